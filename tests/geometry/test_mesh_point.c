/* A point and a closed mesh: winding numbers and nearest places. */
#include "base/random.h"
#include "geometry/mesh_point.h"
#include "testing.h"

START_TEST(box)
{
    context ctx;
    context_init(&ctx);
    mesh m = {0};
    ck_assert(mesh_make_box(&ctx, (vec3){-1, -2, -3}, (vec3){1, 2, 3}, &m));
    random_stream r = random_begin(1, 0, 0);
    for (int i = 0; i < 2000; i++) {
        vec3 p = {random_uniform(&r, -2, 2), random_uniform(&r, -4, 4), random_uniform(&r, -5, 5)};
        bool inside = fabs(p.x) < 1 && fabs(p.y) < 2 && fabs(p.z) < 3;
        assert_absolute(mesh_winding(&m, p), inside ? 1 : 0, 1e-12);
        vec3 expected = {fmax(-1, fmin(1, p.x)), fmax(-2, fmin(2, p.y)), fmax(-3, fmin(3, p.z))};
        if (inside) {
            double dx = 1 - fabs(p.x), dy = 2 - fabs(p.y), dz = 3 - fabs(p.z);
            if (dx < dy && dx < dz)
                expected.x = p.x > 0 ? 1 : -1;
            else if (dy < dz)
                expected.y = p.y > 0 ? 2 : -2;
            else
                expected.z = p.z > 0 ? 3 : -3;
        }
        int32_t face = -1;
        vec3 q = mesh_nearest_point(&m, p, &face);
        assert_vec3_close(q, expected, 1e-12);
        ck_assert(face >= 0 && face < m.face.count);
        /* The face holds the point. */
        vec3 n = mesh_area_vector(&m, face), v = m.vertex.data[m.face.data[face].v[0]];
        assert_absolute(vec3_dot(n, vec3_sub(q, v)), 0, 1e-10);
    }
    vec3 at = {1, 2, 0.5};
    assert_vec3_close(mesh_nearest_point(&m, at, NULL), at, 1e-15);
    mesh_free(&ctx, &m);
}
END_TEST

/* In the hollow of a U the convex hull says inside, the surface outside. */
START_TEST(hollow)
{
    context ctx;
    context_init(&ctx);
    fram_error e = {0};
    mesh m = {0};
    static const vec2 fork[8] = {{-5, -5}, {5, -5}, {5, -2}, {-2, -2}, {-2, 2}, {5, 2}, {5, 5}, {-5, 5}};
    assert_ok(mesh_make_prism(&ctx, (polygon){fork, 8}, -1, 1, &m, &e), e);
    assert_absolute(mesh_winding(&m, (vec3){2, 0, 0}), 0, 1e-12);
    assert_absolute(mesh_winding(&m, (vec3){2, 3, 0}), 1, 1e-12);
    assert_absolute(mesh_winding(&m, (vec3){-3, 0, 0.9}), 1, 1e-12);
    assert_vec3_close(mesh_nearest_point(&m, (vec3){2, 0.5, 0}, NULL), ((vec3){2, 2, 0}), 1e-14);
    assert_vec3_close(mesh_nearest_point(&m, (vec3){-1.5, 0.1, 0.2}, NULL), ((vec3){-2, 0.1, 0.2}), 1e-14);
    assert_vec3_close(mesh_nearest_point(&m, (vec3){9, 9, 9}, NULL), ((vec3){5, 5, 1}), 1e-14);
    mesh_free(&ctx, &m);
}
END_TEST

TEST_MAIN("mesh_point", box, hollow)

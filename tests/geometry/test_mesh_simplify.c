/* Fewer triangles for the same surface: closed as before, sound, and no farther away than was allowed. */
#include "geometry/mesh_point.h"
#include "geometry/mesh_simplify.h"
#include "geometry/polyhedron.h"
#include "mesh_samples.h"
#include "testing.h"

static void check_sound(context *ctx, const mesh *m)
{
    mesh_report report;
    ck_assert_int_eq(mesh_check(ctx, m, true, &report), FRAM_OK);
    ck_assert_msg(report.defect == MESH_CLOSED, "%s", report.text);
}

/* Every stride-th vertex of `from` is within `distance` of the surface `to`. */
static void check_near(const mesh *from, const mesh *to, int32_t stride, double distance)
{
    for (int32_t i = 0; i < from->vertex.count; i += stride) {
        vec3 p = from->vertex.data[i], q = mesh_nearest_point(to, p, NULL);
        ck_assert_msg(vec3_length(vec3_sub(p, q)) <= distance, "vertex %d is %g off", i, vec3_length(vec3_sub(p, q)));
    }
}

START_TEST(sphere)
{
    context ctx;
    context_init(&ctx);
    mesh fine = {0}, coarse = {0};
    sample_sphere_mesh(&ctx, 80, 120, 10, &fine);
    ck_assert(mesh_copy(&ctx, &coarse, &fine));
    double largest = 0;
    ck_assert_int_eq(mesh_simplify(&ctx, &coarse, 0.05, &largest), FRAM_OK);
    ck_assert(largest > 0 && largest <= 0.05);
    ck_assert_int_lt(coarse.face.count, fine.face.count / 2);
    check_sound(&ctx, &coarse);
    check_near(&fine, &coarse, 7, largest);
    /* Vertices stay where they were: the sphere is only cut off, by a shell of the distance at most. */
    double before = mesh_solid_properties(&fine).volume, after = mesh_solid_properties(&coarse).volume;
    ck_assert(after < before && after > before * (1 - 3 * largest / 10));
    /* Nothing is allowed: nothing goes. */
    int32_t faces = fine.face.count;
    ck_assert_int_eq(mesh_simplify(&ctx, &fine, 0, &largest), FRAM_OK);
    ck_assert_int_eq(fine.face.count, faces);
    mesh_free(&ctx, &fine);
    mesh_free(&ctx, &coarse);
}
END_TEST

/* A plate of many squares, which is a box again: corners and edges stay sharp. */
START_TEST(divided_box)
{
    enum { N = 40 };
    context ctx;
    context_init(&ctx);
    mesh m = {0};
    const vec3 size = {30, 8, 3};
    int32_t joined;
    for (int side = 0; side < 2; side++)
        for (int32_t u = 0; u <= N; u++)
            for (int32_t v = 0; v <= N; v++)
                ck_assert(mesh_add_vertex(&ctx, &m, vec3_make(size.x * u / N, size.y * v / N, size.z * side)));
    const int32_t top = (N + 1) * (N + 1), row = N + 1;
    for (int32_t u = 0; u < N; u++)
        for (int32_t v = 0; v < N; v++) {
            int32_t a = u * row + v, b = a + row, c = b + 1, d = a + 1;
            ck_assert(mesh_add_triangle(&ctx, &m, a, c, b) && mesh_add_triangle(&ctx, &m, a, d, c) &&
                      mesh_add_triangle(&ctx, &m, top + a, top + b, top + c) &&
                      mesh_add_triangle(&ctx, &m, top + a, top + c, top + d));
        }
    for (int32_t i = 0; i < N; i++) {
        const int32_t from[4] = {i * row, N * row + i, (N - i) * row + N, N - i};
        const int32_t to[4] = {(i + 1) * row, N * row + i + 1, (N - i - 1) * row + N, N - i - 1};
        for (int k = 0; k < 4; k++)
            ck_assert(mesh_add_triangle(&ctx, &m, from[k], to[k], top + to[k]) &&
                      mesh_add_triangle(&ctx, &m, from[k], top + to[k], top + from[k]));
    }
    ck_assert_int_eq(mesh_weld(&ctx, &m, 0, &joined), FRAM_OK);
    check_sound(&ctx, &m);
    double volume = mesh_solid_properties(&m).volume, largest = 0;
    assert_relative(volume, 30.0 * 8 * 3, 1e-12);
    int32_t faces = m.face.count;
    ck_assert_int_eq(mesh_simplify(&ctx, &m, 1e-6, &largest), FRAM_OK);
    check_sound(&ctx, &m);
    ck_assert_int_lt(m.face.count, faces / 20);
    assert_relative(mesh_solid_properties(&m).volume, volume, 1e-9);
    mesh_free(&ctx, &m);
}
END_TEST

/* A hollow hull so fine that its pieces are cut from a coarser surface: they still hold all of it, within the
   tolerance. */
START_TEST(pieces_of_a_fine_hull)
{
    context ctx;
    context_init(&ctx);
    mesh m = {0};
    sample_hull_mesh(&ctx, 140, 90, &m);
    ck_assert_int_gt(m.face.count, 20000);
    const double tolerance = 0.5;
    polyhedron_array pieces = {0};
    double concavity = 0;
    fram_error error = {0};
    assert_ok(mesh_convex_pieces(&ctx, &m, tolerance, 64, &pieces, &concavity, &error), error);
    ck_assert(concavity <= tolerance);
    for (int32_t v = 0; v < m.vertex.count; v++) {
        bool found = false;
        for (int32_t i = 0; i < pieces.count && !found; i++)
            found = polyhedron_contains(&pieces.data[i], m.vertex.data[v], 0.2 * tolerance);
        ck_assert_msg(found, "vertex %d is in no piece", v);
    }
    polyhedron_array_free(&ctx, &pieces);
    mesh_free(&ctx, &m);
}
END_TEST

int main(void)
{
    const TTest *const list[] = {sphere, divided_box, pieces_of_a_fine_hull};
    return testing_run("mesh_simplify", list, (int)(sizeof list / sizeof *list));
}

/* Moments of tree nodes against sums over triangles, and sample points against areas. */
#include "base/random.h"
#include "geometry/mesh_integrals.h"
#include "testing.h"

/* A box of `cells`^2 squares a side. */
static mesh fine_box(context *ctx, vec3 half, int cells)
{
    mesh m = {0};
    static const int axis[6][3] = {{0, 1, 2}, {1, 0, 2}, {1, 2, 0}, {2, 1, 0}, {2, 0, 1}, {0, 2, 1}};
    const double size[3] = {half.x, half.y, half.z};
    for (int side = 0; side < 6; side++) {
        for (int i = 0; i < cells; i++) {
            for (int j = 0; j < cells; j++) {
                int32_t first = m.vertex.count;
                for (int k = 0; k < 4; k++) {
                    double p[3];
                    p[axis[side][0]] = size[axis[side][0]] * (2.0 * (i + (k == 1 || k == 2)) / cells - 1);
                    p[axis[side][1]] = size[axis[side][1]] * (2.0 * (j + (k > 1)) / cells - 1);
                    p[axis[side][2]] = size[axis[side][2]] * (side & 1 ? -1 : 1);
                    ck_assert(mesh_add_vertex(ctx, &m, vec3_make(p[0], p[1], p[2])));
                }
                ck_assert(mesh_add_triangle(ctx, &m, first, first + 1, first + 2));
                ck_assert(mesh_add_triangle(ctx, &m, first, first + 2, first + 3));
            }
        }
    }
    return m;
}

static double area_of_points(const mesh_integrals *all, int32_t first, int32_t end)
{
    double sum = 0;
    for (int32_t i = first; i < end; i++)
        sum += all->area.data[i];
    return sum;
}

/* Area of the places of a node by its points and large triangles. */
static double area_covered(const mesh *m, const mesh_bvh *tree, const mesh_integrals *all, const mesh_bvh_node *node)
{
    int32_t end = node->first + node->count;
    double sum = area_of_points(all, all->point_first.data[node->first], all->point_first.data[end]);
    for (int32_t i = all->large_first.data[node->first]; i < all->large_first.data[end]; i++)
        sum += vec3_length(mesh_area_vector(m, tree->face.data[all->large.data[i]]));
    return sum;
}

static void check_mesh(mesh *m, bool joins, bool large)
{
    context ctx;
    context_init(&ctx);
    mesh_bvh tree = {0};
    mesh_integrals all;
    ck_assert_int_eq(mesh_bvh_build(&ctx, m, &tree), FRAM_OK);
    ck_assert(mesh_integrals_build(&ctx, m, &tree, &all));
    ck_assert_int_eq(all.moments.count, tree.node.count);
    ck_assert_int_eq(all.point_first.count, m->face.count + 1);
    ck_assert_msg((all.x.count < m->face.count) == joins && (all.large.count > 0) == large, "%d points, %d large of %d",
                  (int)all.x.count, (int)all.large.count, (int)m->face.count);

    /* Every node: the pressure of a linear field, from its moments and triangle by triangle. */
    vec3 slope = {0.3, -0.7, 0.2};
    double level = 1.3;
    int32_t settled = 0; /* places whose points are shared with earlier ones */
    for (int32_t n = 0; n < tree.node.count; n++) {
        const mesh_bvh_node *node = &tree.node.data[n];
        const surface_moments *s = &all.moments.data[n];
        vec3 force = {0, 0, 0}, moment = {0, 0, 0};
        double area = 0;
        for (int32_t i = node->first; i < node->first + node->count; i++) {
            vec3 v[3];
            mesh_face_points(m, tree.face.data[i], v);
            vec3 normal = mesh_area_vector(m, tree.face.data[i]);
            area += vec3_length(normal);
            double at[3], sum = 0;
            for (int k = 0; k < 3; k++)
                sum += at[k] = level + vec3_dot(slope, v[k]);
            force = vec3_mad(force, normal, sum / 3);
            for (int k = 0; k < 3; k++)
                moment = vec3_mad(moment, vec3_cross(v[k], normal), (sum + at[k]) / 12);
        }
        assert_vec3_close(vec3_mad(mat3_mul_vec(s->area_first, slope), s->area, level), force, 1e-11);
        assert_vec3_close(vec3_mad(mat3_mul_vec(s->turn_first, slope), s->turn, level), moment, 1e-10);
        if (node->first >= settled)
            assert_relative(area_covered(m, &tree, &all, node), area, 1e-9);
        bool one = all.point_first.data[node->first + node->count] - all.point_first.data[node->first] == 1;
        if (one && node->first >= settled)
            settled = node->first + node->count;
    }
    /* Closed: no area vector, and three times the volume. */
    const surface_moments *whole = &all.moments.data[0];
    assert_vec3_close(whole->area, vec3_make(0, 0, 0), 1e-11);
    for (int i = 0; i < 3; i++)
        assert_relative(whole->area_first.m[i][i], mesh_solid_properties(m).volume, 1e-11);
    for (int32_t i = 0; i < all.x.count; i++) {
        vec3 normal = {all.nx.data[i], all.ny.data[i], all.nz.data[i]};
        assert_absolute(vec3_length(normal), 1, 1e-14);
    }
    mesh_integrals_free(&ctx, &all);
    mesh_bvh_free(&ctx, &tree);
    mesh_free(&ctx, m);
}

START_TEST(moments_and_points)
{
    context ctx;
    context_init(&ctx);
    mesh coarse = fine_box(&ctx, vec3_make(3, 2, 1), 1), middle = fine_box(&ctx, vec3_make(3, 2, 1), 12),
         fine = fine_box(&ctx, vec3_make(3, 2, 1), getenv("FRAM_TEST_SHORT") ? 60 : 150);
    check_mesh(&coarse, true, true);
    check_mesh(&middle, false, false);
    check_mesh(&fine, true, false);
}
END_TEST

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        context good;
        context_init(&good);
        mesh m = fine_box(&good, vec3_make(1, 1, 1), 3);
        mesh_bvh tree = {0};
        ck_assert_int_eq(mesh_bvh_build(&good, &m, &tree), FRAM_OK);
        mesh_integrals all;
        bool made = mesh_integrals_build(&turn.ctx, &m, &tree, &all);
        if (made)
            mesh_integrals_free(&turn.ctx, &all);
        ck_assert_int_eq(all.x.count, 0);
        mesh_bvh_free(&good, &tree);
        mesh_free(&good, &m);
        turn.status = made ? FRAM_OK : FRAM_ERROR_MEMORY;
    }
}
END_TEST

TEST_MAIN("mesh_integrals", moments_and_points, memory_runs_out)

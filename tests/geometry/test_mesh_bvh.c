#include "geometry/mesh_bvh.h"
#include "mesh_samples.h"

static const box3 everything = {{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};

static box3 random_box(random_stream *r, double size)
{
    vec3 lo = {random_uniform(r, -1.2, 1.2), random_uniform(r, -1.2, 1.2), random_uniform(r, -1.2, 1.2)};
    vec3 d = {random_uniform(r, 0, size), random_uniform(r, 0, size), random_uniform(r, 0, size)};
    return (box3){lo, vec3_add(lo, d)};
}

/* The query's answer is the one of a walk over all faces, in ascending order. */
static void compare(const mesh *m, const int32_array *found, box3 box, vec3 normal, double lo, double hi)
{
    int32_t next = 0;
    for (int32_t f = 0; f < m->face.count; f++) {
        box3 b = mesh_face_bounds(m, f);
        double least = HUGE_VAL, most = -HUGE_VAL;
        for (int corner = 0; corner < 8; corner++) {
            vec3 p = {corner & 1 ? b.hi.x : b.lo.x, corner & 2 ? b.hi.y : b.lo.y, corner & 4 ? b.hi.z : b.lo.z};
            least = fmin(least, vec3_dot(normal, p));
            most = fmax(most, vec3_dot(normal, p));
        }
        if (box3_meet(box, b) && least <= hi && most >= lo) {
            ck_assert_int_lt(next, found->count);
            ck_assert_int_eq(found->data[next], f);
            next++;
        }
    }
    ck_assert_int_eq(next, found->count);
}

START_TEST(finds_what_a_walk_finds)
{
    context ctx;
    context_init(&ctx);
    static const int32_t sizes[][2] = {{3, 3}, {4, 5}, {9, 11}, {40, 31}};
    for (int s = 0; s < 4; s++) {
        mesh m = {0};
        mesh_bvh tree = {0};
        int32_array found = {0};
        sample_sphere_mesh(&ctx, sizes[s][0], sizes[s][1], 1, &m);
        ck_assert_int_eq(mesh_bvh_build(&ctx, &m, &tree), FRAM_OK);
        random_stream r = random_begin(1, 2, (uint32_t)s);
        for (int i = 0; i < 50; i++) {
            box3 box = random_box(&r, i % 5 ? 0.6 : 3);
            ck_assert(mesh_bvh_query(&ctx, &tree, box, &found));
            compare(&m, &found, box, (vec3){0, 0, 0}, 0, 0);
            vec3 n = vec3_unit((vec3){random_normal(&r), random_normal(&r), random_normal(&r)});
            double lo = random_uniform(&r, -1, 1), hi = lo + random_uniform(&r, 0, 0.3);
            ck_assert(mesh_bvh_query_slab(&ctx, &tree, i % 2 ? box : everything, n, lo, hi, &found));
            compare(&m, &found, i % 2 ? box : everything, n, lo, hi);
        }
        ck_assert(mesh_bvh_query(&ctx, &tree, everything, &found));
        ck_assert_int_eq(found.count, m.face.count);
        array_free(&ctx, &found);
        mesh_bvh_free(&ctx, &tree);
        mesh_free(&ctx, &m);
    }
}
END_TEST

START_TEST(touching_counts_and_nothing_is_found_in_nothing)
{
    context ctx;
    context_init(&ctx);
    mesh m = {0};
    mesh_bvh tree = {0};
    int32_array found = {0};
    ck_assert_int_eq(mesh_bvh_build(&ctx, &m, &tree), FRAM_OK);
    ck_assert(mesh_bvh_query(&ctx, &tree, everything, &found));
    ck_assert_int_eq(found.count, 0);
    ck_assert(mesh_make_box(&ctx, (vec3){0, 0, 0}, (vec3){1, 1, 1}, &m));
    ck_assert_int_eq(mesh_bvh_build(&ctx, &m, &tree), FRAM_OK);
    ck_assert(mesh_bvh_query(&ctx, &tree, (box3){{1, 0.2, 0.3}, {2, 0.2, 0.3}}, &found));
    ck_assert_int_ge(found.count, 1);
    ck_assert(mesh_bvh_query(&ctx, &tree, (box3){{1.001, 0, 0}, {2, 1, 1}}, &found));
    ck_assert_int_eq(found.count, 0);
    /* An empty box meets nothing. */
    ck_assert(mesh_bvh_query(&ctx, &tree, box3_empty(), &found));
    ck_assert_int_eq(found.count, 0);
    array_free(&ctx, &found);
    mesh_bvh_free(&ctx, &tree);
    mesh_free(&ctx, &m);
}
END_TEST

/* Faces whose centres coincide or stand in one line still make a balanced tree. */
START_TEST(equal_triangles_make_a_tree)
{
    context ctx;
    context_init(&ctx);
    mesh m = {0};
    mesh_bvh tree = {0};
    int32_array found = {0};
    mesh_add_vertex(&ctx, &m, (vec3){0, 0, 0});
    mesh_add_vertex(&ctx, &m, (vec3){1, 0, 0});
    mesh_add_vertex(&ctx, &m, (vec3){0, 1, 0});
    for (int i = 0; i < 1000; i++)
        mesh_add_triangle(&ctx, &m, 0, 1, 2);
    ck_assert_int_eq(mesh_bvh_build(&ctx, &m, &tree), FRAM_OK);
    ck_assert_int_le(tree.node.count, 1001);
    ck_assert(mesh_bvh_query(&ctx, &tree, (box3){{0, 0, 0}, {0, 0, 0}}, &found));
    ck_assert_int_eq(found.count, 1000);
    for (int32_t i = 0; i < found.count; i++)
        ck_assert_int_eq(found.data[i], i);
    array_free(&ctx, &found);
    mesh_bvh_free(&ctx, &tree);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(memory_runs_out)
{
    context plain;
    context_init(&plain);
    mesh m = {0};
    sample_sphere_mesh(&plain, 9, 9, 1, &m);
    for (failing_turn turn = {0}; failing_next(&turn);) {
        mesh_bvh tree = {0};
        int32_array found = {0};
        turn.status = mesh_bvh_build(&turn.ctx, &m, &tree);
        if (turn.status == FRAM_OK && !mesh_bvh_query(&turn.ctx, &tree, everything, &found))
            turn.status = FRAM_ERROR_MEMORY;
        array_free(&turn.ctx, &found);
        mesh_bvh_free(&turn.ctx, &tree);
    }
    mesh_free(&plain, &m);
}
END_TEST

TEST_MAIN("mesh_bvh", finds_what_a_walk_finds, touching_counts_and_nothing_is_found_in_nothing,
          equal_triangles_make_a_tree, memory_runs_out)

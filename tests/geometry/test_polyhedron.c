#include "geometry/polyhedron_build.h"
#include "mesh_samples.h"

static context plain(void)
{
    context ctx;
    context_init(&ctx);
    return ctx;
}

/* The next point of a loop. */
static int32_t after(const polyhedron *p, const polyhedron_face *f, int32_t i)
{
    return p->loop.data[f->first + (i + 1) % f->count];
}

/* Loops close up, each edge is run along once in each direction, Euler's formula holds, all vertices are inside all
   planes and on those of their faces within `tolerance`, the centre is inside. */
static void check_polyhedron(const polyhedron *p, double tolerance)
{
    int32_t edges = 0, vertices = p->vertex.count;
    uint8_t *runs = calloc((size_t)vertices, (size_t)vertices); /* loops that run from one vertex to another */
    for (int32_t k = 0; k < p->face.count; k++)
        for (int32_t i = 0; i < p->face.data[k].count; i++)
            runs[p->loop.data[p->face.data[k].first + i] * vertices + after(p, &p->face.data[k], i)]++;
    for (int32_t k = 0; k < p->face.count; k++) {
        const polyhedron_face *f = &p->face.data[k];
        ck_assert_int_ge(f->count, 3);
        assert_absolute(vec3_length(f->normal), 1, 1e-14);
        for (int32_t i = 0; i < f->count; i++) {
            int32_t from = p->loop.data[f->first + i], to = after(p, f, i);
            edges++;
            ck_assert_int_ge(p->loop.data[f->first + i], p->loop.data[f->first]); /* begins at the least */
            ck_assert_int_eq(runs[from * vertices + to], 1);
            ck_assert_int_eq(runs[to * vertices + from], 1);
            assert_absolute(vec3_dot(f->normal, p->vertex.data[from]), f->offset, 2 * tolerance);
        }
        double highest = -HUGE_VAL;
        for (int32_t v = 0; v < vertices; v++)
            highest = testing_larger(highest, vec3_dot(f->normal, p->vertex.data[v]));
        ck_assert_double_le(highest, f->offset + 2 * tolerance);
    }
    free(runs);
    ck_assert_int_eq(p->vertex.count - edges / 2 + p->face.count, 2);
    ck_assert(polyhedron_contains(p, p->centre, 0));
    for (int32_t v = 0; v < p->vertex.count; v++)
        ck_assert_double_le(vec3_length(vec3_sub(p->vertex.data[v], p->centre)), p->radius);
}

static void assert_hull(context *ctx, const vec3 *point, int32_t count, double tolerance, polyhedron *out)
{
    fram_error error;
    assert_ok(polyhedron_hull(ctx, point, count, tolerance, out, &error), error);
    double bound = fmax(tolerance, 1e-12 * out->radius);
    check_polyhedron(out, bound);
    for (int32_t i = 0; i < count; i++)
        ck_assert(polyhedron_contains(out, point[i], 2 * bound));
}

START_TEST(box_from_a_cloud)
{
    context ctx = plain();
    polyhedron p = {0};
    vec3 point[300];
    random_stream r = random_begin(1, 1, 1);
    for (int turned = 0; turned < 3; turned++) {
        mat3 rotation = quat_matrix(quat_unit((quat){1, 0.3 * turned, -0.2 * turned, 0.7 * turned}));
        vec3 shift = {1000.0 * turned, 0, 0};
        for (int i = 0; i < 300; i++) {
            /* Corners last; points inside, on sides and on edges before. */
            vec3 q = i >= 292
                         ? (vec3){i & 1, (i >> 1) & 1, (i >> 2) & 1}
                         : (vec3){i % 7 == 0 ? 0 : random_unit(&r), i % 3 == 0 ? 1 : random_unit(&r), random_unit(&r)};
            point[i] = vec3_add(mat3_mul_vec(rotation, (vec3){4 * q.x, 2 * q.y, q.z}), shift);
        }
        assert_hull(&ctx, point, 300, 1e-9, &p);
        ck_assert_int_eq(p.vertex.count, 8);
        ck_assert_int_eq(p.face.count, 6);
        ck_assert_int_eq(p.loop.count, 24);
        ck_assert_int_eq(p.edge_direction.count, 3);
        assert_relative(polyhedron_volume(&p), 8, 1e-11);
        assert_vec3_close(p.centre, vec3_add(mat3_mul_vec(rotation, (vec3){2, 1, 0.5}), shift), 1e-11);
        assert_relative(p.radius, sqrt(21) / 2, 1e-11);
    }
    polyhedron_free(&ctx, &p);
}
END_TEST

START_TEST(random_points)
{
    context ctx = plain();
    polyhedron p = {0};
    static vec3 point[2000];
    random_stream r = random_begin(2, 1, 1);
    for (int kind = 0; kind < 4; kind++)
        for (int n = 4; n <= 2000; n = n * 2 + 1) {
            for (int i = 0; i < n; i++) {
                vec3 q = {random_normal(&r), random_normal(&r), random_normal(&r)};
                point[i] = kind == 0   ? q                                                      /* a cloud */
                           : kind == 1 ? vec3_unit(q)                                           /* a sphere */
                           : kind == 2 ? (vec3){floor(q.x * 2), floor(q.y * 2), floor(q.z * 2)} /* a lattice */
                                       : (vec3){q.x, q.y, 1e-7 * q.z};                          /* nearly flat */
            }
            if (kind == 2 && n < 60)
                continue; /* may be flat */
            assert_hull(&ctx, point, n, 0, &p);
        }
    polyhedron_free(&ctx, &p);
}
END_TEST

/* Sides that are flat but for noise about the tolerance. */
START_TEST(noisy_sides)
{
    context ctx = plain();
    polyhedron p = {0};
    static vec3 point[1500];
    random_stream r = random_begin(3, 1, 1);
    for (int level = -13; level <= -1; level++) {
        double noise = 1;
        for (int i = 0; i > level; i--)
            noise /= 10;
        for (int i = 0; i < 1500; i++) {
            double q[3] = {random_unit(&r), random_unit(&r), random_unit(&r)};
            q[i % 3] = (i / 3) % 2;
            for (int k = 0; k < 3; k++)
                q[k] += random_uniform(&r, -noise, noise);
            point[i] = (vec3){q[0], q[1], q[2]};
        }
        for (int k = 0; k < 3; k++) {
            double factor[3] = {0.3, 1, 10};
            if (factor[k] * noise < 0.2)
                assert_hull(&ctx, point, 1500, factor[k] * noise, &p);
            if (level < -4 && k == 2)
                ck_assert_int_le(p.face.count, 150); /* not the thousand triangles of the noise */
        }
    }
    polyhedron_free(&ctx, &p);
}
END_TEST

START_TEST(order_does_not_move_the_shape)
{
    context ctx = plain();
    polyhedron p = {0}, q = {0};
    vec3 point[200], other[200];
    random_stream r = random_begin(4, 1, 1);
    for (int i = 0; i < 200; i++)
        point[i] = vec3_unit((vec3){random_normal(&r), random_normal(&r), random_normal(&r)});
    for (int i = 0; i < 200; i++)
        other[i] = point[(i * 77 + 5) % 200];
    assert_hull(&ctx, point, 200, 0, &p);
    assert_hull(&ctx, other, 200, 0, &q);
    ck_assert_int_eq(p.face.count, q.face.count);
    assert_relative(polyhedron_volume(&p), polyhedron_volume(&q), 1e-14);
    /* The same points give the same bits. */
    assert_hull(&ctx, point, 200, 0, &q);
    ck_assert_int_eq(p.loop.count, q.loop.count);
    ck_assert(memcmp(p.loop.data, q.loop.data, (size_t)p.loop.count * sizeof *p.loop.data) == 0);
    assert_array_bits(&p.vertex.data[0].x, &q.vertex.data[0].x, 3 * p.vertex.count);
    for (int32_t k = 0; k < p.face.count; k++)
        assert_array_bits(&p.face.data[k].normal.x, &q.face.data[k].normal.x, 4);
    polyhedron_free(&ctx, &p);
    polyhedron_free(&ctx, &q);
}
END_TEST

/* Coplanar neighbours become one face, and straight vertices of its edges go. */
START_TEST(faces_of_a_prism_are_merged)
{
    context ctx = plain();
    polyhedron p = {0};
    vec3 point[120];
    int n = 0;
    /* A hexagonal prism whose edges have points in between. */
    for (int k = 0; k < 6; k++) {
        vec2 a = {real_cos(PI / 3 * k), real_sin(PI / 3 * k)},
             b = {real_cos(PI / 3 * (k + 1)), real_sin(PI / 3 * (k + 1))};
        for (int i = 0; i < 4; i++) {
            vec2 c = vec2_add(vec2_scale(a, 1 - i / 4.0), vec2_scale(b, i / 4.0));
            point[n++] = (vec3){c.x, c.y, 0};
            point[n++] = (vec3){c.x, c.y, 2};
            if (i == 0)
                point[n++] = (vec3){c.x, c.y, 0.7};
        }
    }
    assert_hull(&ctx, point, n, 1e-9, &p);
    ck_assert_int_eq(p.vertex.count, 12);
    ck_assert_int_eq(p.face.count, 8);
    ck_assert_int_eq(p.edge_direction.count, 4);
    assert_relative(polyhedron_volume(&p), 3 * sqrt(3), 1e-14);
    polyhedron_free(&ctx, &p);
}
END_TEST

/* A fine cylinder, all of whose side triangles are slivers by the tolerance of merging: its two lids would take them
   all, and two faces are no body. */
START_TEST(too_thin_to_be_merged)
{
    context ctx = plain();
    polyhedron p = {0};
    hull_triangle_array triangles = {0};
    fram_error error;
    vec3 point[256];
    for (int i = 0; i < 256; i++) {
        double angle = PI / 64 * (i / 2);
        point[i] = (vec3){real_cos(angle), real_sin(angle), i % 2};
    }
    assert_ok(convex_hull_triangles(&ctx, point, 256, 0, &triangles, &error), error);
    ck_assert_int_eq(triangles.count, 2 * 256 - 4);
    ck_assert(polyhedron_from_triangles(&ctx, point, &triangles, 0.06, &p));
    ck_assert_int_eq(p.face.count, triangles.count);
    double volume = polyhedron_volume(&p);
    polyhedron_free(&ctx, &p);
    ck_assert(polyhedron_from_triangles(&ctx, point, &triangles, 1e-12, &p));
    ck_assert_int_eq(p.face.count, 128 + 2);
    assert_relative(volume, polyhedron_volume(&p), 1e-14);
    check_polyhedron(&p, 1e-12);
    polyhedron_free(&ctx, &p);
    array_free(&ctx, &triangles);
}
END_TEST

START_TEST(needles_and_plates)
{
    context ctx = plain();
    polyhedron p = {0};
    fram_error error;
    /* Too flat for the tolerance, and just not. */
    for (int i = 0; i < 12; i++) {
        double thin = 1;
        for (int k = 0; k < i; k++)
            thin /= 10;
        vec3 plate[8], needle[8];
        for (int k = 0; k < 8; k++) {
            plate[k] = (vec3){k & 1, (k >> 1) & 1, ((k >> 2) & 1) * thin};
            needle[k] = (vec3){k & 1, ((k >> 1) & 1) * thin, ((k >> 2) & 1) * thin};
        }
        assert_hull(&ctx, plate, 8, 0, &p);
        ck_assert_int_eq(p.face.count, 6);
        assert_hull(&ctx, needle, 8, 0, &p);
        ck_assert_int_eq(p.face.count, 6);
        assert_hull(&ctx, plate, 8, 0.4 * thin, &p);
        assert_hull(&ctx, needle, 8, 0.3 * thin, &p);
        assert_fails(polyhedron_hull(&ctx, plate, 8, 2.1 * thin, &p, &error), error, FRAM_ERROR_INPUT, "in a plane");
        ck_assert_int_eq(p.face.count, 0);
    }
    polyhedron_free(&ctx, &p);
}
END_TEST

/* Every face holds its vertices in its plane, and all others behind it. */
static void check_planes(const polyhedron *p, double slack)
{
    for (int32_t k = 0; k < p->face.count; k++) {
        const polyhedron_face *f = &p->face.data[k];
        for (int32_t i = 0; i < p->vertex.count; i++)
            ck_assert_double_le(vec3_dot(f->normal, p->vertex.data[i]) - f->offset, slack);
        for (int32_t i = f->first; i < f->first + f->count; i++)
            assert_absolute(vec3_dot(f->normal, p->vertex.data[p->loop.data[i]]), f->offset, slack);
    }
}

/* Turned and moved, and moved back: the same body, in memory that is used again. */
START_TEST(bodies_in_other_places)
{
    context ctx = plain();
    random_stream r = random_begin(17, 1, 1);
    polyhedron p = {0}, q = {0};
    fram_error error;
    for (int round = 0; round < 20; round++) {
        vec3 point[40], centre = {random_normal(&r), 10 * random_normal(&r), random_normal(&r)};
        for (int i = 0; i < 40; i++)
            point[i] = (vec3){random_normal(&r), random_normal(&r), random_normal(&r)};
        assert_ok(polyhedron_hull(&ctx, point, 40 - round, 0, &p, &error), error);
        mat3 turn = quat_matrix(quat_from_roll_pitch_yaw(0.3 * round, 1, 2));
        ck_assert(polyhedron_place(&ctx, &p, turn, centre, &q));
        check_planes(&q, 1e-12);
        ck_assert_int_eq(q.edge_direction.count, p.edge_direction.count);
        assert_relative(polyhedron_volume(&q), polyhedron_volume(&p), 1e-12);
        assert_vec3_close(q.centre, vec3_add(centre, mat3_mul_vec(turn, p.centre)), 1e-14);
        for (int32_t i = 0; i < q.edge_direction.count; i++)
            assert_vec3_close(q.edge_direction.data[i], mat3_mul_vec(turn, p.edge_direction.data[i]), 1e-15);
        assert_bits(q.radius, p.radius);
        polyhedron_translate(&q, vec3_neg(centre));
        check_planes(&q, 1e-12);
        assert_vec3_close(q.centre, mat3_mul_vec(turn, p.centre), 1e-13);
    }
    polyhedron_free(&ctx, &q);
    for (failing_turn turn = {0}; failing_next(&turn);) {
        polyhedron out = {0};
        bool placed = polyhedron_place(&turn.ctx, &p, quat_matrix(quat_identity()), p.centre, &out);
        polyhedron_free(&turn.ctx, &out);
        turn.status = placed ? FRAM_OK : FRAM_ERROR_MEMORY;
    }
    polyhedron_free(&ctx, &p);
}
END_TEST

START_TEST(inputs_that_span_nothing)
{
    context ctx = plain();
    polyhedron p = {0};
    fram_error error;
    vec3 point[8] = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {1, 2, 3}, {0, 0, 0}, {2, 3, 4}, {1, 2, 3}};
    assert_fails(polyhedron_hull(&ctx, point, 0, 0, &p, &error), error, FRAM_ERROR_INPUT, "0 points");
    assert_fails(polyhedron_hull(&ctx, point, 3, 0, &p, &error), error, FRAM_ERROR_INPUT, "3 points");
    assert_fails(polyhedron_hull(&ctx, point, 4, 0, &p, &error), error, FRAM_ERROR_INPUT, "in a plane"); /* a line */
    assert_fails(polyhedron_hull(&ctx, point, 8, 0, &p, &error), error, FRAM_ERROR_INPUT, "in a plane");
    vec3 same[5] = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
    assert_fails(polyhedron_hull(&ctx, same, 5, 0, &p, &error), error, FRAM_ERROR_INPUT, "in a plane");
    point[2].z = (double)NAN;
    assert_fails(polyhedron_hull(&ctx, point, 8, 0, &p, &error), error, FRAM_ERROR_INPUT, "point 2");
    ck_assert(!polyhedron_contains(&p, (vec3){0, 0, 0}, 1));
    ck_assert(polyhedron_volume(&p) == 0);
    polyhedron_free(&ctx, &p);
}
END_TEST

START_TEST(memory_runs_out)
{
    vec3 point[40];
    random_stream r = random_begin(9, 1, 1);
    for (int i = 0; i < 40; i++)
        point[i] = (vec3){random_normal(&r), random_normal(&r), random_normal(&r)};
    for (failing_turn turn = {0}; failing_next(&turn);) {
        polyhedron p = {0};
        polyhedron_array list = {0};
        turn.status = polyhedron_hull(&turn.ctx, point, 40, 0, &p, &turn.error);
        if (turn.status == FRAM_OK && !array_push(&turn.ctx, &list, p))
            turn.status = error_memory(&turn.error);
        if (list.count == 0)
            polyhedron_free(&turn.ctx, &p);
        polyhedron_array_free(&turn.ctx, &list);
        if (!turn.memory.failed)
            ck_assert_int_gt(turn.n, 20);
        ck_assert_int_eq(turn.error.status, turn.status);
    }
}
END_TEST

TEST_MAIN("polyhedron", box_from_a_cloud, random_points, noisy_sides, order_does_not_move_the_shape,
          faces_of_a_prism_are_merged, too_thin_to_be_merged, needles_and_plates, bodies_in_other_places,
          inputs_that_span_nothing, memory_runs_out)

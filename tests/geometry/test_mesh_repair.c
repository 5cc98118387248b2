/* Cracks sealed, holes filled, tops raised, triangles turned: what was done, and that a sound solid comes out. */
#include "geometry/mesh_repair.h"
#include "testing.h"

static context plain_context(void)
{
    context ctx;
    context_init(&ctx);
    return ctx;
}

static void add_points(context *ctx, mesh *m, const vec3 *p, int n)
{
    for (int i = 0; i < n; i++)
        ck_assert(mesh_add_vertex(ctx, m, p[i]));
}

/* Box [0, 4] x [0, 2] x [0, 1] whose top is divided in `parts` along x and whose other sides are not; the points of the
   division stand `lift` over the edges of the sides, so that cracks are that wide. */
static mesh cracked_box(context *ctx, int parts, double lift)
{
    mesh m = {0};
    ck_assert(mesh_make_box(ctx, vec3_make(0, 0, 0), vec3_make(4, 2, 1), &m));
    int32_t kept = 0;
    for (int32_t f = 0; f < m.face.count; f++) {
        vec3 n = mesh_area_vector(&m, f);
        if (!(n.z > 0))
            m.face.data[kept++] = m.face.data[f];
    }
    ck_assert_int_eq(kept, 10);
    m.face.count = kept;
    int32_t first = m.vertex.count;
    for (int i = 0; i <= parts; i++) {
        double x = 4.0 * i / parts, z = i == 0 || i == parts ? 1 : 1 + lift;
        add_points(ctx, &m, (const vec3[]){{x, 0, z}, {x, 2, z}}, 2);
    }
    for (int i = 0; i < parts; i++) {
        int32_t a = first + 2 * i;
        ck_assert(mesh_add_triangle(ctx, &m, a, a + 2, a + 3) && mesh_add_triangle(ctx, &m, a, a + 3, a + 1));
    }
    return m;
}

static void check_closed(context *ctx, const mesh *m)
{
    mesh_report report;
    ck_assert_int_eq(mesh_check(ctx, m, true, &report), FRAM_OK);
    ck_assert_msg(report.defect == MESH_CLOSED, "defect %d: %s", (int)report.defect, report.text);
}

START_TEST(cracks_are_closed)
{
    context ctx = plain_context();
    const double lifts[] = {0, 1e-7, 0.02, -0.02};
    for (size_t i = 0; i < sizeof lifts / sizeof *lifts; i++) {
        mesh m = cracked_box(&ctx, 4, lifts[i]);
        int32_array source = {0};
        mesh_seal_report r;
        ck_assert_int_eq(mesh_seal(&ctx, &m, 0.05, &source, &r), FRAM_OK);
        ck_assert_int_eq(r.open_before, 4 + 10);
        ck_assert_int_eq(r.open_after, 0);
        ck_assert_int_eq(r.joined, 4); /* the corners of the top */
        ck_assert_int_eq(r.splits, 6); /* three points on either side */
        assert_absolute(r.width, fabs(lifts[i]), 1e-15);
        /* Each side's crack is a trapezium between 4 and 2 m. */
        assert_absolute(r.area, 2 * 3 * fabs(lifts[i]), 1e-14);
        ck_assert_int_eq(source.count, m.face.count);
        for (int32_t f = 0; f < m.face.count; f++)
            ck_assert(source.data[f] == f || (f >= 18 && source.data[f] < 10));
        ck_assert(mesh_drop_unused_vertices(&ctx, &m));
        ck_assert_int_eq(m.vertex.count, 8 + 6);
        check_closed(&ctx, &m);
        /* The top is where it was: a trapezium of 3 m mean length over the box. */
        double volume = 8 + 2 * 3 * lifts[i];
        vec3 v = mesh_volume_integrals(&m);
        assert_absolute(v.x, volume, 1e-13);
        assert_absolute(v.y, volume, 1e-13);
        assert_absolute(v.z, volume, 1e-13);
        assert_absolute(r.volume.y, 2 * 3 * lifts[i], 1e-13);
        array_free(&ctx, &source);
        mesh_free(&ctx, &m);
    }
}
END_TEST

START_TEST(wider_cracks_stay)
{
    context ctx = plain_context();
    mesh m = cracked_box(&ctx, 4, 0.06);
    mesh_seal_report r;
    ck_assert_int_eq(mesh_seal(&ctx, &m, 0.05, NULL, &r), FRAM_OK);
    ck_assert_int_eq(r.open_after, 2 * 5); /* the corners are joined, the long edges are open */
    ck_assert_int_eq(r.splits, 0);
    ck_assert_int_eq(mesh_seal(&ctx, &m, 0, NULL, &r), FRAM_OK);
    ck_assert_int_eq(r.open_before, 10);
    ck_assert_int_eq(r.open_after, 10);
    mesh_free(&ctx, &m);
}
END_TEST

/* Two halves of a box divided unlike ways along the plane between them, and parted a little. */
START_TEST(both_sides_are_divided)
{
    context ctx = plain_context();
    mesh m = {0};
    const double left[] = {0, 0.3, 0.5, 1}, right[] = {0, 0.2, 0.5, 0.7, 1};
    const double apart = 0.004;
    vec3 p[18];
    for (int i = 0; i < 4; i++) {
        p[i] = vec3_make(-1, left[i], 0);
        p[4 + i] = vec3_make(-apart, left[i], 0);
    }
    for (int i = 0; i < 5; i++) {
        p[8 + i] = vec3_make(apart, right[i], 0);
        p[13 + i] = vec3_make(1, right[i], 0);
    }
    add_points(&ctx, &m, p, 18);
    for (int i = 0; i < 3; i++)
        ck_assert(mesh_add_triangle(&ctx, &m, i, 4 + i, 5 + i) && mesh_add_triangle(&ctx, &m, i, 5 + i, 1 + i));
    for (int i = 8; i < 12; i++)
        ck_assert(mesh_add_triangle(&ctx, &m, i, 5 + i, 6 + i) && mesh_add_triangle(&ctx, &m, i, 6 + i, 1 + i));
    mesh_seal_report r;
    ck_assert_int_eq(mesh_seal(&ctx, &m, 0.01, NULL, &r), FRAM_OK);
    /* Ends and the common middle are joined, one point of the left and two of the right are led over. */
    ck_assert_int_eq(r.joined, 3);
    ck_assert_int_eq(r.splits, 3);
    ck_assert_int_eq(r.open_after, 3 + 4 + 4);
    assert_absolute(r.width, 2 * apart, 1e-15);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(holes_are_filled)
{
    context ctx = plain_context();
    for (int away = 0; away < 12; away++) {
        mesh m = {0};
        mesh_rims rims = {0};
        int32_t edge;
        ck_assert(mesh_make_box(&ctx, vec3_make(0, 0, 0), vec3_make(4, 2, 1), &m));
        m.face.data[away] = m.face.data[--m.face.count];
        ck_assert_int_eq(mesh_rims_find(&ctx, &m, &rims, &edge), FRAM_OK);
        ck_assert_int_eq(mesh_rims_count(&rims), 1);
        ck_assert_int_eq(rims.vertex.count, 3);
        ck_assert_int_eq(mesh_add_polygon(&ctx, &m, rims.vertex.data, 3), FRAM_OK);
        check_closed(&ctx, &m);
        assert_relative(mesh_solid_properties(&m).volume, 8, 1e-15);
        mesh_rims_free(&ctx, &rims);
        mesh_free(&ctx, &m);
    }
}
END_TEST

/* Two triangles that meet in a corner only: one walk, two rims. */
START_TEST(rims_that_touch)
{
    context ctx = plain_context();
    mesh m = {0};
    mesh_rims rims = {0};
    int32_t edge;
    add_points(&ctx, &m, (const vec3[]){{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, 5);
    ck_assert(mesh_add_triangle(&ctx, &m, 0, 1, 2) && mesh_add_triangle(&ctx, &m, 0, 3, 4));
    ck_assert_int_eq(mesh_rims_find(&ctx, &m, &rims, &edge), FRAM_OK);
    ck_assert_int_eq(mesh_rims_count(&rims), 2);
    for (int32_t i = 0; i < 2; i++)
        ck_assert_int_eq(rims.start.data[i + 1] - rims.start.data[i], 3);
    /* In the sense of a cap: against the triangles. */
    assert_vec3_close(mesh_ring_area(&m, rims.vertex.data, 3), vec3_make(0, 0, -0.5), 0);
    m.face.data[1] = (triangle){{0, 2, 1}};
    ck_assert_int_eq(mesh_rims_find(&ctx, &m, &rims, &edge), FRAM_OK);
    ck_assert_int_eq(mesh_rims_count(&rims), 0);
    /* Neighbours that turn unlike ways have no rim that could be walked. */
    add_points(&ctx, &m, (const vec3[]){{1, 1, 0}}, 1);
    m.face.data[1] = (triangle){{1, 2, 5}};
    ck_assert_int_eq(mesh_rims_find(&ctx, &m, &rims, &edge), FRAM_ERROR_INPUT);
    ck_assert_int_ge(edge, 0);
    mesh_rims_free(&ctx, &rims);
    mesh_free(&ctx, &m);
}
END_TEST

/* An open tray with a well through its floor is raised and decked around the well. */
START_TEST(tops_are_raised)
{
    context ctx = plain_context();
    mesh m = {0};
    const double outer = 3, inner = 1, bottom = -2;
    const double side[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    vec3 p[16];
    for (int i = 0; i < 4; i++) {
        p[i] = vec3_make(outer * side[i][0], outer * side[i][1], bottom);
        p[4 + i] = vec3_make(outer * side[i][0], outer * side[i][1], 0);
        p[8 + i] = vec3_make(inner * side[i][0], inner * side[i][1], bottom);
        p[12 + i] = vec3_make(inner * side[i][0], inner * side[i][1], 0);
    }
    add_points(&ctx, &m, p, 16);
    for (int32_t i = 0; i < 4; i++) {
        int32_t j = (i + 1) % 4;
        const int32_t quads[3][4] = {{i, j, 4 + j, 4 + i}, {8 + j, 8 + i, 12 + i, 12 + j}, {j, i, 8 + i, 8 + j}};
        for (int k = 0; k < 3; k++)
            ck_assert_int_eq(mesh_add_polygon(&ctx, &m, quads[k], 4), FRAM_OK);
    }
    mesh_rims rims = {0};
    int32_t edge;
    fram_error error = {0};
    ck_assert_int_eq(mesh_rims_find(&ctx, &m, &rims, &edge), FRAM_OK);
    ck_assert_int_eq(mesh_rims_count(&rims), 2);
    assert_ok(mesh_raise_top(&ctx, &m, &rims, 1.5, &error), error);
    check_closed(&ctx, &m);
    assert_relative(mesh_solid_properties(&m).volume, (36 - 4) * 3.5, 1e-14);
    mesh_rims_free(&ctx, &rims);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(crossing_tops_are_refused)
{
    context ctx = plain_context();
    mesh m = {0};
    /* A pentagram. */
    const double x[] = {0, 3, -5, 5, -3}, y[] = {5, -4, 2, 2, -4};
    mesh_rims rims = {0};
    fram_error error = {0};
    ck_assert(array_push(&ctx, &rims.start, 0) && array_push(&ctx, &rims.start, 5));
    for (int32_t i = 4; i >= 0; i--) {
        add_points(&ctx, &m, (const vec3[]){{x[i], y[i], 0}}, 1);
        ck_assert(array_push(&ctx, &rims.vertex, 4 - i));
    }
    assert_fails(mesh_raise_top(&ctx, &m, &rims, 1, &error), error, FRAM_ERROR_INPUT, "crosses itself");
    mesh_rims_free(&ctx, &rims);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(polygons)
{
    context ctx = plain_context();
    mesh m = {0};
    /* A quadrilateral with a dent has one sound diagonal; a bow tie has none. */
    add_points(&ctx, &m, (const vec3[]){{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}, {3, 2, 0}}, 5);
    ck_assert_int_eq(mesh_add_polygon(&ctx, &m, (const int32_t[]){0, 1, 2, 3}, 4), FRAM_OK);
    ck_assert_int_eq(m.face.count, 2);
    for (int32_t f = 0; f < 2; f++)
        ck_assert(mesh_area_vector(&m, f).z > 0);
    ck_assert_int_eq(mesh_add_polygon(&ctx, &m, (const int32_t[]){0, 1, 3, 4}, 4), FRAM_ERROR_INPUT);
    ck_assert_int_eq(mesh_add_polygon(&ctx, &m, (const int32_t[]){0, 1}, 2), FRAM_ERROR_INPUT);
    ck_assert_int_eq(m.face.count, 2);
    mesh_clear(&m);
    /* A comb in the plane x = y, seen from both sides; the straight rows are straight to the last digit but one, which
       must not make triangles without area. */
    enum { TEETH = 6, COUNT = 4 * TEETH };
    int32_t ring[COUNT], turned[COUNT];
    for (int i = 0; i < COUNT; i++) {
        double along = i < 3 * TEETH ? 0.1 * i : 0.3 * (COUNT - i), up = i < 3 * TEETH ? 1.1 * (i % 3 != 1) : 7.0;
        ck_assert(mesh_add_vertex(&ctx, &m, vec3_make(along, along, up + 1e-17 * i)));
        ring[i] = i;
        turned[COUNT - 1 - i] = i;
    }
    ck_assert_int_eq(mesh_add_polygon(&ctx, &m, ring, COUNT), FRAM_OK);
    ck_assert_int_eq(m.face.count, COUNT - 2);
    ck_assert_int_eq(mesh_add_polygon(&ctx, &m, turned, COUNT), FRAM_OK);
    vec3 sum = {0, 0, 0};
    for (int32_t f = 0; f < m.face.count; f++) {
        sum = vec3_add(sum, mesh_area_vector(&m, f));
        ck_assert(vec3_length(mesh_area_vector(&m, f)) > 1e-3);
    }
    assert_vec3_close(sum, vec3_make(0, 0, 0), 1e-14);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(triangles_are_turned)
{
    context ctx = plain_context();
    for (unsigned pattern = 0; pattern < 4096; pattern += 37) {
        mesh m = {0};
        int32_t flipped, face;
        ck_assert(mesh_make_box(&ctx, vec3_make(0, 0, 0), vec3_make(4, 2, 1), &m));
        int turned = 0;
        for (int32_t f = 0; f < 12; f++)
            if (pattern >> f & 1) {
                int32_t *v = m.face.data[f].v, swap = v[0];
                v[0] = v[1];
                v[1] = swap;
                turned++;
            }
        ck_assert_int_eq(mesh_orient(&ctx, &m, &flipped, &face), FRAM_OK);
        check_closed(&ctx, &m);
        assert_relative(mesh_solid_properties(&m).volume, 8, 1e-15);
        /* From the first triangle, and back if that was the wrong one. */
        ck_assert_int_eq(flipped, pattern & 1 ? 12 - turned + 12 : turned);
        mesh_free(&ctx, &m);
    }
}
END_TEST

/* A box inside a box is a cavity; both are given outward. */
START_TEST(cavities_are_turned_inward)
{
    context ctx = plain_context();
    mesh m = {0}, hole = {0};
    int32_t flipped, face;
    ck_assert(mesh_make_box(&ctx, vec3_make(0, 0, 0), vec3_make(4, 2, 1), &m));
    ck_assert(mesh_make_box(&ctx, vec3_make(1, 0.5, 0.25), vec3_make(2, 1.5, 0.75), &hole));
    for (int32_t v = 0; v < 8; v++)
        ck_assert(mesh_add_vertex(&ctx, &m, hole.vertex.data[v]));
    for (int32_t f = 0; f < 12; f++) {
        const int32_t *v = hole.face.data[f].v;
        ck_assert(mesh_add_triangle(&ctx, &m, 8 + v[0], 8 + v[1], 8 + v[2]));
    }
    ck_assert_int_eq(mesh_orient(&ctx, &m, &flipped, &face), FRAM_OK);
    ck_assert_int_eq(flipped, 12);
    check_closed(&ctx, &m);
    assert_relative(mesh_solid_properties(&m).volume, 8 - 0.5, 1e-15);
    mesh_free(&ctx, &m);
    mesh_free(&ctx, &hole);
}
END_TEST

START_TEST(moebius_bands_are_refused)
{
    context ctx = plain_context();
    mesh m = {0};
    int32_t flipped, face;
    /* Five triangles around five points, each with the next two. */
    for (int i = 0; i < 5; i++)
        add_points(&ctx, &m, (const vec3[]){{i, i * i, i * i * i}}, 1);
    for (int32_t i = 0; i < 5; i++)
        ck_assert(mesh_add_triangle(&ctx, &m, i, (i + 1) % 5, (i + 2) % 5));
    ck_assert_int_eq(mesh_orient(&ctx, &m, &flipped, &face), FRAM_ERROR_INPUT);
    ck_assert_int_ge(face, 0);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        context ctx = plain_context();
        mesh m = cracked_box(&ctx, 4, 0.02);
        mesh copy = {0};
        int32_array source = {0};
        mesh_rims rims = {0};
        mesh_seal_report report;
        int32_t edge, flipped, face;
        turn.status = mesh_copy(&turn.ctx, &copy, &m) ? FRAM_OK : FRAM_ERROR_MEMORY;
        if (turn.status == FRAM_OK)
            turn.status = mesh_seal(&turn.ctx, &copy, 0.05, &source, &report);
        if (turn.status == FRAM_OK && !mesh_drop_unused_vertices(&turn.ctx, &copy))
            turn.status = FRAM_ERROR_MEMORY;
        if (turn.status == FRAM_OK) {
            copy.face.count -= 8; /* a hole in the sealed top */
            turn.status = mesh_rims_find(&turn.ctx, &copy, &rims, &edge);
        }
        if (turn.status == FRAM_OK)
            turn.status = mesh_raise_top(&turn.ctx, &copy, &rims, 1, &turn.error);
        if (turn.status == FRAM_OK)
            turn.status = mesh_orient(&turn.ctx, &copy, &flipped, &face);
        mesh_free(&turn.ctx, &copy);
        mesh_rims_free(&turn.ctx, &rims);
        array_free(&turn.ctx, &source);
        mesh_free(&ctx, &m);
        if (turn.status != FRAM_ERROR_MEMORY)
            turn.status = FRAM_OK; /* or the hole is told */
    }
}
END_TEST

TEST_MAIN("mesh_repair", cracks_are_closed, wider_cracks_stay, both_sides_are_divided, holes_are_filled,
          rims_that_touch, tops_are_raised, crossing_tops_are_refused, polygons, triangles_are_turned,
          cavities_are_turned_inward, moebius_bands_are_refused, memory_runs_out)

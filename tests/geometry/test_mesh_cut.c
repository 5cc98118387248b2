/* Level sections and solids cut by planes. */
#include "geometry/mesh_clip.h"
#include "mesh_samples.h"

static const vec2 l_shape[6] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

static context plain(void)
{
    context ctx;
    context_init(&ctx);
    return ctx;
}

/* Rings of the section and the sum of their areas. */
static double section_area(context *ctx, const mesh *m, double level, int32_t rings)
{
    polygon_list list = {0};
    fram_error error;
    assert_ok(mesh_section(ctx, m, level, &list, &error), error);
    ck_assert_int_eq(polygon_list_count(&list), rings);
    double area = 0;
    for (int32_t i = 0; i < rings; i++)
        area += polygon_area(polygon_list_get(&list, i));
    polygon_list_free(ctx, &list);
    return area;
}

START_TEST(sections_of_a_box)
{
    context ctx = plain();
    mesh m = {0};
    ck_assert(mesh_make_box(&ctx, (vec3){-1, 0, 1}, (vec3){2, 2, 4}, &m));
    assert_relative(section_area(&ctx, &m, 2.3, 1), 6, 1e-15);
    assert_relative(section_area(&ctx, &m, 4, 1), 6, 1e-15); /* the top counts as above */
    section_area(&ctx, &m, 1, 0);                            /* and so does the bottom */
    section_area(&ctx, &m, 4.5, 0);
    section_area(&ctx, &m, 0.5, 0);
    polygon_list list = {0};
    fram_error error;
    assert_ok(mesh_section(&ctx, &m, 4, &list, &error), error);
    ck_assert_int_eq(polygon_list_get(&list, 0).count, 4); /* the corners once, no diagonals */
    polygon_list_free(&ctx, &list);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(sections_with_holes_and_parts)
{
    context ctx = plain();
    mesh m = {0};
    sample_frame_mesh(&ctx, &m);
    mesh_report report;
    ck_assert_int_eq(mesh_check(&ctx, &m, true, &report), FRAM_OK);
    ck_assert_msg(report.defect == MESH_CLOSED, "%s", report.text);
    assert_relative(section_area(&ctx, &m, 0.5, 2), 12, 1e-15);
    assert_relative(section_area(&ctx, &m, 1, 2), 12, 1e-15);
    /* Upright, the frame is cut into two legs. */
    sample_move(&m, quat_from_roll_pitch_yaw(PI / 2, 0, 0), (vec3){0, 0, 0});
    assert_relative(section_area(&ctx, &m, 0.1, 2), 2, 1e-15);
    assert_relative(section_area(&ctx, &m, 1.5, 1), 4, 1e-15);
    mesh_free(&ctx, &m);
}
END_TEST

/* Vertices exactly on the level, of every kind: a tip up, a tip down, ridges. */
START_TEST(levels_through_vertices)
{
    context ctx = plain();
    mesh m = {0};
    sample_sphere sphere = {9, 8, 1};
    sample_surface(&ctx, 9, 8, sample_sphere_point, &sphere, &m);
    for (int32_t i = 0; i < m.vertex.count; i++) {
        double level = m.vertex.data[i].z;
        polygon_list list = {0};
        fram_error error;
        assert_ok(mesh_section(&ctx, &m, level, &list, &error), error);
        double lower = 0, upper = 0, area = 0;
        for (int32_t k = 0; k < polygon_list_count(&list); k++)
            area += polygon_area(polygon_list_get(&list, k));
        ck_assert_int_le(polygon_list_count(&list), 1);
        polygon_list_clear(&list);
        assert_ok(mesh_section(&ctx, &m, level - 1e-9, &list, &error), error);
        for (int32_t k = 0; k < polygon_list_count(&list); k++)
            lower += polygon_area(polygon_list_get(&list, k));
        polygon_list_clear(&list);
        assert_ok(mesh_section(&ctx, &m, level + 1e-9, &list, &error), error);
        for (int32_t k = 0; k < polygon_list_count(&list); k++)
            upper += polygon_area(polygon_list_get(&list, k));
        assert_absolute(area, lower, 1e-7);
        assert_absolute(area, upper, 1e-7);
        polygon_list_free(&ctx, &list);
    }
    /* Two tips at one point: their edges give nothing. */
    mesh_clear(&m);
    ck_assert(mesh_make_box(&ctx, (vec3){-1, -1, -2}, (vec3){1, 1, -1}, &m));
    for (int i = 4; i < 8; i++)
        m.vertex.data[i] = (vec3){m.vertex.data[i].x * (i < 6 ? 1 : 0.5), 0, 0}; /* a roof with its ridge at 0 */
    section_area(&ctx, &m, 0, 0);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(open_and_turned_surfaces_are_refused)
{
    context ctx = plain();
    mesh m = {0};
    mesh_adjacency a = {0};
    polygon_list list = {0};
    fram_error error;
    ck_assert(mesh_make_box(&ctx, (vec3){0, 0, 0}, (vec3){1, 1, 1}, &m));
    m.face.count = 11;
    assert_fails(mesh_section(&ctx, &m, 0.5, &list, &error), error, FRAM_ERROR_INPUT, "not closed");
    ck_assert_int_eq(polygon_list_count(&list), 0);
    m.face.count = 12;
    m.face.data[4] = (triangle){{0, 5, 1}};
    assert_fails(mesh_section(&ctx, &m, 0.5, &list, &error), error, FRAM_ERROR_INPUT, "turns over");
    mesh out = {0};
    ck_assert_int_eq(mesh_adjacency_build(&ctx, &m, &a), FRAM_OK);
    assert_fails(mesh_clip(&ctx, &m, &a, (vec3){0, 0, 1}, 0.5, 0, &out, &error), error, FRAM_ERROR_INPUT, "turns over");
    ck_assert_int_eq(out.vertex.count, 0);
    mesh_free(&ctx, &out);
    mesh_adjacency_free(&ctx, &a);
    polygon_list_free(&ctx, &list);
    mesh_free(&ctx, &m);
}
END_TEST

/* Cuts m both ways: both parts are closed manifolds, on their side, and their volumes and first moments make up the
   whole. sound: they are also free of flat triangles and of touches. */
static void cut_both_ways(context *ctx, const mesh *m, vec3 n, double d, double snap, bool sound)
{
    mesh_adjacency a = {0};
    mesh low = {0}, high = {0};
    fram_error error;
    mesh_report report;
    ck_assert_int_eq(mesh_adjacency_build(ctx, m, &a), FRAM_OK);
    assert_ok(mesh_clip(ctx, m, &a, n, d, snap, &low, &error), error);
    assert_ok(mesh_clip(ctx, m, &a, vec3_neg(n), -d, snap, &high, &error), error);
    const mesh *part[2] = {&low, &high};
    solid_properties whole = mesh_solid_properties(m);
    double volume = 0;
    vec3 moment = {0, 0, 0};
    for (int i = 0; i < 2; i++) {
        if (part[i]->face.count == 0)
            continue;
        ck_assert_int_eq(mesh_adjacency_build(ctx, part[i], &a), FRAM_OK);
        for (int32_t h = 0; h < a.neighbour.count; h++)
            ck_assert_int_ge(a.neighbour.data[h], 0);
        ck_assert_int_eq(mesh_check(ctx, part[i], true, &report), FRAM_OK);
        ck_assert_msg(report.defect == MESH_CLOSED || !sound, "part %d: %s", i, report.text);
        solid_properties p = mesh_solid_properties(part[i]);
        ck_assert_double_gt(p.volume, -1e-12);
        volume += p.volume;
        moment = vec3_mad(moment, p.centre, p.volume);
        for (int32_t v = 0; v < part[i]->vertex.count; v++) {
            double side = vec3_dot(n, part[i]->vertex.data[v]) - d;
            ck_assert_double_le(i ? -side : side, fmax(snap, 1e-12));
        }
    }
    assert_relative(volume, whole.volume, 1e-12);
    assert_vec3_close(vec3_scale(moment, 1 / volume), whole.centre, 1e-12);
    mesh_free(ctx, &low);
    mesh_free(ctx, &high);
    mesh_adjacency_free(ctx, &a);
}

START_TEST(cuts_through_anywhere)
{
    context ctx = plain();
    fram_error error;
    mesh solid[3];
    memset(solid, 0, sizeof solid);
    sample_sphere_mesh(&ctx, 7, 9, 1, &solid[0]);
    assert_ok(mesh_make_prism(&ctx, (polygon){l_shape, 6}, 0, 1, &solid[1], &error), error);
    sample_frame_mesh(&ctx, &solid[2]);
    random_stream r = random_begin(7, 7, 0);
    for (int i = 0; i < 300; i++) {
        vec3 n = vec3_unit((vec3){random_normal(&r), random_normal(&r), random_normal(&r)});
        vec3 at = {random_uniform(&r, -1, 1), random_uniform(&r, -1, 1), random_uniform(&r, 0, 1)};
        /* Flat sides give caps with straight vertices, the frame gives some with holes. */
        cut_both_ways(&ctx, &solid[i % 3], n, vec3_dot(n, at), 0, false);
    }
    cut_both_ways(&ctx, &solid[2], (vec3){0, 0, 1}, 0.5, 0, false);
    for (int i = 0; i < 3; i++)
        mesh_free(&ctx, &solid[i]);
}
END_TEST

/* Planes through three vertices, along sides, along edges. */
START_TEST(cuts_through_vertices)
{
    context ctx = plain();
    fram_error error;
    mesh solid[3];
    memset(solid, 0, sizeof solid);
    sample_sphere_mesh(&ctx, 5, 6, 1, &solid[0]);
    assert_ok(mesh_make_prism(&ctx, (polygon){l_shape, 6}, 0, 1, &solid[1], &error), error);
    sample_frame_mesh(&ctx, &solid[2]);
    random_stream r = random_begin(8, 7, 0);
    for (int i = 0; i < 600; i++) {
        const mesh *m = &solid[i % 3];
        vec3 p[3];
        for (int k = 0; k < 3; k++)
            p[k] = m->vertex.data[(int32_t)random_uniform(&r, 0, m->vertex.count)];
        vec3 n = vec3_unit(vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0])));
        if (vec3_dot(n, n) > 0)
            cut_both_ways(&ctx, m, n, vec3_dot(n, p[0]), 1e-12, false);
    }
    cut_both_ways(&ctx, &solid[1], (vec3){1, 0, 0}, 1, 0, true);
    cut_both_ways(&ctx, &solid[1], (vec3){0, 1, 0}, 1, 0, true);
    cut_both_ways(&ctx, &solid[1], (vec3){0, 0, 1}, 1, 0, true);  /* all of it and nothing */
    cut_both_ways(&ctx, &solid[1], (vec3){1, 1, 0}, 2, 0, false); /* touches at the reflex corner */
    for (int i = 0; i < 3; i++)
        mesh_free(&ctx, &solid[i]);
}
END_TEST

START_TEST(memory_runs_out)
{
    context ctx = plain();
    mesh m = {0};
    sample_frame_mesh(&ctx, &m);
    for (failing_turn turn = {0}; failing_next(&turn);) {
        polygon_list list = {0};
        mesh_adjacency a = {0};
        mesh out = {0};
        turn.status = mesh_section(&turn.ctx, &m, 0.5, &list, &turn.error);
        if (turn.status == FRAM_OK) {
            turn.status = mesh_adjacency_build(&turn.ctx, &m, &a);
            turn.error.status = turn.status;
        }
        if (turn.status == FRAM_OK)
            turn.status = mesh_clip(&turn.ctx, &m, &a, (vec3){0.1, 0.2, 1}, 0.5, 0, &out, &turn.error);
        polygon_list_free(&turn.ctx, &list);
        mesh_adjacency_free(&turn.ctx, &a);
        mesh_free(&turn.ctx, &out);
        ck_assert_int_eq(turn.error.status, turn.status);
    }
    mesh_free(&ctx, &m);
}
END_TEST

TEST_MAIN("mesh_cut", sections_of_a_box, sections_with_holes_and_parts, levels_through_vertices,
          open_and_turned_surfaces_are_refused, cuts_through_anywhere, cuts_through_vertices, memory_runs_out)

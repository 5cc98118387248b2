#include "geometry/polyhedron.h"
#include "mesh_samples.h"

static const vec2 l_shape[6] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
static const vec2 u_shape[8] = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 4}, {0, 4}};

static context plain(void)
{
    context ctx;
    context_init(&ctx);
    return ctx;
}

static double union_volume(const polyhedron_array *pieces)
{
    double volume = 0;
    for (int32_t i = 0; i < pieces->count; i++)
        volume += polyhedron_volume(&pieces->data[i]);
    return volume;
}

/* Every vertex of the mesh is in a piece. */
static void assert_covered(const mesh *m, const polyhedron_array *pieces, double margin)
{
    for (int32_t v = 0; v < m->vertex.count; v++) {
        bool found = false;
        for (int32_t i = 0; i < pieces->count && !found; i++)
            found = polyhedron_contains(&pieces->data[i], m->vertex.data[v], margin);
        ck_assert_msg(found, "vertex %d is in no piece", v);
    }
}

static void assert_pieces(context *ctx, const mesh *m, double tolerance, int32_t count, double volume)
{
    polyhedron_array pieces = {0};
    fram_error error;
    double concavity;
    assert_ok(mesh_convex_pieces(ctx, m, tolerance, 20, &pieces, &concavity, &error), error);
    ck_assert_int_eq(pieces.count, count);
    ck_assert_double_le(concavity, tolerance);
    assert_relative(union_volume(&pieces), volume, 1e-9);
    assert_covered(m, &pieces, 1e-6);
    polyhedron_array_free(ctx, &pieces);
}

START_TEST(a_convex_body_is_one_piece)
{
    context ctx = plain();
    mesh m = {0};
    polyhedron_array pieces = {0};
    fram_error error;
    double concavity;
    ck_assert(mesh_make_box(&ctx, (vec3){-5, -2, -1}, (vec3){5, 2, 1}, &m));
    assert_ok(mesh_convex_pieces(&ctx, &m, 0, 20, &pieces, &concavity, &error), error);
    ck_assert_int_eq(pieces.count, 1);
    ck_assert_int_eq(pieces.data[0].face.count, 6);
    ck_assert(concavity == 0);
    assert_relative(union_volume(&pieces), 80, 1e-15);
    polyhedron_array_free(&ctx, &pieces);
    mesh_clear(&m);
    sample_sphere_mesh(&ctx, 20, 20, 1, &m);
    assert_pieces(&ctx, &m, 1e-9, 1, mesh_solid_properties(&m).volume);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(notched_bodies_are_cut_at_the_notch)
{
    context ctx = plain();
    mesh m = {0};
    fram_error error;
    for (int turned = 0; turned < 4; turned++) {
        quat q = quat_unit((quat){1, turned > 1 ? 0.4 : 0, turned > 2 ? -0.3 : 0, turned > 0 ? 0.3 : 0});
        vec3 shift = {100.0 * turned, 0, -7};
        assert_ok(mesh_make_prism(&ctx, (polygon){l_shape, 6}, 0, 1, &m, &error), error);
        sample_move(&m, q, shift);
        assert_pieces(&ctx, &m, 0.01, 2, 3);
        assert_ok(mesh_make_prism(&ctx, (polygon){u_shape, 8}, 0, 1, &m, &error), error);
        sample_move(&m, q, shift);
        assert_pieces(&ctx, &m, 0.01, 3, 8);
    }
    mesh_free(&ctx, &m);
}
END_TEST

/* One face of either piece of an L lies on the cut, and both know how near they lie to each other. */
START_TEST(faces_on_cuts_are_told_apart)
{
    context ctx = plain();
    mesh m = {0};
    polyhedron_array pieces = {0};
    fram_error error;
    double concavity;
    assert_ok(mesh_make_prism(&ctx, (polygon){l_shape, 6}, 0, 1, &m, &error), error);
    for (int32_t most = 1; most <= 2; most++) {
        assert_ok(mesh_convex_pieces(&ctx, &m, 0.01, most, &pieces, &concavity, &error), error);
        ck_assert_int_eq(pieces.count, most);
        for (int32_t i = 0; i < most; i++) {
            int32_t on_cut = 0;
            polyhedron *p = &pieces.data[i];
            for (int32_t k = 0; k < p->face.count; k++)
                on_cut += p->face.data[k].on_cut;
            ck_assert_int_eq(on_cut, most - 1);
            ck_assert(most == 1 ? !(p->seam > 0) : p->seam > 0 && p->seam < 0.01);
        }
    }
    polyhedron_array_free(&ctx, &pieces);
    mesh_free(&ctx, &m);
}
END_TEST

/* A ring of four beams; one cut too early makes a few pieces more. */
START_TEST(a_frame_is_cut_into_beams)
{
    context ctx = plain();
    mesh m = {0};
    for (int turned = 0; turned < 3; turned++) {
        polyhedron_array pieces = {0};
        fram_error error;
        double concavity;
        mesh_clear(&m);
        sample_frame_mesh(&ctx, &m);
        sample_move(&m, (quat){1, 0.2 * turned, 0.1 * turned, -0.3 * turned}, (vec3){100.0 * turned, 0, 0});
        assert_ok(mesh_convex_pieces(&ctx, &m, 0.01, 20, &pieces, &concavity, &error), error);
        ck_assert_int_ge(pieces.count, 4);
        ck_assert_int_le(pieces.count, turned ? 8 : 4);
        ck_assert_double_le(concavity, 0.01);
        assert_relative(union_volume(&pieces), 12, 1e-9);
        assert_covered(&m, &pieces, 1e-6);
        polyhedron_array_free(&ctx, &pieces);
    }
    mesh_free(&ctx, &m);
}
END_TEST

/* How deep an L is before it is cut: its reflex corner lies sqrt(1/2) under the hull's slant. */
START_TEST(the_limit_leaves_concavity)
{
    context ctx = plain();
    mesh m = {0};
    polyhedron_array pieces = {0};
    fram_error error;
    double concavity;
    assert_ok(mesh_make_prism(&ctx, (polygon){l_shape, 6}, 0, 3, &m, &error), error);
    assert_ok(mesh_convex_pieces(&ctx, &m, 0.01, 1, &pieces, &concavity, &error), error);
    ck_assert_int_eq(pieces.count, 1);
    assert_relative(concavity, sqrt(0.5), 1e-12);
    assert_relative(union_volume(&pieces), 3.5 * 3, 1e-12);
    /* Deeper than the tolerance only. */
    assert_ok(mesh_convex_pieces(&ctx, &m, 0.71, 20, &pieces, &concavity, &error), error);
    ck_assert_int_eq(pieces.count, 1);
    assert_ok(mesh_convex_pieces(&ctx, &m, 0.70, 20, &pieces, &concavity, &error), error);
    ck_assert_int_eq(pieces.count, 2);
    ck_assert_double_le(concavity, 1e-9);
    polyhedron_array_free(&ctx, &pieces);
    mesh_free(&ctx, &m);
}
END_TEST

/* A place in the middle of a large triangle: two tetrahedra of one edge, the valley between, make the deepest place no
   vertex. */
START_TEST(deep_places_between_vertices)
{
    context ctx = plain();
    mesh m = {0};
    polyhedron_array pieces = {0};
    fram_error error;
    double concavity;
    ck_assert(mesh_make_box(&ctx, (vec3){0, 0, -3}, (vec3){4, 4, 1}, &m));
    /* The top's diagonal from 4 to 7 becomes a valley: 5 and 6 are lifted. */
    m.vertex.data[5].z = m.vertex.data[6].z = 3;
    assert_ok(mesh_convex_pieces(&ctx, &m, 0.1, 1, &pieces, &concavity, &error), error);
    /* The hull's ridge from 5 to 6 stands 2 above the middle of the valley, between its slopes, z = 1 + (x + y) / 2 and
       the other. */
    assert_relative(concavity, 2 * sqrt(2.0 / 3), 0.02);
    assert_ok(mesh_convex_pieces(&ctx, &m, 0.1, 20, &pieces, &concavity, &error), error);
    ck_assert_int_le(pieces.count, 4);
    ck_assert_double_le(concavity, 0.1);
    polyhedron_array_free(&ctx, &pieces);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(bodies_apart_and_cavities)
{
    context ctx = plain();
    mesh m = {0}, box = {0};
    polyhedron_array pieces = {0};
    fram_error error;
    double concavity;
    ck_assert(mesh_make_box(&ctx, (vec3){0, 0, 0}, (vec3){1, 1, 1}, &box));
    for (int i = 0; i < 3; i++)
        sample_append(&ctx, &m, &box, (vec3){2.0 * i, 0, 0});
    assert_ok(mesh_convex_pieces(&ctx, &m, 0.01, 1, &pieces, &concavity, &error), error);
    ck_assert_int_eq(pieces.count, 3);
    assert_relative(union_volume(&pieces), 3, 1e-15);
    ck_assert(mesh_make_box(&ctx, (vec3){0.2, 0.2, 0.2}, (vec3){0.8, 0.8, 0.8}, &box));
    for (int32_t f = 0; f < box.face.count; f++) {
        int32_t swap = box.face.data[f].v[0];
        box.face.data[f].v[0] = box.face.data[f].v[1];
        box.face.data[f].v[1] = swap;
    }
    sample_append(&ctx, &m, &box, (vec3){0, 0, 0});
    assert_ok(mesh_convex_pieces(&ctx, &m, 0.01, 1, &pieces, &concavity, &error), error);
    ck_assert_int_eq(pieces.count, 3);
    assert_relative(union_volume(&pieces), 3, 1e-15);
    polyhedron_array_free(&ctx, &pieces);
    mesh_free(&ctx, &box);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(a_hull_with_bulb_and_flare)
{
    static const struct {
        int32_t stations, around;
        double tolerance;
        int32_t most;
    } cases[] = {{8, 7, 1.5, 20}, {50, 35, 1, 20}, {50, 35, 0.5, 40}};
    context ctx = plain();
    for (int i = 0; i < 3; i++) {
        mesh m = {0};
        mesh_report report;
        polyhedron_array pieces = {0};
        fram_error error;
        double concavity;
        sample_hull_mesh(&ctx, cases[i].stations, cases[i].around, &m);
        ck_assert_int_eq(mesh_check(&ctx, &m, true, &report), FRAM_OK);
        ck_assert_msg(report.defect == MESH_CLOSED, "%s", report.text);
        double volume = mesh_solid_properties(&m).volume;
        assert_ok(mesh_convex_pieces(&ctx, &m, cases[i].tolerance, cases[i].most, &pieces, &concavity, &error), error);
        ck_assert_int_gt(pieces.count, 1);
        ck_assert_int_le(pieces.count, cases[i].most);
        if (pieces.count < cases[i].most)
            ck_assert_double_le(concavity, cases[i].tolerance);
        ck_assert_double_le(concavity, 1.5 * cases[i].tolerance);
        /* The pieces cover the hull and little else. */
        assert_covered(&m, &pieces, 0.05 * cases[i].tolerance);
        ck_assert_double_ge(union_volume(&pieces), volume);
        ck_assert_double_le(union_volume(&pieces), 1.02 * volume);
        polyhedron_array_free(&ctx, &pieces);
        mesh_free(&ctx, &m);
    }
}
END_TEST

/* Bodies as rough as no ship is: every vertex of a sphere at a radius of its own, some on a lattice. */
START_TEST(rough_bodies)
{
    context ctx = plain();
    for (int i = 0; i < 30; i++) {
        mesh m = {0};
        mesh_report report;
        polyhedron_array pieces = {0};
        fram_error error;
        double concavity, volume;
        int32_t joined;
        random_stream r = random_begin(77, 1, (uint32_t)i);
        double rough = random_uniform(&r, 0.1, 0.6), tolerance = random_uniform(&r, 0.3, 2);
        sample_sphere_mesh(&ctx, 4 + i % 7, 4 + i % 11, 10, &m);
        for (int32_t v = 0; v < m.vertex.count; v++) {
            vec3 p = vec3_scale(m.vertex.data[v], 1 - rough * random_unit(&r));
            m.vertex.data[v] = i % 3 ? p : (vec3){floor(p.x), floor(p.y), floor(p.z)};
        }
        ck_assert_int_eq(mesh_weld(&ctx, &m, 0, &joined), FRAM_OK);
        ck_assert_int_eq(mesh_check(&ctx, &m, true, &report), FRAM_OK);
        if (report.defect == MESH_CLOSED) {
            volume = mesh_solid_properties(&m).volume;
            assert_ok(mesh_convex_pieces(&ctx, &m, tolerance, 40, &pieces, &concavity, &error), error);
            ck_assert(pieces.count >= 40 || concavity <= tolerance);
            ck_assert_double_ge(union_volume(&pieces), volume * (1 - 1e-3));
            ck_assert_double_le(union_volume(&pieces), volume * 1.8);
            assert_covered(&m, &pieces, 0.06 * tolerance);
        }
        polyhedron_array_free(&ctx, &pieces);
        mesh_free(&ctx, &m);
    }
}
END_TEST

/* Four times the size and the tolerance: four times the same pieces, to the bit. */
START_TEST(size_does_not_matter)
{
    context ctx = plain();
    mesh m = {0};
    polyhedron_array pieces[2] = {{.count = 0}, {.count = 0}};
    fram_error error;
    double concavity[2];
    sample_hull_mesh(&ctx, 20, 11, &m);
    for (int k = 0; k < 2; k++) {
        assert_ok(mesh_convex_pieces(&ctx, &m, k ? 4 : 1, 12, &pieces[k], &concavity[k], &error), error);
        for (int32_t i = 0; i < m.vertex.count; i++)
            m.vertex.data[i] = vec3_scale(m.vertex.data[i], 4);
    }
    assert_bits(4 * concavity[0], concavity[1]);
    ck_assert_int_eq(pieces[0].count, pieces[1].count);
    for (int32_t i = 0; i < pieces[0].count; i++) {
        const polyhedron *p = &pieces[0].data[i], *q = &pieces[1].data[i];
        ck_assert_int_eq(p->vertex.count, q->vertex.count);
        ck_assert_int_eq(p->face.count, q->face.count);
        ck_assert_int_eq(p->edge_direction.count, q->edge_direction.count);
        for (int32_t v = 0; v < p->vertex.count; v++) {
            vec3 scaled = vec3_scale(p->vertex.data[v], 4);
            assert_array_bits(&scaled.x, &q->vertex.data[v].x, 3);
        }
    }
    for (int k = 0; k < 2; k++)
        polyhedron_array_free(&ctx, &pieces[k]);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(surfaces_that_are_no_solids)
{
    context ctx = plain();
    mesh m = {0};
    polyhedron_array pieces = {0};
    fram_error error;
    double concavity;
    assert_fails(mesh_convex_pieces(&ctx, &m, 0.1, 9, &pieces, &concavity, &error), error, FRAM_ERROR_INPUT,
                 "no volume");
    ck_assert(mesh_make_box(&ctx, (vec3){0, 0, 0}, (vec3){1, 1, 1}, &m));
    m.face.count = 11;
    assert_fails(mesh_convex_pieces(&ctx, &m, 0.1, 9, &pieces, &concavity, &error), error, FRAM_ERROR_INPUT,
                 "not closed");
    ck_assert_int_eq(pieces.count, 0);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(memory_runs_out)
{
    context ctx = plain();
    mesh m = {0};
    fram_error error;
    assert_ok(mesh_make_prism(&ctx, (polygon){l_shape, 6}, 0, 3, &m, &error), error);
    for (failing_turn turn = {0}; failing_next(&turn);) {
        polyhedron_array pieces = {0};
        double concavity;
        turn.status = mesh_convex_pieces(&turn.ctx, &m, 0.01, 20, &pieces, &concavity, &turn.error);
        ck_assert_int_eq(turn.error.status, turn.status);
        ck_assert(turn.memory.failed ? pieces.count == 0 : turn.n > 100);
        polyhedron_array_free(&turn.ctx, &pieces);
    }
    mesh_free(&ctx, &m);
}
END_TEST

TEST_MAIN("mesh_convex_pieces", a_convex_body_is_one_piece, notched_bodies_are_cut_at_the_notch,
          faces_on_cuts_are_told_apart, a_frame_is_cut_into_beams, the_limit_leaves_concavity,
          deep_places_between_vertices, bodies_apart_and_cavities, a_hull_with_bulb_and_flare, rough_bodies,
          size_does_not_matter, surfaces_that_are_no_solids, memory_runs_out)

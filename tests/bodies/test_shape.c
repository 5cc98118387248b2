#include "base/transcendental.h"
#include "bodies/shape.h"
#include "testing.h"

static const vec2 square[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
static const vec2 corner[6] = {{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}};

static int32_t add(context *ctx, shape_store *s, overlay *o, const vec2 *vertex, int32_t count)
{
    int32_t row;
    fram_error e = {0};
    assert_ok(shape_add_prism(ctx, s, o, (polygon){vertex, count}, 0.5, 0, &row, &e), e);
    return row;
}

static double area_of_pieces(const shape_store *s, int32_t row)
{
    double sum = 0;
    for (int32_t i = 0; i < s->shapes.piece_count[row]; i++)
        sum += polygon_area(shape_piece(s, row, i));
    return sum;
}

START_TEST(a_convex_prism_is_its_own_piece)
{
    context ctx;
    context_init(&ctx);
    shape_store s = {0};
    int32_t row = add(&ctx, &s, NULL, square, 4);
    ck_assert_int_eq(s.shapes.kind[row], SHAPE_PRISM);
    ck_assert_int_eq(s.shapes.piece_count[row], 1);
    ck_assert_int_eq(s.vertices.count, 4);
    ck_assert(shape_piece(&s, row, 0).vertex == shape_outline(&s, row).vertex);
    ck_assert_uint_eq(s.pieces.inner_edges[s.shapes.piece_first[row]], 0);
    assert_absolute(s.shapes.area[row], 4, 0);
    assert_absolute(s.shapes.plan_radius[row], sqrt(2), 1e-15);
    assert_absolute(s.shapes.radius[row], 1.5, 1e-15);
    ck_assert_int_eq(s.shapes.solid[row], -1);
    shape_store_free(&ctx, &s);
}
END_TEST

START_TEST(many_corners_are_cut_into_small_pieces)
{
    enum { CORNERS = 50 };
    context ctx;
    context_init(&ctx);
    shape_store s = {0};
    vec2 round[CORNERS];
    for (int i = 0; i < CORNERS; i++)
        round[i] = vec2_make(5 * real_cos(2 * PI * i / CORNERS), 5 * real_sin(2 * PI * i / CORNERS));
    int32_t row = add(&ctx, &s, NULL, round, CORNERS), outer = 0;
    assert_relative(area_of_pieces(&s, row), s.shapes.area[row], 1e-14);
    for (int32_t i = 0; i < s.shapes.piece_count[row]; i++) {
        int32_t at = s.shapes.piece_first[row] + i;
        ck_assert_int_le(s.pieces.size[at], PIECE_MOST_VERTICES);
        ck_assert(polygon_is_convex(shape_piece(&s, row, i)));
        for (int32_t k = 0; k < s.pieces.size[at]; k++)
            outer += !(s.pieces.inner_edges[at] >> k & 1u);
    }
    ck_assert_int_eq(outer, CORNERS);
    shape_store_free(&ctx, &s);
}
END_TEST

START_TEST(a_concave_prism_knows_its_seams_and_corners)
{
    context ctx;
    context_init(&ctx);
    shape_store s = {0};
    overlay *o = overlay_create(&ctx);
    int32_t row = add(&ctx, &s, o, corner, 6), outer = 0, inner = 0;
    ck_assert_int_gt(s.shapes.piece_count[row], 1);
    assert_relative(area_of_pieces(&s, row), 64, 1e-14);
    for (int32_t i = 0; i < s.shapes.piece_count[row]; i++) {
        int32_t at = s.shapes.piece_first[row] + i;
        polygon p = shape_piece(&s, row, i);
        for (int32_t k = 0; k < p.count; k++) {
            int32_t c = s.vertices.corner[s.pieces.first[at] + k];
            int32_t next = s.vertices.corner[s.pieces.first[at] + (k + 1) % p.count];
            ck_assert(c >= 0 && p.vertex[k].x == corner[c].x && p.vertex[k].y == corner[c].y);
            bool seam = s.pieces.inner_edges[at] >> k & 1u;
            ck_assert(seam == ((c + 1) % 6 != next));
            *(seam ? &inner : &outer) += 1;
        }
    }
    ck_assert_int_eq(outer, 6);
    ck_assert_int_eq(inner, 2 * (s.shapes.piece_count[row] - 1));
    overlay_free(o);
    shape_store_free(&ctx, &s);
}
END_TEST

/* A notch whose triangle is under the limit of area: one piece is left, which has fewer corners than the outline, at
   their places, and with its own sides; so after the pools were squeezed. */
START_TEST(a_dropped_triangle_leaves_a_piece_of_its_own)
{
    static const vec2 notched[] = {{0, 0}, {4, 0}, {4, 4}, {1, 4}, {0.9, 3.5}};
    context ctx;
    context_init(&ctx);
    shape_store s = {0};
    overlay *o = overlay_create(&ctx);
    fram_error e = {0};
    int32_t row, others[3];
    for (int i = 0; i < 3; i++)
        others[i] = add(&ctx, &s, o, corner, 6);
    assert_ok(shape_add_prism(&ctx, &s, o, (polygon){notched, 5}, 0.5, 1, &row, &e), e);
    for (int squeezed = 0; squeezed < 2; squeezed++) {
        ck_assert_int_eq(s.shapes.piece_count[row], 1);
        ck_assert_int_eq(s.shapes.outline_count[row], 5);
        polygon p = shape_piece(&s, row, 0);
        int32_t first = s.pieces.first[s.shapes.piece_first[row]];
        ck_assert_int_lt(p.count, 5);
        for (int32_t k = 0; k < p.count; k++) {
            vec2 way = vec2_sub(p.vertex[k + 1 < p.count ? k + 1 : 0], p.vertex[k]), n = s.vertices.side[first + k];
            int32_t c = s.vertices.corner[first + k];
            ck_assert(c >= 0 && p.vertex[k].x == notched[c].x && p.vertex[k].y == notched[c].y);
            assert_absolute(vec2_dot(way, n), 0, 1e-12);
            ck_assert(vec2_cross(n, way) > 0);
        }
        for (int i = 0; i < 3; i++)
            shape_remove(&s, others[i]);
        assert_ok(shape_compact(&ctx, &s), e);
    }
    ck_assert_int_eq(s.vertices.count, 5 + shape_piece(&s, row, 0).count);
    overlay_free(o);
    shape_store_free(&ctx, &s);
}
END_TEST

START_TEST(wrong_outlines_are_refused)
{
    context ctx;
    context_init(&ctx);
    shape_store s = {0};
    int32_t row;
    fram_error e = {0};
    vec2 back[4] = {{-1, 1}, {1, 1}, {1, -1}, {-1, -1}};
    assert_fails(shape_add_prism(&ctx, &s, NULL, (polygon){square, 2}, 1, 0, &row, &e), e, FRAM_ERROR_INPUT,
                 "2 vertices");
    assert_fails(shape_add_prism(&ctx, &s, NULL, (polygon){back, 4}, 1, 0, &row, &e), e, FRAM_ERROR_INPUT,
                 "counter-clockwise");
    assert_fails(shape_add_prism(&ctx, &s, NULL, (polygon){square, 4}, 0, 0, &row, &e), e, FRAM_ERROR_INPUT,
                 "thickness");
    assert_fails(shape_add_prism(&ctx, &s, NULL, (polygon){corner, 6}, 1, 0, &row, &e), e, FRAM_ERROR_INPUT, "concave");
    assert_fails(shape_add_solid(&ctx, &s, 0, &row, &e), e, FRAM_ERROR_USAGE, "no solid 0");
    mesh none = {0};
    polyhedron_array pieces = {0};
    solid_array solids = {0};
    s.solids = &solids;
    assert_fails(shape_add_solid(&ctx, &s, 0, &row, &e), e, FRAM_ERROR_USAGE, "no solid 0");
    assert_fails(solid_add(&ctx, &solids, &none, &pieces, 0, &row, &e), e, FRAM_ERROR_INPUT, "empty");
    ck_assert_int_eq(s.shapes.count, 0);
    ck_assert_int_eq(s.vertices.count, 0);
    shape_store_free(&ctx, &s);
}
END_TEST

START_TEST(solids_take_over_their_mesh)
{
    context ctx;
    context_init(&ctx);
    solid_array solids = {0};
    shape_store s = {.solids = &solids};
    mesh box = {0};
    polyhedron_array pieces = {0};
    int32_t index, row;
    fram_error e = {0};
    ck_assert(mesh_make_box(&ctx, vec3_make(-2, -3, -6), vec3_make(2, 3, 1), &box));
    assert_ok(solid_add(&ctx, &solids, &box, &pieces, 0.25, &index, &e), e);
    ck_assert_int_eq(box.face.count, 0);
    assert_ok(shape_add_solid(&ctx, &s, index, &row, &e), e);
    assert_absolute(s.shapes.radius[row], 7, 1e-15);
    ck_assert_int_eq(s.shapes.solid[row], index);
    ck_assert_int_eq(shape_solid(&s, row)->surface.face.count, 12);
    ck_assert_int_eq(shape_solid(&s, row)->tree.face.count, 12);
    ck_assert_int_eq(shape_solid(&s, row)->adjacency.neighbour.count, 36);
    shape_store_free(&ctx, &s);
    solid_array_free(&ctx, &solids);
}
END_TEST

/* The corner that lies farthest out may be the last one. */
START_TEST(the_radius_of_a_solid_is_that_of_its_farthest_corner)
{
    context ctx;
    context_init(&ctx);
    for (int far = 0; far < 4; far++) {
        mesh m = {0};
        polyhedron_array pieces = {0};
        int32_t index;
        fram_error e = {0};
        vec3 v[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        v[far] = vec3_scale(vec3_add(v[far], vec3_make(-0.1, -0.1, -0.1)), 10);
        for (int i = 0; i < 4; i++)
            ck_assert(mesh_add_vertex(&ctx, &m, v[i]));
        ck_assert(mesh_add_triangle(&ctx, &m, 0, 2, 1) && mesh_add_triangle(&ctx, &m, 0, 1, 3) &&
                  mesh_add_triangle(&ctx, &m, 1, 2, 3) && mesh_add_triangle(&ctx, &m, 2, 0, 3));
        double radius = vec3_length(v[far]);
        solid_array solids = {0};
        assert_ok(solid_add(&ctx, &solids, &m, &pieces, 0, &index, &e), e);
        assert_absolute(solids.data[index].radius, radius > 1 ? radius : 1, 1e-14);
        solid_array_free(&ctx, &solids);
    }
}
END_TEST

/* The C library's memory, but what is given back is scrubbed, and every resize moves. */
static void *scrubbing_memory(void *user, void *old, size_t size)
{
    (void)user;
    /* The size stands before the block. */
    size_t had = 0;
    unsigned char *before = old ? (unsigned char *)old - 16 : NULL;
    if (before)
        memcpy(&had, before, sizeof had);
    unsigned char *block = size > 0 ? malloc(size + 16) : NULL;
    if (block) {
        memcpy(block, &size, sizeof size);
        if (before)
            memcpy(block + 16, old, had < size ? had : size);
    }
    if (before && (block || size == 0)) {
        memset(before, 0xff, had + 16);
        free(before);
    }
    return block ? block + 16 : NULL;
}

/* An outline may be one of the store's own, whose memory moves while the prism is made. */
START_TEST(an_outline_of_the_store_itself)
{
    context ctx;
    context_init(&ctx);
    ctx.memory = scrubbing_memory;
    shape_store s = {0};
    fram_error e = {0};
    int32_t row;
    assert_ok(shape_add_prism(&ctx, &s, NULL, (polygon){square, 4}, 0.5, 0, &row, &e), e);
    for (int k = 0; k < 40; k++) {
        assert_ok(shape_add_prism(&ctx, &s, NULL, shape_outline(&s, row), 0.5, 0, &row, &e), e);
        ck_assert(memcmp(shape_outline(&s, row).vertex, square, sizeof square) == 0);
        assert_relative(s.shapes.area[row], polygon_area((polygon){square, 4}), 1e-14);
    }
    shape_store_free(&ctx, &s);
}
END_TEST

START_TEST(rows_are_used_again_and_pools_squeezed)
{
    context ctx;
    context_init(&ctx);
    shape_store s = {0};
    overlay *o = overlay_create(&ctx);
    for (int i = 0; i < 30; i++)
        add(&ctx, &s, o, i % 3 ? square : corner, i % 3 ? 4 : 6);
    int32_t before = s.vertices.count;
    ck_assert_int_eq(shape_compact(&ctx, &s), FRAM_OK); /* counts, and follows from now on */
    ck_assert_int_eq(s.vertices.count, before);
    for (int32_t i = 0; i < 30; i++)
        if (i % 3 != 1 && i < 27)
            shape_remove(&s, i);
    ck_assert_int_eq(shape_compact(&ctx, &s), FRAM_OK);
    ck_assert_int_lt(s.vertices.count, before / 2);
    ck_assert_int_eq(s.live_vertices, s.vertices.count);
    ck_assert_int_eq(s.live_pieces, s.pieces.count);
    for (int32_t i = 0; i < 30; i++) {
        bool live = i % 3 == 1 || i >= 27;
        ck_assert_int_eq(s.shapes.kind[i], live ? SHAPE_PRISM : SHAPE_NONE);
        if (!live)
            continue;
        polygon outline = shape_outline(&s, i);
        const vec2 *expected = i % 3 ? square : corner;
        ck_assert_int_eq(outline.count, i % 3 ? 4 : 6);
        ck_assert(memcmp(outline.vertex, expected, (size_t)outline.count * sizeof *expected) == 0);
        assert_relative(area_of_pieces(&s, i), s.shapes.area[i], 1e-14);
    }
    int32_t after = s.vertices.count;
    ck_assert_int_eq(shape_compact(&ctx, &s), FRAM_OK);
    ck_assert_int_eq(s.vertices.count, after);
    ck_assert_int_eq(add(&ctx, &s, o, square, 4), 0);
    ck_assert_int_eq(s.live_vertices, s.vertices.count);
    /* An outline of the store itself, while its pool grows. */
    fram_error e = {0};
    for (int k = 0; k < 40; k++) {
        int32_t row;
        assert_ok(shape_add_prism(&ctx, &s, o, shape_outline(&s, 27), 0.5, 0, &row, &e), e);
        assert_relative(s.shapes.area[row], 64, 1e-14);
    }
    overlay_free(o);
    shape_store_free(&ctx, &s);
}
END_TEST

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        shape_store s = {0};
        solid_array solids = {0};
        int32_t row;
        overlay *o = overlay_create(&turn.ctx);
        turn.status =
            o ? shape_add_prism(&turn.ctx, &s, o, (polygon){corner, 6}, 1, 0, &row, &turn.error) : FRAM_ERROR_MEMORY;
        if (turn.status == FRAM_OK)
            turn.status = shape_add_prism(&turn.ctx, &s, o, (polygon){square, 4}, 1, 0, &row, &turn.error);
        if (turn.status == FRAM_OK) {
            shape_remove(&s, 0);
            turn.status = shape_compact(&turn.ctx, &s);
        }
        mesh box = {0};
        polyhedron_array pieces = {0};
        if (turn.status == FRAM_OK)
            turn.status =
                mesh_make_box(&turn.ctx, vec3_make(0, 0, 0), vec3_make(1, 1, 1), &box) ? FRAM_OK : FRAM_ERROR_MEMORY;
        if (turn.status == FRAM_OK)
            turn.status = solid_add(&turn.ctx, &solids, &box, &pieces, 0, &row, &turn.error);
        mesh_free(&turn.ctx, &box);
        polyhedron_array_free(&turn.ctx, &pieces);
        shape_store_free(&turn.ctx, &s);
        solid_array_free(&turn.ctx, &solids);
        if (o)
            overlay_free(o);
    }
}
END_TEST

TEST_MAIN("shape", the_radius_of_a_solid_is_that_of_its_farthest_corner, an_outline_of_the_store_itself,
          a_convex_prism_is_its_own_piece, many_corners_are_cut_into_small_pieces,
          a_concave_prism_knows_its_seams_and_corners, a_dropped_triangle_leaves_a_piece_of_its_own,
          wrong_outlines_are_refused, solids_take_over_their_mesh, rows_are_used_again_and_pools_squeezed,
          memory_runs_out)

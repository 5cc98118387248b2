/* Level ice held in tiles: the same breaks as in one floe, in the tiles that are reached and in no others. */
#include "sheet_rig.h"

#include "ice/fracture_parts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double AREA = 1, LOAD = 1e7;

static const box2 PLAN = {{-60, 0}, {60, 90}};

static int compare_areas(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* Areas of the floes that broke off, ascending. */
static int piece_areas(const fracture_rig *r, double *out)
{
    int n = 0;
    for (int32_t i = 0; i < r->floes.count; i++)
        if (r->floes.body[i] >= 0 && r->bodies.motion[r->floes.body[i]] == MOTION_DYNAMIC)
            out[n++] = r->floes.area[i];
    qsort(out, (size_t)n, sizeof *out, compare_areas);
    return n;
}

/* Every tile is sound, lies in its cell, and hangs on an anchored side; nothing overlaps. */
static void check_sheet(fracture_rig *r)
{
    tile_index index = sheet_index(r);
    tile_sheet_view v = sheet_view(r, &index);
    vec2_array ring = {0};
    int32_t rows = r->floes.count;
    uint8_t *held = calloc((size_t)rows, 1);
    bool more = true;
    for (int32_t i = 0; i < rows; i++) {
        if (r->floes.body[i] < 0 || r->floes.tile[i] == 0)
            continue;
        ck_assert(tile_outline(&r->ctx, &v, i, &ring));
        polygon p = {ring.data, ring.count};
        char reason[OVERLAY_REASON_SIZE];
        ck_assert_msg(overlay_is_valid(r->plane, p, reason, NULL), "%s", reason);
        box2 cell = tile_cell(v.grid, r->floes.tile[i] - 1), box = polygon_bounds(p);
        ck_assert(box.lo.x >= cell.lo.x && box.hi.x <= cell.hi.x && box.lo.y >= cell.lo.y && box.hi.y <= cell.hi.y);
        ck_assert_int_eq(r->bodies.motion[r->floes.body[i]], MOTION_STATIC);
        held[i] = tile_is_anchored(&v, i);
    }
    while (more) {
        more = false;
        for (int32_t i = 0; i < rows; i++)
            for (int32_t k = 0; k < rows && !held[i] && r->floes.body[i] >= 0 && r->floes.tile[i]; k++)
                if (held[k] && tile_seam(&v, i, k) > v.grid->least_seam)
                    held[i] = 1, more = true;
    }
    for (int32_t i = 0; i < rows; i++)
        ck_assert(held[i] || r->floes.body[i] < 0 || r->floes.tile[i] == 0);
    free(held);
    array_free(&r->ctx, &ring);
    tile_index_free(&r->ctx, &index);
}

/* ---- tiles ---- */

/* The sheet's boundary is that of the rectangle and of the opening, whatever the tiles. */
START_TEST(boundary)
{
    fracture_rig r;
    fracture_rig_make(&r);
    polygon_list openings = {0};
    const vec2 hole[4] = {{-11, 30}, {13, 30}, {13, 47}, {-11, 47}};
    ck_assert(polygon_list_push(&r.ctx, &openings, (polygon){hole, 4}));
    const double sizes[] = {200, 45, 30, 17, 11.3};
    for (int i = 0; i < 5; i++) {
        sheet_make(&r, PLAN, sizes[i], &openings);
        assert_relative(sheet_area(&r, true), 120 * 90 - 24 * 17, 1e-12);
        tile_index index = sheet_index(&r);
        tile_sheet_view v = sheet_view(&r, &index);
        tile_segment_array segments = {0};
        const tile_grid *g = v.grid;
        ck_assert(tile_boundary(&r.ctx, &v, (tile_range){0, g->columns - 1, 0, g->rows - 1}, &segments));
        double length = 0;
        for (int32_t k = 0; k < segments.count; k++)
            length += vec2_length(vec2_sub(segments.data[k].b, segments.data[k].a));
        /* A ring with a hole is cut along a bridge, which is a seam inside one tile and counts as boundary there. */
        if (sizes[i] < 40)
            assert_relative(length, 2 * (120 + 90) + 2 * (24 + 17), 1e-9);
        array_free(&r.ctx, &segments);
        tile_index_free(&r.ctx, &index);
        check_sheet(&r);
        fracture_rig_remove_all(&r);
    }
    polygon_list_free(&r.ctx, &openings);
    fracture_rig_free(&r);
}
END_TEST

/* A sheet of tiles that a load has broken once. */
static void break_sheet(fracture_rig *r, box2 plan, double tile, vec2 place)
{
    fracture_rig_make(r);
    r->settings.splitting = SPLITTING_NONE;
    sheet_make(r, plan, tile, NULL);
    ck_assert(sheet_load(r, place, LOAD, AREA));
    ck_assert_int_eq(fracture_rig_break(r), 1);
}

/* The same load breaks the same pieces off a sheet of any tiles as off one floe: on an edge, on a seam, at a crossing.
 */
START_TEST(tiles_do_not_matter)
{
    const double at[] = {0, 7.5, 15, 15.0001, 12.3, -30, 29.999, 41};
    for (int i = 0; i < 8; i++) {
        double one[64], many[64];
        int count = 0;
        for (int tiled = 0; tiled < 3; tiled++) {
            fracture_rig r;
            if (tiled) {
                break_sheet(&r, PLAN, tiled == 1 ? 30 : 4, (vec2){at[i], 0.3});
            } else {
                fracture_rig_make(&r);
                r.settings.splitting = SPLITTING_NONE;
                const vec2 corner[4] = {{-60, 0}, {60, 0}, {60, 90}, {-60, 90}};
                int32_t row = fracture_rig_floe(&r, (polygon){corner, 4}, 1, MOTION_STATIC);
                ck_assert(fracture_rig_load(&r, row, (vec2){at[i], 0.3 - 45}, LOAD, AREA));
                ck_assert_int_eq(fracture_rig_break(&r), 1);
            }
            assert_vec3_close(r.events.data[0].place, ((vec3){at[i], 0, 0}), 1e-9);
            assert_absolute(fracture_rig_area(&r), 120 * 90 - r.events.data[0].area_lost + r.events.data[0].area_gained,
                            1e-7);
            int n = piece_areas(&r, tiled ? many : one);
            if (tiled) {
                ck_assert_int_eq(n, count);
                for (int k = 0; k < n; k++)
                    assert_relative(many[k], one[k], 1e-9);
                check_sheet(&r);
            }
            count = n;
            fracture_rig_free(&r);
        }
    }
}
END_TEST

/* Nor does the place: far from the origin, as in polar coordinates, cuts of tiles have the rounding of large numbers,
   and wedges that cross a seam are one piece all the same. */
START_TEST(far_from_the_origin)
{
    static const double FAR[] = {0, 1e6, 7e6}, AT[] = {0, 1.3, -0.7, 0.01};
    for (int i = 0; i < 4; i++) {
        double first[64], areas[64];
        int count = 0;
        for (int k = 0; k < 3; k++) {
            fracture_rig r;
            double x = 0.3 * FAR[k], y = FAR[k];
            break_sheet(&r, (box2){{x - 60, y}, {x + 60, y + 90}}, 30, (vec2){x + AT[i], y + 0.3});
            int n = piece_areas(&r, k ? areas : first);
            count = k ? count : n;
            ck_assert_int_eq(n, count);
            for (int m = 0; m < n && k; m++)
                assert_relative(areas[m], first[m], 1e-6);
            fracture_rig_free(&r);
        }
    }
}
END_TEST

/* Tiles that the stencil does not reach keep their floes. */
START_TEST(other_tiles_stay)
{
    fracture_rig r;
    fracture_rig_make(&r);
    sheet_make(&r, PLAN, 15, NULL);
    int before = sheet_count(&r, true), same = 0;
    ck_assert_int_eq(before, 48);
    ck_assert(sheet_load(&r, (vec2){7, 0}, LOAD, AREA));
    ck_assert_int_eq(fracture_rig_break(&r), 1);
    for (int32_t i = 0; i < r.floes.count; i++)
        same += r.floes.body[i] >= 0 && r.floes.number[i] < before;
    ck_assert_int_ge(same, 45);
    ck_assert_int_eq(sheet_count(&r, true), before);
    ck_assert_int_eq(r.events.data[0].kind, FRACTURE_BENDING);
    fracture_rig_free(&r);
}
END_TEST

/* Seams are no faces of the convex pieces, until the neighbour is gone. */
START_TEST(seams)
{
    fracture_rig r;
    fracture_rig_make(&r);
    sheet_make(&r, (box2){{0, 0}, {40, 20}}, 20, NULL);
    int32_t left = sheet_tile_at(&r, (vec2){10, 10}), right = sheet_tile_at(&r, (vec2){30, 10});
    int32_t shape = r.bodies.shape[r.floes.body[left]];
    ck_assert_uint_ne(r.shapes.pieces.inner_edges[r.shapes.shapes.piece_first[shape]], 0);
    floe_remove(&r.bodies, &r.shapes, &r.floes, right);
    tile_index index = sheet_index(&r);
    tile_sheet_view v = sheet_view(&r, &index);
    tile_mark_seams(&v, &r.shapes, (tile_range){0, 1, 0, 0});
    ck_assert_uint_eq(r.shapes.pieces.inner_edges[r.shapes.shapes.piece_first[shape]], 0);
    tile_index_free(&r.ctx, &index);
    fracture_rig_free(&r);
}
END_TEST

/* A patch that a seam divides is one load: its halves alone would not break the ice.  Of a hull (0), of a piece (1),
   and of a piece that is the floe of the patch, turned (2). */
static void load_across_a_seam(int by, bool touching)
{
    static const vec2 PIECE[] = {{-4, -9}, {4, -9}, {4, 1}, {-4, 1}};
    fracture_rig r;
    fracture_rig_make(&r);
    r.settings.under_pieces = true;
    sheet_make(&r, PLAN, 30, NULL);
    int32_t piece = r.floes.body[fracture_rig_floe(&r, (polygon){PIECE, 4}, 1, MOTION_DYNAMIC)];
    if (by == 2 && touching)
        r.bodies.orientation[piece] = quat_from_roll_pitch_yaw(0, 0, 0.5);
    edge_stress whole = fracture_edge_stress(&r.settings, &FRACTURE_RIG_ICE, 1, 1, 2 * AREA, EDGE_STRAIGHT);
    for (int side = -1; side <= 1; side += 2) {
        ck_assert(sheet_load(&r, (vec2){0.5 * side, 0.4}, 0.51 * whole.wedge_capacity, AREA));
        crushing_patch *p = &r.patches.data[r.patches.count - 1];
        vec3 at = r.bodies.position[p->floe_body];
        double seam = touching ? 0 : 0.1 * side, far = 1.0 * side;
        p->plan = (box2){{fmin(seam, far) - at.x, -at.y}, {fmax(seam, far) - at.x, 0.8 - at.y}};
        if (by > 0)
            fracture_rig_push_by(&r, piece, by == 2);
    }
    ck_assert_int_eq(fracture_rig_break(&r), touching);
    if (touching) {
        assert_relative(r.events.data[0].load, 1.02 * whole.wedge_capacity, 1e-12);
        assert_vec3_close(r.events.data[0].place, ((vec3){0, 0, 0}), 1e-9);
    }
    fracture_rig_free(&r);
}

START_TEST(patch_across_a_seam)
{
    for (int by = 0; by < 3; by++)
        for (int touching = 0; touching < 2; touching++)
            load_across_a_seam(by, touching);
}
END_TEST

/* A cut that is refused, here since its pieces are dust, leaves its tile unbroken: contacts go on. */
START_TEST(refused_is_not_broken)
{
    static const vec2 FLOE[] = {{200, 0}, {400, 0}, {400, 200}, {200, 200}};
    fracture_rig r;
    fram_error e = {0};
    fracture_rig_make(&r);
    r.settings.splitting = SPLITTING_NONE;
    r.settings.smallest_floe_area = 30; /* wedges have 9 m2 in 1 m of ice, 80 in 4 m */
    sheet_make(&r, PLAN, 30, NULL);
    int32_t floe = fracture_rig_floe(&r, (polygon){FLOE, 4}, 4, MOTION_DYNAMIC);
    ck_assert(sheet_load(&r, (vec2){15, 0}, LOAD, AREA));
    ck_assert(fracture_rig_load(&r, floe, (vec2){0, -100}, 20 * LOAD, AREA));
    assert_ok(fracture_rig_try(&r, &e), e);
    ck_assert_int_eq(r.events.count, 1);
    ck_assert_double_gt(r.events.data[0].piece_area, 3e4);
    ck_assert(r.contacts.data[0].correct && !r.contacts.data[1].correct);
    fracture_rig_free(&r);
}
END_TEST

/* A load far from every boundary breaks nothing: an edge is what it would bend. */
START_TEST(inner_load)
{
    fracture_rig r;
    fracture_rig_make(&r);
    sheet_make(&r, PLAN, 30, NULL);
    ck_assert(sheet_load(&r, (vec2){5, 45}, LOAD, AREA));
    ck_assert_int_eq(fracture_rig_break(&r), 0);
    fracture_rig_free(&r);
}
END_TEST

/* ---- what comes loose ---- */

/* Channels bitten along the two free sides of a rectangle and across cut a block out: it drifts, with its area. */
START_TEST(island)
{
    fracture_rig r;
    fracture_rig_make(&r);
    sheet_make(&r, (box2){{0, 0}, {160, 120}}, 20, NULL);
    r.settings.tiles.anchored[SHEET_Y_MIN] = false;
    r.settings.sharing = SHARING_EQUAL; /* bites of one size, so that the block's is known */
    const vec2 corner[] = {{60, 0}, {60, 70}, {120, 70}, {120, -2}};
    int released = 0;
    double loose = 0;
    for (int leg = 0; leg < 3 && !released; leg++) {
        vec2 way = vec2_sub(corner[leg + 1], corner[leg]);
        double length = vec2_length(way);
        for (double s = 0; s < length && !released; s += 1.5) {
            vec2 place = vec2_add(corner[leg], vec2_scale(way, s / length));
            ck_assert(sheet_load(&r, place, LOAD, 3));
            fracture_rig_break(&r);
            for (int32_t i = 0; i < r.events.count; i++) {
                const fracture_event *e = &r.events.data[i];
                assert_absolute(e->parent_area, e->piece_area + e->area_lost - e->area_gained, 1e-9 * e->parent_area);
                if (e->kind != FRACTURE_RELEASE || e->parent_area < 1000)
                    continue;
                released++;
                loose = e->parent_area;
                ck_assert_int_eq(e->pieces, 1);
                for (int32_t k = 0; k < r.floes.count; k++)
                    if (r.floes.body[k] >= 0 && r.floes.number[k] == e->first_piece) {
                        ck_assert_int_eq(r.bodies.motion[r.floes.body[k]], MOTION_DYNAMIC);
                        ck_assert_int_eq(r.floes.tile[k], 0);
                        assert_relative(r.floes.area[k], e->piece_area, 1e-12);
                    }
            }
            if (!released)
                sheet_clear_pieces(&r);
        }
    }
    ck_assert_int_eq(released, 1);
    /* 60 m by 70 between the middles of channels that are 8 m wide on either side, and wider at their bends. */
    ck_assert(loose > 1000 && loose < 60 * 70);
    check_sheet(&r);
    fracture_rig_free(&r);
}
END_TEST

/* A side that does not hold: what hangs on it alone drifts with the first bite next to it. */
START_TEST(anchored_sides)
{
    for (int held = 0; held < 2; held++) {
        fracture_rig r;
        fracture_rig_make(&r);
        polygon_list openings = {0};
        const vec2 channel[4] = {{-1, 20}, {101, 20}, {101, 40}, {-1, 40}};
        ck_assert(polygon_list_push(&r.ctx, &openings, (polygon){channel, 4}));
        sheet_make(&r, (box2){{0, 0}, {100, 60}}, 20, &openings);
        r.settings.tiles.anchored[SHEET_X_MIN] = r.settings.tiles.anchored[SHEET_X_MAX] = false;
        r.settings.tiles.anchored[SHEET_Y_MIN] = held;
        ck_assert(sheet_load(&r, (vec2){50, 20}, LOAD, AREA));
        ck_assert_int_eq(fracture_rig_break(&r), held ? 1 : 2);
        ck_assert_int_eq(sheet_count(&r, true), held ? 10 : 5);
        if (!held)
            assert_relative(sheet_area(&r, true), 2000, 1e-12);
        polygon_list_free(&r.ctx, &openings);
        fracture_rig_free(&r);
    }
}
END_TEST

/* ---- many ---- */

/* Random bites all over a sheet until little is left: sound tiles, exact books, nothing hangs in the air. */
START_TEST(random_bites)
{
    fracture_rig r;
    fracture_rig_make(&r);
    random_stream s = random_begin(11, 1, 0);
    int events = 0, releases = 0, bites = getenv("FRAM_TEST_SHORT") ? 300 : 1500;
    double booked = 0, broken = 0;
    for (int turn = 0; events < bites; turn++) {
        if (turn % 400 == 0) {
            fracture_rig_remove_all(&r);
            sheet_make(&r, (box2){{-50, -30}, {50, 30}}, random_uniform(&s, 7, 35), NULL);
            r.settings.wedges = 2 + (int32_t)random_uniform(&s, 0, 4);
        }
        if (sheet_count(&r, true) == 0)
            continue;
        double before = fracture_rig_area(&r), lost = 0;
        int loads = 1 + (int)random_uniform(&s, 0, 2.5);
        for (int i = 0; i < loads; i++)
            ck_assert(sheet_load(&r, (vec2){random_uniform(&s, -50, 50), random_uniform(&s, -30, 30)}, LOAD,
                                 random_power_law(&s, 0.01, 8, 0)));
        fracture_rig_break(&r);
        for (int32_t i = 0; i < r.events.count; i++) {
            const fracture_event *e = &r.events.data[i];
            assert_absolute(e->parent_area, e->piece_area + e->area_lost - e->area_gained, 1e-9 * e->parent_area);
            /* Dust that comes loose is lost. */
            ck_assert(e->pieces == 0 || e->area_lost + e->area_gained <= 1e-3 * e->parent_area * (1 + 1e-9));
            ck_assert(e->pieces > 0 || e->parent_area < r.settings.smallest_floe_area);
            lost += e->area_lost - e->area_gained;
            booked += e->area_lost + e->area_gained;
            broken += e->parent_area;
            releases += e->kind == FRACTURE_RELEASE;
        }
        events += r.events.count;
        assert_absolute(fracture_rig_area(&r), before - lost, 1e-7);
        check_sheet(&r);
        sheet_clear_pieces(&r);
    }
    printf("%d events, %d of them releases; %.4f %% of the area is booked\n", events, releases, 100 * booked / broken);
    ck_assert_int_gt(releases, 5);
    fracture_rig_free(&r);
}
END_TEST

/* A cut leaves two corners that rounding tells apart on a seam: no sound tile has both, and the break was put off for
   ever. */
START_TEST(corners_within_rounding)
{
    fracture_rig r;
    vec2 corner[] = {{0, 0}, {12, 1e-12}, {12 + 2e-9, 0}, {20, 0}, {20, 20}, {0, 20}, {1e-10, 0}};
    vec2_array ring = {0};
    fracture_rig_make(&r);
    sheet_make(&r, (box2){{0, 0}, {40, 20}}, 20, NULL);
    ck_assert(array_resize(&r.ctx, &ring, 7));
    memcpy(ring.data, corner, sizeof corner);
    tile_snap(&r.settings.tiles, 0, &ring);
    ck_assert_int_eq(ring.count, 5);
    ck_assert(fracture_outline_is_sound(&r.ctx, (polygon){ring.data, ring.count}));
    ck_assert(ring.data[1].x == 12 && ring.data[1].y == 0);
    array_free(&r.ctx, &ring);
    fracture_rig_free(&r);
}
END_TEST

/* A remnant of a tile along its seam, which a sheet may keep under the least area of a floe, is so thin and so ragged
   that all its convex parts are under the least area of these: it joins a sibling, is booked, or the break is put off.
 */
START_TEST(no_convex_part)
{
    static const vec2 RAGGED[7] = {{20, 0.1},    {20, 1.1},      {19.98, 1.1}, {19.998, 0.85},
                                   {19.98, 0.6}, {19.998, 0.35}, {19.98, 0.1}};
    static const vec2 BESIDE[9] = {{0, 0},         {19.98, 0},   {19.98, 0.1}, {19.998, 0.35}, {19.98, 0.6},
                                   {19.998, 0.85}, {19.98, 1.1}, {19.5, 20},   {0, 20}};
    static const vec2 FAR[4] = {{0, 0}, {15, 0}, {15, 20}, {0, 20}};
    for (int turn = 0; turn < 3; turn++) {
        fracture_rig r;
        fracture_rig_make(&r);
        sheet_make(&r, (box2){{0, 0}, {40, 20}}, 20, NULL);
        fracture_state state = fracture_rig_state(&r);
        fram_error e = {0};
        fracture_job j = {&r.ctx, r.scratch, &r.settings, r.plane, &state, &r.events, &e};
        polygon ragged = {RAGGED, 7}, other = turn == 0 ? (polygon){BESIDE, 9} : (polygon){FAR, 4};
        ck_assert(polygon_area(ragged) > r.settings.smallest_piece_area && !polygon_is_convex(ragged));
        ck_assert(tile_side_length(&r.settings.tiles, 0, ragged) > r.settings.tiles.least_seam);
        r.settings.edge_threshold = 1e-4; /* cleaning leaves all as it is */
        if (turn == 2)
            r.settings.smallest_piece_area = r.settings.smallest_floe_area = 4e-3;
        polygon_list rings = {0};
        ck_assert(polygon_list_push(&r.ctx, &rings, ragged) && polygon_list_push(&r.ctx, &rings, other));
        ck_assert(fracture_gather(&r.ctx, r.scratch, &rings, MOTION_STATIC, 1, 0));
        int32_t parent = sheet_tile_at(&r, (vec2){1, 1});
        fracture_event event = {0};
        birth_terms terms = {.least = 1, .most = HUGE_VAL};
        bool broke;
        assert_ok(fracture_birth(&j, &parent, 1, terms, &event, &broke), e);
        ck_assert(broke);
        /* Joined, lost, and kept where its largest part is large enough. */
        ck_assert_int_eq(event.pieces, turn == 2 ? 2 : 1);
        assert_absolute(event.piece_area, polygon_area(other) + (turn == 1 ? 0 : polygon_area(ragged)), 2e-3);
        if (turn == 1)
            assert_absolute(event.area_lost, polygon_area(ragged), 2e-3);
        ck_assert(event.area_lost >= 0 && event.area_gained >= 0 && event.area_gained < 2e-3);
        polygon_list_free(&r.ctx, &rings);
        fracture_rig_free(&r);
    }
}
END_TEST

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        fracture_rig r;
        turn.status = FRAM_ERROR_MEMORY;
        bool good = fracture_rig_start(&r, turn.ctx) && sheet_try(&r, (box2){{0, 0}, {40, 20}}, 20, NULL, &turn.error);
        r.settings.tiles.anchored[SHEET_X_MIN] = r.settings.tiles.anchored[SHEET_Y_MIN] = false;
        if (good && sheet_load(&r, (vec2){20, 0}, LOAD, AREA))
            turn.status = fracture_rig_try(&r, &turn.error);
        fracture_rig_free(&r);
    }
}
END_TEST

TEST_MAIN("fracture_sheet", boundary, tiles_do_not_matter, far_from_the_origin, other_tiles_stay, seams,
          patch_across_a_seam, refused_is_not_broken, inner_load, island, anchored_sides, random_bites,
          corners_within_rounding, no_convex_part, memory_runs_out)

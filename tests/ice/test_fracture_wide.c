/* Contacts that are wide along the edge: a strip breaks off between the end wedges, as strong and as long as the ice
   behind the contact makes it (docs/decisions/0129). */
#include "sheet_rig.h"

#include "ice/sheet.h"
#include "ice/strip.h"
#include "ice_rig.h"

/* ---- plates driven into an edge ---- */

typedef struct breaking {
    fracture_event event;
    double largest; /* area of the largest loose piece [m2] */
} breaking;

/* A plate of this width at 45 degrees moves at 0.1 m/s into the straight edge of ice of 1 m, 300 m x 200 m, until that
   breaks. */
static breaking plate_breaks(double width, double dt)
{
    ice_rig r;
    ice_rig_make(&r, dt);
    int32_t row = ice_rig_plate(&r, 300, 200, 1, MOTION_STATIC), ice = r.floes.body[row];
    r.bodies.position[ice] = (vec3){150, 0, 0};
    int32_t hull = ice_rig_slanted(&r, 1, width / 2, 3);
    r.bodies.position[hull] = (vec3){-0.5, 0, 0};
    r.bodies.velocity[hull] = (vec3){0.1, 0, 0};
    ice_rig_pair(&r, ice, hull);
    fracture_settings settings = fracture_rig_settings();
    settings.time_step = dt;
    settings.thick_plate_radius = false;
    settings.splitting = SPLITTING_NONE;
    settings.wide_contacts = true;
    breaking b = {.event = ice_rig_until_broken(&r, &settings, 2).event};
    for (int32_t i = 0; i < r.floes.count; i++)
        if (r.floes.body[i] >= 0 && r.bodies.motion[r.floes.body[i]] == MOTION_DYNAMIC)
            b.largest = testing_larger(b.largest, r.floes.area[i]);
    ice_rig_free(&r);
    return b;
}

/* docs/oracles.md, section 1: N = 3, frictionless.  The load grows by its crushing, 2 MPa 0.1 m/s times the width. */
START_TEST(plates)
{
    static const double WIDTHS[] = {2, 10, 20, 50}, LOADS[] = {337e3, 437e3, 562e3, 937e3};
    double l = ice_characteristic_length(&FRACTURE_RIG_ICE, 1, 1025, 9.81);
    for (int i = 0; i < 4; i++) {
        /* A step's growth is 4 and 2 % of the load. */
        double growth = 2e6 * 0.1 * WIDTHS[i];
        for (int half = 1; half <= 2; half++) {
            double dt = 0.04 / half * LOADS[i] / growth;
            breaking b = plate_breaks(WIDTHS[i], dt);
            ck_assert_int_eq(b.event.kind, FRACTURE_BENDING);
            ck_assert_msg(b.event.load > 0.998 * LOADS[i] && b.event.load < (1.002 + 0.04 / half) * LOADS[i],
                          "%g m, step %g: %g kN", WIDTHS[i], dt, b.event.load / 1e3);
            assert_relative(b.event.crack_length, 4.14196, 0.02);
            /* 811 m2 under 50 m.  The two points of a narrow patch carry its depth along with its width. */
            double crack = b.event.crack_length / real_cos(PI / 6), length = fmin(1.1107207 * l, crack + WIDTHS[i] / 2);
            assert_relative(b.largest, length * WIDTHS[i], 0.08 / WIDTHS[i]);
            ck_assert_int_eq(b.event.pieces, 6); /* a remnant, a strip and four wedges */
        }
    }
}
END_TEST

/* ---- floes under given loads ---- */

/* A load P straight down, even along a line of this half vector about a place of the floe's own frame. */
static void wide_load(fracture_rig *r, int32_t row, vec2 place, vec2 half, double load, double area)
{
    ck_assert(fracture_rig_load(r, row, place, load, area) && fracture_rig_widen(r, half));
}

/* A floe that is loaded along its whole end is a beam: no ice for wedges beside it, and its own length.  Rigid where it
   is short, Nevel's strip where it is long. */
START_TEST(floes_are_beams)
{
    static const double LENGTHS[] = {3, 8, 20, 45, 90};
    double l = ice_characteristic_length(&FRACTURE_RIG_ICE, 1, 1025, 9.81), width = 12;
    fracture_rig r;
    fracture_rig_make(&r);
    r.settings.splitting = SPLITTING_NONE;
    r.settings.wide_contacts = true;
    r.settings.smallest_floe_area = 0.01;
    for (int i = 0; i < 5; i++) {
        strip s = strip_solve(LENGTHS[i] / l);
        double bears = 0.5e6 / 6 * width / (s.moment * l);
        for (int turn = 0; turn < 2; turn++) {
            int32_t row = fracture_rig_plate(&r, LENGTHS[i], width, MOTION_DYNAMIC);
            wide_load(&r, row, (vec2){-LENGTHS[i] / 2 + 0.01, 0}, (vec2){0, width / 2}, (turn ? 1.002 : 0.998) * bears,
                      0.2);
            ck_assert_int_eq(fracture_rig_break(&r), turn);
            if (turn) {
                ck_assert_int_eq(fracture_rig_count(&r), 2);
                double least = HUGE_VAL;
                for (int32_t k = 0; k < r.floes.count; k++)
                    if (r.floes.body[k] >= 0)
                        least = testing_smaller(least, r.floes.area[k]);
                double piece = fmin(s.x_max * l, LENGTHS[i] - s.x_max * l);
                assert_relative(least, piece * width, 1e-6);
            }
            fracture_rig_remove_all(&r);
        }
    }
    assert_relative(strip_solve(3 / l).x_max * l, 1, 1e-2);
    fracture_rig_free(&r);
}
END_TEST

/* A contact no wider than the ice is thick, and any contact without the option, is narrow. */
START_TEST(narrow)
{
    fracture_rig r;
    fracture_rig_make(&r);
    r.settings.splitting = SPLITTING_NONE;
    for (int turn = 0; turn < 3; turn++) {
        double half = turn == 1 ? 0.6 : turn ? 6 : 0.4;
        r.settings.wide_contacts = turn < 2;
        double bears = fracture_edge_stress(&r.settings, &FRACTURE_RIG_ICE, 1, 1, 0.5, EDGE_STRAIGHT).wedge_capacity;
        int32_t row = fracture_rig_plate(&r, 100, 100, MOTION_DYNAMIC);
        wide_load(&r, row, (vec2){-49.9, 0}, (vec2){0, half}, 1.001 * bears, 0.5);
        ck_assert_int_eq(fracture_rig_break(&r), turn != 1);
        fracture_rig_remove_all(&r);
    }
    fracture_rig_free(&r);
}
END_TEST

/* A contact that goes round a stem follows no straight edge: more than a quarter as deep as it is long, it is narrow.
 */
START_TEST(round_a_stem)
{
    fracture_rig r;
    fracture_rig_make(&r);
    r.settings.splitting = SPLITTING_NONE;
    r.settings.wide_contacts = true;
    double bears = fracture_edge_stress(&r.settings, &FRACTURE_RIG_ICE, 1, 1, 0.5, EDGE_STRAIGHT).wedge_capacity;
    for (int turn = 0; turn < 2; turn++) {
        int32_t row = fracture_rig_plate(&r, 100, 100, MOTION_DYNAMIC);
        wide_load(&r, row, (vec2){-49.9, 0}, (vec2){turn ? 1.6 : 1.4, 6}, 1.001 * bears, 0.5);
        ck_assert_int_eq(fracture_rig_break(&r), turn);
        fracture_rig_remove_all(&r);
    }
    fracture_rig_free(&r);
}
END_TEST

/* The same load on a sheet of tiles and on one floe breaks the same off; patches that a seam divides are one. */
START_TEST(sheets)
{
    double areas[3] = {0};
    for (int i = 0; i < 3; i++) {
        static const double SIZES[3] = {400, 30, 20};
        fracture_rig r;
        fracture_rig_make(&r);
        sheet_make(&r, (box2){{-60, 0}, {60, 360}}, SIZES[i], NULL);
        r.settings.wide_contacts = true;
        double before = fracture_rig_area(&r);
        /* The whole load on the one tile; its halves meet on a seam of the smaller ones, at x = 0. */
        for (int k = 0; k < (i ? 2 : 1); k++) {
            double x = i ? 8 * k - 4 : 0, half = i ? 4 : 8;
            int32_t row = sheet_tile_at(&r, (vec2){x, 0});
            vec3 origin = r.bodies.position[r.floes.body[row]];
            wide_load(&r, row, (vec2){x - origin.x, 0.05 - origin.y}, (vec2){half, 0}, i ? 3e5 : 6e5, i ? 0.2 : 0.4);
            r.patches.data[k].plan = (box2){{x - half - origin.x, -origin.y}, {x + half - origin.x, 0.1 - origin.y}};
        }
        fracture_rig_break(&r);
        for (int32_t k = 0; k < r.floes.count; k++)
            if (r.floes.body[k] >= 0 && r.bodies.motion[r.floes.body[k]] == MOTION_DYNAMIC)
                areas[i] += r.floes.area[k];
        assert_relative(fracture_rig_area(&r), before, 1e-3);
        ck_assert(areas[i] > 50);
        fracture_rig_free(&r);
    }
    assert_relative(areas[1], areas[0], 1e-6);
    assert_relative(areas[2], areas[0], 1e-6);
}
END_TEST

/* What a load of 20 m bears near the middle of the end of a sheet of 80 m, `deep` and held all round, with an opening
 * [N]. */
static double sheet_bears(double deep, double tile, const vec2 hole[4])
{
    fracture_rig r;
    polygon_list openings = {0};
    fracture_rig_make(&r);
    if (hole)
        ck_assert(polygon_list_push(&r.ctx, &openings, (polygon){hole, 4}));
    sheet_make(&r, (box2){{-40, 0}, {40, deep}}, tile, &openings);
    /* The end is open water. */
    r.settings.tiles.anchored[SHEET_Y_MIN] = false;
    r.settings.wide_contacts = true;
    r.settings.smallest_floe_area = r.settings.smallest_piece_area = 1e-3;
    ck_assert(sheet_load(&r, (vec2){0.7, 0.01}, 1e7, 0.4) && fracture_rig_widen(&r, (vec2){10, 0}));
    ck_assert_int_ge(fracture_rig_break(&r), 1); /* what comes loose with it is released */
    double bears = r.events.data[0].load / r.events.data[0].stress_ratio;
    polygon_list_free(&r.ctx, &openings);
    fracture_rig_free(&r);
    return bears;
}

/* A lead or a hole in a part of a strip makes no short beam of the whole, on whatever side of the crack it ends and
   however the tile around it is cut; nor does a side that is held, beyond which ice goes on. */
START_TEST(openings_in_a_strip)
{
    static const vec2 SHORT_LEAD[4] = {{0.8, 3}, {39, 3}, {39, 3.5}, {0.8, 3.5}};
    static const vec2 LONG_LEAD[4] = {{0.6, 8}, {39, 8}, {39, 8.5}, {0.6, 8.5}};
    static const vec2 HOLE[4] = {{0.6, 3.4}, {0.8, 3.4}, {0.8, 3.6}, {0.6, 3.6}};
    static const vec2 ASIDE[4] = {{5.5, 3}, {6.5, 3}, {6.5, 4}, {5.5, 4}};
    static const vec2 ACROSS[4] = {{-39, 8}, {39, 8}, {39, 8.5}, {-39, 8.5}};
    static const vec2 FAR[4] = {{-39, 24}, {39, 24}, {39, 24.5}, {-39, 24.5}};
    double whole = sheet_bears(80, 100, NULL);
    assert_relative(whole, 562e3, 0.02); /* docs/oracles.md, section 1 */
    for (int i = 0; i < 3; i++) {
        static const double TILES[] = {100, 29, 10};
        assert_relative(sheet_bears(80, TILES[i], NULL), whole, 1e-6);
        assert_relative(sheet_bears(80, TILES[i], SHORT_LEAD), whole, 0.06);
        assert_relative(sheet_bears(80, TILES[i], LONG_LEAD), whole, 1e-6);
        assert_relative(sheet_bears(80, TILES[i], HOLE), whole, 0.01);
        assert_relative(sheet_bears(80, TILES[i], ASIDE), whole, 0.02);
        assert_relative(sheet_bears(10, TILES[i], NULL), whole, 1e-6);
        ck_assert_double_gt(sheet_bears(80, TILES[i], ACROSS), 2 * whole);
        /* Farther in than a tile, too. */
        assert_relative(sheet_bears(80, TILES[i], FAR), sheet_bears(80, 100, FAR), 1e-6);
        ck_assert_double_gt(sheet_bears(80, TILES[i], FAR), 1.15 * whole);
    }
}
END_TEST

/* A slit from the far end of a floe to 5 m from the load, on its crack, makes no short beam of the rest; and what opens
   the first crack is spread as far as the load. */
START_TEST(slit_in_a_floe)
{
    static const vec2 SLIT[8] = {{-50, -20}, {50, -20}, {50, -0.1}, {-45, -0.1},
                                 {-45, 0.1}, {50, 0.1}, {50, 20},   {-50, 20}};
    double l = ice_characteristic_length(&FRACTURE_RIG_ICE, 1, 1025, 9.81), bears[2];
    for (int i = 0; i < 2; i++) {
        fracture_rig r;
        fracture_rig_make(&r);
        r.settings.splitting = SPLITTING_NONE;
        r.settings.wide_contacts = true;
        int32_t row = i ? fracture_rig_floe(&r, (polygon){SLIT, 8}, 1, MOTION_DYNAMIC)
                        : fracture_rig_plate(&r, 100, 40, MOTION_DYNAMIC);
        vec3 at = r.bodies.position[r.floes.body[row]];
        wide_load(&r, row, (vec2){-49.99 - at.x, 0 - at.y}, (vec2){0, 10}, 1e7, 0.4);
        ck_assert_int_eq(fracture_rig_break(&r), 1);
        bears[i] = r.events.data[0].load / r.events.data[0].stress_ratio;
        edge_ice wide = {1, 20, HUGE_VAL, HUGE_VAL};
        edge_stress s = fracture_edge_stress(&r.settings, &FRACTURE_RIG_ICE, 1, 1, 0.4, wide);
        assert_relative(s.radial_capacity, 0.5e6 / sheet_stress_strip(10 / l, 0.3), 0.03);
        fracture_rig_free(&r);
    }
    assert_relative(bears[1], bears[0], 0.02);
}
END_TEST

/* ---- pieces that come off ---- */

/* What breaks: a sheet, a fixed floe or one that floats, under a load at the middle of one side. */
typedef enum edge_kind { EDGE_OF_SHEET, EDGE_FIXED, EDGE_FLOATS } edge_kind;

/* The edge gives by told [m] under the load [N, down], and breaks under it; floes lie at this level [m].  Returns the
   load's place. */
static vec2 loaded_edge(fracture_rig *r, edge_kind kind, bool wide, double load, double told, double level)
{
    fracture_rig_make(r);
    r->settings.wide_contacts = wide;
    r->settings.splitting = SPLITTING_NONE;
    r->settings.edges_give = true;
    vec2 tip = {0, kind == EDGE_OF_SHEET ? 0 : -40};
    if (kind == EDGE_OF_SHEET) {
        sheet_make(r, (box2){{-40, 0}, {40, 80}}, 30, NULL);
        ck_assert(sheet_load(r, (vec2){0, 0.01}, load, 0.4));
    } else {
        int32_t row = fracture_rig_plate(r, 80, 80, MOTION_DYNAMIC), body = r->floes.body[row];
        r->bodies.motion[body] = kind == EDGE_FLOATS ? MOTION_DYNAMIC : MOTION_STATIC;
        r->bodies.position[body].z = level;
        ck_assert(fracture_rig_load(r, row, (vec2){0, -39.99}, load, 0.4));
    }
    ck_assert(!wide || fracture_rig_widen(r, (vec2){5, 0}));
    r->patches.data[0].compliance = told / fabs(load);
    return tip;
}

/* Whether a row is a piece that came off, not what is left. */
static bool came_off(const fracture_rig *r, int32_t row)
{
    return r->floes.body[row] >= 0 && r->floes.tile[row] == 0 && r->floes.area[row] <= 500;
}

/* The place at the load's line that a piece of this middle turns with. */
static vec2 at_the_load(const fracture_rig *r, int32_t body, vec2 tip, bool wide)
{
    return vec2_make(wide ? fmin(fmax(r->bodies.position[body].x, -5), 5) : 0, tip.y);
}

/* Height of a point of a body above the level at which it lay [m]. */
static double height_at(const fracture_rig *r, int32_t body, vec2 place)
{
    mat3 turn = quat_matrix(r->bodies.orientation[body]);
    vec3 up = mat3_column(turn, 2), at = r->bodies.position[body];
    return at.z - (up.x * (place.x - at.x) + up.y * (place.y - at.y)) / up.z;
}

/* An edge that had given by w as it broke leaves pieces that are as far down, or up, at the load, and not at all where
   they broke off, of sheets and of fixed floes; pieces of floes that float lie as these did. */
START_TEST(pieces_stay_bent)
{
    for (int i = 0; i < 16; i++) {
        bool wide = i % 2, up = i / 2 % 2;
        edge_kind kind = i < 4 || i >= 12 ? EDGE_OF_SHEET : i < 8 ? EDGE_FIXED : EDGE_FLOATS;
        /* No farther than the ice is thick, whatever load came at once. */
        double told = i >= 12 ? 3 : 0.04, z = kind == EDGE_OF_SHEET ? 0 : 0.2;
        double give = kind == EDGE_FLOATS ? 0 : fmin(told, 1) * (up ? 1 : -1);
        fracture_rig r;
        vec2 tip = loaded_edge(&r, kind, wide, up ? -1e6 : 1e6, told, z);
        ck_assert_int_eq(fracture_rig_break(&r), 1);
        int pieces = 0;
        for (int32_t k = 0; k < r.floes.count; k++) {
            if (!came_off(&r, k))
                continue;
            pieces++;
            int32_t body = r.floes.body[k];
            assert_absolute(height_at(&r, body, at_the_load(&r, body, tip, wide)) - z, give, 0.02 * fabs(give) + 1e-12);
            polygon p = fracture_rig_outline(&r, k);
            double least = HUGE_VAL;
            for (int32_t m = 0; m < p.count; m++) {
                vec3 corner = body_to_global(&r.bodies, body, (vec3){p.vertex[m].x, p.vertex[m].y, 0});
                least = fmin(least, fabs(corner.z - z));
                ck_assert_double_le(fabs(corner.z - z), fabs(give) + 1e-6);
            }
            ck_assert_double_le(least, 0.2 * fabs(give) + 1e-12);
        }
        ck_assert_int_ge(pieces, wide ? 4 : 3);
        fracture_rig_free(&r);
    }
}
END_TEST

/* Each load's pieces come off as the edge stood under it, though another one has broken the same ice before in the
   step: of a sheet, where the first wedges, at a seam, take the slots of its tiles, and of floes that are cut by all
   loads at once. */
START_TEST(pieces_of_each_load)
{
    static const double GIVES[] = {0.04, 0.06};
    for (edge_kind kind = EDGE_OF_SHEET; kind <= EDGE_FLOATS; kind++) {
        fracture_rig r;
        vec2 tip = loaded_edge(&r, kind, false, 1e6, GIVES[0], 0), beside = {-15, tip.y}, at = {-15, tip.y + 0.01};
        ck_assert(kind == EDGE_OF_SHEET ? sheet_load(&r, at, 1.2e6, 0.4) : fracture_rig_load(&r, 0, at, 1.2e6, 0.4));
        r.patches.data[1].compliance = GIVES[1] / 1.2e6;
        ck_assert_int_eq(fracture_rig_break(&r), kind == EDGE_OF_SHEET ? 2 : 1);
        int pieces[2] = {0, 0};
        for (int32_t k = 0; k < r.floes.count; k++) {
            if (!came_off(&r, k))
                continue;
            int32_t body = r.floes.body[k], of = r.bodies.position[body].x < -7.5;
            double give = kind == EDGE_FLOATS ? 0 : -GIVES[of];
            assert_absolute(height_at(&r, body, of ? beside : tip), give, 0.02 * fabs(give) + 1e-12);
            pieces[of]++;
        }
        ck_assert(pieces[0] >= 3 && pieces[1] >= 3);
        fracture_rig_free(&r);
    }
}
END_TEST

/* What patches stood on is remembered: the edge under the only one by this much [m]. */
static void stood(fracture_rig *r, double up)
{
    edge_support_table *e = &r->supports;
    ck_assert(table_resize(&r->ctx, e, &edge_support_table_info, 1));
    e->surface[0] = r->hull;
    e->generation[0] = r->bodies.generation[r->hull];
    e->place[0] = body_to_local(&r->bodies, r->hull, r->patches.data[0].centre);
    e->wedges[0] = e->part[0] = 1;
    e->rise[0] = up;
}

/* Pieces go on as the edge went, turning about where they broke off: by what it gave in the step, no faster than the
   surface that took it along, never back; the books take nothing for it.  Pieces of floes that float move as these. */
START_TEST(pieces_go_on)
{
    static const double DOWN = 0.04;
    static const struct {
        double before, surface, rate; /* [m], [m/s], [m/s] */
    } CASES[] = {{0, -0.3, -0.3}, {0.001 - DOWN, -0.3, -0.1}, {0, 0.2, 0}, {-0.01 - DOWN, -0.3, 0}};
    for (int i = 0; i < 24; i++) {
        bool wide = i / 4 % 2;
        edge_kind kind = i < 8 ? EDGE_OF_SHEET : i < 16 ? EDGE_FIXED : EDGE_FLOATS;
        double rate = kind == EDGE_FLOATS ? 0 : CASES[i % 4].rate;
        fracture_rig r;
        vec2 tip = loaded_edge(&r, kind, wide, 1e6, DOWN, 0);
        r.bodies.velocity[r.hull].z = CASES[i % 4].surface;
        stood(&r, CASES[i % 4].before);
        ck_assert_int_eq(fracture_rig_break(&r), 1);
        assert_absolute(vec3_length(r.events.data[0].momentum_lost), 0, 1e-9);
        int pieces = 0;
        for (int32_t k = 0; k < r.floes.count; k++) {
            if (!came_off(&r, k))
                continue;
            pieces++;
            int32_t body = r.floes.body[k];
            vec2 load = at_the_load(&r, body, tip, wide);
            vec3 at = {load.x, load.y, r.bodies.position[body].z};
            assert_absolute(body_point_velocity(&r.bodies, body, at).z, rate, 0.01 * fabs(rate) + 1e-12);
            polygon p = fracture_rig_outline(&r, k);
            double least = HUGE_VAL;
            for (int32_t m = 0; m < p.count; m++) {
                vec3 corner = body_to_global(&r.bodies, body, (vec3){p.vertex[m].x, p.vertex[m].y, 0});
                least = fmin(least, fabs(body_point_velocity(&r.bodies, body, corner).z));
            }
            ck_assert_double_le(least, 0.2 * fabs(rate) + 1e-12);
        }
        ck_assert_int_ge(pieces, wide ? 4 : 3);
        fracture_rig_free(&r);
    }
}
END_TEST

/* Pieces of an edge that is rigid until it breaks come off at rest. */
START_TEST(rigid_edges)
{
    for (int kind = EDGE_OF_SHEET; kind <= EDGE_FLOATS; kind++) {
        fracture_rig r;
        loaded_edge(&r, (edge_kind)kind, true, 1e6, 0, 0);
        r.settings.edges_give = false;
        r.bodies.velocity[r.hull].z = -0.3;
        ck_assert_int_eq(fracture_rig_break(&r), 1);
        for (int32_t k = 0; k < r.floes.count; k++)
            if (came_off(&r, k))
                assert_absolute(r.bodies.velocity[r.floes.body[k]].z, 0, 1e-12);
        fracture_rig_free(&r);
    }
}
END_TEST

TEST_MAIN("fracture_wide", plates, floes_are_beams, narrow, round_a_stem, sheets, openings_in_a_strip, slit_in_a_floe,
          pieces_stay_bent, pieces_of_each_load, pieces_go_on, rigid_edges)

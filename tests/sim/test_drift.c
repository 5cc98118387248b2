/* Level ice that drifts: the same loads as a ship that comes to it, books of mass and momentum, channels that stay,
   curved and reversed drift, a floe with inertia that stops. */
#include "scene.h"

#include "base/transcendental.h"
#include "sim/build_level.h"
#include "sim/controls.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A ship that stands still, and a sheet whose edge is 2 m before its bow. */
static const char *const FIXED_SHIP =
    "run: {duration: 100, time_step: 0.02, scale: 30}\n"
    "vessel:\n  mode: prescribed\n  speed: 0\n"
    "  hull: {form: icebreaker, length: 40, beam: 10, draught: 4, freeboard: 3,\n"
    "         stem_angle_deg: 30, entrance_angle_deg: 35, flare_angle_deg: 12,\n"
    "         stern_angle_deg: 35, parallel_midbody: 0.4}\n"
    "ice: {source: level, thickness: 0.5, breakable: true, level: {x_min: 22, tile_size: 20}}\n"
    "domain: {x_min: -58, x_max: 62, y_min: -30, y_max: 30, boundary: feeding, drift_speed: 1,\n"
    "         drift_direction_deg: 180}\n"
    "environment: {current_speed: 1, current_direction_deg: 180}\n";

/* The same ship, driven into the same ice at rest: seams at the same places in the ice. */
static const char *const MOVING_SHIP[] = {"vessel.speed=1",          "domain.boundary=open",
                                          "domain.drift_speed=auto", "environment.current_speed=0",
                                          "domain.x_max=102",        "run.time_step=0.02"};

/* Ice without a ship. */
static const char *const ALONE = "run: {duration: 100, time_step: 0.05, scale: 30}\n"
                                 "vessel: {present: false}\n"
                                 "ice: {source: level, thickness: 0.5, breakable: true,\n"
                                 "      level: {openings: [{x: 30, length: 40, width: 8, angle_deg: 20}]}}\n"
                                 "domain: {x_min: -50, x_max: 50, y_min: -30, y_max: 30, boundary: feeding,\n"
                                 "         drift_speed: 1}\n";

/* All ice there is and was: constant. */
static double booked(const scene *k)
{
    const clock_table *c = &k->w.clock;
    return scene_ice_mass(k) + c->ice_left[0] + c->ice_lost[0] - c->ice_gained[0] + c->ice_crushed[0] +
           c->brash_mass[0] - k->w.drift.entered[0];
}

static vec3 load_on_ship(const scene *k) { return k->w.scratch.ice_loads.data[0].total.force; }

/* Area of the sheet inside a rectangle that is given where the sheet was at the start. */
static double ice_in(const scene *k, double x, double y, double length, double width)
{
    vec2 m = k->w.drift.moved[0];
    vec2 box[4] = {{x + m.x, y + m.y},
                   {x + m.x + length, y + m.y},
                   {x + m.x + length, y + m.y + width},
                   {x + m.x, y + m.y + width}};
    double sum = 0;
    for (int32_t i = 0; i < k->w.floes.count; i++) {
        int32_t body = k->w.floes.body[i];
        if (body < 0 || k->w.floes.tile[i] == 0)
            continue;
        polygon p = shape_outline(&k->w.shapes, k->w.bodies.shape[body]);
        vec2 at[512];
        vec3 r = k->w.bodies.position[body];
        ck_assert_int_le(p.count, 512);
        for (int32_t n = 0; n < p.count; n++)
            at[n] = vec2_make(r.x + p.vertex[n].x, r.y + p.vertex[n].y);
        sum += polygon_overlap_area((polygon){at, p.count}, (polygon){box, 4});
    }
    return sum;
}

/* ---- whichever moves ---- */

typedef struct history {
    double mean, largest;
    int64_t breaks;
    int first_break; /* step */
} history;

static history history_of(scene *k, int steps)
{
    history h = {0, 0, 0, -1};
    for (int i = 0; i < steps; i++) {
        scene_steps(k, 1);
        double force = vec3_length(load_on_ship(k));
        h.mean += force / steps;
        h.largest = fmax(h.largest, force);
        if (h.first_break < 0 && k->w.clock.bendings[0] > 0)
            h.first_break = i;
    }
    h.breaks = k->w.clock.bendings[0];
    return h;
}

/* A sheet drifts onto a ship that is held, or the ship comes to a sheet that is held, with the water at rest in the
   ice: the same first contact, the same load up to the first break and after it, at two time steps.  Rounding differs,
   so that pieces part in time: the mean over 10 s is then the same to a few per cent. */
START_TEST(whichever_moves)
{
    int halvings = getenv("FRAM_TEST_SHORT") ? 1 : 2;
    for (int fine = 0; fine < halvings; fine++) {
        const char *step = fine ? "run.time_step=0.01" : "run.time_step=0.02";
        const char *towed[6];
        memcpy(towed, MOVING_SHIP, sizeof towed);
        towed[5] = step;
        scene drifts, comes;
        scene_open_with(&drifts, FIXED_SHIP, &step, 1);
        scene_open_with(&comes, FIXED_SHIP, towed, 6);
        int scale = fine ? 2 : 1;
        /* To the first touch, and on to the first break. */
        int i = 0;
        for (; drifts.w.clock.bendings[0] == 0 && i < 600 * scale; i++) {
            scene_steps(&drifts, 1);
            scene_steps(&comes, 1);
            vec3 a = load_on_ship(&drifts), b = load_on_ship(&comes);
            ck_assert_msg(vec3_length(vec3_sub(a, b)) <= 1e-4 * (1e5 + vec3_length(b)),
                          "step %d: %g N of ice that drifts, %g N of ice that is met", i, a.x, b.x);
        }
        ck_assert_int_eq(comes.w.clock.bendings[0], drifts.w.clock.bendings[0]);
        ck_assert_int_lt(i, 600 * scale);
        history a = history_of(&drifts, 500 * scale), b = history_of(&comes, 500 * scale);
        ck_assert_msg(fabs(a.mean - b.mean) < 0.1 * b.mean, "mean %g and %g N", a.mean, b.mean);
        /* Counts of some twenty scatter by their root. */
        ck_assert_msg((double)llabs(a.breaks - b.breaks) <= 1 + sqrt((double)b.breaks), "%lld and %lld breaks",
                      (long long)a.breaks, (long long)b.breaks);
        ck_assert_int_gt(b.breaks, 5);
        scene_close(&drifts);
        scene_close(&comes);
    }
}
END_TEST

/* ---- books ---- */

/* Tiles know where their ice stood at the start, those that entered later and those that are left after breaks too. */
static void check_places(const scene *k)
{
    for (int32_t i = 0; i < k->w.floes.count; i++) {
        if (k->w.floes.body[i] < 0 || k->w.floes.tile[i] == 0)
            continue;
        vec3 at = k->w.bodies.position[k->w.floes.body[i]];
        vec2 was = vec2_sub(vec2_make(at.x, at.y), k->w.drift.moved[0]);
        assert_absolute(vec2_length(vec2_sub(k->w.floes.ice_origin[i], was)), 0, 1e-9);
    }
}

/* Ice that enters, leaves, breaks and is crushed: nothing gets lost; the ship meets what the sheet and the pieces give.
 */
START_TEST(nothing_gets_lost)
{
    scene k;
    scene_open(&k, FIXED_SHIP);
    double start = scene_ice_mass(&k);
    int steps = 1500;
    for (int i = 0; i < steps; i++) {
        scene_steps(&k, 1);
        assert_relative(booked(&k), start, 1e-11);
    }
    ck_assert(k.w.drift.entered[0] > 1e5 && k.w.clock.bendings[0] > 10 && k.w.drift.broken[0] > 0);
    check_places(&k);
    assert_relative(k.w.drift.moved[0].x, -steps * 0.02, 1e-9);
    ck_assert(fabs(k.w.drift.moved[0].y) < 1e-9);
    scene_close(&k);
}
END_TEST

/* What breaks off has the velocity of the sheet, and so does its momentum. */
START_TEST(pieces_have_the_velocity_of_the_sheet)
{
    scene k;
    scene_open(&k, FIXED_SHIP);
    int found = 0;
    for (int i = 0; i < 600 && found < 3; i++) {
        int32_t next = k.w.clock.next_floe[0];
        scene_steps(&k, 1);
        if (k.w.scratch.fractures.count == 0 || k.w.clock.step[0] < 10)
            continue;
        const fracture_event *e = &k.w.scratch.fractures.data[0];
        assert_absolute(e->momentum_lost.x, -(e->mass_lost - e->mass_gained), 1e-6 * (1 + e->mass_lost));
        for (int32_t f = 0; f < k.w.floes.count; f++) {
            int32_t body = k.w.floes.body[f];
            if (body < 0 || k.w.floes.number[f] < next || k.w.floes.tile[f] != 0)
                continue;
            assert_absolute(k.w.bodies.velocity[body].x, -1, 1e-7);
            found++;
        }
    }
    ck_assert_int_ge(found, 3);
    scene_close(&k);
}
END_TEST

/* ---- where the sheet goes ---- */

/* Once around a circle: every tile is where the drift took it, seams are closed, what the openings left is there, and
   the window is covered. */
START_TEST(curved_drift)
{
    scene k;
    scene_open(&k, ALONE);
    double start = scene_ice_mass(&k), before = ice_in(&k, 5, -25, 40, 50), moved_x = 0, moved_y = 0;
    ck_assert(before > 1000 && before < 40 * 50 - 200);
    int steps = 4000;
    k.m.drift_given = true;
    for (int i = 1; i <= steps; i++) {
        double angle = 2 * PI * i / steps;
        k.m.drift = vec2_make(2 * real_cos(angle), 2 * real_sin(angle));
        moved_x += 0.05 * k.m.drift.x;
        moved_y += 0.05 * k.m.drift.y;
        scene_steps(&k, 1);
        assert_absolute(k.w.drift.moved[0].x, moved_x, 5e-10);
        assert_absolute(k.w.drift.moved[0].y, moved_y, 5e-10);
        if (i % 400 != 0)
            continue;
        /* The whole domain is ice but for the lead. */
        double all = ice_in(&k, -50 - moved_x, -30 - moved_y, 100, 60);
        ck_assert_msg(all >= 6000 - 321 && all <= 6000 + 1e-6, "%g m2 of ice in step %d", all, i);
        assert_relative(booked(&k), start, 1e-11);
    }
    /* 64 m off at most, and back: the lead is where it was. */
    assert_relative(ice_in(&k, 5, -25, 40, 50), before, 1e-9);
    assert_absolute(vec2_length(k.w.drift.moved[0]), 0, 1e-6);
    ck_assert_int_gt(k.w.clock.next_floe[0], 100);
    scene_close(&k);
}
END_TEST

/* The sheet drifts onto the ship for 30 s, goes back until the channel has left the window, and comes again: the
   ship meets its own channel, open, and next to nothing breaks: sharp tips of its walls, which bear little. */
START_TEST(reversal_keeps_the_channel)
{
    if (getenv("FRAM_TEST_SHORT"))
        return; /* ten thousand steps of code that the other tests walk too */
    scene k;
    scene_open(&k, FIXED_SHIP);
    history forth = history_of(&k, 1500);
    ck_assert_int_gt(forth.breaks, 10);
    double cut = ice_in(&k, 22, -6, 6, 12), beside = ice_in(&k, 22, 16, 6, 10);
    ck_assert_msg(cut < 20 && beside > 59.9, "%g m2 in the channel, %g beside", cut, beside);
    int64_t breaks = k.w.clock.bendings[0];
    double crushed = k.w.clock.ice_crushed[0];
    /* Back, until the edge of the sheet is clear of the window, and on. */
    k.m.drift_given = true;
    k.m.drift = vec2_make(2, 0);
    k.m.media.current = vec3_make(2, 0, 0);
    scene_steps(&k, 1800);
    ck_assert(k.w.drift.moved[0].x > 40 && k.w.drift_cells.count > 0);
    ck_assert_msg(k.w.clock.bendings[0] <= breaks + forth.breaks / 5, "%lld breaks on the way back",
                  (long long)(k.w.clock.bendings[0] - breaks));
    ck_assert(k.w.clock.ice_crushed[0] <= crushed + 2000);
    /* And onto the ship again: the channel is there to where it ended. */
    k.m.drift = vec2_make(-2, 0);
    k.m.media.current = vec3_make(-2, 0, 0);
    scene_steps(&k, 1650);
    /* The hull rubs its walls, a tip of which may break: of 72 m2. */
    double again = ice_in(&k, 22, -6, 6, 12);
    ck_assert_msg(again <= cut + 1e-6 && again > cut - 2, "%g m2 of ice in the channel, before %g", again, cut);
    assert_absolute(ice_in(&k, 22, 16, 6, 10), beside, 1e-6);
    ck_assert_msg(k.w.clock.bendings[0] <= breaks + forth.breaks / 5, "%lld breaks in the old channel",
                  (long long)(k.w.clock.bendings[0] - breaks));
    scene_close(&k);
}
END_TEST

/* ---- inertia ---- */

/* A floe of 400 m by 100 m that meets a pier 4 m wide and crushes: it stops after d = M v^2 / (2 sigma w h). */
static const char *const PIER =
    "run: {duration: 100, time_step: 0.02, scale: 30}\n"
    "vessel:\n  mode: prescribed\n  speed: 0\n  x: 0\n"
    "  hull: {form: box, length: 4, beam: 4, draught: 4, freeboard: 3}\n"
    "ice: {source: level, thickness: 0.5, density: 900, breakable: false,\n"
    "      keep_out_margin: 0, crushing_strength: 2.0e6, friction: {ice_hull_static: 0, ice_hull_kinetic: 0},\n"
    "      level: {x_min: 2.01, x_max: 402.01, y_min: -50, y_max: 50, line_load: 0}}\n"
    "domain: {x_min: -40, x_max: 60, y_min: -40, y_max: 40, boundary: feeding,\n"
    "         drift_speed: 0.5, drift_direction_deg: 180}\n"
    "environment: {ice_drag: {water_skin: 0, air_skin: 0}}\n";

START_TEST(a_floe_stops_after_the_distance_of_its_energy)
{
    int halvings = getenv("FRAM_TEST_SHORT") ? 1 : 2;
    for (int fine = 0; fine < halvings; fine++) {
        const char *step = fine ? "run.time_step=0.01" : "run.time_step=0.02";
        scene k;
        scene_open_with(&k, PIER, &step, 1);
        double mass = 400.0 * 100 * 0.5 * 900, force = 2e6 * 4 * 0.5, way = 0.5 * mass * 0.25 / force;
        assert_relative(k.w.drift.mass[0], mass, 1e-12);
        int steps = fine ? 800 : 400;
        double last = k.w.drift.velocity[0].x;
        for (int i = 0; i < steps; i++) {
            scene_steps(&k, 1);
            double v = k.w.drift.velocity[0].x;
            ck_assert_msg(v >= last - 1e-12, "it goes faster: %g, %g", last, v);
            last = v;
        }
        double end = -k.w.drift.moved[0].x - 0.01;
        /* It stops within a step of crushing, and less than the mass that was crushed of the momentum. */
        ck_assert_msg(fabs(end - way) < 0.02 * way, "stops after %g m, energy says %g m", end, way);
        ck_assert_msg(fabs(last) < 0.01, "still at %g m/s", last);
        scene_close(&k);
    }
}
END_TEST

/* Open water in a floe is no mass of it, nor what reaches out of it, nor twice where openings overlap. */
START_TEST(basins_have_no_mass)
{
    static const char text[] =
        "vessel: {present: false}\n"
        "ice:\n  source: level\n  thickness: 0.5\n  density: 900\n"
        "  level:\n    x_min: 0\n    x_max: 400\n    y_min: -50\n    y_max: 50\n    line_load: 0\n"
        "    openings:\n"
        "      - {x: 100, length: 40, width: 50}\n"
        "      - {x: 120, y: 10, length: 20, width: 20}\n"
        "      - {x: 400, y: -50, length: 100, width: 60}\n"
        "domain: {x_min: -40, x_max: 60, y_min: -40, y_max: 40, boundary: feeding}\n";
    static const char *const all[] = {"ice.level.openings[0].x=200", "ice.level.openings[0].length=420",
                                      "ice.level.openings[0].width=120"};
    scene k;
    scene_open(&k, text);
    double area = 400.0 * 100 - (40.0 * 50 + 10 * 20 + 50 * 30);
    assert_relative(k.w.drift.mass[0], area * 0.5 * 900, 1e-9);
    scene_close(&k);
    check_refusal(text, all, 3, "ice.level.openings");
}
END_TEST

/* A sheet without four edges has the mass of a domain full of ice, however large its tiles are and however little of it
   is there at the start, since more comes in; the concentration that is told is what is there.  A mass that is given is
   kept, and what breaks off takes none of it along. */
START_TEST(tiles_do_not_weigh_on_a_sheet)
{
    static const char text[] =
        "vessel: {present: false}\n"
        "ice:\n  source: level\n  thickness: 0.8\n  density: 920\n  breakable: true\n"
        "  level:\n    x_min: 15\n    line_load: 0\n    openings: [{x: 60, length: 20, width: 30}]\n"
        "domain: {x_min: -60, x_max: 60, y_min: -40, y_max: 40, boundary: feeding, drift_speed: 0.8,\n"
        "         drift_direction_deg: 180}\n";
    static const char *const size[] = {"ice.level.tile_size=8", "ice.level.tile_size=auto", "ice.level.tile_size=100"};
    double mass = 120.0 * 80 * 0.8 * 920, ice = (45.0 * 80 - 10 * 30) * 0.8 * 920;
    for (int i = 0; i < 3; i++) {
        scene k;
        scene_open_with(&k, text, &size[i], 1);
        assert_relative(k.w.drift.mass[0], mass, 1e-9);
        ck_assert_double_gt(k.w.drift.ice[0], ice);
        assert_relative(build_ice_in_domain(&k.s), ice, 1e-9);
        world again;
        field_report report;
        fram_error error = {0};
        assert_ok(build_world(&k.ctx, &k.s, &k.m, &again, &report, &error), error);
        assert_relative(report.concentration, ice / mass, 1e-9);
        world_free(&k.ctx, &again);
        scene_close(&k);
        const char *const light[] = {size[i], "ice.level.mass=1e6"};
        scene_open_with(&k, text, light, 2);
        assert_absolute(k.w.drift.mass[0], 1e6, 0);
        k.w.drift.ice[0] += 5e5; /* as if so much had broken off */
        scene_steps(&k, 1);
        assert_absolute(k.w.drift.broken[0], 5e5, 1);
        assert_absolute(k.w.drift.mass[0], 1e6, 0);
        scene_close(&k);
        for (int outside = 0; outside < 2; outside++) {
            const char *const edge[] = {size[i], outside ? "ice.level.x_min=70" : "ice.level.x_min=59.9"};
            scene_open_with(&k, text, edge, 2);
            assert_relative(k.w.drift.mass[0], mass, 1e-9);
            k.s.ice.level.openings.data[0].length = k.s.ice.level.openings.data[0].width = 400;
            assert_absolute(build_ice_in_domain(&k.s), outside ? mass : 0, 1e-3);
            scene_close(&k);
        }
    }
}
END_TEST

/* A floe that is broken up has a mass still, so that what pushes on it divides by it. */
START_TEST(a_broken_floe_keeps_a_mass)
{
    static const char *const light[] = {"ice.level.mass=1e6"};
    scene k;
    scene_open_with(&k, PIER, light, 1);
    k.w.drift.ice[0] += 6e5;
    scene_steps(&k, 1);
    assert_relative(k.w.drift.mass[0], 4e5, 1e-6);
    k.w.drift.ice[0] += 6e5;
    scene_steps(&k, 1);
    assert_relative(k.w.drift.mass[0], 1e3, 1e-9);
    ck_assert(isfinite(k.w.drift.velocity[0].x));
    scene_close(&k);
}
END_TEST

/* The sheet is crushed at the pier, drifts back by 1 m and comes again: nothing before the old face, and ice at it. */
START_TEST(no_load_before_the_old_face)
{
    static const char *const driven[] = {"ice.level.line_load=auto"};
    scene k;
    scene_open_with(&k, PIER, driven, 1);
    scene_steps(&k, 100);
    double face = k.w.drift.moved[0].x;
    ck_assert(load_on_ship(&k).x < -3e6);
    k.m.drift_given = true;
    k.m.drift = vec2_make(0.5, 0);
    scene_steps(&k, 100);
    ck_assert(fabs(load_on_ship(&k).x) < 1);
    k.m.drift = vec2_make(-0.5, 0);
    double first = HUGE_VAL;
    for (int i = 0; i < 130 && first == HUGE_VAL; i++) {
        scene_steps(&k, 1);
        if (fabs(load_on_ship(&k).x) > 1)
            first = k.w.drift.moved[0].x;
    }
    /* The edge threshold is 0.15 m, and a step 1 cm. */
    ck_assert_msg(fabs(first - face) < 0.15 + 0.02, "ice %g m before the old face", first - face);
    ck_assert(k.w.clock.ice_crushed[0] > 0);
    scene_close(&k);
}
END_TEST

/* Ice far away that drives with no more than 1000 N/m of 80 m: the sheet stops at a pier that takes more, and M dv/dt
   is the sum of its forces in every step. */
START_TEST(a_limited_drive)
{
    static const char *const limited[] = {"ice.level.line_load=1000", "ice.level.x_max=auto", "ice.level.y_min=auto",
                                          "ice.level.y_max=auto", "ice.level.mass=2e6"};
    scene k;
    scene_open_with(&k, PIER, limited, 5);
    double most = 0;
    for (int i = 0; i < 600; i++) {
        double before = k.w.drift.velocity[0].x, load = k.w.drift.load[0].x;
        scene_steps(&k, 1);
        const drift_table *d = &k.w.drift;
        double change = (load + d->drive[0].x + d->fluid[0].x) * 0.02 / d->mass[0];
        assert_absolute(d->velocity[0].x - before, change, 1e-12);
        most = fmax(most, fabs(d->drive[0].x));
        ck_assert(fabs(load_on_ship(&k).x + d->load[0].x) <= 1e-9 * (1 + fabs(d->load[0].x)));
    }
    assert_relative(most, 80e3, 1e-12);
    ck_assert_msg(fabs(k.w.drift.velocity[0].x) < 0.05, "%g m/s", k.w.drift.velocity[0].x);
    scene_close(&k);
}
END_TEST

/* With more than the pier takes, it drifts on. */
START_TEST(an_ample_drive)
{
    static const char *const ample[] = {"ice.level.line_load=1e5", "ice.level.x_max=auto", "ice.level.y_min=auto",
                                        "ice.level.y_max=auto", "ice.level.mass=2e6"};
    scene k;
    scene_open_with(&k, PIER, ample, 5);
    scene_steps(&k, 300);
    assert_absolute(k.w.drift.velocity[0].x, -0.5, 0.05);
    ck_assert(load_on_ship(&k).x < -3e6);
    scene_close(&k);
}
END_TEST

/* Without a drive, water drags the floe along: dv/dt = rho_w C A (u - v)^2 / (2 M). */
START_TEST(water_takes_a_floe_along)
{
    static const char *const drag[] = {"environment.ice_drag.water_skin=0.005", "environment.current_speed=1",
                                       "environment.current_direction_deg=0", "domain.drift_speed=0.0001",
                                       "vessel.present=false"};
    scene k;
    scene_open_with(&k, PIER, drag, 5);
    scene_steps(&k, 1000);
    /* u - v = 1 / (1 + a t) with a = rho_w C / (2 rho_i h). */
    double a = 1025 * 0.005 / (2 * 900 * 0.5), v = 1 - 1 / (1 + a * 20);
    assert_absolute(k.w.drift.velocity[0].x, v, 2e-4);
    scene_close(&k);
}
END_TEST

/* The same in a current that grows weaker with depth: the sheet meets that in the middle of its wet part, as floes do.
 */
START_TEST(water_takes_a_sheet_along_at_its_depth)
{
    char path[] = "/tmp/fram-profile-XXXXXX", profile[80];
    int file = mkstemp(path);
    ck_assert(file >= 0 && dprintf(file, "depth,x,y\n0,1,0\n1,0,0\n") > 0);
    close(file);
    snprintf(profile, sizeof profile, "environment.current_profile_file=%s", path);
    const char *const drag[] = {"environment.ice_drag.water_skin=0.005", profile, "domain.drift_speed=0.0001",
                                "vessel.present=false"};
    scene k;
    scene_open_with(&k, PIER, drag, 4);
    unlink(path);
    scene_steps(&k, 1000);
    double u = 1 - 0.5 * 0.5 * 900 / 1025, a = u * 1025 * 0.005 / (2 * 900 * 0.5), v = u * (1 - 1 / (1 + a * 20));
    assert_absolute(k.w.drift.velocity[0].x, v, 2e-4);
    scene_close(&k);
}
END_TEST

/* ---- what is refused ---- */

START_TEST(refusals_name_their_key)
{
    static const char *const held[] = {"domain.boundary=open", "domain.drift_speed=auto", "ice.level.line_load=1"};
    static const char *const mass[] = {"ice.level.mass=1e6"};
    static const char *const loose[] = {"ice.level.anchored_y_max=false"};
    static const char *const order[] = {"ice.level.x_max=3"};
    check_refusal(FIXED_SHIP, held, 3, "ice.level.line_load");
    check_refusal(FIXED_SHIP, mass, 1, "ice.level.mass");
    check_refusal(FIXED_SHIP, loose, 1, "ice.level.anchored_y_max");
    check_refusal(FIXED_SHIP, order, 1, "ice.level.x_max");
}
END_TEST

static control control_named(const control_array *list, const char *name)
{
    int32_t i = 0;
    while (i < list->count && strcmp(list->data[i].name, name) != 0)
        i++;
    ck_assert_msg(i < list->count, "no input %s", name);
    return list->data[i];
}

/* A program turns the drift about, as it may that of an endless field: the sheet goes there, and comes in from there.
 */
START_TEST(drifts_as_it_is_told)
{
    scene k;
    fram_error error = {0};
    control_array list = {0};
    scene_open(&k, ALONE);
    ck_assert(controls_list(&k.ctx, &k.s, &k.m, &k.w, &list));
    control x = control_named(&list, "ice_drift_x"), y = control_named(&list, "ice_drift_y");
    assert_absolute(control_get(&k.m, &k.w, &x), 1, 1e-12);
    assert_absolute(control_get(&k.m, &k.w, &y), 0, 1e-12);
    assert_ok(control_set(&k.ctx, &k.m, &k.w, &x, -4, &error), error);
    assert_ok(control_set(&k.ctx, &k.m, &k.w, &y, 0.5, &error), error);
    double entered = k.w.drift.entered[0];
    scene_steps(&k, 200);
    assert_absolute(k.w.drift.moved[0].x, -40, 1e-6);
    assert_absolute(k.w.drift.moved[0].y, 5, 1e-6);
    ck_assert_double_gt(k.w.drift.entered[0], entered);
    array_free(&k.ctx, &list);
    scene_close(&k);
}
END_TEST

TEST_MAIN("drift", drifts_as_it_is_told, whichever_moves, nothing_gets_lost, pieces_have_the_velocity_of_the_sheet,
          curved_drift, reversal_keeps_the_channel, a_floe_stops_after_the_distance_of_its_energy, basins_have_no_mass,
          tiles_do_not_weigh_on_a_sheet, a_broken_floe_keeps_a_mass, no_load_before_the_old_face, a_limited_drive,
          an_ample_drive, water_takes_a_floe_along, water_takes_a_sheet_along_at_its_depth, refusals_name_their_key)

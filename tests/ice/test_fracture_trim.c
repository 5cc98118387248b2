/* How far a hull has drawn back from ice: what decides when the crushed ice goes; and that a floe which floats keeps
   the notch of a ram (docs/decisions/0177). */
#include "sheet_rig.h"

#include "ice_rig.h"

static const double SPEED = 0.5;

static const vec2 box_plan[] = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
/* With a notch in the stern, as for a tow. */
static const vec2 notched_plan[] = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}, {-5, 1}, {-3, 1}, {-3, -1}, {-5, -1}};

/* The hull becomes one of this plan, 10 m high. */
static void make_hull(fracture_rig *r, solid_array *solids, polygon plan)
{
    fram_error e = {0};
    int32_t index, shape;
    mesh box = {0};
    assert_ok(mesh_make_prism(&r->ctx, plan, -5, 5, &box, &e), e);
    polyhedron_array pieces = {0};
    ck_assert(array_push(&r->ctx, &pieces, (polyhedron){.radius = 0}));
    assert_ok(polyhedron_hull(&r->ctx, box.vertex.data, box.vertex.count, 1e-9, &pieces.data[0], &e), e);
    r->shapes.solids = solids;
    assert_ok(solid_add(&r->ctx, solids, &box, &pieces, 0, &index, &e), e);
    assert_ok(shape_add_solid(&r->ctx, &r->shapes, index, &shape, &e), e);
    r->bodies.shape[r->hull] = shape;
}

/* A plate, and a hull of this plan that stands clear of it and is said to touch it with two patches. */
static int32_t start_with(fracture_rig *r, solid_array *solids, motion kind, polygon plan)
{
    fracture_rig_make(r);
    r->settings.crush_trims = true;
    const vec2 corner[4] = {{-20, -20}, {20, -20}, {20, 20}, {-20, 20}};
    int32_t row = fracture_rig_floe(r, (polygon){corner, 4}, 1, kind);
    make_hull(r, solids, plan);
    r->bodies.position[r->hull] = (vec3){-100, 0, 0};
    return row;
}

static int32_t start(fracture_rig *r, solid_array *solids, motion kind)
{
    return start_with(r, solids, kind, (polygon){box_plan, 4});
}

/* One step in which the hull moves along x and its two patches carry nothing. */
static vec3 step(fracture_rig *r, int32_t row, double speed)
{
    r->bodies.velocity[r->hull] = (vec3){speed, 0, 0};
    for (int i = 0; i < 2; i++) {
        ck_assert(fracture_rig_load(r, row, (vec2){-20, i ? 4 : -4}, 0, 0.5));
        r->patches.data[i].normal = (vec3){1, 0, 0};
    }
    ck_assert_int_eq(fracture_rig_break(r), 0);
    return r->floes.retreat[row];
}

/* The way back is the hull's own, however many patches it has on the floe, and starts anew where it presses on. */
START_TEST(retreat_is_the_way_of_the_hull)
{
    fracture_rig r;
    solid_array solids = {0};
    int32_t row = start(&r, &solids, MOTION_STATIC);
    for (int turn = 0; turn < 2; turn++) {
        for (int i = 1; i <= 10; i++)
            assert_vec3_close(step(&r, row, -SPEED), ((vec3){-SPEED * i * r.settings.time_step, 0, 0}), 1e-15);
        for (int i = 0; i < 3; i++)
            assert_vec3_close(step(&r, row, SPEED), ((vec3){0, 0, 0}), 0);
    }
    fracture_rig_free(&r);
    solid_array_free(&r.ctx, &solids);
}
END_TEST

/* A hull that reaches into the top of a floating floe alone, as over a floe under its bottom, cuts nothing out of it.
 */
START_TEST(a_floe_under_a_hull_stays)
{
    fracture_rig r;
    solid_array solids = {0};
    int32_t row = start(&r, &solids, MOTION_DYNAMIC);
    r.settings.crush_notches = true;
    r.bodies.position[r.hull] = (vec3){-17, 0, 5.2};
    for (int i = 0; i < 60; i++)
        (void)step(&r, row, -SPEED);
    ck_assert_int_eq(r.floes.number[row], 0);
    ck_assert_double_eq(r.crushed, 0);
    fracture_rig_free(&r);
    solid_array_free(&r.ctx, &solids);
}
END_TEST

/* A hull among two plates takes its place out of each, in the frame of each, of whatever thickness: what it cuts is
   found anew unless both lie alike.  A notch on its far side is nothing to the ice. */
START_TEST(plates_that_lie_side_by_side)
{
    for (int notched = 0; notched < 2; notched++) {
        fracture_rig r;
        solid_array solids = {0};
        polygon plan = notched ? (polygon){notched_plan, 8} : (polygon){box_plan, 4};
        int32_t row[2] = {start_with(&r, &solids, MOTION_STATIC, plan), -1};
        const vec2 corner[4] = {{-20, 20}, {20, 20}, {20, 100}, {-20, 100}};
        row[1] = fracture_rig_floe(&r, (polygon){corner, 4}, 1, MOTION_STATIC);
        r.bodies.position[r.hull] = (vec3){-22, 20, 0};
        r.bodies.velocity[r.hull] = (vec3){SPEED, 0, 0};
        for (int i = 0; i < 2; i++) {
            ck_assert(fracture_rig_load(&r, row[i], (vec2){-20, i ? -38 : 18}, 0, 0.5));
            r.patches.data[r.patches.count - 1].normal = (vec3){1, 0, 0};
        }
        (void)fracture_rig_break(&r);
        /* From x = -20 to -17 less the rim, 5 m less the rim to both sides of y = 20. */
        double rim = r.settings.edge_threshold, area = 2 * (3 - rim) * (5 - rim);
        assert_relative(r.crushed, 920 * area, 1e-9);
        fracture_rig_free(&r);
        solid_array_free(&r.ctx, &solids);
    }
}
END_TEST

/* A floe that floats loses the whole section, notch and all, of a hull that has drawn back from it. */
START_TEST(a_notch_stays_ice)
{
    fracture_rig r;
    solid_array solids = {0};
    int32_t row = start_with(&r, &solids, MOTION_DYNAMIC, (polygon){notched_plan, 8});
    r.settings.crush_notches = true;
    double back = 0;
    r.bodies.position[r.hull] = (vec3){-16, 0, 0};
    while (r.floes.number[row] == 0 && back < 1) {
        (void)step(&r, row, -SPEED);
        back += SPEED * r.settings.time_step;
    }
    /* It is where it was when it last pressed on, the step before the first: 10 m wide from -20 on, 2 x 1 m of notch.
     */
    assert_absolute(back, r.settings.edge_threshold, 2 * SPEED * r.settings.time_step);
    assert_absolute(r.crushed, 920 * ((9 + back) * 10 - 2 * (1 + back)), 1);
    fracture_rig_free(&r);
    solid_array_free(&r.ctx, &solids);
}
END_TEST

/* A trim that no sound outline is left of, here with a slot that ends nanometres before what the hull has reached,
   leaves its tile as it is: in the first step of a run or of one that goes on, too, which knows no tiles yet. */
START_TEST(a_refused_trim_leaves_the_tile)
{
    static const vec2 SLOT[] = {{-15 + 3e-9, -1}, {30, -1}, {30, 1}, {-15 + 3e-9, 1}};
    fracture_rig r;
    solid_array solids = {0};
    polygon_list openings = {0};
    double back = 1.05 * fracture_rig_settings().edge_threshold;
    fracture_rig_make(&r);
    r.settings.crush_trims = true;
    ck_assert(polygon_list_push(&r.ctx, &openings, (polygon){SLOT, 4}));
    sheet_make(&r, (box2){{-20, -20}, {20, 20}}, 40, &openings);
    make_hull(&r, &solids, (polygon){box_plan, 4});
    r.bodies.position[r.hull] = (vec3){-20 - back, 0, 0};
    r.bodies.velocity[r.hull] = (vec3){-back / r.settings.time_step, 0, 0};
    ck_assert(sheet_load(&r, (vec2){-16, 0}, 0, 0.5));
    r.patches.data[0].normal = (vec3){1, 0, 0};
    ck_assert_int_eq(fracture_rig_break(&r), 0);
    ck_assert_int_eq(sheet_count(&r, true), 1);
    ck_assert_int_eq(r.floes.number[0], 0);
    ck_assert_double_eq(r.crushed, 0);
    polygon_list_free(&r.ctx, &openings);
    fracture_rig_free(&r);
    solid_array_free(&r.ctx, &solids);
}
END_TEST

/* ---- several hulls on one floe ---- */

enum { HULLS = 3, ROWS = 2 };

/* One step in which each hull moves at its speed along x and has two patches on each floe. */
static void step_all(fracture_rig *r, const int32_t *hull, const int32_t *row, const double *speed)
{
    for (int f = 0; f < ROWS; f++)
        for (int h = 0; h < HULLS; h++) {
            r->bodies.velocity[hull[h]] = (vec3){speed[h], 0, 0};
            for (int i = 0; i < 2; i++) {
                ck_assert(fracture_rig_load(r, row[f], (vec2){-20, i ? 4 : -4}, 0, 0.5));
                crushing_patch *p = &r->patches.data[r->patches.count - 1];
                p->normal = (vec3){1, 0, 0};
                p->surface_body = r->contacts.data[r->contacts.count - 1].b = hull[h];
            }
        }
    ck_assert_int_eq(fracture_rig_break(r), 0);
}

static void start_all(fracture_rig *r, solid_array *solids, int32_t *hull, int32_t *row)
{
    row[0] = start(r, solids, MOTION_STATIC);
    const vec2 corner[4] = {{-20, 100}, {20, 100}, {20, 140}, {-20, 140}};
    row[1] = fracture_rig_floe(r, (polygon){corner, 4}, 1, MOTION_STATIC);
    hull[0] = r->hull;
    for (int32_t h = 1; h < HULLS; h++) {
        hull[h] = body_create(&r->ctx, &r->bodies, MOTION_PRESCRIBED, MATERIAL_HULL);
        r->bodies.shape[hull[h]] = r->bodies.shape[r->hull];
        r->bodies.position[hull[h]] = r->bodies.position[r->hull];
    }
    for (int32_t h = 0; h < HULLS; h++)
        r->bodies.owner[hull[h]] = h;
}

/* A hull that draws back has its own way in each floe, though others press on there or draw back at another speed;
   where it stands in the list of vessels does not matter.  What is kept goes when it is zero, and with its floe. */
START_TEST(each_hull_draws_back_by_itself)
{
    for (int first = 0; first < HULLS; first++) {
        fracture_rig r;
        solid_array solids = {0};
        int32_t hull[HULLS], row[ROWS];
        start_all(&r, &solids, hull, row);
        double speed[HULLS];
        for (int h = 0; h < HULLS; h++) /* one presses on, two draw back */
            speed[(first + h) % HULLS] = h == 0 ? SPEED : -h * SPEED;
        for (int i = 1; i <= 10; i++) {
            step_all(&r, hull, row, speed);
            for (int f = 0; f < ROWS; f++)
                for (int h = 0; h < HULLS; h++) {
                    vec3 way = {fmin(speed[h], 0) * i * r.settings.time_step, 0, 0};
                    assert_vec3_close(retreat_find(&r.retreats, &r.bodies, &r.floes, row[f], hull[h]), way, 1e-15);
                }
        }
        ck_assert_int_eq(r.retreats.count, ROWS * (first == 0 ? HULLS - 1 : HULLS - 2));
        floe_remove(&r.bodies, &r.shapes, &r.floes, row[1]);
        /* Another floe in the same row begins without. */
        const vec2 corner[4] = {{-20, 100}, {20, 100}, {20, 140}, {-20, 140}};
        ck_assert_int_eq(fracture_rig_floe(&r, (polygon){corner, 4}, 1, MOTION_STATIC), row[1]);
        for (int h = 0; h < HULLS; h++)
            assert_vec3_close(retreat_find(&r.retreats, &r.bodies, &r.floes, row[1], hull[h]), ((vec3){0, 0, 0}), 0);
        ck_assert(retreat_sweep(&r.ctx, &r.retreats, &r.floes));
        ck_assert_int_eq(r.retreats.count, first == 0 ? HULLS - 1 : HULLS - 2);
        for (int h = 0; h < HULLS; h++)
            speed[h] = SPEED;
        step_all(&r, hull, row, speed);
        ck_assert(retreat_sweep(&r.ctx, &r.retreats, &r.floes));
        ck_assert_int_eq(r.retreats.count, 0);
        fracture_rig_free(&r);
        solid_array_free(&r.ctx, &solids);
    }
}
END_TEST

/* ---- rams ---- */

/* A box 4 m wide beside a floe of 200 m by 200 m, both free, without friction and water. */
typedef struct ram {
    ice_rig r;
    fracture_scratch *scratch;
    fracture_settings settings;
    edge_load_table edge_loads;
    hull_retreat_table retreats;
    int32_t hull;
    double dt, crushed, gained;
} ram;

static const double HULL_WIDTH = 4, HULL_HALF = 10;

static void ram_make(ram *t, double dt, bool breakable)
{
    *t = (ram){.settings = fracture_rig_settings(), .dt = dt};
    ice_rig_make(&t->r, dt);
    int32_t row = ice_rig_plate(&t->r, 200, 200, 1, MOTION_DYNAMIC), ice = t->r.floes.body[row];
    t->r.floes.breakable[row] = breakable;
    vec3 lo = {-HULL_HALF, -HULL_WIDTH / 2, -3}, hi = {HULL_HALF, HULL_WIDTH / 2, 3};
    t->hull = ice_rig_box(&t->r, lo, hi, MOTION_DYNAMIC, MATERIAL_HULL);
    t->r.bodies.position[t->hull] = (vec3){-100 - HULL_HALF - 0.05, 0, 0};
    ice_rig_pair(&t->r, ice, t->hull);
    t->scratch = fracture_scratch_create(&t->r.ctx);
    t->settings.time_step = dt;
    t->settings.crush_trims = t->settings.crush_notches = true;
}

static void ram_free(ram *t)
{
    fracture_scratch_free(&t->r.ctx, t->scratch);
    table_free(&t->r.ctx, &t->edge_loads, &edge_load_table_info);
    table_free(&t->r.ctx, &t->retreats, &hull_retreat_table_info);
    ice_rig_free(&t->r);
}

/* The row of the only floe. */
static int32_t floe_of(const ram *t)
{
    int32_t row = -1;
    for (int32_t i = 0; i < t->r.floes.count; i++)
        if (t->r.floes.body[i] >= 0) {
            ck_assert_int_lt(row, 0);
            row = i;
        }
    ck_assert_int_ge(row, 0);
    return row;
}

/* One step; returns the force on the hull [N]. */
static double ram_step(ram *t)
{
    ice_rig *r = &t->r;
    fram_error e = {0};
    fracture_event_array events = {0};
    ice_rig_crush(r);
    ice_rig_solve(r);
    double force = 0;
    for (int32_t i = 0; i < r->contacts.count; i++)
        force += r->contacts.data[i].impulse[0] / t->dt;
    fracture_state state = ice_rig_fracture_state(r);
    state.crushed = &t->crushed;
    state.gained = &t->gained;
    state.edge_loads = &t->edge_loads;
    state.retreats = &t->retreats;
    assert_ok(fracture_run(&r->ctx, t->scratch, &t->settings, r->plane, &r->patches, &state, &events, &e), e);
    array_free(&r->ctx, &events);
    integrate_poses(&r->ctx, &r->bodies, t->dt);
    r->pairs.a[0] = r->floes.body[floe_of(t)] < t->hull ? r->floes.body[floe_of(t)] : t->hull;
    r->pairs.b[0] = r->floes.body[floe_of(t)] < t->hull ? t->hull : r->floes.body[floe_of(t)];
    return force;
}

/* Where the hull's face stands in the ice, from the old edge [m]. */
static double face(const ram *t)
{
    int32_t row = floe_of(t);
    vec3 tip = {t->r.bodies.position[t->hull].x + HULL_HALF, 0, 0};
    vec3 local = body_to_local(&t->r.bodies, t->r.floes.body[row], tip);
    return strength_place(&t->r.floes, row, (vec2){local.x, local.y}).x + 100;
}

/* The hull goes at this speed until it has stopped in the ice; the deepest place of its face, and where it met ice. */
static double ram_in(ram *t, double speed, double *met)
{
    double deepest = -HUGE_VAL;
    *met = HUGE_VAL;
    t->r.bodies.velocity[t->hull] = (vec3){speed, 0, 0};
    t->r.bodies.velocity[t->r.floes.body[floe_of(t)]] = (vec3){0, 0, 0};
    for (int i = 0; i * t->dt < 1.5; i++) {
        double at = face(t);
        if (ram_step(t) > 1 && *met == HUGE_VAL)
            *met = at;
        deepest = testing_larger(deepest, face(t));
    }
    return deepest;
}

/* Out again, until clear of the old edge. */
static void ram_out(ram *t)
{
    t->r.bodies.velocity[t->hull] = (vec3){-1, 0, 0};
    t->r.bodies.velocity[t->r.floes.body[floe_of(t)]] = (vec3){0, 0, 0};
    for (int i = 0; i * t->dt < 5 && face(t) > -0.1; i++)
        ck_assert_double_lt(ram_step(t), 1);
}

/* Rams with the same energy at the same place: each crushes as far as it can from the notch of the one before, and
   meets nothing before it; what is crushed is booked.  Without notches each ram is the first.  At two steps. */
START_TEST(rams_meet_the_notch)
{
    for (int turn = 0; turn < 8; turn++) {
        bool notches = turn % 2 == 0, breakable = turn % 4 >= 2;
        ram t;
        ram_make(&t, turn < 4 ? 0.005 : 0.0025, breakable);
        t.settings.crush_notches = notches;
        t.r.floes.material[0].flexural_strength = 1e12;
        double mass = t.r.bodies.mass[t.r.floes.body[0]], own = 1e6, reduced = mass * own / (mass + own), speed = 2.5;
        double way = 0.5 * reduced * speed * speed / (2e6 * HULL_WIDTH), before = 0, met;
        ck_assert(way > 0.3);
        for (int n = 1; n <= 3; n++) {
            double deepest = ram_in(&t, speed, &met);
            /* Ice is met within a step's way. */
            ck_assert_msg(fabs(met - before) <= 1.5 * speed * t.dt, "ram %d meets ice at %g m, not %g", n, met, before);
            ck_assert_msg(fabs(deepest - before - way) < 0.05 * way, "ram %d: from %g to %g m, energy says %g", n,
                          before, deepest, way);
            ram_out(&t);
            before = notches ? deepest : 0;
            assert_relative(t.crushed + (notches ? 0 : 1), notches ? 920 * deepest * HULL_WIDTH : 1, 0.02);
        }
        ck_assert_int_eq(t.r.floes.breakable[floe_of(&t)], breakable);
        ram_free(&t);
    }
}
END_TEST

TEST_MAIN("fracture trim", retreat_is_the_way_of_the_hull, each_hull_draws_back_by_itself, a_floe_under_a_hull_stays,
          plates_that_lie_side_by_side, a_notch_stays_ice, a_refused_trim_leaves_the_tile, rams_meet_the_notch)

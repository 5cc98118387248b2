/* Held ice that a hull drew back from, or melted as it slid along, is met where it stands (docs/decisions/0569). */
#include "fracture_rig.h"

#include "ice_rig.h"

/* J/kg, kg/m3: of the closed forms here, not of the code. */
static const double MELTS = 334e3, DENSITY = 920;

/* A hull against ice that is held, with the part of fracture that keeps what patches stood on. */
typedef struct gap_rig {
    ice_rig r;
    fracture_scratch *scratch;
    fracture_settings settings;
    hull_retreat_table retreats;
    double crushed, gained;
    int32_t hull;
    double turning; /* rate about z [rad/s] */
} gap_rig;

static void gap_rig_make(gap_rig *g, double dt, double friction)
{
    *g = (gap_rig){.settings = fracture_rig_settings()};
    ice_rig_make(&g->r, dt);
    g->scratch = fracture_scratch_create(&g->r.ctx);
    g->settings.time_step = dt;
    g->r.solver.contact_skin = 1e-4; /* closes gaps between floes, not these */
    g->settings.latent_heat = MELTS;
    g->settings.edges_give = g->settings.edge_gaps = g->settings.edge_melts = g->settings.crush_trims = true;
    g->r.settings.edges = (edge_compliance){true, false, 1025, 9.81, 3, true, true};
    pair_policy *p = &g->r.policies.of[MATERIAL_HULL][MATERIAL_ICE];
    p->friction_static = p->friction_kinetic = friction;
    g->r.policies.of[MATERIAL_ICE][MATERIAL_HULL] = *p;
}

static void gap_rig_free(gap_rig *g)
{
    fracture_scratch_free(&g->r.ctx, g->scratch);
    table_free(&g->r.ctx, &g->retreats, &hull_retreat_table_info);
    ice_rig_free(&g->r);
}

/* Ice that was cut is another body. */
static void pair_walls(gap_rig *g)
{
    ice_rig *r = &g->r;
    int32_t pair = 0;
    for (int32_t i = 0; i < r->floes.count; i++) {
        int32_t body = r->floes.body[i];
        if (body < 0)
            continue;
        ck_assert_int_lt(pair, r->pairs.count);
        r->pairs.a[pair] = body < g->hull ? body : g->hull;
        r->pairs.b[pair++] = body < g->hull ? g->hull : body;
    }
}

/* Ice that nothing breaks, its middle there. */
static void wall_at(gap_rig *g, double length, double width, vec3 middle)
{
    int32_t row = ice_rig_plate(&g->r, length, width, 1, MOTION_STATIC);
    g->r.floes.material[row].flexural_strength = 1e12;
    ice_rig_place(&g->r, g->r.floes.body[row], middle, 0, 0, 0);
    ice_rig_pair(&g->r, g->r.floes.body[row], g->hull);
}

/* One step that begins at this velocity; the force of the ice on the hull, global frame [N]. */
static vec3 gap_rig_step(gap_rig *g, vec3 velocity)
{
    ice_rig *r = &g->r;
    fram_error e = {0};
    fracture_event_array events = {0};
    r->bodies.velocity[g->hull] = velocity;
    r->bodies.angular_velocity[g->hull] = (vec3){0, 0, g->turning};
    ice_rig_crush(r);
    ice_rig_edges(r);
    ice_rig_solve(r);
    vec3 sum = {0, 0, 0};
    for (int32_t i = 0; i < r->contacts.count; i++) {
        const contact *c = &r->contacts.data[i];
        sum = vec3_mad(sum, contact_impulse(c), (c->a == g->hull ? 1 : -1) / r->settings.time_step);
    }
    fracture_state state = ice_rig_fracture_state(r);
    state.crushed = &g->crushed;
    state.gained = &g->gained;
    state.retreats = &g->retreats;
    state.supports = &r->supports;
    assert_ok(fracture_run(&r->ctx, g->scratch, &g->settings, r->plane, &r->patches, &state, &events, &e), e);
    ck_assert_int_eq(events.count, 0);
    array_free(&r->ctx, &events);
    integrate_poses(&r->ctx, &r->bodies, r->settings.time_step);
    pair_walls(g);
    return sum;
}

/* A box of 4 m with its bow at x = 0, before ice whose edge is there, too. */
static void bow_on(gap_rig *g, double dt, motion kind)
{
    gap_rig_make(g, dt, 0.1);
    g->hull = ice_rig_box(&g->r, (vec3){-20, -2, -3}, (vec3){0, 2, 3}, kind, MATERIAL_HULL);
    wall_at(g, 100, 100, (vec3){50, 0, 0});
}

/* It goes in, draws back by `way` [m] and comes again: how far before where it had been it meets the ice [m]. */
static double meets(double dt, motion kind, bool gaps, double way)
{
    const double speed = 0.1;
    gap_rig g;
    bow_on(&g, dt, kind);
    g.settings.edge_gaps = gaps;
    for (int i = 0; i < lround(1 / dt); i++)
        gap_rig_step(&g, (vec3){1, 0, 0});
    double deepest = g.r.bodies.position[g.hull].x, met = HUGE_VAL;
    ck_assert_double_gt(deepest, way);
    /* Back, a little on, and back again: it is the way between that counts, for a cut too. */
    static const double PARTS[] = {-0.75, 0.25, -0.5, 1.5};
    double crushed = g.crushed;
    for (int k = 0; k < 4; k++) {
        double rim = g.settings.edge_threshold; /* which goes then */
        ck_assert(k != 3 || !gaps || (g.crushed - crushed > DENSITY * 4 * rim / 2) == (way > rim));
        for (int i = 0; i < lround(fabs(PARTS[k]) * way / speed / dt); i++) {
            double at = deepest - g.r.bodies.position[g.hull].x;
            double force = vec3_length(gap_rig_step(&g, (vec3){PARTS[k] < 0 ? -speed : speed, 0, 0}));
            ck_assert(k % 2 == 1 || force < 1);
            met = force > 1 && met == HUGE_VAL ? at : met;
        }
    }
    gap_rig_free(&g);
    return met;
}

/* A hull that draws back, freely or as it is told, meets what it crushed where it left it, at two steps, by less than
   the edge threshold and by more, at which the ice is cut away; without gaps as soon as it turns. */
START_TEST(met_where_it_was_left)
{
    static const motion KIND[] = {MOTION_DYNAMIC, MOTION_PRESCRIBED};
    static const double WAY[] = {0.08, 0.18, 0.4};
    for (int i = 0; i < 12; i++) {
        double dt = i & 1 ? 0.005 : 0.01, way = WAY[i / 4], step = 0.1 * dt;
        motion kind = KIND[i / 2 % 2];
        assert_absolute(meets(dt, kind, true, way), 0, 1.01 * step);
        if (i < 4)
            assert_absolute(meets(dt, kind, false, way), 0.75 * way, 1.01 * step);
    }
}
END_TEST

/* A long side that stands off the ice and turns comes on with one end: at the way that it stood off. */
START_TEST(an_end_meets_by_itself)
{
    const double dt = 0.01, half = 20, off = 0.02, rate = 0.01;
    for (int told = 0; told < 2; told++) {
        gap_rig g;
        gap_rig_make(&g, dt, 0.1);
        motion kind = told ? MOTION_PRESCRIBED : MOTION_DYNAMIC;
        g.hull = ice_rig_box(&g.r, (vec3){-half, -2, -3}, (vec3){half, 2, 3}, kind, MATERIAL_HULL);
        g.r.bodies.mass[g.hull] = 1e9;
        g.r.bodies.inertia[g.hull] = (sym3){1e12, 1e12, 1e12, 0, 0, 0};
        wall_at(&g, 100, 20, (vec3){0, 12, 0});
        for (int i = 0; i < 14; i++)
            gap_rig_step(&g, (vec3){0, 2, 0});
        for (int i = 0; i < 20; i++)
            ck_assert_double_eq(vec3_length(gap_rig_step(&g, (vec3){0, -off / (20 * dt), 0})), 0);
        assert_relative(g.r.supports.gap[0], off, 1e-9);
        g.turning = rate;
        int steps = 0;
        while (steps < 1000 && vec3_length(gap_rig_step(&g, (vec3){0, 0, 0})) < 1)
            steps++;
        assert_absolute(steps * dt * rate * half, off, 1.01 * rate * half * dt);
        gap_rig_free(&g);
    }
}
END_TEST

/* A hull of 4 m whose sides lean out by the flare, so heavy that nothing moves it aside, goes along between two walls
   and has bent them down. */
static void between_walls(gap_rig *g, double dt, double friction, double speed)
{
    const double flare = radians(10), beam = 2;
    gap_rig_make(g, dt, friction);
    mesh m = {0};
    ck_assert(mesh_make_box(&g->r.ctx, (vec3){-2, -1, -3}, (vec3){2, 1, 3}, &m));
    for (int32_t i = 0; i < m.vertex.count; i++)
        m.vertex.data[i].y *= beam + m.vertex.data[i].z * real_tan(flare);
    g->hull = ice_rig_hull(&g->r, &m, MOTION_DYNAMIC, MATERIAL_HULL);
    g->r.bodies.mass[g->hull] = 1e13;
    g->r.bodies.inertia[g->hull] = (sym3){1e15, 1e15, 1e15, 0, 0, 0};
    double inner = beam - 0.5 * real_tan(flare) - 0.05;
    for (int side = -1; side <= 1; side += 2)
        wall_at(g, 200, 20, (vec3){0, side * (inner + 10), 0});
    g->settings.edge_melts = false;
    for (int i = 0; i < 20; i++)
        gap_rig_step(g, (vec3){speed, 0, i < 10 ? -0.005 / (10 * dt) : 0});
    g->settings.edge_melts = true;
}

/* What presses on patches, along their normals [N]. */
static double pressed(const gap_rig *g)
{
    double sum = 0;
    for (int32_t k = 0; k < g->r.contacts.count; k++)
        sum += g->r.contacts.data[k].impulse[0] / g->r.settings.time_step;
    return sum;
}

/* Friction melts the face that it acts on, mu p v/(rho L) in a second; no farther than the edge is bent, and nothing of
   an edge that does not bend, or under a hull that moves as it is told. */
START_TEST(friction_melts_the_face)
{
    static const double FRICTION[] = {0.05, 0.5, 0.5, 0, 0.5}, SPEED[] = {1, 4, 0, 4, 1e7};
    const double dt = 0.01;
    for (int i = 0; i < 5; i++)
        for (int melts = 0; melts < 2; melts++) {
            gap_rig g;
            between_walls(&g, dt, FRICTION[i], i < 4 ? SPEED[i] : 1);
            g.settings.edge_melts = melts;
            gap_rig_step(&g, (vec3){SPEED[i], 0, 0});
            ck_assert_int_eq(g.r.supports.count, 2);
            const crushing_patch *p = &g.r.patches.data[0];
            double force = pressed(&g) / 2, bent = p->compliance * p->normal.z * p->normal.z * force;
            double depth = FRICTION[i] * force / p->area * SPEED[i] / (DENSITY * MELTS) * dt;
            double is = !melts ? 0 : i < 4 ? depth : bent;
            assert_absolute(g.r.supports.gap[0], is, 0.01 * is + 1e-15);
            gap_rig_free(&g);
        }
    gap_rig g;
    between_walls(&g, dt, 0.5, 4);
    g.r.settings.edges.elastic = false;
    gap_rig_step(&g, (vec3){4, 0, 0});
    ck_assert(g.r.supports.count == 2 && g.r.supports.gap[0] == 0);
    gap_rig_free(&g);
    between_walls(&g, dt, 0.5, 4);
    g.r.bodies.motion[g.hull] = MOTION_PRESCRIBED;
    for (int i = 0; i < 3; i++) {
        gap_rig_step(&g, (vec3){4, 0, -0.01});
        ck_assert(pressed(&g) > 0 && g.r.supports.count == 2 && g.r.supports.gap[0] == 0);
    }
    gap_rig_free(&g);
}
END_TEST

/* The part of the load on bent walls that a hull, which nothing moves aside, has left after a time; what it should be,
   by what C, A and the normal's rise are then. */
static double left_of_load(double dt, double time, double *expected)
{
    const double friction = 0.5, speed = 4;
    gap_rig g;
    between_walls(&g, dt, friction, speed);
    double first = 0;
    for (int i = 0; i <= lround(time / dt); i++) {
        gap_rig_step(&g, (vec3){speed, 0, 0});
        first = i == 0 ? pressed(&g) : first;
    }
    const crushing_patch *p = &g.r.patches.data[0];
    ck_assert_int_eq(g.r.patches.count, 2);
    ck_assert(first > 1e5 && p->compliance > 0);
    double lasts = p->normal.z * p->normal.z * p->compliance * p->area * DENSITY * MELTS / (friction * speed);
    *expected = real_exp(-time / lasts);
    double load = pressed(&g);
    gap_rig_free(&g);
    return load / first;
}

/* A tooth of the channel's wall that is held bent lets go as its face melts: exp(-t/T), T = C n_z^2 A rho L/(mu v). */
START_TEST(bent_ice_lets_go)
{
    double expected, error[2];
    for (int k = 0; k < 2; k++) {
        double left = left_of_load(k ? 0.005 : 0.01, 2, &expected);
        ck_assert(expected > 0.2 && expected < 0.9);
        error[k] = left / expected - 1;
    }
    assert_absolute(error[1], 0, 0.001);
    ck_assert_double_lt(fabs(error[1]), fabs(error[0]));
}
END_TEST

/* An edge that was bent comes back after the hull: the gap is what is left of the hull's way then. */
START_TEST(bent_ice_comes_back)
{
    gap_rig g;
    between_walls(&g, 0.01, 0.1, 1);
    const double rise = 0.008, bent = -g.r.supports.own[0] * g.r.patches.data[0].compliance;
    ck_assert(bent > 0.2 * rise && bent < 0.8 * rise);
    gap_rig_step(&g, (vec3){1, 0, rise / 0.01});
    ck_assert(pressed(&g) == 0);
    assert_relative(g.r.supports.gap[0], (rise - bent) * fabs(g.r.patches.data[0].normal.z), 3e-3);
    gap_rig_free(&g);
}
END_TEST

/* The gap belongs to a patch, not to ice beside it; a hull that is moved as it is told carries nothing before it has
   come as near. */
START_TEST(whose_gap_it_is)
{
    for (int turn = 0; turn < 4; turn++) {
        bool told = turn >= 2;
        gap_rig g;
        bow_on(&g, 0.01, told ? MOTION_PRESCRIBED : MOTION_DYNAMIC);
        ice_rig *r = &g.r;
        for (int i = 0; i < 3; i++)
            gap_rig_step(&g, (vec3){1, 0, 0});
        ck_assert_int_eq(r->supports.count, 1);
        r->supports.gap[0] = 0.02;
        r->supports.place[0].y += turn % 2 ? 1.1 : 0.9; /* 4 m2: half of its size is 1 m */
        r->bodies.velocity[g.hull] = (vec3){told ? 1.5 : 0, 0, 0};
        ice_rig_crush(r);
        double most = r->contacts.data[0].impulse_limit;
        ice_rig_edges(r);
        for (int32_t i = 0; i < r->contacts.count; i++) {
            const contact *c = &r->contacts.data[i];
            ck_assert_double_eq(c->gap, turn % 2 ? 0 : 0.02);
            ck_assert(c->depth >= 0);
            ck_assert_double_eq(c->impulse_limit, told && turn % 2 == 0 ? 0 : most);
        }
        r->bodies.velocity[g.hull] = (vec3){2.1, 0, 0};
        ice_rig_crush(r);
        ice_rig_edges(r);
        ck_assert_double_eq(r->contacts.data[0].impulse_limit, most);
        gap_rig_free(&g);
    }
}
END_TEST

TEST_MAIN("edge gaps", met_where_it_was_left, an_end_meets_by_itself, friction_melts_the_face, bent_ice_lets_go,
          bent_ice_comes_back, whose_gap_it_is)

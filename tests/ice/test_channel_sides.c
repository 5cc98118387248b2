/* A hull that is free to heave between pieces of ice in a channel: its flared sides wedge them against the walls
   (docs/decisions/0330), and what these give (docs/decisions/0400). */
#include "base/transcendental.h"
#include "edge_influence.h"
#include "ice_rig.h"

static const double WEIGHT = 1e5; /* that nothing else carries [N] */
static const double LENGTH = 4, HALF_BEAM = 2, WIDTH = 0.5, THICKNESS = 0.8, OVERLAP = 1e-4;

/* Six metres deep, with sides that lean out by the flare; half as wide as told at z = 0. */
static void flared_hull(context *ctx, double flare, mesh *m)
{
    ck_assert(mesh_make_box(ctx, (vec3){-LENGTH / 2, -1, -3}, (vec3){LENGTH / 2, 1, 3}, m));
    for (int32_t i = 0; i < m->vertex.count; i++)
        m->vertex.data[i].y *= HALF_BEAM + m->vertex.data[i].z * real_tan(flare);
}

static int32_t joint_of_heave(ice_rig *r, int32_t hull)
{
    return joint_create(&r->ctx, &r->joints, &r->bodies, -1, hull, JOINT_PRISMATIC_Z, (vec3){0, 0, 0},
                        (quat){1, 0, 0, 0});
}

/* Heaves with its weight for a time between two pieces and two fixed walls, with friction between ice and ice alone:
   its acceleration down in the end, and the largest force that a piece has got from it. */
static double acceleration_of(double flare, double friction, double dt, double *force)
{
    ice_rig r;
    ice_rig_make(&r, dt);
    r.solver.kind = SOLVER_ACCURATE;
    r.policies.of[MATERIAL_ICE][MATERIAL_ICE].friction_static = friction;
    r.policies.of[MATERIAL_ICE][MATERIAL_ICE].friction_kinetic = friction;
    mesh m = {0};
    flared_hull(&r.ctx, flare, &m);
    int32_t hull = ice_rig_hull(&r, &m, MOTION_DYNAMIC, MATERIAL_HULL);
    ck_assert_int_ge(joint_of_heave(&r, hull), 0);
    double inner = HALF_BEAM - THICKNESS / 2 * real_tan(flare) - OVERLAP;
    for (int side = -1; side <= 1; side += 2) {
        int32_t row = ice_rig_plate(&r, LENGTH, WIDTH, THICKNESS, MOTION_DYNAMIC), piece = r.floes.body[row];
        row = ice_rig_plate(&r, 3 * LENGTH, 6, THICKNESS, MOTION_STATIC);
        int32_t wall = r.floes.body[row];
        ice_rig_place(&r, piece, (vec3){0, side * (inner + WIDTH / 2), 0}, 0, 0, 0);
        ice_rig_place(&r, wall, (vec3){0, side * (inner + WIDTH + 3 - OVERLAP), 0}, 0, 0, 0);
        ice_rig_pair(&r, hull, piece);
        ice_rig_pair(&r, piece, wall);
    }
    double before = 0, mass = r.bodies.mass[hull];
    for (int i = 0; i < 10; i++) {
        before = r.bodies.velocity[hull].z;
        r.bodies.velocity[hull].z -= WEIGHT / mass * dt;
        ice_rig_step(&r);
    }
    *force = 0;
    for (int32_t i = 0; i < r.contacts.count; i++) {
        const contact *c = &r.contacts.data[i];
        if (c->a == hull || c->b == hull)
            *force += 0.5 * c->impulse[0] / dt;
    }
    double found = (before - r.bodies.velocity[hull].z) / dt;
    ice_rig_free(&r);
    return found;
}

/* Coulomb: pieces hold while tan(flare) < mu, and then press on the hull with W/(2 sin(flare)); beyond, they and the
   hull go down together, by what friction of the walls leaves. */
START_TEST(a_hull_hangs_on_its_flare)
{
    static const double DEGREES[] = {5, 10, 16, 18, 20, 24};
    const double friction = 0.3, piece = 920 * LENGTH * WIDTH * THICKNESS, hull = 1e6;
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 2; k++) {
            double flare = radians(DEGREES[i]), s = real_sin(flare), c = real_cos(flare), force;
            double found = acceleration_of(flare, friction, k ? 0.005 : 0.01, &force);
            double left = s - friction * c, down = 0, push = WEIGHT / (2 * s);
            if (left > 0) {
                /* N (sin - mu cos) = m a,  W - 2 N sin = M a. */
                down = WEIGHT / (hull + 2 * piece * s / left);
                push = piece * down / left;
            }
            assert_absolute(found, down, 3e-4 * WEIGHT / hull);
            assert_relative(force, push, 0.01);
        }
}
END_TEST

/* ---- walls that give ---- */

/* What patches stood on, as fracture keeps it for the step to come. */
static void keep_supports(ice_rig *r)
{
    edge_support_table *e = &r->supports;
    ck_assert(table_resize(&r->ctx, e, &edge_support_table_info, r->patches.count));
    for (int32_t i = 0; i < e->count; i++) {
        const crushing_patch *p = &r->patches.data[i];
        e->surface[i] = p->surface_body;
        e->generation[i] = r->bodies.generation[p->surface_body];
        e->place[i] = body_to_local(&r->bodies, p->surface_body, p->centre);
        e->wedges[i] = e->part[i] = 1;
        e->strip[i] = e->load[i] = e->impulse[i] = e->own[i] = 0;
        for (int32_t k = p->contact_first; k < p->contact_first + p->contact_count; k++)
            e->own[i] += contact_impulse(&r->contacts.data[k]).z / r->settings.time_step;
    }
}

/* Floating with a waterplane's stiffness beside walls that give: how far the hull has come down after a time [m].
   With pieces between, or on the walls themselves (bigger ones, that stand where the pieces stood). */
static double way_down(bool pieces, bool gives, solver_kind kind, double dt, double time, double *stiffness)
{
    ice_rig r;
    ice_rig_make(&r, dt);
    r.solver.kind = kind;
    r.solver.iterations = 400;
    r.settings.edges = (edge_compliance){true, false, 1025, 9.81, 3, false, gives};
    if (pieces)
        r.policies.of[MATERIAL_ICE][MATERIAL_ICE].friction_static =
            r.policies.of[MATERIAL_ICE][MATERIAL_ICE].friction_kinetic = 0.3;
    mesh m = {0};
    flared_hull(&r.ctx, radians(10), &m);
    int32_t hull = ice_rig_hull(&r, &m, MOTION_DYNAMIC, MATERIAL_HULL);
    ck_assert_int_ge(joint_of_heave(&r, hull), 0);
    /* A hull that floats stands deeper in walls of its own: what it touches is crushed by less than it bends. */
    double inner = HALF_BEAM - THICKNESS / 2 * real_tan(radians(10)) - (pieces ? OVERLAP : 0.05);
    for (int side = -1; side <= 1; side += 2) {
        double at = inner;
        int32_t last = hull;
        if (pieces) {
            last = ice_rig_plate_body(&r, LENGTH, WIDTH, THICKNESS, MOTION_DYNAMIC);
            ice_rig_place(&r, last, (vec3){0, side * (at + WIDTH / 2), 0}, 0, 0, 0);
            ice_rig_pair(&r, hull, last);
            at += WIDTH - OVERLAP;
        }
        int32_t wall = ice_rig_plate_body(&r, 3 * LENGTH, 6, THICKNESS, MOTION_STATIC);
        ice_rig_place(&r, wall, (vec3){0, side * (at + 3), 0}, 0, 0, 0);
        ice_rig_pair(&r, last, wall);
    }
    for (int i = 0; i < lround(time / dt); i++) {
        r.bodies.velocity[hull].z -= WEIGHT / r.bodies.mass[hull] * dt;
        ice_rig_step(&r);
        keep_supports(&r);
    }
    *stiffness = 0;
    if (!pieces)
        for (int32_t i = 0; i < r.patches.count; i++)
            *stiffness += r.patches.data[i].compliance > 0 ? 1 / r.patches.data[i].compliance : 0;
    double way = -r.bodies.position[hull].z;
    ice_rig_free(&r);
    return way;
}

/* A mass on two springs: (W/K)(1 - cos(sqrt(K/M) t)), to the first order in the step.  K of pieces that hold by
   friction is the plate's under a load as wide as they are. */
START_TEST(walls_go_down_with_what_hangs_on_them)
{
    const double time = 0.4;
    double l = ice_characteristic_length(&ICE_RIG_MATERIAL, THICKNESS, 1025, 9.81);
    for (int pieces = 0; pieces < 2; pieces++) {
        double error[2], mass = 1e6 + pieces * 2 * 920 * LENGTH * WIDTH * THICKNESS, fast;
        for (int k = 0; k < 2; k++) {
            double dt = k ? 0.005 : 0.01, stiffness;
            double way = way_down(pieces, true, SOLVER_ACCURATE, dt, time, &stiffness);
            if (pieces)
                stiffness = 2 * 1025 * 9.81 * l * l / edge_influence(LENGTH / (3 * l), 0.3);
            double is = WEIGHT / stiffness * (1 - real_cos(sqrt(stiffness / mass) * time));
            error[k] = way / is - 1;
            assert_relative(way_down(pieces, true, SOLVER_FAST, dt, time, &fast), way, 1e-3);
        }
        assert_absolute(error[1], 0, 0.01);
        assert_relative(error[0] / error[1], 2, 0.05);
        ck_assert(fabs(way_down(pieces, false, SOLVER_ACCURATE, 0.01, time, &fast)) < 1e-4);
    }
}
END_TEST

TEST_MAIN("channel sides", a_hull_hangs_on_its_flare, walls_go_down_with_what_hangs_on_them)

/* Edges that bend under loads that crush nothing (docs/decisions/0400). */
#include "edge_influence.h"
#include "ice_rig.h"

static const edge_compliance ELASTIC = {true, false, 1025, 9.81, 3, false, true};
static const double THICKNESS = 0.8;

static double length(void) { return ice_characteristic_length(&ICE_RIG_MATERIAL, THICKNESS, 1025, 9.81); }

/* rho_w g l^2. */
static double plate_stiffness(void) { return 1025 * 9.81 * length() * length(); }

/* A fixed sheet of 200 m with its edge at y = 0, and n pieces of 1 m in a row before it; first middle at x = 0. */
static void wall_of(ice_rig *r, int n, double spacing)
{
    ice_rig_make(r, 0.01);
    r->settings.edges = ELASTIC;
    int32_t wall = ice_rig_plate_body(r, 200, 20, THICKNESS, MOTION_STATIC);
    ice_rig_place(r, wall, (vec3){0, 10 - 1e-4, 0}, 0, 0, 0);
    for (int i = 0; i < n; i++) {
        int32_t piece = ice_rig_plate_body(r, 1, 1, THICKNESS, MOTION_DYNAMIC);
        ice_rig_place(r, piece, (vec3){spacing * i, -0.5, 0}, 0, 0, 0);
        ice_rig_pair(r, wall, piece);
    }
    ice_rig_crush(r);
}

/* The wall with its pieces on both sides of x = 0. */
static void line_of(ice_rig *r, int n, double spacing)
{
    wall_of(r, n, spacing);
    for (int i = 0; i < n; i++)
        ice_rig_place(r, r->floes.body[i + 1], (vec3){spacing * (i - n / 2), -0.5, 0}, 0, 0, 0);
    ice_rig_crush(r);
}

/* As if the contacts of piece i had carried force[i] down on the wall in the last step. */
static void remember(ice_rig *r, const double *force)
{
    contact_memory_table *m = &r->memory;
    ck_assert(table_resize(&r->ctx, m, &contact_memory_table_info, r->contacts.count));
    for (int32_t i = 0; i < r->contacts.count; i++) {
        const contact *c = &r->contacts.data[i];
        bool piece_is_a = body_is_dynamic(&r->bodies, c->a);
        int32_t points = 0, piece = piece_is_a ? c->a : c->b, at = i;
        for (int32_t k = 0; k < r->contacts.count; k++)
            points += r->contacts.data[k].a == c->a && r->contacts.data[k].b == c->b;
        double p = force[r->bodies.owner[piece] - 1] * r->settings.time_step / points;
        for (; at > 0 && m->key[at - 1] > c->key; at--) {
            m->key[at] = m->key[at - 1];
            m->on_lower[at] = m->on_lower[at - 1];
        }
        m->key[at] = c->key;
        bool lower = piece < (piece_is_a ? c->b : c->a);
        m->on_lower[at] = vec3_add(vec3_scale(c->normal, c->a < c->b ? 1 : -1), vec3_make(0, 0, lower ? p : -p));
    }
}

/* The edge's deflection over the load on it, of all contacts of a piece, times what a plate on water has. */
static double influence_of(const ice_rig *r, int32_t piece, double *down)
{
    double dt = r->settings.time_step, plate = plate_stiffness();
    for (int32_t i = 0; i < r->contacts.count; i++) {
        const contact *c = &r->contacts.data[i];
        if (r->bodies.owner[c->a] != piece + 1 && r->bodies.owner[c->b] != piece + 1)
            continue;
        *down = c->recoil * dt * plate;
        return c->give * dt * dt * plate;
    }
    ck_abort_msg("piece %d touches nothing", (int)piece);
    return 0;
}

/* One piece: the point's deflection, from its own load alone.  Equal loads along a wall: a line's, sqrt(2) p / (k l).
 */
START_TEST(point_and_line)
{
    enum { MANY = 101 };
    ice_rig r;
    double force[MANY], down;
    wall_of(&r, 1, 1);
    force[0] = 2e4;
    ice_rig_edges(&r);
    assert_relative(influence_of(&r, 0, &down), edge_influence(1 / (3 * length()), 0.3), 0.003);
    ck_assert(down == 0);
    remember(&r, force);
    ice_rig_crush(&r);
    ice_rig_edges(&r);
    double alone = influence_of(&r, 0, &down);
    assert_relative(alone, edge_influence(1 / (3 * length()), 0.3), 0.003);
    assert_relative(down, alone * force[0], 1e-9); /* the edge would go up again */
    ice_rig_free(&r);
    line_of(&r, MANY, 1.25);
    for (int i = 0; i < MANY; i++)
        force[i] = 1e3;
    remember(&r, force);
    ice_rig_edges(&r);
    assert_relative(influence_of(&r, MANY / 2, &down), sqrt(2) * length() / 1.25, 0.01);
    /* A load beside which nothing counts, and one that goes the other way. */
    for (int i = 0; i < MANY; i++)
        force[i] = i == MANY / 2 ? 1e3 : i % 2 ? 1e-6 : -1e3;
    remember(&r, force);
    ice_rig_crush(&r);
    ice_rig_edges(&r);
    assert_relative(influence_of(&r, MANY / 2, &down), alone, 1e-6);
    ice_rig_free(&r);
}
END_TEST

/* A wall gives the same whichever way it goes, far neighbours and ones that nothing reaches among them. */
START_TEST(any_direction)
{
    enum { MANY = 25 };
    ice_rig r;
    double force[MANY], down, along_x[MANY];
    for (int i = 0; i < MANY; i++)
        force[i] = 1e3 * (1 + i % 3);
    for (int turned = 0; turned < 2; turned++) {
        line_of(&r, MANY, 7.5);
        for (int32_t i = 0; i <= MANY && turned; i++) {
            vec3 p = r.bodies.position[r.floes.body[i]];
            ice_rig_place(&r, r.floes.body[i], vec3_make(-p.y, p.x, p.z), 0, 0, PI / 2);
        }
        ice_rig_crush(&r);
        remember(&r, force);
        ice_rig_edges(&r);
        for (int i = 0; i < MANY; i++) {
            double influence = influence_of(&r, i, &down);
            if (turned)
                assert_relative(influence, along_x[i], 1e-9);
            else
                along_x[i] = influence;
        }
        ice_rig_free(&r);
    }
}
END_TEST

/* Nothing gives with the switch off, on ice that cannot break or that moves freely, and past the thickness. */
START_TEST(what_stays_rigid)
{
    for (int i = 0; i < 5; i++) {
        ice_rig r;
        double down, force = i == 4 ? 1.01 * THICKNESS * plate_stiffness() / 0.45 : 1e3;
        wall_of(&r, 1, 1);
        remember(&r, &force);
        if (i == 1)
            r.settings.edges.elastic = false;
        if (i == 2)
            r.floes.breakable[0] = 0;
        if (i == 3)
            r.bodies.motion[r.floes.body[0]] = MOTION_DYNAMIC;
        ice_rig_crush(&r);
        ice_rig_edges(&r);
        ck_assert_int_eq(influence_of(&r, 0, &down) > 0, i == 0);
        ice_rig_free(&r);
    }
}
END_TEST

/* ---- hulls ---- */

/* What the support of a patch carried is its patches' whole, by their areas. */
START_TEST(supports_are_shared)
{
    ice_rig r;
    ice_rig_make(&r, 0.01);
    r.settings.edges = ELASTIC;
    mesh bow = {0};
    ice_rig_bow(&r.ctx, &bow);
    int32_t hull = ice_rig_hull(&r, &bow, MOTION_DYNAMIC, MATERIAL_HULL);
    for (int i = 0; i < 2; i++) {
        int32_t sheet = ice_rig_plate_body(&r, 20, 20, THICKNESS, MOTION_STATIC);
        ice_rig_place(&r, sheet, (vec3){5 + i, i ? 10 : -10, -2}, 0, 0, 0);
        ice_rig_pair(&r, hull, sheet);
    }
    ice_rig_crush(&r);
    ck_assert_int_eq(r.patches.count, 2);
    const crushing_patch *p = r.patches.data;
    ck_assert(p[0].compliance > 0 && p[1].compliance > 0 && p[0].horizontal_area > p[1].horizontal_area);
    ck_assert(table_resize(&r.ctx, &r.supports, &edge_support_table_info, 1));
    r.supports.surface[0] = hull;
    r.supports.generation[0] = r.bodies.generation[hull];
    r.supports.place[0] = body_to_local(&r.bodies, hull, vec3_scale(vec3_add(p[0].centre, p[1].centre), 0.5));
    r.supports.wedges[0] = 1;
    r.supports.own[0] = -3e4;
    ice_rig_edges(&r);
    double sum = 0;
    for (int i = 0; i < 2; i++) {
        const contact *c = &r.contacts.data[p[i].contact_first];
        double load = -c->recoil * 0.01 / p[i].compliance;
        assert_relative(c->give, p[i].compliance / 1e-4, 1e-12);
        assert_relative(load, -3e4 * p[i].horizontal_area / (p[0].horizontal_area + p[1].horizontal_area), 1e-9);
        sum += load;
    }
    assert_relative(sum, -3e4, 1e-9);
    ice_rig_free(&r);
}
END_TEST

TEST_MAIN("edge_rows", point_and_line, any_direction, what_stays_rigid, supports_are_shared)

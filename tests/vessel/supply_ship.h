/* The supply ship of docs/oracles.md, 7 (MSS toolbox): matrices about midships with z down, thrusters. */
#ifndef SUPPLY_SHIP_H
#define SUPPLY_SHIP_H

#include "testing.h"
#include "vessel/thruster.h"

static const mat3 supply_mass = {{{6.7644e6, 0, 0}, {0, 1.13412e7, -3.401568e7}, {0, -3.401568e7, 4.452378e9}}};
static const mat3 supply_damping = {{{7.707105e4, 0, 0}, {0, 2.546789e5, -2.034159e6}, {0, -6.725849e5, 3.850073e8}}};

/* z down to z up: sway and yaw reversed. */
static inline mat3 in_axes_of_fram(mat3 m)
{
    static const double sign[3] = {1, -1, -1};
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            m.m[r][c] *= sign[r] * sign[c];
    return m;
}

/* A vessel row without any mesh: enough for what thrusters and lines ask. */
typedef struct bare_vessel {
    context ctx;
    body_table bodies;
    vessel_table vessels;
    thruster_table thrusters;
    event_table events;
    fram_error error;
} bare_vessel;

static inline void bare_vessel_open(bare_vessel *b)
{
    memset(b, 0, sizeof *b);
    context_init(&b->ctx);
    ck_assert_int_eq(body_create(&b->ctx, &b->bodies, MOTION_DYNAMIC, MATERIAL_HULL), 0);
    b->bodies.mass[0] = 6e6;
    ck_assert(table_resize(&b->ctx, &b->vessels, &vessel_table_info, 1));
    b->vessels.body[0] = 0;
    b->vessels.carriage[0] = b->vessels.joint[0] = -1;
    b->vessels.length[0] = 76.2;
}

static inline void bare_vessel_close(bare_vessel *b)
{
    table_free(&b->ctx, &b->bodies, &body_table_info);
    table_free(&b->ctx, &b->vessels, &vessel_table_info);
    table_free(&b->ctx, &b->thrusters, &thruster_table_info);
    table_free(&b->ctx, &b->events, &event_table_info);
}

static inline thruster_definition supply_tunnel(double x)
{
    double most = 3.2 * 250 * 250;
    return (thruster_definition){.kind = THRUSTER_TUNNEL,
                                 .place = {x, 0, -3},
                                 .ahead = most,
                                 .astern = most,
                                 .time_constant = 1,
                                 .speed_rate = 10,
                                 .turn_rate = 1,
                                 .cost = 1,
                                 .full_power = 6.25 * most,
                                 .failure_time = HUGE_VAL};
}

static inline thruster_definition supply_main(double y)
{
    thruster_definition d = supply_tunnel(-38.1);
    d.kind = THRUSTER_MAIN;
    d.place.y = y;
    d.ahead = d.astern = 31.2 * 160 * 160;
    d.full_power = 6.25 * d.ahead;
    return d;
}

static inline void supply_thrusters(bare_vessel *b)
{
    const thruster_definition all[] = {supply_tunnel(30),  supply_tunnel(22), supply_tunnel(-22),
                                       supply_tunnel(-30), supply_main(8),    supply_main(-8)};
    for (int i = 0; i < 6; i++)
        assert_ok(thruster_add(&b->ctx, &all[i], &b->vessels, &b->thrusters, &b->error), b->error);
}

#endif

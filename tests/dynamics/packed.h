/* A field of hexagonal floes packed between three walls and driven against one of them: the scene that tests and
   benchmarks of the solver share. */
#ifndef PACKED_H
#define PACKED_H

#include "base/random.h"
#include "base/transcendental.h"
#include "rig.h"

/* Hexagons of 10 m across flats, rows along x every 8.66 m; sizes so that neighbours overlap by about a centimetre. */
#define PACKED_SPACING 10.0
#define PACKED_ROW 8.66
#define PACKED_RADIUS 5.78

static inline int32_t packed_floe(rig *r, vec3 place, double radius, double turn)
{
    vec2 corner[6];
    for (int k = 0; k < 6; k++) {
        double angle = turn + PI / 3 * (k + 0.5);
        corner[k] = vec2_make(radius * real_cos(angle), radius * real_sin(angle));
    }
    return rig_prism(r, MOTION_DYNAMIC, (polygon){corner, 6}, 1, 900, place);
}

/* columns x rows floes with a wall ahead (+x) and on both sides; every floe is pushed by about a kilonewton and starts
   at about 0.1 m/s, both at random by the seed.  No gravity: contacts alone hold floes up. */
static inline rig packed_rig(int columns, int rows, double friction, uint64_t seed)
{
    rig r = rig_make(0.02);
    r.gravity = vec3_make(0, 0, 0);
    rig_friction(&r, friction, friction);
    double length = columns * PACKED_SPACING, width = rows * PACKED_ROW, edge = 5.77;
    rig_box(&r, MOTION_STATIC, vec3_make(4, width + 40, 4), 1, vec3_make(length + 2, width / 2, 0));
    rig_box(&r, MOTION_STATIC, vec3_make(length + 200, 4, 4), 1, vec3_make(length / 2 - 50, -edge - 2, 0));
    rig_box(&r, MOTION_STATIC, vec3_make(length + 200, 4, 4), 1,
            vec3_make(length / 2 - 50, (rows - 1) * PACKED_ROW + edge + 2, 0));
    for (int i = 0; i < columns * rows; i++) {
        random_stream random = random_begin(seed, 0, (uint32_t)i);
        double u[8];
        for (int k = 0; k < 8; k++)
            u[k] = random_unit(&random) - 0.5;
        int x = i % columns, y = i / columns;
        vec3 place = {PACKED_SPACING * (x + 0.5 * (y % 2)) + 0.02 * u[0], PACKED_ROW * y + 0.02 * u[1], 0.05 * u[2]};
        int32_t floe = packed_floe(&r, place, PACKED_RADIUS, 0.004 * u[3]);
        r.loads.data[floe].force = vec3_make(1000 * (1 + u[4]), 200 * u[5], 0);
        r.bodies.velocity[floe] = vec3_make(0.1 * (u[6] + 0.5), 0.05 * u[7], 0);
    }
    return r;
}

/* A free vessel of 100 m at the open end, touching, with the speed given along +x. */
static inline int32_t packed_vessel(rig *r, int rows, double mass, double speed)
{
    double beam = 0.4 * rows * PACKED_ROW;
    int32_t ship = rig_box(r, MOTION_DYNAMIC, vec3_make(100, beam, 10), mass / (100 * beam * 10),
                           vec3_make(-55, rows * PACKED_ROW / 2, 0));
    r->bodies.velocity[ship].x = speed;
    return ship;
}

/* A plate with its underside in the tops of all floes of columns [first, end): a body with columns x rows contacts. */
static inline int32_t packed_plate(rig *r, int first, int end, int rows, double mass)
{
    vec3 size = {PACKED_SPACING * (end - first), PACKED_ROW * rows, 1};
    vec3 place = {PACKED_SPACING * (0.5 * (first + end) - 0.5), PACKED_ROW * (rows - 1) / 2, 0.999};
    return rig_box(r, MOTION_DYNAMIC, size, mass / (size.x * size.y * size.z), place);
}

#endif

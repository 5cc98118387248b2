/* Free decay of a vessel: measured by stepping a scenario's world, and by the theory of small motions from hydrostatics
   and added mass.  Used by the test and by the picture of it; knows nothing of libcheck. */
#ifndef TEST_SIM_DECAY_H
#define TEST_SIM_DECAY_H

#include "base/transcendental.h"
#include "io/scenario_file.h"
#include "sim/build.h"
#include "sim/step.h"

#include <stdlib.h>
#include <string.h>

enum decay_mode { DECAY_HEAVE = 2, DECAY_ROLL, DECAY_PITCH };

typedef struct decay {
    context ctx;
    scenario s;
    model m;
    world w;
    matrix6 mass;        /* of body and water, about the centre of mass */
    double spring[6][6]; /* of heave, roll and pitch [N/m], [N], [N m] */
    double period[6];    /* by theory, of the mode that is mostly this motion [s] */
    double shape[6][2];  /* its heave [m] and pitch [rad] */
    double rest;         /* height of the centre of mass [m] */
} decay;

/* Springs of the water plane, from hydrostatics about the centre of mass: dz = heave - x pitch + y roll at a point of
 * it. */
static inline void decay_springs(decay *d, const hull_hydrostatics *f, double weight)
{
    double area = weight * f->waterplane_area, x = f->centre_of_flotation.x;
    double lift = weight * f->volume * f->centre_of_buoyancy.z;
    d->spring[2][2] = area;
    d->spring[2][4] = d->spring[4][2] = -area * x;
    d->spring[3][3] = weight * f->waterplane_xx + lift;
    d->spring[4][4] = weight * f->waterplane_yy + area * x * x + lift;
}

/* Motions without a spring follow the others: m_ij - m_ip m_pj / m_pp for each of them. */
static inline void decay_reduce(matrix6 *m)
{
    static const int free_motion[3] = {0, 1, 5};
    for (int k = 0; k < 3; k++) {
        int p = free_motion[k];
        matrix6 before = *m;
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < 6; j++)
                if (i != p && j != p)
                    m->m[i][j] = before.m[i][j] - before.m[i][p] * before.m[p][j] / before.m[p][p];
    }
}

/* Roll by itself; heave and pitch as the two modes of (spring - w^2 mass) x = 0. */
static inline void decay_theory(decay *d)
{
    matrix6 m = d->mass;
    decay_reduce(&m);
    d->period[3] = 2 * PI * sqrt(m.m[3][3] / d->spring[3][3]);
    double m3 = m.m[2][2], m5 = m.m[4][4], m35 = m.m[2][4];
    double c3 = d->spring[2][2], c5 = d->spring[4][4], c35 = d->spring[2][4];
    double a = m3 * m5 - m35 * m35, b = -(c3 * m5 + c5 * m3 - 2 * c35 * m35), c = c3 * c5 - c35 * c35;
    double root = sqrt(b * b - 4 * a * c);
    for (int k = 0; k < 2; k++) {
        double square = (-b + (k ? root : -root)) / (2 * a);
        /* (c3 - w2 m3) heave + (c35 - w2 m35) pitch = 0, or the other row where this one is all small. */
        double p = c3 - square * m3, q = c35 - square * m35, r = c5 - square * m5;
        double heave = fabs(p) * m5 > fabs(r) * m3 ? -q : r, pitch = fabs(p) * m5 > fabs(r) * m3 ? p : -q;
        int mode = heave * heave * m3 > pitch * pitch * m5 ? 2 : 4;
        double size = mode == 2 ? heave : pitch;
        d->period[mode] = 2 * PI / sqrt(square);
        d->shape[mode][0] = heave / size;
        d->shape[mode][1] = pitch / size;
    }
}

/* name: the file that the text stands for, whose folder its paths are relative to. */
static inline fram_status decay_open_as(decay *d, const char *name, const char *text, fram_error *error)
{
    memset(d, 0, sizeof *d);
    context_init(&d->ctx);
    fram_status status = scenario_parse(&d->ctx, name, text, strlen(text), NULL, &d->s, error);
    field_report report;
    hull_hydrostatics floats;
    if (status == FRAM_OK)
        status = build_model(&d->ctx, &d->s, &d->m, error);
    if (status == FRAM_OK)
        status = build_world(&d->ctx, &d->s, &d->m, &d->w, &report, error);
    if (status != FRAM_OK)
        return status;
    int32_t body = d->w.vessels.body[0];
    vec3 centre = d->w.vessels.centre[0];
    const solid *hull = shape_solid(&d->w.shapes, d->w.bodies.shape[body]);
    status = hull_hydrostatics_at(&d->ctx, &hull->surface, -centre.z, &floats, error);
    decay_springs(d, &floats, d->m.media.water_density * d->m.media.gravity);
    double m = d->w.bodies.mass[body];
    sym3 i = d->w.bodies.inertia[body];
    d->mass = (matrix6){{{m},
                         {0, m},
                         {0, 0, m},
                         {0, 0, 0, i.xx, i.xy, i.xz},
                         {0, 0, 0, i.xy, i.yy, i.yz},
                         {0, 0, 0, i.xz, i.yz, i.zz}}};
    const vessel_model *fixed = &d->m.vessels.data[0];
    if (fixed->has_hydrodynamics)
        d->mass = matrix6_sum(&d->mass, &fixed->hydrodynamics.added_mass, 1);
    d->rest = d->w.bodies.position[body].z;
    decay_theory(d);
    return status;
}

static inline fram_status decay_open(decay *d, const char *text, fram_error *error)
{
    return decay_open_as(d, "decay.yaml", text, error);
}

static inline void decay_close(decay *d)
{
    world_free(&d->ctx, &d->w);
    model_free(&d->ctx, &d->m);
    scenario_free(&d->ctx, &d->s);
}

static inline double decay_now(const decay *d, int mode)
{
    int32_t body = d->w.vessels.body[0];
    vec3 angles = quat_roll_pitch_yaw(d->w.bodies.orientation[body]);
    return mode == DECAY_HEAVE ? d->w.bodies.position[body].z - d->rest : mode == DECAY_ROLL ? angles.x : angles.y;
}

/* From rest at an amplitude [m] or [rad] of that mode; value[i] at time i dt, steps + 1 of them.  The mean period over
   the upward crossings seen, 0 for fewer than two. */
static inline double decay_run(decay *d, int mode, double amplitude, int steps, double *value, fram_error *error)
{
    int32_t body = d->w.vessels.body[0];
    body_table *b = &d->w.bodies;
    double heave = mode == DECAY_ROLL ? 0 : amplitude * d->shape[mode][0];
    double pitch = mode == DECAY_ROLL ? 0 : amplitude * d->shape[mode][1];
    b->position[body].z = d->rest + heave;
    b->orientation[body] = quat_from_roll_pitch_yaw(mode == DECAY_ROLL ? amplitude : 0, pitch, 0);
    double first = 0, last = 0, before = decay_now(d, mode), dt = d->m.time_step;
    int crossings = 0;
    if (value)
        value[0] = before;
    for (int i = 1; i <= steps; i++) {
        if (world_step(&d->ctx, &d->m, &d->w, error) != FRAM_OK)
            return 0;
        double now = decay_now(d, mode);
        if (before < 0 && now >= 0) {
            last = dt * (i - now / (now - before));
            first = crossings++ == 0 ? last : first;
        }
        before = now;
        if (value)
            value[i] = now;
    }
    return crossings > 1 ? (last - first) / (crossings - 1) : 0;
}

#endif

/* Floes of several outlines, and their loads beside those of the walk over all faces: what tests of level and of tilted
   floes share. */
#ifndef FLUID_FIELD_H
#define FLUID_FIELD_H

#include "geometry/outlines.h"
#include "samples.h"

static const vec2 triangle_outline[] = {{-3, -2}, {4, -2.5}, {-1, 4.5}};
static const vec2 plank_outline[] = {{-10, -2.5}, {10, -2.5}, {10, 2.5}, {-10, 2.5}};
enum { OUTLINES = 6 };
static inline polygon outline_of(int i)
{
    const polygon list[OUTLINES] = {OUTLINE(square_outline), OUTLINE(hexagon_outline), OUTLINE(triangle_outline),
                                    OUTLINE(plank_outline),  OUTLINE(arrow_outline),   OUTLINE(comb_outline)};
    return list[i];
}
static const double half_height = 0.6;

typedef struct field {
    context ctx;
    body_table bodies;
    shape_store shapes;
} field;

static inline void field_open(field *f)
{
    *f = (field){0};
    context_init(&f->ctx);
    fram_error error = {0};
    overlay *cutter = overlay_create(&f->ctx);
    ck_assert_ptr_nonnull(cutter);
    for (int i = 0; i < OUTLINES; i++) {
        int32_t row;
        assert_ok(shape_add_prism(&f->ctx, &f->shapes, cutter, outline_of(i), half_height, 0, &row, &error), error);
        ck_assert_int_eq(row, i);
    }
    overlay_free(cutter);
}

static inline void field_close(field *f)
{
    table_free(&f->ctx, &f->bodies, &body_table_info);
    shape_store_free(&f->ctx, &f->shapes);
}

/* A floe tilted by up to `tilt`, moving. */
static inline int32_t add_floe(field *f, random_stream *r, int32_t shape, double tilt, double spin)
{
    int32_t slot = body_create(&f->ctx, &f->bodies, MOTION_DYNAMIC, MATERIAL_ICE);
    ck_assert_int_ge(slot, 0);
    body_table *b = &f->bodies;
    b->shape[slot] = shape;
    b->mass[slot] = 1000;
    b->position[slot] = vec3_make(0, 0, random_uniform(r, -0.3, 0.3));
    double roll = random_uniform(r, -tilt, tilt), pitch = random_uniform(r, -tilt, tilt);
    b->orientation[slot] = quat_from_roll_pitch_yaw(roll, pitch, random_uniform(r, -3, 3));
    b->velocity[slot] = random_vector(r, 1);
    b->angular_velocity[slot] = random_vector(r, spin);
    return slot;
}

static inline fluid_motion motion_of(const field *f, int32_t slot)
{
    const body_table *b = &f->bodies;
    return (fluid_motion){b->position[slot], quat_matrix(b->orientation[slot]), b->velocity[slot],
                          b->angular_velocity[slot]};
}

static inline fluid_load *apply(field *f, const media *m, const drag_coefficients *c)
{
    wrench *loads = malloc((size_t)f->bodies.count * sizeof *loads);
    fluid_load *detail = malloc((size_t)f->bodies.count * sizeof *detail);
    fram_error error = {0};
    assert_ok(fluid_apply(&f->ctx, m, c, &f->bodies, &f->shapes, NULL, loads, &(fluid_details){.all = detail}, &error),
              error);
    free(loads);
    return detail;
}

static inline double largest_speed(const fluid_motion *s, vec3 medium, double reach)
{
    return vec3_length(vec3_sub(s->velocity, medium)) + reach * vec3_length(s->angular_velocity);
}

static inline double apart(const wrench *a, const wrench *b, double reach)
{
    return testing_larger(vec3_length(vec3_sub(a->force, b->force)),
                          vec3_length(vec3_sub(a->moment, b->moment)) / reach);
}

/* How far a floe's load is from the prism's own: drag over that of a face at the floe's largest speed and one
   coefficient, hydrostatics over the buoyancy; of a floe in the air in N and m3. */
typedef struct load_error {
    double water, air, hydrostatic, volume;
} load_error;

static inline load_error error_of(const field *f, const media *m, const drag_coefficients *c, double coefficient,
                                  const fluid_load *load, int i)
{
    fluid_motion state = motion_of(f, i);
    polygon outline = outline_of(i % OUTLINES);
    fluid_load expected;
    fluid_load_prism(m, c, outline, half_height, &state, &expected);
    double reach = 0.5 * polygon_diameter(outline), speed = largest_speed(&state, m->current, reach);
    double size = 0.5 * 1025 * coefficient * polygon_area(outline) * speed * speed;
    double volume = expected.submerged_volume, buoyancy = expected.hydrostatic.force.z;
    return (load_error){apart(&load->water_drag, &expected.water_drag, reach) / size,
                        apart(&load->wind_drag, &expected.wind_drag, reach) / size,
                        apart(&load->hydrostatic, &expected.hydrostatic, reach) / (buoyancy > 0 ? buoyancy : 1),
                        fabs(load->submerged_volume - volume) / (volume > 0 ? volume : 1)};
}

#endif

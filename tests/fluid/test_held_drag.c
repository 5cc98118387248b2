/* Drag that is held: how far it may be from drag that is computed, when it is computed anew, and the same bits with any
   instruction set. */
#include "samples.h"

enum { OUTLINES = 4, FLOES = 240 };
static const double half_height = 0.6;
static const vec2 plank_outline[] = {{-10, -2.5}, {10, -2.5}, {10, 2.5}, {-10, 2.5}};

static polygon outline_of(int i)
{
    const polygon list[OUTLINES] = {OUTLINE(square_outline), OUTLINE(hexagon_outline), OUTLINE(plank_outline),
                                    OUTLINE(arrow_outline)};
    return list[i];
}

typedef struct field {
    context ctx;
    media media;
    body_table bodies;
    shape_store shapes;
    held_drag_table held;
    wrench loads[FLOES];
    double volume[FLOES];
} field;

static int32_t add_floe(field *f, int32_t shape)
{
    int32_t slot = body_create(&f->ctx, &f->bodies, MOTION_DYNAMIC, MATERIAL_ICE);
    ck_assert_int_ge(slot, 0);
    f->bodies.shape[slot] = shape;
    return slot;
}

static void field_open(field *f)
{
    *f = (field){.media = still_water};
    f->media.current = vec3_make(0.3, -0.1, 0);
    f->media.wind = vec3_make(-6, 5, 0);
    context_init(&f->ctx);
    fram_error error = {0};
    overlay *cutter = overlay_create(&f->ctx);
    ck_assert_ptr_nonnull(cutter);
    int32_t row;
    for (int i = 0; i < OUTLINES; i++)
        assert_ok(shape_add_prism(&f->ctx, &f->shapes, cutter, outline_of(i), half_height, 0, &row, &error), error);
    overlay_free(cutter);
    for (int i = 0; i < FLOES; i++)
        add_floe(f, i % OUTLINES);
}

static void field_close(field *f)
{
    table_free(&f->ctx, &f->bodies, &body_table_info);
    table_free(&f->ctx, &f->held, &held_drag_table_info);
    shape_store_free(&f->ctx, &f->shapes);
}

/* Drift, spin and swing of every share, tilted a little; the slowest 1e-6 of the fastest. */
static void stir(field *f, random_stream *r)
{
    body_table *b = &f->bodies;
    for (int i = 0; i < FLOES; i++) {
        double slow = i % 5 ? 1 : exp(random_uniform(r, -14, 0));
        vec3 swing = random_vector(r, 0.2 * slow);
        b->position[i] = vec3_make(0, 0, random_uniform(r, -0.2, 0.2));
        b->orientation[i] = quat_from_roll_pitch_yaw(random_uniform(r, -0.01, 0.01), random_uniform(r, -0.01, 0.01),
                                                     random_uniform(r, -3, 3));
        b->velocity[i] = vec3_add(i % 3 ? f->media.current : f->media.wind, random_vector(r, slow));
        b->angular_velocity[i] = i % 2 ? swing : vec3_make(0, 0, swing.z);
    }
}

static void apply(field *f, const drag_coefficients *c, held_drag_table *held)
{
    fram_error error = {0};
    assert_ok(fluid_apply(&f->ctx, &f->media, c, &f->bodies, &f->shapes, held, f->loads,
                          &(fluid_details){.volume = f->volume}, &error),
              error);
}

/* The motion of a floe as it was held is one that it had this time. */
static bool computed_in(const field *f, int32_t slot, const held_vectors *rows, vec3 medium)
{
    int32_t at = slot % HELD_LANES;
    mat3 r = quat_matrix(f->bodies.orientation[slot]);
    vec3 now = mat3_tmul_vec(r, vec3_sub(f->bodies.velocity[slot], medium));
    const held_vectors *v = &rows[slot / HELD_LANES];
    return v->x[at] == now.x && v->y[at] == now.y && v->z[at] == now.z;
}

static bool was_computed(const field *f, int32_t slot)
{
    return computed_in(f, slot, f->held.through_water, f->media.current);
}

static vec3 nudged(random_stream *r, vec3 v, double by) { return vec3_add(v, random_vector(r, by)); }

/* All motions change by up to about what is allowed, with the wind or the current as they are. */
static void nudge(field *f, random_stream *r, vec3 medium)
{
    body_table *b = &f->bodies;
    for (int i = 0; i < FLOES; i++) {
        double reach = f->shapes.shapes.plan_radius[b->shape[i]];
        vec3 through = vec3_sub(b->velocity[i], medium), spin = b->angular_velocity[i];
        double size = hypot(vec3_length(through), reach * vec3_length(spin)), by = HELD_MOTION * size;
        double scale = random_uniform(r, 0.7, 1.5);
        b->velocity[i] = vec3_add(medium, nudged(r, vec3_scale(through, scale), by));
        b->angular_velocity[i] = nudged(r, vec3_scale(spin, scale), by / reach);
        b->position[i].z += random_uniform(r, -0.5, 0.5) * HELD_LINE * half_height;
    }
}

/* Form and skin drag, in water and air, of floes that were nudged: apart from what is computed by at most 1.5e-3 of the
   drag of the cap at the largest speed (2.8e-3 is what no motion can exceed); many of them held. */
START_TEST(within_its_bound)
{
    static const drag_coefficients kinds[4] = {
        {.water_form = 1}, {.water_skin = 0.01}, {.air_form = 0.8}, {.air_skin = 0.003}};
    static const double size_of[4] = {0.5 * 1025, 0.5 * 1025 * 0.01, 0.5 * 1.25 * 0.8, 0.5 * 1.25 * 0.003};
    field f;
    field_open(&f);
    random_stream r = random_begin(31, 0, 0);
    for (int kind = 0; kind < 4; kind++) {
        const drag_coefficients c[MATERIAL_COUNT] = {kinds[kind]};
        vec3 medium = kind < 2 ? f.media.current : f.media.wind;
        double worst = 0;
        int held = 0;
        for (int round = 0; round < 10; round++) {
            stir(&f, &r);
            table_resize(&f.ctx, &f.held, &held_drag_table_info, 0);
            apply(&f, c, &f.held);
            nudge(&f, &r, medium);
            apply(&f, c, &f.held);
            wrench found[FLOES];
            memcpy(found, f.loads, sizeof found);
            apply(&f, c, NULL);
            for (int i = 0; i < FLOES; i++) {
                const body_table *b = &f.bodies;
                double reach = f.shapes.shapes.plan_radius[b->shape[i]], area = f.shapes.shapes.area[b->shape[i]];
                double through = vec3_length(vec3_sub(b->velocity[i], medium));
                if (kind > 1) /* air: the faster of both motions counts */
                    through = fmax(through, vec3_length(vec3_sub(b->velocity[i], f.media.current)));
                double speed = through + reach * vec3_length(b->angular_velocity[i]);
                double size = size_of[kind] * area * (speed * speed);
                double force = vec3_length(vec3_sub(found[i].force, f.loads[i].force));
                double moment = vec3_length(vec3_sub(found[i].moment, f.loads[i].moment)) / reach;
                /* Rounding of buoyancy. */
                double rounding = 1e-13 * 1025 * 9.81 * area;
                worst = testing_larger(worst, (testing_larger(force, moment) - rounding) / size);
                held += !computed_in(&f, i, kind < 2 ? f.held.through_water : f.held.through_air, medium);
            }
        }
        ck_assert_msg(worst < 1.5e-3 && worst > 1e-5, "kind %d: %g", kind, worst);
        ck_assert_msg(held > 500, "kind %d: %d", kind, held);
    }
    field_close(&f);
}
END_TEST

static const drag_coefficients all_kinds[MATERIAL_COUNT] = {{1, 0.01, 0.8, 0.003}};

/* The same motion, only faster, in water and air at once: the drag goes with its square, and nothing is computed. */
START_TEST(goes_with_the_square)
{
    field f;
    field_open(&f);
    f.media.wind = f.media.current;
    random_stream r = random_begin(32, 0, 0);
    stir(&f, &r);
    apply(&f, all_kinds, &f.held);
    for (int i = 0; i < FLOES; i++) {
        vec3 through = vec3_sub(f.bodies.velocity[i], f.media.current);
        f.bodies.velocity[i] = vec3_add(f.media.current, vec3_scale(through, 1.5));
        f.bodies.angular_velocity[i] = vec3_scale(f.bodies.angular_velocity[i], 1.5);
    }
    apply(&f, all_kinds, &f.held);
    wrench found[FLOES];
    double volume[FLOES];
    memcpy(found, f.loads, sizeof found);
    memcpy(volume, f.volume, sizeof volume);
    apply(&f, all_kinds, NULL);
    for (int i = 0; i < FLOES; i++) {
        ck_assert_msg(!was_computed(&f, i), "floe %d", i);
        double weight = 1025 * 9.81 * f.volume[i];
        assert_relative(volume[i], f.volume[i], 1e-14);
        assert_vec3_close(found[i].force, f.loads[i].force, 1e-11 * vec3_length(f.loads[i].force));
        assert_vec3_close(found[i].moment, f.loads[i].moment, 1e-11 * weight);
    }
    field_close(&f);
}
END_TEST

/* What floats at rest is computed once, whatever it trembles; and so is what drifts with its medium. */
START_TEST(rest_costs_nothing)
{
    field f;
    field_open(&f);
    random_stream r = random_begin(33, 0, 0);
    f.media.current = f.media.wind = vec3_make(0, 0, 0);
    for (int step = 0; step < 20; step++) {
        for (int i = 0; i < FLOES; i++) {
            f.bodies.velocity[i] = random_vector(&r, 1e-7);
            f.bodies.angular_velocity[i] = random_vector(&r, 1e-8);
        }
        apply(&f, all_kinds, &f.held);
        for (int i = 0; i < FLOES; i++)
            ck_assert_int_eq(was_computed(&f, i), step == 0);
    }
    field_close(&f);
}
END_TEST

/* Beyond what is allowed, in another place in the water, in another body of the same slot: the bits of what is computed
   without anything held. */
START_TEST(computed_anew)
{
    field f;
    field_open(&f);
    random_stream r = random_begin(34, 0, 0);
    for (int way = 0; way < 5; way++) {
        stir(&f, &r);
        for (int i = 0; i < FLOES; i++)
            f.bodies.velocity[i] = vec3_add(f.media.current, vec3_make(0.4, 0.1, 0.02));
        apply(&f, all_kinds, &f.held);
        for (int i = 0; i < FLOES; i++) {
            body_table *b = &f.bodies;
            if (way == 0) /* across the motion */
                b->velocity[i] = vec3_add(b->velocity[i], vec3_make(-0.01, 0.04, 0));
            else if (way == 1) /* turned about */
                b->velocity[i] = vec3_sub(f.media.current, vec3_sub(b->velocity[i], f.media.current));
            else if (way == 2)
                b->angular_velocity[i].z += 0.05;
            else if (way == 3)
                b->position[i].z += 2 * HELD_LINE * half_height;
            else {
                vec3 velocity = b->velocity[i], position = b->position[i];
                quat turn = b->orientation[i];
                body_remove(b, i);
                ck_assert_int_eq(add_floe(&f, (i + 1) % OUTLINES), i);
                b->velocity[i] = velocity, b->position[i] = position, b->orientation[i] = turn;
            }
        }
        apply(&f, all_kinds, &f.held);
        wrench found[FLOES];
        memcpy(found, f.loads, sizeof found);
        apply(&f, all_kinds, NULL);
        assert_array_bits(&found[0].force.x, &f.loads[0].force.x, FLOES * (long)(sizeof *found / sizeof(double)));
    }
    field_close(&f);
}
END_TEST

/* A floe that the water no longer cuts through its sides alone is forgotten, and held again when it is back. */
START_TEST(tilted_floes)
{
    field f;
    field_open(&f);
    apply(&f, all_kinds, &f.held);
    ck_assert_uint_eq(f.held.generation[0].lane[0], 1);
    f.bodies.orientation[0] = quat_from_roll_pitch_yaw(0.3, 0, 0);
    apply(&f, all_kinds, &f.held);
    ck_assert_uint_eq(f.held.generation[0].lane[0], 0);
    f.bodies.orientation[0] = quat_identity();
    apply(&f, all_kinds, &f.held);
    ck_assert_uint_eq(f.held.generation[0].lane[0], 1);
    ck_assert_uint_eq(f.held.generation[0].lane[1], 1);
    field_close(&f);
}
END_TEST

/* Loads and what is held, over steps, in a current that changes with depth. */
START_TEST(instructions)
{
    wrench expected[FLOES];
    uint64_t hash = 0;
    const isa best = isa_best();
    for (int set = ISA_BASELINE; set <= (int)best; set++) {
        field f;
        field_open(&f);
        f.ctx.isa = (isa)set;
        f.media.profile = (current_profile){2, {0.2, 1.5}, {{0, 0, 0}, {0.2, 0.1, 0}}};
        random_stream r = random_begin(35, 0, 0);
        stir(&f, &r);
        for (int step = 0; step < 6; step++) {
            apply(&f, all_kinds, &f.held);
            nudge(&f, &r, f.media.current);
        }
        uint64_t found = table_hash(&f.held, &held_drag_table_info, 1);
        if (set > ISA_BASELINE) {
            assert_array_bits(&f.loads[0].force.x, &expected[0].force.x,
                              FLOES * (long)(sizeof *expected / sizeof(double)));
            ck_assert_uint_eq(found, hash);
        }
        memcpy(expected, f.loads, sizeof expected);
        hash = found;
        field_close(&f);
    }
}
END_TEST

TEST_MAIN("held_drag", within_its_bound, goes_with_the_square, rest_costs_nothing, computed_anew, tilted_floes,
          instructions)

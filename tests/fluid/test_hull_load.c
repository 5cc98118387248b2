/* Solids of many triangles by their tree, against the walk over all of them. */
#include "base/pool.h"
#include "fluid/hull_load.h"
#include "samples.h"

static const drag_coefficients all_kinds = {1, 0.01, 0.8, 0.003}, none = {0};

/* A ship-like spheroid with a flat deck at z = 0.3 of its height, `rings` x `sectors` quadrilaterals. */
static mesh spheroid(context *ctx, double length, double beam, double depth, int rings, int sectors)
{
    mesh m = {0};
    ck_assert(mesh_add_vertex(ctx, &m, vec3_make(-0.5 * length, 0, 0)));
    for (int i = 1; i < rings; i++) {
        double a = PI * i / rings, along = -0.5 * length * real_cos(a), wide = real_sin(a);
        for (int k = 0; k < sectors; k++) {
            double b = 2 * PI * k / sectors, up = depth * wide * real_sin(b);
            ck_assert(
                mesh_add_vertex(ctx, &m, vec3_make(along, 0.5 * beam * wide * real_cos(b), fmin(up, 0.3 * depth))));
        }
    }
    ck_assert(mesh_add_vertex(ctx, &m, vec3_make(0.5 * length, 0, 0)));
    int32_t last = m.vertex.count - 1;
    for (int k = 0; k < sectors; k++) {
        int32_t next = (k + 1) % sectors;
        ck_assert(mesh_add_triangle(ctx, &m, 0, 1 + next, 1 + k));
        for (int i = 1; i + 1 < rings; i++) {
            int32_t a = 1 + (i - 1) * sectors, b = a + sectors;
            ck_assert(mesh_add_triangle(ctx, &m, a + k, a + next, b + next));
            ck_assert(mesh_add_triangle(ctx, &m, a + k, b + next, b + k));
        }
        ck_assert(mesh_add_triangle(ctx, &m, last, last - sectors + k, last - sectors + next));
    }
    return m;
}

typedef struct hull {
    context ctx;
    solid_array solids;
} hull;

static const solid *hull_open(hull *h, int rings, int sectors)
{
    *h = (hull){0};
    context_init(&h->ctx);
    mesh m = spheroid(&h->ctx, 200, 40, 15, rings, sectors);
    ck_assert(mesh_solid_properties(&m).volume > 0);
    polyhedron_array pieces = {0};
    int32_t index;
    fram_error error = {0};
    assert_ok(solid_add(&h->ctx, &h->solids, &m, &pieces, 0, &index, &error), error);
    return &h->solids.data[index];
}

static void hull_close(hull *h) { solid_array_free(&h->ctx, &h->solids); }

static fluid_motion random_state(random_stream *r, double tilt)
{
    /* One after the other: the order in which arguments are worked out is the compiler's. */
    double z = random_uniform(r, -4, 2), roll = random_uniform(r, -tilt, tilt), pitch = random_uniform(r, -tilt, tilt);
    fluid_motion s = motion_at(vec3_make(0, 0, z), roll, pitch, random_uniform(r, -3, 3));
    s.velocity = random_vector(r, 1.5);
    s.angular_velocity = random_vector(r, 0.01);
    return s;
}

START_TEST(pressure_is_exact)
{
    static const int size[3][2] = {{6, 8}, {40, 60}, {130, 150}};
    for (int k = 0; k < 3; k++) {
        hull h;
        const solid *body = hull_open(&h, size[k][0], size[k][1]);
        random_stream r = random_begin(21, 0, 0);
        for (int i = 0; i < 60; i++) {
            fluid_motion state = random_state(&r, i % 3 ? 0.1 : 1.5);
            if (i % 10 == 0)
                state.position.z = i % 20 ? 300 : -300;
            fluid_load got, expected;
            fluid_load_solid(&h.ctx, &still_water, &none, body, &state, &got);
            fluid_load_mesh(&still_water, &(drag_coefficients){0}, &body->surface, &state, &expected);
            double size_of = 1025 * 9.81 * 5e4 * (1 + fabs(state.position.z) / 10);
            assert_vec3_close(got.hydrostatic.force, expected.hydrostatic.force, 1e-13 * size_of);
            assert_vec3_close(got.hydrostatic.moment, expected.hydrostatic.moment, 1e-13 * size_of * 100);
            assert_absolute(got.submerged_volume, expected.submerged_volume,
                            1e-12 * 5e4 * (1 + fabs(state.position.z)));
            ck_assert(vec3_length(got.water_drag.force) == 0 && vec3_length(got.wind_drag.force) == 0);
        }
        hull_close(&h);
    }
}
END_TEST

/* In terms of the drag of all the surface at the largest speed; `coarse` for the hull of 80 triangles. */
static void check_drag(const media *m, const drag_coefficients *c, double coarse, double fine)
{
    static const int size[3][2] = {{6, 8}, {40, 60}, {130, 150}};
    for (int k = 0; k < 3; k++) {
        hull h;
        const solid *body = hull_open(&h, size[k][0], size[k][1]);
        double area = 0, bound = k == 0 ? coarse : fine;
        for (int32_t i = 0; i < body->surface.face.count; i++)
            area += vec3_length(mesh_area_vector(&body->surface, i));
        random_stream r = random_begin(22, 0, 0);
        double worst = 0, worst_moment = 0;
        for (int i = 0; i < 60; i++) {
            fluid_motion state = random_state(&r, i % 3 ? 0.1 : 1.5);
            fluid_load got, expected = {0};
            fluid_load_solid(&h.ctx, m, c, body, &state, &got);
            fluid_load_mesh(m, c, &body->surface, &state, &expected);
            double speed =
                vec3_length(vec3_sub(state.velocity, m->current)) + 100 * vec3_length(state.angular_velocity);
            double size_of = 0.5 * area * speed * speed * 1025 * (c->water_form + c->water_skin);
            wrench a = got.water_drag, b = expected.water_drag;
            worst = testing_larger(worst, vec3_length(vec3_sub(a.force, b.force)) / size_of);
            worst_moment = testing_larger(worst_moment, vec3_length(vec3_sub(a.moment, b.moment)) / (100 * size_of));
            speed = vec3_length(vec3_sub(state.velocity, m->wind)) + 100 * vec3_length(state.angular_velocity);
            size_of = 0.5 * area * speed * speed * 1.25 * (c->air_form + c->air_skin);
            a = got.wind_drag, b = expected.wind_drag;
            worst = testing_larger(worst, vec3_length(vec3_sub(a.force, b.force)) / size_of);
            worst_moment = testing_larger(worst_moment, vec3_length(vec3_sub(a.moment, b.moment)) / (100 * size_of));
        }
        ck_assert_msg(worst < bound && worst_moment < bound, "%d triangles, %d points: %g, moment %g",
                      (int)body->surface.face.count, (int)body->integrals.x.count, worst, worst_moment);
        hull_close(&h);
    }
}

START_TEST(drag)
{
    media windy = still_water;
    windy.current = vec3_make(0.5, 0.3, 0);
    windy.wind = vec3_make(-8, 4, 0);
    static const drag_coefficients form = {1, 0, 0.8, 0}, skin = {0, 0.01, 0, 0.003};
    check_drag(&windy, &form, 1e-3, 1e-3);
    check_drag(&windy, &skin, 1e-3, 1e-3);
}
END_TEST

START_TEST(current_of_depth)
{
    media m = still_water;
    m.current = vec3_make(0.1, 0, 0);
    m.profile = (current_profile){4, {0, 3, 8, 20}, {{1, 0, 0}, {0.6, 0.2, 0}, {0, 0.3, 0}, {-0.5, 0, 0}}};
    static const drag_coefficients form = {1, 0, 0.8, 0};
    /* A point has one current for all that it stands for: 1.1e-3 is the most of 3,000 states. */
    check_drag(&m, &form, 1.5e-3, 1e-3);
    assert_vec3_close(media_current(&m, 1), vec3_make(1.1, 0, 0), 1e-15);
    assert_vec3_close(media_current(&m, -1.5), vec3_make(0.9, 0.1, 0), 1e-15);
    assert_vec3_close(media_current(&m, -8), vec3_make(0.1, 0.3, 0), 1e-15);
    assert_vec3_close(media_current(&m, -14), vec3_make(-0.15, 0.15, 0), 1e-15);
    assert_vec3_close(media_current(&m, -50), vec3_make(-0.4, 0, 0), 1e-15);
}
END_TEST

/* A box of 12 triangles across a current: form drag is the integral of |U| U over its depth, though a triangle of a
   side has all of it, and so is its moment; sheared water that turns about pushes on both sides. */
START_TEST(few_large_triangles_in_a_current_of_depth)
{
    static const current_profile layered = {3, {0, 3, 4}, {{0, 0.8, 0}, {0, 0.8, 0}, {0, 0, 0}}},
                                 turning = {2, {0, 6}, {{0, 0.8, 0}, {0, -0.4, 0}}},
                                 deeper = {2, {6, 9}, {{0, 0.8, 0}, {0, 5, 0}}};
    static const drag_coefficients form = {1, 0, 0, 0}, skin = {0, 1, 0, 0};
    hull h = {0};
    context_init(&h.ctx);
    mesh box = {0};
    polyhedron_array pieces = {0};
    int32_t index;
    fram_error error = {0};
    ck_assert(mesh_make_box(&h.ctx, vec3_make(-30, -7, -6), vec3_make(30, 7, 3), &box));
    assert_ok(solid_add(&h.ctx, &h.solids, &box, &pieces, 0, &index, &error), error);
    const solid *body = &h.solids.data[index];
    const fluid_motion still = motion_at(vec3_make(0, 0, 0), 0, 0, 0);
    media m = still_water;
    double each = 0.5 * 1025 * 60, u = 0.8 * 0.8;
    fluid_load got, walk;
    m.profile = layered;
    fluid_load_solid(&h.ctx, &m, &form, body, &still, &got);
    assert_relative(got.water_drag.force.y, each * u * (3 + 1.0 / 3), 1e-12);
    assert_relative(got.water_drag.moment.x, each * u * (4.5 + 1 + 1.0 / 12), 1e-12);
    fluid_load_mesh(&m, &form, &body->surface, &still, &walk);
    assert_vec3_close(walk.water_drag.force, got.water_drag.force, 1e-9 * each);
    assert_vec3_close(walk.water_drag.moment, got.water_drag.moment, 1e-9 * each);
    /* Skin on both ends and the bottom, where the water is at rest. */
    fluid_load_solid(&h.ctx, &m, &skin, body, &still, &got);
    assert_relative(got.water_drag.force.y, 0.5 * 1025 * 2 * 14 * u * (3 + 1.0 / 3), 1e-12);
    m.profile = turning;
    fluid_load_solid(&h.ctx, &m, &form, body, &still, &got);
    assert_relative(got.water_drag.force.y, each * (4 * u - 2 * 0.25 * u) / 3, 1e-12);
    /* Its bottom lies where the profile bends. */
    m.profile = deeper;
    fluid_load_solid(&h.ctx, &m, &skin, body, &still, &got);
    assert_relative(got.water_drag.force.y, 0.5 * 1025 * u * (2 * 14 * 6 + 60 * 14), 1e-12);
    hull_close(&h);
}
END_TEST

/* The same bits on any number of threads and with any instruction set. */
START_TEST(threads_and_instructions)
{
    hull h;
    const solid *body = hull_open(&h, 80, 90);
    ck_assert_int_gt(body->surface.face.count, 4000);
    random_stream r = random_begin(23, 0, 0);
    media m = still_water;
    m.profile = (current_profile){2, {0, 9}, {{1, 0, 0}, {0, 1, 0}}};
    const isa best = isa_best();
    for (int i = 0; i < 20; i++) {
        fluid_motion state = random_state(&r, 0.3);
        fluid_load expected;
        h.ctx.isa = best;
        fluid_load_solid(&h.ctx, &m, &all_kinds, body, &state, &expected);
        for (int k = 0; k <= (int)best; k++) {
            h.ctx.isa = (isa)k;
            h.ctx.threads = pool_create(&h.ctx, 1 + k);
            fluid_load got;
            fluid_load_solid(&h.ctx, &m, &all_kinds, body, &state, &got);
            assert_array_bits(&got.hydrostatic.force.x, &expected.hydrostatic.force.x,
                              (long)(sizeof got / sizeof(double)));
            pool_free(&h.ctx, h.ctx.threads);
            h.ctx.threads = NULL;
        }
    }
    hull_close(&h);
}
END_TEST

TEST_MAIN("hull_load", pressure_is_exact, drag, current_of_depth, few_large_triangles_in_a_current_of_depth,
          threads_and_instructions)

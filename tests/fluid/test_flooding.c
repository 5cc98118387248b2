/* Upper faces of ice that is pressed under: closed forms of dry and half flooded faces, the way of the water against
   its own equation, and when a face counts as flooded. */
#include "samples.h"

#include "base/pool.h"
#include "geometry/polygon.h"

/* A plank that turns about one end of its upper face, which stays in the water plane. */
#define LENGTH 4.0
#define WIDTH 3.0
#define HALF 0.25
static const vec2 plank[] = {
    {-LENGTH / 2, -WIDTH / 2}, {LENGTH / 2, -WIDTH / 2}, {LENGTH / 2, WIDTH / 2}, {-LENGTH / 2, WIDTH / 2}};
#define WEIGHT (1025 * 9.81)
/* Of the discharge over a width at a depth of 1 m [m1.5/s]. */
static double weir(void) { return 8.0 / 27 * sqrt(9.81); }

static mat3 turned(double angle) { return quat_matrix(quat_from_roll_pitch_yaw(0, angle, 0)); }

static wrench advance(double angle, double dt, flooding_state *s)
{
    mat3 r = turned(angle);
    double height = -(0.5 * LENGTH * real_sin(angle) + HALF * real_cos(angle));
    return flooding_advance(&still_water, OUTLINE(plank), HALF, &r, height, dt, s);
}

/* The load of a pressure that grows evenly along the plank's face from a place to its deep end. */
static wrench wedge_load(double angle, double from)
{
    mat3 r = turned(angle);
    double length = LENGTH - from, size = WEIGHT * WIDTH * 0.5 * length * length * real_sin(angle);
    vec3 at = mat3_mul_vec(r, vec3_make(0.5 * LENGTH - length / 3, 0, HALF));
    vec3 force = vec3_scale(mat3_column(r, 2), size);
    return (wrench){force, vec3_cross(at, force)};
}

static void assert_wrench(wrench found, wrench expected, double part)
{
    double size = vec3_length(expected.force);
    assert_vec3_close(found.force, expected.force, part * size);
    assert_vec3_close(found.moment, expected.moment, part * size * LENGTH);
}

static wrench without(wrench a, wrench b) { return (wrench){vec3_sub(a.force, b.force), vec3_sub(a.moment, b.moment)}; }

static const flooding_state dry = {0, FLOODING_TOP, false};

START_TEST(a_face_turned_at_once_is_dry)
{
    for (double angle = 0.01; angle < 1.5; angle += 0.17) {
        flooding_state s = dry;
        assert_wrench(advance(angle, 0.01, &s), wedge_load(angle, 0), 1e-12);
        ck_assert(s.face == FLOODING_TOP && !s.drowned);
        /* Over the deep end and both sides, by integrals of depth^1.5. */
        double deep = LENGTH * real_sin(angle), along = LENGTH * real_cos(angle);
        double expected = 0.01 * weir() * deep * sqrt(deep) * (WIDTH + 2 * 0.4 * along);
        assert_relative(s.water, expected, 1e-12);
    }
}
END_TEST

START_TEST(water_lies_at_the_deep_end)
{
    double angle = 0.3, slope = real_sin(angle) * real_cos(angle);
    for (int i = 1; i <= 6; i++) {
        static const double wet[] = {1e-5, 0.01, 0.3, 0.7, 0.99, 1};
        double length = wet[i - 1] * LENGTH;
        flooding_state s = {WIDTH * 0.5 * length * length * slope, FLOODING_TOP, false};
        wrench found = advance(angle, 0, &s);
        wrench expected = without(wedge_load(angle, 0), wedge_load(angle, LENGTH - length));
        double size = vec3_length(wedge_load(angle, 0).force);
        assert_vec3_close(found.force, expected.force, 1e-11 * size);
        assert_vec3_close(found.moment, expected.moment, 1e-11 * size * LENGTH);
        /* What is missing upward is the weight of the water that is not there. */
        double room = WIDTH * 0.5 * LENGTH * LENGTH * slope;
        assert_absolute(found.force.z, WEIGHT * (room - s.water), 1e-11 * size);
    }
}
END_TEST

/* Discharge at an angle, and its integral over a turn at a rate, by Simpson's rule. */
static double inflow_at(double angle)
{
    double deep = LENGTH * real_sin(angle);
    return weir() * deep * sqrt(deep) * (WIDTH + 0.8 * LENGTH * real_cos(angle));
}

static double water_after(double rate, double angle)
{
    enum { PARTS = 2000 };
    double sum = 0, part = angle / PARTS;
    for (int i = 0; i <= PARTS; i++)
        sum += (i == 0 || i == PARTS ? 1 : i % 2 ? 4 : 2) * inflow_at(part * i);
    return sum * part / 3 / rate;
}

static double room_at(double angle) { return WIDTH * 0.5 * LENGTH * LENGTH * real_sin(angle) * real_cos(angle); }

/* The load at an angle on the way, in so many steps. */
static wrench turn(double rate, double angle, int steps, flooding_state *s)
{
    *s = dry;
    wrench found = {{0, 0, 0}, {0, 0, 0}};
    for (int i = 0; i <= steps; i++)
        found = advance(angle * i / steps, i < steps ? angle / steps / rate : 0, s);
    return found;
}

START_TEST(the_way_of_the_water)
{
    for (double rate = 0.3; rate < 3; rate *= 2) {
        double angle = 0.25, water = water_after(rate, angle);
        ck_assert(water < room_at(angle));
        double length = sqrt(2 * water / (WIDTH * real_sin(angle) * real_cos(angle)));
        wrench expected = without(wedge_load(angle, 0), wedge_load(angle, LENGTH - length));
        double before = 0;
        for (int steps = 50; steps <= 800; steps *= 4) {
            flooding_state s;
            wrench found = turn(rate, angle, steps, &s);
            double apart = fabs(s.water / water - 1);
            ck_assert_msg(apart < 2.0 / steps && (before == 0 || apart < 0.27 * before), "%g, %g before", apart,
                          before);
            assert_wrench(found, expected, 4.0 / steps);
            before = apart;
        }
    }
}
END_TEST

/* The angle at which the face is flooded; from there on the load is that of hydrostatics to the bit. */
static double flooded_from(double rate, double step)
{
    flooding_state s = dry;
    double from = 0;
    for (double angle = 0; angle < 0.5; angle += step) {
        wrench found = advance(angle, step / rate, &s);
        bool flooded = vec3_length(found.force) <= 0 && vec3_length(found.moment) <= 0;
        ck_assert(!flooded || angle <= 0 || angle >= from);
        if (!flooded)
            from = angle;
    }
    return from;
}

/* Small angles: (2/5) c rate^1.5 t^2.5 (W L^1.5 + (4/5) L^2.5) = W L^2 rate t / 2, so that the angle goes with
   rate^(2/3), to none. */
START_TEST(turned_slowly_it_is_flooded)
{
    for (double rate = 0.03; rate > 1e-5; rate *= 0.1) {
        double root = sqrt(LENGTH), gain = weir() * (WIDTH * LENGTH * root + 0.8 * LENGTH * LENGTH * root);
        double power = 1.25 * WIDTH * LENGTH * LENGTH * rate / gain; /* of the angle, 1.5 */
        double expected = real_exp(real_log(power) / 1.5);
        assert_relative(flooded_from(rate, expected / 500), expected, 0.03);
    }
}
END_TEST

/* Where on a face of any outline, in any attitude, water lies and presses: by points of a grid, and bisection. */
typedef struct grid_face {
    polygon outline;
    mat3 r;
    double height, half; /* half: of the face in the body's z */
    double low, high, step;
} grid_face;

static wrench grid_sum(const grid_face *g, double level, double *volume)
{
    wrench sum = {{0, 0, 0}, {0, 0, 0}};
    *volume = 0;
    vec3 up = vec3_scale(mat3_column(g->r, 2), g->half > 0 ? 1 : -1);
    double patch = g->step * g->step;
    for (double x = g->low + 0.5 * g->step; x < g->high; x += g->step) {
        for (double y = g->low + 0.5 * g->step; y < g->high; y += g->step) {
            vec3 at = mat3_mul_vec(g->r, vec3_make(x, y, g->half));
            double depth = level - (at.z + g->height);
            if (depth <= 0 || !polygon_contains(g->outline, vec2_make(x, y)))
                continue;
            vec3 force = vec3_scale(up, WEIGHT * depth * patch);
            sum.force = vec3_add(sum.force, force);
            sum.moment = vec3_add(sum.moment, vec3_cross(at, force));
            *volume += depth * patch * up.z;
        }
    }
    return sum;
}

START_TEST(any_face_by_points)
{
    random_stream random = random_begin(3, 0, 0);
    const polygon outlines[3] = {OUTLINE(hexagon_outline), OUTLINE(arrow_outline), OUTLINE(comb_outline)};
    for (int i = 0; i < 12; i++) {
        grid_face g = {.outline = outlines[i % 3], .r = random_rotation(&random), .low = -5, .high = 9.5, .step = 0.1};
        bool top = g.r.m[2][2] > 0;
        g.height = random_uniform(&random, -4, 2);
        g.half = top ? 0.5 : -0.5;
        double room, found_room, share = random_uniform(&random, 0.05, 0.95), low = -20, high = 0;
        wrench full = grid_sum(&g, 0, &room);
        if (!(room > 0.5))
            continue;
        flooding_state s = {share * room, top ? FLOODING_TOP : FLOODING_BOTTOM, false};
        for (int k = 0; k < 24; k++) {
            double middle = 0.5 * (low + high), volume;
            grid_sum(&g, middle, &volume);
            *(volume > s.water ? &high : &low) = middle;
        }
        wrench expected = without(full, grid_sum(&g, high, &found_room));
        wrench found = flooding_advance(&still_water, g.outline, 0.5, &g.r, g.height, 0, &s);
        double size = vec3_length(full.force);
        assert_vec3_close(found.force, expected.force, 0.01 * size);
        assert_vec3_close(found.moment, expected.moment, 0.04 * size);
        assert_vec3_close(vec3_cross(found.force, mat3_column(g.r, 2)), vec3_make(0, 0, 0), 1e-12 * size);
    }
}
END_TEST

/* A piece and its mirror image get mirrored loads. */
START_TEST(mirrored)
{
    enum { CORNERS = sizeof hexagon_outline / sizeof *hexagon_outline };
    vec2 other[CORNERS];
    for (int i = 0; i < CORNERS; i++)
        other[i] = vec2_make(hexagon_outline[CORNERS - 1 - i].x, -hexagon_outline[CORNERS - 1 - i].y);
    quat q = quat_from_roll_pitch_yaw(0.2, 0.4, 0.3), mirror = {q.w, -q.x, q.y, -q.z};
    mat3 r = quat_matrix(q), m = quat_matrix(mirror);
    flooding_state a = {1.5, FLOODING_TOP, false}, b = a;
    wrench right = flooding_advance(&still_water, OUTLINE(hexagon_outline), 0.5, &r, -1, 0.1, &a);
    wrench left = flooding_advance(&still_water, OUTLINE(other), 0.5, &m, -1, 0.1, &b);
    double size = vec3_length(right.force);
    ck_assert(size > 0);
    assert_vec3_close(left.force, vec3_make(right.force.x, -right.force.y, right.force.z), 1e-11 * size);
    assert_vec3_close(left.moment, vec3_make(-right.moment.x, right.moment.y, -right.moment.z), 1e-10 * size);
    assert_relative(b.water, a.water, 1e-12);
}
END_TEST

static wrench at_height(double height, double roll, double dt, flooding_state *s)
{
    mat3 r = quat_matrix(quat_from_roll_pitch_yaw(roll, 0, 0));
    return flooding_advance(&still_water, OUTLINE(plank), HALF, &r, height, dt, s);
}

/* The water plane cuts two edges in their middle. */
START_TEST(edges_count_as_far_as_they_are_under)
{
    for (double roll = -0.7; roll < 1; roll += 0.4) {
        flooding_state s = dry;
        vec3 found = at_height(-HALF * real_cos(roll), roll, 0.1, &s).force;
        double deep = 0.5 * WIDTH * fabs(real_sin(roll)), along = 0.5 * WIDTH * real_cos(roll);
        assert_relative(s.water, 0.1 * weir() * deep * sqrt(deep) * (LENGTH + 0.8 * along), 1e-12);
        assert_relative(vec3_length(found), WEIGHT * LENGTH * 0.25 * WIDTH * deep, 1e-12);
    }
}
END_TEST

START_TEST(a_face_that_was_flooded_stays_so)
{
    flooding_state s = dry;
    double area = LENGTH * WIDTH, depth = 0.5;
    wrench found = at_height(-HALF - depth, 0, 0.1, &s);
    assert_relative(found.force.z, WEIGHT * area * depth, 1e-12);
    assert_relative(s.water, 0.1 * weir() * depth * sqrt(depth) * 2 * (LENGTH + WIDTH), 1e-12);
    /* 1.4 s later there is more water than room; a level face has it as a layer before. */
    double water = s.water;
    found = at_height(-HALF - depth, 0, 1.4, &s);
    assert_relative(found.force.z, WEIGHT * (area * depth - water), 1e-12);
    assert_vec3_close(found.moment, vec3_make(0, 0, 0), 1e-9 * found.force.z);
    ck_assert(!s.drowned);
    found = at_height(-HALF - depth, 0, 0.01, &s);
    ck_assert(s.drowned && vec3_length(found.force) <= 0);
    /* However fast it goes down, or turns over. */
    found = at_height(-10, 3, 0.01, &s);
    ck_assert(s.drowned && vec3_length(found.force) <= 0 && s.face == FLOODING_BOTTOM);
    /* What comes out is full as far as it is under water, and goes on with that water. */
    found = at_height(-0.2, 0.4, 0, &s);
    ck_assert(!s.drowned && vec3_length(found.force) <= 0 && s.water > 0);
    double held = s.water;
    found = at_height(-0.4, 0.4, 0, &s);
    ck_assert(vec3_length(found.force) > 0 && s.water <= held && s.water >= held);
    /* Out of the water it runs off. */
    found = at_height(1, 0.4, 1, &s);
    ck_assert(vec3_length(found.force) <= 0 && s.water <= 0 && s.face == FLOODING_TOP);
}
END_TEST

START_TEST(what_is_not_known_counts_as_flooded)
{
    flooding_state unseen = {0, FLOODING_NONE, false}, over = {0, FLOODING_BOTTOM, false},
                   none = {NAN, FLOODING_TOP, 0};
    ck_assert(vec3_length(at_height(-0.3, 0.3, 0, &unseen).force) <= 0);
    ck_assert(vec3_length(at_height(-0.3, 0.3, 0, &over).force) <= 0);
    ck_assert(vec3_length(at_height(-0.3, 0.3, 0, &none).force) <= 0);
    ck_assert(unseen.water > 0 && unseen.face == FLOODING_TOP && over.water > 0 && none.water > 0);
    flooding_state below = {-1, FLOODING_TOP, false}, zero = dry;
    vec3 found = at_height(-0.3, 0.3, 0, &below).force, expected = at_height(-0.3, 0.3, 0, &zero).force;
    assert_array_bits(&found.x, &expected.x, 3);
}
END_TEST

/* ---- many floes ---- */

enum { FLOES = 333 };

typedef struct field {
    context ctx;
    body_table bodies;
    shape_store shapes;
    flooding_table flooding;
    wrench loads[FLOES];
} field;

static void field_open(field *f, random_stream *r)
{
    *f = (field){0};
    context_init(&f->ctx);
    fram_error error = {0};
    overlay *cutter = overlay_create(&f->ctx);
    int32_t row[2];
    assert_ok(shape_add_prism(&f->ctx, &f->shapes, cutter, OUTLINE(hexagon_outline), 0.5, 0, &row[0], &error), error);
    assert_ok(shape_add_prism(&f->ctx, &f->shapes, cutter, OUTLINE(arrow_outline), 0.4, 0, &row[1], &error), error);
    overlay_free(cutter);
    for (int i = 0; i < FLOES; i++) {
        int32_t slot = body_create(&f->ctx, &f->bodies, i % 50 ? MOTION_DYNAMIC : MOTION_STATIC, MATERIAL_ICE);
        ck_assert_int_ge(slot, 0);
        f->bodies.shape[slot] = row[i % 2];
        f->bodies.position[slot] = vec3_make(0, 0, random_uniform(r, -0.1, 0.3));
    }
}

static void field_close(field *f)
{
    table_free(&f->ctx, &f->bodies, &body_table_info);
    table_free(&f->ctx, &f->flooding, &flooding_table_info);
    shape_store_free(&f->ctx, &f->shapes);
}

static void apply(field *f, bool ventilated, double dt)
{
    static const drag_coefficients coefficients[MATERIAL_COUNT];
    fram_error error = {0};
    const fluid_details details = {.flooding = ventilated ? &f->flooding : NULL, .time_step = dt};
    assert_ok(
        fluid_apply(&f->ctx, &still_water, coefficients, &f->bodies, &f->shapes, NULL, f->loads, &details, &error),
        error);
}

/* Two steps: level, then tilted and lower. */
static uint64_t dunk(int threads, wrench loads[FLOES])
{
    field f;
    random_stream r = random_begin(8, 0, 0);
    field_open(&f, &r);
    if (threads > 1) {
        f.ctx.threads = pool_create(&f.ctx, threads);
        ck_assert_ptr_nonnull(f.ctx.threads);
    }
    apply(&f, true, 0.02);
    for (int i = 0; i < FLOES; i++) {
        f.bodies.orientation[i] =
            quat_from_roll_pitch_yaw(random_uniform(&r, -0.5, 0.5), random_uniform(&r, -0.5, 0.5), 1);
        f.bodies.position[i].z -= random_uniform(&r, 0, 1);
    }
    apply(&f, true, 0.02);
    apply(&f, true, 0.02);
    memcpy(loads, f.loads, sizeof f.loads);
    uint64_t hash = table_hash(&f.flooding, &flooding_table_info, 1);
    int followed = 0;
    for (int i = 0; i < FLOES; i++) {
        ck_assert((f.flooding.generation[i] != 0) == body_is_dynamic(&f.bodies, i));
        followed += f.flooding.water[i] > 0;
    }
    ck_assert_int_gt(followed, FLOES / 2);
    apply(&f, false, 0.02);
    int lifted = 0;
    for (int i = 0; i < FLOES; i++)
        lifted += loads[i].force.z > f.loads[i].force.z;
    ck_assert_int_gt(lifted, FLOES / 2);
    if (f.ctx.threads)
        pool_free(&f.ctx, f.ctx.threads);
    field_close(&f);
    return hash;
}

START_TEST(threads_do_not_matter)
{
    static wrench alone[FLOES], together[FLOES];
    uint64_t hash = dunk(1, alone);
    for (int threads = 2; threads <= 5; threads += 3) {
        ck_assert(dunk(threads, together) == hash);
        assert_array_bits(&together[0].force.x, &alone[0].force.x, 6 * FLOES);
    }
}
END_TEST

/* A body that takes the slot of another one is not taken for it. */
START_TEST(the_next_body_of_a_slot)
{
    field f;
    random_stream r = random_begin(8, 0, 0);
    field_open(&f, &r);
    apply(&f, true, 0.02);
    int32_t slot = 7, shape = f.bodies.shape[slot];
    ck_assert(f.flooding.face[slot] == FLOODING_TOP);
    body_remove(&f.bodies, slot);
    ck_assert_int_eq(body_create(&f.ctx, &f.bodies, MOTION_DYNAMIC, MATERIAL_ICE), slot);
    f.bodies.shape[slot] = shape;
    f.bodies.position[slot].z = f.bodies.position[slot + 2].z = -1;
    apply(&f, true, 0.02);
    wrench fresh = f.loads[slot], other = f.loads[slot + 2];
    apply(&f, false, 0.02);
    /* Without flooding it is one of the sunken floes, which are summed up in another order. */
    assert_vec3_close(fresh.force, f.loads[slot].force, 1e-8);
    assert_vec3_close(fresh.moment, f.loads[slot].moment, 1e-8);
    ck_assert(f.flooding.drowned[slot] == 1 && f.flooding.drowned[slot + 2] == 0);
    ck_assert(other.force.z > f.loads[slot + 2].force.z);
    field_close(&f);
}
END_TEST

TEST_MAIN("flooding", a_face_turned_at_once_is_dry, water_lies_at_the_deep_end, the_way_of_the_water,
          turned_slowly_it_is_flooded, any_face_by_points, mirrored, edges_count_as_far_as_they_are_under,
          a_face_that_was_flooded_stays_so, what_is_not_known_counts_as_flooded, threads_do_not_matter,
          the_next_body_of_a_slot)

/* Strength that varies over the ice: statistics of the field against what was asked for, and that a value goes with the
   piece of ice that has it. */
#include "sheet_rig.h"

#include "ice/strength.h"
#include "ice_rig.h"

static const strength_field FIELD = {
    .seed = 7, .flexural_variation = 0.4, .crushing_variation = 0.25, .length = 3, .common = 0.6};

/* ---- statistics ---- */

/* Sums of two variables. */
typedef struct sums {
    double n, a, b, aa, bb, ab;
} sums;

static void sums_add(sums *s, double a, double b)
{
    s->n += 1;
    s->a += a;
    s->b += b;
    s->aa += a * a;
    s->bb += b * b;
    s->ab += a * b;
}

static double correlation(const sums *s)
{
    double ma = s->a / s->n, mb = s->b / s->n;
    return (s->ab / s->n - ma * mb) / sqrt((s->aa / s->n - ma * ma) * (s->bb / s->n - mb * mb));
}

/* Pairs of factors at places that are apart by `way`, the pairs ten correlation lengths from one another and at all
   places between the points of the lattice. */
static sums sample(const strength_field *f, strength_kind one, strength_kind two, vec2 way, bool logarithms)
{
    enum { ACROSS = 100 };
    sums s = {0};
    for (int i = 0; i < ACROSS; i++)
        for (int k = 0; k < ACROSS; k++) {
            vec2 at = {(i - ACROSS / 2) * 10.137 * f->length, (k - ACROSS / 2) * 10.291 * f->length};
            double a = strength_factor(f, NULL, one, at), b = strength_factor(f, NULL, two, vec2_add(at, way));
            if (logarithms)
                sums_add(&s, real_log(a), real_log(b));
            else
                sums_add(&s, a, b);
        }
    return s;
}

/* Of 10,000 independent pairs the standard error is 1 % of the deviation; four of them are allowed. */
START_TEST(mean_and_variation)
{
    const double c = FIELD.flexural_variation, d = FIELD.crushing_variation;
    sums s = sample(&FIELD, STRENGTH_FLEXURAL, STRENGTH_CRUSHING, (vec2){0, 0}, false);
    ck_assert_msg(fabs(s.a / s.n - 1) < 0.04 * c, "mean %g", s.a / s.n);
    ck_assert_msg(fabs(s.b / s.n - 1) < 0.04 * d, "mean %g", s.b / s.n);
    assert_relative(sqrt(s.aa / s.n - s.a * s.a / (s.n * s.n)), c, 0.05);
    assert_relative(sqrt(s.bb / s.n - s.b * s.b / (s.n * s.n)), d, 0.05);
    /* Lognormal: the logarithm is normal, with the variance ln(1 + c^2) and no skewness. */
    sums l = sample(&FIELD, STRENGTH_FLEXURAL, STRENGTH_CRUSHING, (vec2){0, 0}, true);
    double mean = l.a / l.n, variance = l.aa / l.n - mean * mean;
    assert_relative(variance, real_log(1 + c * c), 0.06);
    ck_assert_msg(fabs(mean + 0.5 * real_log(1 + c * c)) < 0.04 * c, "mean of the logarithm %g", mean);
    ck_assert_msg(fabs(correlation(&l) - FIELD.common) < 0.04, "both strengths: %g", correlation(&l));
}
END_TEST

START_TEST(correlation_length)
{
    static const vec2 WAYS[] = {{0.5, 0}, {1, 0}, {0, 1}, {0.6, -0.8}, {-1.2, 0.9}};
    for (size_t i = 0; i < sizeof WAYS / sizeof *WAYS; i++) {
        sums s = sample(&FIELD, STRENGTH_FLEXURAL, STRENGTH_FLEXURAL, vec2_scale(WAYS[i], FIELD.length), true);
        double expected = real_exp(-vec2_dot(WAYS[i], WAYS[i]));
        ck_assert_msg(fabs(correlation(&s) - expected) < 0.04, "%g, %g L: %g, not %g", WAYS[i].x, WAYS[i].y,
                      correlation(&s), expected);
    }
}
END_TEST

START_TEST(seeds_and_switches)
{
    strength_field other = FIELD, none = {.seed = 7, .length = 3}, together = FIELD, apart = FIELD;
    vec2 at = {12.3, -4.5};
    other.seed = 8;
    ck_assert(strength_factor(&FIELD, NULL, STRENGTH_FLEXURAL, at) !=
              strength_factor(&other, NULL, STRENGTH_FLEXURAL, at));
    ck_assert_double_eq(strength_factor(&none, NULL, STRENGTH_FLEXURAL, at), 1);
    ck_assert_double_eq(strength_factor(&none, NULL, STRENGTH_CRUSHING, at), 1);
    together.common = 1;
    together.crushing_variation = together.flexural_variation;
    ck_assert_double_eq(strength_factor(&together, NULL, STRENGTH_FLEXURAL, at),
                        strength_factor(&together, NULL, STRENGTH_CRUSHING, at));
    apart.common = 0;
    sums s = sample(&apart, STRENGTH_FLEXURAL, STRENGTH_CRUSHING, (vec2){0, 0}, true);
    ck_assert_msg(fabs(correlation(&s)) < 0.04, "%g", correlation(&s));
    /* Continuous: where a point of the lattice comes into reach too. */
    double largest = 0, before = strength_factor(&FIELD, NULL, STRENGTH_FLEXURAL, (vec2){0, 0.2});
    for (int i = 1; i <= 6000; i++) {
        double now = strength_factor(&FIELD, NULL, STRENGTH_FLEXURAL, (vec2){i * 1e-3, 0.2});
        largest = testing_larger(largest, fabs(now - before));
        before = now;
    }
    ck_assert_msg(largest < 2e-3, "a jump of %g within a millimetre", largest);
}
END_TEST

static void assert_remembered(const strength_field *f, strength_memory *memory, strength_kind kind, vec2 at)
{
    ck_assert_double_eq(strength_factor(f, memory, kind, at), strength_factor(f, NULL, kind, at));
}

/* What is remembered of the lattice changes no bit, whatever was asked for before, also by another field, or at places
   that share their rows of the memory. */
START_TEST(remembered)
{
    static strength_memory memory;
    const double again = STRENGTH_NOISES * 0.5 * FIELD.length;
    strength_field other = FIELD;
    other.seed = 8;
    random_stream r = random_begin(41, 0, 0);
    vec2 at = {0, 0};
    for (int i = 0; i < 2000; i++) {
        const strength_field *f = i / 50 % 2 ? &other : &FIELD;
        at = vec2_add(at, vec2_make(random_uniform(&r, -2, 2), random_uniform(&r, -2, 2)));
        const strength_kind kind = i / 500 % 2 ? STRENGTH_CRUSHING : STRENGTH_FLEXURAL;
        assert_remembered(f, &memory, kind, at);
        if (i % 10 == 0) {
            assert_remembered(f, &memory, kind, vec2_make(at.x, at.y + again));
            assert_remembered(f, &memory, kind, vec2_make(at.x + again, at.y));
        }
    }
}
END_TEST

/* ---- a value belongs to the ice ---- */

/* Every corner of every floe stands in the ice where it stood at the start: `back` undoes the way of the ice since. */
static void check_places(const fracture_rig *r, vec2 (*back)(vec2 global))
{
    for (int32_t row = 0; row < r->floes.count; row++) {
        if (r->floes.body[row] < 0)
            continue;
        polygon p = fracture_rig_outline(r, row);
        vec2 global[256] = {{0, 0}};
        ck_assert_int_le(fracture_rig_global(r, row, global, 256), 256);
        for (int32_t i = 0; i < p.count; i++) {
            vec2 at = strength_place(&r->floes, row, p.vertex[i]), was = back(global[i]);
            ck_assert_msg(vec2_length(vec2_sub(at, was)) < 1e-9, "floe %d: %g, %g, not %g, %g", row, at.x, at.y, was.x,
                          was.y);
        }
    }
}

static vec2 not_moved(vec2 p) { return p; }

/* The motion of the floe below. */
static const double TURN = 0.7;
static const vec2 WAY = {31, -8};
static vec2 moved_back(vec2 p)
{
    double c = real_cos(TURN), s = real_sin(TURN);
    vec2 d = vec2_sub(p, WAY);
    return (vec2){c * d.x + s * d.y, -s * d.x + c * d.y};
}

START_TEST(goes_with_a_floe)
{
    fracture_rig r;
    fracture_rig_make(&r);
    /* Made with a yaw, as a floe of a list is. */
    vec2 corner[4] = {{10, 5}, {70, 5}, {70, 65}, {10, 65}};
    int32_t row;
    fram_error e = {0};
    floe_definition d = {.outline = {corner, 4},
                         .thickness = 1,
                         .material = FRACTURE_RIG_ICE,
                         .breakable = true,
                         .motion = MOTION_DYNAMIC,
                         .yaw = 0.4,
                         .parent = -1};
    assert_ok(floe_create(&r.ctx, &d, 0.009, r.plane, &r.bodies, &r.shapes, &r.floes, &r.next_number, &row, &e), e);
    r.settings.splitting = SPLITTING_NONE;
    check_places(&r, not_moved);
    vec2 before = strength_place(&r.floes, row, (vec2){3, 4});
    int32_t body = r.floes.body[row];
    vec3 at = r.bodies.position[body];
    double c = real_cos(TURN), s = real_sin(TURN);
    r.bodies.position[body] = (vec3){WAY.x + c * at.x - s * at.y, WAY.y + s * at.x + c * at.y, at.z};
    r.bodies.orientation[body] = quat_from_roll_pitch_yaw(0, 0, 0.4 + TURN);
    ck_assert_double_eq(vec2_length(vec2_sub(strength_place(&r.floes, row, (vec2){3, 4}), before)), 0);
    check_places(&r, moved_back);
    vec2 mid =
        vec2_scale(vec2_add(fracture_rig_outline(&r, row).vertex[0], fracture_rig_outline(&r, row).vertex[1]), 0.5);
    ck_assert(fracture_rig_load(&r, row, mid, 2e6, 0.5));
    ck_assert_int_eq(fracture_rig_break(&r), 1);
    ck_assert_int_gt(fracture_rig_count(&r), 3);
    check_places(&r, moved_back);
    fracture_rig_free(&r);
}
END_TEST

START_TEST(goes_with_a_sheet)
{
    fracture_rig r;
    fracture_rig_make(&r);
    sheet_make(&r, (box2){{3, -20}, {63, 40}}, 20, NULL);
    check_places(&r, not_moved);
    /* Beside a seam, so that wedges of two tiles are one floe. */
    ck_assert(sheet_load(&r, (vec2){23.4, -20}, 2e6, 0.5));
    ck_assert_int_eq(fracture_rig_break(&r), 1);
    ck_assert_int_gt(fracture_rig_count(&r), 9);
    check_places(&r, not_moved);
    fracture_rig_free(&r);
}
END_TEST

/* ---- what it does ---- */

/* Ice breaks where it stands and as strong as it is there: a load just under the local strength does nothing. */
START_TEST(decides_on_bending)
{
    vec2 corner[4] = {{0, 0}, {200, 0}, {200, 200}, {0, 200}};
    double least = HUGE_VAL, most = 0;
    for (int i = 0; i < 5; i++) {
        fracture_rig r;
        fracture_rig_make(&r);
        r.settings.splitting = SPLITTING_NONE;
        r.settings.strength = FIELD;
        int32_t row = fracture_rig_floe(&r, (polygon){corner, 4}, 1, MOTION_DYNAMIC);
        vec2 at = {-60 + 30 * i, -100};
        double factor = strength_factor(&FIELD, NULL, STRENGTH_FLEXURAL, strength_place(&r.floes, row, at));
        edge_stress s = fracture_edge_stress(&r.settings, &FRACTURE_RIG_ICE, 1, 1, 0.5, EDGE_STRAIGHT);
        double load = factor * s.wedge_capacity;
        ck_assert(fracture_rig_load(&r, row, at, 0.99 * load, 0.5));
        ck_assert_int_eq(fracture_rig_break(&r), 0);
        ck_assert(fracture_rig_load(&r, row, at, 1.01 * load, 0.5));
        ck_assert_int_eq(fracture_rig_break(&r), 1);
        assert_relative(r.events.data[0].stress_ratio, 1.01, 1e-6);
        least = fmin(least, factor);
        most = fmax(most, factor);
        fracture_rig_free(&r);
    }
    ck_assert_msg(most > 1.3 * least, "factors from %g to %g", least, most);
}
END_TEST

/* Factor of the crushing strength of a floe at a point of the water. */
static double factor_at(const ice_rig *r, int32_t row, vec3 global)
{
    vec3 local = body_to_local(&r->bodies, r->floes.body[row], global);
    return strength_factor(&FIELD, NULL, STRENGTH_CRUSHING, strength_place(&r->floes, row, (vec2){local.x, local.y}));
}

/* A wall driven into a floe, and floes on floes, crush at the strength of the weaker ice where they meet. */
START_TEST(limits_crushing)
{
    ice_rig r;
    ice_rig_make(&r, 0.01);
    r.settings.strength = FIELD;
    int32_t row = ice_rig_plate(&r, 20, 20, 1, MOTION_STATIC), ice = r.floes.body[row];
    int32_t other = ice_rig_plate(&r, 6, 4, 1, MOTION_DYNAMIC), floe = r.floes.body[other];
    int32_t wall = ice_rig_box(&r, (vec3){-2, -2, -2}, (vec3){0, 2, 2}, MOTION_STATIC, MATERIAL_HULL);
    r.bodies.position[wall] = (vec3){-9.9, 3, 0};
    r.bodies.position[floe] = (vec3){12.9, -3, 0};
    ice_rig_pair(&r, ice, wall);
    ice_rig_pair(&r, ice, floe);
    ice_rig_crush(&r);
    ck_assert_int_eq(r.patches.count, 2);
    for (int32_t i = 0; i < 2; i++) {
        const crushing_patch *p = &r.patches.data[i];
        bool hull = p->surface_body == wall || p->floe_body == wall;
        double here = factor_at(&r, row, p->centre), own = factor_at(&r, other, p->centre);
        assert_relative(p->pressure, 2e6 * (hull ? here : fmin(here, own)), 1e-9);
        ck_assert_msg(fabs(here - 1) > 0.02 && fabs(here - own) > 0.01, "%g and %g tell nothing", here, own);
        double limit = 0;
        for (int32_t k = p->contact_first; k < p->contact_first + p->contact_count; k++)
            limit += r.contacts.data[k].impulse_limit;
        assert_relative(limit, p->pressure * p->area * 0.01, 1e-9);
    }
    /* Side to side, without patches. */
    r.policies.of[MATERIAL_ICE][MATERIAL_ICE] = (pair_policy){.sides = true};
    contact c = {.a = ice, .b = floe, .point = {10, -3, 0}, .normal = {-1, 0, 0}, .depth = 0.1, .patch = -1};
    array_clear(&r.contacts);
    ck_assert(array_push(&r.ctx, &r.contacts, c));
    crushing_limit_sides(&r.ctx, &r.settings, &r.bodies, &r.shapes, &r.floes, &r.policies, &r.contacts);
    double face = fmin(factor_at(&r, row, c.point), factor_at(&r, other, c.point));
    assert_relative(r.contacts.data[0].impulse_limit, 2e6 * face * 4 * 0.01, 1e-6);
    ice_rig_free(&r);
}
END_TEST

TEST_MAIN("strength", mean_and_variation, correlation_length, seeds_and_switches, remembered, goes_with_a_floe,
          goes_with_a_sheet, decides_on_bending, limits_crushing)

/* The kernels of free motion and of the solver's bodies, lane by lane against plain code, for every instruction set.
   Tables hold free slots, fixed, driven and dynamic bodies, with and without added mass, and end within a group. */
#include "base/random.h"
#include "dynamics/motion.h"
#include "dynamics/motion_kernel.h"
#include "dynamics/solver_bodies_kernel.h"
#include "dynamics/solver_rows.h"
#include "testing.h"

#include <string.h>

enum { BODIES = 43, DRAWS = 20 };
#define DT 0.02
#define EPSILON 1e-12

typedef struct sample {
    context ctx;
    body_table bodies;
    wrench loads[BODIES];
} sample;

static vec3 draw3(random_stream *d, double size)
{
    double x = random_uniform(d, -size, size), y = random_uniform(d, -size, size);
    return vec3_make(x, y, random_uniform(d, -size, size));
}

static void sample_draw(sample *s, uint64_t seed)
{
    memset(s, 0, sizeof *s);
    context_init(&s->ctx);
    for (uint32_t i = 0; i < BODIES; i++) {
        random_stream d = random_begin(seed, 0, i);
        const motion kinds[] = {MOTION_DYNAMIC, MOTION_DYNAMIC, MOTION_DYNAMIC, MOTION_STATIC, MOTION_PRESCRIBED};
        int32_t slot = body_create(&s->ctx, &s->bodies, kinds[(int)random_uniform(&d, 0, 4.999)], MATERIAL_ICE);
        ck_assert_int_eq(slot, (int32_t)i);
        body_table *b = &s->bodies;
        b->position[i] = draw3(&d, 100);
        vec3 turn = draw3(&d, 3);
        b->orientation[i] = quat_from_roll_pitch_yaw(turn.x, turn.y, turn.z);
        b->velocity[i] = draw3(&d, 2);
        b->angular_velocity[i] = draw3(&d, random_unit(&d) < 0.2 ? 0 : 3);
        b->mass[i] = random_uniform(&d, 1e3, 1e6);
        b->inertia[i] = (sym3){.xx = b->mass[i] * random_uniform(&d, 2, 3),
                               .yy = b->mass[i] * random_uniform(&d, 2, 3),
                               .zz = b->mass[i] * random_uniform(&d, 2, 3),
                               .xy = b->mass[i] * random_uniform(&d, -0.5, 0.5),
                               .xz = b->mass[i] * random_uniform(&d, -0.5, 0.5),
                               .yz = b->mass[i] * random_uniform(&d, -0.5, 0.5)};
        if (random_unit(&d) < 0.5) {
            b->added_mass[i] = vec3_scale(vec3_make(random_unit(&d), random_unit(&d), random_unit(&d)), b->mass[i]);
            b->added_inertia[i] = vec3_scale(vec3_make(random_unit(&d), 2, random_unit(&d)), b->mass[i]);
        }
        s->loads[i].force = draw3(&d, 10 * b->mass[i]);
        s->loads[i].moment = draw3(&d, 10 * b->mass[i]);
    }
    body_remove(&s->bodies, 5);
    body_remove(&s->bodies, BODIES - 2);
}

static void sample_free(sample *s) { table_free(&s->ctx, &s->bodies, &body_table_info); }

/* All samples with all instruction sets. */
static void for_all(void (*check)(sample *s))
{
    for (isa set = ISA_BASELINE; set <= isa_best(); set++) {
        for (uint64_t seed = 1; seed <= DRAWS; seed++) {
            sample s;
            sample_draw(&s, seed);
            s.ctx.isa = set;
            check(&s);
            sample_free(&s);
        }
    }
}

enum { GROUPS = (BODIES + 7) / 8 };

static void assert_same(const void *a, const void *b, size_t size, int slot)
{
    ck_assert_msg(memcmp(a, b, size) == 0, "slot %d is no body that moves freely, but was changed", slot);
}

/* ---- loads into velocities ---- */

static void check_accelerate(sample *s)
{
    sample old = *s;
    vec3 velocity[BODIES], spin[BODIES];
    memcpy(velocity, s->bodies.velocity, sizeof velocity);
    memcpy(spin, s->bodies.angular_velocity, sizeof spin);
    KERNEL_PICK(&s->ctx, motion_accelerate)(&s->bodies, s->loads, DT, 0, GROUPS);
    for (int32_t i = 0; i < BODIES; i++) {
        sym3 mass, inertia;
        body_inverse_tensors(&old.bodies, i, &mass, &inertia); /* zero for what loads do not move */
        vec3 push = vec3_scale(sym3_mul_vec(mass, s->loads[i].force), DT);
        vec3 turn = vec3_scale(sym3_mul_vec(inertia, s->loads[i].moment), DT);
        assert_vec3_close(s->bodies.velocity[i], vec3_add(velocity[i], push), EPSILON * 10);
        assert_vec3_close(s->bodies.angular_velocity[i], vec3_add(spin[i], turn), EPSILON * 10);
        if (!body_is_dynamic(&s->bodies, i)) {
            assert_same(&s->bodies.velocity[i], &velocity[i], sizeof(vec3), i);
            assert_same(&s->bodies.angular_velocity[i], &spin[i], sizeof(vec3), i);
        }
    }
}

START_TEST(loads_move_each_body_as_plain_code_does) { for_all(check_accelerate); }
END_TEST

/* ---- velocities into poses ---- */

/* Euler's equations by the midpoint rule, body frame: what is left of them. */
static vec3 spin_rest(sym3 inertia, vec3 before, vec3 after)
{
    vec3 middle = vec3_scale(vec3_add(before, after), 0.5);
    vec3 turned = vec3_scale(vec3_cross(middle, sym3_mul_vec(inertia, middle)), DT);
    return vec3_add(sym3_mul_vec(inertia, vec3_sub(after, before)), turned);
}

static void check_advance(sample *s)
{
    vec3 position[BODIES], spin[BODIES];
    quat orientation[BODIES];
    memcpy(position, s->bodies.position, sizeof position);
    memcpy(orientation, s->bodies.orientation, sizeof orientation);
    memcpy(spin, s->bodies.angular_velocity, sizeof spin);
    KERNEL_PICK(&s->ctx, motion_advance)(&s->bodies, DT, 0, GROUPS);
    for (int32_t i = 0; i < BODIES; i++) {
        body_table *b = &s->bodies;
        if (!body_is_dynamic(b, i)) {
            assert_same(&b->position[i], &position[i], sizeof(vec3), i);
            assert_same(&b->orientation[i], &orientation[i], sizeof(quat), i);
            assert_same(&b->angular_velocity[i], &spin[i], sizeof(vec3), i);
            continue;
        }
        mat3 old = quat_matrix(orientation[i]), now = quat_matrix(b->orientation[i]);
        vec3 before = mat3_tmul_vec(old, spin[i]), after = mat3_tmul_vec(now, b->angular_velocity[i]);
        vec3 rest = spin_rest(body_total_inertia(b, i), before, after);
        ck_assert_msg(vec3_length(rest) <= EPSILON * b->mass[i], "slot %d: %g of the equations is left", (int)i,
                      vec3_length(rest) / b->mass[i]);
        /* The pose by the plain step with the mean of both. */
        vec3 mean = mat3_mul_vec(old, vec3_scale(vec3_add(before, after), 0.5));
        vec3 to = b->position[i];
        quat q = b->orientation[i];
        b->position[i] = position[i];
        b->orientation[i] = orientation[i];
        body_move(b, i, b->velocity[i], mean, DT);
        assert_vec3_close(to, b->position[i], EPSILON);
        double apart = fabs(q.w - b->orientation[i].w) + fabs(q.x - b->orientation[i].x) +
                       fabs(q.y - b->orientation[i].y) + fabs(q.z - b->orientation[i].z);
        ck_assert_msg(apart <= EPSILON, "slot %d: turned %g off", (int)i, apart);
    }
}

START_TEST(free_bodies_turn_by_eulers_equations) { for_all(check_advance); }
END_TEST

/* ---- rows of the solver ---- */

enum { ROW = 8 };

static void assert_row(const char *name, const double *row, sym3 wanted, double scale)
{
    const double w[6] = {wanted.xx, wanted.yy, wanted.zz, wanted.xy, wanted.xz, wanted.yz};
    for (int k = 0; k < 6; k++)
        ck_assert_msg(fabs(row[k] - w[k]) <= EPSILON * scale, "%s %d: %g, not %g", name, k, row[k], w[k]);
}

static sym3 times(sym3 s, double f)
{
    return (sym3){.xx = f * s.xx, .yy = f * s.yy, .zz = f * s.zz, .xy = f * s.xy, .xz = f * s.xz, .yz = f * s.yz};
}

static void check_masses(sample *s)
{
    static const double factors[] = {1, 8};
    for (int32_t first = 0; first < BODIES; first++) {
        double factor = factors[first % 2], room[4][ROW * ROW + ROW];
        double *at[4]; /* on cache lines */
        for (int k = 0; k < 4; k++)
            at[k] = room[k] + (64 - (uintptr_t)room[k] % 64) % 64 / sizeof(double);
        body_rows rows = {at[0], at[1], at[2], at[3]};
        int32_t slot[ROW];
        for (int32_t i = 0; i < ROW; i++)
            slot[i] = i == first % ROW ? -1 : (first + 7 * i) % BODIES;
        KERNEL_PICK(&s->ctx, solver_masses)(&s->bodies, slot, factor, &rows);
        for (int32_t i = 0; i < ROW; i++) {
            const double *inverse = at[0] + ROW * i;
            sym3 mass, inertia, none = {0};
            body_inverse_tensors(&s->bodies, slot[i], &mass, &inertia);
            bool moves = mass.xx > 0, whole = moves && factor == 1;
            double m = moves ? s->bodies.mass[slot[i]] : 1;
            assert_row("inverse inertia", inverse + INVERSE_INERTIA, times(inertia, factor), factor / m);
            assert_row("inverse mass", at[1] + ROW * i, times(mass, factor), factor / m);
            ck_assert_double_eq_tol(inverse[INVERSE_MASS], factor * mass.xx, EPSILON * factor / m);
            vec3 added = moves ? s->bodies.added_mass[slot[i]] : vec3_make(0, 0, 0);
            ck_assert_double_eq(inverse[INVERSE_GENERAL], added.x > 0 || added.y > 0 || added.z > 0 ? 1 : 0);
            assert_row("mass", at[2] + ROW * i, whole ? sym3_inverse(mass) : none, 100 * m);
            assert_row("inertia", at[3] + ROW * i, whole ? sym3_inverse(inertia) : none, 100 * m);
        }
    }
}

START_TEST(rows_of_the_solver_hold_the_bodies_tensors) { for_all(check_masses); }
END_TEST

TEST_MAIN("motion_kernel", loads_move_each_body_as_plain_code_does, free_bodies_turn_by_eulers_equations,
          rows_of_the_solver_hold_the_bodies_tensors)

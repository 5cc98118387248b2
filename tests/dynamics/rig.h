/* A small world of rigid bodies for the tests of dynamics: the stages of a step without ice, water and vessels. */
#ifndef RIG_H
#define RIG_H

#include "books.h"
#include "dynamics/collision.h"
#include "dynamics/solver.h"
#include "testing.h"

#define GRAVITY 9.81

/* The solver of new rigs: RIG_MAIN runs every test once with each. */
static solver_kind rig_kind = SOLVER_SEQUENTIAL;
static inline void rig_use_sequential(void) { rig_kind = SOLVER_SEQUENTIAL; }
static inline void rig_use_fast(void) { rig_kind = SOLVER_FAST; }
static inline void rig_use_accurate(void) { rig_kind = SOLVER_ACCURATE; }

#define RIG_MAIN(name, ...)                                             \
    int main(void)                                                      \
    {                                                                   \
        const TTest *const list[] = {__VA_ARGS__};                      \
        return rig_tests_run((name), list, sizeof list / sizeof *list); \
    }

static inline int rig_tests_run(const char *name, const TTest *const *tests, size_t count)
{
    static const struct {
        const char *name;
        SFun use;
    } kinds[] = {{"sequential", rig_use_sequential}, {"fast", rig_use_fast}, {"accurate", rig_use_accurate}};
    Suite *suite = suite_create(name);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        TCase *group = tcase_create(kinds[k].name);
        tcase_set_timeout(group, TEST_TIMEOUT);
        tcase_add_checked_fixture(group, kinds[k].use, NULL);
        for (size_t i = 0; i < count; i++)
            tcase_add_test(group, tests[i]);
        suite_add_tcase(suite, group);
    }
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}

typedef struct rig {
    context ctx;
    body_table bodies;
    shape_store shapes;
    joint_table joints;
    pair_table pairs;
    broad_table boxes;
    contact_memory_table memory;
    contact_array contacts;
    index_array patch_pairs;
    collision_scratch *scratch;
    solver *solve;
    solver_settings settings;
    collision_settings collision;
    pair_policies policies;
    solver_report report;
    ARRAY(wrench) loads; /* besides gravity, kept from step to step */
    vec3 gravity;
    double dt;
    void (*cap)(struct rig *); /* sets limits of contacts before the solve; NULL: none */
    double crushing;           /* for cap functions */
} rig;

static inline void rig_friction(rig *r, double mu_static, double mu_kinetic)
{
    for (int i = 0; i < MATERIAL_COUNT; i++)
        for (int j = 0; j < MATERIAL_COUNT; j++)
            r->policies.of[i][j] = (pair_policy){.friction_static = mu_static, .friction_kinetic = mu_kinetic};
}

static inline rig rig_make(double dt)
{
    rig r = {.dt = dt, .gravity = {0, 0, -GRAVITY}};
    context_init(&r.ctx);
    r.settings = (solver_settings){.kind = rig_kind,
                                   .iterations = 30,
                                   .position_iterations = 30,
                                   .warm_start = true,
                                   .correction_rate = 0.8,
                                   .tolerance = 1e-12,
                                   .most_iterations = 20000};
    r.collision.margin = 0.25;
    r.scratch = collision_scratch_create(&r.ctx);
    r.solve = solver_create(&r.ctx);
    ck_assert(r.scratch && r.solve);
    return r;
}

static inline void rig_free(rig *r)
{
    context *c = &r->ctx;
    table_free(c, &r->bodies, &body_table_info);
    shape_store_free(c, &r->shapes);
    table_free(c, &r->joints, &joint_table_info);
    table_free(c, &r->pairs, &pair_table_info);
    table_free(c, &r->boxes, &broad_table_info);
    table_free(c, &r->memory, &contact_memory_table_info);
    array_free(c, &r->contacts);
    array_free(c, &r->patch_pairs);
    array_free(c, &r->loads);
    collision_scratch_free(c, r->scratch);
    solver_free(c, r->solve);
}

/* A prism body about its own origin; the inertia is that of a box of the outline's bounds and exact for rectangles. */
static inline int32_t rig_prism(rig *r, motion kind, polygon outline, double height, double density, vec3 position)
{
    fram_error e = {0};
    int32_t slot = body_create(&r->ctx, &r->bodies, kind, MATERIAL_ICE), row;
    assert_ok(shape_add_prism(&r->ctx, &r->shapes, NULL, outline, height / 2, 0, &row, &e), e);
    box2 b = polygon_bounds(outline);
    double lx = b.hi.x - b.lo.x, ly = b.hi.y - b.lo.y, m = density * polygon_area(outline) * height;
    r->bodies.shape[slot] = row;
    r->bodies.position[slot] = position;
    r->bodies.mass[slot] = m;
    r->bodies.inertia[slot] = (sym3){.xx = m / 12 * (ly * ly + height * height),
                                     .yy = m / 12 * (lx * lx + height * height),
                                     .zz = m / 12 * (lx * lx + ly * ly)};
    ck_assert(array_resize(&r->ctx, &r->loads, r->bodies.count));
    r->loads.data[slot] = (wrench){{0, 0, 0}, {0, 0, 0}};
    return slot;
}

static inline int32_t rig_box(rig *r, motion kind, vec3 size, double density, vec3 position)
{
    double x = size.x / 2, y = size.y / 2;
    vec2 corner[4] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    return rig_prism(r, kind, (polygon){corner, 4}, size.z, density, position);
}

/* A body without shape. */
static inline int32_t rig_point(rig *r, motion kind, double mass, sym3 inertia, vec3 position)
{
    int32_t slot = body_create(&r->ctx, &r->bodies, kind, MATERIAL_HULL);
    r->bodies.position[slot] = position;
    r->bodies.mass[slot] = mass;
    r->bodies.inertia[slot] = inertia;
    ck_assert(array_resize(&r->ctx, &r->loads, r->bodies.count));
    r->loads.data[slot] = (wrench){{0, 0, 0}, {0, 0, 0}};
    return slot;
}

static inline void rig_detect(rig *r)
{
    fram_error e = {0};
    assert_ok(broad_phase_update(&r->ctx, &r->bodies, &r->shapes, &r->collision, &r->boxes, &r->pairs, r->scratch, &e),
              e);
    assert_ok(narrow_phase_run(&r->ctx, &r->bodies, &r->shapes, &r->policies, &r->boxes, &r->pairs, &r->contacts,
                               &r->patch_pairs, r->scratch, &e),
              e);
}

static inline void rig_solve(rig *r)
{
    fram_error e = {0};
    wrench *loads = memory_array(&r->ctx, (size_t)r->bodies.count + 1, sizeof *loads);
    ck_assert(loads);
    for (int32_t i = 0; i < r->bodies.count; i++) {
        loads[i] = r->loads.data[i];
        loads[i].force = vec3_mad(loads[i].force, r->gravity, r->bodies.mass[i]);
    }
    assert_ok(solver_solve(&r->ctx, r->solve, &r->settings, r->dt, &r->bodies, loads, &r->joints, &r->contacts,
                           &r->memory, &r->report, &e),
              e);
    memory_free(&r->ctx, loads);
}

static inline void rig_correct(rig *r)
{
    fram_error e = {0};
    assert_ok(
        solver_correct_positions(&r->ctx, r->solve, &r->settings, r->dt, &r->bodies, &r->joints, &r->contacts, &e), e);
}

static inline void rig_step(rig *r)
{
    rig_detect(r);
    if (r->cap)
        r->cap(r);
    rig_solve(r);
    integrate_poses(&r->ctx, &r->bodies, r->dt);
    rig_correct(r);
}

static inline void rig_run(rig *r, int steps)
{
    for (int i = 0; i < steps; i++)
        rig_step(r);
}

/* Depth of the deepest contact [m]. */
static inline double rig_deepest(const rig *r)
{
    double depth = -HUGE_VAL;
    for (int32_t i = 0; i < r->contacts.count; i++)
        depth = testing_larger(depth, r->contacts.data[i].depth);
    return depth;
}

#endif

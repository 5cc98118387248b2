/* The vessel as a body: frames, carriage, modes; towed through still water with the real solver. */
#include "dynamics/solver.h"
#include "fluid/fluid.h"
#include "samples.h"

typedef struct scene {
    body_table bodies;
    solid_array solids;
    shape_store shapes;
    joint_table joints;
    vessel_table vessels;
} scene;

static void scene_free(context *ctx, scene *s)
{
    table_free(ctx, &s->bodies, &body_table_info);
    table_free(ctx, &s->joints, &joint_table_info);
    table_free(ctx, &s->vessels, &vessel_table_info);
    shape_store_free(ctx, &s->shapes);
    solid_array_free(ctx, &s->solids);
}

/* Box 40 x 12 x 7 with its centre of mass at `centre`; false: no memory. */
static bool add_box_solid(context *ctx, scene *s, vec3 centre, int32_t *solid_row)
{
    mesh surface = {0};
    polyhedron_array pieces = {0};
    vec3 lo = vec3_sub(vec3_make(-20, -6, -4), centre), hi = vec3_sub(vec3_make(20, 6, 3), centre);
    s->shapes.solids = &s->solids;
    fram_status status = mesh_make_box(ctx, lo, hi, &surface) ? FRAM_OK : FRAM_ERROR_MEMORY;
    if (status == FRAM_OK)
        status = solid_add(ctx, &s->solids, &surface, &pieces, 0, solid_row, NULL);
    mesh_free(ctx, &surface);
    polyhedron_array_free(ctx, &pieces);
    return status == FRAM_OK;
}

/* A box that floats at its draught. */
static vessel_definition box_definition(vessel_mode mode)
{
    return (vessel_definition){.solid = 0,
                               .centre = {-0.5, 0, -1},
                               .mass = 1025.0 * 40 * 12 * 4,
                               .gyration = {4, 10, 11},
                               .particulars = box_particulars,
                               .mode = mode,
                               .position = {100, 50, 0},
                               .heading = 0.5 * PI,
                               .tow_velocity = {0.25, 1.5, 0},
                               .tow_ramp = 2};
}

static int32_t add_vessel(context *ctx, scene *s, const vessel_definition *d)
{
    int32_t solid_row, row = -1;
    ck_assert(add_box_solid(ctx, s, d->centre, &solid_row));
    fram_error error = {0};
    assert_ok(vessel_create(ctx, d, &s->bodies, &s->shapes, &s->joints, &s->vessels, &row, &error), error);
    return row;
}

START_TEST(frames)
{
    context ctx;
    context_init(&ctx);
    scene s = {0};
    vessel_definition d = box_definition(VESSEL_FREE);
    int32_t row = add_vessel(&ctx, &s, &d), body = s.vessels.body[row];
    ck_assert_int_eq(s.bodies.motion[body], MOTION_DYNAMIC);
    ck_assert_int_eq(s.bodies.material[body], MATERIAL_HULL);
    ck_assert_int_eq(s.bodies.owner[body], row);
    ck_assert_int_eq(s.vessels.carriage[row], -1);
    ck_assert_int_eq(s.vessels.joint[row], -1);
    /* The bow points along Y, so that forward is Y and port is -X. */
    assert_vec3_close(s.bodies.position[body], vec3_make(100, 49.5, -1), 1e-13);
    assert_vec3_close(vessel_ship_coordinates(&s.vessels, &s.bodies, row, vec3_make(97, 70, 2)), vec3_make(20, 3, 2),
                      1e-13);
    ck_assert_int_eq(hull_zone_at(&s.vessels.zones[row], vec3_make(20, 3, 2)), ZONE_BOW);
    assert_vec3_close(s.bodies.velocity[body], d.tow_velocity, 0);
    assert_relative(s.bodies.inertia[body].yy, d.mass * 100, 1e-15);
    assert_bits(s.bodies.inertia[body].xz, 0);
    vessel_drive(&s.vessels, &s.bodies, 1);
    assert_vec3_close(s.bodies.velocity[body], d.tow_velocity, 0);
    scene_free(&ctx, &s);
}
END_TEST

/* Driven hull and carriage follow the ramp, and end each step where the sum of their velocities says. */
START_TEST(driven_along_the_ramp)
{
    context ctx;
    context_init(&ctx);
    for (int mode = VESSEL_PRESCRIBED; mode <= VESSEL_TOWED; mode++) {
        scene s = {0};
        vessel_definition d = box_definition((vessel_mode)mode);
        int32_t row = add_vessel(&ctx, &s, &d);
        int32_t body = mode == VESSEL_TOWED ? s.vessels.carriage[row] : s.vessels.body[row];
        ck_assert_int_eq(s.bodies.motion[body], MOTION_PRESCRIBED);
        assert_vec3_close(s.bodies.velocity[body], vec3_make(0, 0, 0), 0);
        vec3 at = s.bodies.position[body];
        double dt = 0.125;
        for (int n = 1; n <= 32; n++) {
            vessel_drive(&s.vessels, &s.bodies, n * dt);
            double share = n < 16 ? n / 16.0 : 1;
            assert_vec3_close(s.bodies.velocity[body], vec3_scale(d.tow_velocity, share), 0);
            integrate_poses(&ctx, &s.bodies, dt);
            at = vec3_mad(at, s.bodies.velocity[body], dt);
            assert_vec3_close(s.bodies.position[body], at, 0);
        }
        /* Sum over the ramp: dt (1 + ... + 15)/16, then at full speed: exact in binary. */
        assert_vec3_close(at, vec3_add(vec3_make(100, 49.5, -1), vec3_scale(d.tow_velocity, dt * (120 / 16.0 + 17))),
                          1e-12);
        scene_free(&ctx, &s);
    }
}
END_TEST

/* Without a ramp a towed hull moves with its carriage from the start. */
START_TEST(no_ramp)
{
    context ctx;
    context_init(&ctx);
    scene s = {0};
    vessel_definition d = box_definition(VESSEL_TOWED);
    d.tow_ramp = 0;
    int32_t row = add_vessel(&ctx, &s, &d);
    assert_vec3_close(s.bodies.velocity[s.vessels.body[row]], d.tow_velocity, 0);
    assert_vec3_close(s.bodies.velocity[s.vessels.carriage[row]], d.tow_velocity, 0);
    scene_free(&ctx, &s);
}
END_TEST

static void step(context *ctx, scene *s, solver *solve, const media *m, double time, double dt)
{
    static const solver_settings settings = {.kind = SOLVER_FAST, .iterations = 20, .warm_start = true};
    static const drag_coefficients drag[MATERIAL_COUNT] = {[MATERIAL_HULL] = {.water_form = 1, .water_skin = 0.004}};
    wrench loads[2];
    contact_array contacts = {0};
    contact_memory_table memory = {0};
    solver_report report;
    fram_error error = {0};
    assert_ok(fluid_apply(ctx, m, drag, &s->bodies, &s->shapes, NULL, loads, NULL, &error), error);
    vessel_drive(&s->vessels, &s->bodies, time);
    assert_ok(
        solver_solve(ctx, solve, &settings, dt, &s->bodies, loads, &s->joints, &contacts, &memory, &report, &error),
        error);
    table_free(ctx, &memory, &contact_memory_table_info);
    integrate_poses(ctx, &s->bodies, dt);
}

/* Free in heave only: period 2 pi sqrt(T/g) of a box with draught T, and the joint carries the drag of the tow. */
START_TEST(towed_box_heaves)
{
    context ctx;
    context_init(&ctx);
    const media still = {.gravity = 9.81, .water_density = 1025};
    double dt = 0.01, period = 2 * PI * sqrt(4 / 9.81);
    scene s = {0};
    vessel_definition d = box_definition(VESSEL_TOWED);
    d.heading = 0;
    d.tow_velocity = vec3_make(2, 0, 0);
    d.tow_ramp = 0;
    d.position.z = 0.05;
    int32_t row = add_vessel(&ctx, &s, &d), body = s.vessels.body[row], carriage = s.vessels.carriage[row];
    solver *solve = solver_create(&ctx);
    double before = 0.05, first = 0, last = 0;
    int crossings = 0;
    for (int n = 1; n <= 2000; n++) {
        step(&ctx, &s, solve, &still, n * dt, dt);
        double heave = s.bodies.position[body].z + 1;
        if (before < 0 && heave >= 0) {
            last = dt * (n - heave / (heave - before));
            if (crossings++ == 0)
                first = last;
        }
        before = heave;
    }
    ck_assert_int_ge(crossings, 4);
    /* Square law drag of the bottom damps a little: the period shifts less. */
    assert_relative((last - first) / (crossings - 1), period, 2e-3);
    assert_absolute(s.bodies.position[body].x, s.bodies.position[carriage].x, 1e-6);
    assert_absolute(s.bodies.position[body].x, 100 - 0.5 + 2 * 20, 1e-6);
    assert_absolute(s.bodies.position[body].y, 50, 1e-9);
    quat q = s.bodies.orientation[body];
    assert_absolute(q.w, 1, 1e-9);
    /* Form drag on the bow, skin drag on bottom and two sides: draught within the last heave. */
    double immersed = 4 - before, form = 0.5 * 1025 * 1 * 12 * immersed * 4;
    double skin = 0.5 * 1025 * 0.004 * (40 * 12 + 2 * 40 * immersed) * 4;
    assert_relative(s.joints.reaction_force[s.vessels.joint[row]].x, form + skin, 1e-3);
    solver_free(&ctx, solve);
    scene_free(&ctx, &s);
}
END_TEST

START_TEST(wrong_definitions)
{
    context ctx;
    context_init(&ctx);
    scene s = {0};
    int32_t solid_row, row;
    ck_assert(add_box_solid(&ctx, &s, vec3_make(0, 0, 0), &solid_row));
    for (int i = 0; i < 10; i++) {
        static const char *const keys[10] = {"solid",   "mass",         "gyration", "centre", "position",
                                             "heading", "tow_velocity", "tow_ramp", "mode",   "draught"};
        vessel_definition d = box_definition(VESSEL_TOWED);
        switch (i) {
        case 0:
            d.solid = 1;
            break;
        case 1:
            d.mass = 0;
            break;
        case 2:
            d.gyration.y = 0;
            break;
        case 3:
            d.centre.z = HUGE_VAL;
            break;
        case 4:
            d.position.x = -HUGE_VAL;
            break;
        case 5:
            d.heading = HUGE_VAL;
            break;
        case 6:
            d.tow_velocity.y = HUGE_VAL;
            break;
        case 7:
            d.tow_ramp = -1;
            break;
        case 8:
            d.mode = (vessel_mode)7;
            break;
        default:
            d.particulars.draught = -4;
            break;
        }
        fram_error error = {0};
        assert_fails(vessel_create(&ctx, &d, &s.bodies, &s.shapes, &s.joints, &s.vessels, &row, &error), error,
                     FRAM_ERROR_INPUT, "expected ");
        ck_assert_str_eq(error.key, keys[i]);
        ck_assert_int_eq(s.vessels.count + s.bodies.count + s.shapes.shapes.count, 0);
    }
    scene_free(&ctx, &s);
}
END_TEST

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        scene s = {0};
        int32_t solid_row, row = -1;
        vessel_definition d = box_definition(VESSEL_TOWED);
        turn.status = FRAM_ERROR_MEMORY;
        if (add_box_solid(&turn.ctx, &s, d.centre, &solid_row)) {
            turn.status = vessel_create(&turn.ctx, &d, &s.bodies, &s.shapes, &s.joints, &s.vessels, &row, &turn.error);
            if (turn.status != FRAM_OK) {
                ck_assert_int_eq(s.vessels.count, 0);
                for (int32_t i = 0; i < s.bodies.count; i++)
                    ck_assert(!body_is_alive(&s.bodies, i));
                for (int32_t i = 0; i < s.shapes.shapes.count; i++)
                    ck_assert_int_eq(s.shapes.shapes.kind[i], SHAPE_NONE);
            }
        }
        scene_free(&turn.ctx, &s);
    }
}
END_TEST

TEST_MAIN("vessel", frames, driven_along_the_ramp, no_ramp, towed_box_heaves, wrong_definitions, memory_runs_out)

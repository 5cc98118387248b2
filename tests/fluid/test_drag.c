/* Form and skin drag: closed forms (docs/oracles.md, section 5), mesh against prism, and what must hold for any motion.
 */
#include "geometry/outlines.h"
#include "samples.h"

static const drag_coefficients form_only = {.water_form = 1}, skin_only = {.water_skin = 0.01};
static const drag_coefficients all_kinds = {.water_form = 1, .water_skin = 0.01, .air_form = 0.8, .air_skin = 0.003};

static polygon regular_polygon(vec2 *vertex, int32_t n, double radius)
{
    for (int32_t i = 0; i < n; i++)
        vertex[i] = vec2_make(radius * real_cos(2 * PI * i / n), radius * real_sin(2 * PI * i / n));
    return (polygon){vertex, n};
}

/* Yaw moment of the wet cap alone: immersion so small that the sides count for nothing. */
static double cap_moment(polygon outline, double spin)
{
    fluid_motion state = motion_at(vec3_make(0, 0, 0.5 - 1e-12), 0, 0, 0);
    state.angular_velocity.z = spin;
    fluid_load load;
    fluid_load_prism(&still_water, &skin_only, outline, 0.5, &state, &load);
    return load.water_drag.moment.z;
}

/* Torque (pi/5) rho Cf w^2 R^5; a regular n-gon in the circle has (1 - 5/3 (pi/n)^2) of it. */
START_TEST(disc_spins_in_its_plane)
{
    vec2 vertex[256];
    double radius = 5, spin = 0.3, expected = -PI / 5 * 1025 * 0.01 * spin * spin * 3125;
    for (int32_t n = 16; n <= 256; n *= 4) {
        double chord = PI / n;
        double moment = cap_moment(regular_polygon(vertex, n, radius), spin);
        assert_relative(moment, expected * (1 - 5.0 / 3 * chord * chord), 2e-5 + 3 * chord * chord * chord * chord);
    }
    assert_relative(cap_moment(regular_polygon(vertex, 64, radius), -spin), -expected, 5e-3);
}
END_TEST

/* int |r|^3 over a square of side 2 b: (8/5) b^5 int_0^(pi/4) sec^5 = 2.5087389 b^5. */
START_TEST(square_cap_spins_in_its_plane)
{
    double root = sqrt(2), sec5 = root / 2 + 3.0 / 8 * (root + real_log(1 + root));
    double expected = -0.5 * 1025 * 0.01 * 0.09 * (8.0 / 5 * 3125 * sec5);
    assert_relative(cap_moment(OUTLINE(square_outline), 0.3), expected, 1e-3);
}
END_TEST

/* Square prism of side 2 b, draught d, spinning: 1/2 rho Cd d w^2 b^4, exactly. */
START_TEST(square_prism_spins)
{
    context ctx;
    context_init(&ctx);
    mesh surface = prism_mesh(&ctx, OUTLINE(square_outline), 0.5);
    fluid_motion state = motion_at(vec3_make(0, 0, -0.2), 0, 0, 0.3);
    state.angular_velocity.z = 0.3;
    double expected = -0.5 * 1025 * 0.7 * 0.09 * 625;
    fluid_load load;
    fluid_load_prism(&still_water, &form_only, OUTLINE(square_outline), 0.5, &state, &load);
    assert_relative(load.water_drag.moment.z, expected, 1e-13);
    assert_vec3_close(load.water_drag.force, vec3_make(0, 0, 0), 1e-9);
    fluid_load_mesh(&still_water, &form_only, &surface, &state, &load);
    assert_relative(load.water_drag.moment.z, expected, 1e-13);
    mesh_free(&ctx, &surface);
}
END_TEST

static fluid_motion random_motion(random_stream *r, double spin)
{
    fluid_motion state = motion_at(random_vector(r, 1.5), 0, 0, 0);
    state.rotation = random_rotation(r);
    state.velocity = random_vector(r, 1);
    state.angular_velocity = random_vector(r, spin);
    return state;
}

static void assert_same_load(const wrench *a, const wrench *b, double force, double reach)
{
    assert_vec3_close(a->force, b->force, force);
    assert_vec3_close(a->moment, b->moment, force * reach);
}

/* Form drag of any motion, and skin drag of one without rotation, do not depend on how a face is cut. */
START_TEST(prism_equals_mesh)
{
    context ctx;
    context_init(&ctx);
    const polygon outlines[] = {OUTLINE(square_outline), OUTLINE(arrow_outline), OUTLINE(comb_outline)};
    media moving = still_water;
    moving.current = vec3_make(0.3, -0.2, 0);
    moving.wind = vec3_make(-5, 8, 0);
    random_stream r = random_begin(2, 0, 0);
    for (size_t k = 0; k < sizeof outlines / sizeof *outlines; k++) {
        mesh surface = prism_mesh(&ctx, outlines[k], 0.6);
        for (int i = 0; i < 300; i++) {
            drag_coefficients c = all_kinds;
            fluid_motion state = random_motion(&r, i % 2 ? 0.5 : 0);
            if (i % 2)
                c.water_skin = c.air_skin = 0;
            if (i % 3 == 0)
                state.rotation = quat_matrix(quat_from_roll_pitch_yaw(0.02 + (i % 2 ? PI : 0), 0.03, 1));
            fluid_load by_prism, by_mesh = {0};
            fluid_load_prism(&moving, &c, outlines[k], 0.6, &state, &by_prism);
            fluid_load_mesh(&moving, &c, &surface, &state, &by_mesh);
            assert_same_load(&by_prism.water_drag, &by_mesh.water_drag, 1e-7, 10);
            assert_same_load(&by_prism.wind_drag, &by_mesh.wind_drag, 1e-7, 10);
        }
        mesh_free(&ctx, &surface);
    }
}
END_TEST

/* Skin drag while turning is a quadrature: the prism's and the mesh's both near that of a mesh 64 times as fine, in
   terms of the drag of the whole face at the largest speed. */
START_TEST(skin_quadrature)
{
    context ctx;
    context_init(&ctx);
    const polygon outlines[] = {OUTLINE(square_outline), OUTLINE(hexagon_outline), OUTLINE(arrow_outline)};
    random_stream r = random_begin(3, 0, 0);
    for (size_t k = 0; k < sizeof outlines / sizeof *outlines; k++) {
        mesh surface = prism_mesh(&ctx, outlines[k], 0.6), fine = refined_mesh(&ctx, &surface);
        for (int level = 0; level < 2; level++) {
            mesh finer = refined_mesh(&ctx, &fine);
            mesh_free(&ctx, &fine);
            fine = finer;
        }
        double worst = 0, worst_mesh = 0;
        for (int i = 0; i < 200; i++) {
            fluid_motion state = random_motion(&r, 0.5);
            fluid_load by_prism, by_mesh = {0}, reference = {0};
            fluid_load_prism(&still_water, &skin_only, outlines[k], 0.6, &state, &by_prism);
            fluid_load_mesh(&still_water, &skin_only, &surface, &state, &by_mesh);
            fluid_load_mesh(&still_water, &skin_only, &fine, &state, &reference);
            double reach = 0.5 * polygon_diameter(outlines[k]);
            double speed = vec3_length(state.velocity) + reach * vec3_length(state.angular_velocity);
            double size = 0.5 * 1025 * 0.01 * polygon_area(outlines[k]) * speed * speed * reach;
            worst = testing_larger(
                worst, vec3_length(vec3_sub(by_prism.water_drag.moment, reference.water_drag.moment)) / size);
            worst_mesh = testing_larger(
                worst_mesh, vec3_length(vec3_sub(by_mesh.water_drag.moment, reference.water_drag.moment)) / size);
        }
        double bound = k < 2 ? 0.003 : 0.015; /* signed fans of a concave face err more */
        ck_assert_msg(worst < bound && worst_mesh < 0.015, "outline %d: prism %g, mesh %g", (int)k, worst, worst_mesh);
        mesh_free(&ctx, &surface);
        mesh_free(&ctx, &fine);
    }
}
END_TEST

/* Drag takes energy out of every motion in media at rest, upright, tilted, capsized, afloat or not. */
START_TEST(drag_dissipates)
{
    random_stream r = random_begin(4, 0, 0);
    for (int i = 0; i < 2000; i++) {
        fluid_motion state = random_motion(&r, 1);
        fluid_load load;
        fluid_load_prism(&still_water, &all_kinds, OUTLINE(comb_outline), 0.7, &state, &load);
        double water =
            vec3_dot(load.water_drag.force, state.velocity) + vec3_dot(load.water_drag.moment, state.angular_velocity);
        double air =
            vec3_dot(load.wind_drag.force, state.velocity) + vec3_dot(load.wind_drag.moment, state.angular_velocity);
        ck_assert_msg(water <= 0 && air <= 0, "power %g W in water, %g W in air", water, air);
    }
}
END_TEST

/* Only the motion relative to the medium counts. */
START_TEST(moving_frame)
{
    fluid_motion state = motion_at(vec3_make(0, 0, 0.1), 0.3, -0.2, 1);
    state.velocity = vec3_make(0.5, -0.25, 0.125);
    state.angular_velocity = vec3_make(0.1, 0.2, 0.3);
    media moving = still_water;
    moving.current = moving.wind = vec3_make(1, 2, 0);
    fluid_load rest, drift;
    fluid_load_prism(&still_water, &all_kinds, OUTLINE(arrow_outline), 0.5, &state, &rest);
    state.velocity = vec3_add(state.velocity, moving.current);
    fluid_load_prism(&moving, &all_kinds, OUTLINE(arrow_outline), 0.5, &state, &drift);
    assert_array_bits(&drift.water_drag.force.x, &rest.water_drag.force.x, 6);
    assert_array_bits(&drift.wind_drag.force.x, &rest.wind_drag.force.x, 6);
}
END_TEST

/* Surge of a 10 x 10 x 1 floe from rest in a current of 0.3 m/s, symplectic Euler; the error of u(60 s) against
   u_rel = U/(1 + U t/L) with bottom and two sides along the flow, L = 17.6770 m. */
static double drift_error(double time_step)
{
    media moving = still_water;
    moving.current.x = 0.3;
    double draught = 920.0 / 1025;
    fluid_motion state = motion_at(vec3_make(0, 0, 0.5 - draught), 0, 0, 0);
    drag_coefficients c = {.water_form = 1, .water_skin = 0.01};
    int steps = (int)(60 / time_step + 0.5);
    for (int i = 0; i < steps; i++) {
        fluid_load load;
        fluid_load_prism(&moving, &c, OUTLINE(square_outline), 0.5, &state, &load);
        state.velocity.x += time_step * load.water_drag.force.x / 92000;
    }
    double area = 0.5 * 10 * draught + 0.5 * 0.01 * (100 + 2 * 10 * draught), length = 92000 / (1025 * area);
    assert_absolute(length, 17.6770, 1e-4);
    return state.velocity.x - (0.3 - 0.3 / (1 + 0.3 * 60 / length));
}

START_TEST(drift_from_rest)
{
    double coarse = drift_error(0.2), fine = drift_error(0.1);
    assert_absolute(fine, 0, 1e-4);
    /* First order: half the step, half the error. */
    assert_absolute(coarse / fine, 2, 0.02);
    assert_absolute(0.3 - 0.3 / (1 + 0.3 * 60 / 17.6770), 0.15136, 1e-5);
}
END_TEST

/* The oracle's other row, L = 17.9951 m and u(60 s) = 0.15002: the same floe when its two sides along the flow do not
   rub.  A floe of Fram always has them; a mesh of the other wet faces gives the row. */
START_TEST(drift_without_sides_along_the_flow)
{
    context ctx;
    context_init(&ctx);
    double draught = 920.0 / 1025;
    mesh faces = {0};
    for (int i = 0; i < 8; i++)
        ck_assert(mesh_add_vertex(&ctx, &faces, vec3_make(i & 1 ? 5 : -5, i & 2 ? 5 : -5, i & 4 ? draught : 0)));
    /* The bottom, and the faces across the flow. */
    static const int face[6][3] = {{0, 2, 1}, {1, 2, 3}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (int i = 0; i < 6; i++)
        ck_assert(mesh_add_triangle(&ctx, &faces, face[i][0], face[i][1], face[i][2]));
    media moving = still_water;
    moving.current.x = 0.3;
    fluid_motion state = motion_at(vec3_make(0, 0, -draught), 0, 0, 0);
    const drag_coefficients c = {.water_form = 1, .water_skin = 0.01};
    fluid_load load = {0};
    fluid_load_mesh(&moving, &c, &faces, &state, &load);
    double length = 92000 * 0.3 * 0.3 / load.water_drag.force.x;
    assert_absolute(length, 17.9951, 1e-4);
    assert_absolute(0.3 - 0.3 / (1 + 0.3 * 60 / length), 0.15002, 1e-5);
    mesh_free(&ctx, &faces);
}
END_TEST

/* A wide thin floe between wind and still water: U_i/U_a = 0.018768 for Ca 1.5e-3 and Cw 5e-3. */
START_TEST(wind_drift_limit)
{
    static const vec2 wide[] = {{-500, -500}, {500, -500}, {500, 500}, {-500, 500}};
    media windy = still_water;
    windy.wind.x = 10;
    drag_coefficients c = {.water_skin = 1e-2, .air_skin = 3e-3};
    double low = 0, high = 1;
    for (int i = 0; i < 50; i++) {
        fluid_motion state = motion_at(vec3_make(0, 0, -4e-5), 0, 0, 0);
        state.velocity.x = 0.5 * (low + high);
        fluid_load load;
        fluid_load_prism(&windy, &c, OUTLINE(wide), 5e-5, &state, &load);
        if (load.water_drag.force.x + load.wind_drag.force.x > 0)
            low = state.velocity.x;
        else
            high = state.velocity.x;
    }
    assert_absolute(low / 10, 0.018768, 5e-7);
}
END_TEST

TEST_MAIN("drag", disc_spins_in_its_plane, square_cap_spins_in_its_plane, square_prism_spins, prism_equals_mesh,
          skin_quadrature, drag_dissipates, moving_frame, drift_from_rest, drift_without_sides_along_the_flow,
          wind_drift_limit)

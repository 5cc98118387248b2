/* Buoyancy of meshes and prisms: closed forms (docs/oracles.md, section 5), and each against the other. */
#include "geometry/outlines.h"
#include "samples.h"

static context make_context(void)
{
    context ctx;
    context_init(&ctx);
    return ctx;
}

/* Rotation that turns the cube's diagonal (1, 1, 1) upright. */
static mat3 diagonal_up(void)
{
    vec3 z = vec3_scale(vec3_make(1, 1, 1), 1 / sqrt(3)), x = vec3_scale(vec3_make(1, -1, 0), sqrt(0.5));
    vec3 y = vec3_cross(z, x);
    return (mat3){{{x.x, x.y, x.z}, {y.x, y.y, y.z}, {z.x, z.y, z.z}}};
}

START_TEST(cube_on_its_corner)
{
    context ctx = make_context();
    static const vec2 outline[] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
    static const double cases[][2] = {
        {0.2, 0.00692820323}, {0.5, 0.1082531755}, {0.86602540378443865, 0.5}, {1.6, 0.9980058684}};
    mesh cube = prism_mesh(&ctx, OUTLINE(outline), 0.5);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double immersion = cases[i][0], volume = cases[i][1];
        fluid_motion state = {{3, -2, sqrt(0.75) - immersion}, diagonal_up(), {0, 0, 0}, {0, 0, 0}};
        fluid_load by_mesh, by_prism;
        fluid_load_mesh(&still_water, &(drag_coefficients){0}, &cube, &state, &by_mesh);
        fluid_load_prism(&still_water, &(drag_coefficients){0}, OUTLINE(outline), 0.5, &state, &by_prism);
        assert_absolute(by_mesh.submerged_volume, volume, 1e-10);
        assert_absolute(by_prism.submerged_volume, volume, 1e-10);
        assert_vec3_close(by_mesh.hydrostatic.force, vec3_make(0, 0, 1025 * 9.81 * by_mesh.submerged_volume), 1e-10);
        /* The diagonal is an axis of symmetry. */
        assert_vec3_close(by_mesh.hydrostatic.moment, vec3_make(0, 0, 0), 1e-10);
        assert_vec3_close(by_prism.hydrostatic.moment, vec3_make(0, 0, 0), 1e-10);
    }
    mesh_free(&ctx, &cube);
}
END_TEST

/* Box 10 x 4 x 2 at half density: the righting lever of the righting moment. */
START_TEST(righting_lever_of_a_box)
{
    context ctx = make_context();
    static const vec2 outline[] = {{-5, -2}, {5, -2}, {5, 2}, {-5, 2}};
    static const double cases[][2] = {{5, 0.0730745278}, {15, 0.2280707852}, {26, 0.4348300074}};
    mesh box = prism_mesh(&ctx, OUTLINE(outline), 1);
    double displacement = 1025 * 9.81 * 40;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fluid_motion state = motion_at(vec3_make(0, 0, 0), radians(cases[i][0]), 0, 0);
        fluid_load by_mesh, by_prism;
        fluid_load_mesh(&still_water, &(drag_coefficients){0}, &box, &state, &by_mesh);
        fluid_load_prism(&still_water, &(drag_coefficients){0}, OUTLINE(outline), 1, &state, &by_prism);
        assert_relative(by_mesh.submerged_volume, 40, 1e-13);
        assert_absolute(-by_mesh.hydrostatic.moment.x / displacement, cases[i][1], 1e-10);
        assert_absolute(-by_prism.hydrostatic.moment.x / displacement, cases[i][1], 1e-10);
    }
    /* GM is the slope at zero. */
    fluid_motion state = motion_at(vec3_make(0, 0, 0), 1e-5, 0, 0);
    fluid_load load;
    fluid_load_prism(&still_water, &(drag_coefficients){0}, OUTLINE(outline), 1, &state, &load);
    assert_absolute(-load.hydrostatic.moment.x / displacement / 1e-5, 5.0 / 6, 1e-8);
    mesh_free(&ctx, &box);
}
END_TEST

static void compare(const mesh *surface, polygon outline, double half_height, const fluid_motion *state)
{
    fluid_load by_mesh, by_prism;
    fluid_load_mesh(&still_water, &(drag_coefficients){0}, surface, state, &by_mesh);
    fluid_load_prism(&still_water, &(drag_coefficients){0}, outline, half_height, state, &by_prism);
    /* Pressures reach the deepest corner's over every face: rounding is of that size. */
    double weight = 1025 * 9.81 * 2 * half_height * polygon_area(outline), reach = polygon_diameter(outline);
    double deep = weight * (1 + fabs(state->position.z) / half_height);
    assert_vec3_close(by_prism.hydrostatic.force, by_mesh.hydrostatic.force, 1e-14 * deep);
    assert_vec3_close(by_prism.hydrostatic.moment, by_mesh.hydrostatic.moment, 1e-14 * deep * reach);
    assert_absolute(by_prism.submerged_volume * 1025 * 9.81, by_prism.hydrostatic.force.z, 1e-14 * weight);
}

START_TEST(prism_equals_mesh)
{
    context ctx = make_context();
    const polygon outlines[] = {OUTLINE(square_outline), OUTLINE(hexagon_outline), OUTLINE(arrow_outline),
                                OUTLINE(comb_outline)};
    random_stream r = random_begin(1, 0, 0);
    for (size_t k = 0; k < sizeof outlines / sizeof *outlines; k++) {
        double half_height = 0.3 + 0.4 * (double)k;
        mesh surface = prism_mesh(&ctx, outlines[k], half_height);
        for (int i = 0; i < 400; i++) {
            /* Any attitude; then nearly level ones, upright and capsized; the last few fully wet or dry. */
            fluid_motion state = motion_at(random_vector(&r, 2), 0, 0, 0);
            if (i < 200)
                state.rotation = random_rotation(&r);
            else
                state.rotation =
                    quat_matrix(quat_from_roll_pitch_yaw(random_uniform(&r, -0.1, 0.1) + (i % 2 ? PI : 0),
                                                         random_uniform(&r, -0.1, 0.1), 6 * random_unit(&r)));
            if (i >= 380)
                state.position.z = i % 4 < 2 ? -20 : 20;
            compare(&surface, outlines[k], half_height, &state);
        }
        mesh_free(&ctx, &surface);
    }
}
END_TEST

/* Closed form and facets meet where a corner of the upper cap reaches the water: the load has no step there. */
START_TEST(closed_form_is_continuous)
{
    polygon outline = OUTLINE(arrow_outline);
    for (int capsized = 0; capsized < 2; capsized++) {
        fluid_motion state = motion_at(vec3_make(0, 0, 0), 0.07 + (capsized ? PI : 0), 0.03, 0.5);
        double lowest = HUGE_VAL;
        for (int32_t i = 0; i < outline.count; i++) {
            vec3 corner = {outline.vertex[i].x, outline.vertex[i].y, capsized ? -1 : 1};
            lowest = fmin(lowest, mat3_mul_vec(state.rotation, corner).z);
        }
        fluid_load load[2];
        for (int dry = 0; dry < 2; dry++) {
            state.position.z = (dry ? 1e-9 : -1e-9) - lowest;
            fluid_load_prism(&still_water, &(drag_coefficients){0}, outline, 1, &state, &load[dry]);
        }
        double stiffness = 1025 * 9.81 * polygon_area(outline);
        assert_absolute(load[0].hydrostatic.force.z - load[1].hydrostatic.force.z, 2e-9 * stiffness, 1e-10 * stiffness);
        assert_vec3_close(load[0].hydrostatic.moment, load[1].hydrostatic.moment, 1e-7 * stiffness);
    }
}
END_TEST

START_TEST(dry_and_submerged)
{
    polygon outline = OUTLINE(hexagon_outline);
    fluid_motion state = motion_at(vec3_make(0, 0, 3), 0.1, 0.2, 0.3);
    fluid_load load;
    fluid_load_prism(&still_water, &(drag_coefficients){0}, outline, 0.5, &state, &load);
    assert_bits(load.submerged_volume, 0);
    assert_vec3_close(load.hydrostatic.force, vec3_make(0, 0, 0), 0);
    state.position.z = -30;
    fluid_load_prism(&still_water, &(drag_coefficients){0}, outline, 0.5, &state, &load);
    assert_relative(load.submerged_volume, polygon_area(outline), 1e-14);
    polygon_moments m = polygon_moments_of(outline);
    vec3 arm = mat3_mul_vec(state.rotation, vec3_make(m.centroid.x, m.centroid.y, 0));
    assert_vec3_close(load.hydrostatic.moment, vec3_cross(arm, load.hydrostatic.force), 1e-9);
}
END_TEST

/* The wrench acts at the centroid of the submerged volume: a ship far from the origin feels the same. */
START_TEST(place_does_not_matter)
{
    context ctx = make_context();
    mesh surface = prism_mesh(&ctx, OUTLINE(arrow_outline), 0.8);
    fluid_motion state = motion_at(vec3_make(0, 0, -0.1), 0.3, -0.4, 1);
    fluid_load here, there;
    fluid_load_mesh(&still_water, &(drag_coefficients){0}, &surface, &state, &here);
    state.position.x = 1e6;
    state.position.y = -3e6;
    fluid_load_mesh(&still_water, &(drag_coefficients){0}, &surface, &state, &there);
    assert_array_bits(&there.hydrostatic.force.x, &here.hydrostatic.force.x, 3);
    assert_array_bits(&there.hydrostatic.moment.x, &here.hydrostatic.moment.x, 3);
    mesh_free(&ctx, &surface);
}
END_TEST

TEST_MAIN("hydrostatics", cube_on_its_corner, righting_lever_of_a_box, prism_equals_mesh, closed_form_is_continuous,
          dry_and_submerged, place_does_not_matter)

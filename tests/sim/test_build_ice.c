/* The ice of a world as its scenario describes it: single floes, sheets with openings, contacts of the materials. */
#include "base/transcendental.h"
#include "scene.h"
#include "sim/ice_kinds.h"

#include <stddef.h>

#define BASE "run: {duration: 1, time_step: 0.02}\n"
#define NO_VESSEL "vessel: {present: false}\n"
#define DOMAIN "domain: {boundary: open, x_min: -100, x_max: 100, y_min: -60, y_max: 60}\n"

/* Some ice covers a place of the plan. */
static bool is_ice(const scene *k, double x, double y)
{
    bool inside = false;
    for (int32_t i = 0; i < k->w.floes.count; i++) {
        int32_t body = k->w.floes.body[i];
        vec3 at = body_to_local(&k->w.bodies, body, vec3_make(x, y, k->w.bodies.position[body].z));
        inside = inside || polygon_contains(shape_outline(&k->w.shapes, k->w.bodies.shape[body]), (vec2){at.x, at.y});
    }
    return inside;
}

START_TEST(a_floe_lies_and_moves_as_given)
{
    scene k;
    scene_open(&k, BASE NO_VESSEL DOMAIN
               "ice:\n  source: floes\n  thickness: 0.8\n  floes:\n"
               "    - {x: 10, y: 5, length: 20, width: 4, yaw_deg: 30, velocity_x: 0.3, "
               "velocity_y: -0.2, spin: 0.05}\n"
               "    - {x: -50, y: 5, shape: regular, radius: 6, sides: 3, fixed: true}\n"
               "    - {x: 60, y: 5, length: 9, width: 4, yaw_deg: 30, pitch_deg: 4, roll_deg: -3}\n");
    int32_t body = scene_floe(&k, 0);
    assert_vec3_close(k.w.bodies.velocity[body], ((vec3){0.3, -0.2, 0}), 0);
    assert_vec3_close(k.w.bodies.angular_velocity[body], ((vec3){0, 0, 0.05}), 0);
    double c = real_cos(radians(30)), s = real_sin(radians(30));
    ck_assert(is_ice(&k, 10 + 9.9 * c, 5 + 9.9 * s) && is_ice(&k, 10 - 9.9 * c, 5 - 9.9 * s));
    ck_assert(!is_ice(&k, 10 + 9.9 * c, 5 - 9.9 * s) && !is_ice(&k, 10 + 10.1 * c, 5 + 10.1 * s));
    ck_assert(is_ice(&k, 10 - 1.9 * s, 5 + 1.9 * c) && !is_ice(&k, 10 - 2.1 * s, 5 + 2.1 * c));
    /* The first corner of a regular one lies on its x axis. */
    ck_assert(is_ice(&k, -50 + 5.9, 5) && !is_ice(&k, -50 - 5.9, 5) && is_ice(&k, -50 - 2.9, 5));
    ck_assert_int_eq(k.w.bodies.motion[scene_floe(&k, 1)], MOTION_STATIC);
    assert_vec3_close(quat_roll_pitch_yaw(k.w.bodies.orientation[scene_floe(&k, 2)]),
                      ((vec3){radians(-3), radians(4), radians(30)}), 1e-12);
    scene_close(&k);
}
END_TEST

START_TEST(a_sheet_has_its_openings_margin_and_held_sides)
{
    scene k;
    scene_open(&k, BASE "vessel:\n  x: -40\n  mode: towed\n"
                        "  hull: {form: box, length: 40, beam: 10, draught: 4, freeboard: 3}\n" DOMAIN
                        "ice:\n  source: level\n  thickness: 0.5\n  keep_out_margin: 3\n"
                        "  level: {anchored_x_min: true, anchored_x_max: false, anchored_y_min: false, "
                        "anchored_y_max: true, openings: [{x: 50, y: 10, length: 40, width: 6, angle_deg: 30}]}\n");
    const tile_grid *g = &k.m.fracture.tiles;
    ck_assert(g->anchored[SHEET_X_MIN] && !g->anchored[SHEET_X_MAX] && !g->anchored[SHEET_Y_MIN] &&
              g->anchored[SHEET_Y_MAX]);
    double c = real_cos(radians(30)), s = real_sin(radians(30));
    ck_assert(!is_ice(&k, 50 + 19.9 * c, 10 + 19.9 * s) && is_ice(&k, 50 + 20.1 * c, 10 + 20.1 * s));
    ck_assert(is_ice(&k, 50 + 19.9 * c, 10 - 19.9 * s));
    ck_assert(!is_ice(&k, 50 - 2.9 * s, 10 + 2.9 * c) && is_ice(&k, 50 - 3.1 * s, 10 + 3.1 * c));
    /* The hull from -60 to -20, and 3 m around it. */
    ck_assert(!is_ice(&k, -17.1, 0) && is_ice(&k, -16.9, 0));
    ck_assert(!is_ice(&k, -40, 7.9) && is_ice(&k, -40, 8.1));
    ck_assert(!is_ice(&k, -20 + 2.05, 5 + 2.05) && is_ice(&k, -20 + 2.3, 5 + 2.3));
    double open = 40 * 10 + 3 * 100 + 40 * 6, area = 0;
    for (int32_t i = 0; i < k.w.floes.count; i++)
        area += k.w.floes.area[i];
    double corners = 200 * 120 - open - area; /* arcs, or two tangents for each */
    ck_assert(corners >= 9 * PI && corners <= 9 * 8 * real_tan(PI / 8) + 1e-9);
    scene_close(&k);
}
END_TEST

START_TEST(open_water_is_turned_as_given)
{
    scene k;
    scene_open(&k, BASE NO_VESSEL DOMAIN "ice:\n  concentration: 0.9\n  mean_floe_area: 20\n"
                                         "  open_water: [{x: 10, y: 5, length: 100, width: 20, angle_deg: 25}]\n");
    double c = real_cos(radians(25)), s = real_sin(radians(25));
    int along = 0, other = 0, beside = 0;
    for (int i = -9; i <= 9; i++)
        for (int j = -3; j <= 3; j++) {
            double x = 5.4 * i, y = 3.2 * j;
            along += is_ice(&k, 10 + c * x - s * y, 5 + s * x + c * y);
            other += is_ice(&k, 10 + c * x + s * y, 5 - s * x + c * y);
        }
    /* 6 m from its long sides there is ice again. */
    for (int i = -9; i <= 9; i++)
        for (int side = -1; side <= 1; side += 2)
            beside += is_ice(&k, 10 + c * 5.4 * i - s * 16 * side, 5 + s * 5.4 * i + c * 16 * side);
    ck_assert_int_eq(along, 0);
    ck_assert_int_gt(other, 20);
    ck_assert_int_gt(beside, 19);
    scene_close(&k);
}
END_TEST

/* Each pair of materials has its own friction and its own rule of crushing. */
START_TEST(pairs_of_materials_have_their_own_policies)
{
    static const char *const under[] = {"ice.fracture.under_ice_contacts=true", "ice.breakable=true"};
    for (int n = 0; n < 3; n++) {
        scene k;
        scene_open_with(&k,
                        BASE NO_VESSEL DOMAIN
                        "ice:\n  source: none\n  cap_ice_ice: true\n  cap_ice_wall: false\n  friction:\n"
                        "    {ice_ice_static: 0.31, ice_ice_kinetic: 0.21, ice_hull_static: 0.12, "
                        "ice_hull_kinetic: 0.11, ice_wall_static: 0.43, ice_wall_kinetic: 0.41,\n"
                        "     hull_hull_static: 0.53, hull_hull_kinetic: 0.37, hull_wall_static: 0.47, "
                        "hull_wall_kinetic: 0.29}\n",
                        under, n);
        static const struct {
            material first, other;
            double at_rest, sliding;
            bool patch;
        } pairs[5] = {{MATERIAL_ICE, MATERIAL_ICE, 0.31, 0.21, true},
                      {MATERIAL_ICE, MATERIAL_HULL, 0.12, 0.11, true},
                      {MATERIAL_ICE, MATERIAL_WALL, 0.43, 0.41, false},
                      {MATERIAL_HULL, MATERIAL_HULL, 0.53, 0.37, false},
                      {MATERIAL_HULL, MATERIAL_WALL, 0.47, 0.29, false}};
        for (int i = 0; i < 5; i++) {
            const pair_policy *one = &k.m.policies.of[pairs[i].first][pairs[i].other];
            const pair_policy *two = &k.m.policies.of[pairs[i].other][pairs[i].first];
            assert_bits(one->friction_static, pairs[i].at_rest);
            assert_bits(one->friction_kinetic, pairs[i].sliding);
            assert_bits(two->friction_static, pairs[i].at_rest);
            assert_bits(two->friction_kinetic, pairs[i].sliding);
            ck_assert_int_eq(one->patch, pairs[i].patch);
        }
        /* Floes that may break do so under others by the patches of these contacts. */
        ck_assert_int_eq(k.m.policies.of[MATERIAL_ICE][MATERIAL_ICE].sides, n < 2);
        scene_close(&k);
    }
    scenario_population kinds[2] = {{.breakable = false}, {.breakable = true}};
    scenario_ice ice = {.source = ICE_PACKED, .breakable = true, .populations = {.data = kinds, .count = 1}};
    ck_assert(!ice_may_break(&ice) && !ice_all_breaks(&ice));
    ice.populations.count = 2;
    ck_assert(ice_may_break(&ice) && !ice_all_breaks(&ice));
    ice.populations.count = 1;
    ice.source = ICE_FILE; /* has floes beside its populations */
    ck_assert(ice_may_break(&ice) && !ice_all_breaks(&ice));
    ice.source = ICE_LEVEL; /* has none */
    ck_assert(ice_may_break(&ice) && ice_all_breaks(&ice));
}
END_TEST

/* With the reference's area no edge gives, at the crushing limit, below it or as it breaks. */
START_TEST(edges_are_rigid_under_a_section)
{
    for (int section = 0; section < 2; section++) {
        static const char *const area[] = {"ice.top_plane_area=true"};
        scene k;
        scene_open_with(&k, BASE NO_VESSEL DOMAIN "ice: {source: none}\n", area, section);
        ck_assert_int_eq(k.m.fracture.edges_give, !section);
        ck_assert_int_eq(k.m.crushing.edges.gives, !section);
        ck_assert_int_eq(k.m.crushing.edges.elastic, !section);
        scene_close(&k);
    }
}
END_TEST

/* Numbers and choices of the method. */
START_TEST(the_method_is_as_its_keys_say)
{
    static const char *const keys[] = {"run.collision_margin=0.37",    "run.solver.correction_rate=0.7",
                                       "run.solver.contact_skin=2e-4", "ice.small_patch=0.03",
                                       "ice.fracture.load_over=step",  "ice.fracture.radius_along=cracks",
                                       "domain.boundary=walls",        "domain.wall_thickness=1.7"};
    scene k;
    scene_open_with(&k, BASE NO_VESSEL DOMAIN "ice: {source: none}\n", keys, sizeof keys / sizeof *keys);
    assert_absolute(k.m.collision.margin, 0.37, 0);
    assert_absolute(k.m.solver.correction_rate, 0.7, 0);
    assert_absolute(k.m.solver.contact_skin, 2e-4, 0);
    assert_absolute(k.m.crushing.skin, 2e-4, 0);
    assert_absolute(k.m.crushing.small_patch, 0.03, 0);
    ck_assert_int_eq(k.m.fracture.load_rule, EDGE_LOAD_STEP);
    ck_assert_int_eq(k.m.fracture.radius_along, RADIUS_ALONG_CRACKS);
    ck_assert_int_eq(k.w.bodies.material[0], MATERIAL_WALL);
    assert_absolute(k.w.bodies.position[0].x, -100 - 0.5 * 1.7, 1e-12);
    scene_close(&k);
}
END_TEST

/* Each switch of the method by itself, so that two that changed places are found. */
START_TEST(switches_are_as_their_keys_say)
{
    static const struct {
        const char *set;
        size_t at;
        bool told;
    } flags[] = {{"run.solver.baumgarte=true", offsetof(model, solver.baumgarte), true},
                 {"ice.crush_notches=false", offsetof(model, fracture.crush_notches), false},
                 {"ice.parts_by_motion=false", offsetof(model, crushing.parts_by_motion), false},
                 {"ice.fracture.thick_plate_radius=false", offsetof(model, fracture.thick_plate_radius), false},
                 {"ice.fracture.wide_contacts=false", offsetof(model, fracture.wide_contacts), false},
                 {"ice.fracture.joint_loads=false", offsetof(model, fracture.joint_loads), false},
                 {"ice.fracture.wedge_room=true", offsetof(model, fracture.wedge_room), true}};
    enum { FLAGS = sizeof flags / sizeof *flags };
    for (int i = 0; i < FLAGS; i++) {
        scene k;
        scene_open_with(&k, BASE NO_VESSEL DOMAIN "ice: {source: none}\n", &flags[i].set, 1);
        for (int j = 0; j < FLAGS; j++)
            ck_assert_msg(*(const bool *)((const char *)&k.m + flags[j].at) == (flags[j].told == (i == j)),
                          "%s with %s", flags[j].set, flags[i].set);
        scene_close(&k);
    }
}
END_TEST

/* Floes that all lie in one place are refused; a stack of as many, one above the other, is none. */
START_TEST(a_stack_is_no_crowd)
{
    enum { FLOES = 200 };
    for (int apart = 0; apart < 2; apart++) {
        char text[32768];
        int at =
            snprintf(text, sizeof text, BASE NO_VESSEL DOMAIN "ice:\n  source: floes\n  thickness: 0.5\n  floes:\n");
        for (int i = 0; i < FLOES; i++)
            at += snprintf(text + at, sizeof text - (size_t)at, "    - {length: 10, width: 10, elevation: %g}\n",
                           apart ? 0.51 * i : 0.001 * i);
        scene k;
        fram_error error = {0};
        context_init(&k.ctx);
        assert_ok(scenario_parse(&k.ctx, "scene.yaml", text, strlen(text), NULL, &k.s, &error), error);
        fram_status status = scene_build(&k.ctx, &k.s, &k.m, &k.w, &error);
        if (apart) {
            assert_ok(status, error);
            ck_assert_int_eq(k.w.floes.count, FLOES);
            world_free(&k.ctx, &k.w);
            model_free(&k.ctx, &k.m);
        } else {
            ck_assert_int_eq(status, FRAM_ERROR_INPUT);
            ck_assert_str_eq(error.key, "ice.floes");
        }
        scenario_free(&k.ctx, &k.s);
    }
}
END_TEST

TEST_MAIN("build_ice", a_floe_lies_and_moves_as_given, a_sheet_has_its_openings_margin_and_held_sides,
          open_water_is_turned_as_given, pairs_of_materials_have_their_own_policies, edges_are_rigid_under_a_section,
          the_method_is_as_its_keys_say, switches_are_as_their_keys_say, a_stack_is_no_crowd)

/* model/world_check: the states of runs are sound, and one with a number that names nothing is refused with its place;
   as a checkpoint too, whose checksums and hash fit. */
#include "model/world_check.h"
#include "scene.h"
#include "scratch.h"
#include "sim/checkpoint.h"

#include <stdio.h>
#include <unistd.h>

static const char moored[] =
    "run: {duration: 5, time_step: 0.1}\n"
    "vessel:\n  mode: free\n  x: -10\n"
    "  hull: {form: box, length: 20, beam: 8, draught: 2, freeboard: 2}\n"
    "  mooring: {depth: 60, lines: [{count: 2, spacing_deg: 180, distance: 200, pretension: 3e5}]}\n"
    "  thrusters: [{x: 5, thrust: 1e4}, {x: -5, thrust: 1e4}]\n"
    "  positioning: {active: true, waypoints: [{time: 1, x: -10, y: 0}]}\n"
    "ice: {mean_floe_area: 64, concentration: 0.5}\n"
    "domain: {x_min: -40, x_max: 40, y_min: -20, y_max: 20}\n";

static const char towed_level[] = "run: {duration: 5, time_step: 0.1}\n"
                                  "vessel:\n  mode: towed\n  x: -31\n  speed: 1\n"
                                  "  hull: {form: box, length: 20, beam: 8, draught: 2, freeboard: 2}\n"
                                  "ice: {source: level, level: {x_min: -20, tile_size: 10}}\n"
                                  "domain: {x_min: -60, x_max: 40, y_min: -20, y_max: 20}\n";

/* The second vessel keeps no station, so that no row has the loads of lines and thrusters on it. */
static const char company[] =
    "run: {duration: 5, time_step: 0.1}\nvessels:\n"
    "  - {name: a, mode: free, x: -10, hull: {form: box, length: 20, beam: 8, draught: 2, freeboard: 2},\n"
    "     thrusters: [{x: 5, thrust: 1e4}],\n"
    "     mooring: {depth: 60, lines: [{count: 2, spacing_deg: 180, distance: 200, pretension: 3e5}]}}\n"
    "  - {name: b, mode: prescribed, x: 20, hull: {form: box, length: 10, beam: 4, draught: 2, freeboard: 2}}\n"
    "ice: {source: none}\ndomain: {x_min: -40, x_max: 40, y_min: -20, y_max: 20}\n";

/* As what is read is looked at, unless a step had failed. */
static fram_status check(const scene *k, fram_error *error)
{
    fram_status status = world_check(&k->m, &k->w, error);
    return status == FRAM_OK ? world_check_numbers(&k->m, &k->w, error) : status;
}

static void assert_sound(const scene *k)
{
    fram_error error = {0};
    assert_ok(check(k, &error), error);
}

START_TEST(states_of_runs_are_sound)
{
    static const char *const texts[] = {moored, towed_level, company};
    for (int i = 0; i < 3; i++) {
        scene k;
        scene_open(&k, texts[i]);
        assert_sound(&k);
        scene_steps(&k, 20);
        assert_sound(&k);
        scene_close(&k);
    }
}
END_TEST

/* One number of the state changed: refused with this key, and sound again with the number of before. */
static void assert_found(scene *k, void *number, size_t size, int64_t value, const char *key)
{
    fram_error error = {0};
    unsigned char kept[8];
    ck_assert_uint_le(size, sizeof kept);
    memcpy(kept, number, size);
    memcpy(number, &value, size); /* little-endian, as all that Fram runs on */
    ck_assert_int_eq(check(k, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, key);
    memcpy(number, kept, size);
    assert_sound(k);
}
#define FOUND(k, member, value, key) assert_found((k), &(k)->w.member, sizeof(k)->w.member, (value), (key))

static int64_t bits(double value)
{
    int64_t out;
    memcpy(&out, &value, sizeof out);
    return out;
}

START_TEST(what_names_nothing_is_found)
{
    scene k;
    scene_open(&k, moored);
    scene_steps(&k, 3);
    const world *w = &k.w;
    int32_t vessel = w->vessels.body[0], floe = scene_floe(&k, 0), shape = w->bodies.shape[floe];
    char key[64];
    ck_assert(w->pairs.count > 0 && w->lines.count == 2 && w->thrusters.count == 2 && w->stations.count == 1);
    snprintf(key, sizeof key, "body[%d].motion", (int)vessel);
    FOUND(&k, bodies.motion[vessel], 77, key);
    snprintf(key, sizeof key, "body[%d].material", (int)vessel);
    FOUND(&k, bodies.material[vessel], MATERIAL_COUNT, key);
    snprintf(key, sizeof key, "body[%d].shape", (int)floe);
    FOUND(&k, bodies.shape[floe], w->shapes.shapes.count, key);
    FOUND(&k, bodies.shape[floe], -2, key);
    snprintf(key, sizeof key, "body[%d].motion", (int)floe);
    FOUND(&k, bodies.motion[floe], MOTION_ASLEEP, key); /* without a row that tells of it */
    snprintf(key, sizeof key, "body[%d].owner", (int)floe);
    FOUND(&k, bodies.owner[floe], w->floes.count, key);
    FOUND(&k, bodies.owner[floe], -1, key);
    FOUND(&k, floes.body[0], w->bodies.count, "floe[0].body");
    FOUND(&k, floes.body[0], vessel, "floe[0].body");
    FOUND(&k, floes.body[0], scene_floe(&k, 1), "floe[0].body");
    FOUND(&k, floes.tile[0], 1, "floe[0].tile");
    FOUND(&k, floes.number[0], INT32_MAX, "floe[0].number");
    FOUND(&k, floes.number[0], w->clock.next_floe[0], "floe[0].number");
    FOUND(&k, vessels.body[0], -1, "vessel[0].body");
    FOUND(&k, vessels.body[0], floe, "vessel[0].body");
    FOUND(&k, bodies.shape[vessel], -1, "vessel[0].body");
    FOUND(&k, bodies.motion[vessel], MOTION_NONE, "vessel[0].body");
    FOUND(&k, vessels.joint[0], w->joints.count, "vessel[0].joint");
    FOUND(&k, vessels.mode[0], 9, "vessel[0].mode");
    FOUND(&k, pairs.a[0], -1, "pair[0].a");
    FOUND(&k, pairs.b[0], w->bodies.count, "pair[0].b");
    FOUND(&k, pairs.b[0], w->pairs.a[0], "pair[0].b");
    FOUND(&k, lines.vessel[1], 1, "line[1].vessel");
    FOUND(&k, lines.kind[0], 200, "line[0].kind");
    FOUND(&k, lines.kind[0], LINE_TABLE, "line[0].stiffness"); /* as of tables that went along the line */
    FOUND(&k, lines.points[0], LINE_POINTS + 1, "line[0].points");
    FOUND(&k, thrusters.vessel[0], -1, "thruster[0].vessel");
    FOUND(&k, thrusters.kind[1], 3, "thruster[1].kind");
    FOUND(&k, waypoints.vessel[0], 5, "waypoint[0].vessel");
    FOUND(&k, stations.control_every[0], 0, "station[0].control_every");
    FOUND(&k, stations.observer[0], 7, "station[0].observer");
    FOUND(&k, clock.step[0], -1, "clock[0].step");
    FOUND(&k, clock.step[0], INT64_MAX, "clock[0].step");
    FOUND(&k, clock.splits[0], INT64_MAX, "clock[0].splits");
    FOUND(&k, clock.next_floe[0], INT32_MAX, "clock[0].next_floe");
    snprintf(key, sizeof key, "shape[%d].kind", (int)shape);
    FOUND(&k, shapes.shapes.kind[shape], 3, key);
    snprintf(key, sizeof key, "shape[%d].outline_first", (int)shape);
    FOUND(&k, shapes.shapes.outline_first[shape], w->shapes.vertices.count, key);
    FOUND(&k, shapes.shapes.outline_first[shape], INT32_MAX, key);
    FOUND(&k, shapes.shapes.outline_count[shape], 2, key);
    FOUND(&k, shapes.shapes.outline_count[shape], INT32_MAX, key);
    FOUND(&k, shapes.shapes.piece_first[shape], -1, key);
    FOUND(&k, shapes.shapes.piece_count[shape], INT32_MAX, key);
    FOUND(&k, shapes.pieces.size[w->shapes.shapes.piece_first[shape]], PIECE_MOST_VERTICES + 1, key);
    FOUND(&k, shapes.vertices.corner[w->shapes.pieces.first[w->shapes.shapes.piece_first[shape]]], INT32_MAX, key);
    int32_t hull = w->bodies.shape[vessel];
    snprintf(key, sizeof key, "shape[%d].outline_first", (int)hull);
    FOUND(&k, shapes.shapes.solid[hull], w->shapes.solids->count, key);
    FOUND(&k, clock.count, 0, "clock");
    /* A vessel that the model does not know. */
    fram_error error = {0};
    for (int32_t other = 0; other <= 2; other += 2) {
        k.m.vessels.count = other;
        ck_assert_int_eq(world_check(&k.m, &k.w, &error), FRAM_ERROR_INPUT);
        ck_assert(strncmp(error.key, "vessel", 6) == 0);
    }
    k.m.vessels.count = 1;
    assert_sound(&k);
    scene_close(&k);
}
END_TEST

START_TEST(what_no_body_can_be_is_found)
{
    const double nan_value = (double)NAN, infinite = (double)INFINITY;
    scene k;
    scene_open(&k, moored);
    scene_steps(&k, 3);
    int32_t floe = scene_floe(&k, 0), shape = k.w.bodies.shape[floe];
    char key[64];
    FOUND(&k, clock.time[0], bits(infinite), "clock[0].time");
    snprintf(key, sizeof key, "body[%d].position", (int)floe);
    FOUND(&k, bodies.position[floe].z, bits(nan_value), key);
    snprintf(key, sizeof key, "body[%d].velocity", (int)floe);
    FOUND(&k, bodies.velocity[floe].x, bits(-infinite), key);
    snprintf(key, sizeof key, "body[%d].angular_velocity", (int)floe);
    FOUND(&k, bodies.angular_velocity[floe].y, bits(nan_value), key);
    FOUND(&k, bodies.angular_velocity[floe].x, bits(-1e100), key);
    snprintf(key, sizeof key, "body[%d].orientation", (int)floe);
    FOUND(&k, bodies.orientation[floe].w, bits(nan_value), key);
    snprintf(key, sizeof key, "body[%d]", (int)floe);
    FOUND(&k, bodies.orientation[floe].w, bits(k.w.bodies.orientation[floe].w + 1e-8), key); /* the solver asserts it */
    FOUND(&k, bodies.mass[floe], bits(0), key);
    FOUND(&k, bodies.inertia[floe].zz, bits(-3.8e-280), key);
    snprintf(key, sizeof key, "body[%d].inertia", (int)floe);
    FOUND(&k, bodies.inertia[floe].xx, bits(nan_value), key);
    FOUND(&k, bodies.inertia[floe].xy, bits(nan_value), key);
    snprintf(key, sizeof key, "body[%d].mass", (int)floe);
    FOUND(&k, bodies.mass[floe], bits(infinite), key);
    FOUND(&k, bodies.mass[floe], bits(nan_value), key);
    snprintf(key, sizeof key, "body[%d].added_mass", (int)floe);
    FOUND(&k, bodies.added_mass[floe].x, bits(nan_value), key);
    FOUND(&k, floes.material[0].density, bits(-2.4e-185), "floe[0].material");
    FOUND(&k, floes.material[0].poisson_ratio, bits(0.5), "floe[0].material");
    FOUND(&k, floes.material[0].crushing_strength, bits(-1.4e62), "floe[0].material");
    FOUND(&k, floes.material[0].crushing_exponent, bits(nan_value), "floe[0].material");
    FOUND(&k, boxes.lo[0].z, bits(1e270), "broad[0].lo");
    FOUND(&k, boxes.hi[0].x, bits(nan_value), "broad[0].hi");
    FOUND(&k, floes.thickness[0], bits(0), "floe[0].thickness");
    FOUND(&k, floes.area[0], bits(-1), "floe[0].area");
    snprintf(key, sizeof key, "shape[%d].half_height", (int)shape);
    FOUND(&k, shapes.shapes.half_height[shape], bits(infinite), key);
    snprintf(key, sizeof key, "shape[%d].area", (int)shape);
    FOUND(&k, shapes.shapes.area[shape], bits(nan_value), key);
    scene_close(&k);
}
END_TEST

/* Every column, those included that somebody adds tomorrow: a row of each table has no number in each place in turn. */
START_TEST(no_column_may_have_what_is_no_number)
{
    scene k;
    scene_open(&k, moored);
    scene_steps(&k, 3);
    world_table tables[WORLD_TABLE_COUNT];
    world_tables(&k.w, tables);
    int places = 0;
    for (int t = 0; t < WORLD_TABLE_COUNT; t++) {
        table_head *head = (table_head *)(uintptr_t)tables[t].table;
        int32_t rows = head->count;
        ck_assert(table_resize(&k.ctx, head, tables[t].info, rows > 0 ? rows : 1));
        for (int f = 0; f < tables[t].info->field_count; f++) {
            const field_info *field = &tables[t].info->fields[f];
            int32_t row = head->count - 1;
            double *value = (double *)table_field(head, field) + (int64_t)row * field->components;
            for (int i = 0; i < (field->kind == FIELD_F64 ? field->components : 0); i++, places++) {
                fram_error error = {0};
                char key[80];
                double kept = value[i];
                value[i] = (double)NAN;
                snprintf(key, sizeof key, "%s[%d].%s", tables[t].info->name, (int)row, field->name);
                ck_assert_int_eq(world_check_numbers(&k.m, &k.w, &error), FRAM_ERROR_INPUT);
                ck_assert_str_eq(error.key, key);
                value[i] = kept;
            }
        }
        ck_assert(table_resize(&k.ctx, head, tables[t].info, rows));
    }
    ck_assert_int_gt(places, 500);
    assert_sound(&k);
    scene_close(&k);
}
END_TEST

START_TEST(what_no_spring_and_no_size_can_be_is_found)
{
    scene k;
    scene_open(&k, towed_level);
    scene_steps(&k, 3);
    ck_assert_int_eq(k.w.joints.count, 1);
    FOUND(&k, joints.stiffness[0], bits(-1e12), "joint[0].stiffness");
    FOUND(&k, joints.damping[0], bits(-1), "joint[0].damping");
    FOUND(&k, joints.frame_b[0].x, bits(3.5e305), "joint[0].frame_b");
    FOUND(&k, joints.frame_a[0].w, bits(k.w.joints.frame_a[0].w + 1e-6), "joint[0].frame_a");
    FOUND(&k, joints.frame_b[0].w, bits(k.w.joints.frame_b[0].w - 1e-6), "joint[0].frame_b");
    FOUND(&k, shapes.shapes.radius[0], bits(-1), "shape[0].radius");
    FOUND(&k, shapes.shapes.plan_radius[0], bits(-1e-9), "shape[0].plan_radius");
    FOUND(&k, shapes.shapes.half_height[0], bits(1e300), "shape[0].half_height");
    FOUND(&k, vessels.length[0], bits(1e13), "vessel[0].length");
    FOUND(&k, vessels.tow_ramp[0], bits((double)INFINITY), "vessel[0].tow_ramp");
    FOUND(&k, clock.work_crushed[0], bits(-1e61), "clock[0].work_crushed");
    int32_t hull = k.w.vessels.body[0];
    char mass[40];
    snprintf(mass, sizeof mass, "body[%d].added_mass", (int)hull);
    FOUND(&k, bodies.added_mass[hull].y, bits(-1), mass);
    scene_close(&k);
    /* Infinity where it means that there is none. */
    scene_open(&k, moored);
    scene_steps(&k, 3);
    k.w.stations.offset_limit[0] = (double)INFINITY;
    k.w.lines.release_time[0] = (double)INFINITY;
    k.w.thrusters.failure_time[0] = (double)INFINITY;
    assert_sound(&k);
    FOUND(&k, stations.offset_limit[0], bits((double)NAN), "station[0].offset_limit");
    FOUND(&k, lines.release_time[0], bits(-(double)INFINITY), "line[0].release_time");
    FOUND(&k, lines.stiffness[0], bits(-1e12), "line[0].stiffness");
    FOUND(&k, thrusters.time_constant[0], bits(-1), "thruster[0].time_constant");
    scene_close(&k);
}
END_TEST

/* Bodies and rows that are there, but not for this: a carriage has no shape, a vessel beside the ice no station. */
START_TEST(what_names_another_thing_is_found)
{
    scene k;
    scene_open(&k, towed_level);
    scene_steps(&k, 20);
    int32_t carriage = k.w.vessels.carriage[0];
    ck_assert(carriage >= 0 && k.w.pairs.count > 0);
    FOUND(&k, pairs.a[0], carriage, "pair[0].a");
    FOUND(&k, pairs.b[0], carriage, "pair[0].b");
    FOUND(&k, vessels.body[0], carriage, "vessel[0].body");
    FOUND(&k, vessels.carriage[0], -1, "vessel[0].carriage");
    FOUND(&k, bodies.motion[carriage], MOTION_NONE, "vessel[0].carriage");
    ck_assert(table_resize(&k.ctx, &k.w.memory, &contact_memory_table_info, 1));
    k.w.memory.on_lower[0] = (vec3){1, 2, 3};
    FOUND(&k, memory.on_lower[0].y, bits((double)INFINITY), "contact_memory[0].on_lower");
    /* One of a pair may have broken after it was found: the next step sees to it. */
    k.w.bodies.generation[k.w.pairs.a[0]]++;
    assert_sound(&k);
    scene_close(&k);
    scene_open(&k, company);
    ck_assert(k.w.vessels.count == 2 && k.w.stations.count == 1);
    FOUND(&k, lines.vessel[0], 1, "line[0].vessel");
    FOUND(&k, thrusters.vessel[0], 1, "thruster[0].vessel");
    FOUND(&k, vessels.body[1], k.w.vessels.body[0], "vessel[1].body");
    scene_close(&k);
}
END_TEST

START_TEST(a_checkpoint_of_such_a_state_is_refused)
{
    scene k;
    char folder[SCRATCH_FOLDER];
    scratch_folder(folder);
    scene_open(&k, moored);
    scene_steps(&k, 2);
    fram_error error = {0};
    checkpoint_note note = {.scenario_hash = "of this test", .inputs = ""};
    int32_t there = k.w.pairs.b[0];
    /* The last is of a step that failed, which may have failed by its numbers. */
    static const char *const keys[] = {"", "body[0].position", "pair[0].b", ""};
    for (int bad = 0; bad < 4; bad++) {
        late_commit commit = {0};
        note.failed = bad == 3;
        k.w.bodies.position[0].x = bad % 2 ? (double)NAN : 0;
        k.w.pairs.b[0] = bad == 2 ? 1 << 20 : there;
        assert_ok(checkpoint_begin(&k.ctx, folder, &k.w, &note, NULL, 0, &commit, &error), error);
        assert_ok(checkpoint_end(&k.ctx, folder, &commit, &error), error);
        world w;
        assert_ok(world_init(&k.ctx, &k.m, &w, &error), error);
        fram_status status = checkpoint_read_newest(&k.ctx, folder, &k.m, &w, &note, &error);
        ck_assert_int_eq(status, bad ? FRAM_ERROR_INPUT : FRAM_OK);
        if (bad)
            ck_assert_str_eq(error.key, keys[bad]);
        if (bad == 3)
            ck_assert_ptr_nonnull(strstr(error.message, "a step that failed"));
        world_free(&k.ctx, &w);
    }
    checkpoint_remove_all(&k.ctx, folder);
    ck_assert_int_eq(rmdir(folder), 0);
    scene_close(&k);
}
END_TEST

TEST_MAIN("world_check", states_of_runs_are_sound, what_names_nothing_is_found, what_no_body_can_be_is_found,
          no_column_may_have_what_is_no_number, what_no_spring_and_no_size_can_be_is_found,
          what_names_another_thing_is_found, a_checkpoint_of_such_a_state_is_refused)

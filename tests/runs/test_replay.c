/* The record of a run read back: forces, births and deaths, velocities, damage. */
#include "scratch.h"
#include "sim/scene.h"

#include "base/transcendental.h"
#include "io/record_pose.h"
#include "results/peaks.h"
#include "results/replay_moment.h"
#include "results/replay_plan.h"
#include "sim/run.h"

#include <stdio.h>
#include <sys/stat.h>

enum { PATH = 512 };

static const char text[] = "run:\n  duration: 6\n  time_step: 0.02\n"
                           "vessel:\n  mode: towed\n  x: -26\n  speed: 3\n  ramp: 0.5\n"
                           "  hull:\n    length: 48\n    beam: 12\n    draught: 4\n    freeboard: 2\n"
                           "ice:\n  source: floes\n  thickness: 0.5\n  breakable: true\n  floes:\n"
                           "    - {length: 40, width: 40, x: 20.5, y: 20.5, fixed: true}\n"
                           "    - {length: 40, width: 20, x: 20.5, y: -11, velocity_y: -0.25}\n"
                           "domain:\n  x_min: -64\n  x_max: 64\n  y_min: -40\n  y_max: 44\n"
                           "output:\n  frame_interval: 0.2\n";

static void run_scene(context *ctx, const char *from, char folder[SCRATCH_FOLDER])
{
    fram_error error = {0};
    scenario s = {0};
    run_result result = {0};
    scratch_folder(folder);
    assert_ok(scenario_parse(ctx, "scene.yaml", from, strlen(from), NULL, &s, &error), error);
    run_options options = {.folder = folder};
    assert_ok(run_start(ctx, &s, &options, &result, &error), error);
    scenario_free(ctx, &s);
}

/* A run of a scene, opened to be read; its folder goes with the last reader. */
static void run_and_open(context *ctx, const char *from, char folder[SCRATCH_FOLDER], replay *r)
{
    fram_error error = {0};
    run_scene(ctx, from, folder);
    assert_ok(replay_open(ctx, folder, r, &error), error);
}

static void close_and_remove(replay *r, const char *folder)
{
    replay_close(r);
    scratch_remove_folder(folder);
}

START_TEST(a_run_is_read_back)
{
    context ctx;
    char folder[SCRATCH_FOLDER];
    context_init(&ctx);
    run_scene(&ctx, text, folder);
    replay r;
    fram_error error = {0};
    bool found = true;
    int64_t frames = 0;
    int32_t pieces = 0, touched = 0;
    double area[2] = {0};
    assert_ok(replay_open(&ctx, folder, &r, &error), error);
    ck_assert_ptr_nonnull(strstr(r.scenario, "source: floes"));
    while (true) {
        assert_ok(replay_next(&r, &found, &error), error);
        if (!found)
            break;
        ck_assert_double_le(fabs(r.frame.time - 0.2 * (double)frames), 1e-9);
        ck_assert_int_eq(r.frame.number, frames);
        double sum = 0, on_floes = 0, on_vessel = 0;
        for (int32_t i = 0; i < r.frame.poses.count; i++) {
            const replay_pose *p = &r.frame.poses.data[i];
            const replay_body *b = &r.bodies.data[p->body];
            sum += b->material == MATERIAL_ICE ? b->area : 0;
            if (b->material == MATERIAL_ICE)
                on_floes += p->contact_force;
            if (b->solid)
                ck_assert_double_le(fabs(p->velocity.y), 1e-3);
            if (b->number == 1 && frames == 0)
                ck_assert_double_le(fabs(p->velocity.y + 0.25), 0.05);
        }
        for (int32_t i = 0; i < r.frame.forces.count; i++) {
            ck_assert_int_eq(r.frame.forces.data[i].kind, RECORD_FORCE_ICE);
            ck_assert_int_ge(r.frame.forces.data[i].which, 0);
            if (r.bodies.data[r.frame.forces.data[i].which].moves)
                on_vessel += vec3_length(r.frame.forces.data[i].force);
        }
        /* Every newton on the vessel is one on a floe that moves or on one that is fixed; forces of one floe at several
         * points partly cancel. */
        ck_assert_double_le(on_vessel, 1.01 * on_floes + 1);
        touched += r.frame.forces.count;
        area[frames > 0] = sum;
        frames++;
    }
    ck_assert_int_eq(frames, 31);
    ck_assert_int_gt(touched, 5);
    ck_assert_int_gt(r.fractures.count, 0);
    for (int32_t i = 0; i < r.bodies.count; i++)
        pieces += r.bodies.data[i].parent >= 0;
    ck_assert_int_ge(pieces, 2);
    /* Breaking loses next to no area, and births and deaths are in step. */
    ck_assert_double_le(fabs(area[1] / area[0] - 1), 0.01);
    close_and_remove(&r, folder);
}
END_TEST

/* A floe of 2900 t that is pushed from rest in a step: its contact is the load on the hull, beyond a half float of kN.
 */
START_TEST(contacts_of_large_floes_are_kept_whole)
{
    static const char blow[] = "run: {duration: 0.2, time_step: 0.02}\n"
                               "vessel: {mode: prescribed, x: -26, speed: 3, hull: {form: box, length: 48, beam: 12,"
                               " draught: 4, freeboard: 2}}\n"
                               "ice: {source: floes, thickness: 2, crushing_strength: 1.0e9,"
                               " floes: [{length: 40, width: 40, x: 18.1}]}\n"
                               "domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 44}\n"
                               "output: {frame_interval: 0.02}\n";
    context ctx;
    char folder[SCRATCH_FOLDER];
    replay r;
    fram_error error = {0};
    bool found = true;
    double most = 0;
    context_init(&ctx);
    run_and_open(&ctx, blow, folder, &r);
    while (found) {
        assert_ok(replay_next(&r, &found, &error), error);
        for (int32_t i = 0; found && i < r.frame.poses.count && r.frame.forces.count == 1; i++) {
            const replay_pose *p = &r.frame.poses.data[i];
            if (r.bodies.data[p->body].material != MATERIAL_ICE)
                continue;
            double load = vec3_length(r.frame.forces.data[0].force);
            /* A sum of magnitudes, of points that friction pulls apart: of the blow itself, hardly. */
            ck_assert_double_gt(p->contact_force, 0.999 * load);
            ck_assert(load < 1e8 || p->contact_force < 1.03 * load);
            most = fmax(most, load);
        }
    }
    ck_assert_double_gt(most, 1e8);
    close_and_remove(&r, folder);
}
END_TEST

/* Tiles of level ice are told from fixed floes, and a map shows them as level ice. */
START_TEST(level_ice_is_known)
{
    static const char level[] = "run: {duration: 0.04, time_step: 0.02}\nvessel: {present: false}\n"
                                "ice: {source: level, breakable: true}\n"
                                "domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 44, boundary: open}\n";
    static const char drifting[] = "run: {duration: 0.04, time_step: 0.02}\nvessel: {present: false}\n"
                                   "ice: {source: level, breakable: true}\n"
                                   "domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 44, boundary: feeding,"
                                   " drift_speed: 0.5}\n";
    const char *const from[3] = {text, level, drifting};
    for (int k = 0; k < 3; k++) {
        context ctx;
        char folder[SCRATCH_FOLDER];
        replay r;
        replay_moment m = {0};
        replay_plan plan = {0};
        fram_error error = {0};
        bool found = false;
        int32_t tiles = 0, fixed = 0, shown[PLAN_STYLE_COUNT] = {0};
        context_init(&ctx);
        run_and_open(&ctx, from[k], folder, &r);
        assert_ok(replay_next(&r, &found, &error), error);
        assert_ok(replay_moment_now(&r, &m, &error), error);
        assert_ok(replay_plan_make(&r, &m, PLAN_COLOUR_PLAIN, 0, 1, 0, 0, &plan, &error), error);
        for (int32_t i = 0; i < r.bodies.count; i++) {
            tiles += r.bodies.data[i].level;
            fixed += r.bodies.data[i].material == MATERIAL_ICE && !r.bodies.data[i].moves && !r.bodies.data[i].level;
        }
        for (int32_t i = 0; i < plan.shapes.count; i++)
            shown[plan.shapes.data[i].style]++;
        ck_assert_int_eq(fixed, k == 0);
        ck_assert(k == 0 ? tiles == 0 : tiles > 1);
        ck_assert_int_eq(shown[PLAN_LEVEL_ICE], tiles);
        ck_assert_int_eq(shown[PLAN_FIXED_ICE], fixed);
        replay_plan_free(&ctx, &plan);
        replay_moment_free(&ctx, &m);
        close_and_remove(&r, folder);
    }
}
END_TEST

/* What a break leaves of a tile has a parent as its pieces have, but did not break off itself. */
START_TEST(pieces_have_an_age_and_tiles_none)
{
    replay_pose p = {0};
    replay_body piece = {.material = MATERIAL_ICE, .parent = 3, .birth = 2}, tile = piece, whole = piece;
    tile.level = true;
    whole.parent = -1;
    assert_absolute(plan_colour_value(PLAN_COLOUR_AGE, &piece, &p, 5), 3, 0);
    ck_assert(isnan(plan_colour_value(PLAN_COLOUR_AGE, &tile, &p, 5)));
    ck_assert(isnan(plan_colour_value(PLAN_COLOUR_AGE, &whole, &p, 5)));
}
END_TEST

/* Astern a main propeller pushes along the ship, whatever its rudder does: so it is recorded. */
START_TEST(a_propeller_astern_pushes_along_the_ship)
{
    static const char backing[] =
        "run: {duration: 0.4, time_step: 0.1}\nice: {source: none}\n"
        "domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 44, boundary: open}\n"
        "vessel:\n  mode: free\n  hull: {form: box, length: 48, beam: 12, draught: 4, freeboard: 2}\n"
        "  thrusters: [{kind: main, x: -22, thrust: 3.0e5, rudder_deg: 30, setting: -0.8, direction_deg: 25}]\n"
        "output: {frame_interval: 0.1}\n";
    context ctx;
    char folder[SCRATCH_FOLDER];
    replay r;
    replay_moment m = {0};
    fram_error error = {0};
    context_init(&ctx);
    run_and_open(&ctx, backing, folder, &r);
    assert_ok(replay_moment_at(&r, 0.4, &m, &error), error);
    ck_assert_int_eq(r.frame.forces.count, 1);
    const replay_force *f = &r.frame.forces.data[0];
    ck_assert_int_eq(f->kind, RECORD_FORCE_THRUSTER);
    ck_assert_int_eq(f->vessel, 0);
    ck_assert_double_lt(f->force.x, -100);
    assert_absolute(f->force.y / f->force.x, 0, 1e-4);
    replay_moment_free(&ctx, &m);
    close_and_remove(&r, folder);
}
END_TEST

START_TEST(a_moment_lies_between_its_frames)
{
    context ctx;
    char folder[SCRATCH_FOLDER];
    context_init(&ctx);
    run_scene(&ctx, text, folder);
    replay r;
    replay_moment m = {0};
    fram_error error = {0};
    assert_ok(replay_open(&ctx, folder, &r, &error), error);
    double before = 0;
    for (double t = 2; t < 2.6; t += 0.1) {
        assert_ok(replay_moment_at(&r, t, &m, &error), error);
        ck_assert_double_le(fabs(m.time - t), 1e-6);
        for (int32_t i = 0; i < m.poses.count; i++) {
            if (!r.bodies.data[m.poses.data[i].body].solid)
                continue;
            double x = m.poses.data[i].position.x;
            if (t > 2)
                ck_assert_double_le(fabs(x - before - 0.3), 1e-3);
            before = x;
        }
    }
    ck_assert_int_eq(replay_moment_at(&r, 99, &m, &error), FRAM_ERROR_INPUT);
    replay_moment_free(&ctx, &m);
    replay_close(&r);
    assert_ok(replay_open(&ctx, folder, &r, &error), error);
    ck_assert_int_eq(replay_moment_at(&r, -1, &m, &error), FRAM_ERROR_INPUT);
    close_and_remove(&r, folder);
}
END_TEST

/* A ship in a sheet that drifts: tiles that are gone by the next frame, those of one frame alone too, lie at any time
   where the sheet is, beside their neighbours; floes that break go on as they came, and none rests, of those too that
   broke twice between two frames. */
START_TEST(what_breaks_between_frames_goes_on)
{
    static const char drifting[] =
        "run: {duration: 4, time_step: 0.02}\n"
        "vessel: {mode: prescribed, x: -12, speed: 3, hull: {length: 40, beam: 10, draught: 4, freeboard: 2}}\n"
        "ice: {source: level, thickness: 0.4, breakable: true, level: {x_min: 10, tile_size: 10}}\n"
        "domain: {x_min: -40, x_max: 60, y_min: -30, y_max: 30, boundary: feeding, drift_speed: 1,\n"
        "         drift_direction_deg: 180}\noutput: {frame_interval: 1}\n";
    context ctx;
    char folder[SCRATCH_FOLDER];
    replay r;
    replay_moment m = {0};
    fram_error error = {0};
    int32_t gone = 0, alone = 0, floes = 0;
    context_init(&ctx);
    run_and_open(&ctx, drifting, folder, &r);
    for (int i = 0; i < 4; i++) {
        assert_ok(replay_moment_at(&r, i + 0.3, &m, &error), error);
        for (int32_t k = 0; k < m.poses.count; k++) {
            const replay_pose *from = &r.frame.poses.data[k], *p = &m.poses.data[k];
            const replay_body *b = &r.bodies.data[p->body];
            vec3 way = vec3_sub(p->position, from->position);
            bool last = r.next_row.data[p->body] < 0;
            if (b->level)
                ck_assert_msg(vec3_length(vec3_sub(way, vec3_make(-0.3, 0, 0))) < 1e-3, "tile %d moves by %g, %g m",
                              b->number, way.x, way.y);
            if (last)
                ck_assert_double_le(vec3_length(vec3_sub(way, vec3_scale(p->velocity, 0.3))), 1e-9);
            ck_assert_msg(b->solid || !b->moves || vec3_length(way) > 0, "floe %d of %d rests", b->number, b->parent);
            gone += b->level && last;
            alone += b->level && last && b->born == r.frame.number && b->parent >= 0;
            floes += !b->level && !b->solid && last && vec3_length(way) > 0.05;
        }
    }
    ck_assert_msg(gone > 5 && alone > 1 && floes > 0, "%d tiles, %d of one frame, %d floes", gone, alone, floes);
    replay_moment_free(&ctx, &m);
    close_and_remove(&r, folder);
}
END_TEST

/* Two moored vessels, whose lines each begin with number 1: a plan draws them as far as their own anchors. */
START_TEST(lines_reach_their_own_anchors)
{
    static const char moored[] =
        "run: {duration: 0.2, time_step: 0.02}\nice: {source: none}\n"
        "domain: {x_min: -400, x_max: 400, y_min: -400, y_max: 400, boundary: open}\n"
        "vessels:\n"
        "  - {name: near, mode: free, y: -150, hull: {length: 48, beam: 12, draught: 4, freeboard: 2},\n"
        "     mooring: {depth: 60, lines: [{count: 3, spacing_deg: 120, distance: 300, pretension: 2.0e5}]}}\n"
        "  - {name: far, mode: free, y: 150, hull: {length: 48, beam: 12, draught: 4, freeboard: 2},\n"
        "     mooring: {depth: 60, lines: [{count: 3, spacing_deg: 120, distance: 700, pretension: 2.0e5}]}}\n"
        "output: {frame_interval: 0.1}\n";
    context ctx;
    char folder[SCRATCH_FOLDER];
    replay r;
    replay_moment m = {0};
    replay_plan plan = {0};
    scenario s = {0};
    fram_error error = {0};
    context_init(&ctx);
    run_scene(&ctx, moored, folder);
    assert_ok(scenario_parse(&ctx, "scene.yaml", moored, strlen(moored), NULL, &s, &error), error);
    assert_ok(replay_open(&ctx, folder, &r, &error), error);
    assert_ok(replay_moment_at(&r, 0.1, &m, &error), error);
    assert_ok(replay_plan_lines(&r, &s, &plan, &error), error);
    ck_assert_int_eq(plan.lines.count, 6);
    for (int32_t i = 0; i < 6; i++) {
        const plan_line *line = &plan.lines.data[i];
        assert_absolute(vec2_length(vec2_sub(line->anchor, line->upper)), line->upper.y < 0 ? 300 : 700, 1e-3);
    }
    replay_plan_free(&ctx, &plan);
    replay_moment_free(&ctx, &m);
    replay_close(&r);
    scenario_free(&ctx, &s);
    scratch_remove_folder(folder);
}
END_TEST

/* A floe that spins at 1 rad/s through 270 degrees, where the quaternion that is stored changes its sign: between
   frames it turns the short way, at an even rate. */
START_TEST(a_turn_between_frames_is_the_short_one)
{
    static const char spinning[] =
        "run: {duration: 1.2, time_step: 0.02}\nvessel: {present: false}\n"
        "ice:\n  source: floes\n  floes:\n    - {length: 40, width: 40, yaw_deg: 250, spin: 1}\n"
        "output: {frame_interval: 0.2}\n";
    context ctx;
    char folder[SCRATCH_FOLDER];
    replay r;
    replay_moment m = {0};
    fram_error error = {0};
    context_init(&ctx);
    run_and_open(&ctx, spinning, folder, &r);
    double before = radians(250);
    for (int i = 1; i < 12; i++) {
        assert_ok(replay_moment_at(&r, 0.1 * i, &m, &error), error);
        int32_t floe = 0;
        while (r.bodies.data[m.poses.data[floe].body].material != MATERIAL_ICE)
            floe++;
        quat q = m.poses.data[floe].orientation;
        /* In 0.1 s, while the water takes some of the spin. */
        double yaw = 2 * real_atan2(q.z, q.w), turn = plane_angle(yaw - before);
        ck_assert_msg(turn > 0.07 && turn < 0.102, "%g rad at %g s", turn, 0.1 * i);
        before = yaw;
    }
    replay_moment_free(&ctx, &m);
    close_and_remove(&r, folder);
}
END_TEST

static uint64_t record_size(const char *folder)
{
    char path[PATH + 32];
    struct stat about;
    snprintf(path, sizeof path, "%s/record.fram", folder);
    ck_assert_int_eq(stat(path, &about), 0);
    return (uint64_t)about.st_size;
}

/* Runs the scene with a limit [MB], stopped at half time and resumed when asked to, and counts its frames, which must
 * be evenly spaced. */
static int64_t frames_under(context *ctx, const char *limit, bool halves, uint64_t *size)
{
    char folder[SCRATCH_FOLDER], all[1024];
    scenario s = {0};
    fram_error error = {0};
    run_result result = {0};
    replay r;
    bool found = true;
    int64_t frames = 0;
    snprintf(all, sizeof all, "%s  record_limit: %s\n", text, limit);
    scratch_folder(folder);
    assert_ok(scenario_parse(ctx, "scene.yaml", all, strlen(all), NULL, &s, &error), error);
    run_options options = {.folder = folder, .until = halves ? 3 : 0};
    assert_ok(run_start(ctx, &s, &options, &result, &error), error);
    options.until = 0;
    if (halves)
        assert_ok(run_resume(ctx, &options, &result, &error), error);
    assert_ok(replay_open(ctx, folder, &r, &error), error);
    while (true) {
        assert_ok(replay_next(&r, &found, &error), error);
        if (!found)
            break;
        ck_assert_int_eq(r.frame.step % 10, 0);
        frames++;
    }
    replay_close(&r);
    *size = record_size(folder);
    scratch_remove_folder(folder);
    scenario_free(ctx, &s);
    return frames;
}

/* 31 frames at 0.2 s, of about 650 bytes at first: every second one fits the limit, and fewer when there are more than
 * twenty pieces. */
START_TEST(frames_come_rarely_enough_for_the_limit)
{
    context ctx;
    uint64_t all = 0, few = 0, again = 0;
    context_init(&ctx);
    ck_assert_int_eq(frames_under(&ctx, "0", false, &all), 31);
    ck_assert_int_eq(frames_under(&ctx, "1", false, &few), 31);
    ck_assert_uint_eq(few, all);
    int64_t half = frames_under(&ctx, "0.016", false, &few);
    ck_assert(half > 8 && half <= 16);
    ck_assert_uint_lt(few, all);
    ck_assert_int_eq(frames_under(&ctx, "0.016", true, &again), half);
    ck_assert_uint_eq(again, few);
    int64_t quarter = frames_under(&ctx, "0.008", false, &few);
    ck_assert(quarter > 4 && quarter <= 8);
}
END_TEST

/* A frame has the pull of each line, which is most of it where there is no ice: 601 of 2.2 kB, of which one in eight
   stays. */
START_TEST(lines_count_for_the_limit)
{
    static const char moored[] =
        "run: {duration: 60, time_step: 0.1}\nice: {source: none}\n"
        "vessel:\n  mode: free\n  hull: {form: box, length: 60, beam: 20, draught: 5, freeboard: 2}\n"
        "  mooring: {depth: 80, lines: [{count: 64, spacing_deg: 5.625, distance: 400, pretension: 1.0e+5, weight: "
        "500}]}\noutput: {frame_interval: 0.1, csv_interval: 10, record_limit: 0.3}\n";
    context ctx;
    char folder[SCRATCH_FOLDER];
    context_init(&ctx);
    run_scene(&ctx, moored, folder);
    uint64_t size = record_size(folder);
    ck_assert_msg(size > 150000 && size < 300000, "%llu bytes", (unsigned long long)size);
    scratch_remove_folder(folder);
}
END_TEST

/* In one go, in two, and in two with damage between them in the first block of the record. */
typedef enum how { WHOLE, HALVES, DAMAGED, HOWS } how;

static void damage_record(const char *folder)
{
    char path[PATH + 32];
    snprintf(path, sizeof path, "%s/record.fram", folder);
    FILE *file = fopen(path, "r+b");
    ck_assert_ptr_nonnull(file);
    ck_assert_int_eq(fseek(file, 24 + 24, SEEK_SET), 0);
    ck_assert_int_eq(fputc('x', file), 'x');
    ck_assert_int_eq(fclose(file), 0);
}

/* A hull that breaks an edge and meets a floe, about a place. */
static void run_about(context *ctx, double x, double y, how made, char folder[SCRATCH_FOLDER])
{
    char told[1024];
    fram_error error = {0};
    scenario s = {0};
    run_result result = {0};
    snprintf(told, sizeof told,
             "run: {duration: 2, time_step: 0.02}\nvessel: {mode: towed, x: %.0f, y: %.0f, speed: 3, ramp: 0.5, hull: "
             "{length: 48, beam: 12, draught: 4, freeboard: 2}}\nice: {source: floes, thickness: 0.5, breakable: true, "
             "floes: [{length: 40, width: 40, x: %.1f, y: %.1f, fixed: true}, {length: 40, width: 20, x: %.1f, y: "
             "%.1f}]}\ndomain: {x_min: %.0f, x_max: %.0f, y_min: %.0f, y_max: %.0f}\noutput: {frame_interval: 0.2}\n",
             x - 26, y, x + 20.5, y + 20.5, x + 20.5, y - 11, x - 64, x + 64, y - 40, y + 44);
    scratch_folder(folder);
    assert_ok(scenario_parse(ctx, "scene.yaml", told, strlen(told), NULL, &s, &error), error);
    run_options options = {.folder = folder, .until = made == WHOLE ? 0 : 1};
    assert_ok(run_start(ctx, &s, &options, &result, &error), error);
    options.until = 0;
    if (made == DAMAGED)
        damage_record(folder);
    if (made != WHOLE)
        assert_ok(run_resume(ctx, &options, &result, &error), error);
    scenario_free(ctx, &s);
}

enum { PLACES = 64 };
static int32_t add_replayed(context *ctx, const char *folder, int32_t count, vec3 out[PLACES], vec2 *origin)
{
    fram_error error = {0};
    replay r;
    bool found = true;
    assert_ok(replay_open(ctx, folder, &r, &error), error);
    *origin = r.origin;
    while (true) {
        assert_ok(replay_next(&r, &found, &error), error);
        if (!found)
            break;
        for (int32_t i = 0; i < r.frame.forces.count && count < PLACES / 2; i++)
            out[count++] = r.frame.forces.data[i].point;
    }
    for (int32_t i = 0; i < r.fractures.count && count < PLACES * 3 / 4; i++)
        out[count++] = r.fractures.data[i].place;
    for (int32_t i = 0; i < r.frame.poses.count && count < PLACES; i++)
        out[count++] = r.frame.poses.data[i].position;
    replay_close(&r);
    return count;
}

/* Places in its record, less that: of its peaks, which are all that damage leaves, of forces, of where floes broke and
   of bodies at the end. */
static int32_t places_about(context *ctx, double x, double y, how made, vec3 out[PLACES], vec2 *origin)
{
    char folder[SCRATCH_FOLDER];
    fram_error error = {0};
    peak_list peaks;
    int32_t count = 0;
    run_about(ctx, x, y, made, folder);
    assert_ok(peak_list_read(ctx, folder, 0, &peaks, &error), error);
    ck_assert_int_gt(peaks.count, 0);
    for (int32_t i = 0; i < peaks.count && count < PLACES / 4; i++)
        out[count++] = peaks.peak[i]->floe[0].point;
    peak_list_free(ctx, &peaks);
    if (made != DAMAGED)
        count = add_replayed(ctx, folder, count, out, origin);
    scratch_remove_folder(folder);
    for (int32_t i = 0; i < count; i++)
        out[i] = vec3_make(out[i].x - x, out[i].y - y, out[i].z);
    return count;
}

/* In coordinates of a map, where floats are a decimetre apart, a run is recorded as finely as about 0. */
START_TEST(places_are_as_fine_far_from_zero)
{
    static vec3 here[PLACES], there[PLACES];
    context ctx;
    vec2 origin;
    context_init(&ctx);
    int32_t count = places_about(&ctx, 0, 0, WHOLE, here, &origin);
    ck_assert_int_gt(count, 12);
    ck_assert(origin.x == 0 && origin.y == 0);
    for (how made = WHOLE; made < HOWS; made++) {
        int32_t readable = places_about(&ctx, -1400000, 2000000, made, there, &origin);
        ck_assert(made == DAMAGED ? readable > 0 : readable == count);
        for (int32_t i = 0; i < readable; i++)
            ck_assert_double_le(vec3_length(vec3_sub(there[i], here[i])), 2e-3);
        ck_assert(made == DAMAGED || (origin.x == -1400000 && origin.y == 2000002));
    }
}
END_TEST

static fram_status write_one(context *ctx, const char *folder, uint32_t type, const void *data, size_t size)
{
    char path[PATH + 32];
    record_writer w;
    record_part part = {data, size};
    fram_error error = {0};
    replay r;
    snprintf(path, sizeof path, "%s/record.fram", folder);
    assert_ok(record_create(ctx, path, &w, &error), error);
    assert_ok(record_append(&w, type, &part, 1, &error), error);
    assert_ok(record_close(&w, &error), error);
    fram_status status = replay_open(ctx, folder, &r, &error);
    if (status == FRAM_OK)
        replay_close(&r);
    return status;
}

static void add_frame(record_writer *w, uint32_t type, uint16_t touched)
{
    const int32_t head[12] = {[10] = 1};
    unsigned char pose[RECORD_POSE_SIZE];
    fram_error error = {0};
    _Static_assert(sizeof head == FRAME_HEAD_SIZE, "step, time, force, count");
    record_pose_pack(vec3_make(0, 0, 0), quat_identity(), pose);
    record_pose_mark(pose);
    const record_part part[] = {{head, sizeof head}, {pose, sizeof pose}, {&touched, sizeof touched}};
    assert_ok(record_append(w, type, part, 3, &error), error);
}

/* Frames of before, and those that a run writes which began with them. */
START_TEST(contacts_of_an_earlier_layout_are_read)
{
    const struct {
        int32_t count, slot, generation;
        unsigned char kind[4];
        float thickness, density;
        int32_t number, parent, vertices;
        float outline[6];
    } births = {1, 0, 1, {MATERIAL_ICE, 1}, 1, 900, 0, -1, 3, {0, 0, 1, 0, 0, 1}};
    context ctx;
    char folder[SCRATCH_FOLDER], path[PATH + 32];
    record_writer w;
    const record_part part = {&births, sizeof births};
    replay r;
    fram_error error = {0};
    bool found;
    context_init(&ctx);
    scratch_folder(folder);
    snprintf(path, sizeof path, "%s/record.fram", folder);
    assert_ok(record_create(&ctx, path, &w, &error), error);
    assert_ok(record_append(&w, BLOCK_BIRTHS, &part, 1, &error), error);
    add_frame(&w, BLOCK_HALF_FRAME, 0x6800);
    add_frame(&w, BLOCK_FRAME, 0x6800);
    add_frame(&w, BLOCK_FRAME, 0xa800);
    assert_ok(record_close(&w, &error), error);
    assert_ok(replay_open(&ctx, folder, &r, &error), error);
    const double newton[] = {2048e3, 1e3 / 32, 2048e3};
    for (int i = 0; i < 3; i++) {
        assert_ok(replay_next(&r, &found, &error), error);
        ck_assert_double_eq(r.frame.poses.data[0].contact_force, newton[i]);
    }
    close_and_remove(&r, folder);
}
END_TEST

START_TEST(records_that_lie_are_refused)
{
    context ctx;
    context_init(&ctx);
    char folder[SCRATCH_FOLDER];
    scratch_folder(folder);
    const int32_t births[] = {1000000, 0, 0, 0}, slot[] = {1, -5, 1, 0, 0, 0, 0, 0, 0},
                  closed[] = {0, 1, 1, 1, 0, 0, 0, 0, 9, 0};
    const int32_t many[] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 7, 0};
    ck_assert_int_eq(write_one(&ctx, folder, BLOCK_BIRTHS, births, sizeof births), FRAM_ERROR_INPUT);
    ck_assert_int_eq(write_one(&ctx, folder, BLOCK_BIRTHS, slot, sizeof slot), FRAM_ERROR_INPUT);
    ck_assert_int_eq(write_one(&ctx, folder, BLOCK_SOLID, closed, sizeof closed), FRAM_ERROR_INPUT);
    ck_assert_int_eq(write_one(&ctx, folder, BLOCK_FRAME, many, sizeof many), FRAM_ERROR_INPUT);
    ck_assert_int_eq(write_one(&ctx, folder, BLOCK_HALF_FRAME, many, sizeof many), FRAM_ERROR_INPUT);
    ck_assert_int_eq(write_one(&ctx, folder, BLOCK_FORCES, births, sizeof births), FRAM_ERROR_INPUT);
    ck_assert_int_eq(write_one(&ctx, folder, BLOCK_FRACTURES, births, sizeof births), FRAM_ERROR_INPUT);
    ck_assert_int_eq(write_one(&ctx, folder, BLOCK_EARLIER_FRAME, many, sizeof many), FRAM_ERROR_INPUT);
    ck_assert_int_eq(write_one(&ctx, folder, BLOCK_TOUCHED_FRAME, many, sizeof many), FRAM_ERROR_INPUT);
    ck_assert_int_eq(write_one(&ctx, folder, 77, many, sizeof many), FRAM_ERROR_INPUT); /* no frame */
    scratch_remove_folder(folder);
}
END_TEST

TEST_MAIN("replay", a_run_is_read_back, contacts_of_large_floes_are_kept_whole, contacts_of_an_earlier_layout_are_read,
          level_ice_is_known, pieces_have_an_age_and_tiles_none, a_propeller_astern_pushes_along_the_ship,
          a_moment_lies_between_its_frames, what_breaks_between_frames_goes_on, a_turn_between_frames_is_the_short_one,
          lines_reach_their_own_anchors, frames_come_rarely_enough_for_the_limit, lines_count_for_the_limit,
          places_are_as_fine_far_from_zero, records_that_lie_are_refused)

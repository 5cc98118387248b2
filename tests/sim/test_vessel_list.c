/* Vessels of a list in one world: each does to the bit what it does alone, wherever it stands in the list; their
   channels go by name.  The sequential solver treats contacts one by one; for the fast one see docs/limits.md. */
#include "scene.h"

#include "model/scenario_vessel.h"
#include "sim/series.h"

#include <stdio.h>

#define METHOD "run: {time_step: 0.02, duration: 10, seed: 7, solver: {kind: sequential, position_iterations: 0}}\n"
#define REST                                                                                                  \
    "environment: {current_speed: 0.3, current_direction_deg: 180, wind_speed: 12, wind_direction_deg: 90}\n" \
    "domain: {boundary: open, x_min: -500, x_max: 3000, y_min: -500, y_max: 500}\n"                           \
    "ice:\n  source: floes\n  thickness: 0.8\n  floes:\n"                                                     \
    "    - {x: 39, y: 2, length: 16, width: 20, yaw_deg: 10}\n"                                               \
    "    - {x: 57, y: -4, length: 18, width: 16}\n"                                                           \
    "    - {x: 2039, y: 2, length: 16, width: 20, yaw_deg: 10, velocity_x: -1}\n"                             \
    "    - {x: 2010, y: 17, length: 16, width: 16, velocity_y: -0.6}\n"
#define TUG                                                                                   \
    "  - name: tug\n    mode: towed\n    speed: 1.5\n    hydrodynamics: {source: estimate}\n" \
    "    hull: {length: 60, beam: 14, draught: 5, freeboard: 3, parallel_midbody: 0.3}\n"
#define SHIP                                                                                                  \
    "  - name: ship\n    mode: free\n    x: 2000\n    hydrodynamics: {source: estimate}\n"                    \
    "    hull: {length: 60, beam: 14, draught: 5, freeboard: 3, parallel_midbody: 0.3}\n"                     \
    "    mooring: {lines: [{count: 4, spacing_deg: 90, direction_deg: 45, distance: 400, pretension: 2.0e5, " \
    "release_time: 2}]}\n"                                                                                    \
    "    thrusters: [{x: 20, thrust: 3.0e5}, {x: -20, thrust: 3.0e5, failure_time: 1}]\n"                     \
    "    positioning: {active: true, interval: 0.1, sample_interval: 0.1, feed_forward: measured, "           \
    "feed_forward_time: 1}\n    station: {offset_limit: 0.01}\n"

typedef struct row {
    series_layout layout;
    ARRAY(double) value;
} row;

static void row_open(scene *k, row *r)
{
    fram_error error = {0};
    *r = (row){0};
    assert_ok(series_columns(&k->ctx, &k->s, &r->layout, &error), error);
    ck_assert(array_resize(&k->ctx, &r->value, r->layout.columns.count));
}

static void row_close(scene *k, row *r)
{
    series_layout_free(&k->ctx, &r->layout);
    array_free(&k->ctx, &r->value);
}

static const double *channel(const row *r, const char *name)
{
    for (int32_t i = 0; i < r->layout.columns.count; i++)
        if (strcmp(r->layout.columns.data[i].name, name) == 0)
            return &r->value.data[i];
    return NULL;
}

/* Channels of one vessel in two runs: as many, and the same to the bit.  prefix: of its channels in the second. */
static void assert_same_channels(const row *a, const row *b, const char *name, const char *prefix, int step)
{
    int compared = 0;
    size_t size = strlen(name);
    for (int32_t i = 0; i < a->layout.columns.count; i++) {
        const char *full = a->layout.columns.data[i].name;
        char other[120];
        if (strncmp(full, name, size) != 0 || full[size] != '.')
            continue;
        snprintf(other, sizeof other, "%s%s", prefix, full + size + 1);
        const double *found = channel(b, other);
        ck_assert_msg(found != NULL, "no channel %s", other);
        ck_assert_msg(memcmp(found, &a->value.data[i], sizeof *found) == 0, "step %d: %s is %.17g, alone %.17g", step,
                      full, a->value.data[i], *found);
        compared++;
    }
    ck_assert_int_gt(compared, 90);
}

/* Each vessel in company, in both orders, against its own run as a list of one and as the short form. */
static void compare(const char *together, const char *alone, const char *name, const char *prefix)
{
    scene both, one;
    row a, b;
    scene_open(&both, together);
    scene_open(&one, alone);
    row_open(&both, &a);
    row_open(&one, &b);
    double pushed = 0;
    char load[64];
    snprintf(load, sizeof load, "%s.ice_force_x", name);
    for (int n = 0; n < 200; n++) {
        scene_steps(&both, 1);
        scene_steps(&one, 1);
        series_row(&both.ctx, &a.layout, &both.w, 0, a.value.data);
        series_row(&one.ctx, &b.layout, &one.w, 0, b.value.data);
        assert_same_channels(&a, &b, name, prefix, n);
        pushed = fmax(pushed, fabs(*channel(&a, load)));
    }
    ck_assert_msg(pushed > 1e4, "the largest load on %s is %g N", name, pushed);
    row_close(&both, &a);
    row_close(&one, &b);
    scene_close(&both);
    scene_close(&one);
}

START_TEST(each_does_as_alone)
{
    compare(METHOD "vessels:\n" TUG SHIP REST, METHOD "vessels:\n" TUG REST, "tug", "tug.");
    compare(METHOD "vessels:\n" TUG SHIP REST, METHOD "vessels:\n" SHIP REST, "ship", "ship.");
}
END_TEST

START_TEST(order_does_not_matter)
{
    compare(METHOD "vessels:\n" SHIP TUG REST, METHOD "vessels:\n" TUG SHIP REST, "tug", "tug.");
    compare(METHOD "vessels:\n" SHIP TUG REST, METHOD "vessels:\n" TUG SHIP REST, "ship", "ship.");
}
END_TEST

/* The short form of the towed one. */
START_TEST(short_form_is_the_same)
{
    compare(METHOD "vessels:\n" TUG SHIP REST,
            METHOD "vessel:\n  mode: towed\n  speed: 1.5\n  hydrodynamics: {source: estimate}\n"
                   "  hull: {length: 60, beam: 14, draught: 5, freeboard: 3, parallel_midbody: 0.3}\n" REST,
            "tug", "");
}
END_TEST

/* Events and equipment stand by their own vessel. */
START_TEST(equipment_is_counted_by_vessel)
{
    scene k;
    row r;
    scene_open(&k, METHOD "vessels:\n" TUG SHIP REST);
    row_open(&k, &r);
    scene_steps(&k, 120);
    series_row(&k.ctx, &r.layout, &k.w, 0, r.value.data);
    ck_assert(*channel(&r, "ship.lines_parted") == 4);
    ck_assert(*channel(&r, "tug.lines_parted") == 0);
    ck_assert(*channel(&r, "ship.thrusters_failed") == 1);
    ck_assert(*channel(&r, "tug.thruster_power") == 0);
    ck_assert_ptr_nonnull(channel(&r, "ship.line_4_tension"));
    ck_assert_ptr_null(channel(&r, "tug.line_1_tension"));
    ck_assert_ptr_null(channel(&r, "ice_force_x"));
    ck_assert_ptr_nonnull(channel(&r, "kinetic_energy"));
    row_close(&k, &r);
    scene_close(&k);
}
END_TEST

/* Two sensors of the same kind do not err alike: their noise goes by the vessels' names. */
START_TEST(noise_goes_by_name)
{
    static const char fleet[] = METHOD
        "vessels:\n"
        "  - {name: a, mode: free, hull: {form: box}, thrusters: [{x: 1}], positioning: {active: true}}\n"
        "  - {name: b, x: 500, mode: free, hull: {form: box}, thrusters: [{x: 1}], positioning: {active: true}}\n"
        "ice: {source: none}\ndomain: {boundary: open, x_min: -500, x_max: 900}\n";
    scene k;
    scene_open(&k, fleet);
    scene_steps(&k, 1);
    const body_table *b = &k.w.bodies;
    double error_a = k.w.stations.measured[0].y - b->position[k.w.vessels.body[0]].y;
    double error_b = k.w.stations.measured[1].y - b->position[k.w.vessels.body[1]].y;
    ck_assert(error_a != 0 && error_b != 0 && error_a != error_b);
    scene_close(&k);
}
END_TEST

START_TEST(ten_run)
{
    char text[4096];
    int at = snprintf(text, sizeof text, "%s", "run: {time_step: 0.02, duration: 2}\nvessels:\n");
    for (int i = 0; i < 10; i++)
        at += snprintf(text + at, sizeof text - (size_t)at,
                       "  - {name: v%d, x: %d, y: %d, mode: %s, speed: 1, hull: {form: %s, length: %d, beam: 12, "
                       "draught: 4, freeboard: 2}}\n",
                       i, 100 * (i % 5), 60 * (i / 5),
                       i % 3 == 0   ? "free"
                       : i % 3 == 1 ? "towed"
                                    : "prescribed",
                       i % 2 ? "box" : "icebreaker", 50 + i);
    snprintf(text + at, sizeof text - (size_t)at,
             "ice: {concentration: 0.6, mean_floe_area: 400, breakable: true}\n"
             "domain: {boundary: open, x_min: -60, x_max: 480, y_min: -60, y_max: 120}\n");
    scene k;
    row r;
    scene_open(&k, text);
    row_open(&k, &r);
    scene_steps(&k, 100);
    series_row(&k.ctx, &r.layout, &k.w, 0, r.value.data);
    for (int i = 0; i < 10; i++) {
        char name[32];
        snprintf(name, sizeof name, "v%d.position_x", i);
        const double *x = channel(&r, name);
        ck_assert_ptr_nonnull(x);
        ck_assert_msg(fabs(*x - 100 * (i % 5)) < 5, "%s is %g", name, *x);
    }
    row_close(&k, &r);
    scene_close(&k);
}
END_TEST

START_TEST(overlap_at_the_start_is_refused)
{
    static const char text[] = "vessels:\n"
                               "  - {name: a, hull: {form: box, length: 100, beam: 20}}\n"
                               "  - {name: b, x: 99, hull: {form: box, length: 100, beam: 20}}\n"
                               "ice: {source: none}\n";
    context ctx;
    scenario s;
    model m;
    world w;
    fram_error error = {0};
    context_init(&ctx);
    assert_ok(scenario_parse(&ctx, "scene.yaml", text, strlen(text), NULL, &s, &error), error);
    ck_assert_int_eq(scene_build(&ctx, &s, &m, &w, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, "vessels[1].x");
    ck_assert_int_eq(error.line, 3);
    ck_assert_ptr_nonnull(strstr(error.message, "vessel a"));
    s.vessels.data[1].x = 100; /* side by side is no overlap */
    error = (fram_error){0};
    assert_ok(scene_build(&ctx, &s, &m, &w, &error), error);
    world_free(&ctx, &w);
    model_free(&ctx, &m);
    scenario_free(&ctx, &s);
}
END_TEST

TEST_MAIN("vessel_list", each_does_as_alone, order_does_not_matter, short_form_is_the_same,
          equipment_is_counted_by_vessel, noise_goes_by_name, ten_run, overlap_at_the_start_is_refused)

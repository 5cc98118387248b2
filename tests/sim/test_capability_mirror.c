/* Loads from port are those from starboard where hull, ice and domain are their own mirror image, and nowhere else. */
#include "io/scenario_file.h"
#include "sim/capability.h"
#include "sim/capability_mirror.h"
#include "testing.h"

#include <stdio.h>

typedef struct mirror_case {
    const char *ice;      /* more of its section; empty: nothing */
    const char *items[3]; /* over the scenario */
    bool mirrored;
} mirror_case;

static const char *const SHEET = "ice: {source: level, thickness: 0.2, breakable: true%s}\n"
                                 "domain: {boundary: feeding, x_min: -60, x_max: 60, y_min: -60, y_max: 60}\n"
                                 "vessel: {mode: free, hull: {form: ship, length: 40, beam: 10, draught: 4},\n"
                                 "         thrusters: [{x: 15, thrust: 2.0e+5}, {x: -15, thrust: 2.0e+5}]}\n";
static const char *const TANK = "run: {scale: 1}\n"
                                "ice: {source: level, thickness: 0.02, breakable: true%s}\n"
                                "domain: {boundary: feeding, x_min: -4, x_max: 4, y_min: -4, y_max: 4}\n"
                                "vessel: {mode: free, hull: {form: ship, length: 2, beam: 0.4, draught: 0.15},\n"
                                "         thrusters: [{x: 0.7, thrust: 20}, {x: -0.7, thrust: 20}]}\n";
static const char *const FIELD = "ice: {concentration: 0.7, mean_floe_area: 60, thickness: 0.3%s}\n"
                                 "domain: {boundary: feeding, x_min: -80, x_max: 80, y_min: -80, y_max: 80}\n"
                                 "vessel: {hull: {form: ship, length: 40, beam: 10, draught: 4}}\n";

static void read_with(context *ctx, const char *pattern, const mirror_case *c, scenario *s)
{
    fram_error error = {0};
    int32_t count = 0;
    char text[700];
    while (count < 3 && c->items[count])
        count++;
    const scenario_overrides overrides = {c->items, count};
    context_init(ctx);
    snprintf(text, sizeof text, pattern, c->ice);
    assert_ok(scenario_parse(ctx, "mirror.yaml", text, strlen(text), &overrides, s, &error), error);
}

static void check_cases(const char *text, const mirror_case *cases, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        context ctx;
        scenario s = {0};
        read_with(&ctx, text, &cases[i], &s);
        ck_assert_msg(!capability_one_sided(&s) == cases[i].mirrored, "%s %s", cases[i].ice,
                      cases[i].items[0] ? cases[i].items[0] : "");
        scenario_free(&ctx, &s);
    }
}

#define OPENING(x, y, angle) "{x: " #x ", y: " #y ", length: 30, width: 20, angle_deg: " #angle "}"
#define TURNED "vessel.heading_deg=30"

START_TEST(sheets)
{
    static const mirror_case cases[] = {
        {"", {NULL}, true},
        {"", {TURNED}, true},
        {"", {"vessel.centre_of_gravity_y=0.1"}, false},
        {", level: {openings: [" OPENING(0, -12, 0) "]}", {NULL}, false},
        {", level: {openings: [" OPENING(0, 12, 0) "]}", {NULL}, false},
        {", level: {openings: [" OPENING(9, 0, 0) "]}", {NULL}, true},
        {", level: {openings: [" OPENING(9, 0, 90) "]}", {NULL}, true},
        {", level: {openings: [" OPENING(9, 0, 40) "]}", {NULL}, false},
        {", level: {openings: [" OPENING(9, 0, 40) ", " OPENING(9, 0, -40) "]}", {NULL}, true},
        {", level: {openings: [" OPENING(9, 7, 40) ", " OPENING(9, -7, 140) "]}", {NULL}, true},
        {", level: {openings: [" OPENING(9, 7, 40) ", " OPENING(9, -7, 40) "]}", {NULL}, false},
        {", level: {openings: [" OPENING(9, 0, 0) "]}", {"vessel.y=1"}, false},
        {", level: {openings: [" OPENING(0, 0, 30) "]}", {TURNED}, true},
        {", level: {openings: [" OPENING(0, 0, 0) "]}", {TURNED}, false},
        {", level: {x_min: 40}", {NULL}, true},
        {", level: {x_min: 40}", {TURNED}, false},
        {", level: {y_min: 8}", {NULL}, false},
        {", level: {y_min: -90, y_max: 90}", {NULL}, true},
        {", level: {y_min: -90, y_max: 80}", {NULL}, false},
        {", level: {y_min: -90, y_max: 90}", {"vessel.heading_deg=90"}, true},
        {", level: {y_min: -90, y_max: 91}", {NULL}, false},
        {", level: {y_min: -90, y_max: 90.001}", {NULL}, false},
        {", level: {x_min: -90, y_max: 90}", {"vessel.heading_deg=-45"}, true},
        {", level: {x_min: -90, y_max: 91}", {"vessel.heading_deg=-45"}, false},
        {", level: {x_min: -90, y_max: 90}", {"vessel.heading_deg=45"}, false},
        {", level: {x_min: 40, openings: [{x: 0, y: 0, length: 1.0e+6, width: 9}]}", {NULL}, true},
        {", level: {openings: [{x: 0, y: 0.0005, length: 1.0e+6, width: 9}]}", {NULL}, false},
    };
    check_cases(SHEET, cases, sizeof cases / sizeof *cases);
}
END_TEST

/* What is off by less than a metre is much for a model of 2 m. */
START_TEST(sheets_of_a_tank)
{
    static const mirror_case cases[] = {
        {", level: {y_min: -0.8, y_max: 0.8}", {NULL}, true},
        {", level: {y_min: -0.8, y_max: 1.8}", {NULL}, false},
        {", level: {y_min: -0.8, y_max: 0.8001}", {NULL}, false},
        {", level: {y_min: -0.7, y_max: 0.9}", {"vessel.y=0.1", "domain.y_min=-3.9", "domain.y_max=4.1"}, true},
        {", level: {x_min: -0.8, x_max: 1.8}", {NULL}, true},
        {", level: {x_min: -0.8, x_max: 1.8}", {"vessel.heading_deg=90"}, false},
        {", level: {y_min: -0.8, y_max: 0.8}", {"vessel.heading_deg=0.001"}, false},
    };
    check_cases(TANK, cases, sizeof cases / sizeof *cases);
}
END_TEST

START_TEST(fields)
{
    static const mirror_case cases[] = {
        {"", {NULL}, true},
        {"", {TURNED}, true},
        {"", {"vessel.hull.form=box"}, true},
        {", open_water: [{x: 0, y: -60, length: 160, width: 100}]", {NULL}, false},
        {", open_water: [{x: 0, y: 0, length: 160, width: 100}]", {NULL}, true},
        {", open_water_file: tests/data/none.geojson", {NULL}, false},
        {"", {"vessel.y=20"}, false},
        {"", {"vessel.x=20"}, true},
        {"", {"vessel.x=20", TURNED}, false},
        {"", {"domain.y_max=100"}, false},
        {"", {"domain.x_max=100"}, true},
        {"", {"domain.x_max=100", TURNED}, false},
        {"", {"domain.x_max=100", "vessel.heading_deg=-180"}, true},
        {"", {"vessel.x=20", "vessel.y=20", "vessel.heading_deg=45"}, true},
        {"", {"vessel.x=20", "vessel.y=-20", "vessel.heading_deg=45"}, false},
        {", populations: [{size: constant, diameter: 8}]", {NULL}, true},
        {", source: packed, populations: [{size: constant, diameter: 8}]", {NULL}, true},
        {", source: packed, populations: [{size: constant, diameter: 8, shape: templates, "
         "templates: tests/data/none.geojson}]",
         {NULL},
         false},
        {", source: file, file: tests/data/none.geojson", {NULL}, false},
    };
    check_cases(FIELD, cases, sizeof cases / sizeof *cases);
}
END_TEST

static void keep_why(void *user, log_level level, const char *text)
{
    char *why = user;
    if (level == LOG_INFO && strstr(text, "all 4 directions"))
        snprintf(why, 200, "%s", text);
}

/* As many runs as directions, and loads of their own; who waits is told why. */
START_TEST(an_opening_to_one_side_is_measured)
{
    for (int side = -1; side <= 1; side += 2) {
        context ctx;
        scenario s = {0};
        fram_error error = {0};
        char opening[120], why[200] = "";
        snprintf(opening, sizeof opening, ", level: {openings: [{x: 0, y: %d, length: 120, width: 4000}]}",
                 side * 2005);
        const mirror_case one = {opening, {"run.time_step=0.05"}, false};
        read_with(&ctx, SHEET, &one, &s);
        ctx.log = keep_why;
        ctx.log_user = why;
        const capability_options o = {.directions = 4,
                                      .speed_step = 0.5,
                                      .speed_most = 0.5,
                                      .allowance = 1,
                                      .line_safety = 1,
                                      .line_safety_damaged = 1,
                                      .measure = 6};
        capability c;
        assert_ok(capability_find(&ctx, &s, &o, &c, &error), error);
        ck_assert_double_eq(c.loads.runs, 4);
        ck_assert_msg(strstr(why, "the ice is not known to be the same to port and to starboard"), "\"%s\"", why);
        /* Ice from starboard pushes to port, that from port back, and where there is none next to nothing does. */
        double starboard = fabs(c.loads.ice[capability_row(&c, 1) * c.loads.speeds].y),
               port = fabs(c.loads.ice[capability_row(&c, 3) * c.loads.speeds].y);
        ck_assert_msg(side < 0 ? starboard < 0.2 * port : port < 0.2 * starboard, "%g N, %g N", starboard, port);
        capability_free(&ctx, &c);
        scenario_free(&ctx, &s);
    }
}
END_TEST

TEST_MAIN("capability mirror", sheets, sheets_of_a_tank, fields, an_opening_to_one_side_is_measured)

/* What the results of station keeping are made of. */
#include "scratch.h"

#include "base/transcendental.h"
#include "io/scenario_file.h"
#include "results/run_data.h"
#include "results/station_results.h"

#include <math.h>

START_TEST(envelope_of_offsets)
{
    const double time[] = {0, 1, 2, 3, 4}, x[] = {9, 2, 3, 0, -1}, y[] = {0, 0, 0.1, -4, -1};
    double out[ENVELOPE_DIRECTIONS];
    offset_envelope(time, x, y, 5, 0.5, out);
    assert_relative(out[0], sqrt(9.01), 1e-12);
    assert_relative(out[27], 4, 1e-12);
    assert_relative(out[22] + out[23], sqrt(2.0), 1e-12);
    for (int i = 1; i < 20; i++)
        ck_assert(!(out[i] > 0));
}
END_TEST

/* A direction's sector of 10 degrees reaches 5 to either side. */
START_TEST(sectors_lie_about_their_directions)
{
    for (int direction = 0; direction < ENVELOPE_DIRECTIONS; direction++) {
        for (int off = -4; off <= 4; off += 4) {
            double angle = radians(10.0 * direction + off), out[ENVELOPE_DIRECTIONS];
            const double time = 1, x = 3 * real_cos(angle), y = 3 * real_sin(angle);
            offset_envelope(&time, &x, &y, 1, 0, out);
            for (int i = 0; i < ENVELOPE_DIRECTIONS; i++)
                assert_absolute(out[i], i == direction ? 3 : 0, 1e-12);
        }
    }
}
END_TEST

/* Statistics begin with the first row that is not in the transient. */
START_TEST(the_transient_is_left_out)
{
    static double time[] = {0, 1, 2, 3, 4};
    csv_table_column column = {.name = "time", .value = {time, 5, 5}};
    run_data d = {.series = {.columns = {&column, 1, 1}, .rows = 5}};
    static const double transient[] = {0, 0.5, 1, 3.5, 9};
    static const int first[] = {0, 1, 2, 4, 5};
    for (int i = 0; i < 5; i++) {
        d.s.run.transient = transient[i];
        ck_assert_int_eq(run_first_row(&d), first[i]);
    }
    d.series.columns.count = 0;
    ck_assert_int_eq(run_first_row(&d), 0);
}
END_TEST

/* ---- the second of two vessels ---- */

#define HULL "    mode: free\n    hull: {form: box, length: 60, beam: 12, draught: 4, freeboard: 2}\n"
static const char two_ships[] = "run: {transient: 1, time_step: 0.2}\noutput: {averaging_window: 0.75}\nvessels:\n"
                                "  - name: a\n" HULL "    thrusters: [{thrust: 10}]\n"
                                "    mooring: {lines: [{kind: spring, distance: 100, stiffness: 1}]}\n"
                                "  - name: b\n" HULL "    thrusters: [{thrust: 50}]\n"
                                "    station: {offset_limit: 9, heading_limit_deg: 3}\n"
                                "    mooring: {lines: [{kind: spring, distance: 100, stiffness: 1}]}\n";

/* A row at the end of the transient, and three of one second each. */
static const char two_series[] =
    "time[s],b.offset_x[m],b.offset_y[m],b.heading_deviation[deg],b.ice_force_averaged_x[N],b.ice_force_averaged_y[N],"
    "b.thruster_power[W],b.thrusters_saturated[1],b.line_tension_max[N],b.line_1_tension[N],b.thruster_1_thrust[N]\n"
    "1,99,99,99,99,99,99,99,99,99,99\n"
    "2,3,4,1,10,-1,6,0,100,100,20\n"
    "3,6,8,-5,10,-2,6,1,800,800,-10\n"
    "4,3,4,4,10,-3,6,0,0,0,40\n";

static void check_told(const char *text, const char *expected)
{
    if (!strstr(text, expected))
        ck_abort_msg("station-b.json lacks %s:\n%s", expected, text);
}

static char *told_of(context *ctx, const scenario *s, const station_outcome *o, scratch *f, const char *series)
{
    fram_error error = {0};
    size_t size;
    scratch_write(scratch_path(f, "series.csv"), series, strlen(series));
    assert_ok(station_results_write(ctx, s, 1, o, f->folder, &error), error);
    char *text = scratch_read(scratch_path(f, "station-b.json"), &size);
    text[size] = '\0';
    return text;
}

/* Rows from 3 s on of a run to 4.5 s: the first one is of one interval, here of 1 s in whole steps, then of a step. */
static void check_late_energy(context *ctx, scenario *s, const station_outcome *o, scratch *f)
{
    char late[sizeof two_series];
    snprintf(late, sizeof late, "%.*s%s", (int)(strchr(two_series, '\n') - two_series), two_series,
             strstr(two_series, "\n3,"));
    const double interval[] = {1.05, 0}, energy[] = {6 * 2.5, 6 * 1.7};
    for (int i = 0; i < 2; i++) {
        s->output.csv_interval = interval[i];
        char *text = told_of(ctx, s, o, f, late), *at = strstr(text, "\"energy_J\": ");
        ck_assert_ptr_nonnull(at);
        assert_relative(strtod(at + 12, NULL), energy[i], 1e-9);
        free(text);
    }
}

/* Its lines, thrusters and events stand behind those of the first in the tables; its line was used up as it parted. */
START_TEST(results_of_the_second_vessel)
{
    scratch f = scratch_make();
    context ctx;
    scenario s;
    line_table lines = {0};
    thruster_table thrusters = {0};
    event_table events = {0};
    fram_error error = {0};
    context_init(&ctx);
    assert_ok(scenario_parse(&ctx, "two.yaml", two_ships, strlen(two_ships), NULL, &s, &error), error);
    ck_assert(table_resize(&ctx, &lines, &line_table_info, 2) &&
              table_resize(&ctx, &thrusters, &thruster_table_info, 2));
    for (int i = 0; i < 2; i++) {
        lines.vessel[i] = thrusters.vessel[i] = i;
        lines.breaking_load[i] = i ? 1000 : 1e9;
        lines.broken[i] = i == 1;
        thrusters.ahead[i] = i ? 50 : 1e9;
        thrusters.astern[i] = i ? 25 : 1e9;
        thrusters.failed[i] = 0;
    }
    ck_assert(event_add(&ctx, &events, EVENT_LINE_BREAK, 1.5, 0, 0, 444) &&
              event_add(&ctx, &events, EVENT_LINE_BREAK, 2.5, 1, 0, 950));
    const station_outcome o = {4.5, &lines, &thrusters, &events};
    char *text = told_of(&ctx, &s, &o, &f, two_series);
    static const char *const told[] = {
        "\"vessel\": \"b\"",
        "\"averaging_window_s\": 0.8,", /* in whole steps */
        "\"greatest\": 10, \"peak\": 10, \"limit\": 9, \"exceedance\": 0.333333333333333",
        "\"limit\": 3, \"exceedance\": 0.666666666666666",
        "\"ice_load_x_N\": {\"mean\": 10,",
        "\"ice_load_y_N\": {\"mean\": -2,",
        "\"energy_J\": 21", /* three rows of a second each, and half of one behind them */
        "\"thrusters_saturated\": 0.333333333333333",
        "\"parted\": true, \"parted_at_s\": 2.5, \"tension_then\": 950, \"utilisation\": 0.95, \"mean\": 300",
        "\"failed\": false, \"largest_use\": 0.8,",
        "\"time_s\": 2.5, \"value\": 950, \"number\": 1,"};
    for (size_t i = 0; i < sizeof told / sizeof *told; i++)
        check_told(text, told[i]);
    ck_assert_ptr_null(strstr(text, "444"));
    free(text);
    check_late_energy(&ctx, &s, &o, &f);
    unlink(scratch_path(&f, "series.csv"));
    scratch_remove(&f, "station-b.json");
    table_free(&ctx, &lines, &line_table_info);
    table_free(&ctx, &thrusters, &thruster_table_info);
    table_free(&ctx, &events, &event_table_info);
    scenario_free(&ctx, &s);
}
END_TEST

TEST_MAIN("station_results", envelope_of_offsets, sectors_lie_about_their_directions, the_transient_is_left_out,
          results_of_the_second_vessel)

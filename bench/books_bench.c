/* Whether the parts of the ice load add up to it in every step of a scenario: mechanisms and zones of the hull, each
   axis of force and moment, for every vessel; as the step leaves them, and as they stand in a row of series.csv.

       books_bench SCENARIO [SECONDS]        SECONDS: of processor time at most, then it stops where it is

   Told on lines of JSON, one every few seconds and one at the end: the largest difference so far between the sum of the
   parts and the load, over the largest load so far of that vessel.  Exit code 1 when one is over BOUND. */
#include "base/clock.h"
#include "base/number_text.h"
#include "io/scenario_file.h"
#include "model/scenario_vessel.h"
#include "sim/build.h"
#include "sim/series.h"
#include "sim/step.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of the largest load. */
#define BOUND 1e-9
/* Between two lines, of processor time [s]. */
#define LINE_PERIOD 10.0

/* The load, then its parts, in the order of the columns; "" ends a list. */
#define PARTS_MOST 10
static const char *const mechanism_parts[PARTS_MOST] = {
#define NAME(id, name, text) "mechanism_" name,
    ICE_MECHANISMS(NAME)
#undef NAME
        NULL};
static const char *const zone_parts[PARTS_MOST] = {"ice_force_bow",   "ice_force_shoulder", "ice_force_midbody",
                                                   "ice_force_stern", "ice_force_bottom",   NULL};
static const char *const cap_parts[PARTS_MOST] = {"ice_force_capped", "ice_force_below_cap", "ice_force_friction",
                                                  NULL};

/* One sum: that of three columns is the sums of the columns of its parts. */
typedef struct book {
    int32_t whole, part[PARTS_MOST], parts; /* first columns, x */
    double difference, peak;                /* largest of an axis, largest length */
} book;

/* What is kept of one vessel. */
enum { BOOK_FORCE, BOOK_MOMENT, BOOK_ZONES, BOOK_CAPS, BOOK_COUNT };
typedef struct vessel_books {
    book row[BOOK_COUNT];
    double force, moment, zones, peak_force, peak_moment; /* of the step itself */
} vessel_books;

typedef struct books {
    context ctx;
    scenario s;
    model m;
    world w;
    series_layout layout;
    ARRAY(double) row;
    ARRAY(vessel_books) vessels;
    int64_t loaded; /* steps with an ice load on a vessel */
} books;

static int fail(const fram_error *error)
{
    fprintf(stderr, "books_bench: %s: %s: %s\n", error->file, error->key, error->message);
    return 2;
}

static int32_t column_of(const books *b, int32_t vessel, const char *name, const char *ending)
{
    char whole[80];
    snprintf(whole, sizeof whole, "%s%s_x", name, ending);
    vessel_channel channel = vessel_channel_name(&b->s, vessel, whole);
    for (int32_t i = 0; i < b->layout.names.count; i++)
        if (strcmp(b->layout.names.data[i].text, channel.text) == 0)
            return i;
    fprintf(stderr, "books_bench: no column %s\n", channel.text);
    exit(2);
}

static book find_book(const books *b, int32_t vessel, const char *whole, const char *const *parts, const char *ending)
{
    book k = {.whole = column_of(b, vessel, whole, "")};
    for (; parts[k.parts]; k.parts++)
        k.part[k.parts] = column_of(b, vessel, parts[k.parts], ending);
    return k;
}

static bool find_columns(books *b)
{
    for (int32_t v = 0; v < b->w.vessels.count; v++) {
        vessel_books k = {.row = {find_book(b, v, "ice_force", mechanism_parts, ""),
                                  find_book(b, v, "ice_moment", mechanism_parts, "_moment"),
                                  find_book(b, v, "ice_force", zone_parts, ""),
                                  find_book(b, v, "ice_force", cap_parts, "")}};
        if (!array_push(&b->ctx, &b->vessels, k))
            return false;
    }
    return true;
}

/* The larger one; what is not a number stays. */
static void keep_most(double *most, double value)
{
    if (!(value <= *most) && !isnan(*most))
        *most = value;
}

static double axis_most(vec3 v)
{
    double most = fabs(v.x);
    keep_most(&most, fabs(v.y));
    keep_most(&most, fabs(v.z));
    return most;
}

/* As the step leaves it. */
static void check_step(const ice_load *l, vessel_books *k)
{
    wrench mechanisms = {0};
    vec3 zones = {0};
    for (int i = 0; i < MECHANISM_COUNT; i++) {
        mechanisms.force = vec3_add(mechanisms.force, l->mechanism[i].force);
        mechanisms.moment = vec3_add(mechanisms.moment, l->mechanism[i].moment);
    }
    for (int i = 0; i < ZONE_COUNT; i++)
        zones = vec3_add(zones, l->zone[i].force);
    keep_most(&k->force, axis_most(vec3_sub(mechanisms.force, l->total.force)));
    keep_most(&k->moment, axis_most(vec3_sub(mechanisms.moment, l->total.moment)));
    keep_most(&k->zones, axis_most(vec3_sub(zones, l->total.force)));
    keep_most(&k->peak_force, vec3_length(l->total.force));
    keep_most(&k->peak_moment, vec3_length(l->total.moment));
}

/* A value as whoever reads series.csv finds it. */
static double as_written(double value)
{
    char text[NUMBER_TEXT_SIZE];
    if (value == 0)
        return value;
    real_to_digits(value, CSV_DIGITS, text);
    return real_read(text, &(char *){NULL});
}

static void check_row(const double *row, book *k)
{
    vec3 whole = {0};
    double *axis = &whole.x;
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        axis[i] = as_written(row[k->whole + i]);
        for (int p = 0; p < k->parts; p++)
            sum += as_written(row[k->part[p] + i]);
        keep_most(&k->difference, fabs(sum - axis[i]));
    }
    keep_most(&k->peak, vec3_length(whole));
}

static void check_now(books *b)
{
    bool loaded = false;
    series_row(&b->ctx, &b->layout, &b->w, 0, b->row.data);
    for (int32_t v = 0; v < b->vessels.count; v++) {
        vessel_books *k = &b->vessels.data[v];
        const ice_load *l = &b->w.scratch.ice_loads.data[v];
        loaded |= vec3_length(l->total.force) > 0;
        check_step(l, k);
        for (int i = 0; i < BOOK_COUNT; i++)
            check_row(b->row.data, &k->row[i]);
    }
    b->loaded += loaded;
}

/* 0 of nothing. */
static double part_of(double difference, double peak) { return difference == 0 ? 0 : difference / peak; }

/* Whether every sum is within the bound. */
static bool tell(const books *b)
{
    double step = 0, row = 0, zones = 0, peak = 0;
    for (int32_t v = 0; v < b->vessels.count; v++) {
        const vessel_books *k = &b->vessels.data[v];
        keep_most(&step, part_of(k->force, k->peak_force));
        keep_most(&step, part_of(k->moment, k->peak_moment));
        keep_most(&zones, part_of(k->zones, k->peak_force));
        keep_most(&peak, k->peak_force);
        for (int i = 0; i < BOOK_COUNT; i++)
            keep_most(&row, part_of(k->row[i].difference, k->row[i].peak));
    }
    printf("{\"time\": %.10g, \"duration\": %.10g, \"steps\": %lld, \"loaded\": %lld, \"vessels\": %d, \"peak\": %.6g, "
           "\"step\": %.3g, \"zones\": %.3g, \"row\": %.3g, \"processor\": %.1f}\n",
           b->w.clock.time[0], b->s.run.duration, (long long)b->w.clock.step[0], (long long)b->loaded,
           (int)b->vessels.count, peak, step, zones, row, clock_processor());
    fflush(stdout);
    return step <= BOUND && zones <= BOUND && row <= BOUND;
}

static fram_status open_scene(books *b, const char *path, fram_error *error)
{
    field_report report;
    fram_status status = scenario_read(&b->ctx, path, NULL, &b->s, error);
    if (status == FRAM_OK)
        status = build_model(&b->ctx, &b->s, &b->m, error);
    if (status == FRAM_OK)
        status = build_world(&b->ctx, &b->s, &b->m, &b->w, &report, error);
    if (status == FRAM_OK)
        status = series_columns(&b->ctx, &b->s, &b->layout, error);
    if (status == FRAM_OK && (!array_resize(&b->ctx, &b->row, b->layout.names.count) || !find_columns(b)))
        status = error_memory(error);
    return status;
}

int main(int argc, char **argv)
{
    static books b;
    fram_error error = {0};
    double most = argc > 2 ? strtod(argv[2], NULL) : HUGE_VAL, told = 0;
    if (argc < 2) {
        fprintf(stderr, "usage: books_bench SCENARIO [SECONDS]\n");
        return 2;
    }
    context_init(&b.ctx);
    fram_status status = open_scene(&b, argv[1], &error);
    int64_t steps = status == FRAM_OK ? (int64_t)floor(b.s.run.duration / b.m.time_step + 0.5) : 0;
    while (status == FRAM_OK && b.w.clock.step[0] < steps && clock_processor() < most) {
        status = world_step(&b.ctx, &b.m, &b.w, &error);
        if (status == FRAM_OK)
            check_now(&b);
        if (clock_processor() - told > LINE_PERIOD) {
            told = clock_processor();
            (void)tell(&b);
        }
    }
    if (status != FRAM_OK)
        return fail(&error);
    bool good = tell(&b);
    array_free(&b.ctx, &b.vessels);
    array_free(&b.ctx, &b.row);
    series_layout_free(&b.ctx, &b.layout);
    world_free(&b.ctx, &b.w);
    model_free(&b.ctx, &b.m);
    scenario_free(&b.ctx, &b.s);
    return good ? 0 : 1;
}

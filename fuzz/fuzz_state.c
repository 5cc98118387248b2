/* A state of a run that is another one in some of its numbers, as a forged checkpoint has them, loaded into a real
   world and stepped.  The input is text, a line a number: TABLE.COLUMN ROW NUMBER VALUE; rows and numbers are taken
   modulo what there is, and a line that says nothing is passed over.  Promises: a refusal says which number cannot be;
   a state that is believed is stepped, or the step says what went wrong. */
#include "fuzzing.h"
#include "io/scenario_file.h"
#include "model/world_check.h"
#include "sim/build.h"
#include "sim/step.h"
#include <string.h>

enum { STEPS_BEFORE = 30, STEPS_AFTER = 3, LINES_MOST = 16 };

/* Joints, lines, thrusters, a controller, floes that break and books of all of them. */
static const char scene_words[] =
    "run: {duration: 5, time_step: 0.05}\n"
    "vessels:\n"
    "  - {name: a, mode: towed, x: -20, speed: 2, hull: {form: box, length: 20, beam: 8, draught: 2, freeboard: 2}}\n"
    "  - {name: b, mode: free, x: 15, hull: {form: box, length: 16, beam: 6, draught: 2, freeboard: 2},\n"
    "     mooring: {depth: 60, lines: [{count: 2, spacing_deg: 180, distance: 200, pretension: 3e5}]},\n"
    "     thrusters: [{x: 5, thrust: 1e4}, {x: -5, thrust: 1e4}], positioning: {active: true}}\n"
    "ice: {source: voronoi, concentration: 0.9, mean_floe_area: 60, thickness: 0.5, breakable: true}\n"
    "domain: {x_min: -40, x_max: 40, y_min: -16, y_max: 16}\n";

/* One for all inputs: each is of a copy of it. */
static struct {
    bool made;
    context ctx;
    scenario s;
    model m;
    world w;
} base;

static void make_base(void)
{
    fram_error error = {0};
    field_report report;
    context_init(&base.ctx);
    fram_status status =
        scenario_parse(&base.ctx, "fuzz.yaml", scene_words, sizeof scene_words - 1, NULL, &base.s, &error);
    if (status == FRAM_OK)
        status = build_model(&base.ctx, &base.s, &base.m, &error);
    if (status == FRAM_OK)
        status = build_world(&base.ctx, &base.s, &base.m, &base.w, &report, &error);
    for (int i = 0; i < STEPS_BEFORE && status == FRAM_OK; i++)
        status = world_step(&base.ctx, &base.m, &base.w, &error);
    if (status != FRAM_OK)
        fprintf(stderr, "%s: %s\n", error.key, error.message);
    PROMISE(status == FRAM_OK);
    PROMISE(world_check(&base.m, &base.w, &error) == FRAM_OK);
    PROMISE(world_check_numbers(&base.m, &base.w, &error) == FRAM_OK);
    base.made = true;
}

static void put_number(void *at, field_kind kind, double value)
{
    const int64_t whole = value >= -9e18 && value <= 9e18 ? (int64_t)value : 0;
    const int32_t half = (int32_t)(uint32_t)(uint64_t)whole;
    const uint8_t byte = (uint8_t)(uint64_t)whole;
    switch (kind) {
    case FIELD_F64:
        memcpy(at, &value, sizeof value);
        return;
    case FIELD_I32:
    case FIELD_U32:
        memcpy(at, &half, sizeof half);
        return;
    case FIELD_U8:
        memcpy(at, &byte, sizeof byte);
        return;
    default:
        memcpy(at, &whole, sizeof whole);
    }
}

/* "body.mass" */
static bool is_named(const char *name, const char *table, const char *column)
{
    size_t length = strlen(table);
    return strncmp(name, table, length) == 0 && name[length] == '.' && strcmp(name + length + 1, column) == 0;
}

static void change_number(world *w, const char *line)
{
    char name[64];
    unsigned row, number;
    double value;
    world_table tables[WORLD_TABLE_COUNT];
    if (sscanf(line, "%63s %u %u %lf", name, &row, &number, &value) != 4)
        return;
    world_tables(w, tables);
    for (int t = 0; t < WORLD_TABLE_COUNT; t++) {
        const int32_t rows = ((const table_head *)tables[t].table)->count;
        for (int f = 0; f < tables[t].info->field_count && rows > 0; f++) {
            const field_info *field = &tables[t].info->fields[f];
            const size_t size = field_kind_size(field->kind);
            if (is_named(name, tables[t].info->name, field->name))
                put_number((char *)table_field(tables[t].table, field) + row % (unsigned)rows * field->size +
                               number % (unsigned)field->components * size,
                           field->kind, value);
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    world w;
    fram_error error = {0};
    if (!base.made)
        make_base();
    char *text = malloc(size + 1), *rest = NULL;
    if (!text || world_copy(&base.ctx, &base.w, &w, &error) != FRAM_OK) {
        free(text);
        return 0;
    }
    if (size > 0)
        memcpy(text, data, size);
    text[size] = '\0';
    int lines = 0;
    for (char *line = strtok_r(text, "\n", &rest); line && lines < LINES_MOST;
         line = strtok_r(NULL, "\n", &rest), lines++)
        change_number(&w, line);
    fram_status status = world_check(&base.m, &w, &error);
    if (status == FRAM_OK)
        status = world_check_numbers(&base.m, &w, &error);
    PROMISE(status == FRAM_OK || (status == FRAM_ERROR_INPUT && error.key[0] && error.message[0]));
    for (int i = 0; i < STEPS_AFTER && status == FRAM_OK; i++) {
        status = world_step(&base.ctx, &base.m, &w, &error);
        PROMISE(status == FRAM_OK || (error.status == status && error.message[0]));
    }
    world_free(&base.ctx, &w);
    free(text);
    return 0;
}

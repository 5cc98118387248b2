#include "results/export.h"

#include "base/number_text.h"
#include "io/geojson.h"
#include "io/scenario_file.h"
#include "model/scenario_vessel.h"
#include "results/replay_moment.h"

#include <stdio.h>
#include <string.h>

enum {
    COLUMN_THICKNESS,
    COLUMN_AREA,
    COLUMN_VELOCITY_X,
    COLUMN_VELOCITY_Y,
    COLUMN_CONTACT_FORCE,
    COLUMN_AGE,
    COLUMN_NUMBER,
    COLUMN_PARENT,
    PLAN_COLUMNS
};
static const char *const column_names[PLAN_COLUMNS] = {"thickness",     "area", "velocity_x", "velocity_y",
                                                       "contact_force", "age",  "floe",       "parent"};
static const char *const kinds[MATERIAL_COUNT] = {"floe", "vessel", "wall"};

typedef struct plan_columns {
    ARRAY(double) value[PLAN_COLUMNS];
    ARRAY(const char *) kind, name; /* name: of a vessel of a list, otherwise NULL */
} plan_columns;

static bool fill_columns(context *ctx, const replay *r, const replay_moment *m, const scenario *s, plan_columns *c)
{
    const double none = (double)NAN;
    bool good = true;
    for (int32_t i = 0; i < m->poses.count && good; i++) {
        const replay_pose *p = &m->poses.data[i];
        const replay_body *b = &r->bodies.data[p->body];
        bool ice = b->material == MATERIAL_ICE;
        const double row[PLAN_COLUMNS] = {[COLUMN_THICKNESS] = b->solid ? none : b->thickness,
                                          [COLUMN_AREA] = b->solid ? none : b->area,
                                          [COLUMN_VELOCITY_X] = p->velocity.x,
                                          [COLUMN_VELOCITY_Y] = p->velocity.y,
                                          [COLUMN_CONTACT_FORCE] = p->contact_force,
                                          [COLUMN_AGE] = ice ? m->time - b->birth : none,
                                          [COLUMN_NUMBER] = ice ? b->number : none,
                                          [COLUMN_PARENT] = ice && b->parent >= 0 ? b->parent : none};
        for (int k = 0; k < PLAN_COLUMNS && good; k++)
            good = array_push(ctx, &c->value[k], row[k]);
        good = good && array_push(ctx, &c->kind, kinds[b->material]) &&
               array_push(ctx, &c->name, b->vessel >= 0 ? scenario_vessel_name(s, b->vessel) : NULL);
    }
    return good;
}

/* The scenario in the record, for its vessels' names; none where it cannot be read any more. */
static fram_status read_scenario(context *ctx, const replay *r, const char *folder, scenario *s, fram_error *error)
{
    fram_error reason = {0};
    char name[PATH_ROOM];
    fram_status status = path_join(folder, "scenario.yaml", name, error);
    if (status != FRAM_OK || !r->scenario)
        return status;
    status = scenario_parse(ctx, name, r->scenario, strlen(r->scenario), NULL, s, &reason);
    if (status == FRAM_ERROR_MEMORY)
        return error_memory(error);
    if (status != FRAM_OK) {
        *s = (scenario){0};
        log_write(ctx, LOG_WARNING, "%s: vessels are told without their names: %s", name, reason.message);
    }
    return FRAM_OK;
}

fram_status export_geojson(context *ctx, const char *folder, const char *output, double time, export_report *report,
                           fram_error *error)
{
    replay r;
    replay_moment m = {0};
    plan_columns c = {0};
    scenario s = {0};
    *report = (export_report){.frames = 1};
    char text[NUMBER_TEXT_SIZE];
    real_to_text(time, text); /* all its digits, so that every time has a name of its own */
    char name[NUMBER_TEXT_SIZE + 16];
    snprintf(name, sizeof name, "field-%s.geojson", text);
    fram_status status = path_given_or(output, folder, name, report->path, error);
    if (status == FRAM_OK)
        status = replay_open(ctx, folder, &r, error);
    if (status != FRAM_OK)
        return status;
    status = replay_moment_at(&r, time, &m, error);
    if (status == FRAM_OK)
        status = read_scenario(ctx, &r, folder, &s, error);
    if (status == FRAM_OK && !fill_columns(ctx, &r, &m, &s, &c))
        status = error_memory(error);
    if (status == FRAM_OK) {
        geojson_property property[PLAN_COLUMNS + 2] = {{.name = "kind", .text = c.kind.data},
                                                       {.name = "name", .text = c.name.data}};
        for (int k = 0; k < PLAN_COLUMNS; k++)
            property[k + 2] = (geojson_property){.name = column_names[k], .value = c.value[k].data};
        report->time = m.time;
        geojson_parts parts = {m.part_of.data, m.part_of.count};
        status =
            geojson_write_properties(ctx, report->path, &m.outlines, parts, property, PLAN_COLUMNS + 2, m.time, error);
    }
    for (int k = 0; k < PLAN_COLUMNS; k++)
        array_free(ctx, &c.value[k]);
    array_free(ctx, &c.kind);
    array_free(ctx, &c.name);
    scenario_free(ctx, &s);
    replay_moment_free(ctx, &m);
    replay_close(&r);
    return status;
}

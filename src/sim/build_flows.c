#include "sim/build_flows.h"

#include "base/transcendental.h"
#include "io/csv_read.h"

#include <stdio.h>

/* As those of a table in the scenario, in a file too. */
enum { COEFFICIENT_MOST = 100 };
/* Of the name of a section of coefficients. */
enum { FLOW_KEY_SIZE = 64 };
/* What flows past a hull gives it energy at no angle.  Against the motion may stand this part of a force, as scatter,
   and forces that are so small a part of the largest one. */
#define AGAINST_MOST 0.1
#define FORCE_LEAST 1e-3

/* Rows as they are given. */
typedef struct flow_rows {
    double_array column[4]; /* angle [deg], CX, CY, CN */
} flow_rows;

static void rows_free(context *ctx, flow_rows *rows)
{
    for (int i = 0; i < 4; i++)
        array_free(ctx, &rows->column[i]);
}

/* What a table is read with: its section and that one's name, and what flows. */
typedef struct flow_job {
    context *ctx;
    const scenario *s;
    const scenario_flow *from;
    const char *key, *medium;
    fram_error *error;
} flow_job;

static fram_status read_rows(const flow_job *j, flow_rows *rows)
{
    static const char *const names[4] = {"angle[deg]", "cx", "cy", "cn"};
    if (j->from->table_file[0]) {
        char path[SCENARIO_PATH_ROOM];
        fram_status status = scenario_file_path(j->s, NULL, j->from->table_file, path, j->error);
        return status == FRAM_OK ? csv_read(j->ctx, path, names, 4, rows->column, j->error) : status;
    }
    for (int32_t i = 0; i < j->from->table.count; i++) {
        const scenario_flow_row *r = &j->from->table.data[i];
        const double value[4] = {r->angle_deg, r->cx, r->cy, r->cn};
        for (int k = 0; k < 4; k++)
            if (!array_push(j->ctx, &rows->column[k], value[k]))
                return error_memory(j->error);
    }
    return FRAM_OK;
}

/* ---- rules ---- */

/* Names the row: of the scenario, or of its file. */
static fram_status fault(const flow_job *j, int32_t row, const char *rule, double found)
{
    char name[80];
    char path[SCENARIO_PATH_ROOM];
    bool in_file = j->from->table_file[0] && scenario_resolve_path(j->s, j->from->table_file, path, sizeof path);
    snprintf(name, sizeof name, in_file ? "%s.table_file" : row < 0 ? "%s.table" : "%s.table[%d]", j->key, (int)row);
    if (in_file && row >= 0)
        return error_set(j->error, FRAM_ERROR_INPUT, path, csv_line_of(j->ctx, path, row), name,
                         "expected %s, found %g", rule, found);
    error_value(j->error, name, rule, found);
    scenario_locate(j->s, j->error);
    return FRAM_ERROR_INPUT;
}

static bool differs(double a, double b) { return !(fabs(a - b) <= 1e-9); }

static fram_status check_ends(const flow_job *j, const flow_rows *rows, int32_t count)
{
    const double *angle = rows->column[0].data;
    int32_t last = count - 1;
    if (differs(angle[0], 0))
        return fault(j, 0, "the angle 0 first", angle[0]);
    bool whole = !differs(angle[last], 360);
    if (!whole && differs(angle[last], 180))
        return fault(j, last, "180 (for equal sides) or 360 degrees last", angle[last]);
    for (int k = 1; k < 4 && whole; k++)
        if (differs(rows->column[k].data[last], rows->column[k].data[0]))
            return fault(j, last, "at 360 degrees what stands at 0", rows->column[k].data[last]);
    for (int k = 2; k < 4 && !whole; k++)
        for (int32_t i = 0; i < count; i += last)
            if (differs(rows->column[k].data[i], 0))
                return fault(j, i, "no CY and CN at 0 and 180 degrees, since the sides are alike",
                             rows->column[k].data[i]);
    return FRAM_OK;
}

static fram_status check_rows(const flow_job *j, const flow_rows *rows)
{
    int32_t count = rows->column[0].count;
    if (count < 2 || count > FLOW_ANGLES)
        return fault(j, -1, "2 to 73 rows", count);
    for (int32_t i = 0; i < count; i++) {
        for (int k = 0; k < 4; k++)
            if (!isfinite(rows->column[k].data[i]))
                return fault(j, i, "finite numbers", rows->column[k].data[i]);
        for (int k = 1; k < 4; k++)
            if (!(fabs(rows->column[k].data[i]) <= COEFFICIENT_MOST))
                return fault(j, i, "coefficients from -100 to 100", rows->column[k].data[i]);
        if (i > 0 && !(rows->column[0].data[i] > rows->column[0].data[i - 1]))
            return fault(j, i, "a larger angle than in the row before", rows->column[0].data[i]);
    }
    return check_ends(j, rows, count);
}

/* ---- slips ---- */

/* Forward and to port, over the pressure of the medium [m2]. */
static vec2 force_area(const flow_table *t, int32_t i)
{
    return vec2_make(t->coefficient[i].x * t->frontal, t->coefficient[i].y * t->lateral);
}

/* Angles that are counted from ahead, or forces of other signs: such a hull swims against the current, ever faster. */
static void warn_of_signs(const flow_job *j, const flow_table *t)
{
    double largest = 0;
    for (int32_t i = 0; i < t->count; i++)
        largest = fmax(largest, vec2_length(force_area(t, i)));
    for (int32_t i = 0; i < t->count; i++) {
        vec2 force = force_area(t, i);
        double size = vec2_length(force);
        double along = force.x * real_cos(t->angle[i]) + force.y * real_sin(t->angle[i]);
        if (size < FORCE_LEAST * largest || along >= -AGAINST_MOST * size)
            continue;
        log_write(j->ctx, LOG_WARNING,
                  "%s: at %.4g degrees cx and cy push the vessel against the motion of the %s: angles are of where it "
                  "goes, 0 from astern and 180 from ahead, cx is forward and cy to port",
                  j->key, t->angle[i] * (180 / PI), j->medium);
        return;
    }
}

/* On a ship that drives itself the table stands for the lift of the hull that slides (sim/build_propulsion.c). */
static void warn_of_lift(context *ctx, const char *key, const scenario_vessel *v, const flow_table *t)
{
    bool aside = false, turns = false;
    for (int32_t i = 0; i < t->count; i++) {
        aside = aside || t->coefficient[i].y != 0;
        turns = turns || t->coefficient[i].z != 0;
    }
    if (t->count > 0 && !(aside && turns) && v->mode == VESSEL_FREE && vessel_drives_itself(v))
        log_write(
            ctx, LOG_WARNING,
            "%s: on a ship with propulsion the table stands for the lift of a hull that slides, and it has no %s: "
            "give cy and cn",
            key,
            aside   ? "cn"
            : turns ? "cy"
                    : "cy and cn");
}

/* ---- a table ---- */

/* Ends that go for 0, 180 and 360 degrees are these: between the last angle and a full turn the other side would be
   meant. */
static void set_ends(flow_table *t)
{
    t->angle[0] = 0;
    t->angle[t->count - 1] = t->angle[t->count - 1] < 1.5 * PI ? PI : 2 * PI;
}

/* height: of the part of the hull that the medium meets; middle: of that part over the design waterline [m]. */
static fram_status build_one(const flow_job *j, const vessel_model *hull, double height, double middle, flow_table *out)
{
    const scenario_flow *from = j->from;
    flow_rows rows = {0};
    *out = (flow_table){0};
    if (from->table.count == 0 && !from->table_file[0])
        return FRAM_OK;
    fram_status status = from->table.count > 0 && from->table_file[0]
                             ? fault(j, -1, "a table or a table_file, not both", from->table.count)
                             : read_rows(j, &rows);
    if (status == FRAM_OK)
        status = check_rows(j, &rows);
    const hull_particulars *p = &hull->particulars;
    out->frontal = automatic_or(from->frontal_area, p->beam * height);
    out->lateral = automatic_or(from->lateral_area, p->length * height);
    out->length = automatic_or(from->length, p->length);
    out->point = vec3_sub(vec3_make(from->x, 0, automatic_or(from->z, middle)), hull->centre);
    for (int32_t i = 0; i < rows.column[0].count && status == FRAM_OK; i++) {
        out->angle[i] = radians(rows.column[0].data[i]);
        out->coefficient[i] = vec3_make(rows.column[1].data[i], rows.column[2].data[i], rows.column[3].data[i]);
        out->count = i + 1;
    }
    rows_free(j->ctx, &rows);
    if (status == FRAM_OK) {
        set_ends(out);
        warn_of_signs(j, out);
    }
    return status;
}

fram_status build_flows(context *ctx, const scenario *s, const vessel_entry *entry, vessel_model *vessel,
                        fram_error *error)
{
    const scenario_vessel *v = entry->keys;
    double draught = vessel->particulars.draught, freeboard = vessel->particulars.freeboard;
    char water[FLOW_KEY_SIZE], air[FLOW_KEY_SIZE];
    snprintf(water, sizeof water, "%s.current_coefficients", entry->path);
    snprintf(air, sizeof air, "%s.wind_coefficients", entry->path);
    vessel->flows.depth = 0.5 * draught;
    const flow_job current = {ctx, s, &v->current_coefficients, water, "current", error};
    const flow_job wind = {ctx, s, &v->wind_coefficients, air, "wind", error};
    fram_status status = build_one(&current, vessel, draught, -0.5 * draught, &vessel->flows.water);
    if (status == FRAM_OK)
        warn_of_lift(ctx, water, v, &vessel->flows.water);
    if (status == FRAM_OK)
        status = build_one(&wind, vessel, freeboard, 0.5 * freeboard, &vessel->flows.air);
    return status;
}

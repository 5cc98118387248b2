#include "vessel/mooring.h"

#include "base/number_text.h"
#include "base/transcendental.h"

#include <stdio.h>

#define TABLE_SELF line_table
TABLE_DEFINE(line, LINE_FIELDS)
#undef TABLE_SELF

/* The member names a point: "table[2].offset". */
static fram_status refuse_point(fram_error *error, int32_t point, const char *member, const char *rule, double found)
{
    char key[48];
    snprintf(key, sizeof key, "table[%d].%s", (int)point, member);
    return error_value(error, key, rule, found);
}

static fram_status check_curve(const line_definition *d, fram_error *error)
{
    const line_curve *c = &d->curve;
    if (d->points < 2 || d->points > LINE_POINTS)
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "table", "expected 2 to %d points, found %d",
                         (int)LINE_POINTS, (int)d->points);
    for (int32_t i = 0; i < d->points; i++) {
        if (!isfinite(c->offset[i]) || (i > 0 && !(c->offset[i] > c->offset[i - 1])))
            return refuse_point(error, i, "offset", "more metres than in the point before", c->offset[i]);
        if (!isfinite(c->tension[i]) || c->tension[i] < 0 || (i > 0 && c->tension[i] < c->tension[i - 1]))
            return refuse_point(error, i, "tension", "newtons, no fewer than in the point before", c->tension[i]);
    }
    if (c->offset[0] > 0 || c->offset[d->points - 1] < 0)
        return refuse_point(error, 0, "offset", "points on both sides of the offset 0, which is that at the start",
                            c->offset[0]);
    if (!(d->breaking_load > 0))
        return error_value(error, "breaking_load", "a positive number of newtons", d->breaking_load);
    return FRAM_OK;
}

static fram_status check_line(const line_definition *d, double height, fram_error *error)
{
    if (!(height > 0))
        return error_value(error, "depth", "more than the depth of the upper end", d->depth);
    if (!(d->distance > 0))
        return error_value(error, "distance", "a positive number of metres", d->distance);
    if (d->kind == LINE_TABLE)
        return check_curve(d, error);
    if (!(d->stiffness > 0))
        return error_value(error, "stiffness", "a positive number of newtons", d->stiffness);
    if (d->kind == LINE_CATENARY && !(d->weight > 0))
        return error_value(error, "weight", "a positive number of newtons per metre", d->weight);
    if (!(d->breaking_load > 0))
        return error_value(error, "breaking_load", "a positive number of newtons", d->breaking_load);
    if (isnan(d->length) && !(d->pretension > 0))
        return error_value(error, "pretension", "a positive number of newtons where no length is given", d->pretension);
    if (!isnan(d->length) && !(d->length > 0))
        return error_value(error, "length", "a positive number of metres", d->length);
    return FRAM_OK;
}

/* Unstretched length from the pretension, where it is not given. */
static fram_status find_length(const line_definition *d, double height, double *length, fram_error *error)
{
    *length = d->length;
    if (d->kind == LINE_TABLE) {
        *length = d->distance;
        return FRAM_OK;
    }
    if (!isnan(d->length))
        return FRAM_OK;
    if (d->kind == LINE_SPRING) {
        *length = sqrt(height * height + d->distance * d->distance) - d->pretension / d->stiffness;
        if (*length > 0)
            return FRAM_OK;
        return error_value(error, "pretension", "less than the stiffness times the distance of the ends",
                           d->pretension);
    }
    const catenary_line line = {0, d->weight, d->stiffness};
    if (catenary_length_for(line, height, d->distance, d->pretension, length))
        return FRAM_OK;
    if (d->pretension > d->weight * height)
        return error_set(
            error, FRAM_ERROR_INPUT, NULL, 0, "pretension",
            "no line that weighs %g N/m in the water has a pretension of %g N over %g m: expected a heavier line, or "
            "its length instead of the pretension",
            d->weight, d->pretension, d->distance);
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "pretension",
                     "pretension must be more than the weight of the line over the depth, %s N, found %g N",
                     least_text_of(d->weight * height, 6).text, d->pretension);
}

fram_status mooring_add_line(context *ctx, const line_definition *d, const vessel_table *vessels,
                             const body_table *bodies, line_table *lines, fram_error *error)
{
    int32_t body = vessels->body[d->vessel];
    vec3 lead = vec3_make(real_cos(d->direction), real_sin(d->direction), 0);
    vec3 arm = vec3_scale(lead, d->fairlead_distance);
    vec3 fairlead = vec3_sub(d->centre, vessels->centre[d->vessel]);
    vec3 point = vec3_add(body_to_global(bodies, body, fairlead), arm);
    double height = point.z + d->depth, length;
    fram_status status = check_line(d, height, error);
    if (status == FRAM_OK)
        status = find_length(d, height, &length, error);
    if (status != FRAM_OK)
        return status;
    int32_t row = lines->count;
    if (!table_resize(ctx, lines, &line_table_info, row + 1))
        return error_memory(error);
    lines->vessel[row] = d->vessel;
    lines->kind[row] = (uint8_t)d->kind;
    lines->fairlead[row] = d->turret ? fairlead : body_to_local(bodies, body, point);
    lines->arm[row] = d->turret ? arm : vec3_make(0, 0, 0);
    vec3 anchor = vec3_mad(point, lead, d->distance);
    lines->anchor[row] = vec3_make(anchor.x, anchor.y, -d->depth);
    lines->length[row] = length;
    lines->weight[row] = d->weight;
    lines->stiffness[row] = d->kind == LINE_TABLE ? 0 : d->stiffness;
    lines->points[row] = d->kind == LINE_TABLE ? d->points : 0;
    lines->curve[row] = d->kind == LINE_TABLE ? d->curve : (line_curve){{0}, {0}};
    lines->breaking_load[row] = d->breaking_load;
    lines->release_time[row] = d->release_time;
    line_pull pull = mooring_line_pull(lines, row, bodies->position[body], bodies->orientation[body]);
    lines->horizontal[row] = pull.horizontal;
    lines->tension[row] = pull.tension;
    return FRAM_OK;
}

/* Tension of a curve of `points` points, two at least [N]. */
static double line_curve_tension(const line_curve *c, int32_t points, double offset)
{
    if (offset <= c->offset[0])
        return c->tension[0];
    int32_t i = 1;
    while (i + 1 < points && c->offset[i] < offset)
        i++;
    double slope = (c->tension[i] - c->tension[i - 1]) / (c->offset[i] - c->offset[i - 1]);
    return c->tension[i - 1] + slope * (offset - c->offset[i - 1]);
}

/* Springs, which go by the distance of their ends, and tables, which go by the horizontal one. */
static void straight_pull(const line_table *lines, int32_t row, vec3 gap, line_pull *pull)
{
    bool by_table = lines->kind[row] == LINE_TABLE;
    double distance = vec3_length(gap), aside = sqrt(gap.x * gap.x + gap.y * gap.y);
    double stretch = (by_table ? aside : distance) - lines->length[row];
    pull->tension = by_table ? line_curve_tension(&lines->curve[row], lines->points[row], stretch)
                             : lines->stiffness[row] * fmax(stretch, 0);
    if (!(distance > 0))
        return;
    pull->force = vec3_scale(gap, pull->tension / distance);
    pull->horizontal = sqrt(pull->force.x * pull->force.x + pull->force.y * pull->force.y);
}

static void hanging_pull(const line_table *lines, int32_t row, vec3 gap, line_pull *pull)
{
    const catenary_line line = {lines->length[row], lines->weight[row], lines->stiffness[row]};
    double distance = sqrt(gap.x * gap.x + gap.y * gap.y);
    catenary_pull p = catenary_solve(&line, -gap.z, distance, lines->horizontal[row]);
    double share = distance > 0 ? p.horizontal / distance : 0;
    pull->force = vec3_make(gap.x * share, gap.y * share, -p.vertical);
    pull->tension = catenary_tension(p);
    pull->horizontal = p.horizontal;
}

line_pull mooring_line_pull(const line_table *lines, int32_t row, vec3 position, quat orientation)
{
    vec3 at = vec3_add(position, mat3_mul_vec(quat_matrix(orientation), lines->fairlead[row]));
    line_pull pull = {.point = vec3_add(at, lines->arm[row])};
    if (lines->broken[row])
        return pull;
    vec3 gap = vec3_sub(lines->anchor[row], pull.point);
    if (lines->kind[row] != LINE_CATENARY)
        straight_pull(lines, row, gap, &pull);
    else
        hanging_pull(lines, row, gap, &pull);
    return pull;
}

/* About `position`.  A turret turns on its bearing until its lines leave no moment about the vertical on it: it hands
   the vessel none.  Its fairleads are taken to stay in their directions. */
static void add_pull(const line_table *lines, int32_t row, const line_pull *pull, vec3 position, wrench *sum)
{
    wrench_add(sum, position, pull->force, pull->point);
    sum->moment.z -= vec3_cross(lines->arm[row], pull->force).z;
}

wrench mooring_pull(const line_table *lines, int32_t vessel, vec3 position, quat orientation)
{
    wrench sum = {0};
    for (int32_t i = 0; i < lines->count; i++) {
        if (lines->vessel[i] != vessel)
            continue;
        line_pull pull = mooring_line_pull(lines, i, position, orientation);
        add_pull(lines, i, &pull, position, &sum);
    }
    return sum;
}

/* Whether the line parts now; the event is booked. */
static bool parts(context *ctx, line_table *lines, int32_t row, double time, double tension, event_table *events,
                  bool *good)
{
    station_event kind;
    /* A line that is let go does not part, however hard it would pull where the others hold the vessel. */
    if (time >= lines->release_time[row])
        kind = EVENT_LINE_RELEASE;
    else if (tension > lines->breaking_load[row])
        kind = EVENT_LINE_BREAK;
    else
        return false;
    /* The number of a line counts those of its own vessel. */
    int32_t number = 0;
    for (int32_t i = 0; i < row; i++)
        number += lines->vessel[i] == lines->vessel[row];
    *good = event_add(ctx, events, kind, time, lines->vessel[row], number, tension);
    lines->broken[row] = 1;
    lines->tension[row] = lines->horizontal[row] = 0;
    return true;
}

fram_status mooring_step(context *ctx, line_table *lines, const vessel_table *vessels, const body_table *bodies,
                         double time, wrench *loads, wrench *sum, event_table *events, fram_error *error)
{
    for (int32_t i = 0; i < lines->count; i++) {
        if (lines->broken[i])
            continue;
        int32_t vessel = lines->vessel[i], body = vessels->body[vessel];
        line_pull pull = mooring_line_pull(lines, i, bodies->position[body], bodies->orientation[body]);
        bool good = true, parted = parts(ctx, lines, i, time, pull.tension, events, &good);
        if (!good)
            return error_memory(error);
        if (parted)
            continue;
        lines->tension[i] = pull.tension;
        lines->horizontal[i] = pull.horizontal;
        add_pull(lines, i, &pull, bodies->position[body], &loads[body]);
        add_pull(lines, i, &pull, bodies->position[body], &sum[vessel]);
    }
    return FRAM_OK;
}

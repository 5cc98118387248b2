/* What a scenario must satisfy: the range of every key, and that keys go together.  All rules between keys stand here.
 */
#include "base/number_text.h"
#include "model/scenario_schema.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static fram_status fault(const scenario *s, fram_error *error, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

static fram_status fault(const scenario *s, fram_error *error, const char *key, const char *format, ...)
{
    char message[sizeof error->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    error_set(error, FRAM_ERROR_INPUT, NULL, 0, key, "%s", message);
    scenario_locate(s, error);
    return FRAM_ERROR_INPUT;
}

/* More tiles than this are a slip of the pen: a sheet of a million ship lengths squared. */
enum { MOST_TILES = 1000000 };

/* ---- ranges ---- */

static const char *unit_text(const scenario_key *key) { return strcmp(key->unit, "1") == 0 ? "" : key->unit; }

static fram_status check_number(const scenario *s, const scenario_key *key, const void *member, const char *path,
                                fram_error *error)
{
    double value = key_number(key, member);
    if (key->automatic && is_automatic(value))
        return FRAM_OK;
    if (value >= key->lo && value <= key->hi)
        return FRAM_OK;
    char lo[NUMBER_TEXT_SIZE], hi[NUMBER_TEXT_SIZE], found[NUMBER_TEXT_SIZE];
    real_to_text(key->lo, lo);
    real_to_text(key->hi, hi);
    real_to_text(value, found);
    const char *unit = unit_text(key);
    return fault(s, error, path, "expected %s%s from %s to %s%s%s, found %s", key->automatic ? "auto or " : "",
                 key->kind == KEY_INTEGER ? "an integer" : "a number", lo, hi, *unit ? " " : "", unit, found);
}

static fram_status check_range(void *user, const scenario_key *key, const void *member, const char *path,
                               fram_error *error)
{
    const scenario *s = user;
    size_t size;
    if (key->kind == KEY_REAL || key->kind == KEY_INTEGER)
        return check_number(s, key, member, path, error);
    if (key->kind == KEY_CHOICE && !choice_name(key, choice_value(member), &size))
        return fault(s, error, path, "expected one of %s, found value %d", key->text, (int)choice_value(member));
    if (key->kind == KEY_LIST && list_count(member) > (int32_t)key->hi)
        return fault(s, error, path, "expected at most %d items, found %d", (int)key->hi, (int)list_count(member));
    return FRAM_OK;
}

/* ---- keys that must go together ---- */

/* Two numbers of which the first must not exceed the second.  At fault is the one that was given, the first if both
 * were. */
static fram_status check_order(const scenario *s, const char *key, double value, const char *bound_key, double bound,
                               fram_error *error)
{
    if (value <= bound)
        return FRAM_OK;
    char found[NUMBER_TEXT_SIZE], limit[NUMBER_TEXT_SIZE];
    real_to_text(value, found);
    real_to_text(bound, limit);
    if (!scenario_given(s, key) && scenario_given(s, bound_key))
        return fault(s, error, bound_key, "expected at least %s, which is %s, found %s", key, found, limit);
    return fault(s, error, key, "expected at most %s, which is %s, found %s", bound_key, limit, found);
}

static fram_status check_run(const scenario *s, fram_error *error)
{
    const scenario_run *run = &s->run;
    fram_status status = check_order(s, "run.time_step", run->time_step, "run.duration", run->duration, error);
    if (status == FRAM_OK)
        status = check_order(s, "run.transient", run->transient, "run.duration", run->duration, error);
    return status;
}

/* An endless field is made from a law or from a file, and only it drifts. */
static fram_status check_feeding(const scenario *s, fram_error *error)
{
    const scenario_domain *d = &s->domain;
    if (d->boundary == DOMAIN_FEEDING) {
        if (s->ice.source == ICE_NONE || s->ice.source == ICE_FLOES || s->ice.source == ICE_LEVEL)
            return fault(s, error, "ice.source",
                         "expected a field that can go on without end, since domain.boundary is feeding, found %s",
                         s->ice.source == ICE_NONE    ? "none"
                         : s->ice.source == ICE_FLOES ? "floes"
                                                      : "level");
        return FRAM_OK;
    }
    if (d->drift_file[0])
        return fault(s, error, "domain.drift_file",
                     "expected nothing, since domain.boundary is not feeding, found %.200s", d->drift_file);
    if (!is_automatic(d->drift_speed))
        return fault(s, error, "domain.drift_speed",
                     "expected auto, since domain.boundary is not feeding, found %g m/s", d->drift_speed);
    return FRAM_OK;
}

static fram_status check_domain(const scenario *s, fram_error *error)
{
    const scenario_domain *d = &s->domain;
    if (d->x_min == d->x_max)
        return fault(s, error, "domain.x_max", "expected more than domain.x_min, found the same value");
    if (d->y_min == d->y_max)
        return fault(s, error, "domain.y_max", "expected more than domain.y_min, found the same value");
    fram_status status = check_order(s, "domain.x_min", d->x_min, "domain.x_max", d->x_max, error);
    if (status == FRAM_OK)
        status = check_order(s, "domain.y_min", d->y_min, "domain.y_max", d->y_max, error);
    return status == FRAM_OK ? check_feeding(s, error) : status;
}

static bool inside_domain(const scenario *s, double x, double y)
{
    return x >= s->domain.x_min && x <= s->domain.x_max && y >= s->domain.y_min && y <= s->domain.y_max;
}

/* A path is for what is driven, and its times go on. */
static fram_status check_path(const scenario *s, fram_error *error)
{
    const scenario_vessel *v = &s->vessel;
    if (v->mode == VESSEL_FREE && v->path.count > 0)
        return fault(s, error, "vessel.path", "expected none, since vessel.mode is free, found %d points",
                     (int)v->path.count);
    if (v->path.count == 1)
        return fault(s, error, "vessel.path", "expected two points at least, found 1");
    for (int32_t i = 1; i < v->path.count; i++) {
        char key[48];
        snprintf(key, sizeof key, "vessel.path[%d].time", (int)i);
        if (!(v->path.data[i].time > v->path.data[i - 1].time))
            return fault(s, error, key, "expected a later time than that of the point before");
    }
    return FRAM_OK;
}

/* A speed that is given must lie under the one at which a run is taken to have gone wrong. */
static fram_status check_speed(const scenario *s, const char *key, double speed, fram_error *error)
{
    if (speed < s->run.speed_limit)
        return FRAM_OK;
    return fault(s, error, key, "expected less than run.speed_limit, at which a run ends, %g m/s, found %g m/s",
                 s->run.speed_limit, speed);
}

static fram_status check_speeds(const scenario *s, fram_error *error)
{
    const scenario_vessel *v = &s->vessel;
    fram_status status = check_speed(s, "environment.current_speed", s->environment.current_speed, error);
    if (status == FRAM_OK && !is_automatic(s->domain.drift_speed))
        status = check_speed(s, "domain.drift_speed", s->domain.drift_speed, error);
    if (status == FRAM_OK && v->present && v->path.count == 0)
        status = check_speed(s, "vessel.speed", v->speed, error);
    for (int32_t i = 1; v->present && i < v->path.count && status == FRAM_OK; i++) {
        const scenario_path_point *a = &v->path.data[i - 1], *b = &v->path.data[i];
        double x = b->x - a->x, y = b->y - a->y;
        char key[48];
        snprintf(key, sizeof key, "vessel.path[%d].time", (int)i);
        status = check_speed(s, key, sqrt(x * x + y * y) / (b->time - a->time), error);
    }
    return status;
}

/* Mooring lines of one vessel, those of a count each: as many as the table of results has columns for. */
enum { MOST_LINES = 64 };

static fram_status check_line_count(const scenario *s, fram_error *error)
{
    const scenario_mooring_line_list *lines = &s->vessel.mooring.lines;
    int64_t all = 0;
    for (int32_t i = 0; i < lines->count; i++)
        all += lines->data[i].count;
    if (lines->count > 0 && !(s->vessel.mooring.z > -s->vessel.mooring.depth))
        return fault(s, error, "vessel.mooring.z", "expected fairleads above the bottom, which is at %g m, found %g m",
                     -s->vessel.mooring.depth, s->vessel.mooring.z);
    if (all <= MOST_LINES)
        return FRAM_OK;
    return fault(s, error, "vessel.mooring.lines", "expected at most %d lines in all, found %d", (int)MOST_LINES,
                 (int)all);
}

/* A line of kind table has one table, others have none. */
static fram_status check_line_tables(const scenario *s, fram_error *error)
{
    for (int32_t i = 0; i < s->vessel.mooring.lines.count; i++) {
        const scenario_mooring_line *l = &s->vessel.mooring.lines.data[i];
        char key[64];
        snprintf(key, sizeof key, "vessel.mooring.lines[%d].table", (int)i);
        bool given = l->table.count > 0 || l->table_file[0];
        if (l->kind == LINE_TABLE && !given)
            return fault(s, error, key, "expected points or a table_file, since kind is table, found neither");
        if (l->kind != LINE_TABLE && given)
            return fault(s, error, key, "expected neither points nor a table_file, since kind is not table");
        if (l->table.count > 0 && l->table_file[0])
            return fault(s, error, key, "expected points or a table_file, found both");
    }
    return FRAM_OK;
}

/* Lines, thrusters and positioning act on a vessel that is free, and positioning needs thrusters. */
static fram_status check_station(const scenario *s, fram_error *error)
{
    const scenario_vessel *v = &s->vessel;
    bool held = v->mode != VESSEL_FREE;
    if (held && v->mooring.lines.count > 0)
        return fault(s, error, "vessel.mooring.lines", "expected none, since vessel.mode is not free, found %d",
                     (int)v->mooring.lines.count);
    if (held && v->thrusters.count > 0)
        return fault(s, error, "vessel.thrusters", "expected none, since vessel.mode is not free, found %d",
                     (int)v->thrusters.count);
    if (v->positioning.active && v->thrusters.count == 0)
        return fault(s, error, "vessel.thrusters",
                     "expected thrusters, since vessel.positioning.active is true, found none");
    for (int32_t i = 1; i < v->positioning.waypoints.count; i++) {
        if (v->positioning.waypoints.data[i].time > v->positioning.waypoints.data[i - 1].time)
            continue;
        char key[64];
        snprintf(key, sizeof key, "vessel.positioning.waypoints[%d].time", (int)i);
        return fault(s, error, key, "expected a later time than that of the way point before");
    }
    fram_status status = check_line_count(s, error);
    if (status == FRAM_OK)
        status = check_line_tables(s, error);
    return status == FRAM_OK ? check_path(s, error) : status;
}

static fram_status check_vessel(const scenario *s, fram_error *error)
{
    const scenario_vessel *v = &s->vessel;
    if (!v->present)
        return FRAM_OK;
    if (v->hull.form == HULL_MESH && !v->hull.file[0])
        return fault(s, error, "vessel.hull.file",
                     "expected the path of a mesh, since vessel.hull.form is file, found nothing");
    if (v->hull.form != HULL_MESH && v->hull.file[0])
        return fault(s, error, "vessel.hull.file", "expected nothing, since vessel.hull.form is not file, found \"%s\"",
                     v->hull.file);
    fram_status status = check_station(s, error);
    if (status != FRAM_OK)
        return status;
    if (s->domain.boundary == DOMAIN_WALLS && !inside_domain(s, v->x, v->y))
        return fault(s, error, "vessel.x",
                     "expected vessel.x and vessel.y inside the walls of the domain, found a place outside");
    return FRAM_OK;
}

static fram_status check_friction(const scenario *s, fram_error *error)
{
    const scenario_friction *f = &s->ice.friction;
    fram_status status = check_order(s, "ice.friction.ice_ice_kinetic", f->ice_ice_kinetic,
                                     "ice.friction.ice_ice_static", f->ice_ice_static, error);
    if (status == FRAM_OK)
        status = check_order(s, "ice.friction.ice_hull_kinetic", f->ice_hull_kinetic, "ice.friction.ice_hull_static",
                             f->ice_hull_static, error);
    if (status == FRAM_OK)
        status = check_order(s, "ice.friction.ice_wall_kinetic", f->ice_wall_kinetic, "ice.friction.ice_wall_static",
                             f->ice_wall_static, error);
    return status;
}

static fram_status check_field(const scenario *s, fram_error *error)
{
    const scenario_ice *ice = &s->ice;
    const scenario_domain *d = &s->domain;
    double area = (d->x_max - d->x_min) * (d->y_max - d->y_min);
    fram_status status =
        check_order(s, "ice.mean_floe_area", ice->mean_floe_area, "the area of the domain", area, error);
    if (status == FRAM_OK)
        status = check_order(s, "ice.smallest_floe_area", ice->smallest_floe_area, "ice.mean_floe_area",
                             ice->mean_floe_area, error);
    return status;
}

static fram_status check_floes(const scenario *s, fram_error *error)
{
    for (int32_t i = 0; i < s->ice.floes.count; i++) {
        const scenario_floe *floe = &s->ice.floes.data[i];
        if (inside_domain(s, floe->x, floe->y))
            continue;
        char key[32];
        snprintf(key, sizeof key, "ice.floes[%d].x", (int)i);
        return fault(s, error, key, "expected the centre (x, y) of the floe inside the domain, found a place outside");
    }
    return FRAM_OK;
}

static fram_status check_level(const scenario *s, fram_error *error)
{
    const scenario_level *l = &s->ice.level;
    if (s->ice.source != ICE_LEVEL) {
        if (l->openings.count == 0)
            return FRAM_OK;
        return fault(s, error, "ice.level.openings", "expected none, since ice.source is not level, found %d",
                     (int)l->openings.count);
    }
    double x_min = automatic_or(l->x_min, s->domain.x_min), x_max = automatic_or(l->x_max, s->domain.x_max);
    double y_min = automatic_or(l->y_min, s->domain.y_min), y_max = automatic_or(l->y_max, s->domain.y_max);
    if (!(x_min < x_max))
        return fault(s, error, "ice.level.x_max", "expected more than ice.level.x_min, %g, found %g", x_min, x_max);
    if (!(y_min < y_max))
        return fault(s, error, "ice.level.y_max", "expected more than ice.level.y_min, %g, found %g", y_min, y_max);
    double size = automatic_or(l->tile_size, x_max - x_min);
    if ((x_max - x_min) / size * ((y_max - y_min) / size) > MOST_TILES)
        return fault(s, error, "ice.level.tile_size",
                     "expected tiles so large that the sheet has no more than %d, found %g m", MOST_TILES, size);
    return FRAM_OK;
}

static fram_status population_fault(const scenario *s, int32_t number, const char *member, const char *expected,
                                    fram_error *error)
{
    char key[64];
    snprintf(key, sizeof key, "ice.populations[%d].%s", (int)number, member);
    return fault(s, error, key, "%s", expected);
}

static fram_status check_population(const scenario *s, int32_t number, fram_error *error)
{
    const scenario_population *p = &s->ice.populations.data[number];
    bool ranged = p->size == SIZE_UNIFORM || p->size == SIZE_LOGNORMAL || p->size == SIZE_POWER;
    if (ranged && p->diameter_max < p->diameter_min)
        return population_fault(s, number, "diameter_max", "expected at least diameter_min", error);
    if (p->vertices_max < p->vertices_min)
        return population_fault(s, number, "vertices_max", "expected at least vertices_min", error);
    if ((p->size == SIZE_HISTOGRAM) != (p->histogram[0] != '\0'))
        return population_fault(s, number, "histogram",
                                "expected the path of a CSV file with size histogram, nothing with others", error);
    if ((p->shape == POPULATION_TEMPLATES) != (p->templates[0] != '\0'))
        return population_fault(s, number, "templates",
                                "expected the path of a file of outlines with shape templates, nothing with others",
                                error);
    return FRAM_OK;
}

/* Floes are drawn for a packed field, and for what a file leaves open. */
static fram_status check_populations(const scenario *s, fram_error *error)
{
    const scenario_ice *ice = &s->ice;
    if (ice->source == ICE_PACKED && ice->populations.count == 0)
        return fault(s, error, "ice.populations", "expected at least one population, since ice.source is packed");
    bool managed = ice->source == ICE_VORONOI;
    if (ice->source != ICE_PACKED && ice->source != ICE_FILE && !managed && ice->populations.count > 0)
        return fault(s, error, "ice.populations",
                     "expected none, since ice.source is not packed, file or voronoi, found %d",
                     (int)ice->populations.count);
    if (managed && ice->populations.count > 1)
        return fault(s, error, "ice.populations", "expected one at most, since ice.source is voronoi, found %d",
                     (int)ice->populations.count);
    if (managed && ice->populations.count > 0 && ice->populations.data[0].shape == POPULATION_TEMPLATES)
        return population_fault(s, 0, "shape", "expected convex: with ice.source voronoi the cells are the shapes",
                                error);
    if (ice->populations.count > 0 && s->domain.boundary == DOMAIN_FEEDING && ice->source == ICE_FILE)
        return fault(s, error, "ice.populations", "expected none, since domain.boundary is feeding");
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < ice->populations.count && status == FRAM_OK; i++)
        status = check_population(s, i, error);
    return status;
}

static fram_status check_ice(const scenario *s, fram_error *error)
{
    const scenario_ice *ice = &s->ice;
    bool listed = ice->source == ICE_FLOES;
    if (listed && ice->floes.count == 0)
        return fault(s, error, "ice.floes", "expected at least one floe, since ice.source is floes, found none");
    if (!listed && ice->floes.count > 0)
        return fault(s, error, "ice.floes", "expected no floes, since ice.source is not floes, found %d",
                     (int)ice->floes.count);
    if (ice->source == ICE_FILE && !ice->file[0])
        return fault(s, error, "ice.file", "expected the path of a file of floes, since ice.source is file");
    if (ice->source != ICE_FILE && ice->file[0])
        return fault(s, error, "ice.file", "expected no file, since ice.source is not file, found %.200s", ice->file);
    bool filled = ice->source == ICE_VORONOI || ice->source == ICE_FILE || ice->source == ICE_PACKED;
    if (!filled && ice->open_water.count > 0)
        return fault(s, error, "ice.open_water",
                     "expected none, since ice.source is not voronoi, file or packed, found %d",
                     (int)ice->open_water.count);
    if (!filled && ice->open_water_file[0])
        return fault(s, error, "ice.open_water_file",
                     "expected no file, since ice.source is not voronoi, file or packed, found %.200s",
                     ice->open_water_file);
    fram_status status = check_friction(s, error);
    if (status == FRAM_OK)
        status = check_populations(s, error);
    if (status == FRAM_OK && ice->source == ICE_VORONOI)
        status = check_field(s, error);
    if (status == FRAM_OK)
        status = check_floes(s, error);
    if (status == FRAM_OK)
        status = check_level(s, error);
    if (status != FRAM_OK || ice->source == ICE_NONE || !s->environment.water)
        return status;
    if (ice->density < s->environment.water_density)
        return FRAM_OK;
    char found[NUMBER_TEXT_SIZE];
    real_to_text(ice->density, found);
    return fault(s, error, "ice.density", "expected less than environment.water_density, so that ice floats, found %s",
                 found);
}

static fram_status check_rows(const scenario *s, const char *key, int32_t count, fram_error *error)
{
    if (count == 0 || count == 6)
        return FRAM_OK;
    return fault(s, error, key, "expected 6 rows (surge, sway, heave, roll, pitch, yaw) or none, found %d", (int)count);
}

static fram_status check_hydrodynamics(const scenario *s, fram_error *error)
{
    const scenario_hydrodynamics *h = &s->vessel.hydrodynamics;
    fram_status status = check_rows(s, "vessel.hydrodynamics.added_mass", h->added_mass.count, error);
    return status == FRAM_OK ? check_rows(s, "vessel.hydrodynamics.damping", h->damping.count, error) : status;
}

fram_status scenario_check(const scenario *s, fram_error *error)
{
    fram_status status = scenario_walk(s, check_range, (void *)s, error);
    if (status == FRAM_OK)
        status = check_run(s, error);
    if (status == FRAM_OK)
        status = check_domain(s, error);
    if (status == FRAM_OK)
        status = check_vessel(s, error);
    if (status == FRAM_OK)
        status = check_hydrodynamics(s, error);
    if (status == FRAM_OK)
        status = check_speeds(s, error);
    if (status == FRAM_OK)
        status = check_ice(s, error);
    return status;
}

/* What a scenario must satisfy: the range of every key, and that keys go together.  All rules between keys stand here.
 */
#include "base/number_text.h"
#include "ice/tiles.h"
#include "model/scenario_check_vessels.h"
#include "model/scenario_schema.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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
    return scenario_fault(s, error, path, "expected %s%s from %s to %s%s%s, found %s", key->automatic ? "auto or " : "",
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
        return scenario_fault(s, error, path, "expected one of %s, found value %d", key->text,
                              (int)choice_value(member));
    if (key->kind == KEY_LIST && list_count(member) > (int32_t)key->hi)
        return scenario_fault(s, error, path, "expected at most %d items, found %d", (int)key->hi,
                              (int)list_count(member));
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
        return scenario_fault(s, error, bound_key, "expected at least %s, which is %s, found %s", key, found, limit);
    return scenario_fault(s, error, key, "expected at most %s, which is %s, found %s", bound_key, limit, found);
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
        if (s->ice.source == ICE_NONE || s->ice.source == ICE_FLOES)
            return scenario_fault(
                s, error, "ice.source",
                "expected a field that can go on without end, since domain.boundary is feeding, found %s",
                s->ice.source == ICE_NONE ? "none" : "floes");
        if (d->drift_file[0] && !is_automatic(d->drift_speed))
            return scenario_fault(s, error, "domain.drift_speed",
                                  "expected auto, since domain.drift_file tells it, found %g m/s", d->drift_speed);
        double narrow = fmin(d->x_max - d->x_min, d->y_max - d->y_min);
        if (s->ice.source != ICE_LEVEL && 2 * automatic_or(d->band, 0) >= narrow)
            return scenario_fault(s, error, "domain.band", "expected less than half of the domain, %s m, found %g m",
                                  most_text_of(0.5 * narrow, 6).text, d->band);
        return FRAM_OK;
    }
    if (d->drift_file[0])
        return scenario_fault(s, error, "domain.drift_file",
                              "expected nothing, since domain.boundary is not feeding, found %.200s", d->drift_file);
    if (!is_automatic(d->drift_speed))
        return scenario_fault(s, error, "domain.drift_speed",
                              "expected auto, since domain.boundary is not feeding, found %g m/s", d->drift_speed);
    return FRAM_OK;
}

static fram_status check_domain(const scenario *s, fram_error *error)
{
    const scenario_domain *d = &s->domain;
    if (d->x_min == d->x_max)
        return scenario_fault(s, error, "domain.x_max", "expected more than domain.x_min, found the same value");
    if (d->y_min == d->y_max)
        return scenario_fault(s, error, "domain.y_max", "expected more than domain.y_min, found the same value");
    fram_status status = check_order(s, "domain.x_min", d->x_min, "domain.x_max", d->x_max, error);
    if (status == FRAM_OK)
        status = check_order(s, "domain.y_min", d->y_min, "domain.y_max", d->y_max, error);
    return status == FRAM_OK ? check_feeding(s, error) : status;
}

/* A speed that is given must lie under the one at which a run is taken to have gone wrong. */
static fram_status check_speed(const scenario *s, const char *key, double speed, fram_error *error)
{
    if (speed < s->run.speed_limit)
        return FRAM_OK;
    return scenario_fault(s, error, key,
                          "expected less than run.speed_limit, at which a run ends, %g m/s, found %g m/s",
                          s->run.speed_limit, speed);
}

static fram_status check_speeds(const scenario *s, fram_error *error)
{
    fram_status status = check_speed(s, "environment.current_speed", s->environment.current_speed, error);
    if (status == FRAM_OK && !is_automatic(s->domain.drift_speed))
        status = check_speed(s, "domain.drift_speed", s->domain.drift_speed, error);
    return status;
}

static fram_status check_floe_speed(const scenario *s, int32_t number, fram_error *error)
{
    const scenario_floe *f = &s->ice.floes.data[number];
    const double v[3] = {f->velocity_x, f->velocity_y, f->velocity_z};
    double speed = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    double reach = f->shape == FLOE_REGULAR ? f->radius : 0.5 * sqrt(f->length * f->length + f->width * f->width);
    int most = fabs(v[1]) > fabs(v[0]);
    most = fabs(v[2]) > fabs(v[most]) ? 2 : most;
    char key[40];
    snprintf(key, sizeof key, "ice.floes[%d].velocity_%c", (int)number, "xyz"[most]);
    if (!(speed < s->run.speed_limit))
        return scenario_fault(
            s, error, key,
            "expected a floe that moves at less than run.speed_limit, at which a run ends, %g m/s, found %g "
            "m/s",
            s->run.speed_limit, speed);
    if (fabs(f->spin) * reach < s->run.speed_limit)
        return FRAM_OK;
    snprintf(key, sizeof key, "ice.floes[%d].spin", (int)number);
    return scenario_fault(
        s, error, key,
        "expected a turn at less than run.speed_limit, at which a run ends, %g m/s, found %g m/s at %g m from "
        "the centre of the floe",
        s->run.speed_limit, fabs(f->spin) * reach, reach);
}

/* The rim of a floe that turns keeps under that speed too. */
static fram_status check_floe_speeds(const scenario *s, fram_error *error)
{
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < s->ice.floes.count && status == FRAM_OK; i++)
        if (!s->ice.floes.data[i].fixed)
            status = check_floe_speed(s, i, error);
    return status;
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
    if (status == FRAM_OK)
        status = check_order(s, "ice.friction.hull_hull_kinetic", f->hull_hull_kinetic, "ice.friction.hull_hull_static",
                             f->hull_hull_static, error);
    if (status == FRAM_OK)
        status = check_order(s, "ice.friction.hull_wall_kinetic", f->hull_wall_kinetic, "ice.friction.hull_wall_static",
                             f->hull_wall_static, error);
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

static fram_status check_floe_places(const scenario *s, fram_error *error)
{
    for (int32_t i = 0; i < s->ice.floes.count; i++) {
        const scenario_floe *floe = &s->ice.floes.data[i];
        if (domain_has(&s->domain, floe->x, floe->y))
            continue;
        char key[32];
        snprintf(key, sizeof key, "ice.floes[%d].x", (int)i);
        return scenario_fault(s, error, key,
                              "expected the centre (x, y) of the floe inside the domain, found a place outside");
    }
    return FRAM_OK;
}

/* What only a sheet that drifts has, and what it has not. */
static fram_status check_sheet_drift(const scenario *s, fram_error *error)
{
    const scenario_level *l = &s->ice.level;
    bool drifts = s->ice.source == ICE_LEVEL && s->domain.boundary == DOMAIN_FEEDING;
    const char *key[SHEET_SIDES] = {"ice.level.anchored_x_min", "ice.level.anchored_x_max", "ice.level.anchored_y_min",
                                    "ice.level.anchored_y_max"};
    const bool held[SHEET_SIDES] = {l->anchored_x_min, l->anchored_x_max, l->anchored_y_min, l->anchored_y_max};
    if (!drifts && !is_automatic(l->line_load))
        return scenario_fault(
            s, error, "ice.level.line_load",
            "expected auto, since the sheet does not drift (ice.source level with domain.boundary feeding), "
            "found %g N/m",
            l->line_load);
    if (is_automatic(l->line_load) && !is_automatic(l->mass))
        return scenario_fault(
            s, error, "ice.level.mass",
            "expected auto, since without ice.level.line_load the sheet drifts whatever it meets, found %g kg",
            l->mass);
    for (int i = 0; drifts && i < SHEET_SIDES; i++)
        if (!held[i])
            return scenario_fault(
                s, error, key[i],
                "expected true, since a sheet that drifts goes on beyond the domain; its own edges are "
                "ice.level.x_min and so on");
    return FRAM_OK;
}

static fram_status check_level(const scenario *s, fram_error *error)
{
    const scenario_level *l = &s->ice.level;
    fram_status status = check_sheet_drift(s, error);
    if (status != FRAM_OK)
        return status;
    if (s->ice.source != ICE_LEVEL) {
        if (l->openings.count == 0)
            return FRAM_OK;
        return scenario_fault(s, error, "ice.level.openings", "expected none, since ice.source is not level, found %d",
                              (int)l->openings.count);
    }
    double x_min = automatic_or(l->x_min, s->domain.x_min), x_max = automatic_or(l->x_max, s->domain.x_max);
    double y_min = automatic_or(l->y_min, s->domain.y_min), y_max = automatic_or(l->y_max, s->domain.y_max);
    if (s->domain.boundary == DOMAIN_FEEDING) {
        /* An edge may lie outside the domain at the start, and a sheet may have no edge on one side. */
        x_min = is_automatic(l->x_max) ? automatic_or(l->x_min, s->domain.x_min) : automatic_or(l->x_min, -HUGE_VAL);
        x_max = automatic_or(l->x_max, HUGE_VAL);
        y_min = is_automatic(l->y_max) ? automatic_or(l->y_min, s->domain.y_min) : automatic_or(l->y_min, -HUGE_VAL);
        y_max = automatic_or(l->y_max, HUGE_VAL);
    }
    if (!(x_min < x_max))
        return scenario_fault(s, error, "ice.level.x_max", "expected more than ice.level.x_min, %g, found %g", x_min,
                              x_max);
    if (!(y_min < y_max))
        return scenario_fault(s, error, "ice.level.y_max", "expected more than ice.level.y_min, %g, found %g", y_min,
                              y_max);
    if (s->domain.boundary == DOMAIN_FEEDING) {
        x_min = s->domain.x_min, x_max = s->domain.x_max;
        y_min = s->domain.y_min, y_max = s->domain.y_max;
    }
    bool held = l->anchored_x_min || l->anchored_x_max || l->anchored_y_min || l->anchored_y_max;
    if (!held && s->domain.boundary != DOMAIN_FEEDING)
        return scenario_fault(
            s, error, "ice.level.anchored_x_min",
            "expected a sheet that is held at one of its edges at least, found none: ice that nothing holds is "
            "a floe (ice.source floes), or drifts through (domain.boundary feeding)");
    double size = automatic_or(l->tile_size, x_max - x_min);
    if ((x_max - x_min) / size * ((y_max - y_min) / size) > MOST_TILES)
        return scenario_fault(s, error, "ice.level.tile_size",
                              "expected tiles so large that the sheet has no more than %d, found %g m", MOST_TILES,
                              size);
    return FRAM_OK;
}

static fram_status population_fault(const scenario *s, int32_t number, const char *member, const char *expected,
                                    fram_error *error)
{
    char key[64];
    snprintf(key, sizeof key, "ice.populations[%d].%s", (int)number, member);
    return scenario_fault(s, error, key, "%s", expected);
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
        return scenario_fault(s, error, "ice.populations",
                              "expected at least one population, since ice.source is packed");
    bool managed = ice->source == ICE_VORONOI;
    if (!scenario_ice_is_field(ice) && ice->populations.count > 0)
        return scenario_fault(s, error, "ice.populations",
                              "expected none, since ice.source is not packed, file or voronoi, found %d",
                              (int)ice->populations.count);
    if (managed && ice->populations.count > 1)
        return scenario_fault(s, error, "ice.populations",
                              "expected one at most, since ice.source is voronoi, found %d",
                              (int)ice->populations.count);
    if (managed && ice->populations.count > 0 && ice->populations.data[0].shape == POPULATION_TEMPLATES)
        return population_fault(s, 0, "shape", "expected convex: with ice.source voronoi the cells are the shapes",
                                error);
    if (ice->populations.count > 0 && s->domain.boundary == DOMAIN_FEEDING && ice->source == ICE_FILE)
        return scenario_fault(s, error, "ice.populations", "expected none, since domain.boundary is feeding");
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < ice->populations.count && status == FRAM_OK; i++)
        status = check_population(s, i, error);
    return status;
}

/* Between floes that are drawn some water stays. */
static fram_status check_concentration(const scenario *s, fram_error *error)
{
    const scenario_ice *ice = &s->ice;
    if (!scenario_ice_is_drawn(ice) || ice->concentration < 1)
        return FRAM_OK;
    return scenario_fault(s, error, "ice.concentration",
                          "expected less than 1, since floes that are drawn have water between them (a whole sheet is "
                          "ice.source level), found %g",
                          ice->concentration);
}

static fram_status check_water(const scenario *s, fram_error *error)
{
    if (s->environment.floe_ventilation && !s->environment.water)
        return scenario_fault(s, error, "environment.floe_ventilation",
                              "expected false, since environment.water is false");
    return FRAM_OK;
}

static fram_status check_ice(const scenario *s, fram_error *error)
{
    const scenario_ice *ice = &s->ice;
    bool listed = ice->source == ICE_FLOES;
    if (listed && ice->floes.count == 0)
        return scenario_fault(s, error, "ice.floes",
                              "expected at least one floe, since ice.source is floes, found none");
    if (!listed && ice->floes.count > 0)
        return scenario_fault(s, error, "ice.floes", "expected no floes, since ice.source is not floes, found %d",
                              (int)ice->floes.count);
    if (ice->source == ICE_FILE && !ice->file[0])
        return scenario_fault(s, error, "ice.file", "expected the path of a file of floes, since ice.source is file");
    if (ice->source == ICE_FILE && ice->file_coordinates == FILE_DEGREES && ice->file_scale != 1)
        return scenario_fault(s, error, "ice.file_scale",
                              "expected 1, since ice.file_coordinates is degrees, which are no lengths, found %g",
                              ice->file_scale);
    if (ice->source != ICE_FILE && ice->file[0])
        return scenario_fault(s, error, "ice.file", "expected no file, since ice.source is not file, found %.200s",
                              ice->file);
    bool field = scenario_ice_is_field(ice);
    if (!field && ice->open_water.count > 0)
        return scenario_fault(s, error, "ice.open_water",
                              "expected none, since ice.source is not voronoi, file or packed, found %d",
                              (int)ice->open_water.count);
    if (!field && ice->open_water_file[0])
        return scenario_fault(s, error, "ice.open_water_file",
                              "expected no file, since ice.source is not voronoi, file or packed, found %.200s",
                              ice->open_water_file);
    bool fed = s->domain.boundary == DOMAIN_FEEDING;
    if (ice->sleep_speed > 0 && fed && (ice->source != ICE_LEVEL || isfinite(ice->level.line_load)))
        return scenario_fault(
            s, error, "ice.sleep_speed",
            "expected 0, since domain.boundary is feeding and the ice no sheet whose drift is given: what "
            "drifts otherwise does not rest, found %g m/s",
            ice->sleep_speed);
    fram_status status = check_friction(s, error);
    if (status == FRAM_OK)
        status = check_populations(s, error);
    if (status == FRAM_OK)
        status = check_concentration(s, error);
    if (status == FRAM_OK && ice->source == ICE_VORONOI && ice->populations.count == 0)
        status = check_field(s, error);
    if (status == FRAM_OK)
        status = check_floe_places(s, error);
    if (status == FRAM_OK)
        status = check_floe_speeds(s, error);
    if (status == FRAM_OK)
        status = check_level(s, error);
    if (status != FRAM_OK || ice->source == ICE_NONE || !s->environment.water)
        return status;
    if (ice->density < s->environment.water_density)
        return FRAM_OK;
    char found[NUMBER_TEXT_SIZE];
    real_to_text(ice->density, found);
    return scenario_fault(s, error, "ice.density",
                          "expected less than environment.water_density, so that ice floats, found %s", found);
}

fram_status scenario_check(const scenario *s, fram_error *error)
{
    fram_status status = scenario_walk(s, check_range, (void *)s, error);
    if (status == FRAM_OK)
        status = check_run(s, error);
    if (status == FRAM_OK)
        status = check_domain(s, error);
    if (status == FRAM_OK)
        status = scenario_check_vessels(s, error);
    if (status == FRAM_OK)
        status = check_speeds(s, error);
    if (status == FRAM_OK)
        status = check_water(s, error);
    if (status == FRAM_OK)
        status = check_ice(s, error);
    return status;
}

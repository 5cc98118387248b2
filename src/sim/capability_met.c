/* The scenario of a capability plot with ice that runs of ice management left before a vessel. */
#include "sim/capability.h"

#include <string.h>

/* What the measured ice takes the place of: given over the scenario, it would go unheard. */
static const char *const replaced[] = {
    "ice.source",      "ice.concentration",   "ice.thickness", "ice.populations", "ice.mean_floe_area", "ice.roundness",
    "ice.open_water",  "ice.open_water_file", "domain.x_min",  "domain.x_max",    "domain.y_min",       "domain.y_max",
    "domain.boundary", "domain.band",         "domain.tile_x", "domain.tile_y"};

/* Whether a key is another one or lies in that, which is a list. */
static bool is_of(const char *key, const char *other)
{
    size_t n = strlen(other);
    return strncmp(key, other, n) == 0 && (key[n] == '\0' || key[n] == '[' || key[n] == '.');
}

static fram_status refuse_overrides(const scenario *s, fram_error *error)
{
    for (size_t i = 0; i < sizeof replaced / sizeof *replaced; i++)
        for (int32_t k = 0; k < s->places.count; k++)
            if (s->places.data[k].override && is_of(s->places.data[k].key, replaced[i]))
                return error_set(
                    error, FRAM_ERROR_USAGE, SCENARIO_OVERRIDE, 0, replaced[i],
                    "expected no override, since the ice and its window are those of the runs: leave it out, or "
                    "make runs with it");
    return FRAM_OK;
}

fram_status capability_met_scenario(const scenario *s, const capability_met_ice *met, double side,
                                    scenario_population *population, const size_law *sizes, scenario *out,
                                    fram_error *error)
{
    fram_status status = refuse_overrides(s, error);
    if (status != FRAM_OK)
        return status;
    scenario usual;
    scenario_defaults(&usual, s->run.scale);
    *out = *s;
    out->sizes = sizes;
    scenario_ice *ice = &out->ice;
    ice->source = ICE_VORONOI;
    ice->concentration = met->law.concentration;
    ice->thickness = met->law.thickness;
    ice->roundness = usual.ice.roundness;
    ice->open_water.count = 0;
    ice->open_water_file[0] = '\0';
    *population = (scenario_population){.share = 1,
                                        .size = SIZE_HISTOGRAM,
                                        .shape = POPULATION_CONVEX,
                                        .thickness = (double)NAN,
                                        .flexural_strength = (double)NAN,
                                        .crushing_strength = (double)NAN,
                                        .breakable = true};
    ice->populations = (scenario_population_list){.data = population, .count = 1};
    double half = 0.5 * side;
    scenario_domain *d = &out->domain;
    d->boundary = DOMAIN_FEEDING;
    d->x_min = s->vessel.x - half;
    d->x_max = s->vessel.x + half;
    d->y_min = s->vessel.y - half;
    d->y_max = s->vessel.y + half;
    d->tile_x = d->tile_y = d->band = (double)NAN;
    return FRAM_OK;
}

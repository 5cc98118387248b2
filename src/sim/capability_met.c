/* The scenario of a capability plot with ice that runs of ice management left before a vessel. */
#include "sim/capability.h"

/* What the measured ice takes the place of: given over the scenario, it would go unheard. */
static const char *const replaced[] = {"ice.source",         "ice.concentration", "ice.thickness", "ice.populations",
                                       "ice.mean_floe_area", "domain.x_min",      "domain.x_max",  "domain.y_min",
                                       "domain.y_max",       "domain.boundary"};

static fram_status refuse_overrides(const scenario *s, fram_error *error)
{
    for (size_t i = 0; i < sizeof replaced / sizeof *replaced; i++) {
        const scenario_place *place = scenario_given(s, replaced[i]);
        if (place && place->override)
            return error_set(
                error, FRAM_ERROR_USAGE, SCENARIO_OVERRIDE, 0, replaced[i],
                "expected no override, since the ice and its window are those of the runs: leave it out, or "
                "make runs with it");
    }
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

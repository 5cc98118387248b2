/* Floes drawn from the populations of a scenario, in places where none overlap. */
#ifndef SIM_BUILD_PACKED_H
#define SIM_BUILD_PACKED_H

#include "sim/draw_ice.h"

/* The law of size that the keys of a population tell; a histogram is in its file, and has no bins here. */
size_law population_size_law(const scenario_population *p);

/* Part of the mean floe, or of all floes, from which on what is left out is ice that was asked for. */
#define POPULATION_LEFT_OUT 0.1
/* Of the least area [m2], its diameter [m], the part that has less, the population's number and run.scale. */
#define POPULATION_LAW_CUT                                                                                    \
    "ice.smallest_floe_area: %.4g m2, %.3g m across, leaves out %.2g of the floes that the law of size of "   \
    "ice.populations[%d] asks for, and those that are made are larger than it says; give a smaller area, or " \
    "the run.scale (%g) by which it is found"

/* A generator of fields names the member of its own request: the key that it came from, with its place. */
void name_ice_request(const scenario *s, fram_error *error);

/* Mean area of the floes of ice.populations, which are there, by their shares of the ice [m2]; reads the files of their
   histograms. */
fram_status population_mean_area(context *ctx, const scenario *s, double *area, fram_error *error);

/* Packs floes of ice.populations to ice.concentration around the keep-out zones and around the outlines that are there
   already; appends to outlines and traits, fills shapes, parts and reports.  FRAM_ERROR_INPUT, with place, for files
   that cannot be read and for a concentration that cannot be reached. */
fram_status draw_populations(context *ctx, const scenario *s, world *w, const polygon_list *keep_out, drawn_ice *out,
                             fram_error *error);

/* Managed ice of the sizes, thickness and strength of the one population of ice.populations; the rest as `request`
   says, whose law of size is of no account.  Fills outlines, traits, parts and report. */
fram_status draw_managed(context *ctx, const scenario *s, world *w, field_request request, drawn_ice *out,
                         fram_error *error);

#endif

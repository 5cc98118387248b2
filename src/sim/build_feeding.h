/* The ice of a world, fed or not. */
#ifndef SIM_BUILD_FEEDING_H
#define SIM_BUILD_FEEDING_H

#include "ice/field.h"
#include "model/scenario.h"
#include "model/world.h"

/* The scenario's ice (build_ice.h); with domain.boundary feeding, its field fills a tile, and the domain is a window on
   the endless field of such tiles.  The report is then that of the tile.  Errors name the key where it is not ice. */
fram_status build_field(context *ctx, const scenario *s, const model *m, world *w, field_report *report,
                        fram_error *error);

/* The mean floe of a field that is fed, by which its tile is found where the scenario does not say [m2]: of the
   populations, whose histograms are read, or ice.mean_floe_area. */
fram_status feeding_floe_area(context *ctx, const scenario *s, double *area, fram_error *error);
/* What building the field of such a tile refuses, of floes that are drawn: tile, window and band that do not go
   together, a vessel in the band.  w: the world with its vessels. */
fram_status feeding_outlines_check(context *ctx, const scenario *s, const model *m, const world *w, double floe_area,
                                   const polygon_list *outlines, fram_error *error);
/* What is refused before there is ice: a vessel in a band that the scenario gives. */
fram_status feeding_place_check(context *ctx, const scenario *s, const model *m, const world *w, fram_error *error);
/* The scenario whose domain is the tile of one that is fed. */
scenario feeding_scenario(const scenario *s, double floe_area);

#endif

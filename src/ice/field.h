/* Generation of ice fields (SPEC 3): outlines in the plane, seeded, the same to the bit for the same seed on any number of threads. */
#ifndef ICE_FIELD_H
#define ICE_FIELD_H

#include "geometry/overlay.h"

typedef struct field_request {
    box2 domain;              /* [m] */
    double concentration;     /* target, ice area / free area, 0..1 */
    double mean_area;         /* Voronoi: mean cell area before shrinking [m2] */
    double size_deviation;    /* Voronoi: relative scatter of sites, 0 regular .. 1 random */
    double roundness;         /* Voronoi: 0 sharp corners .. 1 corners cut as far as the concentration allows */
    uint64_t seed;
    double smallest_area;     /* floes under it are not made [m2] */
    const polygon_list *keep_out; /* convex zones that stay free of ice; may be NULL */
    double keep_out_margin;   /* [m] */
} field_request;

typedef struct field_report {
    int32_t floes;
    double concentration;   /* achieved, of the domain less the keep-out zones */
    double free_area;       /* [m2] */
    double largest_overlap; /* [m] */
} field_report;

/* Voronoi cells of managed ice, cut by the keep-out zones and shrunk towards their centroids to the target concentration.
   FRAM_ERROR_INPUT when the target cannot be reached, saying what was reached and why. */
fram_status field_voronoi(context *ctx, overlay *o, const field_request *request, polygon_list *outlines,
                          field_report *report, fram_error *error);

#endif

/* Packed fields: floes of one or several populations, drawn by size and shape before and independently of
   where they go, then brought to places where none overlap, around what is already there.  Same request, same bits.
   Knows outlines only. */
#ifndef ICE_FIELD_PACK_H
#define ICE_FIELD_PACK_H

#include "ice/field.h"
#include "ice/field_shape.h"
#include "ice/field_size.h"

/* Floes of one kind. */
typedef struct field_population {
    double share; /* of the drawn ice area; any common factor */
    size_law size;
    shape_law shape;
} field_population;

typedef struct field_packed_request {
    box2 domain;                 /* [m] */
    bool periodic_x, periodic_y; /* the field continues beyond the edge with itself; otherwise it ends there */
    double concentration;        /* target, ice area / free area, over 0 and under 1 */
    const field_population *populations;
    int32_t population_count;
    uint64_t seed;
    const polygon_list *keep_out; /* convex zones that stay free of ice; may be NULL */
    double keep_out_margin;       /* the zones are grown by it all around [m] */
    const polygon_list *present;  /* simple outlines of floes that are there already and stay; may be NULL */
    double effort;                /* see packing.h; 0: 1 */
} field_packed_request;

/* A floe before it had a place. */
typedef struct field_floe {
    int32_t population; /* from 0 */
    int32_t vertices;
    double area; /* [m2] */
} field_floe;
typedef ARRAY(field_floe) field_floe_array;

/* What came of it, for each population. */
typedef struct field_population_report {
    int32_t floes;
    double area;          /* [m2] */
    double size_distance; /* Kolmogorov and Smirnov's, of the outlines' equivalent diameters from the law */
    size_histogram sizes; /* of the equivalent diameters */
} field_population_report;

typedef struct field_packed_report {
    field_report field;
    int32_t rounds, moves;  /* of the packing */
    double area_change;     /* largest relative change of a floe's area by being moved: rounding */
    int32_t vertex_changes; /* floes whose number of vertices changed: 0 */
} field_packed_report;

/* Appends outlines in the order of the populations, and to `floes` what each was drawn as.  parts (of population_count)
   and report are filled.  The floes that were present are counted in the concentration, not appended.
   FRAM_ERROR_INPUT for a request that is wrong or cannot be met, saying what was reached and why; outlines and
   floes are then unchanged. */
fram_status field_packed(context *ctx, overlay *o, const field_packed_request *request, polygon_list *outlines,
                         field_floe_array *floes, field_population_report *parts, field_packed_report *report,
                         fram_error *error);

/* Measured on the outlines: all of them, or with `drawn` those of population `number`.  false: no memory. */
bool field_population_measure(context *ctx, const size_law *law, const polygon_list *floes, const field_floe *drawn,
                              int32_t number, field_population_report *out);

#endif

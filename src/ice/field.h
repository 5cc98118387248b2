/* Generation of ice fields: outlines in the plane, seeded, the same to the bit for the same seed on any number
   of threads.  Knows outlines only: thickness, strength and bodies come later (ice/floe.h). */
#ifndef ICE_FIELD_H
#define ICE_FIELD_H

#include "geometry/overlay.h"
#include "ice/field_size.h"

/* Random streams of this room (base/random.h); the numbers are part of what a seed means and never change. */
enum { ICE_STREAM_VORONOI_SITE = 0x1ce00 };

typedef struct field_request {
    box2 domain;          /* [m] */
    double concentration; /* target, ice area / free area, over 0 and under 1 */
    const size_law *size; /* Voronoi: of the floes, by diameter of the disc of their area; NULL: as mean_area says */
    double mean_area;     /* Voronoi without a law: mean cell area before shrinking [m2] */
    double
        size_deviation; /* Voronoi: relative scatter of sites, 0 regular (hexagons) .. 1 anywhere in their grid cell */
    double roundness;   /* Voronoi: 0 sharp corners .. 1 corners cut as far as the concentration allows */
    uint64_t seed;
    double smallest_area;         /* floes under it are not made [m2] */
    const polygon_list *keep_out; /* convex zones that stay free of ice; may be NULL */
    double keep_out_margin;       /* the zones are grown by it all around [m] */
    bool periodic; /* Voronoi: the field repeats itself seamlessly beyond the domain, whose edge floes may reach over */
} field_request;

typedef struct field_report {
    int32_t floes;
    double concentration;   /* achieved: measured on the outlines, of the free area */
    double free_area;       /* domain less the grown keep-out zones [m2] */
    double largest_overlap; /* measured over all pairs of outlines; 0 when none overlap [m] */
    double gap;             /* width of the open water between neighbours [m] */
} field_report;

/* Managed ice: Voronoi cells, cut by the keep-out zones, every edge moved inwards by half the same gap until the summed
   area meets the target (to rounding).  A gap of one width is how broken ice drifts apart; shrinking towards centroids
   would put wide water around large floes and leave small ones stuck together.  With a law of size the cells are those
   of a power diagram (ice/field_sized.h), and floes follow it where no zone cuts them.  All outlines are convex and
   counter-clockwise, stay clear of each other, of the domain's edge (by half a gap) and of the zones; floes come in the
   order of their sites. Appends to outlines, which is unchanged on failure.  FRAM_ERROR_INPUT when the target cannot be
   reached, saying what was reached and why. */
fram_status field_voronoi(context *ctx, const field_request *request, polygon_list *outlines, field_report *report,
                          fram_error *error);

#endif

/* Hulls that the tests of vessel share. */
#ifndef VESSEL_SAMPLES_H
#define VESSEL_SAMPLES_H

#include "base/transcendental.h"
#include "testing.h"
#include "vessel/vessel.h"

static const hull_particulars box_particulars = {
    .form = HULL_BOX, .length = 40, .beam = 12, .draught = 4, .freeboard = 3};

/* An icebreaker as in the scenario's defaults, but with a short bow. */
static inline hull_particulars icebreaker_particulars(void)
{
    return (hull_particulars){.form = HULL_ICEBREAKER,
                              .length = 100,
                              .beam = 20,
                              .draught = 7,
                              .freeboard = 4,
                              .stem_angle = radians(30),
                              .entrance_angle = radians(35),
                              .flare_angle = radians(8),
                              .stern_angle = radians(40),
                              .parallel_midbody = 0.45};
}

static inline void free_hull(context *ctx, mesh *surface, polyhedron_array *pieces)
{
    mesh_free(ctx, surface);
    polyhedron_array_free(ctx, pieces);
}

#endif

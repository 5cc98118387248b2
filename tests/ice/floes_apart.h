/* That the convex floes of a field lie apart. */
#ifndef FLOES_APART_H
#define FLOES_APART_H

#include "ice/field_measure.h"
#include "testing.h"

static inline void assert_apart(context *ctx, const polygon_list *floes)
{
    double overlap = -1;
    fram_error e = {0};
    assert_ok(field_largest_overlap(ctx, NULL, floes, NULL, &overlap, &e), e);
    assert_bits(overlap, 0);
}

#endif

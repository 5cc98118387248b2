/* A hull whose making is refused memory at each place in turn: nothing is lost, and the failure is told. */
#ifndef HULL_MEMORY_H
#define HULL_MEMORY_H

#include "testing.h"
#include "vessel/hull.h"

static inline void hull_make_without_memory(hull_particulars given)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        hull_particulars p = given;
        hull_particulars_fill(&p);
        mesh surface = {0};
        polyhedron_array pieces = {0};
        turn.status = hull_make(&turn.ctx, &p, &surface, &pieces, &turn.error);
        polyhedron_array_free(&turn.ctx, &pieces);
        mesh_free(&turn.ctx, &surface);
    }
}

#endif

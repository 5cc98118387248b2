/* A hull whose making is refused memory at each place in turn: nothing is lost, and the failure is told. */
#ifndef HULL_MEMORY_H
#define HULL_MEMORY_H

#include "testing.h"
#include "vessel/hull.h"

static inline void hull_make_without_memory(hull_particulars given)
{
    for (long n = 1;; n++) {
        failing_memory memory;
        context ctx = failing_context(&memory, n);
        fram_error error = {0};
        hull_particulars p = given;
        hull_particulars_fill(&p);
        mesh surface = {0};
        polyhedron_array pieces = {0};
        fram_status status = hull_make(&ctx, &p, &surface, &pieces, &error);
        polyhedron_array_free(&ctx, &pieces);
        mesh_free(&ctx, &surface);
        ck_assert_int_eq(memory.live, 0);
        if (!memory.failed) {
            ck_assert_int_eq(status, FRAM_OK);
            break;
        }
        ck_assert_int_eq(status, FRAM_ERROR_MEMORY);
    }
}

#endif

/* The column water of groups of eight bodies.  Inside fluid. One module with columns, which lays out what it works on.
 */
#ifndef FLUID_COLUMNS_KERNEL_H
#define FLUID_COLUMNS_KERNEL_H

#include "base/kernel.h"
#include "fluid/columns.h"

/* Groups first..end-1. */
KERNEL_DECLARE(void, column_groups,
               (const column_water *w, const body_table *bodies, int32_t first, int32_t end, wrench *loads));

#endif

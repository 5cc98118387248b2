/* What the files of the import share, inside ice/import*.c. One module with import, whose inside this is. */
#ifndef ICE_IMPORT_PARTS_H
#define ICE_IMPORT_PARTS_H

#include "ice/import.h"

/* Two outlines, a < b, that have more in common than rounding. */
typedef struct import_pair {
    int32_t a, b;
    double area; /* in common [m2] */
} import_pair;
typedef ARRAY(import_pair) import_pair_array;

/* All such pairs, ordered by a, then b.  name: of the outlines' file, or NULL.  FRAM_ERROR_INPUT for a crowd
 * (ice/crowd.h). */
fram_status import_pairs(context *ctx, const char *name, const polygon_list *outlines, import_pair_array *out,
                         fram_error *error);

/* Whether a ring crosses itself so often that it is no outline to be repaired.  FRAM_ERROR_MEMORY, FRAM_INTERRUPTED. */
fram_status import_crosses_too_often(context *ctx, polygon p, bool *too_often, fram_error *error);

/* Whether floes are a tile that repeats itself beyond options->domain, as options->tile says: none overlaps another or
   a copy of one. */
fram_status import_fits_tile(context *ctx, const import_options *options, const polygon_list *floes, bool *fits,
                             fram_error *error);

/* What two floes have in common goes to the smaller one (of equal ones to the first): the larger is cut, and noted.
   Cut pieces under the smallest area and slivers are left out. */
fram_status import_cut_overlaps(context *ctx, overlay *o, const import_options *options, import_field *field,
                                fram_error *error);

#endif

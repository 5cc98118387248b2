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

/* How often a ring meets itself. */
typedef struct import_meetings {
    int64_t corners;   /* pairs of corners at one place */
    int64_t elsewhere; /* edges that cross, and corners on an edge */
} import_meetings;

/* Counts them, on to where they are too many where not all are of corners.  No vertex of p is the one before.
   FRAM_ERROR_MEMORY, FRAM_INTERRUPTED. */
fram_status import_count_meetings(context *ctx, polygon p, import_meetings *out, fram_error *error);
/* Whether overlay_make_valid would take more than some ten seconds for a ring, in which nobody can stop it. */
bool import_meets_too_often(polygon p, const import_meetings *met);
/* What overlay_make_valid would append to out, for a ring that meets itself at common corners alone; cut: false, and
   nothing was appended, where it crosses itself there.  FRAM_ERROR_MEMORY, FRAM_INTERRUPTED. */
fram_status import_cut_at_corners(context *ctx, polygon p, polygon_list *out, bool *cut, fram_error *error);

/* Whether floes are a tile that repeats itself beyond options->domain, as options->tile says: none overlaps another or
   a copy of one. */
fram_status import_fits_tile(context *ctx, const import_options *options, const polygon_list *floes, bool *fits,
                             fram_error *error);

/* What two floes have in common goes to the smaller one (of equal ones to the first): the larger is cut, and noted.
   Cut pieces under the smallest area and slivers are left out. */
fram_status import_cut_overlaps(context *ctx, overlay *o, const import_options *options, import_field *field,
                                fram_error *error);

#endif

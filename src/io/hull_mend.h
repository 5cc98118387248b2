/* One attempt to make a sound solid of a file's triangles, inside io: scaled,
   sealed, given topsides, repaired, checked. Must not know which attempts are
   made, or what is said about them. One module with hull_file, which asks for the mending. */
#ifndef IO_HULL_MEND_H
#define IO_HULL_MEND_H

#include "io/hull_file.h"
#include "io/hull_top.h"

/* The widest seal that is tried for a remedy, as a part of the longest side: what is wider is no crack. */
#define HULL_WIDEST_SEAL (1.0 / 100)

/* A file, and what is asked of it. */
typedef struct hull_request {
    context *ctx;
    const char *name;
    const mesh_file *file;
    hull_file_options options;
} hull_request;

/* How one attempt ended. */
typedef struct hull_outcome {
    mesh surface; /* sound, or empty */
    hull_file_report report;
    fram_error error;
    mesh_defect defect; /* for which the surface was refused; MESH_EMPTY for any
                           other reason */
    bool one_sided;     /* it was refused because it has one side only */
    hull_half half;     /* half a hull, or a quarter */
    hull_ending end;    /* where a hole that was filled is no hole but the end of the hull, about the water plane or a
                        centre plane that it does not cross: what is missing there are topsides, or its other half */
} hull_outcome;

/* Seal cracks up to seal_width [m], take corners that are off the plane of an open top by `level` [m] for level, fill
   holes where that is asked for, and the rest as the options say.  What the outcome held is dropped; the file stays as
   it is.  FRAM_ERROR_INPUT without advice, FRAM_ERROR_MEMORY. */
fram_status hull_mend(const hull_request *q, double seal_width, double level, bool fill, hull_outcome *out);

/* How many triangles whoever reads a GDF takes for lids of the water plane, and leaves out.  false: no memory. */
bool hull_count_lids(context *ctx, const mesh *m, int32_t *count);

#endif

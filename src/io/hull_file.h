/* Hulls from mesh files: read, sealed, given topsides, repaired if asked, and checked; what comes out is a sound solid
   in the file's own frame, metres.  Knows the conventions of the formats; must not know how a hull is used. */
#ifndef IO_HULL_FILE_H
#define IO_HULL_FILE_H

#include "geometry/mesh_repair.h"
#include "io/hull_skin.h"
#include "io/mesh_file.h"

/* What may be done to the surface.  A NaN leaves the number to Fram. */
typedef struct hull_file_options {
    double scale;      /* lengths of the file times this are metres; > 0 */
    double seal_width; /* cracks up to this are sealed [m]; 0: none; NaN: a two-thousandth of the longest side */
    bool repair;       /* fill holes, turn triangles, leave out those without area */
    double freeboard;  /* a level open top is raised by this and decked [m]; NaN: as the next says */
    /* A hull that ends at the water is raised by this and decked [m], and one that ends above it is decked there.  NaN:
       so are GDF files alone, which end at the waterline by convention, and are raised by a third of their depth; tops
       of others stay open. */
    double usual_freeboard;
} hull_file_options;
hull_file_options hull_file_defaults(void);

/* What was found and done. */
typedef struct hull_file_report {
    mesh_format format;
    int32_t elements, dropped; /* of the file; dropped: triangles without area */
    bool mirror_x, mirror_y;
    int32_t lids; /* GDF: triangles in the water plane, which are left out */
    double seal_width;
    mesh_seal_report seal;
    double freeboard;    /* of the topsides that were added, 0 without [m] */
    double top;          /* z of an open top above the water, before it was raised; 0: there was none [m] */
    double decked;       /* of an open top that was closed where it is, 0 without [m2] */
    int32_t holes;       /* filled on request */
    double hole_area;    /* [m2] */
    int32_t flipped;     /* triangles turned on request */
    int32_t inner_parts; /* closed parts inside the hull, left out: tanks, the inner face of a plating */
    double inner_volume; /* by which the hull encloses more without them [m3] */
    hull_half half;      /* it was half a hull, or a quarter, and was closed there on request */
    double well;         /* part of what the waterline goes round that is a hole in it (hull_skin.h) */
} hull_file_report;

/* A well of more than this: an open boat, plating without a deck.  Moonpools are smaller. */
#define OPEN_BOAT 0.5

/* FRAM_ERROR_INPUT with line and element of the file where the surface is no sound solid, and what would help;
   FRAM_ERROR_IO, FRAM_ERROR_MEMORY.  surface must be empty; on failure it still is. */
fram_status hull_file_read(context *ctx, const char *path, const hull_file_options *options, mesh *surface,
                           hull_file_report *report, fram_error *error);
/* The same for a file that is parsed already (it is emptied). */
fram_status hull_file_finish(context *ctx, const char *name, mesh_file *file, const hull_file_options *options,
                             mesh *surface, hull_file_report *report, fram_error *error);
/* Write a hull as mesh_file_write does, in its own z; of a GDF, warn of what programs of panel methods do not take. */
fram_status hull_file_write(context *ctx, const char *path, const mesh *surface, fram_error *error);

#endif

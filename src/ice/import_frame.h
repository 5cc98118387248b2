/* From the coordinates of a file to metres in the domain: scaled and moved, or projected from longitude and latitude.
   One module with import. */
#ifndef ICE_IMPORT_FRAME_H
#define ICE_IMPORT_FRAME_H

#include "geometry/geographic.h"
#include "ice/import.h"

typedef struct import_frame {
    bool degrees;
    double scale;
    stereographic projection;
    vec2 shift; /* added in the end [m] */
} import_frame;

/* FRAM_ERROR_INPUT, naming the first ring at fault, for planar coordinates that are plainly degrees, degrees that are
   none, and a field too wide to be laid flat.  Degrees that have ice where there is none, and have not with latitude
   first, are warned of. */
fram_status import_frame_make(context *ctx, const import_rings *rings, const import_options *o, import_frame *out,
                              fram_error *error);
vec2 import_frame_place(const import_frame *f, vec2 position);

#endif

/* Tracks of an icebreaker that manages ice for another vessel: closed lines, or one without end, in a frame whose first
   axis points updrift from a place that stays, and whose second is to the left of it.  Pure geometry. */
#ifndef VESSEL_PATTERN_H
#define VESSEL_PATTERN_H

#include "base/vec.h"

typedef enum pattern_kind {
    PATTERN_NONE = 0,
    PATTERN_LINE,   /* updrift and back, `width` long, from `distance` on with its turn */
    PATTERN_ACROSS, /* to and fro across the drift, `width` long, `distance` updrift */
    PATTERN_CIRCLE, /* of diameter `width` about a centre `distance` updrift, counter-clockwise */
    PATTERN_SQUARE, /* of side `width` about that centre, counter-clockwise */
    PATTERN_SECTOR, /* to and fro on an arc of radius `distance` about the place, `width` long */
    PATTERN_AHEAD   /* straight on, without end */
} pattern_kind;

typedef struct pattern_shape {
    pattern_kind kind;
    double distance, width; /* [m] */
    double aside;           /* all of it is moved so far to the left [m] */
} pattern_shape;

#endif

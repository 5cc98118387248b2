/* Plan views: polygons seen from above with water, scale bar, north of the global frame (Y up) and a caption, as PNG.
 */
#ifndef IO_PLAN_VIEW_H
#define IO_PLAN_VIEW_H

#include "geometry/polygon.h"

typedef enum plan_style {
    PLAN_FLOE = 0,
    PLAN_LEVEL_ICE,
    PLAN_FIXED_ICE,
    PLAN_WALL,
    PLAN_DECK,
    PLAN_WATERLINE,
    PLAN_STYLE_COUNT
} plan_style;

typedef struct plan_shape {
    polygon outline; /* global plan coordinates [m] */
    plan_style style;
} plan_shape;

typedef struct plan_view {
    box2 window; /* shown part [m] */
    const char *title;
    const char *caption;      /* second line: time, counts */
    const plan_shape *shapes; /* drawn in order */
    int32_t shape_count;
    const vec2 *track; /* path of the vessel [m] */
    int32_t track_count;
} plan_view;

/* `longest`: pixels of the longer side.  FRAM_ERROR_UNSUPPORTED without cairo. */
fram_status plan_view_write(context *ctx, const plan_view *view, const char *path, int longest, fram_error *error);

#endif

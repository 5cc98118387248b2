/* Plan views: polygons seen from above with water, scale bar, the axes of the global frame (X to the right, Y up) and a
   caption, as PNG or SVG. */
#ifndef IO_PLAN_VIEW_H
#define IO_PLAN_VIEW_H

#include "base/vec.h"
#include "geometry/polygon.h"
#include "io/text_buffer.h"

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
    polygon outline; /* global plan coordinates; of a prism half way between its faces [m] */
    vec2 drop;       /* plan way from the upper face of a prism to its lower one: its sides are seen; 0: none [m] */
    double height;   /* of what covers others, or is covered [m] */
    plan_style style;
    int32_t owner;  /* of a part of a hull: the row of its vessel */
    bool has_value; /* filled by `value`, 0 to 1, on the colours of image_ramp instead of its style's colour */
    float value;
} plan_shape;

/* drop and height of a prism of this thickness. */
void plan_shape_stand(plan_shape *s, vec3 position, quat orientation, double thickness);
/* By ascending height, so that what floats is drawn over what lies under it; ties by style, so that the tiles of level
   ice follow each other, and by the place of their vertices, which are all in one array. */
void plan_shapes_sort(plan_shape *shapes, int32_t count);
/* The window that shows a vessel: the usual one where something of a hull is in it, or there is none.  Else it is
   larger by as much as takes in all hulls, or, where they are so far that little would be told apart, as large, with
   the hull of the first vessel in its middle, all parts of it.  Its sides are to each other as those of the usual one.
   Shapes in any order. */
box2 plan_window(box2 usual, const plan_shape *shapes, int32_t count);

typedef struct plan_arrow {
    vec2 from, to;
} plan_arrow;

/* A mooring line: from its upper end to its anchor [m]. */
typedef struct plan_line {
    vec2 upper, anchor;
} plan_line;

/* What has no outline to be drawn: a disc with its name beside it. */
typedef struct plan_label {
    vec2 at;
    float value; /* 0 to 1, on the colours of image_ramp */
    char text[32];
    bool bare; /* a name without a disc */
} plan_label;

/* What moves over the whole of a plan: an arrow beside the title, with its name and speed. */
typedef struct plan_flow {
    const char *name;
    vec2 velocity; /* [m/s] */
} plan_flow;

typedef struct plan_view {
    box2 window; /* shown part [m] */
    const char *title;
    const char *caption;      /* second line: time, counts */
    const plan_shape *shapes; /* drawn in order */
    int32_t shape_count;
    const vec2 *track; /* path of the vessel [m] */
    int32_t track_count;
    const vec2 *marks; /* of events: crosses [m] */
    int32_t mark_count;
    const plan_arrow *arrows; /* of forces [m] */
    int32_t arrow_count;
    const plan_label *labels;
    int32_t label_count;
    const plan_line *lines; /* of a mooring */
    int32_t line_count;
    const plan_flow *flows;
    int32_t flow_count;
    bool no_axes;           /* X and Y of the global frame are not those of the shapes */
    double arrow_scale;     /* of the arrows, told beside the scale bar [m/N]; 0: not told */
    const char *scale_name; /* of the shapes' values, with unit; NULL: none */
    double scale_lo, scale_hi;
    const char *unscaled_name; /* beside the scale: what level ice without a value is; NULL: it is not named */
} plan_view;

/* What a legend is to name: of what something lies in the window. */
typedef struct plan_used {
    bool style[PLAN_STYLE_COUNT], line; /* mooring lines */
} plan_used;
plan_used plan_find_used(const plan_view *view);

/* `longest`: pixels of the longer side.  SVG when the path ends in .svg, else PNG.  FRAM_ERROR_UNSUPPORTED without
   cairo. */
fram_status plan_view_write(context *ctx, const plan_view *view, const char *path, int longest, fram_error *error);

/* The same as PNG in memory, appended to out. */
fram_status plan_view_png(context *ctx, const plan_view *view, int longest, text_buffer *out, fram_error *error);

#ifdef FRAM_HAVE_CAIRO
#include <cairo.h>
/* Colours of values from lo to hi with their name, ending at `right`, on a line of text at y; not before
   `left`, for which the bar gets shorter, and then the name goes to the next line. */
void plan_view_colour_scale(cairo_t *page, const char *name, double lo, double hi, double left, double right, double y);
/* Into the rectangle of width x height pixels from the origin of a page, title and legend included. */
void plan_view_draw(cairo_t *page, const plan_view *view, int width, int height);
#endif

#endif

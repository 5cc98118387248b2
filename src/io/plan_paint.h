/* Inside plan_view: where its places lie on a page, and how its shapes are painted.  One module with plan_view.h. */
#ifndef IO_PLAN_PAINT_H
#define IO_PLAN_PAINT_H

#include "io/image.h"
#include "io/plan_view.h"

#ifdef FRAM_HAVE_CAIRO

typedef struct plan_look {
    image_colour fill, line;
    const char *name;
} plan_look;
extern const plan_look plan_looks[PLAN_STYLE_COUNT];

typedef struct plan_map {
    double left, top, scale; /* pixels; pixels per metre */
    box2 window;
} plan_map;
double plan_map_x(const plan_map *m, vec2 p);
double plan_map_y(const plan_map *m, vec2 p);
void plan_line_to(cairo_t *page, const plan_map *m, vec2 p);

/* In order. */
void plan_paint_shapes(cairo_t *page, const plan_map *m, const plan_shape *shapes, int32_t count);

#endif

#endif

/* Inside hull_panels: facets before they are joined to panels.  One module with hull_panels.h. */
#ifndef VESSEL_HULL_PANELS_PARTS_H
#define VESSEL_HULL_PANELS_PARTS_H

#include "vessel/hull_panels.h"

/* Where lines run across a patch, in one direction: planes of a ship coordinate, dot(axis, x). */
typedef struct panel_ruler {
    vec3 axis;
    double size;        /* between them, one of them at 0 [m] */
    const double *line; /* NULL: every `size` */
    int32_t count;
} panel_ruler;
/* Number of the cell of a coordinate; where a cell begins, -HUGE_VAL without a line there. */
int32_t ruler_cell(const panel_ruler *r, double at);
double ruler_begin(const panel_ruler *r, int32_t cell);

/* A piece of a triangle in one cell, on the way. */
typedef struct raw_facet {
    int32_t patch, column, row, face, first, count;
    double area;
    int32_t root; /* of the facets that are one panel */
} raw_facet;
typedef ARRAY(raw_facet) raw_facet_array;

typedef struct panel_work {
    context *ctx;
    const mesh *hull;
    const panel_rules *rules;
    mesh_adjacency adjacency;
    int32_array patch_of;     /* by face */
    ARRAY(panel_ruler) ruler; /* two a patch */
    raw_facet_array facet;
    ARRAY(vec3) corner;
    int32_array first_of_face; /* places in by_face, one more than faces */
    int32_array by_face;       /* facets by face */
} panel_work;

static inline int32_t facet_root(panel_work *w, int32_t i)
{
    raw_facet *f = w->facet.data;
    while (f[i].root != i)
        i = f[i].root = f[f[i].root].root;
    return i;
}

/* Facets of one cell that meet along an edge of the mesh get one root; then slivers join their neighbours. */
fram_status panels_connect(panel_work *w, fram_error *error);
fram_status panels_join_slivers(panel_work *w, fram_error *error);

#endif

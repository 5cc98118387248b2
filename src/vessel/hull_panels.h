/* The surface of a hull in panels: what pressures are averaged over.  Each point of the surface belongs to one panel,
   whatever the hull's form: flat bows, several hulls beside each other, moonpools.  Knows a mesh in ship coordinates;
   no ice, no time, no files.

   How panels come about.  Triangles are sorted by the side that they face most (port, starboard, bow, stern, bottom,
   deck); connected triangles of a side, up to knuckles of 20 degrees, are a patch.  A patch is cut by sections and
   waterlines (bow and stern by buttocks and waterlines, bottom and deck by sections and buttocks) so far apart that
   cells of a plane of its mean normal have the area of the chosen size squared, sloping or not; where the patch turns
   by more than 60 degrees from the mean, of a plane that faces its side.  One line lies at amidships, at the design
   waterline and at the centre line.  The connected pieces of a patch in a cell are its panels; slivers join the
   neighbour with which they share most of their border.

   Frames and stringers of one's own take the place of grid lines: frames are planes of x on all but bow and stern,
   stringers planes of z on all but bottom and deck. */
#ifndef VESSEL_HULL_PANELS_H
#define VESSEL_HULL_PANELS_H

#include "geometry/mesh_bvh.h"

typedef enum hull_side {
    SIDE_PORT = 0,
    SIDE_STARBOARD,
    SIDE_BOW,
    SIDE_STERN,
    SIDE_BOTTOM,
    SIDE_DECK,
    SIDE_COUNT
} hull_side;
/* "port"; of a side. */
const char *hull_side_name(hull_side side);

/* Lines are ascending; none: the grid's. */
typedef struct panel_rules {
    double size; /* side of a panel [m] */
    const double *frame, *stringer;
    int32_t frame_count, stringer_count;
} panel_rules;

typedef struct hull_panel {
    uint8_t side;        /* enum hull_side, of its patch */
    int32_t patch, part; /* number of the patch; of several panels in one cell */
    int32_t column, row; /* of the grid: along x (bow and stern: y), up z (bottom and deck: y) */
    double area;         /* of the surface [m2] */
    vec3 centre, normal; /* centroid; unit, mean over the area; ship coordinates */
    box3 bounds;
} hull_panel;

/* A convex piece of a triangle. */
typedef struct panel_facet {
    int32_t panel, face, first, count; /* face of the hull's mesh; corners */
} panel_facet;

typedef struct panel_patch {
    uint8_t side;
    vec3 normal; /* unit, that its cells are measured by */
} panel_patch;

typedef struct hull_panels {
    ARRAY(hull_panel) panel;
    ARRAY(panel_facet) facet; /* by panel */
    ARRAY(vec3) corner;
    ARRAY(panel_patch) patch;
    /* To find the panel of a point: the facets as triangles. */
    mesh triangle;
    int32_array triangle_panel;
    mesh_bvh tree;
    box3 bounds;       /* of the triangles */
    int32_t last_face; /* found last: where the next search begins */
} hull_panels;

/* The panels of a closed mesh without degenerate triangles.  out need not be initialised; it is empty on failure.
   FRAM_ERROR_INPUT, key "panel": a size that is not above nothing, is longer than the hull, or makes more than
   PANEL_MOST panels; key "frames" or "stringers": lines that do not ascend or are not finite. */
enum { PANEL_MOST = 200000 };
fram_status hull_panels_make(context *ctx, const mesh *hull, const panel_rules *rules, hull_panels *out,
                             fram_error *error);
void hull_panels_free(context *ctx, hull_panels *p);

/* The panel whose surface is nearest to a point, of those that look along `outward` (within about 70 degrees; all where
   there is none such nearby); for a point that lies beside all of these what stands round their border, if anything
   does. -1 only for no panels. */
int32_t hull_panel_at(hull_panels *p, vec3 point, vec3 outward);

#endif

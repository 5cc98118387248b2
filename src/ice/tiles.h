/* Level ice (docs/decisions/0040): an intact sheet, held as static floes that are the tiles of a grid, so that an event
   touches only the tiles that its crack reaches.  Between two tiles of neighbouring cells runs a seam, which is neither
   boundary nor crack; what a tile has on its cell's sides and shares with no neighbour is boundary, as is the sheet's
   outer edge.  Tiles stand level and unturned, at rest or
   carried along together.  Knows floes; must not know loads. */
#ifndef ICE_TILES_H
#define ICE_TILES_H

#include "ice/floe.h"

typedef enum sheet_side { SHEET_X_MIN = 0, SHEET_X_MAX, SHEET_Y_MIN, SHEET_Y_MAX, SHEET_SIDES } sheet_side;

/* The sheet's grid.  That of a sheet that is held is given once and never changed; that of one that drifts
   (ice/drift.h) is a window on cells without end, which goes with the sheet. */
typedef struct tile_grid {
    box2 plan;                  /* the sheet's rectangle, global [m] */
    int32_t columns, rows;      /* cells along x and y; 0: there is no sheet */
    bool anchored[SHEET_SIDES]; /* what no longer hangs on one of these sides drifts */
    double least_seam;          /* a shorter common edge holds nothing together [m] */
    bool drifts;
    vec2 origin;         /* drifts: where line 0 of the cells stood at the start, global [m] */
    vec2 pitch;          /* drifts: size of a cell [m] */
    vec2 moved;          /* drifts: way of the sheet since [m] */
    int64_t column, row; /* drifts: number of the first column and row of the window */
} tile_grid;

/* A grid over a rectangle, its cells near `size` [m]. */
tile_grid tile_grid_over(box2 plan, double size);
/* The rectangle of a grid that drifts, from its lines. */
box2 tile_grid_plan(const tile_grid *g);
/* The cell of column i and row k is i + k columns. */
box2 tile_cell(const tile_grid *g, int32_t cell);
/* Whether a segment lies on a side of the sheet that is held: ice goes on beyond it. */
bool tile_grid_is_held(const tile_grid *g, vec2 a, vec2 b);
/* Columns and rows that a box reaches into, clamped to the grid; false when it lies outside. */
typedef struct tile_range {
    int32_t column_first, column_last, row_first, row_last;
} tile_range;
bool tile_range_of(const tile_grid *g, box2 box, tile_range *range);

/* The sheet less its openings (simple rings), cell by cell: outlines are appended, and the cell of each to `cells`.
   Pieces under `smallest` [m2] are left out. */
fram_status tile_sheet(context *ctx, const tile_grid *g, overlay *plane, const polygon_list *openings, double smallest,
                       polygon_list *outlines, int32_array *cells, fram_error *error);

/* The same for one cell. */
fram_status tile_cell_rings(context *ctx, const tile_grid *g, int32_t cell, overlay *plane,
                            const polygon_list *openings, double smallest, polygon_list *outlines, int32_array *cells,
                            fram_error *error);

/* Length that a ring has on the sides of its cell that have a neighbour beyond, or are held [m]. */
double tile_side_length(const tile_grid *g, int32_t cell, polygon ring);

/* ---- the sheet as it stands ---- */

/* The floe rows of every cell: first[cell], then next[row], -1 at the end. */
typedef struct tile_index {
    int32_array first, next;
} tile_index;
void tile_index_free(context *ctx, tile_index *index);
bool tile_index_build(context *ctx, tile_index *index, const tile_grid *g, const floe_table *floes);

/* What the queries below look at. */
typedef struct tile_sheet_view {
    const tile_grid *grid;
    const tile_index *index;
    const body_table *bodies;
    const shape_store *shapes;
    const floe_table *floes;
} tile_sheet_view;

bool tile_outline(context *ctx, const tile_sheet_view *v, int32_t row, vec2_array *out);
/* Points within rounding of the sides of a cell are put there; of those within rounding of one another one stays. */
void tile_snap(const tile_grid *g, int32_t cell, vec2_array *ring);

/* A part of the boundary of the sheet, inward normal to the left. */
typedef struct tile_segment {
    vec2 a, b;
    vec2 normal; /* unit, into the ice */
} tile_segment;
typedef ARRAY(tile_segment) tile_segment_array;
/* Appends the boundary that the tiles of these cells have: their edges less the seams, and less the cuts that divide a
   tile around a hole. */
bool tile_boundary(context *ctx, const tile_sheet_view *v, tile_range range, tile_segment_array *out);

/* Length that two tiles of neighbouring cells share [m]; 0 for any others. */
double tile_seam(const tile_sheet_view *v, int32_t row_a, int32_t row_b);
/* Whether a tile has an edge on an anchored side of the sheet. */
bool tile_is_anchored(const tile_sheet_view *v, int32_t row);
/* Marks the edges of the tiles' convex pieces that are seams in full, so that nothing pushes on them, and unmarks those
   that are no longer. */
void tile_mark_seams(const tile_sheet_view *v, shape_store *shapes, tile_range range);

#endif

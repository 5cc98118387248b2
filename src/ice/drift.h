/* Level ice that drifts (docs/decisions/0139): a sheet without end, or a floe of it as large as is said, that moves as
   one rigid body without turning; what breaks off it moves on its own.

   The sheet is held in the cells of a grid (ice/tiles.h) that goes with it.  A window of whole columns and rows of
   cells, a little larger than the domain, is simulated: as the sheet moves, a row of cells leaves on one side and
   another enters on the other.  What was cut into cells that leave is remembered and is there again when they return.

   The tiles are carried bodies: contacts, friction, crushing and fracture see their velocity.  It is that of the drift
   far away as long as the ice far away can drive the sheet; where a limit is given, the sheet has inertia:

       M dv/dt = F_contacts + F_fluid + F_drive,   |F_drive| <= line load * width across,

   with F_drive whatever is needed to reach the drift's velocity within the step, up to that limit.

   Way and velocity of the tiles are whole multiples of 2^-32 m a step, so that positions are moved without rounding and
   seams stay closed, however long the drift; what is left over goes into the next step.

   Knows floes, tiles and contacts; must not know why the ice far away drifts, nor scenarios. */
#ifndef ICE_DRIFT_H
#define ICE_DRIFT_H

#include "dynamics/contact.h"
#include "ice/tiles.h"

/* What stays as it was built. */
typedef struct drift_definition {
    bool drifts;
    box2 window;           /* what the cells must cover [m] */
    box2 extent;           /* of the sheet where it was at the start; infinite where it has no end [m] */
    polygon_list openings; /* water in it, where it was at the start */
    floe_definition ice;   /* of a tile; outline and tile unset */
    double smallest;       /* rings of openings under this are no tile [m2] */
    double smallest_piece; /* as in shape_add_prism [m2] */
    double line_load; /* most that the ice far away drives with, per metre across; INFINITY: whatever is needed [N/m] */
    double mass;      /* of all that moves together at the start, ice outside the window too; with a line load [kg] */
    bool bounded;     /* a floe with four edges: what breaks off makes that mass less; otherwise the sheet is fed */
} drift_definition;

/* One row, or none without a sheet that drifts. */
#define DRIFT_FIELDS(X)                                                                             \
    X(moved, vec2, FIELD_F64, 2, "m", "way of the sheet since the start, whole quanta of 2^-32 m")  \
    X(rest, vec2, FIELD_F64, 2, "m", "way that is less than a quantum, still to go")                \
    X(way, vec2, FIELD_F64, 2, "m", "in the step that is done or under way, whole quanta")          \
    X(velocity, vec2, FIELD_F64, 2, "m/s", "of the sheet")                                          \
    X(column, int64_t, FIELD_I64, 1, "1", "number of the window's first column of cells")           \
    X(row, int64_t, FIELD_I64, 1, "1", "number of the window's first row of cells")                 \
    X(load, vec2, FIELD_F64, 2, "N", "of contacts on the sheet, mean over the last step")           \
    X(drive, vec2, FIELD_F64, 2, "N", "of the ice far away on the sheet, in the last step")         \
    X(fluid, vec2, FIELD_F64, 2, "N", "of water and air on the sheet, in the last step")            \
    X(mass, double, FIELD_F64, 1, "kg", "of all that moves together")                               \
    X(ice, double, FIELD_F64, 1, "kg", "mass of the tiles in the window")                           \
    X(entered, double, FIELD_F64, 1, "kg", "mass of tiles that entered the window since the start") \
    X(left, double, FIELD_F64, 1, "kg", "mass of tiles that left the window since the start")       \
    X(broken, double, FIELD_F64, 1, "kg", "mass that broke off or was cut out of tiles since the start")
TABLE_DECLARE(drift, DRIFT_FIELDS)

/* Cells that left with less than all their ice: a row for each ring that was left, or one without vertices. */
#define DRIFT_CELL_FIELDS(X)                                         \
    X(column, int64_t, FIELD_I64, 1, "1", "number of its column")    \
    X(row, int64_t, FIELD_I64, 1, "1", "number of its row")          \
    X(first, int32_t, FIELD_I32, 1, "1", "first vertex of the ring") \
    X(size, int32_t, FIELD_I32, 1, "1", "vertices; 0: nothing is left of the cell")
TABLE_DECLARE(drift_cell, DRIFT_CELL_FIELDS)

#define DRIFT_VERTEX_FIELDS(X) X(point, vec2, FIELD_F64, 2, "m", "where it was at the start of the drift")
TABLE_DECLARE(drift_vertex, DRIFT_VERTEX_FIELDS)

/* Everything that the drift of a sheet reads and changes. */
typedef struct drift_world {
    const drift_definition *definition;
    const tile_grid *start; /* the grid as it stood at the start */
    drift_table *drift;
    drift_cell_table *cells;
    drift_vertex_table *vertices;
    body_table *bodies;
    shape_store *shapes;
    floe_table *floes;
    int32_t *next_number;
    double *left; /* mass of ice that left [kg], added to */
} drift_world;

/* A grid of square cells of about `size` for a sheet that drifts through a window: it covers the window with a cell to
   spare on each side. */
tile_grid drift_grid_over(box2 window, double size);
/* The grid as it stands after the drift so far. */
tile_grid drift_grid(const tile_grid *start, const drift_table *drift);

/* What a cell is before anything is cut into it: its rectangle less openings and less what lies outside the extent;
   appended as by tile_cell_rings. */
fram_status drift_cell_rings(context *ctx, const drift_definition *d, const tile_grid *g, int32_t cell, overlay *plane,
                             polygon_list *outlines, int32_array *cells, fram_error *error);
/* With the tiles of the start in place: the state of the drift, and their velocity. */
fram_status drift_begin(context *ctx, const drift_world *w, vec2 velocity, fram_error *error);

/* Before a step of dt: `far` is the velocity of the drift at its end, `fluid` the force of water and air on the whole
   sheet [N].  Sets the velocity of sheet and tiles. */
void drift_drive(const drift_world *w, vec2 far, vec2 fluid, double dt);
/* After the solution: the loads of the contacts on the sheet. */
void drift_load(const drift_world *w, const contact_array *contacts, double dt);
/* After the poses moved on: so does the grid; cells leave and enter, and what broke off is booked. */
fram_status drift_step(context *ctx, overlay *plane, const drift_world *w, fram_error *error);

#endif

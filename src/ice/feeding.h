/* Feeding: an endless field of floes that drifts through a window (docs/decisions/0021-feeding.md).

   The field is a pattern of floes in a tile that repeats itself along both axes without end and moves as one sheet with
   the far-field velocity.  The window shows the part of it that is simulated.  A floe enters as soon as it reaches the
   window, on whatever side the sheet comes from; while its centre lies in the outer band of the window it goes with the
   sheet, whatever pushes (a prescribed body), so that the band presses on the ice inside as the sheet around it would.
   Inside the band it is a floe like any other.  What leaves the window is taken out, and what returns is the sheet as
   it was.  The tile is larger than the window by more than a floe: no floe of the pattern has two places in the window.
   Where ice lingers (before a vessel) the sheet leaves its floes behind; they stay, and when the pattern comes again
   its next copy of them enters too (docs/decisions/0310-copies-of-the-pattern.md).

   Knows floes, bodies and the boxes of the broad phase; must not know why the sheet moves, nor scenarios. */
#ifndef ICE_FEEDING_H
#define ICE_FEEDING_H

#include "dynamics/contact.h"
#include "ice/floe.h"

/* One row, or none without feeding. */
#define FEEDING_FIELDS(X)                                                                                    \
    X(lo, vec2, FIELD_F64, 2, "m", "lower corner of the window")                                             \
    X(hi, vec2, FIELD_F64, 2, "m", "upper corner of the window")                                             \
    X(tile, vec2, FIELD_F64, 2, "m", "size of the tile")                                                     \
    X(band, double, FIELD_F64, 1, "m", "width of the outer band whose floes go with the sheet")              \
    X(displacement, vec2, FIELD_F64, 2, "m", "of the sheet since the start, less whole tiles")               \
    X(velocity, vec2, FIELD_F64, 2, "m/s", "of the sheet")                                                   \
    X(piece_area_limit, double, FIELD_F64, 1, "m2", "smaller triangles of a concave floe are dropped")       \
    X(entered, double, FIELD_F64, 1, "kg", "mass of ice that entered since the start")                       \
    X(entered_area, double, FIELD_F64, 1, "m2", "area of ice that entered since the start")                  \
    X(entered_floes, int64_t, FIELD_I64, 1, "1", "floes that entered since the start")                       \
    X(held_back, double, FIELD_F64, 1, "kg", "mass that could not enter: other ice or the vessel was there") \
    X(held_back_floes, int64_t, FIELD_I64, 1, "1", "floes that could not enter")
TABLE_DECLARE(feeding, FEEDING_FIELDS)

/* What became of a floe of the pattern where it is nearest to the window. */
typedef enum pattern_state {
    PATTERN_OUTSIDE = 0, /* clear of the window */
    PATTERN_INSIDE,      /* it entered, whatever became of it since */
    PATTERN_WAITING,     /* it reaches the window, and its place is taken */
    PATTERN_HELD_BACK    /* its place was taken until it was all inside */
} pattern_state;

#define PATTERN_FIELDS(X)                                                                       \
    X(place, vec2, FIELD_F64, 2, "m", "centroid at the start")                                  \
    X(radius, double, FIELD_F64, 1, "m", "largest distance of a vertex from the centroid")      \
    X(area, double, FIELD_F64, 1, "m2", "area of the outline")                                  \
    X(thickness, double, FIELD_F64, 1, "m", "thickness")                                        \
    X(elevation, double, FIELD_F64, 1, "m", "of the centre of mass above still water")          \
    X(material, ice_material, FIELD_F64, 6, "SI", "density, E, nu, sigma_f, sigma_c, exponent") \
    X(breakable, uint8_t, FIELD_U8, 1, "1", "1: may break")                                     \
    X(state, uint8_t, FIELD_U8, 1, "1", "enum pattern_state")                                   \
    X(body, int32_t, FIELD_I32, 1, "1", "body slot that this copy entered as, -1: none")        \
    X(generation, uint32_t, FIELD_U32, 1, "1", "of that body")                                  \
    X(first, int32_t, FIELD_I32, 1, "1", "first vertex of the outline")                         \
    X(size, int32_t, FIELD_I32, 1, "1", "number of vertices")
TABLE_DECLARE(pattern, PATTERN_FIELDS)

/* Floes of the pattern whose body is still there while the sheet shows another copy of them.  Copies are told apart by
   whole tiles; no rows where the sheet leaves no floe behind. */
#define PATTERN_COPY_FIELDS(X)                                                             \
    X(row, int32_t, FIELD_I32, 1, "1", "floe of the pattern")                              \
    X(tiles_x, int32_t, FIELD_I32, 1, "1", "tiles from the copy that is shown to its own") \
    X(tiles_y, int32_t, FIELD_I32, 1, "1", "tiles from the copy that is shown to its own") \
    X(body, int32_t, FIELD_I32, 1, "1", "body slot that it entered as")                    \
    X(generation, uint32_t, FIELD_U32, 1, "1", "of that body")
TABLE_DECLARE(pattern_copy, PATTERN_COPY_FIELDS)

#define PATTERN_VERTEX_FIELDS(X) X(point, vec2, FIELD_F64, 2, "m", "about the centroid of its outline")
TABLE_DECLARE(pattern_vertex, PATTERN_VERTEX_FIELDS)

/* Floes of the pattern that the next steps may concern: all others show nothing, and are farther from the window than
   the sheet has moved on since these were listed.  No state; is_known becomes false when the tables become those of
   another. */
typedef struct feeding_near {
    int32_array row; /* ascending */
    double way;      /* of the sheet since [m] */
    bool is_known;
} feeding_near;

/* Everything that feeding reads and changes. */
typedef struct feeding_world {
    feeding_table *feeding;
    pattern_table *pattern;
    pattern_copy_table *copies;
    pattern_vertex_table *vertices;
    body_table *bodies;
    shape_store *shapes;
    floe_table *floes;
    const broad_table *boxes; /* of the vessel, to keep clear of */
    int32_t *next_number;
    double *left;       /* mass that left [kg] */
    feeding_near *near; /* for steps only */
} feeding_world;

typedef struct feeding_definition {
    box2 window;                  /* [m] */
    vec2 tile;                    /* [m] */
    double band;                  /* [m]; NaN: one and a half times the radius of the largest floe */
    vec2 velocity;                /* of the sheet at the start [m/s] */
    const polygon_list *keep_out; /* convex zones that are clear of ice at the start */
    double keep_out_margin;       /* the zones are grown by it all around [m] */
    double smallest_area;         /* floes cut by a zone are left out under it [m2] */
    double piece_area_limit;      /* as in shape_add_prism [m2] */
    bool given;                   /* the floes are those that somebody gave, not drawn ones */
} feeding_definition;

/* The floes that are there become the pattern, each at its place in the tile, which lies about the middle of the
   window. They are then replaced by what the window shows of the endless field, which moves with it already.  Convex
   floes are cut by keep-out zones, others that reach into one are left out.  FRAM_ERROR_INPUT with the key tile or band
   for a tile that is not larger than the window by the diameter of the largest floe, or a band that is narrower than
   its radius or leaves nothing inside. */
fram_status feeding_begin(context *ctx, overlay *o, const feeding_definition *d, const feeding_world *w,
                          fram_error *error);

/* That window, tile and band of a definition go together where the largest floe reaches so far from its centre [m], and
   the band that it gets; the errors are those of feeding_begin. */
fram_status feeding_check(const feeding_definition *d, double radius, double *band, fram_error *error);
/* The width of the band that a definition without one gets, for a pattern whose largest floe has this radius [m]. */
double feeding_band(double largest_radius);

/* The sheet moves with this velocity in the coming step: sets that of the floes in the band. */
void feeding_drive(const feeding_world *w, vec2 velocity);
/* After a step of dt with the velocity of feeding_drive: the sheet has moved on, floes change between band and inside,
   leave and enter.  A floe never enters where it would overlap other ice, or the box around the vessel. */
fram_status feeding_step(context *ctx, overlay *o, const feeding_world *w, double dt, fram_error *error);

#endif

/* Floes: polygons extruded by their thickness, as bodies with ice properties.  One code path makes them, at the start
   and after fracture. */
#ifndef ICE_FLOE_H
#define ICE_FLOE_H

#include "base/table.h"
#include "bodies/body.h"
#include "bodies/shape.h"
#include "ice/material.h"

#define FLOE_FIELDS(X)                                                                                          \
    X(body, int32_t, FIELD_I32, 1, "1", "body slot, -1: free row")                                              \
    X(thickness, double, FIELD_F64, 1, "m", "thickness h")                                                      \
    X(area, double, FIELD_F64, 1, "m2", "area of the outline")                                                  \
    X(material, ice_material, FIELD_F64, 6, "SI", "density, E, nu, sigma_f, sigma_c, exponent")                 \
    X(breakable, uint8_t, FIELD_U8, 1, "1", "1: may break in bending and splitting")                            \
    X(parent, int32_t, FIELD_I32, 1, "1", "number of the floe it broke from, -1: original")                     \
    X(number, int32_t, FIELD_I32, 1, "1", "running number, never used twice")                                   \
    X(tile, int32_t, FIELD_I32, 1, "1", "cell of the level sheet it is a part of, plus 1; 0: of none")          \
    X(retreat, vec3, FIELD_F64, 3, "m", "way of the first hull in it since it last pressed on (ice/retreat.h)") \
    X(ice_origin, vec2, FIELD_F64, 2, "m", "where the ice at the body's origin stood at the start")             \
    X(ice_yaw, double, FIELD_F64, 1, "rad", "how the body's frame is turned in the ice of the start")
TABLE_DECLARE(floe, FLOE_FIELDS)

typedef struct floe_definition {
    polygon outline; /* global plan coordinates [m], simple, counter-clockwise */
    double thickness;
    ice_material material;
    bool breakable;
    motion motion;    /* MOTION_DYNAMIC, MOTION_STATIC or MOTION_CARRIED for level ice */
    double elevation; /* z of the centre of mass; floating: see floe_floating_elevation */
    double yaw;       /* orientation given to the body; the outline is turned into the body frame by it [rad] */
    int32_t parent;
    int32_t tile;    /* cell of the level sheet plus 1 (ice/tiles.h), 0 for any other floe */
    vec2 ice_origin; /* where the origin of the outline's coordinates stood in the ice of the start [m] */
    double ice_yaw;  /* how these coordinates are turned in it [rad] */
} floe_definition;

/* Height of the centre of a level floe at rest in still water [m]: h/2 - h rho_i/rho_w. */
double floe_floating_elevation(double thickness, double density, double water_density);

/* Adds body (material ice, at rest, owner: the floe's row), shape and floe row (the lowest free one).  The body stands
   at the centroid of the outline, turned by yaw alone: a piece of a tilted floe is made from its outline in the
   parent's frame with yaw 0, and its pose set afterwards.  piece_area_limit [m2] as in shape_add_prism; o as there.
   next_number is read and advanced.  Mass = density area thickness; inertia of the prism about its centroid, products
   included. FRAM_ERROR_INPUT for an outline without area or turning clockwise, and for a thickness or density that is
   not positive; whatever fails, the tables keep their meaning. */
fram_status floe_create(context *ctx, const floe_definition *d, double piece_area_limit, overlay *o, body_table *bodies,
                        shape_store *shapes, floe_table *floes, int32_t *next_number, int32_t *row, fram_error *error);
/* Removes body, shape and row: slot and rows may be used again by later floes, the running number never is. */
void floe_remove(body_table *bodies, shape_store *shapes, floe_table *floes, int32_t row);

#endif

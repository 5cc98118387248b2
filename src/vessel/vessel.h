/* The vessel as a body: hull, mass, and how it is held or moved (towing carriage, prescribed, free).  One row a vessel.
 */
#ifndef VESSEL_VESSEL_H
#define VESSEL_VESSEL_H

#include "bodies/shape.h"
#include "dynamics/joint.h"
#include "vessel/hull.h"

typedef enum vessel_mode {
    VESSEL_PRESCRIBED = 0, /* the hull itself is driven: infinite mass, all motions given */
    VESSEL_TOWED,          /* a carriage of prescribed motion holds it by a prismatic joint along Z: free to heave */
    VESSEL_FREE            /* six degrees of freedom */
} vessel_mode;

#define VESSEL_FIELDS(X)                                                                      \
    X(body, int32_t, FIELD_I32, 1, "1", "body slot of the hull")                              \
    X(carriage, int32_t, FIELD_I32, 1, "1", "body slot of the towing carriage, -1 without")   \
    X(joint, int32_t, FIELD_I32, 1, "1", "row of the towing joint, -1 without")               \
    X(mode, uint8_t, FIELD_U8, 1, "1", "enum vessel_mode")                                    \
    X(centre, vec3, FIELD_F64, 3, "m", "centre of mass in ship coordinates")                  \
    X(length, double, FIELD_F64, 1, "m", "waterline length")                                  \
    X(beam, double, FIELD_F64, 1, "m", "waterline beam")                                      \
    X(draught, double, FIELD_F64, 1, "m", "draught")                                          \
    X(zones, hull_zones, FIELD_F64, 4, "m", "limits of the hull's zones in ship coordinates") \
    X(tow_velocity, vec3, FIELD_F64, 3, "m/s", "prescribed velocity, global frame")           \
    X(tow_ramp, double, FIELD_F64, 1, "s", "time over which the prescribed velocity grows from zero")
TABLE_DECLARE(vessel, VESSEL_FIELDS)

typedef struct vessel_definition {
    int32_t solid; /* the hull in the store, body frame about the centre of mass */
    vec3 centre;   /* centre of mass in ship coordinates [m] */
    double mass;   /* [kg] */
    vec3 gyration; /* radii of gyration in roll, pitch, yaw [m] */
    hull_particulars particulars;
    vessel_mode mode;
    vec3 position;     /* of the ship's origin (amidships, waterline), global [m] */
    double heading;    /* [rad], counter-clockwise from X */
    vec3 tow_velocity; /* of the carriage or the driven hull; free: at the start [m/s] */
    double tow_ramp;   /* [s] */
} vessel_definition;

/* Hull, and carriage and joint when towed.  The hull's body has the ship's axes and its origin in the centre of mass;
   inertia is mass times the squared radii of gyration.  A towed hull and its carriage start with the velocity at time
   0, a free one with all of tow_velocity; the joint runs along the global Z through the centre of mass.
   FRAM_ERROR_INPUT names the member that does not fit; after a failure nothing was made. */
fram_status vessel_create(context *ctx, const vessel_definition *d, body_table *bodies, shape_store *shapes,
                          joint_table *joints, vessel_table *vessels, int32_t *row, fram_error *error);
/* Set the velocity of prescribed bodies (carriage or driven hull) for the step that ends at `time`: tow_velocity times
   min(1, time / tow_ramp), no rotation.  Bodies move by the velocity at the end of a step, so that after n steps of dt
   the carriage has moved dt times the sum of the velocities at dt, 2 dt, ... n dt. */
void vessel_drive(const vessel_table *vessels, body_table *bodies, double time);
/* Ship coordinates of a global point. */
vec3 vessel_ship_coordinates(const vessel_table *vessels, const body_table *bodies, int32_t row, vec3 point);

#endif

/* Joints between two bodies as Jacobian rows with free-signed multipliers.  All kinds are one generic joint: a frame
   fixed in each body, and a mask of the six relative motions (along and about the frame's axes in body a) that are
   locked. */
#ifndef DYNAMICS_JOINT_H
#define DYNAMICS_JOINT_H

#include "bodies/body.h"

/* Bits 0-2: translation along the frame's x, y, z; bits 3-5: rotation about them. */
enum {
    JOINT_FIXED = 0x3f,
    JOINT_BALL = 0x07,
    JOINT_HINGE_Z = 0x1f,     /* free to turn about z */
    JOINT_PRISMATIC_Z = 0x3b, /* free to move along z */
    JOINT_SPRING = 0x40       /* no locked row (lower bits are then ignored): spring and damper along the line
                                 between the anchors */
};

#define JOINT_FIELDS(X)                                                                            \
    X(a, int32_t, FIELD_I32, 1, "1", "body slot that carries the frame; -1: the world")            \
    X(b, int32_t, FIELD_I32, 1, "1", "body slot")                                                  \
    X(locked, uint32_t, FIELD_U32, 1, "1", "mask of locked motions")                               \
    X(anchor_a, vec3, FIELD_F64, 3, "m", "joint point in body a's frame")                          \
    X(anchor_b, vec3, FIELD_F64, 3, "m", "joint point in body b's frame")                          \
    X(frame_a, quat, FIELD_F64, 4, "1", "joint axes in body a's frame")                            \
    X(frame_b, quat, FIELD_F64, 4, "1", "joint axes in body b's frame")                            \
    X(stiffness, double, FIELD_F64, 1, "N/m", "spring")                                            \
    X(damping, double, FIELD_F64, 1, "N s/m", "damper")                                            \
    X(rest_length, double, FIELD_F64, 1, "m", "spring length without force")                       \
    X(reaction_force, vec3, FIELD_F64, 3, "N", "on body b, mean over the last step, global frame") \
    X(reaction_moment, vec3, FIELD_F64, 3, "N m", "on body b about its anchor, global frame")      \
    X(impulse, joint_impulse, FIELD_F64, 6, "N s, N m s", "multipliers of the last step; warm start")
typedef struct joint_impulse {
    double row[6];
} joint_impulse;
TABLE_DECLARE(joint, JOINT_FIELDS)

/* A joint that locks `locked` at the bodies' present relative pose, with its frame at `point` turned by `axes`
   (global). Returns the row, -1 without memory. */
int32_t joint_create(context *ctx, joint_table *joints, const body_table *bodies, int32_t a, int32_t b, uint32_t locked,
                     vec3 point, quat axes);

#endif

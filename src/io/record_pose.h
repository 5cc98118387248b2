/* Poses and magnitudes as the record packs them: small enough for hours of thousands of floes, fine enough for
   pictures. Knows numbers only. */
#ifndef IO_RECORD_POSE_H
#define IO_RECORD_POSE_H

#include "base/vec.h"
#include <stdbool.h>
#include <stdint.h>

/* f32 x y [m], half float z [m], u16 x 3 orientation: the three smaller components of the unit quaternion (its sign
   chosen so that the largest, left out, is positive), 15 bits each over -1/sqrt(2) .. 1/sqrt(2) in the order w x y z;
   the top bits of the first two words are the high and low bit of the number of the one left out, and that of the third
   is a mark, for whoever has more to say of the body.  Angles are kept to 1e-4 rad. */
enum { RECORD_POSE_SIZE = 16 };
void record_pose_pack(vec3 position, quat orientation, unsigned char out[RECORD_POSE_SIZE]);
void record_pose_unpack(const unsigned char in[RECORD_POSE_SIZE], vec3 *position, quat *orientation);
/* Set the mark of a packed pose; whether it is set. */
void record_pose_mark(unsigned char pose[RECORD_POSE_SIZE]);
bool record_pose_is_marked(const unsigned char pose[RECORD_POSE_SIZE]);

/* IEEE 754 half precision, rounded to nearest even; beyond its range the largest finite one.  Not for numbers that are
   none. */
uint16_t half_from_real(double value);
double real_from_half(uint16_t half);

/* A magnitude of force [N], which is never negative: as half floats of kN, but with a sixth bit of exponent in place of
   the sign.  From 1e-9 kN, of models, to 8.58e9 kN to eleven binary places; beyond that the largest, which no ice
   bears. */
uint16_t record_force_pack(double newton);
double record_force_unpack(uint16_t packed);

#endif

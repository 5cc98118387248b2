/* Strength that varies over the ice: two lognormal random fields, of flexural and of crushing strength, over the places
   that the ice had at the start.  A value belongs to the piece of ice that is there and goes with it, also into the
   floes that break off.  A field is a pure function of seed and place: nothing is stored but where a floe's ice stood
   (floe table: ice_origin, ice_yaw), so that order, threads and restarts do not matter.  Knows floes; must not know
   loads. */
#ifndef ICE_STRENGTH_H
#define ICE_STRENGTH_H

#include "ice/floe.h"

typedef struct strength_field {
    uint64_t seed;
    double flexural_variation; /* coefficient of variation of the flexural strength; 0: it does not vary [1] */
    double crushing_variation; /* of the crushing strength [1] */
    double length;             /* correlation length L: the logarithms correlate with exp(-(r/L)^2) [m] */
    double common;             /* correlation of the logarithms of both strengths at one place, 0 to 1 [1] */
} strength_field;

/* Noise of the lattice that was asked for before, of one field: loads come to the same places step after step. Scratch:
   answers are the same with and without.  Zero: nothing yet. */
enum { STRENGTH_NOISES = 1024 };
typedef struct strength_noise {
    int64_t column, row;
    double value;
    uint32_t stream;
    bool known;
} strength_noise;
typedef struct strength_memory {
    uint64_t seed;
    strength_noise noise[STRENGTH_NOISES];
} strength_memory;

/* The Gaussian fields behind the strengths. */
typedef enum strength_kind { STRENGTH_FLEXURAL = 0, STRENGTH_CRUSHING } strength_kind;

/* What a strength is multiplied by at a place of the ice [m]: lognormal, mean 1 and the field's coefficient of
   variation; 1 without variation.  White noise on a lattice of L/2 under a Gaussian kernel of the standard deviation
   L/2 (Vanmarcke 1983): mean and variance are exact at every place, the correlation within 2e-3.  memory: may be NULL.
 */
double strength_factor(const strength_field *f, strength_memory *memory, strength_kind kind, vec2 place);

/* The place in the ice of a point of a floe's plane, in the frame of its body [m]. */
vec2 strength_place(const floe_table *floes, int32_t floe, vec2 point);

/* The material of a floe with its strengths at a point of its plane, in the frame of its body [m].  Its own strengths
   are the means of the field. */
ice_material strength_flexural_at(const strength_field *f, strength_memory *memory, const floe_table *floes,
                                  int32_t floe, vec2 point);
ice_material strength_crushing_at(const strength_field *f, const floe_table *floes, int32_t floe, vec2 point);

#endif

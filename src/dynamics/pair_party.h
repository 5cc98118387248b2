/* The two bodies of a pair as the narrow phase sees them: their pieces, where these reach, and how far apart the whole
   bodies are along an axis.  Inside dynamics. */
#ifndef DYNAMICS_PAIR_PARTY_H
#define DYNAMICS_PAIR_PARTY_H

#include "dynamics/collision_scratch.h"
#include "dynamics/prism_contact.h"

/* One body of a pair. */
typedef struct party {
    int32_t slot, shape;
    mat3 rotation;
    vec3 centre; /* about the first body's centre of mass */
    bool is_prism;
    const shape_store *shapes;
} party;

/* origin: the first body's centre of mass, global frame. */
party party_of(const body_table *bodies, const shape_store *shapes, int32_t slot, vec3 origin);

static inline const polyhedron_array *solid_pieces(const party *p) { return &shape_solid(p->shapes, p->shape)->pieces; }

static inline int32_t piece_count(const party *p)
{
    return p->is_prism ? p->shapes->shapes.piece_count[p->shape] : solid_pieces(p)->count;
}

prism prism_piece(const party *p, int32_t piece);

/* How far apart two bodies are along an axis from b to a; -infinity without an axis. */
double axis_gap(const party *a, const party *b, vec3 axis);
/* The same of two of their pieces. */
double piece_axis_gap(const party *a, int32_t piece_a, const party *b, int32_t piece_b, vec3 axis);

/* A box around each piece, and around all.  false: no memory. */
bool party_boxes(context *ctx, const party *p, box3_array *boxes, box3 *whole);

/* The pieces whose boxes come nearer to the box than `slack`, and the only one wherever it is; *apart becomes no more
   than how far the others are from it [m].  false: no memory. */
bool gather_pieces(context *ctx, const box3_array *boxes, box3 box, double slack, int32_array *near, double *apart);

#endif

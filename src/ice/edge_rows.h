/* What edges of level and fixed ice give in rows of the solver (docs/decisions/0400): loads that crush nothing, of
   hulls and of free pieces that hang on an edge by friction or lift it, bend it as they come and go.  A row is told
   what its edge carried, and yields by the compliance to what changes of that (give and recoil, dynamics/contact.h);
   nothing is corrected afterwards.

   Under a hull the stiffness is that of ice/edge_give.h, and what the edge carried is handed on with what the patch
   stood on.  Under pieces it is that of a half plane on water, whose loads P_j make
       w_i = sum_j G(|r_i - r_j| / l) P_j / (rho_w g l^2),
   G of ice/sheet.h.  Loads of neighbours are taken to change in proportion to what they carried, C_i = sum_j min(1,
   P_j / P_i) G_ij, so that a load alone gets the point's deflection and equal loads along a wall that of a line; what a
   pair carried stands in the memory of contacts. */
#ifndef ICE_EDGE_ROWS_H
#define ICE_EDGE_ROWS_H

#include "ice/crushing.h"

/* An edge under one piece.  Scratch. */
typedef struct edge_piece {
    int32_t first, end, groups; /* contacts */
    vec2 place;                 /* middle of the contacts [m] */
    double along;               /* place along the longer side of all [m], by which neighbours are found */
    vec2 facing;                /* out of the edge, level part of a unit vector */
    double width;               /* of the contact along the edge [m] */
    double length, stiffness;   /* l [m], rho_w g l^2 [N/m] */
    double most;                /* deflection at which the theory ends [m] */
    double load;                /* up, on the edge, in the last step [N] */
    double influence;           /* w rho_w g l^2 / P */
} edge_piece;
typedef ARRAY(edge_piece) edge_piece_array;

typedef struct edge_rows_work {
    int32_array picked; /* contacts with an edge that may give */
    edge_piece_array pieces;
    int32_array support;   /* of each patch: row, -1 without */
    ARRAY(double) claimed; /* of each support: horizontal area of its patches [m2] */
} edge_rows_work;
void edge_rows_free(context *ctx, edge_rows_work *w);

typedef struct edge_job {
    const edge_compliance *edges;
    double time_step; /* [s] */
    const body_table *bodies;
    const floe_table *floes;
    const edge_support_table *supports; /* may be NULL: no patch carried anything */
    const contact_memory_table *memory;
} edge_job;

/* Writes give and recoil of all contacts on breakable ice that does not move freely: with hulls, whose patches have a
   compliance, and with free pieces.  Nothing without edges->elastic.  false: no memory. */
bool edge_rows_set(context *ctx, const edge_job *j, edge_rows_work *w, const crushing_patch_array *patches,
                   contact_array *contacts);

#endif

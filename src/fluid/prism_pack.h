/* Floes of the tables into batches of eight, and their loads back.  Inside fluid; knows no kernel. */
#ifndef FLUID_PRISM_PACK_H
#define FLUID_PRISM_PACK_H

#include "fluid/fluid.h"
#include "fluid/prism_batch.h"

/* Body slots that are worked on together. */
enum { PRISM_BLOCK = 256 };

typedef struct prism_work {
    const media *media;
    drag_coefficients half[MATERIAL_COUNT]; /* 1/2 rho C [kg/m3] */
    bool wet, dry;                          /* media whose drag is wanted by any material */
    bool level_only;                        /* sunken floes are worked on as tilted ones */
    const body_table *bodies;
    const shape_store *shapes;
    held_drag_table *held; /* of level floes; may be NULL */
} prism_work;

prism_work prism_work_of(const media *m, const drag_coefficients coefficients[MATERIAL_COUNT], const body_table *bodies,
                         const shape_store *shapes);

/* Where the loads of a block go, at [slot - first]. */
typedef struct prism_output {
    wrench *total;    /* of water and air, without gravity */
    double *volume;   /* submerged [m3] */
    fluid_load *load; /* may be NULL */
} prism_output;

/* Vertices of the longest outline whose sides are cut in half. */
enum { PRISM_FEW_VERTICES = 4 };

/* Points that an outline has in a batch.  Those of few vertices have long edges, on which the quadrature of skin drag
   is coarse: they are cut in half. */
int32_t prism_points(int32_t vertices);
/* These points of n vertices: the vertices themselves, or in `room`, of twice as many. */
const vec2 *prism_outline(const vec2 *vertex, int32_t n, vec2 *room);

/* Pose and motion of a slot's floe; not wet and dry and the weight, which all have in common. */
void prism_pack(const prism_work *w, prism_batch *b, int lane, int32_t slot);
void prism_unpack(const prism_batch *b, int lane, const prism_output *out, int32_t to);

#endif

/* What the parts of fracture share.  Inside fracture. */
#ifndef ICE_FRACTURE_PARTS_H
#define ICE_FRACTURE_PARTS_H

#include "ice/fracture.h"

/* A patch as a load on a floe, in the floe's own frame. */
typedef struct fracture_load {
    int32_t body, floe; /* slot and row */
    int32_t patch;      /* row, for ties */
    double force;       /* P: along the floe's own z [N] */
    double plane_force; /* in its plane [N] */
    vec2 place;         /* r_break [m] */
    edge_stress stress;
    double radial_ratio, wedge_ratio; /* stress over flexural strength */
} fracture_load;
typedef ARRAY(fracture_load) fracture_load_array;

/* An outline on its way to become a floe. */
typedef struct cut_piece {
    int32_t ring;   /* in fracture_scratch.outlines */
    uint8_t motion; /* enum motion of the floe to be */
    double area;    /* [m2] */
} cut_piece;
typedef ARRAY(cut_piece) cut_piece_array;

struct fracture_scratch {
    fracture_load_array loads;
    ARRAY(uint8_t) broken; /* one per body slot: broke in this step */
    polygon_list whole;    /* what is left uncut of the floe at hand, its frame; remnants in the end */
    polygon_list remnants; /* of one ring under one stencil */
    polygon_list wedges;   /* broken off */
    polygon_list pieces;   /* wedges of one ring under one stencil */
    polygon_list outlines; /* rings of the cut pieces, and of what became of them */
    polygon_list pair, joined;
    cut_piece_array cut;
    vec2_array ring, clean;
    ARRAY(uint8_t) forgotten; /* rows of the contact memory */
};

/* Loads of this step on breakable floes that fail in one way at least, by ascending slot, then falling stress over
   strength, ties by patch.  false: no memory. */
bool fracture_loads(context *ctx, fracture_scratch *s, const fracture_settings *settings,
                    const crushing_patch_array *patches, const fracture_state *state);

/* Where a crack starts: the boundary point nearest to a load. */
typedef struct crack_start {
    vec2 point;      /* r_start [m] */
    int32_t edge;    /* index of the edge it is on; of its first edge where it is a vertex */
    vec2 direction;  /* unit, into the ice: theta_crack (Algorithm 7) */
    double distance; /* from the load's place [m] */
} crack_start;
crack_start crack_start_of(polygon p, vec2 load, double snap);

/* Way of a ray from the start to where it first leaves the polygon; edge gets the edge met, -1 when there is none. */
double crack_length(polygon p, const crack_start *start, int32_t *edge);

/* Cut `outline` from the start along its direction: two children are appended to out.  false when the reference refuses
   the split (a child that crosses itself, is too small or too narrow); *memory is set when that is what failed. */
bool fracture_split(context *ctx, const fracture_settings *settings, polygon outline, const crack_start *start,
                    polygon_list *out, bool *memory);

/* Whether the load's radial crack runs through the floe; length gets the crack's. */
bool fracture_splits(const fracture_settings *settings, polygon outline, const fracture_load *load, double thickness,
                     const crack_start *start, double *length);

/* The stencil's 2 N points around the start. */
enum { MOST_STENCIL = 64 };
int fracture_stencil(int32_t wedges, double radius, const crack_start *start, vec2 out[MOST_STENCIL]);
/* Cut one ring by the stencil: remnants and wedges are appended. */
fram_status fracture_bend(context *ctx, overlay *plane, const fracture_settings *settings, double radius, polygon ring,
                          const crack_start *start, polygon_list *remnants, polygon_list *wedges, fram_error *error);

/* Simple, and by so much that rounding in a shift of the origin does not spoil it. */
bool fracture_outline_is_sound(context *ctx, polygon p);

/* Pieces that are too small or too narrow to be floes are joined to the neighbour that they share the most boundary
   with, so that no ice is lost; those without one stay.  Pieces keep their order. */
fram_status fracture_join_dust(context *ctx, fracture_scratch *s, const fracture_settings *settings, overlay *plane,
                               fram_error *error);

/* The parent goes; cleaned remnants and wedges become floes, and the event's books are filled in.  *broke is false, and
   nothing has changed, when the pieces are too small to part, or so small that more than the booked area of SPEC 8.8
   would be lost with them. */
fram_status fracture_birth(context *ctx, fracture_scratch *s, const fracture_settings *settings, overlay *plane,
                           const fracture_state *state, int32_t floe, const polygon_list *remnants,
                           const polygon_list *wedges, fracture_event *event, bool *broke, fram_error *error);

#endif

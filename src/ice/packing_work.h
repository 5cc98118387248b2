/* What the files of the packing share, one struct for each stage: the layout (packing_bodies, packing_start), the
   search for pairs (packing_pairs), the contacts of a round (packing_contacts, packing_hooks, packing_solve).  A
   function takes the stages that it works on; the schedule (packing, packing_moves, packing_fit, packing_swaps) holds
   them together in pack_work.  Not for other files.  One module with packing, whose inside this is.

   Why not the grid, pairs and solver of dynamics: docs/decisions/0120-own-code-and-libraries.md. */
#ifndef ICE_PACKING_WORK_H
#define ICE_PACKING_WORK_H

#include "ice/packing.h"

/* Random streams of the packing (base/random.h). */
enum { PACK_STREAM_START = 0x1ce10, PACK_STREAM_SHAKE, PACK_STREAM_MOVE, PACK_STREAM_HOLE, PACK_STREAM_SWAP };

/* A floe, or an obstacle (weights 0). */
typedef struct pack_body {
    vec2 centre, turn;
    double weight, spin_weight; /* inverse mass and moment of inertia, in units of their own */
    double radius;              /* [m] */
    double size;                /* square root of the area [m] */
    int32_t piece, piece_count;
} pack_body;

/* A convex piece. */
typedef struct pack_piece {
    int32_t body, first, count; /* vertices */
    vec2 middle;                /* mean of its vertices as it lies: inside */
    box2 box;                   /* as it lies */
} pack_piece;

/* A pair of pieces whose boxes come near; b's piece stands `shift` away from where it is stored. */
typedef struct pack_pair {
    int32_t a, b;
    int8_t shift_x, shift_y; /* in periods */
    int16_t axis;            /* the edge that parted them last: of a, or of b counted from a's end; -1 */
} pack_pair;

/* One condition: gap + motion along the normal >= 0. */
typedef struct pack_row {
    int32_t a, b; /* bodies; b < 0: a wall */
    vec2 normal;  /* from a to b, unit */
    double arm_a, arm_b;
    double gap;  /* over the wanted one [m] */
    double mass; /* what a unit push moves the gap, inverse */
    double push;
} pack_row;

/* Displacement of one round. */
typedef struct pack_step {
    double x, y, turn;
} pack_step;

/* An entry of the search grid: a piece, or its image. */
typedef struct pack_item {
    box2 box;
    int32_t piece;
    int8_t shift_x, shift_y;
} pack_item;

typedef struct pack_grid {
    vec2 origin;
    double width;
    int32_t nx, ny;
} pack_grid;

/* The floes and obstacles, and where they lie. */
typedef struct pack_layout {
    ARRAY(pack_body) bodies;
    ARRAY(pack_piece) pieces;
    vec2_array local, local_normal; /* vertices, and outward normals of the edges that begin there, body frame */
    vec2_array vertex, normal;      /* as they lie */
    ARRAY(uint8_t) seam;            /* 1: the edge is a cut inside its floe */
    int32_array shape;              /* of each movable body: the request's */
    int32_t movable;                /* bodies from here on are obstacles */
    bool coarse;                    /* the bodies are the request's coarse shapes */
    bool concave;                   /* some floe has several pieces */
    double scale; /* of the floes: 1 but while concave ones grow, or an impossible field is shrunk until it fits */
    double mean_size, least_size; /* [m] */
    double grain;                 /* what large floes are moved by as if they were of this size [m] */
} pack_layout;

/* Which pieces come near each other, and what that was found by. */
typedef struct pack_search {
    ARRAY(pack_item) items;
    pack_grid grid;
    int32_array cell_start, cell_item;
    ARRAY(pack_pair) pairs;
    vec2_array pair_centre; /* of the bodies when the pairs were found */
    double reach;           /* pieces nearer than this are pairs [m] */
} pack_search;

/* The conditions of one round, and the displacements that meet them. */
typedef struct pack_contacts {
    ARRAY(pack_row) rows;
    ARRAY(pack_step) steps;
    ARRAY(double) squeeze; /* deepest overlap of each body in this round [m] */
    double overlap;        /* largest of this round; negative: all are apart [m] */
} pack_contacts;

/* A packing at work: what was asked, how far it is, and the stages' own. */
typedef struct pack_work {
    context *ctx;
    const packing_request *request;
    overlay *overlay;  /* may be NULL */
    fram_error *error; /* and its status, when it is not for memory that a function returned false */
    fram_status status;
    vec2 period;   /* 0: walls */
    uint64_t seed; /* of this beginning */
    double gap;    /* clear distance the rounds aim at [m] */
    int32_t round;
    pack_layout layout;
    pack_search search;
    pack_contacts contacts;
} pack_work;

/* packing_bodies.c: bodies of the shapes, coarse or not, replace all that there were; false: no memory, or
   w->status. */
bool pack_bodies_make(pack_work *w);
/* Finer shapes in place of coarse ones, as these lie; false: no memory, or w->status. */
bool pack_refine(pack_work *w);
void pack_work_free(pack_work *w);
/* By the request's shapes; there is room. */
void pack_poses(const pack_layout *l, packing_pose_array *poses);
/* Vertices, normals and boxes as they lie. */
void pack_place(pack_layout *l);
void pack_place_body(pack_layout *l, int32_t body);

/* Stores the bodies anew in the order of their places, so that neighbours in the water are neighbours in memory:
   l->shape says which shape is where.  false: no memory. */
bool pack_sort_bodies(context *ctx, pack_layout *l);

/* packing.c: mean of the floes' deepest overlaps, each over the floe's size, as the last rows were found. */
double pack_mean_squeeze(const pack_layout *l, const pack_contacts *c);

/* packing_start.c: first places and angles; false: no memory, or w->status. */
bool pack_start(pack_work *w);

/* packing_pairs.c: find the pairs anew when bodies may have left the margin of the last search; false: no memory. */
bool pack_find_pairs(pack_work *w, bool force);
/* What brings a place in the domain to the image that is nearest to another. */
vec2 pack_image_shift(const pack_work *w, vec2 from, vec2 to);
/* Cells of the grid that a box meets. */
void pack_grid_range(const pack_grid *g, box2 box, int32_t lo[2], int32_t hi[2]);

/* A deep overlap is undone in several rounds: this part of a grain at a time. */
#define PACK_MOST_PUSH 0.15

/* packing_contacts.c: rows of all pairs and walls; false: no memory. */
bool pack_find_rows(pack_work *w);
/* Whether two boxes, the second moved by shift, are farther apart than `far` along an axis. */
bool pack_boxes_far(box2 a, box2 b, vec2 shift, double far);
/* How deep b, moved by shift, is in a; what is less than `enough` may be called 0. */
double pack_depth(const pack_layout *l, const pack_piece *a, const pack_piece *b, vec2 shift, double enough);

/* packing_hooks.c: pairs of concave floes whose rows contradict one another get one row each instead; false: no
   memory. */
bool pack_part_hooked(pack_work *w);

/* packing_solve.c: displacements that part the rows, added to a random step of `shake` floe sizes, and moving by
   them. */
void pack_solve_rows(pack_work *w, double shake);

/* packing_moves.c: carries squeezed floes into open water where that helps; with `hooked` over 0, the smaller floe of
   each pair that overlaps by more than this part of its size to the widest water there is, whether it helps at once or
   not.  Concave floes that stay squeezed are turned or swap places.  Adds to *moves; false: no memory. */
bool pack_move_squeezed(pack_work *w, double hooked, int32_t *moves);
/* packing_fit.c: turns a body to the angle, of some from `first` on, at which it overlaps least, if that is by less
   than `bound`; how deep it overlaps then, or the bound.  carried: bodies that have left the places at which the grid
   lists them. */
double pack_turn_best(pack_work *w, int32_t body, double first, double bound, const int32_array *carried);

/* packing_swaps.c: turns a squeezed body to where it fits better, or has it swap places with a smaller one; who moved
   is added to `carried`. false: no memory. */
bool pack_swap_squeezed(pack_work *w, int32_t body, int32_array *carried);

#endif

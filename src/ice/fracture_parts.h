/* What the parts of fracture share.  Inside fracture. One module with fracture, whose inside this is. */
#ifndef ICE_FRACTURE_PARTS_H
#define ICE_FRACTURE_PARTS_H

#include "ice/edge_way.h"
#include "ice/fracture.h"
#include "ice/tiles.h"

/* What one call works on. */
typedef struct fracture_job {
    context *ctx;
    fracture_scratch *scratch;
    const fracture_settings *settings;
    overlay *plane;
    const fracture_state *state;
    fracture_event_array *events;
    fram_error *error;
} fracture_job;

/* What is known of a load. */
enum { LOAD_HOLDS, LOAD_OPEN, LOAD_JOINT, LOAD_FAILS };

/* Where a crack starts: the boundary point nearest to a load. */
typedef struct crack_start {
    vec2 point;      /* r_start [m] */
    int32_t edge;    /* index of the edge it is on; of its first edge where it is a vertex */
    vec2 direction;  /* unit, into the ice: theta_crack (Algorithm 7) */
    double distance; /* from the load's place [m] */
} crack_start;

/* A patch as a load on a floe, in the floe's own frame; of a level sheet, in the global plan, with what the patch has
   in other tiles. */
typedef struct fracture_load {
    int32_t body, floe;   /* slot and row; of a sheet those of one of its tiles */
    int32_t patch;        /* row, for ties */
    int32_t tile;         /* cell of the sheet plus 1, 0: a floe of its own */
    int32_t surface;      /* slot of the body that pushes */
    vec3 vector;          /* force on the floe, floe frame [N] */
    double force;         /* P: along the floe's own z [N] */
    double near;          /* that of all others that are near on the same ice [N] */
    double joint_ratio;   /* what all of them make, over the strength, at the worst place where this load makes most */
    bool known;           /* whether the ice under it was looked at */
    double plane_force;   /* in its plane [N] */
    vec3 normal;          /* of the patch, floe frame */
    double rise;          /* of the edge that gave, against its floe, up [m] */
    double rate;          /* at which it goes on up; until its growth is known, that of the surface there [m/s] */
    double aside;         /* what a patch parts the ice with over its load along the normal: 1/(2 tan b) of a wedge */
    double opening_force; /* what opens a crack in the plane: that, and no less than plane_force [N] */
    vec2 place;           /* r_break [m] */
    crack_start start;    /* with the ice that it stands on; of a sheet that ends nowhere near: distance below 0 */
    box2 plan;            /* of a sheet: bounds of the patch, global [m] */
    double spread[3];     /* xx, xy, yy: mean squares of the patch about its place; with wide_contacts [m2] */
    double width;         /* of the contact along the edge; 0: it acts as a narrow one [m] */
    bool beam;            /* no ice for wedges: loaded along the whole end of a floe */
    double area, horizontal_area; /* of the patch [m2] */
    double reach;                 /* what fracture_reach told [m]; 0: nobody asked */
    double thickness;             /* of the floe [m] */
    ice_material ice;
    edge_stress stress;
    double radial_ratio, wedge_ratio; /* stress over flexural strength */
    double split_ratio;               /* with SPLITTING_TOUGHNESS: load in the plane over the largest; else 0 */
    int32_t fate;                     /* LOAD_... */
} fracture_load;
typedef ARRAY(fracture_load) fracture_load_array;

/* An outline on its way to become a floe. */
typedef struct cut_piece {
    int32_t ring;   /* in piece_work.outlines */
    uint8_t motion; /* enum motion of the floe to be */
    int32_t tile;   /* cell of the sheet that it lies in plus 1; 0: of no sheet, or in several */
    int32_t wedge;  /* number in the stencil plus 1; 0: what is left of the floe */
    double area;    /* [m2] */
    int32_t bend;   /* of a wedge: which of the birth's bends it has */
} cut_piece;
typedef ARRAY(cut_piece) cut_piece_array;

/* A load by the floe and the surface that it is between. */
typedef struct load_pair {
    int32_t floe;    /* running number */
    int32_t surface; /* slot */
    int32_t load;    /* row */
} load_pair;

/* A load by the ice that it is on. */
typedef struct joint_load {
    int32_t ice;  /* slot of the floe; -1: the sheet */
    int32_t load; /* row */
} joint_load;

/* A load near another one, as it bends the edge under that. */
typedef struct joint_part {
    int32_t load;      /* row */
    double force;      /* up or down as that [N] */
    double width, way; /* along the edge, and from that [m] */
} joint_part;

/* A patch on ice that is held, before seams were merged. */
typedef struct load_part {
    bool held;       /* under a hull; all other parts are of ice that gives in no way */
    bool over;       /* it bore all that it may, and would have been over what breaks the edge, as that was known */
    int32_t patch;   /* row */
    int32_t root;    /* the first part of the same load */
    int32_t load;    /* of a root: row of the load */
    int32_t floe;    /* row */
    int32_t surface; /* slot */
    vec3 place;      /* frame of the surface's body [m] */
    double level;    /* horizontal area [m2] */
    double sum;      /* of a root: of all parts [m2] */
    double impulse;  /* of the load that was here, up to the last step [N s] */
    double up;       /* how far the edge stood up under that [m] */
    double own;      /* vertical load of the part, up [N] */
    double gap;      /* by which the surface stands off the ice at the end of the step [m] */
} load_part;

/* How a load has grown. */
typedef struct load_rise {
    double load;    /* vertical, in this step [N] */
    double impulse; /* since the first touch [N s] */
    double time;    /* of rising; infinite on ice that floats, or without inertia [s] */
    double up;      /* how far the edge stands up [m] */
    bool known;     /* whether the ice under it was looked at */
} load_rise;

/* The loads at hand. */
typedef struct load_work {
    fracture_load_array all;
    ARRAY(load_pair) pairs;   /* those of floes that float, sorted */
    ARRAY(vec3) felt;         /* one per load: what was felt there before this step */
    ARRAY(load_part) parts;   /* one per load that there was before seams were merged */
    ARRAY(edge_ice) edges;    /* one per load since: the ice that it stands on, a straight edge where it is too small */
    ARRAY(load_rise) rises;   /* one per load since */
    int32_array root;         /* the least load that is one with each, across seams */
    ARRAY(joint_load) joint;  /* with joint_loads, one per load, sorted */
    ARRAY(joint_part) beside; /* of the load at hand */
    tile_segment_array line;  /* the edge around it, */
    edge_arc_array arcs;      /* and the ways along that */
    strength_memory strengths;
} load_work;

/* What a break in bending takes out. */
typedef struct break_size {
    double radius;       /* of the wedges: R_bending [m] */
    double side;         /* of the cracks between them [m] */
    double width;        /* of the contact along the edge, between the end wedges; 0: narrow [m] */
    double strip_length; /* of the strip there, from the edge [m] */
} break_size;

/* An edge as it breaks: what comes off is as far up at the load as the edge was, and not at all at the crack; and goes
   on up as the edge did. */
typedef struct edge_bend {
    crack_start start;
    break_size size;
    double rise; /* [m] */
    double rate; /* [m/s] */
} edge_bend;

/* One floe being cut, in its own frame. */
typedef struct floe_work {
    vec2_array outline;
    polygon_list whole;     /* what is left uncut; remnants in the end */
    polygon_list wedges;    /* broken off, */
    ARRAY(edge_bend) bends; /* and how the edge stood where each did */
    polygon_list remnants;  /* of one ring under one stencil */
    polygon_list pieces;    /* wedges of one ring under one stencil */
    polygon_list room;      /* spare of `whole` */
} floe_work;

/* Cut pieces on their way to become floes. */
typedef struct piece_work {
    cut_piece_array rows;
    polygon_list outlines;     /* rings of the rows, and of what became of them */
    polygon_list pair, joined; /* two siblings, and their union */
    vec2_array welded;         /* one of the two, with the corners of the other */
    polygon_list parts;        /* convex parts of a ring */
    vec2_array clean;
} piece_work;

/* A part of a level sheet, as a search from what changed knows it. */
typedef struct sheet_part {
    int32_t joined;      /* the part that it was found to be one with; -1: none */
    int32_t first, last; /* floe rows that are to be looked at, by sheet.behind; -1: none */
    int32_t state;       /* PART_... */
} sheet_part;

/* Level ice. */
typedef struct sheet_work {
    tile_index index;
    bool index_is_made;
    tile_segment_array boundary;
    ARRAY(crack_start) starts; /* one per load */
    int32_array touched;       /* floe rows that the crack at hand reaches, or that come loose */
    ARRAY(uint8_t) mark;       /* one per floe row */
    int32_array front;         /* of a flood */
    tile_range changed;        /* cells in which something broke in this step, */
    bool has_changed;          /* if there are any */
    bool all_held;             /* every tile is known to hang on an anchored side; no state */
    ARRAY(sheet_part) parts;   /* that a search found, */
    int32_array open;          /* those that are neither held nor loose yet, */
    int32_array part, behind;  /* one per floe row that it reached: its part, and the next in the front of that */
    int32_array reached;       /* in the order of the search */
    int32_array cut_off;       /* floe rows of tiles that nothing holds, ascending */
    vec2_array ring;           /* of the tile at hand, global plan */
    vec2_array snapped_ring;
    polygon_list remnants, wedge_parts; /* of that tile */
    polygon_list snapped;               /* the same with corners back on the cell's sides */
    polygon_list loose, united;         /* tiles that nothing holds, and their union */
} sheet_work;

/* How a hull cuts a floe. */
typedef struct trim_place {
    int32_t surface; /* slot of the hull; -1: of none */
    mat3 rotation;   /* hull to floe */
    vec3 offset;
    double half; /* of the floe's thickness [m] */
    double rim;  /* of ice that stays inside the sections [m] */
    bool all;    /* both sections go, not what they have in common */
} trim_place;

/* Crushed ice being cut away from one floe. */
typedef struct trim_work {
    trim_place place;         /* for which `gone` was found */
    mesh hull;                /* in the frame of that floe */
    polygon_list top, bottom; /* its sections with the floe's faces */
    polygon_list inner;       /* one of these, moved inwards */
    polygon_list gone;        /* where no ice may be */
    polygon_list left, room;  /* of the floe, and its spare */
    vec2_array outline;       /* of the floe */
    vec2_array ring, clipped;
} trim_work;

struct fracture_scratch {
    load_work load;
    floe_work floe;
    piece_work piece;
    sheet_work sheet;
    trim_work trim;
    ARRAY(uint8_t) broken;    /* one per body slot: broke in this step */
    ARRAY(uint8_t) forgotten; /* rows of the contact memory */
};

/* A crack starts at a corner when it is nearer to it than this part of R_bending. */
#define CRACK_CORNER_REACH 1e-6
/* A start is gone when the boundary that is left is farther from it than this part of R_bending. */
#define CRACK_GONE_REACH 1e-6

/* Loads of this step on breakable floes that fail in one way at least, by ascending slot, then falling stress over
   strength, ties by patch. */
fram_status fracture_loads(const fracture_job *j, const crushing_patch_array *patches);

/* By EDGE_LOAD_RESPONSE, the loads on floes that float become what these feel, which is remembered. */
fram_status fracture_respond(const fracture_job *j);

/* Loads of hulls on level and fixed ice, before seams are merged; how each load since has grown; and what they stood
   on, for the next step. */
bool fracture_note_parts(const fracture_job *j, const crushing_patch_array *patches);
bool fracture_note_rises(const fracture_job *j);
fram_status fracture_keep_supports(const fracture_job *j);
/* What a load that broke its ice stands on now is not known, nor what that bears. */
void fracture_renew_supports(const fracture_job *j);

/* What of the settings concerns edges alone. */
edge_compliance fracture_edges(const fracture_settings *f);

/* How far into the ice a load's wedges are looked at along their axes: R_bending on a straight edge, within 5 % [m].
 */
double fracture_edge_reach(const fracture_settings *f, const ice_material *ice, double thickness, double area);
/* The same of a load. */
double fracture_reach(const fracture_job *j, fracture_load *l);
/* The ice that a load on a floe of its own stands on is at least this part of N whole wedges, what costs little to
   know: 0 where that is nothing. */
double fracture_least_ice(const fracture_job *j, fracture_load *l);
/* The ice that a load stands on, by the areas inside the sectors of its stencil; N whole wedges with SHARING_EQUAL. The
   load gets its width along the edge.  Of a floe of its own, on any thread; of a sheet, with its index of tiles. */
edge_ice fracture_floe_ice(const fracture_job *j, fracture_load *l);
fram_status fracture_sheet_ice(const fracture_job *j, fracture_load *l, edge_ice *edge);

/* Loads that are near each other on the same ice, where joint_loads asks for them. */
bool fracture_note_joint(const fracture_job *j);
/* Vertical loads on the same ice whose patches are near a load's, together [N]. */
double fracture_near_force(const fracture_job *j, const fracture_load *l);
/* A load whose own stresses are known, with all that are near: the worst sum over its width becomes the joint_ratio of
   the load that makes most of it in its middle, if it is that one's largest. */
fram_status fracture_join(const fracture_job *j, int32_t load);
/* The width along an edge with this inward normal that a load keeps; 0: it acts as a narrow one [m]. */
double fracture_contact_width(const fracture_job *j, const fracture_load *l, vec2 inward);
/* Appends the sheet's boundary in the tiles within reach of a place. */
fram_status fracture_sheet_boundary(const fracture_job *j, vec2 place, double reach, tile_segment_array *out);

crack_start crack_start_of(polygon p, vec2 load, double snap);

/* *least becomes the length to where the ray crosses the segment, if it is shorter and the segment begins farther than
   `snap` from the start [m]. */
void crack_shorten(const crack_start *start, vec2 a, vec2 b, double snap, double *least);
/* Length of the crack's ray to where it first leaves the polygon; edge gets the edge met, -1 when there is none. */
double crack_length(polygon p, const crack_start *start, int32_t *edge);

/* Cut `outline` from the start along its direction: two children are appended to out.  false when the reference refuses
   the split (a child that crosses itself, is too small or too narrow); *memory is set when that is what failed. */
bool fracture_split(context *ctx, const fracture_settings *settings, polygon outline, const crack_start *start,
                    polygon_list *out, bool *memory);

/* The load in the plane over the largest that the floe bears by its toughness, whatever bends it; 0 where the crack
   leaves no floe on one side.  length gets the crack's. */
double fracture_split_ratio(const fracture_settings *settings, polygon outline, const fracture_load *load,
                            double thickness, const crack_start *start, double *length);

/* Whether the load's radial crack runs through the floe; length gets the crack's. */
bool fracture_splits(const fracture_settings *settings, polygon outline, const fracture_load *load, double thickness,
                     const crack_start *start, double *length);

/* The stencil's 2 N points around the start, at the ends of cracks of this length [m]. */
enum { MOST_STENCIL = 64 };
int fracture_stencil(int32_t wedges, double side, const crack_start *start, vec2 out[MOST_STENCIL]);
typedef struct break_shape {
    vec2 outline[MOST_STENCIL + 4];
    int count;
    vec2 part[MOST_STENCIL + 1]
             [4]; /* the wedges, by falling angle from the first crack; then the strip, if there is one */
    int32_t corners[MOST_STENCIL + 1];
    int parts;
} break_shape;
/* The break that a failing load makes. */
break_size fracture_break_size(const fracture_settings *f, const fracture_load *l);
void fracture_shape(int32_t wedges, const crack_start *start, const break_size *size, break_shape *out);

/* Cut one ring by a shape: remnants and wedges are appended. */
fram_status fracture_bend(context *ctx, overlay *plane, const break_shape *shape, polygon ring, polygon_list *remnants,
                          polygon_list *wedges, fram_error *error);

/* Simple, and by so much that rounding in a shift of the origin does not spoil it. */
bool fracture_outline_is_sound(context *ctx, polygon p);

/* The part of one wedge inside a ring, appended to wedges; a convex ring needs no general overlay. */
fram_status fracture_cut_wedge(context *ctx, overlay *plane, polygon ring, bool convex, polygon corner,
                               polygon_list *wedges, fram_error *error);

/* Unite pieces i and k; *joined says whether that gave one ring, which then is piece k's. */
fram_status fracture_unite(context *ctx, fracture_scratch *s, overlay *plane, int32_t i, int32_t k, bool *joined,
                           fram_error *error);
void fracture_drop_piece(fracture_scratch *s, int32_t i);

/* Pieces that are too small or too narrow to be floes, or that no convex parts can be made of, are joined to the
   neighbour that they share the most boundary with, so that no ice is lost; those without one stay.  Pieces keep their
   order. */
fram_status fracture_join_dust(const fracture_job *j);

/* What is left of a floe moves as it did: held, carried or free. */
motion fracture_motion(const fracture_job *j, int32_t floe);

/* Outlines become the cut pieces: remnants with this motion and the wedges of a floe. */
bool fracture_gather(context *ctx, fracture_scratch *s, const polygon_list *rings, motion kind, int32_t tile,
                     int32_t wedge);

/* Too small to be a floe.  A part of a sheet need not be one, as long as it has a seam to hang on, and a convex part
   large enough for contacts. */
fram_status fracture_is_dust(const fracture_job *j, const cut_piece *piece, polygon ring, bool *dust);

/* Whether a ring has convex parts that contacts can be made with (bodies/shape.h). */
fram_status fracture_has_parts(const fracture_job *j, polygon ring, bool *has);

/* Pieces fewer than `least`, or so small that more than `most` [m2], or a thousandth of the parents' area, would be
   lost with them: nothing breaks.  bends: of an edge that gave, by the `bend` of the wedges, or NULL. */
typedef struct birth_terms {
    int32_t least;
    double most;
    const edge_bend *bends;
} birth_terms;

/* The parents (floe rows; more than one only of a level sheet) go; the gathered pieces are cleaned and become floes,
   and the event's books are filled in; their bodies are marked as broken.  *broke is false, and nothing has changed,
   when the terms are not met. */
fram_status fracture_birth(const fracture_job *j, const int32_t *parents, int32_t count, birth_terms terms,
                           fracture_event *event, bool *broke);
/* How the edge under a load stands as it breaks: not at all where the floe floats. */
edge_bend fracture_bend_of(const fracture_job *j, const fracture_load *l, const crack_start *start);

/* An event as its load tells it; place is global. */
fracture_event fracture_event_of(const fracture_load *l, vec3 place, fracture_kind kind, double length);

/* Bending of a level sheet under its failing loads, by falling stress over strength. */
fram_status fracture_break_sheet(const fracture_job *j, const fracture_load *load, int32_t count);
/* Static floes lose the ice whose place a hull has taken (docs/decisions/0041); *trimmed says whether any did. */
fram_status fracture_trim(const fracture_job *j, const crushing_patch_array *patches, bool *trimmed);
/* The index of tiles, made where this step has none yet. */
fram_status fracture_sheet_index(const fracture_job *j);
/* After a change of the sheet: the index anew, and the cells of sheet.touched among those that changed. */
fram_status fracture_sheet_changed(const fracture_job *j);
void fracture_sheet_touch(const fracture_job *j);
/* The start of a load's crack on the sheet as it stands, with the boundary around it in sheet.boundary.  A load farther
   than `reach` from any boundary breaks nothing: an edge is what it would bend. */
fram_status fracture_sheet_start(const fracture_job *j, vec2 load, double reach, double radius, crack_start *start,
                                 bool *found);
/* Loads farther than this from an edge do not break the sheet [m]. */
double fracture_sheet_reach(const tile_grid *g);
/* Length of a crack's ray to where ice ends, by sheet.boundary; past_held: it goes on beyond sides that are held. */
double fracture_sheet_crack_length(const fracture_job *j, const crack_start *start, double snap, bool past_held);
/* Adds the areas that the sheet has in common with each of these polygons to out. */
fram_status fracture_sheet_areas(const fracture_job *j, const vec2 *corner, const int32_t *size, int count,
                                 double *out);
/* What the queries of tiles look at. */
tile_sheet_view fracture_sheet_view(const fracture_job *j);

/* What hangs on no anchored side any more drifts; seams are marked anew.  After all loads of a step. */
fram_status fracture_release(const fracture_job *j);

#endif

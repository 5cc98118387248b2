/* Ice fields that were observed: rings as somebody else outlined them become sound floe outlines, moved, cut to a
   domain, simplified, and kept clear of a vessel, with a record of everything that was refused, left out or mended.
   Knows outlines and where they were written; must not know files, bodies or materials. One module with import_frame
   and import_parts. */
#ifndef ICE_IMPORT_H
#define ICE_IMPORT_H

#include "geometry/overlay.h"

/* Where a ring came from, for errors and notes. */
typedef struct import_place {
    int32_t feature, polygon, ring; /* from 1; ring 1 is the outline of its polygon, later ones are holes */
    int32_t line, column;           /* from 1 */
    bool open;                      /* its last position was not its first one */
    double thickness;               /* [m]; NaN: not given */
} import_place;

enum { IMPORT_NAME_SIZE = 64 };
/* "feature 17, polygon 2, ring 1" */
void import_place_name(const import_place *p, char out[IMPORT_NAME_SIZE]);

/* Rings as they were written, sound or not, without the repeated last position; place[i] belongs to ring i. */
typedef struct import_rings {
    polygon_list rings;
    ARRAY(import_place) place;
    int32_t passed_over; /* features that say they are no ice, */
    int32_t walls;       /* and of these walls */
} import_rings;
void import_rings_free(context *ctx, import_rings *r);

/* What is done with a ring that is no simple outline. */
typedef enum import_bad { IMPORT_REFUSE = 0, IMPORT_DROP, IMPORT_REPAIR } import_bad;

typedef struct import_options {
    const char *name; /* of the file, for errors */
    bool degrees; /* the rings are longitudes and latitudes on WGS 84 [deg], to be projected about their centre, which
                     goes to `offset`, with y to the north; scale must be 1 */
    double scale; /* lengths of the rings times this are metres; > 0 */
    bool centre;  /* the centre of the bounds of all rings goes to `offset`, instead of their origin */
    vec2 offset;  /* [m], added after scaling */
    bool crop;    /* floes are cut at the edge of `domain` */
    bool tile; /* with crop, where the field repeats itself beyond `domain`: all stay whole if they fit to their copies
                  and each lies in the domain or beside it, no farther off than it is wide */
    box2 domain;     /* [m] */
    bool window;     /* somebody chose `domain` for this file: words call it a window and name members, not keys */
    double simplify; /* largest distance by which an outline may change [m]; 0: not at all */
    import_bad bad;
    bool lengths;            /* the rings are such even if they look like degrees */
    const char *say_lengths; /* how somebody says that, for the refusal of others; NULL: by the scale, 1 too */
    bool as_it_is;           /* nobody chooses degrees, scale or bad: refusals do not name what could be chosen */
    double smallest_area;    /* floes and cut pieces under it are left out [m2] */
    const polygon_list
        *keep_out;          /* convex, counter-clockwise zones; floes that reach into them are left out; or NULL */
    double keep_out_margin; /* and those nearer to a zone than this [m] */
} import_options;

/* What happened to a ring.  Those from IMPORT_NOTE_OPEN to IMPORT_NOTE_HOLE are faults: IMPORT_REFUSE stops there. */
typedef enum import_event {
    IMPORT_NOTE_OPEN = 0, /* not closed; repair: closed */
    IMPORT_NOTE_FEW,      /* fewer than 3 different vertices; always left out */
    IMPORT_NOTE_FLAT,     /* no area; always left out */
    IMPORT_NOTE_CROSSED,  /* meets itself; repair: the outlines of all that it winds round */
    IMPORT_NOTE_HOLE,     /* a hole; drop and repair: filled with ice */
    IMPORT_NOTE_SMALL,    /* under the smallest area, whole or as a cut piece */
    IMPORT_NOTE_OUTSIDE,  /* outside the domain */
    IMPORT_NOTE_KEPT_OUT, /* in a keep-out zone */
    IMPORT_NOTE_OVERLAP,  /* repair: what it shares with a smaller floe is left to that one */
    IMPORT_NOTE_SLIVER,   /* repair: a piece that such a cut leaves is too thin for a floe */
    IMPORT_EVENT_COUNT
} import_event;
/* "crosses or touches itself"; window: of import_options */
const char *import_event_text(import_event event, bool window);

typedef struct import_note {
    int32_t ring; /* of import_rings */
    import_event event;
    bool dropped; /* nothing came of the ring or of this piece of it; otherwise it was mended */
    vec2 at;      /* where it crosses itself; otherwise its first vertex, if it has one [m] */
} import_note;

/* Sound floes: simple, counter-clockwise, with area.  ring[i] and thickness[i] belong to outline i. */
typedef struct import_field {
    polygon_list outlines;
    int32_array ring;
    ARRAY(double) thickness; /* [m]; NaN: not given */
    ARRAY(import_note) notes;
} import_field;
void import_field_free(context *ctx, import_field *f);

/* out must be empty; on failure it still is.  FRAM_ERROR_INPUT, with line, column and the ring's name as key, for a
   fault under IMPORT_REFUSE, for coordinates beyond 1e9 m and when no floe is left.  Floes come in the order of the
   rings. */
fram_status import_field_make(context *ctx, overlay *o, const import_rings *rings, const import_options *options,
                              import_field *out, fram_error *error);

/* What a field of outlines is.  Also for fields from elsewhere. */
enum { IMPORT_HISTOGRAM_BINS = 12 };
typedef struct import_measure {
    int32_t floes, vertices, concave;
    box2 bounds;                        /* of the outlines [m] */
    double area;                        /* [m2] */
    double largest_diameter;            /* [m] */
    double smallest_area, largest_area; /* [m2] */
    int32_t overlaps;                   /* pairs that share area */
    double overlap_area;                /* of all pairs together [m2] */
    double largest_overlap;             /* the largest common area of a pair [m2] */
    int32_t overlap_pair[2];            /* of it; -1, -1: none */
    /* The largest width of a part that a pair has in common: the shorter side of the box around the widest of its
       convex pieces, or of the rectangle of its area and perimeter (no wider than the box around it) where that is more
       [m]. */
    double overlap_width;
    /* Floes by diameter of the circle of equal area: bin i holds up to edge[i+1], edge[i] excluded (but for the first).
     */
    double edge[IMPORT_HISTOGRAM_BINS + 1]; /* [m] */
    int32_t bin[IMPORT_HISTOGRAM_BINS];
} import_measure;
/* Common area under 1e-12 of the areas of both is rounding and counts as none.  No outlines give zeros.  name: of
   their file for errors, or NULL.  FRAM_ERROR_INPUT when more lie over one another than a field can have (ice/crowd.h).
 */
fram_status import_field_measure(context *ctx, overlay *o, const char *name, const polygon_list *outlines,
                                 import_measure *out, fram_error *error);

#endif

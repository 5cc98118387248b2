/* Fram: ice fields from files.  Read outlines that were observed, scale and cut them, mend or leave out what is no
   floe, see what the field is, draw it, write it.

       fram_field *field;
       fram_field_summary summary;
       fram_field_load(context, "floes.geojson", NULL, &field, &error);
       fram_field_summary_get(field, &summary);
       printf("%d floes, %g m2\n", summary.floes, summary.area);
       fram_field_destroy(field);

   Units are SI; coordinates are planar: x along the global X, y along Y.  Rules about statuses, errors and threads
   stand in fram.h; a context must outlive its fields. */
#ifndef FRAM_FIELD_H
#define FRAM_FIELD_H

#include "fram/fram.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Outlines of floes: simple, counter-clockwise, with area.  Never changes. */
typedef struct fram_field fram_field;

/* --- Making one --- */

/* What is done with a ring that is no simple outline: open, too few vertices, without area, crossing itself, a hole. */
typedef enum fram_field_bad {
    FRAM_FIELD_REFUSE = 0, /* the file is refused at the first one */
    FRAM_FIELD_DROP = 1,   /* it is left out; a hole is filled with ice */
    FRAM_FIELD_REPAIR = 2  /* it is closed, and replaced by the outline of all that it winds round, if that has area;
                              what floes share is left to the smaller one */
} fram_field_bad;

typedef struct fram_field_definition {
    size_t size;          /* of this struct, set by fram_field_default */
    double scale;         /* lengths of the file times this are metres; > 0, default 1 */
    bool centre;          /* the centre of the bounds of all rings goes to `offset`, instead of the file's origin */
    double offset[2];     /* [m], default 0, 0 */
    bool crop;            /* floes are cut at the edge of crop_lo .. crop_hi */
    double crop_lo[2];    /* [m] */
    double crop_hi[2];    /* [m] */
    double simplify;      /* largest distance by which an outline may change [m]; default 0: not at all */
    fram_field_bad bad;   /* default FRAM_FIELD_REFUSE */
    double smallest_area; /* smaller floes and cut pieces are left out [m2]; default 0 */
} fram_field_definition;
FRAM_API void fram_field_default(fram_field_definition *definition);
/* From GeoJSON, WKT (POLYGON and MULTIPOLYGON) or plain lines of x and y with a blank line after each outline, told
   apart by the first character.  definition NULL: the defaults.  FRAM_ERROR_INPUT, with line, column and ring ("feature
   17, polygon 1, ring 1") as key, when the file cannot be read or a ring is refused; with the member's name as key when
   the definition is wrong. */
FRAM_API fram_status fram_field_load(fram_context *context, const char *path, const fram_field_definition *definition,
                                     fram_field **field, fram_error *error);
FRAM_API void fram_field_destroy(fram_field *field);

/* --- What it is --- */

enum { FRAM_FIELD_BINS = 12 };

typedef struct fram_field_summary {
    int rings;    /* of the file */
    int floes;    /* that came of them */
    int dropped;  /* rings or cut pieces that were left out */
    int repaired; /* rings that were mended */
    int vertices, concave;
    double lo[2], hi[2];     /* corners of the box around the floes [m] */
    double area;             /* of the floes [m2] */
    double concentration;    /* area over that of the crop window, or of the box around the floes without one [1] */
    double largest_diameter; /* [m] */
    double smallest_area, largest_area; /* [m2] */
    int overlaps;                       /* pairs of floes that share area */
    double overlap_area;                /* of all pairs together [m2] */
    double overlap_width;               /* the largest width of what a pair shares [m] */
    int overlap_features[2];            /* features (from 1) of the pair that shares the largest area; 0, 0: none */
    /* Floes by the diameter of the circle of equal area: bin[i] holds those over bin_edge[i] up to bin_edge[i+1]. */
    double bin_edge[FRAM_FIELD_BINS + 1]; /* [m] */
    int bin[FRAM_FIELD_BINS];
} fram_field_summary;
FRAM_API void fram_field_summary_get(const fram_field *field, fram_field_summary *summary);

/* What happened to a ring, in the file's order. */
typedef struct fram_field_note {
    int feature, polygon, ring; /* from 1 */
    int line;                   /* of the file */
    bool dropped;               /* left out, or this piece of it; otherwise mended */
    const char *reason;         /* "crosses or touches itself" */
} fram_field_note;
/* Number of notes; up to `room` of them are copied to notes, which may be NULL with room 0. */
FRAM_API int fram_field_notes(const fram_field *field, fram_field_note *notes, int room);

/* Number of vertices of a floe (from 0), 0 for no floe; up to `room` of them (x, y) are copied to vertices, which may
   be NULL with room 0. */
FRAM_API int fram_field_outline(const fram_field *field, int floe, double *vertices, int room);

/* --- Drawings, files --- */

/* Seen from above, as PNG; title may be NULL.  FRAM_ERROR_UNSUPPORTED in a build without pictures. */
FRAM_API fram_status fram_field_draw(const fram_field *field, const char *title, const char *path, fram_error *error);
/* As GeoJSON whose numbers read back to the bit. */
FRAM_API fram_status fram_field_save(const fram_field *field, const char *path, fram_error *error);

#ifdef __cplusplus
}
#endif
#endif

/* Fram: ice fields from files and from scenarios.  Read outlines that were observed, scale and cut them, mend or leave
   out what is no floe; or make the field that a run of a scenario starts with; see what it is, draw it, write it.

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
    bool degrees;         /* the file holds longitudes and latitudes (WGS 84), which are laid flat about the centre of
                             all rings; that goes to `offset`, with y to the north; scale must be 1; default false */
    bool lengths;         /* the file holds lengths, even if they look like degrees, as those of small floes 37 to 90 m
                             from the origin of a tank; default false: such a file is refused with scale 1 */
} fram_field_definition;
FRAM_API void fram_field_default(fram_field_definition *definition, size_t size);
#define fram_field_default(definition) fram_field_default((definition), sizeof *(definition))
/* From GeoJSON, WKT (POLYGON and MULTIPOLYGON) or plain lines of x and y with a blank line after each outline, told
   apart by the first character.  definition NULL: the defaults.  FRAM_ERROR_INPUT, with line, column and ring ("feature
   17, polygon 1, ring 1") as key, when the file cannot be read or a ring is refused; with the member's name as key when
   the definition is wrong. */
FRAM_API fram_status fram_field_load(fram_context *context, const char *path, const fram_field_definition *definition,
                                     fram_field **field, fram_error *error);
/* The field that a run of the scenario starts with, to the bit, of ice.source voronoi, packed or file; under
   domain.boundary: feeding the whole tile that repeats itself, before vessels and open water are cut out of it.
   FRAM_ERROR_INPUT, with the key, for a scenario without a field and for a field that cannot be made, saying what was
   reached and why.  The scenario may go before the field. */
FRAM_API fram_status fram_field_generate(const fram_scenario *scenario, fram_field **field, fram_error *error);
FRAM_API void fram_field_destroy(fram_field *field);

/* --- What it is --- */

enum { FRAM_FIELD_BINS = 12 };

typedef struct fram_field_summary {
    int rings;    /* of the file, also of that of a scenario */
    int floes;    /* that came of them */
    int dropped;  /* rings or cut pieces that were left out */
    int repaired; /* mendings; a ring may have several, as one that was closed and then cut */
    int vertices, concave;
    double lo[2], hi[2];     /* corners of the box around the floes [m] */
    double area;             /* of the floes [m2] */
    double concentration;    /* area over that of the crop window, domain or tile, or of the box around the floes [1] */
    double largest_diameter; /* [m] */
    double smallest_area, largest_area; /* [m2] */
    int overlaps;                       /* pairs of floes that share area */
    double overlap_area;                /* of all pairs together [m2] */
    double overlap_width;               /* the largest width of what a pair shares [m] */
    int overlap_features[2];            /* features (from 1) of the pair that shares the largest area: of the file, of
                                           drawn floes of the one that fram_field_save writes; 0, 0: none, and 0 for a
                                           drawn floe among those of a file */
    /* Floes by the diameter of the circle of equal area: bin[i] holds those over bin_edge[i] up to bin_edge[i+1]. */
    double bin_edge[FRAM_FIELD_BINS + 1]; /* [m] */
    int bin[FRAM_FIELD_BINS];
    int passed_over; /* features of a file that say they are no ice: kind "vessel" or "wall", as exports write them */
    int overlap_polygons[2]; /* polygons (from 1) of overlap_features, 0 where those are */
} fram_field_summary;
FRAM_API void fram_field_summary_get(const fram_field *field, fram_field_summary *summary, size_t size);
#define fram_field_summary_get(...) fram_field_summary_get(__VA_ARGS__, sizeof(fram_field_summary))

/* What happened to a ring, in the file's order. */
typedef struct fram_field_note {
    int feature, polygon, ring; /* from 1 */
    int line;                   /* of the file */
    bool dropped;               /* left out, or this piece of it; otherwise mended */
    const char *reason;         /* "crosses or touches itself" */
    bool outside;               /* left out as outside of the window or domain */
} fram_field_note;
/* Number of notes; up to `room` of them are copied to notes, which may be NULL with room 0. */
FRAM_API int fram_field_notes(const fram_field *field, fram_field_note *notes, int room, size_t size);
#define fram_field_notes(...) fram_field_notes(__VA_ARGS__, sizeof(fram_field_note))

/* Number of vertices of a floe (from 0), 0 for no floe; up to `room` of them (x, y) are copied to vertices, which may
   be NULL with room 0. */
FRAM_API int fram_field_outline(const fram_field *field, int floe, double *vertices, int room);

/* Ice area over the area of the window lo .. hi, each x and y [1]; exact where floes do not overlap.  A field generated
   under domain.boundary: feeding goes on beyond its tile, for windows and the cover map.  NaN for a window without
   area. */
FRAM_API double fram_field_concentration(const fram_field *field, const double lo[2], const double hi[2]);

/* --- How it was made --- */

typedef struct fram_field_making {
    double target;          /* concentration that was asked for, NaN for floes of a file alone [1] */
    double reached;         /* ice area over the area free for ice [1] */
    double free_area;       /* domain less the vessel, its margin and open water [m2] */
    double largest_overlap; /* the least way that parts the two floes that overlap most; 0 when none do [m] */
    int populations;        /* of drawn floes; 0 for Voronoi cells and floes of a file */
    int placed;             /* floes that were not drawn: cells, floes of a file; they come first */
    int rounds, moves;      /* of the packing: rounds, floes carried into open water */
    double area_change;     /* of a drawn floe by being moved, the largest, relative: rounding */
    int vertex_changes;     /* drawn floes whose number of vertices was changed by being moved */
    bool tile;              /* the field is the tile that repeats itself (domain.boundary: feeding), not the domain */
    double tile_x, tile_y;  /* after which it does, 0 for a domain [m] */
} fram_field_making;
/* false, and nothing is written, for a field of a file. */
FRAM_API bool fram_field_making_get(const fram_field *field, fram_field_making *making, size_t size);
#define fram_field_making_get(...) fram_field_making_get(__VA_ARGS__, sizeof(fram_field_making))

/* A population against the law of size that was asked for. */
typedef struct fram_field_population {
    int floes;
    double area;          /* [m2] */
    double size_distance; /* Kolmogorov and Smirnov's, by number, of the diameters of the circles of equal area; for a
                             law of one diameter the part of the floes more than 1 % off it [1] */
    /* Floes, and what the law expects of so many, in the bins of fram_field_summary's kind. */
    double bin_edge[FRAM_FIELD_BINS + 1]; /* [m] */
    int bin[FRAM_FIELD_BINS];
    double expected[FRAM_FIELD_BINS];
} fram_field_population;
/* FRAM_ERROR_USAGE for a number (from 0) that is none. */
FRAM_API fram_status fram_field_population_get(const fram_field *field, int number, fram_field_population *population,
                                               fram_error *error, size_t size);
#define fram_field_population_get(...) fram_field_population_get(__VA_ARGS__, sizeof(fram_field_population))

/* --- Drawings, files --- */

/* Not over a file that the field is made of, the scenario that it is of among them: FRAM_ERROR_USAGE, key "path". */

/* Seen from above, as SVG when path ends in .svg, else as PNG; title may be NULL.  FRAM_ERROR_UNSUPPORTED in a build
   without pictures. */
FRAM_API fram_status fram_field_draw(const fram_field *field, const char *title, const char *path, fram_error *error);
/* The cover map: concentration in square cells of about `cell` [m], 0: a fortieth of the longer side. */
FRAM_API fram_status fram_field_draw_cover(const fram_field *field, double cell, const char *title, const char *path,
                                           fram_error *error);
/* A row per floe, as CSV: diameter of the circle of equal area, area, vertices, thickness (where known), its population
   (from 0; -1: not drawn), and area and vertices of the shape that was drawn before it had a place. */
FRAM_API fram_status fram_field_table(const fram_field *field, const char *path, fram_error *error);
/* As GeoJSON whose numbers read back to the bit: outlines and thickness.  Strengths of populations, and which of their
   floes break, are not in it; the log warns where there are such. */
FRAM_API fram_status fram_field_save(const fram_field *field, const char *path, fram_error *error);

#ifdef __cplusplus
}
#endif
#endif

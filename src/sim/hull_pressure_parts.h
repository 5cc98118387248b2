/* Inside hull_pressure: what panels have borne, and the files of it.  One module with hull_pressure.h. */
#ifndef SIM_HULL_PRESSURE_PARTS_H
#define SIM_HULL_PRESSURE_PARTS_H

#include "io/text_buffer.h"
#include "model/mechanism.h"
#include "model/scenario.h"
#include "sim/hull_pressure.h"
#include "sim/patch_area.h"

/* Of one panel. */
typedef struct panel_load {
    double step;  /* normal force of this step [N] */
    vec3 force;   /* of this step, friction included, ship axes [N] */
    double sum;   /* integral of the normal force over time [N s] */
    vec3 impulse; /* integral of the force over time [N s] */
    double most;  /* largest normal force of a step [N] */
    double when;  /* at which time [s] */
} panel_load;

/* Rectangles of panels that the curve of pressure over area looks at: columns by rows. */
typedef struct window_shape {
    int32_t columns, rows;
} window_shape;
enum { WINDOW_SHAPES = 20 };
extern const window_shape window_shapes[WINDOW_SHAPES];
typedef struct window_most {
    double pressure, area, time; /* [Pa], [m2], [s]; area 0: there is none of this shape */
} window_most;

/* The cells of a patch as a table of panels, to sum windows in one look. */
typedef struct window_grid {
    int32_t first_column, first_row, columns, rows; /* columns 0: no panels */
    int32_t table;                                  /* where its sums begin, (columns + 1) (rows + 1) of them */
    bool touched;
} window_grid;

typedef struct pressure_map {
    context *ctx;
    const pressure_options *o;
    scenario s;
    int32_t vessel; /* row */
    vec3 centre;    /* of its mass, ship coordinates */
    double end;     /* of the time that is looked at [s] */
    int64_t last;   /* step that ends by then */
    hull_panels panels;
    panel_load *load;    /* by panel */
    int32_array touched; /* panels of this step */
    window_grid *grid;   /* by patch */
    double *sum_area;    /* summed-area tables of all grids: area, cells that have a panel, force of the step */
    double *sum_cells;
    double *sum_force;
    window_most most[WINDOW_SHAPES];
    vec3 part[ZONE_COUNT][MECHANISM_COUNT]; /* impulse by zone and mechanism, ship axes [N s] */
    double time;                            /* looked at [s] */
} pressure_map;

/* Whether pressure_write_files writes a file of this name. */
bool pressure_is_file(const char *name);
/* The panels of the hull, and room for their loads. */
fram_status pressure_begin(pressure_map *p, const mesh *hull, fram_error *error);
void pressure_free(pressure_map *p);
/* A point of a contact in a step, in ship coordinates: where, its normal force and its friction (ship axes), spread
   over the part of the area that it stands for.  false: no memory. */
bool pressure_add(pressure_map *p, const patch_area *area, vec3 point, vec3 normal, vec3 friction);
/* At the end of a step, after all of its contacts. */
void pressure_end_step(pressure_map *p, double time, double time_step);

fram_status pressure_write_files(pressure_map *p, fram_error *error);
/* FRAM_OK without cairo too, without a picture. */
fram_status pressure_draw(pressure_map *p, const char *path, fram_error *error);

#endif

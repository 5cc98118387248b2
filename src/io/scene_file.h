/* The text scenes of the benchmark peers, format `icescene 1` (bench/peers/README.md): convex floes in a walled basin
   and a box ship driven at constant speed.  One statement a line, SI units, z = 0 is the water surface.
   Knows the text, not what a benchmark does with it. */
#ifndef IO_SCENE_FILE_H
#define IO_SCENE_FILE_H

#include "geometry/polygon.h"

/* Bounds of what is read: far beyond any benchmark, far below what would exhaust memory or arithmetic. */
enum { SCENE_MOST_FLOES = 1 << 20, SCENE_MOST_SIDES = 16, SCENE_MOST_BYTES = 1 << 29 };

typedef struct scene_floe {
    double thickness; /* [m] */
    double density;   /* [kg/m3] */
    vec2 centre;      /* [m] */
    int32_t first;    /* of its vertices in scene_text.vertices */
    int32_t count;
} scene_floe;

typedef struct scene_text {
    double gravity;       /* [m/s2] */
    double water_density; /* [kg/m3] */
    vec2 current;         /* [m/s] */
    double form_drag, skin_drag, friction;
    box2 domain; /* inner faces of the four walls [m] */
    bool ship;
    double ship_length, ship_beam, ship_depth, ship_draught; /* [m] */
    vec2 ship_centre;                                        /* at the start [m] */
    vec2 ship_velocity;                                      /* constant [m/s] */
    ARRAY(scene_floe) floes;
    vec2_array vertices; /* of all floes, each about its centre, counter-clockwise [m] */
} scene_text;

/* The scene of a file.  FRAM_ERROR_INPUT names file and line of what is wrong: an unknown statement, a value that is no
   number or out of range, a floe that is not convex or not about its centre, a scene without walls or floes.  On
   failure *out is empty. */
fram_status scene_file_read(context *ctx, const char *path, scene_text *out, fram_error *error);
/* The same of a text in memory, which is cut into words on the way; text[size] must be a NUL. */
fram_status scene_text_parse(context *ctx, const char *name, char *text, size_t size, scene_text *out,
                             fram_error *error);
void scene_text_free(context *ctx, scene_text *s);
/* Outline of a floe about its centre. */
polygon scene_floe_outline(const scene_text *s, int32_t floe);

#endif

/* The record of a run, frame by frame: what every exporter, picture and report of a finished run reads.  Follows the
   layout in io/record_layout.h; must not know what is made of it. */
#ifndef RESULTS_REPLAY_H
#define RESULTS_REPLAY_H

#include "bodies/body.h"
#include "geometry/polygon.h"
#include "io/record_blocks.h"

/* A body of the record.  Bodies are listed by birth and stay listed when they are gone. */
typedef struct replay_body {
    int32_t slot;
    uint8_t material; /* enum material */
    bool moves, solid, breakable;
    bool level;                         /* a tile of level ice */
    double thickness;                   /* of a prism [m] */
    double density;                     /* of a floe [kg/m3] */
    double area;                        /* of a prism's outline [m2] */
    int32_t number, parent;             /* running numbers of a floe and of the one it broke from; -1: none */
    int32_t vessel;                     /* row in the scenario of a hull's vessel; -1: no hull */
    int32_t vertex_first, vertex_count; /* prism: in replay.outlines; solid: in replay.points */
    int32_t face_first, face_count;     /* solid: triangles in replay.faces */
    bool looked_at;                     /* solid: whether its parts were looked for (results/replay_parts.h) */
    int32_t part_first, part_count;     /* solid that is open: rings in replay.parts */
    int64_t born;                       /* number of the first frame with it */
    double birth;                       /* of a piece the time of the break, otherwise of that first frame [s] */
    vec3 position;                      /* of a body that does not move */
    quat orientation;
    vec3 velocity; /* last one known, see replay_pose */
} replay_body;

typedef struct replay_pose {
    int32_t body; /* in replay.bodies */
    vec3 position;
    quat orientation;
    vec3 velocity;        /* way to the next frame over its time; in a body's last frame that of its sheet (a tile), of
                             the way from the frame before, of what it broke from, or, where no frame has that, of the
                             sheet that drifts, 0 without one [m/s] */
    double contact_force; /* sum of the magnitudes at its contacts; 0 for a body that does not move [N] */
} replay_pose;

typedef struct replay_force {
    record_force_kind kind;
    int32_t vessel; /* that it is on, row in the scenario; -1: a record of several by an earlier Fram tells none */
    int32_t which;  /* line or thruster, from 1; floe, hull or wall, in replay.bodies, or -1 */
    vec3 point;     /* [m] */
    vec3 force;     /* on the vessel [N] */
} replay_force;

typedef struct replay_frame {
    int64_t number, step;
    double time;
    vec3 ice_force;           /* on the first vessel, averaged [N] */
    ARRAY(replay_pose) poses; /* of all bodies that are there, those that do not move last */
    ARRAY(replay_force) forces;
} replay_frame;

typedef struct replay {
    context *ctx;
    record_reader reader;
    vec2 origin;     /* of its places; those of this reader are global [m] */
    char *scenario;  /* text */
    int32_t vessels; /* hulls so far: a run's are recorded in the scenario's order */
    ARRAY(replay_body) bodies;
    vec2_array outlines;
    ARRAY(vec3) points;
    int32_array faces;
    polygon_list parts;               /* of solids that are open, upright and about their centres of mass */
    ARRAY(record_fracture) fractures; /* all up to the next frame */
    replay_frame frame;               /* the current one */
    /* Inside: */
    replay_frame next;
    bool has_next;
    int64_t frames_read;
    int32_array at_slot;  /* body in each slot, -1 */
    int32_array next_row; /* scratch: row of each body in `next`, -1 */
} replay;

/* The record of a run's folder.  FRAM_ERROR_INPUT when there is none (results/run_record.h), when it holds no frame, or
   when an earlier Fram wrote it.  A record that is damaged or was cut short is read up to there, with a warning in the
   log. */
fram_status replay_open(context *ctx, const char *folder, replay *r, fram_error *error);
/* The same, but that a record which holds no frame is none that fails: there is no first frame. */
fram_status replay_open_any(context *ctx, const char *folder, replay *r, fram_error *error);
/* To the next frame; found is false after the last. */
fram_status replay_next(replay *r, bool *found, fram_error *error);
void replay_close(replay *r);

polygon replay_outline(const replay *r, const replay_body *b);
/* Body of a vessel by its row in the scenario, -1 before it is there. */
int32_t replay_hull(const replay *r, int32_t vessel);
/* Length and breadth of a vessel's hull over all, in its own axes [m]; 0 before it is there. */
vec2 replay_hull_size(const replay *r, int32_t vessel);

#endif

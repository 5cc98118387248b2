/* A moment of a run in space, as the playback page shows it: hull, floes, water, arrows of forces, marks of fractures,
   with scale, axes and colours told. */
#ifndef RESULTS_VIDEO_SCENE_H
#define RESULTS_VIDEO_SCENE_H

#include "io/image.h"
#include "results/replay_plan.h"

typedef enum video_camera {
    VIDEO_PLAN = 0, /* from above, as io/plan_view.h draws it */
    VIDEO_ORBIT,    /* the whole field from one side */
    VIDEO_FOLLOW,   /* near the first vessel, moving with it */
    VIDEO_CAMERA_COUNT
} video_camera;
/* "plan", as on the command line. */
const char *video_camera_name(video_camera camera);

typedef struct video_scene {
    video_camera camera;
    box2 extent; /* of the field: bodies' places but those of walls [m] */
    box2 whole;  /* of all that there is, whole [m] */
    double top;  /* of that, over still water [m] */
    double near; /* what VIDEO_FOLLOW sees across [m] */
    plan_colour colour;
    double lo, hi;    /* what the ends of the colours stand for */
    double arrow;     /* [m/N]; 0: none */
    double mark_time; /* fractures stay marked so long [s] */
    const char *title, *caption;
} video_scene;

#ifdef FRAM_HAVE_CAIRO
/* Into the rectangle of width x height pixels from the origin of a page that is an RGB24 image. */
fram_status video_scene_draw(context *ctx, const video_scene *s, const replay *r, const replay_moment *m, cairo_t *page,
                             int width, int height, fram_error *error);
#endif

#endif

/* A run as a video: the field in space or from above, coloured, with force arrows, fracture marks and the load curve.
 */
#ifndef RESULTS_VIDEO_H
#define RESULTS_VIDEO_H

#include "results/video_scene.h"

typedef struct video_options {
    const char *output; /* NULL: FOLDER/run.mp4, or the folder FOLDER/video */
    plan_colour colour;
    video_camera camera;
    double speed; /* simulated seconds per second of video; <= 0: such that it lasts 30 s at most, 1 at least */
    double span;  /* metres across, VIDEO_PLAN following the vessel; <= 0: the whole domain */
    int frames_per_second;
    int width, height; /* [pixels], even */
    bool pictures;     /* numbered PNG files in the folder `output` (FOLDER/video) instead of a video */
    bool force;        /* pictures: though the folder is not empty; those of a longer series go */
} video_options;

/* frames: how many there are.  path: what was written, at least 1024 bytes.  FRAM_INTERRUPTED when the context's stop
   flag is set: no video is left then, and of the pictures those that were drawn. */
fram_status video_write(context *ctx, const char *folder, const video_options *options, int64_t *frames, char *path,
                        fram_error *error);

#endif

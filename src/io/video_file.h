/* MP4 files: frames of pixels piped to ffmpeg, which must be installed.  The file is whole or not there. */
#ifndef IO_VIDEO_FILE_H
#define IO_VIDEO_FILE_H

#include "base/context.h"

#include <stdbool.h>

enum { VIDEO_SAID = 2048 };

typedef struct video_file {
    context *ctx;
    char *path, *temporary;
    int socket; /* to ffmpeg's standard input */
    int words;  /* from its standard error; -1 once nobody holds that */
    int process;
    char said[VIDEO_SAID]; /* the last of its words so far */
    int said_count;
    bool said_more; /* before them */
} video_file;

/* FRAM_ERROR_UNSUPPORTED when ffmpeg cannot be started.  width and height: even. */
fram_status video_begin(context *ctx, const char *path, int width, int height, int frames_per_second, video_file *v,
                        fram_error *error);
/* One frame of width x height pixels of 4 bytes: blue, green, red, unused.  FRAM_INTERRUPTED, here and at the end, when
   the context is to stop while ffmpeg is waited for. */
fram_status video_frame(video_file *v, const void *pixels, size_t size, fram_error *error);
/* Wait for ffmpeg, not for what it leaves behind, and give the file its name.  What an ffmpeg said that made the video
   all the same is a warning. */
fram_status video_end(video_file *v, fram_error *error);
void video_abandon(video_file *v);

#endif

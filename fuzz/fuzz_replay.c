/* The reader of a run's bodies, frames, forces and fractures on any bytes, which playback, exports, reports and videos
   stand on.
   Promises: reading ends; what a frame names is there; outlines and triangles lie inside their tables; a refusal says
   why. */
#include "fuzzing.h"
#include "fuzzing_record.h"
#include "results/replay_moment.h"

#include <unistd.h>

enum { FRAMES_MOST = 2000 };

static void look_at_body(const replay *r, const replay_body *b)
{
    if (b->solid) {
        PROMISE(b->vertex_first >= 0 && b->vertex_count <= r->points.count - b->vertex_first);
        PROMISE(b->face_first >= 0 && b->face_count <= r->faces.count / 3 - b->face_first);
    } else {
        polygon outline = replay_outline(r, b);
        double sum = 0;
        for (int32_t i = 0; i < outline.count; i++)
            sum += outline.vertex[i].x;
        PROMISE(outline.count >= 3 && sum == sum);
    }
}

static void look_at_frame(const replay *r)
{
    const replay_frame *f = &r->frame;
    for (int32_t i = 0; i < f->poses.count; i++) {
        PROMISE(f->poses.data[i].body >= 0 && f->poses.data[i].body < r->bodies.count);
        look_at_body(r, &r->bodies.data[f->poses.data[i].body]);
    }
    for (int32_t i = 0; i < f->forces.count; i++)
        PROMISE(f->forces.data[i].kind != RECORD_FORCE_ICE || f->forces.data[i].which < r->bodies.count);
}

static void read_all(context *ctx, replay *r)
{
    replay_moment m = {0};
    fram_error error = {0};
    bool found = true;
    for (int i = 0; i < FRAMES_MOST && found; i++) {
        if (replay_next(r, &found, &error) != FRAM_OK) {
            PROMISE(error.message[0] != '\0');
            break;
        }
        if (!found)
            break;
        look_at_frame(r);
        if (i == 1)
            (void)replay_moment_now(r, &m, &error);
    }
    replay_moment_free(ctx, &m);
}

/* One for all inputs: at the program's end nothing else knows it. */
static char folder[64], record[96];

static void remove_folder(void)
{
    (void)unlink(record);
    (void)rmdir(folder);
}

/* A folder whose record.fram is the file in memory; the same one as long as its descriptor has the same number. */
static const char *folder_with(const char *file)
{
    static char linked[64];
    if (!folder[0]) {
        snprintf(folder, sizeof folder, "/tmp/fram-fuzz-XXXXXX");
        if (!mkdtemp(folder) || atexit(remove_folder) != 0)
            abort();
        snprintf(record, sizeof record, "%s/record.fram", folder);
    }
    if (strcmp(linked, file) != 0) {
        (void)unlink(record);
        if (symlink(file, record) != 0)
            abort();
        snprintf(linked, sizeof linked, "%s", file);
    }
    return folder;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    context ctx;
    context_init(&ctx);
    memory_file file = record_file(data, size);
    if (file.descriptor < 0)
        return 0;
    replay r;
    fram_error error = {0};
    if (replay_open(&ctx, folder_with(file.path), &r, &error) == FRAM_OK) {
        read_all(&ctx, &r);
        replay_close(&r);
    } else {
        PROMISE(error.message[0] != '\0');
    }
    memory_file_close(&file);
    return 0;
}

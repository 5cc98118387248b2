/* Videos through ffmpeg; where it is missing there is nothing to test. */
#include "io/video_file.h"

#include "scratch.h"

#include <signal.h>
#include <sys/resource.h>

enum { WIDTH = 64, HEIGHT = 48, FRAMES = 3 };

static void put_frames(video_file *v)
{
    static unsigned char pixels[4 * WIDTH * HEIGHT];
    fram_error e;
    for (int i = 0; i < FRAMES; i++)
        assert_ok(video_frame(v, pixels, sizeof pixels, &e), e);
}

/* Players need not guess which colours they are; where ffprobe is missing nobody says. */
static void check_colours(const char *path)
{
    char command[500], told[200] = "";
    snprintf(command, sizeof command,
             "ffprobe -v error -show_entries stream=color_range,color_space,color_transfer,color_primaries "
             "-of csv=p=0 %s 2>/dev/null",
             path);
    FILE *probe = popen(command, "r");
    ck_assert_ptr_nonnull(probe);
    const char *line = fgets(told, sizeof told, probe);
    if (pclose(probe) == 0)
        ck_assert_msg(line && strcmp(told, "tv,bt709,bt709,bt709\n") == 0, "colours: %s", told);
}

/* The first ends while the second still goes on: their programs do not hold each other's frames.  And the second is
   given up while its program waits for the next. */
START_TEST(two_at_once)
{
    context ctx;
    fram_error e = {0};
    video_file first, second;
    scratch s = scratch_make();
    context_init(&ctx);
    fram_status status = video_begin(&ctx, scratch_path(&s, "first.mp4"), WIDTH, HEIGHT, 10, &first, &e);
    if (status == FRAM_ERROR_UNSUPPORTED) {
        ck_assert_int_eq(rmdir(s.folder), 0);
        return;
    }
    assert_ok(status, e);
    assert_ok(video_begin(&ctx, scratch_path(&s, "second.mp4"), WIDTH, HEIGHT, 10, &second, &e), e);
    put_frames(&first);
    put_frames(&second);
    assert_ok(video_end(&first, &e), e);
    ck_assert_int_eq(access(scratch_path(&s, "first.mp4"), R_OK), 0);
    check_colours(s.path);
    ck_assert_int_eq(access(scratch_path(&s, "second.mp4"), F_OK), -1);
    video_abandon(&second);
    scratch_remove(&s, "first.mp4");
}
END_TEST

/* As on a full disk: what was there stays, and nothing half-written takes its name. */
START_TEST(no_room_for_the_file)
{
    context ctx;
    fram_error e = {0};
    video_file video;
    scratch s = scratch_make();
    context_init(&ctx);
    struct rlimit before, limit;
    ck_assert_int_eq(getrlimit(RLIMIT_FSIZE, &before), 0);
    limit = before;
    limit.rlim_cur = 512;
    ck_assert(signal(SIGXFSZ, SIG_IGN) != SIG_ERR); /* and so it is to ffmpeg */
    ck_assert_int_eq(setrlimit(RLIMIT_FSIZE, &limit), 0);
    fram_status status = video_begin(&ctx, scratch_path(&s, "full.mp4"), WIDTH, HEIGHT, 10, &video, &e);
    if (status == FRAM_OK) {
        put_frames(&video);
        status = video_end(&video, &e);
    }
    ck_assert_int_eq(setrlimit(RLIMIT_FSIZE, &before), 0);
    if (status != FRAM_ERROR_UNSUPPORTED) {
        ck_assert_int_eq(status, FRAM_ERROR_IO);
        ck_assert_ptr_nonnull(strstr(e.message, "ffmpeg could not make the video"));
    }
    ck_assert_int_eq(rmdir(s.folder), 0);
}
END_TEST

TEST_MAIN("video_file", two_at_once, no_room_for_the_file)

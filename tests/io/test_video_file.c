/* Videos through ffmpeg; where it is missing there is nothing to test. */
#include "io/video_file.h"

#include "scratch.h"

#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/stat.h>

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

/* A script of ours in ffmpeg's place, which has the path of the video as $file. */
static void be_ffmpeg(scratch *s, const char *script)
{
    char text[800], path[400];
    snprintf(text, sizeof text, "#!/bin/sh\nfor file; do :; done\nfile=${file#file:}\n%s\n", script);
    scratch_write(scratch_path(s, "ffmpeg"), text, strlen(text));
    ck_assert_int_eq(chmod(s->path, 0700), 0);
    snprintf(path, sizeof path, "%s:%s", s->folder, getenv("PATH"));
    ck_assert_int_eq(setenv("PATH", path, 1), 0);
}

static void keep_warning(void *user, log_level level, const char *text)
{
    if (level == LOG_WARNING)
        snprintf(user, 500, "%s", text);
}

/* The last of its words are told, in whole lines, of a video that could not be made and of one that could. */
START_TEST(last_words_are_told)
{
    for (int code = 0; code < 2; code++) {
        context ctx;
        fram_error e = {0};
        video_file video;
        scratch s = scratch_make();
        char script[400], told[500] = "", reason[400];
        context_init(&ctx);
        ctx.log = keep_warning;
        ctx.log_user = told;
        snprintf(script, sizeof script,
                 "/bin/cat >/dev/null\nfor n in $(seq 300); do echo \"line $n of $n\" >&2; done\n: >\"$file\"\n"
                 "echo \"file:$file: the reason\" >&2\nexit %d",
                 code);
        be_ffmpeg(&s, script);
        assert_ok(video_begin(&ctx, scratch_path(&s, "said.mp4"), WIDTH, HEIGHT, 10, &video, &e), e);
        snprintf(reason, sizeof reason, "; line 300 of 300; %s: the reason", s.path);
        put_frames(&video);
        ck_assert_int_eq(video_end(&video, &e), code ? FRAM_ERROR_IO : FRAM_OK);
        const char *text = code ? e.message : told, *cut = strstr(text, ": ... line "), *end = strstr(text, reason);
        ck_assert_msg(cut && end && strlen(end) == strlen(reason), "%d: %s", code, text);
        ck_assert(code == 1 || strstr(told, "said.mp4: ffmpeg made the video, and said: ... line ") != NULL);
        ck_assert_int_eq(unlink(scratch_path(&s, "said.mp4")), code ? -1 : 0);
        scratch_remove(&s, "ffmpeg");
    }
}
END_TEST

/* What is said while frames are taken, more than a socket holds, and more behind it. */
START_TEST(words_between_frames_are_heard)
{
    context ctx;
    fram_error e = {0};
    video_file video;
    scratch s = scratch_make();
    context_init(&ctx);
    be_ffmpeg(&s, "for n in $(seq 3000); do echo \"line $n\" >&2; done\n/bin/cat >/dev/null\nexit 1");
    assert_ok(video_begin(&ctx, scratch_path(&s, "said.mp4"), WIDTH, HEIGHT, 10, &video, &e), e);
    for (int i = 0; i < 40; i++)
        put_frames(&video);
    ck_assert_int_eq(video_end(&video, &e), FRAM_ERROR_IO);
    ck_assert_msg(strstr(e.message, "line 2999; line 3000") != NULL, "%s", e.message);
    scratch_remove(&s, "ffmpeg");
}
END_TEST

/* What a script in ffmpeg's place leaves behind, silent or not. */
START_TEST(nothing_is_waited_for_in_vain)
{
    static const char *const behind[] = {"sleep 60 >/dev/null &", "yes >&2 &\nexec 2>/dev/null"};
    for (int k = 0; k < 2; k++) {
        context ctx;
        fram_error e = {0};
        video_file video;
        scratch s = scratch_make();
        char script[400], line[40] = "";
        context_init(&ctx);
        snprintf(script, sizeof script, "/bin/cat >/dev/null\n: >\"$file\"\n%s\necho $! >${0%%/*}/left", behind[k]);
        be_ffmpeg(&s, script);
        assert_ok(video_begin(&ctx, scratch_path(&s, "left.mp4"), WIDTH, HEIGHT, 10, &video, &e), e);
        put_frames(&video);
        assert_ok(video_end(&video, &e), e);
        FILE *left = fopen(scratch_path(&s, "left"), "r");
        ck_assert_ptr_nonnull(left);
        ck_assert_ptr_nonnull(fgets(line, sizeof line, left));
        fclose(left);
        (void)kill((pid_t)atoi(line), SIGKILL);
        ck_assert_int_eq(unlink(s.path), 0);
        ck_assert_int_eq(unlink(scratch_path(&s, "left.mp4")), 0);
        scratch_remove(&s, "ffmpeg");
    }
}
END_TEST

/* For an ffmpeg that does not end, or takes no frame. */
START_TEST(who_waits_can_be_stopped)
{
    static const char *const scripts[] = {"/bin/cat >/dev/null\nexec sleep 60", "exec sleep 60"};
    for (int k = 0; k < 2; k++) {
        context ctx;
        fram_error e = {0};
        video_file video;
        volatile int stop = 0;
        scratch s = scratch_make();
        context_init(&ctx);
        ctx.stop = &stop;
        be_ffmpeg(&s, scripts[k]);
        assert_ok(video_begin(&ctx, scratch_path(&s, "never.mp4"), WIDTH, HEIGHT, 10, &video, &e), e);
        fram_status status = FRAM_OK;
        if (k == 0)
            put_frames(&video);
        stop = 1;
        for (int i = 0; k == 1 && i < 1000 && status == FRAM_OK; i++) {
            static unsigned char pixels[4 * WIDTH * HEIGHT];
            status = video_frame(&video, pixels, sizeof pixels, &e);
        }
        if (k == 0)
            status = video_end(&video, &e);
        else
            video_abandon(&video);
        ck_assert_int_eq(status, FRAM_INTERRUPTED);
        ck_assert_int_eq(access(scratch_path(&s, "never.mp4"), F_OK), -1);
        scratch_remove(&s, "ffmpeg");
    }
}
END_TEST

TEST_MAIN("video_file", two_at_once, no_room_for_the_file, last_words_are_told, words_between_frames_are_heard,
          nothing_is_waited_for_in_vain, who_waits_can_be_stopped)

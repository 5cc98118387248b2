/* io/file and io/atomic_file: buffering, continuing, replacing, and what the operating system refuses. */
#include "io/late_commit.h"
#include "scratch.h"
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>

static context ctx;
static fram_error error;

static void assert_content(const char *path, const char *expected)
{
    size_t size;
    char *data = scratch_read(path, &size);
    ck_assert_uint_eq(size, strlen(expected));
    ck_assert_int_eq(memcmp(data, expected, size), 0);
    free(data);
}

START_TEST(what_is_written_is_read)
{
    context_init(&ctx);
    scratch s = scratch_make();
    file_writer w;
    /* Parts smaller and larger than the buffer, in an order that crosses its end. */
    static const size_t parts[] = {1, 65535, 1, 70000, 65536, 3, 0, 200000, 65537};
    static char pattern[200000];
    for (size_t i = 0; i < sizeof pattern; i++)
        pattern[i] = (char)(i * 7 + i / 251);
    assert_ok(file_create(&ctx, scratch_path(&s, "a"), &w, &error), error);
    size_t total = 0;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        assert_ok(file_write(&w, pattern, parts[i], &error), error);
        total += parts[i];
        ck_assert_uint_eq(w.length, total);
    }
    assert_ok(file_flush(&w, true, &error), error);
    assert_ok(file_close(&w, &error), error);
    assert_ok(file_close(&w, &error), error);
    char *data;
    size_t size;
    assert_fails(file_read(&ctx, s.path, total - 1, &data, &size, &error), error, FRAM_ERROR_INPUT, "at most");
    assert_ok(file_read(&ctx, s.path, total, &data, &size, &error), error);
    ck_assert_uint_eq(size, total);
    ck_assert_int_eq(data[size], '\0');
    size_t at = 0;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; at += parts[i++])
        ck_assert_int_eq(memcmp(data + at, pattern, parts[i]), 0);
    memory_free(&ctx, data);
    scratch_remove(&s, "a");
}
END_TEST

START_TEST(a_file_is_continued_after_a_cut)
{
    context_init(&ctx);
    scratch s = scratch_make();
    file_writer w;
    scratch_write(scratch_path(&s, "a"), "0123456789", 10);
    assert_ok(file_open(&ctx, s.path, &w, &error), error);
    ck_assert_uint_eq(w.length, 10);
    assert_ok(file_write(&w, "xyz", 3, &error), error);
    assert_ok(file_cut(&w, 11, &error), error);
    assert_ok(file_cut(&w, 4, &error), error);
    assert_ok(file_write(&w, "ab", 2, &error), error);
    assert_fails(file_cut(&w, 7, &error), error, FRAM_ERROR_INPUT, "at least 7 bytes, found 6");
    char two[2];
    assert_ok(file_flush(&w, false, &error), error);
    assert_ok(file_read_at(w.descriptor, s.path, 3, two, 2, &error), error);
    ck_assert_int_eq(memcmp(two, "3a", 2), 0);
    assert_fails(file_read_at(w.descriptor, s.path, 5, two, 2, &error), error, FRAM_ERROR_INPUT, "the end");
    assert_ok(file_close(&w, &error), error);
    assert_content(s.path, "0123ab");
    scratch_remove(&s, "a");
}
END_TEST

START_TEST(missing_files_and_folders_are_named)
{
    context_init(&ctx);
    file_writer w;
    char *data;
    size_t size;
    assert_fails(file_open(&ctx, "/no/such/file", &w, &error), error, FRAM_ERROR_INPUT, "No such file");
    ck_assert_str_eq(error.file, "/no/such/file");
    assert_fails(file_create(&ctx, "/no/such/file", &w, &error), error, FRAM_ERROR_INPUT, "open for writing");
    assert_fails(file_create(&ctx, "/dev/null/file", &w, &error), error, FRAM_ERROR_INPUT, "Not a directory");
    assert_fails(file_create(&ctx, "/tmp", &w, &error), error, FRAM_ERROR_INPUT, "directory");
    assert_fails(file_read(&ctx, "/no/such/file", 10, &data, &size, &error), error, FRAM_ERROR_INPUT, "cannot read");
    assert_fails(file_read(&ctx, "/tmp", 10, &data, &size, &error), error, FRAM_ERROR_INPUT, "regular file");
    ck_assert_int_eq(file_read(&ctx, "/no/such/file", 10, &data, &size, NULL), FRAM_ERROR_INPUT);
    assert_ok(file_close(&w, &error), error);
    file_abandon(&w);
}
END_TEST

/* A folder with a named pipe, whose name is in `path`. */
static scratch pipe_make(void)
{
    scratch s = scratch_make();
    ck_assert_int_eq(mkfifo(scratch_path(&s, "pipe"), 0600), 0);
    return s;
}

/* Opening a pipe without a writer must not hang. */
START_TEST(a_pipe_is_not_waited_for)
{
    context_init(&ctx);
    scratch s = pipe_make();
    char *data;
    size_t size;
    assert_fails(file_read(&ctx, s.path, 10, &data, &size, &error), error, FRAM_ERROR_INPUT, "regular file");
    scratch_remove(&s, "pipe");
}
END_TEST

/* As `fram report RUN -o /dev/stdout | head` has it. */
START_TEST(a_reader_that_goes_ends_the_writing)
{
    context_init(&ctx);
    scratch s = pipe_make();
    file_writer w;
    int reader = open(s.path, O_RDONLY | O_NONBLOCK);
    ck_assert_int_ge(reader, 0);
    assert_ok(file_create(&ctx, s.path, &w, &error), error);
    ck_assert_int_eq(close(reader), 0);
    ck_assert(signal(SIGPIPE, SIG_IGN) != SIG_ERR);
    assert_ok(file_write(&w, "a", 1, &error), error);
    assert_fails(file_close(&w, &error), error, FRAM_ERROR_IO, "Broken pipe");
    scratch_remove(&s, "pipe");
}
END_TEST

static volatile int stop;
static void ask_to_stop(int number) { stop = number; }

/* A stop by a signal, as Ctrl-C is one, while the system waits. */
static void stop_soon(void)
{
    struct sigaction action = {.sa_handler = ask_to_stop};
    stop = 0;
    ck_assert_int_eq(sigaction(SIGALRM, &action, NULL), 0);
    ck_assert_int_eq(setitimer(ITIMER_REAL, &(struct itimerval){.it_value.tv_usec = 20000}, NULL), 0);
}

/* Neither a pipe without a reader is waited for then, nor one whose reader takes nothing. */
START_TEST(a_stop_ends_the_waiting_for_a_reader)
{
    context_init(&ctx);
    ctx.stop = &stop;
    scratch s = pipe_make();
    file_writer w;
    static const char large[200000];
    stop_soon();
    assert_fails(file_create(&ctx, s.path, &w, &error), error, FRAM_INTERRUPTED, "waiting for a reader");
    int reader = open(s.path, O_RDONLY | O_NONBLOCK);
    stop_soon();
    assert_ok(file_create(&ctx, s.path, &w, &error), error);
    assert_fails(file_write(&w, large, sizeof large, &error), error, FRAM_INTERRUPTED, "the reader takes no more");
    assert_fails(file_close(&w, &error), error, FRAM_INTERRUPTED, "the reader takes no more");
    ck_assert_int_eq(close(reader), 0);
    scratch_remove(&s, "pipe");
}
END_TEST

/* A run that is stopped has its last rows where they are read; only what would wait is refused. */
START_TEST(a_stop_leaves_out_only_what_a_pipe_has_no_room_for)
{
    context_init(&ctx);
    ctx.stop = &stop;
    scratch s = pipe_make();
    file_writer w;
    static char large[200000];
    int reader = open(s.path, O_RDONLY | O_NONBLOCK);
    stop = 1;
    assert_ok(file_create(&ctx, s.path, &w, &error), error);
    assert_ok(file_write(&w, large, 60000, &error), error);
    assert_ok(file_flush(&w, true, &error), error);
    assert_fails(file_write(&w, large, sizeof large, &error), error, FRAM_INTERRUPTED, "the reader takes no more");
    file_abandon(&w);
    ck_assert_int_ge(read(reader, large, sizeof large), 60000);
    ck_assert_int_eq(close(reader), 0);
    scratch_remove(&s, "pipe");
}
END_TEST

static char bulk[200000];

static void pause_for(int milliseconds) { nanosleep(&(struct timespec){.tv_nsec = milliseconds * 1000000L}, NULL); }

/* A program that comes late, and wants all that is in `bulk` and nothing behind it. */
static pid_t late_reader(const char *path, int milliseconds)
{
    pid_t reader = fork();
    if (reader == 0) {
        pause_for(milliseconds);
        FILE *pipe = fopen(path, "rb");
        size_t got = pipe ? fread(bulk, 1, sizeof bulk, pipe) : 0;
        _exit(got == sizeof bulk && fgetc(pipe) == EOF ? 0 : 1);
    }
    return reader;
}

static void write_bulk(const char *path)
{
    file_writer w;
    assert_ok(file_create(&ctx, path, &w, &error), error);
    assert_ok(file_write(&w, bulk, sizeof bulk, &error), error);
    assert_ok(file_close(&w, &error), error);
}

/* It had what it wants. */
static void assert_read(pid_t reader)
{
    int state;
    ck_assert_int_eq(waitpid(reader, &state, 0), reader);
    ck_assert_int_eq(state, 0);
}

START_TEST(a_pipe_waits_for_its_reader)
{
    context_init(&ctx);
    scratch s = pipe_make();
    pid_t reader = late_reader(s.path, 20);
    write_bulk(s.path);
    assert_read(reader);
    scratch_remove(&s, "pipe");
}
END_TEST

/* After a stop a reader that pauses is waited for, in all for less than one takes that reads little by little. */
START_TEST(a_stop_waits_for_a_reader_that_pauses_not_for_a_slow_one)
{
    context_init(&ctx);
    ctx.stop = &stop;
    scratch s = pipe_make();
    file_writer w;
    int state = 0;
    int own = open(s.path, O_RDONLY | O_NONBLOCK);
    stop = 1;
    pid_t reader = late_reader(s.path, 150);
    write_bulk(s.path);
    assert_read(reader);
    reader = fork();
    for (int i = 0; reader == 0 && i < 50; i++) {
        pause_for(50);
        (void)!read(own, bulk, 4096);
    }
    if (reader == 0)
        _exit(0);
    assert_ok(file_create(&ctx, s.path, &w, &error), error);
    assert_fails(file_write(&w, bulk, sizeof bulk, &error), error, FRAM_INTERRUPTED, "the reader takes no more");
    file_abandon(&w);
    ck_assert_int_eq(kill(reader, SIGKILL), 0);
    ck_assert_int_eq(waitpid(reader, &state, 0), reader);
    ck_assert_int_eq(close(own), 0);
    scratch_remove(&s, "pipe");
}
END_TEST

/* As another program leaves a standard output that it shares. */
START_TEST(a_stream_that_does_not_wait_is_waited_for)
{
    context_init(&ctx);
    scratch s = pipe_make();
    char name[64];
    pid_t reader = late_reader(s.path, 20);
    int own = open(s.path, O_RDWR | O_NONBLOCK); /* not the reader's too, who would wait for its own end */
    snprintf(name, sizeof name, "/dev/fd/%d", own);
    write_bulk(access(name, F_OK) == 0 ? name : s.path);
    ck_assert(fcntl(own, F_GETFL) & O_NONBLOCK);
    ck_assert_int_eq(close(own), 0);
    assert_read(reader);
    scratch_remove(&s, "pipe");
}
END_TEST

/* As `fram fatigue RUN -o /dev/stdout >> FILE` has it: what is there stays, and each write has its turn. */
START_TEST(a_descriptor_that_has_a_name_goes_on)
{
    context_init(&ctx);
    scratch s = scratch_make();
    char name[64], link[320];
    scratch_write(scratch_path(&s, "a"), "old", 3);
    int own = open(s.path, O_WRONLY);
    ck_assert_int_eq(lseek(own, 0, SEEK_END), 3);
    snprintf(name, sizeof name, "/dev/fd/%d", own);
    if (access(name, F_OK) == 0) {
        snprintf(link, sizeof link, "%s", scratch_path(&s, "link"));
        ck_assert_int_eq(symlink(name, link), 0);
        assert_ok(atomic_file_write(&ctx, name, " one", 4, &error), error);
        ck_assert_int_eq(write(own, " two", 4), 4);
        snprintf(name, sizeof name, "/proc/self/fd/%d", own);
        assert_ok(atomic_file_write(&ctx, name, " three", 6, &error), error);
        assert_ok(atomic_file_write(&ctx, link, " four", 5, &error), error);
        snprintf(name, sizeof name, "/proc/thread-self/fd/%d", own);
        assert_ok(atomic_file_write(&ctx, access(name, F_OK) == 0 ? name : link, " five", 5, &error), error);
        assert_content(scratch_path(&s, "a"), "old one two three four five");
        ck_assert_int_eq(unlink(link), 0);
    }
    ck_assert_int_eq(close(own), 0);
    scratch_remove(&s, "a");
}
END_TEST

START_TEST(a_full_disk_is_seen_at_once)
{
    context_init(&ctx);
    file_writer w;
    if (access("/dev/full", W_OK) != 0)
        return;
    assert_ok(file_create(&ctx, "/dev/full", &w, &error), error);
    assert_ok(file_write(&w, "a", 1, &error), error);
    assert_fails(file_flush(&w, false, &error), error, FRAM_ERROR_IO, "cannot write: No space");
    ck_assert_str_eq(error.file, "/dev/full");
    /* And for good: nothing may be appended after a gap. */
    assert_fails(file_write(&w, "b", 1, &error), error, FRAM_ERROR_IO, "No space");
    assert_fails(file_close(&w, &error), error, FRAM_ERROR_IO, "No space");
    assert_ok(file_create(&ctx, "/dev/full", &w, &error), error);
    static const char large[100000];
    assert_fails(file_write(&w, large, sizeof large, &error), error, FRAM_ERROR_IO, "No space");
    file_abandon(&w);
}
END_TEST

/* The system takes a part of the bytes, then refuses: the limit on the size of files does that. */
START_TEST(a_partial_write_is_seen)
{
    context_init(&ctx);
    scratch s = scratch_make();
    file_writer w;
    static char data[50000];
    struct rlimit limit = {30000, RLIM_INFINITY}, unlimited;
    ck_assert_int_eq(getrlimit(RLIMIT_FSIZE, &unlimited), 0);
    signal(SIGXFSZ, SIG_IGN);
    scratch_write(scratch_path(&s, "a"), "old", 3);
    assert_ok(file_create(&ctx, scratch_path(&s, "b"), &w, &error), error);
    assert_ok(file_write(&w, data, sizeof data, &error), error);
    ck_assert_int_eq(setrlimit(RLIMIT_FSIZE, &limit), 0);
    assert_fails(file_flush(&w, true, &error), error, FRAM_ERROR_IO, "File too large");
    file_abandon(&w);
    fram_status status = atomic_file_write(&ctx, scratch_path(&s, "a"), data, sizeof data, &error);
    ck_assert_int_eq(setrlimit(RLIMIT_FSIZE, &unlimited), 0);
    ck_assert_int_eq(status, FRAM_ERROR_IO);
    ck_assert_str_eq(error.file, s.path); /* not that of the temporary one */
    assert_content(s.path, "old");
    ck_assert_int_eq(unlink(scratch_path(&s, "b")), 0);
    scratch_remove(&s, "a");
}
END_TEST

START_TEST(replacing_is_all_or_nothing)
{
    context_init(&ctx);
    scratch s = scratch_make();
    atomic_file a;
    assert_ok(atomic_file_write(&ctx, scratch_path(&s, "a"), "first", 5, &error), error);
    assert_content(s.path, "first");
    assert_ok(atomic_file_write(&ctx, s.path, "second", 6, &error), error);
    assert_content(s.path, "second");
    assert_ok(atomic_file_begin(&ctx, s.path, &a, &error), error);
    assert_ok(file_write(&a.writer, "third", 5, &error), error);
    assert_content(s.path, "second");
    atomic_file_abandon(&a);
    atomic_file_abandon(&a);
    assert_content(s.path, "second");
    assert_ok(atomic_file_write(&ctx, s.path, NULL, 0, &error), error);
    assert_content(s.path, "");
    scratch_remove(&s, "a");
}
END_TEST

START_TEST(replacing_a_folder_leaves_nothing_behind)
{
    context_init(&ctx);
    scratch s = scratch_make();
    ck_assert_int_eq(mkdir(scratch_path(&s, "a"), 0700), 0);
    char inside[320];
    snprintf(inside, sizeof inside, "%s/file", s.path);
    scratch_write(inside, "x", 1);
    assert_fails(atomic_file_write(&ctx, s.path, "y", 1, &error), error, FRAM_ERROR_INPUT, "found a folder");
    ck_assert_str_eq(error.file, s.path);
    ck_assert_int_eq(unlink(inside), 0);
    ck_assert_int_eq(rmdir(s.path), 0);
    ck_assert_int_eq(rmdir(s.folder), 0);
    assert_fails(atomic_file_write(&ctx, "", "y", 1, &error), error, FRAM_ERROR_INPUT, "found an empty text");
    assert_fails(atomic_file_write(&ctx, "/no/such/folder/a", "y", 1, &error), error, FRAM_ERROR_INPUT,
                 "the folder /no/such/folder is not there; make it");
    ck_assert_str_eq(error.file, "/no/such/folder/a");
}
END_TEST

/* Folders that are there are not told to be missing: a link in the place of the file, or on the way, leads nowhere. */
START_TEST(links_that_lead_nowhere_are_told)
{
    static const struct {
        const char *link, *path;
    } rows[] = {{"l", "l"}, {"l", "l/a"}, {"l", "l//b/a/"}};
    context_init(&ctx);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        scratch s = scratch_make();
        char link[320], said[700];
        snprintf(link, sizeof link, "%s/%s", s.folder, rows[i].link);
        ck_assert_int_eq(symlink("nowhere/x.html", link), 0);
        snprintf(said, sizeof said, "cannot write: the link %s leads nowhere; ", link);
        assert_fails(file_place_error(&error, scratch_path(&s, rows[i].path), "write", ENOENT), error, FRAM_ERROR_INPUT,
                     said);
        if (i == 0)
            assert_fails(atomic_file_write(&ctx, link, "y", 1, &error), error, FRAM_ERROR_INPUT, "leads nowhere");
        ck_assert_int_eq(unlink(link), 0);
        snprintf(said, sizeof said, "the folder %s/l is not there; make it", s.folder);
        assert_fails(file_place_error(&error, scratch_path(&s, "l/a"), "write", ENOENT), error, FRAM_ERROR_INPUT, said);
        assert_fails(file_place_error(&error, scratch_path(&s, "a"), "write", ENOENT), error, FRAM_ERROR_INPUT,
                     "cannot write: No such file");
        ck_assert_int_eq(rmdir(s.folder), 0);
    }
}
END_TEST

/* A device or a link in the place of the file stays what it is. */
START_TEST(devices_and_links_are_written_through)
{
    context_init(&ctx);
    scratch s = scratch_make();
    char link[320];
    atomic_file a;
    snprintf(link, sizeof link, "%s", scratch_path(&s, "link"));
    scratch_write(scratch_path(&s, "a"), "old", 3);
    ck_assert_int_eq(symlink("a", link), 0);
    assert_ok(atomic_file_write(&ctx, link, "through", 7, &error), error);
    assert_content(s.path, "through");
    assert_ok(atomic_file_begin(&ctx, link, &a, &error), error);
    atomic_file_abandon(&a);
    struct stat about;
    ck_assert_int_eq(lstat(link, &about), 0);
    ck_assert(S_ISLNK(about.st_mode));
    assert_fails(atomic_file_adopt(&ctx, s.path, link, &error), error, FRAM_ERROR_INPUT, "a device or a link");
    ck_assert_int_eq(unlink(link), 0);
    ck_assert_int_eq(symlink("/dev/full", link), 0);
    if (access("/dev/full", W_OK) == 0)
        assert_fails(atomic_file_write(&ctx, link, "x", 1, &error), error, FRAM_ERROR_IO, "No space");
    ck_assert_int_eq(unlink(link), 0);
    ck_assert_int_eq(rmdir(s.folder), 0);
}
END_TEST

/* A file on a file system that has no disk below it is adopted as it is written: what cannot be brought to a disk is
   complete without.  Why one cannot be adopted is what befell that file. */
START_TEST(what_has_no_disk_below_is_adopted)
{
    context_init(&ctx);
    scratch s = scratch_make();
    char made[320];
    int pipes[2];
    ck_assert_int_eq(pipe(pipes), 0);
    ck_assert(file_sync(pipes[1]));
    ck_assert(!file_sync(-1) && errno == EBADF);
    close(pipes[0]);
    close(pipes[1]);
    snprintf(made, sizeof made, "%s", scratch_path(&s, "a/made"));
    scratch_write(scratch_path(&s, "a"), "old", 3);
    assert_fails(atomic_file_adopt(&ctx, made, scratch_path(&s, "b"), &error), error, FRAM_ERROR_INPUT,
                 "Not a directory");
    snprintf(made, sizeof made, "%s", scratch_path(&s, "made"));
    scratch_path(&s, "a");
    ck_assert_int_eq(symlink("/dev/null", made), 0);
    assert_ok(atomic_file_adopt(&ctx, made, s.path, &error), error);
    ck_assert_int_eq(unlink(s.path), 0);
    ck_assert_int_eq(rmdir(s.folder), 0);
}
END_TEST

START_TEST(a_late_commit_brings_all_to_its_place)
{
    context_init(&ctx);
    scratch s = scratch_make();
    file_writer stream, *streams[] = {&stream};
    late_commit commit = {0};
    atomic_file a;
    assert_ok(late_commit_wait(&commit, &error), error); /* none */
    assert_ok(file_create(&ctx, scratch_path(&s, "stream"), &stream, &error), error);
    for (int i = 0; i < 3; i++) {
        char text[2] = {(char)('0' + i), '\0'}, so_far[4] = "012";
        so_far[i + 1] = '\0';
        assert_ok(file_write(&stream, text, 1, &error), error);
        assert_ok(atomic_file_begin(&ctx, scratch_path(&s, "a"), &a, &error), error);
        assert_ok(file_write(&a.writer, text, 1, &error), error);
        assert_ok(late_commit_start(&commit, &a, streams, 1, &error), error);
        assert_content(scratch_path(&s, "stream"), so_far);
        assert_ok(late_commit_wait(&commit, &error), error);
        assert_content(scratch_path(&s, "a"), text);
    }
    /* What the rename finds in its way is told, and nothing is left behind. */
    assert_ok(atomic_file_begin(&ctx, scratch_path(&s, "b"), &a, &error), error);
    ck_assert_int_eq(mkdir(scratch_path(&s, "b"), 0700), 0);
    assert_ok(late_commit_start(&commit, &a, NULL, 0, &error), error);
    ck_assert_int_ne(late_commit_wait(&commit, &error), FRAM_OK);
    ck_assert_str_eq(error.file, scratch_path(&s, "b"));
    ck_assert_int_eq(rmdir(scratch_path(&s, "b")), 0);
    assert_ok(file_close(&stream, &error), error);
    ck_assert_int_eq(unlink(scratch_path(&s, "stream")), 0);
    scratch_remove(&s, "a");
}
END_TEST

/* A name without a folder is in the working folder. */
START_TEST(a_bare_name_is_here)
{
    context_init(&ctx);
    scratch s = scratch_make();
    char here[400];
    ck_assert_ptr_nonnull(getcwd(here, sizeof here));
    ck_assert_int_eq(chdir(s.folder), 0);
    assert_ok(atomic_file_write(&ctx, "bare", "y", 1, &error), error);
    ck_assert_int_eq(chdir(here), 0);
    assert_content(scratch_path(&s, "bare"), "y");
    scratch_remove(&s, "bare");
}
END_TEST

START_TEST(memory_runs_out)
{
    scratch s = scratch_make();
    for (failing_turn turn = {0}; failing_next(&turn);) {
        char *data = NULL;
        size_t size;
        turn.status = atomic_file_write(&turn.ctx, scratch_path(&s, "a"), "text", 4, &error);
        if (turn.status == FRAM_OK)
            turn.status = file_read(&turn.ctx, s.path, 100, &data, &size, &error);
        if (turn.status == FRAM_OK)
            memory_free(&turn.ctx, data);
    }
    scratch_remove(&s, "a");
}
END_TEST

TEST_MAIN("file", what_is_written_is_read, a_file_is_continued_after_a_cut, missing_files_and_folders_are_named,
          a_pipe_is_not_waited_for, a_reader_that_goes_ends_the_writing, a_stop_ends_the_waiting_for_a_reader,
          a_stop_leaves_out_only_what_a_pipe_has_no_room_for, a_pipe_waits_for_its_reader,
          a_stop_waits_for_a_reader_that_pauses_not_for_a_slow_one, a_stream_that_does_not_wait_is_waited_for,
          a_descriptor_that_has_a_name_goes_on, a_full_disk_is_seen_at_once, a_partial_write_is_seen,
          replacing_is_all_or_nothing, a_late_commit_brings_all_to_its_place, replacing_a_folder_leaves_nothing_behind,
          devices_and_links_are_written_through, links_that_lead_nowhere_are_told, what_has_no_disk_below_is_adopted,
          a_bare_name_is_here, memory_runs_out)

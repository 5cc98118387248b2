#include "io/run_note.h"

#include "io/atomic_file.h"
#include "io/file.h"
#include "io/json_walk.h"
#include "io/path.h"

#include <math.h>
#include <string.h>

void run_note_init(run_note *n)
{
    const double none = (double)NAN;
    *n = (run_note){.steps = none, .time = none, .recorded_from = -1, .good_until = none};
    n->step_median = n->step_p99 = n->step_p999 = n->step_longest = none;
}

void run_note_free(context *ctx, run_note *n)
{
    array_free(ctx, &n->files);
    array_free(ctx, &n->events);
    array_free(ctx, &n->tracks);
    text_free(ctx, &n->told);
}

/* ---- members: one table for both directions, in the order in which they are written ---- */

typedef enum note_kind {
    NOTE_TEXT,
    NOTE_WORDS, /* a text that may be "", and null for that: none that runs are told apart by */
    NOTE_NAME,  /* the same, left out where it is "" */
    NOTE_WHOLE, /* a number without decimals, */
    NOTE_REAL,  /* by the fewest digits that read back as the same, null where it is none, */
    NOTE_MILLI, /* to thousandths, */
    NOTE_TENTH, /* to tenths of those, */
    NOTE_ROUGH, /* to the digits that bins of times have */
    NOTE_LIST
} note_kind;

typedef struct note_reader {
    context *ctx;
    json_walk walk;
    fram_error *error;
} note_reader;

typedef struct note_writer {
    context *ctx;
    text_buffer *out;
} note_writer;

typedef struct note_list {
    void (*write)(note_writer *w, const run_note *n);
    fram_status (*read)(note_reader *r, run_note *n);
} note_list;

typedef struct note_member {
    const char *name;
    note_kind kind;
    size_t offset, room; /* in its struct; bytes of a text */
    const note_list *list;
    bool (*is_told)(const run_note *n); /* NULL: always */
} note_member;

static const char *text_in(const void *of, const note_member *m) { return (const char *)of + m->offset; }
static double number_in(const void *of, const note_member *m)
{
    double value;
    memcpy(&value, (const char *)of + m->offset, sizeof value);
    return value;
}

static void write_member(note_writer *w, const note_member *m, const char *before, const void *of)
{
    text_format(w->ctx, w->out, "%s\"%s\": ", before, m->name);
    switch (m->kind) {
    case NOTE_TEXT:
    case NOTE_WORDS:
    case NOTE_NAME:
        text_quoted(w->ctx, w->out, text_in(of, m));
        break;
    case NOTE_REAL:
        text_real_or_null(w->ctx, w->out, number_in(of, m));
        break;
    case NOTE_LIST:
        text_add(w->ctx, w->out, "[");
        m->list->write(w, of);
        text_add(w->ctx, w->out, "]");
        break;
    case NOTE_WHOLE:
        text_format(w->ctx, w->out, "%.0f", number_in(of, m));
        break;
    case NOTE_MILLI:
        text_format(w->ctx, w->out, "%.3f", number_in(of, m));
        break;
    case NOTE_TENTH:
        text_format(w->ctx, w->out, "%.4f", number_in(of, m));
        break;
    case NOTE_ROUGH:
        text_format(w->ctx, w->out, "%.3g", number_in(of, m));
        break;
    }
}

static fram_status read_member(note_reader *r, const note_member *m, void *of)
{
    double value = 0;
    if (m->kind == NOTE_LIST)
        return m->list->read(r, of);
    if (m->kind == NOTE_TEXT)
        return json_walk_text(&r->walk, (char *)of + m->offset, m->room, r->error);
    if (m->kind == NOTE_WORDS || m->kind == NOTE_NAME)
        return json_walk_text_or_null(&r->walk, (char *)of + m->offset, m->room, r->error);
    fram_status status = json_walk_number_or_null(&r->walk, &value, r->error);
    if (status == FRAM_OK)
        memcpy((char *)of + m->offset, &value, sizeof value);
    return status;
}

/* What the object has of these. */
static fram_status read_object(note_reader *r, const note_member *members, size_t count, void *of)
{
    char key[64];
    json_loop loop = json_walk_into(&r->walk, JSON_OBJECT, r->error);
    while (json_walk_next_member(&r->walk, &loop, key, sizeof key, r->error)) {
        size_t i = 0;
        while (i < count && strcmp(key, members[i].name) != 0)
            i++;
        loop.status = i < count ? read_member(r, &members[i], of) : json_walk_skip(&r->walk, r->error);
    }
    return loop.status;
}

/* On one line. */
static void write_object(note_writer *w, const note_member *members, size_t count, const char *before, const void *of)
{
    const char *comma = before;
    for (size_t i = 0; i < count; i++) {
        if (members[i].kind == NOTE_NAME && !text_in(of, &members[i])[0])
            continue;
        write_member(w, &members[i], comma, of);
        comma = ", ";
    }
    text_add(w->ctx, w->out, "}");
}

#define MEMBERS_OF(list) (sizeof(list) / sizeof *(list))
#define TEXT_OF(type, name, member, kind)                                         \
    {                                                                             \
        name, kind, offsetof(type, member), sizeof((type *)0)->member, NULL, NULL \
    }
#define NUMBER_OF(type, name, member, kind)               \
    {                                                     \
        name, kind, offsetof(type, member), 0, NULL, NULL \
    }

/* ---- lists ---- */

/* Each of a list takes hundreds of bytes, of a damaged or forged text's two. */
static fram_status check_room(note_reader *r, int32_t count)
{
    if (count < RUN_NOTE_ITEMS_MOST)
        return FRAM_OK;
    return json_walk_refuse(&r->walk, "", r->error, "expected a list of %d at most", (int)RUN_NOTE_ITEMS_MOST);
}

static const note_member file_members[] = {TEXT_OF(run_note_file, "sha256", digest, NOTE_TEXT),
                                           TEXT_OF(run_note_file, "file", path, NOTE_TEXT)};

static void write_files(note_writer *w, const run_note *n)
{
    for (int32_t i = 0; i < n->files.count; i++)
        write_object(w, file_members, MEMBERS_OF(file_members), i > 0 ? ", {" : "{", &n->files.data[i]);
}

static fram_status read_files(note_reader *r, run_note *n)
{
    json_loop loop = json_walk_into(&r->walk, JSON_ARRAY, r->error);
    while (json_walk_next(&r->walk, &loop, r->error)) {
        run_note_file file = {0};
        loop.status = check_room(r, n->files.count);
        if (loop.status == FRAM_OK)
            loop.status = read_object(r, file_members, MEMBERS_OF(file_members), &file);
        if (loop.status == FRAM_OK && !array_push(r->ctx, &n->files, file))
            loop.status = error_memory(r->error);
    }
    return loop.status;
}

static const note_member event_members[] = {
    NUMBER_OF(run_event, "time_s", time, NOTE_REAL), TEXT_OF(run_event, "kind", kind, NOTE_TEXT),
    TEXT_OF(run_event, "vessel", vessel, NOTE_NAME), TEXT_OF(run_event, "other", other, NOTE_NAME),
    NUMBER_OF(run_event, "value", value, NOTE_REAL), NUMBER_OF(run_event, "ahead_s", ahead, NOTE_REAL),
    TEXT_OF(run_event, "text", text, NOTE_WORDS)};

static void write_events(note_writer *w, const run_note *n)
{
    for (int32_t i = 0; i < n->events.count; i++)
        write_object(w, event_members, MEMBERS_OF(event_members), i > 0 ? ",\n    {" : "\n    {", &n->events.data[i]);
}

static fram_status read_events(note_reader *r, run_note *n)
{
    json_loop loop = json_walk_into(&r->walk, JSON_ARRAY, r->error);
    while (json_walk_next(&r->walk, &loop, r->error)) {
        run_event event = {0};
        loop.status = check_room(r, n->events.count);
        if (loop.status == FRAM_OK)
            loop.status = read_object(r, event_members, MEMBERS_OF(event_members), &event);
        if (loop.status == FRAM_OK && !array_push(r->ctx, &n->events, event))
            loop.status = error_memory(r->error);
    }
    return loop.status;
}

static const note_member track_members[] = {
    TEXT_OF(run_track, "vessel", vessel, NOTE_NAME),       NUMBER_OF(run_track, "limit_m", limit, NOTE_REAL),
    NUMBER_OF(run_track, "largest_m", largest, NOTE_REAL), NUMBER_OF(run_track, "rms_m", rms, NOTE_REAL),
    NUMBER_OF(run_track, "time_s", time, NOTE_REAL),       NUMBER_OF(run_track, "rounds", rounds, NOTE_WHOLE)};

static void write_tracks(note_writer *w, const run_note *n)
{
    for (int32_t i = 0; i < n->tracks.count; i++)
        write_object(w, track_members, MEMBERS_OF(track_members), i > 0 ? ",\n    {" : "\n    {", &n->tracks.data[i]);
}

static fram_status read_tracks(note_reader *r, run_note *n)
{
    json_loop loop = json_walk_into(&r->walk, JSON_ARRAY, r->error);
    while (json_walk_next(&r->walk, &loop, r->error)) {
        run_track track = {0};
        loop.status = check_room(r, n->tracks.count);
        if (loop.status == FRAM_OK)
            loop.status = read_object(r, track_members, MEMBERS_OF(track_members), &track);
        if (loop.status == FRAM_OK && !array_push(r->ctx, &n->tracks, track))
            loop.status = error_memory(r->error);
    }
    return loop.status;
}

enum { TOLD_NAME_ROOM = VESSEL_NAME_MOST + 48 };

static void write_told(note_writer *w, const run_note *n)
{
    const char *at = n->told.data, *comma = "";
    for (size_t length; at && *at; at += length + 1, comma = ", ") {
        char name[TOLD_NAME_ROOM];
        length = strcspn(at, "\n");
        snprintf(name, sizeof name, "%.*s", (int)length, at);
        text_add(w->ctx, w->out, comma);
        text_quoted(w->ctx, w->out, name);
    }
}

static fram_status read_told(note_reader *r, run_note *n)
{
    json_loop loop = json_walk_into(&r->walk, JSON_ARRAY, r->error);
    while (json_walk_next(&r->walk, &loop, r->error)) {
        char name[TOLD_NAME_ROOM];
        loop.status = json_walk_text(&r->walk, name, sizeof name, r->error);
        if (loop.status == FRAM_OK)
            text_format(r->ctx, &n->told, "%s\n", name);
    }
    return loop.status == FRAM_OK && n->told.failed ? error_memory(r->error) : loop.status;
}

/* ---- the note ---- */

static bool tells_failure(const run_note *n) { return n->message[0] != '\0'; }
static bool tells_beginning(const run_note *n) { return n->recorded_from >= 0; }
static bool tells_steps(const run_note *n) { return !isnan(n->step_longest); }

#define NOTE_TEXT_OF(name, member) TEXT_OF(run_note, name, member, NOTE_TEXT)
#define NOTE_WORDS_OF(name, member) TEXT_OF(run_note, name, member, NOTE_WORDS)
#define NOTE_NUMBER_OF(name, member, kind) NUMBER_OF(run_note, name, member, kind)
#define NOTE_STEPS_OF(name, member)                                        \
    {                                                                      \
        name, NOTE_ROUGH, offsetof(run_note, member), 0, NULL, tells_steps \
    }
static const note_list file_list = {write_files, read_files}, event_list = {write_events, read_events},
                       track_list = {write_tracks, read_tracks}, told_list = {write_told, read_told};
static const note_member note_members[] = {
    NOTE_TEXT_OF("fram_version", version),
    NOTE_TEXT_OF("compiler", compiler),
    NOTE_TEXT_OF("libraries", libraries),
    NOTE_TEXT_OF("isa", isa),
    NOTE_NUMBER_OF("threads", threads, NOTE_WHOLE),
    NOTE_WORDS_OF("title", title),
    NOTE_NUMBER_OF("seed", seed, NOTE_WHOLE),
    NOTE_TEXT_OF("scenario_hash", scenario_hash),
    {"inputs", NOTE_LIST, 0, 0, &file_list, NULL},
    NOTE_TEXT_OF("status", status),
    {"message", NOTE_TEXT, offsetof(run_note, message), sizeof((run_note *)0)->message, NULL, tells_failure},
    {"good_until_s", NOTE_REAL, offsetof(run_note, good_until), 0, NULL, tells_failure},
    {"recorded_from_s", NOTE_REAL, offsetof(run_note, recorded_from), 0, NULL, tells_beginning},
    NOTE_NUMBER_OF("steps", steps, NOTE_WHOLE),
    NOTE_NUMBER_OF("time_s", time, NOTE_REAL),
    {"events", NOTE_LIST, 0, 0, &event_list, NULL},
    NOTE_NUMBER_OF("events_left_out", events_left_out, NOTE_WHOLE),
    {"tracks", NOTE_LIST, 0, 0, &track_list, NULL},
    {"told", NOTE_LIST, 0, 0, &told_list, NULL},
    NOTE_NUMBER_OF("wall_s", wall, NOTE_MILLI),
    NOTE_NUMBER_OF("recording_s", recording, NOTE_TENTH),
    NOTE_NUMBER_OF("recording_end_s", recording_end, NOTE_TENTH),
    NOTE_STEPS_OF("step_wall_median_ms", step_median),
    NOTE_STEPS_OF("step_wall_p99_ms", step_p99),
    NOTE_STEPS_OF("step_wall_p999_ms", step_p999),
    NOTE_STEPS_OF("step_wall_longest_ms", step_longest),
    NOTE_TEXT_OF("state_hash", state_hash),
};

static fram_status note_path(const char *folder, char path[PATH_ROOM], fram_error *error)
{
    return path_join(folder, "run.json", path, error);
}

fram_status run_note_write(context *ctx, const char *folder, const run_note *n, fram_error *error)
{
    char path[PATH_ROOM];
    fram_status status = note_path(folder, path, error);
    if (status == FRAM_OK)
        status = path_claim(path, error);
    if (status != FRAM_OK)
        return status;
    text_buffer text = {0};
    note_writer w = {ctx, &text};
    const char *before = "{\n  ";
    for (size_t i = 0; i < MEMBERS_OF(note_members); i++) {
        const note_member *m = &note_members[i];
        if (m->is_told && !m->is_told(n))
            continue;
        write_member(&w, m, before, n);
        before = ",\n  ";
    }
    text_add(ctx, &text, "\n}\n");
    status = text.failed ? error_memory(error) : atomic_file_put(ctx, path, text.data, (size_t)text.count, error);
    text_free(ctx, &text);
    return status;
}

fram_status run_note_read(context *ctx, const char *folder, run_note *n, fram_error *error)
{
    enum { DEPTH = 16 };
    char path[PATH_ROOM], *text = NULL;
    size_t size = 0;
    run_note_init(n);
    fram_status status = note_path(folder, path, error);
    if (status == FRAM_OK)
        status = file_read(ctx, path, RUN_NOTE_MOST, &text, &size, error);
    if (status != FRAM_OK)
        return status;
    note_reader r = {ctx, json_walk_begin(path, text, size, DEPTH), error};
    status = read_object(&r, note_members, MEMBERS_OF(note_members), n);
    if (status == FRAM_OK)
        status = json_walk_end(&r.walk, error);
    memory_free(ctx, text);
    return status;
}

/* ---- what every run tells ---- */

/* Beyond all steps and seconds that the longest run.duration has at the shortest run.time_step. */
#define NOTE_MOST 1e15
#define NO_RUN_WROTE ": no run of Fram wrote that; run the scenario again"

static fram_status check_count(const char *path, const char *key, double value, fram_error *error)
{
    if (value >= 0 && value <= NOTE_MOST)
        return FRAM_OK;
    if (isnan(value))
        return error_set(error, FRAM_ERROR_INPUT, path, 0, key, "is missing" NO_RUN_WROTE);
    return error_set(error, FRAM_ERROR_INPUT, path, 0, key, "expected a number from 0 to %g, found %.6g" NO_RUN_WROTE,
                     NOTE_MOST, value);
}

fram_status run_note_check(const run_note *n, const char *folder, fram_error *error)
{
    static const char *const states[] = {"running", "finished", "stopped", "interrupted", "failed"};
    char path[PATH_ROOM];
    size_t i = 0, count = sizeof states / sizeof *states;
    fram_status status = note_path(folder, path, error);
    if (status != FRAM_OK)
        return status;
    while (i < count && strcmp(n->status, states[i]) != 0)
        i++;
    if (i == count)
        return error_set(error, FRAM_ERROR_INPUT, path, 0, "status",
                         "expected running, finished, stopped, interrupted or failed, found \"%s\"" NO_RUN_WROTE,
                         n->status);
    status = check_count(path, "steps", n->steps, error);
    return status == FRAM_OK ? check_count(path, "time_s", n->time, error) : status;
}

/* ---- its text ---- */

bool run_note_is_there(const char *folder)
{
    char path[PATH_ROOM];
    return note_path(folder, path, NULL) == FRAM_OK && file_is_readable(path);
}

fram_status run_note_load(context *ctx, const char *folder, char **text, fram_error *error)
{
    char path[PATH_ROOM];
    size_t size = 0;
    *text = NULL;
    fram_status status = note_path(folder, path, error);
    return status == FRAM_OK ? file_read(ctx, path, RUN_NOTE_MOST, text, &size, error) : status;
}

bool run_note_mentions(const char *text, const char *digest) { return strstr(text, digest) != NULL; }

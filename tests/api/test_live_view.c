/* The live view of a recorded world, asked by plain sockets: who has the address gets the page and the record, and
   nobody gets anything else; it ends with the recording. */
#include "fram/live.h"
#include "scratch.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

static const char scene[] = "run: {duration: 1, time_step: 0.05}\n"
                            "vessel: {mode: towed, speed: 1, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}\n"
                            "ice: {concentration: 0.5, mean_floe_area: 400}\n"
                            "domain: {x_min: -100, x_max: 100, y_min: -60, y_max: 60}\n"
                            "output: {frame_interval: 0.1}\n";
static const char viewer[] = "<p data=\"<!--BESIDE-->\"><!--RECORD--></p>";
enum { ROOM = 1 << 20 };

typedef struct opened {
    fram_context *ctx;
    fram_scenario *s;
    fram_world *w;
    char folder[SCRATCH_FOLDER], page[SCRATCH_PATH], run[SCRATCH_PATH];
    char address[128];
    int told, port;
    const char *path; /* of the address: "/TOKEN/" */
} opened;

static void keep_address(void *user, const char *address)
{
    opened *o = user;
    o->told++;
    snprintf(o->address, sizeof o->address, "%s", address);
}

/* The recording is not begun yet: nothing of the world is to be had. */
static void keep_and_try(void *user, const char *address)
{
    opened *o = user;
    fram_error e;
    keep_address(user, address);
    ck_assert_int_eq(fram_world_step(o->w, &e), FRAM_ERROR_USAGE);
    ck_assert_str_eq(e.key, "world");
    ck_assert_int_eq(fram_world_record_end(o->w, NULL, &e), FRAM_ERROR_USAGE);
    ck_assert_str_eq(e.key, "world");
}

/* A world before its recording; false when this build has no live view. */
static bool set_up(opened *o)
{
    fram_error e;
    *o = (opened){0};
    if (!strstr(fram_features(), "libmicrohttpd"))
        return false;
    scratch_folder(o->folder);
    snprintf(o->page, sizeof o->page, "%s/page.html", o->folder);
    snprintf(o->run, sizeof o->run, "%s/run", o->folder);
    scratch_text(o->page, viewer);
    assert_ok(fram_context_create(NULL, &o->ctx, &e), e);
    assert_ok(fram_scenario_parse(o->ctx, scene, NULL, NULL, 0, &o->s, &e), e);
    assert_ok(fram_world_create(o->s, &o->w, &e), e);
    return true;
}

static void tear_down(opened *o)
{
    fram_world_destroy(o->w);
    fram_scenario_destroy(o->s);
    fram_context_destroy(o->ctx);
    scratch_remove_folder(o->folder);
}

static void begin(opened *o)
{
    fram_error e;
    fram_record_definition d;
    fram_record_default(&d);
    d.folder = o->run;
    d.live_page = o->page;
    d.live = keep_and_try;
    d.live_user = o;
    assert_ok(fram_world_record(o->w, &d, &e), e);
    ck_assert_int_eq(o->told, 1);
    int end = 0;
    ck_assert_int_eq(sscanf(o->address, "http://127.0.0.1:%d%n", &o->port, &end), 1);
    o->path = o->address + end;
    ck_assert_uint_eq(strlen(o->path), 34); /* 128 bits */
}

static int dial(int port, in_addr_t where)
{
    int s = socket(AF_INET, SOCK_STREAM, 0);
    struct sockaddr_in to = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port), .sin_addr.s_addr = htonl(where)};
    ck_assert_int_ge(s, 0);
    if (connect(s, (struct sockaddr *)&to, sizeof to) == 0)
        return s;
    close(s);
    return -1;
}

typedef struct reply {
    int status;
    char *head, *body;
    size_t size;
} reply;

/* What is answered to METHOD PATH with this Host, "HEAD" of the answer kept in text that the next call overwrites. */
static reply ask(const opened *o, const char *method, const char *path, const char *host)
{
    static char text[ROOM];
    char request[512];
    int s = dial(o->port, INADDR_LOOPBACK);
    ck_assert_msg(s >= 0, "nobody listens");
    int length = snprintf(request, sizeof request, "%s %s HTTP/1.1\r\n%s%s%sConnection: close\r\n\r\n", method, path,
                          host ? "Host: " : "", host ? host : "", host ? "\r\n" : "");
    ck_assert_int_eq(send(s, request, (size_t)length, MSG_NOSIGNAL), length);
    size_t have = 0;
    for (ssize_t got; (got = recv(s, text + have, ROOM - 1 - have, 0)) > 0; have += (size_t)got)
        ;
    close(s);
    text[have] = '\0';
    reply r = {.head = text, .body = strstr(text, "\r\n\r\n")};
    ck_assert_msg(sscanf(text, "HTTP/1.1 %d", &r.status) == 1 && r.body, "no answer to %s %s", method, path);
    *r.body = '\0';
    r.body += 4;
    r.size = have - (size_t)(r.body - text);
    return r;
}

static reply get(const opened *o, const char *rest)
{
    char host[40], path[128];
    snprintf(host, sizeof host, "127.0.0.1:%d", o->port);
    snprintf(path, sizeof path, "%s%s", o->path, rest);
    return ask(o, "GET", path, host);
}

START_TEST(page_and_record_are_given)
{
    opened o;
    fram_error e;
    if (!set_up(&o))
        return;
    begin(&o);
    reply r = get(&o, "");
    ck_assert_int_eq(r.status, 200);
    ck_assert_str_eq(r.body, "<p data=\"record\"></p>");
    ck_assert_ptr_nonnull(strstr(r.head, "Referrer-Policy: no-referrer"));
    ck_assert_ptr_nonnull(strstr(r.head, "default-src 'none'"));
    /* The first frame is there before the first step, and each step's when it returns. */
    static char seen[ROOM];
    size_t have = 0;
    for (int step = 0; step <= 20; step++) {
        char rest[64];
        snprintf(rest, sizeof rest, "record?from=%zu", have);
        r = get(&o, rest);
        ck_assert_int_eq(r.status, 200);
        ck_assert_ptr_nonnull(strstr(r.head, "Fram-Run: running"));
        ck_assert_msg((r.size > 0) == (step % 2 == 0), "%zu bytes at step %d", r.size, step);
        memcpy(seen + have, r.body, r.size);
        have += r.size;
        if (step < 20)
            assert_ok(fram_world_step(o.w, &e), e);
    }
    assert_ok(fram_world_record_end(o.w, NULL, &e), e);
    char path[128];
    snprintf(path, sizeof path, "%s/record.fram", o.run);
    FILE *file = fopen(path, "rb");
    ck_assert_ptr_nonnull(file);
    static char written[ROOM];
    size_t size = fread(written, 1, sizeof written, file);
    fclose(file);
    ck_assert_uint_eq(size, have);
    ck_assert_mem_eq(written, seen, have);
    ck_assert_int_eq(dial(o.port, INADDR_LOOPBACK), -1);
    tear_down(&o);
}
END_TEST

static int status_of(const opened *o, const char *method, const char *path, const char *host)
{
    return ask(o, method, path, host).status;
}

START_TEST(others_are_refused)
{
    opened o;
    if (!set_up(&o))
        return;
    begin(&o);
    char own[40], local[40], wrong[64], path[160];
    snprintf(own, sizeof own, "127.0.0.1:%d", o.port);
    snprintf(local, sizeof local, "localhost:%d", o.port);
    ck_assert_int_eq(status_of(&o, "GET", o.path, local), 200);
    /* Other hosts, and none at all. */
    ck_assert_int_eq(status_of(&o, "GET", o.path, "evil.example"), 403);
    ck_assert_int_eq(status_of(&o, "GET", o.path, "127.0.0.1"), 403);
    snprintf(wrong, sizeof wrong, "evil.example:%d", o.port);
    ck_assert_int_eq(status_of(&o, "GET", o.path, wrong), 403);
    ck_assert_int_ge(status_of(&o, "GET", o.path, NULL), 400);
    /* Other methods. */
    const char *const methods[] = {"POST", "PUT", "DELETE", "OPTIONS", "HEAD"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
        ck_assert_int_eq(status_of(&o, methods[i], o.path, own), 405);
    /* Other paths: without the token, with each digit of it wrong, with more or less of it, and beside the two. */
    const char *const paths[] = {"/", "/record?from=0", "/index.html", "//"};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++)
        ck_assert_int_eq(status_of(&o, "GET", paths[i], own), 404);
    for (size_t i = 1; i <= 32; i++) {
        snprintf(path, sizeof path, "%s", o.path);
        path[i] = path[i] == '0' ? '1' : '0';
        ck_assert_int_eq(status_of(&o, "GET", path, own), 404);
    }
    const char *const rests[] = {"index.html", "record/", "../record", "run.json", "%2e%2e/scenario.yaml"};
    for (size_t i = 0; i < sizeof rests / sizeof *rests; i++)
        ck_assert_int_eq(get(&o, rests[i]).status, 404);
    const char *const queries[] = {"record",
                                   "record?from=",
                                   "record?from=-1",
                                   "record?from=1e3",
                                   "record?from=0x10",
                                   "record?from= 1",
                                   "record?from=9999999999999999"};
    for (size_t i = 0; i < sizeof queries / sizeof *queries; i++)
        ck_assert_msg(get(&o, queries[i]).status == 400, "%s", queries[i]);
    ck_assert_uint_eq(get(&o, "record?from=999999999999999").size, 0);
    /* Nothing listens on other addresses of this machine. */
    ck_assert_int_eq(dial(o.port, INADDR_LOOPBACK + 1), -1);
    tear_down(&o);
}
END_TEST

START_TEST(misuse_is_refused)
{
    opened o;
    fram_error e;
    fram_record_definition d;
    if (!set_up(&o))
        return;
    fram_record_default(&d);
    d.folder = o.run;
    d.live_page = o.page;
    ck_assert_int_eq(fram_world_record(o.w, &d, &e), FRAM_ERROR_USAGE);
    ck_assert_str_eq(e.key, "live");
    d.live = keep_address;
    d.live_user = &o;
    d.live_page = "/nowhere/playback.html";
    ck_assert_int_eq(fram_world_record(o.w, &d, &e), FRAM_ERROR_INPUT);
    scratch_text(o.page, "no marks");
    d.live_page = o.page;
    ck_assert_int_eq(fram_world_record(o.w, &d, &e), FRAM_ERROR_INPUT);
    ck_assert(!fram_world_is_recorded(o.w) && o.told == 0);
    /* The same of runs; and a run that cannot begin closes its view. */
    fram_run_definition run;
    fram_run_default(&run);
    run.folder = o.run;
    run.live_page = o.page;
    ck_assert_int_eq(fram_run(o.s, &run, NULL, &e), FRAM_ERROR_USAGE);
    run.live = keep_address;
    run.live_user = &o;
    ck_assert_int_eq(fram_resume(o.ctx, &run, NULL, &e), FRAM_ERROR_INPUT);
    /* A program that knows nothing of live views hands over a shorter definition. */
    fram_run_default(&run);
    run.folder = o.run;
    run.size = offsetof(fram_run_definition, live_page);
    run.live_page = "/nowhere/playback.html";
    assert_ok(fram_run(o.s, &run, NULL, &e), e);
    tear_down(&o);
}
END_TEST

START_TEST(builds_without_it_say_so)
{
    fram_error e;
    fram_context *ctx;
    if (strstr(fram_features(), "libmicrohttpd"))
        return;
    fram_run_definition run;
    fram_run_default(&run);
    run.folder = "/tmp/nowhere";
    run.live_page = "page.html";
    run.live = keep_address;
    assert_ok(fram_context_create(NULL, &ctx, &e), e);
    ck_assert_int_eq(fram_resume(ctx, &run, NULL, &e), FRAM_ERROR_UNSUPPORTED);
    fram_context_destroy(ctx);
}
END_TEST

TEST_MAIN("live view", page_and_record_are_given, others_are_refused, misuse_is_refused, builds_without_it_say_so)

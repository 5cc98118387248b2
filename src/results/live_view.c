#include "results/live_view.h"

#ifdef FRAM_HAVE_LIBMICROHTTPD

#include "base/clock.h"
#include "io/path.h"
#include "results/playback.h"
#include "results/playback_explained.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <microhttpd.h>
#include <netinet/in.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* 128 random bits cannot be guessed. */
enum { TOKEN_BYTES = 16, TOKEN_DIGITS = 2 * TOKEN_BYTES };
/* A page needs one connection, two while it is read again; a connection that says nothing is closed. */
enum { CONNECTIONS_MOST = 16, SILENCE_MOST = 10 };
/* One answer holds at most so much of the record: the page draws while the rest comes [bytes]. */
#define ANSWER_MOST ((uint64_t)4 << 20)
/* Pages ask four times a second.  One that has not asked for so long is not there any more, and the end of a run waits
   for the others so long at most [s]. */
#define ABSENT 0.6
#define WAIT_MOST 3.0

struct live_view {
    context *ctx;
    struct MHD_Daemon *daemon;
    char folder[PATH_ROOM], record[PATH_ROOM];
    char *page;
    size_t page_size;
    char token[TOKEN_DIGITS + 1];
    char hosts[2][40]; /* what a browser on this machine says it asks */
    char address[TOKEN_DIGITS + 48];
    atomic_bool begun, ended;
    text_buffer loads;    /* blocks that follow the record for whoever looks on; whole before `ended` */
    _Atomic double asked; /* when a page was last given less than the whole record [s]; 0: never */
};

/* ---- answers: from the daemon's thread ---- */

static enum MHD_Result answer(struct MHD_Connection *connection, unsigned status, struct MHD_Response *response)
{
    /* No other page may read or frame it, and its address, which is the key, goes nowhere. */
    static const char *const headers[][2] = {
        {"Cache-Control", "no-store"},
        {"Content-Security-Policy", "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
                                    "img-src data: blob:; media-src blob:; connect-src 'self'; frame-ancestors 'none'; "
                                    "base-uri 'none'; form-action 'none'"},
        {"Cross-Origin-Opener-Policy", "same-origin"},
        {"Cross-Origin-Resource-Policy", "same-origin"},
        {"Referrer-Policy", "no-referrer"},
        {"X-Content-Type-Options", "nosniff"},
        {"X-Frame-Options", "DENY"},
    };
    if (!response)
        return MHD_NO;
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++)
        MHD_add_response_header(response, headers[i][0], headers[i][1]);
    enum MHD_Result queued = MHD_queue_response(connection, status, response);
    MHD_destroy_response(response);
    return queued;
}

static enum MHD_Result refuse(struct MHD_Connection *connection, unsigned status, const char *reason)
{
    char text[80]; /* copied by the library, which takes no const */
    int length = snprintf(text, sizeof text, "%s\n", reason);
    struct MHD_Response *response = MHD_create_response_from_buffer((size_t)length, text, MHD_RESPMEM_MUST_COPY);
    if (response)
        MHD_add_response_header(response, "Content-Type", "text/plain; charset=utf-8");
    if (response && status == MHD_HTTP_METHOD_NOT_ALLOWED)
        MHD_add_response_header(response, "Allow", "GET");
    return answer(connection, status, response);
}

/* A name that is not this machine's own would be a page from elsewhere whose name was made to lead here. */
static bool host_is_own(const live_view *v, struct MHD_Connection *connection)
{
    const char *host = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, MHD_HTTP_HEADER_HOST);
    return host && (strcmp(host, v->hosts[0]) == 0 || strcmp(host, v->hosts[1]) == 0);
}

/* What follows the token in a path, NULL for another token.  How long it takes tells nothing of where they differ. */
static const char *after_token(const live_view *v, const char *path)
{
    if (strlen(path) < TOKEN_DIGITS + 2 || path[0] != '/' || path[TOKEN_DIGITS + 1] != '/')
        return NULL;
    unsigned differs = 0;
    for (size_t i = 0; i < TOKEN_DIGITS; i++)
        differs |= (unsigned)(unsigned char)path[i + 1] ^ (unsigned)(unsigned char)v->token[i];
    return differs == 0 ? path + TOKEN_DIGITS + 2 : NULL;
}

static enum MHD_Result give_page(live_view *v, struct MHD_Connection *connection)
{
    struct MHD_Response *response = MHD_create_response_from_buffer(v->page_size, v->page, MHD_RESPMEM_PERSISTENT);
    if (response)
        MHD_add_response_header(response, "Content-Type", "text/html; charset=utf-8");
    return answer(connection, MHD_HTTP_OK, response);
}

/* "from" of the query: where the page's part of the record ends. */
static bool asked_from(struct MHD_Connection *connection, uint64_t *from)
{
    enum { DIGITS_MOST = 15 };
    const char *text = MHD_lookup_connection_value(connection, MHD_GET_ARGUMENT_KIND, "from");
    size_t length = text ? strlen(text) : 0;
    if (length == 0 || length > DIGITS_MOST || strspn(text, "0123456789") != length)
        return false;
    *from = strtoull(text, NULL, 10);
    return true;
}

/* What the record holds from there on, then what follows it; an empty answer while there is nothing. */
static enum MHD_Result give_record(live_view *v, struct MHD_Connection *connection)
{
    uint64_t from, size = 0, given = 0;
    if (!asked_from(connection, &from))
        return refuse(connection, MHD_HTTP_BAD_REQUEST, "expected record?from=BYTES");
    /* Before the size is looked at: it is final once the run has ended. */
    bool ended = atomic_load(&v->ended);
    int descriptor = atomic_load(&v->begun) ? open(v->record, O_RDONLY | O_CLOEXEC | O_NOFOLLOW) : -1;
    struct stat about;
    if (descriptor >= 0 && fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode))
        size = (uint64_t)about.st_size;
    if (from < size)
        given = size - from < ANSWER_MOST ? size - from : ANSWER_MOST;
    uint64_t total = size + (ended ? (uint64_t)v->loads.count : 0);
    struct MHD_Response *response = NULL;
    if (given > 0) {
        response = MHD_create_response_from_fd_at_offset64(given, descriptor, from);
        if (!response)
            close(descriptor);
    } else {
        if (descriptor >= 0)
            close(descriptor);
        given = from < total ? total - from : 0;
        response = MHD_create_response_from_buffer((size_t)given, given > 0 ? v->loads.data + (from - size) : "",
                                                   MHD_RESPMEM_PERSISTENT);
    }
    /* The answer with the last bytes says so: nothing is left to ask for, and nobody may be there to be asked. */
    bool whole = ended && from + given >= total;
    if (given > 0 || !whole)
        atomic_store(&v->asked, clock_wall());
    if (response) {
        MHD_add_response_header(response, "Content-Type", "application/octet-stream");
        MHD_add_response_header(response, "Fram-Run", whole ? "ended" : "running");
    }
    return answer(connection, MHD_HTTP_OK, response);
}

static enum MHD_Result on_request(void *user, struct MHD_Connection *connection, const char *path, const char *method,
                                  const char *version, const char *upload, size_t *upload_size, void **state)
{
    (void)version;
    (void)upload;
    (void)state;
    live_view *v = user;
    *upload_size = 0; /* whatever came with it is not read */
    if (!host_is_own(v, connection))
        return refuse(connection, MHD_HTTP_FORBIDDEN, "this is not for other hosts");
    if (strcmp(method, MHD_HTTP_METHOD_GET) != 0)
        return refuse(connection, MHD_HTTP_METHOD_NOT_ALLOWED, "expected GET");
    const char *rest = after_token(v, path);
    if (rest && strcmp(rest, "") == 0)
        return give_page(v, connection);
    if (rest && strcmp(rest, "record") == 0)
        return give_record(v, connection);
    return refuse(connection, MHD_HTTP_NOT_FOUND, "there is nothing here");
}

/* ---- opening ---- */

static fram_status draw_token(live_view *v, fram_error *error)
{
    unsigned char bytes[TOKEN_BYTES];
    if (getrandom(bytes, sizeof bytes, 0) != (ssize_t)sizeof bytes)
        return error_set(error, FRAM_ERROR_IO, NULL, 0, "live", "the system gave no random numbers: %s",
                         strerror(errno));
    for (size_t i = 0; i < TOKEN_BYTES; i++)
        snprintf(v->token + 2 * i, 3, "%02x", bytes[i]);
    return FRAM_OK;
}

/* Signals are left to the threads of the host program. */
static struct MHD_Daemon *start(live_view *v)
{
    struct sockaddr_in loopback = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    struct MHD_Daemon *daemon =
        MHD_start_daemon(MHD_USE_INTERNAL_POLLING_THREAD | MHD_USE_AUTO, 0, NULL, NULL, on_request, v,
                         MHD_OPTION_SOCK_ADDR, &loopback, MHD_OPTION_CONNECTION_LIMIT, (unsigned)CONNECTIONS_MOST,
                         MHD_OPTION_CONNECTION_TIMEOUT, (unsigned)SILENCE_MOST, MHD_OPTION_END);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return daemon;
}

static fram_status listen_there(live_view *v, fram_error *error)
{
    v->daemon = start(v);
    const union MHD_DaemonInfo *info = v->daemon ? MHD_get_daemon_info(v->daemon, MHD_DAEMON_INFO_BIND_PORT) : NULL;
    if (!info || info->port == 0)
        return error_set(error, FRAM_ERROR_IO, NULL, 0, "live",
                         "the loopback address cannot be listened on (is there a network in this container?)");
    unsigned port = info->port;
    snprintf(v->hosts[0], sizeof v->hosts[0], "127.0.0.1:%u", port);
    snprintf(v->hosts[1], sizeof v->hosts[1], "localhost:%u", port);
    snprintf(v->address, sizeof v->address, "http://127.0.0.1:%u/%s/", port, v->token);
    return FRAM_OK;
}

static void free_view(live_view *v)
{
    if (v->daemon)
        MHD_stop_daemon(v->daemon);
    memory_free(v->ctx, v->page);
    text_free(v->ctx, &v->loads);
    memory_free(v->ctx, v);
}

fram_status live_view_open(context *ctx, const char *folder, const char *viewer, live_view **view, fram_error *error)
{
    live_view *v = memory_array(ctx, 1, sizeof *v);
    if (!v)
        return error_memory(error);
    v->ctx = ctx;
    atomic_init(&v->begun, false);
    atomic_init(&v->ended, false);
    atomic_init(&v->asked, 0);
    fram_status status = path_join(folder, "record.fram", v->record, error);
    snprintf(v->folder, sizeof v->folder, "%s", folder);
    if (status == FRAM_OK)
        status = playback_live_page(ctx, viewer, "record", &v->page, &v->page_size, error);
    if (status == FRAM_OK)
        status = draw_token(v, error);
    if (status == FRAM_OK)
        status = listen_there(v, error);
    if (status == FRAM_OK)
        *view = v;
    else
        free_view(v);
    return status;
}

const char *live_view_address(const live_view *v) { return v->address; }

void live_view_begin(live_view *v)
{
    if (v)
        atomic_store(&v->begun, true);
}

static bool is_looked_at(live_view *v) { return clock_wall() - atomic_load(&v->asked) < ABSENT; }

/* Loads by mechanism and the explained peaks, as a page from disk has them, for whoever looks on, of a run that was
   asked to stop too; without them when they cannot be read, of a run that failed for one. */
static void explain_loads(live_view *v)
{
    context own = context_unstopped(v->ctx);
    if (atomic_load(&v->begun) && is_looked_at(v) &&
        playback_explain(&own, v->folder, NULL, &v->loads, NULL) != FRAM_OK)
        text_free(&own, &v->loads);
}

void live_view_end(live_view *v)
{
    if (!v)
        return;
    explain_loads(v);
    atomic_store(&v->ended, true);
    const struct timespec moment = {.tv_nsec = 20000000};
    double until = clock_wall() + WAIT_MOST;
    while (clock_wall() < until && is_looked_at(v))
        nanosleep(&moment, NULL);
    free_view(v);
}

#else

fram_status live_view_open(context *ctx, const char *folder, const char *viewer, live_view **view, fram_error *error)
{
    (void)ctx;
    (void)folder;
    (void)viewer;
    (void)view;
    return error_set(error, FRAM_ERROR_UNSUPPORTED, NULL, 0, "live",
                     "this build has no libmicrohttpd, which the live view needs");
}

const char *live_view_address(const live_view *v)
{
    (void)v;
    return "";
}
void live_view_begin(live_view *v) { (void)v; }
void live_view_end(live_view *v) { (void)v; }

#endif

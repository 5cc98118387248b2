/* What a command needs around the library: a context that logs to standard error, Ctrl-C, a progress line. */
#include "cli/cli.h"

#include "fram/statistics.h"

#include <math.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static void log_to_stderr(void *user, fram_log_level level, const char *text)
{
    (void)user;
    static const char *const prefix[] = {"error: ", "warning: ", "", ""};
    terminal_clear();
    tell(stderr, "%s%s\n", prefix[level], text);
}

/* The only mutable globals of Fram: a signal handler can reach nothing else. */
static _Atomic int64_t first_signal; /* when it came [ms]; 0: none did */
static volatile int stop_flag;       /* which no signal sets before session_stop_flag */

static fram_context_definition session_definition(const common_options *common)
{
    fram_context_definition definition;
    fram_context_default(&definition);
    definition.log = log_to_stderr;
    definition.stop = &stop_flag;
    definition.verbosity = common->quiet ? FRAM_LOG_ERROR : common->verbose ? FRAM_LOG_DEBUG : FRAM_LOG_INFO;
    definition.threads = common->threads;
    definition.isa = common->isa;
    return definition;
}

static int create(const common_options *common, const fram_context_definition *definition, fram_context **context)
{
    fram_error error;
    return fram_context_create(definition, context, &error) == FRAM_OK ? -1 : answer_error(common, &error);
}

int session_open(const common_options *common, fram_context **context)
{
    const fram_context_definition definition = session_definition(common);
    return create(common, &definition, context);
}

/* What takes less time than the first is not worth a word; then a word after each of the others, on a terminal and
   elsewhere [s]. */
#define QUIET_TIME 1.0
#define TERMINAL_PERIOD 0.2
#define LINE_PERIOD 5.0

double wall_clock(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void work_show(void *user, const char *what, double done, double total)
{
    work_view *view = user;
    double now = wall_clock();
    /* What goes back begins again: a record is read several times, and of a short file its beginning alone is told. */
    if (strcmp(view->what, what) != 0 || done < view->done || (done == 0 && total > 0)) {
        snprintf(view->what, sizeof view->what, "%s", what);
        view->begun = now;
        view->first = done;
        view->shown = now - LINE_PERIOD;
    }
    view->done = done;
    if (now - view->begun < QUIET_TIME || now - view->shown < (view->terminal ? TERMINAL_PERIOD : LINE_PERIOD))
        return;
    view->shown = now;
    line_part part[2] = {0};
    char words[DURATION_ROOM];
    snprintf(part[0].text, sizeof part[0].text, total > 0 ? "%s: %.0f %%" : "%s: round %.0f", what,
             total > 0 ? 100 * done / total : done);
    if (total > 0)
        snprintf(part[1].text, sizeof part[1].text, "  left %s",
                 duration_words(done > view->first ? (now - view->begun) * (total - done) / (done - view->first)
                                                   : (double)NAN,
                                words));
    part[1].rank = 1;
    terminal_line(part, 2);
    /* On a terminal whatever comes next is written over it. */
    if (view->terminal)
        fputc('\r', stderr);
    fflush(stderr);
}

static int open_shown(const common_options *common, session_kind kind, work_view *view, fram_context **context)
{
    fram_context_definition definition = session_definition(common);
    *view = (work_view){.terminal = terminal_draws()};
    if (kind == SESSION_MAKES)
        (void)session_stop_flag();
    definition.work = common->quiet ? NULL : work_show;
    definition.work_user = view;
    return create(common, &definition, context);
}

int session_open_reading(const common_options *common, work_view *view, fram_context **context)
{
    return open_shown(common, SESSION_READS, view, context);
}

int session_open_making(const common_options *common, work_view *view, fram_context **context)
{
    return open_shown(common, SESSION_MAKES, view, context);
}

session_kind session_kind_for(const char *file) { return file ? SESSION_MAKES : SESSION_READS; }

int session_open_for(const char *file, const common_options *common, work_view *view, fram_context **context)
{
    return open_shown(common, session_kind_for(file), view, context);
}

int session_open_files(const common_options *common, const command_files *files, session_kind kind, work_view *view,
                       fram_context **context)
{
    int code = refuse_outputs(common, files);
    return code >= 0 ? code : open_shown(common, kind, view, context);
}

/* One wish to stop often comes as two signals: a closed terminal's from the shell and the kernel, that of timeout to
   the program and to its group.  What comes sooner after the first is the same wish [ms]. */
#define SAME_WISH 500

static void on_signal(int number)
{
    int64_t now = (int64_t)(1e3 * wall_clock()) + 1, first = 0;
    if (atomic_compare_exchange_strong(&first_signal, &first, now))
        stop_flag = 1;
    else if (number != SIGHUP && now - first >= SAME_WISH)
        _exit(128 + number);
}

const volatile int *session_stop_flag(void)
{
    struct sigaction action = {.sa_handler = on_signal};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    /* A terminal that closes stops a run as Ctrl-C does, unless nohup has said otherwise; a closed pipe costs it its
       progress lines, not the run. */
    struct sigaction hangup;
    if (sigaction(SIGHUP, NULL, &hangup) == 0 && hangup.sa_handler != SIG_IGN)
        sigaction(SIGHUP, &action, NULL);
    signal(SIGPIPE, SIG_IGN);
    return &stop_flag;
}

void progress_begin(progress_view *view)
{
    *view = (progress_view){.terminal = terminal_draws(), .last_tenth = -1, .shown = wall_clock()};
}

const char *plural(int64_t count) { return count == 1 ? "" : "s"; }

const char *duration_words(double seconds, char out[DURATION_ROOM])
{
    double whole = floor(seconds + 0.5);
    if (isnan(seconds) || (seconds > 0 && whole < 1))
        snprintf(out, DURATION_ROOM, "%s", isnan(seconds) ? "not known yet" : "less than 1 s");
    else
        fram_duration_text(whole, out, DURATION_ROOM);
    return out;
}

void print_duration(double seconds)
{
    char text[DURATION_ROOM];
    fputs(duration_words(seconds, text), stderr);
}

void progress_show(void *user, const fram_progress *p)
{
    progress_view *view = user;
    double percent = p->end > 0 ? 100 * p->time / p->end : 100;
    int tenth = (int)(percent / 10);
    double now = wall_clock();
    if (!view->terminal && tenth == view->last_tenth && now - view->shown < LINE_PERIOD)
        return;
    view->last_tenth = tenth;
    view->shown = now;
    line_part part[4] = {{.rank = 0}, {.rank = 1}, {.rank = 2}, {.rank = 0}};
    char words[DURATION_ROOM];
    snprintf(part[0].text, sizeof part[0].text, "%5.1f %%", percent);
    snprintf(part[1].text, sizeof part[1].text, "  t = %.2f of %g s", p->time, p->end);
    snprintf(part[2].text, sizeof part[2].text, "  real-time factor %.2f", p->real_time_factor);
    snprintf(part[3].text, sizeof part[3].text, "  left %s", duration_words(p->eta, words));
    terminal_line(part, 4);
    view->drawn = view->terminal;
}

void progress_end(progress_view *view)
{
    if (view->drawn)
        fputc('\n', stderr);
}

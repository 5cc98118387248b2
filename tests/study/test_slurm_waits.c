/* What a full cluster says: tasks that wait, and why, as `squeue` tells it.  A scheduler of two scripts answers. */
#include "scratch.h"

#include "study/slurm.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct scheduler {
    char folder[SCRATCH_FOLDER], before[4096];
} scheduler;

static void write_script(const scheduler *s, const char *name, const char *text)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", s->folder, name);
    int file = open(path, O_CREAT | O_TRUNC | O_WRONLY, 0755);
    ck_assert(file >= 0);
    ck_assert_int_eq((int)write(file, text, strlen(text)), (int)strlen(text));
    close(file);
}

static void begin(scheduler *s)
{
    scratch_folder(s->folder);
    snprintf(s->before, sizeof s->before, "%s", getenv("PATH"));
    char path[4200];
    snprintf(path, sizeof path, "%s:%s", s->folder, s->before);
    setenv("PATH", path, 1);
    write_script(s, "sbatch", "#!/bin/sh\necho 7\n");
    write_script(s, "scancel", "#!/bin/sh\n");
}

static void end(scheduler *s)
{
    setenv("PATH", s->before, 1);
    scratch_remove_folder(s->folder);
}

/* So many questions to the scheduler, however soon. */
static void look(slurm_pool *queue, int times)
{
    for (int i = 0; i < times; i++) {
        queue->asked = -1e9;
        slurm_look(queue);
    }
}

/* What the study says when squeue answers so. */
static const char *told(scheduler *s, slurm_pool *queue, const char *answer)
{
    char script[400];
    snprintf(script, sizeof script, "#!/bin/sh\ncat <<'END'\n%sEND\n", answer);
    write_script(s, "squeue", script);
    look(queue, 1);
    return slurm_waits(queue);
}

START_TEST(tasks_that_wait_are_told_with_their_reasons)
{
    context ctx;
    context_init(&ctx);
    scheduler s;
    begin(&s);
    const slurm_options options = {.runs_per_task = 1};
    slurm_pool queue;
    fram_error error;
    ck_assert_int_eq(slurm_begin(&ctx, &options, s.folder, "/bin/fram", &queue, &error), FRAM_OK);
    for (int i = 0; i < 3; i++)
        ck_assert(slurm_add(&queue, "0123456789ab", 1 + i, i, 0));
    ck_assert_int_eq(slurm_submit(&queue, &error), FRAM_OK);
    ck_assert_ptr_null(slurm_waits(&queue));
    ck_assert_str_eq(told(&s, &queue, "7_0 R None\n7_1 PD Resources\n7_2 PD Resources\n"),
                     "2 tasks wait at Slurm: Resources");
    ck_assert_str_eq(told(&s, &queue, "7_0 R None\n7_1 PD Resources\n7_2 PD Priority\n"),
                     "2 tasks wait at Slurm: Resources, Priority");
    /* Those of another study are not ours. */
    ck_assert_str_eq(told(&s, &queue, "77_0 PD Dependency\n7_1 R None\n7_2 PD ReqNodeNotAvail, May be reserved\n"),
                     "1 task waits at Slurm: ReqNodeNotAvail, May be reserved");
    ck_assert_ptr_null(told(&s, &queue, "7_0 R None\n7_1 R None\n7_2 R None\n77_0 PD Resources\n"));
    slurm_end(&queue, false);
    slurm_free(&queue);
    end(&s);
}
END_TEST

static void begin_queue(context *ctx, scheduler *s, const slurm_options *options, slurm_pool *queue)
{
    fram_error error;
    context_init(ctx);
    begin(s);
    ck_assert_int_eq(slurm_begin(ctx, options, s->folder, "/bin/fram", queue, &error), FRAM_OK);
    ck_assert(slurm_add(queue, "0123456789ab", 1, 5, 0));
    ck_assert_int_eq(slurm_submit(queue, &error), FRAM_OK);
}

/* Whether the folder tells the number of its first array. */
static bool has_job(const scheduler *s)
{
    char path[128];
    snprintf(path, sizeof path, "%s/slurm/1.job", s->folder);
    return access(path, F_OK) == 0;
}

/* A run whose tasks vanish again and again, cancelled by somebody, say, is submitted four times and no more. */
START_TEST(what_is_lost_again_and_again_has_failed)
{
    context ctx;
    scheduler s;
    slurm_pool queue;
    fram_error error;
    const slurm_options options = {.runs_per_task = 1};
    begin_queue(&ctx, &s, &options, &queue);
    int32_t task = -1;
    int code = 0, looks = 0;
    for (; !slurm_ended(&queue, &task, &code) && looks < 20; looks++) {
        ck_assert_ptr_null(told(&s, &queue, ""));
        ck_assert_int_eq(slurm_submit(&queue, &error), FRAM_OK);
    }
    ck_assert_int_eq(task, 5);
    ck_assert_int_eq(code, 128 + 9);
    ck_assert_int_eq(queue.arrays, 4);
    ck_assert_int_eq(queue.runs.count, 0);
    slurm_free(&queue);
    end(&s);
}
END_TEST

/* Tasks of another name, which `#SBATCH --job-name` of a user or SBATCH_JOB_NAME gives, are there all the same. Numbers
   of what has ended are not kept: there, they would be cancelled by the next call, whosever they are by then. */
START_TEST(tasks_are_known_by_their_number)
{
    context ctx;
    scheduler s;
    slurm_pool queue;
    const slurm_options options = {.runs_per_task = 1};
    begin_queue(&ctx, &s, &options, &queue);
    ck_assert(has_job(&s));
    write_script(&s, "squeue", "#!/bin/sh\ncase $* in *--name*) ;; *) echo 7_0 R None ;; esac\n");
    look(&queue, 4);
    ck_assert_int_eq(queue.runs.data[0].array, 0);
    ck_assert_int_eq(queue.runs.data[0].missed, 0);
    slurm_free(&queue);
    ck_assert(!has_job(&s));
    end(&s);
}
END_TEST

static void count_silence(void *user, log_level level, const char *text)
{
    *(int *)user += level == LOG_WARNING &&
                    strstr(text, "squeue does not answer (squeue: unrecognized option '--me' Try --help)") != NULL;
}

/* Of a scheduler that never answers nobody would know why lost tasks stay lost: it is told, once. */
START_TEST(a_scheduler_that_does_not_answer_is_told)
{
    context ctx;
    scheduler s;
    slurm_pool queue;
    int told_of = 0;
    const slurm_options options = {.runs_per_task = 1};
    begin_queue(&ctx, &s, &options, &queue);
    ctx.log = count_silence;
    ctx.log_user = &told_of;
    write_script(&s, "squeue", "#!/bin/sh\necho \"squeue: unrecognized option '--me'\nTry --help\" >&2\nexit 1\n");
    for (int i = 0; i < 12; i++) {
        ck_assert_int_eq(told_of, i >= 5);
        look(&queue, 1);
    }
    ck_assert_int_eq(queue.runs.data[0].array, 0);
    slurm_free(&queue);
    end(&s);
}
END_TEST

/* What a cluster has to say to who submits comes with the number, on a line of its own. */
START_TEST(the_number_of_an_array_is_found_among_words)
{
    static const char *const words[] = {"echo 'sbatch: 2 notes: your account is ice' >&2\necho 7",
                                        "echo '7;far'\necho 'sbatch: ready' >&2"};
    for (int i = 0; i < 2; i++) {
        context ctx;
        scheduler s;
        slurm_pool queue;
        fram_error error;
        const slurm_options options = {.runs_per_task = 1};
        char script[128];
        context_init(&ctx);
        begin(&s);
        snprintf(script, sizeof script, "#!/bin/sh\n%s\n", words[i]);
        write_script(&s, "sbatch", script);
        ck_assert_int_eq(slurm_begin(&ctx, &options, s.folder, "/bin/fram", &queue, &error), FRAM_OK);
        ck_assert(slurm_add(&queue, "0123456789ab", 1, 0, 0));
        ck_assert_msg(slurm_submit(&queue, &error) == FRAM_OK, "%s", error.message);
        ck_assert_int_eq(queue.jobs.data[0], 7);
        slurm_free(&queue);
        end(&s);
    }
}
END_TEST

/* Where sbatch ends well without a word something may have been taken: that is no refusal, which would be tried again.
 */
START_TEST(an_array_without_a_number_ends_the_study)
{
    context ctx;
    scheduler s;
    slurm_pool queue;
    fram_error error;
    const slurm_options options = {.runs_per_task = 1, .poll = 1e-9};
    begin_queue(&ctx, &s, &options, &queue);
    write_script(&s, "sbatch", "#!/bin/sh\n");
    ck_assert(slurm_add(&queue, "0123456789ab", 2, 6, 0));
    ck_assert_int_eq(slurm_submit(&queue, &error), FRAM_ERROR_IO);
    ck_assert_ptr_nonnull(strstr(error.message, "sbatch told no number; look with squeue"));
    slurm_free(&queue);
    end(&s);
}
END_TEST

/* A variable as SBATCH_PARTITION goes before what a script says, an option of the command before both. */
START_TEST(what_is_asked_for_stands_in_the_command_too)
{
    static const char *const more[] = {"--comment=two words", "--nice=5", "--account ice", "--qos=\"a\""};
    slurm_options options = {"long", "1:00:00", more, 4, 2, 0, false, 3};
    context ctx;
    scheduler s;
    slurm_pool queue;
    fram_error error;
    char path[128], line[256] = "";
    context_init(&ctx);
    begin(&s);
    write_script(&s, "sbatch", "#!/bin/sh\nprintf '%s|' \"$@\" >${0%/*}/words\necho 7\n");
    ck_assert_int_eq(slurm_begin(&ctx, &options, s.folder, "/bin/fram", &queue, &error), FRAM_OK);
    for (int i = 0; i < 3; i++)
        ck_assert(slurm_add(&queue, "0123456789ab", i, i, 0));
    ck_assert_int_eq(slurm_submit(&queue, &error), FRAM_OK);
    snprintf(path, sizeof path, "%s/words", s.folder);
    FILE *file = fopen(path, "r");
    ck_assert(file && fgets(line, sizeof line, file));
    fclose(file);
    char *script = strstr(line, s.folder);
    ck_assert_ptr_nonnull(script);
    *script = '\0';
    ck_assert_str_eq(line, "--parsable|--array|0-1%3|--partition|long|--time|1:00:00|--comment=two words|--nice=5|");
    /* The scheduler is asked as often as is wished, else every half minute. */
    assert_bits(slurm_poll(&queue), 30);
    options.poll = 2;
    assert_bits(slurm_poll(&queue), 2);
    slurm_free(&queue);
    end(&s);
}
END_TEST

/* Partitions may be hidden from who does not ask for all, and a user may have asked to see less at a terminal. */
START_TEST(tasks_are_known_in_hidden_partitions)
{
    context ctx;
    scheduler s;
    slurm_pool queue;
    const slurm_options options = {.runs_per_task = 1};
    begin_queue(&ctx, &s, &options, &queue);
    setenv("SQUEUE_STATES", "RUNNING", 1);
    write_script(&s, "squeue",
                 "#!/bin/sh\n[ -n \"$SQUEUE_STATES\" ] || case $* in *--all*) echo 7_0 PD None ;; esac\n");
    look(&queue, 4);
    unsetenv("SQUEUE_STATES");
    ck_assert_int_eq(queue.runs.data[0].array, 0);
    slurm_free(&queue);
    end(&s);
}
END_TEST

/* How many arrays the script below has cancelled. */
static int cancelled(const scheduler *s)
{
    char path[128], line[16];
    int count = 0;
    snprintf(path, sizeof path, "%s/cancelled", s->folder);
    FILE *file = fopen(path, "r");
    while (file && fgets(line, sizeof line, file))
        count += strcmp(line, "7\n") == 0;
    if (file)
        fclose(file);
    return count;
}

/* A scheduler that starts anew when a study ends goes on with its array: the next call cancels it, also for a user who
   wants to be asked. */
START_TEST(what_is_not_cancelled_is_cancelled_by_the_next_call)
{
    context ctx;
    scheduler s;
    slurm_pool queue;
    fram_error error;
    const slurm_options options = {.runs_per_task = 1};
    begin_queue(&ctx, &s, &options, &queue);
    write_script(&s, "scancel", "#!/bin/sh\necho Unable to contact slurm controller >&2\nexit 8\n");
    slurm_end(&queue, false);
    slurm_free(&queue);
    ck_assert(has_job(&s));
    setenv("SCANCEL_INTERACTIVE", "1", 1);
    write_script(&s, "scancel", "#!/bin/sh\n[ -n \"$SCANCEL_INTERACTIVE\" ] || echo $* >>${0%/*}/cancelled\n");
    ck_assert_int_eq(slurm_begin(&ctx, &options, s.folder, "/bin/fram", &queue, &error), FRAM_OK);
    unsetenv("SCANCEL_INTERACTIVE");
    ck_assert_int_eq(cancelled(&s), 1);
    ck_assert(!has_job(&s));
    slurm_end(&queue, true);
    slurm_free(&queue);
    ck_assert_int_eq(cancelled(&s), 1);
    /* What has ended meanwhile is no array that goes on. */
    static const char *const words[] = {"Invalid job id specified", "Job/step already completing or completed"};
    for (int i = 0; i < 2; i++) {
        char script[128];
        snprintf(script, sizeof script, "#!/bin/sh\necho scancel: error: %s >&2\nexit 1\n", words[i]);
        write_script(&s, "scancel", script);
        ck_assert_int_eq(slurm_begin(&ctx, &options, s.folder, "/bin/fram", &queue, &error), FRAM_OK);
        ck_assert(slurm_add(&queue, "0123456789ab", 1, 5, 0));
        ck_assert_int_eq(slurm_submit(&queue, &error), FRAM_OK);
        slurm_end(&queue, false);
        ck_assert(!queue.unstopped);
        slurm_free(&queue);
    }
    end(&s);
}
END_TEST

/* The exit code that a task of the seed leaves. */
static void write_exit(const scheduler *s, int seed, const char *code)
{
    char name[64];
    snprintf(name, sizeof name, "runs/0123456789ab/%d.exit", seed);
    write_script(s, name, code);
}

static void make_runs(const scheduler *s)
{
    char path[128];
    snprintf(path, sizeof path, "%s/runs", s->folder);
    ck_assert_int_eq(mkdir(path, 0777), 0);
    snprintf(path, sizeof path, "%s/runs/0123456789ab", s->folder);
    ck_assert_int_eq(mkdir(path, 0777), 0);
}

/* What failed before the call, by a full disk that ended the one before, say, is tried again; what ended well is taken.
   Of a run that is submitted twice one task may go on when the study ends. */
START_TEST(failures_of_another_call_are_tried_again)
{
    context ctx;
    scheduler s;
    slurm_pool queue;
    fram_error error;
    const slurm_options options = {.runs_per_task = 1};
    begin_queue(&ctx, &s, &options, &queue);
    write_script(&s, "scancel", "#!/bin/sh\necho $* >>${0%/*}/cancelled\n");
    make_runs(&s);
    write_exit(&s, 2, "1\n");
    write_exit(&s, 3, "0\n");
    ck_assert(slurm_add(&queue, "0123456789ab", 2, 6, 0) && slurm_add(&queue, "0123456789ab", 3, 7, 0));
    int32_t task = -1;
    int code = -1;
    ck_assert(slurm_ended(&queue, &task, &code));
    ck_assert_int_eq(task, 7);
    ck_assert_int_eq(code, 0);
    ck_assert(!slurm_ended(&queue, &task, &code));
    slurm_end(&queue, true);
    ck_assert_int_eq(cancelled(&s), 0);
    write_exit(&s, 1, "137\n");
    ck_assert(!slurm_ended(&queue, &task, &code));
    ck_assert_int_eq(slurm_submit(&queue, &error), FRAM_OK);
    slurm_end(&queue, true);
    ck_assert_int_eq(cancelled(&s), 2);
    slurm_free(&queue);
    end(&s);
}
END_TEST

/* Whether the last array was submitted with these words among its options, and its script says so. */
static bool was_submitted_with(const scheduler *s, int array, const char *words)
{
    char path[128], text[4096] = "", line[300] = "";
    snprintf(path, sizeof path, "%s/slurm/%d.sh", s->folder, array);
    FILE *file = fopen(path, "r");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_gt(fread(text, 1, sizeof text - 1, file), 0);
    fclose(file);
    snprintf(path, sizeof path, "%s/words", s->folder);
    file = fopen(path, "r");
    ck_assert_ptr_nonnull(file);
    while (fgets(line, sizeof line, file))
        ;
    fclose(file);
    return strstr(text, words) && strstr(line, words);
}

/* A node without the program ends its tasks at once, and gets more and more of them: it is left out, with those that
   the user leaves out, in what is submitted again.  What cannot start anywhere ends with its code, after as many tries
   as of a node that was lost. */
START_TEST(a_node_that_cannot_start_the_program_is_left_out)
{
    context ctx;
    scheduler s;
    slurm_pool queue;
    fram_error error;
    const char *const own[] = {"--account=ice", "--exclude='n8, n9'"};
    const slurm_options options = {.runs_per_task = 1, .options = own, .option_count = 2};
    begin_queue(&ctx, &s, &options, &queue);
    write_script(&s, "sbatch", "#!/bin/sh\necho $* >>${0%/*}/words\necho 7\n");
    make_runs(&s);
    int32_t task = -1;
    int code = -1;
    write_exit(&s, 1, "127 n3\n");
    ck_assert(!slurm_ended(&queue, &task, &code));
    ck_assert_int_eq(slurm_submit(&queue, &error), FRAM_OK);
    ck_assert(was_submitted_with(&s, 2, "--exclude=n8,n9,n3"));
    write_exit(&s, 1, "126 n30\n");
    ck_assert(!slurm_ended(&queue, &task, &code));
    ck_assert_int_eq(slurm_submit(&queue, &error), FRAM_OK);
    ck_assert(was_submitted_with(&s, 3, "--exclude=n8,n9,n3,n30"));
    /* There are no other nodes: it is tried on all again. */
    write_script(&s, "sbatch", "#!/bin/sh\ncase $* in *n3*) exit 1 ;; esac\necho $* >>${0%/*}/words\necho 7\n");
    write_exit(&s, 1, "127 n3\n");
    ck_assert(!slurm_ended(&queue, &task, &code));
    ck_assert_int_eq(slurm_submit(&queue, &error), FRAM_OK);
    ck_assert_int_eq(queue.arrays, 5);
    ck_assert(!was_submitted_with(&s, 5, "n3"));
    write_exit(&s, 1, "127 n3\n");
    ck_assert(slurm_ended(&queue, &task, &code));
    ck_assert_int_eq(task, 5);
    ck_assert_int_eq(code, 127);
    ck_assert_str_eq(queue.node, "n3");
    slurm_free(&queue);
    end(&s);
}
END_TEST

/* Six runs of one task whose limit of time lets it make one of them each time: none of the others has failed. */
START_TEST(what_a_task_did_not_come_to_has_not_failed)
{
    enum { RUNS = 6 };
    context ctx;
    scheduler s;
    slurm_pool queue;
    fram_error error;
    const slurm_options options = {.runs_per_task = RUNS};
    context_init(&ctx);
    begin(&s);
    make_runs(&s);
    ck_assert_int_eq(slurm_begin(&ctx, &options, s.folder, "/bin/fram", &queue, &error), FRAM_OK);
    for (int i = 1; i <= RUNS; i++)
        ck_assert(slurm_add(&queue, "0123456789ab", i, i, 0));
    ck_assert_int_eq(slurm_submit(&queue, &error), FRAM_OK);
    int ended = 0;
    for (int looks = 0; looks < 4 * RUNS && queue.runs.count > 0; looks++) {
        int32_t task = -1;
        int code = -1;
        if (looks % 2 == 0)
            write_exit(&s, (int)queue.runs.data[queue.runs.count - 1].seed, "0\n");
        while (slurm_ended(&queue, &task, &code)) {
            ck_assert_int_eq(code, 0);
            ended++;
        }
        ck_assert_ptr_null(told(&s, &queue, ""));
        ck_assert_int_eq(slurm_submit(&queue, &error), FRAM_OK);
    }
    ck_assert_int_eq(ended, RUNS);
    slurm_free(&queue);
    end(&s);
}
END_TEST

/* A scheduler that has taken an array and does not answer for a while does not end the study; one that never took any
   does. */
START_TEST(a_scheduler_that_starts_anew_is_waited_for)
{
    context ctx;
    scheduler s;
    slurm_pool queue;
    fram_error error;
    const slurm_options options = {.runs_per_task = 1, .poll = 1e-9};
    static const char gone[] =
        "#!/bin/sh\n[ $1 = --version ] || { echo Unable to contact slurm controller; exit 1; }\n";
    begin_queue(&ctx, &s, &options, &queue);
    write_script(&s, "sbatch", gone);
    ck_assert(slurm_add(&queue, "0123456789ab", 2, 6, 0));
    for (int i = 0; i < 2 * 4; i++)
        ck_assert_int_eq(slurm_submit(&queue, &error), FRAM_OK);
    ck_assert_int_eq(queue.jobs.count, 1);
    write_script(&s, "sbatch", "#!/bin/sh\necho 8\n");
    ck_assert_int_eq(slurm_submit(&queue, &error), FRAM_OK);
    ck_assert_int_eq(queue.jobs.count, 2);
    ck_assert_int_eq(queue.runs.data[1].array, 1);
    ck_assert_int_eq(queue.runs.data[1].tries, 1);
    slurm_free(&queue);
    write_script(&s, "sbatch", gone);
    ck_assert_int_eq(slurm_begin(&ctx, &options, s.folder, "/bin/fram", &queue, &error), FRAM_OK);
    ck_assert(slurm_add(&queue, "0123456789ab", 2, 6, 0));
    ck_assert_int_eq(slurm_submit(&queue, &error), FRAM_ERROR_USAGE);
    ck_assert_ptr_nonnull(strstr(error.message, "Unable to contact"));
    slurm_free(&queue);
    end(&s);
}
END_TEST

TEST_MAIN("slurm_waits", a_node_that_cannot_start_the_program_is_left_out, tasks_that_wait_are_told_with_their_reasons,
          what_is_lost_again_and_again_has_failed, tasks_are_known_by_their_number,
          the_number_of_an_array_is_found_among_words, an_array_without_a_number_ends_the_study,
          what_is_asked_for_stands_in_the_command_too, tasks_are_known_in_hidden_partitions,
          what_is_not_cancelled_is_cancelled_by_the_next_call, failures_of_another_call_are_tried_again,
          what_a_task_did_not_come_to_has_not_failed, a_scheduler_that_starts_anew_is_waited_for,
          a_scheduler_that_does_not_answer_is_told)

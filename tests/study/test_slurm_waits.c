/* What a full cluster says: tasks that wait, and why, as `squeue` tells it.  A scheduler of two scripts answers. */
#include "testing.h"

#include "study/slurm.h"

#include <fcntl.h>
#include <unistd.h>

typedef struct scheduler {
    char folder[64], before[4096];
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
    strcpy(s->folder, "/tmp/fram-waits-XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(s->folder));
    snprintf(s->before, sizeof s->before, "%s", getenv("PATH"));
    char path[4200];
    snprintf(path, sizeof path, "%s:%s", s->folder, s->before);
    setenv("PATH", path, 1);
    write_script(s, "sbatch", "#!/bin/sh\necho 7\n");
    write_script(s, "scancel", "#!/bin/sh\n");
}

static void end(scheduler *s)
{
    char command[96];
    setenv("PATH", s->before, 1);
    snprintf(command, sizeof command, "rm -r %s", s->folder);
    ck_assert_int_eq(system(command), 0); /* NOLINT(cert-env33-c): a folder of mkdtemp */
}

/* What the study says when squeue answers so. */
static const char *told(scheduler *s, slurm_pool *queue, const char *answer)
{
    char script[400];
    snprintf(script, sizeof script, "#!/bin/sh\ncat <<'END'\n%sEND\n", answer);
    write_script(s, "squeue", script);
    queue->asked = -1e9;
    slurm_look(queue);
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
    slurm_stop(&queue);
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
    for (int i = 0; i < 4; i++) {
        queue.asked = -1e9;
        slurm_look(&queue);
    }
    ck_assert_int_eq(queue.runs.data[0].array, 0);
    ck_assert_int_eq(queue.runs.data[0].missed, 0);
    slurm_free(&queue);
    ck_assert(!has_job(&s));
    end(&s);
}
END_TEST

TEST_MAIN("slurm_waits", tasks_that_wait_are_told_with_their_reasons, what_is_lost_again_and_again_has_failed,
          tasks_are_known_by_their_number)

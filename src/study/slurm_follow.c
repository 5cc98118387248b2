#include "study/slurm.h"

#include "base/clock.h"

#include <math.h>
#include <time.h>

/* Between looks at the files of a shared folder, which may be far away, at least [s]; and times as long as a look took.
 */
#define LOOK_SECONDS 1.0
#define LOOK_SPARING 20

/* Longer where looking at the files takes long [s]. */
static void pause_between_looks(double look)
{
    double seconds = fmax(LOOK_SECONDS, LOOK_SPARING * look), whole = floor(seconds);
    const struct timespec pause = {(time_t)whole, (long)((seconds - whole) * 1e9)};
    nanosleep(&pause, NULL);
}

static fram_status take_all(slurm_pool *all, const slurm_follower *f, fram_error *error)
{
    int32_t task = 0;
    int exit_code = 0;
    fram_status status = FRAM_OK;
    while (status == FRAM_OK && slurm_ended(all, &task, &exit_code))
        status = f->take(f->user, task, exit_code, all->node, error);
    return status;
}

static bool is_any_left(const slurm_pool *all, const slurm_follower *f) { return all->runs.count > 0 || *f->held > 0; }

static fram_status submit_more(slurm_pool *all, const slurm_follower *f, fram_error *error)
{
    fram_status status = f->add(f->user, all, error);
    return status == FRAM_OK ? slurm_submit(all, error) : status;
}

fram_status slurm_follow(context *ctx, const slurm_options *options, const char *folder, const char *program,
                         const slurm_follower *f, fram_error *error)
{
    slurm_pool all;
    fram_status status = slurm_begin(ctx, options, folder, program, &all, error);
    if (status != FRAM_OK)
        return status;
    status = submit_more(&all, f, error);
    f->tell(f->user, NULL);
    while (status == FRAM_OK && !options->dry_run && is_any_left(&all, f) && !stop_is_asked(f->stop)) {
        double began = clock_wall();
        status = take_all(&all, f, error);
        f->tell(f->user, slurm_waits(&all));
        if (status == FRAM_OK && is_any_left(&all, f))
            pause_between_looks(clock_wall() - began);
        slurm_look(&all);
        if (status == FRAM_OK)
            status = submit_more(&all, f, error);
    }
    slurm_end(&all, status == FRAM_OK && all.runs.count == 0);
    slurm_free(&all);
    return status;
}

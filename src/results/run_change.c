/* Whether the scenario in a run's folder is still the one that the run was made of.  One module with run_data. */
#include "results/run_data.h"

#include "io/scenario_file.h"

#include <string.h>

fram_status run_find_change(context *ctx, run_data *d, fram_error *error)
{
    fram_status status = scenario_hash(ctx, &d->s, d->scenario_hash, error);
    d->is_changed =
        status == FRAM_OK && d->note.scenario_hash[0] && strcmp(d->note.scenario_hash, d->scenario_hash) != 0;
    return status;
}

void run_warn_change(context *ctx, const run_data *d) { run_warn_changes(ctx, d->folder, d->is_changed); }

void run_warn_changes(context *ctx, const char *first, int32_t count)
{
    if (count == 1)
        log_write(ctx, LOG_WARNING, "%s: " RUN_IS_CHANGED, first);
    else if (count > 1)
        log_write(ctx, LOG_WARNING, "%s and %d more: " RUN_IS_CHANGED, first, (int)count - 1);
}

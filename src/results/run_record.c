#include "results/run_record.h"

#include <errno.h>
#include <unistd.h>

static bool holds_file(const char *folder, const char *name)
{
    char path[PATH_ROOM];
    return path_join(folder, name, path, NULL) != FRAM_OK || access(path, F_OK) == 0 || errno != ENOENT;
}

bool run_lacks_record(const char *folder)
{
    return !holds_file(folder, "record.fram") && holds_file(folder, "series.csv");
}

fram_status run_record_open(context *ctx, const char *folder, char path[PATH_ROOM], record_reader *r, fram_error *error)
{
    fram_status status = path_join(folder, "record.fram", path, error);
    if (status == FRAM_OK && run_lacks_record(folder))
        status = error_set(error, FRAM_ERROR_INPUT, folder, 0, NULL,
                           RUN_WITHOUT_RECORD ": make it again with `fram run %.200s/scenario.yaml -o DIR`", folder);
    return status == FRAM_OK ? record_open(ctx, path, r, error) : status;
}

#include "io/run_files.h"

#include <stddef.h>
#include <string.h>

static const run_file run_file_rows[] = {
    /* name         source written in one go */
    {"run.json", true, true, true, RUN_FILE_GOES_FIRST},
    {"scenario.yaml", true, true, true, RUN_FILE_STAYS},
    {"series.csv", true, true, false, RUN_FILE_GOES_LAST},
    {"fractures.csv", true, true, false, RUN_FILE_GOES_LAST},
    {"record.fram", true, true, false, RUN_FILE_GOES_LAST},
    {"peaks.fram", true, true, true, RUN_FILE_GOES},
    {"failed.fram", false, true, true, RUN_FILE_GOES},
    {"plan.png", false, true, true, RUN_FILE_GOES},
    {"loads.png", false, true, true, RUN_FILE_GOES},
    {"station.png", false, true, true, RUN_FILE_GOES},
    {"station.json", false, true, true, RUN_FILE_GOES},
    /* by commands that are given the run */
    {"playback.html", false, false, false, RUN_FILE_GOES},
    {"report.html", false, false, false, RUN_FILE_GOES},
    {"run.nc", false, false, false, RUN_FILE_GOES},
    {"run.mp4", false, false, false, RUN_FILE_GOES},
    {"manage.html", false, false, false, RUN_FILE_GOES},
    {"manage.csv", false, false, false, RUN_FILE_GOES},
    {"manage-sizes.csv", false, false, false, RUN_FILE_GOES},
};
enum { RUN_FILE_ROWS = sizeof run_file_rows / sizeof *run_file_rows };

const run_file *run_file_at(int32_t row) { return row < RUN_FILE_ROWS ? &run_file_rows[row] : NULL; }

const run_file *run_file_find(const char *name)
{
    const run_file *found = NULL;
    for (int32_t i = 0; i < RUN_FILE_ROWS && !found; i++)
        found = strcmp(name, run_file_rows[i].name) == 0 ? &run_file_rows[i] : NULL;
    return found;
}

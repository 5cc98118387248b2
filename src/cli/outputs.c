/* What an output may not be written over. */
#include "cli/cli.h"

#include <string.h>
#include <sys/stat.h>

bool is_one_file(const char *a, const char *b)
{
    struct stat one, other;
    return strcmp(a, b) == 0 ||
           (stat(a, &one) == 0 && stat(b, &other) == 0 && one.st_dev == other.st_dev && one.st_ino == other.st_ino);
}

int refuse_over_run(const common_options *common, const char *run, const char *output)
{
    static const char *const names[] = {"scenario.yaml", "run.json", "series.csv", "fractures.csv", "record.fram"};
    char path[4096];
    for (size_t i = 0; output && i < sizeof names / sizeof *names; i++) {
        int length = snprintf(path, sizeof path, "%s/%s", run, names[i]);
        if (length > 0 && length < (int)sizeof path && is_one_file(path, output))
            return answer_usage(common, "--output", "names a file that the run itself is made of; give it another one");
    }
    return -1;
}

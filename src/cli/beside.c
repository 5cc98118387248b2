/* Files that belong to the command: in the build tree beside it, or where it was installed. */
#include "cli/cli.h"

#include <string.h>
#include <unistd.h>

bool find_beside(const char *const *places, size_t count, char out[BESIDE_SIZE])
{
    char self[BESIDE_SIZE / 2];
    ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    if (length <= 0)
        return false;
    self[length] = '\0';
    char *slash = strrchr(self, '/');
    if (!slash)
        return false;
    *slash = '\0';
    for (size_t i = 0; i < count; i++) {
        snprintf(out, BESIDE_SIZE, "%s/%s", self, places[i]);
        if (access(out, R_OK) == 0)
            return true;
    }
    return false;
}

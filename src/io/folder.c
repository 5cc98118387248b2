#include "io/folder.h"

#include <errno.h>
#include <string.h>

const char *folder_next(DIR *folder, int *failure)
{
    for (;;) {
        errno = 0;
        const struct dirent *entry = readdir(folder);
        *failure = entry ? 0 : errno;
        if (!entry)
            return NULL;
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            return entry->d_name;
    }
}

/* main() of a fuzz target outside libFuzzer: give it every file of the folders and files named, so that inputs once
   found stay tested by every compiler and sanitizer.  Knows nothing of Fram. */
#include <dirent.h>
#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static int replay_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        fprintf(stderr, "%s: %s\n", path, strerror(errno));
        return 0;
    }
    uint8_t *data = NULL;
    size_t size = 0, room = 0, got = 0;
    do {
        if (size == room) {
            room = room ? 2 * room : 65536;
            uint8_t *larger = realloc(data, room);
            if (!larger) {
                free(data);
                fclose(file);
                fprintf(stderr, "%s: no memory\n", path);
                return 0;
            }
            data = larger;
        }
        got = fread(data + size, 1, room - size, file);
        size += got;
    } while (got > 0);
    int good = !ferror(file);
    fclose(file);
    if (good) {
        /* A copy of exactly this size, so that AddressSanitizer sees a read one past the end. */
        uint8_t *exact = malloc(size ? size : 1);
        good = exact != NULL;
        if (exact) {
            memcpy(exact, data, size);
            LLVMFuzzerTestOneInput(exact, size);
            free(exact);
        }
    }
    free(data);
    return good;
}

int main(int argc, char **argv)
{
    int files = 0;
    for (int i = 1; i < argc; i++) {
        DIR *folder = opendir(argv[i]);
        if (!folder) {
            if (!replay_file(argv[i]))
                return 1;
            files++;
            continue;
        }
        for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
            char path[4096];
            if (entry->d_name[0] == '.')
                continue;
            if (snprintf(path, sizeof path, "%s/%s", argv[i], entry->d_name) >= (int)sizeof path ||
                !replay_file(path)) {
                closedir(folder);
                return 1;
            }
            files++;
        }
        closedir(folder);
    }
    printf("%d inputs\n", files);
    if (files == 0) {
        fprintf(stderr, "no input: a fuzz target needs a committed seed\n");
        return 1;
    }
    return 0;
}

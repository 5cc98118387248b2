#include "sim/run_inputs.h"

#include "io/file.h"
#include "io/folder.h"
#include "io/path.h"
#include "io/scenario_file.h"
#include "model/scenario_schema.h"

#include <string.h>

enum { INPUT_LIMIT = 1 << 30, DIGEST_LENGTH = SHA256_TEXT_SIZE - 1, GAP_LENGTH = 2 };

typedef struct input_list {
    context *ctx;
    const scenario *s;
    text_buffer *known, *out;
} input_list;

static bool find_known(const text_buffer *known, const char *path, char digest[SHA256_TEXT_SIZE])
{
    run_input file;
    const char *at = known && known->count > 0 ? known->data : "", *end = at + (known ? known->count : 0);
    while (run_inputs_next(&at, end, &file)) {
        if ((size_t)file.path_length != strlen(path) || memcmp(file.path, path, strlen(path)) != 0)
            continue;
        memcpy(digest, file.digest, SHA256_TEXT_SIZE);
        return true;
    }
    return false;
}

static fram_status add_input(void *user, const scenario_key *key, const void *member, const char *name,
                             fram_error *error)
{
    input_list *list = user;
    const char *given = member;
    if (key->kind != KEY_PATH || !*given)
        return FRAM_OK;
    char path[SCENARIO_TEXT_SIZE], digest[SHA256_TEXT_SIZE];
    char *data = NULL;
    size_t size = 0;
    /* Absolute, as in the run folder's scenario: the run is resumed from any folder. */
    fram_status status = scenario_absolute_path(list->s, name, given, path, error);
    if (status == FRAM_OK && !find_known(list->known, path, digest)) {
        status = file_read(list->ctx, path, INPUT_LIMIT, &data, &size, error);
        if (status != FRAM_OK)
            return status;
        sha256_text(data, size, digest);
        memory_free(list->ctx, data);
        if (list->known)
            text_format(list->ctx, list->known, "%s  %s\n", digest, path);
    }
    if (status == FRAM_OK)
        text_format(list->ctx, list->out, "%s  %s\n", digest, path);
    return status;
}

fram_status run_inputs_list(context *ctx, const scenario *s, text_buffer *known, text_buffer *out, fram_error *error)
{
    input_list list = {ctx, s, known, out};
    text_add(ctx, out, "");
    fram_status status = scenario_walk(s, add_input, &list, error);
    bool failed = out->failed || !out->data || (known && known->failed);
    return status == FRAM_OK && failed ? error_memory(error) : status;
}

static bool begins_with_digest(const char *text, size_t size)
{
    if (size < DIGEST_LENGTH)
        return false;
    for (int i = 0; i < DIGEST_LENGTH; i++) {
        if (!(text[i] >= '0' && text[i] <= '9') && !(text[i] >= 'a' && text[i] <= 'f'))
            return false;
    }
    return true;
}

bool run_inputs_next(const char **at, const char *end, run_input *out)
{
    const char *line = *at;
    size_t size = (size_t)(end - line);
    if (!begins_with_digest(line, size) || size <= DIGEST_LENGTH + GAP_LENGTH ||
        memcmp(line + DIGEST_LENGTH, "  ", GAP_LENGTH) != 0)
        return false;
    const char *path = line + DIGEST_LENGTH + GAP_LENGTH, *stop = memchr(path, '\n', (size_t)(end - path));
    if (!stop || stop == path || stop - path > SCENARIO_TEXT_SIZE)
        return false;
    memcpy(out->digest, line, DIGEST_LENGTH);
    out->digest[DIGEST_LENGTH] = '\0';
    out->path = path;
    out->path_length = (int)(stop - path);
    *at = stop + 1;
    return true;
}

bool run_inputs_has(const char *inputs, const char *path)
{
    run_input file;
    bool found = false;
    for (const char *end = inputs + strlen(inputs); !found && run_inputs_next(&inputs, end, &file);) {
        char input[PATH_ROOM];
        snprintf(input, sizeof input, "%.*s", file.path_length, file.path);
        found = path_is_same(input, path);
    }
    return found;
}

fram_status run_inputs_refuse(const char *inputs, const char *folder, bool (*is_written)(const char *name),
                              fram_error *error)
{
    char path[PATH_ROOM];
    DIR *dir = opendir(folder);
    bool found = false;
    int failure;
    for (const char *name; dir && !found && (name = folder_next(dir, &failure)) != NULL;)
        found = is_written(name) && path_join(folder, name, path, NULL) == FRAM_OK && run_inputs_has(inputs, path);
    if (dir)
        closedir(dir);
    if (!found)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_USAGE, path, 0, "output",
                     "expected a file of its own, found one that the scenario names; write into another folder");
}

fram_status run_inputs_digest(context *ctx, const char *text, size_t size, char out[SHA256_TEXT_SIZE],
                              fram_error *error)
{
    if (size == DIGEST_LENGTH && begins_with_digest(text, size)) {
        memcpy(out, text, DIGEST_LENGTH);
        out[DIGEST_LENGTH] = '\0';
        return FRAM_OK;
    }
    text_buffer digests = {0};
    text_add(ctx, &digests, "");
    const char *at = size > 0 ? text : "", *end = at + size;
    run_input file;
    while (run_inputs_next(&at, end, &file))
        text_add_bytes(ctx, &digests, file.digest, DIGEST_LENGTH);
    fram_status status = FRAM_OK;
    if (at < end)
        status =
            error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL,
                      "expected a list of files, lines of SHA-256 and path; found something else at byte %zu of it",
                      (size_t)(at - text));
    else if (digests.failed)
        status = error_memory(error);
    else
        sha256_text(digests.data, (size_t)digests.count, out);
    text_free(ctx, &digests);
    return status;
}

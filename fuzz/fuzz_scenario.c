/* scenario_parse, scenario_print and scenario_hash on any bytes.  The input is the text of a file, then, each after a
   NUL, overrides "key=value".
   Promises: a refusal says which file and why; what is accepted, printed and read again is the same scenario. */
#include "fuzzing.h"
#include "io/scenario_file.h"
#include <string.h>

enum { MOST_OVERRIDES = 8 };

/* What is accepted must come back from its own printed form. */
static void print_and_read_again(context *ctx, const scenario *first)
{
    text_buffer text = {0}, again = {0};
    scenario second;
    fram_error error = {0};
    char hash[SHA256_TEXT_SIZE], hash_again[SHA256_TEXT_SIZE];
    PROMISE(scenario_print(ctx, first, NULL, &text, &error) == FRAM_OK);
    PROMISE(text.data);
    PROMISE(scenario_hash(ctx, first, hash, &error) == FRAM_OK);
    fram_status status = scenario_parse(ctx, "printed.yaml", text.data, (size_t)text.count, NULL, &second, &error);
    if (status)
        fprintf(stderr, "%s:%d: %s: %s\n%s\n", error.file, error.line, error.key, error.message, text.data);
    PROMISE(status == FRAM_OK);
    PROMISE(scenario_hash(ctx, &second, hash_again, &error) == FRAM_OK);
    PROMISE(strcmp(hash, hash_again) == 0);
    PROMISE(scenario_print(ctx, &second, NULL, &again, &error) == FRAM_OK);
    PROMISE(again.data);
    PROMISE(text.count == again.count && memcmp(text.data, again.data, (size_t)text.count) == 0);
    scenario_free(ctx, &second);
    text_free(ctx, &text);
    text_free(ctx, &again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    context ctx;
    context_init(&ctx);
    const char *items[MOST_OVERRIDES];
    scenario_overrides overrides = {.items = items, .count = 0};
    char *copy = malloc(size + 1);
    if (!copy)
        return 0;
    if (size > 0)
        memcpy(copy, data, size);
    copy[size] = '\0';
    size_t text_size = strlen(copy);
    for (size_t at = text_size + 1; at < size && overrides.count < MOST_OVERRIDES; at += strlen(copy + at) + 1)
        items[overrides.count++] = copy + at;

    scenario parsed;
    fram_error error = {0};
    fram_status status = scenario_parse(&ctx, "fuzz.yaml", copy, text_size, &overrides, &parsed, &error);
    if (status == FRAM_OK) {
        print_and_read_again(&ctx, &parsed);
        scenario_free(&ctx, &parsed);
    } else {
        PROMISE(status == FRAM_ERROR_INPUT || status == FRAM_ERROR_USAGE);
        PROMISE(error.status == status);
        PROMISE(strcmp(error.file, "fuzz.yaml") == 0 || strcmp(error.file, SCENARIO_OVERRIDE) == 0);
        PROMISE(error.message[0] != '\0');
    }
    free(copy);
    return 0;
}

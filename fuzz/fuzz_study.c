/* study_parse on any bytes.
   Promises: a refusal says where and why and leaves nothing behind; what is accepted has at least one condition with a
   value for every key, and a rule for seeds that can be met. */
#include "fuzzing.h"
#include "study/study_file.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    context ctx;
    context_init(&ctx);
    char *copy = malloc(size + 1);
    if (!copy)
        return 0;
    if (size > 0)
        memcpy(copy, data, size);
    copy[size] = '\0';
    study s = {0};
    fram_error error = {0};
    fram_status status = study_parse(&ctx, "fuzz.yaml", copy, size, &s, &error);
    if (status == FRAM_OK) {
        PROMISE(s.scenario && s.conditions >= 1 && s.conditions <= STUDY_CONDITIONS_MOST);
        PROMISE((int64_t)s.values.count == (int64_t)s.conditions * s.keys.count);
        PROMISE(s.seeds.least >= 1 && s.seeds.most >= s.seeds.least && s.seeds.most <= STUDY_SEEDS_MOST);
        study_free(&ctx, &s);
    } else {
        PROMISE(status == FRAM_ERROR_INPUT && error.status == status);
        PROMISE(error.file[0] != '\0' && error.message[0] != '\0');
        PROMISE(!s.file && !s.scenario && !s.keys.data && !s.values.data && !s.set.data);
    }
    free(copy);
    return 0;
}

/* How the study of a folder stands, by its index and the rows of its runs. */
#include "io/file.h"
#include "study/seeds.h"
#include "study/study_file.h"
#include "study/study_record.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

/* An index of the most conditions with a few files each. */
enum { INDEX_LIMIT = 1 << 27 };

typedef ARRAY(double) number_list;

typedef struct study_look {
    study_folder folder;
    study s;
    double *block; /* how long the runs of each condition are after the transient [s]; NULL: not asked */
    number_list mean, largest;
    text_buffer keys;
} study_look;

static fram_status read_part(context *ctx, const char *folder, const char *name, uint64_t limit, text_buffer *path,
                             char **data, size_t *size, fram_error *error)
{
    path->count = 0;
    text_format(ctx, path, "%s/%s", folder, name);
    if (path->failed)
        return error_memory(error);
    /* One that is there and may not be read is told as that. */
    if (access(path->data, F_OK) != 0 && (errno == ENOENT || errno == ENOTDIR))
        return error_set(error, FRAM_ERROR_INPUT, folder, 0, NULL,
                         "the folder holds no study: expected one made by `fram study STUDY -o DIR` (%s is not there)",
                         name);
    return file_read(ctx, path->data, limit, data, size, error);
}

/* The second cell of each line behind the heads. */
static bool take_ids(study_folder *f, const char *text)
{
    for (int32_t c = 0; c < f->s->conditions; c++) {
        const char *line = strchr(text, '\n'), *cell = line ? strchr(line, ',') : NULL;
        if (!cell || strcspn(cell + 1, ",\n") != CONDITION_ID - 1)
            return false;
        memcpy(f->id[c], cell + 1, CONDITION_ID - 1);
        f->id[c][CONDITION_ID - 1] = '\0';
        text = line + 1;
    }
    return true;
}

static fram_status open_look(context *ctx, const char *folder, study_look *l, fram_error *error)
{
    text_buffer path = {0};
    char *data = NULL;
    size_t size = 0;
    fram_status status = read_part(ctx, folder, "effective.yaml", STUDY_FILE_LIMIT, &path, &data, &size, error);
    if (status == FRAM_OK)
        status = study_parse(ctx, path.data, data, size, &l->s, error);
    memory_free(ctx, data);
    data = NULL;
    if (status == FRAM_OK)
        status = read_part(ctx, folder, "index.csv", INDEX_LIMIT, &path, &data, &size, error);
    l->folder = (study_folder){.ctx = ctx, .s = &l->s, .path = folder, .lock = -1};
    if (status == FRAM_OK) {
        l->folder.id = memory_array(ctx, (size_t)l->s.conditions, CONDITION_ID);
        if (!l->folder.id)
            status = error_memory(error);
        else if (!data || !take_ids(&l->folder, data))
            status = error_set(error, FRAM_ERROR_INPUT, path.data, 0, NULL, "expected a line for each of %d conditions",
                               (int)l->s.conditions);
    }
    memory_free(ctx, data);
    text_free(ctx, &path);
    return status;
}

/* The rows of a condition that are there; a failure counts as in the tables, with NaN.  How many seeds are wanted is
   decided by those up to the first that is not there, as by the study. */
static fram_status read_rows(study_look *l, int32_t condition, condition_standing *out, fram_error *error)
{
    context *ctx = l->folder.ctx;
    array_clear(&l->mean);
    array_clear(&l->largest);
    out->wanted = l->s.seeds.least;
    for (int32_t i = 0; i < out->wanted; i++) {
        run_rows rows = {0};
        row_file found = ROWS_NONE;
        char *path = study_run_path(&l->folder, condition, l->s.seeds.first + i, ".row");
        fram_status status = path ? run_rows_read(ctx, path, &rows, &found, error) : error_memory(error);
        memory_free(ctx, path);
        const run_row *row = found == ROWS_WHOLE ? run_rows_find(&rows, l->s.vessel) : NULL;
        bool good = !row || (array_push(ctx, &l->mean, row->figure[ROW_load_mean]) &&
                             array_push(ctx, &l->largest, row->figure[ROW_load_largest]));
        out->failed += row && row->failed;
        array_free(ctx, &rows);
        if (status != FRAM_OK || !good)
            return status != FRAM_OK ? status : error_memory(error);
        out->runs += row != NULL;
        if (out->runs < i + 1)
            continue;
        const seeds_extreme rare = seeds_extreme_of(ctx, &l->s, l->block ? l->block[condition] : 1);
        out->wanted = seeds_wanted(&l->s.seeds, l->mean.data, l->largest.data, &rare, l->mean.count);
    }
    return FRAM_OK;
}

static fram_status tell_condition(study_look *l, int32_t c, standing_function tell, void *user, fram_error *error)
{
    condition_standing out = {.condition = c + 1, .id = l->folder.id[c], .load_largest = (double)NAN};
    fram_status status = read_rows(l, c, &out, error);
    seed_interval mean = seed_interval_of(l->mean.data, l->mean.count, l->s.seeds.confidence);
    out.load_mean = mean.mean;
    out.load_mean_half = mean.half;
    for (int32_t i = 0; i < l->largest.count; i++)
        out.load_largest = fmax(out.load_largest, l->largest.data[i]);
    l->keys.count = 0;
    text_add(l->folder.ctx, &l->keys, "");
    for (int32_t k = 0; k < l->s.keys.count; k++)
        text_format(l->folder.ctx, &l->keys, "%s%s=%s", k > 0 ? " " : "", l->s.keys.data[k], study_value(&l->s, c, k));
    if (status == FRAM_OK && l->keys.failed)
        status = error_memory(error);
    out.keys = l->keys.data;
    if (status == FRAM_OK)
        tell(user, &out);
    return status;
}

fram_status study_list(context *ctx, const char *folder, standing_function tell, void *user, fram_error *error)
{
    study_look l = {0};
    fram_status status = open_look(ctx, folder, &l, error);
    if (status == FRAM_OK && l.s.seeds.extreme_within > 0)
        status = study_blocks(&l.folder, &l.block, error);
    for (int32_t c = 0; c < l.s.conditions && status == FRAM_OK; c++)
        status = tell_condition(&l, c, tell, user, error);
    memory_free(ctx, l.folder.id);
    memory_free(ctx, l.block);
    array_free(ctx, &l.mean);
    array_free(ctx, &l.largest);
    text_free(ctx, &l.keys);
    study_free(ctx, &l.s);
    return status;
}

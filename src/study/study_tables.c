/* The tables of a study.  No wall-clock times and no order of ends: the same study leaves the same bytes. */
#include "io/atomic_file.h"
#include "io/path.h"
#include "model/mechanism.h"
#include "study/cells.h"
#include "study/seeds.h"
#include "study/study_answers.h"

#include <unistd.h>

static void add_condition_cells(const study_folder *f, int32_t condition, text_buffer *b)
{
    text_format(f->ctx, b, "%d", (int)condition + 1);
    for (int32_t k = 0; k < f->s->keys.count; k++)
        cell_text(f->ctx, b, study_value(f->s, condition, k));
}

static void add_condition_heads(const study_folder *f, text_buffer *b)
{
    text_add(f->ctx, b, "condition");
    for (int32_t k = 0; k < f->s->keys.count; k++)
        text_format(f->ctx, b, ",%s", f->s->keys.data[k]);
}

static void summarise(const study_folder *f, const condition_rows *conditions, text_buffer *b)
{
    add_condition_heads(f, b);
    text_add(f->ctx, b, ",seed");
    run_row_heads(f->ctx, b);
    for (int32_t c = 0; c < f->s->conditions; c++) {
        for (int32_t i = 0; i < conditions[c].rows.count; i++) {
            add_condition_cells(f, c, b);
            int64_t seed = f->s->seeds.first + i;
            text_format(f->ctx, b, ",%lld", (long long)seed);
            run_row_line(f->ctx, &conditions[c].rows.data[i], b);
        }
    }
}

static fram_status summarise_conditions(const study_folder *f, const condition_rows *conditions, text_buffer *b,
                                        fram_error *error)
{
    static const run_figure of[] = {ROW_load_mean,
                                    ROW_load_significant,
                                    ROW_load_largest,
                                    ROW_offset_largest,
                                    ROW_line_tension_largest,
                                    ROW_load_range_equivalent,
                                    ROW_line_tension_range_equivalent,
#define SHARE_COLUMN(id, name, text) ROW_share_splitting + MECHANISM_##id,
                                    ICE_MECHANISMS(SHARE_COLUMN)
#undef SHARE_COLUMN
    };
    add_condition_heads(f, b);
    text_add(f->ctx, b, ",seeds,failed");
    text_add(f->ctx, b, ",load_mean[N],load_mean_half[N],load_significant[N],load_significant_half[N]");
    text_add(f->ctx, b, ",load_largest[N],load_largest_half[N],offset_largest[m],offset_largest_half[m]");
    text_add(f->ctx, b, ",line_tension_largest[N],line_tension_largest_half[N]");
    text_add(f->ctx, b, ",load_range_equivalent[N],load_range_equivalent_half[N]");
    text_add(f->ctx, b, ",line_tension_range_equivalent[N],line_tension_range_equivalent_half[N]");
#define SHARE_HEAD(id, name, text) text_add(f->ctx, b, ",share_" name "[1],share_" name "_half[1]");
    ICE_MECHANISMS(SHARE_HEAD)
#undef SHARE_HEAD
    text_add(f->ctx, b, "\n");
    ARRAY(double) value = {0};
    for (int32_t c = 0; c < f->s->conditions; c++) {
        int32_t failed = 0, n = conditions[c].rows.count;
        if (!array_resize(f->ctx, &value, n)) {
            array_free(f->ctx, &value);
            return error_memory(error);
        }
        for (int32_t i = 0; i < n; i++)
            failed += conditions[c].rows.data[i].failed;
        add_condition_cells(f, c, b);
        text_format(f->ctx, b, ",%d,%d", (int)n, (int)failed);
        for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
            for (int32_t i = 0; i < n; i++)
                value.data[i] = conditions[c].rows.data[i].figure[of[k]];
            seed_interval interval = seed_interval_of(value.data, n, f->s->seeds.confidence);
            cell_number(f->ctx, b, interval.mean);
            cell_number(f->ctx, b, interval.half);
        }
        text_add(f->ctx, b, "\n");
    }
    array_free(f->ctx, &value);
    return FRAM_OK;
}

fram_status study_table_write(const study_folder *f, const char *name, const text_buffer *b, fram_error *error)
{
    text_buffer path = {0};
    text_format(f->ctx, &path, "%s/%s", f->path, name);
    fram_status status = path.failed ? error_memory(error) : path_claim(path.data, error);
    if (status == FRAM_OK)
        status = text_file_write(f->ctx, path.data, b, error);
    text_free(f->ctx, &path);
    return status;
}

void study_table_remove(const study_folder *f, const char *name)
{
    text_buffer path = {0};
    text_format(f->ctx, &path, "%s/%s", f->path, name);
    if (!path.failed)
        (void)unlink(path.data);
    text_free(f->ctx, &path);
}

static fram_status find_tables(const study_folder *f, bool *there, fram_error *error)
{
    text_buffer path = {0};
    text_format(f->ctx, &path, "%s/summary.csv", f->path);
    *there = !path.failed && access(path.data, F_OK) == 0;
    fram_status status = path.failed ? error_memory(error) : FRAM_OK;
    text_free(f->ctx, &path);
    return status;
}

fram_status study_tables_write(const study_folder *f, const condition_rows *conditions, bool replace, fram_error *error)
{
    text_buffer runs = {0}, means = {0};
    bool there = false;
    fram_status found = replace ? FRAM_OK : find_tables(f, &there, error);
    if (found != FRAM_OK || there)
        return found;
    summarise(f, conditions, &runs);
    fram_status status = summarise_conditions(f, conditions, &means, error);
    if (status == FRAM_OK)
        status = study_table_write(f, "summary.csv", &runs, error);
    if (status == FRAM_OK)
        status = study_table_write(f, "conditions.csv", &means, error);
    if (status == FRAM_OK)
        status = study_differences_write(f, conditions, error);
    if (status == FRAM_OK)
        status = study_station_write(f, conditions, error);
    if (status == FRAM_OK)
        status = study_answers_write(f, conditions, error);
    if (status == FRAM_OK)
        status = study_netcdf_write(f, conditions, error);
    if (status == FRAM_OK)
        status = study_page_write(f, conditions, error);
    text_free(f->ctx, &runs);
    text_free(f->ctx, &means);
    return status;
}

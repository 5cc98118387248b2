/* study.nc: all figures of all runs over the dimensions condition and seed, NaN where there is no run. */
#include "fram/version.h"
#include "io/netcdf_file.h"
#include "study/key_names.h"
#include "study/study_answers.h"
#include "study/study_series.h"

#include <math.h>
#include <string.h>

/* Values of a key, 1 and 0 for true and false; false where it has other words. */
static bool key_values(const study_folder *f, int32_t key, double *out)
{
    for (int32_t c = 0; c < f->s->conditions; c++) {
        const char *text = study_value(f->s, c, key);
        bool yes = strcmp(text, "true") == 0;
        if (yes || strcmp(text, "false") == 0)
            out[c] = yes ? 1 : 0;
        else if (!study_series_number(text, &out[c]))
            return false;
    }
    return true;
}

static void put_keys(const study_folder *f, netcdf_file *nc, int over, double *value, const char **word)
{
    for (int32_t k = 0; k < f->s->keys.count; k++) {
        char name[128];
        size_t n = 0;
        for (const char *c = f->s->keys.data[k]; *c && n + 1 < sizeof name; c++)
            name[n++] = *c;
        name[n] = '\0';
        bool number = key_values(f, k, value);
        int variable = netcdf_variable(nc, name, number ? NETCDF_F64 : NETCDF_TEXT, &over, 1,
                                       key_unit(f->s->keys.data[k]), "scenario key of the conditions");
        for (int32_t c = 0; c < f->s->conditions; c++)
            word[c] = study_value(f->s, c, k);
        if (number)
            netcdf_put_f64(nc, variable, value);
        else
            netcdf_put_text(nc, variable, word);
    }
}

/* A figure of every run, condition after condition. */
static void put_figure(const study_folder *f, netcdf_file *nc, const int over[2], const condition_rows *conditions,
                       int32_t seeds, run_figure figure, double *value)
{
    for (int32_t c = 0; c < f->s->conditions; c++)
        for (int32_t i = 0; i < seeds; i++)
            value[(int64_t)c * seeds + i] =
                i < conditions[c].rows.count ? conditions[c].rows.data[i].figure[figure] : (double)NAN;
    int variable = netcdf_variable(nc, run_figure_name(figure), NETCDF_F64, over, 2, run_figure_unit(figure), "");
    netcdf_put_f64(nc, variable, value);
}

/* 0: none, 1: finished, 2: failed. */
static void put_status(const study_folder *f, netcdf_file *nc, const int over[2], const condition_rows *conditions,
                       int32_t seeds, int32_t *state)
{
    for (int32_t c = 0; c < f->s->conditions; c++)
        for (int32_t i = 0; i < seeds; i++)
            state[(int64_t)c * seeds + i] = i >= conditions[c].rows.count ? 0 : 1 + conditions[c].rows.data[i].failed;
    netcdf_put_i32(nc, netcdf_variable(nc, "status", NETCDF_I32, over, 2, "1", "0: no run, 1: finished, 2: failed"),
                   state);
}

static void put_all(const study_folder *f, netcdf_file *nc, const condition_rows *conditions, int32_t seeds,
                    double *value, int32_t *state, const char **word)
{
    const int over[2] = {netcdf_dimension(nc, "condition", (size_t)f->s->conditions),
                         netcdf_dimension(nc, "seed", (size_t)seeds)};
    netcdf_attribute(nc, "title", "study of Fram");
    netcdf_attribute(nc, "fram_version", FRAM_VERSION);
    if (f->s->vessel)
        netcdf_attribute(nc, "vessel", f->s->vessel);
    for (int32_t c = 0; c < f->s->conditions; c++)
        state[c] = c + 1;
    netcdf_put_i32(nc, netcdf_variable(nc, "condition", NETCDF_I32, &over[0], 1, "1", "number, as in summary.csv"),
                   state);
    for (int32_t i = 0; i < seeds; i++)
        value[i] = (double)(f->s->seeds.first + i);
    netcdf_put_f64(nc, netcdf_variable(nc, "seed", NETCDF_F64, &over[1], 1, "1", "run.seed"), value);
    put_keys(f, nc, over[0], value, word);
    put_status(f, nc, over, conditions, seeds, state);
    for (int figure = 0; figure < ROW_FIGURES; figure++)
        put_figure(f, nc, over, conditions, seeds, (run_figure)figure, value);
}

fram_status study_netcdf_write(const study_folder *f, const condition_rows *conditions, fram_error *error)
{
    int32_t seeds = 0;
    for (int32_t c = 0; c < f->s->conditions; c++)
        seeds = conditions[c].rows.count > seeds ? conditions[c].rows.count : seeds;
    if (seeds == 0) {
        study_table_remove(f, "study.nc");
        return FRAM_OK;
    }
    size_t room = (size_t)f->s->conditions * (size_t)seeds;
    text_buffer path = {0};
    netcdf_file nc;
    text_format(f->ctx, &path, "%s/study.nc", f->path);
    double *value = memory_array(f->ctx, room, sizeof *value);
    int32_t *state = memory_array(f->ctx, room, sizeof *state);
    const char **word = memory_array(f->ctx, (size_t)f->s->conditions, sizeof *word);
    fram_status status = path.failed || !value || !state || !word ? error_memory(error) : FRAM_OK;
    if (status == FRAM_OK)
        status = netcdf_begin_in_memory(f->ctx, path.data, &nc, error);
    if (status == FRAM_OK) {
        put_all(f, &nc, conditions, seeds, value, state, word);
        status = netcdf_end(&nc, error);
    } else if (status == FRAM_ERROR_UNSUPPORTED) {
        status = FRAM_OK; /* the tables have it all */
    }
    memory_free(f->ctx, value);
    memory_free(f->ctx, state);
    memory_free(f->ctx, word);
    text_free(f->ctx, &path);
    return status;
}

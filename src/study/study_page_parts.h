/* Parts of the page of a study that share it.  One module with study_page. */
#ifndef STUDY_STUDY_PAGE_PARTS_H
#define STUDY_STUDY_PAGE_PARTS_H

#include "io/html_page.h"
#include "study/seeds.h"
#include "study/study_answers.h"
#include "study/study_series.h"

/* A figure in the unit of the page: those of page_figures are of full size. */
typedef struct page_figure {
    run_figure figure;
    const char *name, *unit;
    double factor;
} page_figure;
enum { PAGE_FIGURES = 7, CONDITIONS_OF_TABLE = 500 };
extern const page_figure page_figures[PAGE_FIGURES];

typedef struct study_page {
    const study_folder *f;
    const condition_rows *conditions;
    html_page page;
    page_figure figures[PAGE_FIGURES]; /* page_figures in the units that fit this study */
    int32_array key_digits;            /* of the keys that were asked for */
} study_page;

/* The units of its figures: kN and kW, or N and W where all are under 10 kN or kW, as of a model.  Loads have one, so
   that their columns can be compared, and tensions have one. */
void page_choose_units(study_page *p);
/* The figure as the page has it, or as in summary.csv. */
page_figure page_figure_of(const study_page *p, run_figure figure);
/* Mean over the seeds of a condition and half its interval, in the unit of the page; without memory none, and the
   page's text has failed. */
seed_interval page_interval(study_page *p, int32_t condition, const page_figure *figure);
void page_count_runs(const study_page *p, int64_t *runs, int64_t *failed);

/* Runs of a condition that failed; and "Failed runs", with their reasons, where there are some. */
int32_t page_failed_of(const study_page *p, int32_t condition);
void page_add_failed(study_page *p);

/* Tables of many columns keep numbers in one piece, and are moved sideways where the window is narrow: begin with the
   number of a condition and the keys as heads, then these; each row begins with them too. */
void page_table_begin(study_page *p, const char *const *heads, int32_t count);
void page_row_begin(study_page *p, int32_t condition);
void page_table_end(study_page *p);

/* A cell whose text wraps where those of numbers do not. */
void page_text_cell(study_page *p, const char *text);
/* The name of a key with a space of no width behind each dot and low line, where it may be broken. */
enum { PAGE_NAME_SIZE = 128 };
void page_breakable(const char *name, char out[PAGE_NAME_SIZE]);

/* "1.23 ± 0.45": the uncertainty, to two digits, decides how many the mean has; alone it has three. */
enum { PAGE_INTERVAL_SIZE = 80 };
void page_interval_text(seed_interval i, char out[PAGE_INTERVAL_SIZE]);

/* Rounded to three significant digits. */
double page_three_digits(double value);
/* The value of a key: as it was written, or in fewer digits, at least four, that still tell it from the key's other
   values. */
enum { PAGE_KEY_SIZE = 48 };
void page_key_text(study_page *p, int32_t condition, int32_t key, char out[PAGE_KEY_SIZE]);

/* Maps of a grid over two keys: rows by the first, columns by the second, conditions row by row. */
enum { HEAT_SIDE = 12, PAGE_HEAT_MOST = HEAT_SIDE * HEAT_SIDE };
typedef struct page_heat {
    int32_t rows, columns;
} page_heat;
typedef struct page_heat_scale {
    const char *colour;
    double full; /* the value that has all of it */
} page_heat_scale;
/* false: the conditions are no such grid, or too large a one. */
bool page_heat_find(const study *s, page_heat *out);
/* One map, of a value a condition; a NaN is a dash. */
void page_add_heat(study_page *p, const page_heat *of, const char *name, page_heat_scale scale, const double *value);
/* "Heat maps" of the figures. */
void page_add_heats(study_page *p, const bool *has);

/* What tells a group of a series from the others: "ice.thickness 0.6 m", brief "thickness 0.6 m"; "" where there is one
   group. */
enum { PAGE_GROUP_SIZE = 96 };
void page_group_name(study_page *p, const study_series *of, int32_t group, bool brief, char out[PAGE_GROUP_SIZE]);

/* "Seeds and means": a dot a run, means with their intervals; lines along a key where the conditions are series over
   it (study/study_series.h). */
fram_status page_add_charts(study_page *p, const bool *has, fram_error *error);
/* "Differences" of conditions that are compared, where they have two runs each. */
fram_status page_add_differences(study_page *p, const bool *has, fram_error *error);
/* "Station": in how many runs each condition kept what was required, where vessels are on a station. */
fram_status page_add_station(study_page *p, fram_error *error);
/* "Sensitivity": which key moves which figure, where the conditions are a design for it. */
fram_status page_add_sensitivity(study_page *p, fram_error *error);
/* Rare loads, where the study asks for them: a table of levels, and probability plots. */
fram_status page_add_extremes(study_page *p, fram_error *error);

#endif

/* study.html: what a study says, for people: conditions with intervals, charts, seeds, the worst runs. */
#include "base/number_text.h"
#include "base/sort.h"
#include "io/atomic_file.h"
#include "io/path.h"
#include "model/mechanism.h"
#include "study/key_names.h"
#include "study/study_page_parts.h"
#include "study/study_worst.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WORST = 10 };
/* An interval wider than this part of the mean calls for more seeds, where the study does not say what does. */
#define WIDE_INTERVAL 0.1

/* ---- numbers ---- */

seed_interval page_interval(study_page *p, int32_t condition, const page_figure *figure)
{
    const condition_rows *of = &p->conditions[condition];
    seed_interval out = {(double)NAN, (double)NAN};
    double *value = memory_array(p->f->ctx, (size_t)of->rows.count + 1, sizeof *value);
    for (int32_t i = 0; value && i < of->rows.count; i++)
        value[i] = of->rows.data[i].figure[figure->figure] * figure->factor;
    if (value)
        out = seed_interval_of(value, of->rows.count, p->f->s->seeds.confidence);
    else
        p->page.text.failed = true;
    memory_free(p->f->ctx, value);
    return out;
}

/* Decimals that leave so many significant digits, at most six; negative: of a number that is larger. */
static int decimals_of(double value, int digits)
{
    double size = fabs(value);
    int before = 0;
    if (!(size > 0) || !isfinite(size))
        return 0;
    while (size >= 10) {
        size /= 10;
        before++;
    }
    while (size < 1 && before > -6) {
        size *= 10;
        before--;
    }
    return digits - 1 - before;
}

static double power_of_ten(int n)
{
    double out = 1;
    for (; n > 0; n--)
        out *= 10;
    return out;
}

static double rounded_at(double value, int decimals)
{
    double unit = power_of_ten(decimals < 0 ? -decimals : decimals);
    return decimals < 0 ? floor(value / unit + 0.5) * unit : floor(value * unit + 0.5) / unit;
}

double page_three_digits(double value) { return isfinite(value) ? rounded_at(value, decimals_of(value, 3)) : value; }

/* To `decimals`, which may be negative. */
static void number_at(double value, int decimals, char out[HTML_NUMBER_SIZE])
{
    snprintf(out, HTML_NUMBER_SIZE, "%.*f", decimals > 0 ? decimals : 0, rounded_at(value, decimals));
}

/* Digits that tell the numbers of a key apart, whichever of them are shortened.  Rounding keeps an order, so that
   neighbours in it are enough to look at. */
static int digits_for_key(study_page *p, int32_t key)
{
    enum { LEAST = 4, MOST = 17 };
    const study *s = p->f->s;
    double *value = memory_array(p->f->ctx, (size_t)s->conditions + 1, sizeof *value);
    int32_t count = 0;
    int digits = LEAST;
    for (int32_t c = 0; value && c < s->conditions; c++)
        count += study_series_number(study_value(s, c, key), &value[count]);
    if (value)
        numbers_sort(value, count);
    p->page.text.failed = !value || p->page.text.failed;
    for (int32_t i = 1; i < count; i++) {
        for (char text[2][PAGE_KEY_SIZE]; digits < MOST && value[i] > value[i - 1]; digits++) {
            snprintf(text[0], PAGE_KEY_SIZE, "%.*g", digits, value[i - 1]);
            snprintf(text[1], PAGE_KEY_SIZE, "%.*g", digits, value[i]);
            if (strcmp(text[0], text[1]) != 0)
                break;
        }
    }
    memory_free(p->f->ctx, value);
    return digits;
}

void page_key_text(study_page *p, int32_t condition, int32_t key, char out[PAGE_KEY_SIZE])
{
    const char *value = study_value(p->f->s, condition, key);
    double number;
    while (p->key_digits.count <= key && !p->page.text.failed) {
        int digits = digits_for_key(p, p->key_digits.count);
        p->page.text.failed = !array_push(p->f->ctx, &p->key_digits, digits) || p->page.text.failed;
    }
    snprintf(out, PAGE_KEY_SIZE, "%s", value);
    if (p->page.text.failed || strlen(value) <= 6 || !study_series_number(value, &number))
        return;
    char brief[PAGE_KEY_SIZE];
    snprintf(brief, sizeof brief, "%.*g", p->key_digits.data[key], number);
    if (strlen(brief) < strlen(value))
        snprintf(out, PAGE_KEY_SIZE, "%s", brief);
}

static bool has_figure(study_page *p, const page_figure *figure)
{
    for (int32_t c = 0; c < p->f->s->conditions; c++)
        if (isfinite(page_interval(p, c, figure).mean))
            return true;
    return false;
}

/* ---- tables ---- */

enum { HEADS_MOST = 128 };

void page_breakable(const char *name, char out[PAGE_NAME_SIZE])
{
    size_t n = 0;
    for (const char *c = name; *c && n + 5 < PAGE_NAME_SIZE; c++) {
        out[n++] = *c;
        if (*c == '.' || *c == '_') {
            memcpy(out + n, "\xe2\x80\x8b", 3);
            n += 3;
        }
    }
    out[n] = '\0';
}

static void wide_begin(study_page *p) { text_add(p->f->ctx, &p->page.text, "<div class=\"wide\">"); }

void page_table_begin(study_page *p, const char *const *heads, int32_t count)
{
    const char *all[HEADS_MOST] = {"no."};
    char key[HEADS_MOST / 2][PAGE_NAME_SIZE];
    int32_t n = 1;
    wide_begin(p);
    for (int32_t k = 0; k < p->f->s->keys.count && k < HEADS_MOST / 2; k++) {
        char text[KEY_TEXT_SIZE];
        key_with_unit(p->f->s->keys.data[k], text);
        page_breakable(text, key[k]);
        all[n++] = key[k];
    }
    for (int32_t i = 0; i < count && n < HEADS_MOST; i++)
        all[n++] = heads[i];
    html_table_begin(&p->page, all, n);
}

void page_row_begin(study_page *p, int32_t condition)
{
    char text[PAGE_KEY_SIZE];
    html_row_begin(&p->page);
    snprintf(text, sizeof text, "%d", (int)condition + 1);
    html_cell(&p->page, text);
    for (int32_t k = 0; k < p->f->s->keys.count && k < HEADS_MOST / 2; k++) {
        page_key_text(p, condition, k, text);
        html_cell(&p->page, text);
    }
}

void page_text_cell(study_page *p, const char *text)
{
    text_format(p->f->ctx, &p->page.text, "<td style=\"white-space:normal;min-width:%s\">",
                strlen(text) > 80 ? "16em" : "9em");
    html_escaped(&p->page, text);
    text_add(p->f->ctx, &p->page.text, "</td>");
}

static void wide_end(study_page *p)
{
    html_table_end(&p->page);
    text_add(p->f->ctx, &p->page.text, "</div>\n");
}

void page_table_end(study_page *p) { wide_end(p); }

/* ---- head and table ---- */

void page_count_runs(const study_page *p, int64_t *runs, int64_t *failed)
{
    *runs = *failed = 0;
    for (int32_t c = 0; c < p->f->s->conditions; c++) {
        *runs += p->conditions[c].rows.count;
        *failed += page_failed_of(p, c);
    }
}

static const char *last_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static void add_head(study_page *p)
{
    char text[64], window[PATH_ROOM];
    int64_t runs, failed;
    page_count_runs(p, &runs, &failed);
    const char *of = last_name(p->f->s->scenario);
    snprintf(window, sizeof window, "Study %s of %s", last_name(p->f->s->file), of);
    html_begin_named(&p->page, window, "Study", of);
    html_figures_begin(&p->page);
    snprintf(text, sizeof text, "%d", (int)p->f->s->conditions);
    html_figure(&p->page, p->f->s->conditions == 1 ? "condition" : "conditions", text, "");
    snprintf(text, sizeof text, "%lld", (long long)runs);
    html_figure(&p->page, runs == 1 ? "run" : "runs", text, "");
    snprintf(text, sizeof text, "%lld", (long long)failed);
    html_figure(&p->page, "of them failed", text, "");
    snprintf(text, sizeof text, "%g", 100 * p->f->s->seeds.confidence);
    html_figure(&p->page, "confidence of the intervals", text, "%");
    html_figures_end(&p->page);
    html_paragraph(&p->page,
                   "Loads are the horizontal ice force on %s, averaged over output.averaging_window, after the "
                   "transient. A mean over seeds stands with half the width of its interval (Student's t).",
                   p->f->s->vessel ? p->f->s->vessel : "the vessel");
}

void page_interval_text(seed_interval i, char out[PAGE_INTERVAL_SIZE])
{
    char mean[HTML_NUMBER_SIZE] = "–", half[HTML_NUMBER_SIZE];
    /* Less is rounding alone, of runs that nothing of chance reaches. */
    bool known = isfinite(i.half) && i.half > 1e-9 * fabs(i.mean);
    int decimals = known ? decimals_of(i.half, 2) : decimals_of(i.mean, 3);
    number_at(i.mean, decimals, mean);
    number_at(i.half, decimals, half);
    if (isfinite(i.half))
        snprintf(out, PAGE_INTERVAL_SIZE, "%s ± %s", mean, half);
    else
        snprintf(out, PAGE_INTERVAL_SIZE, "%s", isfinite(i.mean) ? mean : "–");
}

static void add_interval(study_page *p, seed_interval i)
{
    char text[PAGE_INTERVAL_SIZE];
    page_interval_text(i, text);
    html_cell(&p->page, text);
}

static double wide_of(const study_page *p)
{
    double within = p->f->s->seeds.mean_within;
    return within > 0 ? within : WIDE_INTERVAL;
}

/* Half the interval of the mean load is a large part of it. */
static bool wants_seeds(study_page *p, int32_t condition)
{
    seed_interval of = page_interval(p, condition, &p->figures[0]);
    return isfinite(of.mean) && of.mean != 0 && !(of.half <= wide_of(p) * fabs(of.mean));
}

static void add_row(study_page *p, int32_t condition, const bool *has)
{
    char text[64], failed[32] = "";
    page_row_begin(p, condition);
    if (page_failed_of(p, condition) > 0)
        snprintf(failed, sizeof failed, ", %d failed", (int)page_failed_of(p, condition));
    snprintf(text, sizeof text, "%d%s%s", (int)p->conditions[condition].rows.count, failed,
             wants_seeds(p, condition) ? ", more" : "");
    html_cell(&p->page, text);
    for (int i = 0; i < PAGE_FIGURES; i++)
        if (has[i])
            add_interval(p, page_interval(p, condition, &p->figures[i]));
    html_row_end(&p->page);
}

static void add_table(study_page *p, const bool *has)
{
    const char *heads[PAGE_FIGURES + 1] = {"seeds"};
    char names[PAGE_FIGURES][64];
    int32_t count = 1;
    html_section(&p->page, "Conditions");
    text_add(p->f->ctx, &p->page.text,
             "<style>.wide{overflow-x:auto}.wide td{overflow-wrap:normal;white-space:nowrap}"
             ".wide td.command{white-space:normal;min-width:9em}.wide code{overflow-wrap:anywhere}"
             ".wide code i{font-style:normal;white-space:nowrap}"
             /* Paper does not scroll: sheets lie on their long side. */
             "@media print{@page{size:A4 landscape}.wide{overflow:visible}.wide table{font-size:8pt}}"
             "</style>\n");
    for (int i = 0; i < PAGE_FIGURES; i++) {
        snprintf(names[i], sizeof names[i], "%s [%s]", p->figures[i].name, p->figures[i].unit);
        if (has[i])
            heads[count++] = names[i];
    }
    page_table_begin(p, heads, count);
    bool wide = false;
    for (int32_t c = 0; c < p->f->s->conditions && c < CONDITIONS_OF_TABLE; c++) {
        add_row(p, c, has);
        wide = wide || wants_seeds(p, c);
    }
    page_table_end(p);
    if (wide)
        html_paragraph(&p->page,
                       "Seeds with \"more\": half the interval of the mean load is wider than %g %% of the mean, or "
                       "not known, of one seed.",
                       100 * wide_of(p));
    if (p->f->s->conditions > CONDITIONS_OF_TABLE)
        html_paragraph(&p->page, "The first %d conditions; conditions.csv has all.", CONDITIONS_OF_TABLE);
}

/* ---- mechanisms ---- */

#define SHARE_FIGURE(id, name, text) {ROW_share_splitting + (int)MECHANISM_##id, name, "%", 100},
static const page_figure shares[MECHANISM_COUNT] = {ICE_MECHANISMS(SHARE_FIGURE)};
#undef SHARE_FIGURE

static void add_share_row(study_page *p, int32_t condition)
{
    char text[32];
    page_row_begin(p, condition);
    for (int m = 0; m < (int)MECHANISM_COUNT; m++) {
        seed_interval of = page_interval(p, condition, &shares[m]);
        if (isfinite(of.half))
            snprintf(text, sizeof text, "%.1f ± %.1f", rounded_at(of.mean, 1), of.half);
        else
            snprintf(text, sizeof text, "%.1f", rounded_at(of.mean, 1));
        html_cell(&p->page, isfinite(of.mean) ? text : "–");
    }
    html_row_end(&p->page);
}

/* Which mechanism makes how much of the load, of studies whose runs met ice. */
static void add_shares(study_page *p)
{
    const char *heads[MECHANISM_COUNT];
    int32_t rows = p->f->s->conditions < CONDITIONS_OF_TABLE ? p->f->s->conditions : CONDITIONS_OF_TABLE;
    if (!has_figure(p, &shares[0]))
        return;
    html_section(&p->page, "Mechanisms of the load");
    for (int m = 0; m < (int)MECHANISM_COUNT; m++)
        heads[m] = shares[m].name;
    page_table_begin(p, heads, MECHANISM_COUNT);
    for (int32_t c = 0; c < rows; c++)
        add_share_row(p, c);
    page_table_end(p);
    html_paragraph(&p->page,
                   "Parts of the mean load vector along it [%%], mean over the seeds: those of a condition add "
                   "up to 100. A part may be negative, and says nothing where loads from all sides cancel.");
}

/* ---- the worst runs ---- */

static void add_view(study_page *p, const char *folder)
{
    text_format(p->f->ctx, &p->page.text,
                "<td class=\"command\"><code>fram view %s</code> makes it from the record</td>", folder);
}

/* The link to the playback where it is there, or else the command that makes it: from a record, or run anew. */
static fram_status add_playback(study_page *p, const worst_run *run, fram_error *error)
{
    text_buffer *text = &p->page.text;
    char folder[WORST_PLACES][WORST_FOLDER], frames[NUMBER_TEXT_SIZE];
    double interval = 0;
    bool own = false;
    for (int i = 0; i < (int)WORST_PLACES; i++) {
        study_worst_folder(p->f, run, (worst_place)i, folder[i]);
        if (study_worst_has(p->f, run, (worst_place)i, "playback.html")) {
            text_format(p->f->ctx, text, "<td><a href=\"%s/playback.html\">playback</a></td>", folder[i]);
            return FRAM_OK;
        }
    }
    if (study_worst_has(p->f, run, WORST_AGAIN, "record.fram")) {
        add_view(p, folder[WORST_AGAIN]);
        return FRAM_OK;
    }
    fram_status status = study_worst_frames_of(p->f, run, &interval, &own, error);
    if (status != FRAM_OK)
        return status;
    real_to_text(interval, frames);
    if (own && study_worst_has(p->f, run, WORST_FIRST, "record.fram"))
        add_view(p, folder[WORST_FIRST]);
    else
        text_format(p->f->ctx, text,
                    "<td class=\"command\"><code>fram run conditions/%s.yaml <i>--set</i> run.seed=%lld <i>--set</i> "
                    "output.frame_interval=%s <i>-o</i> %s &amp;&amp; fram view %s</code></td>",
                    p->f->id[run->condition], (long long)p->f->s->seeds.first + run->index, frames, folder[WORST_AGAIN],
                    folder[WORST_AGAIN]);
    return FRAM_OK;
}

static fram_status add_worst(study_page *p, fram_error *error)
{
    const study *s = p->f->s;
    worst_run worst[STUDY_WORST_MOST];
    char text[32], name[80], beside[80];
    page_figure by = page_figure_of(p, (run_figure)s->worst.figure);
    bool load = by.figure == ROW_load_largest;
    page_figure other = page_figure_of(p, load ? ROW_load_mean : ROW_load_largest);
    int32_t most = s->worst.count > WORST ? s->worst.count : WORST;
    int32_t count = study_worst_find(p->f, p->conditions, by.figure, most, worst);
    snprintf(name, sizeof name, "%s [%s]", by.name, by.unit);
    snprintf(beside, sizeof beside, "%s [%s]", other.name, other.unit);
    const char *heads[] = {"condition", "seed", name, beside, "playback"};
    if (count == 0)
        return FRAM_OK;
    html_section(&p->page, "Worst runs");
    if (s->worst.count < count)
        html_paragraph(
            &p->page,
            "A command, given in the folder of this page, makes a run again with a record and its playback, "
            "playback.html in the folder that it names; \"keep: {record_of_worst: %d}\" in the study has them made at "
            "its end, with links from here.",
            WORST);
    wide_begin(p);
    html_table_begin(&p->page, heads, sizeof heads / sizeof *heads);
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < count && status == FRAM_OK; i++) {
        const run_row *row = &p->conditions[worst[i].condition].rows.data[worst[i].index];
        html_row_begin(&p->page);
        snprintf(text, sizeof text, "%d", (int)worst[i].condition + 1);
        html_cell(&p->page, text);
        snprintf(text, sizeof text, "%lld", (long long)s->seeds.first + worst[i].index);
        html_cell(&p->page, text);
        html_number(&p->page, page_three_digits(worst[i].value * by.factor));
        html_number(&p->page, page_three_digits(row->figure[other.figure] * other.factor));
        status = add_playback(p, &worst[i], error);
        html_row_end(&p->page);
    }
    wide_end(p);
    return status;
}

/* ---- all ---- */

static fram_status make_page(study_page *p, fram_error *error)
{
    bool has[PAGE_FIGURES];
    int64_t runs, failed;
    page_choose_units(p);
    for (int i = 0; i < PAGE_FIGURES; i++)
        has[i] = has_figure(p, &p->figures[i]);
    add_head(p);
    add_table(p, has);
    page_count_runs(p, &runs, &failed);
    if (runs == 0)
        html_paragraph(&p->page, "No run has ended yet: the study command, given again, makes them.");
    page_add_failed(p);
    fram_status status = page_add_differences(p, has, error);
    if (status == FRAM_OK)
        status = page_add_station(p, error);
    if (status == FRAM_OK)
        status = page_add_sensitivity(p, error);
    add_shares(p);
    if (status == FRAM_OK)
        status = page_add_charts(p, has, error);
    if (status == FRAM_OK)
        page_add_heats(p, has);
    if (status == FRAM_OK)
        status = page_add_extremes(p, error);
    if (status == FRAM_OK)
        status = add_worst(p, error);
    if (status == FRAM_OK)
        html_end(&p->page);
    return status;
}

fram_status study_page_write(const study_folder *f, const condition_rows *conditions, fram_error *error)
{
    study_page p = {.f = f, .conditions = conditions, .page = {.ctx = f->ctx}};
    text_buffer path = {0};
    text_format(f->ctx, &path, "%s/study.html", f->path);
    fram_status status = make_page(&p, error);
    if (status == FRAM_OK)
        status = path.failed ? error_memory(error) : path_claim(path.data, error);
    if (status == FRAM_OK)
        status = text_file_write(f->ctx, path.data, &p.page.text, error);
    text_free(f->ctx, &path);
    array_free(f->ctx, &p.key_digits);
    html_free(&p.page);
    return status;
}

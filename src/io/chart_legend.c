#include "io/chart_legend.h"

#include "base/transcendental.h"
#include "io/palette.h"

#include <math.h>
#include <stdio.h>

_Static_assert(CHART_COLOURS == (int)PALETTE_LINES, "a chart's colours are its palette");

void chart_colour_text(int number, char out[CHART_COLOUR_TEXT])
{
    const double *c = palette_lines[(number - 1) % CHART_COLOURS];
    snprintf(out, CHART_COLOUR_TEXT, "#%02x%02x%02x", (unsigned)(255 * c[0] + 0.5), (unsigned)(255 * c[1] + 0.5),
             (unsigned)(255 * c[2] + 0.5));
}

#ifdef FRAM_HAVE_CAIRO

/* [pixels] A name's sign with its gap, what is between two names, and from one row to the next. */
enum { SIGN = 26, BETWEEN_NAMES = 18, LEGEND_ROW = 16, NAME_SIZE = 12 };
#define LEAST_PLOT (1 / 6.0)

static int32_t number_of(const chart_line *line, int32_t place) { return line->colour > 0 ? line->colour - 1 : place; }

image_colour chart_colour_of(const chart_line *line, int32_t place)
{
    const double *c = palette_lines[number_of(line, place) % CHART_COLOURS];
    return (image_colour){c[0], c[1], c[2]};
}

/* By how often the palette was gone through before. */
void chart_set_dashes(cairo_t *page, const chart_line *line, int32_t place)
{
    static const double dashes[][2] = {{7, 4}, {2, 3}, {12, 3}};
    enum { KINDS = sizeof dashes / sizeof *dashes };
    int32_t round = number_of(line, place) / CHART_COLOURS;
    if (round > 0)
        cairo_set_dash(page, dashes[(round - 1) % KINDS], 2, 0);
}

/* The line after the last one whose name stands in the row that begins with line `first`. */
static int32_t row_end(cairo_t *page, const chart *c, int32_t first, double wide)
{
    double used = -BETWEEN_NAMES;
    int32_t names = 0;
    for (int32_t k = first; k < c->line_count; k++) {
        if (!c->lines[k].name[0])
            continue;
        used += SIGN + BETWEEN_NAMES + image_text_width(page, NAME_SIZE, false, c->lines[k].name);
        if (names++ > 0 && used > wide)
            return k;
    }
    return c->line_count;
}

static int rows_of(cairo_t *page, const chart *c, double wide)
{
    int rows = 0;
    for (int32_t first = 0; first < c->line_count; rows++)
        first = row_end(page, c, first, wide);
    return rows;
}

double chart_legend_more(cairo_t *page, const chart *c, double wide, double high)
{
    double most = floor((1 - LEAST_PLOT) * high / LEGEND_ROW);
    return LEGEND_ROW * fmax(fmin(rows_of(page, c, wide) - 1, most), 0);
}

void chart_stack_words(const chart *charts, int32_t count, char out[CHART_WORDS])
{
    size_t n = 0;
    out[0] = '\0';
    for (int32_t i = 0; i < count && n < CHART_WORDS; i++) {
        const chart *c = &charts[i];
        n += (size_t)snprintf(out + n, CHART_WORDS - n, "%s%s%s", i > 0 ? "; " : "", c->title, c->title[0] ? ": " : "");
        for (int32_t k = 0; k < c->line_count && c->line_count > 1 && n < CHART_WORDS; k++)
            n += (size_t)snprintf(out + n, CHART_WORDS - n, "%s%s", c->lines[k].name,
                                  k + 1 < c->line_count ? ", " : " ");
        const char *label = c->y_label + (c->y_label[0] == ' ');
        if (n < CHART_WORDS)
            n += (size_t)snprintf(out + n, CHART_WORDS - n, "%s", label);
    }
    if (count > 0 && n < CHART_WORDS)
        snprintf(out + n, CHART_WORDS - n, " over %s", charts[count - 1].x_label);
}

static void draw_sign(cairo_t *page, const chart_line *line, int32_t place, double x, double y)
{
    bool band = line->style == CHART_BAND;
    image_colour colour = chart_colour_of(line, place);
    cairo_set_source_rgba(page, colour.r, colour.g, colour.b, band && !line->solid ? CHART_BAND_OPACITY : 1);
    if (line->style == CHART_POINTS) {
        cairo_arc(page, x - 16, y - 4, 3.5, 0, 2 * PI);
        cairo_fill(page);
        return;
    }
    if (line->style == CHART_LINE)
        chart_set_dashes(page, line, place);
    cairo_set_line_width(page, band ? 10 : 3);
    cairo_move_to(page, x - 26, y - 4);
    cairo_line_to(page, x - 6, y - 4);
    cairo_stroke(page);
    cairo_set_dash(page, NULL, 0, 0);
}

static void draw_row(cairo_t *page, const chart *c, int32_t first, int32_t end, double right, double y)
{
    double x = right;
    for (int32_t k = end - 1; k >= first; k--) {
        if (!c->lines[k].name[0])
            continue;
        x -= image_text_width(page, NAME_SIZE, false, c->lines[k].name);
        image_set_colour(page, CHART_INK);
        image_text(page, x, y, NAME_SIZE, ALIGN_LEFT, false, c->lines[k].name);
        draw_sign(page, &c->lines[k], k, x, y);
        x -= SIGN + BETWEEN_NAMES;
    }
}

void chart_draw_legend(cairo_t *page, const chart *c, double left, double right, double top)
{
    double y = top - 8 - LEGEND_ROW * fmax(rows_of(page, c, right - left) - 1, 0);
    for (int32_t first = 0, end; first < c->line_count; first = end) {
        end = row_end(page, c, first, right - left);
        draw_row(page, c, first, end, right, y);
        y += LEGEND_ROW;
    }
}

#endif

/* Charts and pictures of pages.  One module with html_page. */
#include "io/html_page.h"

#include "io/base64.h"

#include <math.h>
#include <stdio.h>

void html_grid_begin(html_page *p) { text_add(p->ctx, &p->text, "<div class=\"grid\">\n"); }
void html_grid_end(html_page *p) { text_add(p->ctx, &p->text, "</div>\n"); }

/* Of what a chart shows along an axis; without a value the first is larger. */
static void widen_range(const double *value, int32_t count, bool logarithmic, double range[2])
{
    for (int32_t i = 0; value && i < count; i++) {
        if (isfinite(value[i]) && (value[i] > 0 || !logarithmic)) {
            range[0] = fmin(range[0], value[i]);
            range[1] = fmax(range[1], value[i]);
        }
    }
}

static void add_axis(html_page *p, const char *label, const double range[2])
{
    char from[HTML_NUMBER_SIZE], to[HTML_NUMBER_SIZE];
    html_escaped(p, label);
    if (!(range[0] <= range[1]))
        return;
    html_number_text(range[0], from);
    html_number_text(range[1], to);
    text_format(p->ctx, &p->text, " from %s to %s", from, to);
}

/* In words what is to be seen: "Energy: kJ from 0 to 12 over time [s] from 0 to 40; kinetic, crushing". */
static void tell_chart(html_page *p, const chart *c, const char *name)
{
    double x[2] = {HUGE_VAL, -HUGE_VAL}, y[2] = {HUGE_VAL, -HUGE_VAL};
    for (int32_t i = 0; i < c->line_count; i++) {
        widen_range(c->lines[i].x, c->lines[i].count, c->log_x, x);
        widen_range(c->lines[i].y, c->lines[i].count, c->log_y, y);
        widen_range(c->lines[i].style == CHART_BAND ? c->lines[i].y2 : NULL, c->lines[i].count, c->log_y, y);
    }
    html_escaped(p, name);
    text_add(p->ctx, &p->text, ": ");
    add_axis(p, c->y_label, y);
    text_add(p->ctx, &p->text, " over ");
    add_axis(p, c->x_label, x);
    for (int32_t i = 0; i < c->line_count; i++) {
        text_add(p->ctx, &p->text, c->lines[i].name[0] ? "; " : "");
        html_escaped(p, c->lines[i].name);
    }
}

fram_status html_chart(html_page *p, const chart *c, bool wide, fram_error *error)
{
    return html_chart_named(p, c, c->title, wide, error);
}

fram_status html_chart_named(html_page *p, const chart *c, const char *name, bool wide, fram_error *error)
{
    enum { HALF = 620, WHOLE = 1240, HEIGHT = 400 };
    text_buffer svg = {0};
    fram_status status = chart_svg(p->ctx, c, wide ? WHOLE : HALF, HEIGHT, &svg, error);
    if (status == FRAM_OK) {
        text_add(p->ctx, &p->text, wide ? "<figure class=\"wide\"><img alt=\"" : "<figure><img alt=\"");
        tell_chart(p, c, name);
        text_add(p->ctx, &p->text, "\" src=\"data:image/svg+xml;base64,");
        base64_text(p->ctx, &p->text, svg.data, (size_t)svg.count);
        text_add(p->ctx, &p->text, "\"></figure>\n");
    } else if (status == FRAM_ERROR_UNSUPPORTED) {
        html_paragraph(p, "%s: not drawn, for this build has no cairo.", name);
        status = FRAM_OK;
    }
    text_free(p->ctx, &svg);
    return status;
}

void html_picture(html_page *p, const void *png, size_t size, const char *shows, const char *caption)
{
    text_add(p->ctx, &p->text, "<figure><img alt=\"");
    html_escaped(p, shows);
    text_add(p->ctx, &p->text, "\" src=\"data:image/png;base64,");
    base64_text(p->ctx, &p->text, png, size);
    text_add(p->ctx, &p->text, "\"><figcaption>");
    html_escaped(p, caption);
    text_add(p->ctx, &p->text, "</figcaption></figure>\n");
}

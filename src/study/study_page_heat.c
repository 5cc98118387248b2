/* Heat maps of the page of a study, of grids over two keys. */
#include "study/key_names.h"
#include "study/study_page_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Number of the value among those that came before, in the order in which they appear. */
static int32_t place_of(const study *s, int32_t key, int32_t condition)
{
    int32_t place = 0;
    for (int32_t c = 0; c <= condition; c++) {
        bool fresh = true;
        for (int32_t d = 0; d < c && fresh; d++)
            fresh = !study_values_same(study_value(s, d, key), study_value(s, c, key));
        if (study_values_same(study_value(s, c, key), study_value(s, condition, key)))
            return place;
        place += fresh;
    }
    return place;
}

static int32_t values_of(const study *s, int32_t key)
{
    int32_t most = 0;
    for (int32_t c = 0; c < s->conditions; c++) {
        int32_t place = place_of(s, key, c);
        most = place > most ? place : most;
    }
    return most + 1;
}

/* The part of its colour that the fullest cell has [%]: ink on it has a contrast of 4.5 at least, as WCAG 2 asks for
   (AA); on all of the colours that maps have it would be 3.2. */
#define HEAT_MOST 70

static void add_heat_cell(study_page *p, page_heat_scale scale, double value)
{
    char text[HTML_NUMBER_SIZE];
    int part = scale.full > 0 && value > 0 ? (int)(fmin(value / scale.full, 1) * HEAT_MOST) : 0;
    html_number_text(page_three_digits(value), text);
    text_format(p->f->ctx, &p->page.text,
                "<td style=\"text-align:center;background:color-mix(in srgb,%s %d%%,#fff)\">%s</td>", scale.colour,
                part, text);
}

/* The values are numbers or plain words, and the conditions in the order of a grid. */
bool page_heat_find(const study *s, page_heat *out)
{
    if (s->keys.count != 2 || s->conditions < 4 || s->conditions > PAGE_HEAT_MOST)
        return false;
    *out = (page_heat){values_of(s, 0), values_of(s, 1)};
    if (out->rows < 2 || out->columns < 2 || out->rows > HEAT_SIDE || out->columns > HEAT_SIDE ||
        out->rows * out->columns != s->conditions)
        return false;
    for (int32_t c = 0; c < s->conditions; c++)
        if (place_of(s, 0, c) != c / out->columns || place_of(s, 1, c) != c % out->columns ||
            strpbrk(study_value(s, c, 0), "<>&") || strpbrk(study_value(s, c, 1), "<>&"))
            return false;
    return true;
}

void page_add_heat(study_page *p, const page_heat *of, const char *name, page_heat_scale scale, const double *value)
{
    const study *s = p->f->s;
    char down[KEY_TEXT_SIZE], across[KEY_TEXT_SIZE];
    key_with_unit(s->keys.data[0], down);
    key_with_unit(s->keys.data[1], across);
    html_paragraph(&p->page, "%s: %s downwards, %s across", name, down, across);
    text_add(p->f->ctx, &p->page.text, "<table><tr><td></td>");
    for (int32_t c = 0; c < of->columns; c++)
        text_format(p->f->ctx, &p->page.text, "<th scope=\"col\" style=\"text-align:center\">%s</th>",
                    study_value(s, c, 1));
    text_add(p->f->ctx, &p->page.text, "</tr>\n");
    for (int32_t r = 0; r < of->rows; r++) {
        text_format(p->f->ctx, &p->page.text, "<tr><th scope=\"row\">%s</th>", study_value(s, r * of->columns, 0));
        for (int32_t c = 0; c < of->columns; c++)
            add_heat_cell(p, scale, value[r * of->columns + c]);
        text_add(p->f->ctx, &p->page.text, "</tr>\n");
    }
    text_add(p->f->ctx, &p->page.text, "</table>\n");
}

void page_add_heats(study_page *p, const bool *has)
{
    page_heat of;
    double value[PAGE_HEAT_MOST] = {0};
    char name[80];
    if (!page_heat_find(p->f->s, &of))
        return;
    html_section(&p->page, "Heat maps");
    for (int i = 0; i < PAGE_FIGURES; i++) {
        if (!has[i])
            continue;
        page_heat_scale scale = {"#d1603d", 0};
        for (int32_t c = 0; c < p->f->s->conditions; c++) {
            value[c] = page_interval(p, c, &p->figures[i]).mean;
            scale.full = fmax(scale.full, value[c]);
        }
        snprintf(name, sizeof name, "%s [%s]", p->figures[i].name, p->figures[i].unit);
        page_add_heat(p, &of, name, scale, value);
    }
}

#include "io/html_page.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char style[] =
    "<style>\n"
    ":root{--ink:#15222e;--soft:#5b6b7a;--line:#dde4ea;--blue:#00457f;--pale:#f4f7fa}\n"
    "*{box-sizing:border-box}\n"
    "body{margin:0 auto;max-width:1120px;padding:36px 40px 60px;color:var(--ink);background:#fff;"
    "font:15px/1.5 system-ui,-apple-system,\"Segoe UI\",\"DejaVu Sans\",sans-serif}\n"
    "header{border-bottom:3px solid var(--blue);padding-bottom:14px;margin-bottom:22px}\n"
    "h1{font-size:28px;line-height:1.2;margin:0 0 6px}\n"
    "header p{margin:0;color:var(--soft)}header h1,header p{overflow-wrap:anywhere}\n"
    "h2{font-size:19px;margin:38px 0 12px;color:var(--blue);border-bottom:1px solid var(--line);padding-bottom:5px;"
    "break-after:avoid}\n"
    "p{margin:8px 0;max-width:86ch}\n"
    ".figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(165px,1fr));gap:12px;margin:14px 0}\n"
    ".figure{background:var(--pale);border:1px solid var(--line);border-radius:8px;padding:11px 14px;"
    "break-inside:avoid}\n"
    ".figure b{display:block;font-size:23px;line-height:1.25;font-variant-numeric:tabular-nums}\n"
    ".figure b small{font-size:14px;font-weight:500;color:var(--soft)}\n"
    ".figure span{font-size:12.5px;color:var(--soft)}\n"
    ".verdict{border:1px solid var(--line);border-left:7px solid #2e7d4f;border-radius:8px;padding:12px 16px 10px;"
    "margin:14px 0;break-inside:avoid}.verdict>b{font-size:19px;line-height:1.3}\n"
    ".verdict.caution{border-left-color:#d08700}.verdict.bad{border-left-color:#b3261e}\n"
    ".verdict ul{list-style:none;margin:8px 0 0;padding:0}.verdict li{display:flex;gap:9px;padding:2px 0}\n"
    ".verdict i{font-style:normal;font-weight:700;width:14px;flex:none;text-align:center;color:#2e7d4f}\n"
    ".verdict .note i{color:var(--soft)}.verdict .caution i{color:#8f5c00}.verdict .bad i{color:#b3261e}\n"
    ".verdict em{font-style:normal;color:var(--soft)}\n"
    "table{border-collapse:collapse;width:100%;margin:10px 0 16px;font-size:13.5px;font-variant-numeric:tabular-nums}\n"
    "th{text-align:left;font-weight:600;color:var(--soft);border-bottom:1.5px solid var(--line);"
    "padding:5px 10px 5px 0}\n"
    "td{border-bottom:1px solid var(--line);padding:5px 10px 5px 0;vertical-align:top;overflow-wrap:break-word}\n"
    "tbody th{font-weight:400;color:inherit;border-bottom:1px solid var(--line);vertical-align:top;"
    "overflow-wrap:break-word}\n"
    "td.n{text-align:right;white-space:nowrap}th.n{text-align:right}td.v{overflow-wrap:anywhere}\n"
    ".scroll{overflow-x:auto}\n"
    "tr{break-inside:avoid}\n"
    ".grid{display:grid;grid-template-columns:1fr 1fr;gap:16px;margin:12px 0}\n"
    "figure{margin:12px 0;break-inside:avoid}.grid figure{margin:0}.grid figure.wide{grid-column:1/-1}\n"
    "figure img{width:100%;height:auto;display:block;border:1px solid var(--line);border-radius:8px}\n"
    ".contents{columns:2;column-gap:28px;padding-left:18px;margin:14px 0}.contents a{color:var(--blue)}\n"
    "figcaption{font-size:12.5px;color:var(--soft);padding-top:4px}\n"
    "pre{font:11px/1.45 ui-monospace,\"DejaVu Sans Mono\",monospace;background:var(--pale);"
    "border:1px solid var(--line);"
    "border-radius:8px;padding:12px 14px;white-space:pre-wrap;overflow-wrap:anywhere;columns:2;column-gap:28px}\n"
    /* Larger letters of a browser make a page narrow: charts stay readable, and are moved sideways.  Paper has a width
       of its own. */
    "@media screen{figure{overflow-x:auto}figure img{min-width:460px}figure.wide img{min-width:900px}}\n"
    "@media screen and (max-width:1020px){.grid{grid-template-columns:minmax(0,1fr)}}\n"
    "@media screen and (max-width:760px){body{padding:20px}pre,.contents{columns:1}}\n"
    "@media print{@page{size:A4;margin:14mm}body{padding:0;max-width:none;font-size:10.5pt}h2{margin-top:20pt}"
    ".scroll{overflow:visible}"
    "table{font-size:9pt}.figure b{font-size:15pt}pre{font-size:6.5pt;border:none;padding:0}"
    "*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}\n"
    "</style>\n";

static void add(html_page *p, const char *text) { text_add(p->ctx, &p->text, text); }

void html_escaped(html_page *p, const char *text) { text_add_escaped(p->ctx, &p->text, text); }

void html_begin(html_page *p, const char *title, const char *subtitle) { html_begin_named(p, title, title, subtitle); }

void html_begin_named(html_page *p, const char *window, const char *title, const char *subtitle)
{
    add(p, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>");
    html_escaped(p, window);
    add(p, "</title>\n");
    add(p, style);
    add(p, "</head>\n<body>\n<header>\n<h1 dir=\"auto\">");
    html_escaped(p, title);
    add(p, "</h1>\n<p dir=\"auto\">");
    html_escaped(p, subtitle);
    add(p, "</p>\n</header>\n<main>\n");
}

void html_contents(html_page *p) { p->list_at = p->text.count; }

/* What stands behind `at` moves on. */
static void put_in(html_page *p, int32_t at, const text_buffer *piece)
{
    int32_t end = p->text.count;
    text_add_bytes(p->ctx, &p->text, piece->data, (size_t)piece->count);
    if (p->text.failed)
        return;
    memmove(p->text.data + at + piece->count, p->text.data + at, (size_t)(end - at));
    memcpy(p->text.data + at, piece->data, (size_t)piece->count);
}

void html_end(html_page *p)
{
    add(p, "</main>\n</body>\n</html>\n");
    p->text.failed = p->text.failed || p->list.failed;
    if (p->list_at == 0 || !p->list.data || p->text.failed)
        return;
    text_buffer whole = {0};
    text_format(p->ctx, &whole, "<nav aria-label=\"Contents\"><ul class=\"contents\">\n%s</ul></nav>\n", p->list.data);
    p->text.failed = whole.failed;
    if (!whole.failed)
        put_in(p, p->list_at, &whole);
    text_free(p->ctx, &whole);
}

void html_free(html_page *p)
{
    text_free(p->ctx, &p->text);
    text_free(p->ctx, &p->list);
}

/* Name of a heading for links: small letters, digits, and one dash for all that lies between. */
enum { LINK_NAME = 96, LINK_ROOM = LINK_NAME + 16 };

static void link_name_of(const html_page *p, const char *title, char out[LINK_ROOM])
{
    char name[LINK_NAME] = "", mark[LINK_ROOM + 4];
    size_t n = 0;
    for (const char *c = title; *c && n + 1 < sizeof name; c++) {
        char small = (char)(*c >= 'A' && *c <= 'Z' ? *c - 'A' + 'a' : *c);
        bool plain = (small >= 'a' && small <= 'z') || (small >= '0' && small <= '9');
        if (plain)
            name[n++] = small;
        else if (n > 0 && name[n - 1] != '-')
            name[n++] = '-';
    }
    n -= n > 0 && name[n - 1] == '-';
    name[n] = '\0';
    snprintf(out, LINK_ROOM, "%s", n > 0 ? name : "section");
    for (int number = 2;; number++) {
        snprintf(mark, sizeof mark, "\"#%s\"", out);
        if (!p->list.data || !strstr(p->list.data, mark))
            return;
        snprintf(out, LINK_ROOM, "%s-%d", n > 0 ? name : "section", number);
    }
}

void html_section(html_page *p, const char *title)
{
    char name[LINK_ROOM];
    link_name_of(p, title, name);
    text_format(p->ctx, &p->text, "<h2 id=\"%s\">", name);
    html_escaped(p, title);
    add(p, "</h2>\n");
    text_format(p->ctx, &p->list, "<li><a href=\"#%s\">", name);
    text_add_escaped(p->ctx, &p->list, title);
    text_add(p->ctx, &p->list, "</a></li>\n");
}

/* The text of a printf, escaped; longer than any line of a page is cut. */
static void add_formatted(html_page *p, const char *format, va_list arguments)
{
    char text[2048];
    vsnprintf(text, sizeof text, format, arguments);
    html_escaped(p, text);
}

void html_paragraph(html_page *p, const char *format, ...)
{
    va_list arguments;
    add(p, "<p>");
    va_start(arguments, format);
    add_formatted(p, format, arguments);
    va_end(arguments);
    add(p, "</p>\n");
}

static const char *const grade_words[] = {"good", "note", "caution", "bad"};
static const char *const grade_marks[] = {"\xe2\x9c\x93", "\xe2\x80\xa2", "!", "\xe2\x9c\x97"};

void html_verdict_begin(html_page *p, verdict_grade grade, const char *title)
{
    add(p, "<section class=\"verdict ");
    add(p, grade_words[grade]);
    add(p, "\">\n<b>");
    html_escaped(p, title);
    add(p, "</b>\n<ul>\n");
}

void html_verdict_line(html_page *p, verdict_grade grade, const char *text, const char *remedy)
{
    add(p, "<li class=\"");
    add(p, grade_words[grade]);
    add(p, "\"><i>");
    add(p, grade_marks[grade]);
    add(p, "</i><span>");
    html_escaped(p, text);
    if (*remedy) {
        add(p, " <em>");
        html_escaped(p, remedy);
        add(p, "</em>");
    }
    add(p, "</span></li>\n");
}

void html_verdict_end(html_page *p) { add(p, "</ul>\n</section>\n"); }

void html_figures_begin(html_page *p) { add(p, "<div class=\"figures\">\n"); }

void html_figure(html_page *p, const char *name, const char *value, const char *unit)
{
    add(p, "<div class=\"figure\"><b>");
    html_escaped(p, value);
    add(p, " <small>");
    html_escaped(p, unit);
    add(p, "</small></b><span>");
    html_escaped(p, name);
    add(p, "</span></div>\n");
}

void html_figures_end(html_page *p) { add(p, "</div>\n"); }

/* The first column holds names, the others numbers. */
void html_table_begin(html_page *p, const char *const *heads, int32_t count)
{
    add(p, "<div class=\"scroll\"><table>\n");
    if (count > 0)
        add(p, "<thead><tr>");
    p->heads = count < HTML_HEADS_MOST ? count : HTML_HEADS_MOST;
    for (int32_t i = 0; i < count; i++) {
        add(p, "<th class=\"w\"");
        if (i < p->heads)
            p->head[i] = p->text.count - 2;
        add(p, " scope=\"col\">");
        html_escaped(p, heads[i]);
        add(p, "</th>");
    }
    add(p, count > 0 ? "</tr></thead>\n<tbody>\n" : "<tbody>\n");
}

/* The first row tells what a column holds. */
static void head_of_number(html_page *p)
{
    if (p->column < p->heads && !p->text.failed)
        p->text.data[p->head[p->column]] = 'n';
}

void html_row_begin(html_page *p)
{
    p->column = 0;
    add(p, "<tr>");
}

void html_row_name(html_page *p, const char *text)
{
    p->column++;
    add(p, "<th scope=\"row\">");
    html_escaped(p, text);
    add(p, "</th>");
}

void html_cell(html_page *p, const char *text)
{
    p->column++;
    add(p, "<td>");
    html_escaped(p, text);
    add(p, "</td>");
}

void html_number_text(double value, char out[HTML_NUMBER_SIZE])
{
    double size = fabs(value);
    value += 0.0; /* 0, not -0 */
    if (value != value)
        snprintf(out, HTML_NUMBER_SIZE, "\xe2\x80\x93");
    else if (size >= 1e6 || (size > 0 && size < 1e-3))
        snprintf(out, HTML_NUMBER_SIZE, "%.3e", value);
    else if (size >= 1000)
        snprintf(out, HTML_NUMBER_SIZE, "%.0f", value);
    else
        snprintf(out, HTML_NUMBER_SIZE, "%.4g", value);
}

static void number_cell(html_page *p, const char *text)
{
    head_of_number(p);
    p->column++;
    add(p, "<td class=\"n\">");
    add(p, text);
    add(p, "</td>");
}

void html_number(html_page *p, double value)
{
    char text[HTML_NUMBER_SIZE];
    html_number_text(value, text);
    number_cell(p, text);
}

void html_place(html_page *p, double value)
{
    char text[HTML_NUMBER_SIZE];
    if (fabs(value) >= 1000)
        snprintf(text, sizeof text, "%.1f", value);
    else
        html_number_text(value, text);
    number_cell(p, text);
}

void html_row_end(html_page *p)
{
    p->heads = 0;
    add(p, "</tr>\n");
}

void html_table_end(html_page *p) { add(p, "</tbody>\n</table></div>\n"); }

void html_fact(html_page *p, const char *name, const char *format, ...)
{
    va_list arguments;
    html_row_begin(p);
    html_row_name(p, name);
    p->column++;
    add(p, "<td class=\"v\">");
    va_start(arguments, format);
    add_formatted(p, format, arguments);
    va_end(arguments);
    add(p, "</td>");
    html_row_end(p);
}

void html_verbatim(html_page *p, const char *text)
{
    add(p, "<pre>");
    html_escaped(p, text);
    add(p, "</pre>\n");
}

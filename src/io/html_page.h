/* Pages for people: one self-contained HTML file with headings, tables, figures of numbers, charts (SVG inside) and
   pictures (PNG inside); no script, nothing fetched; laid out for the screen and for A4.  Knows the form; must not know
   what a page is about.  Failures of memory are kept in the text buffer. */
#ifndef IO_HTML_PAGE_H
#define IO_HTML_PAGE_H

#include "io/chart.h"

/* Heads of a table stand over their columns as these do: right over numbers, left over words. */
enum { HTML_HEADS_MOST = 24 };
typedef struct html_page {
    context *ctx;
    text_buffer text;
    int32_t head[HTML_HEADS_MOST]; /* of the open table's heads: where the letter of its class stands in the text */
    int32_t heads, column;         /* heads that wait for the first row; cells of the row so far */
    text_buffer list;              /* of its sections so far, as links */
    int32_t list_at;               /* where in the text they will stand; 0: nowhere */
} html_page;

/* The head and the heading; subtitle may be "". */
void html_begin(html_page *p, const char *title, const char *subtitle);
/* One whose window has another name than its heading, as one of several. */
void html_begin_named(html_page *p, const char *window, const char *title, const char *subtitle);
/* Here will stand links to the sections that follow. */
void html_contents(html_page *p);
void html_end(html_page *p);
void html_free(html_page *p);

/* Its heading has a name for links, "ice-load", with a number where there was one of this name. */
void html_section(html_page *p, const char *title);
/* printf; the text is escaped. */
void html_paragraph(html_page *p, const char *format, ...) __attribute__((format(printf, 2, 3)));
void html_escaped(html_page *p, const char *text);

/* A box with what a reader must know first: begin with its sentence, lines with what to do ("": nothing), end. */
typedef enum verdict_grade { VERDICT_GOOD = 0, VERDICT_NOTE, VERDICT_CAUTION, VERDICT_BAD } verdict_grade;
void html_verdict_begin(html_page *p, verdict_grade grade, const char *title);
void html_verdict_line(html_page *p, verdict_grade grade, const char *text, const char *remedy);
void html_verdict_end(html_page *p);

/* A row of large figures: begin, figures, end. */
void html_figures_begin(html_page *p);
void html_figure(html_page *p, const char *name, const char *value, const char *unit);
void html_figures_end(html_page *p);

/* A table: begin with the columns' heads; cells row by row; numbers stand right, and heads as the cells of the first
   row. */
void html_table_begin(html_page *p, const char *const *heads, int32_t count);
void html_row_begin(html_page *p);
/* The first cell, where it tells what the row is of. */
void html_row_name(html_page *p, const char *text);
void html_cell(html_page *p, const char *text);
/* To four significant digits; a NaN is a dash. */
void html_number(html_page *p, double value);
/* A coordinate [m]: to decimetres, however far from the origin. */
void html_place(html_page *p, double value);
void html_row_end(html_page *p);
void html_table_end(html_page *p);
/* Two cells: a name and a text. */
void html_fact(html_page *p, const char *name, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Charts and pictures stand side by side in a grid where there is room. */
void html_grid_begin(html_page *p);
void html_grid_end(html_page *p);
/* Without cairo a note stands in its place.  wide: over the whole width of the page.  To who cannot see it a chart
   tells its title, its axes with their ends, and the names of its lines. */
fram_status html_chart(html_page *p, const chart *c, bool wide, fram_error *error);
/* One that is called by another name than its title where it is not seen. */
fram_status html_chart_named(html_page *p, const chart *c, const char *name, bool wide, fram_error *error);
/* A PNG; shows: what is to be seen, for who cannot see it. */
void html_picture(html_page *p, const void *png, size_t size, const char *shows, const char *caption);
/* Text as it stands, in small type. */
void html_verbatim(html_page *p, const char *text);

/* A number to four significant digits, as html_number writes it. */
enum { HTML_NUMBER_SIZE = 32 };
void html_number_text(double value, char out[HTML_NUMBER_SIZE]);

#endif

/* Ticks of a chart's axis: where they stand and how they are told.  Part of the chart, which draws them. */
#ifndef IO_CHART_TICKS_H
#define IO_CHART_TICKS_H

#include <stdbool.h>

/* Values on the axis: decades on a logarithmic one. */
typedef struct tick_row {
    double first, step;
    int count;
    bool logarithmic;
    int digits; /* with which two neighbours are told apart */
} tick_row;

/* In about so many parts, or with the step where that is above 0. */
tick_row tick_row_of(double lo, double hi, int parts, double step, bool logarithmic);
static inline double tick_at(const tick_row *t, int i) { return t->first + i * t->step; }
/* Of each so many ticks one is told, those at multiples of `every` steps, so that zero is where it is shown. */
bool tick_is_told(const tick_row *t, int i, int every);

enum { TICK_TEXT = 32 };
void tick_text(const tick_row *t, int i, char text[TICK_TEXT]);

#endif

#include "io/chart_ticks.h"

#include "base/number_text.h"
#include "base/transcendental.h"
#include "io/image.h"

#include <math.h>
#include <stdio.h>

/* More ticks than any axis needs: a bound for data at the end of the range of doubles. */
enum { MOST_TICKS = 50 };
/* What an axis is told with where that is enough; and of the step, which may be several of its last place. */
enum { LEAST_DIGITS = 6, STEP_DIGITS = 2 };

/* Those of the end that is farther from zero, down to the last one of the step. */
static int digits_for(const tick_row *t)
{
    double most = fmax(fabs(t->first), fabs(tick_at(t, t->count - 1)));
    return digits_beside(most, t->step, STEP_DIGITS, LEAST_DIGITS);
}

tick_row tick_row_of(double lo, double hi, int parts, double step, bool logarithmic)
{
    if (!(step > 0))
        step = logarithmic ? fmax(1, ceil((hi - lo) / parts)) : image_round_step(hi - lo, parts);
    double first = ceil(lo / step - 1e-9) * step;
    int count = (int)fmin(floor((hi - first) / step + 1e-9), MOST_TICKS) + 1;
    tick_row t = {first, step, count, logarithmic, LEAST_DIGITS};
    if (!logarithmic)
        t.digits = digits_for(&t);
    return t;
}

bool tick_is_told(const tick_row *t, int i, int every)
{
    return every <= 1 || fmod(floor(tick_at(t, i) / t->step + 0.5), every) == 0;
}

void tick_text(const tick_row *t, int i, char text[TICK_TEXT])
{
    double at = tick_at(t, i);
    if (t->logarithmic && fabs(at) > 4)
        snprintf(text, TICK_TEXT, "1e%.0f", at);
    else if (t->logarithmic)
        snprintf(text, TICK_TEXT, "%.6g", real_pow(10, at));
    else
        snprintf(text, TICK_TEXT, "%.*g", t->digits, fabs(at) < t->step * 1e-6 ? 0.0 : at);
}

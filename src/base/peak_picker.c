#include "base/peak_picker.h"

#include "base/channel_statistics.h"

#include <math.h>
#include <string.h>

/* Times are apart by a whole number of steps but for rounding: as a part of the separation. */
static const double TIME_SLACK = 1e-9;

bool peak_picker_init(context *ctx, double separation, double from, int32_t steps, peak_picker *p)
{
    *p = (peak_picker){.separation = separation, .from = from};
    return array_resize(ctx, &p->recent, steps + 2); /* both ends, and one by rounding */
}

void peak_picker_free(context *ctx, peak_picker *p) { array_free(ctx, &p->recent); }

static bool stand_apart(const peak_picker *p, double a, double b)
{
    return fabs(a - b) >= p->separation * (1 - TIME_SLACK);
}

/* ---- peaks ---- */

static bool is_large(const peak_picker *p, const load_peak *peak)
{
    return p->count < PEAKS_KEPT || peak->value > p->kept[PEAKS_KEPT - 1].value;
}

bool peak_picker_may_keep(const peak_picker *p, const load_peak *peak)
{
    return is_large(p, peak) && time_is_after(peak->time, p->from);
}

bool peak_picker_keeps(const peak_picker *p) { return p->open && peak_picker_may_keep(p, &p->candidate); }

static void keep(peak_picker *p, load_peak peak)
{
    if (!peak_picker_may_keep(p, &peak))
        return;
    int32_t at = p->count < PEAKS_KEPT ? p->count++ : PEAKS_KEPT - 1;
    for (; at > 0 && p->kept[at - 1].value < peak.value; at--)
        p->kept[at] = p->kept[at - 1];
    p->kept[at] = peak;
}

/* The largest that waits from before a time, the first one of equal ones; -1: none. */
static int32_t largest_before(const peak_picker *p, double time)
{
    int32_t best = -1;
    for (int32_t i = 0; i < p->awaited_count && p->awaited[i].time < time; i++)
        best = best < 0 || p->awaited[i].value > p->awaited[best].value ? i : best;
    return best;
}

static void stop_awaiting(peak_picker *p, int32_t from, int32_t to)
{
    memmove(&p->awaited[from], &p->awaited[to], (size_t)(p->awaited_count - to) * sizeof *p->awaited);
    p->awaited_count -= to - from;
}

/* A peak; what stands too near to it is none. */
static void choose(peak_picker *p, int32_t at)
{
    load_peak peak = p->awaited[at];
    int32_t from = at, to = at + 1;
    while (from > 0 && !stand_apart(p, p->awaited[from - 1].time, peak.time))
        from--;
    while (to < p->awaited_count && !stand_apart(p, p->awaited[to].time, peak.time))
        to++;
    keep(p, peak);
    stop_awaiting(p, from, to);
}

/* What comes is not before `until`: when the largest stands apart from that it is a peak, and those before it depend on
   nothing that comes. */
static void settle(peak_picker *p, double until)
{
    for (int32_t at = largest_before(p, HUGE_VAL); at >= 0 && stand_apart(p, p->awaited[at].time, until);
         at = largest_before(p, HUGE_VAL)) {
        double time = p->awaited[at].time;
        for (; at >= 0; at = largest_before(p, time))
            choose(p, at);
    }
}

/* ---- maxima ---- */

static int32_t free_room(const peak_picker *p)
{
    bool taken[PEAK_ROOMS] = {0};
    for (int32_t i = 0; i < p->count; i++)
        taken[p->kept[i].room] = true;
    for (int32_t i = 0; i < p->awaited_count; i++)
        taken[p->awaited[i].room] = true;
    int32_t room = 0;
    while (taken[room])
        room++;
    return room;
}

/* Nothing within a window overtook the candidate.  One that is too small to be kept decides on smaller ones only, and
   one from before the start on none. */
static void confirm(peak_picker *p)
{
    p->open = false;
    if (!peak_picker_may_keep(p, &p->candidate))
        return;
    if (p->awaited_count == PEAKS_AWAITED)
        stop_awaiting(p, 0, 1);
    p->awaited[p->awaited_count++] = p->candidate;
}

load_value *peak_picker_recent(const peak_picker *p, int32_t i)
{
    return &p->recent.data[(p->first + i) % p->recent.count];
}

/* Values of before the window go, but for the last one: a maximum exceeds its neighbours, however far they are. */
static void forget(peak_picker *p, double time)
{
    double since = time - p->separation / PEAK_SEPARATION * (1 + TIME_SLACK);
    while (p->recent_count > 1 && (peak_picker_recent(p, 0)->time < since || p->recent_count == p->recent.count)) {
        p->first = (p->first + 1) % p->recent.count;
        p->recent_count--;
    }
}

static void remember(peak_picker *p, double time, double value)
{
    while (p->recent_count > 0 && peak_picker_recent(p, p->recent_count - 1)->value < value)
        p->recent_count--;
    *peak_picker_recent(p, p->recent_count++) = (load_value){time, value};
}

bool peak_picker_rises(peak_picker *p, double time, double value)
{
    forget(p, time);
    const load_value *largest = p->recent_count > 0 ? peak_picker_recent(p, 0) : NULL;
    bool rises = value > (largest ? largest->value : 0);
    if (p->open && largest && largest->time > p->candidate.time)
        confirm(p);
    remember(p, time, value);
    if (rises) {
        p->candidate = (load_peak){time, value, p->open ? p->candidate.room : free_room(p)};
        p->open = true;
    }
    settle(p, p->open ? p->candidate.time : time);
    return rises && peak_picker_keeps(p);
}

void peak_picker_ends(peak_picker *p)
{
    if (p->open)
        confirm(p);
    settle(p, HUGE_VAL);
}

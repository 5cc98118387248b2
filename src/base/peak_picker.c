#include "base/peak_picker.h"

#include "base/channel_statistics.h"

void peak_picker_init(peak_picker *p, double separation, double from)
{
    *p = (peak_picker){.separation = separation, .from = from};
}

bool peak_picker_keeps(const peak_picker *p)
{
    double value = p->candidate.value;
    return p->open && time_is_after(p->candidate.time, p->from) && value > 0 &&
           (p->count < PEAKS_KEPT || value > p->kept[PEAKS_KEPT - 1].value);
}

int32_t peak_picker_ends(peak_picker *p)
{
    bool keeps = peak_picker_keeps(p);
    p->open = false;
    if (!keeps)
        return -1;
    int32_t at = p->count < PEAKS_KEPT ? p->count++ : PEAKS_KEPT - 1;
    for (; at > 0 && p->kept[at - 1].value < p->candidate.value; at--)
        p->kept[at] = p->kept[at - 1];
    p->kept[at] = p->candidate;
    return at;
}

int32_t peak_picker_settles(peak_picker *p, double time)
{
    return p->open && time >= p->candidate.time + p->separation ? peak_picker_ends(p) : -1;
}

bool peak_picker_rises(peak_picker *p, double time, double value)
{
    /* Down a flank nothing is a peak. */
    bool rises = value > p->last;
    p->last = value;
    if (!rises || (p->open && value <= p->candidate.value))
        return false;
    p->open = true;
    p->candidate = (load_peak){time, value};
    return peak_picker_keeps(p);
}

#include "sim/media_now.h"

media media_now(const model *m, const input_table *inputs, double time)
{
    media now = media_at(&m->media, &m->history, time);
    int32_t wind = input_find(inputs, INPUT_WIND, 0), current = input_find(inputs, INPUT_CURRENT, 0);
    if (wind >= 0)
        now.wind = inputs->first[wind];
    if (current >= 0)
        now.current = inputs->first[current];
    return now;
}

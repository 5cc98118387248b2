#include "sim/media_now.h"

media media_now(const model *m, const input_table *inputs, double time)
{
    media now = media_at(&m->media, &m->history, time);
    now.wind = input_velocity(inputs, INPUT_WIND, now.wind);
    now.current = input_velocity(inputs, INPUT_CURRENT, now.current);
    return now;
}

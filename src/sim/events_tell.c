#include "sim/events_tell.h"

void events_tell(context *ctx, const model *m, const world *w, int32_t from)
{
    for (int32_t i = from; i < w->events.count; i++) {
        char text[160];
        int32_t vessel = w->events.vessel[i], other = w->events.number[i];
        bool of_two = event_is_of_two((station_event)w->events.kind[i]) && other >= 0 && other < m->vessels.count;
        const char *name = m->vessels.data[vessel].name;
        event_text(&w->events, i, of_two && name[0] ? m->vessels.data[other].name : NULL,
                   m->vessels.data[vessel].approach.look_ahead, text, sizeof text);
        log_write(ctx, LOG_WARNING, "t = %.2f s: %s%s%s", w->events.time[i], name, name[0] ? ": " : "", text);
    }
}

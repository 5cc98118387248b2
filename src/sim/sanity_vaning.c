/* A bow that turns against its load, where that load turns with the bow: a loop that may swing without end. */
#include "base/number_text.h"
#include "sim/sanity_parts.h"
#include "sim/steady_load.h"
#include "vessel/plane_motion.h"

/* Headings that are looked at, a degree apart. */
enum { HEADINGS = 360 };
/* Halvings of a frequency: to a part of 1e-6. */
enum { FREQUENCY_HALVINGS = 20 };

/* From a heading to that which wind and current ask for, between -pi and pi; a NaN where they are less than what is
   heeded. */
static double left_to_turn(const teller *t, const media *now, int32_t vessel, double heading)
{
    vec3 load = steady_media_load(t->model, t->made, vessel, now, heading);
    double least = t->e->keys->positioning.vaning_load;
    if (!(load.x * load.x + load.y * load.y > least * least))
        return (double)NAN;
    return plane_angle(real_atan2(-load.y, -load.x) - heading);
}

/* By how much, for each radian that the bow turns away from where it meets the load, the heading that the load asks for
   turns to the other side: 0 for a load whose direction does not go by the heading; a NaN where there is no such
   place. */
static double swing_of_load(const teller *t, int32_t vessel)
{
    const media now = media_at(&t->model->media, &t->model->history, 0);
    double step = 2 * PI / HEADINGS, before = left_to_turn(t, &now, vessel, 0), most = (double)NAN;
    for (int i = 1; i <= HEADINGS; i++) {
        double left = left_to_turn(t, &now, vessel, i * step);
        if (before >= 0 && left < 0 && before - left < PI)
            most = fmax(most, (before - left) / step - 1);
        before = left;
    }
    return most;
}

/* From the load to the bow lie the vaning itself, of one pole, the filter of set points and the observer, of three
   each.  Where they have turned a swing by half of a period, it grows if it comes back larger: the swing of the load at
   which it does.  A box of 100 m in a wind on coefficients of 2.99 went on by 0.9 of itself a period with a vaning_time
   for which this is 2.92; a current damps, since its water goes along with a hull that turns: to 1.5 times this. */
static double largest_swing(double vaning_time, double filter, double observer)
{
    double low = 0, high = 2 * filter;
    for (int i = 0; i < FREQUENCY_HALVINGS; i++) {
        double w = 0.5 * (low + high);
        double lag = real_atan2(vaning_time * w, 1) + 3 * real_atan2(w, filter) + 3 * real_atan2(w, observer);
        *(lag < PI ? &low : &high) = w;
    }
    double v = low * vaning_time, f = 1 + low * low / (filter * filter), o = 1 + low * low / (observer * observer);
    return sqrt(1 + v * v) * f * sqrt(f) * o * sqrt(o);
}

/* A vaning_time with which half of what comes back would be too much. */
#define SWING_TO_SPARE 2

static double enough_time(const scenario_positioning *p, double observer, double swing)
{
    double time = p->vaning_time;
    while (largest_swing(time, p->reference_frequency, observer) < SWING_TO_SPARE * swing && time < 1e9)
        time *= 1.1;
    return time;
}

/* A load that is fed forward as measured is that of the ice alone. */
bool sanity_asks_of_vaning(const scenario_vessel *v)
{
    const scenario_positioning *p = &v->positioning;
    return sanity_is_positioned(v) && p->heading == HEADING_VANING && p->feed_forward != FEED_MEASURED;
}

/* Of wind and current as the run begins; ice comes on top. */
void sanity_tell_vaning(const scenario *s, int32_t vessel, sanity_built built, sanity_teller tell, const void *to)
{
    const vessel_entry e = scenario_vessel_entry(s, vessel);
    const scenario_positioning *p = &e.keys->positioning;
    const teller t = {s, tell, to, &e, built.made, built.model, built.read};
    if (!sanity_asks_of_vaning(e.keys) || !built.made || !built.model || built.model->forces != FORCES_FLUID)
        return;
    double swing = swing_of_load(&t, vessel), observer = sanity_observer_bandwidth(s, p, p->interval);
    if (!(swing > largest_swing(p->vaning_time, p->reference_frequency, observer)))
        return;
    sanity_say(tell, to,
               "%s.positioning.vaning_time: as the bow turns by a degree the heading that wind and current ask for "
               "turns by %.3g the other way, so that it may swing for long, or for ever; take %s s or more",
               e.path, swing, least_text_of(enough_time(p, observer, swing), 3).text);
}

/* A bow that turns against its load, where that load turns with the bow: a loop that may swing without end. */
#include "base/number_text.h"
#include "sim/sanity_parts.h"
#include "sim/steady_load.h"
#include "vessel/controller.h"

/* Headings that are looked at, 5 degrees apart, and between two of them where a place may be, a degree apart: each is a
   sum over the faces of the hull. */
enum { HEADINGS = 72, BETWEEN = 5 };
/* Halvings of a frequency, or of a time: to a part of 1e-6. */
enum { FREQUENCY_HALVINGS = 20, TIME_HALVINGS = 20 };

/* A load and the heading that it asks for, from that at which it is met, between -pi and pi; a NaN where it is less
   than what is heeded. */
typedef struct asked_turn {
    vec3 load;
    double left;
} asked_turn;

static asked_turn turn_asked(const teller *t, const media *now, int32_t vessel, double heading)
{
    asked_turn out = {steady_media_load(t->model, t->made, vessel, now, heading), (double)NAN};
    double least = t->e->keys->positioning.vaning_load;
    if (out.load.x * out.load.x + out.load.y * out.load.y > least * least)
        out.left = plane_angle(real_atan2(-out.load.y, -out.load.x) - heading);
    return out;
}

static bool is_met_between(double before, double after) { return before >= 0 && after < 0 && before - after < PI; }

/* A load that turns with the bow: by how much the heading that it asks for turns to the other side, for each radian
   that the bow turns away from where it meets the load (0 for a load whose direction does not go by the heading; a NaN
   where there is no such place), over what the current damps of it. */
typedef struct bow_swing {
    double turn, relieved;
} bow_swing;

/* Of what turns the load the part that is the current's damps as much again, since its water goes along with a hull
   that turns.  By half at most: an estimate by two runs of one box, which swings with a vaning_time of 100 s and rests
   with 130, no law. */
#define MOST_RELIEF 1.5

static double relief_of_current(const teller *t, const media *now, int32_t vessel, double heading, double step)
{
    media flows = *now;
    flows.wind = vec3_make(0, 0, 0);
    vec3 all = vec3_sub(steady_media_load(t->model, t->made, vessel, now, heading),
                        steady_media_load(t->model, t->made, vessel, now, heading - step));
    vec3 own = vec3_sub(steady_media_load(t->model, t->made, vessel, &flows, heading),
                        steady_media_load(t->model, t->made, vessel, &flows, heading - step));
    double square = all.x * all.x + all.y * all.y;
    return square > 0 ? fmin(1 + fmax((all.x * own.x + all.y * own.y) / square, 0), MOST_RELIEF) : 1;
}

/* first: of the headings that are BETWEEN times as many; found by the same product as those, since
   the place may lie at one of them. */
static void look_between(const teller *t, const media *now, int32_t vessel, int first, bow_swing *most)
{
    double step = 2 * PI / (HEADINGS * BETWEEN), before = turn_asked(t, now, vessel, first * step).left;
    for (int i = 1; i <= BETWEEN; i++) {
        double heading = (first + i) * step, left = turn_asked(t, now, vessel, heading).left;
        if (is_met_between(before, left)) {
            double turn = (before - left) / step - 1;
            double relieved = turn / relief_of_current(t, now, vessel, heading, step);
            if (!(most->relieved >= relieved))
                *most = (bow_swing){turn, relieved};
        }
        before = left;
    }
}

static bow_swing swing_of_load(const teller *t, int32_t vessel)
{
    const media now = media_at(&t->model->media, &t->model->history, 0);
    double step = 2 * PI / (HEADINGS * BETWEEN), before = turn_asked(t, &now, vessel, 0).left;
    bow_swing most = {(double)NAN, (double)NAN};
    for (int i = BETWEEN; i <= HEADINGS * BETWEEN; i += BETWEEN) {
        double left = turn_asked(t, &now, vessel, i * step).left;
        if (is_met_between(before, left))
            look_between(t, &now, vessel, i - BETWEEN, &most);
        before = left;
    }
    return most;
}

/* What lies between the load and the bow. */
typedef struct vaning_loop {
    double filter, observer;                   /* poles of set points and of the observer, three each [rad/s] */
    double proportional, derivative, integral; /* of the controller, over what it turns: pid_gains_for */
} vaning_loop;

static vaning_loop loop_of(const scenario *s, const scenario_positioning *p)
{
    const mat3 one = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const pid_gains g = pid_gains_for(one, p->frequency, p->damping);
    return (vaning_loop){p->reference_frequency, sanity_observer_bandwidth(s, p, p->interval), g.proportional.z,
                         g.derivative.z, g.integral.z};
}

/* From a heading that is wanted, with its speed, to that of the ship at a frequency: how much smaller, and later. */
static double ship_follows(const vaning_loop *l, double w, double *lag)
{
    double re = l->integral - l->derivative * w * w, wanted = l->proportional * w, made = wanted - w * w * w;
    *lag = real_atan2(made * re - re * wanted, re * re + made * wanted);
    return sqrt((re * re + made * made) / (re * re + wanted * wanted));
}

/* From the load to the bow lie the vaning itself, of one pole, the filter of set points and the observer, of three
   each, and the ship under its controller.  Where they have turned a swing by half of a period, it grows if it comes
   back larger: the swing of the load at which it does.  A box of 100 m whose wind has one of 2.99 comes to rest with a
   vaning_time for which this is 3.08, takes an hour with 2.59 and swings for ever with 2.38. */
static double largest_swing(const vaning_loop *l, double vaning_time)
{
    double low = 0, high = 2 * l->filter, late;
    for (int i = 0; i < FREQUENCY_HALVINGS; i++) {
        double w = 0.5 * (low + high);
        (void)ship_follows(l, w, &late);
        double lag = real_atan2(vaning_time * w, 1) + 3 * real_atan2(w, l->filter) + 3 * real_atan2(w, l->observer);
        *(lag + late < PI ? &low : &high) = w;
    }
    double v = low * vaning_time, f = low / l->filter, o = low / l->observer;
    double steps = (1 + f * f) * (1 + o * o);
    return sqrt(1 + v * v) * steps * sqrt(steps) * ship_follows(l, low, &late);
}

/* A vaning_time with which four fifths of what comes back would be too much: a swing is gone within half an hour. */
#define SWING_TO_SPARE 1.25

static double enough_time(const vaning_loop *l, double set, double swing)
{
    double low = set, high = set;
    while (largest_swing(l, high) < SWING_TO_SPARE * swing && high < 1e9)
        high *= 2;
    for (int i = 0; i < TIME_HALVINGS; i++) {
        double time = 0.5 * (low + high);
        *(largest_swing(l, time) < SWING_TO_SPARE * swing ? &low : &high) = time;
    }
    return high;
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
    const bow_swing swing = swing_of_load(&t, vessel);
    const vaning_loop loop = loop_of(s, p);
    if (!(swing.relieved > largest_swing(&loop, p->vaning_time)))
        return;
    sanity_say(tell, to,
               "%s.positioning.vaning_time: as the bow turns by a degree the heading that wind and current ask for "
               "turns by %.3g the other way, so that it may swing for long, or for ever; take %s s or more",
               e.path, swing.turn, least_text_of(enough_time(&loop, p->vaning_time, swing.relieved), 3).text);
}

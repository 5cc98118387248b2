#include "vessel/manoeuvre.h"

#include "base/transcendental.h"

hull_lift hull_lift_of(double length, double beam, double draught, double volume, double water_density)
{
    double flat = PI * (draught / length) * (draught / length), block = volume / (length * beam * draught);
    double square = 0.5 * water_density * length * length;
    return (hull_lift){
        .y_v = -square * flat * (1 + 0.4 * block * beam / draught),
        .y_r = -square * length * flat * (-0.5 + 2.2 * beam / length - 0.08 * beam / draught),
        .n_v = -square * length * flat * (0.5 + 2.4 * draught / length),
        .n_r = -square * length * length * flat * (0.25 + 0.039 * beam / draught - 0.56 * beam / length),
    };
}

hull_lift hull_lift_moved(hull_lift l, double aft)
{
    return (hull_lift){
        .y_v = l.y_v,
        .y_r = l.y_r + aft * l.y_v,
        .n_v = l.n_v + aft * l.y_v,
        .n_r = l.n_r + aft * (l.n_v + l.y_r) + aft * aft * l.y_v,
    };
}

hull_lift manoeuvring_lift(const manoeuvring *m)
{
    hull_lift l = m->whole;
    l.y_r += m->a11;
    if (l.y_v != 0 || l.n_v != 0)
        l.n_v += m->a22 - m->a11;
    l.n_r += m->a26;
    return l;
}

double manoeuvring_lever(const manoeuvring *m) { return m->a26 / (m->mass + m->a22); }

double manoeuvring_inertia(const manoeuvring *m) { return m->inertia - m->a26 * manoeuvring_lever(m); }

#include "vessel/rudder.h"

#include "base/transcendental.h"

#include <math.h>

/* Height over chord of a rudder: 1.5 of usual ones, from 1 to 2 (Bertram 2000, 5.4). */
static const double ASPECT = 1.5;
/* Of the speed that the propeller gives to the water far behind it the rudder meets this part (0.5 of the tanker
   KVLCC2, Yasukawa and Yoshimura 2015; 0.6 is usual, and 0.9 is momentum theory's without losses a diameter behind). */
static const double RACE = 0.6;
/* Part of the ship's motion aside that the flow at the rudder shows, straightened by hull and propeller: 0.40 and 0.64
   to the two sides of the same ship. */
static const double STRAIGHTENED = 0.5;
/* The hull before a rudder that pushes aside takes a part of the rudder's force on itself, and its wake makes up for
   part of the rudder's drag (the same ship, 1 + a_H and 1 - t_R). */
static const double WITH_HULL = 1.31, DRAG_LEFT = 0.61;
/* The flow leaves the rudder at a larger angle of attack, whose force is taken as that at this angle [rad]. */
static const double STALL = 35 * PI / 180;

double rudder_area(double length, double beam, double draught, double block_coefficient)
{
    double broad = block_coefficient * beam / length;
    return 0.01 * length * draught * (1 + 50 * broad * broad);
}

rudder rudder_of(double area, int propellers, double diameter, double block_coefficient, double density)
{
    double height = sqrt(ASPECT * area / propellers);
    double wake = propellers > 1 ? 0.55 * block_coefficient - 0.2 : 0.5 * block_coefficient - 0.05;
    return (rudder){.area = area,
                    .slope = 6.13 * ASPECT / (ASPECT + 2.25),
                    .wake = fmin(fmax(wake, 0), 0.9),
                    .disc_area = propellers * PI / 4 * diameter * diameter,
                    .covered = height > 0 ? fmin(1, diameter / height) : 1,
                    .density = density};
}

double rudder_speed(const rudder *r, double ahead, double thrust)
{
    double past = (1 - r->wake) * fmax(ahead, 0);
    double gained = sqrt(past * past + fmax(thrust, 0) / (0.5 * r->density * r->disc_area)) - past;
    double race = past + RACE * gained;
    return sqrt(r->covered * race * race + (1 - r->covered) * past * past);
}

/* Angle by which the water comes from ahead, and the normal force over the sine of the angle of attack. */
static double inflow(const rudder *r, double ahead, double aside, double thrust, double *most)
{
    double speed = rudder_speed(r, ahead, thrust), across = STRAIGHTENED * aside;
    *most = 0.5 * r->density * r->area * r->slope * (speed * speed + across * across);
    return speed > 0 ? real_atan2(across, speed) : 0;
}

double rudder_most_angle(const rudder *r, double ahead, double aside, double thrust)
{
    if (!(r->area > 0))
        return 0.5 * PI;
    /* Of sin(angle + flow) cos(angle), by which the force aside goes until the flow leaves the rudder. */
    double most, flow = inflow(r, ahead, aside, thrust, &most);
    return fmin(STALL - flow, 0.25 * PI - 0.5 * flow);
}

steering_force rudder_force(const rudder *r, double ahead, double aside, double thrust, double angle)
{
    if (!(r->area > 0)) {
        double turned = thrust > 0 ? angle : 0;
        return (steering_force){thrust * real_cos(turned), -thrust * real_sin(turned)};
    }
    double most, attack = angle + inflow(r, ahead, aside, thrust, &most);
    double normal = most * real_sin(fmin(fmax(attack, -STALL), STALL));
    return (steering_force){thrust - DRAG_LEFT * normal * real_sin(angle), -WITH_HULL * normal * real_cos(angle)};
}

static double arc_sine(double x)
{
    double y = fmin(fmax(x, -1), 1);
    return real_atan2(y, sqrt(1 - y * y));
}

double rudder_angle_for(const rudder *r, double ahead, double aside, double thrust, double force, double now)
{
    if (!(r->area > 0))
        return thrust > 0 ? arc_sine(-force / thrust) : 0;
    double most, flow = inflow(r, ahead, aside, thrust, &most);
    if (!(most > 0))
        return 0;
    double attack = arc_sine(-force / (WITH_HULL * most * real_cos(now)));
    return fmin(fmax(attack, -STALL), STALL) - flow;
}

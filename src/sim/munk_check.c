#include "sim/munk_check.h"

#include "base/number_text.h"
#include "base/transcendental.h"
#include "sim/known_flow.h"
#include "sim/vessel_speed.h"

#include <math.h>

/* Munk's moment in a table's terms.  A hull that goes through the water with (u, v), ahead and to port, and does not
   turn has the yaw moment N = -(a22 - a11) u v of Kirchhoff's equations (Lamb 1932, section 124).  A table's angle a is
   that of the water's motion past the hull, counter-clockwise from the bow: u = -U cos a, v = -U sin a, so that
   N = -(a22 - a11) U^2 sin a cos a = -1/2 (a22 - a11) U^2 sin 2a, and as a coefficient over 1/2 rho U^2 A L
       cn = -k sin 2a,  k = (a22 - a11) / (rho A L).
   From ahead, at a = 180 degrees, water that comes a little from starboard (a < 180) turns the bow of a long hull to
   port, away from it: cn > 0.

   With a table Kirchhoff's terms are taken without N (fluid/response.c), since what was measured on a hull held in a
   flow has it.  All of them together do no work; so without a part 1 - f of N in the table the rest does
   (1 - f) (a22 - a11) u v r, which drives a ship that swings about lines before its middle. */

/* The angle from ahead at which tables are judged [deg]: small, and not within one row of most. */
#define JUDGED_AT 10.0
/* f under which is warned.  With half of it a ship of 200 m on a turret 70 m before its middle hardly loses of its
   swing in 1 m/s, and on one at 95 m it swings ever wider; with a quarter on the first too, with all on neither.  Bare
   hulls have a half to all of it near ahead, where the lift of the hull takes some off (OCIMF 1994). */
#define LEAST_PART 0.8
/* k under which there is hardly such a moment: hulls about as broad as long. */
#define LEAST_MUNK 2e-3
/* Linear yaw damping that is enough, over (1 - f) (a22 - a11) U L / 2, which is the most work that is done about a
   point half of the length away.  That ship grows with 0.1, also with cn of the other sign, and rests with 0.25. */
#define DAMPING_PART 0.25

/* At an angle of the water's motion [rad], of speed 1: Munk's moment, and which part of it the table has: 1 where there
   is no such moment. */
static double part_of_munk(const scenario *s, const vessel_model *hull, double angle, double *munk)
{
    const mat3 level = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    hydrodynamics alone = hull->hydrodynamics;
    const vec3 past = vec3_make(real_cos(angle), real_sin(angle), 0);
    alone.measured = false;
    *munk = hydrodynamics_munk(&alone, vec3_neg(past));
    double told = flow_load(&hull->flows.water, s->environment.water_density, level, past).moment.z;
    return *munk != 0 ? told / *munk : 1;
}

/* Whether a turret lets it turn, and no helm or thrusters hold its heading: a spread of lines has a stiffness against
   turning, and a ship without lines no point to swing about. */
static bool swings(const scenario_vessel *v)
{
    bool steered = vessel_drives_itself(v) || (v->positioning.active && v->thrusters.count > 0);
    return v->mooring.turret && v->mooring.lines.count > 0 && !steered;
}

/* The fastest that the water goes past it [m/s]. */
static double fastest_past(const scenario *s, const scenario_vessel *v, const model *m)
{
    return fmax(known_current(s, &m->history).fastest, vessel_fastest(v));
}

void munk_warnings(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, int32_t row)
{
    const vessel_model *hull = &m->vessels.data[row];
    const flow_table *table = &hull->flows.water;
    const scenario_vessel *v = entry->keys;
    double speed = fastest_past(s, v, m), turn = radians(JUDGED_AT), port, starboard;
    if (v->mode != VESSEL_FREE || !swings(v) || table->count == 0 || !hull->has_hydrodynamics || !(speed > 0))
        return;
    double part = fmin(part_of_munk(s, hull, PI - turn, &starboard), part_of_munk(s, hull, PI + turn, &port));
    double cn = starboard / (0.5 * s->environment.water_density * table->lateral * table->length);
    if (fabs(cn) < LEAST_MUNK * real_sin(2 * turn) || part >= LEAST_PART)
        return;
    double apart = fabs(starboard) / (real_sin(turn) * real_cos(turn));
    double enough = DAMPING_PART * (1 - part) * apart * speed * 0.5 * table->length;
    if (hull->hydrodynamics.damping.m[5][5] >= enough)
        return;
    log_write(
        ctx, LOG_WARNING,
        "%s.current_coefficients: near a current from ahead the moment is %.2g of Munk's, cn = %.3g at %g degrees, "
        "which a table has in it: the vessel may swing ever wider in a steady current; give cn of the bare hull, "
        "or hydrodynamics.source: given with a damping of %s N m s or more in yaw",
        entry->path, fabs(part) < 5e-3 ? 0 : part, cn, 180 - JUDGED_AT, least_text_of(enough, 3).text);
}

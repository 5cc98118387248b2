/* What a capability plot leaves out or does not know well, as warnings. */
#include "sim/capability.h"

#include "base/transcendental.h"
#include "sim/sanity.h"

#include <stdio.h>

/* Currents come across the hull here whatever the scenario's own one does. */
static void tell_sides(context *ctx, const scenario *s, const capability_options *o)
{
    double form = s->environment.hull_drag.water_form;
    if (sanity_drags_as_ahead(s, &s->vessel, o->speed_most))
        log_write(ctx, LOG_WARNING,
                  "environment.hull_drag.water_form: %.3g is of a hull that goes ahead, and in this plot currents come "
                  "from all sides: a ship's side has about 1; give that, or the vessel's current_coefficients",
                  form);
}

/* A current that goes with the drift takes the place of the scenario's: of what that has on top at a depth nothing is
   left, and nothing could be given in place of the file. */
static void tell_left_profile(context *ctx, const scenario *s)
{
    if (s->environment.current_profile_file[0] && s->environment.water)
        log_write(ctx, LOG_WARNING,
                  "environment.current_profile_file is left out: the current of a capability plot goes with the drift, "
                  "at its speed, from its side and at all depths alike");
}

void capability_tell_scenario(context *ctx, const scenario *s, const capability_options *o)
{
    tell_sides(ctx, s, o);
    tell_left_profile(ctx, s);
}

static double largest_turn(const capability *c)
{
    double turn = 0;
    for (int32_t i = 0; i < c->loads.directions; i++)
        turn = fmax(turn, fmax(c->intact[i].turn, c->damaged[i].turn));
    return turn;
}

/* A load that goes with the sine of the direction, and is linear between measured ones, is off by half of this product
   of its distances to them: told from what it is halfway between as many as are measured at most, 3.4 %. */
void capability_tell_turns(context *ctx, const capability *c)
{
    if (!c->loads.measured)
        return;
    double spacing = 2 * PI / c->loads.measured, turn = fmin(largest_turn(c), 0.5 * spacing);
    double halfway = PI / CAPABILITY_MEASURED;
    if (turn * (spacing - turn) < halfway * halfway * (1 - 1e-9))
        return;
    bool few = c->loads.measured < CAPABILITY_MEASURED;
    char remedy[64] = "judge such balances by runs";
    if (few)
        snprintf(remedy, sizeof remedy, "ask for %d directions or more", (int)CAPABILITY_MEASURED);
    log_write(
        ctx, LOG_WARNING,
        "the vessel is held turned by up to %.3g degrees, where its ice load lies between loads that are measured "
        "%.3g degrees apart: %s",
        degrees(largest_turn(c)), degrees(spacing), remedy);
}

/* A second half that is larger by this factor over all directions is no chance of single ones, and no small part of
   what a balance is judged by: of the allowance that mean loads have. */
#define GROWTH_MOST 1.25

bool capability_builds_up(const capability *c) { return c->loads.measured && c->loads.growth > GROWTH_MOST; }

/* How ice comes to press on a wide hull goes by the way that it has drifted, which is short at low speeds. */
void capability_tell_growth(context *ctx, const capability *c)
{
    const capability_loads *l = &c->loads;
    if (!capability_builds_up(c))
        return;
    char factors[96];
    int n = isfinite(l->growth) ? snprintf(factors, sizeof factors, "%.3g times as large", l->growth)
                                : snprintf(factors, sizeof factors, "there alone");
    if (isfinite(l->growth) && isfinite(l->growth_most))
        snprintf(factors + n, sizeof factors - (size_t)n, " (from %.0f deg %.3g times)", degrees(l->growth_from),
                 l->growth_most);
    log_write(ctx, LOG_WARNING,
              "measured ice loads were still building up, and limits are too high: at %.3g m/s, at which %.3g m of ice "
              "came in %.6g s, those of the second half of what counts are %s; measure twice as long (%.6g s), "
              "until both halves agree",
              l->growth_speed, l->growth_speed * c->options.measure, c->options.measure, factors,
              2 * c->options.measure);
}

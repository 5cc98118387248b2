/* Times of a run and of what it writes: those that leave nothing to see, and those that steps round; see sim/sanity.h.
 */
#include "sim/sanity_parts.h"

#include <stdio.h>

/* Parts of a run from which times leave no sense to its statistics, and pictures that nobody looks at. */
#define LONGEST_TRANSIENT 0.9
#define LONGEST_WINDOW 0.5
#define MOST_PICTURES 1e4
/* Rows of series.csv under which no curve is one. */
#define LEAST_ROWS 10
/* Three hours in steps of 0.1 ms, ten times as short as any scene of full size asks for. */
#define MOST_STEPS 1.08e8
/* Steps under which a window is one of another unit; a little shorter than a step is a step. */
#define SHORTEST_WINDOW 0.5
/* The default, which is longer than many a short run. */
#define USUAL_CHECKPOINT 60
/* A part of an interval by which whole steps may differ from it without a word. */
#define ROUNDED_OFF 0.01
/* Of whole steps that are told in seconds; as of times in series.csv. */
#define ROUNDING 1e-9

/* Every so many steps something is done.  Where one step was told to be longer than the interval, that says it all; a
   default is nobody's wish. */
static void tell_rounded(const teller *t, const char *key, double interval, int64_t steps, double least_steps)
{
    double dt = t->s->run.time_step;
    double made = (double)steps * dt;
    if (steps == 0 || interval < least_steps * dt || !scenario_given(t->s, key))
        return;
    if (fabs(made - interval) > ROUNDED_OFF * interval)
        sanity_say(t->tell, t->to, "%s: %.6g s is %.4g steps of run.time_step, %g s, and counts as %lld: %.6g s; %s",
                   key, interval, interval / dt, dt, (long long)steps, made,
                   interval - made > dt ? "no more are counted" : "give a multiple of it");
}

static void tell_rounded_interval(const teller *t, const char *key, double interval, double least_steps)
{
    tell_rounded(t, key, interval, scenario_interval_steps(interval, t->s->run.time_step), least_steps);
}

static void tell_all_rounded(const teller *t)
{
    const scenario_output *o = &t->s->output;
    tell_rounded_interval(t, "output.csv_interval", o->csv_interval, SHORTEST_WINDOW);
    tell_rounded_interval(t, "output.frame_interval", o->frame_interval, 1);
    tell_rounded_interval(t, "output.checkpoint_interval", o->checkpoint_interval, 1);
    tell_rounded_interval(t, "output.picture_interval", o->picture_interval, 0);
    tell_rounded(t, "output.averaging_window", o->averaging_window, scenario_averaging_steps(t->s), SHORTEST_WINDOW);
}

/* Of the run in series.csv: one after each whole interval. */
static void tell_few_rows(const teller *t)
{
    const scenario_run *r = &t->s->run;
    double interval = t->s->output.csv_interval;
    if (!(interval > 0))
        return;
    int64_t steps = scenario_step_at(r->duration, r->time_step),
            rows = steps / scenario_interval_steps(interval, r->time_step);
    char number[16] = "no";
    if (rows >= LEAST_ROWS || steps <= LEAST_ROWS)
        return;
    if (rows > 0)
        snprintf(number, sizeof number, "%d", (int)rows);
    sanity_say(t->tell, t->to, "output.csv_interval: %g s leaves %s row%s of the run in series.csv", interval, number,
               rows > 1 ? "s" : "");
}

/* When the first row after the transient comes [s]: rows come every so many steps from the start on. */
static double first_row_that_counts(const scenario *s)
{
    const int64_t given = scenario_interval_steps(s->output.csv_interval, s->run.time_step),
                  every = given > 0 ? given : 1;
    const double left_out = floor(s->run.transient / s->run.time_step * (1 + ROUNDING));
    return (floor(left_out / (double)every) + 1) * (double)every * s->run.time_step;
}

/* The averages that statistics are of, of loads that there may be. */
static bool averages_begin_early(const scenario *s)
{
    return s->ice.source != ICE_NONE && scenario_vessel_count(s) > 0 &&
           scenario_averages_begin_early(s, first_row_that_counts(s), s->run.duration - s->run.transient);
}

static void tell_times(const teller *t)
{
    const scenario_run *r = &t->s->run;
    const scenario_output *o = &t->s->output;
    if (r->transient > LONGEST_TRANSIENT * r->duration)
        sanity_say(t->tell, t->to,
                   "run.transient: statistics leave out %g s of %g s, so that next to nothing is left for them",
                   r->transient, r->duration);
    if (o->frame_interval > r->duration)
        sanity_say(t->tell, t->to,
                   "output.frame_interval: %g s is longer than the run, so that pages show nothing that moves",
                   o->frame_interval);
    if (r->duration / r->time_step > MOST_STEPS)
        sanity_say(t->tell, t->to, "run.time_step: %g s makes %.3g steps of the run: give seconds", r->time_step,
                   r->duration / r->time_step);
    if (o->frame_interval > 0 && o->frame_interval < r->time_step)
        sanity_say(t->tell, t->to,
                   "output.frame_interval: %g s is shorter than run.time_step, %g s: a frame every step",
                   o->frame_interval, r->time_step);
    if (o->checkpoint_interval > 0 && o->checkpoint_interval < r->time_step)
        sanity_say(t->tell, t->to,
                   "output.checkpoint_interval: %g s is shorter than run.time_step, %g s: a checkpoint every step",
                   o->checkpoint_interval, r->time_step);
    if (o->csv_interval > 0 && o->csv_interval < SHORTEST_WINDOW * r->time_step)
        sanity_say(t->tell, t->to,
                   "output.csv_interval: %g s is shorter than run.time_step, %g s: a row every step, as 0 says",
                   o->csv_interval, r->time_step);
    tell_few_rows(t);
    if (o->picture_interval > r->duration)
        sanity_say(t->tell, t->to, "output.picture_interval: %g s is longer than the run: no picture on the way",
                   o->picture_interval);
    if (o->checkpoint_interval > r->duration && o->checkpoint_interval > USUAL_CHECKPOINT)
        sanity_say(t->tell, t->to,
                   "output.checkpoint_interval: %g s is longer than the run: nothing to resume from if it is killed",
                   o->checkpoint_interval);
    if (o->averaging_window > 0 && o->averaging_window < SHORTEST_WINDOW * r->time_step)
        sanity_say(t->tell, t->to,
                   "output.averaging_window: %g s is less than run.time_step, %g s: averaged loads are those of a step",
                   o->averaging_window, r->time_step);
    if (averages_begin_early(t->s))
        sanity_say(
            t->tell, t->to,
            "output.averaging_window: %g s is longer than run.transient, %g s: statistics of averaged loads "
            "contain what was before it, and before the start no load; give a shorter one, or a longer transient",
            o->averaging_window, r->transient);
    else if (o->averaging_window > LONGEST_WINDOW * r->duration)
        sanity_say(t->tell, t->to, "output.averaging_window: %g s is more than half of the run", o->averaging_window);
    double pictures = r->duration / fmax(o->picture_interval, r->time_step); /* no more than steps */
    if (o->picture_interval > 0 && pictures > MOST_PICTURES)
        sanity_say(t->tell, t->to, "output.picture_interval: %.0f pictures will be written", pictures);
}

void sanity_tell_times(const scenario *s, sanity_teller tell, const void *to)
{
    const teller t = {s, tell, to, NULL, NULL, NULL, NULL};
    tell_times(&t);
    tell_all_rounded(&t);
}

/* The capability plot of a scenario's vessel in drifting ice: from which direction and up to which drift speed its
   thrusters and mooring hold it in a static balance, intact and after the worst single failure.  What is balanced, and
   what the ice load is, stands in docs/decisions/0022-capability.md.

   Directions are those of capability plots (IMCA M 140): where drift, current and wind together come from, clockwise
   from the bow. */
#ifndef SIM_CAPABILITY_H
#define SIM_CAPABILITY_H

#include "ice/managed_ice.h"
#include "io/path.h"
#include "model/scenario.h"
#include "model/world.h"
#include "vessel/holding.h"

enum { CAPABILITY_DIRECTIONS = 360, CAPABILITY_SPEEDS = 100 };
/* Ice loads are measured at this many directions at most, evenly over those that are asked for. */
enum { CAPABILITY_MEASURED = 12 };

/* Ice that was measured in runs, in place of the scenario's. */
typedef struct capability_met_ice {
    managed_law law;
    double windows;  /* in which it was measured */
    double sheet_as; /* size of floes that stand for unbroken ice [m]; NaN: none do */
    double side;     /* of the square of ice about the vessel [m]; NaN: CAPABILITY_LENGTHS times the hull's length */
    const char *const *runs; /* their folders */
    int32_t run_count;
} capability_met_ice;

/* The table of sizes of that ice, which a scenario can name as a histogram. */
#define CAPABILITY_FLOES "capability_floes.csv"
/* The side of the square of ice over the hull's length: a length of ice on every side of it. */
#define CAPABILITY_LENGTHS 3.0

typedef struct capability_options {
    const char *folder;
    bool force;
    bool formula;   /* the ice load is Zuev's, not measured */
    double measure; /* simulated seconds of each run that measures it */
    int32_t directions;
    double speed_step, speed_most;           /* [m/s] */
    double allowance;                        /* what mean loads are multiplied by */
    double line_safety, line_safety_damaged; /* breaking load over allowed tension: intact, after a failure */
    const char *vessel;                      /* its name, where the scenario has several; else NULL */
    const capability_met_ice *met;           /* NULL: the ice is the scenario's */
    const volatile int *stop;                /* non-zero: FRAM_INTERRUPTED, nothing written; may be NULL */
} capability_options;

/* A load in the ship's frame: surge, sway [N], yaw about the centre of mass [N m], by direction and speed.  A ship on
   lines turns, to headings between the directions that are asked for: loads stand in rows of their own, evenly round
   from the bow and as many whatever is asked, so that the load on a turned ship is too. */
typedef struct capability_loads {
    int32_t directions, speeds; /* that are asked for */
    int32_t rows;               /* of loads: a whole number of them from one direction that is asked for to the next */
    double speed_step;
    vec3 *wind, *damping, *drag; /* by row: all; times the speed; times its square */
    vec3 *ice;                   /* [row * speeds + k] at the speed (k + 1) speed_step; constant below the first */
    int32_t measured;            /* in so many directions, and linear between them; 0: not */
    double runs_done, runs;      /* that measure the ice load, for who waits */
    /* Of measured loads, at the speed where they grow most [m/s]: mean of the second half of what counts over that of
       the first, over all directions and from the one where it is most [rad]. */
    double growth, growth_speed, growth_most, growth_from;
} capability_loads;

/* What is lost in a failure. */
typedef struct capability_failure {
    bool line;
    int32_t number; /* from 0 */
} capability_failure;

typedef struct capability_limit {
    double speed;    /* up to which the vessel is held [m/s] */
    double turn;     /* the largest in drifts that are held, of those that were tried [rad] */
    bool beyond;     /* it is held at every speed that was tried */
    holding at;      /* just beyond it, or at the largest speed */
    int32_t failure; /* the worst one; -1: intact */
} capability_limit;

typedef struct capability {
    capability_options options;
    double wind_speed;               /* [m/s] */
    double thickness, concentration; /* of the ice, means over its area; 0 without ice */
    double side;                     /* of the window of ice that was met [m]; 0: the ice is the scenario's */
    capability_loads loads;
    capability_failure failure[VESSEL_LINES_MOST + VESSEL_THRUSTERS_MOST];
    int32_t failures;
    capability_limit *intact, *damaged; /* by direction; without anything that can fail damaged says nothing */
    holding *use;                       /* [direction * speeds + k], intact */
} capability;

/* Of the loads from direction i of those that are asked for. */
int32_t capability_row(const capability *c, int32_t i);
/* Steady load from a direction at a speed, with the allowance, in the ship's frame. */
vec3 capability_load_at(const capability *c, double from, double speed);

/* An ice load between those of a table, laid out as that of capability_loads: linear in both, constant beyond the least
   and the largest speed. */
vec3 capability_ice_between(const vec3 *load, int32_t directions, int32_t speeds, double speed_step, double from,
                            double speed);
/* Ice loads by direction and speed into c->loads.ice: by formula, or the mean of the highest third of the peaks in runs
   of the scenario's field past the hull held fast.  FRAM_ERROR_INPUT names the key that stands in the way; an error of
   a run begins with its direction and speed. */
fram_status capability_ice_formula(context *ctx, const scenario *s, const world *w, capability *c, fram_error *error);
fram_status capability_ice_measured(context *ctx, const scenario *s, capability *c, fram_error *error);
/* The scenario, of one vessel, with the ice that was met about it: an endless field of its sizes, concentration and
   thickness, in a square window of a side [m]; strengths, densities and friction are the scenario's.  It refers to
   `population`, `sizes` and s, and must not be freed.  FRAM_ERROR_USAGE for an override of a key that the ice gives. */
fram_status capability_met_scenario(const scenario *s, const capability_met_ice *met, double side,
                                    scenario_population *population, const size_law *sizes, scenario *out,
                                    fram_error *error);
/* Resistance of a ship of breadth b [m] in broken ice of thickness h [m] and concentration S at a speed [m/s] (Zuev's
   formula): rho_i g b h^2 (0.13 b/h + 1.3 F + 0.5 F^2) (2 - S) S^2, F = v / sqrt(g h) [N]. */
double broken_ice_resistance(double density, double gravity, double breadth, double thickness, double concentration,
                             double speed);

/* Warnings: of what a plot of the scenario does not take from it, or takes as it is for another purpose; and of turns
   to where measured ice loads are far apart. */
void capability_tell_scenario(context *ctx, const scenario *s, const capability_options *o);
void capability_tell_turns(context *ctx, const capability *c);
/* A warning where measured ice loads were still building up; whether they were. */
void capability_tell_growth(context *ctx, const capability *c);
bool capability_builds_up(const capability *c);
/* FRAM_INTERRUPTED when the options' stop flag is set. */
fram_status capability_go_on(const capability *c, fram_error *error);
/* All of it, before anything is written; to be freed. */
fram_status capability_find(context *ctx, const scenario *s, const capability_options *options, capability *c,
                            fram_error *error);
void capability_free(context *ctx, capability *c);

/* capability.csv, capability_use.csv, capability.json and, with cairo, capability.png and capability.svg in the folder
   of the options; `path` is the file to look at first: the picture, or the JSON file. */
fram_status capability_write(context *ctx, const scenario *s, const capability_options *options, char path[PATH_ROOM],
                             fram_error *error);

#endif

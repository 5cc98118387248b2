/* The plan of a moment of a run as shapes to draw, coloured by what the reader wants to see. */
#ifndef RESULTS_REPLAY_PLAN_H
#define RESULTS_REPLAY_PLAN_H

#include "io/plan_view.h"
#include "model/scenario.h"
#include "results/replay_moment.h"

typedef enum plan_colour {
    PLAN_COLOUR_PLAIN = 0,
    PLAN_COLOUR_SPEED,     /* m/s */
    PLAN_COLOUR_FORCE,     /* contact force [kN] */
    PLAN_COLOUR_THICKNESS, /* m */
    PLAN_COLOUR_AGE,       /* time since a floe broke off [s] */
    PLAN_COLOUR_COUNT
} plan_colour;
/* "speed", as on the command line. */
const char *plan_colour_name(plan_colour colour);
/* "speed [m/s]", for a legend; NULL for plain. */
const char *plan_colour_title(plan_colour colour);
/* What is shown of a body at a time, in the unit above; a NaN: nothing. */
double plan_colour_value(plan_colour colour, const replay_body *b, const replay_pose *p, double time);

typedef struct replay_plan {
    ARRAY(plan_shape) shapes; /* point into the moment */
    ARRAY(plan_arrow) arrows;
    ARRAY(plan_line) lines; /* of moorings, by replay_plan_lines */
    vec2_array marks;
    vec2 vessel; /* centre of the first vessel [m] */
    bool has_vessel;
} replay_plan;

/* lo, hi: what the ends of the colours stand for. arrow: length of an arrow [m/N], 0: none.  Marks: fractures of the
   last `mark_time` seconds. */
fram_status replay_plan_make(const replay *r, const replay_moment *m, plan_colour colour, double lo, double hi,
                             double arrow, double mark_time, replay_plan *out, fram_error *error);
/* Whether a picture of that window shows a mark. */
bool replay_plan_marks_in(const replay_plan *p, box2 window);
/* Mooring lines of the current frame: from where they pull towards their anchors, as far off as the scenario says; none
   where the record has no forces.  The run's time interpolates bodies, not forces: lines are those of the frame. */
fram_status replay_plan_lines(const replay *r, const scenario *s, replay_plan *out, fram_error *error);
void replay_plan_free(context *ctx, replay_plan *p);

#endif

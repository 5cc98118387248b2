/* Inside the results of ice management: a run as a list of moments, and what was found at each. One module with
   manage. */
#ifndef RESULTS_MANAGE_PARTS_H
#define RESULTS_MANAGE_PARTS_H

#include "results/manage.h"
#include "results/run_data.h"

/* Other vessels that are followed: those that keep no station. */
enum { MANAGE_HELPERS = 31 };

/* A frame of the record. */
typedef struct manage_moment {
    double time;
    vec2 place;    /* of the protected vessel's centre of mass [m] */
    vec2 ice;      /* way of the ice so far [m] */
    vec2 velocity; /* of the ice [m/s] */
    vec2 updrift;  /* unit: where the vessel's ice comes from; 0: from nowhere */
    double speed;  /* at which it comes [m/s] */
    double reach;  /* of the hull updrift of its centre [m] */
    double width;  /* of the corridor: of the hull across the drift [m] */
    double middle; /* of that, to port of updrift from its centre [m] */
    vec2 helper[MANAGE_HELPERS];
    /* Found in the second reading; those of the window that is at the vessel at this moment. */
    int32_t looked[MANAGE_PLACES]; /* moment at which it was at that place; -1: at none */
    manage_cover cover[MANAGE_PLACES];
    manage_threat threat;
} manage_moment;

typedef struct manage_run {
    context *ctx;
    run_data d;
    int32_t vessel, helpers;
    double helper_reach[MANAGE_HELPERS]; /* half the length of each, 0: not seen yet [m] */
    double limit, depth, unit;
    ARRAY(manage_moment) moments;
    ARRAY(managed_cover) met; /* of each moment, where asked for: the ice at the place that manage_came_from tells */
} manage_run;

/* Reads the run twice and fills in all of it; on an error nothing is left. */
fram_status manage_read(context *ctx, const char *folder, const manage_options *options, manage_run *m,
                        fram_error *error);
void manage_free(manage_run *m);
/* Where the ice of a moment's window is taken as that which came: the last place at which it was seen before the hull
   was upon it; -1: it was seen nowhere. */
int manage_came_from(const manage_moment *at);
/* Of a vessel's mooring, as its keys have it. */
int32_t manage_line_count(const scenario_vessel *keys);
/* Seconds until unmanaged ice comes: the nearest, or the largest of it. */
double manage_alarm(const manage_moment *at, bool largest);
fram_status manage_sum_up(const manage_run *m, manage_summary *out, fram_error *error);
/* The page, on which `other` (NULL: none) stands beside. */
fram_status manage_page(const manage_run *m, const manage_summary *s, const manage_run *other,
                        const manage_summary *other_summary, fram_error *error);

#endif

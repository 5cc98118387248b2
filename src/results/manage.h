/* Results of ice management: what lay in the corridor of a protected vessel upstream, behind the icebreakers and at the
   vessel, in windows that drift along with the ice; how long it takes unmanaged ice to come; loads with and without. */
#ifndef RESULTS_MANAGE_H
#define RESULTS_MANAGE_H

#include "io/path.h"
#include "io/text_buffer.h"
#include "results/manage_ice.h"

/* Where a window of ice is looked at on its way to the vessel. */
typedef enum manage_place {
    MANAGE_UPSTREAM = 0, /* before an icebreaker came near it; without one, as early as it is in the domain */
    MANAGE_BEHIND,       /* after the last icebreaker has left it */
    MANAGE_AT,           /* before the vessel */
    MANAGE_PLACES
} manage_place;

typedef struct manage_options {
    const char *vessel; /* name of the protected one; NULL: the only one that does not drive itself */
    const char *beside; /* another run's folder, the same without management say; NULL: none */
    const char *output; /* the page; NULL: FOLDER/manage.html; tables go beside it */
    double limit;       /* largest size of a floe that counts as managed [m]; a NaN: the vessel's beam */
    double depth;       /* of the windows along the drift [m]; a NaN: as much as the corridor is wide */
    double unit;        /* a metre of full size in the run, by which sizes are classed [m]; 0: by its run.scale */
    bool met;           /* keep what manage_met_ice sums up */
    bool compared;      /* the run is the one beside: its only vessel need not have that name where it has none */
} manage_options;

typedef struct manage_summary {
    char page[PATH_ROOM], moments[PATH_ROOM], sizes[PATH_ROOM]; /* what was written: page and tables; "": none */
    double limit;                                               /* [m] */
    struct {
        double windows;                             /* looked at after the transient */
        double concentration, managed, sheet, mean; /* means; the middle two over the ice; mean size by area [m] */
        double largest;                             /* of all windows [m] */
        double share[MANAGE_CLASSES + 1];           /* of the ice, by size */
    } place[MANAGE_PLACES];
    double largest_time;                  /* when that came to the vessel [s] */
    double first_time;                    /* of the first window at the vessel with ice in it [s]; NaN: none had */
    double empty;                         /* windows at the vessel before it, after the transient */
    double alarm_least, alarm_median;     /* until unmanaged ice comes [s]; infinity: none in sight */
    double warning_least, warning_median; /* until the largest of it comes [s] */
    double load_mean, load_most;          /* averaged horizontal ice load on the vessel [N] */
    double offset_most, tension_most;     /* [m], [N] */
    /* Of the line with the largest: the range of tension that does the damage of all its rainflow cycles with one cycle
       a second and the slope FATIGUE_CHAIN_SLOPE [N]; the line's number, 0: none. */
    double tension_range;
    int32_t tension_line;
} manage_summary;

/* What is told on a terminal, or one JSON object in SI units; numbers that there are not are null. */
fram_status manage_text(context *ctx, const manage_summary *s, const manage_summary *beside, bool json,
                        text_buffer *out, fram_error *error);
/* Adds the ice that came to the vessel of a run in each window after the transient, as it was before the hull touched
   it: right behind the icebreakers where they broke it, else as far upstream as it was seen, else before the hull.
   name: as manage_options.  unit: a metre of full size, at the scale of who asks [m]; the same for all runs of a sum,
   whose bins of size are of full size. */
fram_status manage_met_ice(context *ctx, const char *folder, const char *name, double unit, managed_ice *sum,
                           fram_error *error);
/* managed_law_of such a sum, with all lengths as they are at that scale. */
fram_status manage_met_law(const managed_ice *sum, double unit, double sheet_as, managed_law *out, fram_error *error);
/* The page, its two tables (PAGE less its ending, .csv and -sizes.csv; none, with a warning, beside a page that goes
   into a stream) and the numbers; beside: those of the other run, may be NULL.  FRAM_ERROR_INPUT for a folder without a
   run or a record, and for a vessel that is not there or not to be told from others; FRAM_ERROR_USAGE for a page whose
   tables would be written over what a run is made of. */
fram_status manage_write(context *ctx, const char *folder, const manage_options *options, manage_summary *summary,
                         manage_summary *beside, fram_error *error);

#endif

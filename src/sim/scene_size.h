/* How large a scenario is before anything of it is built: floes, memory and disk, from its keys alone. One module with
   build, which asks before it makes anything. */
#ifndef SIM_SCENE_SIZE_H
#define SIM_SCENE_SIZE_H

#include "model/scenario_vessel.h"

/* Bytes of a run's folder in the end, by what takes them: all within a factor of two in the runs that were measured,
   but more where ice breaks, since pieces come to the floes. */
typedef struct scene_disk {
    double rows;        /* series.csv and the texts beside it, what a study keeps with `series` */
    double frames;      /* the record, thinned out as output.record_limit says */
    double checkpoints; /* those that stay */
    double pictures;    /* from above, and the chart of the loads */
    double all;
} scene_disk;
/* Of a run of so many floes. */
scene_disk scene_disk_of(const scenario *s, double floes);

typedef struct scene_size {
    double floes; /* at the start, about; those of ice.file and of histograms are not counted */
    double bytes; /* that a run takes, about: at least half of it in the fields that were measured, at most all */
    double disk;  /* bytes of the run's folder in the end (scene_disk) */
    const char *uncounted; /* floes beside those, "the floes of its file"; NULL: none */
} scene_size;
scene_size scene_size_of(const scenario *s);
/* The same of a scenario whose ice was made, with so many floes: none are uncounted. */
scene_size scene_size_made(const scenario *s, int32_t floes);

/* FRAM_ERROR_INPUT, naming the key that makes it so large, when the scenario takes more than run.memory_limit, or has
   more floes than can be numbered; or for tiles of level ice that are smaller than the smallest floe. */
fram_status scene_size_check(const scenario *s, fram_error *error);

#endif

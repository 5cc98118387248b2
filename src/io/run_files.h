/* The files of a run's folder by their names, and what is done with each: one table for all that ask.  Those that there
   are for each vessel, time or number have no row: sim/run_folder.c knows them by how they are named. */
#ifndef IO_RUN_FILES_H
#define IO_RUN_FILES_H

#include <stdbool.h>
#include <stdint.h>

/* What a new run in the folder does with one of the run before. */
typedef enum run_file_end {
    RUN_FILE_STAYS = 0,  /* until it is written over */
    RUN_FILE_GOES_FIRST, /* it says how that run ended */
    RUN_FILE_GOES,
    RUN_FILE_GOES_LAST /* it grows with a run, and by it the folder of one is known */
} run_file_end;

typedef struct run_file {
    const char *name;
    bool source;    /* results are made of it, and none is written over it */
    bool written;   /* by a run, whatever is there, however it ends */
    bool in_one_go; /* so written: of a run that was killed its temporary file (io/temporary.h) may be left */
    run_file_end end;
} run_file;

/* The rows one after the other; NULL: no more. */
const run_file *run_file_at(int32_t row);
/* The row of a name; NULL: none. */
const run_file *run_file_find(const char *name);

#endif

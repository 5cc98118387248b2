/* run.json: what run a folder holds, and how it went.  Its text is written and read here alone.  Knows numbers, names
   and JSON; must not know a world, nor how a run is judged. */
#ifndef IO_RUN_NOTE_H
#define IO_RUN_NOTE_H

#include "base/hash.h"
#include "io/text_buffer.h"
#include "model/scenario.h"
#include "model/scenario_vessel.h"

/* Bytes that a run.json has at most. */
enum { RUN_NOTE_MOST = 1 << 26 };
/* Files, events and tracks that one tells at most: more than any scenario has files and vessels, and a run notes
   events. */
enum { RUN_NOTE_ITEMS_MOST = 10000 };

/* A file that the scenario names. */
typedef struct run_note_file {
    char digest[SHA256_TEXT_SIZE], path[SCENARIO_TEXT_SIZE + 1];
} run_note_file;

/* What befell a vessel. */
typedef struct run_event {
    double time, value; /* [s], what the kind says (vessel/event.h) */
    double ahead;       /* until what is predicted comes [s] */
    char vessel[VESSEL_NAME_MOST + 1], other[VESSEL_NAME_MOST + 1], kind[24], text[160]; /* names: "" without */
} run_event;

/* How a ship that drives itself kept its track. */
typedef struct run_track {
    char vessel[VESSEL_NAME_MOST + 1];
    double limit, largest, rms; /* track error: beyond which it is off, most, and in the mean [m] */
    double time, rounds;        /* that counts, 0: it never came to its track [s]; of its pattern */
} run_track;

/* Texts are "" where they are not told. */
typedef struct run_note {
    char version[32], compiler[160], libraries[256], isa[16], status[16];
    char message[800]; /* of a failure: the file that it is about, and what is wrong */
    char title[SCENARIO_TEXT_SIZE], scenario_hash[SHA256_TEXT_SIZE], state_hash[17];
    double threads, seed, events_left_out;
    double steps, time;                                    /* NaN: not told */
    double wall, recording, recording_end;                 /* of the last call, see sim/run_summary.h [s] */
    double recorded_from;                                  /* when its recording began [s]; -1: not told */
    double good_until;                                     /* with a message: the end of the last good step [s] */
    double step_median, step_p99, step_p999, step_longest; /* wall time [ms]; NaN: not told */
    ARRAY(run_note_file) files;
    ARRAY(run_event) events;
    ARRAY(run_track) tracks;
    text_buffer told; /* names of what a program told the world in place of the scenario, a line each */
} run_note;

/* Nothing is told. */
void run_note_init(run_note *n);
void run_note_free(context *ctx, run_note *n);

/* FOLDER/run.json, in one go. */
fram_status run_note_write(context *ctx, const char *folder, const run_note *n, fram_error *error);
/* What the file tells of this, of any version; FRAM_ERROR_INPUT where it is not there or is none.  n is to be freed
   after an error too. */
fram_status run_note_read(context *ctx, const char *folder, run_note *n, fram_error *error);
/* FRAM_ERROR_INPUT for a note that lacks what every run tells, or tells what none can have. */
fram_status run_note_check(const run_note *n, const char *folder, fram_error *error);

bool run_note_is_there(const char *folder);
/* The text as it stands, to be freed, for run_note_mentions. */
fram_status run_note_load(context *ctx, const char *folder, char **text, fram_error *error);
/* Whether it tells a digest, of the scenario or of a file that this names; a text of no JSON may do so too. */
bool run_note_mentions(const char *text, const char *digest);

#endif

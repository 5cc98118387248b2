/* What ends a run and is no answer of its scenario: a disk that is full, a program that does not start. */
#ifndef STUDY_NO_ANSWER_H
#define STUDY_NO_ANSWER_H

#include "base/context.h"
#include "study/processes.h"

/* A run that did not end well. */
typedef struct ended_run {
    const char *folder, *log;
    const char *program, *node; /* that made it, and where; node NULL or "": here */
    int exit_code;
} ended_run;
/* FRAM_ERROR_INPUT when the program did not start, for want of it or of what it needs; FRAM_ERROR_IO when the log or
   the run.json says that the disk failed. */
fram_status study_run_check_answer(context *ctx, const ended_run *run, fram_error *error);
/* What the system said of a program that did not start, by its log. */
enum { NO_START_REASON = 300 };
void study_run_why_not_started(context *ctx, const char *log, char out[NO_START_REASON]);

#endif

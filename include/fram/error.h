/* Status codes and the error record: the one vocabulary that every room of Fram, the public API and
   the command share.  Knows nothing else; see docs/decisions/0001-error-vocabulary.md. */
#ifndef FRAM_ERROR_H
#define FRAM_ERROR_H

#ifdef __cplusplus
extern "C" {
#endif

/* What a call that can fail returns.  Details stand in the caller's fram_error. */
typedef enum fram_status {
    FRAM_OK = 0,
    FRAM_ERROR_USAGE = 1,       /* the call or the command line is wrong: argument, option, order of calls */
    FRAM_ERROR_INPUT = 2,       /* a file or a value that the user gave is wrong */
    FRAM_ERROR_IO = 3,          /* the operating system refused to read or write */
    FRAM_ERROR_MEMORY = 4,      /* an allocation failed */
    FRAM_ERROR_SIMULATION = 5,  /* the run went wrong: non-finite state, runaway energy */
    FRAM_ERROR_UNSUPPORTED = 6, /* this build lacks an optional part */
    FRAM_ERROR_INTERNAL = 7,    /* a defect in Fram itself */
    FRAM_INTERRUPTED = 8        /* the caller's stop flag was seen; a run has written a checkpoint */
} fram_status;

/* Where and why a call failed.  Owned by the caller; filled only when a status other than FRAM_OK is
   returned.  Texts are cut to their size, never unterminated.  line and column count from 1, 0 when
   there is no place. */
typedef struct fram_error {
    fram_status status;
    int line;
    int column;
    char file[256];    /* the file that holds the mistake, or empty */
    char key[128];     /* scenario key ("ice.thickness"), mesh element ("triangle 17"), option ("--until") */
    char message[512]; /* what is wrong, what was expected, what was found, what to do */
} fram_error;

#ifdef __cplusplus
}
#endif
#endif

/* A scenario as a co-simulation unit of FMI 2.0 or 3.0: model description, the binary that steps it, the scenario and
   its files in one archive.  The binary is bindings/fmi, made elsewhere; here it is only packed. */
#ifndef SIM_FMU_H
#define SIM_FMU_H

#include "model/scenario.h"

typedef struct fmu_options {
    const char *output;         /* NAME.fmu */
    const char *binary;         /* bindings/fmi as a shared library */
    const char *const *inputs;  /* names, * and ? stand for any; none: all inputs */
    const char *const *outputs; /* none: all channels but time and the step's wall time */
    int input_count, output_count;
    int version;                                 /* of the standard: 2 or 3 */
    const char *(*meaning)(const char *channel); /* a few words, or "" */
} fmu_options;

typedef struct fmu_report {
    int32_t inputs, outputs, files;
} fmu_report;

/* FRAM_ERROR_USAGE, with "input" or "output" as key, for a name that the scenario does not have. */
fram_status fmu_write(context *ctx, const scenario *s, const fmu_options *options, fmu_report *report,
                      fram_error *error);

#endif

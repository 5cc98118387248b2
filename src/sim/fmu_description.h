/* modelDescription.xml of a co-simulation unit (FMI 2.0, section 4.3 and chapter 2.2 of the standard). */
#ifndef SIM_FMU_DESCRIPTION_H
#define SIM_FMU_DESCRIPTION_H

#include "io/text_buffer.h"
#include "model/scenario.h"

typedef struct fmu_variable {
    bool is_input;
    const char *name, *unit, *meaning;
    double start; /* of an input */
} fmu_variable;
typedef ARRAY(fmu_variable) fmu_variable_array;

typedef struct fmu_names {
    char identifier[80]; /* of the model: letters, digits and _ */
    char guid[48];
} fmu_names;

/* Appended to out; value references are the numbers of the variables. */
void fmu_describe(context *ctx, const scenario *s, const fmu_names *names, const fmu_variable_array *variables,
                  text_buffer *out);

#endif

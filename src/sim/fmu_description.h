/* modelDescription.xml of a co-simulation unit (FMI 2.0, section 4.3 and chapter 2.2 of the standard; FMI 3.0.2,
   sections 2.4 and 4.4). */
#ifndef SIM_FMU_DESCRIPTION_H
#define SIM_FMU_DESCRIPTION_H

#include "io/text_buffer.h"
#include "model/scenario.h"

typedef enum fmu_kind { FMU_INPUT, FMU_OUTPUT, FMU_TIME } fmu_kind; /* FMU_TIME: the independent variable of 3.0 */
typedef struct fmu_variable {
    fmu_kind kind;
    bool is_discrete; /* of an input: it is a switch, nothing between its values has a meaning */
    const char *name, *unit, *meaning;
    double start; /* of an input */
} fmu_variable;
typedef ARRAY(fmu_variable) fmu_variable_array;

typedef struct fmu_names {
    char identifier[80]; /* of the model: letters, digits and _ */
    char guid[48];
    int version; /* of the standard: 2 or 3 */
} fmu_names;

/* Appended to out; value references are the numbers of the variables. */
void fmu_describe(context *ctx, const scenario *s, const fmu_names *names, const fmu_variable_array *variables,
                  text_buffer *out);

#endif

/* What a co-simulation unit tells people, in its folder `documentation`: a page about the unit, which shared libraries
   it needs, and its licence. */
#ifndef SIM_FMU_DOCUMENTATION_H
#define SIM_FMU_DOCUMENTATION_H

#include "sim/fmu_description.h"

/* index.html: what the unit is, how it is stepped, and its variables. */
fram_status fmu_page(context *ctx, const scenario *s, const fmu_names *names, const fmu_variable_array *variables,
                     text_buffer *out, fram_error *error);
/* externalDependencies.txt, which the standard wants of a unit that needs shared libraries. */
void fmu_dependencies(context *ctx, const fmu_names *names, text_buffer *out);
/* licenses/license.txt: of the binary. */
extern const char fmu_licence[];

#endif

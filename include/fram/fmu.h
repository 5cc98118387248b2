/* Fram: scenarios as co-simulation units of FMI 2.0 or 3.0, for programs that import such (docs/fmu.md). */
#ifndef FRAM_FMU_H
#define FRAM_FMU_H

#include "fram/fram.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct fram_fmu_definition {
    size_t size;        /* of this struct, set by fram_fmu_default */
    const char *output; /* NAME.fmu; NAME, letters, digits and _, is the model's */
    const char *binary; /* fram_fmu.so, which the unit carries */
    /* Names of inputs (fram_world_input) and channels that the unit has; * and ? stand for any characters.  NULL with
       0: all inputs; all channels but time and step_wall_time.  In 3.0 `time` is the independent variable of every
       unit, and no output. */
    const char *const *inputs, *const *outputs;
    int input_count, output_count;
    int version; /* of FMI: 2 (by default) for 2.0, 3 for 3.0 */
} fram_fmu_definition;

typedef struct fram_fmu_result {
    int inputs, outputs; /* variables of the unit */
    int files;           /* of the scenario that it carries */
} fram_fmu_result;

FRAM_API void fram_fmu_default(fram_fmu_definition *definition, size_t size);
#define fram_fmu_default(definition) fram_fmu_default((definition), sizeof *(definition))
/* Write the unit; the world is made once for that.  FRAM_ERROR_USAGE, with the key "inputs" or "outputs", for a name
   that the scenario does not have.  result may be NULL. */
FRAM_API fram_status fram_fmu(const fram_scenario *scenario, const fram_fmu_definition *definition,
                              fram_fmu_result *result, fram_error *error, size_t size);
#define fram_fmu(...) fram_fmu(__VA_ARGS__, sizeof(fram_fmu_result))

#ifdef __cplusplus
}
#endif
#endif

/* The vessels of a scenario, one after the other, whichever way the file gives them. */
#ifndef MODEL_SCENARIO_VESSEL_H
#define MODEL_SCENARIO_VESSEL_H

#include "model/scenario.h"

/* One of them: what is said of it, and where. */
typedef struct vessel_entry {
    const scenario_vessel *keys;
    char path[24]; /* of its section: "vessel" */
} vessel_entry;

int32_t scenario_vessel_count(const scenario *s);
/* index: 0 to the count - 1, also the vessel's row in a world. */
vessel_entry scenario_vessel_entry(const scenario *s, int32_t index);

/* FRAM_ERROR_INPUT for a key of a vessel ("mode", "hull.file"; "" for the vessel itself), with its place. */
fram_status vessel_fault(const scenario *s, const vessel_entry *entry, const char *member, fram_error *error,
                         const char *format, ...) __attribute__((format(printf, 5, 6)));
/* The key of an error, that of a member, becomes the vessel's key, and its place is found. */
void vessel_name_error(const scenario *s, const vessel_entry *entry, fram_error *error);

#endif

/* The vessels of a scenario, one after the other, whichever way the file gives them. */
#ifndef MODEL_SCENARIO_VESSEL_H
#define MODEL_SCENARIO_VESSEL_H

#include "model/scenario.h"

/* Characters of a vessel's name. */
enum { VESSEL_NAME_MOST = 24 };

/* One of them: what is said of it, and where. */
typedef struct vessel_entry {
    const scenario_vessel *keys;
    char path[24]; /* of its section: "vessel", or "vessels[3]" */
} vessel_entry;

/* Whether it has propulsion of its own. */
static inline bool vessel_drives_itself(const scenario_vessel *v) { return !is_automatic(v->propulsion.bollard_pull); }
/* Whether lines, positioning or a carriage at rest hold it where it is: ice goes past it, it goes through none. */
static inline bool vessel_is_held(const scenario_vessel *v)
{
    if (v->mode == VESSEL_FREE)
        return v->mooring.lines.count > 0 || v->positioning.active;
    return !(v->speed > 0) && v->path.count == 0;
}
/* Whether positioning leads it along way points to a last one outside of the domain: it leaves the ice on purpose. */
bool scenario_vessel_leaves(const scenario *s, const scenario_vessel *v);
/* Of those that are present. */
int32_t scenario_vessel_count(const scenario *s);
/* index: 0 to the count - 1, also the vessel's row in a world. */
vessel_entry scenario_vessel_entry(const scenario *s, int32_t index);
/* An item of the list, present or not. */
vessel_entry scenario_vessel_item(const scenario *s, int32_t item);
/* Row of the vessel of this name; -1 without one. */
int32_t scenario_find_vessel(const scenario *s, const char *name);
/* Row of the vessel that a person names, the first where name is NULL: FRAM_ERROR_INPUT with the names that there are,
   and with place, a file or folder, for one that is not there. */
fram_status scenario_choose_vessel(const scenario *s, const char *place, const char *name, int32_t *index,
                                   fram_error *error);
/* The scenario with one of its vessels alone, in the short form; what is said of that names its place in s.  It refers
   to what s owns, and must not be freed. */
scenario scenario_of_vessel(const scenario *s, int32_t index);
/* Whether channels and results are called by vessels' names: those of a list are, a single `vessel` is not. */
bool scenario_names_vessels(const scenario *s);
/* Name of a vessel by its row; NULL where vessels have none, and for a row that is not there. */
const char *scenario_vessel_name(const scenario *s, int32_t index);
/* How a text speaks of a vessel: "the vessel", or "vessel NAME". */
typedef struct vessel_title {
    char text[VESSEL_NAME_MOST + 12];
} vessel_title;
vessel_title vessel_title_of(const vessel_entry *entry);
/* Name of a channel of a vessel: "ice_force_x", in a list "NAME.ice_force_x". */
typedef struct vessel_channel {
    char text[VESSEL_NAME_MOST + 48];
} vessel_channel;
vessel_channel vessel_channel_name(const scenario *s, int32_t index, const char *channel);
/* Name of a file of a vessel in a run's folder: "loads.png", in a list "loads-NAME.png". */
typedef struct vessel_file {
    char text[VESSEL_NAME_MOST + 40];
} vessel_file;
vessel_file vessel_file_name(const scenario *s, int32_t index, const char *stem, const char *ending);

/* Whether it begins where its mooring holds it, and not where the scenario puts it: that is found as its world is made.
 */
bool vessel_begins_at_equilibrium(const scenario_vessel *v);

/* Mooring lines that the scenario lets go by this time. */
int32_t scenario_released_lines(const scenario_vessel *v, double time);

/* FRAM_ERROR_INPUT for a key of a vessel ("mode", "hull.file"; "" for the vessel itself), with its place. */
fram_status vessel_fault(const scenario *s, const vessel_entry *entry, const char *member, fram_error *error,
                         const char *format, ...) __attribute__((format(printf, 5, 6)));
/* The key of an error, that of a member, becomes the vessel's key, and its place is found. */
void vessel_name_error(const scenario *s, const vessel_entry *entry, fram_error *error);

#endif

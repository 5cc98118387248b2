/* Scenario keys by their paths, as a study names them, and their units. */
#ifndef STUDY_KEY_NAMES_H
#define STUDY_KEY_NAMES_H

#include "model/scenario_schema.h"

/* The key of a path as "vessels[1].hull.length" or "vessels.tanker.hull.length"; NULL when there is none. */
const scenario_key *key_of_path(const char *path);
/* Whether there are keys in it: a section or a list; false for none. */
bool key_has_keys(const scenario_key *key);
/* Its unit; "" of pure numbers, of words, and where there is no such key. */
const char *key_unit(const char *path);
/* "vessel.speed [m/s]", or the path alone where it has no unit. */
enum { KEY_TEXT_SIZE = 128 };
void key_with_unit(const char *path, char out[KEY_TEXT_SIZE]);

#endif

#include "study/key_names.h"

#include <stdio.h>
#include <string.h>

const scenario_key *key_of_path(const char *path)
{
    const scenario_section *section = &scenario_schema;
    const scenario_key *key = NULL;
    bool chosen = true; /* of a list an element, by its number or its name */
    while (*path) {
        char name[64];
        size_t length = strcspn(path, ".[");
        if (!section || length >= sizeof name)
            return NULL;
        memcpy(name, path, length);
        name[length] = '\0';
        int32_t found = section_find(section, name);
        if (found < 0 && chosen)
            return NULL;
        if (found >= 0) {
            key = &section->keys[found];
            section = key->section;
        }
        path += length;
        chosen = found < 0 || key->kind != KEY_LIST || *path == '[';
        path += *path == '[' ? strcspn(path, ".") : 0;
        path += *path == '.';
    }
    return key;
}

bool key_has_keys(const scenario_key *key) { return key && (key->kind == KEY_SECTION || key->kind == KEY_LIST); }

const char *key_unit(const char *path)
{
    const scenario_key *key = key_of_path(path);
    return key && strcmp(key->unit, "1") != 0 ? key->unit : "";
}

void key_with_unit(const char *path, char out[KEY_TEXT_SIZE])
{
    const char *unit = key_unit(path);
    snprintf(out, KEY_TEXT_SIZE, "%s%s%s%s", path, *unit ? " [" : "", unit, *unit ? "]" : "");
}

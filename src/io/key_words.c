#include "io/key_words.h"

#include "base/name_search.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* Word and key, by the word; of several keys for one word in the order in which they are tried. */
static const char *const other_words[][2] = {
    {"anchor_distance", "distance"},
    {"anchor_radius", "distance"},
    {"anchors", "lines"},
    {"angle", "direction_deg"},
    {"azimuth", "direction_deg"},
    {"azimuths", "thrusters"},
    {"B", "beam"},
    {"bending_strength", "flexural_strength"},
    {"bollard", "bollard_pull"},
    {"boundaries", "boundary"},
    {"bow_angle", "stem_angle_deg"},
    {"breadth", "beam"},
    {"Cb", "block_coefficient"},
    {"cb", "block_coefficient"},
    {"center_of_gravity_x", "centre_of_gravity_x"},
    {"center_of_gravity_y", "centre_of_gravity_y"},
    {"center_of_gravity_z", "centre_of_gravity_z"},
    {"cog_x", "centre_of_gravity_x"},
    {"cog_y", "centre_of_gravity_y"},
    {"cog_z", "centre_of_gravity_z"},
    {"compressive_strength", "crushing_strength"},
    {"course", "course_deg"},
    {"coverage", "concentration"},
    {"current", "current_speed"},
    {"current_angle", "current_direction_deg"},
    {"current_dir", "current_direction_deg"},
    {"current_direction", "current_direction_deg"},
    {"current_velocity", "current_speed"},
    {"diameter", "mean_floe_area"},
    {"direction", "direction_deg"},
    {"displacement", "mass"},
    {"dp", "positioning"},
    {"draft", "draught"},
    {"drift", "drift_speed"},
    {"drift_angle", "drift_direction_deg"},
    {"drift_dir", "drift_direction_deg"},
    {"drift_direction", "drift_direction_deg"},
    {"drift_velocity", "drift_speed"},
    {"dt", "time_step"},
    {"E", "elastic_modulus"},
    {"EA", "stiffness"},
    {"end_time", "duration"},
    {"flare_angle", "flare_angle_deg"},
    {"floe_area", "mean_floe_area"},
    {"floe_diameter", "mean_floe_area"},
    {"floe_size", "mean_floe_area"},
    {"fracture_toughness", "toughness"},
    {"friction_coefficient", "ice_hull_kinetic"},
    {"h", "thickness"},
    {"heading", "heading_deg"},
    {"hull_type", "form"},
    {"ice_concentration", "concentration"},
    {"ice_thickness", "thickness"},
    {"KG", "centre_of_gravity_z"},
    {"kg", "centre_of_gravity_z"},
    {"kxx", "gyration_roll"},
    {"kyy", "gyration_pitch"},
    {"kzz", "gyration_yaw"},
    {"L", "length"},
    {"lcg", "centre_of_gravity_x"},
    {"LOA", "length"},
    {"Loa", "length"},
    {"loa", "length"},
    {"LPP", "length"},
    {"Lpp", "length"},
    {"lpp", "length"},
    {"LWL", "length"},
    {"Lwl", "length"},
    {"lwl", "length"},
    {"max_thrust", "thrust"},
    {"MBL", "breaking_load"},
    {"mbl", "breaking_load"},
    {"mu", "ice_hull_kinetic"},
    {"n", "count"},
    {"nu", "poisson_ratio"},
    {"number", "count"},
    {"number_of_lines", "count"},
    {"poisson", "poisson_ratio"},
    {"pre_tension", "pretension"},
    {"propellers", "thrusters"},
    {"radius", "distance"},
    {"random_seed", "seed"},
    {"rho_ice", "density"},
    {"rho_water", "water_density"},
    {"roll_radius", "gyration_roll"},
    {"sigma_c", "crushing_strength"},
    {"sigma_f", "flexural_strength"},
    {"simulation_time", "duration"},
    {"spacing", "spacing_deg"},
    {"speed", "speed"}, /* of a vessel, but for these two sections */
    {"speed", "current_speed"},
    {"speed", "drift_speed"},
    {"stem_angle", "stem_angle_deg"},
    {"step", "time_step"},
    {"strength", "flexural_strength"},
    {"submerged_weight", "weight"},
    {"T", "draught"},
    {"t_end", "duration"},
    {"tension", "pretension"},
    {"time", "duration"},
    {"timestep", "time_step"},
    {"type", "form"},
    {"type", "kind"},
    {"type", "source"},
    {"type", "mode"},
    {"vcg", "centre_of_gravity_z"},
    {"velocity", "speed"},
    {"water_depth", "depth"},
    {"water_line_length", "length"},
    {"waterline_angle", "entrance_angle_deg"},
    {"weathervaning", "heading"},
    {"weight", "mass"},
    {"width", "beam"},
    {"wind", "wind_speed"},
    {"wind_angle", "wind_direction_deg"},
    {"wind_dir", "wind_direction_deg"},
    {"wind_direction", "wind_direction_deg"},
    {"wind_velocity", "wind_speed"},
    {"yaw", "heading_deg"},
    {"young_modulus", "elastic_modulus"},
    {"youngs_modulus", "elastic_modulus"},
};

/* Words for what there is not.  section: that the words are of; "": any. */
static const char *const lacking[][2] = {
    {"", "hawser"},    {"", "hawsers"},           {"", "tow"},         {"", "tow_line"},
    {"", "tow_lines"}, {"", "tow_rope"},          {"", "tow_wire"},    {"", "towed_by"},
    {"", "towing"},    {"", "towing_line"},       {"", "towline"},     {"", "tows"},
    {"lines", "body"}, {"lines", "connected_to"}, {"lines", "other"},  {"lines", "ship"},
    {"lines", "to"},   {"lines", "to_vessel"},    {"lines", "vessel"},
};

const char *key_lacks(const char *path, const char *name)
{
    for (size_t i = 0; i < sizeof lacking / sizeof *lacking; i++)
        if (strcmp(name, lacking[i][1]) == 0 && (!lacking[i][0][0] || strstr(path, lacking[i][0])))
            return "no line ties two vessels: lines end at fixed anchors, and a vessel in tow (mode: towed) goes as "
                   "its speed or path says, whatever tows it";
    return NULL;
}

/* A word may stand for several keys, of which nth counts from 0.  NULL past the last, and for a word that is not known.
 */
static const char *key_other_name(const char *word, int32_t nth)
{
    for (size_t i = 0; i < sizeof other_words / sizeof *other_words; i++)
        if (strcmp(word, other_words[i][0]) == 0 && nth-- == 0)
            return other_words[i][1];
    return NULL;
}

void key_join(char out[KEY_SIZE], const char *path, const char *name)
{
    int head = snprintf(out, KEY_SIZE, "%s%s", path, *path ? "." : "");
    if (head < 0 || head >= KEY_SIZE)
        return;
    snprintf(out + head, KEY_SIZE - (size_t)head, "%.*s", KEY_SIZE - 1 - head, name);
}

/* The full name of the first key of a section, or inside it, that is called so, for people who put a key in the wrong
   section. */
static bool find_anywhere(const scenario_section *section, const char *path, const char *name, char out[KEY_SIZE])
{
    for (int32_t k = 0; k < section->key_count; k++) {
        const scenario_key *key = &section->keys[k];
        char here[KEY_SIZE];
        key_join(here, path, key->name);
        if (strcmp(key->name, name) == 0) {
            memcpy(out, here, KEY_SIZE);
            return true;
        }
        if (key->section && find_anywhere(key->section, here, name, out))
            return true;
    }
    return false;
}

const char *key_meant(const scenario_section *section, const char *path, const char *name, char out[KEY_SIZE])
{
    const char *known = key_other_name(name, 0), *word = known;
    for (int32_t nth = 1; word; nth++) {
        if (section_find(section, word) >= 0)
            return word;
        word = key_other_name(name, nth);
    }
    /* Inside the section a name is no other word: the weight of a mooring is that of its lines. */
    if (*path && find_anywhere(section, path, name, out))
        return out;
    if (known && find_anywhere(&scenario_schema, "", known, out))
        return out;
    /* x and y have keys in many sections: in the domain they are its edges. */
    const char *begun = section_begun(section, name);
    if (begun)
        return begun;
    return find_anywhere(&scenario_schema, "", name, out) ? out : section_nearest(section, name);
}

bool key_nested(const scenario_section *section, const char *name, char out[KEY_NESTED_SIZE])
{
    char word[KEY_NESTED_SIZE];
    size_t used = 0, depth = 0;
    out[0] = '\0';
    for (const char *point; (point = strchr(name, '.')) != NULL; name = point + 1, depth++) {
        snprintf(word, sizeof word, "%.*s", (int)(point - name), name);
        int32_t k = section_find(section, word);
        if (k < 0 || section->keys[k].kind != KEY_SECTION)
            return false;
        section = section->keys[k].section;
        used += (size_t)snprintf(out + used, KEY_NESTED_SIZE - used, "%s: {", word);
    }
    if (depth == 0 || section_find(section, name) < 0)
        return false;
    /* The names of the schema are short, and nested a few deep. */
    used += (size_t)snprintf(out + used, KEY_NESTED_SIZE - used, "%s: ...", name);
    for (; depth > 0 && used + 1 < KEY_NESTED_SIZE; depth--)
        used += (size_t)snprintf(out + used, KEY_NESTED_SIZE - used, "}");
    return true;
}

/* "" where items of the list have no name. */
static const char *item_name(const scenario_key *key, const void *member, int32_t item)
{
    int32_t k = section_find(key->section, "name");
    const scenario_key *text = k >= 0 ? &key->section->keys[k] : NULL;
    return text && text->kind == KEY_TEXT ? key_member(text, list_element(key, member, item)) : "";
}

int32_t item_find(const scenario_key *key, const void *member, const char *name)
{
    for (int32_t i = 0; *name && i < list_count(member); i++)
        if (strcmp(item_name(key, member, i), name) == 0)
            return i;
    return -1;
}

const char *item_meant(const scenario_key *key, const void *member, const char *word, char names[ITEM_NAMES_SIZE])
{
    name_search near = name_search_begin(word);
    int32_t told = 0;
    names[0] = '\0';
    for (int32_t i = 0; i < list_count(member); i++) {
        const char *name = item_name(key, member, i);
        if (!*name)
            continue;
        name_try(&near, name);
        size_t used = strlen(names);
        if (told++ <= ITEM_NAMES_MOST)
            snprintf(names + used, ITEM_NAMES_SIZE - used, "%s%.24s", told == 1 ? ", or the name, " : ", ",
                     told > ITEM_NAMES_MOST ? "..." : name);
    }
    return *word ? near.found : NULL;
}

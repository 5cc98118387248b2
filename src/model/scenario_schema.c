/* The descriptors of scenario_keys.h, and what is asked of them. */
#include "model/scenario_schema.h"
#include "base/name_search.h"
#include "base/transcendental.h"
#include <string.h>

/* Choices are read and written as int32_t. */
_Static_assert(sizeof(ice_source) == sizeof(int32_t) && sizeof(import_bad) == sizeof(int32_t), "an enum is 4 bytes");
_Static_assert(sizeof(solver_kind) == sizeof(int32_t), "an enum is 4 bytes");
_Static_assert(sizeof(vessel_mode) == sizeof(int32_t), "an enum is 4 bytes");

#define INFO_REAL(v, l, h) .kind = KEY_REAL, .value = (v), .at = 1, .lo = (l), .hi = (h)
#define INFO_SCALED(v, a, p, l, h) .kind = KEY_REAL, .value = (v), .at = (a), .power = (p), .lo = (l), .hi = (h)
#define INFO_AUTOMATIC(l, h) .kind = KEY_REAL, .automatic = true, .value = (double)NAN, .at = 1, .lo = (l), .hi = (h)
#define INFO_INTEGER(v, l, h) .kind = KEY_INTEGER, .value = (double)(v), .lo = (double)(l), .hi = (double)(h)
#define INFO_BOOLEAN(v) .kind = KEY_BOOLEAN, .value = (v)
#define INFO_CHOICE(type, v, names) .kind = KEY_CHOICE, .value = (double)(v), .text = (names)
#define INFO_TEXT(v) .kind = KEY_TEXT, .text = (v)
#define INFO_PATH(v) .kind = KEY_PATH, .text = (v)
#define INFO_SECTION(noun) .kind = KEY_SECTION, .section = &noun##_section
#define INFO_LIST(noun, most) .kind = KEY_LIST, .hi = (most), .section = &noun##_section

/* A row needs the struct of its section, hence SELF. */
#define ROW(k, spec, u, m) {.name = #k, .unit = (u), .meaning = (m), .offset = offsetof(SELF, k), INFO_##spec},
#define SECTION_DEFINE(noun, KEYS)                                       \
    static const scenario_key noun##_keys[] = {KEYS(ROW)};               \
    static const scenario_section noun##_section = {#noun, sizeof(SELF), \
                                                    (int32_t)(sizeof noun##_keys / sizeof *noun##_keys), noun##_keys};

#define SELF scenario_solver
SECTION_DEFINE(solver, SCENARIO_SOLVER_KEYS)
#undef SELF
#define SELF scenario_run
SECTION_DEFINE(run, SCENARIO_RUN_KEYS)
#undef SELF
#define SELF scenario_hull
SECTION_DEFINE(hull, SCENARIO_HULL_KEYS)
#undef SELF
#define SELF scenario_line_point
SECTION_DEFINE(line_point, SCENARIO_LINE_POINT_KEYS)
#undef SELF
#define SELF scenario_mooring_line
SECTION_DEFINE(mooring_line, SCENARIO_MOORING_LINE_KEYS)
#undef SELF
#define SELF scenario_mooring
SECTION_DEFINE(mooring, SCENARIO_MOORING_KEYS)
#undef SELF
#define SELF scenario_thruster
SECTION_DEFINE(thruster, SCENARIO_THRUSTER_KEYS)
#undef SELF
#define SELF scenario_path_point
SECTION_DEFINE(path_point, SCENARIO_PATH_POINT_KEYS)
#undef SELF
#define SELF scenario_waypoint
SECTION_DEFINE(waypoint, SCENARIO_WAYPOINT_KEYS)
#undef SELF
#define SELF scenario_positioning
SECTION_DEFINE(positioning, SCENARIO_POSITIONING_KEYS)
#undef SELF
#define SELF scenario_station
SECTION_DEFINE(station, SCENARIO_STATION_KEYS)
#undef SELF
#define SELF scenario_course_point
SECTION_DEFINE(course_point, SCENARIO_COURSE_POINT_KEYS)
#undef SELF
#define SELF scenario_pattern
SECTION_DEFINE(pattern, SCENARIO_PATTERN_KEYS)
#undef SELF
#define SELF scenario_approach
SECTION_DEFINE(approach, SCENARIO_APPROACH_KEYS)
#undef SELF
#define SELF scenario_wash
SECTION_DEFINE(wash, SCENARIO_WASH_KEYS)
#undef SELF
#define SELF scenario_propulsion
SECTION_DEFINE(propulsion, SCENARIO_PROPULSION_KEYS)
#undef SELF
#define SELF scenario_flow_row
SECTION_DEFINE(flow_row, SCENARIO_FLOW_ROW_KEYS)
#undef SELF
#define SELF scenario_flow
SECTION_DEFINE(flow, SCENARIO_FLOW_KEYS)
#undef SELF
#define SELF scenario_matrix_row
SECTION_DEFINE(matrix_row, SCENARIO_MATRIX_ROW_KEYS)
#undef SELF
#define SELF scenario_hydrodynamics
SECTION_DEFINE(hydrodynamics, SCENARIO_HYDRODYNAMICS_KEYS)
#undef SELF
#define SELF scenario_vessel
SECTION_DEFINE(vessel, SCENARIO_VESSEL_KEYS)
#undef SELF
#define SELF scenario_friction
SECTION_DEFINE(friction, SCENARIO_FRICTION_KEYS)
#undef SELF
#define SELF scenario_fracture
SECTION_DEFINE(fracture, SCENARIO_FRACTURE_KEYS)
#undef SELF
#define SELF scenario_floe
SECTION_DEFINE(floe, SCENARIO_FLOE_KEYS)
#undef SELF
#define SELF scenario_opening
SECTION_DEFINE(opening, SCENARIO_OPENING_KEYS)
#undef SELF
#define SELF scenario_population
SECTION_DEFINE(population, SCENARIO_POPULATION_KEYS)
#undef SELF
#define SELF scenario_level
SECTION_DEFINE(level, SCENARIO_LEVEL_KEYS)
#undef SELF
#define SELF scenario_strength
SECTION_DEFINE(strength, SCENARIO_STRENGTH_KEYS)
#undef SELF
#define SELF scenario_ice
SECTION_DEFINE(ice, SCENARIO_ICE_KEYS)
#undef SELF
#define SELF scenario_domain
SECTION_DEFINE(domain, SCENARIO_DOMAIN_KEYS)
#undef SELF
#define SELF scenario_ice_drag
SECTION_DEFINE(ice_drag, SCENARIO_ICE_DRAG_KEYS)
#undef SELF
#define SELF scenario_hull_drag
SECTION_DEFINE(hull_drag, SCENARIO_HULL_DRAG_KEYS)
#undef SELF
#define SELF scenario_environment
SECTION_DEFINE(environment, SCENARIO_ENVIRONMENT_KEYS)
#undef SELF
#define SELF scenario_output
SECTION_DEFINE(output, SCENARIO_OUTPUT_KEYS)
#undef SELF

#define SELF scenario
static const scenario_key scenario_keys[] = {SCENARIO_KEYS(ROW)};
#undef SELF
const scenario_section scenario_schema = {"scenario", sizeof(scenario),
                                          (int32_t)(sizeof scenario_keys / sizeof *scenario_keys), scenario_keys};

/* What any ARRAY looks like.  The members are arrays of many types and are moved as bytes, so that no rule of aliasing
   is bent. */
typedef ARRAY(void) any_list;

int32_t section_find(const scenario_section *section, const char *name)
{
    for (int32_t k = 0; k < section->key_count; k++)
        if (strcmp(section->keys[k].name, name) == 0)
            return k;
    return -1;
}

const scenario_key *scenario_key_find(const char *section, const char *name)
{
    const scenario_section *of = scenario_schema.keys[section_find(&scenario_schema, section)].section;
    return &of->keys[section_find(of, name)];
}

const char *section_begun(const scenario_section *section, const char *name)
{
    size_t length = strlen(name);
    for (int32_t k = 0; length > 0 && k < section->key_count; k++)
        if (strncmp(section->keys[k].name, name, length) == 0 && section->keys[k].name[length] == '_')
            return section->keys[k].name;
    return NULL;
}

const char *section_nearest(const scenario_section *section, const char *name)
{
    name_search near = name_search_begin(name);
    for (int32_t k = 0; k < section->key_count; k++)
        name_try(&near, section->keys[k].name);
    return near.found ? near.found : section_begun(section, name);
}

double key_default(const scenario_key *key, double scale)
{
    double ratio = scale / key->at;
    if (key->power == 0)
        return key->value;
    if (key->power == 0.5)
        return key->value * sqrt(ratio);
    if (key->power == 1)
        return key->value * ratio;
    if (key->power == 2)
        return key->value * (ratio * ratio);
    return key->value * real_pow(ratio, key->power);
}

static void key_set_default(const scenario_key *key, void *member, double scale)
{
    switch (key->kind) {
    case KEY_REAL:
        *(double *)member = key_default(key, scale);
        break;
    case KEY_INTEGER:
        *(int64_t *)member = (int64_t)key->value;
        break;
    case KEY_BOOLEAN:
        *(bool *)member = key->value != 0;
        break;
    case KEY_CHOICE:
        choice_set(member, (int32_t)key->value);
        break;
    case KEY_TEXT:
    case KEY_PATH:
        memset(member, 0, SCENARIO_TEXT_SIZE);
        memcpy(member, key->text, strlen(key->text));
        break;
    case KEY_SECTION:
        section_defaults(key->section, member, scale);
        break;
    case KEY_LIST:
        memset(member, 0, sizeof(any_list));
        break;
    }
}

void section_defaults(const scenario_section *section, void *data, double scale)
{
    for (int32_t k = 0; k < section->key_count; k++)
        key_set_default(&section->keys[k], key_member(&section->keys[k], data), scale);
}

static any_list list_load(const void *member)
{
    any_list list;
    memcpy(&list, member, sizeof list);
    return list;
}

int32_t list_count(const void *member) { return list_load(member).count; }

void *list_element(const scenario_key *key, const void *member, int32_t index)
{
    return (char *)list_load(member).data + (size_t)index * key->section->size;
}

void *list_append(context *ctx, const scenario_key *key, void *member, double scale)
{
    any_list list = list_load(member);
    if (list.count == INT32_MAX ||
        !array_reserve_raw(ctx, &list.data, &list.capacity, list.count + 1, key->section->size))
        return NULL;
    list.count++;
    memcpy(member, &list, sizeof list);
    void *element = list_element(key, member, list.count - 1);
    memset(element, 0, key->section->size);
    section_defaults(key->section, element, scale);
    return element;
}

void list_free(context *ctx, void *member)
{
    memory_free(ctx, list_load(member).data);
    memset(member, 0, sizeof(any_list));
}

int32_t choice_value(const void *member)
{
    int32_t value;
    memcpy(&value, member, sizeof value);
    return value;
}

void choice_set(void *member, int32_t value) { memcpy(member, &value, sizeof value); }

const char *choice_name(const scenario_key *key, int32_t value, size_t *size)
{
    const char *name = key->text;
    for (int32_t i = 0; i < value && *name; i++) {
        name += strcspn(name, " ");
        name += *name == ' ';
    }
    *size = strcspn(name, " ");
    return *size > 0 && value >= 0 ? name : NULL;
}

int32_t choice_find(const scenario_key *key, const char *name)
{
    size_t size;
    const char *have;
    for (int32_t i = 0; (have = choice_name(key, i, &size)) != NULL; i++)
        if (strlen(name) == size && memcmp(have, name, size) == 0)
            return i;
    return -1;
}

bool key_is_silent(const scenario_section *section, const scenario_key *key, const void *data)
{
    if (section == &scenario_schema) {
        bool listed = ((const scenario *)data)->vessels.count > 0;
        return listed ? key->offset == offsetof(scenario, vessel) : key->offset == offsetof(scenario, vessels);
    }
    return section == &vessel_section && key->offset == offsetof(scenario_vessel, name) &&
           ((const scenario_vessel *)data)->name[0] == '\0';
}

double key_number(const scenario_key *key, const void *member)
{
    switch (key->kind) {
    case KEY_REAL:
        return *(const double *)member;
    case KEY_INTEGER:
        return (double)*(const int64_t *)member;
    case KEY_BOOLEAN:
        return *(const bool *)member ? 1 : 0;
    default:
        return 0;
    }
}

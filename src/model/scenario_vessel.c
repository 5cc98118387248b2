#include "model/scenario_vessel.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool scenario_vessel_leaves(const scenario *s, const scenario_vessel *v)
{
    const scenario_positioning *p = &v->positioning;
    bool led = v->mode == VESSEL_FREE && p->active && v->thrusters.count > 0 && p->control != CONTROL_HEADING;
    if (!led || p->waypoints.count == 0)
        return false;
    const vec2 last = {p->waypoints.data[p->waypoints.count - 1].x, p->waypoints.data[p->waypoints.count - 1].y};
    const vec2 room = domain_edges_from(&s->domain, last);
    return fmin(room.x, room.y) < 0;
}

bool scenario_names_vessels(const scenario *s) { return s->vessels.count > 0; }

int32_t scenario_vessel_count(const scenario *s)
{
    if (!scenario_names_vessels(s))
        return s->vessel.present ? 1 : 0;
    int32_t count = 0;
    for (int32_t i = 0; i < s->vessels.count; i++)
        count += s->vessels.data[i].present;
    return count;
}

vessel_entry scenario_vessel_item(const scenario *s, int32_t item)
{
    vessel_entry e = {&s->vessels.data[item], ""};
    snprintf(e.path, sizeof e.path, "vessels[%d]", (int)item);
    return e;
}

vessel_entry scenario_vessel_entry(const scenario *s, int32_t index)
{
    for (int32_t i = 0; i < s->vessels.count; i++) {
        if (s->vessels.data[i].present && index-- == 0)
            return scenario_vessel_item(s, i);
    }
    vessel_entry alone = {&s->vessel, "vessel"};
    if (s->vessel_path[0])
        memcpy(alone.path, s->vessel_path, sizeof alone.path);
    return alone;
}

int32_t scenario_find_vessel(const scenario *s, const char *name)
{
    for (int32_t v = 0; v < scenario_vessel_count(s); v++) {
        if (*name && strcmp(scenario_vessel_entry(s, v).keys->name, name) == 0)
            return v;
    }
    return -1;
}

/* "\"tug\", \"barge\"" and so on, as far as there is room. */
static void list_names(const scenario *s, char *out, size_t room)
{
    size_t at = 0;
    for (int32_t v = 0; v < scenario_vessel_count(s) && at < room; v++) {
        const char *name = scenario_vessel_entry(s, v).keys->name; /* a single vessel may have one too */
        int written = *name ? snprintf(out + at, room - at, "%s\"%s\"", v > 0 ? ", " : "", name) : 0;
        at += written >= 0 ? (size_t)written : room;
    }
}

fram_status scenario_choose_vessel(const scenario *s, const char *place, const char *name, int32_t *index,
                                   fram_error *error)
{
    if (scenario_vessel_count(s) == 0)
        return error_set(error, FRAM_ERROR_INPUT, place, 0, "vessel", "there is no vessel");
    *index = name ? scenario_find_vessel(s, name) : 0;
    if (*index >= 0)
        return FRAM_OK;
    char names[160] = "";
    list_names(s, names, sizeof names);
    return error_set(error, FRAM_ERROR_INPUT, place, 0, "vessel", "expected the name of a vessel, %s; found \"%.60s\"",
                     names[0] ? names : "of which the only one has none", name);
}

scenario scenario_of_vessel(const scenario *s, int32_t index)
{
    scenario alone = *s;
    const vessel_entry entry = scenario_vessel_entry(s, index);
    alone.vessel = *entry.keys;
    memset(&alone.vessels, 0, sizeof alone.vessels);
    memcpy(alone.vessel_path, entry.path, sizeof alone.vessel_path);
    return alone;
}

const char *scenario_vessel_name(const scenario *s, int32_t index)
{
    bool there = index >= 0 && index < scenario_vessel_count(s) && scenario_names_vessels(s);
    return there ? scenario_vessel_entry(s, index).keys->name : NULL;
}

vessel_title vessel_title_of(const vessel_entry *entry)
{
    vessel_title title;
    const char *name = entry->keys->name;
    snprintf(title.text, sizeof title.text, "%s%.*s", *name ? "vessel " : "the vessel", (int)VESSEL_NAME_MOST, name);
    return title;
}

vessel_channel vessel_channel_name(const scenario *s, int32_t index, const char *channel)
{
    vessel_channel out;
    bool named = scenario_names_vessels(s);
    const char *name = named ? scenario_vessel_entry(s, index).keys->name : "";
    snprintf(out.text, sizeof out.text, "%.*s%s%.46s", (int)VESSEL_NAME_MOST, name, named ? "." : "", channel);
    return out;
}

vessel_file vessel_file_name(const scenario *s, int32_t index, const char *stem, const char *ending)
{
    vessel_file out;
    bool named = scenario_names_vessels(s);
    const char *name = named ? scenario_vessel_entry(s, index).keys->name : "";
    snprintf(out.text, sizeof out.text, "%.20s%s%.*s%.10s", stem, named ? "-" : "", (int)VESSEL_NAME_MOST, name,
             ending);
    return out;
}

void vessel_name_error(const scenario *s, const vessel_entry *entry, fram_error *error)
{
    if (!error)
        return;
    char member[sizeof error->key];
    memcpy(member, error->key, sizeof member);
    snprintf(error->key, sizeof error->key, "%s%s%.100s", entry->path, member[0] ? "." : "", member);
    scenario_locate(s, error);
}

fram_status vessel_fault(const scenario *s, const vessel_entry *entry, const char *member, fram_error *error,
                         const char *format, ...)
{
    char message[sizeof error->message];
    va_list arguments;
    va_start(arguments, format);
    if (vsnprintf(message, sizeof message, format, arguments) < 0)
        message[0] = '\0';
    va_end(arguments);
    fram_status status = error_set(error, FRAM_ERROR_INPUT, NULL, 0, member, "%s", message);
    vessel_name_error(s, entry, error);
    return status;
}

bool vessel_begins_at_equilibrium(const scenario_vessel *v)
{
    return v->mode == VESSEL_FREE && v->mooring.equilibrium && v->mooring.lines.count > 0;
}

int32_t scenario_released_lines(const scenario_vessel *v, double time)
{
    int32_t count = 0;
    for (int32_t i = 0; i < v->mooring.lines.count; i++) {
        const scenario_mooring_line *line = &v->mooring.lines.data[i];
        if (automatic_or(line->release_time, HUGE_VAL) <= time)
            count += (int32_t)line->count;
    }
    return count;
}

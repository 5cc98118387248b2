#include "model/scenario_check_vessels.h"

#include "model/scenario_vessel.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- one vessel ---- */

/* A path is for what is driven, and its times go on. */
static fram_status check_path(const scenario *s, const vessel_entry *e, fram_error *error)
{
    const scenario_vessel *v = e->keys;
    if (v->mode == VESSEL_FREE && v->path.count > 0)
        return vessel_fault(s, e, "path", error, "expected none, since %s.mode is free, found %d points", e->path,
                            (int)v->path.count);
    if (v->path.count == 1)
        return vessel_fault(s, e, "path", error, "expected two points at least, found 1");
    for (int32_t i = 1; i < v->path.count; i++) {
        char key[48];
        snprintf(key, sizeof key, "path[%d].time", (int)i);
        if (!(v->path.data[i].time > v->path.data[i - 1].time))
            return vessel_fault(s, e, key, error, "expected a later time than that of the point before");
    }
    return FRAM_OK;
}

/* A speed that is given must lie under the one at which a run is taken to have gone wrong. */
static fram_status check_vessel_speed(const scenario *s, const vessel_entry *e, const char *key, double speed,
                                      fram_error *error)
{
    if (speed < s->run.speed_limit)
        return FRAM_OK;
    return vessel_fault(s, e, key, error,
                        "expected less than run.speed_limit, at which a run ends, %g m/s, found %g m/s",
                        s->run.speed_limit, speed);
}

static fram_status check_vessel_speeds(const scenario *s, const vessel_entry *e, fram_error *error)
{
    const scenario_vessel *v = e->keys;
    fram_status status = v->path.count == 0 ? check_vessel_speed(s, e, "speed", v->speed, error) : FRAM_OK;
    for (int32_t i = 1; i < v->path.count && status == FRAM_OK; i++) {
        const scenario_path_point *a = &v->path.data[i - 1], *b = &v->path.data[i];
        double x = b->x - a->x, y = b->y - a->y;
        char key[48];
        snprintf(key, sizeof key, "path[%d].time", (int)i);
        status = check_vessel_speed(s, e, key, sqrt(x * x + y * y) / (b->time - a->time), error);
    }
    return status;
}

static fram_status check_line_count(const scenario *s, const vessel_entry *e, fram_error *error)
{
    const scenario_mooring *m = &e->keys->mooring;
    int64_t all = 0;
    for (int32_t i = 0; i < m->lines.count; i++)
        all += m->lines.data[i].count;
    if (m->lines.count > 0 && !(m->z > -m->depth))
        return vessel_fault(s, e, "mooring.z", error,
                            "expected fairleads above the bottom, which is at %g m, found %g m", -m->depth, m->z);
    if (all <= VESSEL_LINES_MOST)
        return FRAM_OK;
    return vessel_fault(s, e, "mooring.lines", error, "expected at most %d lines in all, found %d",
                        (int)VESSEL_LINES_MOST, (int)all);
}

/* A line of kind table has one table, others have none. */
static fram_status check_line_tables(const scenario *s, const vessel_entry *e, fram_error *error)
{
    const scenario_mooring_line_list *lines = &e->keys->mooring.lines;
    for (int32_t i = 0; i < lines->count; i++) {
        const scenario_mooring_line *l = &lines->data[i];
        char key[64];
        snprintf(key, sizeof key, "mooring.lines[%d].table", (int)i);
        bool given = l->table.count > 0 || l->table_file[0];
        if (l->kind == LINE_TABLE && !given)
            return vessel_fault(s, e, key, error,
                                "expected points or a table_file, since kind is table, found neither");
        if (l->kind != LINE_TABLE && given)
            return vessel_fault(s, e, key, error, "expected neither points nor a table_file, since kind is not table");
        if (l->table.count > 0 && l->table_file[0])
            return vessel_fault(s, e, key, error, "expected points or a table_file, found both");
    }
    return FRAM_OK;
}

/* A ship that drives itself is free and keeps no station. */
static fram_status check_propulsion(const scenario *s, const vessel_entry *e, fram_error *error)
{
    const scenario_propulsion *p = &e->keys->propulsion;
    bool drives = vessel_drives_itself(e->keys), aims = p->waypoints.count > 0 || p->pattern.kind != PATTERN_NONE;
    if (!drives && aims)
        return vessel_fault(s, e, "propulsion.bollard_pull", error,
                            "expected a thrust, since way points or a pattern are given, found auto");
    if (drives && e->keys->mode != VESSEL_FREE)
        return vessel_fault(s, e, "propulsion.bollard_pull", error,
                            "expected auto, since %s.mode is not free: a ship that drives itself needs mode: free",
                            e->path);
    if (drives && e->keys->positioning.active)
        return vessel_fault(s, e, "propulsion.bollard_pull", error,
                            "expected auto, since %s.positioning.active is true", e->path);
    if (p->waypoints.count > 0 && p->pattern.kind != PATTERN_NONE)
        return vessel_fault(s, e, "propulsion.waypoints", error, "expected none, since there is a pattern, found %d",
                            (int)p->waypoints.count);
    if (p->pattern.kind == PATTERN_AHEAD && !is_automatic(p->pattern.period))
        return vessel_fault(s, e, "propulsion.pattern.period", error,
                            "expected auto, since the way ahead has no rounds: set propulsion.speed");
    return FRAM_OK;
}

/* Lines, thrusters and positioning act on a vessel that is free, and positioning needs thrusters. */
static fram_status check_station(const scenario *s, const vessel_entry *e, fram_error *error)
{
    const scenario_vessel *v = e->keys;
    bool held = v->mode != VESSEL_FREE;
    if (held && v->mooring.lines.count > 0)
        return vessel_fault(s, e, "mooring.lines", error,
                            "expected none, since %s.mode is not free, found %d: a moored vessel needs mode: free",
                            e->path, (int)v->mooring.lines.count);
    if (held && v->thrusters.count > 0)
        return vessel_fault(s, e, "thrusters", error,
                            "expected none, since %s.mode is not free, found %d: thrusters move a vessel in mode: free",
                            e->path, (int)v->thrusters.count);
    if (held && v->positioning.active)
        return vessel_fault(s, e, "positioning.active", error,
                            "expected false, since %s.mode is not free: a vessel that is positioned needs mode: free",
                            e->path);
    if (v->positioning.active && v->thrusters.count == 0)
        return vessel_fault(s, e, "thrusters", error,
                            "expected thrusters, since %s.positioning.active is true, found none", e->path);
    for (int32_t i = 1; i < v->positioning.waypoints.count; i++) {
        if (v->positioning.waypoints.data[i].time > v->positioning.waypoints.data[i - 1].time)
            continue;
        char key[64];
        snprintf(key, sizeof key, "positioning.waypoints[%d].time", (int)i);
        return vessel_fault(s, e, key, error, "expected a later time than that of the way point before");
    }
    fram_status status = check_propulsion(s, e, error);
    if (status == FRAM_OK)
        status = check_line_count(s, e, error);
    if (status == FRAM_OK)
        status = check_line_tables(s, e, error);
    return status == FRAM_OK ? check_path(s, e, error) : status;
}

static fram_status check_hull(const scenario *s, const vessel_entry *e, fram_error *error)
{
    const scenario_hull *hull = &e->keys->hull;
    if (hull->form == HULL_MESH && !hull->file[0])
        return vessel_fault(s, e, "hull.file", error,
                            "expected the path of a mesh, since %s.hull.form is file, found nothing", e->path);
    if (hull->form != HULL_MESH && hull->file[0])
        return vessel_fault(s, e, "hull.file", error, "expected nothing, since %s.hull.form is not file, found \"%s\"",
                            e->path, hull->file);
    return FRAM_OK;
}

/* A path stands in place of x and y: the vessel begins at its first point. */
static fram_status check_place(const scenario *s, const vessel_entry *e, fram_error *error)
{
    const scenario_vessel *v = e->keys;
    const scenario_domain *d = &s->domain;
    bool goes = v->path.count > 0;
    double x = goes ? v->path.data[0].x : v->x, y = goes ? v->path.data[0].y : v->y;
    if (d->boundary != DOMAIN_WALLS || domain_has(d, x, y))
        return FRAM_OK;
    const char *of = goes ? "path[0]." : "";
    return vessel_fault(s, e, goes ? "path[0].x" : "x", error,
                        "expected %s.%sx and %s.%sy inside the walls of the domain, found a place outside", e->path, of,
                        e->path, of);
}

static fram_status check_rows(const scenario *s, const vessel_entry *e, const char *key, int32_t count,
                              fram_error *error)
{
    if (count == 0 || count == 6)
        return FRAM_OK;
    return vessel_fault(s, e, key, error, "expected 6 rows (surge, sway, heave, roll, pitch, yaw) or none, found %d",
                        (int)count);
}

static fram_status check_hydrodynamics(const scenario *s, const vessel_entry *e, fram_error *error)
{
    const scenario_hydrodynamics *h = &e->keys->hydrodynamics;
    fram_status status = check_rows(s, e, "hydrodynamics.added_mass", h->added_mass.count, error);
    return status == FRAM_OK ? check_rows(s, e, "hydrodynamics.damping", h->damping.count, error) : status;
}

/* A jet needs water, and somebody who makes it. */
static fram_status check_wash(const scenario *s, const vessel_entry *e, fram_error *error)
{
    const scenario_vessel *v = e->keys;
    if (!v->wash.active)
        return FRAM_OK;
    if (!s->environment.water)
        return vessel_fault(s, e, "wash.active", error, "expected false, since environment.water is false");
    if (v->thrusters.count == 0 && !vessel_drives_itself(v))
        return vessel_fault(s, e, "wash.active", error,
                            "expected false, since %s has neither thrusters nor propulsion.bollard_pull", e->path);
    return FRAM_OK;
}

static fram_status check_vessel(const scenario *s, const vessel_entry *e, fram_error *error)
{
    fram_status status = check_hull(s, e, error);
    if (status == FRAM_OK)
        status = check_station(s, e, error);
    if (status == FRAM_OK)
        status = check_place(s, e, error);
    if (status == FRAM_OK)
        status = check_hydrodynamics(s, e, error);
    if (status == FRAM_OK)
        status = check_wash(s, e, error);
    return status == FRAM_OK ? check_vessel_speeds(s, e, error) : status;
}

/* ---- the list ---- */

/* `vessel` is the short form of a list of one: nobody could tell what both mean together. */
static fram_status check_forms(const scenario *s, fram_error *error)
{
    if (scenario_given(s, "vessels") && s->vessels.count == 0)
        return scenario_fault(s, error, "vessels",
                              "expected at least one vessel, found none; vessel: {present: false} asks for ice alone");
    if (s->vessels.count == 0)
        return FRAM_OK;
    for (int32_t i = 0; i < s->places.count; i++) {
        const char *key = s->places.data[i].key;
        if (strcmp(key, "vessel") == 0 || strncmp(key, "vessel.", 7) == 0)
            return scenario_fault(
                s, error, key,
                "expected either vessel, of one vessel, or vessels, a list, found both; in a list the key "
                "is vessels.NAME.KEY");
    }
    return FRAM_OK;
}

static bool is_name_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

/* Names stand in headers of columns, in keys beside numbers of items, in names of files and of variables of NetCDF;
   words of a command that begin with - are options. */
static fram_status check_name(const scenario *s, const vessel_entry *e, fram_error *error)
{
    static const char *const rule = "letters a to z, digits, - and _, a letter at least and - not the first";
    const char *name = e->keys->name;
    size_t size = strlen(name);
    bool letters = false, fits = size <= VESSEL_NAME_MOST && name[0] != '-';
    for (size_t i = 0; i < size; i++) {
        fits = fits && is_name_letter(name[i]);
        letters = letters || ((name[i] | 32) >= 'a' && (name[i] | 32) <= 'z');
    }
    if (size == 0)
        return vessel_fault(s, e, "name", error, "expected a name of %s, found none", rule);
    if (!fits || !letters)
        return vessel_fault(s, e, "name", error, "expected a name of at most %d characters, %s, found \"%.60s\"",
                            (int)VESSEL_NAME_MOST, rule, name);
    return FRAM_OK;
}

static bool same_name(const char *a, const char *b)
{
    while (*a && (*a == *b || ((*a | 32) == (*b | 32) && (*a | 32) >= 'a' && (*a | 32) <= 'z'))) {
        a++;
        b++;
    }
    return *a == *b;
}

static fram_status check_names(const scenario *s, fram_error *error)
{
    for (int32_t i = 0; i < s->vessels.count; i++) {
        vessel_entry e = scenario_vessel_item(s, i);
        fram_status status = check_name(s, &e, error);
        if (status != FRAM_OK)
            return status;
        for (int32_t j = 0; j < i; j++) {
            if (same_name(e.keys->name, s->vessels.data[j].name))
                return vessel_fault(s, &e, "name", error,
                                    "expected a name of its own, small and capital letters being the same, found "
                                    "\"%s\", which vessels[%d] has",
                                    e.keys->name, (int)j);
        }
    }
    return FRAM_OK;
}

/* Whether a section of an item, or a key in it, was given. */
static bool is_given(const scenario *s, const char *key)
{
    size_t size = strlen(key);
    for (int32_t i = 0; i < s->places.count; i++) {
        const char *place = s->places.data[i].key;
        if (strncmp(place, key, size) == 0 && (place[size] == '\0' || place[size] == '.'))
            return true;
    }
    return false;
}

/* A hull that was forgotten in a list would be the icebreaker of the defaults. */
static fram_status check_hulls_given(const scenario *s, fram_error *error)
{
    for (int32_t i = 0; i < s->vessels.count && scenario_given(s, "vessels"); i++) {
        vessel_entry e = scenario_vessel_item(s, i);
        char key[48];
        snprintf(key, sizeof key, "%s.hull", e.path);
        if (e.keys->present && !is_given(s, key))
            return vessel_fault(s, &e, "hull", error, "expected a hull for vessel \"%s\", found none", e.keys->name);
    }
    return FRAM_OK;
}

fram_status scenario_check_vessels(const scenario *s, fram_error *error)
{
    fram_status status = check_forms(s, error);
    if (status == FRAM_OK && s->vessel.name[0]) {
        vessel_entry single = {&s->vessel, "vessel"};
        status = check_name(s, &single, error);
    }
    if (status == FRAM_OK)
        status = check_names(s, error);
    if (status == FRAM_OK)
        status = check_hulls_given(s, error);
    for (int32_t i = 0; i < scenario_vessel_count(s) && status == FRAM_OK; i++) {
        vessel_entry e = scenario_vessel_entry(s, i);
        status = check_vessel(s, &e, error);
    }
    return status;
}

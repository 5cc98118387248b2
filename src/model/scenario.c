/* Defaults, places and paths of a scenario. */
#include "base/transcendental.h"
#include "model/scenario_schema.h"
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* The longest full name of a key with its list indices. */
enum { PATH_SIZE = sizeof((scenario_place *)0)->key };

void scenario_defaults(scenario *s, double scale)
{
    memset(s, 0, sizeof *s);
    section_defaults(&scenario_schema, s, scale);
    s->run.scale = scale;
}

double scenario_default_scale(void) { return scenario_key_find("run", "scale")->value; }

static void section_free(context *ctx, const scenario_section *section, void *data)
{
    for (int32_t k = 0; k < section->key_count; k++) {
        const scenario_key *key = &section->keys[k];
        void *member = key_member(key, data);
        if (key->kind == KEY_SECTION)
            section_free(ctx, key->section, member);
        if (key->kind == KEY_LIST) {
            for (int32_t i = 0; i < list_count(member); i++)
                section_free(ctx, key->section, list_element(key, member, i));
            list_free(ctx, member);
        }
    }
}

void scenario_free(context *ctx, scenario *s)
{
    section_free(ctx, &scenario_schema, s);
    array_free(ctx, &s->places);
}

static fram_status section_walk(const scenario_section *section, const void *data, const char *path, key_visit visit,
                                void *user, fram_error *error)
{
    fram_status status = FRAM_OK;
    for (int32_t k = 0; k < section->key_count && status == FRAM_OK; k++) {
        const scenario_key *key = &section->keys[k];
        const void *member = key_member_const(key, data);
        char name[PATH_SIZE];
        snprintf(name, sizeof name, "%s%s%s", path, *path ? "." : "", key->name);
        if (key->kind == KEY_SECTION) {
            status = section_walk(key->section, member, name, visit, user, error);
        } else if (key->kind == KEY_LIST) {
            char list[PATH_SIZE];
            memcpy(list, name, sizeof list);
            status = visit(user, key, member, list, error);
            for (int32_t i = 0; i < list_count(member) && status == FRAM_OK; i++) {
                snprintf(name, sizeof name, "%.80s[%d]", list, (int)i);
                status = section_walk(key->section, list_element(key, member, i), name, visit, user, error);
            }
        } else {
            status = visit(user, key, member, name, error);
        }
    }
    return status;
}

fram_status scenario_walk(const scenario *s, key_visit visit, void *user, fram_error *error)
{
    return section_walk(&scenario_schema, s, "", visit, user, error);
}

/* From the last one, since an override stands behind the key it overrides. */
const scenario_place *scenario_given(const scenario *s, const char *key)
{
    for (int32_t i = s->places.count - 1; i >= 0; i--)
        if (strcmp(s->places.data[i].key, key) == 0)
            return &s->places.data[i];
    return NULL;
}

void scenario_locate(const scenario *s, fram_error *error)
{
    if (!error)
        return;
    char key[sizeof error->key];
    memcpy(key, error->key, sizeof key);
    const scenario_place *place = scenario_given(s, key);
    for (char *end = strrchr(key, '.'); end && !place; end = strrchr(key, '.')) {
        *end = '\0';
        place = scenario_given(s, key);
    }
    const char *file = place && place->override ? SCENARIO_OVERRIDE : s->file;
    snprintf(error->file, sizeof error->file, "%.*s", (int)sizeof error->file - 1, file);
    error->line = place ? place->line : 0;
    error->column = place ? place->column : 0;
}

fram_status scenario_fault(const scenario *s, fram_error *error, const char *key, const char *format, ...)
{
    char message[sizeof error->message];
    va_list arguments;
    va_start(arguments, format);
    if (vsnprintf(message, sizeof message, format, arguments) < 0)
        message[0] = '\0';
    va_end(arguments);
    error_set(error, FRAM_ERROR_INPUT, NULL, 0, key, "%s", message);
    scenario_locate(s, error);
    return FRAM_ERROR_INPUT;
}

/* Files keep their short names in messages until the program changes its working folder. */
static bool program_went_elsewhere(const scenario *s)
{
    char now[sizeof s->folder];
    if (!s->folder[0])
        return false;
    size_t length = getcwd(now, sizeof now) ? strlen(now) : 0;
    return length == 0 || strncmp(now, s->folder, length) != 0 || strlen(s->folder) != length + (length > 1);
}

bool scenario_resolve_path(const scenario *s, const char *path, char *out, size_t size)
{
    const char *slash = strrchr(s->file, '/');
    int folder = path[0] == '/' || !slash ? 0 : (int)(slash - s->file) + 1;
    bool elsewhere = path[0] != '/' && s->file[0] != '/' && program_went_elsewhere(s);
    int length = snprintf(out, size, "%s%.*s%s", elsewhere ? s->folder : "", folder, s->file, path);
    return length >= 0 && (size_t)length < size;
}

fram_status scenario_file_path(const scenario *s, const char *key, const char *file, char out[SCENARIO_PATH_ROOM],
                               fram_error *error)
{
    if (scenario_resolve_path(s, file, out, SCENARIO_PATH_ROOM))
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, key ? NULL : file, 0, key, "the path is too long");
}

bool scenario_own_file(const scenario *s, char *out, size_t size)
{
    const char *slash = strrchr(s->file, '/');
    return s->file[0] && scenario_resolve_path(s, slash ? slash + 1 : s->file, out, size);
}

int64_t scenario_step_at(double time, double time_step) { return (int64_t)floor(time / time_step + 0.5); }

int64_t scenario_steps_of(double interval, double time_step)
{
    int64_t steps = scenario_step_at(interval, time_step);
    return steps < 1 ? 1 : steps;
}

int64_t scenario_interval_steps(double interval, double time_step)
{
    return interval > 0 ? scenario_steps_of(interval, time_step) : 0;
}

/* The most steps that loads are averaged over. */
enum { AVERAGING_STEPS_MOST = 1000000 };

int64_t scenario_averaging_steps(const scenario *s)
{
    int64_t steps = scenario_steps_of(s->output.averaging_window, s->run.time_step);
    return steps > AVERAGING_STEPS_MOST ? AVERAGING_STEPS_MOST : steps;
}

double scenario_averaging_window(const scenario *s)
{
    double asked = s->output.averaging_window, made = (double)scenario_averaging_steps(s) * s->run.time_step;
    return fabs(made - asked) <= 1e-9 * asked ? asked : made;
}

/* Part of the span that a window may have. */
#define SHORT_WINDOW 0.1

bool scenario_averages_begin_early(const scenario *s, double first, double span)
{
    double window = scenario_averaging_window(s);
    return window > first * (1 + 1e-9) && window > SHORT_WINDOW * span;
}

box2 domain_box(const scenario_domain *d) { return (box2){{d->x_min, d->y_min}, {d->x_max, d->y_max}}; }

bool domain_has(const scenario_domain *d, double x, double y)
{
    return x >= d->x_min && x <= d->x_max && y >= d->y_min && y <= d->y_max;
}

vec2 domain_edges_from(const scenario_domain *d, vec2 at)
{
    return vec2_make(fmin(at.x - d->x_min, d->x_max - at.x), fmin(at.y - d->y_min, d->y_max - at.y));
}

box2 domain_with_walls(const scenario_domain *d)
{
    double t = d->boundary == DOMAIN_WALLS ? d->wall_thickness : 0;
    return (box2){{d->x_min - t, d->y_min - t}, {d->x_max + t, d->y_max + t}};
}

bool scenario_ice_is_field(const scenario_ice *i)
{
    return i->source == ICE_VORONOI || i->source == ICE_PACKED || i->source == ICE_FILE;
}

bool scenario_ice_is_drawn(const scenario_ice *i)
{
    return scenario_ice_is_field(i) && (i->source != ICE_FILE || i->populations.count > 0);
}

ice_drift scenario_current(const scenario *s)
{
    const scenario_environment *e = &s->environment;
    bool fed = s->ice.source != ICE_NONE && s->domain.boundary == DOMAIN_FEEDING;
    return (ice_drift){
        e->current_file, e->current_profile_file, e->current_speed, e->current_direction_deg, fed, false};
}

ice_drift scenario_drift(const scenario *s)
{
    const scenario_domain *d = &s->domain;
    const ice_drift current = scenario_current(s);
    if (current.fed && (d->drift_file[0] || !is_automatic(d->drift_speed)))
        return (ice_drift){d->drift_file, "", automatic_or(d->drift_speed, 0), d->drift_direction_deg, true, true};
    return current;
}

vec3 scenario_velocity(double speed, double direction_deg)
{
    double angle = radians(direction_deg);
    return vec3_make(speed * real_cos(angle), speed * real_sin(angle), 0);
}

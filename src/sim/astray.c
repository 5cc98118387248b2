#include "sim/astray.h"

#define FORCES_TOLD                                                                                              \
    "the forces that a program told it (outside_force, outside_moment, wrenches) and at current and wind where " \
    "they were told"

static bool is_touched(const world *w, int32_t body)
{
    for (int32_t i = 0; i < w->scratch.contacts.count; i++) {
        if (w->scratch.contacts.data[i].a == body || w->scratch.contacts.data[i].b == body)
            return true;
    }
    return false;
}

/* A carriage tells a vessel how to go over the water, and leaves it free to heave. */
static bool goes_as_towed(const world *w, int32_t body)
{
    vec3 u = w->bodies.velocity[body];
    if (!(u.x * u.x + u.y * u.y >= u.z * u.z))
        return false;
    for (int32_t v = 0; v < w->vessels.count; v++) {
        if (w->vessels.body[v] == body && w->vessels.joint[v] >= 0)
            return true;
    }
    return false;
}

/* Whether a program told a force that acts on the body, or a wind or current; what was told to be zero is none. */
static bool is_pushed(const world *w, int32_t body)
{
    const input_table *in = &w->inputs;
    bool pushed = false;
    for (int32_t i = 0; i < in->count && !pushed; i++) {
        bool first = vec3_length(in->first[i]) > 0, some = first || vec3_length(in->second[i]) > 0;
        switch ((input_kind)in->kind[i]) {
        case INPUT_WIND:
        case INPUT_CURRENT:
            pushed = first;
            break;
        case INPUT_FORCE:
            pushed = some && w->vessels.body[in->which[i]] == body;
            break;
        case INPUT_WRENCH:
            pushed = some && in->which[i] == body;
            break;
        case INPUT_DRIFT:
        case INPUT_KIND_COUNT:
            break;
        }
    }
    return pushed;
}

/* What nothing touches. */
static const char *remedy_alone(const world *w, int32_t body, bool pushed)
{
    if (w->bodies.material[body] == MATERIAL_ICE)
        return pushed ? "nothing touches it: look at " FORCES_TOLD ", then at its velocity at the start"
                      : "nothing touches it: look at its velocity at the start, at run.time_step, and at the warnings "
                        "that the notes of the scenario give";
    return pushed ? "nothing touches it: look at " FORCES_TOLD ", then at its mass, lines, thrusters and coefficients"
                  : "nothing touches it, so that its own forces did it: look at its mass, radii of gyration and centre "
                    "of gravity, at lines, thrusters and coefficients, and at the warnings that the notes of the "
                    "scenario give";
}

const char *astray_remedy(const world *w, int32_t body)
{
    if (!body_is_dynamic(&w->bodies, body) || goes_as_towed(w, body))
        return "it moves as the scenario, or a program, told it: correct that, or raise run.speed_limit";
    bool pushed = is_pushed(w, body);
    if (is_touched(w, body))
        return pushed ? "contacts act on it: look at " FORCES_TOLD "; a smaller run.time_step may help too"
                      : "contacts act on it; a smaller run.time_step may help";
    return remedy_alone(w, body, pushed);
}

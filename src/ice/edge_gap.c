/* Gaps between a hull and the face that it left or melted; see edge_gap.h. */
#include "ice/edge_gap.h"

/* The end of an even patch over the arm of its contacts, which have its second moments. */
static const double END_OVER_ARM = 1.7320508075688772;

static const contact *first_contact_of(const crushing_patch *p, const contact_array *contacts)
{
    return &contacts->data[p->contact_first];
}

static vec3 past_at(const body_table *bodies, const crushing_patch *p, vec3 place)
{
    return body_velocity_past(bodies, p->surface_body, p->floe_body, place);
}

/* At which the surface closes on the face where it does so fastest: a hull that turns comes on with one end of a patch
   [m/s]. */
static double closing_speed(const body_table *bodies, const crushing_patch *p, const contact_array *contacts)
{
    double middle = vec3_dot(past_at(bodies, p, p->centre), p->normal), most = 0;
    for (int32_t i = 0; i < p->contact_count; i++) {
        vec3 place = first_contact_of(p, contacts)[i].point;
        most = fmax(most, vec3_dot(past_at(bodies, p, place), p->normal) - middle);
    }
    return middle + END_OVER_ARM * most;
}

/* A patch is the one that its support was kept of, not a neighbour, if their middles are apart by no more than the
   surface slid in a step and half of the patch's size. */
static bool is_same_patch(vec3 place, const body_table *bodies, const floe_table *floes, double time_step,
                          const crushing_patch *p)
{
    double size = fmax(sqrt(p->area), floes->thickness[p->floe]);
    double apart = vec3_length(vec3_sub(place, body_to_local(bodies, p->surface_body, p->centre)));
    return apart <= vec3_length(past_at(bodies, p, p->centre)) * time_step + size / 2;
}

void edge_gap_open(const edge_support_table *supports, int32_t row, const body_table *bodies, const floe_table *floes,
                   double time_step, const crushing_patch *p, contact_array *contacts)
{
    double gap = supports->gap[row];
    if (!(gap > 0) || !is_same_patch(supports->place[row], bodies, floes, time_step, p))
        return;
    bool closes = closing_speed(bodies, p, contacts) * time_step > gap;
    for (int32_t i = p->contact_first; i < p->contact_first + p->contact_count; i++) {
        contact *c = &contacts->data[i];
        c->gap = gap;
        /* What nothing moves aside presses with all that it may, once it has come as near. */
        if (c->crush_infinite && !closes)
            c->impulse_limit = 0;
    }
}

/* Depth that the heat of friction melts off the face in a step, mu p v/(rho L), of an edge that is bent; no more than
   lets it go, C n_z^2 N, so that its load fades in steps of any length [m].  Under a hull that moves as it is told
   nothing is bent. */
static double melted(const body_table *bodies, double density, double latent_heat, double time_step,
                     const crushing_patch *p, const contact *first, double pressed)
{
    vec3 past = past_at(bodies, p, p->centre);
    vec3 slip = vec3_mad(past, p->normal, -vec3_dot(past, p->normal));
    double depth = first->friction_kinetic * pressed * vec3_length(slip) / (p->area * density * latent_heat);
    double bent = first->give * time_step * pressed * p->normal.z * p->normal.z;
    return bent > 0 && !first->crush_infinite ? depth * bent / (depth + bent) : 0;
}

double edge_gap_after(edge_gap_rules rules, const body_table *bodies, double density, double time_step,
                      const crushing_patch *p, const contact_array *contacts)
{
    const contact *first = first_contact_of(p, contacts);
    double pressed = edge_gap_pressed(p, contacts);
    if (pressed > 0)
        return rules.melts ? melted(bodies, density, rules.latent_heat, time_step, p, first, pressed) : 0;
    double recoil = first->crush_infinite ? 0 : first->recoil;
    double closes = closing_speed(bodies, p, contacts) - recoil * p->normal.z;
    return rules.gaps ? fmax(first->gap - closes * time_step, 0) : 0;
}

double edge_gap_pressed(const crushing_patch *p, const contact_array *contacts)
{
    double sum = 0;
    for (int32_t i = p->contact_first; i < p->contact_first + p->contact_count; i++)
        sum += contacts->data[i].impulse[0];
    return sum;
}

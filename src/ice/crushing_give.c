/* Edges of level and fixed ice that give under what crushes on them (docs/decisions/0220); see crushing_parts.h. */
#include "ice/crushing_parts.h"

/* How well the way is found that an edge gives, as part of the largest; and in how many turns at most. */
static const double GIVE_PRECISION = 1e-13;
enum { MOST_GIVE_TURNS = 100 };

/* Vertical load on the floe over that of the pressure alone: what friction leaves of it as the hull slides along the
   ice, F_z = p (A_z + mu |A| t_z), t the direction in which the surface slides.  1 at rest, where friction has no
   direction; under 0 where friction turns the load over. */
static double share_of_friction(const crushing_job *j, const crushing_pair *p, const patch_component *c)
{
    vec3 centre = vec3_add(p->position, mat3_mul_vec(p->rotation, c->centre));
    vec3 past = body_velocity_past(j->bodies, p->surface_body, p->floe_body, centre);
    vec3 normal = vec3_unit(c->area), slip = mat3_tmul_vec(p->rotation, past);
    slip = vec3_mad(slip, normal, -vec3_dot(slip, normal));
    double speed = vec3_length(slip);
    if (!(speed > p->surface.rest))
        return 1;
    return 1 + p->policy->friction_kinetic * slip.z / speed / normal.z;
}

bool crushing_edge_gives(const crushing_job *j, const crushing_pair *p, const patch_component *c)
{
    return j->settings->edges.gives && j->floes->breakable[p->floe] && !j->settings->top_plane_area &&
           body_is_held(j->bodies, p->floe_body) && j->bodies->material[p->surface_body] == MATERIAL_HULL &&
           fabs(c->area.z) > CLOSED_PATCH * c->surface && share_of_friction(j, p, c) > 0;
}

/* An edge under one component. */
typedef struct loaded_edge {
    const patch_component *whole;
    int32_t number;
    edge_stand stand;
    double sign;  /* of the way that it gives, along the floe's z */
    double share; /* of the pressure's vertical load that friction leaves */
} loaded_edge;

/* What bears the edge after it gave by this much, less what crushes on it then [N]; with what seams divide off, which
   gives as this part does.  Were that kept as it was, parts would answer one another's last step, and loads over three
   tiles and more grow from swing to swing. */
static double excess(const crushing_job *j, const crushing_pair *p, const loaded_edge *e, double give,
                     double *stiffness)
{
    vec3 left = patch_area_left(j->room, &p->prism, e->number, e->sign * give);
    double area = vec3_length(left), level = fabs(left.z) / e->stand.part;
    *stiffness = edge_stiffness(&j->settings->edges, &j->floes->material[p->floe], j->floes->thickness[p->floe], level,
                                e->stand);
    return *stiffness * give - (area > 0 ? crushing_component_pressure(j, p, e->whole, area) * level * e->share : 0);
}

/* The largest way that is not more than balance, and whether there is balance before theory ends: by secants between
   two ways with both signs, every third time by halves, so that a patch that leaves the edge all at once ends the
   search too. */
static double find_give(const crushing_job *j, const crushing_pair *p, const loaded_edge *e, bool *balance)
{
    double lo = 0, hi = EDGE_MOST_DEFLECTION * j->floes->thickness[p->floe], stiffness;
    double below = excess(j, p, e, lo, &stiffness), above = excess(j, p, e, hi, &stiffness);
    *balance = above > 0;
    if (!*balance)
        return hi;
    for (int i = 0; i < MOST_GIVE_TURNS && hi - lo > GIVE_PRECISION * hi; i++) {
        double at = i % 3 == 2 ? 0.5 * (lo + hi) : lo + (hi - lo) * below / (below - above);
        at = at > lo && at < hi ? at : 0.5 * (lo + hi);
        double now = excess(j, p, e, at, &stiffness);
        if (now > 0) {
            hi = at;
            above = now;
        } else {
            lo = at;
            below = now;
        }
    }
    return lo;
}

/* An edge that breaks within a step would be loaded on to the step's end, at any multiple of what breaks it: a load is
   held to this part of that, more than what is not known of the ice and of friction makes. */
static const double BREAKS_WITHIN = 1.1;

/* Turns in which the load that breaks an edge with inertia and the time of its rise follow each other. */
enum { BREAK_TURNS = 3 };

/* The whole load to which one of this size [N] is held, at the end of a step. */
static double most_load(const crushing_job *j, const crushing_pair *p, const loaded_edge *e,
                        const patch_component *left, double load)
{
    double dt = j->settings->time_step, level = fabs(left->area.z) / e->stand.part, most = load;
    ice_material ice = strength_flexural_at(&j->settings->strength, NULL, j->floes, p->floe,
                                            vec2_make(left->centre.x, left->centre.y));
    edge_stand stand = e->stand;
    for (int turn = 0; turn < (j->settings->edges.inertia ? BREAK_TURNS : 1); turn++) {
        stand.rise = edge_rise_time(stand.impulse + most * dt, most);
        most = fmin(load, BREAKS_WITHIN * edge_breaking_load(&j->settings->edges, &ice, j->floes->thickness[p->floe],
                                                             level, stand, load));
    }
    return most;
}

/* No more than breaks the edge, once: ice that did not break then bears more, since others lift what this presses down,
   and is loaded on as it is. */
static void limit_to_break(const crushing_job *j, const crushing_pair *p, const loaded_edge *e,
                           const patch_component *left, patch_bearing *bearing)
{
    double load = bearing->pressure * fabs(left->area.z) * e->share / e->stand.part;
    double most = load > 0 ? most_load(j, p, e, left, load) : load;
    if (!(most < load))
        return;
    bearing->over = e->stand.known;
    if (!e->stand.over)
        bearing->pressure *= most / load;
}

patch_component crushing_give_way(const crushing_job *j, const crushing_pair *p, const patch_component *c,
                                  int32_t number, patch_bearing *bearing)
{
    double reach =
        edge_reach(&j->settings->edges, &j->floes->material[p->floe], j->floes->thickness[p->floe], fabs(c->area.z));
    vec3 centre = vec3_add(p->position, mat3_mul_vec(p->rotation, c->centre));
    loaded_edge e = {.whole = c, .number = number, .sign = c->area.z < 0 ? -1 : 1, .share = share_of_friction(j, p, c)};
    e.stand =
        j->supports ? edge_stand_find(j->supports, j->bodies, p->surface_body, centre, reach) : EDGE_STAND_STRAIGHT;
    e.stand.rise += j->settings->time_step;
    bool balance;
    double give = find_give(j, p, &e, &balance), stiffness;
    patch_component left = patch_left(j->room, &p->prism, number, e.sign * give);
    excess(j, p, &e, give, &stiffness);
    bearing->pressure = crushing_component_pressure(j, p, c, vec3_length(left.area));
    if (balance && give > 0 && left.area.z != 0)
        bearing->pressure = fmin(bearing->pressure, stiffness * give * e.stand.part / (fabs(left.area.z) * e.share));
    bearing->compliance = left.area.z != 0 ? 1 / (e.stand.part * stiffness) : 0;
    limit_to_break(j, p, &e, &left, bearing);
    return left;
}

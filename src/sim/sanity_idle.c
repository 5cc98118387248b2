/* Keys that were set and decide nothing, since another key leaves them without a meaning; see sim/sanity.h. */
#include "sim/sanity_parts.h"

#include <stdio.h>
#include <string.h>

/* What a rule asks of: the scenario, and the vessel whose key it is (NULL for keys that are of none). */
typedef struct question {
    const scenario *s;
    const scenario_vessel *v;
} question;

/* A key, or all keys of a section where it ends with a dot (without indices, vessels in a list as the one), what leaves
   them idle, and the sentence about it.  The first rule that fits counts. */
typedef struct idle_rule {
    const char *key;
    bool (*idle)(const question *q);
    const char *why;
} idle_rule;

static bool is_no_sheet(const question *q) { return q->s->ice.source != ICE_LEVEL; }
static bool is_no_file(const question *q) { return q->s->ice.source != ICE_FILE; }
static bool is_no_list(const question *q) { return q->s->ice.source != ICE_FLOES; }
static bool is_no_voronoi(const question *q) { return q->s->ice.source != ICE_VORONOI; }
static bool is_of_cells(const question *q) { return is_no_voronoi(q) || q->s->ice.populations.count > 0; }
static bool is_no_field(const question *q) { return !is_no_list(q) || !is_no_sheet(q) || q->s->ice.source == ICE_NONE; }
static bool draws_nothing(const question *q)
{
    return is_no_field(q) || (q->s->ice.source == ICE_FILE && q->s->ice.populations.count == 0);
}
static bool is_unbreakable(const question *q) { return !q->s->ice.breakable; }
static bool is_even(const question *q)
{
    return q->s->ice.strength.flexural_variation == 0 && q->s->ice.strength.crushing_variation == 0;
}
static bool is_awake(const question *q) { return q->s->ice.sleep_speed == 0; }
static bool never_yields(const question *q) { return !q->s->ice.cap_ice_ice; }

static bool is_unfed(const question *q) { return q->s->domain.boundary != DOMAIN_FEEDING; }
static bool is_no_endless_field(const question *q) { return is_unfed(q) || !is_no_sheet(q); }
static bool has_own_drift(const question *q) { return is_automatic(q->s->domain.drift_speed); }
static bool has_no_walls(const question *q) { return q->s->domain.boundary != DOMAIN_WALLS; }

static bool is_not_accurate(const question *q) { return q->s->run.solver.kind != SOLVER_ACCURATE; }

static bool is_own_hull(const question *q) { return sanity_own_hull(q->v); }
static bool is_mesh(const question *q) { return !sanity_own_hull(q->v); }
static bool is_no_ship(const question *q) { return q->v->hull.form != HULL_SHIP; }
static bool has_path(const question *q) { return q->v->path.count > 0; }
static bool is_free(const question *q) { return q->v->mode == VESSEL_FREE; }
static bool has_no_lines(const question *q) { return q->v->mooring.lines.count == 0; }
static bool is_not_positioned(const question *q) { return !q->v->positioning.active; }
static bool is_passive(const question *q) { return q->v->positioning.observer != OBSERVER_KALMAN; }
static bool is_kalman(const question *q) { return !is_passive(q); }
static bool feeds_nothing(const question *q) { return q->v->positioning.feed_forward == FEED_NONE; }
static bool feeds_no_measured(const question *q) { return q->v->positioning.feed_forward != FEED_MEASURED; }
static bool keeps_heading(const question *q) { return q->v->positioning.heading != HEADING_VANING; }
static bool drives_not(const question *q) { return is_automatic(q->v->propulsion.bollard_pull); }
static bool has_no_pattern(const question *q) { return q->v->propulsion.pattern.kind == PATTERN_NONE; }
static bool goes_ahead(const question *q) { return q->v->propulsion.pattern.kind == PATTERN_AHEAD; }
static bool watches_not(const question *q) { return is_automatic(q->v->approach.limit); }
static bool has_no_wash(const question *q) { return !q->v->wash.active; }
static bool is_no_estimate(const question *q) { return q->v->hydrodynamics.source != HYDRODYNAMICS_ESTIMATE; }
static bool is_not_given(const question *q) { return q->v->hydrodynamics.source != HYDRODYNAMICS_GIVEN; }

static const char OWN_FORM[] = "hull.form is not file", MESH[] = "with hull.form file the mesh has its own";
static const char UNBREAKABLE[] = "ice.breakable is false";
static const char PATH[] = "the vessel goes along its path", NO_VANING[] = "positioning.heading is not vaning";

static const idle_rule rules[] = {
    {"run.solver.most_iterations", is_not_accurate, "run.solver.kind is not accurate"},
    {"ice.level.", is_no_sheet, "ice.source is not level"},
    {"ice.file_coordinates", is_no_file, "ice.source is not file"},
    {"ice.file_scale", is_no_file, "ice.source is not file"},
    {"ice.file_x", is_no_file, "ice.source is not file"},
    {"ice.file_y", is_no_file, "ice.source is not file"},
    {"ice.file_centre", is_no_file, "ice.source is not file"},
    {"ice.simplify", is_no_file, "ice.source is not file"},
    {"ice.bad_rings", is_no_file, "ice.source is not file"},
    {"ice.concentration", draws_nothing, "no floes are drawn (ice.source voronoi or packed, or ice.populations)"},
    {"ice.mean_floe_area", is_of_cells, "floes are not cells of ice.source voronoi without populations"},
    {"ice.size_deviation", is_no_voronoi, "ice.source is not voronoi"},
    {"ice.roundness", is_no_voronoi, "ice.source is not voronoi"},
    {"ice.open_water", is_no_field, "ice.source is neither voronoi nor file nor packed"},
    {"ice.populations", is_no_field, "ice.source is neither voronoi nor file nor packed"},
    {"ice.floes", is_no_list, "ice.source is not floes"},
    {"ice.strength.correlation_length", is_even, "neither strength varies (ice.strength)"},
    {"ice.strength.common", is_even, "neither strength varies (ice.strength)"},
    {"ice.ridging_resistance", never_yields, "ice.cap_ice_ice is false"},
    {"ice.rafting_edge_angle_deg", never_yields, "ice.cap_ice_ice is false"},
    {"ice.sleep_time", is_awake, "ice.sleep_speed is 0: nothing sleeps"},
    {"ice.fracture.wedges", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.sharing", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.radius_along", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.load_over", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.edge_compliance", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.edge_elastic", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.edge_inertia", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.edge_gaps", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.edge_melts", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.splitting", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.splitting_factor", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.toughness", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.narrowness", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.thick_plate_radius", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.wide_contacts", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.joint_loads", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.under_pieces", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.wedge_room", is_unbreakable, UNBREAKABLE},
    {"domain.band", is_no_endless_field, "no field of floes is fed (domain.boundary feeding)"},
    {"domain.tile_x", is_no_endless_field, "no field of floes is fed (domain.boundary feeding)"},
    {"domain.tile_y", is_no_endless_field, "no field of floes is fed (domain.boundary feeding)"},
    {"domain.drift_direction_deg", has_own_drift, "there is no domain.drift_speed"},
    {"domain.wall_height", has_no_walls, "domain.boundary is not walls"},
    {"domain.wall_thickness", has_no_walls, "domain.boundary is not walls"},
    {"vessel.x", has_path, PATH},
    {"vessel.y", has_path, PATH},
    {"vessel.heading_deg", has_path, PATH},
    {"vessel.speed", has_path, PATH},
    {"vessel.course_deg", has_path, PATH},
    {"vessel.ramp", has_path, PATH},
    {"vessel.ramp", is_free, "mode is free"},
    {"vessel.hull.file_scale", is_own_hull, OWN_FORM},
    {"vessel.hull.seal_width", is_own_hull, OWN_FORM},
    {"vessel.hull.repair", is_own_hull, OWN_FORM},
    {"vessel.hull.piece_distance", is_own_hull, OWN_FORM},
    {"vessel.hull.most_pieces", is_own_hull, OWN_FORM},
    {"vessel.hull.length", is_mesh, MESH},
    {"vessel.hull.beam", is_mesh, MESH},
    {"vessel.hull.draught", is_mesh, MESH},
    {"vessel.hull.stem_angle_deg", is_mesh, MESH},
    {"vessel.hull.entrance_angle_deg", is_mesh, MESH},
    {"vessel.hull.flare_angle_deg", is_mesh, MESH},
    {"vessel.hull.stern_angle_deg", is_mesh, MESH},
    {"vessel.hull.parallel_midbody", is_mesh, MESH},
    {"vessel.hull.block_coefficient", is_mesh, MESH},
    {"vessel.hull.bilge_radius", is_no_ship, "hull.form is not ship"},
    {"vessel.hull.transom", is_no_ship, "hull.form is not ship"},
    {"vessel.mooring.depth", has_no_lines, "there are no mooring.lines"},
    {"vessel.mooring.turret", has_no_lines, "there are no mooring.lines"},
    {"vessel.positioning.", is_not_positioned, "positioning.active is false"},
    {"vessel.positioning.bias_rate", is_passive, "positioning.observer is not kalman"},
    {"vessel.positioning.force_noise", is_passive, "positioning.observer is not kalman"},
    {"vessel.positioning.observer_bandwidth", is_kalman, "positioning.observer is not passive"},
    {"vessel.positioning.feed_forward_gain", feeds_nothing, "positioning.feed_forward is none"},
    {"vessel.positioning.feed_forward_time", feeds_no_measured, "positioning.feed_forward is not measured"},
    {"vessel.positioning.vaning_rate_deg", keeps_heading, NO_VANING},
    {"vessel.positioning.vaning_time", keeps_heading, NO_VANING},
    {"vessel.positioning.vaning_load", keeps_heading, NO_VANING},
    {"vessel.propulsion.", drives_not, "there is no propulsion.bollard_pull"},
    {"vessel.propulsion.pattern.", has_no_pattern, "propulsion.pattern.kind is none"},
    {"vessel.propulsion.pattern.width", goes_ahead, "the way ahead has none (propulsion.pattern.kind)"},
    {"vessel.approach.look_ahead", watches_not, "there is no approach.limit"},
    {"vessel.wash.", has_no_wash, "wash.active is false"},
    {"vessel.hydrodynamics.heave_damping", is_no_estimate, "hydrodynamics.source is not estimate"},
    {"vessel.hydrodynamics.roll_damping", is_no_estimate, "hydrodynamics.source is not estimate"},
    {"vessel.hydrodynamics.pitch_damping", is_no_estimate, "hydrodynamics.source is not estimate"},
    {"vessel.hydrodynamics.axes", is_not_given, "hydrodynamics.source is not given"},
    {"vessel.hydrodynamics.added_mass", is_not_given, "hydrodynamics.source is not given"},
    {"vessel.hydrodynamics.damping", is_not_given, "hydrodynamics.source is not given"},
};

static bool fits(const char *rule, const char *key)
{
    size_t n = strlen(rule);
    return rule[n - 1] == '.' ? strncmp(rule, key, n) == 0 : strcmp(rule, key) == 0;
}

static const idle_rule *idle_rule_of(const char *pattern, const question *q)
{
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        if (fits(rules[i].key, pattern) && rules[i].idle(q))
            return &rules[i];
    return NULL;
}

/* Whether a key says something else than when it is left out. */
static bool is_set(const scenario_key *key, const void *member, double scale)
{
    double value;
    switch (key->kind) {
    case KEY_REAL:
        value = key_number(key, member);
        return is_automatic(value) ? !key->automatic : key->automatic || value != key_default(key, scale);
    case KEY_INTEGER:
    case KEY_BOOLEAN:
        return key_number(key, member) != key->value;
    case KEY_CHOICE:
        return choice_value(member) != (int32_t)key->value;
    case KEY_TEXT:
    case KEY_PATH:
        return strcmp((const char *)member, key->text) != 0;
    default:
        return list_count(member) > 0;
    }
}

/* The keys of one rule that stand one after the other, told in one sentence. */
typedef struct idle_group {
    teller *t;
    const idle_rule *rule;
    char first[SANITY_SENTENCE]; /* path */
    int32_t more;
} idle_group;

static void tell_group(idle_group *g)
{
    char others[32] = "";
    if (g->rule && g->more > 0)
        snprintf(others, sizeof others, " and %d more", (int)g->more);
    if (g->rule)
        sanity_say(g->t->tell, g->t->to, "%s%s: without effect, since %s", g->first, others, g->rule->why);
    g->rule = NULL;
}

/* The vessel of a path: of the list, or the one. */
static const scenario_vessel *vessel_of(const scenario *s, const char *path)
{
    int item = 0;
    if (sscanf(path, "vessels[%d]", &item) == 1 && item >= 0 && item < s->vessels.count)
        return &s->vessels.data[item];
    return &s->vessel;
}

static fram_status look_at_key(void *user, const scenario_key *key, const void *member, const char *path,
                               fram_error *error)
{
    (void)error;
    idle_group *g = user;
    const scenario *s = g->t->s;
    /* What an item of an idle list says is idle with it. */
    const char *item = strncmp(path, "vessels[", 8) == 0 ? strchr(path, ']') : path;
    const question q = {s, vessel_of(s, path)};
    bool absent = strncmp(path, "vessel", 6) == 0 && !q.v->present;
    if (absent || strchr(item, '[') || !is_set(key, member, s->run.scale))
        return FRAM_OK;
    char pattern[SANITY_PATTERN];
    sanity_pattern(path, pattern);
    const idle_rule *rule = idle_rule_of(pattern, &q);
    if (!rule)
        return FRAM_OK;
    if (g->rule == rule && g->rule->key[strlen(g->rule->key) - 1] == '.' && vessel_of(s, g->first) == q.v) {
        g->more++;
        return FRAM_OK;
    }
    tell_group(g);
    g->rule = rule;
    g->more = 0;
    snprintf(g->first, sizeof g->first, "%s", path);
    return FRAM_OK;
}

void sanity_tell_idle(const scenario *s, sanity_teller tell, const void *to)
{
    teller t = {s, tell, to, NULL};
    idle_group group = {.t = &t};
    (void)scenario_walk(s, look_at_key, &group, NULL);
    tell_group(&group);
}

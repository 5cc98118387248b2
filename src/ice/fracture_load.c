/* Loads of crushing patches on floes, and the stresses they make (Metrikin 2014, 5.5). */
#include "ice/fracture_parts.h"

#include "base/pool.h"
#include "base/transcendental.h"
#include "ice/sheet.h"
#include "ice/strip.h"

#include <stdlib.h>

/* A load that is a point makes infinite stress in a thin plate; this a/l is a point. */
static const double POINT_LOAD = 1e-3;

/* Patches nearer than this part of a cell to one another meet on its side. */
static const double SAME_LINE = 1e-7;

edge_stress fracture_edge_stress(const fracture_settings *settings, const ice_material *ice, double thickness,
                                 double load, double horizontal_area, edge_ice edge)
{
    double h = thickness;
    edge_stress s = {.length = ice_characteristic_length(ice, h, settings->water_density, settings->gravity)};
    s.radial_radius = fracture_loaded_radius(horizontal_area, PI / 2, h, settings->thick_plate_radius);
    s.radial_radius = fmax(s.radial_radius, s.length * sheet_disk_of_strip(edge.strip / 2 / s.length));
    double radial = sheet_stress(fmax(s.radial_radius / s.length, POINT_LOAD), ice->poisson_ratio);
    s.radial_stress = radial * load / (h * h);
    s.radial_capacity = ice->flexural_strength * h * h / radial;
    if (edge.strip > 0) {
        strip b = strip_solve(edge.length / s.length);
        s.strip_length = s.length * b.x_max;
        s.strip_capacity = ice->flexural_strength * edge_strip_bears(edge.strip, b.moment * s.length, h);
    }
    const edge_compliance edges = fracture_edges(settings);
    edge_bearing b = edge_bears(&edges, ice, h, horizontal_area, edge.wedges, s.strip_capacity);
    s.wedge_radius = b.radius;
    s.wedge_capacity = b.load;
    s.wedge_stress = ice->flexural_strength * load / b.load;
    s.breaking_radius = s.length * b.place;
    wedge_ramp r = edge_rise(&edges, ice, h, s.wedge_radius, edge.rise);
    s.inertia = r.moment;
    s.wedge_stress *= r.moment;
    s.wedge_capacity /= r.moment;
    s.strip_capacity /= r.moment;
    s.breaking_radius *= r.place;
    s.strip_length *= r.place;
    return s;
}

/* Whether a surface goes up or down past the floe by itself, more than its face does as it crushes on. */
static bool slides_upright(const body_table *bodies, const crushing_patch *p, vec3 up)
{
    vec3 past = body_velocity_past(bodies, p->surface_body, p->floe_body, p->centre);
    return fabs(vec3_dot(past, up)) > fabs(vec3_dot(past, p->normal) * vec3_dot(p->normal, up));
}

/* At which a surface comes up through a place in the ice, along the floe's z [m/s]. */
static double face_rate(const body_table *bodies, const crushing_patch *p, const mat3 *rotation)
{
    double level = vec3_dot(p->normal, mat3_column(*rotation, 2));
    vec3 past = body_velocity_past(bodies, p->surface_body, p->floe_body, p->centre);
    return level != 0 ? vec3_dot(past, p->normal) / level : 0;
}

/* Impulse of a patch on its floe, floe frame [N s].  Friction on a face that crushes on holds what the pressure presses
   down or up, and does not press it the other way: on a steep face the ice goes along with the hull (decision 0553). */
static vec3 patch_impulse(const fracture_state *state, const crushing_patch *p, const mat3 *rotation)
{
    vec3 sum = {0, 0, 0}, up = mat3_column(*rotation, 2);
    double pressed = 0;
    for (int32_t i = p->contact_first; i < p->contact_first + p->contact_count; i++) {
        const contact *c = &state->contacts->data[i];
        sum = vec3_add(sum, contact_impulse(c));
        pressed += c->impulse[0] * vec3_dot(c->normal, up);
    }
    sum = mat3_tmul_vec(*rotation, sum);
    if (sum.z * pressed < 0 && !slides_upright(state->bodies, p, up))
        sum.z = 0;
    return sum;
}

/* Mean squares of a patch about its place, from its points: these have the second moments of the patch. */
static void spread_of(const crushing_patch *p, const fracture_state *state, int32_t body, bool in_plan, double out[3])
{
    vec3 at = in_plan ? p->centre : body_to_local(state->bodies, body, p->centre);
    out[0] = out[1] = out[2] = 0;
    for (int32_t i = p->contact_first; i < p->contact_first + p->contact_count; i++) {
        vec3 point = state->contacts->data[i].point;
        vec3 d = vec3_sub(in_plan ? point : body_to_local(state->bodies, body, point), at);
        out[0] += d.x * d.x / p->contact_count;
        out[1] += d.x * d.y / p->contact_count;
        out[2] += d.y * d.y / p->contact_count;
    }
}

/* Half of the areas that cancel in a patch, over what is left: two sides of a wedge of half angle b, each of area S,
   leave 2 S sin b of 2 S and cancel S cos b. */
static double aside_of(const crushing_patch *p)
{
    double cancelled = p->surface_area * p->surface_area - p->area * p->area;
    return cancelled > 0 ? sqrt(cancelled) / (2 * p->area) : 0;
}

/* Bounds of a patch in the plan of a sheet whose tile is one of its bodies; where the other one is the floe they are
   those of its own frame, turned, as far as they lie in the tile's cell. */
static box2 patch_plan(const tile_grid *g, const crushing_patch *p, const fracture_state *state, int32_t tile, bool own)
{
    vec3 at = state->bodies->position[p->floe_body];
    box2 in = p->plan, out = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    if (own || !tile)
        return (box2){{in.lo.x + at.x, in.lo.y + at.y}, {in.hi.x + at.x, in.hi.y + at.y}};
    double z = body_to_local(state->bodies, p->floe_body, p->centre).z;
    for (int i = 0; i < 4; i++) {
        vec3 corner = {i & 1 ? in.hi.x : in.lo.x, i & 2 ? in.hi.y : in.lo.y, z};
        vec3 c = body_to_global(state->bodies, p->floe_body, corner);
        out.lo = (vec2){fmin(out.lo.x, c.x), fmin(out.lo.y, c.y)};
        out.hi = (vec2){fmax(out.hi.x, c.x), fmax(out.hi.y, c.y)};
    }
    box2 cell = tile_cell(g, tile - 1);
    return (box2){{fmax(out.lo.x, cell.lo.x), fmax(out.lo.y, cell.lo.y)},
                  {fmin(out.hi.x, cell.hi.x), fmin(out.hi.y, cell.hi.y)}};
}

/* The load of a patch on one of its two bodies: contacts push the floe, and its surface the other way. */
static bool add_load(context *ctx, fracture_scratch *s, const fracture_settings *settings,
                     const crushing_patch_array *patches, int32_t patch, const fracture_state *state, int32_t body)
{
    const crushing_patch *p = &patches->data[patch];
    int32_t floe = state->bodies->owner[body];
    if (!state->floes->breakable[floe])
        return true;
    int32_t tile = state->floes->tile[floe];
    mat3 rotation = quat_matrix(state->bodies->orientation[body]);
    vec3 place = tile ? p->centre : body_to_local(state->bodies, body, p->centre);
    bool own = body == p->floe_body;
    double onto = own ? 1 : -1;
    fracture_load l = {.body = body,
                       .floe = floe,
                       .patch = patch,
                       .tile = tile,
                       .surface = own ? p->surface_body : p->floe_body,
                       .vector = vec3_scale(patch_impulse(state, p, &rotation), onto / settings->time_step),
                       .normal = vec3_scale(mat3_tmul_vec(rotation, p->normal), onto),
                       .aside = aside_of(p),
                       .place = {place.x, place.y},
                       .plan = patch_plan(&settings->tiles, p, state, tile, own),
                       .area = p->area,
                       .horizontal_area =
                           own ? p->horizontal_area : p->area * fabs(mat3_tmul_vec(rotation, p->normal).z),
                       .thickness = state->floes->thickness[floe],
                       .ice = state->floes->material[floe]};
    if (settings->wide_contacts)
        spread_of(p, state, body, tile != 0, l.spread);
    l.rise = own ? p->compliance * l.vector.z : 0;
    l.rate = own ? face_rate(state->bodies, p, &rotation) : 0;
    return array_push(ctx, &s->load.all, l);
}

/* ---- patches that a seam divides ---- */

static double gap(double lo, double hi, double other_lo, double other_hi) { return fmax(lo - other_hi, other_lo - hi); }

/* Two patches of one surface in neighbouring cells that both reach the line between these, at the same place. */
static bool is_one_patch(const tile_grid *g, const fracture_load *a, const fracture_load *b)
{
    int32_t i = (b->tile - 1) % g->columns - (a->tile - 1) % g->columns;
    int32_t k = (b->tile - 1) / g->columns - (a->tile - 1) / g->columns;
    if (a->surface != b->surface || i * i + k * k != 1)
        return false;
    box2 cell = tile_cell(g, a->tile - 1);
    double reach = SAME_LINE * (cell.hi.x - cell.lo.x + cell.hi.y - cell.lo.y);
    return gap(a->plan.lo.x, a->plan.hi.x, b->plan.lo.x, b->plan.hi.x) <= reach &&
           gap(a->plan.lo.y, a->plan.hi.y, b->plan.lo.y, b->plan.hi.y) <= reach;
}

static void merge_into(fracture_load *a, const fracture_load *b)
{
    double area = a->area + b->area, share = area > 0 ? b->area / area : 0.5;
    vec2 apart = vec2_sub(b->place, a->place);
    const double between[3] = {apart.x * apart.x, apart.x * apart.y, apart.y * apart.y};
    for (int i = 0; i < 3; i++)
        a->spread[i] = (1 - share) * a->spread[i] + share * b->spread[i] + share * (1 - share) * between[i];
    a->vector = vec3_add(a->vector, b->vector);
    a->rise = fabs(b->rise) > fabs(a->rise) ? b->rise : a->rise;
    a->place = vec2_add(a->place, vec2_scale(vec2_sub(b->place, a->place), share));
    a->plan.lo = (vec2){fmin(a->plan.lo.x, b->plan.lo.x), fmin(a->plan.lo.y, b->plan.lo.y)};
    a->plan.hi = (vec2){fmax(a->plan.hi.x, b->plan.hi.x), fmax(a->plan.hi.y, b->plan.hi.y)};
    a->area = area;
    a->horizontal_area += b->horizontal_area;
}

/* The least load that is one with load i. */
static int32_t root_of(const int32_t *root, int32_t i)
{
    while (root[i] != i)
        i = root[i];
    return i;
}

static bool merge_seams(context *ctx, fracture_scratch *s, const tile_grid *g)
{
    fracture_load_array *l = &s->load.all;
    if (!array_resize(ctx, &s->load.root, l->count))
        return false;
    int32_t *root = s->load.root.data, kept = 0;
    for (int32_t i = 0; i < l->count; i++) {
        root[i] = i;
        for (int32_t k = 0; k < i && l->data[i].tile; k++) {
            if (!l->data[k].tile || !is_one_patch(g, &l->data[k], &l->data[i]))
                continue;
            int32_t a = root_of(root, i), b = root_of(root, k);
            root[a > b ? a : b] = a > b ? b : a;
        }
    }
    for (int32_t i = 0; i < l->count; i++)
        if (root_of(root, i) != i)
            merge_into(&l->data[root_of(root, i)], &l->data[i]);
    for (int32_t i = 0; i < l->count; i++)
        if (root_of(root, i) == i)
            l->data[kept++] = l->data[i];
    l->count = kept;
    return true;
}

/* ---- which fail ---- */

/* 6/b0 eta'' and sigma_yy h^2/P are both under this for a/l of POINT_LOAD and more, and fall from there. */
static const double MOST_STRESS = 12;

/* Loads under this part of the strength fail in no way on a straight edge; vibration adds a twentieth at most.  Less
   ice than a spike of 8 degrees has is at no start: a cleaned outline has no sharper corner. */
static bool may_fail(const fracture_settings *settings, const fracture_load *l)
{
    static const double SPIKE = 8.0 / 180;
    double least = settings->sharing == SHARING_EQUAL ? 1 : SPIKE, h = l->thickness;
    return MOST_STRESS * WEDGE_RAMP_MOST_MOMENT * (l->force + l->near) >= least * l->ice.flexural_strength * h * h;
}

/* Whether a load is too small for the first crack, wherever it stands. */
static bool radial_holds(const fracture_load *l)
{
    return MOST_STRESS * l->force < l->ice.flexural_strength * l->thickness * l->thickness;
}

/* Part of N whole wedges of which a force needs more to stand on.  Nevel's C is at least 1, that of a load on a point.
 */
static double ice_needed(const fracture_load *l, double force, double width)
{
    double h = l->thickness, strength = l->ice.flexural_strength * h * h;
    return 6 * (WEDGE_RAMP_MOST_MOMENT * force) / (strength * width);
}

/* Loads of pieces on held ice are looked at that would break what a corner has of this part of an edge's ice. */
static const double LEAST_CORNER = 0.125;

/* Whether a piece presses too little on held ice to be looked at.  width: of N wedges, N b0. */
static bool is_slight(const fracture_job *j, const fracture_load *l, double width)
{
    return body_is_held(j->state->bodies, l->body) && j->state->bodies->material[l->surface] == MATERIAL_ICE &&
           ice_needed(l, l->force, width) < LEAST_CORNER;
}

/* Whether a load fails in no way, by what costs little to know: nearly all are so small.  What held ice stands on under
   a vessel is wanted whether it fails or not, unless it could not even at a corner. */
static bool surely_holds(const fracture_job *j, fracture_load *l, double width)
{
    /* More than rounding of the areas that are compared in the end. */
    static const double SURELY = 0.99;
    if (!may_fail(j->settings, l))
        return true;
    if (l->tile || body_is_held(j->state->bodies, l->body))
        return false;
    return radial_holds(l) && ice_needed(l, l->force + l->near, width) < SURELY * fracture_least_ice(j, l);
}

/* Whether a load on this ice fails at all; a sheet of tiles breaks in bending alone. */
static bool fails(const fracture_settings *settings, const fracture_load *l, edge_ice edge)
{
    double h = l->thickness, strength = l->ice.flexural_strength * h * h;
    double force = WEDGE_RAMP_MOST_MOMENT * (l->force + l->near);
    double length = ice_characteristic_length(&l->ice, h, settings->water_density, settings->gravity);
    double wedges = settings->wedges * fracture_wedge_width(settings->wedges) * edge.wedges;
    /* Beside a wide load the strip bears less of what others make there. */
    double between = l->near > 0 ? 0 : edge.strip / (STRIP_MOST_MOMENT * length);
    if (6 * force >= strength * (wedges + between))
        return true;
    if (l->tile || radial_holds(l))
        return false;
    double radius = fracture_loaded_radius(l->horizontal_area, PI / 2, h, settings->thick_plate_radius);
    return sheet_stress(fmax(radius / length, POINT_LOAD), l->ice.poisson_ratio) * l->force >= strength;
}

/* With SPLITTING_TOUGHNESS a floe of its own splits by its load in the plane, whatever bends it. */
static double split_ratio(const fracture_job *j, fracture_load *l)
{
    if (j->settings->splitting != SPLITTING_TOUGHNESS || l->tile)
        return 0;
    polygon outline = shape_outline(j->state->shapes, j->state->bodies->shape[l->body]);
    double length;
    crack_start start = crack_start_of(outline, l->place, CRACK_CORNER_REACH * fracture_reach(j, l));
    return fracture_split_ratio(j->settings, outline, l, l->thickness, &start, &length);
}

/* In the frame of the floe; of a sheet that of the load's tile [m]. */
static vec2 place_on_floe(const fracture_state *state, const fracture_load *l)
{
    vec3 at = state->bodies->position[l->body];
    return l->tile ? vec2_sub(l->place, vec2_make(at.x, at.y)) : l->place;
}

static bool is_over(const fracture_load *l)
{
    return l->radial_ratio >= 1 || l->wedge_ratio >= 1 || l->split_ratio >= 1;
}

static void find_stress(const fracture_job *j, int32_t i)
{
    fracture_load *l = &j->scratch->load.all.data[i];
    const edge_ice edge = j->scratch->load.edges.data[i];
    l->stress = fracture_edge_stress(j->settings, &l->ice, l->thickness, l->force, l->horizontal_area, edge);
    l->radial_ratio = l->stress.radial_stress / l->ice.flexural_strength;
    l->wedge_ratio = l->stress.wedge_stress / l->ice.flexural_strength;
}

/* Whether the edge may break under a load with those that are near: none makes more of its force than the wedges there
   bear. */
static bool load_may_join(const fracture_load *l)
{
    double wedges = l->stress.wedge_capacity - l->stress.strip_capacity;
    return l->near > 0 && l->start.distance >= 0 && l->wedge_ratio * wedges + l->near >= wedges;
}

/* A load whose ice is known: its stresses, and whether it fails by itself. */
static void judge_load(const fracture_job *j, int32_t i, edge_ice edge)
{
    fracture_load *l = &j->scratch->load.all.data[i];
    edge.rise = j->scratch->load.rises.data[i].time;
    l->beam = edge.wedges <= EDGE_LEAST_ICE;
    l->known = j->scratch->load.rises.data[i].known = true;
    l->fate = LOAD_HOLDS;
    j->scratch->load.edges.data[i] = edge;
    if (l->split_ratio < 1 && !fails(j->settings, l, edge))
        return;
    find_stress(j, i);
    l->fate = load_may_join(l) ? LOAD_JOINT : is_over(l) ? LOAD_FAILS : LOAD_HOLDS;
}

/* Loads of a block: an overlap of a floe and sectors takes some microseconds. */
enum { BLOCK_LOADS = 8 };

/* Its size, and the ice there: the noise of strength fields is remembered, which one thread does. */
static void read_load(const fracture_job *j, fracture_load *l)
{
    l->force = fabs(l->vector.z);
    l->ice = strength_flexural_at(&j->settings->strength, &j->scratch->load.strengths, j->state->floes, l->floe,
                                  place_on_floe(j->state, l));
    l->plane_force = sqrt(l->vector.x * l->vector.x + l->vector.y * l->vector.y);
    l->opening_force = fmax(l->plane_force, fabs(vec3_dot(l->vector, l->normal)) * l->aside);
}

/* All that one load tells by itself; loads on sheets, which share one index of tiles, are left open. */
static void weigh_block(void *arg, int32_t block, int32_t thread)
{
    const fracture_job *j = arg;
    load_work *w = &j->scratch->load;
    double width = j->settings->wedges * fracture_wedge_width(j->settings->wedges);
    (void)thread;
    for (int32_t i = BLOCK_LOADS * block; i < w->all.count && i < BLOCK_LOADS * (block + 1); i++) {
        fracture_load *l = &w->all.data[i];
        w->edges.data[i] = EDGE_STRAIGHT;
        l->split_ratio = split_ratio(j, l);
        l->fate = LOAD_HOLDS;
        if (l->split_ratio < 1 && is_slight(j, l, width))
            continue;
        l->near = fracture_near_force(j, l);
        if (l->split_ratio < 1 && surely_holds(j, l, width))
            continue;
        if (l->tile)
            l->fate = LOAD_OPEN;
        else
            judge_load(j, i, fracture_floe_ice(j, l));
    }
}

static fram_status judge_open(const fracture_job *j)
{
    fracture_load_array *all = &j->scratch->load.all;
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < all->count && status == FRAM_OK; i++) {
        edge_ice edge;
        if (all->data[i].fate != LOAD_OPEN)
            continue;
        status = fracture_sheet_ice(j, &all->data[i], &edge);
        if (status == FRAM_OK)
            judge_load(j, i, edge);
    }
    return status;
}

/* Loads bend the edge together; the sum of a place may be that of a load which by itself was dismissed. */
static fram_status judge_jointly(const fracture_job *j)
{
    fracture_load_array *all = &j->scratch->load.all;
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < all->count && status == FRAM_OK; i++)
        if (all->data[i].fate == LOAD_JOINT)
            status = fracture_join(j, i);
    for (int32_t i = 0; i < all->count && status == FRAM_OK; i++) {
        fracture_load *l = &all->data[i];
        if (l->joint_ratio >= 1 && !(l->stress.length > 0))
            find_stress(j, i);
        l->wedge_ratio = fmax(l->wedge_ratio, l->joint_ratio);
        l->fate = is_over(l) ? LOAD_FAILS : LOAD_HOLDS;
    }
    return status;
}

/* Stresses of all loads; those that fail in no way go. */
static fram_status keep_failing(const fracture_job *j)
{
    fracture_load_array *all = &j->scratch->load.all;
    int32_t kept = 0;
    if (!array_resize(j->ctx, &j->scratch->load.edges, all->count))
        return error_memory(j->error);
    for (int32_t i = 0; i < all->count; i++)
        read_load(j, &all->data[i]);
    if (!fracture_note_joint(j))
        return error_memory(j->error);
    fracture_job job = *j;
    pool_run(j->ctx, weigh_block, &job, (all->count + BLOCK_LOADS - 1) / BLOCK_LOADS);
    fram_status status = judge_open(j);
    if (status == FRAM_OK)
        status = judge_jointly(j);
    for (int32_t i = 0; i < all->count; i++)
        if (all->data[i].fate == LOAD_FAILS)
            all->data[kept++] = all->data[i];
    all->count = kept;
    return status;
}

/* Radial cracks run through no sheet. */
static double severity(const fracture_load *l)
{
    return l->tile ? l->wedge_ratio : fmax(fmax(l->radial_ratio, l->wedge_ratio), l->split_ratio);
}

static int compare_loads(const void *a, const void *b)
{
    const fracture_load *x = a, *y = b;
    if (!x->tile != !y->tile)
        return x->tile ? 1 : -1;
    if (!x->tile && x->body != y->body)
        return x->body < y->body ? -1 : 1;
    if (severity(x) != severity(y))
        return severity(x) > severity(y) ? -1 : 1;
    return x->patch < y->patch ? -1 : x->patch > y->patch ? 1 : 0;
}

/* Whether a load of this material may break the ice of a body. */
static bool bears_load(const fracture_job *j, int32_t body, uint8_t other)
{
    const fracture_settings *f = j->settings;
    return other != MATERIAL_ICE || f->under_ice_contacts || (f->under_pieces && body_is_held(j->state->bodies, body));
}

fram_status fracture_loads(const fracture_job *j, const crushing_patch_array *patches)
{
    context *ctx = j->ctx;
    fracture_scratch *s = j->scratch;
    array_clear(&s->load.all);
    for (int32_t i = 0; i < patches->count; i++) {
        const crushing_patch *p = &patches->data[i];
        uint8_t other = j->state->bodies->material[p->surface_body];
        if (other == MATERIAL_WALL)
            continue;
        if (bears_load(j, p->floe_body, other) && !add_load(ctx, s, j->settings, patches, i, j->state, p->floe_body))
            return error_memory(j->error);
        if (other == MATERIAL_ICE && bears_load(j, p->surface_body, other) &&
            !add_load(ctx, s, j->settings, patches, i, j->state, p->surface_body))
            return error_memory(j->error);
    }
    if (!fracture_note_parts(j, patches) || !merge_seams(ctx, s, &j->settings->tiles) || !fracture_note_rises(j))
        return error_memory(j->error);
    fram_status status = fracture_respond(j);
    if (status == FRAM_OK)
        status = keep_failing(j);
    if (status == FRAM_OK)
        status = fracture_keep_supports(j);
    if (status == FRAM_OK && s->load.all.count > 1)
        qsort(s->load.all.data, (size_t)s->load.all.count, sizeof *s->load.all.data, compare_loads);
    return status;
}

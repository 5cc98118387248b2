#include "sim/build_hull.h"

#include "base/transcendental.h"
#include "io/hull_file.h"
#include "vessel/hydrostatics.h"

#include <stdio.h>
#include <string.h>

/* A hull on its way into the store. */
typedef struct new_hull {
    mesh surface;
    polyhedron_array pieces;
    double concavity; /* of the pieces [m] */
    hull_hydrostatics floats;
} new_hull;

static hull_particulars particulars_of(const scenario *s, const scenario_hull *h)
{
    hull_particulars p = {.form = h->form,
                          .length = h->length,
                          .beam = h->beam,
                          .draught = h->draught,
                          .freeboard = scenario_freeboard(s, h),
                          .stem_angle = radians(h->stem_angle_deg),
                          .entrance_angle = radians(h->entrance_angle_deg),
                          .flare_angle = radians(h->flare_angle_deg),
                          .stern_angle = radians(h->stern_angle_deg),
                          .parallel_midbody = h->parallel_midbody,
                          .block_coefficient = automatic_or(h->block_coefficient, 0),
                          .bilge_radius = h->bilge_radius,
                          .transom = h->transom};
    hull_particulars_fill(&p);
    return p;
}

/* An error of the rooms below names a member; the scenario's key is longer, and angles are in degrees there. */
static fram_status name_hull_key(const scenario *s, const vessel_entry *entry, fram_status status, fram_error *error)
{
    if (status != FRAM_ERROR_INPUT || !error || error->file[0])
        return status;
    char member[sizeof error->key];
    memcpy(member, error->key, sizeof member);
    size_t length = strlen(member);
    bool angle = length > 6 && strcmp(member + length - 6, "_angle") == 0;
    snprintf(error->key, sizeof error->key, "hull%s%.90s%s", length ? "." : "", member, angle ? "_deg" : "");
    vessel_name_error(s, entry, error);
    return status;
}

static void report_file(context *ctx, const hull_file_report *r)
{
    log_write(ctx, LOG_INFO, "the hull is read from %d elements of %s", (int)r->elements, mesh_format_name(r->format));
    if (r->seal.joined || r->seal.splits)
        log_write(
            ctx, LOG_INFO,
            "its cracks are sealed: the widest %.3g m, %d vertices joined, edges led over a vertex %d times, %.3g "
            "m2 swept, volume integrals changed by (%.3g, %.3g, %.3g) m3",
            r->seal.width, (int)r->seal.joined, (int)r->seal.splits, r->seal.area, r->seal.volume.x, r->seal.volume.y,
            r->seal.volume.z);
    if (r->freeboard > 0)
        log_write(ctx, LOG_INFO, "its open top is raised by %.3g m and decked", r->freeboard);
    if (r->freeboard > 0 && r->top > 0)
        log_write(ctx, LOG_WARNING,
                  "hull.freeboard: the open top of the hull's file is %.3g m above the water already, and is raised by "
                  "%.3g m to %.3g m: leave freeboard out (auto), and it is decked where it is",
                  r->top, r->freeboard, r->top + r->freeboard);
    if (r->decked > 0)
        log_write(ctx, LOG_INFO, "its open top, %.3g m above the water, is decked where it is", r->top);
    if (r->holes || r->flipped)
        log_write(ctx, LOG_INFO, "it is repaired: %d holes of %.3g m2 filled, %d triangles turned", (int)r->holes,
                  r->hole_area, (int)r->flipped);
    if (r->half)
        log_write(ctx, LOG_WARNING, "the hull's file has %s, and is closed there: mirror it if it is half",
                  hull_half_words(r->half));
    if (r->well > OPEN_BOAT)
        log_write(ctx, LOG_WARNING,
                  "the hull's waterline goes round a hole of %.0f %% of its area: an open boat is full of water; give "
                  "it a deck, or its outer face alone",
                  100 * r->well);
    if (r->inner_parts)
        log_write(ctx, LOG_INFO, "closed parts inside the hull are left out, %d of %.4g m3: no water comes there",
                  (int)r->inner_parts, r->inner_volume);
}

/* Main particulars of a mesh: those of its part under z = 0. */
static fram_status measure_hull(const scenario_hull *keys, const new_hull *h, hull_particulars *p, fram_error *error)
{
    box3 box = mesh_bounds(&h->surface);
    box2 line = h->floats.waterline;
    if (!(h->floats.waterplane_area > 0) || !(h->floats.volume > 0))
        return error_set(
            error, FRAM_ERROR_INPUT, keys->file, 0, "mesh",
            "the design waterline of a hull's file is its z = 0, but the mesh reaches from z = %g to %g m; "
            "move it up or down",
            box.lo.z, box.hi.z);
    p->length = line.hi.x - line.lo.x;
    p->beam = line.hi.y - line.lo.y;
    p->draught = -box.lo.z;
    p->freeboard = box.hi.z;
    p->midships = 0.5 * (line.lo.x + line.hi.x);
    return FRAM_OK;
}

/* ---- hulls that were read before ---- */

static bool same(double a, double b) { return a == b || (isnan(a) && isnan(b)); }

/* All that decides what is read: other keys of a hull do not act on one from a file. */
static bool is_read_alike(const stored_hull *h, const scenario_hull *keys, const hull_file_options *options,
                          const char *path)
{
    const scenario_hull *k = &h->keys;
    return same(k->file_scale, keys->file_scale) && same(k->seal_width, keys->seal_width) &&
           k->repair == keys->repair && same(k->freeboard, keys->freeboard) &&
           h->usual_freeboard == options->usual_freeboard && same(k->piece_distance, keys->piece_distance) &&
           k->most_pieces == keys->most_pieces && strcmp(h->path, path) == 0;
}

/* false: no memory. */
static bool copy_hull(context *ctx, const mesh *surface, const polyhedron_array *pieces, mesh *to,
                      polyhedron_array *pieces_to)
{
    const mat3 as_it_lies = quat_matrix((quat){.w = 1});
    bool good = mesh_copy(ctx, to, surface);
    for (int32_t i = 0; i < pieces->count && good; i++)
        good = array_push(ctx, pieces_to, (polyhedron){.radius = 0}) &&
               polyhedron_place(ctx, &pieces->data[i], as_it_lies, vec3_make(0, 0, 0), &pieces_to->data[i]);
    return good;
}

static void free_stored(context *ctx, stored_hull *h)
{
    mesh_free(ctx, &h->surface);
    polyhedron_array_free(ctx, &h->pieces);
}

void hull_store_free(context *ctx, hull_store *store)
{
    for (int32_t i = 0; i < store->hulls.count; i++)
        free_stored(ctx, &store->hulls.data[i]);
    array_free(ctx, &store->hulls);
    store->next = 0;
}

static const stored_hull *find_stored(const hull_store *store, const scenario_hull *keys,
                                      const hull_file_options *options, const char *path)
{
    for (int32_t i = 0; store && i < store->hulls.count; i++) {
        if (is_read_alike(&store->hulls.data[i], keys, options, path))
            return &store->hulls.data[i];
    }
    return NULL;
}

static bool keep(context *ctx, hull_store *store, const scenario_hull *keys, const hull_file_options *options,
                 const char *path, const new_hull *h)
{
    if (store->hulls.count < STORED_HULLS && !array_push(ctx, &store->hulls, (stored_hull){.concavity = 0}))
        return false;
    stored_hull *to = &store->hulls.data[store->next];
    store->next = (store->next + 1) % STORED_HULLS;
    free_stored(ctx, to);
    *to = (stored_hull){.keys = *keys, .usual_freeboard = options->usual_freeboard, .concavity = h->concavity};
    snprintf(to->path, sizeof to->path, "%s", path);
    return copy_hull(ctx, &h->surface, &h->pieces, &to->surface, &to->pieces);
}

/* ---- a hull ---- */

static fram_status read_hull(context *ctx, const scenario *s, const scenario_hull *keys, hull_store *store, new_hull *h,
                             fram_error *error)
{
    char path[SCENARIO_PATH_ROOM];
    fram_status status = scenario_file_path(s, "file", keys->file, path, error);
    if (status != FRAM_OK)
        return status;
    const hull_file_options options = {keys->file_scale, keys->seal_width, keys->repair, keys->freeboard,
                                       scenario_usual_freeboard(s)};
    const stored_hull *known = find_stored(store, keys, &options, path);
    if (known) {
        h->concavity = known->concavity;
        return copy_hull(ctx, &known->surface, &known->pieces, &h->surface, &h->pieces) ? FRAM_OK : error_memory(error);
    }
    hull_file_report report;
    status = hull_file_read(ctx, path, &options, &h->surface, &report, error);
    if (status == FRAM_OK) {
        report_file(ctx, &report);
        if (!(report.freeboard > 0) && !is_automatic(keys->freeboard))
            log_write(ctx, LOG_WARNING, "hull.freeboard: the hull's file has no level open top: without effect");
        double distance = keys->piece_distance;
        status = hull_cut(ctx, &h->surface, &distance, (int32_t)keys->most_pieces, &h->pieces, &h->concavity, error);
    }
    if (status == FRAM_OK)
        log_write(ctx, LOG_INFO, "it is cut into %d convex pieces within %.3g m of the mesh", (int)h->pieces.count,
                  h->concavity);
    if (status == FRAM_OK && store && !keep(ctx, store, keys, &options, path, h))
        status = error_memory(error);
    return status;
}

static fram_status make(context *ctx, const scenario *s, const scenario_hull *keys, hull_store *store, new_hull *h,
                        hull_particulars *p, fram_error *error)
{
    bool from_file = keys->form == HULL_MESH;
    *p = particulars_of(s, keys);
    fram_status status =
        from_file ? read_hull(ctx, s, keys, store, h, error) : hull_make(ctx, p, &h->surface, &h->pieces, error);
    if (status == FRAM_OK)
        status = hull_hydrostatics_at(ctx, &h->surface, 0, &h->floats, error);
    return status == FRAM_OK && from_file ? measure_hull(keys, h, p, error) : status;
}

fram_status build_hull(context *ctx, const scenario *s, const vessel_entry *entry, hull_store *store,
                       solid_array *solids, vessel_model *out, fram_error *error)
{
    const scenario_vessel *v = entry->keys;
    new_hull h = {0};
    fram_status status = make(ctx, s, &v->hull, store, &h, &out->particulars, error);
    if (status == FRAM_OK) {
        out->floats = h.floats;
        out->displaced_mass = h.floats.volume * s->environment.water_density;
        out->centre = vec3_make(automatic_or(v->centre_of_gravity_x, h.floats.centre_of_buoyancy.x),
                                automatic_or(v->centre_of_gravity_y, h.floats.centre_of_buoyancy.y),
                                automatic_or(v->centre_of_gravity_z, 0));
        mesh_translate(&h.surface, vec3_neg(out->centre));
        for (int32_t i = 0; i < h.pieces.count; i++)
            polyhedron_translate(&h.pieces.data[i], vec3_neg(out->centre));
        status = solid_add(ctx, solids, &h.surface, &h.pieces, h.concavity, &out->solid, error);
    }
    mesh_free(ctx, &h.surface);
    polyhedron_array_free(ctx, &h.pieces);
    return name_hull_key(s, entry, status, error);
}

/* From about the centre of gravity to ship coordinates; second moments are about the water plane's own middle. */
static void move_from_centre(hull_hydrostatics *h, vec3 centre)
{
    const vec2 level = vec2_make(centre.x, centre.y);
    h->centre_of_buoyancy = vec3_add(h->centre_of_buoyancy, centre);
    h->centre_of_flotation = vec2_add(h->centre_of_flotation, level);
    h->waterline = (box2){vec2_add(h->waterline.lo, level), vec2_add(h->waterline.hi, level)};
}

fram_status build_upright(context *ctx, const scenario *s, const vessel_entry *entry, const vessel_model *hull,
                          const solid *body, hull_hydrostatics *out, fram_error *error)
{
    double mass = automatic_or(entry->keys->mass, hull->displaced_mass), level = 0;
    *out = hull->floats;
    if (mass == hull->displaced_mass)
        return FRAM_OK;
    fram_status status =
        hull_level_of(ctx, &body->surface, mass / s->environment.water_density, &level, error); /* about the centre */
    if (status == FRAM_OK)
        status = hull_hydrostatics_at(ctx, &body->surface, level, out, error);
    move_from_centre(out, hull->centre);
    if (status != FRAM_ERROR_INPUT)
        return status;
    *out = (hull_hydrostatics){.volume = 0};
    return FRAM_OK;
}

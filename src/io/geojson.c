#include "io/geojson.h"

#include "base/number_text.h"
#include "io/atomic_file.h"
#include "io/json_walk.h"
#include "io/text_buffer.h"
#include "model/scenario_schema.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* One reading.  Members of an object may come in any order, so each object is walked twice: once to find its members,
   then those that its type asks for. */
typedef struct reading {
    context *ctx;
    import_rings *out;
    fram_error *error;
    int32_t feature, polygon; /* of the ring that is read, from 1; feature 0: not in one yet */
    int32_t features;
    double thickness;
    bool is_ice, is_wall;       /* the feature */
    bool told;                  /* of a property that is nearly one that is read */
    char key[IMPORT_NAME_SIZE]; /* for errors */
} reading;

/* The members that matter, of any object; at of one that is missing is NULL. */
typedef struct object {
    char type[24]; /* empty: missing */
    json_walk type_place, features, geometry, geometries, coordinates, properties;
} object;

/* Names the place in an error that has none. */
static fram_status name_place(const reading *r, fram_status status)
{
    if (status == FRAM_ERROR_INPUT && r->error && !r->error->key[0])
        snprintf(r->error->key, sizeof r->error->key, "%s", r->key);
    return status;
}

/* ---- objects ---- */

static json_walk *member_of(object *o, const char *key)
{
    const struct {
        const char *name;
        json_walk *walk;
    } members[] = {{"type", &o->type_place},       {"features", &o->features},       {"geometry", &o->geometry},
                   {"geometries", &o->geometries}, {"coordinates", &o->coordinates}, {"properties", &o->properties}};
    for (size_t i = 0; i < sizeof members / sizeof *members; i++)
        if (strcmp(key, members[i].name) == 0)
            return members[i].walk;
    return NULL;
}

/* Walks over an object and remembers where its members are. */
static fram_status scan_object(const reading *r, json_walk *w, object *o)
{
    char key[24];
    *o = (object){.type = ""};
    json_loop loop = json_walk_into(w, JSON_OBJECT, r->error);
    while (json_walk_next_member(w, &loop, key, sizeof key, r->error)) {
        json_walk *member = member_of(o, key);
        if (member && member->at)
            return json_walk_refuse(w, r->key, r->error, "the member \"%s\" is there twice", key);
        if (member)
            *member = *w;
        loop.status = member == &o->type_place ? json_walk_text(w, o->type, sizeof o->type, r->error)
                                               : json_walk_skip(w, r->error);
    }
    return loop.status;
}

/* ---- coordinates ---- */

static fram_status read_position(const reading *r, json_walk *w, vec2 *out)
{
    double value[3] = {0};
    int count = 0;
    json_walk begin = *w;
    json_loop loop = json_walk_into(w, JSON_ARRAY, r->error);
    while (json_walk_next(w, &loop, r->error)) {
        if (count == 3)
            return json_walk_refuse(&begin, r->key, r->error, "expected a position of 2 or 3 numbers, found more");
        loop.status = json_walk_number(w, &value[count++], r->error);
    }
    if (loop.status == FRAM_OK && count < 2)
        return json_walk_refuse(&begin, r->key, r->error, "expected a position of 2 or 3 numbers, found %d", count);
    *out = vec2_make(value[0], value[1]);
    return loop.status;
}

/* The last ring of a list, while it grows: its vertices stand at the end of the pool. */
static fram_status read_positions(const reading *r, json_walk *w, int32_t begin)
{
    vec2_array *vertices = &r->out->rings.vertex;
    json_loop loop = json_walk_into(w, JSON_ARRAY, r->error);
    while (json_walk_next(w, &loop, r->error)) {
        vec2 position = {0, 0};
        if (vertices->count - begin == GEOJSON_RING_VERTICES_MOST)
            return json_walk_refuse(w, r->key, r->error, "a ring has more than %d positions",
                                    (int)GEOJSON_RING_VERTICES_MOST);
        if (vertices->count == GEOJSON_VERTICES_MOST)
            return json_walk_refuse(w, r->key, r->error, "the file has more than %d positions",
                                    (int)GEOJSON_VERTICES_MOST);
        loop.status = read_position(r, w, &position);
        if (loop.status == FRAM_OK && !array_push(r->ctx, vertices, position))
            loop.status = error_memory(r->error);
    }
    return loop.status;
}

static fram_status read_ring(reading *r, json_walk *w, int32_t number)
{
    polygon_list *rings = &r->out->rings;
    if (r->out->place.count == GEOJSON_RINGS_MOST)
        return json_walk_refuse(w, r->key, r->error, "the file has more than %d rings", (int)GEOJSON_RINGS_MOST);
    import_place place = {.feature = r->feature,
                          .polygon = r->polygon,
                          .ring = number,
                          .line = w->line,
                          .column = json_walk_column(w),
                          .thickness = r->thickness};
    import_place_name(&place, r->key);
    int32_t begin = rings->vertex.count;
    fram_status status = read_positions(r, w, begin);
    if (status != FRAM_OK)
        return name_place(r, status);
    int32_t count = rings->vertex.count - begin;
    const vec2 *v = count > 0 ? rings->vertex.data + begin : NULL; /* before the first position there is no data */
    place.open = count < 2 || v[0].x != v[count - 1].x || v[0].y != v[count - 1].y;
    if (!place.open)
        rings->vertex.count--;
    if (rings->start.count == 0 && !array_push(r->ctx, &rings->start, 0))
        return error_memory(r->error);
    if (!array_push(r->ctx, &r->out->place, place) || !array_push(r->ctx, &rings->start, rings->vertex.count))
        return error_memory(r->error);
    return FRAM_OK;
}

/* Rings of a polygon: the outline, then its holes. */
static fram_status read_polygon(reading *r, json_walk *w)
{
    int32_t count = 0;
    json_walk begin = *w;
    r->polygon++;
    snprintf(r->key, sizeof r->key, "feature %d, polygon %d", (int)r->feature, (int)r->polygon);
    json_loop loop = json_walk_into(w, JSON_ARRAY, r->error);
    while (json_walk_next(w, &loop, r->error))
        loop.status = read_ring(r, w, ++count);
    if (loop.status == FRAM_OK && count == 0)
        return json_walk_refuse(&begin, r->key, r->error, "expected at least one ring, found none");
    return name_place(r, loop.status);
}

/* A geometry without coordinates is one of null (RFC 7946, 3.1), as programs write what a cut left nothing of. */
static fram_status read_single_polygon(reading *r, json_walk *w)
{
    json_walk inside = *w;
    json_loop loop = json_walk_into(&inside, JSON_ARRAY, NULL);
    if (!json_walk_next(&inside, &loop, NULL) && loop.status == FRAM_OK)
        return FRAM_OK;
    return read_polygon(r, w);
}

static fram_status read_polygons(reading *r, json_walk *w)
{
    json_loop loop = json_walk_into(w, JSON_ARRAY, r->error);
    while (json_walk_next(w, &loop, r->error))
        loop.status = read_polygon(r, w);
    return loop.status;
}

/* ---- features ---- */

/* What an export of Fram writes beside floes. */
static const char VESSEL_KIND[] = "vessel", WALL_KIND[] = "wall";

static fram_status read_kind(reading *r, json_walk *w)
{
    char text[16];
    json_kind kind;
    fram_status status = json_walk_kind(w, &kind, r->error);
    if (status != FRAM_OK || kind != JSON_STRING)
        return status == FRAM_OK ? json_walk_skip(w, r->error) : status;
    status = json_walk_text(w, text, sizeof text, r->error);
    r->is_wall = status == FRAM_OK && strcmp(text, WALL_KIND) == 0;
    if (status == FRAM_OK)
        r->is_ice = !r->is_wall && strcmp(text, VESSEL_KIND) != 0;
    return status;
}

static fram_status read_thickness(reading *r, json_walk *w, json_kind kind)
{
    json_walk place = *w;
    double most = scenario_key_find("ice", "thickness")->hi;
    if (kind != JSON_NUMBER)
        return json_walk_refuse(&place, r->key, r->error, "expected a number for the property thickness, found %s",
                                kind == JSON_STRING ? "a text" : "none");
    fram_status status = json_walk_number(w, &r->thickness, r->error);
    if (status == FRAM_OK && !(r->thickness > 0))
        return json_walk_refuse(&place, r->key, r->error, "expected a thickness over 0 m, found %g", r->thickness);
    if (status == FRAM_OK && r->thickness > most)
        return json_walk_refuse(&place, r->key, r->error,
                                "expected a thickness of at most %g m, found %g: is it in centimetres?", most,
                                r->thickness);
    return status;
}

/* The kind and thickness of a feature; its other properties are its own business. */
static fram_status read_properties(reading *r, json_walk w)
{
    char key[16];
    json_kind kind;
    if (!w.at)
        return FRAM_OK;
    fram_status status = json_walk_kind(&w, &kind, r->error);
    if (status != FRAM_OK || kind == JSON_NULL)
        return status;
    json_loop loop = json_walk_into(&w, JSON_OBJECT, r->error);
    while (json_walk_next_member(&w, &loop, key, sizeof key, r->error)) {
        if (strcmp(key, "kind") == 0) {
            loop.status = read_kind(r, &w);
            continue;
        }
        bool wanted = strcmp(key, "thickness") == 0;
        if (!wanted && !r->told && strcasecmp(key, "thickness") == 0) {
            log_write(r->ctx, LOG_WARNING, "%s: the property %s is not read: its name is thickness, in metres", r->key,
                      key);
            r->told = true;
        }
        if (wanted)
            loop.status = json_walk_kind(&w, &kind, r->error);
        if (loop.status != FRAM_OK || !wanted || kind == JSON_NULL) {
            loop.status = loop.status == FRAM_OK ? json_walk_skip(&w, r->error) : loop.status;
            continue;
        }
        loop.status = read_thickness(r, &w, kind);
    }
    return loop.status;
}

static fram_status read_geometry(reading *r, json_walk w);

static fram_status read_geometries(reading *r, json_walk w)
{
    json_loop loop = json_walk_into(&w, JSON_ARRAY, r->error);
    while (json_walk_next(&w, &loop, r->error)) {
        json_walk geometry = w;
        loop.status = json_walk_skip(&w, r->error);
        if (loop.status == FRAM_OK)
            loop.status = read_geometry(r, geometry);
    }
    return loop.status;
}

/* A geometry object that the walk stands at, scanned already. */
static fram_status read_scanned_geometry(reading *r, json_walk begin, const object *o)
{
    bool collection = strcmp(o->type, "GeometryCollection") == 0, many = strcmp(o->type, "MultiPolygon") == 0;
    if (!collection && !many && strcmp(o->type, "Polygon") != 0)
        return json_walk_refuse(o->type_place.at ? &o->type_place : &begin, r->key, r->error,
                                "expected a Polygon, MultiPolygon or GeometryCollection, found %s%.24s",
                                o->type[0] ? "" : "no type", o->type);
    json_walk w = collection ? o->geometries : o->coordinates;
    if (!w.at)
        return json_walk_refuse(&begin, r->key, r->error, "the %s has no member \"%s\"", o->type,
                                collection ? "geometries" : "coordinates");
    if (collection)
        return read_geometries(r, w);
    return many ? read_polygons(r, &w) : read_single_polygon(r, &w);
}

static fram_status read_geometry(reading *r, json_walk w)
{
    object o;
    json_walk begin = w;
    fram_status status = scan_object(r, &w, &o);
    return status == FRAM_OK ? read_scanned_geometry(r, begin, &o) : status;
}

static fram_status begin_feature(reading *r, const json_walk *w)
{
    if (r->features == GEOJSON_FEATURES_MOST)
        return json_walk_refuse(w, r->key, r->error, "the file has more than %d features", (int)GEOJSON_FEATURES_MOST);
    r->feature = ++r->features;
    r->polygon = 0;
    r->thickness = (double)NAN;
    r->is_ice = true;
    r->is_wall = false;
    snprintf(r->key, sizeof r->key, "feature %d", (int)r->feature);
    return FRAM_OK;
}

/* A feature without a geometry, which is null then, is one that is not anywhere: allowed, and no floe. */
static fram_status read_feature(reading *r, json_walk begin, const object *o)
{
    json_kind kind;
    json_walk geometry = o->geometry;
    if (strcmp(o->type, "Feature") != 0)
        return json_walk_refuse(o->type_place.at ? &o->type_place : &begin, r->key, r->error,
                                "expected a Feature, found %s%.24s", o->type[0] ? "" : "no type", o->type);
    if (!geometry.at)
        return json_walk_refuse(&begin, r->key, r->error, "the Feature has no member \"geometry\"");
    fram_status status = read_properties(r, o->properties);
    if (status == FRAM_OK && !r->is_ice) {
        r->out->passed_over++;
        r->out->walls += r->is_wall;
        return FRAM_OK;
    }
    if (status == FRAM_OK)
        status = json_walk_kind(&geometry, &kind, r->error);
    if (status == FRAM_OK && kind != JSON_NULL)
        status = read_geometry(r, geometry);
    return status;
}

static fram_status read_features(reading *r, json_walk w)
{
    json_loop loop = json_walk_into(&w, JSON_ARRAY, r->error);
    while (json_walk_next(&w, &loop, r->error)) {
        object o;
        r->key[0] = '\0';
        json_walk begin = w;
        loop.status = begin_feature(r, &begin);
        if (loop.status == FRAM_OK)
            loop.status = scan_object(r, &w, &o);
        if (loop.status == FRAM_OK)
            loop.status = read_feature(r, begin, &o);
        name_place(r, loop.status);
    }
    return loop.status;
}

static fram_status read_root(reading *r, json_walk *w)
{
    object o;
    json_walk begin = *w;
    fram_status status = scan_object(r, w, &o);
    if (status == FRAM_OK)
        status = json_walk_end(w, r->error);
    if (status != FRAM_OK)
        return status;
    if (strcmp(o.type, "FeatureCollection") == 0) {
        if (!o.features.at)
            return json_walk_refuse(&begin, NULL, r->error, "the FeatureCollection has no member \"features\"");
        return read_features(r, o.features);
    }
    status = begin_feature(r, &begin);
    if (status != FRAM_OK)
        return status;
    status = strcmp(o.type, "Feature") == 0 ? read_feature(r, begin, &o) : read_scanned_geometry(r, begin, &o);
    return name_place(r, status);
}

fram_status geojson_parse(context *ctx, const char *name, const char *data, size_t size, import_rings *out,
                          fram_error *error)
{
    reading r = {.ctx = ctx, .out = out, .error = error, .thickness = (double)NAN};
    json_walk w = json_walk_begin(name, data, size, GEOJSON_DEPTH_MOST);
    fram_error own;
    if (!error)
        r.error = &own;
    *r.error = (fram_error){.status = FRAM_OK};
    fram_status status = read_root(&r, &w);
    if (status != FRAM_OK)
        import_rings_free(ctx, out);
    return status;
}

/* ---- writing ---- */

static void add_number(context *ctx, text_buffer *b, double value)
{
    char text[NUMBER_TEXT_SIZE];
    int length = real_to_text(value, text);
    text_add_bytes(ctx, b, text, (size_t)length);
}

/* Counter-clockwise, as RFC 7946 has it, whichever way up the floe lies; as the reader would turn it. */
static void add_ring(context *ctx, text_buffer *b, polygon p)
{
    bool turned = p.count > 0 && polygon_orientation(p) < 0;
    for (int32_t k = 0; k <= p.count && p.count > 0; k++) {
        int32_t i = k % p.count;
        vec2 v = p.vertex[turned ? p.count - 1 - i : i];
        text_add(ctx, b, k > 0 ? ",[" : "[");
        add_number(ctx, b, v.x);
        text_add(ctx, b, ",");
        add_number(ctx, b, v.y);
        text_add(ctx, b, "]");
    }
}

static void add_property(context *ctx, text_buffer *b, const geojson_property *p, int32_t row)
{
    if (p->text) {
        if (p->text[row])
            text_format(ctx, b, ",\"%s\":\"%s\"", p->name, p->text[row]);
    } else if (!isnan(p->value[row])) {
        text_format(ctx, b, ",\"%s\":", p->name);
        add_number(ctx, b, p->value[row]);
    }
}

/* Of feature `row`: its outline, or what stands in its place. */
static void add_geometry(context *ctx, text_buffer *b, const polygon_list *outlines, geojson_parts parts, int32_t row)
{
    int32_t found = 0, features = polygon_list_count(outlines) - parts.count;
    for (int32_t k = 0; k < parts.count; k++) {
        if (parts.feature[k] != row)
            continue;
        text_add(ctx, b, found++ > 0 ? "]],[[" : "{\"type\":\"MultiPolygon\",\"coordinates\":[[[");
        add_ring(ctx, b, polygon_list_get(outlines, features + k));
    }
    if (found == 0) {
        text_add(ctx, b, "{\"type\":\"Polygon\",\"coordinates\":[[");
        add_ring(ctx, b, polygon_list_get(outlines, row));
    }
    text_add(ctx, b, found > 0 ? "]]]}" : "]]}");
}

fram_status geojson_write_properties(context *ctx, const char *path, const polygon_list *outlines, geojson_parts parts,
                                     const geojson_property *properties, int32_t property_count, double time,
                                     fram_error *error)
{
    text_buffer b = {0};
    int32_t count = polygon_list_count(outlines) - parts.count;
    text_add(ctx, &b, "{\"type\":\"FeatureCollection\",");
    if (!isnan(time)) {
        text_add(ctx, &b, "\"time\":");
        add_number(ctx, &b, time);
        text_add(ctx, &b, ",");
    }
    text_add(ctx, &b, "\"features\":[\n");
    for (int32_t i = 0; i < count; i++) {
        text_format(ctx, &b, "{\"type\":\"Feature\",\"properties\":{\"id\":%d", (int)i);
        for (int32_t k = 0; k < property_count; k++)
            add_property(ctx, &b, &properties[k], i);
        text_add(ctx, &b, "},\"geometry\":");
        add_geometry(ctx, &b, outlines, parts, i);
        text_add(ctx, &b, i + 1 < count ? "},\n" : "}\n");
    }
    text_add(ctx, &b, "]}\n");
    fram_status status = text_file_write(ctx, path, &b, error);
    text_free(ctx, &b);
    return status;
}

fram_status geojson_write(context *ctx, const char *path, const polygon_list *outlines, const double *thickness,
                          fram_error *error)
{
    const geojson_property property = {.name = "thickness", .value = thickness};
    return geojson_write_properties(ctx, path, outlines, (geojson_parts){NULL, 0}, &property, thickness ? 1 : 0, NAN,
                                    error);
}

/* Conditions that are a Latin hypercube: ranges of keys in strata, and lists of values that are met equally often. */
#include "base/random.h"
#include "study/conditions.h"
#include "study/key_names.h"

#include <string.h>

/* Streams of random numbers of this room: of strata, and of places inside them. */
enum { STREAM_STRATA = 901, STREAM_PLACES };

/* ---- Latin hypercube (McKay, Beckman and Conover 1979): every key's range in `count` strata, each met once ---- */

/* A key: a range, or a list of values, each of which takes as many strata as the others, or one more or less. */
typedef struct latin_key {
    key_range range;
    const yaml_node *values; /* NULL: it is a range */
    int32_array stratum;     /* of each condition */
} latin_key;

enum { LATIN_KEYS_MOST = 64 };

/* Whether what stands under a key are the ends of a range: two numbers, but of keys whose values are none. */
static bool is_range(const study_source *r, const yaml_node *node)
{
    const scenario_key *key = key_of_path(study_key(r, node));
    double end;
    if (key && key->kind != KEY_REAL && key->kind != KEY_INTEGER)
        return key_has_keys(key); /* they have neither, and are told so */
    if (node->kind != YAML_SEQUENCE || node->count != 2)
        return node->kind != YAML_SEQUENCE || node->count == 0;
    const yaml_node *lo = study_child(r, node), *hi = study_next(r, lo);
    return study_number_is(r, lo, &end) && study_number_is(r, hi, &end);
}

enum { LISTED_SIZE = 120 };

/* A list of values as it stands, or "[...]" where it is none or has no room. */
static void write_list(const study_source *r, const yaml_node *list, char out[LISTED_SIZE])
{
    size_t used = 0;
    const yaml_node *first = list->kind == YAML_SEQUENCE ? study_child(r, list) : NULL;
    bool good = first != NULL;
    for (const yaml_node *k = first; k && good; k = study_next(r, k)) {
        good = k->kind == YAML_SCALAR;
        if (good)
            used += (size_t)snprintf(out + used, LISTED_SIZE - used, "%s%s", k == first ? "[" : ", ",
                                     yaml_text(r->tree, k->value));
        good = good && used + 1 < LISTED_SIZE;
    }
    snprintf(out + (good ? used : 0), LISTED_SIZE - (good ? used : 0), good ? "]" : "[...]");
}

/* What stands under `values`, alone; NULL where nothing does, or that is a key of the scenario. */
static fram_status find_values(const study_source *r, const yaml_node *node, const yaml_node **out)
{
    const yaml_node *beside = NULL, *first = node->kind == YAML_MAPPING ? study_child(r, node) : NULL;
    *out = NULL;
    if (key_has_keys(key_of_path(study_key(r, node))))
        return FRAM_OK;
    for (const yaml_node *k = first; k; k = study_next(r, k))
        *(strcmp(study_key(r, k), "values") == 0 ? out : &beside) = k;
    if (!*out || !beside)
        return FRAM_OK;
    char listed[LISTED_SIZE];
    write_list(r, *out, listed);
    return study_refuse(r, beside, "expected nothing beside values, as %s: {values: %s}", study_key(r, node), listed);
}

/* `[ends of a range]`, `[a, list, of, values]`, or `{values: [...]}`, as two numbers that are no range are written. */
static fram_status read_latin_key(const study_source *r, const yaml_node *node, latin_key *out)
{
    const yaml_node *listed;
    fram_status status = find_values(r, node, &listed);
    if (status != FRAM_OK)
        return status;
    if (!listed && node->kind == YAML_MAPPING)
        return study_refuse_kind(r, node, YAML_SEQUENCE, true, "the ends of a range, as [0.5, 1.5]");
    if (!listed && is_range(r, node))
        return study_range(r, node, &out->range);
    out->values = listed ? listed : node;
    return study_expect(r, out->values, YAML_SEQUENCE, "a list of values, as [0.6, 1.1]");
}

static fram_status add_of_list(const study_source *r, const yaml_node *values, int32_t stratum)
{
    int64_t number = (int64_t)stratum * values->count / r->out->conditions;
    const yaml_node *value = study_child(r, values);
    while (number-- > 0)
        value = study_next(r, value);
    return study_add_value(r, value);
}

static fram_status draw_latin(const study_source *r, const latin_key *keys, random_stream *places)
{
    for (int32_t c = 0; c < r->out->conditions; c++) {
        for (int32_t k = 0; k < r->out->keys.count; k++) {
            const int32_t *stratum = keys[k].stratum.data;
            if (!stratum)
                return error_memory(r->error);
            double at = (stratum[c] + random_unit(&places[k])) / r->out->conditions;
            fram_status status =
                keys[k].values ? add_of_list(r, keys[k].values, stratum[c]) : study_add_part(r, keys[k].range, at);
            if (status != FRAM_OK)
                return status;
        }
    }
    return FRAM_OK;
}

static fram_status fill_latin(const study_source *r, const yaml_node *node, int64_t seed)
{
    latin_key keys[LATIN_KEYS_MOST] = {{.range = {.lo = 0}}};
    random_stream places[LATIN_KEYS_MOST];
    fram_status status = study_expect(r, node, YAML_MAPPING, "keys with a range or a list of values each");
    if (status == FRAM_OK && node->count > LATIN_KEYS_MOST)
        status = study_refuse(r, node, "found %d keys, expected at most %d", (int)node->count, LATIN_KEYS_MOST);
    int32_t n = 0;
    for (const yaml_node *k = study_child(r, node); k && status == FRAM_OK; k = study_next(r, k), n++) {
        random_stream strata = random_begin((uint64_t)seed, STREAM_STRATA, (uint32_t)n);
        places[n] = random_begin((uint64_t)seed, STREAM_PLACES, (uint32_t)n);
        status = read_latin_key(r, k, &keys[n]);
        if (status == FRAM_OK)
            status = study_add_key(r, k);
        if (status == FRAM_OK && !array_resize(r->ctx, &keys[n].stratum, r->out->conditions))
            status = error_memory(r->error);
        if (status == FRAM_OK)
            random_order(&strata, keys[n].stratum.data, r->out->conditions);
    }
    if (status == FRAM_OK)
        status = draw_latin(r, keys, places);
    for (int32_t k = 0; k < LATIN_KEYS_MOST; k++)
        array_free(r->ctx, &keys[k].stratum);
    return status;
}

fram_status study_latin_read(const study_source *r, const yaml_node *node)
{
    drawn_head head = {0};
    fram_status status = study_drawn_read(r, node, 1, 0, &head);
    if (status != FRAM_OK)
        return status;
    r->out->conditions = (int32_t)head.count;
    return fill_latin(r, head.keys, head.seed);
}

/* Conditions that are designs of sensitivity: points of Sobol's and Morris's schemes within the ranges of keys. */
#include "study/conditions.h"
#include "study/sensitivity.h"

/* A range of its own width, whose key is added. */
static fram_status read_range(const study_source *r, const yaml_node *k)
{
    key_range range;
    fram_status status = study_range(r, k, &range);
    if (status == FRAM_OK && !(range.hi > range.lo))
        status = study_refuse(r, k, "expected a range that is wider than nothing");
    if (status == FRAM_OK && !array_push(r->ctx, &r->out->design.range, range))
        status = error_memory(r->error);
    return status == FRAM_OK ? study_add_key(r, k) : status;
}

static fram_status write_values(const study_source *r)
{
    const study_design *d = &r->out->design;
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < d->point.count && status == FRAM_OK; i++)
        status = study_add_part(r, d->range.data[i % d->range.count], d->point.data[i]);
    return status;
}

static fram_status draw_points(const study_source *r)
{
    study_design *d = &r->out->design;
    int32_t k = d->range.count;
    if (!array_resize(r->ctx, &d->point, r->out->conditions * k))
        return error_memory(r->error);
    if (d->kind == DESIGN_MORRIS)
        morris_points(d->count, k, d->levels, d->seed, d->point.data);
    else if (!sobol_points(r->ctx, d->count, k, d->seed, d->point.data))
        return error_memory(r->error);
    return FRAM_OK;
}

/* The ranges under `keys`, and the number of conditions that follows from them. */
static fram_status read_ranges(const study_source *r, const yaml_node *node)
{
    study *s = r->out;
    if (node->kind != YAML_MAPPING || node->count == 0)
        return study_refuse(r, node, "expected keys with a range each");
    if (node->count > SENSITIVITY_KEYS_MOST)
        return study_refuse(r, node, "found %d keys, expected at most %d", (int)node->count, SENSITIVITY_KEYS_MOST);
    fram_status status = FRAM_OK;
    for (const yaml_node *k = study_child(r, node); k && status == FRAM_OK; k = study_next(r, k))
        status = read_range(r, k);
    int64_t each = s->keys.count + (s->design.kind == DESIGN_MORRIS ? 1 : 2), all = each * s->design.count;
    if (status == FRAM_OK && all > STUDY_CONDITIONS_MOST)
        status =
            study_refuse(r, node, "found %lld conditions, expected at most %d: count times the number of keys + %d",
                         (long long)all, STUDY_CONDITIONS_MOST, s->design.kind == DESIGN_MORRIS ? 1 : 2);
    s->conditions = status == FRAM_OK ? (int32_t)all : s->conditions;
    return status;
}

static fram_status read_design(const study_source *r, const yaml_node *node, study_design_kind kind)
{
    bool morris = kind == DESIGN_MORRIS;
    drawn_head head = {.levels = 4};
    fram_status status = study_drawn_read(r, node, morris ? 2 : 10, morris ? SENSITIVITY_LEVELS_MOST : 0, &head);
    if (status != FRAM_OK)
        return status;
    if (head.levels % 2 != 0)
        return study_refuse(r, node, "expected an even number of levels, found %d", (int)head.levels);
    r->out->design =
        (study_design){.kind = kind, .count = (int32_t)head.count, .levels = (int32_t)head.levels, .seed = head.seed};
    status = read_ranges(r, head.keys);
    if (status == FRAM_OK)
        status = draw_points(r);
    return status == FRAM_OK ? write_values(r) : status;
}

fram_status study_sobol_read(const study_source *r, const yaml_node *node)
{
    return read_design(r, node, DESIGN_SOBOL);
}

fram_status study_morris_read(const study_source *r, const yaml_node *node)
{
    return read_design(r, node, DESIGN_MORRIS);
}

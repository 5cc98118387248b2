/* The picture of a peak: the field near the vessel, floes coloured by their part of the load, chains as lines. */
#include "results/why.h"

#include "base/load_unit.h"
#include "results/replay_plan.h"
#include "results/why_labels.h"

#include "io/folder.h"
#include "io/path.h"

#include <stdio.h>
#include <string.h>

enum { LONGEST_SIDE = 1400 };

/* Of the load that a floe carries [%]. */
static double part_of(const peak_detail *d, const peak_floe *f)
{
    double part = 0;
    for (int m = 0; m < MECHANISM_COUNT; m++)
        part += d->load > 0 ? 100 * f->part[m] / d->load : 0;
    return part;
}

/* Part of the load that a body carries [%]; a body of a chain that does not touch the vessel 0. */
static bool part_in(const peak_detail *d, const replay_body *b, double *part)
{
    bool found = false;
    *part = 0;
    for (int32_t i = 0; i < d->link_count; i++)
        found = found || (b->number >= 0 && d->link[i].number == b->number);
    for (int32_t i = 0; i < d->floe_count; i++) {
        if (b->number < 0 || d->floe[i].number != b->number)
            continue;
        found = true;
        *part += part_of(d, &d->floe[i]);
    }
    return found;
}

static float on_scale(double part, double most) { return (float)(most > 0 ? fmin(fmax(part / most, 0), 1) : 0); }

/* Outlines are told apart by where they lie in memory: shapes are sorted. */
static void colour_floes(const replay *r, const replay_moment *m, const peak_detail *d, double most, replay_plan *plan)
{
    for (int32_t i = 0; i < plan->shapes.count; i++) {
        plan_shape *s = &plan->shapes.data[i];
        for (int32_t k = 0; k < m->poses.count; k++) {
            double part;
            if (polygon_list_get(&m->outlines, k).vertex != s->outline.vertex ||
                !part_in(d, &r->bodies.data[m->poses.data[k].body], &part))
                continue;
            s->has_value = true;
            s->value = on_scale(part, most);
        }
    }
}

/* The hull under the ice that it covers: what carries a load is mostly below it. */
static void show_under_hull(replay_plan *plan)
{
    for (int32_t i = 0; i < plan->shapes.count; i++)
        if (plan->shapes.data[i].style == PLAN_DECK)
            plan->shapes.data[i].height = -HUGE_VAL;
    plan_shapes_sort(plan->shapes.data, plan->shapes.count);
}

static bool add_arrows(context *ctx, const peak_detail *d, double length, replay_plan *plan)
{
    bool good = true;
    int32_t at = 0;
    array_clear(&plan->arrows);
    for (int32_t i = 0; i < d->floe_count && good; i++) {
        const peak_floe *f = &d->floe[i];
        vec2 point = vec2_make(f->point.x, f->point.y);
        vec2 way = vec2_make(f->force.x * length, f->force.y * length);
        good = array_push(ctx, &plan->arrows, (plan_arrow){vec2_sub(point, way), point});
        for (int k = 1; k < f->links && good; k++) {
            if (peak_chain_jumps_to(f, k))
                continue;
            const peak_link *a = &d->link[at + k - 1], *b = &d->link[at + k];
            good = array_push(ctx, &plan->arrows,
                              (plan_arrow){vec2_make(a->place.x, a->place.y), vec2_make(b->place.x, b->place.y)});
        }
        at += f->links;
    }
    return good;
}

/* Floes that were born and broke between two frames have no outline in the record: those of at least this part of the
   load get their names [%]. */
static const double NAMED_PART = 1;

static bool is_drawn(const replay *r, const replay_moment *m, int32_t number)
{
    for (int32_t i = 0; i < m->poses.count; i++)
        if (r->bodies.data[m->poses.data[i].body].number == number)
            return true;
    return false;
}

int32_t why_labels(const replay *r, const replay_moment *m, const peak_detail *d, double most, double length,
                   plan_label labels[PEAK_FLOES])
{
    int32_t count = 0;
    for (int32_t i = 0; i < d->floe_count; i++) {
        const peak_floe *f = &d->floe[i];
        double part = part_of(d, f);
        if (f->number < 0 || part < NAMED_PART || is_drawn(r, m, f->number))
            continue;
        plan_label *l = &labels[count++];
        *l = (plan_label){.value = on_scale(part, most)};
        l->at = vec2_make(f->point.x - f->force.x * length, f->point.y - f->force.y * length);
        snprintf(l->text, sizeof l->text, "floe %d, %.0f %%", (int)f->number, part);
    }
    return count;
}

/* A hull from a file has its own length, whatever the keys say [m]. */
static double length_of(const replay *r, const scenario_hull *hull, int32_t vessel)
{
    return hull->form == HULL_MESH ? replay_hull_size(r, vessel).x : hull->length;
}

/* The middle of what touches the vessel; where nothing does, the vessel itself. */
static vec2 peak_middle(const replay *r, const replay_moment *m, const peak_detail *d, int32_t vessel)
{
    vec2 middle = vec2_make(0, 0);
    for (int32_t i = 0; i < d->floe_count; i++)
        middle = vec2_add(middle, vec2_make(d->floe[i].point.x / d->floe_count, d->floe[i].point.y / d->floe_count));
    const int32_t hull = replay_hull(r, vessel);
    for (int32_t i = 0; d->floe_count == 0 && i < m->poses.count; i++)
        if (m->poses.data[i].body == hull)
            middle = vec2_make(m->poses.data[i].position.x, m->poses.data[i].position.y);
    return middle;
}

box2 why_window(const replay *r, const replay_moment *m, const peak_detail *d, int32_t vessel, double reach)
{
    const vec2 middle = peak_middle(r, m, d, vessel);
    box2 box = {vec2_make(middle.x - reach, middle.y - reach), vec2_make(middle.x + reach, middle.y + reach)};
    for (int32_t i = 0; i < d->link_count; i++) {
        /* A fixed floe's place may be far: the middle of a sheet. */
        vec3 p = d->link[i].place;
        if (fabs(p.x - middle.x) > 3 * reach || fabs(p.y - middle.y) > 3 * reach)
            continue;
        box.lo = vec2_make(fmin(box.lo.x, p.x), fmin(box.lo.y, p.y));
        box.hi = vec2_make(fmax(box.hi.x, p.x), fmax(box.hi.y, p.y));
    }
    return box;
}

void why_caption(const peak_detail *d, const replay_plan *plan, box2 window, double span, int32_t labels,
                 char out[WHY_CAPTION])
{
    char breaks[48] = "";
    if (replay_plan_marks_in(plan, window))
        snprintf(breaks, sizeof breaks, "; crosses: breaks of the last %.3g s", span);
    snprintf(out, WHY_CAPTION, "%s%s%s%s",
             d->floe_count > 0 ? mechanism_text(peak_main_mechanism(d->mechanism)) : "no ice touches the vessel",
             d->floe_count > 0 ? "; arrows: forces of floes on the hull, and chains behind them" : "", breaks,
             labels > 0 ? "; discs: floes that no frame shows" : "");
}

static fram_status draw_peak(const why *y, const replay *r, const replay_moment *m, const peak_detail *d, int32_t rank,
                             const char *path, fram_error *error)
{
    replay_plan plan = {0};
    vessel_entry vessel = scenario_vessel_entry(&y->run.s, y->vessel);
    double most = 0, part, force = 0, reach = fmax(0.75 * length_of(r, &vessel.keys->hull, y->vessel), 1);
    for (int32_t i = 0; i < m->poses.count; i++)
        if (part_in(d, &r->bodies.data[m->poses.data[i].body], &part))
            most = fmax(most, part);
    for (int32_t i = 0; i < d->floe_count; i++) {
        most = fmax(most, part_of(d, &d->floe[i]));
        force = fmax(force, vec3_length(d->floe[i].force));
    }
    double span = peak_span_before(&y->run.s);
    fram_status status = replay_plan_make(r, m, PLAN_COLOUR_PLAIN, 0, 1, 0, span, &plan, error);
    if (status == FRAM_OK) {
        double length = force > 0 ? 0.3 * reach / force : 0;
        char title[120], caption[WHY_CAPTION];
        plan_label labels[PEAK_FLOES];
        int32_t label_count = why_labels(r, m, d, most, length, labels);
        show_under_hull(&plan);
        colour_floes(r, m, d, most, &plan);
        if (!add_arrows(y->ctx, d, length, &plan))
            status = error_memory(error);
        char name[24] = "Ice load";
        if (rank > 0)
            snprintf(name, sizeof name, "Peak %d", (int)rank);
        const char *on = scenario_vessel_name(&y->run.s, y->vessel);
        snprintf(title, sizeof title, "%s%s%s: %s at %.6g s", name, on ? " on " : "", on ? on : "",
                 load_text_of(d->load, 4).text, d->time);
        const box2 window = why_window(r, m, d, y->vessel, reach);
        why_caption(d, &plan, window, span, label_count, caption);
        plan_view view = {.window = window,
                          .title = title,
                          .caption = caption,
                          .shapes = plan.shapes.data,
                          .shape_count = plan.shapes.count,
                          .marks = plan.marks.data,
                          .mark_count = plan.marks.count,
                          .arrows = plan.arrows.data,
                          .arrow_count = plan.arrows.count,
                          .labels = labels,
                          .label_count = label_count,
                          .arrow_scale = length,
                          .scale_name = most > 0 ? "part of the load [%]" : NULL,
                          .scale_hi = most};
        if (status == FRAM_OK)
            status = plan_view_write(y->ctx, &view, path, LONGEST_SIDE, error);
    }
    replay_plan_free(y->ctx, &plan);
    return status;
}

fram_status why_picture(const why *y, const peak_detail *d, int32_t rank, const char *path, fram_error *error)
{
    replay r;
    replay_moment m = {0};
    fram_status status = replay_open(y->ctx, y->run.folder, &r, error);
    if (status != FRAM_OK)
        return status;
    status = replay_moment_until(&r, d->time, &m, error);
    if (status == FRAM_ERROR_INPUT) /* a record that begins later: floes that no frame shows are named as that */
        status = replay_moment_now(&r, &m, error);
    if (status == FRAM_OK)
        status = draw_peak(y, &r, &m, d, rank, path, error);
    replay_moment_free(y->ctx, &m);
    replay_close(&r);
    return status;
}

fram_status why_picture_check(const why *y, const char *path, fram_error *error)
{
    replay r;
    fram_status status = path_refuse_read(y->run.folder, path, "picture", error);
    if (status == FRAM_OK)
        status = replay_open(y->ctx, y->run.folder, &r, error);
    if (status != FRAM_OK)
        return status;
    replay_close(&r);
    return folder_check_place(path, false, error);
}

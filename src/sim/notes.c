#include "sim/notes.h"

#include "base/transcendental.h"
#include "ice/floe.h"
#include "ice/fracture.h"
#include "sim/build.h"
#include "sim/scene_size.h"

static void note_ice(context *ctx, const scenario *s, text_buffer *out)
{
    const scenario_ice *i = &s->ice;
    const scenario_environment *e = &s->environment;
    if (i->source == ICE_NONE)
        return;
    ice_material m = {i->density,           i->elastic_modulus,   i->poisson_ratio,
                      i->flexural_strength, i->crushing_strength, i->crushing_exponent};
    double area = (s->domain.x_max - s->domain.x_min) * (s->domain.y_max - s->domain.y_min);
    text_format(ctx, out, "ice: floats with %.4g m under water; characteristic length l = %.4g m\n",
                i->thickness * i->density / e->water_density,
                ice_characteristic_length(&m, i->thickness, e->water_density, e->gravity));
    text_format(ctx, out, "ice: crushing pressure %.4g Pa on 1 m2; a vertical face loads %.4g kN per metre of width\n",
                ice_crushing_pressure(&m, 1), ice_crushing_pressure(&m, i->thickness) * i->thickness * 1e-3);
    if (i->source == ICE_VORONOI)
        text_format(ctx, out, "ice: about %.0f cells of %.4g m2 in a domain of %.4g m2\n", area / i->mean_floe_area,
                    i->mean_floe_area, area);
    text_format(ctx, out, "thresholds: floe %.4g m2, piece %.4g m2, edge %.4g m (scale %g)\n", i->smallest_floe_area,
                i->smallest_piece_area, i->edge_threshold, s->run.scale);
}

/* What breaks the ice at its edge, by the loads that SPEC 8 compares. */
static void note_fracture(context *ctx, const scenario *s, text_buffer *out)
{
    const scenario_ice *i = &s->ice;
    if (i->source == ICE_NONE || !i->breakable)
        return;
    double h = i->thickness, sigma = i->crushing_strength, areas[2] = {0.1 * h * h, h * h};
    ice_material m = {i->density,           i->elastic_modulus,   i->poisson_ratio,
                      i->flexural_strength, i->crushing_strength, i->crushing_exponent};
    fracture_settings f = build_fracture_settings(s);
    for (int k = 0; k < 2; k++) {
        edge_stress e = fracture_edge_stress(&f, &m, h, 1, areas[k], EDGE_STRAIGHT);
        text_format(
            ctx, out,
            "fracture: on %.3g m2 the radial crack opens at %.4g kN, %d wedges break off at %.4g kN, %.4g m from "
            "the edge; crushing there gives %.4g kN\n",
            areas[k], e.radial_capacity * 1e-3, (int)f.wedges, e.wedge_capacity * 1e-3, e.breaking_radius,
            ice_crushing_pressure(&m, areas[k]) * areas[k] * 1e-3);
    }
    /* The patch of a plate at 45 degrees, as wide as the ice is thick, grows until the wedges break off. */
    edge_stress e = fracture_edge_stress(&f, &m, h, 1, areas[0], EDGE_STRAIGHT);
    double depth = s->vessel.speed * s->run.time_step, needed = e.wedge_capacity / (sigma * h);
    if (s->vessel.present && depth > 0.2 * needed)
        text_format(ctx, out,
                    "warning: the vessel moves %.3g m in a step, and ice as wide as it is thick breaks after about "
                    "%.3g m of crushing; take run.time_step under %.3g s\n",
                    depth, needed, 0.2 * needed / s->vessel.speed);
}

static void note_vessel(context *ctx, const scenario *s, text_buffer *out)
{
    const scenario_vessel *v = &s->vessel;
    if (!v->present)
        return;
    double way = v->speed * s->run.time_step;
    text_format(ctx, out, "vessel: moves %.4g m in a step, %.4g m in the run\n", way, v->speed * s->run.duration);
    if (s->ice.source != ICE_NONE && way > 0.1 * s->ice.thickness)
        text_format(ctx, out,
                    "warning: the vessel moves %.2g of the ice thickness in a step; crushing patches grow in jumps. "
                    "Take run.time_step under %.3g s\n",
                    way / s->ice.thickness, 0.1 * s->ice.thickness / v->speed);
    double x = v->x + v->speed * s->run.duration * real_cos(radians(automatic_or(v->course_deg, v->heading_deg)));
    double y = v->y + v->speed * s->run.duration * real_sin(radians(automatic_or(v->course_deg, v->heading_deg)));
    bool inside = x > s->domain.x_min && x < s->domain.x_max && y > s->domain.y_min && y < s->domain.y_max;
    if (v->mode != VESSEL_FREE && !inside)
        text_format(ctx, out, "warning: the vessel leaves the domain before the end, at (%.4g, %.4g) m\n", x, y);
}

void scenario_notes(context *ctx, const scenario *s, text_buffer *out)
{
    text_format(ctx, out, "run: %.0f steps of %g s\n", floor(s->run.duration / s->run.time_step + 0.5),
                s->run.time_step);
    scene_size size = scene_size_of(s);
    text_format(ctx, out, "memory: about %.2g GB for about %.0f floes; run.memory_limit is %g GB\n", size.bytes * 1e-9,
                size.floes, s->run.memory_limit);
    note_ice(ctx, s, out);
    note_fracture(ctx, s, out);
    note_vessel(ctx, s, out);
    if (s->run.solver.baumgarte)
        text_add(ctx, out,
                 "warning: run.solver.baumgarte is a comparison switch; it is known to make the ice explode\n");
}

#include "sim/frame_size.h"

#include "io/record_blocks.h"
#include "model/scenario_vessel.h"

/* The blocks of poses and of forces without these. */
enum { HEADS_BYTES = 2 * RECORD_BLOCK_HEAD + FRAME_HEAD_SIZE + FORCES_HEAD_SIZE };
/* Floes that touch vessels in ice, about. */
enum { FLOES_AT_VESSELS = 16 };

/* pulls: mooring lines and thrusters of all vessels; meet: there are vessels and ice. */
static double frame_size(double bodies, double pulls, bool meet)
{
    double forces = pulls + (meet ? FLOES_AT_VESSELS : 0);
    return HEADS_BYTES + RECORD_TOUCHED_SIZE * bodies + RECORD_FORCE_SIZE * forces;
}

double frame_size_of_world(const world *w)
{
    int32_t bodies = 0;
    for (int32_t i = 0; i < w->bodies.count; i++)
        bodies += body_is_alive(&w->bodies, i) && w->bodies.motion[i] != MOTION_STATIC;
    return frame_size(bodies, w->lines.count + w->thrusters.count, w->vessels.count > 0 && w->floes.count > 0);
}

double frame_size_of_scenario(const scenario *s, double floes)
{
    int32_t vessels = scenario_vessel_count(s);
    double pulls = 0;
    for (int32_t v = 0; v < vessels; v++) {
        const scenario_vessel *keys = scenario_vessel_entry(s, v).keys;
        if (keys->mode != VESSEL_FREE)
            continue;
        pulls += keys->thrusters.count;
        for (int32_t i = 0; i < keys->mooring.lines.count; i++)
            pulls += (double)keys->mooring.lines.data[i].count;
    }
    return frame_size(floes + vessels, pulls, vessels > 0 && floes > 0);
}

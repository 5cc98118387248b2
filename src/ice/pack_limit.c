/* Bounds of the load between floes; see pack_limit.h. */
#include "ice/pack_limit.h"

#include "base/vec.h"

double pack_line_load(const pack_limit *limit, const pack_floe floe[2], double friction, double width)
{
    double thin = floe[0].thickness < floe[1].thickness ? floe[0].thickness : floe[1].thickness;
    double ridge = ice_ridging_line_load(limit->ridging, thin, width);
    if (limit->edge_slope <= 0)
        return ridge;
    double lift =
        ice_rafting_lift(&floe[0].ice, floe[0].thickness, &floe[1].ice, floe[1].thickness, limit->water_weight);
    /* Up a slope with friction; where friction holds on it, nothing slides. */
    double held = 1 - friction * limit->edge_slope;
    double raft = held > 0 ? lift * (limit->edge_slope + friction) / held : HUGE_VAL;
    return raft < ridge ? raft : ridge;
}

#include "model/scenario_words.h"

#include "base/text.h"
#include "model/scenario_vessel.h"

setting_text ice_strength_text(double crushing, double flexural, bool breaks)
{
    setting_text out;
    snprintf(out.text, sizeof out.text, "crushing strength %.4g kPa, flexural strength %.4g kPa, %s", crushing * 1e-3,
             flexural * 1e-3, breaks ? "breaks" : "does not break");
    return out;
}

setting_text ice_population_text(const scenario_ice *ice, int32_t population)
{
    setting_text out;
    const scenario_population *p = &ice->populations.data[population];
    snprintf(out.text, sizeof out.text, "%.4g m thick, %s", automatic_or(p->thickness, ice->thickness),
             ice_strength_text(automatic_or(p->crushing_strength, ice->crushing_strength),
                               automatic_or(p->flexural_strength, ice->flexural_strength),
                               ice->breakable && p->breakable)
                 .text);
    return out;
}

setting_text mooring_lines_text(const scenario_vessel *v)
{
    setting_text out = {""};
    int64_t count = 0;
    for (int32_t i = 0; i < v->mooring.lines.count; i++)
        count += v->mooring.lines.data[i].count;
    if (count > 0)
        snprintf(out.text, sizeof out.text, "%lld mooring line%s%s in %.4g m of water", (long long)count,
                 count > 1 ? "s" : "", v->mooring.turret ? " on a turret" : "", v->mooring.depth);
    return out;
}

const char *vessel_equilibrium_text(const scenario_vessel *v)
{
    return vessel_begins_at_equilibrium(v) ? ", from which it begins at the equilibrium of its mooring" : "";
}

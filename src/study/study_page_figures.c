/* The figures of the page of a study, and the units in which it tells them. */
#include "base/load_unit.h"
#include "study/study_page_parts.h"

#include <math.h>

const page_figure page_figures[PAGE_FIGURES] = {
    {ROW_load_mean, "Mean load", "kN", 1e-3},
    {ROW_load_significant, "Significant load", "kN", 1e-3},
    {ROW_load_largest, "Largest load", "kN", 1e-3},
    {ROW_offset_largest, "Largest offset", "m", 1},
    {ROW_line_tension_largest, "Largest line tension", "kN", 1e-3},
    {ROW_line_tension_range_equivalent, "Equivalent tension range", "kN", 1e-3},
    {ROW_thruster_power_mean, "Mean thruster power", "kW", 1e-3}};

static double largest_of(const study_page *p, run_figure figure)
{
    double most = 0;
    for (int32_t c = 0; c < p->f->s->conditions; c++)
        for (int32_t i = 0; i < p->conditions[c].rows.count; i++)
            most = fmax(most, p->conditions[c].rows.data[i].figure[figure]);
    return most;
}

void page_choose_units(study_page *p)
{
    load_unit load = load_unit_for(largest_of(p, ROW_load_largest)),
              tension = load_unit_for(
                  fmax(largest_of(p, ROW_line_tension_largest), largest_of(p, ROW_line_tension_range_equivalent))),
              power = power_unit_for(largest_of(p, ROW_thruster_power_mean));
    for (int i = 0; i < PAGE_FIGURES; i++) {
        page_figure *f = &p->figures[i];
        *f = page_figures[i];
        if (f->figure == ROW_offset_largest)
            continue;
        bool line = f->figure == ROW_line_tension_largest || f->figure == ROW_line_tension_range_equivalent;
        load_unit unit = line ? tension : f->figure == ROW_thruster_power_mean ? power : load;
        f->unit = unit.name;
        f->factor = unit.factor;
    }
}

page_figure page_figure_of(const study_page *p, run_figure figure)
{
    for (int i = 0; i < PAGE_FIGURES; i++)
        if (p->figures[i].figure == figure)
            return p->figures[i];
    return (page_figure){figure, run_figure_name(figure), run_figure_unit(figure), 1};
}

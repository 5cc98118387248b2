#include "ice/managed_ice.h"

#include "base/transcendental.h"

#include <math.h>

/* Lower edge of the first bin [m]. */
static const double SMALLEST = 0.25;

double managed_edge(int32_t bin) { return SMALLEST * real_pow(2, (double)bin / MANAGED_OCTAVE); }

static int32_t bin_of(double size)
{
    int32_t bin = 0, above = MANAGED_BINS;
    while (bin + 1 < above) {
        int32_t middle = (bin + above) / 2;
        if (size > managed_edge(middle))
            bin = middle;
        else
            above = middle;
    }
    return bin;
}

void managed_cover_add(managed_cover *cover, double size, double part)
{
    cover->of_bin[bin_of(size)] += part;
    cover->sized += part * size;
}

void managed_ice_add(managed_ice *ice, const managed_cover *window, double largest)
{
    ice->windows++;
    for (int32_t i = 0; i < MANAGED_BINS; i++)
        ice->sum.of_bin[i] += window->of_bin[i];
    ice->sum.sized += window->sized;
    ice->sum.sheet += window->sheet;
    ice->sum.volume += window->volume;
    ice->largest = fmax(ice->largest, largest);
}

/* Mean area of floes whose diameters are even between two. */
static double mean_area(double lo, double hi) { return PI / 4 * (lo * lo + lo * hi + hi * hi) / 3; }

static void fill_bins(const double part[MANAGED_BINS], managed_law *out)
{
    int32_t first = 0, last = MANAGED_BINS - 1;
    while (!(part[first] > 0))
        first++;
    while (!(part[last] > 0))
        last--;
    out->bins = last - first + 1;
    for (int32_t i = first; i <= last; i++) {
        double lo = managed_edge(i), hi = managed_edge(i + 1);
        out->edge[i - first] = lo;
        out->weight[i - first] = part[i] / mean_area(lo, hi);
    }
    out->edge[out->bins] = managed_edge(last + 1);
}

fram_status managed_law_of(const managed_ice *ice, double sheet_as, managed_law *out, fram_error *error)
{
    double part[MANAGED_BINS], floes = 0, sized = ice->sum.sized;
    *out = (managed_law){.largest = ice->largest};
    for (int32_t i = 0; i < MANAGED_BINS; i++)
        floes += part[i] = ice->sum.of_bin[i];
    double all = floes + ice->sum.sheet;
    if (!(ice->windows > 0 && all > 0))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "no ice came to the vessel after the transient");
    out->concentration = all / ice->windows;
    out->thickness = ice->sum.volume / all;
    out->sheet = ice->sum.sheet / all;
    if (sheet_as > 0) {
        part[bin_of(sheet_as)] += ice->sum.sheet;
        floes += ice->sum.sheet;
        sized += ice->sum.sheet * sheet_as;
    }
    if (!(floes > 0))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "no floe came to the vessel, unbroken ice alone");
    out->mean = sized / floes;
    fill_bins(part, out);
    return FRAM_OK;
}

size_law managed_size_law(const managed_law *from)
{
    return (size_law){.kind = SIZE_HISTOGRAM, .edge = from->edge, .weight = from->weight, .bins = from->bins};
}

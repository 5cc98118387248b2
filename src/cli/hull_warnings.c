#include "cli/hull_warnings.h"

#include <math.h>

/* Longer than any ship, as in the check of a scenario [m]; models of basins are shorter than any, and right. */
#define LONGEST_SHIP 500.0

void hull_warn_of_file(const common_options *common, const fram_hull_floating *f)
{
    if (common->quiet)
        return;
    if (f->length_waterline > LONGEST_SHIP)
        fprintf(stderr,
                "warning: the waterline is %.4g m long: a file in millimetres wants --scale 0.001, in centimetres "
                "0.01, in inches 0.0254, in feet 0.3048\n",
                f->length_waterline);
    if (f->axes == FRAM_HULL_Y_FORWARD)
        fprintf(stderr,
                "warning: the hull is %.4g m wide along y and %.4g m long along x: x is to be forward: turn the mesh\n",
                f->breadth_waterline, f->length_waterline);
    if (f->axes == FRAM_HULL_Y_UP)
        fprintf(stderr, "warning: the two sides of the hull lie about z = 0, not about y = 0: z is to be up, and y to "
                        "port: turn the mesh\n");
}

/* As a scenario is told of such water [kg/m3]. */
#define LIGHTEST_WATER 980.0
#define HEAVIEST_WATER 1100.0
/* Of all that the hull can displace: an empty one weighs more. */
#define LIGHTEST_MASS 0.05

static void warn_of_weight(const common_options *common, const fram_hull_condition *c, const fram_hull_floating *f)
{
    if (!isnan(c->mass) && f->volume < LIGHTEST_MASS * f->enclosed_volume && !common->quiet)
        fprintf(stderr, "warning: --mass: %.6g kg is %.2g %% of what the hull can displace, %.6g kg: give kilograms\n",
                c->mass, 100 * f->volume / f->enclosed_volume, c->water_density * f->enclosed_volume);
    if ((c->water_density < LIGHTEST_WATER || c->water_density > HEAVIEST_WATER) && !common->quiet)
        fprintf(stderr,
                "warning: --water-density: %.4g kg/m3 is outside of %.4g to %.4g, fresh water to brine: give kg/m3\n",
                c->water_density, LIGHTEST_WATER, HEAVIEST_WATER);
}

/* A scenario refuses such a centre of gravity. */
static void warn_of_centre(const common_options *common, const fram_hull_surface *s, const fram_hull_floating *f)
{
    static const char *const names[3] = {"--lcg", "--tcg", "--kg"};
    for (int i = 0; i < 3; i++) {
        double top = i == 2 ? 2 * s->hi[i] - s->lo[i] : s->hi[i];
        if ((f->centre[i] < s->lo[i] || f->centre[i] > top) && !common->quiet)
            fprintf(stderr,
                    "warning: %s: the centre of gravity is at %c = %.6g m, outside of the hull, %.6g to %.6g m%s\n",
                    names[i], "xyz"[i], f -> centre[i], s -> lo[i], top,
                    i == 2 ? ", its depth above its top included" : "");
    }
}

void hull_warn_of_condition(const common_options *common, const fram_hull_condition *condition,
                            const fram_hull_surface *surface, const fram_hull_floating *floating)
{
    warn_of_weight(common, condition, floating);
    warn_of_centre(common, surface, floating);
}

/* Of the length: less is rounding, as where the file is read again. */
#define LEVEL_TOLERANCE 1e-6
/* Heel and trim that are no more than rounding of the equilibrium [rad]: 5 mm at the ends of 100 m. */
#define UPRIGHT_TOLERANCE 1e-4

static double degrees_of(double angle)
{
    return fabs(angle) > UPRIGHT_TOLERANCE ? angle * 180 / 3.14159265358979323846 : 0;
}

/* The level is one of the hull turned upright: of a hull that is not, no plane z = const is the waterline. */
static bool warn_of_lean(const fram_hull_floating *f, const char *output)
{
    if (fmax(fabs(f->heel), fabs(f->trim)) <= UPRIGHT_TOLERANCE)
        return false;
    fprintf(stderr,
            "warning: %s: its z = 0 is not the waterline at that mass: the hull floats with a heel of %.3g deg and a "
            "trim of %.3g deg: turn it so first, or give --lcg, --tcg and --kg with which it floats upright\n",
            output, degrees_of(f->heel), degrees_of(f->trim));
    return true;
}

void hull_warn_of_level(const common_options *common, const fram_hull_condition *condition,
                        const fram_hull_surface *surface, const fram_hull_floating *floating, const char *output)
{
    double tolerance = LEVEL_TOLERANCE * (surface->hi[0] - surface->lo[0]);
    if (!output || !has_ending(output, "gdf") || common->quiet || warn_of_lean(floating, output))
        return;
    if (fabs(floating->level) > tolerance)
        fprintf(stderr, "warning: %s: its z = 0 is not the waterline at that %s: move the hull %s by %.6g m first\n",
                output, isnan(condition->mass) ? "draught" : "mass", floating->level > 0 ? "down" : "up",
                fabs(floating->level));
}

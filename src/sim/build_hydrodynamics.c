#include "sim/build_hydrodynamics.h"

#include "fluid/added_mass.h"
#include "sim/build_hull.h"
#include "sim/build_vessel.h"
#include "sim/matrix_check.h"

#include <string.h>

/* ---- matrices of the scenario ---- */

/* Entries m[i][j] and m[j][i] of an added mass may differ by this part of the diagonal, and its motions have so much
   less mass than none: published ones are rounded. */
#define ASYMMETRY 1e-3

static const char MASS_KEY[] = "hydrodynamics.added_mass";

static matrix6 rows_of(const scenario_matrix_row_list *rows)
{
    matrix6 a = {0};
    for (int i = 0; i < rows->count && i < 6; i++) {
        const scenario_matrix_row *r = &rows->data[i];
        const double row[6] = {r->surge, r->sway, r->heave, r->roll, r->pitch, r->yaw};
        memcpy(a.m[i], row, sizeof row);
    }
    return a;
}

/* Symmetric, nearly, and of no motion a negative mass; takes the mean of the two halves. */
static fram_status check_added_mass(const scenario *s, const vessel_entry *entry, matrix6 *a, fram_error *error)
{
    for (int i = 0; i < 6; i++) {
        if (a->m[i][i] < 0)
            return vessel_fault(s, entry, MASS_KEY, error,
                                "expected a diagonal without negative numbers, found %g in row %d", a->m[i][i], i + 1);
        for (int j = 0; j < i; j++) {
            double size = sqrt(a->m[i][i] * a->m[j][j]), mean = 0.5 * (a->m[i][j] + a->m[j][i]);
            if (fabs(a->m[i][j] - a->m[j][i]) > ASYMMETRY * size || fabs(mean) > size)
                return vessel_fault(
                    s, entry, MASS_KEY, error,
                    "expected a symmetric positive matrix, found %g in row %d, column %d, and %g across", a->m[i][j],
                    i + 1, j + 1, a->m[j][i]);
            a->m[i][j] = a->m[j][i] = mean;
        }
    }
    int row = matrix_failing_row(a, ASYMMETRY);
    if (row >= 0)
        return vessel_fault(s, entry, MASS_KEY, error,
                            "expected a symmetric positive matrix, found in row %d couplings by which a motion of it "
                            "with those before it has a negative mass",
                            row + 1);
    return FRAM_OK;
}

/* About the centre of mass, in the ship's axes. */
static matrix6 moved(const scenario_hydrodynamics *h, const matrix6 *a, vec3 centre)
{
    matrix6 up = h->axes == MATRIX_AXES_DOWN ? matrix6_turned_over(a) : *a;
    return matrix6_moved(&up, vec3_sub(vec3_make(h->x, h->y, h->z), centre));
}

static fram_status given(const scenario *s, const vessel_entry *entry, vec3 centre, hydrodynamics *out,
                         fram_error *error)
{
    const scenario_hydrodynamics *h = &entry->keys->hydrodynamics;
    matrix6 mass = rows_of(&h->added_mass), damping = rows_of(&h->damping);
    fram_status status = check_added_mass(s, entry, &mass, error);
    out->added_mass = moved(h, &mass, centre);
    out->damping = moved(h, &damping, centre);
    return status;
}

/* ---- estimate ---- */

/* upright: how the hull floats with its mass. */
static hydrodynamics estimate(const scenario *s, const scenario_vessel *v, const vessel_model *hull,
                              const hull_hydrostatics *upright)
{
    const hull_particulars *p = &hull->particulars;
    /* What no water bears is refused, or does not move by itself. */
    const hull_hydrostatics *f = upright->volume > 0 ? upright : &hull->floats;
    double density = s->environment.water_density, weight = density * s->environment.gravity;
    vec3 half = {0.5 * p->length, 0.5 * p->beam, p->draught}, arm = build_gyration(v, p);
    matrix6 mass = ellipsoid_added_mass(half, hull->floats.volume, density);
    hydrodynamics out = {0};
    out.added_mass = matrix6_moved(&mass, vec3_sub(vec3_make(p->midships, 0, 0), hull->centre));
    double m = automatic_or(v->mass, hull->displaced_mass), lift = f->centre_of_buoyancy.z - hull->centre.z;
    double heave_spring = weight * f->waterplane_area;
    double roll_spring = fmax(0, weight * (f->waterplane_xx + f->volume * lift));
    double pitch_spring = fmax(0, weight * (f->waterplane_yy + f->volume * lift));
    const scenario_hydrodynamics *h = &v->hydrodynamics;
    const matrix6 *a = &out.added_mass;
    out.damping.m[2][2] = 2 * h->heave_damping * sqrt(heave_spring * (m + a->m[2][2]));
    out.damping.m[3][3] = 2 * h->roll_damping * sqrt(roll_spring * (m * arm.x * arm.x + a->m[3][3]));
    out.damping.m[4][4] = 2 * h->pitch_damping * sqrt(pitch_spring * (m * arm.y * arm.y + a->m[4][4]));
    return out;
}

fram_status build_hydrodynamics(context *ctx, const scenario *s, const vessel_entry *entry, const solid *body,
                                vessel_model *vessel, fram_error *error)
{
    hydrodynamics_source source = entry->keys->hydrodynamics.source;
    vessel->has_hydrodynamics = source != HYDRODYNAMICS_NONE && s->environment.water;
    vessel->hydrodynamics = (hydrodynamics){0};
    if (source == HYDRODYNAMICS_GIVEN)
        return given(s, entry, vessel->centre, &vessel->hydrodynamics, error);
    if (source != HYDRODYNAMICS_ESTIMATE)
        return FRAM_OK;
    hull_hydrostatics upright;
    fram_status status = build_upright(ctx, s, entry, vessel, body, &upright, error);
    if (status == FRAM_OK)
        vessel->hydrodynamics = estimate(s, entry->keys, vessel, &upright);
    return status;
}

/* Mechanical properties of sea ice and what follows from them.  Knows no vessels and no files. */
#ifndef ICE_MATERIAL_H
#define ICE_MATERIAL_H

/* Of one floe; defaults and ranges stand in the scenario schema. */
typedef struct ice_material {
    double density;           /* [kg/m3] */
    double elastic_modulus;   /* [Pa] */
    double poisson_ratio;     /* [1] */
    double flexural_strength; /* sigma_f [Pa] */
    double crushing_strength; /* sigma_c [Pa]; with crushing_exponent e != 0 the pressure at 1 m2 */
    double crushing_exponent; /* e of sigma(A) = crushing_strength (A / 1 m2)^e; 0: constant */
} ice_material;

/* Stiffness of a plate of thickness h [m]: D = E h^3 / (12 (1 - nu^2)) [N m]. */
double ice_plate_stiffness(const ice_material *m, double thickness);
/* Characteristic length of that plate on water, l = (D / (rho_w g))^(1/4) [m] (Hertz 1884). */
double ice_characteristic_length(const ice_material *m, double thickness, double water_density, double gravity);
/* Crushing pressure sigma(A) [Pa] on a contact area A [m2]; 0 on no area when the law has an exponent (there A^e would
   be infinite for e < 0, but the force A sigma goes to 0 for e > -1). */
double ice_crushing_pressure(const ice_material *m, double area);
/* Line load at which ice of thickness h [m] builds a ridge over a width D [m]: w = R h^1.25 D^-0.54 in MN/m with h and
   D in metres and R 2 to 10 (ISO 19906; docs/decisions/0113), returned in N/m; infinite for R = 0 (no ridges) and on no
   width. */
double ice_ridging_line_load(double resistance, double thickness, double width);
/* Vertical line load [N/m] at which the edges of two sheets have pushed each other up and down far enough for one to
   slide over the other, by (h_a + h_b)/2 [m] together, on water of weight k = rho_w g [N/m3]: half-infinite strips give
   by 2 V/(k sqrt(2) l) at a loaded end, l the characteristic length (Hetenyi 1946).  Infinite where that bends one of
   them, by at most exp(-pi/4) sin(pi/4) V sqrt(2) l, past its flexural strength: such ice breaks instead (Parmerter
   1975; docs/decisions/0556). */
double ice_rafting_lift(const ice_material *a, double thickness_a, const ice_material *b, double thickness_b,
                        double water_weight);

#endif

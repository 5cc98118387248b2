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

#endif

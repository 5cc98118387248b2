/* Formulas of the material. */
#include "base/transcendental.h"
#include "ice/material.h"
#include "testing.h"

static const ice_material SAMPLE = {
    .density = 920, .elastic_modulus = 5e9, .poisson_ratio = 0.3, .flexural_strength = 0.5e6, .crushing_strength = 2e6};

START_TEST(plate_stiffness)
{
    assert_relative(ice_plate_stiffness(&SAMPLE, 1), 5e9 / (12 * 0.91), 1e-15);
    assert_relative(ice_plate_stiffness(&SAMPLE, 2), 8 * 5e9 / (12 * 0.91), 1e-15);
}
END_TEST

/* Hertz 1884. */
START_TEST(characteristic_length)
{
    assert_absolute(ice_characteristic_length(&SAMPLE, 1, 1025, 9.81), 14.6079, 5e-5);
    /* l grows with h^(3/4). */
    assert_relative(ice_characteristic_length(&SAMPLE, 16, 1025, 9.81),
                    8 * ice_characteristic_length(&SAMPLE, 1, 1025, 9.81), 1e-15);
    /* And falls with (rho g)^(1/4). */
    assert_relative(ice_characteristic_length(&SAMPLE, 1, 1025, 16 * 9.81), 14.6079 / 2, 5e-6);
    assert_relative(ice_characteristic_length(&SAMPLE, 1, 16 * 1025, 9.81), 14.6079 / 2, 5e-6);
    /* Froude scaling by 16: h and E times 16, l times 16, to the bit. */
    ice_material scaled = SAMPLE;
    scaled.elastic_modulus *= 16;
    assert_bits(ice_characteristic_length(&scaled, 16 * 0.7, 1025, 9.81),
                16 * ice_characteristic_length(&SAMPLE, 0.7, 1025, 9.81));
}
END_TEST

START_TEST(crushing_pressure)
{
    assert_bits(ice_crushing_pressure(&SAMPLE, 1e-6), 2e6);
    assert_bits(ice_crushing_pressure(&SAMPLE, 0), 2e6);
    ice_material law = SAMPLE;
    law.crushing_exponent = -0.5;
    assert_relative(ice_crushing_pressure(&law, 1), 2e6, 1e-15);
    assert_relative(ice_crushing_pressure(&law, 4), 1e6, 1e-15);
    assert_relative(ice_crushing_pressure(&law, 0.25), 4e6, 1e-15);
    assert_bits(ice_crushing_pressure(&law, 0), 0);
}
END_TEST

TEST_MAIN("material", plate_stiffness, characteristic_length, crushing_pressure)

/* simd.h for the baseline instruction set. */
#include "simd_cases.h"

TEST_MAIN("simd", SIMD_TESTS)

/* simd.h for AVX2, where compiler and processor have it. */
#include "base/random.h"
#include "testing.h"
#include <stdio.h>

/* clang has no such pragma for what the preprocessor sees; its kernels are tested in the rooms that have some. */
#if defined(FRAM_KERNELS_X86) && defined(__GNUC__) && !defined(__clang__)

#pragma GCC push_options
#pragma GCC target("avx2")
#include "simd_cases.h"
#pragma GCC pop_options

int main(void)
{
    if (isa_best() < ISA_AVX2) {
        puts("skipped: this processor has no AVX2");
        return 77;
    }
    const TTest *const list[] = {SIMD_TESTS};
    return testing_run("simd_avx2", list, (int)(sizeof list / sizeof *list));
}

#else

int main(void)
{
    puts("skipped: this compiler cannot switch to AVX2 inside a file");
    return 77;
}

#endif

/* simd.h for AVX-512, where compiler and processor have it. */
#include "base/random.h"
#include "testing.h"
#include <stdio.h>

/* clang has no such pragma for what the preprocessor sees; its kernels are tested in the rooms that have some. */
#if defined(FRAM_KERNELS_X86) && defined(__GNUC__) && !defined(__clang__)

#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl")
#include "simd_cases.h"
#pragma GCC pop_options

int main(void)
{
    if (isa_best() < ISA_AVX512) {
        puts("skipped: this processor has no AVX-512");
        return 77;
    }
    const TTest *const list[] = {SIMD_TESTS};
    return testing_run("simd_avx512", list, (int)(sizeof list / sizeof *list));
}

#else

int main(void)
{
    puts("skipped: this compiler cannot switch to AVX-512 inside a file");
    return 77;
}

#endif

/* Kernels: one source, compiled once per instruction set, chosen at run time.

   A file src/<room>/<topic>_kernel.c is compiled three times on x86-64: for the baseline, with -mavx2 and with
   -mavx512f -mavx512dq -mavx512vl (never with -mfma, always with -ffp-contract=off); elsewhere only for the
   baseline.  Each time KERNEL_SUFFIX is another word and KERNEL_LANES another number, so write

       topic_kernel.h    KERNEL_DECLARE(void, contact_solve, (contact_batch *batch, double dt));
       topic_kernel.c    void KERNEL(contact_solve)(contact_batch *batch, double dt) { ... }
       the caller        KERNEL_PICK(ctx, contact_solve)(batch, dt);

   Everything else in a kernel file is static.  Results must be the same to the bit for every instruction set:
   the batch width and the order of every sum are fixed by data, never by KERNEL_LANES, and no fused
   multiply-add is used.  Do not call inline functions of other headers that the linker could share between the
   copies: `static inline` is right, plain `inline` is not.

   Compiled by hand without the build system, a kernel file is the baseline. */
#ifndef BASE_KERNEL_H
#define BASE_KERNEL_H

#include "base/context.h"

#ifndef KERNEL_SUFFIX
#define KERNEL_SUFFIX _baseline
#endif
/* Doubles in one register: 1 (plain C), 4 (AVX2), 8 (AVX-512). */
#ifndef KERNEL_LANES
#define KERNEL_LANES 1
#endif

#define KERNEL_PASTE_(name, suffix) name##suffix
#define KERNEL_PASTE(name, suffix) KERNEL_PASTE_(name, suffix)
/* The name of this copy of a kernel. */
#define KERNEL(name) KERNEL_PASTE(name, KERNEL_SUFFIX)

/* FRAM_KERNELS_X86 is defined by the build when the wide copies are in it. */
#ifdef FRAM_KERNELS_X86
#define KERNEL_DECLARE(type, name, parameters) \
    type name##_baseline parameters;           \
    type name##_avx2 parameters;               \
    type name##_avx512 parameters
#define KERNEL_PICK(ctx, name) \
    ((ctx)->isa == ISA_AVX512 ? name##_avx512 : (ctx)->isa == ISA_AVX2 ? name##_avx2 : name##_baseline)
#else
#define KERNEL_DECLARE(type, name, parameters) type name##_baseline parameters
#define KERNEL_PICK(ctx, name) ((void)(ctx), name##_baseline)
#endif

#endif

#!/bin/sh
# tools/fuzz_fracture.sh PLAIN ASAN EVENTS: random floes broken EVENTS times in ten parts, each with its own seed, by
# the test program PLAIN; the first part once more by ASAN, the same test with AddressSanitizer and
# UndefinedBehaviorSanitizer.  Stops at the first part that fails, and says how to repeat it.
set -eu
part=$((($3 + 9) / 10))

part_of() {
    said=$(FRAM_FUZZ_EVENTS=$part FRAM_FUZZ_SEED=$2 CK_FORK=no "$1" 2>&1) || {
        echo "$said" >&2
        echo "failed; again: FRAM_FUZZ_EVENTS=$part FRAM_FUZZ_SEED=$2 CK_FORK=no $1" >&2
        exit 1
    }
    echo "$said" | sed -n "s/^[0-9]* events/seed $2: &/p"
}

for seed in 1 2 3 4 5 6 7 8 9 10; do
    part_of "$1" "$seed"
done
echo "seed 1 under ASan and UBSan:"
part_of "$2" 1

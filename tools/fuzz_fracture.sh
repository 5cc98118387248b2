#!/bin/sh
# tools/fuzz_fracture.sh PLAIN ASAN EVENTS: random floes broken EVENTS times, and random sheets of level ice as often,
# in ten parts each with its own seed, by the test programs in the folder PLAIN; the first part once more by those in
# ASAN, the same with AddressSanitizer and UndefinedBehaviorSanitizer.  Stops at the first part that fails, and says how
# to repeat it.
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

for test in test_ice_fracture_fuzz test_ice_fracture_fuzz_sheet; do
    echo "$test:"
    for seed in 1 2 3 4 5 6 7 8 9 10; do
        part_of "$1/$test" "$seed"
    done
    echo "seed 1 under ASan and UBSan:"
    part_of "$2/$test" 1
done

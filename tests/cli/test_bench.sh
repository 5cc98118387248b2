#!/usr/bin/env bash
# fram bench --scene: the same state for every thread count, instruction set and choice of functions of the C library;
# the numbers that benchmarks read; refusals.
. "$FRAM_SOURCE/tests/cli/common.sh"
key_of() { python3 -c 'import json, sys; print(json.load(sys.stdin)[sys.argv[1]])' "$1"; }

scene=$scratch/small.scene
python3 "$FRAM_SOURCE/bench/peers/gen_scene.py" --n 150 --coverage 0.9 --current 0.3 0 --seed 3 -o "$scene" >/dev/null
steps=${FRAM_TEST_SHORT:+5.2}
bench() { "$FRAM" bench --scene "$scene" --warm 5 --time "${steps:-8}" --json --quiet "$@"; }

bench >"$scratch/plain"
hash=$(key_of state_hash <"$scratch/plain")
for key in ms_per_step_median ms_wall_median us_per_floe_step contact_points pairs mean_penetration_m \
    max_penetration_m ship_force_kN kinetic_energy_J collide_ms solve_ms forces_ms ms_wall_p99 ms_wall_p999 \
    ms_wall_longest; do
    key_of $key <"$scratch/plain" >/dev/null || fail "no $key in the answer"
done
# Times in their order, and parts that are most of the whole.
python3 - "$scratch/plain" <<'END' || fail "times of steps or shares: $(cat "$scratch/plain")"
import json, sys
r = json.load(open(sys.argv[1]))
assert 0 < r["ms_per_step_median"] <= r["ms_p99"] <= r["ms_p999"] <= r["ms_longest"]
assert r["ms_mean"] <= r["ms_longest"] <= r["ms_mean"] * r["steps"]
assert r["ms_wall_median"] <= r["ms_wall_p99"] <= r["ms_wall_p999"] <= r["ms_wall_longest"]
shares = [r["share_" + name] for name in ("forces", "collision", "crushing", "solver", "fracture")]
assert all(0 <= share < 1 for share in shares) and 0.5 < sum(shares) <= 1.000001, shares
END
[ "$(key_of floes <"$scratch/plain")" = 150 ] || fail "wrong number of floes"

same_state() {
    [ "$1" = "$hash" ] || fail "$2: state $1 instead of $hash"
}
for threads in 2 3 4 8; do
    same_state "$(bench --threads $threads | key_of state_hash)" "$threads threads"
done
for isa in baseline avx2 avx512; do
    if answer=$(bench --isa $isa 2>/dev/null); then
        same_state "$(key_of state_hash <<<"$answer")" "--isa $isa"
    fi
done
tunables=glibc.cpu.hwcaps=-AVX2,-FMA,-AVX2_Usable,-FMA_Usable,-AVX512F
same_state "$(GLIBC_TUNABLES=$tunables bench | key_of state_hash)" "$tunables"

# Fram's own water on the same scene: another state, and that on any instruction set.
hash=$(bench --exact-water | key_of state_hash)
[ "$hash" != "$(key_of state_hash <"$scratch/plain")" ] || fail "--exact-water changes nothing"
same_state "$(bench --exact-water --isa baseline --threads 3 | key_of state_hash)" "--exact-water, baseline, 3 threads"
hash=$(key_of state_hash <"$scratch/plain")

# Poses, and how deep they overlap.  The ship has jammed the floes against the walls by then: enough sweeps for that.
bench --iterations 30 --dump "$scratch/poses.csv" >/dev/null
[ "$(wc -l <"$scratch/poses.csv")" = 151 ] || fail "the poses have not one line a floe"
python3 "$FRAM_SOURCE/bench/penetration.py" "$scene" "$scratch/poses.csv" | key_of max_m >"$scratch/overlap"
python3 -c 'import sys; sys.exit(not 0 <= float(open(sys.argv[1]).read()) < 0.2)' "$scratch/overlap" ||
    fail "overlap of $(cat "$scratch/overlap") m"

refuses() {
    local words=$1 code=0
    shift
    "$FRAM" bench "$@" >/dev/null 2>"$scratch/err" || code=$?
    [ $code = 2 ] || fail "exit code $code instead of 2: $*"
    grep -q -- "$words" "$scratch/err" || fail "'$(cat "$scratch/err")' lacks '$words'"
}
refuses "SCENARIO"
refuses "not both" scenes/demo.yaml --scene "$scene"
refuses "--dump" scenes/demo.yaml --dump x.csv
refuses "--dump: expected a table's name that ends in .csv" --scene "$scene" --dump "$scratch/poses.txt"
refuses "--exact-water" scenes/demo.yaml --exact-water
refuses "is for scenarios" --scene "$scene" --set a=b
refuses "solver" --scene "$scene" --solver best
refuses "iterations" --scene "$scene" --iterations 0
refuses "warm" --scene "$scene" --warm 5 --time 5
# The bounds are the library's, by the names of options.
for words in "--warm -1" "--warm 2e+06" "--time 2e+06"; do
    # shellcheck disable=SC2086
    refuses "${words% *}: expected a number from 0 to 1e+06, found ${words#* }" --scene "$scene" $words
done
refuses "--time: needs a number above zero" --scene "$scene" --time 0
refuses "--dt: expected a number from 1e-09 to 1e+06, found 1e-12" --scene "$scene" --dt 1e-12

# What the help tells as defaults, given by hand, changes nothing.
expect 0 "$FRAM" bench --help
of_scenario=$(told_defaults simulated 'measur[a-z]* \(')
of_scene=$(told_defaults simulated 'scene: ' && told_defaults simulated 'total \(' &&
    told_defaults "scene: time|scene: solver" '\(')
same "$(wc -l <<<"$of_scenario") $(wc -l <<<"$of_scene")" "2 4" "defaults that the help tells: $of_scenario $of_scene"
cat >open.yaml <<'END'
vessel: {mode: free, speed: 1, hull: {form: box, length: 20, beam: 8, draught: 2}}
ice: {source: none}
domain: {boundary: open}
END
python3 "$FRAM_SOURCE/bench/peers/gen_scene.py" --n 6 --coverage 0.5 --current 0.3 0 --seed 3 -o few.scene >/dev/null
outcome() { python3 -c 'import json, sys; j = json.load(sys.stdin); print(j["steps"], j["state_hash"])' <out; }
while read -r what told; do
    expect 0 "$FRAM" bench "$what" --json
    bare=$(outcome)
    # shellcheck disable=SC2086
    expect 0 "$FRAM" bench "$what" $told --json
    same "$(outcome)" "$bare" "bench $what with the defaults of the help: $told"
done <<END
open.yaml $(xargs <<<"$of_scenario")
--scene=few.scene $(xargs <<<"$of_scene")
END

printf 'icescene 1\nfloe 1 2\n' >"$scratch/bad.scene"
refuses "bad.scene:2" --scene "$scratch/bad.scene"

finish "fram bench --scene: as it should be"

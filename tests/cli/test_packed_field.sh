#!/usr/bin/env bash
# A packed field through fram bench --scene: Voronoi floes at 98 % pressed against a wall by a current come to rest and
# stay there for 10,000 steps, without jitter, gain of energy or growing overlap.
. "$FRAM_SOURCE/tests/cli/common.sh"

scene=$scratch/packed.scene
floes=200
[ -z "${FRAM_TEST_SHORT:-}" ] || floes=100 # under sanitizers
python3 "$FRAM_SOURCE/bench/peers/gen_scene.py" --n $floes --coverage 0.98 --current 0.3 0 --ship-speed 0 --seed 2 \
    -o "$scene" >/dev/null
steps=${FRAM_TEST_SHORT:+500}
bench() { "$FRAM" bench --scene "$scene" --iterations 10 --json --quiet "$@"; }
settled=60
end=$(python3 -c "print($settled + 0.02 * ${steps:-10000})")
bench --warm $settled --time "$(python3 -c "print($settled + 1)")" >"$scratch/early"
bench --warm $settled --time "$end" >"$scratch/late"

python3 - "$scratch" $floes <<'EOF'
import json
import sys

early, late = (json.load(open(f"{sys.argv[1]}/{name}")) for name in ("early", "late"))
mass = 0
for line in open(f"{sys.argv[1]}/packed.scene"):
    word = line.split()
    if word and word[0] == "floe":
        v = [float(x) for x in word[6:]]
        x, y = v[0::2], v[1::2]
        mass += float(word[1]) * float(word[2]) * sum(x[i - 1] * y[i] - x[i] * y[i - 1] for i in range(len(x))) / 2
rms = [(2 * r["kinetic_energy_J"] / mass) ** 0.5 for r in (early, late)]  # with what turns, so no less than it is
bad = []
if not max(rms) < 1e-5:
    bad.append(f"rms velocity {rms} m/s")
if not late["max_penetration_m"] < 1e-4:  # of a metre of thickness
    bad.append(f"overlap of {late['max_penetration_m']} m")
# Below a tenth of the bound energies go up and down with what the sweeps leave.
if not late["kinetic_energy_J"] <= max(early["kinetic_energy_J"], 0.5 * mass * 1e-12):
    bad.append(f"energy grew from {early['kinetic_energy_J']} to {late['kinetic_energy_J']} J")
if not late["loaded_pairs"] > int(sys.argv[2]):
    bad.append(f"only {late['loaded_pairs']} pairs press on one another")
for line in bad:
    print("FAILED:", line)
deep, pairs = late["max_penetration_m"], late["loaded_pairs"]
print(f"rms velocity {rms[0]:.3g}, {rms[1]:.3g} m/s; overlap {deep:.3g} m; {pairs:.0f} pairs")
sys.exit(bool(bad))
EOF

#!/usr/bin/env bash
# A ship on a turret in level ice that turns about: the scene for it, with a drift that is quicker than in the scene.
# Ice that comes from ahead pushes the ship astern, and ahead once it comes from astern; the mooring holds it.
. "$FRAM_SOURCE/tests/cli/common.sh"
cp "$FRAM_SOURCE/scenes/turret_turning.yaml" .
python3 - <<'PY'
import math

with open("drift_about.csv", "w") as file:
    file.write("time[s],x[m/s],y[m/s]\n0,-1,0\n10,-1,0\n")
    for k in range(1, 13):
        angle = math.radians(180 - 15 * k)
        file.write(f"{10 + k / 2},{math.cos(angle):.6f},{math.sin(angle):.6f}\n")
PY
expect 0 "$FRAM" run turret_turning.yaml -o about -q --set run.duration=32 --set run.time_step=0.04 \
    --set output.csv_interval=0.2
python3 - <<'PY' || fail "the ship does not go with the drift"
import csv, sys

rows = list(csv.reader(open("about/series.csv")))
head = [name.split("[")[0] for name in rows[0]]
column = lambda name: [float(r[head.index(name)]) for r in rows[1:]]
time, load, offset = column("time"), column("ice_force_x"), column("offset_x")
mean = lambda values, since, until: sum(v for t, v in zip(time, values) if since <= t < until)
before, after = mean(load, 0, 12), mean(load, 20, 33)
faults = []
if not (before < 0 and after > 0):
    faults.append(f"ice from ahead gives {before:g} N along x, from astern {after:g} N")
if not min(offset) < -0.1:
    faults.append(f"the ship is pushed astern by {-min(offset):g} m only")
if not offset[-1] > min(offset) + 0.1:
    faults.append(f"the ship stays astern, at {offset[-1]:g} m")
if max(map(abs, offset)) > 20 or max(column("lines_parted")) > 0:
    faults.append("the mooring does not hold")
sys.exit("; ".join(faults) if faults else 0)
PY
finish "a moored ship in level ice that turns about"

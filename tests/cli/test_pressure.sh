#!/usr/bin/env bash
# fram pressure: a vertical plate crushes a sheet of 0.5 m evenly over its width. The panels' forces add up to the load
# of series.csv in each axis; those in the ice bear crushing strength times the part of them that is in it. Two vessels
# by name with a heading, a hull of two boxes, frames of one's own, a part of the run from its checkpoint; refusals.
. "$FRAM_SOURCE/tests/cli/common.sh"
cat >plate.yaml <<'YAML'
run: {duration: 3, time_step: 0.02}
vessel: {mode: prescribed, x: -21.1, speed: 0.5, hull: {form: box, length: 40, beam: 20, draught: 4, freeboard: 3}}
domain: {boundary: open, x_min: -60, x_max: 60, y_min: -30, y_max: 30}
ice:
  source: level
  thickness: 0.5
  level: {x_min: 0}
  friction: {ice_hull_static: 0, ice_hull_kinetic: 0}
output: {checkpoint_interval: 1, frame_interval: 1}
YAML
expect 0 "$FRAM" run plate.yaml -o run --quiet
find run -type f -exec cksum {} + | sort >before
expect 0 "$FRAM" pressure run -o map --panel 2 --from 2.5
for file in map/*; do
    says "${file#map/}" err
done
find run -type f -exec cksum {} + | sort >after
cmp -s before after || fail "fram pressure changes the run's folder"
cat >tables.py <<'PYTHON'
import csv
import math


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def table(path):
    return [{k.split("[")[0]: number(v) for k, v in r.items()} for r in csv.DictReader(open(path))]


def loads(run, name, since, heading=0.0, until=1e9):
    """Mean ice load in the vessel's axes."""
    rows = [r for r in table(f"{run}/series.csv") if since + 1e-6 < r["time"] < until + 1e-6]
    x, y, z = (sum(r[f"{name}ice_force_{a}"] for r in rows) / len(rows) for a in "xyz")
    return (x * math.cos(heading) + y * math.sin(heading), y * math.cos(heading) - x * math.sin(heading), z), rows


def balance(panels, wanted):
    size = max(map(abs, wanted))
    for axis, want in zip("xyz", wanted):
        found = sum(p[f"force_{axis}"] for p in panels)
        assert abs(found - want) < 1e-6 * size, (axis, found, want)
PYTHON
python3 - <<'PYTHON' || fail "panels of a plate"
from tables import balance, loads, table
panels = table("map/panels.csv")
wanted, rows = loads("run", "", 2.5)
balance(panels, wanted)
hull = 2 * (40 * 20 + 40 * 7 + 20 * 7)
assert abs(sum(p["area"] for p in panels) / hull - 1) < 1e-9
bow = [p for p in panels if p["side"] == "bow"]
assert len(bow) == 10 * 4, len(bow)
# The panels from 0 to 2 m down hold most of the ice, 0.1 of them stands above the water: 920/1025 of 0.5 m is under it.
middle = [p for p in bow if p["y_min"] >= -8.1 and p["y_max"] <= 8.1]
under = [p for p in middle if p["row"] == -1]
above = [p for p in middle if p["row"] == 0]
draught = 0.5 * 920 / 1025
for p in under:
    assert abs(p["pressure_mean"] / (2e6 * draught / 2) - 1) < 0.05, p
for p in above:
    assert abs(p["pressure_mean"] / (2e6 * (0.5 - draught) / 2) - 1) < 0.25, p
assert all(p["pressure_mean"] == 0 for p in bow if p["row"] < -1 or p["row"] > 0)
assert all(p["pressure_mean"] <= p["pressure_largest"] * (1 + 1e-9) for p in panels)
assert all(abs(p["pressure_cumulative"] - p["pressure_mean"] * 0.5) <= 1e-6 * (1 + p["pressure_mean"]) for p in panels)
assert all(2.5 < p["time_of_largest"] <= 3 for p in panels if p["pressure_largest"] > 0)
assert all(p["time_of_largest"] == "" for p in panels if p["pressure_largest"] == 0)
curve = table("map/area.csv")
one = [c for c in curve if (c["columns"], c["rows"]) == (1, 1)][0]
assert abs(one["pressure_largest"] - max(p["pressure_largest"] for p in panels)) < 1e-6 * one["pressure_largest"]
# An even line load: as much on a row of eight panels as on one; two rows hold all of the ice.
long = [c for c in curve if (c["columns"], c["rows"]) == (8, 1)][0]
assert abs(long["pressure_largest"] / one["pressure_largest"] - 1) < 0.05, (long, one)
square = [c for c in curve if (c["columns"], c["rows"]) == (2, 2)][0]
assert abs(square["pressure_largest"] / (2e6 * 0.5 / 4) - 1) < 0.05, square
for c in curve:
    wanted = 7.4e6 * c["area"] ** -0.7 if c["area"] <= 10 else 1.48e6
    assert abs(c["iso_19906"] / wanted - 1) < 1e-9, c
PYTHON
[ -s map/hull.vtp ] || fail "no hull.vtp"
! built_with cairo || [ -s map/pressure.png ] || fail "no pressure.png"
# The sides stand as far apart whatever the size of the panels.
if built_with cairo; then
    expect 0 "$FRAM" pressure run -o coarse --panel 9 --from 2.9 --quiet
    python3 "$FRAM_SOURCE/tests/cli/pixels.py" size map/pressure.png coarse/pressure.png || fail "coarse/pressure.png"
fi
# Of a strip of ice the bow has panels that it met between others: these are one area all the same.
if built_with cairo; then
    expect 0 "$FRAM" run plate.yaml -o strip --set domain.y_min=-3 --set domain.y_max=3 --quiet
    expect 0 "$FRAM" pressure strip -o strip-map --panel 1.3 --from 2.5 --quiet
    python3 "$FRAM_SOURCE/tests/cli/pixels.py" seamless strip-map/pressure.png || fail "pressure.png has seams"
fi
# Pictures without any load differ by what they say: of which time, and whose lines.
if built_with cairo; then
    expect 0 "$FRAM" pressure run -o early --panel 2 --to 0.5 --quiet
    expect 0 "$FRAM" pressure run -o later --panel 2 --from 0.5 --to 1 --quiet
    expect 0 "$FRAM" pressure run -o framed --panel 2 --to 0.5 --frames -20:2:20 --quiet
    for other in later framed; do
        cmp -s early/pressure.png $other/pressure.png && fail "$other/pressure.png says the same as early/pressure.png"
    done
fi
# A tank has panels of a metre of full size, and no pressures of the sea beside its own.
cat >tank.yaml <<'YAML'
run: {duration: 0.3, time_step: 0.01, scale: 3}
vessel:
  {mode: prescribed, x: -2.11, speed: 0.5, hull: {form: box, length: 4, beam: 2, draught: 0.4, freeboard: 0.3}}
domain: {boundary: open, x_min: -6, x_max: 6, y_min: -3, y_max: 3}
ice: {source: level, thickness: 0.05, crushing_strength: 2.0e5, level: {x_min: 0}}
output: {frame_interval: 0}
YAML
expect 0 "$FRAM" run tank.yaml -o tank --quiet
expect 0 "$FRAM" pressure tank -o small --quiet
python3 - <<'PYTHON' || fail "panels of a tank"
from tables import table
bow = [p for p in table("small/panels.csv") if p["side"] == "bow"]
assert len(bow) == 20 * 7, len(bow)
assert all(abs(p["area"] / 0.01 - 1) < 1e-6 for p in bow), bow
curve = table("small/area.csv")
assert curve and all(c["pressure_largest"] > 0 and c["iso_19906"] == "" for c in curve), curve
PYTHON
# From the start as from a checkpoint.
mkdir moved
mv run/checkpoint* moved/
expect 0 "$FRAM" pressure run -o again --panel 2 --from 2.5 --quiet
cmp -s map/panels.csv again/panels.csv || fail "another map from the start than from a checkpoint"
mv moved/* run/
expect 0 "$FRAM" pressure run -o own --frames -20:5:20 --stringers -0.5,0.5 --quiet
python3 - <<'PYTHON' || fail "frames of one's own"
from tables import balance, loads, table
panels = table("own/panels.csv")
balance(panels, loads("run", "", 0)[0])
port = [p for p in panels if p["side"] == "port"]
assert len(port) == 8 * 3, len(port)
assert {(p["x_min"], p["x_max"]) for p in port} == {(x, x + 5) for x in range(-20, 20, 5)}
PYTHON
# Two hulls in one file, and beside it a second vessel across.
python3 - <<'PYTHON'
faces = [(1, 3, 2), (1, 4, 3), (5, 6, 7), (5, 7, 8), (1, 2, 6), (1, 6, 5), (2, 3, 7), (2, 7, 6), (3, 4, 8), (3, 8, 7),
         (4, 1, 5), (4, 5, 8)]
with open("twin.obj", "w") as out:
    for hull, (low, high) in enumerate(((-9, -5), (5, 9))):
        for z in (-3, 3):
            for x, y in ((-15, low), (15, low), (15, high), (-15, high)):
                print("v", x, y, z, file=out)
        for face in faces:
            print("f", *(v + 8 * hull for v in face), file=out)
PYTHON
cat >two.yaml <<'YAML'
run: {duration: 3, time_step: 0.02, seed: 2}
vessels:
  - {name: twin, mode: prescribed, x: -40, speed: 4, hull: {form: file, file: twin.obj, draught: 3}}
  - {name: other, mode: prescribed, x: 25, y: -28, heading_deg: 90, speed: 4,
     hull: {form: icebreaker, length: 30, beam: 9, draught: 3, freeboard: 2, stem_angle_deg: 25, entrance_angle_deg: 40,
            parallel_midbody: 0.45}}
ice: {concentration: 0.7, mean_floe_area: 30, thickness: 0.5}
domain: {x_min: -60, x_max: 60, y_min: -50, y_max: 50}
output: {frame_interval: 0}
YAML
expect 0 "$FRAM" run two.yaml -o two --quiet
expect 0 "$FRAM" pressure two -o twin --vessel twin --panel 1.5 --quiet
expect 0 "$FRAM" pressure two -o other --vessel other --panel 1 --quiet
python3 - <<'PYTHON' || fail "two vessels by name"
import math
from tables import balance, loads, table
twin, other = table("twin/panels.csv"), table("other/panels.csv")
wanted, rows = loads("two", "twin.", 0)
balance(twin, wanted)
parts = table("twin/zones.csv")
balance(parts, wanted)
assert len(parts) == 5 * 8, len(parts)
size = max(map(abs, wanted))
for key, column in (("zone", "twin.ice_{}_{}"), ("mechanism", "twin.mechanism_{}_{}")):
    for name in {p[key] for p in parts}:
        for axis in "xyz":
            channel = column.format(name, axis)
            if channel not in rows[0]:
                assert key == "zone", channel
                continue
            mean = sum(r[channel] for r in rows) / len(rows)
            found = sum(p[f"force_{axis}"] for p in parts if p[key] == name)
            assert abs(found - mean) < 1e-6 * size, (channel, found, mean)
balance(other, loads("two", "other.", 0, math.pi / 2)[0])
# Inner sides are panels of their own.
port = {p["patch"] for p in twin if p["side"] == "port"}
assert len(port) == 2, port
assert all(p["area"] <= 1.5 ** 2 * 1.5 for p in twin)
assert any(p["pressure_largest"] > 0 for p in twin) and any(p["pressure_largest"] > 0 for p in other)
PYTHON
# A run that was stopped, one that was cut short, and one whose end nothing tells but its rows.
expect 0 "$FRAM" run plate.yaml -o part --until 2.8 --quiet
expect 0 "$FRAM" pressure part -o half --panel 2 --to 9
says "the run has gone to 2.8 s: pressures are up to there, not to 9 s" err
python3 -c '
from tables import balance, loads, table
balance(table("half/panels.csv"), loads("part", "", 0)[0])
' || fail "the mean of a run that was stopped"
expect 2 "$FRAM" pressure part -o none --from 2.9
says "up to 2.8 s" err
sed -i 's/"status": "stopped"/"status": "running"/' part/run.json
head -n 126 part/series.csv >rows && printf '2.52,0.5' >>rows && mv rows part/series.csv
expect 2 "$FRAM" pressure part -o none --from 2.6
says "up to 2.5 s" err
expect 0 "$FRAM" pressure part -o half --panel 2 --force --quiet
rm part/series.csv
expect 0 "$FRAM" pressure part -o half --panel 2 --force --to 0.2
says "is not known" err
# A vertical ship among floes that turn away: patches of which some points carry.  Behind the stem, where patches are
# flat, a panel bears what the ice does, or with two patches that the motion divides, as rectangles that overlap, less
# than twice that.
cat >wedge.yaml <<'YAML'
run: {duration: 8, time_step: 0.02}
vessel:
  mode: prescribed
  x: -60
  speed: 2
  hull: {form: ship, length: 60, beam: 14, draught: 5, freeboard: 4, stem_angle_deg: 90, entrance_angle_deg: 40}
ice: {source: voronoi, concentration: 0.8, thickness: 0.8, mean_floe_area: 200, crushing_strength: 2.0e6}
domain: {x_min: -110, x_max: 30, y_min: -40, y_max: 40}
output: {frame_interval: 0}
YAML
expect 0 "$FRAM" run wedge.yaml -o wedge --quiet
expect 0 "$FRAM" pressure wedge -o wedged --panel 0.4 --quiet
python3 - <<'PYTHON' || fail "pressures of patches of which some points carry"
from tables import balance, loads, table
panels = table("wedged/panels.csv")
balance(panels, loads("wedge", "", 0)[0])
worst = max((p["pressure_largest"], p["x"]) for p in panels if p["x"] < 28)
assert 1e6 < worst[0] <= 3e6, worst
PYTHON
expect 2 "$FRAM" pressure run
expect 2 "$FRAM" pressure run -o map
# A time between two steps: the one that ends after it belongs to the time that follows.  A link in place of a file is
# not followed.
echo mine | tee kept >precious
ln -sf ../precious map/pressure.fram
expect 0 "$FRAM" pressure run -o map --panel 2 --force --from 2.5 --to 2.553 --quiet
{ cmp -s precious kept && [ ! -L map/pressure.fram ]; } || fail "fram pressure writes through a link"
[ -z "$(find . -name '*.new')" ] || fail "half-written files are left: $(find . -name '*.new')"
expect 0 "$FRAM" pressure run -o rest --panel 2 --from 2.553 --to 2.6 --quiet
python3 - <<'PYTHON' || fail "two times that meet between two steps"
from tables import balance, loads, table
for folder, since, until in ("map", 2.5, 2.54), ("rest", 2.54, 2.6):
    panels = table(folder + "/panels.csv")
    balance(panels, loads("run", "", since, until=until)[0])
    for p in panels:
        wanted = p["pressure_mean"] * (until - since)
        assert abs(p["pressure_cumulative"] - wanted) <= 1e-6 * (1 + wanted), p
PYTHON
for bad in "--panel 0" "--panel -1" "--panel 41" "--panel 1e-4" "--from 5" "--from 2 --to 1" "--vessel ghost" \
    "--from 2.54 --to 2.553" \
    "--frames 3,1" "--frames 1,,2" "--frames 0:1" "--frames 0:-1:5" "--frames x" "--stringers 1,nan" "--frames 0x1" \
    "--frames 0:1e-9:5" "--frames 100,200" "--stringers -90"; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" pressure run -o none $bad
    [ "$(wc -l <err)" -le 2 ] || fail "$bad: more than one message: $(cat err)"
done
# Peaks that cannot be read cost a page its peaks alone, neither the loads by mechanism nor the pressure.
echo "no peaks" >run/peaks.fram
echo "<!--BESIDE--><!--RECORD-->" >page.html
expect 0 "$FRAM" view run --page page.html --pressure rest -o told.html
holds "^warning: the page tells no peaks: run/peaks.fram: expected a record" err
python3 - <<'PYTHON' || fail "a page without peaks"
import base64
import re
data = b"".join(base64.b64decode(part) for part in re.findall("[A-Za-z0-9+/=]{99,}", open("told.html").read()))
assert b'"mechanisms":[[' in data and b'"load":[' in data and b'"peaks":[]' in data
assert open("rest/pressure.fram", "rb").read()[48:] in data
PYTHON
# No file that its scenario reads is written over.
mkdir blown
printf 'time,x,y\n0,1,0\n' | tee blown/zones.csv >wind.csv
expect 0 "$FRAM" run plate.yaml -o windy --until 0.1 --quiet --set environment.wind_file=blown/zones.csv
expect 2 "$FRAM" pressure windy -o blown --force
says "blown/zones.csv: --output: expected a file of its own" err
cmp -s wind.csv blown/zones.csv || fail "fram pressure writes over a file of the scenario"
expect 2 "$FRAM" pressure nowhere -o none
[ ! -e none ] || fail "a refusal leaves a folder"
finish "pressure on plates and hulls by panel"

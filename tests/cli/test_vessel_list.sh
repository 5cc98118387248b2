#!/usr/bin/env bash
# A scenario with a list of vessels through the command: results, report, exports and plots by the vessels' names.
. "$FRAM_SOURCE/tests/cli/common.sh"
scene=$FRAM_SOURCE/scenes/three_vessels.yaml
run=$scratch/run
"$FRAM" run "$scene" -o "$run" --quiet --set run.duration=2 --set run.transient=0 --set output.frame_interval=0.5 \
    --set vessels.tug.y=-20.7 --set vessels.tug.speed=0.5 --set vessels.icebreaker.approach.limit=30 \
    --set vessels.icebreaker.approach.look_ahead=100 || fail "the run failed"
"$FRAM" run "$scene" -o "$scratch/start" --set run.duration=0.1 --set run.transient=0 2>"$scratch/log" ||
    fail "the short run failed"
for name in icebreaker ship tug; do
    grep -q "vessel $name displaces [0-9]" "$scratch/log" || fail "nothing tells what vessel $name displaces"
done
pictures=()
! built_with cairo || pictures=(loads-icebreaker.png loads-ship.png loads-tug.png)
for name in "${pictures[@]}" station-ship.json station-tug.json; do
    [ -s "$run/$name" ] || fail "there is no $name"
done
for name in loads.png station.json station-icebreaker.json; do
    [ ! -e "$run/$name" ] || fail "there is a $name"
done
python3 - "$run" <<'END' || failures=$((failures + 1))
import json
import sys

# The icebreaker gathers way towards the ship, past which it goes at 16 m.
note = json.load(open(sys.argv[1] + "/run.json"))
(event,) = [e for e in note["events"] if e["kind"] == "approach" and e["other"] == "ship"]
assert event["vessel"] == "icebreaker" and 15.9 < event["value"] < 30 and event["ahead_s"] <= 100, event
assert "vessel ship comes within" in event["text"] and note["events_left_out"] == 0
END
grep -q '"vessel": "ship"' "$run/station-ship.json" || fail "station-ship.json does not name its vessel"
[ "$(grep -c '"number": [0-9]*, "parted"' "$run/station-ship.json")" = 6 ] || fail "the ship has not six lines"
grep -q '"parted"' "$run/station-tug.json" && fail "the tug has lines of the ship"

python3 - "$run" <<'END' || failures=$((failures + 1))
import csv
import sys

rows = [{key.split("[")[0]: float(value) for key, value in row.items()}
        for row in csv.DictReader(open(sys.argv[1] + "/series.csv"))]
names = ["icebreaker", "ship", "tug"]
columns = {name: {c.split(".", 1)[1] for c in rows[0] if c.startswith(name + ".")} for name in names}
assert "ice_force_x" not in rows[0] and "kinetic_energy" in rows[0]
assert columns["icebreaker"] < columns["ship"] and "line_6_tension" in columns["ship"]
assert "thruster_1_thrust" in columns["tug"] and "line_1_tension" not in columns["tug"]
assert any(row["tug.hull_contact_force_y"] < 0 for row in rows), "the tug does not meet the ship"
for row in rows:
    both = row["tug.hull_contact_force_y"] + row["ship.hull_contact_force_y"]
    assert abs(both) <= 1e-9 * abs(row["tug.hull_contact_force_y"]), row
END

"$FRAM" report "$run" --quiet || fail "the report failed"
for text in "vessel ship comes within" 'time \[s\]</th><th class="w" scope="col">vessel</th>' \
    "Ice load, vessel icebreaker" "Station keeping, vessel ship" "Motion of the vessel, vessel tug"; do
    grep -q "$text" "$run/report.html" || fail "the report has no section $text"
done
grep -q "crosses: where floes broke" "$run/report.html" && fail "crosses of nothing that broke"
! built_with cairo ||
    "$FRAM" plot "$run" ship.offset_x tug.hull_contact_force_y -o "$scratch/p.svg" --quiet || fail "the plot failed"
expect 2 "$FRAM" plot "$run" ice_force_x -o "$scratch/q.svg"
for format in "--vtk" "--netcdf" "--geojson --time=1"; do
    [ "$format" != --netcdf ] || built_with netcdf || continue
    # shellcheck disable=SC2086 # words of a format
    "$FRAM" export "$run" $format --quiet || fail "the export $format failed"
done
# Hulls by name in GeoJSON, by number in cells for ParaView.
python3 - "$run" <<'END' || fail "exports do not tell the vessels apart"
import json, re, struct, sys, zlib
features = json.load(open(sys.argv[1] + "/field-1.geojson"))["features"]
names = {f["properties"]["name"]: f["geometry"]["coordinates"][0]
         for f in features if f["properties"]["kind"] == "vessel"}
assert list(names) == ["icebreaker", "ship", "tug"], list(names)
assert not any("name" in f["properties"] for f in features if f["properties"]["kind"] != "vessel")
def load(name):
    global head, body
    file = open(sys.argv[1] + f"/vtk/data/{name}.vtp", "rb").read()
    head, body = file.split(b'<AppendedData encoding="raw">\n_', 1)
def array(name, kind):
    at = int(re.findall(rb'Name="' + name + rb'"[^>]*offset="(\d+)"', head)[-1]) # of vertices first, of faces last
    _, size, _, packed = struct.unpack_from("<4Q", body, at)
    return struct.unpack(f"<{size // struct.calcsize(kind)}{kind}", zlib.decompress(body[at + 32:at + 32 + packed]))
load("hull_000002")
vessel, points = array(b"vessel", "f"), array(b"Points", "d")
corners = array(b"connectivity", "i")
assert sorted(set(vessel)) == [1, 2, 3] and len(vessel) * 3 == len(corners), set(vessel)
for number, outline in enumerate(names.values(), 1): # of t = 1 s, the frame's time
    xs = [points[3 * corners[3 * i + k]] for i in range(len(vessel)) if vessel[i] == number for k in range(3)]
    plan = [p[0] for p in outline]
    assert abs(min(xs) - min(plan)) < 0.01 and abs(max(xs) - max(plan)) < 0.01, (number, min(xs), min(plan))
# Forces by the vessel that they are on: of the ship its six lines, of the tug its thrusters, of both how they touch.
pushed = 0
for frame in range(5):
    load(f"forces_{frame:06d}")
    rows = list(zip(*(map(int, array(name, "f")) for name in (b"vessel", b"kind", b"number"))))
    forces = array(rb"force \[N\]", "f")
    assert all(1 <= vessel <= 3 for vessel, _, _ in rows), rows
    assert [row for row in rows if row[1] == 2] == [(2, 2, n) for n in range(1, 7)], rows
    assert any(vessel == 3 for vessel, kind, _ in rows if kind == 3), rows
    touching = {vessel: forces[3 * i + 1] for i, (vessel, kind, _) in enumerate(rows) if kind == 4}
    assert set(touching) in (set(), {2, 3}) and abs(sum(touching.values())) <= 1e-6 * max(touching.values(), default=0)
    pushed += len(touching)
assert pushed, "the tug does not meet the ship in any frame"
END
"$FRAM" compare "$run" "$run" -o "$scratch/c.html" --quiet || fail "the comparison failed"
grep -q "tug: ice load along X, mean" "$scratch/c.html" || fail "the comparison has no row of the tug"

# Fatigue and extremes are of the vessel that is named, and say so where none is, or there is none.
"$FRAM" fatigue "$run" --channel tug.load --quiet || fail "there is no fatigue of the load on the tug"
expect 2 "$FRAM" fatigue "$run" --channel barge.load
expect 2 "$FRAM" fatigue "$run"
says "did you mean icebreaker.load?" err
printf 'vessel: {present: false}\nice: {source: floes, floes: [{x: 0}]}\n' >"$scratch/bare.yaml"
expect 0 "$FRAM" run "$scratch/bare.yaml" -o "$scratch/bare" --quiet --set run.duration=2
for command in extremes fatigue; do
    expect 2 "$FRAM" $command "$scratch/bare"
    says "there is no vessel" err
    expect 2 "$FRAM" $command "$scratch/bare" --channel load
    says "no channel of this name" err
done

# The capability of the vessel that is asked for, the others left out.
expect 2 "$FRAM" capability "$scene" -o "$scratch/a" --formula
expect 2 "$FRAM" capability "$scene" -o "$scratch/a" --formula --vessel barge
"$FRAM" capability "$scene" -o "$scratch/ship" --formula --vessel ship --directions 4 --speed-step 0.5 --quiet ||
    fail "there is no capability of the ship"

# The longest names are read again; a name that begins as an option does is refused.
long=an-ice_breaker-of-1977-x
"$FRAM" run "$scene" -o "$scratch/long" --quiet --set run.duration=0.1 --set run.transient=0 \
    --set vessels.icebreaker.name=$long --set vessels.tug.name=${long%x}y ||
    fail "a vessel has not a name of ${#long} characters"
! built_with cairo || "$FRAM" plot "$scratch/long" $long.mechanism_accumulation_moment_x -o "$scratch/l.svg" --quiet ||
    fail "the longest column of a vessel cannot be read"
"$FRAM" compare "$scratch/long" "$run" -o "$scratch/l.html" --quiet || fail "there is no comparison of long names"
! built_with cairo || python3 - "$scratch/l.html" $long ${long%x}y <<'END' || fail "two charts have one title"
import base64, re, sys
page, heads = open(sys.argv[1]).read(), []
for name in sys.argv[2:]:
    alt = re.escape(f"Ice load along X, averaged, vessel {name}")
    image = re.search(f'alt="{alt}: [^"]*" src="data:image/svg\\+xml;base64,([^"]+)"', page)[1]
    chart = base64.b64decode(image).decode()
    shapes = dict(re.findall(r'id="(glyph[-0-9]+)">\n<path [^>]* d="([^"]*)"', chart))
    # Title and subtitle.
    heads.append([shapes[g] for g in re.findall(r'href="#(glyph[-0-9]+)" x="[^"]*" y="(?:28|48)"', chart)])
assert min(map(len, heads)) > 40 and heads[0] != heads[1], heads
END
"$FRAM" report "$scratch/long" --quiet || fail "there is no report of long names"
! built_with netcdf || "$FRAM" export "$scratch/long" --netcdf --quiet || fail "there is no export of long names"
expect 2 "$FRAM" check "$scene" --set vessels.icebreaker.name=${long}l
expect 2 "$FRAM" check "$scene" --set vessels.icebreaker.name=-tug
says "- not the first" err

# Results of vessels that are gone do not stay beside those of a new run.
"$FRAM" run "$scene" -o "$run" --force --quiet --set run.duration=0.1 --set run.transient=0 \
    --set vessels.tug.present=false || fail "the second run failed"
for name in loads-tug.png station-tug.json; do
    [ ! -e "$run/$name" ] || fail "$name of the run before was left"
done

# A vessel that the second run alone has is told too, after those of the first.
"$FRAM" compare "$run" "$scratch/start" --json >"$scratch/besides" || fail "runs of other vessels are not compared"
grep -q '"tug: ice load along X, mean","unit":"kN","a":null,"b":[-0-9]' "$scratch/besides" ||
    fail "the tug of the second run is not told"
head -1 "$run/series.csv" | grep -q "tug\." && fail "a vessel that is not present has columns"

# Vessels whose motions are given and meet: told before the run, with the time (hulls 20 m long, 2 m/s after a ramp of
# 10 s against 1 m/s; a path that crosses from below at 2.5 m/s), and not where one of them is free or they stay clear.
cat >"$scratch/meet.yaml" <<'END'
run: {duration: 60, time_step: 0.02, transient: 0}
vessels:
  - {name: tug, mode: towed, x: -40, speed: 2, ramp: 10,
     hull: {form: box, length: 20, beam: 8, draught: 3, freeboard: 2}}
  - {name: barge, mode: prescribed, x: 40, y: 3, speed: 1, course_deg: 180,
     hull: {form: box, length: 20, beam: 8, draught: 3, freeboard: 2}}
  - {name: pilot, mode: prescribed,
     path: [{time: 0, x: -40, y: -30}, {time: 20, x: 0, y: -30}, {time: 40, x: 0, y: 20}],
     hull: {form: box, length: 10, beam: 4, draught: 2, freeboard: 1}}
ice: {source: none}
domain: {x_min: -100, x_max: 100, y_min: -60, y_max: 60, boundary: open}
END
expect 0 "$FRAM" check "$scratch/meet.yaml"
python3 - err <<'END' || failures=$((failures + 1))
import re
import sys

met = re.findall(r"vessel (\w+) is driven through vessel (\w+) from t = ([\d.]+) s on", open(sys.argv[1]).read())
expected = [("barge", "tug", 70 / 3), ("pilot", "tug", 29.6), ("pilot", "barge", None)]
assert [m[:2] for m in met] == [e[:2] for e in expected], met
assert all(e[2] is None or abs(float(m[2]) - e[2]) < 0.01 for m, e in zip(met, expected)), met
END
# In a run of more than an hour they go farther between two looks than they reach.
expect 0 "$FRAM" check "$scratch/meet.yaml" --set vessels.pilot.present=false --set run.duration=4000
says "vessel barge is driven through vessel tug from t = 23.33 s on" err
for change in barge.mode=free barge.y=9; do
    expect 0 "$FRAM" check "$scratch/meet.yaml" --set vessels.pilot.present=false --set "vessels.$change"
    grep -q 'is driven through' err && fail "vessels are said to meet with $change"
done

# Between the two hulls of a catamaran there is water: a tug and a floe find room there, and the picture shows it.
python3 - <<'END'
corners = [(x, y, z) for side in (-10, 10) for z in (-3, 2) for y in (side - 2, side + 2) for x in (-20, 20)]
faces = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]
with open("catamaran.obj", "w") as file:
    file.writelines("v %g %g %g\n" % c for c in corners)
    file.writelines("f %d %d %d %d\n" % tuple(i + first for i in f) for first in (0, 8) for f in faces)
END
cat >catamaran.yaml <<'END'
run: {duration: 0.02, time_step: 0.02}
vessels:
  - {name: cat, mode: towed, hull: {form: file, file: catamaran.obj}}
  - {name: tug, mode: towed, x: -10, hull: {form: box, length: 12, beam: 5, draught: 2, freeboard: 1}}
ice: {source: floes, thickness: 0.5, floes: [{x: 10, length: 5, width: 5}]}
domain: {x_min: -50, x_max: 50, y_min: -50, y_max: 50, boundary: open}
END
expect 0 "$FRAM" run catamaran.yaml -o catamaran
grep '^warning.*lie inside' err && fail "a floe in open water is told to be in a hull"
python3 - <<'END' || fail "the picture does not show the water between the hulls"
import os
import pathlib
import sys

sys.path.insert(0, os.environ["FRAM_SOURCE"] + "/tests/views")
import chromium

_, _, channels, rows = chromium.pixels(pathlib.Path("catamaran/plan.png").read_bytes())
at = lambda x, y: tuple(rows[y][channels * x:channels * x + 3])
middle, water = (514, 564), at(30, 80)  # ten pixels a metre
assert at(*middle) == water, at(*middle)
assert all(at(514, 564 + side) != water for side in (-100, 100)), (at(514, 464), at(514, 664))
END
expect 2 "$FRAM" check catamaran.yaml --set vessels.tug.y=8
says "vessels[1].x: the hull lies in that of vessel cat at the start, by 30 m2 as seen from above" err
expect 0 "$FRAM" check catamaran.yaml --set "ice.floes[0].y=10"
says "ice.floes[0]: 20 m2 of the floe at (10, 10) m lie inside the hull of vessel cat" err
grep 'no level open top' err && fail "a freeboard that nobody gave is told of"
expect 0 "$FRAM" check catamaran.yaml --set vessels.cat.hull.freeboard=3
says "warning: hull.freeboard: the hull's file has no level open top: without effect" err

# A semi-submersible, two pontoons 4 m under water with two columns each: between the columns there is water, and what
# stands one above the other counts once.
python3 - <<'END'
profile = [(-20, -10), (20, -10), (20, 2), (10, 2), (10, -4), (-10, -4), (-10, 2), (-20, 2)]
with open("catamaran.obj", "w") as file:
    file.writelines("v %g %g %g\n" % (x, y, z) for y in (-12, -4, 4, 12) for x, z in profile)
    for first in (1, 17):
        starboard, port = [range(first + k, first + k + 8) for k in (0, 8)]
        faces = [starboard, port[::-1]] + [(port[i - 1], port[i], starboard[i], starboard[i - 1]) for i in range(8)]
        file.writelines("f %s\n" % " ".join(map(str, f)) for f in faces)
END
sed -i -e 's/\[{x: 10,.*/[{x: -6}, {y: 8, length: 8}, {x: 15, y: 8, length: 4, width: 4}]}/' \
    -e 's/x: -10, hull/x: 5, hull/' catamaran.yaml
expect 0 "$FRAM" run catamaran.yaml -o semi
same "$(grep -c '^warning.*lie inside' err)" 1 "floes that are told to be in a hull: $(cat err)"
says "ice.floes[2]: 16 m2 of the floe at (15, 8) m lie inside the hull of vessel cat" err
# Far from every vessel pictures show the first one whole: water is in their middle, a pontoon on either side of it.
expect 0 "$FRAM" run catamaran.yaml -o away --set vessels.cat.x=900 --set vessels.tug.x=-900 --set domain.y_min=-20 \
    --set domain.y_max=20
expect 0 "$FRAM" report away -q
python3 "$FRAM_SOURCE/tests/cli/pixels.py" twin away/plan.png away/report.html ||
    fail "a picture does not show the first vessel that is beside the domain"
python3 - <<'END' || fail "the picture does not show the water between the columns"
import os
import pathlib
import sys

sys.path.insert(0, os.environ["FRAM_SOURCE"] + "/tests/views")
import chromium

_, _, channels, rows = chromium.pixels(pathlib.Path("semi/plan.png").read_bytes())
at = lambda x, y: tuple(rows[564 - 10 * y][channels * (514 + 10 * x):][:3])
water, pontoon, column = at(0, 14), at(8, 6), at(18, 6)
assert at(-14, 0) == water and len({water, pontoon, column}) == 3, (at(-14, 0), water, pontoon, column)
END

finish "vessels of a list go by name"

#!/usr/bin/env bash
# fram capability in ice that came to a vessel in runs: known floes that drift onto a ship.
. "$FRAM_SOURCE/tests/cli/common.sh"

# Rows of squares of 3 and 8 m come from ahead at 0.5 m/s; nothing breaks, nothing is in the water.
python3 - >scene.yaml <<'END'
print("""title: Known ice
run: {duration: 8, time_step: 0.02, transient: 2}
vessels:
  - name: ship
    mode: towed
    hull: {form: box, length: 40, beam: 10, draught: 4, freeboard: 2}
  - name: tender
    mode: towed
    x: 48
    y: 14
    hull: {form: box, length: 20, beam: 4, draught: 2, freeboard: 2}
    propulsion: {bollard_pull: auto}
ice:
  source: floes
  thickness: 0.8
  floes:""")
for i in range(8):
    print(f"    - {{length: 3, width: 3, x: {26 + 12 * i}, velocity_x: -0.5}}")
    print(f"    - {{length: 8, width: 8, x: {32 + 12 * i}, velocity_x: -0.5}}")
print("""domain: {x_min: -100, x_max: 300, y_min: -100, y_max: 100, boundary: open}
environment: {water: false}
output: {frame_interval: 1}""")
END
cat >held.yaml <<'END'
run: {time_step: 0.05}
vessel:
  name: ship
  mode: free
  hull: {form: box, length: 40, beam: 10, draught: 4, freeboard: 2}
  thrusters: [{x: 15, thrust: 4.0e4}, {x: -15, thrust: 4.0e4}]
ice: {source: level}
domain: {x_min: -100, x_max: 100, y_min: -100, y_max: 100, boundary: open}
END
"$FRAM" run scene.yaml -o run -q
"$FRAM" manage run --vessel ship -q >/dev/null
ask=(--measure 0.1 --directions 4 --speed-step 0.2 --speed-most 0.2)

expect 0 "$FRAM" capability held.yaml -o a --ice-from run --ice-vessel ship "${ask[@]}"
python3 - <<'END' || fail "the ice of the run, in capability.json or its table"
import csv, json, math
j = json.load(open("a/capability.json"))
ice = j["ice_from"]
# What manage found of each window: behind the tender where it came near, else upstream, else at the ship.
places = "behind", "upstream", "at_vessel"
first = lambda row: next(float(row[p + "_concentration[1]"]) for p in places if row[p + "_time[s]"] != "nan")
rows = [r for r in csv.DictReader(open("run/manage.csv")) if float(r["time[s]"]) > 2]
assert ice["windows"] == len(rows) == 6 and ice["runs"] == ["run"], ice
assert abs(ice["concentration"] - sum(map(first, rows)) / len(rows)) < 1e-9, ice
assert abs(ice["thickness_m"] - 0.8) < 1e-6 and ice["window_m"] == 120 and ice["unbroken"] == 0, ice
assert abs(ice["largest_m"] - math.sqrt(256 / math.pi)) < 1e-9
# Two sizes, and as much of each as the mean size says.
bins = [r for r in csv.DictReader(open("a/capability_floes.csv")) if float(r["floes[1]"]) > 0]
assert len(bins) == 2, bins
area = []
for r, side in zip(bins, (3, 8)):
    lo, hi = float(r["diameter_min[m]"]), float(r["diameter_max[m]"])
    assert lo < side * math.sqrt(4 / math.pi) <= hi, (r, side)
    area.append(float(r["floes[1]"]) * math.pi / 12 * (lo * lo + lo * hi + hi * hi))
mean = sum(a * s for a, s in zip(area, (3, 8))) / sum(area) * math.sqrt(4 / math.pi)
assert abs(mean / ice["mean_size_m"] - 1) < 1e-9, (mean, ice)
# The field that loads were measured in is that ice.
assert j["ice_load"] == "measured" and abs(j["ice_concentration"] / ice["concentration"] - 1) < 0.02, j
assert abs(j["ice_thickness_m"] - 0.8) < 1e-6
END
# Runs count together; a window of another size.
expect 0 "$FRAM" capability held.yaml -o b --ice-from run --ice-from run --ice-vessel ship --window 160 "${ask[@]}"
python3 -c 'import json; a, b = (json.load(open(f"{k}/capability.json"))["ice_from"] for k in "ab")
assert b["windows"] == 2 * a["windows"] and abs(b["concentration"] - a["concentration"]) < 1e-12, b
assert b["window_m"] == 160 and b["runs"] == ["run", "run"], b' || fail "two runs"
# The histogram is one that ice.populations takes.
sizes="[{size: histogram, histogram: a/capability_floes.csv}]"
sed "s|^ice: .*|ice: {concentration: 0.3, populations: $sizes}|" held.yaml >made.yaml
expect 0 "$FRAM" check made.yaml
expect 2 "$FRAM" capability made.yaml -o a --force --ice-from run --ice-vessel ship "${ask[@]}"
same "$(cat err)" "fram: a/capability_floes.csv: --output: expected a file of its own, found one that is read" "refusal"

# In a model of 1:40 the floes are of as many sizes.
python3 - <<'END'
import re
k, keys = 1 / 40, "length|beam|draught|freeboard|width|thickness|x|y|x_min|x_max|y_min|y_max"
def model(path, of, more):
    text = re.sub(rf"\b({keys}): (-?[\d.]+)", lambda m: f"{m[1]}: {float(m[2]) * k:.9g}", open(of).read())
    text = re.sub(r"\b(duration|time_step|transient|velocity_x): (-?[\d.]+)",
                  lambda m: f"{m[1]}: {float(m[2]) * k**0.5:.9g}", text)
    open(path, "w").write(text.replace("run: {", "run: {scale: 0.75, ").replace("frame_interval: 1", more))
model("model.yaml", "scene.yaml", "frame_interval: 0.15811388")
model("tank.yaml", "held.yaml", "")
END
sed -i 's/, thrust: [^}]*/, thrust: 0.6/g; s/source: level/&, mean_floe_area: 0.04/' tank.yaml
"$FRAM" run model.yaml -o model -q
expect 0 "$FRAM" capability tank.yaml -o m --ice-from model --ice-vessel ship --measure 0.02 --directions 4 \
    --speed-step 0.05 --speed-most 0.05 --window 2
python3 - <<'END' || fail "floes of a model"
import csv, json, math
ice = json.load(open("m/capability.json"))["ice_from"]
bins = [r for r in csv.DictReader(open("m/capability_floes.csv")) if float(r["floes[1]"]) > 0]
assert len(bins) == 2, bins
for r, side in zip(bins, (0.075, 0.2)):
    assert float(r["diameter_min[m]"]) < side * math.sqrt(4 / math.pi) <= float(r["diameter_max[m]"]), (r, side)
assert abs(ice["largest_m"] - math.sqrt(0.16 / math.pi)) < 1e-7, ice
END

# So are the classes of fram manage, and ice comes that in full size would come at 0.03 m/s.
sed 's/velocity_x: -[0-9.]*/velocity_x: -0.005/g' model.yaml >slow.yaml
"$FRAM" run slow.yaml -o slow -q
expect 0 "$FRAM" manage slow --vessel ship --json -q
python3 - <<'END' || fail "sizes and drift of a model in fram manage"
import csv, json
assert json.load(open("out"))["run"]["at_vessel"]["windows"] > 0
rows = [{k: float(v) for k, v in r.items()} for r in csv.DictReader(open("slow/manage-sizes.csv"))]
met = [(r["size_over[m]"], r["size_up_to[m]"]) for r in rows if r["at_vessel[1]"] > 0]
assert met == [(0.05, 0.125), (0.125, 0.25)], met
END

# Unbroken ice is not passed over.
grep -v thrusters held.yaml >fast.yaml
"$FRAM" run fast.yaml -o level -q --set vessel.mode=prescribed --set ice.breakable=true \
    --set domain.boundary=feeding --set domain.drift_speed=0.5 --set domain.drift_direction_deg=180 \
    --set run.duration=0.5 --set output.frame_interval=0.25 --set ice.level.x_min=24
expect 2 "$FRAM" capability held.yaml -o c --ice-from level "${ask[@]}"
says "level: --unbroken-as: 100 % of the ice that came to the vessel was unbroken" err
expect 0 "$FRAM" capability held.yaml -o c --ice-from level --unbroken-as 15 "${ask[@]}"
python3 -c 'import json; j = json.load(open("c/capability.json"))["ice_from"]
assert j["unbroken"] == 1 and j["unbroken_as_m"] == 15 and abs(j["mean_size_m"] - 15) < 1e-9, j' ||
    fail "floes for unbroken ice"
# A window that was full of it is made as dense as drawn floes can be, which is told.
"$FRAM" run fast.yaml -o full -q --set vessel.mode=prescribed --set ice.breakable=true --set ice.keep_out_margin=0 \
    --set domain.boundary=feeding --set domain.drift_speed=0.5 --set domain.drift_direction_deg=180 \
    --set run.duration=0.5 --set run.transient=0.25 --set output.frame_interval=0.25 --set ice.level.x_min=20
expect 0 "$FRAM" capability held.yaml -o f --ice-from full --unbroken-as 15 "${ask[@]}"
says "the ice that came covers 1 of the water" err
python3 -c 'import json; j = json.load(open("f/capability.json"))
assert abs(j["ice_from"]["concentration"] - 1) < 1e-9 and 0.995 < j["ice_concentration"] < 0.999, j' ||
    fail "a field for ice without water"

# What cannot be.
expect 2 "$FRAM" capability held.yaml -o d --ice-from nowhere "${ask[@]}"
says "nowhere/run.json" err
expect 2 "$FRAM" capability held.yaml -o d --ice-from run --ice-vessel nobody "${ask[@]}"
says '"nobody"' err
expect 2 "$FRAM" capability held.yaml -o d --unbroken-as 10 "${ask[@]}"
says "ice-from: expected runs" err
expect 2 "$FRAM" capability held.yaml -o d --ice-from run --ice-vessel ship --formula "${ask[@]}"
says "formula: expected" err
expect 2 "$FRAM" capability held.yaml -o d --ice-from run --ice-vessel ship --window 10 "${ask[@]}"
says "window: ice from" err
says "take a larger window" err
expect 2 "$FRAM" capability held.yaml -o d --ice-from run --ice-vessel ship --set ice.thickness=2 "${ask[@]}"
says "set: ice.thickness: expected no override" err
sed 's/source: level/source: voronoi, open_water: [{x: 9, length: 8, width: 8}]/' held.yaml >zones.yaml
for key in domain.band=20 domain.tile_x=300 ice.roundness=0.5 "ice.open_water[0].length=9"; do
    expect 2 "$FRAM" capability zones.yaml -o d --ice-from run --ice-vessel ship --set "$key" "${ask[@]}"
    says "set: ${key%%[=[]*}: expected no override" err
done
expect 2 "$FRAM" capability held.yaml -o d --ice-from level --unbroken-as -3 "${ask[@]}"
[ ! -e d ] || fail "a refused plot left a folder"
finish "fram capability: in the ice of runs"

#!/usr/bin/env bash
# fram capability as a user meets it: files, JSON, errors.
. "$FRAM_SOURCE/tests/cli/common.sh"

scene=$FRAM_SOURCE/scenes/supply_ship.yaml
expect 0 "$FRAM" capability "$scene" -o "$scratch/a" --formula --directions 12 --speed-step 0.2 --json
says '"file"' out
# Currents come across a hull whose drag is that of one that goes ahead: its side has none but what is given.
sides='environment.hull_drag.water_form: 0.1 is of a hull that goes ahead'
grep -F "${sides%% *}" err && fail "told of a hull whose side is damped"
estimate='--formula --directions 4 --set vessel.hydrodynamics.source=estimate'
long='A title that goes on and on, over the whole of the picture and over its legend, until there is no more room'
# shellcheck disable=SC2086
expect 0 "$FRAM" capability "$scene" -o "$scratch/ahead" $estimate --set "title=$long, $long"
says "$sides" err
! built_with cairo || python3 "$FRAM_SOURCE/tests/cli/pixels.py" head "$scratch/ahead/capability.png" ||
    fail "a title runs out of capability.png"
# shellcheck disable=SC2086
expect 0 "$FRAM" capability "$scene" -o "$scratch/sides" $estimate --set environment.hull_drag.water_form=1
grep -F "${sides%% *}" err && fail "told of the drag of a ship's side"
python3 - "$scratch/a" <<'END' || fail "capability.json or its tables"
import csv, json, sys
a = sys.argv[1]
j = json.load(open(a + "/capability.json"))
rows = list(csv.DictReader(open(a + "/capability.csv")))
use = list(csv.DictReader(open(a + "/capability_use.csv")))
assert j["ice_load"] == "formula" and len(j["directions"]) == len(rows) == 12 and len(use) == 60, "counts"
for d, r in zip(j["directions"], rows):
    assert d["from_bow_clockwise_deg"] == float(r["from_bow_clockwise[deg]"]), "direction"
    for limit, speed, by in (("intact", "speed_intact[m/s]", "limited_by"),
                             ("after_worst_failure", "speed_after_failure[m/s]", "then_limited_by")):
        assert d[limit]["speed"] == float(r[speed]) and d[limit]["limited_by"] == r[by], (limit, r)
    # Where the vessel is held after each failure none of them is the worst.
    assert d["after_worst_failure"]["failure"] == r["failure"], r
    assert r["failure"].startswith("none" if d["after_worst_failure"]["held_at_all_speeds"] else "thruster "), r
    assert d["after_worst_failure"]["speed"] <= d["intact"]["speed"] + 1e-9, "a failure makes nothing better"
    assert d["use"] == [float(u["use[1]"]) for u in use if u["from_bow_clockwise[deg]"] == r["from_bow_clockwise[deg]"]]
    assert len(d["use"]) == 5, "use"
head = {"measuring_time_s": None, "wind_speed_m_s": 0, "ice_thickness_m": 0.7, "ice_concentration": 0.7,
        "allowance": 1.25, "line_safety_intact": 2, "line_safety_after_failure": 1.43, "speed_step_m_s": 0.2,
        "speed_most_m_s": 1}
assert {name: j[name] for name in head} == head, j
assert 0 < sum(r["failure"] == "none" for r in rows) < 12, "directions in which all failures are held"
assert float(rows[0]["speed_intact[m/s]"]) > float(rows[3]["speed_intact[m/s]"]), "the bow holds more than the side"
END
case $("$FRAM" --version) in
*cairo*) for name in capability.png capability.svg; do
    [ -s "$scratch/a/$name" ] || fail "$name is missing"
done ;;
esac
expect 2 "$FRAM" capability "$scene" -o "$scratch/a" --formula
says '--force' err
expect 2 "$FRAM" capability "$scene" -o "$scratch/b" --formula --speed-step 0.3
says '--speed-step: expected a positive step that divides the largest speed' err
expect 2 "$FRAM" capability "$scene" -o "$scratch/b" --set "environment.wind_file=$FRAM_SOURCE/scenes/drift_turning.csv"
says 'environment.wind_file' err
# The drift's current, at all depths, stands in place of what the scenario's has at some of them, which is told.
printf 'depth,x,y\n0,0,1\n20,0,1\n' >profile.csv
expect 0 "$FRAM" capability "$scene" -o left --formula --directions 4 \
    --set "environment.current_profile_file=$PWD/profile.csv"
says "environment.current_profile_file is left out: the current of a capability plot goes with the drift" err
expect 2 "$FRAM" capability "$scene" -o "$scratch/b" --formula --set ice.source=level --set domain.boundary=open
says 'broken ice' err
cat >mixed.yaml <<'END'
vessel:
  mode: free
  hull: {form: box, length: 40, beam: 12, draught: 4, freeboard: 2}
  thrusters: [{x: 15, thrust: 4.0e4}, {x: -15, thrust: 4.0e4}]
domain: {x_min: -100, x_max: 100, y_min: -100, y_max: 100, boundary: feeding}
ice:
  source: packed
  concentration: 0.6
  populations: [{size: constant, diameter: 20, thickness: 0.4}, {size: constant, diameter: 25, thickness: 0.8}]
END
expect 2 "$FRAM" capability mixed.yaml -o "$scratch/b" --formula
says 'ice.populations: expected none' err
expect 0 "$FRAM" capability mixed.yaml -o mixed --measure 3 --directions 4 --speed-step 0.2 --speed-most 0.2
python3 -c 'import json; j = json.load(open("mixed/capability.json"))
assert 0.5 < j["ice_thickness_m"] < 0.7 and abs(j["ice_concentration"] - 0.6) < 0.01, j
assert j["measuring_time_s"] == 3, j' || fail "what ice was met"
# A sheet that comes to a wide side loads it more and more, and a plot of its first metres is none of its load.
cat >growing.yaml <<'END'
vessel:
  mode: free
  hull: {form: box, length: 40, beam: 12, draught: 4, freeboard: 2}
  thrusters: [{x: 15, thrust: 4.0e4}, {x: -15, thrust: 4.0e4}]
domain: {x_min: -120, x_max: 120, y_min: -120, y_max: 120, boundary: feeding}
ice: {source: voronoi, concentration: 0.5, mean_floe_area: 60, thickness: 0.4}
END
expect 0 "$FRAM" capability growing.yaml -o growing --measure 40 --directions 4 --speed-step 0.2 --speed-most 0.2
says 'measured ice loads were still building up, and limits are too high: at 0.2 m/s, at which 8 m of ice' err
says 'measure twice as long (80 s)' err
python3 -c 'import json; j = json.load(open("growing/capability.json"))
assert j["ice_load_still_building"] is True and j["ice_load_growth"] > 1.25 and j["ice_load_growth_speed_m_s"] == 0.2, j
j = json.load(open("'"$scratch"'/a/capability.json"))
assert j["ice_load_growth"] is None and j["ice_load_still_building"] is None, j' || fail "how much loads grew"
# The formula measures nothing, however long.
expect 2 "$FRAM" capability mixed.yaml -o "$scratch/b" --formula --measure 3
says '--measure: expected none with the formula' err
# Level ice is measured from when it comes to the hull, across the opening that the ship lies in; or there is no load.
level=$FRAM_SOURCE/scenes/turret_turning.yaml
expect 0 "$FRAM" capability "$level" -o level --measure 6 --directions 4 --speed-step 0.3 --speed-most 0.3
same "$(grep -c '^ice from' err)" 3 "directions that are measured"
grep 'surge -\{0,1\}0 kN, sway -\{0,1\}0 kN' err && fail "a load of no ice"
expect 2 "$FRAM" capability "$level" -o none --measure 0.5 --directions 4 --speed-step 0.3 --speed-most 0.3
says "ice from 0 deg at 0.3 m/s: no ice came to the hull in 10" err
says "ice.level.openings" err
[ ! -e none/capability.json ] || fail "loads of no ice were written"
touch file
expect 2 "$FRAM" capability "$scene" -o "$scratch/file/b" --formula
says 'file' err
expect 2 "$FRAM" capability "$scene"
says '--output' err
expect 2 "$FRAM" capability "$scene" -o "$scratch/b" --set domain.boundary=open
says 'domain.boundary' err
# Ctrl-C while loads are measured, once: without --foreground the group gets it too, and a second one ends at once.
code=0
timeout --foreground --preserve-status -s INT 2 \
    "$FRAM" capability "$scene" -o "$scratch/b" --measure 1e5 2>err || code=$?
same "$code" 130 "exit code after Ctrl-C"
says 'nothing was written' err
[ ! -e "$scratch/b" ] || fail "a refused plot left a folder"
expect 2 "$FRAM" capability "$FRAM_SOURCE/scenes/demo.yaml" -o "$scratch/b"
says 'mode free' err

# What the help tells as defaults, given by hand, changes nothing.
expect 0 "$FRAM" capability --help
told=$(told_defaults "simulated|directions|drift speed|allowance|safety|failure" '\(')
same "$(wc -l <<<"$told")" 7 "defaults that the help tells: $told"
expect 0 "$FRAM" capability "$scene" -o bare --formula
# shellcheck disable=SC2086
expect 0 "$FRAM" capability "$scene" -o told --formula $told
for name in capability.json capability_use.csv; do
    cmp bare/$name told/$name || fail "$name with the defaults of the help is another one"
done
rm -r bare

# A section of the scenario is no option of that name.
echo "ice: {source: none}" >bare.yaml
expect 2 "$FRAM" capability bare.yaml -o bare --formula
says "bare.yaml: vessel: expected a vessel of mode free" err
expect 2 "$FRAM" capability bare.yaml -o bare --formula --vessel nobody
says "fram: --vessel: expected" err
echo "vessel: {name: tug, mode: free}" >named.yaml
expect 2 "$FRAM" capability named.yaml -o bare --formula --vessel nobody
says '--vessel: expected the name of a vessel, "tug"; found "nobody"' err

# Of one of a list its place there is told, which counts vessels that are not present.
cat >fleet.yaml <<'END'
ice: {source: none}
domain: {boundary: open}
vessels:
  - {name: gone, present: false}
  - name: kept
    mode: free
    hull: {form: box, length: 60, beam: 12, draught: 4}
    thrusters: [{x: 20, thrust: 4.0e4}, {x: -20, thrust: 4.0e4}]
    current_coefficients: {table: [{angle_deg: 0, cx: -0.1}, {angle_deg: 180, cx: 0.1}]}
END
expect 0 "$FRAM" capability fleet.yaml -o fleet --measure 9 --directions 4 --vessel kept --allowance 1.1 \
    --line-safety 3 --line-safety-damaged 2.5
says 'warning: vessels[1].current_coefficients: at 0 degrees' err
same "$(python3 -S -c 'import json; j = json.load(open("fleet/capability.json"))
print(j["allowance"], j["line_safety_intact"], j["line_safety_after_failure"], j["measuring_time_s"])')" \
    "1.1 3 2.5 None" "factors that are given, and what was measured of no ice"

finish "fram capability: as it should be"

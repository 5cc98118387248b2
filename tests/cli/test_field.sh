#!/usr/bin/env bash
# fram field as a user meets it: what a field is, mending, cutting, drawing, out and back, errors with their place.
. "$FRAM_SOURCE/tests/cli/common.sh"

# Two squares, one of them with a thickness, and a bow tie of two triangles of 25 m2.
cat >floes.geojson <<'JSON'
{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"thickness":0.7},"geometry":{"type":"Polygon",
"coordinates":[[[0,0],[10,0],[10,10],[0,10],[0,0]]]}},
{"type":"Feature","properties":{},"geometry":{"type":"Polygon",
"coordinates":[[[20,0],[30,10],[30,0],[20,10],[20,0]]]}},
{"type":"Feature","properties":{},"geometry":{"type":"Polygon",
"coordinates":[[[40.1,0],[40.1,10],[50.1,10],[50.1,0],[40.1,0]]]}}
]}
JSON

# A property that is not read is told.
sed 's/"thickness"/"Thickness"/' floes.geojson >case.geojson
expect 0 "$FRAM" field case.geojson --bad drop
says "feature 1: the property Thickness is not read: its name is thickness, in metres" err
# The bow tie is refused with its place, dropped, mended.
expect 2 "$FRAM" field floes.geojson --json
same "$(value 'j["error"]["file"], j["error"]["line"], j["error"]["column"], j["error"]["key"]')" \
    "floes.geojson 5 16 feature 2, polygon 1, ring 1" "place of the bow tie"
says "floes.geojson:5:16: feature 2, polygon 1, ring 1: the ring crosses or touches itself" err
expect 0 "$FRAM" field floes.geojson --bad drop --json
same "$(wc -l <out)" 1 "lines of JSON"
same "$(value 'j["rings"], j["floes"], j["area_m2"], len(j["dropped"]), len(j["repaired"])')" "3 2 200 1 0" dropped
same "$(value 'j["dropped"][0]["feature"], j["dropped"][0]["line"]')" "2 5" "what was dropped"
expect 0 "$FRAM" field floes.geojson --bad repair --json
same "$(value 'j["floes"], j["area_m2"], len(j["repaired"]), sum(j["histogram"]["floes"])')" "4 250 1 4" repaired
expect 0 "$FRAM" field floes.geojson --bad drop --x 400000 --y 8600000
says "2 floes of 3 rings" out
# In metres of a map: seven digits before the point, and those that tell the field's extent.
says "x from 400000 to 400050.1 m, y from 8600000 to 8600010 m" out
says "floes of 100 to 100 m2" out
expect 0 "$FRAM" field floes.geojson --bad drop --scale 3.59198
says "floes of 1290.23 to 1290.23 m2" out
says "left out: feature 2" out

# Scaled, moved, cut at a window.
expect 0 "$FRAM" field floes.geojson --bad drop --scale 0.5 --x 100 --y -7 --json
same "$(value 'j["area_m2"], j["bounds_m"]')" "50 [100, -7, 125.05, -2]" "scaled and moved"
expect 0 "$FRAM" field floes.geojson --bad drop --centre --json
same "$(value 'max(abs(a - b) for a, b in zip(j["bounds_m"], (-25.05, -5, 25.05, 5))) < 1e-12')" True "in the centre"
expect 0 "$FRAM" field floes.geojson --bad drop --crop 5,0,25,10 --json
same "$(value 'j["floes"], j["area_m2"], j["concentration"]')" "1 50 0.25" "cut at a window"
same "$(value '"is outside the window" in [d["reason"] for d in j["dropped"]]')" True "what lies outside of it"
expect 0 "$FRAM" field floes.geojson --bad repair --smallest 30 --json
same "$(value 'j["floes"], len(j["dropped"])')" "2 2" "without small floes"

# Out and back to the bit, thickness included; through a link or a device, which stay what they are.
expect 0 "$FRAM" field floes.geojson --bad repair --scale 0.3333333333333333 -o once.geojson --json
expect 0 "$FRAM" field once.geojson -o twice.geojson --json
cmp -s once.geojson twice.geojson || fail "a written field reads back as another one"
grep -qF '"thickness":0.7' once.geojson || fail "the thickness is lost"
ln -s /dev/full full
if [ -w /dev/full ]; then
    expect 1 "$FRAM" field once.geojson -o full --json
    same "$(value 'j["error"]["file"], j["error"]["status"]')" "full io" "a full disk"
    [ -L full ] || fail "the link to a device was replaced"
fi
if "$FRAM" --version | grep -q cairo; then
    expect 0 "$FRAM" field once.geojson --draw field.png
    head -c 8 field.png | od -An -tx1 | grep -q "89 50 4e 47" || fail "field.png is no PNG"
    expect 2 "$FRAM" field once.geojson --draw no/such/folder/field.png
fi

# The field of a scenario: what was asked for is what is reported, and what the floes add up to.
cat >packed.yaml <<'YAML'
run: {duration: 1, seed: 3}
vessel: {present: false}
domain: {x_min: -100, x_max: 100, y_min: -100, y_max: 100}
ice:
  source: packed
  concentration: 0.8
  open_water: [{x: 50, y: 50, length: 40, width: 40}]
  populations:
    - {share: 3, size: power, diameter_min: 8, diameter_max: 40}
    - {share: 1, size: constant, diameter: 4, thickness: 0.4, thickness_deviation: 0.1}
YAML
expect 0 "$FRAM" field packed.yaml --window -100,-100,0,100 --window 35,35,65,65 --json --table floes.csv \
    -o packed.geojson
same "$(value 'abs(j["made"]["concentration"] - 0.8) < 0.004, j["made"]["asked_concentration"]')" "True 0.8" reached
same "$(value 'abs(j["made"]["free_area_m2"] - 38400) < 1e-6, j["made"]["largest_overlap_m"]')" "True 0" "free area"
same "$(value '[p["kolmogorov_smirnov"] < 0.02 for p in j["made"]["populations"]]')" "[True, True]" "laws of size"
same "$(value 'all(sum(p["counted"]) == p["floes"] and abs(sum(p["expected"]) - p["floes"]) < 1e-6
               for p in j["made"]["populations"])')" True "histograms"
same "$(value 'sum(p["floes"] for p in j["made"]["populations"]) == j["floes"], j["made"]["vertex_changes"]')" \
    "True 0" "floes"
same "$(value 'j["windows"][1]["concentration"], 0.7 < j["windows"][0]["concentration"] < 0.9')" "0 True" windows
cp out report
python3 - <<'PY' || fail "the table contradicts the report"
import csv, json
j = json.loads(open("report").read())
rows = list(csv.DictReader(open("floes.csv")))
assert len(rows) == j["floes"]
assert abs(sum(float(r["area[m2]"]) for r in rows) / j["area_m2"] - 1) < 1e-12
assert all(abs(float(r["area[m2]"]) / float(r["drawn_area[m2]"]) - 1) < 1e-12 for r in rows)
assert all(r["vertices[1]"] == r["drawn_vertices[1]"] for r in rows)
assert {r["population"] for r in rows} == {"0", "1"}
small = [float(r["thickness[m]"]) for r in rows if r["population"] == "1"]
assert len(set(small)) == len(small) and abs(sum(small) / len(small) - 0.4) < 0.03
PY
# Out and in again to the bit, also into a scenario; the same on any number of threads; another one of another seed.
expect 0 "$FRAM" field packed.geojson -o again.geojson --json
cmp -s packed.geojson again.geojson || fail "a generated field reads back as another one"
printf '%s\n' 'run: {duration: 1}' 'vessel: {present: false}' \
    'domain: {x_min: -100, x_max: 100, y_min: -100, y_max: 100}' 'ice: {source: file, file: packed.geojson}' >file.yaml
expect 0 "$FRAM" field file.yaml -o again.geojson --json
cmp -s packed.geojson again.geojson || fail "a scenario reads a generated field as another one"
! grep -qF "not the strengths" err || fail "a field of one strength is said to lose it"
same "$(value 'j["made"]["populations"], j["made"]["placed"] == j["floes"]')" "[] True" "a field of a file"
same "$(value 'j["made"]["asked_concentration"]')" None "a concentration is asked of a field of a file"
# A thickness in centimetres of a feature is told as one of the scenario is.
sed 's/"thickness":[0-9.]*/"thickness":7.2/g' packed.geojson | sed '0,/"thickness":[0-9.]*/s//"thickness":60/' \
    >thick.geojson
expect 0 "$FRAM" field file.yaml --set ice.file=thick.geojson --set run.scale=36
says 'thick.geojson: the property thickness of 1 floe, the first 60 m, is outside of 0.02 to 7.2, what floes' err
expect 0 "$FRAM" field packed.yaml --threads 4 -o again.geojson
cmp -s packed.geojson again.geojson || fail "the field depends on the number of threads"
says "moved rigidly" out
says "the law" out
# Sentences count populations from 1, in the log too.
for name in out err; do
    same "$(grep -o "^ *population [0-9]*" $name | xargs)" "population 1 population 2" "populations in $name"
done
expect 0 "$FRAM" field packed.yaml --set run.seed=4 -o again.geojson
cmp -s packed.geojson again.geojson && fail "the field does not depend on the seed"
printf '%s\n' 'run: {duration: 1}' 'vessel: {present: false}' \
    'domain: {x_min: -200, x_max: 200, y_min: -200, y_max: 200}' 'ice:' '  source: voronoi' '  concentration: 0.98' \
    '  populations: [{size: power, diameter_min: 5, diameter_max: 30, thickness_deviation: 0.2}]' >managed.yaml
expect 0 "$FRAM" field managed.yaml --json
same "$(value 'abs(j["made"]["concentration"] - 0.98) < 1e-6, j["made"]["largest_overlap_m"]')" "True 0" "managed ice"
same "$(value 'j["made"]["populations"][0]["kolmogorov_smirnov"] < 0.03, j["floes"] > 800')" "True True" cells
# A law of size that the least area cuts is told where it stands in a file, too.
printf 'diameter_min[m],diameter_max[m],floes\n2,3,9\n3,9,9\n' >cut.csv
small=(--set domain.x_min=160 --set domain.y_min=160 --set ice.concentration=0.4)
cut=("${small[@]}")
cut+=(--set "ice.populations[0].size=histogram" --set "ice.populations[0].histogram=cut.csv")
expect 0 "$FRAM" field managed.yaml "${cut[@]}" --set ice.smallest_floe_area=8
says "ice.smallest_floe_area: 8 m2, 3.19 m across, leaves out 0.52 of the floes" err
# What populations have of their own beside thickness is not in a written file.
for own in flexural_strength=3e5 crushing_deviation=2e5 breakable=false; do
    expect 0 "$FRAM" field managed.yaml "${small[@]}" --set ice.breakable=true --set "ice.populations[0].$own" \
        -o own.geojson
    says "own.geojson: the file keeps outlines and thickness, not the strengths of ice.populations nor which" err
done
expect 0 "$FRAM" field managed.yaml "${small[@]}" --set ice.breakable=false --set "ice.populations[0].breakable=false" \
    -o own.geojson
! grep -qF "not the strengths" err || fail "floes that do not break anyway are said to lose that"
# The written tile of an endless field starts it again to the bit; windows count what lies across the tile's edge.
for ice in 'source: voronoi, mean_floe_area: 60' \
    'source: packed, populations: [{size: uniform, diameter_min: 8, diameter_max: 14}]'; do
    printf '%s\n' 'run: {duration: 0.1}' 'vessel: {present: false}' 'domain: {x_min: -40, x_max: 40, y_min: -40,' \
        '  y_max: 40, boundary: feeding, drift_speed: 0.5, tile_x: 120, tile_y: 130}' \
        "ice: {concentration: 0.6, $ice}" >endless.yaml
    expect 0 "$FRAM" field endless.yaml -o tile.geojson --window -60,-65,60,65 --window 7,-200,127,60 \
        --window -60,-60,-50,60 --window 900,-60,910,60 --window -620,-650,580,650 --json
    same "$(value '[abs(w["concentration"] - j["area_m2"] / 15600) < 1e-9 for w in j["windows"][:2] + j["windows"][4:]],
        abs(j["windows"][2]["concentration"] - j["windows"][3]["concentration"]) < 1e-9')" "[True, True, True] True" \
        "windows of an endless field, $ice"
    same "$(value 'j["made"]["tile_m"]')" "[120, 130]" "the tile of an endless field, $ice"
    sed '/^ice/d' endless.yaml >again.yaml
    echo 'ice: {source: file, file: tile.geojson}' >>again.yaml
    expect 0 "$FRAM" field again.yaml -o back.geojson
    cmp -s tile.geojson back.geojson || fail "the tile of an endless field reads back as another one, $ice"
done
if "$FRAM" --version | grep -q cairo; then
    expect 0 "$FRAM" field packed.yaml --draw field.png --cover cover.png --cell 10 --json
    for picture in field.png cover.png; do
        head -c 8 $picture | od -An -tx1 | grep -q "89 50 4e 47" || fail "$picture is no PNG"
    done
    expect 2 "$FRAM" field packed.yaml --cover none.png --cell 1e9 --draw none_too.png --table none.csv
    says "expected cells" err
    [ -z "$(ls none* 2>/dev/null)" ] || fail "a refused size of cells left $(ls none*)"
fi
# Zones that lie over one another are open water once; a floe beside a zone stays, whichever corner is its first.
for ring in '[[0,0],[40,0],[40,40],[0,40],[0,0]]' '[[40,0],[40,40],[0,40],[0,0],[40,0]]'; do
    printf '{"type":"Polygon","coordinates":[%s]}' "$ring" >beside.geojson
    printf '%s\n' 'run: {duration: 1}' 'vessel: {present: false}' \
        'domain: {x_min: -100, x_max: 100, y_min: -100, y_max: 100}' 'ice:' '  source: file' '  file: beside.geojson' \
        '  keep_out_margin: 0' \
        '  open_water: [{x: -20, y: 20, length: 40, width: 40}, {x: -20, y: 20, length: 40, width: 40}]' >beside.yaml
    expect 0 "$FRAM" field beside.yaml --json
    same "$(value 'j["floes"], abs(j["made"]["free_area_m2"] - 38400) < 1e-6')" "1 True" "beside a zone: $ring"
done
# What cannot be: with the key, its place, what was reached and why.
expect 2 "$FRAM" field packed.yaml --set ice.concentration=0.98 --json
same "$(value 'j["error"]["key"]')" ice.concentration "the key of an impossible field"
says "was reached" err
printf '%s\n' 'run: {duration: 1}' 'vessel: {present: false}' 'ice: {source: none}' >water.yaml
expect 2 "$FRAM" field water.yaml
says "no field of floes" err
for scale in 1 2; do
    expect 2 "$FRAM" field packed.yaml --scale $scale
    says "a scenario has keys for it" err
done
expect 2 "$FRAM" field once.geojson --set run.seed=1
says "is for scenarios" err
# A scenario in JSON is none of GeoJSON, whose members may come in any order.
echo '{"run": {"seed": 2}, "vessel": {"present": false}, "ice": {"source": "file", "file": "x}.json"},
    "domain": {"x_min": -50, "x_max": 50, "y_min": -50, "y_max": 50}}' >scenario.json
echo '{"name": "\"type", "bbox": [{"run": 1}],
    "coordinates": [[[0, 0], [9, 0], [9, 9], [0, 0]]], "type": "Polygon"}' >"x}.json"
expect 0 "$FRAM" field scenario.json --set ice.thickness=0.5 --json
same "$(value 'j["rings"], j["floes"], "made" in j')" "1 1 True" "a scenario in JSON"
{ printf '# of {"type"\n\n  # ice\n'; cat scenario.json; } >told.json
expect 0 "$FRAM" field told.json --json
same "$(value '"made" in j')" True "a scenario in JSON below comments"
expect 0 "$FRAM" field "x}.json" --json
same "$(value '"made" in j')" False "GeoJSON that begins with members of others"
expect 2 "$FRAM" field packed.yaml --window 1,2,3
printf '%s\n' '{"type":"Polygon","coordinates":[[[0,0],[1,1],[1,0],[0,1],[0,0]]]}' >bow.geojson
sed -i 's/size: constant,/size: constant, shape: templates, templates: bow.geojson,/' packed.yaml
expect 2 "$FRAM" field packed.yaml --json
same "$(value 'j["error"]["file"].endswith("bow.geojson")')" True "the file of bad templates"
says "none of its 1 outlines" err

# An overlap is as wide as it is where it goes round a corner, and told of a scenario from the contact skin on.
for by in 9.999 9.99999; do
    echo "MULTIPOLYGON (((0 0, 30 0, 30 10, 10 10, 10 30, 0 30, 0 0))," \
        "(($by $by, 40 $by, 40 40, $by 40, $by $by)))" >bent$by.wkt
done
printf '%s\n' 'vessel: {present: false}' 'domain: {x_min: -9, x_max: 49, y_min: -9, y_max: 49}' \
    'ice: {source: file, file: bent9.999.wkt}' >bent.yaml
expect 0 "$FRAM" field bent.yaml
says "1 pairs of floes overlap, by 0.001 m at most" err
says "at most 0.001 m wide; the most, features 1 and 1, polygons 1 and 2" out
expect 0 "$FRAM" field bent.yaml --set ice.file=bent9.99999.wkt
! grep -q '^warning: .*overlap' err || fail "an overlap within the skin warns: $(cat err)"

# There is no less than no ice, as under an arch.
echo 'POLYGON ((0 0, 5 0, 6.1 10.3, 17.7 11.1, 25 0, 30 0, 21.3 20, 9.7 21, 3 19, 0 0))' >arch.wkt
expect 0 "$FRAM" field arch.wkt --window 8.3,2.6,15.6,6.6 --window 8,1.8,15.3,5.8 --json
same "$(value '[0 <= w["concentration"] < 1e-12 for w in j["windows"]]')" "[True, True]" "windows without ice"

# What became of the rings of a scenario's file is told as of the file alone: one beside the domain, one in open water,
# a bow tie, and two that overlap, by their features.
cat >rings.wkt <<'END'
POLYGON ((200 0, 209 0, 209 9, 200 9, 200 0))
POLYGON ((20 20, 29 20, 29 29, 20 29, 20 20))
POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0))
POLYGON ((-9 20, -19 30, -9 30, -19 20, -9 20))
POLYGON ((8 0, 17 0, 17 9, 8 9, 8 0))
END
cat >rings.yaml <<'END'
vessel: {present: false}
domain: {x_min: -50, x_max: 50, y_min: -50, y_max: 50}
ice: {source: file, file: rings.wkt, bad_rings: drop, open_water: [{x: 25, y: 25, length: 6, width: 6}]}
END
expect 0 "$FRAM" field rings.yaml --json -v
same "$(value 'j["rings"], j["floes"], [n["feature"] for n in j["dropped"]], list(map(j["overlap"].get,
    ("feature_a", "feature_b", "polygon_a", "polygon_b")))')" "5 2 [1, 2, 4] [3, 5, 1, 1]" "rings of a scenario's file"
says "feature 2, polygon 1, ring 1 (20, 20): is in the way of a vessel or of open water; left out" err
expect 0 "$FRAM" field rings.yaml --set ice.bad_rings=repair
says "left out: 2, repairs: 2" out
says "repaired: feature 4, polygon 1, ring 1 (line 4): crosses or touches itself" out
expect 2 "$FRAM" field rings.yaml --set ice.bad_rings=drop --set ice.open_water[0].length=90 \
    --set ice.open_water[0].width=90
says "each is in the way of a vessel or of open water; look at where these lie, and at ice.keep_out_margin" err

# How large its run is, is known when its floes are made; before that they are said to be missing.
expect 0 "$FRAM" check rings.yaml --set ice.bad_rings=drop
says "memory: about 0.015 GB beside the floes of its file, which are not counted; run.memory_limit" err
says "MB for what the run leaves beside the floes of its file, which are not counted" err
expect 0 "$FRAM" check rings.yaml --build --set run.duration=0.1
says "memory: about 0.015 GB for about 2 floes; run.memory_limit" err

# A hull that reaches into a wall is refused as by a run.
cat >wall.yaml <<'END'
vessel: {x: 100, y: 0, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
ice: {concentration: 0.5, mean_floe_area: 64}
domain: {x_min: -100, x_max: 110, y_min: -40, y_max: 40, boundary: walls}
END
for words in "field wall.yaml" "run wall.yaml -o walled"; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" $words --json
    same "$(value 'j["error"]["key"]')" vessel.x "the key of a hull inside a wall, by $words"
    says "reaches into the walls" err
done

# Floes that all lie in one place are refused at once, wherever they come from, and not by memory and time: a thousand
# are half a million pairs, and took 4.4 GB.
python3 - <<'END'
import json
import math

ring = [[20 * math.cos(k * math.pi / 6), 20 * math.sin(k * math.pi / 6)] for k in range(12)]
rings = [[[x + i / 1000, y] for x, y in ring] for i in range(1000)]
json.dump({"type": "MultiPolygon", "coordinates": [[r + r[:1]] for r in rings]}, open("heap.geojson", "w"))
floes = "".join(f"  - {{x: {i / 1000}, length: 20, width: 20}}\n" for i in range(1000))
open("heap.yaml", "w").write("ice:\n  source: floes\n  floes:\n" + floes)
open("heap_file.yaml", "w").write("vessel: {present: false}\nice: {source: file, file: heap.geojson}\n")
# One above the other they do not meet.
stack = "".join(f"  - {{elevation: {2 * i}, thickness: 1, length: 20, width: 20}}\n" for i in range(300))
open("stack.yaml", "w").write("vessel: {present: false}\nice:\n  source: floes\n  floes:\n" + stack)
END
for words in "field heap.geojson" "field heap.geojson --bad repair" "field heap_file.yaml" \
    "run heap_file.yaml -o heaped" "run heap.yaml -o heaped" "check --build heap.yaml"; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" $words --json
    says "more than 40000 pairs of 1000 floes" err
done
same "$(value 'j["error"]["key"]')" ice.floes "the key of a heap of floes"
expect 2 "$FRAM" field heap_file.yaml --json
same "$(value 'j["error"]["file"].endswith("heap.geojson")')" True "the file of a heap of floes"
expect 0 "$FRAM" check --build stack.yaml -q

# Words and files that are wrong.
expect 2 "$FRAM" field
expect 2 "$FRAM" field missing.geojson
says "missing.geojson" err
expect 2 "$FRAM" field . --json
same "$(value 'j["error"]["file"]')" . "a folder as a file"
expect 2 "$FRAM" field once.geojson -o .
says "found a folder" err
: >empty.geojson
expect 2 "$FRAM" field empty.geojson
says "empty.geojson:1:1" err
printf '\xff\xfe{' >other.geojson
expect 2 "$FRAM" field other.geojson
says "other.geojson:1:1: expected" err
for head in '\0\0\x27\x0a' 'SQLite format 3\0' '7\0'; do
    # shellcheck disable=SC2059
    printf "$head" >binary.shp
    expect 2 "$FRAM" field binary.shp
    says "found a binary file: export GeoJSON" err
done
for words in "--scale 0" "--scale nan" "--scale -1" "--scale 1e300" "--crop 1,2,3" "--crop 3,0,1,1" "--crop 0,0,1,nan" \
    "--simplify -1" "--smallest -1" "--bad mend" "--smallest 1e9" "--x 1e400" "--wrong"; do
    # shellcheck disable=SC2086  # an option and its value
    expect 2 "$FRAM" field once.geojson $words --json
    value 'j["error"]["message"]' >/dev/null || fail "no JSON error after $words"
done

# Why no floe is left.
none_left() {
    local words=$1
    shift
    expect 2 "$FRAM" field "$@"
    says "$words" err
    case $words in *outside*) ;; *) ! grep -q "look at .*scale" err || fail "scale is to blame: $(cat err)" ;; esac
}
none_left "left of 1 rings: 1 of them or of their pieces were left out because each crosses" bow.geojson --bad drop
none_left "4 of them or of their pieces were left out because each is under the smallest area" once.geojson \
    --smallest 1000
none_left "each is outside the window; look at --scale, --x, --y and --crop" once.geojson --crop 900,0,999,9
# A floe as wide as the domain, with its vessel in it, and thirteen beside: those come last, and are no reason.
python3 - <<'END' >wide.wkt
for x in list(range(900, 1550, 50)) + [-50]:
    d = 100 if x < 0 else 40
    print(f"POLYGON (({x} -50, {x + d} -50, {x + d} 50, {x} 50, {x} -50))")
END
cat >wide.yaml <<'END'
vessel: {hull: {length: 20, beam: 6, draught: 2, freeboard: 2}}
ice: {source: file, file: wide.wkt}
domain: {x_min: -40, x_max: 40, y_min: -40, y_max: 40}
END
none_left "13 lie outside the domain: look at ice.file_scale, ice.file_x, ice.file_y and domain" wide.yaml
says "of 14 rings: 1 of them or of their pieces were left out because each is in the way of a vessel" err
says "look at where these lie, and at ice.keep_out_margin; 13 lie" err
# With twelve under the smallest area too, those are the most of what is in the domain.
cp wide.wkt small.wkt
for y in {-30..-19}; do echo "POLYGON ((20 $y, 20.5 $y, 20.5 $y.5, 20 $y.5, 20 $y))"; done >>small.wkt
expect 2 "$FRAM" field wide.yaml --set ice.file=small.wkt --set ice.smallest_floe_area=1
says "12 of them or of their pieces were left out because each is under the smallest area; 13 lie outside" err
echo 'POLYGON ((20 20, 30 20, 30 30, 20 30, 20 20))' >>wide.wkt
expect 0 "$FRAM" field wide.yaml
says "left out: feature 14, polygon 1, ring 1 (line 14): is in the way" out
same "$(grep -c "left out: feature" out)" 12 "notes that are shown"
echo '{"type": "Feature", "properties": {"kind": "wall"}, "geometry": null}' >walls.geojson
echo 'POLYGON ((0 0, 5 0, 5 5, 5 0, 0 0))' >spike.wkt
none_left "left of 1 rings: none winds round an area" spike.wkt --bad repair
none_left "the file has no floes; 1 feature of kind vessel or wall was passed over" walls.geojson

# Floes of a file that are in the way of a vessel are told where the field is endless too; the next tile brings them.
cat >covered.yaml <<'YAML'
run: {duration: 1, time_step: 0.02}
vessel: {mode: prescribed, hull: {form: box, length: 60, beam: 20, draught: 3, freeboard: 3}}
domain: {boundary: feeding, drift_speed: 0.5, x_min: -100, x_max: 100, y_min: -60, y_max: 60}
ice: {source: file, file: covered.txt}
YAML
printf '%s\n' '0 0' '6 0' '6 6' '0 6' '' '10 0' '16 0' '16 6' '10 6' >covered.txt
expect 0 "$FRAM" check --build covered.yaml
says "warning: 2 of 2 floes left out at the start, 0 of them concave: they are in the way of a vessel" err
says "none is there until the field drifts on and repeats itself" err
says "built: 0 floes" err
expect 0 "$FRAM" run covered.yaml -o covered --quiet --set run.duration=60 --set run.time_step=0.1 \
    --set domain.drift_speed=4
python3 - <<'PY' || fail "the next tile brings no floes"
import csv
lines = open("covered/series.csv").read().splitlines()
names = [name.split("[")[0] for name in lines[0].split(",")]
rows = [dict(zip(names, row)) for row in csv.reader(lines[1:])]
assert float(rows[0]["floes"]) == 0 and max(float(row["floes"]) for row in rows) > 0
PY
printf '%s\n' '' '60 0' '66 0' '66 6' '60 6' >>covered.txt
expect 0 "$FRAM" check --build covered.yaml
says "warning: 2 of 3 floes left out at the start, 0 of them concave: they are in the way of a vessel" err
says "built: 1 floe among" err
grep "1 floes\|1 bodies" err && fail "one is told as several"
for x in 60 70 80; do printf '%s\n' '' "$x 20" "$((x + 6)) 20" "$((x + 6)) 26" "$x 26" >>covered.txt; done
expect 0 "$FRAM" check --build covered.yaml
says "2 of 6 floes left out at the start" err
printf '%s\n' '0 0' '6 0' '3 2' '6 6' '0 6' '' '60 0' '66 0' '66 6' '60 6' >concave.txt
expect 0 "$FRAM" check --build covered.yaml --set ice.file=concave.txt
says "warning: 1 of 2 floes left out at the start, 1 of them concave: they are in the way of a vessel" err
expect 0 "$FRAM" check --build covered.yaml
! grep -q "warning: 2 of 6" err || fail "some floes under a hull are a warning: $(cat err)"
# Of a field that is drawn a hull covers some, which is no news.
sed -e 's/file, file: covered.txt/voronoi, mean_floe_area: 30/' covered.yaml >drawn.yaml
expect 0 "$FRAM" check --build drawn.yaml
! grep -q "left out at the start" err || fail "floes of a drawn field under a hull are told: $(cat err)"

# Nothing is written over the input, nor two outputs into one file.
cp floes.geojson keep.geojson
ln -s keep.geojson link.geojson
expect 2 "$FRAM" field keep.geojson --bad drop -o link.geojson
says "--output" err
expect 2 "$FRAM" field keep.geojson --bad drop --draw one.svg --table one.svg
says "--table: names another output too" err
expect 2 "$FRAM" field packed.yaml --table sizes.txt
says "--table: expected a table's name that ends in .csv" err
[ ! -e sizes.txt ] || fail "a table of another ending is written"
cmp -s floes.geojson keep.geojson || fail "the input was written over"
expect 2 "$FRAM" field keep.geojson --cell 5
says "--cover" err
# Nor over what a scenario names.
cp once.geojson seen.geojson
expect 2 "$FRAM" field file.yaml --set ice.file=seen.geojson -o ./seen.geojson --force
says "--output: names what the command reads" err
cmp -s once.geojson seen.geojson || fail "a field that a scenario reads was written over"

# A bin of a histogram at fault is a line of its file.
printf 'diameter_min[m],diameter_max[m],floes\n4,6,10\n6,12,-5\n' >sizes.csv
cat >packed.yaml <<'END'
ice:
  source: packed
  concentration: 0.6
  populations: [{size: histogram, histogram: sizes.csv}]
END
expect 2 "$FRAM" field packed.yaml --table sizes.csv
says "--table: names what the command reads" err
expect 2 "$FRAM" field packed.yaml
says "sizes.csv:3: the weights of a histogram must not be negative" err
printf 'diameter_min[m],diameter_max[m],floes\n4,6,10\n\n7,12,5\n' >sizes.csv
expect 2 "$FRAM" field packed.yaml
says "sizes.csv:4: diameter_min: each bin must begin where the one before ends" err

# Degrees: a floe of a hundredth of a degree each way at 75 N, and one across the date line, both of 1116.93 m (a
# degree of the meridian there is 111,661 m) by 289.66 m (28,902 m a degree of longitude, Bowring's series): told apart
# from lengths, laid flat on request, to a part in ten thousand of the area on the ellipsoid.
for at in 20 179.995; do
    python3 - "$at" <<'END' >degrees.geojson
import json, sys
x, y, d = float(sys.argv[1]), 75.0, 0.01
wrap = lambda v: v - 360 if v > 180 else v
ring = [[wrap(a), b] for a, b in ((x, y), (x + d, y), (x + d, y + d), (x, y + d), (x, y))]
print(json.dumps({"type": "Polygon", "coordinates": [ring]}))
END
    if [ "$at" = 20 ]; then
        expect 2 "$FRAM" field degrees.geojson
        says "look like degrees" err
    fi
    expect 0 "$FRAM" field degrees.geojson --degrees --json
    python3 - "$(value 'j["area_m2"]')" <<'END' || fail "area in degrees at $at"
import math, sys
a, f = 6378137.0, 1 / 298.257223563
e2, step = f * (2 - f), math.radians(0.01)
# Area of a strip of the ellipsoid between two parallels, by its closed form.
def q(p):
    e, s = math.sqrt(e2), math.sin(p)
    return (1 - e2) * a * a / 2 * (s / (1 - e2 * s * s) + math.atanh(e * s) / e)
area = step * (q(math.radians(75.01)) - q(math.radians(75)))
sys.exit(abs(float(sys.argv[1]) / area - 1) > 1e-6)
END
done
# The southernmost sea ice, off Laizhou.
cat >bohai.geojson <<'END'
{"type": "Polygon", "coordinates": [[[119.5, 37.1], [119.51, 37.1], [119.51, 37.11], [119.5, 37.11], [119.5, 37.1]]]}
END
expect 2 "$FRAM" field bohai.geojson
says "look like degrees" err
# A floe of 38 km in the Arctic, more than two degrees of longitude wide.
sed 's/119.51/121.7/g; s/37.11/37.46/g; s/37\([.0-9]*\)\]/80\1]/g' bohai.geojson >arctic.geojson
expect 2 "$FRAM" field arctic.geojson
says "look like degrees" err
# Nine floes in ten tell: a vast one among them; latitude first, which a longitude beyond 90 tells.
python3 - <<'END'
import json

def square(x, y, d):
    return [[x, y], [x + d, y], [x + d, y + d], [x, y + d], [x, y]]

floes = [square(-156.8 + 0.02 * i, 70.3, 0.01) for i in range(11)]
for name, rings in {"vast": floes + [square(-154, 70.3, 2)], "vaster": floes[:8] + [square(-154, 70.3, 2)],
                    "swapped": [[[y, x] for x, y in ring] for ring in floes]}.items():
    json.dump({"type": "MultiPolygon", "coordinates": [[ring] for ring in rings]}, open(name + ".geojson", "w"))
END
expect 2 "$FRAM" field vast.geojson
says "look like degrees of longitude and latitude, and lengths" err
expect 0 "$FRAM" field vaster.geojson
expect 2 "$FRAM" field swapped.geojson
says "look like degrees of latitude and longitude, which are swapped (longitude comes first), and lengths" err
expect 2 "$FRAM" field swapped.geojson --degrees
says "expected longitudes from -360 to 360 first, and latitudes" err
expect 0 "$FRAM" field swapped.geojson --scale 1
# Where both may be latitudes, what lies where there is no ice is warned of, and read as it stands; a lake is not.
warm() { sed "s/119.5/$1/g; s/37.1/$2/g" bohai.geojson >warm.geojson && expect 0 "$FRAM" field warm.geojson --degrees; }
warm 78.2 15.3
says "warm.geojson: ice at latitude 15.3" err
says "longitude comes first; are they swapped?" err
for at in "15.3 78.2" "20.1 30.2" "110.3 30.2" "78.2 40.3"; do
    # shellcheck disable=SC2086
    warm $at
    ! grep -q swapped err || fail "degrees at $at are taken for swapped"
done
# Floes of half a metre at 60 m of a tank: metres where that is said, of zones and floes of a scenario by its scale.
cat >tank.geojson <<'END'
{"type": "MultiPolygon", "coordinates": [[[[0, 60], [0.5, 60], [0.5, 60.5], [0, 60.5], [0, 60]]],
  [[[1, 60], [1.5, 60], [1.5, 61], [1, 60]]]]}
END
expect 2 "$FRAM" field tank.geojson
says "or give the scale that makes metres of them, 1 too" err
expect 0 "$FRAM" field tank.geojson --scale 1 --json
same "$(value 'j["floes"], j["area_m2"]')" "2 0.5" "floes in a tank"
cat >tank.yaml <<'END'
run: {duration: 1, scale: 1}
vessel: {present: false}
ice: {source: file, file: tank.geojson}
domain: {x_min: -5, x_max: 5, y_min: 0, y_max: 78}
END
expect 0 "$FRAM" field tank.yaml --json
same "$(value 'j["floes"]')" 2 "floes in a tank's scenario"
expect 0 "$FRAM" field tank.yaml --set ice.source=voronoi --set ice.concentration=0.5 --set ice.file= \
    --set ice.open_water_file=tank.geojson --set ice.mean_floe_area=20 -q
for ice in file=tank.geojson "open_water_file=tank.geojson --set ice.source=voronoi --set ice.file="; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" field tank.yaml --set run.scale=30 --set ice.$ice
    says "metres of a tank go with its run.scale, under 10" err
done
# Zones and templates have no option for degrees and bad rings: none is named.
printf '%s\n' 'run: {duration: 1}' 'ice: {open_water_file: hole.wkt}' >zones.yaml
echo 'POLYGON ((90 40, 99 40, 99 49, 90 40), (92 41, 94 41, 94 42, 92 41))' >hole.wkt
expect 2 "$FRAM" field zones.yaml
says "ring 2: the ring is a hole; cut its polygon in two that have none, for a repair would fill it" err
sed 's/40, 99 49, 90 40), .*/40, 90 49, 99 49, 90 40))/' hole.wkt >crossed.wkt
expect 2 "$FRAM" field zones.yaml --set ice.open_water_file=crossed.wkt
says "crosses or touches itself; mend the file, as \"fram field\" can" err
expect 2 "$FRAM" field zones.yaml --set ice.open_water_file=arctic.geojson
says "only lengths are taken here" err
# An endless field is told as the tile that it is, and its zones are read as by a run.
fed=(--set domain.boundary=feeding --set vessel.present=false)
expect 0 "$FRAM" field zones.yaml "${fed[@]}" --set ice.open_water_file=
says "% of the tile" out
says "the tile repeats itself after" out
# Tiles, windows and places that a run refuses are refused as by that.
for bad in vessel.present=true domain.tile_x=101 domain.band=0.1 "domain.x_max=-90"; do
    fault=0
    "$FRAM" run zones.yaml -o fed -q --until 0.01 "${fed[@]}" --set ice.open_water_file= --set vessel.x=90 \
        --set domain.x_min=-100 --set domain.x_max=100 --set "$bad" 2>ran || fault=$?
    same "$fault" 2 "a run with $bad"
    expect 2 "$FRAM" field zones.yaml "${fed[@]}" --set ice.open_water_file= --set vessel.x=90 \
        --set domain.x_min=-100 --set domain.x_max=100 --set "$bad"
    same "$(tail -1 err)" "$(tail -1 ran)" "what fram field says of $bad"
done
expect 2 "$FRAM" field zones.yaml "${fed[@]}"
says "ring 2: the ring is a hole" err
# Zones that lie beside the domain, as in other coordinates, are told; of a file only when all of it does.
printf '%s\n' 'run: {duration: 1}' 'domain: {x_min: -100, x_max: 100, y_min: -100, y_max: 100}' \
    'ice: {open_water: [{x: 60, y: 0, length: 99, width: 9}, {x: 3000, y: 0, length: 50, width: 20},' \
    '  {x: 120, y: 120, length: 90, width: 6, angle_deg: 135}]}' >elsewhere.yaml
printf '%s\n' 'POLYGON ((400000 0, 400090 0, 400000 90, 400000 0))' >zones.wkt
expect 0 "$FRAM" field elsewhere.yaml --set ice.open_water_file=zones.wkt
says "ice.open_water[1]: it lies beside the domain and keeps no ice away" err
says "ice.open_water[2]: it lies beside the domain and keeps no ice away" err # across the domain's corner
says "ice.open_water_file: all of it lies beside the domain and keeps no ice away: x from 400000 to 400090" err
! grep -qF "open_water[0]" err || fail "a zone inside the domain is said to lie beside it"
echo 'POLYGON ((90 0, 140 0, 100 40, 90 0))' >>zones.wkt
expect 0 "$FRAM" field elsewhere.yaml --set ice.open_water_file=zones.wkt
! grep -qF open_water_file err || fail "a file with a zone inside the domain is said to lie beside it"
# --centre of degrees; a field round the pole is centred in any case: the middle of its degrees lies beside the pole.
expect 0 "$FRAM" field arctic.geojson --degrees --centre --x 7 --json
same "$(value 'all(abs(j["bounds_m"][k] + j["bounds_m"][k + 2] - at) < 1e-6 for k, at in ((0, 14), (1, 0)))')" \
    True "the centre of degrees"
cat >pole.geojson <<'END'
{"type": "MultiPolygon", "coordinates": [[[[0, 89.9], [4, 89.9], [2, 89.91], [0, 89.9]]],
  [[[90, 89.9], [94, 89.9], [92, 89.91], [90, 89.9]]], [[[180, 89.9], [184, 89.9], [182, 89.91], [180, 89.9]]],
  [[[-90, 89.9], [-86, 89.9], [-88, 89.91], [-90, 89.9]]]]}
END
expect 0 "$FRAM" field pole.geojson --degrees --json
same "$(value 'abs(j["bounds_m"][0] + j["bounds_m"][2]) < 1e-6, abs(j["bounds_m"][1] + j["bounds_m"][3]) < 1e-6')" \
    "True True" "a field round the pole"
expect 2 "$FRAM" field floes.geojson --bad drop --degrees --scale 2
says "have no scale" err
sed 's/40.1/400.1/g' floes.geojson >far.geojson
expect 2 "$FRAM" field far.geojson --bad drop --degrees
says "feature 3, polygon 1, ring 1: expected longitudes from -360 to 360" err
expect 2 "$FRAM" field floes.geojson --bad drop --degrees
says "farther than 1000 km from its centre" err
cat >degrees.yaml <<'END'
run: {duration: 1}
vessel: {present: false}
ice: {source: file, file: degrees.geojson, file_coordinates: degrees, file_x: 100, file_y: -20, thickness: 0.5}
domain: {x_min: -2000, x_max: 2000, y_min: -2000, y_max: 2000, boundary: open}
END
expect 0 "$FRAM" field degrees.yaml --json
same "$(value '[round(0.5 * (j["bounds_m"][k] + j["bounds_m"][k + 2])) for k in (0, 1)]')" "[100, -20]" \
    "centre of a field in degrees"
expect 0 "$FRAM" field degrees.yaml --set ice.file=once.geojson --set ice.file_coordinates=planar \
    --set ice.file_centre=true --json
same "$(value '[round(0.5 * (j["bounds_m"][k] + j["bounds_m"][k + 2]), 9) for k in (0, 1)]')" "[100.0, -20.0]" \
    "centre of a field in metres"
expect 2 "$FRAM" field degrees.yaml --set ice.file_coordinates=planar
expect 2 "$FRAM" field degrees.yaml --set ice.file_coordinates=polar
says "ice.file_coordinates" err

# What an export says is no ice, is none.
cat >kinds.geojson <<'JSON'
{"type":"FeatureCollection","features":[
{"type":"Feature","geometry":{"type":"Polygon","coordinates":[[[0,0],[10,0],[10,10],[0,10],[0,0]]]},
 "properties":{"kind":"floe"}},
{"type":"Feature","properties":{"kind":"vessel"},
 "geometry":{"type":"Polygon","coordinates":[[[20,0],[30,10],[30,0],[20,10],[20,0]]]}},
{"type":"Feature","properties":{"kind":"wall"},"geometry":{"type":"Polygon","coordinates":[]}},
{"type":"Feature","properties":{"kind":null},
 "geometry":{"type":"Polygon","coordinates":[[[40,0],[50,0],[45,9],[40,0]]]}}
]}
JSON
expect 0 "$FRAM" field kinds.geojson --json
same "$(value 'j["rings"], j["floes"], j["passed_over"]')" "2 2 2" "floes among other kinds"
expect 0 "$FRAM" field kinds.geojson
says "passed over: 2 features of kind vessel or wall, not ice" out
# A run tells of walls that it has not; what it exported itself has its vessel and, of a basin, its walls.
cat >kinds.yaml <<'YAML'
run: {duration: 0.1, time_step: 0.05}
vessel: {present: false}
ice: {source: file, file: kinds.geojson}
domain: {x_min: -20, x_max: 80, y_min: -20, y_max: 40, boundary: open}
YAML
walls="kinds.geojson: 1 feature of kind wall is no ice and was passed over, and the domain has no walls"
expect 0 "$FRAM" run kinds.yaml -o kinds --force
says "$walls: domain.boundary: walls makes it a basin" err
expect 0 "$FRAM" field kinds.yaml
says "$walls" err
expect 0 "$FRAM" run kinds.yaml -o kinds --force --set domain.boundary=walls
grep 'of kind wall' err && fail "a basin is told that it has no walls"

finish "fram field: as it should be"

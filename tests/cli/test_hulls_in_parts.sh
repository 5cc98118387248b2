#!/usr/bin/env bash
# A field has ice between the hulls of a catamaran and under its deck, unless the margins around them leave no room; of
# a hull in one part nothing is under what is seen from above.
. "$FRAM_SOURCE/tests/cli/common.sh"
# prism PROFILE CAPS: 40 m long, of corners y, z and of the convex pieces of its ends.
prism() {
    python3 - "$@" <<'PY'
import ast, sys
profile, caps = map(ast.literal_eval, sys.argv[1:])
n = len(profile)
for x in (-20, 20):
    for y, z in profile:
        print("v", x, y, z)
for i in range(n):
    k = (i + 1) % n
    print("f", k + 1, k + 1 + n, i + 1 + n, i + 1)
for piece in caps:
    print("f", *(i + 1 for i in reversed(piece)))
    print("f", *(i + 1 + n for i in piece))
PY
}
# hull LOW HIGH: two hulls of 6 m, 18 m apart, and over them a deck whose underside is between these heights.
hull() {
    prism "[(-15, -3), (-9, -3), (-9, $1), (9, $1), (9, -3), (15, -3), (15, $2), (-15, $2)]" \
        "[(0, 1, 2, 7), (2, 3, 6, 7), (3, 4, 5, 6)]"
}
hull 1.5 2.5 >high.obj
hull 0.02 2.5 >low.obj
cat >field.yaml <<'YAML'
vessel: {hull: {form: file, file: high.obj}}
ice: {thickness: 0.5, concentration: 0.8, mean_floe_area: 9, smallest_floe_area: 0.5}
domain: {boundary: open, x_min: -60, x_max: 60, y_min: -40, y_max: 40}
YAML
# Part of the water between the hulls that floes have their middle in, and of the hulls themselves.
covered() {
    expect 0 "$FRAM" field field.yaml -o floes.geojson "$@"
    python3 - <<'PY'
import json
def moments(ring):
    pairs = list(zip(ring, ring[1:]))
    cross = [a[0] * b[1] - b[0] * a[1] for a, b in pairs]
    area = sum(cross) / 2
    return area, *(sum((a[k] + b[k]) * c for (a, b), c in zip(pairs, cross)) / (6 * area) for k in (0, 1))
between = hulls = 0
for feature in json.load(open("floes.geojson"))["features"]:
    if feature["properties"].get("kind", "floe") != "floe":
        continue
    area, x, y = moments(feature["geometry"]["coordinates"][0])
    between += area * (abs(x) < 20 and abs(y) < 9)
    hulls += area * (abs(x) < 20 and 9 < abs(y) < 15)
print(f"{between / (40 * 16):.1f} {hulls:.0f}")
PY
}
same "$(covered)" "0.8 0" "ice between the hulls, and in them"
same "$(covered --set vessel.hull.file=low.obj)" "0.0 0" "ice under a deck that lies on it"
same "$(covered --set ice.keep_out_margin=9.1)" "0.0 0" "ice where margins leave no room"
same "$(covered --set ice.keep_out_margin=8)" "0.1 0" "ice where margins leave little room"
# In level ice and in an endless field likewise.
floes() {
    expect 0 "$FRAM" check --build field.yaml --set ice.keep_out_margin=1 "$@"
    sed -n 's/.*built: \([0-9]*\) floes.*/\1/p' err
}
feeding=(--set domain.boundary=feeding --set domain.drift_speed=0.5)
[ "$(floes "${feeding[@]}")" -gt "$(floes "${feeding[@]}" --set vessel.hull.file=low.obj)" ] ||
    fail "no ice between the hulls in an endless field"
[ "$(floes --set ice.source=level)" -gt "$(floes --set ice.source=level --set vessel.hull.file=low.obj)" ] ||
    fail "no level ice between the hulls"

# A SWATH: pontoons 22 m apart from 1.2 m under water on, which thick ice reaches and thin ice does not.
prism "[(-19, -5), (-11, -5), (-11, -1.2), (-14, -1.2), (-14, 4), (14, 4), (14, -1.2), (11, -1.2), (11, -5), (19, -5),
    (19, -1.2), (16, -1.2), (16, 6), (-16, 6), (-16, -1.2), (-19, -1.2)]" \
    "[(0, 1, 2, 3, 14, 15), (3, 4, 13, 14), (4, 5, 12, 13), (5, 6, 11, 12), (6, 7, 8, 9, 10, 11)]" >swath.obj
cat >swath.yaml <<'YAML'
run: {duration: 0.02, time_step: 0.02, transient: 0}
vessel: {mode: prescribed, speed: 0, hull: {form: file, file: swath.obj}}
domain: {boundary: open, x_min: -60, x_max: 60, y_min: -40, y_max: 40}
ice: {smallest_floe_area: 0.5}
YAML
# outlines THICKNESS: floes of 4 m that touch the inner sides of the struts, and one far off.
outlines() {
    python3 - "$1" <<'PY'
import json, sys
def floe(x, y):
    ring = [[x - 2, y - 2], [x + 2, y - 2], [x + 2, y + 2], [x - 2, y + 2], [x - 2, y - 2]]
    return {"type": "Feature", "properties": {"thickness": float(sys.argv[1])},
            "geometry": {"type": "Polygon", "coordinates": [ring]}}
places = [(x, y) for x in (-12, -6, 0, 6, 12) for y in (-10.5, 0, 10.5)] + [(45, 0)]
print(json.dumps({"type": "FeatureCollection", "features": [floe(*p) for p in places]}))
PY
}
outlines 4 >thick.geojson
outlines 0.5 >thin.geojson
# first SCENE ...: how deep floes are in one another or the hull at the first step, and how many there are.
first() {
    rm -rf swath
    expect 0 "$FRAM" run "$1.yaml" -o swath --quiet "${@:2}"
    python3 - <<'PY'
import csv
lines = open("swath/series.csv").read().splitlines()
names = [name.split("[")[0] for name in lines[0].split(",")]
rows = [dict(zip(names, row)) for row in csv.reader(lines[1:])]
print(float(rows[0]["overlap_max"]), int(float(rows[0]["floes"])))
PY
}
file=(--set ice.source=file)
same "$(first swath "${file[@]}" --set ice.file=thick.geojson --set ice.thickness=0.5)" "0.0 6" "thick floes of a file"
same "$(first swath "${file[@]}" --set ice.file=thin.geojson --set ice.thickness=4)" "0.0 16" "thin floes of a file"
# Thickness that scatters is not known before the floes are there; in an endless field they are.
sed '$d' swath.yaml >packed.yaml
cat >>packed.yaml <<'YAML'
ice: {source: packed, concentration: 0.5, populations: [{diameter_min: 2, diameter_max: 6, thickness: 1}]}
YAML
scatter=(--set "ice.populations[0].thickness_deviation=1.2")
scattered=$(first packed "${scatter[@]}")
known=$(first packed --set "ice.populations[0].thickness=0.5" --set ice.thickness=4)
same "${scattered% *} ${known% *}" "0.0 0.0" "ice in a hull at the start"
[ "${known#* }" -gt "${scattered#* }" ] || fail "a thickness that no floe has keeps ice away: $scattered, $known"
feeding+=(--set domain.tile_x=200 --set domain.tile_y=150)
scattered=$(first packed "${feeding[@]}" "${scatter[@]}")
same "${scattered% *}" "0.0" "ice of an endless field in a hull at the start"
finish "hulls in parts have ice between them"

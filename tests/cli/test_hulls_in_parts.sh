#!/usr/bin/env bash
# A field has ice between the hulls of a catamaran and under its deck, unless the margins around them leave no room; of
# a hull in one part nothing is under what is seen from above.
. "$FRAM_SOURCE/tests/cli/common.sh"
# hull LOW HIGH: two hulls of 6 m, 18 m apart, and over them a deck whose underside is between these heights.
hull() {
    python3 - "$@" <<'PY'
import sys
low, high = map(float, sys.argv[1:])
profile = [(-15, -3), (-9, -3), (-9, low), (9, low), (9, -3), (15, -3), (15, high), (-15, high)]
for x in (-20, 20):
    for y, z in profile:
        print("v", x, y, z)
for i in range(8):
    k = (i + 1) % 8
    print("f", k + 1, k + 9, i + 9, i + 1)
for quad in ((0, 1, 2, 7), (2, 3, 6, 7), (3, 4, 5, 6)):
    print("f", *(i + 1 for i in reversed(quad)))
    print("f", *(i + 9 for i in quad))
PY
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
finish "hulls in parts have ice between them"

#!/usr/bin/env bash
# A field of a file whose water populations fill is told as one that is drawn: populations, concentration, thickness.
. "$FRAM_SOURCE/tests/cli/slips.sh"

cat >floes.geojson <<'JSON'
{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon",
 "coordinates": [[[0, 0], [12, 0], [12, 9], [0, 9], [0, 0]]]}}]}
JSON
cat >filled.yaml <<'YAML'
run: {duration: 1, time_step: 0.05}
domain: {x_min: -40, x_max: 40, y_min: -40, y_max: 40}
ice: {source: file, file: floes.geojson, concentration: 0.4, thickness: 0.4,
      populations: [{size: constant, diameter: 4, thickness: 0.2}]}
vessel: {mode: towed, x: -30, hull: {form: box, length: 10, beam: 4, draught: 2}}
YAML
expect 0 "$FRAM" check filled.yaml
says "population 1 of 1: 100 % of the ice between the floes of the file, diameter 4 m; 0.2 m thick" err
grep 'next to open water' err && fail "a concentration of 0.4 is told to be small"
told filled.yaml "ice.concentration: 0.02 is next to open water" --set ice.concentration=0.02
expect 0 "$FRAM" run filled.yaml -o filled -q
expect 0 "$FRAM" report filled
says "40 % of the area free for ice requested" filled/report.html
says "40 % was requested of the area free for ice" filled/report.html
# Without populations the concentration is that of the file.
sed '/populations/d; s/thickness: 0.4,/thickness: 0.4}/' filled.yaml >alone.yaml
expect 0 "$FRAM" check alone.yaml --set ice.concentration=0.02
grep 'next to open water' err && fail "a concentration that nothing asks for is told to be small"
expect 0 "$FRAM" run alone.yaml -o alone -q
expect 0 "$FRAM" report alone
grep 'requested' alone/report.html && fail "a file's floes alone are told to be requested"
finish "populations beside the floes of a file are told"

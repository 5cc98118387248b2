#!/usr/bin/env bash
# Ready vessels (scenes/vessels): each is a scenario that runs, floats where its file says, and keeps still or goes
# ahead.
. "$FRAM_SOURCE/tests/cli/common.sh"
for file in "$FRAM_SOURCE"/scenes/vessels/*.yaml; do
    name=$(basename "$file" .yaml)
    "$FRAM" run "$file" -o "$scratch/$name" --until 20 --quiet || failures=$((failures + 1))
    python3 - "$scratch/$name/series.csv" "$name" <<'END' || failures=$((failures + 1))
import csv
import sys

rows = [{key.split("[")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(open(sys.argv[1]))]
first, last = rows[0], rows[-1]
bad = abs(last["position_z"] - first["position_z"]) > 0.05 or abs(last["pitch"]) > 0.2 or abs(last["roll"]) > 0.2
if sys.argv[2] == "icebreaker":
    bad = bad or last["velocity_x"] < 1 or abs(last["yaw"]) > 0.1
else:
    bad = bad or abs(last["velocity_x"]) > 0.05 or abs(last["position_x"] - first["position_x"]) > 0.5
if bad:
    sys.exit(f"FAILED: {sys.argv[2]}: {last}")
END
done

finish "ready vessels run"

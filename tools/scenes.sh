#!/bin/sh
# Run the ready scenes of vessels on station, SCENE_SECONDS (600: ten minutes) of each, and say what came of them.
set -eu
cd "$(dirname "$0")/.."
seconds=${SCENE_SECONDS:-600}
for name in supply_ship turret_ship conical_unit; do
    echo "scenes/$name.yaml, $seconds s"
    build/release/fram run "scenes/$name.yaml" -o "out/$name" --force --threads 2 --set run.duration="$seconds"
    echo "  out/$name/station.png, station.json: offsets, loads, tensions, power, events on one page"
done

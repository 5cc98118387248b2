#!/bin/sh
# Run the ready scenes of vessels on station (ten simulated minutes each) and say what came of them.
set -eu
cd "$(dirname "$0")/.."
for name in supply_ship turret_ship conical_unit; do
    echo "scenes/$name.yaml"
    build/release/fram run "scenes/$name.yaml" -o "out/$name" --force --threads 2
    echo "  out/$name/station.png, station.json: offsets, loads, tensions, power, events on one page"
done

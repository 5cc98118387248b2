#!/bin/sh
# Run the ready scenes of ice management to their end, with and without icebreakers, and make the page of each.
set -eu
cd "$(dirname "$0")/.."
sail() { # scene, folder, settings
    scene=$1 folder=$2
    shift 2
    echo "scenes/$scene.yaml, out/$folder"
    build/release/fram run "scenes/$scene.yaml" -o "out/$folder" --force --threads 2 "$@"
}
page() { # folder, that of the vessel alone, vessel
    build/release/fram manage "out/$1" --beside "out/$2" --vessel "$3" -o "out/$1/manage.html" --force
    echo "  out/$1/manage.html: what ice came, loads, offsets and tracks beside those of the vessel alone"
}
sail escort tanker_alone --set vessels.icebreaker.present=false
sail escort escort
page escort tanker_alone tanker
sail drillship_one_icebreaker drillship_alone --set vessels.icebreaker.present=false
sail drillship_one_icebreaker drillship_one
page drillship_one drillship_alone drillship
sail drillship_two_icebreakers drillship_two
page drillship_two drillship_alone drillship

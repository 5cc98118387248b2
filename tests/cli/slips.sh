# What tests of slips of a pen share: a moored ship without one, ship.yaml, and how a slip is told.
# shellcheck shell=bash
. "$FRAM_SOURCE/tests/cli/common.sh"

cat >ship.yaml <<'YAML'
run: {duration: 600, time_step: 0.05, transient: 60}
vessel:
  mode: free
  hull: {form: icebreaker, length: 76, beam: 19, draught: 6.5, freeboard: 3.5}
  mooring:
    depth: 120
    lines:
      - {count: 8, spacing_deg: 45, distance: 900, pretension: 8.0e5, weight: 1500, stiffness: 8.0e8,
         breaking_load: 8.0e6}
  thrusters: [{x: 30, thrust: 2.0e5}, {x: -30, thrust: 2.0e5}]
ice: {concentration: 0.7, mean_floe_area: 200, thickness: 0.7}
domain: {x_min: -160, x_max: 160, y_min: -160, y_max: 160, boundary: feeding}
environment: {current_speed: 0.4, current_direction_deg: 180, wind_speed: 8, wind_direction_deg: 170}
YAML

# told SCENE WORDS OPTIONS...: a warning with all the words between the bars
told() {
    local scene=$1 words=$2
    shift 2
    expect 0 "$FRAM" check "$scene" "$@"
    grep '^warning' err | grep -F -- "${words%%|*}" | grep -qF -- "${words##*|}" ||
        fail "not told \"$words\" of $*: $(grep '^warning' err)"
}

#!/usr/bin/env bash
# What is told of a current holds whoever tells it: the keys, a history, or the surface of a profile over depth.
. "$FRAM_SOURCE/tests/cli/slips.sh"

printf 'time [s],x [m/s],y [m/s]\n0,-1,0\n100000,-1,0\n' >history.csv
printf 'depth [m],x [m/s],y [m/s]\n0,-1,0\n50,-0.2,0\n' >profile.csv
currents=("current_speed: 1, current_direction_deg: 180" "current_file: history.csv"
    "current_profile_file: profile.csv" "current_speed: 3, current_profile_file: slow.csv")
# On top of 3 m/s towards X.
printf 'depth [m],x [m/s],y [m/s]\n0,-4,0\n' >slow.csv
hull="hull: {form: ship, length: 60, beam: 15, draught: 5}"

# warned SCENE: the warnings, those of a key without effect left out
warned() {
    expect 0 "$FRAM" check "$1"
    grep '^warning' err | grep -v 'without effect' || true
}
# alike NAME WORDS: of ship.yaml with CURRENT in place of the word, the same is told of every current, the words too
alike() {
    local first="" now
    for current in "${currents[@]}"; do
        sed "s/CURRENT/$current/" "$1.yaml" >"now.yaml"
        now=$(warned now.yaml)
        grep -qF -- "$2" <<<"$now" || fail "not told \"$2\" of $current: $now"
        [[ -z $first ]] && first=$now
        same "$now" "$first" "what is told of $1 with $current"
    done
}
cat >step.yaml <<YAML
run: {duration: 20, time_step: 0.2}
domain: {boundary: feeding, x_min: -150, x_max: 150, y_min: -80, y_max: 80}
ice: {source: level, thickness: 0.5, breakable: true}
environment: {CURRENT}
vessel: {mode: prescribed, $hull}
YAML
alike step "move 0.2 m past each other in a step at 1 m/s"
sed -i 's/20, time_step: 0.2/60, time_step: 0.01/
    s/0.5, breakable: true/0.5, breakable: true, level: {x_min: 211}/' step.yaml
alike step "begins 61 m outside of the domain, and drifts 60 m towards 180 degrees in the run: there will be no ice"
sed -i 's/211/209/' step.yaml
for current in "${currents[@]}"; do
    sed "s/CURRENT/$current/" step.yaml >now.yaml
    warned now.yaml | grep 'no ice' && fail "a sheet that comes is told not to, with $current"
done
cat >basin.yaml <<YAML
run: {duration: 20, time_step: 0.05}
domain: {boundary: walls, x_min: -200, x_max: 200, y_min: -200, y_max: 200}
ice: {concentration: 0.3, mean_floe_area: 400}
environment: {CURRENT, hull_drag: {water_form: 1}}
vessel:
  mode: free
  $hull
  hydrodynamics: {source: estimate}
  mooring: {depth: 100, lines: [{count: 4, spacing_deg: 90, distance: 500}]}
YAML
alike basin "walls keep the ice in a basin, where the current of 1 m/s drives it"
cat >slow.yaml <<YAML
run: {duration: 20, time_step: 0.05}
domain: {boundary: feeding, x_min: -200, x_max: 200, y_min: -200, y_max: 200}
ice: {concentration: 0.5, mean_floe_area: 400}
environment: {CURRENT}
vessel:
  mode: free
  hull: {form: ship}
  hydrodynamics: {source: estimate}
  propulsion: {bollard_pull: 1.0e+6, speed: 0.05, open_water_speed: 8}
YAML
alike slow "it backs again and again"
# What rests in a file rests: nothing moves, and a ship so slow is stopped for good.
printf 'time [s],x [m/s],y [m/s]\n0,0,0\n' >rest.csv
currents=("current_speed: 0" "current_file: rest.csv" "current_profile_file: none.csv")
printf 'depth [m],x [m/s],y [m/s]\n0,0,0\n50,1,0\n' >none.csv
alike slow "it never counts as beset and waits"
# A drift of a file and a wind against it; a history that turns goes against nobody.
sed 's/CURRENT/wind_speed: 10, wind_direction_deg: 0/
    s/x_max: 200, y/drift_file: history.csv, x_max: 200, y/' slow.yaml >wind.yaml
told wind.yaml "the wind blows towards 0 degrees and the ice (domain.drift_direction_deg) goes towards 180, against it"
printf 'time [s],x [m/s],y [m/s]\n0,-1,0\n20,1,0\n' >history.csv
warned wind.yaml | grep 'against it' && fail "a drift that turns is told to go against the wind"

# Speeds that are usual at the scale of the keys are so in files.
printf 'time [s],x [m/s],y [m/s]\n0,5,0\n10,5,0\n' >five.csv
printf 'time [s],x [m/s],y [m/s]\n0,60,0\n10,60,0\n' >sixty.csv
printf 'depth [m],x [m/s],y [m/s]\n0,5,0\n' >deep.csv
cat >large.yaml <<'YAML'
run: {duration: 10, time_step: 0.05, scale: 200}
environment: {current_file: five.csv, wind_file: sixty.csv}
ice: {source: none}
vessel: {mode: towed}
YAML
at_scale() { grep -c 'goes up to' <(warned large.yaml) || true; }
same "$(at_scale)" 0 "speeds at a scale of 200"
sed -i 's/current_file: five/current_profile_file: deep/' large.yaml
same "$(at_scale)" 0 "speeds over depth at a scale of 200"
sed -i 's/scale: 200/scale: 45/' large.yaml
same "$(at_scale)" 1 "speeds at a scale of 45, where 4.9 m/s of current and 61 of wind are usual"
# A depth that is none is told at its line, and one too many at its own.
printf 'depth [m],x [m/s],y [m/s]\n-5,1,0\n10,1,0\n' >up.csv
{ echo 'depth,x,y'; for d in $(seq 0 16); do echo "$d,1,0"; done; } >many.csv
for words in "up.csv:2: depth[m]: expected a depth below the surface, 0 or more, found -5" \
    "many.csv:18: depth[m]: expected at most 16 depths, found 17"; do
    sed "s/current_profile_file: deep/current_profile_file: ${words%%.*}/" large.yaml >depth.yaml
    expect 2 "$FRAM" check depth.yaml
    says "$words" err
done
finish "currents of files are told as those of keys"

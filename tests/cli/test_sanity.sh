#!/usr/bin/env bash
# Thirty slips of a pen: each is told, or refused where nothing sensible can follow, with its key and the remedy.
. "$FRAM_SOURCE/tests/cli/slips.sh"

# refused KEY WORDS OPTIONS...: the key that is blamed, and words of the remedy
refused() {
    local key=$1 words=$2
    shift 2
    expect 2 "$FRAM" check ship.yaml --json "$@"
    same "$(value 'j["error"]["key"]')" "$key" "key of $*"
    says "$words" err
}

expect 0 "$FRAM" check ship.yaml
grep '^warning' err && fail "a warning without reason"
radii=""
for scene in "$FRAM_SOURCE"/scenes/*.yaml; do
    expect 0 "$FRAM" check "$scene"
    radii+=$(sed -n 's/^vessel icebreaker .* loops of its track have \(.*\) m$/ \1/p' err)
    # Its ship makes 3.7 m/s in steps for half of that, as its results were measured.
    [[ $scene == */drillship_circle.yaml ]] && sed -i '/^warning: vessel icebreaker and the ice move 0.05 m past/d' err
    # Scenes of ice management, as their results were made: the head of each tells that smaller pieces stay with others.
    grep -q "^#.* of a wedge" "$scene" && sed -i '/^warning: ice.smallest_floe_area: [48] m2 is .* of the pieces/d' err
    # Its drift, by a file, makes 0.4 m/s in steps for 0.3 of that.
    [[ $scene == */turret_turning.yaml ]] && sed -i '/^warning: ice.smallest_floe_area: 2 m2 is more/d
        /^warning: the vessel and the ice move 0.008 m past/d' err
    grep '^warning' err && fail "$scene warns"
done
# shellcheck disable=SC2086  # a list of numbers
says "$(printf '%.0f\n' $radii | sort -nru | xargs | sed 's/ /, /; s/ \([0-9]*\)$/ and \1/') m of radius" \
    "$FRAM_SOURCE/docs/limits.md"

# A number in another unit.
refused domain.band "expected less than half of the domain, 160 m, found 200 m" --set domain.band=200
bound_of() { sed -n "s/.*domain.band: expected a band from \([0-9.]*\) m.*, to less than 160 m.*/\1/p" err; }
expect 2 "$FRAM" check ship.yaml --build --set domain.band=1
expect 0 "$FRAM" check ship.yaml --build --set domain.band="$(bound_of)"
refused vessel.mass "thrown out of the water" --set vessel.mass=5000
refused vessel.mass "it sinks" --set vessel.mass=5e9
refused ice.concentration "from 0.01 to 1" --set ice.concentration=70
refused ice.density "ice floats" --set ice.density=1100
refused environment.water_density "" --set environment.water_density=0
told ship.yaml "ice.thickness: 80 m|give metres" --set ice.thickness=80
told ship.yaml "ice.thickness: 0.0008 m|give metres" --set ice.thickness=0.0008
told ship.yaml "ice.flexural_strength: 0.5 Pa|not kPa or MPa" --set ice.flexural_strength=0.5
told ship.yaml "ice.flexural_strength: 500 Pa|not kPa or MPa" --set ice.flexural_strength=500
told ship.yaml "ice.elastic_modulus: 5 Pa|not GPa" --set ice.elastic_modulus=5
told ship.yaml "ice.crushing_strength: 2 Pa|not kPa or MPa" --set ice.crushing_strength=2
told ship.yaml "ice.fracture.toughness: 150 Pa m^0.5|not kPa" --set ice.fracture.toughness=150
told ship.yaml "ice.fracture.latent_heat: 334 J/kg|not kJ/kg" --set ice.fracture.latent_heat=334
told ship.yaml "environment.wind_speed: 70 m/s|knot" --set environment.wind_speed=70
told ship.yaml "environment.current_speed: 40 m/s|cm/s" --set environment.current_speed=40
told ship.yaml "vessel.speed: 15 m/s|knot" --set vessel.speed=15
told ship.yaml "environment.gravity: 981|Earth" --set environment.gravity=981
told ship.yaml "environment.water_density: 1250 kg/m3|brine" --set environment.water_density=1250
refused "vessel.mooring.lines[0].pretension" "more than the weight of the line" \
    --set "vessel.mooring.lines[0].pretension=800"
told ship.yaml "vessel.mooring.lines[0].pretension: 1500 N|not kN" --set "vessel.mooring.lines[0].pretension=1500" \
    --set "vessel.mooring.lines[0].weight=10"
told ship.yaml "vessel.mooring.lines[0].breaking_load: 8000 N|not kN" --set "vessel.mooring.lines[0].breaking_load=8000"
told ship.yaml "vessel.thrusters[1].thrust: 200 N|not kN" --set "vessel.thrusters[1].thrust=200"
told ship.yaml "vessel.heading_deg: 1.5708 degrees is 0.5 of pi|not radians" --set vessel.heading_deg=1.5708
told ship.yaml "vessel.hull.length: 760 m|give metres" --set vessel.hull.length=760 --set domain.boundary=open

# Two that do not belong together.
told ship.yaml "run.time_step: 0.5 s is too long|heaves" --set run.time_step=0.5 --set ice.thickness=0.3
told ship.yaml "pretension: 7000 kN is more than half" --set "vessel.mooring.lines[0].pretension=7e6"
told ship.yaml "pretension: 9000 kN is over the breaking load" --set "vessel.mooring.lines[0].pretension=9e6"
told ship.yaml "length: 1100 m reaches down|does not pull until the vessel is 80 m farther" \
    --set "vessel.mooring.lines[0].length=1100"
# From a fairlead 6 m up it is 1026 m down and along the bottom, from one 6 m under water 1014 m.
expect 0 "$FRAM" check ship.yaml --set vessel.mooring.z=6 --set "vessel.mooring.lines[0].length=1024"
grep 'reaches down' err && fail "a line that pulls is told to hang slack"
told ship.yaml "length: 1024 m reaches down|until the vessel is 10 m farther" --set vessel.mooring.z=-6 \
    --set "vessel.mooring.lines[0].length=1024"
told ship.yaml "length: 890 m over a straight way of 907.96 m|over its breaking load" \
    --set "vessel.mooring.lines[0].length=890"
told ship.yaml "vessel.mooring.depth: the hull of draught 6.5 m lies on the bottom" --set vessel.mooring.depth=6
told ship.yaml "its edge with the band is 30 m from vessel, which reaches 39.17 m|9.17 m" --set domain.x_max=50 \
    --set domain.band=20
# A band that is not given is 1.5 radii of the mean floe wide at least; a ship on a turret turns about that.
told ship.yaml "its edge with the band is 24.99 m from vessel" --set domain.y_min=-35
told ship.yaml "its edge with the band is 59.99 m from vessel, which reaches 68.66 m" --set domain.x_max=100 \
    --set vessel.mooring.turret=true --set vessel.mooring.x=30
expect 0 "$FRAM" check ship.yaml --set domain.x_max=100 --set vessel.mooring.x=30
grep 'domain: its edge' err && fail "a ship that turns about amidships is told of the edge"
# A vessel that is led lies as it heads, a round one reaches its radius; with the metres that are told it has room.
sed 's/mode: free/mode: towed/; /mooring:/,/thrusters/d' ship.yaml >led.yaml
expect 0 "$FRAM" check led.yaml --set domain.y_min=-20 --set domain.band=10
grep 'domain: its edge' err && fail "a ship that never turns is told to reach as far as it is long"
# In a band that is given it is refused.
expect 2 "$FRAM" check led.yaml --set domain.x_max=50 --set domain.band=20
says "--set: domain.band: expected the vessel inside the band of 20 m whose floes go with the field, found 5.938 m" err
told led.yaml \
    "its edge with the band is 9.987 m from vessel, which reaches 38 m towards it|take domain.y_min -48.02 or less" \
    --set domain.y_min=-20 --set vessel.heading_deg=90
told led.yaml \
    "its edge with the band is 29.99 m from vessel, which reaches 39.07 m towards it|take domain.x_min -49.09 or less" \
    --set domain.x_min=-40 --set vessel.heading_deg=10
expect 0 "$FRAM" check led.yaml --set domain.x_min=-49.09 --set vessel.heading_deg=10
grep 'domain: its edge' err && fail "the metres that are told do not suffice"
# What lies outside of the domain is told of that alone, and the metres of what lies across its edge are not negative.
alone() {
    expect 0 "$FRAM" check led.yaml "${@:2}"
    same "$(grep -c 'domain' <(grep '^warning' err))" 1 "warnings of the domain with ${*:2}"
    says "$1" err
}
alone "(500, 0) m lies outside of the domain" --set vessel.x=500 --set vessel.speed=2
alone "(500, 0) m lies outside of the domain" --set vessel.x=500 --set vessel.speed=2 --set vessel.course_deg=180 \
    --set run.duration=3600
# Of a scenario whose hull is refused the error alone is told; where the ice cannot be made, a warning may tell why.
printf 'vessel: {hull: {length: 48, beam: 12, draught: 4}}\nice: {concentration: 0.04, mean_floe_area: 64}\n' >odd.yaml
printf 'domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40}\nrun: {duration: 0.1}\n' >>odd.yaml
expect 0 "$FRAM" run odd.yaml -o odd
says "next to open water" err
packed='[{size: power, diameter_min: 600, diameter_max: 900}]'
sed "s/mean_floe_area: 64/source: packed, populations: $packed/" odd.yaml >wide.yaml
for words in "run odd.yaml -o heavy --set vessel.mass=1e9" "check wide.yaml --build" \
    "check odd.yaml --set vessel.mass=1e9"; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" $words
    grep '^warning' err && fail "$words: warns of what is refused: $(cat err)"
done
expect 2 "$FRAM" run wide.yaml -o wide
says "floes of 900 m do not fit into a domain of 80 m" err
says "the largest floe drawn" err
told led.yaml \
    "its edge with the band is 35.01 m short of vessel, which reaches 38 m|take domain.x_min -168.1 or less" \
    --set vessel.x=-120 --set domain.x_min=-95
# Far from the origin the metres that are told have the digits that tell the reach.
told led.yaml "which reaches 38 m towards it|take domain.x_min 123407.9 or less and domain.x_max 123504.1 or more" \
    --set vessel.x=123456 --set domain.x_min=123420 --set domain.x_max=123490
round=(--set vessel.hull.form=cone --set vessel.hull.length=19 --set vessel.hull.flare_angle_deg=30)
told ship.yaml \
    "its edge with the band is 8.987 m from vessel, which reaches 9.5 m as it turns|take domain.x_min -19.52 or less" \
    --set domain.x_min=-19 "${round[@]}"
expect 0 "$FRAM" check ship.yaml --set domain.x_min=-19.52 "${round[@]}"
grep 'domain: its edge' err && fail "a round hull is told to reach beyond its radius"
told ship.yaml "the wind blows towards 0 degrees and the current goes towards 180|not where it comes from" \
    --set environment.wind_direction_deg=0
# Of ice that has its own drift, whatever tells the current.
printf 'time[s],x[m/s],y[m/s]\n0,0.3,0\n600,0.3,0.1\n' >flow.csv
told ship.yaml "the wind blows towards 0 degrees and the ice (domain.drift_direction_deg) goes towards 180" \
    --set environment.wind_direction_deg=0 --set domain.drift_speed=0.3 --set domain.drift_direction_deg=180 \
    --set environment.current_file=flow.csv
told ship.yaml "goes towards 0 degrees at 0.3 m/s and the current under it towards 180 at 0.4 m/s, against it" \
    --set domain.drift_speed=0.3
told ship.yaml "domain.drift_direction_deg: the ice goes towards 270|against it" \
    --set domain.drift_speed=0.3 --set domain.drift_direction_deg=270 --set environment.current_direction_deg=30
expect 0 "$FRAM" check ship.yaml --set domain.drift_speed=0.3 --set environment.wind_direction_deg=10
grep '^warning: domain.drift_direction_deg' err && fail "ice that a wind drives against the current is told"
told ship.yaml "ice.mean_floe_area: floes of 1.5 m2" --set ice.mean_floe_area=1.5
told ship.yaml "run.transient: statistics leave out 590 s" --set run.transient=590
told ship.yaml "output.frame_interval: 900 s" --set output.frame_interval=900
refused vessel.mooring.lines "vessel.mode is not free" --set vessel.mode=towed
told ship.yaml "more than the draught of the vessel" --set ice.thickness=5 --set vessel.hull.draught=4
told ship.yaml "vessel.hull.beam: the hull is wider" --set vessel.hull.form=box --set vessel.hull.beam=100
told ship.yaml "vessel.hull.draught: 20 m is more than the beam, 19 m" --set vessel.hull.form=box \
    --set vessel.hull.draught=20
# A pile stands deep.
expect 0 "$FRAM" check ship.yaml --set vessel.hull.form=cone --set vessel.hull.length=8 --set vessel.hull.beam=8 \
    --set vessel.hull.draught=30 --set vessel.hull.flare_angle_deg=0
grep 'more than the beam' err && fail "a pile is told to be deep"

# Nothing moves.
grep -v -e mooring -e depth -e lines -e count -e breaking -e thrusters ship.yaml >hull.yaml
expect 0 "$FRAM" check hull.yaml --set environment.wind_speed=0 --set environment.current_speed=0 \
    --set vessel.mode=towed
says "no load will come" err
expect 0 "$FRAM" check hull.yaml --set environment.wind_speed=0 --set environment.current_speed=0 \
    --set vessel.mode=towed --set vessel.speed=1
grep 'no load will come' err && fail "a towed vessel is told to rest"

# Walls hold the ice that a current drives, and where there is no water there is none.
told ship.yaml "domain.boundary: walls keep the ice in a basin|take feeding" --set domain.boundary=walls
told ship.yaml "where the current drives it against" --set domain.boundary=walls \
    --set environment.current_file=flow.csv --set environment.current_speed=0
expect 0 "$FRAM" check ship.yaml --set domain.boundary=walls --set environment.water=false
grep 'walls keep the ice' err && fail "a current is told that is without effect"

# One vessel of two that moves is enough, and so is one that drives itself.
cat >two.yaml <<'END'
run: {duration: 10, time_step: 0.005}
vessels:
  - {name: tug, mode: towed, x: -60, hull: {length: 40, beam: 10, draught: 4}}
  - {name: barge, mode: free, x: 40, hull: {form: box, length: 60, beam: 16, draught: 4}}
ice: {thickness: 0.5}
END
expect 0 "$FRAM" check two.yaml
says "vessels[0].speed: neither vessel nor ice" err
expect 0 "$FRAM" check two.yaml --set vessels.tug.speed=1
grep 'no load will come' err && fail "a vessel that another one comes to is told to rest"
expect 0 "$FRAM" check two.yaml --set vessels.barge.propulsion.bollard_pull=2e5
grep 'no load will come' err && fail "a ship that drives itself is told to rest"

# Stability, list and trim are those where the hull floats with its mass, for a box KB + BM = T / 2 + B^2 / 12 T.
barge=(--set vessels.barge.hull.draught=3 --set vessels.barge.hull.freeboard=2)
light=("${barge[@]}" --set vessels.barge.mass=1.5e6 --set vessels.barge.centre_of_gravity_z=6.5)
expect 0 "$FRAM" check two.yaml "${light[@]}"
grep 'capsizes' err && fail "a light barge is told to capsize at another draught"
told two.yaml "vessels[1].centre_of_gravity_y: the vessel heels by about 5 degrees" "${light[@]}" \
    --set vessels.barge.centre_of_gravity_y=0.5
told two.yaml "its transverse metacentric height is -0.5992 m where it floats" "${barge[@]}" \
    --set vessels.barge.mass=4.6e6 --set vessels.barge.centre_of_gravity_z=4.5

# Thrusters that hold the heading alone, and no mooring that holds the rest.
grep -v -e mooring -e depth -e lines -e count -e breaking ship.yaml >adrift.yaml
expect 0 "$FRAM" check adrift.yaml --set vessel.positioning.active=true --set vessel.positioning.control=heading
says "positioning.control: heading alone leaves the position to a mooring" err

# At another scale the bounds go along: a tank of 1:30 with ice of 23 mm, and the same numbers at full size.
told ship.yaml "offset_limit: 0.0008 m|is outside of 0.000834 to 500" --set run.scale=0.5 \
    --set vessel.station.offset_limit=0.0008
expect 0 "$FRAM" check ship.yaml --set run.scale=0.5 --set vessel.station.offset_limit=0.000834
grep offset_limit err && fail "the least limit that is told is told as too small"
expect 0 "$FRAM" check ship.yaml --set run.scale=1 --set ice.thickness=0.03 --set ice.flexural_strength=2e4 \
    --set ice.breakable=true
grep '^warning: ice' err && fail "ice of a tank is told"
told ship.yaml "ice.flexural_strength: 20000 Pa" --set ice.flexural_strength=2e4

# A ship that cuts a long channel is told what it costs to keep awake; not one that stops early, or whose ice sleeps.
cat >long.yaml <<'END'
run: {duration: 400, time_step: 0.02}
vessel: {mode: towed, x: -60, speed: 2, hull: {length: 60, beam: 14, draught: 5, freeboard: 3}}
ice: {source: level, thickness: 0.7, breakable: true, level: {x_min: 0}}
domain: {x_min: -100, x_max: 900, y_min: -60, y_max: 60, boundary: open}
END
note="channel: the vessel may go 800 m, and pieces behind it cost as much as those beside it while they are awake;"
note+=" ice.sleep_speed: 0.2 lets them sleep"
expect 0 "$FRAM" check long.yaml
grep -qF "$note" out err || fail "a long channel is not told of: $(cat out err)"
for set in run.duration=100 ice.sleep_speed=0.1 ice.breakable=false run.scale=100 domain.x_max=300; do
    expect 0 "$FRAM" check long.yaml --set $set
    grep -q 'channel: the vessel' out err && fail "a channel is told of with $set"
done
# One on station that ice drifts to cuts none.
sed -i -e 's/mode: towed/mode: free/' -e 's/speed: 2/speed: 0/' -e 's/open}/feeding, drift_speed: 2}/' long.yaml
expect 0 "$FRAM" check long.yaml
grep -q 'channel: the vessel' out err && fail "a ship that stays is told of a channel"
finish "each slip of the pen is told or refused, with its key and the remedy"

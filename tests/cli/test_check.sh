#!/usr/bin/env bash
# What `fram check` refuses and tells of a vessel before a run would meet it.
. "$FRAM_SOURCE/tests/cli/common.sh"

# A box of 40 x 10 x 4 m: 1 640 000 kg of water of 1025 kg/m3; B = 2 m under the water, BM = 10^2 / (12 * 4) = 2.0833 m.
cat >box.yaml <<'YAML'
run: {duration: 20, time_step: 0.05}
vessel:
  mode: free
  hull: {form: box, length: 40, beam: 10, draught: 4, freeboard: 2}
ice: {source: none}
domain: {x_min: -100, x_max: 100, y_min: -50, y_max: 50, boundary: open}
YAML
# refused KEY WORDS OPTIONS..., told WORDS OPTIONS..., silent OPTIONS...
refused() {
    local key=$1 words=$2
    shift 2
    expect 2 "$FRAM" check box.yaml --json "$@"
    same "$(value 'j["error"]["key"]')" "$key" "key of $*"
    says "$words" err
    expect 2 "$FRAM" run box.yaml -o refused -q "$@"
    [ ! -e refused ] || fail "a refused run left a folder: $*"
}
told() {
    local words=$1
    shift
    expect 0 "$FRAM" check box.yaml "$@"
    says "$words" err
    expect 0 "$FRAM" run box.yaml -o told --force --until 0.05 "$@"
    says "$words" err
}
silent() {
    expect 0 "$FRAM" check box.yaml "$@"
    grep -q '^warning' err && fail "a warning without reason: $* $(grep '^warning' err)"
    return 0
}
silent

# Mass: from a twentieth of what it displaces (82 t) to all that it encloses (40 x 10 x 6 m3, 2460 t).
refused vessel.mass "it sinks, found 2.47e+06 kg" --set vessel.mass=2.47e6
refused vessel.mass "8.2e+04 to 2.46e+06 kg" --set vessel.mass=8e4
told "vessel.mass is 0.8 of what the hull displaces" --set vessel.mass=1.312e6
silent --set vessel.mass=1.6e6
told "vessel.mass is 0.8 of what the hull displaces" --set vessel.mass=1.312e6 --set vessel.mode=towed
expect 0 "$FRAM" check box.yaml --set vessel.mass=1e9 --set vessel.mode=prescribed

# The centre of gravity: in the box around the hull, or above it by its depth; 20 m of length to each side.
refused vessel.centre_of_gravity_x "from -20 to 20 m, found 20.5 m" --set vessel.centre_of_gravity_x=20.5
refused vessel.centre_of_gravity_y "from -5 to 5 m, found -6 m" --set vessel.centre_of_gravity_y=-6
refused vessel.centre_of_gravity_z "found 8.1 m" --set vessel.centre_of_gravity_z=8.1
refused vessel.centre_of_gravity_z "found -4.1 m" --set vessel.centre_of_gravity_z=-4.1

# Gyration: the hull reaches sqrt(5^2 + 4^2) = 6.403 m from the roll axis; 1.5 of that is 9.6047 m, 0.02 of it 0.1281 m.
refused vessel.gyration_roll "0.1281 to 9.604 m" --set vessel.gyration_roll=9.7
refused vessel.gyration_roll "6.403 m from the axis, found 0.12 m" --set vessel.gyration_roll=0.12
# k_z^2 <= k_x^2 + k_y^2 of every body: 3.5 m and 10 m by default, 10.595 m.
refused vessel.gyration_yaw "expected 10.5948 m at most" --set vessel.gyration_yaw=10.6
# With a beam of 12 m 10.846197 m: what is told is taken.
told=$(sed -n 's/.*expected \(.*\) m at most.*/\1/p' <("$FRAM" check box.yaml --set vessel.hull.beam=12 \
    --set vessel.gyration_yaw=11 2>&1))
same "$told" 10.8461 "largest radius of gyration"
silent --set vessel.hull.beam=12 --set vessel.gyration_yaw="$told"

# GM = KB + BM - KG: the centre of mass at 0.0833 m over the water line is where it vanishes.
told "transverse metacentric height is -0.01667 m" --set vessel.centre_of_gravity_z=0.1
silent --set vessel.centre_of_gravity_z=0.05
# A list: tan = 0.05 / GM with GM = 0.5833 m is 4.9 degrees, which is not told; 0.1 m are 9.7.
silent --set vessel.centre_of_gravity_z=-0.5 --set vessel.centre_of_gravity_y=0.05
told "heels by about 10 degrees" --set vessel.centre_of_gravity_z=-0.5 --set vessel.centre_of_gravity_y=0.1

# Speeds that end the run at once.
refused vessel.speed "expected less than run.speed_limit" --set run.speed_limit=2 --set vessel.speed=2
refused environment.current_speed "found 3 m/s" --set run.speed_limit=3 --set environment.current_speed=3

# Floes without water between them: the check refuses what the run would.
refused ice.concentration "expected less than 1" --set ice.source=voronoi --set ice.concentration=1
expect 0 "$FRAM" check box.yaml --set ice.source=level --set ice.concentration=1

# Springs: heave at sqrt(rho g A / m) = sqrt(g / draught) = 1.566 rad/s: a step of 0.64 s is told, 0.63 s is not.
told "the buoyancy of the vessel is too stiff for the step: 1.566 rad/s with the vessel's mass; take \
run.time_step under \
0.319 s" --set run.time_step=0.64 --set output.csv_interval=0.64
silent --set run.time_step=0.63
cat >moored.yaml <<'YAML'
run: {duration: 2, time_step: 0.05}
vessel:
  mode: free
  hull: {form: box, length: 40, beam: 10, draught: 4, freeboard: 2}
  mooring:
    depth: 60
    lines:
      - {kind: spring, count: 2, spacing_deg: 180, distance: 400, pretension: 1.0e5, stiffness: 4.1e8}
ice: {source: none}
domain: {boundary: open}
YAML
# Two lines of 4.1e8 N/m in line on 1.64e6 kg: sqrt(500) = 22.36 rad/s.
expect 0 "$FRAM" check moored.yaml
says "vessel.mooring.lines is too stiff for the step: 22.36 rad/s" err
says "take run.time_step under 0.0224 s" err
expect 0 "$FRAM" check moored.yaml --set run.time_step=0.0223
grep -q 'too stiff' err && fail "the step that is said to work is told to be too long"
# With that step the box lies in a current within a millimetre; with one beyond 2 / 22.36 s it is thrown about.
current=(-q --set environment.current_speed=0.5 --set vessel.mooring.equilibrium=false --set run.duration=15)
offset() { python3 -c "import json; print(json.load(open('$1/station.json'))['offset_m']['peak'])"; }
expect 0 "$FRAM" run moored.yaml -o steady "${current[@]}" --set run.time_step=0.0223
expect 0 "$FRAM" run moored.yaml -o wild "${current[@]}" --set run.time_step=0.1
python3 -c "assert 10 * $(offset steady) < min(0.01, $(offset wild))" ||
    fail "offsets of $(offset steady) and $(offset wild) m"

# Lines pull down, here with 0.6 of 4 MN, 0.149 of 16.09 MN that the box displaces; it sinks by 2.4e6 N over 1025 * 9.81
# * 400 N/m. From x = 12 m it trims by the arc tangent of 12 * 2.4e6 N m over 16.09e6 N times GM, 40^2 / (12 * 4) - 2 m.
pulled() {
    local words=$1
    shift
    expect 0 "$FRAM" check moored.yaml "${steep[@]}" "$@"
    same "$(grep '^warning' err)" "${words:+warning: $words}" "what is told of lines that pull down: $*"
}
steep=(--set "vessel.mooring.lines[0].distance=80" --set "vessel.mooring.lines[0].pretension=2e6"
    --set "vessel.mooring.lines[0].stiffness=1e5")
down="vessel.mooring.lines: they pull the vessel down with 2400 kN, 0.149 of what it displaces: it begins by"
for begun in true false; do
    pulled "$down sinking by up to about 0.6 m; with vessel.mass 1.39535e+06 kg it begins at rest" \
        --set vessel.mooring.equilibrium=$begun
done
pulled "" --set vessel.mass=1.39535e6
pulled "$down sinking by up to about 0.6 m, trimming by up to about 3.3 degrees; with vessel.mass 1.39535e+06 kg, \
centre_of_gravity_x -2.104 m it begins at rest" --set vessel.mooring.x=12
pulled "" --set vessel.mooring.x=12 --set vessel.mass=1.39535e6 --set vessel.centre_of_gravity_x=-2.104
# So it does on both axes, with a centre of gravity that lies far from where the hull floats.
pulled "" --set vessel.mooring.x=12 --set vessel.mooring.y=2 --set vessel.centre_of_gravity_z=-0.5 \
    --set vessel.mass=1.39535e6 --set vessel.centre_of_gravity_x=-2.104 --set vessel.centre_of_gravity_y=-0.3507
# A fifth of that heels it where GM is 0.5833 m; lines that are let go pull on nothing.
heel=(--set vessel.mooring.y=2 --set "vessel.mooring.lines[0].pretension=4e5" --set vessel.centre_of_gravity_z=-0.5)
pulled "vessel.mooring.lines: they pull the vessel down with 480 kN, 0.0298 of what it displaces: it begins by \
heeling by up to about 5.8 degrees; with vessel.mass 1.59107e+06 kg, centre_of_gravity_y -0.06151 m it begins at rest" \
    "${heel[@]}"
pulled "" "${heel[@]}" --set "vessel.mooring.lines[0].release_time=0"
# A line that parts in the first step pulls on nothing either.
for load in "3.9e5 over" "4.1e5 more than half of"; do
    most="vessel.mooring.lines[0].breaking_load=${load%% *}"
    expect 0 "$FRAM" check moored.yaml "${steep[@]}" "${heel[@]}" --set "$most"
    says "N is ${load#* } the breaking load" err
    pulls="$(grep -c "pull the vessel down" err || true)"
    same "$pulls" "$([[ $load = *of ]] && echo 1 || echo 0)" "what is told of pulls at $most"
done
# GM is 0.1833 m; from 2 m over the waterline 2.45 MN, which make it sink by 0.61 m, take (2 - 0.305) * 2.45 / 16.09 m
# of that. From 1.5 m they leave 2 mm, and nothing of a vessel that is lighter by them, for its weight lies low.
low=(--set vessel.centre_of_gravity_z=-0.1)
pulled "vessel.mooring.lines: the vessel capsizes unless their stiffness holds it: they pull it down with 2450 kN, \
which takes its transverse metacentric height from 0.1833 m to -0.07488 m; lower vessel.mooring.z, 2 m, by more than \
0.492 m, or let the lines pull less" "${low[@]}" --set vessel.mooring.z=2
pulled "${down/2400 kN, 0.149/2438 kN, 0.152} sinking by up to about 0.61 m; it needs lines that pull less" \
    "${low[@]}" --set vessel.mooring.z=1.5
# The mass that lines balance is not told as wrong, and the one that they do not is.
pulled "vessel.mass is 0.6 of what the hull displaces at its draught: it begins by moving up or down to its own \
waterline" --set vessel.mass=9.84e5
# Of two vessels the moored one.
sed -e 's/^  /    /; s/^vessel:/vessels:\n  - {name: a, x: -60, mode: free, hull: HULL}\n  - name: b/' \
    -e 's/HULL/{form: box, length: 40, beam: 10, draught: 4}/' moored.yaml >pair.yaml
expect 0 "$FRAM" check pair.yaml "${steep[@]//vessel.mooring/vessels.b.mooring}"
same "$(grep '^warning' err)" "warning: ${down/vessel/vessels[1]} sinking by up to about 0.6 m; with vessels[1].mass \
1.39535e+06 kg it begins at rest" "what is told of two vessels"

# A fairlead under the bottom; damping that drives.
expect 2 "$FRAM" check moored.yaml --json --set vessel.mooring.z=-61
same "$(value 'j["error"]["key"]')" vessel.mooring.z "key of a fairlead under the bottom"
sed 's/^  mooring:/  hydrodynamics: {source: given, added_mass: [MATRIX], damping: [MATRIX]}\n&/' moored.yaml |
    sed 's/added_mass: \[MATRIX\]/added_mass: [{surge: 1e5}, {sway: 1e5}, {heave: 1e5}, {}, {}, {}]/' |
    sed 's/damping: \[MATRIX\]/damping: [{surge: -1e5}, {sway: 1e5}, {heave: 1e5}, {}, {}, {}]/' >driven.yaml
expect 0 "$FRAM" check driven.yaml
says "damping is negative in surge, -1e+05" err
grep -q 'negative in sway' err && fail "sway is told to be driven"

# A bow that reaches the wall: 100 - 20 m at 5 m/s.
basin=(--set domain.boundary=walls --set vessel.mode=towed --set vessel.speed=5)
told "the hull reaches a wall of the domain at t = 16 s, after 80 m" "${basin[@]}"
told "the hull reaches a wall of the domain at t = 18 s, after 80 m" "${basin[@]}" --set vessel.ramp=4
silent "${basin[@]}" --set run.duration=15.9
# Athwart, the beam counts: 50 - 5 m.
told "at t = 9 s, after 45 m" "${basin[@]}" --set vessel.course_deg=-90
# One that begins in the wall is refused without --build too.
expect 2 "$FRAM" check box.yaml "${basin[@]}" --set vessel.x=85 --json
same "$(value 'j["error"]["key"]')" vessel.x "key of a hull inside a wall"

# How long and how large: a trial of the first steps, and within a factor of two what the run then leaves.
expect 0 "$FRAM" check box.yaml --build --json --set output.csv_interval=0.1
python3 - "$(value 'j["run_wall_s"]')" <<'END' || fail "no time is told"
import sys
sys.exit(not 0 < float(sys.argv[1]) < 600)
END
says "time: judged by its first steps a run takes" err
promised() { sed -n 's/^disk: about \([0-9.e+]*\) MB.*/\1/p' err; }
pictures=no
! built_with cairo || pictures=yes
# sized MEGABYTES OPTIONS...
sized() {
    local promised=$1
    shift
    expect 0 "$FRAM" run box.yaml -o sized --force -q --set output.csv_interval=0.1 "$@"
    python3 - "$promised" "$(du -sb sized | cut -f1)" "$pictures" <<'END' ||
import sys
promised, found = float(sys.argv[1]) * 1e6, float(sys.argv[2])
# Without pictures a build leaves less.
sys.exit(not (found / 2 if sys.argv[3] == "yes" else 0) < promised < found * (2 if sys.argv[3] == "yes" else 4))
END
        fail "the folder has another size than $promised MB: $*"
}
sized "$(promised)"
# Floes of a file are not counted before it is read, but rows and pictures are those of a run in ice.
python3 - >blocks.wkt <<'END'
for x in range(-90, 90, 15):
    for y in (-45, -25, 25, 45):
        print(f"POLYGON (({x} {y - 4}, {x + 10} {y - 4}, {x + 10} {y + 4}, {x} {y + 4}, {x} {y - 4}))")
END
file=(--set ice.source=file --set ice.file=blocks.wkt --set vessel.speed=4 --set vessel.y=20)
expect 0 "$FRAM" check box.yaml "${file[@]}" --set output.csv_interval=0.1
says "for what the run leaves beside the floes of its file, which are not counted" err
unread=$(promised)
sized "$unread" "${file[@]}"
expect 0 "$FRAM" check box.yaml --set ice.source=voronoi --set ice.mean_floe_area=20000 --set output.csv_interval=0.1
says "for about 1 floe" err
python3 -c "import sys; a, b = map(float, sys.argv[1:]); sys.exit(abs(a - b) > 0.03)" "$unread" "$(promised)" ||
    fail "with ice of a file $unread MB are told, with one floe $(promised) MB"

printf 'run: {duration: 1}\nice: {mean_floe_area: 400}\n' >field.yaml
expect 0 "$FRAM" check field.yaml --set ice.breakable=true
says "for what the run leaves, more where ice breaks" err
expect 0 "$FRAM" check field.yaml --set ice.breakable=false
grep 'more where ice breaks' err && fail "ice that cannot break is told to"

# Listed floes that lie in one another or in a wall; openings beside a sheet, and ones that leave nothing of it.
cat >floes.yaml <<'YAML'
run: {duration: 1, time_step: 0.05}
vessel: {present: false}
ice:
  source: floes
  floes: [{x: -20, length: 10, width: 10}, {x: -18, length: 10, width: 10}, {x: 95, length: 20, width: 4}]
domain: {x_min: -100, x_max: 100, y_min: -60, y_max: 60, boundary: walls}
YAML
expect 0 "$FRAM" run floes.yaml -o floes
says "1 pairs of floes overlap at the start, as ice.floes[0] and ice.floes[1], by 80 m2" err
says "ice.floes[2] reaches into a wall of the domain" err
grep -q "concentration" err && fail "a concentration of floes that are listed: $(cat err)"
expect 0 "$FRAM" run floes.yaml -o floes --force --set "ice.floes[1].x=-9.99" --set "ice.floes[2].x=90"
grep '^warning: .*floes' err && fail "a warning without reason"
cat >sheet.yaml <<'YAML'
run: {duration: 1, time_step: 0.05}
vessel: {present: false}
ice: {source: level, level: {x_min: -30, openings: [{x: 35, length: 30, width: 30}, {x: -80, length: 30, width: 30}]}}
domain: {x_min: -100, x_max: 100, y_min: -60, y_max: 60}
YAML
expect 0 "$FRAM" run sheet.yaml -o sheet
says "ice.level.openings[1]: it lies beside the ice and opens nothing" err
grep -qF "openings[0]" err && fail "an opening that opens is told"
expect 2 "$FRAM" run sheet.yaml -o none --set "ice.level.openings[0].length=300" --set "ice.level.openings[0].width=300"
says "sheet.yaml:3:" err
says "nothing is left of the sheet of 130 m by 120 m" err

# What ice does and what is warned of it goes by the ice that there is: populations have their own, and their own size.
cat >thin.yaml <<'END'
run: {duration: 10, time_step: 0.02}
vessel: {mode: towed, speed: 1, hull: {length: 40, beam: 10, draught: 4}}
ice: {source: voronoi, concentration: 0.6, populations: [{size: constant, diameter: 8, thickness: 0.15}]}
domain: {x_min: -100, x_max: 100, y_min: -100, y_max: 100}
END
expect 0 "$FRAM" check thin.yaml
says "ice: 0.15 m thick, 0.1346 m of it under water" err
says "a vertical face loads 300 kN per metre" err
says "move 0.13 of its thickness past each other in a step" err
grep -e 'cells of' -e '1 m thick' err && fail "told of ice that there is not"
sed 's/voronoi/packed/; s/thickness: 0.15}/thickness: 0.5}, {size: constant, diameter: 9, thickness: 5}/' \
    thin.yaml >two.yaml
expect 0 "$FRAM" check two.yaml
says "ice: 0.5 m thick, 0.4488 m of it" err
says "ice: 5 m thick, 4.488 m of it" err
says "ice.populations[].thickness: 5 m is more than the draught" err
expect 0 "$FRAM" check thin.yaml --set ice.thickness=9
grep 'more than the draught' err && fail "told of a thickness that no floe has"
# Of equally thick populations the strongest and the weakest are told, and the step is short for the one that breaks
# first, whichever stands first; one that does not break asks for no short step.
cat >strengths.yaml <<'END'
run: {duration: 2, time_step: 0.01}
vessel: {mode: prescribed, x: -15, speed: 2, hull: {form: box, length: 20, beam: 8, draught: 3, freeboard: 2}}
domain: {x_min: -30, x_max: 30, y_min: -20, y_max: 20}
ice:
  source: packed
  breakable: true
  populations:
    - {size: constant, diameter: 9, crushing_strength: 5e5}
    - {size: constant, diameter: 5, crushing_strength: 4e6, flexural_strength: 2e5}
END
sed '/diameter: 9/{h;d}; /diameter: 5/G' strengths.yaml >swapped.yaml
for order in strengths swapped; do
    expect 0 "$FRAM" check $order.yaml
    says "a vertical face loads 500 kN per metre" err
    says "a vertical face loads 4000 kN per metre" err
    says "take run.time_step under 0.00315 s" err
    says "crushing strength 4000 kPa, flexural strength 200 kPa, breaks" err
    says "fracture: of ice 1 m thick (bending 200 kPa, crushing 4000 kPa), on 1 m2 the radial crack" err
    says "fracture: in ice 1 m thick (bending 200 kPa, crushing 4000 kPa) steps of 0.01 s are short" err
    says "and ice 1 m thick (bending 200 kPa, crushing 4000 kPa), as wide as it is thick breaks after" err
done
# Lines of the loads are of what may break, of the thickest too; where all ice is alike they name none.
expect 0 "$FRAM" check strengths.yaml --set "ice.populations[0].thickness=2"
says "fracture: of ice 1 m thick (bending 200 kPa, crushing 4000 kPa), on 1 m2 the radial crack" err
says "fracture: of ice 2 m thick (bending 500 kPa, crushing 500 kPa), on 4 m2 the radial crack" err
grep 'fracture: on' err && fail "a load that is told of no ice, and there are two"
expect 0 "$FRAM" check strengths.yaml --set "ice.populations[1].breakable=false"
grep -e 'take run.time_step' -e 'fracture: .*bending 200' err && fail "told of ice that does not break as if it did"
expect 0 "$FRAM" check strengths.yaml --set "ice.populations[0].breakable=false" \
    --set "ice.populations[1].breakable=false" --set run.time_step=0.1 --set ice.smallest_floe_area=30
says "ice: nothing breaks or splits (ice.populations[].breakable: false)" err
says "move 0.2 of its thickness past each other in a step at 2 m/s; crushing" err
grep -e 'take run.time_step' -e fracture: -e wedge err && fail "told of ice none of which breaks as if it did"
expect 0 "$FRAM" check strengths.yaml --set "ice.populations[0].breakable=false" \
    --set "ice.populations[1].breakable=false" --set ice.smallest_floe_area=1e-6
says "ice.smallest_floe_area: without effect, since packed floes are made as drawn, and none may break" err
grep specks err && fail "told of specks of ice that does not break"
expect 0 "$FRAM" check thin.yaml --set ice.breakable=true
says "fracture: on 0.0225 m2 the radial crack" err
# Floes of a file have the thicknesses that it gives, which are known where they are made.
python3 - <<'PY'
import json
square = lambda x, h: {"type": "Feature", "properties": {"thickness": h}, "geometry": {
    "type": "Polygon", "coordinates": [[[x, 20], [x + 10, 20], [x + 10, 30], [x, 30], [x, 20]]]}}
json.dump({"type": "FeatureCollection", "features": [square(0, 0.05), square(20, 5)]}, open("floes.geojson", "w"))
PY
sed 's/^ice:.*/ice: {source: file, file: floes.geojson}/; s/duration: 10/duration: 0.04/' thin.yaml >filed.yaml
expect 0 "$FRAM" check filed.yaml
says "ice: thicknesses that its file gives to floes go before that" err
expect 0 "$FRAM" check filed.yaml --build
says "ice: 0.05 m thick, 0.04488 m of it" err
says "ice: 5 m thick, 4.488 m of it" err
says "move 0.4 of its thickness past each other in a step" err
says "ice.file: 5 m is more than the draught" err
grep -e '1 m thick' -e 'go before' err && fail "told of ice that there is not"
expect 0 "$FRAM" run filed.yaml -o filed
says "move 0.4 of its thickness past each other in a step" err
# An endless field may begin with none of its floes in the domain.
sed 's/^domain:.*/domain: {x_min: -42, x_max: 42, y_min: -18, y_max: 18, tile_x: 300, tile_y: 300, boundary: feeding}/
    s/floes.geojson/&, file_y: 100/' filed.yaml >fed.yaml
expect 0 "$FRAM" check fed.yaml --build
says "built: 0 floes" err
says "ice: 0.05 m thick, 0.04488 m of it" err
says "ice.file: 5 m is more than the draught" err
expect 0 "$FRAM" run fed.yaml -o fed
says "move 0.4 of its thickness past each other in a step" err

# A tank and its twin sixteen times as large: with an exponent the step is as short for the one as for the other.
cat >tank.yaml <<'YAML'
run: {duration: 2, time_step: 0.002, scale: 1}
vessel: {mode: towed, x: -1.5, speed: 0.4, hull: {length: 3, beam: 0.7, draught: 0.25, freeboard: 0.15}}
ice: {thickness: 0.03, elastic_modulus: 5.0e+7, flexural_strength: 2.5e+4, crushing_strength: 2.0e+4,
      crushing_exponent: -0.5, breakable: true, mean_floe_area: 0.2}
domain: {x_min: -4, x_max: 5, y_min: -2, y_max: 2}
YAML
sed 's/0.002, scale: 1/0.008, scale: 16/; s/-1.5, speed: 0.4/-24, speed: 1.6/; s/: 3,/: 48,/; s/: 0.7,/: 11.2,/
    s/: 0.25,/: 4,/; s/: 0.15}/: 2.4}/; s/: 0.03,/: 0.48,/; s/: 5.0e+7/: 8.0e+8/; s/: 2.5e+4/: 4.0e+5/
    s/: 2.0e+4/: 5.12e+6/; s/area: 0.2/area: 51.2/; s/-4, x_max: 5/-64, x_max: 80/; s/-2, y_max: 2/-32, y_max: 32/' \
    tank.yaml >ship.yaml
expect 0 "$FRAM" check tank.yaml
says "a vertical face 1 m wide loads 3464 N" err
grep 'per metre of width' err && fail "the load of 1 m of a face is told of each metre of a wider one"
short_up_to() {
    expect 0 "$FRAM" check "$@"
    sed -n 's/.*steps of .* s are short for the vessel up to \([0-9.e+-]*\) m.*/\1/p' err
}
for exponent in -0.5 0; do
    # Without an exponent a strength goes with lambda alone.
    strength=$([ $exponent = 0 ] && echo 3.2e5 || echo 5.12e6)
    small=$(short_up_to tank.yaml --set ice.crushing_exponent=$exponent)
    large=$(short_up_to ship.yaml --set ice.crushing_exponent=$exponent --set ice.crushing_strength="$strength")
    python3 -c "assert abs($large / $small / 4 - 1) < 0.02" || fail "steps are short up to $small and $large m/s"
done
same "$(short_up_to tank.yaml --set ice.crushing_exponent=-1)" "" "a load that does not grow breaks ice after no way"

# A ship that cannot steer turns on no radius, and no pattern is held against one.
cat >helm.yaml <<'YAML'
run: {duration: 60, time_step: 0.05}
vessel:
  mode: free
  speed: 3
  hull: {length: 60, beam: 14, draught: 5}
  hydrodynamics: {source: estimate}
  propulsion: {bollard_pull: 6e5, open_water_speed: 7, speed: 3, pattern: {kind: circle, distance: 300, width: 300}}
ice: {source: none}
domain: {x_min: -500, x_max: 1500, y_min: -600, y_max: 600, boundary: open}
YAML
expect 0 "$FRAM" check helm.yaml
says "the vessel turns on a radius of" err
grep -e 'steering_angle_deg' -e 'by its helm' err && fail "a ship that steers is told that it does not"
expect 0 "$FRAM" check helm.yaml --set vessel.propulsion.steering_angle_deg=0
says "the vessel does not turn by its helm at 3 m/s; corners and loops of its track are taken as 60 m" err
says "vessel.propulsion.steering_angle_deg: 0 steers no ship: it does not keep its pattern" err
grep -e 'on a radius' -e 'pattern.width' err && fail "a radius of a ship that does not steer is told"
expect 0 "$FRAM" check helm.yaml --set vessel.propulsion.steering_angle_deg=0 --set vessel.propulsion.pattern.kind=none
grep 'steers no ship' err && fail "a ship without a track is told that it does not keep it"
# A hull too broad for its rudders turns on by itself: no radius of it is told that was but the least one tried, and
# corners that its helm cannot stop are.
broad="--set vessel.hull.form=icebreaker --set vessel.hull.beam=19 --set vessel.hull.draught=7"
# shellcheck disable=SC2086
expect 0 "$FRAM" check helm.yaml $broad
holds "no steady turn of the vessel was found .* at 3 m/s down to a radius of 20 m: this hull turns on by itself" err
holds "pattern.width: 300 m asks for a radius of 150 m; under .* m the hull of the vessel turns on by itself" err
grep -e 'the vessel turns on a radius' -e 'does not stop a turn' err && fail "a radius that is none is told"
# shellcheck disable=SC2086
expect 0 "$FRAM" check helm.yaml $broad --set vessel.propulsion.pattern.width=30
holds "asks for a radius of 15 m, and no steady turn .* down to a radius of 20 m: it cannot keep this pattern" err
turns() {
    sed "s/pattern: {kind: circle,/$1/" helm.yaml >course.yaml
    shift
    # shellcheck disable=SC2086
    expect 0 "$FRAM" check course.yaml $broad --set vessel.propulsion.rudder_area=1 "$@"
}
for course in "pattern: {kind: line," "waypoints: [{x: 300, y: 0}, {x: 900, y: 0}, {x: 1200, y: 200}], pattern: {"; do
    turns "$course"
    holds "propulsion.rudder_area: the helm of the vessel does not stop a turn at 3 m/s with a radius under .* m" err
done
for course in "pattern: {kind: ahead," "waypoints: [{x: 300, y: 0}, {x: 900, y: 0}, {x: 1200, y: 0}], pattern: {"; do
    turns "$course"
    grep 'does not stop a turn' err && fail "corners are told of $course"
done
turns "pattern: {kind: line," --set vessel.propulsion.turning_radius=9e3
grep 'does not stop a turn' err && fail "a radius that was given is told to be given"
# shellcheck disable=SC2086
expect 0 "$FRAM" check helm.yaml $broad --set vessel.propulsion.rudder_area=0
holds "of 150 m; under .* m the hull of the vessel turns on by itself, .* or a larger steering_angle_deg" err
# A circle wider than any corner, ten lengths, and narrower than what its helm stops; the width that is advised is not.
# shellcheck disable=SC2086
expect 0 "$FRAM" check helm.yaml $broad --set vessel.propulsion.rudder_area=1 --set vessel.propulsion.pattern.width=1210
holds "of 605 m; under .* m the hull of the vessel turns on by itself, .* or a larger rudder_area" err
wide=$(sed -n 's/.*radius of 605 m.* take \([0-9.]*\) m or more.*/\1/p' err)
# shellcheck disable=SC2086
expect 0 "$FRAM" check helm.yaml $broad --set vessel.propulsion.rudder_area=1 \
    --set vessel.propulsion.pattern.width="${wide:-0}"
grep -e 'pattern.width' -e 'does not stop a turn' err && fail "a width of $wide m is told as the least, and too small"
# Edges of a fed domain that are too near to a vessel are told by their keys, with values that are far enough.
cat >near.yaml <<'END'
run: {duration: 5}
vessel: {mode: towed, speed: 1, y: 3, hull: {form: box, length: 40, beam: 10, draught: 4, freeboard: 2}}
ice: {source: voronoi, concentration: 0.7, mean_floe_area: 9000, thickness: 0.5}
domain: {x_min: -70, x_max: 130, y_min: -50, y_max: 50, boundary: feeding, drift_speed: 0.5}
END
expect 0 "$FRAM" check near.yaml
near=$(grep -o 'its edge with the band is .*; take domain.*' err)
bounds=$(grep -oE 'domain\.[xy]_m[a-z]+ -?[0-9.e+]+' <<<"$near" | sed 's/ /=/')
same "$(cut -d= -f1 <<<"$bounds" | tr '\n' ' ')" "domain.x_min domain.y_min domain.y_max " "edges that are too near"
for bound in $bounds; do set -- "$@" --set "$bound"; done
expect 0 "$FRAM" check near.yaml "$@"
grep "its edge with the band" err && fail "edges that were told are too near: $bounds"

finish "what cannot be is refused, what will be is told"

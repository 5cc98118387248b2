#!/usr/bin/env bash
# fram hull as a user meets it: files and particulars in, report, JSON, drawing and files out, errors with their place.
. "$FRAM_SOURCE/tests/cli/common.sh"
# near EXPRESSIONS NUMBERS NAME: numbers of j, to rounding.
near() { same "$(value "max(abs(a - b) for a, b in zip(($1), ($2))) < 1e-11 * max(map(abs, ($2)))")" True "$3"; }

# A box from particulars, by hand: 40 x 10 x (3 + 2) m.
expect 0 "$FRAM" hull --box --length 40 --beam 10 --draught 3 --freeboard 2 --json -o box.stl
same "$(wc -l <out)" 1 "lines of JSON"
near 'j["volume_m3"], j["enclosed_volume_m3"], j["displacement_t"]' "1200, 2000, 1230" "volumes of the box"
near 'j["centre_of_buoyancy_m"]' "0, 0, -1.5" "centre of buoyancy"
near 'j["waterplane_area_m2"], j["draught_m"], j["kb_m"]' "400, 3, 1.5" "water plane"
same "$(value 'abs(j["gm_transverse_m"] - (1.5 + 1000 / 360 - 3)) < 1e-12')" True "GM"
same "$(value 'j["convex_pieces"]["count"], j["closed"]')" "1 True" "pieces"

# The file that it wrote, at another draught, and by mass.
expect 0 "$FRAM" hull box.stl --draught 2.5 --json
same "$(value 'j["format"]')" "STL (binary)" "format"
near 'j["volume_m3"], j["level_m"]' "1000, -0.5" "the box at 2.5 m"
expect 0 "$FRAM" hull box.stl --mass 1025e3 --kg 1 --json
same "$(value 'abs(j["level_m"] + 0.5) < 1e-12, abs(j["heel_deg"]) < 1e-9, j["kg_m"], j["stable"]')" \
    "True True 1 True" "the box of 1025 t"
expect 0 "$FRAM" hull box.stl --mass 1025e3 --kg 1 --tcg 5e-11
says "heel 0 deg, trim 0 deg" out
expect 0 "$FRAM" hull box.stl --water-density 1.025 --lcg 21 --kg 9.9
says "warning: --water-density: 1.025 kg/m3 is outside of 980 to 1100" err
says "warning: --lcg: the centre of gravity is at x = 21 m, outside of the hull, -20 to 20 m" err
same "$(grep -c warning err)" 2 "warnings of water and centre"
expect 2 "$FRAM" hull box.stl --lcg 1e300
says "centre: expected coordinates within 1e9 m" err
expect 0 "$FRAM" hull box.stl --freeboard 3
says "warning: --freeboard: no level open top: without effect" err
expect 0 "$FRAM" hull box.stl
says "displaced volume" out
says "closed, 12 triangles, 8 vertices" out
says "C35 0 N" out
# What rounding leaves is told as 0: of a level, of the middle of two hulls, of a coupling.
expect 0 "$FRAM" hull box.stl --mass 1230e3
says "Floating at z = 0 m" out
for y in -20 10; do
    z=$((y + 10))
    printf 'v %s %s %s\n' -20 $y -3 20 $y -3 20 $z -3 -20 $z -3 -20 $y 2 20 $y 2 20 $z 2 -20 $z 2
done >two.obj
for i in 0 8; do
    for face in "4 3 2 1" "5 6 7 8" "1 2 6 5" "2 3 7 6" "3 4 8 7" "4 1 5 8"; do
        echo "f $(for v in $face; do echo -n "$((v + i)) "; done)"
    done
done >>two.obj
expect 0 "$FRAM" hull two.obj --pieces 1
! grep -q -e '-0\.0000 ' out || fail "rounding is told: $(cat out)"
says "convex pieces: 2," out
"$FRAM" hull --help | grep -q "each closed part has one at least" || fail "the help on pieces"
! grep -q warning err || fail "a box of 40 m is warned of: $(cat err)"

# Off its centre it lies down by the bow and to port, and the report tells the numbers of the JSON, each in its place.
off=(box.stl --mass 1025e3 --kg 1 --lcg 0.5 --tcg 0.1)
expect 0 "$FRAM" hull "${off[@]}"
cp out report
expect 0 "$FRAM" hull "${off[@]}" --json
python3 - <<'END' || fail "the report of a box off its centre"
import json, math, re
j = json.load(open("out"))
words = """level heel_deg trim_deg | volume displacement_t | enclosed_volume | draught draught_fore draught_aft |
length_waterline breadth_waterline | length_overall breadth_overall depth | centre_of_buoyancy kb |
centre_of_flotation | centre_of_mass kg | waterplane_area wetted_area | second_moment_transverse
second_moment_longitudinal | bm_transverse gm_transverse | bm_longitudinal gm_longitudinal | c33 c35 | c44 c55 |
block_coefficient waterplane_coefficient midship_coefficient prismatic_coefficient"""
lines = open("report").read().split("\nFloating ")[1].splitlines()
for names, line in zip(words.split("|"), lines):
    told = [float(x) for x in re.findall(r"(?<![a-zA-Z0-9.])-?[0-9][0-9.]*(?:e[+-][0-9]+)?", line)]
    wanted = [j[next(k for k in j if re.fullmatch(f"{name}(_m[234]?|_N.*)?", k))] for name in names.split()]
    wanted = [x for value in wanted for x in (value if isinstance(value, list) else [value])]
    if "centre_of_flotation" in names:
        del wanted[2]  # it lies in the waterline
    assert len(told) == len(wanted), (line, told, wanted)
    assert all(abs(a - b) < 1e-4 * max(1, abs(b)) for a, b in zip(told, wanted)), (line, told, wanted)
assert abs(j["draught_fore_m"] - j["draught_aft_m"] - 40 * math.tan(math.radians(j["trim_deg"]))) < 1e-3
assert j["trim_deg"] > 0.5 and j["heel_deg"] < -1, j
END

# A ship of kilometres is one in millimetres; a model of a basin is small, and right.
sed 's/^v \(.*\) \(.*\) \(.*\)/v \1e3 \2e3 \3e3/' >long.obj <<'END'
v -20 -5 -3
v 20 -5 -3
v 20 5 -3
v -20 5 -3
v -20 -5 2
v 20 -5 2
v 20 5 2
v -20 5 2
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
END
expect 0 "$FRAM" hull long.obj
says "warning: the waterline is 4e+04 m long: a file in millimetres wants --scale 0.001" err
says "in centimetres 0.01, in inches 0.0254, in feet 0.3048" err
expect 0 "$FRAM" hull long.obj --scale 0.001
! grep -q warning err || fail "a file in millimetres is warned of: $(cat err)"
expect 0 "$FRAM" hull long.obj --scale 0.00001
! grep -q warning err || fail "a model is warned of: $(cat err)"

# Files of programs with other axes: y forward, and y up.
expect 0 "$FRAM" hull --length 60 --beam 16 --draught 5 --freeboard 3 -o axes.obj --quiet
expect 0 "$FRAM" hull axes.obj
! grep -q warning err || fail "a ship is warned of: $(cat err)"
awk '$1 == "v" { print "v", -$3, $2, $4; next } { print }' axes.obj >y_forward.obj
expect 0 "$FRAM" hull y_forward.obj
says "warning: the hull is 60 m wide along y and 16 m long along x: x is to be forward: turn the mesh" err
awk '$1 == "v" { print "v", $2, $4, -$3; next } { print }' axes.obj >y_up.obj
expect 0 "$FRAM" hull y_up.obj
says "warning: the two sides of the hull lie about z = 0, not about y = 0: z is to be up, and y to port: turn" err
# fram check says the same of the same files.
for axes in y_forward y_up; do
    expect 0 "$FRAM" hull "$axes.obj"
    told=$(sed -n 's/.*m long along x: \(x is .*\)/\1/p; s/.*\(the two sides .*\)/\1/p' err)
    printf 'vessel: {hull: {form: file, file: %s.obj}}\nice: {source: none}\n' "$axes" >axes.yaml
    "$FRAM" check axes.yaml >out 2>err || true
    grep -qF "$told" err || fail "check does not say '$told' of $axes.obj: $(cat out err)"
    ! grep -q "move the mesh" err || fail "check would have $axes.obj moved: $(cat err)"
done

# An icebreaker of a given block coefficient, in all formats.
for ending in stl obj gdf; do
    expect 0 "$FRAM" hull --length 100 --beam 20 --draught 7 --block-coefficient 0.5 -o "ship.$ending" --quiet
    # A panel file ends in its water plane by convention; this one is closed.
    expect 0 "$FRAM" hull "ship.$ending" --json
    same "$(value 'abs(j["block_coefficient"] - 0.5) < 1e-6')" True "block coefficient of ship.$ending"
done
# A deck in z = 0 would be a lid of the water plane to whoever reads it.
sed 's/^\(v .*\) 2e3$/\1 0/; s/e3//g' long.obj >deck.obj
expect 0 "$FRAM" hull deck.obj --draught 2 -o deck.gdf
says "warning: deck.gdf: 2 triangles lie in z = 0" err
same "$(grep -c "above z = 0" err)" 0 "warnings of a hull under water"
# What is above z = 0 is written too, whatever the draught.
expect 0 "$FRAM" hull box.stl --draught 2 -o box.gdf
says "warning: box.gdf: 10 panels reach above z = 0; programs of panel methods take those under water alone" err
same "$(grep -c "triangles lie in" err)" 0 "lids of a box"
says "warning: box.gdf: its z = 0 is not the waterline at that draught: move the hull up by 1 m first" err
expect 0 "$FRAM" hull box.stl --mass 1230e3 -o box.gdf
! grep -q "is not the waterline" err || fail "the box is warned of at its own waterline: $(cat err)"
# Moved up or down a hull that lists floats no better.
expect 0 "$FRAM" hull "${off[@]}" -o box.gdf
says "warning: box.gdf: its z = 0 is not the waterline at that mass: the hull floats with a heel of -" err
says "deg: turn it so first, or give --lcg, --tcg and --kg with which it floats upright" err
! grep -q "move the hull" err || fail "a hull that lists is to be moved: $(cat err)"
# Of a hull on its keel nothing is to be cut off there.
sed 's/^\(v .*\) -3e3$/\1 0/; s/e3//g' long.obj >keel.obj
expect 0 "$FRAM" hull keel.obj --draught 1.5 -o keel.gdf
says "warning: keel.gdf: its z = 0 is not the waterline at that draught: move the hull down by 1.5 m first" err
says "warning: keel.gdf: no panel reaches under z = 0" err
! grep -q "cut them off" err || fail "the hull is to be cut off at its keel: $(cat err)"
expect 0 "$FRAM" hull deck.obj --draught 2 -o deck.stl
! grep -q warning err || fail "deck.stl is warned of: $(cat err)"
# Plating of a metre without a deck: the water in it is told of.
cat >boat.obj <<'END'
v -8 -4 -2
v 8 -4 -2
v 8 4 -2
v -8 4 -2
v -8 -4 1
v 8 -4 1
v 8 4 1
v -8 4 1
v -7 -3 -1
v 7 -3 -1
v 7 3 -1
v -7 3 -1
v -7 -3 1
v 7 -3 1
v 7 3 1
v -7 3 1
f 4 3 2 1
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
f 9 10 11 12
f 13 14 10 9
f 14 15 11 10
f 15 16 12 11
f 16 13 9 12
f 5 6 14 13
f 6 7 15 14
f 7 8 16 15
f 8 5 13 16
END
expect 0 "$FRAM" hull boat.obj --json
near 'j["well"], j["volume_m3"]' "84 / 128, 256 - 84" "the well of an open boat"
same "$(value 'j["open_boat"], j["half"]')" "True False" "an open boat"
says "goes round a hole of 66 % of its area" err
expect 2 "$FRAM" hull --length 100 --beam 20 --draught 7 --block-coefficient 0.9 --json
same "$(value 'j["error"]["key"]')" --block-coefficient "key"
says "can be 0.3751 to 0.566," err
expect 0 "$FRAM" hull --length 100 --beam 20 --draught 7 --block-coefficient 0.3751

# A tanker: sound when read again, of the block coefficient asked for; what cannot be is refused with its key.
tanker=(--ship --length 320 --beam 60 --draught 21 --freeboard 9)
for block in 0.75 0.9; do
    expect 0 "$FRAM" hull "${tanker[@]}" --block-coefficient $block -o tanker.stl --force --quiet
    expect 0 "$FRAM" hull tanker.stl --json
    same "$(value 'abs(j["block_coefficient"] - '$block') < 1e-5, j["closed"], j["convex_pieces"]["count"]')" \
        "True True 1" "the tanker of $block"
done
refused_ship() {
    expect 2 "$FRAM" hull "${tanker[@]}" --json "$@"
    same "$(value 'j["error"]["key"]')" "$1" "key of $*"
}
refused_ship --block-coefficient 0.98
# The range that docs/hulls.md tells is the one that a refusal tells.
expect 2 "$FRAM" hull --ship --length 220 --beam 42 --draught 12 --block-coefficient 0.98
range=$(sed -n 's/.* can be \(0\.[0-9][0-9]\)[0-9]* to \(0\.[0-9][0-9]\)[0-9]*, .*/\1 to \2/p' err)
says "of 220 x 42 x 12 m reaches block coefficients of $range;" "$FRAM_SOURCE/docs/hulls.md"
refused_ship --flare-angle-deg 8
refused_ship --bilge-radius 30
refused_ship --transom 0.05
refused_ship --parallel-midbody 0.95
refused_ship --ship --box
expect 2 "$FRAM" hull --length 100 --beam 20 --draught 7 --transom 0.5
says "applies to a ship" err

# A ship with bulb, flare and transom: cut as finely as it is told, and symmetric.
ship=$FRAM_SOURCE/examples/hulls/ship_with_bulb.obj
before=0
for tolerance in 1 0.25; do
    expect 0 "$FRAM" hull "$ship" --tolerance "$tolerance" --json
    same "$(value 'j["convex_pieces"]["largest_distance_m"] <= '"$tolerance")" True "pieces within $tolerance m"
    same "$(value 'j["convex_pieces"]["count"] > '"$before")" True "more pieces for less distance"
    before=$(value 'j["convex_pieces"]["count"]')
    same "$(value '1 <= j["convex_pieces"]["volume_m3"] / j["enclosed_volume_m3"] < 1.01 + 0.02 * '"$tolerance")" True \
        "volume of the pieces"
done
same "$(value 'j["level_m"], abs(j["centre_of_buoyancy_m"][1]) < 1e-9, j["stable"]')" "0 True True" "the ship at z = 0"

# The FPSO of the Marine Systems Simulator, where it is there: cracks sealed and told, integrals that agree, at z = 0 of
# the file and in its frame (an independent computation and WAMIT's printout; see tests/io/test_observed_hull.c).
fpso=$FRAM_SOURCE/../shared/data/hulls/fpso_low.gdf
if [ -r "$fpso" ]; then
    expect 0 "$FRAM" hull "$fpso" --json
    same "$(value 'abs(j["volume_m3"] / 97947.92 - 1) < 1e-5, abs(j["volume_m3"] / 97960.9 - 1) < 5e-3')" "True True" \
        "volume of the FPSO"
    same "$(value 'max(j["volume_integrals_m3"]) / min(j["volume_integrals_m3"]) - 1 < 1e-6')" True "three integrals"
    same "$(value 'abs(j["centre_of_buoyancy_m"][2] / -5.922808 - 1) < 1e-5, j["level_m"]')" "True 0" "its frame"
    same "$(value 'abs(j["waterplane_area_m2"] / 8315.66 - 1) < 1e-5')" True "water plane"
    same "$(value '0.03 < j["seal"]["widest_crack_m"] < 0.05, abs(j["seal"]["area_vector_m2"][2] + 0.828) < 1e-3')" \
        "True True" "cracks"
    same "$(value 'j["enclosed_volume_m3"] > j["volume_m3"], j["mirrored_y"], j["topsides_raised_by_m"] > 0')" \
        "True True True" "topsides"
fi

# A drawing.
if "$FRAM" --version | grep -q cairo; then
    expect 0 "$FRAM" hull ship.obj --draw ship.png
    head -c 8 ship.png | od -An -tx1 | grep -q "89 50 4e 47" || fail "ship.png is no PNG"
    expect 2 "$FRAM" hull ship.obj --draw no/such/folder/ship.png
    # A picture that finds no room is one error and no file, and leaves the picture of before as it was.
    cp ship.png before.png
    for picture in half.png ship.png; do
        expect 1 bash -c 'ulimit -f 4 && exec "$@"' - "$FRAM" hull ship.obj --draw $picture --force
        says "cannot write" err
        [ -z "$(find . -name '*.new')" ] || fail "half-written files are left: $(find . -name '*.new')"
    done
    # A name that the file system does not take is told before anything is written.
    long=$(printf '%252s' '' | tr ' ' n)
    expect 2 "$FRAM" hull ship.obj --draw half.png -o "$long.stl"
    says "--output: expected a shorter name" err
    [ ! -e half.png ] || fail "a half-written picture stands at its place"
    cmp -s ship.png before.png || fail "a picture that could not be written took the one of before"
fi

# A light ship with her centre of gravity high and off the middle floats keel up; the drawing, which is upright, has its
# water at the deck.
if built_with cairo; then
    expect 0 "$FRAM" hull --length 90 --beam 20 --draught 6.5 --block-coefficient 0.5 -o light.stl --quiet
    expect 0 "$FRAM" hull light.stl --mass 4e6 --kg 9 --tcg 0.5 --draw light.png --json
    same "$(value 'abs(j["heel_deg"]) > 170')" True "a ship that floats keel up"
    python3 "$FRAM_SOURCE/tests/cli/pixels.py" wet light.png || fail "light.png"
fi

# A hole is refused with its place, and filled on request.
grep -v '^f' ship.obj >hole.obj
grep '^f' ship.obj | head -n -1 >>hole.obj # without a triangle of the deck
expect 2 "$FRAM" hull hole.obj --json
same "$(value 'j["error"]["file"], j["error"]["line"] > 0, j["error"]["key"].split()[0]')" "hole.obj True face" "place"
says "has one triangle" err
expect 0 "$FRAM" hull hole.obj --repair --json
same "$(value 'j["holes_filled"]')" 1 "holes"

# The example that --help gives for main particulars can be made.
example=$("$FRAM" hull --help | grep -o 'hull --length.*')
# shellcheck disable=SC2086
expect 0 "$FRAM" $example

# What the help tells as defaults, given by hand, changes nothing.
for form in "" --ship; do
    expect 0 "$FRAM" hull --help
    told=$(told_defaults "density|pieces" '\(' && if [ "$form" ]; then
        told_defaults "no file:" 'ship ' && told_defaults "ship:" '\('
    else
        told_defaults "no file:" '\('
    fi)
    expect 0 "$FRAM" hull $form --length 120 --beam 24 --draught 8 --json
    bare=$(cat out)
    # shellcheck disable=SC2086
    expect 0 "$FRAM" hull $form --length 120 --beam 24 --draught 8 $told --json
    same "$(cat out)" "$bare" "$form with the defaults of the help: $told"
done

# Angles that are given. A waterline of half the beam B over an entrance of B/2 cot(angle), a parallel body and a run,
# which together are as long as the ship: its area stays with the angle of entrance, its centre goes forward. A steeper
# stern displaces more under the same waterline.
icebreaker="--length 120 --beam 24 --draught 8 --parallel-midbody 0.4"
# shellcheck disable=SC2086
expect 0 "$FRAM" hull $icebreaker --json
volume=$(value 'j["volume_m3"]') && centre=$(value 'j["centre_of_flotation_m"][0]')
# shellcheck disable=SC2086
expect 0 "$FRAM" hull $icebreaker --entrance-angle-deg 35 --json
same "$(value '(lambda bow: abs(j["centre_of_flotation_m"][0] * 2016 - 12 * bow * (60 - 2 * bow / 3)
    - 24 * 48 * (36 - bow) - 12 * (72 - bow) * (-60 + 2 * (72 - bow) / 3)) < 1e-6)(12 / 0.7002075382097097)')" True \
    "the waterline by the angle of entrance"
# shellcheck disable=SC2086
expect 0 "$FRAM" hull $icebreaker --stern-angle-deg 35 --json
same "$(value "1.005 < j['volume_m3'] / $volume < 1.05, abs(j['centre_of_flotation_m'][0] - $centre) < 1e-9")" \
    "True True" "a steeper stern"

# Words that do not go together.
expect 2 "$FRAM" hull
says "needs a mesh file" err
expect 2 "$FRAM" hull ship.obj --length 30
says "--length" err
for words in "--scale 0.001" "--seal 0.1" --repair; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" hull --length 100 --beam 20 --draught 7 $words
    says "${words% *}: applies to a hull from a file" err
done
for option in --stem-angle-deg --bilge-radius --transom; do
    expect 2 "$FRAM" hull --box --length 100 --beam 20 --draught 7 $option 1
    says "$option: does not apply to a box" err
done
expect 2 "$FRAM" hull ship.obj --draught 3 --mass 1e6
says "give one of them" err
expect 2 "$FRAM" hull ship.obj more.obj
expect 2 "$FRAM" hull ship.obj --draught 100
says "does not cut the hull, which is 11 m deep; give a smaller one" err
# Of a box of 40 x 10 x 5 m, by what was given of it.
expect 2 "$FRAM" hull box.stl --draught 4.9999999 --json
says "the water at a draught of 4.9999999 m does not cut the hull, which is 5 m deep; give a smaller one" out
expect 2 "$FRAM" hull box.stl --draught 1e-9
says "does not cut the hull, which is 5 m deep; give a larger one" err
expect 2 "$FRAM" hull box.stl --mass 1e-3 --json
same "$(value 'j["error"]["key"]')" --mass "the key of no mass"
says "the mass of 0.001 kg is next to nothing for a hull that encloses 2000 m3: give kilograms" out
expect 2 "$FRAM" hull box.stl --mass 2049999.9
says "the mass of 2049999.9 kg is all that the hull, which encloses 2000 m3, can displace: give less" err
expect 0 "$FRAM" hull box.stl --mass 1e5
says "warning: --mass: 100000 kg is 4.9 % of what the hull can displace, 2.05e+06 kg: give kilograms" err
expect 0 "$FRAM" hull box.stl --mass 1.1e5
! grep -q warning err || fail "a light hull is warned of: $(cat err)"
expect 2 "$FRAM" hull ship.obj --mass 1e12
says "encloses" err
expect 2 "$FRAM" hull ship.obj --pieces 0
says "--pieces: expected 1 to 4096 pieces, found 0" err
expect 2 "$FRAM" hull ship.obj --pieces 300000000
says "--pieces: expected 1 to 4096 pieces, found 300000000" err
expect 2 "$FRAM" hull ship.obj -o ship.ply
says ".stl, .obj or .gdf" err
expect 2 "$FRAM" hull missing.stl
says "missing.stl" err

finish "fram hull: as it should be"

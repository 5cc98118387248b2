#!/usr/bin/env bash
# fram ice as a user meets it: dimensionless and SI calculations, JSON, errors.
. "$FRAM_SOURCE/tests/cli/common.sh"
# near EXPRESSION NUMBER TOLERANCE NAME, of the JSON object j on the last line of out.
near() {
    tail -n 1 out | python3 -c 'import json, sys; j = json.load(sys.stdin); a, b = '"$1, $2"'
sys.exit(abs(a - b) > '"$3"' * abs(b))' || fail "$4: $(cat out)"
}

expect 0 "$FRAM" ice wedge --a-over-l 0.1 --json
near 'j["capacity_C"]' 1.255469567682 1e-9 "capacity"
near 'j["x_max"]' 0.5114858883249 1e-9 "place"
near 'j["eta0"]' 2.067333645437 1e-9 "deflection"
expect 0 "$FRAM" ice sheet --a-over-l 0.2 --nu 0.3 --json
near 'j["sigma_h2_over_P"]' 2.94937 0.01 "sheet"
near 'j["exact_sigma_h2_over_P"]' 2.94937 1e-5 "exact sheet"
expect 0 "$FRAM" ice break --force 311743 --contact-area 0.155871 --thin-plate --json
near 'j["wedge_stress"]' 0.5e6 1e-5 "stress"
near 'j["breaking_radius"]' 4.14196 1e-5 "radius"
expect 0 "$FRAM" ice break --thickness 0.8
says breaking_radius out
# Stresses and capacities go together, of the radial crack and of the wedges each by itself.
expect 0 "$FRAM" ice break --force 2e5 --contact-area 0.5 --thickness 0.8 --elastic-modulus 4e9 --nu 0.25 --thin-plate \
    --flexural-strength 6e5 --crushing-strength 3e6 --water-density 1010 --gravity 9.7 --json
near 'j["characteristic_length"]' '(4e9 * 0.8 ** 3 / (12 * (1 - 0.25 ** 2) * 1010 * 9.7)) ** 0.25' 1e-9 "l"
near 'j["radial_stress"] * j["radial_capacity"]' '6e5 * 2e5' 1e-9 "radial crack"
near 'j["wedge_stress"] * j["wedge_capacity"]' '6e5 * 2e5' 1e-9 "wedges"
near 'j["radial_radius"]' '(2 * 0.5 / 3.141592653589793) ** 0.5' 1e-9 "half disc"
near 'j["crushing_force"]' '0.5 * 3e6' 1e-9 "crushing"
[ "$(tail -n 1 out | python3 -c 'import json, sys; j = json.load(sys.stdin)
print(j["radial_capacity"] < j["wedge_capacity"])')" = True ] || fail "an edge cracks before it breaks off: $(cat out)"

expect 0 "$FRAM" ice break --thin-plate --json
near 'j["wedge_capacity"]' '0.5e6 / 6 * 2 * 3**0.5' 1.1e-2 "an edge, a point"
edge=$(tail -n 1 out | python3 -c 'import json, sys; print(json.load(sys.stdin)["wedge_capacity"])')
expect 0 "$FRAM" ice break --thin-plate --included-angle 60 --json
near 'j["wedge_capacity"]' "$edge / 3" 1e-12 "a corner of 60 degrees"
expect 0 "$FRAM" ice break --thin-plate --contact-area 0.2185 --contact-width 10 --json
near 'j["wedge_capacity"]' 437e3 2e-3 "a contact of 10 m"
near 'j["strip_length"]' '1.11072 * j["characteristic_length"]' 1e-5 "its strip"
expect 0 "$FRAM" ice break --contact-width 400 --json
says '"radial_capacity":null' out
expect 0 "$FRAM" ice break --contact-width 400
holds '^radial_capacity  *none ' out
expect 0 "$FRAM" ice break --contact-width 10 --ice-length 1.5 --json
near 'j["strip_capacity"]' '0.5e6 / 6 * 10 * 27 / 4 / 1.5' 1e-4 "a rigid strip"
near 'j["strip_length"]' 0.5 1e-4 "where it breaks"
# A load that rises in a tenth of a second: the ratios of validation/wedge_ramp.py at a/l 0.0205, tau 0.1624.
expect 0 "$FRAM" ice break --thin-plate --contact-area 0.155871 --json
both='j = __import__("json").load(__import__("sys").stdin); print(j["wedge_capacity"], j["breaking_radius"])'
rest=$(tail -n 1 out | python3 -c "$both")
expect 0 "$FRAM" ice break --thin-plate --contact-area 0.155871 --rise-time 0.1 --json
near 'j["wedge_capacity"]' "${rest% *} / 0.9322" 1e-2 "capacity under a load that rises"
near 'j["breaking_radius"]' "${rest#* } * 0.5390" 2e-2 "length under a load that rises"
# An error names the option, not the member of the library's struct.
expect 2 "$FRAM" ice break --rise-time -1
says "fram: --rise-time: expected" err
expect 2 "$FRAM" ice sheet --a-over-l 0.1 --nu 0.7
says "fram: --nu: expected" err
expect 2 "$FRAM" ice break --included-angle -30
says "more than 0 and at most 360 degrees" err
expect 2 "$FRAM" ice break --included-angle 361
says included-angle err
expect 2 "$FRAM" ice break --contact-width -1
says --contact-width err

# Beyond tables and theory.
expect 2 "$FRAM" ice break --contact-area 1e6
says "no larger than 3 characteristic lengths" err
expect 0 "$FRAM" ice break --contact-area 100 --contact-width 80
expect 2 "$FRAM" ice break --thickness 1e-300
says "1e-06 to 100 m" err
expect 2 "$FRAM" ice break --rise-time 0.1 --ice-density 1030
says "--ice-density: expected less than the density of the water, 1025, found 1030" err
expect 2 "$FRAM" ice break --rise-time 1 --water-density 900
says "--water-density: expected more than the density of the ice, 920, found 900" err
expect 0 "$FRAM" ice break --water-density 900

expect 0 "$FRAM" ice split --length 75 --width 50 --json
near 'j["factor"]' 0.1540 2e-3 "splitting, width over length 2/3"
near 'j["splitting_load"]' 'j["factor"] * 150e3 * 75 ** 0.5' 1e-12 "splitting load"
expect 0 "$FRAM" ice split --length 40 --width 60 --thickness 0.5 --toughness 100e3 --json
near 'j["splitting_load"]' '0.2077 * 0.5 * 100e3 * 40 ** 0.5' 2e-3 "splitting, width over length 1.5"
expect 0 "$FRAM" ice split --length 50 --width 50 --place -18.75 --json
near 'j["smaller_side"]' 6.25 1e-12 "side"
near 'j["larger_side"]' 43.75 1e-12 "other side"
near 'j["factor"]' 0.106 6e-3 "splitting near a corner"
near 'j["slenderness"]' 8 1e-12 "the narrower piece"
expect 0 "$FRAM" ice split --length 10 --width 100 --place 10 --json
near 'j["slenderness"]' 6 1e-12 "the wider piece is the more slender one"
expect 0 "$FRAM" ice split
says splitting_load out
expect 2 "$FRAM" ice split --place 25
says place err
expect 2 "$FRAM" ice split --width 0 --json
says '"status":"input"' out

# What the help tells as defaults, given by hand, changes nothing.
for what in break split; do
    expect 0 "$FRAM" ice --help
    told=$(told_defaults "${what}[a-z, ]*:" '\(')
    [ "$(wc -l <<<"$told")" -ge 4 ] || fail "the help of $what tells few defaults: $told"
    rise=() && [ $what = split ] || rise=(--rise-time 0.1)
    expect 0 "$FRAM" ice $what "${rise[@]}" --json
    bare=$(cat out)
    # shellcheck disable=SC2086
    expect 0 "$FRAM" ice $what $told "${rise[@]}" --json
    same "$(cat out)" "$bare" "$what with the defaults of the help"
done

# Options of the other calculations.
expect 2 "$FRAM" ice split --length 80 --flexural-strength 6e5
says "--flexural-strength: is for break" err
expect 2 "$FRAM" ice wedge --a-over-l 0.1 --nu 0.2
says "--nu: is for sheet, break" err
expect 2 "$FRAM" ice break --a-over-l 0.1
says "--a-over-l: is for wedge, sheet" err
expect 2 "$FRAM" ice sheet --a-over-l 0.1 --wedges 4
says "--wedges: is for break" err
# A fraction is no matter of how it is written, 1e1 and 2.0 are; nor is a number that is too large.
expect 2 "$FRAM" ice break --wedges 2.5
says "--wedges: needs a whole number" err
grep -q "1e3" err && fail "2.5 is told as a way of writing: $(cat err)"
expect 2 "$FRAM" ice break --wedges 1e1
says "as 1000, not 1e3 or 1000.0" err
expect 2 "$FRAM" ice break --wedges 2.0
says "--wedges: needs a whole number, as 1000, not 1e3 or 1000.0" err
for words in 2147483648 1e300 -99999999999999999999 "$(printf '%600s' '' | tr ' ' 9)"; do
    expect 2 "$FRAM" ice break --wedges "$words"
    says "--wedges: needs a whole number of at most nine digits" err
done
expect 2 "$FRAM" ice split --thin-plate
says "--thin-plate: is for break" err
# Options that count beside another one.
expect 2 "$FRAM" ice break --ice-length 1.5
says "--ice-length: is for --contact-width" err
expect 2 "$FRAM" ice break --contact-width 10 --ice-density 900 --json
says "--ice-density: is for --rise-time" err
says '"status":"usage"' out

expect 2 "$FRAM" ice wedge
says '--a-over-l' err
expect 2 "$FRAM" ice wedge --a-over-l 7 --json
says '--a-over-l' err
says '"status":"input"' out
expect 2 "$FRAM" ice bend
says 'is not a calculation' err
expect 2 "$FRAM" ice break --thickness -1
says thickness err

finish "fram ice: as it should be"

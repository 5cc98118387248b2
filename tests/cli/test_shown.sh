#!/usr/bin/env bash
# Texts of files that somebody sent are told without acting on the terminal: no control characters, no bytes that are no
# text, no names that turn the writing, no lines that a name makes up.
. "$FRAM_SOURCE/tests/cli/common.sh"

cat >scene.yaml <<'YAML'
title: Told
run: {duration: 1, time_step: 0.02}
vessel: {mode: towed, speed: 1, hull: {form: box, length: 20, beam: 8, draught: 2, freeboard: 2}}
ice: {source: floes, floes: [{length: 8, width: 8, x: 30}]}
domain: {x_min: -40, x_max: 60, y_min: -20, y_max: 20}
environment: {water: false}
YAML
"$FRAM" run scene.yaml -o good -q

# quiet_on_terminal NAME: nothing in out or err acts, whatever the file is that made them speak.
quiet_on_terminal() {
    python3 - "$1" <<'PY' || fail "$1: what is told acts on a terminal"
import sys, unicodedata

for name in ("out", "err"):
    text = open(name, "rb").read().decode()  # UTF-8, all of it
    bad = [c for c in text if c not in "\n\t" and (unicodedata.category(c) == "Cc" or "\u202a" <= c <= "\u202e"
                                                  or "\u2066" <= c <= "\u2069")]
    assert not bad, (sys.argv[1], name, bad, text)
PY
}
# acts: each of what may not be told, in a text of its own.
escape=$'\e]52;c;cHduZWQ=\a' c1=$'\xc2\x9b31m' turned=$'a\xe2\x80\xaelmth.\xe2\x81\xa6b' broken=$'\xff\xfe\x9b'
for word in "$escape$c1"$'two\rwords\b\x7f' "$turned$broken"; do
    "$FRAM" "$word" >out 2>err && fail "a command of this name: $word"
    quiet_on_terminal "an unknown command"
    "$FRAM" run scene.yaml "--$word" >out 2>err && fail "an option of this name: $word"
    quiet_on_terminal "an unknown option"
    "$FRAM" check scene.yaml --set "$word=1" >out 2>err && fail "a key of this name: $word"
    quiet_on_terminal "a key of --set"
    cp scene.yaml "$word.yaml"
    "$FRAM" check "$word.yaml" >out 2>err || fail "a file of this name is not read: $word"
    quiet_on_terminal "the scenario of a file of this name"
    "$FRAM" check "$word.yml" >out 2>err && fail "there is no such file"
    quiet_on_terminal "the name of a file that is not there"
    says "cannot" err
    "$FRAM" report "$word" --json >out 2>err && fail "there is no such run"
    quiet_on_terminal "JSON of a name"
done
"$FRAM" report "$turned" --json >out 2>err || true
python3 - "$turned" <<'PY' || fail "a name is another one in JSON"
import json, sys

assert json.load(open("out"))["error"]["file"].startswith(sys.argv[1])
PY

# Keys and words in files.
printf 'output: {"\\e]52;c;cHduZWQ=\\a": 1}\n' >key.yaml
printf 'output: {"\\u202egnp.\\u2066": 1}\n' >key2.yaml
printf '{"type": "\\u001b[2J\\u009b\\u202e", "features": []}' >type.geojson
printf 'solid s\n\e[2J nonsense\n' >token.stl
printf 'v 0 0 \e[31m1\n' >token.obj
printf 'scenario: "\\e[2J.yaml"\nseeds: {least: 1, most: 1}\n' >path.yaml
for words in "check key.yaml" "check key2.yaml" "field type.geojson" "hull token.stl" "hull token.obj" \
    "study path.yaml -o st"; do
    # shellcheck disable=SC2086 # words
    "$FRAM" $words >out 2>err && fail "nothing is wrong: $words"
    quiet_on_terminal "$words"
done
sed 's/"status": "[a-z]*"/"status": "\\u001b[2J\\u009b"/' good/run.json >note.json
cp -r good sent && cp note.json sent/run.json
for words in "report sent" "manage sent" "compare sent good" "compare good sent" "why sent --peak 1 --no-rerun" \
    "view sent --page key.yaml" "resume sent"; do
    # shellcheck disable=SC2086 # words
    "$FRAM" $words >out 2>err || true
    quiet_on_terminal "$words"
done
sed $'1s/ice_force_x\\[/ice\e[2J_\xe2\x80\xae\x9bx[/; 1s/\\[m\\]/[\e]0;m]/' good/series.csv >sent/series.csv
for words in "plot sent" "compare sent good" "extremes sent/series.csv"; do
    # shellcheck disable=SC2086 # words
    "$FRAM" $words >out 2>err || true
    quiet_on_terminal "$words"
done

# A line that a name makes up is none.
name=$'x\nwarning: all is well\n.yaml'
expect 2 "$FRAM" check "$name"
[ "$(grep -c . err)" = 1 ] || fail "a name makes lines: $(cat err)"

# Names of all languages stay as they are.
cp scene.yaml 'Jäämurtaja 北極 مركب.yaml'
expect 2 "$FRAM" check 'Jäämurtaja 北極 مركب.yaml' --set ваза=1
says 'ваза' err
expect 2 "$FRAM" check 'Jäämurtaja 北極 مركب.yml'
says 'Jäämurtaja 北極 مركب.yml' err

# The reason of a run that failed, in a row that is read.
cat >study.yaml <<'YAML'
scenario: scene.yaml
seeds: {least: 1, most: 1}
vary: {grid: {vessel.speed: [1, 2]}}
keep: summary
YAML
expect 0 "$FRAM" study study.yaml -o st -q
for row in st/runs/*/1.row; do
    python3 - "$row" <<'PY'
import sys

lines = open(sys.argv[1]).read().split("\n")
at = lines.index("finished")
lines[at], lines[at + 2], lines[at + 3] = "failed", "\x1b[2J\u202e\u009b\rwhy", ""
open(sys.argv[1], "w").write("\n".join(lines))
PY
done
"$FRAM" study study.yaml -o st >out 2>err || true
says "the first that failed" err
says "why" err
quiet_on_terminal "the reason in a row"
cp st/summary.csv out
quiet_on_terminal "summary.csv"

finish "what files and names say does not act on a terminal"

#!/usr/bin/env bash
# How a ship keeps its track is told before, during and after a run; the same on one and two threads and after a resume.
. "$FRAM_SOURCE/tests/cli/common.sh"

# A small icebreaker on an arc across thin ice that drifts against a ship which is held.
cat >scene.yaml <<'YAML'
title: A pattern in ice
run: {duration: 14, time_step: 0.04, scale: 30, transient: 2.02}
vessels:
  - name: ship
    mode: prescribed
    hull: {form: box, length: 40, beam: 10, draught: 4, freeboard: 2}
  - name: breaker
    mode: free
    x: 60
    y: -80
    speed: 4
    hull: {form: icebreaker, length: 40, beam: 10, draught: 4, freeboard: 3}
    hydrodynamics: {source: estimate}
    propulsion:
      bollard_pull: 5.0e5
      open_water_speed: 7
      rudder_area: 0
      steering_rate_deg: 5
      speed: 4
      track_limit: 0.05
      pattern: {kind: circle, distance: 60, width: 160}
ice:
  source: level
  thickness: 0.25
  breakable: true
  smallest_floe_area: 4
  fracture: {brash: true}
  level: {openings: [{x: 60, y: -80, length: 60, width: 16}, {x: 0, y: 0, length: 60, width: 20}]}
domain: {boundary: feeding, x_min: -60, x_max: 180, y_min: -120, y_max: 120, drift_speed: 0.3, drift_direction_deg: 180}
output: {csv_interval: 0.2, frame_interval: 1}
YAML
# With the drag of a ship's side: without it the hull turns on by itself (tests/cli/test_check.sh).
side=environment.hull_drag.water_form=1
expect 0 "$FRAM" check scene.yaml --set $side --set vessels.breaker.propulsion.pattern.width=170
holds "vessel breaker turns on a radius of .* m at full helm in open water at 4 m/s, in ice on a larger one" err
grep '^warning.*pattern' err && fail "a warning without reason"
grep 'points as its bow does' err && fail "a pattern that turns with the drift is said to stand"
expect 0 "$FRAM" check scene.yaml --set $side --set vessels.breaker.propulsion.pattern.width=170 \
    --set vessels.breaker.propulsion.steering_rate_deg=1.5
says "pattern.width: 170 m asks for a radius of 85 m" err
says "leaves little helm, or time to put it over, to correct" err
expect 0 "$FRAM" check scene.yaml --set domain.boundary=open --set domain.drift_speed=auto \
    --set domain.drift_direction_deg=0
says "vessel breaker: its pattern points as its bow does at the start, whatever the current" err
expect 0 "$FRAM" check scene.yaml --set vessels.breaker.propulsion.pattern.width=8
holds "vessels\[1\].propulsion.pattern.width: 8 m asks for a radius of 4 m.*it cannot keep this pattern" err
wide=$(sed -n 's/.*cannot keep this pattern; take \([0-9.]*\) m or more.*/\1/p' err)
expect 0 "$FRAM" check scene.yaml --set vessels.breaker.propulsion.pattern.width="$wide"
grep 'pattern.width' err && fail "a width of $wide m is told as the least, and as too small"
expect 0 "$FRAM" check scene.yaml --set vessels.breaker.propulsion.pattern.distance=160
holds "pattern: at 0 s it leads to .*outside of the domain" err
expect 0 "$FRAM" check scene.yaml --set $side --set vessels.breaker.propulsion.pattern.kind=square \
    --set vessels.breaker.propulsion.pattern.width=100 --set vessels.breaker.propulsion.turning_radius=90
says "corners of 90 m radius leave nothing straight of a side of 100 m" err
# A period that asks for more than the ship makes, for less than counts as beset, and for what lies between.
period=vessels.breaker.propulsion.pattern.period
expect 0 "$FRAM" check scene.yaml --set $period=1 --set vessels.breaker.propulsion.speed=auto
holds "vessels\[1\].propulsion.pattern.period: a round of .* m in 1 s asks for .* vessel breaker makes .* m/s" err
expect 0 "$FRAM" check scene.yaml --set $period=3e5 --set vessels.breaker.propulsion.speed=auto
holds "pattern.period: a round of .* m in 3e+05 s asks for .* and vessel breaker counts as beset under" err
expect 0 "$FRAM" check scene.yaml --set $period=3e5 --set vessels.breaker.propulsion.speed=auto \
    --set domain.drift_speed=0.05
holds "pattern.period: .* vessel breaker, stopped by ice, pushes with 15 % of its pull: it never counts as beset" err
expect 0 "$FRAM" check scene.yaml --set $period=100 --set vessels.breaker.propulsion.speed=auto
grep 'pattern.period' err && fail "a period is told that the ship can keep"

expect 0 "$FRAM" run scene.yaml -o one -q --threads 1
expect 0 "$FRAM" run scene.yaml -o two -q --threads 2
expect 0 "$FRAM" run scene.yaml -o parts -q --until 7
expect 0 "$FRAM" resume parts -q
python3 - <<'PY' || fail "what run.json tells of the track is wrong"
import csv, json, math, re, sys

notes = [json.load(open(f"{name}/run.json")) for name in ("one", "two", "parts")]
assert notes[0]["state_hash"] == notes[1]["state_hash"] == notes[2]["state_hash"], "states differ"
assert notes[0]["tracks"] == notes[1]["tracks"] == notes[2]["tracks"], "tracks differ"
(track,) = notes[0]["tracks"]
rows = [{k.split("[")[0]: float(v) for k, v in r.items()} for r in csv.DictReader(open("one/series.csv"))]
errors = [r["breaker.track_error"] for r in rows if r["time"] > 2]
assert all(r["ship.track_error"] == 0 for r in rows)
# A row tells the error at the begin of its step, 0.16 m of way earlier than the place that it tells.
for r in rows:
    off = 80 - math.hypot(r["breaker.position_x"] - 60, r["breaker.position_y"])
    assert abs(r["breaker.track_error"] - off) < 0.2, (r["time"], off)
most = max(map(abs, errors))
assert most - 1e-6 <= track["largest_m"] < most + 0.1, (most, track)  # the table rounds
assert abs(track["rms_m"] - math.sqrt(sum(e * e for e in errors) / len(errors))) < 0.1 * track["rms_m"] + 0.01, track
assert track["vessel"] == "breaker" and track["limit_m"] == 0.05 and abs(track["time_s"] - 11.96) < 1e-6, track
first = next(e for e in notes[0]["events"] if e["kind"] == "off_track")
assert first["vessel"] == "breaker" and 0.05 < first["value"] < 2 and first["time_s"] > 2, first
assert "off its track by" in first["text"], first
# With no more digits than it takes, as texts and the log have them.
told = re.findall(r'_(?:s|m)": ([-+.e0-9]+)', open("one/run.json").read().split('"told"')[0])
assert len(told) > 4 and all(len(x) <= len(repr(float(x))) for x in told), told
PY
expect 0 "$FRAM" report one -o report.html
holds "Vessel breaker did not keep its track: .* m off at most" report.html
says "Tracks that were sailed" report.html
expect 0 "$FRAM" manage one -o manage.html -q
holds "Vessel breaker did not keep its track: .* m off at most" manage.html
says "Tracks that were sailed" manage.html
finish "tracks are told: before, during and after a run, on any threads and after a resume"

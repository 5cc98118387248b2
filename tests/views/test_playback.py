#!/usr/bin/env python3
"""The playback page in headless Chromium: it draws, and hull, floes and water are where the run says.

The page of a short run gets a probe script, which looks at the drawn pixels under the projected places of bodies and
leaves its findings in the document.  Skipped (77) without Chromium or without the viewer's page.
"""
import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

FRAM = os.environ["FRAM"]
PAGE = pathlib.Path(os.environ["FRAM_SOURCE"]) / "build" / "viewer" / "playback.html"
FLAGS = """--headless --no-sandbox --disable-quic --no-first-run --disable-background-networking
--disable-component-update --disable-sync --use-angle=swiftshader --enable-unsafe-swiftshader
--window-size=1000,700 --virtual-time-budget=15000 --dump-dom""".split()

SCENE = """
title: Playback test
run: {duration: 6, time_step: 0.02}
vessel:
  mode: towed
  x: -20
  speed: 4
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
ice: {mean_floe_area: 64, concentration: 0.7}
domain: {x_min: -64, x_max: 96, y_min: -40, y_max: 40}
output: {frame_interval: 0.5}
"""

PROBE = """
<script>
function pixel(x, y) {
    const gl = fram.scene.renderer.getContext(), out = new Uint8Array(4);
    const p = fram.scene.camera.position.clone().set(x, y, 0).project(fram.scene.camera);
    gl.readPixels((p.x + 1) / 2 * gl.drawingBufferWidth, (p.y + 1) / 2 * gl.drawingBufferHeight, 1, 1, gl.RGBA,
                  gl.UNSIGNED_BYTE, out);
    return [...out];
}
function look(time) {
    fram.time = time;
    document.getElementById('camera').value = 'top';
    fram.placeCamera();
    fram.draw();
    const pose = (b) => [...fram.poses.pose.subarray(7 * b.index, 7 * b.index + 3)];
    const ice = fram.record.bodies.filter((b) => b.material === 'ice' && fram.poses.shown[b.index]);
    const hull = pose(fram.hull), clear = (p) => Math.abs(p[0] - hull[0]) > 35 || Math.abs(p[1] - hull[1]) > 12;
    return { hull, hullPixel: pixel(hull[0], hull[1]), floes: ice.length,
             floePixels: ice.map(pose).filter(clear).map((p) => pixel(p[0], p[1])), waterPixel: pixel(180, 0) };
}
const result = document.createElement('pre');
try {
    const draws = () => fram.scene.renderer.info.render.calls;
    const start = look(fram.record.frames[0].time), end = look(fram.end);
    result.textContent = JSON.stringify({ start, end, calls: draws() });
} catch (e) { result.textContent = JSON.stringify({ error: String(e) }); }
result.id = 'result';
document.body.append(result);
</script>
</body>"""


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


def is_red(p):
    return p[0] > 1.5 * p[2] and p[0] > 60


def is_white(p):
    return min(p[:3]) > 150


def is_blue(p):
    return p[2] > 1.2 * p[0] and p[2] > 60


def find_result(chromium, page, profile):
    dom = subprocess.run([chromium, *FLAGS, f"--user-data-dir={profile}", page.as_uri()],
                         capture_output=True, text=True, timeout=200, check=False).stdout
    found = re.search(r'<pre id="result">(.*?)</pre>', dom, re.S)
    assert found, "the page left no result: " + dom[-400:]
    return json.loads(found.group(1))


def check(view, expected_x):
    assert abs(view["hull"][0] - expected_x) < 0.05, (view["hull"], expected_x)
    assert is_red(view["hullPixel"]), f"no hull at its place: {view['hullPixel']}"
    assert is_blue(view["waterPixel"]), f"no water beside the field: {view['waterPixel']}"
    white = sum(is_white(p) for p in view["floePixels"])
    assert len(view["floePixels"]) > 30, "too few floes to look at"
    floes = len(view["floePixels"])
    assert white >= 0.97 * floes, f"{white} of {floes} floes are drawn at their place"


def main():
    chromium = shutil.which("chromium")
    if not chromium:
        skip("Chromium is not installed")
    if not PAGE.exists():
        skip("the viewer's page is not built (make viewer)")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "scene.yaml").write_text(SCENE)
        run = folder / "run"
        subprocess.run([FRAM, "run", folder / "scene.yaml", "-o", run, "--quiet"], check=True)
        subprocess.run([FRAM, "view", run, "--page", PAGE, "--quiet"], check=True)
        page = run / "playback.html"
        page.write_text(page.read_text().replace("</body>", PROBE))
        with open(run / "series.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        result = find_result(chromium, page, folder / "profile")
        assert "error" not in result, result
        check(result["start"], float(rows[0]["position_x[m]"]) - 0.08)
        check(result["end"], float(rows[-1]["position_x[m]"]))
        assert result["end"]["floes"] == float(rows[-1]["floes[1]"])
        assert result["end"]["hull"][0] - result["start"]["hull"][0] > 20, "the hull does not move"
        assert result["calls"] <= 20, result["calls"]
    print(f"the playback page shows {result['end']['floes']} floes and the hull in {result['calls']} draw calls")


main()

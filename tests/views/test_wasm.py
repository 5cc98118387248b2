#!/usr/bin/env python3
"""The simulator in a browser (`make wasm`), in headless Chromium: its state hash is the command's, for the page's own
scenario and for one that is pasted in; the scene grows with the run; mistakes are told with their line; a run is
stopped; series and record that are saved are the command's.

Skipped (77) without Chromium, or when build/wasm/fram.html was not built (it needs emscripten).
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import chromium

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from skipping import skip  # noqa: E402  (tests is no package)

FRAM = os.environ["FRAM"]
SOURCE = pathlib.Path(os.environ["FRAM_SOURCE"])
PAGE = SOURCE / "build" / "wasm" / "fram.html"
# Thrusters, lines, a controller, floes that split, an end between two steps: what the page's own scenario has not.
OWN = """title: Own
run: {duration: 6.008, time_step: 0.02, seed: 3}
vessel:
  mode: free
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
  mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}
  thrusters: [{x: 18}, {x: -18}]
  positioning: {active: true}
ice: {concentration: 0.75, mean_floe_area: 64, thickness: 0.3, breakable: true}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40, boundary: open}
environment: {current_speed: 2.5, current_direction_deg: 180}
output: {frame_interval: 0.2}
"""
WRONG = "run: {duration: 6, time_step: 0.02}\nvessel:\n  mode: towed\n  hull: {length: 48, beam: 12, draft: 4}\n"
LONG = OWN.replace("duration: 6.008", "duration: 10000")
OVER = "['finished', 'stopped', 'failed'].includes(simulation.state)"


def native(folder, name, text):
    (folder / f"{name}.yaml").write_text(text)
    run = subprocess.run([FRAM, "run", folder / f"{name}.yaml", "-o", folder / name, "--quiet", "--json"], check=True,
                         capture_output=True, text=True)
    return json.loads(run.stdout)


def start(browser, text=None):
    if text is not None:
        browser.run(f"document.getElementById('scenario').value = {json.dumps(text)}")
    browser.run("document.getElementById('run').click()")


def compare(browser, folder, name, text):
    """One scenario in both; returns what the page tells of it."""
    told = native(folder, name, text)
    start(browser, text)
    browser.until(OVER, f"{name} does not end in the browser")
    state = browser.run("simulation.state")
    assert state == "finished", (state, browser.run("document.getElementById('error').textContent"))
    ended = browser.run("simulation.ended")
    assert ended["hash"] == told["state_hash"], \
        f"{name}: {ended['hash']} in the browser, {told['state_hash']} here (is build/wasm/fram.html of this code?)"
    assert ended["steps"] == told["steps"]
    scene = browser.run("({ frames: simulation.scene.fram.record.frames.length, end: simulation.scene.fram.end,"
                        " bodies: simulation.scene.fram.record.bodies.length })")
    assert abs(scene["end"] - told["time_s"]) < 1e-9 and scene["frames"] > 20, scene
    return browser.run("simulation.progress") | scene | ended


def saved(browser, name):
    """A file that the page offers, as bytes."""
    return bytes(browser.run(f"fetch([...document.querySelectorAll('#results a')].find((a) => a.download === '{name}')"
                             ".href).then((r) => r.arrayBuffer()).then((b) => [...new Uint8Array(b)])"))


def check_files(browser, folder, name):
    record = saved(browser, "record.fram")
    assert record == (folder / name / "record.fram").read_bytes(), "the record is another one"
    series = [line.split(b",") for line in saved(browser, "series.csv").splitlines()]
    other = [line.split(b",") for line in (folder / name / "series.csv").read_bytes().splitlines()]
    wall = [k for k, head in enumerate(other[0]) if head.startswith(b"step_wall") or b"wall" in head]
    assert len(series) == len(other) and series[0] == other[0]
    for one, two in zip(series, other):
        assert [v for k, v in enumerate(one) if k not in wall] == [v for k, v in enumerate(two) if k not in wall]
    browser.run("[...document.querySelectorAll('#results a')].find((a) => a.download === 'series.csv').click()")
    assert browser.file("series.csv").stat().st_size == len(saved(browser, "series.csv"))


def check_mistake(browser):
    start(browser, WRONG)
    browser.until(OVER, "a mistake is not told")
    error = browser.run("simulation.error")
    assert error["line"] == 4 and "draught" in error["message"], error
    shown = browser.run("document.getElementById('error').textContent")
    assert shown.startswith("line 4, vessel.hull.draft: "), shown
    chosen = browser.run("(() => { const b = document.getElementById('scenario');"
                         " return b.value.slice(b.selectionStart, b.selectionEnd); })()")
    assert chosen == WRONG.splitlines()[3], chosen
    browser.until("simulation.scene?.framEnded === true", "the playback waits for a run that failed")
    return shown


def check_stop(browser):
    start(browser, LONG)
    browser.until("simulation.progress?.time > 0.2 && simulation.scene?.fram?.ready", "a long run does not begin")
    browser.run("document.getElementById('stop').click()")
    browser.until(OVER, "a run does not stop")
    ended = browser.run("simulation.ended")
    assert ended["stopped"] and 0 < ended["time"] < 10000, ended
    assert saved(browser, "record.fram")[:7] == b"FRAMREC"
    return ended["time"]


def frame_rate(browser):
    """Pictures a second that the page draws while a run goes: of the page itself, and of the scene."""
    start(browser, LONG)
    browser.until("simulation.scene?.fram?.ready && simulation.progress?.time > 0.2", "a run does not begin")
    return browser.run("""new Promise((done) => {
        const scene = simulation.scene, draw = scene.fram.draw.bind(scene.fram), from = simulation.progress.time;
        let ticks = 0, drawn = 0;
        scene.fram.draw = () => { drawn++; draw(); };
        const began = performance.now(), tick = () => {
            ticks++;
            const seconds = (performance.now() - began) / 1000;
            if (seconds < 4) { requestAnimationFrame(tick); return; }
            scene.fram.draw = draw;
            document.getElementById('stop').click();
            done({ ticks: ticks / seconds, drawn: drawn / seconds,
                   pace: (simulation.progress.time - from) / seconds });
        };
        requestAnimationFrame(tick);
    })""")


def main():
    if not chromium.path():
        skip("no chromium (tools/deps.sh --install views)")
    if not PAGE.exists():
        skip("build/wasm/fram.html is not there (make wasm, which needs emscripten)")
    with tempfile.TemporaryDirectory(prefix="fram-wasm-") as name, chromium.Browser() as browser:
        folder = pathlib.Path(name)
        browser.call("Page.navigate", url=PAGE.as_uri())
        browser.until("window.simulation?.state === 'ready'", "the page does not get ready")
        shown = compare(browser, folder, "shown", browser.run("document.getElementById('scenario').value"))
        check_files(browser, folder, "shown")
        assert chromium.colours(browser.picture(os.environ.get("FRAM_PICTURE"))) > 50, "the picture is empty"
        own = compare(browser, folder, "own", OWN)
        told = check_mistake(browser)
        rate = frame_rate(browser)
        browser.until(OVER, "a run does not stop")
        stopped = check_stop(browser)
        again = compare(browser, folder, "again", OWN)
        assert again["hash"] == own["hash"]
        assert rate["drawn"] > 0, rate
        assert not browser.complaints, browser.complaints
    for what in (shown, own):
        pace = what["time"] / what["wall"]
        print(f"hash {what['hash']} as native, {what['floes']} floes, {pace:.2f} times real time")
    print(f"while a run goes: {rate['ticks']:.1f} animation frames/s, {rate['drawn']:.1f} scenes/s, "
          f"{rate['pace']:.2f} times real time; stopped at {stopped:.1f} s")
    print(told)


main()

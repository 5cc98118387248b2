#!/usr/bin/env python3
"""A run that goes on, looked at in headless Chromium by its live view; stepped here, so that the page is looked at when
the run stands still.

The page must show frames while the run goes, go on with it, know floes that broke off meanwhile, and play the whole
run afterwards, with nothing to complain of.  Skipped (77) without Chromium, libmicrohttpd or the viewer's page.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import chromium

FRAM = os.environ["FRAM"]
SOURCE = pathlib.Path(os.environ["FRAM_SOURCE"])
SCENE = """
title: Live
run: {duration: 12, time_step: 0.02}
vessel: {mode: towed, x: -20, speed: 4, ramp: 1, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
ice: {mean_floe_area: 64, concentration: 0.75, thickness: 0.3, breakable: true}
domain: {x_min: -64, x_max: 96, y_min: -40, y_max: 40}
output: {frame_interval: 0.1}
"""


STATE = """({ frames: fram.record.frames.length, broke: fram.record.fractures.length, floes: fram.poses.floes,
    born: fram.record.bodies.filter((b) => b.parent >= 0).length,
    clock: document.getElementById('clock').textContent })"""


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


def advance(world, time):
    while world.time < time - 1e-9:
        world.step()


def check_peak(browser, run):
    """The run is over: the same page has its loads by mechanism, and a click on a peak tells what fram why tells."""
    told = subprocess.run([FRAM, "why", run, "--peak", "1", "--no-rerun", "--json"], capture_output=True, text=True,
                          check=True)
    why = json.loads(told.stdout)
    peaks = browser.run("fram.loads.vessels[0].peaks.map((p) => [p.rank, p.time, p.detail.load])")
    assert len(peaks) == why["peaks"] and peaks[0][1:] == [why["time"], why["load"]], (peaks, why["time"], why["load"])
    left, top, height, x = browser.run("""(() => {
        const t = fram.timeline, box = t.canvas.getBoundingClientRect();
        return [box.left, box.top, box.height, t.x(fram.loads.vessels[0].peaks[0].time)]; })()""")
    assert height > 70, "the timeline has no room for its bands"
    browser.click(left + x, top + height / 2)
    assert abs(browser.run("fram.time") - why["time"]) < 1e-9, "a click on a peak does not lead there"
    panel = browser.run("document.getElementById('peak').textContent")
    assert browser.run("fram.loads.vessels[0].peaks[0].sentence") in panel, panel
    browser.run("fram.peaks.close()")


def check(browser, folder, page):
    import fram
    addresses = []
    with fram.Scenario.from_text(SCENE).world() as world:
        recording = world.record(folder / "run", live_page=page, live=addresses.append)
        advance(world, 3)
        browser.call("Page.navigate", url=addresses[0])
        browser.until("window.fram?.ready === true", "the page does not get ready")
        browser.until("fram.end === 3 && fram.time <= 3", "the page does not show what there is")
        browser.run("(fram.seek(3), fram.draw())")
        before = browser.run(STATE)
        assert before["frames"] == 31 and before["floes"] == world["floes"], before
        # Who stands at the end goes on with the run; who looks at something else is left there.
        advance(world, 9)
        browser.until("fram.end === 9 && fram.time === 9 && !fram.dirty", "the page does not go on with the run")
        assert browser.run(STATE)["floes"] == world["floes"]
        browser.run("fram.seek(1)")
        advance(world, 12)
        browser.until("fram.end === 12", "the page does not go on with the run")
        assert browser.run("fram.time") == 1
        assert browser.run("fram.loads === undefined"), "loads of a run that goes on"
        recording.end()
        floes = world["floes"]
    browser.until("window.framEnded === true", "the page does not hear of the end")
    check_peak(browser, folder / "run")
    browser.run("(fram.seek(12), fram.draw())")
    state = browser.run(STATE)
    assert state["frames"] == 121 and state["floes"] == floes, (state, floes)
    assert state["broke"] > before["broke"] and state["born"] > 0, (before, state)
    assert chromium.colours(browser.picture()) > 50, "the picture is empty"
    assert not browser.complaints, browser.complaints
    print(f"{state['frames']} frames, {state['broke']} floes broke, {state['clock']}")


def main():
    if not chromium.path():
        skip("no chromium (tools/deps.sh --install views)")
    if "libmicrohttpd" not in subprocess.run([FRAM, "--version"], capture_output=True, text=True, check=True).stdout:
        skip("this build has no libmicrohttpd")
    page = SOURCE / "build/viewer/playback.html"
    if not page.exists():
        skip("the viewer's page is not there (make viewer)")
    sys.path.insert(0, str(SOURCE / "tests/python"))
    import package  # which looks for the package `fram`
    assert package.SOURCE == SOURCE
    with tempfile.TemporaryDirectory(prefix="fram-live-") as folder, chromium.Browser() as browser:
        check(browser, pathlib.Path(folder), page)


main()

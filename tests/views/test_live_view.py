#!/usr/bin/env python3
"""A run that goes on, looked at in headless Chromium by its live view; stepped here, so that the page is looked at when
the run stands still.

The page must show frames while the run goes, go on with it, know floes that broke off meanwhile, and play the whole
run afterwards, with nothing to complain of.  The record is then given frame by frame, and cut where it should not
matter, to a page that is looked at each time.  What
goes wrong is told, also where nothing can be drawn.  Skipped (77) without Chromium, libmicrohttpd or the viewer's page.
"""
import base64
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile

import chromium

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from skipping import skip  # noqa: E402  (tests is no package)

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


# Of a page that has just got a frame; the camera is the one that follows.
SHOWN = """(fram.prepare(), (() => {
    const centre = fram.camera.centre(), at = fram.camera.controls.target, { forces, marked } = fram.legend.content;
    const pulls = fram.poses.forces.map((f) => Math.hypot(...f.force));
    return { time: fram.time, end: fram.end, off: Math.hypot(at.x - centre.x, at.y - centre.y),
             longest: fram.colours.arrowScale * Math.max(0, ...pulls), kinds: fram.poses.forces.map((f) => f.kind),
             named: forces, broke: fram.record.fractures.length, marked, born: fram.record.bodies.length,
             text: document.getElementById('history').innerText, told: fram.history.sorted?.at(-1)?.time }; })())"""
FRAME = 15  # type of the block of a frame, src/io/record_layout.h


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


def frames_of(record):
    """Of each frame: where its payload ends, and where the zeros after it do (src/io/record.h)."""
    at, ends = 24, []
    while at < len(record):
        kind, size = struct.unpack_from("<IQ", record, at + 4)
        end = at + 24 + (size + 7) // 8 * 8
        if kind == FRAME:
            ends.append((at + 24 + size, end))
        at = end
    return ends


def follow(browser, folder, page):
    """A page that waits for what the page around it gives: no server."""
    alone = folder / "follows.html"
    alone.write_text(page.read_text().replace("<!--BESIDE-->", "").replace("<!--RECORD-->", ""))
    browser.call("Page.navigate", url=alone.as_uri())
    browser.until("location.pathname.endsWith('follows.html') && window.framAppend", "the page follows nothing")


def give(browser, data):
    text = base64.b64encode(data).decode()
    browser.run(f"framAppend(Uint8Array.from(atob('{text}'), (c) => c.charCodeAt(0)).buffer)")


def check_frames(browser, folder, page, broken):
    """Frame by frame, the view at the end: the camera stays with the ship, arrows have a length and a name as soon as
    there are forces, marks are explained with the first one, and what is told of a floe that breaks goes on with it."""
    record = (folder / "run" / "record.fram").read_bytes()
    ends = [end for _, end in frames_of(record)][:61]
    follow(browser, folder, page)
    give(browser, record[:ends[0]])
    browser.until("window.fram?.ready === true", "the page does not get ready")
    browser.run("fram.scene.render = () => {}")  # what is looked at here is what is drawn, not how
    browser.run(f"fram.pick(fram.record.bodies.find((b) => b.number === {broken}))")
    seen = [browser.run(SHOWN)]
    for begin, end in zip(ends, ends[1:]):
        give(browser, record[begin:end])
        seen.append(browser.run(SHOWN))
    assert all(s["time"] == s["end"] for s in seen) and seen[-1]["born"] > seen[0]["born"], seen[-1]
    away = max(seen, key=lambda s: s["off"])
    assert away["off"] < 0.01, f"the camera that follows is {away['off']} m off the ship at {away['time']} s"
    assert all(set(s["kinds"]) <= set(s["named"]) for s in seen), "arrows without a name"
    assert any(s["kinds"] for s in seen[:20]) and not seen[0]["kinds"], "ice is to be met soon, and not at once"
    longest = max(seen, key=lambda s: s["longest"])
    # 24 m is the length of the 99th percentile, which may double; one hard blow may be longer.
    assert longest["longest"] < 300, f"an arrow of {longest['longest']} m at {longest['time']} s"
    assert all((s["broke"] > 0) == (s["marked"] > 0) for s in seen), "marks without a word, or a word without marks"
    alive = [s for s in seen if "to the end" in s["text"]]
    assert 10 < len(alive) < len(seen) and all(f"Floe {broken}" in s["text"] for s in seen), len(alive)
    assert all(s["told"] == s["end"] for s in alive[1:]), "curves of a picked floe do not go on with the run"
    assert "broke at" in seen[-1]["text"], seen[-1]["text"]


def check_cuts(browser, folder, page):
    """An answer may end anywhere: between the payload of a frame and the zeros after it, and within these too."""
    record = (folder / "run" / "record.fram").read_bytes()
    frames = frames_of(record)
    cuts = [cut for payload, end in frames if end - payload > 1 for cut in (payload, end - 1)][:20]
    assert len(cuts) > 4, "no frame has zeros after it"
    follow(browser, folder, page)
    for begin, end in zip([0, *cuts], [*cuts, len(record)]):
        give(browser, record[begin:end])
    count = browser.run("fram.record.frames.length")
    assert count == len(frames), f"{count} of {len(frames)} frames of a record that came in {len(cuts) + 1} pieces"


def check_no_drawing(browser, folder, page):
    """Without WebGL or JavaScript the page says so and offers no buttons, also after a run that was followed."""
    told = "['#note', '#waiting', 'footer'].map((q) => document.querySelector(q)).map((e) => e.offsetHeight > 0 && " \
        "e.textContent)"
    script = browser.call("Page.addScriptToEvaluateOnNewDocument", source="HTMLCanvasElement.prototype.getContext = "
                          "((known) => function (kind, ...more) { return kind.startsWith('webgl') ? null : "
                          "known.call(this, kind, ...more); })(HTMLCanvasElement.prototype.getContext)")["identifier"]
    run = folder / "run"
    subprocess.run([FRAM, "view", run, "--page", page, "--quiet"], check=True)
    record = base64.b64encode((run / "record.fram").read_bytes()).decode()
    live = f"framAppend(Uint8Array.from(atob('{record}'), (c) => c.charCodeAt(0)).buffer), framEnd()"
    for file, then in (run / "playback.html", ""), (folder / "follows.html", live):
        browser.call("Page.navigate", url=file.as_uri())
        browser.until(f"location.pathname.endsWith('{file.name}') && (window.fram || window.framEnd)",
                      "the page does not load")
        browser.run(then)
        note, *others = browser.run(told)
        assert note and note.startswith("This browser has no WebGL 2") and others == [False, False], (note, others)
    browser.call("Page.removeScriptToEvaluateOnNewDocument", identifier=script)
    browser.complaints = [c for c in browser.complaints if "THREE.WebGLRenderer" not in c]
    browser.call("Emulation.setScriptExecutionDisabled", value=True)
    browser.call("Page.navigate", url=(run / "playback.html").as_uri())
    browser.until("document.querySelector('noscript .note')?.offsetHeight > 0", "nothing is told without JavaScript")
    assert browser.run(told) == [False] * 3, browser.run(told)
    browser.call("Emulation.setScriptExecutionDisabled", value=False)


def check_answers(browser, folder, page):
    """The first thing that goes wrong with what a page asks for is told, and stays told when the run has ended."""
    asks = folder / "asks.html"
    asks.write_text(page.read_text().replace("<!--BESIDE-->", "record").replace("<!--RECORD-->", ""))
    for answer, text in (("Promise.reject()", "The run has ended, or does not answer."),
                         ("new Response('no record, for all it has')",
                          "The record cannot be played: this is not a record of Fram")):
        script = browser.call("Page.addScriptToEvaluateOnNewDocument", source=f"window.fetch = async () => {answer}")
        browser.call("Page.navigate", url=asks.as_uri())
        browser.until("location.pathname.endsWith('asks.html') && window.framEnded", "the page asks on")
        told = browser.run("document.getElementById('note').textContent")
        assert told == text, told
        browser.call("Page.removeScriptToEvaluateOnNewDocument", identifier=script["identifier"])


def check(browser, folder, page):
    import fram
    addresses = []
    with fram.Scenario.from_text(SCENE).world() as world:
        recording = world.record(folder / "run", live_page=page, live=addresses.append)
        advance(world, 3)
        browser.call("Page.navigate", url=addresses[0])
        browser.until("window.fram?.ready === true", "the page does not get ready")
        browser.until("fram.end === 3 && fram.time === 3 && !fram.dirty", "the page does not show what there is")
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
    broken = browser.run("fram.record.fractures.find((f) => f.time > 3 && fram.record.bodies.some("
                         "(b) => b.number === f.floe && b.birth === 0)).floe")
    check_frames(browser, folder, page, broken)
    check_cuts(browser, folder, page)
    check_no_drawing(browser, folder, page)
    check_answers(browser, folder, page)
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

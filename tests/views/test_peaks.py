#!/usr/bin/env python3
"""Loads in the playback page, in headless Chromium: the curve by mechanism, a click on a peak, pressure on the hull.

What the page shows is held against series.csv, fram why and fram pressure, and looked for in the pixels.  Also a run
with two vessels, one that meets no ice, and a record of an earlier layout.  Skipped (77) without Chromium or without
the viewer's page.
"""
import base64
import csv
import json
import math
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zlib

import chromium

FRAM = os.environ["FRAM"]
SOURCE = pathlib.Path(os.environ["FRAM_SOURCE"])
PAGE = SOURCE / "build" / "viewer" / "playback.html"
# In coordinates of a map, where floats are a decimetre apart: the page counts from the middle of the domain.
MIDDLE = (-1400000, 2000000)
TOWED = """
title: Peaks
run: {duration: 8, time_step: 0.02, transient: 0.5}
vessel:
  mode: towed
  x: -1400036
  y: 2000000
  speed: 4
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
ice: {mean_floe_area: 64, concentration: 0.8}
domain: {x_min: -1400080, x_max: -1399920, y_min: 1999970, y_max: 2000030}
output: {frame_interval: 0.5}
"""
TWO = """
title: Two
run: {duration: 4, time_step: 0.02}
vessels:
  - {name: gone, present: false}
  - {name: first, mode: towed, x: -20, y: -15, speed: 4, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
  - {name: second, mode: towed, x: -60, y: 20, speed: 3, hull: {length: 36, beam: 10, draught: 3, freeboard: 2}}
ice: {mean_floe_area: 64, concentration: 0.7}
domain: {x_min: -84, x_max: 64, y_min: -45, y_max: 45}
"""
OPEN_WATER = """
title: No ice to meet
run: {duration: 2, time_step: 0.02}
vessel: {mode: towed, x: -20, speed: 0.1, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
ice: {mean_floe_area: 64, concentration: 0.3}
domain: {x_min: -64, x_max: 96, y_min: -40, y_max: 40}
"""
# A sheet that drifts into the domain.
LATER = """
run: {duration: 2, time_step: 0.02}
vessel: {mode: towed, x: -30, speed: 1, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
ice: {source: level, level: {x_min: 180, tile_size: 16}}
domain: {x_min: -200, x_max: 120, y_min: -40, y_max: 40, boundary: feeding, drift_speed: 40, drift_direction_deg: 180}
output: {frame_interval: 0.5}
"""


def fram(*arguments, check=True):
    return subprocess.run([FRAM, *arguments], check=check, capture_output=True, text=True)


def make_run(folder, name, scene):
    (folder / f"{name}.yaml").write_text(scene)
    fram("run", folder / f"{name}.yaml", "-o", folder / name, "--quiet")
    fram("view", folder / name, "--page", PAGE, "--quiet")
    with open(folder / name / "series.csv", newline="") as file:
        return folder / name, [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def check_curve(browser, rows, prefix="", vessel=0):
    """Every point is a moment of the series, its parts add up to the averaged load there, and no peak is lost."""
    told = browser.run(f"fram.record.loads.vessels[{vessel}]")
    x, y = (f"{prefix}ice_force_averaged_{c}[N]" for c in "xy")
    load = {round(r["time[s]"], 6): math.hypot(r[x], r[y]) for r in rows}
    most = max(load.values())
    assert most > 1e4 and abs(max(told["load"]) - most) < 1e-4 * most, (max(told["load"]), most)
    for k, time in enumerate(told["time"]):
        assert abs(told["load"][k] - load[round(time, 6)]) < 2e-4 * most, (time, told["load"][k])
        assert abs(sum(p[k] for p in told["parts"]) - told["load"][k]) < 2e-4 * most, time


def click_peak(browser, rank):
    """As a user does, on the number over the curve."""
    left, top, _, height = browser.box("timeline")
    x = browser.run(f"fram.timeline.x(fram.peaks.vessel.peaks[{rank - 1}].time)")
    browser.click(left + x, top + height / 2)
    browser.run("fram.draw()")


def check_click(browser, run):
    why = json.loads(fram("why", run, "--peak", "2", "--no-rerun", "--json").stdout.splitlines()[-1])
    sentence = fram("why", run, "--peak", "2", "--no-rerun").stdout.splitlines()[2]
    pixel = """((n) => { const b = fram.record.bodies.find((b) => b.number === n), k = 7 * b.index;
        const p = fram.scene.camera.position.clone().set(...fram.poses.pose.subarray(k, k + 3));
        p.project(fram.scene.camera); fram.scene.render();
        const gl = fram.scene.renderer.getContext(), out = new Uint8Array(4);
        gl.readPixels((p.x + 1) / 2 * gl.drawingBufferWidth, (p.y + 1) / 2 * gl.drawingBufferHeight, 1, 1, gl.RGBA,
                      gl.UNSIGNED_BYTE, out);
        return [...out].slice(0, 3); })"""
    browser.choose("camera", "top")
    browser.run(f"(fram.seek({why['time']}), fram.draw())")
    floe = why["floes"][0]["floe"]
    before = browser.run(f"{pixel}({floe})")
    browser.run("(fram.seek(0), fram.draw())")
    click_peak(browser, 2)
    assert abs(browser.run("fram.time") - why["time"]) < 1e-9, "a click on a peak does not lead there"
    text = browser.run("document.getElementById('peak').innerText")
    assert "Peak 2 of " in text and sentence in text, (text, sentence)
    known = {f["floe"] for f in why["floes"]} | {link["floe"] for f in why["floes"] for link in f["chain"]}
    lit = browser.run("fram.peaks.bodies.map(([b]) => b.number)")
    assert set(lit) == {n for n in known if n >= 0} and lit, (lit, known)
    after = browser.run(f"{pixel}({floe})")
    assert sum(abs(a - b) for a, b in zip(before, after)) > 40, f"floe {floe} is not lit: {before}, {after}"
    links = sum(max(len(f["chain"]) - 1, 0) for f in why["floes"])
    assert browser.run("fram.scene.peakArrows.shafts.count") == links + len(why["floes"])
    ends = [line["to"] for line in browser.run("fram.peaks.lines(1e-6, 1)") if line["colour"] != "#111111"]
    hull, points = browser.run("[...fram.camera.centre()]"), [f["point"] for f in why["floes"]]
    assert all(math.dist(end[:2], hull[:2]) < 30 for end in ends), (hull, ends)
    for end, point in zip(ends, points, strict=True):
        assert all(abs(a + m - b) < 1e-9 for a, m, b in zip(end, (*MIDDLE, 0), point)), (end, point)
    assert not browser.run("fram.poses.forces.filter((f) => f.kind === 'ice').length && fram.scene.arrows.count")
    calls = browser.run("fram.scene.renderer.info.render.calls")
    assert calls <= 20, calls


def check_words(browser):
    """Ends of chains and colours of mechanisms are those of `fram why` and of the report's chart."""
    told = (SOURCE / "src/model/mechanism.h").read_text(encoding="utf-8")
    ends = re.findall(r'X\(\w+, "(\w+)", "([^"]+)"\)', told[told.index("define CHAIN_ENDS"):])
    for name, text in ends:
        panel = browser.run(f"""(() => {{
            const {{ peaks }} = fram, [peak] = peaks.vessel.peaks, [floe] = peak.detail.floes;
            const link = {{ ...floe.chain[0], place: floe.point, push: [1000, 0, 0] }};
            const floes = [{{ ...floe, chain: [link, link], end: '{name}' }}];
            peaks.open({{ ...peak, detail: {{ ...peak.detail, floes }} }});
            return document.getElementById('peak').innerText; }})()""")
        assert f": {text}." in panel, f"the end {name} of a chain is {text!r}: {panel}"
    browser.run("fram.peaks.open(fram.peaks.vessel.peaks[1])")
    told = (SOURCE / "src/io/palette.c").read_text(encoding="utf-8")
    told = told[told.index("palette_lines"):]
    palette = re.findall(r"\{(0\.\d+), (0\.\d+), (0\.\d+)\}", told[:told.index(";")])
    drawn = [[int(c[k:k + 2], 16) for k in (1, 3, 5)] for c in browser.run("fram.loads.colours")]
    assert len(ends) == 9 and len(drawn) == 8 == len(palette), (ends, drawn, palette)
    for page, chart in zip(drawn, palette):
        assert all(abs(p - 255 * float(c)) < 0.51 for p, c in zip(page, chart)), (page, chart)


def check_odd_clicks(browser):
    """Round all peaks, away from one and back, twice on the same, beside the curve, let go."""
    count = browser.run("fram.peaks.vessel.peaks.length")
    seen = set()
    for _ in range(count):
        browser.click_on("smaller")
        seen.add(browser.run("fram.peaks.peak.rank"))
    assert len(seen) == count > 1, seen
    click_peak(browser, 1)
    click_peak(browser, 1)
    assert browser.run("fram.peaks.peak.rank === 1 && fram.peakShown")
    of_ice = "fram.legend.rows.forces.flat().some(([, name]) => name === 'ice')"
    assert browser.run(f"!{of_ice}"), "the legend has the colour of forces that a lit peak hides"
    browser.run("(fram.seek(fram.peaks.peak.time < 4 ? 8 : 0), fram.draw())")
    assert browser.run("!fram.peakShown && !fram.scene.lit.fill.visible && fram.scene.peakArrows.shafts.count === 0 && "
                       f"!document.getElementById('peak').hidden && {of_ice}"), \
        "what was a peak stays lit when time goes on"
    browser.click_on("gotopeak")
    browser.run("fram.draw()")
    assert browser.run("fram.peakShown")
    left, top, width, height = browser.box("timeline")
    browser.click(left + width - 1, top + height - 1)
    browser.click(left + 1, top + 1)
    browser.click_on("letgo")
    # Without a mouse: Enter on the timeline opens the peak that is nearest.
    browser.run("(fram.seek(fram.peaks.vessel.peaks[1].time + 0.01), document.getElementById('timeline').focus())")
    for kind in ("keyDown", "keyUp"):
        browser.call("Input.dispatchKeyEvent", type=kind, code="Enter", key="Enter", windowsVirtualKeyCode=13)
    assert browser.run("fram.peaks.peak?.rank") == 2, "Enter opens no peak"
    browser.click_on("letgo")
    browser.run("fram.draw()")
    assert browser.run("document.getElementById('peak').hidden && fram.peaks.peak === null && !fram.peakShown")


def check_keys(browser):
    """Without a mouse: the button that has the focus keeps it, Escape closes and leads back to the timeline."""
    def press(code, text=""):
        browser.call("Input.dispatchKeyEvent", type="keyDown", code=code, key=code, text=text,
                     windowsVirtualKeyCode={"Enter": 13, "Escape": 27}[code])
        browser.call("Input.dispatchKeyEvent", type="keyUp", code=code, key=code)
    browser.run("(fram.peaks.open(fram.peaks.vessel.peaks[0]), document.getElementById('smaller').focus())")
    count = browser.run("fram.peaks.vessel.peaks.length")
    for rank in [*range(2, count + 1), 1]:  # after the last comes the first
        press("Enter", "\r")
        told = browser.run("[fram.peaks.peak.rank, document.activeElement.id]")
        assert told == [rank, "smaller"], f"after Enter on the button for smaller peaks: {told}"
    press("Escape")
    told = browser.run("[fram.peaks.peak, document.getElementById('peak').hidden, document.activeElement.id]")
    assert told == [None, True, "timeline"], told


def check_finger(browser):
    """The timeline is dragged with a finger; the browser scrolls and goes nowhere for that."""
    left, top, width, height = browser.box("timeline")
    browser.run("fram.seek(0)")
    browser.call("Emulation.setTouchEmulationEnabled", enabled=True)
    for k in range(11):
        at = {"x": left + width * (0.1 + 0.07 * k), "y": top + height / 2}
        browser.call("Input.dispatchTouchEvent", type="touchMove" if k else "touchStart", touchPoints=[at])
    browser.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
    browser.call("Emulation.setTouchEmulationEnabled", enabled=False)
    time = browser.run("fram.time / fram.timeline.span")
    assert abs(time - 0.8) < 0.01, f"a finger leads to {time} of the timeline, not 0.8"


def check_print(browser):
    """On paper is what the view shows: drawing begins anew on a canvas that has changed its size, which is not waited
    for; on a screen with finer pixels too, and back from there."""
    size = {name: browser.run(f"inner{name.title()}") for name in ("width", "height")}
    print_view(browser)
    for ratio in (2, 1):
        browser.call("Emulation.setDeviceMetricsOverride", **size, deviceScaleFactor=ratio, mobile=False)
        browser.until(f"fram.scene.renderer.getPixelRatio() === {ratio}", f"the view is not drawn for {ratio} pixels")
        print_view(browser)
    browser.call("Emulation.clearDeviceMetricsOverride")


def print_view(browser):
    paper = base64.b64decode(browser.call("Page.printToPDF", landscape=True, printBackground=True)["data"])
    images = [zlib.decompressobj().decompress(paper[head.end():])
              for head in re.finditer(rb"/Subtype ?/Image\b[^>]*/FlateDecode[^>]*>>\s*stream\r?\n", paper)]
    view = max(images, key=len)  # the legend and the timeline are smaller
    most = len({view[k:k + 3] for k in range(0, len(view), 291)})
    assert most > 30, f"the view on paper has {most} colours"


def check_low(browser, run):
    """A page seen at twice its size, a phone on its side and upright: the panel is clear of buttons and legend."""
    for width, height in ((640, 400), (844, 390), (420, 720)):
        browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                     mobile=False)
        browser.open(run / "playback.html")
        browser.run("(fram.peaks.open(fram.peaks.vessel.peaks[0]), fram.draw())")
        clear = browser.run("""(() => {
            const box = (q) => document.querySelector(q).getBoundingClientRect();
            const panel = box('#peak'), legend = box('#legend'), foot = box('footer').top, gone = box('#letgo');
            const apart = panel.right <= legend.left || panel.top >= legend.bottom;
            return [panel.bottom <= foot, legend.bottom <= foot, apart, gone.bottom <= panel.bottom]; })()""")
        assert clear == [True] * 4, f"at {width} x {height} pixels: panel, legend, apart, button to close: {clear}"
    browser.call("Emulation.clearDeviceMetricsOverride")


def check_pressure(browser, run):
    folder = run.parent / "pressure"
    fram("pressure", run, "-o", folder, "--panel", "3", "--quiet")
    fram("view", run, "--page", PAGE, "--pressure", folder, "-o", run / "pressure.html", "--quiet")
    with open(folder / "panels.csv", newline="") as file:
        panels = list(csv.DictReader(file))
    browser.open(run / "pressure.html")
    told = browser.run("({ ...fram.record.pressure, mean: [...fram.record.pressure.mean], "
                       "largest: [...fram.record.pressure.largest] })")
    for key, column in (("mean", "pressure_mean[Pa]"), ("largest", "pressure_largest[Pa]")):
        expected = [float(p[column]) for p in panels]
        assert all(abs(a - b) <= 1e-6 * max(expected) for a, b in zip(told[key], expected)) and max(expected) > 0
    # The panels lie on the hull: its box is theirs.
    boxes = browser.run("""(() => { const box = (c, n) => { const lo = [9e9, 9e9, 9e9], hi = [-9e9, -9e9, -9e9];
        for (let i = 0; i < n; i++) { lo[i % 3] = Math.min(lo[i % 3], c[i]); hi[i % 3] = Math.max(hi[i % 3], c[i]); }
        return [...lo, ...hi]; };
        const { corner } = fram.record.pressure, { vertices } = fram.hull;
        return [box(corner, corner.length), box(vertices, vertices.length)]; })()""")
    assert all(abs(a - b) < 1e-3 for a, b in zip(*boxes)), boxes
    for which, column in (("largest", "pressure_largest[Pa]"), ("mean", "pressure_mean[Pa]")):
        browser.choose("hull", which)
        browser.run("fram.draw()")
        met = sorted(float(p[column]) for p in panels if float(p[column]) > 0)
        ends = browser.run("fram.legend.content.hull.ends")
        assert abs(ends[1] - met[int(0.99 * (len(met) - 1))] / 1000) < 1e-3 * ends[1], ends
        assert browser.run("fram.scene.pressure.mesh.visible")
    browser.choose("hull", "none")
    assert browser.run("!fram.scene.pressure.mesh.visible && fram.legend.content.hull === null")
    return folder


def check_two(browser, folder, pressure):
    run, rows = make_run(folder, "two", TWO)
    answer = fram("view", run, "--page", PAGE, "--pressure", pressure, check=False)
    assert answer.returncode == 2 and "another scenario" in answer.stderr, answer
    browser.open(run / "playback.html")
    for v, name in enumerate(("first", "second")):
        browser.choose("vessel", str(v))
        check_curve(browser, rows, f"{name}.", v)
        assert browser.run("fram.timeline.vessel.name") == name
        click_peak(browser, 1)
        assert browser.run("fram.peaks.peak.detail.floes.length > 0 && fram.peakShown"), name
        off = browser.run(f"""(() => {{ const hull = fram.record.bodies.filter((b) => b.material === 'hull')[{v}];
            const {{ target }} = fram.camera.controls, [x, y] = fram.poses.pose.subarray(7 * hull.index);
            const length = Math.max(...hull.vertices.filter((_, i) => i % 3 === 0));
            return [Math.hypot(x - target.x, y - target.y), Math.abs(length - {(24, 18)[v]})]; }})()""")
        assert max(off) < 3, f"the camera that goes along looks {off[0]} m beside {name}"
    assert not browser.run("document.getElementById('vessels').hidden")
    told = browser.run("document.getElementById('load').textContent")
    assert told.startswith("averaged ice force on first: X "), told
    check_phone(browser)
    # Without its loads, as a page of a run that goes on.
    told = browser.run("(() => { const t = fram.timeline; t.loads = null; t.drawCurve(900, 90, 1);"
                       "return t.canvas.ariaDescription; })()")
    assert told.startswith("ice load on first, averaged, at the frames; largest of them "), told
    browser.call("Emulation.setDeviceMetricsOverride", width=320, height=720, deviceScaleFactor=1, mobile=False)
    browser.until("document.documentElement.clientWidth === 320", "the window does not get narrow")
    cut = browser.run("(() => { const load = document.getElementById('load');"
                      "return [load, ...load.children].some((e) => e.scrollWidth > e.clientWidth); })()")
    assert not cut, f"on a phone the end is left out of {told!r}"
    check_smallest(browser)
    browser.call("Emulation.clearDeviceMetricsOverride")
    check_legend(browser)


def check_phone(browser):
    """On its side it has the whole caption in two lines, and room for the curve."""
    browser.call("Emulation.setDeviceMetricsOverride", width=667, height=375, deviceScaleFactor=1, mobile=False)
    browser.until("document.documentElement.clientHeight === 375", "the window does not get low")
    written = browser.run("(fram.timeline.events = [1, 2], fram.timeline.back = null, fram.draw(), "
                          "fram.timeline.written)")
    words, foot = " ".join(text for text, *_ in written), max(bottom for *_, bottom in written)
    assert "click one" in words and "orange: 2 breaks" in words, words
    assert browser.run("fram.timeline.canvas.clientHeight") - foot > 55, written


def check_smallest(browser):
    """Whatever the size of a window the buttons begin in it, the view has room over them, legend and what is told of a
    floe keep to that, and captions leave a low timeline to its curve."""
    browser.run("""(() => { const { vessel } = fram.timeline;
        fram.timeline.show(fram.loads, { ...vessel, name: 'a long name of a ship '.repeat(3) }); })()""")
    pick = "fram.pick(fram.record.bodies.find((b) => b.material === 'ice'))"
    browser.run(pick)
    for width, height in ((568, 320), (320, 568), (320, 200), (320, 256)):
        browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                     mobile=False)
        if height == 256:
            browser.call("Page.reload")
            browser.until("window.fram?.ready", "the page does not get ready")
            browser.run(pick)
        browser.until(f"document.documentElement.clientHeight === {height} && document.getElementById('view')"
                      ".clientHeight === fram.room().height", "the view does not take the room there is")
        browser.run("fram.draw()")
        play, view, foot, legend, told, folded, cut, scrolls = browser.run("""(() => {
            const panel = document.getElementById('history');
            return [...['#play', '#view', 'footer', '#legend', '#history'].map((q) => document.querySelector(q)
                .getBoundingClientRect()).map((b) => [b.top, b.bottom]), document.body.className === 'folded',
                panel.scrollHeight > panel.clientHeight, getComputedStyle(panel).pointerEvents === 'auto']; })()""")
        assert view[1] >= 40 and abs(view[1] - foot[0]) <= 1 < play[0] - foot[0], (height, view, foot, play)
        assert told[0] + 20 < told[1] <= foot[0] and cut == scrolls, (width, height, told, foot, cut, scrolls)
        assert legend[1] <= foot[0] and folded == (height == 200), (height, legend, foot, folded)
        head = max(bottom for _, _, _, _, bottom in browser.run("fram.timeline.written"))
        high = browser.run("fram.timeline.canvas.clientHeight")
        assert high - head > 40, f"of {high} pixels captions take {head}"


def check_legend(browser):
    """All kinds of forces at once, and the longest row of a station, stand within the legend."""
    rows = browser.run("""(() => {
        const { legend } = fram, station = [[['#000', 'mooring line'], ['#000', 'propeller, thruster']]];
        const content = legend.content;
        legend.set({ ...content, forces: ['ice'], station: [] });
        const before = legend.height;
        legend.set({ ...content, forces: ['ice', 'line', 'thruster', 'hull'], station });
        const ends = [...legend.rows.forces, ...legend.rows.station].map((row) => 12 + row.reduce((x, [, name]) =>
            x + 14 + legend.measure.measureText(name).width + 12, -12));
        const out = [ends, legend.width, legend.height - before];
        legend.set(content);
        return out; })()""")
    ends, width, taller = rows
    assert len(ends) == 4 and max(ends) <= width - 12, (ends, width)
    assert taller == 3 * 18, taller


def check_few_rows(browser, folder):
    """A series that leaves out steps and goes on after the last frame: the curve still has every peak, whole and on
    the canvas, and a part that changes its side leaves no gap."""
    run, rows = make_run(folder, "rows", TOWED.replace("interval: 0.5}", "interval: 3, csv_interval: 0.3}"))
    browser.open(run / "playback.html")
    told = browser.run("fram.record.loads.vessels[0]")
    most = max(p["detail"]["load"] for p in told["peaks"])
    assert len(rows) < 30 and abs(max(told["load"]) - most) < 1e-4 * most, (len(rows), max(told["load"]), most)
    for peak in told["peaks"]:
        k = min(range(len(told["time"])), key=lambda k: abs(told["time"][k] - peak["detail"]["time"]))
        assert abs(told["time"][k] - peak["detail"]["time"]) < 1e-6
        assert abs(told["load"][k] - peak["detail"]["load"]) < 1e-4 * most
    for k, load in enumerate(told["load"]):
        assert abs(sum(p[k] for p in told["parts"]) - load) < 2e-4 * most, told["time"][k]
    assert told["time"] == sorted(told["time"])
    assert browser.run("fram.end") == 6
    at, width = browser.run("[fram.timeline.x(fram.timeline.vessel.time.at(-1)), fram.timeline.canvas.clientWidth]")
    assert at <= width, f"the curve ends at {at} of {width} pixels"
    changed = sum(min(p) < 0 < max(p) for p in told["parts"])
    assert changed > 0, "no part changes its side: too little for this test to tell"
    assert browser.run("fram.timeline.bands.every(({ low, high }) => { const all = [...low, ...high];"
                       "return all.every((v) => v >= 0) || all.every((v) => v <= 0); })"), "a band changes its side"
    assert browser.run("fram.timeline.vessel.peaks.every((p) => { const y = fram.timeline.y(p.load, 132, 40);"
                       "return y >= 39.9 && y <= 132; })")
    # Of a series without rows there are the peaks alone.
    before, without = browser.run("""(() => { const { timeline, loads } = fram, { vessel, canvas } = timeline;
        const rows = { time: [], load: [], parts: vessel.parts.map(() => []) }, out = [];
        for (const shown of [vessel, { ...vessel, ...rows }]) {
            timeline.show(loads, shown);
            fram.draw();
            out.push(canvas.ariaDescription);
        }
        return out; })()""")
    assert without == before and "largest" in before, (before, without)


def check_narrow(browser, run):
    """In a window of 420 pixels the whole caption is there, and no text of the timeline lies on another."""
    browser.call("Emulation.setDeviceMetricsOverride", width=420, height=720, deviceScaleFactor=1, mobile=False)
    browser.open(run / "playback.html")
    browser.run("fram.draw()")
    width, written, numbers = browser.run(
        "[document.getElementById('timeline').clientWidth, fram.timeline.written, fram.timeline.numbers]")
    assert width < 420 and len(numbers) > 1, (width, numbers)
    words = " ".join(text for text, *_ in written)
    assert "averaged over" in words and "click one" in words and "8 s" in words, words
    assert len({top for text, _, top, *_ in written}) > 2, f"the caption takes no second line: {written}"
    for text, left, _, right, _ in written:
        assert left >= 0 and right <= width, f"{text!r} is cut off: {left} to {right} of {width}"
    for i, (text, left, top, right, bottom) in enumerate([*written, *numbers]):
        for other, l, t, r, b in written[:i]:
            assert right <= l or left >= r or bottom <= t or top >= b, f"{text!r} lies on {other!r}"
    browser.call("Emulation.clearDeviceMetricsOverride")


def check_no_ice(browser, folder):
    run, rows = make_run(folder, "water", OPEN_WATER)
    assert all(r["ice_force_x[N]"] == 0 for r in rows)
    browser.open(run / "playback.html")
    left, top, width, height = browser.box("timeline")
    browser.click(left + width / 2, top + height / 2)
    browser.run("fram.draw()")
    assert browser.run("fram.peaks.vessel.peaks.length === 0 && document.getElementById('peak').hidden")
    assert abs(browser.run("fram.time") - 1) < 0.02


def check_later_ice(browser, folder):
    """Ice that comes after the first frame: all of the domain is seen, and a page that follows the run sees as much."""
    run, _ = make_run(folder, "later", LATER)
    boxes = "[fram.scene.box, fram.scene.field].flatMap((b) => [b.min.x, b.max.x, b.min.y, b.max.y])"
    browser.open(run / "playback.html")
    births = browser.run("fram.record.bodies.filter((b) => b.material === 'ice').map((b) => b.birth)")
    assert births and min(births) > 0, f"ice is there from frame {births} on"
    whole = browser.run(boxes)
    assert whole[0] < -200 and whole[1] > 120 and whole[4] > -60 and whole[5] < 20, whole
    page = folder / "follows.html"
    page.write_text(PAGE.read_text().replace("<!--BESIDE-->", "").replace("<!--RECORD-->", ""))
    browser.call("Page.navigate", url=page.as_uri())
    browser.until("location.pathname.endsWith('follows.html') && window.framEnd", "the page follows nothing")
    data = base64.b64encode((run / "record.fram").read_bytes()).decode()
    browser.run(f"(() => {{ const bytes = Uint8Array.from(atob('{data}'), (c) => c.charCodeAt(0));"
                "for (let at = 0; !window.fram; at += 256) framAppend(bytes.slice(at, at + 256).buffer); })()")
    browser.until("window.fram.ready", "the page does not get ready")
    assert not browser.run("fram.record.bodies.some((b) => b.material === 'ice')"), "too much of the run is there"
    assert browser.run(boxes) == whole, (browser.run(boxes), whole)


def check_earlier_layout(run):
    """The type of the first block of bodies becomes that of an earlier layout."""
    path = run / "record.fram"
    data = bytearray(path.read_bytes())
    at = 24
    while struct.unpack_from("<I", data, at + 4)[0] != 7:
        at += 24 + (struct.unpack_from("<Q", data, at + 8)[0] + 7) // 8 * 8
    struct.pack_into("<I", data, at + 4, 3)
    struct.pack_into("<I", data, at + 20, zlib.crc32(data[at:at + 20]))
    path.write_bytes(data)
    answer = fram("view", run, "--page", PAGE, check=False)
    assert answer.returncode == 2 and "earlier" in answer.stderr and "record.fram" in answer.stderr, answer


def main():
    if not chromium.path() or not PAGE.exists():
        print("skipped: Chromium is not installed, or the viewer's page is not built (make viewer)")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as temporary, chromium.Browser() as browser:
        folder = pathlib.Path(temporary)
        run, rows = make_run(folder, "towed", TOWED)
        browser.open(run / "playback.html")
        check_curve(browser, rows)
        check_click(browser, run)
        check_words(browser)
        check_odd_clicks(browser)
        check_keys(browser)
        check_finger(browser)
        check_print(browser)
        pressure = check_pressure(browser, run)
        check_two(browser, folder, pressure)
        check_few_rows(browser, folder)
        check_narrow(browser, run)
        check_low(browser, run)
        check_no_ice(browser, folder)
        check_later_ice(browser, folder)
        check_earlier_layout(run)
        assert not browser.complaints, browser.complaints
    print("curves, peaks and pressure in the playback page are those of the run")


main()

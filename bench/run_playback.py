#!/usr/bin/env python3
"""Speed of the playback page with 10,000 floes, in headless Chromium: bench/results/playback.md.

Runs bench/playback.yaml, makes its page, plays it and seeks in it.  Ends with code 1 when a bound is broken:
8 ms of script a frame (95 of 100 frames), 20 draw calls, 0.5 s a seek.  Give --write to put the table into the results.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "tests" / "views"), str(HERE.parent / "tools")]
import chromium  # noqa: E402  (tests/views is no package)
import machine  # noqa: E402  (tools)

ABOUT = """# The playback page

`make bench-views` (`bench/run_playback.py`), {day}; {processor}, 2 cores of a shared virtual machine, nothing else
running; Chromium 156, headless, without a graphics card: SwiftShader draws on the processor. Script is what the page
itself computes for a frame (poses, colours, arrows, legend, timeline), measured in every frame of three playbacks at
twice real time; the calls to WebGL are told apart, for they wait for the device when it is slower than the page. A
seek ends when the new picture can be read back. Bounds: 8 ms of script, 20 draw calls, 0.5 s a seek.

"""
MOST_SCRIPT, MOST_CALLS, MOST_SEEK = 8.0, 20, 0.5
PLAYS = 3
PLAY = """(async () => {
    const script = [], webgl = [], gl = fram.scene.renderer.getContext(), { scene } = fram;
    const prepare = fram.prepare.bind(fram), render = scene.render.bind(scene);
    fram.prepare = () => { const t = performance.now(), r = prepare(); script.push(performance.now() - t); return r; };
    scene.render = () => { const t = performance.now(); render(); webgl.push(performance.now() - t); };
    document.getElementById('speed').value = '2';
    fram.seek(0);
    const begin = performance.now();
    fram.toggle();
    while (fram.playing) await new Promise(requestAnimationFrame);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    const passed = performance.now() - begin;
    delete fram.prepare;
    delete scene.render;
    return { script, webgl, passed, calls: fram.scene.renderer.info.render.calls };
})()"""
# A seek ends when the drawn picture can be read back.
SEEK = """(() => {
    const gl = fram.scene.renderer.getContext(), out = [], lit = new Uint8Array(4);
    for (let i = 0; i < 24; i++) {
        const t = performance.now();
        fram.seek(fram.end * ((i * 7) % 24 + 0.37) / 24);
        fram.draw();
        gl.readPixels(gl.drawingBufferWidth / 2, gl.drawingBufferHeight / 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, lit);
        out.push(performance.now() - t);
    }
    return { seeks: out, lit: [...lit] };
})()"""
DEVICE = """(() => { const gl = fram.scene.renderer.getContext(), e = gl.getExtension('WEBGL_debug_renderer_info');
    return gl.getParameter(e ? e.UNMASKED_RENDERER_WEBGL : gl.RENDERER); })()"""


def at(values, part):
    return sorted(values)[min(len(values) - 1, int(part * len(values)))]


def play(browser):
    """A few playbacks as one: of some forty frames in one the system takes the time of two or three."""
    plays = [browser.run(PLAY) for _ in range(PLAYS)]
    together = {name: [value for p in plays for value in p[name]] for name in ("script", "webgl")}
    return {**together, "passed": sum(p["passed"] for p in plays), "calls": max(p["calls"] for p in plays)}


def measure(page):
    with chromium.Browser() as browser:
        begin = time.monotonic()
        browser.open(page)
        load = time.monotonic() - begin
        picture = chromium.colours(browser.picture())
        device = browser.run(DEVICE)
        floes = browser.run("fram.record.bodies.filter((b) => b.material === 'ice').length")
        view = browser.run("[fram.scene.renderer.domElement.width, fram.scene.renderer.domElement.height]")
        modes = []
        for colour, camera in (("plain", "orbit"), ("speed", "follow")):
            browser.choose("colour", colour)
            browser.choose("camera", camera)
            modes.append((f"{colour}, {camera}", play(browser), browser.run(SEEK)))
        assert not browser.complaints, browser.complaints
    return {"load": load, "picture": picture, "device": device, "floes": floes, "view": view, "modes": modes}


def table(m, size):
    lines = [f"{m['floes']} floes, page of {size / 1e6:.1f} MB, view of {m['view'][0]} x {m['view'][1]} pixels. "
             f"Loaded and drawn for the first time after {m['load']:.1f} s.", "",
             f"Drawn by: {m['device']}", "",
             "| colour, camera | script a frame: median ms | 95 % | largest | WebGL calls: median ms | 95 % | "
             "draw calls | seek: median ms | largest | frames/s drawn |", "|---|---|---|---|---|---|---|---|---|---|"]
    for name, play, seek in m["modes"]:
        script, seeks = play["script"], seek["seeks"]
        lines.append(f"| {name} | {at(script, 0.5):.1f} | {at(script, 0.95):.1f} | {max(script):.1f} | "
                     f"{at(play['webgl'], 0.5):.1f} | {at(play['webgl'], 0.95):.1f} | {play['calls']} | "
                     f"{at(seeks, 0.5):.0f} | {max(seeks):.0f} | {1000 * len(script) / play['passed']:.1f} |")
    return "\n".join(lines)


def broken(m):
    out = []
    for name, play, seek in m["modes"]:
        if at(play["script"], 0.95) > MOST_SCRIPT:
            out.append(f"{name}: {at(play['script'], 0.95):.1f} ms of script a frame")
        if play["calls"] > MOST_CALLS:
            out.append(f"{name}: {play['calls']} draw calls")
        if max(seek["seeks"]) > 1000 * MOST_SEEK:
            out.append(f"{name}: a seek takes {max(seek['seeks']):.0f} ms")
        if max(seek["lit"][:3]) == 0:
            out.append(f"{name}: the canvas is black")
    if m["picture"] < 100:
        out.append("the window is blank")
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fram", default=HERE.parent / "build" / "release" / "fram")
    parser.add_argument("--write", action="store_true", help="put the table into bench/results/playback.md")
    options = parser.parse_args()
    if not chromium.path():
        sys.exit("Chromium is not installed")
    with tempfile.TemporaryDirectory() as folder:
        run = pathlib.Path(folder) / "run"
        subprocess.run([options.fram, "run", HERE / "playback.yaml", "-o", run, "--quiet"], check=True)
        subprocess.run([options.fram, "view", run, "--quiet"], check=True)
        page = run / "playback.html"
        m = measure(page)
        text = table(m, page.stat().st_size)
    print(text)
    if options.write:
        head = ABOUT.format(day=time.strftime("%Y-%m-%d"), processor=machine.processor())
        (HERE / "results" / "playback.md").write_text(head + text + "\n", encoding="utf-8")
    for complaint in broken(m):
        print("BROKEN: " + complaint)
    sys.exit(1 if broken(m) else 0)


main()

#!/usr/bin/env python3
"""Screenshots of the pages that people open, at two widths of the window:  make pictures

Runs half a minute of the demo, 40 s of the drillship, five minutes of the escort and a study of eight runs, makes
their pages (playback, report, comparison, ice management, study, a plot, the documents) and takes
docs/pictures/pages/NAME-WIDTH.png of each with headless Chromium, for eyes to look at, and the picture of pressure on
the hull that docs/results.md shows.  Needs `make viewer`.
"""

import pathlib
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "views"))
import chromium  # noqa: E402
from words import words_of  # noqa: E402

FRAM = ROOT / "build" / "release" / "fram"
OUT = ROOT / "docs" / "pictures" / "pages"
# Width and height of the windows: a laptop's, and the narrowest that is to be readable.
WINDOWS = ((1280, 800), (420, 800))
PRESSURE_WINDOW = (1000, 700)
RUNS = {
    "demo": ("demo.yaml", ["run.duration=30", "run.transient=10"], 25),
    "calm": ("drillship.yaml", ["run.duration=40", "run.transient=10"], None),
    # Until the tanker has sailed in the channel for a while.
    "escort": ("escort.yaml", ["run.duration=340"], None),
    "drillship": ("drillship.yaml", ["run.duration=40", "run.transient=10", "environment.wind_speed=12",
                                     "environment.wind_direction_deg=200"], 40),
}
STUDY = """scenario: {scene}
set: {{run.duration: 20, run.transient: 10}}
seeds: 2
vary:
  grid: {{ice.thickness: [0.8, 1.2], domain.drift_speed: [0.3, 0.5]}}
"""
# A hull that is large in its field, so that panels of a metre are seen.
PRESSED = """title: Pressure on a towed hull
run: {duration: 12, time_step: 0.02, transient: 2}
vessel: {mode: towed, x: -38, speed: 2, ramp: 1, hull: {length: 40, beam: 10, draught: 3, freeboard: 2}}
ice: {source: voronoi, concentration: 0.85, mean_floe_area: 50, thickness: 0.8}
domain: {x_min: -70, x_max: 40, y_min: -40, y_max: 40}
"""


def fram(*arguments):
    subprocess.run([FRAM, *arguments, "--quiet"], check=True)


def seen_at(time):
    return lambda browser: browser.run(f"(fram.seek({time}), fram.placeCamera(), fram.draw())")


def largest_peak(browser):
    """As a user clicks on the number over the curve."""
    left, top, _, height = browser.box("timeline")
    browser.click(left + browser.run("fram.timeline.x(fram.peaks.vessel.peaks[0].time)"), top + height / 2)
    browser.run("(fram.placeCamera(), fram.draw())")


def from_below(browser):
    """The bow, coloured by the largest pressure of the run."""
    browser.choose("camera", "below")
    browser.choose("hull", "largest")
    browser.choose("colour", "plain")
    seen_at(9)(browser)


def photograph(browser, page, window, file, prepare):
    width, height = window
    browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
    browser.call("Page.navigate", url=page.as_uri() + "#still")
    browser.until(f"location.pathname === {page.as_uri()[7:]!r} && document.readyState === 'complete'",
                  "the page does not load")
    if prepare:
        browser.until("window.fram?.ready === true", "the playback does not get ready")
        prepare(browser)
    time.sleep(0.5)
    browser.picture(file)
    print(file.relative_to(ROOT))


def take(browser, page, name, prepare):
    for window in WINDOWS:
        photograph(browser, page, window, OUT / f"{name}-{window[0]}.png", prepare)


def take_pressure(browser, made):
    (made / "pressed.yaml").write_text(PRESSED)
    fram("run", made / "pressed.yaml", "-o", made / "pressed", "--force")
    fram("pressure", made / "pressed", "-o", made / "pressure", "--force")
    fram("view", made / "pressed", "--pressure", made / "pressure", "-o", made / "pressure.html")
    photograph(browser, made / "pressure.html", PRESSURE_WINDOW, OUT.parent / "playback_pressure.png", from_below)


def study(folder):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "study.yaml").write_text(STUDY.format(scene=ROOT / "scenes" / "drillship.yaml"))
    fram("study", folder / "study.yaml", "-o", folder / "out")
    return folder / "out" / "study.html"


def pages_of_several(made):
    """What is made of more than one run, and of none: page by name."""
    # The page names the folders as they are given.
    subprocess.run([FRAM, "compare", "calm", "drillship", "-o", "compare.html", "--quiet", "--force"], cwd=made,
                   check=True, stdout=subprocess.DEVNULL)
    fram("manage", made / "escort", "--vessel", "tanker", "-o", made / "manage.html", "--force")
    fram("plot", made / "drillship", "ice_force_averaged_x", "ice_force_x", "line_tension_max", "offset_x", "-o",
         made / "plot.svg")
    fram("why", made / "demo", "--peak", "1", "--no-rerun", "-o", made / "why.png")
    subprocess.run([sys.executable, ROOT / "tools" / "site" / "site.py"], check=True, stdout=subprocess.DEVNULL)
    site = ROOT / "build" / "site"
    return {"compare": made / "compare.html", "manage": made / "manage.html", "plot": made / "plot.svg",
            "why": made / "why.png", "study": study(made / "study"), "site": site / "index.html",
            "station": made / "drillship" / "station.png"}


def main():
    words_of(__doc__).parse_args()
    OUT.mkdir(parents=True, exist_ok=True)
    made = ROOT / "out" / "pictures"
    with chromium.Browser(1400, 1000) as browser:
        for name, (scene, settings, at) in RUNS.items():
            run = made / name
            fram("run", ROOT / "scenes" / scene, "-o", run, "--force", *[w for s in settings for w in ("--set", s)])
            if at is None:
                continue
            fram("view", run)
            fram("report", run)
            take(browser, run / "playback.html", f"playback-{name}", seen_at(at))
            if name == "demo":
                take(browser, run / "playback.html", "peak-demo", largest_peak)
            take(browser, run / "report.html", f"report-{name}", None)
        take_pressure(browser, made)
        for name, page in pages_of_several(made).items():
            take(browser, page, name, None)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Screenshots of the pages that people open, at two widths of the window:  make pictures

Runs half a minute of the demo and 40 s of the drillship, makes their playback pages and reports, and takes
docs/pictures/pages/NAME-WIDTH.png of each with headless Chromium, for eyes to look at.  Needs `make viewer`.
"""

import pathlib
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "views"))
import chromium  # noqa: E402

FRAM = ROOT / "build" / "release" / "fram"
OUT = ROOT / "docs" / "pictures" / "pages"
# Width and height of the windows: a laptop's, and the narrowest that is to be readable.
WINDOWS = ((1280, 800), (420, 800))
RUNS = {
    "demo": ("demo.yaml", ["run.duration=30", "run.transient=10"], 25),
    "drillship": ("drillship.yaml", ["run.duration=40", "run.transient=10", "environment.wind_speed=12",
                                     "environment.wind_direction_deg=200"], 40),
}


def fram(*arguments):
    subprocess.run([FRAM, *arguments, "--quiet"], check=True)


def take(browser, page, name, prepare):
    for width, height in WINDOWS:
        browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                     mobile=False)
        browser.call("Page.navigate", url=page.as_uri() + "#still")
        browser.until(f"location.pathname === {page.as_uri()[7:]!r} && document.readyState === 'complete'",
                      "the page does not load")
        if prepare:
            browser.until("window.fram?.ready === true", "the playback does not get ready")
            browser.run(prepare)
        time.sleep(0.5)
        browser.picture(OUT / f"{name}-{width}.png")
        print(f"docs/pictures/pages/{name}-{width}.png")


def main():
    OUT.mkdir(parents=True, exist_ok=True)
    with chromium.Browser(1400, 1000) as browser:
        for name, (scene, settings, at) in RUNS.items():
            run = ROOT / "out" / "pictures" / name
            fram("run", ROOT / "scenes" / scene, "-o", run, "--force", *[w for s in settings for w in ("--set", s)])
            fram("view", run)
            fram("report", run)
            take(browser, run / "playback.html", f"playback-{name}",
                 f"(fram.seek({at}), fram.placeCamera(), fram.draw())")
            take(browser, run / "report.html", f"report-{name}", None)


if __name__ == "__main__":
    main()

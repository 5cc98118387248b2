"""Reports on a narrow window, as larger letters of the browser make it, and on paper: where figures stand, how many
columns there are, and what is moved sideways.

Skipped (77) without Chromium, and in a build without pictures.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import chromium  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))
from skipping import skip  # noqa: E402  (tests is no package)

FRAM = os.environ["FRAM"]
SCENE = """
run: {duration: 6, time_step: 0.02, seed: 4, transient: 1}
vessel:
  mode: free
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
  mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}
ice: {concentration: 0.8, mean_floe_area: 64, thickness: 0.4, breakable: true}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40, boundary: feeding, drift_speed: 2, drift_direction_deg: 200}
"""
# Of a sheet of A4 what its margins leave, at 96 pixels an inch.
PAPER = 688
LAYOUT = """(() => {
    const box = e => e.getBoundingClientRect(), main = document.querySelector('main') ?? document.body;
    return {page: document.documentElement.scrollWidth, left: box(main).left, right: box(main).right,
            figures: [...document.querySelectorAll('figure')].map(f => ({left: box(f).left, right: box(f).right,
                wide: f.className === 'wide', image: box(f.querySelector('img')).width,
                moved: f.scrollWidth - f.clientWidth, top: Math.round(box(f).top)}))};
})()"""


def layout(browser, page, width, media=""):
    browser.call("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)
    browser.call("Emulation.setEmulatedMedia", media=media)
    browser.call("Page.navigate", url=page.as_uri())
    browser.until("document.readyState === 'complete'", "the report is not loaded")
    return browser.run(LAYOUT)


def columns(seen):
    """The most figures that stand side by side."""
    tops = [f["top"] for f in seen["figures"]]
    return max(map(tops.count, tops))


def check_lines(seen):
    """Every figure begins and ends with the text or in its column."""
    middle = (seen["left"] + seen["right"]) / 2
    for figure in seen["figures"]:
        assert abs(figure["left"] - seen["left"]) < 1 or 0 < figure["left"] - middle < 20, (figure, seen["left"])
        assert abs(figure["right"] - seen["right"]) < 1 or 0 < middle - figure["right"] < 20, (figure, seen["right"])


def check_widths(browser, page):
    for width, expected in ((1280, 2), (640, 1), (320, 1)):
        seen = layout(browser, page, width)
        assert columns(seen) == expected and len(seen["figures"]) > 8, (width, columns(seen))
        assert seen["page"] <= width, f"at {width} pixels the page is {seen['page']} wide"
        check_lines(seen)
        assert all(f["image"] >= (900 if f["wide"] else 460) for f in seen["figures"]), (width, seen["figures"])
        assert any(f["moved"] > 0 for f in seen["figures"]) == (width < 1280), width


def check_paper(browser, page):
    seen = layout(browser, page, PAPER, "print")
    assert columns(seen) == 2, "on paper figures stand below each other"
    check_lines(seen)
    assert not any(f["moved"] > 0 or f["image"] > PAPER for f in seen["figures"]), seen["figures"]


def main():
    if not chromium.path():
        skip("Chromium is not installed")
    if "cairo" not in subprocess.run([FRAM, "--version"], capture_output=True, text=True, check=True).stdout:
        skip("this build draws no pictures")
    with tempfile.TemporaryDirectory() as folder, chromium.Browser() as browser:
        run = pathlib.Path(folder) / "run"
        (pathlib.Path(folder) / "scene.yaml").write_text(SCENE)
        subprocess.run([FRAM, "run", pathlib.Path(folder) / "scene.yaml", "-o", run, "-q"], check=True)
        subprocess.run([FRAM, "report", run, "-q"], check=True)
        check_widths(browser, run / "report.html")
        check_paper(browser, run / "report.html")


main()

"""What the playback page has a second time since a record has none of it: colours, words and sizes of the program."""
import os
import pathlib
import re
import shutil
import subprocess

SOURCE = pathlib.Path(os.environ["FRAM_SOURCE"])


def numbers_after(path, name):
    """Of the first pair of outer braces, brackets or the first value after `name =` in a source file."""
    found = re.search(rf"{name}(?:\[\d*\])? = ([\[{{].*?[\]}}];|[^,;]+)", (SOURCE / path).read_text(encoding="utf-8"),
                      re.DOTALL)
    return [float(n) for n in re.findall(r"\d+(?:\.\d+)?(?:e\d+)?", found[1])]


def check_units(legend):
    """Forces have the unit of their size by one rule, and no exponent."""
    unit = (SOURCE / "src/base/load_unit.c").read_text(encoding="utf-8")
    ends = [float(re.search(rf"{name} (\S+?)\)?\n", unit)[1]) for name in ("TOLD_PLAIN", "newton >=")]
    page = re.findall(r"kilonewton < (\S+)", legend[legend.index("function forceUnit"):].split("\n}")[0])
    assert [1000 * float(end) for end in page] == ends == [1e4, 1e7], (page, ends)
    wanted = {0: "0 kN", -2.9: "-2900 N", 0.0335: "33.5 N", 0.9996: "1000 N",
              9.641: "9641 N", 9.996: "10.0 kN", 999.6: "1000 kN",
              2500: "2500 kN", 9994: "9994 kN", 9996: "10.0 MN", 26134: "26.1 MN"}
    if shutil.which("node"):
        script = (f"import {{ forceText }} from '{SOURCE}/viewer/src/legend.js';"
                  f"console.log({list(wanted)}.map(forceText).join());")
        told = subprocess.run(["node", "--input-type=module", "-e", script], check=True, capture_output=True,
                              text=True).stdout.strip()
        assert told == ",".join(wanted.values()), told
        # Beside the largest of them: in its unit, but for what would have one digit left.
        wanted = {(3, 26100): "3000 N", (-0.29, 37000): "-290 N", (1500, 26100): "1.5 MN", (0, 26100): "0.0 MN",
                  (0, 0): "0 kN", (5, 9996): "5000 N", (0.005, 9): "5 N", (9999, 9999): "10.0 MN"}
        script = (f"import {{ forceTextBeside }} from '{SOURCE}/viewer/src/legend.js';"
                  f"console.log({[list(pair) for pair in wanted]}.map((pair) => forceTextBeside(...pair)).join());")
        told = subprocess.run(["node", "--input-type=module", "-e", script], check=True, capture_output=True,
                              text=True).stdout.strip()
        assert told == ",".join(wanted.values()), told


def check():
    """What the page cannot be told, since a record has none of it, is as the program has it."""
    page, image = numbers_after("viewer/src/colours.js", "STOPS"), "src/io/image.c"
    ramp = re.findall(r"\{(\d\.\d+), (\d\.\d+), (\d\.\d+)\}", (SOURCE / image).read_text(encoding="utf-8"))[:3]
    assert page == [float(v) for stop in ramp for v in stop] and len(page) == 9, (page, ramp)
    for path, names in ("src/sim/build_wash.c", ("SPACING", "DEPTH")), ("src/sim/build_propulsion.c", ("STERN",)):
        for name in names:
            assert numbers_after(path, name) == numbers_after("viewer/src/station.js", name), name
    assert numbers_after("src/sim/build_wash.c", "DISC_LOAD") == numbers_after("viewer/src/station.js",
                                                                              "DISC_PRESSURE")
    kinds = re.findall(r"RECORD_FORCE_(\w+)\] = \{\{([\d., ]+)\}, \"([^\"]+)\"",
                       (SOURCE / "src/results/video_scene.c").read_text(encoding="utf-8"))
    legend = (SOURCE / "viewer/src/legend.js").read_text(encoding="utf-8")
    check_units(legend)
    colours = dict(re.findall(r"(\w+): '#(\w+)'", legend[legend.index("FORCE_COLOURS"):].split("\n")[0]))
    words = dict(re.findall(r"(\w+): '([^']+)'", legend[legend.index("FORCE_WORDS"):].split("\n")[0]))
    assert len(kinds) == len(colours) == 4, (kinds, colours)
    mark = re.search(r"MARK = '#(\w+)'", legend)[1]
    kinds.append(("MARK", ", ".join(map(str, numbers_after("src/results/video_scene.c", "mark"))), "mark"))
    colours["mark"] = mark
    for kind, rgb, name in kinds:
        drawn = [int(colours[kind.lower()][k:k + 2], 16) / 255 for k in (0, 2, 4)]
        assert all(abs(a - float(b)) < 0.006 for a, b in zip(drawn, rgb.split(","))), (kind, drawn, rgb)
        assert words.get(kind.lower(), kind.lower()) == name, (kind, name)

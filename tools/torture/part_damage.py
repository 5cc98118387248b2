"""Damaged results: what reads a run or a study refuses a damaged file with its name, or does without it; never more."""

import json

import fixture
import mangle
from finding import Case

NAME = "damage"
SAYS = "a file of a run or of a study is damaged, then read by every command that reads one"
READERS = ("resume {run}", "report {run}", "view {run}", "export {run} --vtk", "export {run} --netcdf",
           "export {run} --geojson --time 0.4", "plot {run} ice_force_x -o p.png", "plot {run}", "compare {run} level",
           "video {run} --pictures -o frames", "why {run} --time 1.2", "why {run} --peak 1 --no-rerun",
           "pressure {run} -o pressed --panel 2", "manage {run} -o manage.html", "extremes {run}",
           "fatigue {run} --channel line_tension_max", "study list studied", "study study.yaml -o studied --jobs 1")


def hash_of(run):
    return json.loads((run / "run.json").read_text()).get("state_hash")


def case(rig, draw, folder):
    """One damage, one reader."""
    done = Case()
    work = fixture.copy(rig, folder / "work")
    words = draw.choice(READERS)
    run = work / ("half" if words.startswith("resume") else "studied" if words.startswith("study") else
                  draw.choice(("done", "half", "level")))
    files = run.rglob("*") if words.startswith("study") else run.iterdir()
    names = sorted(str(p.relative_to(run)) for p in files if p.is_file() and p.suffix != ".png")
    name = draw.choice(names)
    before = (run / name).read_bytes()
    data = mangle.mangle(draw, before) if draw.random() < 0.9 else None
    if data is None:
        (run / name).unlink()
    else:
        (run / name).write_bytes(data)
    outcome = rig.fram.call(*words.format(run=run.name).split(), "--json", folder=work)
    fault = outcome.fault(json_asked=True)
    if not fault and outcome.code == 0 and words.startswith("resume") and data != before:
        if name not in ("scenario.yaml",) and hash_of(run) != hash_of(work / "done"):
            fault = "goes on to another end with a damaged file"
    done.counts["done without it" if outcome.code == 0 else "refused"] += 1
    if fault:
        done.found(f"{words.split()[0]} {fault} ({name.split('-')[0]})", outcome,
                   {name.replace("/", "-"): data} if data is not None else {}, told=f"damaged: {run.name}/{name}")
    return done

"""Allocations, file calls and threads that fail at the n-th call, over all commands."""

import json
import os
import subprocess

import fixture
from finding import Case

NAME = "faults"
SAYS = "an allocation, a file call or a thread fails at its n-th call, once or from then on, over all commands"

# In a copy of the fixture's folder; each writes what it writes into that copy.
COMMANDS = (
    "run scene.yaml -o new --threads 2", "run level.yaml -o new --threads 1", "run packed.yaml -o new --threads 2",
    "resume half", "check scene.yaml", "check level.yaml --build", "bench scene.yaml --warm 0.1 --time 0.2",
    "view done", "export done --vtk", "export done --netcdf", "export done --geojson --time 0.6", "report done",
    "report level", "plot done ice_force_x roll -o plot.png", "plot done ice_force_x -o plot.svg", "plot done",
    "compare done level -o both.html", "video level --pictures -o frames", "hull hull.obj --draw hull.png -o out.stl",
    "hull --length 50 --beam 12 --draught 4 -o ship.obj",
    "field floes.geojson --bad repair -o clean.geojson --draw f.png",
    "field scene.yaml --table floes.csv --cover cover.png", "ice wedge --a-over-l 0.1",
    "ice break --force 3e5 --contact-area 0.2 --thickness 0.8 --flexural-strength 6e5", "keys",
    "study study.yaml -o made --jobs 2", "study study.yaml -o studied --jobs 1", "study check study.yaml",
    "study list studied", "extremes tension.csv --channel tension --draw levels.png",
    "fatigue done --channel line_tension_max -o cycles.csv", "manage done -o manage.html",
    "manage level --beside level -o manage.html", "why level --peak 1 -o why.png", "why done --peak 1 --no-rerun",
    "pressure level -o pressed --panel 2", "fmu scene.yaml -o scene.fmu",
    "capability scene.yaml -o held --formula --directions 4 --speed-step 0.5 --speed-most 1",
)
# Needs a page that only `make viewer` builds.
MAY_BE_ABSENT = ("view",)
# May have been meant for standard output, which then holds no JSON.
STREAMS = ("fputc", "fputs", "fprintf", "fwrite", "fflush", "fclose")
KINDS = ("memory", "memory", "files", "files", "files", "threads")


def shim(rig):
    """The preloaded library, compiled once."""
    def make(path):
        path = path.with_suffix(".so")
        subprocess.run([os.environ.get("CC", "cc"), "-std=gnu17", "-O1", "-fPIC", "-shared",
                        rig.root / "tools/torture/fault_shim.c", "-o", path, "-ldl"], check=True)
        return path
    return rig.once("fault_shim", make)


def environment(rig, kind, at, goes_on, report):
    """What makes a call of the command fail there."""
    return {"LD_PRELOAD": str(shim(rig)), "FRAM_FAULT_KIND": kind, "FRAM_FAULT_AT": str(at),
            "FRAM_FAULT_ON": "1" if goes_on else "0", "FRAM_FAULT_REPORT": str(report)}


def told(report):
    """(name of the call that failed or None, number of calls or None)"""
    hit, calls = None, None
    for line in report.read_text().splitlines() if report.exists() else ():
        word, _, rest = line.partition(" ")
        hit, calls = (rest if word == "hit" else hit), (int(rest) if word == "calls" else calls)
    return hit, calls


def plain(rig, words, kind, folder):
    """Without a failure: how many calls there are, and what the command leaves."""
    def make(_):
        fixture.copy(rig, folder)
        report = folder.parent / (folder.name + "-count")
        outcome = rig.fram.call(*words.split(), "--json", folder=folder,
                                environment=environment(rig, kind, 0, False, report))
        if outcome.code != 0 and words.split()[0] not in MAY_BE_ABSENT:
            raise RuntimeError(f"fram {words}: {outcome.err}")
        if outcome.code != 0:
            return 0, {}, ""
        return told(report)[1] or 0, fixture.contents(folder), outcome.err
    return rig.once(f"plain-{kind}-{words}", make)


def stays_running(folder):
    """The run that was to be made says that it is still running."""
    for name in ("new", "half"):
        try:
            if json.loads((folder / name / "run.json").read_text()).get("status") == "running":
                return True
        except (OSError, ValueError):
            continue
    return False


def inject(rig, words, kind, at, goes_on, folder):
    """One command with one failure: (outcome, name of the call or None, kind of fault or None, what to tell)."""
    calls, contents, err = plain(rig, words, kind, folder / "plain")
    work, report = fixture.copy(rig, folder / "work"), folder / "report"
    report.unlink(missing_ok=True)
    outcome = rig.fram.call(*words.split(), "--json", folder=work,
                            environment=environment(rig, kind, at, goes_on, report))
    hit, _ = told(report)
    note = f"{kind}: call {at} of {calls}, {hit}, fails{' and all after it' if goes_on else ''}"
    if hit is None:
        return outcome, None, None, note
    fault = outcome.fault(json_asked=not goes_on and hit not in STREAMS)
    if not fault and outcome.code == 0 and "warning" not in outcome.err.replace(err, ""):
        others = differences(contents, work, hit)
        if others:
            fault, note = "hides a failure", note + "; other than without it: " + ", ".join(others[:5])
    if not fault and not goes_on and outcome.code != 0 and stays_running(work):
        fault = "leaves run.json at \"running\""
    return outcome, hit, fault, note


def differences(contents, work, hit):
    """Names of files that are other ones than without the failure."""
    try:
        now = fixture.contents(work)
    except ValueError as problem:
        return [str(problem)]
    # What could not be removed stays, and harms nobody; an old checkpoint that was not listed is not removed, nor what
    # a study does not keep of its runs.
    names = set(contents) if hit == "unlink" else set(contents) | set(now)
    names = {n for n in names if n in contents or "/runs/" not in n}
    if hit in ("opendir", "readdir"):
        names = {n for n in names if n in contents or "/checkpoint-" not in n}
    return [n for n in sorted(names) if contents.get(n) != now.get(n)]


def case(rig, draw, folder):
    """One command with one failure."""
    done = Case()
    words, kind, goes_on = draw.choice(COMMANDS), draw.choice(KINDS), draw.random() < 0.3
    calls, _, _ = plain(rig, words, kind, folder / "plain")
    if calls == 0:
        done.counts["had no such call"] += 1
        return done
    outcome, hit, fault, note = inject(rig, words, kind, draw.randint(1, calls), goes_on, folder)
    if hit is None:
        done.counts["ended before the failure"] += 1
        return done
    done.counts["told the failure" if outcome.code else "did without"] += 1
    if fault:
        done.found(f"{words.split()[0]} {fault} when {hit} fails", outcome, told=note)
    return done

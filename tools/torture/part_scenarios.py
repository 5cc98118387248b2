"""Random valid scenarios: what `check` lets pass runs to its end or says why not, keeps its books, and is the same when
it is interrupted, resumed, on two threads and with the plainest kernels."""

import json
import pathlib

import books
import extras
import scenario
from finding import Case

NAME = "scenarios"
SAYS = "random scenarios drawn from the schema: refused, or run, watched, interrupted and resumed"


def judge(rig, text, folder, counts):
    """Check and run the scenario; a kind of fault and the outcome that shows it, or None."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "scenario.yaml"
    path.write_text(text, encoding="utf-8")
    checked = rig.fram.call("check", path, "--json")
    fault = checked.fault(json_asked=True)
    if fault:
        return "check " + fault, checked
    if checked.code != 0:
        counts["refused by check"] += 1
        return None
    one, two = folder / "one", folder / "two"
    ran = rig.fram.call("run", path, "-o", one, "--json", "--threads", "1")
    fault = ran.fault(json_asked=True)
    if fault:
        return "run " + fault, ran
    if ran.code == 2:
        counts["refused while it is built"] += 1
        return None
    if ran.code != 0:
        counts["ended with a diagnosis"] += 1
        rig.diagnosed(folder, ran.err)
        return None
    counts["finished"] += 1
    fault = books.look_at_run(one)
    if fault:
        return "run: " + fault, ran
    end = json.loads((one / "run.json").read_text())["time_s"]
    plain = ("--threads", "2", "--isa", "baseline", "--json")
    first = rig.fram.call("run", path, "-o", two, "--until", repr(0.5 * end), *plain)
    second = rig.fram.call("resume", two, *plain) if first.code == 0 else first
    fault = first.fault(json_asked=True) or second.fault(json_asked=True)
    if fault or second.code != 0:
        return "resume " + (fault or "fails"), second
    fault = books.differ(one, two)
    return ("resumed, on two threads and baseline kernels: " + fault, second) if fault else None


def case(rig, draw, folder):
    """One random scenario; a finding is shrunk to what shows it."""
    done = Case()
    tree = scenario.random_scenario(draw, rig.sections)
    result = judge(rig, scenario.text_of(tree) + "\n", folder / "whole", done.counts)
    if done.counts["finished"]:
        done.counts.update(f"with {name} finished" for name in extras.reached(tree))
    if result:
        kind = result[0]
        tries = [0]

        def still_fails(smaller):
            tries[0] += 1
            again = judge(rig, scenario.text_of(smaller) + "\n", folder / f"less-{tries[0]}", Scrap())
            rig.clear(folder / f"less-{tries[0]}")
            return again is not None and again[0] == kind

        tree = scenario.shrink(tree, still_fails, rig.shrink_tries)
        done.found(kind, result[1], {"scenario.yaml": scenario.text_of(tree) + "\n"})
    return done


class Scrap(dict):
    """Counts that nobody reads."""

    def __missing__(self, key):
        return 0

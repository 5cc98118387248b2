"""Signals at random moments: Ctrl-C and SIGTERM end a run within reason, and nothing that a kill leaves is half."""

import json
import shutil

import books
import fixture
from finding import Case

NAME = "kills"
SAYS = "runs that are interrupted or killed at random moments, and resumed to the same end"
SIGNALS = {"INT": 2, "TERM": 15, "HUP": 1, "KILL": 9}
MOST_KILLS = 4
# As a terminal that closes: a hangup comes beside the signal, sooner than it counts as a second one [s].
PAIRED, PAIR_WITHIN = 0.3, 0.02


def straight(rig):
    """The run that nobody disturbed."""
    return fixture.get(rig) / "done"


def wall_of(rig):
    return rig.once("wall", lambda _: json.loads((straight(rig) / "run.json").read_text())["wall_s"])


def has_checkpoint(run):
    return run.exists() and any(run.glob("checkpoint-*.fram"))


def case(rig, draw, folder):
    """One run, killed again and again until it ends."""
    done = Case()
    run, scene = folder / "run", fixture.get(rig) / "scene.yaml"
    for kill in range(MOST_KILLS + 1):
        words = ("resume", run) if has_checkpoint(run) else ("run", scene, "-o", run, "--force")
        name = draw.choice(sorted(SIGNALS))
        after = draw.uniform(0.002, max(0.02, 1.3 * wall_of(rig)))
        sent = ((after, SIGNALS[name]),) if kill < MOST_KILLS else ()
        if sent and draw.random() < PAIRED:
            sent += ((after + draw.uniform(0, PAIR_WITHIN), SIGNALS["HUP"]),)
        outcome = rig.fram.call(*words, "--threads", str(draw.choice((1, 2))), signals=sent)
        died_of_it = outcome.code in [-number for _, number in sent]
        fault = None if died_of_it else outcome.fault()
        if not fault and not died_of_it and outcome.code in (1, 2):
            fault = "fails" + (" after a kill" if kill else "")
        if fault:
            done.found(f"{words[0]} {fault}", outcome, told=f"{name} after {after:.3f} s")
            return done
        done.counts[f"SIG{name}" if sent and outcome.code != 0 else "undisturbed"] += 1
        if outcome.code == 0:
            break
    fault = books.look_at_run(run) or books.differ(straight(rig), run)
    if fault:
        done.found("after kills: " + fault, outcome)
    shutil.rmtree(run, ignore_errors=True)
    return done

#!/usr/bin/env python3
"""What a step costs with more and more channel behind the ship: level ice of 5 km whose broken pieces sleep.

A bow breaks its way through scenes/level_ice.yaml, made longer; the state at each length of channel is kept in FOLDER
(build/channel), where later calls find it: the first call takes an hour of one core.  Then N steps are taken from each
state in turn, R times over, with this library and, after it in each round, with that of an older build (its
libfram.so).  Times are CPU time of one thread; a row's ratios are medians of what they were inside each round, so that
other work on the machine changes both sides of them.  Give --write to put the table into the results.
"""

import argparse
import datetime
import os
import pathlib
import platform
import statistics
import subprocess
import sys
import time

import kept_page

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
import machine  # noqa: E402  (tools)

NEW = ROOT / "build" / "release" / "libfram.so"
WAYS = (100, 250, 500, 1000, 2000, 5000)  # of the ship in the ice [m]
SPEED = 2.0  # of scenes/level_ice.yaml [m/s]
OVERRIDES = ("run.time_step=0.02", "run.duration=3000", "domain.x_max=5300", "ice.sleep_speed=0.2",
             "ice.sleep_time=2", "output.frame_interval=0", "output.checkpoint_interval=0")


def scenario():
    import fram
    return fram.Scenario.load(str(ROOT / "scenes" / "level_ice.yaml"), OVERRIDES)


def state_of(folder, way):
    return folder / f"{way}.fram"


def make_states(folder):
    """Runs on from the longest channel that is there."""
    folder.mkdir(parents=True, exist_ok=True)
    world = scenario().world()
    for way in WAYS:
        if state_of(folder, way).exists():
            world.load(state_of(folder, way))
            continue
        print(f"run_channel: simulating {way} m", flush=True)
        world.run_until(way / SPEED)
        world.save(state_of(folder, way))


def work(folder, steps):
    """A worker's life: for each line on its input a round, told as CPU seconds a step of each state."""
    worlds = []
    for way in WAYS:
        worlds.append(scenario().world())
        worlds[-1].load(state_of(folder, way))
        worlds[-1].step(steps)  # memory grows to its size, which loading does not tell
    asleep = [int(w["floes"]) for w in worlds]
    print(*asleep, flush=True)
    for _ in sys.stdin:
        costs = []
        for world in worlds:
            begun = time.process_time()
            world.step(steps)
            costs.append((time.process_time() - begun) / steps)
        print(*costs, flush=True)


class Worker:
    def __init__(self, library, options):
        words = [sys.executable, __file__, "--work", "--states", options.states, "--steps", options.steps]
        environment = dict(os.environ, FRAM_LIBRARY=str(library))
        self.process = subprocess.Popen([str(w) for w in words], env=environment, text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.floes = [int(word) for word in self._line()]
        self.rounds = []

    def _line(self):
        words = self.process.stdout.readline().split()
        if not words:
            sys.exit("run_channel: a worker ended; its message stands above")
        return words

    def round(self):
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        self.rounds.append([float(word) for word in self._line()])

    def median(self, column):
        return statistics.median(r[column] for r in self.rounds)

    def ratio(self, column, other, other_column):
        return statistics.median(a[column] / b[other_column] for a, b in zip(self.rounds, other.rounds))


def page(new, old, options):
    compiler = subprocess.run(["cc", "--version"], capture_output=True, text=True).stdout.splitlines()[0]
    head = "| channel, m | floes | ms a step | times that of 100 m |"
    if old:
        head += " old, ms | times its 100 m | old/new |"
    rows = []
    for i, way in enumerate(WAYS):
        row = f"| {way:,} | {new.floes[i]:,} | {1e3 * new.median(i):.2f} | {new.ratio(i, new, 0):.2f} |"
        if old:
            row += f" {1e3 * old.median(i):.2f} | {old.ratio(i, old, 0):.2f} | {old.ratio(i, new, i):.2f} |"
        rows.append(row)
    return "\n".join([
        "# A channel behind a ship", "",
        f"{datetime.date.today()}; {machine.processor()}; {platform.system()}; {compiler}; "
        f"load average {machine.load()} at the end.",
        f"`bench/run_channel.py`, {options.rounds} rounds of {options.steps} steps from each state, "
        "one thread, CPU time, medians.", "",
        "`scenes/level_ice.yaml` with more ice before the bow, `run.time_step: 0.02`, `ice.sleep_speed: 0.2` and",
        "`ice.sleep_time: 2`.  Ratios are medians of those inside each round.  With 100 m of channel the pieces beside",
        "a hull of 60 m and behind it are not yet as many as later.", "",
        head, "|" + "---|" * (head.count("|") - 1), *rows, ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--old", type=pathlib.Path, help="libfram.so of an older build")
    parser.add_argument("--rounds", type=int, default=20, help="%(default)s")
    parser.add_argument("--steps", type=int, default=25, help="of a round (%(default)s)")
    parser.add_argument("--states", type=pathlib.Path, default=ROOT / "build" / "channel",
                        help="folder that keeps the channels")
    parser.add_argument("--write", action="store_true",
                        help="write bench/results/channel.md; what stands there by hand is kept")
    parser.add_argument("--work", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.rounds < 1 or options.steps < 1:
        sys.exit("run_channel: --rounds and --steps must be 1 or more")
    sys.path.insert(0, str(ROOT / "bindings" / "python"))
    os.environ.setdefault("FRAM_LIBRARY", str(NEW))
    if options.work:
        return work(options.states, options.steps)
    for library in (NEW, options.old):
        if library is not None and not library.exists():
            sys.exit(f"run_channel: there is no {library}: build it first")
    make_states(options.states)
    new = Worker(NEW, options)
    old = Worker(options.old, options) if options.old else None
    for _ in range(options.rounds):
        new.round()
        if old:
            old.round()
    text = page(new, old, options)
    if options.write:
        kept_page.write(ROOT / "bench" / "results" / "channel.md", text)
    print(text)


if __name__ == "__main__":
    main()

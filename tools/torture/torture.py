#!/usr/bin/env python3
"""A campaign of faults against the command: random scenarios, mutated inputs, failing system calls, signals, damage.

    tools/torture/torture.py [--minutes M] [--cases N] [--seed S] [--jobs J]
                             [--only PART[:CASE]] [--soak-hours H] [--page FILE] [--out DIR]

Every case is drawn from seed, part and number alone: --seed S --only PART:CASE shows a finding again.  Exit code 1 when
something was found; each finding stands in DIR with its files (a scenario shrunk to what shows it).
"""

import argparse
import collections
import concurrent.futures
import pathlib
import random
import shutil
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import command  # noqa: E402
import page  # noqa: E402
import part_damage  # noqa: E402
import part_faults  # noqa: E402
import part_inputs  # noqa: E402
import part_kills  # noqa: E402
import part_parallel  # noqa: E402
import part_scenarios  # noqa: E402
import part_soak  # noqa: E402
import schema  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Parts with their share of the time.
PARTS = {part_scenarios: 0.40, part_inputs: 0.15, part_faults: 0.20, part_kills: 0.10, part_damage: 0.07,
         part_parallel: 0.04, part_soak: 0.04}


class Rig:
    """What the cases share."""

    def __init__(self, options):
        self.root = ROOT
        self.fram = command.Fram(options.fram)
        self.sections = schema.read(options.fram)
        self.shrink_tries = options.shrink
        self.minutes, self.out = options.minutes, options.out
        self.soak_hours = options.soak_hours
        self.work = pathlib.Path(tempfile.mkdtemp(prefix="fram-torture-"))
        self.lock = threading.RLock()
        self.kept = {}

    def clear(self, folder):
        """Remove a case's files."""
        shutil.rmtree(folder, ignore_errors=True)

    def diagnosed(self, folder, err):
        """Note a scenario that `check` let pass and that ended with a diagnosis: not a finding, but to be kept rare."""
        with self.lock:
            self.out.mkdir(parents=True, exist_ok=True)
            with open(self.out / "diagnoses.txt", "a", encoding="utf-8") as file:
                file.write(f"{folder.parent.name}: {err.strip().splitlines()[-1] if err.strip() else ''}\n")

    def once(self, name, make):
        """What is made once for all cases of a part."""
        with self.lock:
            if name not in self.kept:
                self.kept[name] = make(self.work / name)
            return self.kept[name]


class Tally:
    """All that a part did."""

    def __init__(self):
        self.cases, self.seconds = 0, 0.0
        self.counts = collections.Counter()
        self.findings = []


def keep(out, part, number, finding, seed):
    """Write a finding's folder and say it."""
    folder = out / f"{part}-{number}"
    folder.mkdir(parents=True, exist_ok=True)
    for name, data in finding.files.items():
        (folder / name).write_bytes(data if isinstance(data, bytes) else data.encode("utf-8", "surrogateescape"))
    (folder / "finding.txt").write_text(
        f"{finding.kind}\n\nagain: tools/torture/torture.py --seed {seed} --only {part}:{number}\n"
        f"call: fram {' '.join(finding.words)}\n\n{finding.told}\n", encoding="utf-8", errors="replace")
    print(f"FOUND {part}:{number}: {finding.kind}\n  {folder}", flush=True)
    for name, data in finding.files.items():
        if name.endswith(".yaml") and isinstance(data, str):
            print("    " + data.replace("\n", "\n    ").rstrip(), flush=True)


def run_case(rig, part, number, seed):
    folder = rig.work / f"{part.NAME}-{number}"
    folder.mkdir(parents=True, exist_ok=True)
    try:
        return part.case(rig, random.Random(f"{seed}/{part.NAME}/{number}"), folder)
    finally:
        rig.clear(folder)


def campaign(rig, options, parts):
    """Deal out cases to the workers until each part has had its share of time."""
    tallies = {part: Tally() for part in parts}
    total = sum(parts.values())
    budget = {part: options.minutes * 60 * options.jobs * share / total for part, share in parts.items()}
    end = time.monotonic() + options.minutes * 60
    lock = threading.Lock()
    started = collections.Counter()

    def next_part():
        """The part that lags most behind its share."""
        with lock:
            open_parts = [p for p in parts if tallies[p].seconds < budget[p]
                          and started[p] < min(getattr(p, "MOST", None) or options.cases, options.cases)]
            if not open_parts or time.monotonic() >= end:
                return None, 0
            part = min(open_parts, key=lambda p: (tallies[p].seconds + 1e-3 * started[p]) / budget[p])
            # Counted as begun, so that two workers do not take the same.
            started[part] += 1
            tallies[part].seconds += 1e-3
            return part, started[part] - 1

    def work():
        while True:
            part, number = next_part()
            if part is None:
                return
            began = time.monotonic()
            done = run_case(rig, part, number, options.seed)
            with lock:
                tally = tallies[part]
                tally.cases += 1
                tally.seconds += time.monotonic() - began
                tally.counts.update(done.counts)
                for finding in done.findings:
                    tally.findings.append((number, finding))
                    keep(options.out, part.NAME, number, finding, options.seed)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for future in [pool.submit(work) for _ in range(options.jobs)]:
            future.result()
    return tallies


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fram", default=str(ROOT / "build/release/fram"))
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--cases", type=int, default=sys.maxsize, help="most cases of a part, however fast the machine")
    parser.add_argument("--soak-hours", type=float, default=0, help="soak for so many simulated hours (--only soak)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", default="", help="PART or PART:CASE")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out/torture")
    parser.add_argument("--page", type=pathlib.Path)
    parser.add_argument("--shrink", type=int, default=60, help="most runs spent on making a finding smaller")
    options = parser.parse_args()
    rig = Rig(options)
    try:
        name, _, number = options.only.partition(":")
        parts = {p: s for p, s in PARTS.items() if not name or p.NAME == name}
        if not parts:
            parser.error(f"no part is called {name}; there are {', '.join(p.NAME for p in PARTS)}")
        began = time.monotonic()
        if number:
            part = next(iter(parts))
            done = run_case(rig, part, int(number), options.seed)
            for finding in done.findings:
                keep(options.out, part.NAME, int(number), finding, options.seed)
            print(dict(done.counts))
            return 1 if done.findings else 0
        tallies = campaign(rig, options, parts)
        text = page.summary(rig, options, tallies, time.monotonic() - began)
        print(text)
        if options.page:
            page.write(options.page, rig, options, tallies, time.monotonic() - began)
        return 1 if any(t.findings for t in tallies.values()) else 0
    finally:
        rig.clear(rig.work)


if __name__ == "__main__":
    sys.exit(main())

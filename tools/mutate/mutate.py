#!/usr/bin/env python3
"""Make small faults one at a time and say which test caught each:  tools/mutate/mutate.py [options]

    --check       only look whether each fault of tests/mutants still fits the code (seconds; part of lint)
    --rooms A,B   faults of these rooms only
    --only TEXT   faults that have this text in what they break, or in the lines they change, only
    --jobs N      so many at once, each in a copy of the tree under build/mutate
    --minutes M   begin no fault after that time; the next call goes on
    --first N     only the N likeliest tests of the fault's own room, with short scenes; what they miss is left open
    --least P     exit code 1 when less than P % (95) are caught

Verdicts stand in bench/results/mutants.csv; one on equal code and by an equal test is not asked for again.  A fault
that does not compile has none, and exit code 1 follows.
"""

import argparse
import concurrent.futures
import pathlib
import queue
import sys
import threading
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import mutants as listing  # noqa: E402
import table  # noqa: E402
from verdicts import CAUGHT, OPEN, SURVIVED, Verdicts, all_tests, digest, test_code  # noqa: E402
from workplace import LEAST_PATIENCE_S, PATIENCE, Workplace, first_failure, likely  # noqa: E402

ROOT = HERE.parents[1]
# Groups of tests that are no rooms: of whole runs.
OTHERS = {"runs"}


def order(place, mutant, path, first):
    """The test named first, then tests of the own room, the likeliest ahead, then quick ones of the others; none of
    rooms below."""
    def sort_key(test):
        return (-likely(test, path), place.usual(test))
    named = [t for t in place.tests if t["name"] == mutant.test]
    rest = [t for t in place.tests if t["name"] != mutant.test]
    own = named + sorted((t for t in rest if t["room"] == mutant.room), key=sort_key)
    if first:
        return own[:first]
    above = set(listing.ROOMS[listing.ROOMS.index(mutant.room) + 1:]) | OTHERS
    return own + sorted((t for t in rest if t["room"] in above), key=place.usual)


def judge(place, mutant, path, text, first):
    """A row: caught by which test, or survived.  The copy is as before when it returns."""
    row = {"code": digest(text), "seconds": ""}
    made = False
    for test in order(place, mutant, path, first):
        if test["name"] not in place.seconds:
            # Its time without a fault.
            place.restore(path)
            made = False
        usual = place.know(test)
        if usual is None:
            continue
        if not made:
            place.put(path, text)
            made = True
        problem = place.make(test)
        if problem:
            place.restore(path)
            return {"problem": problem}
        good, said, seconds = place.run(test, max(PATIENCE * usual, LEAST_PATIENCE_S))
        if not good:
            place.restore(path)
            return {**row, "verdict": CAUGHT, "test": test["name"], "function": first_failure(said),
                    "seconds": f"{seconds:.1f}", "test_code": test_code(ROOT, test["name"])}
    place.restore(path)
    verdict = OPEN if first else SURVIVED
    return {**row, "verdict": verdict, "test": "", "function": "", "test_code": all_tests(ROOT)}


def work(place, jobs, verdicts, lock, options, end):
    """Take faults until there are none, or no time; how many did not compile."""
    broken = 0
    place.prepare()
    while time.monotonic() < end:
        try:
            mutant, path, text = jobs.get_nowait()
        except queue.Empty:
            break
        began = time.monotonic()
        row = judge(place, mutant, path, text, options.first)
        with lock:
            spent = f"{time.monotonic() - began:.0f} s"
            if "problem" in row:
                print(f"{mutant.place}: does not compile\n{row['problem']}", flush=True)
                broken += 1
                # What it was on other code says nothing of it now.
                verdicts.drop(mutant)
                continue
            caught = f"[{row['test']} {row['function']}]"
            print(f"{row['verdict']:8} {mutant.room}: {mutant.what} {caught} {spent}", flush=True)
            verdicts.put(mutant, row)
    return broken


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--rooms", default="")
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=1e6)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--least", type=float, default=95)
    parser.add_argument("--results", type=pathlib.Path, default=ROOT / "bench/results/mutants.csv")
    options = parser.parse_args()
    problems, count = listing.check(ROOT)
    print("\n".join(problems) if problems else f"mutants: {count} fit the code")
    if options.check:
        return 1 if problems else 0
    verdicts, jobs, wanted, late = Verdicts(options.results), queue.Queue(), [], []
    every = listing.read(ROOT)
    for mutant in every:
        if options.rooms and mutant.room not in options.rooms.split(","):
            continue
        if options.only not in mutant.what + mutant.old + mutant.new:
            continue
        try:
            path, text = listing.locate(ROOT, mutant)
        except listing.Stale:
            continue
        wanted.append(mutant)
        if not verdicts.known(ROOT, mutant, digest(text)):
            late.append((mutant, path, text))
    # What was never tried comes first, for who has little time.
    for job in sorted(late, key=lambda job: (job[0].room, job[0].what) in verdicts.rows):
        jobs.put(job)
    print(f"{jobs.qsize()} of {len(wanted)} to be tried", flush=True)
    lock, end = threading.Lock(), time.monotonic() + 60 * options.minutes
    places = [Workplace(ROOT, n, options.first > 0) for n in range(min(options.jobs, jobs.qsize()))]
    # A worker that fails says so here: verdicts of older code alone would look like an answer.
    with concurrent.futures.ThreadPoolExecutor(max(1, len(places))) as pool:
        workers = [pool.submit(work, place, jobs, verdicts, lock, options, end) for place in places]
        broken = sum(worker.result() for worker in workers)
    verdicts.keep_only(every)
    verdicts.write()
    share, survivors, missing = table.write(options.results.with_suffix(".md"), ROOT, every, verdicts)
    print(f"{share:.1f} % caught, {survivors} survive, {missing} not tried yet; {options.results.with_suffix('.md')}")
    if broken:
        print(f"{broken} do not compile")
    left = jobs.qsize()  # the next call goes on with them; those known of older code are no answer until then
    if left:
        print(f"{left} not tried in this time")
    return 1 if problems or broken or left or share < options.least or missing else 0


if __name__ == "__main__":
    sys.exit(main())

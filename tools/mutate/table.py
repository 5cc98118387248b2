"""The page about the mutants: bench/results/mutants.md."""

import collections
import datetime
import subprocess

from machine import processor
from mutants import Stale, locate
from verdicts import CAUGHT, OPEN, digest

HEAD = """# Faults made on purpose

`make mutate` makes each small fault of `tests/mutants` alone, in a copy of the tree, and looks which test notices it:
signs, factors, indices, comparisons, terms and limits left out. The tests of the fault's own room come first, then
those of the others. `mutants.csv` beside this page has each fault with the test that caught it.
"""


def code(root):
    words = ["git", "-C", str(root), "--git-dir=.git", "rev-parse", "--short", "HEAD"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    return done.stdout.strip()


def first_line(words):
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    return done.stdout.partition("\n")[0].strip()


def machine():
    """Processor and compiler: what the times of the tests, and so what hangs, depend on."""
    return f"{processor()}, {first_line(['nproc'])} cores, {first_line(['cc', '--version'])}"


def is_of_today(root, mutant, row):
    """Whether a verdict was given on the code as it is."""
    try:
        return row["code"] == digest(locate(root, mutant)[1])
    except Stale:
        return False


def write(path, root, mutants, verdicts):
    """Counts by room, and every survivor with its reason."""
    count = {room: collections.Counter() for room in dict.fromkeys(m.room for m in mutants)}
    survivors, open_ones, missing, earlier = [], [], 0, 0
    for m in mutants:
        row = verdicts.rows.get((m.room, m.what))
        if not row:
            missing += 1
            count[m.room]["missing"] += 1
            continue
        earlier += not is_of_today(root, m, row)
        count[m.room]["tried"] += 1
        if row["verdict"] == CAUGHT:
            own = row["test"].split("/")[0] == m.room
            count[m.room]["own" if own else "other"] += 1
        elif row["verdict"] == OPEN and not m.survives:
            count[m.room]["open"] += 1
            open_ones.append(f"- {m.room}, {m.kind}: {m.what}.")
        else:
            why = m.survives or "No reason is known: a test is missing."
            survivors.append(f"- {m.room}, {m.kind}: {m.what}. {why}")
    total = sum(count.values(), collections.Counter())
    rows = ["| room | faults tried | caught by its own tests | by tests of other rooms | survive | open "
            "| not tried yet |",
            "|---|---|---|---|---|---|---|"]
    for name, c in [*count.items(), ("all", total)]:
        left = c["tried"] - c["own"] - c["other"] - c["open"]
        rows.append(f"| {name} | {c['tried']} | {c['own']} | {c['other']} | {left} | {c['open']} | "
                    f"{c['missing']} |")
    share = 100 * (total["own"] + total["other"]) / max(1, total["tried"])
    all_of_them = total["tried"] + missing
    text = (f"{HEAD}\n{datetime.date.today().isoformat()}, code {code(root)}, {machine()}: {total['tried']} of "
            f"{all_of_them} faults tried, {share:.1f} % of these caught. {earlier} verdicts are of code that has "
            "changed since.\n\n" + "\n".join(rows) + "\n\n## Survivors\n\n" +
            ("\n".join(survivors) or "None.") + "\n")
    if open_ones:
        text += ("\n## Open\n\nMissed by the likeliest tests of their room; the others were not run yet.\n\n"
                 + "\n".join(open_ones) + "\n")
    path.write_text(text, encoding="utf-8")
    return share, len(survivors) + len(open_ones), missing

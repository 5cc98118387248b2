"""What a campaign tells at its end: a short table, and the page that is committed."""

import collections
import datetime
import platform
import subprocess


def kinds(tally):
    """Kind of finding -> how many."""
    return collections.Counter(finding.kind for _, finding in tally.findings)


def summary(rig, options, tallies, seconds):
    """A few lines for the terminal."""
    lines = []
    for part, tally in tallies.items():
        told = ", ".join(f"{n:,} {what}" for what, n in sorted(tally.counts.items()))
        lines.append(f"{part.NAME:10} {tally.cases:6,} cases, {len(tally.findings)} findings; {told}")
        lines += [f"           {n} x {kind}" for kind, n in kinds(tally).most_common()]
    lines.append(f"{rig.fram.calls:,} calls in {seconds:.0f} s (seed {options.seed}); longest {rig.fram.longest:.1f} s "
                 f"of computing, largest {rig.fram.most_memory:.0f} MB")
    return "\n".join(lines)


def version(fram):
    done = subprocess.run([fram, "--version"], capture_output=True, text=True, check=False)
    return done.stdout.strip().splitlines()[0] if done.stdout.strip() else "unknown"


def code(root):
    words = ["git", "-C", str(root), "--git-dir=.git", "rev-parse", "--short", "HEAD"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    return done.stdout.strip() or "unknown"


def write(path, rig, options, tallies, seconds):
    """The table of the page, between its two marks; the words around it are written by hand."""
    rows = ["| part | cases | what came of them | findings |", "|---|---|---|---|"]
    for part, tally in tallies.items():
        told = "; ".join(f"{n:,} {what}" for what, n in sorted(tally.counts.items()))
        found = "; ".join(f"{n} x {kind}" for kind, n in kinds(tally).most_common()) or "none"
        rows.append(f"| {part.NAME}: {part.SAYS} | {tally.cases:,} | {told} | {found} |")
    processor = platform.processor() or platform.machine()
    when = datetime.date.today().isoformat()
    text = (f"{when}, {version(rig.fram.path)}, code {code(rig.root)}, {processor}, "
            f"{options.jobs} jobs, {seconds / 60:.0f} minutes, seed {options.seed}: {rig.fram.calls:,} calls; the "
            f"longest computed {rig.fram.longest:.1f} s, the largest held {rig.fram.most_memory:.0f} MB.\n\n" +
            "\n".join(rows))
    old = path.read_text(encoding="utf-8") if path.exists() else "<!-- begin -->\n<!-- end -->\n"
    head, rest = old.split("<!-- begin -->", 1)
    tail = rest.split("<!-- end -->", 1)[1]
    path.write_text(f"{head}<!-- begin -->\n{text}\n<!-- end -->{tail}", encoding="utf-8")

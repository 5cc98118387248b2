"""What became of each mutant, in bench/results/mutants.csv: the result of `make mutate`, and where it goes on."""

import csv
import hashlib

FIELDS = ("room", "kind", "what", "verdict", "test", "function", "seconds", "code", "test_code")
# open: the likeliest tests missed it, the others were not run.
CAUGHT, SURVIVED, OPEN = "caught", "survived", "open"


def digest(*texts):
    """A short name of the texts."""
    whole = hashlib.sha256()
    for text in texts:
        whole.update(text.encode("utf-8", "surrogateescape") + b"\0")
    return whole.hexdigest()[:12]


def test_code(root, name):
    """The source of a test."""
    for suffix in ("c", "sh", "py"):
        room, topic = name.split("/", 1)
        path = root / "tests" / room / f"test_{topic}.{suffix}"
        if path.exists():
            return digest(path.read_text(encoding="utf-8"))
    return ""


def all_tests(root):
    """All tests together: a fault that survived is looked at again when one of them is another."""
    paths = sorted((root / "tests").glob("*/*.[chsp]*"))
    return digest(*(p.read_text(encoding="utf-8", errors="replace") for p in paths))


class Verdicts:
    """Rows by (room, what)."""

    def __init__(self, path):
        self.path, self.rows = path, {}
        if path.exists():
            with open(path, newline="", encoding="utf-8") as file:
                self.rows = {(r["room"], r["what"]): r for r in csv.DictReader(file)}

    def known(self, root, mutant, code):
        """The verdict on equal code and equal tests, or None."""
        row = self.rows.get((mutant.room, mutant.what))
        if not row or row["code"] != code or row["verdict"] == OPEN:
            return None
        if row["verdict"] == CAUGHT:
            return row if row["test_code"] == test_code(root, row["test"]) else None
        return row if row["test_code"] == all_tests(root) else None

    def put(self, mutant, row):
        """Note a verdict and write the file."""
        self.rows[mutant.room, mutant.what] = {"room": mutant.room, "kind": mutant.kind, "what": mutant.what, **row}
        self.write()

    def drop(self, mutant):
        """Forget a verdict, and write the file."""
        self.rows.pop((mutant.room, mutant.what), None)
        self.write()

    def keep_only(self, mutants):
        """Leave out what is not in the list any more, and sort as the list is."""
        order = [(m.room, m.what) for m in mutants]
        self.rows = {key: self.rows[key] for key in order if key in self.rows}

    def write(self):
        self.path.parent.mkdir(parents=True, exist_ok=True)
        with open(self.path, "w", newline="", encoding="utf-8") as file:
            out = csv.DictWriter(file, FIELDS, lineterminator="\n")
            out.writeheader()
            out.writerows(self.rows.values())

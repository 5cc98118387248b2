"""The keys of a scenario with their kinds and ranges, read from `fram keys`: the table that Fram's reader uses."""

import collections
import re
import subprocess

# path: section names from the top, "lines[]" for a list; low, high: None where a kind has no range; most: of a list.
Key = collections.namedtuple("Key", "path name kind choices automatic low high default power")
Section = collections.namedtuple("Section", "path is_list most keys")

_ROW = re.compile(r"^\| `(?P<name>\w+)` \| (?P<kind>.*?) \| (?P<unit>.*?) \| (?P<default>.*?) \| (?P<range>.*?) \| ")


def _kind(text):
    """('number' | 'integer' | 'boolean' | 'choice' | 'text' | 'path', choices, may be auto)"""
    words = re.findall(r"`([^`]*)`", text)
    if text.startswith("number"):
        return "number", (), "auto" in words
    if text in ("integer", "text", "path"):
        return text, (), False
    if words == ["true", "false"]:
        return "boolean", (), False
    return "choice", tuple(words), False


def _default(text):
    """The default at scale 30 and the power by which it grows with the scale."""
    if text.startswith("`"):
        return text.strip("`").strip('"'), 0.0
    found = re.match(r"^(\S+) (?:\(scale / 30\)|scale)(?:\^(\S+))?$", text)
    if found:
        power = float(found.group(2) or 1)
        value = float(found.group(1))
        return (value if "(scale / 30)" in text else value * 30**power), power
    return float(text), 0.0


def parse(text):
    """The sections of the Markdown reference, outer ones first."""
    sections, section = [], None
    for line in text.splitlines():
        if line.startswith("## "):
            name = line[3:].strip()
            path = () if name == "Top level" else tuple(name.split("."))
            section = Section(path, name.endswith("[]"), [None], [])
            sections.append(section)
        found = re.search(r"a list of at most (\d+) mappings\.$", line)
        if found and section:
            section.most[0] = int(found.group(1))
        row = _ROW.match(line)
        if row and section is not None:
            kind, choices, automatic = _kind(row["kind"])
            default, power = _default(row["default"])
            low, high = (None, None)
            if " to " in row["range"]:
                low, high = (float(x) for x in row["range"].split(" to "))
            section.keys.append(Key(section.path, row["name"], kind, choices, automatic, low, high, default, power))
    return sections


def read(fram):
    """The schema of this build."""
    done = subprocess.run([fram, "keys"], capture_output=True, text=True, check=True)
    sections = parse(done.stdout)
    if sum(len(s.keys) for s in sections) < 100:
        raise SystemExit("torture: `fram keys` is not the table that tools/torture/schema.py can read")
    return sections

#!/usr/bin/env python3
"""The manual page fram(1), made of what the command says of itself."""

import pathlib
import re
import subprocess

from words import words_of

HEAD = r""".TH FRAM 1 "" "fram {version}" "Simulator of vessels in sea ice"
.SH NAME
fram \- simulator of vessels in sea ice
.SH SYNOPSIS
.B fram
.I COMMAND ...
.br
.B fram
.I COMMAND
.B \-\-help
.SH DESCRIPTION
"""


def said(*words):
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout


def verbatim(text):
    """Text as it stands: a line may not begin as a request, a backslash and a hyphen are written out."""
    lines = text.rstrip().replace("\\", r"\e").replace("-", r"\-").split("\n")
    return ".nf\n" + "\n".join(r"\&" + line if line[:1] in (".", "'") else line for line in lines) + "\n.fi\n"


def main():
    words = words_of(__doc__)
    words.add_argument("fram", help="the command")
    words.add_argument("output", help="file for the page, as build/release/fram.1")
    options = words.parse_args()
    fram = options.fram
    overview = said(fram, "--help")
    # Commands stand indented by two under their heading, one a line, until the next empty line.
    commands = re.findall(r"^  (\w+) ", overview.split("Commands:\n")[1].split("\n\n")[0], re.M)
    page = HEAD.format(version=said(fram, "--version").split()[1]) + verbatim(overview) + ".SH COMMANDS\n"
    for command in commands:
        page += f'.SS "fram {command}"\n' + verbatim(said(fram, command, "--help"))
    pathlib.Path(options.output).write_text(page)


main()

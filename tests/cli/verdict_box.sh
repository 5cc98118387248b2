# What tests of verdicts share: the box at the head of a report.  After common.sh.
# shellcheck shell=bash

# verdict FOLDER: the text of the box, a finding a line, in verdict.txt.
verdict() {
    expect 0 "$FRAM" report "$1" --quiet
    python3 - "$1/report.html" >verdict.txt <<'PY'
import html, re, sys
page = open(sys.argv[1]).read()
box = re.search(r'<section class="verdict (\w+)">(.*?)</section>', page, re.S)
print(box.group(1))
print(html.unescape(re.sub(r"<[^>]+>", "", box.group(2))))
PY
}

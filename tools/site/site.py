#!/usr/bin/env python3
"""The documents as a site of plain files, with search and figures, that opens from disk.

Every Markdown file of the repository becomes a page at its own place; what pages link to (scenes, sources, pictures) is
copied beside them.  The order of the menu is that of the links in docs/README.md.  Needs python3-markdown."""

import html
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

try:
    import markdown
    from markdown.extensions.toc import TocExtension
except ImportError:
    raise SystemExit("site: needs Debian's python3-markdown")

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from words import words_of  # noqa: E402
LINK = re.compile(r"\[[^\]]*\]\(([^)\s#]+\.md)[^)]*\)")
HREF = re.compile(r'(<(?:a|img)\b[^>]*?\b(?:href|src)=")([^"]+)(")')
# Pages of a reader; those of faults, corpora and the like stay in the repository.
LEFT_OUT = re.compile(r"^(fuzz|tests|packaging)/")
MENU_DEPTH = {"docs/decisions": "Decisions", "docs/validation": "Validation", "bench/results": "Measured"}


def own_pages():
    listing = subprocess.run([ROOT / "tools/sources.sh", "*.md"], stdout=subprocess.PIPE, text=True, check=True)
    return [name for name in listing.stdout.splitlines() if not LEFT_OUT.match(name)]


def in_reading_order(pages):
    """README first, then as docs/README.md names them, then the rest by name."""
    index = (ROOT / "docs/README.md").read_text(encoding="utf-8")
    named = [os.path.normpath(os.path.join("docs", link)) for link in LINK.findall(index)]
    order = ["README.md", "docs/README.md"] + named + sorted(pages)
    return [page for page in dict.fromkeys(order) if page in pages]


def slug(text, separator):
    """Anchors as the hosts of repositories make them, so that links of the Markdown hold here."""
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", separator)


def prepared(text):
    """A list that follows its paragraph without an empty line is one elsewhere; here it needs the line."""
    lines, fenced, out = text.split("\n"), False, []
    for number, line in enumerate(lines):
        fenced ^= line.startswith("```")
        before = lines[number - 1] if number else ""
        if not fenced and re.match(r"([-*] |\d+\. )", line) and before and not re.match(r"([-*] |\d+\. |  )", before):
            out.append("")
        out.append(line)
    return "\n".join(out)


def title_of(page, text):
    found = re.search(r"^# +(.*)$", text, re.M)
    return re.sub(r"[`*]|\[([^\]]*)\]\([^)]*\)", r"\1", found[1]) if found else page


def page_name(page):
    return "index.html" if page == "README.md" else page[:-3] + ".html"


def relative(target, page):
    return os.path.relpath(target, os.path.dirname(page_name(page)) or ".").replace(os.sep, "/")


class Site:
    def __init__(self, output):
        self.output = output
        self.pages = in_reading_order(own_pages())
        self.texts = {page: (ROOT / page).read_text(encoding="utf-8") for page in self.pages}
        self.titles = {page: title_of(page, text) for page, text in self.texts.items()}
        self.copied = set()
        self.frame = (HERE / "page.html").read_text(encoding="utf-8")

    def address(self, page, target):
        """Where a link of a page leads in the site; files beside the pages are copied."""
        if re.match(r"[a-z]+:|#", target):
            return target
        name, mark, part = target.partition("#")
        path = os.path.normpath(os.path.join(os.path.dirname(page), name))
        if path in self.texts:
            return relative(page_name(path), page) + mark + part
        if (ROOT / path).is_file():
            self.copied.add(path)
        return relative(path, page) + mark + part

    def link(self, page, current):
        item, told = (" class=here", " aria-current=page") if page == current else ("", "")
        address = relative(page_name(page), current)
        return f'<li{item}><a href="{address}"{told}>{html.escape(self.titles[page])}</a></li>'

    def menu(self, current):
        groups = {"Documents": []}
        for page in self.pages:
            group = MENU_DEPTH.get(os.path.dirname(page), "Documents")
            groups.setdefault(group, []).append(page)
        parts = []
        for group, pages in groups.items():
            links = "".join(self.link(page, current) for page in pages)
            opened = " open" if group == "Documents" or current in pages else ""
            parts.append(f"<details{opened}><summary>{group}</summary><ul>{links}</ul></details>")
        return "".join(parts)

    def body(self, page):
        made = markdown.markdown(prepared(self.texts[page]), output_format="html",
                                 extensions=["tables", "fenced_code", "sane_lists", TocExtension(slugify=slug)])
        return HREF.sub(lambda found: found[1] + html.escape(self.address(page, html.unescape(found[2]))) + found[3],
                        made).replace("<table>", '<div class="wide"><table>').replace("</table>", "</table></div>")

    def write(self, page):
        target = self.output / page_name(page)
        target.parent.mkdir(parents=True, exist_ok=True)
        body = self.body(page)
        title = self.titles[page]
        fields = {"HEADING": html.escape(title if title == "Fram" else f"{title} - Fram"),
                  "BODY": body, "MENU": self.menu(page),
                  "BASE": relative(".", page) + "/"}
        target.write_text(re.sub(r"@(HEADING|BODY|MENU|BASE)@", lambda field: fields[field[1]], self.frame),
                          encoding="utf-8")
        return {"t": self.titles[page], "a": page_name(page), "s": self.sections(body)}

    def sections(self, body):
        """What search looks in: the text of each heading's section, with the heading and its anchor."""
        found = []
        for part in re.split(r"(?=<h[1-4] id=)", body):
            head = re.match(r'<h[1-4] id="([^"]*)">(.*?)</h[1-4]>', part, re.S)
            plain = html.unescape(re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", part))).strip()
            if plain:
                name = html.unescape(re.sub(r"<[^>]+>", "", head[2])) if head else ""
                found.append([name, head[1] if head else "", plain])
        return found

    def build(self):
        shutil.rmtree(self.output, ignore_errors=True)
        index = [self.write(page) for page in self.pages]
        for name in sorted(self.copied):
            (self.output / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / name, self.output / name)
        for name in ("site.css", "search.js"):
            shutil.copyfile(HERE / name, self.output / name)
        (self.output / "index.js").write_text("const pages = " + json.dumps(index, ensure_ascii=False,
                                                                             separators=(",", ":")) + ";\n",
                                              encoding="utf-8")
        print(f"site: {len(self.pages)} pages; open {self.output}/index.html")


words = words_of(__doc__)
words.add_argument("output", nargs="?", type=pathlib.Path, default="build/site", help="folder (%(default)s)")
Site(words.parse_args().output).build()

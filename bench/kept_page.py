"""Pages of bench/results whose beginning a script measures and writes: what people write below the mark stays."""

MARK = "<!-- by hand from here on -->\n"


def write(path, text):
    """The page anew, with what stood below its mark."""
    old = path.read_text(encoding="utf-8") if path.exists() else ""
    _, mark, below = old.partition(MARK)
    path.write_text(text.rstrip("\n") + "\n" + (f"\n{mark}{below}" if mark else ""), encoding="utf-8")

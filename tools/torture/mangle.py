"""Damage: bytes, lines and words of a file changed at random."""

WORDS = (b"0", b"-1", b"1e308", b"-1e308", b"nan", b"inf", b"1e-320", b"9223372036854775807", b"2147483648",
         b"4294967295", b"null", b"true", b"[]", b"{}", b"\"\"",
         b"..", b"\x00", b"\xff\xfe", b"1" * 400, b"/dev/null", b"- - -", b"&a",
         b"*a", b"\t", b"\r\n", b"[" * 200, b"{" * 200)


def _split(draw, data):
    return draw.randrange(len(data) + 1)


def bytes_changed(draw, data):
    data = bytearray(data)
    for _ in range(draw.choice((1, 1, 2, 8))):
        if data:
            i = draw.randrange(len(data))
            data[i] = draw.choice((0, 255, data[i] ^ (1 << draw.randrange(8)), draw.randrange(256)))
    return bytes(data)


def cut_short(draw, data):
    return data[:_split(draw, data)]


def piece_lost(draw, data):
    a, b = sorted((_split(draw, data), _split(draw, data)))
    b = min(b, a + draw.choice((1, 10, 1000)))
    return data[:a] + data[b:]


def piece_doubled(draw, data):
    a, b = sorted((_split(draw, data), _split(draw, data)))
    b = min(b, a + 5000)
    return data[:b] + data[a:b] * draw.choice((1, 2, 50)) + data[b:]


def word_put_in(draw, data):
    a = _split(draw, data)
    return data[:a] + draw.choice(WORDS) + data[a:]


def number_changed(draw, data):
    """A number of a text becomes another."""
    import re
    found = list(re.finditer(rb"-?\d+(\.\d+)?([eE][-+]?\d+)?", data[:200000]))
    if not found:
        return bytes_changed(draw, data)
    hit = draw.choice(found)
    return data[:hit.start()] + draw.choice(WORDS[:12]) + data[hit.end():]


def lines_swapped(draw, data):
    lines = data.splitlines(keepends=True)
    if len(lines) < 2:
        return bytes_changed(draw, data)
    i, j = draw.randrange(len(lines)), draw.randrange(len(lines))
    lines[i], lines[j] = lines[j], lines[i]
    return b"".join(lines)


def zeros(draw, data):
    a = _split(draw, data)
    n = draw.choice((1, 8, 64, 4096))
    return data[:a] + bytes(min(n, len(data) - a)) + data[a + n:]


KINDS = (bytes_changed, cut_short, piece_lost, piece_doubled, word_put_in, number_changed, number_changed,
         lines_swapped, zeros)


def mangle(draw, data):
    """One to three kinds of damage."""
    for _ in range(draw.choice((1, 1, 1, 2, 3))):
        data = draw.choice(KINDS)(draw, data)
    return data

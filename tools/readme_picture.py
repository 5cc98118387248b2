#!/usr/bin/env python3
"""The moving picture of the README, docs/pictures/demo.webp:  make readme-picture

Runs scenes/demo.yaml, plays its page with headless Chromium, camera with the ship, at four times real time, and joins
the frames to an animated WebP (RFC 9649), which needs nothing that is not here already.  Needs `make viewer`.
"""

import base64
import pathlib
import struct
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "views"))
import chromium  # noqa: E402
from words import words_of  # noqa: E402

FRAM = ROOT / "build" / "release" / "fram"
RUN = ROOT / "out" / "readme"
OUT = ROOT / "docs" / "pictures" / "demo.webp"
WIDTH, HEIGHT = 640, 360
FROM, FRAMES, EVERY, SPEED = 22.0, 80, 0.1, 4  # s, number, s of the picture, times real time
QUALITY, MOST_BYTES = 0.38, 1_500_000
# One frame as the page draws it, without boxes and buttons.
GRAB = """(async (time) => {
    fram.seek(time);
    for (fram.draw(); fram.waiting; fram.draw()) await new Promise((done) => setTimeout(done, 10));
    const out = document.createElement('canvas');
    [out.width, out.height] = [%d, %d];
    out.getContext('2d', { alpha: false }).drawImage(document.getElementById('view'), 0, 0, out.width, out.height);
    return out.toDataURL('image/webp', %g).split(',')[1];
})""" % (WIDTH, HEIGHT, QUALITY)


def chunk(name, data):
    """A chunk of a RIFF file: name, size, data to an even size."""
    return name + struct.pack("<I", len(data)) + data + b"\0" * (len(data) % 2)


def triple(number):
    return struct.pack("<I", number)[:3]


def picture_chunk(still):
    """The chunk with the picture of a still WebP."""
    at = 12
    while at < len(still):
        name, size = struct.unpack_from("<4sI", still, at)
        if name in (b"VP8 ", b"VP8L"):
            return chunk(name, still[at + 8:at + 8 + size])
        at += 8 + size + size % 2
    raise ValueError("a frame is no WebP")


def animated(stills):
    """An endless animation of still pictures, each shown for EVERY seconds."""
    size = triple(WIDTH - 1) + triple(HEIGHT - 1)
    frame = bytes(6) + size + triple(round(1000 * EVERY)) + b"\2"
    body = chunk(b"VP8X", struct.pack("<I", 2) + size) + chunk(b"ANIM", bytes(6))
    body += b"".join(chunk(b"ANMF", frame + picture_chunk(still)) for still in stills)
    return chunk(b"RIFF", b"WEBP" + body)


def take(browser):
    browser.open(RUN / "playback.html")
    for foot in ("0", "document.querySelector('footer').offsetHeight"):  # whose height follows the width
        browser.call("Emulation.setDeviceMetricsOverride", width=WIDTH, height=HEIGHT + browser.run(foot),
                     deviceScaleFactor=1, mobile=False)
    browser.run("fram.resize()")
    browser.run(f"(fram.seek({FROM}), fram.placeCamera())")
    return [base64.b64decode(browser.run(f"{GRAB}({FROM + SPEED * EVERY * k})")) for k in range(FRAMES)]


def main():
    words_of(__doc__).parse_args()
    subprocess.run([FRAM, "run", ROOT / "scenes" / "demo.yaml", "-o", RUN, "--force", "--quiet"], check=True)
    subprocess.run([FRAM, "view", RUN, "--quiet"], check=True)
    with chromium.Browser(1000, 800) as browser:
        data = animated(take(browser))
    if len(data) > MOST_BYTES:
        sys.exit(f"{len(data)} bytes are more than {MOST_BYTES}: give a lower QUALITY")
    OUT.write_bytes(data)
    print(f"{OUT.relative_to(ROOT)}: {FRAMES} frames, {FRAMES * EVERY:g} s, {len(data) / 1e6:.2f} MB")


if __name__ == "__main__":
    main()

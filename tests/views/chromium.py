"""Headless Chromium driven through its DevTools pipe: open a page, evaluate, click, and hear what it complains of.

Only Python's own library is needed.  Messages are JSON ended by a zero byte: descriptor 3 to the browser, 4 from it.
"""
import base64
import json
import os
import pathlib
import select
import shutil
import struct
import subprocess
import tempfile
import time
import zlib

FLAGS = """--headless --no-sandbox --disable-quic --no-first-run --disable-background-networking --mute-audio
--disable-component-update --disable-sync --use-angle=swiftshader --enable-unsafe-swiftshader
--autoplay-policy=no-user-gesture-required --remote-debugging-pipe --hide-scrollbars about:blank""".split()
PATIENCE = 150.0  # seconds that one answer may take on a busy machine


def path():
    """The browser's path, or None."""
    return shutil.which("chromium")


class Browser:
    """One window with one page; a context manager that ends the browser it began."""

    def __init__(self, width=1200, height=800):
        self.home = tempfile.mkdtemp(prefix="fram-chromium-")
        self.downloads = pathlib.Path(self.home) / "downloads"
        self.downloads.mkdir()
        to_read, self.to = os.pipe()
        self.back, back_write = os.pipe()
        self.process = subprocess.Popen(
            ["/bin/sh", "-c", f'exec "$@" 3<&{to_read} 4>&{back_write}', "sh", path(), *FLAGS,
             f"--user-data-dir={self.home}/profile", f"--window-size={width},{height}"],
            pass_fds=(to_read, back_write), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_read)
        os.close(back_write)
        self.number, self.rest, self.answers, self.complaints, self.saved = 0, b"", {}, [], {}
        self.session = None
        pages = [t for t in self.call("Target.getTargets")["targetInfos"] if t["type"] == "page"]
        target = pages[0]["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(domain + ".enable")
        session, self.session = self.session, None
        self.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(self.downloads),
                  eventsEnabled=True)
        self.session = session

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.session = None
            self.call("Browser.close")
            self.process.wait(20)
        except (OSError, RuntimeError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        os.close(self.to)
        os.close(self.back)
        time.sleep(0.2)
        shutil.rmtree(self.home, ignore_errors=True)

    def call(self, method, **parameters):
        """Send a command and wait for its answer."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self.to, data):]
        end = time.monotonic() + PATIENCE
        while self.number not in self.answers:
            if time.monotonic() > end:
                raise RuntimeError(f"Chromium gave no answer to {method}")
            self.listen(1)
        answer = self.answers.pop(self.number)
        if "error" in answer:
            raise RuntimeError(f"{method}: {answer['error']}")
        return answer["result"]

    def listen(self, seconds):
        """Take in what the browser says."""
        if not select.select([self.back], [], [], seconds)[0]:
            return
        data = os.read(self.back, 1 << 20)
        if not data:
            raise RuntimeError("Chromium ended")
        *whole, self.rest = (self.rest + data).split(b"\0")
        for text in whole:
            self.take(json.loads(text))

    def take(self, message):
        """Keep an answer, a complaint of the page, or a file that was saved."""
        if "id" in message:
            self.answers[message["id"]] = message
            return
        kind, p = message["method"], message.get("params", {})
        if kind == "Runtime.exceptionThrown":
            about = p["exceptionDetails"]
            self.complaints.append(about.get("exception", {}).get("description") or about["text"])
        elif kind == "Runtime.consoleAPICalled" and p["type"] in ("error", "warning", "assert"):
            self.complaints.append(" ".join(str(a.get("value", a.get("description"))) for a in p["args"]))
        elif kind == "Log.entryAdded" and p["entry"]["level"] in ("error", "warning"):
            self.complaints.append(p["entry"]["text"] + " " + p["entry"].get("url", ""))
        elif kind == "Browser.downloadWillBegin":
            self.saved[p["guid"]] = [p["suggestedFilename"], False]
        elif kind == "Browser.downloadProgress" and p["state"] == "completed":
            self.saved[p["guid"]][1] = True

    def open(self, page):
        """Load a file and wait until its playback is ready; it does not play by itself."""
        self.call("Page.navigate", url="about:blank")  # at its own address a page would stay as it is
        self.call("Page.navigate", url=pathlib.Path(page).as_uri() + "#still")
        self.until("window.fram?.ready === true", "the page does not get ready")

    def run(self, script):
        """The value of an expression in the page; promises are awaited."""
        answer = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            about = answer["exceptionDetails"]
            raise AssertionError(about.get("exception", {}).get("description") or about["text"])
        return answer["result"].get("value")

    def until(self, script, complaint):
        """Wait until an expression holds."""
        end = time.monotonic() + PATIENCE
        while not self.run(f"Boolean({script})"):
            assert time.monotonic() < end, f"{complaint}; {self.complaints}"
            self.listen(0.05)

    def mouse(self, kind, x, y, buttons=0):
        """A movement, press or release at a point of the page [CSS pixels]."""
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left" if kind != "mouseMoved" else "none",
                  buttons=buttons, clickCount=1)

    def click(self, x, y):
        """Press and let go at a point."""
        self.mouse("mouseMoved", x, y)
        self.mouse("mousePressed", x, y, 1)
        self.mouse("mouseReleased", x, y)

    def click_on(self, name):
        """Click the middle of the element with an id."""
        box = self.box(name)
        self.click(box[0] + box[2] / 2, box[1] + box[3] / 2)

    def box(self, name):
        """Left, top, width, height of an element [CSS pixels]."""
        return self.run(f"(({{left, top, width, height}}) => [left, top, width, height])"
                        f"(document.getElementById('{name}').getBoundingClientRect())")

    def choose(self, name, value):
        """Choose an option as a user does: the element hears of the change."""
        self.run(f"(() => {{ const e = document.getElementById('{name}'); e.value = '{value}';"
                 "e.dispatchEvent(new Event('change')); })()")

    def picture(self, file=None):
        """What the window shows, as PNG bytes."""
        data = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        if file:
            pathlib.Path(file).write_bytes(data)
        return data

    def file(self, ending):
        """The newest file that the page saved with this ending, once it is whole."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            whole = [name for name, done in self.saved.values() if done and name.endswith(ending)]
            if whole:
                return self.downloads / whole[-1]
            self.listen(0.2)
        raise AssertionError(f"the page saved no {ending}: {self.saved}, {self.complaints}")


def pixels(png):
    """Width, height and rows of bytes of an 8-bit RGB or RGBA PNG; channels too."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n", "this is no PNG"
    at, data = 8, b""
    while at < len(png):
        size, kind = struct.unpack(">I4s", png[at:at + 8])
        if kind == b"IHDR":
            width, height, depth, form = struct.unpack(">IIBB", png[at + 8:at + 18])
            assert depth == 8 and form in (2, 6), (depth, form)
        elif kind == b"IDAT":
            data += png[at + 8:at + 8 + size]
        at += size + 12
    channels = 3 if form == 2 else 4
    return width, height, channels, unfilter(zlib.decompress(data), width * channels, channels)


def unfilter(data, stride, step):
    """Rows of a PNG without its filters (W3C, PNG specification, section 9)."""
    rows, before = [], bytearray(stride)
    for at in range(0, len(data), stride + 1):
        kind, row = data[at], bytearray(data[at + 1:at + 1 + stride])
        for i in range(stride) if kind else ():
            left = row[i - step] if i >= step else 0
            if kind == 1:
                guess = left
            elif kind == 2:
                guess = before[i]
            elif kind == 3:
                guess = (left + before[i]) // 2
            else:
                guess = paeth(left, before[i], before[i - step] if i >= step else 0)
            row[i] = (row[i] + guess) & 255
        rows.append(bytes(row))
        before = row
    return rows


def paeth(a, b, c):
    """The neighbour nearest to a + b - c."""
    p = a + b - c
    pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
    return a if pa <= pb and pa <= pc else b if pb <= pc else c


def colours(png, every=7):
    """How many different colours a picture has, looked at on a grid."""
    width, _, channels, rows = pixels(png)
    return len({row[channels * x:channels * x + 3] for row in rows[::every] for x in range(0, width, every)})

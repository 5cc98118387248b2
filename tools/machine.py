"""What results of measurements say about the machine that they were made on."""

import pathlib
import platform


def processor():
    """Its processor in words, as the system calls it."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            return next(line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def load():
    """How many programs wanted its cores over the last minute, as the system writes it."""
    average = pathlib.Path("/proc/loadavg")
    return average.read_text().split()[0] if average.exists() else "unknown"

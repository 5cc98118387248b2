"""Calls of the command under a watchdog, and what every call must keep: it ends, by itself, and says why it failed."""

import contextlib
import json
import os
import resource
import signal
import subprocess
import tempfile
import threading
import time

# A call that computes longer hangs.  Wall time only backs it up: the machine may be busy.
CPU_LIMIT_S = 120
WALL_LIMIT_S = 900
MEMORY_LIMIT_MB = 4096
# 0 good, 1 failed, 2 bad input or usage, 130 interrupted
EXIT_CODES = (0, 1, 2, 130)


class Outcome:
    """What a call left: exit code (negative: a signal), its texts, its time [s] and its largest memory [MB]."""

    def __init__(self, words, code, out, err, wall, cpu, memory, timed_out):
        self.words, self.code, self.out, self.err = words, code, out, err
        self.wall, self.cpu, self.memory, self.timed_out = wall, cpu, memory, timed_out

    def answer(self):
        """The JSON object that ends standard output, or None."""
        lines = [line for line in self.out.splitlines() if line.strip()]
        try:
            value = json.loads(lines[-1]) if lines else None
        except ValueError:
            return None
        return value if isinstance(value, dict) else None

    def fault(self, json_asked=False):
        """What is wrong with how the call ended, as a few words that name a kind of fault; None when nothing is."""
        if self.timed_out or self.code in (-signal.SIGXCPU, -signal.SIGKILL):
            return "hangs"
        if self.code < 0:
            return "dies of " + signal.Signals(-self.code).name
        if self.code not in EXIT_CODES:
            return f"ends with exit code {self.code}"
        if self.code in (1, 2) and not self.err.strip():
            return "fails without a word"
        if "internal" in self.err.lower() and "error" in self.err.lower():
            return "calls it an internal error"
        if json_asked and self.answer() is None:
            return "breaks the promise of --json"
        return None


class Fram:
    """The command, with counts over all calls made through it."""

    def __init__(self, path):
        self.path = os.path.abspath(path)
        self.lock = threading.Lock()
        self.calls, self.longest, self.most_memory = 0, 0.0, 0.0
        self.running = set()

    def start(self, words, environment=None, cpu_limit=CPU_LIMIT_S, **files):
        """A process that somebody else waits for; limits are set, of its computing time in seconds."""
        env = dict(os.environ, LC_ALL="C.UTF-8", **(environment or {}))
        process = subprocess.Popen([self.path, *map(str, words)], env=env, stdin=subprocess.DEVNULL, **files)
        for kind, most in ((resource.RLIMIT_CPU, cpu_limit), (resource.RLIMIT_AS, MEMORY_LIMIT_MB << 20),
                           (resource.RLIMIT_CORE, 0)):
            try:
                resource.prlimit(process.pid, kind, (most, most + 5 if kind == resource.RLIMIT_CPU else most))
            except ProcessLookupError:
                pass
        return process

    def call(self, *words, environment=None, folder=None, signals=()):
        """Call and wait.  signals: (seconds after the start, signal) to send on the way."""
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            began = time.monotonic()
            process = self.start(words, environment, stdout=out, stderr=err, cwd=folder)
            expired = threading.Event()

            def send(number):
                # Popen's own looks whether the process has ended, and so takes its status away from the wait below.
                if process.returncode is None:
                    with contextlib.suppress(ProcessLookupError):
                        os.kill(process.pid, number)

            def kill():
                expired.set()
                send(signal.SIGKILL)

            timers = [threading.Timer(WALL_LIMIT_S, kill)]
            timers += [threading.Timer(after, send, (number,)) for after, number in signals]
            for timer in timers:
                timer.start()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            for timer in timers:
                timer.cancel()
            wall = time.monotonic() - began
            texts = []
            for file in (out, err):
                file.seek(0)
                texts.append(file.read(1 << 22).decode("utf-8", "replace"))
        outcome = Outcome(words, process.returncode, *texts, wall, usage.ru_utime + usage.ru_stime,
                          usage.ru_maxrss / 1024, expired.is_set())
        with self.lock:
            self.calls += 1
            self.longest = max(self.longest, outcome.cpu)
            self.most_memory = max(self.most_memory, outcome.memory)
        return outcome

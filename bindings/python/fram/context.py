"""What a program lends to Fram: threads and a place for its log."""

from __future__ import annotations

import contextlib
import weakref
from typing import Callable, Optional

from ._arguments import call_of, one_of, text_bytes_of, whole_of
from ._library import check, ffi, lib, new_error, owned, text_of

_LEVELS = ("error", "warning", "info", "debug")


class Context:
    """Threads and log of the worlds that are made with it.

    threads: how many of the processor's cores a step may use; results never depend on it.
    log: called as ``log(level, text)`` with level "error", "warning", "info" or "debug", from the thread that called
    the library.  isa: "baseline", "avx2", "avx512" or None for the best.
    """

    def __init__(self, threads: int = 1, log: Optional[Callable[[str, str], None]] = None, isa: Optional[str] = None):
        threads = whole_of("threads", threads, f"1 to {lib.FRAM_THREADS}")
        log = call_of("log", log)
        definition = ffi.new("fram_context_definition *")
        lib.fram_context_default(definition, ffi.sizeof("fram_context_definition"))
        self._stop = ffi.new("int *")
        self._keep = [self._stop]
        raised: list[BaseException] = []
        stop = self._stop

        def keep_exception(_kind, exception, _trace):
            """An exception in a callback is raised when the library has returned; the first one counts."""
            raised.append(exception)
            lib.fram_stop_set(stop, 1)

        self._raised, self._keep_exception = raised, keep_exception
        definition.threads = threads
        definition.stop = self._stop
        if isa is not None:
            self._keep.append(ffi.new("char[]", text_bytes_of("isa", isa)))
            definition.isa = self._keep[-1]

        @ffi.callback("void(void *, const char *, double, double)", onerror=keep_exception)
        def look(_user, _what, _done, _total):
            """Python sees Ctrl-C when it comes to its own code: here, while the library is at work for long."""

        self._keep.append(look)
        definition.work = look
        self._log = log
        self._ending: list[Context] = []  # this one, once for each world that ends its recording as it goes
        if log is not None:
            # The library's functions live as long as its context does, whoever has it: they must not hold the
            # caller's, which may know the worlds of this context.
            me, heard = weakref.ref(self), self._ending

            @ffi.callback("void(void *, fram_log_level, const char *)", onerror=keep_exception)
            def forward(_user, level, text):
                context = me() or (heard[-1] if heard else None)
                if context is not None:
                    context._log(_LEVELS[int(level)], text_of(text))

            self._keep.append(forward)
            definition.log = forward
        error, out = new_error(), ffi.new("fram_context **")
        check(lib.fram_context_create(definition, out, error), error)
        self._pointer = owned(out[0], lib.fram_context_destroy, uses=self._keep)

    @contextlib.contextmanager
    def _heard(self):
        """The log is called in the block though Python's collector has found this context with what goes."""
        self._ending.append(self)
        try:
            yield
        finally:
            self._ending.pop()

    def __copy__(self) -> "Context":
        return self  # it never changes

    def __deepcopy__(self, _memo) -> "Context":
        return self

    def __reduce__(self):
        raise TypeError("a context is of its process and cannot be pickled; scenarios and worlds of the default one "
                        "can be")

    def _check(self, status: int, error) -> None:
        lib.fram_stop_set(self._stop, 0)
        if self._raised:
            raised = self._raised[0]
            self._raised.clear()
            raise raised
        check(status, error)


_default: dict[str, Context] = {}


def default_context() -> Context:
    """The context of everything that is made without one: one thread, no log."""
    # Threads that ask for it at once may make several: one is there first, and is everybody's.
    return _default.get("one") or _default.setdefault("one", Context())


def context_of(context: Optional[Context]) -> Context:
    """The context that is given, or the default one."""
    return default_context() if context is None else one_of("context", context, Context)

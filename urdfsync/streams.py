"""The output and error streams of a command, which neither end its work nor make it fail halfway.

A reader that goes away (`| head`), a full disk, a stream that is closed from the start, an encoding that lacks a
character: the work goes on, and the command says at its end what could not be said.
"""

import errno
import os
import sys

TYPE_CHECKING = False  # that of `typing`, whose import takes longer than all that a command without work does
if TYPE_CHECKING:
    from types import TracebackType
    from typing import Any, TextIO

OUTPUT, ERRORS = "1", "2"
"""How both streams are called in `Said`."""
Said = list[tuple[str, str]]
"""Texts in the order in which they were written, each with its stream."""


class Stream:
    """A text stream that drops what it can't write; `error` is the first reason, None while all is well."""

    def __init__(self, inner: "TextIO", name: str = OUTPUT, said: Said | None = None) -> None:
        """`said` gets all that is written, with `name`, whether it arrives or not."""
        self._inner, self._name, self._said = inner, name, said
        self.error: OSError | None = None
        if hasattr(inner, "reconfigure"):
            inner.reconfigure(errors="backslashreplace")

    def write(self, text: str) -> int:
        """Write `text` unless nobody reads it any more; its length in any case. A full disk may have room again."""
        if self._said is not None:
            self._said.append((self._name, text))
        if self.error is None or self.error.errno == errno.ENOSPC:
            try:
                self._inner.write(text)
            except OSError as error:
                self.error = self.error or error
        return len(text)

    def flush(self) -> None:
        """Pass on what is held back."""
        if self.error is None or self.error.errno == errno.ENOSPC:
            try:
                self._inner.flush()
            except OSError as error:
                self.error = self.error or error

    def __getattr__(self, name: str) -> "Any":
        return getattr(self._inner, name)

    @property
    def trouble(self) -> str:
        """Why the output is incomplete; empty if it is complete, or if its reader has seen enough."""
        self.flush()
        if self.error is None or self.error.errno in (errno.EPIPE, errno.EINVAL):  # EINVAL: the same on Windows
            return ""
        return self.error.strerror or str(self.error)

    def close_broken(self) -> None:
        """Let what a broken stream still holds back go nowhere: Python would complain about it at its exit."""
        if self.error is None:
            return
        try:
            with _nowhere() as nowhere:
                os.dup2(nowhere.fileno(), self._inner.fileno())
        except (OSError, ValueError):
            return  # it has no descriptor


def unrecorded(stream: "Any") -> "Any":
    """The same stream for what is gone again at the end, such as a progress bar: nobody takes that down."""
    return Stream(stream._inner, stream._name) if isinstance(stream, Stream) else stream


class guarded:  # noqa: N801 - used as a function; contextlib is another import
    """Replaces both standard streams while a command runs; gives the output stream.

    `said` gets all that is written to them meanwhile.
    """

    def __init__(self, said: Said | None = None) -> None:
        self._before = sys.stdout, sys.stderr
        self._opened: list[TextIO] = []
        self._out, self._err = (
            Stream(stream or self._open(), name, said)  # what is closed from the start is None
            for stream, name in zip(self._before, (OUTPUT, ERRORS), strict=True)
        )

    def __enter__(self) -> Stream:
        sys.stdout, sys.stderr = self._out, self._err
        return self._out

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: "TracebackType | None"
    ) -> None:
        for stream in (self._out, self._err):
            stream.flush()
            stream.close_broken()
        sys.stdout, sys.stderr = self._before
        for opened in self._opened:
            opened.close()

    def _open(self) -> "TextIO":
        self._opened.append(_nowhere())
        return self._opened[-1]


def _nowhere() -> "TextIO":
    return open(os.devnull, "w", encoding="utf-8")  # noqa: PTH123 - no pathlib here; who opens it closes it

"""Standard streams that neither end a command's work nor make it fail halfway.

A reader may go away (`| head`), a disk be full, a stream be closed from the start, an encoding lack a character. The
work goes on, and the command reports at its end what it could not write.
"""

from __future__ import annotations

import contextlib
import errno
import os
import sys
from collections.abc import Iterator

TYPE_CHECKING = False  # the one of `typing` takes 2 of the 11 ms that a command without work has
if TYPE_CHECKING:
    from typing import Any, TextIO

OUTPUT, ERRORS = "1", "2"
"""Names of the two streams in a `Transcript`."""
Transcript = list[tuple[str, str]]
"""Texts in the order in which they were written, each with the name of its stream."""


class Stream:
    """A text stream that drops what it can't write; `error` is the first reason, None while all is well."""

    def __init__(self, inner: TextIO, name: str = OUTPUT, transcript: Transcript | None = None) -> None:
        """`transcript` gets all that is written, whether it arrives or not."""
        self._inner, self._name, self._transcript = inner, name, transcript
        self.error: OSError | None = None
        if hasattr(inner, "reconfigure"):
            inner.reconfigure(errors="backslashreplace")

    def write(self, text: str) -> int:
        """Write `text` unless nobody reads it any more. Returns its length in any case."""
        if self._transcript is not None:
            self._transcript.append((self._name, text))
        self._try(self._inner.write, text)
        return len(text)

    def flush(self) -> None:
        """Pass on what is held back."""
        self._try(self._inner.flush)

    def _try(self, function: Any, *arguments: str) -> None:
        if self.error is None or self.error.errno == errno.ENOSPC:  # a full disk may have room again
            try:
                function(*arguments)
            except OSError as error:
                self.error = self.error or error

    def __getattr__(self, name: str) -> Any:
        return getattr(self._inner, name)

    @property
    def trouble(self) -> str:
        """Why the output is incomplete; empty if it is complete, or if its reader has seen enough."""
        self.flush()
        if self.error is None or self.error.errno in (errno.EPIPE, errno.EINVAL):  # EINVAL: the same on Windows
            return ""
        return self.error.strerror or str(self.error)

    def without_transcript(self) -> Stream:
        """The same stream for text that does not stay, such as a progress bar."""
        return Stream(self._inner, self._name)

    def close_broken(self) -> None:
        """Discard what a broken stream still holds back: Python would report it at its exit, with exit code 120."""
        if self.error is not None:
            with contextlib.suppress(OSError, ValueError), _devnull() as nowhere:  # it may have no descriptor
                os.dup2(nowhere.fileno(), self._inner.fileno())


@contextlib.contextmanager
def safe_streams(transcript: Transcript | None = None) -> Iterator[Stream]:
    """Replace both standard streams by a `Stream`; yields that of the output."""
    before = sys.stdout, sys.stderr
    with contextlib.ExitStack() as stack:  # a stream that is closed from the start is None
        inner = [stream or stack.enter_context(_devnull()) for stream in before]
        output, errors = (Stream(one, name, transcript) for one, name in zip(inner, (OUTPUT, ERRORS), strict=True))
        sys.stdout, sys.stderr = output, errors
        try:
            yield output
        finally:
            for stream in (output, errors):
                stream.flush()
                stream.close_broken()
            sys.stdout, sys.stderr = before


def _devnull() -> TextIO:
    return open(os.devnull, "w", encoding="utf-8")

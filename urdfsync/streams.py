"""The output and error streams of a command, which neither end its work nor make it fail halfway.

A reader that goes away (`| head`), a full disk, a stream that is closed from the start, an encoding that lacks a
character: the work goes on, and the command says at its end what could not be said.
"""

from __future__ import annotations

import contextlib
import errno
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TextIO, cast


class Stream:
    """A text stream that drops what it can't write; `error` is the first reason, None while all is well."""

    def __init__(self, inner: TextIO) -> None:
        self._inner = inner
        self.error: OSError | None = None
        if hasattr(inner, "reconfigure"):
            inner.reconfigure(errors="backslashreplace")

    def write(self, text: str) -> int:
        """Write `text` unless nobody reads it any more; its length in any case. A full disk may have room again."""
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

    def __getattr__(self, name: str) -> Any:
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
        if self.error is not None:
            with contextlib.suppress(OSError, ValueError), Path(os.devnull).open("wb") as nowhere:
                os.dup2(nowhere.fileno(), self._inner.fileno())


@contextlib.contextmanager
def guarded() -> Iterator[Stream]:
    """Replace both standard streams while a command runs; yields the output stream."""
    before = sys.stdout, sys.stderr
    with contextlib.ExitStack() as stack:
        # what is closed from the start is None
        inner = [stream or stack.enter_context(Path(os.devnull).open("w", encoding="utf-8")) for stream in before]
        out, err = map(Stream, inner)
        sys.stdout, sys.stderr = cast("TextIO", out), cast("TextIO", err)
        try:
            yield out
        finally:
            for stream in (out, err):
                stream.flush()
                stream.close_broken()
            sys.stdout, sys.stderr = before

"""Standard streams whose faults do not stop a command.

The reader may stop early (`| head`), the disk may be full, or the encoding may lack a character. The
command finishes its work, and reports the fault at its end.
"""

from __future__ import annotations

import codecs
import errno
import os
import sys

TYPE_CHECKING = False  # importing `typing` takes 2 of the 25 ms of a no-op build, contextlib 1
if TYPE_CHECKING:
    from typing import IO, Any, TextIO


_FALLBACK = "urdfsync"
_PLAIN = {"→": "->", "…": "...", "·": "|", "²": "^2", "³": "^3", "×": "x", "°": " deg", "±": "+-", "−": "-", "─": "-"}
"""What an encoding may lack, and what stands for it: those of Windows' pipes lack `→`."""


def _spell_out(error: UnicodeError) -> tuple[str, int]:
    """Return plain signs for characters that an encoding lacks, else their numbers; and where to go on."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    signs = error.object[error.start : error.end]
    plain = (_PLAIN.get(sign) or sign.encode("ascii", "backslashreplace").decode() for sign in signs)
    return "".join(plain), error.end


codecs.register_error(_FALLBACK, _spell_out)


class Stream:
    """A text stream that drops texts that it can't write; `error` is the first failure, None without one."""

    def __init__(self, inner: TextIO) -> None:
        self._inner = inner
        self.error: OSError | None = None
        if hasattr(inner, "reconfigure"):
            inner.reconfigure(errors=_FALLBACK)
            if sys.platform == "win32" and not inner.isatty():
                from urdfsync.common.system import pipe_encoding

                # a shell or a program reads it: bash refuses `\r`
                inner.reconfigure(newline="\n", encoding=pipe_encoding(inner.encoding), errors=_FALLBACK)

    def write(self, text: str) -> int:
        """Write `text` unless an earlier write failed. Returns its length, even if it is dropped."""
        self._try(self._inner.write, text)
        return len(text)

    def write_bytes(self, content: bytes) -> None:
        """Write bytes as they are, unless an earlier write failed."""
        self.flush()
        self._try(self._inner.buffer.write, content)

    def flush(self) -> None:
        """Pass on the buffered text."""
        self._try(self._inner.flush)

    def _try(self, function: Any, *arguments: str | bytes) -> None:
        if self.error is None or self.error.errno == errno.ENOSPC:  # a full disk may have space later
            try:
                function(*arguments)
            except OSError as error:
                self.error = self.error or error

    def __getattr__(self, name: str) -> Any:
        return getattr(self._inner, name)

    @property
    def trouble(self) -> str:
        """Why the output is incomplete; empty if it is complete, or if its reader stopped early."""
        self.flush()
        if self.error is None or self.error.errno in (errno.EPIPE, errno.EINVAL):  # EINVAL: EPIPE on Windows
            return ""
        return self.error.strerror or str(self.error)

    def close_broken(self) -> None:
        """Discard the buffer of a broken stream: at its exit, Python would report the fault, with exit code 120."""
        if self.error is None:
            return
        try:
            with _devnull() as nowhere:
                os.dup2(nowhere.fileno(), self._inner.fileno())
        except (OSError, ValueError):
            return  # the stream has no descriptor


class SafeStreams:
    """Replaces both standard streams by a `Stream` inside a `with` block; the block gets the `Stream` of stdout."""

    def __init__(self) -> None:
        self._before = sys.stdout, sys.stderr
        self._inner = [stream or _devnull() for stream in self._before]  # a closed stream is None
        self._output, self._errors = map(Stream, self._inner)

    def __enter__(self) -> Stream:
        sys.stdout, sys.stderr = self._output, self._errors
        return self._output

    def __exit__(self, *_: object) -> None:
        for stream in (self._output, self._errors):
            stream.flush()
            stream.close_broken()
        sys.stdout, sys.stderr = self._before
        for inner, before in zip(self._inner, self._before, strict=True):
            if inner is not before:
                inner.close()


def _devnull() -> TextIO:
    return open(os.devnull, "w", encoding="utf-8")


def is_terminal(stream: IO[str] | Stream) -> bool:
    """Return whether the stream is a terminal, or the user forces colours."""
    return bool(stream.isatty() or os.environ.get("FORCE_COLOR"))


def has_marks(stream: IO[str] | Stream) -> bool:
    """Return whether signs like ✓ can be shown."""
    return is_terminal(stream) and str(getattr(stream, "encoding", "")).lower().startswith("utf")


def has_colours(stream: IO[str] | Stream) -> bool:
    """Return whether the terminal and the user allow colours."""
    is_plain = os.environ.get("NO_COLOR") or os.environ.get("TERM") in ("dumb", "unknown")
    return is_terminal(stream) and not is_plain

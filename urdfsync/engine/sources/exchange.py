"""What a build or a check asks of the process that expands a source, and what the process answers."""

from __future__ import annotations

import atexit
import gc
import sys
from collections.abc import Callable, Mapping

import msgspec

from urdfsync.common.dependencies.facts import MAX_FILE
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.processes import reserve_stdout

_GARBAGE_THRESHOLD = 100_000
"""New objects after which Python looks for cycles."""


class Request(msgspec.Struct, frozen=True):
    """A file to expand; paths are absolute."""

    source: str
    arguments: Mapping[str, str]
    package_paths: tuple[str, ...]
    seconds: float
    """The CPU time that the expansion may take, in s."""
    memory: int
    """The bytes that the expansion may allocate."""
    folder: str = "."
    """The value of `$(cwd)`. The process has another working folder: PYTHONPATH may have relative entries."""
    contents: Mapping[str, bytes] = {}
    """Contents of files that override the disk, by path."""
    text: str = ""
    """An expanded text to compare with the source; empty to expand the source."""


def fault(code: str, message: str, file: str = "", line: int = 0, hint: str = "") -> Diagnostic:
    """Return the reason why a file can't be expanded; `hint` is better than the usual one for the code."""
    return Diagnostic(Severity.ERROR, code, message, file, line, hint=hint)


class Answer(msgspec.Struct, frozen=True):
    """The expanded text, and all inputs, even after a failure; files are absolute."""

    text: str = ""
    places: tuple[tuple[int, str, int], ...] = ()
    """Line of each element in the text, and the element's original file and line."""
    files: Mapping[str, str | None] = {}
    """Hash of each file that was read; None for a missing one."""
    patterns: tuple[str, ...] = ()
    variables: tuple[str, ...] = ()
    """The environment variables that the source has asked for."""
    packages: Mapping[str, str | None] = {}
    """Folders of the packages that the source has asked for; None for a missing one."""
    unknown: tuple[str, ...] = ()
    """Given arguments that the source does not declare."""
    warnings: tuple[str, ...] = ()
    problem: Diagnostic | None = None
    compared: int = 0
    """The count of numbers that were compared, if the request has a text."""
    differences: tuple[str, ...] = ()
    """A clause for each quantity of the text that differs from the source."""
    uncompared: tuple[str, ...] = ()
    """Parts of the source that this does not compare."""


def not_unicode(code: str) -> Diagnostic:
    """Return the problem of a text or a path that is not UTF-8."""
    hint = "rename its folders and files, or correct the text, then build again"
    return fault(code, "a text or a path that it works with is not UTF-8", hint=hint)


def too_large(code: str) -> Diagnostic:
    """Return the problem of a text that is larger than a source may be."""
    return fault(code, f"it expands to more than {MAX_FILE:,} bytes")


def encode(answer: Answer, code: str) -> bytes:
    """Return an answer as JSON; if that is impossible or too large, return an answer with this problem of `code`."""
    try:
        content = msgspec.json.encode(answer)
    except UnicodeEncodeError:
        return msgspec.json.encode(Answer(problem=not_unicode(code)))
    if len(content) > MAX_FILE:
        return msgspec.json.encode(Answer(problem=too_large(code)))
    return content


def serve(answer: Callable[[Request], Answer], code: str) -> None:
    """Answer the request on stdin; a program calls this as its last step."""
    # looks for garbage seldom, and not at the end: 0.05 of 0.7 s of an MJCF
    gc.set_threshold(_GARBAGE_THRESHOLD)
    atexit.register(gc.freeze)
    request = msgspec.json.decode(sys.stdin.buffer.read(), type=Request)
    with reserve_stdout() as answers:
        answers.write(encode(answer(request), code))

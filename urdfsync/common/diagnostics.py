"""Findings about the user's input: severity, code, message, file and line."""

from __future__ import annotations

import enum
import functools
import os
from typing import Self

import msgspec

from urdfsync.common import system

IGNORABLE = frozenset(
    "as-recorded broken-state byte-order-mark compiler-warning connector-changed does-not-compile dotted-modifier "
    "empty-cell equal-connections fmu-differs fmu-not-simulated fmu-not-valid kept-save other-part "
    "left-behind limit-passed nested-redeclare no-joints no-package-path no-plot no-users-path no-uses no-variable "
    "not-checked order-lacks order-twice out-of-step overshoot put-aside rename-done "
    "renamed-robot repeated same-but-for-case stray-state stray-template terminated too-long too-many-folders "
    "units unused unused-argument unresolved wrong-kind wrong-within xacro-said".split()
)
"""Codes of warnings and notes that a configuration may ignore, beside the codes of the robot's domain."""
OF_SOURCES = frozenset("empty-cell units unused unused-argument xacro-said".split())
"""Those of them that each build finds in a source: a configuration may refuse them, and the codes of the domain."""


_LONGEST = 1000
"""The greatest number of characters of a message, a hint or a detail: a name in the text may have any length."""
_PLACES = 8
"""The greatest number of places that a sentence lists."""


def cut(text: str, longest: int) -> str:
    """Return a text; leave out its middle if it is longer than `longest`."""
    if len(text) <= longest:
        return text
    end = longest // 4
    return f"{text[: longest - end - 1]}…{text[-end:]}"


class Severity(enum.StrEnum):
    """How much a diagnostic matters: an error stops the build of its robot, a warning does not."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


class Detail(msgspec.Struct, frozen=True):
    """A further place of a finding."""

    line: int
    text: str = ""
    """What stands there; empty for another finding like the first."""
    file: str = ""
    """Empty for the finding's own file."""

    def __str__(self) -> str:
        """Return the place with its text: `line 3: <camera> eye`, or `arm.xacro:3: <camera> eye`."""
        return f"{f'{self.file}:' if self.file else 'line '}{self.line}: {self.text}".rstrip(": ")


class Diagnostic(msgspec.Struct, frozen=True):
    """One finding about one place of the user's input.

    `code` is a stable, lower-case word such as `duplicate-link`. `message` is a sentence without a full stop that names
    the faulty thing. `hint` says what to do. `file` is shown as it is given; `line` and `column` count from 1, and 0
    stands for unknown.
    """

    severity: Severity
    code: str
    message: str
    file: str = ""
    line: int = 0
    column: int = 0
    hint: str = ""
    details: tuple[Detail, ...] = ()
    """Further places, which `--verbose` lists."""
    element: str = ""
    """The part of the model, as `diff` names it: `link hand / inertial`; empty if the finding is about no part."""
    is_new: bool = False
    """Whether the model of the last build, or the older version, lacks this finding."""

    def __post_init__(self) -> None:
        """Cut texts that are too long for a line."""
        for field, text in (("message", self.message), ("hint", self.hint)):
            if len(text) > _LONGEST:
                msgspec.structs.force_setattr(self, field, cut(text, _LONGEST))

    def __str__(self) -> str:
        """Return the finding as one line: `file:line:column: severity: message; hint [code]`."""
        numbers = [str(number) for number in (self.line, self.column) if number]
        place = ":".join([self.file, *numbers]) + ": " if self.file else ""
        return " ".join(f"{place}{self.severity}: {self.sentence} [{self.code}]".split())

    @property
    def sentence(self) -> str:
        """The message with its hint."""
        since = "since this export: " if self.is_new else ""
        return since + "; ".join(filter(None, (self.statement, self.hint)))

    @property
    def statement(self) -> str:
        """The message with the places of further findings like it."""
        more = [detail for detail in self.details if not detail.text]
        if not more:
            return self.message
        has_others = any(detail.file not in ("", self.file) for detail in more)
        places = dict.fromkeys(f"{detail.file or self.file}:{detail.line}" for detail in more)
        words = [place if has_others else place.rpartition(":")[2] for place in places]
        listed = ", ".join(words[:_PLACES]) + (", …" if len(words) > _PLACES else "")
        return f"{self.message} (and {len(more)} more like it: line{'s' * (len(words) > 1)} {listed})"


def internal_error(error: Exception, what: str = "") -> Diagnostic:
    """Return the finding for a bug in urdfsync: the place of the exception, and a file with the traceback."""
    import traceback  # takes 4 ms, and is rarely needed

    frame = traceback.extract_tb(error.__traceback__)[-1]
    place = f"{os.path.basename(frame.filename)}, line {frame.lineno}"  # noqa: PTH119 - no pathlib for this alone
    message = f"{what}{type(error).__name__} in {place}: {error}".rstrip(": ")
    if isinstance(error, MemoryError):
        message = f"{what}there is not enough memory"
    file = _save_traceback("".join(traceback.format_exception(error)))
    hint = f"this is a bug in urdfsync: please report it{file and f' with the traceback in {file}'}"
    return Diagnostic(Severity.ERROR, "internal", message, hint=hint)


@functools.lru_cache(maxsize=16)  # the daemon may hit the same bug in each build
def _save_traceback(text: str) -> str:
    """Write a traceback to a temporary file and return the file's path; empty if the file can't be written."""
    import tempfile

    try:
        number, path = tempfile.mkstemp(prefix="urdfsync-", suffix=".traceback.txt")
        with open(number, "w", encoding="utf-8", errors="backslashreplace") as file:  # noqa: PTH123 - open already
            file.write(text)
    except OSError:
        return ""
    return path


class UrdfsyncError(Exception):
    """Base of all errors that a user can cause; its `diagnostics` explain the error."""

    is_locked = False
    """Whether another process builds the same robots: the exit code is 4, not 2."""

    def __init__(self, *diagnostics: Diagnostic) -> None:
        super().__init__(*diagnostics)  # pickle needs these arguments when a worker raises it
        self.diagnostics = diagnostics

    @classmethod
    def of(cls, code: str, message: str, file: str = "", line: int = 0, *, hint: str = "") -> Self:
        """Return the error of a single finding."""
        return cls(Diagnostic(Severity.ERROR, code, message, file, line, hint=hint))

    def __str__(self) -> str:
        """Return each finding as a line."""
        return "\n".join(map(str, self.diagnostics))


class ConfigError(UrdfsyncError):
    """The configuration can't be used."""


class SourceError(UrdfsyncError):
    """A source can't be read as a model."""


class StateError(UrdfsyncError):
    """The recorded state of an earlier build can't be used."""


class OutputError(UrdfsyncError):
    """The outputs can't be written."""


def findings_of(error: Exception) -> tuple[Diagnostic, ...]:
    """Return the diagnostics of an exception; for a bug in urdfsync, a diagnostic about an internal error.

    Loops over robots catch every exception and call this function, so one robot never stops the others.
    """
    if isinstance(error, UrdfsyncError):
        return error.diagnostics
    if not isinstance(error, OSError):
        return (internal_error(error),)
    place = os.fsdecode(error.filename or "")
    hint = system.held_hint(error)
    return (Diagnostic(Severity.ERROR, "system", error.strerror or str(error), place, hint=hint),)

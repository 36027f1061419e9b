"""How lines look on a terminal, a pipe or in a file: colours, marks, and nothing that a terminal would obey."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import IO, TYPE_CHECKING, Literal

import msgspec

from urdfsync import wording
from urdfsync.diagnostics import Diagnostic, Severity

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

_SEVERITIES = {Severity.ERROR: "bold red", Severity.WARNING: "yellow", Severity.NOTE: "cyan"}


class Words(msgspec.Struct, frozen=True):
    """The words of one line, and how each of them looks; to rich it is a text."""

    parts: tuple[tuple[str, str], ...]

    def __str__(self) -> str:
        """The line without looks."""
        return "".join(text for text, _ in self.parts)

    def __rich__(self) -> Text:
        """The line with looks."""
        from rich.text import Text

        return Text.assemble(*self.parts)


def show(lines: Iterable[Words | Text], stream: IO[str]) -> None:
    """Write lines, of which none is broken. Files and pipes get what rich would write to them, without loading it."""
    if is_terminal(stream):
        screen = console(stream)
        for line in lines:
            screen.print(line, soft_wrap=True)
    else:
        for line in lines:
            stream.write(f"{line}\n")
            stream.flush()


def console(stream: IO[str]) -> Console:
    """A console of rich on this stream."""
    from rich.console import Console

    system: Literal["auto"] | None = "auto" if is_styled(stream) else None
    return Console(file=stream, highlight=False, force_terminal=is_terminal(stream), color_system=system)


def is_terminal(stream: IO[str]) -> bool:
    """Whether people look at the stream, or want it to look as if."""
    return stream.isatty() or bool(os.environ.get("FORCE_COLOR"))


def is_styled(stream: IO[str]) -> bool:
    """Whether colours and bold letters are understood and wanted."""
    plain = os.environ.get("NO_COLOR") or os.environ.get("TERM") in ("dumb", "unknown")
    return is_terminal(stream) and not plain


def has_marks(stream: IO[str]) -> bool:
    """Whether signs like ✓ can be shown."""
    return is_terminal(stream) and str(getattr(stream, "encoding", "")).lower().startswith("utf")


def words(*parts: tuple[str, str]) -> Words:
    """One line. Nothing in it can move the cursor or turn the writing round."""
    return Words(tuple((wording.visible(text), style) for text, style in parts))


def text(*parts: tuple[str, str]) -> Text:
    """The same for what only rich can do with it."""
    return words(*parts).__rich__()


def finding(found: Diagnostic) -> Words:
    """A diagnostic as one line: `file:line: severity: message [code]`."""
    numbers = [str(number) for number in (found.line, found.column) if number]
    place = ":".join([found.file, *numbers]) + ": " if found.file else ""
    hint = f"; {found.hint}" if found.hint else ""
    message = " ".join(f"{found.message}{hint}".split())
    style = _SEVERITIES[found.severity]
    return words((place, "bold"), (found.severity.value, style), (f": {message} ", ""), (f"[{found.code}]", "dim"))

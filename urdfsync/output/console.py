"""The output of one command: lines for people, or one document in JSON, Markdown or SARIF.

Findings, progress and errors go to the error stream, everything else to the output stream. Text quoted from files can't
control a terminal: `visible` escapes it.
"""

from __future__ import annotations

import importlib
import io
import json
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import IO, TYPE_CHECKING, Any, Literal, TypeAlias, TypeVar

import msgspec

from urdfsync.common import noop
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.spelling import visible
from urdfsync.common.streams import Stream, has_colours, has_marks, is_terminal
from urdfsync.output.documents import Document, plain

if TYPE_CHECKING:
    import rich.console
    from rich.progress import Progress, TaskID
    from rich.text import Text

R = TypeVar("R", bound=msgspec.Struct)
Format: TypeAlias = Literal["text", "json", "markdown", "sarif"]
"""The format of the output stream."""
PURPOSES: Mapping[Format, str] = {"markdown": "for a comment", "sarif": "for findings at their lines"}
"""The purpose of formats, for the help."""
FEW = 5
"""The greatest number of warnings of one code that are shown; further warnings are counted."""
BAR_AFTER = 0.5
"""Seconds of work before a progress bar appears."""
_SEVERITIES = {Severity.ERROR: "bold red", Severity.WARNING: "yellow", Severity.NOTE: "cyan"}


class StyledLine(msgspec.Struct, frozen=True):
    """One line as pieces of text, each with a style of rich; the style is empty for plain text.

    Pipes and files get the text without rich: its import takes 20 of the 95 ms in which a build writes one changed
    mass.
    """

    parts: tuple[tuple[str, str], ...]

    def __str__(self) -> str:
        """Return the line without styles."""
        return "".join(text for text, _ in self.parts)

    def __rich__(self) -> Text:
        """Return the line with styles."""
        from rich.text import Text

        return Text.assemble(*self.parts)


def line(*parts: tuple[str, str]) -> StyledLine:
    """Return a line of pieces of text with their styles; control characters are escaped."""
    return StyledLine(tuple((visible(text), style) for text, style in parts))


def table_lines(rows: Sequence[tuple[Sequence[str], str]]) -> Iterator[StyledLine]:
    """Yield rows of cells in aligned columns, each row with its style; nothing for a header without rows."""
    widths = [max(map(len, column)) for column in zip(*(cells for cells, _ in rows), strict=True)]
    for cells, style in rows if len(rows) > 1 else ():
        aligned = "  ".join(cell.ljust(width) for cell, width in zip(cells, widths, strict=True))
        yield line((f"  {aligned}".rstrip(), style))


def file_lines(files: Mapping[str, object]) -> Iterator[StyledLine]:
    """Yield a line for each file that a command was asked to write, by kind."""
    for kind, file in files.items():
        yield line((f"  {kind}: ", ""), (str(file), "bold"))


def first_lines(lines: Sequence[StyledLine], most: int, noun: str, *, verbose: bool) -> Sequence[StyledLine]:
    """Return at most `most` lines, of which the last gives the number of missing lines; with `verbose` all lines."""
    rest = len(lines) - most + 1
    if verbose or rest < 2:
        return lines
    return [*lines[: most - 1], line((f"  … and {rest} more {noun}s; --verbose shows them", "dim"))]


def findings(diagnostics: Sequence[Diagnostic], *, quiet: bool = False, verbose: bool = False) -> list[StyledLine]:
    """Return diagnostics as lines: with `quiet` only errors, without `verbose` only the first warnings of a code."""
    if quiet:
        diagnostics = [diagnostic for diagnostic in diagnostics if diagnostic.severity is Severity.ERROR]
    total, seen, hidden = Counter(diagnostic.code for diagnostic in diagnostics), Counter[str](), Counter[str]()
    lines = []
    for diagnostic in diagnostics:
        seen[diagnostic.code] += 1
        is_early = total[diagnostic.code] <= FEW or seen[diagnostic.code] < FEW
        if verbose or is_early or diagnostic.severity is Severity.ERROR:
            place, severity, rest = str(diagnostic).partition(f"{diagnostic.severity}: ")
            lines.append(line((place, "bold"), (severity, _SEVERITIES[diagnostic.severity]), (rest, "")))
            lines += [line((f"  {detail}", "dim")) for detail in diagnostic.details if verbose]
        else:
            hidden[diagnostic.code] += 1
    more = (f"and {number} more like these [{code}]; --verbose shows them" for code, number in hidden.items())
    return [*lines, *(line((words, "dim")) for words in more)]


def rich_console(stream: IO[str]) -> rich.console.Console:
    """Return a console of rich on this stream, with colours if the terminal and the user allow them."""
    from rich.console import Console

    system: Literal["auto"] | None = "auto" if has_colours(stream) else None
    return Console(file=stream, highlight=False, force_terminal=is_terminal(stream), color_system=system)


def write_lines(lines: Iterable[StyledLine], stream: IO[str]) -> None:
    """Write lines without wrapping them."""
    if is_terminal(stream):
        screen = rich_console(stream)
        for text in lines:
            screen.print(text, soft_wrap=True)
        return
    for text in lines:
        stream.write(f"{text}\n")
        stream.flush()


def html(lines: Iterable[StyledLine]) -> str:
    """Return lines as a paragraph of HTML, with their styles."""
    from rich.console import Console

    screen = Console(record=True, file=io.StringIO(), highlight=False)
    for text in lines:
        screen.print(text, soft_wrap=True)
    return screen.export_html(inline_styles=True, code_format="<pre>{code}</pre>")


class Console:
    """The output of one command."""

    def __init__(
        self,
        command: str = "",
        *,
        format: Format = "text",  # noqa: A002 - its option's name
        quiet: bool = False,
        verbose: bool = False,
        config: str = "",
    ) -> None:
        """`config` is the path of --config as the user wrote it, for the commands in hints."""
        self._command, self.config = command, config
        self.format, self.quiet, self.verbose = format, quiet, verbose
        self._results: list[msgspec.Struct] = []
        self._sections: list[Any] = []
        self._warnings: Sequence[Diagnostic] = ()
        self._begin = time.monotonic()
        self.counts_robots = False
        """Whether robots with nothing to tell are counted at the end, instead of a line for each."""
        self.uneventful = Counter[str]()
        """The number of these robots by their summary."""
        self.repeated_findings: list[int] = []
        """The number of findings that the last build has shown already, for each robot that has any."""
        self._bar: tuple[Progress, TaskID] | None = None

    @property
    def has_warned(self) -> bool:
        """Whether there was a warning that belongs to no robot."""
        return bool(self._warnings)

    @property
    def is_document(self) -> bool:
        """Whether a document takes the place of lines on the output stream."""
        return self.format != "text"

    def print(self, lines: Iterable[StyledLine], *, error: bool = False) -> None:
        """Write lines on the output stream; with `error` on the error stream."""
        self.stop_progress()
        write_lines(lines, sys.stderr if error else sys.stdout)

    def write(self, content: bytes) -> None:
        """Write bytes on the output stream."""
        self.stop_progress()
        stream = sys.stdout if isinstance(sys.stdout, Stream) else Stream(sys.stdout)
        stream.write_bytes(content)

    def tell(self, lines: Iterable[StyledLine]) -> None:
        """Write lines on the output stream, unless it gets a document or the user gives --quiet."""
        if not (self.is_document or self.quiet):
            self.print(lines)

    def findings(self, diagnostics: Sequence[Diagnostic]) -> None:
        """Show diagnostics to people."""
        if not self.is_document and diagnostics:
            self.print(findings(diagnostics, quiet=self.quiet, verbose=self.verbose), error=True)

    def warnings(self, diagnostics: Sequence[Diagnostic]) -> None:
        """Show diagnostics that belong to no robot and that do not end the command."""
        self._warnings = diagnostics
        self.findings(diagnostics)

    def announce(self, robots: int) -> None:
        """Say how many robots the command is about: if there are many, those with nothing to tell are counted."""
        self.counts_robots = robots > noop.MANY and not self.verbose

    def add(self, result: R, to_section: Callable[[R], Any] | None = None) -> None:
        """Add a result to the document; a later failure of the command does not remove it."""
        self.stop_progress()
        if self.format == "json":
            self._results.append(result)
        elif self.is_document and to_section:
            self._sections.append(to_section(result))

    def end(self, code: int, diagnostics: Sequence[Diagnostic] = ()) -> int:
        """End a command: show its errors, or write its document. Returns the exit code."""
        self.stop_progress()
        if not self.is_document:
            self.count_robots()
            self.findings(diagnostics)
            return code
        self.write(self._document(code, (*self._warnings, *diagnostics)).encode(errors="backslashreplace"))
        return code

    def count_robots(self) -> None:
        """Show the numbers that stand for the lines of many robots, once."""
        marks = [("✓ ", "green")] if has_marks(sys.stdout) else []
        for summary, robots in self.uneventful.items():
            self.tell([line(*marks, (noop.robots_in_words(robots), "bold"), (f": {summary}", ""))])
        if self.repeated_findings and not self.quiet:
            self.print([line((noop.findings_in_words(self.repeated_findings), "dim"))], error=True)
        self.uneventful.clear()
        self.repeated_findings.clear()

    def _document(self, code: int, diagnostics: Sequence[Diagnostic]) -> str:
        """Return the document; `diagnostics` belong to no robot."""
        if self.format != "json":  # each other format has a module, which most commands do not need
            document: str = importlib.import_module(f"urdfsync.output.{self.format}").document(
                self._sections, diagnostics, code
            )
            return document
        values = Document(command=self._command, exit=int(code), results=self._results, diagnostics=diagnostics)
        indent = None if self._command == "watch" else 2  # each line of the daemon's output is one object
        return json.dumps(plain(values), indent=indent) + "\n"

    def progress(self, what: str, done: int, total: int) -> None:
        """Show the present step, if the command has worked for more than a moment."""
        is_wanted = not self.is_document and not self.quiet and sys.stderr.isatty()
        if not is_wanted or time.monotonic() - self._begin < BAR_AFTER:
            return
        if self._bar is None:
            from rich.progress import Progress

            bar = Progress(
                console=rich_console(sys.stderr), transient=True, redirect_stdout=False, redirect_stderr=False
            )
            self._bar = bar, bar.add_task(what, total=total)
            bar.start()
        bar, task = self._bar
        bar.update(task, description=what, completed=done, total=total)

    def telling(self, mark: str = "") -> Callable[[str, int, int], None]:
        """Return a progress that also prints the first step with this mark, since a pipe shows no progress."""
        told = list[str]()

        def progress(what: str, done: int, total: int) -> None:
            if not told and mark in what:
                told.append(what)
                if not (self.quiet or self.is_document):
                    self.print([line((what, "dim"))], error=True)
            self.progress(what, done, total)

        return progress

    def stop_progress(self) -> None:
        """Remove the progress bar."""
        if self._bar is not None:
            self._bar[0].stop()
            self._bar = None
        self._begin = time.monotonic()

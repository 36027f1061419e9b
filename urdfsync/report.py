"""What people and programs see of a command.

For people: one headline per robot, findings as `file:line: severity: message` on the error stream,
conflicts with what to do about them. For programs: one JSON document on the output stream. Only
this module knows rich, and imports it only when there is more to say than that all is in step.
"""

from __future__ import annotations

import json
import os
import shlex
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, Literal

from urdfsync import wording
from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.outcome import Exit, Result
from urdfsync.plan import CONFLICTS, Action, Kind

if TYPE_CHECKING:
    from rich.console import Console
    from rich.progress import Progress, TaskID
    from rich.text import Text

    from urdfsync.init import Draft

VERSION = 1
"""Version of the JSON documents; raised when a key changes its meaning or goes away."""

_PATIENCE = 0.5
"""Seconds of work before a progress bar appears."""
_SEVERITIES = {Severity.ERROR: "bold red", Severity.WARNING: "yellow", Severity.NOTE: "cyan"}
_KINDS = {
    Kind.CREATE: "green",
    Kind.RESTORE: "green",
    Kind.ADOPT: "green",
    Kind.UPDATE: "green",
    Kind.DELETE: "magenta",
    Kind.KEEP: "cyan",
    Kind.ORPHAN: "yellow",
    Kind.NEEDED: "yellow",
    Kind.CONFLICT: "bold red",
    Kind.UNOWNED: "bold red",
}
_LISTED = CONFLICTS | {Kind.ORPHAN, Kind.NEEDED}
"""What is named file by file even if nobody asks."""
_CHANGES = 12
"""So many changes of a model are shown at most, unless somebody asks."""
_ADVICE = (
    "  Your file stays as it is. To settle a conflict, move the file out of the package and build again,",
    "  then put your edits into the file that urdfsync has written.",
)


class Report:
    """Says what happened, in the way that a command's options ask for."""

    def __init__(
        self, as_json: bool = False, quiet: bool = False, verbose: bool = False, explain: bool = False
    ) -> None:
        self._json, self._quiet, self._verbose, self._explain = as_json, quiet, verbose, explain
        self._begin = time.monotonic()
        self._bar: tuple[Progress, TaskID] | None = None
        self._results: list[Result] = []
        self._warnings: Sequence[Diagnostic] = ()

    def progress(self, what: str, done: int, total: int) -> None:
        """Show a step of the work, once the work takes long enough for anybody to wonder."""
        if self._json or self._quiet or not sys.stderr.isatty() or time.monotonic() - self._begin < _PATIENCE:
            return
        if self._bar is None:
            from rich.progress import Progress

            bar = Progress(console=_console(sys.stderr), transient=True)
            self._bar = bar, bar.add_task(what, total=total)
            bar.start()
        self._bar[0].update(self._bar[1], description=what, completed=done, total=total)

    def warnings(self, diagnostics: Sequence[Diagnostic]) -> None:
        """Findings that concern the whole command and do not stop it."""
        self._warnings = diagnostics
        if not self._json:
            self._findings(diagnostics)

    def result(self, result: Result) -> None:
        """Show what was done with one robot."""
        self._stop_bar()
        self._results.append(result)
        if self._json:
            return
        self._findings(result.diagnostics)
        if self._quiet and not result.conflicts:
            return
        if result.in_step and not (self._explain or self._verbose or result.drawing or result.changes):
            _plain(result.robot, wording.summary(result))
            return
        console = _console(sys.stderr if result.failed else sys.stdout)
        for line in self._lines(result, console):
            console.print(line, soft_wrap=True)

    def finish(self, command: str, code: Exit) -> None:
        """The end of a build: the JSON document, if one is asked for."""
        self._stop_bar()
        if self._json:
            robots = [wording.robot(result) for result in self._results]
            self._document(command, code, {"robots": robots}, self._warnings)

    def problems(self, command: str, diagnostics: Sequence[Diagnostic], code: Exit = Exit.ERROR) -> None:
        """Findings that stopped the whole command."""
        self._stop_bar()
        if self._json:
            robots = [wording.robot(result) for result in self._results]
            self._document(command, code, {"robots": robots}, [*self._warnings, *diagnostics])
        else:
            self._findings(diagnostics)

    def bad_usage(self, command: str, usage: str, found: Diagnostic) -> None:
        """Say what is wrong with the arguments of a command, and how it is called."""
        if not self._json:
            sys.stderr.write(usage)
        self.problems(command, [found])

    def draft(self, draft: Draft) -> None:
        """Show the configuration that `init` wrote."""
        if self._json:
            robots = [
                {
                    "name": guess.robot,
                    "source": guess.source,
                    "package": guess.package,
                    "options": [{"option": o.option, "value": o.value, "reason": o.reason} for o in guess.options],
                }
                for guess in draft.guesses
            ]
            values = {"config": str(draft.file), "robots": robots}
            self._document("init", Exit.IN_STEP, values, draft.diagnostics)
            return
        self._findings(draft.diagnostics)
        if not self._quiet:
            console = _console(sys.stdout)
            for line in _draft_lines(draft):
                console.print(line, soft_wrap=True)

    def library(self, folder: Path) -> None:
        """Show where the Modelica library is, and how a Modelica tool finds it; to `eval`, only the latter."""
        if os.name == "nt":
            line = f"set MODELICAPATH={folder};%MODELICAPATH%"
        else:
            line = f'export MODELICAPATH={shlex.quote(str(folder))}"${{MODELICAPATH:+:$MODELICAPATH}}"'
        if self._json:
            self._document("library", Exit.IN_STEP, {"folder": str(folder), "line": line})
        elif sys.stdout.isatty():
            sys.stdout.write(f"{wording.visible(str(folder))}\n{wording.visible(line)}\n")
        else:
            sys.stdout.write(f"{line}\n")

    def _lines(self, result: Result, console: Console) -> Iterator[Text]:
        yield _headline(result, console)
        if result.changes:
            lines = wording.changes(result.changes)
            few = len(lines) if self._verbose or len(lines) <= _CHANGES else _CHANGES - 1
            yield from (_text((f"  {line}", "")) for line in lines[:few])
            if few < len(lines):
                yield _text((f"  … and {len(lines) - few} more changes; --verbose shows them", "dim"))
        if self._explain or self._verbose:
            yield from _explanation(result, console, everything=self._explain)
        else:
            for action in result.actions:
                if action.kind in _LISTED:
                    yield _text(("  ", ""), *_verdict(action, _place(result, action)))
        if result.conflicts:
            yield from (_text((line, "dim")) for line in _ADVICE)
        if result.drawing:
            yield _text((f"  diagram: {shown(result.drawing)}", ""))

    def _document(
        self, command: str, code: Exit, values: dict[str, Any], diagnostics: Sequence[Diagnostic] = ()
    ) -> None:
        findings = [wording.finding(diagnostic) for diagnostic in diagnostics]
        document = {"version": VERSION, "command": command, "exit": int(code), **values, "diagnostics": findings}
        sys.stdout.write(json.dumps(document, indent=2) + "\n")

    def _findings(self, diagnostics: Sequence[Diagnostic]) -> None:
        if self._quiet:
            diagnostics = [found for found in diagnostics if found.severity is Severity.ERROR]
        findings, more = (diagnostics, {}) if self._verbose else wording.folded(diagnostics)
        if not findings:
            return
        console = _console(sys.stderr)
        for found in findings:
            console.print(_finding(found), soft_wrap=True)
        for code, number in more.items():
            more_words = f"and {number} more like these [{code}]; --verbose shows them"
            console.print(_text((more_words, "dim")), soft_wrap=True)

    def _stop_bar(self) -> None:
        if self._bar is not None:
            self._bar[0].stop()
            self._bar = None
        self._begin = time.monotonic()


def _console(stream: IO[str]) -> Console:
    from rich.console import Console

    system: Literal["auto"] | None = "auto" if _is_styled(stream) else None
    return Console(file=stream, highlight=False, force_terminal=_is_terminal(stream), color_system=system)


def _is_terminal(stream: IO[str]) -> bool:
    return stream.isatty() or bool(os.environ.get("FORCE_COLOR"))


def _is_styled(stream: IO[str]) -> bool:
    """Whether colours and bold letters are understood and wanted."""
    plain = os.environ.get("NO_COLOR") or os.environ.get("TERM") in ("dumb", "unknown")
    return _is_terminal(stream) and not plain


def _has_marks(stream: IO[str]) -> bool:
    return _is_terminal(stream) and str(getattr(stream, "encoding", "")).lower().startswith("utf")


def _text(*parts: tuple[str, str]) -> Text:
    """One line. Nothing in it can move the cursor or turn the writing round."""
    from rich.text import Text

    return Text.assemble(*((wording.visible(text), style) for text, style in parts))


def _plain(name: str, summary: str) -> None:
    """A headline without rich; it looks as `_headline` does."""
    styled = _is_styled(sys.stdout) and sys.platform != "win32"
    green, bold, off = ("\x1b[32m", "\x1b[1m", "\x1b[0m") if styled else ("", "", "")
    mark = f"{green}✓ {off}" if _has_marks(sys.stdout) else ""
    sys.stdout.write(f"{mark}{bold}{name}{off}: {summary}\n")


def _headline(result: Result, console: Console) -> Text:
    mark, style = ("✗", "bold red") if result.failed else ("!", "yellow") if result.conflicts else ("✓", "green")
    marks = [(f"{mark} ", style)] if _has_marks(console.file) else []
    return _text(*marks, (result.robot, "bold"), (f": {wording.summary(result)}", ""))


def _explanation(result: Result, console: Console, everything: bool) -> Iterator[Text]:
    """Each file, what happens to it and why: below its folder on a terminal, else one path per line."""
    actions = [action for action in result.actions if everything or action.kind is not Kind.UNCHANGED]
    actions.sort(key=lambda action: action.path.rpartition("/"))
    folder = None
    width = max((len(Path(action.path).name) for action in actions), default=0)
    for action in actions:
        place = _place(result, action)
        if not console.is_terminal:
            yield _text(("  ", ""), *_verdict(action, place))
            continue
        if place.parent != folder:
            folder = place.parent
            yield _text((f"  {folder}/", "bold blue"))
        yield _text(("    ", ""), *_verdict(action, Path(place.name), width))


def _place(result: Result, action: Action) -> Path:
    return Path(shown(Path(os.path.normpath(result.root / action.path))))


def _verdict(action: Action, path: Path, width: int = 0) -> tuple[tuple[str, str], ...]:
    word = "waiting" if action.held else action.kind.value.removeprefix("unowned-")
    style = "yellow" if action.held else _KINDS.get(action.kind, "dim")
    return (f"{word:<9}  ", style), (f"{path!s:<{width}}", ""), (f"  {action.reason}", "dim")


def _finding(found: Diagnostic) -> Text:
    numbers = [str(number) for number in (found.line, found.column) if number]
    place = ":".join([found.file, *numbers]) + ": " if found.file else ""
    hint = f"; {found.hint}" if found.hint else ""
    message = " ".join(f"{found.message}{hint}".split())
    style = _SEVERITIES[found.severity]
    return _text((place, "bold"), (found.severity.value, style), (f": {message} ", ""), (f"[{found.code}]", "dim"))


def _draft_lines(draft: Draft) -> Iterator[Text]:
    yield _text((shown(draft.file), "bold"), (" written", ""))
    for guess in draft.guesses:
        yield _text(
            ("  ", ""), (guess.robot, "bold"), (f": {guess.source} becomes package ", ""), (guess.package, "bold")
        )
        for option in guess.options:
            value = json.dumps(option.value)
            yield _text((f"    {option.option} = {value}", ""), (f"  guessed: {option.reason}", "dim"))
    yield _text(("Look it over, then run `urdfsync build`.", ""))

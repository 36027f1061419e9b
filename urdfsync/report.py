"""What people and programs see of a command.

For people: one headline per robot, findings as `file:line: severity: message` on the error stream,
conflicts with what to do about them. For programs: one JSON document on the output stream. Only
this module and `views` know rich, and import it only for terminals, and for what it lays out: trees, tables, conflicts.
"""

from __future__ import annotations

import json
import os
import shlex
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from urdfsync import profiling, streams, wording
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.outcome import Exit, Result
from urdfsync.status import RobotState
from urdfsync.views import builds, statuses, terminal

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

    from urdfsync.checking.verdict import Verdict
    from urdfsync.comparing.comparison import Comparison
    from urdfsync.init import Draft
    from urdfsync.standalone import Record
    from urdfsync.views.checks import Checks
    from urdfsync.watch.report import WatchReport

_PATIENCE = 0.5
"""Seconds of work before a progress bar appears."""


class Report:
    """Says what happened, in the way that a command's options ask for."""

    def __init__(
        self,
        as_json: bool = False,
        quiet: bool = False,
        verbose: bool = False,
        explain: bool = False,
        config: str = "",
    ) -> None:
        """`config` is the configuration as the user named it, for commands that are proposed."""
        self._json, self._quiet, self._verbose, self._explain = as_json, quiet, verbose, explain
        self._config = config
        self._begin = time.monotonic()
        self._bar: tuple[Progress, TaskID] | None = None
        self._results: list[Result] = []
        self._states: list[RobotState] = []
        self._comparisons: list[Comparison] = []
        self._verdicts: list[dict[str, Any]] = []
        self._checks: Checks | None = None
        self._warnings: Sequence[Diagnostic] = ()

    def progress(self, what: str, done: int, total: int) -> None:
        """Show a step of the work, once the work takes long enough for anybody to wonder."""
        if self._wants_bar and time.monotonic() - self._begin >= _PATIENCE:
            bar, task = self._start_bar(what)
            bar.update(task, description=what, completed=done, total=total)

    def waiting(self, what: str) -> None:
        """Show that there is work of which no steps are known, at once: it may be too long to say it later."""
        if self._wants_bar:
            self._start_bar(what)

    @profiling.stage("presentation")
    def warnings(self, diagnostics: Sequence[Diagnostic]) -> None:
        """Findings that concern the whole command and do not stop it."""
        self._warnings = diagnostics
        if not self._json:
            self._findings(diagnostics)

    @profiling.stage("presentation")
    def result(self, result: Result) -> None:
        """Show what was done with one robot."""
        self._stop_bar()
        self._results.append(result)
        if self._json:
            return
        self._findings(result.diagnostics)
        if self._quiet and not result.conflicts:
            return
        if not (self._explain or self._verbose or builds.has_more(result)):
            builds.plain(result.robot, wording.summary(result))
            return
        stream = sys.stderr if result.failed else sys.stdout
        lines = builds.lines(result, stream, quiet=self._quiet, verbose=self._verbose, explain=self._explain)
        terminal.show(lines, stream)
        if result.conflicts:
            from urdfsync.views import conflicts  # most builds have no use for it

            before = sum(len(other.conflicts) for other in self._results[:-1])
            look = conflicts.Look(self._verbose, self._quiet, before, self._config)
            terminal.show(conflicts.lines(result, terminal.console(stream), look), stream)

    @profiling.stage("presentation")
    def status(self, found: RobotState) -> None:
        """Show how one robot stands."""
        self._stop_bar()
        self._states.append(found)
        if self._json:
            return
        self._findings(found.result.diagnostics if self._verbose else found.findings)
        if self._quiet and not found.result.conflicts:
            return
        if not statuses.has_more(found, self._verbose):
            builds.plain(found.result.robot, wording.state(found))
            return
        stream = sys.stderr if found.result.failed else sys.stdout
        terminal.show(statuses.lines(found, stream, self._verbose), stream)

    @profiling.stage("presentation")
    def comparison(self, found: Comparison) -> None:
        """Show what changed in one source."""
        self._stop_bar()
        self._comparisons.append(found)
        if self._json:
            return
        self._findings(found.result.diagnostics)
        if self._quiet and not found.result.conflicts:
            return
        if found.in_step and found.changes is None:
            builds.plain(found.result.robot, wording.comparison(found))
            return
        from urdfsync.views import comparisons  # a build has no use for it

        console = terminal.console(sys.stderr if found.result.failed else sys.stdout)
        for part in comparisons.parts(found, console, self._verbose):
            console.print(part)

    def verdict(self, found: Verdict, strict: bool, robots: Sequence[str] = ()) -> None:
        """Show what was checked of one robot; `robots` are all that the command is about, by their names."""
        self._stop_bar()
        if self._json:
            from urdfsync import documents

            self._verdicts.append(documents.verdict(found, strict))
            return
        if self._checks is None:
            from urdfsync.views import checks  # no other command has a use for it

            look = checks.Look(strict=strict, verbose=self._verbose, quiet=self._quiet)
            self._checks = checks.Checks(terminal.console(sys.stdout), robots, look)
        console = terminal.console(sys.stdout)
        for line in self._checks.lines(found):
            console.print(line, soft_wrap=True)
        self._findings(found.diagnostics)

    def cleared(self, freed: int) -> None:
        """Show how many bytes there were in the cache of checks that was emptied."""
        self._stop_bar()
        if self._json:
            self._document("check", Exit.IN_STEP, {"freed": freed})
        elif not self._quiet:
            sys.stdout.write(f"cache emptied, {wording.size(freed)} freed\n" if freed else "the cache was empty\n")

    @profiling.stage("presentation")
    def finish(self, command: str, code: Exit) -> None:
        """The end of a command on robots: the JSON document, if one is asked for."""
        self._stop_bar()
        self._close_checks()
        if self._json:
            self._document(command, code, {"robots": self._robots()} | self._profile(), self._warnings)
        elif profile := profiling.current():
            from urdfsync.views import profiles  # hardly anybody asks

            console = terminal.console(sys.stderr)
            for part in profiles.parts(profile):
                console.print(part)

    def problems(self, command: str, diagnostics: Sequence[Diagnostic], code: Exit = Exit.ERROR) -> None:
        """Findings that stopped the whole command."""
        self._stop_bar()
        self._close_checks()
        if self._json:
            self._document(command, code, {"robots": self._robots()}, [*self._warnings, *diagnostics])
        else:
            self._findings(diagnostics)

    def bad_usage(self, command: str, usage: str, found: Diagnostic) -> None:
        """Say what is wrong with the arguments of a command, and how it is called."""
        if not self._json:
            sys.stderr.write(usage)
        self.problems(command, [found])

    def watching(self) -> WatchReport:
        """What shows the events of the daemon."""
        from urdfsync.watch.report import watch_report

        return watch_report(as_json=self._json, quiet=self._quiet, verbose=self._verbose, config=self._config)

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
            from urdfsync.views import drafts  # no other command has a use for it

            console = terminal.console(sys.stdout)
            for line in drafts.lines(draft):
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

    def record(self, found: Record, file: Path | None, written: bool | None) -> None:
        """Show the record of a source, or what became of the file that it belongs into."""
        if self._json:
            place = {"text": found.text} if file is None else {"file": str(file), "written": written}
            target = {"class": found.target.name, "within": found.target.package}
            self._document("record", Exit.IN_STEP, target | place, self._warnings)
        elif file is None:
            if hasattr(sys.stdout, "reconfigure") and not sys.stdout.isatty():
                sys.stdout.reconfigure(encoding="utf-8", newline="\n")  # a file is what Modelica tools read
            sys.stdout.write(found.text)
        elif not self._quiet:
            said = "written" if written else "unchanged"
            sys.stdout.write(f"{wording.visible(str(file))} {said}: record {found.target.name}\n")

    @staticmethod
    def _profile() -> dict[str, Any]:
        """Where the time went until now, if somebody wants to know."""
        from urdfsync import documents

        profile = profiling.current()
        return {"profile": documents.profile(profile)} if profile else {}

    def _robots(self) -> list[dict[str, Any]]:
        from urdfsync import documents

        return [
            *map(documents.robot, self._results),
            *map(documents.state, self._states),
            *map(documents.comparison, self._comparisons),
            *self._verdicts,
        ]

    def _document(
        self, command: str, code: Exit, values: dict[str, Any], diagnostics: Sequence[Diagnostic] = ()
    ) -> None:
        from urdfsync import documents  # people have no use for it

        findings = [documents.finding(diagnostic) for diagnostic in diagnostics]
        document = {
            "version": documents.VERSION,
            "command": command,
            "exit": int(code),
            **values,
            "diagnostics": findings,
        }
        indent = None if command == "watch" else 2  # its output is one object per line
        sys.stdout.write(json.dumps(document, indent=indent) + "\n")

    def _findings(self, diagnostics: Sequence[Diagnostic]) -> None:
        if self._quiet:
            diagnostics = [found for found in diagnostics if found.severity is Severity.ERROR]
        findings, more = (diagnostics, {}) if self._verbose else wording.folded(diagnostics)
        if not findings:
            return
        hidden = (f"and {number} more like these [{code}]; --verbose shows them" for code, number in more.items())
        folded = (terminal.words((said, "dim")) for said in hidden)
        terminal.show([*map(terminal.finding, findings), *folded], sys.stderr)

    def _close_checks(self) -> None:
        """What there is to say of all verdicts, as far as the command came."""
        if self._checks is not None:
            console = terminal.console(sys.stdout)
            for line in self._checks.end():
                console.print(line, soft_wrap=True)
            self._checks = None

    @property
    def _wants_bar(self) -> bool:
        return not self._json and not self._quiet and sys.stderr.isatty()

    def _start_bar(self, what: str) -> tuple[Progress, TaskID]:
        """The bar, which moves to and fro until there is a number of steps."""
        if self._bar is None:
            from rich.progress import Progress

            stream: Any = sys.stderr
            if isinstance(stream, streams.Stream):
                stream = stream.without_transcript()
            console = terminal.console(stream)
            bar = Progress(console=console, transient=True, redirect_stdout=False, redirect_stderr=False)
            self._bar = bar, bar.add_task(what, total=None)
            bar.start()
        return self._bar

    def _stop_bar(self) -> None:
        if self._bar is not None:
            self._bar[0].stop()
            self._bar = None
        self._begin = time.monotonic()


def unwritten(output: streams.Stream) -> int:
    """Say that not all of the output could be written; returns the exit code."""
    found = Diagnostic(Severity.ERROR, "output", f"the output can't be written: {output.trouble}")
    Report().problems("", [found])
    return Exit.ERROR

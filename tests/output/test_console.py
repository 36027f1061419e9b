"""The console: colours where they are wanted, text of others that commands no terminal, findings that are folded."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from support.screen import Terminal

from urdfsync.commands import cli
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console

Capture = pytest.CaptureFixture[str]


@pytest.mark.parametrize("variable", ["", "NO_COLOR", "TERM"])
def test_a_terminal_gets_colours_unless_it_wants_none(
    project: Path, monkeypatch: pytest.MonkeyPatch, variable: str
) -> None:
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setattr("urdfsync.output.console.BAR_AFTER", float("inf"))  # no bar, however slow the machine is
    if variable:
        monkeypatch.setenv(variable, "dumb")
    (project / "step.csv").unlink()
    for arguments in (["build", "--verbose"], ["build"], ["build", "--full"], ["build", "nobody"]):
        screen, errors = Terminal(), Terminal()
        monkeypatch.setattr(sys, "stdout", screen)
        monkeypatch.setattr(sys, "stderr", errors)
        cli.main(arguments)
        assert ("\x1b" in screen.getvalue() + errors.getvalue()) is not bool(variable)
        assert "✓" in screen.getvalue() or arguments[-1] == "nobody"


EVIL = "a\x1b[31m\x07\u202eb\x9b2J\ud800"


def test_text_of_others_can_not_command_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "dumb")
    errors = Terminal()
    monkeypatch.setattr(sys, "stderr", errors)
    found = Diagnostic(Severity.ERROR, "x", f"it says `{EVIL}`", f"{EVIL}.urdf", 3, hint=f"not {EVIL}")
    Console().end(Exit.ERROR, [found])
    safe = "a\\x1b[31m\\x07\\u202eb\\x9b2J\\ud800"
    assert errors.getvalue() == f"{safe}.urdf:3: error: it says `{safe}`; not {safe} [x]\n"


def test_many_findings_of_one_kind_are_folded(capsys: Capture) -> None:
    many = [Diagnostic(Severity.WARNING, "mesh-not-found", f"mesh {n} not found", "a.urdf", n) for n in range(1, 10)]
    Console().end(Exit.ERROR, many)
    lines = capsys.readouterr().err.splitlines()
    assert lines[:4] == [f"a.urdf:{n}: warning: mesh {n} not found [mesh-not-found]" for n in range(1, 5)]
    assert lines[4:] == ["and 5 more like these [mesh-not-found]; --verbose shows them"]
    Console(verbose=True).end(Exit.ERROR, many)
    assert len(capsys.readouterr().err.splitlines()) == 9

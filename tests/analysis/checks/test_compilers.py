"""The compilers that `--tool` and the configuration can name."""

from __future__ import annotations

from pathlib import Path

import pytest
from support import checks

from urdfsync.analysis.checks.compilers import BOTH, COMPILERS, choose, find_missing
from urdfsync.analysis.checks.compilers.compiler import Tool
from urdfsync.project.config import Config


def test_both_are_two_of_however_many_there_are(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(COMPILERS, "fake", checks.Compiler())
    tools = choose(Config(Path("urdfsync.toml"), ()), BOTH, trusted=True)
    assert [tool.name for tool in tools] == ["rumoca", "omc"]


def test_a_missing_program_is_told_by_the_name_of_its_compiler(monkeypatch: pytest.MonkeyPatch) -> None:
    compiler = checks.Compiler()
    compiler.is_missing = True
    monkeypatch.setitem(COMPILERS, "fake", compiler)
    no_program = "`x` is no program; `fake` in the table `[check]` names it"
    for program, reason in (("", "`fake` is not on the PATH"), ("x", no_program)):
        missing = find_missing(Tool("fake", program))
        assert missing is not None
        assert reason in missing.message

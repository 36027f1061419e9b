"""The compilers that `--tool` and the configuration can name."""

from __future__ import annotations

import inspect
from pathlib import Path

import pytest
from support import checks

from urdfsync.checks.compilers import BOTH, COMPILERS, choose, find_missing
from urdfsync.checks.compilers.compiler import Compiler, Tool
from urdfsync.config import Config


@pytest.mark.parametrize("name", COMPILERS)
def test_each_is_as_the_protocol_says(name: str) -> None:
    module = COMPILERS[name]
    for constant, kind in inspect.get_annotations(Compiler, eval_str=True).items():
        assert type(getattr(module, constant)) in (kind, getattr(kind, "__origin__", None)), constant
    for function in [member for member in vars(Compiler).values() if inspect.isfunction(member)]:
        if not function.__name__.startswith("_"):
            _self, *parameters = inspect.signature(function).parameters
            assert list(inspect.signature(getattr(module, function.__name__)).parameters) == parameters, function


def test_both_are_two_of_however_many_there_are(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(COMPILERS, "fake", checks.Compiler())
    tools = choose(Config(Path("urdfsync.toml"), ()), BOTH, trusted=True)
    assert [tool.name for tool in tools] == ["rumoca", "omc"]


def test_a_missing_program_is_told_by_the_name_of_its_compiler(monkeypatch: pytest.MonkeyPatch) -> None:
    compiler = checks.Compiler()
    compiler.is_missing = True
    monkeypatch.setitem(COMPILERS, "fake", compiler)
    for program, reason in (("", "`fake` is not on the PATH"), ("x", "`x`, which `fake` in the table `[check]` names")):
        missing = find_missing(Tool("fake", program))
        assert missing is not None
        assert reason in missing.message

"""The compilers that `--tool` and the configuration can name."""

from __future__ import annotations

from pathlib import Path
from typing import get_args, get_type_hints

import pytest
from support import checks

from urdfsync.checks.compilers import COMPILERS
from urdfsync.checks.tools import BOTH, chosen_tools
from urdfsync.config import Config
from urdfsync.config.settings import CheckConfig


def test_the_configuration_can_name_every_compiler() -> None:
    assert get_args(get_type_hints(CheckConfig)["tool"]) == (*COMPILERS, BOTH)


def test_both_are_two_of_however_many_there_are(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(COMPILERS, "fake", checks.Compiler())
    tools = chosen_tools(Config(Path("urdfsync.toml"), ()), BOTH, trusted=True)
    assert [tool.name for tool in tools] == ["rumoca", "omc"]

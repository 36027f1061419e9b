"""Fixtures: a model whose edits contradict what the source says now, and the user's editor."""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

import pytest
from support.commands import Editor, Execute
from support.fmu import openmodelica, reference
from support.networks import MINE, MODEL, edit
from support.simulation import arm, built_arm, compiler

__all__ = ["arm", "built_arm", "compiler", "contradictory", "editor", "openmodelica", "reference"]


@pytest.fixture
def contradictory(execute: Execute, project: Path) -> Path:
    """A resistor is edited in the network's model, and replaced in the source."""
    execute("build")
    edit(MODEL, '"Element R2"', MINE)
    edit("ladder.json", '{"name": "R2", "between": ["middle", "out"]', '{"name": "R3", "between": ["in", "out"]')
    return project


@pytest.fixture
def editor(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Editor:
    """Sets the user's editor: a program in Python, which gets the names of the files as `names`."""
    program = tmp_path / "editor.py"
    monkeypatch.setenv("VISUAL", f"{sys.executable} {program}")
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    begin = "import sys\nfrom pathlib import Path\nnames = sys.argv[1:]\nfile = Path(names[0])\n"
    return lambda text: program.write_text(begin + text)

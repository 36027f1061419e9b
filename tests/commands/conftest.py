"""Fixtures: a model whose edits contradict what the source says now."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute
from support.fmu import openmodelica, reference
from support.networks import MINE, MODEL, add_resistor, edit
from support.simulation import arm, built_arm, compiler

__all__ = ["arm", "built_arm", "clean", "compiler", "contradictory", "openmodelica", "reference"]


@pytest.fixture
def contradictory(execute: Execute, project: Path) -> Path:
    """A resistor is edited in the network's model, and replaced in the source."""
    execute("build")
    edit(MODEL, '"Element R2"', MINE)
    edit("ladder.json", '{"name": "R2", "between": ["middle", "out"]', '{"name": "R3", "between": ["in", "out"]')
    return project


@pytest.fixture
def clean(execute: Execute, project: Path) -> Path:
    """The network's model is edited, one more resistor is in the source: both fit together."""
    execute("build")
    edit(MODEL, "Elements.C1 elementC1", "parameter Real mine = 1;\n\n  Elements.C1 elementC1")
    add_resistor("R3")
    return project

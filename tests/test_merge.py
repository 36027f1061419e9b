"""Merging: what survives side by side, what is a conflict, and that whole lines merge as they do in git."""

from __future__ import annotations

import random
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from urdfsync.merge import merge, merge_lines, split_lines
from urdfsync.tokens import is_word, tokens

EXAMPLES = Path(__file__).parents[1] / "modelica" / "UrdfSync" / "Examples"

RECORD = """\
record ForearmParameters "Numbers of link \\"forearm\\""
  extends UrdfSync.Records.Link(
    name = "forearm",
    inertial(
      origin(
        xyz = {0.1118, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1.2,
      inertia(
        ixx = 0.005953,
        iyy = 0.029335,
        izz = 0.030752)));
end ForearmParameters;
"""


def changed(text: str, *replacements: tuple[str, str]) -> str:
    """The text with each first string, which must be there once, replaced by the second."""
    for old, new in replacements:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


@pytest.mark.parametrize(
    ("mine", "generated"),
    [
        pytest.param(("mass = 1.2,", "mass = 1.2, // weighed"), ("mass = 1.2", "mass = 1.25"), id="comment, value"),
        pytest.param(("0.030752", "0.030752 /* see CAD */"), ("0.030752", "0.031"), id="comment right after a value"),
        pytest.param(
            ("      mass", "      // with battery\n      mass"), ("1.2", "1.25"), id="comment line above a new value"
        ),
        pytest.param(("mass = 1.2", "mass = 1.25"), ("ixx = 0.005953", "ixx = 0.006"), id="value, value two lines on"),
        pytest.param(("mass = 1.2", "mass = 1.25"), ("inertia(", "tensor("), id="value, name on the next line"),
        pytest.param(("ixx = 0.005953", "ixx = 0.006"), ("iyy = 0.029335", "iyy = 0.03"), id="values one line apart"),
        pytest.param(("        ixx", "        final ixx"), ("0.005953", "0.006"), id="prefix, value"),
        pytest.param(("ixx = 0.005953", "ixx  =  0.005953"), ("0.005953", "0.006"), id="spacing, value"),
        pytest.param(
            ("izz = 0.030752", "izz = 0.030752,\n        ixy = 1e-6"), ("0.030752", "0.031"), id="modifier added, value"
        ),
        pytest.param(
            ("mass = 1.2,", "mass = 1.2,\n      payload = 3,"), ("1.2", "1.25"), id="line with a modifier added, value"
        ),
        pytest.param(("        iyy = 0.029335,\n", ""), ("0.005953", "0.006"), id="modifier removed, value before it"),
        pytest.param(("record Forearm", "record  Forearm"), ("end Fore", "end  Fore"), id="first line, last line"),
    ],
)
def test_both_survive(mine: tuple[str, str], generated: tuple[str, str]) -> None:
    expected = changed(RECORD, mine)
    lines = merge(RECORD, changed(RECORD, mine), changed(RECORD, generated))
    if generated[0] in expected:
        expected = changed(expected, generated)
    assert lines.text == expected
    assert lines.conflicts == ()
    assert lines.proposal == lines.text

"""No regular expression of the program takes long on a small text."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from support import patterns

LOCAL = {"checks/compilers/omc.py", "checks/compilers/rumoca.py", "engine/file_kinds.py", "engine/imports.py"} | {
    "modelica/files.py",
    "urdf/meshes/reading.py",
}
"""Modules with a pattern in a local name: of the user's command line, for 64 kB at most, or tried by hand."""


def test_nearly_every_pattern_is_reached() -> None:
    found, unreached = patterns.find()
    assert len(found) > 180
    assert {Path(place.rpartition(":")[0]).relative_to(patterns.PACKAGE).as_posix() for place in unreached} <= LOCAL


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no limit of CPU time")
def test_no_pattern_takes_a_second_for_200_kb() -> None:
    """A signal ends the process after a second of its own CPU time, a twentieth of what a quadratic pattern takes."""
    program = [sys.executable, "-m", "support.patterns", "0"]
    done = subprocess.run(program, cwd=Path(__file__).parent, capture_output=True, text=True, check=False)
    assert done.stdout.rsplit("\n", 2)[-2:] == ["done", ""], done.stdout.rsplit("\n", 2)[-2] + done.stderr

"""No regular expression of the program takes long on a small text."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from support.patterns import find_patterns

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform == "win32", reason="Windows has no limit of CPU time"),
]


def _last_line(*patterns: str) -> str:
    """Try patterns in a process; return its last line, which is `done` if none takes a second."""
    program = [sys.executable, "-m", "support.patterns", *patterns]
    done = subprocess.run(program, cwd=Path(__file__).parent, capture_output=True, text=True, check=False)
    return done.stdout.rstrip("\n").rpartition("\n")[2] + done.stderr


def test_every_pattern_is_found_with_the_methods_that_it_is_used_with() -> None:
    patterns = find_patterns()
    assert len(patterns) > 200
    assert {"match", "search"} <= {method for pattern in patterns for method in pattern.methods}


def test_no_pattern_takes_a_second_for_200_kb() -> None:
    assert _last_line() == "done"


@pytest.mark.parametrize("pattern", [" *$", r'"(?:[^"\\]|\\.)*"', "(?:a+)+b", r"<!--.*?-->", r"\w+\s*=", r"(\w)-.*\1;"])
def test_a_pattern_that_takes_long_is_found(pattern: str) -> None:
    """A quadratic pattern takes some twenty seconds for 200 kB."""
    assert _last_line(pattern).startswith("argument search (")

"""`urdfsync status` where a text is no scenario: many files, a lock; see `tests/scenarios/status.txt`."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from support.commands import Execute

from urdfsync.project.state.lock import build_lock


@pytest.fixture
def built(project: Path, execute: Execute) -> Path:
    """A built project."""
    execute("build")
    return project


def test_many_stale_files_are_named_only_if_asked_for(built: Path, execute: Execute) -> None:
    elements = [{"name": f"R{n}", "between": ["in", "ground"], "ohm": 1.0} for n in range(10, 30)]
    (built / "ladder.json").write_text(json.dumps({"name": "many", "elements": elements}))
    found = execute("status", code=1).lines
    assert sum(line.startswith("  stale ") for line in found) == 19
    stale = sum(line.startswith("  stale ") for line in execute("status", "--verbose", code=1).lines)
    assert found[-1] == f"  … and {stale - 19} more stale files; --verbose shows them"


def test_a_build_that_is_writing_is_waited_for(built: Path, execute: Execute) -> None:
    with build_lock(built / ".urdfsync", 0) as lock:
        lock.acquire()
        assert execute("status").lines == ["ladder: in step, 14 files"], "it only reads, and nothing is half written"

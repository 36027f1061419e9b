"""Reads and changes the recorded state of a robot, as somebody may who edits the file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec

from urdfsync.project.state import statefile
from urdfsync.project.state.record import Record


def records(state: Path) -> tuple[Record, ...]:
    """Return the readable records in a state."""
    return statefile.loads(state.read_text(), state.name)[0]


def record(state: Path) -> Record:
    """Return the only record in a state."""
    (found,) = records(state)
    return found


def rewrite(state: Path, **changes: Any) -> None:
    """Change the only record in a state."""
    state.write_text(statefile.dumps(msgspec.structs.replace(record(state), **changes)))

"""What there is to do for one robot: the value that planning ends with, and that building begins with."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from urdfsync.diagnostics import Diagnostic
from urdfsync.planning.decide import Decision
from urdfsync.state.store import Witness
from urdfsync.state.transactions import Change

if TYPE_CHECKING:
    from urdfsync.diff.changes import Changes


class Work(msgspec.Struct, frozen=True):
    """What there is to do for one robot."""

    decision: Decision
    witness: Witness
    """The recorded state that all of it rests on."""
    writes: tuple[Change, ...] = ()
    """The files to write, the manifest last; none in a dry run."""
    emptied: tuple[Path, ...] = ()
    """The folders that are empty then, innermost first."""
    diagnostics: tuple[Diagnostic, ...] = ()
    drawing: Path | None = None
    """Where the main model's diagram is then."""
    changes: Changes | None = None
    """What is new in the model."""

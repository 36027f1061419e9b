"""What there is to do for one robot: the value that planning ends with, and that building begins with."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from urdfsync.diagnostics import Diagnostic
from urdfsync.planning.decide import Decision
from urdfsync.state.store import Witness
from urdfsync.state.transaction import Change

if TYPE_CHECKING:
    from urdfsync.changes import Changes


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
    bases: Mapping[str, str] = {}
    """Texts that are written now, by their hashes: kept to merge with."""
    mentioned: frozenset[str] | None = None
    """All hashes that the manifest mentions then; None if others may be needed as well."""
    former: str | None = None
    """The name that the robot had in the last build, if it has another one now."""
    drawing: Path | None = None
    """Where the main model's diagram is then."""
    changes: Changes | None = None
    """What is new in the model."""

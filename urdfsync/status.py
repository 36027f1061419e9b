"""How the files of a robot stand, from the plan of a build that writes nothing."""

from __future__ import annotations

import enum
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.actions import Action, Kind
from urdfsync.outcome import Result

if TYPE_CHECKING:
    from urdfsync.engine.conflicts import Conflict


class FileStatus(enum.StrEnum):
    """How a file stands, what asks for most attention first."""

    CONFLICT = "conflict"
    """The user and urdfsync want different things of it."""
    MISSING = "missing"
    """It was written and somebody deleted it."""
    STALE = "stale"
    """The next build writes or deletes it."""
    EDITED = "edited"
    """The user changed it, and there is nothing new for it."""
    ORPHAN = "orphan"
    """Nothing generates it any longer, and it stays because it is the user's or something of the user's needs it."""
    IN_STEP = "in step"


_STATUSES: Mapping[Kind, tuple[FileStatus, str]] = {
    Kind.UNCHANGED: (FileStatus.IN_STEP, ""),
    Kind.ADOPT: (FileStatus.IN_STEP, "as wanted; not recorded yet"),
    Kind.CREATE: (FileStatus.STALE, "to be created"),
    Kind.UPDATE: (FileStatus.STALE, "to be updated"),
    Kind.DELETE: (FileStatus.STALE, "to be deleted"),
    Kind.MERGE: (FileStatus.STALE, "to be updated, your edits stay"),
    Kind.MOVE: (FileStatus.STALE, "renamed, your edits move here"),
    Kind.LEAVE: (FileStatus.STALE, "renamed, your edits move away"),
    Kind.RESTORE: (FileStatus.MISSING, "deleted, to be written again"),
    Kind.KEEP: (FileStatus.EDITED, ""),
    Kind.INCLUDED: (FileStatus.EDITED, "already has what is new"),
    Kind.CONFLICT: (FileStatus.CONFLICT, "edited and stale"),
    Kind.UNOWNED: (FileStatus.CONFLICT, "not written by urdfsync"),
    Kind.ORPHAN: (FileStatus.ORPHAN, "edited, no longer generated"),
    Kind.NEEDED: (FileStatus.ORPHAN, "needed by yours, no longer generated"),
}
"""Status and reason by what a build would do; FORGET is left out, since its file is gone for good."""

_MERGES = "; can be merged"
_HELD = ", waits"
"""Until the robot's conflicts are settled."""


class FileState(msgspec.Struct, frozen=True):
    """How one file stands, and why; the reason is empty if there is nothing to say."""

    path: str
    """Where it is or will be, as in the manifest: relative to the configuration's folder, with `/`."""
    status: FileStatus
    reason: str
    action: Action
    """What a build would do."""


class RobotState(msgspec.Struct, frozen=True):
    """How one robot stands."""

    result: Result
    """Of a build that wrote nothing."""
    files: tuple[FileState, ...] = ()
    source: str = ""
    """The source, as diagnostics name it."""

    @property
    def built(self) -> bool:
        """Whether a build has written anything of it."""
        return any(file.action.base is not None for file in self.files)

    @property
    def in_step(self) -> bool:
        """Whether a build would write nothing, and no file is in conflict; edits and orphans are in order."""
        off = {FileStatus.CONFLICT, FileStatus.MISSING, FileStatus.STALE}
        return not self.result.failed and all(file.status not in off for file in self.files)

    @property
    def findings(self) -> Sequence[Diagnostic]:
        """What there is to say, without warnings about the source: they are for whoever builds it."""
        found = self.result.diagnostics
        return [one for one in found if one.file != self.source or one.severity is Severity.ERROR]

    @property
    def counts(self) -> Mapping[FileStatus, int]:
        """The number of files of each status that there is, in the order of `FileStatus`."""
        found = Counter(file.status for file in self.files)
        return {status: found[status] for status in FileStatus if found[status]}


def of(result: Result, source: str = "") -> RobotState:
    """How a robot stands, from the result of a dry build; `source` is how its diagnostics name the source."""
    standoffs = {standoff.path: standoff for standoff in result.standoffs}
    files = [_file(action, standoffs.get(action.path)) for action in result.actions if action.kind in _STATUSES]
    return RobotState(result, tuple(sorted(files, key=lambda file: file.path)), source)


def _file(action: Action, standoff: Conflict | None) -> FileState:
    status, reason = _STATUSES[action.kind]
    if status is FileStatus.CONFLICT and standoff and standoff.merge and standoff.merge.text is not None:
        reason += _MERGES
    if action.held:
        reason += _HELD
    here = status is FileStatus.CONFLICT and action.origin is not None
    return FileState((action.origin or action.path) if here else action.path, status, reason, action)

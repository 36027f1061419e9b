"""Results of commands, for `output` to show and for the exit code."""

from __future__ import annotations

import enum
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from urdfsync.diagnostics import Diagnostic, SourceError
from urdfsync.engine.actions import Action, Actions, Kind, Reason

if TYPE_CHECKING:
    from urdfsync.changes import Changes
    from urdfsync.engine.conflicts import Conflict


class Exit(enum.IntEnum):
    """Exit codes of every command."""

    IN_STEP = 0
    OUT_OF_STEP = 1
    ERROR = 2
    CONFLICT = 3
    LOCKED = 4
    INTERRUPTED = 130


class Checked(enum.StrEnum):
    """Verdict of the check after a build on the package on disk."""

    RIGHT = "right"
    INCOMPLETE = "incomplete"
    """Nothing is wrong with it as far as it could be checked, but not everything could."""
    WRONG = "wrong"


class Result(msgspec.Struct, frozen=True):
    """Result of a build, or of a dry run, for one robot."""

    robot: str
    package: str
    folder: Path
    """The package's folder, absolute; the paths of `actions` count from `root`."""
    root: Path
    actions: Actions = Actions()
    diagnostics: tuple[Diagnostic, ...] = ()
    failed: bool = False
    locked: bool = False
    """It failed because another process is building."""
    unfinished: bool = False
    """It failed half way, and what was begun could not be put back: the next build does that."""
    source_error: SourceError | None = None
    """It failed since the source can't be read as a model; an exporter may be at work on it."""
    dry: bool = False
    """Nothing was written, whatever the actions say."""
    writes: bool = False
    """The build has written files or the recorded state, or would in a dry run."""
    stale: tuple[str, ...] = ()
    """Files that have changed since the source was expanded, if the old text was used."""
    is_broken: bool = False
    """A file of the package that the user edited does not fit it, or is no Modelica."""
    drawing: Path | None = None
    changes: Changes | None = None
    """Changes of the model since the last build that wrote; None if there are none, or they are not known."""
    conflict_texts: tuple[Conflict, ...] = ()
    """The texts of the files that conflict, in the order of their paths."""
    checked: Checked | None = None
    """Verdict of a check of the package; None if there was none. Its findings are among the diagnostics."""

    @property
    def conflicts(self) -> list[Action]:
        """The files that were left alone although they should be otherwise."""
        return [action for action in self.actions.decided if action.kind is Kind.CONFLICT]

    @property
    def in_step(self) -> bool:
        """Whether the package is in step now: a build would write nothing, and nothing is in conflict or broken.

        All commands, hooks and documents read this one value.
        """
        return self.are_files_in_step and not self.is_broken

    @property
    def are_files_in_step(self) -> bool:
        """The same, whether the user's edits fit or not."""
        return not (self.failed or self.stale or self.conflicts or (self.dry and self.writes))

    @property
    def effective_changes(self) -> Changes | None:
        """The changes of the model that a build writes, or that wait for a conflict; `diff` shows the others, too."""
        return self.changes if self.writes or self.conflicts else None

    @property
    def is_built(self) -> bool:
        """Whether a build has written any file of the package, its record lost or not."""
        return any(action.base is not None or action.reason is Reason.ADOPT for action in self.actions)

    @property
    def is_first(self) -> bool:
        """Whether no build has written any file of the package before."""
        return not self.is_built and any(action.reason is Reason.CREATE for action in self.actions)


def exit_code(results: Iterable[Result], check: bool = False) -> Exit:
    """The worst of all: an error, a lock, a conflict or what a build leaves broken, being out of step.

    The last counts only if `check`, or if a package is broken.
    """
    results = list(results)
    if any((result.failed and not result.locked) or result.checked is Checked.WRONG for result in results):
        return Exit.ERROR
    if any(result.locked for result in results):
        return Exit.LOCKED
    if any(result.conflicts or (result.is_broken and not result.dry) for result in results):
        return Exit.CONFLICT
    if any(result.is_broken for result in results):
        return Exit.OUT_OF_STEP
    return Exit.IN_STEP if not check or all(result.in_step for result in results) else Exit.OUT_OF_STEP

"""Results of builds: plain data, the words about it, and the exit code."""

from __future__ import annotations

import enum
import os
from collections import Counter
from collections.abc import Container, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Self

import msgspec

from urdfsync.common.dependencies.facts import Dependencies
from urdfsync.common.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.common.files import shown
from urdfsync.common.spelling import counted
from urdfsync.domain.comparison import Changes
from urdfsync.engine.actions import Action, Actions, Choice, Reason
from urdfsync.engine.decide.conflicts import Conflict
from urdfsync.project.config import Config, RobotConfig

_NAMED = 3
"""The greatest number of contradictions that a sentence about a file names."""


class Exit(enum.IntEnum):
    """Exit codes of every command."""

    IN_STEP = 0
    OUT_OF_STEP = 1
    ERROR = 2
    CONFLICT = 3
    """A file is in conflict, or the package is broken."""
    LOCKED = 4
    DOUBTFUL = 5
    """A log is hardly that of the robot."""
    INTERRUPTED = 130


class Checked(enum.StrEnum):
    """Result of the check of the package on disk after a build."""

    RIGHT = "right"
    INCOMPLETE = "incomplete"
    """The check found no fault, but could not check everything."""
    WRONG = "wrong"


class SavedVersions(msgspec.Struct, frozen=True):
    """The saved versions of a file in conflict."""

    files: Mapping[str, str] = {}
    """Paths by kind (`base`, `generated`, `merge`), below the robot's folder in `.urdfsync/conflicts`."""
    edited: str | None = None
    """The proposed merge as the user edited it."""


class DisputedFile(msgspec.Struct, frozen=True):
    """A file in conflict."""

    KEYS = ("action", "merges", "relation", "saved")

    result: Result
    action: Action
    texts: Conflict | None = None
    """The texts; None if a version is not a text."""
    versions: SavedVersions = SavedVersions()

    @property
    def shown(self) -> str:
        """The path of the user's file, as the user would type it."""
        return self.result.shown(self.action.present)

    @property
    def merges(self) -> bool:
        """Whether `--merge` settles the conflict."""
        return self.offers(Choice.MERGE)

    @property
    def relation(self) -> str:
        """How the changes of both sides fit together, as a clause."""
        texts = self.texts
        if texts is None:
            return "it is not a text, so it can't be merged"
        if texts.merge is None:
            is_unowned = self.action.reason is Reason.UNOWNED
            lost = "its merge base, the text that urdfsync wrote last, is not recorded"
            return texts.rejected or f"{'there is no base' if is_unowned else lost}, so it can't be merged"
        if self.merges and texts.renamed and texts.base == texts.generated:
            return f"{texts.renamed}: --merge takes the new names over"
        if self.merges:
            told = f"{texts.renamed}; " if texts.renamed else ""
            return f"{told}the changes fit together: --merge takes both"
        if texts.rejected:
            return f"--merge would not be right: {texts.rejected}"
        contradictions = texts.merge.contradictions
        if not all(contradictions):
            places = f" in {len(contradictions)} places" if len(contradictions) > 1 else ""
            return f"the changes contradict each other{places}"
        more = f"; and {len(contradictions) - _NAMED} more" if len(contradictions) > _NAMED else ""
        return f"{'; '.join(contradictions[:_NAMED])}{more}"

    @property
    def saved(self) -> Mapping[str, str]:
        """Where a build saves the versions, from the configuration's folder: `base`, `generated`, `merge`."""
        return {kind: f".urdfsync/conflicts/{self.result.robot}/{path}" for kind, path in self.versions.files.items()}

    def offers(self, choice: Choice) -> bool:
        """Return whether this kind of merge settles the conflict."""
        return self.texts is not None and self.texts.merged(choice) is not None


class Outlook(msgspec.Struct, frozen=True):
    """What a build makes of a robot's package, or would make of it, with its findings."""

    actions: Actions = Actions()
    diagnostics: tuple[Diagnostic, ...] = ()
    writes: bool = False
    """Whether the build has written files of the package; in a dry run, whether a build would."""
    renews: bool = False
    """Whether the build has renewed the recorded state; in a dry run, whether a build would."""
    stale: tuple[str, ...] = ()
    """Changed inputs of the source, if the build used the source's old text."""
    is_broken: bool = False
    """Whether an edited file does not fit the package, or has syntax errors."""
    is_unmerged: bool = False
    """Whether git's index has several versions of one of the robot's files."""
    drawing: Path | None = None
    """The diagram that `--svg` wrote."""
    changes: Changes | None = None
    """Changes of the model since the last complete build; None if there are none, or if they are unknown."""
    conflict_texts: tuple[Conflict, ...] = ()
    saved: Mapping[str, SavedVersions] = {}
    """The saved versions of the files in `conflict_texts`, by path."""
    settled: frozenset[str] = frozenset()
    """The keys of the files for which a choice was carried out."""


class Result(Outlook, frozen=True, kw_only=True):
    """Result of a build, or of a dry run, for one robot."""

    KEYS = tuple(
        "robot package folder failed locked is_built in_step is_broken writes renews summary "
        "drawing checked stale changes actions conflicts diagnostics".split()
    )

    robot: str
    package: str
    folder: Path
    """The package's folder, absolute; the paths of `actions` count from `root`."""
    root: Path
    failed: bool = False
    locked: bool = False
    """Whether the build failed because another process is building."""
    unfinished: bool = False
    """Whether the build failed after it had changed files; the next build writes the rest."""
    source_error: SourceError | None = None
    """The error if the source is not a readable model; an exporter may be writing the file."""
    dry: bool = False
    """Whether this was a dry run: nothing was written."""
    checked: Checked | None = None
    """Result of the check after the build; None without a check. `diagnostics` includes the check's findings."""
    reads: Dependencies = {}
    """All that the build has read; written files have their new facts."""

    @classmethod
    def of(cls, config: Config, robot: RobotConfig, outlook: Outlook, **others: Any) -> Self:
        """Return the result of a robot; `others` are fields that the outlook lacks, or that replace its own."""
        fields = msgspec.structs.asdict(outlook) | others
        return cls(robot=robot.name, package=robot.target.package, folder=robot.folder, root=config.root, **fields)

    @property
    def conflicts(self) -> Sequence[DisputedFile]:
        """The files in conflict, in the order of their paths."""
        texts = {each.path: each for each in self.conflict_texts}
        actions = (action for action in self.actions.decided if action.is_conflict)
        nothing = SavedVersions()
        return [
            DisputedFile(self, action, texts.get(action.path), self.saved.get(action.path, nothing))
            for action in actions
        ]

    @property
    def in_step(self) -> bool:
        """Whether the package is in step now: a build would write nothing, and nothing is in conflict or broken.

        All commands, hooks and JSON documents use this value.
        """
        return self.are_files_in_step and not self.is_broken and not self.is_unmerged

    @property
    def are_files_in_step(self) -> bool:
        """Whether the files are in step, even if an edit breaks the package (see `in_step`)."""
        return not (self.failed or self.stale or self.conflicts or (self.dry and self.writes))

    @property
    def effective_changes(self) -> Changes | None:
        """The changes of the model if the build writes files or has conflicts, else None; `diff` shows all changes."""
        return self.changes if self.writes or self.conflicts or self.settled else None

    @property
    def is_built(self) -> bool:
        """Whether a build has written any file of the package, even if the record is lost."""
        return any(action.base is not None or action.reason is Reason.UNCHANGED for action in self.actions)

    @property
    def is_first(self) -> bool:
        """Whether no build has written any file of the package before."""
        return not self.is_built and any(action.reason is Reason.CREATE for action in self.actions)

    @property
    def summary(self) -> str:
        """The changes of the package, as the rest of a line that names the robot."""
        if self.failed:
            end = "the next build writes the rest" if self.unfinished else "nothing was changed"
            return f"{error_count(self.diagnostics)}, {end}"
        parts = [*(["inputs changed since the last build"] if self.stale else []), *self.counts()]
        if self.in_step and not any(action.writes for action in self.actions.decided):
            fine = (Reason.UNCHANGED, Reason.KEEP)
            total = sum(action.reason in fine for action in self.actions)
            parts.insert(0, f"in step, {counted(total, 'file')}")
        if self.is_unmerged:
            parts.insert(0, "unmerged in git")
        if self.is_broken:
            parts.insert(0, "broken: an edited file does not fit the package")
        checked = [check_result(self.checked, self.diagnostics)] if self.checked else []
        return "; ".join([", ".join(parts), *checked])

    def shown(self, path: str) -> str:
        """Return a path of the record as the user would type it."""
        return shown(Path(os.path.normpath(self.root / path)))

    def counts(self, silent: Container[Reason] = ()) -> list[str]:
        """Return a phrase with the number of files for each reason outside of `silent`, and one for waiting files."""
        decided = [action for action in self.actions.decided if not action.is_waiting]
        reasons = Counter(Reason.CONFLICT if action.is_conflict else action.reason for action in decided)
        reasons[Reason.UPDATE] += reasons.pop(Reason.CREATE, 0)
        phrases = []
        for reason in Reason:  # in the order of their definition
            if (number := reasons[reason]) and reason not in silent and reason.done:
                them, have, s = ("them", "have", "s") if number > 1 else ("it", "has", "")
                phrase = reason.to_do if self.dry else reason.done
                phrases.append(phrase.format(n=number, them=them, have=have, s=s))
                if reason is Reason.CONFLICT and (waiting := len(self.actions.decided) - len(decided)):
                    phrases[-1] += f" ({counted(waiting, 'file')} wait{'s' if waiting == 1 else ''} for {them})"
        if given_back := sum(one.choice is Choice.UNDO and one.is_conflict for one in self.actions.decided):
            phrases.insert(0, f"{counted(given_back, 'file')} set back to your former text")
        if self.renews and self.in_step and not (self.writes or self.dry or self.settled):
            phrases.append("recorded state renewed: commit .urdfsync")
        return phrases


def error_count(diagnostics: Sequence[Diagnostic]) -> str:
    """`2 errors`."""
    return counted(sum(diagnostic.severity is Severity.ERROR for diagnostic in diagnostics), "error")


def check_result(checked: Checked, diagnostics: Sequence[Diagnostic]) -> str:
    """Return the result of the check after a build, as the rest of a line that names the robot."""
    return {
        Checked.RIGHT: "checked: compiles",
        Checked.INCOMPLETE: "checked in part",
        Checked.WRONG: f"checked: {error_count(diagnostics)}",
    }[checked]


def exit_code(results: Iterable[Result], check: bool = False) -> Exit:
    """Return the exit code of the worst result: error, then lock, then conflict or broken, then out of step.

    Packages out of step count only with `check`.
    """
    results = list(results)
    if any((result.failed and not result.locked) or result.checked is Checked.WRONG for result in results):
        return Exit.ERROR
    if any(result.locked for result in results):
        return Exit.LOCKED
    if any(result.conflicts or result.is_broken for result in results):
        return Exit.CONFLICT
    return Exit.IN_STEP if not check or all(result.in_step for result in results) else Exit.OUT_OF_STEP

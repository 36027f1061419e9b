"""All or nothing for a set of files: written together, put back together, and healed after a crash."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import msgspec

from urdfsync import profiling
from urdfsync.diagnostics import Diagnostic, OutputError, Severity, StateError
from urdfsync.files import TEMPORARY, Tree, digest
from urdfsync.state import operations
from urdfsync.state.batch import Batch, SavedError, find_phase
from urdfsync.state.journal import FORMAT, Journal, Phase, Step


class UnfinishedError(OutputError):
    """Some files have changed, and could not be put back; the journal says which."""


class Change(msgspec.Struct, frozen=True):
    """What is to happen to one file."""

    path: Path
    content: bytes | None
    """None to delete it."""
    old: str | None
    """SHA-256 (hex) of the bytes that were there when this was decided; None if there was no file."""

    def read(self) -> bytes | None:
        """The bytes that are to be there; None for no file."""
        return self.content

    def hash(self) -> str | None:
        """SHA-256 (hex) of these bytes; None for no file."""
        return None if self.content is None else digest(self.content)


class Transactions:
    """The writer of one configuration, with its journal in the state folder; for the holder of the build lock only."""

    def __init__(self, root: Path, folder: Path, shown: Callable[[Path], str] = str) -> None:
        self._root, self._folder, self._shown = root, folder, shown
        self._prefix = os.path.join(root, "")  # noqa: PTH118

    def pending(self) -> bool:
        """Whether a batch is under way, or was when its process ended. Needs no lock."""
        return find_phase(self._folder) is not None

    @profiling.stage("writing")
    def apply(self, robot: str, changes: Sequence[Change], emptied: Iterable[Path] = ()) -> None:
        """Make all changes, in their order, or none; `emptied` are folders to remove if they are empty then.

        The last change is made only when all others are. Raises SavedError if somebody else has changed
        one of the files, OutputError if one can't be written: then all is as it was. Raises
        UnfinishedError if it can't be put back; `recover` will.
        """
        steps = [Step(self._key(c.path), c.old, c.hash()) for c in changes]
        made = _missing_folders(self._root, [change.path for change in changes if change.content is not None])
        journal = Journal(
            robot, str(os.getpid()), tuple(steps), tuple(map(self._key, made)), tuple(map(self._key, emptied))
        )
        batch = Batch(self._root, self._folder, journal, self._shown)
        try:
            batch.prepare(change.read() for change in changes)
            batch.apply()
        except BaseException as error:
            self._roll_back(batch, error)
            raise
        self._tidy(batch)
        profiling.count("written", len(changes))

    def recover(self, outputs: Sequence[Path], packages: Sequence[Path]) -> Diagnostic | None:
        """Finish or undo what a run left that was killed; returns what there is to say about it.

        `outputs` are the folders that may be written to beside the configuration's own, `packages` those
        that may hold temporary files. Raises UnfinishedError, or StateError if the journal can't be used.
        """
        phase = find_phase(self._folder)
        if phase is None:
            return None
        journal = self._load(phase)
        if journal is None:  # cut short, so no target has changed
            self._sweep([*packages, self._folder])
            return None
        batch = Batch(self._root, self._folder, journal, self._shown, resumed=True)
        self._check_places([*batch.targets, *batch.folders], [self._root, *outputs])
        if phase is Phase.APPLY:
            phase = self._resume(batch)
        try:
            if phase is Phase.DONE:
                batch.tidy()
            else:
                if phase is not Phase.PREPARE:
                    batch.put_back()
                batch.discard()
        except (OSError, OutputError) as error:
            raise self._unfinished(error) from None
        if phase is Phase.PREPARE:
            return None
        done = "finished" if phase is Phase.DONE else "undone, and starts again"
        message = f"the last build of robot `{journal.robot}` was interrupted; it is {done}"
        return Diagnostic(Severity.NOTE, "recovered", message)

    def _resume(self, batch: Batch) -> Phase:
        """Do the rest of a batch if that is possible. Returns the phase that it is in then."""
        try:
            if not batch.can_be_finished():
                return Phase.UNDO
            batch.apply()
        except OSError as error:
            raise self._unfinished(error) from None
        except (SavedError, OutputError):
            return Phase.UNDO
        return Phase.DONE

    def _roll_back(self, batch: Batch, reason: BaseException) -> None:
        """Put everything back; a batch that is done already is only tidied up."""
        phase = find_phase(self._folder)
        try:
            if phase is Phase.DONE:
                batch.tidy()
                return
            if phase in (Phase.APPLY, Phase.UNDO):
                batch.put_back()
            batch.discard()
        except (OSError, OutputError) as error:
            first = reason.diagnostics if isinstance(reason, OutputError) else ()
            raise self._unfinished(error, *first) from reason

    def _tidy(self, batch: Batch) -> None:
        try:
            batch.tidy()
        except OSError as error:
            raise self._unfinished(error) from None

    def _unfinished(self, error: OSError | OutputError, *first: Diagnostic) -> UnfinishedError:
        if isinstance(error, OutputError):
            return UnfinishedError(*first, *error.diagnostics)
        place = Path(error.filename) if isinstance(error.filename, str) else self._folder
        message = f"an interrupted build can't be brought to an end: {error.strerror or error}"
        hint = "repair that, then build again"
        return UnfinishedError(*first, Diagnostic(Severity.ERROR, "unfinished", message, self._shown(place), hint=hint))

    def _load(self, phase: Phase) -> Journal | None:
        """The journal; None if it is incomplete because it was being written. Raises StateError for any other."""
        file = self._folder / "journal" / f"{phase}.json"
        journal = Journal.loads(Tree(self._root, self._shown).read(file) or b"")
        if phase is not Phase.PREPARE and (journal is None or not journal.token.isalnum()):
            message = "the journal of an interrupted build can't be read"
            hint = "delete it, then build again: files that are half way will be shown as conflicts"
            raise StateError(Diagnostic(Severity.ERROR, "broken-journal", message, self._shown(file), hint=hint))
        if journal is not None and journal.format > FORMAT:
            message = "a newer urdfsync was interrupted here"
            raise StateError(
                Diagnostic(Severity.ERROR, "newer-state", message, self._shown(file), hint="update urdfsync")
            )
        return journal

    def _check_places(self, paths: Sequence[Path], roots: Sequence[Path]) -> None:
        """Refuse what a build could not have written to. Raises StateError or OutputError."""
        trees = [Tree(root, self._shown) for root in roots]
        for path in paths:
            if path in roots:
                continue
            tree = next((tree for tree in trees if tree.root in path.parents), None)
            if tree is None:
                message = "an interrupted build was writing this file, but it is in no output folder now"
                hint = "bring back the `output` that the robot had, build, then change it"
                raise StateError(Diagnostic(Severity.ERROR, "outside", message, self._shown(path), hint=hint))
            tree.check_folder(path.parent)

    def _sweep(self, folders: Sequence[Path]) -> None:
        """Remove the temporary files of a run that did not get far enough to say which they are."""
        found = {path for folder in folders for path in folder.rglob(f".*{TEMPORARY}")}
        for path in sorted(found):
            operations.remove(path)
        operations.remove(self._folder / "journal" / f"{Phase.PREPARE}.json")

    def _key(self, path: Path) -> str:
        if (place := str(path)).startswith(self._prefix):  # relpath takes ten times as long
            return place[len(self._prefix) :].replace(os.sep, "/")
        return Path(os.path.relpath(path, self._root)).as_posix()


def _missing_folders(root: Path, paths: Iterable[Path]) -> list[Path]:
    """The folders of these files that do not exist, outermost first."""
    missing: set[Path] = set()
    for innermost in {os.path.dirname(path) for path in paths}:  # noqa: PTH120 - thousands of files
        if os.path.isdir(innermost):  # noqa: PTH112 - as nearly always
            continue
        for folder in (Path(innermost), *Path(innermost).parents):
            if folder == root or folder in missing or folder.is_dir():
                break
            missing.add(folder)
    return sorted(missing)

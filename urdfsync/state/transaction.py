"""Write a set of files so that a crash, a full disk or somebody's save at any moment loses nothing.

A transaction only goes forward:

1. All new files are written beside their targets under temporary names.
2. The journal makes the intent durable. Until then nothing has changed, and an error or a crash leaves no trace.
3. Each target is exchanged with its new file. The old file stands under the temporary name then, where its hash shows
   whether it is the one that was planned with. If it is not, somebody has saved the target in between: the two are
   exchanged back, and the target is *overtaken*. It stays as it is, and the manifest records it as a conflict.
4. The manifest takes its place, and what is left under temporary names is removed.

Whoever finds a journal finishes the transaction by the same steps: what stands in a target and under its temporary
name says how far it is. A temporary name that holds bytes that nobody planned with holds a save of the user's. It is
put back, or kept beside the target under a name that people see.
"""

from __future__ import annotations

import contextlib
import itertools
import os
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from pathlib import Path

import msgspec

from urdfsync import profiling
from urdfsync.diagnostics import Diagnostic, OutputError, Severity, StateError
from urdfsync.files import TEMPORARY, Tree, digest, failure
from urdfsync.state import file_operations, manifest
from urdfsync.state.journal import (
    Journal,
    Phase,
    Step,
    check_folders,
    check_paths,
    find_phase,
    is_pending,
    journal_file,
    load,
    refuse_old,
    save,
    set_aside,
    unfinished_file,
)

_OTHER = "no regular file"
"""Stands for the hash of a folder, a link or a device."""
_ADJUSTED = "overtaken"
"""In the temporary name of a manifest that says that files were overtaken."""


class UnfinishedError(OutputError):
    """Some files have changed, and the others could not be; the journal says which, and the next build finishes."""


class Change(msgspec.Struct, frozen=True):
    """What is to happen to one file."""

    path: Path
    content: bytes | None
    """None to delete the file."""
    old: str | None
    """SHA-256 (hex) of the bytes that were there when this was decided; None if there was no file."""


class Applied(msgspec.Struct, frozen=True):
    """What became of a transaction."""

    overtaken: tuple[Path, ...] = ()
    """Targets that somebody saved in between; they are as they were saved."""
    diagnostics: tuple[Diagnostic, ...] = ()


class Transactions:
    """The writer of one configuration, with its journal in the state folder; for the holder of the build lock only."""

    def __init__(
        self, root: Path, folder: Path, shown: Callable[[Path], str] = str, outputs: Sequence[Path] = ()
    ) -> None:
        """`root` is the configuration's folder, `folder` the state folder; `outputs` may be written to as well."""
        self._root, self._folder, self._shown, self._outputs = root, folder, shown, outputs

    def pending(self) -> bool:
        """Whether a transaction is under way, or was when its process ended. Needs no lock."""
        return is_pending(self._folder)

    @profiling.stage("writing")
    def apply(self, robot: str, changes: Sequence[Change], emptied: Iterable[Path] = ()) -> Applied:
        """Make all changes; the manifest is the last one. `emptied` are folders to remove if they are empty then.

        Raises OutputError if a file can't be written: nothing has changed then. Raises UnfinishedError if that shows
        only when files have changed already; `recover` goes on.
        """
        paths = [change.path for change in changes]
        trees = self._trees()
        check_paths(paths, trees, self._folder, self._shown)
        journal = Journal(
            robot,
            os.urandom(8).hex(),
            tuple(Step(self._key(c.path), c.old, None if c.content is None else digest(c.content)) for c in changes),
            tuple(self._key(folder) for folder in self._missing_folders(changes)),
            tuple(map(self._key, emptied)),
        )
        transaction = _Transaction(self._root, self._folder, self._shown, journal)
        try:
            transaction.prepare(change.content for change in changes)
            applied = self._finish(transaction)
        except UnfinishedError:
            raise
        except BaseException as error:
            self._give_up(transaction, error)
            raise
        profiling.count("written", len(changes) - len(applied.overtaken))
        return applied

    def recover(self, repair: bool = False) -> tuple[Diagnostic, ...]:
        """Finish what a run left that was killed; returns what there is to say about it.

        With `repair`, a journal that can't be believed is set aside. Raises StateError for such a journal otherwise,
        and UnfinishedError if the transaction can't be finished.
        """
        phase = find_phase(self._folder)
        if phase is None:
            if self.pending():
                refuse_old(self._folder, self._shown)
            return ()
        try:
            transaction = self._load(phase)
        except StateError as error:
            if not repair or {found.code for found in error.diagnostics} != {"broken-journal"}:
                raise
            return (self._set_aside(),)
        if phase is Phase.PREPARE:
            try:
                transaction.discard()
            except OSError as error:
                raise self._unfinished(error) from None
            return ()
        applied = self._finish(transaction)
        message = f"the last build of robot `{transaction.journal.robot}` was interrupted; it is finished"
        return Diagnostic(Severity.NOTE, "recovered", message), *applied.diagnostics

    def _give_up(self, transaction: _Transaction, error: BaseException) -> None:
        """End a transaction that was stopped: go back as long as nothing is durable, else forward."""
        known = error.diagnostics if isinstance(error, OutputError) else ()
        if find_phase(self._folder) in (Phase.APPLY, Phase.DONE):
            if known:
                raise UnfinishedError(*known) from error
            self._finish(transaction)  # Ctrl-C: it takes some milliseconds
            return
        try:
            transaction.discard()
        except OSError as other:
            raise self._unfinished(other, *known) from error

    def _load(self, phase: Phase) -> _Transaction:
        journal = load(self._root, self._folder, phase, self._shown)
        transaction = _Transaction(self._root, self._folder, self._shown, journal)
        trees, source = self._trees(), journal_file(self._folder, phase)
        check_paths(transaction.targets, trees, self._folder, self._shown, source)
        check_folders(transaction.folders, trees, self._folder, self._shown)
        return transaction

    def _finish(self, transaction: _Transaction) -> Applied:
        try:
            return transaction.finish()
        except OSError as error:
            raise self._unfinished(error) from None

    def _set_aside(self) -> Diagnostic:
        try:
            aside = set_aside(self._folder)
        except OSError as error:
            raise self._unfinished(error) from None
        message = "the journal of an interrupted build was set aside, and nothing was done of it"
        hint = f"look at files called .*{TEMPORARY} in packages: they may hold what somebody saved meanwhile"
        return Diagnostic(Severity.WARNING, "refused-journal", message, self._shown(aside), hint=hint)

    def _unfinished(self, error: OSError, *first: Diagnostic) -> UnfinishedError:
        place = Path(error.filename) if isinstance(error.filename, str) else self._folder
        message = f"an interrupted build can't be brought to an end: {error.strerror or error}"
        hint = "repair that, then build again"
        return UnfinishedError(*first, Diagnostic(Severity.ERROR, "unfinished", message, self._shown(place), hint=hint))

    def _trees(self) -> list[Tree]:
        return [Tree(self._root, self._shown), *(Tree(output, self._shown) for output in self._outputs)]

    def _missing_folders(self, changes: Iterable[Change]) -> list[Path]:
        """The folders that these files need and that do not exist, outermost first."""
        missing: set[Path] = set()
        for innermost in {change.path.parent for change in changes if change.content is not None}:
            for folder in (innermost, *innermost.parents):
                if folder == self._root or folder in missing or folder.is_dir():
                    break
                missing.add(folder)
        return sorted(missing)

    def _key(self, path: Path) -> str:
        if path.is_relative_to(self._root):
            return path.relative_to(self._root).as_posix()
        return Path(os.path.relpath(path, self._root)).as_posix()


class _Transaction:
    """The files of one journal."""

    def __init__(self, root: Path, folder: Path, shown: Callable[[Path], str], journal: Journal) -> None:
        self.journal = journal
        self._root, self._folder, self._shown = root, folder, shown
        self._files = []
        for number, step in enumerate(journal.steps):
            path = _join(root, step.path)
            self._files.append(_File(path, self._temporary(path, number), step.old, step.new))

    @property
    def targets(self) -> list[Path]:
        """The files that change."""
        return [file.path for file in self._files]

    @property
    def folders(self) -> list[Path]:
        """The folders that come or go."""
        return [_join(self._root, path) for path in (*self.journal.made, *self.journal.emptied)]

    def prepare(self, contents: Iterable[bytes | None]) -> None:
        """Write all new files, and make the intent durable. Raises OutputError."""
        journal = journal_file(self._folder, Phase.PREPARE)
        for folder in (self._folder, journal.parent):
            with self._about(folder):
                file_operations.make_folder(folder)
        with self._about(journal):
            save(self._folder, self.journal)
            file_operations.sync([journal])  # before the first temporary file, or nobody would know of that
        for path in self.journal.made:
            with self._about(_join(self._root, path)):
                file_operations.make_folder(_join(self._root, path))
        written = []
        for file, content in zip(self._files, contents, strict=True):
            if content is not None:
                with self._about(file.path):
                    file_operations.write(file.temporary, content, file.path)
                written.append(file.temporary)
        with self._about(self._folder):
            file_operations.sync(written)
            self._enter(Phase.APPLY)
            file_operations.sync([journal.parent])

    def discard(self) -> None:
        """Remove all traces of a transaction of which no target has changed. Raises OSError."""
        for file in self._files:
            file_operations.remove(file.temporary)
        for path in reversed(self.journal.made):
            file_operations.remove_folder(_join(self._root, path))
        for journal in (unfinished_file(self._folder), journal_file(self._folder, Phase.PREPARE)):
            file_operations.remove(journal)

    def finish(self) -> Applied:
        """Change all targets that have not changed yet, the manifest last, and remove all traces. Raises OSError."""
        overtaken: list[Path] = []
        if find_phase(self._folder) is not Phase.DONE:
            overtaken = self._change_all()
            file_operations.sync(sorted({path.parent for path in self.targets if path.parent.is_dir()}))
            self._enter(Phase.DONE)
        last = self._files[-1]
        adjusted = _File(last.path, self._temporary(last.path, _ADJUSTED), last.old, last.new)
        left = {str(path) for folder in {path.parent for path in self.targets} for path in _files_in(folder)}
        saved = [(file, name) for file in (*self._files, adjusted) for name in file.clear(left)]
        for path in self.journal.emptied:
            file_operations.remove_folder(_join(self._root, path))
        file_operations.remove(journal_file(self._folder, Phase.DONE))
        return Applied(tuple(overtaken), tuple(self._told(file, name) for file, name in saved))

    def _change_all(self) -> list[Path]:
        """Change the targets. Returns those that somebody saved in between."""
        *others, last = self._files
        changed = [file.change() for file in others]
        # again, since somebody may have written to an old file through a handle that was opened before
        overtaken = [
            file.path
            for file, done in zip(others, changed, strict=True)
            if not (done if file.old is None else file.change())
        ]
        is_manifest = _is_manifest(last) and last.new is not None
        done = self._record(last, overtaken) if overtaken and is_manifest else last.change()
        return overtaken if done else [*overtaken, last.path]

    def _record(self, last: _File, overtaken: Sequence[Path]) -> bool:
        """Change the manifest, which says that other files were overtaken. Returns False if it was overtaken itself."""
        temporary = self._temporary(last.path, _ADJUSTED)
        planned = _find(last.new, [last.temporary, last.path])
        if planned is None:
            return False
        before = [(file.old, (file.path, file.temporary, temporary)) for file in self._files if _is_manifest(file)]
        recorded = (_find(old, paths) for old, paths in before)
        keys = [step.path for step, file in zip(self.journal.steps, self._files, strict=True) if file.path in overtaken]
        text = manifest.with_overtaken(planned, [found for found in recorded if found is not None], keys)
        current = hash_of(last.path)
        adjusted = _File(last.path, temporary, last.new if current == last.new else last.old, digest(text))
        if current != adjusted.new and (adjusted.old is None or hash_of(temporary) != adjusted.old):
            file_operations.remove(temporary)  # a run that was killed may have written half of it
            file_operations.write(temporary, text, last.path)
        if adjusted.change():
            return True
        if hash_of(temporary) == adjusted.new:
            file_operations.remove(temporary)
        return False

    def _told(self, file: _File, name: Path) -> Diagnostic:
        message = f"it was saved in the instant in which a build replaced it; that save is kept as {self._shown(name)}"
        return Diagnostic(Severity.WARNING, "kept-save", message, self._shown(file.path))

    def _temporary(self, path: Path, name: int | str) -> Path:
        return path.with_name(f".{self.journal.token}-{name}{TEMPORARY}")

    def _enter(self, phase: Phase) -> None:
        """Rename the journal."""
        now = find_phase(self._folder)
        if now is not None and now is not phase:
            file_operations.replace(journal_file(self._folder, now), journal_file(self._folder, phase))

    @contextlib.contextmanager
    def _about(self, path: Path) -> Iterator[None]:
        """Turn an error of the system into one about a file."""
        try:
            yield
        except OSError as error:
            raise failure(error, self._shown(path)) from None


class _File(msgspec.Struct, frozen=True):
    """One target; `old` and `new` are hashes as in `Step`."""

    path: Path
    temporary: Path
    """Holds the new file before the change, and the old one after it."""
    old: str | None
    new: str | None

    def change(self) -> bool:
        """Change the target, unless that is done. Returns False if somebody saved it in between: then it is theirs.

        Raises OSError.
        """
        try:
            if self.old is None:
                return self._create()
            return self._delete() if self.new is None else self._replace()
        except (FileNotFoundError, FileExistsError, NotADirectoryError):
            return False  # somebody deleted the file or its folder, or saved a file whose name was free

    def clear(self, left: Collection[str]) -> Iterator[Path]:
        """Remove what is left under temporary names. What nobody planned with is kept; yields under which name.

        `left` are all paths that exist: nearly all temporary files are gone.
        """
        for path in (self.temporary, file_operations.spare(self.temporary)):
            found = hash_of(path) if str(path) in left else None
            if found in (self.old, self.new):
                file_operations.remove(path)
            elif found is not None:
                yield self._keep(path)

    def _create(self) -> bool:
        if not os.path.lexists(self.temporary):
            return True  # it has been placed
        if os.path.lexists(self.path):
            return hash_of(self.path) == self.new
        file_operations.place(self.temporary, self.path)
        return True

    def _delete(self) -> bool:
        found, current = hash_of(self.temporary), hash_of(self.path)
        if found is None and current == self.old:
            file_operations.replace(self.path, self.temporary)
            found = hash_of(self.temporary)
        if found is None:
            return current is None
        if found != self.old:
            file_operations.place(self.temporary, self.path)
        return found == self.old

    def _replace(self) -> bool:
        file_operations.complete_exchange(self.temporary, self.path)
        found, current = hash_of(self.temporary), hash_of(self.path)
        if found == self.new and current == self.old:
            file_operations.exchange(self.temporary, self.path)
            found, current = hash_of(self.temporary), self.new
        if found in (self.new, None):
            return current == self.new
        if found == self.old:
            return True
        if current == self.new:  # what was replaced is somebody's save: it takes its place again
            file_operations.exchange(self.temporary, self.path)
            if hash_of(self.temporary) != self.new:  # and was saved once more: the later save counts
                file_operations.exchange(self.temporary, self.path)
        return False

    def _keep(self, path: Path) -> Path:
        """Move somebody's save to a free name beside the target."""
        for number in itertools.count(1):
            name = self.path.with_name(f"{self.path.name}.saved{'' if number == 1 else number}")
            with contextlib.suppress(FileExistsError):
                file_operations.place(path, name)
                return name
        raise AssertionError


def hash_of(path: Path) -> str | None:
    """SHA-256 (hex) of a file, None for nothing; a word for what is no regular file. Raises OSError."""
    try:
        content = file_operations.read(path)
    except IsADirectoryError:
        return _OTHER
    return None if content is None else digest(content)


def _files_in(folder: Path) -> list[Path]:
    try:
        return list(folder.iterdir())
    except (FileNotFoundError, NotADirectoryError):
        return []


def _find(wanted: str | None, paths: Iterable[Path]) -> bytes | None:
    """The content of this hash, from one of several files."""
    for path in paths if wanted else ():
        with contextlib.suppress(IsADirectoryError):
            content = file_operations.read(path)
            if content is not None and digest(content) == wanted:
                return content
    return None


def _is_manifest(file: _File) -> bool:
    return file.path.suffix == ".toml" and file.path.parent.name == "robots"


def _join(root: Path, path: str) -> Path:
    """The path that a journal gives from the configuration's folder."""
    return Path(os.path.normpath(root / path))

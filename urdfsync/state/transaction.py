"""Write a set of files so that a crash, a full disk or somebody's save at any moment loses nothing.

A transaction only goes forward:

1. All new files are written beside their targets under temporary names.
2. The journal makes the intent durable. Until then nothing has changed, and an error or a crash leaves no trace.
3. Each target is exchanged with its new file. The old file stands under the temporary name then, where its hash shows
   whether it is the one that was planned with. If it is not, somebody has saved the target in between: the two are
   exchanged back, and the target is *overtaken*.
4. The recorded state takes its place, the manifest last, unless a target was overtaken: then it stays as it was, and
   the build records what was done.
5. What is left under temporary names is removed.

Whoever finds a journal finishes the transaction by the same steps: what stands in a target and under its temporary
name says how far it is. A temporary name that holds bytes that nobody planned with holds a save of the user's. It is
put back, or kept beside the target under a name that people see.
"""

from __future__ import annotations

import contextlib
import itertools
import os
from collections.abc import Collection, Iterable, Iterator, Sequence
from pathlib import Path
from typing import NoReturn

import msgspec

from urdfsync.diagnostics import Diagnostic, OutputError, Severity, StateError
from urdfsync.files import TEMPORARY, Tree, digest, failure, placed, shown
from urdfsync.state import file_operations
from urdfsync.state.journal import REPAIR, Journal, JournalFolder, Phase, Step

_OTHER = "no regular file"
"""Stands for the hash of a folder, a link or a device."""
_STATE_FILES = {"robots": (".state",), "svg": (".svg",)}
"""Folders and suffixes of the files in the state folder that transactions write, beside those of conflicts."""


class UnfinishedError(OutputError):
    """Some files have changed, and the others could not be; the journal says which, and the next build finishes."""


class FileChange(msgspec.Struct, frozen=True):
    """What is to happen to one file."""

    path: Path
    content: bytes | None
    """None to delete the file."""
    old: str | None
    """SHA-256 (hex) of the bytes that were there when this was decided; None if there was no file."""
    is_moved: bool = False
    """Whether this is a text of the user's that leaves its old place; it is kept if it can't come here."""


class Applied(msgspec.Struct, frozen=True):
    """What became of a transaction."""

    not_done: tuple[Path, ...] = ()
    """Targets that somebody saved in between, and the recorded state that stays because of it."""
    diagnostics: tuple[Diagnostic, ...] = ()


class Transactions:
    """The writer of one configuration, with its journal in the state folder; for the holder of the build lock only."""

    def __init__(self, root: Path, folder: Path, outputs: Sequence[Path] = ()) -> None:
        """`root` is the configuration's folder, `folder` the state folder; `outputs` may be written to as well."""
        self._root, self._folder, self._outputs = root, folder, outputs
        self._prefix = os.path.join(root, "")  # noqa: PTH118 - strings: there are thousands of files
        self._journals = JournalFolder(root, folder / "journal")

    def pending(self) -> bool:
        """Whether a transaction is under way, or was when its process ended. Needs no lock."""
        return bool(self._journals.names())

    def apply(self, robot: str, changes: Sequence[FileChange], emptied: Iterable[Path] = ()) -> Applied:
        """Make all changes. `emptied` are folders to remove if they are empty then.

        Raises OutputError if a file can't be written: nothing has changed then. Raises UnfinishedError if that shows
        only when files have changed already; `recover` goes on.
        """
        steps = (
            Step(self._key(c.path), c.old, None if c.content is None else digest(c.content), c.is_moved)
            for c in changes
        )
        made: set[Path] = set()
        for innermost in {change.path.parent for change in changes if change.content is not None}:
            for folder in (innermost, *innermost.parents):
                if folder == self._root or folder in made or folder.is_dir():
                    break
                made.add(folder)
        keys = tuple(map(self._key, sorted(made))), tuple(map(self._key, emptied))
        journal = Journal(robot, os.urandom(8).hex(), tuple(steps), *keys)
        self._check(journal)
        files = self._files(journal)
        try:
            self._prepare(journal, files, [change.content for change in changes])
            applied = self._finish(journal, files)
        except UnfinishedError:
            raise
        except BaseException as error:
            known = error.diagnostics if isinstance(error, OutputError) else ()
            if self._journals.phase() in (Phase.APPLY, Phase.DONE):  # durable: only forward
                if known:
                    raise UnfinishedError(*known) from error
                self._finish(journal, files)  # Ctrl-C: it takes some milliseconds
            else:
                self._discard(journal, files, known)
            raise
        return applied

    def recover(self, repair: bool = False) -> tuple[Diagnostic, ...]:
        """Finish what a run left that was killed; returns what there is to say about it.

        With `repair`, a journal that can't be believed is set aside. Raises StateError for such a journal otherwise,
        and UnfinishedError if the transaction can't be finished.
        """
        if not self.pending():
            return ()
        try:
            journal, phase = self._journals.load()
            self._check(journal, self._journals.file(phase))
        except StateError as error:
            if not repair or {found.code for found in error.diagnostics} != {"broken-journal"}:
                raise
            try:
                aside = self._journals.set_aside()
            except OSError as problem:
                self._refuse_to_finish(problem)
            message = "the journal of an interrupted build was set aside, and nothing was done of it"
            hint = f"look at files called .*{TEMPORARY} in packages: they may hold what somebody saved meanwhile"
            return (Diagnostic(Severity.WARNING, "refused-journal", message, shown(aside), hint=hint),)
        files = self._files(journal)
        if phase is Phase.PREPARE:
            self._discard(journal, files)
            return ()
        applied = self._finish(journal, files)
        message = f"the last build of robot `{journal.robot}` was interrupted; it is finished"
        return Diagnostic(Severity.NOTE, "recovered", message), *applied.diagnostics

    def _prepare(self, journal: Journal, files: Sequence[_File], contents: Sequence[bytes | None]) -> None:
        """Write all new files, and make the intent durable. Raises OutputError."""
        written, place = [], self._folder
        try:
            file_operations.make_folder(self._folder)
            place = self._journals.folder
            file_operations.make_folder(place)
            place = self._journals.file(Phase.PREPARE)
            self._journals.save(journal)  # before the first temporary file, or nobody would know of that
            for place in map(self._path, journal.made):
                file_operations.make_folder(place)
            for file, content in zip(files, contents, strict=True):
                if content is not None:
                    place = file.path
                    file_operations.write(file.temporary, content, file.path)
                    written.append(file.temporary)
            place = self._folder
            file_operations.sync(written)
            self._journals.enter(Phase.APPLY)
            file_operations.sync([self._journals.folder])
        except OSError as error:
            raise failure(error, place) from None

    def _discard(self, journal: Journal, files: Sequence[_File], known: Sequence[Diagnostic] = ()) -> None:
        """Remove all traces of a transaction of which no target has changed; `known` is why. Raises UnfinishedError."""
        try:
            for file in files:
                file_operations.remove(file.temporary)
            for path in reversed(journal.made):
                file_operations.remove_folder(self._path(path))
            self._journals.remove()
        except OSError as error:
            self._refuse_to_finish(error, known)

    def _finish(self, journal: Journal, files: Sequence[_File]) -> Applied:
        """Change all targets that have not changed yet, and remove all traces. Raises UnfinishedError."""
        folders = sorted({file.folder for file in files})
        not_done: list[Path] = []
        try:
            if self._journals.phase() is not Phase.DONE:
                state_folder = str(self._folder / "robots")
                others = [file for file in files if file.folder != state_folder]
                changed = [(file, file.change()) for file in others]
                # again, since somebody may have written to an old file through a handle that was opened before
                changed = [(file, done if file.old is None else file.change()) for file, done in changed]
                not_done = [file.path for file, done in changed if not done]
                for file in files:  # the recorded state comes last, and stays if a target is not as planned
                    if file.folder == state_folder and (not_done or not file.change()):
                        not_done.append(file.path)
                file_operations.sync([folder for folder in map(Path, folders) if folder.is_dir()])
                self._journals.enter(Phase.DONE)
            left = set()
            for folder in folders:
                with contextlib.suppress(FileNotFoundError, NotADirectoryError):
                    names = os.listdir(folder)  # noqa: PTH208 - with those of an exchange of three renames, `….…-tmp~`
                    left |= {f"{folder}{os.sep}{name}" for name in names if TEMPORARY in name}
            saved = [(file, name) for file in files for name in file.clear(left)] if left else []
            for path in journal.emptied:
                file_operations.remove_folder(self._path(path))
            self._journals.remove()
        except OSError as error:
            self._refuse_to_finish(error)
        message = "it was saved in the instant in which a build wrote it; the other text is kept as"
        return Applied(
            tuple(not_done),
            tuple(
                Diagnostic(Severity.WARNING, "kept-save", f"{message} {shown(name)}", shown(file.path))
                for file, name in saved
            ),
        )

    def _check(self, journal: Journal, source: Path | None = None) -> None:
        """Refuse files and folders that no build writes, and links on the way. Raises StateError or OutputError.

        `source` is the file of a journal that was found; None for a build that is about to write.
        """
        trees = [Tree(self._root), *(Tree(output) for output in self._outputs)]
        paths = [(placed(self._prefix, step.path), False) for step in journal.steps]
        paths += [(placed(self._prefix, path), True) for path in (*journal.made, *journal.emptied)]
        for path, is_folder in paths:
            tree = next((tree for tree in trees if tree.covers(path)), None)
            if tree is None or not self._is_written(path, tree.root, is_folder):
                code, hint = ("broken-journal", REPAIR) if source else ("outside", "")
                if source and tree is None:
                    hint = f"bring back the `output` that the robot had, and build; {REPAIR}"
                message = f"{shown(Path(path))} is no file that a build writes"
                file = shown(source or Path(path))
                raise StateError(Diagnostic(Severity.ERROR, code, message, file, hint=hint))
            tree.check_folder(os.path.dirname(path))  # noqa: PTH120 - strings: there are thousands of files

    def _is_written(self, path: str, root: Path, is_folder: bool) -> bool:
        """Whether a path below a root is of a package, around one, or of the state."""
        state = str(self._folder)
        if path == state or path.startswith(state + os.sep):
            parts = path[len(state) + 1 :].replace(os.sep, "/").split("/")
            if is_folder or parts in ([".gitignore"], [".gitattributes"]):
                return True
            is_state = len(parts) == 2 and parts[1].endswith(_STATE_FILES.get(parts[0], ()))
            return is_state or (len(parts) > 1 and parts[0] == "conflicts")
        parts = path[len(str(root)) :].strip(os.sep).replace(os.sep, "/").split("/")
        if any(part.startswith(".") for part in parts):  # `.git` among them
            return False
        return is_folder or parts[-1] == "package.order" or parts[-1].endswith(".mo") or "Resources" in parts[1:-1]

    def _refuse_to_finish(self, error: OSError, known: Sequence[Diagnostic] = ()) -> NoReturn:
        place = Path(error.filename) if isinstance(error.filename, str) else self._folder
        message = f"an interrupted build can't be brought to an end: {error.strerror or error}"
        hint = "repair that, then build again"
        found = Diagnostic(Severity.ERROR, "unfinished", message, shown(place), hint=hint)
        raise UnfinishedError(*known, found) from error

    def _files(self, journal: Journal) -> list[_File]:
        found = []
        for number, step in enumerate(journal.steps):
            path = placed(self._prefix, step.path)
            folder = path.rpartition(os.sep)[0]
            temporary = f"{folder}{os.sep}.{journal.token}-{number}{TEMPORARY}"
            found.append(_File(folder, Path(path), Path(temporary), step.old, step.new, step.is_moved))
        return found

    def _key(self, path: Path) -> str:
        """A path as journals name it: from the configuration's folder, POSIX."""
        text = str(path)
        key = text[len(self._prefix) :] if text.startswith(self._prefix) else os.path.relpath(path, self._root)
        return key.replace(os.sep, "/")

    def _path(self, key: str) -> Path:
        return Path(placed(self._prefix, key))


class _File(msgspec.Struct, frozen=True):
    """One target; `old` and `new` are hashes as in `Step`."""

    folder: str
    path: Path
    temporary: Path
    """Holds the new file before the change, and the old one after it."""
    old: str | None
    new: str | None
    is_moved: bool

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

        So is a text of the user's that was to move here. `left` are the paths of all temporary files.
        """
        for path in (self.temporary, file_operations.spare(self.temporary)):
            if str(path) not in left:
                continue
            found = hash_of(path)
            is_homeless = self.is_moved and found == self.new != hash_of(self.path)
            if found in (self.old, self.new) and not is_homeless:
                file_operations.remove(path)
            elif found is not None:
                for number in itertools.count(1):
                    name = self.path.with_name(f"{self.path.name}.saved{'' if number == 1 else number}")
                    with contextlib.suppress(FileExistsError):
                        file_operations.place(path, name)
                        break
                yield name

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


def hash_of(path: Path) -> str | None:
    """SHA-256 (hex) of a file, None for nothing; a word for what is no regular file. Raises OSError."""
    try:
        content = file_operations.read(path)
    except IsADirectoryError:
        return _OTHER
    return None if content is None else digest(content)

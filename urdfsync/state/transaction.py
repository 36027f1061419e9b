"""Writes a set of files. A crash, a full disk or a save at any moment loses nothing.

1. The planned hashes are written under a temporary name.
2. All new files are written beside their targets under temporary names, and written through to the disk.
3. The planned hashes get their final name. Until then nothing has changed, and an error leaves no trace.
4. Each target is exchanged with its new file, in the order of `Writes`. The old file then has the temporary name.
   The old file's hash shows whether it is the file of the plan. If not, somebody has saved the target meanwhile: the
   two files are exchanged back, and the target is *overtaken*.
5. The recorded state is replaced, unless a target was overtaken.
6. The files under temporary names are removed, and then the planned hashes. If a target was overtaken, the next
   plan recognises the written texts by their bases.

From step 4 on, every write can be repeated, and recovery resumes there. If a file under a temporary name has an
unplanned content, the user has saved this content. It is put back, or kept beside the target under a visible name.
"""

from __future__ import annotations

import contextlib
import itertools
import os
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.dependencies import localfile
from urdfsync.dependencies.reads import file_type
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.files import TEMPORARY, Tree, digest, failure, placed, shown
from urdfsync.state import file_operations

PLANNED = "planned.json"
"""The file of the planned hashes during a build, and after a killed build."""
DRAFT = f".{PLANNED}{TEMPORARY}"
"""The name of this file until all new files are written. While it has this name, no target has changed."""
_OTHER = "no regular file"
"""Stands for the hash of a folder, a link or a device."""


class UnfinishedError(OutputError):
    """A build changed some files, and then failed. The planned hashes stay, and the next build finishes the changes."""


class FileChange(msgspec.Struct, frozen=True):
    """A planned change of one file."""

    path: Path
    content: bytes | None
    """The new content; None to delete the file."""
    old: str | None
    """SHA-256 (hex) of the bytes at the time of the plan; None if there was no file."""
    is_moved: bool = False
    """Whether this is a user's text from another path; if it can't move here, it is kept under another name."""


class Writes(msgspec.Struct, frozen=True):
    """All changes of one build."""

    before: tuple[FileChange, ...] = ()
    """Bases and copies: each text is known by its base, and copied if it will be replaced, before its file changes."""
    files: tuple[FileChange, ...] = ()
    record: tuple[FileChange, ...] = ()
    """Recorded state: it changes only if all other files did."""

    def in_order(self) -> list[FileChange]:
        """Return all changes in the order in which they are made: deletions come late, and the record last."""
        written = (change for change in (*self.before, *self.files) if change.content is not None)
        deleted = (change for change in (*self.files, *self.before) if change.content is None)
        return [*written, *deleted, *self.record]

    def __bool__(self) -> bool:
        return bool(self.before or self.files or self.record)


class PlannedFile(msgspec.Struct, frozen=True, omit_defaults=True):
    """The change of one file, as SHA-256 (hex) of old and new bytes; None stands for no file."""

    path: str
    """POSIX, from the configuration's folder."""
    old: str | None = None
    new: str | None = None
    is_moved: bool = False


class PlannedBuild(msgspec.Struct, frozen=True):
    """The planned changes of one build."""

    robot: str
    token: str
    """Part of the temporary files' names: hexadecimal."""
    files: tuple[PlannedFile, ...]
    """In the order of their changes."""
    recorded: int = 0
    """The number of files of the recorded state; they are the last ones."""
    emptied: tuple[str, ...] = ()
    """Folders to delete if they are empty after the build, innermost first."""


class Applied(msgspec.Struct, frozen=True):
    """The outcome of a transaction."""

    not_done: tuple[Path, ...] = ()
    """Targets that somebody saved meanwhile; if there are any, also the files of the recorded state, which stay."""
    diagnostics: tuple[Diagnostic, ...] = ()
    written: Mapping[str, str | None] = {}
    """The hash of each target by path; None for a deleted file."""


class Transactions:
    """Writes all files of one configuration. Only the holder of the build lock may use it."""

    def __init__(self, root: Path, state_folder: Path, outputs: Collection[Path] = ()) -> None:
        """`root` is the configuration's folder; files in `outputs` may be written, too."""
        self._root, self._state_folder, self._outputs = root, state_folder, outputs
        self._prefix = os.path.join(root, "")  # noqa: PTH118 - strings: there are thousands of files
        self._planned, self._draft = state_folder / PLANNED, state_folder / DRAFT

    def apply(self, robot: str, writes: Writes, emptied: Iterable[Path] = ()) -> Applied:
        """Make all changes.

        `emptied` are folders to remove if they are empty afterwards. Raises OutputError if a file can't be written and
        nothing has changed. Raises UnfinishedError if files have changed; `recover` finishes the changes.
        """
        changes = writes.in_order()
        hashes = (None if change.content is None else digest(change.content) for change in changes)
        files = tuple(
            PlannedFile(self._key(change.path), change.old, new, change.is_moved)
            for change, new in zip(changes, hashes, strict=True)
        )
        folders = tuple(map(self._key, emptied))
        build = PlannedBuild(robot, os.urandom(8).hex(), files, len(writes.record), folders)
        targets, made, has_begun = self._targets(build), self._missing_folders(changes), False
        try:
            self._prepare(build, made, targets, [change.content for change in changes])
            has_begun = True
            return self._finish(build, targets)
        except BaseException as error:
            try:
                if not has_begun:
                    self._discard(targets, made)
                elif isinstance(error, OSError):
                    raise
                else:
                    self._finish(build, targets)  # also after Ctrl-C: this takes milliseconds
            except OSError as problem:
                told = error.diagnostics if isinstance(error, OutputError) else ()
                raise UnfinishedError(*told, self._unfinished(problem)) from error
            raise

    def recover(self) -> tuple[Diagnostic, ...]:
        """Finish a killed build; returns findings about it.

        Raises UnfinishedError if this fails, OutputError for links in paths.
        """
        notes: tuple[Diagnostic, ...] = ()
        try:
            if draft := self._load(self._draft):
                self._discard(self._targets(draft))
            file_operations.remove(self._draft)
            build = self._load(self._planned)
            if build is not None:
                applied = self._finish(build, self._targets(build))
                notes = applied.diagnostics
                if not applied.not_done:
                    message = f"the last build of robot `{build.robot}` was interrupted; it is finished"
                    notes = Diagnostic(Severity.NOTE, "recovered", message), *notes
            elif is_interrupted(self._state_folder):
                file_operations.remove(self._planned)
                message = "an interrupted build belongs to another folder or can't be read; it is ignored"
                hint = f"look for files .*{TEMPORARY} in packages: they may hold what you saved during that build"
                notes = (Diagnostic(Severity.WARNING, "unknown-build", message, shown(self._planned), hint=hint),)
        except OSError as error:
            raise UnfinishedError(self._unfinished(error)) from error
        return notes

    def is_pending(self) -> bool:
        """Whether a build is writing, or was killed while writing."""
        return is_interrupted(self._state_folder) or file_type(self._draft, follow=False) != 0

    def _load(self, file: Path) -> PlannedBuild | None:
        """Return the planned hashes in a file; None for a copy: it has another inode or time.

        A stranger may have committed the file: his files under temporary names must not count as urdfsync's. Raises
        OutputError for symbolic links.
        """
        Tree(self._root).read(file)
        try:
            return msgspec.json.decode(localfile.read(file) or b"", type=PlannedBuild)
        except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
            return None

    def _prepare(
        self, build: PlannedBuild, made: Sequence[Path], targets: Sequence[_Target], contents: Sequence[bytes | None]
    ) -> None:
        """Write the planned hashes under a temporary name, and all new files. Raises OutputError."""
        written = list[str]()
        place: str | Path = self._state_folder
        try:
            file_operations.make_folder(self._state_folder)
            place = self._planned
            file_operations.remove(self._draft)
            file_operations.write_local(
                self._draft, msgspec.json.encode(build)
            )  # first: this file has the names of the temporary files
            file_operations.sync([self._draft])
            for place in made:
                file_operations.make_folder(place)
            for target, content in zip(targets, contents, strict=True):
                if content is not None:
                    place = target.path
                    # a missing file has no permissions: looking for those of 20,000 new files takes 0.2 s
                    file_operations.write(target.temporary, content, target.path if target.old else None)
                    written.append(target.temporary)
            place = self._state_folder
            file_operations.sync(written)
            file_operations.replace(self._draft, self._planned)
        except OSError as error:
            raise failure(error, place) from None

    def _discard(self, targets: Sequence[_Target], made: Sequence[Path] = ()) -> None:
        """Remove all temporary files of a build that has changed nothing. Raises OSError."""
        for target in targets:
            file_operations.remove(target.temporary)
        for folder in reversed(made):
            file_operations.remove_folder(folder)
        file_operations.remove(self._draft)

    def _finish(self, build: PlannedBuild, targets: Sequence[_Target]) -> Applied:
        """Change all targets that have not changed yet, and remove all temporary files. Raises OSError."""
        file_operations.sync([self._state_folder])
        others, record = targets[: len(targets) - build.recorded], targets[len(targets) - build.recorded :]
        changed = [(target, target.change()) for target in others]
        # a second time: a process may have written to an old file through an open handle
        not_done = [target.path for target, done in changed if not (done if target.old is None else target.change())]
        for target in record:
            if not_done or not target.change():
                not_done.append(target.path)
        folders = sorted({target.folder for target in targets})
        file_operations.sync([folder for folder in map(Path, folders) if folder.is_dir()])
        notes = []
        message = "it was saved while a build replaced it; the other text is kept as"
        temporary_files = _temporary_files(folders)
        for target in targets if temporary_files else ():
            for kept in target.clear(temporary_files):
                text = f"{message} {shown(kept)}"
                notes.append(Diagnostic(Severity.WARNING, "kept-save", text, shown(target.path)))
        for key in build.emptied:
            file_operations.remove_folder(Path(placed(self._prefix, key)))
        file_operations.remove(self._planned)
        return Applied(tuple(map(Path, not_done)), tuple(notes), {target.path: target.new for target in targets})

    def _missing_folders(self, changes: Iterable[FileChange]) -> list[Path]:
        """The folders to create, outermost first."""
        missing: set[Path] = set()
        files = (str(change.path) for change in changes if change.content is not None)
        for innermost in map(Path, {file.rpartition(os.sep)[0] for file in files}):
            for folder in (innermost, *innermost.parents):
                if folder == self._root or folder in missing or folder.is_dir():
                    break
                missing.add(folder)
        return sorted(missing)

    def _unfinished(self, error: OSError) -> Diagnostic:
        place = Path(error.filename) if isinstance(error.filename, str) else self._state_folder
        message = f"an interrupted build can't be finished: {error.strerror or error}"
        return Diagnostic(Severity.ERROR, "unfinished", message, shown(place), hint="correct this, then build again")

    def _targets(self, build: PlannedBuild) -> list[_Target]:
        """Return the files to change. Raises OutputError for a file outside of the outputs, or a link in a path."""
        trees, targets, folders = [Tree(self._root), *map(Tree, self._outputs)], [], set[str]()
        for number, file in enumerate(build.files):
            path = placed(self._prefix, file.path)
            folder = path.rpartition(os.sep)[0]
            if folder not in folders:  # there are thousands of files
                next((tree for tree in trees if tree.covers(path)), trees[0]).check_folder(folder)
                folders.add(folder)
            temporary = f"{folder}{os.sep}.{build.token}-{number}{TEMPORARY}"
            targets.append(_Target(folder, path, temporary, file.old, file.new, file.is_moved))
        return targets

    def _key(self, path: Path) -> str:
        """A path from the configuration's folder, POSIX."""
        text = str(path)
        key = text[len(self._prefix) :] if text.startswith(self._prefix) else os.path.relpath(path, self._root)
        return key.replace(os.sep, "/")


class _Target(msgspec.Struct, frozen=True):
    """One file to change; `old`, `new` and `is_moved` as in `PlannedFile`."""

    folder: str
    path: str  # strings, since there may be 20,000 targets: their paths take 0.3 s
    temporary: str
    """The name of the new file before the change, and of the old file after the change."""
    old: str | None
    new: str | None
    is_moved: bool

    def change(self) -> bool:
        """Change the target, unless it is changed already.

        Returns False if somebody saved the target meanwhile: the saved file stays. Raises OSError.
        """
        try:
            if self.old is None:
                return self._create()
            return self._delete() if self.new is None else self._replace()
        except (FileNotFoundError, FileExistsError, NotADirectoryError):
            return False  # the file or its folder was deleted, or a new file was saved

    def clear(self, temporary_files: Collection[str]) -> Iterator[str]:
        """Remove files under temporary names.

        Keeps unplanned contents, and a user's text that could not move here, under new names; yields these names.
        `temporary_files` are the paths of all temporary files.
        """
        for path in (self.temporary, file_operations.spare(self.temporary)):
            if path not in temporary_files:
                continue
            current = hash_of(path)
            is_homeless = self.is_moved and current == self.new != hash_of(self.path)
            if current in (self.old, self.new) and not is_homeless:
                file_operations.remove(path)
            elif current is not None:
                for number in itertools.count(1):
                    name = f"{self.path}.saved{'' if number == 1 else number}"
                    with contextlib.suppress(FileExistsError):
                        file_operations.place(path, name)
                        break
                yield name

    def _create(self) -> bool:
        try:
            file_operations.place(self.temporary, self.path)
        except FileNotFoundError:  # it has its place already, or its folder was deleted
            return os.path.lexists(self.path)
        except FileExistsError:
            return hash_of(self.path) == self.new
        return True

    def _delete(self) -> bool:
        aside, current = hash_of(self.temporary), hash_of(self.path)
        if aside is None and current == self.old:
            file_operations.replace(self.path, self.temporary)
            aside = hash_of(self.temporary)
        if aside is None:
            return current is None
        if aside != self.old:
            file_operations.place(self.temporary, self.path)
        return aside == self.old

    def _replace(self) -> bool:
        if os.path.lexists(file_operations.spare(self.temporary)):
            file_operations.exchange(self.temporary, self.path)  # finish an interrupted exchange
        aside, current = hash_of(self.temporary), hash_of(self.path)
        if aside == self.new and current == self.old:
            file_operations.exchange(self.temporary, self.path)
            aside, current = hash_of(self.temporary), self.new
        if aside in (self.new, None):
            return current == self.new
        if aside == self.old:
            return True
        if current == self.new:  # the replaced content is an unplanned save: put it back
            file_operations.exchange(self.temporary, self.path)
            if hash_of(self.temporary) != self.new:  # somebody saved again: the later save counts
                file_operations.exchange(self.temporary, self.path)
        return False


def is_interrupted(state_folder: Path) -> bool:
    """Return whether a build is changing files, or was killed while changing files. Needs no lock."""
    return file_type(state_folder / PLANNED, follow=False) != 0


def save(file: Path, old: bytes, new: bytes) -> None:
    """Replace a file that no build owns; its permissions and symbolic links to it stay.

    Raises OutputError if the file differs from `old`: somebody has saved it, and the saved file stays. Raises OSError.
    """
    path = file.resolve()
    temporary = path.with_name(f".{os.urandom(8).hex()}{TEMPORARY}")
    target = _Target(str(path.parent), str(path), str(temporary), digest(old), digest(new), is_moved=False)
    try:
        file_operations.write(temporary, new, path)
        file_operations.sync([temporary])
    except BaseException:
        file_operations.remove(temporary)
        raise
    try:
        # twice: a process may have written to the old file through an open handle
        is_done = target.change() and target.change()
    finally:
        kept = [*target.clear(_temporary_files([target.folder]))]
    if not is_done:
        message = "somebody saved this file meanwhile: it stays unchanged"
        hint = f"{'an earlier save is kept as ' + shown(kept[0]) + '; ' if kept else ''}run the command again"
        raise OutputError.of("changed-meanwhile", message, shown(file), hint=hint)


def hash_of(path: str | Path) -> str | None:
    """Return the SHA-256 (hex) of a file; None for a missing file, `_OTHER` for any irregular file. Raises OSError."""
    try:
        content = file_operations.read(path)
    except IsADirectoryError:
        return _OTHER
    return None if content is None else digest(content)


def _temporary_files(folders: Iterable[str]) -> set[str]:
    """Return the paths of all temporary files in some folders, including `….urdfsync-tmp~` of three renames."""
    paths = set[str]()
    for folder in folders:
        with contextlib.suppress(FileNotFoundError, NotADirectoryError):
            paths |= {f"{folder}{os.sep}{name}" for name in os.listdir(folder) if TEMPORARY in name}  # noqa: PTH208
    return paths

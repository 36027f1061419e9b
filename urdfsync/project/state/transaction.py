"""Writes a set of files. A kill, a full disk or a save at any moment loses nothing.

There is no journal: after each operation, the files are in a state on which the next build decides as on any other.

1. All new files are written beside their targets under temporary names, and written through to the disk.
2. Bases and copies of replaced texts get their places: each text is known by its base before its file changes.
3. An edited file whose element has another path is renamed: the user's text is always in one visible place.
4. Each target is exchanged with its new file. The old file then has the temporary name. The old file's hash shows
   whether it is the file of the plan. If not, somebody has saved the target meanwhile: the two files are exchanged
   back, and the build stops and plans again.
5. Old places are deleted, the temporary files and empty folders removed. The recorded state comes last.

A temporary name states target, old and new content. So whoever finds such a file after a kill knows whether it is
needed (see `_clear`).
"""

from __future__ import annotations

import contextlib
import itertools
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import msgspec

from urdfsync.common import system
from urdfsync.common.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.common.files import TEMPORARY, Tree, digest, failure, reason, shown
from urdfsync.common.spelling import counted
from urdfsync.project.state import file_operations

UNFINISHED = "unfinished"
"""The code of the error if a build failed after it had changed files."""
_DIGITS = 12
"""The number of digits of the hashes in temporary names: names of files have 255 bytes at most."""
_NONE, _MOVES = "none", "moves"
"""Stand for the hash of no file, and for the new content of a file that was renamed by three renames."""
_NAME = re.compile(
    rf"\A\.(.+)\.([0-9a-f]{{12}}|none)-([0-9a-f]{{12}}|none|moves)\.[0-9a-f]{{6}}m?{re.escape(TEMPORARY)}~?"
)
"""A temporary name: target, old content, new content, random digits; `m` if the old content comes from a renaming that
is made later, `~` is of three renames."""
SAVED = ".saved"
"""The end of the name under which a content is kept that nobody planned."""
_OTHER = "no regular file"
"""Stands for the hash of a folder, a link or a device."""


class FileChange(msgspec.Struct, frozen=True):
    """A planned change of one file."""

    path: Path
    content: bytes | None
    """The new content; None to delete the file."""
    old: str | None
    """SHA-256 (hex) of the bytes at the time of the plan; None if there was no file."""
    origin: Path | None = None
    """The present path of the user's text that `content` is made of, if the text moves here."""


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


class Applied(NamedTuple):
    """The outcome of a transaction."""

    overtaken: Path | None
    """The target that somebody saved meanwhile: it stays, and so do all later targets. None if all have changed."""
    diagnostics: tuple[Diagnostic, ...]
    written: Mapping[str, str | None]
    """The hash of each target by path; None for a deleted file."""


class Transactions:
    """Writes all files of one configuration. Only the holder of the build lock may use it."""

    def __init__(self, root: Path, outputs: Iterable[Path] = ()) -> None:
        """`root` is the configuration's folder; files in `outputs` may be written, too."""
        self._root, self._outputs = root, tuple(outputs)

    def apply(self, writes: Writes, emptied: Sequence[Path] = ()) -> Applied:
        """Make all changes.

        `emptied` are folders to remove if they are empty afterwards, innermost first. Raises OutputError if a file
        can't be written; its code is UNFINISHED if some files have changed.
        """
        changes = writes.in_order()
        moves, targets = _plan(changes)
        first, last = sum(one.content is not None for one in writes.before), len(targets) - len(writes.record)
        folders, notes = {target.folder for target in targets}, list[Diagnostic]()
        self._check(folders)
        made = self._missing_folders(changes)
        try:
            system.check_unheld(target.path for target in targets if target.old)
            _prepare(targets, changes, made)
            overtaken = _first_saved(one for one in targets[:first] if not one.change())
            if overtaken is None:
                _sync_folders({target.folder for target in targets[:first]})
                steps: list[_Move | _Target] = [*moves, *targets[first:last]]
                overtaken = _first_saved(one for one in steps if not one.change())
            if overtaken is None:  # a process may have written to an old file through an open handle
                overtaken = _first_saved(one for one in targets[:last] if one.old and not one.has_old())
            _sync_folders(folders)
            notes += _clear_own((*moves, *targets[:last]), emptied)
            if overtaken is None:
                overtaken = _first_saved(one for one in targets[last:] if not one.change())
                _sync_folders({target.folder for target in targets[last:]})
            notes += _clear_own(targets[last:], (*emptied, *reversed(made)))
        except BaseException as error:
            with contextlib.suppress(OSError):  # else the next build clears them
                _clear_own((*moves, *targets), reversed(made))
            if not isinstance(error, OSError):
                raise
            folder, name = os.path.split(error.filename if isinstance(error.filename, str) else self._root)
            place = Path(folder, _NAME.sub(r"\1", name))
            done = sum(_hash(one.path) == one.new for one in targets) + sum(move.is_done() for move in moves)
            if not done:
                raise failure(error, place) from None
            message = f"{done} of {counted(len(targets), 'file')} are written, then: {reason(error)}"
            hint = "correct this, then build again: the next build writes the rest"
            raise OutputError.of(UNFINISHED, message, shown(place), hint=hint) from error
        return Applied(overtaken, tuple(notes), {target.path: target.new for target in targets})

    def clear(self, leftovers: Iterable[str]) -> tuple[Diagnostic, ...]:
        """Remove what a killed build left, and folders that are empty then; return warnings about what is kept.

        Raises OutputError.
        """
        paths = sorted(leftovers)
        folders = {path.rpartition(os.sep)[0] for path in paths}
        self._check(folders)
        try:
            return _clear_all(paths, {*map(Path, folders)} - {self._root, *self._outputs})
        except OSError as error:
            raise failure(error, error.filename or self._root) from None

    def _check(self, folders: Iterable[str]) -> None:
        """Raise OutputError for a folder outside of the outputs, or a link in a path."""
        trees = [Tree(self._root), *map(Tree, self._outputs)]
        for folder in map(os.path.normpath, folders):
            covering = (tree for tree in trees if str(tree.root) == folder or tree.covers(folder))
            tree = next(covering, trees[0])
            if str(tree.root) != folder:
                tree.check_folder(folder)

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


class _Target(msgspec.Struct, frozen=True):
    """One file to change; `old` and `new` are hashes, None for no file."""

    path: str  # strings, since there may be 20,000 targets: their paths take 0.3 s
    temporary: str
    """The name of the new file before the change, and of the old file after the change."""
    old: str | None
    new: str | None

    @property
    def folder(self) -> str:
        """The folder of the file."""
        return self.path.rpartition(os.sep)[0]

    def change(self) -> bool:
        """Change the target. Returns False if somebody saved it meanwhile: the saved file stays. Raises OSError."""
        try:
            if self.old is None:
                if self.new is None:
                    return not os.path.lexists(self.path)
                file_operations.place(self.temporary, self.path)
                return True
            if _hash(self.path) != self.old:
                return False
            if self.new is None:
                file_operations.replace(self.path, self.temporary)
            else:
                file_operations.exchange(self.temporary, self.path)
        except (FileNotFoundError, FileExistsError, NotADirectoryError):
            return False  # the file or its folder was deleted, or a new file was saved
        return self.has_old()

    def has_old(self) -> bool:
        """Return whether the replaced file is the planned one; else it is a save, and takes its place again."""
        if _hash(self.temporary) == self.old:
            return True
        with contextlib.suppress(FileNotFoundError, FileExistsError):
            if self.new is None:
                file_operations.place(self.temporary, self.path)
            elif _hash(self.path) == self.new:
                file_operations.exchange(self.temporary, self.path)
                if _hash(self.temporary) != self.new:  # somebody saved again: the later save counts
                    file_operations.exchange(self.temporary, self.path)
        return False


class _Move(msgspec.Struct, frozen=True):
    """A renaming of an edited file, before the file gets its new text; what is at the new path goes to the old one."""

    source: str
    path: str
    temporary: str
    """The third name of an exchange by three renames, without its end."""
    text: str
    """The hash of the edited file."""
    other: str | None
    """The hash of the file at the new path."""

    def change(self) -> bool:
        """Rename the file. Returns False, and changes nothing, if somebody saved one of the two. Raises OSError."""
        with contextlib.suppress(FileNotFoundError, FileExistsError, NotADirectoryError):
            self._rename(self.source, self.path)
            if not self.is_done():
                self._rename(self.path, self.source)
        return self.is_done()

    def is_done(self) -> bool:
        """Return whether each file has the path of the other one."""
        return (_hash(self.path), _hash(self.source)) == (self.text, self.other)

    def _rename(self, source: str, path: str) -> None:
        if self.other is None:
            file_operations.place(source, path)
        else:
            file_operations.exchange(source, path, file_operations.spare(self.temporary))


def find_leftovers(folders: Iterable[str | Path]) -> list[str]:
    """Return the temporary files in these folders, of a build that is writing or was killed. Needs no lock."""
    found = list[str]()
    for folder in folders:
        with contextlib.suppress(OSError), os.scandir(folder) as entries:
            found += (one.path for one in entries if _NAME.fullmatch(one.name) and one.is_file(follow_symlinks=False))
    return sorted(found)


def save(file: Path, old: bytes, new: bytes) -> None:
    """Replace a file that no build owns; its permissions and symbolic links to it stay.

    Raises OutputError if the file differs from `old`: somebody has saved it, and the saved file stays. Raises OSError.
    """
    change = FileChange(file.resolve(), new, digest(old))
    _, (target,) = _plan([change])
    try:
        _prepare([target], [change], ())
        # again: a process may have written to the old file through an open handle
        is_done = target.change() and target.has_old()
    finally:
        names = target.temporary, file_operations.spare(target.temporary)
        kept = [*filter(None, map(_clear, filter(os.path.lexists, names)))]
    if not is_done:
        message = "somebody saved this file meanwhile: it stays unchanged"
        hint = f"{'an earlier save is kept as ' + shown(kept[0]) + '; ' if kept else ''}run the command again"
        raise OutputError.of("changed-meanwhile", message, shown(file), hint=hint)


def _plan(changes: Sequence[FileChange]) -> tuple[list[_Move], list[_Target]]:
    """Return the renamings of edited files, and all targets as they are after the renamings."""
    token, moves = os.urandom(3).hex(), list[_Move]()
    old = {str(change.path): change.old for change in changes}
    sources = {str(change.path): str(change.origin) for change in changes if change.origin}
    for path in sources:
        source = sources[path]
        if source == path or not (text := old.get(source)) or _device(source) != _device(path):
            continue
        moves.append(_Move(source, path, _temporary(path, old[path], _MOVES, token), text, old[path]))
        old[source], old[path] = old[path], text
        sources.update((other, source) for other, place in sources.items() if place == path)
    targets, moved = list[_Target](), {path for move in moves for path in (move.source, move.path)}
    for change in changes:
        path, new = str(change.path), None if change.content is None else digest(change.content)
        temporary = _temporary(path, old[path], new, f"{token}m" if path in moved else token)
        targets.append(_Target(path, temporary, old[path], new))
    return moves, targets


def _temporary(path: str, old: str | None, new: str | None, token: str) -> str:
    folder, _, name = path.rpartition(os.sep)
    return f"{folder}{os.sep}.{name}.{(old or _NONE)[:_DIGITS]}-{(new or _NONE)[:_DIGITS]}.{token}{TEMPORARY}"


def _device(path: str) -> int:
    """Return the number of the file system on which the folder of a file is, or will be made."""
    return next(folder for folder in Path(path).parents if folder.is_dir()).stat().st_dev


def _prepare(targets: Sequence[_Target], changes: Sequence[FileChange], made: Iterable[Path]) -> None:
    """Write all new files under temporary names. Raises OSError."""
    for folder in made:
        file_operations.make_folder(folder)
    for target, change in zip(targets, changes, strict=True):
        if change.content is not None:
            try:
                # a missing file has no permissions: looking for those of 20,000 new files takes 0.2 s
                file_operations.write(target.temporary, change.content, target.path if target.old else None)
            except OSError as error:
                error.filename = target.path  # a full disk names no file
                raise
    file_operations.sync([target.temporary for target in targets if target.new])


def _first_saved(overtaken: Iterable[_Move | _Target]) -> Path | None:
    return next((Path(one.path) for one in overtaken), None)


def _clear_own(files: Iterable[_Move | _Target], folders: Iterable[Path]) -> tuple[Diagnostic, ...]:
    own = {f"{one.temporary}{end}" for one in files for end in ("", file_operations.SPARE)}
    return _clear_all(own.intersection(find_leftovers({path.rpartition(os.sep)[0] for path in own})), folders)


def _clear_all(paths: Iterable[str], folders: Iterable[Path]) -> tuple[Diagnostic, ...]:
    """Clear temporary files, and remove these folders if they are empty, in this order. Raises OSError."""
    notes = list[Diagnostic]()
    for kept in filter(None, map(_clear, sorted(paths))):
        message = f"it was saved while a build replaced it; the other text is kept as {shown(kept)}"
        notes.append(Diagnostic(Severity.WARNING, "kept-save", message, shown(kept.rpartition(SAVED)[0])))
    for folder in folders:
        file_operations.remove_folder(folder)
    return tuple(notes)


def _clear(path: str) -> str | None:
    """Remove a temporary file if its name explains its content; else keep the content, and return its new name."""
    folder, _, name = path.rpartition(os.sep)
    target, old, new = _NAME.sub(r"\1/\2/\3", name).split("/")
    target, is_spare = f"{folder}{os.sep}{target}", path.endswith(file_operations.SPARE)
    content, present = ((_hash(file) or "")[:_DIGITS] or _NONE for file in (path, target))
    # if two of three renames are missing; a text that moves unchanged is still at its old path, too
    if present == _NONE != new and (is_spare or content == old != new):
        file_operations.place(path, target)
        return None
    # a new file never held anything else; until an exchange, this one holds at most half of the new content
    is_before = present == old or (name.partition(TEMPORARY)[0].endswith("m") and present != new)
    is_own = old == _NONE or (is_before and new not in (_NONE, _MOVES))
    if new != _MOVES and (content in (old, new) or is_own):
        file_operations.remove(path)
        return None
    for number in itertools.count(1):
        saved = f"{target}{SAVED}{'' if number == 1 else number}"
        with contextlib.suppress(FileExistsError):
            file_operations.place(path, saved)
            break
    return saved


def _sync_folders(folders: Iterable[str]) -> None:
    file_operations.sync([folder for folder in sorted(folders) if os.path.isdir(folder)])  # noqa: PTH112 - strings


def _hash(path: str) -> str | None:
    """Return the SHA-256 (hex) of a file; None for a missing, `_OTHER` for any irregular file. Raises OSError."""
    try:
        content = file_operations.read(path)
    except IsADirectoryError:
        return _OTHER
    return None if content is None else digest(content)

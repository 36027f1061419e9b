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

import collections
import contextlib
import itertools
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import msgspec

from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.files import TEMPORARY, Tree, digest, failure, shown
from urdfsync.spelling import counted
from urdfsync.state import file_operations

UNFINISHED = "unfinished"
"""The code of the error if a build failed after it had changed files."""
_DIGITS = 12
"""The number of digits of the hashes in temporary names: names of files have 255 bytes at most."""
_NONE, _MOVES = "none", "moves"
"""Stand for the hash of no file, and for the new content of a file that was renamed by three renames."""
_NAME = re.compile(rf"\.(.+)\.([0-9a-f]{{12}}|none)-([0-9a-f]{{12}}|none|moves)\.[0-9a-f]{{6}}{re.escape(TEMPORARY)}~?")
"""A temporary name: target, old content, new content, random digits; `~` is of three renames."""
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

    def apply(self, writes: Writes, emptied: Iterable[Path] = ()) -> Applied:
        """Make all changes.

        `emptied` are folders to remove if they are empty afterwards, innermost first. Raises OutputError if a file
        can't be written; its code is UNFINISHED if some files have changed.
        """
        changes = writes.in_order()
        moves, targets = _plan(changes)
        folders = self._check({target.folder for target in targets})
        made = self._missing_folders(changes)
        _prepare(targets, changes, made)
        first, last = sum(one.content is not None for one in writes.before), len(targets) - len(writes.record)
        # again: a process may have written to an old file through an open handle
        again = collections.deque(target for target in targets[:last] if target.old is not None)
        before, record = collections.deque(targets[:first]), collections.deque(targets[last:])
        files = collections.deque((*moves, *targets[first:last]))
        total, notes = len(before) + len(files), list[Diagnostic]()

        def clear(files: Iterable[_Move | _Target]) -> None:
            own = {f"{one.temporary}{end}" for one in files for end in ("", file_operations.SPARE)}
            notes.extend(self.clear(own.intersection(find_leftovers(folders))))

        def finish() -> Applied:
            overtaken = _change(before)
            if overtaken is None:
                _sync_folders({target.folder for target in targets[:first]})
                overtaken = _change(files) or _change(again)
            clear((*moves, *targets[:last]))
            if overtaken is None:
                for folder in emptied:
                    file_operations.remove_folder(folder)
                _sync_folders(folders)
                overtaken = _change(record)
                _sync_folders({target.folder for target in targets[last:]})
            clear(targets[last:])
            return Applied(overtaken, tuple(notes), {target.path: target.new_sha256 for target in targets})

        try:
            return finish()
        except OSError as error:
            with contextlib.suppress(OSError, OutputError):
                clear((*moves, *targets))  # else the next build does
            place = error.filename if isinstance(error.filename, str) else self._root
            if (done := total - len(before) - len(files)) == 0:
                for folder in reversed(made):
                    file_operations.remove_folder(folder)
                raise failure(error, place) from None
            message = f"{done} of {counted(total, 'file')} are written, then: {error.strerror or error}"
            hint = "correct this, then build again: the next build writes the rest"
            raise OutputError.of(UNFINISHED, message, shown(place), hint=hint) from error
        except BaseException:
            with contextlib.suppress(OSError):
                finish()  # also after Ctrl-C: this takes milliseconds
            raise

    def clear(self, leftovers: Iterable[str]) -> tuple[Diagnostic, ...]:
        """Remove temporary files that nobody needs; return warnings about contents that are kept. Raises OutputError."""
        paths, notes = sorted(leftovers), list[Diagnostic]()
        self._check({path.rpartition(os.sep)[0] for path in paths})
        for path in paths:
            try:
                kept = _clear(path)
            except OSError as error:
                raise failure(error, path, "it can't be removed") from None
            if kept is not None:
                message = f"it was saved while a build replaced it; the other text is kept as {shown(kept.saved)}"
                notes.append(Diagnostic(Severity.WARNING, "kept-save", message, shown(kept.target)))
        return tuple(notes)

    def _check(self, folders: Iterable[str]) -> list[str]:
        """Return the sorted folders. Raises OutputError for a folder outside of the outputs, or a link in a path."""
        trees = [Tree(self._root), *map(Tree, self._outputs)]
        for folder in map(os.path.normpath, found := sorted(folders)):
            if folder != str(self._root):
                next((tree for tree in trees if tree.covers(os.path.join(folder, ""))), trees[0]).check_folder(folder)
        return found

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


class _Kept(NamedTuple):
    """A content that was found under a temporary name, and is kept under a visible one."""

    target: str
    saved: str


class _Target(msgspec.Struct, frozen=True):
    """One file to change. Hashes have their first digits; None stands for no file."""

    path: str  # strings, since there may be 20,000 targets: their paths take 0.3 s
    temporary: str
    """The name of the new file before the change, and of the old file after the change."""
    old: str | None
    new_sha256: str | None

    @property
    def folder(self) -> str:
        """The target's folder."""
        return self.path.rpartition(os.sep)[0]

    @property
    def new(self) -> str | None:
        """The hash of the new content."""
        return _first_digits(self.new_sha256)

    def change(self) -> bool:
        """Change the target, unless it is changed already.

        Returns False if somebody saved the target meanwhile: the saved file stays. Raises OSError.
        """
        try:
            if self.old is None:
                return self._create() if self.new else not os.path.lexists(self.path)
            return self._delete() if self.new is None else self._replace()
        except (FileNotFoundError, FileExistsError, NotADirectoryError):
            return False  # the file or its folder was deleted, or a new file was saved

    def _create(self) -> bool:
        try:
            file_operations.place(self.temporary, self.path)
        except FileNotFoundError:  # it has its place already, or its folder was deleted
            return os.path.lexists(self.path)
        except FileExistsError:
            return _hash(self.path) == self.new
        return True

    def _delete(self) -> bool:
        aside, current = _hash(self.temporary), _hash(self.path)
        if aside is None and current == self.old:
            file_operations.replace(self.path, self.temporary)
            aside = _hash(self.temporary)
        if aside is None:
            return current is None
        if aside != self.old:
            file_operations.place(self.temporary, self.path)
        return aside == self.old

    def _replace(self) -> bool:
        if os.path.lexists(file_operations.spare(self.temporary)):
            file_operations.exchange(self.temporary, self.path)  # finish an interrupted exchange
        aside, current = _hash(self.temporary), _hash(self.path)
        if aside == self.new and current == self.old:
            file_operations.exchange(self.temporary, self.path)
            aside, current = _hash(self.temporary), self.new
        if aside in (self.new, None):
            return current == self.new
        if aside == self.old:
            return True
        if current == self.new:  # the replaced content is an unplanned save: put it back
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
        """Rename the file, unless it is renamed already. Returns False, and changes nothing, if somebody saved one."""
        try:
            if self._is_done():
                return True
            self._rename(self.source, self.path)
            if not self._is_done():
                self._rename(self.path, self.source)
        except (FileNotFoundError, FileExistsError, NotADirectoryError):
            return False
        return self._is_done()

    def _is_done(self) -> bool:
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
        file_operations.write(target.temporary, new, target.path)
        file_operations.sync([target.temporary])
    except BaseException:
        file_operations.remove(target.temporary)
        raise
    try:
        # twice: a process may have written to the old file through an open handle
        is_done = target.change() and target.change()
    finally:
        names = target.temporary, file_operations.spare(target.temporary)
        kept = [*filter(None, map(_clear, filter(os.path.lexists, names)))]
    if not is_done:
        message = "somebody saved this file meanwhile: it stays unchanged"
        hint = f"{'an earlier save is kept as ' + shown(kept[0].saved) + '; ' if kept else ''}run the command again"
        raise OutputError.of("changed-meanwhile", message, shown(file), hint=hint)


def _plan(changes: Iterable[FileChange]) -> tuple[list[_Move], list[_Target]]:
    """Return the renamings of edited files, and all targets as they are after the renamings."""
    token, changes = os.urandom(3).hex(), [*changes]
    old = {str(change.path): _first_digits(change.old) for change in changes}
    sources, moves = {str(change.path): str(change.origin) for change in changes if change.origin}, list[_Move]()
    for path in sources:
        source = sources[path]
        if not (old.get(source) and _device(source) == _device(path)) or source == path:
            continue
        moves.append(_Move(source, path, _temporary(path, old[path], _MOVES, token), old[source] or "", old[path]))
        old[source], old[path] = old[path], old[source]
        sources.update((other, source) for other, place in sources.items() if place == path)
    targets = list[_Target]()
    for change in changes:
        path, new = str(change.path), None if change.content is None else digest(change.content)
        temporary = _temporary(path, old[path], _first_digits(new), token)
        targets.append(_Target(path, temporary, old[path], new))
    return moves, targets


def _temporary(path: str, old: str | None, new: str | None, token: str) -> str:
    folder, _, name = path.rpartition(os.sep)
    return f"{folder}{os.sep}.{name}.{old or _NONE}-{new or _NONE}.{token}{TEMPORARY}"


def _device(path: str) -> int:
    """Return the number of the file system on which the folder of a file is, or will be made."""
    while not os.path.isdir(path):
        path = os.path.dirname(path)
    return os.stat(path).st_dev


def _prepare(targets: Sequence[_Target], changes: Sequence[FileChange], made: Sequence[Path]) -> None:
    """Write all new files under temporary names. Raises OutputError; then nothing has changed."""
    written, place = list[str](), ""
    try:
        for folder in made:
            place = str(folder)
            file_operations.make_folder(folder)
        for target, change in zip(targets, changes, strict=True):
            if change.content is not None:
                place = target.path
                written.append(target.temporary)
                # a missing file has no permissions: looking for those of 20,000 new files takes 0.2 s
                file_operations.write(target.temporary, change.content, target.path if target.old else None)
        file_operations.sync(written)
    except BaseException as error:
        with contextlib.suppress(OSError):  # the next build removes them
            for path in written:
                file_operations.remove(path)
        for folder in reversed(made):
            file_operations.remove_folder(folder)
        if isinstance(error, OSError):
            raise failure(error, place) from None
        raise


def _change(pending: collections.deque[_Target] | collections.deque[_Move | _Target]) -> Path | None:
    """Change these files in order; return the first one that somebody saved meanwhile. Raises OSError."""
    while pending:
        if not pending[0].change():
            return Path(pending[0].path)
        pending.popleft()
    return None


def _clear(path: str) -> _Kept | None:
    """Remove a temporary file if its name explains its content; else keep the content under a new name."""
    folder, _, name = path.rpartition(os.sep)
    match = _NAME.fullmatch(name)
    assert match
    target, old, new = f"{folder}{os.sep}{match[1]}", match[2], match[3]
    content, present = _hash(path), _hash(target)
    is_spare = path.endswith(file_operations.SPARE)
    if present is None and new != _NONE and (content == old or is_spare):  # two of three renames are missing
        file_operations.place(path, target)
        return None
    # a new file never held anything else; until an exchange, this one holds at most half of the new content
    is_own = old == _NONE or (present == old and new not in (_NONE, _MOVES))
    if new != _MOVES and (content in (old, new) or is_own):
        file_operations.remove(path)
        return None
    for number in itertools.count(1):
        saved = f"{target}.saved{'' if number == 1 else number}"
        with contextlib.suppress(FileExistsError):
            file_operations.place(path, saved)
            break
    return _Kept(target, saved)


def _sync_folders(folders: Iterable[str]) -> None:
    if existing := [*filter(os.path.isdir, sorted(folders))]:
        file_operations.sync(existing)


def _first_digits(sha256: str | None) -> str | None:
    return sha256 and sha256[:_DIGITS]


def _hash(path: str) -> str | None:
    """Return the hash of a file; None for a missing file, `_OTHER` for any irregular file. Raises OSError."""
    try:
        content = file_operations.read(path)
    except IsADirectoryError:
        return _OTHER
    return None if content is None else _first_digits(digest(content))

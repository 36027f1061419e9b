"""One batch of writes on disk: its temporary files, the changes one by one, the way back, and its traces.

In the state folder, `journal/<phase>.json` says what the batch is, and `undo/<number>` is what stood
in the place of a target. In which phase a batch is, only the disk says: it can be asked at any time,
by the process that writes or by the next one.

A temporary file that replaces another file stands in `undo/`, where nobody watches what comes and goes, and
a new file beside its target: it gets what the folder hands on to new files. Beside their targets stand also
those that can't be moved there from `undo/`, or would be another file then. Only the disk says where a temporary
file is: in `undo/` if there is one, else beside the target.
"""

from __future__ import annotations

import contextlib
import functools
import os
import stat
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

from urdfsync.dependencies import list_folder
from urdfsync.files import TEMPORARY, digest, failure
from urdfsync.state import operations
from urdfsync.state.journal import MAY_BE_APART, Journal, Phase, Step

_OTHER = "no regular file"
"""Stands for the hash of a folder, a link or a device."""


class SavedError(Exception):
    """Somebody else changed a target after it was planned; nothing of that is lost."""

    def __init__(self, path: str) -> None:
        super().__init__(path)
        self.path = Path(path)


class Batch:
    """The files of one journal; `root` is the configuration's folder, `folder` the state folder."""

    def __init__(
        self, root: Path, folder: Path, journal: Journal, shown: Callable[[Path], str], resumed: bool = False
    ) -> None:
        """`resumed` stands for a batch that another run has begun."""
        self._root, self._folder, self._shown = root, str(folder), shown
        self.journal, self._resumed = journal, resumed
        self._targets = [self._path(step.path) for step in journal.steps]
        self._target_folders = sorted(set(map(os.path.dirname, self._targets)))
        names = [f".{journal.token}-{number}{TEMPORARY}" for number in range(len(self._targets))]
        self._beside = [f"{os.path.dirname(t)}{os.sep}{name}" for t, name in zip(self._targets, names, strict=True)]
        self._undo_folder = f"{folder}{os.sep}undo"
        self._undo = {
            number: f"{self._undo_folder}{os.sep}{number}"
            for number, step in enumerate(journal.steps)
            if step.old is not None
        }
        """What stood in the place of targets."""
        self._apart = {
            number: f"{self._undo_folder}{os.sep}{names[number]}"
            for number, step in enumerate(journal.steps)
            if step.old is not None and step.new is not None and journal.format >= MAY_BE_APART
        }
        """Where temporary files may stand that replace another file."""
        self._temporaries = list(self._beside)
        if resumed:
            self._find_temporaries()
        self._spent: set[int] = set()
        """The targets that have changed, so that their temporary files are gone."""
        self._hashed: dict[int, tuple[int, ...] | None] = {}
        """What the system said of targets before they were hashed."""

    @property
    def targets(self) -> Sequence[Path]:
        """The files that change, in the order of the steps."""
        return list(map(Path, self._targets))

    @property
    def folders(self) -> Sequence[Path]:
        """The folders that come or go."""
        return [Path(self._path(path)) for path in (*self.journal.made, *self.journal.emptied)]

    def prepare(self, contents: Iterable[bytes | None]) -> None:
        """Write the journal and all temporary files. Raises OutputError; no target has changed then."""
        for folder in (self._folder, os.path.dirname(self._file(Phase.PREPARE)), self._undo_folder):
            with self._about(folder):
                operations.make_folder(folder)
        first = self._file(Phase.PREPARE)
        with self._about(first):
            operations.write(first, self.journal.dumps())
        for path in self.journal.made:
            with self._about(self._path(path)):
                operations.make_folder(self._path(path))
        self._choose_places()
        written = [first]
        for number, content in enumerate(contents):
            if content is not None:
                temporary, target = self._temporaries[number], self._targets[number]
                with self._about(target if temporary is self._beside[number] else self._undo_folder):
                    operations.write(temporary, content, target if self._step(number).old is not None else None)
                written.append(temporary)
        with self._about(self._folder):
            operations.sync(written)

    def apply(self) -> None:
        """Change the targets, the last one when all others are as they should be.

        Raises SavedError if somebody else changed a target, OutputError if it can't be done.
        """
        self._enter(Phase.APPLY)
        *others, last = range(len(self._targets))
        for number in others:
            self._change(number)
        for number in others:
            self._check_kept(number)
        self._change(last)
        self._check_kept(last)
        with self._about(self._folder):
            operations.sync([folder for folder in self._target_folders if os.path.isdir(folder)])
        self._enter(Phase.DONE)

    def can_be_finished(self) -> bool:
        """Whether every target has changed or still can, as it was planned."""
        return all(self._is_sound(number) for number in range(len(self._targets)))

    def put_back(self) -> None:
        """Change the targets back, as far as nobody else has changed them since. Raises OSError or OutputError."""
        self._enter(Phase.UNDO)
        for number in reversed(range(len(self._targets))):
            target, step, temporary = self._targets[number], self._step(number), self._temporaries[number]
            theirs = self._hash(temporary) not in (None, step.new, step.old)  # taken away by a run that was killed then
            source = temporary if theirs else self._undo.get(number)
            current = self._hash(target)
            if source and current is None and (theirs or step.new is None):
                with contextlib.suppress(FileNotFoundError, FileExistsError):
                    operations.place(source, target)
            elif source and current == step.new and os.path.lexists(source):
                self._swap(source, target, functools.partial(self._has, step.new))
            elif current == step.new and step.old is None:
                self._take(target, temporary, step.new)

    def discard(self) -> None:
        """Remove all traces of a batch that did not happen. Raises OSError if that can't be done."""
        for number in range(len(self._targets)):
            self._remove_temporaries(number)
        for path in reversed(self.journal.made):
            operations.remove_folder(self._path(path))
        self._remove_traces()

    def tidy(self) -> None:
        """Remove all traces of a batch that is done, and the folders it has emptied. Raises OSError if it can't."""
        for number in range(len(self._targets)):
            if number not in self._spent:
                self._remove_temporaries(number)
        for path in self.journal.emptied:
            operations.remove_folder(self._path(path))
        self._remove_traces()

    def _find_temporaries(self) -> None:
        """See where another run has left them."""
        for number, apart in self._apart.items():
            if os.path.lexists(apart):
                self._temporaries[number] = apart

    def _choose_places(self) -> None:
        """Let temporary files stand apart wherever they become what they would be beside their targets."""
        alike: dict[str, bool] = {}
        for number, apart in self._apart.items():
            folder = os.path.dirname(self._targets[number])
            if folder not in alike:
                alike[folder] = operations.makes_alike(self._undo_folder, folder)
            if alike[folder]:
                self._temporaries[number] = apart
            else:
                operations.remove(apart)  # of a run whose journal was deleted: it would count as ours

    def _bring_beside(self, folder: str) -> None:
        """Copy temporary files to a folder to which they can't be moved; until all copies are complete, they count."""
        found = [n for n, apart in self._apart.items() if self._temporaries[n] == apart and n not in self._spent]
        found = [number for number in found if os.path.dirname(self._targets[number]) == folder]
        for number in found:
            operations.write(self._beside[number], operations.read(self._apart[number]), self._targets[number])
        if found:
            operations.sync([self._beside[number] for number in found])
        for number in found:
            operations.remove(self._apart[number])
            self._temporaries[number] = self._beside[number]

    def _remove_temporaries(self, number: int) -> None:
        operations.remove(self._beside[number])
        if number in self._apart:
            operations.remove(self._apart[number])

    def _remove_traces(self) -> None:
        for undo in self._undo.values():
            operations.remove(undo)
        if phase := find_phase(self._folder):
            operations.remove(self._file(phase))

    def _change(self, number: int) -> None:
        target, step, temporary = self._targets[number], self._step(number), self._temporaries[number]
        with self._about(target):
            if step.old is None and self._place_new(number):
                return
            self._hashed[number] = _identity(target)
            current = self._hash(target)
            if current == step.new or (self._resumed and current != step.old and self._hash(temporary) != step.new):
                return  # done by the run that was killed; it may have been edited since
            if current != step.old:
                raise SavedError(target)
            try:
                if step.old is None or not self._replace(number):
                    raise SavedError(target)
                self._spent.add(number)
            except (FileNotFoundError, FileExistsError) as error:
                raise SavedError(target) from error

    def _place_new(self, number: int) -> bool:
        """Give a new file its name. Returns False if the name is not free, or something else is in the way."""
        try:
            operations.place(self._temporaries[number], self._targets[number])
        except (FileNotFoundError, FileExistsError):
            return False
        self._spent.add(number)
        return True

    def _replace(self, number: int) -> bool:
        """Change one target. Returns False, and leaves it alone, if it is not what was planned with."""
        target, step = self._targets[number], self._step(number)
        moves = operations.keep(target, self._undo[number])
        if not self._is_old(number, self._undo[number]):
            return False
        if step.new is None:
            return self._take(target, self._temporaries[number], step.old)
        if not moves:
            self._bring_beside(os.path.dirname(target))
        return self._swap(self._temporaries[number], target, functools.partial(self._is_old, number))

    def _is_old(self, number: int, path: str) -> bool:
        """Whether a file is what the target was when it was hashed; what is written to it, `_check_kept` will see."""
        found = _identity(path)
        return found is not None and (found == self._hashed[number] or self._hash(path) == self._step(number).old)

    def _swap(self, source: str, target: str, is_expected: Callable[[str], bool]) -> bool:
        """Put a file in the place of another. Returns False, and leaves both, if the other is not as expected.

        Where files can't be swapped, a save within the microseconds after the last look is lost.
        """
        if not operations.exchange(source, target):
            if not is_expected(target):
                return False
            operations.replace(source, target)
            return True
        if not is_expected(source):
            operations.exchange(source, target)
            return False
        operations.remove(source)
        return True

    def _take(self, target: str, aside: str, expected: str | None) -> bool:
        """Remove a file by way of another name. Returns False, and leaves it, if it is not as expected."""
        operations.replace(target, aside)
        if self._hash(aside) != expected:
            operations.place(aside, target)
            return False
        operations.remove(aside)
        return True

    def _check_kept(self, number: int) -> None:
        """Make sure that nobody has written to the old file while the new one took its place."""
        if number in self._undo and self._hash(self._undo[number]) not in (None, self._step(number).old):
            raise SavedError(self._targets[number])

    def _is_sound(self, number: int) -> bool:
        step, current = self._step(number), self._hash(self._targets[number])
        temporary = self._hash(self._temporaries[number])
        undo = self._hash(self._undo[number]) if number in self._undo else None
        kept = (undo, temporary if temporary != step.new else None)
        if any(found not in (None, step.old) for found in kept):
            return False  # somebody saved in the instant of the change
        if current == step.new:
            return True
        if current == step.old:
            return step.new is None or temporary == step.new
        edited = current is not None and current != _OTHER
        return edited and step.new is not None and temporary != step.new

    def _enter(self, phase: Phase) -> None:
        """Rename the journal, unless it has the phase's name already."""
        target = self._file(phase)
        now = find_phase(self._folder)
        if now is None or now is phase:
            return
        with self._about(target):
            operations.replace(self._file(now), target)
            if phase is Phase.APPLY:
                operations.sync([os.path.dirname(target)])

    def _hash(self, path: str) -> str | None:
        try:
            if not stat.S_ISREG(os.lstat(path).st_mode):
                return _OTHER
            return digest(operations.read(path))
        except (FileNotFoundError, NotADirectoryError):
            return None

    def _has(self, expected: str | None, path: str) -> bool:
        return self._hash(path) == expected

    def _step(self, number: int) -> Step:
        return self.journal.steps[number]

    def _path(self, path: str) -> str:
        """Where a path of the journal leads."""
        return os.path.normpath(os.path.join(self._root, path))

    def _file(self, phase: Phase) -> str:
        return f"{self._folder}{os.sep}journal{os.sep}{phase}.json"

    @contextlib.contextmanager
    def _about(self, path: str) -> Iterator[None]:
        """Turn what the system says into an error about a file."""
        try:
            yield
        except OSError as error:
            raise failure(error, self._shown(Path(path))) from None


def _identity(path: str) -> tuple[int, ...] | None:
    """What tells a file from another one, by whatever name; None if there is none."""
    try:
        status = os.lstat(path)
    except (FileNotFoundError, NotADirectoryError):
        return None
    return status.st_mode, status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns


def find_phase(folder: operations.AnyPath) -> Phase | None:
    """The phase of the batch that a state folder has, None if it has none."""
    try:
        names = list_folder(f"{os.fspath(folder)}{os.sep}journal")
    except (FileNotFoundError, NotADirectoryError):
        return None
    return next((phase for phase in reversed(Phase) if f"{phase}.json" in names), None)

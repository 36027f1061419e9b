"""What a compiler is given for one robot: versions of its package in folders, and the libraries that they need."""

from __future__ import annotations

import contextlib
import hashlib
import os
import tempfile
import threading
import time
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import msgspec

from urdfsync.checking import workspace
from urdfsync.checking.cache import LOCK, Cache, CacheError, writing
from urdfsync.checking.libraries import dependencies, library, references, slim
from urdfsync.checking.libraries.dependencies import Dependencies
from urdfsync.checking.libraries.library import LibraryError, StandardLibrary
from urdfsync.checking.subject import Subject
from urdfsync.config import Config, RobotConfig, library_folder
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.modelica.names import LIBRARY
from urdfsync.state.lock import Lock, LockedError

ATTEMPTS = 2
"""So often a version is loaded if somebody deletes it."""
_PAUSE = 1.0
"""Seconds that somebody gets to be done with that."""


class Loaded(msgspec.Struct, frozen=True):
    """What a compiler is given for one version of a robot's package."""

    label: str
    """Which version it is."""
    texts: Mapping[str, bytes]
    """The files of the package, by path."""
    root: Path
    """The top-level package, as a copy."""
    libraries: Mapping[str, Path]
    """Other libraries, by their top-level names, without the Modelica Standard Library."""
    standard: tuple[str, ...]
    """The roots of the Modelica Standard Library; none if there is none."""
    files: int
    """How many there were in all copies when they were made."""

    @property
    def roots(self) -> tuple[str, ...]:
        """All roots."""
        return (*self.standard, *map(str, self.libraries.values()), str(self.root))

    def is_there(self) -> bool:
        """Whether a compiler still finds all that was put there."""
        all_there = all(Path(root).exists() for root in self.roots)
        return all_there and _count((*self.standard, self.root)) == self.files


class Loader:
    """Puts versions of one robot's package where a compiler finds them; may be used from several threads."""

    def __init__(self, subject: Subject, cache: Cache, folder: Path) -> None:
        """`folder` is for the copies of packages. Raises LibraryError if the Modelica Standard Library is broken."""
        self.subject, self._cache, self._folder = subject, cache, folder
        self._dependencies = Dependencies(dependencies.search_path(subject.robot))
        self._loading = threading.Lock()
        self.missing: LibraryError | None = None
        """Why there is no Modelica Standard Library; None if there is one."""
        self._standard: StandardLibrary | None = None
        try:
            self._standard = library.standard(os.environ, library.home(), subject.config.check.library)
        except LibraryError as error:
            self.missing = error
        self._copies = slim.Copies(self._standard, cache) if self._standard else None

    def load(self, label: str, texts: Mapping[str, bytes]) -> Loaded:
        """Put a version of the package, which `label` tells from others, where the compiler finds it.

        Raises CacheError if that can't be, OutputError for a library or a file around the package that can't be read.
        """
        with self._loading:
            for _ in range(ATTEMPTS):
                try:
                    return self._put(label, texts)
                except CacheError as error:
                    if not isinstance(error.__cause__, FileNotFoundError):
                        raise
                time.sleep(_PAUSE)
            raise self.emptied()

    def again(self, loaded: Loaded) -> Loaded:
        """Put there once more what somebody has deleted. Raises as `load` does."""
        time.sleep(_PAUSE)
        return self.load(loaded.label, loaded.texts)

    def emptied(self) -> CacheError:
        """What to raise if that does not help."""
        message = "somebody empties the cache while a check works with it"
        hint = "check again, and leave it alone meanwhile"
        return CacheError(Diagnostic(Severity.ERROR, "cache-emptied", message, str(self._cache.folder), hint=hint))

    def folders(self, loaded: Loaded) -> dict[Path, Path]:
        """Folders that the compiler reads, and those that people know instead."""
        robot, top = self.subject.robot, loaded.root
        known = {top: robot.output / top.name}
        if self._standard:
            copied = Path(*loaded.standard)
            known[copied / "Modelica"] = self._standard.modelica.path
            known[copied / "ModelicaServices"] = self._standard.services.path
        return known

    def _put(self, label: str, texts: Mapping[str, bytes]) -> Loaded:
        robot, around = self.subject.robot, self.subject.around
        with writing(self._cache.folder):
            root = workspace.write(self._folder / label, robot, texts, around)
        every = [content.decode(errors="replace") for content in (*texts.values(), *around.values())]
        uses = (name for name, _ in self.subject.domain.uses(robot.options))
        libraries = self._dependencies.of(root.name, every, uses)
        standard: tuple[str, ...] = ()
        if self._copies is not None:
            mentioned = references.mentioned(every) | self._dependencies.standard(libraries.values())
            standard = self._copies.roots(mentioned)
        own = {LIBRARY: library_folder() / LIBRARY} if root.name != LIBRARY else {}
        return Loaded(label, texts, root, {**own, **libraries}, standard, _count((*standard, root)))


@contextlib.contextmanager
def bench(cache: Cache, config: Config, robot: RobotConfig) -> Iterator[Path]:
    """A folder for copies of a robot's packages: always the same, so that a compiler's cache of them stays good.

    While another check works in it, it is one of its own. Raises CacheError if it can't be made.
    """
    name = hashlib.sha256(f"{config.file}\0{robot.name}".encode()).hexdigest()[:16]
    folder = cache.workspace(name)
    with Lock(folder / LOCK, wait=0) as lock:
        try:
            lock.acquire()
        except LockedError:
            with tempfile.TemporaryDirectory(dir=cache.workspaces) as other, Lock(Path(other) / LOCK, wait=0) as own:
                own.acquire()
                yield Path(other)
        else:
            yield folder


def _count(folders: Iterable[str | Path]) -> int:
    """How many files there are below folders."""
    return sum(len(files) for folder in folders for _, _, files in os.walk(folder))

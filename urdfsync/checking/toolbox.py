"""A compiler for one robot: where it finds the libraries, and the packages that it is to look at."""

from __future__ import annotations

import contextlib
import dataclasses
import hashlib
import os
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync import modelica
from urdfsync.checking import dependencies, library, references, slim, workspace
from urdfsync.checking.cache import LOCK, Cache, CacheError, writing
from urdfsync.checking.compiler import Compiler, CompilerError, Rumoca, ignore
from urdfsync.checking.dependencies import Dependencies
from urdfsync.checking.library import LibraryError, StandardLibrary
from urdfsync.checking.process import Limits
from urdfsync.checking.subject import Subject
from urdfsync.checking.tasks import Job, Outcome, Task
from urdfsync.checking.wishes import Wishes
from urdfsync.config import Config, RobotConfig, library_folder
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.state.lock import Lock, LockedError

_ATTEMPTS = 2
"""So often a version is loaded if somebody deletes it."""
_PAUSE = 1.0
"""Seconds that somebody gets to be done with that."""


@dataclasses.dataclass(frozen=True, slots=True)
class Loaded:
    """What a compiler is given for one version of a robot's package."""

    root: Path
    """The top-level package, as a copy."""
    libraries: Mapping[str, Path]
    """Other libraries, by their top-level names, without the Modelica Standard Library."""
    standard: tuple[str, ...]
    """The roots of the Modelica Standard Library; none if there is none."""

    @property
    def roots(self) -> tuple[str, ...]:
        """All roots."""
        return (*self.standard, *map(str, self.libraries.values()), str(self.root))


class Toolbox:
    """Compiles models of one robot's package, in the versions that are given; may be used from several threads."""

    def __init__(self, subject: Subject, wishes: Wishes, limits: Limits, cache: Cache, folder: Path) -> None:
        """`folder` is for the copies of packages; `limits` are those of each compiler.

        Raises LibraryError if the Modelica Standard Library is broken.
        """
        self.subject, self._limits, self._cache, self._folder = subject, limits, cache, folder
        self._compiler = _compiler(wishes, cache)
        self._dependencies = Dependencies(dependencies.search_path(subject.robot))
        self._loading = threading.Lock()
        self._loads: dict[Path, _Load] = {}
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
            for _ in range(_ATTEMPTS):
                try:
                    return self._put(label, texts)
                except CacheError as error:
                    if not isinstance(error.__cause__, FileNotFoundError):
                        raise
                time.sleep(_PAUSE)
            raise _emptied(self._cache)

    def run(
        self, loaded: Loaded, tasks: Sequence[Task], tell: Callable[[int, Outcome], None] = ignore
    ) -> list[Outcome]:
        """Do tasks in a process of their own. Raises CompilerError, or CacheError if the cache is emptied all the time.

        If somebody deletes meanwhile what the compiler reads, it is put there once more.
        """
        done: list[Outcome] = []

        def heard(number: int, outcome: Outcome) -> None:  # noqa: ARG001 - it counts from the beginning of its job
            if _is_problem(outcome) and not self._is_there(loaded):
                raise _EmptiedError
            done.append(outcome)
            tell(len(done) - 1, outcome)

        for _ in range(_ATTEMPTS):
            left = [_with_imports(task, list(loaded.libraries)) for task in tasks[len(done) :]]
            try:
                self._compiler.compile(Job(loaded.roots, tuple(left)), self._limits, heard)
            except (_EmptiedError, CompilerError) as error:
                if isinstance(error, CompilerError) and self._is_there(loaded):
                    raise
            else:
                return done
            load = self._loads[loaded.root]
            time.sleep(_PAUSE)
            loaded = self.load(load.label, load.texts)
        raise _emptied(self._cache)

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
        uses = (name for name, _ in self.subject.domain.uses)
        libraries = self._dependencies.of(root.name, every, uses)
        standard: tuple[str, ...] = ()
        if self._copies is not None:
            mentioned = references.mentioned(every) | self._dependencies.standard(libraries.values())
            standard = self._copies.roots(mentioned)
        own = {modelica.LIBRARY: library_folder() / modelica.LIBRARY} if root.name != modelica.LIBRARY else {}
        loaded = Loaded(root, {**own, **libraries}, standard)
        self._loads[root] = _Load(label, texts, _count((*standard, root)))
        return loaded

    def _is_there(self, loaded: Loaded) -> bool:
        """Whether the compiler still finds all that it was given."""
        all_there = all(Path(root).exists() for root in loaded.roots)
        return all_there and _count((*loaded.standard, loaded.root)) == self._loads[loaded.root].files


@dataclasses.dataclass(frozen=True, slots=True)
class _Load:
    """What was put into a folder."""

    label: str
    texts: Mapping[str, bytes]
    files: int
    """How many there were then in all copies."""


class _EmptiedError(Exception):
    """A problem is due to what is not there any more."""


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


def _compiler(wishes: Wishes, cache: Cache) -> Compiler:
    if wishes.tool == "omc":
        from urdfsync.checking.omc import OpenModelica

        return OpenModelica()
    return Rumoca(cache)


def _is_problem(outcome: Outcome) -> bool:
    return bool(outcome.problem) or any(run.problem for run in outcome.runs)


def _count(folders: Iterable[str | Path]) -> int:
    """How many files there are below folders."""
    return sum(len(files) for folder in folders for _, _, files in os.walk(folder))


def _emptied(cache: Cache) -> CacheError:
    message = "somebody empties the cache while a check works with it"
    hint = "check again, and leave it alone meanwhile"
    return CacheError(Diagnostic(Severity.ERROR, "cache-emptied", message, str(cache.folder), hint=hint))


def _with_imports(task: Task, names: Sequence[str]) -> Task:
    """The task with imports of libraries behind the first line of its text, which opens a class."""
    first, _, rest = task.source.partition("\n")
    imports = "".join(f"  import {name};\n" for name in names if f"import {name};" not in rest)
    return msgspec.structs.replace(task, source=f"{first}\n{imports}{rest}")

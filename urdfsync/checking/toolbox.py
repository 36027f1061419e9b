"""A compiler for one robot: where it finds the libraries, and the packages that it is to look at."""

from __future__ import annotations

import contextlib
import dataclasses
import hashlib
import os
import re
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync import modelica
from urdfsync.checking import library, slim, workspace
from urdfsync.checking.cache import Cache
from urdfsync.checking.compiler import Compiler, Rumoca, ignore
from urdfsync.checking.library import LibraryError, StandardLibrary
from urdfsync.checking.process import Limits
from urdfsync.checking.subject import Subject
from urdfsync.checking.tasks import Job, Outcome, Task
from urdfsync.checking.wishes import Wishes
from urdfsync.config import Config, RobotConfig, library_folder
from urdfsync.state.lock import Lock, LockedError

_STANDARD = ("Modelica", "ModelicaServices", "Complex")


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
        """`folder` is for the copies of packages; `limits` are those of each compiler."""
        self.subject, self._limits, self._cache, self._folder = subject, limits, cache, folder
        self._compiler = _compiler(wishes, cache)
        self._places = [subject.robot.output, *library.folders(os.environ, Path.home())]
        self.missing: LibraryError | None = None
        """Why there is no Modelica Standard Library; None if there is one."""
        self._standard: StandardLibrary | None = None
        try:
            self._standard = library.standard(os.environ, Path.home(), subject.config.check.library)
        except LibraryError as error:
            self.missing = error

    def load(self, label: str, texts: Mapping[str, bytes]) -> Loaded:
        """Put a version of the package, which `label` tells from others, where the compiler finds it."""
        robot = self.subject.robot
        around = workspace.surroundings(self.subject.config, robot, texts)
        root = workspace.write(self._folder / label, robot, texts, around)
        every = [content.decode(errors="replace") for content in (*texts.values(), *around.values())]
        standard = slim.roots(self._standard, self._cache, every) if self._standard else ()
        return Loaded(root, self._libraries(root.name, every), standard)

    def run(
        self, loaded: Loaded, tasks: Sequence[Task], tell: Callable[[int, Outcome], None] = ignore
    ) -> list[Outcome]:
        """Do tasks in a process of their own. Raises CompilerError."""
        named = [_with_imports(task, list(loaded.libraries)) for task in tasks]
        return self._compiler.compile(Job(loaded.roots, tuple(named)), self._limits, tell)

    def folders(self, loaded: Loaded) -> dict[Path, Path]:
        """Folders that the compiler reads, and those that people know instead."""
        robot, top = self.subject.robot, loaded.root
        known = {top: robot.output / top.name}
        if self._standard and len(loaded.standard) == 1:
            copied = Path(loaded.standard[0])
            known[copied / "Modelica"] = self._standard.modelica.path
            known[copied / "ModelicaServices"] = self._standard.services.path
        return known

    def _libraries(self, top: str, texts: Sequence[str]) -> dict[str, Path]:
        """The libraries at hand that the package needs or mentions, without the Modelica Standard Library."""
        known = {modelica.LIBRARY: library_folder() / modelica.LIBRARY} if top != modelica.LIBRARY else {}
        needed = {name for name, _ in self.subject.domain.uses} | _first_names(texts)
        for name in sorted(needed - {top, *known, *_STANDARD}):
            found = library.find(name, self._places)
            if found is not None:
                known[name] = found
        return known


@contextlib.contextmanager
def bench(cache: Cache, config: Config, robot: RobotConfig) -> Iterator[Path]:
    """A folder for copies of a robot's packages: always the same, so that a compiler's cache of them stays good.

    While another check works in it, it is one of its own. Raises CacheError if it can't be made.
    """
    name = hashlib.sha256(f"{config.file}\0{robot.name}".encode()).hexdigest()[:16]
    folder = cache.workspace(name)
    with Lock(folder / "lock", wait=0) as lock:
        try:
            lock.acquire()
        except LockedError:
            with tempfile.TemporaryDirectory(dir=cache.workspaces) as other:
                yield Path(other)
        else:
            yield folder


def _compiler(wishes: Wishes, cache: Cache) -> Compiler:
    if wishes.tool == "omc":
        from urdfsync.checking.omc import OpenModelica

        return OpenModelica()
    return Rumoca(cache)


def _first_names(texts: Sequence[str]) -> set[str]:
    """What stands before the first dot of names that begin with a capital, as those of libraries do."""
    return {name for text in texts for name in re.findall(r"(?<![\w.])([A-Z]\w*)(?=\.[A-Za-z])", text)}


def _with_imports(task: Task, names: Sequence[str]) -> Task:
    """The task with imports of libraries behind the first line of its text, which opens a class."""
    first, _, rest = task.source.partition("\n")
    imports = "".join(f"  import {name};\n" for name in names if f"import {name};" not in rest)
    return msgspec.structs.replace(task, source=f"{first}\n{imports}{rest}")

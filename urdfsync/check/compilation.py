"""Versions of one robot's package, put where a compiler finds them, and compiled with the libraries that they need."""

from __future__ import annotations

import os
import threading
from collections.abc import Generator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.check import libraries
from urdfsync.check.cache import UserCache, cache_errors
from urdfsync.check.compilers import compiler
from urdfsync.check.compilers.compiler import CompileJob, CompileResult, CompileTask
from urdfsync.check.files import write_package
from urdfsync.check.libraries import StandardLibrary
from urdfsync.check.package import CheckedPackage
from urdfsync.check.results import CompilerName
from urdfsync.config import library_folder
from urdfsync.modelica.names import LIBRARY


class PackageVersion(msgspec.Struct, frozen=True):
    """What a compiler is given for one version of a robot's package."""

    top: Path
    """The top-level package, as a copy."""
    standard: Path
    """The folder with a copy of the Modelica Standard Library."""
    libraries: Mapping[str, Path]
    """Other libraries, by their top-level names."""


class PackageCompiler:
    """Compiles versions of one robot's package; may be used from several threads."""

    def __init__(
        self, package: CheckedPackage, standard: StandardLibrary, name: CompilerName, cache: UserCache, folder: Path
    ) -> None:
        """`folder` is for copies of the package."""
        self._package, self._standard, self._name, self._cache = package, standard, name, cache
        self._folder, self._lock = folder, threading.Lock()

    def put(self, label: str, texts: Mapping[str, bytes]) -> PackageVersion:
        """Put a version of the package, which `label` tells from others, where the compiler finds it.

        Raises CacheError if that can't be, OutputError for a library that can't be read.
        """
        package, robot = self._package, self._package.robot
        with self._lock:
            with cache_errors(self._cache.folder):
                top = write_package(self._folder / label, robot, texts, package.around)
            every = [*texts.values(), *package.around.values()]
            uses = [name for name, _ in package.domain.uses(robot.options)]
            found = libraries.needed_libraries(every, top.name, libraries.search_path(robot), uses)
            more = [text for path in found.values() for text in libraries.library_texts(path).values()]
            standard = libraries.standard_library_copy(self._standard, [*every, *more], self._cache)
        own = {LIBRARY: library_folder() / LIBRARY} if top.name != LIBRARY else {}
        return PackageVersion(top, standard, {**own, **found})

    def run(self, version: PackageVersion, tasks: Sequence[CompileTask]) -> Generator[CompileResult, None, None]:
        """Do tasks in a process of their own; each result as soon as it is known. Raises CompilerError."""
        roots = (version.standard, *version.libraries.values(), version.top)
        imported = tuple(_with_imports(task, version.libraries) for task in tasks)
        return compiler.run_job(self._name, CompileJob(tuple(map(os.fspath, roots)), imported), self._cache)

    def known_folders(self, version: PackageVersion) -> dict[Path, Path]:
        """Folders that the compiler reads, and those that people know instead."""
        copies = {version.standard / name: path for name, path in self._standard.parts.items() if path.suffix != ".mo"}
        return {**copies, version.top: self._package.robot.output / version.top.name}


def _with_imports(task: CompileTask, names: Mapping[str, Path]) -> CompileTask:
    """The task with imports of libraries behind the first line of its text: rumoca loads no others."""
    first, _, rest = task.source.partition("\n")
    imports = "".join(f"  import {name};\n" for name in names if f"import {name};" not in rest)
    return msgspec.structs.replace(task, source=f"{first}\n{imports}{rest}")

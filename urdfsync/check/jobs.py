"""Does tasks of a compiler with versions of one robot's package, each a copy in a folder that the compiler reads."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.check import compilers, libraries
from urdfsync.check.cache import UserCache, cache_errors
from urdfsync.check.compilers.compiler import CompileJob, CompileResult, CompileTask, Tool
from urdfsync.check.contents import copy_library
from urdfsync.check.package import write_package
from urdfsync.check.process import Limits
from urdfsync.config import RobotConfig, find_own_library
from urdfsync.modelica.names import LIBRARY


class Jobs:
    """Where the tasks of one robot are done."""

    def __init__(
        self,
        robot: RobotConfig,
        around: Mapping[str, bytes],
        needed: libraries.Libraries,
        texts: Iterable[bytes],
        tool: Tool,
        limits: Limits,
        folder: Path,
        progress: Callable[[], None] | None = None,
    ) -> None:
        """Copy the part of the Modelica Standard Library that `texts` and other libraries need. Raises CacheError.

        `around` is as in `package.files_around`; copies go below `folder`; for `progress` see `process.run`.
        """
        self._robot, self._around, self._tool, self._progress = robot, around, tool, progress
        self._limits, self._folder = limits, folder
        self._roots, self._originals = list[str](), dict[str, Path]()
        if not compilers.COMPILERS[tool.name].HAS_STANDARD_LIBRARY:
            others = (text for path in needed.others.values() for text in libraries.library_texts(path).values())
            copy = libraries.standard_library_copy(needed.standard, [*texts, *others], UserCache.default())
            self._roots = [str(copy)]
            parts = needed.standard.items()
            self._originals = {str(copy / name): path for name, path in parts if path.suffix != ".mo"}
        own = find_own_library(LIBRARY, robot.target.package)
        self._libraries = {**({LIBRARY: own} if own else {}), **needed.others}

    def run(
        self,
        label: str,
        texts: Mapping[str, bytes],
        tasks: Sequence[CompileTask],
        changed: Mapping[Path, bytes] | None = None,
    ) -> list[CompileResult]:
        """Do tasks with a package in a process. Problems name the files that people know, and not their copies.

        `label` names the copy; `changed` are files of other libraries that have another content there. Raises
        CompilerError, LimitError and CacheError, and as `copy_library`.
        """
        cache, folder = UserCache.default(), self._folder / label.replace("/", "-")
        originals, roots = dict(self._originals), list(self._roots)
        with cache_errors(cache.folder):
            top = write_package(folder, self._robot, texts, self._around)
            for path in self._libraries.values():
                root = _readable(path, folder / ".libraries", changed or {})
                originals[root] = path
                roots.append(root)
        originals[str(top)] = self._robot.output / top.name
        with_imports = []  # of libraries, behind the first line of each text: rumoca loads no others
        for task in tasks:
            first, _, rest = task.source.partition("\n")
            imports = "".join(f"  import {name};\n" for name in self._libraries if f"import {name};" not in rest)
            with_imports.append(msgspec.structs.replace(task, source=f"{first}\n{imports}{rest}"))
        job = CompileJob((*roots, str(top)), tuple(with_imports))

        def named(text: str) -> str:
            for copy, original in originals.items():
                text = text.replace(copy, str(original))
            return text

        return [
            msgspec.structs.replace(
                one,
                problem=named(one.problem),
                warnings=named(one.warnings),
                runs=tuple(msgspec.structs.replace(run, problem=named(run.problem)) for run in one.runs),
            )
            for one in compilers.run_job(self._tool, job, cache, self._limits, self._progress)
        ]


def _readable(path: Path, folder: Path, changed: Mapping[Path, bytes]) -> str:
    """A library where the compiler can read it, which takes paths in UTF-8 only; else, or if changed, a copy."""
    inside = {file: content for file, content in changed.items() if file == path or path in file.parents}
    try:
        str(path).encode()
    except UnicodeEncodeError:
        pass
    else:
        if not inside:
            return str(path)
    copy = folder / path.name
    folder.mkdir(parents=True, exist_ok=True)
    copy_library(path, copy)
    for file, content in inside.items():
        (copy / file.relative_to(path)).write_bytes(content)
    return str(copy)

"""Runs a compiler on versions of one robot's package; each version is a copy in a folder of its own."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.analysis.checks import compilers, libraries
from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.compilers.compiler import CompileJob, CompileResult, CompileTask, Tool
from urdfsync.analysis.checks.contents import copy_library
from urdfsync.analysis.checks.package import write_package
from urdfsync.analysis.checks.process import Limits
from urdfsync.modelica.names import LIBRARY
from urdfsync.project.config import RobotConfig, find_own_library


class Jobs(msgspec.Struct, frozen=True):
    """Runs the tasks of one compiler on the package of one robot."""

    robot: RobotConfig
    tool: Tool
    needed: libraries.Libraries
    around: Mapping[str, bytes]
    """See `package.files_around`."""
    limits: Limits
    folder: Path
    """The folder for copies of the package."""
    progress: Callable[[], None] | None = None
    on_result: Callable[[CompileResult], None] | None = None
    """See `process.run` for both. Problems of these results name the copies of files."""

    def run(
        self,
        label: str,
        texts: Mapping[str, bytes],
        tasks: Sequence[CompileTask],
        changed: Mapping[Path, bytes] | None = None,
    ) -> list[CompileResult]:
        """Run tasks on a version of the package in a process. Problems name the user's files.

        `label` names the copy; `changed` has new contents for some files of the package, by absolute path. Raises
        CompilerError, LimitError, CacheError, and the errors of `copy_library`.
        """
        cache, folder, changed = UserCache.default(), self.folder / label.replace("/", "-"), changed or {}
        texts = {path: changed.get(self.robot.folder / path, content) for path, content in texts.items()}
        around = {path: changed.get(self.robot.output / path, content) for path, content in self.around.items()}
        own = find_own_library(LIBRARY, self.robot.target.package)
        needed = {**({LIBRARY: own} if own else {}), **self.needed.others}
        top, copied = write_package(folder, self.robot, texts, around), dict[str, Path]()
        originals = dict[str, str]()
        """For each copied folder or file, the user's original."""
        roots = list[str]()
        if not compilers.COMPILERS[self.tool.name].HAS_STANDARD_LIBRARY:
            copied = dict(self.needed.standard)
            whole = dict(self.needed.others)
            if own:
                (whole if any(own in file.parents for file in changed) else copied)[LIBRARY] = own
            others = (text for path in whole.values() for text in libraries.library_texts(path).values())
            changes, sources = changed.values(), (task.source.encode() for task in tasks)
            every = (*texts.values(), *around.values(), *others, *changes, *sources)
            roots.append(str(libraries.copy_named(copied, every, cache)))
            for name, path in copied.items():
                end = ".mo" if path.suffix == ".mo" else os.sep  # `Modelica` begins `ModelicaServices`, too
                originals[f"{roots[0]}{os.sep}{name}{end}"] = str(path).removesuffix(end) + end
        for name, path in needed.items():
            if name not in copied:
                roots.append(_readable(path, folder / ".libraries", changed))
                originals[roots[-1]] = str(path)
        roots.append(str(top))
        originals[roots[-1]] = str(self.robot.output / top.name)
        tasks = [_with_imports(task, needed) for task in tasks]
        job = CompileJob(tuple(roots), tuple(tasks))
        results = compilers.run_job(self.tool, job, cache, self.limits, self.progress, self.on_result)
        return [_with_originals(result, originals) for result in results]


def _with_imports(task: CompileTask, names: Iterable[str]) -> CompileTask:
    """Import libraries below the first line of a task's text: rumoca loads no others."""
    first, _, rest = task.source.partition("\n")
    imports = "".join(f"  import {name};\n" for name in names if f"import {name};" not in rest)
    return msgspec.structs.replace(task, source=f"{first}\n{imports}{rest}")


def _with_originals(result: CompileResult, originals: Mapping[str, str]) -> CompileResult:
    """Replace the paths of copies in a compiler's text by the paths of the originals."""

    def named(text: str) -> str:
        for copy, original in originals.items():
            text = text.replace(copy, original)
        return text

    runs = tuple(msgspec.structs.replace(run, problem=named(run.problem)) for run in result.runs)
    return msgspec.structs.replace(result, problem=named(result.problem), warnings=named(result.warnings), runs=runs)


def _readable(path: Path, folder: Path, changed: Mapping[Path, bytes]) -> str:
    """Return a library's path for the compiler; if this is not UTF-8, or a file has changed, the path of a copy."""
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

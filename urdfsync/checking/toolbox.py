"""The compiler for one robot: does tasks, and does them again if somebody deletes what it reads."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import msgspec

from urdfsync.checking.compilers.compiler import Compiler, CompilerError, ignore
from urdfsync.checking.compilers.tasks import Job, Outcome, Task
from urdfsync.checking.loading import ATTEMPTS, Loaded, Loader
from urdfsync.checking.process import Limits


class Toolbox:
    """Compiles models of one robot's package, in the versions that are given; may be used from several threads."""

    def __init__(self, loader: Loader, compiler: Compiler, limits: Limits) -> None:
        """`limits` are those of each of the compiler's processes."""
        self.loader, self._compiler, self._limits = loader, compiler, limits

    def run(
        self, loaded: Loaded, tasks: Sequence[Task], tell: Callable[[int, Outcome], None] = ignore
    ) -> list[Outcome]:
        """Do tasks in a process of their own. Raises CompilerError, or CacheError if the cache is emptied all the time.

        If somebody deletes meanwhile what the compiler reads, it is put there once more.
        """
        done: list[Outcome] = []

        def heard(number: int, outcome: Outcome) -> None:  # noqa: ARG001 - it counts from the beginning of its job
            if _is_problem(outcome) and not loaded.is_there():
                raise _EmptiedError
            done.append(outcome)
            tell(len(done) - 1, outcome)

        for _ in range(ATTEMPTS):
            left = [_with_imports(task, list(loaded.libraries)) for task in tasks[len(done) :]]
            try:
                self._compiler.compile(Job(loaded.roots, tuple(left)), self._limits, heard)
            except (_EmptiedError, CompilerError) as error:
                if isinstance(error, CompilerError) and loaded.is_there():
                    raise
            else:
                return done
            loaded = self.loader.again(loaded)
        raise self.loader.emptied()


class _EmptiedError(Exception):
    """A problem is due to what is not there any more."""


def _is_problem(outcome: Outcome) -> bool:
    return bool(outcome.problem) or any(run.problem for run in outcome.runs)


def _with_imports(task: Task, names: Sequence[str]) -> Task:
    """The task with imports of libraries behind the first line of its text, which opens a class."""
    first, _, rest = task.source.partition("\n")
    imports = "".join(f"  import {name};\n" for name in names if f"import {name};" not in rest)
    return msgspec.structs.replace(task, source=f"{first}\n{imports}{rest}")

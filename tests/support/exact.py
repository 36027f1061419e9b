"""The worker around the compiler, with a tolerance that leaves only errors of models: where motion is compared."""

from __future__ import annotations

import functools
import os
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from unittest import mock

from support.modelica import CACHE, URDFSYNC, Task, standard
from urdfsync.checking.compilers import compiler, tasks, worker
from urdfsync.checking.process import Limits

TOLERANCE = 1e-9
"""Relative and absolute."""

_TOOL = compiler.Tool("the compiler", "support.exact", "", "")


def execute(
    library: Path, packages: Iterable[Path], todo: Sequence[Task], timeout: float = 1800
) -> list[tasks.Outcome]:
    """As `support.modelica.execute`, but exactly; raises CompilerError if the compiler does not get to the end."""
    roots = (*standard(library), str(URDFSYNC), *map(str, packages))
    runs = [tuple(tasks.Simulation(run.stop, run.step, run.parameters) for run in task.runs) for task in todo]
    job = [tasks.Task(task.model, task.source, runs, tuple(task.values)) for task, runs in zip(todo, runs, strict=True)]
    cache = {"XDG_CACHE_HOME": str(CACHE.compiler.parent), "MODELICAPATH": ""}
    with mock.patch.dict(os.environ, PYTHONPATH=str(Path(__file__).parents[1])):
        return compiler.ask(_TOOL, tasks.Job(roots, tuple(job)), Limits(timeout), cache, compiler.ignore)


def main() -> int:
    """The worker of `urdfsync.checking` with another default of the compiler."""
    import rumoca

    rumoca.SimConfig = functools.partial(rumoca.SimConfig, rtol=TOLERANCE, atol=TOLERANCE)  # type: ignore[misc,assignment]
    return worker.main()


if __name__ == "__main__":
    sys.exit(main())

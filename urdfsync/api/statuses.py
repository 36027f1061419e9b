"""How packages stand."""

from __future__ import annotations

from collections.abc import Callable

from urdfsync.api import Place, Results, ignore, load
from urdfsync.api.builds import build_options
from urdfsync.engine.build import build
from urdfsync.engine.options import Progress, no_progress
from urdfsync.engine.result import Result
from urdfsync.output.status import status_lines


def status(
    *robots: str,
    config: Place = None,
    wait: float = 60,
    progress: Progress = no_progress,
    on_result: Callable[[Result], object] = ignore,
) -> Results[Result]:
    """Say how each file stands, from a build that writes nothing: `action.reason.status` of a result's `actions`.

    A source that xacro or a command makes is not made anew: `stale` names the inputs that changed.
    """
    loaded = load(config)
    options = build_options(dry=True, expands=False, wait=wait, progress=progress)
    return Results(build(loaded, loaded.select(robots), options), status_lines, on_result)

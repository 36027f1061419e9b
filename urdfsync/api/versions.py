"""Differences of sources from older versions."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from urdfsync import config as configuration
from urdfsync.api import Place, Results, ignore, load
from urdfsync.api.builds import build_options
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import ConfigError
from urdfsync.engine.options import Progress, no_progress
from urdfsync.versions import comparison, report
from urdfsync.versions.comparison import Comparison


def diff(
    *sources: str,
    robots: Sequence[str] = (),
    against: str | None = None,
    config: Place = None,
    wait: float = 60,
    progress: Progress = no_progress,
    on_result: Callable[[Comparison], object] = ignore,
) -> Results[Comparison]:
    """Show what changed in sources since the last build, or since the version `against`: a file, or a git revision.

    `sources` are files or robots, `robots` names of robots alone; without both, all sources are compared. No
    configuration is needed for files and `against`. Raises UrdfsyncError for what can't be compared at all; where the
    version can't be read, the `result` of a comparison has `failed`.
    """
    folder = configuration.working_folder()
    loaded = _find_config(sources, robots, against, config, folder)
    options = build_options(wait=wait, progress=progress)
    pairs = list(_select_sources(sources, robots, against, loaded, folder))
    compared = (
        each for known, chosen in pairs for each in comparison.compare_sources(chosen, against, known, options, folder)
    )
    return Results(compared, report.all_lines, on_result)


def _find_config(
    sources: Sequence[str], robots: Sequence[str], against: str | None, config: Place, folder: Path
) -> Config | None:
    """Return the configuration; None if there is none and none is needed. Raises ConfigError."""
    is_near = any((place / configuration.FILE_NAME).is_file() for place in (folder, *folder.parents))
    if is_near or config or robots or not sources:
        return load(config)
    if against is not None:
        return None
    message = (
        f"no {configuration.FILE_NAME} in {folder} or a folder above it, so there is no last build to compare with"
    )
    hint = "name the version to compare with: --against FILE or REVISION, or begin with `urdfsync init`"
    raise ConfigError.of("no-config", message, hint=hint)


def _select_sources(
    sources: Sequence[str], names: Sequence[str], against: str | None, config: Config | None, folder: Path
) -> Iterator[tuple[Config | None, Sequence[RobotConfig]]]:
    """Yield the robots that the arguments mean, and robots for sources that none of them has. Raises ConfigError."""
    known = {os.path.realpath(robot.source) for robot in config.robots} if config else set()
    places = {text: Path(os.path.normpath(folder / text)) for text in sources}
    alone = {text: place for text, place in places.items() if place.is_file() and os.path.realpath(place) not in known}
    if config is None and (missing := places.keys() - alone.keys()):
        raise ConfigError.of("no-source", f"there is no file {min(missing)!r}", hint="name a source that exists")
    if against is None and alone:
        message = f"{min(alone)} was never built: it is not the source of a robot"
        hint = "add a robot for it, or name the version to compare it with: --against FILE or REVISION"
        raise ConfigError.of("no-robot", message, hint=hint)
    named = [*(text for text in sources if text not in alone), *names]
    robots = config.select(named) if config and (named or not alone) else ()
    if against and (folder / against).is_file() and len({robot.source for robot in robots}) + len(alone) > 1:
        message = "--against names one file, but several sources are compared"
        raise ConfigError.of("one-file", message, hint="name the source to compare it with")
    yield config, robots
    yield None, [comparison.robot_of_file(place) for place in alone.values()]

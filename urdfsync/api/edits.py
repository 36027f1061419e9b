"""Differences of packages from what was generated: what the user edited."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

from urdfsync import config as configuration
from urdfsync.api import Place, Results, ignore, load
from urdfsync.api.builds import build_options
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import ConfigError, UrdfsyncError
from urdfsync.engine.edits import find_edited
from urdfsync.engine.generation import generate_robot
from urdfsync.engine.inputs import inspect
from urdfsync.engine.options import BuildOptions, Progress, no_progress
from urdfsync.output.edits import RobotEdits, all_lines


def edits(
    *paths: str,
    robots: Sequence[str] = (),
    config: Place = None,
    wait: float = 60,
    progress: Progress = no_progress,
    on_result: Callable[[RobotEdits], object] = ignore,
) -> Results[RobotEdits]:
    """Show what the user edited in packages, of `robots` or all, as far as `paths` mean it: robots, files, folders.

    Raises ConfigError for a path that means none.
    """
    loaded, options = load(config), build_options(dry=True, wait=wait, progress=progress)
    return Results(_find_edits(paths, loaded, loaded.select(robots), options), all_lines, on_result)


def _find_edits(
    paths: Sequence[str], config: Config, robots: Sequence[RobotConfig], options: BuildOptions
) -> Iterator[RobotEdits]:
    """Yield the edits in the files that paths mean, or in all. Raises ConfigError if a path means none."""
    places = {text: Path(os.path.normpath(configuration.working_folder() / text)) for text in paths}
    unknown = set(places)
    for robot in robots:
        named = {
            text: robot.folder if text == robot.name else place
            for text, place in places.items()
            if text == robot.name or place.is_relative_to(robot.folder) or robot.folder.is_relative_to(place)
        }
        unknown -= named.keys()
        if places and not named:
            continue
        try:
            files = tuple(find_edited(generate_robot(inspect(config, robot, options))))
        except UrdfsyncError as error:
            yield RobotEdits(robot.name, config.root, diagnostics=error.diagnostics, failed=True)
            continue
        if named:
            files = tuple(file for file in files if _is_below(config.root / file.path, named.values()))
        yield RobotEdits(robot.name, config.root, files)
    if unknown:
        message = f"{min(unknown)!r} is no robot, and no file of a package"
        raise ConfigError.of("no-source", message, hint="name a robot, or a file of its package")


def _is_below(path: Path, places: Iterable[Path]) -> bool:
    return any(path.is_relative_to(place) for place in places)

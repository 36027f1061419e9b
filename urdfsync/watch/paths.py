"""Which paths matter to a robot, and in which folders changes of them show.

Paths are strings here, since there are thousands of them and they are looked at often.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync import registry
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import SourceError, UrdfsyncError
from urdfsync.domain import Lookup
from urdfsync.engine import parents
from urdfsync.engine.expansion import Inputs
from urdfsync.engine.imports import find_dependencies
from urdfsync.files import placed
from urdfsync.state.record import Record
from urdfsync.state.store import Store

_MAX_STEPS = 1000
"""Folders and links on the way to a file: links may lead in a circle."""


class RobotPaths(msgspec.Struct, frozen=True):
    """The files of one robot, absolute, and what the last build recorded of its source."""

    inputs: frozenset[str]
    """Configuration, source and dependencies, wherever these may be found, as configuration and source name them."""
    outputs: frozenset[str]
    """Files of the package, of the packages around it, and of the recorded state."""
    patterns: frozenset[str] = frozenset()
    """By which xacro looks for files."""


def find_robot_paths(
    config: Config, robot: RobotConfig, package_paths: Sequence[Path], error: SourceError | None = None
) -> RobotPaths:
    """Return the paths of a robot as far as the last build recorded them; of one that failed, what its error names."""
    store, patterns = Store(config.root), set(error.patterns if error else ())
    beside = registry.domain(robot.domain).beside(robot.source)
    inputs = {str(config.file), str(robot.source), *(error.reads if error else ()), *([str(beside)] if beside else [])}
    outputs = {*parents.files(robot), str(store.path(robot.name))}
    with contextlib.suppress(UrdfsyncError, OSError):  # told by the build
        state, _ = store.load(robot.name)
        if (expanded := store.load_expansion(robot.name)) is not None:
            expansion_inputs = Inputs(config.root, robot.source, (*robot.package_paths, *package_paths))
            inputs.update(map(str, expansion_inputs.paths(expanded.files)))
            patterns.update(map(str, expansion_inputs.paths(expanded.patterns)))
            outputs.add(str(store.expansion(robot.name)))
        if state is not None:
            prefix = os.path.join(os.path.normpath(config.root), "")  # noqa: PTH118
            outputs.update(placed(prefix, key) for key in state.files)
            inputs.update(_dependencies(robot, state, package_paths))
    return RobotPaths(frozenset(inputs), frozenset(outputs), frozenset(patterns))


def _dependencies(robot: RobotConfig, state: Record, package_paths: Sequence[Path]) -> Iterator[str]:
    """Yield the places of each dependency up to the first readable file: those behind it do not matter yet."""
    if state.snapshot is None:
        return
    lookup = Lookup(robot.source, (*robot.package_paths, *package_paths))
    try:
        dependencies = find_dependencies(registry.domain(robot.domain), state.snapshot, lookup, robot.options, {})
    except Exception:  # noqa: BLE001 - no model of the domain, or a mistake in it: the build tells it
        return
    for dependency in dependencies:
        others = [name for imported in state.imports.get(dependency.key, ()) for name in imported.others]
        for path in map(str, dependency.candidates):
            yield path
            if os.path.isfile(path) and os.access(path, os.R_OK):  # noqa: PTH113
                yield from (os.path.normpath(os.path.join(os.path.dirname(path), name)) for name in others)  # noqa: PTH118, PTH120
                break


class WatchedPaths(msgspec.Struct, frozen=True):
    """Where changes of the paths of all robots show; without symbolic links, as events have none."""

    by_path: Mapping[str, set[str]] = {}
    """Robots by each of their files, and by each folder and link on the way there; by FOLDER/* for each file in it."""
    folders: frozenset[str] = frozenset()
    """Folders to watch, without those below."""
    trees: Mapping[str, set[str]] = {}
    """Folders to watch with all folders below; if it names robots, every file there matters to these."""

    def robots_for(self, path: str) -> set[str]:
        """Return the robots to which a change of a path matters."""
        robots = {*self.by_path.get(path, ()), *self.by_path.get(_any_file(os.path.dirname(path)), ())}  # noqa: PTH120
        return robots.union(*(names for tree, names in self.trees.items() if path.startswith(f"{tree}{os.sep}")))


def find_watched_paths(config: Config, paths: Mapping[str, RobotPaths]) -> WatchedPaths:
    """Return where to look for changes; `paths` are by the names of robots.

    Folders above the configuration's are not watched, but for the one nearest to a file that is found outside.
    """
    root = _way_to(str(config.root))[-1]
    above = {root, *map(str, Path(root).parents)}
    by_path: dict[str, set[str]] = {}
    trees: dict[str, set[str]] = {}

    def add(path: str, name: str) -> str:
        """Note who wants to know of a path, and of what is on the way there. Returns the path without links."""
        way = _way_to(path)
        for place in way:
            if place not in above:
                by_path.setdefault(place, set()).add(name)
        return way[-1]

    for robot in (robot for robot in config.robots if robot.name in paths):
        name, own = robot.name, paths[robot.name]
        for path in own.inputs:
            add(path, name)
        folders = {folder: add(folder, name) for folder in {os.path.dirname(path) for path in own.outputs}}  # noqa: PTH120
        for path in own.outputs:  # thousands, and no links: a build refuses those
            folder, _, file = path.rpartition(os.sep)
            by_path.setdefault(f"{folders[folder]}{os.sep}{file}", set()).add(name)
        trees.setdefault(add(str(robot.folder), name), set())
        for folder in {os.path.dirname(pattern) for pattern in own.patterns}:  # noqa: PTH120
            by_path.setdefault(_any_file(add(folder, name)), set()).add(name)
        if robot.templates:
            trees.setdefault(add(str(robot.templates), name), set()).add(name)
    trees = {folder: names for folder, names in trees.items() if os.path.isdir(folder)}  # noqa: PTH112
    in_trees = tuple(f"{tree}{os.sep}" for tree in trees)
    above.remove(root)  # a file that is missing there may come, as any below it
    watched: set[str] = set()
    for path in by_path:
        folder = os.path.dirname(path)  # noqa: PTH120
        if folder in watched or f"{folder}{os.sep}".startswith(in_trees) or os.path.dirname(folder) == folder:  # noqa: PTH120
            continue
        # a file that does not exist is not waited for in the folders above the configuration's
        if os.path.exists(path) if folder in above else os.path.isdir(folder):  # noqa: PTH110, PTH112
            watched.add(folder)
    return WatchedPaths(by_path, frozenset(watched), trees)


def _any_file(folder: str) -> str:
    """Return the key for each file in a folder."""
    return f"{folder}{os.sep}*"


def _way_to(path: str) -> list[str]:
    """Return each folder and link on the way to a path, with the targets of links; at last the path without links."""
    *parts, place = reversed(Path(path).parts)
    way = [place]
    while parts and len(way) < _MAX_STEPS:
        folder, place = place, os.path.join(place, parts.pop())  # noqa: PTH118
        way.append(place)
        with contextlib.suppress(OSError):  # no link, or nothing at all
            target = os.path.normpath(os.path.join(folder, os.readlink(place)))  # noqa: PTH115, PTH118
            *more, place = reversed(Path(target).parts)
            parts += more
    return way

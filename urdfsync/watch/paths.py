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
from urdfsync.config import Config, RobotConfig, shown
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.domain import Lookup
from urdfsync.engine import parents
from urdfsync.engine.cache import Cache
from urdfsync.engine.imports import find_dependencies
from urdfsync.files import placed
from urdfsync.state.store import State, Store

_MAX_LINKS = 40
"""Symbolic links that one path may lead through, as for the system."""
CONFIG = ""
"""Stands for the configuration where a robot's name is expected."""


class RobotPaths(msgspec.Struct, frozen=True):
    """The files of one robot, absolute, and what the last build recorded of its source."""

    source: str
    inputs: frozenset[str]
    """Source and dependencies, wherever they may be found, as the configuration and the source name them."""
    templates: str | None
    """Folder of which every file matters, those in folders below included."""
    outputs: frozenset[str]
    """Files of the package, of the packages around it, and of the recorded state."""
    package: str
    """The package's folder."""
    built_hash: str = ""
    """Text hash of the source in the last build; empty if there was none."""
    built_names: frozenset[tuple[str, str]] = frozenset()
    """Kind and name of each element in the last build."""

    def input_files(self) -> Iterator[str]:
        """Yield all files that the robot is built from, those in the template folder included."""
        yield from self.inputs
        for folder, _, names in os.walk(self.templates) if self.templates else ():
            yield from (os.path.join(folder, name) for name in names)  # noqa: PTH118


def find_robot_paths(config: Config, robot: RobotConfig, package_paths: Sequence[Path], cache: Cache) -> RobotPaths:
    """Return the paths of a robot as far as the last build recorded them."""
    store, state = Store(config.root, shown), None
    outputs = {*parents.files(robot), *map(str, store.paths(robot.name))}
    inputs, names = {str(robot.source)}, set[tuple[str, str]]()
    with contextlib.suppress(UrdfsyncError, OSError):  # told by the build
        # a build has just recorded it; loading it again takes a fifth of the time of a changed mass in 1,000 links
        state = cache.get("state", store.texts(robot.name), lambda: store.load(robot.name))
    if state:
        prefix = os.path.join(os.path.normpath(config.root), "")  # noqa: PTH118
        outputs.update(placed(prefix, key) for key in (*state.manifest.files, *state.manifest.orders))
        inputs.update(_dependencies(robot, state, package_paths))
        names = {(kind, name) for kind, found in state.manifest.names.items() for name in found}
    return RobotPaths(
        source=str(robot.source),
        inputs=frozenset(inputs),
        templates=str(robot.templates) if robot.templates else None,
        outputs=frozenset(outputs),
        package=str(robot.folder),
        built_hash=state.manifest.source.hash if state else "",
        built_names=frozenset(names),
    )


def _dependencies(robot: RobotConfig, state: State, package_paths: Sequence[Path]) -> Iterator[str]:
    """Yield the places of each dependency up to the first readable file: those behind it do not matter yet."""
    if state.model is None:
        return
    lookup = Lookup(robot.source, (*robot.package_paths, *package_paths))
    try:
        found = find_dependencies(registry.domain(robot.domain), state.model.snapshot, lookup, robot.options, {})
    except Exception:  # noqa: BLE001 - no model of the domain, or a mistake in it: the build tells it
        return
    for dependency in found:
        for path in map(str, dependency.candidates):
            yield path
            if os.path.isfile(path) and os.access(path, os.R_OK):  # noqa: PTH113
                break


class WatchedPaths(msgspec.Struct, frozen=True):
    """Where changes of the paths of all robots show; without symbolic links, as events have none."""

    by_path: Mapping[str, set[str]] = {}
    """Robots by each of their files, and by each folder and link on the way there."""
    folders: frozenset[str] = frozenset()
    """Folders to watch, without those below."""
    trees: Mapping[str, set[str]] = {}
    """Folders to watch with all folders below; if it names robots, every file there matters to these."""

    def robots_for(self, path: str) -> set[str]:
        """Return the robots to which a change of a path matters, and `CONFIG` for the configuration."""
        found = set(self.by_path.get(path, ()))
        for tree, robots in self.trees.items():
            if robots and path.startswith(f"{tree}{os.sep}"):
                found |= robots
        return found


def find_watched_paths(root: str, config_file: str, robots: Mapping[str, RobotPaths]) -> WatchedPaths:
    """Return where to look for changes of the configuration and of robots, by their names.

    `root` is the configuration's folder. Folders above it are not watched, but for the one nearest to a file that is
    found outside.
    """
    known: dict[str, tuple[str, tuple[str, ...]]] = {}
    root = _follow_links(root, known)[0]
    above = {root, *map(str, Path(root).parents)}
    by_path: dict[str, set[str]] = {}
    trees: dict[str, set[str]] = {}

    def add(path: str, robot: str) -> str:
        real, names = _follow_links(path, known)
        for name in names:
            if name not in above:
                by_path.setdefault(name, set()).add(robot)
        return real

    add(config_file, CONFIG)
    for name, robot in robots.items():
        for path in robot.inputs:
            add(path, name)
        folders = {folder: add(folder, name) for folder in {os.path.dirname(path) for path in robot.outputs}}  # noqa: PTH120
        for path in robot.outputs:  # thousands, and no links: a build refuses those
            folder, _, file = path.rpartition(os.sep)
            by_path.setdefault(f"{folders[folder]}{os.sep}{file}", set()).add(name)
        trees.setdefault(add(robot.package, name), set())
        if robot.templates:
            trees.setdefault(add(robot.templates, name), set()).add(name)
    trees = {folder: names for folder, names in trees.items() if os.path.isdir(folder)}  # noqa: PTH112
    inside = tuple(f"{tree}{os.sep}" for tree in trees)
    above.remove(root)
    watched: set[str] = set()
    for path in by_path:
        folder = os.path.dirname(path)  # noqa: PTH120
        if folder in watched or f"{folder}{os.sep}".startswith(inside) or os.path.dirname(folder) == folder:  # noqa: PTH120
            continue
        # a file that does not exist is not waited for in the folders above the configuration's
        if os.path.exists(path) if folder in above else os.path.isdir(folder):  # noqa: PTH110, PTH112
            watched.add(folder)
    return WatchedPaths(by_path, frozenset(watched), trees)


def _follow_links(
    path: str, known: dict[str, tuple[str, tuple[str, ...]]], depth: int = 0
) -> tuple[str, tuple[str, ...]]:
    """Return a path without links, and everything on the way: folders, links, their targets, and the path itself.

    `known` keeps each folder that was followed.
    """
    if path in known:
        return known[path]
    parent, name = os.path.split(path)
    if not name or depth > _MAX_LINKS:
        return path, ()
    folder, names = _follow_links(parent, known, depth)
    place = os.path.join(folder, name)  # noqa: PTH118
    result = place, (*names, place)
    try:
        target = os.readlink(place)  # noqa: PTH115
    except OSError:
        pass  # no link, or nothing at all
    else:
        real, more = _follow_links(os.path.normpath(os.path.join(folder, target)), known, depth + 1)  # noqa: PTH118
        result = real, (*result[1], *more)
    known[path] = result
    return result

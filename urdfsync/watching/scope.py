"""Which paths matter to a robot: what it is built from, what is built, and where changes of either can be seen.

Everything here is a string, since there are many of them and they are looked at often.
"""

from __future__ import annotations

import functools
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync import registry
from urdfsync.config import Config, RobotConfig, shown
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.domain import Dependency, Lookup
from urdfsync.engine import parents
from urdfsync.engine.cache import Cache
from urdfsync.engine.imports import find_dependencies
from urdfsync.files import placed
from urdfsync.state.store import State, Store
from urdfsync.watching.samples import all_files_below

_LINKS = 40
"""So many symbolic links one path may lead through, as for the system."""


class Scope(msgspec.Struct, frozen=True, dict=True):
    """The files of one robot, absolute, and what the last build recorded of its source."""

    source: str
    inputs: frozenset[str]
    """Source and dependencies, wherever they may turn up, as the configuration and the source call them."""
    templates: str | None
    """Folder of which every file matters, with those in the folders in it."""
    outputs: frozenset[str]
    """Files of the package, of the packages around it, and of the recorded state."""
    package: str
    """The package's folder."""
    built: str = ""
    """SHA-256 (hex) of the source in the last build; empty if there was none."""
    names: frozenset[tuple[str, str]] = frozenset()
    """Elements of the model in the last build: kind and name."""

    @functools.cached_property
    def folders(self) -> frozenset[str]:
        """Those that the outputs are in."""
        return frozenset([path.rpartition(os.sep)[0] for path in self.outputs])

    def ingredients(self) -> Iterator[str]:
        """All files that the robot is built from, as they are now."""
        yield from self.inputs
        yield from all_files_below(self.templates) if self.templates else ()


def scope(config: Config, robot: RobotConfig, package_paths: Sequence[Path], cache: Cache | None = None) -> Scope:
    """What matters to a robot, as far as the last build knew it; `package_paths` are those beside the robot's own."""
    state = _recorded(config, robot, cache)
    store, outputs = Store(config.root), set(parents.files(robot))
    outputs.update(map(str, store.paths(robot.name)))
    inputs = {str(robot.source)}
    if state:
        prefix = os.path.join(os.path.normpath(config.root), "")  # noqa: PTH118
        outputs.update(placed(prefix, key) for key in (*state.manifest.files, *state.manifest.orders))
        inputs.update(_candidates(_dependencies(robot, state, package_paths)))
    recorded = state.manifest.names if state else {}
    return Scope(
        source=str(robot.source),
        inputs=frozenset(inputs),
        templates=str(robot.templates) if robot.templates else None,
        outputs=frozenset(outputs),
        package=str(robot.folder),
        built=state.manifest.source.hash if state else "",
        names=frozenset((kind, name) for kind, names in recorded.items() for name in names),
    )


def _recorded(config: Config, robot: RobotConfig, cache: Cache | None) -> State | None:
    """The recorded state; None if there is none, or if it can't be read: then the build says so."""
    try:
        store = Store(config.root, shown)
        return (
            cache.get("state", store.texts(robot.name), lambda: store.load(robot.name))
            if cache
            else store.load(robot.name)
        )
    except (UrdfsyncError, OSError):
        return None


def _dependencies(robot: RobotConfig, state: State, package_paths: Sequence[Path]) -> Sequence[Dependency]:
    if state.model is None:
        return ()
    lookup = Lookup(robot.source, (*robot.package_paths, *package_paths))
    try:
        return find_dependencies(registry.domain(robot.domain), state.model.snapshot, lookup, robot.options, {})
    except Exception:  # noqa: BLE001 - no model of the domain, or a mistake in it: the build says so
        return ()


def _candidates(dependencies: Iterable[Dependency]) -> Iterator[str]:
    """Where each dependency may turn up; places behind the one where it is do not matter as long as it is there."""
    for dependency in dependencies:
        for path in map(str, dependency.candidates):
            yield path
            if os.path.isfile(path) and os.access(path, os.R_OK):  # noqa: PTH113 - many, and often
                break


class Sight(msgspec.Struct, frozen=True):
    """Where changes of some scopes can be seen; without symbolic links."""

    robots: Mapping[str, set[str]]
    """Robots by the paths whose change concerns them: their inputs, and each folder and link on the way there."""
    outputs: Mapping[str, Sequence[tuple[str, str, frozenset[str]]]]
    """By folder, the robots that have outputs in it, what they call it, and these outputs: there are thousands."""
    folders: frozenset[str]
    """Folders to watch, without those in them."""
    trees: Mapping[str, set[str]]
    """Folders to watch with all folders in them; if robots are named, every file in them matters to these."""

    def concerned(self, path: str) -> set[str]:
        """The robots to which a change of this path matters."""
        found = set(self.robots.get(path, ()))
        folder, _, file = path.rpartition(os.sep)
        found.update(
            robot for robot, called, outputs in self.outputs.get(folder, ()) if f"{called}{os.sep}{file}" in outputs
        )
        for tree, robots in self.trees.items():
            if robots and path.startswith(f"{tree}{os.sep}"):
                found |= robots
        return found


def sight(root: str, scopes: Mapping[str, Scope], others: Iterable[str] = ()) -> Sight:
    """Where to look for changes of scopes, by the name of their robots, and of `others`, which are the robot ``""``.

    `root` is the configuration's folder. What is above it is not watched, unless a file beside it is found there:
    then the nearest folder above both is.
    """
    trail = _Trail()
    root = trail.follow(root)
    above = {root, *map(str, Path(root).parents)}
    robots: dict[str, set[str]] = {}
    outputs: dict[str, list[tuple[str, str, frozenset[str]]]] = {}
    trees: dict[str, set[str]] = {}

    def add(path: str, robot: str) -> str:
        for name in trail.names(path):
            if name not in above:
                robots.setdefault(name, set()).add(robot)
        return trail.follow(path)

    for path in others:
        add(path, "")
    for name, one in scopes.items():
        for path in one.inputs:
            add(path, name)
        for folder in one.folders:  # the outputs are no links: a build refuses those
            outputs.setdefault(add(folder, name), []).append((name, folder, one.outputs))
        trees.setdefault(add(one.package, name), set())
        if one.templates:
            trees.setdefault(add(one.templates, name), set()).add(name)
    trees = {folder: names for folder, names in trees.items() if os.path.isdir(folder)}  # noqa: PTH112
    above.remove(root)
    folders = {folder for name in robots if (folder := os.path.dirname(name)) not in above or os.path.exists(name)}  # noqa: PTH110, PTH120 - many, and often
    folders |= {folder for folder, found in outputs.items() if folder not in above or any(map(_are_there, found))}
    return Sight(robots, outputs, frozenset(_alone(folders, trees)), trees)


def _are_there(entry: tuple[str, str, frozenset[str]]) -> bool:
    """Whether any of the outputs in one folder exists."""
    _, folder, outputs = entry
    return any(path.rpartition(os.sep)[0] == folder and os.path.exists(path) for path in outputs)  # noqa: PTH110


def _alone(folders: Iterable[str], trees: Iterable[str]) -> Iterator[str]:
    """The folders that exist, without those that are watched as trees."""
    inside = tuple(f"{tree}{os.sep}" for tree in trees)
    for folder in folders:
        if not _is_top(folder) and not f"{folder}{os.sep}".startswith(inside) and os.path.isdir(folder):  # noqa: PTH112
            yield folder


def _is_top(folder: str) -> bool:
    return os.path.dirname(folder) == folder  # noqa: PTH120


class _Trail:
    """Follows paths through symbolic links; folders that many paths share are followed once."""

    def __init__(self) -> None:
        self._known: dict[str, tuple[str, tuple[str, ...]]] = {}

    def follow(self, path: str) -> str:
        """Where a path leads to."""
        return self._follow(path, 0)[0]

    def names(self, path: str) -> tuple[str, ...]:
        """Everything on the way: folders, links, their targets, and at last the path's own."""
        return self._follow(path, 0)[1]

    def _follow(self, path: str, depth: int) -> tuple[str, tuple[str, ...]]:
        if path in self._known:
            return self._known[path]
        parent, name = os.path.split(path)
        if not name or depth > _LINKS:
            return path, ()
        folder, names = self._follow(parent, depth)
        place = os.path.join(folder, name)  # noqa: PTH118 - many, and often
        result = place, (*names, place)
        try:
            target = os.readlink(place)  # noqa: PTH115 - many, and often
        except OSError:
            pass  # no link, or nothing at all
        else:
            real, more = self._follow(os.path.normpath(os.path.join(folder, target)), depth + 1)  # noqa: PTH118
            result = real, (*result[1], *more)
        self._known[path] = result
        return result

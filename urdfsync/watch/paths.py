"""Finds the folders to watch for the inputs of robots. Paths are strings: there are thousands of them."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.common.dependencies.facts import LISTINGS, Entry
from urdfsync.project.config import Config

_MAX_STEPS = 1000
"""The greatest number of folders and links on the way to a file: links may lead in a circle."""
_FEW = 16
"""The greatest number of folders that are watched one by one: each takes threads. Beyond it, parents are watched."""


class WatchedFolders(msgspec.Struct, frozen=True):
    """Folders to watch. Their paths contain no symbolic links, like those of events."""

    singles: frozenset[str] = frozenset()
    """Folders to watch without the folders below them."""
    trees: frozenset[str] = frozenset()
    """Folders to watch with all folders below them."""


def find_watched_folders(
    config: Config, entries: Iterable[Entry], package_paths: Sequence[Path] = ()
) -> WatchedFolders:
    """Return the folders to watch for changes of entries, and of each folder and link on the way to an entry.

    A folder above the configuration's is watched only if it holds one of the files.
    """
    ways, places, listed = dict[str, list[str]](), set[str](), set[str]()
    for check, path in entries:
        folder, _, name = path.rpartition(os.sep)
        if check.startswith(LISTINGS) or not folder or os.path.islink(path):  # noqa: PTH114
            way = ways[path] = _way_to(path)
            listed.update(way[-1:] if check.startswith(LISTINGS) else ())
            continue
        if folder not in ways:
            ways[folder] = _way_to(folder)
        places.add(os.path.join(ways[folder][-1], name))  # noqa: PTH118
    places.update(*ways.values())
    root = _resolved(config.root)
    above = {*map(str, Path(root).parents)}
    parents = {os.path.dirname(place) for place in places - above - {root} if _shows(place, above)}  # noqa: PTH120
    tops = {config.root, *package_paths}
    for robot in config.robots:
        tops.update((robot.output, *robot.users, *robot.package_paths, *filter(None, [robot.templates])))
    tree_tops = {*map(_resolved, tops)} - above
    wanted = parents | {folder for folder in listed if _is_below(folder, tree_tops)}
    trees = {_resolved(robot.folder) for robot in config.robots}
    for top in sorted(tree_tops):
        if sum(_is_below(folder, [top]) and not _is_below(folder, trees) for folder in wanted) > _FEW:
            trees.add(top)
    trees = {tree for tree in trees if os.path.isdir(tree) and any(_is_below(folder, [tree]) for folder in wanted)}  # noqa: PTH112
    singles = (folder for folder in wanted if os.path.isdir(folder) and not _is_below(folder, trees))  # noqa: PTH112
    return WatchedFolders(frozenset(singles), frozenset(trees))


def find_places(entries: Iterable[Entry]) -> Mapping[str, set[Entry]]:
    """Return the entries to look at after an event, by the path of the event.

    The paths contain no symbolic links, like those of events; for a list of names, the path is that of its folder.
    """
    places, ways = dict[str, set[Entry]](), dict[str, str]()
    for entry in entries:
        kind, path = entry
        folder, _, name = path.rpartition(os.sep)
        if kind.startswith(LISTINGS):
            on_the_way = _way_to(path)[-1:]
        elif not folder or os.path.islink(path):  # noqa: PTH114
            on_the_way = _way_to(path)
        else:
            if folder not in ways:
                ways[folder] = _way_to(folder)[-1]
            on_the_way = [os.path.join(ways[folder], name)]  # noqa: PTH118
        for place in on_the_way:
            places.setdefault(place, set()).add(entry)
    return places


def _shows(place: str, above: set[str]) -> bool:
    """Return whether to watch the folder of a path: not the root of the disk, and not above a missing folder."""
    folder = os.path.dirname(place)  # noqa: PTH120
    return os.path.dirname(folder) != folder and (folder not in above or os.path.exists(place))  # noqa: PTH110, PTH120


def _is_below(folder: str, places: Collection[str]) -> bool:
    return f"{folder}{os.sep}".startswith(tuple(f"{place}{os.sep}" for place in places))


def _resolved(path: Path) -> str:
    return _way_to(str(path))[-1]


def _way_to(path: str) -> list[str]:
    """Return each folder and link on the way to a path, with the targets of links, and last the path without links."""
    *parts, place = reversed(Path(path).parts)
    way = [place]
    while parts and len(way) < _MAX_STEPS:
        folder, place = place, os.path.join(place, parts.pop())  # noqa: PTH118
        way.append(place)
        with contextlib.suppress(OSError):  # `place` is no link, or missing
            target = os.path.normpath(os.path.join(folder, os.readlink(place)))  # noqa: PTH115, PTH118
            *more, place = reversed(Path(target).parts)
            parts += more
    return way

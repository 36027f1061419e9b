"""Finds the folders of ROS packages and Modelica libraries by name."""

from __future__ import annotations

import functools
import itertools
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from urdfsync.common.dependencies.reads import is_file, is_folder, list_folder, read_file, scan_folder

_NAME = rb"<name>\s*([^<\s]+)\s*</name>"
_IGNORED = frozenset({"CATKIN_IGNORE", "COLCON_IGNORE", "AMENT_IGNORE"})
_MARKS = _IGNORED | {"package.xml"}
_DEPTH = 8


def find(folders: Sequence[Path], source: Path) -> Mapping[str, Path]:
    """Return the folder of each ROS package below `folders` and around `source`; for a name with several, the first.

    As in rospack, a package contains no other packages, and folders with an ignore file are skipped. Unreadable folders
    are skipped, too.
    """
    around = [(name, folder) for folder in source.parents if (name := _package_name(folder))]
    return dict(reversed([*around, *itertools.chain.from_iterable(map(_below, folders))]))


class Packages:
    """The ROS packages that one source may name. All folders are searched only once."""

    def __init__(self, folders: Sequence[Path], source: Path) -> None:
        self.folders, self.source = folders, source
        self._named: dict[str, Path | None] = {}

    def folder(self, name: str) -> Path | None:
        """Return the folder of a package: around the source, beside the source, or below the folders.

        Without a package, a folder of this name without `package.xml` counts, as for meshes; else the result is None.
        """
        if name not in self._named:
            self._named[name] = None if "\0" in name else self._find(name)  # the name may come from a stranger's file
        return self._named[name]

    @functools.cached_property
    def _all(self) -> Mapping[str, Path]:
        return find(self.folders, self.source)

    def places(self) -> dict[str, str | None]:
        """Return the folder of each package that was asked for; None for a missing one."""
        return {name: str(folder) if folder else None for name, folder in self._named.items()}

    def _find(self, name: str) -> Path | None:
        named = [folder / name for folder in (*self.folders, *self.source.parents)]
        near = [*self.source.parents, *named]
        if package := next((folder for folder in near if _package_name(folder) == name), None):
            return package
        plain = [*named, *(folder for folder in self.source.parents if folder.name == name)]
        return self._all.get(name) or next(filter(is_folder, plain), None)


def libraries(environment: Mapping[str, str]) -> Mapping[str, Path]:
    """Return the folder of each Modelica library on MODELICAPATH; for a repeated name, the folder in the first entry.

    A library is a folder `Name` or `Name VERSION` with a `package.mo`. Within an entry, the folder without a version
    comes first, then the newest version.
    """
    folders: dict[str, Path] = {}
    for entry in filter(None, environment.get("MODELICAPATH", "").split(os.pathsep)):
        folder = Path(entry).absolute()
        try:
            names = list_folder(folder)
        except OSError:  # the folder is missing or unreadable now
            continue
        for name in sorted(names, key=_precedence):
            if is_visible_file(folder / name / "package.mo"):
                folders.setdefault(name.partition(" ")[0], folder / name)
    return folders


def _precedence(name: str) -> tuple[bool, list[int], str]:
    """Return a sort key: folders without a version first, then newer versions before older versions."""
    version = name.partition(" ")[2]
    return bool(version), [-int(number) for number in re.findall("[0-9]+", version)], name


def is_visible_file(path: str | Path) -> bool:
    """Return whether a file is known to exist; False if a folder above is inaccessible."""
    try:
        return is_file(path)
    except OSError:
        return False


def _below(top: Path) -> Iterator[tuple[str, Path]]:
    waiting = [(top, 0)]
    while waiting:
        path, depth = waiting.pop()
        try:
            entries = {entry.name: entry for entry in scan_folder(path)}
        except OSError:  # the folder is missing or unreadable now
            continue
        marks = {name for name in _MARKS.intersection(entries) if not is_folder(path / name)}
        if "package.xml" in marks and marks.isdisjoint(_IGNORED) and (name := _package_name(path)):
            yield name, path
        if not marks and depth < _DEPTH:
            below = (entry.name for entry in entries.values() if entry.is_dir(follow_symlinks=False))
            waiting += [(path / name, depth + 1) for name in sorted(below, reverse=True) if not name.startswith(".")]


def _package_name(folder: Path) -> str | None:
    file = folder / "package.xml"
    try:
        match = re.search(_NAME, read_file(file)) if is_file(file) else None
    except OSError:
        return None
    return match[1].decode(errors="replace") if match else None

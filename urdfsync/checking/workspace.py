"""A folder in which a compiler finds one package and what it refers to, and nothing else that could disturb.

A compiler reads all files below a root, and one that does not parse spoils them all. So packages of other robots
are left out, unless they are mentioned.
"""

from __future__ import annotations

import codecs
import os
import re
import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path

from urdfsync import modelica
from urdfsync.config import Config, RobotConfig

_NOT_CLASSES = frozenset({"Resources"})
"""Folders of a package that hold no classes, whatever is in them."""


def package_texts(folder: Path) -> dict[str, bytes]:
    """The Modelica files below a package's folder, by their path below it; none if there is no such folder."""
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in _files(folder, frozenset())}


def surroundings(config: Config, robot: RobotConfig, texts: Mapping[str, bytes]) -> dict[str, bytes]:
    """The files of the top-level package around a robot's package, by their path below the output folder.

    Packages of other robots are among them if `texts` (the robot's own), or anything else around, mention them.
    Packages around the robot's that do not exist yet are made up.
    """
    top = robot.output / robot.target.package.partition(".")[0]
    others = {other.folder: _name(other) for other in config.robots if top in other.folder.parents}
    others.pop(robot.folder, None)
    found = _read(robot, top, frozenset({robot.folder, *others})) if top != robot.folder else {}
    waiting = [*texts.values(), *found.values()] if others else []
    while waiting:
        text = waiting.pop()
        for folder in [folder for folder, name in others.items() if _mentions(text, name)]:
            del others[folder]
            more = _read(robot, folder, frozenset(others))
            found |= more
            waiting += more.values()
    for name in _parents(robot.target.package):
        path = f"{name.replace('.', '/')}/package.mo"
        last = name.rpartition(".")[2]
        found.setdefault(path, f"{modelica.within(name)}\npackage {last}\nend {last};\n".encode())
    return found


def write(folder: Path, robot: RobotConfig, texts: Mapping[str, bytes], around: Mapping[str, bytes]) -> Path:
    """Make `folder` hold the package in `texts` with what is around it, and nothing else; gives the top-level package.

    Files that are as they should be are left alone, so that a compiler's cache of them stays good.
    """
    place = robot.target.package.replace(".", "/")
    wanted = {**around, **{f"{place}/{path}": content for path, content in texts.items()}}
    for path in [path for path in folder.rglob("*") if path.is_file()]:
        if path.relative_to(folder).as_posix() not in wanted:
            path.unlink()
    for name, content in wanted.items():
        path, content = folder / name, content.removeprefix(codecs.BOM_UTF8)
        if not (path.is_file() and path.read_bytes() == content):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
    for path in sorted(folder.rglob("*"), reverse=True):
        if path.is_dir() and not os.listdir(path):  # noqa: PTH208 - any entry will do
            shutil.rmtree(path)
    return folder / robot.target.package.partition(".")[0]


def _read(robot: RobotConfig, folder: Path, without: frozenset[Path]) -> dict[str, bytes]:
    return {path.relative_to(robot.output).as_posix(): path.read_bytes() for path in _files(folder, without)}


def _files(folder: Path, without: frozenset[Path]) -> Iterator[Path]:
    """The Modelica files of a package and of those in it, but for the folders in `without`."""
    for place, folders, files in os.walk(folder):
        here = Path(place)
        folders[:] = [
            name
            for name in sorted(folders)
            if name not in _NOT_CLASSES and not name.startswith(".") and here / name not in without
        ]
        own = (name for name in sorted(files) if not name.startswith("."))  # editors leave some that do
        yield from (here / name for name in own if name.endswith(".mo") or name == "package.order")


def _name(other: RobotConfig) -> bytes:
    return other.target.package.rpartition(".")[2].encode()


def _mentions(text: bytes, name: bytes) -> bool:
    return name in text and re.search(rb"\b" + name + rb"\b", text) is not None


def _parents(package: str) -> Iterator[str]:
    """Full names of the packages around a package."""
    parts = package.split(".")
    yield from (".".join(parts[:count]) for count in range(1, len(parts)))

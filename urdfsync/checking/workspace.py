"""A folder in which a compiler finds one package and what it refers to, and nothing else that could disturb.

A compiler reads all files below a root, and one that does not parse spoils them all. So packages of other robots
are left out, unless they are mentioned.
"""

from __future__ import annotations

import codecs
import contextlib
import os
import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path

from urdfsync.config import Config, RobotConfig, shown
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.modelica.files import files_that_use, has_word
from urdfsync.modelica.names import within

_NOT_CLASSES = frozenset({"Resources"})
"""Folders of a package that hold no classes, whatever is in them."""


def package_texts(folder: Path) -> dict[str, bytes]:
    """The Modelica files below a package's folder, by their path below it; none if there is no such folder.

    Only regular files count, and links to such; see `oddities`. Raises OutputError for one that can't be read.
    """
    return _read(folder, folder, frozenset())


def oddities(folder: Path) -> list[Path]:
    """What looks like a part of the package in `folder` and is left out, since it is no regular file or real folder.

    Links that lead nowhere, pipes and the like, and links to folders of classes. Raises OutputError.
    """
    return [path for path, regular in _entries(folder, frozenset()) if not regular]


def surroundings(config: Config, robot: RobotConfig, texts: Mapping[str, bytes]) -> dict[str, bytes]:
    """The files of the top-level package around a robot's package, by their path below the output folder.

    Packages of other robots are among them if `texts` (the robot's own), or anything else around, mention them.
    Packages around the robot's that do not exist yet are made up. Raises OutputError for a file that can't be read.
    """
    top = robot.output / robot.target.package.partition(".")[0]
    others = {other.folder: _name(other) for other in config.robots if top in other.folder.parents}
    others.pop(robot.folder, None)
    found = _read(robot.output, top, frozenset({robot.folder, *others})) if top != robot.folder else {}
    waiting = [*texts.values(), *found.values()] if others else []
    while waiting:
        text = waiting.pop()
        for folder in [folder for folder, name in others.items() if has_word(text, name)]:
            del others[folder]
            more = _read(robot.output, folder, frozenset(others))
            found |= more
            waiting += more.values()
    for name in _parents(robot.target.package):
        path = f"{name.replace('.', '/')}/package.mo"
        last = name.rpartition(".")[2]
        found.setdefault(path, f"{within(name)}\npackage {last}\nend {last};\n".encode())
    return found


def users_files(config: Config, robot: RobotConfig) -> dict[Path, bytes]:
    """The Modelica files below the output folder, in no robot's package, that have to do with the robot's package.

    They mention the package, or the class in another such file. Raises OutputError for a file that can't be read.
    """
    folders = frozenset(other.folder for other in config.robots)
    read = _read(robot.output, robot.output, folders) if robot.output not in folders else {}
    files = {robot.output / path: content for path, content in read.items() if path.endswith(".mo")}
    return files_that_use(files, [robot.target.package.rpartition(".")[2]])


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


def _read(base: Path, folder: Path, without: frozenset[Path]) -> dict[str, bytes]:
    """The files below `folder`, by their path below `base`."""
    found = {}
    for path, regular in _entries(folder, without):
        if regular:
            with _reading(), contextlib.suppress(FileNotFoundError):  # somebody deletes it at this moment
                found[path.relative_to(base).as_posix()] = path.read_bytes()
    return found


def content(file: Path) -> bytes:
    """The content of a regular file. Raises OutputError if it can't be read, FileNotFoundError if it is gone."""
    with _reading():
        return file.read_bytes()


def _entries(folder: Path, without: frozenset[Path]) -> Iterator[tuple[Path, bool]]:
    """The Modelica files of a package and of those in it, but for the folders in `without`.

    With each whether it is a regular file, or a link to one; anything else must not be opened.
    """
    for place, folders, files in os.walk(folder, onerror=_refuse):
        here = Path(place)
        folders[:] = [
            name
            for name in sorted(folders)
            if name not in _NOT_CLASSES and not name.startswith(".") and here / name not in without
        ]
        links = [here / name for name in folders if (here / name).is_symlink()]  # not followed: they may go in circles
        yield from ((link, False) for link in links if os.path.isfile(link / "package.mo"))  # noqa: PTH113
        own = (name for name in sorted(files) if not name.startswith("."))  # editors leave some that do
        paths = (here / name for name in own if name.endswith(".mo") or name == "package.order")
        yield from ((path, os.path.isfile(path)) for path in paths)  # noqa: PTH113 - no error for what can't be looked at


def _refuse(error: OSError) -> None:
    """Called for a folder that can't be listed, also for one that is not there."""
    if not isinstance(error, FileNotFoundError | NotADirectoryError):
        with _reading():
            raise error


@contextlib.contextmanager
def _reading() -> Iterator[None]:
    """Whatever the system refuses inside becomes an OutputError about the file, unless the file is gone."""
    try:
        yield
    except FileNotFoundError:
        raise
    except OSError as error:
        message, hint = f"it can't be read: {error.strerror or error}", "check the permissions of it and of its folder"
        place = shown(Path(os.fsdecode(error.filename))) if error.filename else ""
        raise OutputError(Diagnostic(Severity.ERROR, "unreadable", message, place, hint=hint)) from error


def _name(other: RobotConfig) -> bytes:
    return other.target.package.rpartition(".")[2].encode()


def _parents(package: str) -> Iterator[str]:
    """Full names of the packages around a package."""
    parts = package.split(".")
    yield from (".".join(parts[:count]) for count in range(1, len(parts)))

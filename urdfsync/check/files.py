"""The Modelica files of a package, and of what is around it: read from disk, and written where a compiler reads them.

A compiler reads all files below a folder, and one that does not parse spoils them all. So packages of other robots
are left out, unless they are mentioned.
"""

from __future__ import annotations

import codecs
import contextlib
import itertools
import os
import shutil
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path, PurePosixPath

import msgspec

from urdfsync.config import Config, RobotConfig, shown
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.modelica.files import files_that_use, has_word
from urdfsync.modelica.lexer import lex
from urdfsync.modelica.names import within

_PREFIXES = frozenset({"final", "encapsulated", "partial"})


class PackageFiles(msgspec.Struct, frozen=True):
    """A Modelica package that is stored as a folder. Paths are POSIX ones, below that folder."""

    name: str
    """Its full name, as in `Plant.Robots.Arm`."""
    folder: Path
    """Where people find it, whether or not it has been written yet."""
    texts: Mapping[str, bytes]
    """Its `.mo` and `package.order` files by path."""
    owners: Mapping[str, str] = msgspec.field(default_factory=dict)
    """The element that a file belongs to, in the domain's words: `joint elbow`."""
    edited: Collection[str] = ()
    """The files that differ from what is generated."""

    def text(self, path: str) -> str:
        """The text of a file; what is not UTF-8 in it is replaced."""
        return self.texts[path].decode("utf-8", "replace")

    def models_not_in(self, generated: Collection[str]) -> list[str]:
        """The user's models and blocks that are files and not partial, by their full names below the package."""
        own = (PurePosixPath(path) for path in sorted(self.texts) if path not in generated)
        files = [path for path in own if holds_class(path) and path.name != "package.mo"]
        return [".".join(path.with_suffix("").parts) for path in files if _is_model(self.text(str(path)), path.stem)]

    def diagnostic(
        self, severity: Severity, code: str, message: str, path: str, line: int = 0, column: int = 0, hint: str = ""
    ) -> Diagnostic:
        """A finding in one of the files, or in a folder; it names the element."""
        owner = self.owners.get(path, "")
        message = f"{owner}: {message}" if owner else message
        return Diagnostic(severity, code, message, shown(self.folder / path), line, column, hint)


def holds_class(path: PurePosixPath) -> bool:
    """Whether a file of a package is one that tools read as Modelica."""
    hidden = any(part.startswith(".") for part in path.parts)
    return path.suffix == ".mo" and not hidden and "Resources" not in path.parts[:-1]


def package_texts(folder: Path) -> dict[str, bytes]:
    """The Modelica files below a package's folder, by their path below it; none if there is no such folder.

    Only regular files count, and links to such; see `irregular_files`. Raises OutputError for one that can't be read.
    """
    return _read(folder, folder, frozenset())


def irregular_files(folder: Path) -> list[Path]:
    """What looks like a part of the package in `folder` and is left out, since it is no regular file or real folder.

    Links that lead nowhere, pipes and the like, and links to folders of classes. Raises OutputError.
    """
    return [path for path, regular in _entries(folder, frozenset()) if not regular]


def files_around(config: Config, robot: RobotConfig, texts: Mapping[str, bytes]) -> dict[str, bytes]:
    """The files of the top-level package around a robot's package, by their path below the output folder.

    Packages of other robots are among them if `texts` (the robot's own), or anything else around, mention them.
    Packages around the robot's that do not exist yet are made up. Raises OutputError for a file that can't be read.
    """
    top = robot.output / robot.target.package.partition(".")[0]
    others = {other.folder: other.target.package.rpartition(".")[2].encode() for other in config.robots}
    others = {folder: name for folder, name in others.items() if top in folder.parents and folder != robot.folder}
    found = _read(robot.output, top, frozenset({robot.folder, *others})) if top != robot.folder else {}
    waiting = [*texts.values(), *found.values()] if others else []
    while waiting:
        text = waiting.pop()
        for folder in [folder for folder, name in others.items() if has_word(text, name)]:
            del others[folder]
            more = _read(robot.output, folder, frozenset(others))
            found |= more
            waiting += more.values()
    parts = robot.target.package.split(".")
    for count in range(1, len(parts)):
        name = parts[count - 1]
        made_up = f"{within('.'.join(parts[:count]))}\npackage {name}\nend {name};\n"
        found.setdefault(f"{'/'.join(parts[:count])}/package.mo", made_up.encode())
    return found


def users_files(config: Config, robot: RobotConfig) -> dict[Path, bytes]:
    """The Modelica files below the output folder, in no robot's package, that have to do with the robot's package.

    They mention the package, or the class in another such file. Raises OutputError for a file that can't be read.
    """
    folders = frozenset(other.folder for other in config.robots)
    read = _read(robot.output, robot.output, folders) if robot.output not in folders else {}
    files = {robot.output / path: content for path, content in read.items() if path.endswith(".mo")}
    return files_that_use(files, [robot.target.package.rpartition(".")[2]])


def write_package(folder: Path, robot: RobotConfig, texts: Mapping[str, bytes], around: Mapping[str, bytes]) -> Path:
    """Make `folder` hold the package in `texts` with what is around it, and nothing else; gives the top-level package.

    Files that are as they should be are left alone, so that a compiler's cache of them stays good.
    """
    place = robot.target.package.replace(".", "/")
    wanted = {**around, **{f"{place}/{path}": content for path, content in texts.items()}}
    for path in [path for path in folder.rglob("*") if path.is_file()]:
        if path.relative_to(folder).as_posix() not in wanted:
            path.unlink()
    for name, content in wanted.items():
        path, content = folder / name, content.removeprefix(codecs.BOM_UTF8)  # rumoca refuses a byte order mark
        if not (path.is_file() and path.read_bytes() == content):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
    for path in sorted(folder.rglob("*"), reverse=True):
        if path.is_dir() and not any(path.iterdir()):
            shutil.rmtree(path)
    return folder / robot.target.package.partition(".")[0]


def _is_model(text: str, name: str) -> bool:
    """Whether a file begins with a class of this name that can be compiled by itself."""
    words = [token.text for token in lex(text)[0]]
    start = words.index(";") + 1 if words[0] == "within" and ";" in words else 0
    head = list(itertools.takewhile(lambda word: word in _PREFIXES or word in ("model", "block"), words[start:]))
    is_model = ("model" in head or "block" in head) and "partial" not in head
    return is_model and words[start + len(head)] == name


def _read(base: Path, folder: Path, without: frozenset[Path]) -> dict[str, bytes]:
    """The files below `folder`, by their path below `base`."""
    found = {}
    for path, regular in _entries(folder, without):
        if regular:
            with _reading(), contextlib.suppress(FileNotFoundError):  # somebody deletes it at this moment
                found[path.relative_to(base).as_posix()] = path.read_bytes()
    return found


def _entries(folder: Path, without: frozenset[Path]) -> Iterator[tuple[Path, bool]]:
    """The Modelica files of a package and of those in it, but for the folders in `without`.

    With each whether it is a regular file, or a link to one; a pipe, say, must not be opened.
    """
    for place, folders, files in os.walk(folder, onerror=_refuse):
        here = Path(place)
        folders[:] = [
            name
            for name in sorted(folders)
            if name != "Resources" and not name.startswith(".") and here / name not in without
        ]
        links = [here / name for name in folders if (here / name).is_symlink()]  # not followed: they may go in circles
        yield from ((link, False) for link in links if (link / "package.mo").is_file())
        own = (here / name for name in sorted(files) if not name.startswith("."))  # editors leave some that do
        yield from ((path, path.is_file()) for path in own if path.suffix == ".mo" or path.name == "package.order")


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

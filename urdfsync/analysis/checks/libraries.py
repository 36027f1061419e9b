"""Finds the Modelica libraries that a package needs, and copies the files whose classes the package names."""

from __future__ import annotations

import contextlib
import os
import re
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync.analysis.checks.cache import UserCache, cache_errors, digest
from urdfsync.analysis.checks.contents import RESOURCES, content_hash, package_texts
from urdfsync.common import system
from urdfsync.common.dependencies.facts import read_unrecorded
from urdfsync.common.diagnostics import Diagnostic, UrdfsyncError
from urdfsync.modelica.names import LIBRARY, STANDARD_LIBRARIES
from urdfsync.project.config import Config, RobotConfig, find_own_library

LibraryVersion: TypeAlias = tuple[int, ...]

OLDEST: LibraryVersion = (4, 1)  # the embedded compiler accepts no older ones
NEXT: LibraryVersion = (5,)  # newer versions are untested, and used only without an older one

_ANNOTATED_VERSION = re.compile(r'(?:^|,|\bannotation\s*\()[^\S\n]*version\s*=\s*"(\d+(?:\.\d+)*)', re.MULTILINE)
# a string or comment without an end goes on to the end of the text: else each quotation mark would look for it
_STRING_OR_REMARK = r'"(?:\\.|[^"\\])*+(?:"|\\?\Z)|//[^\n]*+|/\*.*?(?:\*/|\Z)'
_NOISE = re.compile(_STRING_OR_REMARK.encode(), re.DOTALL)
_NAME = re.compile(rf"{_STRING_OR_REMARK}|('(?:\\.|[^'\\])*+(?:'|\\?\Z)|[A-Za-z_]\w*+)", re.DOTALL)
_LIBRARY_NAME = re.compile(rb"\bimport\s+(?:\w+\s*=\s*)?\.?(\w+)|(?<![\w.\])'])\.?\b(\w+)\s*\.")
_CALLED = {"constructor", "destructor", "equalityConstraint"}
"""Functions that Modelica calls although no text names them."""
_HINT = (
    "name the folder that holds `Modelica`, `ModelicaServices` and `Complex`, 4.1.0 or newer, with `library` in the "
    "table `[check]`, or put it on MODELICAPATH"
)


def find_standard_library(configured: Path | None = None) -> Mapping[str, Path]:
    """Find the Modelica Standard Library: in the configured folder, else in the first folder with a suitable version.

    Returns the three libraries by their names: each is a folder with a `package.mo`, or a file. Raises UrdfsyncError.
    """
    candidates = list[tuple[LibraryVersion, dict[str, Path]]]()
    for place in [configured] if configured else library_folders():
        for version, path in _versions(place, "Modelica"):
            parts = {"Modelica": path}
            for name in STANDARD_LIBRARIES[1:]:  # take the part of the same version, else the newest
                others = _versions(place, name)
                if others:
                    parts[name] = dict(others).get(version, others[0][1])
            if len(parts) == len(STANDARD_LIBRARIES):
                candidates.append((version, parts))
    suitable = [(version, parts) for version, parts in candidates if version >= OLDEST]
    if suitable:
        _, parts = min(suitable, key=lambda candidate: candidate[0] >= NEXT)
        return parts
    code, message = "no-standard-library", "there is no Modelica Standard Library"
    if candidates:
        (version, parts), oldest = candidates[0], ".".join(map(str, OLDEST))
        place, number = parts["Modelica"].parent, ".".join(map(str, version)) or "of unknown version"
        code = "standard-library-too-old"
        message = f"the Modelica Standard Library in {place} is {number}; the compiler takes {oldest} and newer"
    if configured:
        code, message = "wrong-library-folder", f"{message}: `library` in the table `[check]` names {configured}"
    raise UrdfsyncError.of(code, message, hint=_HINT)


def library_folders() -> list[Path]:
    """Return the folders of libraries, each once: those on MODELICAPATH, then those of OpenModelica and Dymola."""

    def paths(name: str) -> list[Path]:
        return [Path(folder) for folder in os.environ.get(name, "").split(os.pathsep) if folder]

    homes = [Path(os.path.expanduser("~")), *paths("APPDATA")]  # noqa: PTH111 - Path.home() fails without a home
    own = [home / ".openmodelica" / "libraries" for home in homes]
    installed = [path / "lib" / "omlibrary" for path in paths("OPENMODELICAHOME")]
    installed += [Path("/usr/lib/omlibrary"), Path("/opt/openmodelica/lib/omlibrary")]
    for pattern in ("OpenModelica*/lib/omlibrary", "Dymola*/Modelica/Library"):
        installed += map(Path, system.program_files(pattern))
    return list(dict.fromkeys([*paths("MODELICAPATH"), *paths("OPENMODELICALIBRARY"), *own, *installed]))


def standard_libraries() -> list[Path]:
    """Return all versions of the three standard libraries: a compiler that finds libraries itself may take any."""
    return [path for place in library_folders() for name in STANDARD_LIBRARIES for _, path in _versions(place, name)]


def find_library(name: str, places: Iterable[Path]) -> Path | None:
    """Find the newest version of the library `name` in the first folder that has this library: a folder or a file."""
    return next((versions[0][1] for place in places if (versions := _versions(place, name))), None)


def class_finder(package: str, standard: Mapping[str, Path], places: Sequence[Path]) -> Callable[[str], Path | None]:
    """Return a function that finds the folder or file of a top-level class outside of a robot's package.

    Of the Modelica Standard Library, the function finds only the parts in `standard`.
    """

    def find(name: str) -> Path | None:
        if own := find_own_library(name, package):
            return own
        return standard.get(name) if name in STANDARD_LIBRARIES else find_library(name, places)

    return find


class Libraries(msgspec.Struct, frozen=True):
    """The libraries that a package needs, except UrdfSync."""

    standard: Mapping[str, Path]
    """The Modelica Standard Library; empty without a suitable version."""
    others: Mapping[str, Path]
    problem: Diagnostic | None = None
    """Why there is no Modelica Standard Library."""


def find_libraries(config: Config, robot: RobotConfig, texts: Iterable[bytes], wanted: Iterable[str] = ()) -> Libraries:
    """Find the libraries that the texts of a robot's package need, and `wanted` ones. Raises OutputError."""
    top, places = robot.target.package.partition(".")[0], search_path(robot)
    others = needed_libraries(texts, top, places, wanted)
    try:
        return Libraries(find_standard_library(config.check.library), others)
    except UrdfsyncError as error:
        return Libraries({}, others, error.diagnostics[0])


def search_path(robot: RobotConfig) -> list[Path]:
    """Return the folders in which to look for the libraries of a robot's package: first its own output folder."""
    return [robot.output, *library_folders()]


def needed_libraries(
    texts: Iterable[bytes], top: str, places: Sequence[Path], wanted: Iterable[str]
) -> dict[str, Path]:
    """Find the libraries in `places` that texts of the top-level package `top` need.

    These are the `wanted` libraries, the libraries that the texts name, and the libraries that these libraries need.

    A text names a library in an import, or by a name that begins with the library's name and a dot. The Modelica
    Standard Library and UrdfSync are left out. Raises OutputError for an unreadable library.
    """
    available = {path.name.removesuffix(".mo").partition(" ")[0] for place in places for path in _entries(place)}
    available -= {top, LIBRARY, *STANDARD_LIBRARIES}
    named, waiting, needed = set(wanted), list(texts), dict[str, Path]()
    while named or waiting:
        for name in sorted(named & available):
            available.remove(name)
            if path := find_library(name, places):
                needed[name] = path
                waiting += library_texts(path).values()
        code = _NOISE.sub(b"", waiting.pop()) if waiting else b""
        named = {os.fsdecode(word) for match in _LIBRARY_NAME.finditer(code) for word in match.groups() if word}
    return dict(sorted(needed.items()))


def library_texts(path: Path) -> Mapping[str, bytes]:
    """Read the files of a library, which is a folder or a file. Raises OutputError for an unreadable library."""
    return {path.name: read_unrecorded(path)} if path.suffix == ".mo" else package_texts(path)


def copy_named(parts: Mapping[str, Path], texts: Iterable[bytes], cache: UserCache) -> Path:
    """Return a folder with a copy of each library: the files whose classes `texts` name, and the files that these need.

    The compiler goes through all files for each model: a check of a six-axis arm takes 13 s and 0.6 GB with copies,
    27 s and 2 GB with whole libraries.
    Raises CacheError, OutputError for an unreadable library, and UrdfsyncError for a library with bad links.
    """
    files, hashes = dict[str, bytes](), list[str]()
    for name, path in sorted(parts.items()):
        hashes.append(content_hash(path, [RESOURCES]))
        for file, text in library_texts(path).items():
            files[f"{name}.mo" if path.suffix == ".mo" else f"{name}/{file}"] = text
    needed = _reached(files, set(parts).union(*map(_names_in, texts)))
    target = cache.libraries / digest(hashes, sorted(needed))[:16]
    with cache_errors(cache.folder):
        if not target.is_dir():
            target.parent.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryDirectory(prefix="new-", dir=target.parent) as folder:
                made = Path(folder) / "libraries"
                for file in needed:
                    (made / file).parent.mkdir(parents=True, exist_ok=True)
                    (made / file).write_bytes(files[file])
                try:
                    made.rename(target)
                except OSError:
                    if not target.is_dir():  # if the folder exists, another process was faster
                        raise
        os.utime(target)  # the cache deletes the least recently used folders
    return target


def _reached(files: Mapping[str, bytes], names: set[str]) -> set[str]:
    """Return the files that models with these names can need, by their paths.

    A file is needed if all names in its path occur in models, or in needed files. Modelica calls operators and some
    other functions without their names.
    """
    names, reached = names | _CALLED, set[str]()
    waiting = {path: path.removesuffix("/package.mo").removesuffix(".mo").split("/") for path in files}
    while found := {
        path for path, parts in waiting.items() if all(part in names or part.startswith("'") for part in parts)
    }:
        reached |= found
        names.update(*(_names_in(files[path]) for path in found))
        waiting = {path: parts for path, parts in waiting.items() if path not in found}
    return reached


def _names_in(text: bytes) -> set[str]:
    """Return the names in a text, keywords included; names in comments and strings do not count."""
    return set(_NAME.findall(text.decode("utf-8", "surrogateescape")))


def _versions(place: Path, name: str) -> list[tuple[LibraryVersion, Path]]:
    """Return all versions of a library in a folder, the newest first, an unknown version last."""
    versions = []
    for path in _entries(place):
        stem = path.name.removesuffix(".mo")
        text = path if path.suffix == ".mo" else path / "package.mo"
        if (stem == name or stem.startswith(f"{name} ")) and text.is_file():
            number = re.search(r"\d+(?:\.\d+)*", stem.removeprefix(name))
            written = None if number else _ANNOTATED_VERSION.search(text.read_text("utf-8", "replace"))
            digits = number[0] if number else written[1] if written else ""
            versions.append((tuple(map(int, digits.split("."))) if digits else (), path))
    return sorted(versions, reverse=True)


def _entries(place: Path) -> Iterator[Path]:
    with contextlib.suppress(OSError):  # a folder on a search path need not exist
        yield from list(place.iterdir())

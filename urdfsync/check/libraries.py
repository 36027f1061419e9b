"""The Modelica libraries that a package needs: where they are, and a copy of the part that robots need of the MSL."""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import sys
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync.check.cache import UserCache, cache_errors
from urdfsync.check.files import package_texts
from urdfsync.config import RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.modelica.names import LIBRARY

Version: TypeAlias = tuple[int, ...]

STANDARD = ("Modelica", "ModelicaServices", "Complex")
"""The libraries that make up the Modelica Standard Library."""
OLDEST: Version = (4, 1)  # the first that the embedded compiler takes
NEXT: Version = (5,)  # the first that is known only by its number; taken if there is no other

# The copy of these takes the compiler a fifth of the time and memory that the whole library does (5 s and 1.1 GB).
_COPIED = tuple(
    "Blocks Constants Icons Math Mechanics Units Utilities Thermal/HeatTransfer Electrical/Machines/Thermal".split()
)
_LEFT_OUT = frozenset({"Examples", "UsersGuide", "Resources"})
_COPY_REVISION = 2  # raised when other parts are copied

_NUMBERS = re.compile(r"\d+(?:\.\d+)*")
_ANNOTATED_VERSION = re.compile(r'(?:^|,|\bannotation\s*\()\s*version\s*=\s*"(\d+(?:\.\d+)*)', re.MULTILINE)
_NOISE = re.compile(rb'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)
_STANDARD_NAME = re.compile(rb"\bModelica((?:\s*\.\s*[\w*{]+)+)")
_STANDARD_ALIAS = re.compile(rb"=\s*Modelica\s*;")
_HINT = "name the folder that holds it with `library` in the table `[check]`, or put it on MODELICAPATH"


class LibraryError(UrdfsyncError):
    """There is no Modelica Standard Library that suits; the code of the one diagnostic says why."""

    def __init__(self, code: str, message: str, hint: str) -> None:
        super().__init__(Diagnostic(Severity.ERROR, code, message, hint=hint))


class StandardLibrary(msgspec.Struct, frozen=True):
    """The Modelica Standard Library: three libraries that belong together."""

    version: Version
    """Empty if unknown."""
    parts: Mapping[str, Path]
    """Its libraries by their names: each a folder with a `package.mo`, or a file."""


def find_standard_library(environment: Mapping[str, str], configured: Path | None = None) -> StandardLibrary:
    """The Modelica Standard Library: in the folder that is configured, else in the first that has one that suits.

    Raises LibraryError.
    """
    places = [configured] if configured else library_folders(environment)
    found = [library for place in places for library in _standard_libraries(place)]
    suitable = [library for library in found if library.version >= OLDEST]
    if suitable:
        return next((library for library in suitable if library.version < NEXT), suitable[0])
    oldest = _dotted(OLDEST)
    unsuitable = ""
    if found:
        place, version = found[0].parts["Modelica"].parent, _dotted(found[0].version) or "of unknown version"
        unsuitable = f"the Modelica Standard Library in {place} is {version}; the compiler takes {oldest} and newer"
    if configured and unsuitable:
        message = f"{unsuitable}, which the configuration names"
        raise LibraryError("wrong-library-folder", message, f"install {oldest} or newer, or name another folder")
    if configured:
        hint = "name the folder that holds `Modelica`, `ModelicaServices` and `Complex`"
        if (configured / "package.mo").is_file():
            hint = f"name the folder around it: {configured.parent}"
        raise LibraryError("wrong-library-folder", f"there is no Modelica Standard Library in {configured}", hint)
    if unsuitable:
        raise LibraryError("standard-library-too-old", unsuitable, f"install {oldest}; {_HINT}")
    raise LibraryError("no-standard-library", "there is no Modelica Standard Library", _HINT)


def library_folders(environment: Mapping[str, str]) -> list[Path]:
    """Where libraries are looked for: MODELICAPATH, then where OpenModelica keeps them; each once."""

    def paths(name: str) -> list[Path]:
        return [Path(folder) for folder in environment.get(name, "").split(os.pathsep) if folder]

    homes = [Path(os.path.expanduser("~")), *paths("APPDATA")]  # noqa: PTH111 - Path.home() fails without a home
    installed = [path / "lib" / "omlibrary" for path in paths("OPENMODELICAHOME")]
    if sys.platform != "win32":
        installed += [Path("/usr/lib/omlibrary"), Path("/opt/openmodelica/lib/omlibrary")]
    own = [home / ".openmodelica" / "libraries" for home in homes]
    return list(dict.fromkeys([*paths("MODELICAPATH"), *paths("OPENMODELICALIBRARY"), *own, *installed]))


def search_path(robot: RobotConfig) -> list[Path]:
    """The folders in which the libraries of a robot's package are looked for: the one of its package comes first."""
    return [robot.output, *library_folders(os.environ)]


def find_library(name: str, places: Iterable[Path]) -> Path | None:
    """The library `name` in the first of the folders that has it, in its newest version: a folder or a file."""
    for place in places:
        if versions := _versions(place, name):
            return versions[0][1]
    return None


def needed_libraries(
    texts: Iterable[bytes], top: str, places: Sequence[Path], wanted: Iterable[str]
) -> dict[str, Path]:
    """Libraries in `places` that the texts of the top-level package `top` name, those `wanted`, and what these name.

    A library is named in an import, or where its name and a dot begin a name. The Modelica Standard Library and
    UrdfSync are left out. Raises OutputError for a library that can't be read.
    """
    names = {path.name.removesuffix(".mo").partition(" ")[0] for place in places for path in _entries(place)}
    names -= {top, LIBRARY, *STANDARD}
    patterns = {name: _use_of(name) for name in names}
    found: dict[str, Path] = {}
    waiting = [_NOISE.sub(b"", text) for text in texts]
    wanted = names & set(wanted)
    while waiting or wanted:
        code = waiting.pop() if waiting else b""
        for name in sorted(wanted | {name for name, pattern in patterns.items() if pattern.search(code)}):
            del patterns[name]
            if path := find_library(name, places):
                found[name] = path
                waiting += [_NOISE.sub(b"", text) for text in library_texts(path).values()]
        wanted = set()
    return dict(sorted(found.items()))


def library_texts(path: Path) -> Mapping[str, bytes]:
    """The files of a library, which is a folder or a file. Raises OutputError for one that can't be read."""
    return {path.name: path.read_bytes()} if path.suffix == ".mo" else package_texts(path)


def standard_library_copy(library: StandardLibrary, texts: Iterable[bytes], cache: UserCache) -> Path:
    """A copy of the part of the library that robots need, or of the whole if `texts` name anything else of it.

    It is made once for each state of the library. The whole is copied as well, without its resources: the compiler
    wants all parts in one folder, and would read all that is in this one. Raises CacheError, or LibraryError for a
    library that lacks what robots need.
    """
    _check_parts(library)
    whole = not all(map(_is_in_copy, texts))
    state = repr((_COPY_REVISION, sorted(library_state(path) for path in library.parts.values())))
    key = hashlib.sha256(state.encode(errors="surrogateescape")).hexdigest()[:16]
    target = cache.libraries / f"{'whole' if whole else 'part'}-{key}"
    with cache_errors(cache.folder):
        if not target.is_dir():
            target.parent.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryDirectory(prefix="new-", dir=target.parent) as folder:
                made = Path(folder) / "library"
                _copy(library, made, None if whole else _COPIED)
                try:
                    made.rename(target)
                except OSError:
                    if not target.is_dir():  # else another process was faster
                        raise
        os.utime(target)  # the cache sees that it is in use
    return target


def library_state(path: Path) -> str:
    """SHA-256 (hex) over names, sizes and times of change of a library's files; changes whenever one of them does."""
    entries = sorted(_files_of_library(path))
    facts = [f"{file}\0{status.st_size}\0{status.st_mtime_ns}" for file in entries if (status := _status(file))]
    return hashlib.sha256("\n".join(facts).encode(errors="surrogateescape")).hexdigest()


def _files_of_library(path: Path) -> Iterator[str]:
    if path.is_file():
        yield str(path)
    for folder, folders, files in os.walk(path):
        folders[:] = [name for name in folders if name != "Resources" and not name.startswith(".")]
        yield from (os.path.join(folder, name) for name in files if name.endswith((".mo", ".order")))  # noqa: PTH118


def _status(file: str) -> os.stat_result | None:
    try:
        return os.stat(file)  # noqa: PTH116 - thousands of them
    except OSError:  # a link to nothing, say
        return None


def _is_in_copy(text: bytes) -> bool:
    """Whether the part of the Modelica Standard Library that is copied has all that a text names of it."""
    code = _NOISE.sub(b"", text)
    names = [re.sub(r"\s", "", name.decode()).strip(".").split(".") for name in _STANDARD_NAME.findall(code)]
    copied = [part.split("/") for part in _COPIED]
    covered = (any(name[: len(part)] == part for part in copied) and "Examples" not in name for name in names)
    return all(covered) and not _STANDARD_ALIAS.search(code)


def _copy(library: StandardLibrary, target: Path, parts: Sequence[str] | None) -> None:
    """Copy the library without resources and `package.order` files, of Modelica only `parts` if there are some."""
    source = library.parts["Modelica"]

    def ignored(folder: str, names: list[str]) -> set[str]:
        path = Path(folder)
        left_out = {name for name in names if name in ("Resources", "package.order") or name.startswith(".")}
        if parts is not None and path.is_relative_to(source):
            below = path.relative_to(source).parts
            left_out |= {name for name in names if name != "package.mo" and not _is_part((*below, name), parts)}
        return left_out

    target.mkdir()
    for name, path in library.parts.items():
        if path.suffix == ".mo":
            shutil.copyfile(path, target / f"{name}.mo")
        else:
            shutil.copytree(path, target / name, ignore=ignored)


def _is_part(path: tuple[str, ...], parts: Sequence[str]) -> bool:
    """Whether a file or folder is in one of the parts, or around one."""
    names = tuple(name.removesuffix(".mo") for name in path)
    if not _LEFT_OUT.isdisjoint(names):
        return False
    wanted = [tuple(part.split("/")) for part in parts]
    return any(names[: len(part)] == part[: len(names)] for part in wanted)


def _check_parts(library: StandardLibrary) -> None:
    """Raise LibraryError if a library lacks what robots need."""
    modelica = library.parts["Modelica"]
    missing = [part for part in _COPIED if not ((modelica / part).is_dir() or (modelica / f"{part}.mo").is_file())]
    if missing:
        names = " and no ".join(f"`Modelica.{part.replace('/', '.')}`" for part in missing[:3])
        message = f"the Modelica Standard Library in {modelica} is broken: there is no {names}"
        raise LibraryError("broken-standard-library", message, f"install it anew, or take another one: {_HINT}")


def _standard_libraries(place: Path) -> Iterator[StandardLibrary]:
    """The standard libraries in a folder, the newest first, each with those of its version if they are there."""
    versions = {name: _versions(place, name) for name in STANDARD}
    for version, path in versions["Modelica"]:
        parts = {"Modelica": path}
        for name in STANDARD[1:]:
            same = [other for number, other in versions[name] if number == version]
            near = [other for number, other in versions[name] if number[:1] in (version[:1], ())]
            if partners := same or near:
                parts[name] = partners[0]
        if len(parts) == len(STANDARD):
            yield StandardLibrary(version, parts)


def _versions(place: Path, name: str) -> list[tuple[Version, Path]]:
    """All versions of a library in a folder, the newest first, one without a known version last."""
    found = []
    for path in _entries(place):
        stem = path.name.removesuffix(".mo")
        text = path if path.suffix == ".mo" else path / "package.mo"
        if (stem == name or stem.startswith(f"{name} ")) and text.is_file():
            version = _version(stem.removeprefix(name))
            if not version and (written := _ANNOTATED_VERSION.search(text.read_text("utf-8", "replace"))):
                version = _version(written[1])
            found.append((version, path))
    return sorted(found, reverse=True)


def _version(text: str) -> Version:
    """The numbers in a name such as `Modelica 4.1.0`; empty if there are none."""
    numbers = _NUMBERS.search(text)
    return tuple(map(int, numbers[0].split("."))) if numbers else ()


def _dotted(version: Version) -> str:
    return ".".join(map(str, version))


def _use_of(name: str) -> re.Pattern[bytes]:
    """Matches an import of a library, and a name that it begins; not a component of something else."""
    word = re.escape(os.fsencode(name))
    return re.compile(rb"\bimport\s+(?:\w+\s*=\s*)?\.?" + word + rb"\s*[.;]|(?<![\w.\])'])\.?\b" + word + rb"\s*\.")


def _entries(place: Path) -> list[Path]:
    try:
        return list(place.iterdir())
    except OSError:
        return []  # a folder on a search path need not exist

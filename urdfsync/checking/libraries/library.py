"""Where Modelica libraries are: the standard library and others, by their top-level names."""

from __future__ import annotations

import contextlib
import hashlib
import os
import re
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError

Version = tuple[int, ...]

OLDEST: Version = (4, 1)
"""The first version of the Modelica Standard Library that the embedded compiler takes."""
NEXT: Version = (5,)
"""The first version that is known only by its number; taken if there is no other."""
PARTS = ("Modelica", "ModelicaServices", "Complex")
"""The libraries that make up the Modelica Standard Library."""

_OPENMODELICA = (Path("/usr/lib/omlibrary"), Path("/opt/openmodelica/lib/omlibrary"))
_NUMBERS = re.compile(r"\d+(?:\.\d+)*")
_VERSION = re.compile(r'(?:^|,|\bannotation\s*\()\s*version\s*=\s*"(\d+(?:\.\d+)*)', re.MULTILINE)
_HINT = "name the folder that holds it with `library` in the table `[check]`, or put it on MODELICAPATH"


class LibraryError(UrdfsyncError):
    """There is no Modelica Standard Library that suits; the code of the one diagnostic says why.

    `no-standard-library`: none was found; `standard-library-too-old`: none that is new enough;
    `wrong-library-folder`: the folder that the configuration names holds none that suits;
    `broken-standard-library`: something of it that robots need is not there.
    """


class Found(msgspec.Struct, frozen=True, order=True):
    """A library as a folder with a `package.mo`, or as a single file."""

    version: Version
    """Empty if unknown."""
    path: Path

    @property
    def text(self) -> Path:
        """The file with the library's own class."""
        return self.path if self.path.suffix == ".mo" else self.path / "package.mo"


class StandardLibrary(msgspec.Struct, frozen=True):
    """The Modelica Standard Library: three libraries that belong together."""

    modelica: Found
    services: Found
    complex: Found

    @property
    def version(self) -> str:
        """As in `4.1.0`."""
        return dotted(self.modelica.version)


def standard(environment: Mapping[str, str], home: Path, explicit: Path | None = None) -> StandardLibrary:
    """The Modelica Standard Library: in the folder `explicit` if given, else in the first that has one that suits.

    Raises LibraryError.
    """
    places = [explicit] if explicit else folders(environment, home)
    found = [library for place in places for library in _complete(place)]
    suitable = [library for library in found if library.modelica.version >= OLDEST]
    if suitable:
        return next((library for library in suitable if library.modelica.version < NEXT), suitable[0])
    if explicit is not None:
        raise LibraryError(_useless(explicit, found))
    if not found:
        raise LibraryError(_error("no-standard-library", "there is no Modelica Standard Library", _HINT))
    raise LibraryError(_error("standard-library-too-old", _unsuitable(found[0]), f"install {dotted(OLDEST)}; {_HINT}"))


def folders(environment: Mapping[str, str], home: Path) -> list[Path]:
    """Where libraries are looked for: MODELICAPATH, then where OpenModelica keeps them; each once."""
    named = [*_paths(environment, "MODELICAPATH"), *_paths(environment, "OPENMODELICALIBRARY")]
    own = [home / ".openmodelica" / "libraries"]
    own += [path / ".openmodelica" / "libraries" for path in _paths(environment, "APPDATA")]
    own += [path / "lib" / "omlibrary" for path in _paths(environment, "OPENMODELICAHOME")]
    return list(dict.fromkeys([*named, *own, *(() if sys.platform == "win32" else _OPENMODELICA)]))


def find(name: str, places: Iterable[Path]) -> Path | None:
    """The library `name` in the first of the folders that has it, in its newest version: a folder or a file."""
    for place in places:
        if versions := _versions(place, name):
            return versions[0].path
    return None


def home() -> Path:
    """The user's own folder, or `~` if nobody knows it."""
    return Path(os.path.expanduser("~"))  # noqa: PTH111 - it can't fail


def names(places: Iterable[Path]) -> set[str]:
    """The names that libraries in these folders may have."""
    return {path.name.removesuffix(".mo").partition(" ")[0] for place in places for path in _entries(place)}


def state(path: Path, *, folders_only: bool = False) -> str:
    """SHA-256 (hex) over names, sizes and times of change of a library's files; changes whenever one of them does.

    With `folders_only` it takes a third of the time, and misses files that are written to in place.
    """
    facts = sorted(_facts(path, folders_only))
    return hashlib.sha256("\n".join(facts).encode(errors="surrogateescape")).hexdigest()


def _facts(path: Path, folders_only: bool) -> Iterator[str]:
    yield _fact(str(path))
    waiting = [str(path)] if path.is_dir() else []
    while waiting:
        with contextlib.suppress(OSError), os.scandir(waiting.pop()) as entries:
            for entry in entries:
                inside = entry.is_dir(follow_symlinks=False)
                if inside and entry.name != "Resources" and not entry.name.startswith("."):
                    waiting.append(entry.path)
                    yield _fact(entry.path)
                elif not inside and not folders_only and entry.name.endswith((".mo", ".order")):
                    yield _fact(entry.path)


def _fact(path: str) -> str:
    try:
        found = os.stat(path)  # noqa: PTH116 - thousands of them
    except OSError:
        return f"{path}\0"  # a link to nothing, say
    return f"{path}\0{found.st_size}\0{found.st_mtime_ns}"


def broken(library: StandardLibrary, faults: Sequence[str]) -> LibraryError:
    """Says what is wrong with a library, as sentences without a full stop."""
    message = f"the Modelica Standard Library in {library.modelica.path} is broken: {', '.join(faults)}"
    return LibraryError(_error("broken-standard-library", message, f"install it anew, or take another one: {_HINT}"))


def dotted(version: Version) -> str:
    """As in `4.1.0`; empty if unknown."""
    return ".".join(map(str, version))


def version(text: str) -> Version:
    """The numbers in a name such as `Modelica 4.1.0`; empty if there are none."""
    numbers = _NUMBERS.search(text)
    return tuple(map(int, numbers[0].split("."))) if numbers else ()


def written_version(file: Path) -> Version:
    """The version in the annotation of a library, whose text is in `file`; empty if it has none."""
    found = _VERSION.search(file.read_text(encoding="utf-8", errors="replace"))
    return version(found[1]) if found else ()


def _complete(place: Path) -> Iterator[StandardLibrary]:
    """The standard libraries in a folder, the newest first, each with those of its version if they are there."""
    libraries, services, numbers = (_versions(place, name) for name in PARTS)
    for library in libraries:
        partners = [_partner(library, others) for others in (services, numbers)]
        if partners[0] and partners[1]:
            yield StandardLibrary(library, partners[0], partners[1])


def _partner(library: Found, others: Sequence[Found]) -> Found | None:
    """The one of the same version, else the newest of the same generation or of unknown version."""
    same = [other for other in others if other.version == library.version]
    near = [other for other in others if other.version[:1] in (library.version[:1], ())]
    return next(iter(same + near), None)


def _versions(place: Path, name: str) -> list[Found]:
    """All versions of a library in a folder, the newest first, one without a known version last."""
    found = []
    for path in _entries(place):
        stem = path.name.removesuffix(".mo")
        if stem == name or stem.startswith(f"{name} "):
            candidate = Found(version(stem.removeprefix(name)), path)
            if candidate.text.is_file():
                found.append(candidate if candidate.version else Found(written_version(candidate.text), path))
    return sorted(found, reverse=True)


def _entries(place: Path) -> list[Path]:
    try:
        return list(place.iterdir())
    except OSError:
        return []  # a folder on a search path need not exist


def _paths(environment: Mapping[str, str], name: str) -> list[Path]:
    return [Path(folder) for folder in environment.get(name, "").split(os.pathsep) if folder]


def _useless(place: Path, found: Sequence[StandardLibrary]) -> Diagnostic:
    if found:
        message = f"{_unsuitable(found[0])}, which the configuration names"
        return _error("wrong-library-folder", message, f"install {dotted(OLDEST)} or newer, or name another folder")
    hint = "name the folder that holds `Modelica`, `ModelicaServices` and `Complex`"
    if (place / "package.mo").is_file():
        hint = f"name the folder around it: {place.parent}"
    return _error("wrong-library-folder", f"there is no Modelica Standard Library in {place}", hint)


def _unsuitable(library: StandardLibrary) -> str:
    version = library.version or "of unknown version"
    found = f"the Modelica Standard Library in {library.modelica.path.parent} is {version}"
    return f"{found}; the compiler takes {dotted(OLDEST)} and newer"


def _error(code: str, message: str, hint: str) -> Diagnostic:
    return Diagnostic(Severity.ERROR, code, message, hint=hint)

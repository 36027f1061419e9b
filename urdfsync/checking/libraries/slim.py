"""A copy of the part of the Modelica Standard Library that robots need.

The compiler reads a library as a whole; the copy takes a fifth of the time and of the memory. It has all that its
own files refer to, so that a package that mentions nothing else compiles as it does with the whole library.
"""

from __future__ import annotations

import functools
import hashlib
import os
import re
import shutil
import tempfile
from collections.abc import Collection, Iterable, Iterator, Mapping
from pathlib import Path

from urdfsync.checking.cache import Cache, writing
from urdfsync.checking.libraries import references
from urdfsync.checking.libraries.library import PARTS, StandardLibrary, broken, state

REVISION = 1
"""Counts up when other parts are copied."""
_NOTE = "count.txt"
"""The file in a copy that holds the number of the others."""
_NAMED = 3
"""So many missing packages are named."""

_SEEDS = """
    Modelica.Blocks Modelica.Constants Modelica.Icons Modelica.Math Modelica.Mechanics.MultiBody
    Modelica.Mechanics.Rotational Modelica.Mechanics.Translational Modelica.Units Modelica.Utilities
""".split()
_UNNEEDED = frozenset(("Examples", "UsersGuide", "Colors", "Assemblies"))
"""Packages that are left out, and what only they need, unless something else needs them."""
_EXAMPLES = re.compile(r"^\s*package Examples\b.*?^\s*end Examples;", re.DOTALL | re.MULTILINE)
"""Examples inside another file; what they need is not copied."""


class Copies:
    """The copies of one library; what it is made of is looked at once."""

    def __init__(self, library: StandardLibrary, cache: Cache) -> None:
        """Raises LibraryError if the library lacks what robots need."""
        self._library, self._cache = library, cache
        faults = list(_faults(library, self._entries))
        if faults:
            raise broken(library, faults)

    def roots(self, names: Collection[str]) -> tuple[str, ...]:
        """What the compiler is given: a copy of the needed part if that has all of these full names, else of the whole.

        Raises CacheError.
        """
        part = self.copy()
        return (str(part if self.covers(part, names) else self.copy(whole=True)),)

    def copy(self, *, whole: bool = False) -> Path:
        """The folder with the copy, made if it is not there: once per state of the library.

        Also the `whole` library is copied, without its resources, since the compiler wants all its parts in one folder,
        and would read all that is in this one. Raises CacheError.
        """
        target = self._cache.libraries / f"{'whole' if whole else 'part'}-{self._key}"
        self._cache.prepare()
        with writing(self._cache.folder):
            try:
                os.utime(target)  # by this the cache knows that it is in use
            except FileNotFoundError:
                _make(self._library, self._entries, target, whole)
            else:
                if not _is_complete(target):
                    _remove(target)
                    _make(self._library, self._entries, target, whole)
        return target

    def covers(self, copied: Path, names: Iterable[str]) -> bool:
        """Whether the copy has the classes of these full names, or the whole library has not got them either."""
        part = _entries(copied / "Modelica")
        return all(_is_covered(name, self._entries, part) for name in names)

    @functools.cached_property
    def _entries(self) -> Mapping[str, Path]:
        return _entries(self._library.modelica.path)

    @functools.cached_property
    def _key(self) -> str:
        parts = (self._library.modelica, self._library.services, self._library.complex)
        states = [(str(one.path), one.version, state(one.path)) for one in parts]
        return hashlib.sha256(repr((REVISION, states)).encode(errors="surrogateescape")).hexdigest()[:16]


def _faults(library: StandardLibrary, entries: Mapping[str, Path]) -> Iterator[str]:
    """What makes a library useless for robots, in words."""
    for name, one in zip(PARTS, (library.modelica, library.services, library.complex), strict=True):
        if not re.search(rf"\bend\s+{name}\s*;", _text(one.text)):
            yield f"{one.text} does not hold `{name}`"
    if library.modelica.path == library.modelica.text:
        yield "it is one file, and has to be a folder"
    elif missing := [f"`{name}`" for name in _SEEDS if name not in entries]:
        yield f"there is no {' and no '.join(missing[:_NAMED])}"


def _is_covered(name: str, whole: Mapping[str, Path], part: Mapping[str, Path]) -> bool:
    stem = name.removesuffix(".*")
    if "Examples" in stem.split("."):
        return False
    if references.entry_of(stem, whole) not in part:
        return False
    if stem == name:
        return True
    inside = {entry for entry in whole if entry.rpartition(".")[0] == stem}
    return inside <= part.keys()


def _entries(package: Path, name: str = "Modelica") -> dict[str, Path]:
    """The files of a library by the full names of their classes."""
    if package.suffix == ".mo":
        return {name: package}
    found = {name: package / "package.mo"}
    with os.scandir(package) as entries:
        for entry in entries:
            stem = f"{name}.{entry.name.removesuffix('.mo')}"
            if entry.is_dir() and os.path.isfile(os.path.join(entry.path, "package.mo")):  # noqa: PTH113, PTH118
                found |= _entries(Path(entry.path), stem)
            elif entry.name.endswith(".mo") and entry.name != "package.mo" and entry.is_file():
                found[stem] = Path(entry.path)
    return found


def _make(library: StandardLibrary, entries: Mapping[str, Path], target: Path, whole: bool) -> None:
    """Make the copy beside its place, and move it there when it is complete."""
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="new-", dir=target.parent) as folder:
        made = Path(folder) / "library"
        own = _copy_partners(library, made)
        _copy_files(library.modelica.path, made / "Modelica", entries, set(entries) if whole else _needed(entries, own))
        (made / _NOTE).write_text(str(_count(made)), "utf-8")
        try:
            made.rename(target)
        except OSError:
            if not target.is_dir():  # else another process was faster
                raise


def _is_complete(copied: Path) -> bool:
    """Whether a copy has all its files: somebody who empties the cache by hand may have left a part of them."""
    try:
        return int((copied / _NOTE).read_text("utf-8")) == _count(copied)
    except (FileNotFoundError, ValueError):
        return False


def _count(copied: Path) -> int:
    """The number of files in a copy."""
    return sum(name != _NOTE for _, _, files in os.walk(copied) for name in files)


def _remove(copied: Path) -> None:
    """Delete a copy; nobody shall find half of it meanwhile."""
    with tempfile.TemporaryDirectory(prefix="old-", dir=copied.parent) as folder:
        copied.rename(Path(folder) / "library")


def _copy_partners(library: StandardLibrary, target: Path) -> list[str]:
    """Copy the two small libraries; their texts."""
    target.mkdir()
    for name, one in (("ModelicaServices", library.services), ("Complex", library.complex)):
        if one.path == one.text:
            shutil.copyfile(one.path, target / f"{name}.mo")
        else:
            shutil.copytree(one.path, target / name, ignore=shutil.ignore_patterns("Resources"))
    return [_text(path) for path in target.rglob("*.mo")]


def _needed(entries: Mapping[str, Path], partners: Iterable[str]) -> set[str]:
    seeds = [references.entry_of(name, entries) for name in references.mentioned(partners)]
    seeds += [entry for entry in entries if _is_seed(entry)]
    return references.closure(seeds, entries, lambda entry: _EXAMPLES.sub("", _text(entries[entry])))


def _copy_files(source: Path, target: Path, entries: Mapping[str, Path], needed: set[str]) -> None:
    """Copy files of a library by the names of their classes; a `package.order` loses what is not copied."""
    missing: dict[str, set[str]] = {}
    for entry in entries.keys() - needed:
        package, _, name = entry.rpartition(".")
        missing.setdefault(package, set()).add(name)
    for entry in needed:
        file = entries[entry]
        place = target / file.relative_to(source)
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, place)
        order = file.with_name("package.order")
        if file.name == "package.mo" and order.is_file():
            kept = [name for name in _text(order).split() if name not in missing.get(entry, ())]
            place.with_name("package.order").write_text("".join(f"{name}\n" for name in kept), "utf-8")


def _is_seed(entry: str) -> bool:
    wanted = any(entry == seed or entry.startswith(f"{seed}.") for seed in _SEEDS)
    return wanted and not _UNNEEDED & set(entry.split("."))


def _text(file: Path) -> str:
    return file.read_text("utf-8", "replace")

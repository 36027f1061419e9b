"""Imports the files of a source: finds and converts them; a missing file keeps its recorded copy."""

from __future__ import annotations

import contextlib
import itertools
import os
import re
import stat
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path, PurePosixPath
from typing import Any

import msgspec

from urdfsync.common.dependencies.facts import MAX_FILE
from urdfsync.common.dependencies.places import place
from urdfsync.common.dependencies.reads import file_type, read_file
from urdfsync.common.diagnostics import Diagnostic, Severity, SourceError, StateError
from urdfsync.common.files import digest, normalised, shown, text_hash
from urdfsync.domain import Dependency, Domain, Import, Lookup, Snapshot, further_key
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.sources import ros_packages
from urdfsync.project.config import RobotConfig

_POINTER = b"version https://git-lfs"
"""The beginning of a pointer of Git LFS."""
_MOST_OTHERS = 100
"""The greatest number of other files that a conversion may read."""
_IN_LIBRARY = r"\s*modelica:/*([^/.]+)"
_HINTS = {
    r"(?:https?|ftp):": "urdfsync downloads no files: download it, and let the source refer to your copy",
    # for an absolute path, no search path can help
    r"file:(?!/*\$)|[/\\]|[a-z]:[/\\]": "put it there, or let the source refer to it by a package or a relative path",
    _IN_LIBRARY: "put the folder that holds the library `{}` on MODELICAPATH",
    "[a-z]+://([^/]+)/": "put it into the package `{}`, or name the folder around that in the robot's `package_paths`",
    "": "put it there, or name the folder where this path begins in the robot's `package_paths`",
}
"""Hints for a missing file by the beginning of its URI; the first match counts."""


class RecordedFile(msgspec.Struct, frozen=True, dict=True):
    """One imported file of the last build."""

    entry: Import
    copy: bytes | None
    """The content of the file in the package."""
    written: str | None = None
    """The hashes that builds have recorded for this file."""
    is_noted: bool = False
    """Whether this machine and this version of urdfsync have converted the file."""

    @cached_property
    def hash(self) -> str:
        """The hash of the copy; empty if there is none."""
        return "" if self.copy is None else text_hash(self.copy)

    @property
    def is_intact(self) -> bool:
        """Whether the copy is unchanged since the import."""
        return self.hash == self.entry.target_hash


class Imported(msgspec.Struct):
    """The imports of the package, the available contents (by target), and findings."""

    imports: dict[str, Import] = msgspec.field(default_factory=dict)
    contents: dict[str, bytes] = msgspec.field(default_factory=dict)
    diagnostics: list[Diagnostic] = msgspec.field(default_factory=list)
    converted: set[str] = msgspec.field(default_factory=set)
    """Keys of the files that this build converted."""
    refused: list[tuple[Dependency, Path]] = msgspec.field(default_factory=list)
    """Found files that could not be converted."""

    def add(self, key: str, entry: Import, content: bytes | None) -> None:
        """Add an import; `content` is None if the file is unavailable."""
        self.imports[key] = entry
        if content is not None:
            self.contents[entry.target] = content


def places_of(dependency: Dependency) -> Iterator[tuple[str, str]]:
    """Yield key and target of each file that a dependency may become, its main file first."""
    yield dependency.key, dependency.target
    path = PurePosixPath(dependency.target)
    for number in itertools.count(1):
        yield further_key(dependency.key, number), str(path.with_stem(f"{path.stem}_{number}"))


def import_files(
    domain: Domain,
    robot: RobotConfig,
    options: BuildOptions,
    dependencies: Sequence[Dependency],
    recorded: Mapping[str, RecordedFile],
    source: str,
    *,
    has_moved: bool = False,
) -> Imported:
    """Import every dependency; `source` is the source's name in diagnostics.

    If this machine has noted a conversion of the same input, the result is used again. A full build, and a package that
    `has_moved`, convert again. A missing or unreadable file is left out, or replaced by its recorded copy. Raises
    StateError if the facts of that copy are lost.
    """
    importer = _Importer(domain, recorded, source, options.full, has_moved)
    result = importer.result
    failed: dict[tuple[str, ...], list[tuple[Dependency, Diagnostic]]] = {}
    guessed: dict[tuple[str, str], list[Dependency]] = {}
    for count, dependency in enumerate(dependencies):
        options.progress(f"{robot.name}: imports", count, len(dependencies))
        noun = dependency.noun
        content = _find(dependency)
        if dependency.guessed and isinstance(content, tuple):
            package = dependency.uri.partition("://")[2].partition("/")[0]
            guessed.setdefault((noun, package), []).append(dependency)
        if (trouble := importer.add(dependency, content)) is not None:
            trouble = importer.keep_copy(dependency, trouble)
            # one warning for all files of a package: they have the same hint
            own = dependency.key if trouble.code.startswith(f"{noun}-unreadable") else ""
            failed.setdefault((noun, trouble.code, trouble.hint, own), []).append((dependency, trouble))
    for troubles in failed.values():
        first = min((trouble for _, trouble in troubles), key=lambda trouble: trouble.line)
        if len(troubles) > 1:
            message = _not_found([dependency for dependency, _ in troubles], source).message
            end = "the imported copies are kept" if first.code.endswith("-kept") else "left out"
            first = msgspec.structs.replace(first, message=f"{message}; {end}")
        result.diagnostics.append(first)
    for (noun, package), alike in guessed.items():
        be = "is" if len(alike) == 1 else "are"
        message = f"{_named(alike)} {be} taken from a folder with another name than the package `{package}`"
        hint = "if they are the wrong ones, name the right package's folder in the robot's `package_paths`"
        line = min(dependency.line for dependency in alike)
        result.diagnostics.append(Diagnostic(Severity.NOTE, f"{noun}-guessed", message, source, line, hint=hint))
    return result


class _Importer(msgspec.Struct):
    """The imports of one source so far."""

    domain: Domain
    recorded: Mapping[str, RecordedFile]
    source: str
    """The source's name in diagnostics."""
    is_full: bool
    has_moved: bool
    result: Imported = msgspec.field(default_factory=Imported)

    def _recorded_files(self, dependency: Dependency) -> list[tuple[str, str, RecordedFile]]:
        """Return the recorded files of a dependency with their present keys and targets, the main file first."""
        places = itertools.takewhile(lambda place: place[0] in self.recorded, places_of(dependency))
        return [(key, target, self.recorded[key]) for key, target in places]

    def add(self, dependency: Dependency, content: tuple[Path, bytes] | OSError | None) -> Diagnostic | None:
        """Add one import to the result, or return why it fails; may use the recorded files of the last build."""
        code, place = f"{dependency.noun}-unreadable", (self.source, dependency.line)
        if content is None:
            return _not_found([dependency], *place)
        if isinstance(content, OSError):
            message = f"{_named([dependency])} can't be read: {content.strerror}"
            hint = f"replace it by a {dependency.noun} that can be read"
            return Diagnostic(Severity.WARNING, code, message, *place, hint=hint)
        path, text = content
        others = _read_mentioned(self.domain, dependency, path, text)
        sha256 = digest(b"".join(map(normalised, (text, *others.values()))))  # git may change the line ends
        own = self.recorded.get(dependency.key)
        # copies in a former folder may be the user's files: do not use these
        if own and own.entry.source_hash == sha256 and not (self.is_full or self.has_moved):
            facts, files = _needed(dependency, own.entry), self._recorded_files(dependency)
            if facts is not None and all(file.is_noted and file.is_intact for _, _, file in files):
                self._reuse(dependency, facts)
                return None
        if text.startswith(_POINTER):
            message = f"{_named([dependency])} can't be read: it is a Git LFS pointer"
            hint = "get the file itself with `git lfs pull`"
            return Diagnostic(Severity.WARNING, code, message, *place, hint=hint)
        try:
            conversion = self.domain.convert(dependency, path, text, others)
        except SourceError as error:
            self.result.refused.append((dependency, path))
            found = error.diagnostics[0]
            return Diagnostic(Severity.WARNING, code, found.message, *place, hint=found.hint)
        for (key, target), part in zip(places_of(dependency), (conversion, *conversion.more), strict=False):
            names = (*others,) if part is conversion else ()
            self.result.add(key, Import(target, sha256, text_hash(part.content), part.facts, names), part.content)
            self.result.converted.add(key)
        return None

    def keep_copy(self, dependency: Dependency, trouble: Diagnostic) -> Diagnostic:
        """Use the copy of an earlier build, if there is one.

        `trouble` says why the file is not imported now; the result also says whether the copy is kept.
        """
        own, files = self.recorded.get(dependency.key), self._recorded_files(dependency)
        if own is None or any(file.copy is None for _, _, file in files):
            return msgspec.structs.replace(trouble, message=f"{trouble.message}; left out")
        facts = _needed(dependency, own.entry)
        if facts is None:
            message = f"{trouble.message}, and the record of its imported copy is incomplete"
            hint = "put the file back, or restore `.urdfsync/robots` from version control"
            raise StateError.of("lost-state", message, trouble.file, trouble.line, hint=hint)
        self._reuse(dependency, facts)
        message = f"{trouble.message}; the imported copy is kept"
        return msgspec.structs.replace(trouble, code=f"{trouble.code}-kept", message=message)

    def _reuse(self, dependency: Dependency, facts: Mapping[str, Any]) -> None:
        """Use the recorded copies of a dependency again; `facts` are those of its main file."""
        for key, target, file in self._recorded_files(dependency):
            entry = file.entry
            # if the user put back an older copy, it does not belong to the recorded source
            is_older = not file.is_intact and file.hash == file.written
            is_placed_anew = self.has_moved or entry.target != target
            target_hash = file.hash if is_older or is_placed_anew else entry.target_hash
            own_facts = facts if key == dependency.key else entry.facts
            entry = msgspec.structs.replace(entry, target=target, target_hash=target_hash, facts=own_facts)
            self.result.add(key, entry, file.copy if file.hash == target_hash else None)


def _read_mentioned(domain: Domain, dependency: Dependency, path: Path, content: bytes) -> dict[str, bytes]:
    """Return the other files that a conversion needs: contents by path from the file's folder; empty if unreadable."""
    mentions = domain.imports
    contents, waiting = dict[str, bytes](), [*mentions.mentioned(dependency, path.name, content)] if mentions else []
    while mentions and waiting and len(contents) < _MOST_OTHERS and sum(map(len, contents.values())) < MAX_FILE:
        name = waiting.pop(0)
        if name not in contents:
            contents[name] = b""
            with contextlib.suppress(OSError, ValueError):  # the conversion works without this file
                contents[name] = read_file(path.parent / name)
                waiting += mentions.mentioned(dependency, name, contents[name])
    return contents


def _needed(dependency: Dependency, recorded: Import) -> Mapping[str, Any] | None:
    """Return the recorded facts that artifacts need; None if a fact is missing."""
    if not dependency.facts:
        return recorded.facts
    facts = {name: recorded.facts[name] for name in dependency.facts if name in recorded.facts}
    return facts if len(facts) == len(dependency.facts) else None


def _named(dependencies: Sequence[Dependency]) -> str:
    """Describe files with the same noun: a single file, or the number of files and the first file."""
    first, count = dependencies[0], len(dependencies)
    plural = f"{first.noun}es" if first.noun.endswith(("s", "sh", "ch", "x")) else f"{first.noun}s"
    return f"{first.noun} `{first.uri}`" if count == 1 else f"{count} {plural} (such as `{first.uri}`)"


def _not_found(dependencies: Sequence[Dependency], source: str, line: int = 0) -> Diagnostic:
    """Return one warning for missing files with the same noun and reason."""
    first, what = dependencies[0], _named(dependencies)
    others = ((path, _find_other_case(path)) for path in first.candidates)
    if found := next((at for path, at in others if at and at != path and Path(place(at)).is_file()), None):
        what, hint = f"{what} not found; there is `{shown(found)}`", "rename it, or correct the case in the source"
        return Diagnostic(Severity.WARNING, f"{first.noun}-not-found", what, source, line, hint=hint)
    beginning, match = next(
        (beginning, match)
        for beginning in _HINTS
        if (match := re.match(beginning, first.uri.strip(), re.IGNORECASE)) is not None
    )
    hint = _HINTS[beginning].format(*match.groups())
    return Diagnostic(Severity.WARNING, f"{first.noun}-not-found", f"{what} not found", source, line, hint=hint)


def find_missing(dependencies: Sequence[Dependency], source: str) -> Iterator[Diagnostic]:
    """Yield a warning for all files that are not found and have the same hint; `source` as in `import_files`."""
    missing: dict[str, list[Dependency]] = {}
    for one in dependencies:
        if not _is_found(one):
            missing.setdefault(_not_found([one], source).hint, []).append(one)
    for alike in missing.values():
        yield _not_found(alike, source, min(one.line for one in alike))


def _find_other_case(path: Path) -> Path | None:
    """Return an existing path that differs only in case: the exporter's system may ignore case."""
    try:
        is_folder = path.parent == path or Path(place(path.parent)).is_dir()
        folder = path.parent if is_folder else _find_other_case(path.parent)
        # the path is recorded as a dependency, but not this folder: it may change all the time
        names = sorted(os.listdir(place(folder))) if folder else []  # noqa: PTH208
    except OSError:
        return None
    wanted = path.name.lower()
    return next((folder / name for name in names if folder and name.lower() == wanted), None)


def find_dependencies(
    domain: Domain, snapshot: Snapshot, lookup: Lookup, options: Any, lines: Mapping[str, int]
) -> Sequence[Dependency]:
    """Return the files that a model refers to.

    MODELICAPATH is read first, if a file is in a Modelica library. ROS packages are searched only for files that are
    not found elsewhere. Last, a folder of another name is tried as the package.
    """

    def find(**known: Any) -> Sequence[Dependency]:
        nonlocal lookup
        lookup = msgspec.structs.replace(lookup, **known)
        return domain.dependencies(snapshot, lookup, options, lines)

    found = find()
    if any(re.match(_IN_LIBRARY, dependency.uri, re.IGNORECASE) for dependency in found):
        found = find(libraries=ros_packages.libraries(os.environ))
    if not all(map(_is_found, found)):
        found = find(packages=ros_packages.find(lookup.package_paths, lookup.source))
    if not all(map(_is_found, found)):
        guesses = [msgspec.structs.replace(guess, guessed=_is_found(guess)) for guess in find(guess=True)]
        found = [one if _is_found(one) else guess for one, guess in zip(found, guesses, strict=True)]
    return found


def _is_found(dependency: Dependency) -> bool:
    return any(map(ros_packages.is_visible_file, dependency.candidates))


def _find(dependency: Dependency) -> tuple[Path, bytes] | OSError | None:
    """Return the first readable candidate with its content; else the first error of a candidate, or None."""
    trouble = None
    for path in dependency.candidates:
        try:
            kind = file_type(path)
            if kind not in (0, stat.S_IFDIR):
                return path, read_file(path)
        except PermissionError:
            continue  # without permission for a folder above: try the other candidates
        except OSError as error:
            trouble = trouble or error
    return trouble

"""Files that a source refers to: found, converted if need be, and kept where they can't be found."""

from __future__ import annotations

import os
import re
import stat
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import msgspec

from urdfsync.dependencies import file_type, is_file, read_file
from urdfsync.diagnostics import Diagnostic, Severity, SourceError, StateError
from urdfsync.domain import Dependency, Domain, Import, Lookup, Snapshot
from urdfsync.engine import ros_packages as packages
from urdfsync.files import digest
from urdfsync.state.manifest import DependencyRecord
from urdfsync.state.modelfile import ConversionFacts

_POINTER = b"version https://git-lfs"
"""How a file begins that Git LFS has not replaced by its content yet."""
_ABSOLUTE = r"file:(?!/*\$)|[/\\]|[a-z]:[/\\]"
"""A place on this machine, to which search paths make no difference."""
_IN_PACKAGE = "[a-z]+://([^/]+)/"
_IN_LIBRARY = r"\s*modelica:/*([^/.]+)"


class Recorded(msgspec.Struct, frozen=True):
    """What is known of the imports of the last build, and how their copies in the package are read."""

    records: Mapping[str, DependencyRecord]
    facts: Mapping[str, ConversionFacts]
    copy: Callable[[str], bytes | None]
    """Content of an imported file, by its target."""
    base: Callable[[str], str | None]
    """Hash of what was written last, by target."""
    moved: bool = False
    """Whether the package has another folder now."""


class Imported(msgspec.Struct):
    """What is in the package now: imports, the bytes that are at hand (by target), and what there is to say."""

    imports: dict[str, Import] = msgspec.field(default_factory=dict)
    contents: dict[str, bytes] = msgspec.field(default_factory=dict)
    records: dict[str, DependencyRecord] = msgspec.field(default_factory=dict)
    diagnostics: list[Diagnostic] = msgspec.field(default_factory=list)
    hashes_only: set[str] = msgspec.field(default_factory=set)
    """Targets of which nobody has the bytes that should be there: the copy has others, and the source is gone."""


def unchanged(dependencies: Sequence[Dependency], records: Mapping[str, DependencyRecord], converter: int) -> bool:
    """Whether every dependency is as it was, as far as it can be found on this machine."""
    if {dependency.key for dependency in dependencies} != records.keys():
        return False
    for dependency in dependencies:
        record = records[dependency.key]
        if (record.uri, record.target) != (dependency.uri, dependency.target):
            return False
        found = _find(dependency)
        known = {(record.source_hash, record.converter), (record.unreadable, record.unreadable_by)}
        if isinstance(found, tuple) and (digest(found[1]), converter) not in known:
            return False
    return True


def reminder(
    dependencies: Sequence[Dependency], records: Mapping[str, DependencyRecord], source: str
) -> tuple[Diagnostic, ...]:
    """One note on what `bring_in` has left out, for a build that finds nothing to do and so imports nothing."""
    nouns = Counter(d.noun for d in dependencies if d.key in records and records[d.key].target_hash is None)
    if not nouns:
        return ()
    parts = [f"{count} {noun if count == 1 else _plural(noun)}" for noun, count in nouns.items()]
    message, hint = f"{' and '.join(parts)} left out", "`urdfsync build --full` says which, and why"
    return (Diagnostic(Severity.NOTE, "left-out", message, source, hint=hint),)


def _plural(noun: str) -> str:
    return f"{noun}es" if noun.endswith(("s", "sh", "ch", "x")) else f"{noun}s"


def bring_in(
    domain: Domain,
    dependencies: Sequence[Dependency],
    recorded: Recorded,
    source: str,
    again: bool,
    progress: Callable[[int, int], None],
) -> Imported:
    """Import every dependency; `source` is how diagnostics name the file that refers to them.

    A conversion of the last build serves again if it has the same input, unless `again`. What the last build did not
    find either is no warning again, but a note. Raises StateError if a copy must serve of which the recorded facts are
    lost.
    """
    result = Imported()
    missing: list[tuple[Dependency, Diagnostic]] = []
    known: list[Dependency] = []
    for count, dependency in enumerate(dependencies):
        progress(count, len(dependencies))
        found = _find(dependency)
        if not isinstance(found, tuple):
            record = recorded.records.get(dependency.key)
            was_missing = record is not None and record.target_hash is None and record.unreadable is None
            reason = _unreadable(dependency, source, found) if found else _not_found([dependency], source)
            trouble = _keep(dependency, recorded, result, reason)
            if was_missing and not again:
                known.append(dependency)
            else:
                missing.append((dependency, trouble))
            continue
        if dependency.guessed:
            result.diagnostics.append(_doubt(dependency, source))
        if again or not _serve(domain, dependency, digest(found[1]), recorded, result):
            _convert(domain, dependency, found, recorded, source, result)
    result.diagnostics += [*_merge_alike(missing, source), *reminder(known, result.records, source)]
    return result


def _merge_alike(missing: Sequence[tuple[Dependency, Diagnostic]], source: str) -> Iterator[Diagnostic]:
    """One warning for all files of a package, whose hint is the same."""
    groups: dict[tuple[str, ...], list[tuple[Dependency, Diagnostic]]] = {}
    for dependency, trouble in missing:
        place = "" if "not-found" in trouble.code else dependency.key
        groups.setdefault((trouble.code, trouble.hint, dependency.noun, place), []).append((dependency, trouble))
    for group in groups.values():
        first = min((trouble for _, trouble in group), key=lambda trouble: trouble.line)
        if len(group) > 1:
            message = _not_found([dependency for dependency, _ in group], source).message
            end = "the imported copies are kept" if first.code.endswith("-kept") else "left out"
            first = msgspec.structs.replace(first, message=f"{message}; {end}")
        yield first


def find_dependencies(
    domain: Domain, snapshot: Snapshot, lookup: Lookup, options: Any, lines: Mapping[str, int]
) -> Sequence[Dependency]:
    """The files that a model refers to.

    Packages are searched for only if one of them is not found without; what is not found then either is guessed.
    Modelica libraries come first for the files that are said to be in them, so MODELICAPATH is read before that.
    """
    found = domain.dependencies(snapshot, lookup, options, lines)
    if any(re.match(_IN_LIBRARY, dependency.uri, re.IGNORECASE) for dependency in found):
        lookup = msgspec.structs.replace(lookup, libraries=packages.libraries(os.environ))
        found = domain.dependencies(snapshot, lookup, options, lines)
    if all(map(_is_found, found)):
        return found
    lookup = msgspec.structs.replace(lookup, packages=packages.find(lookup.package_paths, lookup.source))
    found = domain.dependencies(snapshot, lookup, options, lines)
    if all(map(_is_found, found)):
        return found
    guesses = domain.dependencies(snapshot, msgspec.structs.replace(lookup, guess=True), options, lines)
    return [one if _is_found(one) else _guessed(guess) for one, guess in zip(found, guesses, strict=True)]


def _is_found(dependency: Dependency) -> bool:
    return any(map(_is_file, dependency.candidates))


def _guessed(dependency: Dependency) -> Dependency:
    return msgspec.structs.replace(dependency, guessed=_is_found(dependency))


def _find(dependency: Dependency) -> tuple[Path, bytes] | OSError | None:
    """The first candidate that is a file and can be read, with its content; else why one can't be, None for no file."""
    trouble = None
    for path in dependency.candidates:
        try:
            kind = file_type(path)
            if kind not in (0, stat.S_IFDIR):
                return path, read_file(path)
        except PermissionError:
            continue  # a folder above it may not let us in, and another candidate is as good
        except OSError as error:
            trouble = trouble or error
    return trouble


def _is_file(path: Path) -> bool:
    """Whether a file is there, as far as that can be told: a folder above it may not let us in."""
    try:
        return is_file(path)
    except OSError:
        return False


def _serve(domain: Domain, dependency: Dependency, source: str, recorded: Recorded, result: Imported) -> bool:
    """Use the conversion of an earlier build, if it has the same input and its copy is untouched."""
    record, facts = recorded.records.get(dependency.key), recorded.facts.get(dependency.key)
    if record is None or facts is None:
        return False
    if {(record.source_hash, record.converter), (facts.source_hash, facts.converter)} != {(source, domain.converter)}:
        return False
    copy = recorded.copy(record.target)
    if copy is None or digest(copy) != record.target_hash:
        return False
    if recorded.moved or record.target != dependency.target:
        result.contents[dependency.target] = copy
    _add(dependency, Import(dependency.target, source, digest(copy), domain.converter, facts.facts), result)
    return True


def _convert(
    domain: Domain,
    dependency: Dependency,
    found: tuple[Path, bytes],
    recorded: Recorded,
    source: str,
    result: Imported,
) -> None:
    path, content = found
    if content.startswith(_POINTER):
        _refuse(domain, dependency, content, recorded, result, _pointer(dependency, source))
        return
    try:
        conversion = domain.convert(dependency, path, content)
    except SourceError as error:
        trouble = msgspec.structs.replace(error.diagnostics[0], file=source, code="unreadable")
        _refuse(domain, dependency, content, recorded, result, trouble)
        return
    result.contents[dependency.target] = conversion.content
    hashes = digest(content), digest(conversion.content)
    _add(dependency, Import(dependency.target, *hashes, domain.converter, conversion.facts), result)


def _refuse(
    domain: Domain,
    dependency: Dependency,
    content: bytes,
    recorded: Recorded,
    result: Imported,
    trouble: Diagnostic,
) -> None:
    """Do without a file that can't be read, and remember it, so that it is tried again only if it changes."""
    result.diagnostics.append(_keep(dependency, recorded, result, trouble))
    seen = {"unreadable": digest(content), "unreadable_by": domain.converter}
    result.records[dependency.key] = msgspec.structs.replace(result.records[dependency.key], **seen)


def _pointer(dependency: Dependency, source: str) -> Diagnostic:
    message = f"{dependency.noun} `{dependency.uri}` can't be read: it is a Git LFS pointer"
    hint = "get the file itself with `git lfs pull`"
    return Diagnostic(Severity.WARNING, "unreadable", message, source, hint=hint)


def _unreadable(dependency: Dependency, source: str, error: OSError) -> Diagnostic:
    message = f"{dependency.noun} `{dependency.uri}` can't be read: {error.strerror}"
    hint = f"put a {dependency.noun} in its place that can be"
    return Diagnostic(Severity.WARNING, "unreadable", message, source, hint=hint)


def _not_found(dependencies: Sequence[Dependency], source: str) -> Diagnostic:
    """What to say of files that have the same noun and are missing for the same reason."""
    first = dependencies[0]
    one = len(dependencies) == 1
    what = (
        f"{first.noun} `{first.uri}`" if one else f"{len(dependencies)} {_plural(first.noun)} (such as `{first.uri}`)"
    )
    message, hint = f"{what} not found", "add the folder that holds it to `package_paths`"
    uri = first.uri.strip()
    if uri.lower().startswith(("http:", "https:", "ftp:")):
        message = f"{what} {'is' if one else 'are'} on the network, where urdfsync does not look"
        hint = "download it, and let the source refer to the file"
    elif re.match(_ABSOLUTE, uri, re.IGNORECASE):
        hint = "put it there, or let the source refer to it by a package or a relative path"
    elif library := re.match(_IN_LIBRARY, uri, re.IGNORECASE):
        hint = f"put the folder that holds the library `{library[1]}` on MODELICAPATH"
    elif package := re.match(_IN_PACKAGE, uri, re.IGNORECASE):
        hint = f"add the folder that holds the folder `{package[1]}` to `package_paths`"
    return Diagnostic(Severity.WARNING, "not-found", message, source, hint=hint)


def _doubt(dependency: Dependency, source: str) -> Diagnostic:
    message = f"{dependency.noun} `{dependency.uri}` is taken from a folder that is not called like its package"
    hint = "rename the folder, or add that of the right package to `package_paths`"
    code = f"{dependency.noun}-guessed"
    return Diagnostic(Severity.WARNING, code, message, source, dependency.line, hint=hint)


def _keep(dependency: Dependency, recorded: Recorded, result: Imported, trouble: Diagnostic) -> Diagnostic:
    """Without the source, the copy that an earlier build made serves; without a copy there is nothing.

    `trouble` says what is wrong with the source. Returns it as a warning, with what follows from it.
    """
    trouble = msgspec.structs.replace(
        trouble, severity=Severity.WARNING, code=f"{dependency.noun}-{trouble.code}", line=dependency.line
    )
    record = recorded.records.get(dependency.key)
    copy = recorded.copy(record.target) if record and record.target_hash else None
    if record is None or copy is None:
        result.records[dependency.key] = DependencyRecord(dependency.uri, dependency.target)
        return msgspec.structs.replace(trouble, message=f"{trouble.message}; left out")
    facts = recorded.facts.get(dependency.key)
    if facts is None or facts.source_hash != record.source_hash or record.source_hash is None:
        message = f"{trouble.message}, and what is recorded of its imported copy is lost"
        hint = "restore `.urdfsync/robots` from version control, or the file itself"
        raise StateError(Diagnostic(Severity.ERROR, "lost-state", message, trouble.file, trouble.line, hint=hint))
    copied = digest(copy)
    written = copied if copied == recorded.base(record.target) else record.target_hash or copied
    converter = facts.converter if written == record.target_hash else None  # an older copy, which was put back
    if recorded.moved or record.target != dependency.target:
        result.contents[dependency.target], written = copy, copied
    if written != copied:
        result.hashes_only.add(dependency.target)
    _add(dependency, Import(dependency.target, record.source_hash, written, converter, facts.facts), result)
    message = f"{trouble.message}; the imported copy is kept"
    return msgspec.structs.replace(trouble, code=f"{trouble.code}-kept", message=message, hint="")


def _add(dependency: Dependency, entry: Import, result: Imported) -> None:
    result.imports[dependency.key] = entry
    result.records[dependency.key] = DependencyRecord(
        dependency.uri, entry.target, entry.source_hash, entry.target_hash, entry.converter
    )

"""Versions of a model, as they are read from a file or a git revision, with all that they refer to."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Sequence
from pathlib import Path

import msgspec

from urdfsync import modelfile
from urdfsync.comparing.revisions import Revision
from urdfsync.comparing.subjects import Subject
from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.difference import Version
from urdfsync.domain import Dependency, Domain, Lookup
from urdfsync.engine import imports
from urdfsync.engine import source as engine_source
from urdfsync.files import digest

_POINTER = re.compile(rb"version https://git-lfs.*^oid sha256:([0-9a-f]{64})$", re.DOTALL | re.MULTILINE)
"""What git holds in the place of a file that is in Git LFS."""


class Source(msgspec.Struct, frozen=True):
    """What a version is read from."""

    content: bytes
    name: str
    """How diagnostics call it."""
    places: tuple[Path, ...]
    """The files from which references count, best first; absolute."""
    locate: Callable[[Sequence[Dependency]], Sequence[Dependency]] = lambda dependencies: dependencies
    """Puts the files that this version has in the place of those on disk."""


class Read(msgspec.Struct, frozen=True):
    """A version, and what there is to say about it."""

    version: Version
    imported: imports.Imported
    diagnostics: tuple[Diagnostic, ...]


def from_file(path: Path, *others: Path) -> Source:
    """The version in a file; what is not found beside it is looked for beside `others`. Raises SourceError."""
    try:
        content = path.read_bytes()
    except OSError as error:
        message, hint = f"the source can't be read: {error.strerror}", "name a file that is there and may be read"
        raise SourceError(Diagnostic(Severity.ERROR, "no-source", message, shown(path), hint=hint)) from None
    return Source(content, shown(path), (path, *others))


def from_revision(revision: Revision, path: Path, scratch: Path) -> Source:
    """The version of a file in a git revision; what it refers to and is not on disk any more goes to `scratch`.

    Raises SourceError if the revision does not have it.
    """
    content = revision.read(path)
    return Source(content, revision.label(path), (path,), lambda found: _as_they_were(found, revision, scratch))


def read(
    domain: Domain,
    subject: Subject,
    source: Source,
    package_paths: tuple[Path, ...],
    known: imports.Recorded,
    progress: Callable[[int, int], None],
) -> Read:
    """Read a source and the files that it refers to; imports that are `known` need not be converted again.

    Raises SourceError for a source that can't be read.
    """
    plain, reading = engine_source.read(domain, subject.options, source.content, source.name)
    lookups = [Lookup(place, subject.package_paths + package_paths) for place in source.places]
    found = [imports.find_dependencies(domain, plain, lookup, subject.options, reading.lines) for lookup in lookups]
    dependencies = source.locate([_joined(same) for same in zip(*found, strict=True)])
    imported = imports.bring_in(domain, dependencies, known, source.name, again=False, progress=progress)
    return Read(Version(plain, imported.imports), imported, (*reading.diagnostics, *imported.diagnostics))


def known_from(read: Read, copy: Callable[[str], bytes | None]) -> imports.Recorded:
    """What one version tells about the imports of another; `copy` reads those that it did not convert itself."""
    contents, found = read.imported.contents, read.imported.imports
    return imports.Recorded(
        records={key: record for key, record in read.imported.records.items() if key in found},
        facts={key: modelfile.ConversionFacts(i.source_hash, i.converter, dict(i.facts)) for key, i in found.items()},
        copy=lambda target: contents.get(target) or copy(target),
        base=lambda _target: None,
    )


def _joined(same: Sequence[Dependency]) -> Dependency:
    """One dependency, as it is looked for from several places."""
    candidates = dict.fromkeys(path for dependency in same for path in dependency.candidates)
    return msgspec.structs.replace(same[0], candidates=tuple(candidates))


def _as_they_were(dependencies: Sequence[Dependency], revision: Revision, scratch: Path) -> list[Dependency]:
    """The dependencies with files as a revision has them; files that no revision can have stay as they are."""
    held = {path for dependency in dependencies for path in dependency.candidates if revision.holds(path)}
    contents = revision.contents(sorted(held))
    places = {path: _place(path, content, scratch / str(n)) for n, (path, content) in enumerate(contents.items())}

    def candidates(dependency: Dependency) -> tuple[Path, ...]:
        return tuple(places.get(path, path) for path in dependency.candidates if path in places or path not in held)

    return [msgspec.structs.replace(dependency, candidates=candidates(dependency)) for dependency in dependencies]


def _place(path: Path, content: bytes, folder: Path) -> Path:
    """A file with this content: the one on disk if it is the same, else one in a folder of its own."""
    now = path.read_bytes() if os.access(path, os.R_OK) and path.is_file() else None
    pointer = _POINTER.match(content)
    if now is not None and (now == content or (pointer and digest(now) == pointer[1].decode())):
        return path
    folder.mkdir()
    (folder / path.name).write_bytes(content)
    return folder / path.name

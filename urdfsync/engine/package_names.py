"""Names that the package of the last complete build had, and what they are called now."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from pathlib import PurePosixPath

from urdfsync.engine.generation import Generation
from urdfsync.modelica.files import class_path
from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import declared


def renamed_identifiers(generation: Generation) -> dict[str, str]:
    """Return old and new identifiers of elements since the last complete build, the longest old ones first."""
    inputs = generation.inputs
    if inputs.last.version is None:
        return {}
    old = inputs.domain.names(inputs.last.version.snapshot, inputs.last.target)
    new = inputs.domain.names(generation.now.snapshot, inputs.robot.target)
    found = {inputs.last.target.name: inputs.robot.target.name}
    for kind, identifiers in old.items():
        for name, identifier in identifiers.items():
            now = generation.renames.get((kind.removesuffix("s"), name), name)
            found[identifier] = new.get(kind, {}).get(now, identifier)
    return {one: found[one] for one in sorted(found, key=len, reverse=True) if one != found[one]}


def renamed_names(generation: Generation) -> dict[str, str]:
    """Return new names by the old ones: of classes, and of what those at the top of the package declare.

    Only names that the package has no more, and those of elements that have left them to others.
    """
    inputs, renamed = generation.inputs, renamed_identifiers(generation)
    if not renamed:
        return {}
    keys = [key for key, record in inputs.last.files.items() if record.hashes and key.endswith(".mo")]
    tops = (key for key in keys if "/" not in inputs.last.folder.path(key))
    texts = (inputs.last.base(inputs.last.files[key].generated) or "" for key in tops)
    known, declared_before = known_names(generation), declared_names(texts)
    old = (declared_before | frozenset(map(class_of, keys))) - known
    # the same name is the class of a link, and of a joint: only names of parts are those of one element alone
    left = {name: new for name, new in renamed.items() if name in declared_before & known and new in known}
    left = {name: new for name, new in left.items() if name in renamed.values() and name != inputs.last.target.name}
    return left | {name: new for name in sorted(old) if (new := new_name(name, renamed, known))}


def known_names(generation: Generation) -> frozenset[str]:
    """Return the names of all generated classes, and of what those at the top of the package declare."""
    paths = generation.package.artifacts
    tops = (generation.package.content(path).decode() for path in paths if "/" not in path)
    return frozenset(map(class_of, paths)) | declared_names(tops)


def new_name(part: str, renamed: Mapping[str, str], known: Collection[str]) -> str:
    """Return the known name that `part` would have by the new identifiers; empty if there is none."""
    return next((one for one in new_names(part, renamed) if one in known), "")


def new_names(part: str, renamed: Mapping[str, str]) -> Iterator[str]:
    """Yield the names that begin with a new identifier where this one begins with the old one, the likeliest first."""
    for old, new in renamed.items():
        if part.lower().startswith(old.lower()):
            first = new[:1].upper() if part[:1].isupper() else new[:1].lower()
            yield from dict.fromkeys((f"{first}{new[1:]}{part[len(old) :]}", f"{new}{part[len(old) :]}"))
            return


def class_of(path: str) -> str:
    """Return the name of the class that a file is for, by its key or path."""
    return class_path(PurePosixPath(path)).name


def declared_names(texts: Iterable[str]) -> frozenset[str]:
    """Return the names of all classes and components that texts declare."""
    return frozenset(one.path[-1] for text in texts for one in declared(parse(text).classes, ()) if one.path)

"""Names of the last complete build's package, and their new names."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from pathlib import PurePosixPath

import msgspec

from urdfsync.domain import Domain, ElementKey, Snapshot, Target, displaced
from urdfsync.engine.decide.conflicts import Conflict
from urdfsync.engine.decide.differences import GONE, Differences
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.package.generate import Package
from urdfsync.modelica.files import class_path


def renamed_names(inputs: Inputs, generation: Generation, differences: Differences) -> dict[str, str]:
    """Return new names by old names: of classes, and of declarations in classes at the top of the package.

    The old names are those that the package lacks now, or that belong to other elements now.
    """
    if not (renamed := differences.identifiers):
        return {}
    recorded = {inputs.last.folder.path(key): base for key, base in inputs.last.files.items()}
    files = {path: base for path, base in recorded.items() if path.endswith(".mo")}
    before = declared_names(inputs.last.base(base) or "" for path, base in files.items() if "/" not in path)
    names = names_of(inputs, generation, renamed, before := before | {*map(class_of, files)})
    gone = displaced(differences.renames)
    if last := inputs.last.version if differences.renames else None:
        identifiers = elements_by_identifier(inputs.domain, last.snapshot, inputs.last.target)
        # classes of other elements declare elements without files, such as columns
        owners = {*generation.package.owners.values()}
        inner = {(kind, name) for (kind, name), new in differences.renames.items() if f"{kind} {new}" not in owners}
        names |= {name: new for name, new in renamed.items() if identifiers.get(name) in inner}
        # other elements have these names now, so a rename would be wrong
        names |= {name: f"{name}{GONE}" for name in before if identifiers.get(identifier_of(name, identifiers)) in gone}
    return names


def names_of(
    inputs: Inputs, generation: Generation, renamed: Mapping[str, str], before: frozenset[str]
) -> dict[str, str]:
    """Return the new name of each name in `before` whose identifier was renamed, by the old name."""
    now = known_names(generation.package)
    kinds = inputs.domain.names(generation.now.snapshot, inputs.robot.target).values()
    identifiers = {identifier: identifier for names in kinds for identifier in names.values()} | dict(renamed)
    names = dict[str, str]()
    for name in sorted(before):
        known = identifiers if name in now else renamed
        if name == inputs.last.target.name and name in now:
            continue
        if (new := new_name(name, known, now)) and new != name:
            names[name] = new
    return names


def known_names(package: Package) -> frozenset[str]:
    """Return the names of all generated classes, and of declarations in classes at the top of the package."""
    tops = (package.content(path).decode() for path in package.artifacts if "/" not in path)
    return frozenset(map(class_of, package.artifacts)) | declared_names(tops)


def new_name(part: str, renamed: Mapping[str, str], known: Collection[str]) -> str:
    """Return the new name of `part` by the new identifiers; empty if no known name fits."""
    return next((name for name in new_names(part, renamed) if name in known), "")


def new_names(part: str, renamed: Mapping[str, str]) -> Iterator[str]:
    """Yield possible new names, the likeliest first: the old identifier at the beginning of `part` is replaced."""
    if old := identifier_of(part, renamed):
        new = renamed[old]
        first = new[:1].upper() if part[:1].isupper() else new[:1].lower()
        yield from dict.fromkeys((f"{first}{new[1:]}{part[len(old) :]}", f"{new}{part[len(old) :]}"))


def elements_by_identifier(domain: Domain, snapshot: Snapshot, target: Target) -> dict[str, ElementKey]:
    """Return the elements of a model by their Modelica identifiers."""
    names = domain.names(snapshot, target)
    return {identifier: (kind.removesuffix("s"), name) for kind in names for name, identifier in names[kind].items()}


def identifier_of(part: str, identifiers: Collection[str]) -> str:
    """Return the longest identifier that a name begins with, in any case of the first letter; empty for none."""
    for end in range(len(part), 0, -1):
        for first in (part[0], part[0].lower(), part[0].upper()):
            if (start := first + part[1:end]) in identifiers:
                return start
    return ""


def describe_renames(
    inputs: Inputs, generation: Generation, identifiers: Mapping[str, str], conflicts: Mapping[str, Conflict]
) -> Mapping[str, Conflict]:
    """Return the conflicts with the renamed elements that their texts use, in words: `link a renamed to upper`.

    `identifiers` has new identifiers by old identifiers.
    """
    if not (identifiers and conflicts):
        return conflicts
    from urdfsync.modelica.lexer import words_in  # imports the parser

    elements = elements_by_identifier(inputs.domain, generation.now.snapshot, inputs.robot.target)
    described = dict[str, Conflict]()
    for key, conflict in conflicts.items():
        used = conflict.names.keys() & {*words_in(conflict.base or ""), *words_in(conflict.mine)}
        pairs = [(old, elements.get(identifiers.get(old, ""))) for old in {identifier_of(n, identifiers) for n in used}]
        told = sorted(f"{element[0]} {old} renamed to {element[1]}" for old, element in pairs if element)
        described[key] = msgspec.structs.replace(conflict, renamed=", ".join(told))
    return described


def class_of(path: str) -> str:
    """Return the name of a file's class, by the file's key or path."""
    return class_path(PurePosixPath(path)).name


def declared_names(texts: Iterable[str]) -> frozenset[str]:
    """Return the names of all classes and components that texts declare."""
    from urdfsync.modelica.statements import parse_without, plain_statements  # imports the parser
    from urdfsync.modelica.syntax import declared

    read = (parse_without(text, plain_statements(text)).stored for text in texts)
    return frozenset(declaration.path[-1] for stored in read for declaration in declared(stored.classes))

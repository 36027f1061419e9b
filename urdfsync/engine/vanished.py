"""Names that a build takes away, and where texts of the user's use them.

The resolver of `check` is asked about the package of the last complete build and about the package as this build leaves
it: what meant something in a text before, and means nothing now, has vanished.
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath

import msgspec

from urdfsync.config import find_own_library
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import Role, Target
from urdfsync.engine.actions import USERS, Action, Kind
from urdfsync.engine.generation import Generation
from urdfsync.files import shown
from urdfsync.modelica.files import ClassName, StoredClasses, class_path
from urdfsync.modelica.lexer import lex
from urdfsync.modelica.parser import parse
from urdfsync.modelica.scopes import Scopes
from urdfsync.modelica.syntax import declared
from urdfsync.modelica.unresolved import Unresolved, UnresolvedKind, unresolved
from urdfsync.state.record import Choice

_LEGAL = (UnresolvedKind.NESTED_REDECLARE, UnresolvedKind.DOTTED_MODIFIER)
_CLASS_KINDS = frozenset({"block", "class", "connector", "function", "model", "package", "record", "type"})


class VanishedNames(msgspec.Struct, frozen=True):
    """The uses of names that are gone, in the order of their lines."""

    in_package: Mapping[str, Sequence[Unresolved]]
    """By the key of the file in which they are."""
    elsewhere: Mapping[Path, Sequence[Unresolved]]
    """In files outside of the package."""


class _Texts(msgspec.Struct, frozen=True):
    """The user's texts, in which names are looked up."""

    own: Mapping[str, str]
    """Models of the user's inside of the package, by key."""
    edited: Mapping[str, str]
    """Generated files that the user edited, by the key that they get; those of renamed elements move."""
    places: Mapping[str, str]
    """Where each edited file is now: key by key."""
    around: Mapping[Path, bytes]
    """Models outside of the package that have to do with it."""


def find_vanished(generation: Generation, actions: Sequence[Action], merged: Mapping[str, str]) -> VanishedNames:
    """Find names that meant something in the last complete build, and mean nothing once all actions are done.

    Looked at are edited files, `merged` ones (texts by key) and models of the user's, inside of the package and around.
    """
    inputs, texts = generation.inputs, _users_texts(generation, actions)
    if not (texts.own or texts.edited or texts.around):
        return VanishedNames({}, {})
    stored_before, stored_after, doubtful = _packages(generation, actions, texts, merged)
    before, after = Scopes(stored_before), Scopes(stored_after)

    def vanished(name: ClassName, old_name: ClassName) -> list[Unresolved]:
        known = {one.name for one in _unresolved(old_name, before, doubtful)}
        found = (one for one in _unresolved(name, after, doubtful) if one.kind not in _LEGAL)
        return sorted((one for one in found if one.name not in known), key=lambda one: one.line)

    package, old_package = inputs.robot.target.package, inputs.old_target.package
    in_package = {}
    for key in (*texts.own, *texts.edited):
        old_name = _class_name(old_package, inputs.old_path(texts.places.get(key, key)))
        in_package[key] = vanished(_class_name(package, inputs.path(key)), old_name)
    elsewhere: dict[Path, list[Unresolved]] = {}
    for name, node in stored_after.users.items():
        elsewhere.setdefault(Path(node.file), []).extend(vanished(name, name))
    return VanishedNames(
        {key: found for key, found in in_package.items() if found},
        {file: found for file, found in elsewhere.items() if found},
    )


def find_misfits(
    generation: Generation, actions: Sequence[Action], merged: Mapping[str, str], keys: Collection[str]
) -> dict[str, list[Unresolved]]:
    """Return the uses of names that mean nothing once all actions are done, by the key of the file; of some files."""
    if not keys:
        return {}
    _, stored, doubtful = _packages(generation, actions, _users_texts(generation, actions), merged)
    inputs, scopes, found = generation.inputs, Scopes(stored), dict[str, list[Unresolved]]()
    for key in keys:
        name = _class_name(inputs.robot.target.package, inputs.path(key))
        uses = [one for one in _unresolved(name, scopes, doubtful) if one.kind not in _LEGAL]
        if uses:
            found[key] = sorted(uses, key=lambda one: one.line)
    return found


def misfit_warnings(generation: Generation, found: Mapping[str, Sequence[Unresolved]]) -> Iterator[Diagnostic]:
    """A warning for each kept file that does not fit the package, with the first name that it mentions in vain."""
    for key, (first, *_) in found.items():
        file = shown(generation.inputs.files.path(key))
        message = f"kept, does not fit: it mentions `{first.part}`, which the package does not have"
        hint = f"change that, or `urdfsync resolve {file} --merge`"
        yield Diagnostic(Severity.WARNING, "does-not-fit", message, file, first.line, hint=hint)


def _users_texts(generation: Generation, actions: Sequence[Action]) -> _Texts:
    inputs, files = generation.inputs, generation.inputs.files
    written = {action.path for action in actions} | inputs.recorded_files.keys()
    places = {action.path: action.origin or action.path for action in actions if action.kind in USERS}
    around = dict(files.users_files({inputs.folder, inputs.old_folder}))
    if inputs.has_moved:
        left = files.classes(inputs.old_folder) - written
        around |= {files.path(key): files.any_text(key).encode() for key in left}
    return _Texts(
        own={key: files.any_text(key) for key in files.classes(inputs.folder) - written},
        edited={key: files.any_text(place) for key, place in places.items()},
        places=places,
        around=around,
    )


def _packages(
    generation: Generation, actions: Sequence[Action], texts: _Texts, merged: Mapping[str, str]
) -> tuple[StoredClasses, StoredClasses, frozenset[str]]:
    """Return the package of the last complete build and as this build leaves it, with the user's texts in both.

    Also the names that count as gone where a class inherits from a library that is not at hand.
    """
    inputs, files = generation.inputs, generation.inputs.files
    before = {
        key: generation.base(key, record.generated) or ""
        for key, record in inputs.recorded_files.items()
        if record.hashes and key.endswith(".mo")
    }
    after = {inputs.key(path): generation.content(inputs.key(path)).decode() for path in generation.package.artifacts}
    doubtful = _lost_parts(generation, before, after)
    before |= {place: texts.edited[key] for key, place in texts.places.items()}
    if not inputs.has_moved:
        before |= texts.own
    staying = {action.path for action in actions if action.kind is Kind.NEEDED or action.released}
    after |= {**texts.own, **{key: files.any_text(key) for key in staying}, **texts.edited, **merged}
    return (
        _classes(generation, inputs.old_target, inputs.old_folder, before, texts.around, now=False),
        _classes(generation, inputs.robot.target, inputs.folder, after, texts.around, now=True),
        doubtful,
    )


def warnings(generation: Generation, found: VanishedNames) -> Iterator[Diagnostic]:
    """A warning for each name that is gone in each text: where, and what it is now."""
    files = generation.inputs.files
    uses = [*((files.path(key), one) for key, one in found.in_package.items()), *found.elsewhere.items()]
    renamed = _renamed_identifiers(generation) if uses else {}
    known = _known_names(generation) if uses else frozenset()
    for file, all_uses in uses:
        by_part: dict[str, list[Unresolved]] = {}
        for use in all_uses:
            by_part.setdefault(use.part, []).append(use)
        for part, (first, *more) in by_part.items():
            hint = _hint(generation, part, _new_name(part, renamed, known))
            if lines := sorted({use.line for use in more} - {first.line}):
                hint += f"; also in line{'s' if len(lines) > 1 else ''} {', '.join(map(str, lines))}"
            message = f"`{first.name}` is used here, but the package has no `{part}` any more"
            yield Diagnostic(Severity.WARNING, "vanished-name", message, shown(file), first.line, hint=hint)


def _hint(generation: Generation, part: str, new_name: str) -> str:
    inputs = generation.inputs
    if new_name:
        return f"use `{new_name}` instead"
    paths = (inputs.old_path(key) for key in inputs.recorded_files if class_of(key) == part)
    options = (inputs.domain.option_for(path, inputs.old_target, inputs.robot.options) for path in paths)
    if option := next(filter(None, options), ""):
        return f"`{option}` in the configuration brings it back"
    return "change or remove this use: nothing has taken its place"


def _renamed_identifiers(generation: Generation) -> dict[str, str]:
    """Return old and new identifiers of elements since the last complete build, the longest old ones first."""
    inputs = generation.inputs
    if inputs.last is None:
        return {}
    old = inputs.domain.names(inputs.last.snapshot, inputs.old_target)
    new = inputs.domain.names(generation.now.snapshot, inputs.robot.target)
    found = {inputs.old_target.name: inputs.robot.target.name}
    for kind, identifiers in old.items():
        for name, identifier in identifiers.items():
            now = generation.renames.get((kind.removesuffix("s"), name), name)
            found[identifier] = new.get(kind, {}).get(now, identifier)
    return {one: found[one] for one in sorted(found, key=len, reverse=True) if one != found[one]}


def renamed_names(generation: Generation) -> dict[str, str]:
    """Return new names by the old ones: of classes, and of what those at the top of the package declare.

    Only names that the package has no more.
    """
    inputs, renamed = generation.inputs, _renamed_identifiers(generation)
    if not renamed:
        return {}
    keys = [key for key, record in inputs.recorded_files.items() if record.hashes and key.endswith(".mo")]
    tops = (key for key in keys if "/" not in inputs.old_path(key))
    texts = (generation.base(key, inputs.recorded_files[key].generated) or "" for key in tops)
    known = _known_names(generation)
    old = (_declared(texts) | frozenset(map(class_of, keys))) - known
    return {name: new for name in sorted(old) if (new := _new_name(name, renamed, known))}


def _known_names(generation: Generation) -> frozenset[str]:
    """Return the names of all generated classes, and of what those at the top of the package declare."""
    paths = generation.package.artifacts
    tops = (generation.content(generation.inputs.key(path)).decode() for path in paths if "/" not in path)
    return frozenset(map(class_of, paths)) | _declared(tops)


def _new_name(part: str, renamed: Mapping[str, str], known: Collection[str]) -> str:
    """Return the known name that begins with the new identifier where this one begins with the old one; else ``."""
    for old, new in renamed.items():
        if part.lower().startswith(old.lower()):
            first = new[:1].upper() if part[:1].isupper() else new[:1].lower()
            candidates = (f"{first}{new[1:]}{part[len(old) :]}", f"{new}{part[len(old) :]}")
            return next((one for one in candidates if one in known), "")
    return ""


def _classes(
    generation: Generation,
    target: Target,
    folder: str,
    texts: Mapping[str, str],
    around: Mapping[Path, bytes],
    now: bool,
) -> StoredClasses:
    """The classes of a package with these texts, and of the user's files around it.

    `now` tells whether the package is that of this build; then nothing that is in a former folder counts.
    """
    inputs, robot = generation.inputs, generation.inputs.robot
    contents = {key.removeprefix(f"{folder}/"): text.encode(errors="replace") for key, text in texts.items()}
    parents = {one.path: one.content for one in inputs.parents.shared if one.content is not None} if now else {}

    def find(name: str) -> Path | None:
        if own := find_own_library(name, target.package):
            return own
        places = (robot.output / name, robot.output / f"{name}.mo")
        return next((path for path in places if path.is_file() or (path / "package.mo").is_file()), None)

    former = inputs.old_target.package if now and inputs.old_target.package != target.package else ""
    return StoredClasses(target.package, inputs.files.path(folder), contents, {**around, **parents}, find, former)


def _unresolved(name: ClassName, scopes: Scopes, doubtful: Collection[str]) -> Iterator[Unresolved]:
    """All that means nothing in a stored class; nothing if there is no such class, or if it can't be read."""
    node = scopes.node(name)
    return iter(()) if node is None else unresolved(node, scopes, doubtful)


def _class_name(package: str, path: str) -> ClassName:
    return (*package.split("."), *class_path(PurePosixPath(path)).parts)


def class_of(path: str) -> str:
    """Return the name of the class that a file is for, by its key or path."""
    return class_path(PurePosixPath(path)).name


def _lost_parts(generation: Generation, before: Mapping[str, str], after: Mapping[str, str]) -> frozenset[str]:
    """Return the names of generated classes and of their parts that are no longer generated.

    Where a class inherits from a library that is not at hand, such a name counts as gone.
    """
    new_keys, found = {old: new for new, old in generation.moves.items()}, set[str]()
    for key, text in before.items():
        now = after.get(new_keys.get(key, key))
        if now != text:
            found |= {class_of(key)} if now is None else _declared([text]) - _declared([now])
    return frozenset(found)


def _declared(texts: Iterable[str]) -> frozenset[str]:
    """Return the names of all classes and components that texts declare."""
    return frozenset(one.path[-1] for text in texts for one in declared(parse(text).classes, ()) if one.path)


def code_words(text: str) -> set[str]:
    """Return all names and keywords in a text, without those in strings and comments, and without the classes in it.

    Left out are the packages that it stands in, too: one may be called like the robot's model. An edited file whose
    element has another name may still declare its class by the old one. The text need not parse.
    """
    found = [token.text for token in lex(text)[0]]
    if found[:1] == ["within"]:
        found = found[[*found, ";"].index(";") :]
    return set(found) - {name for kind, name in itertools.pairwise(found) if kind in _CLASS_KINDS}


def mentioned_files(generation: Generation, actions: Sequence[Action], merged: Mapping[str, str]) -> frozenset[str]:
    """Return the files that are no longer generated and that the user's texts need.

    These are records that any of his texts mentions, edited files included; but those that a renamed element left are
    not: he is told the new name. What a file that he keeps mentions stays whatever it is, and so does what is mentioned
    or shown by what stays.
    """
    inputs, files, before = generation.inputs, generation.inputs.files, generation.last_package
    leaving = {one.path: one for one in actions if one.kind is Kind.DELETE}
    texts = inputs.users_classes([one for one in actions if one.kind in USERS], actions, merged)
    around = files.users_files({inputs.folder, inputs.old_folder})
    all_words = {word for text in texts.values() for word in code_words(text)}
    all_words |= {word for content in around.values() for word in code_words(content.decode(errors="replace"))}
    kept = {one.path for one in actions if one.choice is Choice.KEEP and one.kind in USERS}
    kept_words = {word for key in kept & texts.keys() for word in code_words(texts[key])}
    left = set(generation.moves.values())
    used = set()
    for path, action in leaving.items():
        was_needed = before is not None and inputs.old_path(path) not in before.artifacts
        is_record = action.role is Role.RECORD and path not in left
        if class_of(path) in (all_words if is_record or was_needed else kept_words) and path.endswith(".mo"):
            used.add(path)
    found = set(used)
    while used:
        needed = [files.any_text(path) for path in used]
        words = {word for text in needed for word in code_words(text)}
        used = {
            path
            for path in leaving.keys() - found
            if (
                class_of(path) in words if path.endswith(".mo") else any(inputs.old_path(path) in one for one in needed)
            )
        }
        found |= used
    return frozenset(found)

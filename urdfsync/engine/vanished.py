"""Names that a build takes away, and where texts of the user's use them.

The resolver of `check` is asked about the package of the last complete build and about the package as this build leaves
it: what meant something in a text before, and means nothing now, has vanished.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath

import msgspec

from urdfsync.config import find_own_library
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import Target, brings_back
from urdfsync.engine.actions import USERS, Action, Kind
from urdfsync.engine.generation import Generation
from urdfsync.engine.needed import code_words
from urdfsync.engine.package_files import encode
from urdfsync.engine.package_names import (
    class_of,
    declared_names,
    known_names,
    new_name,
    new_names,
    renamed_identifiers,
)
from urdfsync.files import shown
from urdfsync.modelica.classes import Node
from urdfsync.modelica.files import ClassName, StoredClasses, class_path
from urdfsync.modelica.scopes import Scopes
from urdfsync.modelica.unresolved import Unresolved, UnresolvedKind, unresolved

_LEGAL = (UnresolvedKind.NESTED_REDECLARE, UnresolvedKind.DOTTED_MODIFIER)


class VanishedNames(msgspec.Struct, frozen=True):
    """The uses of names that are gone, in the order of their lines."""

    in_package: Mapping[str, Sequence[Unresolved]]
    """By the key of the file in which they are."""
    elsewhere: Mapping[Path, Sequence[Unresolved]]
    """In files outside of the package."""
    reused: Sequence[tuple[Path, Unresolved]] = ()
    """Uses, in files of the user's, of names that another element has now."""


class UsersTexts(msgspec.Struct, frozen=True):
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
    inputs, texts = generation.inputs, users_texts(generation, actions)
    if not (texts.own or texts.edited or texts.around):
        return VanishedNames({}, {})
    before = Scopes(package_before(generation, texts))
    after = Scopes(package_after(generation, actions, merged, texts))
    doubtful = _lost_parts(generation, _recorded(generation), _generated(generation))

    def vanished(node: Node | None, old_node: Node | None, brought: Collection[str] = ()) -> list[Unresolved]:
        known = {(one.name, one.part) for one in unresolved(old_node, before, doubtful)} if old_node else set()
        found = unresolved(node, after, doubtful) if node else ()
        new = [one for one in found if one.kind not in _LEGAL and (one.name, one.part) not in known]
        if node and brought:  # is not taken for inherited from a library that is not at hand
            more = (one for one in unresolved(node, after, brought) if one.owner == str(node))
            new += [one for one in more if one not in new and one.name.partition(".")[0] == one.part in brought]
        return sorted(new, key=lambda one: one.line)

    package, old_package = inputs.robot.target.package, inputs.old_target.package
    in_package = {}
    for key in (*texts.own, *texts.edited):
        old_name = class_name(old_package, inputs.old_path(texts.places.get(key, key)))
        brought = code_words(merged[key]) - code_words(texts.edited[key]) if key in merged else ()
        node = after.node(class_name(package, inputs.path(key)))
        in_package[key] = vanished(node, before.node(old_name), brought)
    elsewhere: dict[Path, list[Unresolved]] = {}
    old_nodes = {(node.file, node.name): node for node in before.users()}
    for node in after.users():
        elsewhere.setdefault(Path(node.file), []).extend(vanished(node, old_nodes.get((node.file, node.name))))
    return VanishedNames(
        {key: found for key, found in in_package.items() if found},
        {file: found for file, found in elsewhere.items() if found},
        [*_find_reused(generation, actions, merged, before, after)],
    )


def _find_reused(
    generation: Generation, actions: Sequence[Action], merged: Mapping[str, str], before: Scopes, after: Scopes
) -> Iterator[tuple[Path, Unresolved]]:
    """Yield the uses of names that another element has now.

    They mean something before and after, and nothing as soon as the package lacks these names.
    """
    known, reused = known_names(generation), _reused(renamed_identifiers(generation))
    names = {name for name in known if new_name(name, reused, known)}
    if not names:
        return
    scopes = Scopes(package_after(generation, actions, merged, users_texts(generation, actions), names))
    old_nodes = {(node.file, node.name): node for node in before.users()}
    for node, lacking in zip(after.users(), scopes.users(), strict=True):
        old_node = old_nodes.get((node.file, node.name))
        pairs = ((node, after), (old_node, before)) if old_node else ((node, after),)
        missing = {use.start for one, places in pairs for use in unresolved(one, places, names)}
        uses = (use for use in unresolved(lacking, scopes, names) if use.part in names)
        yield from ((Path(node.file), use) for use in uses if use.start not in missing)


def _reused(renamed: Mapping[str, str]) -> dict[str, str]:
    """Return those new identifiers, by the old ones, whose old one is another element's new one."""
    return {old: new for old, new in renamed.items() if old in renamed.values()}


class Misfit(msgspec.Struct, frozen=True):
    """Why a text does not fit the package."""

    what: str
    """As the end of a sentence that begins with "it"."""
    line: int


def find_misfits(
    generation: Generation, actions: Sequence[Action], merged: Mapping[str, str], keys: Collection[str]
) -> dict[str, Misfit]:
    """Find out why some of the user's files, by their keys, do not fit the package once all actions are done.

    Either they mention what the package has not, or they lack what its models at the top mention.
    """
    if not keys:
        return {}
    inputs, found = generation.inputs, dict[str, Misfit]()
    scopes = Scopes(package_after(generation, actions, merged, users_texts(generation, actions)))
    doubtful = _lost_parts(generation, _recorded(generation), _generated(generation))
    package = inputs.robot.target.package
    owners = {".".join(class_name(package, inputs.path(key))): key for key in keys}
    tops = [inputs.key(path) for path in generation.package.artifacts if "/" not in path and path.endswith(".mo")]
    for key in dict.fromkeys((*keys, *tops)):
        node = scopes.node(class_name(package, inputs.path(key)))
        uses = [one for one in unresolved(node, scopes, doubtful) if one.kind not in _LEGAL] if node else []
        for use in sorted(uses, key=lambda one: one.line):
            if key in keys:
                what = f"mentions `{use.part}`, which the package does not have"
                found.setdefault(key, Misfit(what, use.line))
            elif lacking := owners.get(use.owner):
                place = f"{shown(inputs.files.path(key))}:{use.line}"
                found.setdefault(lacking, Misfit(f"lacks `{use.part}`, which {place} mentions", 0))
    return found


def misfit_warnings(generation: Generation, found: Mapping[str, Misfit]) -> Iterator[Diagnostic]:
    """A warning for each kept file that does not fit the package."""
    for key, misfit in found.items():
        file = shown(generation.inputs.files.path(key))
        hint = f"change that, or `urdfsync resolve {file} --merge` (or --edit)"
        message = f"kept, does not fit: it {misfit.what}"
        yield Diagnostic(Severity.WARNING, "does-not-fit", message, file, misfit.line, hint=hint)


def users_texts(generation: Generation, actions: Sequence[Action]) -> UsersTexts:
    """Return the user's texts that have to do with the package, as they are on disk."""
    inputs, files = generation.inputs, generation.inputs.files
    written = {action.path for action in actions} | inputs.recorded_files.keys()
    places = {action.path: action.origin or action.path for action in actions if action.kind in USERS}
    around = dict(inputs.users_files)
    if inputs.has_moved:
        left = files.classes(inputs.old_folder) - written
        around |= {files.path(key): encode(files.any_text(key)) for key in left}
    return UsersTexts(
        own={key: files.any_text(key) for key in files.classes(inputs.folder) - written},
        edited={key: files.any_text(place) for key, place in places.items()},
        places=places,
        around=around,
    )


def package_after(
    generation: Generation,
    actions: Sequence[Action],
    merged: Mapping[str, str],
    texts: UsersTexts,
    hidden: Collection[str] = (),
) -> StoredClasses:
    """Return the classes as this build leaves them; `merged` are the texts of merged files by key.

    Names that are `hidden` are taken out of what is generated.
    """
    inputs, files = generation.inputs, generation.inputs.files
    staying = {action.path for action in actions if action.kind is Kind.NEEDED or action.released}
    kept = {key: files.any_text(key) for key in staying}
    generated = _generated(generation)
    if hidden:
        words = re.compile(rf"\b({'|'.join(map(re.escape, hidden))})\b")
        generated = {key: words.sub("hidden", text) for key, text in generated.items()}
    after = {**generated, **texts.own, **kept, **texts.edited, **merged}
    return _classes(generation, inputs.robot.target, inputs.folder, after, texts.around, now=True)


def package_before(generation: Generation, texts: UsersTexts) -> StoredClasses:
    """Return the classes of the last complete build, with the user's texts."""
    inputs = generation.inputs
    before = _recorded(generation) | {place: texts.edited[key] for key, place in texts.places.items()}
    if not inputs.has_moved:
        before |= texts.own
    return _classes(generation, inputs.old_target, inputs.old_folder, before, texts.around, now=False)


def _recorded(generation: Generation) -> dict[str, str]:
    """Return the texts of the last complete build by their keys."""
    records = generation.inputs.recorded_files
    return {
        key: generation.inputs.base(record.generated) or ""
        for key, record in records.items()
        if record.hashes and key.endswith(".mo")
    }


def _generated(generation: Generation) -> dict[str, str]:
    """Return the texts that are generated, by their keys."""
    keys = map(generation.inputs.key, generation.package.artifacts)
    return {key: generation.content(key).decode() for key in keys}


def warnings(generation: Generation, found: VanishedNames) -> Iterator[Diagnostic]:
    """A warning for each name that is gone in each text: where, and what it is now; a note on what writes new names."""
    files = generation.inputs.files
    uses = [*((files.path(key), one) for key, one in found.in_package.items()), *found.elsewhere.items()]
    renamed = renamed_identifiers(generation) if uses or found.reused else {}
    known = known_names(generation) if uses or found.reused else frozenset()
    followed, places = dict[str, str](), list[tuple[str, int]]()
    for file, all_uses in uses:
        by_part: dict[str, list[Unresolved]] = {}
        for use in all_uses:
            by_part.setdefault(use.part, []).append(use)
        for part, (first, *more) in by_part.items():
            hint = _hint(generation, first, renamed, known)
            name = new_name(part, renamed, known)
            if part not in known and any(one.is_certain and name in one.known for one in (first, *more)):
                old = next(old for old in renamed if part.lower().startswith(old.lower()))
                followed[old] = renamed[old]
                places.append((shown(file), first.line))
            if lines := sorted({use.line for use in more} - {first.line}):
                hint += f"; also in line{'s' if len(lines) > 1 else ''} {', '.join(map(str, lines))}"
            message = f"`{first.name}` is used here, but the package has no `{part}` any more"
            yield Diagnostic(Severity.WARNING, "vanished-name", message, shown(file), first.line, hint=hint)
    for file, use in found.reused:
        yield _reused_warning(generation, file, use, renamed, known)
    if followed:
        command = " ".join(("urdfsync resolve --rename-uses", *(f"{old}={new}" for old, new in followed.items())))
        message, hint = (
            "your models can get the new names",
            f"`{command}` shows the lines, and writes them if you agree",
        )
        yield Diagnostic(Severity.NOTE, "rename-uses", message, *max(places), hint=hint)


def _reused_warning(
    generation: Generation, file: Path, use: Unresolved, renamed: Mapping[str, str], known: Collection[str]
) -> Diagnostic:
    """A warning that a name means another element than before."""
    inputs, reused = generation.inputs, _reused(renamed)
    identifier = next(old for old in reused if use.part.lower().startswith(old.lower()))
    was = _element(inputs.domain.names(inputs.last.snapshot, inputs.old_target) if inputs.last else {}, identifier)
    now = _element(inputs.domain.names(generation.now.snapshot, inputs.robot.target), identifier)
    parts = use.name.split(".")
    name = ".".join(parts[: parts.index(use.part) + 1])
    message = f"`{name}` was {was} and is {now} now"
    hint = f"use `{new_name(use.part, reused, known)}` instead"
    return Diagnostic(Severity.WARNING, "vanished-name", message, shown(file), use.line, hint=hint)


def _element(names: Mapping[str, Mapping[str, str]], identifier: str) -> str:
    """Return the kind and the name of the element that has an identifier; it may be that of the package."""
    found = ((kind, name) for kind, spellings in names.items() for name in spellings if spellings[name] == identifier)
    return next((f"{kind.removesuffix('s')} {name}" for kind, name in found), "the package")


def _hint(generation: Generation, use: Unresolved, renamed: Mapping[str, str], known: Collection[str]) -> str:
    inputs, part = generation.inputs, use.part
    domain, target, options = inputs.domain, inputs.robot.target, inputs.robot.options
    if name := new_name(part, renamed, known):
        # a package that is in another one now
        return f"use `{target.package if name == target.name and name not in use.known else name}` instead"
    paths = (inputs.old_path(key) for key in inputs.recorded_files if class_of(key) == part)
    if option := next(filter(None, (domain.option_for(path, inputs.old_target, options) for path in paths)), ""):
        return brings_back(option)
    for name in (part, *new_names(part, renamed)):
        if option := domain.option_for_connector(name, generation.now.snapshot, target, options):
            return brings_back(option, name if name != part else "")
    return "change or remove this use: nothing has taken its place"


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
    contents = {key.removeprefix(f"{folder}/"): encode(text) for key, text in texts.items()}
    parents = {one.path: one.content for one in inputs.parents.shared if one.content is not None} if now else {}

    def find(name: str) -> Path | None:
        if own := find_own_library(name, target.package):
            return own
        places = (robot.output / name, robot.output / f"{name}.mo")
        return next((path for path in places if path.is_file() or (path / "package.mo").is_file()), None)

    former = inputs.old_target.package if now and inputs.old_target.package != target.package else ""
    return StoredClasses(target.package, inputs.files.path(folder), contents, {**around, **parents}, find, former)


def class_name(package: str, path: str) -> ClassName:
    """Return the full name of the class that a file is for, by its path below the package."""
    return (*package.split("."), *class_path(PurePosixPath(path)).parts)


def _lost_parts(generation: Generation, before: Mapping[str, str], after: Mapping[str, str]) -> frozenset[str]:
    """Return the names of generated classes and of their parts that are no longer generated.

    Where a class inherits from a library that is not at hand, such a name counts as gone.
    """
    new_keys, found = {old: new for new, old in generation.moves.items()}, set[str]()
    for key, text in before.items():
        now = after.get(new_keys.get(key, key))
        if now != text:
            found |= {class_of(key)} if now is None else declared_names([text]) - declared_names([now])
    return frozenset(found)

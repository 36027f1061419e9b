"""The user's own models with new names for what was renamed: in the words alone that the resolver of names finds."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.config import Config, RobotConfig
from urdfsync.engine.actions import Kind
from urdfsync.engine.decide import Decision, decide_package
from urdfsync.engine.generation import Generation, generate_robot
from urdfsync.engine.inputs import inspect
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.package_names import known_names, new_names, renamed_identifiers, renamed_names
from urdfsync.engine.users_files import find_users_files
from urdfsync.engine.vanished import UsersTexts, class_name, package_after, package_before, users_texts
from urdfsync.modelica.classes import Node
from urdfsync.modelica.files import replace_words
from urdfsync.modelica.scopes import Scopes
from urdfsync.modelica.unresolved import Unresolved, unresolved


class RenamedUses(msgspec.Struct, frozen=True):
    """What becomes of the user's models."""

    texts: Mapping[Path, tuple[bytes, bytes]]
    """Old and new content of each file that changes."""
    robots: Sequence[RobotConfig]
    """The robots whose names are new only after a build."""
    conflicting: Sequence[str]
    """The robots that keep their names until conflicts are resolved."""
    unknown: Collection[str]
    """New names that were given and that no package has."""
    left: Sequence[tuple[Path, Unresolved, str]]
    """Uses of old names that stay, since the new name is not certain to mean the same there: file, use, new name."""


class _Names(msgspec.Struct, frozen=True):
    """New names by the old ones."""

    planned: Mapping[str, str]
    """Of what the next build renames: what an old name means until then is known."""
    given: Mapping[str, str]
    """Of what the user says was renamed before."""


def rename_uses(
    config: Config, robots: Sequence[RobotConfig], options: BuildOptions, given: Mapping[str, str]
) -> RenamedUses:
    """Find the uses of what the next build renames, and of what was renamed before as `given` tells: new names by old.

    Writes nothing. Raises UrdfsyncError for a robot that can't be planned.
    """
    before, after = dict[Path, bytes](), dict[Path, bytes]()
    pending, conflicting, unknown = list[RobotConfig](), list[str](), set(given.values())
    left = list[tuple[Path, Unresolved, str]]()
    for robot in robots:
        generation = generate_robot(inspect(config, robot, options))
        decision, known = decide_package(generation), known_names(generation)
        unknown = {name for name in unknown if not any(one.lower().startswith(name.lower()) for one in known)}
        if not decision.is_complete:
            conflicting.append(robot.name)
            continue
        around, inside = _users_contents(generation, decision, given)
        contents = {**around, **inside}
        newest = {path: after.get(path, content) for path, content in contents.items()}
        found, uses = _follow(generation, decision, _names(generation, known, given), newest, inside)
        left += uses
        before = {**{path: contents[path] for path in found}, **before}
        after |= found
        if found and any(action.writes for action in decision.actions):
            pending.append(robot)
    return RenamedUses(
        {path: (before[path], after[path]) for path in sorted(after)}, pending, conflicting, unknown, left
    )


def _names(generation: Generation, known: Collection[str], given: Mapping[str, str]) -> _Names:
    """Return new names by the old ones; `known` are all that the package has now."""
    identifiers, likely, others = renamed_identifiers(generation), dict[str, str](), dict[str, str]()
    for old, new in given.items():
        for name in sorted(known):
            former_names = [*new_names(name, {new: old})]
            likely |= dict.fromkeys(former_names[:1], name)
            others |= dict.fromkeys(former_names[1:], name)
    found = {old: new for old, new in (others | likely).items() if old not in known}
    # with `a` now `b`, and `b` now `c`, a use of `b` may mean either: the user has to tell
    doubtful = tuple(new.lower() for new in identifiers.values() if new in identifiers)
    planned = {old: new for old, new in renamed_names(generation).items() if not new.lower().startswith(doubtful)}
    return _Names(planned, found)


def _users_contents(
    generation: Generation, decision: Decision, given: Collection[str]
) -> tuple[dict[Path, bytes], dict[Path, bytes]]:
    """Return the user's files outside of the package, and those in it that a build leaves as they are."""
    inputs, files = generation.inputs, generation.inputs.files
    folders = {files.path(folder) for folder in (inputs.folder, inputs.old_folder)}
    names = {*(folder.name for folder in folders), *given}
    own = users_texts(generation, decision.actions).own
    kept = (action.path for action in decision.actions if action.kind is Kind.KEEP)
    inside = {files.path(key): files.read(key) or b"" for key in (*own, *kept) if key.endswith(".mo")}
    return find_users_files(inputs.config, inputs.robot, folders, names), inside


def _follow(
    generation: Generation,
    decision: Decision,
    names: _Names,
    contents: Mapping[Path, bytes],
    inside: Collection[Path],
) -> tuple[dict[Path, bytes], list[tuple[Path, Unresolved, str]]]:
    """Return the new contents of the files that use one of the old names, and the uses that stay.

    Some files are `inside` of the package. What a class redeclares by its old name is missed in others only once that
    is renamed: so all is looked through again until nothing is missed.
    """
    inputs, actions, all_names = generation.inputs, decision.actions, {**names.given, **names.planned}
    words, left = dict[Path, dict[int, tuple[str, str]]](), list[tuple[Path, Unresolved, str]]()
    if not all_names:
        return {}, left
    keys = {path: inputs.files.key(path) for path in inside}
    merged = {key: text for key, text in decision.texts.items() if key.endswith(".mo")}
    texts = _with_contents(users_texts(generation, actions), contents, keys)
    users = {str(path) for path in contents if keys.get(path) not in texts.edited}
    scopes, package = Scopes(package_before(generation, texts)), inputs.old_target.package
    nodes = (scopes.node(class_name(package, inputs.old_path(key))) for key in keys.values())
    before = {(node.file, node.name): node for node in (*filter(None, nodes), *scopes.users())}
    missed = {place: {use.start for use in unresolved(node, scopes, all_names)} for place, node in before.items()}

    while True:
        replaced = {path: dict(places) for path, places in words.items()}  # `words` grows meanwhile
        found = {path: replace_words(contents[path], places) for path, places in replaced.items()}
        texts = _with_contents(texts, {**contents, **found}, keys)
        scopes, package = Scopes(package_after(generation, actions, merged, texts)), inputs.robot.target.package
        nodes = (scopes.node(class_name(package, inputs.path(key))) for key in keys.values())
        left, is_done = [], True
        for node, use in _uses((*filter(None, nodes), *scopes.users()), scopes, all_names):
            path = Path(node.file)
            start = _old_start(use.start, replaced.get(path, {}))
            was_missed = missed.get((node.file, node.name))
            is_planned = use.part in names.planned and was_missed is not None and start not in was_missed
            if not (is_planned or use.part in names.given):
                continue
            new = names.planned[use.part] if is_planned else names.given[use.part]
            owner = scopes.node(use.owner.split("."))
            if new in use.known and (is_planned or use.is_certain) and not _is_users(new, owner, scopes, users):
                words.setdefault(path, {})[start], is_done = (use.part, new), False
            else:
                left.append((path, use, new))
        if is_done:
            return found, left


def _with_contents(texts: UsersTexts, contents: Mapping[Path, bytes], keys: Mapping[Path, str]) -> UsersTexts:
    """Return the texts with other contents of files; `keys` are those of files in the package."""
    inside = {key: contents[path].decode(errors="surrogateescape") for path, key in keys.items()}
    return msgspec.structs.replace(
        texts,
        own={key: inside.get(key, text) for key, text in texts.own.items()},
        edited={key: inside.get(key, text) for key, text in texts.edited.items()},
        around={path: content for path, content in contents.items() if path not in keys},
    )


def _uses(nodes: Sequence[Node], scopes: Scopes, names: Collection[str]) -> Iterator[tuple[Node, Unresolved]]:
    """Yield the uses of old names in classes, where they mean nothing."""
    for node in nodes:
        yield from ((node, use) for use in unresolved(node, scopes, names) if use.part in names and use.start >= 0)


def _old_start(start: int, words: Mapping[int, tuple[str, str]]) -> int:
    """Return where something began before words were replaced; these are known by where they began then."""
    for place, (old, new) in sorted(words.items()):
        if place >= start:
            break
        start -= len(new) - len(old)
    return start


def _is_users(name: str, owner: Node | None, scopes: Scopes, files: Collection[str]) -> bool:
    """Whether a class in the user's files declares a name for itself, of those where it is looked for."""
    waiting, seen = [owner], set[Node]()
    while waiting:
        node = waiting.pop()
        if node is not None and node not in seen:
            seen.add(node)
            component = node.components.get(name)
            if component and node.file in files and "redeclare" not in component.prefixes:
                return True
            waiting += [node.parent, *(base.node for base in scopes.bases(node))]
    return False

"""The user's own models with new names for what was renamed: in the words alone that the resolver of names finds."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
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
from urdfsync.engine.vanished import class_name, package_after, users_texts
from urdfsync.modelica.files import replace_words
from urdfsync.modelica.scopes import Scopes
from urdfsync.modelica.unresolved import unresolved


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


def rename_uses(
    config: Config, robots: Sequence[RobotConfig], options: BuildOptions, given: Mapping[str, str]
) -> RenamedUses:
    """Find the uses of what the next build renames, and of what was renamed before as `given` tells: new names by old.

    Writes nothing. Raises UrdfsyncError for a robot that can't be planned.
    """
    before, after = dict[Path, bytes](), dict[Path, bytes]()
    pending, conflicting, unknown = list[RobotConfig](), list[str](), set(given.values())
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
        found = _follow(generation, decision, _names(generation, known, given), newest, inside)
        before = {**{path: contents[path] for path in found}, **before}
        after |= found
        if found and any(action.writes for action in decision.actions):
            pending.append(robot)
    return RenamedUses({path: (before[path], after[path]) for path in sorted(after)}, pending, conflicting, unknown)


def _names(generation: Generation, known: Collection[str], given: Mapping[str, str]) -> dict[str, str]:
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
    return found | {old: new for old, new in renamed_names(generation).items() if not new.lower().startswith(doubtful)}


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
    names: Mapping[str, str],
    contents: Mapping[Path, bytes],
    inside: Collection[Path],
) -> dict[Path, bytes]:
    """Return the new contents of the files that use one of the old names; some are `inside` of the package.

    What a class redeclares by its old name is missed in others only once that is renamed: so all is looked through
    again until nothing is missed.
    """
    inputs, actions, found = generation.inputs, decision.actions, dict[Path, bytes]()
    texts, package = users_texts(generation, actions), inputs.robot.target.package
    merged = {key: text for key, text in decision.texts.items() if key.endswith(".mo")}
    keys = {path: inputs.files.key(path) for path in inside}
    while names:
        contents = {**contents, **found}
        merged |= {key: contents[path].decode(errors="surrogateescape") for path, key in keys.items()}
        around = {path: content for path, content in contents.items() if path not in keys}
        stored = package_after(generation, actions, merged, msgspec.structs.replace(texts, around=around))
        scopes, words = Scopes(stored), dict[Path, dict[int, tuple[str, str]]]()
        nodes = (scopes.node(class_name(package, inputs.path(key))) for key in keys.values())
        for node in (*filter(None, nodes), *scopes.users()):
            for use in unresolved(node, scopes, names):
                new, path = names.get(use.part, ""), Path(node.file)
                if new in use.known and use.start >= 0:
                    words.setdefault(path, {})[use.start] = use.part, new
        if not words:
            break
        found |= {path: replace_words(contents[path], places) for path, places in words.items()}
    return found

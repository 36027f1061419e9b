"""The user's own models with new names for what was renamed: in the words alone that the resolver of names finds."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.config import Config, RobotConfig
from urdfsync.engine.decide import Decision, decide_package
from urdfsync.engine.fit import Package
from urdfsync.engine.generation import Generation, generate_robot
from urdfsync.engine.inputs import inspect
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.package_names import known_names, new_name, new_names, recently_renamed
from urdfsync.modelica.classes import Node
from urdfsync.modelica.files import replace_words
from urdfsync.modelica.scopes import Scopes
from urdfsync.modelica.unresolved import Unresolved


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
    uncertain: Sequence[tuple[Path, Unresolved, str]]
    """Uses of old names that stay, since the new name is not certain to mean the same there: file, use, new name."""


def rename_uses(
    config: Config, robots: Sequence[RobotConfig], options: BuildOptions, given: Mapping[str, str]
) -> RenamedUses:
    """Find the uses of names that mean nothing after the next build, and that have a new name.

    The build tells what it renames; `given` tells what was renamed before: new names by old. Writes nothing. Raises
    UrdfsyncError for a robot that can't be planned.
    """
    before, after = dict[Path, bytes](), dict[Path, bytes]()
    pending, conflicting, unknown = list[RobotConfig](), list[str](), {*given.values()}
    uncertain = list[tuple[Path, Unresolved, str]]()
    for robot in robots:
        generation = generate_robot(inspect(config, robot, options))
        names = [name.lower() for name in known_names(generation)] if unknown else []
        unknown = {new for new in unknown if not any(name.startswith(new.lower()) for name in names)}
        decision = decide_package(generation)
        if not decision.is_complete:
            conflicting.append(robot.name)
            continue
        changed, uses = _follow(generation, decision, given, after)
        uncertain += uses
        before = {**{path: old for path, (old, _) in changed.items()}, **before}
        after |= {path: new for path, (_, new) in changed.items()}
        if changed and any(action.writes for action in decision.actions):
            pending.append(robot)
    texts = {path: (before[path], after[path]) for path in sorted(after)}
    return RenamedUses(texts, pending, conflicting, unknown, uncertain)


def _follow(
    generation: Generation, decision: Decision, given: Mapping[str, str], contents: Mapping[Path, bytes]
) -> tuple[dict[Path, tuple[bytes, bytes]], list[tuple[Path, Unresolved, str]]]:
    """Return old and new contents of the files that use one of the old names, and the uses that stay.

    `contents` are those of files that change for other robots. What a class redeclares by its old name is missed in
    others only once that is renamed: so all is looked through again until nothing is missed.
    """
    old, new, names = dict[Path, bytes](), {**contents}, recently_renamed(generation)
    renamed = {name: now for name, now in names.items() if now not in names}  # else two parts would have one name
    while True:
        package = Package(generation, decision.actions, decision.texts, new, given)
        scopes, uncertain = Scopes(package.classes()), list[tuple[Path, Unresolved, str]]()
        words = dict[Path, dict[int, tuple[str, str]]]()
        for misfit in package.misfits():
            use = misfit.use
            if use is None or use.start < 0 or misfit.key in decision.texts:  # the build writes these texts
                continue
            name = (
                new_name(use.part, renamed, use.candidates)
                or new_name(use.part, given, use.candidates)
                or next(new_names(use.part, given), "")
            )
            if name not in use.candidates or _is_users(name, scopes.node(use.owner.split(".")), scopes, package):
                uncertain += [(misfit.file, use, name)] if name else []
            else:
                words.setdefault(misfit.file, {})[use.start] = use.part, name
        if not words:
            return {path: (content, new[path]) for path, content in old.items()}, uncertain
        for path, places in words.items():
            old.setdefault(path, package.users[path])
            new[path] = replace_words(package.users[path], places)


def _is_users(name: str, owner: Node | None, scopes: Scopes, package: Package) -> bool:
    """Whether a class in the user's own files declares a name for itself, of those where it is looked for."""
    waiting, seen = [owner], set[Node]()
    while waiting:
        node = waiting.pop()
        if node is not None and node not in seen:
            seen.add(node)
            component = node.components.get(name)
            if component and Path(node.file) in package.own and "redeclare" not in component.prefixes:
                return True
            waiting += [node.parent, *(base.node for base in scopes.bases(node))]
    return False

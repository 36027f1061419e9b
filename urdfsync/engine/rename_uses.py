"""The user's own models with new names for what was renamed: in the words alone that the resolver of names finds."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.config import Config, RobotConfig
from urdfsync.engine.decide import Decision, decide_package
from urdfsync.engine.fit import Misfit, Package
from urdfsync.engine.generation import Generation, generate_robot
from urdfsync.engine.inputs import inspect
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.package_names import known_names, new_name, new_names
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
    left: Sequence[tuple[Path, Unresolved, str]]
    """Uses of old names that stay, since the new name is not certain to mean the same there: file, use, new name."""


def rename_uses(
    config: Config, robots: Sequence[RobotConfig], options: BuildOptions, given: Mapping[str, str]
) -> RenamedUses:
    """Find the uses of names that mean nothing after the next build, and that have a new name.

    The build tells what it renames; `given` tells what was renamed before: new names by old. Writes nothing. Raises
    UrdfsyncError for a robot that can't be planned.
    """
    before, after = dict[Path, bytes](), dict[Path, bytes]()
    pending, conflicting, unknown = list[RobotConfig](), list[str](), set(given.values())
    left = list[tuple[Path, Unresolved, str]]()
    for robot in robots:
        generation = generate_robot(inspect(config, robot, options))
        decision = decide_package(generation)
        unknown -= _known(unknown, generation)
        if not decision.is_complete:
            conflicting.append(robot.name)
            continue
        found, uses = _follow(generation, decision, given, after)
        left += uses
        before = {**{path: old for path, (old, _) in found.items()}, **before}
        after |= {path: new for path, (_, new) in found.items()}
        if found and any(action.writes for action in decision.actions):
            pending.append(robot)
    return RenamedUses(
        {path: (before[path], after[path]) for path in sorted(after)}, pending, conflicting, unknown, left
    )


def _known(names: Collection[str], generation: Generation) -> set[str]:
    """Return those of the names with which a name in the package begins."""
    known = {name.lower() for name in known_names(generation)} if names else set()
    return {name for name in names if any(one.startswith(name.lower()) for one in known)}


def _follow(
    generation: Generation, decision: Decision, given: Mapping[str, str], contents: Mapping[Path, bytes]
) -> tuple[dict[Path, tuple[bytes, bytes]], list[tuple[Path, Unresolved, str]]]:
    """Return old and new contents of the files that use one of the old names, and the uses that stay.

    `contents` are those of files that change for other robots. What a class redeclares by its old name is missed in
    others only once that is renamed: so all is looked through again until nothing is missed.
    """
    words, old = dict[Path, dict[int, tuple[str, str]]](), dict[Path, bytes]()
    while True:
        replaced = {path: dict(places) for path, places in words.items()}  # `words` grows meanwhile
        new = {path: replace_words(old[path], places) for path, places in replaced.items()}
        package = Package(generation, decision.actions, decision.texts, {**contents, **new}, given)
        left, is_done, scopes = list[tuple[Path, Unresolved, str]](), True, Scopes(package.classes())
        for misfit, use, name in _renamed(package.misfits(), package, given):
            path = misfit.file
            if misfit.key in decision.texts:
                continue  # the build writes it
            if name not in use.known or _is_users(name, scopes.node(use.owner.split(".")), scopes, package):
                left.append((path, use, name))
                continue
            old.setdefault(path, package.content_of(path))
            start = _old_start(use.start, replaced.get(path, {}))
            words.setdefault(path, {})[start], is_done = (use.part, name), False
        if is_done:
            return {path: (old[path], content) for path, content in new.items()}, left


def _renamed(
    misfits: Sequence[Misfit], package: Package, given: Mapping[str, str]
) -> Iterator[tuple[Misfit, Unresolved, str]]:
    """Yield each use of an old name with the new one."""
    for misfit in misfits:
        if (use := misfit.use) and use.start >= 0:
            likely = next(new_names(use.part, given), "")
            if name := package.new_name(use) or new_name(use.part, given, use.known) or likely:
                yield misfit, use, name


def _old_start(start: int, words: Mapping[int, tuple[str, str]]) -> int:
    """Return where something began before words were replaced; these are known by where they began then."""
    for place, (old, new) in sorted(words.items()):
        if place >= start:
            break
        start -= len(new) - len(old)
    return start


def _is_users(name: str, owner: Node | None, scopes: Scopes, package: Package) -> bool:
    """Whether a class in the user's own files declares a name for itself, of those where it is looked for."""
    waiting, seen = [owner], set[Node]()
    while waiting:
        node = waiting.pop()
        if node is not None and node not in seen:
            seen.add(node)
            component = node.components.get(name)
            if component and package.is_users(Path(node.file)) and "redeclare" not in component.prefixes:
                return True
            waiting += [node.parent, *(base.node for base in scopes.bases(node))]
    return False

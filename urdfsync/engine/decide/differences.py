"""Compares the last complete build of a robot with the present build: elements, model, names of files."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import cached_property
from pathlib import PurePosixPath

import msgspec

from urdfsync.domain import ChangeClass, ElementKey, Role, Snapshot, Target, displaced
from urdfsync.domain import comparison as changes
from urdfsync.domain.comparison import Changes
from urdfsync.domain.matching import Matching, without_exchanges
from urdfsync.engine.decide.parts import (
    file_ids,
    find_former_ids,
    find_part_ids,
    ids_of,
    ids_of_stamps,
    is_older_than_package,
    recorded_ids,
)
from urdfsync.engine.decide.places import find_moves
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.last_build import option_values
from urdfsync.engine.renames import find_matching, pending
from urdfsync.modelica.files import class_path

GONE = "_gone"
"""The end of the new name of a removed element whose name another element has now."""


class Differences(msgspec.Struct, frozen=True, dict=True):
    """The differences between the last complete build and the present build."""

    matching: Matching
    """Renamed elements, and elements that may be other parts than their names say."""
    changes: Changes | None
    """The changes of the model; None if they are unknown, and for a removed robot."""
    is_structural: bool
    """Whether files or names may come or go; False if only numbers changed."""
    ids: Mapping[str, str]
    """The lasting id of each generated file, by path."""
    parts: Mapping[str, str]
    """The lasting ids of the parts that had other names, by owner."""
    former_ids: Mapping[str, tuple[str, ...]]
    """The ids of all parts that had a name before, by owner."""
    moves: Mapping[str, str]
    """The old key of each text file that moves with its element or with the package, by its new key."""
    identifiers: Mapping[str, str]
    """New identifiers by old identifiers of the last complete build."""
    former: Mapping[str, str]
    """New identifiers by all former identifiers, also of builds before the last complete one."""
    other_elements: Mapping[str, str]
    """For each name that another element has now: the new name of the element that had this name before."""
    has_exchanges: bool
    """Whether an element has the former name of another element."""
    undeclared: Mapping[ElementKey, str]
    """The renames without the declarations that are not made yet: the user may delete a declaration."""
    stamped: Mapping[str, str]
    """The ids of parts that stamps on disk tell, by owner, if the recorded state is lost or older than the package."""

    @cached_property
    def paths(self) -> Mapping[str, str]:
        """The path of each generated file, by its lasting id."""
        return {file_id: path for path, file_id in self.ids.items()}

    @property
    def renames(self) -> Mapping[ElementKey, str]:
        """Renamed elements: old element → new name."""
        return self.matching.renames


def compare_with_last(inputs: Inputs, generation: Generation) -> Differences:
    """Compare the last complete build of a robot with the present build."""
    last, now, package = inputs.last, generation.now.snapshot, generation.package
    declared = pending(inputs)
    matching = _find_matching(inputs, now, declared)
    undeclared = _match_with_last(inputs, now, {}).renames if declared else matching.renames
    is_older = bool(last.records) and is_older_than_package(inputs, generation)
    if is_older:
        matching = Matching(matching.renames)  # the build of the package has settled the doubts
    stamped = ids_of_stamps(inputs, generation) if is_older or not last.records else {}
    news = _find_changes(inputs, generation, matching)
    parts = find_part_ids(inputs, generation, matching, stamped)
    ids = file_ids(package.artifacts.values(), parts)
    moves = find_moves(inputs, ids)
    others, has_exchanges, renames = dict[str, str](), False, matching.renames
    if renames and last.version:
        after = inputs.domain.features(now)
        others = {name: f"{name}{GONE}" for _, name in displaced(renames)}
        others |= {key[1]: new for key, new in renames.items() if key in after}
        has_exchanges = any((kind, new) in last.elements for (kind, _), new in renames.items())
    # another version of urdfsync may give an element another identifier
    is_large = news is None or news.change_class.rank >= ChangeClass.STRUCTURAL.rank
    is_structural = is_large or bool(moves) or last.is_united
    former_ids = find_former_ids(inputs, generation, parts) if is_structural else last.record.former_ids
    identifiers, former = dict[str, str](), last.record.former
    if is_structural:
        identifiers = _find_identifiers(inputs, now, renames, moves) if news is not None else {}
        former = {old: identifiers.get(new, new) for old, new in former.items()} | identifiers
        former = _other_identifiers(inputs, now, parts) | former
    names = identifiers, former, others, has_exchanges
    return Differences(matching, news, is_structural, ids, parts, former_ids, moves, *names, undeclared, stamped)


def _find_matching(inputs: Inputs, now: Snapshot, declared: Mapping[str, str]) -> Matching:
    """Match the elements of the last complete build with the present elements.

    A stranger may have written the recorded model: names count as exchanged only if the records on disk confirm it.
    """
    last = inputs.last
    matching = _match_with_last(inputs, now, declared)
    if last.version is None or not matching.renames:
        return matching
    old = last.elements
    found = {key: new for key, new in matching.renames.items() if key[1] not in declared}
    exchanged = {f"{kind} {name}" for (kind, name), new in found.items() if (kind, new) in old}
    return matching if agrees(inputs, exchanged) else without_exchanges(matching, old)


def _match_with_last(inputs: Inputs, now: Snapshot, declared: Mapping[str, str]) -> Matching:
    """Match the elements of the last complete build with the present elements.

    While a conflict is open, one export may rename an element, and the next export may change its numbers. So this
    follows each part, by its id, through the model that the last build read. `declared` has only renames
    that no complete build has made.
    """
    last, domain = inputs.last, inputs.domain
    if last.version is None:
        return Matching()
    recorded, last_seen = last.version.snapshot, last.seen
    has_other_format = recorded != now and last.source_format != inputs.source.format
    direct = find_matching(domain, recorded, now, declared, is_pending=True, has_other_format=has_other_format)
    if last_seen is None:
        return direct
    existing = domain.features(now)
    recorded_ids = ids_of(last.elements, last.record.ids)
    seen = {part: key for key, part in ids_of(domain.features(last_seen), last.seen_ids).items()}
    opened = {(name, seen[part][1]) for (_, name), part in recorded_ids.items() if part in seen}
    remaining = {name: new for name, new in declared.items() if (name, new) not in opened}
    later = find_matching(domain, last_seen, now, remaining, is_pending=True, has_other_format=has_other_format)
    gone, followed = displaced(later.renames), dict[ElementKey, str]()
    for key, part in recorded_ids.items():
        if part in seen and seen[part] not in gone:
            new = later.renames.get(seen[part], seen[part][1])
            if (key[0], new) in existing:
                followed[key] = new
    found = {key: name for key, name in direct.renames.items() if key[1] in declared}
    for more in (followed, direct.renames):
        taken = {(kind, name) for (kind, _), name in found.items()}
        found |= {key: name for key, name in more.items() if key not in found and (key[0], name) not in taken}
    return Matching({key: name for key, name in found.items() if name != key[1]}, {**direct.doubts, **later.doubts})


def agrees(inputs: Inputs, owners: Collection[str]) -> bool:
    """Whether the unedited records of these elements on disk equal the records from the recorded model."""
    last, package = inputs.last, inputs.last.package
    if package is None or not owners:
        return not owners
    for path, artifact in package.artifacts.items():
        if artifact.owner in owners and artifact.role is Role.RECORD:
            on_disk = inputs.files.hash(last.folder.key(path), Role.RECORD)
            recorded = last.record.files.get(last.folder.key(path))
            if last.record.open and on_disk and last.has_written(on_disk):
                continue  # an incomplete build has written this file since
            if on_disk == recorded and package.hash(path) != on_disk:
                return False
    return True


def _find_changes(inputs: Inputs, generation: Generation, matching: Matching) -> Changes | None:
    """Find the changes of the model, and of templates, options and version."""
    last, robot, domain = inputs.last, inputs.robot, inputs.domain
    if last.version is None or inputs.options.removes:
        return None
    news: Changes | None = None
    with last.passing_over_invalid():
        news = changes.compare(last.version, generation.now, domain, robot.options, matching)
    if news is None:
        return None
    if news.change_class.rank >= ChangeClass.STRUCTURAL.rank and last.package is None:
        return None  # a stranger may have written the recorded model
    if domain.describe is None and news.changes and (before := last.package_like(generation.now.snapshot)) is not None:
        news = changes.by_texts(news, generation.package.changed_models(before))
    is_same = last.record.generator == inputs.generator and last.target == robot.target
    if last.record.generator == inputs.generator and last.record.options == option_values(robot.options):
        if is_same:
            return news
        former, present = (f"{target.package} with the class {target.name}" for target in (last.target, robot.target))
        if last.target.package != robot.target.package:
            former, present = last.target.package, robot.target.package
        return msgspec.structs.replace(news, generator=True, package=f"{former} → {present}")
    options: list[str] = []
    if is_same and last.options is not None:
        names = robot.options.__struct_fields__
        options = [name for name in names if getattr(last.options, name) != getattr(robot.options, name)]
    return msgspec.structs.replace(news, generator=True, options=tuple(options))


def _find_identifiers(
    inputs: Inputs, now: Snapshot, renames: Mapping[ElementKey, str], moves: Mapping[str, str]
) -> dict[str, str]:
    """Return new identifiers by old identifiers of the last complete build."""
    last, target = inputs.last, inputs.robot.target
    if last.version is None:
        return {}
    old, new = inputs.domain.names(last.version.snapshot, last.target), inputs.domain.names(now, target)
    renamed = {last.folder.rpartition("/")[2]: inputs.robot.folder.name, last.target.name: target.name}
    for kind, identifiers in old.items():
        for name, identifier in identifiers.items():
            new_name = renames.get((kind.removesuffix("s"), name), name)
            renamed[identifier] = new.get(kind, {}).get(new_name, identifier)
    for new_key, key in moves.items():  # another version of urdfsync may call the class of an element otherwise
        names = (class_path(PurePosixPath(each)).name for each in (key, new_key))
        former, present = (f"{name[0].lower()}{name[1:]}" for name in names)
        if former not in renamed and present in renamed:
            renamed[former] = renamed.pop(present)
    return {name: new for name, new in renamed.items() if name != new}


def _other_identifiers(inputs: Inputs, now: Snapshot, parts: Mapping[str, str]) -> dict[str, str]:
    """Return new identifiers by those in the records of further branches that git has united; `parts` as in `ids`."""
    last, found = inputs.last, dict[str, str]()
    if not last.is_united:
        return found
    names = {part: key for key, part in ids_of(inputs.domain.features(now), parts).items()}
    present = inputs.domain.names(now, inputs.robot.target)
    for record, model, ids in recorded_ids(last):
        if record is last.records[0]:
            continue
        former = inputs.domain.names(model, Target(record.package, record.class_))
        for (kind, name), part in ids.items():
            new = names.get(part, (kind, name))[1]
            old_name, new_name = former.get(f"{kind}s", {}).get(name), present.get(f"{kind}s", {}).get(new)
            if old_name and new_name and old_name != new_name:
                found[old_name] = new_name
    return found

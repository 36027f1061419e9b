"""Compares the last complete build of a robot with the present build: elements, model, names of files."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from pathlib import PurePosixPath

import msgspec

from urdfsync import changes
from urdfsync.changes import Changes
from urdfsync.domain import ChangeClass, ElementKey, Role, Snapshot, Target, displaced
from urdfsync.engine.decide.parts import file_ids, find_former_ids, find_part_ids
from urdfsync.engine.decide.renames import match_with_last
from urdfsync.engine.decide.unused import IMPORTS, changed_owners, find_unused, with_unshown
from urdfsync.engine.declared import pending
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.last_build import option_values
from urdfsync.matching import Matching, without_exchanges
from urdfsync.modelica.files import as_file, class_parts, class_path

GONE = "_gone"
"""The end of the new name of a removed element whose name another element has now."""


class Differences(msgspec.Struct, frozen=True):
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
    unused: frozenset[str] = frozenset()
    """The parts of the model that no template uses."""

    @property
    def renames(self) -> Mapping[ElementKey, str]:
        """Renamed elements: old element → new name."""
        return self.matching.renames


def compare_with_last(inputs: Inputs, generation: Generation) -> Differences:
    """Compare the last complete build of a robot with the present build."""
    last, now, package = inputs.last, generation.now.snapshot, generation.package
    declared = pending(inputs)
    matching = _find_matching(inputs, now, declared)
    undeclared = match_with_last(inputs, now, {}).renames if declared else matching.renames
    unused = frozenset[str]()
    if not inputs.options.removes:
        target, options = inputs.robot.target, inputs.robot.options
        unused = find_unused(inputs.domain, generation.now, target, options, inputs.templates, package)
    news = _find_changes(inputs, generation, matching, unused)
    parts = find_part_ids(inputs, generation, matching)
    ids = file_ids(package.artifacts.values(), parts)
    moves = _find_moves(inputs, ids)
    others, has_exchanges, renames = dict[str, str](), False, matching.renames
    if renames and last.version:
        after = inputs.domain.features(now)
        others = {name: f"{name}{GONE}" for _, name in displaced(renames)}
        others |= {key[1]: new for key, new in renames.items() if key in after}
        has_exchanges = any((kind, new) in last.elements for (kind, _), new in renames.items())
    # another version of urdfsync may give an element another identifier
    is_structural = news is None or news.change_class.rank >= ChangeClass.STRUCTURAL.rank or bool(moves)
    former_ids = find_former_ids(inputs, generation, parts) if is_structural else last.record.former_ids
    identifiers, former = dict[str, str](), last.record.former
    if is_structural:
        identifiers = _find_identifiers(inputs, now, renames, moves) if news is not None else {}
        former = {old: identifiers.get(new, new) for old, new in former.items()} | identifiers
    names = identifiers, former, others, has_exchanges
    return Differences(matching, news, is_structural, ids, parts, former_ids, moves, *names, undeclared, unused)


def _find_matching(inputs: Inputs, now: Snapshot, declared: Mapping[str, str]) -> Matching:
    """Match the elements of the last complete build with the present elements.

    A stranger may have written the recorded model: names count as exchanged only if the records on disk confirm it.
    """
    last = inputs.last
    matching = match_with_last(inputs, now, declared)
    if last.version is None or not matching.renames:
        return matching
    old = last.elements
    if last.record.is_united:  # a record that git united has elements of both branches: a name may mean either
        return Matching(without_exchanges(matching, old).renames)
    found = {key: new for key, new in matching.renames.items() if key[1] not in declared}
    exchanged = {f"{kind} {name}" for (kind, name), new in found.items() if (kind, new) in old}
    return matching if agrees(inputs, exchanged) else without_exchanges(matching, old)


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


def _find_changes(
    inputs: Inputs, generation: Generation, matching: Matching, unused: Collection[str]
) -> Changes | None:
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
        return None  # git may have merged two models into an invalid model
    if domain.describe is None and news.changes and (before := last.package_like(generation.now.snapshot)) is not None:
        news = changes.by_texts(news, generation.package.changed_models(before))
    news = _with_unshown(inputs, generation, news, unused)
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


def _with_unshown(inputs: Inputs, generation: Generation, news: Changes, unused: Collection[str]) -> Changes:
    """Return the changes, of which those that no text shows count as unmodelled.

    The recorded hashes show most changes; they do not show the changes that an incomplete build has written already.
    The recorded package takes 20 ms with 100 links.
    """
    last, package = inputs.last, generation.package
    owners = package.owners
    hashes = {last.folder.path(key): base for key, base in last.files.items()}
    changed = {owner for path, owner in owners.items() if package.hash(path) != hashes.get(path)}
    imported = {IMPORTS} if last.version and last.version.imports != generation.now.imports else set[str]()
    found = with_unshown(news, inputs.domain, unused, set(owners.values()), changed | imported)
    if not found.unshown:
        return found
    if (before := last.package_like(generation.now.snapshot)) is None:
        return news
    changed = changed_owners(package, before)
    return with_unshown(news, inputs.domain, unused, set(owners.values()), changed | imported)


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


def _find_moves(inputs: Inputs, ids: Mapping[str, str]) -> dict[str, str]:
    """Return old keys by new keys of the files whose stamps say that they belong at another path."""
    files, last, moves = inputs.files, inputs.last, dict[str, str]()
    targets = {file_id: inputs.folder.key(path) for path, file_id in ids.items()}
    for folder in dict.fromkeys((last.folder, inputs.folder)):
        for key, stamp in files.stamps(folder).items():
            file_id = last.edits.get(files.hash(key, Role.MODEL) or "", stamp.id)
            target = targets.get(file_id)
            if target is None or as_file(target) == as_file(key):
                continue
            there = files.stamp(target)
            is_there = there is not None and there.id == file_id and there.base != files.hash(target, Role.MODEL)
            is_edited = files.hash(key, Role.MODEL) != stamp.base
            if is_there or (is_edited and not is_in_place(last.base(stamp.base), last.target, folder.path(key))):
                continue  # the class is the user's own: a copy, or with another name
            place = as_file(key)  # if the class is a folder, the file that it was
            moves.setdefault(target, place if place in last.record.files else key)
    return moves


def is_in_place(base: str | None, target: Target, path: str) -> bool:
    """Return whether the file at this path is where its base was generated: a copy has another name or folder."""
    *folders, name = (*target.package.split("."), *class_parts(path))
    within = f"within {re.escape('.'.join(folders))};\n" if folders else ""
    return re.match(rf"{within}.*?^(?:\w+ )+{name}\b", base or "", re.DOTALL | re.MULTILINE) is not None

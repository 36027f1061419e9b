"""What to do with each file: decided from its recorded base, what is on disk, and what would be written now.

*Base* is the generated text that the file on disk last took into account, *mine* is on disk, *generated* would be
written. All are compared by hashes, never by times. Everything here is pure.
"""

from __future__ import annotations

import enum
import hashlib
from collections.abc import Callable, Collection, Iterable, Mapping
from typing import TypeAlias

import msgspec

from urdfsync.domain import Role
from urdfsync.engine.actions import CONFLICTS, DELETES, Action, Kind
from urdfsync.state.record import Choice, FileRecord, RecordState


class DesiredFile(msgspec.Struct, frozen=True):
    """A file that the package should have."""

    role: Role
    owner: str
    hash: str
    at_hand: bool = True
    """Whether its content is available; otherwise only the hash is known."""


class ClassFolder(enum.Enum):
    """Stands for the hash of a missing file whose class the user has made a folder of (`X/package.mo`).

    It is no string, so that no hash in a stranger's manifest is equal to it.
    """

    CLASS_FOLDER = enum.auto()


CLASS_FOLDER = ClassFolder.CLASS_FOLDER
OnDisk: TypeAlias = str | ClassFolder | None
"""Hash of what is at a path; None for nothing."""


def decide_file(base: str | None, mine: OnDisk, generated: str | None) -> Kind:
    """Decide on one file by the table of the design; a hash is None where there is no such text."""
    if generated is None:
        if base is None or mine is None:
            return Kind.FORGET
        return Kind.DELETE if mine == base else Kind.ORPHAN
    if mine is None:
        return Kind.CREATE if base is None else Kind.RESTORE
    if mine == generated:
        return Kind.UNCHANGED if base == generated else Kind.ADOPT
    if base is None:
        return Kind.UNOWNED
    if mine == base:
        return Kind.UPDATE
    return Kind.KEEP if generated == base else Kind.CONFLICT


def renamed_files(
    recorded: Mapping[str, FileRecord], targets: Mapping[str, str], desired: Collection[str]
) -> dict[str, str]:
    """Return new and old path of the files that belong elsewhere now.

    `targets` has, for recorded paths, the path of the element's file now. A file that waits for a conflict still is at
    its origin; the record of the origin itself then describes another element's file, or an older one.
    """
    waiting = {record.origin for record in recorded.values() if record.origin}
    found = {}
    for path, record in recorded.items():
        if path in targets and (record.origin or path not in waiting):
            old, new = record.origin or path, targets[path]
            if new in desired and new != old:
                found[new] = old
    return found


def decide(
    recorded: Mapping[str, FileRecord],
    desired: Mapping[str, DesiredFile],
    on_disk: Mapping[str, OnDisk],
    moves: Mapping[str, str],
) -> tuple[Action, ...]:
    """Decide on every file of a robot; `on_disk` has the hashes of the files that are there, or CLASS_FOLDER.

    `moves` has new and old path of files whose element was renamed, see `renamed_files`. A file that the user edited
    goes to its new path (MOVE, and LEAVE at the old one), unless something else of the user's is there. A file that the
    user moved there by hand is compared with what was written at the old path.
    """
    # what urdfsync wrote last of each file that moves; it may have waited before, to move here or to another place
    waiting = {record.origin: record for record in recorded.values() if record.origin}
    bases: dict[str, str | None] = {}
    for to, place in moves.items():
        waited = recorded[to] if to in recorded and recorded[to].origin == place else waiting.get(place)
        bases[to] = waited.base if waited else recorded[place].written_hash if place in recorded else None
    # what is at the old and the new places of the files that move: ours is what urdfsync wrote at that very place
    ends = {path: mine for path in {*moves, *moves.values()} if (mine := on_disk.get(path)) is not None}
    hashes = {path: mine for path, mine in ends.items() if isinstance(mine, str)}
    ours = {path: hash_ for path, hash_ in hashes.items() if path in recorded and recorded[path].written_hash == hash_}
    taken = ends.keys() - ours.keys()
    edited = {new: old for new, old in moves.items() if bases[new] and hashes.get(old) not in (None, bases[new])}
    # an edited file that can't move blocks the one that would take its place, and so on
    while blocked := edited.keys() & taken - set(edited.values()):
        edited = {new: old for new, old in edited.items() if new not in blocked}
    moved_away = set(edited.values())

    actions = []
    for path in sorted(recorded.keys() | desired.keys()):
        record, target, mine = recorded.get(path), desired.get(path), on_disk.get(path)
        base, generated = record.written_hash if record else None, target.hash if target else None
        old, origin = moves.get(path) if target else None, None
        if old and path in edited:
            kind, origin, base, mine = Kind.MOVE, old, bases[path], hashes[old]
        elif old and bases[path] and hashes.get(old) == bases[path] and path not in taken and mine != generated:
            kind, origin, base = Kind.CREATE if mine is None else Kind.UPDATE, old, bases[path]
        elif path in moved_away and target is None:
            kind, mine = Kind.LEAVE, None
        else:
            if path in moved_away:
                base, mine = None, None
            elif old and old not in hashes and path in taken & hashes.keys() and (not record or record.origin == old):
                base = bases[path] or base  # the user moved it by hand
            kind = decide_file(base, mine, generated)
            if kind is Kind.FORGET and base is None:
                continue  # it was never written, and is not wanted any more
        file, at_hand = target or recorded[path], target is None or target.at_hand
        known = mine if isinstance(mine, str) else None
        action = Action(path, kind, file.role, file.owner, base, generated, origin, mine=known, at_hand=at_hand)
        if origin and path in ours:  # remembered in case that the file has to wait
            action = msgspec.structs.replace(action, replaced_hash=ours[path])
        actions.append(action)
    return tuple(actions)


def keep_needed(
    actions: Iterable[Action], has_classes: Callable[[str, Collection[str]], bool], used: Collection[str] = ()
) -> tuple[Action, ...]:
    """Keep what the user's files need: the record of an edited model, and the `package.mo` of a folder with classes.

    The record of a model that the user keeps for himself goes with the model. `used` are records that a text of the
    user's mentions. `has_classes(path, gone)` tells whether the folder of the `package.mo` at `path` holds classes
    other than the files in `gone`.
    """
    actions = tuple(actions)
    models = [action for action in actions if action.role is Role.MODEL]
    orphans = {action.owner for action in models if action.kind is Kind.ORPHAN}
    released = {action.owner for action in models if action.released} - orphans
    gone = {action.path: action for action in actions if action.kind in DELETES}
    kept = {}
    for path, action in gone.items():
        if action.role is Role.RECORD and action.owner in released:
            kept[path] = msgspec.structs.replace(action, kind=Kind.FORGET, choice=Choice.KEEP)
        elif action.role is Role.RECORD and action.kind is Kind.DELETE and (action.owner in orphans or path in used):
            kept[path] = msgspec.structs.replace(action, kind=Kind.NEEDED)
    packages = [path for path, action in gone.items() if action.role is Role.PACKAGE]
    for path in sorted(packages, key=lambda path: path.count("/"), reverse=True):  # innermost first
        if has_classes(path, gone.keys() - kept.keys()):
            kept[path] = msgspec.structs.replace(gone[path], kind=Kind.NEEDED)
    return tuple(kept.get(action.path, action) for action in actions)


def hold(actions: Iterable[Action], numbers_only: Collection[str]) -> tuple[Action, ...]:
    """Put off structural changes of a robot while one of its files is in conflict.

    Still written are files after which the package compiles: records of which only numbers change (their paths are
    `numbers_only`), imported files, and files that are restored as they were.
    """
    actions = tuple(actions)
    if not any(action.kind in CONFLICTS for action in actions):
        return actions
    origins = {action.origin for action in actions}

    def waits(action: Action) -> bool:
        if not action.writes or action.origin is not None or action.path in origins:
            return action.writes
        if action.role is Role.IMPORT:
            return action.kind is Kind.DELETE
        if action.kind is Kind.RESTORE:
            return action.role is Role.ORDER or action.base != action.generated
        return action.kind not in (Kind.UPDATE, Kind.MERGE) or action.path not in numbers_only

    return tuple(msgspec.structs.replace(action, held=True) if waits(action) else action for action in actions)


def records_after(actions: Iterable[Action]) -> dict[str, FileRecord]:
    """Return the manifest's entry of each file once the actions are done; `package.order` files have none.

    While something waits, files that are gone are recorded still: their lines in `package.order` wait, too.
    """
    every, records = tuple(actions), dict[str, FileRecord]()
    waits = any(action.held or action.kind in CONFLICTS for action in every)
    for action in every:
        base, state = action.generated, RecordState.GENERATED
        if action.role is Role.ORDER:
            continue
        is_left = waits and action.kind is Kind.FORGET and not action.released
        if action.held or is_left or action.kind in CONFLICTS:
            state = RecordState.CONFLICT if action.kind in CONFLICTS else RecordState.WAITING
            chosen_for = sides_hash(action.mine, action.generated) if action.choice else None
            pending = action.origin, action.replaced_hash, action.choice, chosen_for
            records[action.path] = FileRecord(action.owner, action.role, action.base, state, *pending)
            continue
        if action.kind in (Kind.KEEP, Kind.INCLUDED) or (action.result or base) != base:
            state = RecordState.EDITED
        elif action.kind in (Kind.ORPHAN, Kind.NEEDED):
            base, state = action.base, RecordState.ORPHAN
        elif base is None:
            continue
        records[action.path] = FileRecord(action.owner, action.role, base, state)
    return records


def sides_hash(mine: str | None, generated: str | None) -> str:
    """Return one hash for the texts of both sides, from theirs."""
    return hashlib.sha256(f"{mine} {generated}".encode()).hexdigest()


def remembered_choices(recorded: Mapping[str, FileRecord], actions: Iterable[Action]) -> dict[str, Choice]:
    """Return the recorded choices of the user that still hold."""
    return {
        action.path: record.choice
        for action in actions
        if (record := recorded.get(action.path) or recorded.get(action.origin or "")) is not None
        and record.choice is not None
        and record.chosen_for == sides_hash(action.mine, action.generated)
    }

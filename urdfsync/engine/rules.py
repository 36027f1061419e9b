"""What to do with each file: decided from its recorded base, what is on disk, and what would be written now.

*Base* is the generated text that the file on disk last took into account, *mine* is on disk, *generated* would be
written. All are compared by hashes, never by times. Everything here is pure.
"""

from __future__ import annotations

import enum
from collections.abc import Callable, Collection, Iterable, Mapping
from typing import TypeAlias

import msgspec

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Kind, Reason
from urdfsync.state.record import Choice, FileRecord


class DesiredFile(msgspec.Struct, frozen=True):
    """A file that the package should have."""

    role: Role
    owner: str
    hash: str


class ClassFolder(enum.Enum):
    """Stands for the hash of a missing file whose class the user has made a folder of (`X/package.mo`).

    It is no string, so that no hash in a stranger's record is equal to it.
    """

    CLASS_FOLDER = enum.auto()


CLASS_FOLDER = ClassFolder.CLASS_FOLDER
OnDisk: TypeAlias = str | ClassFolder | None
"""Hash of what is at a path; None for nothing."""

_NEVER_WRITTEN = FileRecord()


def decide_file(base: str | None, mine: OnDisk, generated: str | None) -> Reason:
    """Decide on one file by the table of the design; a hash is None where there is no such text."""
    if generated is None:
        if base is None or mine is None:
            return Reason.FORGET
        return Reason.DELETE if mine == base else Reason.ORPHAN
    if mine is None:
        return Reason.CREATE if base is None else Reason.RESTORE
    if mine == generated:
        return Reason.UNCHANGED if base == generated else Reason.ADOPT
    if base is None:
        return Reason.UNOWNED
    if mine == base:
        return Reason.UPDATE
    return Reason.KEEP if generated == base else Reason.CONFLICT


def decide(
    recorded: Mapping[str, FileRecord],
    desired: Mapping[str, DesiredFile],
    on_disk: Mapping[str, OnDisk],
    moves: Mapping[str, str],
    known: Mapping[str, tuple[Role, str]],
) -> tuple[Action, ...]:
    """Decide on every file of a robot; `on_disk` has the hashes of the files that are there, or CLASS_FOLDER.

    `moves` has new and old path of files whose element was renamed. A file that the user edited goes to its new path
    (MOVE, and LEAVE at the old one), unless something else of the user's is there. `known` has role and owner of
    recorded files.
    """
    edited = _edited_moves(recorded, on_disk, moves)
    left = set(edited.values())
    actions = []
    for path in sorted(recorded.keys() | desired.keys()):
        record, target = recorded.get(path, _NEVER_WRITTEN), desired.get(path)
        mine, generated = on_disk.get(path), target.hash if target else None
        base, origin = record.base(mine, generated), None
        old = moves.get(path) if target else None
        there = on_disk.get(old) if old else None
        old_base = recorded[old].base(there, generated) if old else None
        if old and path in edited:
            reason, origin, base, mine = Reason.MOVE, old, old_base, there
        elif old and old_base and there == old_base and mine != generated and _is_free(record, mine):
            reason, origin, base = Reason.CREATE if mine is None else Reason.UPDATE, old, old_base
        elif path in left and target is None:
            reason, mine = Reason.MOVED_AWAY, None
        else:
            if path in left:
                base, mine = None, None
            elif old_base and there is None and isinstance(mine, str) and path not in recorded:
                base = old_base  # the user moved the file there by hand
            reason = decide_file(base, mine, generated)
            if reason is Reason.DELETE and record.is_ambiguous:
                reason = Reason.ORPHAN
        if reason is Reason.FORGET and (record.is_users or not record.hashes):
            continue  # it was never written, and is not wanted any more; or it is the user's
        role, owner = (target.role, target.owner) if target else known[path]
        on_disk_hash = mine if isinstance(mine, str) else None
        actions.append(Action(path, reason, role, owner, base, generated, origin, mine=on_disk_hash))
    return tuple(actions)


def _edited_moves(
    recorded: Mapping[str, FileRecord], on_disk: Mapping[str, OnDisk], moves: Mapping[str, str]
) -> dict[str, str]:
    """Return new and old path of the edited files that move with their elements."""
    edited = {
        new: old
        for new, old in moves.items()
        if isinstance(mine := on_disk.get(old), str) and recorded[old].hashes and mine not in recorded[old].hashes
    }
    taken = {path for path in moves if not _is_free(recorded.get(path, _NEVER_WRITTEN), on_disk.get(path))}
    # an edited file that can't move blocks the one that would take its place, and so on
    while blocked := edited.keys() & taken - set(edited.values()):
        edited = {new: old for new, old in edited.items() if new not in blocked}
    return edited


def _is_free(record: FileRecord, mine: OnDisk) -> bool:
    """Whether nothing of the user's is at a path: no file, or one that urdfsync wrote there."""
    return mine is None or mine in record.hashes


def keep_needed(
    actions: Iterable[Action], has_classes: Callable[[str, Collection[str]], bool], used: Collection[str]
) -> tuple[Action, ...]:
    """Keep what the user's files need: the records in `used`, and the `package.mo` of a folder with classes.

    `has_classes(path, gone)` tells whether the folder of the `package.mo` at `path` holds classes other than the files
    in `gone`.
    """
    actions = tuple(actions)
    gone = {action.path: action for action in actions if action.kind is Kind.DELETE}
    kept = {path: msgspec.structs.replace(gone[path], reason=Reason.NEEDED) for path in used if path in gone}
    packages = [path for path, action in gone.items() if action.role is Role.PACKAGE]
    for path in sorted(packages, key=lambda path: path.count("/"), reverse=True):  # innermost first
        if has_classes(path, gone.keys() - kept.keys()):
            kept[path] = msgspec.structs.replace(gone[path], reason=Reason.NEEDED)
    return tuple(kept.get(action.path, action) for action in actions)


def hold(
    actions: Iterable[Action], numbers_only: Collection[str], origins: Collection[str], moves: bool
) -> tuple[Action, ...]:
    """Put off structural changes of a robot while one of its files is in conflict.

    Still written are files after which the package compiles: records of which only numbers change (their paths are
    `numbers_only`), imported files, and files that are restored or taken as they were; but none of `origins`, which
    elements leave that have another name now. Nothing is if the package `moves`. Conflicts about numbers alone put off
    nothing else.
    """
    actions = tuple(actions)
    if all(action.path in numbers_only and not moves for action in actions if action.kind is Kind.CONFLICT):
        return actions

    def waits(action: Action) -> bool:
        if not action.writes:
            return action.choice is not None and action.kind is not Kind.CONFLICT
        if action.choice is Choice.UNDO and not moves:
            return False
        if moves or action.origin is not None or action.path in origins:
            return True
        if action.role is Role.IMPORT:
            return action.reason is Reason.DELETE
        if action.reason is Reason.RESTORE:
            return action.role is Role.ORDER or action.base != action.generated
        if action.choice is Choice.TAKE and action.base == action.generated:
            return False
        return action.reason not in (Reason.UPDATE, Reason.MERGE) or action.path not in numbers_only

    return tuple(msgspec.structs.replace(action, held=True) if waits(action) else action for action in actions)


def files_after(actions: Iterable[Action], recorded: Mapping[str, FileRecord]) -> dict[str, FileRecord]:
    """Return the records of a package's files after a build that did all of its actions."""
    found = {path: one for path, one in recorded.items() if one.is_users}
    for action in actions:
        if action.role is Role.ORDER:
            continue
        if action.reason in (Reason.ORPHAN, Reason.NEEDED):
            hashes = recorded[action.path].hashes
            # one is left of an ambiguous base: not that of the file, or the next build would delete it
            found[action.path] = FileRecord((next((one for one in hashes if one != action.mine), hashes[0]),))
        elif action.handed_to_user:
            found[action.path] = FileRecord(is_users=True)
        elif action.generated is not None:
            found[action.path] = FileRecord((action.generated,))
    return found


def renewed_files(actions: Iterable[Action]) -> dict[str, FileRecord]:
    """Return the records of the files that are as generated after a build that left others waiting."""
    return {
        action.path: FileRecord((action.generated,))
        for action in actions
        if action.role is not Role.ORDER
        and action.generated is not None
        and (action.reason in (Reason.UNCHANGED, Reason.ADOPT) or (action.writes and action.kind is not Kind.DELETE))
    }


def pending_choices(actions: Iterable[Action]) -> dict[tuple[str, str], Choice]:
    """Return the user's choices that wait, by path and by the two texts that they were made on."""
    waiting = (one for one in actions if one.choice and one.held and one.choice is not Choice.UNDO)
    return {(one.path, one.sides): one.choice for one in waiting if one.choice}


def remembered_choices(pending: Mapping[tuple[str, str], Choice], actions: Iterable[Action]) -> dict[str, Choice]:
    """Return the pending choices that still hold, by path: neither side has changed since.

    An edited file that nothing is new for waits for nothing: a state that says so is not urdfsync's.
    """
    found = valid_choices(pending, (one for one in actions if one.reason is not Reason.KEEP))
    return {path: choice for path, choice in found.items() if choice is not Choice.UNDO}


def valid_choices(choices: Mapping[tuple[str, str], Choice], actions: Iterable[Action]) -> dict[str, Choice]:
    """Return the choices of which both texts are still those that they were made on, by path."""
    return {one.path: choices[one.path, one.sides] for one in actions if (one.path, one.sides) in choices}

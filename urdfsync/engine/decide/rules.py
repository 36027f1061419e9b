"""The decision about each file: from its recorded base, the file on disk, and the generated text.

*Base* is the last generated text that the file on disk contains or was merged with. *Mine* is the text on disk.
*Generated* is the text from the present source. The rules compare hashes, never times. All functions here are pure.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

import msgspec

from urdfsync.domain import Role
from urdfsync.engine.actions import ORPHANS, Action, Reason
from urdfsync.engine.inspect.package_files import OnDisk


class File(msgspec.Struct, frozen=True):
    """One file of a package before the build."""

    role: Role
    owner: str = ""
    base: str | None = None
    """Hash of the base; None if no build wrote the file."""
    on_disk: OnDisk = None
    generated: str | None = None
    """Hash of the generated text; None if the file is not generated."""

    @property
    def is_free(self) -> bool:
        """Whether no text of the user is at the path: the file is missing or unedited."""
        return self.on_disk is None or self.on_disk == self.base

    @property
    def is_edited(self) -> bool:
        """Whether the user changed a file that urdfsync wrote."""
        return isinstance(self.on_disk, str) and self.base is not None and self.on_disk != self.base


def decide_file(base: str | None, mine: OnDisk, generated: str | None) -> Reason:
    """Decide on one file by the table of docs/conflicts.md; a hash is None for a missing text."""
    if generated is None:
        if base is None or mine is None:
            return Reason.FORGET
        return Reason.DELETE if mine == base else Reason.ORPHAN
    if mine is None:
        return Reason.CREATE if base is None else Reason.RESTORE
    if mine == generated:
        return Reason.UNCHANGED
    if base is None:
        return Reason.UNOWNED
    if mine == base:
        return Reason.UPDATE
    return Reason.KEEP if generated == base else Reason.CONFLICT


def decide(files: Mapping[str, File], moves: Mapping[str, str]) -> tuple[Action, ...]:
    """Decide on every file of a robot, by path.

    `moves` has old paths by new paths of files whose element was renamed. An edited file moves to its new path (MOVE,
    and MOVED_AWAY at the old path), unless a user's file is there.
    """
    edited = _edited_moves(files, moves)
    origins = set(edited.values())
    actions = []
    for path, file in sorted(files.items()):
        mine, generated, origin = file.on_disk, file.generated, None
        base = file.base
        old = moves.get(path) if generated is not None else None
        old_mine = files[old].on_disk if old else None
        old_base = files[old].base if old else None
        if old and path in edited:
            reason, origin, base, mine = Reason.MOVE, old, old_base, old_mine
        elif old and old_base and old_mine == old_base and mine != generated and file.is_free:
            reason, origin, base = Reason.CREATE if mine is None else Reason.UPDATE, old, old_base
        elif path in origins and generated is None:
            reason, mine = Reason.MOVED_AWAY, None
        else:
            if path in origins:
                base, mine = None, None
            elif old_base and old_mine is None and isinstance(mine, str) and file.base is None:
                base = old_base  # the user moved the file there by hand
            reason = decide_file(base, mine, generated)
        if reason is Reason.FORGET and file.base is None:
            continue  # no build wrote this file, and it is no longer generated
        on_disk_hash = mine if isinstance(mine, str) else None
        actions.append(Action(path, reason, file.role, file.owner, base, generated, origin, mine=on_disk_hash))
    return tuple(actions)


def _edited_moves(files: Mapping[str, File], moves: Mapping[str, str]) -> dict[str, str]:
    """Return the old paths by new paths of the edited files that move with their elements."""
    edited = {new: old for new, old in moves.items() if files[old].is_edited}
    taken = {path for path in moves if not files[path].is_free}
    # if an edited file can't move, no other file can move to its path, and so on
    while blocked := edited.keys() & taken - set(edited.values()):
        edited = {new: old for new, old in edited.items() if new not in blocked}
    return edited


def put_off(
    actions: Iterable[Action], value_only_keys: Collection[str], origins: Collection[str], *, has_moved: bool
) -> tuple[Action, ...]:
    """Let structural changes of a robot wait while one of its files is in conflict.

    A build still writes files that keep the package valid: records with changed numbers (`value_only_keys`), imported
    files, and restored files. `origins` are the old files of renamed elements; these files wait. If the package
    `has_moved`, all files wait. If all conflicts are only about numbers, no file waits.
    """
    actions = tuple(actions)
    if all(action.path in value_only_keys and not has_moved for action in actions if action.is_conflict):
        return actions

    def waits(action: Action) -> bool:
        if not action.writes:
            return False
        if has_moved or action.origin is not None or action.path in origins:
            return True
        if action.role is Role.IMPORT:
            return action.reason is Reason.DELETE
        if action.reason is Reason.RESTORE:
            return action.role is Role.ORDER or action.base != action.generated
        return action.reason not in (Reason.UPDATE, Reason.MERGE) or action.path not in value_only_keys

    return tuple(msgspec.structs.replace(action, is_waiting=True) if waits(action) else action for action in actions)


def file_records_after(actions: Iterable[Action], recorded: Mapping[str, str], *, is_complete: bool) -> dict[str, str]:
    """Return the records of a package's files after a build.

    A complete build renews the records of all files. An incomplete build renews only the records of files that it wrote
    or found in step, or that have taken their generated text into account: a killed build may have written them.
    """
    records = {} if is_complete else dict(recorded)
    for action in actions:
        is_generated = action.reason is Reason.UNCHANGED or action.writes or action.base == action.generated
        if action.role is Role.ORDER or not (is_complete or is_generated):
            continue
        if action.generated is not None:
            records[action.path] = action.generated
        elif is_complete and action.reason in ORPHANS and action.base is not None:
            records[action.path] = action.base
    return records

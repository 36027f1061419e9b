"""Files that both sides changed: their texts, what the user may decide about them, and what becomes of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, NamedTuple

import msgspec

from urdfsync.engine.actions import CONFLICTS, Action, Kind
from urdfsync.state.record import Choice

if TYPE_CHECKING:
    from urdfsync.merge import Merge


class Conflict(msgspec.Struct, frozen=True):
    """One text file in conflict: the three texts as they are, line endings included."""

    path: str
    """Path of the generated text as in the manifest: from the configuration's folder, POSIX."""
    owner: str
    """Element that the file belongs to, in the domain's words."""
    base: str | None
    """Text that urdfsync wrote last; None if it is not known, or urdfsync never wrote the file."""
    mine: str
    generated: str
    merge: Merge | None
    """None without a base. Its `text` is None if both sides changed the same, or if the result makes no sense."""
    origin: str | None = None
    """Path of the user's file, if its element was renamed; None if it is at `path`."""
    rejected: str = ""
    """Why there is no merge although the sides do not contradict each other, as a clause; empty if there is one."""

    @property
    def place(self) -> str:
        """Path of the user's file."""
        return self.origin or self.path


class ConflictFiles(NamedTuple):
    """Paths of the versions of a file in conflict, below the robot's folder in `.urdfsync/conflicts`."""

    generated: str
    base: str | None
    merge: str | None


def conflict_files(conflict: Conflict, folder: str) -> ConflictFiles:
    """Return where the versions of a file in conflict are put; `folder` is the package's.

    A proposed merge with markers in it is no Modelica, so it gets the suffix `.txt`.
    """
    path = PurePosixPath(conflict.path).relative_to(folder)
    stem, suffix = path.with_suffix("").as_posix(), path.suffix
    merged = conflict.merge
    return ConflictFiles(
        generated=f"{stem}.generated{suffix}",
        base=None if conflict.base is None else f"{stem}.base{suffix}",
        merge=None if merged is None else f"{stem}.merge{'.txt' if merged.text is None else suffix}",
    )


def find_conflict(action: Action, base: str | None, mine: str, generated: str) -> Conflict:
    """Merge the texts of a file; a merge that is no sound Modelica is rejected."""
    from urdfsync.merge import merge

    merged = None if base is None else merge(base, mine, generated, is_modelica=action.path.endswith(".mo"))
    rejected = f"the merge {merged.flaw}" if merged and merged.flaw else ""
    return Conflict(action.path, action.owner, base, mine, generated, merged, action.origin, rejected)


def resolve(
    actions: Iterable[Action], conflicts: Mapping[str, Conflict], choices: Mapping[str, Choice], merging: bool
) -> tuple[tuple[Action, ...], dict[str, str]]:
    """Decide on every file that both sides changed, and on orphans that the user decided about.

    Returns the actions, and the texts of merged files by path. `conflicts` has the disputed text files by path. A merge
    is taken only if the file moves with its element, if the user chose it, or if the configuration allows clean merges
    (`merging`).
    """
    found, texts = [], {}
    for action in actions:
        conflict, choice = conflicts.get(action.path), choices.get(action.path)
        merged = conflict.merge.text if conflict and conflict.merge else None
        kind, base, text = action.kind, action.base, None
        if kind is Kind.ORPHAN:
            if choice is Choice.TAKE and action.mine is not None:
                kind = Kind.DELETE
            elif choice is Choice.KEEP:
                kind = Kind.FORGET
            else:
                choice = None
        elif kind is Kind.MOVE and conflict:
            text = None if choice is Choice.TAKE else conflict.mine if choice is Choice.KEEP else merged
            if text is None and choice is not Choice.TAKE:
                kind = Kind.CONFLICT
        elif kind not in CONFLICTS:
            choice = action.choice
        elif conflict and merged == conflict.mine:
            kind, choice = Kind.INCLUDED, None
        elif choice is Choice.KEEP:
            kind, base = Kind.KEEP, action.generated
        elif choice is Choice.TAKE and action.replaceable:
            kind = Kind.UPDATE
        elif merged is not None and (choice is Choice.MERGE or merging):
            kind, text = Kind.MERGE, merged
        if (kind, base, choice) != (action.kind, action.base, action.choice):
            action = msgspec.structs.replace(action, kind=kind, base=base, choice=choice)
        found.append(action)
        if text is not None:
            texts[action.path] = text
    return tuple(found), texts

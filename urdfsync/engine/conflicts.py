"""Files that both sides changed: their texts, what the user may decide about them, and what becomes of them."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

import msgspec

from urdfsync.engine.actions import Action, Reason
from urdfsync.state.record import Choice, UsersChoice

if TYPE_CHECKING:
    from urdfsync.merge import Merge


PREFERENCES = frozenset({Choice.MERGE_MINE, Choice.MERGE_GENERATED})
"""Choices to take both sides' changes, and one side's where they contradict each other."""
MERGES = PREFERENCES | {Choice.MERGE}
"""Choices to take both sides' changes."""
BOTH_SIDES = MERGES | {Choice.EDIT}
"""Choices that make one text of both sides."""


class Conflict(msgspec.Struct, frozen=True):
    """One text file in conflict: the three texts as they are, line endings included."""

    path: str
    """Path of the generated text as in the record: from the configuration's folder, POSIX."""
    base: str | None
    """Text that urdfsync wrote last; None if it is not known, or urdfsync never wrote the file."""
    mine: str
    generated: str
    merge: Merge | None
    """None without a base. Its `text` is None if both sides changed the same, or if the result makes no sense."""
    origin: str | None = None
    """Path of the user's file, if its element was renamed; None if it is at `path`."""
    kept: str = ""
    """The user's text as it stays if he keeps it: at its new path, what was renamed has its new name in it."""
    rejected: str = ""
    """Why there is no merge although the sides do not contradict each other, as a clause; empty if there is one."""
    refused: frozenset[Choice] = frozenset()
    """Preferences of a side that would bring in a name that means nothing."""

    def merged(self, choice: Choice | None, edited: str | None = None) -> str | None:
        """Return the merged text that a choice asks for; None if there is none. `edited` is the user's own."""
        if choice is Choice.EDIT:
            return edited
        if self.merge is None or self.merge.text is not None or choice not in PREFERENCES:
            return self.merge.text if self.merge else None
        if choice in self.refused:
            return None
        return self.merge.with_mine if choice is Choice.MERGE_MINE else self.merge.with_generated


def conflict_files(conflict: Conflict, folder: str) -> dict[str, tuple[str, str]]:
    """Return the versions that are put aside of a file in conflict: `base`, `generated` and `merge`, if there are such.

    Each has its path below the robot's folder in `.urdfsync/conflicts`, and its text; `folder` is the package's. A
    proposed merge with markers in it is no Modelica, so it gets the suffix `.txt`.
    """
    path, merge = PurePosixPath(conflict.path).relative_to(folder), conflict.merge
    stem, suffix = path.with_suffix("").as_posix(), path.suffix
    versions = {} if conflict.base is None else {"base": (f"{stem}.base{suffix}", conflict.base)}
    versions["generated"] = f"{stem}.generated{suffix}", conflict.generated
    if merge is not None:
        versions["merge"] = f"{stem}.merge{'.txt' if merge.text is None else suffix}", merge.proposal
    return versions


def find_conflict(
    action: Action, bases: Sequence[str], mine: str, generated: str, names: Mapping[str, str] | None = None
) -> Conflict:
    """Merge the texts of a file; a merge that is no sound Modelica is rejected, and so is one that is ambiguous.

    `bases` are all texts that may be the base, best first; `names` has new names by the old ones.
    """
    from urdfsync.merge import merge
    from urdfsync.merge.renames import rename, without_clashes

    is_modelica = action.path.endswith(".mo")
    edited = over_bases(bases, mine, is_modelica=is_modelica) or [(base, mine) for base in bases]
    merges = [merge(base, text, generated, is_modelica=is_modelica, names=names) for base, text in edited]
    first = merges[0] if merges else None
    rejected = f"the merge {first.flaw}" if first and first.flaw else ""
    if first and any(other.text != first.text for other in merges):
        first = first.rejected
        rejected = "two branches recorded different bases, which give different merges"
    base = bases[0] if bases else None
    kept = rename(base, mine, without_clashes(names, mine))[1] if names and base and action.origin else mine
    texts = base, mine, generated, first
    return Conflict(action.path, *texts, origin=action.origin, kept=kept, rejected=rejected)


def over_bases(bases: Sequence[str], mine: str, *, is_modelica: bool) -> list[tuple[str, str]]:
    """Return the edits of a file as edits of its last base and of its first one: the base, and that with the edits.

    Git may have united what several branches recorded: what one of these texts has is no edit of another. A base is
    left out that the edits contradict.
    """
    from urdfsync.merge import merge

    edited = []
    for way in dict.fromkeys([tuple(bases), tuple(reversed(bases))]):
        text: str | None = mine
        for base, other in itertools.pairwise(way):
            text = None if text is None else merge(base, text, other, is_modelica=is_modelica).text
        if text is not None and way:
            edited.append((way[-1], text))
    return edited


def resolve(
    actions: Iterable[Action], conflicts: Mapping[str, Conflict], choices: Mapping[str, UsersChoice], merging: bool
) -> tuple[tuple[Action, ...], dict[str, str]]:
    """Decide on every file that both sides changed, and on orphans that the user decided about.

    Returns the actions, and the texts of merged files by path. `conflicts` has the disputed text files by path. A merge
    is taken only if the file moves with its element, if the user chose it, or if the configuration allows clean merges
    (`merging`).
    """
    resolved, texts = [], {}
    for action in actions:
        reason, choice, text = _outcome(action, conflicts.get(action.path), choices.get(action.path), merging)
        if text is not None:
            texts[action.path] = text
        if (reason, choice, text) != (action.reason, action.choice, None):
            base = action.generated if reason is Reason.KEEP else action.base
            action = msgspec.structs.replace(action, reason=reason, base=base, choice=choice)
        resolved.append(action)
    return tuple(resolved), texts


def _outcome(
    action: Action, conflict: Conflict | None, chosen: UsersChoice | None, merging: bool
) -> tuple[Reason, Choice | None, str | None]:
    """Return what happens to a file, the choice that counts, and the text that it gets if that is not the generated."""
    choice = chosen.choice if chosen else None
    merged = conflict.merged(choice, chosen.text if chosen else None) if conflict else None
    if conflict and choice is Choice.EDIT and merged == conflict.mine:
        choice, merged = Choice.KEEP, None
    if action.reason is Reason.ORPHAN:
        if choice is Choice.TAKE and action.is_on_disk:
            return Reason.DELETE, choice, None
        return (Reason.FORGET, choice, None) if choice is Choice.KEEP else (Reason.ORPHAN, None, None)
    if action.reason is Reason.MOVE and conflict:
        text = None if choice is Choice.TAKE else conflict.kept if choice is Choice.KEEP else merged
        return Reason.CONFLICT if text is None and choice is not Choice.TAKE else Reason.MOVE, choice, text
    if action.reason is not Reason.KEEP and not action.is_conflict:
        return action.reason, action.choice, None
    if choice is Choice.TAKE and action.is_on_disk:
        return Reason.UPDATE, choice, None
    if action.reason is Reason.KEEP:
        return Reason.KEEP, action.choice, None
    if conflict and merged == conflict.mine:  # by a preference for the user's side, which has to be remembered
        return (Reason.KEEP, choice, None) if choice in PREFERENCES else (Reason.INCLUDED, None, None)
    if choice is Choice.KEEP:
        return Reason.KEEP, choice, None
    if merged is not None and (choice in BOTH_SIDES or merging):
        return Reason.MERGE, choice, merged
    return action.reason, choice, None

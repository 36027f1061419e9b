"""Files that both sides changed: their texts, their merges, and the user's choices."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from typing import TYPE_CHECKING

import msgspec

from urdfsync.domain.matching import Doubt
from urdfsync.engine.actions import Action, Choice, Reason

if TYPE_CHECKING:
    from urdfsync.merge import Merge


PREFERENCES = Choice.MERGE_MINE, Choice.MERGE_GENERATED, Choice.MERGE_THEIRS
"""Choices that merge both sides' changes, and take one side's text for each contradiction; the best first."""


class Conflict(msgspec.Struct, frozen=True):
    """One text file in conflict; its texts have the line endings of the files."""

    path: str
    """Path of the generated text as in the record: from the configuration's folder, POSIX."""
    base: str | None
    """The last generated text that *mine* contains or was merged with; None if this text is missing or lost."""
    mine: str
    generated: str
    merge: Merge | None
    """The merge; None without a base. Its `text` is None if the changes contradict each other, or if the merge was
    rejected."""
    origin: str | None = None
    """Path of the user's file, if its element was renamed; None if it is at `path`."""
    rejected: str = ""
    """Why the merge was rejected, as a clause; empty if it was not rejected."""
    moved_to: str = ""
    """The likely new name of the edited element, if the file may belong to another element now."""
    names: Mapping[str, str] = {}
    """New names by old names, with which `merge` was made."""
    renamed: str = ""
    """The new names of the elements in the file, as a clause; empty if all have their names."""
    refused: Mapping[Choice, str] = {}
    """The choices of `PREFERENCES` that would bring an unknown name into the file, each with the reason as a clause."""
    is_of_branches: bool = False
    """Whether `merge` is that of two branches: git left both in *mine*, or one of them. Then *theirs* is the other side
    of a contradiction, in place of *generated*."""

    def merged(self, choice: Choice | None) -> str | None:
        """Return the merged text for a choice, or without a choice; None if there is none."""
        if self.merge is None or self.merge.text is not None or choice not in PREFERENCES:
            return self.merge.text if self.merge else None
        if choice in self.refused or choice is (Choice.MERGE_GENERATED if self.is_of_branches else Choice.MERGE_THEIRS):
            return None
        return self.merge.with_mine if choice is Choice.MERGE_MINE else self.merge.with_generated


def find_conflict(
    action: Action, base: str | None, mine: str, generated: str, names: Mapping[str, str] | None = None
) -> Conflict:
    """Merge the texts of a file, if its base is known. Wrong Modelica is rejected; `names` has new by old names."""
    from urdfsync.merge.texts import merge

    merged = None
    if base is not None:
        merged = merge(base, mine, generated, is_modelica=action.path.endswith(".mo"), names=names)
    rejected = f"the merge {merged.flaw}" if merged and merged.flaw else ""
    texts = base, mine, generated, merged
    return Conflict(action.path, *texts, origin=action.origin, rejected=rejected, names=names or {})


def only_names_changed(conflict: Conflict, names: Mapping[str, str]) -> bool:
    """Return whether the generated text is its base with new names (`names`, by old names), also in descriptions.

    Some words may stay: a link may be called as an argument is, such as `upper`.
    """
    if conflict.base in (None, conflict.generated) or not names:
        return False
    listed = "|".join(map(re.escape, sorted({*names, *names.values()}, key=len, reverse=True)))
    nameless = (re.sub(rf"(?<!\w)(?:{listed})(?!\w)", "\0", str(text)) for text in (conflict.base, conflict.generated))
    return len(set(nameless)) == 1


def resolve(
    actions: Iterable[Action],
    conflicts: Mapping[str, Conflict],
    *,
    merging: bool,
    choice: Choice | None = None,
    renamed: Collection[str] = (),
) -> tuple[tuple[Action, ...], dict[str, str]]:
    """Decide on every file that the user and the source changed.

    Returns the actions, and the texts of merged files by path. `conflicts` has the disputed text files by path. A file
    that moves with its element takes the merge, and so does a file in which only names changed (`renamed`). Other files
    take it only if the configuration allows clean merges (`merging`). A `choice` of `PREFERENCES` decides
    contradictions for one side.
    """
    resolved, texts = [], {}
    for action in actions:
        conflict = conflicts.get(action.path)
        merged = conflict.merged(choice) if conflict else None
        reason = action.reason
        if reason is Reason.MOVE and conflict:
            reason = Reason.CONFLICT if merged is None else Reason.MOVE
        elif action.is_conflict and conflict and merged is not None:
            is_merging = merging or action.path in renamed
            reason = Reason.KEEP if merged == conflict.mine else Reason.MERGE if is_merging else reason
        if merged is not None and reason in (Reason.MOVE, Reason.MERGE):
            texts[action.path] = merged
        resolved.append(action if reason is action.reason else msgspec.structs.replace(action, reason=reason))
    return tuple(resolved), texts


def describe_doubt(doubt: Doubt, *, is_used: bool = False) -> str:
    """Return the doubt as a clause; `is_used` if a file of the whole robot uses the element's name."""
    name, aspects = doubt.element.partition(" ")[2], " and ".join(doubt.aspects)
    subject = f"it uses `{name}`, which" if is_used else f"`{name}`"
    if doubt.is_named_alike:
        return f"{subject} may be another part now: only its name is as before"
    if doubt.is_certain:
        called = f"; the part of your edit is called `{doubt.moved_to}`" if doubt.moved_to else ""
        return f"{subject} is another part now{f', the former `{doubt.former}`' if doubt.former else called}"
    if doubt.former and not aspects:
        return f"{subject} may be the former `{doubt.former}` now"
    shared = f"its {aspects} {'are those' if len(doubt.aspects) > 1 else 'is that'} of the former `{doubt.former}`"
    neighbours = "parts next to it, or like it, have other names"
    return f"{subject} may be another part now: {shared if doubt.former else neighbours}"

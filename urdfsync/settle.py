"""What becomes of files that both sides changed: by what the user chose, by the merge, and by the configuration."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

import msgspec

from urdfsync.merge import merge
from urdfsync.plan import CONFLICTS, Action, Kind
from urdfsync.standoff import Choice, Standoff


class Settled(NamedTuple):
    """An action that is final but for the wait for others, and the text that it writes if that is not the generated."""

    action: Action
    text: str | None = None


def stand_off(action: Action, base: str | None, mine: str, generated: str) -> Standoff:
    """The three texts of a file, and what comes of merging them; a merge that makes no sense is none."""
    merged = None if base is None else merge(base, mine, generated, is_modelica=action.path.endswith(".mo"))
    rejected = f"the merge {merged.flaw}" if merged and merged.flaw else ""
    return Standoff(action.path, action.owner, base, mine, generated, merged, action.origin, rejected)


def reject_merge(standoff: Standoff, name: str, line: int) -> Standoff:
    """The same without its merge, which uses a name that the package loses."""
    if standoff.merge is None:
        return standoff
    reason = f"the merge mentions `{name}`, which the package has no more (line {line})"
    return msgspec.structs.replace(standoff, merge=msgspec.structs.replace(standoff.merge, text=None), rejected=reason)


def settle(
    actions: Iterable[Action], standoffs: Mapping[str, Standoff], choices: Mapping[str, Choice], merging: bool
) -> tuple[Settled, ...]:
    """Decide on every file that both sides changed, and on orphans that the user decided about.

    `standoffs` has the texts of those files by their path, as far as they are texts. Nobody's edits are merged unless
    the file goes to another path, the user chose it, or `merging` says that clean merges are welcome.
    """
    return tuple(_settled(action, standoffs.get(action.path), choices.get(action.path), merging) for action in actions)


def _settled(action: Action, standoff: Standoff | None, choice: Choice | None, merging: bool) -> Settled:
    if action.kind is Kind.ORPHAN:
        if choice is Choice.TAKE and action.mine is not None:
            return Settled(msgspec.structs.replace(action, kind=Kind.DELETE, choice=choice))
        if choice is Choice.KEEP:
            return Settled(msgspec.structs.replace(action, kind=Kind.FORGET, choice=choice))
        return Settled(action)
    if action.kind is Kind.MOVE and standoff:
        return _moved(action, standoff, choice)
    if action.kind not in CONFLICTS:
        return Settled(action)
    merged = standoff.merge.text if standoff and standoff.merge else None
    if standoff and merged == standoff.mine:
        return Settled(_with(action, Kind.INCLUDED))
    action = msgspec.structs.replace(action, choice=choice)
    if choice is Choice.KEEP:
        return Settled(msgspec.structs.replace(action, kind=Kind.KEEP, base=action.generated))
    if choice is Choice.TAKE and action.replaceable:
        return Settled(_with(action, Kind.UPDATE))
    if merged is not None and (choice is Choice.MERGE or merging):
        return Settled(_with(action, Kind.MERGE), merged)
    return Settled(action)


def _moved(action: Action, standoff: Standoff, choice: Choice | None) -> Settled:
    """A file that goes with its element's new name: merged, unless the user wants one of the sides."""
    action = msgspec.structs.replace(action, choice=choice)
    if choice is Choice.TAKE:
        return Settled(action)
    if choice is Choice.KEEP:
        return Settled(action, standoff.mine)
    if standoff.merge and standoff.merge.text is not None:
        return Settled(action, standoff.merge.text)
    return Settled(_with(action, Kind.CONFLICT))


def _with(action: Action, kind: Kind) -> Action:
    return msgspec.structs.replace(action, kind=kind)

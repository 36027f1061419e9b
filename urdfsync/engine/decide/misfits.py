"""Looks for misfits where a text of the user may have one: other builds do not load the parser."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

from urdfsync.engine.decide.package_after import PackageAfter

if TYPE_CHECKING:
    from urdfsync.engine.decide.fit import Misfit


def look_for_misfits(after: PackageAfter, only: Collection[str] | None = None) -> Sequence[Misfit]:
    """Find misfits in the user's files after all actions that do not wait; `only` limits the search to these keys."""
    if only is None and after.inputs.has_moved and any(action.is_waiting for action in after.actions):
        return ()  # the package does not move yet
    if not (after.users or (only is None and after.extended_orders)):
        return ()
    from urdfsync.engine.decide.fit import find_misfits  # this imports the parser: 15 of 220 ms of a build

    return find_misfits(after, only)

"""The decision about one robot's package: each step of `steps` makes the next one of it."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Self

import msgspec

from urdfsync.domain.matching import Doubt
from urdfsync.engine.actions import Action, Actions
from urdfsync.engine.decide.conflicts import Conflict
from urdfsync.engine.decide.differences import Differences
from urdfsync.engine.inspect.parents import SharedFile

if TYPE_CHECKING:
    from urdfsync.engine.decide.fit import Misfit


class Decision(msgspec.Struct, frozen=True, dict=True):
    """All actions of one robot, and the texts and findings about them."""

    differences: Differences
    """The differences from the last complete build; the actions follow from these."""
    actions: Actions
    texts: Mapping[str, str] = {}
    """New texts of every `package.order` and of merged files, by key; empty for no file."""
    doubts: Mapping[str, Doubt] = {}
    """Why edited files may belong to other parts, by key."""
    disputed: Mapping[str, Conflict] = {}
    """Texts of files that both sides changed, and of edited files that move, by key."""
    shared: tuple[SharedFile, ...] = ()
    """Changes of the `package.mo` and `package.order` files around the package, and around that of the last build."""
    misfits: tuple[Misfit, ...] = ()
    """Unknown names and syntax errors in the user's files."""
    names: Mapping[str, str] = {}
    """New names by old names, from before the choices; empty if no edit, no text in `aside` and no use of an exchanged
    name needs them."""

    def with_actions(self, actions: Iterable[Action], **others: Any) -> Self:
        """Return the decision with these actions, and other values of `others`."""
        return msgspec.structs.replace(self, actions=Actions(actions), **others)

    @property
    def conflicts(self) -> tuple[Conflict, ...]:
        """The texts of the files in conflict."""
        keys = [action.path for action in self.actions if action.is_conflict]
        return tuple(self.disputed[key] for key in keys if key in self.disputed)

    @functools.cached_property  # there are thousands of actions
    def is_complete(self) -> bool:
        """Whether nothing conflicts and nothing waits."""
        return not any(action.is_waiting or action.is_conflict for action in self.actions)

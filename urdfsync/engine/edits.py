"""The files of a package that the user has edited, with what urdfsync wrote last."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from urdfsync.domain import Role
from urdfsync.engine.actions import Reason
from urdfsync.engine.decide import decide_package
from urdfsync.engine.generation import Generation


class EditedFile(msgspec.Struct, frozen=True):
    """A text file that is not as it was written."""

    path: str
    """Where it is: a path from the configuration's folder, POSIX."""
    owner: str
    """Element that it belongs to, in the domain's words."""
    base: str | None
    """The generated text that it last took into account; None if that is lost, or if urdfsync never wrote it."""
    mine: str


def find_edited(generation: Generation) -> Iterator[EditedFile]:
    """Yield the edited files of a robot, in the order of their paths. Raises UrdfsyncError."""
    files = generation.inputs.files
    for action in decide_package(generation).actions:
        key = action.origin or action.path
        is_text = action.role not in (Role.IMPORT, Role.ORDER) and action.reason is not Reason.MOVED_AWAY
        if is_text and action.mine not in (None, action.base, action.generated):
            base = generation.inputs.last.base(action.base) if action.base else None
            if action.base == action.generated:  # it need not be stored yet, as before a package is adopted
                base = generation.package.content(generation.inputs.folder.path(action.path)).decode()
            yield EditedFile(key, action.owner, base, files.any_text(key))

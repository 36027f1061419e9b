"""Saves the versions of each file in conflict: base, generated, and a proposed merge, below `.urdfsync/conflicts`.

`resolve --edit` begins with a proposal that a person has changed; builds leave it there.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import PurePosixPath

import msgspec

from urdfsync.engine.decide.conflicts import Conflict
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.package_files import encode
from urdfsync.engine.result import SavedVersions
from urdfsync.project.state.store import saved_name
from urdfsync.project.state.transaction import FileChange


class SavedConflicts(msgspec.Struct, frozen=True):
    """The saved versions of all conflicts of a robot."""

    versions: Mapping[str, SavedVersions]
    """By path."""
    changes: Sequence[FileChange]


def save_conflicts(inputs: Inputs, conflicts: Sequence[Conflict]) -> SavedConflicts:
    """Return the writes that save the versions of conflicts, and the paths of the versions."""
    store, robot = inputs.store, inputs.robot.name
    existing, contents, saved = store.conflict_files(robot), dict[str, bytes](), dict[str, SavedVersions]()
    for conflict in conflicts:
        path, merge, files = PurePosixPath(inputs.folder.path(conflict.path)), conflict.merge, dict[str, str]()
        texts = {"base": conflict.base, "generated": conflict.generated, "merge": merge.proposal if merge else None}
        for kind, text in texts.items():
            if text is not None:  # a text with markers is no Modelica
                suffix = ".txt" if kind == "merge" and merge and merge.text is None else path.suffix
                files[kind] = saved_name(path.with_suffix(f".{kind}{suffix}").as_posix(), encode(text))
                contents[files[kind]] = encode(text)
        edited = existing.get(files.get("merge", ""), b"")
        is_changed = bool(edited.strip()) and edited != contents[files["merge"]]
        saved[conflict.path] = SavedVersions(files, edited.decode(errors="replace") if is_changed else None)
    return SavedConflicts(saved, store.save_conflicts(robot, contents))

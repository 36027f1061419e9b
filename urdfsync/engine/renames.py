"""Files whose element was renamed: their old paths and their new ones.

A file that the user edited moves with its element, unless something else of the user's is in its new place. A file
that waits for a conflict to be resolved stays at its `origin` until it can move.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

import msgspec

from urdfsync.state.record import FileRecord


class OnDisk(msgspec.Struct, frozen=True):
    """What is on disk at a path: the hash of a file, or None; then whether the class is a folder (`X/package.mo`)."""

    hash: str | None = None
    is_folder: bool = False


NO_FILE = OnDisk()


def renamed_files(
    recorded: Mapping[str, FileRecord], targets: Mapping[str, str], desired: Collection[str]
) -> dict[str, str]:
    """Return new and old path of the files that belong elsewhere now.

    `targets` has, for recorded paths, the path of the element's file now. A waiting file still is at its origin; the
    record of the origin itself then describes another element's file, or an older one.
    """
    waiting = {record.origin for record in recorded.values() if record.origin}
    found = {}
    for path, record in recorded.items():
        if path in targets and (record.origin or path not in waiting):
            old, new = record.origin or path, targets[path]
            if new in desired and new != old:
                found[new] = old
    return found


class Renames:
    """The renamed files of one plan; `places` is new and old path of each, see `renamed_files`."""

    def __init__(
        self, recorded: Mapping[str, FileRecord], on_disk: Mapping[str, OnDisk], places: Mapping[str, str]
    ) -> None:
        self._recorded, self._on_disk, self._places = recorded, on_disk, places
        self._waiting = {record.origin: record for record in recorded.values() if record.origin}
        self.edited = self._edited()
        """New and old path of files that the user edited and that can move."""
        self.moved_away = frozenset(self.edited.values())
        """The old paths of these."""

    def base(self, new: str, old: str) -> str | None:
        """Return the base of a file that moves from `old` to `new`; it may have waited to move elsewhere before."""
        there = self._recorded.get(new)
        waiting = there if there and there.origin == old else self._waiting.get(old)
        if waiting is not None:
            return waiting.base
        return self._recorded[old].written_hash if old in self._recorded else None

    def unedited_source(self, new: str) -> str | None:
        """Return the old path of an unedited file, if the new place is free; None otherwise."""
        old = self._places.get(new)
        if old is None or (base := self.base(new, old)) is None:
            return None
        return old if self._mine(old) == base and self._is_free(new) else None

    def moved_by_hand(self, new: str) -> str | None:
        """Return the base of a file that the user moved to its new path; None otherwise."""
        old, there = self._places.get(new), self._recorded.get(new)
        if old is None or (there and there.origin != old) or self._mine(old) is not None:
            return None
        return None if self._mine(new) is None or self.replaced_hash(new) else self.base(new, old)

    def replaced_hash(self, path: str) -> str | None:
        """Return the hash of the file at a path, if it is as urdfsync wrote it there; None otherwise."""
        mine, record = self._mine(path), self._recorded.get(path)
        return mine if record and mine == record.written_hash else None

    def _edited(self) -> dict[str, str]:
        edited = {}
        for new, old in self._places.items():
            base, mine = self.base(new, old), self._mine(old)
            if base is not None and mine is not None and mine != base:
                edited[new] = old
        # A file that can't move blocks the one that would take its place, and so on.
        while True:
            moving = set(edited.values())
            blocked = [path for path in edited if path not in moving and not self._is_free(path)]
            if not blocked:
                return edited
            for path in blocked:
                del edited[path]

    def _is_free(self, path: str) -> bool:
        """Return whether nothing but urdfsync's own file is at a path."""
        return self._on_disk.get(path, NO_FILE) == NO_FILE or self.replaced_hash(path) is not None

    def _mine(self, path: str) -> str | None:
        return self._on_disk.get(path, NO_FILE).hash

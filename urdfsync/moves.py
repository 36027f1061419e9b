"""Files whose element has another name now: what is known of their old places and of their new ones."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from urdfsync.plan import FileRecord, Found


def places(recorded: Mapping[str, FileRecord], targets: Mapping[str, str], wanted: Collection[str]) -> dict[str, str]:
    """New and old path of files that belong elsewhere now.

    `targets` says of recorded paths where the element of the file belongs now. A file that has been waiting to go
    somewhere still is at its origin; what is recorded of that place itself is another element's, or its own past.
    """
    waiting = {record.origin for record in recorded.values() if record.origin}
    found = {}
    for path, record in recorded.items():
        if path in targets and (record.origin or path not in waiting):
            origin, target = record.origin or path, targets[path]
            if target in wanted and target != origin:
                found[target] = origin
    return found


class Moves:
    """The moves of one plan, `places` being new and old path of each; see `plan.plan` for the other two."""

    def __init__(
        self, recorded: Mapping[str, FileRecord], found: Mapping[str, Found], places: Mapping[str, str]
    ) -> None:
        self._recorded, self._found, self._places = recorded, found, places
        self._waiting = {record.origin: record for record in recorded.values() if record.origin}
        self.edited = self._edited()
        """New and old path of files that the user edited, and that can go."""
        self.left = frozenset(self.edited.values())
        """The old paths of these."""

    def base(self, new: str, old: str) -> str | None:
        """The base of a file that goes from its old path to a new one, also if it was to go elsewhere before."""
        there = self._recorded.get(new)
        waiting = there if there and there.origin == old else self._waiting.get(old)
        if waiting is not None:
            return waiting.base
        return self._recorded[old].own if old in self._recorded else None

    def followed(self, new: str) -> str | None:
        """The old path of a file that urdfsync may just write anew at the new one; None if there is no such.

        It is as urdfsync wrote it, and nothing of the user's is at the new path.
        """
        old = self._places.get(new)
        if old is None or (base := self.base(new, old)) is None:
            return None
        return old if self._mine(old) == base and self._is_free(new) else None

    def moved_by_hand(self, new: str) -> str | None:
        """The base of a file that the user has moved to its new path already; None if there is no such."""
        old, there = self._places.get(new), self._recorded.get(new)
        if old is None or (there and there.origin != old) or self._mine(old) is not None:
            return None
        return None if self._mine(new) is None or self.stands(new) else self.base(new, old)

    def stands(self, path: str) -> str | None:
        """Hash of what is in a place, if urdfsync wrote it there itself; else None."""
        mine, record = self._mine(path), self._recorded.get(path)
        return mine if record and mine == record.own else None

    def _edited(self) -> dict[str, str]:
        edited = {}
        for new, old in self._places.items():
            base, mine = self.base(new, old), self._mine(old)
            if base is not None and mine is not None and mine != base:
                edited[new] = old
        while True:
            left = set(edited.values())
            occupied = [path for path in edited if path not in left and not self._is_free(path)]
            if not occupied:
                return edited
            for path in occupied:
                del edited[path]

    def _is_free(self, path: str) -> bool:
        """Whether nothing is in a place but what urdfsync wrote there itself."""
        there = self._found.get(path)
        return there is None or (there.hash is None and not there.as_folder) or self.stands(path) is not None

    def _mine(self, path: str) -> str | None:
        there = self._found.get(path)
        return there.hash if there else None

"""The texts of one robot's package: what would be written now, and what was written last.

Only stale texts are rendered. Where a file is made of the same template and the same data as in the last build, its
text is the one that was written then, and its hash is recorded.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence, Set

from urdfsync.files import normalised, text_digest
from urdfsync.plan import FileRecord, State
from urdfsync.planning.generate import Generated
from urdfsync.state.bases import BaseStore

_AS_GENERATED = (State.GENERATED, State.EDITED)
"""States of files whose base is what the last build generated."""


class Outputs:
    """What is known of the texts; all paths are POSIX, below the package's folder."""

    def __init__(
        self,
        now: Generated,
        last: Generated | None,
        differing: Set[str],
        record: Callable[[str], FileRecord | None],
        bases: BaseStore,
        aside: Mapping[str, str],
        mine: Callable[[str], bytes | None],
        older: Sequence[Generated] = (),
        again: bool = False,
    ) -> None:
        """`last` is the package of the last build, None if it can't be rendered again; `record` gives its records.

        `differing` are the paths of files that are made of something else than in `last`. `aside` are texts that were
        recorded because nothing else gives them back; `mine` reads a file of the last build. `older` are packages that
        may give back what was written last, too. With `again`, everything counts as stale.
        """
        self._now, self._last, self._older = now, last, older
        self.stale = now.artifacts.keys() if last is None or again else differing
        """The paths of texts that may be other than in the last build."""
        self._record = record
        self.bases, self._aside, self._mine = bases, aside, mine
        self._digests: dict[str, str] = {}
        self._texts: dict[tuple[str, str], str | None] = {}

    def digest(self, path: str) -> str:
        """Hash of what would be written."""
        if path not in self._digests:
            self._digests[path] = self._recorded(path) or text_digest(self._now.content(path))
        return self._digests[path]

    def content(self, path: str) -> bytes:
        """What would be written."""
        known = self._known(path, self._recorded(path))
        return self._now.content(path) if known is None else known.encode()

    def generates(self, path: str, digest: str) -> bool:
        """Whether the text of this hash is what would be written to a path."""
        return path in self._now.artifacts and self.digest(path) == digest

    def base(self, path: str, digest: str) -> str | None:
        """The text that was written last at a path of the last build, by its hash; None if it is lost."""
        known = self._known(path, digest)
        if known is not None:
            return known
        candidates = [text.encode() for text in self._aside.values()]
        packages = [
            package for package in (self._last, self._now, *self._older) if package and path in package.artifacts
        ]
        candidates += [package.content(path) for package in packages]
        return next((text.decode() for text in candidates if text_digest(text) == digest), None)

    def _recorded(self, path: str) -> str | None:
        """The recorded hash of a text that is not stale and need not be rendered."""
        record = None if path in self.stale else self._record(path)
        if record is None or record.state not in _AS_GENERATED:
            return None
        kept = record.base in self.bases or self._known(path, record.base) is not None
        return record.base if kept else None

    def _known(self, path: str, digest: str | None) -> str | None:
        """The text of this hash, as far as it can be had without rendering."""
        if digest is None:
            return None
        if (path, digest) not in self._texts:
            self._texts[path, digest] = self._look_for(path, digest)
        return self._texts[path, digest]

    def _look_for(self, path: str, digest: str) -> str | None:
        kept = self.bases.get(digest)
        if kept is not None:
            return kept
        mine = self._mine(path)
        if mine is None or text_digest(mine) != digest:
            return None
        return normalised(mine).decode(errors="surrogateescape")

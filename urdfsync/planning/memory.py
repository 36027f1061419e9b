"""What a process remembers of the robot that it built last, for one that builds again and again.

Each entry stands with all that it was made of, and serves only who asks for exactly that: a memory spares work, and
never says what is on disk. Of each kind there is one entry, so a memory is as large as one robot. Only what plans saw
of files is there for every robot: hashes, each with what the system said of the file, where that can be believed.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import msgspec

from urdfsync.domain import Artifact, Domain, Import, Order, Parts, Reading, Snapshot, Target
from urdfsync.looking import NO_FACTS
from urdfsync.planning import generate
from urdfsync.stamping import stamp

if TYPE_CHECKING:
    from urdfsync.planning.disk import Hashes
    from urdfsync.stamping.trust import Clock

_FEW = 4
"""So many files are sooner read again than the clock is."""
_Value = TypeVar("_Value")


class Memory:
    """The source that was read last, and the files that were made last of a model.

    And of each robot, what was seen of its files.
    """

    def __init__(self) -> None:
        self._seen: dict[str, Hashes] = {}
        self._current: set[str] = set()
        self._reading: _Last[Reading] = _Last()
        self._parts: _Last[Parts] = _Last()
        self._artifacts: _Files | None = None
        self._shipped: dict[Hashable, Mapping[str, str]] = {}

    def read(self, domain: Domain, options: Any, content: bytes, name: str) -> Reading:
        """What the domain reads in a source: who judges one, and then builds it, reads it once.

        What the next version of the source has in common with it need not be read again.
        """
        parts = self._parts.get((domain, options, name), dict)
        return self._reading.get((domain, options, content, name), lambda: domain.read(content, name, options, parts))

    def artifacts(
        self, domain: Domain, snapshot: Snapshot, imports: Mapping[str, Import], target: Target, options: Any
    ) -> Sequence[Artifact | Order]:
        """The files of a package, see `generate.artifacts`: those of the last build are those that it has made."""
        last = self._artifacts
        if last is not None and last.domain is domain and last.are_of(snapshot, imports, target, options):
            return last.files
        parts = last.parts if last is not None and last.domain is domain else {}
        files = generate.artifacts(domain, snapshot, imports, target, options, parts)
        self._artifacts = _Files(domain, snapshot, _encoded((imports, target, options)), files, parts)
        return files

    def shipped(self, folder: Hashable, read: Callable[[], Mapping[str, str]]) -> Mapping[str, str]:
        """What is in a folder of templates that is part of the program, as its modules are: it is read once."""
        if folder not in self._shipped:
            self._shipped[folder] = read()
        return self._shipped[folder]

    def seen(self, robot: str) -> Hashes:
        """What was seen last of a robot's outputs and recorded state; without facts where these can't be believed."""
        return self._seen.get(robot, {})

    def is_current(self, robot: str) -> bool:
        """Whether that is what the last plan saw, and no build has written since."""
        return robot in self._current

    def note_look(
        self, robot: str, seen: Hashes, begin: tuple[int, int], read_clock: Callable[[], Clock | None]
    ) -> None:
        """Remember what a look at all that matters to a robot's plan has found.

        `begin` is when it began (`stamp.now`): files that had changed shortly before keep their hashes but no facts, so
        they are read next time.
        """
        before = self.seen(robot)
        new = {path: entry for path, entry in seen.items() if entry and before.get(path) is not entry}
        doubtful = {path: (NO_FACTS, *entry[1:]) for path, entry in new.items() if entry[0] != NO_FACTS}
        if len(doubtful) > _FEW and (clock := read_clock()):
            passed = stamp.passed(begin)
            doubtful = {path: entry for path, entry in doubtful.items() if not clock.trusts(new[path][0], passed)}
        self._seen[robot] = {**seen, **doubtful}
        self._current.add(robot)

    def invalidate(self, robot: str) -> None:
        """What was seen is not what counts any more: a build has written, or a plan looks again."""
        self._current.discard(robot)

    def forget_others(self, robots: Collection[str]) -> None:
        """Forget what was seen of all others."""
        self._seen = {robot: seen for robot, seen in self._seen.items() if robot in robots}
        self._current.intersection_update(robots)

    def distrust(self) -> None:
        """Read all files again, whatever the system says of them."""
        self._shipped.clear()
        for robot, seen in self._seen.items():
            self._seen[robot] = {path: entry and (NO_FACTS, *entry[1:]) for path, entry in seen.items()}


class _Files(msgspec.Struct):
    """The files of a package, with all that they were made of, and what their domain has kept of them."""

    domain: Domain
    snapshot: Snapshot
    others: bytes
    files: Sequence[Artifact | Order]
    parts: Parts

    def are_of(self, snapshot: Snapshot, imports: Mapping[str, Import], target: Target, options: Any) -> bool:
        """Whether that is what they were made of."""
        return self.others == _encoded((imports, target, options)) and _same(self.snapshot, snapshot, 2)


def _same(one: Any, other: Any, depth: int) -> bool:
    """Whether two values of plain data give the same texts: 1 and 1.0 don't, nor do 0.0 and -0.0.

    Mappings are looked into to this depth, for parts that are one and the same.
    """
    if one is other:
        return True
    if depth and isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(_same(value, other[key], depth - 1) for key, value in one.items())
    return _encoded(one) == _encoded(other)


def _encoded(value: Any) -> bytes:
    """The value as JSON, which tells numbers apart as texts do."""
    return msgspec.json.encode(value, order="sorted")


class _Last(Generic[_Value]):
    """The last value of a kind, with its key."""

    def __init__(self) -> None:
        self._entry: tuple[object, _Value] | None = None

    def get(self, key: object, make: Callable[[], _Value]) -> _Value:
        """The value of this key, made unless it is the last one; where that raises, the last one stays."""
        if self._entry is None or self._entry[0] != key:
            self._entry = key, make()
        return self._entry[1]

"""The record of a robot's dependencies: what its last complete build has read, and that result.

`.urdfsync/deps/NAME.robot` is this machine's, and safe to lose. While each fact in its list is as it was, the result
holds: the robot is neither read, nor generated, nor decided again. A file that was young when it was read is compared
by its content, as in git's racy index entries. Once all files are old, the record is written again without contents.
"""

from __future__ import annotations

import os
import time

from urdfsync.dependencies import localfile, places, program
from urdfsync.dependencies.facts import MAX_FILE, PATH, VARIABLE, hash_file, is_young, look

TYPE_CHECKING = False  # importing it from `typing` takes 2 of the 12 ms of a no-op build
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from urdfsync.dependencies.facts import Entry, Facts
    from urdfsync.dependencies.reads import Reads

_FORMAT = "1"
_OLD = "-"
"""Stands for the hash of a file that was old when it was read."""


class FactList:
    """Facts about all that a piece of work has read. Pure data: pickled by workers, written by records."""

    def __init__(self, entries: Sequence[Entry] = (), facts: Sequence[int] = (), hashes: Sequence[str] = ()) -> None:
        self.entries = entries
        """Kind and path of each fact."""
        self._facts, self._hashes = facts, hashes
        """For each entry the hash of its facts, and the content's hash: `_OLD` for an old file, empty if unknown."""

    @classmethod
    def of(cls, reads: Reads) -> FactList:
        """Return the facts of all reads so far."""
        here, entries = os.getcwd(), reads.entries
        places = [(kind, path if kind == VARIABLE else os.path.join(here, path)) for kind, path in entries]
        return cls(places, list(map(hash, entries.values())), [reads.hashes.get(entry, _OLD) for entry in entries])

    def look(self, seen: dict[Entry, Facts] | None = None) -> Iterator[Facts]:
        """Yield the present facts; `seen` has listings that were looked at just now, and gets the others.

        Robots of one package read the same folders: a fleet of 1,000 would list 1,000 names 1,000 times.
        """
        seen = {} if seen is None else seen
        for entry in self.entries:
            kind, path = entry
            if kind == PATH:
                yield look(kind, path)
            else:
                if entry not in seen:
                    seen[entry] = look(kind, path)
                yield seen[entry]

    def changes(self, present: Iterable[Facts]) -> Iterator[Entry]:
        """Yield the entries whose facts differ from the present ones, or whose files were young and have others."""
        for entry, known, sha256, facts in zip(self.entries, self._facts, self._hashes, present, strict=True):
            # Python gives tuples of integers the same hash in each process
            if hash(facts) != known or (sha256 != _OLD and not _has_content(entry[1], sha256)):
                yield entry

    def aged(self) -> FactList:
        """Return the list without contents once all its files are old; else the same list."""
        now = time.time_ns()
        young = [entry for entry, sha256 in zip(self.entries, self._hashes, strict=True) if sha256 != _OLD]
        if not young or any(is_young(look(*entry), now) for entry in young):
            return self
        return FactList(self.entries, self._facts, [_OLD] * len(self.entries))

    def renewed(self) -> FactList:
        """Return the list with the present facts."""
        return FactList(self.entries, list(map(hash, self.look())), [_OLD] * len(self.entries))

    def extended(self, other: FactList) -> FactList:
        """Return a list with the entries of both."""
        pairs = ((self.entries, other.entries), (self._facts, other._facts), (self._hashes, other._hashes))
        return FactList(*([*own, *others] for own, others in pairs))

    def can_be_saved(self) -> bool:
        """Whether the contents of all young files are known, and a text can hold all paths."""
        return all(self._hashes) and not any(not path or "\0" in path for _, path in self.entries)

    def dumps(self) -> str:
        """Return the list as a text: kinds, paths, facts and hashes, one after the other."""
        columns = (*zip(*self.entries, strict=True), map(str, self._facts), self._hashes) if self.entries else ()
        return "\0".join(text for column in columns for text in column)

    @classmethod
    def loads(cls, text: str) -> FactList:
        """Read the text of `dumps`. Raises ValueError."""
        if not text:
            return cls()
        words = text.split("\0")
        size, rest = divmod(len(words), 4)
        if rest:
            raise ValueError
        kinds, paths, facts, hashes = (words[start : start + size] for start in range(0, 4 * size, size))
        return cls(list(zip(kinds, paths, strict=True)), list(map(int, facts)), hashes)


def _has_content(path: str, sha256: str) -> bool:
    """Return whether a file still has the content with this hash; True if the hash is unknown."""
    try:
        return not sha256 or hash_file(path) == sha256
    except OSError:
        return False


class DependencyRecord:
    """A list of facts, and what held when it was made."""

    def __init__(self, key: str, facts: FactList, words: Sequence[str], result: bytes = b"") -> None:
        self.key = key
        """A text of all inputs other than files; never empty."""
        self.facts = facts
        self.words = words
        """What a command may show without reading the result; no word is empty."""
        self.result = result

    def save(self, folder: str, name: str) -> None:
        """Save the record in the state folder; if that fails, or a file may still change, nothing is remembered."""
        if not self.facts.can_be_saved() or any(not word or "\0" in word for word in (self.key, *self.words)):
            return
        folder = places.place(folder)  # the hook's clone has records of its own
        place = os.path.join(folder, program.FOLDER)
        about = "\0".join((_FORMAT, program.identity(folder), program.user()))
        texts = [about, self.key, self.facts.dumps(), "\0".join(self.words)]
        content = b"\0\0".join([*(text.encode("utf-8", "surrogateescape") for text in texts), self.result])
        if len(content) < MAX_FILE and os.path.isdir(folder) and _shows_changes(place):
            localfile.replace(os.path.join(place, name), content)


def load(folder: str, name: str) -> DependencyRecord | None:
    """Return the record of this name in the state folder; None if this machine, program and user wrote none.

    A record may be damaged: then its robot is built as if it had none.
    """
    folder = places.place(folder)
    place = os.path.join(folder, program.FOLDER)
    try:
        about, key, facts, words, result = (localfile.read(os.path.join(place, name)) or b"").split(b"\0\0", 4)
        if about.decode() != "\0".join((_FORMAT, program.identity(folder), program.user())):
            return None
        listed = FactList.loads(facts.decode("utf-8", "surrogateescape"))
        return DependencyRecord(_text(key), listed, _text(words).split("\0") if words else [], result)
    except (ValueError, OSError):
        return None


def _text(content: bytes) -> str:
    return content.decode("utf-8", "surrogateescape")


def recall(folder: str, name: str, key: str, seen: dict[Entry, Facts]) -> DependencyRecord | None:
    """Return the record of this name if it has this key, and nothing has changed since; `seen`: see `FactList.look`."""
    found = load(folder, name)
    # the source, which changes most, is among the first entries: further ones are not looked at
    if found is None or found.key != key or any(found.facts.changes(found.facts.look(seen))):
        return None
    if (aged := found.facts.aged()) is not found.facts:
        found.facts = aged
        found.save(folder, name)
    return found


_folders_with_times: dict[str, bool] = {}


def _shows_changes(folder: str) -> bool:
    """Return whether the file system tells the time of each change: else stat values prove nothing.

    On Windows, FAT and sshfs, a user can set all of a file's times.
    """
    if folder not in _folders_with_times:
        _folders_with_times[folder] = os.name != "nt" and _probe(folder)
    return _folders_with_times[folder]


def _probe(folder: str) -> bool:
    if os.path.islink(folder):
        return False
    probe = os.path.join(folder, f".probe-{os.getpid()}.urdfsync-tmp")
    try:
        os.makedirs(folder, exist_ok=True)
        descriptor = os.open(probe, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
        try:
            status = os.fstat(descriptor)
            os.utime(descriptor, ns=(0, 0))
            return os.fstat(descriptor).st_ctime_ns >= status.st_ctime_ns > 0
        finally:
            os.close(descriptor)
            os.unlink(probe)
    except OSError:
        return False


_VARIABLES = ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "MODELICAPATH", "PYTHONPATH")
"""Environment variables that change the files that a command finds."""


def surroundings() -> str:
    """Return the inputs of every command that are no files; messages name files relative to the working folder."""
    return repr((os.getcwd(), *map(os.environ.get, _VARIABLES)))


def findings_told(folder: str, robot: str) -> set[str]:
    """Return the keys of the findings that the last build of a robot has told on this machine."""
    content = localfile.read(os.path.join(folder, program.FOLDER, f"{robot}.told"))
    return set(content.decode(errors="replace").split()) if content else set()


def note_findings(folder: str, robot: str, keys: Iterable[str]) -> None:
    """Note the keys of the findings that a build has told."""
    if os.path.isdir(folder):
        localfile.replace(os.path.join(folder, program.FOLDER, f"{robot}.told"), " ".join(sorted(keys)).encode())

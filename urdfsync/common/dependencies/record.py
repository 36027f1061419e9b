"""The records of dependencies: each has all that a piece of work has read, and its result.

`.urdfsync/deps/NAME.robot` has the result of a robot's last complete build, `urdfsync.toml.config` the robots of the
configuration. They are this machine's, and safe to lose. While each fact is as it was, the result holds: the robot is
neither read, nor generated, nor decided again. Once all files are old, a record is written again without contents.
"""

from __future__ import annotations

import os
import time

from urdfsync.common.dependencies import localfile, places, program
from urdfsync.common.dependencies.facts import MAX_FILE, aged, changes

TYPE_CHECKING = False  # importing it from `typing` takes 2 of the 12 ms of a no-op build
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from urdfsync.common.dependencies.facts import Dependencies, Entry, Facts

ROBOT, CONFIGURATION = ".robot", ".config"
"""The endings of the names of records."""
_FORMAT = "2"
_FOLDER = "deps"
_TOLD = ".told"
_VARIABLES = ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "MODELICAPATH", "PYTHONPATH")
"""Environment variables that change the files that a command finds."""


class Record:
    """A result, and all that it rests on."""

    def __init__(self, dependencies: Dependencies, words: Sequence[str], result: bytes = b"") -> None:
        self.dependencies = dependencies
        self.words = words
        """Texts that a command may show without reading the result; none is empty."""
        self.result = result


class Records:
    """The records in a state folder, for one command: it looks at each folder once."""

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self._parent = places.place(folder)  # the hook's clone has records of its own
        self._seen: dict[Entry, Facts] = {}
        # messages name files relative to the working folder
        others = os.getcwd(), *map(os.environ.get, _VARIABLES)
        self._about = repr((_FORMAT, program.identity(), program.user(), others))

    def recall(self, name: str, key: str = "") -> Record | None:
        """Return the record of this name if nothing has changed since; None without one.

        `key` is a text of all inputs that are neither files nor equal for all commands in this folder. A record of
        another key, machine, user, program or environment does not count, nor does a damaged one.
        """
        try:
            head, listed, words, result = (localfile.read(self._place(name)) or b"").split(b"\0\0", 3)
            if _text(head) != self._about + key:
                return None
            texts = _text(listed).split("\0") if listed else []
            size = len(texts) // 3
            entries = zip(texts[:size], texts[size : 2 * size], strict=True)
            known = dict(zip(entries, map(int, texts[2 * size :]), strict=True))
        except ValueError:
            return None
        # the source, which changes most, is among the first entries: further ones are not looked at
        if any(changes(known, self._seen)):
            return None
        found = Record(aged(known, time.time_ns()), _text(words).split("\0") if words else [], result)
        if found.dependencies is not known:
            self.save(name, key, found)
        return found

    def save(self, name: str, key: str, record: Record) -> None:
        """Save a record; if that fails, or stat values of files prove nothing here, nothing is remembered."""
        entries = record.dependencies
        listed = [*(kind for kind, _ in entries), *(path for _, path in entries), *map(str, entries.values())]
        if not all(text and "\0" not in text for text in (*listed, *record.words)):
            return
        texts = self._about + key, "\0".join(listed), "\0".join(record.words)
        content = b"\0\0".join([*(text.encode("utf-8", "surrogateescape") for text in texts), record.result])
        if len(content) < MAX_FILE and os.path.isdir(self._parent):
            localfile.replace(self._place(name), content, needs_times=True)

    def told(self, robot: str) -> set[str]:
        """Return the keys of the findings that the last build of a robot has told on this machine."""
        return set((localfile.read(self._place(f"{robot}{_TOLD}")) or b"").decode(errors="replace").split())

    def tell(self, robot: str, keys: Iterable[str]) -> None:
        """Note the keys of the findings that a build has told."""
        if os.path.isdir(self._parent):
            localfile.replace(self._place(f"{robot}{_TOLD}"), " ".join(sorted(keys)).encode())

    def _place(self, name: str) -> str:
        return os.path.join(self._parent, _FOLDER, name)


def _text(content: bytes) -> str:
    return content.decode("utf-8", "surrogateescape")

"""The memory of finished work: each result, with all that it rests on.

`.urdfsync/deps/NAME.robot` has the result of a robot's last complete build, `urdfsync.toml.config` the robots of the
configuration. They are this machine's, and safe to lose. While each fact is as it was, the result holds: the robot is
neither read, nor generated, nor decided again. Once all files are old, it is written again without contents.
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
"""The endings of the names of files."""
_FORMAT = "2"
_FOLDER = "deps"
_TOLD = ".told"
_VARIABLES = ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "MODELICAPATH", "PYTHONPATH")
"""Environment variables that change the files that a command finds."""


class Remembered:
    """A result, and all that it rests on."""

    def __init__(self, dependencies: Dependencies, words: Sequence[str], result: bytes = b"") -> None:
        self.dependencies = dependencies
        self.words = words
        """Texts that a command may show without reading the result; none is empty."""
        self.result = result


class Memory:
    """What is remembered in a state folder, for one command: it looks at each folder once."""

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self._parent = places.place(folder)  # the hook's clone has a memory of its own
        self._seen: dict[Entry, Facts] = {}
        # messages name files relative to the working folder
        others = os.getcwd(), *map(os.environ.get, _VARIABLES)
        self._about = repr((_FORMAT, program.identity(), program.user(), others))

    def recall(self, name: str, key: str = "") -> Remembered | None:
        """Return what is remembered under this name if nothing has changed since; None without it.

        `key` is a text of all inputs that are neither files nor equal for all commands in this folder. The result of
        another key, machine, user, program or environment does not count, nor does a damaged file.
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
        found = Remembered(aged(known, time.time_ns()), _text(words).split("\0") if words else [], result)
        if found.dependencies is not known:
            self.save(name, key, found)
        return found

    def save(self, name: str, key: str, result: Remembered) -> None:
        """Save a result; if that fails, or stat values of files prove nothing here, nothing is remembered."""
        entries = result.dependencies
        listed = [*(kind for kind, _ in entries), *(path for _, path in entries), *map(str, entries.values())]
        if not all(text and "\0" not in text for text in (*listed, *result.words)):
            return
        texts = self._about + key, "\0".join(listed), "\0".join(result.words)
        content = b"\0\0".join([*(text.encode("utf-8", "surrogateescape") for text in texts), result.result])
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

"""Decides by the records of dependencies whether a commit passes: then `urdfsync hook` imports few other modules."""

from __future__ import annotations

import os

from urdfsync import git, noop
from urdfsync.dependencies import localfile
from urdfsync.dependencies.places import Clone

TYPE_CHECKING = False  # importing it from `typing` takes 2 ms
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

_CHECKSUM = 20
"""The number of bytes at the end of an index that identify it, as a part of its checksum."""


class ExportedIndex:
    """What the hook's clone was exported from (see `git.clone`)."""

    def __init__(self, index: str, conversions: str, configurations: Sequence[str], lost: Sequence[str]) -> None:
        """`index` identifies the index; it is empty if a submodule was not at hand.

        `conversions` is a hash of the submodules, and of the settings and attributes by which git converts files.
        `lost` are the untracked configurations of tracked states. All paths are from the top.
        """
        self.index, self.conversions = index, conversions
        self.configurations, self.lost = configurations, lost

    @classmethod
    def read(cls, file: str) -> ExportedIndex | None:
        """Return the last export; None if there is none, or if an export is under way or was killed."""
        try:
            index, conversions, *lists = os.fsdecode(localfile.read(file) or b"").split("\0\0")
            configurations, lost = ([path for path in text.split("\0") if path] for text in lists)
        except ValueError:
            return None
        return cls(index, conversions, configurations, lost)

    def write(self, file: str) -> None:
        """Write the file of the last export."""
        texts = self.index, self.conversions, "\0".join(self.configurations), "\0".join(self.lost)
        localfile.replace(file, os.fsencode("\0\0".join(texts)))


def is_answered(arguments: list[str]) -> bool:
    """Return whether a command is a hook, and the clone's records let the commit pass."""
    if arguments not in (["hook", "build"], ["hook", "check"]):
        return False
    repository = git.Repository()
    export = ExportedIndex.read(record_place(repository))
    is_merge = os.path.exists(f"{repository.folder}/MERGE_HEAD")  # other parents, perhaps without another index
    if export is None or is_merge or export.index != identify(read_index(repository)):
        return False
    with Clone(repository.top, f"{repository.folder}/urdfsync/clone"):
        files = (f"{repository.top}/{path}" for path in export.configurations)
        if find_lost(repository, export) or not all(map(noop.is_in_step, files)):
            return False
    after = ExportedIndex.read(record_place(repository))
    return after is not None and after.index == export.index  # otherwise another hook changed the clone meanwhile


def record_place(repository: git.Repository) -> str:
    """Return the file of the last export."""
    return f"{repository.folder}/urdfsync/exported"


def read_index(repository: git.Repository) -> bytes:
    """Return the content of the index; empty if nothing was ever added."""
    try:
        with open(repository.index, "rb") as file:
            return file.read()
    except FileNotFoundError:
        return b""


def identify(index: bytes) -> str:
    """Return a text that identifies the content of an index."""
    checksum = index[-_CHECKSUM:]
    if not any(checksum):  # a setting of git's lets it write no checksum
        from hashlib import sha256  # takes 3 ms

        checksum = sha256(index).digest()
    return f"{len(index)} {checksum.hex()}"


def find_configurations(files: Iterable[str]) -> tuple[list[str], list[str]]:
    """Return the configurations among the files of a commit, and those that are missing beside recorded states."""
    name, states = noop.FILE_NAME, "/.urdfsync/robots/"
    files = [f"/{path}" for path in files]
    found = {path[1:] for path in files if path.rpartition("/")[2] == name}
    of_states = {f"{path.rpartition(states)[0]}/{name}"[1:] for path in files if states in path}
    return sorted(found), sorted(of_states - found)


def find_lost(repository: git.Repository, export: ExportedIndex) -> list[str]:
    """Return the configurations on disk that the commit lacks, although it has their states."""
    return [path for path in export.lost if os.path.isfile(f"{repository.top}/{path}")]

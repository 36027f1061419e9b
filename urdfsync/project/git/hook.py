"""Decides by the records of dependencies whether a commit passes: then `urdfsync hook` imports few other modules."""

from __future__ import annotations

from urdfsync.common import noop
from urdfsync.common.dependencies.facts import NOTHING, PATH
from urdfsync.common.dependencies.memory import Memory, Remembered
from urdfsync.common.dependencies.places import Clone
from urdfsync.project import git

TYPE_CHECKING = False  # importing it from `typing` takes 2 ms
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

_CHECKSUM = 20
"""The number of bytes at the end of an index that identify it, as a part of its checksum."""
_EXPORT = "export"
"""The name of the record of the clone: its key identifies the index, its words are the configurations."""


def is_answered(arguments: list[str]) -> bool:
    """Return whether a command is a hook, and the clone's records let the commit pass."""
    if arguments not in (["hook", "build"], ["hook", "check"]):
        return False
    repository = git.Repository()
    place, key = f"{repository.folder}/urdfsync", _identify(read_index(repository))
    if (export := Memory(place).recall(_EXPORT, key)) is None:
        return False
    with Clone(repository.top, f"{place}/clone"):
        is_in_step = all(noop.is_in_step(f"{repository.top}/{path}") for path in export.words)
    return is_in_step and Memory(place).recall(_EXPORT, key) is not None  # else another hook changed the clone


def remember(repository: git.Repository, index: bytes, configurations: Sequence[str], lost: Iterable[str]) -> None:
    """Remember that the clone has the files of this index, until there is one of the `lost` files."""
    dependencies = {(PATH, f"{repository.top}/{path}"): hash(NOTHING) for path in lost}
    Memory(f"{repository.folder}/urdfsync").save(_EXPORT, _identify(index), Remembered(dependencies, configurations))


def read_index(repository: git.Repository) -> bytes:
    """Return the content of the index; empty if nothing was ever added."""
    try:
        with open(repository.index, "rb") as file:
            return file.read()
    except FileNotFoundError:
        return b""


def _identify(index: bytes) -> str:
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

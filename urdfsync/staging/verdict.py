"""What is wrong with one robot in what is being committed: the value that judging ends with."""

from __future__ import annotations

from pathlib import Path

import msgspec

from urdfsync.outcome import Result


class Verdict(msgspec.Struct, frozen=True):
    """How one robot stands in what is being committed, if something is wrong with it."""

    config: Path
    robot: str
    add: tuple[str, ...] = ()
    """The files of the working tree that have to be staged; paths of the repository."""
    result: Result | None = None
    """What a build did, or would do if it is a dry one; None if the working tree needs none."""
    hindered: tuple[str, ...] = ()
    """What kept a build from writing: files of which the working tree has another version than the index."""
    folders: tuple[str, ...] = ()
    """The folders of outputs: those of the package and of the recorded state."""

    @property
    def waits(self) -> bool:
        """Whether it takes a build to put things right."""
        return self.result is not None and self.result.dry

    @property
    def troubled(self) -> bool:
        """Whether a build is not enough."""
        return self.result is not None and (self.result.failed or bool(self.result.conflicts))

"""A robot that the daemon watches: its files, as they are and as the last build left them, and whether they settled."""

from __future__ import annotations

import errno
import math
import os
import stat
import time
from collections.abc import Collection

import msgspec

from urdfsync.config import RobotConfig
from urdfsync.dependencies import NO_STAT, read_unrecorded, stat_of
from urdfsync.diagnostics import Diagnostic
from urdfsync.engine.package_files import FileState, state_of
from urdfsync.watch.paths import RobotPaths

_COARSE_TICK = 2_000_000_000
"""No clock of a file system is coarser (ns): that of FAT."""


def read_state(path: str, known: FileState | None = None, *, follow: bool = True) -> FileState:
    """Return the state of a path; an error is a state, too: its hashes are a word. So is a link that is not followed.

    The file is hashed unless `known` has its stat values. A racy state has none, so it is hashed again next time.
    """
    try:
        status = os.stat(path, follow_symlinks=follow)  # noqa: PTH116 - many, and often
        facts = stat_of(status)
        if known is not None and known.stat == facts:
            return known
        if not stat.S_ISREG(status.st_mode):
            word = "folder" if stat.S_ISDIR(status.st_mode) else "other"
            return FileState(NO_STAT, word, word)
        content = read_unrecorded(path)
    except OSError as error:
        word = "missing" if error.errno in (errno.ENOENT, errno.ENOTDIR) else f"error {error.errno}"
        return FileState(NO_STAT, word, word)
    is_racy = max(facts[-2:]) > time.time_ns() - _COARSE_TICK
    return state_of(NO_STAT if is_racy else facts, content)


class Times(msgspec.Struct, frozen=True):
    """How long the daemon waits; all in seconds."""

    settle: float = 0.3
    """Without an event."""
    sample: float = 0.2
    """Between the two samples that have to be equal; with 0 there is one sample."""
    give_up_after: float = 30.0
    """Until an invalid source is an error."""
    recheck_shrunk: float = 2.0
    """Until a source that has lost many elements is believed."""


class Debouncer:
    """Files have settled after a while without an event, once two samples some time apart are equal."""

    def __init__(self, times: Times) -> None:
        self._times = times
        self._sample: object = None
        self.due = math.inf
        """When the next sample is to be taken, in seconds of a monotonic clock; infinite if there is nothing to do."""

    @property
    def is_idle(self) -> bool:
        """Whether nothing happened since the last build."""
        return self.due == math.inf

    def touch(self, now: float) -> None:
        """Begin again: something may have changed."""
        self._sample, self.due = None, now + self._times.settle

    def add_sample(self, sample: object, now: float) -> bool:
        """Take a sample. Returns whether the files have settled; the next sample is due in any case, until `rest`."""
        is_settled = sample == self._sample or not self._times.sample
        self._sample, self.due = sample, now + self._times.sample
        return is_settled

    def rest(self) -> None:
        """Do nothing until the next event."""
        self._sample, self.due = None, math.inf


class WatchedRobot(msgspec.Struct):
    """One robot, as long as the configuration has one of its name."""

    robot: RobotConfig
    paths: RobotPaths
    debouncer: Debouncer
    files: dict[str, FileState] = msgspec.field(default_factory=dict)
    """Inputs and outputs by absolute path, when they were last read."""
    built: dict[str, str] | None = None
    """Hashes of all files before and after the last build, which changed none; None if the robot has to be built."""
    is_announced: bool = False
    """Whether the user was told that something is going on."""
    source_errors: tuple[Diagnostic, ...] = ()
    """What the user was told of an invalid source that is waited for."""
    invalid_since: float | None = None
    """When the source was found to be invalid."""
    rechecked: str = ""
    """Hash of the last source that had lost many elements, and was looked at longer."""
    failure: tuple[Diagnostic, ...] | None = None
    """Why the last build failed; None if it did not."""
    left_alone: frozenset[tuple[str, str]] = frozenset()
    """Files that the last build did not write although they differ, each with the kind of its action."""

    @property
    def name(self) -> str:
        """As in the configuration."""
        return self.robot.name

    @property
    def source(self) -> FileState:
        """The source when it was last read."""
        return self.files[str(self.robot.source)]

    def read_files(self, *, inputs_only: bool = False) -> dict[str, str]:
        """Read all inputs, those in the template folder included, and all outputs. Returns their hashes by path.

        With `inputs_only` the outputs are as they were last read: the time of "one mass changed in the daemon" in
        docs/speed.md is 4 % less. Whoever changes an output causes an event, or is found by the next full look.
        """
        known, templates, inputs = self.files, self.robot.templates, set(self.paths.inputs)
        for folder, _, names in os.walk(templates) if templates else ():
            inputs.update(os.path.join(folder, name) for name in names)  # noqa: PTH118
        self.files = {path: read_state(path, known.get(path)) for path in inputs}
        for path in self.paths.outputs:
            is_known = inputs_only and path in known
            self.files[path] = known[path] if is_known else read_state(path, known.get(path), follow=False)
        return self.hashes()

    def hashes(self) -> dict[str, str]:
        """Return the hashes of all files, when they were last read."""
        return {path: state.sha256 for path, state in self.files.items()}

    def has_changed(self, paths: Collection[str] = ()) -> bool:
        """Return whether files have changed since they were last read; with `paths`, at these alone.

        If one of them is no file of the robot, but a folder or a link on the way to one, all are read.
        """
        if not paths or not self.files.keys() >= set(paths):
            return self.hashes() != self.read_files()
        before = {path: self.files[path] for path in paths}
        for path, state in before.items():
            self.files[path] = read_state(path, state, follow=path not in self.paths.outputs)
        return any(self.files[path].sha256 != state.sha256 for path, state in before.items())

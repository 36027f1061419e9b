"""When the files of one robot have settled: pure, told of events, samples and the time by its caller.

After the last event it has to be quiet for a while; then two samples some time apart have to be equal. A settled
source may still be invalid: then it is sampled again and again, until it changes or the time is up. All times are
seconds of one monotonic clock.
"""

from __future__ import annotations

import enum

import msgspec

_PAUSE = 1.0
"""Seconds between two samples of an invalid source: most changes are events, which need no sample."""


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


class Phase(enum.Enum):
    """What a robot waits for."""

    IDLE = "nothing: no event since the last build"
    QUIET = "no more events"
    COMPARE = "the second sample"
    SHRUNK = "a third sample, since many elements are gone"
    INVALID = "a valid source"
    SETTLED = "the build"


class Debouncer:
    """One robot's way from an event to a build."""

    def __init__(self, times: Times) -> None:
        self._times = times
        self._sample: object = None
        self._invalid_since: float | None = None
        self.phase = Phase.IDLE
        self.deadline: float | None = None
        """When the next sample is due; None if there is nothing to do."""
        self.is_rechecked = False
        """Whether the settled files were watched for longer, since the source had shrunk."""

    @property
    def is_idle(self) -> bool:
        """Whether nothing happened since the last build."""
        return self.phase is Phase.IDLE

    def is_due(self, now: float) -> bool:
        """Return whether a sample is to be taken."""
        return self.deadline is not None and self.deadline <= now

    def touch(self, now: float) -> None:
        """Begin again: something may have changed."""
        self.phase, self.is_rechecked = Phase.QUIET, False
        self.deadline = now + self._times.settle

    def add_sample(self, sample: object, now: float) -> Phase:
        """Take the sample that is due. Returns SETTLED if the robot is to be built, IDLE if the time is up."""
        is_equal, self._sample = sample == self._sample, sample
        if self.phase is Phase.QUIET and self._times.sample:
            self.phase, self.deadline = Phase.COMPARE, now + self._times.sample
        elif self.phase is not Phase.QUIET and not is_equal:
            self.touch(now)
        elif self.phase is Phase.INVALID:
            self.wait_for_valid(now)
        else:
            self.is_rechecked = self.phase is Phase.SHRUNK
            self.phase, self.deadline = Phase.SETTLED, None
        return self.phase

    def recheck_shrunk(self, now: float) -> None:
        """Sample once more, later: the settled source has lost many elements."""
        self.phase, self.deadline = Phase.SHRUNK, now + self._times.recheck_shrunk

    def wait_for_valid(self, now: float) -> Phase:
        """Wait for a valid source, at most `give_up_after` since the first call. Returns IDLE if the time is up."""
        self._invalid_since = now if self._invalid_since is None else self._invalid_since
        end = self._invalid_since + self._times.give_up_after
        if now >= end:
            self.rest()
        else:
            self.phase, self.deadline = Phase.INVALID, min(now + _PAUSE, end)
        return self.phase

    def rest(self) -> None:
        """Do nothing until the next event; since when the source is invalid is still known."""
        self.phase, self._sample, self.deadline = Phase.IDLE, None, None

    def note_valid(self) -> None:
        """Note that the settled source is valid: if it is invalid some day, `give_up_after` counts from then."""
        self._invalid_since = None

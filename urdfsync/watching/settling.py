"""When the files of one robot have settled: pure, told of events, samples and the time by its caller.

After the last event it has to be quiet for a while; then two samples some time apart have to be alike. What is
settled may still be no model: then it is waited for, and looked at again and again. All times are seconds of one
monotonic clock.
"""

from __future__ import annotations

import enum
from typing import Generic, TypeVar

import msgspec

S = TypeVar("S")

_PAUSE = 1.0
"""Seconds between two samples of what can't be read: most changes are events, which need no sample."""


class Times(msgspec.Struct, frozen=True):
    """How patient the daemon is; all in seconds."""

    settle: float = 0.3
    """So long no event."""
    sample: float = 0.2
    """Between the two samples that have to be alike; where there is no time between them, one sample is enough."""
    patience: float = 30.0
    """So long a source may be no model before that is an error."""
    doubt: float = 2.0
    """So long a source that has lost much is looked at before that is believed."""


class Verdict(enum.Enum):
    """What a sample says."""

    PENDING = enum.auto()
    """Look again at the deadline."""
    SETTLED = enum.auto()
    EXPIRED = enum.auto()
    """It has been no model for too long."""


class _Phase(enum.Enum):
    CALM = enum.auto()
    QUIET = enum.auto()
    COMPARE = enum.auto()
    DOUBT = enum.auto()
    WAIT = enum.auto()


class Settler(Generic[S]):
    """One robot's way from an event to a build. `S` is a sample: alike is what is equal."""

    def __init__(self, times: Times) -> None:
        self._times = times
        self._phase = _Phase.CALM
        self._sample: S | None = None
        self._since: float | None = None
        self.deadline: float | None = None
        """When the next sample is due; None if nothing is to be done."""
        self.believed = False
        """Whether what has settled was looked at for longer, since it was doubtful."""

    @property
    def calm(self) -> bool:
        """Whether nothing happened since the last build."""
        return self._phase is _Phase.CALM

    def touch(self, now: float) -> None:
        """Something may have changed: it has to be quiet from now on."""
        self._phase, self.believed = _Phase.QUIET, False
        self.deadline = now + self._times.settle

    def look(self, sample: S, now: float) -> Verdict:
        """Take note of a sample that was due."""
        alike = sample == self._sample
        self._sample = sample
        if self._phase is _Phase.QUIET and self._times.sample:
            self._phase, self.deadline = _Phase.COMPARE, now + self._times.sample
            return Verdict.PENDING
        if self._phase is not _Phase.QUIET and not alike:
            self.touch(now)
            return Verdict.PENDING
        if self._phase is _Phase.WAIT:
            return self._go_on_waiting(now)
        self.believed = self._phase is _Phase.DOUBT
        self.deadline = None
        return Verdict.SETTLED

    def doubt(self, now: float) -> None:
        """What has settled has lost much: look at it a little longer, unless that was done."""
        self._phase, self.deadline = _Phase.DOUBT, now + self._times.doubt

    def wait(self, now: float) -> Verdict:
        """What has settled is no model: wait, at most until patience is at its end since the first such time."""
        self._since = now if self._since is None else self._since
        self._phase = _Phase.WAIT
        return self._go_on_waiting(now)

    def rest(self) -> None:
        """Nothing more to be done until the next event; how long it has been no model is still known."""
        self._phase, self._sample, self.deadline = _Phase.CALM, None, None

    def readable(self) -> None:
        """What has settled is a model: if it is none some day, patience begins anew."""
        self._since = None

    def _go_on_waiting(self, now: float) -> Verdict:
        end = (now if self._since is None else self._since) + self._times.patience
        if now >= end:
            self.rest()
            return Verdict.EXPIRED
        self.deadline = min(now + _PAUSE, end)
        return Verdict.PENDING

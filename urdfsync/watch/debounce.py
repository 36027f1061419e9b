"""When files have settled: pure, told of events, samples and the time by its caller."""

from __future__ import annotations

import msgspec


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
        self.due: float | None = None
        """When the next sample is to be taken, in seconds of a monotonic clock; None if there is nothing to do."""

    @property
    def is_idle(self) -> bool:
        """Whether nothing happened since the last build."""
        return self.due is None

    def is_due(self, now: float) -> bool:
        """Return whether a sample is to be taken."""
        return self.due is not None and self.due <= now

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
        self._sample = self.due = None

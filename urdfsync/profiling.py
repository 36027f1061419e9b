"""Measure where the time of a command goes, stage by stage, for `--profile`.

Stages may lie inside each other: each moment counts for the innermost, so their times add up to that of the command.
Other processes measure themselves, and their times are added apart, since they may work at the same time.
"""

from __future__ import annotations

import contextlib
import time
from collections import Counter
from collections.abc import Iterator
from contextvars import ContextVar
from typing import TypeAlias

Measured: TypeAlias = tuple[dict[str, int], dict[str, int]]
"""What one process measured: ns of each stage, and counts."""

STAGES = (
    *("start", "imports", "saved answer", "configuration", "looking at files", "reading", "cross-check", "meshes"),
    *("artifacts", "rendering", "comparing", "deciding", "recording", "waiting", "writing", "syncing", "presentation"),
)
"""In the order in which they are shown, to people and to programs; `other` is what is in none of them."""
OTHER = "other"


class Profile:
    """The times and counts of one thread, until `results` asks for them."""

    def __init__(self) -> None:
        self.here: Counter[str] = Counter()
        """Nanoseconds by stage."""
        self.elsewhere: Counter[str] = Counter()
        """The same of other processes."""
        self.counts: Counter[str] = Counter()
        """Files that were `read` or `written`, texts that were `rendered`."""
        self.has_answer: bool | None = None
        """Whether a saved answer would have done; None for a command that has none."""
        self._stage, self._since = OTHER, time.perf_counter_ns()

    def switch(self, stage: str) -> str:
        """Count the time for another stage from now on; return the one before."""
        now, before = time.perf_counter_ns(), self._stage
        self.here[before] += now - self._since
        self._stage, self._since = stage, now
        return before

    def add(self, measured: Measured) -> None:
        """Add what another process measured."""
        self.elsewhere.update(measured[0])
        self.counts.update(measured[1])

    def results(self) -> Measured:
        """Return what was measured so far."""
        self.switch(self._stage)
        return dict(self.here), dict(self.counts)


_profile: ContextVar[Profile | None] = ContextVar("profile", default=None)


@contextlib.contextmanager
def stage(name: str) -> Iterator[None]:
    """Let what happens inside count for one of `STAGES`; also a decorator, for a whole function."""
    profile = _profile.get()
    if profile is None:
        yield
        return
    outer = profile.switch(name)
    try:
        yield
    finally:
        profile.switch(outer)


def count(what: str, number: int = 1) -> None:
    """Count so many things that were done."""
    if (profile := _profile.get()) is not None:
        profile.counts[what] += number


def current() -> Profile | None:
    """Return the profile that is being made; None if nobody asked for one."""
    return _profile.get()


@contextlib.contextmanager
def measured(since: int | None = None) -> Iterator[Profile]:
    """Measure what happens inside, in this thread; `since` is when the program began (ns of the monotonic clock)."""
    profile = Profile()
    if since is not None:
        profile.here["start"] = time.monotonic_ns() - since
    token = _profile.set(profile)
    try:
        yield profile
    finally:
        _profile.reset(token)

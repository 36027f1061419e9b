"""Where the time of a command goes, stage by stage, while somebody wants to know; else it costs next to nothing.

Stages may lie inside each other: each moment counts for the innermost, so their times add up to that of the command.
What other processes do meanwhile is counted by them, and added apart.
"""

from __future__ import annotations

import builtins
import contextlib
import functools
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from typing import Any, ParamSpec, TypeAlias, TypeVar

_Parameters = ParamSpec("_Parameters")
_Returned = TypeVar("_Returned")

Elsewhere: TypeAlias = tuple[dict[str, int], dict[str, int]]
"""What another process measured: ns of each stage, and counts."""

STAGES = (
    *("start", "imports", "stamp", "configuration", "looking", "reading", "cross-check", "meshes", "artifacts"),
    *("rendering", "comparing", "deciding", "recording", "waiting", "writing", "syncing", "presentation"),
)
"""In the order in which they are shown; `other` is what is in none of them."""
OTHER = "other"


class Profile:
    """Measures until it is asked for its results; of one thread."""

    def __init__(self) -> None:
        self.here: Counter[str] = Counter()
        """Nanoseconds by stage."""
        self.elsewhere: Counter[str] = Counter()
        """The same of other processes; they may work at the same time."""
        self.counts: Counter[str] = Counter()
        """Files that were `read` or `written`, texts that were `rendered`."""
        self.stamp: bool | None = None
        """Whether a stamp would have answered; None if there is none for such a command."""
        self._inside = [OTHER]
        self._since = time.perf_counter_ns()

    def enter(self, stage: str) -> None:
        """Begin a stage."""
        self._close()
        self._inside.append(stage)

    def leave(self) -> None:
        """End the innermost stage."""
        self._close()
        self._inside.pop()

    def add(self, found: Elsewhere) -> None:
        """Take over what another process measured."""
        self.elsewhere.update(found[0])
        self.counts.update(found[1])

    def results(self) -> Elsewhere:
        """What was measured so far."""
        self._close()
        return dict(self.here), dict(self.counts)

    def _close(self) -> None:
        now = time.perf_counter_ns()
        self.here[self._inside[-1]] += now - self._since
        self._since = now


_profile: ContextVar[Profile | None] = ContextVar("profile", default=None)


class _Stage:
    def __init__(self, profile: Profile, name: str) -> None:
        self._profile, self._name = profile, name

    def __enter__(self) -> None:
        self._profile.enter(self._name)

    def __exit__(self, *_: object) -> None:
        self._profile.leave()


_NOTHING = contextlib.nullcontext()


def stage(name: str) -> contextlib.AbstractContextManager[None]:
    """What happens inside belongs to this stage, one of `STAGES`."""
    profile = _profile.get()
    return _NOTHING if profile is None else _Stage(profile, name)


def staged(name: str) -> Callable[[Callable[_Parameters, _Returned]], Callable[_Parameters, _Returned]]:
    """The same for a function as a whole."""

    def decorate(function: Callable[_Parameters, _Returned]) -> Callable[_Parameters, _Returned]:
        @functools.wraps(function)
        def call(*arguments: _Parameters.args, **named: _Parameters.kwargs) -> _Returned:
            with stage(name):
                return function(*arguments, **named)

        return call

    return decorate


def count(what: str, number: int = 1) -> None:
    """So many more things were done."""
    if (profile := _profile.get()) is not None:
        profile.counts[what] += number


def current() -> Profile | None:
    """The profile that is being made; None if nobody wants one."""
    return _profile.get()


@contextlib.contextmanager
def measured(since: int | None = None) -> Iterator[Profile]:
    """Measure what happens inside, in this thread; `since` is when the program began (ns of the monotonic clock)."""
    profile = Profile()
    if since is not None:
        profile.here["start"] = time.monotonic_ns() - since
    token, original = _profile.set(profile), builtins.__import__

    def load(name: str, *arguments: Any, **named: Any) -> Any:
        if name in sys.modules or profile is not _profile.get():
            return original(name, *arguments, **named)
        with stage("imports"):
            return original(name, *arguments, **named)

    builtins.__import__ = load
    try:
        yield profile
    finally:
        builtins.__import__ = original
        _profile.reset(token)

"""When files have settled, with a clock of the test's own."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.watch.debounce import Debouncer, Phase, Times

TIMES = Times(settle=0.3, sample=0.2, give_up_after=30.0, recheck_shrunk=2.0)
SMALLEST = 1e-6


def touched(now: float = 0.0) -> Debouncer:
    debouncer = Debouncer(TIMES)
    debouncer.touch(now)
    return debouncer


def settled(now: float = 0.0) -> Debouncer:
    debouncer = touched(now)
    debouncer.add_sample("a", now + 0.3)
    assert debouncer.add_sample("a", now + 0.5) is Phase.SETTLED
    return debouncer


def test_an_invalid_source_is_given_up_after_a_time() -> None:
    debouncer = settled(0.0)
    assert debouncer.wait_for_valid(0.5) is Phase.INVALID
    assert debouncer.add_sample("a", 1.5) is Phase.INVALID
    assert debouncer.add_sample("a", 30.4) is Phase.INVALID
    assert debouncer.deadline == pytest.approx(30.5)
    assert debouncer.add_sample("a", 30.5) is Phase.IDLE
    assert debouncer.is_idle


def test_the_time_counts_from_the_first_invalid_sample() -> None:
    debouncer = settled(0.0)
    debouncer.wait_for_valid(0.5)
    debouncer.touch(29.0)
    debouncer.add_sample("b", 29.3)
    assert debouncer.add_sample("b", 29.5) is Phase.SETTLED
    assert debouncer.wait_for_valid(29.5) is Phase.INVALID
    debouncer.touch(31.0)
    debouncer.add_sample("c", 31.3)
    assert debouncer.add_sample("c", 31.5) is Phase.SETTLED
    assert debouncer.wait_for_valid(31.5) is Phase.IDLE


steps = st.lists(
    st.tuples(st.sampled_from(["event", "write", "silent write", "wait"]), st.floats(0.0, 3.0)), max_size=40
)


@given(steps)
def test_nothing_is_built_that_has_just_changed(steps: list[tuple[str, float]]) -> None:
    """Whatever happens when: what settles was the same for 200 ms, and had no event for 500 ms."""
    debouncer = Debouncer(TIMES)
    now, content, changed, event = 0.0, 0, -10.0, -10.0
    debouncer.touch(now)
    event = now
    for what, pause in [*steps, ("wait", 10.0)]:
        if what in ("write", "silent write"):
            content, changed = content + 1, now
        if what in ("event", "write"):
            debouncer.touch(now)
            event = now
        end = now + pause
        while debouncer.deadline is not None and debouncer.deadline <= end:
            now = max(debouncer.deadline, now)
            if debouncer.add_sample(content, now) is Phase.SETTLED:
                assert now - changed >= TIMES.sample - SMALLEST or changed == -10.0
                assert now - event >= TIMES.settle + TIMES.sample - SMALLEST
                debouncer.rest()
        now = end
    assert debouncer.is_idle, "it settles as soon as nothing happens any more"


@given(st.lists(st.floats(0.0, 0.29), min_size=1, max_size=50))
def test_a_steady_writer_is_never_sampled(pauses: list[float]) -> None:
    debouncer = Debouncer(TIMES)
    now = 0.0
    for pause in pauses:
        debouncer.touch(now)
        now += pause
        assert debouncer.deadline is not None
        assert debouncer.deadline > now

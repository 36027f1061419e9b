"""When files have settled, with a clock of the test's own."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.watching.settling import Settler, Times, Verdict

TIMES = Times(settle=0.3, sample=0.2, patience=30.0, doubt=2.0)
SMALLEST = 1e-6
PENDING, SETTLED, EXPIRED = Verdict


def touched(now: float = 0.0) -> Settler[str]:
    settler: Settler[str] = Settler(TIMES)
    settler.touch(now)
    return settler


def settled(now: float = 0.0, sample: str = "a") -> Settler[str]:
    settler = touched(now)
    settler.look(sample, now + 0.3)
    assert settler.look(sample, now + 0.5) is SETTLED
    return settler


def test_quiet_and_two_equal_samples() -> None:
    settler = touched(10.0)
    assert settler.deadline == pytest.approx(10.3)
    assert settler.look("a", 10.3) is PENDING
    assert settler.deadline == pytest.approx(10.5)
    assert settler.look("a", 10.5) is SETTLED
    assert settler.deadline is None


def test_every_event_begins_anew() -> None:
    settler = touched(10.0)
    settler.look("a", 10.3)
    settler.touch(10.4)
    assert settler.look("a", 10.7) is PENDING, "equal to the sample before the event, but one is not two"
    assert settler.look("a", 10.9) is SETTLED


def test_different_samples_begin_anew() -> None:
    settler = touched()
    settler.look("a", 0.3)
    assert settler.look("b", 0.5) is PENDING
    assert settler.deadline == pytest.approx(0.8)
    assert settler.look("b", 0.8) is PENDING
    assert settler.look("b", 1.0) is SETTLED


def test_what_is_no_model_is_an_error_when_patience_ends() -> None:
    settler = settled(0.0)
    assert settler.wait(0.5) is PENDING
    assert settler.look("a", 1.5) is PENDING
    assert settler.look("a", 30.4) is PENDING
    assert settler.deadline == pytest.approx(30.5)
    assert settler.look("a", 30.5) is EXPIRED
    assert settler.calm


def test_patience_counts_from_the_first_time_it_was_no_model() -> None:
    settler = settled(0.0)
    settler.wait(0.5)
    settler.touch(29.0)
    settler.look("b", 29.3)
    assert settler.look("b", 29.5) is SETTLED
    assert settler.wait(29.5) is PENDING
    settler.touch(31.0)
    settler.look("c", 31.3)
    assert settler.look("c", 31.5) is SETTLED
    assert settler.wait(31.5) is EXPIRED


def test_patience_begins_anew_after_a_model() -> None:
    settler = settled(0.0)
    settler.wait(0.5)
    settler.readable()
    settler.rest()
    settler.touch(100.0)
    settler.look("b", 100.3)
    settler.look("b", 100.5)
    assert settler.wait(100.5) is PENDING


def test_what_is_waited_for_settles_when_it_changes() -> None:
    settler = settled(0.0)
    settler.wait(0.5)
    assert settler.look("b", 1.5) is PENDING
    assert settler.look("b", 1.8) is PENDING
    assert settler.look("b", 2.0) is SETTLED


def test_what_is_doubtful_is_believed_when_it_stays() -> None:
    settler = settled(0.0)
    assert not settler.believed
    settler.doubt(0.5)
    assert settler.deadline == pytest.approx(2.5)
    assert settler.look("a", 2.5) is SETTLED
    assert settler.believed


def test_what_is_doubtful_and_changes_is_not_believed() -> None:
    settler = settled(0.0)
    settler.doubt(0.5)
    settler.touch(1.0)
    settler.look("b", 1.3)
    assert settler.look("b", 1.5) is SETTLED
    assert not settler.believed


def test_times_of_zero() -> None:
    settler: Settler[str] = Settler(Times(settle=0, sample=0))
    settler.touch(1.0)
    assert settler.look("a", 1.0) is SETTLED, "another sample would have to be alike at the same moment"
    assert settler.deadline is None


steps = st.lists(
    st.tuples(st.sampled_from(["event", "write", "silent write", "wait"]), st.floats(0.0, 3.0)), max_size=40
)


@given(steps)
def test_nothing_is_built_that_has_just_changed(steps: list[tuple[str, float]]) -> None:
    """Whatever happens when: what settles was the same for 200 ms, and had no event for 500 ms."""
    settler: Settler[int] = Settler(TIMES)
    now, content, changed, event = 0.0, 0, -10.0, -10.0
    settler.touch(now)
    event = now
    for what, pause in [*steps, ("wait", 10.0)]:
        if what in ("write", "silent write"):
            content, changed = content + 1, now
        if what in ("event", "write"):
            settler.touch(now)
            event = now
        end = now + pause
        while settler.deadline is not None and settler.deadline <= end:
            now = max(settler.deadline, now)
            if settler.look(content, now) is SETTLED:
                assert now - changed >= TIMES.sample - SMALLEST or changed == -10.0
                assert now - event >= TIMES.settle + TIMES.sample - SMALLEST
                settler.rest()
        now = end
    assert settler.calm, "it settles as soon as nothing happens any more"


@given(st.lists(st.floats(0.0, 0.29), min_size=1, max_size=50))
def test_a_steady_writer_is_never_sampled(pauses: list[float]) -> None:
    settler: Settler[int] = Settler(TIMES)
    now = 0.0
    for pause in pauses:
        settler.touch(now)
        now += pause
        assert settler.deadline is not None
        assert settler.deadline > now

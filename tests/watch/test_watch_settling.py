"""When files have settled, with a clock of the test's own."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from urdfsync.watch.robot import Debouncer, Times

TIMES = Times(settle=0.3, sample=0.2)
SMALLEST = 1e-6

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
        while debouncer.due <= end:
            now = max(debouncer.due, now)
            if debouncer.add_sample(content, now):
                assert now - changed >= TIMES.sample - SMALLEST or changed == -10.0
                assert now - event >= TIMES.settle + TIMES.sample - SMALLEST
                debouncer.rest()
        now = end
    assert debouncer.is_idle, "it settles as soon as nothing happens any more"

"""The journal as text."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from urdfsync.state.journal import Journal, Phase, Step

hashes = st.none() | st.text("0123456789abcdef", min_size=64, max_size=64)
steps = st.builds(Step, st.text(), hashes, hashes)
journals = st.builds(Journal, st.text(), st.text(), st.lists(steps).map(tuple), st.just(("a", "a/b")), st.just(()))


@given(journals)
def test_what_is_written_is_read_again(journal: Journal) -> None:
    assert Journal.loads(journal.dumps()) == journal


def test_a_text_that_is_cut_short_is_no_journal() -> None:
    text = Journal("arm", "1", (Step("Arm.mo", None, "0" * 64),)).dumps()
    assert all(Journal.loads(text[:length]) is None for length in range(len(text)))


def test_phases_are_in_their_order() -> None:
    assert list(Phase) == [Phase.PREPARE, Phase.APPLY, Phase.UNDO, Phase.DONE]

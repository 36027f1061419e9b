"""What each edit does by itself."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from hypothesis import given
from hypothesis import strategies as st

from urdfsync.check.compilation import edit_effects
from urdfsync.check.results import TOLERANCE, EditEffect
from urdfsync.domain import Deviation, Quantity

FILES = ["A.mo", "B.mo", "C.mo"]
OWNERS = {"A.mo": "joint a", "B.mo": "joint b", "C.mo": "joint b"}


def torque(joint: str, difference: float) -> Deviation:
    return Deviation(Quantity.EFFORT, f"joint {joint}", difference, 10.0, 50.0, "N·m")


def effects(
    files: Sequence[str],
    whole: Sequence[Deviation],
    single: Mapping[str, Sequence[Deviation]],
) -> list[EditEffect]:
    return list(edit_effects(files, OWNERS, whole, single))


def test_one_edited_file_does_it_all() -> None:
    found = effects(["A.mo"], [torque("elbow", 2.0), torque("wrist", 1e-15)], {})
    assert found == [EditEffect(("A.mo",), (torque("elbow", 2.0),), ("joint a",))]


def test_edits_are_told_apart() -> None:
    single = {"A.mo": [torque("elbow", 2.0)], "B.mo": [torque("elbow", 0.0)]}
    first, second = effects(["A.mo", "B.mo"], [torque("elbow", 2.0)], single)
    assert (first.files, first.deviations) == (("A.mo",), (torque("elbow", 2.0),))
    assert (second.files, second.deviations) == (("B.mo",), ())


def test_what_no_single_edit_does_the_others_do_together() -> None:
    """A limit that a changed model now reads: neither file does anything without the other; a third one does."""
    single = {file: [torque("elbow", 0.0)] for file in FILES} | {"A.mo": [torque("shoulder", 0.3)]}
    alone, together = effects(FILES, [torque("shoulder", 0.3), torque("elbow", 4.0)], single)
    assert (alone.files, alone.deviations) == (("A.mo",), (torque("shoulder", 0.3),))
    assert (together.files, together.deviations) == (("B.mo", "C.mo"), (torque("elbow", 4.0),))
    assert together.owners == ("joint b",)


values = st.floats(0, 1e3) | st.sampled_from([0.0, 1e-12, float("inf")])
lists = st.lists(values, min_size=1, max_size=4).map(lambda found: [torque(str(k), one) for k, one in enumerate(found)])


@given(lists, st.dictionaries(st.sampled_from(FILES), lists))
def test_every_file_and_every_change_is_told(whole: list[Deviation], single: dict[str, list[Deviation]]) -> None:
    found = effects(FILES, whole, single)
    told = {one.element for effect in found for one in effect.deviations}
    assert {file for effect in found for file in effect.files} == set(FILES)
    assert {one.element for one in whole if one.relative > TOLERANCE} <= told
    assert all(one.relative > TOLERANCE for effect in found for one in effect.deviations)

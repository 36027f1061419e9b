"""What each edit does by itself."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from urdfsync.check.physics import edit_effects, unexplained
from urdfsync.check.results import TOLERANCE
from urdfsync.domain import Deviation, Quantity


def torque(joint: str, difference: float) -> Deviation:
    return Deviation(Quantity.EFFORT, f"joint {joint}", difference, 10.0, 50.0, "N·m")


def test_one_edited_file_does_it_all() -> None:
    (effect,) = edit_effects(["Joints/Elbow.mo"], [torque("elbow", 2.0), torque("wrist", 1e-15)], {}, [])
    assert effect.files == ("Joints/Elbow.mo",)
    assert effect.deviations == (torque("elbow", 2.0),)


def test_edits_are_told_apart() -> None:
    single = {"A.mo": [torque("elbow", 2.0)], "B.mo": [torque("elbow", 0.0)]}
    first, second = edit_effects(["A.mo", "B.mo"], [torque("elbow", 2.0)], single, [torque("elbow", 1e-14)])
    assert (first.files, first.deviations) == (("A.mo",), (torque("elbow", 2.0),))
    assert (second.files, second.deviations) == (("B.mo",), ())


def test_edits_that_only_together_change_anything_are_told_together_beside_others() -> None:
    """A limit that a changed model now reads: neither file does anything without the other; a third one does."""
    files = ["Elbow.mo", "ElbowParameters.mo", "Shoulder.mo"]
    whole = [torque("shoulder", 0.3), torque("elbow", 4.0)]
    single = {
        "Elbow.mo": [torque("elbow", 0.0)],
        "ElbowParameters.mo": [torque("elbow", 0.0)],
        "Shoulder.mo": [torque("shoulder", 0.3)],
    }
    alone, together = edit_effects(files, whole, single, [torque("shoulder", 0.0), torque("elbow", 4.0)])
    assert (alone.files, alone.deviations) == (("Shoulder.mo",), (torque("shoulder", 0.3),))
    assert (together.files, together.deviations) == (("Elbow.mo", "ElbowParameters.mo"), (torque("elbow", 4.0),))


def test_a_rest_that_is_small_beside_the_whole_is_no_effect_of_its_own() -> None:
    """Two turns one after the other are not quite the sum of both."""
    single = {"A.mo": [torque("elbow", 2.0)], "B.mo": [torque("elbow", 1.0)]}
    found = edit_effects(["A.mo", "B.mo"], [torque("elbow", 3.0)], single, [torque("elbow", 0.001)])
    assert [effect.files for effect in found] == [("A.mo",), ("B.mo",)]


def test_what_is_left_over_is_what_single_edits_do_not_explain() -> None:
    baseline, whole = {"x": [1.0, 2.0]}, {"x": [1.5, 7.0]}
    found = unexplained(baseline, whole, [{"x": [1.5, 2.0]}, {"x": [1.0, 4.0]}])
    assert found == {"x": [1.0, 5.0]}


numbers = st.integers(-8, 8).map(lambda number: number / 4)


@given(
    base=st.lists(numbers, min_size=2, max_size=2),
    shifts=st.lists(st.lists(numbers, min_size=2, max_size=2), max_size=4),
)
def test_edits_that_add_up_leave_nothing_over(base: list[float], shifts: list[list[float]]) -> None:
    single = [{"x": [value + shift for value, shift in zip(base, one, strict=True)]} for one in shifts]
    whole = {"x": [value + sum(one[k] for one in shifts) for k, value in enumerate(base)]}
    assert unexplained({"x": base}, whole, single) == {"x": base}


values = st.floats(0, 1e3) | st.sampled_from([0.0, 1e-12, float("inf")])
lists = st.lists(values, min_size=1, max_size=4)


@given(lists, st.dictionaries(st.sampled_from(["A.mo", "B.mo", "C.mo"]), lists), lists)
def test_every_file_is_told_once_and_only_what_is_beyond_the_tolerance(
    whole: list[float], single: dict[str, list[float]], rest: list[float]
) -> None:
    def deviations(found: list[float]) -> list[Deviation]:
        return [torque(str(number), value) for number, value in enumerate(found)]

    files = ["A.mo", "B.mo", "C.mo"]
    runs = {file: deviations(found) for file, found in single.items()}
    found = edit_effects(files, deviations(whole), runs, deviations(rest))
    silent = [file for effect in found for file in effect.files if not effect.deviations]
    assert len(silent) == len(set(silent))
    assert {file for effect in found for file in effect.files} == set(files)
    assert all(one.relative > TOLERANCE for effect in found for one in effect.deviations if effect.files[1:] == ())

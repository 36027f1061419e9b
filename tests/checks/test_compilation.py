"""How far a simulation is from what is expected, and what each edit does by itself."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.checks.compilation import compare, edit_effects
from urdfsync.checks.results import EditEffect
from urdfsync.domain.experiment import TOLERANCE, Compared, Deviation, Quantity

FILES = ["A.mo", "B.mo", "C.mo"]
OWNERS = {"A.mo": "joint a", "B.mo": "joint b", "C.mo": "joint b"}


def torque(joint: str, difference: float) -> Deviation:
    return Deviation(Quantity.EFFORT, f"joint {joint}", difference, 10.0, 50.0, "N·m")


def effects(
    files: Sequence[str], whole: Sequence[Deviation], single: Mapping[str, Sequence[Deviation]]
) -> list[EditEffect]:
    return list(edit_effects(files, OWNERS, whole, single))


ELBOW, SHOULDER, NOTHING = torque("elbow", 4.0), torque("shoulder", 0.3), torque("elbow", 0.0)
CASES: dict[str, tuple[list[str], list[Deviation], dict[str, list[Deviation]], list[EditEffect]]] = {
    "one file does it all": (
        ["A.mo"], [ELBOW, torque("wrist", 1e-15)], {}, [EditEffect(("A.mo",), (ELBOW,), ("joint a",))],
    ),
    "each by itself": (
        ["A.mo", "B.mo"], [ELBOW], {"A.mo": [ELBOW], "B.mo": [NOTHING]},
        [EditEffect(("A.mo",), (ELBOW,), ("joint a",)), EditEffect(("B.mo",), (), ("joint b",))],
    ),
    # a limit that a changed model now reads: neither file does anything without the other; a third one does
    "what no single one does the others do together": (
        FILES, [SHOULDER, ELBOW], {"A.mo": [SHOULDER], "B.mo": [NOTHING], "C.mo": [NOTHING]},
        [EditEffect(("A.mo",), (SHOULDER,), ("joint a",)), EditEffect(("B.mo", "C.mo"), (ELBOW,), ("joint b",))],
    ),
}  # fmt: skip


@pytest.mark.parametrize(("files", "whole", "single", "expected"), CASES.values(), ids=CASES)
def test_edits_are_told_apart(
    files: list[str], whole: list[Deviation], single: dict[str, list[Deviation]], expected: list[EditEffect]
) -> None:
    assert effects(files, whole, single) == expected


values = st.floats(0, 1e3) | st.sampled_from([0.0, 1e-12, float("inf")])
lists = st.lists(values, min_size=1, max_size=4).map(lambda found: [torque(str(k), one) for k, one in enumerate(found)])


@given(lists, st.dictionaries(st.sampled_from(FILES), lists))
def test_every_file_and_every_change_is_told(whole: list[Deviation], single: dict[str, list[Deviation]]) -> None:
    found = effects(FILES, whole, single)
    told = {one.element for effect in found for one in effect.deviations}
    assert {file for effect in found for file in effect.files} == set(FILES)
    assert {one.element for one in whole if one.relative > TOLERANCE} <= told
    assert all(one.relative > TOLERANCE for effect in found for one in effect.deviations)


ENDS = (0.0, 1.0)
COMPARED = (
    Compared(Quantity.EFFORT, "joint a", "N·m", ("a",), ENDS),
    Compared(Quantity.EFFORT, "joint b", "N·m", ("b",), ENDS),
    Compared(Quantity.EFFORT, "joint c", "N", ("c", "d"), ENDS),
)
EXPECTED: dict[str, tuple[float, ...]] = {
    "time": ENDS,
    "a": (1.0, 2.0),
    "b": (-50.0, 7.0),
    "c": (0.0, 0.0),
    "d": (0.5, 300.0),
}


def test_differences_are_the_greatest_of_the_instants_and_sizes_those_of_a_unit() -> None:
    """A torque is not held against forces, and what is between the instants does not count."""
    series = {**EXPECTED, "time": (0.0, 0.5, 1.0), "a": (1.5, 99.0, 2.25), "b": (-50.0, 0.0, 7.0)}
    series |= {"c": (0.0, 1.0, 0.0), "d": (0.0, 9.0, 301.0)}
    found = compare(COMPARED, series, EXPECTED)
    assert [(one.difference, one.value, one.size) for one in found] == [
        (0.5, 2.0, 50.0), (0.0, 50.0, 50.0), (1.0, 300.0, 300.0),
    ]  # fmt: skip


@pytest.mark.parametrize("numbers", [None, (), (math.nan, 1.0), (1.0, math.nan), (1.0, math.inf)])
def test_a_value_that_is_no_number_is_infinitely_far_off(numbers: tuple[float, ...] | None) -> None:
    lacking = {**EXPECTED, "a": numbers} if numbers is not None else {k: v for k, v in EXPECTED.items() if k != "a"}
    for series, baseline in ((lacking, EXPECTED), (EXPECTED, lacking), (lacking, lacking)):
        found = compare(COMPARED, series, baseline)
        assert [one.difference for one in found] == [math.inf, 0.0, 0.0]
        assert all(math.isfinite(one.value) for one in found)

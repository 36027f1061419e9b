"""How far a simulation is from what is expected, and what each edit does by itself."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.analysis.checks.compilation import compare, edit_effects
from urdfsync.analysis.checks.results import EditEffect
from urdfsync.domain.experiment import Compared, Deviation, Quantity

FILES = ["A.mo", "B.mo", "C.mo"]
OWNERS = {"A.mo": "joint a", "B.mo": "joint b", "C.mo": "joint b"}


def torque(joint: str, difference: float) -> Deviation:
    return Deviation(Quantity.EFFORT, f"joint {joint}", difference, 10.0, 50.0, "N·m")


def effects(
    files: Sequence[str], whole: Sequence[Deviation], single: Mapping[str, Sequence[Deviation]]
) -> list[EditEffect]:
    return list(edit_effects(files, OWNERS, whole, single))


ELBOW, SHOULDER = torque("elbow", 4.0), torque("shoulder", 0.3)
CASES: dict[str, tuple[list[str], list[Deviation], dict[str, list[Deviation]], list[EditEffect]]] = {
    "one file does it all": (["A.mo"], [ELBOW], {"A.mo": [ELBOW]}, [EditEffect(("A.mo",), (ELBOW,), ("joint a",))]),
    "each by itself": (
        ["A.mo", "B.mo"], [ELBOW], {"A.mo": [ELBOW], "B.mo": []},
        [EditEffect(("A.mo",), (ELBOW,), ("joint a",)), EditEffect(("B.mo",), (), ("joint b",))],
    ),
    "no single one explains it": (
        FILES, [SHOULDER, ELBOW], {"A.mo": [SHOULDER], "B.mo": [], "C.mo": []},
        [EditEffect(("A.mo",), (SHOULDER,), ("joint a",)), EditEffect(tuple(FILES), (ELBOW,), ("joint a", "joint b"))],
    ),
    "too many to tell apart": (FILES, [ELBOW], {}, [EditEffect(tuple(FILES), (ELBOW,), ("joint a", "joint b"))]),
    "nothing changes": (FILES, [], {}, [EditEffect(tuple(FILES), (), ("joint a", "joint b"))]),
    # nothing compares C.mo: the package works neither without it nor with it alone
    "one can't be measured": (
        FILES, [ELBOW], {"A.mo": [ELBOW], "B.mo": []},
        [EditEffect(("A.mo",), (ELBOW,), ("joint a",)), EditEffect(("B.mo",), (), ("joint b",))],
    ),
}  # fmt: skip


@pytest.mark.parametrize(("files", "whole", "single", "expected"), CASES.values(), ids=CASES)
def test_edits_are_told_apart(
    files: list[str], whole: list[Deviation], single: dict[str, list[Deviation]], expected: list[EditEffect]
) -> None:
    assert effects(files, whole, single) == expected


values = st.floats(0.1, 1e3) | st.just(math.inf)
lists = st.lists(values, min_size=1, max_size=4).map(lambda found: [torque(str(k), one) for k, one in enumerate(found)])


@given(lists, st.fixed_dictionaries(dict.fromkeys(FILES, lists)))
def test_every_file_and_every_change_is_told(whole: list[Deviation], single: dict[str, list[Deviation]]) -> None:
    found = effects(FILES, whole, single)
    told = {one.element for effect in found for one in effect.deviations}
    assert {file for effect in found for file in effect.files} == set(FILES)
    assert {one.element for one in whole} <= told


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
    """Two simulations without it agree."""
    lacking = {**EXPECTED, "a": numbers} if numbers is not None else {k: v for k, v in EXPECTED.items() if k != "a"}
    for series, baseline, difference in (
        (lacking, EXPECTED, math.inf),
        (EXPECTED, lacking, math.inf),
        (lacking, lacking, 0),
    ):
        found = compare(COMPARED, series, baseline)
        assert [one.difference for one in found] == [difference, 0.0, 0.0]
        assert all(math.isfinite(one.value) for one in found)

"""Values in few characters: enough digits to see a difference, no more text than helps."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from urdfsync.comparing import figures

NUMBERS = st.floats(-1e6, 1e6)


@pytest.mark.parametrize(
    ("old", "new", "shown"),
    [
        (1.0, 1.5, "1 → 1.5"),
        (1.2345678, 2.3456789, "1.235 → 2.346"),
        (1.2345678, 1.2345999, "1.2345678 → 1.2345999"),
        (1e-5, 2e-5, "1e-05 → 2e-05"),
        (0.00123456789, 0.00234567891, "0.001235 → 0.002346"),
        (123456.789, 234567.891, "123457 → 234568"),
        (1e300, 1.5e300, "1e+300 → 1.5e+300"),
        (True, False, "true → false"),
        (None, 1.5, "null → 1.5"),
        ("revolute", "fixed", "revolute → fixed"),
        ("", "b", '"" → b'),
        ("a" * 64, "b" * 64, "aaaaaaaa → bbbbbbbb"),
        (
            f"{'x' * 50}1.5{'y' * 50}",
            f"{'x' * 50}2.5{'y' * 50}",
            f"…{'x' * 12}1.5{'y' * 23}… → …{'x' * 12}2.5{'y' * 23}…",
        ),
        (f"{'x' * 50}", f"{'x' * 50}z", f"…{'x' * 12} → …{'x' * 12}z"),
    ],
)
def test_pairs(old: Any, new: Any, shown: str) -> None:
    assert " → ".join(figures.pair(old, new)) == shown


def test_everything_is_everything() -> None:
    assert figures.pair(0.1 + 0.2, 1e-17, everything=True) == ("0.30000000000000004", "1e-17")
    assert figures.pair("x" * 99, "", everything=True) == ("x" * 99, "")


@given(NUMBERS, NUMBERS)
@example(0.0, 5e-324)
def test_numbers_that_differ_look_different(old: float, new: float) -> None:
    assume(abs(new - old) > 1e-6 * max(abs(old), abs(new)))
    shown = figures.pair(old, new)
    assert shown[0] != shown[1]
    for text, value in zip(shown, (old, new), strict=True):
        assert float(text) == pytest.approx(value, abs=0.01 * abs(new - old), rel=1e-9)
        assert len(text) <= 17


@given(st.lists(st.tuples(NUMBERS, NUMBERS), min_size=1, max_size=4))
def test_vectors_that_differ_look_different(pairs: list[tuple[float, float]]) -> None:
    old, new = zip(*pairs, strict=True)
    assume(max(abs(b - a) for a, b in pairs) > 1e-6 * max(map(abs, (*old, *new))))
    before, after = figures.vectors(old, new)
    assert before != after


@pytest.mark.parametrize(
    ("old", "new", "shown"),
    [
        (2, 1, "-50 %"),
        (54.0, 60.0, "+11.1 %"),
        (52.345, 52.695, "+0.669 %"),
        (1.2345678, 1.2345999, "+0.0026 %"),
        (1.0, 1.000001, "< 0.001 %"),
        (100.0, 700.0, "+600 %"),
        (1.0, 100.0, "× 100"),
        (-2.0, -1.0, "+50 %"),
        (0.5, 0.0, "-100 %"),
        (1.0, -1.0, ""),
        (0.0, 0.5, ""),
        (None, 0.5, ""),
        (True, 2, ""),
    ],
)
def test_percent(old: Any, new: Any, shown: str) -> None:
    assert figures.percent(old, new) == shown


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (None, "added"),
        (1.5, "added: 1.5"),
        ([1, 0.5, 1 / 3], "added: (1, 0.5, 0.3333)"),
        ([{"a": 1}], "added"),
        ("<gazebo reference='a'/>", "added"),
        ("package://arm/tip.stl", "added: package://arm/tip.stl"),
        ({"lower": -1, "upper": 1.5, "name": ""}, "added: lower -1, upper 1.5"),
        ({"name": "a", "geometry": {"kind": "box", "size": [1, 2, 3]}}, "added: name a, geometry kind box"),
        ({"gazebo": "<gazebo>" * 9}, "added: gazebo"),
    ],
)
def test_what_comes(value: Any, shown: str) -> None:
    assert figures.coming("added", value) == shown

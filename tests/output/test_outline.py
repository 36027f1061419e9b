"""Changes in few words: numbers, vectors, noise, what comes and goes, and what many elements share."""

from __future__ import annotations

import math
from typing import Any

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from urdfsync.domain import ChangeClass, ChangeKind
from urdfsync.domain.changes import Change, Effect
from urdfsync.domain.comparison import Changes
from urdfsync.output.outline import effect_rows, number_table, outline


def change(
    path: str,
    old: Any,
    new: Any,
    unit: str = "",
    reach: ChangeClass = ChangeClass.PARAMETER,
    kind: ChangeKind = ChangeKind.CHANGED,
) -> Change:
    return Change(tuple(path.split(" / ")), kind, reach, old, new, unit)


def lines(*found: Change, everything: bool = False) -> list[str]:
    """The outline as plain lines: elements, and below them their rows."""
    elements = outline(Changes(found), everything=everything)
    return [line for title, rows in elements for line in (title, *(f"  {row}" for row in rows))]


def test_angles_are_also_in_degrees() -> None:
    found = lines(change("joint elbow / limit / upper", 0.0, math.pi / 2, "rad"))
    assert found[1] == "  limit / upper 0 → 1.5708 rad (0° → 90°)"


def test_components_of_a_vector_are_one_row() -> None:
    found = lines(
        change("joint a / origin / rpy[0]", 0.0, math.pi, "rad"),
        change("joint a / origin / rpy[2]", 0.0, -math.pi / 2, "rad"),
        change("joint a / origin / xyz[1]", 0.1, 0.2, "m"),
    )
    assert found == [
        "joint a",
        "  origin / rpy[0, 2] (0, 0) → (3.14159, -1.5708) rad ((0°, 0°) → (180°, -90°))",
        "  origin / xyz[1] 0.1 → 0.2 m (+100 %)",
    ]


def test_vectors_of_shapes_of_one_element_stay_apart() -> None:
    found = lines(change("link a / visual 1 / size[0]", 1, 2, "m"), change("link a / visual 2 / size[0]", 1, 2, "m"))
    assert [line.split(" / ")[0] for line in found] == ["link a", "  visual 1", "  visual 2"]


def test_noise_is_counted() -> None:
    noise = [change(f"link a / inertia / {name}", 1.0, 1.0000001, "kg·m²") for name in ("ixx", "iyy")]
    zero = change("link a / origin / xyz[0]", 1e-17, -3e-17, "m")
    mass = change("link a / mass", 1.0, 2.0, "kg")
    assert lines(*noise, zero, mass) == ["link a", "  mass 1 → 2 kg (+100 %)", "  rounding 3 changes"]
    assert lines(*noise, zero, everything=True) == [
        "link a",
        "  inertia / ixx 1.0 → 1.0000001 kg·m² (rounding)",
        "  inertia / iyy 1.0 → 1.0000001 kg·m² (rounding)",
        "  origin / xyz[0] 1e-17 → -3e-17 m",
    ]


def test_a_tiny_capacity_is_no_rounding() -> None:
    assert lines(change("C1 / farad", 1e-12, 2e-12, "F"))[1] == "  farad 1e-12 → 2e-12 F (+100 %)"


def test_what_comes_and_goes_is_told_apart() -> None:
    structural = ChangeClass.STRUCTURAL
    joint = {"type": "fixed", "parent": "a", "child": "b", "axis": [1, 0, 0], "origin": {"xyz": [0, 0, 0]}}
    limit = {"lower": -1.0, "upper": 1.5}
    found = lines(
        change("joint new", None, joint, reach=structural, kind=ChangeKind.ADDED),
        change("joint old", joint, None, reach=structural, kind=ChangeKind.REMOVED),
        change("joint elbow / limit", None, limit, kind=ChangeKind.ADDED),
        change("joint wrist / limit", limit, None, kind=ChangeKind.REMOVED),
        change("link left", "left", "port", reach=structural, kind=ChangeKind.RENAMED),
    )
    assert found == [
        "joint new",
        "  added: type fixed, parent a, child b",
        "joint old",
        "  removed",
        "joint elbow",
        "  limit added: lower -1, upper 1.5",
        "joint wrist",
        "  limit removed: lower -1, upper 1.5",
        "link left",
        "  renamed to port",
    ]


def test_elements_with_the_same_rows_share_an_entry() -> None:
    found = lines(*(change(f"joint {name} / effort", 50.0, 17.0, "N·m") for name in "abc"))
    assert found == ["joint a, b, c", "  effort 50 → 17 N·m (-66 %)"]
    mixed = lines(*(change(f"{name} / ohm", 50.0, 17.0) for name in ("R1", "R2")))
    assert mixed[0] == "R1, R2"


def test_long_lists_of_names_are_cut() -> None:
    found = lines(*(change(f"joint a_rather_long_name_{k} / effort", 50.0, 17.0) for k in range(30)))
    assert found[0].startswith("joint a_rather_long_name_0, a_rather_long_name_1, ")
    assert found[0].endswith(" and 24 more")


def test_what_is_not_modelled_is_counted_and_does_not_crowd_out_the_rest() -> None:
    unmodelled = ChangeClass.UNMODELLED
    many = [change(f"robot / transmission {k}", "x", None, reach=unmodelled, kind=ChangeKind.REMOVED) for k in range(9)]
    name = change("robot / name", "a", "b")
    assert lines(*many, name) == ["robot", "  name a → b", "  not modelled 9 changes"]
    assert lines(many[0], everything=True) == ["robot", "  transmission 0 removed: x (not modelled)"]


def test_effects() -> None:
    found = effect_rows(
        [
            Effect(("robot", "mass"), 12.5, 12.75, "kg"),
            Effect(("robot", "centre of mass"), (0.1, 0.0, 0.2), (0.1, 0.0, 0.25), "m"),
            Effect(("joint wrist", "connector"), "axis[4]", "axis[5]"),
            Effect(("joint wrist", "gravity torque"), 4.0, 5.0, "N·m", limit=80.0),
        ]
    )
    assert list(map(str, found)) == [
        "robot mass 12.5 → 12.75 kg (+2 %)",
        "robot centre of mass (0.1, 0, 0.2) → (0.1, 0, 0.25) m (by 0.05 m)",
        "joint wrist connector axis[4] → axis[5]",
        "joint wrist gravity torque 4 → 5/80 N·m (+25 %)",
    ]


def test_numbers_of_a_model() -> None:
    table = number_table(
        [
            Effect(("robot", "mass"), 12.5, 12.5, "kg"),
            Effect(("joint wrist", "connector"), "axis[4]", "axis[5]"),
            Effect(("joint wrist", "gravity torque"), 4.0, 5.0, "N·m", limit=80.0),
            Effect(("robot", "reach"), 1.0, None, "m"),
        ]
    )
    assert table.rows == [
        ("robot mass", "", "12.5 kg", ""),
        ("joint wrist gravity torque", "4 N·m", "5 N·m", "80 N·m"),
    ]


def test_effects_that_are_none() -> None:
    centre = ("robot", "centre of mass")
    assert effect_rows([Effect(centre, (0.1, 0.2), (0.1, 0.2 + 1e-16), "m"), Effect(("mass",), 1.0, 1.0)]) == []
    (gone,) = effect_rows([Effect(centre, (0.1, 0.2), None, "m")])
    assert str(gone) == "robot centre of mass was (0.1, 0.2) m"
    (come,) = effect_rows([Effect(centre, None, (0.1, 0.2), "m")])
    assert str(come) == "robot centre of mass now (0.1, 0.2) m"


# --- values in few characters -------------------------------------------------------------------------------------

NUMBERS = st.floats(-1e6, 1e6)


def row(old: Any, new: Any, kind: ChangeKind = ChangeKind.CHANGED, *, everything: bool = False) -> str:
    """The only row of one change, without its place."""
    ((_, (found,)),) = outline(Changes((change("a / b", old, new, kind=kind),)), everything=everything)
    return str(found).removeprefix("b ")


@pytest.mark.parametrize(
    ("old", "new", "shown"),
    [
        (1.0, 1.5, "1 → 1.5"),
        (1.2345678, 2.3456789, "1.23457 → 2.34568"),
        (1.2345678, 1.2345699, "1.2345678 → 1.2345699"),
        (1e-5, 2e-5, "1e-05 → 2e-05"),
        (0.00123456789, 0.00234567891, "0.00123457 → 0.00234568"),
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
    assert row(old, new).partition(" (")[0] == shown


def test_everything_is_everything() -> None:
    assert row(0.1 + 0.2, 1e-17, everything=True) == "0.30000000000000004 → 1e-17 (-100 %)"
    assert row("x" * 99, "", everything=True) == f'{"x" * 99} → ""'


@given(NUMBERS, NUMBERS)
@example(0.0, 5e-324)
def test_numbers_that_differ_look_different(old: float, new: float) -> None:
    assume(abs(new - old) > 1e-6 * max(abs(old), abs(new)))
    texts = row(old, new).partition(" (")[0].split(" → ")
    assert texts[0] != texts[1]
    for text, value in zip(texts, (old, new), strict=True):
        assert float(text) == pytest.approx(value, rel=1e-5)


@pytest.mark.parametrize(
    ("old", "new", "shown"),
    [
        (2, 1, "-50 %"),
        (54.0, 60.0, "+11.1 %"),
        (52.345, 52.695, "+0.669 %"),
        (1.2345678, 1.2345999, "+0.0026 %"),
        (1.0, 1.000002, "+0.0002 %"),
        (100.0, 700.0, "+600 %"),
        (1.0, 100.0, "× 100"),
        (-2.0, -1.0, "-50 %"),
        (-0.2, -200.0, "× 1e+03"),
        (0.5, 0.0, "-100 %"),
        (1.0, -1.0, ""),
        (0.0, 0.5, ""),
        (None, 0.5, ""),
        (True, 2, ""),
    ],
)
def test_percent(old: Any, new: Any, shown: str) -> None:
    assert row(old, new).partition(" (")[2].removesuffix(")") == shown


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (None, "added"),
        (1.5, "added: 1.5"),
        ([1, 0.5, 1 / 3], "added: (1, 0.5, 0.333333)"),
        ([{"a": 1}], "added"),
        ("<gazebo reference='a'/>", "added"),
        ("package://arm/tip.stl", "added: package://arm/tip.stl"),
        ({"lower": -1, "upper": 1.5, "name": ""}, "added: lower -1, upper 1.5"),
        ({"name": "a", "geometry": {"kind": "box", "size": [1, 2, 3]}}, "added: name a, geometry kind box"),
        ({"gazebo": "<gazebo>" * 9}, "added"),
    ],
)
def test_what_comes(value: Any, shown: str) -> None:
    assert row(None, value, ChangeKind.ADDED) == shown


def test_a_number_that_comes_or_goes_has_its_unit() -> None:
    spring = "joint elbow / dynamics / spring_stiffness"
    found = lines(change(spring, None, 30.0, "N·m/rad", kind=ChangeKind.ADDED))
    assert found[1] == "  dynamics / spring_stiffness added: 30 N·m/rad"
    assert lines(change(spring, 30.0, None, "N·m/rad", kind=ChangeKind.REMOVED))[1].endswith("removed: 30 N·m/rad")

"""Changes in few words: numbers, vectors, noise, what comes and goes, and what many elements share."""

from __future__ import annotations

import math
from typing import Any

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from urdfsync.diff.changes import Change, Changes
from urdfsync.domain import ChangeClass, ChangeKind, Effect
from urdfsync.output.outline import LONG, OutlineEntry, OutlineRow, effect_rows, outline
from urdfsync.output.phrases import change_lines


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
    return [
        line
        for entry in outline(Changes(found), everything=everything).entries
        for line in (entry.title, *(f"  {' '.join(words(row))}" for row in entry.rows))
    ]


def words(row: OutlineRow) -> list[str]:
    value = f"{row.old} → {row.new}" if row.old else row.new
    return [part for part in (row.label, value, row.relation) if part]


ADDED, REMOVED, CHANGED, RENAMED = list(ChangeKind)
UNMODELLED, STRUCTURAL = ChangeClass.UNMODELLED, ChangeClass.STRUCTURAL
JOINT = {"type": "fixed", "parent": "a", "child": "b", "axis": [1, 0, 0], "origin": {"xyz": [0, 0, 0]}}
LIMIT = {"lower": -1.0, "upper": 1.5}
TINY = [change(f"link a / inertia / {name}", 1.0, 1.0000001, "kg·m²") for name in ("ixx", "iyy")]
TINY.append(change("link a / origin / xyz[0]", 1e-17, -3e-17, "m"))
OUTLINES: dict[str, tuple[list[Change], list[str]]] = {
    "a number has its unit and its percentage": (
        [change("joint elbow / limit / effort", 54.0, 60.0, "N·m")],
        ["joint elbow", "  limit / effort 54 → 60 N·m +11.1 %"],
    ),
    "angles are also in degrees": (
        [change("joint elbow / limit / upper", 0.0, math.pi / 2, "rad")],
        ["joint elbow", "  limit / upper 0 → 1.571 rad 0° → 90°"],
    ),
    "components of a vector are one row": (
        [
            change("joint a / origin / rpy[0]", 0.0, math.pi, "rad"),
            change("joint a / origin / rpy[2]", 0.0, -math.pi / 2, "rad"),
            change("joint a / origin / xyz[1]", 0.1, 0.2, "m"),
        ],
        [
            "joint a",
            "  origin / rpy[0, 2] (0, 0) → (3.142, -1.571) rad (0°, 0°) → (180°, -90°)",
            "  origin / xyz[1] 0.1 → 0.2 m +100 %",
        ],
    ),
    "vectors of shapes of one element stay apart": (
        [change(f"link a / visual {number} / size[0]", 1, 2, "m") for number in (1, 2)],
        ["link a", "  visual 1 / size[0] 1 → 2 m +100 %", "  visual 2 / size[0] 1 → 2 m +100 %"],
    ),
    "noise is counted": (
        [*TINY, change("link a / mass", 1.0, 2.0, "kg")],
        ["link a", "  mass 1 → 2 kg +100 %", "  rounding 3 numbers"],
    ),
    "a tiny capacity is no rounding": (
        [change("C1 / farad", 1e-12, 2e-12, "F")],
        ["C1", "  farad 1e-12 → 2e-12 F +100 %"],
    ),
    "what comes and goes is told apart": (
        [
            change("joint new", None, JOINT, reach=STRUCTURAL, kind=ADDED),
            change("joint old", JOINT, None, reach=STRUCTURAL, kind=REMOVED),
            change("joint elbow / limit", None, LIMIT, kind=ADDED),
            change("joint wrist / limit", LIMIT, None, kind=REMOVED),
            change("link left", "left", "port", reach=STRUCTURAL, kind=RENAMED),
        ],
        [
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
        ],
    ),
    "elements with the same rows share an entry": (
        [change(f"{name} / effort", 50.0, 17.0, "N·m") for name in ("joint a", "joint b", "joint c")],
        ["joint a, b, c", "  effort 50 → 17 N·m -66 %"],
    ),
    "also those without a kind": (
        [change(f"{name} / ohm", 50.0, 17.0) for name in ("R1", "R2")],
        ["R1, R2", "  ohm 50 → 17 -66 %"],
    ),
    "things that are counted share a row": (
        [change(f"link a / visual {k}", {"name": "x"}, None, kind=REMOVED) for k in (2, 3, 5)],
        ["link a", "  visual 2, 3, 5 removed: name x"],
    ),
    "what is not modelled is marked": (
        [change("robot / gazebo", None, "<gazebo>" * 9, reach=UNMODELLED, kind=ADDED)],
        ["robot", "  gazebo added not modelled"],
    ),
    "and does not crowd out the rest": (
        [
            *(change(f"robot / transmission {k}", "x", None, reach=UNMODELLED, kind=REMOVED) for k in range(9)),
            change("robot / name", "a", "b"),
        ],
        ["robot", "  name a → b", "  not modelled 9 removed"],
    ),
    "elements with nothing that matters come last and together": (
        [change(f"link {name} / mass", 1.0, 1.0000001 if name < "c" else 2.0, "kg") for name in "abc"],
        ["link c", "  mass 1 → 2 kg +100 %", "link a, b", "  rounding"],
    ),
}


@pytest.mark.parametrize(("found", "expected"), OUTLINES.values(), ids=OUTLINES)
def test_outlines(found: list[Change], expected: list[str]) -> None:
    assert lines(*found) == expected


def test_all_digits_and_noise_are_shown_on_request() -> None:
    assert lines(*TINY, everything=True) == [
        "link a",
        "  inertia / ixx 1.0 → 1.0000001 kg·m² rounding",
        "  inertia / iyy 1.0 → 1.0000001 kg·m² rounding",
        "  origin / xyz[0] 1e-17 → -3e-17 m",
    ]


def test_a_change_is_one_line_of_a_build() -> None:
    found = Changes(
        (
            change("link a", "a", "b: c", kind=ChangeKind.RENAMED, reach=ChangeClass.STRUCTURAL),
            change("link a / visual 1", None, {"name": "x"}, kind=ChangeKind.ADDED),
            change("robot / gazebo", "x", "y", reach=ChangeClass.UNMODELLED),
            change("joint a / limit / effort", 54.0, 60.0, "N·m"),
        )
    )
    assert change_lines(found) == [
        "link a: renamed to b: c",
        "link a / visual 1: added",
        "robot / gazebo: x → y (not modelled)",
        "joint a / limit / effort: 54 → 60 N·m (+11.1 %)",
    ]


def test_long_lists_of_names_are_cut() -> None:
    names = [f"a_rather_long_name_{k}" for k in range(30)]
    title = OutlineEntry(tuple(f"joint {name}" for name in names), ()).title
    assert title.startswith("joint a_rather_long_name_0, a_rather_long_name_1, ")
    assert title.endswith(" and 24 more")


def test_a_long_outline_is_condensed_to_a_row_per_element() -> None:
    numbers = [change(f"link {k} / visual {v} / mass", k + 1.0, k + 2.0 + v) for k in range(LONG) for v in (1, 2)]
    noise = change("link 0 / inertia", 1.0, 1.0000001)
    kind = change("link 0 / type", "a", "b", reach=ChangeClass.STRUCTURAL)
    found = outline(Changes((*numbers, noise, kind)))
    assert found.condensed
    assert found.entries[0].title == "link 0"
    assert found.entries[0].rows == (
        OutlineRow("", new="2 in visual; 1 by rounding"),
        OutlineRow("type", ChangeKind.CHANGED, "a", "b"),
    )
    assert len(found.entries) == 2, "all others have the same row"
    everything = outline(Changes((*numbers, noise, kind)), everything=True)
    assert sum(len(entry.rows) for entry in everything.entries) == len(numbers) + 2


def test_effects() -> None:
    found = effect_rows(
        [
            Effect(("robot", "mass"), 12.5, 12.75, "kg"),
            Effect(("robot", "centre of mass"), (0.1, 0.0, 0.2), (0.1, 0.0, 0.25), "m"),
            Effect(("joint wrist", "connector"), "axis[4]", "axis[5]"),
        ]
    )
    assert [" ".join(words(row)) for row in found] == [
        "robot mass 12.5 → 12.75 kg +2 %",
        "robot centre of mass (0.1, 0, 0.2) → (0.1, 0, 0.25) m by 0.05 m",
        "joint wrist connector axis[4] → axis[5]",
    ]


def test_effects_that_are_none() -> None:
    centre = ("robot", "centre of mass")
    assert effect_rows([Effect(centre, (0.1, 0.2), (0.1, 0.2 + 1e-16), "m"), Effect(("mass",), 1.0, 1.0)]) == []
    (gone,) = effect_rows([Effect(centre, (0.1, 0.2), None, "m")])
    assert words(gone) == ["robot centre of mass", "was (0.1, 0.2) m"]
    (come,) = effect_rows([Effect(centre, None, (0.1, 0.2), "m")])
    assert words(come) == ["robot centre of mass", "now (0.1, 0.2) m"]


# --- values in few characters -------------------------------------------------------------------------------------

NUMBERS = st.floats(-1e6, 1e6)


def row(old: Any, new: Any, kind: ChangeKind = ChangeKind.CHANGED, *, everything: bool = False) -> OutlineRow:
    """The only row of one change."""
    (entry,) = outline(Changes((change("a / b", old, new, kind=kind),)), everything=everything).entries
    return entry.rows[0]


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
    found = row(old, new)
    assert f"{found.old} → {found.new}" == shown


def test_everything_is_everything() -> None:
    found = row(0.1 + 0.2, 1e-17, everything=True)
    assert (found.old, found.new) == ("0.30000000000000004", "1e-17")
    found = row("x" * 99, "", everything=True)
    assert (found.old, found.new) == ("x" * 99, '""')


@given(NUMBERS, NUMBERS)
@example(0.0, 5e-324)
def test_numbers_that_differ_look_different(old: float, new: float) -> None:
    assume(abs(new - old) > 1e-6 * max(abs(old), abs(new)))
    found = row(old, new)
    assert found.old != found.new
    for text, value in ((found.old, old), (found.new, new)):
        assert float(text) == pytest.approx(value, abs=0.01 * abs(new - old), rel=1e-9)
        assert len(text) <= 17


@given(st.lists(st.tuples(NUMBERS, NUMBERS), min_size=1, max_size=4))
def test_vectors_that_differ_look_different(pairs: list[tuple[float, float]]) -> None:
    old, new = zip(*pairs, strict=True)
    assume(max(abs(b - a) for a, b in pairs) > 1e-6 * max(map(abs, (*old, *new))))
    (found,) = effect_rows([Effect(("a",), old, new)])
    assert found.old != found.new


@pytest.mark.parametrize(
    ("old", "new", "shown"),
    [
        (2, 1, "-50 %"),
        (54.0, 60.0, "+11.1 %"),
        (52.345, 52.695, "+0.669 %"),
        (1.2345678, 1.2345999, "+0.0026 %"),
        (1.0, 1.000002, "< 0.001 %"),
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
    assert row(old, new).relation == shown


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
    assert row(None, value, ChangeKind.ADDED).new == shown

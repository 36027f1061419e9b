"""Changes in few words: numbers, vectors, noise, what comes and goes, and what many elements share."""

from __future__ import annotations

import math
from typing import Any

from urdfsync.changes import Change, Changes
from urdfsync.comparing.outline import LONG, Entry, Row, Tone, effects, outline
from urdfsync.difference import ChangeClass, Effect, Kind


def change(
    path: str,
    old: Any,
    new: Any,
    unit: str = "",
    reach: ChangeClass = ChangeClass.PARAMETER,
    kind: Kind = Kind.CHANGED,
) -> Change:
    return Change(tuple(path.split(" / ")), kind, reach, old, new, unit)


def lines(*found: Change, everything: bool = False) -> list[str]:
    """The outline as plain lines: elements, and below them their rows."""
    return [
        line
        for entry in outline(Changes(found), everything=everything).entries
        for line in (entry.title, *(f"  {' '.join(words(row))}" for row in entry.rows))
    ]


def words(row: Row) -> list[str]:
    value = f"{row.old} → {row.new}" if row.old else row.new
    return [part for part in (row.label, value, row.relation) if part]


def test_a_number_has_its_unit_and_its_percentage() -> None:
    found = lines(change("joint elbow / limit / effort", 54.0, 60.0, "N·m"))
    assert found == ["joint elbow", "  limit / effort 54 → 60 N·m +11.1 %"]


def test_angles_are_also_in_degrees() -> None:
    found = lines(change("joint elbow / limit / upper", 0.0, math.pi / 2, "rad"))
    assert found[1] == "  limit / upper 0 → 1.571 rad 0° → 90°"


def test_components_of_a_vector_are_one_row() -> None:
    found = lines(
        change("joint a / origin / rpy[0]", 0.0, math.pi, "rad"),
        change("joint a / origin / rpy[2]", 0.0, -math.pi / 2, "rad"),
        change("joint a / origin / xyz[1]", 0.1, 0.2, "m"),
    )
    assert found == [
        "joint a",
        "  origin / rpy[0, 2] (0, 0) → (3.142, -1.571) rad (0°, 0°) → (180°, -90°)",
        "  origin / xyz[1] 0.1 → 0.2 m +100 %",
    ]


def test_vectors_of_shapes_of_one_element_stay_apart() -> None:
    found = lines(change("link a / visual 1 / size[0]", 1, 2, "m"), change("link a / visual 2 / size[0]", 1, 2, "m"))
    assert [line.split(" / ")[0] for line in found] == ["link a", "  visual 1", "  visual 2"]


def test_noise_is_counted() -> None:
    noise = [change(f"link a / inertia / {name}", 1.0, 1.0000001, "kg·m²") for name in ("ixx", "iyy")]
    zero = change("link a / origin / xyz[0]", 1e-17, -3e-17, "m")
    mass = change("link a / mass", 1.0, 2.0, "kg")
    assert lines(*noise, zero, mass) == ["link a", "  mass 1 → 2 kg +100 %", "  rounding 3 numbers"]
    assert lines(*noise, zero, everything=True) == [
        "link a",
        "  inertia / ixx 1.0 → 1.0000001 kg·m² rounding",
        "  inertia / iyy 1.0 → 1.0000001 kg·m² rounding",
        "  origin / xyz[0] 1e-17 → -3e-17 m",
    ]


def test_a_tiny_capacity_is_no_rounding() -> None:
    assert lines(change("C1 / farad", 1e-12, 2e-12, "F"))[1] == "  farad 1e-12 → 2e-12 F +100 %"


def test_what_comes_and_goes_is_told_apart() -> None:
    structural = ChangeClass.STRUCTURAL
    joint = {"type": "fixed", "parent": "a", "child": "b", "axis": [1, 0, 0], "origin": {"xyz": [0, 0, 0]}}
    limit = {"lower": -1.0, "upper": 1.5}
    found = lines(
        change("joint new", None, joint, reach=structural, kind=Kind.ADDED),
        change("joint old", joint, None, reach=structural, kind=Kind.REMOVED),
        change("joint elbow / limit", None, limit, kind=Kind.ADDED),
        change("joint wrist / limit", limit, None, kind=Kind.REMOVED),
        change("link left", "left", "port", reach=structural, kind=Kind.RENAMED),
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
    assert found == ["joint a, b, c", "  effort 50 → 17 N·m -66 %"]
    mixed = lines(*(change(f"{name} / ohm", 50.0, 17.0) for name in ("R1", "R2")))
    assert mixed[0] == "R1, R2"


def test_things_that_are_counted_share_a_row() -> None:
    removed = [change(f"link a / visual {k}", {"name": "x"}, None, kind=Kind.REMOVED) for k in (2, 3, 5)]
    assert lines(*removed) == ["link a", "  visual 2, 3, 5 removed: name x"]


def test_long_lists_of_names_are_cut() -> None:
    names = [f"a_rather_long_name_{k}" for k in range(30)]
    title = Entry(tuple(f"joint {name}" for name in names), ()).title
    assert title.startswith("joint a_rather_long_name_0, a_rather_long_name_1, ")
    assert title.endswith(" and 24 more")


def test_what_is_not_modelled_is_marked_and_does_not_crowd_out_the_rest() -> None:
    unmodelled = ChangeClass.UNMODELLED
    few = [change("robot / gazebo", None, "<gazebo>" * 9, reach=unmodelled, kind=Kind.ADDED)]
    assert lines(*few) == ["robot", "  gazebo added not modelled"]
    many = [change(f"robot / transmission {k}", "x", None, reach=unmodelled, kind=Kind.REMOVED) for k in range(9)]
    name = change("robot / name", "a", "b")
    assert lines(*many, name) == ["robot", "  name a → b", "  not modelled 9 removed"]


def test_elements_with_nothing_that_matters_come_last_and_together() -> None:
    noise = [change(f"link {name} / mass", 1.0, 1.0000001, "kg") for name in "ab"]
    mass = change("link c / mass", 1.0, 2.0, "kg")
    assert lines(*noise, mass) == ["link c", "  mass 1 → 2 kg +100 %", "link a, b", "  rounding"]


def test_a_long_outline_is_condensed_to_a_row_per_element() -> None:
    numbers = [change(f"link {k} / visual {v} / mass", k + 1.0, k + 2.0 + v) for k in range(LONG) for v in (1, 2)]
    noise = change("link 0 / inertia", 1.0, 1.0000001)
    kind = change("link 0 / type", "a", "b", reach=ChangeClass.STRUCTURAL)
    found = outline(Changes((*numbers, noise, kind)))
    assert found.condensed
    assert found.entries[0].title == "link 0"
    assert found.entries[0].rows == (
        Row("", Tone.CHANGED, new="2 in visual; 1 by rounding"),
        Row("type", Tone.CHANGED, "a", "b"),
    )
    assert len(found.entries) == 2, "all others have the same row"
    everything = outline(Changes((*numbers, noise, kind)), everything=True)
    assert sum(len(entry.rows) for entry in everything.entries) == len(numbers) + 2


def test_effects() -> None:
    found = effects(
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
    assert effects([Effect(centre, (0.1, 0.2), (0.1, 0.2 + 1e-16), "m"), Effect(("mass",), 1.0, 1.0)]) == []
    (gone,) = effects([Effect(centre, (0.1, 0.2), None, "m")])
    assert words(gone) == ["robot centre of mass", "was (0.1, 0.2) m"]
    (come,) = effects([Effect(centre, None, (0.1, 0.2), "m")])
    assert words(come) == ["robot centre of mass", "now (0.1, 0.2) m"]

"""Modifiers read from the text of a record, whole or half-written."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.urdf.modifiers import Value, clauses

RECORD = """\
within Arm.Links;

record TipParameters "Numbers of link \\"tip\\""
  extends UrdfSync.Records.Link(
    name = "tip",
    inertial(
      origin(xyz = {0.5, 0,
        -2e-3}),
      mass = 4.20 /* with screws */));

  UrdfSync.Records.Box visual1(
    size = {1, 2, 3})
    "Visual 1";

  UrdfSync.Records.Link bare
    "Nothing is known of it";

  annotation (Documentation(info="<html>of extends Link(mass = 7)</html>"));
end TipParameters;
"""


def values(modifiers: str) -> dict[str, str]:
    """What a component with these modifiers gives, as it is written."""
    (found,) = clauses(f"Box b({modifiers});")
    return {name: value.text for name, value in found.values.items()}


def value(text: str) -> Value:
    (found,) = clauses(f"Box b(x = {text});")
    return found.values["x"]


def test_a_record_is_an_extends_clause_and_components() -> None:
    link, box, bare = clauses(RECORD)
    assert (link.name, link.line) == ("", 4)
    assert {name: (value.text, value.line) for name, value in link.values.items()} == {
        "name": ('"tip"', 5),
        "inertial.origin.xyz": ("{0.5, 0, -2e-3}", 7),
        "inertial.mass": ("4.20", 9),
    }
    assert (box.name, [*box.values]) == ("visual1", ["size"])
    assert (bare.name, bare.line, bare.values) == ("bare", 15, {})


@pytest.mark.parametrize(
    ("modifiers", "expected"),
    [
        ("final m = 1, each n(final p = 2)", {"m": "1", "n.p": "2"}),
        ("inertial.mass = 3", {"inertial.mass": "3"}),
        ("redeclare Big box(m = 1) = 3, n = 2", {"n": "2"}),
        ("m = 2*(1 + 3), n = f(1, {2, 3}, x = 4)", {"m": "2*(1 + 3)", "n": "f(1, {2, 3}, x = 4)"}),
        ('m = 1 "heavy", n = "a" + "b"', {"m": "1", "n": '"a" + "b"'}),
        ("m = 1 // heavy\n, n = 2", {"m": "1", "n": "2"}),
        ("m = limit.up[1], 'odd name' = 2", {"m": "limit.up[1]", "'odd name'": "2"}),
        ("m(unit = 1) = 2", {"m.unit": "1", "m": "2"}),
    ],
)
def test_modifiers_as_people_write_them(modifiers: str, expected: dict[str, str]) -> None:
    assert values(modifiers) == expected


def test_a_component_may_be_given_as_a_whole() -> None:
    (found,) = clauses("final parameter Links.Box b = Links.big;")
    assert (found.name, {name: value.text for name, value in found.values.items()}) == ("b", {"": "Links.big"})


@pytest.mark.parametrize(("one", "other"), [("1", "1.0"), ("-0.5", "- 5e-1"), ("{1, 2}", "{ 1,2 }"), ("a+b", "a + b")])
def test_equal_values_have_equal_keys(one: str, other: str) -> None:
    assert value(one).key == value(other).key


@pytest.mark.parametrize(("one", "other"), [("1", "1.0000001"), ("inf", "nan"), ('"1"', "1"), ("{1, 2}", "{2, 1}")])
def test_other_values_have_other_keys(one: str, other: str) -> None:
    assert value(one).key != value(other).key


def test_arrays_have_elements() -> None:
    assert [item.text for item in value("{1, -2, pi/2}").items or ()] == ["1", "-2", "pi/2"]
    assert [item.text for item in value("{{1, 2}, {3, 4}}").items or ()] == ["{1, 2}", "{3, 4}"]
    assert [value(text).items for text in ("{1} + {2}", "[1, 2]", "fill(0, 3)", "{1,}")] == [None] * 4


@given(st.integers(0, len(RECORD)), st.text('(){}[];,="ax1. \n', max_size=8))
def test_a_text_that_somebody_is_editing_is_read_as_far_as_it_goes(place: int, typed: str) -> None:
    for found in clauses(RECORD[:place] + typed):
        assert all(
            1 <= value.line <= RECORD.count("\n", 0, place) + typed.count("\n") + 1 for value in found.values.values()
        )
    assert [clause.name for clause in clauses(RECORD + typed)][:3] == ["", "visual1", "bare"]

"""What somebody edited, thing by thing."""

from __future__ import annotations

import pytest

from urdfsync.merge.edits import find_edits, in_words

BASE = """\
model Arm
  function f
    input Real x;
    input Real y;
  end f;
  Body b(inertial(mass = 2)) "A body"
    annotation (Placement(transformation(extent={{0, 0}, {20, 20}})));
  Real w[2] = {b.m, c.m};
  Real m = b.m + c.m;
equation
  connect(frame_a, b.frame_a);
end Arm;
"""
EDITS = {
    "nothing": (("Real m", "Real  m"), []),
    "a modifier": (("mass = 2", "mass = 2.5"), [("component `b`", "inertial.mass 2 → 2.5")]),
    "a modifier more": (("mass = 2)", "mass = 2, x = 1)"), [("component `b`", "inertial.x added")]),
    "a modifier less": (("inertial(mass = 2)", "inertial"), [("component `b`", "inertial modifiers removed")]),
    "no annotation": (
        ("\n    annotation (Placement(transformation(extent={{0, 0}, {20, 20}})))", ""),
        [("component `b`", "annotation removed")],
    ),
    "a type": (("Body b", "Ball b"), [("component `b`", "type Body → Ball")]),
    "a term": (("b.m + c.m", "b.m + d.m + c.m"), [("component `m`", "d.m added")]),
    "a place": (("{20, 20}", "{30, 30}"), [("layout", "1 element placed or drawn differently")]),
    "a connection": (("connect(frame_a", "connect(frame_b"), [
        ("`connect(b.frame_a, frame_b)`", "added"), ("`connect(b.frame_a, frame_a)`", "removed"),
    ]),
    "an element": (("equation", "  Real x;\nequation"), [("component `x`", "added")]),
    "an initial equation": (("equation", 'initial equation\n  assert(true, "a ( b");\nequation'), [
        ('initial equation `assert(true, "a ( b")`', "added"),
    ]),
    "a sign of zero": (("{{0, 0}, {20, 20}}", "{{-0.0, +0}, {20, 20}}"), []),
    "a difference": (("mass = 2", "mass = 2 - 0"), [("component `b`", "inertial.mass 2 → 2 - 0")]),
    "a comment": (("equation", "equation // mine"), [("comments", "changed")]),
    "a value": (("m = b.m + c.m", "m = 1"), [("component `m`", "m b.m + c.m → 1")]),
    "an order of items": (("{b.m, c.m}", "{c.m, b.m}"), [("component `w`", "w {b.m, c.m} → {c.m, b.m}")]),
    "an order of inputs": (("x;\n    input Real y", "y;\n    input Real x"), [
        ("class `f`", "order of inputs and outputs changed"),
    ]),
    "an order of declarations, which means nothing": (
        ("  Real w[2] = {b.m, c.m};\n  Real m = b.m + c.m;", "  Real m = b.m + c.m;\n  Real w[2] = {b.m, c.m};"), [],
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", EDITS)
def test_edits(name: str) -> None:
    (old, new), expected = EDITS[name]
    edits = find_edits(BASE, BASE.replace(old, new))
    assert edits is not None
    assert in_words(edits) == expected


def test_what_is_no_class() -> None:
    assert find_edits(BASE, "x") is None


def test_words_for_readers_come_last_and_documentation_is_not_quoted() -> None:
    base = """model A "old"
  parameter Real m = 1 "mass";
  annotation (Documentation(info = "<html>old</html>"));
end A;
"""
    mine = base.replace("old", "new").replace("m = 1", "m = 2")
    edits = find_edits(base, mine)
    assert edits
    assert in_words(edits) == [
        ("component `m`", "m 1 → 2"),
        ("the class", 'description "old" → "new"'),
        ("the Documentation", "info changed"),
    ]

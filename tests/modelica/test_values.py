"""Values of a record by their paths, with their lines, and which expressions are literals."""

from __future__ import annotations

import pytest

from urdfsync.modelica.values import Value, literals, read_values

TEXT = """within A;

record B "Numbers, of (something; else)"
  extends UrdfSync.Records.Link(
    name = "x\\"y", // said = 1
    inertial(
      mass = 3 /* weighed 3 March */,
      origin(xyz = {1, -2, 3e-4})));

  parameter Modelica.Units.SI.Angle corners[2, 3] = {{0, 0, 1},
    {0, 1, 0}}
    "Corners";

protected
  Inner inner(each final a = b + c, f = g(1, 2));

  constant Integer axis = 2
    "Number";

  annotation (Icon(x = 1));
end B;
"""


def test_values_are_found_with_their_lines() -> None:
    assert all(TEXT[value.start :].startswith(value.text) for value in read_values(TEXT))
    assert [value._replace(start=0) for value in read_values(TEXT)] == [
        Value("name", "UrdfSync.Records.Link", '"x\\"y"', 5),
        Value("inertial.mass", "UrdfSync.Records.Link", "3", 7),
        Value("inertial.origin.xyz", "UrdfSync.Records.Link", "{1, -2, 3e-4}", 8),
        Value("corners", "parameterModelica.Units.SI.Angle", "{{0, 0, 1},\n    {0, 1, 0}}", 10),
        Value("inner.a", "Inner", "b + c", 15),
        Value("inner.f", "Inner", "g(1, 2)", 15),
        Value("axis", "constantInteger", "2", 17),
    ]


@pytest.mark.parametrize(("text", "value"), [
    ("-2.5e-3", (-0.0025,)), ("-0", (0.0,)), ("- Modelica.Constants.inf", (-float("inf"),)), ('"a\\nb"', "a\nb"),
    ("[1, 2; 3, 4]", (1.0, 2.0, 3.0, 4.0)), ("fill(0, 0, 3)", ()), ("true", "true"), ("2*x", None), ("x.y", None),
    ("1+1", None), ("{1, 2 - 1}", None), ("{1, - 2 }", (1.0, -2.0)), ("1 2", None),
])  # fmt: skip
def test_literals_are_read_as_values(text: str, value: object) -> None:
    assert literals(text) == value

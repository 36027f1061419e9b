"""The merge of classes: what survives side by side, what is a contradiction, and that comments and blanks stay."""

from __future__ import annotations

import re

import pytest

from urdfsync.merge import Merge, merge

Edit = tuple[str, str]
"""What is there once, and what it is replaced by."""

RECORD = """\
record ForearmParameters "Numbers of link \\"forearm\\""
  extends UrdfSync.Records.Link(
    name = "forearm",
    inertial(
      origin(
        xyz = {0.1118, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1.2,
      inertia(
        ixx = 0.005953,
        iyy = 0.029335,
        izz = 0.030752)));
  parameter Real gain = 1.05
    "Of the drive";
  Real r = min(a, b);
  Real s = sum(2 * a + 2 * a);
  Body body(m = parameters.mass, animation = false) annotation (Placement(transformation(extent={{0, 0}, {20, 20}})));
end ForearmParameters;
"""


def changed(text: str, *edits: Edit) -> str:
    for old, new in edits:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


def merged(base: str, mine: str, generated: str) -> Merge:
    return merge(base, mine, generated, is_modelica=True)


def model(body: str) -> str:
    return f"model A\n{body}end A;\n"


# --- both sides' edits survive --------------------------------------------------------------------------------------

SIDE_BY_SIDE: dict[str, tuple[Edit, Edit]] = {
    "comment at the end of the line, value": (("1.2,", "1.2, // weighed"), ("1.2", "1.25")),
    "comment, item added after it": (("1.2,", "1.2, // kg"), ("      inertia", "      load = 3,\n      inertia")),
    "comment after the last item, item added": (("752)", "752 // rough\n        )"), ("iyy", "ixy = 0,\n        iyy")),
    "comment right after the value": (("gain = 1.05", "gain = 1.05 // tuned"), ("1.05", "1.07")),
    "comment line before the value's": (("      mass", "      // full\n      mass"), ("1.2", "1.25")),
    "values on neighbouring lines": (("ixx = 0.005953", "ixx = 0.006"), ("iyy = 0.029335", "iyy = 0.03")),
    "value, name of another": (("mass = 1.2", "mass = 1.3"), ("inertia(", "tensor(")),
    "prefix, value": (("        ixx", "        final ixx"), ("0.005953", "0.006")),
    "spacing, value": (("ixx = 0.005953", "ixx  =  0.005953"), ("0.005953", "0.006")),
    "last item added": (("752)));", "752,\n        ixy = 1e-6)));"), ("iyy = 0.029335", "iyy = 1")),
    "item added, value before": (("mass, anim", "mass, r = 1, anim"), ("parameters.mass", "5")),
    "item removed, value after": (("m = parameters.mass, ", ""), ("false", "true")),
    "item renamed, value before": (("animation =", "visible ="), ("parameters.mass", "5")),
    "item added, the next one removed": (("mass, a", "mass, r = 1, a"), (", animation = false", "")),
    "item added, the one before removed": (("false)", "false, r = 1)"), (", animation = false", "")),
    "value, the description after it": (("1.05", "1.06"), ('"Of the drive"', '"Of it"')),
    "type, value": (("Body body", "Sphere body"), ("parameters.mass", "5")),
    "description, type of the next": (('"Of the drive";', '"Mine";'), ("Real r", "Length r")),
    "declaration added, the one before": (("  Body", "  Real x;\n  Body"), ('drive"', 'motor"')),
    "head, element": (("record F", "encapsulated record F"), ("1.2", "1.25")),
}  # fmt: skip


@pytest.mark.parametrize(("mine", "generated"), SIDE_BY_SIDE.values(), ids=SIDE_BY_SIDE)
def test_both_survive(mine: Edit, generated: Edit) -> None:
    both = changed(RECORD, mine, generated)
    assert merged(RECORD, changed(RECORD, mine), changed(RECORD, generated)) == Merge(both, both, ())
    assert merged(RECORD, changed(RECORD, generated), changed(RECORD, mine)).text is not None


CONTRADICTIONS: dict[str, tuple[Edit, Edit, str]] = {
    "one number": (
        ("1.05", "2.05"), ("1.05", "1.07"), "component `gain`: you set `gain = 2.05`, the export changes 1.05 to 1.07",
    ),
    "sign, digits": (
        ("= 1.05", "= -1.05"), ("1.05", "1.07"), "you set `gain = -1.05`, the export changes 1.05 to 1.07",
    ),
    "expression, number": (("1.05", "1.05 + offset"), ("1.05", "1.07"), "you set `gain = 1.05 + offset`"),
    "one vector": (
        ("{0.1118, 0, 0}", "{0.2, 0, 0}"), ("{0.1118, 0, 0}", "{0.1118, 0, 0.5}"), "inertial.origin.xyz = {0.2, 0, 0}`",
    ),
    "one dotted name": (
        ("parameters.mass", "data.mass"), ("parameters.mass", "parameters.m"), "you set `m = data.mass`",
    ),
    "one string": (
        ("Of the drive", "Of my drive"), ("the drive", "the motor"), "you changed the description to `\"Of my drive\"`",
    ),
    "two arguments": (("min(a", "min(x"), ("b)", "y)"), "you set `r = min(x, b)`"),
    "one type": (
        ("Body body", "Sphere body"), ("Body body", "Ball body"),
        "you changed the type to `Sphere`, the export to `Ball`",
    ),
    "name and description, its value": (
        ('gain = 1.05\n    "Of the drive"', 'factor = 1.05\n    "Mine"'), ("1.05", "1.07"),
        "component `gain`: you removed it, the export changes it",
    ),
    "item removed, value in it": (
        ("      mass = 1.2,\n", ""), ("1.2", "1.25"), "you removed `inertial.mass`, the export changes it",
    ),
    "value, item removed": (
        ("1.2", "1.25"), ("      mass = 1.2,\n", ""), "you changed `inertial.mass`, the export removes it",
    ),
    "item added by both": (
        ("false)", "false, r = 1)"), ("false)", "false, r = 2)"), "you added `r = 1`, the export `r = 2`",
    ),
    "class": (
        ("record F", "partial record F"), ("record F", "encapsulated record F"),
        "the class: you changed the kind and name to `partial record ForearmParameters`",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("mine", "generated", "what"), CONTRADICTIONS.values(), ids=CONTRADICTIONS)
def test_what_both_changed_is_a_contradiction_with_a_name(mine: Edit, generated: Edit, what: str) -> None:
    result = merged(RECORD, changed(RECORD, mine), changed(RECORD, generated))
    assert result.text is None
    (conflict,) = result.contradictions
    assert what in conflict
    assert merged(RECORD, changed(RECORD, generated), changed(RECORD, mine)).text is None


# --- bodies: base, mine, generated, merged (None for a contradiction) -----------------------------------------------

BODIES = {
    "components at one place, mine first": (
        "  Real x;\n\nequation\n  x = 1;\n",
        "  Real x;\n  Real m;\n\nequation\n  x = 1;\n",
        "  Real x;\n\n  Real g;\n\nequation\n  x = 1;\n",
        "  Real x;\n  Real m;\n\n  Real g;\n\nequation\n  x = 1;\n",
    ),
    "connections after the last one, mine first": (
        "equation\n  connect(a, b);\n",
        "equation\n  connect(a, b);\n  connect(m, n);\n",
        "equation\n  connect(a, b);\n  connect(g, h);\n",
        "equation\n  connect(a, b);\n  connect(m, n);\n  connect(g, h);\n",
    ),
    "a connection turned round": (
        "equation\n  connect(a, b);\n",
        "equation\n  connect(b, a); // mine\n",
        "equation\n  connect(a, b) annotation (Dialog);\n",
        "equation\n  connect(b, a) annotation (Dialog); // mine\n",
    ),
    "both add one thing, one with more": (
        "", "  Real m;\n", '  Real m annotation (Placement(x = 1));\n', "  Real m;\n",
    ),
    "both add one thing, otherwise": ("", "  Real m;\n", "  Body m;\n", None),
    "sections of its own": (
        "  Real x;\nprotected\n  Real p;\n",
        "  Real x;\n  Real m;\nprotected\n  Real p;\n  Real mp;\n",
        "  Real x;\n  Real g;\nprotected\n  Real p;\n  Real gp;\n",
        "  Real x;\n  Real m;\n  Real g;\nprotected\n  Real p;\n  Real mp;\n  Real gp;\n",
    ),
    "a section that mine lacks": (
        "  Real x;\n", "  Real x;\n  Real m;\n", "  Real x;\nequation\n  x = 1;\n",
        "  Real x;\n  Real m;\nequation\n  x = 1;\n",
    ),
    "a section that is empty without the element": (
        "  Real x;\nequation\n  x = 1;\n", "  Real x; // m\nequation\n  x = 1;\n", "  Real x;\n", "  Real x; // m\n",
    ),
    "protected by the export, edited by me": (
        "  Real x;\n  Real y;\n", "  Real x;\n  Real y = 3;\n", "  Real x;\nprotected\n  Real y;\n",
        "  Real x;\nprotected\n  Real y = 3;\n",
    ),
    "protected by me, edited by the export": (
        "  Real x;\n  Real y;\n", "  Real x;\nprotected\n  Real y;\n", "  Real x;\n  Real y = 3;\n",
        "  Real x;\nprotected\n  Real y = 3;\n",
    ),
    "other order of declarations": (
        "  Real a;\n  Real b;\n  Real c;\n", "  Real c;\n  Real b;\n  Real a;\n",
        "  Real a;\n  Real b = 1;\n  Real c;\n",
        "  Real c;\n  Real b = 1;\n  Real a;\n",
    ),
    "another order by the export": (
        "  Real a;\n  Real b;\n", "  Real a;\n  Real b; // m\n", "  Real b;\n  Real a;\n",
        "  Real b; // m\n  Real a;\n",
    ),
    "another order by the export, a component of mine behind one that moves": (
        "  Real a;\n  Real b;\n  Real c;\n", "  Real a;\n  Real m;\n  Real b;\n  Real c;\n",
        "  Real c;\n  Real g;\n  Real a;\n  Real b;\n", "  Real c;\n  Real g;\n  Real a;\n  Real m;\n  Real b;\n",
    ),
    "another order by both, mine where I moved something": (
        "  Real a;\n  Real b;\n  Real c;\n  Real d;\n", "  Real a;\n  Real c;\n  Real d;\n  Real b;\n",
        "  Real d;\n  Real a;\n  Real b;\n  Real c;\n", "  Real d;\n  Real b;\n  Real a;\n  Real c;\n",
    ),
    "removed by me, the same in the export": (
        "  Real a;\n  Real b;\n", "  Real a;\n", "  Real a = 1;\n  Real b;\n", "  Real a = 1;\n",
    ),
    "removed by both": ("  Real a;\n  Real b;\n", "  Real a; // m\n", "  Real a;\n", "  Real a; // m\n"),
    "removed by the export, other layout in mine": (
        "  Real a;\n  B b annotation (Placement(x = 1));\n", "  Real a;\n  B b annotation (Placement(x = 2));\n",
        "  Real a;\n", "  Real a;\n",
    ),
    "one equation for a variable": (
        "equation\n  x = 1;\n", "equation\n  x = 1; // m\n", "equation\n  x = 2;\n", "equation\n  x = 2; // m\n",
    ),
    "a second equation for a variable": (
        "equation\n  x = 1;\n", "equation\n  x = 1;\n  x = m;\n", "equation\n  x = 2;\n",
        "equation\n  x = m;\n  x = 2;\n",
    ),
    "an equation without a variable": (
        "equation\n  a + b = c;\n", "equation\n  a + b = 2*c;\n", "equation\n  a + b = 3*c;\n", None,
    ),
    "an equation that mine lacks": ("equation\n  a + b = c;\n", "", "equation\n  a + b = 3*c;\n", None),
    "a sensor in a connection, a joint in the same": (
        "equation\n  connect(a, b);\n", "equation\n  connect(a, m.a);\n  connect(m.b, b);\n",
        "equation\n  connect(a, g.a);\n  connect(g.b, b);\n", None,
    ),
    "a base class for another": ("  extends B;\n", "  extends M;\n", "  extends G;\n", None),
    "modifiers of a base class, an import": (
        "  import SI = Modelica.SIunits;\n  extends B(x = 1);\n",
        "  import SI = Modelica.SIunits;\n  import Math;\n  extends B(x = 2);\n",
        "  import SI = Modelica.Units.SI;\n  extends B(x = 1, y = 2);\n  extends C;\n",
        "  import SI = Modelica.Units.SI;\n  import Math;\n  extends B(x = 2, y = 2);\n  extends C;\n",
    ),
    "an import for another": ("  import S = A;\n", "  import S = M;\n", "  import S = G;\n", None),
    "if-equations by lines": (
        "equation\n  if a then\n    x = 1;\n  else\n    x = 2;\n  end if;\n",
        "equation\n  if a then\n    x = 1; // m\n    y = 1;\n  else\n    x = 2;\n  end if;\n",
        "equation\n  if a then\n    x = 1;\n  else\n    x = 3;\n  end if;\n",
        "equation\n  if a then\n    x = 1; // m\n    y = 1;\n  else\n    x = 3;\n  end if;\n",
    ),
    "for and when": (
        "equation\n  for i in 1:2 loop\n    x[i] = 1;\n  end for;\n  when a then\n    b = 1;\n  end when;\n",
        "equation\n  for i in 1:2 loop\n    x[i] = 5;\n  end for;\n  when a then\n    b = 1;\n  end when;\n",
        "equation\n  for i in 1:2 loop\n    x[i] = 1;\n  end for;\n  when a then\n    b = 7;\n  end when;\n",
        "equation\n  for i in 1:2 loop\n    x[i] = 5;\n  end for;\n  when a then\n    b = 7;\n  end when;\n",
    ),
    "comments in a block stay at their lines": (
        "equation\n  when a then\n    b = 1;\n    c = 1;\n    d = 1;\n  end when;\n",
        "equation\n  when a then\n    b = 1; // m\n    c = 1;\n    d = 1;\n  end when;\n",
        "equation\n  when a then\n    b = 1;\n    c = 1;\n    d = 2;\n  end when;\n",
        "equation\n  when a then\n    b = 1; // m\n    c = 1;\n    d = 2;\n  end when;\n",
    ),
    "statements by lines": (
        "algorithm\n  x := 1;\n  y := 2;\n  z := 3;\n", "algorithm\n  x := 1;\n  y := 2;\n  z := 4;\n",
        "algorithm\n  x := 7;\n  y := 2;\n  z := 3;\n", "algorithm\n  x := 7;\n  y := 2;\n  z := 4;\n",
    ),
    "one statement": ("algorithm\n  x := 1;\n", "algorithm\n  x := 2;\n", "algorithm\n  x := 3;\n", None),
    "a nested class": (
        "  model N\n    Real x;\n  end N;\n", "  model N\n    Real x;\n    Real m;\n  end N;\n",
        "  model N\n    Real x(start = 1);\n    Real g;\n  end N;\n",
        "  model N\n    Real x(start = 1);\n    Real m;\n    Real g;\n  end N;\n",
    ),
    "a short class": (
        '  type T = Real(min = 0, max = 1) "d";\n', '  type T = Real(min = 0, max = 2) "d";\n',
        '  type T = Length(min = 1, max = 1) "e";\n', '  type T = Length(min = 1, max = 2) "e";\n',
    ),
    "an enumeration": (
        "  type T = enumeration(a, b);\n", "  type T = enumeration(a, b); // m\n", "  type T = enumeration(a, c);\n",
        "  type T = enumeration(a, c); // m\n",
    ),
    "an external function": (
        'external "C" y = f(u) annotation (Library = "m");\n',
        '  input Real m;\nexternal "C" y = f(u) annotation (Library = "m");\n',
        'external "C" y = g(u) annotation (Library = "m");\n',
        '  input Real m;\nexternal "C" y = g(u) annotation (Library = "m");\n',
    ),
    "prefixes, sizes, conditions": (
        "  inner World w;\n  B b if c;\n  P p[2];\n", "  inner outer World w;\n  B b(x = 1) if c;\n  P p[3];\n",
        '  inner World w(g = 1);\n  B b if c and d;\n  P p[2] "d";\n',
        '  inner outer World w(g = 1);\n  B b(x = 1) if c and d;\n  P p[3] "d";\n',
    ),
    "several components in one declaration": (
        "  Real x, y;\n", "  Real x, y, z;\n", "  Real x, y;\n  Real w;\n", "  Real x, y, z;\n  Real w;\n",
    ),
    "redeclarations and constraints": (
        "  replaceable B b(redeclare model X = Y, redeclare Real z(start = 1)) constrainedby C(k = 1);\n",
        "  replaceable B b(redeclare model X = Y, redeclare Real z(start = 2)) constrainedby C(k = 1, m = 2);\n",
        '  replaceable B b(redeclare model X = Z, redeclare Real z(start = 1)) constrainedby C(k = 3) "d";\n',
        '  replaceable B b(redeclare model X = Z, redeclare Real z(start = 2)) constrainedby C(k = 3, m = 2) "d";\n',
    ),
    "one redeclaration": (
        "  B b(redeclare model X = Y);\n", "  B b(redeclare model X = M);\n", "  B b(redeclare model X = G);\n", None,
    ),
    "quoted names": (
        "  Real 'a b'(start = 1);\nequation\n  connect('a b', 'c;d');\n",
        "  Real 'a b'(start = 1) \"d\";\nequation\n  connect('c;d', 'a b');\n",
        "  Real 'a b'(start = 2);\nequation\n  connect('a b', 'c;d');\n  connect('x(', y);\n",
        "  Real 'a b'(start = 2) \"d\";\nequation\n  connect('c;d', 'a b');\n  connect('x(', y);\n",
    ),
    "annotations by key": (
        '  annotation (Dialog(group = "a"), __Dymola_x = 1, Evaluate = true);\n',
        '  annotation (Dialog(group = "a", tab = "m"), __Dymola_x = 1, __Dymola_m = 1);\n',
        '  annotation (Dialog(group = "g"), __Dymola_x = 2, Evaluate = true, __OpenModelica_g = 1);\n',
        '  annotation (Dialog(group = "g", tab = "m"), __Dymola_x = 2, __Dymola_m = 1, __OpenModelica_g = 1);\n',
    ),
    "choices, of which there are several": (
        "  Real x annotation (choices(choice = 1, choice = 2));\n",
        "  Real x annotation (choices(choice = 1, choice = 2), Dialog);\n",
        "  Real x annotation (choices(choice = 1, choice = 3));\n",
        "  Real x annotation (choices(choice = 1, choice = 3), Dialog);\n",
    ),
    "documentation by lines": (
        '  annotation (Documentation(info = "<p>a</p>\n<p>b</p>\n<p>c</p>\n"));\n',
        '  annotation (Documentation(info = "<p>m</p>\n<p>b</p>\n<p>c</p>\n"));\n',
        '  annotation (Documentation(info = "<p>a</p>\n<p>b</p>\n<p>\\"g\\"</p>\n"));\n',
        '  annotation (Documentation(info = "<p>m</p>\n<p>b</p>\n<p>\\"g\\"</p>\n"));\n',
    ),
    "one line of documentation": (
        '  annotation (Documentation(info = "<p>a</p>\n"));\n', '  annotation (Documentation(info = "<p>m</p>\n"));\n',
        '  annotation (Documentation(info = "<p>g</p>\n"));\n', None,
    ),
    "terms of a sum": (
        "  Real m = a.m + b.m;\n", "  Real m = a.m + b.m + mine.m;\n", "  Real m =\n    b.m +\n    c.m;\n",
        "  Real m = b.m + mine.m + c.m;\n",
    ),
    "a sum of one term": (
        "  Real m = a.m;\n", "  Real m = a.m + mine.m;\n", "  Real m = a.m + b.m;\n",
        "  Real m = a.m + mine.m + b.m;\n",
    ),
    "down to one term": (
        "  Real m = a.m + b.m;\n", "  Real m = a.m + b.m + mine.m;\n", "  Real m = a.m;\n",
        "  Real m = a.m + mine.m;\n",
    ),
    "a difference is no list": ("  Real m = a - b;\n", "  Real m = a - b + m;\n", "  Real m = a - b + g;\n", None),
    "arrays of names": (
        "  R r(v = {a.x, b.x});\n", "  R r(v = {a.x, b.x, mine});\n", "  R r(v = {b.x, c.x});\n",
        None,
    ),
    "arrays of names, in different places": (
        "  R r(v = {a.x, b.x});\n", "  R r(v = {a.x, b.x, mine});\n", "  R r(v = {c.x, a.x, b.x});\n",
        "  R r(v = {c.x, a.x, b.x, mine});\n",
    ),
    "an array in another order": (
        "  R r(v = {a.x, b.x, c.x}, w = 1);\n", "  R r(v = {a.x, b.x, c.x}, w = 2);\n",
        "  R r(v = {b.x, c.x, a.x}, w = 1);\n", "  R r(v = {b.x, c.x, a.x}, w = 2);\n",
    ),
    "an array in another order, an item of it": (
        "  R r(v = {a.x, b.x, c.x});\n", "  R r(v = {a.x, 5, c.x});\n", "  R r(v = {b.x, c.x, a.x});\n", None,
    ),
    "an array of which one side moves what the other removes": (
        "  R r(v = {a, b, c, d, e});\n",
        "  R r(v = {b, c, d, a, e});\n",
        "  R r(v = {b, c, d, e});\n",
        None,
    ),
    "an array of which one side removes what the other moves": (
        "  R r(v = {a, b, c, d, e});\n",
        "  R r(v = {b, c, d, e});\n",
        "  R r(v = {b, c, d, a, e});\n",
        None,
    ),
    "an array in which items are alike": (
        "  R r(v = {a.x, a.x, b.x, c.x});\n", "  R r(v = {a.x, m, a.x, b.x, c.x});\n",
        "  R r(v = {a.x, a.x, b.x, c.x, d.x});\n", None,
    ),
    "an array that both add": ("  R r;\n", "  R r(v = {a, b});\n", "  R r(v = {b, c});\n", None),
    "arguments in lines": (
        "  Real r = f(\n    1,\n    0,\n    0,\n    0);\n", "  Real r = f(\n    2,\n    0,\n    0,\n    0);\n",
        "  Real r = f(\n    1,\n    0,\n    0,\n    7,\n    0);\n", None,
    ),
    "a matrix in lines": (
        "  R r(m = [1, 2;\n    2, 3;\n    3, 4]);\n", "  R r(m = [1, 9;\n    2, 3;\n    3, 4]);\n",
        "  R r(m = [1, 2;\n    2, 3;\n    3, 5]);\n", None,
    ),
    "arrays of graphics": (
        "  G g(v = {Line(p = 1), Text(s = 1)});\n", "  G g(v = {Line(p = 1), Text(s = 1), Bitmap(m = 1)});\n",
        "  G g(v = {Line(p = 2), Text(s = 1)});\n", "  G g(v = {Line(p = 2), Text(s = 1), Bitmap(m = 1)});\n",
    ),
    "numbers by value": (
        "  B b(m = 11.5, n = 2);\n", "  B b(m = 1.15e1, n = 3);\n", "  B b(m = 12, n = 2.0);\n",
        "  B b(m = 12, n = 3);\n",
    ),
    "the same number": ("  B b(m = 1);\n", "  B b(m = 2.0);\n", "  B b(m = 2);\n", "  B b(m = 2.0);\n"),
    "a small change by the user beside one of the export": (
        "  B b(m = 11.5, n = 1);\n", "  B b(m = 11.50000001, n = 1);\n", "  B b(m = 11.5, n = 2);\n",
        "  B b(m = 11.50000001, n = 2);\n",
    ),
    "a large Integer that both change by one": (
        "  B b(seed = 3000001);\n", "  B b(seed = 3000002);\n", "  B b(seed = 3000003);\n", None,
    ),
    "protected by the user, removed by the export": (
        "  Real x;\n  Real y;\n", "  Real x;\nprotected\n  Real y;\n", "  Real x;\n", None,
    ),
    "what the user has already": (
        "  B b(m = 1);\n", "  B b(m = 2, x = 3) \"d\"; // m\n", "  B b(x = 3, m = 2.0) \"d\";\n",
        "  B b(x = 3, m = 2) \"d\"; // m\n",
    ),
    "nothing but brackets": ("  B b;\n", "  B b();\n", "  B b(y = 2);\n", "  B b(y = 2);\n"),
    "all modifiers gone": ("  B b(x = 1);\n", '  B b(x = 1) "m";\n', "  B b;\n", '  B b "m";\n'),
    "the last in its row gone": (
        "  B b(x = 1, y = 2);\n", "  B b(x = 3, y = 2);\n", "  B b(x = 1);\n", "  B b(x = 3);\n",
    ),
    "a value that both add": ("  B b;\n", "  B b = 1;\n", "  B b = 2;\n", None),
    "a value and a description": ("  B b;\n", "  B b = 1;\n", '  B b "d";\n', '  B b = 1 "d";\n'),
}  # fmt: skip


@pytest.mark.parametrize(("base", "mine", "generated", "expected"), BODIES.values(), ids=BODIES)
def test_bodies(base: str, mine: str, generated: str, expected: str | None) -> None:
    result = merged(*map(model, (base, mine, generated)))
    assert result.flaw == ""
    assert result.text == (None if expected is None else model(expected)), result.proposal
    assert (merged(*map(model, (base, generated, mine))).text is None) == (expected is None)


def test_rounding_is_what_an_export_does() -> None:
    """The same digits are an edit if the user typed them."""
    base, mine = model("  B b(m = 11.5, v = {1, 2});\n"), model("  B b(m = 99, v = {1, 3});\n")
    rounded = model("  B b(m = 11.50000001, v = {1, 2.0000001});\n")
    assert merged(base, mine, rounded).text == mine
    assert merged(base, rounded, mine).text is None


FUNCTION = """\
model A
  function f
    input Real x;
    input Real y "second";
    output Real z;
  algorithm
    z := x + y;
  end f;
  Real a = 1;
end A;
"""
SIGNATURES: dict[str, tuple[Edit, Edit, bool]] = {
    "another order by mine": (
        ("x;\n    input Real y \"second\";", "y \"second\";\n    input Real x;"), ("a = 1", "a = 2"), True,
    ),
    "another order by the export": (
        ("a = 1", "a = 2"), ("x;\n    input Real y \"second\";", "y \"second\";\n    input Real x;"), True,
    ),
    "another order, an input more": (
        ("x;\n    input Real y \"second\";", "y \"second\";\n    input Real x;"),
        ("second\";\n", "second\";\n    input Real g;\n"), False,
    ),
    "both an input in one place": (
        ("second\";\n", "second\";\n    input Real m;\n"), ("second\";\n", "second\";\n    input Real g;\n"), False,
    ),
    "both an input, in two places": (
        ("second\";\n", "second\";\n    input Real m;\n"),
        ("    input Real x;\n", "    input Real g;\n    input Real x;\n"), True,
    ),
}  # fmt: skip


@pytest.mark.parametrize(("mine", "generated", "fits"), SIGNATURES.values(), ids=SIGNATURES)
def test_inputs_of_a_function_are_a_sequence(mine: Edit, generated: Edit, fits: bool) -> None:
    edited = changed(FUNCTION, mine)
    found = merged(FUNCTION, edited, changed(FUNCTION, generated))
    assert found.text == (changed(edited, generated) if fits else None)
    assert fits or ["class `f`: you" in one for one in found.contradictions] == [True]


# --- comments and blanks --------------------------------------------------------------------------------------------

COMMENTS = {
    "element gone": (
        "  A a;\n  // 1\n  B b(x = 1 /* 2 */); // 3\n  C c;\n", "  A a;\n  C c;\n",
        "  A a;\n  // 1\n  /* 2 */\n  // 3\n  C c;\n",
    ),
    "last element gone": ("  A a;\n  // 1\n  B b(x = 1); // 2\n", "  A a;\n", "  A a;\n  // 1\n  // 2\n"),
    "element after a long comment gone": ("  /* 1\n  2 */ B b;\n  C c;\n", "  C c;\n", "  /* 1\n  2 */\n  C c;\n"),
    "only element gone": ("  B b; // 1\n", "", "  // 1\n"),
    "modifier gone": (
        "  B b(x = 1, // 1\n    y = 2, // 2\n    z = 3);\n", "  B b(x = 1, z = 3);\n",
        "  B b(x = 1, // 1\n    // 2\n    z = 3);\n",
    ),
    "element gone, behind a blank line": (
        "  A a;\n\n  // 1\n  B b;\n", "  A a;\n", "  A a;\n  // 1\n",
    ),
    "last modifier gone": ("  B b(x = 1,\n    y = 2 // 1\n  );\n", "  B b(x = 1);\n", "  B b(x = 1\n    // 1\n  );\n"),
    "all modifiers gone": ("  B b(x = 1 // 1\n  );\n", "  B b;\n", "  B b // 1\n;\n"),
    "description gone": ('  B b // 1\n    "d";\n', "  B b;\n", "  B b\n    // 1\n;\n"),
    "modifier added behind a remark": (
        "  B b(x = 1, // 1\n    y = 2);\n", "  B b(x = 1, w = 3, y = 2);\n",
        "  B b(x = 1, // 1\n    w = 3,\n    y = 2);\n",
    ),
    "modifier added at the end, behind a remark": (
        "  B b(x = 1,\n    y = 2 // 1\n  );\n", "  B b(x = 1, y = 2, z = 3);\n",
        "  B b(x = 1,\n    y = 2, // 1\n    z = 3\n  );\n",
    ),
    "modifier added first": ("  B b(/* 1 */ x = 1);\n", "  B b(w = 3, x = 1);\n", "  B b(w = 3, /* 1 */ x = 1);\n"),
    "between a modifier and its comma": (
        "  B b(x = 1 /* 1 */, y = 2);\n", "  B b(x = 5, y = 2, z = 3);\n", "  B b(x = 5 /* 1 */, y = 2, z = 3);\n",
    ),
    "in an expression": ("  Real r = a /* 1 */ * b; // 2\n", "  Real r = a * c;\n", "  Real r = a * c /* 1 */; // 2\n"),
    "at the end of a line in an expression": (
        "  Real r = a // 1\n    * b; // 2\n", "  Real r = a * c;\n", "  Real r = a * c // 1\n; // 2\n",
    ),
    "in a sum": (
        "  Real r = a.m + // 1\n    b.m;\n", "  Real r = a.m + b.m + c.m;\n",
        "  Real r = a.m + // 1\n    b.m +\n    c.m;\n",
    ),
    "element added behind a remark": ("  A a; // 1\n", "  A a;\n  B b;\n", "  A a; // 1\n  B b;\n"),
    "element added before the end": ("  A a;\n  // 1\n", "  A a;\n  B b;\n", "  A a;\n  B b;\n  // 1\n"),
    "two on one line": (
        "  A a; /* 1 */ B b; /* 2 */\n", "  A a; B b(x = 1);\n", "  A a; /* 1 */ B b(x = 1); /* 2 */\n",
    ),
    "around words": ("  /* 1 */ A /* 2 */ a /* 3 */ (x = /* 4 */ 1) /* 5 */ ; /* 6 */\n", '  A a(x = 2) "d";\n',
        '  /* 1 */ A /* 2 */ a /* 3 */ (x = /* 4 */ 2) "d" /* 5 */ ; /* 6 */\n'),
}  # fmt: skip


@pytest.mark.parametrize(("mine", "generated", "expected"), COMMENTS.values(), ids=COMMENTS)
def test_comments_stay(mine: str, generated: str, expected: str) -> None:
    base = re.sub(r"[ \t]*(//[^\n]*|/\*.*?\*/)", "", mine, flags=re.S)
    base = base if any(line.strip() for line in base.splitlines()) else ""
    result = merged(*map(model, (base, mine, generated)))
    assert result.text == model(expected), result


def test_comments_that_the_generator_wrote_go_with_their_element() -> None:
    base, generated = model("  A a;\n  // of b\n  B b; // b\n"), model("  A a;\n")
    assert merged(base, changed(base, ("A a;", "A a(x = 1);")), generated).text == model("  A a(x = 1);\n")


RESAVED = """\
model A
  B b(x={1,2},
      y=3) "d" annotation(
    Placement(transformation(extent={{-1,2},{3,4}})));
  C   c;
equation
  connect(a,b) annotation (Line(points={{1,2},{3,4}}));
end A;
"""
SAVED = """\
model A
  C c;
  B b(x = {1, 2}, y = 3) "d" annotation (Placement(transformation(extent = {{-1, 2}, {3, 4}})));

equation
  connect(b, a) annotation (Line(points = {{1, 2}, {3, 4}}));

end A;
"""


def test_text_saved_with_other_blanks_is_no_change_and_stays() -> None:
    generated = changed(SAVED, ("y = 3", "y = 4"), ("C c;", "C c(z = 1);"), ("\nend A", "  x = 1;\nend A"))
    expected = changed(RESAVED, ("y=3", "y=4"), ("C   c;", "C   c(z = 1);"), ("end A", "  x = 1;\nend A"))
    assert merged(SAVED, RESAVED, generated).text == expected
    assert merged(SAVED, RESAVED, SAVED.replace(" = ", "=")).text == RESAVED


def test_items_without_blanks_stay_so() -> None:
    base, mine = model("  B b(x = 1, y = 2);\n"), model("  B b(x=1,y=2);\n")
    generated = model("  B b(w = 0, x = 1, y = 3, z = 4);\n")
    assert merged(base, mine, generated).text == model("  B b(w = 0,x=1,y=3,z = 4);\n")


def test_items_are_set_apart_as_in_the_users_list() -> None:
    base = model("  B b(\n    x = 1,\n    y = 2);\n")
    generated = changed(base, ("y = 2", "y = 2,\n    z = 3"))
    assert merged(base, changed(base, ("\n    x", "x"), ("\n    y", " y")), generated).text == model(
        "  B b(x = 1, y = 2, z = 3);\n"
    )
    generated = model("  B b(x = 1, y = 2, z = 3);\n")
    mine = changed(base, ("y = 2", "y = 2,\n    m = 4"))
    assert merged(base, mine, generated).text == changed(mine, ("m = 4", "m = 4,\n    z = 3"))


def test_many_comments_in_a_row_end() -> None:
    """One pattern for all of them tried each end of each comment with all others: minutes for 30 comments."""
    base = "model A\n  Real x = 1;\n" + 200 * "  /* note */\n" + "  Real y = 1;\nend A;\n"
    merged = merge(base, base.replace("x = 1", "x = 2"), base.replace("y = 1", "y = 3"), is_modelica=True)
    assert merged.text == base.replace("x = 1", "x = 2").replace("y = 1", "y = 3")


def test_equations_too_many_to_compare_each_with_each_merge_by_lines() -> None:
    """A thousand that both sides replaced: nothing is lost, nothing is taken for another in silence."""
    texts = ("".join(f"  x{i} + {n} = y*{i + n};\n" for i in range(1_000)) for n in range(3))
    base, mine, generated = (f"model A\nequation\n{text}end A;\n" for text in texts)
    assert merge(base, mine, generated, is_modelica=True).text is None

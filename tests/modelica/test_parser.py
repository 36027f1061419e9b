"""The parser: what a text declares and uses, also where some of it can't be read."""

from __future__ import annotations

import os
import random
import re
from collections.abc import Sequence
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import Class, Extends, Modifier, Name, declared

LIBRARY = Path(__file__).parents[2] / "modelica"
STANDARD = Path.home() / ".openmodelica" / "libraries"
TEXT = """\
within Plant.Robots; // a comment

package Arm
  constant Real pi = 3, e = 2.7;
  model Joint
    extends Base(redeclare model Shape = Box);
    replaceable Plant.Friction friction[2](d = 1);
  end Joint;
  type Angle = Real(unit = "rad");
end Arm;
"""


ARM = """\
within Plant;
model Arm "An arm"
  extends Icons.Robot;
  import SI = Modelica.Units.SI;
  import Modelica.Math.{sin, cos};

  replaceable package Medium = Water(p = 1) constrainedby Fluid "What is in it";

  parameter SI.Mass m[2](each min = 0) = {1.2, 0.8} "Masses"
    annotation (Dialog(group = "Inertia", enable = not massless));

  final parameter Boolean massless = m[end] <= -1e-9 or false;

  Body body(m = m[1], redeclare model Shape = Box(a = 1), color = {0, 0, 255}) if not massless "The body";

  Real x, y(start = if massless then 0 elseif m[1] > 1 then -1 else x.^2 .+ sum(k * m[k] for k in 1:2));

  type Mode = enumeration(off "No torque", on);

  function gain
    input Real u;
    output Real y;
  external "C" y = gain(u) annotation (Library = "m");
  end gain;

  block Delay = Blocks.Delay(redeclare each Real u[3], final T = 1);

initial equation
  x = 0;

equation
  connect(body.frame_a, body.frame_b) annotation (Line(points = {{0, 0}, {1, 1}}));
  der(x) + y = [1, 2; 3, 4] * x[:, 1];
  if massless then
    x = 1;
  else
    for i in 1:2, j loop
      assert(m[i] > 0, "Mass " + String(i), AssertionLevel.warning);
    end for;
  end if;
  when {initial(), time > 1} then
    reinit(x, pre(y));
  elsewhen sample(0, 1) then
    reinit(x, 0);
  end when "Restart";

algorithm
  (x, , y) := f(m, scale = function g(a = 1));
  while x > 0 loop
    x := x - 1;
    break;
  end while;
  x := x - 1;
  x := x - 1;
  annotation (choices(choice = 1, choice = 2), Documentation(info = "<html>
---
</html>"));
end Arm;
"""


def name(text: str, line: int, start: int) -> Name:
    return Name((text,), line, starts=(start,))


def class_in(body: str) -> Class:
    """The class `A` with this body, which begins in line 2."""
    found = parse(f"model A\n{body}\nend A;\n")
    assert found.faults == []
    return found.classes[0]


def uses(names: Sequence[Name]) -> list[str]:
    return [f"{one}{'()' if one.is_called else ''}" for one in names]


def test_what_is_no_modelica_does_not_hide_the_rest() -> None:
    found = parse(TEXT.replace("  model Joint", "  Real = 3;\n  model Joint"))
    assert [(fault.reason, fault.line) for fault in found.faults] == [("lacks a name before `=`", 5)]
    assert len(list(declared(found.classes))) == 6


def test_a_text_may_say_that_it_is_in_no_package() -> None:
    assert parse("within;\nmodel A\nend A;\n").within == ""
    assert (parse(TEXT).within, parse(TEXT).within_line) == ("Plant.Robots", 1)
    assert parse("model A\nend A;\n").within is None


def test_classes_come_in_several_forms() -> None:
    text = (
        "type T = Real(min = a);\n type E = enumeration(one, two);\n replaceable package M = B constrainedby C;\n"
        "redeclare model extends S(k = 1)\n end S;\n function d = der(f, x);\n operator record O\n end O;"
    )
    found = class_in(text)
    assert [(str(one.name), one.kind, one.literals, one.is_extension, one.is_derivative) for one in found.classes] == [
        ("T", "type", None, False, False),
        ("E", "type", ("one", "two"), False, False),
        ("M", "package", None, False, False),
        ("S", "model", None, True, False),
        ("d", "function", None, False, True),
        ("O", "operator record", None, False, False),
    ]
    short, _, medium, extension, *_ = found.classes
    real, least, a, c, k = (len("model A\n") + text.index(word) for word in ("Real", "min", "a)", "C;", "k ="))
    assert short.alias == Extends(name("Real", 2, real), (Modifier(name("min", 2, least), uses=(name("a", 2, a),)),))
    assert (medium.constraint, medium.prefixes) == (Extends(name("C", 4, c)), frozenset({"replaceable"}))
    assert (extension.arguments, extension.prefixes) == ((Modifier(name("k", 5, k)),), frozenset({"redeclare"}))


def test_each_part_of_a_name_has_its_place() -> None:
    text = "model A\nequation\n  x = a . b[i.j].\n // a comment\n c;\nend A;\n"
    found = {str(one): [text[start] for start in one.starts] for one in parse(text).classes[0].uses}
    assert found == {"x": ["x"], "a.b.c": ["a", "b", "c"], "i.j": ["i", "j"]}


def test_names_in_statements_and_external_functions() -> None:
    found = class_in("algorithm\n  (x, , y) := f(m);\n  while x > 0 loop\n    x := x - w.v;\n  end while;")
    assert sorted(uses(found.uses)) == ["f()", "m", "w.v", "x", "x", "x", "x", "y"]
    found = class_in('external "C" y = gain(u) annotation (Library = "m");')
    assert uses(found.uses) == ["y", "u"]


def test_what_is_taken_away_from_a_base_class() -> None:
    (base,) = class_in("extends B(break c, break connect(a, d));").extends
    assert base.arguments == (Modifier(name("c", 2, len("model A\nextends B(break "))),)


FAULTS = {
    "unbalanced": ("body.frame_b)", "body.frame_b", "lacks `)` before `annotation` (line 32)"),
    "modifier of a global name": ("(each min = 0)", "(each .min = 0)", "lacks a name before `.` (line 9)"),
    "crossing": ("(each min = 0)", "(each min = 0]", "lacks `,` or `)` before `]` (line 9)"),
    "braces": ("{1, 1}}", "{1, 1}", "lacks `,` or `}` before `)` (line 32)"),
    "string": ('"Masses"', '"Masses', "has a string without an end (line 57)"),
    "escape": ('"Masses"', '"Mass\\es"', r"has the escape `\e`, which Modelica does not define (line 9)"),
    "comment": ("m[2]", "/* m[2]", "has a comment without an end (line 9)"),
    "quoted name": ("x, y", "'x, y", "has a quoted name without an end (line 16)"),
    "another name": ("end Arm", "end Leg", "ends `Arm` with `end Leg` (line 58)"),
    "no end": ("  end gain;\n", "", "lacks `end gain` before `end` (line 57)"),
    "end twice": ("end Arm;\n", "end Arm;\nend Arm;\n", "has one `end` too many (line 59)"),
    "cut off": ("end Arm;\n", "", "lacks `end Arm` before its end (line 58)"),
    "end of another block": ("end while", "end for", "lacks `end while` before `end` (line 52)"),
    "block without end": ("  end if;\n", "", "lacks `end if` before `algorithm` (line 46)"),
    "semicolon": ("Real u;\n", "Real u\n", "lacks `;` before `output` (line 22)"),
    "semicolon of an equation": ("  x = 0;", "  x = 0", "lacks `;` before `equation` (line 31)"),
    "subscript": ("x[:, 1]", "x[]", "lacks a subscript before `]` (line 33)"),
    "constraint": ("  Real x, y(", "  Real u constrainedby Real;\n  Real x, y(",
        "lacks `;` before `constrainedby` (line 16)"),
    "global package": ("within Plant", "within .Plant", "lacks a name before `.` (line 1)"),
    "comma too many": ("0.8}", "0.8, }", "lacks an expression before `}` (line 9)"),
    "comma": ("m[1], redeclare", "m[1] redeclare", "lacks `,` or `)` before `redeclare` (line 14)"),
    "names": ("  import SI", "  Real Mode;\n  import SI", "declares `Mode` twice (line 19)"),
    "names of one declaration": ("x, y(", "x, x, y(", "declares `x` twice (line 16)"),
    "bases": ("Robot;", "Robot;\n extends Icons.Robot(a = 1);", "extends `Icons.Robot` twice (line 4)"),
    "modifiers": ("a = 1)", "a = 1, a = 2)", "sets `a` twice (line 14)"),
    "ends": ("equation\n  c",
        "equation\n  connect(b, a);\n  connect(a, b);\n  c", "connects `a` and `b` twice (line 33)"),
    "equations": ("  x = 1;\n", "  x = 1;\n    y = 2;\n    x = 1;\n", "has the equation `x = 1` twice (line 37)"),
    "equation in an algorithm": ("(x, , y) :=", "(x, , y) =", "lacks `:=` before `=` (line 48)"),
    "after all": ("end Arm", "Real z;\nend Arm", "goes on after the annotation of `Arm` (line 58)"),
    "depth": ("(each min = 0)", f"(min = {50 * '('}0{50 * ')'})", "nests more than 50 deep (line 9)"),
}  # fmt: skip


@pytest.mark.parametrize(("old", "new", "reason"), FAULTS.values(), ids=FAULTS)
def test_faults_have_a_reason_and_a_line(old: str, new: str, reason: str) -> None:
    assert parse(ARM).faults == []
    text = ARM.replace(old, new, 1)
    assert text != ARM
    first = parse(text).faults[0]
    assert f"{first.reason} (line {first.line})" == reason


@pytest.mark.slow
@pytest.mark.parametrize("below", ["Mechanics/**", pytest.param("**", marks=pytest.mark.large)])
def test_the_standard_library_can_be_read(below: str) -> None:
    folders = [Path(entry) for entry in os.environ.get("MODELICAPATH", "").split(os.pathsep) if entry]
    files = [path for folder in (*folders, STANDARD) for path in folder.glob(f"Modelica*/{below}/*.mo")]
    if not files:
        pytest.skip("there is no Modelica Standard Library")
    assert [path for path in files if parse(path.read_text("utf-8", errors="replace")).faults] == []


SOURCE = (LIBRARY / "UrdfSync" / "Visualizers" / "package.mo").read_text("utf-8") + TEXT.partition(";")[2]


@given(st.data())
def test_no_damage_is_too_much(data: st.DataObject) -> None:
    """Whatever is cut out of a text, and put in: the parser ends, and its lines are in the text."""
    start = data.draw(st.integers(0, len(SOURCE)))
    end = data.draw(st.integers(start, len(SOURCE)))
    text = SOURCE[:start] + data.draw(st.text(alphabet=" \n\"'()[]{};,.=abend/*", max_size=20)) + SOURCE[end:]
    lines = text.count("\n") + 1
    found = parse(text)
    assert all(1 <= fault.line <= lines for fault in found.faults)
    assert all(1 <= one.line <= lines for one in declared(found.classes))


@given(st.text(max_size=60))
def test_any_text_can_be_read(text: str) -> None:
    parse(text)


def damaged(rng: random.Random, text: str, other: str) -> str:
    """A text with lines taken from another one, lines lost, doubled or moved, and single tokens lost or swapped."""
    lines, pool = text.splitlines(keepends=True), other.splitlines(keepends=True)
    for _ in range(rng.randint(0, 3)):
        place, size = rng.randrange(len(lines) + 1), rng.randint(1, 4)
        some, start = lines[place : place + size], rng.randrange(len(pool))
        lines[place : place + size] = rng.choice([[], 2 * some, some + pool[start : start + size], some[::-1]])
    parts = re.findall(r"\s+|\w+|.", "".join(lines)) or [""]
    for _ in range(rng.randint(0, 2)):
        one, two = rng.randrange(len(parts)), rng.randrange(len(parts))
        parts[one], parts[two] = rng.choice([("", parts[two]), (parts[two], parts[two]), (parts[two], parts[one])])
    return "".join(parts)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_a_text_has_a_fault_where_a_compiler_refuses_it(seed: int) -> None:
    rumoca = pytest.importorskip("rumoca")
    rng = random.Random(seed)
    files = [text for path in sorted(LIBRARY.rglob("*.mo")) if len(text := path.read_text("utf-8")) < 4000]
    refused = 0
    for _ in range(100):
        text = damaged(rng, *rng.sample(files, 2))
        try:
            told = rumoca.validate_source(text)
        except rumoca.RumocaError as error:
            told = [str(error)]
        if any("can only contain constants" in one for one in map(str, told)):
            continue  # a rule of packages, which the parser does not know
        is_refused = bool(told)
        refused += is_refused
        found = parse(text).faults
        syntax = [fault for fault in found if not fault.reason.endswith(" twice")]
        # the compiler's parser takes some of what stands there twice
        assert bool(syntax) <= is_refused <= bool(found), text
    assert 20 < refused < 95, "the cases are worth comparing"

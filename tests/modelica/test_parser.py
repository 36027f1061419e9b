"""The parser: what a text declares and uses, also where some of it can't be read."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import Class, Component, Connection, Declared, Extends, Import, Modifier, Name, declared

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


def name(text: str, line: int, *, is_called: bool = False) -> Name:
    return Name(tuple(text.lstrip(".").split(".")), line, text.startswith("."), is_called)


def class_in(body: str) -> Class:
    """The class `A` with this body, which begins in line 2."""
    found = parse(f"model A\n{body}\nend A;\n")
    assert found.faults == ()
    return found.classes[0]


def uses(names: Sequence[Name]) -> list[str]:
    return [f"{one}{'()' if one.is_called else ''}" for one in names]


def test_all_that_is_declared() -> None:
    found = parse(TEXT)
    assert (found.faults, found.within, found.within_line) == ((), "Plant.Robots", 1)
    assert list(declared(found.classes)) == [
        Declared(("Arm",), 3),
        Declared(("Arm", "pi"), 4, "Real"),
        Declared(("Arm", "e"), 4, "Real"),
        Declared(("Arm", "Joint"), 5),
        Declared(("Arm", "Joint", "friction"), 7, "Plant.Friction"),
        Declared(("Arm", "Angle"), 9),
    ]


def test_what_is_no_modelica_does_not_hide_the_rest() -> None:
    found = parse(TEXT.replace("  model Joint", "  Real = 3;\n  model Joint"))
    assert [(fault.reason, fault.line) for fault in found.faults] == [("lacks a name before `=`", 5)]
    assert len(list(declared(found.classes))) == 6


def test_a_text_may_say_that_it_is_in_no_package() -> None:
    assert parse("within;\nmodel A\nend A;\n").within == ""
    assert parse("model A\nend A;\n").within is None


def test_modifiers_are_nested_values() -> None:
    found = class_in("extends Arm(redeclare My.Elbow elbow(c = k), lower(inertial(mass = 3*m)));")
    inner = Modifier(name("mass", 2), uses=(name("m", 2),))
    assert found.extends == (
        Extends(
            name("Arm", 2),
            (
                Modifier(
                    name("elbow", 2),
                    (Modifier(name("c", 2), uses=(name("k", 2),)),),
                    is_redeclared=True,
                    type=name("My.Elbow", 2),
                ),
                Modifier(name("lower", 2), (Modifier(name("inertial", 2), (inner,)),)),
            ),
        ),
    )


def test_a_component_may_be_replaceable() -> None:
    found = class_in("inner replaceable .P.Link up[n], low = x if b\n  constrainedby P.Partial(final m = 2);")
    constraint = Extends(name("P.Partial", 3), (Modifier(name("m", 3)),))
    prefixes = frozenset({"inner", "replaceable"})
    assert found.components == (
        Component(name("up", 2), name(".P.Link", 2), prefixes, (), (name("n", 2),), constraint),
        Component(name("low", 2), name(".P.Link", 2), prefixes, (), (name("x", 2), name("b", 2)), constraint),
    )


def test_classes_come_in_several_forms() -> None:
    found = class_in(
        "type T = Real(min = a);\n type E = enumeration(one, two);\n replaceable package M = B constrainedby C;\n"
        "redeclare model extends S(k = 1)\n end S;\n function d = der(f, x);\n operator record O\n end O;"
    )
    assert [(str(one.name), one.kind, one.literals, one.is_extension, one.is_derivative) for one in found.classes] == [
        ("T", "type", None, False, False),
        ("E", "type", ("one", "two"), False, False),
        ("M", "package", None, False, False),
        ("S", "model", None, True, False),
        ("d", "function", None, False, True),
        ("O", "operator record", None, False, False),
    ]
    short, _, medium, extension, *_ = found.classes
    assert short.alias == Extends(name("Real", 2), (Modifier(name("min", 2), uses=(name("a", 2),)),))
    assert (medium.constraint, medium.prefixes) == (Extends(name("C", 4)), frozenset({"replaceable"}))
    assert (extension.arguments, extension.prefixes) == ((Modifier(name("k", 5)),), frozenset({"redeclare"}))


def test_imports() -> None:
    found = class_in("import A.B;\n import C = A.D;\n import A.*;\n import A.{x, y = z};")
    assert found.imports == (
        Import(name("A.B", 2)),
        Import(name("A.D", 3), "C"),
        Import(name("A", 4), is_everything=True),
        Import(name("A", 5), members=(("x", "x"), ("y", "z"))),
    )


def test_names_in_equations_without_indices_of_loops() -> None:
    found = class_in(
        "equation\n  connect(a.b[i].c, .d);\n  for i in 1:n loop\n    x[i] = F.g(i, k = y) + i;\n  end for;\n"
        "  z = sum(j*q for j in p) + time;\n  annotation (Icon(extent = nowhere));\n"
    )
    assert found.connections == (Connection(name("a.b.c", 3), name(".d", 3)),)
    expected = ["i", "a.b.c", "d", "n", "x", "F.g()", "y", "z", "sum()", "q", "p", "time"]
    assert sorted(uses(found.uses)) == sorted(expected)


def test_names_in_statements_and_external_functions() -> None:
    found = class_in("algorithm\n  (x, , y) := f(m);\n  while x > 0 loop\n    x := x - w.v;\n  end while;")
    assert sorted(uses(found.uses)) == ["f()", "m", "w.v", "x", "x", "x", "x", "y"]
    found = class_in('external "C" y = gain(u) annotation (Library = "m");')
    assert uses(found.uses) == ["y", "u"]


def test_what_is_taken_away_from_a_base_class() -> None:
    (base,) = class_in("extends B(break c, break connect(a, d));").extends
    assert base.arguments == (Modifier(name("c", 2), is_break=True),)


def test_the_library_can_be_read() -> None:
    files = list(LIBRARY.rglob("*.mo"))
    assert len(files) > 200
    assert [path for path in files if parse(path.read_text("utf-8")).faults] == []


@pytest.mark.slow
def test_the_standard_library_can_be_read() -> None:
    folders = [Path(entry) for entry in os.environ.get("MODELICAPATH", "").split(os.pathsep) if entry]
    files = [path for folder in (*folders, STANDARD) for path in folder.glob("*/**/*.mo") if "Modelica" in str(path)]
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

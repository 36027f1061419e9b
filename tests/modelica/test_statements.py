"""Texts are read without their plain statements: places, names and types of components are those of the whole text."""

from __future__ import annotations

import pytest

from urdfsync.modelica.parser import parse
from urdfsync.modelica.statements import compare, is_plain, mentioning, parse_without, plain_statements
from urdfsync.modelica.syntax import Component

GENERATED = """\
within Arm;

model Arm "Arm"
  extends UrdfSync.Icons.Robot;

  replaceable Joints.Elbow elbow(
    animation = animation,
    c(start = 1, fixed = true)) constrainedby Joints.Any
    "Joint, with a comma";

  Modelica.Mechanics.Interfaces.Frame_a tool
    annotation (Placement(transformation(extent={{1, 2}, {3, 4}})));

equation
  connect(elbow.frame_a, tool)
    annotation (Line(points={{1, 2}}));
  connect(elbow.frame_b, tool)
    annotation (Line(points={{1, 2}}));

  annotation (
    Icon(graphics={Text(extent={{1, 2}, {3, 4}})}));
end Arm;
"""
ELBOW, TOOL = GENERATED.split(";\n")[2:4]


def components(text: str, passed: frozenset[str]) -> list[Component]:
    (model,) = parse_without(text, passed).stored.classes
    return model.components


def test_what_is_passed_over_leaves_all_names_at_their_places() -> None:
    passed = plain_statements(GENERATED)
    (whole,), reading = parse(GENERATED).classes, parse_without(GENERATED, passed)
    (model,) = reading.stored.classes
    assert [(one.name, one.type) for one in model.components] == [(one.name, one.type) for one in whole.components]
    assert reading.passed == {one.name.line for one in whole.components}
    assert [str(one) for one in model.uses] == ["elbow.frame_a", "tool"], "the first connection is behind `equation`"
    assert whole.components[0].uses or whole.components[0].arguments
    assert not model.components[0].arguments
    assert len(reading.text) == len(GENERATED)
    assert not reading.stored.faults


def test_only_what_is_edited_is_read() -> None:
    mine = GENERATED.replace("start = 1", "start = mine").replace("\nequation", "\n  Real mine, other;\n\nequation")
    difference = compare(mine, GENERATED)
    assert difference.names == {"elbow", "mine", "other"}
    assert not difference.is_whole
    assert [bool(one.arguments) for one in components(mine, difference.same)] == [True, False, False, False]
    assert parse_without(mine, difference.same).passed == {11}


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("extends UrdfSync.Icons.Robot", "extends Mine"),
        ('"Arm"', '"Arm"\n  import Mine.*;'),
        ("  extends", "  // extends"),
    ],
)
def test_other_bases_and_imports_may_change_all(old: str, new: str) -> None:
    assert compare(GENERATED.replace(old, new), GENERATED).is_whole


@pytest.mark.parametrize(("before", "after"), [("/*", "*/"), ('  Real mine "', '"')])
def test_a_statement_in_a_comment_or_string_is_not_as_generated(before: str, after: str) -> None:
    mine = GENERATED.replace(f"{ELBOW};\n{TOOL};\n", f"{before};\n{TOOL};\n{after};\n".replace("*/;", "*/"))
    assert compare(mine, GENERATED).is_whole


def test_another_description_of_the_class_changes_nothing() -> None:
    difference = compare(GENERATED.replace('"Arm"', '"Mine"'), GENERATED)
    assert (difference.names, difference.is_whole) == (frozenset(), False)


def test_a_statement_that_stands_twice_is_no_longer_as_generated() -> None:
    assert TOOL not in compare(GENERATED.replace(TOOL, f"{TOOL};\n{TOOL}"), GENERATED).same


@pytest.mark.parametrize(
    "statement",
    [
        "  Real x(start = 1), y",
        "  Real x = 1, y",
        '  Real x "one"; Real y',
        "  Arm arm(redeclare Elbow elbow)",
        "model Arm\n  Real x",
        "equation\n  connect(a, b)",
        "  x = y",
        "  extends Arm",
        '  annotation (uses(Modelica(version="4")))',
    ],
)
def test_what_others_see_more_of_is_not_plain(statement: str) -> None:
    assert not is_plain(statement)


def test_names_are_mentioned_as_words() -> None:
    statements = [ELBOW, TOOL]
    assert mentioning(statements, {"elbow"}) == {ELBOW}
    assert mentioning(statements, {"elb", "too"}) == set()

"""What the export renamed is renamed in the user's text where it is the same thing."""

from __future__ import annotations

import pytest

from urdfsync.merge import merge
from urdfsync.merge.renames import find_uses_of, rename, without_clashes

BASE = """\
model Arm
  Links.Elbow elbow(m = 1) "elbow";
equation
  connect(elbow.frame, 'w r'.frame);
end Arm;
"""


def test_what_is_used_in_base_follows() -> None:
    mine = BASE.replace("equation", "  Real elbow2 = elbow.m; // elbow\nequation")
    assert rename(BASE, mine, {"elbow": "wrist", "Elbow": "Wrist", "'w r'": "hand"}) == tuple(
        text.replace("Elbow elbow(", "Wrist wrist(")
        .replace("elbow.", "wrist.")
        .replace("'w r'", "hand")
        .replace("Links.Elbow", "Links.Wrist")
        for text in (BASE, mine)
    )


def test_base_may_be_a_piece_of_a_text() -> None:
    """The lines that use a name may end within brackets."""
    assert rename("  connect(elbow", "  connect(elbow.frame_a, hand);", {"elbow": "knee"}) == (
        "  connect(knee",
        "  connect(knee.frame_a, hand);",
    )


def test_what_is_not_in_base_does_not() -> None:
    base = BASE.replace(" elbow(", " joint(").replace("elbow.", "joint.")
    mine = base.replace("equation", "  Real elbow = Links.Elbow.m + other.Elbow;\nequation")
    _, renamed = rename(base, mine, {"elbow": "wrist", "Elbow": "Wrist"})
    assert renamed == mine.replace("Links.Elbow", "Links.Wrist")


def test_names_that_change_places() -> None:
    assert rename("a = b;", "a = b + a;", {"a": "b", "b": "a"}) == ("b = a;", "b = a + b;")


def test_an_edit_moves_to_the_new_name() -> None:
    mine = BASE.replace("m = 1", "m = 2 /* mine */")
    generated = BASE.replace("elbow", "wrist").replace("Elbow", "Wrist")
    merged = merge(BASE, mine, generated, is_modelica=True, names={"elbow": "wrist", "Elbow": "Wrist"})
    assert merged.text == mine.replace("Elbow elbow", "Wrist wrist").replace("elbow.", "wrist.").replace(
        '"elbow"', '"wrist"'
    )
    plain = merge(BASE, mine, generated, is_modelica=True)
    told = 'you changed it to `Links.Elbow elbow(m = 2 /* mine */) "elbow";`, the export removes the component'
    assert [*plain.contradictions] == [f"component `elbow`: {told}"]


def test_a_new_name_that_the_user_has_given_to_something_else_is_a_conflict() -> None:
    """Both would have the same name, and the user's equation would mean something else."""
    base, generated = "model A\n  Real a = 1;\nend A;\n", "model A\n  Real n = 1;\nend A;\n"
    mine = "model A\n  Real a = 1;\n  Real n = 5;\nequation\n  a = n;\nend A;\n"
    assert merge(base, mine, generated, is_modelica=True, names={"a": "n"}).text is None


def test_names_that_swap_or_follow_each_other_have_no_clash() -> None:
    """Each goes its way at once."""
    assert without_clashes({"a": "b", "b": "a"}, "a = b") == {"a": "b", "b": "a"}
    assert without_clashes({"a": "b", "b": "c"}, "a = b") == {"a": "b", "b": "c"}
    assert without_clashes({"a": "b", "b": "c"}, "a = b + c") == {}
    assert without_clashes({"a": "b"}, "a b") == {}


@pytest.mark.parametrize(
    ("base", "mine", "generated", "merged"),
    [
        pytest.param("B a(m = 1);", "B x(m = 1);", "B a(m = 2);", "B x(m = 2);", id="the only one like it"),
        pytest.param("B a(m = 1);", "B x(m = 3);", "B a(m = 2);", None, id="with another number"),
        pytest.param("B a(m = 1);", "B x(m = 1), y(m = 1);", "B a(m = 2);", None, id="two are like it"),
        pytest.param(
            'B a(m = 1) "a";', 'B x(m = 1) "a" annotation (Placement());', 'B a(m = 2) "a";',
            'B x(m = 2) "a" annotation (Placement());', id="with another layout",
        ),
    ],
)  # fmt: skip
def test_a_component_that_the_user_renamed_takes_what_the_export_changes(
    base: str, mine: str, generated: str, merged: str | None
) -> None:
    texts = (f"model A\n  {text}\nequation\n  c = 1;\nend A;\n" for text in (base, mine, generated))
    expected = None if merged is None else f"model A\n  {merged}\nequation\n  c = 1;\nend A;\n"
    assert merge(*texts, is_modelica=True).text == expected


@pytest.mark.parametrize(
    ("text", "renamed"),
    [
        ("Arm arm(upper(mass = 1))", "Arm arm(big(mass = 1))"),
        ("Plant.Arm arm[2](each upper(mass = 1))", "Plant.Arm arm[2](each big(mass = 1))"),
        ("Arm[2] arms(final upper = 1)", "Arm[2] arms(final big = 1)"),
        ("extends Plant.Arm(upper(mass = 1))", "extends Plant.Arm(big(mass = 1))"),
        ("extends Scene(redeclare Arm arm(upper(mass = 1)))", "extends Scene(redeclare Arm arm(big(mass = 1)))"),
        ("Arm arm(elbow(limits(upper = 1)))", None),
        ("extends UrdfSync.Records.Revolute(limits(lower = 0, upper = 1), upper = 2)", None),
        ("Modelica.Blocks.Sources.Constant constant(upper = 1)", None),
        ("parameters = Parameters(upper = 1)", None),
        ("equation\n  y = f(upper = 1)", None),
    ],
)
def test_only_elements_of_a_robot_are_renamed_in_modifiers(text: str, renamed: str | None) -> None:
    """Limits have an `upper`, and inertias a `mass`, whatever links are called."""
    assert rename(text, text, {"upper": "big"}) == ((renamed or text,) * 2)
    assert [*find_uses_of(text, {"upper": "big"})] == ([("upper", text.index("upper"))] if renamed else [])

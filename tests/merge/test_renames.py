"""What the export renamed is renamed in the user's text where it is the same thing."""

from __future__ import annotations

from urdfsync.merge import merge
from urdfsync.merge.renames import rename

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
    assert [found.what for found in plain.conflicts] == ["component `elbow`: you changed it, the export removes it"]


def test_what_the_user_renamed_is_still_the_same_thing() -> None:
    """Only a component that is alike in all but its own name counts as renamed."""
    base = "model A\n  Body b(m = b.x, n = 1);\nequation\n  connect(b.frame, c.frame);\nend A;\n"
    mine, generated = base.replace("b", "body"), base.replace("n = 1", "n = 2")
    assert merge(base, mine, generated, is_modelica=True).text == mine.replace("n = 1", "n = 2")
    assert merge(base, mine.replace("Body", "Ball"), generated, is_modelica=True).text is None

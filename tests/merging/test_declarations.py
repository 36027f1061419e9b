"""What a text declares: classes and components with the classes around them, wherever it can be read."""

from __future__ import annotations

from urdfsync.merging.grammar import Declared, outline

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


def test_an_outline_has_all_that_is_declared() -> None:
    found = outline(TEXT)
    assert (found.findings, found.within, found.within_line) == ([], "Plant.Robots", 1)
    assert found.declared == [
        Declared(("Arm", "pi"), 4, "Real"),
        Declared(("Arm", "e"), 4, "Real"),
        Declared(("Arm", "Joint", "friction"), 7, "Plant.Friction"),
        Declared(("Arm", "Joint"), 5),
        Declared(("Arm", "Angle"), 9),
        Declared(("Arm",), 3),
    ]


def test_what_is_no_modelica_does_not_hide_the_rest() -> None:
    found = outline(TEXT.replace("  model Joint", "  Real = 3;\n  model Joint"))
    assert len(found.findings) == 1
    assert len(found.declared) == 6


def test_a_text_may_say_that_it_is_in_no_package() -> None:
    assert outline("within;\nmodel A\nend A;\n").within == ""
    assert outline("model A\nend A;\n").within is None

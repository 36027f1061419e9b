"""The parts of a text that is parsed: what it declares, and whether all of it could be read."""

from __future__ import annotations

import pytest

from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import declared

TEXT = """\
package Arm
  constant Real pi = 3,
    e = 2.7;
  model Joint
    extends Base(redeclare model Shape = Box);
    replaceable Plant.Friction friction[2](d = 1);
  end Joint;
end Arm;
model Other = Arm.Joint;
"""


def test_all_that_is_declared() -> None:
    found = parse(TEXT)
    assert found.faults == []
    assert [(".".join(one.path), one.line) for one in declared(found.classes)] == [
        ("Arm", 1), ("Arm.pi", 2), ("Arm.e", 3), ("Arm.Joint", 4), ("Arm.Joint.friction", 6), ("Other", 9),
    ]  # fmt: skip


@pytest.mark.parametrize(("more", "is_broken"), [("", False), ("Real x, x;", False), ("Real x, x; Real;", True)])
def test_what_is_there_twice_breaks_no_text(more: str, is_broken: bool) -> None:
    found = parse(TEXT.replace("end Arm", f"{more}\nend Arm"))
    assert (bool(found.faults), found.is_broken) == (bool(more), is_broken)

"""Warnings of a package as variables."""

from __future__ import annotations

import re

import pytest
from support.packages import generate
from support.urdfs import robot

from urdfsync.checks.flags import flagged, with_flags
from urdfsync.domain import Target

BOX = '<geometry><box size="1 2 3"/></geometry>'
LINK = robot(f'<link name="base"><visual name="a;b">{BOX}</visual><collision>{BOX}</collision></link>')

MODEL = """\
model Joint
  Real x;
{section}
  x = time;
{assertion}
end Joint;
"""
ASSERTION = '  assert(noEvent(x <= max(1, 2)), getInstanceName() + " (joint) is, far out", AssertionLevel.warning);'
FLAG = "warning_getInstanceName_joint_is_far_out"


def model(section: str, assertion: str) -> str:
    return MODEL.format(section=section, assertion=assertion)


def test_a_warning_becomes_a_variable_before_its_equations() -> None:
    equation = f"  {FLAG} = noEvent(if noEvent(x <= max(1, 2)) then 0 else 1);"
    assert flagged(model("equation", ASSERTION)) == model(f"Real {FLAG};\nequation", equation)


@pytest.mark.parametrize(
    "text",
    [
        model("algorithm", ASSERTION),
        model("initial equation", ASSERTION),
        model("equation", ASSERTION.replace(".warning", ".error")),
        model("equation", f"  if x > 0 then\n  {ASSERTION}\n  end if;"),
        model("equation", f"  for i in 1:2 loop\n  {ASSERTION}\n  end for;"),
    ],
)
def test_other_assertions_stay(text: str) -> None:
    assert flagged(text) == text


def test_one_message_makes_one_variable_and_other_files_are_as_they_were() -> None:
    assert flagged(model("equation", f"{ASSERTION}\n{ASSERTION}")).count("Real warning_") == 1
    texts = {"a.txt": ASSERTION.encode(), "b.mo": b"// caf\xe9\nmodel B\nend B;\n"}
    assert with_flags(texts) == texts
    latin = b"// caf\xe9\n" + model("equation", ASSERTION).encode()
    assert with_flags({"a.mo": latin})["a.mo"].startswith(b"// caf\xe9\n")


def test_shapes_of_links_are_left_out() -> None:
    package = generate(LINK.encode(), Target("Bot", "Bot"))
    text = package.texts["Links/Base.mo"]
    assert re.findall(r"(\w+)\(\s*parameters = [^;]* if false\n", flagged(text)) == ["visual1", "collision1"]
    assert flagged(text).replace(" if false\n", "\n") == text

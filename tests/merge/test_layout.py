"""Places of many new parts; `catalogue/` has the other cases of layout."""

from __future__ import annotations

import re

import pytest

from urdfsync.merge import merge


def placed(name: str, x: int, y: int, *, origin: bool = False) -> str:
    extent = "{{-10, -10}, {10, 10}}" if origin else f"{{{{{x - 10}, {y - 10}}}, {{{x + 10}, {y + 10}}}}}"
    at = f", origin={{{x}, {y}}}" if origin else ""
    return f"  B {name} annotation (Placement(transformation(extent={extent}{at})));\n"


def line(one: str, other: str, *points: tuple[int, int]) -> str:
    through = ", ".join(f"{{{x}, {y}}}" for x, y in points)
    return f"  connect({one}, {other}) annotation (Line(points={{{through}}}));\n"


def model(components: str, lines: str = "", annotation: str = "") -> str:
    return f"model A\n{components}equation\n{lines}{annotation}end A;\n"


def merged(base: str, mine: str, generated: str) -> str:
    found = merge(base, mine, generated, is_modelica=True)
    assert found.text is not None, (found.contradictions, found.flaw)
    return found.text


A, B, A_B = placed("a", 0, 0), placed("b", 50, 0), line("a.f", "b.f", (10, 0), (40, 0))
BASE = model(A + B, A_B)
MOVED_B, BENT = placed("b", 50, 60), line("a.f", "b.f", (10, 0), (25, 0), (25, 60), (40, 60))
MOVED = model(A + MOVED_B, BENT)
EXPORT = model(
    placed("a", 0, 20) + placed("b", 50, 20) + placed("c", 100, 20),
    line("a.f", "b.f", (10, 20), (40, 20)) + line("b.f", "c.f", (60, 20), (90, 20)),
)


def test_new_parts_do_not_lie_on_each_other() -> None:
    parts = "".join(placed(f"n{number}", 100, 20) for number in range(30))
    text = merged(BASE, MOVED, EXPORT.replace(placed("c", 100, 20), parts).replace("c.f", "n0.f"))
    places = re.findall(r"B n\d+ .*extent=(.*)\)\)\);", text)
    assert len(set(places)) == 30


def test_parts_side_by_side_do_not_lie_on_each_other() -> None:
    text = merged(BASE, model(A + MOVED_B + placed("mine", 80, 60), BENT), EXPORT)
    assert placed("c", 100, 60) in text


@pytest.mark.slow
def test_a_diagram_full_of_boxes_upon_each_other_takes_no_minutes() -> None:
    """Free places are looked for so long only; all parts are there."""
    boxes = "".join(placed(f"n{number}", 0, 0) for number in range(2_000))
    text = merged(model(A), model(placed("a", 7, 7)), model(A + boxes))
    assert text.count("  B n") == 2_000

"""Layout belongs to the user once he has moved anything in a diagram; new things get a place in it."""

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


def test_without_a_move_the_generated_layout_is_taken() -> None:
    mine = BASE.replace("B a ", "B a(x = 1) ")
    assert merged(BASE, mine, EXPORT) == EXPORT.replace("B a ", "B a(x = 1) ")


def test_what_is_there_stays_where_the_user_put_it_and_the_new_goes_along() -> None:
    """The new part keeps its way from its neighbour, and its line starts where the neighbour is."""
    assert merged(BASE, MOVED, EXPORT) == model(
        A + MOVED_B + placed("c", 100, 60), BENT + line("b.f", "c.f", (60, 60), (90, 60))
    )


MOVES = {
    "line": ("{40, 0}}", "{30, 5}, {40, 0}}"),
    "diagram": ("{1, 1}", "{9, 9}"),
    "no place any more": (" annotation (Placement(transformation(extent={{40, -10}, {60, 10}})))", ""),
}


@pytest.mark.parametrize(("old", "new"), MOVES.values(), ids=MOVES)
def test_any_change_of_the_layout_makes_it_the_users(old: str, new: str) -> None:
    diagram = "  annotation (Diagram(coordinateSystem(extent={{0, 0}, {1, 1}})));\n"
    base, export = BASE.replace("end A", f"{diagram}end A"), EXPORT.replace("end A", f"{diagram}end A")
    mine = base.replace(old, new)
    text = merged(base, mine, export.replace("{1, 1}", "{7, 7}"))
    assert set(mine.splitlines()) <= set(text.splitlines())
    assert "B c" in text


def test_a_new_part_gets_a_free_place() -> None:
    """Where it would stand the user has put something: it stands below."""
    mine = model(A + placed("b", 100, 0), line("a.f", "b.f", (10, 0), (90, 0)))
    export = model(A + B + placed("c", 50, 0), A_B + line("a.f", "c.f", (10, 0), (40, 0)))
    assert merged(BASE, mine, export) == model(
        A + placed("b", 100, 0) + placed("c", 50, 0),
        line("a.f", "b.f", (10, 0), (90, 0)) + line("a.f", "c.f", (10, 0), (40, 0)),
    )
    mine = mine.replace("equation", placed("m", 50, 0) + "equation")
    text = merged(BASE, mine, export)
    assert placed("c", 50, -20) in text
    assert line("a.f", "c.f", (10, 0), (25, 0), (25, -20), (40, -20)) in text


def test_a_place_with_an_origin_is_moved_by_it() -> None:
    export = EXPORT.replace(placed("c", 100, 20), placed("c", 100, 20, origin=True))
    assert placed("c", 100, 60, origin=True) in merged(BASE, MOVED, export)


def test_new_parts_do_not_lie_on_each_other() -> None:
    parts = "".join(placed(f"n{number}", 100, 20) for number in range(30))
    text = merged(BASE, MOVED, EXPORT.replace(placed("c", 100, 20), parts).replace("c.f", "n0.f"))
    places = re.findall(r"B n\d+ .*extent=(.*)\)\)\);", text)
    assert len(set(places)) == 30


def test_a_part_without_a_place_needs_none() -> None:
    export = BASE.replace("equation\n", "  Real x;\nequation\n  x = 1;\n")
    assert merged(BASE, MOVED, export) == MOVED.replace("equation\n", "  Real x;\nequation\n  x = 1;\n")


def test_what_the_export_removes_goes_also_if_it_was_moved() -> None:
    assert merged(BASE, MOVED, model(A)) == model(A)


def test_icons_stay_and_other_annotations_do_not() -> None:
    icon = '  annotation (Icon(graphics={{Line(points={{{{0, 0}}, {{{0}, 1}}}})}}), Documentation(info="{1}"));\n'
    base, mine, export = (model(A, A_B, icon.format(*values)) for values in (("1", "a"), ("2", "a"), ("3", "b")))
    assert merged(base, mine, export) == model(A, A_B, icon.format("2", "b"))


@pytest.mark.parametrize(
    "endless", ["extent={{-1e999, -10}, {10, 10}}", "extent={{-1, -1}, {1, 1}}, origin={1e999, 0}"]
)
def test_a_place_without_end_counts_as_none(endless: str) -> None:
    """Else `inf` and `nan` would be in the text."""
    mine = BASE.replace("extent={{40, -10}, {60, 10}}", endless)
    assert placed("c", 100, 0) in merged(BASE, mine, EXPORT)


def test_a_diagram_full_of_boxes_upon_each_other_takes_no_minutes() -> None:
    """Free places are looked for so long only; all parts are there."""
    boxes = "".join(placed(f"n{number}", 0, 0) for number in range(2_000))
    text = merged(model(A), model(placed("a", 7, 7)), model(A + boxes))
    assert text.count("  B n") == 2_000


def text(name: str, y: int) -> str:
    return f'Text(extent={{{{0, {y}}}, {{9, {y + 9}}}}}, textString="{name}")'


def drawing(*graphics: str, extent: int = 100) -> str:
    inner = ", ".join(graphics)
    system = f"coordinateSystem(extent={{{{0, 0}}, {{1, {extent}}}}})"
    return f"  annotation (Icon({system}, graphics={{{inner}}}));\n"


def frame(name: str, y: int) -> str:
    places = f"transformation(x = {y}), iconTransformation(extent={{{{0, {y}}}, {{9, {y + 9}}}}})"
    return f"  F {name} annotation (Placement({places}));\n"


DRAWN = model(frame("a", 0) + frame("b", 20), "", drawing(text("a", 0), text("b", 20)))
LARGER = model(
    *(frame("a", 20) + frame("c", 40) + frame("b", 60), ""),
    drawing(text("a", 20), text("c", 40), text("b", 60), extent=150),
)


@pytest.mark.parametrize("export", [LARGER, LARGER.replace(text("b", 60), f"{text('b', 60)}, {text('d', 80)}")])
def test_graphics_of_the_user_stand_in_an_icon_that_grows(export: str) -> None:
    """What he only adds leaves all the rest to the export."""
    logo = 'Text(extent={{0, 0}, {1, 1}}, textString="mine")'
    mine = DRAWN.replace(text("b", 20), f"{text('b', 20)}, {logo}")
    assert merged(DRAWN, mine, export) == export.replace(text("b", 60), f"{text('b', 60)}, {logo}")


def test_graphics_of_the_export_come_to_an_icon_that_the_user_has_arranged() -> None:
    mine = DRAWN.replace(text("a", 0), text("a", 7)).replace(text("b", 20), text("label of b", 20))
    found = merged(DRAWN, mine, LARGER)
    assert drawing(text("a", 7), text("label of b", 20), text("c", 40)) in found
    assert frame("a", 0) in found.replace("x = 20", "x = 0"), "what is on the icon stays there"


def test_graphics_of_the_export_go_from_an_icon_that_the_user_has_arranged() -> None:
    mine = LARGER.replace(text("a", 20), text("a", 7)).replace(text("c", 40), text("c", 47))
    assert drawing(text("a", 7), text("b", 60), extent=150) in merged(LARGER, mine, DRAWN)


def test_an_icon_follows_the_export_where_the_diagram_is_the_users() -> None:
    mine = DRAWN.replace("x = 0", "x = 5")
    assert merged(DRAWN, mine, LARGER) == LARGER.replace("x = 20", "x = 5").replace("x = 60", "x = 20")


def test_a_component_with_a_place_of_its_own_leaves_the_layout_to_the_export() -> None:
    mine = BASE.replace("equation\n", placed("m", 0, 90) + "equation\n" + line("m.f", "a.f", (0, 90), (0, 0)))
    found = merged(BASE, mine, EXPORT)
    assert found.replace(placed("m", 0, 90), "").replace(line("m.f", "a.f", (0, 90), (0, 0)), "") == EXPORT

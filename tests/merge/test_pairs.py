"""Equations, connections and base classes that both sides replaced: one thing that they dispute, or two new ones."""

from __future__ import annotations

import gc
import time

import pytest

from urdfsync.merge import merge
from urdfsync.merge.pairs import pair
from urdfsync.modelica.tree import SyntaxTree, read_tree

CLASS = "model A\n  extends {};\nequation\n  {}\n  0 = a;\n  0 = 2 * a;\nend A;\n"
"""Of several equations for one variable, or number, none is named by it."""


@pytest.mark.parametrize(
    ("base", "mine", "generated", "contradicts"),
    [
        pytest.param("0 = b + c;", "0 = b - c;", "0 = b * c;", True, id="most words are the same"),
        pytest.param("0 = b + c;", "0 = b - c;", "", True, id="taken out by the export"),
        pytest.param("0 = b + c;", "", "0 = b - c;", True, id="taken out by the user"),
        pytest.param("0 = b + c;", "0 = b + d - e;", "0 = b + f - g;", True, id="half of the words are the same"),
        pytest.param("0 = b + c;", "0 = b - d * e;", "0 = b - f * g;", False, id="fewer words are the same"),
        pytest.param("0 = b + c;", "0 = b - d * e;", "0 = b * c;", True, id="fewer are in the user's"),
        pytest.param("b = c + d;", "", "b = c - d;", True, id="named by its variable"),
        pytest.param("connect(b, c);", "connect(b, d);", "connect(b, e);", True, id="the first end stays"),
        pytest.param("connect(b, c);", "connect(d, c);", "connect(c, e);", True, id="the second end stays"),
        pytest.param("connect(b, c);", "connect(d, e);", "connect(f, g);", False, id="no end stays"),
        pytest.param("connect(b, c);", "connect(b, d);", "", False, id="a connection taken out"),
        pytest.param("connect(b, c);", "b = d;", "connect(b, d);", False, id="an equation for a connection"),
    ],
)
def test_equations(base: str, mine: str, generated: str, contradicts: bool) -> None:
    texts = [CLASS.format("B", text) for text in (base, mine, generated)]
    found = merge(*texts, is_modelica=True)
    assert bool(found.contradictions) == contradicts
    if found.text is not None:
        assert found.text.split() == CLASS.format("B", f"{mine} {generated}").split()


@pytest.mark.parametrize(
    ("mine", "generated", "contradicts"), [("C", "D", True), ("C", "B(x = 1)", True), ("C", "C", False)]
)
def test_base_classes(mine: str, generated: str, contradicts: bool) -> None:
    texts = [CLASS.format(name, "") for name in ("B", mine, generated)]
    assert bool(merge(*texts, is_modelica=True).contradictions) == contradicts


def test_one_new_version_is_that_of_one_equation() -> None:
    """Two that the user made one, and the export two others: the second has a new version on one side alone."""
    texts = ("0 = b + c;\n  0 = b + d;", "0 = b + c + d;", "0 = b - c;\n  0 = b - d;")
    found = merge(*(CLASS.format("B", text) for text in texts), is_modelica=True)
    assert found.contradictions == (
        "equation `0.0 = b + c`: you changed the equation to `0 = b + c + d`, the export to `0 = b - c`",
        "equation `0.0 = b + d`: you removed it, the export changed it to `0 = b - d;`",
    )


def test_a_connector_may_be_called_as_other_things_are() -> None:
    """A new component is no new version of a connection to `component`."""
    texts = ("equation\n  connect(component, c);", "  Real x;", "equation\n  connect(component, d);")
    found = merge(*(f"model A\n  Pin component;\n{text}\nend A;\n" for text in texts), is_modelica=True)
    assert found.text == "model A\n  Pin component;\n  Real x;\nequation\n  connect(component, d);\nend A;\n"


def test_equations_too_many_to_compare_each_with_each_merge_by_lines() -> None:
    """A thousand that both sides replaced: nothing is lost, nothing is taken for another in silence."""
    texts = ("".join(f"  x{i} + {n} = y*{i + n};\n" for i in range(1_000)) for n in range(3))
    base, mine, generated = (f"model A\nequation\n{text}end A;\n" for text in texts)
    assert merge(base, mine, generated, is_modelica=True).contradictions == ("",), "all lines"


@pytest.mark.slow
@pytest.mark.parametrize("statement", ["extends {}{};", "equation connect(hub, {}{});"], ids=["extends", "connect"])
def test_the_time_grows_with_the_number_of_things_that_both_sides_replaced(statement: str) -> None:
    """And not with its square, which is seconds here."""
    bodies = [body("\n".join(statement.format(name, k) for k in range(3000))) for name in "abc"]
    gc.disable()  # a full collection of what thousands of tests have made takes a second
    try:
        begin = time.thread_time()
        _, mine, generated = pair(*bodies)
        assert time.thread_time() - begin < 0.5
    finally:
        gc.enable()
    assert [child.key for child in mine.children] == [child.key for child in generated.children]


def body(statements: str) -> SyntaxTree:
    tree = read_tree(f"model A\n{statements}\nend A;\n")
    child = tree.find("body") if tree else None
    assert child
    assert isinstance(child.node, SyntaxTree)
    return child.node

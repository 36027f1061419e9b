"""A class as a tree: every byte is kept, and what means nothing makes no difference."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.golden import distinct_models
from support.printer import STYLES, Style, resaved

from urdfsync.modelica.parser import parse
from urdfsync.modelica.tree import (
    KnownStatements,
    SyntaxTree,
    UnreadableError,
    comments,
    find_faults,
    is_same,
    read_tree,
)

ROOT = Path(__file__).parents[2]
STANDARD = Path.home() / ".openmodelica" / "libraries"
TEXT = """\
\ufeffwithin P; // 1
final encapsulated model A "d" /* 2 */
  import SI = Modelica.Units.SI;
  extends B(x = 1 /* 3 */, y(z = 2)); /* 4 */ Real 'a b'[2] = {u.v, w} + c.d + e; // 5
  inner replaceable C c(redeclare each model M = N(k = 1), break f) if g constrainedby H(i = 1) "h" annotation (
    Dialog(group = "a // b"), choices(choice = 1, choice = 2)); // 6
  Real x, y(start = 1);
  type T = enumeration(one "1", two) annotation (Icon);
  type S = Real(min = 0); /* 7 */ /* 8 */
  function f = der(g, x);
  model N
    Real x;
  initial equation
    x = 1;
  end N;
protected
  outer D d;
initial equation
  x = 0;
equation
  connect('a b'[1], c.f) annotation (Line(points = {{1, 2}}));
  x = 1; x = y;
  if a then b = 1; else b = 2; end if;
algorithm
  x := 1; // 9
  (a, b) := f(x);
  annotation (Documentation(info = "<p>
\\"</p>"));
end A /* 10 */; // 11
// 12"""


def tree_of(text: str) -> SyntaxTree:
    found = read_tree(text)
    assert found is not None
    return found


def body_of(text: str) -> SyntaxTree:
    body = tree_of(f"model A\n{text}\nend A;\n").find("body")
    assert body is not None
    assert isinstance(body.node, SyntaxTree)
    return body.node


@pytest.mark.parametrize("ending", ["\n", "\r\n"])
def test_every_byte_is_in_the_tree(ending: str) -> None:
    text = TEXT.replace("\n", ending)
    assert tree_of(text).text == text
    assert [*map(str, range(1, 13))] == [note.strip("/* ") for note in comments(text)]


def written(tree: SyntaxTree) -> str:
    """The text of a tree by the texts of its innermost parts."""
    pieces = [tree.opening]
    for number, child in enumerate(tree.children, start=1):
        inner = written(child.node) if isinstance(child.node, SyntaxTree) else child.node.text
        separator = tree.separator if number < len(tree.children) else ""
        pieces += [child.before, inner, child.after, separator, child.remark]
    return "".join((*pieces, tree.closing))


@pytest.mark.slow
@given(st.data())
def test_a_text_is_kept_or_not_read(data: st.DataObject) -> None:
    start = data.draw(st.integers(0, len(TEXT)))
    end = data.draw(st.integers(start, min(len(TEXT), start + 20)))
    text = TEXT[:start] + data.draw(st.text(alphabet=" \n\"'()[]{};,.=abend/*+", max_size=20)) + TEXT[end:]
    known: KnownStatements = {}
    read_tree(TEXT, known)
    assert [one.reason for one in find_faults(text, known)] == [one.reason for one in parse(text).faults]
    found = read_tree(text)
    if found is not None:
        assert found.text == text
        with contextlib.suppress(UnreadableError):
            assert written(found) == text


def test_what_is_known_hides_no_fault_beside_it() -> None:
    text = "model A\n  Real y;\n  Real x;\n  annotation (Icon);\nend A;\n"
    known: KnownStatements = {}
    read_tree(text, known)
    for new in ("  Real x;\n  Real x;\n", "  Real x;\n  annotation (Icon);\n", "equation\n  Real x;\n"):
        other = text.replace("  Real x;\n", new)
        faults = [(one.reason, one.line) for one in parse(other).faults]
        assert [(one.reason, one.line) for one in find_faults(other, known)] == faults != []


@pytest.mark.slow
@pytest.mark.parametrize("below", ["Mechanics/**", pytest.param("**", marks=pytest.mark.large)])
@pytest.mark.large  # random edits show the same of generated texts
def test_the_standard_library_and_ours_are_kept(below: str) -> None:
    folders = [Path(entry) for entry in os.environ.get("MODELICAPATH", "").split(os.pathsep) if entry]
    files = [path for folder in (*folders, STANDARD) for path in folder.glob(f"Modelica*/{below}/*.mo")]
    for path in (*files, *(ROOT / "modelica").rglob("*.mo"), *(ROOT / "tests" / "golden").rglob("*.mo")):
        text = path.read_bytes().decode("utf-8", errors="replace")
        assert written(tree_of(text)) == text, path


@pytest.mark.parametrize(
    "text",
    ["", "Real x;", "model A\nend B;", "model A\nend A;\nmodel B\nend B;", "model A\n  Real x;\n  Real x;\nend A;"],
)
def test_what_is_no_single_class_has_no_tree(text: str) -> None:
    assert read_tree(text) is None


def test_things_have_keys() -> None:
    body = body_of(
        "import SI = Modelica.SI;\nimport Modelica.Math.*;\nextends .B.C(x = 1);\nReal a, b;\nfinal model M\nend M;\n"
        "equation\n  connect(b.c, a[1]);\n  der(x) = 1;\n  a + b = c;\n  when d then\n    e = 1;\n  end when;\n"
        "initial equation\n  x = 1;\n  x = y;\nalgorithm\n  x := 1;\nequation\nannotation (Icon);"
    )
    assert [child.key for child in body.children] == [
        "import SI", "import Modelica . Math . *", "extends .B.C", "component a, b", "class M",
        "section equation 1", "connect a[1] b.c", "equation der ( x )", "equation a + b = c", "when d",
        "section initial equation 1", "initial equation equation x = 1.0", "initial equation equation x = y",
        "section algorithm 1", "statements of algorithm 1", "section equation 2", "annotation",
    ]  # fmt: skip


SAME = {
    "blanks": ("B b(x = {1, 2});", "B  b ( x={1,2} ) ;"),
    "numbers": ("B b(x = 1, y = 1e3);", "B b(x = 1.0, y = 1000);"),
    "order": ("A a;\nB b(x = 1, y = 2);", "B b(y = 2, x = 1);\nA a;"),
    "comments": ("A a;", "/* 1 */ A a; // 2"),
    "ends of a connection": ("equation\n  connect(a, b);", "equation\n  connect(b, a);"),
    "order of terms": ("Real x = a + b;", "Real x = b + a;"),
    "line ends in a string": ('A a "1\n2";', 'A a "1\r\n2";'),
    "an empty section": ("A a;", "A a;\nequation"),
}
OTHER = {
    "value": ("B b(x = 1);", "B b(x = 2);"),
    "type": ("B b;", "C b;"),
    "prefix": ("B b;", "inner B b;"),
    "blanks in a string": ('B b "1 2";', 'B b "1  2";'),
    "order of items": ("B b(x = {c, d});", "B b(x = {d, c});"),
    "visibility": ("A a;\nB b;", "A a;\nprotected\nB b;"),
    "layout": ("B b annotation (Placement(x = 1));", "B b annotation (Placement(x = 2));"),
    "order of statements": ("algorithm\na := 1;\nb := 2;", "algorithm\nb := 2;\na := 1;"),
}


@pytest.mark.parametrize(("one", "other"), SAME.values(), ids=SAME)
def test_what_means_the_same(one: str, other: str) -> None:
    assert is_same(body_of(one), body_of(other), layout=False)


@pytest.mark.parametrize("case", ["order", "order of terms"])
def test_an_order_that_means_nothing_can_be_told(case: str) -> None:
    one, other = map(body_of, SAME[case])
    assert not is_same(one, other)


@pytest.mark.parametrize(("one", "other"), OTHER.values(), ids=OTHER)
def test_what_means_something_else(one: str, other: str) -> None:
    assert not is_same(body_of(one), body_of(other))
    assert is_same(body_of(one), body_of(other), layout=False) == ("Placement" in one)


@pytest.mark.slow
@pytest.mark.parametrize("style", STYLES.values(), ids=STYLES)
def test_what_editors_change_means_nothing(style: Style) -> None:
    models = [model for models in distinct_models().values() for model in models.items()]
    for text in [text for path, text in models if path.endswith("Parameters.mo")]:
        assert is_same(tree_of(resaved(text, style)), tree_of(text))

"""Soundness: what makes no sense in a merge is found, and what a side has already is let be."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from urdfsync.merge import merge
from urdfsync.merging.soundness import flaw
from urdfsync.merging.tokens import tokens

REPOSITORY = Path(__file__).parents[2]
LIBRARY = REPOSITORY / "modelica" / "UrdfSync"
GENERATED = sorted([*LIBRARY.rglob("*.mo"), *(REPOSITORY / "tests" / "golden").rglob("*.mo")])

ARM = """\
within Plant;
model Arm "An arm"
  extends Icons.Robot;
  import SI = Modelica.Units.SI;
  import Modelica.Math.{sin, cos};

  replaceable package Medium = Water(p = 1) constrainedby Fluid "What is in it";

  parameter SI.Mass m[2](each min = 0) = {1.2, 0.8} "Masses"
    annotation (Dialog(group = "Inertia", enable = not massless));

  final parameter Boolean massless = m[end] <= -1e-9 or false;

  Body body(m = m[1], redeclare model Shape = Box(a = 1), color = {0, 0, 255}) if not massless "The body";

  Real x, y(start = if massless then 0 elseif m[1] > 1 then -1 else x.^2 .+ sum(k * m[k] for k in 1:2));

  type Mode = enumeration(off "No torque", on);

  function gain
    input Real u;
    output Real y;
  external "C" y = gain(u) annotation (Library = "m");
  end gain;

  block Delay = Blocks.Delay(redeclare each Real u[3], final T = 1);

initial equation
  x = 0;

equation
  connect(body.frame_a, body.frame_b) annotation (Line(points = {{0, 0}, {1, 1}}));
  der(x) + y = [1, 2; 3, 4] * x[:, 1];
  if massless then
    x = 1;
  else
    for i in 1:2, j loop
      assert(m[i] > 0, "Mass " + String(i), AssertionLevel.warning);
    end for;
  end if;
  when {initial(), time > 1} then
    reinit(x, pre(y));
  elsewhen sample(0, 1) then
    reinit(x, 0);
  end when "Restart";

algorithm
  (x, , y) := f(m, scale = function g(a = 1));
  while x > 0 loop
    x := x - 1;
    break;
  end while;
  x := x - 1;
  x := x - 1;
  annotation (choices(choice = 1, choice = 2), Documentation(info = "<html>
=======
</html>"));
end Arm;
"""


def changed(old: str, new: str, text: str = ARM) -> str:
    assert text.count(old) == 1, old
    return text.replace(old, new)


def test_what_modelica_allows_has_no_flaw() -> None:
    assert flaw(ARM, [ARM]) == ""
    assert flaw(ARM, []) == "has the conflict marker `=======` (line 56)"
    assert flaw(ARM.replace("=======", "---"), []) == ""


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        pytest.param("body.frame_b)", "body.frame_b", "lacks `)` before `annotation` (line 32)", id="unbalanced"),
        pytest.param("(each min = 0)", "(each min = 0]", "lacks `,` or `)` before `]` (line 9)", id="crossing"),
        pytest.param("{1, 1}}", "{1, 1}", "lacks `,` or `}` before `)` (line 32)", id="braces"),
        pytest.param('"Masses"', '"Masses', "has a string without an end (line 57)", id="string"),
        pytest.param("m[2]", "/* m[2]", "has a comment without an end (line 9)", id="comment"),
        pytest.param("x, y", "'x, y", "has a quoted name without an end (line 16)", id="quoted name"),
        pytest.param("end Arm", "end Leg", "ends `Arm` with `end Leg` (line 58)", id="another name"),
        pytest.param("  end gain;\n", "", "lacks `end gain` before `end` (line 57)", id="no end"),
        pytest.param("end Arm;\n", "end Arm;\nend Arm;\n", "has an `end` too many (line 59)", id="end twice"),
        pytest.param("end Arm;\n", "", "lacks `end Arm` before its end (line 58)", id="cut off"),
        pytest.param("end while", "end for", "lacks `end while` before `end` (line 52)", id="end of another block"),
        pytest.param("  end if;\n", "", "lacks `end if` before `algorithm` (line 46)", id="block without end"),
        pytest.param("Real u;\n", "Real u\n", "lacks `;` before `output` (line 22)", id="semicolon"),
        pytest.param("  x = 0;", "  x = 0", "lacks `;` before `equation` (line 31)", id="semicolon of an equation"),
        pytest.param("0.8}", "0.8, }", "lacks an expression before `}` (line 9)", id="comma too many"),
        pytest.param("m[1], redeclare", "m[1] redeclare", "lacks `,` or `)` before `redeclare` (line 14)", id="comma"),
        pytest.param("  import SI", "  Real Mode;\n  import SI", "declares `Mode` twice (line 19)", id="names"),
        pytest.param("x, y(", "x, x, y(", "declares `x` twice (line 16)", id="names of one declaration"),
        pytest.param(
            "Robot;", "Robot;\n extends Icons.Robot(a = 1);", "extends `Icons.Robot` twice (line 4)", id="bases"
        ),
        pytest.param("a = 1)", "a = 1, a = 2)", "sets `a` twice (line 14)", id="modifiers"),
        pytest.param(
            "equation\n  c",
            "equation\n  connect(b, a);\n  connect(a, b);\n  c",
            "connects `a` and `b` twice (line 33)",
            id="ends",
        ),
        pytest.param(
            "  x = 1;\n",
            "  x = 1;\n    y = 2;\n    x = 1;\n",
            "has the equation `x = 1` twice (line 37)",
            id="equations",
        ),
        pytest.param("(x, , y) :=", "(x, , y) =", "lacks `:=` before `=` (line 48)", id="equation in an algorithm"),
        pytest.param("end Arm", "Real z;\nend Arm", "goes on after the annotation of `Arm` (line 58)", id="after all"),
        pytest.param("  x = 0;", "<<<<<<< mine\n  x = 0;", "has the conflict marker `<<<<<<<` (line 29)", id="marker"),
        pytest.param(
            "(each min = 0)", f"(min = {50 * '('}0{50 * ')'})", "nests more than 50 deep (line 9)", id="depth"
        ),
    ],
)
def test_what_makes_no_sense_is_found(old: str, new: str, reason: str) -> None:
    text = ARM.replace(old, new, 1)
    assert text != ARM
    assert flaw(text, [ARM, ARM]) == reason
    assert flaw(text, [ARM, text]) == "", "what a side has is its author's business"


def test_a_flaw_counts_if_a_side_has_it_less_often() -> None:
    odd = changed("x, y(", "x, x, y(")
    assert flaw(odd, [odd, ARM]) == ""
    assert flaw(changed("x, x, y(", "x, x, x, y(", odd), [odd, ARM]) == "declares `x` twice (line 16)"


def test_what_is_no_modelica_hides_nothing_behind_it() -> None:
    odd = changed("  extends Icons.Robot;\n", "  extends?! Icons.Robot;\n")
    assert flaw(odd, [ARM]) == "lacks a name before `?` (line 3)"
    assert flaw(changed("x, y(", "x, x, y(", odd), [odd, odd]) == "declares `x` twice (line 16)"


def test_lines_that_both_sides_add_at_different_places_are_found() -> None:
    base = "model A\n  Real a;\n  Real b;\n  Real c;\nequation\n  a = b;\n  b = c;\n  c = 1;\nend A;\n"
    mine, generated = (base.replace(f"  Real {name};\n", f"  Real {name};\n  Real d;\n") for name in "ac")
    merged = merge(base, mine, generated).text
    assert merged is not None
    assert flaw(merged, [mine, generated]) == "declares `d` twice (line 6)"


def test_generated_texts_have_no_flaw() -> None:
    assert len(GENERATED) > 200
    found = {path.name: reason for path in GENERATED if (reason := flaw(path.read_text("utf-8"), []))}
    assert found == {}


def test_the_standard_library_has_no_flaw(modelica_library: Path) -> None:
    folders = [root / name for root in modelica_library.glob("Modelica*") for name in ("Blocks", "Mechanics")]
    paths = [path for folder in folders for path in sorted(folder.rglob("*.mo"))]
    assert len(paths) > 300
    found = {path.name: reason for path in paths if (reason := flaw(path.read_text("utf-8"), []))}
    assert found == {}


SAMPLE = [path for path in GENERATED[::3] if path.stat().st_size < 4000]
fragments = st.lists(
    st.sampled_from([*set(tokens(ARM)), '"', "'", "/*", "?", "end A", "model A", "<<<<<<< x\n", "\n"]), max_size=30
)


@given(parts=fragments, others=fragments)
def test_any_text_is_sound_if_a_side_is_the_same(parts: list[str], others: list[str]) -> None:
    text, other = " ".join(parts), " ".join(others)
    assert flaw(text, [text]) == ""
    assert flaw(text, [other, text]) == ""


@settings(max_examples=50)
@given(data=st.data())
def test_a_bracket_too_few_or_too_many_is_found(data: st.DataObject) -> None:
    text = data.draw(st.sampled_from(SAMPLE)).read_text("utf-8")
    parts = tokens(text)
    places = [place for place, token in enumerate(parts) if token in tuple("()[]{}")]
    place = data.draw(st.sampled_from(places))
    for instead in ("", 2 * parts[place]):
        damaged = "".join([*parts[:place], instead, *parts[place + 1 :]])
        assert flaw(damaged, [text, text]) != ""


@settings(max_examples=50)
@given(data=st.data())
def test_a_keyword_or_semicolon_too_few_is_found(data: st.DataObject) -> None:
    text = data.draw(st.sampled_from(SAMPLE)).read_text("utf-8")
    parts = tokens(text)
    places = [place for place, token in enumerate(parts) if token in (";", "end", "then", "loop")]
    place = data.draw(st.sampled_from(places))
    rest = "".join(parts[place + 1 :])
    assume(not rest.lstrip().startswith("annotation"))  # without the semicolon it is the annotation of what precedes it
    assert flaw("".join(parts[:place]) + rest, [text, text]) != ""

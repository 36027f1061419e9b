"""Which files of a library a text needs: made-up libraries as texts."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.checking.libraries import references

LIBRARY = {
    "L": "package L end L;",
    "L.Bodies": "within L; package Bodies end Bodies;",
    "L.Bodies.Ball": "within L.Bodies; model Ball extends Shape; Interfaces.Port p; end Ball;",
    "L.Bodies.Shape": "within L.Bodies; model Shape parameter Units.Length r; end Shape;",
    "L.Interfaces": "within L; package Interfaces import L.Bodies.Lonely; connector Port end Port; end Interfaces;",
    "L.Units": "within L; package Units type Length = Real; end Units;",
    "L.Bodies.Lonely": "within L.Bodies; model Lonely end Lonely;",
    "L.Other": "within L; model Other end Other;",
}


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("Modelica.Units.SI.Length r;", {"Modelica.Units.SI.Length"}),
        ("extends Modelica . Icons\n .Package;", {"Modelica.Icons.Package"}),
        ("import SI = Modelica.Units.SI; SI.Length r;", {"Modelica.Units.SI", "Modelica.Units.SI.Length"}),
        ("import Modelica.Blocks; Blocks.Sources.Sine s;", {"Modelica.Blocks", "Modelica.Blocks.Sources.Sine"}),
        ("import Modelica.Math.{sin, c = cos}; Real x = c(1);", {"Modelica.Math.cos", "Modelica.Math.sin"}),
        ("import Modelica.Math.*;", {"Modelica.Math.*"}),
        ("import M = Modelica; M.Blocks.Sources.Sine s;", {"Modelica.Blocks.Sources.Sine"}),
        ("import Modelica; MyModelica.A a; Modelica_.B b; a.Modelica.C c;", set()),
        ('Real x "Modelica.Blocks.A \\" Modelica.Blocks.B"; // Modelica.Blocks.C\n /* Modelica.D */', set()),
        ("Real 'a\"b'; Modelica.Icons.Package p; Real 'c\"d';", {"Modelica.Icons.Package"}),
    ],
)
def test_names_of_the_standard_library_are_seen(text: str, names: set[str]) -> None:
    assert references.mentioned([text]) == names


def test_an_import_counts_in_all_texts() -> None:
    texts = ["package P import Modelica.Blocks; end P;", "within P; model M Blocks.Sources.Sine s; end M;"]
    assert "Modelica.Blocks.Sources.Sine" in references.mentioned(texts)


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("Pumps.Small p; extends Tanks . Round;", {"Pumps", "Tanks"}),
        (".Pumps.Small p;", {"Pumps"}),
        ("import Pumps; import T = Tanks; import V = Valves.Ball; import Pipes.{Bend, Tee}; import lib.*;",
         {"Pumps", "Tanks", "Valves", "Pipes", "lib"}),
        ("arm.frame_a; a[1].B.c; 'x y'.B.c; f(1) . B.c;", set()),
        ('parameter String s = "Pumps.Small"; // Pumps.Small\n/* import Pumps; */', set()),
        ("Real Pumps;", set()),
    ],
)  # fmt: skip
def test_other_libraries_are_what_names_begin_with(text: str, names: set[str]) -> None:
    assert references.beginnings([text]) == names


@pytest.mark.parametrize(
    ("name", "entry"),
    [
        ("L.Bodies.Ball", "L.Bodies.Ball"),
        ("L.Units.Length", "L.Units"),
        ("L.Nothing.At.All", "L"),
        ("L", "L"),
        ("Elsewhere.Ball", ""),
    ],
)
def test_a_class_is_in_the_file_of_the_nearest_class_around_it(name: str, entry: str) -> None:
    assert references.entry_of(name, LIBRARY) == entry


def test_files_bring_those_that_they_refer_to() -> None:
    found = references.closure(["L.Bodies.Ball"], LIBRARY, LIBRARY.__getitem__)
    assert found == LIBRARY.keys() - {"L.Other"}


def test_comments_and_strings_bring_nothing() -> None:
    library = LIBRARY | {"L.Bodies.Shape": 'model Shape "see L.Other" /* L.Other */ end Shape; // L.Other'}
    assert "L.Other" not in references.closure(["L.Bodies.Shape"], library, library.__getitem__)


@pytest.mark.parametrize(
    "text",
    [
        "import O = L.Other; O o;",
        "import L.Other; Other o;",
        "import L.{Other}; Other o;",
        "import L.*; Other o;",
        "Other o;",
        "L.Other o;",
    ],
)
def test_every_way_to_name_a_class_brings_its_file(text: str) -> None:
    library = LIBRARY | {"L.Bodies.Ball": f"within L.Bodies; model Ball {text} end Ball;"}
    assert "L.Other" in references.closure(["L.Bodies.Ball"], library, library.__getitem__)


@given(st.dictionaries(st.sampled_from("ABCDEF"), st.lists(st.sampled_from("ABCDEF"), max_size=3), min_size=1))
def test_a_closure_is_closed(graph: dict[str, list[str]]) -> None:
    library = {"L": ""} | {f"L.{name}": " ".join(f"L.{other} x;" for other in others) for name, others in graph.items()}
    start = f"L.{min(graph)}"
    found = references.closure([start], library, library.__getitem__)
    assert {start, "L"} <= found <= library.keys()
    for entry in found:
        assert references.closure([entry], library, library.__getitem__) <= found

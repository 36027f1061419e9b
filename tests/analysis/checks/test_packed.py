"""Libraries as one text: what a compiler reads is the same, and each line is found in its file again."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync.analysis.checks.libraries import library_texts
from urdfsync.analysis.checks.packed import class_texts, names_in, original_place, packed
from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import declared

FILES = {
    "package.mo": """// A library
within ;
package Lib "Said (" + " in two"
  extends Icon;
  annotation (version="1.0", Documentation(info="<p>a) \\" b</p>
"));
end Lib;
""",
    "Tank.mo": """within Lib; /* one ( */
model Tank
  Real 'Icon(' annotation (Placement(transformation(
    extent={{-1, -1}, {1, 1}})), Evaluate=true);
  Icon Line(x = 1);
  annotation (Icon(graphics={Line(points={{0, 0}})}), smoothOrder=2);
end Tank;
""",
    "Parts/package.mo": "within Lib;\npackage Parts\nend Parts;\n",
    "Parts/Lid.mo": "within Lib.Parts;\n\nmodel Lid\n  Real lid;\nend Lid;\n",
    "Notes/read.mo": "no part of it",
}


@pytest.fixture
def library(tmp_path: Path) -> Path:
    for name, text in FILES.items():
        file = tmp_path / "Lib" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    return tmp_path / "Lib"


def whole(library: Path) -> str:
    """The text of a library with all classes."""
    taken_apart = class_texts("Lib", library_texts(library))
    names = {name for piece in taken_apart for name in piece.owner.split(".")}
    return packed({"Lib": taken_apart}, names)["Lib"]


def test_all_classes_are_where_they_were(library: Path) -> None:
    text = whole(library)
    stored = parse(text)
    assert not stored.faults
    assert {".".join(found.path) for found in declared(stored.classes)} == {
        *("Lib", "Lib.Parts", "Lib.Parts.Lid", "Lib.Parts.Lid.lid"),
        *("Lib.Tank", "Lib.Tank.'Icon('", "Lib.Tank.Line"),
    }
    for kept in ('version="1.0"', "Evaluate=true", "Line(x = 1)", "smoothOrder=2", "extends Icon", "<p>a)"):
        assert kept in text
    assert "within" not in text
    assert "no part" not in text


def test_each_line_is_found_in_its_file(library: Path) -> None:
    text = whole(library)
    for word, place in {
        "extends Icon": ("package.mo", 4),
        "end Lib": ("package.mo", 7),
        "Icon Line": ("Tank.mo", 5),
        "Real lid": ("Parts/Lid.mo", 4),
        "end Parts": ("Parts/package.mo", 3),
    }.items():
        (line,) = [number for number, each in enumerate(text.split("\n"), 1) if word in each]
        assert original_place(text, line) == place


def test_a_library_may_be_one_file(tmp_path: Path) -> None:
    (tmp_path / "Lib.mo").write_text("package Lib\nend Lib;\n")
    text = whole(tmp_path / "Lib.mo")
    assert original_place(text, len(text.splitlines())) == ("Lib.mo", 2)


PACKAGE = """package Lib
  partial package Tanks
    type Level = Real(unit = "m; end Lib;");
    model Tank // end Tank;
      record Tank end Tank;
      Level level = Math.height(1);
      outer replaceable model Lid = Icon;
    end Tank;
    constant Real most = Pi.half;
  end Tanks;
  package Math
    function height input Real x; external "C"; end height;
    protected function 'end width' end 'end width';
    replaceable function width
      package Inner end Inner;
    end width;
  end Math;
  operator record Complex operator '+' end '+'; end Complex;
  package Pi constant Real half = 1.5; end Pi; model Last end Last;
end Lib;
"""


@pytest.mark.parametrize(
    ("named", "kept"),
    {
        "": "",
        "Tanks": "Tanks Pi",
        "Lib.Tanks.Tank": "Tanks Pi Level Tank Math height width",
        "Tank": "",
        "Math": "Math width",
        "Complex": "Complex",
        "import Lib.*; Last": "Last",
    }.items(),
)
def test_classes_are_kept_that_are_reached_by_names(named: str, kept: str) -> None:
    text = packed({"Lib": class_texts("Lib", {"Lib.mo": PACKAGE.encode()})}, names_in(named))["Lib"]
    stored = parse(text)
    assert not stored.faults
    found = {".".join(each.path[1:]).rpartition(".")[2] for each in declared(stored.classes)}
    assert found & {*"Tanks Level Tank Math height width 'end width' Complex Pi Last".split(" ")} == {*kept.split()}
    lines = {line: number for number, line in enumerate(PACKAGE.split("\n"), 1)}
    assert all(
        original_place(text, number) == ("Lib.mo", lines[line])
        for number, line in enumerate(text.split("\n"), 1)
        if line in lines and line.strip()
    )


HEADS = {
    "a comment below `within`": "within ;\n// This package is free\npackage Lib\n",
    "a comment over two lines": "within ;\n/* This package is\nfree */ package Lib\n",
    "a comment before the string": 'package Lib // c\n "doc" + "more"\n',
    "a comment before the name": "package /* c */ Lib\n",
    "a comment in `within`": "within /* a; b */ ;\npackage Lib\n",
}


@pytest.mark.parametrize("head", HEADS.values(), ids=HEADS)
def test_files_of_a_package_are_in_it_whatever_stands_around_its_name(head: str) -> None:
    texts = {"package.mo": f"{head}constant Real x = 1; end Lib;".encode(), "A.mo": b"within Lib; model A end A;"}
    stored = parse(packed({"Lib": class_texts("Lib", texts)}, ["A"])["Lib"])
    assert not stored.faults
    assert {".".join(each.path) for each in declared(stored.classes)} == {"Lib", "Lib.A", "Lib.x"}


@pytest.mark.parametrize("text", [
    "package Lib replaceable record R Real x; function equalityConstraint end equalityConstraint; end R; end Lib;",
    "package Lib replaceable operator record R operator function '+' end '+'; end R; end Lib;",
    "package Lib operator record R /* c */ Real x; operator function '+' end '+'; end R // c\n; end Lib;",
    "package Lib model extends R Real x; end R; end Lib;",
])  # fmt: skip
def test_functions_that_are_called_without_their_names_are_kept(text: str) -> None:
    kept = packed({"Lib": class_texts("Lib", {"Lib.mo": text.encode()})}, ["R"])["Lib"]
    assert kept.replace("// urdfsync: Lib.mo:1", "").split() == text.split()


def test_lines_behind_a_class_that_is_left_out_keep_their_file() -> None:
    texts = {
        "package.mo": b"package Lib\n  model X\n  end X;\n  constant Real y = 1;\nend Lib;",
        "A.mo": b"model A end A;",
    }
    lines = packed({"Lib": class_texts("Lib", texts)}, ["A"])["Lib"].split("\n")
    (line,) = [number for number, each in enumerate(lines, 1) if "Real y" in each]
    assert original_place("\n".join(lines), line) == ("package.mo", 4)


@pytest.mark.parametrize(
    "text", [b"", b"// nothing", b"within ;", b"package Foo end Foo;", b'package Lib "caf\xe9" end Lib;']
)
def test_a_damaged_library_is_left_to_the_compiler(text: bytes) -> None:
    assert isinstance(packed({"Lib": class_texts("Lib", {"Lib.mo": text})}, ["Foo"])["Lib"].encode(), bytes)
    assert packed({"Lib": class_texts("Lib", {})}, [])["Lib"] == ""

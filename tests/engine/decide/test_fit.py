"""Whether what the user wrote fits the package: all commands say the same, and none is green on what is broken.

`tests/scenarios/fit.txt` has what is right, and how findings come and go.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
import support.urdfs as urdfs
from support.commands import Execute
from support.git import Repository
from support.networks import edit

ARM = Path("modelica/Arm")
ELBOW, MODEL = ARM / "Joints/Elbow.mo", ARM / "Arm.mo"
CONFIG = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n'


def write_source(joint: str = "elbow") -> None:
    links = (urdfs.link("base", 1.0), urdfs.link("limb", 2.0))
    Path("arm.urdf").write_text(urdfs.robot(*links, urdfs.joint(joint, "continuous", "base", "limb")))


@pytest.fixture
def arm(folder: Path, execute: Execute) -> Path:
    """An arm that was built."""
    Path("urdfsync.toml").write_text(CONFIG)
    write_source()
    execute("build")
    return folder


def undone_merge(execute: Execute) -> None:
    edit(MODEL, "equation", "  Real mine = 1;\n\nequation")
    write_source("wrist")
    execute("build", "--merge")
    execute("resolve", str(MODEL), "--undo", code=None)
    execute("resolve", str(MODEL), "--keep", code=None)


def make_folder(_: Execute) -> None:
    """Make a folder of a class, beside the file that it has."""
    ELBOW.with_suffix("").mkdir()
    (ELBOW.with_suffix("") / "package.mo").write_text(ELBOW.read_text())


BROKEN: dict[str, tuple[Callable[[Execute], object], str]] = {
    "a joint that has another name now": (
        lambda _: edit(MODEL, "connect(elbow.frame_b", "connect(wrist.frame_b"),
        "Arm has no `wrist`",
    ),
    "a syntax error": (lambda _: edit(ELBOW, "\nequation", "\nequatoin"), "the file lacks"),
    "an empty file": (lambda _: ELBOW.write_text(""), "the file holds no class"),
    "another class": (
        lambda _: ELBOW.write_text("within Arm.Joints;\nmodel Elbo\nend Elbo;\n"),
        "the class is called `Elbo`, but its file `Elbow`",
    ),
    "another within": (lambda _: edit(ELBOW, "within Arm.Joints", "within Arm"), "the file says `within Arm;`"),
    "nowhere": (
        lambda _: edit(ELBOW, "extends UrdfSync.Icons", "extends Nowhere.To.Be;\n  extends UrdfSync.Icons"),
        "there is no class `Nowhere.To.Be`; if `Nowhere` is a library, name it in `uses`",
    ),
    "itself": (
        lambda _: edit(ELBOW, "extends UrdfSync.Icons", "extends Elbow;\n  extends UrdfSync.Icons"),
        "Elbow extends itself",
    ),
    "a merge that was undone": (undone_merge, "there is no class `Joints.Elbow`"),
    "a connector": (lambda _: edit(MODEL, "elbow.frame_b", "elbow.frame_c"), "Elbow has no `frame_c`"),
    "a middle part": (lambda _: edit(ELBOW, "UrdfSync.Interfaces.", "UrdfSync.Interface."), "did you mean `UrdfSync.I"),
    "what another file lacks": (
        lambda _: edit(MODEL, "elbowAxis", "elbowShaft"),
        "it has no `elbowAxis`, which modelica/Arm/ArmRun.mo:",
    ),
    "another kind of class": (lambda _: edit(ELBOW, "model Elbow", "function Elbow"), "but used as `model`"),
    "a class with two files": (make_folder, "`Elbow` has two files, this one and Joints/Elbow/package.mo"),
    "package.order": (lambda _: edit(ARM / "package.order", "Arm\n", "Arm\nNosuch\n"), "`Nosuch` is named, but the"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_nothing_is_green_on_what_is_broken(
    arm: Path, execute: Execute, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    make, words = BROKEN[name]
    make(execute)
    repository = Repository(arm, monkeypatch)
    repository.git("add", "-A")
    commands = "status", "build --check", "hook check", "build -q", "build --dry-run", "build", "build --full", "status"
    for command in commands:
        printed = execute(*command.split(), code=3)
        assert words in printed.err, command
        assert "error: " in printed.err
        assert "broken" in printed.lines[0]
    (robot,) = execute("build", "--format=json", code=3).json["results"]
    assert (robot["is_broken"], robot["in_step"]) == (True, False)


def test_statements_as_generated_are_looked_at_where_a_declaration_is_gone(arm: Path, execute: Execute) -> None:
    """Nobody touched the connections that need it."""
    text = MODEL.read_text()
    block = text[text.index("  replaceable Joints.Elbow elbow") :].partition(";\n")[0]
    for without in ("", f"  /* off;\n{block};\n  */\n"):
        MODEL.write_text(text.replace(f"{block};\n", without))
        assert "Arm has no `elbow`" in execute("build", code=3).err
    MODEL.write_text(text.replace("  extends UrdfSync.Robots.PartialStationaryRobot;\n", ""))
    assert "it has no `frame_a`, which modelica/Arm/ArmRun.mo:" in execute("build", code=3).err
    MODEL.write_text(text)
    edit(ELBOW, "PartialRevoluteJoint", "PartialLink")
    assert "Elbow has no `frame_b`" in execute("build", code=3).err


FUNCTION = """
  record Pair
    Real first;
  end Pair;
  function f
    extends Modelica.Icons.Function;
    input Real u;
    output Real y = u;
  end f;
  function open
    extends Modelica.Math.Interfaces.partialFunction;
  end open;
  operator record Number
    Real x;
    operator 'constructor'
      function fromReal
        input Real value;
        output Number number = Number(x = value);
      end fromReal;
    end 'constructor';
  end Number;
  Number number = Number(value = 2);
  Complex z = Complex(re = 1, im = ModelicaServices.Machine.eps);
  Pair pair = Pair(first = f(u = 1) + open(other = 1));

equation"""


def test_arguments_have_names_that_a_function_or_record_has(arm: Path, execute: Execute) -> None:
    edit(MODEL, "\nequation", FUNCTION)
    assert execute("build").err == ""
    edit(MODEL, "f(u", "f(v")
    edit(MODEL, "Pair(first", "Pair(frist")
    printed = execute("build", code=3).err
    assert "f has no `v`" in printed
    assert "Pair has no `frist`; did you mean `first`?" in printed

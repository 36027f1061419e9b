"""Whether what the user wrote fits the package: all commands say the same, and none is green on what is broken."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
import support.urdfs as urdfs
from support.commands import Execute
from support.git import Repository
from support.networks import edit
from support.replay import contents

ARM = Path("modelica/Arm")
ELBOW, MODEL = ARM / "Joints/Elbow.mo", ARM / "Arm.mo"
CONFIG = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n'


def write_source(joint: str = "elbow", mass: float = 1.0) -> None:
    links = (urdfs.link("base", mass), urdfs.link("limb", 2.0))
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
    for command, code in (
        (["status"], 1),
        (["build", "--check"], 1),
        (["hook", "check"], 1),
        (["build", "-q"], 3),
        (["build", "--dry-run"], 1),
        (["build"], 3),
        (["build", "--full"], 3),
        (["status"], 1),
    ):
        printed = execute(*command, code=code)
        assert words in printed.err, command
        assert "error: " in printed.err
        assert "broken" in printed.lines[0]
    (robot,) = execute("build", "--format=json", code=3).json["results"]
    assert (robot["is_broken"], robot["in_step"]) == (True, False)


def test_what_is_mended_is_in_step(arm: Path, execute: Execute) -> None:
    edit(MODEL, "equation", "  Real mine = wrong;\n\nequation")
    execute("build", code=3)
    edit(MODEL, "mine = wrong", "mine = 1")
    for command in (["build"], ["build", "--check"], ["status"]):
        assert execute(*command).err == ""


def test_a_class_whose_file_waits_is_no_misspelled_one(arm: Path, execute: Execute) -> None:
    edit(MODEL, "equation", "  Real mine = 1;\n\nequation")
    edit(ELBOW, 'from link \\"base\\"', 'from link \\"desk\\"')
    links = (urdfs.link("base", 1.0), urdfs.link("limb", 2.0), urdfs.link("limp", 4.0))
    joints = (urdfs.joint("elbow", "continuous", "limp", "limb"), urdfs.joint("swing", "continuous", "base", "limp"))
    Path("arm.urdf").write_text(urdfs.robot(*links, *joints))
    hint = execute("status", code=3).lines[-1]
    assert hint.endswith("(or --keep, --take); --merge settles 1 of 2")
    found = execute("resolve", "--all", "--merge", code=3).words
    assert "there is no class `Links.Limp`; settle the conflicts: the file of this class waits until then" in found
    execute("resolve", "--all", "--merge", "--prefer", "mine")


@pytest.mark.parametrize(("class_", "meant"), [("", "Arm8.Arm8"), ('class = "Bot"\n', "Arm8.Bot")])
def test_a_renamed_package_is_told_in_models_until_they_are_saved(
    arm: Path, execute: Execute, class_: str, meant: str
) -> None:
    """Also after two new names; later builds were silent."""
    Path("Mine.mo").write_text(f"model Mine\n  Arm.{'Bot' if class_ else 'Arm'} robot;\nend Mine;\n")
    for package in ("Arm", "Arm7", "Arm8"):
        Path("urdfsync.toml").write_text(f"{CONFIG.replace('Arm', package)}{class_}")
        execute("build")
    for command in ("build", "status", "diff", "build --check"):
        assert f"use `{meant}` instead [unresolved]" in execute(*command.split()).words
    Path("Mine.mo").write_text(f"model Mine\n  {meant} robot;\nend Mine;\n")
    assert "unresolved" not in execute("build").words


def test_a_finding_holds_nothing_back(arm: Path, execute: Execute) -> None:
    edit(ELBOW, "\nequation", "\n  Real mine = wrong;\n\nequation")
    write_source(mass=3)
    assert "Elbow has no `wrong`" in execute("build", code=3).err
    assert "mass = 3" in (ARM / "Links/BaseParameters.mo").read_text()


def test_models_of_the_users_are_warnings_as_long_as_they_are_true(arm: Path, execute: Execute) -> None:
    Path("Cell.mo").write_text("model Cell\n  Arm.Arm robot;\n  Real x = robot.elbw.phi;\nend Cell;\n")
    Path("modelica/Arm/Own.mo").write_text("within Arm;\nmodel Own\n  Links.Gone gone;\nend Own;\n")
    for command in (["build"], ["status"], ["build", "--check"], ["build", "--dry-run"]):
        errors = execute(*command).errors
        assert "Cell.mo:3: warning: Arm has no `elbw`; did you mean `robot.elbow.phi`? [unresolved]" in errors
        assert any("Own.mo:3: warning: there is no class `Links.Gone`" in one for one in errors)


def test_a_library_that_uses_names_may_have_anything(arm: Path, execute: Execute) -> None:
    cell = "model Cell\n  extends Plant.Cells.Cell;\n  Arm.Arm robot;\n  Real y = x;\n{}end Cell;\n"
    Path("Cell.mo").write_text(cell.format(""))
    assert "there is no class `Plant.Cells.Cell`; if `Plant` is a library" in execute("build").err
    Path("Cell.mo").write_text(cell.format('  annotation (uses(Plant(version="1.0.0")));\n'))
    assert execute("build").err == ""


def test_what_an_edited_file_uses_of_another_is_looked_at_whichever_changes(arm: Path, execute: Execute) -> None:
    edit(MODEL, "equation", "  Real mine = elbow.extra;\n\nequation")
    edit(ELBOW, "\nequation", "\n  Real extra = 1;\n\nequation")
    assert execute("build").err == ""
    edit(ELBOW, "Real extra", "Real other")
    assert "Elbow has no `extra`" in execute("build", code=3).err
    edit(ELBOW, "Real other", "Real extra")
    assert execute("build").err == ""
    (arm / ELBOW).rename("Elbow.mo")
    assert "Elbow has no `extra`" in execute("build", code=3).err


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


def test_an_edit_with_a_fault_moves_with_its_element_and_stays_broken(arm: Path, execute: Execute) -> None:
    edit(ELBOW, "\nequation", "\n  Real mine = revolute.nothing + nowhere;\n\nequation")
    assert "Elbow has no `nowhere`" in execute("build", code=3).err
    write_source("wrist")
    printed = execute("build", code=3)
    assert "Wrist has no `nowhere`" in printed.err
    assert "conflict" not in printed.out
    assert "nowhere" in (ARM / "Joints/Wrist.mo").read_text()


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


def test_the_kind_of_a_class_may_be_another_legal_one(arm: Path, execute: Execute) -> None:
    edit(ELBOW, "model Elbow", "block Elbow")
    edit(ARM / "Links/Base.mo", "model Base", "class Base")
    edit(ARM / "Links/BaseParameters.mo", "record Base", "operator record Base")
    assert execute("build").err == ""


def test_a_class_may_be_partial_where_the_package_instantiates_another(arm: Path, execute: Execute) -> None:
    edit(ELBOW, "model Elbow", "partial model Elbow")
    assert "`Elbow` is partial, but modelica/Arm/Arm.mo:" in execute("build", code=3).err
    (ARM / "Joints/Soft.mo").write_text("within Arm.Joints;\nmodel Soft\n  extends Elbow;\nend Soft;\n")
    edit(MODEL, "replaceable Joints.Elbow elbow", "replaceable Joints.Soft elbow")
    assert "partial" not in execute("build").err


def test_package_order_may_name_what_is_there(arm: Path, execute: Execute) -> None:
    edit(ARM / "package.mo", "  annotation", "  constant Real pi = 3;\n  annotation")
    (ARM / "Own.mo").write_text("within Arm;\nmodel Own\nend Own;\n")
    edit(ARM / "package.order", "Arm\n", "pi\nArm\nOwn\n")
    assert execute("build").err == ""
    (ARM / "Own.mo").unlink()
    assert "`Own` is named" in execute("status", code=1).err
    write_source("wrist")
    edit(ARM / "package.order", "Own\n", "")
    assert "order-unknown" not in execute("build").err


def test_an_old_fault_stops_no_merge_if_the_package_file_is_missing(arm: Path, execute: Execute) -> None:
    """Without `package.mo` no name is looked up: the fault seemed to be new, and a second build merged."""
    edit(MODEL, "\nequation", "\n  Real mine = missing.x;\nequation")
    assert execute("build", code=3).words.startswith("arm: broken")
    (ARM / "package.mo").unlink()
    write_source("wrist")
    printed = execute("build", "--merge", code=3)
    assert "1 restored because you deleted it, 2 deleted, 1 merged with your edits" in printed.words
    built = contents(arm)
    assert "Arm has no `missing`" in execute("build", "--merge", code=3).words
    assert contents(arm) == built


def test_a_class_that_became_a_folder_is_listed_by_its_path(arm: Path, execute: Execute) -> None:
    make_folder(execute)
    ELBOW.unlink()
    edit(ELBOW.with_suffix("") / "package.mo", "\nequation", "\n  Real mine = 1;\n\nequation")
    execute("build")
    assert f"edited     {ELBOW.with_suffix('')}/package.mo" in execute("status").out

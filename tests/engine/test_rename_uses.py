"""Models of the user's follow what the source renames: which texts change, and which stay."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute
from support.files import unchanged
from support.old_names import CELL, COMMAND, CONFIG, NAMES, NO_OLD_NAMES, RENAMED, make_user, texts, write_source


@pytest.fixture
def user(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Path:
    return make_user(tmp_path, monkeypatch, execute)


def test_what_the_next_build_renames_is_renamed_in_models_and_built(user: Path, execute: Execute) -> None:
    printed = execute(*COMMAND, "--yes")
    assert printed.lines[1:7] == [
        "    +++ Cell.mo",
        "    @@ -3,7 +3,7 @@",
        '       Arm.Arm robot; Real elbow = 1 "elbow";',
        "     equation",
        "    -  connect(robot.elbowAxis, motor); // robot.elbowAxis",
        "    +  connect(robot.wristAxis, motor); // robot.elbowAxis",
    ]
    assert "7 lines in 3 files written" in printed.lines
    assert "Arm has no" not in printed.err
    assert "there is no class" not in printed.err
    assert texts() == RENAMED
    assert Path("modelica/Arm/Joints/Wrist.mo").exists()
    execute("build", "--check")
    assert NO_OLD_NAMES in execute(*COMMAND).err


def test_bytes_that_are_no_utf8_and_marks_of_the_encoding_stay(user: Path, execute: Execute) -> None:
    around = b"\xef\xbb\xbf", b"// \xe9t\xe9 \xe2\x82 robot.elbowAxis\r\n"
    Path("Cell.mo").write_bytes(CELL.encode().join(around))
    execute(*COMMAND, "--yes")
    assert Path("Cell.mo").read_bytes() == RENAMED["Cell.mo"].encode().join(around)


def test_a_robot_in_conflict_keeps_its_names_and_its_users(user: Path, execute: Execute) -> None:
    robot = Path("modelica/Arm/Arm.mo")
    robot.write_text(robot.read_text().replace("equation", "  Real mine;\n\nequation", 1))
    with unchanged(user.parent):
        printed = execute(*COMMAND, "--yes", code=3)
    assert "files of `arm` are in conflict, so its names stay as they are" in printed.words


CART = """\
model Cart
  extends Modelica.Mechanics.MultiBody.Parts.BodyShape;
  Arm.Arm wrist;
  Real speed = elbow.w;
  Real own = wrist.elbow.w;
end Cart;
"""


@pytest.mark.parametrize("is_built", [False, True])
def test_a_name_that_may_come_from_a_library_is_not_the_robots(user: Path, execute: Execute, is_built: bool) -> None:
    """Behind the robot it is."""
    Path("Cart.mo").write_text(CART)
    if is_built:
        execute("build")
    found = execute(*COMMAND, *(["elbow=wrist"] if is_built else []), "--yes")
    assert Path("Cart.mo").read_text() == CART.replace("wrist.elbow", "wrist.wrist")
    assert "stays" not in found.words


def test_a_name_that_the_user_declares_is_not_the_robots(user: Path, execute: Execute) -> None:
    """`elbow` meant nothing before, and `wrist` is no part of a robot."""
    own = "model Own\n  Arm.Arm wrist;\n  Real angle = elbow.phi;\nend Own;\n"
    Path("Own.mo").write_text(own)
    execute("build")
    assert "`elbow` in `elbow.phi` stays" in execute(*NAMES, "--yes").words
    assert Path("Own.mo").read_text() == own


def test_several_names_in_one_line_are_known_from_before(user: Path, execute: Execute) -> None:
    """They begin elsewhere once the first has been replaced by a longer one."""
    write_source("shoulder")
    mine = "model Mine\n  extends Arm.Links.Mine; {0} a(elbow(c = 1)); Real b = {1}.phi; Real x = {1}.w;\nend Mine;\n"
    Path("Mine.mo").write_text(mine.format("Arm.Joints.Elbow", "elbow"))
    execute(*COMMAND, "--yes")
    assert Path("Mine.mo").read_text() == mine.format("Arm.Joints.Shoulder", "shoulder")


@pytest.mark.parametrize(
    "clause", ["Joints.Elbow", "Joints.{Elbow, Swing}", "Joints.{Swing, mine = Elbow}", "Joints.*"]
)
def test_imported_classes_are_renamed(user: Path, execute: Execute, clause: str) -> None:
    short = "mine" if "mine" in clause else "Elbow"
    model = f"model Imports\n  import Arm.{clause};\n  {short} one;\nend Imports;\n"
    Path("Imports.mo").write_text(model)
    assert "--rename-uses elbow=wrist" in execute("build").words
    execute(*NAMES, "--yes")
    assert Path("Imports.mo").read_text() == model.replace("Elbow", "Wrist")


def test_a_package_that_moves_into_another_one_is_left_to_the_user(user: Path, execute: Execute) -> None:
    write_source("elbow")
    Path("modelica/Arm/Links/Mine.mo").unlink()
    Path("../plant/Bench.mo").unlink()
    Path("urdfsync.toml").write_text(CONFIG.replace('"Arm"', '"Plant.Robot"\ncreate_parents = true'))
    printed = execute("build").words
    assert "use `Plant.Robot` instead" in printed
    assert "--rename-uses" not in printed
    left = "Cell.mo:3: warning: `Arm` in `Arm.Arm` stays: `Robot` means nothing there; "
    assert left in execute(*COMMAND, "Arm=Robot", "--yes").words

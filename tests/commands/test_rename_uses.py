"""`urdfsync resolve --rename-uses`: models of the user's follow what the source renames."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
import support.urdfs as urdfs
from support.commands import Execute
from support.crashes import Operation, before_each
from support.files import unchanged

CONFIG = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\nusers = ["../plant"]\n'
CELL = """\
within;\r
model Cell "robot.elbowAxis"\r
  Arm.Arm robot; Real elbow = 1 "elbow";\r
equation\r
  connect(robot.elbowAxis, motor); // robot.elbowAxis\r
  connect(
    robot.
      elbowSupport, housing);
end Cell;\r
"""
MINE = """\
within Arm.Links;
model Mine
  extends Arm(redeclare Joints.Elbow elbow(checkLimits = false));
  Joints.ElbowParameters numbers;
  Real angle = elbow.phi;
end Mine;
"""
BENCH = "model Bench\n  Arm.Links.Mine mine(elbow(fixedStart = true));\n  Real angle = mine.elbow.phi;\nend Bench;\n"
FILES = {"Cell.mo": CELL, "../plant/Bench.mo": BENCH, "modelica/Arm/Links/Mine.mo": MINE}
RENAMED = {
    "Cell.mo": CELL.replace("connect(robot.elbowAxis", "connect(robot.wristAxis").replace("elbowS", "wristS"),
    "../plant/Bench.mo": BENCH.replace("elbow", "wrist"),
    "modelica/Arm/Links/Mine.mo": MINE.replace("elbow", "wrist").replace("Elbow", "Wrist"),
}
NONE = "none of your models uses a name that is known to have another one now"
COMMAND = ("resolve", "--rename-uses")
NAMES = (*COMMAND, "elbow=wrist")


def write_source(joint: str, other: str = "swing") -> None:
    joints = (urdfs.joint(joint, "continuous", "base", "limb"), urdfs.joint(other, "revolute", "limb", "hand"))
    Path("arm.urdf").write_text(urdfs.robot(*(urdfs.link(name, 1.0) for name in ("base", "limb", "hand")), *joints))


def texts() -> dict[str, str]:
    return {path: Path(path).read_bytes().decode() for path in FILES}


@pytest.fixture
def user(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Path:
    """A project whose joint `elbow` is used in models around the package and in it; now the source calls it `wrist`.

    The user trusts it with what lies outside of its folder.
    """
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "settings"))
    trusted = tmp_path / "settings/urdfsync/trusted.toml"
    trusted.parent.mkdir(parents=True)
    trusted.write_text(f"folders = ['{tmp_path / 'cell'}']\n")
    project = tmp_path / "cell"
    project.mkdir()
    (tmp_path / "plant").mkdir()
    monkeypatch.chdir(project)
    Path("urdfsync.toml").write_text(CONFIG)
    write_source("elbow")
    execute("build")
    for path, text in FILES.items():
        Path(path).write_bytes(text.encode())
    write_source("wrist")
    return project


class Terminal:
    """Somebody who answers, and saves one of the files before."""

    def __init__(self, words: str, meanwhile: str = "") -> None:
        self._words, self._meanwhile = words, meanwhile

    def isatty(self) -> bool:
        return True

    def readline(self) -> str:
        if self._meanwhile:
            Path(self._meanwhile).write_text("saved")
        return self._words


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
    assert NONE in execute(*COMMAND).err


def test_what_an_earlier_build_renamed_is_renamed_by_its_names(user: Path, execute: Execute) -> None:
    hint = "`urdfsync resolve --rename-uses elbow=wrist` shows the lines, and writes them if you agree [rename-uses]"
    assert f"note: your files can get the new names; {hint}" in execute("build").words
    assert "Write 7 lines" not in execute(*COMMAND, code=2).out, "they are known until the next build that writes"
    assert "Arm has no `elbowAxis`; use `wristAxis` instead" in execute("status").err
    write_source("wrist", "push")
    execute("build")
    Path("modelica/Arm/Arm.mo").touch()
    note = f"{NONE}; give names that an earlier build renamed: --rename-uses OLD=NEW"
    assert f"note: {note} [no-old-names]" in execute(*COMMAND).errors
    with unchanged(user / "modelica/Arm/Joints"):
        assert execute(*NAMES, "--yes").lines[-1] == "7 lines in 3 files written"
    assert texts() == RENAMED


def test_bytes_that_are_no_utf8_and_marks_of_the_encoding_stay(user: Path, execute: Execute) -> None:
    around = b"\xef\xbb\xbf", b"// \xe9t\xe9 \xe2\x82 robot.elbowAxis\r\n"
    Path("Cell.mo").write_bytes(CELL.encode().join(around))
    execute(*COMMAND, "--yes")
    assert Path("Cell.mo").read_bytes() == RENAMED["Cell.mo"].encode().join(around)


@pytest.mark.parametrize("options", [(), ("--json",), ("--dry-run",)])
def test_without_a_word_of_the_user_the_lines_are_only_shown(
    user: Path, execute: Execute, options: tuple[str, ...]
) -> None:
    with unchanged(user.parent):
        printed = execute(*COMMAND, *options, code=0 if "--dry-run" in options else 2)
    message = "nothing was written: there is no terminal to ask on"
    if "--json" in options:
        *notes, last = printed.json["diagnostics"]
        assert (notes[0]["file"], notes[0]["line"], notes[0]["code"]) == ("Cell.mo", 5, "renamed-use")
        assert len(notes) == 7
        assert last["message"] == message
        return
    assert "    +  connect(robot.wristAxis, motor); // robot.elbowAxis" in printed.lines
    hint = "look at what is shown, then give --yes"
    assert printed.errors == ([] if options else [f"error: {message}; {hint} [not-confirmed]"])


@pytest.mark.parametrize(("words", "code"), [("y", 0), ("Yes ", 0), ("", 1), ("no", 1)])
def test_somebody_at_a_terminal_is_asked(
    user: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch, words: str, code: int
) -> None:
    monkeypatch.setattr(sys, "stdin", Terminal(words))
    assert "Write 7 lines in 3 files, and build arm? [y/N] " in execute(*COMMAND, code=code).out
    assert texts() == (FILES if code else RENAMED)


def test_a_file_that_is_saved_before_the_answer_stays_and_nothing_is_built(
    user: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stdin", Terminal("y", "../plant/Bench.mo"))
    found = execute(*COMMAND, code=2).words
    assert "Bench.mo: error: it has changed meanwhile, and stays as it is now; " in found
    assert texts() == {**RENAMED, "../plant/Bench.mo": "saved"}
    assert Path("modelica/Arm/Joints/Elbow.mo").exists()


def test_a_robot_in_conflict_keeps_its_names_and_its_users(user: Path, execute: Execute) -> None:
    robot = Path("modelica/Arm/Arm.mo")
    robot.write_text(robot.read_text().replace("equation", "  Real mine;\n\nequation", 1))
    with unchanged(user.parent):
        printed = execute(*COMMAND, "--yes", code=3)
    assert "files of `arm` are in conflict, so its names stay as they are" in printed.words


def test_an_output_elsewhere_is_asked_for_before_anything_is_written(
    user: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(user))
    Path("../elsewhere").mkdir()
    Path("urdfsync.toml").write_text(CONFIG + 'output = "../elsewhere"\n')
    Path("arm.urdf").write_text(Path("arm.urdf").read_text().replace("wrist", "elbow"))
    execute("build", "--trust")
    write_source("wrist")
    Path("modelica/Arm/Links/Mine.mo").unlink()
    Path("../plant/Bench.mo").unlink()
    assert "untrusted-output" in execute(*COMMAND, "--yes", code=2).err
    assert Path("Cell.mo").read_bytes() == CELL.encode()
    execute(*COMMAND, "--yes", "--trust")
    assert Path("Cell.mo").read_bytes() == RENAMED["Cell.mo"].encode()


def test_a_name_that_may_mean_either_of_two_is_left_to_the_user(user: Path, execute: Execute) -> None:
    """What was `elbow` is `swing`, and what was `swing` is `wrist`."""
    write_source("swing", "wrist")
    with unchanged(user.parent):
        assert NONE in execute(*COMMAND, "--yes").err


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (("elbow=wirst",), "no package has a name that begins with `wirst`"),
        (("elbow",), "`elbow` is not OLD=NEW; for example --rename-uses elbow=wrist"),
        (("--all",), "--rename-uses goes without paths and --all"),
    ],
)
def test_arguments_that_make_no_sense(user: Path, execute: Execute, given: tuple[str, ...], message: str) -> None:
    assert f"error: {message}" in execute(*COMMAND, *given, code=2).words


def test_another_name_of_the_package_is_followed(user: Path, execute: Execute) -> None:
    write_source("elbow")
    Path("modelica/Arm/Links/Mine.mo").unlink()
    Path("../plant/Bench.mo").unlink()
    Path("urdfsync.toml").write_text(CONFIG.replace('"Arm"', '"Robot"'))
    execute("build")
    execute(*COMMAND, "Arm=Robot", "--yes")
    assert Path("Cell.mo").read_bytes().decode() == CELL.replace("Arm.Arm robot", "Robot.Robot robot")


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


@pytest.mark.parametrize("is_linked", [False, True])
def test_files_elsewhere_are_written_only_with_the_users_word(
    user: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch, is_linked: bool
) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(user))
    if is_linked:
        Path("Bench.mo").symlink_to(user.parent / "plant/Bench.mo")
        Path("urdfsync.toml").write_text(CONFIG.replace("../plant", "Bench.mo"))
    with unchanged(user.parent):
        found = execute(*COMMAND, "--yes", code=2)
    assert f"leads out of the configuration's folder, to {user.parent}/plant/Bench.mo; " in found.words
    execute(*COMMAND, "--yes", "--trust")
    assert texts() == RENAMED


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


def test_a_model_that_is_saved_while_others_are_written_stays(user: Path, execute: Execute) -> None:
    """The others are written; nothing is built before all are."""
    saved = f"// saved\n{CELL}"
    once = iter([saved])

    def save(found: Operation) -> None:
        if found.name == "exchange" and user / "Cell.mo" in found.paths and (text := next(once, "")):
            Path("Cell.mo").write_bytes(text.encode())

    with before_each(save):
        error = execute(*COMMAND, "--yes", code=2).err
    assert "Cell.mo: error: it has changed meanwhile, and stays as it is now; run the command again" in error
    assert "2 other files written, nothing built" in error
    assert texts() == {**RENAMED, "Cell.mo": saved}
    execute(*COMMAND, "--yes")
    assert texts() == {**RENAMED, "Cell.mo": f"// saved\n{RENAMED['Cell.mo']}"}

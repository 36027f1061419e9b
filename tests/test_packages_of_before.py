"""Packages that an urdfsync wrote before links and joints extended classes of the library: one build carries them over.

`tests/golden/before` is a project as such a program left it (revision 3 of the domain): an arm, and the same robot on a
free base, whose joint had to give way to the name `swingAxis` at that time. Nothing of the user's gets lost.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from urdfsync import cli
from urdfsync.state.manifest import text_hash
from urdfsync.state.store import Store

BEFORE = Path(__file__).parent / "golden" / "before"
Files = dict[str, bytes]
Capture = pytest.CaptureFixture[str]

ELBOW, LINK, MAIN = "Arm/Joints/Swing.mo", "Arm/Links/Boom.mo", "Arm/Arm.mo"
RECORD, RUN, TEST = "Arm/ArmParameters.mo", "Arm/ArmRun.mo", "Arm/ArmTest.mo"
WAITS = "it does not fit the library UrdfSync of this version; it fits the library again once"
BENCH = """\
model Bench
  inner Modelica.Mechanics.MultiBody.World world;
  Arm.Arm robot(phi_start = {0.3});
  Arm.ArmParameters numbers;
  Modelica.Mechanics.Rotational.Sources.ConstantTorque torque(tau_constant = numbers.boom.inertial.mass);
equation
  connect(world.frame_b, robot.frame_a);
  connect(torque.flange, robot.rotationalAxis[1]);
end Bench;
"""


def files(root: Path) -> Files:
    folder = root / "modelica"
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def start(root: Path) -> Path:
    """The project of before, with the bases that its program kept beside it."""
    shutil.copytree(BEFORE, root, ignore=shutil.ignore_patterns("robots"))
    shutil.copytree(BEFORE / "robots", root / ".urdfsync" / "robots")
    for robot in ("Arm", "Cart"):
        texts = [path.read_text() for path in sorted((root / "modelica" / robot).rglob("*.mo"))]
        Store(root).bases(robot.lower()).add({text_hash(text): text for text in texts})
    return root


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    root = start(tmp_path / "project")
    monkeypatch.chdir(root)
    return root


@pytest.fixture(scope="module")
def fresh(tmp_path_factory: pytest.TempPathFactory) -> Files:
    """What this program makes of the same sources where nothing was built before."""
    root = tmp_path_factory.mktemp("fresh")
    for name in ("arm.urdf", "cart.urdf", "urdfsync.toml"):
        shutil.copy(BEFORE / name, root / name)
    assert cli.main(["build", "-q", "--config", str(root / "urdfsync.toml")]) == 0
    return files(root)


def said(capsys: Capture, *arguments: str, code: int = 0) -> str:
    capsys.readouterr()
    assert cli.main([*arguments]) == code
    streams = capsys.readouterr()
    return " ".join((streams.out + streams.err).split())


def edit(project: Path, path: str, old: str, new: str) -> bytes:
    file = project / "modelica" / path
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))
    return file.read_bytes()


def differing(project: Path, fresh: Files) -> set[str]:
    now = files(project)
    return {path for path in now.keys() | fresh.keys() if now.get(path) != fresh.get(path)}


def test_one_build_carries_untouched_packages_over(project: Path, fresh: Files, capsys: Capture) -> None:
    found = said(capsys, "build")
    assert "conflict" not in found
    assert "does not fit" not in found
    assert files(project) == fresh
    assert "in step" in said(capsys, "build", "--check")


def test_files_keep_their_names(fresh: Files) -> None:
    before = files(BEFORE.parent / "before")
    gone, new = before.keys() - fresh.keys(), fresh.keys() - before.keys()
    given = {"Cart/Joints/Swing.mo", "Cart/Joints/SwingParameters.mo"}  # its connector gives way now, not the joint
    assert gone == {RECORD, "Cart/CartParameters.mo", *(path.replace("Swing", "Swing_joint") for path in given)}
    assert new == {"Cart/CartStance.mo", *given}


COMMENT = ('    "Motion along the axis"', '    // softer than it looks\n    "Motion along the axis"')
EDITS: dict[str, tuple[str, str, str]] = {
    "comment": (ELBOW, *COMMENT),
    "part of a joint": (ELBOW, "\nequation\n", "\n  parameter Real stiffness = 4e4;\n\nequation\n"),
    "part of a link": (LINK, "\nequation\n", "\n  Real mine = 2*m;\n\nequation\n"),
    "bench": (TEST, "\nequation\n", "\n  Real mine = time;\n\nequation\n"),
}


@pytest.mark.parametrize("name", EDITS)
def test_an_edit_waits_for_its_user_and_is_merged(project: Path, fresh: Files, capsys: Capture, name: str) -> None:
    path, old, new = EDITS[name]
    before, mine = files(project), edit(project, path, old, new)
    found = said(capsys, "build", "arm", code=3)
    place = f"modelica/{path}"
    assert f"{WAITS} {place} is resolved: urdfsync resolve {place} [outdated-package]" in found
    assert f"urdfsync resolve {place} --merge" in found
    assert files(project) == {**before, path: mine}  # nothing structural is half done
    assert WAITS in said(capsys, "status", "arm", code=3)  # and it is said as long as it is true
    assert WAITS in said(capsys, "build", "arm", code=3)
    assert WAITS not in said(capsys, "resolve", place, "--merge")
    said(capsys, "build")
    assert differing(project, fresh) == {path}
    assert fresh[path].decode().replace(old, new, 1).encode() == (project / place).read_bytes()
    assert WAITS not in said(capsys, "build")


def test_what_the_user_takes_is_as_in_a_fresh_build(project: Path, fresh: Files, capsys: Capture) -> None:
    edit(project, ELBOW, *COMMENT)
    edit(project, RUN, "\nequation\n", "\n  Real mine = rotationalDrive[1].w;\n\nequation\n")
    found = said(capsys, "build", code=3)
    assert f"{WAITS} each of 2 conflicts is resolved: urdfsync resolve --all --robot arm" in found
    assert "the merge mentions `rotationalDrive`, which the package has no more" in found
    found = said(capsys, "resolve", f"modelica/{ELBOW}", "--take", code=3)
    assert f"{WAITS} modelica/{RUN} is resolved" in found
    said(capsys, "resolve", f"modelica/{RUN}", "--take")
    said(capsys, "build")
    assert files(project) == fresh


def test_what_the_user_keeps_is_said_not_to_fit(project: Path, fresh: Files, capsys: Capture) -> None:
    mine = edit(project, ELBOW, *COMMENT)
    said(capsys, "build", code=3)
    found = said(capsys, "resolve", f"modelica/{ELBOW}", "--keep")
    warning = "this file stays as it is, but it was made for an older library UrdfSync"
    assert f"modelica/{ELBOW}: warning: {warning}" in found
    assert "vanished-name" not in found  # what the file uses, it declares itself
    said(capsys, "build")
    assert differing(project, fresh) == {ELBOW}
    assert files(project)[ELBOW] == mine


def test_a_connection_by_number_is_kept_and_never_merged(project: Path, fresh: Files, capsys: Capture) -> None:
    mine = edit(project, MAIN, "\nequation\n", "\nequation\n  connect(frame_b[1], sensor.frame_a);\n")
    assert "the merge mentions `frame_b`, which the package has no more" in said(capsys, "build", code=3)
    said(capsys, "resolve", "--all", "--merge", code=3)
    assert files(project)[MAIN] == mine
    said(capsys, "resolve", "--all", "--take")
    said(capsys, "build")
    assert files(project) == fresh


def test_edited_numbers_of_an_element_stay(project: Path, fresh: Files, capsys: Capture) -> None:
    mine = edit(project, "Arm/Links/BoomParameters.mo", "mass = 2", "mass = 2.5")
    said(capsys, "build")
    assert differing(project, fresh) == {"Arm/Links/BoomParameters.mo"}
    assert files(project)["Arm/Links/BoomParameters.mo"] == mine


def test_edits_of_a_joint_with_another_name_move(project: Path, fresh: Files, capsys: Capture) -> None:
    old, new = "Cart/Joints/Swing_joint.mo", "Cart/Joints/Swing.mo"
    edit(project, old, *COMMENT)
    assert "1 moved with your edits" in said(capsys, "build")
    assert differing(project, fresh) == {new}
    assert files(project)[new] == fresh[new].decode().replace(*COMMENT).encode()


def test_a_file_that_was_deleted_comes_back(project: Path, fresh: Files, capsys: Capture) -> None:
    (project / "modelica" / ELBOW).unlink()
    assert "1 restored because you deleted it" in said(capsys, "build")
    assert files(project) == fresh


def test_an_edited_record_of_the_robot_stays_and_the_option_is_named(project: Path, capsys: Capture) -> None:
    mine = edit(project, RECORD, "mass = 2", "mass = 2.5")
    option = '`approach = ["package", "record"]` in the configuration keeps it up to date [left-out]'
    assert f"modelica/{RECORD}: warning: the file is no longer generated; {option}" in said(capsys, "build")
    assert files(project)[RECORD] == mine
    assert "left-out" not in said(capsys, "build")


def test_users_of_the_record_and_of_lost_names_are_told(project: Path, fresh: Files, capsys: Capture) -> None:
    (project / "modelica" / "Bench.mo").write_text(BENCH)
    found = said(capsys, "build")
    option = '`approach = ["package", "record"]` in the configuration keeps it up to date [left-out]'
    assert f"modelica/Bench.mo:4: warning: `Arm.ArmParameters` is used here, and no longer generated; {option}" in found
    assert "modelica/Bench.mo:3: warning: `phi_start` is used here" in found
    assert "modelica/Bench.mo:8: warning: `robot.rotationalAxis` is used here" in found
    assert "frame_b" not in found  # that of the world
    assert differing(project, fresh) == {"Bench.mo", RECORD, "Arm/package.order"}
    assert (project / "modelica" / "Bench.mo").read_text() == BENCH


def test_who_changes_the_approach_is_told_as_well(project: Path, capsys: Capture) -> None:
    config = (project / "urdfsync.toml").read_text()
    both = config.replace('package = "Arm"', 'package = "Arm"\napproach = ["package", "record"]')
    (project / "urdfsync.toml").write_text(both)
    (project / "modelica" / "Bench.mo").write_text(BENCH)
    assert "left-out" not in said(capsys, "build")
    (project / "urdfsync.toml").write_text(config)
    assert "modelica/Bench.mo:4: warning: `Arm.ArmParameters` is used here" in said(capsys, "build")


def test_a_clone_without_bases_loses_nothing_either(project: Path, fresh: Files, capsys: Capture) -> None:
    shutil.rmtree(project / ".urdfsync" / "base")
    mine = edit(project, ELBOW, *COMMENT)
    assert "What urdfsync wrote last is lost" in said(capsys, "build", code=3)
    assert files(project)[ELBOW] == mine
    said(capsys, "resolve", "--all", "--take")
    said(capsys, "build")
    assert files(project) == fresh


def test_clean_merges_are_made_at_once_where_they_are_welcome(project: Path, fresh: Files, capsys: Capture) -> None:
    config = project / "urdfsync.toml"
    config.write_text(config.read_text() + 'on_conflict = "merge"\n')
    old, new = "Cart/Joints/Swing_joint.mo", "Cart/Joints/Swing.mo"
    edit(project, old, *COMMENT)
    edit(project, "Cart/CartRun.mo", "\nequation\n", "\n  Real mine = time;\n\nequation\n")
    said(capsys, "build")
    assert differing(project, fresh) == {new, "Cart/CartRun.mo"}

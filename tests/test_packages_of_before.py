"""Packages that an urdfsync wrote before links and joints extended classes of the library: one build carries them over.

`tests/golden/before` is a project as such a program left it (revision 3 of the domain): an arm, and the same robot on a
free base, whose joint had to give way to the name `swingAxis` at that time. Nothing of the user's gets lost.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from support.commands import Execute
from support.replay import contents

from urdfsync import cli
from urdfsync.files import text_digest
from urdfsync.state.store import Store

BEFORE = Path(__file__).parent / "golden" / "before"
Files = dict[str, bytes]

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
    return contents(root / "modelica")


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The project of before, with the bases that its program kept beside it."""
    root = tmp_path / "project"
    shutil.copytree(BEFORE, root, ignore=shutil.ignore_patterns("robots"))
    shutil.copytree(BEFORE / "robots", root / ".urdfsync" / "robots")
    for robot in ("Arm", "Cart"):
        texts = [path.read_text() for path in sorted((root / "modelica" / robot).rglob("*.mo"))]
        Store(root).bases(robot.lower()).add({text_digest(text.encode()): text for text in texts})
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


def edit(project: Path, path: str, old: str, new: str) -> bytes:
    file = project / "modelica" / path
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))
    return file.read_bytes()


def differing(project: Path, fresh: Files) -> set[str]:
    now = files(project)
    return {path for path in now.keys() | fresh.keys() if now.get(path) != fresh.get(path)}


def test_one_build_carries_untouched_packages_over(project: Path, fresh: Files, execute: Execute) -> None:
    before, found = files(project), execute("build").words
    assert "conflict" not in found
    assert "does not fit" not in found
    assert files(project) == fresh
    given = {"Cart/Joints/Swing.mo", "Cart/Joints/SwingParameters.mo"}  # its connector gives way now, not the joint
    assert before.keys() - fresh.keys() == {
        *(RECORD, "Cart/CartParameters.mo"),
        *(path.replace("Swing", "Swing_joint") for path in given),
    }
    assert fresh.keys() - before.keys() == {"Cart/CartStance.mo", *given}
    assert "in step" in execute("build", "--check").words


COMMENT = ('    "Motion along the axis"', '    // softer than it looks\n    "Motion along the axis"')
PART = ("\nequation\n", "\n  parameter Real mine = 4e4;\n\nequation\n")


@pytest.mark.parametrize(("path", "old", "new"), [(ELBOW, *COMMENT), (ELBOW, *PART), (TEST, *PART)])
def test_an_edit_waits_for_its_user_and_is_merged(
    project: Path, fresh: Files, execute: Execute, path: str, old: str, new: str
) -> None:
    before, mine = files(project), edit(project, path, old, new)
    found = execute("build", "arm", code=3).words
    place = f"modelica/{path}"
    assert f"{WAITS} {place} is resolved: urdfsync resolve {place} [outdated-package]" in found
    assert f"urdfsync resolve {place} --merge" in found
    assert files(project) == {**before, path: mine}  # nothing structural is half done
    assert WAITS in execute("status", "arm", code=3).words  # and it is said as long as it is true
    assert WAITS in execute("build", "arm", code=3).words
    assert WAITS not in execute("resolve", place, "--merge").words
    execute("build")
    assert differing(project, fresh) == {path}
    assert fresh[path].decode().replace(old, new, 1).encode() == (project / place).read_bytes()
    assert WAITS not in execute("build").words


def test_what_the_user_takes_fits_and_what_he_keeps_is_said_not_to(
    project: Path, fresh: Files, execute: Execute
) -> None:
    mine = edit(project, ELBOW, *COMMENT)
    edit(project, RUN, "\nequation\n", "\n  Real mine = rotationalDrive[1].w;\n\nequation\n")
    found = execute("build", code=3).words
    assert f"{WAITS} each of 2 conflicts is resolved: urdfsync resolve --all --robot arm" in found
    assert "the merge mentions `rotationalDrive`, which the package has no more" in found
    found = execute("resolve", f"modelica/{RUN}", "--take", code=3).words
    assert f"{WAITS} modelica/{ELBOW} is resolved" in found
    found = execute("resolve", f"modelica/{ELBOW}", "--keep").words
    warning = "this file stays as it is, but it was made for an older library UrdfSync"
    assert f"modelica/{ELBOW}: warning: {warning}" in found
    assert "vanished-name" not in found  # what the file uses, it declares itself
    execute("build")
    assert differing(project, fresh) == {ELBOW}
    assert files(project)[ELBOW] == mine


def test_a_record_that_is_left_out_stays_and_its_users_are_told_with_the_option(
    project: Path, fresh: Files, execute: Execute
) -> None:
    option = '`approach = ["package", "record"]` in the configuration keeps it up to date [left-out]'
    mine = edit(project, RECORD, "mass = 2", "mass = 2.5")
    (project / "modelica" / "Bench.mo").write_text(BENCH)
    found = execute("build").words
    assert f"modelica/{RECORD}: warning: the file is no longer generated; {option}" in found
    assert f"modelica/Bench.mo:4: warning: `ArmParameters` is used here, and no longer generated; {option}" in found
    assert "modelica/Bench.mo:3: warning: `phi_start` is used here" in found
    assert "modelica/Bench.mo:8: warning: `robot.rotationalAxis` is used here" in found
    assert "frame_b" not in found  # that of the world
    assert differing(project, fresh) == {"Bench.mo", RECORD, "Arm/package.order"}
    assert files(project)[RECORD] == mine
    assert "left-out" not in execute("build").words

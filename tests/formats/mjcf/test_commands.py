"""Each command takes an MJCF as it takes a URDF."""

from __future__ import annotations

import contextlib
import shutil
from pathlib import Path

import pytest
from support.commands import Execute
from support.files import unchanged
from support.git import NEEDS_GIT, Repository
from support.mjcfs import ARM, body, stl, world

from urdfsync.analysis.checks import robot as checks
from urdfsync.analysis.checks.results import CheckOptions, CheckResult
from urdfsync.commands import cli
from urdfsync.engine.sources.exchange import Answer
from urdfsync.project import config

RECORD = Path("modelica/Arm/Links/UpperParameters.mo")
EXPANDED = Path(".urdfsync/robots/arm.expanded")


@pytest.fixture(scope="module")
def in_step(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project with the arm, in step; tests work on copies of it, since a translation takes half a second."""
    folder = tmp_path_factory.mktemp("built")
    (folder / "mjcf").mkdir()
    (folder / "mjcf/arm.xml").write_text(ARM)
    with contextlib.chdir(folder):
        assert [cli.main(command.split()) for command in ("init mjcf/arm.xml", "build")] == [0, 0]
    return folder


@pytest.fixture
def project(folder: Path, in_step: Path) -> Path:
    """A project with the arm, in step."""
    return shutil.copytree(in_step, folder, dirs_exist_ok=True)


def edit(old: str, new: str, file: str = "mjcf/arm.xml") -> None:
    text = Path(file).read_text()
    assert old in text
    Path(file).write_text(text.replace(old, new))


def without_mujoco(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let processes that start from now on find a MuJoCo that can't be imported."""
    (folder / "broken").mkdir()
    (folder / "broken/mujoco.py").write_text("raise ImportError('No module named mujoco')\n")
    monkeypatch.setenv("PYTHONPATH", str(folder / "broken"))


@pytest.mark.slow
def test_init_guesses_the_options(folder: Path, execute: Execute) -> None:
    spring = '<body name="toe" pos="0 0 1"><joint type="ball" stiffness="3"/><geom size="0.1"/></body>'
    Path("arm.xml").write_text(ARM)
    Path("leg.xml").write_text(body(f"<freejoint/>{spring}"))
    printed = execute("init", "arm.xml", "leg.xml")
    assert 'base = "fixed"  guessed: its root link is named "world"' in printed.out
    assert 'base = "floating"  guessed: its root moves freely' in printed.out
    assert 'allow = ["part-left-out"]  guessed: the model leaves this part out' in printed.out
    assert "leg.xml:2: warning: spring toe_joint: this acts on the robot, but no model has it" in printed.err
    assert "bolted down" not in printed.err


@pytest.mark.slow
def test_a_spring_of_a_ball_stops_a_build_unless_it_is_allowed(project: Path, execute: Execute) -> None:
    edit('name="elbow" axis="0 1 0" armature="0.1"', 'name="elbow" type="ball"')
    with unchanged(project):
        told = execute("build", code=2).err
    assert "mjcf/arm.xml:7: error: spring elbow: this acts on the robot, but no model has it" in told
    edit("[robots.arm]", '[robots.arm]\nallow = ["part-left-out"]', "urdfsync.toml")
    assert "mjcf/arm.xml:7: warning: spring elbow" in execute("build").err


@pytest.mark.slow
def test_a_free_robot_that_is_bolted_down_is_told(folder: Path, execute: Execute) -> None:
    Path("leg.xml").write_text(body("<freejoint/>"))
    Path("urdfsync.toml").write_text('[robots.leg]\nsource = "leg.xml"\npackage = "Leg"\n')
    assert "leg.xml:2: warning: link 'part' moves freely in the source, but is bolted down" in execute("build").err
    edit("[robots.leg]", '[robots.leg]\nbase = "floating"', "urdfsync.toml")
    assert "bolted down" not in execute("build").err


def test_one_number_changes_one_record(project: Path, execute: Execute) -> None:
    edit('mass="1.5"', 'mass="1.75"')
    assert "link upper: inertial / mass 1.5 → 1.75 kg" in execute("diff", code=1).out
    assert "1 file written" in execute("build").out
    assert "1.75" in RECORD.read_text()


@pytest.mark.slow
def test_a_gain_changes_one_record(project: Path, execute: Execute) -> None:
    """A law that comes changes Run, too."""
    edit("</mujoco>", '<actuator><motor joint="elbow"/></actuator></mujoco>')
    execute("build")
    edit('<motor joint="elbow"/>', '<position joint="elbow" kp="50" kv="5"/>')
    told = execute("diff", code=1).out
    assert "joint elbow: servo added: position_gain 50, velocity_gain 5" in told
    assert "ArmRun.mo" in told
    execute("build")
    edit('kp="50"', 'kp="60"')
    told = execute("diff", code=1).out
    assert "arm: 1 parameter change since the last build" in told
    assert "joint elbow: servo / position_gain 50 → 60 N·m/rad (+20 %)" in told
    assert "1 file written" in execute("build").out
    assert "positionGain = 60" in Path("modelica/Arm/Joints/ElbowParameters.mo").read_text()


@pytest.mark.slow
def test_an_included_file_and_a_mesh_are_inputs(project: Path, execute: Execute) -> None:
    asset = '<asset><mesh name="m" file="m.stl"/></asset>'
    Path("mjcf/m.stl").write_bytes(stl())
    Path("mjcf/hand.xml").write_text(
        '<mujocoinclude><body name="hand"><geom type="mesh" mesh="m"/></body></mujocoinclude>'
    )
    edit("</mujoco>", f"{asset}</mujoco>")
    edit('<geom type="box"', '<include file="hand.xml"/><geom type="box"')
    execute("build")
    assert execute("status").lines == ["arm: in step, 24 files"]
    edit('name="hand"', 'name="grip"', "mjcf/hand.xml")
    assert "grip" in execute("status", code=1).out
    execute("build")
    Path("mjcf/m.stl").write_bytes(stl(2))
    assert "inertial / mass" in execute("status", code=1).out


def test_a_clone_needs_no_mujoco(project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.rmtree(".urdfsync/notes")
    without_mujoco(project, monkeypatch)
    assert execute("build").lines == ["arm: in step, 19 files"]
    edit('mass="1.5"', 'mass="1.75"')
    assert "pip install mujoco [not-installed]" in execute("build", code=2).err


@pytest.mark.slow
def test_a_robot_of_a_scene_is_chosen_by_an_argument(folder: Path, execute: Execute) -> None:
    Path("scene.xml").write_text(
        world("".join(f'<body name="{name}"><joint/><geom size="0.1"/></body>' for name in ("left", "right")))
    )
    assert "the model has 2 robots: 'left', 'right'" in execute("init", "scene.xml", code=2).err
    execute("init", "scene.xml", "body:=right")
    assert 'arguments = { body = "right" }' in Path("urdfsync.toml").read_text()
    execute("build")
    execute("add", "scene.xml", "body:=left")
    execute("build")
    texts = [file.read_text() for file in Path(".urdfsync/robots").glob("*.expanded")]
    assert sorted('<link name="left"' in text for text in texts) == [False, True]


@pytest.mark.slow
def test_a_source_outside_of_a_project_is_compared(project: Path, execute: Execute) -> None:
    Path("new.xml").write_text(ARM.replace('mass="1.5"', 'mass="1.75"'))
    assert "1.75 → 1.5 kg" in execute("diff", "arm", "--against", "new.xml", code=1).out


@pytest.mark.slow
@NEEDS_GIT
def test_a_revision_is_compared(project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    Repository(project, monkeypatch).commit()
    edit('mass="1.5"', 'mass="1.75"')
    assert "1.5 → 1.75 kg" in execute("diff", "--against", "HEAD", code=1).out
    execute("build")
    without_mujoco(project, monkeypatch)
    assert "1.5 → 1.75 kg" in execute("diff", "--against", "HEAD", code=1).out


@pytest.mark.slow
@NEEDS_GIT
def test_a_hook_passes_a_commit_in_step(project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    repository = Repository(project, monkeypatch)
    repository.commit()
    edit('mass="1.5"', 'mass="1.75"')
    repository.git("add", "mjcf")
    assert "robot `arm`: the package is out of step: 1 file to write" in execute("hook", "check", code=1).err
    execute("build")
    repository.git("add", "-A")
    execute("hook", "check")


@pytest.mark.slow
def test_an_edited_number_goes_back_as_a_hint(project: Path, execute: Execute) -> None:
    """`diff --patch` finds the number in the source by translating changed copies of the source."""
    RECORD.write_text(RECORD.read_text().replace("1.5", "1.75"))
    printed = execute("diff", "--edits", "--patch", code=None)
    assert '-      <inertial pos="0 0 0.2" mass="1.5" diaginertia="0.02 0.02 0.01"/>' in printed.out
    assert '+      <inertial pos="0 0 0.2" mass="1.75" diaginertia="0.02 0.02 0.01"/>' in printed.out


@pytest.mark.slow
def test_a_check_compares_the_urdf_with_mujoco(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("urdfsync.analysis.checks.compilation.Compilation.run", lambda *_: None)  # other tests compile
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *_, **__: project / "cache")
    result = check()
    assert result.numbers is not None
    assert result.numbers.right == result.numbers.total > 150  # 76 of them in the records
    assert not result.diagnostics
    monkeypatch.setattr(checks, "compare", lambda *_: Answer(differences=("mass of link upper differs by 1.0e-03",)))
    edit('mass="1.5"', 'mass="1.75"')  # a right result is remembered
    (found,) = [each for each in check().diagnostics if each.code == "translation-differs"]
    assert str(found).startswith("mjcf/arm.xml: error: mass of link upper differs by 1.0e-03")


def check() -> CheckResult:
    (robot,) = (loaded := config.load(Path("urdfsync.toml"))).robots
    return checks.check_robot(loaded, robot, CheckOptions())

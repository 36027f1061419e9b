"""Each command takes an SDF as it takes a URDF."""

from __future__ import annotations

import contextlib
import shutil
from pathlib import Path

import pytest
from support.commands import Execute
from support.files import unchanged
from support.git import NEEDS_GIT, Repository
from support.sdfs import ARM, hinge, model, sdf

from urdfsync.analysis.checks import robot as checks
from urdfsync.analysis.checks.results import CheckOptions
from urdfsync.commands import cli
from urdfsync.engine.sources.exchange import Answer
from urdfsync.project import config

RECORD = Path("modelica/Arm/Links/UpperParameters.mo")
HAND = sdf('<model name="hand"><link name="palm"><inertial><mass>0.25</mass></inertial></link></model>')
CONFIG = '<model><sdf version="1.9">hand.sdf</sdf></model>'


@pytest.fixture(scope="module")
def in_step(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project with the arm, in step; tests work on copies of it, since a translation takes half a second."""
    folder = tmp_path_factory.mktemp("built")
    (folder / "sdf").mkdir()
    (folder / "sdf/arm.sdf").write_text(ARM)
    with contextlib.chdir(folder):
        assert [cli.main(command.split()) for command in ("init sdf/arm.sdf", "build")] == [0, 0]
    return folder


@pytest.fixture
def project(folder: Path, in_step: Path) -> Path:
    """A project with the arm, in step."""
    return shutil.copytree(in_step, folder, dirs_exist_ok=True)


def edit(old: str, new: str, file: str = "sdf/arm.sdf") -> None:
    text = Path(file).read_text()
    assert old in text
    Path(file).write_text(text.replace(old, new))


def test_init_guesses_the_options(folder: Path, execute: Execute) -> None:
    links = '<link name="base"/><link name="toe"><pose>0 0 1 0 0 0</pose></link>'
    Path("arm.sdf").write_text(ARM)
    Path("leg.world").write_text(model(links + "\n" + hinge("ankle", "base", "toe", kind="screw"), name="leg"))
    printed = execute("init", "arm.sdf", "leg.world")
    assert 'base = "fixed"  guessed: its root link is named "world"' in printed.out
    assert 'base = "floating"  guessed: its root moves freely' in printed.out
    assert 'allow = ["part-left-out"]  guessed: the model leaves this part out' in printed.out
    assert "leg.world:3: warning: screw joint ankle: this acts on the robot, but no model has it" in printed.err


def test_what_no_model_has_stops_a_build_unless_it_is_allowed(project: Path, execute: Execute) -> None:
    edit('<link name="fore">', '<link name="fore">\n<gravity>false</gravity>')
    with unchanged(project):
        told = execute("build", code=2).err
    assert "sdf/arm.sdf:12: error: gravity off fore: this acts on the robot, but no model has it" in told
    edit("[robots.arm]", '[robots.arm]\nallow = ["part-left-out"]', "urdfsync.toml")
    assert "sdf/arm.sdf:12: warning: gravity off fore" in execute("build").err


def test_findings_of_the_urdf_have_lines_of_the_sdf(project: Path, execute: Execute) -> None:
    edit("<mass>1.5</mass>", "<mass>-1.5</mass>")
    with unchanged(project):
        assert "sdf/arm.sdf:6: error: link upper / inertial: the mass -1.5 kg" in execute("build", code=2).err


def test_one_number_changes_one_record(project: Path, execute: Execute) -> None:
    edit("<mass>1.5</mass>", "<mass>1.75</mass>")
    assert "link upper: inertial / mass 1.5 → 1.75 kg" in execute("diff", code=1).out
    assert "1 file written" in execute("build").out
    assert "1.75" in RECORD.read_text()


@pytest.mark.slow
def test_an_included_model_is_an_input(project: Path, execute: Execute) -> None:
    Path("sdf/hand").mkdir()
    Path("sdf/hand/hand.sdf").write_text(HAND)
    Path("sdf/hand/model.config").write_text(CONFIG)
    held = hinge("wrist", "fore", "hand::palm", "<axis><xyz>1 0 0</xyz></axis>")
    edit("  </model>", f"<include><uri>model://hand</uri></include>{held}</model>")
    execute("build")
    edit("0.25", "0.5", "sdf/hand/hand.sdf")
    assert "link hand::palm: inertial / mass 0.25 → 0.5 kg" in execute("diff", code=1).out
    execute("build")
    Path("sdf/hand/new.sdf").write_text(HAND)
    edit("hand.sdf", "new.sdf", "sdf/hand/model.config")
    assert "inertial / mass 0.5 → 0.25 kg" in execute("diff", code=1).out


@pytest.mark.slow
def test_a_robot_of_a_world_is_chosen_by_an_argument(folder: Path, execute: Execute) -> None:
    arms = "".join(
        f'<model name="{name}"><link name="{name}_link"/>{hinge("h", "world", f"{name}_link")}</model>'
        for name in ("left", "right")
    )
    Path("scene.world").write_text(sdf(f'<world name="w">{arms}</world>'))
    assert "the file has 2 robots: 'left', 'right'" in execute("init", "scene.world", code=2).err
    execute("init", "scene.world", "model:=right")
    assert 'arguments = { model = "right" }' in Path("urdfsync.toml").read_text()
    execute("build")
    execute("add", "scene.world", "model:=left")
    execute("build")
    texts = [file.read_text() for file in Path(".urdfsync/robots").glob("*.expanded")]
    assert sorted('<link name="left_link"' in text for text in texts) == [False, True]


def test_a_source_outside_of_a_project_is_compared(project: Path, execute: Execute) -> None:
    Path("new.sdf").write_text(ARM.replace("<mass>1.5", "<mass>1.75"))
    assert "1.75 → 1.5 kg" in execute("diff", "arm", "--against", "new.sdf", code=1).out


@NEEDS_GIT
def test_a_revision_is_compared(project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    Repository(project, monkeypatch).commit()
    edit("<mass>1.5</mass>", "<mass>1.75</mass>")
    assert "1.5 → 1.75 kg" in execute("diff", "--against", "HEAD", code=1).out


@pytest.mark.slow
@NEEDS_GIT
def test_a_hook_passes_a_commit_in_step(project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    repository = Repository(project, monkeypatch)
    repository.commit()
    edit("<mass>1.5</mass>", "<mass>1.75</mass>")
    repository.git("add", "sdf")
    assert "robot `arm`: the package is out of step: 1 file to write" in execute("hook", "check", code=1).err
    execute("build")
    repository.git("add", "-A")
    execute("hook", "check")


def test_an_edited_file_is_kept(project: Path, execute: Execute) -> None:
    """An export that changes another number leaves the user's edit alone."""
    joint = Path("modelica/Arm/Joints/Elbow.mo")
    joint.write_text(joint.read_text().replace("end Elbow;", "  // mine\nend Elbow;"))
    edit("<mass>1.5</mass>", "<mass>1.75</mass>")
    execute("build")
    assert "// mine" in joint.read_text()
    assert "1.75" in RECORD.read_text()


@pytest.mark.slow
def test_an_edited_number_goes_back_as_a_hint(project: Path, execute: Execute) -> None:
    """`diff --patch` finds the number in the source by translating changed copies of the source."""
    RECORD.write_text(RECORD.read_text().replace("1.5", "1.75"))
    printed = execute("diff", "--edits", "--patch", code=None)
    assert "-        <mass>1.5</mass>" in printed.out
    assert "+        <mass>1.75</mass>" in printed.out


def test_a_urdf_may_have_any_suffix_and_an_sdf_too(folder: Path, execute: Execute) -> None:
    Path("odd.sdf").write_text('<robot name="odd"><link name="base"/></robot>')
    Path("arm.urdf").write_text(ARM)
    execute("init", "odd.sdf", "arm.urdf")
    execute("build")
    assert [path.name for path in Path(".urdfsync/robots").glob("*.expanded")] == ["arm.expanded"]


@pytest.mark.slow
def test_a_check_reads_masses_and_shapes_again(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("urdfsync.analysis.checks.compilation.Compilation.run", lambda *_: None)  # other tests compile
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *_, **__: project / "cache")
    (robot,) = (loaded := config.load(Path("urdfsync.toml"))).robots
    result = checks.check_robot(loaded, robot, CheckOptions())
    assert result.numbers is not None
    assert result.numbers.right == result.numbers.total > 110  # 72 of them in the records
    assert any(sentence.startswith("joints, contacts and sensors of the SDF") for sentence in result.unchecked)
    assert not result.diagnostics
    monkeypatch.setattr(checks, "compare", lambda *_: Answer(differences=("mass of link upper differs by 1.0e-03",)))
    edit("<mass>1.5</mass>", "<mass>1.75</mass>")  # a right result is remembered
    (found,) = [
        each for each in checks.check_robot(loaded, robot, CheckOptions()).diagnostics if "differs" in each.code
    ]
    assert str(found).startswith("sdf/arm.sdf: error: mass of link upper differs by 1.0e-03")

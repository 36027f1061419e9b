"""The motion of a model beside its motion in a git revision."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import pytest
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.simulation import Compiler, run

from urdfsync import api
from urdfsync.analysis.checks.compilers.compiler import CompileResult, SimulationResult
from urdfsync.commands import cli
from urdfsync.common.diagnostics import UrdfsyncError

pytestmark = NEEDS_GIT
TIMES = (0.0, 1.0, 2.0)


def refused(against: str) -> str:
    with pytest.raises(UrdfsyncError) as caught:
        api.simulate(against=against)
    return str(caught.value)


@pytest.fixture
def repository(arm: Path, monkeypatch: pytest.MonkeyPatch) -> Repository:
    """The built arm, committed."""
    repository = Repository(arm, monkeypatch)
    repository.commit()
    return repository


def moved(compiler: Compiler, times: tuple[float, ...] = TIMES, **positions: tuple[float, ...]) -> None:
    """Let the compiler answer with these positions of joints."""
    values = {"time": times, **{f"robot.{name}.revolute.phi": values for name, values in positions.items()}}
    compiler.results.append(CompileResult(runs=(SimulationResult(values),)))


@pytest.mark.slow
def test_the_greatest_difference_of_each_joint_is_shown(
    repository: Repository, compiler: Compiler, execute: Execute
) -> None:
    moved(compiler, shoulder=(0.0, 1.0, 2.0), elbow=(0.0, 0.25, 0.5))
    moved(compiler, shoulder=(0.0, 1.5, 2.25), elbow=(0.0, 0.25, 0.5))
    lines = execute("simulate", "--against", "HEAD").lines
    assert lines[lines.index("  since HEAD: 1 joint differs, 1 equal") :] == [
        "  since HEAD: 1 joint differs, 1 equal",
        "  joint     position by     speed by  effort by  effort before and now",
        "  shoulder  0.5 rad at 1 s  -         -          -",
    ]


@pytest.mark.slow
def test_efforts_are_shown_before_and_now(repository: Repository, compiler: Compiler, execute: Execute) -> None:
    compiler.results = [CompileResult(runs=(SimulationResult(dict(compiler.values)),))]
    compiler.values = {**compiler.values, "robot.shoulderAxis.tau": (0.0, -0.5, 0.0)}
    last = execute("simulate", "--against", "HEAD").lines[-1]
    assert last == "  shoulder  -            -         1.5 N·m at 1 s  0.5 → 1 N·m"


@pytest.mark.slow
def test_equal_motions_are_told_in_one_line(repository: Repository, compiler: Compiler, execute: Execute) -> None:
    assert execute("simulate", "--against", "HEAD").lines[-1] == "  since HEAD: the same motion"


@pytest.mark.slow
def test_both_versions_are_simulated_with_the_same_settings(repository: Repository, compiler: Compiler) -> None:
    api.simulate(against="HEAD", stop=2.0, step=0.5, values=("robot.elbow.parameters.dynamics.damping=4",))
    now, former = (job.tasks[0] for job in compiler.jobs)
    assert now.runs == former.runs
    assert now.source == former.source


@pytest.mark.slow
def test_the_revision_has_its_own_package_and_models(repository: Repository, compiler: Compiler, arm: Path) -> None:
    (arm / "Own.mo").write_text("model Own\n  extends Arm.ArmTest;\nend Own;\n")
    repository.commit()
    package = arm / "modelica/Arm/ArmTest.mo"
    package.write_text(package.read_text().replace("StopTime", "// mine\n      StopTime"))
    (arm / "Own.mo").write_text("model Own // new\n  extends Arm.ArmTest;\nend Own;\n")
    api.simulate(against="HEAD", model="Own")
    texts = [["// mine" in str(job), "// new" in str(job)] for job in compiler.jobs]
    assert len(texts) == 2
    assert not any(texts[1])


@pytest.mark.slow
def test_a_renamed_joint_is_compared_with_its_former_self(
    repository: Repository, compiler: Compiler, execute: Execute, arm: Path
) -> None:
    (arm / "arm.urdf").write_text((arm / "arm.urdf").read_text().replace('name="elbow"', 'name="bend"'))
    execute("build", code=0)
    moved(compiler, bend=(0.0, 0.5, 1.0))
    moved(compiler, elbow=(0.0, 0.5, 1.5))
    assert (
        "  bend (was elbow)  0.5 rad at 2 s  -         -          -" in execute("simulate", "--against", "HEAD").lines
    )


@pytest.mark.slow
def test_the_table_has_both_series(repository: Repository, compiler: Compiler, execute: Execute) -> None:
    """The former simulation ends earlier, so its columns end with blanks."""
    moved(compiler, shoulder=(0.0, 1.0, 2.0))
    moved(compiler, times=TIMES[:2], shoulder=(0.0, 1.5))
    assert (
        "  shoulder  0.5 rad at 1 s  -         -          -"
        in execute("simulate", "--against", "HEAD", "--csv", "a.csv").lines
    )
    with Path("a.csv").open() as opened:
        header, *rows = csv.reader(opened)
    assert header == ["time", "robot.shoulder.revolute.phi", "robot.shoulder.revolute.phi@HEAD"]
    assert rows == [["0.0", "0.0", "0.0"], ["1.0", "1.0", "1.5"], ["2.0", "2.0", ""]]


@pytest.mark.slow
def test_the_picture_and_the_page_have_both_curves(
    repository: Repository, compiler: Compiler, execute: Execute
) -> None:
    pytest.importorskip("matplotlib")
    moved(compiler, shoulder=(0.0, 1.0, 2.0))
    moved(compiler, times=TIMES[:2], shoulder=(0.0, 1.5))
    execute("simulate", "--against", "HEAD", "--plot", "a.svg", "--report", "a.html")
    assert "<!-- Arm.ArmTest; dotted: HEAD -->" in Path("a.svg").read_text()
    page = Path("a.html").read_text()
    assert "the broad curves are those of HEAD" in page
    former = re.search(r'"former":\{"time":\[0.0,1.0,null\],"robot.shoulder.revolute.phi":\[([^]]*)\]\}', page)
    assert former
    assert former[1] == "0.0,1.5,null"


@pytest.mark.slow
def test_the_repository_stays_as_it_is(repository: Repository, compiler: Compiler, arm: Path) -> None:
    (arm / "staged.txt").write_text("new\n")
    repository.git("add", "staged.txt")
    (arm / "arm.urdf").write_text((arm / "arm.urdf").read_text() + "\n")
    before = repository.git("status", "--porcelain"), repository.git("ls-files", "--stage")
    api.simulate(against="HEAD")
    assert (repository.git("status", "--porcelain"), repository.git("ls-files", "--stage")) == before


def test_faults_of_the_revision_name_it(
    repository: Repository, compiler: Compiler, execute: Execute, arm: Path
) -> None:
    source = (arm / "arm.urdf").read_text()
    (arm / "arm.urdf").write_text(source.replace('<mass value="1.0"', '<mass value="one"'))
    repository.commit()
    (arm / "arm.urdf").write_text(source)
    (error,) = execute("simulate", "--against", "HEAD", code=2).errors
    assert re.match(r"HEAD:arm\.urdf:\d+: error: ", error), error
    assert not compiler.jobs


def test_a_revision_without_the_package_is_an_error(
    arm: Path, compiler: Compiler, monkeypatch: pytest.MonkeyPatch
) -> None:
    (arm / ".gitignore").write_text("modelica\n.urdfsync\n")
    Repository(arm, monkeypatch).commit()
    message = refused("HEAD")
    assert (
        "HEAD:modelica/Arm: error: the package of robot `arm` is not built; name a revision with a built package"
        in message
    )


@pytest.mark.parametrize(
    ("against", "message"),
    [("HEAD~9", "is neither a file nor a revision"), ("--help", "is neither a file nor a git revision")],
)
def test_an_unknown_revision_is_an_error(
    repository: Repository, compiler: Compiler, against: str, message: str
) -> None:
    assert message in refused(against)


def test_a_folder_without_git_is_an_error(arm: Path, compiler: Compiler) -> None:
    assert "no git repository" in refused("HEAD")


def test_many_cases_have_no_other_version(arm: Path, compiler: Compiler, execute: Execute) -> None:
    printed = execute("simulate", "--against", "HEAD", "--vary", "a=0..1", code=2)
    assert "no `--against`" in printed.err


@pytest.mark.slow
def test_each_series_equals_that_of_a_plain_simulation(
    repository: Repository, modelica_library: Path, arm: Path
) -> None:
    pytest.importorskip("rumoca")
    then = run(stop=2.0)
    (arm / "arm.urdf").write_text((arm / "arm.urdf").read_text().replace('<mass value="1.0"', '<mass value="1.7"'))
    assert cli.main(["build", "-q"]) == 0
    both = api.simulate(against="HEAD", stop=2.0)
    assert both.series == run(stop=2.0).series
    assert both.former == {name: then.series[name] for name in both.former}
    assert both.against is not None
    efforts = [each for joint in both.against.joints for each in joint.differences if each.quantity == "effort"]
    assert all(each.difference > 0.1 for each in efforts)

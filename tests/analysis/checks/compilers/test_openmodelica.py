"""What only a real OpenModelica shows; with none these tests are skipped, and `test_omc` replays its answers."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from support.checks import status
from support.modelica import CACHE
from support.simulation import ARM

from urdfsync.analysis.checks import compilers
from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.compilers import omc
from urdfsync.analysis.checks.results import CheckOptions, CheckResult, CheckStatus
from urdfsync.analysis.checks.robot import check_robot
from urdfsync.commands import cli
from urdfsync.project import config

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(omc.program("") is None, reason="no OpenModelica: recorded answers stand for it in other tests"),
]

Edit = Callable[[Path], None]


@pytest.fixture(autouse=True)
def package(tmp_path: Path, modelica_library: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project with an arm, built; the package's folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *_, **__: CACHE.folder)
    monkeypatch.setattr(UserCache, "load", lambda *_: None)
    Path("arm.urdf").write_text(ARM)
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    assert cli.main(["build", "-q"]) == 0
    return tmp_path / "modelica/Arm"


def check(tool: str, *, physics: bool = False) -> CheckResult:
    loaded = config.load(Path("urdfsync.toml").absolute())
    tools = compilers.choose(loaded, tool)
    return check_robot(loaded, loaded.robots[0], CheckOptions(physics=physics, tools=tools, compilers=2))


def replaced(name: str, old: str, new: str) -> Edit:
    def edit(package: Path) -> None:
        text = (package / name).read_text()
        assert old in text
        (package / name).write_text(text.replace(old, new, 1))

    return edit


def test_two_compilers_and_pinocchio_agree() -> None:
    result = check("both", physics=True)
    assert (status(result, strict=True), result.diagnostics) == (CheckStatus.RIGHT, ())
    assert [one.tool.partition(" ")[0] for one in result.tools] == ["rumoca", "OpenModelica"]
    assert [one.model for one in result.tools[1].compiled] == ["Arm", "ArmRun", "ArmTest"]
    found = [*(result.deviations or ()), *(result.between or ())]
    assert 0 < max(one.relative for one in found) < 1e-12


@pytest.mark.parametrize(("edit", "place", "code", "words"), [
    (
        replaced("Joints/Elbow.mo", "\nequation\n", "\n  Real extra;\nequation\n"),
        ("modelica/Arm/Joints/Elbow.mo", ""), "unbalanced", "1 equation too few",
    ),
    (
        replaced("Joints/Elbow.mo", "useAxisFlange = true", 'useAxisFlange = "yes"'),
        ("modelica/Arm/Joints/Elbow.mo", 'useAxisFlange = "yes"'), "does-not-compile", "expected subtype of Boolean",
    ),
    (
        replaced("Joints/Elbow.mo", "\nequation\n", "\n  Modelica.Units.SI.Length far = revolute.w;\nequation\n"),
        ("modelica/Arm/Joints/Elbow.mo", "Length far"), "units", 'has unit "m"',
    ),
])  # fmt: skip
def test_a_fault_is_told_at_its_line(package: Path, edit: Edit, place: tuple[str, str], code: str, words: str) -> None:
    edit(package)
    (found,) = check("omc").diagnostics
    file, text = place
    lines = (package / "Joints/Elbow.mo").read_text().splitlines()
    line = next((number for number, one in enumerate(lines, 1) if text and text in one), 0)
    assert (found.file, found.line, found.code) == (file, line, code)
    assert words in found.message


@pytest.mark.parametrize(("edit", "quantity", "element"), [
    (replaced("Links/LowerParameters.mo", "mass = 1", "mass = 1.5"), "effort", "joint shoulder"),
    (replaced("Joints/ElbowParameters.mo", "{0, 0, 1}", "{0, 1, 0}"), "orientation", "link lower"),
])  # fmt: skip
def test_what_an_edit_does_is_the_same_by_both(package: Path, edit: Edit, quantity: str, element: str) -> None:
    edit(package)
    result = check("both", physics=True)
    assert max(one.relative for one in result.between_edited) < 1e-12
    (effect,) = result.effects
    assert (quantity, element) in [(str(one.quantity), one.element) for one in effect.deviations]
    assert status(result, strict=False) is CheckStatus.RIGHT
    assert status(result, strict=True) is CheckStatus.DIFFERS


def test_a_parameter_that_does_not_exist_is_told_with_the_nearest(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["simulate", "--tool", "omc", "--set", "robot.elbow.parameters.dynamics.dampin=4"]) == 2
    assert capsys.readouterr().err.startswith(
        "arm: compiling Arm.ArmTest with OpenModelica\n"
        "error: `Arm.ArmTest` has no parameter `robot.elbow.parameters.dynamics.dampin`; "
        "did you mean `robot.elbow.parameters.dynamics.damping`?"
    )


def test_a_simulation_gives_the_same_by_both(capsys: pytest.CaptureFixture[str]) -> None:
    tables = []
    for tool in ("rumoca", "omc"):
        arguments = ["--stop", "0.5", "--tolerance", "1e-8", "--set", "robot.elbow.parameters.dynamics.damping=4"]
        assert cli.main(["simulate", "--tool", tool, *arguments]) == 0
        tables.append([line.split() for line in capsys.readouterr().out.splitlines()[1:]])
    assert tables[0] == tables[1]
    assert len(tables[0]) == 3

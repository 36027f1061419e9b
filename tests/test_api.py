"""The API: `urdfsync.build` and other functions return values, print nothing, and raise their commands' errors."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from support.commands import Execute
from support.networks import LADDER, edit, source

import urdfsync
from urdfsync.analysis.checks.results import CheckResult
from urdfsync.analysis.simulation.results import SimulateResult
from urdfsync.common.diagnostics import ConfigError
from urdfsync.engine.actions import FileStatus

REPOSITORY = Path(__file__).parents[1]
ROBOTS = REPOSITORY / "modelica/UrdfSync/Resources/robots"
PAGE = (REPOSITORY / "docs/api.md").read_text(encoding="utf-8")


def test_the_shipped_arm_in_ten_lines(folder: Path, capfd: pytest.CaptureFixture[str]) -> None:
    arm = ROBOTS / "six_axis_arm/six_axis_arm.urdf"
    Path("urdfsync.toml").write_text(f"[robots.arm]\nsource = '{arm}'\npackage = 'Arm'\n")
    (result,) = urdfsync.build("arm")
    assert result.in_step
    assert (folder / "modelica/Arm/Arm.mo").is_file()
    (standing,) = urdfsync.status()
    assert {action.reason.status for action in standing.actions} == {FileStatus.IN_STEP}
    assert "record ArmParameters" in urdfsync.record(arm, class_="ArmParameters").text
    assert (urdfsync.library_folder() / "UrdfSync/package.mo").is_file()
    assert capfd.readouterr() == ("", "")


def test_results_look_as_the_commands_show_them(project: Path, execute: Execute) -> None:
    assert str(urdfsync.build(dry=True)) == execute("build", "--dry-run").out.rstrip("\n")
    assert urdfsync.build(config=urdfsync.load(project / "urdfsync.toml"))[0].in_step
    edit(f"{LADDER}/Ladder.mo", "end Ladder;\n", "  // mine\nend Ladder;\n")
    source('"R2"', '"R3"')
    assert str(urdfsync.status()) == execute("status", code=3).out.rstrip("\n")
    assert str(urdfsync.diff("ladder")) == execute("diff", code=1).out.rstrip("\n")
    assert str(urdfsync.edits()) == execute("diff", "--edits").out.rstrip("\n")
    assert str(urdfsync.build()) == execute("build", code=3).out.rstrip("\n")
    assert '<span style="font-weight: bold">ladder</span>: 1 conflict' in urdfsync.build(merge=False)._repr_html_()


def test_foreign_text_is_no_html(project: Path) -> None:
    source('"R2"', '"<script>"')
    (result,) = results = urdfsync.build()
    assert result.failed
    assert "&lt;script&gt;" in results._repr_html_()
    assert "<script>" not in results._repr_html_()


@pytest.mark.parametrize("name", ["build", "status", "check", "simulate", "diff", "edits"])
def test_a_robot_that_does_not_exist_is_the_error_of_the_command(project: Path, execute: Execute, name: str) -> None:
    said = execute(*(("diff", "--edits") if name == "edits" else (name,)), "lader", code=2).err
    with pytest.raises(urdfsync.UrdfsyncError) as error:
        getattr(urdfsync, name)("lader")
    assert isinstance(error.value, ConfigError)
    assert f"{error.value}\n" == said
    assert "did you mean `ladder`?" in said


def test_checks_and_simulations_are_values(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("urdfsync.analysis.checks.run.check_robots", lambda *_: iter([CheckResult("ladder", "Ladder")]))
    (checked,) = results = urdfsync.check(physics=True)
    assert (checked.robot, str(results)) == ("ladder", "ladder: right: syntax and layout; 0.0 s")
    simulated = SimulateResult("ladder", "Ladder.Test", 1, 0.5, 1e-6, (), {"time": (0.0, 1.0)}, (), 2, is_known=False)
    monkeypatch.setattr("urdfsync.analysis.simulation.run.simulate", lambda *_: simulated)
    result = urdfsync.simulate(files={"csv": Path("ladder.csv")})
    assert result.series["time"] == (0.0, 1.0)
    assert Path("ladder.csv").read_text() == "time\n0.0\n1.0\n"
    assert "</span>: Ladder.Test, 1 s in steps of 0.5 s" in result._repr_html_()


@pytest.mark.parametrize("function", [urdfsync.check, urdfsync.simulate])
def test_a_compiler_that_does_not_exist_is_an_error_of_urdfsync(project: Path, function: Callable[..., object]) -> None:
    with pytest.raises(urdfsync.UrdfsyncError, match="no compiler 'omcc' to check with; use one of rumoca, omc, both"):
        function(tool="omcc")


def test_all_names_are_there_and_on_the_page_and_nothing_is_loaded_before() -> None:
    assert all(hasattr(urdfsync, name) for name in urdfsync.__all__)
    assert set(urdfsync.__all__) < set(dir(urdfsync))  # notebooks complete names by this list
    functions = {name for name in urdfsync.__all__ if name[0].islower()}
    # importing a module of the same name would replace the function
    assert functions.isdisjoint(path.stem for path in Path(urdfsync.__file__).parent.iterdir())
    assert functions <= set(re.findall(r"`urdfsync\.(\w+)\(?", PAGE))
    with pytest.raises(AttributeError, match="has no attribute 'biuld'"):
        _ = urdfsync.biuld  # type: ignore[attr-defined]
    code = "import sys, urdfsync; print(*(name for name in sys.modules if name.startswith(('urdfsync.', 'msgspec'))))"
    assert subprocess.check_output([sys.executable, "-c", code], text=True).split() == [
        "urdfsync.common",
        "urdfsync.common.version",
    ]


@pytest.mark.slow
def test_a_script_that_starts_processes_needs_no_main_guard(folder: Path) -> None:
    source = ROBOTS / "planar_platform/planar_platform.urdf"
    Path("urdfsync.toml").write_text(f"[robots.platform]\nsource = '{source}'\npackage = 'Platform'\n")
    Path("script.py").write_text("import urdfsync\nurdfsync.build()\nprint(urdfsync.check()[0].diagnostics)\n")
    # without a library nothing is compiled, which has a process of its own in any case
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "HOME": str(folder), "MODELICAPATH": ""}
    command = [sys.executable, "script.py"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=200, check=True)
    assert done.stderr == ""
    assert "check-crashed" not in done.stdout

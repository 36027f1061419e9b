"""What `check` and `simulate` remember: the commands, with a compiler that notes what it is asked."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from support import fake_omc
from support.cases import sampled
from support.corpus import REPOSITORY
from support.simulation import ARM
from support.trajectories import write_trajectory

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform == "win32", reason="the stand-in for omc is a script"),
]

BALANCED = '"Check of it completed successfully.\nClass it has 4 equation(s) and 4 variable(s)."\n""\n'
RESULT = 'record SimulationResult\n    resultFile = "{}",\n    messages = ""\nend SimulationResult;\n""\n'

Ask = Callable[[str], int]


@pytest.fixture
def ask(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Ask:
    """Run a command with an installation of urdfsync of its own; returns how often the compiler was at work."""
    home, project = tmp_path / "installed", tmp_path / "project"
    for name in ("urdfsync", "templates", "modelica"):
        shutil.copytree(REPOSITORY / name, home / name, ignore=shutil.ignore_patterns("__pycache__"))
    project.mkdir()
    (project / "arm.urdf").write_text(ARM)
    (project / "urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    trajectory = tmp_path / "it_res.mat"
    write_trajectory(trajectory, {"k": 7.0}, {"time": (0.0, 1.0), "p": (1.0, 2.0)})
    fake_omc.install(tmp_path / "bin", {"checkModel": BALANCED, "simulate": RESULT.format(trajectory)})
    environment = {
        **os.environ,
        "PYTHONPATH": str(home),
        "OPENMODELICAHOME": str(tmp_path),
        "MODELICAPATH": str(tmp_path / "libraries"),
        "XDG_CACHE_HOME": str(tmp_path / "cache"),
        "HOME": str(tmp_path),
    }
    asked = tmp_path / "bin/asked.txt"

    def run(command: str) -> int:
        asked.write_text("")
        program = [sys.executable, "-P", "-m", "urdfsync", *command.split()]
        done = subprocess.run(program, cwd=project, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return sum(call.startswith(("checkModel(", "simulate(")) for call in asked.read_text().splitlines())

    run("build")
    return run


@pytest.mark.parametrize("command", sampled(["check --tool omc --trust", "simulate --tool omc --trust"], 2))
def test_one_line_of_what_a_result_rests_on_makes_it_anew(command: str, ask: Ask, tmp_path: Path) -> None:
    """Whoever develops urdfsync does not change the version; `test_fingerprint` shows the same of packages."""
    assert ask(command) > 0
    assert ask(command) == 0
    for file in (
        "installed/urdfsync/checks/texts.py",
        "installed/urdfsync/urdf/robot.py",
        "installed/modelica/UrdfSync/Friction/Rotational.mo",
        "bin/omc",
        *(["installed/templates/urdf/macros.jinja"] if "check" in command else []),
    ):
        comment = {".py": "# a line\n", "": "# a line\n", ".jinja": "<# a line #>"}.get(
            Path(file).suffix, "// a line\n"
        )
        with (tmp_path / file).open("a") as stream:
            stream.write(comment)
        assert ask(command) > 0, file
    assert ask(command) == 0

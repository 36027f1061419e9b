"""Fixtures: a small arm to simulate, and a compiler that only keeps its jobs."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from support import urdfs
from support.modelica import CACHE
from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.compilers.compiler import CompileJob, CompileResult, SimulationResult, Tool
from urdfsync.analysis.checks.process import Limits
from urdfsync.analysis.simulation.results import SimulateOptions, SimulateResult
from urdfsync.analysis.simulation.run import simulate
from urdfsync.commands import cli
from urdfsync.common.diagnostics import UrdfsyncError
from urdfsync.engine.options import no_progress
from urdfsync.project import config

ARM = urdfs.robot(
    *urdfs.links(base=None, upper=2.0, lower=1.0),
    urdfs.joint("shoulder", "revolute", "base", "upper", axis="0 1 0", inside=[urdfs.limit(-2, 2, 3, 50)]),
    urdfs.joint(
        "elbow",
        "revolute",
        "upper",
        "lower",
        axis="0 0 1",
        inside=[urdfs.limit(-1, 1.5, 4, 20), '<dynamics damping="0.5" friction="0.1"/>'],
    ),
    name="arm",
)


class Compiler:
    """Replace `compilers.run_job`: return the same result for each job, and keep the jobs."""

    def __init__(self) -> None:
        self.jobs: list[CompileJob] = []
        self.results: list[CompileResult] = []
        self.values: Mapping[str, tuple[float, ...]] = {
            "time": (0.0, 1.0, 2.0),
            "robot.shoulder.revolute.phi": (0.0, 1.0, 2.5),
            "robot.shoulder.revolute.w": (0.0, 1.0, 0.0),
            "robot.shoulderAxis.tau": (0.0, 1.0, 0.0),
            "robot.elbow.revolute.phi": (0.0, 0.25, 0.5),
            "robot.elbow.revolute.w": (0.0, 0.0, 0.0),
        }
        limits = {"lower": -2.0, "upper": 2.0, "velocity": 3.0}
        self.parameters = {f"robot.shoulder.parameters.limits.{name}": limit for name, limit in limits.items()}

    def __call__(
        self,
        tool: Tool,
        job: CompileJob,
        cache: UserCache,
        limits: Limits,
        progress: object = None,
        on_result: object = None,
    ) -> list[CompileResult]:
        """Return the next of the results, or the series."""
        self.jobs.append(job)
        run = SimulationResult(self.values, parameters=self.parameters)
        return [self.results.pop(0) if self.results else CompileResult(runs=(run,))]

    @property
    def source(self) -> str:
        """The last compiled text."""
        return self.jobs[-1].tasks[0].source


@pytest.fixture(scope="session")
def built_arm(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project with the package `Arm`; tests work on copies of it."""
    folder = tmp_path_factory.mktemp("arm") / "project"
    folder.mkdir()
    (folder / "arm.urdf").write_text(ARM)
    (folder / "urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    assert cli.main(["build", "-q", "--config", str(folder / "urdfsync.toml")]) == 0
    return folder


@pytest.fixture
def arm(built_arm: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the project, which is the working folder; the compiler keeps its cache, but no results."""
    folder = tmp_path / "project"
    shutil.copytree(built_arm, folder)
    monkeypatch.chdir(folder)
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *_, **__: CACHE.folder)
    monkeypatch.setattr(UserCache, "load", lambda *_: None)
    monkeypatch.setattr(UserCache, "trim", lambda *_: None)  # trimming takes a second for 10,000 files
    return folder


@pytest.fixture
def compiler(arm: Path, modelica_library: Path, monkeypatch: pytest.MonkeyPatch) -> Compiler:
    """A compiler that compiles nothing, for the arm."""
    found = Compiler()
    monkeypatch.setattr("urdfsync.analysis.checks.compilers.run_job", found)
    return found


OWN = "model Own\n  extends Arm.ArmTest;\n  parameter Real k = 2;\n  Real y = k*time;\nend Own;\n"


def run(**options: Any) -> SimulateResult:
    found = config.load(Path("urdfsync.toml"))
    return simulate(found, found.robots[0], SimulateOptions(**options), no_progress)


def refused(**options: Any) -> str:
    with pytest.raises(UrdfsyncError) as caught:
        run(**options)
    return str(caught.value)

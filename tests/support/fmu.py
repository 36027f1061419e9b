"""FMUs that no compiler has made, a stand-in for FMPy, and fixtures of both."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path
from typing import Any

import pytest

from support.simulation import Compiler
from urdfsync.analysis.checks.compilers.compiler import CompileResult, Export, Tool
from urdfsync.analysis.simulation import fmu
from urdfsync.analysis.simulation.export import Exported, export
from urdfsync.analysis.simulation.results import SimulateOptions, SimulateResult
from urdfsync.project import config

DESCRIPTION = b"""<fmiModelDescription description="Arm.ArmRun, exported by urdfsync 1.0.0">
  <ModelExchange modelIdentifier="Arm_ArmRun">
    <SourceFiles/>
  </ModelExchange>
  <CoSimulation modelIdentifier="Arm_ArmRun"/>
  <ScalarVariable name="der(der(der(robot.elbow.phi)))"/><ScalarVariable name="der(robot.elbow.phi)"/>
</fmiModelDescription>
"""
BOTH = Export("2.0", "me_cs")
OPTIONS = SimulateOptions(tool=Tool("omc"))


def archive() -> bytes:
    """An FMU as OpenModelica writes it, but without code."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as file:
        file.writestr("modelDescription.xml", DESCRIPTION)
        file.writestr("binaries/linux64/Arm_ArmRun.so", b"code")
    return content.getvalue()


@pytest.fixture
def openmodelica(compiler: Compiler, monkeypatch: pytest.MonkeyPatch) -> Compiler:
    """A stand-in for OpenModelica that makes an FMU from any model."""
    monkeypatch.setattr("urdfsync.analysis.checks.compilers.find_missing", lambda _: None)
    compiler.results = [CompileResult(fmu=archive(), version="1.27.0")]
    return compiler


def exported(options: SimulateOptions = OPTIONS) -> Exported:
    loaded = config.load(Path("urdfsync.toml").absolute())
    return export(loaded, loaded.robots[0], options, BOTH, lambda *_: None, for_trial=True)


class Fmpy:
    """Replace `process.run`: FMPy has these findings, and the FMU has these series."""

    def __init__(self, findings: list[str], **series: dict[str, list[float]]) -> None:
        self.answer: Any = fmu._Examined(findings, series, {"cs": "a step failed"} if findings else {})
        self.request: Any = None

    def __call__(self, function: object, request: Any, **_: object) -> list[Any]:
        """Answer."""
        self.request = request
        return [self.answer]


REFERENCE = {"time": (0.0, 0.5, 0.5, 1.0), "elbow_phi": (0.0, 0.25, 0.5, 1.0), "elbow_tau": (0.0, 1.0, 2.0, 4.0)}


@pytest.fixture
def reference(monkeypatch: pytest.MonkeyPatch) -> list[SimulateOptions]:
    """Replace `simulate`, and return the options of its calls; the trajectory has an event at 0.5 s."""
    asked: list[SimulateOptions] = []

    def simulate(_config: object, _robot: object, options: SimulateOptions, _progress: object) -> SimulateResult:
        asked.append(options)
        return SimulateResult("arm", "Arm.ArmRun", 1.0, 0.5, 1e-10, (), REFERENCE, (), 1.0, is_known=False)

    monkeypatch.setattr(fmu, "simulate", simulate)
    return asked

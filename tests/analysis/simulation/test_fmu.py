"""FMUs that are tried out: their trajectories are compared with those of `simulate`, at rest or with a motion."""

from __future__ import annotations

import math
from pathlib import Path

import msgspec
import pytest
from support.fmu import OPTIONS, Fmpy, archive, exported
from support.simulation import Compiler

from urdfsync.analysis.checks.compilers.compiler import CompileResult
from urdfsync.analysis.simulation.fmu import FmuTrial, try_out
from urdfsync.analysis.simulation.results import SimulateOptions
from urdfsync.project import config


def tried(options: SimulateOptions = OPTIONS) -> FmuTrial:
    loaded = config.load(Path("urdfsync.toml").absolute())
    return try_out(loaded, loaded.robots[0], options, exported(), ("me", "cs"), lambda *_: None)


def test_a_trajectory_is_compared_at_all_results_with_the_nearest_at_an_event(
    openmodelica: Compiler, reference: list[SimulateOptions], monkeypatch: pytest.MonkeyPatch
) -> None:
    same = {"time": [0.0, 0.5, 1.0], "elbow_phi": [0.0, 0.5, 1.0], "elbow_tau": [0.0, 2.0, 4.0]}
    monkeypatch.setattr(
        "urdfsync.analysis.checks.process.run", Fmpy([], me=same, cs={**same, "elbow_tau": [0.0, 2.0, 4.4]})
    )
    found = tried()
    assert found.agreement == {"me": 0.0, "cs": pytest.approx(0.1)}
    assert (found.worst["cs"], found.compared) == ("elbow_tau", 2)
    assert reference[0].as_exported
    assert reference[0].tolerance == 1e-10


def test_a_motion_goes_step_by_step_and_only_to_co_simulation(
    openmodelica: Compiler, reference: list[SimulateOptions], monkeypatch: pytest.MonkeyPatch
) -> None:
    Path("motion.csv").write_text("time,shoulder_phi,elbow_phi\n0,0,0\n1,1,1\n2,4,8\n3,9,27\n")
    fmpy = Fmpy([])
    monkeypatch.setattr("urdfsync.analysis.checks.process.run", fmpy)
    tried(msgspec.structs.replace(OPTIONS, motion=Path("motion.csv")))
    assert fmpy.request.kinds == ["cs"]
    place = fmpy.request.times.index(pytest.approx(1.5))
    assert fmpy.request.inputs["shoulder_phi"][place] == pytest.approx(1.5**2)
    assert fmpy.request.inputs["elbow_phi"][place] == pytest.approx(1.5**3)


def test_a_trajectory_that_is_no_number_or_ends_early_does_not_agree(
    openmodelica: Compiler, reference: list[SimulateOptions], monkeypatch: pytest.MonkeyPatch
) -> None:
    late = {"time": [0.0, 0.5, 1.0], "elbow_tau": [0.0, float("nan"), 4.0]}
    monkeypatch.setattr(
        "urdfsync.analysis.checks.process.run", Fmpy([], me=late, cs={"time": [0.0, 0.5], "elbow_tau": [0.0, 2.0]})
    )
    found = tried()
    assert found.agreement["me"] == math.inf
    assert found.problems == {"cs": "the FMU ends at 0.5 s, not at 1 s"}
    openmodelica.results = [CompileResult(fmu=archive())]
    monkeypatch.setattr("urdfsync.analysis.checks.process.run", Fmpy([], me={"time": [0.0, 0.5, 1.0]}))
    assert tried().problems == {"me": "the FMU has no variable of the model"}

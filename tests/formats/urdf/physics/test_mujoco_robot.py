"""MuJoCo in place of Pinocchio: the same numbers of the same robots, and it sees the same faults."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from support import corpus, loops, physics
from support.urdfs import dynamics, joint, limit, link, links, mimic, robot

from urdfsync.domain import Target
from urdfsync.domain.experiment import Experiment, Sample
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.physics.multibody import Array
from urdfsync.formats.urdf.physics.regressor import read_regressor

IMU = '<gazebo reference="hand"><sensor name="imu" type="imu"><pose>0.1 0.2 -0.3 0.4 -0.5 0.6</pose></sensor></gazebo>'
LOAD = '<gazebo reference="glue"><sensor name="load" type="force_torque"/></gazebo>'
ARM = robot(
    *links(base=4.0, arm=2.5, drone=0.7, hand=0.4, ring=None, bob=0.5),
    link("stick", 0.3).replace('ixx="0.0063"', 'ixx="0.1"'),  # a tensor that no body has
    joint("elbow", "revolute", "base", "arm", inside=[dynamics(1, 1), limit()]),
    joint("slide", "prismatic", "base", "drone", inside=[dynamics(2, 3), limit()]),
    joint("glue", "fixed", "arm", "hand"),
    joint("spin", "continuous", "hand", "ring", axis="0 1 0"),
    joint("follower", "revolute", "ring", "stick", inside=[mimic("elbow", -2, 0.1), limit()]),
    joint("tip", "ball", "stick", "bob", inside=['<dynamics damping="0.1"/>']),
    *(IMU, LOAD),
)


def without_pinocchio(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "urdfsync.formats.urdf.physics.pinocchio_robot", None)


def experiment(content: bytes, options: Options) -> Experiment | str:
    found = DOMAIN.checks.experiment(Sample(content, "robot.urdf", Target("Bot", "Bot"), options, {}))
    assert isinstance(found, Experiment | str)
    return found


def assert_same(content: bytes, options: Options, monkeypatch: pytest.MonkeyPatch) -> None:
    """All expected numbers agree, relative to the greatest of their kind."""
    found = [experiment(content, options)]
    without_pinocchio(monkeypatch)
    found.append(experiment(content, options))
    if isinstance(found[0], str):
        assert found[0] == found[1]
        return
    first, second = (each for each in found if isinstance(each, Experiment))
    assert first.reference.startswith("Pinocchio")
    assert second.reference.startswith("MuJoCo")
    assert (first.content, first.notes, first.unchecked) == (second.content, second.notes, second.unchecked)
    for one, other in zip(first.trials, second.trials, strict=True):
        assert [each.values for each in one.compared] == [each.values for each in other.compared]
        numbers = dict[tuple[str, str], list[tuple[Array, Array]]]()
        for each in one.compared:
            pair = (np.array([trial.expected[value] for value in each.values]) for trial in (one, other))
            numbers.setdefault((each.quantity.value, each.unit), []).append(tuple(pair))  # type: ignore[arg-type]
        for kind, pairs in numbers.items():
            size = max(1e-3, *(float(np.nanmax(np.abs(first))) for first, _ in pairs))
            for first_values, second_values in pairs:
                assert second_values == pytest.approx(first_values, abs=1e-10 * size, rel=0, nan_ok=True), kind


@pytest.mark.parametrize("base", ["fixed", "floating"])
def test_both_references_say_the_same_of_joints_sensors_and_tensors(base: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert_same(ARM.encode(), Options(base=base), monkeypatch)  # type: ignore[arg-type]


@pytest.mark.parametrize("name", loops.ROBOTS)
def test_both_references_say_the_same_of_loops(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    bars = loops.ROBOTS[name]
    sensor = f'<gazebo reference="{bars.joints[-1].name}"><sensor name="l" type="force_torque"/></gazebo></robot>'
    content = loops.to_urdf(bars).replace("</robot>", sensor).encode()
    assert_same(content, Options(**loops.to_options(bars)), monkeypatch)


TINY = [file for file in corpus.robots() if file.endswith("robotisOP2.urdf")]
"""Its tensors are so small that MuJoCo rounds them."""


@pytest.mark.parametrize("file", [*corpus.robots()[::15], *TINY], ids=corpus.label)
def test_both_references_say_the_same_of_real_robots(corpus: Path, file: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert_same((corpus / file).read_bytes(), Options(), monkeypatch)


def test_efforts_are_linear_in_the_same_parameters(monkeypatch: pytest.MonkeyPatch) -> None:
    sample = Sample(ARM.replace('"ball"', '"fixed"').encode(), "a.urdf", Target("Bot", "Bot"), Options(), {})
    motion = np.array([[[0.3, -0.2, 0.4]], [[0.5, 0.7, -0.6]], [[0.7, 1.1, -0.9]]])
    models = [read_regressor(sample, {})]
    without_pinocchio(monkeypatch)
    models.append(read_regressor(sample, {}))
    (slopes, efforts), others = (model.rows(*motion) for model in models)
    assert others[0] == pytest.approx(slopes, abs=1e-11)
    assert others[1] == pytest.approx(efforts, abs=1e-11)
    bodies = [body.name for body in models[1].bodies]
    assert bodies == ["arm", "hand", "stick", "bob", "drone"]
    assert [body.is_first for body in models[1].bodies] == [True, False, True, False, True]


FAULTS: Mapping[str, tuple[str, str, str]] = {
    "mass": ("Links/HandParameters.mo", "mass = 0.4", "mass = 0.401"),
    "axis": ("Joints/SpinParameters.mo", "axis = {0, 1, 0}", "axis = {0, 1, 0.001}"),
    "origin": ("Joints/ElbowParameters.mo", "xyz = {0.1, ", "xyz = {0.1001, "),
    "damping": ("Joints/SlideParameters.mo", "damping = 2", "damping = 2.001"),
}


@pytest.mark.slow
def test_mujoco_alone_sees_faults(modelica_library: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    without_pinocchio(monkeypatch)
    text = ARM.replace('"ball"', '"fixed"').encode()
    right = physics.prepare(text, "Right").only("motion")
    wrong = [physics.prepare(text, name.capitalize()).only("motion").changed(*FAULTS[name]) for name in FAULTS]
    agreeing, *faulty = physics.compare(modelica_library, tmp_path, [right, *wrong])
    assert physics.fault(agreeing) is None
    assert max(each.relative for each in agreeing) < 1e-9
    assert [bool(physics.fault(each)) for each in faulty] == [True] * len(FAULTS)

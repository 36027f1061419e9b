"""Greatest loads and reach over a grid: Pinocchio computes the same at each pose."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from support.urdfs import joint, limit, link, links, parsed, robot

from urdfsync.formats.urdf.kinematics.loads import find_extremes, find_grids, positions
from urdfsync.formats.urdf.kinematics.poses import GRAVITY
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.robot import Joint, JointType

ARM = Path(__file__).parents[4] / "modelica/UrdfSync/Resources/robots/six_axis_arm/six_axis_arm.urdf"


def test_loads_and_reach_are_those_of_pinocchio(monkeypatch: pytest.MonkeyPatch) -> None:
    """The shipped arm has a slider, followers, several leaves, and more joints than one grid takes."""
    monkeypatch.setattr("urdfsync.formats.urdf.kinematics.loads._MOST", 300)  # takes a second less
    tree = KinematicTree.of(parsed(ARM.read_text()))
    model = pin.buildModelFromUrdf(str(ARM))
    model.gravity.linear = np.array([0, 0, -GRAVITY])
    data, rest = model.createData(), dict.fromkeys(model.names[1:], 0.0)
    expected, reach = dict[str, float](), 0.0
    for path, grid in find_grids(tree):
        for number in range(max(map(len, grid))):
            at = {one.name: float(values[number % len(values)]) for one, values in zip(path, grid, strict=True)}
            q = pin.neutral(model)
            for name, value in (rest | {name: value for name, value in at.items() if name in rest}).items():
                found = model.joints[model.getJointId(name)]
                q[found.idx_q : found.idx_q + found.nq] = value if found.nq == 1 else (math.cos(value), math.sin(value))
            efforts = pin.computeGeneralizedGravity(model, data, q)
            pin.framesForwardKinematics(model, data, q)
            for one in path:
                place = data.oMf[model.getFrameId(one.child, pin.BODY)].translation
                reach = max(reach, float(np.linalg.norm(place)))
                if one.name in rest:
                    effort = abs(float(efforts[model.joints[model.getJointId(one.name)].idx_v]))
                    expected[one.name] = max(expected.get(one.name, 0.0), effort)
    found_reach, loads = find_extremes(tree)
    assert found_reach == pytest.approx(reach, abs=1e-6)
    assert dict(loads) == pytest.approx(expected, abs=1e-6)


HALF = math.pi / 2


@pytest.mark.parametrize(
    ("kind", "lower", "upper", "expected"),
    [
        ("revolute", -2.0, 3.0, [-2.0, -HALF, 0.0, HALF, 3.0]),
        ("revolute", 0.1, 0.2, [0.1, 0.2]),
        ("revolute", -7.0, 7.0, [0.0, HALF, 2 * HALF, 3 * HALF]),
        ("continuous", -math.inf, math.inf, [0.0, HALF, 2 * HALF, 3 * HALF]),
        ("prismatic", -2.0, 3.0, [-2.0, 3.0]),
        ("prismatic", -math.inf, math.inf, [0.25]),
        ("revolute", 2.0, 1.0, [0.25]),
        ("fixed", 0.0, 0.0, [0.25]),
    ],
)
def test_positions_of_a_joint(kind: JointType, lower: float, upper: float, expected: list[float]) -> None:
    assert positions(Joint("j", kind, "a", "b"), lower, upper, 0.25) == pytest.approx(expected)


def test_a_long_branch_has_a_grid_at_each_end() -> None:
    """A chain of three has one grid with all poses."""
    chain = [joint(f"j{k}", "revolute", f"l{k}", f"l{k + 1}", inside=[limit(0.1, 0.2)]) for k in range(14)]
    names = [f"l{k}" for k in range(15)]
    tree = KinematicTree.of(parsed(robot(*map(link, names), *chain)))
    moving = [
        [one.name for one, values in zip(path, grid, strict=True) if len(values) > 1] for path, grid in find_grids(tree)
    ]
    assert moving == [[f"j{k}" for k in range(10)], [f"j{k}" for k in range(4, 14)]]
    short = KinematicTree.of(parsed(robot(*map(link, names[:4]), *chain[:3])))
    ((_, grid),) = find_grids(short)
    assert len(set(zip(*grid, strict=True))) == 8


def test_robots_without_an_answer() -> None:
    loop = (
        '<loop_joint name="l" type="spherical"><link1 link="a" xyz="0 0 0"/><link2 link="b" xyz="0 0 0"/></loop_joint>'
    )
    joints = [joint("ja", "continuous", "base", "a"), joint("jb", "continuous", "base", "b")]
    assert find_extremes(KinematicTree.of(parsed(robot(*links(base=1.0, a=1.0, b=1.0), *joints, loop)))) == (None, {})
    assert find_extremes(KinematicTree.of(parsed(robot(link("base", 1.0))))) == (0.0, {})
    huge = robot(link("base"), link("a", 1e308, center="1e9 0 0"), joints[0])
    assert find_extremes(KinematicTree.of(parsed(huge)))[1] == {}

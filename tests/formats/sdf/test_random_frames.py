"""A random robot in SDF, with each pose given in a random frame, equals the same robot in URDF, by Pinocchio."""

from __future__ import annotations

import math
from collections.abc import Sequence
from random import Random
from typing import Any

import numpy as np
import pinocchio
import pytest
from support.cases import CASES
from support.random_sdfs import example
from support.sdfs import urdf

_STATES = 3


def numbers_of(text: str, states: Sequence[dict[str, float]], *, is_fixed: bool) -> list[Any]:
    """Return mass matrix, weights and places of the centres of mass of the links at each state."""
    free = () if is_fixed else (pinocchio.JointModelFreeFlyer(),)
    model = pinocchio.buildModelFromXML(text, *free)
    data, result = model.createData(), list[Any]()
    for state in states:
        q, rows = pinocchio.neutral(model), list(range(0 if is_fixed else 6))
        for name, position in sorted(state.items()):
            joint = model.joints[model.getJointId(name)]
            turned = (math.cos(position), math.sin(position))
            q[joint.idx_q : joint.idx_q + joint.nq] = turned if joint.nq == 2 else position
            rows.append(joint.idx_v)
        mass = pinocchio.crba(model, data, q)
        result.append((np.triu(mass) + np.triu(mass, 1).T)[np.ix_(rows, rows)])
        result.append(pinocchio.computeGeneralizedGravity(model, data, q)[rows])
        result.append(pinocchio.centerOfMass(model, data, q))
    return result


@pytest.mark.parametrize("seed", range(max(60, CASES)))
def test_a_robot_in_random_frames_moves_as_its_urdf(seed: int) -> None:
    robot, random = example(seed), Random(seed)
    states = [{name: random.uniform(-1, 1) for name in robot.joints} for _ in range(_STATES)]
    found, _ = urdf(robot.sdf, robot="arm")
    ours, theirs = (numbers_of(text, states, is_fixed=robot.is_fixed) for text in (found, robot.urdf))
    for first, second in zip(ours, theirs, strict=True):
        assert np.abs(first - second).max(initial=0) <= 1e-12 * max(1.0, np.abs(second).max(initial=0))

"""The reference against other ways to the same numbers, such as derivatives of momentum.

That it moves and pushes as generated robots do, tests/modelica/test_joints.py shows.
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest
from numpy.typing import NDArray
from support.urdfs import joint, links, mimic, parsed, robot

from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.physics import motion
from urdfsync.urdf.physics.reference import Configuration, Instant, Reference, read

Array = NDArray[np.float64]

DRIVEN = robot(
    *links(base=4.0, upper=2.5, hand=0.7, finger=0.2),
    joint("shoulder", "revolute", "base", "upper", axis="0 1 0"),
    joint("slide", "prismatic", "upper", "hand", axis="-2 0 0"),
    joint("grip", "continuous", "hand", "finger", axis="0 1 1", inside=[mimic("shoulder", -1.5, 0.2)]),
)


class Bot:
    """A reference, and the state that the motion gives it."""

    def __init__(self, urdf: str) -> None:
        self.axes = motion.driven_axes(KinematicTree.of(parsed(urdf)))
        self.reference = Reference(read(urdf.encode(), "robot.urdf"), [joint.name for joint in self.axes])

    def state(self, time: float = 0.0) -> Configuration:
        return self.reference.state(time, [motion.axis_course(joint) for joint in self.axes])

    def instant(self, time: float = 0.0) -> Instant:
        return self.reference.solve(self.state(time))


def test_the_wrench_on_the_base_is_the_change_of_momentum() -> None:
    """Newton's and Euler's laws for the whole robot, about the origin of the world, by central differences."""
    bot, step = Bot(DRIVEN), 1e-4
    before, after, now = (momentum(bot, time) for time in (-step, step, 0.0))
    change = (after - before) / (2 * step)
    instant = bot.instant()
    mass, centre = instant.mass_and_centre()
    weight = np.array([0, 0, -mass * motion.GRAVITY])
    place, axes = instant.frame("base")
    force, torque = axes @ instant.force, axes @ instant.torque
    assert force + weight == pytest.approx(change[:3], abs=1e-5)
    assert torque + np.cross(place, force) + np.cross(centre, weight) == pytest.approx(change[3:], abs=1e-5)
    assert np.abs(now).max() > 1
    assert mass == pytest.approx(7.4)


def momentum(bot: Bot, time: float) -> Array:
    """Linear and angular momentum about the origin of the world."""
    state, model = bot.state(time), bot.reference.model
    data = model.createData()
    about_centre = pin.computeCentroidalMomentum(model, data, state.q, state.v)
    shifted = about_centre.angular + np.cross(data.com[0], about_centre.linear)
    return np.concatenate([about_centre.linear, shifted])


def test_followers_move_with_their_leader_and_load_it() -> None:
    bot = Bot(DRIVEN)
    state, model = bot.state(), bot.reference.model
    (shoulder, _) = [motion.axis_course(joint) for joint in bot.axes]
    grip = model.joints[model.getJointId("grip")]
    angle = np.arctan2(state.q[grip.idx_q + 1], state.q[grip.idx_q])
    assert angle == pytest.approx(-1.5 * shoulder.position + 0.2)
    efforts = pin.rnea(model, model.createData(), state.q, state.v, state.a)
    both = efforts[model.joints[model.getJointId("shoulder")].idx_v] - 1.5 * efforts[grip.idx_v]
    assert bot.instant().efforts[0] == pytest.approx(both)

"""The reference against other ways to the same numbers: forward dynamics, and derivatives of momentum.

That it moves and pushes as generated robots do, on planes too, tests/modelica/test_joints.py shows.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pinocchio as pin
import pytest
from numpy.typing import NDArray
from support.urdfs import dynamics, joint, links, mimic, parsed, robot

from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.physics import motion
from urdfsync.urdf.physics.reading import read
from urdfsync.urdf.physics.reference import Configuration, Instant, Reference
from urdfsync.urdf.robot import Joint

Array = NDArray[np.float64]

DRIVEN = robot(
    *links(base=4.0, upper=2.5, hand=0.7, finger=0.2),
    joint("shoulder", "revolute", "base", "upper", axis="0 1 0"),
    joint("slide", "prismatic", "upper", "hand", axis="-2 0 0"),
    joint("grip", "continuous", "hand", "finger", axis="0 1 1", inside=[mimic("shoulder", -1.5, 0.2)]),
)
FREE = robot(
    *links(base=4.0, carrier=1.0, drone=3.0, arm=1.0, puck=0.5),
    joint("rail", "prismatic", "base", "carrier", axis="0 1 1", inside=[dynamics(0.3, 0.1)]),
    joint("air", "floating", "carrier", "drone"),
    joint("turn", "revolute", "drone", "arm", axis="1 0 0", inside=[dynamics(0.2, 0.1)]),
    joint("tray", "planar", "arm", "puck", axis="0.3 1 -0.2", inside=[dynamics(0.4, 0.3)]),
)
"""A floating joint and a planar one, each moved by a driven one."""


class Bot:
    """A reference, and the state that the motion gives it."""

    def __init__(self, urdf: str) -> None:
        skeleton = KinematicTree.of(parsed(urdf))
        self.axes, self.free = motion.driven_axes(skeleton), motion.free_joints(skeleton)
        self.reference = Reference(read(urdf.encode(), "robot.urdf"), names(self.axes), names(self.free))
        self.starts = {j.name: self.reference.start(j.name, motion.free_start(j)) for j in self.free}

    def state(self, time: float = 0.0) -> Configuration:
        return self.reference.state(time, [motion.axis_course(joint) for joint in self.axes], self.starts)

    def instant(self, time: float = 0.0) -> Instant:
        return self.reference.solve(self.state(time))


def names(joints: Sequence[Joint]) -> list[str]:
    return [joint.name for joint in joints]


def test_hybrid_dynamics_are_forward_dynamics_with_the_efforts_that_they_give() -> None:
    """The articulated-body algorithm (Featherstone 2008, section 7.3) needs no split into known and unknown."""
    bot = Bot(FREE)
    state, instant = bot.state(), bot.instant()
    model = bot.reference.model
    efforts = np.concatenate([instant.force, instant.torque, np.zeros(model.nv - 6)])
    efforts += bot.reference.projection @ instant.efforts
    losses = bot.reference.losses(state.v)
    assert np.count_nonzero(losses) == 5
    data = model.createData()
    a = pin.aba(model, data, state.q, state.v, efforts - losses)
    known = np.setdiff1d(np.arange(model.nv), bot.reference.loose)
    assert known.size == 8
    assert a[known] == pytest.approx(state.a[known], abs=1e-9)
    pin.forwardKinematics(model, data, state.q, state.v, a)
    for link_name in ("drone", "puck"):
        number = model.getFrameId(link_name, pin.BODY)
        linear, angular = instant.acceleration(link_name)
        world = pin.getFrameClassicalAcceleration(model, data, number, pin.LOCAL_WORLD_ALIGNED)
        assert linear == pytest.approx(world.linear, abs=1e-9)
        assert angular == pytest.approx(pin.getFrameClassicalAcceleration(model, data, number, pin.LOCAL).angular)


def test_the_wrench_on_the_base_is_the_change_of_momentum() -> None:
    """Newton's and Euler's laws for the whole robot, about the origin of the world, by central differences."""
    bot, step = Bot(DRIVEN), 1e-4
    before, after, now = (momentum(bot, time) for time in (-step, step, 0.0))
    change = (after - before) / (2 * step)
    instant = bot.instant()
    mass, centre = instant.mass_and_centre()
    weight = np.array([0, 0, -mass * motion.GRAVITY])
    base = instant.frame("base")
    force, torque = base.axes @ instant.force, base.axes @ instant.torque
    assert force + weight == pytest.approx(change[:3], abs=1e-5)
    assert torque + np.cross(base.place, force) + np.cross(centre, weight) == pytest.approx(change[3:], abs=1e-5)
    assert np.abs(now).max() > 1
    assert mass == pytest.approx(7.4)


def momentum(bot: Bot, time: float) -> Array:
    """Linear and angular momentum about the origin of the world."""
    state, model = bot.state(time), bot.reference.model
    data = model.createData()
    about_centre = pin.computeCentroidalMomentum(model, data, state.q, state.v)
    shifted = about_centre.angular + np.cross(data.com[0], about_centre.linear)
    return np.concatenate([about_centre.linear, shifted])


def test_a_state_is_found_again_from_the_frames_of_links() -> None:
    bot = Bot(FREE)
    state, instant = bot.state(), bot.instant()
    frames = {joint.name: instant.frame(joint.child) for joint in bot.free}
    again = bot.reference.state(0.0, [motion.axis_course(joint) for joint in bot.axes], frames, in_world=True)
    assert again.q == pytest.approx(state.q, abs=1e-12)
    assert again.v == pytest.approx(state.v, abs=1e-12)


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

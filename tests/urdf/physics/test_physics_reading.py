"""What Pinocchio reads of a URDF, and what is said when it does not."""

from __future__ import annotations

import sys

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from support.urdfs import dynamics, joint, limit, link, mimic, robot

from urdfsync.diagnostics import SourceError
from urdfsync.urdf.physics.reading import Follower, directions, read

VECTORS = st.tuples(*[st.floats(-100, 100)] * 3).map(np.array)


def test_the_root_link_moves_and_has_its_inertia() -> None:
    model = read(robot(link("base", 2.0)).encode(), "robot.urdf").model
    assert model.nv == 6
    assert model.inertias[1].mass == 2.0


def test_a_root_joint_of_the_robot_is_no_clash() -> None:
    urdf = robot(link("base"), link("arm"), joint("root_joint", "continuous", "base", "arm"))
    assert "root_joint" in read(urdf.encode(), "robot.urdf").model.names


def test_mimic_is_read_from_the_file() -> None:
    parts = [link(name) for name in ("base", "left", "right")]
    joints = [
        joint("lead", "continuous", "base", "left"),
        joint("follow", "revolute", "base", "right", inside=[limit(), mimic("lead", -2.0, 0.1)]),
    ]
    assert read(robot(*parts, *joints).encode(), "robot.urdf").followers == {"follow": Follower("lead", -2.0, 0.1)}


def test_a_planar_joint_is_two_slides_and_a_turn_with_losses_each() -> None:
    urdf = robot(
        link("floor"),
        link("plate", 3.0),
        joint("skate", "planar", "floor", "plate", axis="0 3 4", inside=[dynamics(2, 1)]),
    )
    reading = read(urdf.encode(), "robot.urdf")
    plane = reading.planes["skate"]
    assert plane.axes[0] == pytest.approx([1, 0, 0])
    assert plane.axes[2] == pytest.approx([0, 0.6, 0.8])
    kinds = [reading.model.joints[reading.model.getJointId(part)].shortname() for part in plane.parts]
    assert [kind.removeprefix("JointModel")[0] for kind in kinds] == ["P", "P", "R"]
    assert list(reading.model.damping[6:]) == [2, 2, 2]
    assert list(reading.model.friction[6:]) == [1, 1, 1]
    assert reading.model.frames[reading.model.getFrameId("plate", pin.BODY)].parentJoint == 4


@given(VECTORS)
def test_directions_of_a_plane_are_a_right_handed_frame(normal: np.typing.NDArray[np.float64]) -> None:
    assume(np.linalg.norm(normal) > 1e-3)
    axes = directions(normal)
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1)
    assert np.cross(axes[2], normal) == pytest.approx(np.zeros(3), abs=1e-9)


REFUSED = {
    "joint [elbow]: limit has no effort": '<limit lower="-1" upper="1" velocity="1"/>',
    "joint dynamics element specified with no damping and no friction": f"{limit()}<dynamics/>",
}


@pytest.mark.parametrize(("reason", "inside"), REFUSED.items())
def test_what_pinocchio_says_is_one_line_and_nothing_else(
    reason: str, inside: str, capfd: pytest.CaptureFixture[str]
) -> None:
    urdf = robot(link("base"), link("arm"), joint("elbow", "revolute", "base", "arm", inside=[inside]))
    with pytest.raises(SourceError) as caught:
        read(urdf.encode(), "arm.urdf")
    (diagnostic,) = caught.value.diagnostics
    assert (diagnostic.code, diagnostic.file) == ("pinocchio-refuses", "arm.urdf")
    assert diagnostic.message == f"Pinocchio can't read this file: {reason}"
    assert capfd.readouterr() == ("", "")


def test_a_mass_that_pinocchio_leaves_out_is_no_agreement() -> None:
    urdf = robot('<link name="base"><inertial><mass value="1"/></inertial></link>')
    with pytest.raises(SourceError, match="Could not parse inertial element"):
        read(urdf.encode(), "robot.urdf")


def test_without_pinocchio_it_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pinocchio", None)
    with pytest.raises(SourceError) as caught:
        read(robot(link("base")).encode(), "robot.urdf")
    (diagnostic,) = caught.value.diagnostics
    assert (diagnostic.code, diagnostic.hint) == ("no-pinocchio", "pip install pin")

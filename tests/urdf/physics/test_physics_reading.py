"""What Pinocchio is given of a URDF: mimic and planar joints, which it does not read by itself."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from support.urdfs import dynamics, joint, link, robot

from urdfsync.diagnostics import SourceError
from urdfsync.urdf.physics.free_joints import directions
from urdfsync.urdf.physics.reading import read

NORMALS = arrays(np.float64, 3, elements=st.floats(-100, 100))


def test_a_planar_joint_is_two_slides_and_a_turn_with_losses_each() -> None:
    losses = [dynamics(2, 1)]
    skate = joint("skate", "planar", "floor", "plate", axis="0 3 4", inside=losses)
    found = read(robot(link("floor"), link("plate", 3.0), skate).encode(), "robot.urdf")
    plane = found.split_joints["skate"]
    assert plane.axes[0] == pytest.approx([1, 0, 0])
    assert plane.axes[2] == pytest.approx([0, 0.6, 0.8])
    kinds = [found.model.joints[found.model.getJointId(part)].shortname() for part in plane.parts]
    assert [kind.removeprefix("JointModel")[0] for kind in kinds] == ["P", "P", "R"]
    assert list(found.model.damping[6:]) == [2, 2, 2]
    assert list(found.model.friction[6:]) == [1, 1, 1]
    assert found.model.frames[found.model.getFrameId("plate", pin.BODY)].parentJoint == 4


@given(NORMALS)
def test_directions_of_a_plane_are_a_right_handed_frame(normal: np.typing.NDArray[np.float64]) -> None:
    assume(np.linalg.norm(normal) > 1e-3)
    axes = directions(normal)
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1)
    assert np.cross(axes[2], normal) == pytest.approx(np.zeros(3), abs=1e-9)


def test_a_file_that_pinocchio_refuses_is_named() -> None:
    elbow = joint("elbow", "revolute", "base", "arm", inside=['<limit lower="-1" upper="1" velocity="1"/>'])
    with pytest.raises(SourceError) as caught:
        read(robot(link("base"), link("arm"), elbow).encode(), "arm.urdf")
    (diagnostic,) = caught.value.diagnostics
    assert (diagnostic.code, diagnostic.file) == ("pinocchio-refuses", "arm.urdf")

"""What Pinocchio is given of a planar joint, and what is said of a URDF that it can't read."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from support.urdfs import joint, link, robot

from urdfsync.diagnostics import SourceError
from urdfsync.urdf.physics.reading import directions, read


@given(arrays(np.float64, 3, elements=st.floats(-100, 100)))
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

"""A URDF that Pinocchio can't read."""

from __future__ import annotations

import pytest
from support.urdfs import joint, link, robot

from urdfsync.diagnostics import SourceError
from urdfsync.urdf.physics.reading import read


def test_a_file_that_pinocchio_refuses_is_named() -> None:
    elbow = joint("elbow", "revolute", "base", "arm", inside=['<limit lower="-1" upper="1" velocity="1"/>'])
    with pytest.raises(SourceError) as caught:
        read(robot(link("base"), link("arm"), elbow).encode(), "arm.urdf")
    (diagnostic,) = caught.value.diagnostics
    assert (diagnostic.code, diagnostic.file) == ("pinocchio-refuses", "arm.urdf")

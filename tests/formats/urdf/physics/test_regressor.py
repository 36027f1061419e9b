"""The efforts of a robot by its parameters: all that Pinocchio's own reader leaves out takes part in them."""

from __future__ import annotations

import numpy as np
from support.urdfs import joint, links, mimic, robot

from urdfsync.domain import Target
from urdfsync.domain.experiment import Sample
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.physics.regressor import read_regressor

PARTS = (*links(base=1, arm=2, hand=3), joint("arm", "continuous", "base", "arm", axis="0 1 0"))
CONTROL = """<ros2_control name="c"><joint name="hand"><param name="mimic">arm</param>
  <param name="multiplier">-2</param><state_interface name="position"/></joint></ros2_control>"""


def test_a_joint_that_ros2_control_couples_follows_as_one_with_a_mimic_does() -> None:
    efforts = []
    for inside, more in ((mimic("arm", -2), ""), ("", CONTROL)):
        hand = joint("hand", "continuous", "arm", "hand", axis="0 1 0", inside=[inside])
        sample = Sample(robot(*PARTS, hand, more).encode(), "a.urdf", Target("Bot", "Bot"), Options(), {})
        model = read_regressor(sample, {})
        assert [axis.name for axis in model.axes] == ["arm"]
        efforts.append(model.rows(*np.array([[[0.3]], [[0.5]], [[0.7]]]))[1])
    assert efforts[0] == efforts[1] != 0

"""A damaged MJCF gives a robot or a finding, in bounded time: no traceback, no hang."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.cases import CASES
from support.damage import assert_robot_or_finding, damaged
from support.mjcfs import ARM

PARTS = """\
<actuator><position joint="shoulder" kp="3" forcerange="-4 4"/><motor joint="elbow" gear="5"/></actuator>
<equality><joint joint1="elbow" joint2="shoulder" polycoef="0.1 2 0 0 0"/></equality>
<sensor><jointpos joint="elbow"/></sensor>
<keyframe><key name="home" qpos="0.1 0.3"/></keyframe>
</mujoco>
"""
TEXT = ARM.replace("</mujoco>", PARTS)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(max(20, CASES)))
def test_a_damaged_source_gives_a_robot_or_a_finding(folder: Path, seed: int) -> None:
    file = folder / "arm.xml"
    file.write_bytes(damaged(TEXT, seed, word=r'"([^"]*)"'))
    assert_robot_or_finding(file)

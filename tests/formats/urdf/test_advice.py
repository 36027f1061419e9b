"""What `init` guesses: which robots stand on the ground by themselves, and the reason it gives."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from pathlib import Path

import pytest
from support import corpus as real

from urdfsync.formats.urdf.advice import guess_base
from urdfsync.formats.urdf.parse.source import read_robot
from urdfsync.formats.urdf.robot import Joint, JointType, Link, Robot

MOBILE = "atlas jackal qbot2e robotisop2 turtlebot3 mir upkie sigmaban stompy gpr spirit".split()
STATIONARY = """
    robotiq openmanipulator open_manipulator qarm sawyer ur5e onrobot schunk al5d iiwa puma560 px100 irb rx160 m430ia
    m900ib so101 reachy_mini
""".split()


def robot(*children: str, root: str = "base", kind: JointType = "revolute", joints: Sequence[str] = ()) -> Robot:
    """Links around a root link; joints are numbered unless they are named."""
    names = joints or [f"joint{number}" for number in range(len(children))]
    arms = tuple(Joint(name, kind, root, child) for name, child in zip(names, children, strict=True))
    return Robot("r", tuple(Link(name) for name in (root, *children)), arms)


MOVING = [
    ("wheel_left", "wheel_right"),
    ("FrontLeftWheel", "FrontRightWheel"),
    ("left_track", "right_track"),
    ("caster_1", "caster_2", "drive"),
    ("l_foot", "r_foot"),
    ("LF_HIP", "RF_HIP"),
    ("leftUpperLeg", "rightUpperLeg"),
    ("fl_lowerleg", "fr_lowerleg"),
    ("leg1", "leg2", "leg3"),
    ("MP_ANKLE1_L", "MP_ANKLE1_R"),
]
BOLTED = [
    ("upper_arm", "lower_arm"),
    ("tracker_left", "tracker_right"),
    ("chip_1", "ship_2"),
    ("elegant", "legacy"),
    ("toehold", "football"),
    ("sensor_wheel", "arm"),
    (),
]


@pytest.mark.parametrize(
    ("links", "base"), [*((one, "floating") for one in MOVING), *((one, "fixed") for one in BOLTED)]
)
def test_robots_on_wheels_and_legs_move_freely_and_others_are_bolted_down(links: tuple[str, ...], base: str) -> None:
    assert guess_base(robot(*links)).value == base
    assert guess_base(robot(*links, kind="fixed")).value == "fixed", "a wheel that does not turn is a picture of one"


@pytest.mark.parametrize("name", ["rotor_{}", "thruster{}", "propeller-{}", "prop_{}", "motor_{}"])
def test_a_robot_that_flies_or_swims_moves_freely(name: str) -> None:
    """Motors of an arm turn the next link, or not all the way round."""
    names = [name.format(number) for number in range(4)]
    assert guess_base(robot(*names, kind="continuous")).value == "floating"
    assert guess_base(robot(*names)).value == "fixed"
    chain = [Joint(f"j{k}", "continuous", parent, child) for k, (parent, child) in enumerate(itertools.pairwise(names))]
    assert guess_base(Robot("r", tuple(map(Link, names)), tuple(chain))).value == "fixed"


def test_names_of_joints_count_as_well() -> None:
    found = guess_base(robot("rotor_2", "rotor", joints=("right_hip_yaw", "left_hip_yaw")))
    assert (found.option, found.value) == ("base", "floating")
    assert found.reason == 'joint "left_hip_yaw" and others sound like legs'


def test_the_root_decides_before_everything_else() -> None:
    wheels = ("wheel_left", "wheel_right")
    assert guess_base(robot(*wheels, root="world")).value == "fixed"
    assert guess_base(robot("arm", root="base_footprint")).value == "floating"
    assert 'named "base_footprint"' in guess_base(robot("arm", root="base_footprint")).reason


def expected(file: str) -> str:
    """What a person says who looks at the robot."""
    path = file.lower()
    if any(name in path for name in STATIONARY):
        return "fixed"
    return "floating" if any(name in path for name in MOBILE) else "nobody has looked at it"


@pytest.mark.slow
def test_real_robots_are_guessed_right(corpus: Path) -> None:
    wrong = {}
    for file in real.distinct_files():
        found = read_robot((corpus / file).read_bytes(), file).robot
        if found is not None and guess_base(found).value != expected(file):
            wrong[file] = guess_base(found)
    assert wrong == {}

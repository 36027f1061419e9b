"""What resists the motion of joints is the diagonal of the mass matrix, which Pinocchio finds in another way."""

from __future__ import annotations

import numpy as np
import pinocchio
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support import urdfs
from support.trees import ORIGINS, SCALAR, robots

from urdfsync.urdf.kinematics import start_positions
from urdfsync.urdf.resistance import resistances, unresisted
from urdfsync.urdf.robot import Inertia, Inertial, Link, Robot
from urdfsync.urdf.skeleton import Skeleton
from urdfsync.urdf.source import read_robot

ARM = urdfs.robot(
    *(urdfs.link(name, mass) for name, mass in (("base", 5), ("upper", 3), ("lower", 2), ("hand", 0.5), ("rail", 1))),
    urdfs.link("flange"),
    urdfs.joint("lift", "revolute", "base", "upper", axis="0.6 0 0.8", inside=[urdfs.limit(0.5, 2)]),
    urdfs.joint("bend", "revolute", "upper", "lower", axis="0 1 0", inside=[urdfs.limit(-2, -0.3)]),
    urdfs.joint("fasten", "fixed", "lower", "flange"),
    urdfs.joint("reach", "prismatic", "flange", "hand", axis="1 0 0", inside=[urdfs.limit(0.1, 0.4)]),
    urdfs.joint("slide", "prismatic", "base", "rail", axis="0 0 1", inside=[urdfs.limit()]),
)
"""No joint but the last can be at zero."""


def skeleton(urdf: str) -> Skeleton:
    robot = read_robot(urdf.encode(), "own.urdf", cross_check=False).robot
    assert robot is not None
    return Skeleton.of(robot)


def test_they_are_the_diagonal_of_the_mass_matrix_at_the_start() -> None:
    of, model = skeleton(ARM), pinocchio.buildModelFromXML(ARM)
    start, names = start_positions(of), list(model.names)[1:]
    matrix = pinocchio.crba(model, model.createData(), np.array([start[name] for name in names]))
    found = resistances(of)
    assert set(found) == set(names)
    assert [found[name] for name in names] == pytest.approx(np.diag(matrix), rel=1e-12)


def test_a_leader_moves_its_followers_with_their_ratios() -> None:
    plain = resistances(skeleton(ARM))
    led = ARM.replace("</robot>", "").splitlines()
    mimic = [
        line.replace("</joint>", f"{urdfs.mimic('lift', -3)}</joint>") if '"slide"' in line else line for line in led
    ]
    found = resistances(skeleton("\n".join([*mimic, "</robot>"])))
    assert found["lift"] == pytest.approx(plain["lift"] + 9 * plain["slide"], rel=1e-12)


def test_what_is_on_the_axis_is_no_inertia_even_far_from_the_root() -> None:
    """Where terms of 1e4 cancel each other."""
    rod = '<inertial><origin xyz="0 0 0.2"/><mass value="2"/><inertia ixx="1" iyy="1" izz="0" ixy="0" ixz="0" iyz="0"/>'
    urdf = urdfs.robot(
        urdfs.link("base", 1),
        f'<link name="rod">{rod}</inertial></link>',
        urdfs.joint("spin", "continuous", "base", "rod", axis="0 0 1", xyz="70 -30 20"),
    )
    assert resistances(skeleton(urdf)) == {"spin": 0.0}


SIZES = st.sampled_from([0.0, 1e-15, 1e-9, 1e-6, 0.5, 2.0])
INERTIAS = st.builds(lambda size, x, xy: Inertia(ixx=size * x, iyy=size, izz=size, ixy=xy * size), SIZES, SIZES, SIZES)
INERTIALS = st.none() | st.builds(Inertial, SIZES, ORIGINS, INERTIAS)


@settings(deadline=None)
@given(robots(types=(*SCALAR, "fixed")), st.lists(INERTIALS, min_size=7, max_size=7))
def test_a_joint_is_unresisted_if_its_resistance_is_zero(robot: Robot, inertials: list[Inertial | None]) -> None:
    links = tuple(Link(link.name, inertial) for link, inertial in zip(robot.links, inertials, strict=False))
    of = Skeleton.of(Robot(robot.name, links, robot.joints))
    found = resistances(of)
    assert unresisted(of) == {joint.name for joint in of.joints if joint.mimic is None and found.get(joint.name) == 0}


def test_where_a_link_behind_each_joint_has_an_inertia_nothing_is_added_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr("urdfsync.urdf.resistance.link_poses")
    near = ARM.replace('lower="0.1"', 'lower="-0.1"')
    turn = urdfs.joint("turn", "continuous", "base", "nothing", axis="0 0 1")
    hold = urdfs.joint("hold", "fixed", "nothing", "held")
    more = "".join([urdfs.link("nothing"), urdfs.link("held", 1), turn, hold])
    assert unresisted(skeleton(near.replace("</robot>", f"{more}</robot>"))) == set()


def rod(izz: float) -> str:
    return f'<inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="{izz!r}" ixy="0" ixz="0" iyz="0"/></inertial>'


AT = {"xyz": "0 0 0", "rpy": "0 0 0"}
SPIN = urdfs.joint("spin", "continuous", "base", "rod", axis="0 0 1", xyz="70 -30 20")
SPUN = urdfs.joint("spin", "continuous", "far", "rod", axis="0 0 1", **AT)
FAR = [urdfs.limit(1e6, 2e6)], [urdfs.limit(-2e6, 2e6), urdfs.mimic("lead", 1, 1e6)]
HIDDEN = {
    "far from the root": [f'<link name="rod">{rod(1e-12)}</link>', SPIN],
    "a negative one": [
        *(f'<link name="{name}">{rod(izz)}</link>' for name, izz in (("rod", 1.0), ("other", -1.0))),
        *(SPIN, urdfs.joint("hold", "fixed", "rod", "other", **AT)),
    ],
    **{
        name: [
            *(urdfs.link("far"), urdfs.link("led", 1), f'<link name="rod">{rod(1e-3)}</link>'),
            *(urdfs.joint("lead", "continuous", "base", "led", axis="0 0 1"), SPUN),
            urdfs.joint("slide", "prismatic", "base", "far", axis="1 0 0", inside=inside, **AT),
        ]
        for name, inside in zip(("a start far away", "a start that follows from another"), FAR, strict=True)
    },
}


@pytest.mark.parametrize("elements", HIDDEN.values(), ids=HIDDEN)
def test_an_inertia_that_does_not_count_resists_nothing(elements: list[str]) -> None:
    assert unresisted(skeleton(urdfs.robot(urdfs.link("base", 1), *elements))) == {"spin"}

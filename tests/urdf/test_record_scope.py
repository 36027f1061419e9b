"""What the generic robot can't take is a warning at its line, if the record approach is asked for, and a way out."""

from __future__ import annotations

import pytest
from support import urdfs

from urdfsync.diagnostics import Severity
from urdfsync.urdf.domain import DOMAIN
from urdfsync.urdf.options import Options

PLANAR = urdfs.robot(
    urdfs.link("base", 1),
    urdfs.link("puck", 1),
    urdfs.link("lever", 1),
    urdfs.joint("glide", "planar", "base", "puck", axis="0 0 1"),
    urdfs.joint("swing", "continuous", "puck", "lever", axis="0 0 1"),
)
FREE_ROOT = urdfs.robot(
    urdfs.link("world"), urdfs.link("drone", 1), urdfs.joint("fly", "floating", "world", "drone"), name="drone"
)
FREE_INSIDE = urdfs.robot(
    urdfs.link("base", 1),
    urdfs.link("boat", 1),
    urdfs.link("mast", 1),
    urdfs.joint("drift", "floating", "base", "boat"),
    urdfs.joint("lean", "continuous", "base", "mast", axis="1 0 0"),
)
STATUE = urdfs.robot(urdfs.link("base", 1), urdfs.link("head", 1), urdfs.joint("neck", "fixed", "base", "head"))


def warnings(urdf: str, *approach: str) -> list[str]:
    options = Options(cross_check=False, approach=approach)  # type: ignore[arg-type]
    found = DOMAIN.read(urdf.encode(), "own.urdf", options).diagnostics
    assert all(one.severity is Severity.WARNING for one in found)
    return [str(one) for one in found if one.code.endswith(("-not-generic", "nothing-moves"))]


@pytest.mark.parametrize("approach", [("record",), ("package", "record")])
def test_a_planar_joint_is_named_with_its_line_and_what_to_do(approach: tuple[str, ...]) -> None:
    assert warnings(PLANAR, *approach) == [
        "own.urdf:6: warning: the generic robot has no planar joints, so there are no tables for it: joint 'glide'; "
        'write it as two prismatic joints and a continuous one, or use `approach = ["package"]` [planar-not-generic]'
    ]


def test_a_floating_joint_at_the_root_is_what_a_floating_base_is_for() -> None:
    (warning,) = warnings(FREE_ROOT, "record")
    assert warning.startswith("own.urdf:5: warning: the generic robot has no floating joints")
    assert 'leave it out with its parent link, and set `base = "floating"`' in warning


def test_a_floating_joint_elsewhere_can_be_taken_apart() -> None:
    (warning,) = warnings(FREE_INSIDE, "record")
    assert "joint 'drift'; write it as three prismatic joints and three continuous ones" in warning


@pytest.mark.parametrize("urdf", [STATUE, urdfs.robot(urdfs.link("base", 1))], ids=["fixed joints", "one link"])
def test_a_robot_that_does_not_move_says_so_once(urdf: str) -> None:
    assert warnings(urdf, "record") == [
        "own.urdf:2: warning: the generic robot needs a joint that moves, so there are no tables for it; "
        'use `approach = ["package"]`, or take the record as it is [nothing-moves]'
    ]


@pytest.mark.parametrize("urdf", [PLANAR, FREE_ROOT, FREE_INSIDE, STATUE])
def test_the_package_approach_has_no_reason_to_warn(urdf: str) -> None:
    assert warnings(urdf, "package") == []

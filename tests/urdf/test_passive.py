"""Passive joints that move no mass are named where the package approach is asked for; driven ones are not."""

from __future__ import annotations

from typing import Any

import pytest
from support import urdfs

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.urdf.domain import DOMAIN
from urdfsync.urdf.options import Options

CODE = "passive-moves-no-mass"
DRIVE = '<transmission name="t"><joint name="wheel"/></transmission>'
CART = urdfs.robot(
    urdfs.link("base", 1),
    urdfs.link("tyre", 1),
    urdfs.link("roller"),
    urdfs.joint("wheel", "continuous", "base", "tyre", axis="0 1 0", xyz="0 0 0.1"),
    urdfs.joint("caster", "continuous", "base", "roller", axis="0 0 1"),
).replace("</robot>", f"{DRIVE}</robot>")
"""Going by the source, the wheel is driven and the caster is passive."""
TWINS = urdfs.robot(
    urdfs.link("base", 1),
    urdfs.link("ring"),
    urdfs.link("arm", 1),
    urdfs.joint("first", "continuous", "base", "ring", axis="0 0 1"),
    urdfs.joint("second", "continuous", "ring", "arm", axis="0 0 1", xyz="0 0 0.3", rpy="0 0 0"),
)
"""Two joints on one axis, and nothing between them."""


def warnings(urdf: str, **options: Any) -> list[Diagnostic]:
    found = DOMAIN.read(urdf.encode(), "own.urdf", Options(cross_check=False, **options)).diagnostics
    return [one for one in found if one.code == CODE]


def test_a_caster_without_a_mass_is_named_with_its_line_and_what_to_do() -> None:
    (found,) = warnings(CART)
    assert found.severity is Severity.WARNING
    assert str(found) == (
        "own.urdf:7: warning: joint 'caster' is not driven and moves no mass where it starts, so nothing determines "
        "its motion in Run and Test; give a link behind it an <inertial>, drive it (`driven`), or make it a fixed "
        "joint [passive-moves-no-mass]"
    )


@pytest.mark.parametrize(
    ("options", "names"),
    [
        ({"driven": ("wheel", "caster")}, []),
        ({"driven": ("caster",)}, []),
        ({"driven": ("wheel",)}, ["caster"]),
        ({"approach": ("record",)}, []),
        ({"approach": ("package", "record")}, ["caster"]),
    ],
)
def test_what_is_driven_counts_and_so_does_the_approach(options: dict[str, Any], names: list[str]) -> None:
    assert [found.message.split("'")[1] for found in warnings(CART, **options)] == names


def test_a_caster_that_turns_a_mass_is_fine() -> None:
    heavy = CART.replace('<link name="roller"/>', urdfs.link("roller", 0.2))
    assert heavy != CART
    assert warnings(heavy) == []


@pytest.mark.parametrize(
    ("driven", "names"),
    [((), ["first"]), (("second",), []), (("first",), []), (("first", "second"), [])],
)
def test_a_driven_joint_behind_a_passive_one_does_not_undo_its_motion(
    driven: tuple[str, ...], names: list[str]
) -> None:
    assert [found.message.split("'")[1] for found in warnings(TWINS, driven=driven)] == names


def test_a_passive_leader_moves_what_its_followers_move() -> None:
    def led(mass: float | None) -> str:
        follow = urdfs.joint("follow", "continuous", "base", "thumb", axis="0 0 1", inside=[urdfs.mimic("caster", 2)])
        return CART.replace("</robot>", f"{urdfs.link('thumb', mass)}{follow}</robot>")

    assert warnings(led(1)) == []
    assert len(warnings(led(None))) == 1

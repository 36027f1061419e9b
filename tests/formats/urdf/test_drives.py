"""Which joints Run and Test drive."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pytest

from urdfsync.formats.urdf.drives import passive_joints, wanted_joints
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import Command, Joint, Limit, Mimic


def joint(
    name: str,
    kind: str = "continuous",
    limit: bool = False,
    mimic: str = "",
    actuated: bool = False,
    measured: bool = False,
) -> Joint:
    return Joint(
        name,
        kind,  # type: ignore[arg-type]
        "p",
        "c",
        limit=Limit() if limit else None,
        mimic=Mimic(mimic) if mimic else None,
        actuated=actuated,
        measured=measured,
    )


CART = (
    joint("wheel", actuated=True),
    joint("caster"),
    joint("mast", "revolute", limit=True),
    joint("lid", "revolute"),
    joint("lift", "prismatic"),
    joint("spindle", limit=True),
    joint("slave", mimic="wheel"),
    joint("driven slave", mimic="wheel", actuated=True),
    joint("weld", "fixed", actuated=True),
    joint("glide", "planar"),
    joint("fly", "floating"),
)
DRIVEN = {"wheel", "mast", "lid", "lift", "spindle"}


SILENT = [joint("wheel"), *CART[1:7], *CART[9:]]
"""Without any drive."""


@pytest.mark.parametrize(("joints", "names", "driven", "passive"), [
    pytest.param(CART, None, DRIVEN, {"caster"}, id="others have a drive"),
    pytest.param([joint("fork", "revolute", limit=True, measured=True), joint("wheel")], None, {"wheel"}, {"fork"},
        id="one is only measured"),
    pytest.param(SILENT, None, {*DRIVEN, "caster"}, set(), id="nobody has one"),
    pytest.param(CART, (), set(), {"caster"}, id="none is asked for"),
    pytest.param(CART, ("caster", "caster", "mast"), {"caster", "mast"}, {"caster"}, id="two are asked for"),
    pytest.param(CART, ("mast", "slave", "weld", "glide", "fly", "gone"), {"mast"}, {"caster"}, id="no axes"),
])  # fmt: skip
def test_driven_and_passive_joints(
    joints: Sequence[Joint], names: tuple[str, ...] | None, driven: set[str], passive: set[str]
) -> None:
    assert wanted_joints(joints, Options(driven=names)) == driven
    assert passive_joints(joints) == passive


def test_a_command_in_the_options_drives_a_passive_joint_unless_they_name_all_that_are_driven() -> None:
    commands: Mapping[str, Command] = {"caster": "velocity", "slave": "effort"}
    assert wanted_joints(CART, Options(commands=commands)) == {*DRIVEN, "caster"}
    assert wanted_joints(CART, Options(commands=commands, driven=("mast",))) == {"mast"}

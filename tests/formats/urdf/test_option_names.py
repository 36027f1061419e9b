"""Names in options that the robot does not have: what they are instead, and what may be meant."""

from __future__ import annotations

import math
from typing import Any

import pytest
from support import urdfs

from urdfsync.common.diagnostics import Severity
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.options import Options

TRANSMISSION = '<transmission name="t"><joint name="wheel"/></transmission>'
CART = urdfs.robot(
    *map(urdfs.link, ("base", "tyre", "roller", "mast", "camera", "plate", "kite", "cover", "bolt")),
    urdfs.joint("wheel", "continuous", "base", "tyre"),
    urdfs.joint("caster", "continuous", "base", "roller"),
    urdfs.joint("lift", "prismatic", "base", "mast", inside=[urdfs.mimic("wheel")]),
    urdfs.joint("camera", "fixed", "mast", "camera"),
    urdfs.joint("glide", "planar", "base", "plate"),
    urdfs.joint("lid", "fixed", "base", "cover", inside=[urdfs.mimic("wheel")]),
    urdfs.joint("latch", "continuous", "base", "bolt", inside=[urdfs.mimic("lift")]),
    urdfs.joint("fly", "floating", "base", "kite"),
)
DRIVEN = "revolute, continuous or prismatic joint without <mimic>"
WITH_DRIVE = CART.replace("</robot>", f"{TRANSMISSION}</robot>")


def found(urdf: str = CART, **options: Any) -> list[tuple[str, Severity, str]]:
    reading = DOMAIN.read(urdf.encode(), "robot.urdf", Options(**options))
    assert reading.snapshot is not None
    return [(option, said.severity, str(said).partition(": ")[2]) for option, said in reading.option_findings]


def of(option: str, *names: str) -> list[tuple[str, Severity, str]]:
    """What is said of an option with these names."""
    options: dict[str, Any] = {option: names}
    return found(CART, **options)


@pytest.mark.parametrize(("option", "name", "words"), [
    ("frames", "base_link", "link; did you mean `base`?"),
    ("frames", "lift", "link; correct the name, or remove it from the option"),
    ("driven", "wheels", f"{DRIVEN}; did you mean `wheel`?"),
    ("driven", "lift", f"{DRIVEN}; correct the name, or remove it from the option"),
    ("driven", "glide", f"{DRIVEN}; correct the name, or remove it from the option"),
    ("driven", "fly", f"{DRIVEN}; correct the name, or remove it from the option"),
    ("driven", "plate", f"{DRIVEN}; correct the name, or remove it from the option"),
])  # fmt: skip
def test_a_name_that_an_option_can_not_have(option: str, name: str, words: str) -> None:
    code = "frame-of-no-link" if option == "frames" else "drive-of-no-joint"
    others = ("base", "mast") if option == "frames" else ("caster",)
    problem = (option, Severity.ERROR, f"`{option}` names `{name}`, but the robot has no such {words} [{code}]")
    assert of(option, *others, name) == [problem]


@pytest.mark.parametrize("option", ["frames", "driven"])
def test_a_name_that_stands_there_twice(option: str) -> None:
    """The package is right all the same; a name that is wrong as well is told so once."""
    once, twice = ("tyre", "mast") if option == "frames" else ("caster", "wheel")
    words = "more than once; remove one, or correct the name [name-repeated]"
    assert of(option, twice, once, twice) == [(option, Severity.WARNING, f"`{option}` names `{twice}` {words}")]
    wrong = of(option, "gone", "gone")
    assert [severity for _, severity, _ in wrong] == [Severity.WARNING, Severity.ERROR]


@pytest.mark.parametrize("options", [
    {},
    {"frames": "all"},
    {"frames": ("tyre", "camera", "base")},
    {"driven": ()},
    {"driven": ("wheel", "caster")},
    {"approach": ("record",), "frames": ("gone",), "driven": ("gone",)},
])  # fmt: skip
def test_nothing_to_say(options: dict[str, Any]) -> None:
    assert found(**options) == []


def test_commands_are_of_joints_that_run_drives() -> None:
    """Each entry has its own line in the configuration."""
    wrong = found(CART, commands={"wheel": "effort", "casters": "velocity", "lift": "effort"})
    assert [(option, said.partition(";")[0]) for option, _, said in wrong] == [
        ("commands.casters", f"`commands` names `casters`, but the robot has no such {DRIVEN}"),
        ("commands.lift", f"`commands` names `lift`, but the robot has no such {DRIVEN}"),
    ]
    assert "did you mean `caster`?" in wrong[0][2]
    (left_out,) = found(CART, commands={"caster": "effort"}, driven=("wheel",))
    words = "`commands` names `caster`, which `driven` leaves out; add it there [drive-of-no-joint]"
    assert left_out == ("commands.caster", Severity.ERROR, words)


def test_start_positions_are_of_joints_with_an_axis_and_inside_of_their_limits() -> None:
    limited = CART.replace("</robot>", "") + urdfs.link("tip")
    limited += urdfs.joint("mast", "revolute", "plate", "tip", inside=[urdfs.limit(-1, 1, 1, 1)]) + "</robot>"
    start = {"mast": 1.5, "wheels": 0.1, "lift": 0.2, "caster": 99.0, "wheel": math.inf}
    words = [said for _, _, said in found(limited, start=start, approach=("record",))]
    assert [said.partition(";")[0] for said in words] == [
        "`start` puts `mast` at 1.5, outside of its limits -1 to 1",
        "`start` puts `wheel` at inf, outside of its limits -inf to inf",
        f"`start` names `wheels`, but the robot has no such {DRIVEN}",
        f"`start` names `lift`, but the robot has no such {DRIVEN}",
    ]


def test_passive_joints_are_a_note_unless_the_option_says_what_is_driven() -> None:
    note = (
        "Run and Test do not drive `caster`: no transmission, no ros2_control and no limit; "
        "to drive other joints, list all driven joints in `driven` [passive-joints]"
    )
    assert found(WITH_DRIVE) == [("driven", Severity.NOTE, note)]
    assert found(WITH_DRIVE, driven=("wheel",)) == []
    assert found(WITH_DRIVE, approach=("record",)) == []


def test_laws_and_drives_that_make_no_model() -> None:
    """Each joint is told with its reason; a table has the line of its entry, an option its own."""
    dry, wet = ('<dynamics friction="2"/>',), ('<dynamics damping="2"/>',)
    arm = urdfs.robot(
        *map(urdfs.link, ("base", "a", "b", "c", "d")),
        urdfs.joint("dry", "revolute", "base", "a", inside=dry),
        urdfs.joint("wet", "revolute", "a", "b", inside=wet),
        urdfs.joint("bare", "revolute", "b", "c"),
        urdfs.joint("tail", "revolute", "c", "d", inside=[urdfs.mimic("dry"), *dry]),
    )

    def told(**options: Any) -> list[tuple[str, str]]:
        return sorted((option, said.partition(";")[0]) for option, _, said in found(arm, **options))

    assert told(friction="lugre") == [("friction", "`friction` means `wet`, which has no dry friction")]
    assert told(friction={"dry": "lugre"}, elastic=("dry",), saturated=("dry",)) == []
    assert told(friction={"dry": "stiction"}, driven=()) == []
    assert told(friction={"dry": "stiction", "bare": "lugre"}) == [
        ("friction.bare", "`friction` means `bare`, which has no dry friction"),
        ("friction.dry", "`friction` means `dry`, which sticks while Test prescribes its motion"),
    ]
    assert told(friction={"tail": "lugre"}) == [
        ("friction.tail", f"`friction` names `tail`, but the robot has no such {DRIVEN}")
    ]
    assert told(saturated=("wet",)) == [
        ("saturated", "`saturated` means `wet`, which has a drive that prescribes its motion at any effort")
    ]
    assert told(elastic=("wet", "wett")) == [
        ("elastic", f"`elastic` names `wett`, but the robot has no such {DRIVEN} that Run and Test drive")
    ]


def test_a_drive_with_a_law_saturates_without_a_spring() -> None:
    """It gives an effort, so a spring needs an inertia before it."""
    drive = '<command_interface name="position"><param name="position_gain">50</param></command_interface>'
    arm = urdfs.robot(
        *map(urdfs.link, ("base", "a")),
        urdfs.joint("lift", "revolute", "base", "a", inside=['<dynamics damping="1"/>']),
        f'<ros2_control name="c"><joint name="lift">{drive}</joint></ros2_control>',
    )
    assert found(arm, saturated="all") == []
    assert ["has no inertia before the spring" in said for _, _, said in found(arm, elastic="all")] == [True]
    (refused,) = found(arm, saturated="all", commands={"lift": "position"})
    assert "prescribes its motion at any effort" in refused[2]


def test_an_effort_needs_an_inertia_before_the_spring() -> None:
    for dynamics, count in (('damping="1"', 1), ('damping="1" armature="0.1"', 0)):
        arm = urdfs.robot(
            *map(urdfs.link, ("base", "a")),
            urdfs.joint("dry", "revolute", "base", "a", inside=[f"<dynamics {dynamics}/>"]),
            '<transmission name="t"><joint name="dry">'
            "<hardwareInterface>EffortJointInterface</hardwareInterface></joint></transmission>",
        )
        words = [said for _, _, said in found(arm, elastic="all", saturated="all")]
        assert len(words) == count
        assert all("has no inertia before the spring" in said for said in words)

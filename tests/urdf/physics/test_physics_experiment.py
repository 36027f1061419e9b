"""The experiment as the core sees it: content, notes, and how numbers become deviations."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Sequence

import pytest
from support.urdfs import dynamics, joint, limit, link, mimic, robot

from urdfsync.diagnostics import SourceError
from urdfsync.domain import Deviation, Experiment, Quantity, Target
from urdfsync.urdf.domain import DOMAIN
from urdfsync.urdf.options import Options

BOT = Target("Bot", "Bot")
ARM = robot(
    link("base", 4.0),
    link("arm", 2.5),
    link("drone", 0.7),
    link("plate", 0.7),
    joint("elbow", "revolute", "base", "arm", inside=[limit(), dynamics(1, 1)]),
    joint("slide", "prismatic", "base", "drone", inside=[limit()]),
    joint("skate", "planar", "arm", "plate"),
)


def experiment(urdf: str | bytes, complete: bool = True, **options: str) -> Experiment:
    content = urdf if isinstance(urdf, bytes) else urdf.encode()
    found = DOMAIN.experiment(content, "robot.urdf", BOT, Options(**options), complete)  # type: ignore[arg-type]
    assert found is not None
    return found


def zeros(one: Experiment) -> dict[str, Sequence[float]]:
    """A series in which nothing ever moves."""
    still: Sequence[float] = (0.0, 0.0, 0.0)
    return {"time": (0.0, 0.005, 0.01), **dict.fromkeys(one.probe.values, still)}


def key(one: Deviation) -> tuple[str, str, str]:
    return one.quantity.value, one.element, one.unit


def test_every_element_has_its_deviations() -> None:
    one = experiment(ARM)
    links = ("base", "arm", "drone", "plate")
    assert sorted(map(key, one.compare(zeros(one)))) == sorted(
        [
            *(("position", f"link {name}", "m") for name in links),
            *(("orientation", f"link {name}", "") for name in links),
            *(("effort", "joint elbow", "N·m"), ("effort", "joint slide", "N")),
            *(("effort", "link base", "N"), ("effort", "link base", "N·m")),
            *(("acceleration", "link plate", "m/s²"), ("acceleration", "link plate", "rad/s²")),
            *(("mass", "robot", "kg"), ("centre of mass", "robot", "m")),
        ]
    )


def test_differences_are_the_greatest_of_the_first_and_last_instant() -> None:
    one = experiment(robot(link("base", 4.0)))
    series = zeros(one)
    (mass,) = [found for found in one.compare(series) if found.quantity is Quantity.MASS]
    assert (mass.difference, mass.value, mass.size) == (4.0, 4.0, 4.0)
    series["mass"] = (4.0, 100.0, 4.25)
    (mass,) = [found for found in one.compare(series) if found.quantity is Quantity.MASS]
    assert mass.difference == 0.25


def test_sizes_are_those_of_all_elements_of_a_quantity() -> None:
    one = experiment(ARM)
    efforts = [found for found in one.compare(zeros(one)) if found.quantity is Quantity.EFFORT]
    assert {found.size for found in efforts} == {max(found.value for found in efforts)}


@pytest.mark.parametrize("values", [None, (), (math.nan, 0.0, 0.0), (0.0, 0.0, math.nan), (0.0, 0.0, math.inf)])
def test_a_value_that_is_no_number_is_infinitely_far_off(values: tuple[float, ...] | None) -> None:
    one = experiment(ARM)
    series = zeros(one)
    del series["robot.drone.frame_a.r_0[2]"]
    if values is not None:
        series["robot.drone.frame_a.r_0[2]"] = values
    infinite = [key(found) for found in one.compare(series) if math.isinf(found.difference)]
    assert ("position", "link drone", "m") in infinite
    assert ("position", "link base", "m") not in infinite


def test_nothing_at_all_agrees_with_nothing() -> None:
    found = experiment(ARM).compare({})
    assert all(math.isinf(one.difference) and math.isinf(one.relative) for one in found)
    assert all(math.isfinite(one.value) and math.isfinite(one.size) for one in found)


def test_what_is_made_up_is_said_and_read_by_both_sides() -> None:
    bare = robot(link("base"), link("arm"), joint("elbow", "continuous", "base", "arm")).encode()
    one = experiment(bare)
    assert one.notes == ("inertias were made up for 2 links, because the file gives no mass at all",)
    reading = DOMAIN.read(one.content, "robot.urdf", Options(cross_check=False))
    assert reading.snapshot is not None
    assert reading.snapshot["links"]["arm"]["inertial"]["mass"] > 0


def test_nothing_is_made_up_unless_it_is_asked_for() -> None:
    bare = robot(link("base"), link("arm"), joint("elbow", "continuous", "base", "arm")).encode()
    one = experiment(bare, complete=False)
    assert (one.content, one.notes) == (bare, ())
    assert "no link has a mass, so that efforts show the losses of joints only" in one.unchecked


def test_the_reference_has_a_name_and_a_version() -> None:
    assert re.fullmatch(r"Pinocchio \d+\.\d+\.\d+", experiment(ARM).reference)


SPHERE = "<geometry><sphere radius='1'/></geometry>"
SHAPE = f"<visual>{SPHERE}</visual><collision>{SPHERE}</collision>"


def test_what_is_not_compared_concerns_this_robot() -> None:
    assert experiment(robot(link("base", 1.0))).unchecked == (
        "no joint moves, so that only poses, masses and the forces on the root link are compared",
    )
    free = robot(link("base", 1.0), link("wheel", 1.0), joint("axle", "continuous", "base", "wheel"))
    assert experiment(free).unchecked == ()
    limited = free.replace("</joint>", "<limit effort='1' velocity='1'/></joint>").replace("</link>", f"{SHAPE}</link>")
    idle = "limits and shapes are not compared: they change no motion"
    assert experiment(limited).unchecked == (idle,)
    contacts = "contacts with the ground are not compared: the robot moves high above it"
    assert experiment(limited, base="floating").unchecked == (idle, contacts)


def test_a_free_joint_that_moves_nothing_gets_ballast() -> None:
    plane = robot(link("floor", 1.0), link("plate"), joint("skate", "planar", "floor", "plate"))
    one = experiment(plane, complete=False)
    assert one.notes == ("1.5 kg hang on each link without children, because 'skate' would move without any inertia",)
    assert "ballast" in one.probe.source
    assert "ballast" not in experiment(plane).probe.source, "its link has a made-up inertia instead"


def test_free_joints_in_a_row_without_inertia_have_no_motion() -> None:
    rows = robot(
        link("floor", 1.0),
        link("plate"),
        link("puck"),
        joint("skate", "planar", "floor", "plate"),
        joint("slip", "planar", "plate", "puck"),
    )
    with pytest.raises(SourceError, match="no simulation can tell how 'skate', 'slip' move"):
        experiment(rows, complete=False)
    assert experiment(rows).unchecked == ()


def test_a_source_with_errors_says_what_is_wrong() -> None:
    with pytest.raises(SourceError) as caught:
        experiment("<robot name='a'><link name='b'/><link name='b'/></robot>")
    assert "duplicate-link" in [diagnostic.code for diagnostic in caught.value.diagnostics]


def test_without_pinocchio_there_is_no_experiment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pinocchio", None)
    with pytest.raises(SourceError, match="no-pinocchio"):
        experiment(ARM)


def test_followers_without_a_leader_that_moves_are_fine() -> None:
    held = robot(
        link("base", 1.0),
        link("plate", 1.0),
        link("pin", 1.0),
        joint("weld", "fixed", "base", "plate"),
        joint("stop", "prismatic", "plate", "pin", inside=[mimic("weld", 3.0, -0.2), limit()]),
    )
    assert not [value for value in experiment(held).probe.values if "Axis" in value]


def test_classes_that_have_to_compile_come_with_the_main_one_first() -> None:
    assert DOMAIN.models(Target("Plant.Arm", "Arm")) == ("Arm", "ArmRun", "ArmTest")

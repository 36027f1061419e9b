"""The SVG of a diagram: well-formed with any names, complete, readable, and the same for the same robot."""

from __future__ import annotations

import itertools
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree
from msgspec.structs import replace

from urdfsync.domain import Target
from urdfsync.formats.urdf.diagram.drawing import draw
from urdfsync.formats.urdf.names import spell
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import Inertial, Joint, Link, Mimic, Robot, Sensor

SVG = "{http://www.w3.org/2000/svg}"
TARGET = Target("Plant.Arm", "Arm")
GRIPPER = Robot(
    "gripper",
    (Link("palm", Inertial(0.7)), Link("left"), Link("tip<&>"), Link("camera"), Link("last", Inertial(1234))),
    (
        Joint("a_slide", "prismatic", "palm", "left"),
        Joint("b_follow", "prismatic", "palm", "tip<&>", mimic=Mimic("a_slide", -2.5)),
        Joint("c_mount", "fixed", "palm", "camera"),
        Joint("stay", "revolute", "left", "last", mimic=Mimic("c_mount", 7)),
    ),
)
"""A palm with a sliding finger, one that follows it, a camera, and a joint that follows one that never moves."""


def texts(root: etree._Element) -> list[str]:
    return [element.text or "" for element in root.iter(f"{SVG}text")]


def chain(*names: str) -> Robot:
    joints = [Joint(f"forearm_roll_to_{b}", "revolute", a, b) for a, b in itertools.pairwise(names)]
    return Robot("r", tuple(Link(name, Inertial(123456789)) for name in names), tuple(joints))


def test_elements_connectors_masses_and_ratios_can_be_read() -> None:
    found = set(texts(etree.fromstring(draw(GRIPPER, TARGET, Options(), {}))))
    tip = spell("tip<&>", "link")
    assert {"Plant.Arm", "frame_a", "cameraFrame", "palm", "left", tip, "b_follow", "b_followMimic"} <= found
    assert {"0.7 kg", "1230 kg", "× -2.5", "held"} <= found
    assert "× 7" not in found
    assert {"link, mass", "fixed joint", "mimic coupling, ratio", "rotational joint"} <= found
    assert not {"planar or floating joint", "ball joint"} & found, "the legend has the kinds that are there"
    robot = replace(GRIPPER, joints=tuple(replace(joint, type="ball", mimic=None) for joint in GRIPPER.joints))
    assert "ball joint" in texts(etree.fromstring(draw(robot, TARGET, Options(), {})))


def test_sensors_are_shown_by_their_names() -> None:
    sensors = Sensor("eye", "camera", "palm"), Sensor("gyro", "imu", "left")
    found = set(texts(etree.fromstring(draw(replace(GRIPPER, sensors=sensors), TARGET, Options(), {}))))
    assert {"eye", "gyro", "sensor"} <= found


def test_all_text_is_ten_pixels_high_or_more_at_its_natural_size() -> None:
    robot = chain(*(f"link_{'o' * length}" for length in range(0, 80, 8)))
    root = etree.fromstring(draw(robot, TARGET, Options(), {}))
    width, height = map(float, root.get("viewBox", "").split()[2:])
    scale = float(root.get("width", "")) / width
    assert float(root.get("height", "")) == scale * height
    assert min(scale * float(text.get("font-size", "")) for text in root.iter(f"{SVG}text")) >= 10


def test_it_needs_nothing_from_elsewhere_and_the_order_of_elements_makes_no_difference() -> None:
    drawing = draw(GRIPPER, TARGET, Options(), {})
    assert drawing == draw(Robot("r", GRIPPER.links[::-1], GRIPPER.joints[::-1]), TARGET, Options(), {})
    assert not re.search(r"href|url\(|@import|<script|<image", drawing)


def test_a_long_name_is_shortened_in_the_middle_and_kept_as_tooltip() -> None:
    name = "the_one_link_with_a_name_that_is_much_too_long_to_be_drawn_beside_others"
    root = etree.fromstring(draw(chain(name), TARGET, Options(), {}))
    assert any(text.startswith("the_one") and text.endswith("others") for text in texts(root) if "…" in text)
    assert name in [title.text for title in root.iter(f"{SVG}title")]


@pytest.mark.slow
@settings(max_examples=20)
@given(st.text(st.characters(), max_size=30))
def test_any_title_gives_well_formed_xml(title: str) -> None:
    root = etree.fromstring(draw(chain("box"), Target(title, "Box"), Options(), {}).encode("utf-8"))
    assert root.tag == f"{SVG}svg"

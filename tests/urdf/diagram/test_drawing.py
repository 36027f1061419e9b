"""The SVG of a diagram: well-formed with any names, complete, readable, and the same for the same robot."""

from __future__ import annotations

import itertools
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

from urdfsync.domain import Target
from urdfsync.urdf.diagram.drawing import Label, draw, svg
from urdfsync.urdf.diagram.layout import Diagram, Tree, TreeCoupling, TreeJoint, layout
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Inertial, Joint, Link, Mimic, Robot

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture
def gripper() -> Diagram:
    """A palm with a sliding finger, a finger that follows it, and a camera."""
    joints = [
        TreeJoint("left", "leftFinger", "translational", "leftAxis", "leftSupport"),
        TreeJoint("right", "rightFinger", "translational"),
        TreeJoint("mount", "camera", "fixed"),
    ]
    frames = {"leftFinger": "leftFrame", "rightFinger": "rightFrame", "camera": "cameraFrame"}
    return layout(Tree("palm", {"palm": joints}, frames, [TreeCoupling("mimic", "left", "right")]))


LABELS = {
    "palm": Label("link", "palm", "0.7 kg"),
    "leftFinger": Label("link", "left_finger", "12 g"),
    "rightFinger": Label("link", "right_finger", "13 g"),
    "camera": Label("link", "camera"),
    "left": Label("translational", "left_joint"),
    "right": Label("translational", "right_joint"),
    "mount": Label("fixed", "mount_joint"),
    "mimic": Label("coupling", "right_mimic", "× -1"),
}


ROBOT = Robot(
    "arm",
    (
        Link("base", Inertial(12.3456)),
        Link("Arm"),
        Link("tip<&>"),
        Link("left"),
        Link("right"),
        Link("last", Inertial(1234)),
    ),
    (
        Joint("turn", "revolute", "base", "Arm"),
        Joint("mount", "fixed", "Arm", "tip<&>"),
        Joint("slide", "prismatic", "Arm", "left"),
        Joint("follow", "prismatic", "Arm", "right", mimic=Mimic("slide", -2.5)),
        Joint("stay", "revolute", "right", "last", mimic=Mimic("mount", 7)),
    ),
)


def texts(drawing: str) -> list[str]:
    return [element.text or "" for element in etree.fromstring(drawing).iter(f"{SVG}text")]


def arm_texts(target: Target) -> list[str]:
    return texts(draw(ROBOT, target, Options()))


def box(name: str, detail: str = "") -> str:
    return svg(layout(Tree("box", {}, {"box": "boxFrame"})), {"box": Label("link", name, detail)}, name)


def test_names_details_title_and_connectors_can_be_read(gripper: Diagram) -> None:
    found = texts(svg(gripper, LABELS, "Gripper"))
    expected = {text for label in LABELS.values() for text in label[1:] if text}
    assert expected | {"Gripper", "frame_a", "leftFrame", "rightFrame", "cameraFrame"} <= set(found)


def test_the_legend_has_the_kinds_that_are_there_and_no_others(gripper: Diagram) -> None:
    found = set(texts(svg(gripper, LABELS)))
    assert {"link, mass", "fixed joint", "mimic coupling, ratio"} <= found
    assert not {"rotational joint", "planar or floating joint"} & found


def test_components_stand_where_the_layout_puts_them_with_y_downwards(gripper: Diagram) -> None:
    root = etree.fromstring(svg(gripper, LABELS))
    moves = {element.get("transform") for element in root.iter(f"{SVG}g")}
    for name in LABELS:
        x, y = gripper.placements[name].centre
        assert f"translate({x} {-y})" in moves


def test_every_line_is_drawn_in_the_colour_of_its_kind(gripper: Diagram) -> None:
    root = etree.fromstring(svg(gripper, LABELS))
    drawn = {path.get("class"): path.get("d", "") for path in root.iter(f"{SVG}path") if path.get("class") != "glyph"}
    assert set(drawn) == {"line frame", "line translational", "line translational support"}
    starts = [(int(x), -int(y)) for data in drawn.values() for x, y in re.findall(r"M(\S+) ([^LQM]+)", data)]
    assert sorted(starts) == sorted(points[0] for points in gripper.lines.values())


def test_dots_mark_where_a_net_branches(gripper: Diagram) -> None:
    root = etree.fromstring(svg(gripper, LABELS))
    dots = {(dot.get("class"), int(dot.get("cx", "")), -int(dot.get("cy", ""))) for dot in root.iter(f"{SVG}circle")}
    trunk = gripper.lines["palm.frame_a", "left.frame_a"][1][0]
    spines = [gripper.placements[joint].centre[1] for joint in ("left", "right", "mount")]
    palm = gripper.placements["palm"].centre[1]
    on_trunk = {("dot-frame", trunk, y) for y in (spines[0], palm, spines[1])}
    assert on_trunk == {dot for dot in dots if dot[1] == trunk}
    assert ("dot-frame", trunk, spines[2]) not in dots  # the last branch is a bend
    assert [dot[1] for dot in dots if dot[0] == "dot-translational"] == [gripper.placements["left"].centre[0]]


def test_the_picture_holds_the_whole_diagram(gripper: Diagram) -> None:
    left, top, width, height = map(float, etree.fromstring(svg(gripper, LABELS)).get("viewBox", "").split())
    x1, y1, x2, y2 = gripper.extent
    assert left < x1
    assert top < -y2
    assert left + width > x2
    assert top + height > -y1


def test_all_text_is_ten_pixels_high_or_more_at_its_natural_size() -> None:
    names = [f"link_{'o' * length}" for length in range(0, 80, 8)]
    chain = {
        a: [TreeJoint(f"to_{b}", b, "rotational", f"{b}Axis", f"{b}Support")] for a, b in itertools.pairwise(names)
    }
    tree = Tree(names[0], chain, {names[-1]: f"{names[-1]}Frame"})
    labels = {name: Label("link", name, "123456789 kg") for name in names}
    labels |= {joint.name: Label("rotational", joint.name) for joints in chain.values() for joint in joints}
    root = etree.fromstring(svg(layout(tree), labels, names[-1]))
    width, height = map(float, root.get("viewBox", "").split()[2:])
    scale = float(root.get("width", "")) / width
    assert float(root.get("height", "")) == scale * height
    assert min(scale * float(text.get("font-size", "")) for text in root.iter(f"{SVG}text")) >= 10


def test_joints_names_keep_clear_of_their_neighbours_connectors() -> None:
    joints = {a: [TreeJoint(f"forearm_roll{b}", b, "rotational", f"{b}Axis", f"{b}Support")] for a, b in ("ab", "bc")}
    diagram = layout(Tree("a", joints, {"c": "cFrame"}))
    labels = {name: Label("link", name) for name in "abc"}
    labels |= {name: Label("rotational", name) for name in ("forearm_rollb", "forearm_rollc")}
    root = etree.fromstring(svg(diagram, labels))
    (text,) = [element for element in root.iter(f"{SVG}text") if element.text == "forearm_rollb"][1:]
    support = diagram.placements["cSupport"]
    assert -float(text.get("y", "")) > support.centre[1] + 4  # radius of its circle


def test_it_needs_nothing_from_elsewhere_and_is_the_same_each_time(gripper: Diagram) -> None:
    drawing = svg(gripper, LABELS, "Gripper")
    assert drawing == svg(gripper, dict(reversed(LABELS.items())), "Gripper")
    assert not re.search(r"href|url\(|@import|<script|<image", drawing)


def test_a_long_name_is_shortened_in_the_middle_and_kept_as_tooltip() -> None:
    name = "the_one_link_with_a_name_that_is_much_too_long_to_be_drawn_beside_others"
    root = etree.fromstring(box(name))
    drawn = [text for text in texts(box(name)) if "…" in text]
    assert any(text.startswith("the_one") and text.endswith("others") for text in drawn)
    assert name in [title.text for title in root.iter(f"{SVG}title")]


def test_markup_in_names_is_text() -> None:
    drawing = box('</text><script>a & "b"', "<kg>")
    assert "<script" not in drawing
    assert "<kg>" in texts(drawing)


@settings(deadline=None)
@given(st.text(st.characters(), max_size=30), st.text(st.characters(), max_size=30))
def test_any_text_gives_well_formed_xml(name: str, detail: str) -> None:
    root = etree.fromstring(box(name, detail).encode("utf-8"))
    assert root.tag == f"{SVG}svg"


def test_a_component_without_label_is_an_error(gripper: Diagram) -> None:
    with pytest.raises(KeyError, match="palm"):
        svg(gripper, {name: label for name, label in LABELS.items() if name != "palm"})


def test_every_element_is_named_as_in_modelica() -> None:
    found = arm_texts(Target("Plant.Arm", "Arm"))
    names = {"base", "arm_link", "tip___", "left", "right", "turn", "mount", "slide", "follow", "followMimic"}
    assert names <= set(found)
    assert "Plant.Arm" in found
    assert {"12.3 kg", "1230 kg"} <= set(found)


def test_couplings_show_their_ratio_or_that_they_hold_a_joint_whose_leader_cannot_move() -> None:
    found = arm_texts(Target("Plant.Arm", "Arm"))
    assert "× -2.5" in found
    assert "held" in found
    assert "× 7" not in found


def test_the_robots_class_decides_about_names_as_in_the_model() -> None:
    assert "arm" in arm_texts(Target("Plant.Machine", "Machine"))

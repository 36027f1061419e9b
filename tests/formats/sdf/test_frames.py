"""Names, frames and their faults."""

from __future__ import annotations

import math

import pytest
from support.sdfs import arm, hinge, joint, link, model, problem, read, sdf

from urdfsync.formats.urdf.robot import Origin


def part(pose: str, more: str = "", version: str = "1.9") -> Origin:
    """Return the origin of the joint to `part`, whose link has this pose."""
    return joint(read(arm(pose, more=more, version=version))).origin


def test_a_pose_is_given_in_the_model() -> None:
    base = '<link name="base"><pose>1 0 0 0 0 0</pose></link><link name="part"><pose>1 2 0 0 0 0</pose></link>'
    robot = read(model(base + hinge("turn", "base", "part")))
    assert joint(robot).origin == Origin((0, 2, 0))


def test_numbers_stay_as_written_in_the_frame_in_which_they_are_given() -> None:
    far = '<frame name="far"><pose>0.1 0.2 0.3 0.7 0.8 0.9</pose></frame>'
    links = '<link name="base"><pose relative_to="far"/></link><link name="part"><pose relative_to="base">'
    robot = read(model(f"{far}{links}0.1 0.2 0.3 0.123 1.5708 0.456</pose></link>" + hinge("turn", "base", "part")))
    assert joint(robot).origin == Origin((0.1, 0.2, 0.3), (0.123, 1.5708, 0.456))


@pytest.mark.parametrize(
    "pose",
    [
        "<pose>0 0 1 0 0 1.5707963267948966</pose>",
        '<pose degrees="true">0 0 1 0 0 90</pose>',
        '<pose rotation_format="quat_xyzw">0 0 1 0 0 3 3</pose>',
        '<pose relative_to="up">0 0 0.5 0 0 1.5707963267948966</pose>',
        '<pose relative_to="sub">0 0 0.75 0 0 1.5707963267948966</pose>',
        '<pose relative_to="sub::inner">0 0 0 0 0 1.5707963267948966</pose>',
        "<pose> 0 0\n1 0 0 1.5707963267948966 </pose>",
    ],
)
def test_a_pose_has_many_forms(pose: str) -> None:
    up = '<frame name="up" attached_to="base"><pose>0 0 0.5 0 0 0</pose></frame>'
    inner = '<link name="inner"><pose>0 0 0.75 0 0 0</pose></link>'
    sub = f'<model name="sub"><pose>0 0 0.25 0 0 0</pose>{inner}</model>' + hinge("held", "base", "sub", "", "fixed")
    origin = part(pose, up + sub)
    assert origin.xyz == (0, 0, 1)
    assert origin.rpy == pytest.approx((0, 0, math.pi / 2), abs=1e-15)


def test_an_old_word_names_the_frame() -> None:
    text = '<frame name="up"><pose>0 0 0.5 0 0 0</pose></frame>'
    assert part('<pose frame="up">0 0 0.5 0 0 0</pose>', text, "1.6").xyz == (0, 0, 1)
    assert part('<pose frame="up">0 0 0.5 0 0 0</pose>', text, "1.7").xyz == (0, 0, 0.5)


def test_a_placement_frame_places_its_model() -> None:
    inner = '<link name="tip"><pose>0 0 1 0 0 0</pose></link>'
    sub = f'<model name="sub" placement_frame="tip"><pose>0 0 5 0 0 0</pose>{inner}</model>'
    robot = read(arm(more=sub + hinge("held", "base", "sub::tip", "<axis/>")))
    assert joint(robot, "held").origin.xyz == (0, 0, 5)


def test_a_nested_model_moves_with_its_canonical_link() -> None:
    inner = '<link name="one"/><link name="two"/>' + hinge("bend", "one", "two")
    sub = f'<model name="sub" canonical_link="two">{inner}</model>'
    robot = read(model('<link name="base"/>' + sub + hinge("held", "base", "sub", "", "fixed")))
    assert [(each.name, each.parent, each.child) for each in robot.joints] == [
        ("held", "base", "sub::two"),
        ("sub::bend", "sub::two", "sub::one"),
    ]


@pytest.mark.parametrize(("is_first", "expected"), [(True, "finger"), (False, "base")])
def test_a_frame_is_attached_to_the_first_link_counted_where_a_merged_model_stands(
    is_first: bool, expected: str
) -> None:
    merged = '<include merge="true"><uri>hand.sdf</uri></include>'
    base = '<link name="base"/>'
    inside = (merged + base if is_first else base + merged) + hinge("held", "finger", "base")
    files = {"hand.sdf": model('<link name="finger"/>', name="hand")}
    robot = read(model(inside + '<frame name="tool"><pose>0 0 1 0 0 0</pose></frame>'), files)
    assert joint(robot, "tool_fixed").parent == expected


def test_an_included_model_is_static_if_it_says_so() -> None:
    files = {"shelf.sdf": model(f'<static>true</static><link name="a"/><link name="b"/>{hinge("h", "a", "b")}')}
    shelf = "<include><uri>shelf.sdf</uri>{}</include>"
    leg = f'<model name="leg"><link name="a"/>{hinge("h", "world", "a")}</model>'
    assert read(sdf(f'<world name="w">{shelf.format("")}{leg}</world>'), files).name == "leg"
    world = f'<world name="w">{shelf.format("<static>false</static>")}{leg}</world>'
    assert "2 robots" in problem(sdf(world), files)


def test_a_frame_is_a_link_without_mass() -> None:
    frame = '<frame name="tool" attached_to="turn"><pose>0 0 0.3 0 0 0</pose></frame>'
    robot = read(arm(more=frame))
    assert link(robot, "tool").inertial is None
    fixed = joint(robot, "tool_fixed")
    assert (fixed.parent, fixed.origin.xyz) == ("part", (0, 0, 0.3))


@pytest.mark.parametrize(
    ("axis", "version", "expected"),
    [
        ("<axis/>", "1.9", (0, 0, 1)),
        ("<axis><xyz>1 0 0</xyz></axis>", "1.9", (1, 0, 0)),
        ('<axis><xyz expressed_in="__model__">1 0 0</xyz></axis>', "1.9", (0, -1, 0)),
        ('<axis><xyz expressed_in="base">1 0 0</xyz></axis>', "1.9", (0, -1, 0)),
        ("<axis><xyz>1 0 0</xyz><use_parent_model_frame>1</use_parent_model_frame></axis>", "1.6", (0, -1, 0)),
        ("<axis><xyz>1 0 0</xyz><use_parent_model_frame>0</use_parent_model_frame></axis>", "1.6", (1, 0, 0)),
        ("<axis><xyz>1 0 0</xyz><use_parent_model_frame>1</use_parent_model_frame></axis>", "1.9", (1, 0, 0)),
        ("<axis><xyz>1 0 0</xyz></axis>", "1.4", (0, -1, 0)),
    ],
)
def test_an_axis_is_given_in_the_joint_unless_it_says_so(axis: str, version: str, expected: tuple[float, ...]) -> None:
    robot = read(arm("<pose>0 0 0 0 0 1.5707963267948966</pose>", axis, version=version))
    assert joint(robot).axis == pytest.approx(expected, abs=1e-15)


def test_a_link_has_its_frame_at_its_joint() -> None:
    """Its axes stay those of SDF, so its own numbers only move."""
    box = "<geometry><box/></geometry>"
    inside = f'<inertial><pose>0 0 1 0 0 0.3</pose></inertial><visual name="v"><pose>0 0 2 0 0 0</pose>{box}</visual>'
    lower = '<link name="tip"><pose relative_to="part">0 0 3 0 0 0</pose></link>' + hinge("bend", "part", "tip")
    robot = read(arm(inside, "<pose>0 0 0.5 0 0 1.5707963267948966</pose><axis><xyz>1 0 0</xyz></axis>", lower))
    assert joint(robot).origin == Origin((0, 0, 0.5))
    assert joint(robot).axis == pytest.approx((0, 1, 0), abs=1e-15)
    inertial = link(robot).inertial
    assert inertial is not None
    assert inertial.origin == Origin((0, 0, 0.5), (0, 0, 0.3))
    assert link(robot).visuals[0].origin == Origin((0, 0, 1.5))
    assert joint(robot, "bend").origin == Origin((0, 0, 2.5))


@pytest.mark.parametrize(
    ("inside", "told"),
    [
        (
            '<link name="a">\n<pose relative_to="b"/></link>',
            "arm.sdf:3: there is no frame 'b' in model 'arm'; name",
        ),
        ('<link name="a"/><link name="a"/>', "arm.sdf:2: link 'a' has the name of the link in line 2; give each part"),
        ('<link name="a"/>\n<frame name="a"/>', "arm.sdf:3: frame 'a' has the name of the link in line 2"),
        ('<link name="__a__"/>', "arm.sdf:2: the name '__a__' is reserved; rename the <link>"),
        ('<link name="world"/>', "arm.sdf:2: the name 'world' is reserved"),
        ("<link/>", "arm.sdf:2: <link> has no name"),
        ('<frame name="f" attached_to="f"/><link name="a"/>', "arm.sdf:2: the pose of frame 'f' is given in its own"),
        (
            '<link name="a"><pose relative_to="f"/></link><frame name="f"><pose relative_to="a"/></frame>',
            "arm.sdf:2: the pose of link 'a' is given in its own frame, by a circle",
        ),
        (
            '<link name="a"/><frame name="f" attached_to="g"/><frame name="g" attached_to="f"><pose relative_to="a"/>'
            "</frame>" + hinge("h", "a", "f"),
            "arm.sdf:2: the frame of frame 'f' is attached to itself",
        ),
        ('<link name="a"><pose>1 2 3</pose></link>', "arm.sdf:2: <pose> '1 2 3' has 3 numbers instead of 6"),
        ('<link name="a"><pose>0 0 0 0 0 x</pose></link>', "arm.sdf:2: <pose> '0 0 0 0 0 x' is not a decimal number"),
        ('<link name="a"><pose>0 0 0 0 0 inf</pose></link>', "arm.sdf:2: <pose> has a number that is not finite"),
        ('<link name="a"><pose rotation_format="x"/></link>', "arm.sdf:2: <pose> has the unknown rotation_format 'x'"),
        (
            '<link name="a"><pose rotation_format="quat_xyzw">0 0 0 0 0 0 0</pose></link>',
            "arm.sdf:2: the quaternion of <pose> has no direction",
        ),
        ('<link name="a"><pose/><gravity>maybe</gravity></link>', "arm.sdf:2: <gravity> 'maybe' is neither true nor"),
        (
            '<model name="m" placement_frame="x"><link name="a"/></model>',
            "arm.sdf:2: there is no frame 'x' in model 'm'",
        ),
        ('<model name="m"/>', "arm.sdf:2: model 'm' has no link"),
        ('<link name="a"/>' + hinge("h", "a", "a"), "arm.sdf:2: joint 'h' joins 'a' with itself"),
        ('<link name="a"/><joint name="h" type="fixed"/>', "arm.sdf:2: joint 'h' has no <child>"),
        (
            '<link name="a"/>' + hinge("h", "world", "a", "", "hinge"),
            "arm.sdf:2: joint 'h' has the unknown type 'hinge'",
        ),
        ("", "arm.sdf:2: model 'arm' has no link"),
    ],
)
def test_a_fault_has_a_line(inside: str, told: str) -> None:
    assert problem(model(inside), robot="arm").startswith(told)


def test_before_sdf_1_7_a_joint_may_have_the_name_of_its_link() -> None:
    links = '<link name="base"/><link name="part"><pose>0 0 1 0 0 0</pose></link>'
    text = links + hinge("part", "base", "part")
    assert joint(read(model(links + hinge("part", "base", "part"), "1.6")), "part").origin.xyz == (0, 0, 1)
    assert "joint 'part' has the name of the link" in problem(model(text, "1.7"))


@pytest.mark.parametrize(
    ("inside", "chosen", "told"),
    [
        ("", "", "arm.sdf:1: the file has no model; name the file that has the robot"),
        ('<model name="a"><link name="b"/></model>', "", "arm.sdf:1: the model has no joint: nothing in it moves"),
        (
            '<model name="a"><link name="b"/></model><model name="c"><link name="d"/></model>',
            "",
            "arm.sdf:1: no model has a joint that moves",
        ),
        (
            "".join(f'<model name="{name}"><link name="a"/>{hinge("h", "world", "a")}</model>' for name in "ab"),
            "",
            "arm.sdf:1: the file has 2 robots: 'a', 'b'; choose one by `arguments = { model = \"a\" }` "
            "(`init FILE model:=a`)",
        ),
        ('<model name="leg"><link name="a"/></model>', "lag", "arm.sdf:1: there is no model 'lag'; perhaps 'leg' is"),
        ('<world name="a"/><world name="b"/>', "", "arm.sdf:2: the file has 2 worlds"),
    ],
)
def test_a_file_has_one_robot(inside: str, chosen: str, told: str) -> None:
    assert problem(sdf(inside), robot=chosen).startswith(told)


def test_a_world_gives_its_robot_a_place() -> None:
    box = '<model name="box"><static>true</static><pose>0 0 4 0 0 0</pose><link name="l"/></model>'
    inside = f'<pose relative_to="box">0 1 0 0 0 0</pose><link name="a"/>{hinge("h", "world", "a")}'
    robot = f'<model name="leg">{inside}</model>'
    assert joint(read(sdf(f'<world name="w">{box}{robot}</world>')), "h").origin.xyz == (0, 1, 4)


@pytest.mark.parametrize("name", ["world", "__model__", "__a__"])
def test_a_name_was_not_reserved_in_sdf_1_6(name: str) -> None:
    """It stands for the link; in URDF, the link has another name than the world."""
    text = model(f'<link name="{name}"/><link name="part"/>' + hinge("turn", name, "part"), "1.6")
    assert joint(read(text)).parent == {"world": "world_link"}.get(name, name)


@pytest.mark.parametrize("name", ["__", "___"])
def test_a_name_of_few_lines_is_not_reserved(name: str) -> None:
    assert joint(read(model(f'<link name="{name}"/><link name="part"/>' + hinge("turn", name, "part")))).parent == name

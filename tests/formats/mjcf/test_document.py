"""An MJCF and its files become one text: includes, attached models, meshes, and the places of their elements."""

from __future__ import annotations

import pytest
from support.mjcfs import ARM, FOLDER, SOURCE, body, document, joint, link, problem, read, stl, urdf, world

from urdfsync.formats.mjcf.comparison import compare
from urdfsync.formats.mjcf.document import read_document
from urdfsync.formats.mjcf.urdf import translated
from urdfsync.formats.translation.files import Files

LEG = '<mujocoinclude>\n\n<body name="leg"><joint name="hip"/><geom size="0.1"/></body></mujocoinclude>'
GRIPPER = '<mujoco><worldbody>\n<body name="hand"><joint name="grip"/><geom size="0.1"/></body></worldbody></mujoco>'


def test_an_include_is_replaced_by_the_elements_of_its_file() -> None:
    robot = read(body('<joint/><include file="parts/leg.xml"/>'), {"parts/leg.xml": LEG})
    assert [each.name for each in robot.links] == ["world", "part", "leg"]


@pytest.mark.parametrize("place", ["parts/leg.xml", "leg.xml"])
def test_an_inner_include_counts_from_the_source_or_from_its_file(place: str) -> None:
    outer = '<mujocoinclude><include file="leg.xml"/></mujocoinclude>'
    robot = read(body('<joint/><include file="parts/outer.xml"/>'), {"parts/outer.xml": outer, place: LEG})
    assert robot.links[-1].name == "leg"


def test_of_two_files_of_a_name_that_beside_the_source_is_included() -> None:
    outer = '<mujocoinclude><include file="leg.xml"/></mujocoinclude>'
    files = {"parts/outer.xml": outer, "leg.xml": LEG, "parts/leg.xml": LEG.replace('"leg"', '"other"')}
    assert read(body('<joint/><include file="parts/outer.xml"/>'), files).links[-1].name == "leg"


def test_an_image_of_a_light_is_left_out() -> None:
    light = '<asset><texture name="t" file="t.png" type="2d"/></asset>'
    read(body('<joint/><light type="image" texture="t"/>', light))


def test_each_element_has_a_place() -> None:
    """The place of each line of the URDF is that of the body, joint or geom that the line comes from."""
    text, places = translated(document(body('<joint/>\n<include file="leg.xml"/>'), {"leg.xml": LEG}))
    lines = text.splitlines()
    number = next(number for number, line in enumerate(lines, 1) if '<joint name="hip"' in line)
    assert [place[1:] for place in places if place[0] <= number][-1] == (f"{FOLDER}/leg.xml", 3)


def test_an_attached_model_has_a_compiler_of_its_own() -> None:
    """Its angles, its folder of meshes, and masses that follow from them."""
    part = (
        '<mujoco model="part"><compiler angle="radian" meshdir="shapes" inertiafromgeom="true"/><asset>'
        '<mesh name="m" file="a.stl"/></asset><worldbody><body name="tip"><joint name="j" range="-1 1"/>'
        '<inertial pos="0 0 0" mass="5" diaginertia="1 1 1"/><geom type="mesh" mesh="m"/></body></worldbody></mujoco>'
    )
    asset = '<asset><model name="part" file="sub/part.xml"/></asset>'
    text = body('<joint range="-90 90"/><attach model="part" body="tip" prefix="p_"/>', asset)
    files: dict[str, str | bytes] = {"sub/part.xml": part, "sub/shapes/a.stl": stl(0.1)}
    robot = read(text, files)
    inertial, limit = link(robot, "p_tip").inertial, joint(robot, "p_j").limit
    assert inertial is not None
    assert limit is not None
    assert inertial.mass == pytest.approx(1, rel=1e-6)
    assert limit.upper == 1
    assert compare(document(text, files), urdf(text, files))[1] == ()


def test_an_attached_model_has_places_of_its_own() -> None:
    """MuJoCo counts lines in each text alone."""
    asset = '<asset><model name="g" file="gripper.xml"/></asset>'
    text = body('<joint/><attach model="g" body="hand" prefix="left_"/>', asset)
    found, places = translated(document(text, {"gripper.xml": GRIPPER}))
    number = next(number for number, line in enumerate(found.splitlines(), 1) if '<joint name="left_grip"' in line)
    assert [place[1:] for place in places if place[0] <= number][-1] == (f"{FOLDER}/gripper.xml", 2)


def test_defaults_frames_and_copies_are_resolved() -> None:
    default = '<default><default class="arm"><joint damping="3"/></default></default>'
    inner = (
        '<replicate count="2" offset="0 0 1"><body name="leg"><joint class="arm"/><geom size="1"/></body></replicate>'
    )
    robot = read(world(f'<body name="a"><frame pos="1 0 0">{inner}</frame></body>', default), robot="world")
    assert [(each.child, each.origin.xyz) for each in robot.joints if each.dynamics] == [
        ("leg0", (1, 0, 0)),
        ("leg1", (1, 0, 1)),
    ]


def test_each_file_is_recorded_with_a_hash_even_a_missing_one() -> None:
    contents = {SOURCE: body('<joint/><include file="leg.xml"/>').encode(), f"{FOLDER}/leg.xml": LEG.encode()}
    files = Files(contents, [FOLDER])
    read_document(SOURCE, files)
    assert set(files.hashes) == set(contents)
    assert None not in files.hashes.values()
    del contents[f"{FOLDER}/leg.xml"]
    with pytest.raises(Exception, match="can't be read"):
        read_document(SOURCE, files := Files(contents, [FOLDER]))
    assert files.hashes[f"{FOLDER}/leg.xml"] is None


@pytest.mark.parametrize(
    ("text", "files", "told"),
    [
        (
            '<mujoco><worldbody>\n<body name="line 1"/>\n<body name="line 1"/></worldbody></mujoco>',
            {},
            "arm.xml:3: MuJoCo: repeated name 'line 1' in body",
        ),
        (ARM[:200], {}, "arm.xml:5: this is not well-formed XML: unclosed token"),
        ("<mujoco>\n<include/></mujoco>", {}, "arm.xml:2: <include> names no file; write file="),
        ('<mujoco>\n<include file="a.xml"/></mujoco>', {}, "arm.xml:2: a.xml can't be read: No such file or directory"),
        (
            '<mujoco><include file="a.xml"/></mujoco>',
            {"a.xml": '<mujocoinclude>\n<include file="a.xml"/></mujocoinclude>'},
            "a.xml:2: a.xml includes itself",
        ),
        ('<mujoco>\n<include file="/etc/hosts"/></mujoco>', {}, "arm.xml:2: the included file /etc/hosts is outside"),
        ('<mujoco>\n<include file="../../../b"/></mujoco>', {}, "arm.xml:2: the included file /b is outside"),
        (LEG, {}, "arm.xml:1: the root element is <mujocoinclude> and not <mujoco>; name the file that includes this"),
        (
            '<mujoco>\n<asset><mesh file="no.stl"/></asset></mujoco>',
            {},
            "arm.xml:2: no.stl can't be read: No such file",
        ),
        (
            '<mujoco>\n<asset><model name="m" file="arm.xml"/></asset></mujoco>',
            {},
            "arm.xml:2: the model attaches itself",
        ),
        (
            world('<replicate count="10000"><body><joint/><geom size="1"/></body></replicate>'),
            {},
            "arm.xml:1: the model has 30,003 elements, and urdfsync reads up to 20,000",
        ),
        ('<!DOCTYPE m [<!ENTITY a "b">]>\n<mujoco/>', {}, "arm.xml:1: the file declares XML entities"),
    ],
)
def test_a_fault_has_a_line(text: str, files: dict[str, str], told: str) -> None:
    assert problem(text, files).startswith(told)

"""The YAML beside a URDF: its loops, motors and joints are read as if the URDF had them, at the lines of the YAML."""

from __future__ import annotations

import pytest
from support.numbers import BOT, differences, of_package
from support.packages import generate
from support.urdfs import joint, link, robot

from urdfsync.diagnostics import SourceError
from urdfsync.urdf.options import Options
from urdfsync.urdf.parse.beside import join
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.physics.completion import completed_for_pinocchio
from urdfsync.urdf.second.beside import join_again

URDF = robot(
    *(link("base"), link("a", 1.0), link("b", 1.0), link("c", 1.0)),
    joint("m", "continuous", "base", "a", xyz="0 0 0", rpy="0 0 0", axis="0 0 1"),
    joint("e", "continuous", "a", "b", xyz="0.3 0.1 0", rpy="0 0 0", axis="0 0 1"),
    joint("p", "continuous", "base", "c", xyz="0.5 0 0", rpy="0 0 0", axis="0 0 1"),
    *(link("tip_A"), link("tip_B")),
    joint("fa", "fixed", "b", "tip_A", xyz="0.4 0.2 0", rpy="0 0 0"),
    joint("fb", "fixed", "c", "tip_B", xyz="0.2 0.3 0", rpy="0 0 0"),
).encode()
YAML = b"""closed_loop: [['tip_A', 'tip_B']]
type: ['6d']
name_mot: ['m']
joint_name: ['e']
joint_type: [SPHERICAL]
"""


def test_loops_motors_and_joints_are_as_the_yaml_says() -> None:
    text, places = join(URDF, YAML, "a.yaml")
    reading = read_robot(text, "a.urdf")
    assert reading.robot is not None
    (loop,) = reading.robot.loops
    assert (loop.kind, loop.parent, loop.child) == ("fixed", "tip_A", "tip_B")
    joints = {joint.name: joint for joint in reading.robot.joints}
    assert joints["m"].actuated
    assert [(joints[f"e_{axis}"].parent, joints[f"e_{axis}"].child) for axis in "xyz"] == [
        ("a", "e_x"),
        ("e_x", "e_y"),
        ("e_y", "b"),
    ]
    assert joints["e_y"].axis == (0.0, 1.0, 0.0)
    assert joints["e_y"].measured
    assert dict(places)[reading.lines["loop tip_A_tip_B"]] == 1
    assert dict(places)[reading.lines["joint e_x"]] == 4


def test_the_second_reader_finds_the_joints_of_the_yaml() -> None:
    for kind in (b"SPHERICAL", b"FIXED", b"UJOINT_YX"):
        yaml = YAML.replace(b"SPHERICAL", kind)
        text, _ = join(URDF, yaml, "a.yaml")
        assert join_again((URDF, yaml), Options()) == text
        assert differences(text, allow=()) == []


@pytest.mark.parametrize("more", [b"? [a, b]\n: c\n", b"more: &x [*x]\n"])
def test_a_yaml_with_other_keys_is_joined_alike_twice(more: bytes) -> None:
    assert join_again((URDF, YAML + more), Options()) == join(URDF, YAML + more, "a.yaml")[0]


def test_a_name_in_another_encoding_than_that_of_the_urdf_is_found() -> None:
    names = URDF.decode().replace("tip_A", "é1").removeprefix('<?xml version="1.0"?>')
    urdf = f'<?xml version="1.0" encoding="iso-8859-1"?>{names}'.encode("latin-1")
    yaml = YAML.decode().replace("tip_A", "é1").encode()
    text, _ = join(urdf, yaml, "a.yaml")
    found = read_robot(text, "a.urdf").robot
    assert found is not None
    assert [each.name for each in found.loops] == ["é1_tip_B"]
    assert join_again((urdf, yaml), Options()) == text


@pytest.mark.parametrize(("old", "new", "element"), [
    (b"_XY", b"_YX", "joint e_x"),
    (b"6d", b"3d", "loop tip_A_tip_B"),
])  # fmt: skip
def test_a_yaml_that_is_joined_wrongly_is_found(old: bytes, new: bytes, element: str) -> None:
    yaml = YAML.replace(b"SPHERICAL", b"UJOINT_XY")
    text, _ = join(URDF, yaml, "a.yaml")
    package = generate(text, BOT)
    assert of_package(package, text, package.texts, (URDF, yaml)).differences == ()
    found = of_package(package, text, package.texts, (URDF, yaml.replace(old, new))).differences
    assert element in {each.element for each in found}


def test_pinocchio_gets_the_joints_of_the_yaml() -> None:
    for kind in (b"SPHERICAL", b"FIXED", b"UJOINT_YX"):
        text, _ = join(URDF, YAML.replace(b"SPHERICAL", kind), "a.yaml")
        ours, theirs = (read_robot(each, "a.urdf").robot for each in (text, completed_for_pinocchio(text).content))
        assert ours is not None
        assert theirs is not None
        assert {one.name for one in theirs.links} == {one.name for one in ours.links}
        chains = [
            {(one.name, one.type, one.parent, one.child, one.origin, one.axis) for one in robot.joints}
            for robot in (ours, theirs)
        ]
        assert chains[0] == chains[1]


def test_a_joint_of_the_yaml_that_is_none_is_told() -> None:
    text, places = join(URDF, YAML.replace(b"'e'", b"'elbow'"), "a.yaml")
    (finding,) = read_robot(text, "a.urdf").diagnostics
    assert (finding.code, dict(places)[finding.line]) == ("unknown-reference", 4)


def test_axes_that_are_none_are_told() -> None:
    """Such an element may stand in a URDF itself."""
    text = URDF.replace(b"</robot>", b'<joint_axes joint="e" axes="q"/></robot>')
    (finding,) = read_robot(text, "a.urdf").diagnostics
    assert (finding.code, "its axes 'q' are unknown" in finding.message) == ("unknown-reference", True), finding


def test_another_yaml_says_nothing() -> None:
    for other in (b"controller: {gain: 3}\n", b"- closed_loop\n", b"drive: {closed_loop: true}\n", b"closed_loop:\n"):
        assert join(URDF, other, "a.yaml")[1] in ((), [])


@pytest.mark.parametrize(("yaml", "line", "words"), [
    (b"a: 1\nclosed_loop: [[x, y]\ntype: ['6d']\n", 3, "expected"),
    (b"a: 1\nclosed_loop: [[x, y]]\ntype: []\n", 2, "the file has 1 loop and 0 types"),
    (b"closed_loop: [[x, y]]\ntype: ['5d']\n", 2, "the type '5d' is none of 3d, 6d"),
    (b"closed_loop: [[x]]\ntype: ['6d']\n", 1, "an item of `closed_loop` is no pair of frames"),
    (b"closed_loop: [[x, [y]]]\ntype: ['6d']\n", 1, "an item of `closed_loop` is no name"),
    (b"closed_loop: 5\ntype: ['6d']\n", 1, "`closed_loop` is no list"),
    (b"closed_loop: []\ntype: []\nclosed_loop: []\n", 3, "the key `closed_loop` stands twice"),
    (b"a: 1\nclosed_loops: [[x, y]]\ntype: ['6d']\n", 2, "`closed_loops` is unknown; perhaps `closed_loop` is meant"),
    (YAML.replace(b"['m']", b"m"), 3, "`name_mot` is no list"),
    (YAML.replace(b"[SPHERICAL]", b"[]"), 1, "the file has 1 joint and 0 joint types"),
    (YAML.replace(b"[SPHERICAL]", b"[[X]]"), 5, "an item of `joint_type` is no name"),
    (YAML.replace(b"[SPHERICAL]", b"[BALL]"), 5, "the joint type 'BALL' is none of FIXED, SPHERICAL"),
    (b"closed_loop: " + b"[" * 2_000, 1, "lists are nested 50 deep"),
    (b"closed_loop:\n " + b"- " * 2_000, 2, "lists are nested 50 deep"),
    (b"closed_loop: [" + b"[x, y], " * 20_000 + b"]", 1, "the file has more than 100,000 bytes"),
    (b"closed_loop: [&a [%b, y]%b]\ntype: [&k 6d%b]" % (b"x" * 30_000, b", *a" * 7_000, b", *k" * 7_000), 1,
     "the elements for the URDF have more than 10,000,000 characters"),
    (b'closed_loop: [["\\UFFFFFFFF", y]]\ntype: [6d]', 1, "this is no list of loops"),
    (b'closed_loop: [["\\uD800", y]]\ntype: [6d]', 1, "this is no list of loops"),
])  # fmt: skip
def test_a_fault_is_one_line(yaml: bytes, line: int, words: str) -> None:
    with pytest.raises(SourceError) as raised:
        join(URDF, yaml, "a.yaml")
    (error,) = raised.value.diagnostics
    assert (error.file, error.line) == ("a.yaml", line)
    assert words in error.message

"""The YAML beside a URDF: its loops, motors and joints join those of the URDF, with the lines of the YAML."""

from __future__ import annotations

import pytest
from support.numbers import BOT, differences, of_package
from support.packages import generate
from support.urdfs import joint, link, robot

from urdfsync.common.diagnostics import SourceError
from urdfsync.domain import Companion
from urdfsync.domain.experiment import Sample
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.parse.closures import read_closures
from urdfsync.formats.urdf.parse.source import RobotReading, read_robot
from urdfsync.formats.urdf.physics.completion import completed_for_reference
from urdfsync.formats.urdf.robot import Motor, Transmission
from urdfsync.formats.urdf.second.companions import read_companions

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


KINDS = pytest.mark.parametrize("kind", [b"SPHERICAL", b"FIXED", b"UJOINT_YX"])


def beside(yaml: bytes = YAML) -> Companion:
    return Companion("closed_loops", "a.yaml", yaml)


def read(yaml: bytes = YAML, urdf: bytes = URDF) -> RobotReading:
    return read_robot(urdf, "a.urdf", Options(), beside(yaml))


def test_loops_motors_and_joints_are_as_the_yaml_says() -> None:
    reading = read()
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
    places = [(reading.files.get(path), reading.lines[path]) for path in ("loop tip_A_tip_B", "joint e_x", "joint m")]
    assert places == [("a.yaml", 1), ("a.yaml", 4), (None, 7)]


@KINDS
def test_the_second_reader_finds_the_joints_of_the_yaml(kind: bytes) -> None:
    assert differences(URDF, [beside(YAML.replace(b"SPHERICAL", kind))], allow=()) == []


@pytest.mark.parametrize("more", [b"? [a, b]\n: c\n", b"more: &x [*x]\n"])
def test_other_keys_of_a_yaml_say_nothing(more: bytes) -> None:
    assert read_closures(beside(YAML + more)) == read_closures(beside())
    assert differences(URDF, [beside(YAML + more)], allow=()) == []


@pytest.mark.parametrize("encoding", ["latin-1", "utf-8", "utf-16"])
@pytest.mark.parametrize("of_yaml", ["utf-8", "utf-16"])
def test_urdf_and_yaml_may_have_different_encodings(encoding: str, of_yaml: str) -> None:
    names = URDF.decode().replace("tip_A", "é1").removeprefix('<?xml version="1.0"?>')
    urdf = f'<?xml version="1.0" encoding="{encoding}"?>{names}'.encode(encoding)
    yaml = YAML.decode().replace("tip_A", "é1").encode(of_yaml)
    found = read(yaml, urdf).robot
    assert found is not None
    assert [each.name for each in found.loops] == ["é1_tip_B"]
    assert differences(urdf, [beside(yaml)], allow=()) == []


def test_a_comment_behind_the_robot_gets_nothing() -> None:
    urdf = URDF + b"<!-- the former </robot> -->\n"
    assert read(urdf=urdf).robot == read().robot
    assert differences(urdf, [beside()], allow=()) == []


@pytest.mark.parametrize(("old", "new", "element"), [
    (b"_XY", b"_YX", "joint e_x"),
    (b"6d", b"3d", "loop tip_A_tip_B"),
])  # fmt: skip
def test_a_yaml_that_is_joined_wrongly_is_found(old: bytes, new: bytes, element: str) -> None:
    yaml = YAML.replace(b"SPHERICAL", b"UJOINT_XY")
    package = generate(URDF, BOT, beside(yaml))
    assert of_package(package, URDF, package.texts, beside(yaml)).differences == ()
    found = of_package(package, URDF, package.texts, beside(yaml.replace(old, new))).differences
    assert element in {each.element for each in found}


def test_a_difference_of_a_loop_has_its_line_in_the_yaml() -> None:
    package = generate(URDF, BOT, beside())
    yaml = beside(b"# pairs\n" + YAML.replace(b"6d", b"3d"))
    found = of_package(package, URDF, package.texts, yaml).differences
    assert ("a.yaml", 2) in {(each.source, each.source_line) for each in found if each.element.startswith("loop")}


@KINDS
def test_pinocchio_gets_the_joints_of_the_yaml(kind: bytes) -> None:
    yaml = YAML.replace(b"SPHERICAL", kind)
    completed = completed_for_reference(URDF, companions=read_companions([beside(yaml)], Options())).content
    ours, theirs = read(yaml).robot, read_robot(completed, "a.urdf").robot
    assert ours is not None
    assert theirs is not None
    assert {one.name for one in theirs.links} == {one.name for one in ours.links}
    assert theirs.loops == ours.loops
    chains = [
        {(one.name, one.type, one.parent, one.child, one.origin, one.axis, one.actuated) for one in robot.joints}
        for robot in (ours, theirs)
    ]
    assert chains[0] == chains[1]


def test_the_experiment_with_pinocchio_is_read_with_the_catalogue_alone() -> None:
    """Its copy of the URDF has the statements of the YAML."""
    motors = Companion("catalogue", "motors.csv", b"name,effort [N.m],reduction [1]\nS,3,50\n")
    options = Options(catalogue="motors.csv", motors={"m": "S"})
    ours = read_robot(URDF, "a.urdf", options, beside(), motors).robot
    found = DOMAIN.checks.experiment(Sample(URDF, "a.urdf", BOT, options, {}, companions=(beside(), motors)))
    theirs = read_robot(found.content, "a.urdf", found.options, *found.companions).robot
    assert ours is not None
    assert theirs is not None
    assert (found.companions, theirs.loops) == ((motors,), ours.loops)
    drives = [
        {joint.name: (joint.motor, joint.transmission, joint.actuated) for joint in each.joints}
        for each in (ours, theirs)
    ]
    assert drives[0] == drives[1]
    assert drives[0]["m"] == (Motor("S", ("effort", "reduction")), Transmission(50.0), True)


@pytest.mark.parametrize(("old", "new", "code", "line"), [
    (b"'e'", b"'elbow'", "unknown-reference", 4),
    (b"'m'", b"'motor'", "unknown-actuated-joint", 3),
    (b"'tip_B'", b"'tip_C'", "loop-of-no-link", 1),
])  # fmt: skip
def test_a_name_that_the_urdf_lacks_is_told(old: bytes, new: bytes, code: str, line: int) -> None:
    found = read(YAML.replace(old, new)).diagnostics
    assert (code, "a.yaml", line) in [(finding.code, finding.file, finding.line) for finding in found]


def test_an_empty_list_states_nothing() -> None:
    assert not any(read_closures(beside(b"closed_loop:\n"))[1:])


@pytest.mark.parametrize(
    "other", [b"controller: {gain: 3}\n", b"- closed_loop\n", b"drive: {closed_loop: true}\n", b""]
)
def test_a_yaml_of_another_kind_is_told(other: bytes) -> None:
    with pytest.raises(SourceError, match="it states no loop, no motor and no joint"):
        read_closures(beside(other))


@pytest.mark.parametrize(("yaml", "line", "words"), [
    (b"a: 1\nclosed_loop: [[x, y]\ntype: ['6d']\n", 3, "expected"),
    (b"a: 1\nclosed_loop: [[x, y]]\ntype: []\n", 2, "the file has 1 loop and 0 loop types"),
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
    (b"closed_loop: " + b"[" * 1_000, 1, "lists are nested too deep"),
    (b"closed_loop:\n " + b"- " * 2_000, 1, "lists are nested too deep"),
    (b"closed_loop: [" + b"[x, y], " * 20_000 + b"]", 1, "the file has more than 100,000 bytes"),
    (b"closed_loop: [&a [%b, y]%b]\ntype: [&k 6d%b]" % (b"x" * 30_000, b", *a" * 7_000, b", *k" * 7_000), 1,
     "the names have more than 10,000,000 bytes"),
    (b'closed_loop: [["\\UFFFFFFFF", y]]\ntype: [6d]', 1, "this is no list of loops"),
    (b'closed_loop: [["\\uD800", y]]\ntype: [6d]', 1, "this is no list of loops"),
])  # fmt: skip
def test_a_fault_is_one_line(yaml: bytes, line: int, words: str) -> None:
    (error,) = read(yaml).diagnostics
    assert (error.file, error.line) == ("a.yaml", line)
    assert words in error.message

"""Differences of robots in the words of URDF: paths, units and classes, one example per line of the design's table."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import msgspec
import pytest
import support.urdfs as urdfs
from support.packages import read

from urdfsync.domain import ChangeClass, ChangeKind, Import, Version, further_key
from urdfsync.domain.changes import Change
from urdfsync.domain.comparison import compare
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.meshes import lookup
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import Mesh, Robot
from urdfsync.project.state.record import as_read, as_recorded

NONE, UNMODELLED, PARAMETER, STRUCTURAL = list(ChangeClass)[:4]
ADDED, REMOVED, CHANGED = list(ChangeKind)[:3]
FIXED, FLOATING = Options(), Options(base="floating")
MESH = lookup.key(Mesh("arm.stl"))
Data = dict[str, Any]

ROBOT = urdfs.robot(
    """<link name="base">
      <inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
      <visual name="cover"><geometry><box size="1 2 3"/></geometry>
        <material name="red"><color rgba="1 0 0 1"/></material></visual>
      <visual><geometry><mesh filename="arm.stl"/></geometry></visual>
      <collision><geometry><sphere radius="0.1"/></geometry></collision>
      <collision><geometry><mesh filename="arm.stl"/></geometry></collision>
    </link>""",
    *(f'<link name="{name}"/>' for name in ("one", "two", "three", "four", "five", "six", "seven", "eight")),
    """<joint name="turn" type="revolute"><parent link="base"/><child link="one"/><axis xyz="0 0 1"/>
      <limit lower="-1" upper="1" effort="5" velocity="2"/><dynamics damping="0.1" friction="0.2"/>
      <safety_controller k_velocity="3"/><calibration rising="0.5"/></joint>""",
    """<joint name="slide" type="prismatic"><parent link="base"/><child link="two"/><axis xyz="0 0 1"/>
      <limit lower="0" upper="1" effort="5" velocity="2"/><dynamics damping="0.1"/>
      <mimic joint="turn" multiplier="0.5"/></joint>""",
    """<joint name="spin" type="continuous"><parent link="base"/><child link="three"/>
      <limit effort="5" velocity="2"/></joint>""",
    """<joint name="glide" type="planar"><parent link="base"/><child link="four"/>
      <dynamics damping="0.1"/></joint>""",
    '<joint name="weld" type="fixed"><parent link="base"/><child link="five"/></joint>',
    *(
        urdfs.joint(name, kind, "base", child, inside=[urdfs.mimic(leader)])
        for name, kind, child, leader in (
            ("lean", "continuous", "six", "turn"),
            ("rest", "continuous", "seven", "weld"),
            ("bolt", "fixed", "eight", "turn"),
        )
    ),
    '<gazebo reference="one"><selfCollide>1</selfCollide></gazebo>',
)


def import_(content: str, hull: bool = True) -> Import:
    facts = {"bounds": [[0.0] * 3, [1.0] * 3], "hull": [[0.0] * 3] if hull else []}
    return Import("Resources/arm.stl", content, content, facts)


def version(edit: Callable[[Data], object] = lambda _: None, found: Import | None = None) -> Version:
    data = as_recorded(read(ROBOT.encode()).snapshot)
    edit(data)
    return Version(as_read(data, Robot), {MESH: found} if found else {})


def changes(edit: Callable[[Data], object], options: Options = FIXED) -> list[Change]:
    """The changes that an edit of the robot's snapshot makes; its mesh is there before and after."""
    found = import_("a")
    return list(compare(version(found=found), version(edit, found), DOMAIN, options).changes)


def at(path: str) -> list[str | int]:
    """Where the snapshot has what a path in the words of URDF names."""
    element, *inside = path.split(" / ")
    kind, _, name = element.partition(" ")
    found: list[str | int] = [f"{kind}s", name] if name else []
    for word in inside:
        shape, index = re.fullmatch(r"(visual|collision) (\d+)", word), re.fullmatch(r"(\w+)\[(\d)\]", word)
        found += [f"{shape[1]}s", int(shape[2]) - 1] if shape else [index[1], int(index[2])] if index else [word]
    return found


def put(path: str, value: Any) -> Callable[[Data], object]:
    """Set the value at a path; without a value, remove it."""

    def edit(data: Any) -> None:
        *keys, last = at(path)
        for key in keys:
            data = data[key]
        if value is None:
            del data[last]
        else:
            data[last] = value

    return edit


CASES = """
    robot / name = "other"                                  changed parameter
    link base / inertial / mass = 3.0                       changed kg parameter
    link base / inertial / inertia / ixy = 0.1              changed kg·m² parameter
    link base / inertial                                    removed parameter
    link base / visual 1 / origin / rpy[2] = 1.0            changed rad parameter
    link base / visual 1 / geometry / size[0] = 9.0         changed m parameter
    link base / visual 1 / material / rgba[1] = 0.5         changed parameter
    link base / visual 1 / material                         removed parameter
    link base / visual 1 / material / name = "blue"         changed unmodelled
    link base / visual 2 / material = {"name": "red"}       added unmodelled
    link base / visual 1 / name = "lid"                     changed parameter
    link base / visual 2                                    removed structural
    link base / collision 2                                 removed structural
    link base / collision 1 / geometry / radius = 0.2       changed m parameter
    joint weld / type = "floating"                          changed structural
    joint weld / parent = "one"                             changed structural
    joint weld / origin / xyz[2] = 1.0                      changed m parameter
    joint weld / axis[0] = 0.5                              changed unmodelled
    joint weld / dynamics = {"damping": 0, "friction": 0}   added unmodelled
    joint weld / limit = {"lower": 0, "upper": 0}           added unmodelled
    joint turn / axis[2] = 0.5                              changed parameter
    joint turn / limit / upper = 2.0                        changed rad parameter
    joint turn / limit / velocity = 3.0                     changed rad/s parameter
    joint turn / limit / effort                             removed N·m parameter
    joint turn / limit                                      removed parameter
    joint turn / dynamics / damping = 0.0                   changed N·m·s/rad parameter
    joint turn / dynamics                                   removed structural
    joint turn / calibration                                removed parameter
    joint turn / safety_controller / k_position = 1.0       changed 1/s parameter
    joint spin / limit / lower = 1.0                        changed rad unmodelled
    joint spin / limit / effort = 1.0                       changed N·m parameter
    joint slide / limit / effort = 1.0                      changed N parameter
    joint slide / dynamics / friction = 1.0                 changed N parameter
    joint slide / mimic / multiplier = 1.0                  changed m/rad parameter
    joint lean / mimic / multiplier = 2.0                   changed parameter
    joint rest / mimic / multiplier = 2.0                   changed parameter
    joint bolt / mimic / multiplier = 2.0                   changed unmodelled
    joint slide / mimic / offset = 1.0                      changed m parameter
    joint slide / mimic / joint = "spin"                    changed structural
    joint slide / mimic                                     removed structural
    joint glide / axis[0] = 0.5                             changed parameter
    joint glide / dynamics / damping = 1.0                  changed parameter
    joint glide / dynamics                                  removed structural
"""
"""What is edited, and the kind, unit and class of the change. What gets no value is removed."""


@pytest.mark.parametrize("case", CASES.strip().splitlines(), ids=str.strip)
def test_an_edit_is_one_change_in_the_words_of_urdf(case: str) -> None:
    edited, said = re.split(r"\s{2,}", case.strip())
    path, _, value = edited.partition(" = ")
    found = [change for change in changes(put(path, json.loads(value or "null"))) if str(change) == path]
    assert [" ".join(f"{one.kind} {one.unit} {one.change_class}".split()) for one in found] == [said]


def test_each_of_two_changes_of_one_shape_has_its_own_class() -> None:
    def edit(data: Data) -> None:
        put("link base / visual 1 / geometry / size[0]", 9.0)(data)
        put("link base / visual 1 / material / name", "blue")(data)

    found = {str(change).rpartition(" / ")[2]: change.change_class for change in changes(edit)}
    assert found == {"size[0]": PARAMETER, "name": UNMODELLED}


@pytest.mark.parametrize(
    ("numbers", "expected"),
    [
        ((2, 1), {"link base / collision 2 / origin / xyz[0]": PARAMETER}),
        ((2,), {"link base / collision 2 / origin / xyz[0]": PARAMETER, "link base / collision 1": STRUCTURAL}),
        ((3, 1), {"link base / collision 3": STRUCTURAL, "link base / collision 2": STRUCTURAL}),
    ],
    ids=["exchanged", "removed", "replaced"],
)
def test_shapes_are_told_by_their_lasting_numbers(numbers: Sequence[int], expected: Mapping[str, ChangeClass]) -> None:
    def edit(data: Data) -> None:
        first, second = data["links"]["base"]["collisions"]
        shapes = {1: first, 2: second | {"origin": {"xyz": [1, 0, 0]}}, 3: first | {"name": "new"}}
        data["links"]["base"]["collisions"] = [shapes[number] | {"number": number} for number in numbers]

    assert {" / ".join(change.path): change.change_class for change in changes(edit)} == expected


def test_a_value_that_only_one_version_models_is_modelled() -> None:
    def edit(data: Data) -> None:
        put("joint spin / type", "revolute")(data)
        put("joint spin / limit / lower", 1.0)(data)

    found = {str(change).rpartition(" / ")[2]: change.change_class for change in changes(edit)}
    assert found == {"type": STRUCTURAL, "lower": PARAMETER}


def test_what_is_named_by_its_element_alone_came_or_went() -> None:
    def add(data: Data) -> None:
        data["links"]["nine"] = {"visuals": [], "collisions": []}
        data["joints"]["nine"] = {**data["joints"]["weld"], "child": "nine"}

    found = [(str(change), change.kind, change.change_class) for change in changes(add)]
    assert found == [("link nine", ADDED, STRUCTURAL), ("joint nine", ADDED, STRUCTURAL)]


def test_collisions_that_are_not_wanted_are_not_modelled_unless_the_robot_stands_on_them() -> None:
    edit = put("link base / collision 1 / geometry / radius", 0.2)
    assert [change.change_class for change in changes(edit, Options(collisions=False))] == [UNMODELLED]
    assert [change.change_class for change in changes(edit, Options(base="floating", collisions=False))] == [PARAMETER]


def mesh_change(
    old: Import | None, new: Import | None, options: Options = FIXED
) -> Iterator[tuple[str, ChangeKind, str]]:
    for change in compare(version(found=old), version(found=new), DOMAIN, options).changes:
        yield str(change), change.kind, change.change_class


@pytest.mark.parametrize(("old", "new", "kind", "reach"), [
    (import_("a"), import_("b"), CHANGED, PARAMETER),
    (None, import_("a"), ADDED, STRUCTURAL),
    (import_("a"), None, REMOVED, STRUCTURAL),
])  # fmt: skip
def test_the_content_of_a_mesh_is_a_parameter_its_presence_structure(
    old: Import | None, new: Import | None, kind: ChangeKind, reach: ChangeClass
) -> None:
    assert list(mesh_change(old, new)) == [("mesh arm.stl / content", kind, reach)]


def test_a_mesh_that_can_no_longer_touch_the_ground_is_structural_for_mobile_robots() -> None:
    old, new = import_("a"), import_("b", hull=False)
    assert [change[2] for change in mesh_change(old, new, FIXED)] == [PARAMETER]
    assert [change[2] for change in mesh_change(old, new, FLOATING)] == [STRUCTURAL]
    lower = msgspec.structs.replace(new, facts={**old.facts, "hull": [[0.0, 0.0, -1.0]]})
    assert [change[2] for change in mesh_change(old, lower, FLOATING)] == [PARAMETER]


@pytest.mark.parametrize("options", [FIXED, FLOATING])
def test_a_mesh_that_begins_or_ceases_to_collide_is_a_change_of_its_link_alone(options: Options) -> None:
    found = import_("a")
    seen = msgspec.structs.replace(found, facts={"bounds": found.facts["bounds"]})  # nothing asked for the hull
    without, with_it = version(put("link base / collision 2", None), seen), version(found=found)
    for old, new, kind in ((without, with_it, ADDED), (with_it, without, REMOVED)):
        (change,) = compare(old, new, DOMAIN, options).changes
        assert (str(change), change.kind, change.change_class) == ("link base / collision 2", kind, STRUCTURAL)


def test_a_mesh_shows_its_colours_where_a_material_comes_or_goes() -> None:
    """A mesh with two colours is two visuals; only the version without the material knows that."""
    plain = import_("a")
    parts = {"parts": [[255, 0, 0], [0, 0, 255]], "textured": False, "colorless": False}
    split = {MESH: msgspec.structs.replace(plain, facts={**plain.facts, **parts}), further_key(MESH, 1): plain}
    painted = version(put("link base / visual 2 / material", {"name": "", "rgba": [1.0, 0.0, 0.0, 1.0]}), plain)
    bare = msgspec.structs.replace(version(), imports=split)
    for old, new, kind in ((painted, bare, REMOVED), (bare, painted, ADDED)):
        found = [change for change in compare(old, new, DOMAIN, FIXED).changes if change.element == "link base"]
        assert [(str(c), c.kind, c.change_class) for c in found] == [
            ("link base / visual 2 / material", kind, STRUCTURAL)
        ]


def test_a_robot_that_was_fixed_has_no_hulls_to_compare() -> None:
    found = import_("a")
    fixed = msgspec.structs.replace(found, facts={"bounds": found.facts["bounds"]})
    assert list(mesh_change(fixed, found, FLOATING)) == []
    assert [change[2] for change in mesh_change(fixed, None, FLOATING)] == [STRUCTURAL]


@pytest.mark.parametrize(("meshes", "options", "reach"), [
    ({MESH: import_("a")}, FIXED, STRUCTURAL),
    ({}, FIXED, UNMODELLED),
    (None, FIXED, PARAMETER),
    (None, Options(meshes="skip"), UNMODELLED),
])  # fmt: skip
def test_another_mesh_file_matters_as_far_as_it_is_found(
    meshes: dict[str, Import] | None, options: Options, reach: ChangeClass
) -> None:
    edit = put("link base / visual 2 / geometry / filename", "other.stl")
    old, new = (msgspec.structs.replace(version(e), imports=meshes) for e in (lambda _: None, edit))
    found = compare(old, new, DOMAIN, options).changes
    assert [(str(c), c.change_class) for c in found] == [("link base / visual 2 / geometry / filename", reach)]


def test_a_mesh_that_comes_or_goes_with_its_shapes_is_no_change_by_itself() -> None:
    def other(data: Data) -> None:
        for group in ("visuals", "collisions"):
            data["links"]["base"][group][1]["geometry"]["filename"] = "other.stl"

    old, new = version(found=import_("a")), version(other)
    new = msgspec.structs.replace(new, imports={lookup.key(Mesh("other.stl")): import_("b")})
    found = {str(change): change.change_class for change in compare(old, new, DOMAIN, FIXED).changes}
    shapes = ("visual", "collision")
    assert found == {f"link base / {shape} 2 / geometry / filename": PARAMETER for shape in shapes}


CASTERS = (
    *(f'<link name="{name}"/>' for name in ("base", "one", "two", "three")),
    '<joint name="wheel" type="continuous"><parent link="base"/><child link="one"/></joint>',
    '<joint name="caster" type="continuous"><parent link="base"/><child link="two"/></joint>',
    '<joint name="mast" type="revolute"><parent link="base"/><child link="three"/><limit upper="1"/></joint>',
)
WHEEL, MAST = (f'<transmission name="{name} drive"><joint name="{name}"/></transmission>' for name in ("wheel", "mast"))


FOLLOWER = '<link name="f"/>' + urdfs.joint("f", "continuous", "base", "f", inside=[urdfs.mimic("wheel")])

PAIR = ('<link name="a"/><link name="b"/>', '<joint name="a" type="fixed"><parent link="a"/><child link="b"/></joint>')
EYE = '<link name="b"><sensor name="camera"/></link>'


IMU = '<gazebo reference="{}"><sensor name="imu" type="imu"><pose>{} 0 0 0 0 0</pose></sensor></gazebo>'
FORCE = '<gazebo reference="{}"><sensor name="s" type="force_torque"><force_torque>{}</force_torque></sensor></gazebo>'
CHILD = "<frame>child</frame>"
COMMAND = '<ros2_control name="c"><joint name="wheel"><command_interface name="{}"/></joint></ros2_control>'

START = """<ros2_control name="c"><joint name="wheel"><command_interface name="position"/><state_interface
    name="position"><param name="initial_value">{}</param></state_interface></joint></ros2_control>"""


def geared(inside: str) -> str:
    """The drive of the wheel, with more to say of its motor."""
    return WHEEL.replace("</trans", f"<actuator name='m'>{inside}</actuator></trans")


def servo(command: str = "position", **numbers: float) -> str:
    """The command of the wheel, with the law of its drive."""
    params = "".join(f'<param name="{name}">{number}</param>' for name, number in numbers.items())
    return COMMAND.replace('"{}"/>', f'"{command}">{params}</command_interface>')


def with_caster(old: str, new: str) -> tuple[str, ...]:
    """The robot with the drive of its wheel, and another text about its caster."""
    return (*CASTERS[:5], CASTERS[5].replace(old, new), *CASTERS[6:], WHEEL)


def tags(*links: str) -> list[str]:
    return [f'<gazebo reference="{link}"><selfCollide>1</selfCollide></gazebo>' for link in links]


def said(old: Sequence[str], new: Sequence[str], options: Options = FIXED) -> set[str]:
    """The changes from one robot to another: with both values where a drive changed."""
    found = compare(urdfs.version(*old), urdfs.version(*new), DOMAIN, options).changes
    return {
        f"{each}: {f'{each.old} → {each.new}' if each.path[-1] == 'drive' else each.kind}, {each.change_class}"
        for each in found
    }


DRIVES = {
    "the first drive makes casters passive": (
        CASTERS,
        (*CASTERS, WHEEL),
        {"joint caster / drive: driven → passive, structural"},
    ),
    "a joint that is driven anyway": ((*CASTERS, WHEEL),
        (*CASTERS, WHEEL, MAST), set()),
    "another text about a drive": (
        (*CASTERS, WHEEL),
        (*CASTERS, WHEEL.replace("</trans", "<n/></trans")),
        {"transmission wheel drive / extensions: added, unmodelled"},
    ),
    "a gear stands in the record": (
        (*CASTERS, WHEEL),
        (*CASTERS, geared("<mechanicalReduction>50</mechanicalReduction>")),
        {"joint wheel / transmission: added, parameter"},
    ),
    "another gear": (
        (*CASTERS, geared("<mechanicalReduction>50</mechanicalReduction>")),
        (*CASTERS, geared("<mechanicalReduction>60</mechanicalReduction>")),
        {"joint wheel / transmission / reduction: changed, parameter"},
    ),
    "a rotor is a part of the joint": (
        (*CASTERS, WHEEL),
        (*CASTERS, geared('<drake:rotor_inertia value="1e-4"/>')),
        {"joint wheel / transmission: added, structural"},
    ),
    "ros2_control commands a speed": (
        (*CASTERS, COMMAND.format("position")),
        (*CASTERS, COMMAND.format("velocity")),
        {"joint wheel / command: added, structural"},
    ),
    "a drive gets a law": (
        (*CASTERS, COMMAND.format("position")),
        (*CASTERS, servo(position_gain=50)),
        {"joint wheel / servo: added, structural"},
    ),
    "another gain": (
        (*CASTERS, servo(position_gain=50, velocity_gain=5)),
        (*CASTERS, servo(position_gain=50, velocity_gain=6)),
        {"joint wheel / servo / velocity_gain: changed, parameter"},
    ),
    "a law gets a limit": (
        (*CASTERS, servo(position_gain=50)),
        (*CASTERS, servo(position_gain=50, max_effort=9)),
        {"joint wheel / servo / max_effort: added, parameter"},
    ),
    "a law becomes one of an integral": (
        (*CASTERS, servo("velocity", velocity_gain=5)),
        (*CASTERS, servo("velocity", velocity_gain=5, position_gain=50)),
        {"joint wheel / servo / position_gain: added, structural"},
    ),
    "another start position": (
        (*CASTERS, START.format(0.5)),
        (*CASTERS, START.format(0.6)),
        {"joint wheel / start: changed, parameter"},
    ),
    "a start position comes": (
        (*CASTERS, COMMAND.format("position")),
        (*CASTERS, START.format(0.5)),
        {"joint wheel / start: added, structural"},
    ),
    "a sensor comes": (
        PAIR,
        (*PAIR, IMU.format("b", 1)),
        {"sensor imu: added, structural"},
    ),
    "a sensor has another place on its link": (
        (*PAIR, IMU.format("b", 1)),
        (*PAIR, IMU.format("b", 2)),
        {"sensor imu / origin / xyz[0]: changed, parameter"},
    ),
    "a sensor moves with the new name of its link": (
        (*PAIR, IMU.format("b", 1)),
        (*(element.replace('"b"', '"c"') for element in PAIR), IMU.format("c", 1)),
        {"link b: renamed, structural"},
    ),
    "a sensor moves with the new name of its joint": (
        (*PAIR, FORCE.format("a", CHILD)),
        (PAIR[0], PAIR[1].replace('name="a"', 'name="c"'), FORCE.format("c", CHILD)),
        {"joint a: renamed, structural"},
    ),
    "a sensor measures in the frame of the other link": (
        (*PAIR, FORCE.format("a", CHILD)),
        (*PAIR, FORCE.format("a", "<frame>parent</frame>")),
        {"sensor s / in_parent: changed, structural"},
    ),
    "a sensor measures the other way": (
        (*PAIR, FORCE.format("a", CHILD)),
        (*PAIR, FORCE.format("a", f"{CHILD}<measure_direction>parent_to_child</measure_direction>")),
        {"sensor s / on_child: changed, structural"},
    ),
    "a caster that is fixed has no drive to speak of": ((*CASTERS, WHEEL),
        with_caster("continuous", "fixed"), {"joint caster / type: changed, structural"}),
    "nor has one that follows": ((*CASTERS, WHEEL),
        with_caster('"two"/>', '"two"/><mimic joint="wheel"/>'), {"joint caster / mimic: added, structural"}),
    "a rename that the transmission has missed": (
        (*CASTERS, WHEEL),
        (*(element.replace('"wheel"', '"tyre"') for element in CASTERS), WHEEL),
        {
            "joint wheel: renamed, structural",
            "joint caster / drive: passive → driven, structural",
            "robot / extensions: added, unmodelled",
        },
    ),
    "a rename that what follows goes along with": (
        (*CASTERS, FOLLOWER),
        tuple(element.replace('"wheel"', '"tyre"') for element in (*CASTERS, FOLLOWER)),
        {"joint wheel: renamed, structural"},
    ),
    "extensions are told apart by what they are about": ((*PAIR, *tags("b")),
        (*PAIR, *tags("a", "b")), {"gazebo a / extensions: added, unmodelled"}),
    "or by their number": ((*PAIR, "<n><a/></n>"),
        (*PAIR, "<n><a/></n>", "<n><b/></n>"), {"robot / n (2): added, unmodelled"}),
    "and go with their element": (
        ('<link name="a"/>', EYE, PAIR[1]),
        ('<link name="a"/>', EYE.replace('"b"', '"head"'), PAIR[1].replace('"b"', '"head"')),
        {"link b: renamed, structural"},
    ),
}  # fmt: skip


@pytest.mark.parametrize(("old", "new", "expected"), DRIVES.values(), ids=DRIVES)
def test_drives_and_extensions(old: Sequence[str], new: Sequence[str], expected: set[str]) -> None:
    assert said(old, new) == expected


@pytest.mark.parametrize("options", [Options(driven=("wheel",)), Options(approach=("record",))])
def test_where_the_source_does_not_decide_drives_are_no_change(options: Options) -> None:
    assert said(CASTERS, (*CASTERS, WHEEL), options) == set()


def test_a_contact_is_in_the_record_and_which_numbers_it_has_in_the_model_of_a_mobile_robot() -> None:
    def foot(inner: str) -> list[str]:
        shape = '<collision><geometry><sphere radius="1"/></geometry></collision>'
        return [f'<link name="foot">{shape}</link>', f'<gazebo reference="foot">{inner}</gazebo>' if inner else ""]

    mobile = Options(base="floating")
    assert said(foot("<kp>1e5</kp>"), foot("<kp>2e5</kp>"), mobile) == {"link foot / contact / kp: changed, parameter"}
    assert said(foot(""), foot("<kp>2e5</kp>"), mobile) == {"link foot / contact: added, structural"}
    assert said(foot(""), foot("<kp>2e5</kp>")) == {"link foot / contact: added, parameter"}

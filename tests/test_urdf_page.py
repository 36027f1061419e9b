"""The page on URDF: its table has each attribute of a joint, and the effect of each element and attribute."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple, get_args

import msgspec
import pytest
from support.corpus import REPOSITORY
from support.meshes import stl
from support.modelica import URDFSYNC
from support.numbers import BOT, of_package
from support.packages import Package, generate, read

from urdfsync.domain import Target
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.model.numbers import camel
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import JOINT_KINDS, SENSOR_KINDS, STATED_ELSEWHERE, Joint, Vector, effective

INERTIA = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'
BALL = '<geometry><sphere radius="0.05"/></geometry>'
BARS = f"""<link name="p"><inertial><mass value="1"/>{INERTIA}</inertial></link>
  <link name="q"><inertial><mass value="1"/>{INERTIA}</inertial></link><link name="r"/>
  <joint name="bp" type="continuous"><parent link="base"/><child link="p"/><axis xyz="0 0 1"/></joint>
  <joint name="pq" type="continuous"><parent link="p"/><child link="q"/>
    <origin xyz="0.3 0.1 0"/><axis xyz="0 0 1"/></joint>
  <joint name="br" type="continuous"><parent link="base"/><child link="r"/>
    <origin xyz="0.5 0 0"/><axis xyz="0 0 1"/></joint>"""
LOOP_JOINT = """<loop_joint name="l" type="revolute"><link1 link="q" xyz="0.4 0.2 0"/><link2 link="r" xyz="0.2 0.3 0"/>
  <axis xyz="0 0 1"/></loop_joint>"""
BALL_CONSTRAINT = """<drake:ball_constraint xmlns:drake="http://drake.mit.edu">
  <drake:ball_constraint_body_A name="q"/><drake:ball_constraint_p_AP value="0.4 0.2 0"/>
  <drake:ball_constraint_body_B name="r"/><drake:ball_constraint_p_BQ value="0.2 0.3 0"/></drake:ball_constraint>"""
GAZEBO_JOINT = """<gazebo><joint name="l" type="revolute"><parent>q</parent><child>r</child><pose>0.2 0.3 0 0 0 0</pose>
  <axis><xyz>0 0 1</xyz></axis></joint></gazebo>"""
CLOSING_FRAMES = """<link name="closing_l_1"/><link name="closing_l_2"/>
  <joint name="f1" type="fixed"><parent link="q"/><child link="closing_l_1"/><origin xyz="0.4 0.2 0"/></joint>
  <joint name="f2" type="fixed"><parent link="r"/><child link="closing_l_2"/><origin xyz="0.2 0.3 0"/></joint>"""
ROBOT = f"""<robot name="own" version="1.2">
  <material name="blue"><color rgba="0 0 1 1"/><texture filename="a.png"/></material>
  <material name="red"><color rgba="1 0 0 1"/></material>
  <link name="base"/>
  <link name="arm">
    <inertial><origin xyz="0 0 0.1" rpy="0 0 0.2"/><mass value="2"/>
      <inertia ixx="3" ixy="0.1" ixz="0.2" iyy="4" iyz="0.3" izz="5"/></inertial>
    <visual name="tube"><origin xyz="0 0 0.3" rpy="0 0 0.4"/>
      <geometry><cylinder radius="0.1" length="1"/></geometry><material name="blue"/></visual>
    <visual><geometry><mesh filename="a.stl" scale="2 2 2"/></geometry></visual>
    <visual><geometry><capsule radius="0.2" length="1.5"/></geometry></visual>
    <visual><geometry><ellipsoid radii="4 5 6"/></geometry></visual>
    <collision name="hull"><origin quat_xyzw="0 0 0 1"/><geometry><box size="1 2 3"/></geometry></collision>
    <collision><geometry><sphere radius="0.3"/></geometry></collision>
  </link>
  <link name="hand"><inertial><mass value="1"/>{INERTIA}</inertial></link>
  <link name="tip"><collision>{BALL}</collision><inertial><mass value="1"/>{INERTIA}</inertial></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1.1" effort="10" velocity="2" acceleration="3" deceleration="4" jerk="5"/>
    <dynamics damping="0.5" friction="0.6" armature="0.03"/><calibration rising="0.7" falling="0.8"/>
    <safety_controller k_velocity="6" k_position="7" soft_lower_limit="-0.9" soft_upper_limit="0.9"/></joint>
  <joint name="grip" type="continuous"><parent link="arm"/><child link="hand"/></joint>
  <joint name="pull" type="continuous"><parent link="arm"/><child link="tip"/>
    <mimic joint="turn" multiplier="8" offset="9"/></joint>
  <link name="top"><inertial><mass value="1"/></inertial></link>
  <joint name="spin" type="continuous"><parent link="arm"/><child link="top"/></joint>
  <transmission name="t"><joint name="spin"/></transmission>
  <ros2_control name="c" type="system"><joint name="grip"><command_interface name="position"/></joint></ros2_control>
  <gazebo reference="arm"><material>Gazebo/Red</material>
    <mu1>0.5</mu1><kp>1e5</kp><kd>3</kd><minDepth>0.001</minDepth></gazebo>
  <sensor name="eye" type="camera"><parent link="arm"/></sensor>
  <frame name="f"/>
</robot>
"""
INERTIAS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
CHANGED = {
    "robot name": ('name="own"', 'name="mine"'),
    "robot version": ('version="1.2"', 'version="1.1"'),
    "link name": (r'(?s)"hand"(.*)"hand"', r'"claw"\1"claw"'),
    "inertial": (r'(?s)(<link name="hand">)<inertial>.*?</inertial>', r"\1"),
    "inertial/mass value": ('mass value="2"', 'mass value="2.5"'),
    **{f"inertial/inertia {name}": (rf'{name}="([\d.]+)"', rf'{name}="1\1"') for name in INERTIAS},
    "visual name": ('"tube"', '"pipe"'),
    "collision name": ('"hull"', '"skin"'),
    "origin xyz": ('xyz="0 0 0.1"', 'xyz="0 0 0.15"'),
    "origin rpy": ('rpy="0 0 0.2"', 'rpy="0 0 0.25"'),
    "origin quat_xyzw": ('"0 0 0 1"', '"0 0 1 0"'),
    "geometry/box size": ('"1 2 3"', '"1 2 4"'),
    "geometry/cylinder radius": ('cylinder radius="0.1"', 'cylinder radius="0.15"'),
    "geometry/cylinder length": ('length="1"', 'length="2"'),
    "geometry/capsule radius": ('capsule radius="0.2"', 'capsule radius="0.15"'),
    "geometry/capsule length": ('length="1.5"', 'length="2"'),
    "geometry/ellipsoid radii": ('"4 5 6"', '"4 5 7"'),
    "geometry/sphere radius": ('sphere radius="0.3"', 'sphere radius="0.4"'),
    "geometry/mesh filename": ("a.stl", "b.stl"),
    "geometry/mesh scale": ("2 2 2", "3 3 3"),
    "material name": ('<material name="blue"/>', '<material name="red"/>'),
    "material/color rgba": ("0 0 1 1", "0 1 1 1"),
    "material/texture filename": ("a.png", "b.png"),
    "joint name": ('"grip"', '"grasp"'),
    "joint type": ('"grip" type="continuous"', '"grip" type="fixed"'),
    "joint/parent link": ('<parent link="arm"/><child link="hand"/>', '<parent link="tip"/><child link="hand"/>'),
    "joint/child link": (r'(?s)child link="hand"/>(.*)child link="tip"/>', r'child link="tip"/>\1child link="hand"/>'),
    "axis xyz": ('<axis xyz="0 0 1"/>', '<axis xyz="0 1 0"/>'),
    "limit lower": ('lower="-1"', 'lower="-2"'),
    "limit upper": ('upper="1.1"', 'upper="2"'),
    **{f"limit {name}": (rf'{name}="(\d+)"', rf'{name}="1\1"') for name in ("effort", "velocity", "acceleration",
                                                                         "deceleration", "jerk")},
    "dynamics damping": ('damping="0.5"', 'damping="0.55"'),
    "dynamics friction": ('friction="0.6"', 'friction="0.65"'),
    "dynamics armature": ('armature="0.03"', 'armature="0.04"'),
    **{
        f"gazebo {name}": ("</robot>", f'<gazebo reference="spin"><{name}>0.4</{name}></gazebo></robot>')
        for name in ("springStiffness", "springReference")
    },
    "mimic joint": ('mimic joint="turn"', 'mimic joint="grip"'),
    "mimic multiplier": ('multiplier="8"', 'multiplier="-8"'),
    "mimic offset": ('offset="9"', 'offset="0"'),
    "calibration rising": ('rising="0.7"', 'rising="0"'),
    "calibration falling": ('falling="0.8"', 'falling="0"'),
    **{f"safety_controller {name}": (rf'{name}="(-?)([\d.]+)"', rf'{name}="\g<1>1\2"') for name in (
        "k_velocity", "k_position", "soft_lower_limit", "soft_upper_limit")},
    "transmission": ("<transmission.*</transmission>", ""),
    "ros2_control": (r'(?s)<ros2.*?</ros2_control>', ""),
    "gazebo": ("Gazebo/Red", "Gazebo/Blue"),
    **{f"gazebo {name}": (rf"<{name}>", f"<{name}>1") for name in ("mu1", "kp", "kd", "minDepth")},
    **{
        f"contact {name}": ('<link name="tip">', f'<link name="tip"><contact><{name} value="1"/></contact>')
        for name in ("lateral_friction", "stiffness", "damping")
    },
    "sensor": ('type="camera"', 'type="ray"'),
    "loop_joint": ("</robot>", f"{BARS}{LOOP_JOINT}</robot>"),
    "drake:ball_constraint": ("</robot>", f"{BARS}{BALL_CONSTRAINT}</robot>"),
    "gazebo/joint": ("</robot>", f"{BARS}{GAZEBO_JOINT}</robot>"),
    "closing_…_1, closing_…_2": ("</robot>", f"{BARS}{CLOSING_FRAMES}</robot>"),
    "robot/inertial": ("</robot>", "<inertial/></robot>"),
    "any other": ('frame name="f"', 'frame name="g"'),
}  # fmt: skip
"""Another value for rows of the table: a pattern, and its replacement. Each other row is an attribute with a number."""


def rows() -> Iterator[tuple[str, str]]:
    """Yield each element and attribute of the table, and its effect."""
    page = (REPOSITORY / "docs" / "urdf.md").read_text(encoding="utf-8")
    elements: list[str] = []
    for line in page.split("\n"):
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) == 6 and cells[3] in ("used", "read", "kept", "refused"):
            elements = re.findall(r"`([^`]+)`", cells[1]) or ([cells[1]] if cells[1] else elements)
            attributes = re.findall(r"`([^`]+)`", cells[2]) or [""]
            yield from (
                (f"{element} {attribute}".strip(), cells[3]) for element in elements for attribute in attributes
            )


ROWS = dict(rows())


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The robot with its meshes."""
    folder = tmp_path_factory.mktemp("robot")
    (folder / "a.stl").write_text(stl(1))
    (folder / "b.stl").write_text(stl(2))
    return folder


@pytest.fixture(scope="module")
def before(folder: Path) -> Package:
    return package(folder, ROBOT)


def package(folder: Path, text: str) -> Package:
    (folder / "own.urdf").write_text(text)
    return generate(folder / "own.urdf", Target("Own", "Own"), approach=("package", "record"), base="floating")


def is_used(old: Mapping[str, str], new: Mapping[str, str]) -> bool:
    """Whether models differ, or a number of a record that a model reads; names are only texts."""
    records = {path for path in old if path.endswith("Parameters.mo")}
    if {p: t for p, t in old.items() if p not in records} != {p: t for p, t in new.items() if p not in records}:
        return True
    lines = {line for path in records for line in set(old[path].split("\n")) ^ set(new[path].split("\n"))}
    numbers = {name for line in lines for name in re.findall(r"(\w+) = ", line)} - {"name"}
    library = [file for file in URDFSYNC.rglob("*.mo") if not {"Records", "Examples", "UsersGuide"} & {*file.parts}]
    models = [*(file.read_text(encoding="utf-8") for file in library), *(old[p] for p in old.keys() - records)]
    return any(re.search(rf"\.{name}\b", text) for name in numbers for text in models)


def test_each_case_has_a_row() -> None:
    assert CHANGED.keys() <= ROWS.keys()


@pytest.mark.parametrize("row", ROWS)
def test_each_row_says_what_becomes_of_it(row: str, folder: Path, before: Package) -> None:
    element, _, attribute = row.rpartition(" ")
    pattern, other = CHANGED.get(row, (f"<{element} ", f'<{element} {attribute}="0.375" '))
    text, count = re.subn(pattern, other, ROBOT, count=1)
    assert count == 1
    if DOMAIN.read(text.encode(), "own.urdf", Options()).snapshot is None:
        assert ROWS[row] == "refused"
        return
    after = package(folder, text)
    if after.texts == before.texts and after.imports == before.imports:
        assert after.robot != before.robot
        assert ROWS[row] == "kept"
    else:
        assert ROWS[row] == ("used" if is_used(before.texts, after.texts) else "read")


# The attributes of joints, each alone


class Attribute(NamedTuple):
    """An attribute of `<joint>`, or of an element inside of it."""

    element: str
    """The name of the field of `Joint`; empty for an attribute of the joint itself."""
    name: str
    value: Any
    text: str
    beside: str
    """The attributes that the element requires."""

    def __str__(self) -> str:
        return f"{self.element or 'joint'} {self.name}"

    def of(self, joint: Joint) -> Any:
        """The value in a joint; None without the element."""
        return getattr(getattr(joint, self.element) if self.element else joint, self.name, None)


def attributes() -> Iterator[Attribute]:
    """Yield each attribute that a joint may lack, but the axis."""
    for field in msgspec.structs.fields(Joint):
        struct = next(
            (part for part in (field.type, *get_args(field.type)) if hasattr(part, "__struct_fields__")), None
        )
        if not field.required and field.name not in (*STATED_ELSEWHERE, "axis"):
            fields = msgspec.structs.fields(struct) if struct else [field]
            beside = " ".join(f'{part.name}="lead"' for part in fields if part.required)
            for part in (part for part in fields if not part.required):
                kinds = (part.type, *get_args(part.type))
                value = "P-7" if str in kinds else (0.375, 0.25, 0.5) if Vector in kinds else 0.375
                text = " ".join(map(str, value)) if isinstance(value, tuple) else str(value)
                with_limits = {"lower": 'upper="1"', "upper": 'lower="0"'}.get(part.name, beside)
                yield Attribute(field.name if struct else "", part.name, value, text, with_limits)


def declared(record: str, path: str) -> str:
    """The type of a component in a record of the library; empty without one."""
    name, _, inside = path.partition(".")
    file, _, nested = record.removeprefix("UrdfSync.Records.").partition(".")
    text = (URDFSYNC / "Records" / f"{file}.mo").read_text("utf-8")
    text = text.partition(f"record {nested} ")[2].partition(f"end {nested};")[0] if nested else text
    if found := re.search(rf"^ *(?:parameter )?([\w.]+) {name}\b", text, re.MULTILINE):
        return declared(found[1], inside) if inside else found[1]
    bases = re.findall(r"extends (UrdfSync\.Records\.\w+)", text)
    return next(filter(None, (declared(base, path) for base in bases)), "")


@pytest.mark.parametrize("attribute", list(attributes()), ids=str)
def test_an_attribute_of_a_joint_is_read_recorded_compared_declared_and_described(attribute: Attribute) -> None:
    """For each type of joint on which it has an effect."""
    assert str(attribute) in ROWS
    acting = []
    for kind in JOINT_KINDS:
        words = f'{attribute.beside} {attribute.name}="{attribute.text}"'
        around, inside = ("", f"<{attribute.element} {words}/>") if attribute.element else (words, "")
        ends = '<parent link="{}"/><child link="{}"/>'
        content = f"""<robot name="own" version="1.2"><link name="base"/><link name="arm"/><link name="hand"/>
          <joint name="lead" type="continuous">{ends.format("base", "arm")}</joint>
          <joint name="elbow" type="{kind}" {around}>{ends.format("base", "hand")}{inside}</joint></robot>"""
        if read(content.encode()).snapshot is None:  # only joints with one position follow another one
            continue
        package = generate(content.encode(), BOT)
        (joint,) = (joint for joint in package.robot.joints if joint.name == "elbow")
        assert attribute.of(joint) == attribute.value
        if attribute.of(effective(joint)) != attribute.value:
            continue
        numbers = of_package(package, content.encode(), package.texts)
        assert (numbers.differences, numbers.uncompared) == ((), ())
        file = "Joints/ElbowParameters.mo"
        record = package.texts[file]
        places = list(re.finditer(r"\b0\.375\b|\bP-7\b", record))
        assert places
        for place in places:
            other = f"{record[: place.start()]}{'P-8' if place[0] == 'P-7' else '0.625'}{record[place.end() :]}"
            (change,) = of_package(package, content.encode(), {**package.texts, file: other}).differences
            assert change.quantity.rpartition(".")[2] in (attribute.name, camel(attribute.name))
            assert declared(f"{kind.capitalize()}Joint", change.quantity)
        acting.append(kind)
    assert acting


def test_the_table_of_sensors_has_each_name_and_each_output() -> None:
    section = (REPOSITORY / "docs" / "urdf.md").read_text(encoding="utf-8").partition("\n## Sensors\n")[2]
    table = [line for line in section.partition("\n- ")[0].split("\n") if line.startswith("| ")]
    for kind, model in SENSOR_KINDS.items():
        rows = [line for line in table if all(re.search(rf'[`"]{name}[`"]', line) for name in (kind, *model.types))]
        assert any(all(f"_{output.name}`" in row for output in model.outputs) for row in rows), kind

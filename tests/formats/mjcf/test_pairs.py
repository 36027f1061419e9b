"""One robot in two formats: what differs in its motion is told, and edits follow a source that changes its format."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from support.commands import Execute
from support.mjcfs import ARM

SOURCES = {
    "arm.xml": ARM,
    "arm.urdf": """\
<robot name="other" version="1.2">
  <link name="base_link"/>
  <joint name="shoulder_joint" type="revolute"><parent link="base_link"/><child link="upper_link"/>
    <origin xyz="0 0.1 0.5" rpy="0 0 1.5707963"/><axis xyz="1 0 0"/>
    <limit lower="-1.5708" upper="1.5708"/><dynamics damping="2"/></joint>
  <link name="upper_link"><visual><geometry><sphere radius="0.1"/></geometry></visual>
    <inertial><origin xyz="-0.1 0 0.2"/><mass value="1.5"/>
      <inertia ixx="0.02" iyy="0.02" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="elbow_mount" type="fixed"><parent link="upper_link"/><child link="elbow_base"/>
    <origin xyz="-0.1 0 0.4"/></joint>
  <link name="elbow_base"/>
  <joint name="elbow_joint" type="continuous"><parent link="elbow_base"/><child link="fore_link"/>
    <origin rpy="0 0 -1.0471976"/><axis xyz="0 1 0"/>
    <dynamics spring_stiffness="4"/></joint>
  <transmission name="t"><joint name="elbow_joint"/><actuator name="m"><mechanicalReduction>100</mechanicalReduction>
    <drake:rotor_inertia xmlns:drake="d" value="1e-5"/></actuator></transmission>
  <transmission name="s"><joint name="shoulder_joint"/></transmission>
  <link name="fore_link"><inertial><mass value="3"/><origin rpy="0 0 1.5707963"/>
    <inertia ixx="0.1" iyy="0.13" izz="0.05" ixy="0" ixz="0" iyz="0"/></inertial></link>
</robot>
""",
}
"""The same arm with other names and frames: a frame is turned, and moved along its axis."""


@pytest.fixture
def pair(folder: Path) -> Path:
    """Both sources, side by side."""
    for name, text in SOURCES.items():
        Path(name).write_text(text)
    return folder


def edit(file: str, old: str, new: str) -> None:
    text = Path(file).read_text()
    assert old in text
    Path(file).write_text(text.replace(old, new))


def changed(execute: Execute, *sources: str) -> list[str]:
    """Return the changes of numbers in the order of the terminal; without names and effects."""
    lines = execute("diff", *sources, code=1).out.partition("\nEffects")[0].split("\n")
    return [line.strip() for line in lines[1:] if line and "renamed" not in line and "is now" not in line]


@pytest.mark.slow
def test_other_names_frames_and_shapes_make_no_difference_in_motion(pair: Path, execute: Execute) -> None:
    assert changed(execute, "arm.urdf", "arm.xml") == []
    assert changed(execute, "arm.xml", "arm.urdf") == []


def test_two_equal_sources_do_not_differ(pair: Path, execute: Execute) -> None:
    Path("same.urdf").write_text(SOURCES["arm.urdf"].replace('sphere radius="0.1"', 'box size="1 2 3"'))
    assert execute("diff", "arm.urdf", "same.urdf").lines == ["same.urdf: no difference in motion against arm.urdf"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('mass="1.5"', 'mass="1.75"', ["link upper: inertial / mass 1.5 → 1.75 kg (+16.7 %)"]),
        ('armature="0.1"', 'armature="0.2"', ["joint elbow: dynamics / armature 0.1 → 0.2 kg·m² (+100 %)"]),
        ('stiffness="4"', 'stiffness="5"', ["joint elbow: dynamics / spring_stiffness 4 → 5 N·m/rad (+25 %)"]),
        ("-90 90", "-90 60", ["joint shoulder: limit / upper 1.5708 → 1.0472 rad (90.0002° → 60°)"]),
        ('pos="0 0 0.4"', 'pos="0 0 0.45"', ["joint elbow: origin / xyz[2] 0.4 → 0.45 m (+12.5 %)"]),
        ('pos="0 0 0.2" mass', 'pos="0 0 0.3" mass', ["link upper: inertial / origin / xyz[2] 0.2 → 0.3 m (+50 %)"]),
        ('joint name="elbow" axis="0 1 0"', 'joint name="elbow" axis="0 -1 0"', ["joint elbow: axis[1] 1 → -1"]),
        (
            'mass="3"',
            'mass="3.3"',
            [
                "link fore: inertial / inertia / ixx 0.13 → 0.143 kg·m² (+10 %)",
                "link fore: inertial / inertia / iyy 0.1 → 0.11 kg·m² (+10 %)",
                "link fore: inertial / inertia / izz 0.05 → 0.055 kg·m² (+10 %)",
                "link fore: inertial / mass 3 → 3.3 kg (+10 %)",
            ],
        ),
        (
            "</mujoco>",
            '<actuator><position joint="elbow" kp="5"/><position joint="shoulder" kp="5"/></actuator></mujoco>',
            [],
        ),
        ('damping="2"', "", ["joint shoulder: dynamics removed: damping 2, friction 0"]),
    ],
)
def test_each_difference_in_motion_is_told(pair: Path, execute: Execute, old: str, new: str, words: list[str]) -> None:
    edit("arm.xml", old, new)
    assert changed(execute, "arm.urdf", "arm.xml") == words


@pytest.mark.slow
def test_a_source_of_a_robot_may_be_one_of_two(pair: Path, execute: Execute) -> None:
    execute("init", "arm.urdf")
    edit("arm.xml", 'mass="1.5"', 'mass="1.75"')
    assert changed(execute, "arm.xml", "arm.urdf") == ["link upper_link: inertial / mass 1.75 → 1.5 kg (-14.3 %)"]


@pytest.mark.slow
@pytest.mark.parametrize(("first", "second"), [("arm.urdf", "arm.xml"), ("arm.xml", "arm.urdf")])
def test_edits_follow_a_source_that_changes_its_format(pair: Path, execute: Execute, first: str, second: str) -> None:
    execute("init", first)
    execute("build")
    links, joints = Path("modelica/Arm/Links"), Path("modelica/Arm/Joints")
    (upper,) = links.glob("Upper*Parameters.mo")
    elbow = joints / ("Elbow.mo" if first == "arm.xml" else "Elbow_joint.mo")
    edit(str(upper), "mass = 1.5", "mass = 1.625")
    edit(str(elbow), "equation\n", "  parameter Real mine = 1;\n\nequation\n")
    edit("urdfsync.toml", first, second)
    printed = execute("build", code=None)
    assert not re.search("error|conflict", printed.out + printed.err), printed.out + printed.err
    (upper,) = links.glob("Upper*Parameters.mo")
    assert "mass = 1.625" in upper.read_text()
    assert [file.stem for file in joints.glob("*.mo") if "mine = 1" in file.read_text()] == (
        ["Elbow"] if second == "arm.xml" else ["Elbow_joint"]
    )


LEGS = {"FL": ("leg1", 0.2, 0.1), "FR": ("leg2", 0.2, -0.1), "RL": ("leg3", -0.2, 0.1), "RR": ("leg0", -0.2, -0.1)}
"""Names of a leg in both formats, and the place of its hip."""
CAMERA = (
    '<body name="camera"><joint name="pan"/><inertial pos="0 0 0" mass="0.2" diaginertia="0.001 0.002 0.003"/></body>'
)


def dog_urdf() -> str:
    """A trunk with four equal legs, and equal knees in them."""
    limits = '<limit lower="-2" upper="-0.1" effort="20" velocity="10"/>'
    bodies = {"thigh": ("1", "0.01", "0.002"), "calf": ("0.3", "0.001", "0.0002")}
    parts = [f'<link name="trunk"><inertial><mass value="5"/>{inertia("0.02", "0.04")}</inertial></link>']
    for leg, (_, x, y) in LEGS.items():
        for part, (mass, *moments) in bodies.items():
            inertial = f'<origin xyz="0 0 -0.1"/><mass value="{mass}"/>{inertia(*moments)}'
            parts.append(f'<link name="{leg}_{part}"><inertial>{inertial}</inertial></link>')
        for name, parent, child, place in (
            ("hip", "trunk", f"{leg}_thigh", f"{x} {y} 0"),
            ("knee", f"{leg}_thigh", f"{leg}_calf", "0 0 -0.2"),
        ):
            ends = f'<parent link="{parent}"/><child link="{child}"/><origin xyz="{place}"/><axis xyz="0 1 0"/>'
            parts.append(f'<joint name="{leg}_{name}" type="revolute">{ends}{limits}</joint>')
    return f'<robot name="dog" version="1.2">{"".join(parts)}</robot>'


def inertia(across: str, along: str) -> str:
    return f'<inertia ixx="{across}" iyy="{across}" izz="{along}" ixy="0" ixz="0" iyz="0"/>'


def dog_mjcf(*, without_calf: str = "") -> str:
    """The same dog with other names, and in another order; a camera is in the place of the calf of one leg."""
    bodies = []
    for leg, x, y in sorted(LEGS.values()):
        hinge = 'axis="0 1 0" range="-2 -0.1" actuatorfrcrange="-20 20"'
        calf = (
            f'<body name="{leg}_lower" pos="0 0 -0.2"><joint name="{leg}_q2" {hinge}/>'
            '<inertial pos="0 0 -0.1" mass="0.3" diaginertia="0.001 0.001 0.0002"/></body>'
        )
        bodies.append(
            f'<body name="{leg}_upper" pos="{x} {y} 0"><joint name="{leg}_q1" {hinge}/>'
            '<inertial pos="0 0 -0.1" mass="1" diaginertia="0.01 0.01 0.002"/>'
            f"{CAMERA if leg == without_calf else calf}</body>"
        )
    trunk = '<inertial pos="0 0 0" mass="5" diaginertia="0.02 0.02 0.04"/>'
    return (
        '<mujoco model="dog"><compiler angle="radian"/><worldbody>'
        f'<body name="base">{trunk}{"".join(bodies)}</body></worldbody></mujoco>'
    )


def renamed(execute: Execute) -> dict[str, str]:
    """Return the new names of all elements."""
    (found,) = execute("diff", "--format=json", "dog.urdf", "dog.xml", code=1).json["results"]
    changes = found["changes"]["changes"]
    return {each["path"][0].partition(" ")[2]: each["new"] for each in changes if each["kind"] == "renamed"}


@pytest.mark.slow
def test_equal_legs_match_in_another_format(folder: Path, execute: Execute) -> None:
    """Their places on the trunk tell them apart, and an edit of a knee follows its leg."""
    Path("dog.urdf").write_text(dog_urdf())
    Path("dog.xml").write_text(dog_mjcf())
    new_parts = {"thigh": "upper", "calf": "lower", "hip": "q1", "knee": "q2"}
    names = {f"{old}_{part}": f"{new}_{to}" for old, (new, *_) in LEGS.items() for part, to in new_parts.items()}
    assert renamed(execute) == {"trunk": "base", **names}
    execute("init", "dog.urdf")
    execute("build")
    edit("modelica/Dog/Joints/FR_knee.mo", "equation\n", "  parameter Real mine = 1;\n\nequation\n")
    edit("urdfsync.toml", "dog.urdf", "dog.xml")
    execute("build", code=None)
    assert "mine = 1" in Path("modelica/Dog/Joints/Leg2_q2.mo").read_text()


def test_a_new_part_is_not_the_removed_part_at_its_place(folder: Path, execute: Execute) -> None:
    """The rest of the dog matches, so the camera is no calf."""
    Path("dog.urdf").write_text(dog_urdf())
    Path("dog.xml").write_text(dog_mjcf(without_calf="leg2"))
    names = renamed(execute)
    assert len(names) == 15
    assert not {"FR_calf", "FR_knee"} & {*names}


def with_tool(tool: str, place: str, friction: str, motor: str) -> str:
    """An MJCF of a floating arm, whose names of the tool, place of the tool, friction and kind of motor may differ."""
    inertial = '<inertial pos="0 0 0" mass="2" diaginertia="0.1 0.1 0.1"/>'
    arm = f'<body name="arm"><joint name="j"/>{inertial}<site name="{tool}" pos="0 0 {place}"/></body>'
    trunk = f'<freejoint/><inertial pos="0 0 0" mass="5" diaginertia="1 1 1"/><geom size="0.1" friction="{friction}"/>'
    robot = f'<worldbody><body name="trunk">{trunk}{arm}</body></worldbody>'
    return f'<mujoco model="arm">{robot}<actuator><{motor} joint="j"/></actuator></mujoco>'


@pytest.mark.slow
def test_frames_contacts_and_commands_make_no_difference_in_motion(pair: Path, execute: Execute) -> None:
    Path("arm.xml").write_text(with_tool("tool", "0.3", "0.7", "motor"))
    Path("other.xml").write_text(with_tool("tcp", "0.295", "0.6", "position"))
    assert "other.xml: no difference in motion against arm.xml" in execute("diff", "arm.xml", "other.xml").lines


@pytest.mark.slow
def test_a_frame_without_mass_counts_if_the_other_source_has_a_mass_there(pair: Path, execute: Execute) -> None:
    text = with_tool("tool", "0.3", "0.7", "motor")
    Path("arm.xml").write_text(text)
    inertial = '<inertial pos="0 0 0" mass="0.2" diaginertia="0.001 0.001 0.001"/>'
    site = '<site name="tool" pos="0 0 0.3"/>'
    Path("other.xml").write_text(text.replace(site, f'<body name="tool" pos="0 0 0.3">{inertial}</body>'))
    (line,) = [line for line in changed(execute, "arm.xml", "other.xml") if "free-root" not in line]
    assert line.startswith("link tool: inertial added: ")

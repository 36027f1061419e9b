"""The numbers of packages, and the first reading, against the second one: real robots agree, each fault is found."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
import trimesh
from msgspec.structs import replace
from support import corpus
from support.cases import sampled
from support.loops import HINGE, UNIVERSAL, WELD, to_options, to_urdf
from support.numbers import BOT, compare, differences, of_package
from support.packages import Package, generate, generate_robot, proposed_base, read
from support.urdfs import every_number, joint, limit, link, mimic
from support.urdfs import robot as urdf

from urdfsync.formats.urdf.model.numbers import camel
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import Box, Joint, Link, Loop, Origin, Robot, Servo
from urdfsync.project import config

UNCOMPARED = {f"{kind}.{path}" for kind in ("visual", "collision") for path in ("lower", "upper", "color", "opacity")}
UNCOMPARED |= {"reach", "start", "height", "collisionCorners", "translations", "rotations", "childRotations"}
"""What only the files of meshes have, and what follows from other numbers: of loops, of the stance."""


def uncompared(sentences: tuple[str, ...]) -> set[str]:
    return {sentence.partition(" of records")[0] for sentence in sentences if " of records" in sentence}


ROBOTS = config.load(corpus.REPOSITORY / "urdfsync.toml").robots


@pytest.mark.parametrize("example", ROBOTS, ids=lambda example: example.name)
def test_shipped_examples_agree(example: Any) -> None:
    options = msgspec.structs.asdict(example.options) | {"approach": ("package", "record")}
    numbers = compare(example.source, **options)
    assert numbers.differences == ()
    assert uncompared(numbers.uncompared) <= UNCOMPARED
    left = sum(
        int(sentence.rpartition("(")[2].split()[0]) for sentence in numbers.uncompared if " of records" in sentence
    )
    assert numbers.right == numbers.total - left
    assert numbers.right > 400


def test_the_menagerie_agrees() -> None:
    assert differences(corpus.REPOSITORY / "tests/golden/menagerie.urdf") == []


@pytest.mark.parametrize(
    "shape",
    [
        'box size="0.1 0.2 0.3"',
        'sphere radius="0.2"',
        'cylinder radius="0.1" length="0.5"',
        'capsule radius="0.1" length="0.5"',
        'ellipsoid radii="0.1 0.2 0.3"',
    ],
)
def test_numbers_of_each_shape_agree(shape: str) -> None:
    geometry = f'<origin xyz="1 2 3" rpy="0.4 0.5 0.6"/><geometry><{shape}/></geometry>'
    shapes = f"<visual>{geometry}</visual><collision>{geometry}</collision>"
    text = urdf(link("base", 1.0).replace("</link>", f"{shapes}</link>"))
    assert compare(text.encode(), base="floating", approach=("package", "record")).differences == ()


@pytest.mark.parametrize("file", sampled(corpus.robots(), 4))
def test_real_robots_agree(file: str, corpus: Path) -> None:
    content = (corpus / file).read_bytes()
    if read(content).snapshot is None:
        return
    numbers = compare(corpus / file, base=proposed_base(content))
    assert numbers.differences == ()
    assert uncompared(numbers.uncompared) <= UNCOMPARED
    assert numbers.total > 10


# Each fault is what a wrong reader would read, or a number that a wrong template would write

BOX = '<geometry><box size="0.1 0.2 0.3"/></geometry>'
RED = '<material name="red"><color rgba="1 0.5 0.25 0.75"/></material>'
MESH = '<visual><geometry><mesh filename="cube.stl" scale="0.5 0.7 1"/></geometry></visual>'
SHAPES = f'<visual>{BOX}{RED}</visual><collision><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>{BOX}</collision>{MESH}'
SHAPES += MESH.replace("visual", "collision")
LAW = "".join(f'<param name="{name}">{k + 0.5}</param>' for k, name in enumerate(Servo.__struct_fields__, 1))
CONTROL = (
    f'<ros2_control name="c"><joint name="slide"><command_interface name="velocity">{LAW}</command_interface>'
    '<state_interface name="position"><param name="initial_value">0.2</param></state_interface></joint></ros2_control>'
)
GEAR = (
    '<transmission name="t"><joint name="shoulder"><offset>0.1</offset></joint>'
    "<actuator><mechanicalReduction>50</mechanicalReduction></actuator></transmission>"
)
GROUND = '<gazebo reference="arm"><mu1>0.8</mu1><mu2>0.3</mu2><kp>1000</kp><kd>20</kd></gazebo>'
IMU = '<gazebo reference="hand"><sensor name="imu" type="imu"><pose>1 2 3 0.1 0.2 0.3</pose></sensor></gazebo>'
WRENCH = '<gazebo reference="shoulder"><sensor name="force" type="force_torque"/></gazebo>'
PULL = (
    '<gazebo reference="slide"><springStiffness>90</springStiffness><springReference value="0.2"/>'
    "<implicitSpringDamper>1</implicitSpringDamper></gazebo>"
)
SAFE = '<safety_controller k_velocity="5" k_position="6" soft_lower_limit="-0.5" soft_upper_limit="0.4"/>'
URDF = urdf(
    *(link("base", 3.0), link("arm", 2.0).replace("</link>", f"{SHAPES}</link>"), link("hand", 0.7), link("tip", 0.1)),
    joint("shoulder", "revolute", "base", "arm", axis="0 1 0",
          inside=[every_number(0.5, 0.2, armature=0.01, spring_stiffness=7.5, spring_reference=0.3),
                  limit(-1, 2, 3, 40), SAFE, '<calibration rising="0.3"/>']),
    joint("slide", "prismatic", "arm", "hand", axis="1 2 2", inside=[limit(0, 0.5, 0.6, 70)]),
    joint("twist", "revolute", "hand", "tip", axis="0 0 1", inside=[limit(-2, 3), mimic("shoulder", 0.5, 0.1)]),
    *(CONTROL, GEAR, GROUND, IMU, WRENCH, PULL),
)  # fmt: skip


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Package:
    """The package of the robot above, floating so that it touches the ground."""
    folder = tmp_path_factory.mktemp("sound")
    trimesh.creation.box(np.ones(3)).export(folder / "cube.stl")
    (folder / "a.urdf").write_text(URDF)
    return generate(folder / "a.urdf", BOT, base="floating", approach=("package", "record"))


def test_a_sound_package_agrees(sound: Package) -> None:
    numbers = of_package(sound, URDF.encode(), sound.texts)
    assert numbers.differences == ()
    ends = {f"{kind}.{end}" for kind in ("visual", "collision") for end in ("lower", "upper")}
    assert uncompared(numbers.uncompared) == {*ends, "visual.color", "visual.opacity", "height", "collisionCorners"}
    assert "the tables in the record of the whole robot, except by their motion with `--physics`" in numbers.uncompared


def of(kind: str, name: str, /, **parts: Any) -> Callable[[Robot], Robot]:
    """Return what reads parts of an element otherwise; a function makes a part from the element."""

    def wrong(each: Any) -> Any:
        if each.name != name:
            return each
        return replace(each, **{key: part(each) if callable(part) else part for key, part in parts.items()})

    return lambda robot: replace(robot, **{kind: tuple(map(wrong, getattr(robot, kind)))})


def limits(**parts: Any) -> Callable[[Joint], Any]:
    return lambda own: (
        own.limit and replace(own.limit, **{key: getattr(own.limit, part) for key, part in parts.items()})
    )


def inertial(**parts: Any) -> Callable[[Link], Any]:
    return lambda own: own.inertial and replace(own.inertial, **parts)


def tensor(own: Link) -> Any:
    assert own.inertial is not None
    inertia = own.inertial.inertia
    return replace(own.inertial, inertia=replace(inertia, ixy=inertia.ixz, ixz=inertia.ixy))


def shape(kind: str, number: int, **parts: Any) -> Callable[[Link], Any]:
    def wrong(own: Link) -> Any:
        every = list(getattr(own, kind))
        every[number] = replace(every[number], **parts)
        return tuple(every)

    return wrong


READER: dict[str, tuple[Callable[[Robot], Robot], str, str]] = {
    "limits exchanged in sign": (
        of("joints", "shoulder", limit=lambda j: replace(j.limit, lower=-2.0, upper=1.0)),
        "Joints/ShoulderParameters.mo", "limits.lower"),
    "an effort read as the velocity's": (
        of("joints", "slide", limit=limits(velocity="effort")), "Joints/SlideParameters.mo", "limits.velocity"),
    "efforts and velocities exchanged": (
        of("joints", "slide", limit=limits(velocity="effort", effort="velocity")), "Joints/SlideParameters.mo",
        "limits.effort"),
    "a velocity interface read as position": (
        of("joints", "slide", command=None), "Joints/SlideParameters.mo", "command"),
    "an effort interface that is none": (
        of("joints", "shoulder", command="effort"), "Joints/ShoulderParameters.mo", "command"),
    "a start with the other sign": (of("joints", "slide", start=-0.2), "BotStart.mo", "start"),
    "a gain read as another": (
        of("joints", "slide", servo=lambda j: replace(j.servo, position_gain=2.5)), "Joints/SlideParameters.mo",
        "servo.positionGain"),
    "a law that is none": (
        of("joints", "slide", servo=None), "Joints/SlideParameters.mo", "servo.maxEffort"),
    "no start": (of("joints", "slide", start=None), "BotStart.mo", "start"),
    "kd read as kp": (of("links", "arm", contact=lambda own: replace(own.contact, kp=20.0)), "Links/ArmParameters.mo",
                      "contact.kp"),
    "mu2 as mu1": (of("links", "arm", contact=lambda own: replace(own.contact, mu=0.3)), "Links/ArmParameters.mo",
                   "contact.mu"),
    "a collision's rpy in another order": (
        of("links", "arm", collisions=shape("collisions", 0, origin=Origin((1.0, 2.0, 3.0), (0.3, 0.2, 0.1)))),
        "Links/ArmParameters.mo", "collision1.origin.rpy"),
    "a box's sides exchanged": (
        of("links", "arm", visuals=shape("visuals", 0, geometry=Box((0.2, 0.1, 0.3)))), "Links/ArmParameters.mo",
        "visual1.size"),
    "an axis that is not unit": (of("joints", "slide", axis=(1.0, 2.0, 2.0)), "Joints/SlideParameters.mo", "axis"),
    "an axis turned around": (of("joints", "shoulder", axis=(0.0, -1.0, 0.0)), "Joints/ShoulderParameters.mo", "axis"),
    "an origin of the joint in degrees": (
        of("joints", "shoulder", origin=Origin((0.1, -0.2, 0.3), (28.6, -34.4, 40.1))), "Joints/ShoulderParameters.mo",
        "origin.rpy"),
    "products of inertia exchanged": (of("links", "hand", inertial=tensor), "Links/HandParameters.mo",
                                      "inertial.inertia.ixy"),
    "a mass in g": (of("links", "hand", inertial=inertial(mass=700.0)), "Links/HandParameters.mo", "inertial.mass"),
    "a centre of mass left out": (of("links", "hand", inertial=inertial(origin=Origin())), "Links/HandParameters.mo",
                                  "inertial.origin.xyz"),
    "no inertial": (of("links", "tip", inertial=None), "Links/TipParameters.mo", "inertial.mass"),
    "a reduction upside down": (
        of("joints", "shoulder", transmission=lambda j: replace(j.transmission, reduction=0.02)),
        "Joints/ShoulderParameters.mo", "transmission.reduction"),
    "an offset of the gear left out": (
        of("joints", "shoulder", transmission=lambda j: replace(j.transmission, offset=0.0)),
        "Joints/ShoulderParameters.mo", "transmission.offset"),
    "a multiplier upside down": (
        of("joints", "twist", mimic=lambda j: replace(j.mimic, multiplier=2.0)), "Joints/TwistParameters.mo",
        "mimic.multiplier"),
    "an offset with the other sign": (
        of("joints", "twist", mimic=lambda j: replace(j.mimic, offset=-0.1)), "Joints/TwistParameters.mo",
        "mimic.offset"),
    "another leader": (
        of("joints", "twist", mimic=lambda j: replace(j.mimic, joint="slide")), "Joints/TwistParameters.mo", "leader"),
    "another parent": (of("joints", "twist", parent="arm"), "Joints/TwistParameters.mo", "parent"),
    "a drive that is none": (of("joints", "shoulder", actuated=None), "Joints/ShoulderParameters.mo", "drive"),
    "damping and friction exchanged": (
        of("joints", "shoulder", dynamics=lambda j: replace(j.dynamics, damping=0.2, friction=0.5)),
        "Joints/ShoulderParameters.mo", "dynamics.damping"),
    "an armature left out": (
        of("joints", "shoulder", dynamics=lambda j: replace(j.dynamics, armature=None)),
        "Joints/ShoulderParameters.mo", "dynamics.armature"),
    "soft limits exchanged": (
        of("joints", "shoulder", safety_controller=lambda j: replace(j.safety_controller, soft_lower_limit=0.4)),
        "Joints/ShoulderParameters.mo", "safetyController.soft_lower_limit"),
    "a rising edge as a falling one": (
        of("joints", "shoulder", calibration=lambda j: replace(j.calibration, rising=None, falling=0.3)),
        "Joints/ShoulderParameters.mo", "calibration.rising"),
    "a continuous joint for a revolute one": (of("joints", "shoulder", type="continuous"),
                                              "Joints/ShoulderParameters.mo", "type"),
    "a sensor's pose left out": (of("sensors", "imu", origin=Origin()), "BotSensors.mo", "origin.xyz"),
    "a sensor on another link": (of("sensors", "imu", at="arm"), "BotSensors.mo", "at"),
    "a sensor of another kind": (of("sensors", "imu", kind="gyroscope"), "BotSensors.mo", "kind"),
    "a wrench in the other axes": (of("sensors", "force", in_parent=True), "BotSensors.mo", "axes"),
    "a wrench in the other direction": (of("sensors", "force", on_child=True), "BotSensors.mo", "axes"),
    "a colour with red and blue exchanged": (
        of("links", "arm", visuals=lambda own: (replace(own.visuals[0], material=replace(
            own.visuals[0].material, rgba=(0.25, 0.5, 1.0, 0.75))), *own.visuals[1:])),
        "Links/ArmParameters.mo", "visual1.color"),
}  # fmt: skip
"""The robot as it is read, with the file and the quantity that differ."""


def as_read(sound: Package, wrong: Callable[[Robot], Robot], **options: Any) -> Package:
    """The package that a wrong reader makes of the robot."""
    mesh = sound.robot
    package = generate_robot(wrong(mesh), BOT, base="floating", approach=("package", "record"), **options)
    return dataclasses.replace(package, facts=sound.facts)


def test_shapes_are_compared_by_their_lasting_numbers(sound: Package) -> None:
    shapes = {"visuals": lambda own: renumbered(own.visuals), "collisions": lambda own: renumbered(own.collisions)}
    package = as_read(dataclasses.replace(sound, facts={}), of("links", "arm", **shapes))
    assert any(" visual7(" in text for text in package.texts.values())
    assert not of_package(package, URDF.encode(), package.texts).differences


def renumbered(shapes: Sequence[Any]) -> tuple[Any, ...]:
    return tuple(replace(shape, number=7 - place) for place, shape in enumerate(shapes))


@pytest.mark.parametrize("fault", READER)
def test_what_a_reader_misreads_is_found(fault: str, sound: Package) -> None:
    wrong, file, quantity = READER[fault]
    meshless = dataclasses.replace(sound, facts={})
    package = as_read(meshless, wrong)
    numbers = of_package(package, URDF.encode(), package.texts)
    found = {(each.file, each.quantity): each for each in numbers.differences}
    assert (file, quantity) in found, found
    assert numbers.right < numbers.total
    each = found[file, quantity]
    assert each.expected != each.given
    assert each.line > 0 or each.given == "nothing"
    assert each.source_line > 0


def test_a_scale_in_the_spelling_of_sdf_agrees(sound: Package) -> None:
    source, count = re.subn(r' scale="([^"]*)"/>', r"><scale>\1</scale></mesh>", URDF)
    assert count == 2
    assert of_package(sound, source.encode(), sound.texts).differences == ()


def test_a_scale_with_x_and_y_exchanged_is_found(sound: Package) -> None:
    """Its files in the package are others."""
    facts = {key.replace("0.5 0.7", "0.7 0.5"): file for key, file in sound.facts.items()}
    numbers = of_package(dataclasses.replace(sound, facts=facts), URDF.encode(), sound.texts)
    assert {each.quantity for each in numbers.differences} == {"visual2.uri", "collision2.uri"}


RECORDS = {
    "a shape of another kind": (
        "Links/ArmParameters.mo", "Records.Box visual1", "Records.Sphere visual1", "visual1.shape"),
    "two fields of a record exchanged": ("Joints/ShoulderParameters.mo", "damping = 0.5", "damping = 0.2",
                                         "dynamics.damping"),
    "a name of another element": ("Links/HandParameters.mo", 'name = "hand"', 'name = "arm"', "inertial.mass"),
    "an expression": ("Joints/SlideParameters.mo", "upper = 0.5", "upper = 2*x", "limits.upper"),
    "two numbers of three": ("Joints/SlideParameters.mo", "rpy = {0.5, -0.6, 0.7}", "rpy = {0.5}", "origin.rpy"),
}  # fmt: skip
"""A text of a record, what a template or a user would write in it otherwise, and the quantity that differs."""


@pytest.mark.parametrize("fault", RECORDS)
def test_a_wrong_number_in_a_record_is_found(fault: str, sound: Package) -> None:
    file, old, new, quantity = RECORDS[fault]
    assert old in sound.texts[file]
    texts = {**sound.texts, file: sound.texts[file].replace(old, new)}
    numbers = of_package(sound, URDF.encode(), texts)
    assert (file, quantity) in {(each.file, each.quantity) for each in numbers.differences}


@pytest.mark.parametrize(("written", "given"), [
    ("0.5 /* weighed 3 March */", []), ("0.6 /* weighed 3 March */", ["0.6"]),
    ("2 /* weighed 3 March */ * x", ["2 /* weighed 3 March */ * x"]),
])  # fmt: skip
def test_a_comment_is_no_part_of_a_number(written: str, given: list[str], sound: Package) -> None:
    file = "Joints/SlideParameters.mo"
    texts = {**sound.texts, file: sound.texts[file].replace("upper = 0.5", f"upper = {written}")}
    assert [each.given for each in of_package(sound, URDF.encode(), texts).differences] == given


NUMBER = re.compile(r"(?<=[ ={,])-?\d+(?:\.\d+)?(?:e-?\d+)?(?=[,)};\n])")


@pytest.mark.slow
@pytest.mark.parametrize("file", ["Joints/Shoulder", "Joints/Slide", "Joints/Twist", "Links/Hand"])
def test_each_number_of_a_record_is_compared(file: str, sound: Package) -> None:
    """One number after the other is another one: so a new number is compared, too."""
    path, same = f"{file}Parameters.mo", list[str]()
    text, content = sound.texts[path], URDF.encode()
    for number in NUMBER.finditer(text):
        line = text[text.rfind("\n", 0, number.start()) + 1 : text.find("\n", number.end())]
        other = text[: number.start()] + f"{float(number[0]) + 1!r}" + text[number.end() :]
        if not of_package(sound, content, {**sound.texts, path: other}).differences:
            same.append(line.strip())
    assert same == []
    assert not path.startswith("Joints/Sl") or all(f"{camel(name)} = " in text for name in Servo.__struct_fields__)


# Loops, and options


FOUR_BAR = next(robot for robot in ROBOTS if robot.name == "four_bar")
LOOP_FAULTS: dict[str, tuple[Callable[[Loop], Loop], str, str]] = {
    "a frame 5 cm off": (
        lambda loop: replace(loop, origin=Origin((0.55, 0.0, -0.025))), "Joints/Rocker_pinParameters.mo", "origin.xyz"),
    "another kind": (lambda loop: replace(loop, kind="ball"), "Joints/Rocker_pinParameters.mo", "kind"),
    "frames exchanged": (
        lambda loop: replace(loop, parent=loop.child, child=loop.parent, origin=loop.child_origin,
                             child_origin=loop.origin), "Joints/Rocker_pinParameters.mo", "parent"),
}  # fmt: skip


@pytest.mark.parametrize("fault", LOOP_FAULTS)
def test_a_loop_that_is_read_otherwise_is_found(fault: str) -> None:
    wrong, file, quantity = LOOP_FAULTS[fault]
    content, options = FOUR_BAR.source.read_bytes(), FOUR_BAR.options
    own = generate(content, BOT, **msgspec.structs.asdict(options))
    changed = replace(own.robot, loops=tuple(map(wrong, own.robot.loops)))
    package = generate_robot(changed, BOT, **msgspec.structs.asdict(options))
    found = of_package(package, content, package.texts).differences
    assert (file, quantity) in {(each.file, each.quantity) for each in found}


@pytest.mark.parametrize(("robot", "axes"), [(HINGE, {"axis"}), (UNIVERSAL, {"axis", "childAxis"}), (WELD, set())])
def test_axes_of_a_loop_that_are_read_otherwise_are_found(robot: Robot, axes: set[str]) -> None:
    """A weld has no axis."""
    source, options = to_urdf(robot).encode(), to_options(robot)
    own = generate(source, BOT, **options)
    assert of_package(own, source, own.texts).differences == ()
    turned = {"axis": (0.6, 0.0, 0.8), "child_axis": (0.0, 0.6, 0.8)}
    wrong = replace(own.robot, loops=tuple(replace(loop, **turned) for loop in own.robot.loops))
    numbers = of_package(dataclasses.replace(own, robot=wrong), source, own.texts)
    assert {each.quantity for each in numbers.differences} == axes


def test_the_axis_of_a_loop_joint_is_read_alike() -> None:
    closing = f"""<loop_joint name="rocker_pivot" type="revolute">
<link1 link="ground" xyz="0.6 0 0"
rpy="{np.pi / 2} 0 0"/><link2 link="rocker" xyz="0.4 0 0"/><axis xyz="0 0.28 0.96"/></loop_joint></robot>"""
    source = to_urdf(HINGE).replace("</robot>", closing).encode()
    assert compare(source, **{**to_options(HINGE), "loops": ()}).differences == ()


def test_a_record_alone_has_no_loops() -> None:
    options = msgspec.structs.asdict(FOUR_BAR.options) | {"approach": ("record",)}
    assert compare(FOUR_BAR.source, **options).differences == ()


def test_a_joint_with_a_drive_that_a_loop_moves_begins_where_the_loop_is_closed() -> None:
    drive = b'<transmission name="t"><joint name="rocker_pivot"/></transmission></robot>'
    content = FOUR_BAR.source.read_bytes().replace(b"</robot>", drive)
    assert compare(content, **msgspec.structs.asdict(FOUR_BAR.options)).differences == ()


def test_another_joint_that_drives_a_loop_is_found() -> None:
    drive = b'<transmission name="t"><joint name="crank_pivot"/></transmission></robot>'
    content, options = (
        FOUR_BAR.source.read_bytes().replace(b"</robot>", drive),
        msgspec.structs.asdict(FOUR_BAR.options),
    )
    own = generate(content, BOT, **options)
    assert of_package(own, content, own.texts).differences == ()
    wrong = tuple(replace(joint, actuated=joint.name == "rocker_pivot" or None) for joint in own.robot.joints)
    package = generate_robot(replace(own.robot, joints=wrong), BOT, **options)
    found = of_package(package, content, package.texts).differences
    assert {(each.element, each.quantity, each.expected, each.given) for each in found} == {
        ("joint crank_pivot", "drive", "stated", "nothing"),
        ("joint crank_pivot", "command", "position", "nothing"),
        ("joint rocker_pivot", "command", "nothing", "position"),
        ("joint rocker_pivot", "drive", "nothing", "stated"),
    }


def test_a_package_whose_record_was_deleted_is_compared() -> None:
    def change(texts: Any) -> Any:
        return {path: text for path, text in texts.items() if path != "BotParameters.mo"}

    assert compare(URDF.encode(), change).differences == ()


def test_a_law_without_an_integral_has_no_range_of_positions() -> None:
    law = '<param name="velocity_gain">4</param><param name="min_position">-1</param>'
    numbers = compare(URDF.replace(LAW, law).encode())
    assert numbers.differences == ()


OPTIONS: dict[str, dict[str, Any]] = {
    "commands": {"commands": {"shoulder": "effort", "slide": "position"}},
    "start": {"start": {"shoulder": 0.5}},
    "driven": {"driven": ("slide",)},
    "a vector of inputs": {"inputs": "vector", "approach": ("package",)},
    "drives that keep their limits": {"saturated": "all", "commands": {"shoulder": "effort"}},
    "no collisions": {"collisions": False},
    "flanges of motors": {"drives": "motor"},
}


@pytest.mark.parametrize("name", OPTIONS)
def test_options_count_before_the_source(name: str) -> None:
    options = {**OPTIONS[name], "base": "floating", "allow": ()}
    assert compare(URDF.encode(), **options).differences == ()
    as_if_without = generate(URDF.encode(), BOT, approach=("package", "record"), base="floating")
    asked = dataclasses.replace(as_if_without, options=Options(**options))
    found = {each.quantity for each in of_package(asked, URDF.encode(), as_if_without.texts).differences}
    assert bool(found) == bool(OPTIONS[name].keys() & {"commands", "start"})

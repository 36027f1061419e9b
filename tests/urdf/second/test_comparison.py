"""The numbers of packages against the second reading: real robots agree, and each fault is found in its file."""

from __future__ import annotations

import dataclasses
import shutil
from collections.abc import Callable
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
from support.urdfs import dynamics, joint, limit, link, links, mimic
from support.urdfs import robot as urdf

from urdfsync import config
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Box, Joint, Link, Loop, Origin, Robot

UNCOMPARED = {f"{kind}.{path}" for kind in ("visual", "collision") for path in ("lower", "upper", "color", "opacity")}
UNCOMPARED.add("reach")
"""What only the files of meshes have, and how far Test may move the joints of a loop."""


def uncompared(sentences: tuple[str, ...]) -> set[str]:
    return {sentence.partition(" of records")[0] for sentence in sentences if "yourdfpy" not in sentence}


ROBOTS = config.load(corpus.REPOSITORY / "urdfsync.toml").robots


@pytest.mark.parametrize("example", ROBOTS, ids=lambda example: example.name)
def test_shipped_examples_agree(example: Any) -> None:
    options = msgspec.structs.asdict(example.options) | {"approach": ("package", "record")}
    numbers = compare(example.source, **options)
    assert numbers.differences == ()
    assert uncompared(numbers.uncompared) <= UNCOMPARED
    left = sum(int(sentence.rpartition("(")[2].split()[0]) for sentence in numbers.uncompared)
    assert numbers.right == numbers.total - left
    assert numbers.right > 400


def test_the_menagerie_agrees() -> None:
    """It gets one sensor of each new kind: this fails if the second reading does not know the kind."""
    assert differences(corpus.REPOSITORY / "tests/golden/menagerie.urdf") == []


@pytest.mark.parametrize("file", sampled(corpus.robots(), 4))
def test_real_robots_agree(file: str, corpus: Path) -> None:
    content = (corpus / file).read_bytes()
    if read(content).snapshot is None:
        return
    numbers = compare(corpus / file, base=proposed_base(content))
    assert numbers.differences == ()
    assert uncompared(numbers.uncompared) <= UNCOMPARED
    assert numbers.total > 10


# Each fault is what a wrong reader would read, or what a wrong template would write

BOX = '<geometry><box size="0.1 0.2 0.3"/></geometry>'
RED = '<material name="red"><color rgba="1 0.5 0.25 0.75"/></material>'
MESH = '<visual><geometry><mesh filename="cube.stl" scale="0.5 0.7 1"/></geometry></visual>'
SHAPES = f'<visual>{BOX}{RED}</visual><collision><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>{BOX}</collision>{MESH}'
SHAPES += MESH.replace("visual", "collision")
CONTROL = (
    '<ros2_control name="c"><joint name="slide"><command_interface name="velocity"/><state_interface name="position">'
    '<param name="initial_value">0.2</param></state_interface></joint></ros2_control>'
)
GEAR = (
    '<transmission name="t"><joint name="shoulder"><offset>0.1</offset></joint>'
    "<actuator><mechanicalReduction>50</mechanicalReduction></actuator></transmission>"
)
GROUND = '<gazebo reference="arm"><mu1>0.8</mu1><mu2>0.3</mu2><kp>1000</kp><kd>20</kd></gazebo>'
IMU = '<gazebo reference="hand"><sensor name="imu" type="imu"><pose>1 2 3 0.1 0.2 0.3</pose></sensor></gazebo>'
WRENCH = '<gazebo reference="shoulder"><sensor name="force" type="force_torque"/></gazebo>'
SAFE = '<safety_controller k_velocity="5" k_position="6" soft_lower_limit="-0.5" soft_upper_limit="0.4"/>'
URDF = urdf(
    *(link("base", 3.0), link("arm", 2.0).replace("</link>", f"{SHAPES}</link>"), link("hand", 0.7), link("tip", 0.1)),
    joint("shoulder", "revolute", "base", "arm", axis="0 1 0",
          inside=[dynamics(0.5, 0.2, armature=0.01), limit(-1, 2, 3, 40), SAFE, '<calibration rising="0.3"/>']),
    joint("slide", "prismatic", "arm", "hand", axis="1 2 2", inside=[limit(0, 0.5, 0.6, 70)]),
    joint("twist", "revolute", "hand", "tip", axis="0 0 1", inside=[limit(-2, 3), mimic("shoulder", 0.5, 0.1)]),
    *(CONTROL, GEAR, GROUND, IMU, WRENCH),
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
    assert uncompared(numbers.uncompared) == {*ends, "visual.color", "visual.opacity"}


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
    "a velocity interface read as position": (of("joints", "slide", command=None), "BotRun.mo", "slideDrive.v_ref"),
    "an effort interface that is none": (
        of("joints", "shoulder", command="effort"), "BotRun.mo", "shoulderDrive.phi_ref"),
    "a start with the other sign": (of("joints", "slide", start=-0.2), "BotStart.mo", "start"),
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
        of("joints", "twist", mimic=lambda j: replace(j.mimic, joint="slide")), "Bot.mo", "twistMimic.leader"),
    "another parent": (of("joints", "twist", parent="arm"), "Bot.mo", "twist.frame_a"),
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
    "a sensor on another link": (of("sensors", "imu", at="arm"), "Bot.mo", "imu.frame_a"),
    "a wrench in the other axes": (of("sensors", "force", in_parent=True), "Bot.mo", "force.f_joint"),
    "a wrench in the other direction": (of("sensors", "force", on_child=True), "Bot.mo", "force.t_joint"),
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


@pytest.mark.parametrize("fault", READER)
def test_what_a_reader_misreads_is_found(fault: str, sound: Package) -> None:
    wrong, file, quantity = READER[fault]
    meshless = dataclasses.replace(sound, facts={})
    numbers = of_package(meshless, URDF.encode(), as_read(meshless, wrong).texts)
    found = {(each.file, each.quantity): each for each in numbers.differences}
    assert (file, quantity) in found, found
    assert numbers.right < numbers.total
    each = found[file, quantity]
    assert each.expected != each.given
    assert each.line > 0 or each.given == "nothing"
    assert each.source_line > 0 or quantity == "height"


def test_a_scale_with_x_and_y_exchanged_is_found(sound: Package) -> None:
    """Its files in the package are others."""
    facts = {key.replace("0.5 0.7", "0.7 0.5"): file for key, file in sound.facts.items()}
    numbers = of_package(dataclasses.replace(sound, facts=facts), URDF.encode(), sound.texts)
    assert {each.quantity for each in numbers.differences} == {"visual2.uri", "collision2.uri"}


TEMPLATES = {
    "an input of Run at another joint": (
        "BotRun.mo", "connect(slide_v, slideDrive", "connect(slide_v, shoulderDrive", "slideDrive.v_ref"),
    "a source of another quantity": ("BotRun.mo", "slideDrive.v_ref", "slideDrive.s_ref", "slideDrive.v_ref"),
    "a source at another axis": ("BotTest.mo", "robot.slideAxis", "robot.shoulderAxis", "robot.slideAxis"),
    "a source that pushes against another housing": (
        "BotRun.mo", "robot.slideSupport", "robot.shoulderSupport", "robot.slideSupport"),
    "an output with the other sign": ("BotRun.mo", "= robot.slideAxis.f", "= -robot.slideAxis.f", "slide_f"),
    "a sensor's output of another sensor": ("BotRun.mo", "= robot.imu.a", "= robot.imu.w", "imu_a"),
    "a Test that begins elsewhere": ("BotTest.mo", "robot.slide.s_start", "robot.slide.s_min", "slideDrive.s_start"),
    "a Test within other limits": ("BotTest.mo", "robot.slide.s_max", "3*robot.slide.s_max", "slideDrive.s_max"),
    "an input in degrees": (
        "BotRun.mo", 'shoulder_phi(unit = "rad")', 'shoulder_phi(unit = "deg")', "shoulder_phi.unit"),
    "a slow filter": ("BotRun.mo", "exact = false", "exact = false, f_crit = 0.5", "shoulderDrive.f_crit"),
    "a source of another kind": ("BotTest.mo", "Drives.RotationalSweep", "Drives.OtherSweep", "type of shoulderDrive"),
    "a drive that begins at zero": (
        "BotRun.mo", "s(start = robot.slide.s_start)", "s(start = 0)", "slideDrive.s.start"),
    "a second force at an axis": (
        "BotRun.mo", "\nequation\n", "\nequation\n  connect(brake.flange, robot.slideAxis);\n", "robot.slideAxis"),
    "no output of a sensor": ("BotRun.mo", "imu_w[3]", "imu_v[3]", "imu_w"),
    "a bench without ground": ("BotTest.mo", "PartialMobileBench(", "PartialBench(", "extends"),
    "the ground for another weight": ("BotRun.mo", "load = robot.m", "load = 10*robot.m", "load"),
    "another stance": (
        "BotTest.mo", "redeclare BotStance stance", "redeclare UrdfSync.Records.Stance stance", "stance"),
    "another start of the generic robot": ("BotGeneric.mo", "startPositions.slide", "0.3", "robot.s_start"),
    "another way of the generic robot": ("BotGeneric.mo", "reach = 1)", "reach = 10)", "rotationalSweep.reach"),
    "the frame of another link": ("Bot.mo", "tip.frame_a, tipFrame", "arm.frame_a, tipFrame", "tip.frame_a"),
    "a visual with the numbers of another": (
        "Links/Arm.mo", "parameters = parameters.visual2", "parameters = parameters.visual1", "visual2.parameters"),
    "a collision that is always drawn": (
        "Links/Arm.mo", "animation = showCollisions", "animation = animation", "collision1.animation"),
    "a contact without friction": (
        "Links/Arm.mo", "friction = parameters.contact.mu", "friction = 0", "contact1.friction"),
    "a contact without damping": ("Links/Arm.mo", "viscosity = parameters.contact.kd,", "", "contact1.viscosity"),
    "a contact of another shape": ("Links/Arm.mo", "Contacts.Box", "Contacts.Sphere", "type of contact1"),
    "a visual that is never drawn": (
        "Links/Arm.mo", "animation = animation)\n", "animation = animation) if false\n", "condition of visual1"),
    "a shape of another kind": (
        "Links/ArmParameters.mo", "Records.Box visual1", "Records.Sphere visual1", "visual1.shape"),
    "another gravity": ("BotTest.mo", "PartialMobileBench(", "PartialMobileBench(world(g = 1), ", "world.g"),
    "two fields of a record exchanged": ("Joints/ShoulderParameters.mo", "damping = 0.5", "damping = 0.2",
                                         "dynamics.damping"),
    "a table that counts from 0": ("BotParameters.mo", "connectionMatrix = [1, 2", "connectionMatrix = [0, 1",
                                   "connectionMatrix[1]"),
    "a table of other joints": ("BotParameters.mo", "slide.axis", "shoulder.axis", "jointAxes[2]"),
    "the other kind of joint in a table": ("BotParameters.mo", "turning = {1, 3}", "turning = {1, 2}", "turning[2]"),
    "a name of another element": ("Links/HandParameters.mo", 'name = "hand"', 'name = "arm"', "inertial.mass"),
    "a number of an axis": ("BotParameters.mo", "Integer slideAxis = 1", "Integer slideAxis = 2", "slideAxis[1]"),
    "the drawn length of a box": ("BotParameters.mo", "-0.5*armVisual1.size[1]", "-0.5*armVisual1.size[2]",
                                  "visuals.starts[1]"),
    "a range that a follower does not narrow": (
        "Bot.mo", "min({shoulder.parameters.limits.upper", "max({shoulder.parameters.limits.upper",
        "shoulder.phi_max"),
    "a start of no joint": ("Bot.mo", "s_start = startPositions.slide", "s_start = 0", "slide.s_start"),
    "limits that nothing checks": ("Bot.mo", "checkLimits = checkLimits", "checkLimits = false", "slide.checkLimits"),
    "a sensor with the numbers of another": (
        "Bot.mo", "sensorParameters.imu", "sensorParameters.force", "imu.parameters"),
    "a mass that is left out": ("Bot.mo", "    tip.m\n", "    hand.m\n", "m"),
    "a coupling that does not know its limits": ("Bot.mo", "w_max = twist.w_max,", "", "twistMimic.w_max"),
    "two joints at one flange": (
        "Bot.mo", "connect(slide.support", "connect(slide.axis, shoulder.axis);\n  connect(slide.support",
        "shoulder.axis"),
    "a Test that stops early": ("BotTest.mo", "StopTime=10", "StopTime=1", "experiment.StopTime"),
    "an expression": ("Joints/SlideParameters.mo", "upper = 0.5", "upper = 2*x", "limits.upper"),
    "two numbers of three": ("Joints/SlideParameters.mo", "rpy = {0.5, -0.6, 0.7}", "rpy = {0.5}", "origin.rpy"),
    "corners of a mesh that are elsewhere": (
        "Links/ArmParameters.mo", "    {0.25, ", "    {0.5, ", "collision2Corners"),
    "corners of a mesh that are an expression": (
        "Links/ArmParameters.mo", "collision2Corners[8, 3] = ", "collision2Corners[8, 3] = 2*", "collision2Corners"),
    "a height that is not that of the lowest shape": ("BotStance.mo", "height = ", "height = 1", "height"),
    "a height of several numbers": ("BotStance.mo", "height = ", "height = {1, 2} + ", "height"),
}  # fmt: skip
"""A text, what a template would write in it otherwise, and the quantity that differs."""


@pytest.mark.parametrize("fault", TEMPLATES)
def test_what_a_template_writes_wrongly_is_found(fault: str, sound: Package) -> None:
    file, old, new, quantity = TEMPLATES[fault]
    assert old in sound.texts[file]
    texts = {**sound.texts, file: sound.texts[file].replace(old, new)}
    numbers = of_package(sound, URDF.encode(), texts)
    assert (file, quantity) in {(each.file, each.quantity) for each in numbers.differences}


@pytest.mark.parametrize(("kind", "old", "new", "quantity"), [
    ("Box", "length = parameters.size[1]", "length = 0.5*parameters.size[1]", "shape.length"),
    ("Cylinder", "- 0.5*parameters.length", "+ 0.5*parameters.length", "shape.r_shape"),
    ("Sphere", "enableAnimation and animation", "enableAnimation and not animation", "condition of shape"),
    ("Capsule", "+ 0.5*parameters.length", "- 0.5*parameters.length", "upperEnd.r_shape"),
    ("Mesh", "widthDirection = R[:, 2]", "widthDirection = R[:, 3]", "shape.widthDirection"),
    ("normalTo", "e - (e*n)/(n*n)*n", "e - (e*n)*n", "p"),
])  # fmt: skip
def test_a_library_that_draws_or_moves_otherwise_is_found(
    kind: str, old: str, new: str, quantity: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    folder = "Functions" if kind == "normalTo" else "Visualizers"
    numbers = {"Box": 'size="1 2 3"', "Mesh": 'filename="cube.stl"'}.get(kind, 'length="2" radius="0.2"')
    shape = f"<visual><geometry><{kind.lower()} {numbers}/></geometry></visual></link>"
    source = urdf(
        link("base", 3.0).replace("</link>", shape), link("cart", 1.0), joint("glide", "planar", "base", "cart")
    ).encode()
    shutil.copytree(corpus.REPOSITORY / "modelica", tmp_path / "modelica")
    file = tmp_path / "modelica" / "UrdfSync" / folder / f"{kind}.mo"
    monkeypatch.setattr("urdfsync.urdf.second.classes.library_folder", lambda: tmp_path / "modelica")
    assert compare(source).differences == ()
    assert old in file.read_text()
    file.write_text(file.read_text().replace(old, new))
    found = {(each.file, each.element, each.quantity) for each in compare(source).differences}
    assert found == {(str(file), f"UrdfSync.{folder}.{kind}", quantity)}


# Loops, and options


FOUR_BAR = next(robot for robot in ROBOTS if robot.name == "four_bar")
LOOP_FAULTS: dict[str, tuple[Callable[[Loop], Loop], str, str]] = {
    "a frame 5 cm off": (
        lambda loop: replace(loop, origin=Origin((0.55, 0.0, -0.025))), "Joints/Rocker_pinParameters.mo", "origin.xyz"),
    "frames exchanged": (
        lambda loop: replace(loop, parent=loop.child, child=loop.parent, origin=loop.child_origin,
                             child_origin=loop.origin), "Bot.mo", "rocker_pin.frame_a"),
}  # fmt: skip


@pytest.mark.parametrize("fault", LOOP_FAULTS)
def test_a_loop_that_is_read_otherwise_is_found(fault: str) -> None:
    wrong, file, quantity = LOOP_FAULTS[fault]
    content, options = FOUR_BAR.source.read_bytes(), FOUR_BAR.options
    own = generate(content, BOT, **msgspec.structs.asdict(options))
    changed = replace(own.robot, loops=tuple(map(wrong, own.robot.loops)))
    texts = generate_robot(changed, BOT, **msgspec.structs.asdict(options)).texts
    assert (file, quantity) in {(each.file, each.quantity) for each in of_package(own, content, texts).differences}


@pytest.mark.parametrize(("old", "new", "file", "quantity"), [
    ("crank_pin = -0.88", "crank_pin = 0.88", "BotStart.mo", "start"),
    ("crank_pivot = 1.2", "crank_pivot = -1.2", "BotStart.mo", "start"),
    *(("translations = [1, 0, 0; 0, 1, 0]", f"translations = {other}", "Joints/Rocker_pinParameters.mo", "translations")
      for other in ("[1, 0, 0; 1, 0, 0]", "{1, 2}", "2*x")),
    ("parameters.childRotations)", "parameters.childRotations, decay = 1)", "Joints/Rocker_pin.mo", "constraint.decay"),
])  # fmt: skip
def test_a_loop_that_closes_otherwise_is_found(old: str, new: str, file: str, quantity: str) -> None:
    def change(texts: Any) -> Any:
        assert old in texts[file]
        return {**texts, file: texts[file].replace(old, new)}

    numbers = compare(FOUR_BAR.source, change, **msgspec.structs.asdict(FOUR_BAR.options))
    assert (file, quantity) in {(each.file, each.quantity) for each in numbers.differences}


@pytest.mark.parametrize(("robot", "old", "new"), [
    (HINGE, "otations = [1, 0, 0; 0, 0.96, -0.28]", "otations = [1, 0, 0; 0, 1, 0]"),
    (HINGE, "[0, 0.28, 0.96; 0, 0.28, 0.96]", "[0, 0.28, 0.96; 1, 0, 0]"),
    (UNIVERSAL, "otations = [0, 0, 1]", "otations = [1, 0, 0]"),
    (UNIVERSAL, "otations = [0, 1, 0]", "otations = [1, 0, 0]"),
    (WELD, "otations = [0, 1, 0]", "otations = [1, 0, 0]"),
])  # fmt: skip
def test_a_wrong_axis_of_a_loop_is_found(robot: Robot, old: str, new: str) -> None:
    """Only loops in space state directions: a loop in a plane has no equations about them."""

    def change(texts: Any) -> Any:
        changed = {path: text.replace(old, new) for path, text in texts.items()}
        assert changed != texts
        return changed

    source, options = to_urdf(robot).encode(), to_options(robot)
    assert compare(source, **options).differences == ()
    assert "rotations" in {each.quantity for each in compare(source, change, **options).differences}


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
    texts = generate_robot(replace(own.robot, joints=wrong), BOT, **options).texts
    found = of_package(own, content, texts).differences
    first = next(each for each in found if each.file == "BotRun.mo")
    assert (first.element, first.quantity) == ("joint rocker_pivot", "robot.rocker_pivotAxis")
    assert first.given == "rocker_pivotDrive.flange"


def test_a_vector_in_another_order_is_found() -> None:
    """Run has its drives in this order, too."""

    def change(texts: Any) -> Any:
        parts = texts["BotRun.mo"].split("\n\n")
        first, second = (k for k, part in enumerate(parts) if " commands[" not in part and ".Sources." in part)
        parts[first], parts[second] = parts[second], parts[first]
        text = "\n\n".join(parts).replace('"rad", "m/s"', '"m/s", "rad"').replace("commands[1]", "commands[3]")
        return {**texts, "BotRun.mo": text.replace("commands[2]", "commands[1]").replace("commands[3]", "commands[2]")}

    options: Any = {"inputs": "vector", "start": {}, "base": "floating"}
    assert compare(URDF.encode(), **options).differences == ()
    found = {(each.quantity, each.given) for each in compare(URDF.encode(), change, **options).differences}
    assert ("slideDrive.v_ref", "commands[1]") in found


def test_a_package_whose_record_was_deleted_is_compared() -> None:
    def change(texts: Any) -> Any:
        return {path: text for path, text in texts.items() if path != "BotParameters.mo"}

    found = compare(URDF.encode(), change, inputs="vector").differences
    assert {each.file for each in found} == {"BotGeneric.mo"}


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
    found = of_package(asked, URDF.encode(), as_if_without.texts).differences
    assert bool(found) == (name in ("commands", "start", "driven", "a vector of inputs",
                                    "drives that keep their limits", "flanges of motors"))  # fmt: skip


LAWS = (
    ("Bend", "UrdfSync.Friction.RotationalLuGre", "UrdfSync.Friction.Rotational", "FrictionLaw"),
    ("Bend", "limits = parameters.limits", "limits(effort = 1, velocity = 1)", "elasticity.limits"),
    ("Slide", "Modelica.Mechanics.Translational.Components.SpringDamper elasticity", "Other elasticity",
     "type of elasticity"),
    ("Glide", "cross(parameters.axis, n_x)", "cross(n_x, parameters.axis)", "prismatic_y.n"),
    ("Glide", "friction_y(parameters = parameters.translation)", "friction_y", "friction_y.parameters"),
    ("Drift", "connect(frame_a, origin.frame_a)", "connect(frame_a, freeMotion.frame_a)", "frame_a"),
)  # fmt: skip


@pytest.mark.parametrize("fault", LAWS)
def test_another_law_than_the_configuration_says_is_found(fault: tuple[str, str, str, str]) -> None:
    file, old, new, quantity = fault
    source = urdf(
        *links(base=3.0, arm=2.0, hand=0.7, cart=1.0, buoy=1.0),
        joint("bend", "revolute", "base", "arm", inside=[dynamics(0.5, 0.2)]),
        joint("slide", "prismatic", "arm", "hand", inside=[dynamics(0.5, 0.2)]),
        joint("glide", "planar", "base", "cart", axis="0 0 1", inside=[dynamics(0.5, 0.2)]),
        joint("drift", "floating", "base", "buoy"),
    )

    def change(texts: Any) -> Any:
        path = f"Joints/{file}.mo"
        assert old in texts[path]
        return {**texts, path: texts[path].replace(old, new)}

    options: Any = {"friction": {"bend": "lugre"}, "elastic": "all", "saturated": ("bend",), "approach": ("package",)}
    assert compare(source.encode(), **options).differences == ()
    found = compare(source.encode(), change, **options).differences
    assert (f"Joints/{file}.mo", quantity) in {(each.file, each.quantity) for each in found}

"""Faults of motion that are put one at a time into templates, library, reader and a user's edits: the comparison sees
each."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from support import physics
from support.cases import sampled
from support.loops import UNIVERSAL, to_options, to_urdf
from support.modelica import URDFSYNC
from support.urdfs import dynamics, every_number, joint, limit, link, links, mimic, robot

from urdfsync.domain.experiment import Aspect, Deviation
from urdfsync.formats.urdf.model.numbers import camel
from urdfsync.formats.urdf.robot import SENSOR_KINDS, Dynamics

pytestmark = pytest.mark.slow

GEAR = (
    '<transmission name="t"><joint name="elbow"><offset>0.2</offset></joint><actuator name="m">'
    "<mechanicalReduction>50</mechanicalReduction><drake:rotor_inertia>1e-4</drake:rotor_inertia>"
    "</actuator></transmission>"
)
IMU = '<gazebo reference="hand"><sensor name="imu" type="imu"><pose>0.1 0.2 -0.3 0.4 -0.5 0.6</pose></sensor></gazebo>'
EYE = IMU.replace("imu", "camera")
LOAD = '<gazebo reference="elbow"><sensor name="load" type="force_torque"/></gazebo>' + "".join(
    f'<gazebo reference="{at}"><sensor name="{at} {frame}" type="force_torque"><pose>0 0 0 0.3 0.2 -0.1</pose>'
    f"<force_torque><frame>{frame}</frame></force_torque></sensor></gazebo>"
    for at in ("shoulder", "grip")
    for frame in ("parent", "sensor")
)
PLACES = {kind: f"0.{number} -0.2 0.3 0.4 -0.5 0.{number}" for number, kind in enumerate(SENSOR_KINDS, 1)}
EACH_SENSOR = "".join(
    f'<gazebo reference="{"elbow" if model.at == "joint" else "hand"}"><sensor name="own{kind}" type="{kind}">'
    f"<pose>{PLACES[kind]}</pose><force_torque><frame>sensor</frame></force_torque></sensor></gazebo>"
    for kind, model in SENSOR_KINDS.items()
)
"""A sensor of each kind, each at a place of its own."""
PULL = '<gazebo reference="elbow"><springStiffness>20</springStiffness><springReference>-0.5</springReference></gazebo>'
SPEED_UP = limit(0.2, 2, 3, 90).replace("/>", ' drake:acceleration="5"/>')
SOURCE = robot(
    *links(base=4.0, upper=2.5, hand=0.7),
    link("finger", 0.3),
    joint(
        "shoulder",
        "revolute",
        "base",
        "upper",
        axis="0 1 0",
        inside=[SPEED_UP, every_number(0.5, 0.4, spring_stiffness=30)],
    ),
    joint(
        "elbow",
        "continuous",
        "upper",
        "hand",
        axis="0.3 -0.4 1.2",
        inside=[dynamics(0.1, 0.2), '<limit effort="60" velocity="4"/>'],
    ),
    joint(
        "grip",
        "prismatic",
        "hand",
        "finger",
        axis="0 1 0",
        inside=[mimic("shoulder", 0.1, 0.02), limit(-0.1, 0.15), every_number(5, 4, spring_stiffness=200)],
    ),
    *(GEAR, IMU, EYE, LOAD, EACH_SENSOR, PULL),
)


class Fault(NamedTuple):
    """A text of a file that is replaced by another; `part` is what has to differ then, at the least."""

    part: Aspect
    file: str
    old: str
    new: str


B, L, F, S = Aspect.BODIES, Aspect.LOSSES, Aspect.FREE_MOTION, Aspect.SENSORS
SHOULDER, ELBOW, HAND = (f"{place}.mo" for place in ("Joints/Shoulder", "Joints/Elbow", "Links/Hand"))
PACKAGE: Mapping[str, Fault] = {
    "order of a joint's turns": Fault(B, ELBOW, "{3, 2, 1}", "{1, 2, 3}"),
    "sign of an axis": Fault(B, ELBOW, "n = parameters.axis", "n = -parameters.axis"),
    "centre of mass": Fault(
        B, HAND, "r_CM = parameters.inertial.origin.xyz", "r_CM = 1.01*parameters.inertial.origin.xyz"
    ),
    "sign of an inertia off the diagonal": Fault(B, HAND, "I_21 = I[2, 1]", "I_21 = -I[2, 1]"),
    "rotor without its reduction": Fault(B, ELBOW, "rotorInertia*parameters.transmission.reduction^2", "rotorInertia"),
    **{
        f"no {name} of the {joint}": Fault(
            L, f"Joints/{joint.capitalize()}Parameters.mo", f"{camel(name)} = ", f"{camel(name)} = 0*"
        )
        for joint in ("shoulder", "grip")
        for name in Dynamics.__struct_fields__
    },
    "reduction": Fault(L, "Joints/ElbowParameters.mo", "reduction = 50", "reduction = 5"),
    "multiplier of a mimic": Fault(B, "Joints/GripParameters.mo", "multiplier = 0.1", "multiplier = -0.1"),
    "offset of a mimic": Fault(B, "Joints/GripParameters.mo", "offset = 0.02", "offset = 0"),
    "start that is not applied": Fault(F, SHOULDER, "phi(start = phi_start, ", "phi(start = 0, "),
    "speed that is not applied": Fault(F, SHOULDER, "w(start = w_start, ", "w(start = 0, "),
    "axes of an IMU": Fault(S, "ArmSensors.mo", "rpy = {0.4, -0.5, 0.6}", "rpy = {0.6, -0.5, 0.4}"),
    "sign of a wrench": Fault(S, "Arm.mo", "f_joint = elbow.frame_b.f", "f_joint = -elbow.frame_b.f"),
}
"""In the text that a template gives, as a fault of the template, of the reader or of a number of the user's would."""


def _place(numbers: str) -> str:
    """The place of a sensor in the record."""
    x, y, z, *angles = numbers.split()
    return f"xyz = {{{x}, {y}, {z}}},\n      rpy = {{{', '.join(angles)}}}"


SENSORS: Mapping[str, Fault] = {
    f"place of a sensor: {kind}": Fault(S, "ArmSensors.mo", _place(place), _place("0.9 0.1 -0.3 0.4 0.5 0"))
    for kind, place in PLACES.items()
}
LIBRARY: Mapping[str, Fault] = {
    "sign of friction": Fault(
        L, "Friction/Rotational.mo", "+ parameters.friction*tanh(", "- parameters.friction*tanh("
    ),
    "steepness of friction": Fault(L, "Friction/Rotational.mo", "tanh(0.5*parameters", "tanh(parameters"),
    "sign of damping": Fault(L, "Friction/Rotational.mo", "parameters.damping*w", "parameters.damping*abs(w)"),
    "effort of a mimic": Fault(B, "Couplings/RotationalToTranslational.mo", "leader.tau + ", "leader.tau - "),
    "frame of a camera": Fault(S, "Sensors/Camera.mo", "connect(origin.frame_b, frame_b)", "connect(frame_a, frame_b)"),
    "gravity in an IMU": Fault(S, "Sensors/Imu.mo", "a = acceleration - ", "a = acceleration + "),
    "gravity of the bench": Fault(F, "Robots/PartialBench.mo", "n = {0, 0, -1}", "n = {0, 0, 1}"),
    "where a joint begins": Fault(F, "Functions/closestToZero.mo", "min(max(", "max(max("),
    "turned inertia": Fault(B, "Functions/inertiaInLinkAxes.mo", "I := R*[", "I := transpose(R)*["),
}


CART = robot(link("base", 8.0), link("left", 1.0), joint("left", "continuous", "base", "left"))
FLOATING: Mapping[str, Fault] = {
    "order of a free base's angles": Fault(F, "Robots/FreeBase.mo", "{3, 2, 1}", "{1, 2, 3}"),
    "frame of a free base's speed": Fault(
        F, "Robots/FreeBase.mo", "w_rel_a_start = w_start", "w_rel_a_start = -w_start"
    ),
    "height of a mobile bench": Fault(F, "Robots/PartialMobileBench.mo", "{0, 0, stance.height}", "{0, 0, 0}"),
}


LOOP: Mapping[str, Fault] = {
    "place of a loop's frame": Fault(B, "Joints/YokeParameters.mo", "{0.4, 0, 0}", "{0.4001, 0, 0}"),
    "frame of the other end": Fault(B, "Joints/Yoke.mo", "r = parameters.childOrigin.xyz", "r = parameters.origin.xyz"),
    "axis of a loop": Fault(B, "Joints/YokeParameters.mo", "rotations = [0, 0, 1]", "rotations = [0.28, 0, 0.96]"),
    "torque of a loop": Fault(Aspect.LOOPS, "Joints/Yoke.mo", "t = constraint.t", "t = -constraint.t"),
}
HELD: Mapping[str, Fault] = {
    "force of a loop": Fault(B, "Loops/Constraint.mo", "frame_a.f = f;", "frame_a.f = -f;"),
    "lever of a row": Fault(B, "Loops/Constraint.mo", "cross(rotations[i, :], rotated[i, :])", "rotations[i, :]"),
}
"""In the library; the robot has a loop."""


def prepared(fault: Fault, name: str, **options: Any) -> physics.Case:
    """The robot, and the one simulation in which a fault shows."""
    trial = "free motion" if fault.part is Aspect.FREE_MOTION else "motion"
    source = CART if fault in FLOATING.values() else SOURCE
    if fault in (*LOOP.values(), *HELD.values()):
        return physics.prepare(to_urdf(UNIVERSAL).encode(), name, **to_options(UNIVERSAL)).only(trial)
    return physics.prepare(source.encode(), name, **options).only(trial)


def damaged(folder: Path, changes: Sequence[tuple[str, str, str]]) -> Path:
    """A copy of the library with other texts."""
    own = folder / "own" / "UrdfSync"
    shutil.copytree(URDFSYNC, own, ignore=shutil.ignore_patterns("Images", "robots"))
    for file, old, new in changes:
        text = (own / file).read_text("utf-8")
        assert old in text
        (own / file).write_text(text.replace(old, new), "utf-8")
    return own


def is_seen(fault: Fault, deviations: Sequence[Deviation]) -> bool:
    return any(each.part is fault.part for each in deviations if not each.agrees)


def test_without_a_fault_all_is_right(modelica_library: Path, tmp_path: Path) -> None:
    cases = [physics.prepare(SOURCE.encode(), "Arm"), physics.prepare(CART.encode(), "Cart", base="floating")]
    arm, cart = physics.compare(modelica_library, tmp_path, cases)
    assert physics.fault(arm) is physics.fault(cart) is None
    assert {each.part for each in (*arm, *cart)} == {*Aspect} - {Aspect.LOOPS}


@pytest.mark.parametrize("fault_name", sampled((*PACKAGE, *SENSORS, *LOOP), 36))
def test_a_fault_in_a_package_is_seen(fault_name: str, modelica_library: Path, tmp_path: Path) -> None:
    fault = {**PACKAGE, **SENSORS, **LOOP}[fault_name]
    case = prepared(fault, "Arm").changed(fault.file, fault.old, fault.new)
    (found,) = physics.compare(modelica_library, tmp_path, [case])
    assert is_seen(fault, found)


@pytest.mark.parametrize("name", sampled((*LIBRARY, *FLOATING, *HELD), 36))
def test_a_fault_in_the_library_is_seen(name: str, modelica_library: Path, tmp_path: Path) -> None:
    base = "floating" if name in FLOATING else "fixed"
    fault = {**LIBRARY, **FLOATING, **HELD}[name]
    own = damaged(tmp_path, [(fault.file, fault.old, fault.new)])
    (found,) = physics.compare(modelica_library, tmp_path, [prepared(fault, "Bot", base=base)], own)
    assert is_seen(fault, found)

"""Faults that are put one at a time into templates, library, reader and a user's edits: the comparison sees each."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import msgspec
import pytest
from support import physics
from support.cases import sampled
from support.loops import UNIVERSAL, to_options, to_urdf
from support.modelica import URDFSYNC
from support.packages import generate
from support.urdfs import dynamics, every_number, joint, limit, link, links, mimic, robot

from urdfsync.domain import Target
from urdfsync.domain.experiment import Aspect, Deviation, Quantity
from urdfsync.urdf.model.numbers import camel
from urdfsync.urdf.robot import SENSOR_KINDS, Dynamics

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


B, L, F, R, S, W, G = (
    *(Aspect.BODIES, Aspect.LOSSES, Aspect.FREE_MOTION, Aspect.BENCHES),
    *(Aspect.SENSORS, Aspect.LIMITS, Aspect.CONTACTS),
)
POINT = "Contacts/Functions/point.mo"
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
    "sign of a limit": Fault(
        W,
        SHOULDER,
        "isAtMost(parameters.limits.lower, revolute.phi)",
        "isAtMost(revolute.phi, parameters.limits.lower)",
    ),
    "limit that never warns": Fault(W, SHOULDER, "(abs(revolute.w), parameters", "(0.5*abs(revolute.w), parameters"),
    "limit of the effort without sign": Fault(W, "Arm.mo", "abs(shoulderAxis.tau)", "shoulderAxis.tau"),
    "limit that names another joint": Fault(
        W, "Arm.mo", '".shoulder (joint " + shoulder.parameters', '".shoulder (joint " + elbow.parameters'
    ),
    "height of the stance": Fault(G, "CartStance.mo", "height = 0.1", "height = 0.10001"),
    "friction of a link": Fault(G, "Links/Left_link_1c47eeParameters.mo", "mu = 0.5", "mu = 0.6"),
    "limit of the acceleration while a joint slows down": Fault(
        W, SHOULDER, "revolute.a*revolute.w < 0", "revolute.a*revolute.w >= 0"
    ),
    "limit of the effort without the motor's": Fault(W, ELBOW, " + parameters.transmission.reduction*motor.tau", ""),
    "limit that is read wrongly": Fault(W, "Joints/ShoulderParameters.mo", "upper = 2", "upper = 2.1"),
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
    "limit of the acceleration alone": Fault(
        W, "Records/RotationalLimits.mo", "deceleration = acceleration", "deceleration = Modelica.Constants.inf"
    ),
    "offset of a motor": Fault(L, "Drives/RotationalGear.mo", "- parameters.offset", "+ parameters.offset"),
    "gravity in an IMU": Fault(S, "Sensors/Imu.mo", "a = acceleration - ", "a = acceleration + "),
    "gravity of the bench": Fault(R, "Robots/PartialBench.mo", "n = {0, 0, -1}", "n = {0, 0, 1}"),
    "where a joint begins": Fault(F, "Functions/closestToZero.mo", "min(max(", "max(max("),
    "range of a leader": Fault(R, "Couplings/RotationalToTranslational.mo", "parameters.offset, s_max", "0, s_max"),
    "housing of Test's drive": Fault(R, "Drives/RotationalSweep.mo", "flange.tau + support", "flange.tau - support"),
    "torque of a motor": Fault(L, "Drives/RotationalGear.mo", "0 = parameters", "0 = 2*parameters"),
    "way of the generic bench": Fault(R, "Robots/AxisSweeps.mo", "0.5*(1 - cos", "1.5*(1 - cos"),
    "range of a leader of the generic robot": Fault(R, "Dynamics/axisEnds.mo", "2] := min(", "2] := max("),
    "turned inertia": Fault(B, "Functions/inertiaInLinkAxes.mo", "I := R*[", "I := transpose(R)*["),
}


def standing(part: str, shape: str, xyz: str = "0 0 0") -> str:
    """A link with a collision."""
    collision = f'<collision><origin xyz="{xyz}"/><geometry><{shape}/></geometry></collision>'
    return part.replace("</link>", f"{collision}</link>")


TILTED = '0.3 0.1 -0.07688" rpy="0 0.4 0'
CART = robot(
    standing(
        standing(link("base", 8.0), 'sphere radius="0.02"', "0.3 0 -0.081"),
        'ellipsoid radii="0.04 0.03 0.02"',
        TILTED,
    ),
    *(standing(link(side, 1.0), 'cylinder radius="0.1" length="0.04"') for side in ("left", "right")),
    *(
        joint(
            side,
            "continuous",
            "base",
            side,
            xyz=f"-0.1 {y} 0",
            rpy="-1.5707963267948966 0 0",
            axis="0 0 1",
            inside=['<limit effort="0.5" velocity="9"/>'],
        )
        for side, y in (("left", 0.2), ("right", -0.2))
    ),
    '<gazebo reference="base"><minDepth>0.001</minDepth></gazebo>',
    '<gazebo reference="left"><mu1>0.5</mu1><kp>2e5</kp></gazebo>',
    '<gazebo reference="right"><mu1>0.5</mu1><kp>3e5</kp><kd>20</kd></gazebo>',
)
FLOATING: Mapping[str, Fault] = {
    "order of a free base's angles": Fault(F, "Robots/FreeBase.mo", "{3, 2, 1}", "{1, 2, 3}"),
    "frame of a free base's speed": Fault(
        F, "Robots/FreeBase.mo", "w_rel_a_start = w_start", "w_rel_a_start = -w_start"
    ),
    "height of a mobile bench": Fault(F, "Robots/PartialMobileBench.mo", "{0, 0, stance.height}", "{0, 0, 0}"),
    "weight on the ground of a bench": Fault(R, "Robots/PartialMobileBench.mo", "ground(load = load)", "ground"),
    "corners of a box": Fault(G, "Contacts/Functions/box.mo", "0.5*y*size[2]", "0.5*y*size[1]"),
    "sliding that begins at three times the speed": Fault(
        G, "Contacts/PartialContact.mo", "else ground.slipSpeed\n", "else 3*ground.slipSpeed\n"
    ),
    "sign of the ground's friction": Fault(G, POINT, "f_n*(n - friction", "f_n*(n + friction"),
    "ground that pulls": Fault(
        G, POINT, "max(0, stiffness*p*max(0, 1 - damping*v_n) - viscosity*v_n)", "stiffness*p*(1 - damping*v_n)"
    ),
    "ground of ten times its stiffness": Fault(
        G, "Contacts/Ground.mo", "stiffness = load/penetration", "stiffness = 10*load/penetration"
    ),
    "ground that feeds in energy": Fault(G, POINT, "1 - damping*v_n", "1 + damping*v_n"),
    "height of a rim": Fault(G, "Contacts/Functions/cylinder.mo", "(c*R[:, 3] - n)", "(c*R[:, 3] + n)"),
    "height of an ellipsoid": Fault(G, "Contacts/Functions/ellipsoid.mo", "/max(sqrt(d*d)", "/max(d*d"),
    "side of an ellipsoid": Fault(G, "Contacts/Functions/ellipsoid.mo", "radii[1]*d[1]", "d[1]"),
    "force of the ground on no link": Fault(G, "Contacts/PartialContact.mo", "frame_a.f = -f", "frame_a.f = zeros(3)"),
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
    is_bench = fault.part is Aspect.BENCHES and "Bench" in fault.file
    trial = "free motion" if fault.part is Aspect.FREE_MOTION or is_bench else "motion"
    trial = "ways in Test" if fault.file.endswith("Sweep.mo") else trial
    source = CART if fault.part is Aspect.CONTACTS else SOURCE
    if fault.file.endswith("box.mo"):
        source = source.replace('sphere radius="0.02"', 'box size="0.1 0.3 0.04"')
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
    name, options = ("Cart", {"base": "floating"}) if fault.part is Aspect.CONTACTS else ("Arm", {})
    options |= {"drives": "motor"} if "motor" in fault.old else {}
    case = prepared(fault, name, **options).changed(fault.file, fault.old, fault.new)
    (found,) = physics.compare(modelica_library, tmp_path, [case])
    assert is_seen(fault, found)


@pytest.mark.parametrize("name", sampled((*LIBRARY, *FLOATING, *HELD), 36))
def test_a_fault_in_the_library_is_seen(name: str, modelica_library: Path, tmp_path: Path) -> None:
    base = "floating" if name in FLOATING else "fixed"
    fault = {**LIBRARY, **FLOATING, **HELD}[name]
    own = damaged(tmp_path, [(fault.file, fault.old, fault.new)])
    options: Any = {"base": base, "drives": "motor" if fault.file.startswith("Drives/") else "joint"}
    if name.endswith(("generic bench", "generic robot")):
        options["approach"] = ("record",)
    (found,) = physics.compare(modelica_library, tmp_path, [prepared(fault, "Bot", **options)], own)
    assert is_seen(fault, found)


TORQUES, TURNING, SLIDING = "Contacts/PartialContact.mo", "Drives/RotationalSweep.mo", "Drives/TranslationalSweep.mo"
TOGETHER: Mapping[str, Sequence[tuple[str, str, str]]] = {
    "no torque of the ground, turning Test begins elsewhere, sliding Test goes too far": [
        (TORQUES, "frame_a.t = -t", "frame_a.t = zeros(3)"),
        (TURNING, "phi(start = phi_start", "phi(start = phi_start + 0.1"),
        (SLIDING, "der(v) = 2", "der(v) = 6"),
    ],
    "reversed torque of the ground, turning Test goes too far, sliding Test begins elsewhere": [
        (TORQUES, "frame_a.t = -t", "frame_a.t = t"),
        (TURNING, "der(w) = 2", "der(w) = 6"),
        (SLIDING, "s(start = s_start", "s(start = s_start + 0.1"),
    ],
}
LAWS = robot(
    *links(base=1.0, a=1.0, b=1.0, c=1.0, d=1.0, e=1.0, f=1.0, g=1.0),
    joint("brush", "revolute", "base", "a", inside=[dynamics(0.1, 0.4)]),
    joint("rail", "prismatic", "a", "b", inside=[dynamics(2, 3)]),
    joint("limp", "revolute", "b", "c"),
    joint("bend", "continuous", "c", "d", inside=[dynamics(0.1, 0.4)]),
    joint("stuck", "revolute", "d", "e", inside=[dynamics(0.1, 0.4)]),
    joint("slip", "prismatic", "e", "f", inside=[dynamics(2, 3)]),
    joint("hoist", "prismatic", "f", "g"),
)
CHOSEN: Mapping[str, Any] = {
    "friction": {"brush": "lugre", "rail": "lugre", "bend": "stiction", "stuck": "stiction", "slip": "stiction"},
    "elastic": ("limp", "bend"),
    "saturated": ("limp", "hoist"),
    "commands": {"hoist": "effort"},
    "driven": ("brush", "rail", "limp", "bend", "hoist"),
}


@pytest.mark.parametrize("name", sampled(TOGETHER, 2))
def test_faults_of_ground_and_test_are_seen_each_by_itself(name: str, modelica_library: Path, tmp_path: Path) -> None:
    mast = joint("mast", "prismatic", "base", "top", axis="0 0 1")
    source = CART.replace("</robot>", f"{link('top', 1.0)}{mast}</robot>")
    case = physics.prepare(source.encode(), "Cart", base="floating").only("motion", "ways in Test")
    (found,) = physics.compare(modelica_library, tmp_path, [case], damaged(tmp_path, TOGETHER[name]))
    faults = {(each.part, each.quantity, each.element, each.unit) for each in found if not each.agrees}
    turning = {(R, Quantity.SWEEP, f"joint {side}", "rad") for side in ("left", "right")}
    assert faults == {(G, Quantity.GROUND, "robot", "N·m"), *turning, (R, Quantity.SWEEP, "joint mast", "m")}


LUGRE, SPRING, STICTION = (
    *("Friction/RotationalLuGre.mo", "Drives/RotationalSpring.mo"),
    "Friction/TranslationalStiction.mo",
)
WRONG_LAWS: Mapping[Quantity, Sequence[tuple[str, str, str]]] = {
    Quantity.ENERGY: [
        (LUGRE, "damping*w + ", "damping*w - "),
        (SPRING, "tau = -Urdf", "tau = Urdf"),
        (STICTION, "else -parameters.friction", "else parameters.friction"),
    ],
    Quantity.LAW: [
        (LUGRE, "parameters.friction - 1)", "parameters.friction + 1)"),
        (SPRING, "-parameters.stiffness", "-0.5*parameters.stiffness"),
        (STICTION, "f0_max = parameters.breakaway", "f0_max = 2*parameters.breakaway"),
    ],
}


def wrong_laws(
    case: physics.Case, quantity: Quantity, library: Path, folder: Path, changes: Sequence[tuple[str, str, str]]
) -> set[str]:
    """The joints whose laws differ, with a changed library."""
    (found,) = physics.compare(library, folder, [case], damaged(folder, changes))
    joints = {each.element for each in found if each.quantity is quantity}
    assert joints == {f"joint {name}" for name in (*OF_LAWS, *["hoist"] * (quantity is Quantity.LAW))}
    return {each.element.removeprefix("joint ") for each in found if each.quantity is quantity and not each.agrees}


OF_LAWS = ("brush", "rail", "limp", "bend", "stuck", "slip")


def case_of_laws() -> physics.Case:
    case = physics.prepare(LAWS.encode(), "Bot", **CHOSEN)
    assert case.experiment.laws is not None
    package = generate(LAWS.encode(), Target("Bot", "Bot"), **CHOSEN)
    return physics.Case(msgspec.structs.replace(case.experiment, trials=(case.experiment.laws,)), package)


@pytest.mark.parametrize("quantity", sampled(WRONG_LAWS, 2))
def test_wrong_laws_are_seen_beside_sound_ones(quantity: Quantity, modelica_library: Path, tmp_path: Path) -> None:
    """The spring of MSL with another stiffness is a fault of the template, the others of the library."""
    factor = "-" if quantity is Quantity.ENERGY else "2*"
    case = case_of_laws().changed("Joints/Bend.mo", "c = parameters", f"c = {factor}parameters")
    seen = wrong_laws(case, quantity, modelica_library, tmp_path, WRONG_LAWS[quantity])
    assert seen == {"brush", "limp", "bend", "slip"}


WRONG_NUMBERS: Mapping[tuple[str, ...], Sequence[tuple[str, str, str]]] = {
    ("limp", "hoist", "rail", "slip"): [
        ("Functions/limitedEffort.mo", "fading = 0.05", "fading = 0.06"),
        ("Records/JointDynamics.mo", "Force breakaway(min = 0) = friction", "Force breakaway(min = 0) = 2*friction"),
    ],
    ("brush", "limp", "bend"): [
        ("Records/JointDynamics.mo", "stribeckSpeed = 0.05", "stribeckSpeed = 0.06"),
        ("Records/RotationalTransmission.mo", "stiffness = 1e4", "stiffness = 1.1e4"),
    ],
    (): [],
}
"""Numbers that no source states, by the joints that they concern."""


@pytest.mark.parametrize("joints", sampled(WRONG_NUMBERS, 3))
def test_other_numbers_of_the_library_are_seen(joints: tuple[str, ...], modelica_library: Path, tmp_path: Path) -> None:
    seen = wrong_laws(case_of_laws(), Quantity.LAW, modelica_library, tmp_path, WRONG_NUMBERS[joints])
    assert seen == {*joints}

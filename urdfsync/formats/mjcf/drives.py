"""Reads the numbers of joints, their couplings and their motors from a compiled model.

MuJoCo counts the position of a joint from `ref`, URDF from the pose in which the model is written: so `ref` is
subtracted from limits, starts and references of springs. A motor's gear is a reduction: the joint has `gear` times the
motor's effort.

The force of an actuator is gain · ctrl + bias + stiffness · length + damping · speed, in its own units. At the joint's
side, this is the law of a `Servo`. Its command is the position, or the speed, at which the actuator gives no force: so
commands mean the same as for joints that move exactly. A commanded effort includes the bias.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import mujoco

from urdfsync.formats.mjcf.scene import MujocoScene
from urdfsync.formats.translation.writer import UrdfElement, rounded
from urdfsync.formats.urdf.robot import Command

HOME = "home"
"""The key with the start positions."""
_AXES = (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE)
_SIZES = {int(mujoco.mjtJoint.mjJNT_BALL): 4, int(mujoco.mjtJoint.mjJNT_FREE): 7}
"""Numbers of a pose."""
_OF_JOINT = (mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_JOINTINPARENT)
_BIASES = (mujoco.mjtBias.mjBIAS_NONE, mujoco.mjtBias.mjBIAS_AFFINE)
_OF_SITE = (int(mujoco.mjtTrn.mjTRN_SITE), int(mujoco.mjtTrn.mjTRN_SLIDERCRANK))


class Follower(NamedTuple):
    """Position = `multiplier` · position of `leader` + `offset`."""

    leader: int
    multiplier: float
    offset: float


class JointActuator(NamedTuple):
    """An actuator that moves one joint."""

    actuator: int
    command: Command
    gear: float
    effort: float | None
    """The greatest effort at the joint, in N·m or N; None without a limit."""
    servo: Mapping[str, float] | None
    """The law at the joint's side, by the names of `urdf.robot.Servo`; None if no `Servo` has it."""


class Drives:
    """The couplings and motors of a robot's joints."""

    def __init__(self, scene: MujocoScene) -> None:
        self.scene = scene
        bodies = {*scene.bodies}
        self.joints = [n for n in range(scene.model.njnt) if int(scene.model.jnt_bodyid[n]) in bodies]
        self.left_out = list[UrdfElement]()
        """Parts that act on the robot, and that no model has."""
        self.followers = dict[int, Follower]()
        self._read_couplings()
        self.motors = defaultdict[int, list[JointActuator]](list)
        groups = scene.model.opt.disableactuator
        actuators = range(len(scene.controls))
        self.disabled = [n for n in actuators if groups & 1 << int(scene.model.actuator_group[n])]
        """Actuators that an option switches off."""
        for number in actuators:
            if number not in self.disabled:
                self._read_motor(number)

    def leave_out(self, what: str, kind: str, number: int, name: str = "") -> None:
        """Tell of an element that acts on the robot, and that no model has."""
        name = name or self.scene.name(kind, number)
        self.left_out.append(UrdfElement("left_out", self.scene.line(kind, number), name=name, what=what))

    def _has_axis(self, joint: int) -> bool:
        return joint in self.joints and int(self.scene.model.jnt_type[joint]) in _AXES  # numpy's are never `in`

    def _read_couplings(self) -> None:
        """Read the equalities of joints; a linear one of two joints becomes a coupling."""
        model = self.scene.model
        for number in range(model.neq):
            if model.eq_type[number] != mujoco.mjtEq.mjEQ_JOINT or not model.eq_active0[number]:
                continue
            first, second = int(model.eq_obj1id[number]), int(model.eq_obj2id[number])
            if first not in self.joints and second not in self.joints:
                continue
            offset, multiplier, *higher = map(float, model.eq_data[number][:5])
            is_linear = self._has_axis(first) and self._has_axis(second) and multiplier and not any(higher)
            if is_linear and first not in self.followers and self.leader(second).leader != first:
                self.followers[first] = Follower(second, multiplier, offset)
            else:
                names = " and ".join(self.scene.joints[joint] for joint in (first, second) if joint >= 0)
                self.leave_out("equality of joints", "equality", number, names)

    def leader(self, joint: int) -> Follower:
        """Return the joint that moves a joint by couplings, perhaps itself; positions are as MuJoCo counts them."""
        offset, multiplier = float(self.scene.model.qpos0[self.scene.model.jnt_qposadr[joint]]), 1.0
        while joint in self.followers:
            joint, factor, constant = self.followers[joint]
            offset += multiplier * constant
            multiplier *= factor
        return Follower(joint, multiplier, offset)

    def _read_motor(self, number: int) -> None:
        """Read an actuator: a motor of one joint, or of joints that move together; anything else is left out."""
        model, target = self.scene.model, int(self.scene.model.actuator_trnid[number][0])
        moved = dict[int, float]()  # leaders with the factor from the actuator's effort to that of the joint
        kind = int(model.actuator_trntype[number])
        if kind in _OF_JOINT:
            if target not in self.joints:
                return
            pulls = [(target, 1.0)]
        elif kind == mujoco.mjtTrn.mjTRN_TENDON:
            pulls = list(self.pulls(target))
            if pulls and not any(joint in self.joints for joint, _ in pulls):
                return
        else:
            bodies = {int(mujoco.mjtTrn.mjTRN_BODY): range(model.nbody)} | dict.fromkeys(_OF_SITE, model.site_bodyid)
            pulls = []
            if kind in bodies and int(bodies[kind][target]) not in self.scene.bodies:
                return
        for joint, factor in pulls:
            leader, multiplier, _ = self.leader(joint)
            moved[leader] = moved.get(leader, 0.0) + factor * multiplier
        command = self._command(number)
        if command is None or len(moved) != 1 or not self._has_axis(joint := next(iter(moved))):
            self.leave_out("actuator", "actuator", number)
            return
        own_gear = float(model.actuator_gear[self.scene.outputs[number]][0])
        gear, length = (
            own_gear * moved[joint],
            own_gear * sum(factor * self.leader(joint).offset for joint, factor in pulls),
        )
        if not gear:
            self.leave_out("actuator without gear", "actuator", number)
            return
        servo, effort = self._read_law(number, command, gear, length, pulls)
        self.motors[joint].append(JointActuator(number, command, gear, effort, servo))

    def pulls(self, tendon: int) -> Iterator[tuple[int, float]]:
        """Yield the joints of a fixed tendon with their factors; nothing for a spatial tendon."""
        model, first = self.scene.model, self.scene.model.tendon_adr[tendon]
        for number in range(first, first + model.tendon_num[tendon]):
            if model.wrap_type[number] == mujoco.mjtWrap.mjWRAP_JOINT:
                yield int(model.wrap_objid[number]), float(model.wrap_prm[number])

    def _bias(self, number: int) -> tuple[float, ...]:
        """Return the constant force of an actuator, and those for a unit of position and of speed."""
        is_affine = self.scene.model.actuator_biastype[number] == mujoco.mjtBias.mjBIAS_AFFINE
        return tuple(map(float, self.scene.model.actuator_biasprm[number][:3])) if is_affine else (0.0, 0.0, 0.0)

    def _command(self, number: int) -> Command | None:
        """Return the quantity that an actuator commands; None for an actuator that is no motor, such as a muscle."""
        model, (_, stiffness, damping) = self.scene.model, self._bias(number)
        is_plain = model.actuator_gaintype[number] == mujoco.mjtGain.mjGAIN_FIXED and model.actuator_plugin[number] < 0
        if not is_plain or int(model.actuator_biastype[number]) not in _BIASES:
            return None
        if hasattr(model, "actuator_ctrlnum") and model.actuator_ctrlnum[number] != 1:  # since MuJoCo 4
            return None
        if model.actuator_dyntype[number] == mujoco.mjtDyn.mjDYN_INTEGRATOR:
            return "velocity" if stiffness else None  # without feedback, the effort grows with time
        return "position" if stiffness else "velocity" if damping else "effort"

    def _read_law(
        self, number: int, command: Command, gear: float, length: float, pulls: Sequence[tuple[int, float]]
    ) -> tuple[Mapping[str, float] | None, float | None]:
        """Return the law of an actuator, by the names of `urdf.robot.Servo`, and the greatest effort at the joint.

        `length` is the actuator's at position zero of the joint. The law is None if no `Servo` has it.
        """
        model, limits = self.scene.model, dict[str, tuple[float, float]]()

        def limit(quantity: str, ends: Any, scale: float, constant: float = 0.0) -> None:
            """Limit a quantity that is `scale` · the limited one + `constant`, after the limits before."""
            least, most = sorted(scale * float(end) + constant for end in ends)
            lower, upper = limits.get(quantity, (least, most))
            limits[quantity] = min(max(lower, least), most), min(max(upper, least), most)

        gain, (bias, stiffness, damping) = float(model.actuator_gainprm[number][0]), self._bias(number)
        servo, scale, constant = dict[str, float](), gear * gain, gear * bias
        if stiffness:
            servo["position_gain"], scale = -stiffness * gear * gear, -gain / (stiffness * gear)
            constant = -(bias + stiffness * length) / (stiffness * gear)
        elif damping:
            scale, constant = -gain / (damping * gear), -bias / (damping * gear)
        if damping:
            servo["velocity_gain"] = -damping * gear * gear
        # `scale` and `constant` make the joint's reference of ctrl, or of the activation that replaces ctrl
        integrates = model.actuator_dyntype[number] == mujoco.mjtDyn.mjDYN_INTEGRATOR
        reference = "position" if stiffness else "velocity" if damping else "effort"
        at = self.scene.controls[number]
        if model.actuator_ctrllimited[at] and not model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_CLAMPCTRL:
            ctrl = model.actuator_ctrlrange[at]
            limit(command if integrates else reference, ctrl, scale, 0.0 if integrates else constant)
        if model.actuator_actlimited[number]:
            limit(reference, model.actuator_actrange[number], scale, constant)
        if model.actuator_forcelimited[number]:
            limit("effort", model.actuator_forcerange[number], gear)
        limited = [joint for joint, _ in pulls if model.jnt_actfrclimited[joint]]
        if limited and len(pulls) == 1:
            limit("effort", model.jnt_actfrcrange[limited[0]], self.leader(limited[0]).multiplier)
        is_servo = stiffness <= 0 and damping <= 0 and not (integrates and not stiffness)
        # each joint of a tendon cuts its own share of the effort
        is_servo = is_servo and (not limited or len(pulls) == 1)
        for quantity, ends in limits.items():
            words = f"min_{quantity}", f"max_{quantity}"
            servo |= zip(words, ends if quantity == "effort" else rounded(ends), strict=True)
        is_servo = is_servo and all(map(math.isfinite, servo.values()))
        return servo if is_servo else None, _greatest(limits["effort"]) if "effort" in limits else None

    def add_numbers(self, joint: UrdfElement, number: int, kind: str) -> None:
        """Add limits, losses and coupling of a joint to its element."""
        model, motors = self.scene.model, self.motors.get(number, [])
        dof, efforts = model.jnt_dofadr[number], [motor.effort for motor in motors]
        effort = sum(filter(None, efforts)) if efforts and None not in efforts else None
        if model.jnt_actfrclimited[number]:
            own = _greatest(model.jnt_actfrcrange[number])
            effort = own if effort is None else min(own, effort)
        if kind in ("revolute", "continuous", "prismatic"):
            lower, upper = None, None
            if model.jnt_limited[number]:
                lower, upper = map(float, model.jnt_range[number])
                if reference := float(model.qpos0[model.jnt_qposadr[number]]):
                    lower, upper = rounded((lower - reference, upper - reference))
            if kind == "prismatic" and lower is None and effort is not None:
                joint.add("effort")  # in URDF, a limit of a sliding joint has a range
            elif effort is not None or lower is not None:
                joint.add("limit", lower=lower, upper=upper, effort=effort)
        damping, friction, armature = model.dof_damping[dof], model.dof_frictionloss[dof], model.dof_armature[dof]
        stiffness = model.jnt_stiffness[number] if kind != "ball" else 0.0
        if kind != "floating" and (damping or friction or armature or stiffness):
            friction, armature = (None if kind == "ball" else value or None for value in (friction, armature))
            spring: dict[str, Any] = {}
            if stiffness:
                place = model.jnt_qposadr[number]
                (reference,) = rounded([model.qpos_spring[place] - model.qpos0[place]])
                spring = {"spring_stiffness": stiffness} | ({"spring_reference": reference} if reference else {})
            joint.add("dynamics", damping=damping, friction=friction, armature=armature, **spring)
        if number in self.followers:
            leader, multiplier, offset = self.followers[number]
            joint.add("mimic", joint=self.scene.joints[leader], multiplier=multiplier, offset=offset)

    def add_control(self, robot: UrdfElement) -> None:
        """Add the motors, their gears, and the starts of joints. With any motor, a joint without one is passive."""
        scene = self.scene
        starts = next((self.positions(key) for key in range(scene.model.nkey) if scene.name("key", key) == HOME), {})
        if not self.motors and not starts:
            return
        control = robot.add("ros2_control", name="MuJoCo", type="system")
        for number in filter(self._has_axis, self.joints):
            motors = self.motors.get(number, [])
            if number in self.followers or not (motors or starts or self.motors):
                continue
            line = scene.line("actuator", motors[0].actuator) if motors else scene.line("joint", number)
            joint = control.add("joint", line, name=scene.joints[number])
            if motors or not self.motors:
                command = joint.add("command_interface", name=motors[0].command if motors else "position")
                for field, value in (motors[0].servo or {}).items() if motors else ():
                    command.add("param", text=repr(value), name=field)
            state = joint.add("state_interface", name="position")
            if starts:
                state.add("param", text=repr(starts[number]), name="initial_value")
        for number, motors in self.motors.items():
            if motors[0].gear != 1:
                line, name = scene.line("actuator", motors[0].actuator), scene.name("actuator", motors[0].actuator)
                gear = control.add("transmission", line, name=name or scene.joints[number])
                gear.add("plugin", text="transmission_interface/SimpleTransmission")
                joint = gear.add("joint", name=scene.joints[number])
                joint.add("mechanical_reduction", text=repr(motors[0].gear))

    def positions(self, key: int) -> dict[int, float]:
        """Return the positions of the joints at a key."""
        model = self.scene.model
        places = {joint: model.jnt_qposadr[joint] for joint in self.joints if self._has_axis(joint)}
        return {joint: rounded([model.key_qpos[key][at] - model.qpos0[at]])[0] for joint, at in places.items()}

    def poses(self, key: int) -> Iterator[int]:
        """Yield the ball and free joints that have another pose at a key: no model begins there."""
        model = self.scene.model
        for joint in self.joints:
            at, size = model.jnt_qposadr[joint], _SIZES.get(int(model.jnt_type[joint]), 0)
            if (model.key_qpos[key][at : at + size] != model.qpos0[at : at + size]).any():
                yield joint


def _greatest(limits: Any) -> float:
    return float(max(abs(limits[0]), abs(limits[1])))

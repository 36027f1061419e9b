"""A robot as its URDF describes it: frozen values in SI units, source order kept.

Lengths are in metres, angles in radians, masses in kilograms, inertias in kg·m². `rpy` are the
fixed-axis roll, pitch and yaw angles of URDF. What a URDF leaves out and its specification gives no
number for stays None; all other defaults are those of ROS's urdfdom.

These values refer to each other in one direction only, so Python need not search them for reference cycles
(`gc=False`): that would take a third of the time that the daemon has for a changed mass of 1,000 links.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, TypeAlias, get_args

import msgspec

Vector: TypeAlias = tuple[float, float, float]

JointType = Literal["fixed", "continuous", "revolute", "prismatic", "planar", "floating"]
SensorKind = Literal["imu", "force_torque", "camera", "lidar"]
Command = Literal["position", "velocity", "effort"]
Motion = Literal["rotational", "translational"]
MOTIONS: tuple[Motion, ...] = get_args(Motion)


class JointKind(msgspec.Struct, frozen=True):
    """What follows from the type of a joint; how far it moves its child is in `kinematics.poses.motion`."""

    does: str
    """For the documentation of generated models."""
    motion: Motion | None = None
    """Kind of motion of a joint with one degree of freedom: these alone have flanges, mimic and are mimicked."""
    has_axis: bool = False
    """Also whether damping and friction have an effect."""
    has_limits: bool = False
    """Of its position."""


JOINT_KINDS: Mapping[JointType, JointKind] = {
    "fixed": JointKind("does not move"),
    "continuous": JointKind("turns without end stops", "rotational", has_axis=True),
    "revolute": JointKind("turns within its limits", "rotational", has_axis=True, has_limits=True),
    "prismatic": JointKind("slides within its limits", "translational", has_axis=True, has_limits=True),
    "planar": JointKind("slides in a plane and turns about its normal", has_axis=True),
    "floating": JointKind("moves freely"),
}
MOTION_KINDS: Mapping[JointType, Motion] = {name: kind.motion for name, kind in JOINT_KINDS.items() if kind.motion}


class Origin(msgspec.Struct, frozen=True, gc=False):
    """Pose of a child frame in its parent frame."""

    xyz: Vector = (0.0, 0.0, 0.0)
    rpy: Vector = (0.0, 0.0, 0.0)


class Box(msgspec.Struct, frozen=True, gc=False, tag="box", tag_field="kind"):
    """A box, centred; `size` along x, y and z."""

    size: Vector


class Cylinder(msgspec.Struct, frozen=True, gc=False, tag="cylinder", tag_field="kind"):
    """A cylinder along z, centred."""

    radius: float
    length: float


class Capsule(msgspec.Struct, frozen=True, gc=False, tag="capsule", tag_field="kind"):
    """A cylinder along z with half spheres at both ends, centred; `length` without the half spheres."""

    radius: float
    length: float


class Sphere(msgspec.Struct, frozen=True, gc=False, tag="sphere", tag_field="kind"):
    """A sphere, centred."""

    radius: float


class Mesh(msgspec.Struct, frozen=True, gc=False, tag="mesh", tag_field="kind"):
    """A mesh file, by its URI as written."""

    filename: str
    scale: Vector = (1.0, 1.0, 1.0)


Geometry: TypeAlias = Box | Cylinder | Capsule | Sphere | Mesh


class Material(msgspec.Struct, frozen=True, gc=False):
    """A material, already looked up through the whole robot; `rgba` in 0 to 1."""

    name: str = ""
    rgba: tuple[float, float, float, float] | None = None


class Visual(msgspec.Struct, frozen=True, gc=False):
    """What a link looks like: one of its shapes."""

    geometry: Geometry
    origin: Origin = Origin()
    name: str = ""
    material: Material | None = None


class Collision(msgspec.Struct, frozen=True, gc=False):
    """What of a link touches other things: one of its shapes."""

    geometry: Geometry
    origin: Origin = Origin()
    name: str = ""


class Inertia(msgspec.Struct, frozen=True, gc=False):
    """Inertia tensor about the centre of mass, in the axes of the inertial frame."""

    ixx: float = 0.0
    ixy: float = 0.0
    ixz: float = 0.0
    iyy: float = 0.0
    iyz: float = 0.0
    izz: float = 0.0


class Inertial(msgspec.Struct, frozen=True, gc=False):
    """Mass properties; `origin` places the inertial frame, whose origin is the centre of mass."""

    mass: float = 0.0
    origin: Origin = Origin()
    inertia: Inertia = Inertia()


class Contact(msgspec.Struct, frozen=True, gc=False, rename="camel", omit_defaults=True):
    """How the collisions of a link feel at the ground; None for what the ground itself says."""

    mu: float | None = None
    kp: float | None = None
    """Stiffness of a point, in N/m."""
    kd: float | None = None
    """Its damping beside that of the ground, in N·s/m."""
    min_depth: float | None = None
    """How deep in the ground a point is without a force."""


class Link(msgspec.Struct, frozen=True, gc=False):
    """A rigid body; without `inertial` it is massless."""

    name: str
    inertial: Inertial | None = None
    visuals: tuple[Visual, ...] = ()
    collisions: tuple[Collision, ...] = ()
    contact: Contact | None = None


class Limit(msgspec.Struct, frozen=True, gc=False):
    """Limits of a joint. A position limit that is left out is 0, as in urdfdom; None is no limit."""

    lower: float = 0.0
    upper: float = 0.0
    effort: float | None = None
    velocity: float | None = None
    acceleration: float | None = None
    deceleration: float | None = None
    """That of `acceleration` if it is None."""
    jerk: float | None = None


class Dynamics(msgspec.Struct, frozen=True, gc=False):
    """Losses of a joint: viscous `damping` (N·m·s/rad or N·s/m), dry `friction` (N·m or N)."""

    damping: float = 0.0
    friction: float = 0.0
    armature: float | None = None
    """Inertia that the drive adds at the joint (kg·m² or kg), as in MuJoCo."""


class Transmission(msgspec.Struct, frozen=True, gc=False):
    """The gear of a drive: position of the motor = `reduction` · (position of the joint - `offset`)."""

    reduction: float = 1.0
    offset: float = 0.0
    rotor_inertia: float | None = None
    """Of the motor, on its own side of the gear; in kg·m²."""


class Mimic(msgspec.Struct, frozen=True, gc=False):
    """Position = `multiplier` · position of `joint` + `offset`."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


class Calibration(msgspec.Struct, frozen=True, gc=False):
    """Positions of the reference edges."""

    rising: float | None = None
    falling: float | None = None


class SafetyController(msgspec.Struct, frozen=True, gc=False):
    """Soft limits and gains of a safety controller."""

    k_velocity: float = 0.0
    k_position: float = 0.0
    soft_lower_limit: float = 0.0
    soft_upper_limit: float = 0.0


class Joint(msgspec.Struct, frozen=True, gc=False):
    """A joint from link `parent` to link `child`; `axis` is a unit vector in the joint frame."""

    name: str
    type: JointType
    parent: str
    child: str
    origin: Origin = Origin()
    axis: Vector = (1.0, 0.0, 0.0)
    limit: Limit | None = None
    dynamics: Dynamics | None = None
    mimic: Mimic | None = None
    calibration: Calibration | None = None
    safety_controller: SafetyController | None = None
    actuated: bool = False
    """Whether a `<transmission>` or `<ros2_control>` of the robot drives it."""
    transmission: Transmission | None = None
    """None if there is no gear: neither reduction nor offset nor rotor."""
    command: Command = "position"
    """What `<ros2_control>` gives the joint."""


def reflected_inertia(joint: Joint) -> float | None:
    """Return what the drive adds to the inertia about or along the axis; None if the source gives nothing."""
    armature = joint.dynamics.armature if joint.dynamics else None
    rotor = joint.transmission.rotor_inertia if joint.transmission else None
    if joint.transmission is None or rotor is None:
        return armature
    return (armature or 0.0) + rotor * joint.transmission.reduction**2


def effective(joint: Joint) -> Joint:
    """Return the joint without what has no effect on one of its type. Records are made from this."""
    kind = JOINT_KINDS[joint.type]
    limit, dynamics = joint.limit if kind.motion else None, joint.dynamics if kind.has_axis else None
    if limit is not None and not kind.has_limits:
        limit = msgspec.structs.replace(limit, lower=0.0, upper=0.0)
    if dynamics is not None and not kind.motion:
        dynamics = Dynamics(dynamics.damping, dynamics.friction)
    return msgspec.structs.replace(
        joint,
        axis=joint.axis if kind.has_axis else (1.0, 0.0, 0.0),
        limit=limit,
        dynamics=dynamics,
        mimic=joint.mimic if kind.motion else None,
        calibration=joint.calibration if kind.motion else None,
        safety_controller=joint.safety_controller if kind.motion else None,
        transmission=joint.transmission if kind.motion else None,
        command=joint.command if kind.motion and joint.mimic is None else "position",
    )


def structure(joint: Joint) -> Joint:
    """Return an effective joint without its numbers and its drive. Models are made from this."""
    dynamics = None if joint.dynamics is None else Dynamics()
    mimic = None if joint.mimic is None else Mimic(joint.mimic.joint)
    limit = Limit(acceleration=0.0) if limits_acceleration(joint) else None
    return Joint(joint.name, joint.type, joint.parent, joint.child, limit=limit, dynamics=dynamics, mimic=mimic)


def limits_acceleration(joint: Joint) -> bool:
    """Return whether an effective joint has a limit of acceleration or deceleration, which its model checks."""
    limit = joint.limit
    return limit is not None and (limit.acceleration is not None or limit.deceleration is not None)


class Camera(msgspec.Struct, frozen=True, gc=False):
    """Numbers of a camera; 0 for what the source does not say."""

    width: float = 0.0
    height: float = 0.0
    horizontal_angle: float = 0.0
    near: float = 0.0
    far: float = 0.0


class Lidar(msgspec.Struct, frozen=True, gc=False):
    """Numbers of a laser scanner; 0 for what the source does not say."""

    samples: float = 0.0
    min_angle: float = 0.0
    max_angle: float = 0.0
    vertical_samples: float = 0.0
    vertical_min_angle: float = 0.0
    vertical_max_angle: float = 0.0
    min_range: float = 0.0
    max_range: float = 0.0


class Sensor(msgspec.Struct, frozen=True, gc=False):
    """A sensor on the link `at`, or for force and torque in the joint of that name; `origin` is its place on the link.

    The wrench is about the origin of the joint.
    """

    name: str
    kind: SensorKind
    at: str
    origin: Origin = Origin()
    """Of a force-torque sensor, the axes alone."""
    update_rate: float = 0.0
    camera: Camera | None = None
    lidar: Lidar | None = None
    in_parent: bool = False
    """Whether the wrench is in the axes of the parent link, not of the child."""
    on_child: bool = False
    """Whether the wrench is what the parent does to the child, not the other way round."""


class Extension(msgspec.Struct, frozen=True, gc=False):
    """An element that urdfsync keeps but does not model: for example transmission, gazebo or sensor.

    `owner` says where it stands (`""` for the robot, `link wheel`, `joint elbow`), `text` is its
    XML in canonical form.
    """

    owner: str
    tag: str
    text: str


class Robot(msgspec.Struct, frozen=True, gc=False):
    """A whole robot: links and joints form one tree (see `validate`)."""

    name: str
    links: tuple[Link, ...] = ()
    joints: tuple[Joint, ...] = ()
    extensions: tuple[Extension, ...] = ()
    sensors: tuple[Sensor, ...] = ()

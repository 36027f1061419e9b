"""A robot as its URDF describes it: frozen values in SI units, in the order of the source.

Lengths are in metres, angles in radians, masses in kilograms, inertias in kg·m². `rpy` are the fixed-axis roll, pitch
and yaw angles of URDF. A missing value without a default in the specification is None; all other defaults are those of
ROS's urdfdom. A new field defaults to None: another default would change each recorded robot.

The values have no reference cycles, so Python need not search for cycles (`gc=False`). With 1,000 links the search
would take a third of the daemon's time for a changed mass.
"""

# no `from __future__ import annotations`: msgspec would compile each annotation, which takes 5 of 250 ms of a build
import operator
from collections.abc import Mapping, Sequence
from typing import Annotated, Literal, NamedTuple, TypeAlias, TypeVar, get_args

import msgspec
from msgspec.structs import replace

Vector: TypeAlias = tuple[float, float, float]
_X: Vector = (1.0, 0.0, 0.0)


class UnitName(NamedTuple):
    """Annotates a number with its unit, in the words of a report."""

    name: str
    sliding: str | None = None
    """The unit for a sliding joint, if `name` is the unit for a turning joint. Other joints have no unit."""
    is_signed: bool = False
    """Whether a limit or a number of the dynamics in this unit may be negative."""


_NAME = operator.attrgetter("name")
_LENGTH, _ANGLE, _INERTIA = UnitName("m"), UnitName("rad"), UnitName("kg·m²")
_POSITION, _LOAD, _LOSS = UnitName("rad", "m", is_signed=True), UnitName("N·m", "N"), UnitName("N·m·s/rad", "N·s/m")
_SPEED, _ACCELERATION, _STIFFNESS = UnitName("rad/s", "m/s"), UnitName("rad/s²", "m/s²"), UnitName("N·m/rad", "N/m")


def unit_of(struct: type[msgspec.Struct], field: str) -> UnitName:
    """Return the unit of a number."""
    unit: UnitName
    (unit,) = struct.__annotations__[field].__metadata__
    return unit


JointType = Literal["fixed", "continuous", "revolute", "prismatic", "planar", "floating", "ball"]
SensorKind = Literal["imu", "accelerometer", "gyroscope", "force_torque", "camera", "lidar"]
LoopKind = Literal["ball", "revolute", "universal", "fixed"]
Command = Literal["position", "velocity", "effort"]
Motion = Literal["rotational", "translational"]
MOTIONS: tuple[Motion, ...] = get_args(Motion)


class JointKind(msgspec.Struct, frozen=True):
    """The properties of a type of joint; `kinematics.poses.motion` has the motion itself."""

    does: str
    """The motion in words, for the documentation of generated models."""
    motion: Motion | None = None
    """Kind of motion of a joint with one degree of freedom; other joints have no flanges and no `mimic`."""
    has_axis: bool = False
    """Whether the joint has an axis: then damping and friction act. On a ball joint, only damping acts."""
    has_limits: bool = False
    """Whether the position of the joint has limits."""


JOINT_KINDS: Mapping[JointType, JointKind] = {
    "fixed": JointKind("does not move"),
    "continuous": JointKind("turns without end stops", "rotational", has_axis=True),
    "revolute": JointKind("turns within its limits", "rotational", has_axis=True, has_limits=True),
    "prismatic": JointKind("slides within its limits", "translational", has_axis=True, has_limits=True),
    "planar": JointKind("slides in a plane and turns about its normal", has_axis=True),
    "floating": JointKind("moves freely"),
    "ball": JointKind("turns in all directions"),
}
MOTION_KINDS: Mapping[JointType, Motion] = {name: kind.motion for name, kind in JOINT_KINDS.items() if kind.motion}


class Output(NamedTuple):
    """A vector, or a single number, that a sensor measures."""

    name: str
    """The name of the output in the library's class."""
    unit: str
    """The unit as Modelica writes it."""
    quantity: str
    """In words."""
    is_vector: bool = True


class SensorModel(msgspec.Struct, frozen=True):
    """The properties of a kind of sensor."""

    name: str
    """The class of such a sensor in the library's `Sensors`."""
    at: Literal["link", "joint"] = "link"
    outputs: tuple[Output, ...] = ()
    """The outputs of Run for such a sensor."""
    has_frame: bool = False
    """Whether the robot model has a connector at the sensor's frame. The user's model of a camera may connect there."""
    record: str = "Sensor"
    """The class in the library's `Records` with the sensor's numbers."""
    types: tuple[str, ...] = ()
    """Further names of the kind, as Gazebo's attribute `type` or as an element inside of a sensor of URDF."""
    states: tuple[str, ...] = ()
    """First words of the state interfaces that such a sensor has in ros2_control."""


_GAIN, _TURN = Output("a", "m/s2", "acceleration minus gravity"), Output("w", "rad/s", "angular velocity")
SENSOR_KINDS: Mapping[SensorKind, SensorModel] = {
    "imu": SensorModel("Imu", outputs=(_GAIN, _TURN), states=("angular_velocity", "linear_acceleration")),
    "accelerometer": SensorModel("Imu", outputs=(_GAIN,)),
    "gyroscope": SensorModel("Imu", outputs=(_TURN,)),
    "force_torque": SensorModel(
        "ForceTorque",
        "joint",
        (Output("f", "N", "force"), Output("t", "N.m", "torque")),
        states=("force", "torque"),
    ),
    "camera": SensorModel(
        "Camera",
        has_frame=True,
        record="Camera",
        types=("depth", "depth_camera", "rgbd", "rgbd_camera", "wideanglecamera"),
    ),
    "lidar": SensorModel("Lidar", has_frame=True, record="Lidar", types=("ray", "gpu_ray", "gpu_lidar")),
}
"""Each kind by its name, which is also its `type` in Gazebo and iDynTree.

iDynTree puts accelerometers and gyroscopes at a link, force-torque sensors at `<parent joint="…"/>` (its page on
extensions of URDF for sensors).
"""


class Origin(msgspec.Struct, frozen=True, gc=False):
    """Pose of a child frame in its parent frame."""

    xyz: Annotated[Vector, _LENGTH] = (0.0, 0.0, 0.0)
    rpy: Annotated[Vector, _ANGLE] = (0.0, 0.0, 0.0)


class Box(msgspec.Struct, frozen=True, gc=False, tag="box", tag_field="kind"):
    """A box, centred; `size` along x, y and z."""

    size: Annotated[Vector, _LENGTH]


class Cylinder(msgspec.Struct, frozen=True, gc=False, tag="cylinder", tag_field="kind"):
    """A cylinder along z, centred."""

    radius: Annotated[float, _LENGTH]
    length: Annotated[float, _LENGTH]


class Capsule(msgspec.Struct, frozen=True, gc=False, tag="capsule", tag_field="kind"):
    """A cylinder along z with half spheres at both ends, centred; `length` without the half spheres."""

    radius: Annotated[float, _LENGTH]
    length: Annotated[float, _LENGTH]


class Sphere(msgspec.Struct, frozen=True, gc=False, tag="sphere", tag_field="kind"):
    """A sphere, centred."""

    radius: Annotated[float, _LENGTH]


class Ellipsoid(msgspec.Struct, frozen=True, gc=False, tag="ellipsoid", tag_field="kind"):
    """An ellipsoid, centred; `radii` are its half axes along x, y and z."""

    radii: Annotated[Vector, _LENGTH]


class Mesh(msgspec.Struct, frozen=True, gc=False, tag="mesh", tag_field="kind"):
    """A mesh file; `filename` is the URI as written."""

    filename: str
    scale: Vector = (1.0, 1.0, 1.0)


Primitive: TypeAlias = Box | Cylinder | Capsule | Sphere | Ellipsoid
"""A shape that its numbers describe, without a file."""
Geometry: TypeAlias = Primitive | Mesh
SHAPES: Mapping[str, type[Geometry]] = {str(kind.__struct_config__.tag): kind for kind in get_args(Geometry)}
"""Each shape by its element in `<geometry>`."""


class Material(msgspec.Struct, frozen=True, gc=False):
    """A material, looked up in the whole robot; `rgba` is from 0 to 1."""

    name: str = ""
    rgba: tuple[float, float, float, float] | None = None


class Visual(msgspec.Struct, frozen=True, gc=False):
    """A visible shape of a link."""

    geometry: Geometry
    origin: Origin = Origin()
    name: str = ""
    material: Material | None = None
    number: Annotated[int, msgspec.Meta(ge=1)] | None = None
    """The lasting number in the names of its components; None for its place among the link's visuals."""


class Collision(msgspec.Struct, frozen=True, gc=False):
    """A shape with which a link touches other bodies."""

    geometry: Geometry
    origin: Origin = Origin()
    name: str = ""
    number: Annotated[int, msgspec.Meta(ge=1)] | None = None
    """The lasting number in the names of its components; None for its place among the link's collisions."""


_Shape = TypeVar("_Shape", Visual, Collision)


def shape_numbers(shapes: Sequence[Visual | Collision]) -> list[int]:
    """Return the number of each of the visuals, or of the collisions, of a link."""
    return [shape.number or place for place, shape in enumerate(shapes, 1)]


def by_number(shapes: Sequence[_Shape]) -> dict[int, _Shape]:
    """Return the visuals or collisions of a link by their numbers, in the order of the numbers."""
    return dict(sorted(zip(shape_numbers(shapes), shapes, strict=True), key=operator.itemgetter(0)))


class Inertia(msgspec.Struct, frozen=True, gc=False):
    """Inertia tensor about the centre of mass, in the axes of the inertial frame."""

    ixx: Annotated[float, _INERTIA] = 0.0
    ixy: Annotated[float, _INERTIA] = 0.0
    ixz: Annotated[float, _INERTIA] = 0.0
    iyy: Annotated[float, _INERTIA] = 0.0
    iyz: Annotated[float, _INERTIA] = 0.0
    izz: Annotated[float, _INERTIA] = 0.0

    @property
    def trace(self) -> float:
        """The sum of the three moments, in kg·m²; the same in all axes."""
        return self.ixx + self.iyy + self.izz


class Inertial(msgspec.Struct, frozen=True, gc=False):
    """Mass and inertia; `origin` places the inertial frame at the centre of mass."""

    mass: Annotated[float, UnitName("kg")] = 0.0
    origin: Origin = Origin()
    inertia: Inertia = Inertia()


class Contact(msgspec.Struct, frozen=True, gc=False, rename="camel", omit_defaults=True):
    """Contact properties of a link's collisions with the ground; None stands for the ground's value."""

    mu: float | None = None
    kp: Annotated[float | None, UnitName("N/m")] = None
    """Stiffness of a contact point."""
    kd: Annotated[float | None, UnitName("N·s/m")] = None
    """Damping of a contact point, added to the damping of the ground."""
    min_depth: Annotated[float | None, _LENGTH] = None
    """Up to this depth in the ground, a contact point has no force."""


class Link(msgspec.Struct, frozen=True, gc=False):
    """A rigid body; without `inertial` it is massless."""

    name: str
    inertial: Inertial | None = None
    visuals: tuple[Visual, ...] = ()
    collisions: tuple[Collision, ...] = ()
    contact: Contact | None = None


class Limit(msgspec.Struct, frozen=True, gc=False):
    """Limits of a joint; None means no limit. A missing limit of position is 0, as in urdfdom."""

    lower: Annotated[float, _POSITION] = 0.0
    upper: Annotated[float, _POSITION] = 0.0
    effort: Annotated[float | None, _LOAD] = None
    velocity: Annotated[float | None, _SPEED] = None
    acceleration: Annotated[float | None, _ACCELERATION] = None
    deceleration: Annotated[float | None, _ACCELERATION] = None
    """None stands for the value of `acceleration`."""
    jerk: Annotated[float | None, UnitName("rad/s³", "m/s³")] = None


class Dynamics(msgspec.Struct, frozen=True, gc=False):
    """Losses of a joint: viscous `damping`, dry `friction`; its armature, and its mechanisms."""

    damping: Annotated[float, _LOSS] = 0.0
    friction: Annotated[float, _LOAD] = 0.0
    armature: Annotated[float | None, UnitName("kg·m²", "kg")] = None
    """Inertia that the drive adds at the joint, as in MuJoCo's `armature`."""
    spring_stiffness: Annotated[float | None, _STIFFNESS] = None
    """A spring pulls with `spring_stiffness` · (`spring_reference` - position), as in SDFormat."""
    spring_reference: Annotated[float | None, _POSITION] = None
    """Position at which the spring is relaxed; None stands for 0."""


LOSSES: tuple[str, ...] = ("damping", "friction")
"""The numbers of `Dynamics` that act against the motion. A further one is None by default, which records leave out."""
MECHANISMS: Mapping[str, str] = {"spring": "spring_stiffness"}
"""Parts that push or pull a joint, by their names in templates; each with the number of `Dynamics` that states it.

A mechanism stores energy, and may carry a weight.
"""


class Transmission(msgspec.Struct, frozen=True, gc=False):
    """The gear of a drive.

    Position of the motor = `reduction` · (position of the joint - `offset`) + `joint_reduction` · position of `joint`.
    """

    reduction: Annotated[float, UnitName("", "rad/m")] = 1.0
    offset: Annotated[float, _POSITION] = 0.0
    rotor_inertia: Annotated[float | None, _INERTIA] = None
    """Inertia of the motor, on the motor's side of the gear."""
    joint: str | None = None
    """Another joint that the motor moves, as in a differential; None for the motor of one joint."""
    joint_reduction: float | None = None


class Servo(msgspec.Struct, frozen=True, gc=False):
    """The law of a drive: the effort that it gives for a command, all at the joint's side of the gear.

    Effort = `position_gain` · (reference - position) - `velocity_gain` · velocity. The reference is the command, or the
    integral of a commanded velocity. Without `position_gain`, a commanded velocity gives `velocity_gain` · (command -
    velocity). A commanded effort is only limited. None stands for 0, and for no limit.
    """

    position_gain: Annotated[float | None, _STIFFNESS] = None
    velocity_gain: Annotated[float | None, _LOSS] = None
    min_position: Annotated[float | None, _POSITION] = None
    """Limits of the reference."""
    max_position: Annotated[float | None, _POSITION] = None
    min_velocity: Annotated[float | None, _SPEED] = None
    """Limits of a commanded velocity."""
    max_velocity: Annotated[float | None, _SPEED] = None
    min_effort: Annotated[float | None, _LOAD] = None
    max_effort: Annotated[float | None, _LOAD] = None


class Motor(msgspec.Struct, frozen=True, gc=False):
    """A row of the catalogue with numbers for a joint, and the names of these numbers."""

    row: str
    numbers: tuple[str, ...]


class Mimic(msgspec.Struct, frozen=True, gc=False):
    """Position = `multiplier` · position of `joint` + `offset`, by `<mimic>`, `<ros2_control>` or a plugin."""

    joint: str
    multiplier: float = 1.0
    offset: Annotated[float, _POSITION] = 0.0


class Calibration(msgspec.Struct, frozen=True, gc=False):
    """Positions of the reference edges."""

    rising: Annotated[float | None, _POSITION] = None
    falling: Annotated[float | None, _POSITION] = None


class SafetyController(msgspec.Struct, frozen=True, gc=False):
    """Soft limits and gains of a safety controller."""

    k_velocity: Annotated[float, _LOSS] = 0.0
    k_position: Annotated[float, UnitName("1/s")] = 0.0
    soft_lower_limit: Annotated[float, _POSITION] = 0.0
    soft_upper_limit: Annotated[float, _POSITION] = 0.0


class Joint(msgspec.Struct, frozen=True, gc=False):
    """A joint from link `parent` to link `child`; `axis` is a unit vector in the joint frame."""

    name: str
    type: JointType
    parent: str
    child: str
    origin: Origin = Origin()
    axis: Vector = _X
    limit: Limit | None = None
    dynamics: Dynamics | None = None
    mimic: Mimic | None = None
    calibration: Calibration | None = None
    safety_controller: SafetyController | None = None
    actuated: bool | None = None
    """Whether a `<transmission>`, `<ros2_control>` or plugin of the robot drives the joint."""
    measured: bool | None = None
    """Whether such elements only measure the joint."""
    transmission: Transmission | None = None
    """The gear; None without reduction, offset and rotor."""
    command: Command | None = None
    """Quantity by which the source commands the joint; None for the position."""
    start: Annotated[float | None, _POSITION] = None
    """Position at the start of a simulation; None leaves it to `kinematics.poses.start_positions`."""
    motor: Motor | None = None
    servo: Servo | None = None
    """The law of the drive; None if the drive moves the joint as commanded, or gives the commanded effort."""


STATED_ELSEWHERE: frozenset[str] = frozenset("actuated measured transmission command start motor servo number".split())
"""Fields of `Joint` and of shapes that their elements do not state: other elements, the configuration, a catalogue or
the last build do."""


class Loop(msgspec.Struct, frozen=True, gc=False):
    """A joint that closes a loop: it holds a frame of link `child` at a frame of link `parent`.

    Without loops, the links and joints of a robot form a tree. A loop has no drive, no limits and no losses.
    """

    name: str
    kind: LoopKind
    parent: str
    child: str
    origin: Origin = Origin()
    """Pose of the frame in the parent link."""
    child_origin: Origin = Origin()
    """Pose of the frame in the child link; in a closed loop both frames have the same origin."""
    axis: Vector = (0.0, 0.0, 1.0)
    """Unit vector: a revolute joint's axis in both frames, or a universal joint's first axis in the parent's frame."""
    child_axis: Vector = (1.0, 0.0, 0.0)
    """The second axis of a universal joint, in the child's frame, at right angles to the first."""


def reflected_inertia(joint: Joint) -> float | None:
    """Return the inertia of the drive about or along the axis; None if the source states no such inertia."""
    armature = joint.dynamics.armature if joint.dynamics else None
    rotor = joint.transmission.rotor_inertia if joint.transmission else None
    if joint.transmission is None or rotor is None:
        return armature
    return (armature or 0.0) + rotor * joint.transmission.reduction * joint.transmission.reduction


_NO_DRIVE: Mapping[str, None] = dict.fromkeys(("command", "servo", "start"))
"""Fields without effect on a joint that follows another one."""
_NO_POSITION: Mapping[str, None] = dict.fromkeys(
    ("limit", "mimic", "calibration", "safety_controller", "transmission", *_NO_DRIVE)
)
"""Fields without effect on a joint that has no single position."""


def effective(joint: Joint) -> Joint:
    """Return the joint without numbers that have no effect on its type, as records have it."""
    kind, limit = JOINT_KINDS[joint.type], joint.limit
    if kind.motion:
        if limit is not None and not kind.has_limits:
            limit = replace(limit, lower=0.0, upper=0.0)
        return replace(joint, limit=limit, **({} if joint.mimic is None else _NO_DRIVE))
    acting, dynamics = LOSSES if kind.has_axis else ("damping",) if joint.type == "ball" else (), None
    if joint.dynamics and acting:
        dynamics = Dynamics(**{name: getattr(joint.dynamics, name) for name in acting})
    return replace(joint, **_NO_POSITION, axis=joint.axis if kind.has_axis else _X, dynamics=dynamics)


def structure(joint: Joint) -> Joint:
    """Return the data of a joint that the robot model depends on; `model.joint` has the data for the joint's model."""
    mimic = None if joint.mimic is None else Mimic(joint.mimic.joint)
    start = None if joint.start is None else 0.0
    return Joint(joint.name, joint.type, joint.parent, joint.child, mimic=mimic, start=start)


def limits_acceleration(joint: Joint) -> bool:
    """Return whether the model of an effective joint checks a limit of acceleration or deceleration."""
    limit = joint.limit
    return limit is not None and (limit.acceleration is not None or limit.deceleration is not None)


class Camera(msgspec.Struct, frozen=True, gc=False):
    """Numbers of a camera; a missing number is 0."""

    width: float = 0.0
    height: float = 0.0
    horizontal_angle: Annotated[float, _ANGLE] = 0.0
    near: Annotated[float, _LENGTH] = 0.0
    far: Annotated[float, _LENGTH] = 0.0


class Lidar(msgspec.Struct, frozen=True, gc=False):
    """Numbers of a laser scanner; a missing number is 0."""

    samples: float = 0.0
    min_angle: Annotated[float, _ANGLE] = 0.0
    max_angle: Annotated[float, _ANGLE] = 0.0
    vertical_samples: float = 0.0
    vertical_min_angle: Annotated[float, _ANGLE] = 0.0
    vertical_max_angle: Annotated[float, _ANGLE] = 0.0
    min_range: Annotated[float, _LENGTH] = 0.0
    max_range: Annotated[float, _LENGTH] = 0.0


class Sensor(msgspec.Struct, frozen=True, gc=False):
    """A sensor on the link `at`, or a force-torque sensor in the joint `at`.

    A force-torque sensor measures about the origin of the joint.
    """

    name: str
    kind: SensorKind
    at: str
    origin: Origin = Origin()
    """Pose of the sensor in its link; for a force-torque sensor, only the axes count."""
    update_rate: Annotated[float, UnitName("Hz")] = 0.0
    camera: Camera | None = None
    lidar: Lidar | None = None
    in_parent: bool = False
    """Whether force and torque are in the axes of the parent link instead of the child link."""
    on_child: bool = False
    """Whether force and torque act from the parent on the child, instead of from the child on the parent."""

    @property
    def is_in_joint(self) -> bool:
        """Whether `at` is a joint."""
        return SENSOR_KINDS[self.kind].at == "joint"


class Robot(msgspec.Struct, frozen=True, gc=False):
    """A whole robot: links and joints form one tree (see `validate`)."""

    name: str
    links: tuple[Link, ...] = ()
    joints: tuple[Joint, ...] = ()
    extensions: Mapping[str, Mapping[str, tuple[str, ...]]] = {}
    """Unmodelled elements, such as `gazebo`, as canonical XML, by place (empty for the robot) and tag."""
    sensors: tuple[Sensor, ...] = ()
    loops: tuple[Loop, ...] = ()

    def by_name(self) -> "Robot":
        """Return the robot with its elements sorted by name: their order in the file has no effect."""
        kinds = {kind: getattr(self, kind) for kind in ("links", "joints", "sensors", "loops")}
        return replace(self, **{kind: tuple(sorted(of_kind, key=_NAME)) for kind, of_kind in kinds.items()})

"""The options of the URDF domain in `urdfsync.toml`, and the libraries that generated packages need."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal, TypeAlias, get_args

import msgspec

from urdfsync.formats.urdf.robot import Command, LoopKind, Vector

USES = (("Modelica", "4.0.0"), ("UrdfSync", "1.0.0"))
"""Libraries that all generated packages need."""

FrictionLaw: TypeAlias = Literal["smooth", "stiction", "lugre"]
MotorNumber: TypeAlias = Literal["effort", "velocity", "damping", "friction", "armature", "reduction", "rotor_inertia"]
_MOTOR_NUMBERS = msgspec.Meta(extra_json_schema={"propertyNames": {"enum": sorted(get_args(MotorNumber))}})
"""Lists the allowed keys as msgspec does from version 0.23 on; earlier ones omit them."""
LeftOut: TypeAlias = Literal["loop-joint", "stray-inertial", "part-left-out"]
"""Codes of errors that the user may allow: a part that the model can't have is left out."""


class LoopFrame(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A frame on a link, in m and rad."""

    link: str
    xyz: Vector = (0.0, 0.0, 0.0)
    rpy: Vector = (0.0, 0.0, 0.0)


class LoopOption(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A joint that closes a loop between two frames. A frame is a link by its URDF name, or a frame on a link."""

    name: Annotated[str, msgspec.Meta(pattern=r"\S")]
    kind: LoopKind
    frames: tuple[str | LoopFrame, str | LoopFrame]
    """The frame of the parent, then the frame of the child."""
    axis: Vector = (0.0, 0.0, 1.0)
    """Axis of a revolute joint, in both frames; for a universal joint its first axis, in the frame of the parent."""
    child_axis: Vector = (1.0, 0.0, 0.0)
    """The second axis of a universal joint, in the frame of the child."""


class Options(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The options of one robot."""

    base: Literal["fixed", "floating"] = "fixed"
    """`fixed`: the root link is bolted down; `floating`: the robot moves freely and touches the ground."""
    collisions: bool = True
    """Whether links have their collision shapes."""
    meshes: Literal["import", "skip"] = "import"
    """Whether the package gets mesh files, or leaves them out."""
    approach: Annotated[tuple[Literal["package", "record"], ...], msgspec.Meta(min_length=1)] = ("package",)
    """`package`: a model per link and joint; `record`: a bench for the generic robot, with the robot's record."""
    driven: tuple[str, ...] | None = None
    """URDF names of the joints that Run and Test drive; None leaves the choice to the source: see `urdf.drives`."""
    commands: Mapping[str, Command] = {}
    """The quantity by which Run drives a joint, by URDF names of joints; for other joints the source decides."""
    start: Mapping[str, float] = {}
    """Positions at the start, in rad or m, by URDF names of joints; for other joints the source decides."""
    friction: FrictionLaw | Mapping[str, FrictionLaw] = "smooth"
    """The law of dry friction: for all joints, or by URDF names of joints."""
    elastic: Literal["none", "all"] | tuple[str, ...] = "none"
    """URDF names of driven joints with a spring and a damper between drive and joint."""
    saturated: Literal["none", "all"] | tuple[str, ...] = "none"
    """URDF names of driven joints. Their drives keep the limits of effort and velocity."""
    drives: Literal["joint", "motor"] = "joint"
    """`motor`: the robot model also has a flange at the motor's side of each gear."""
    catalogue: str = ""
    """Path of the table of motors, from the folder of the configuration."""
    motors: Mapping[str, str] = {}
    """Rows of the catalogue by URDF names of joints. The numbers of the row replace those of the source."""
    motor_columns: Annotated[Mapping[MotorNumber, str | tuple[str, ...]], _MOTOR_NUMBERS] = {}
    """Columns of the catalogue for each number (default: its name); the first filled column counts."""
    frames: Literal["leaves", "all"] | tuple[str, ...] = "leaves"
    """URDF names of links with a frame in the robot model; leaf links always have a frame."""
    inputs: Literal["names", "vector"] = "names"
    """`names`: Run has an input per driven joint; `vector`: one vector of all inputs, in the order of the chain."""

    closed_loops: str = ""
    """Path of a YAML with loops, motors and joints of several axes, from the folder of the configuration."""
    loops: tuple[LoopOption, ...] = ()
    """Joints that close loops, in addition to those of the source."""
    allow: tuple[LeftOut, ...] = ()
    """Errors that become warnings: the faulty parts are left out."""

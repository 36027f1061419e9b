"""The options of the URDF domain in `urdfsync.toml`, and the libraries that generated packages need."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal, TypeAlias, get_args

import msgspec

from urdfsync.urdf.robot import Command, LoopKind, Vector

USES = (("Modelica", "4.0.0"), ("UrdfSync", "0.1.0"))
"""Libraries that all generated packages need."""
# No release notes of Visualization2 are public. The version is that of the published URDFModelica_Tutorial.
_VISUALIZER_USES = {"visualization2": ("Visualization2", "1.1")}
"""Further library of the packages for a visualizer."""


FrictionLaw: TypeAlias = Literal["smooth", "stiction", "lugre"]
MotorNumber: TypeAlias = Literal["effort", "velocity", "damping", "friction", "armature", "reduction", "rotor_inertia"]
_MOTOR_NUMBERS = msgspec.Meta(extra_json_schema={"propertyNames": {"enum": [*get_args(MotorNumber)]}})
"""msgspec leaves the keys of a mapping out of schemas."""
LeftOut: TypeAlias = Literal["loop-joint", "stray-inertial"]
"""Codes of errors about moving parts that can't be in the robot's model."""


class LoopFrame(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A frame on a link, in m and rad."""

    link: str
    xyz: Vector = (0.0, 0.0, 0.0)
    rpy: Vector = (0.0, 0.0, 0.0)


class LoopOption(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A joint that closes a loop, between two frames: links by their URDF names, or frames on them."""

    name: Annotated[str, msgspec.Meta(pattern=r"\S")]
    kind: LoopKind
    frames: tuple[str | LoopFrame, str | LoopFrame]
    """The parent's and the child's."""
    axis: Vector = (0.0, 0.0, 1.0)
    """Axis of a revolute joint in both frames, or the first one of a universal joint, in the frame of the parent."""
    child_axis: Vector = (1.0, 0.0, 0.0)
    """The second axis of a universal joint, in the frame of the child."""


class Options(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The options of one robot."""

    base: Literal["fixed", "floating"] = "fixed"
    """`fixed`: the root link is bolted down; `floating`: a mobile robot that moves freely and touches the ground."""
    visualizer: Literal["standard", "visualization2"] = "standard"
    """The library of shapes: the Modelica Standard Library or the DLR Visualization 2 library."""
    collisions: bool = True
    """Whether links have their collision shapes."""
    meshes: Literal["import", "skip"] = "import"
    """Whether mesh files are brought into the package, or left out."""
    approach: Annotated[tuple[Literal["package", "record"], ...], msgspec.Meta(min_length=1)] = ("package",)
    """`package`: a model per link and joint; `record`: a bench for the generic robot. Both have the robot's record."""
    driven: tuple[str, ...] | None = None
    """URDF names of the joints that Run and Test drive; None leaves it to the source: see `urdfsync.urdf.drives`."""
    commands: Mapping[str, Command] = {}
    """The quantity by which Run drives a joint, by URDF names of joints; the source decides on others."""
    start: Mapping[str, float] = {}
    """Positions at which simulations begin, in rad or m, by URDF names of joints; the source decides on others."""
    friction: FrictionLaw | Mapping[str, FrictionLaw] = "smooth"
    """The law of dry friction: for all joints, or by URDF names of joints."""
    elastic: Literal["none", "all"] | tuple[str, ...] = "none"
    """URDF names of driven joints with a spring and a damper between drive and joint."""
    saturated: Literal["none", "all"] | tuple[str, ...] = "none"
    """URDF names of driven joints whose drives keep their limits of effort and velocity."""
    drives: Literal["joint", "motor"] = "joint"
    """`motor`: the robot model has a flange at the motor's side of each gear, too."""
    catalogue: str = ""
    """The table whose rows have numbers of drives, as a path from the folder of the configuration."""
    motors: Mapping[str, str] = {}
    """Rows of the catalogue by URDF names of joints: their numbers replace those of the source."""
    motor_columns: Annotated[Mapping[MotorNumber, str | tuple[str, ...]], _MOTOR_NUMBERS] = {}
    """Columns of the catalogue by their numbers: the first filled one counts; by default the one of that name."""
    frames: Literal["leaves", "all"] | tuple[str, ...] = "leaves"
    """URDF names of links with a frame in the robot model; leaves always have one."""
    inputs: Literal["names", "vector"] = "names"
    """`names`: Run has a position input per driven joint; `vector`: one for all, in the order of the chain."""

    loops: tuple[LoopOption, ...] = ()
    """Joints that close loops, beside those of the source."""
    allow: tuple[LeftOut, ...] = ()
    """Errors that become warnings: their parts are left out."""

    @property
    def uses(self) -> tuple[tuple[str, str], ...]:
        """Libraries that a package with these options needs, with their versions. Only link models have shapes."""
        library = _VISUALIZER_USES.get(self.visualizer) if "package" in self.approach else None
        return (*USES, library) if library else USES

"""A robot as a picture: bodies with shapes, and the joints between them. The values fit any domain; SI units."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol, TypeAlias

import msgspec

from urdfsync.domain.model import Import, Snapshot, Target

PagePose: TypeAlias = tuple[float, ...]
"""16 numbers of a homogeneous matrix, column after column, as WebGL has them."""
Properties: TypeAlias = Sequence[tuple[str, str]]
"""Properties of an element in words, for people."""


class Shape(msgspec.Struct, frozen=True):
    """A shape of a body."""

    kind: str
    """`visual` or `collision`."""
    form: str
    """`box`, `cylinder`, `capsule`, `sphere`, `ellipsoid` or `mesh`; cylinders and capsules stand along z."""
    size: tuple[float, ...]
    """Edges of a box; half axes of an ellipsoid; radius, and perhaps length without half spheres, of other shapes."""
    pose: PagePose
    """In the frame of the body."""
    color: tuple[float, ...]
    """Red, green, blue and opacity, from 0 to 1."""
    mesh: str = ""
    """The name of the shape's mesh; `pose` includes the mesh's scale."""


class Body(msgspec.Struct, frozen=True):
    """A rigid body."""

    element: str
    """The element in the domain's words: `link hand`."""
    component: str
    """The body's name in the diagram."""
    facts: Properties
    shapes: tuple[Shape, ...] = ()
    mass: float = 0.0
    center: PagePose | None = None
    """The frame of the body's inertia, in the centre of mass; None for a body without mass."""
    inertia: tuple[float, ...] = ()
    """The moments and products xx, xy, xz, yy, yz and zz in this frame."""


class Hinge(msgspec.Struct, frozen=True):
    """A connection of two bodies, which may move."""

    element: str
    """Empty if the connection is only a place in the picture."""
    component: str
    facts: Properties
    parent: str
    child: str
    pose: PagePose
    """The pose of the axis's frame in the parent's frame, at position 0."""
    axis: tuple[float, ...]
    motion: str = ""
    """`rotational` or `translational` along `axis`, `planar` normal to `axis`, `floating`, `ball`; empty if fixed."""
    start: float = 0.0
    way: float = 0.0
    """The distance that a test moves the hinge from the start and back, along a cosine."""
    lower: float | None = None
    upper: float | None = None
    """None for no limit."""
    leader: str = ""
    """The element that the hinge follows; empty if it moves by itself."""
    multiplier: float = 1.0
    offset: float = 0.0
    is_dependent: bool = False
    """Whether loops move the hinge."""


class End(msgspec.Struct, frozen=True):
    """A frame on a body."""

    body: str
    pose: PagePose


class LoopConstraint(msgspec.Struct, frozen=True):
    """A connection of two bodies that hinges already connect.

    The loop's equations hold position and axes of the second end, resolved in the first end.
    """

    element: str
    component: str
    facts: Properties
    ends: tuple[End, End]
    translations: tuple[tuple[float, ...], ...]
    """Directions along which both ends have the same position."""
    rotations: tuple[tuple[tuple[float, ...], tuple[float, ...]], ...]
    """Pairs of directions that stay perpendicular: one of the first end, one of the second."""


class Scene(msgspec.Struct, frozen=True):
    """A whole robot. A hinge stands after the hinge that it follows."""

    bodies: tuple[Body, ...]
    """The root first, each after its parent."""
    hinges: tuple[Hinge, ...]
    missing: tuple[str, ...] = ()
    """Shapes that can't be shown, with reasons, in words."""
    loops: tuple[LoopConstraint, ...] = ()
    height: float | None = None
    """The height of the root above the ground when the robot stands there at its start; None if its base is fixed."""
    noun: str = "robot"
    """The word for the whole scene."""


class PageMesh(msgspec.Struct, frozen=True):
    """The triangles of a mesh as a page shows them."""

    points: int
    faces: int
    content: bytes
    """Three numbers of single precision for each point, in metres, then three points for each face: little-endian."""
    total: int
    """Number of triangles of the file itself."""
    box: tuple[float, ...]
    """The least and the greatest x, y and z of the points."""
    cells: int
    """Number of cells along the longest edge, in each of which corners were merged; 0 if all corners were kept."""


class Pictures(Protocol):
    """Gives pages the picture of a model; a domain's attribute `pictures`. Only meshes are asked for triangles."""

    def scene(
        self, snapshot: Snapshot, imports: Mapping[str, Import], target: Target, options: Any
    ) -> tuple[Scene, Mapping[str, str]]:
        """Return the model as a picture whose joints can be moved, and the import of each mesh by its name. Pure.

        Meshes of one file have one name, also if the model scales or mirrors the meshes. A file that is too large for
        the package has an import without facts.
        """
        ...

    def with_numbers(
        self, snapshot: Snapshot, numbers: Mapping[tuple[str, str], Sequence[float]]
    ) -> tuple[Snapshot, Collection[tuple[str, str]]]:
        """Return a model with other numbers, by element and path in its record, and the places that it lacks. Pure."""
        ...

    def named_poses(self, source: Path, snapshot: Snapshot) -> tuple[Mapping[str, Mapping[str, float]], Sequence[str]]:
        """Return the poses that files beside a source define, as positions of hinges, and faults of the files."""
        ...

    def stated_triangles(self, content: bytes) -> int | None:
        """Return the number of triangles that a mesh file states; None if the file has to be read for this number."""
        ...

    def triangles(self, path: str, content: bytes, key: str, most: int) -> PageMesh | str:
        """Return about `most` triangles of a mesh without the model's scale, or a text that says why there are none.

        The mesh is the imported file at `path`, or, without a path, the file of the dependency `key`.
        """
        ...

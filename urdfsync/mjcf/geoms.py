"""Compares the shapes of a URDF with the geoms of its MJCF: MuJoCo compiles both, with the files of their meshes.

A shape is compared in the frame of its link, with all joints at zero. MuJoCo moves the corners of a mesh to its centre;
in the frame of the link they stand where the file has them, so all corners are compared.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element

import mujoco
import numpy as np

from urdfsync.mjcf.document import MjcfDocument
from urdfsync.mjcf.scene import WORLD, MujocoScene
from urdfsync.urdf.kinematics.poses import angles

_KINDS = {
    "box": (mujoco.mjtGeom.mjGEOM_BOX, ("size",), (0.5, 0.5, 0.5)),
    "sphere": (mujoco.mjtGeom.mjGEOM_SPHERE, ("radius",), (1.0,)),
    "ellipsoid": (mujoco.mjtGeom.mjGEOM_ELLIPSOID, ("radii",), (1.0, 1.0, 1.0)),
    "cylinder": (mujoco.mjtGeom.mjGEOM_CYLINDER, ("radius", "length"), (1.0, 0.5)),
    "capsule": (mujoco.mjtGeom.mjGEOM_CAPSULE, ("radius", "length"), (1.0, 0.5)),
    "mesh": (mujoco.mjtGeom.mjGEOM_MESH, (), ()),
}
"""Kinds of shapes in URDF: MuJoCo's kind, the attributes of their sizes, and MuJoCo's sizes for a size of 1."""
_TENSOR = "ixx", "iyy", "izz", "ixy", "ixz", "iyz"
_TURNING = (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_BALL)
_SHOWN = 2
"""The last group of geoms that MuJoCo's viewers show: these are visuals."""
_PRIMITIVES = _KINDS.keys() - {"mesh"}
_TOLERANCE, _OF_MESHES = 1e-9, 1e-6
"""The greatest errors, relative to the largest number: MuJoCo has corners of meshes in single precision."""


class _Shape(NamedTuple):
    kind: str
    sizes: Any
    """For a mesh, those of its bounding box."""
    place: Any
    """For a mesh, the middle of its bounding box."""
    rest: Any
    """Rotation, or the corners of a mesh."""

    def error(self, other: _Shape) -> float:
        """Return the difference of another shape, relative to the greatest number."""
        if self.kind != other.kind or self.rest.shape != other.rest.shape:
            return np.inf
        first, second = (np.concatenate([np.ravel(part) for part in each[1:]]) for each in (self, other))
        return float(np.abs(first - second).max() / np.abs(first).max())

    def __str__(self) -> str:
        sizes, place = (" ".join(f"{value:.7g}" for value in numbers) for numbers in (self.sizes, self.place))
        turn = " ".join(f"{value:.7g}" for value in angles(self.rest)) if self.kind in _PRIMITIVES else ""
        return f"a {self.kind} of {sizes} at {place}" + (f" turned by {turn}" if turn else "")


def set_inertias(spec: Any, root: Element) -> None:
    """Give links their principal inertias as written: in URDF, MuJoCo before 3.17 loses the turn of `<origin>`."""
    for link in root.iterfind("link[inertial]"):
        inertia, origin = link.find("inertial/inertia"), link.find("inertial/origin")
        values = [float(inertia.get(name, "nan")) for name in _TENSOR] if inertia is not None else [1.0] * 6
        if link.get("name") != WORLD and origin is not None and not any(values[3:]):
            body = spec.body(link.get("name"))
            body.iquat, body.inertia = _quaternion(origin.get("rpy", "0 0 0")), values[:3]
            body.fullinertia = np.full(6, np.nan)


def add_shapes(spec: Any, root: Element, document: MjcfDocument) -> None:
    """Add the shapes of a URDF to MuJoCo's reading of its links; the name of each has its link and its number there."""
    names = {path: name for name, path in document.meshes.items()}
    spec.assets = document.contents
    for link in root.iterfind("link"):
        for number, shape in enumerate(_shapes(link)):
            (geometry,), origin = shape.iterfind("geometry/*"), shape.find("origin")
            file = os.path.join(document.source, "..", geometry.get("filename", ""))  # noqa: PTH118
            mesh = names.get(os.path.normpath(file)) if geometry.tag == "mesh" else ""
            if geometry.tag not in _KINDS or mesh is None:
                continue
            kind, attributes, factors = _KINDS[geometry.tag]
            place = {} if origin is None else origin.attrib
            geom = spec.body(link.get("name")).add_geom(name=f"{link.get('name')} {number}", type=kind)
            geom.pos, geom.quat = _numbers(place.get("xyz", "0 0 0")), _quaternion(place.get("rpy", "0 0 0"))
            geom.contype, geom.conaffinity = 0, 0
            geom.size[: len(factors)] = factors * _numbers(" ".join(geometry.get(name, "") for name in attributes))
            if mesh:  # a shell has no volume that MuJoCo could refuse
                geom.meshname = f"{geom.name} mesh"
                added = spec.add_mesh(name=geom.meshname, file=mesh, inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL)
                added.scale = _numbers(geometry.get("scale", "1 1 1"))


def compare_shapes(scene: MujocoScene, root: Element, urdf: Any) -> tuple[int, list[str]]:
    """Return how many numbers were compared, and a clause about the first shape that differs, if there is one.

    The corners of a mesh count as one rotation.
    """
    total, faults, models = 0, list[str](), (scene.model, urdf)
    source, other = map(mujoco.MjData, models)
    for model, data in zip(models, (source, other), strict=True):
        mujoco.mj_kinematics(model, data)
    shapes = {link.get("name"): _shapes(link) for link in root.iterfind("link")}
    for body in (body for body in scene.bodies if body or scene.root == 0):
        link, same = scene.links[body], urdf.body(scene.links[body]).id
        # the origin of a link is that of the last joint of its body
        anchors = [source.xanchor[n] for n in scene.joints_of(body) if int(scene.model.jnt_type[n]) in _TURNING]
        frames = ([source.xpos[body], *anchors][-1], source.xmat[body]), (other.xpos[same], other.xmat[same])
        geoms = list(_expected(scene, body))
        if len(geoms) != len(shapes[link]):
            faults.append(f"link {link} has {len(shapes[link])} of {len(geoms)} shapes")
            continue
        for number, (geom, shape) in enumerate(zip(geoms, shapes[link], strict=True)):
            expected, found = _shape(scene.model, source, geom, frames[0]), None
            if (twin := mujoco.mj_name2id(urdf, mujoco.mjtObj.mjOBJ_GEOM, f"{link} {number}")) >= 0:
                found = _shape(urdf, other, twin, frames[1])
            elif shape.find("geometry/mesh") is None and expected.kind not in _PRIMITIVES:
                continue  # the reader of the URDF tells that it leaves the shape out
            total += expected.sizes.size + 3 + 9
            if found is None or not expected.error(found) <= (_OF_MESHES if expected.kind == "mesh" else _TOLERANCE):
                file, line = scene.document.place(scene.line("geom", geom))
                where = f"{os.path.relpath(file, os.path.dirname(scene.document.source))}:{line}"  # noqa: PTH120
                words = f"the {shape.tag} of link {link} is {found or 'absent'}, and in MuJoCo {expected}"
                faults.append(f"{words} ({where})")
    more = f", and {len(faults) - 1} more differ" if faults[1:] else ""
    return total, [f"{faults[0]}{more}"] if faults else []


def _shapes(link: Element) -> list[Element]:
    return [*link.iterfind("visual"), *link.iterfind("collision")]


def _quaternion(angles_of_urdf: str) -> Any:
    quaternion = np.zeros(4)
    mujoco.mju_euler2Quat(quaternion, _numbers(angles_of_urdf), "XYZ")
    return quaternion


def _numbers(text: str) -> Any:
    return np.array(text.split(), float)


def _expected(scene: MujocoScene, body: int) -> Iterator[int]:
    """Yield the geoms that are shapes of a link in the order of the URDF: those that are drawn, then the solid ones."""
    first = int(scene.model.body_geomadr[body])
    geoms = range(first, first + int(scene.model.body_geomnum[body]))
    yield from (geom for geom in geoms if scene.model.geom_group[geom] <= _SHOWN)
    yield from filter(scene.touches, geoms)


def _shape(model: Any, data: Any, geom: int, frame: Sequence[Any]) -> _Shape:
    """Return the shape of a geom in a frame, which has an origin and a rotation."""
    kind, (origin, turn) = mujoco.mjtGeom(model.geom_type[geom]).name.removeprefix("mjGEOM_").lower(), frame
    back = turn.reshape(3, 3).T
    rotation, place = back @ data.geom_xmat[geom].reshape(3, 3), back @ (data.geom_xpos[geom] - origin)
    if kind == "mesh":
        mesh = model.geom_dataid[geom]
        first = model.mesh_vertadr[mesh]
        corners = place + model.mesh_vert[first : first + model.mesh_vertnum[mesh]] @ rotation.T
        lowest, highest = corners.min(axis=0), corners.max(axis=0)
        return _Shape(kind, highest - lowest, (highest + lowest) / 2, corners)
    factors = _KINDS[kind][2] if kind in _KINDS else ()
    return _Shape(kind, model.geom_size[geom][: len(factors)] / factors, place, rotation)

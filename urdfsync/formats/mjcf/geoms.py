"""Compares the shapes of a URDF with the geoms of its MJCF: MuJoCo compiles both, with the files of their meshes.

A shape is compared in the frame of its link, with all joints at zero. MuJoCo moves the corners of a mesh to its centre;
in the frame of the link they stand where the file has them, so all corners are compared.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element

import mujoco
import numpy as np

from urdfsync.formats.mjcf.document import MjcfDocument
from urdfsync.formats.mjcf.scene import WORLD, MujocoScene
from urdfsync.formats.urdf.kinematics.poses import angles

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
_TOLERANCE, _OF_MESHES = 1e-9, 1e-5
"""The greatest errors, relative to the largest number: MuJoCo has corners of meshes in single precision."""


class _Shape(NamedTuple):
    words: str
    numbers: Any
    """Sizes and pose, or the corners of a mesh."""
    tolerance: float = _TOLERANCE

    def is_like(self, other: _Shape) -> bool:
        """Return whether another shape is the same."""
        if self.words.split()[0] != other.words.split()[0] or self.numbers.shape != other.numbers.shape:
            return False
        return bool(np.abs(self.numbers - other.numbers).max() <= self.tolerance * np.abs(self.numbers).max())


def complete(spec: Any, root: Element, document: MjcfDocument) -> None:
    """Add the shapes of a URDF to MuJoCo's reading of its links, each named by its link and its number there.

    Principal inertias are set as written: in URDF, MuJoCo before 3.17 loses the turn of their `<origin>`.
    """
    names = {path: name for name, path in document.meshes.items()}
    spec.assets = document.contents
    for link in root.iterfind("link"):
        name, body = link.get("name"), spec.body(link.get("name"))
        for inertial in link.iterfind("inertial"):
            moments = [float(each.get(axes, "0")) for each in inertial.iterfind("inertia") for axes in _TENSOR]
            if name != WORLD and moments and not any(moments[3:]):
                body.iquat, body.inertia, body.fullinertia = _pose(inertial)[1], moments[:3], np.full(6, np.nan)
        for number, shape in enumerate(_shapes(link)):
            (geometry,) = shape.iterfind("geometry/*")
            file = os.path.join(document.source, "..", geometry.get("filename", ""))  # noqa: PTH118
            mesh = names.get(os.path.normpath(file)) if geometry.tag == "mesh" else ""
            if geometry.tag not in _KINDS or mesh is None:
                continue
            kind, attributes, factors = _KINDS[geometry.tag]
            geom = body.add_geom(name=f"{name} {number}", type=kind, contype=0, conaffinity=0)
            geom.pos, geom.quat = _pose(shape)
            geom.size[: len(factors)] = factors * _numbers(" ".join(geometry.get(each, "") for each in attributes))
            if mesh:  # a shell has no volume that MuJoCo could refuse
                geom.meshname = f"{geom.name} mesh"
                added = spec.add_mesh(name=geom.meshname, file=mesh, inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL)
                added.scale = _numbers(geometry.get("scale", "1 1 1"))


def compare_shapes(scene: MujocoScene, root: Element, urdf: Any) -> tuple[int, list[str]]:
    """Return how many numbers were compared, and a clause about the first shape that differs, if there is one."""
    model, total, faults = scene.model, 0, list[str]()
    source, other = mujoco.MjData(model), mujoco.MjData(urdf)
    mujoco.mj_kinematics(model, source)
    mujoco.mj_kinematics(urdf, other)
    shapes = {link.get("name"): _shapes(link) for link in root.iterfind("link")}
    for body in (body for body in scene.bodies if body or scene.root == 0):
        link, own = scene.links[body], scene.geoms_of(body)
        # those that are drawn, and then the solid ones, as in the URDF
        geoms = [*(geom for geom in own if model.geom_group[geom] <= _SHOWN), *filter(scene.touches, own)]
        # the origin of a link is that of the last joint of its body
        anchors = [source.xanchor[n] for n in scene.joints_of(body) if int(model.jnt_type[n]) in _TURNING]
        origin, same = [source.xpos[body], *anchors][-1], other.body(link)
        if len(geoms) != len(shapes[link]):
            faults.append(f"link {link} has {len(shapes[link])} of {len(geoms)} shapes")
            continue
        for number, (geom, shape) in enumerate(zip(geoms, shapes[link], strict=True)):
            expected, found = _shape(model, source, geom, origin, source.xmat[body]), None
            if (twin := mujoco.mj_name2id(urdf, mujoco.mjtObj.mjOBJ_GEOM, f"{link} {number}")) >= 0:
                found = _shape(urdf, other, twin, same.xpos, same.xmat)
            elif shape.find("geometry/mesh") is None and expected.words.split()[0] not in _KINDS.keys() - {"mesh"}:
                continue  # the reader of the URDF tells that it leaves the shape out
            total += min(expected.numbers.size, 15)  # the corners of a mesh are no numbers of the URDF
            if found is None or not expected.is_like(found):
                file, line = scene.document.place(scene.line("geom", geom))
                where = f"{os.path.relpath(file, os.path.dirname(scene.document.source))}:{line}"  # noqa: PTH120
                words = f"is {f'a {found.words}' if found else 'absent'}, and in MuJoCo a {expected.words} ({where})"
                faults.append(f"the {shape.tag} of link {link} {words}")
    more = f", and {len(faults) - 1} more differ" if faults[1:] else ""
    return total, [f"{faults[0]}{more}"] if faults else []


def _shapes(link: Element) -> list[Element]:
    return [*link.iterfind("visual"), *link.iterfind("collision")]


def _pose(holder: Element) -> tuple[Any, Any]:
    """Return the position and the quaternion of an element's `<origin>`."""
    origin, quaternion = holder.find("origin"), np.zeros(4)
    place = {} if origin is None else origin.attrib
    mujoco.mju_euler2Quat(quaternion, _numbers(place.get("rpy", "0 0 0")), "XYZ")
    return _numbers(place.get("xyz", "0 0 0")), quaternion


def _numbers(text: str) -> Any:
    return np.array(text.split(), float)


def _shape(model: Any, data: Any, geom: int, origin: Any, rotation: Any) -> _Shape:
    """Return the shape of a geom in a frame."""
    kind, back = mujoco.mjtGeom(model.geom_type[geom]).name.removeprefix("mjGEOM_").lower(), rotation.reshape(3, 3).T
    turn, place = back @ data.geom_xmat[geom].reshape(3, 3), back @ (data.geom_xpos[geom] - origin)
    if kind == "mesh":
        mesh = model.mesh(model.geom_dataid[geom])
        first = int(mesh.vertadr[0])
        corners = place + model.mesh_vert[first : first + int(mesh.vertnum[0])] @ turn.T
        lowest, highest = corners.min(axis=0), corners.max(axis=0)
        return _Shape(
            f"mesh of {_words(highest - lowest)} around {_words((highest + lowest) / 2)}", corners, _OF_MESHES
        )
    factors = _KINDS[kind][2] if kind in _KINDS else ()
    sizes = model.geom_size[geom][: len(factors)] / factors
    words = f"{kind} of {_words(sizes)} at {_words(place)} turned by {_words(angles(turn))}"
    return _Shape(words, np.concatenate([sizes, place, np.ravel(turn)]))


def _words(numbers: Iterable[float]) -> str:
    return " ".join(f"{value:.7g}" for value in numbers)

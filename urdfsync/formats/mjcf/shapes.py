"""Makes the visuals and collisions of a link from the geoms of its body.

MuJoCo's viewers show the groups 0 to 2, so a geom of these groups is a visual. A geom that can touch others is a
collision. URDF has no plane: its reader tells that it leaves such a shape out.
"""

from __future__ import annotations

import os
from typing import Any

import mujoco
import numpy as np

from urdfsync.formats.mjcf.scene import MujocoScene
from urdfsync.formats.mjcf.turns import Array, rpy, turned
from urdfsync.formats.translation.writer import UrdfElement, rounded

_INVERSE = (1.0, -1.0, -1.0, -1.0)
"""Factors that make the opposite turn of a quaternion."""
_SHOWN = 2
"""The last group of geoms that viewers show."""
_UNSET = (0.5, 0.5, 0.5, 1.0)
"""The colour of a geom that states none: then its material's colour counts."""


def add_shapes(link: UrdfElement, scene: MujocoScene, body: int, offset: Array) -> None:
    """Add the shapes of a body; `offset` is the origin of the link in the frame of the body."""
    model = scene.model
    shapes = {number: _shape(scene, number) for number in scene.geoms_of(body)}
    for tag in ("visual", "collision"):
        for number, (geometry, position, quaternion) in shapes.items():
            if not (scene.touches(number) if tag == "collision" else model.geom_group[number] <= _SHOWN):
                continue
            element = link.add(tag, scene.line("geom", number), name=scene.name("geom", number) or None)
            element.add("origin", xyz=rounded(position - offset if offset.any() else position), rpy=rpy(quaternion))
            element.add("geometry").children.append(geometry)
            if tag == "visual":
                own, material = tuple(map(float, model.geom_rgba[number])), model.geom_matid[number]
                rgba = model.mat_rgba[material] if material >= 0 and np.allclose(own, _UNSET) else own
                # MuJoCo has colours in single precision
                element.add("material", name="").add("color", rgba=tuple(round(float(value), 7) for value in rgba))


def add_friction(link: UrdfElement, scene: MujocoScene, body: int) -> None:
    """Add the sliding friction of the geoms that can touch the ground, and a note if they have several.

    Of two geoms that touch, the friction of the one with the higher priority counts, else the greater one.
    """
    model, found = scene.model, set[float]()
    solid = [geom for geom in scene.geoms_of(body) if scene.touches(geom)]
    for geom in solid:
        frictions = [float(model.geom_friction[geom][0])]
        for other in scene.grounds(geom):
            if (lead := int(model.geom_priority[other]) - int(model.geom_priority[geom])) >= 0:
                frictions = [*(frictions if lead == 0 else []), float(model.geom_friction[other][0])]
        found.add(max(frictions))
    if found:
        contact = link.add("contact", scene.line("geom", solid[0]))
        contact.add("lateral_friction", value=max(found))
        if len(found) > 1:
            contact.add("friction")


def _shape(scene: MujocoScene, number: int) -> tuple[UrdfElement, Array, Array]:
    """Return what a URDF says of a geom, and its pose in the frame of the body."""
    model = scene.model
    kind, (x, y, z) = mujoco.mjtGeom(model.geom_type[number]), map(float, model.geom_size[number])
    position, quaternion = model.geom_pos[number], model.geom_quat[number]
    match kind:
        case mujoco.mjtGeom.mjGEOM_MESH:
            return _mesh(scene, model.geom_dataid[number], position, quaternion)
        case mujoco.mjtGeom.mjGEOM_SPHERE:
            geometry = UrdfElement("sphere", 0, radius=x)
        case mujoco.mjtGeom.mjGEOM_CAPSULE | mujoco.mjtGeom.mjGEOM_CYLINDER:
            tag = "capsule" if kind == mujoco.mjtGeom.mjGEOM_CAPSULE else "cylinder"
            geometry = UrdfElement(tag, 0, radius=x, length=2 * y)
        case mujoco.mjtGeom.mjGEOM_ELLIPSOID:
            geometry = UrdfElement("ellipsoid", 0, radii=(x, y, z))
        case mujoco.mjtGeom.mjGEOM_BOX:
            geometry = UrdfElement("box", 0, size=(2 * x, 2 * y, 2 * z))
        case _:
            geometry = UrdfElement("plane" if kind == mujoco.mjtGeom.mjGEOM_PLANE else "unknown", 0)
    return geometry, position, quaternion


def _mesh(scene: MujocoScene, number: int, position: Any, quaternion: Any) -> tuple[UrdfElement, Array, Array]:
    """Return a mesh in the coordinates of its file.

    MuJoCo moves each mesh to its centre of mass, and turns it to its principal axes. `mesh_pos` and `mesh_quat` are the
    pose of these axes in the mesh as the file, `refpos`, `refquat` and `scale` give it: scale·refquat⁻¹·(v - refpos).
    """
    model, mesh = scene.model, scene.spec.mesh(mujoco.mj_id2name(scene.model, mujoco.mjtObj.mjOBJ_MESH, number))
    turn, back = np.zeros(4), np.zeros(4)
    mujoco.mju_mulQuat(turn, quaternion, model.mesh_quat[number] * _INVERSE)
    place = position - turned(turn, model.mesh_pos[number])
    path, scale, length = scene.document.meshes.get(mesh.file, ""), np.asarray(mesh.scale), np.linalg.norm(mesh.refquat)
    is_turned, is_uniform = abs(mesh.refquat[0]) < length, (scale == scale[0]).all() and scale[0] > 0
    if not path or (is_turned and not is_uniform):  # URDF scales before it turns
        return UrdfElement("turned-and-scaled-mesh" if path else "mesh-without-file", 0), position, quaternion
    mujoco.mju_mulQuat(back, turn, mesh.refquat * _INVERSE / length)
    place = place - turned(back, scale * mesh.refpos)
    folder = os.path.dirname(scene.document.source)  # noqa: PTH120
    filename = os.path.relpath(path, folder).replace(os.sep, "/")
    return UrdfElement("mesh", 0, filename=filename, scale=tuple(scale)), place, back

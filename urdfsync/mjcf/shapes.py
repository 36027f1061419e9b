"""Makes the visuals and collisions of a link from the geoms of its body.

MuJoCo's viewers show the groups 0 to 2, so a geom of these groups is a visual. A geom that can touch others is a
collision. URDF has no plane: its reader tells that it leaves such a shape out.
"""

from __future__ import annotations

import os
from typing import Any, NamedTuple

import mujoco
import numpy as np

from urdfsync.mjcf.scene import MujocoScene
from urdfsync.mjcf.turns import Array, inverse, product, rpy, turned
from urdfsync.translation.writer import UrdfElement, rounded

_SHOWN = 2
"""The last group of geoms that viewers show."""
_UNSET = (0.5, 0.5, 0.5, 1.0)
"""The colour of a geom that states none: then its material's colour counts."""
_KINDS = {
    mujoco.mjtGeom.mjGEOM_PLANE: "plane",
    mujoco.mjtGeom.mjGEOM_SPHERE: "sphere",
    mujoco.mjtGeom.mjGEOM_CAPSULE: "capsule",
    mujoco.mjtGeom.mjGEOM_ELLIPSOID: "ellipsoid",
    mujoco.mjtGeom.mjGEOM_CYLINDER: "cylinder",
    mujoco.mjtGeom.mjGEOM_BOX: "box",
    mujoco.mjtGeom.mjGEOM_MESH: "mesh",
}


class _Shape(NamedTuple):
    tag: str
    attributes: dict[str, Any]
    position: Array
    quaternion: Array


def add_shapes(link: UrdfElement, scene: MujocoScene, body: int, offset: Array) -> None:
    """Add the shapes of a body; `offset` is the origin of the link in the frame of the body."""
    model, first = scene.model, scene.model.body_geomadr[body]
    shapes = {number: _shape(scene, number) for number in range(first, first + model.body_geomnum[body])}
    for tag in ("visual", "collision"):
        for number, shape in shapes.items():
            if not (scene.touches(number) if tag == "collision" else model.geom_group[number] <= _SHOWN):
                continue
            line, name = scene.line("geom", number), scene.name("geom", number)
            element = link.add(tag, line, name=name or None)
            position = shape.position - offset if offset.any() else shape.position
            element.add("origin", xyz=rounded(position), rpy=rpy(shape.quaternion))
            element.add("geometry").add(shape.tag, **shape.attributes)
            if tag == "visual":
                element.add("material", name="").add("color", rgba=_color(scene, number))


def add_friction(link: UrdfElement, scene: MujocoScene, body: int) -> None:
    """Add the sliding friction of the geoms that can touch the ground, and a note if they have several."""
    first = scene.model.body_geomadr[body]
    solid = [n for n in range(first, first + scene.model.body_geomnum[body]) if scene.touches(n)]
    if frictions := {_friction(scene, number) for number in solid}:
        contact = link.add("contact", scene.line("geom", solid[0]))
        contact.add("lateral_friction", value=max(frictions))
        if len(frictions) > 1:
            contact.add("friction")


def _friction(scene: MujocoScene, geom: int) -> float:
    """Return the sliding friction of a geom on the ground.

    Of two geoms that touch, the friction of the one with the higher priority counts, else the greater one.
    """
    model, frictions = scene.model, [float(scene.model.geom_friction[geom][0])]
    for other in scene.grounds(geom):
        if (lead := int(model.geom_priority[other]) - int(model.geom_priority[geom])) >= 0:
            frictions = [*(frictions if lead == 0 else []), float(model.geom_friction[other][0])]
    return max(frictions)


def _shape(scene: MujocoScene, number: int) -> _Shape:
    """Return the shape of a geom, with its pose in the frame of the body."""
    model = scene.model
    kind = _KINDS.get(mujoco.mjtGeom(model.geom_type[number]), "unknown")
    attributes, (x, y, z) = dict[str, Any](), map(float, model.geom_size[number])
    position, quaternion = model.geom_pos[number], model.geom_quat[number]
    match kind:
        case "sphere":
            attributes = {"radius": x}
        case "capsule" | "cylinder":
            attributes = {"radius": x, "length": 2 * y}
        case "ellipsoid":
            attributes = {"radii": (x, y, z)}
        case "box":
            attributes = {"size": (2 * x, 2 * y, 2 * z)}
        case "mesh":
            return _mesh(scene, model.geom_dataid[number], position, quaternion)
    return _Shape(kind, attributes, position, quaternion)


def _mesh(scene: MujocoScene, number: int, position: Any, quaternion: Any) -> _Shape:
    """Return a mesh in the coordinates of its file.

    MuJoCo moves each mesh to its centre of mass, and turns it to its principal axes. `mesh_pos` and `mesh_quat` are the
    pose of these axes in the mesh as the file, `refpos`, `refquat` and `scale` give it: scale·refquat⁻¹·(v - refpos).
    """
    model, mesh = scene.model, scene.spec.mesh(mujoco.mj_id2name(scene.model, mujoco.mjtObj.mjOBJ_MESH, number))
    turn = product(quaternion, inverse(model.mesh_quat[number]))
    place = position - turned(turn, model.mesh_pos[number])
    path, scale, back = scene.document.meshes.get(mesh.file, ""), np.asarray(mesh.scale), inverse(mesh.refquat)
    is_turned, is_uniform = abs(back[0]) < np.linalg.norm(back), (scale == scale[0]).all() and scale[0] > 0
    if not path or (is_turned and not is_uniform):  # URDF scales before it turns
        return _Shape("mesh-without-file" if not path else "turned-and-scaled-mesh", {}, position, quaternion)
    turn = product(turn, back / np.linalg.norm(back))
    place = place - turned(turn, scale * mesh.refpos)
    folder = os.path.dirname(scene.document.source)  # noqa: PTH120
    filename = os.path.relpath(path, folder).replace(os.sep, "/")
    return _Shape("mesh", {"filename": filename, "scale": tuple(scale)}, place, turn)


def _color(scene: MujocoScene, number: int) -> tuple[float, ...]:
    """Return the colour of a geom as MuJoCo draws it, without textures."""
    model = scene.model
    own, material = tuple(map(float, model.geom_rgba[number])), model.geom_matid[number]
    rgba = model.mat_rgba[material] if material >= 0 and np.allclose(own, _UNSET) else own
    return tuple(round(float(value), 7) for value in rgba)  # MuJoCo has colours in single precision

"""A robot in MuJoCo, which reads the file itself: the reference where Pinocchio is not installed, as on Windows.

Coordinates are those of Pinocchio, which resolves the velocity of the root link in the link's frame; MuJoCo resolves it
in the world. MuJoCo refuses moving bodies without mass and tensors that no body has, and it rounds small tensors: its
model gets masses of 0 and all tensors afterwards.
"""

from __future__ import annotations

import warnings
from collections.abc import Collection, Sequence
from typing import Any
from xml.etree.ElementTree import Element, SubElement, tostring

import mujoco
import numpy as np

from urdfsync.formats.urdf.physics.multibody import Array, Coordinates, Multibody
from urdfsync.formats.urdf.robot import Vector
from urdfsync.formats.urdf.second.reading import rotation

_LEAST = 1e-14
"""In kg: MuJoCo takes moving bodies from here on."""
_TENSOR = ("ixx", "ixy", "ixz", "ixy", "iyy", "iyz", "ixz", "iyz", "izz")
_PLACEHOLDER = {"ixx": "2", "ixy": "0.1", "ixz": "0.2", "iyy": "2.5", "iyz": "0.3", "izz": "3"}
"""A tensor without the symmetries that MuJoCo would make use of."""
_SETTINGS = {
    "inertiafromgeom": "false",
    "fusestatic": "false",
    "balanceinertia": "false",
    "boundmass": str(_LEAST),
    "boundinertia": "1",
}
_READ = ("origin", "parent", "child", "axis", "dynamics", "inertial")
"""The parts of joints and links that MuJoCo shall read."""


class MujocoRobot(Multibody):
    """A robot in MuJoCo; its base is free. Raises ValueError if MuJoCo refuses the file."""

    name = f"MuJoCo {mujoco.__version__}"

    def __init__(self, root: Element, balls: Collection[str]) -> None:
        """Read a URDF, whose joints `balls` turn about a point. This changes `root`."""
        inertials = [(link.get("name", ""), part) for link in root.findall("link") for part in link.findall("inertial")]
        tensors = {link: _tensor(inertial) for link, inertial in inertials}
        children = {child.get("link") for child in root.findall("joint/child")}
        root[:] = [part for part in root if part.tag in ("link", "joint")]
        # numbers in place of names, some of which MuJoCo gives a meaning
        numbers = {(part.tag, part.get("name", "")): f"{part.tag} {k}" for k, part in enumerate(root)}
        links = {name: number for (tag, name), number in numbers.items() if tag == "link"}
        for part in root:
            part[:] = [child for child in part if child.tag in _READ]
            if part.tag == "joint" and part.get("name") in balls:
                part.set("type", "spherical")
            part.set("name", numbers[part.tag, part.get("name", "")])
            for end in part.findall("parent") + part.findall("child"):
                end.set("link", links[end.get("link", "")])
            for inertia in part.findall("inertial/inertia"):
                inertia.attrib.update(_PLACEHOLDER)
        SubElement(SubElement(root, "mujoco"), "compiler", _SETTINGS)
        SubElement(root, "link", name="world")
        free = SubElement(root, "joint", name="free", type="floating")
        SubElement(free, "parent", link="world")
        SubElement(free, "child", link=next(number for link, number in links.items() if link not in children))
        # MuJoCo would write its warnings into a file of the working folder
        mujoco.set_mju_user_warning(lambda _: None)
        spec = mujoco.MjSpec.from_string(tostring(root, "unicode"))
        spec.memory = 1 << 20  # bytes for contacts, of which there are none
        with warnings.catch_warnings(action="ignore"):  # of joints that move no mass
            self.model = model = spec.compile()
        model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
        model.body_mass[model.body_mass <= _LEAST] = 0.0
        model.body_inertia[:] = 0.0
        for link, (values, axes) in tensors.items():
            body = model.body(links[link])
            body.inertia[:] = values
            mujoco.mju_mat2Quat(body.iquat, axes.ravel())
        self.nv, self.links = int(model.nv), tuple(links)
        self.damping, self.friction, self.armature = model.dof_damping, model.dof_frictionloss, model.dof_armature
        self._bodies = {name: int(model.body(number).id) for name, number in links.items()}
        self._root = int(model.joint("free").bodyid[0])
        moving = {model.joint(k).name: model.joint(k) for k in range(model.njnt)}
        self._joints = {name: moving[number] for (_, name), number in numbers.items() if number in moving}
        self.coordinates = {
            name: Coordinates(int(each.dofadr[0]), len(each.damping), bool(each.type[0] == mujoco.mjtJoint.mjJNT_SLIDE))
            for name, each in self._joints.items()
        }

    def set_gravity(self, gravity: float) -> None:
        """Set the gravity (m/s²) along -z of the world."""
        self.model.opt.gravity[:] = 0, 0, -gravity

    def configuration(self, positions: Array, place: Sequence[float] = (0, 0, 0), axes: Array | None = None) -> Array:
        """Return MuJoCo's configuration for positions of the joints, and place and axes of the root link."""
        q = np.array(self.model.qpos0)
        mujoco.mj_integratePos(self.model, q, positions, 1.0)
        q[:3] = place
        mujoco.mju_mat2Quat(q[3:7], np.eye(3).ravel() if axes is None else np.ravel(axes))
        return q

    def move(self, q: Array, v: Array | None = None, a: Array | None = None) -> Any:
        """Return MuJoCo's data, with poses and motion of all links."""
        data = mujoco.MjData(self.model)
        data.qpos[:] = q
        mujoco.mj_fwdPosition(self.model, data)
        turn = self._turn(data)
        if v is not None:
            data.qvel[:] = turn @ v
            mujoco.mj_fwdVelocity(self.model, data)
        if v is not None and a is not None:
            data.qacc[:] = turn @ a
            data.qacc[:3] += np.cross(turn[:3, :3] @ v[3:6], data.qvel[:3])
        return data

    def pose(self, data: Any, link: str) -> tuple[Array, Array]:
        """Return place and axes (as columns) of a link's frame in the world."""
        body = data.body(self._bodies[link])
        return np.array(body.xpos), body.xmat.reshape(3, 3).copy()

    def jacobian(self, data: Any, link: str, xyz: Vector = (0.0, 0.0, 0.0)) -> Array:
        """Return the derivatives of velocity and angular velocity of a link at a point, resolved in the world."""
        return np.asarray(self._derivatives(mujoco.mj_jac, data, link, xyz) @ self._turn(data))

    def acceleration(self, data: Any, link: str, xyz: Vector = (0.0, 0.0, 0.0)) -> Array:
        """Return acceleration and angular acceleration of a link at a point, resolved in the world."""
        ways, rates = (self._derivatives(each, data, link, xyz) for each in (mujoco.mj_jac, mujoco.mj_jacDot))
        return np.asarray(ways @ data.qacc + rates @ data.qvel)

    def efforts(self, q: Array, v: Array, a: Array) -> Array:
        """Return the efforts of all coordinates, without losses."""
        data, efforts = self.move(q, v, a), np.zeros(self.nv)
        mujoco.mj_mulM(self.model, data, efforts, data.qacc)
        return np.asarray(self._turn(data).T @ (efforts + data.qfrc_bias))

    def wrench(self, q: Array, v: Array, a: Array, joint: str) -> tuple[Array, Array]:
        """Return force and torque of the parent on the child's frame in a joint, resolved in the world."""
        data, child = self.move(q, v, a), int(self._joints[joint].bodyid[0])
        mujoco.mj_rnePostConstraint(self.model, data)
        torque, force = data.cfrc_int[child].reshape(2, 3)  # at the centre of mass of the robot
        return force, torque + np.cross(data.subtree_com[self._root] - data.xpos[child], force)

    def mass_and_centre(self, q: Array) -> tuple[float, Array]:
        """Return the mass of the robot, and the centre of mass in the world; zero without a mass."""
        masses = np.array(self.model.body_mass)
        mass = float(masses.sum())
        return mass, masses @ self.move(q).xipos / mass if mass else np.zeros(3)

    def _derivatives(self, function: Any, data: Any, link: str, xyz: Vector) -> Array:
        """Return a Jacobian of a link at a point by the coordinates of MuJoCo, or its rate."""
        rows, (place, axes) = np.zeros((6, self.nv)), self.pose(data, link)
        function(self.model, data, rows[:3], rows[3:], place + axes @ xyz, self._bodies[link])
        return rows

    def _turn(self, data: Any) -> Array:
        """Return the matrix that takes Pinocchio's velocity to that of MuJoCo."""
        turn = np.eye(self.nv)
        turn[:3, :3] = data.xmat[self._root].reshape(3, 3)
        return turn


def _tensor(inertial: Element) -> tuple[Array, Array]:
    """Return the principal moments of a link, and the axes in the link's frame."""
    stated = {name: text for inertia in inertial.findall("inertia") for name, text in inertia.items()}
    values, axes = np.linalg.eigh(np.array([float(stated.get(name, "0")) for name in _TENSOR]).reshape(3, 3))
    axes[:, 0] *= np.linalg.det(axes)  # a rotation
    angles = [origin.get("rpy", "0 0 0").split() for origin in inertial.findall("origin")] or [["0"] * 3]
    return values, rotation([float(word) for word in angles[0]]) @ axes

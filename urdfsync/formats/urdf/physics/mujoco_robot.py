"""A robot in MuJoCo, which reads the file itself: the reference where Pinocchio is not installed, as on Windows.

Coordinates are those of Pinocchio, which resolves the velocity of the root link in the link's frame; MuJoCo resolves it
in the world. MuJoCo refuses moving bodies without mass, and tensors that no body has: its model gets these afterwards.
"""

from __future__ import annotations

import copy
from collections.abc import Collection, Sequence
from typing import Any
from xml.etree.ElementTree import Element, SubElement, tostring

import mujoco
import numpy as np

from urdfsync.formats.urdf.physics.multibody import Array, Coordinates, Load
from urdfsync.formats.urdf.robot import Vector
from urdfsync.formats.urdf.second.reading import rotation

_LEAST = 1e-14
"""In kg and kg·m²: MuJoCo takes moving bodies from here on."""
_TENSOR = ("ixx", "ixy", "ixz", "ixy", "iyy", "iyz", "ixz", "iyz", "izz")
_SETTINGS = {
    "inertiafromgeom": "false",
    "fusestatic": "false",
    "balanceinertia": "false",
    "boundmass": str(_LEAST),
    "boundinertia": str(_LEAST),
}
_READ = ("origin", "parent", "child", "axis", "dynamics", "inertial")
"""The parts of joints and links that MuJoCo shall read."""


class MujocoRobot:
    """A robot in MuJoCo; its base is free. Raises ValueError if MuJoCo refuses the file."""

    name = f"MuJoCo {mujoco.__version__}"

    def __init__(self, root: Element, balls: Collection[str]) -> None:
        """Read a URDF, whose joints `balls` turn about a point."""
        links = {link.get("name", ""): f"link {k}" for k, link in enumerate(root.findall("link"))}
        joints = {joint.get("name", ""): f"joint {k}" for k, joint in enumerate(root.findall("joint"))}
        children = {child.get("link") for child in root.findall("joint/child")}
        robot, improper = Element("robot", name="robot"), dict[str, Element]()
        SubElement(SubElement(robot, "mujoco"), "compiler", _SETTINGS)
        SubElement(robot, "link", name="world")
        free = SubElement(robot, "joint", name="free", type="floating")
        SubElement(free, "parent", link="world")
        SubElement(free, "child", link=next(number for name, number in links.items() if name not in children))
        for part in root.findall("link") + root.findall("joint"):
            # numbers in place of names, some of which MuJoCo gives a meaning
            name = part.get("name", "")
            number = (links if part.tag == "link" else joints)[name]
            kind = {} if part.tag == "link" else {"type": "spherical" if name in balls else part.get("type", "")}
            own = SubElement(robot, part.tag, kind, name=number)
            own.extend(copy.deepcopy(child) for child in part if child.tag in _READ)
            for end in own.findall("parent") + own.findall("child"):
                end.set("link", links[end.get("link", "")])
            for inertial in part.findall("inertial"):
                if not _is_proper(inertial):
                    improper[number] = inertial
                    own.find("inertial/inertia").attrib.update(  # type: ignore[union-attr]
                        {name: "1" if name[1] == name[2] else "0" for name in _TENSOR}
                    )
        # MuJoCo would write its warnings into a file of the working folder
        mujoco.set_mju_user_warning(lambda _: None)
        spec = mujoco.MjSpec.from_string(tostring(robot, "unicode"))
        spec.memory = 1 << 20  # bytes for contacts, of which there are none
        self.model = model = spec.compile()
        model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
        for numbers in (model.body_mass, model.body_inertia):
            numbers[numbers <= _LEAST] = 0.0
        for number, inertial in improper.items():
            _put_tensor(model.body(number), inertial)
        self.nv, self.links = int(model.nv), tuple(links)
        self.damping, self.friction, self.armature = model.dof_damping, model.dof_frictionloss, model.dof_armature
        self._bodies = {name: int(model.body(number).id) for name, number in links.items()}
        self._root = int(model.joint("free").bodyid[0])
        self._children, self.coordinates = dict[str, int](), dict[str, Coordinates]()
        for part in root.findall("joint"):
            if part.get("type") != "fixed":
                name = part.get("name", "")
                joint = model.joint(joints[name])
                slides = bool(joint.type[0] == mujoco.mjtJoint.mjJNT_SLIDE)
                self._children[name] = int(joint.bodyid[0])
                self.coordinates[name] = Coordinates(int(joint.dofadr[0]), len(joint.damping), slides)

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

    def efforts(self, q: Array, v: Array, a: Array, loads: Sequence[Load] = ()) -> Array:
        """Return the efforts of all coordinates, without losses, under loads on links."""
        data, efforts, applied = self.move(q, v, a), np.zeros(self.nv), np.zeros(self.nv)
        mujoco.mj_mulM(self.model, data, efforts, data.qacc)
        for load in loads:
            at = load.point, self._bodies[load.link]
            mujoco.mj_applyFT(self.model, data, load.force, load.torque, *at, applied)
        return np.asarray(self._turn(data).T @ (efforts + data.qfrc_bias - applied))

    def mass(self, q: Array) -> Array:
        """Return the mass matrix."""
        data, mass = self.move(q), np.zeros((self.nv, self.nv))
        for row, unit in zip(mass, np.eye(self.nv), strict=True):
            mujoco.mj_mulM(self.model, data, row, unit)
        turn = self._turn(data)
        return np.asarray(turn.T @ mass @ turn)

    def wrench(self, q: Array, v: Array, a: Array, joint: str, loads: Sequence[Load] = ()) -> tuple[Array, Array]:
        """Return force and torque of the parent on the child's frame in a joint, resolved in the world."""
        data, child = self.move(q, v, a), self._children[joint]
        for load in loads:
            body = self._bodies[load.link]
            torque = load.torque + np.cross(load.point - data.xipos[body], load.force)
            data.xfrc_applied[body] += *load.force, *torque
        mujoco.mj_rnePostConstraint(self.model, data)
        torque, force = data.cfrc_int[child].reshape(2, 3)  # at the centre of mass of the robot
        return force.copy(), torque + np.cross(data.subtree_com[self._root] - data.xpos[child], force)

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


def _tensor(inertial: Element) -> Array:
    stated = inertial.find("inertia")
    return np.array([0.0 if stated is None else float(stated.get(name, "0")) for name in _TENSOR]).reshape(3, 3)


def _is_proper(inertial: Element) -> bool:
    """Return whether MuJoCo takes the tensor of a link: one of a body, or no numbers but 0."""
    tensor = _tensor(inertial)
    least, middle, most = np.linalg.eigvalsh(tensor)
    return bool(least > _LEAST and least + middle >= most) or not tensor.any()


def _put_tensor(body: Any, inertial: Element) -> None:
    origin = inertial.find("origin")
    values, axes = np.linalg.eigh(_tensor(inertial))
    axes[:, 0] *= np.linalg.det(axes)  # a rotation
    rpy = [float(word) for word in ("" if origin is None else origin.get("rpy", "")).split()] or [0.0] * 3
    body.inertia[:] = values
    mujoco.mju_mat2Quat(body.iquat, np.ravel(rotation(rpy) @ axes))

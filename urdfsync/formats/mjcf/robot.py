"""Makes the links and joints of a robot from a compiled model.

The frame of a link is that of MuJoCo's body, moved to the position of the body's last joint: a joint of URDF has its
axis through the origin of its child. A body with several joints gets a link without mass before each further joint.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import mujoco
import numpy as np

from urdfsync.formats.mjcf.drives import Drives
from urdfsync.formats.mjcf.scene import MujocoScene
from urdfsync.formats.mjcf.shapes import add_friction, add_shapes
from urdfsync.formats.mjcf.turns import Array, rpy, turned
from urdfsync.formats.translation.writer import UrdfElement, free_name, rounded

_TYPES = {
    mujoco.mjtJoint.mjJNT_FREE: "floating",
    mujoco.mjtJoint.mjJNT_BALL: "ball",
    mujoco.mjtJoint.mjJNT_SLIDE: "prismatic",
    mujoco.mjtJoint.mjJNT_HINGE: "revolute",
}
_SAME = 1e-9
"""The greatest relative difference of an inertia as written from MuJoCo's."""


class Links:
    """The links of a robot with the places of their frames."""

    def __init__(self, scene: MujocoScene) -> None:
        self.scene, self._taken, self._taken_joints = scene, {*scene.links}, {*scene.joints}
        self.sites: dict[int, str] = {}
        """Links of the sites with a name."""
        self.offsets = {body: self._offset(body) for body in scene.bodies}
        """Origin of each link in the frame of its body."""

    def _anchors(self, body: int) -> Iterator[Array]:
        """Yield the origin of each joint of a body. A sliding joint acts the same at any origin."""
        model, anchor = self.scene.model, np.zeros(3)
        for joint in self.scene.joints_of(body):
            if int(model.jnt_type[joint]) in (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_BALL):
                anchor = np.array(model.jnt_pos[joint])
            yield anchor

    def _offset(self, body: int) -> Array:
        return [np.zeros(3), *self._anchors(body)][-1]

    def place(self, body: int, position: Any) -> tuple[float, ...]:
        """Return a position in the frame of a body as one in the frame of its link."""
        offset = self.offsets[body]
        return rounded(position - offset) if offset.any() else tuple(map(float, position))

    def add(self, robot: UrdfElement, drives: Drives) -> None:
        """Add all links and joints to the robot."""
        for body in self.scene.bodies:
            if body != self.scene.bodies[0]:
                self._add_joints(robot, body, drives)
            self._add_link(robot, body)
        self._add_sites(robot)

    def _add_link(self, robot: UrdfElement, body: int) -> None:
        model, line = self.scene.model, self.scene.line("body", body)
        link = robot.add("link", line, name=self.scene.links[body])
        mass, moments = model.body_mass[body], model.body_inertia[body]
        if mass or moments.any():
            inertial = link.add("inertial")
            inertial.add("mass", value=mass)
            tensor = self._written_inertia(body)
            angles = rpy(model.body_iquat[body]) if tensor is None else None
            inertial.add("origin", xyz=self.place(body, model.body_ipos[body]), rpy=angles)
            xx, yy, zz, xy, xz, yz = (*moments, 0.0, 0.0, 0.0) if tensor is None else tensor
            inertial.add("inertia", ixx=xx, ixy=xy, ixz=xz, iyy=yy, iyz=yz, izz=zz)
        if body or self.scene.root == 0:  # what stands in the world is scenery
            add_shapes(link, self.scene, body, self.offsets[body])
        if body and self.scene.is_floating:  # other robots do not touch the ground
            add_friction(link, self.scene, body)

    def _written_inertia(self, body: int) -> Any:
        """Return xx, yy, zz, xy, xz, yz as the file has them; None if it has none, or if MuJoCo changed them."""
        model = self.scene.model
        written = getattr(self.scene.element("body", body), "fullinertia", None) if body else None
        if written is None or np.isnan(written).any() or not self.scene.element("body", body).explicitinertial:
            return None
        xx, yy, zz, xy, xz, yz = written
        axes = np.array([turned(model.body_iquat[body], axis) for axis in np.eye(3)])
        compiled = axes.T @ np.diag(model.body_inertia[body]) @ axes
        same = np.allclose(compiled, [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], rtol=0, atol=_SAME * (xx + yy + zz))
        return written if same else None

    def _add_joints(self, robot: UrdfElement, body: int, drives: Drives) -> None:
        """Add the joints from a body's parent to the body, with a link between each two of them."""
        scene, model = self.scene, self.scene.model
        parent = model.body_parentid[body]
        name, quaternion = scene.links[parent], model.body_quat[body]
        joints, before = list(scene.joints_of(body)), np.zeros(3)
        if not joints:
            self._add_weld(robot, scene.line("body", body), parent, scene.links[body], model.body_pos[body], quaternion)
            return
        for number, anchor in zip(joints, self._anchors(body), strict=True):
            is_last = number == joints[-1]
            child = scene.links[body] if is_last else free_name(scene.joints[number], self._taken)
            kind, line = _TYPES[mujoco.mjtJoint(model.jnt_type[number])], scene.line("joint", number)
            if kind == "revolute" and not model.jnt_limited[number]:
                kind = "continuous"
            joint = robot.add("joint", line, name=scene.joints[number], type=kind)
            joint.add("parent", link=name)
            joint.add("child", link=child)
            if number == joints[0]:
                position = model.body_pos[body]
                moved = position + turned(quaternion, anchor) if anchor.any() else position
                joint.add("origin", xyz=self.place(parent, moved), rpy=rpy(quaternion))
            else:
                joint.add("origin", xyz=rounded(anchor - before), rpy=(0.0, 0.0, 0.0))
            if kind not in ("floating", "ball"):
                joint.add("axis", xyz=model.jnt_axis[number])
            drives.add_numbers(joint, number, kind)
            if not is_last:
                robot.add("link", line, name=child)
            name, before = child, anchor

    def _add_weld(self, robot: UrdfElement, line: int, parent: int, child: str, position: Any, quaternion: Any) -> None:
        """Add a fixed joint from a body to a link."""
        joint = robot.add("joint", line, name=free_name(f"{child}_fixed", self._taken_joints), type="fixed")
        joint.add("parent", link=self.scene.links[parent])
        joint.add("child", link=child)
        joint.add("origin", xyz=self.place(parent, position), rpy=rpy(quaternion))

    def _add_sites(self, robot: UrdfElement) -> None:
        """Add a link without mass for each site with a name."""
        model = self.scene.model
        for site in range(model.nsite):
            body, name = model.site_bodyid[site], self.scene.name("site", site)
            if not name or body not in self.offsets or (body == 0 and self.scene.root):
                continue
            line = self.scene.line("site", site)
            self.sites[site] = free_name(name, self._taken)
            robot.add("link", line, name=self.sites[site])
            self._add_weld(robot, line, body, self.sites[site], model.site_pos[site], model.site_quat[site])

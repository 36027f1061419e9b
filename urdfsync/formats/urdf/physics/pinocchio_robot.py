"""A robot in Pinocchio, which reads the file itself."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any
from xml.etree.ElementTree import Element, tostring

import numpy as np
import pinocchio as pin

from urdfsync.formats.urdf.physics.multibody import Array, Coordinates, Multibody
from urdfsync.formats.urdf.robot import Vector

_SLIDING_JOINTS = ("JointModelPX", "JointModelPY", "JointModelPZ", "JointModelPrismatic")  # Pinocchio's names


class PinocchioRobot(Multibody):
    """A robot in Pinocchio; its base is free. Raises ValueError or RuntimeError if Pinocchio refuses the file."""

    name = f"Pinocchio {pin.__version__}"

    def __init__(self, root: Element, balls: Collection[str]) -> None:
        """Read a URDF. Pinocchio's reader lacks ball joints: this adds the `balls`. It changes `root`."""
        for joint in root.findall("joint"):
            if joint.get("name") in balls:
                joint.set("type", "continuous")
                for part in [part for part in joint if part.tag in ("axis", "limit")]:
                    joint.remove(part)
        # an unused name for Pinocchio's root joint
        unused = "_" * (1 + max(len(element.get("name", "")) for element in root.iter()))
        model = pin.buildModelFromXML(tostring(root, "unicode"), pin.JointModelFreeFlyer(), unused)
        self.model = model = _with_balls(model, balls) if balls else model
        self.nv, self.links = int(model.nv), tuple(link.get("name", "") for link in root.findall("link"))
        self.damping, self.friction, self.armature = model.damping, model.friction, model.armature
        self.coordinates = {
            name: Coordinates(joint.idx_v, joint.nv, joint.shortname().startswith(_SLIDING_JOINTS))
            for name, joint in zip(model.names, model.joints, strict=True)
            if name not in ("universe", unused)
        }

    def set_gravity(self, gravity: float) -> None:
        """Set the gravity (m/s²) along -z of the world."""
        self.model.gravity.linear = np.array([0, 0, -gravity])

    def configuration(self, positions: Array, place: Sequence[float] = (0, 0, 0), axes: Array | None = None) -> Array:
        """Return Pinocchio's configuration for positions of the joints, and place and axes of the root link."""
        q = pin.integrate(self.model, pin.neutral(self.model), positions)
        q[:7] = *place, *pin.Quaternion(np.eye(3) if axes is None else axes).coeffs()
        return np.asarray(q)

    def move(self, q: Array, v: Array | None = None, a: Array | None = None) -> Any:
        """Return Pinocchio's data, with poses and motion of all frames."""
        data, rest = self.model.createData(), np.zeros(self.model.nv)
        pin.forwardKinematics(self.model, data, q, rest if v is None else v, rest if a is None else a)
        pin.computeJointJacobians(self.model, data)
        pin.updateFramePlacements(self.model, data)
        return data

    def pose(self, data: Any, link: str) -> tuple[Array, Array]:
        """Return place and axes (as columns) of a link's frame in the world."""
        place = data.oMf[self._frame(link)]
        return np.array(place.translation), np.array(place.rotation)

    def jacobian(self, data: Any, link: str, xyz: Vector = (0.0, 0.0, 0.0)) -> Array:
        """Return the derivatives of velocity and angular velocity of a link at a point, resolved in the world."""
        return np.array(pin.getFrameJacobian(self.model, data, *self._placed(link, xyz), pin.LOCAL_WORLD_ALIGNED))

    def acceleration(self, data: Any, link: str, xyz: Vector = (0.0, 0.0, 0.0)) -> Array:
        """Return acceleration and angular acceleration of a link at a point, resolved in the world."""
        at = *self._placed(link, xyz), pin.LOCAL_WORLD_ALIGNED
        return np.array(pin.getFrameClassicalAcceleration(self.model, data, *at).vector)

    def efforts(self, q: Array, v: Array, a: Array) -> Array:
        """Return the efforts of all coordinates, without losses."""
        return np.array(pin.rnea(self.model, self.model.createData(), q, v, a))

    def wrench(self, q: Array, v: Array, a: Array, joint: str) -> tuple[Array, Array]:
        """Return force and torque of the parent on the child's frame in a joint, resolved in the world."""
        data, number = self.model.createData(), self.model.getJointId(joint)
        pin.rnea(self.model, data, q, v, a)
        force = data.f[number]
        pin.forwardKinematics(self.model, data, q)  # `rnea` leaves `oMi` at the identity
        axes = data.oMi[number].rotation
        return axes @ force.linear, axes @ force.angular

    def mass_and_centre(self, q: Array) -> tuple[float, Array]:
        """Return the mass of the robot, and the centre of mass in the world; zero without a mass."""
        mass = pin.computeTotalMass(self.model)
        return mass, np.array(pin.centerOfMass(self.model, self.model.createData(), q)) if mass else np.zeros(3)

    def _frame(self, link: str) -> int:
        return int(self.model.getFrameId(link, pin.BODY))

    def _placed(self, link: str, xyz: Vector) -> tuple[int, Any]:
        """Return the joint that moves a link, and the pose of a point of the link behind it."""
        frame = self.model.frames[self._frame(link)]
        return frame.parentJoint, frame.placement * pin.SE3(np.eye(3), np.array(xyz))


def _with_balls(model: Any, balls: Collection[str]) -> Any:
    """Return a model with ball joints instead of the hinges `balls`, with the same damping about each axis."""
    changed = pin.Model()
    for k in range(1, model.njoints):
        name, old = model.names[k], model.joints[k]
        new = pin.JointModelSpherical() if name in balls else old
        changed.addJoint(model.parents[k], new, model.jointPlacements[k], name)
        changed.appendBodyToJoint(k, model.inertias[k], pin.SE3.Identity())
        start = changed.joints[k].idx_v
        for numbers in ("damping", "friction"):
            getattr(changed, numbers)[start : start + new.nv] = getattr(model, numbers)[old.idx_v : old.idx_v + old.nv]
    for frame in model.frames[1:]:
        parts = frame.name, frame.parentJoint, frame.parentFrame, frame.placement, frame.type, frame.inertia
        changed.addFrame(pin.Frame(*parts), append_inertia=False)
    return changed

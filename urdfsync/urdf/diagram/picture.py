"""The diagram of a robot model as a picture."""

from __future__ import annotations

from urdfsync.domain import Target
from urdfsync.urdf.diagram.drawing import Label, svg
from urdfsync.urdf.diagram.layout import layout
from urdfsync.urdf.model.assembly import axis_numbers, couplings, tree
from urdfsync.urdf.robot import Robot
from urdfsync.urdf.skeleton import MOTIONS, Skeleton


def draw(robot: Robot, target: Target) -> str:
    """The robot model's diagram as SVG, with the very layout that the model has; masses and axis numbers are shown."""
    skeleton = Skeleton.of(robot, taken=(target.name,))
    numbers = axis_numbers(skeleton)
    labels = {}
    for link in skeleton.links:
        component = skeleton.link(link.name).component
        labels[component] = Label("link", component, f"{link.inertial.mass:.3g} kg" if link.inertial else "")
    for joint in skeleton.joints:
        component = skeleton.joint(joint.name).component
        kind = MOTIONS.get(joint.type) or ("fixed" if joint.type == "fixed" else "free")
        labels[component] = Label(kind, component, str(numbers.get(joint.name, "")))
    for coupling in couplings(skeleton):
        labels[coupling.component] = Label("coupling", coupling.component)
    return svg(layout(tree(skeleton)), labels, target.package)

"""The diagram of a robot model as a picture."""

from __future__ import annotations

from urdfsync.domain import Target
from urdfsync.urdf.diagram.drawing import Label, svg
from urdfsync.urdf.diagram.layout import layout
from urdfsync.urdf.kinematics.tree import MOTION_KINDS, KinematicTree
from urdfsync.urdf.model.robot import connector_names, couplings, tree
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Robot


def draw(robot: Robot, target: Target, options: Options) -> str:
    """The robot model's diagram as SVG, with the very layout that the model has; masses and ratios are shown."""
    skeleton = KinematicTree.of(robot, taken=(target.name,))
    names = connector_names(skeleton, options)
    labels = {}
    for link in skeleton.links:
        component = skeleton.link(link.name).component
        labels[component] = Label("link", component, f"{_rounded(link.inertial.mass)} kg" if link.inertial else "")
    ratios: dict[str, str] = {}
    for joint in skeleton.joints:
        component = skeleton.joint(joint.name).component
        kind = MOTION_KINDS.get(joint.type) or ("fixed" if joint.type == "fixed" else "free")
        labels[component] = Label(kind, component)
        if joint.mimic:
            ratios[component] = f"× {_rounded(joint.mimic.multiplier)}"
    for coupling in couplings(skeleton, names):
        ratio = ratios[coupling.follower] if coupling.leader else "held"
        labels[coupling.component] = Label("coupling", coupling.component, ratio)
    return svg(layout(tree(skeleton, names)), labels, target.package)


def _rounded(value: float) -> str:
    """Three digits; from a thousand on, the others are zeros rather than an exponent."""
    return f"{float(f'{value:.3g}'):g}"

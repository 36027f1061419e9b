"""The files of a robot's Modelica package: paths, templates and the data that they are rendered with."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import msgspec

from urdfsync.domain import Artifact, Import, Order, Role, Target
from urdfsync.modelica.literals import html
from urdfsync.urdf.connectors import connector_names
from urdfsync.urdf.drives import driven_joints
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.joint import joint_model, joint_record, joint_title
from urdfsync.urdf.model.loop import loop_data, loop_note, loop_record, loop_title
from urdfsync.urdf.model.record import record_data
from urdfsync.urdf.model.robot import bench_data, robot_data
from urdfsync.urdf.model.sensors import sensor_records
from urdfsync.urdf.model.shapes import link_model, link_shapes, standing_height
from urdfsync.urdf.model.tables import obstacles
from urdfsync.urdf.names import Identifier
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import JOINT_KINDS, MOTION_KINDS, MOTIONS, Inertial, Joint, Link, Loop, Robot

if TYPE_CHECKING:
    from urdfsync.urdf.kinematics.loops import Closure

_PARAMETERS = "Parameters"
_EDIT = "This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else."


def artifacts(robot: Robot, imports: Mapping[str, Import], target: Target, options: Options) -> list[Artifact | Order]:
    """Return every file of the robot's package but the imported meshes.

    Raises KeyError or ValueError for a robot that does not pass all checks, or has meshes without their facts.
    """
    tree, package = _tree(robot, target), target.package
    names, driven, loops = connector_names(tree, options), driven_joints(tree, options), loop_data(tree, options)
    tree = loops.tree
    files = list(_package(tree, target, options))
    if "package" in options.approach:
        benches = bench_data(tree, names, options, loops)
        files.append(_of_robot("", "robot", target, options, robot_data(tree.structure(), names, loops.dependent)))
        files.append(_of_robot("Run", "run", target, options, benches))
        files.append(_of_robot("Test", "test", target, options, benches))
        root, *others = tree.links
        if not any(link.inertial for link in tree.links):
            # Modelica's frames need a root, which is a body: a robot without any keeps one, without mass
            root = msgspec.structs.replace(root, inertial=Inertial())
        for link in (root, *others):
            files += _link(link, tree.link(link.name), imports, package, options)
        for joint in tree.joints:
            files += _joint(joint, tree.joint(joint.name), package, options, joint.name in driven)
        for loop in tree.loops:
            files += _loop(loop, loops.closures[loop.name], tree.loop(loop.name), package)
        if tree.sensors:
            data = {"record": f"{target.name}Sensors", "sensors": sensor_records(tree, names)}
            files.append(_of_robot("Sensors", "sensors", target, options, data, Role.RECORD))
        if options.base == "floating":
            stance = {"record": f"{target.name}Stance", "height": standing_height(tree, imports)}
            files.append(_of_robot("Stance", "stance", target, options, stance, Role.RECORD))
    if tree.starts():
        starts = [
            {"component": tree.joint(joint.name).component, "motion": MOTION_KINDS[joint.type], "joint": joint}
            for joint in tree.starts()
        ]
        start_record: dict[str, Any] = {
            "record": f"{target.name}Start",
            "starts": starts,
            "reaches": list(loops.reaches.values()),
            "has_loops": bool(tree.loops),
        }
        files.append(_of_robot("Start", "start", target, options, start_record, Role.RECORD))
    if has_bench(tree.joints, options):
        axes = {
            f"{motion}_axes": [
                tree.joint(joint.name).component if joint.start is not None else None for joint in tree.axes(motion)
            ]
            for motion in MOTIONS
        }
        files.append(_of_robot("Generic", "generic", target, options, axes))
    if "record" in options.approach:
        data = record_data(robot.name, tree, names, imports, package, options)
        files.append(_of_robot(_PARAMETERS, "record", target, options, data, Role.RECORD))
    return files


def record(robot: Robot, target: Target, options: Options) -> Artifact:
    """Return the record of the whole robot without a package around it; `target` names the record itself.

    Its text is that of the record in a package, if that has the same name and the robot has no mesh.
    """
    robot_target = Target(target.package, target.name.removesuffix(_PARAMETERS) or target.name)
    tree = _tree(robot, robot_target)
    data = record_data(robot.name, tree, connector_names(tree, options), {}, target.package, options)
    artifact = _of_robot(_PARAMETERS, "record", robot_target, options, data | {"record": target.name}, Role.RECORD)
    return msgspec.structs.replace(artifact, path=f"{target.name}.mo")


def models(joints: Sequence[Joint], target: Target, options: Options) -> tuple[str, ...]:
    """Return the classes of the package that have to compile by themselves, the main one first."""
    name = target.name
    whole = "package" in options.approach
    main = (name, f"{name}Run", f"{name}Test") if whole else (f"{name}{_PARAMETERS}",)
    return (*main, *((f"{name}Generic",) if has_bench(joints, options) else ()))


def has_bench(joints: Sequence[Joint], options: Options) -> bool:
    """Return whether there is a bench in which the generic robot reads the record."""
    return "record" in options.approach and not obstacles(joints)


def _tree(robot: Robot, target: Target) -> KinematicTree:
    tree = KinematicTree.of(robot, taken=(target.name,))
    if len(tree.leaders_first()) < len(tree.joints):
        raise ValueError("a joint follows one that is not there, or itself")
    return tree


def _of_robot(
    suffix: str, template: str, target: Target, options: Options, data: Mapping[str, Any], role: Role = Role.MODEL
) -> Artifact:
    """Return a file of the robot itself, whose name is that of the robot with a suffix."""
    name = target.name
    common = {"within": target.package, "type": name, "title": f"robot {name}", "record": f"{name}{_PARAMETERS}"}
    data = {**common, "base": options.base, **data}
    return Artifact(f"{name}{suffix}.mo", role, f"robot/{template}.mo.jinja", data, "robot")


def _package(tree: KinematicTree, target: Target, options: Options) -> Iterator[Artifact | Order]:
    """Yield the `package.mo` and `package.order` of the robot, and of its links and its joints."""
    name = target.name
    parent, _, last = target.package.rpartition(".")
    whole = "package" in options.approach
    classes = dict.fromkeys(models(tree.joints, target, options))
    if whole and options.base == "floating":
        classes[f"{name}Stance"] = None
    if whole and tree.sensors:
        classes[f"{name}Sensors"] = None
    if tree.starts():
        classes[f"{name}Start"] = None
    if "record" in options.approach:
        classes[f"{name}{_PARAMETERS}"] = None
    folders = {"Links": [tree.link(link.name) for link in tree.links]} if whole else {}
    if whole and tree.joints:
        folders["Joints"] = [tree.joint(joint.name) for joint in tree.joints]
        folders["Joints"] += [tree.loop(loop.name) for loop in tree.loops]
    data = {
        "within": parent,
        "name": last,
        "title": f"Robot {name}: links, joints, robot and benches" if whole else f"Robot {name} in one record",
        "uses": () if parent else options.uses,
        "robot": name,
        "bench": has_bench(tree.joints, options),
    }
    yield Artifact("package.mo", Role.PACKAGE, "package/robot.mo.jinja", data, "robot")
    yield Order("package.order", (*classes, *folders))
    for folder, identifiers in folders.items():
        data = {"within": target.package, "name": folder, "title": f"{folder} of robot {name}"}
        template = f"package/{folder.lower()}.mo.jinja"
        yield Artifact(f"{folder}/package.mo", Role.PACKAGE, template, data, "robot")
        yield Order(f"{folder}/package.order", tuple(n for i in identifiers for n in (i.type, i.record)))


def _link(
    link: Link, name: Identifier, imports: Mapping[str, Import], package: str, options: Options
) -> tuple[Artifact, Artifact]:
    """Return record and model of a link."""
    owner = f"link {link.name}"
    visuals, collisions = link_shapes(link, imports, package, options)
    named = {
        "within": f"{package}.Links",
        "type": name.type,
        "record": name.record,
        "title": f'link "{link.name}"',
    }
    contact = msgspec.to_builtins(link.contact) or {}
    shapes = {"visuals": visuals, "collisions": collisions}
    record = {"name": link.name, "inertial": link.inertial, "contact": contact, **shapes}
    note = f"Rigid body, visuals and collisions of the URDF link <code>{html(link.name)}</code>. {_EDIT}"
    model = link_model(visuals, collisions, options, link.contact) | {"note": note}
    return (
        Artifact(f"Links/{name.record}.mo", Role.RECORD, "link/record.mo.jinja", named | record, owner),
        Artifact(f"Links/{name.type}.mo", Role.MODEL, "link/model.mo.jinja", named | model, owner),
    )


def _joint(
    joint: Joint, name: Identifier, package: str, options: Options, is_driven: bool
) -> tuple[Artifact, Artifact]:
    """Return record and model of a joint."""
    owner = f"joint {joint.name}"
    named = {
        "within": f"{package}.Joints",
        "type": name.type,
        "record": name.record,
        "title": joint_title(joint),
    }
    ends = f"<code>{html(joint.child)}</code> relative to link <code>{html(joint.parent)}</code>"
    note = f"The URDF joint <code>{html(joint.name)}</code>: link {ends} {JOINT_KINDS[joint.type].does}. {_EDIT}"
    model = joint_model(joint, options, is_driven) | {"note": note}
    template = f"joint/{joint.type}"
    return (
        Artifact(
            f"Joints/{name.record}.mo",
            Role.RECORD,
            f"{template}_parameters.mo.jinja",
            named | joint_record(joint),
            owner,
        ),
        Artifact(f"Joints/{name.type}.mo", Role.MODEL, f"{template}.mo.jinja", named | model, owner),
    )


def _loop(loop: Loop, closure: Closure, name: Identifier, package: str) -> tuple[Artifact, Artifact]:
    """Return record and model of a joint that closes a loop."""
    owner = f"loop {loop.name}"
    named = {"within": f"{package}.Joints", "type": name.type, "record": name.record, "title": loop_title(loop)}
    record, model = loop_record(loop, closure), {"note": f"{loop_note(loop, closure)} {_EDIT}"}
    return (
        Artifact(f"Joints/{name.record}.mo", Role.RECORD, "joint/loop_parameters.mo.jinja", named | record, owner),
        Artifact(f"Joints/{name.type}.mo", Role.MODEL, "joint/loop.mo.jinja", named | model, owner),
    )

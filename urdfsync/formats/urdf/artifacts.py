"""The files of a robot's Modelica package: paths, templates and their data."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import msgspec

from urdfsync.domain import Artifact, Import, Order, Role, Target
from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.model.joint import joint_model, joint_title
from urdfsync.formats.urdf.model.loop import loop_note, loop_reaches, loop_title
from urdfsync.formats.urdf.model.numbers import joint_numbers, joint_record, link_numbers, loop_numbers, shape_part
from urdfsync.formats.urdf.model.record import obstacles, record_data
from urdfsync.formats.urdf.model.robot import bench_data, robot_data, sensor_rows
from urdfsync.formats.urdf.model.shapes import link_model, link_shapes, standing_height
from urdfsync.formats.urdf.options import USES, Options
from urdfsync.formats.urdf.robot import JOINT_KINDS, MOTION_KINDS, MOTIONS, Inertial, Joint, Link, Loop, Robot
from urdfsync.modelica.literals import html

_PARAMETERS = "Parameters"
_EDIT = "This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else."


def artifacts(robot: Robot, imports: Mapping[str, Import], target: Target, options: Options) -> list[Artifact | Order]:
    """Return every file of the robot's package but imported meshes.

    Raises KeyError or ValueError if the robot is invalid, or if an imported mesh lacks its hull or bounds.
    """
    assembly = Assembly(robot, options, target)
    files = list(_robot_files(assembly, imports))
    folders = dict(_folders(assembly, imports)) if "package" in options.approach else {}
    parent, _, last = target.package.rpartition(".")
    data = {
        "within": parent,
        "name": last,
        "title": f"Robot {target.name}: links, joints, robot and benches"
        if folders
        else f"Robot {target.name} in one record",
        "uses": () if parent else USES,
        "robot": target.name,
        "bench": has_bench(assembly.tree.joints, options),
    }
    orders: list[Artifact | Order] = [
        Artifact("package.mo", Role.PACKAGE, "package/robot.mo.jinja", data, "robot"),
        Order("package.order", (*_classes(files), *folders)),
    ]
    for folder, elements in folders.items():
        data = {"within": target.package, "name": folder, "title": f"{folder} of robot {target.name}"}
        template = f"package/{folder.lower()}.mo.jinja"
        orders.append(Artifact(f"{folder}/package.mo", Role.PACKAGE, template, data, "robot"))
        orders.append(Order(f"{folder}/package.order", _classes(elements)))
        files += elements
    return [*orders, *files]


def _robot_files(assembly: Assembly, imports: Mapping[str, Import]) -> Iterator[Artifact]:
    """Yield the files of the robot itself, in the order of the package."""
    tree, options, is_whole = assembly.tree, assembly.options, "package" in assembly.options.approach
    starts, record = {joint.name: tree.joint(joint.name).component for joint in tree.starts()}, list[Artifact]()
    if "record" in options.approach:
        record = [_of_robot(assembly, _PARAMETERS, record_data(assembly, imports), Role.RECORD)]
    if is_whole:
        whole = robot_data(tree.structure(), assembly.connectors, assembly.closed.dependent)
        yield _of_robot(assembly, "", whole)
        benches = bench_data(assembly, whole)
        yield _of_robot(assembly, "Run", benches)
        yield _of_robot(assembly, "Test", benches)
    else:
        yield from record
    if has_bench(tree.joints, options):
        axes = {f"{motion}_axes": [starts.get(joint.name) for joint in tree.axes(motion)] for motion in MOTIONS}
        yield _of_robot(assembly, "Generic", axes)
    if is_whole and options.base == "floating":
        yield _of_robot(assembly, "Stance", {"height": standing_height(tree, imports)}, Role.RECORD)
    if is_whole and tree.sensors:
        yield _of_robot(assembly, "Sensors", {"sensors": sensor_rows(tree, assembly.connectors)}, Role.RECORD)
    if starts:
        begin = [
            {"component": starts[joint.name], "motion": MOTION_KINDS[joint.type], "joint": joint}
            for joint in tree.starts()
        ]
        data = {"starts": begin, "reaches": list(loop_reaches(assembly.closed).values()), "has_loops": bool(tree.loops)}
        yield _of_robot(assembly, "Start", data, Role.RECORD)
    if is_whole:
        yield from record


def _folders(assembly: Assembly, imports: Mapping[str, Import]) -> Iterator[tuple[str, list[Artifact]]]:
    """Yield the folders of links and joints, each with its files; none without joints and loops."""
    tree = assembly.tree
    root, *others = tree.links
    if not any(link.inertial for link in tree.links):
        # Modelica's frames need a root body: a robot without masses gets a massless one
        root = msgspec.structs.replace(root, inertial=Inertial())
    yield "Links", [file for link in (root, *others) for file in _link(assembly, link, imports)]
    joints = [file for joint in tree.joints for file in _joint(assembly, joint)]
    joints += [file for loop in tree.loops for file in _loop(assembly, loop)]
    if joints:
        yield "Joints", joints


def _classes(files: Sequence[Artifact]) -> tuple[str, ...]:
    return tuple(file.path.rpartition("/")[2].removesuffix(".mo") for file in files)


def record(robot: Robot, target: Target, options: Options) -> Artifact:
    """Return the record of the whole robot without a package around it; `target` names the record.

    For a robot without meshes, the record in a package with the same names is equal.
    """
    robot_target = Target(target.package, target.name.removesuffix(_PARAMETERS) or target.name)
    assembly = Assembly(robot, options, robot_target)
    data = record_data(assembly, {}) | {"record": target.name}
    artifact = _of_robot(assembly, _PARAMETERS, data, Role.RECORD)
    return msgspec.structs.replace(artifact, path=f"{target.name}.mo")


def models(joints: Sequence[Joint], target: Target, options: Options) -> tuple[str, ...]:
    """Return the classes of the package that compilers check, the main class first."""
    suffixes = ("", "Run", "Test") if "package" in options.approach else (_PARAMETERS,)
    generic = ("Generic",) if has_bench(joints, options) else ()
    return tuple(f"{target.name}{suffix}" for suffix in (*suffixes, *generic))


def has_bench(joints: Sequence[Joint], options: Options) -> bool:
    """Return whether there is a bench with the generic robot and the record."""
    return "record" in options.approach and not obstacles(joints)


def _of_robot(assembly: Assembly, suffix: str, data: Mapping[str, Any], role: Role = Role.MODEL) -> Artifact:
    """Return a file of the robot itself, named after the robot with a suffix."""
    name = assembly.target.name
    record_name = f"{name}{suffix if role is Role.RECORD else _PARAMETERS}"
    common = {"within": assembly.target.package, "type": name, "title": f"robot {name}", "record": record_name}
    template = {"": "robot", _PARAMETERS: "record"}.get(suffix, suffix.lower())
    data = {**common, "base": assembly.options.base, **data}
    return Artifact(f"{name}{suffix}.mo", role, f"robot/{template}.mo.jinja", data, "robot")


def _link(assembly: Assembly, link: Link, imports: Mapping[str, Import]) -> Iterator[Artifact]:
    """Yield model and record of a link."""
    visuals, collisions = link_shapes(link, imports, assembly.target.package, assembly.options)
    contact = msgspec.to_builtins(link.contact) or {}
    shapes = {"visuals": list(map(shape_part, visuals)), "collisions": list(map(shape_part, collisions))}
    record = {"numbers": link_numbers(link.name, link.inertial), "contact": contact, **shapes}
    note = f"Rigid body, visuals and collisions of the URDF link <code>{html(link.name)}</code>."
    model = link_model(visuals, collisions, link.contact)
    templates = "link/model", "link/record"
    return _element(assembly, "link", link.name, f'link "{link.name}"', templates, (model, record), note)


def _joint(assembly: Assembly, joint: Joint) -> Iterator[Artifact]:
    """Yield model and record of a joint."""
    ends = f"<code>{html(joint.child)}</code> relative to link <code>{html(joint.parent)}</code>"
    note = f"The URDF joint <code>{html(joint.name)}</code>: link {ends} {JOINT_KINDS[joint.type].does}."
    is_driven = joint.name in assembly.closed.driven
    record = {"base": joint_record(joint), "numbers": joint_numbers(joint), "source": "URDF"}
    data = joint_model(joint, assembly.options, is_driven), record
    templates = "joint/axis" if joint.type in MOTION_KINDS else f"joint/{joint.type}", "joint/record"
    return _element(assembly, "joint", joint.name, joint_title(joint), templates, data, note)


def _loop(assembly: Assembly, loop: Loop) -> Iterator[Artifact]:
    """Yield model and record of a joint that closes a loop."""
    closure, templates = assembly.closed.closures[loop.name], ("joint/loop", "joint/record")
    data = dict[str, Any](), {"base": "Loop", "numbers": loop_numbers(loop, closure), "source": "source"}
    return _element(assembly, "loop", loop.name, loop_title(loop), templates, data, loop_note(loop, closure))


def _element(
    assembly: Assembly,
    kind: str,
    name: str,
    title: str,
    templates: tuple[str, str],
    data: tuple[Mapping[str, Any], Mapping[str, Any]],
    note: str,
) -> Iterator[Artifact]:
    """Yield model and record of an element; the note becomes the documentation of the model."""
    identifier, folder = assembly.tree.names[kind, name], "Links" if kind == "link" else "Joints"
    within = f"{assembly.target.package}.{folder}"
    named = {"within": within, "type": identifier.type, "record": identifier.record, "title": title}
    (model, record), of_model = templates, {**data[0], "note": f"{note} {_EDIT}"}
    for stem, role, template, own in (
        (identifier.type, Role.MODEL, model, of_model),
        (identifier.record, Role.RECORD, record, data[1]),
    ):
        yield Artifact(f"{folder}/{stem}.mo", role, f"{template}.mo.jinja", {**named, **own}, f"{kind} {name}")

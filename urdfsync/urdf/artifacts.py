"""A robot to the files of its Modelica package: paths, templates and the data they are rendered with."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import msgspec

from urdfsync.domain import Artifact, Import, Order, Role, Target
from urdfsync.urdf.model import assembly, notes, shapes
from urdfsync.urdf.model.numbers import joint_numbers
from urdfsync.urdf.model.tables import has_tables
from urdfsync.urdf.options import USES, Options
from urdfsync.urdf.robot import Joint, Link, Robot
from urdfsync.urdf.skeleton import Skeleton

LINK_MODEL = "link/model.mo.jinja"
LINK_RECORD = "link/record.mo.jinja"
JOINT_RECORD = "joint/record.mo.jinja"
ROBOT_RECORD = "robot/record.mo.jinja"
_PARAMETERS = "Parameters"

_Shapes = Sequence[Mapping[str, Any]]


def artifacts(robot: Robot, imports: Mapping[str, Import], target: Target, options: Options) -> list[Artifact | Order]:
    """Every file of the robot's package but the imported meshes."""
    skeleton = Skeleton.of(robot, taken=(target.name,))
    context = _Context(skeleton, imports, target, options)
    files: list[Artifact | Order] = [*_package(context)]
    if "package" in options.approach:
        files += _elements(context)
        files += _robot(context)
    if has_bench(skeleton.joints, options):
        data = assembly.generic_data(skeleton, target, options)
        files.append(Artifact(f"{target.name}Generic.mo", Role.MODEL, "robot/generic.mo.jinja", data, "robot"))
    files.append(_record(context, robot.name))
    return files


def record(robot: Robot, target: Target, options: Options) -> Artifact:
    """The record of the whole robot without a package around it; `target` names the record itself.

    It says what the record in a package says, if that is called like this one, and if no mesh has a part in it.
    """
    name = target.name.removesuffix(_PARAMETERS) or target.name
    skeleton = Skeleton.of(robot, taken=(name,))
    artifact = _record(_Context(skeleton, {}, Target(target.package, name), options), robot.name)
    return msgspec.structs.replace(artifact, path=f"{target.name}.mo", data={**artifact.data, "record": target.name})


def models(joints: Sequence[Joint], target: Target, options: Options) -> tuple[str, ...]:
    """The classes of the package that have to compile by themselves, the main one first: benches are none."""
    name = target.name
    whole = "package" in options.approach
    main = (name, f"{name}Run", f"{name}Test") if whole else (f"{name}{_PARAMETERS}",)
    return (*main, *((f"{name}Generic",) if has_bench(joints, options) else ()))


def has_bench(joints: Sequence[Joint], options: Options) -> bool:
    """Whether there is a bench in which the generic robot reads the record: if it is asked for, and possible."""
    return "record" in options.approach and has_tables(joints)


class _Context(msgspec.Struct, frozen=True):
    skeleton: Skeleton
    imports: Mapping[str, Import]
    target: Target
    options: Options


def _package(context: _Context) -> Iterator[Artifact | Order]:
    package, name, joints = context.target.package, context.target.name, context.skeleton.joints
    parent, _, last = package.rpartition(".")
    whole = "package" in context.options.approach
    yield _package_file(
        "package.mo",
        within=parent,
        name=last,
        icon="RobotPackage",
        title=f"Robot {name}: links, joints, robot and benches" if whole else f"Robot {name} in one record",
        uses=() if parent else USES,
        note=notes.package_note(name, bench=has_bench(joints, context.options)),
    )
    classes = dict.fromkeys((*models(joints, context.target, context.options), f"{name}{_PARAMETERS}"))
    folders = ("Links", *(("Joints",) if joints else ())) if whole else ()
    yield Order("package.order", (*classes, *folders))


def _elements(context: _Context) -> Iterator[Artifact | Order]:
    """What the package approach has of each link and joint."""
    skeleton = context.skeleton
    yield from _subpackage(context, "Links", [skeleton.link(link.name) for link in skeleton.links])
    if skeleton.joints:
        yield from _subpackage(context, "Joints", [skeleton.joint(joint.name) for joint in skeleton.joints])
    for link in skeleton.links:
        yield from _link(context, link)
    for joint in skeleton.joints:
        yield from _joint(context, joint)


def _subpackage(context: _Context, name: str, identifiers: list[Any]) -> Iterator[Artifact | Order]:
    title = f"{name} of robot {context.target.name}"
    note = f"One model and one record of numbers per {name[:-1].lower()}."
    yield _package_file(
        f"{name}/package.mo",
        within=context.target.package,
        name=name,
        icon=f"{name}Package",
        title=title,
        uses=(),
        note=note,
    )
    yield Order(f"{name}/package.order", tuple(n for i in identifiers for n in (i.type, i.record)))


def _package_file(path: str, **data: Any) -> Artifact:
    return Artifact(path, Role.PACKAGE, "package/package.mo.jinja", data, "robot")


def _link(context: _Context, link: Link) -> Iterator[Artifact]:
    identifier, owner = context.skeleton.link(link.name), f"link {link.name}"
    found = shapes.link_shapes(link, context.imports, context.target, context.options)
    names = {
        "within": f"{context.target.package}.Links",
        "type": identifier.type,
        "record": identifier.record,
        "title": f'link "{link.name}"',
    }
    record, model = link_record(link, *found), link_model(*found, context.options)
    model |= {"replaceable": False, "note": notes.link_note(link)}
    yield Artifact(f"Links/{identifier.record}.mo", Role.RECORD, LINK_RECORD, names | record, owner)
    yield Artifact(f"Links/{identifier.type}.mo", Role.MODEL, LINK_MODEL, names | model, owner)


def _joint(context: _Context, joint: Joint) -> Iterator[Artifact]:
    identifier, owner = context.skeleton.joint(joint.name), f"joint {joint.name}"
    names = {
        "within": f"{context.target.package}.Joints",
        "type": identifier.type,
        "record": identifier.record,
        "title": notes.joint_title(joint),
        "kind": joint.type.capitalize(),
    }
    record, model = {"joint": joint_numbers(joint)}, joint_model(joint)
    model |= {"replaceable": False, "note": notes.joint_note(joint)}
    yield Artifact(f"Joints/{identifier.record}.mo", Role.RECORD, JOINT_RECORD, names | record, owner)
    yield Artifact(f"Joints/{identifier.type}.mo", Role.MODEL, joint_template(joint), names | model, owner)


def link_record(link: Link, visuals: _Shapes, collisions: _Shapes) -> dict[str, Any]:
    """The numbers of a link, for its record."""
    return {
        "name": link.name,
        "inertial": link.inertial,
        "visuals": [shapes.numbers(shape) for shape in visuals],
        "collisions": [shapes.numbers(shape) for shape in collisions],
    }


def link_model(visuals: _Shapes, collisions: _Shapes, options: Options) -> dict[str, Any]:
    """The structure of a link, for its model: nothing in it depends on a number of the URDF."""
    return {
        "visuals": [shapes.structure(shape) for shape in visuals],
        "collisions": [shapes.structure(shape) for shape in collisions],
        "contacts": shapes.contacts(collisions) if options.base == "floating" else [],
        "visualizer": options.visualizer,
        "top": max([100, *(shape["y"] + 20 for shape in visuals)]),
        "bottom": min([-100, *(shape["y"] - 20 for shape in collisions)]),
    }


def joint_model(joint: Joint) -> dict[str, Any]:
    """The structure of a joint, for its model."""
    return {"dynamics": joint.dynamics is not None, "assertion_level": "warning"}


def joint_template(joint: Joint) -> str:
    """The template of a joint's model."""
    return f"joint/{joint.type}.mo.jinja"


def _robot(context: _Context) -> Iterator[Artifact]:
    name = context.target.name
    data = assembly.robot_data(context.skeleton, context.target, context.options)
    yield Artifact(f"{name}.mo", Role.MODEL, "robot/robot.mo.jinja", data, "robot")
    yield Artifact(f"{name}Run.mo", Role.MODEL, "robot/run.mo.jinja", data, "robot")
    yield Artifact(f"{name}Test.mo", Role.MODEL, "robot/test.mo.jinja", data, "robot")


def _record(context: _Context, urdf_name: str) -> Artifact:
    data = assembly.record_data(context.skeleton, context.imports, context.target, context.options, urdf_name)
    return Artifact(f"{context.target.name}{_PARAMETERS}.mo", Role.RECORD, ROBOT_RECORD, data, "robot")

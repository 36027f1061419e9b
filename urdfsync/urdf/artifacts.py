"""A robot to the files of its Modelica package: paths, templates and the data they are rendered with."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from urdfsync.domain import Artifact, Import, Order, Role, Target
from urdfsync.urdf.model import assembly, notes, shapes
from urdfsync.urdf.model.numbers import joint_numbers
from urdfsync.urdf.options import USES, Options
from urdfsync.urdf.robot import Joint, Link, Robot
from urdfsync.urdf.skeleton import Skeleton

LINK_MODEL = "link/model.mo.jinja"
LINK_RECORD = "link/record.mo.jinja"
JOINT_RECORD = "joint/record.mo.jinja"

_Shapes = Sequence[Mapping[str, Any]]


def artifacts(robot: Robot, imports: Mapping[str, Import], target: Target, options: Options) -> list[Artifact | Order]:
    """Every file of the robot's package but the imported meshes."""
    skeleton = Skeleton.of(robot, taken=(target.name,))
    context = _Context(skeleton, imports, target, options)
    files: list[Artifact | Order] = [*_package(context)]
    for link in skeleton.links:
        files += _link(context, link)
    for joint in skeleton.joints:
        files += _joint(context, joint)
    files += _robot(context, robot.name)
    return files


@dataclasses.dataclass(frozen=True, slots=True)
class _Context:
    skeleton: Skeleton
    imports: Mapping[str, Import]
    target: Target
    options: Options


def _package(context: _Context) -> Iterator[Artifact | Order]:
    package, name = context.target.package, context.target.name
    parent, _, last = package.rpartition(".")
    yield _package_file(
        "package.mo",
        within=parent,
        name=last,
        icon="RobotPackage",
        title=f"Robot {name}: links, joints, robot and benches",
        uses=() if parent else USES,
        note=notes.PACKAGE,
    )
    models = (name, f"{name}Run", f"{name}Test", f"{name}Parameters")
    yield Order("package.order", (*models, "Links", *(("Joints",) if context.skeleton.joints else ())))
    yield from _subpackage(context, "Links", [context.skeleton.link(link.name) for link in context.skeleton.links])
    if context.skeleton.joints:
        yield from _subpackage(context, "Joints", [context.skeleton.joint(j.name) for j in context.skeleton.joints])


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


def _robot(context: _Context, urdf_name: str) -> Iterator[Artifact]:
    name = context.target.name
    data = assembly.robot_data(context.skeleton, context.target, context.options)
    record = assembly.record_data(context.skeleton, context.imports, context.target, context.options, urdf_name)
    yield Artifact(f"{name}.mo", Role.MODEL, "robot/robot.mo.jinja", data, "robot")
    yield Artifact(f"{name}Run.mo", Role.MODEL, "robot/run.mo.jinja", data, "robot")
    yield Artifact(f"{name}Test.mo", Role.MODEL, "robot/test.mo.jinja", data, "robot")
    yield Artifact(f"{name}Parameters.mo", Role.RECORD, "robot/record.mo.jinja", record, "robot")

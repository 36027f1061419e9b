"""A robot to the files of its Modelica package: paths, templates and the data they are rendered with."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import msgspec

from urdfsync.domain import Artifact, Import, Order, Parts, Recipe, Role, Target
from urdfsync.urdf.kept import Kept
from urdfsync.urdf.model import assembly, notes, shapes
from urdfsync.urdf.model.assembly import RecordJoint, RecordLink
from urdfsync.urdf.model.numbers import joint_numbers
from urdfsync.urdf.model.shapes import Look
from urdfsync.urdf.model.tables import has_tables
from urdfsync.urdf.naming import Identifier
from urdfsync.urdf.options import USES, Options
from urdfsync.urdf.robot import Inertial, Joint, JointType, Link, Robot
from urdfsync.urdf.skeleton import Skeleton, bare

LINK_MODEL = "link/model.mo.jinja"
LINK_RECORD = "link/record.mo.jinja"
JOINT_RECORD = "joint/record.mo.jinja"
ROBOT_RECORD = "robot/record.mo.jinja"
_PARAMETERS = "Parameters"


def artifacts(
    robot: Robot, imports: Mapping[str, Import], target: Target, options: Options, parts: Parts | None = None
) -> list[Artifact | Order]:
    """Every file of the robot's package but the imported meshes; see `Domain.artifacts` for `parts`.

    Raises KeyError or ValueError for what is no robot that passed all checks, or has meshes without their facts.
    """
    context = _context(robot, imports, target, options, Kept(parts, "robot"))
    skeleton = context.skeleton
    files: list[Artifact | Order] = [*_package(context)]
    if "package" in options.approach:
        files += _elements(context, Kept(parts, "files"))
        files += _robot(context)
    if has_bench(skeleton.joints, options):
        bench = Recipe(assembly.generic_data, (context.structure, target, options))
        files.append(Artifact(f"{target.name}Generic.mo", Role.MODEL, "robot/generic.mo.jinja", bench, "robot"))
    files.append(_record(context, robot.name, Kept(parts, "record")))
    return files


def record(robot: Robot, target: Target, options: Options) -> Artifact:
    """The record of the whole robot without a package around it; `target` names the record itself.

    It says what the record in a package says, if that is called like this one, and if no mesh has a part in it.
    """
    name = target.name.removesuffix(_PARAMETERS) or target.name
    kept = Kept(None, "")
    artifact = _record(_context(robot, {}, Target(target.package, name), options, kept), robot.name, kept)
    data = {**artifact.data, "record": target.name}
    return msgspec.structs.replace(artifact, path=f"{target.name}.mo", source=data)


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
    structure: Skeleton
    """The skeleton of the bare robot: all that models of the whole robot depend on."""
    imports: Mapping[str, Import]
    target: Target
    options: Options


def _context(robot: Robot, imports: Mapping[str, Import], target: Target, options: Options, kept: Kept) -> _Context:
    for found in imports.values():
        _ = found.facts["bounds"], found.facts["hull"]  # here, and not when a text is rendered
    target, options = kept.same("target", target), kept.same("options", options)
    structure = kept.get("structure", _structure, kept.same("bare", bare(robot)), target)
    return _Context(structure.of_numbers(robot), structure, imports, target, options)


def _structure(robot: Robot, target: Target) -> Skeleton:
    structure = Skeleton.of(robot, taken=(target.name,))
    if len(structure.leaders_first()) < len(structure.joints):
        raise ValueError("a joint follows one that is not there, or itself")
    return structure


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


def _elements(context: _Context, kept: Kept) -> Iterator[Artifact | Order]:
    """What the package approach has of each link and joint."""
    skeleton = context.skeleton
    yield from _subpackage(context, "Links", [skeleton.link(link.name) for link in skeleton.links])
    if skeleton.joints:
        yield from _subpackage(context, "Joints", [skeleton.joint(joint.name) for joint in skeleton.joints])
    package, options = context.target.package, context.options
    for link in skeleton.links:
        name = skeleton.link(link.name)
        meshes = kept.same(("meshes", link.name), shapes.meshes((*link.visuals, *link.collisions), context.imports))
        yield from kept.get(("link", link.name), _link, link, name, meshes, package, options)
    for joint in skeleton.joints:
        yield from kept.get(("joint", joint.name), _joint, joint, skeleton.joint(joint.name), package)


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


def _link(
    link: Link, name: Identifier, meshes: Mapping[str, Import], package: str, options: Options
) -> tuple[Artifact, ...]:
    owner, looks = f"link {link.name}", shapes.looks(link, meshes, options)
    record = Recipe(_link_record, (name, package, link, meshes, options))
    model = Recipe(_link_model, (name, package, link.name, looks, options))
    return (
        Artifact(f"Links/{name.record}.mo", Role.RECORD, LINK_RECORD, record, owner),
        Artifact(f"Links/{name.type}.mo", Role.MODEL, LINK_MODEL, model, owner),
    )


def _link_names(name: Identifier, package: str, link: str) -> dict[str, Any]:
    return {"within": f"{package}.Links", "type": name.type, "record": name.record, "title": f'link "{link}"'}


def _link_record(
    name: Identifier, package: str, link: Link, meshes: Mapping[str, Import], options: Options
) -> dict[str, Any]:
    return _link_names(name, package, link.name) | link_record(link, meshes, package, options)


def _link_model(name: Identifier, package: str, link: str, looks: shapes.Looks, options: Options) -> dict[str, Any]:
    own = {"replaceable": False, "note": notes.link_note(link)}
    return _link_names(name, package, link) | link_model(*looks, options) | own


def link_record(link: Link, imports: Mapping[str, Import], package: str, options: Options) -> dict[str, Any]:
    """The numbers of a link, for its record."""
    visuals, collisions = shapes.numbers(link, imports, package, options)
    return {"name": link.name, "inertial": link.inertial, "visuals": visuals, "collisions": collisions}


def link_model(visuals: Sequence[Look], collisions: Sequence[Look], options: Options) -> dict[str, Any]:
    """The structure of a link, for its model: nothing in it depends on a number of the URDF."""
    return {
        "visuals": visuals,
        "collisions": collisions,
        "contacts": shapes.contacts(collisions),
        "visualizer": options.visualizer,
        "top": max([100, *(shape.y + 20 for shape in visuals)]),
        "bottom": min([-100, *(shape.y - 20 for shape in collisions)]),
    }


def _joint(joint: Joint, name: Identifier, package: str) -> tuple[Artifact, ...]:
    owner, loses = f"joint {joint.name}", joint.dynamics is not None
    own = Joint(joint.name, joint.type, joint.parent, joint.child)
    record = Recipe(_joint_record, (name, package, joint))
    model = Recipe(_joint_model, (name, package, own, loses))
    return (
        Artifact(f"Joints/{name.record}.mo", Role.RECORD, JOINT_RECORD, record, owner),
        Artifact(f"Joints/{name.type}.mo", Role.MODEL, joint_template(joint.type), model, owner),
    )


def _joint_names(name: Identifier, package: str, joint: Joint) -> dict[str, Any]:
    return {
        "within": f"{package}.Joints",
        "type": name.type,
        "record": name.record,
        "title": notes.joint_title(joint),
        "kind": joint.type.capitalize(),
    }


def _joint_record(name: Identifier, package: str, joint: Joint) -> dict[str, Any]:
    return _joint_names(name, package, joint) | {"joint": joint_numbers(joint)}


def _joint_model(name: Identifier, package: str, joint: Joint, loses: bool) -> dict[str, Any]:
    own = {"replaceable": False, "note": notes.joint_note(joint)}
    return _joint_names(name, package, joint) | joint_model(loses) | own


def joint_model(loses: bool) -> dict[str, Any]:
    """The structure of a joint, for its model; one that `loses` has damping or friction."""
    return {"dynamics": loses, "assertion_level": "warning"}


def joint_template(kind: JointType) -> str:
    """The template of the model of such a joint."""
    return f"joint/{kind}.mo.jinja"


def _robot(context: _Context) -> Iterator[Artifact]:
    name, made_of = context.target.name, (context.structure, context.target, context.options)
    robot, bench = Recipe(assembly.robot_data, made_of), Recipe(assembly.bench_data, made_of)
    yield Artifact(f"{name}.mo", Role.MODEL, "robot/robot.mo.jinja", robot, "robot")
    yield Artifact(f"{name}Run.mo", Role.MODEL, "robot/run.mo.jinja", bench, "robot")
    yield Artifact(f"{name}Test.mo", Role.MODEL, "robot/test.mo.jinja", bench, "robot")


def _record(context: _Context, urdf_name: str, kept: Kept) -> Artifact:
    skeleton, structure, stands = context.skeleton, context.structure, context.options.base == "floating"
    links = [
        kept.piece(("link", link.name), partial(_record_link, number, link.name), structure, link.inertial)
        for number, link in enumerate(skeleton.links, 1)
    ]
    joints = [
        kept.piece(("joint", joint.name), partial(_record_joint, number), structure, joint)
        for number, joint in enumerate(skeleton.joints, 1)
    ]
    touching = tuple([Link(link.name, collisions=link.collisions) for link in skeleton.links]) if stands else ()
    ground = (Skeleton(touching, skeleton.joints, skeleton.names), context.imports) if stands else None
    recipe = Recipe(assembly.record_data, (structure, links, joints, ground, context.target, urdf_name))
    return Artifact(f"{context.target.name}{_PARAMETERS}.mo", Role.RECORD, ROBOT_RECORD, recipe, "robot")


def _record_link(number: int, name: str, structure: Skeleton, inertial: Inertial | None) -> RecordLink:
    return RecordLink(number, structure.link(name).component, name, inertial)


def _record_joint(number: int, structure: Skeleton, joint: Joint) -> RecordJoint:
    return RecordJoint(number, structure.joint(joint.name).component, joint)

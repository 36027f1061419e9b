"""A robot to the files of its Modelica package: paths, templates and the data they are rendered with."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import msgspec

from urdfsync.domain import Artifact, Import, Order, Role, Target
from urdfsync.urdf.kinematics.tree import KinematicTree, strip_numbers
from urdfsync.urdf.model import bench, notes, records, shapes, stance
from urdfsync.urdf.model.records import RecordJoint
from urdfsync.urdf.model.robot import robot_data
from urdfsync.urdf.model.shapes import Look
from urdfsync.urdf.model.tables import has_tables
from urdfsync.urdf.names import Identifier, Key
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Joint, JointType, Link, Robot

LINK_MODEL = "link/model.mo.jinja"
LINK_RECORD = "link/record.mo.jinja"
ROBOT_RECORD = "robot/record.mo.jinja"
_PARAMETERS = "Parameters"


def artifacts(robot: Robot, imports: Mapping[str, Import], target: Target, options: Options) -> list[Artifact | Order]:
    """Every file of the robot's package but the imported meshes.

    Raises KeyError or ValueError for what is no robot that passed all checks, or has meshes without their facts.
    """
    context = _context(robot, imports, target, options)
    files: list[Artifact | Order] = [*_of_structure(context.structure, target, options)]
    if "package" in options.approach:
        common = context.structure.names, target.package
        for name, link in context.links.items():
            files += _link(name, link, *common, imports, options)
        for name, joint in context.joints.items():
            files += _joint(name, joint, *common)
        if options.base == "floating":
            files.append(_stance(context))
    if "record" in options.approach:
        files.append(_record(context, robot.name))
    return files


def record(robot: Robot, target: Target, options: Options) -> Artifact:
    """The record of the whole robot without a package around it; `target` names the record itself.

    It says what the record in a package says, if that is called like this one, and if no mesh has a part in it.
    """
    name = target.name.removesuffix(_PARAMETERS) or target.name
    artifact = _record(_context(robot, {}, Target(target.package, name), options), robot.name)
    data = {**artifact.data, "record": target.name}
    return msgspec.structs.replace(artifact, path=f"{target.name}.mo", data=data)


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
    links: Mapping[str, Link]
    joints: Mapping[str, Joint]
    structure: KinematicTree
    """The skeleton of the robot without numbers: all that models of the whole robot depend on."""
    imports: Mapping[str, Import]
    target: Target
    options: Options


def _context(robot: Robot, imports: Mapping[str, Import], target: Target, options: Options) -> _Context:
    for found in imports.values():
        _ = found.facts["bounds"], found.facts["hull"]  # here, and not when a text is rendered
    links, joints = {link.name: link for link in robot.links}, {joint.name: joint for joint in robot.joints}
    structure = _structure(links, tuple(map(strip_numbers, robot.joints)), target)
    return _Context(links, joints, structure, imports, target, options)


def _structure(links: Iterable[str], joints: tuple[Joint, ...], target: Target) -> KinematicTree:
    structure = KinematicTree.of(Robot("", tuple(map(Link, links)), joints), taken=(target.name,))
    if len(structure.leaders_first()) < len(structure.joints):
        raise ValueError("a joint follows one that is not there, or itself")
    return structure


def _numbers(structure: KinematicTree) -> tuple[Mapping[str, int], Mapping[str, int]]:
    """The numbers of links, and of joints, in canonical order, from 1."""
    links = {link.name: number for number, link in enumerate(structure.links, 1)}
    return links, {joint.name: number for number, joint in enumerate(structure.joints, 1)}


def _of_structure(structure: KinematicTree, target: Target, options: Options) -> list[Artifact | Order]:
    """The files that no number of the URDF has a part in."""
    files = [*_package(structure, target, options)]
    if "package" in options.approach:
        links, joints = structure.links, structure.joints
        files += _subpackage("Links", target, [structure.link(link.name) for link in links])
        files += _subpackage("Joints", target, [structure.joint(joint.name) for joint in joints]) if joints else ()
        files += _robot(structure, target, options)
    if has_bench(structure.joints, options):
        bench = records.generic_data(structure, target, options)
        files.append(Artifact(f"{target.name}Generic.mo", Role.MODEL, "robot/generic.mo.jinja", bench, "robot"))
    return files


def _package(structure: KinematicTree, target: Target, options: Options) -> Iterator[Artifact | Order]:
    name, joints = target.name, structure.joints
    parent, _, last = target.package.rpartition(".")
    whole, record = "package" in options.approach, "record" in options.approach
    yield _package_file(
        "package.mo",
        "package/robot.mo.jinja",
        within=parent,
        name=last,
        title=f"Robot {name}: links, joints, robot and benches" if whole else f"Robot {name} in one record",
        uses=() if parent else options.uses,
        note=notes.package_note(name, bench=has_bench(joints, options)),
    )
    classes = [
        *models(joints, target, options),
        *([f"{name}Stance"] if whole and options.base == "floating" else []),
        *([f"{name}{_PARAMETERS}"] if record else []),
    ]
    folders = ("Links", *(("Joints",) if joints else ())) if whole else ()
    yield Order("package.order", (*dict.fromkeys(classes), *folders))


def _subpackage(name: str, target: Target, identifiers: list[Identifier]) -> Iterator[Artifact | Order]:
    """What the package approach has of all links, or of all joints."""
    yield _package_file(
        f"{name}/package.mo",
        f"package/{name.lower()}.mo.jinja",
        within=target.package,
        name=name,
        title=f"{name} of robot {target.name}",
        note=f"One model and one record of numbers per {name[:-1].lower()}.",
    )
    yield Order(f"{name}/package.order", tuple(n for i in identifiers for n in (i.type, i.record)))


def _package_file(path: str, template: str, **data: Any) -> Artifact:
    return Artifact(path, Role.PACKAGE, template, data, "robot")


def _link(
    key: str, link: Link, names: Mapping[Key, Identifier], package: str, imports: Mapping[str, Import], options: Options
) -> tuple[Artifact, ...]:
    """What the package approach has of a link."""
    name, meshes = names["link", key], shapes.meshes((*link.visuals, *link.collisions), imports)
    owner, looks = f"link {key}", shapes.looks(link, meshes, options)
    record = _link_record(name, package, link, meshes, options)
    model = _link_model(name, package, key, looks, options)
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


def _joint(key: str, joint: Joint, names: Mapping[Key, Identifier], package: str) -> tuple[Artifact, ...]:
    """What the package approach has of a joint."""
    name, owner, loses = names["joint", key], f"joint {key}", joint.dynamics is not None
    own = Joint(key, joint.type, joint.parent, joint.child)
    record = _joint_record(name, package, joint)
    model = _joint_model(name, package, own, loses)
    return (
        Artifact(f"Joints/{name.record}.mo", Role.RECORD, joint_record_template(joint.type), record, owner),
        Artifact(f"Joints/{name.type}.mo", Role.MODEL, joint_template(joint.type), model, owner),
    )


def _joint_names(name: Identifier, package: str, joint: Joint) -> dict[str, Any]:
    return {
        "within": f"{package}.Joints",
        "type": name.type,
        "record": name.record,
        "title": notes.joint_title(joint),
    }


def _joint_record(name: Identifier, package: str, joint: Joint) -> dict[str, Any]:
    return _joint_names(name, package, joint) | {"joint": joint, "limits": joint.limit or records.UNLIMITED}


def _joint_model(name: Identifier, package: str, joint: Joint, loses: bool) -> dict[str, Any]:
    own = {"replaceable": False, "note": notes.joint_note(joint)}
    return _joint_names(name, package, joint) | joint_model(loses) | own


def joint_model(loses: bool) -> dict[str, Any]:
    """The structure of a joint, for its model; one that `loses` has damping or friction."""
    return {"dynamics": loses}


def joint_template(kind: JointType) -> str:
    """The template of the model of such a joint."""
    return f"joint/{kind}.mo.jinja"


def joint_record_template(kind: JointType) -> str:
    """The template of the record of such a joint."""
    return f"joint/{kind}_parameters.mo.jinja"


def _robot(structure: KinematicTree, target: Target, options: Options) -> Iterator[Artifact]:
    name, made_of = target.name, (structure, target, options)
    robot, benches = robot_data(*made_of), bench.bench_data(*made_of)
    yield Artifact(f"{name}.mo", Role.MODEL, "robot/robot.mo.jinja", robot, "robot")
    yield Artifact(f"{name}Run.mo", Role.MODEL, "robot/run.mo.jinja", benches, "robot")
    yield Artifact(f"{name}Test.mo", Role.MODEL, "robot/test.mo.jinja", benches, "robot")


def _stance(context: _Context) -> Artifact:
    made_of = (_touching(context), context.imports, context.target)
    record = stance.stance_data(*made_of)
    return Artifact(f"{context.target.name}Stance.mo", Role.RECORD, "robot/stance.mo.jinja", record, "robot")


def _record(context: _Context, urdf_name: str) -> Artifact:
    structure, imports, target, options = context.structure, context.imports, context.target, context.options
    link_numbers, joint_numbers = _numbers(structure)
    looks = {name: found for name in link_numbers if (found := shapes.looks(context.links[name], imports, options)[0])}
    visuals = records.record_visuals(structure, looks)
    links = [
        records.record_link(
            number,
            structure.link(name).component,
            context.links[name],
            visuals.get(name, ()),
            imports,
            target.package,
            options,
        )
        for name, number in link_numbers.items()
    ]
    joints = [
        RecordJoint(number, structure.joint(name).component, context.joints[name])
        for name, number in joint_numbers.items()
    ]
    ground = (_touching(context), imports) if options.base == "floating" else None
    tables = records.structure_data(structure, looks)
    data = records.record_data(tables, links, joints, ground, target, urdf_name, has_tables(structure.joints))
    return Artifact(f"{target.name}{_PARAMETERS}.mo", Role.RECORD, ROBOT_RECORD, data, "robot")


def _touching(context: _Context) -> KinematicTree:
    """The robot with what may touch the ground, and no other numbers of its links."""
    structure = context.structure
    links = tuple([Link(link.name, collisions=context.links[link.name].collisions) for link in structure.links])
    return KinematicTree(links, tuple([context.joints[joint.name] for joint in structure.joints]), structure.names)

"""Random changes to recorded snapshots of robots, valid before and after: for tests of comparisons."""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping
from random import Random
from typing import Any

import msgspec

from support import robots
from support.robots import NAMES
from urdfsync.common.diagnostics import Severity
from urdfsync.domain import Import, Version
from urdfsync.formats.urdf.meshes import lookup
from urdfsync.formats.urdf.robot import Camera, Mesh, Robot, Sensor
from urdfsync.formats.urdf.validate import ADVICE, check
from urdfsync.project.state.record import as_read, as_recorded

Data = dict[str, Any]


def recorded(robot: Robot) -> Data:
    """The recorded form of a robot with all kinds of elements."""
    return {"links": {}, "joints": {}, "sensors": {}, "loops": {}} | as_recorded(robot)


def version(random: Random) -> Version:
    """A robot of up to seven links, with elements of all kinds."""
    return Version(as_read(_snapshot(random), Robot), _imports(random))


def mutated(old: Version, random: Random, count: int) -> Version:
    """The version after up to `count` random changes, without changes that would make it invalid."""
    snapshot = recorded(old.snapshot)
    found = _imports(random) if random.random() < 0.2 else old.imports
    for _ in range(count):
        changed = copy.deepcopy(snapshot)
        random.choice(MUTATIONS)(changed, random)
        for name, sensor in list(changed["sensors"].items()):
            if sensor["at"] not in changed["joints" if sensor["kind"] == "force_torque" else "links"]:
                del changed["sensors"][name]
        findings = {finding.code for finding in check(as_read(changed, Robot))}
        if not any(ADVICE[code][0] is Severity.ERROR for code in findings):
            snapshot = changed
    return Version(as_read(snapshot, Robot), found)


def driven_and_passive(random: Random) -> tuple[Version, Version]:
    """Two versions of a robot of continuous joints, with different transmissions."""
    old = _snapshot(random)
    for joint in old["joints"].values():
        if random.random() < 0.7:
            joint["type"] = "continuous"
            for block in ("limit", "mimic"):
                joint.pop(block, None)
        if random.random() < 0.3:
            joint["actuated"] = True
    snapshot, found = copy.deepcopy(old), _imports(random)
    for _ in range(random.randint(1, 3)):
        _toggle(snapshot, random, "actuated")
    return Version(as_read(old, Robot), found), Version(as_read(snapshot, Robot), found)


def rename(snapshot: Data, part: str, old: str, new: str) -> None:
    """Rename a link or joint, with all references."""
    snapshot[part][new] = snapshot[part].pop(old)
    for joint in snapshot["joints"].values():
        mentions = [(joint, "parent"), (joint, "child")] if part == "links" else [(joint.get("mimic", {}), "joint")]
        for holder, key in mentions:
            if holder.get(key) == old:
                holder[key] = new
    for sensor in snapshot.get("sensors", {}).values():
        if sensor["at"] == old and (part == "joints") == (sensor["kind"] == "force_torque"):
            sensor["at"] = new


def _snapshot(random: Random) -> Data:
    """A random robot as data that may be changed."""
    snapshot = recorded(robots.dressed(robots.random_robot(random), random))
    for joint in snapshot["joints"].values():
        if random.random() < 0.3:
            rotor = random.choice(({}, {"rotor_inertia": 1.0}))
            joint["command"] = random.choice(("velocity", "effort"))
            joint["transmission"] = {"reduction": random.choice((1.0, 50.0)), "offset": 0.0, **rotor}
    snapshot["sensors"] = {name: _sensor(snapshot, random) for name in ("eye", "arm") if random.random() < 0.3}
    return snapshot


def _sensor(snapshot: Data, random: Random) -> Data:
    """A sensor on some link, or in some joint."""
    kind = random.choice(("imu", "camera", "force_torque" if snapshot["joints"] else "imu"))
    sensor = Sensor("", kind, random.choice(list(snapshot["joints" if kind == "force_torque" else "links"])))  # type: ignore[arg-type]
    if kind == "camera":
        sensor = msgspec.structs.replace(sensor, camera=Camera())
    numbers = msgspec.to_builtins(sensor)
    return {key: list(item) if isinstance(item, tuple) else item for key, item in numbers.items() if key != "name"}


def _donor(random: Random) -> Data:
    """Another robot, as a source of parts."""
    return _snapshot(Random(random.random()))


def _imports(random: Random) -> Mapping[str, Import]:
    """Some meshes found, some not, some without a hull."""
    found = {}
    for file in robots.FILES:
        if size := random.choice((None, 1.0, 2.0)):
            facts = {"bounds": [[0.0, 0.0, 0.0], [size] * 3], "hull": random.choice(([], [[size, 0.0, 0.0]]))}
            found[lookup.key(Mesh(file))] = Import(f"Resources/{file}", str(facts), str(facts), facts)
    return found


# Changes


def _change_number(snapshot: Data, random: Random) -> None:
    elements = list(snapshot[random.choice(("links", "joints"))].values())
    if places := _numbers(random.choice(elements)) if elements else []:
        holder, key = random.choice(places)
        holder[key] += random.choice((0.5, 1e-9))


def _numbers(value: Any) -> list[tuple[Any, Any]]:
    """Holder and key of every number."""
    found = []
    for key, item in value.items() if isinstance(value, dict) else enumerate(value):
        if isinstance(item, float):
            found.append((value, key))
        elif isinstance(item, dict | list):
            found += _numbers(item)
    return found


def _take_over(snapshot: Data, random: Random) -> None:
    """Copy a type, limits, an inertia or shapes from an element of another robot, or remove what that element lacks."""
    part, donor = random.choice(("links", "joints")), _donor(random)
    if snapshot[part] and donor[part]:
        element, other = (random.choice(list(robot[part].values())) for robot in (snapshot, donor))
        key = random.choice(sorted((element.keys() | other.keys()) - {"parent", "child", "mimic", "actuated"}))
        element.pop(key, None)
        element |= {key: other[key]} if key in other else {}


def _toggle(snapshot: Data, random: Random, key: str = "") -> None:
    """A joint starts or stops to follow another joint, or to have a drive."""
    if joints := snapshot["joints"]:
        joint, key = random.choice(list(joints.values())), key or random.choice(("mimic", "mimic", "actuated"))
        mimic = {"joint": random.choice(list(joints)), "multiplier": 2.0, "offset": 0.0}
        if not joint.pop(key, None):
            joint[key] = mimic if key == "mimic" else True


def _change_shapes(snapshot: Data, random: Random) -> None:
    group = random.choice(("visuals", "collisions"))
    shapes = random.choice(list(snapshot["links"].values()))[group]
    place = random.randrange(len(shapes) + 1)
    others = [shape for link in _donor(random)["links"].values() for shape in link[group]]
    match random.choice(("insert", "drop", "shuffle", "geometry", "name", "material", "material")):
        case "insert":
            shapes[place:place] = others[:1]
        case "drop":
            del shapes[place : place + 1]
        case "shuffle":
            random.shuffle(shapes)
        case what:
            for shape, new in zip(shapes[place : place + 1], others, strict=False):
                shape.pop(what, None)
                shape |= {what: new[what]} if what in new else {}


def _change_sensors(snapshot: Data, random: Random) -> None:
    """Add, remove or replace a sensor, or change its number."""
    name = random.choice(("eye", "arm"))
    if name in snapshot["sensors"] and random.random() < 0.5:
        holder, key = random.choice(_numbers(snapshot["sensors"][name]))
        holder[key] += 0.5
    elif snapshot["sensors"].pop(name, None) is None or random.random() < 0.5:
        snapshot["sensors"][name] = _sensor(snapshot, random)


def _rename(snapshot: Data, random: Random) -> None:
    part, new = random.choice(("links", "joints")), random.choice(NAMES)
    if snapshot[part] and new not in snapshot[part]:
        rename(snapshot, part, random.choice(list(snapshot[part])), new)


def _add_leaf(snapshot: Data, random: Random) -> None:
    """Add a link and a joint of another robot as a leaf."""
    donor = _donor(random)
    for name, joint in donor["joints"].items():
        if name not in snapshot["joints"] and joint["child"] not in snapshot["links"]:
            joint.pop("mimic", None)
            snapshot["joints"][name] = {**joint, "parent": random.choice(list(snapshot["links"]))}
            snapshot["links"][joint["child"]] = donor["links"][joint["child"]]
            return


def _remove_leaf(snapshot: Data, random: Random) -> None:
    if joints := snapshot["joints"]:
        name = random.choice(list(joints))
        del snapshot["links"][joints.pop(name)["child"]]
        for other in joints.values():
            if other.get("mimic", {}).get("joint") == name:
                del other["mimic"]


def _move(snapshot: Data, random: Random) -> None:
    if joints := snapshot["joints"]:
        random.choice(list(joints.values()))["parent"] = random.choice(list(snapshot["links"]))


def _change_rest(snapshot: Data, random: Random) -> None:
    snapshot["name"] = random.choice(("robot", "machine"))
    owner = random.choice(("", f"link {next(iter(snapshot['links']))}"))
    texts = random.choice((["<gazebo/>"], ['<gazebo reference="arm"><a/></gazebo>', "<gazebo><b/></gazebo>"]))
    snapshot["extensions"] |= random.choice(({}, {owner: {"gazebo": texts}}))


MUTATIONS: tuple[Callable[[Data, Random], None], ...] = (
    *(_change_number, _take_over, _take_over, _take_over, _toggle, _toggle, _change_shapes, _change_shapes),
    *(_rename, _add_leaf, _remove_leaf, _remove_leaf, _move, _change_rest, _change_sensors),
)

"""Random robots as snapshots, and random changes to them, valid before and after: for tests of comparisons."""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping
from random import Random
from typing import Any

from urdfsync.domain import Import, Version
from urdfsync.urdf.meshes import lookup
from urdfsync.urdf.robot import Mesh

SCALAR = ("continuous", "revolute", "prismatic")
TYPES = ("fixed", *SCALAR, "planar", "floating")
NAMES = ("arm", "Arm", "ARM", "arm_link", "arm_joint", "wheel", "leg-1", "leg_1", "leg 1", "Links", "m", "x9", "x10")
FILES = ("a.stl", "b.stl", "c.dae")
GROUPS = ("visuals", "collisions")
_INERTIA = {"ixx": 1.0, "iyy": 1.0, "izz": 1.0, "ixy": 0.0, "ixz": 0.0, "iyz": 0.0}
_SAFETY = {"k_velocity": 1.0, "k_position": 1.0, "soft_lower_limit": 0.0, "soft_upper_limit": 0.0}
_SHAPES = (
    {"kind": "box", "size": [1.0, 2.0, 3.0]},
    {"kind": "sphere", "radius": 1.0},
    {"kind": "cylinder", "radius": 1.0, "length": 2.0},
    *({"kind": "mesh", "filename": name, "scale": [1.0, 1.0, 1.0]} for name in FILES),
)

Data = dict[str, Any]


def version(random: Random) -> Version:
    """A robot of up to seven links, with everything that a URDF can say."""
    snapshot: Data = {"name": "robot", "links": {}, "joints": {}, "extensions": {}}
    for name in random.sample(NAMES, random.randint(1, 7)):
        _add_leaf(snapshot, random, name)
    return Version(snapshot, _imports(random))


def mutated(old: Version, random: Random, count: int) -> Version:
    """The version after `count` random changes, some of which may change nothing."""
    snapshot: Data = copy.deepcopy(dict(old.snapshot))
    found = _imports(random) if random.random() < 0.2 else old.imports
    for _ in range(count):
        random.choice(MUTATIONS)(snapshot, random)
    return Version(snapshot, found)


def driven_and_passive(random: Random) -> tuple[Version, Version]:
    """Two versions of a robot of joints that turn freely, some of them driven: not by the same transmissions."""
    old = version(random)
    for joint in old.snapshot["joints"].values():
        if random.random() < 0.7:
            joint["type"] = "continuous"
            for block in ("limit", "mimic"):
                joint.pop(block, None)
        if random.random() < 0.3:
            joint["actuated"] = True
    snapshot: Data = copy.deepcopy(dict(old.snapshot))
    for _ in range(random.randint(1, 3)):
        _toggle_drive(snapshot, random)
    return old, Version(snapshot, old.imports)


def rename(snapshot: Data, part: str, old: str, new: str) -> None:
    """Give a link or joint a new name, wherever it is mentioned."""
    snapshot[part][new] = snapshot[part].pop(old)
    for joint in snapshot["joints"].values():
        mentions = [(joint, "parent"), (joint, "child")] if part == "links" else [(joint.get("mimic", {}), "joint")]
        for holder, key in mentions:
            if holder.get(key) == old:
                holder[key] = new


# Parts of a robot


def _imports(random: Random) -> Mapping[str, Import]:
    """Some meshes found, some not, some without a hull."""
    found = {}
    for file in FILES:
        if size := random.choice((None, 1.0, 2.0)):
            facts = {"bounds": [[0.0, 0.0, 0.0], [size] * 3], "hull": random.choice(([], [[size, 0.0, 0.0]]))}
            found[lookup.key(Mesh(file))] = Import(f"Resources/{file}", str(facts), str(facts), 1, facts)
    return found


def _link(random: Random) -> Data:
    link: Data = {group: [_shape(group, random) for _ in range(random.choice((0, 0, 1, 2)))] for group in GROUPS}
    inertial = {"mass": 1.0, "origin": _origin(random), "inertia": dict(_INERTIA)}
    return link | random.choice(({}, {"inertial": inertial}))


def _shape(group: str, random: Random) -> Data:
    geometry = copy.deepcopy(random.choice((*_SHAPES, *_SHAPES[3:])))
    shape = {"geometry": geometry, "origin": _origin(random), "name": random.choice(("", "", "cover"))}
    color = {"rgba": list(random.choice(([1.0, 0.0, 0.0, 1.0], [0.0, 0.5, 0.0, 1.0])))}
    look = random.choice((None, {}, color, {"texture": "t.png"}))
    return shape if group == "collisions" or look is None else {**shape, "material": {"name": "red"} | look}


def _joint(random: Random) -> Data:
    """All of a joint but its place in the tree."""
    blocks = {
        "limit": {"lower": -1.0, "upper": 1.0, **random.choice(({}, {"effort": 2.0}))},
        "dynamics": {"damping": 0.0, "friction": 0.0},
        "calibration": random.choice(({}, {"rising": 0.5})),
        "safety_controller": dict(_SAFETY),
    }
    joint = {"type": random.choice(TYPES), "origin": _origin(random), "axis": [0.0, 0.0, 1.0]}
    return joint | {name: block for name, block in blocks.items() if random.random() < 0.4}


def _origin(random: Random) -> Data:
    return {"xyz": [float(random.randint(0, 2)), 0.0, 0.0], "rpy": [0.0, 0.0, 0.0]}


def _leaders(snapshot: Data, follower: str) -> list[str]:
    """Joints that a joint can follow without a cycle."""
    joints = snapshot["joints"]

    def chain(name: str) -> list[str]:
        return [name, *(chain(joints[name]["mimic"]["joint"]) if "mimic" in joints[name] else [])]

    return [
        name for name in joints if name != follower and joints[name]["type"] in SCALAR and follower not in chain(name)
    ]


def _leaves(snapshot: Data) -> list[str]:
    parents = {joint["parent"] for joint in snapshot["joints"].values()}
    return [name for name, joint in snapshot["joints"].items() if joint["child"] not in parents]


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
    """An element gets, or loses, something that another one has or lacks: a type, limits, inertia, shapes."""
    part, other = random.choice((("links", _link(random)), ("joints", _joint(random))))
    if snapshot[part]:
        element = random.choice(list(snapshot[part].values()))
        key = random.choice(sorted((element.keys() | other.keys()) - {"parent", "child", "mimic", "actuated"}))
        element.pop(key, None)
        element |= {key: other[key]} if key in other else {}


def _toggle_mimic(snapshot: Data, random: Random) -> None:
    if snapshot["joints"]:
        name, joint = random.choice(list(snapshot["joints"].items()))
        if random.random() < 0.5:
            joint.pop("mimic", None)
        elif leaders := _leaders(snapshot, name):
            joint["mimic"] = {"joint": random.choice(leaders), "multiplier": 2.0, "offset": 0.0}


def _toggle_drive(snapshot: Data, random: Random) -> None:
    if snapshot["joints"]:
        joint = random.choice(list(snapshot["joints"].values()))
        if not joint.pop("actuated", False):
            joint["actuated"] = True


def _change_shapes(snapshot: Data, random: Random) -> None:
    group = random.choice(GROUPS)
    shapes, new = random.choice(list(snapshot["links"].values()))[group], _shape(group, random)
    place = random.randrange(len(shapes) + 1)
    match random.choice(("insert", "drop", "shuffle", "geometry", "name", "material", "material")):
        case "insert":
            shapes.insert(place, new)
        case "drop":
            del shapes[place : place + 1]
        case "shuffle":
            random.shuffle(shapes)
        case what:
            for shape in shapes[place : place + 1]:
                shape.pop(what, None)
                shape |= {what: new[what]} if what in new else {}


def _rename(snapshot: Data, random: Random) -> None:
    part, new = random.choice(("links", "joints")), random.choice(NAMES)
    if snapshot[part] and new not in snapshot[part]:
        rename(snapshot, part, random.choice(list(snapshot[part])), new)


def _add_leaf(snapshot: Data, random: Random, name: str = "") -> None:
    free = [name] if name else [name for name in NAMES if name not in snapshot["links"]]
    if free:
        child, others = random.choice(free), list(snapshot["links"])
        snapshot["links"][child] = _link(random)
        if others:
            joint = random.choice([name for name in NAMES if name not in snapshot["joints"]])
            snapshot["joints"][joint] = _joint(random) | {"parent": random.choice(others), "child": child}
            if random.random() < 0.4 and (leaders := _leaders(snapshot, joint)):
                snapshot["joints"][joint]["mimic"] = {"joint": random.choice(leaders), "multiplier": 2.0, "offset": 0.0}


def _remove_leaf(snapshot: Data, random: Random) -> None:
    if leaves := _leaves(snapshot):
        joint = random.choice(leaves)
        del snapshot["links"][snapshot["joints"].pop(joint)["child"]]
        for other in snapshot["joints"].values():
            if other.get("mimic", {}).get("joint") == joint:
                del other["mimic"]


def _move_leaf(snapshot: Data, random: Random) -> None:
    if leaves := _leaves(snapshot):
        joint = snapshot["joints"][random.choice(leaves)]
        joint["parent"] = random.choice([name for name in snapshot["links"] if name != joint["child"]])


def _change_rest(snapshot: Data, random: Random) -> None:
    snapshot["name"] = random.choice(("robot", "machine"))
    owner = random.choice(("", f"link {next(iter(snapshot['links']))}"))
    texts = random.choice((["<gazebo/>"], ['<gazebo reference="arm"><a/></gazebo>', "<gazebo><b/></gazebo>"]))
    snapshot["extensions"] |= random.choice(({}, {owner: {"gazebo": texts}}))


MUTATIONS: tuple[Callable[[Data, Random], None], ...] = (
    *(_change_number, _take_over, _take_over, _take_over, _toggle_mimic, _toggle_drive, _change_shapes, _change_shapes),
    *(_rename, _add_leaf, _remove_leaf, _move_leaf, _change_rest),
)

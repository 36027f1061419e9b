"""Random robots as snapshots, and random changes to them, valid before and after: for tests of comparisons."""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping
from random import Random
from typing import Any

from urdfsync.domain import Import, Version
from urdfsync.urdf.meshes import lookup
from urdfsync.urdf.robot import Mesh

TYPES = ("fixed", "continuous", "revolute", "prismatic", "planar", "floating")
SCALAR = ("continuous", "revolute", "prismatic")
BLOCKS = ("limit", "dynamics", "mimic", "calibration", "safety_controller")
NAMES = ("arm", "Arm", "ARM", "arm_link", "arm_joint", "wheel", "leg-1", "leg_1", "leg 1", "Links", "m", "x9", "x10")
FILES = ("a.stl", "b.stl", "c.dae")

Data = dict[str, Any]


def version(random: Random) -> Version:
    """A robot of up to seven links, with everything that a URDF can say."""
    names = random.sample(NAMES, random.randint(1, 7))
    snapshot: Data = {"name": "robot", "links": {}, "joints": {}, "extensions": {}}
    for name in names:
        snapshot["links"][name] = _link(random)
        if len(snapshot["links"]) > 1:
            _attach(snapshot, name, random)
    return Version(snapshot, imports(random))


def imports(random: Random) -> Mapping[str, Import]:
    """Some meshes found, some not, some without a hull."""
    found = {}
    for file in FILES:
        key = lookup.key(Mesh(file))
        size = random.choice((None, 1.0, 2.0))
        if size is not None:
            facts = {"bounds": [[0.0, 0.0, 0.0], [size] * 3], "hull": random.choice(([], [[size, 0.0, 0.0]]))}
            found[key] = Import(f"Resources/{file}", str(facts), str(facts), 1, facts)
    return found


def mutated(old: Version, random: Random, count: int) -> Version:
    """The version after `count` random changes, some of which may change nothing."""
    snapshot: Data = copy.deepcopy(dict(old.snapshot))
    found = imports(random) if random.random() < 0.2 else old.imports
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


def _change_number(snapshot: Data, random: Random) -> None:
    part = random.choice(("links", "joints"))
    if not snapshot[part]:
        return
    element = random.choice(list(snapshot[part].values()))
    places = list(_numbers(element))
    if places:
        holder, key = random.choice(places)
        holder[key] += random.choice((0.5, 1e-9))


def _toggle_inertial(snapshot: Data, random: Random) -> None:
    link = random.choice(list(snapshot["links"].values()))
    if link.pop("inertial", None) is None:
        link["inertial"] = _inertial(random)


def _toggle_block(snapshot: Data, random: Random) -> None:
    if snapshot["joints"]:
        name, joint = random.choice(list(snapshot["joints"].items()))
        block = random.choice(BLOCKS)
        if joint.pop(block, None) is None:
            _add_block(snapshot, name, block, random)


def _toggle_drive(snapshot: Data, random: Random) -> None:
    if snapshot["joints"]:
        joint = random.choice(list(snapshot["joints"].values()))
        if not joint.pop("actuated", False):
            joint["actuated"] = True


def _change_type(snapshot: Data, random: Random) -> None:
    if snapshot["joints"]:
        random.choice(list(snapshot["joints"].values()))["type"] = random.choice(TYPES)


def _change_leader(snapshot: Data, random: Random) -> None:
    followers = [(name, joint) for name, joint in snapshot["joints"].items() if "mimic" in joint]
    if followers:
        name, joint = random.choice(followers)
        joint["mimic"]["joint"] = random.choice(_leaders(snapshot, name) or [joint["mimic"]["joint"]])


def _change_shapes(snapshot: Data, random: Random) -> None:
    link = random.choice(list(snapshot["links"].values()))
    shapes = link[random.choice(("visuals", "collisions"))]
    action = random.choice(("append", "drop", "shuffle", "insert"))
    if action == "append":
        shapes.append(_shape(random))
    elif action == "insert":
        shapes.insert(0, _shape(random))
    elif shapes and action == "drop":
        shapes.pop(random.randrange(len(shapes)))
    else:
        random.shuffle(shapes)


def _change_shape(snapshot: Data, random: Random) -> None:
    shapes = [(group, shape) for link in snapshot["links"].values() for group in GROUPS for shape in link[group]]
    if not shapes:
        return
    group, shape = random.choice(shapes)
    what = random.choice(("geometry", "name", "material"))
    if what == "material":
        _change_material(group, shape, random)
    else:
        shape[what] = _shape(random)[what]


def _change_material(group: str, shape: Data, random: Random) -> None:
    if group == "collisions":
        return
    material = _material(random)
    if material is None:
        shape.pop("material", None)
    else:
        shape["material"] = material


def _rename(snapshot: Data, random: Random) -> None:
    part = random.choice(("links", "joints"))
    new = random.choice(NAMES)
    if not snapshot[part] or new in snapshot[part]:
        return
    old = random.choice(list(snapshot[part]))
    rename(snapshot, part, old, new)


def rename(snapshot: Data, part: str, old: str, new: str) -> None:
    """Give a link or joint a new name, wherever it is mentioned."""
    snapshot[part][new] = snapshot[part].pop(old)
    for joint in snapshot["joints"].values():
        mentions = [(joint, "parent"), (joint, "child")] if part == "links" else [(joint.get("mimic", {}), "joint")]
        for holder, key in mentions:
            if holder.get(key) == old:
                holder[key] = new


def _add_leaf(snapshot: Data, random: Random) -> None:
    free = [name for name in NAMES if name not in snapshot["links"]]
    if free:
        name = random.choice(free)
        snapshot["links"][name] = _link(random)
        _attach(snapshot, name, random)


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


def _change_robot_name(snapshot: Data, random: Random) -> None:
    snapshot["name"] = random.choice(("robot", "machine"))


def _change_extensions(snapshot: Data, random: Random) -> None:
    owner = random.choice(("", f"link {next(iter(snapshot['links']))}"))
    texts = random.choice((["<gazebo/>"], ['<gazebo reference="arm"><a/></gazebo>', "<gazebo><b/></gazebo>"]))
    snapshot["extensions"][owner] = {"gazebo": texts}


MUTATIONS: tuple[Callable[[Data, Random], None], ...] = (
    _change_number,
    _toggle_inertial,
    _toggle_block,
    _toggle_drive,
    _change_type,
    _change_leader,
    _change_shapes,
    _change_shape,
    _rename,
    _add_leaf,
    _remove_leaf,
    _move_leaf,
    _change_robot_name,
    _change_extensions,
)
GROUPS = ("visuals", "collisions")


def _leaves(snapshot: Data) -> list[str]:
    parents = {joint["parent"] for joint in snapshot["joints"].values()}
    return [name for name, joint in snapshot["joints"].items() if joint["child"] not in parents]


def _leaders(snapshot: Data, follower: str) -> list[str]:
    """Joints that a joint can follow without a cycle."""
    joints = snapshot["joints"]

    def chain(name: str) -> list[str]:
        return [name, *(chain(joints[name]["mimic"]["joint"]) if "mimic" in joints[name] else [])]

    return [
        name for name in joints if name != follower and joints[name]["type"] in SCALAR and follower not in chain(name)
    ]


def _numbers(value: Any) -> list[tuple[Any, Any]]:
    """Holder and key of every number."""
    items = value.items() if isinstance(value, dict) else enumerate(value)
    found = []
    for key, item in items:
        if isinstance(item, float):
            found.append((value, key))
        elif isinstance(item, dict | list):
            found += _numbers(item)
    return found


def _attach(snapshot: Data, child: str, random: Random) -> None:
    name = random.choice([name for name in NAMES if name not in snapshot["joints"]])
    parent = random.choice([link for link in snapshot["links"] if link != child])
    kind = random.choice(TYPES)
    joint = {"type": kind, "parent": parent, "child": child, "origin": _origin(random), "axis": [0.0, 0.0, 1.0]}
    snapshot["joints"][name] = joint
    for block in BLOCKS:
        if random.random() < 0.4:
            _add_block(snapshot, name, block, random)


def _add_block(snapshot: Data, name: str, block: str, random: Random) -> None:
    joint = snapshot["joints"][name]
    if block == "limit":
        joint[block] = {"lower": -1.0, "upper": 1.0, **({"effort": 2.0} if random.random() < 0.5 else {})}
    elif block == "dynamics":
        joint[block] = {"damping": 0.0, "friction": 0.0}
    elif block == "calibration":
        joint[block] = {"rising": 0.5} if random.random() < 0.5 else {}
    elif block == "safety_controller":
        joint[block] = {"k_velocity": 1.0, "k_position": 1.0, "soft_lower_limit": 0.0, "soft_upper_limit": 0.0}
    elif leaders := _leaders(snapshot, name):
        joint[block] = {"joint": random.choice(leaders), "multiplier": 2.0, "offset": 0.0}


def _link(random: Random) -> Data:
    link: Data = {group: [_shape(random) for _ in range(random.choice((0, 0, 1, 2)))] for group in GROUPS}
    for shape in link["visuals"]:
        _change_material("visuals", shape, random)
    if random.random() < 0.5:
        link["inertial"] = _inertial(random)
    return link


def _inertial(random: Random) -> Data:
    return {"mass": 1.0, "origin": _origin(random), "inertia": dict.fromkeys(("ixx", "iyy", "izz"), 1.0)
            | dict.fromkeys(("ixy", "ixz", "iyz"), 0.0)}  # fmt: skip


def _shape(random: Random) -> Data:
    geometry = random.choice(
        (
            {"kind": "box", "size": [1.0, 2.0, 3.0]},
            {"kind": "sphere", "radius": 1.0},
            {"kind": "cylinder", "radius": 1.0, "length": 2.0},
            {"kind": "mesh", "filename": random.choice(FILES), "scale": [1.0, 1.0, 1.0]},
            {"kind": "mesh", "filename": random.choice(FILES), "scale": [1.0, 1.0, 1.0]},
        )
    )
    return {"geometry": copy.deepcopy(geometry), "origin": _origin(random), "name": random.choice(("", "", "cover"))}


def _material(random: Random) -> Data | None:
    name, rgba = random.choice(("", "red")), random.choice(([1.0, 0.0, 0.0, 1.0], [0.0, 0.5, 0.0, 1.0]))
    return random.choice((None, {"name": name}, {"name": name, "rgba": list(rgba)}, {"name": name, "texture": "t.png"}))


def _origin(random: Random) -> Data:
    return {"xyz": [float(random.randint(0, 2)), 0.0, 0.0], "rpy": [0.0, 0.0, 0.0]}

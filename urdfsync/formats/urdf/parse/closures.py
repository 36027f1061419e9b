"""Reads the loops, motors and joints in a YAML beside a URDF. `example-parallel-robots` has such files.

    closed_loop: [[FRAME, FRAME], …]          pairs of links
    type: [3d | 6d, …]                        a ball or a fixed joint for each pair
    name_mot: [JOINT, …]                      the joints that have a motor
    joint_name: [JOINT, …]                    joints whose type URDF lacks, each with
    joint_type: [SPHERICAL | UJOINT_XY | FIXED, …]

A joint of several axes becomes a chain of joints: see `chains`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from urdfsync.common.diagnostics import SourceError
from urdfsync.common.spelling import counted
from urdfsync.domain import Companion
from urdfsync.formats.urdf.robot import Loop, LoopKind

_KINDS: Mapping[str, LoopKind] = {"3d": "ball", "6d": "fixed"}
_TYPES = {
    "FIXED": "",
    "SPHERICAL": "xyz",
    **{f"UJOINT_{a}{b}": f"{a}{b}".lower() for a in "XYZ" for b in "XYZ" if a != b},
}
CLOSED_LOOP = re.compile(
    rb"""(?mx)^(?:\xef\xbb\xbf|\xff\xfe|\xfe\xff)?(?:\{\s*+)?  # at the top of the file, no nested key
    ["']?closed_loop["']?[ \t]*+:[ \t]*+(?:[\[&!]|(?:\#.*)?\r?$)  # with a list"""
)
"""What is in files with loops; other programs may have a key of this name."""
_KEYS = ("closed_loop", "type", "name_mot", "joint_name", "joint_type")
_NOTHING = "it states no loop, no motor and no joint"
_LARGEST = 100_000
"""The size limit of a YAML, in bytes: PyYAML needs up to 2 s and 60 MB. Even 10,000 loops need fewer bytes."""
_MOST = 10_000_000
"""The greatest number of bytes of all names: aliases of YAML may repeat a long name 10,000 times."""


class Closures(NamedTuple):
    """The statements of a YAML, each with its line."""

    file: str = ""
    loops: Sequence[tuple[Loop, int]] = ()
    motors: Sequence[tuple[str, int]] = ()
    """The joints that have a motor."""
    axes: Mapping[str, tuple[str, int]] = {}
    """Axes of joints, such as `xyz`; a joint without axes is fixed."""


def read_closures(companion: Companion) -> Closures:
    """Read a YAML. Raises SourceError for an unreadable YAML, and for one that states nothing."""
    from yaml import YAMLError  # a late import saves most robots 20 ms

    try:
        lists = dict(_lists(companion.content))
        motors = [(joint.value, joint.start_mark.line + 1) for joint in lists.get("name_mot", ())]
        return Closures(companion.file, _loops(lists), motors, _axes(lists))
    # ValueError for `\uD800`, OverflowError for `\UFFFFFFFF`
    except (YAMLError, _LoopsError, RecursionError, ValueError, OverflowError) as error:
        mark = getattr(error, "problem_mark", None)
        text = companion.content.replace(b"\0", b"")  # UTF-16 has a zero in each letter of the key
        before, is_there, _ = text.partition(b"closed_loop")
        line = mark.line + 1 if mark else before.count(b"\n") + 1 if is_there else 1
        problem = "lists are nested too deep" if isinstance(error, RecursionError) else getattr(error, "problem", None)
        message = f"this is no list of loops: {problem or error}"
        hint = "write `closed_loop: [[FRAME, FRAME]]` and `type: [6d]`"
        raise SourceError.of("loops-file", message, companion.file, line, hint=hint) from None


class _LoopsError(Exception):
    """An unreadable node of the YAML, with the attributes of PyYAML's errors."""

    def __init__(self, problem: str, node: Any = None) -> None:
        super().__init__(problem)
        self.problem, self.problem_mark = problem, node and node.start_mark


def _lists(content: bytes) -> Iterator[tuple[str, Sequence[Any]]]:
    """Yield the nodes of each list, also of an empty one; checks the size of the file and the shape of the lists."""
    size = 0
    for key, node in _keys(content).items():
        if node.value in ("", "null", "~"):
            yield key, ()
            continue
        if node.id != "sequence":
            raise _LoopsError(f"`{key}` is no list", node)
        for item in node.value:
            if key == "closed_loop" and (item.id != "sequence" or len(item.value) != 2):
                raise _LoopsError("an item of `closed_loop` is no pair of frames", item)
            for name in item.value if key == "closed_loop" else [item]:
                if name.id != "scalar" or not name.value:
                    raise _LoopsError(f"an item of `{key}` is no name", item)
                size += len(name.value.encode())  # refuses half a character such as `\uD800`
                if size > _MOST:
                    raise _LoopsError(f"the names have more than {_MOST:,} bytes")
        yield key, node.value


def _keys(content: bytes) -> dict[str, Any]:
    """Return the node of each key in `_KEYS` at the top of the file, in their order."""
    import yaml

    if len(content) > _LARGEST:
        raise _LoopsError(f"the file has more than {_LARGEST:,} bytes")
    document = yaml.compose(content, yaml.SafeLoader)
    if document is None or document.id != "mapping":
        raise _LoopsError(_NOTHING)
    parts = dict[str, Any]()
    for key, value in document.value:
        if key.id == "scalar" and key.value in parts:
            raise _LoopsError(f"the key `{key.value}` stands twice", key)
        if key.id == "scalar":
            parts[key.value] = value
    for key, node in parts.items():
        if key.startswith("closed_loop") and "closed_loop" not in parts and node.id == "sequence":
            raise _LoopsError(f"the key `{key}` is unknown; perhaps `closed_loop` is meant", node)
    if parts.keys().isdisjoint(_KEYS):
        raise _LoopsError(_NOTHING)
    return {key: parts[key] for key in _KEYS if key in parts}


def _pairs(lists: Mapping[str, Sequence[Any]], key: str, kinds_key: str, noun: str) -> Iterator[tuple[Any, Any]]:
    """Yield the items of two lists in pairs; `noun` stands for an item in messages."""
    items, kinds = lists.get(key, ()), lists.get(kinds_key, ())
    if len(items) != len(kinds):
        raise _LoopsError(f"the file has {counted(len(items), noun)} and {counted(len(kinds), f'{noun} type')}")
    yield from zip(items, kinds, strict=True)


def _loops(lists: Mapping[str, Sequence[Any]]) -> Sequence[tuple[Loop, int]]:
    loops = list[tuple[Loop, int]]()
    for pair, kind in _pairs(lists, "closed_loop", "type", "loop"):
        if kind.value.lower() not in _KINDS:
            raise _LoopsError(f"the type {kind.value!r} is none of {', '.join(_KINDS)}", kind)
        first, second = (end.value for end in pair.value)
        loops.append((Loop(f"{first}_{second}", _KINDS[kind.value.lower()], first, second), pair.start_mark.line + 1))
    return loops


def _axes(lists: Mapping[str, Sequence[Any]]) -> Mapping[str, tuple[str, int]]:
    axes = dict[str, tuple[str, int]]()
    for joint, kind in _pairs(lists, "joint_name", "joint_type", "joint"):
        if kind.value not in _TYPES:
            raise _LoopsError(f"the joint type {kind.value!r} is none of {', '.join(_TYPES)}", kind)
        axes[joint.value] = _TYPES[kind.value], joint.start_mark.line + 1
    return axes

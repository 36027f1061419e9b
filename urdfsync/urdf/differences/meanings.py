"""What the differences of two robots are in the words of URDF, and how far they reach into the package.

The classes follow from what the templates print: models hold structure and names, records hold numbers.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import msgspec

from urdfsync.difference import ChangeClass, Difference, Kind, Meaning, Version
from urdfsync.urdf.differences.shapes import GROUPS, Group, Looks, mesh_of
from urdfsync.urdf.differences.units import joint_unit, link_unit
from urdfsync.urdf.kinematics.tree import MOTION_KINDS
from urdfsync.urdf.meshes import lookup
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Mesh

_SCALAR = frozenset(MOTION_KINDS)
_MODELLED = {
    "axis": _SCALAR | {"planar"},
    "limit": _SCALAR,
    "dynamics": _SCALAR | {"planar"},
    "mimic": _SCALAR,
    "calibration": _SCALAR,
    "safety_controller": _SCALAR,
}
"""Per part of a joint, the types of joints that have it in Modelica; all others are in every joint."""
_STRUCTURE = frozenset({("type",), ("parent",), ("child",), ("dynamics",), ("mimic",), ("mimic", "joint")})
"""What of a joint its model says, as far as it is modelled; records have the rest."""
_UNLIMITED = frozenset({("limit", "lower"), ("limit", "upper")})
"""What a continuous joint does not have."""
_UNSCALED = lookup.key(Mesh(""))
"""How the key of a mesh without a scale ends."""


def describe(
    differences: Sequence[Difference], old: Version, new: Version, options: Options
) -> Sequence[Meaning | None]:
    """The meaning of each difference of two comparable versions."""
    meanings = _Meanings(old, new, options)
    return [meanings.of(difference) for difference in differences]


class _Meanings(msgspec.Struct, frozen=True, dict=True):
    old: Version
    new: Version
    options: Options

    def of(self, difference: Difference) -> Meaning | None:
        match difference.path:
            case ("imports", str(key)):
                return self._import(key)
            case ("links", str(name), *fields):
                return self._link(name, fields)
            case ("joints", str(name), "drive"):
                return self._drive(name, difference.kind)
            case ("joints", str(name), *fields):
                return self._joint(name, fields)
            case ("extensions", str(owner), *fields):
                return Meaning(_words(owner or "robot", fields or ["extensions"]), ChangeClass.UNMODELLED)
            case (*fields,):
                return Meaning(_words("robot", fields), ChangeClass.PARAMETER)

    def _link(self, name: str, fields: Sequence[str | int]) -> Meaning:
        words = _words(f"link {name}", fields)
        match fields:
            case []:
                return Meaning(words, ChangeClass.STRUCTURAL)
            case ["visuals" | "collisions" as group, int(index), *inside]:
                words = (words[0], f"{group[:-1]} {index + 1}", *_words("", inside)[1:])
                return Meaning(words, self._shape(name, group, index, inside), link_unit(_field(inside)))
            case _:
                return Meaning(words, ChangeClass.PARAMETER, link_unit(_field(fields)))

    def _shape(self, link: str, group: Group, index: int, inside: Sequence[str | int]) -> ChangeClass:
        old = self._old_looks.of(self.old.snapshot["links"][link], group, index)
        new = self._new_looks.of(self.new.snapshot["links"][link], group, index)
        if old is None and new is None:
            stands = group == "collisions" and self._stands_on_hidden_shapes and inside[:1] != ["name"]
            return ChangeClass.PARAMETER if stands else ChangeClass.UNMODELLED
        match inside:
            case [] | ["geometry", *_] if old != new:
                return ChangeClass.STRUCTURAL
            case ["material", "name" | "texture"]:
                return ChangeClass.UNMODELLED
            case ["material"] if not self._is_coloured(link, index):
                return ChangeClass.UNMODELLED
            case _:
                return ChangeClass.PARAMETER

    def _is_coloured(self, link: str, index: int) -> bool:
        """Whether a visual whose material comes or goes has a colour in either version."""
        visuals = [version.snapshot["links"][link]["visuals"][index] for version in (self.old, self.new)]
        return any("rgba" in visual.get("material", {}) for visual in visuals)

    def _joint(self, name: str, fields: Sequence[str | int]) -> Meaning:
        words = _words(f"joint {name}", fields)
        if not fields:
            return Meaning(words, ChangeClass.STRUCTURAL)
        versions = [version.snapshot["joints"] for version in (self.old, self.new)]
        place = tuple(field for field in fields if isinstance(field, str))
        classes = [_joint_class(joints[name]["type"], place) for joints in versions]
        units = [joint_unit(joints[name], joints, place[-1]) for joints in versions if _has(joints[name], place)]
        unit = " → ".join(dict.fromkeys(filter(None, units)))
        return Meaning(words, max(classes, key=lambda c: c.rank), unit)

    def _drive(self, name: str, kind: Kind) -> Meaning | None:
        """A joint that begins or ceases to be driven; None if its type or mimic says so, or if an option decides."""
        if kind is not Kind.CHANGED or self.options.driven is not None or "package" not in self.options.approach:
            return None
        return Meaning((f"joint {name}", "drive"), ChangeClass.STRUCTURAL)

    def _import(self, key: str) -> Meaning | None:
        """A mesh that some shape shows in both versions; what else comes or goes follows from other changes."""
        shapes = self._shared_meshes.get(key, ())
        if not shapes:
            return None
        same = all(self._old_looks.look(*shape) == self._new_looks.look(*shape) for shape in shapes)
        words = (f"mesh {key.removesuffix(_UNSCALED)}", "content")
        return Meaning(words, ChangeClass.PARAMETER if same else ChangeClass.STRUCTURAL)

    @property
    def _stands_on_hidden_shapes(self) -> bool:
        """Whether the record has a standing height that follows from collisions that no model shows."""
        return self.options.base == "floating" and not self.options.collisions

    @functools.cached_property
    def _old_looks(self) -> Looks:
        return Looks(self.old.imports, self.options)

    @functools.cached_property
    def _new_looks(self) -> Looks:
        return Looks(self.new.imports, self.options)

    @functools.cached_property
    def _shared_meshes(self) -> Mapping[str, Sequence[tuple[Mapping[str, Any], Group]]]:
        """Per mesh, the shapes that have it in both versions, each with its group."""
        result: dict[str, list[tuple[Mapping[str, Any], Group]]] = {}
        for key, shape, group in self._places():
            result.setdefault(key, []).append((shape, group))
        return result

    def _places(self) -> Iterator[tuple[str, Mapping[str, Any], Group]]:
        for name, link in self.new.snapshot["links"].items():
            before = self.old.snapshot["links"].get(name)
            for group in GROUPS if before is not None else ():
                for one, two in zip(before[group], link[group], strict=False):
                    key = mesh_of(two)
                    if key is not None and mesh_of(one) == key:
                        yield key, two, group


def _joint_class(kind: str, place: tuple[str, ...]) -> ChangeClass:
    """How far a change at this place of a joint of this type reaches."""
    if kind not in _MODELLED.get(place[0], (kind,)) or (kind == "continuous" and place in _UNLIMITED):
        return ChangeClass.UNMODELLED
    return ChangeClass.STRUCTURAL if place in _STRUCTURE else ChangeClass.PARAMETER


def _has(joint: Mapping[str, Any], place: Sequence[str]) -> bool:
    value: Any = joint
    for field in place:
        if not isinstance(value, Mapping) or field not in value:
            return False
        value = value[field]
    return True


def _words(element: str, fields: Sequence[str | int]) -> tuple[str, ...]:
    """A path as people read it: an index goes with its list."""
    words = [element]
    for field in fields:
        if isinstance(field, int):
            words[-1] += f"[{field}]"
        else:
            words.append(field)
    return tuple(words)


def _field(fields: Sequence[str | int]) -> str:
    """The innermost name."""
    return next((field for field in reversed(fields) if isinstance(field, str)), "")

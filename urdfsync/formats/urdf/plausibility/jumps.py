"""Finds numbers that jump from one export to the next, by the ratio of two units or more."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import msgspec

from urdfsync.domain import ElementKey
from urdfsync.domain.jumps import more, units_of
from urdfsync.formats.urdf.robot import Robot
from urdfsync.formats.urdf.validate import Finding

_JUMP = 9.99
"""A greater ratio of two masses is probably a mistake: a factor of 10, with room for rounding."""


class _Jump(NamedTuple):
    path: str
    before: float
    after: float


def find_jumps(old: Robot, new: Robot, renames: Mapping[ElementKey, str]) -> Iterator[Finding]:
    """Yield a warning for each kind of jump since the old version, at the first part that jumps.

    Masses jump by a factor of 10, other numbers by the ratio of two units. A link with a shape loses its `<inertial>`.
    """
    masses, units, lost = list[_Jump](), defaultdict[str, list[_Jump]](list), list[str]()
    for kind in ("link", "joint"):
        before = {renames.get((kind, one.name), one.name): one for one in getattr(old, f"{kind}s")}
        for one in getattr(new, f"{kind}s"):
            former, path = before.get(one.name), f"{kind} {one.name}"
            if former is None or former == one:
                continue
            if kind == "link" and former.inertial and not one.inertial and (one.visuals or one.collisions):
                lost.append(path)
            inertials = (part.inertial if kind == "link" else None for part in (former, one))
            mass, new_mass = (part.mass if part else 0.0 for part in inertials)
            has_jumped = min(mass, new_mass) > 0 and max(mass, new_mass) >= _JUMP * min(mass, new_mass)
            if has_jumped:
                masses.append(_Jump(f"{path} / inertial / mass", mass, new_mass))
            for place, a, b in _numbers(former, one, path):
                is_told = has_jumped and " / inertial / " in place  # an inertia grows with its mass
                if a and b and not is_told and (unit := units_of(abs(b / a))):
                    units[unit].append(_Jump(place, a, b))
    if masses:
        first, path = masses[0], masses[0].path.partition(" / ")[0]
        are_grams = all(units_of(jump.after / jump.before) == units_of(1000) for jump in masses)
        ratio = ", by the ratio of kg and g" if are_grams else ""
        message = f"{path}: its mass jumps, {first.before:g} kg → {first.after:g} kg{more(masses)}{ratio}"
        yield Finding("mass-jump", first.path, message)
    for unit, jumps in units.items():
        first = jumps[0]
        message = f"{first.path} jumps from {first.before:g} to {first.after:g}{more(jumps)}, by the ratio of {unit}"
        yield Finding("unit-jump", first.path, message)
    if lost:
        message = f"{lost[0]} has lost its <inertial>{more(lost)}"
        yield Finding("inertial-lost", f"{lost[0]} / inertial", message)


def _numbers(old: Any, new: Any, path: str) -> Iterator[tuple[str, float, float]]:
    """Yield the numbers of two structs that differ, with their path."""
    for name in new.__struct_fields__:
        a, b = getattr(old, name), getattr(new, name)
        place = f"{path} / {name}"
        if a == b or type(a) is not type(b):
            continue
        if isinstance(b, float):
            yield place, a, b
        elif isinstance(b, msgspec.Struct):
            yield from _numbers(a, b, place)
        elif isinstance(b, tuple) and len(a) == len(b):
            for number, (one, other) in enumerate(zip(a, b, strict=True), start=1):
                if isinstance(other, float):
                    yield place, one, other
                elif isinstance(other, msgspec.Struct) and type(one) is type(other):
                    yield from _numbers(one, other, f"{path} / {name.removesuffix('s')} {number}")

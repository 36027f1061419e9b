"""Keeps the numbers of shapes, and so the names of their components, if an export lists the shapes in another order."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias, TypeVar

from msgspec import to_builtins
from msgspec.structs import replace

from urdfsync.domain import ElementKey, Features, Version, displaced
from urdfsync.domain.matching import match
from urdfsync.formats.urdf.diff.renames import without_names
from urdfsync.formats.urdf.meshes import lookup
from urdfsync.formats.urdf.robot import Collision, Link, Mesh, Robot, Visual, shape_numbers

_Shape = TypeVar("_Shape", Visual, Collision)
_Meshes: TypeAlias = Mapping[str, str]
"""Hashes of mesh files by their keys."""


def keep_numbers(
    new: Version, formers: Sequence[Version], find_renames: Callable[[Version], Mapping[ElementKey, str]]
) -> Robot:
    """Return the robot whose shapes have the numbers that they have in former versions, the first of these first.

    A new shape gets a number that no former shape of its link has.
    """
    robot: Robot = new.snapshot
    shapes = _shapes(robot)
    if all(_shapes(old.snapshot) == shapes for old in formers):  # finding renames takes 8 ms with 100 links
        return robot
    olds = [(_by_new_name(old.snapshot, find_renames(old)), _shared_meshes(old, new)) for old in formers]
    links = []
    for link in robot.links:
        found = [(links_before[link.name], meshes) for links_before, meshes in olds if link.name in links_before]
        visuals = _numbered(link.visuals, [(old.visuals, meshes) for old, meshes in found])
        collisions = _numbered(link.collisions, [(old.collisions, meshes) for old, meshes in found])
        links.append(replace(link, visuals=visuals, collisions=collisions))
    return replace(robot, links=tuple(links))


def _shapes(robot: Robot) -> dict[str, tuple[Sequence[Visual], Sequence[Collision]]]:
    return {link.name: (link.visuals, link.collisions) for link in robot.links}


def _by_new_name(robot: Robot, renames: Mapping[ElementKey, str]) -> dict[str, Link]:
    gone = displaced(renames)
    links = [(("link", link.name), link) for link in robot.links]
    return {renames.get(key, link.name): link for key, link in links if key not in gone}


def _shared_meshes(old: Version, new: Version) -> tuple[_Meshes, _Meshes]:
    """Return the meshes of each version whose contents the other one has, too: exporters number files, as well."""
    sides = [{name: file.source_hash for name, file in (version.imports or {}).items()} for version in (old, new)]
    shared = set(sides[0].values()) & set(sides[1].values())
    before, after = ({name: sha256 for name, sha256 in side.items() if sha256 in shared} for side in sides)
    return before, after


def _numbered(
    shapes: Sequence[_Shape], formers: Sequence[tuple[Sequence[_Shape], tuple[_Meshes, _Meshes]]]
) -> tuple[_Shape, ...]:
    """Return the shapes of a link with lasting numbers; `formers` have its former shapes, and meshes of both sides."""
    numbers = dict[int, int]()  # by place
    for old, (meshes_before, meshes_after) in formers:
        numbers = _known_numbers(old, meshes_before, shapes, meshes_after) | numbers
    count = Counter(numbers.values())  # two branches of git may have given one number to two shapes: then it means none
    unused = itertools.count(1 + max((number for old, _ in formers for number in shape_numbers(old)), default=0))
    lasting = [
        numbers[place] if count[numbers.get(place, 0)] == 1 else next(unused) for place in range(1, len(shapes) + 1)
    ]
    return tuple(
        replace(shape, number=None if number == place else number)
        for place, (number, shape) in enumerate(zip(lasting, shapes, strict=True), 1)
    )


def _known_numbers(
    old: Sequence[_Shape], meshes_before: _Meshes, new: Sequence[_Shape], meshes_after: _Meshes
) -> dict[int, int]:
    """Return the numbers of the new shapes that are old ones, by place."""
    before, after = _features(old, meshes_before), _features(new, meshes_after)
    matching, places = match(before, after), {key: place for place, key in enumerate(after, 1)}
    lost = (displaced(matching.renames) | matching.doubts.keys()) - matching.renames.keys()
    olds = zip(before, shape_numbers(old), strict=True)
    keys = [((key[0], matching.renames.get(key, key[1])), number) for key, number in olds if key not in lost]
    return {places[key]: number for key, number in keys if key in places}


def _features(shapes: Sequence[Visual | Collision], meshes: _Meshes) -> dict[ElementKey, Features]:
    """Return the features of shapes; a shape without a name of its own has its place as name.

    A mesh of both versions is known by its contents. Other meshes have their names.
    """
    names, features = Counter(shape.name for shape in shapes), dict[ElementKey, Features]()
    for place, shape in enumerate(shapes, 1):
        contents = without_names(to_builtins(shape))
        if isinstance(shape.geometry, Mesh):
            contents["file"] = meshes.get(lookup.key(shape.geometry), shape.geometry.filename)
        is_named = shape.name[:1] not in ("", "#") and names[shape.name] == 1
        features["shape", shape.name if is_named else f"#{place}"] = Features(contents, {})
    return features

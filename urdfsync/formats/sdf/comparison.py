"""Reads masses and shapes of an SDF a second time, without code of the translation, and compares them with its URDF.

All joints are at zero. Frames have full names: `/arm::hand::palm` is a link, `/arm::hand::__model__` the model around
it. The translation has refused what has no meaning, so this reading does not look for faults.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple
from urllib.parse import unquote

import numpy as np
from lxml import etree

from urdfsync.engine.sources.ros_packages import Packages
from urdfsync.formats.translation.files import Files, TranslationError
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.second.reading import TENSOR, SecondElement, origin, pose, poses, read_again

UNCOMPARED = "joints, contacts and sensors of the SDF, and an inertia that it leaves to Gazebo (`auto`)"
_MODEL, _WORLD = "__model__", "world"
_SIZES: Mapping[str, Mapping[str, Sequence[float]]] = {
    "box": {"size": (1.0, 1.0, 1.0)},
    "sphere": {"radius": (1.0,)},
    "ellipsoid": {"radii": (1.0, 1.0, 1.0)},
    "cylinder": {"radius": (1.0,), "length": (1.0,)},
    "capsule": {"radius": (0.5,), "length": (1.0,)},
    "mesh": {"scale": (1.0, 1.0, 1.0)},
}
"""The numbers of each shape, with their defaults."""
_NEWEST = 12
"""The minor number of the newest version of SDF."""
_TOLERANCE, _LEAST = 1e-9, 1e-30
"""The greatest relative difference that counts as agreement, and the least size of a number."""


class _Part(NamedTuple):
    """A link, joint, frame or model."""

    element: Any
    """It has the pose."""
    scope: tuple[str, str]
    """The beginning of the full names around it, and the full name of the model's frame there."""
    base: str
    """The frame in which the pose is given, unless the pose names one."""
    inner: tuple[str, str] = ("", "")
    """The scope in a model."""
    anchor: str = ""
    """The frame in a model that gets the model's pose; empty for the model's own frame."""


def compare(files: Files, packages: Packages, source: str, text: str) -> tuple[int, tuple[str, ...]]:
    """Return how many numbers were compared, and a clause for each part of a link that differs."""
    urdf, sdf = read_again(text.encode(), Options()), _Reading(files, packages, source)
    placed, total, differences = poses(urdf), 0, list[str]()
    robot = f"/{_root(text.encode()).get('name')}::"
    # before SDF 1.7, a link could be called `world`; the translation gives it another name
    full = {name: robot + (name if robot + name in sdf.parts else _WORLD) for name in placed}
    root = full[next(iter(placed))]
    to_root = np.linalg.inv(sdf.place(root)) if root in sdf.parts else np.eye(4)
    for name, link in urdf.links.items():
        if (part := sdf.parts.get(full[name])) is None or part.element.tag != "link":
            continue
        first = {title: each for title, *each in sdf.things(part, full[name])}
        second = {title: each for title, *each in _things(link)}
        for title in sorted(first.keys() | second.keys() - {"inertial"}):
            if title not in first or title not in second:
                differences.append(f"link {name} has no {title} in the {'URDF' if title in first else 'SDF'}")
                continue
            frames = to_root @ first[title][1], placed[name] @ second[title][1]
            for quantity, least, pair in (
                ("numbers", _LEAST, (first[title][0], second[title][0])),
                ("poses", 1.0, frames),
            ):
                value, other = map(np.ravel, pair)
                total += value.size
                error = float((np.abs(value - other) / np.maximum(least, np.abs(value))).max())
                if not error <= _TOLERANCE:  # not a number is an error, too
                    differences.append(f"{quantity} of {title} of link {name} differ by {error:.1e}")
    return total, tuple(differences)


def _things(link: SecondElement) -> Iterator[tuple[str, Any, Any]]:
    """Yield the inertial and the shapes of a link of the URDF: title, numbers, and pose in the link."""
    values: dict[str, Any] = {path: stated.value for path, stated in link.values.items()}
    if "inertial.mass" in values:
        numbers = [values["inertial.mass"], *(values[f"inertial.inertia.{each}"] for each in TENSOR)]
        yield "inertial", np.ravel(numbers), origin(link, "inertial.origin")
    for path, kind in ((path[: -len(".shape")], kind) for path, kind in values.items() if path.endswith(".shape")):
        file, scale = values.get(f"{path}.uri", ("", ()))
        sizes = [scale] if kind == "mesh" else [np.ravel(values[f"{path}.{name}"]) for name in _SIZES[kind]]
        yield _title(path, kind, file), np.concatenate(sizes), origin(link, f"{path}.origin")


def _title(path: str, kind: str, file: str) -> str:
    return f"{path} ({kind} {os.path.basename(file.strip())}".rstrip() + ")"  # noqa: PTH119


class _Reading:
    """The frames of an SDF, and of the files that it includes."""

    def __init__(self, files: Files, packages: Packages, source: str) -> None:
        self._files, self._packages = files, packages
        self.parts = dict[str, _Part]()
        root = _root(files.read(source))
        world = root.find("world")
        self._enter(root if world is None else world, source, ("/", _WORLD))

    def _enter(self, holder: Any, file: str, scope: tuple[str, str]) -> None:
        """Add the parts of a model or world."""
        for tag in ("link", "frame", "joint"):
            for part in holder.iterchildren(tag):
                base = part.findtext("child").strip() if tag == "joint" else part.get("attached_to") or _MODEL
                self.parts.setdefault(scope[0] + part.get("name").strip(), _Part(part, scope, base))
        for part in holder.iterchildren("model", "include"):
            model, path, name = part, file, part.get("name")
            if part.tag == "include":
                try:
                    path = self._find(file, part.findtext("uri").strip())
                    self._files.check_inside(path, (file, part.sourceline))
                    model = _root(self._files.read(path)).find("model")
                except TranslationError:  # scenery may be absent
                    continue
                name = part.findtext("name") or model.get("name")
            is_merged = part.get("merge") in ("true", "1") and scope[1] != _WORLD
            around = f"{scope[0]}{name.strip()}::"
            inner = (scope[0] if is_merged else around), around + _MODEL
            anchor = (part.findtext("placement_frame") or model.get("placement_frame") or "").strip()
            self.parts[inner[1]] = _Part(model if part.find("pose") is None else part, scope, _MODEL, inner, anchor)
            self._enter(model, path, inner)

    def _find(self, file: str, uri: str) -> str:
        """Return the file that an `<include>` in another file names."""
        scheme, _, rest = uri.rpartition("://")
        folder = os.path.dirname(file)  # noqa: PTH120
        if scheme in ("model", "package"):
            name, _, rest = rest.lstrip("/").partition("/")
            folder = str(self._packages.folder(name))
        path = os.path.normpath(os.path.join(folder, unquote(rest) if scheme else rest))  # noqa: PTH118
        if path.endswith((".sdf", ".world", ".xml")):
            return path
        config = _root(self._files.read(os.path.join(path, "model.config")))  # noqa: PTH118
        named = {int(sdf.get("version", "1.4")[2:]): sdf.text.strip() for sdf in config.findall("sdf")}
        newest = max(version for version in named if version <= _NEWEST)
        return os.path.normpath(os.path.join(path, named[newest]))  # noqa: PTH118

    def _named(self, scope: tuple[str, str], name: str) -> str:
        """Return the full name of a frame that has a name in a scope."""
        full = scope[0] + name
        known = (each for each in (full, f"{full}::{_MODEL}") if each in self.parts)
        return scope[1] if name == _MODEL else next(known, _WORLD)

    def _base(self, part: _Part, holder: Any, base: str) -> str:
        """Return the full name of the frame in which the pose of an element of a part is given."""
        element = holder.find("pose")
        word = None if element is None else element.get("relative_to") or element.get("frame")
        return self._named(part.scope, word or base)

    def place(self, name: str, end: str = _WORLD) -> Any:
        """Return the pose of a frame in another one, in which it is given, perhaps by frames between the two."""
        if name in (end, _WORLD):
            return np.eye(4)
        part = self.parts[name]
        local = _pose(part.element)
        if part.anchor:
            local = local @ np.linalg.inv(self.place(self._named(part.inner, part.anchor), name))
        return self.place(self._base(part, part.element, part.base), end) @ local

    def things(self, part: _Part, name: str) -> Iterator[tuple[str, Any, Any]]:
        """Yield the inertial and the shapes of a link: title, numbers, and pose in the world."""
        link, inertial = part.element, part.element.find("inertial")
        if inertial is None or inertial.get("auto", "").strip().lower() not in ("true", "1"):
            numbers = [_numbers(inertial, "mass", (1.0,))]
            numbers += [_numbers(inertial, f"inertia/{each}", (float(each[1] == each[2]),)) for each in TENSOR]
            yield "inertial", np.ravel(numbers), self.place(name) @ _pose(inertial)
        for tag in ("visual", "collision"):
            shapes = [(shape, kind) for shape in link.iterchildren(tag) for kind in shape.findall("geometry/*")[:1]]
            drawn = [(shape, kind) for shape, kind in shapes if kind.tag in _SIZES and kind.find("submesh") is None]
            for number, (shape, kind) in enumerate(drawn, start=1):
                frame = self.place(self._base(part, shape, link.get("name").strip())) @ _pose(shape)
                sizes = [_numbers(kind, name, usual) for name, usual in _SIZES[kind.tag].items()]
                yield _title(f"{tag}{number}", kind.tag, kind.findtext("uri", "")), np.concatenate(sizes), frame


def _root(content: bytes) -> Any:
    # the files may have prefixes without a namespace, and comments that contain `--`
    parser = etree.XMLParser(recover=True, resolve_entities=False, no_network=True, remove_comments=True)
    return etree.fromstring(content, parser)


def _numbers(holder: Any, path: str, usual: Sequence[float]) -> Any:
    text = (None if holder is None else holder.findtext(path)) or ""
    return np.array(text.split() or usual, float)


def _pose(holder: Any) -> Any:
    """Return the 4×4 matrix of the pose in an element; the identity without one."""
    element = None if holder is None else holder.find("pose")
    numbers = _numbers(holder, "pose", (0.0,) * 6)
    place, turn = numbers[:3], numbers[3:]
    if len(turn) == 4:
        x, y, z, w = turn / np.linalg.norm(turn)
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        return pose(place, np.eye(3) + 2 * w * cross + 2 * cross @ cross)
    return pose(place, np.radians(turn) if element is not None and element.get("degrees") in ("true", "1") else turn)

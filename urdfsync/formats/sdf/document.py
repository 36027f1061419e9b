"""Reads the files of an SDF and the values in their elements; each element has a place in one of the files."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from pathlib import Path
from urllib.parse import unquote
from xml.etree.ElementTree import Element

from urdfsync.engine.sources.ros_packages import Packages
from urdfsync.formats.translation.files import Files, SourcePlace
from urdfsync.formats.urdf.kinematics.poses import IDENTITY, Pose, pose, roll_pitch_yaw
from urdfsync.formats.urdf.parse.fields import parse_numbers, quoted
from urdfsync.formats.urdf.robot import Origin

SdfVersion = tuple[int, ...]
_OLDEST, _NEWEST = (1, 3), (1, 12)
"""SDF 1.2 has other elements; 1.12 is the newest in libsdformat 15."""
_INFINITE = {"inf": math.inf, "+inf": math.inf, "-inf": -math.inf}
_TRUTHS = {"true": True, "1": True, "false": False, "0": False}
_SCHEMES = ("model://", "package://")
"""Schemes whose first word names a folder or a ROS package."""
_CONFIG = "model.config"
"""The file in the folder of a model that names its SDF files, each with a version."""


class SdfDocument:
    """The elements of an SDF and of the files that it includes."""

    def __init__(self, source: str, files: Files, packages: Sequence[str] = ()) -> None:
        """`packages` are folders with models and ROS packages."""
        self.source, self.files, self.places, self.fault = source, files, files.places, files.fault
        self.packages = Packages(list(map(Path, packages)), Path(source))
        self._roots: dict[str, Element] = {}

    def read(self, path: str, place: SourcePlace = ("", 0)) -> tuple[Element, SdfVersion]:
        """Return the root element of an SDF, and its version. Raises TranslationError."""
        if path not in self._roots:
            # libsdformat's parser accepts such comments, and 20 of Gazebo's own examples have them
            self._roots[path] = self.files.parse(path, place, has_any_comments=True)
        root = self._roots[path]
        if root.tag != "sdf":
            hint = "convert it, or name it as a robot of its own" if root.tag == "robot" else ""
            raise self.fault(root, f"the root element is <{root.tag}> and not <sdf>", hint)
        text = root.get("version", "")
        major, _, minor = text.partition(".")
        if not (major.isdecimal() and minor.isdecimal() and len(text) < 10):
            message = f"version={quoted(text)} is no version of SDF" if text else "<sdf> has no version"
            raise self.fault(root, message, 'write <sdf version="1.9">, or the version that the file was written for')
        version = int(major), int(minor)
        if not _OLDEST <= version <= _NEWEST:
            message = f"the file is of SDF {text}, and urdfsync reads 1.{_OLDEST[1]} to 1.{_NEWEST[1]}"
            hint = "install a newer urdfsync" if version > _NEWEST else "convert it by `gz sdf -p`"
            raise self.fault(root, message, hint)
        return root, version

    def find(self, element: Element, uri: str) -> str:
        """Return the path of the SDF that the `<uri>` of an `<include>` names. Raises TranslationError."""
        place = self.places[element]
        scheme, _, rest = uri.rpartition("://")
        folder = os.path.dirname(place[0])  # noqa: PTH120
        if f"{scheme}://" in _SCHEMES:
            name, _, rest = rest.lstrip("/").partition("/")
            if (found := self.packages.folder(name)) is None:
                hint = "add the folder around it to `package_paths`"
                raise self.fault(element, f"there is no folder {name!r} for {uri}", hint)
            folder = str(found)
        elif scheme not in ("", "file"):
            raise self.fault(element, f"{uri} is not on this machine", "download it, and name its folder by model://")
        path = os.path.normpath(os.path.join(folder, unquote(rest) if scheme else rest))  # noqa: PTH118
        self.files.check_inside(path, place)
        return path if os.path.splitext(path)[1] in (".sdf", ".world", ".urdf", ".xml") else self._chosen(path, place)  # noqa: PTH122

    def _chosen(self, folder: str, place: SourcePlace) -> str:
        """Return the SDF of the newest known version in the folder of a model."""
        root = self.files.parse(os.path.join(folder, _CONFIG), place)  # noqa: PTH118
        names = dict[SdfVersion, str]()
        for sdf in root.iterfind("sdf"):
            words = sdf.get("version", "1.4").split(".")
            version = tuple(int(word) for word in words if word.isdecimal() and len(word) < 10)
            if version <= _NEWEST:
                names[version] = (sdf.text or "").strip()
        if not names:
            raise self.fault(root, "it names no <sdf> of a version that urdfsync reads")
        path = os.path.normpath(os.path.join(folder, names[max(names)]))  # noqa: PTH118
        self.files.check_inside(path, place)
        return path

    def name(self, element: Element) -> str:
        """Return the name of an element. Raises TranslationError."""
        if not (name := element.get("name", "").strip()):
            raise self.fault(element, f"<{element.tag}> has no name")
        return name

    def numbers(self, element: Element | None, tag: str, default: Sequence[float]) -> tuple[float, ...]:
        """Return the numbers in the text of a child; an absent or empty one has the `default`.

        Raises TranslationError.
        """
        # the paths of ElementTree refuse a prefix without a namespace, such as drake:gear_ratio
        children = (part for part in (() if element is None else element) if part.tag == tag)
        child = next(children, None) if ":" in tag or element is None else element.find(tag)
        words = ((child.text if child is not None else "") or "").split()
        if child is None or not words:
            return tuple(default)
        try:
            if len(words) == len(default):
                known = [_INFINITE.get(word.lower()) for word in words]
                return tuple(
                    parse_numbers(word, 1)[0] if value is None else value
                    for word, value in zip(words, known, strict=True)
                )
            return parse_numbers(" ".join(words), len(default))
        except ValueError as error:
            raise self.fault(child, f"<{tag}> {quoted(' '.join(words))} {error}") from None

    def number(self, element: Element | None, tag: str, default: float) -> float:
        """Return the number in the text of a child. Raises TranslationError."""
        return self.numbers(element, tag, (default,))[0]

    def flag(self, element: Element, tag: str, *, default: bool = False) -> bool:
        """Return the truth in the text of a child. Raises TranslationError."""
        child = element.find(tag)
        word = ((child.text if child is not None else "") or "").strip().lower()
        if child is not None and word and word not in _TRUTHS:
            raise self.fault(child, f"<{tag}> {quoted(word)} is neither true nor false")
        return _TRUTHS.get(word, default)

    def pose(self, holder: Element) -> Pose:
        """Return the numbers of the `<pose>` in an element; without one, the identity. Raises TranslationError."""
        element = holder.find("pose")
        if element is None:
            return IDENTITY
        form = element.get("rotation_format", "euler_rpy")
        if form not in ("euler_rpy", "quat_xyzw"):
            message = f"<pose> has the unknown rotation_format {quoted(form)}"
            raise self.fault(element, message, "write euler_rpy or quat_xyzw")
        x, y, z, *turn = self.numbers(holder, "pose", (0.0,) * 6 if form == "euler_rpy" else (0.0,) * 6 + (1.0,))
        if len(turn) == 4 and not any(turn):
            raise self.fault(element, "the quaternion of <pose> has no direction")
        if len(turn) == 4:
            rpy = roll_pitch_yaw(turn)
        else:
            degrees = _TRUTHS.get(element.get("degrees", "").strip().lower(), False)
            rpy = tuple(map(math.radians, turn) if degrees else turn)  # type: ignore[assignment] # three numbers
        if not all(map(math.isfinite, (x, y, z, *rpy))):
            raise self.fault(element, "<pose> has a number that is not finite")
        return pose(Origin((x, y, z), rpy))

"""Sources in MJCF, translated without a disk, and read as robots."""

from __future__ import annotations

import os
import struct
from collections.abc import Mapping

import numpy as np
import pytest

from urdfsync.common.diagnostics import Severity
from urdfsync.formats.mjcf.document import MjcfDocument, read_document
from urdfsync.formats.mjcf.urdf import translated
from urdfsync.formats.translation.files import Files, TranslationError
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.parse.source import RobotReading, read_robot
from urdfsync.formats.urdf.robot import Joint, Link, Robot

FOLDER = "/robots/arm"
SOURCE = f"{FOLDER}/arm.xml"
ARM = """\
<mujoco model="arm">
  <worldbody>
    <body name="upper" pos="0 0 0.5">
      <joint name="shoulder" axis="0 1 0" range="-90 90" damping="2"/>
      <inertial pos="0 0 0.2" mass="1.5" diaginertia="0.02 0.02 0.01"/>
      <body name="fore" pos="0 0 0.4" euler="0 0 30">
        <joint name="elbow" axis="0 1 0" armature="0.1" stiffness="4"/>
        <geom type="box" size="0.1 0.2 0.3" mass="3"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""
"""A robot of two hinges."""


CORNERS = np.array([(5, 6, 7), (6, 6, 7), (5, 8, 7), (5, 6, 10)], float)
"""Corners of a mesh far from its origin, with three different edges."""


def stl(size: float = 1) -> bytes:
    """A tetrahedron, `size` times as large."""
    faces = [size * CORNERS[list(face)] for face in ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))]
    rows = b"".join(struct.pack("<12fH", 0, 0, 0, *face.ravel(), 0) for face in faces)
    return bytes(80) + struct.pack("<I", len(faces)) + rows


def world(inside: str, outside: str = "") -> str:
    """An MJCF with these elements in the world, and beside it."""
    return f'<mujoco model="arm">\n{outside}<worldbody>{inside}</worldbody></mujoco>'


def body(inside: str, outside: str = "") -> str:
    """An MJCF whose only body `part` of 2 kg has these elements."""
    inertial = '<inertial pos="0 0 0" mass="2" diaginertia="0.1 0.1 0.1"/>'
    return world(f'<body name="part">{inertial}{inside}</body>', outside)


def document(text: str, files: Mapping[str, str | bytes] | None = None) -> MjcfDocument:
    """Read an MJCF; `files` stand in its folder."""
    contents = {
        SOURCE: text,
        **{os.path.normpath(f"{FOLDER}/{name}"): content for name, content in (files or {}).items()},
    }
    encoded = {path: text.encode() if isinstance(text, str) else text for path, text in contents.items()}
    return read_document(SOURCE, Files(encoded, [FOLDER]))


def urdf(text: str, files: Mapping[str, str | bytes] | None = None, robot: str = "") -> str:
    """Return the URDF of an MJCF."""
    return translated(document(text, files), robot)[0]


def reading(text: str, files: Mapping[str, str | bytes] | None = None, robot: str = "") -> RobotReading:
    """Read an MJCF as builds do that leave out what no model has."""
    return read_robot(urdf(text, files, robot).encode(), SOURCE, Options(base="floating", allow=("part-left-out",)))


def read(text: str, files: Mapping[str, str | bytes] | None = None, robot: str = "") -> Robot:
    """Return the robot in an MJCF, which has no error."""
    found = reading(text, files, robot)
    assert found.robot is not None, found.diagnostics
    return found.robot


def joint(robot: Robot, name: str) -> Joint:
    """Return the joint with this name."""
    return next(joint for joint in robot.joints if joint.name == name)


def link(robot: Robot, name: str) -> Link:
    """Return the link with this name."""
    return next(link for link in robot.links if link.name == name)


def left_out(text: str) -> list[str]:
    """Return what the translation leaves out, in words."""
    found = read_robot(urdf(text).encode(), SOURCE)
    errors = [each for each in found.diagnostics if each.severity is Severity.ERROR]
    assert {each.code for each in errors} <= {"part-left-out"}
    return [each.message.partition(":")[0] for each in errors]


def noted(text: str) -> str:
    """Return the note on what has no effect."""
    return "; ".join(each.message for each in reading(text).unmodelled)


def problem(text: str, files: Mapping[str, str | bytes] | None = None, robot: str = "") -> str:
    """Return the fault for which there is no robot: file, line, message and hint."""
    with pytest.raises(TranslationError) as error:
        urdf(text, files, robot)
    found = error.value.problem("mjcf")
    file = found.file.removeprefix(f"{FOLDER}/")
    return f"{file}:{found.line}: {found.message}{f'; {found.hint}' if found.hint else ''}".replace(f"{FOLDER}/", "")

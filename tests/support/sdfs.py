"""Sources in SDF, translated without a disk, and read as robots."""

from __future__ import annotations

import os
from collections.abc import Mapping

import pytest

from urdfsync.common.diagnostics import Severity
from urdfsync.formats.sdf.document import SdfDocument
from urdfsync.formats.sdf.frames import Frames
from urdfsync.formats.sdf.robot import translated
from urdfsync.formats.sdf.worker import choose_model
from urdfsync.formats.translation.files import Files, TranslationError
from urdfsync.formats.translation.writer import write
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.parse.source import RobotReading, read_robot
from urdfsync.formats.urdf.robot import Joint, Link, Robot

FOLDER = "/robots/arm"
SOURCE = f"{FOLDER}/arm.sdf"
ARM = """\
<?xml version="1.0"?>
<sdf version="1.9">
  <model name="arm">
    <link name="upper">
      <pose>0 0 0.5 0 0 0</pose>
      <inertial>
        <pose>0 0 0.2 0 0 0</pose>
        <mass>1.5</mass>
        <inertia><ixx>0.02</ixx><iyy>0.02</iyy><izz>0.01</izz></inertia>
      </inertial>
    </link>
    <link name="fore">
      <pose relative_to="upper">0 0 0.4 0 0 0.5</pose>
      <inertial><mass>3</mass></inertial>
      <visual name="tube"><geometry><box><size>0.1 0.2 0.3</size></box></geometry></visual>
    </link>
    <joint name="shoulder" type="revolute">
      <parent>world</parent>
      <child>upper</child>
      <axis>
        <xyz>0 1 0</xyz>
        <limit><lower>-1.5</lower><upper>1.5</upper></limit>
        <dynamics><damping>2</damping></dynamics>
      </axis>
    </joint>
    <joint name="elbow" type="continuous">
      <parent>upper</parent>
      <child>fore</child>
      <axis><xyz>0 1 0</xyz></axis>
    </joint>
  </model>
</sdf>
"""
"""A robot of two hinges."""


def sdf(inside: str, version: str = "1.9") -> str:
    """An SDF with these elements."""
    return f'<sdf version="{version}">\n{inside}</sdf>'


def model(inside: str, version: str = "1.9", name: str = "arm") -> str:
    """An SDF of one model with these elements."""
    return sdf(f'<model name="{name}">{inside}</model>', version)


def hinge(name: str, parent: str, child: str, inside: str = "<axis/>", kind: str = "revolute") -> str:
    """A joint with these elements."""
    ends = f"<parent>{parent}</parent><child>{child}</child>"
    return f'<joint name="{name}" type="{kind}">{ends}{inside}</joint>'


def arm(link: str = "", joint: str = "<axis/>", more: str = "", version: str = "1.9", kind: str = "revolute") -> str:
    """An SDF of the link `base` in the world, and the link `part` at the joint `turn`, with these elements."""
    links = f'<link name="base"/><link name="part">{link}</link>'
    joints = hinge("weld", "world", "base", "", "fixed") + hinge("turn", "base", "part", joint, kind)
    return model(links + joints + more, version)


def urdf(text: str, files: Mapping[str, str] | None = None, robot: str = "") -> tuple[str, SdfDocument]:
    """Return the URDF of an SDF; `files` stand in its folder."""
    contents = {SOURCE: text.encode()}
    contents |= {os.path.normpath(f"{FOLDER}/{name}"): inside.encode() for name, inside in (files or {}).items()}
    frames = Frames(document := SdfDocument(SOURCE, Files(contents, [FOLDER])))
    return write(translated(frames, choose_model(frames, robot)))[0], document


def reading(text: str, files: Mapping[str, str] | None = None, robot: str = "") -> RobotReading:
    """Read an SDF as builds do that leave out what no model has."""
    options = Options(base="floating", allow=("part-left-out",))
    return read_robot(urdf(text, files, robot)[0].encode(), SOURCE, options)


def read(text: str, files: Mapping[str, str] | None = None, robot: str = "") -> Robot:
    """Return the robot in an SDF, which has no error."""
    found = reading(text, files, robot)
    assert found.robot is not None, found.diagnostics
    return found.robot


def joint(robot: Robot, name: str = "turn") -> Joint:
    """Return the joint with this name."""
    return next(joint for joint in robot.joints if joint.name == name)


def link(robot: Robot, name: str = "part") -> Link:
    """Return the link with this name."""
    return next(link for link in robot.links if link.name == name)


def left_out(text: str) -> list[str]:
    """Return what the translation leaves out, in words."""
    found = read_robot(urdf(text)[0].encode(), SOURCE)
    errors = [each for each in found.diagnostics if each.severity is Severity.ERROR]
    assert {each.code for each in errors} <= {"part-left-out"}
    return [each.message.partition(":")[0] for each in errors]


def noted(text: str) -> str:
    """Return the note on what has no effect."""
    return "; ".join(each.message for each in reading(text).unmodelled)


def problem(text: str, files: Mapping[str, str] | None = None, robot: str = "") -> str:
    """Return the fault for which there is no robot: file, line, message and hint."""
    with pytest.raises(TranslationError) as error:
        urdf(text, files, robot)
    found = error.value.problem("sdf")
    file = found.file.removeprefix(f"{FOLDER}/")
    return f"{file}:{found.line}: {found.message}{f'; {found.hint}' if found.hint else ''}".replace(f"{FOLDER}/", "")

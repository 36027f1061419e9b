"""Translates the document of an MJCF into the text of a URDF."""

from __future__ import annotations

from pathlib import PurePath

from urdfsync.formats.mjcf.document import MjcfDocument
from urdfsync.formats.mjcf.drives import Drives
from urdfsync.formats.mjcf.leftovers import add_leftovers, find_left_out
from urdfsync.formats.mjcf.loops import add_loops
from urdfsync.formats.mjcf.robot import Links
from urdfsync.formats.mjcf.scene import read_scene
from urdfsync.formats.mjcf.sensors import add_sensors
from urdfsync.formats.translation.writer import UrdfElement, write

_NO_NAME = "MuJoCo Model"
"""MuJoCo's name of a model without a name."""


def translated(document: MjcfDocument, body: str = "") -> tuple[str, tuple[tuple[int, str, int], ...]]:
    """Return the URDF of the robot below `body`, and the place of each of its lines. Raises TranslationError.

    Without `body`, the document must have one robot.
    """
    scene = read_scene(document, body)
    drives, links = Drives(scene), Links(scene)
    name = scene.spec.modelname
    robot = UrdfElement("robot", 0, name=PurePath(document.source).stem if name == _NO_NAME else name, version="1.2")
    if scene.is_floating:
        robot.add("free_root", scene.line("body", scene.root), link=scene.links[scene.root])
    links.add(robot, drives)
    add_loops(robot, links, drives)
    drives.add_control(robot)
    add_sensors(robot, links)
    find_left_out(scene, drives)
    add_leftovers(robot, scene, drives)
    return write(robot, document.places)

"""The text of the record of a whole robot, and the modifiers in it."""

from __future__ import annotations

import re

from support.packages import RENDERER
from urdfsync.domain import Target
from urdfsync.urdf.artifacts import record
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Robot

_EXTENDS = re.compile(r"  extends UrdfSync\.Records\.Robot\(\n(.*?)\);\n\n", re.DOTALL)
_MODIFIER = re.compile(r"^    (?=\w)", re.MULTILINE)
_COMPONENT = re.compile(r"^  UrdfSync\.Records\.(\w+) (\w+)\((.*?)\)\n    \"", re.DOTALL | re.MULTILINE)


def record_text(of: KinematicTree | Robot) -> str:
    """The record of a robot."""
    artifact = record(Robot("r", of.links, of.joints), Target("", "RParameters"), Options(approach=("record",)))
    return RENDERER.render(artifact.template, artifact.data)


def record_tables(of: KinematicTree | Robot) -> list[str]:
    """The modifiers of `UrdfSync.Records.Robot` by which it is this robot, name and index matrices left out."""
    found = _EXTENDS.search(record_text(of))
    assert found is not None
    modifiers = [modifier.rstrip().rstrip(",") for modifier in _MODIFIER.split(found[1])[1:]]
    return [modifier for modifier in modifiers if not modifier.startswith(("name", "connectionM", "moveableJ"))]


def record_components(of: KinematicTree | Robot) -> dict[str, tuple[str, str]]:
    """Class and modifiers of each component of a class of `UrdfSync.Records`, the modifiers on one line."""
    return {name: (kind, " ".join(text.split())) for kind, name, text in _COMPONENT.findall(record_text(of))}

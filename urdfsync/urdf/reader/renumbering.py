"""A robot of which only numbers have changed since the last reading: it is the last one with these numbers.

What is to be said of a robot beyond its single elements follows from their names, from who is joined to whom and how,
and from materials. As long as all of that is as it was, and each element says of itself what it said, so are all
findings. The second reader is asked about names, types and the tree: where the texts, too, differ in numbers alone, it
has answered that.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Sequence
from itertools import compress
from typing import TypeAlias

import msgspec

from urdfsync.diagnostics import Diagnostic
from urdfsync.urdf.reader.checks import unit_axes
from urdfsync.urdf.reader.chunks import Chunk, Document
from urdfsync.urdf.reader.fields import NUMBER, Findings
from urdfsync.urdf.reader.part import Part
from urdfsync.urdf.robot import Joint, Link, Robot
from urdfsync.urdf.skeleton import bare

_Changes: TypeAlias = list[tuple[Chunk[Part], Chunk[Part]]]

_NUMBER = rf"""(?<=[\s"'])(?:{NUMBER})(?=[\s"'])"""
"""A regular expression; no command but the daemon needs it."""


class Last(msgspec.Struct, frozen=True):
    """What a reading without errors has left."""

    document: Document[Part]
    said: Sequence[Diagnostic]
    """What decoding had to say."""
    robot: Robot
    findings: Findings
    """All but those of the second reader."""
    agreed: str | None = None
    """If the second reader has found nothing: the text before the first child of the root."""


class Renumbered(msgspec.Struct, frozen=True):
    """The last robot with other numbers; links and joints that are equal to the last ones are the same objects."""

    robot: Robot
    agreed: bool
    """Whether the second reader has found nothing in a text that differs in numbers alone."""


def renumbered(last: Last, document: Document[Part], said: Sequence[Diagnostic], head: str) -> Renumbered | None:
    """The robot of the document, if no more than numbers can have changed: then it has the last findings, too.

    `head` is the text before the first child of the root.
    """
    changes = _changes(last, document, said)
    if changes is None or not all(_has_other_numbers(old.made, new.made) for old, new in changes):
        return None
    robot, read = last.robot, [new.made.read for _, new in changes]
    links = {link.name: link for link in read if isinstance(link, Link)}
    joints = {joint.name: joint for joint in read if isinstance(joint, Joint)}
    if links:
        found = [_with_materials(links[old.name], old) if old.name in links else old for old in robot.links]
        robot = msgspec.structs.replace(robot, links=tuple(found))
    if joints:
        moves = [_as_in_robot(joints[old.name], old) if old.name in joints else old for old in robot.joints]
        robot = msgspec.structs.replace(robot, joints=tuple(moves))
    same = last.agreed == head and not document.far
    return Renumbered(robot, same and all(_are_alike(old.text, new.text) for old, new in changes))


def _are_alike(old: str, new: str) -> bool:
    """Whether two texts differ in numbers alone, as they stand between blanks or quotation marks."""
    return re.sub(_NUMBER, "0", old) == re.sub(_NUMBER, "0", new)


def _changes(last: Last, document: Document[Part], said: Sequence[Diagnostic]) -> _Changes | None:
    """The chunks that are not those of the last document; None if something else has changed."""
    old = last.document
    same = (
        said == last.said
        and not (document.prefixes or old.prefixes)
        and _facts(document) == _facts(old)
        and document.lines == old.lines
    )
    others = map(operator.is_not, old.chunks, document.chunks)
    return list(compress(zip(old.chunks, document.chunks, strict=True), others)) if same else None


def _facts(document: Document[Part]) -> tuple[str, dict[str, str], int]:
    root = document.root
    return root.tag, dict(root.attributes), root.line


def _has_other_numbers(old: Part, new: Part) -> bool:
    """Whether two parts are links or joints that differ in numbers at most."""
    match old.read, new.read:
        case Link() as one, Link() as other:
            same = one.name == other.name and _materials(one) == _materials(other)
        case Joint() as one, Joint() as other:
            same = bare(one) == bare(other)
        case _:
            return False
    return (
        same
        and old.extensions == new.extensions
        and old.faults == new.faults
        and old.leftovers == new.leftovers
        and old.findings.say_as(new.findings)
    )


def _materials(link: Link) -> list[object]:
    return [visual.material for visual in link.visuals]


def _with_materials(link: Link, old: Link) -> Link:
    """The link with the materials that were found for the old one, or that itself if nothing has changed."""
    pairs = zip(link.visuals, old.visuals, strict=True)
    visuals = tuple([msgspec.structs.replace(visual, material=known.material) for visual, known in pairs])
    found = msgspec.structs.replace(link, visuals=visuals)
    return old if found == old else found


def _as_in_robot(joint: Joint, old: Joint) -> Joint:
    """The joint with a unit vector as its axis, actuated as the old one; that itself if nothing has changed."""
    (found,) = unit_axes(Robot("", joints=(msgspec.structs.replace(joint, actuated=old.actuated),))).joints
    return old if found == old else found

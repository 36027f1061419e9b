"""Compares our reading with that of yourdfpy, to find our own misreadings.

Loading this module takes most of a second, because of yourdfpy.
"""

from __future__ import annotations

import contextlib
import io
import logging
from collections.abc import Iterator, Mapping
from typing import Any, get_args
from xml.etree.ElementTree import Element

import numpy as np
import yourdfpy

from urdfsync.diagnostics import Diagnostic
from urdfsync.urdf.kinematics.poses import link_poses, pose
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import LeftOut, Options
from urdfsync.urdf.parse import xml
from urdfsync.urdf.parse.beside import with_plain_joints
from urdfsync.urdf.parse.fields import located
from urdfsync.urdf.parse.respelling import with_attributes
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.robot import MOTION_KINDS, Robot
from urdfsync.urdf.validate import Finding

# yourdfpy raises these for valid files, since it expects optional attributes.
_FAILURES = (ArithmeticError, AttributeError, LookupError, SyntaxError, TypeError, ValueError)
_SHOWN = 5
_TOLERANCE = 1e-9
"""The greatest allowed difference of poses, in m relative to the farthest link, and of elements of rotations."""


def cross_check(content: bytes, file: str) -> tuple[Diagnostic, ...]:
    """Return the names, types, parents and poses in which yourdfpy differs from `read_robot`, which accepts the URDF.

    `file` is its name in diagnostics. Joints of several axes are no URDF, and are read with one axis.
    """
    content = with_plain_joints(content)
    options = Options(allow=get_args(LeftOut))
    reading = read_robot(content, file, options)
    if reading.robot is None:
        return ()
    respelled = with_attributes(content, {joint.name for joint in reading.robot.joints})
    findings = list(compare_readers(respelled, reading.robot))
    if respelled != content and (other := read_robot(respelled, file, options).robot):
        pairs = ((*robot.links, *robot.joints) for robot in (reading.robot.by_name(), other.by_name()))
        for ours, theirs in zip(*pairs, strict=True):
            if ours != theirs:
                path = f"{type(ours).__name__.lower()} {ours.name}"
                findings.append(Finding("second-reader-differs", path, f"{path}: its texts are read otherwise"))
    return located(findings, file, reading.lines)


def compare_readers(content: bytes, robot: Robot) -> Iterator[Finding]:
    """Compare names, types, tree and poses of `robot` with yourdfpy's reading of the same bytes."""
    failure, theirs = "finds no link in this file", None
    with _silence():
        try:
            theirs = yourdfpy.URDF.load(io.BytesIO(content), load_meshes=False, build_scene_graph=False).robot
        except _FAILURES as error:
            reason = f"{type(error).__name__}: {' '.join(str(error).split())}"[:120]
            failure = f"can't read this file ({reason})"
    if theirs is None or (robot.links and not theirs.links):
        yield Finding("second-reader-failed", "robot", f"not cross-checked: yourdfpy {failure}")
        return
    differs = False
    for (kind, ours), others in zip(_structure(robot).items(), _structure(theirs).values(), strict=True):
        parts = []
        for title, names in (("without", ours - others), ("with", others - ours)):
            if names:
                shown = sorted(names)[:_SHOWN] + ["…"] * (len(names) > _SHOWN)
                parts.append(f"{title} {', '.join(shown)}")
        if parts:
            differs = True
            yield Finding("second-reader-differs", "robot", f"yourdfpy reads other {kind}: {'; '.join(parts)}")
    if b"quat_xyzw" in content:
        yield Finding("second-reader-failed", "robot", "poses are not cross-checked: yourdfpy reads no quat_xyzw")
    elif not differs:
        yield from _compare_poses(robot, theirs)
        yield from _compare_loops(xml.parse(content).root, robot, theirs)


def _structure(robot: Any) -> Mapping[str, frozenset[str]]:
    """Return names, types and tree, from the robot of either reader."""
    return {
        "links": frozenset(str(link.name) for link in robot.links),
        "joints": frozenset(f"{joint.name} ({joint.type}, {joint.parent} → {joint.child})" for joint in robot.joints),
    }


def _compare_poses(robot: Robot, theirs: Any) -> Iterator[Finding]:
    """Compare the poses of links, first with all joints at zero; yield the first difference.

    Following joints get positions of their own: yourdfpy can't follow a joint that follows another one.
    """
    tree, axes = KinematicTree.of(robot), {}
    for link in theirs.links:
        link.visuals.clear()  # else visuals would be nodes among the links
    for joint in theirs.joints:
        joint.mimic = None
        joint.type = "fixed" if joint.type == "ball" else joint.type  # yourdfpy has no coordinates for a ball
        if joint.type in MOTION_KINDS:
            axes[joint.name] = 1.0 if MOTION_KINDS[joint.type] == "rotational" else float(np.linalg.norm(joint.axis))
    parents = {joint.child: joint.parent for joint in robot.joints}
    # neighbours get different positions, so that exchanged joints show
    positions = {name: 0.3 + 0.1 * (number % 10) for number, name in enumerate(axes)}
    with _silence(), np.errstate(all="ignore"):  # for infinite positions
        scene = yourdfpy.URDF(robot=theirs, build_scene_graph=True, load_meshes=False)
        for moved, words in (({}, "at zero"), (positions, "away from zero")):
            scene.update_cfg({name: position / axes[name] for name, position in moved.items()})
            ours = {name: np.column_stack(pose) for name, pose in link_poses(tree, moved).items()}
            reach = max(1.0, *(float(np.abs(pose).max()) for pose in ours.values()))
            places: dict[str, Any] = {}
            for name, pose in ours.items():  # joint by joint: from the root, a long chain would take minutes
                parent = parents.get(name)
                step = scene.get_transform(name, parent) if parent else scene.get_transform(name)
                places[name] = places[parent] @ step if parent else step
                their_pose = places[name][:3]
                if np.abs(their_pose - pose).max() > _TOLERANCE * reach:
                    place, other = (f"({x:.6g}, {y:.6g}, {z:.6g})" for x, y, z in (pose[:, 3], their_pose[:, 3]))
                    message = f"with all joints {words} the link is at {place} m, for yourdfpy at {other} m"
                    turned = "" if place != other else ", turned otherwise"
                    yield Finding("second-reader-differs", f"link {name}", f"link {name!r}: {message}{turned}")
                    return


def _compare_loops(root: Element, robot: Robot, theirs: Any) -> Iterator[Finding]:
    """Compare the frames of each `<loop_joint>` with its texts; with all joints at zero, by yourdfpy's poses."""
    if not (elements := root.findall("loop_joint")):
        return
    loops = {loop.name: loop for loop in robot.loops}
    with _silence(), np.errstate(all="ignore"):
        scene = yourdfpy.URDF(robot=theirs, build_scene_graph=True, load_meshes=False)
    for element in elements:
        ends = [part for part in element if part.tag in ("link1", "link2", "parent", "child")]
        loop = loops.get(element.get("name", ""))
        if loop is None or len(ends) != 2 or {end.get("link") for end in ends} - {link.name for link in robot.links}:
            continue  # an end may name a joint
        poses = []
        for end, link, origin in zip(ends, (loop.parent, loop.child), (loop.origin, loop.child_origin), strict=True):
            places = [end, *(part for part in element if part.tag == f"{end.tag}_origin")]
            places += element.findall("origin") if end.tag == "parent" else []
            texts = ((places[-1].get(name, ""), value) for name, value in (("xyz", origin.xyz), ("rpy", origin.rpy)))
            is_equal = all(
                np.allclose([*map(float, text.split())], value, 0, _TOLERANCE) for text, value in texts if text
            )
            poses.append(scene.get_transform(link)[:3, :3] @ np.array(pose(origin)[0]))
            if end.get("link") != link or not is_equal:
                yield Finding("second-reader-differs", f"loop {loop.name}", f"loop {loop.name!r} has another {end.tag}")
        is_aligned = any(part.tag == "child_origin" and "rpy" not in part.attrib for part in element)
        if is_aligned and np.abs(poses[0] - poses[1]).max() > _TOLERANCE:
            message = f"loop {loop.name!r} is turned otherwise with all joints at zero"
            yield Finding("second-reader-differs", f"loop {loop.name}", message)


@contextlib.contextmanager
def _silence() -> Iterator[None]:
    """Keep yourdfpy from logging: each problem is a finding."""
    logger = logging.getLogger("yourdfpy.urdf")
    before, logger.disabled = logger.disabled, True
    try:
        yield
    finally:
        logger.disabled = before

"""All judgements about a robot; `urdfsync.domain.features.Judgements` describes the functions."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from urdfsync.common.diagnostics import Diagnostic
from urdfsync.domain import ElementKey, Version
from urdfsync.formats.urdf.kinematics.poses import link_poses
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.plausibility import jumps
from urdfsync.formats.urdf.plausibility.bodies import find_impossible_bodies
from urdfsync.formats.urdf.plausibility.joints import find_impossible_joints
from urdfsync.formats.urdf.plausibility.series import find_odd_ones
from urdfsync.formats.urdf.plausibility.shapes import (
    find_bodies,
    find_displaced_collisions,
    find_far_shapes,
    find_large_meshes,
    find_length,
)
from urdfsync.formats.urdf.plausibility.symmetry import find_asymmetries
from urdfsync.formats.urdf.validate import Finding, diagnostic


def judge(version: Version, changed: Collection[str] = ()) -> Iterator[Diagnostic]:
    """Yield a finding for each implausible part of a valid robot; without imports, meshes have no size."""
    tree, imports = KinematicTree.of(version.snapshot), version.imports or {}
    length, poses = find_length(tree), link_poses(tree, {})
    bodies = find_bodies(tree, imports, length)
    findings = [
        *find_large_meshes(tree, imports, length),
        *find_impossible_bodies(tree, bodies, length),
        *find_far_shapes(bodies, length),
        *find_displaced_collisions(bodies),
        *find_impossible_joints(tree, bodies, length, poses),
    ]
    faulty = {finding.path.partition(" / ")[0] for finding in findings}
    odd = list(find_odd_ones(tree, bodies, faulty))
    told = {finding.path for finding in odd}
    suspects = [faulty | {path.partition(" / ")[0] for path in told}, changed]
    findings += odd
    findings += [finding for finding in find_asymmetries(tree, bodies, poses, suspects) if finding.path not in told]
    for finding in findings:
        yield _diagnostic(finding)


def find_jumps(old: Version, new: Version, renames: Mapping[ElementKey, str]) -> Iterator[Diagnostic]:
    """Yield a warning for each kind of jump between two versions."""
    return map(_diagnostic, jumps.find_jumps(old.snapshot, new.snapshot, renames))


def _diagnostic(finding: Finding) -> Diagnostic:
    return diagnostic(finding.code, finding.message, 0, finding.hint, element=finding.path)

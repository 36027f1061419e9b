"""All judgements about a robot; `urdfsync.engine.judgements.Judgements` describes the functions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import ElementKey, Version
from urdfsync.urdf.kinematics.poses import link_poses
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.plausibility.bodies import find_impossible_bodies
from urdfsync.urdf.plausibility.joints import find_impossible_joints
from urdfsync.urdf.plausibility.series import find_odd_ones
from urdfsync.urdf.plausibility.shapes import (
    find_bodies,
    find_displaced_collisions,
    find_far_shapes,
    find_large_meshes,
    find_length,
)
from urdfsync.urdf.plausibility.symmetry import find_asymmetries
from urdfsync.urdf.validate import Finding, diagnostic

_JUMP = 9.99
"""A greater ratio of two masses is probably a mistake: a factor of 10, with room for rounding."""


def judge(version: Version) -> Iterator[Diagnostic]:
    """Yield a finding for each implausible part of a valid robot; without imports, meshes have no size."""
    tree, imports = KinematicTree.of(version.snapshot), version.imports or {}
    bodies, length, poses = find_bodies(tree, imports), find_length(tree), link_poses(tree, {})
    findings = [
        *find_large_meshes(tree, imports, length),
        *find_impossible_bodies(tree, bodies, length),
        *find_far_shapes(bodies, length),
        *find_displaced_collisions(bodies),
        *find_impossible_joints(tree, bodies, length, poses),
    ]
    odd = list(find_odd_ones(tree, bodies))
    faulty = {finding.path.partition(" / ")[0] for finding in (*findings, *odd)}
    told = {finding.path for finding in odd}
    findings += odd
    findings += [finding for finding in find_asymmetries(tree, bodies, poses, faulty) if finding.path not in told]
    for finding in findings:
        yield _diagnostic(finding)


def find_jumps(old: Version, new: Version, renames: Mapping[ElementKey, str]) -> Iterator[Diagnostic]:
    """Yield one warning, at the first link, if masses of links grow or shrink by a factor of 10 or more."""
    before = {renames.get(("link", link.name), link.name): link.inertial for link in old.snapshot.links}
    jumps = []
    for link in new.snapshot.links:
        mass, new_mass = (part.mass if part else 0.0 for part in (before.get(link.name), link.inertial))
        if min(mass, new_mass) > 0 and max(mass, new_mass) >= _JUMP * min(mass, new_mass):
            jumps.append((f"link {link.name}", f"{mass:g} kg → {new_mass:g} kg"))
    if jumps:
        path, change = jumps[0]
        more = f" (and {len(jumps) - 1} more like it)" if len(jumps) > 1 else ""
        message = f"{path}: its mass jumps, {change}{more}"
        yield _diagnostic(Finding("mass-jump", f"{path} / inertial / mass", message))


def _diagnostic(finding: Finding) -> Diagnostic:
    return diagnostic(finding.code, finding.message, 0, finding.hint, element=finding.path)

"""The URDF domain as the core sees it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import msgspec

from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import (
    Artifact,
    Conversion,
    Dependency,
    Difference,
    Effect,
    ElementKey,
    Experiment,
    Import,
    Lookup,
    Meaning,
    Order,
    Proposal,
    Reading,
    Snapshot,
    Standalone,
    Target,
    Version,
)
from urdfsync.urdf import names
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Robot
from urdfsync.urdf.snapshot import from_snapshot, joints_of, to_snapshot


class UrdfDomain:
    """URDF files to Modelica packages of multibody models. Heavy parts are imported where they are used."""

    name = "urdf"
    templates: Path | None = None
    revision = 6
    fits_since = 5
    converter = 1
    options = Options

    def uses(self, options: Options) -> Sequence[tuple[str, str]]:
        """See `urdfsync.domain.Domain`."""
        return options.uses

    def read(self, content: bytes, file: str, options: Options, *, thorough: bool = False) -> Reading:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.parse.source import read_robot

        cross_check = thorough if options.cross_check is None else options.cross_check
        reading = read_robot(content, file, cross_check=cross_check)
        if reading.robot is None:
            return Reading(None, reading.diagnostics, reading.lines)
        said = reading.diagnostics
        if "record" in options.approach:
            from urdfsync.urdf.record_scope import out_of_scope

            said += tuple(out_of_scope(reading.robot, file, reading.lines))
        if "package" in options.approach:
            from urdfsync.urdf.passive import massless_passive_joints

            said += tuple(massless_passive_joints(reading.robot, options, file, reading.lines))
        return Reading(to_snapshot(reading.robot), said, reading.lines)

    def dependencies(
        self, snapshot: Snapshot, lookup: Lookup, options: Options, lines: Mapping[str, int]
    ) -> Sequence[Dependency]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.meshes.lookup import dependencies

        if options.meshes != "import":
            return ()
        return dependencies(_with_meshes(snapshot, options), lookup, lines)

    def convert(self, dependency: Dependency, file: Path, content: bytes) -> Conversion:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.meshes.convert import convert

        return convert(dependency, file, content)

    def names(self, snapshot: Snapshot, target: Target) -> Mapping[str, Mapping[str, str]]:
        """See `urdfsync.domain.Domain`."""
        return names.components(snapshot["links"], snapshot["joints"], target.name)

    def check_options(self, snapshot: Snapshot, options: Options) -> Iterable[tuple[str, Diagnostic]]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.option_names import check_options

        return check_options(snapshot["links"], joints_of(snapshot["joints"]), options)

    def artifacts(
        self,
        snapshot: Snapshot,
        imports: Mapping[str, Import],
        target: Target,
        options: Options,
    ) -> Sequence[Artifact | Order]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.artifacts import artifacts

        return artifacts(from_snapshot(snapshot), imports, target, options)

    def renames(self, old: Snapshot, new: Snapshot) -> Mapping[ElementKey, str]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.diff.renames import find_renames

        return find_renames(old, new)

    def comparable(self, snapshot: Snapshot, renames: Mapping[ElementKey, str]) -> Snapshot:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.diff.comparable import comparable

        return comparable(snapshot, renames)

    def describe(
        self, differences: Sequence[Difference], old: Version, new: Version, options: Options
    ) -> Sequence[Meaning | None]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.diff.meanings import describe

        return describe(differences, old, new, options)

    def effects(self, old: Version, new: Version) -> Sequence[Effect]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.diff.effects import effects

        return effects(old, new)

    def interface(
        self, old: Version, new: Version, renames: Mapping[ElementKey, str], target: Target, options: Options
    ) -> Sequence[Effect]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.diff.interface import interface

        return interface(old, new, renames, target, options)

    def option_for(self, path: str, target: Target, options: Options) -> str:
        """See `urdfsync.domain.Domain`."""
        is_left_out = path == f"{target.name}Parameters.mo" and "record" not in options.approach
        return 'approach = ["package", "record"]' if is_left_out else ""

    def option_for_connector(self, name: str, snapshot: Snapshot, target: Target, options: Options) -> str:
        """See `urdfsync.domain.Domain`: the frame of a link that `frames` does not name."""
        from urdfsync.urdf.kinematics.tree import KinematicTree
        from urdfsync.urdf.model.connectors import connector_names

        tree = KinematicTree.of(from_snapshot(snapshot), (target.name,))
        if name in connector_names(tree, options).frames.values():
            return ""
        frames = connector_names(tree, msgspec.structs.replace(options, frames="all")).frames
        links = [link for link, frame in frames.items() if frame == name]
        named = [] if isinstance(options.frames, str) else options.frames
        return (
            f"frames = [{', '.join(msgspec.json.encode(link).decode() for link in (*named, *links))}]" if links else ""
        )

    def propose(self, snapshot: Snapshot) -> Sequence[Proposal]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.kinematics.base_guess import guess_base

        return (guess_base(from_snapshot(snapshot)),)

    def drawing(
        self,
        snapshot: Snapshot,
        imports: Mapping[str, Import],  # noqa: ARG002 - the diagram shows no shapes
        target: Target,
        options: Options,
    ) -> str | None:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.diagram.drawing import draw

        return draw(from_snapshot(snapshot), target, options) if "package" in options.approach else None

    def models(self, snapshot: Snapshot, target: Target, options: Options) -> Sequence[str]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.artifacts import models

        return models(from_snapshot(snapshot).joints, target, options)

    def record(self, reading: Reading, file: str, target: Target, options: Options) -> Standalone | None:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.artifacts import record
        from urdfsync.urdf.record_scope import out_of_scope

        if reading.snapshot is None:
            return None
        robot = from_snapshot(reading.snapshot)
        return Standalone(record(robot, target, options), tuple(out_of_scope(robot, file, reading.lines)))

    def experiment(
        self, content: bytes, file: str, target: Target, options: Options, complete: bool
    ) -> Experiment | None:
        """See `urdfsync.domain.Domain`; None if there is only a record, and no generic robot that could read it."""
        from urdfsync.urdf.physics.experiment import experiment

        return experiment(content, file, target, options, complete)


def _with_meshes(snapshot: Snapshot, options: Options) -> Robot:
    """The links with meshes, without the shapes that nothing is made of: the record knows how high collisions stand."""
    absent: dict[str, list[Any]] = {}
    if not options.collisions or ("package" not in options.approach and options.base == "fixed"):
        absent["collisions"] = []
    shown = {name: {**link, **absent} for name, link in snapshot["links"].items() if _has_mesh(link)}
    return from_snapshot({**snapshot, "links": shown, "joints": {}, "extensions": {}})


def _has_mesh(link: Mapping[str, Any]) -> bool:
    return any(shape["geometry"]["kind"] == "mesh" for shape in (*link["visuals"], *link["collisions"]))


DOMAIN = UrdfDomain()

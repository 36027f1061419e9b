"""The URDF domain as the core sees it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from urdfsync.difference import Difference, Effect, ElementKey, Meaning, Version
from urdfsync.domain import (
    Artifact,
    Conversion,
    Dependency,
    Echo,
    Experiment,
    Import,
    Lookup,
    Order,
    Proposal,
    Reading,
    Snapshot,
    Target,
)
from urdfsync.urdf import naming
from urdfsync.urdf.options import USES, Options
from urdfsync.urdf.robot import Robot
from urdfsync.urdf.snapshot import from_snapshot, to_snapshot


class UrdfDomain:
    """URDF files to Modelica packages of multibody models. Heavy parts are imported where they are used."""

    name = "urdf"
    templates: Path | None = None
    revision = 1
    converter = 1
    uses = USES
    options = Options

    def read(self, content: bytes, file: str, options: Options) -> Reading:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.source import read_robot

        reading = read_robot(content, file, cross_check=options.cross_check)
        snapshot = None if reading.robot is None else to_snapshot(reading.robot)
        return Reading(snapshot, reading.diagnostics, reading.lines)

    def dependencies(
        self, snapshot: Snapshot, lookup: Lookup, options: Options, lines: Mapping[str, int]
    ) -> Sequence[Dependency]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.meshes.lookup import dependencies

        return dependencies(_shown(snapshot, options), lookup, lines) if options.meshes == "import" else ()

    def convert(self, dependency: Dependency, file: Path, content: bytes) -> Conversion:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.meshes.convert import convert

        return convert(dependency, file, content)

    def names(self, snapshot: Snapshot, target: Target) -> Mapping[str, Mapping[str, str]]:
        """See `urdfsync.domain.Domain`."""
        names: dict[str, dict[str, str]] = {"links": {}, "joints": {}}
        keys = [("link", name) for name in snapshot["links"]] + [("joint", name) for name in snapshot["joints"]]
        for (kind, name), identifier in naming.identify(keys, taken=(target.name,)).items():
            names[f"{kind}s"][name] = identifier.component
        return names

    def artifacts(
        self, snapshot: Snapshot, imports: Mapping[str, Import], target: Target, options: Options
    ) -> Sequence[Artifact | Order]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.artifacts import artifacts

        return artifacts(from_snapshot(snapshot), imports, target, options)

    def renames(self, old: Snapshot, new: Snapshot) -> Mapping[ElementKey, str]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf import changes

        return changes.renames(old, new)

    def comparable(self, snapshot: Snapshot, renames: Mapping[ElementKey, str]) -> Snapshot:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf import changes

        return changes.comparable(snapshot, renames)

    def describe(
        self, differences: Sequence[Difference], old: Version, new: Version, options: Options
    ) -> Sequence[Meaning | None]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf import changes

        return changes.describe(differences, old, new, options)

    def effects(self, old: Version, new: Version, renames: Mapping[ElementKey, str]) -> Sequence[Effect]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf import changes

        return changes.effects(old, new, renames)

    def echoes(self, records: Mapping[str, str], target: Target) -> Sequence[Echo]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.echoes import echoes

        return tuple(echoes(records, target))

    def propose(self, snapshot: Snapshot) -> Sequence[Proposal]:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.proposal import propose_base

        return (propose_base(from_snapshot(snapshot)),)

    def drawing(
        self,
        snapshot: Snapshot,
        imports: Mapping[str, Import],  # noqa: ARG002 - the diagram shows no shapes
        target: Target,
        options: Options,  # noqa: ARG002 - nor do options change it
    ) -> str | None:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.diagram.picture import draw

        return draw(from_snapshot(snapshot), target)

    def models(self, target: Target) -> Sequence[str]:
        """See `urdfsync.domain.Domain`."""
        return target.name, f"{target.name}Run", f"{target.name}Test"

    def experiment(self, content: bytes, file: str, target: Target, options: Options, complete: bool) -> Experiment:
        """See `urdfsync.domain.Domain`."""
        from urdfsync.urdf.physics.experiment import PinocchioExperiment

        return PinocchioExperiment(content, file, target, options, complete)


def _shown(snapshot: Snapshot, options: Options) -> Robot:
    """The robot without the collisions, if they are not wanted."""
    links = snapshot["links"]
    if not options.collisions:
        links = {name: {**link, "collisions": []} for name, link in links.items()}
    return from_snapshot({**snapshot, "links": links})


DOMAIN = UrdfDomain()

"""The URDF domain; `urdfsync.domain.Domain` describes its functions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import get_args

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.domain import (
    Artifact,
    Companion,
    CompanionKind,
    Conversion,
    Dependency,
    Domain,
    Import,
    LazyModule,
    Lookup,
    Order,
    Reading,
    Target,
)
from urdfsync.formats.urdf import artifacts as package
from urdfsync.formats.urdf import option_names
from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.diff.meanings import describe
from urdfsync.formats.urdf.diff.renames import find_features
from urdfsync.formats.urdf.diff.shapes import keep_numbers
from urdfsync.formats.urdf.kinematics.loops import find_loop_findings
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.meshes import lookup
from urdfsync.formats.urdf.names import identify
from urdfsync.formats.urdf.options import USES, LeftOut, Options
from urdfsync.formats.urdf.parse.closures import CLOSED_LOOP
from urdfsync.formats.urdf.parse.fields import located
from urdfsync.formats.urdf.parse.source import read_robot
from urdfsync.formats.urdf.robot import Robot
from urdfsync.formats.urdf.unsimulated import find_unsimulated, out_of_scope
from urdfsync.formats.urdf.validate import ADVICE, Finding, diagnostic

WARNINGS = frozenset(
    {
        *(code for code, (severity, _) in ADVICE.items() if severity is not Severity.ERROR),
        *("mesh-guessed", "mesh-not-found", "mesh-not-found-kept", "mesh-unreadable", "mesh-unreadable-kept"),
        *("mesh-colors", "name-repeated", "passive-joints", "texture"),
    }
)


class UrdfDomain(Domain):
    """Turns URDF files into Modelica packages of multibody models."""

    name = "urdf"
    warnings = WARNINGS
    model = Robot
    options = Options
    permissive_options = Options(allow=get_args(LeftOut))
    cured = ("loop-singular",)
    advice = LazyModule("urdfsync.formats.urdf.advice")
    effects = LazyModule("urdfsync.formats.urdf.diff.effects")
    checks = LazyModule("urdfsync.formats.urdf.benches")
    judgements = LazyModule("urdfsync.formats.urdf.plausibility.judgements")
    identification = LazyModule("urdfsync.formats.urdf.physics.regressor")
    formats = LazyModule("urdfsync.formats.urdf.diff.common_frames")
    imports = LazyModule("urdfsync.formats.urdf.meshes.lookup")
    simulation = LazyModule("urdfsync.formats.urdf.benches")
    pictures = LazyModule("urdfsync.formats.urdf.scene")
    companions = (
        CompanionKind("closed_loops", ".yaml", CLOSED_LOOP),
        CompanionKind("catalogue", needed_by="motors"),
    )
    describe = staticmethod(describe)

    def uses(self, _options: Options) -> Sequence[tuple[str, str]]:
        """Return the Modelica Standard Library and UrdfSync."""
        return USES

    def read(self, content: bytes, file: str, options: Options, *companions: Companion) -> Reading:
        """Read a URDF.

        A robot without errors is also checked for joints that no simulation can move. Names in options are checked
        against the robot.
        """
        robot, diagnostics, lines, files, unmodelled = read_robot(content, file, options, *companions)
        if robot is None:
            return Reading(None, diagnostics, lines, files)
        assembly = Assembly(robot, options)
        closed = assembly.closed
        about_options = list(option_names.check_options(assembly))
        stated = {f"loop {loop.name}": f"loops.{loop.name}" for loop in options.loops}
        stated |= {f"joint {name}": f"start.{name}" for name in options.start}
        of_source = list[Finding]()
        for finding in find_loop_findings(closed):
            if option := stated.get(finding.path):
                about_options.append((option, diagnostic(finding.code, finding.message, 0, finding.hint)))
            else:
                of_source.append(finding)
        places = file, lines, files
        diagnostics += unmodelled + located(of_source, *places)
        if not closed.faults:
            diagnostics += located(find_unsimulated(assembly), *places)
        is_wrong = any(entry.severity is Severity.ERROR and entry.code not in self.cured for entry in diagnostics)
        return Reading(None if is_wrong else robot.by_name(), diagnostics, lines, files, tuple(about_options))

    def names(self, snapshot: Robot, target: Target) -> Mapping[str, Mapping[str, str]]:
        """Return the component names of links, joints and loops."""
        elements = {"link": snapshot.links, "joint": snapshot.joints, "loop": snapshot.loops}
        names = identify([(kind, one.name) for kind, of_kind in elements.items() for one in of_kind], (target.name,))  # type: ignore[attr-defined]
        by_kind: dict[str, dict[str, str]] = {}
        for (kind, name), identifier in names.items():
            by_kind.setdefault(f"{kind}s", {})[name] = identifier.component
        return by_kind

    def artifacts(
        self, snapshot: Robot, imports: Mapping[str, Import], target: Target, options: Options
    ) -> Sequence[Artifact | Order]:
        """Return the files of the approaches that the options choose."""
        return package.artifacts(snapshot, imports, target, options)

    def dependencies(
        self, snapshot: Robot, places: Lookup, options: Options, lines: Mapping[str, int]
    ) -> Sequence[Dependency]:
        """Return the meshes that the shapes of the package need."""
        if options.meshes != "import":
            return ()
        has_collisions = options.collisions and ("package" in options.approach or options.base == "floating")
        kinds = ("visual", "collision") if has_collisions else ("visual",)
        return lookup.dependencies(snapshot.links, kinds, places, lines, touches=options.base == "floating")

    def convert(self, dependency: Dependency, file: Path, content: bytes, others: Mapping[str, bytes]) -> Conversion:
        """Return a mesh as STL or OBJ, split by colours, with its bounds and its outermost points."""
        from urdfsync.formats.urdf.meshes.convert import convert  # a late import saves 10 ms if no mesh is new

        return convert(dependency, file, content, others)

    features, numbered = staticmethod(find_features), staticmethod(keep_numbers)

    def drawing(
        self,
        snapshot: Robot,
        imports: Mapping[str, Import],  # noqa: ARG002 - the diagram shows no shapes
        target: Target,
        options: Options,
        differing: Mapping[str, tuple[str, str]],
    ) -> str | None:
        """Return the diagram of the robot model on disk; only the package approach has one."""
        from urdfsync.formats.urdf.diagram.drawing import draw

        return draw(snapshot, target, options, differing) if "package" in options.approach else None

    def record(
        self, reading: Reading, file: str, target: Target, options: Options
    ) -> tuple[Artifact, Sequence[Diagnostic]]:
        """Return the record of the whole robot, and findings about parts that the generic robot lacks."""
        robot = reading.snapshot
        findings = out_of_scope(KinematicTree.of(robot))
        return package.record(robot, target, options), located(findings, file, reading.lines, reading.files)


DOMAIN = UrdfDomain()

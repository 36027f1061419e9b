"""The URDF domain as the core sees it: `urdfsync.domain.Domain` describes its functions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import Artifact, Conversion, Dependency, Domain, Import, Lookup, Order, Reading, Snapshot, Target
from urdfsync.urdf import advice, benches, checks, option_names, scene
from urdfsync.urdf import artifacts as package
from urdfsync.urdf.diff import effects
from urdfsync.urdf.diff.meanings import describe
from urdfsync.urdf.diff.renames import comparable, find_features
from urdfsync.urdf.drives import assembly
from urdfsync.urdf.kinematics.loops import find_loop_findings
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.meshes import lookup
from urdfsync.urdf.names import identify
from urdfsync.urdf.options import Options
from urdfsync.urdf.parse import beside
from urdfsync.urdf.parse.fields import located
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.plausibility import find_implausible
from urdfsync.urdf.snapshot import from_snapshot, to_snapshot
from urdfsync.urdf.unsimulated import find_unsimulated, out_of_scope
from urdfsync.urdf.validate import ADVICE, Finding, diagnostic

WARNINGS = frozenset(
    {
        *(code for code, (severity, _) in ADVICE.items() if severity is not Severity.ERROR),
        *("mesh-guessed", "mesh-not-found", "mesh-not-found-kept", "mesh-unreadable", "mesh-unreadable-kept"),
        *("mass-jump", "mesh-colors", "mesh-size", "name-repeated", "passive-joints", "texture"),
    }
)


class UrdfDomain(Domain):
    """URDF files to Modelica packages of multibody models."""

    name = "urdf"
    warnings = WARNINGS
    options = Options
    advice, beside, imports, effects = advice, beside, lookup, effects
    checks, simulation, pictures = checks, benches, scene

    def uses(self, options: Options) -> Sequence[tuple[str, str]]:
        """Return the Modelica Standard Library, UrdfSync, and the library of the visualizer."""
        return options.uses

    def read(self, content: bytes, file: str, options: Options) -> Reading:
        """Read a URDF; warn of one without errors also if it is implausible, or can't be simulated.

        Names in options are held against the robot.
        """
        robot, diagnostics, lines, unmodelled = read_robot(content, file, options)
        if robot is None:
            return Reading(None, diagnostics, lines)
        tree = KinematicTree.of(robot)
        closed = assembly(tree, options)
        about_options = list(option_names.check_options(tree, closed, options))
        stated, of_source = {f"loop {loop.name}": loop.name for loop in options.loops}, list[Finding]()
        for finding in find_loop_findings(closed):
            if name := stated.get(finding.path):
                about_options.append((f"loops.{name}", diagnostic(finding.code, finding.message, 0, finding.hint)))
            else:
                of_source.append(finding)
        diagnostics += located(find_implausible(tree), file, lines) + unmodelled + located(of_source, file, lines)
        if not closed.faults:
            diagnostics += located(find_unsimulated(tree, closed, options), file, lines)
        is_wrong = any(entry.severity is Severity.ERROR for entry in diagnostics)
        return Reading(None if is_wrong else to_snapshot(robot), diagnostics, lines, tuple(about_options))

    def names(self, snapshot: Snapshot, target: Target) -> Mapping[str, Mapping[str, str]]:
        """Return the components of links, joints, and loops if there are any."""
        kinds = [kind for kind in ("link", "joint", "loop") if f"{kind}s" in snapshot]
        names = identify([(kind, name) for kind in kinds for name in snapshot[f"{kind}s"]], (target.name,))
        return {f"{kind}s": {name: names[kind, name].component for name in snapshot[f"{kind}s"]} for kind in kinds}

    def artifacts(
        self, snapshot: Snapshot, imports: Mapping[str, Import], target: Target, options: Options
    ) -> Sequence[Artifact | Order]:
        """Return the files of both approaches, as the options choose."""
        return package.artifacts(from_snapshot(snapshot), imports, target, options)

    def dependencies(
        self, snapshot: Snapshot, places: Lookup, options: Options, lines: Mapping[str, int]
    ) -> Sequence[Dependency]:
        """Return the meshes of the shapes that something in the package is made of."""
        if options.meshes != "import":
            return ()
        has_collisions = options.collisions and ("package" in options.approach or options.base == "floating")
        kinds = ("visual", "collision") if has_collisions else ("visual",)
        return lookup.dependencies(snapshot["links"], kinds, places, lines, touches=options.base == "floating")

    def convert(self, dependency: Dependency, file: Path, content: bytes, others: Mapping[str, bytes]) -> Conversion:
        """Return a mesh as STL or OBJ, with its bounds and its outermost points, and by its colours."""
        from urdfsync.urdf.meshes.convert import convert  # 10 ms, and only new meshes need it

        return convert(dependency, file, content, others)

    features = staticmethod(find_features)
    comparable = staticmethod(comparable)
    describe = staticmethod(describe)

    def drawing(
        self,
        snapshot: Snapshot,
        imports: Mapping[str, Import],  # noqa: ARG002 - the diagram shows no shapes
        target: Target,
        options: Options,
    ) -> str | None:
        """Return the diagram of the robot model, which only the package approach has."""
        from urdfsync.urdf.diagram.drawing import draw

        return draw(from_snapshot(snapshot), target, options) if "package" in options.approach else None

    def record(
        self, reading: Reading, file: str, target: Target, options: Options
    ) -> tuple[Artifact, Sequence[Diagnostic]]:
        """Return the record of the whole robot, and which joints the generic robot can't move."""
        robot = from_snapshot(reading.snapshot or {})
        findings = out_of_scope(KinematicTree.of(robot))
        return package.record(robot, target, options), located(findings, file, reading.lines)


DOMAIN = UrdfDomain()

"""The URDF domain as the core sees it: `urdfsync.domain.Domain` describes its functions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import get_args

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import (
    Artifact,
    Bench,
    Conversion,
    Dependency,
    Deviation,
    Domain,
    Experiment,
    Import,
    Lookup,
    Order,
    Proposal,
    Reading,
    Sample,
    Snapshot,
    Target,
)
from urdfsync.scene import Scene, Triangles
from urdfsync.urdf import artifacts as package
from urdfsync.urdf import option_names
from urdfsync.urdf.benches import bench
from urdfsync.urdf.connectors import connector_options
from urdfsync.urdf.diff.effects import effects, find_doubtful, interface
from urdfsync.urdf.diff.meanings import describe
from urdfsync.urdf.diff.renames import comparable, find_features
from urdfsync.urdf.drives import assembly
from urdfsync.urdf.kinematics.loops import find_loop_findings
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.meshes.lookup import COLORLESS, GLTF, TEXTURED, dependencies, mentioned_files, mesh, suffix
from urdfsync.urdf.names import identify
from urdfsync.urdf.options import LeftOut, Options
from urdfsync.urdf.parse import beside
from urdfsync.urdf.parse.fields import located
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.plausibility import find_implausible
from urdfsync.urdf.scene import scene
from urdfsync.urdf.snapshot import from_snapshot, joints_of, to_snapshot
from urdfsync.urdf.unsimulated import find_unsimulated, out_of_scope
from urdfsync.urdf.validate import ADVICE, Finding, diagnostic

WARNINGS = frozenset(
    {
        *(code for code, (severity, _) in ADVICE.items() if severity is not Severity.ERROR),
        *("mesh-guessed", "mesh-not-found", "mesh-not-found-kept", "mesh-unreadable", "mesh-unreadable-kept"),
        *("mass-jump", "mesh-colors", "name-repeated", "passive-joints", "texture"),
    }
)


class UrdfDomain(Domain):
    """URDF files to Modelica packages of multibody models."""

    name = "urdf"
    warnings = WARNINGS
    options = Options

    def uses(self, options: Options) -> Sequence[tuple[str, str]]:
        """Return the Modelica Standard Library, UrdfSync, and the library of the visualizer."""
        return options.uses

    def read(self, content: bytes, file: str, options: Options) -> Reading:
        """Read a URDF.

        Without errors, also warn of implausible values, and of robots that can't be simulated. Names in options are
        checked against the robot.
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

    def beside(self, source: Path) -> Path:
        """Return the YAML with the loops of a robot."""
        return source.with_suffix(".yaml")

    def join(self, content: bytes, other: bytes, file: str) -> tuple[bytes, Sequence[tuple[int, int]]]:
        """Return the URDF with the loops, motors and joints of that YAML."""
        return beside.join(content, other, file)

    def cross_check(self, content: bytes, file: str) -> Sequence[Diagnostic]:
        """Return the differences from the links, joints and poses that yourdfpy reads."""
        from urdfsync.urdf.parse.second_reader import cross_check  # most of a second, which no build needs

        return cross_check(content, file)

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
        self, snapshot: Snapshot, lookup: Lookup, options: Options, lines: Mapping[str, int]
    ) -> Sequence[Dependency]:
        """Return the meshes of the shapes that the package uses."""
        if options.meshes != "import":
            return ()
        has_collisions = options.collisions and ("package" in options.approach or options.base == "floating")
        kinds = ("visual", "collision") if has_collisions else ("visual",)
        return dependencies(snapshot["links"], kinds, lookup, lines, touches=options.base == "floating")

    def mentioned(self, dependency: Dependency, file: str, content: bytes) -> Sequence[str]:
        """Return the buffers of a glTF file, and the materials and textures of a mesh with its own colours."""
        is_needed = TEXTURED in dependency.facts or suffix(dependency.uri) == GLTF
        return mentioned_files(file, content) if is_needed else ()

    def convert(self, dependency: Dependency, file: Path, content: bytes, others: Mapping[str, bytes]) -> Conversion:
        """Return a mesh as STL or OBJ, split by its colours, with its bounds and its outermost points."""
        from urdfsync.urdf.meshes.convert import convert  # 10 ms, and only new meshes need it

        return convert(dependency, file, content, others)

    def import_findings(self, imports: Mapping[str, Import]) -> Iterator[tuple[str, Diagnostic]]:
        """Yield a warning for each mesh without some of its colours, and a note if textures become colours."""
        for key, file in imports.items():
            if missing := file.facts.get(COLORLESS):
                message = f"mesh `{mesh(key).filename}` lacks colours: "
                hint = "put what is missing beside the mesh, or give the visual a <material>"
                yield key, Diagnostic(Severity.WARNING, "mesh-colors", message + "; ".join(missing), hint=hint)
        count = sum(bool(file.facts.get(TEXTURED)) for file in imports.values())
        if count:
            message = f"{count} {'mesh has' if count == 1 else 'meshes have'} textures, which become their mean colours"
            yield "", Diagnostic(Severity.NOTE, "texture", message)

    def permissive_options(self) -> Options:
        """Allow all parts that can be left out of a model."""
        return Options(allow=get_args(LeftOut))

    def propose(self, snapshot: Snapshot, diagnostics: Sequence[Diagnostic]) -> Sequence[Proposal]:
        """Guess whether the robot is mobile; allow errors about parts that models leave out."""
        from urdfsync.urdf.kinematics.base_guess import guess_base

        base, codes = guess_base(from_snapshot(snapshot)), {entry.code for entry in diagnostics}
        if not (needed := [code for code in get_args(LeftOut) if code in codes]):
            return (base,)
        return (base, Proposal("allow", needed, "the model leaves this out, see the warnings"))

    def option_for(self, name: str, snapshot: Snapshot, target: Target, options: Options) -> str:
        """Return the option that brings the record of the robot, a frame of a link, or a variable of Run."""
        if name == f"{target.name}Parameters" and "record" not in options.approach:
            return 'approach = ["package", "record"]'
        return connector_options(KinematicTree.of(from_snapshot(snapshot), (target.name,)), options).get(name, "")

    features = staticmethod(find_features)
    comparable = staticmethod(comparable)
    describe = staticmethod(describe)
    effects = staticmethod(effects)
    interface = staticmethod(interface)
    find_doubtful = staticmethod(find_doubtful)

    def drawing(
        self,
        snapshot: Snapshot,
        imports: Mapping[str, Import],  # noqa: ARG002 - the diagram shows no shapes
        target: Target,
        options: Options,
    ) -> str | None:
        """Return the diagram of the robot model; only the package approach has one."""
        from urdfsync.urdf.diagram.drawing import draw

        return draw(from_snapshot(snapshot), target, options) if "package" in options.approach else None

    def scene(self, snapshot: Snapshot, imports: Mapping[str, Import], target: Target, options: Options) -> Scene:
        """Return the shapes of visuals and collisions, the masses, and the axes of joints."""
        return scene(from_snapshot(snapshot), imports, target, options)

    def triangles(self, path: str, content: bytes, key: str, most: int) -> Triangles | str:
        """Return the triangles of a mesh, as the process for meshes reads it."""
        from urdfsync.urdf.meshes.convert import triangles  # as above

        return triangles(path, content, key, most)

    def models(self, snapshot: Snapshot, target: Target, options: Options) -> Sequence[str]:
        """Return the robot, its benches, and the record if there is no robot."""
        return package.models(joints_of(snapshot["joints"]), target, options)

    def bench(self, snapshot: Snapshot, target: Target, options: Options) -> Bench | None:
        """Return Test and Run, or the bench of the generic robot, with position, speed and effort of each joint."""
        return bench(KinematicTree.of(from_snapshot(snapshot), (target.name,)), target, options)

    def record(
        self, reading: Reading, file: str, target: Target, options: Options
    ) -> tuple[Artifact, Sequence[Diagnostic]] | None:
        """Return the record of the whole robot, and the joints that the generic robot can't move."""
        if reading.snapshot is None:
            return None
        robot = from_snapshot(reading.snapshot)
        findings = out_of_scope(KinematicTree.of(robot))
        return package.record(robot, target, options), located(findings, file, reading.lines)

    def experiment(self, sample: Sample, step: float | None = None) -> Experiment | str:
        """Return the comparison with Pinocchio, or why there is none, such as planar or floating joints."""
        from urdfsync.urdf.physics.experiment import experiment  # with numpy, which no build needs

        return experiment(sample, step)

    def wiring(
        self, texts: Mapping[str, bytes], snapshot: Snapshot, target: Target, options: Options
    ) -> Iterable[Deviation]:
        """Check the connections of Run and Test; only the package approach has them."""
        from urdfsync.urdf.physics.wiring import wiring  # no build needs it

        tree = KinematicTree.of(from_snapshot(snapshot), (target.name,))
        return wiring(texts, tree, target, options) if "package" in options.approach else ()


DOMAIN = UrdfDomain()

"""A URDF rendered to its Modelica package, by the domain and the renderer alone: no engine, no manifest."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, get_args

import msgspec

from support.corpus import REPOSITORY
from urdfsync.common.diagnostics import Diagnostic
from urdfsync.domain import Artifact, Companion, Import, Lookup, Order, Reading, Role, Target, Version
from urdfsync.engine.judgements import judge
from urdfsync.engine.package.render import Renderer
from urdfsync.formats.urdf.artifacts import record
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.options import LeftOut, Options
from urdfsync.formats.urdf.robot import Robot
from urdfsync.project.state.record import as_read, as_recorded

_EXTENDS = re.compile(r"  extends UrdfSync\.Records\.Robot\(\n(.*?)\);\n\n", re.DOTALL)
_MODIFIER = re.compile(r"^    (?=\w)", re.MULTILINE)
_COMPONENT = re.compile(r"^  UrdfSync\.Records\.(\w+) (\w+)\((.*?)\)\n    \"", re.DOTALL | re.MULTILINE)
RENDERER = Renderer([REPOSITORY / "templates" / "urdf"])


@dataclasses.dataclass(frozen=True)
class Package:
    """The text files of a generated package by path below its folder, and the inputs of the generator."""

    target: Target
    options: Options
    robot: Robot
    skeleton: KinematicTree
    texts: Mapping[str, str]
    roles: Mapping[str, Role]
    imports: Mapping[str, bytes]
    """Imported meshes by path below the package's folder."""
    facts: Mapping[str, Import]
    """The facts about the meshes, by the meshes' keys."""
    artifacts: Sequence[Artifact | Order]

    @property
    def models(self) -> Mapping[str, str]:
        """The Modelica files among the texts."""
        return {path: text for path, text in self.texts.items() if path.endswith(".mo")}

    def write(self, root: Path) -> Path:
        """Write the package below `root`, which is the top level of Modelica's names; return the package's folder."""
        folder = root.joinpath(*self.target.package.split("."))
        files = {path: text.encode() for path, text in self.texts.items()} | dict(self.imports)
        for path, content in files.items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_bytes(content)
        return folder


def read(content: bytes, file: str = "robot.urdf") -> Reading:
    """Return the domain's reading of a source with the judgements about the robot, without the second reader."""
    reading = DOMAIN.read(content, file, Options(allow=get_args(LeftOut)))
    judged = () if reading.snapshot is None else judge(DOMAIN, Version(reading.snapshot), reading, file)
    return msgspec.structs.replace(reading, diagnostics=(*reading.diagnostics, *judged))


def proposed_base(content: bytes) -> str:
    """Return the option `base` that `init` proposes."""
    snapshot = read(content).snapshot
    assert snapshot is not None
    return str(next(proposal.value for proposal in DOMAIN.advice.propose(snapshot, ()) if proposal.option == "base"))


def generate(source: Path | bytes, target: Target, *companions: Companion, **options: Any) -> Package:
    """The package of a URDF that has no errors; `options` are those of the domain."""
    chosen = Options(**{"allow": get_args(LeftOut), **options})
    path = source if isinstance(source, Path) else Path("robot.urdf")
    content = source if isinstance(source, bytes) else source.read_bytes()
    reading = DOMAIN.read(content, path.name, chosen, *companions)
    assert reading.snapshot is not None, _texts(reading.diagnostics)
    imports, contents = _imports(reading, path, chosen)
    return _render(reading.snapshot, imports, contents, target, chosen)


def generate_robot(robot: Robot, target: Target, **options: Any) -> Package:
    """The package of a robot without meshes."""
    return _render(robot.by_name(), {}, {}, target, Options(**options))


def strict(package: Package) -> Package:
    """The same package, in which a passed limit is an error, not a warning."""
    warning, error = "AssertionLevel.warning", "AssertionLevel.error"
    assert any(warning in text for text in package.texts.values())
    texts = {path: text.replace(warning, error) for path, text in package.texts.items()}
    return dataclasses.replace(package, texts=texts)


def scaled(package: Package, factor: float) -> Package:
    """The same package with every floating-point number of the robot's snapshot multiplied by `factor`."""

    def scale(value: Any) -> Any:
        if isinstance(value, Mapping):
            return {key: scale(item) for key, item in value.items()}
        if isinstance(value, list | tuple):
            return [scale(item) for item in value]
        return value * factor if isinstance(value, float) else value

    options = package.options
    return _render(as_read(scale(as_recorded(package.robot)), Robot), {}, {}, package.target, options)


def _render(
    snapshot: Robot, imports: Mapping[str, Import], contents: Mapping[str, bytes], target: Target, options: Options
) -> Package:
    texts, roles, artifacts = {}, {}, tuple(DOMAIN.artifacts(snapshot, imports, target, options))
    for artifact in artifacts:
        if isinstance(artifact, Order):
            texts[artifact.path] = "".join(f"{name}\n" for name in artifact.names)
            roles[artifact.path] = Role.ORDER
        else:
            texts[artifact.path] = RENDERER.render(artifact.template, artifact.data)
            roles[artifact.path] = artifact.role
    tree = KinematicTree.of(snapshot, (target.name,))
    return Package(target, options, snapshot, tree, texts, roles, contents, imports, artifacts)


def _imports(reading: Reading, path: Path, options: Options) -> tuple[dict[str, Import], dict[str, bytes]]:
    imports, contents = {}, {}
    assert reading.snapshot is not None
    for dependency in DOMAIN.dependencies(reading.snapshot, Lookup(path.absolute()), options, reading.lines):
        found = next((candidate for candidate in dependency.candidates if candidate.is_file()), None)
        if found is not None:
            conversion = DOMAIN.convert(dependency, found, found.read_bytes(), {})
            imports[dependency.key] = Import(dependency.target, "", "", conversion.facts)
            contents[dependency.target] = conversion.content
    return imports, contents


def _texts(diagnostics: tuple[Diagnostic, ...]) -> list[str]:
    return [str(diagnostic) for diagnostic in diagnostics]


def record_text(of: KinematicTree | Robot) -> str:
    """The record of a robot."""
    artifact = record(Robot("r", of.links, of.joints), Target("", "RParameters"), Options(approach=("record",)))
    return RENDERER.render(artifact.template, artifact.data)


def record_tables(of: KinematicTree | Robot) -> list[str]:
    """The modifiers of `UrdfSync.Records.Robot` for this robot, without name and index matrices."""
    found = _EXTENDS.search(record_text(of))
    assert found is not None
    modifiers = [modifier.rstrip().rstrip(",") for modifier in _MODIFIER.split(found[1])[1:]]
    return [modifier for modifier in modifiers if not modifier.startswith(("name", "connectionM", "moveableJ"))]


def record_components(of: KinematicTree | Robot) -> dict[str, tuple[str, str]]:
    """Class and modifiers of each component of a class of `UrdfSync.Records`, the modifiers on one line."""
    return {name: (kind, " ".join(text.split())) for kind, name, text in _COMPONENT.findall(record_text(of))}

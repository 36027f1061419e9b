"""Each installed domain meets the requirements of the core."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec
import pytest
from support.meshes import stl

from urdfsync.common.diagnostics import Severity
from urdfsync.common.files import Templates, digest, templates_digest
from urdfsync.domain import (
    Artifact,
    Dependency,
    Domain,
    Import,
    Lookup,
    Order,
    Role,
    Snapshot,
    Target,
    Version,
    registry,
)
from urdfsync.domain.advice import Advice
from urdfsync.domain.bench import Benches
from urdfsync.domain.changes import Effects
from urdfsync.domain.comparison import compare
from urdfsync.domain.experiment import Checks
from urdfsync.domain.features import Mentions
from urdfsync.domain.scene import Pictures
from urdfsync.engine.package import generate
from urdfsync.formats.urdf import advice, benches, scene
from urdfsync.formats.urdf.diff import effects
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.meshes import lookup
from urdfsync.modelica.names import is_identifier, within
from urdfsync.project import config
from urdfsync.project.config import Keys
from urdfsync.project.state import statefile
from urdfsync.project.state.record import Generator, Record, as_read, as_recorded

URDF = b"""<robot name="two &quot;links&quot;">
  <link name="base link"/>
  <link name="Tip">
    <inertial><mass value="1.5"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
    <visual><geometry><mesh filename="tip.stl"/></geometry></visual>
  </link>
  <joint name="tip" type="revolute">
    <parent link="base link"/><child link="Tip"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1.25" effort="3" velocity="2"/>
  </joint>
</robot>
"""
EXAMPLES = Path(__file__).parent / "rcnetwork" / "examples"
TABLE = b'name,mass [kg],made\nM1,1.25,yes\n"two ""words""",3,\n'
SAMPLES: dict[str, tuple[bytes, bytes | None]] = {
    "table": (TABLE, None),
    "urdf": (URDF, stl(height=0.5).encode()),
    "rcnetwork": ((EXAMPLES / "ladder.json").read_bytes(), (EXAMPLES / "step.csv").read_bytes()),
}
"""Per domain: a source, and the content of the file that it refers to; None without such a file."""

TARGET = Target("Plant.Robots.Sample", "Sample")


@dataclasses.dataclass(frozen=True)
class Case:
    """A domain with its sample, read and imported."""

    domain: Domain
    options: Any
    snapshot: Snapshot
    dependencies: tuple[Dependency, ...]
    imports: Mapping[str, Import]

    def artifacts(self) -> list[Artifact | Order]:
        return list(self.domain.artifacts(self.snapshot, self.imports, TARGET, self.options))

    def generated(self) -> generate.Package:
        folders = (config.templates_folder(self.domain),)
        templates = Templates(folders, templates_digest(folders))
        return generate.generate(self.domain, Version(self.snapshot, self.imports), TARGET, self.options, templates)


def make(name: str) -> Case:
    domain = registry.domain(name)
    options = domain.options()
    source, content = SAMPLES[name]
    reading = domain.read(source, "sample", options)
    assert reading.snapshot is not None
    assert not [found for found in reading.diagnostics if found.severity is Severity.ERROR]
    snapshot = reading.snapshot
    lookup = Lookup(Path("/sources/sample"), (Path("/packages"),))
    dependencies = tuple(domain.dependencies(snapshot, lookup, options, reading.lines))
    if content is None:
        assert not dependencies
        return Case(domain, options, snapshot, (), {})
    (dependency,) = dependencies
    conversion = domain.convert(dependency, dependency.candidates[0], content, {})
    hashes = digest(content), digest(conversion.content)
    facts = json.loads(json.dumps(conversion.facts))
    entry = Import(dependency.target, *hashes, facts)
    return Case(domain, options, snapshot, dependencies, {dependency.key: entry})


@pytest.fixture(params=sorted(SAMPLES))
def case(request: pytest.FixtureRequest, rc_domain: None) -> Case:
    return make(request.param)


def test_every_installed_domain_is_tested(rc_domain: None) -> None:
    assert set(registry.names()) == set(SAMPLES)


def test_options(case: Case) -> None:
    fields = msgspec.structs.fields(case.domain.options)
    known, shared = ({one.encode_name for one in found} for found in (fields, msgspec.structs.fields(Keys)))
    assert not shared & known, "an option hides a key of the configuration"
    assert msgspec.convert(msgspec.to_builtins(case.options), case.domain.options) == case.options
    with pytest.raises(AttributeError, match="immutable"):
        setattr(case.options, fields[0].name, None)
    reading = case.domain.read(SAMPLES[case.domain.name][0], "sample", case.options)
    assert reading.option_findings == (), "defaults suit every model"
    assert case.domain.advice
    values = {proposal.option: proposal.value for proposal in case.domain.advice.propose(case.snapshot, ())}
    assert values.keys() <= known
    msgspec.convert(values, case.domain.options)


def test_a_snapshot_comes_back_from_a_state(case: Case) -> None:
    record = Record(
        package="Sample",
        class_="Sample",
        folder="Sample",
        generator=Generator("sample", "1.0.0", ""),
        snapshot=as_recorded(case.snapshot),
        imports=case.imports,
    )
    (loaded,), damage = statefile.loads(statefile.dumps(record), "sample.state")
    assert (loaded, damage) == (record, None)
    assert loaded.snapshot is not None
    assert as_read(loaded.snapshot, case.domain.model) == case.snapshot


def test_nobody_changes_a_snapshot(case: Case) -> None:
    assert case.domain.model.__struct_config__.frozen
    first = msgspec.structs.fields(case.domain.model)[0].name
    other = msgspec.structs.replace(case.snapshot, **{first: type(getattr(case.snapshot, first))()})
    assert compare(Version(case.snapshot), Version(other), case.domain, case.options).changes


@pytest.mark.parametrize("content", [b"", b"\0", b"\xff\xfe", b"<", b"{", b"no source at all", "ä".encode("latin-1")])
def test_bad_sources_are_told_with_file_and_no_exception(case: Case, content: bytes) -> None:
    reading = case.domain.read(content, "bad", case.options)
    errors = [found for found in reading.diagnostics if found.severity is Severity.ERROR]
    assert reading.snapshot is None
    assert errors
    assert {found.file for found in errors} == {"bad"}


def test_dependencies_are_only_looked_for_by_the_core(case: Case) -> None:
    for dependency in case.dependencies:
        assert dependency.candidates[0] == Path("/sources") / Path(dependency.uri).name
        assert all(path.is_absolute() for path in dependency.candidates)
        assert dependency.line > 0
        assert dependency.noun.isidentifier()
        generate.check_paths((dependency.target,))


def texts(package: generate.Package) -> dict[str, bytes]:
    return {path: package.content(path) for path in package.artifacts}


def test_artifacts_are_inside_the_package_and_apart(case: Case) -> None:
    artifacts = case.artifacts()
    generate.check_paths((*(artifact.path for artifact in artifacts), *(one.target for one in case.dependencies)))
    files = [artifact for artifact in artifacts if isinstance(artifact, Artifact)]
    assert {file.role for file in files} <= {Role.RECORD, Role.MODEL, Role.PACKAGE}
    assert all(file.owner for file in files)


def test_artifacts_follow_from_their_input_alone(case: Case) -> None:
    again = make(case.domain.name)
    assert again.imports == case.imports, "conversions, too"
    one, two = case.generated(), again.generated()
    assert (one.artifacts, one.orders) == (two.artifacts, two.orders)
    assert texts(one) == texts(two)
    if case.domain.drawing:
        drawing = case.domain.drawing(case.snapshot, case.imports, TARGET, case.options, {})
        assert drawing is None or "<svg" in drawing
        assert drawing == case.domain.drawing(again.snapshot, again.imports, TARGET, again.options, {})


def test_imports_show_in_the_text_only_while_they_are_there(case: Case) -> None:
    with_import = case.generated()
    without = dataclasses.replace(case, imports={}).generated()
    for target in (one.target.encode() for one in case.dependencies):
        assert any(target in text for text in texts(with_import).values())
        assert not any(target in text for text in texts(without).values())


def test_every_folder_is_a_package_with_a_complete_order(case: Case) -> None:
    generated = case.generated()
    for folder in {str(Path(path).parent) for path in generated.artifacts}:
        prefix = "" if folder == "." else f"{folder}/"
        assert f"{prefix}package.mo" in generated.artifacts
        inside = [path.removeprefix(prefix) for path in generated.artifacts if path.startswith(prefix)]
        classes = {path.removesuffix(".mo").partition("/")[0] for path in inside} - {"package"}
        names = generated.orders[f"{prefix}package.order"]
        assert sorted(names) == sorted(classes)


def test_every_class_says_where_it_is(case: Case) -> None:
    for path, content in texts(case.generated()).items():
        *folders, name = path.removesuffix(".mo").split("/")
        parts = [TARGET.package, *folders, *([] if name == "package" else [name])]
        text = content.decode()
        assert text.startswith(within(".".join(parts))), path
        assert text.endswith(f"end {parts[-1].rpartition('.')[2]};\n"), path
        assert "\r" not in text
        assert "<<" not in text
        assert "<%" not in text


def test_names_are_identifiers_and_reversible(case: Case) -> None:
    for names in case.domain.names(case.snapshot, TARGET).values():
        assert all(map(is_identifier, names.values()))
        assert len(set(names.values())) == len(names)


ANSWERS: tuple[Advice, Mentions, Effects, Checks, Benches, Pictures]
ANSWERS = advice, lookup, effects, benches, benches, scene
"""mypy holds the modules of the URDF domain to the Protocols."""


def test_modules_answer_what_is_asked_beside_the_domain() -> None:
    names = "advice", "imports", "effects", "checks", "simulation", "pictures"
    assert tuple(getattr(DOMAIN, name) for name in names) == ANSWERS


def test_what_has_to_compile_is_in_the_package() -> None:
    case = make("urdf")
    models = benches.models(case.snapshot, TARGET, case.options)
    assert models[0] == TARGET.name
    assert {f"{model.replace('.', '/')}.mo" for model in models} <= case.generated().artifacts.keys()
    bench = benches.bench(case.snapshot, TARGET, case.options)
    assert bench
    assert {bench.test, bench.run} <= {*models}, "what is simulated is checked"


def test_a_domain_need_not_answer_more_than_a_build_asks() -> None:
    class Least(Domain):
        """A domain with nothing but the fields without a default."""

    public = {name for name in vars(Domain) if not name.startswith("_")}
    methods = {name for name in public if callable(getattr(Domain, name))} - {"options"}
    assert len(methods) <= 10
    assert {getattr(Least, name) for name in ("advice", "checks", "simulation", "pictures", "record")} == {None}

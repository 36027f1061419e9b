"""Compare sources with the last build, or with another version of them. Writes nothing, and locks nothing for writing.

Against the last build the answer is that of a dry run: its changes, its plan. Another version is read as the
source itself is, with the files that it refers to as they are in that version.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import msgspec

from urdfsync import registry
from urdfsync.config import Config, RobotConfig, shown, templates_folder
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity, UrdfsyncError
from urdfsync.diff import changes
from urdfsync.diff.changes import Changes
from urdfsync.diff.revisions import VersionedSource, from_file, from_revision
from urdfsync.domain import ChangeClass, Dependency, Effect, Import, Lookup, Role, Target, Templates, Version
from urdfsync.engine import imports
from urdfsync.engine import source as source_files
from urdfsync.engine.actions import Action, Actions, Kind
from urdfsync.engine.build import build
from urdfsync.engine.generate import Package, generate
from urdfsync.engine.inputs import NO_MODEL, inspect
from urdfsync.engine.options import BuildOptions
from urdfsync.files import Tree, digest, templates_digest, text_digest
from urdfsync.modelica.names import class_name
from urdfsync.outcome import Exit, Result
from urdfsync.state.modelfile import ConversionFacts
from urdfsync.state.store import State, Store

_DOMAIN = "urdf"
"""Domain of a source that no robot of the configuration has."""
_MINE = frozenset({Kind.CONFLICT, Kind.UNOWNED, Kind.MERGE, Kind.MOVE, Kind.LEAVE, Kind.INCLUDED, Kind.ORPHAN})
"""Actions on files that the user edited, and that the changes concern."""


class ComparedSource(msgspec.Struct, frozen=True):
    """One source to compare, with all that a package is made from it with."""

    name: str
    source: Path
    """Absolute."""
    domain: str
    options: Any
    """An instance of the domain's options."""
    target: Target
    package_paths: tuple[Path, ...] = ()
    robot: RobotConfig | None = None
    """The robot of the configuration that has it; None for a source that is in no configuration."""


class Comparison(msgspec.Struct, frozen=True):
    """A source as it is now, compared with an older version of it."""

    result: Result
    """Result of a dry run; against another version than the last build, an action for each file that differs."""
    source: str
    """The source, as people see it."""
    against: str | None = None
    """The other version, as the user named it; None for the last build."""
    missing: str = ""
    """Why there is no older version to compare with; empty if there is one."""
    effects: tuple[Effect, ...] = ()
    """Properties of the model as a whole that the changes concern."""
    edited: frozenset[str] = frozenset()
    """The files among the actions that the user has edited."""

    @property
    def changes(self) -> Changes | None:
        """The changes of the model; None if there are none, or if nothing is known of the older version."""
        return self.result.changes

    @property
    def change_class(self) -> ChangeClass:
        """How far the changes reach."""
        return self.changes.change_class if self.changes else ChangeClass.NONE

    @property
    def in_step(self) -> bool:
        """Whether both versions give the same package, and the package on disk needs nothing."""
        return self.result.in_step and self.change_class in (ChangeClass.NONE, ChangeClass.UNMODELLED)


def exit_code(comparisons: Sequence[Comparison]) -> Exit:
    """Return the worst of all: an error, a lock, being out of step; a conflict is no more than that."""
    if any(one.result.failed and not one.result.locked for one in comparisons):
        return Exit.ERROR
    if any(one.result.locked for one in comparisons):
        return Exit.LOCKED
    return Exit.IN_STEP if all(one.in_step for one in comparisons) else Exit.OUT_OF_STEP


# --- sources ------------------------------------------------------------------------------------------------------


def find_sources(source: str, config: Config | None, names: Sequence[str], folder: Path) -> list[ComparedSource]:
    """Return what `source` means: a path from `folder`, else a robot's name; empty for all robots.

    `names` leaves only robots of these names. Without a configuration, or in none, a file is compared by itself.
    Raises ConfigError if there is nothing of that name.
    """
    path = Path(os.path.normpath(folder / source))
    if config is None:
        if not path.is_file():
            raise _config_error("no-source", f"there is no file {source!r}", hint="name a source that exists")
        return [_alone(path)]
    chosen = config.select(names)
    if not source:
        return [_of_robot(robot) for robot in chosen]
    using = [robot for robot in config.robots if os.path.realpath(robot.source) == os.path.realpath(path)]
    if not using and path.is_file():
        if not names:
            return [_alone(path)]
    elif not using:
        using = [robot for robot in config.robots if robot.name == source]
        if not using:
            message = f"there is no file {source!r}, and no robot of this name in {shown(config.file)}"
            hint = f"it has {', '.join(robot.name for robot in config.robots)}"
            raise _config_error("no-source", message, hint=hint)
    left = [robot for robot in using if robot in chosen]
    if not left:
        message = f"{source!r} is not the source of {' or '.join(f'`{name}`' for name in names)}"
        raise _config_error("other-source", message, config.file, "leave out --robot, or name the robot alone")
    return [_of_robot(robot) for robot in left]


def check_sources(sources: Sequence[ComparedSource], against: str | None, config: Config | None, folder: Path) -> None:
    """Raise ConfigError for sources that can't be compared with `against`."""
    alone = [one for one in sources if one.robot is None]
    if alone and against is None and config is not None:
        message = f"{alone[0].name} was never built: it is no robot's source"
        hint = "add a robot for it, or name the version to compare it with: --against FILE or REVISION"
        raise _config_error("no-robot", message, config.file, hint)
    if against is not None and (folder / against).is_file() and len({one.source for one in sources}) > 1:
        message = f"one file can't be the older version of {len(sources)} sources"
        raise _config_error("one-file", message, hint="name the source to compare it with")


def _of_robot(robot: RobotConfig) -> ComparedSource:
    return ComparedSource(
        robot.name, robot.source, robot.domain, robot.options, robot.target, robot.package_paths, robot=robot
    )


def _alone(path: Path) -> ComparedSource:
    name = class_name(path.name.partition(".")[0])
    return ComparedSource(path.name, path, _DOMAIN, registry.domain(_DOMAIN).options(), Target(name, name))


def _config_error(code: str, message: str, file: Path | None = None, hint: str = "") -> ConfigError:
    return ConfigError(Diagnostic(Severity.ERROR, code, message, shown(file) if file else "", hint=hint))


# --- comparisons --------------------------------------------------------------------------------------------------


def compare_sources(
    sources: Sequence[ComparedSource],
    against: str | None,
    config: Config | None,
    build_options: BuildOptions,
    folder: Path,
) -> Iterator[Comparison]:
    """Compare each source with the last build, or with `against`: a file, counted from `folder`, or a git revision.

    One that fails does not stop the others. Without `against`, sources must be those of robots of the configuration.
    """
    for count, source in enumerate(sources):
        build_options.progress(source.name, count, len(sources))
        try:
            if against is not None:
                yield _with_version(source, against, config, build_options, folder)
            elif config is not None and source.robot is not None:
                yield _with_last_build(source, source.robot, config, build_options)
        except UrdfsyncError as error:
            failed = msgspec.structs.replace(_result(source, config), failed=True, diagnostics=error.diagnostics)
            yield Comparison(failed, shown(source.source), against)


def _result(source: ComparedSource, config: Config | None) -> Result:
    """Return an empty result; without a configuration, paths count from nowhere."""
    if config is None or source.robot is None:
        return Result(source.name, source.target.package, Path(), Path(), dry=True)
    return Result(source.name, source.target.package, source.robot.folder, config.root, dry=True)


def _with_last_build(
    source: ComparedSource, robot: RobotConfig, config: Config, build_options: BuildOptions
) -> Comparison:
    (result,) = build(config, [robot], msgspec.structs.replace(build_options, dry=True))
    comparison = Comparison(result, shown(source.source))
    if result.failed:
        return comparison
    inputs = inspect(config, robot, build_options)
    last, found = inputs.last_complete, result.changes
    missing = "" if last else "what was built last is not known any more" if inputs.recorded else "never built"
    edited = frozenset(action.path for action in result.actions.decided if action.kind in _MINE)
    comparison = msgspec.structs.replace(comparison, missing=missing, edited=edited)
    if last is None or found is None or not (found.changes or found.generator):
        return comparison
    name = shown(source.source)
    new = Version(source_files.read(inputs.domain, source.options, inputs.content, name)[0])
    try:
        effects = _effects(last, new, found, source)
    except NO_MODEL:
        return comparison  # what is recorded is no model of the domain
    return msgspec.structs.replace(comparison, effects=effects)


def _with_version(
    source: ComparedSource, against: str, config: Config | None, build_options: BuildOptions, folder: Path
) -> Comparison:
    """Compare a source with another version of it; the actions are those of a package that nobody edited."""
    domain, result = registry.domain(source.domain), _result(source, config)
    is_robot = config is not None and source.robot is not None
    state = Store(config.root, shown).load(source.name) if config and source.robot else None
    tree = Tree(source.robot.output, shown) if source.robot else None

    def copy(target: str) -> bytes | None:
        return tree.read(result.folder / target) if tree else None

    with tempfile.TemporaryDirectory(prefix="urdfsync-") as scratch:
        if (folder / against).is_file():
            other = from_file(folder / against, source.source)
        else:
            other = from_revision(against, source.source, Path(scratch))
        # imports of the last build, and those of the one version for the other, need not be converted again
        recorded = imports.Recorded({}, {}, copy, lambda _target: None)
        if state is not None and state.model is not None and state.intact:
            recorded = imports.Recorded(state.manifest.dependencies, state.model.imports, copy, lambda _target: None)
        new, imported, told = _read(source, from_file(source.source), recorded, build_options)
        known = imports.Recorded(
            {key: record for key, record in imported.records.items() if key in imported.imports},
            {k: ConversionFacts(i.source_hash, i.converter, dict(i.facts)) for k, i in imported.imports.items()},
            lambda target: imported.contents.get(target) or copy(target),
            lambda _target: None,
        )
        old, _, told_before = _read(source, other, known, build_options)
    found = changes.compare(old, new, domain, source.options)
    before = {(one.code, one.message) for one in told_before}
    new_findings = tuple(one for one in told if (one.code, one.message) not in before)
    if not found.changes:
        result = msgspec.structs.replace(result, diagnostics=new_findings)
        return Comparison(result, shown(source.source), against)
    folders = [templates_folder(domain)]
    templates = Templates(tuple(folders), templates_digest(folders))
    if is_robot and config and source.robot:
        templates = source_files.templates(config, source.robot, domain)
    one, two = (
        generate(domain, version.snapshot, version.imports or {}, source.target, source.options, templates)
        for version in (old, new)
    )
    differing = [*_differing_texts(one, two), *_differing_imports(old.imports or {}, new.imports or {})]
    actions = Actions(
        Action(Path(os.path.relpath(result.folder / path, result.root)).as_posix(), kind, role, owner)
        for path, kind, role, owner in differing
    )
    result = msgspec.structs.replace(result, actions=actions, changes=found, diagnostics=new_findings)
    paths = (action.path for action in actions.decided)
    edited = frozenset(path for path in paths if tree and state and _is_edited(path, result.root, tree, state))
    effects = _effects(old, new, found, source)
    return Comparison(result, shown(source.source), against, "", effects, edited)


def _effects(old: Version, new: Version, found: Changes, source: ComparedSource) -> tuple[Effect, ...]:
    domain = registry.domain(source.domain)
    interface = domain.interface(old, new, found.renames, source.target, source.options)
    return (*domain.effects(old, new), *interface)


def _read(
    source: ComparedSource, version: VersionedSource, known: imports.Recorded, build_options: BuildOptions
) -> tuple[Version, imports.Imported, tuple[Diagnostic, ...]]:
    """Read a version and the files that it refers to; imports that are `known` need not be converted again.

    Raises SourceError for a source that can't be read.
    """
    domain = registry.domain(source.domain)
    plain, reading = source_files.read(domain, source.options, version.content, version.name)
    lookups = [Lookup(place, source.package_paths + build_options.package_paths) for place in version.places]
    found = [imports.find_dependencies(domain, plain, lookup, source.options, reading.lines) for lookup in lookups]
    dependencies = version.locate([_joined(same) for same in zip(*found, strict=True)])
    what = f"{source.name}: imports"
    imported = imports.bring_in(
        domain,
        dependencies,
        known,
        version.name,
        again=False,
        progress=lambda *done: build_options.progress(what, *done),
    )
    return Version(plain, imported.imports), imported, (*reading.diagnostics, *imported.diagnostics)


def _joined(same: Sequence[Dependency]) -> Dependency:
    """Return one dependency that is looked for from several places."""
    candidates = dict.fromkeys(path for dependency in same for path in dependency.candidates)
    return msgspec.structs.replace(same[0], candidates=tuple(candidates))


def _differing_texts(before: Package, after: Package) -> Iterator[tuple[str, Kind, Role, str]]:
    """Yield path, action, role and owner of each file whose text differs."""
    for path in after.changed_since(before) | (before.artifacts.keys() - after.artifacts.keys()):
        one, two = before.artifacts.get(path), after.artifacts.get(path)
        if one and two and before.content(path) == after.content(path):
            continue
        if known := two or one:
            yield path, _kind(one is not None, two is not None), known.role, known.owner
    for path in before.orders.keys() | after.orders.keys():
        if before.orders.get(path) != after.orders.get(path):
            yield path, _kind(path in before.orders, path in after.orders), Role.ORDER, "package"


def _differing_imports(old: Mapping[str, Import], new: Mapping[str, Import]) -> Iterator[tuple[str, Kind, Role, str]]:
    """The same for imported files."""
    for key in (*new, *(key for key in old if key not in new)):
        one, two = old.get(key), new.get(key)
        if (known := two or one) and (one is None or two is None or one.target_hash != two.target_hash):
            yield known.target, _kind(one is not None, two is not None), Role.IMPORT, key


def _kind(was: bool, now: bool) -> Kind:
    return Kind.UPDATE if was and now else Kind.CREATE if now else Kind.DELETE


def _is_edited(path: str, root: Path, tree: Tree, state: State) -> bool:
    """Whether the file on disk is another than the last build wrote."""
    record = state.manifest.files.get(path)
    if record is None or record.base is None:
        return False
    mine = tree.read(Path(os.path.normpath(root / path)))
    hash_of = digest if record.role is Role.IMPORT else text_digest
    return mine is not None and hash_of(mine) != record.base

"""Compares sources with the last build, or with another version. Writes nothing, and takes no lock.

The result of a dry run says what the next build does. A comparison with the last build has its changes. Another
version is read like the source, with the files of that version: then the changes are those of the two versions.
"""

from __future__ import annotations

import itertools
import os
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple, TypeAlias

import msgspec

from urdfsync.common.diagnostics import ConfigError, Diagnostic, Severity, SourceError, findings_of
from urdfsync.common.files import relative, shown
from urdfsync.domain import ChangeClass, ChangeKind, Domain, Lookup, Reading, Target, Version, registry
from urdfsync.domain import comparison as changes
from urdfsync.domain.changes import Effect
from urdfsync.domain.comparison import Changes
from urdfsync.domain.matching import Matching
from urdfsync.engine.build import build
from urdfsync.engine.inspect.inputs import inspect
from urdfsync.engine.judgements import find_jumps, judge
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.package import imports
from urdfsync.engine.package.generate import Package, generate
from urdfsync.engine.renames import find_matching
from urdfsync.engine.result import Exit, Outlook, Result, error_count
from urdfsync.engine.result import exit_code as exit_code_of
from urdfsync.engine.sources import source as source_files
from urdfsync.engine.sources.source import Source
from urdfsync.engine.stage.findings import CONNECTORS
from urdfsync.modelica.names import class_name
from urdfsync.output.phrases import change_counts, generator_change
from urdfsync.project.config import FILE_NAME, Config, RobotConfig, load
from urdfsync.project.git.revisions import Revision
from urdfsync.project.state.store import Store

_DOMAIN = "urdf"
"""The domain of sources that no configuration names."""


VersionContents: TypeAlias = tuple[Version, Mapping[str, bytes]]
"""A version, and the contents of its imported files by path."""


class Comparison(msgspec.Struct, frozen=True):
    """The comparison of a source with an older version."""

    KEYS = ("source", "against", "in_step", "summary", "changes", "files", "effects", "result")

    result: Result
    """Result of a dry run; without actions if no configuration names the source, or if two sources are compared.

    With `against`, its findings are the new ones since that version, and the errors of the run.
    """
    source: str
    """The source's name for people."""
    against: str | None = None
    """The user's name of the other version; None for the last build."""
    missing: str = ""
    """Why there is no older version; empty if there is an older version."""
    changes: Changes | None = None
    """Changes of the model since the older version; None if there are none, or if they are unknown."""
    files: Mapping[str, ChangeKind] = {}
    """With `against`: the files that differ between the packages of both versions, as paths in `result.actions`."""
    effects: tuple[Effect, ...] = ()
    """Properties of the whole model that changed."""
    is_pair: bool = False
    """Whether two sources stand side by side: only their motion is compared, and no file."""
    versions: tuple[VersionContents, ...] = ()
    """The older and the new version; empty for the last build, or after an error."""

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """The findings, without findings that `effects` shows."""
        return tuple(finding for finding in self.result.diagnostics if finding.code != CONNECTORS)

    @property
    def in_step(self) -> bool:
        """Return whether both versions give the same package, and nothing is in conflict.

        After a comparison with the last build, the package on disk must be in step, too.
        """
        is_settled = self.result.in_step if self.against is None else not (self.result.failed or self.result.conflicts)
        silent = (ChangeClass.NONE, ChangeClass.UNMODELLED)
        is_same = (self.changes or Changes()).change_class in silent
        return is_settled and is_same and not self.files  # rows of a table may change places only

    @property
    def summary(self) -> str:
        """The changes since the older version, as the rest of a line that names the robot."""
        if self.result.failed and self.result.changes is None:
            return f"{error_count(self.result.diagnostics)}, so nothing can be compared"
        if self.missing:
            return self.missing
        since = f"since {'the last build' if self.against is None else self.against}"
        since = f"against {self.against}" if self.is_pair else since
        changes = self.changes
        if changes is None and self.is_pair:
            return f"no difference in motion {since}"
        if changes is None:
            return f"nothing changed {since}{'' if self.in_step else ', but files are out of step'}"
        return f"{change_counts(changes) if changes.changes else generator_change(changes)} {since}"


def exit_code(comparisons: Sequence[Comparison]) -> Exit:
    """Return the exit code of the worst result: error, lock, out of step. A conflict counts as out of step."""
    code = exit_code_of(comparison.result for comparison in comparisons)
    if code in (Exit.ERROR, Exit.LOCKED):
        return code
    return Exit.IN_STEP if all(comparison.in_step for comparison in comparisons) else Exit.OUT_OF_STEP


def select_sources(
    sources: Sequence[str], against: str | None, config: Config | None, folder: Path
) -> Iterator[tuple[Config | None, Sequence[RobotConfig]]]:
    """Yield the robots for the arguments; for a source without a robot, yield a new robot. Raises ConfigError."""
    if config is None and against is None:
        place = f"{folder} or a folder above it"
        message = f"no {FILE_NAME} in {place}, so there is no last build to compare with"
        hint = "name the version to compare with: --against FILE or REVISION, or begin with `urdfsync init`"
        raise ConfigError.of("no-config", message, hint=hint)
    known = {os.path.realpath(robot.source) for robot in config.robots} if config else set()
    places = {text: Path(os.path.normpath(folder / text)) for text in sources}
    alone = {text: place for text, place in places.items() if place.is_file() and os.path.realpath(place) not in known}
    if config is None and (missing := places.keys() - alone.keys()):
        raise ConfigError.of("no-source", f"there is no file {min(missing)!r}", hint="name a source that exists")
    if against is None and alone:
        message = f"{min(alone)} was never built: it is not the source of a robot"
        hint = "add a robot for it, or name the version to compare it with: --against FILE or REVISION"
        raise ConfigError.of("no-robot", message, hint=hint)
    named = [text for text in sources if text not in alone]
    robots = config.select(named) if config and (named or not alone) else ()
    compared = {*(robot.source for robot in robots), *alone.values()}
    if against and len(compared) > 1 and any(_is_file(against, source, folder) for source in compared):
        message = "--against names one file, but several sources are compared"
        raise ConfigError.of("one-file", message, hint="name the source to compare it with")
    yield config, robots
    yield None, [robot_of_file(place) for place in alone.values()]


def older_of_pair(sources: Sequence[str], config: Config | None, folder: Path) -> str | None:
    """Return the first of two sources that stand side by side; None if the arguments name robots.

    Two files stand side by side unless both are sources of robots: then each has a last build.
    """
    places = [Path(os.path.normpath(folder / text)) for text in sources]
    if len(places) != 2 or not all(place.is_file() for place in places):
        return None
    known = {os.path.realpath(robot.source) for robot in config.robots} if config else set()
    is_pair = any(os.path.realpath(place) not in known for place in places)
    return sources[0] if is_pair else None


def robot_of_file(path: Path) -> RobotConfig:
    """Return a robot for a source that no configuration names, with default settings and permissive options."""
    name = class_name(path.name.partition(".")[0])
    options = registry.domain(_DOMAIN).permissive_options
    return RobotConfig(
        name=path.name,
        source=path,
        source_text=path.name,
        output=Path(),
        target=Target(name, name),
        domain=_DOMAIN,
        options=options,
    )


def compare_sources(
    robots: Sequence[RobotConfig],
    against: str | None,
    config: Config | None,
    options: BuildOptions,
    folder: Path,
    *,
    is_pair: bool = False,
) -> Iterator[Comparison]:
    """Compare each source with the last build, or with `against`: a git revision, or a path from `folder`.

    If `is_pair`, `against` is another source, and only the motion is compared.

    A failure does not stop the others. Without a configuration, `against` is required.
    """
    dry = msgspec.structs.replace(options, dry=True)
    # all in one dry run, which looks at the robots' records once
    results = build(config, robots, dry) if config is not None and not is_pair else itertools.repeat(None)
    for count, (robot, result) in enumerate(zip(robots, results, strict=False)):
        options.progress(robot.name, count, len(robots))
        try:
            plan = _result(robot, config) if result is None else result
            if against is not None:
                yield _with_version(robot, against, config, options, folder, plan, is_pair=is_pair)
            elif config is not None:
                yield _with_last_build(robot, config, options, plan)
        except Exception as error:  # noqa: BLE001 - one robot's error does not stop the others
            failed = msgspec.structs.replace(_result(robot, config), failed=True, diagnostics=findings_of(error))
            yield Comparison(failed, shown(robot.source), against)


def _result(robot: RobotConfig, config: Config | None) -> Result:
    """Return an empty result; without a configuration, paths count from the robot's package."""
    if config is None:
        return Result(robot=robot.name, package=robot.target.package, folder=Path(), root=Path(), dry=True)
    return Result.of(config, robot, Outlook(), dry=True)


def _with_last_build(robot: RobotConfig, config: Config, options: BuildOptions, result: Result) -> Comparison:
    """Compare a source with the last build; `result` is that of a dry run."""
    # also after a failure
    if result.changes is None and not (result.writes or result.renews or result.conflicts):
        return Comparison(result, shown(robot.source))
    inputs = inspect(config, robot, options)
    last, differences = inputs.last.version, result.changes
    missing = "" if last else "the record of the last build is lost" if inputs.last.record.files else "never built"
    effects: tuple[Effect, ...] = ()
    if last is not None and differences is not None and (differences.changes or differences.generator):
        snapshot, _ = source_files.read(inputs.domain, robot.options, inputs.source)
        with inputs.last.passing_over_invalid():
            effects = _effects(inputs.domain, last, Version(snapshot), differences, robot)
    return Comparison(result, shown(robot.source), None, missing, differences, effects=effects)


def _is_file(against: str, source: Path, folder: Path) -> bool:
    """Return whether `against` names a file: it looks like a path, or git has no such revision.

    Raises SourceError if git fails.
    """
    if not (folder / against).is_file():
        return False
    if against.startswith(("./", "../")) or Path(against).is_absolute():
        return True
    try:
        Revision(source.parent, against)
    except SourceError as error:
        if error.diagnostics[0].code == "git":
            raise
        return True
    return False


class _ReadVersion(NamedTuple):
    """One version of a source."""

    text: Source
    model: Version
    imported: imports.Imported
    reading: Reading
    told: tuple[Diagnostic, ...]
    """Findings about source and imports."""


def _with_version(
    robot: RobotConfig,
    against: str,
    config: Config | None,
    options: BuildOptions,
    folder: Path,
    result: Result,
    *,
    is_pair: bool,
) -> Comparison:
    """Compare a source with another version; `result` is that of a dry run."""
    if result.failed and result.changes is None:  # an export that is refused has changes
        return Comparison(result, shown(robot.source), against)
    former, now = _read_both(robot, against, config, options, folder, is_pair=is_pair)
    domain, name = registry.domain(robot.domain), shown(robot.source)
    known = {(finding.code, finding.statement) for finding in former.told}
    findings = [finding for finding in now.told if (finding.code, finding.statement) not in known]
    has_other_format = is_pair or now.text.format != former.text.format
    models = former.model.snapshot, now.model.snapshot
    matching = find_matching(domain, *models, robot.renamed, has_other_format=has_other_format)
    if is_pair:
        result = msgspec.structs.replace(result, diagnostics=tuple(robot.without_ignored(findings)))
        news, effects = _compare_motion(domain, former.model, now.model, matching, robot)
        return Comparison(result, name, against, changes=news, effects=effects, is_pair=True)
    old, new = former.model, now.model
    differences = changes.compare(old, new, domain, robot.options, matching)
    new = msgspec.structs.replace(new, snapshot=domain.numbered(new, [old], lambda _: matching.renames))
    judged = [*judge(domain, new, now.reading, now.text.name, old, differences)]
    judged += find_jumps(domain, new, now.reading, now.text.name, old, differences.renames)
    findings = [*(now.text.locate(finding) for finding in judged if finding.is_new), *findings]
    errors = [finding for finding in result.diagnostics if finding.severity is Severity.ERROR]
    findings = [*(one for one in findings if one.code not in {error.code for error in errors}), *errors]
    files, effects = dict[str, ChangeKind](), tuple[Effect, ...]()
    if differences.changes or _is_reordered(old, new):
        templates = source_files.templates(config, robot, domain) if config else source_files.domain_templates(domain)
        packages = [generate(domain, version, robot.target, robot.options, templates) for version in (old, new)]
        if domain.describe is None:
            differences = changes.by_texts(differences, packages[1].changed_models(packages[0]))
        for path, kind in _differing_files(packages, (old, new)):
            files[Path(relative(result.folder / path, result.root)).as_posix()] = kind
        effects = _effects(domain, old, new, differences, robot)
    result = msgspec.structs.replace(result, diagnostics=robot.without_ignored(findings))
    news = differences if differences.changes else None
    versions = (old, former.imported.contents), (new, now.imported.contents)
    return Comparison(result, name, against, "", news, files, effects, versions=versions)


def _read_both(
    robot: RobotConfig, against: str, config: Config | None, options: BuildOptions, folder: Path, *, is_pair: bool
) -> tuple[_ReadVersion, _ReadVersion]:
    """Return the other version and the present one. Raises SourceError."""
    source = robot.source
    now = _read(robot, _read_text(robot, config, options), (source,), imports.Imported(), options)
    if not (is_pair or _is_file(against, source, folder)):
        return _read_revision(Revision(source.parent, against), robot, config, now.imported, options), now
    file = folder / against
    text = _read_file(msgspec.structs.replace(robot, source=file), config, options)
    return _read(robot, text, (file, source), now.imported, options), now


def _compare_motion(
    domain: Domain, old: Version, new: Version, matching: Matching, robot: RobotConfig
) -> tuple[Changes | None, tuple[Effect, ...]]:
    """Return the changes and effects of two sources side by side, as far as they differ in motion."""
    if domain.formats is not None:
        old, new = map(Version, domain.formats.in_common_frames(old.snapshot, new.snapshot, matching.renames))
    before, after = domain.features(old.snapshot), domain.features(new.snapshot)
    renames = {key: name for key, name in matching.renames.items() if key in before and (key[0], name) in after}
    # no file has the name of a doubtful element
    differences = changes.compare(old, new, domain, robot.options, Matching(renames))
    asked = domain.effects
    effects = (*asked.effects(old, new), *asked.loads(old, new, differences.renames)) if asked else ()
    return differences if differences.changes else None, effects


def _is_reordered(old: Version, new: Version) -> bool:
    """Whether two equal models list their elements in another order, such as rows of a table."""
    encoded = [msgspec.json.encode(version.snapshot) for version in (old, new)]
    return old.snapshot == new.snapshot and encoded[0] != encoded[1]


def _differing_files(packages: Sequence[Package], versions: Sequence[Version]) -> Iterator[tuple[str, ChangeKind]]:
    """Yield the files that differ in an older and a newer package, by path, with their changes."""
    changed = packages[1].changed_since(packages[0])
    older, newer = (_contents(*pair, changed) for pair in zip(packages, versions, strict=True))
    kinds = dict.fromkeys(older, ChangeKind.REMOVED) | dict.fromkeys(newer, ChangeKind.ADDED)
    kinds |= dict.fromkeys(older.keys() & newer.keys(), ChangeKind.CHANGED)
    yield from ((path, kinds[path]) for path in sorted({path for path, _ in older.items() ^ newer.items()}))


def _read_text(robot: RobotConfig, config: Config | None, options: BuildOptions) -> Source:
    """Read the source of a robot as a build does; without a configuration, read the file."""
    if config is None or robot.command:  # the file may be an expanded source
        return _read_file(robot, config, options)
    return source_files.read_source(config, robot, Store(config.root), options)


def _read_file(robot: RobotConfig, config: Config | None, options: BuildOptions) -> Source:
    """Read the file of a source with its companions; a translator may read it first."""
    folders = (*robot.package_paths, *options.package_paths)
    domain, arguments = registry.domain(robot.domain), robot.arguments or {}
    text = source_files.read_file_source(domain, robot.source, arguments, folders, robot.options)
    return source_files.with_named_companions(config, robot, text)


def _read_revision(
    revision: Revision, robot: RobotConfig, config: Config | None, known: imports.Imported, options: BuildOptions
) -> _ReadVersion:
    """Read a source as it is in a revision, and as the robot is configured there. Raises SourceError."""
    with revision.view():
        robot = _configured(robot, config)
        revision.read(robot.source)  # tells what to do if the file has another path there
        return _read(robot, _read_text(robot, config, options), (robot.source,), known, options)


def _configured(robot: RobotConfig, config: Config | None) -> RobotConfig:
    """Return a robot as a revision configures it; with default options if the revision has no such robot."""
    if config is None:
        return robot
    try:
        robots = load(config.file).robots
    except ConfigError as error:
        if error.diagnostics[0].code != "no-config":
            return robot  # later commits may have repaired the configuration, or renamed its keys
        robots = ()
    named = [each for each in robots if each.name == robot.name]
    of_source = [each for each in robots if each.source == robot.source]
    unknown = msgspec.structs.replace(robot, options=registry.domain(robot.domain).options())
    return next((each for each in (*named, *of_source) if each.domain == robot.domain), unknown)


def _contents(
    package: Package, version: Version, changed: Collection[str]
) -> dict[str, bytes | tuple[str, ...] | str | None]:
    """Return the content of each file of a package; None for texts that are not in `changed`: they are not rendered."""
    texts = {path: package.content(path) if path in changed else None for path in package.artifacts}
    imported = {file.target: file.target_hash for file in (version.imports or {}).values()}
    return {**texts, **package.orders, **imported}


def _effects(
    domain: Domain, old: Version, new: Version, differences: Changes, robot: RobotConfig
) -> tuple[Effect, ...]:
    asked = domain.effects
    if asked is None:
        return ()
    names = asked.interface(old, new, differences.renames, robot.target, robot.options)
    return (*asked.effects(old, new), *names, *asked.loads(old, new, differences.renames))


def _read(
    robot: RobotConfig, text: Source, places: Sequence[Path], known: imports.Imported, options: BuildOptions
) -> _ReadVersion:
    """Read a version of a source and the files that it refers to, by paths relative to one of `places`, best first.

    `known` imports are used without converting them again. Raises SourceError for an unreadable source.
    """
    domain = registry.domain(robot.domain)
    with text.locating():
        snapshot, reading = source_files.read(domain, robot.options, text)
    found_files = []
    for place in places:
        lookup = Lookup(place, robot.package_paths + options.package_paths)
        found_files.append(imports.find_dependencies(domain, snapshot, lookup, robot.options, reading.lines))
    dependencies = []
    for same in zip(*found_files, strict=True):  # the paths lead to the same file
        candidates = dict.fromkeys(path for dependency in same for path in dependency.candidates)
        dependencies.append(msgspec.structs.replace(same[0], candidates=tuple(candidates)))
    recorded = {
        key: imports.RecordedFile(entry, known.contents.get(entry.target), is_noted=True)
        for key, entry in known.imports.items()
    }
    imported = imports.import_files(domain, robot, options, dependencies, recorded, text.name)
    told = (*text.diagnostics, *map(text.locate, (*reading.diagnostics, *imported.diagnostics)))
    return _ReadVersion(text, Version(snapshot, imported.imports), imported, reading, told)

"""Compares sources with the last build, or with another version of them. Writes nothing, and locks nothing for writing.

Against the last build the answer is what a build would do: its changes, its plan. Another version is read as the
source itself is, with the files that it refers to as they are in that version.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync import changes, registry
from urdfsync.comparing import versions
from urdfsync.comparing.comparison import Comparison
from urdfsync.comparing.revisions import Revision
from urdfsync.comparing.subjects import Subject
from urdfsync.comparing.versions import Read, Source
from urdfsync.config import Config, RobotConfig, shown, templates_folder
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.difference import Effect, ElementKey, Version
from urdfsync.domain import Domain, Import, Role, Templates
from urdfsync.engine import imports, source
from urdfsync.engine.actions import Action, Actions, Kind
from urdfsync.engine.build import build
from urdfsync.engine.generate import Package, generate
from urdfsync.engine.inputs import NO_MODEL, inspect
from urdfsync.engine.options import BuildOptions
from urdfsync.files import Tree, digest, templates_digest, text_digest
from urdfsync.outcome import Result
from urdfsync.state.store import Store

_MINE = frozenset({Kind.CONFLICT, Kind.UNOWNED, Kind.MERGE, Kind.MOVE, Kind.LEAVE, Kind.INCLUDED, Kind.ORPHAN})
"""What happens to files that the user edited, and that the changes concern."""


def compare(
    subjects: Sequence[Subject], against: str | None, config: Config | None, request: BuildOptions, folder: Path
) -> Iterator[Comparison]:
    """Compare each subject with the last build, or with `against`: a file, counted from `folder`, or a git revision.

    One that fails does not stop the others. Without `against`, subjects must be robots of the configuration.
    """
    for count, subject in enumerate(subjects):
        request.progress(subject.name, count, len(subjects))
        try:
            if against is not None:
                yield _Versions(subject, config, request).compare(against, folder)
            elif config is not None and subject.robot is not None:
                yield _with_last_build(subject, subject.robot, config, request)
        except UrdfsyncError as error:
            result = Result(subject.name, subject.target.package, *_folders(subject, config), failed=True)
            failed = msgspec.structs.replace(result, diagnostics=error.diagnostics)
            yield Comparison(failed, shown(subject.source), against)


def _with_last_build(subject: Subject, robot: RobotConfig, config: Config, request: BuildOptions) -> Comparison:
    (result,) = build(config, [robot], msgspec.structs.replace(request, dry=True))
    comparison = Comparison(result, shown(subject.source))
    if result.failed:
        return comparison
    situation = inspect(config, robot, request)
    last, found = situation.last_complete, result.changes
    missing = "" if last else "what was built last is not known any more" if situation.recorded else "never built"
    edited = frozenset(action.path for action in result.actions.decided if action.kind in _MINE)
    comparison = msgspec.structs.replace(comparison, missing=missing, edited=edited)
    if last is None or found is None or not (found.changes or found.generator):
        return comparison
    name = shown(subject.source)
    new = Version(source.read(situation.domain, subject.options, situation.content, name)[0])
    try:
        effects = _effects(situation.domain, last, new, found.renames, subject)
    except NO_MODEL:
        return comparison  # what is recorded is no model of the domain
    return msgspec.structs.replace(comparison, effects=tuple(effects))


def _effects(
    domain: Domain, old: Version, new: Version, renames: Mapping[ElementKey, str], subject: Subject
) -> Sequence[Effect]:
    return [*domain.effects(old, new), *domain.interface(old, new, renames, subject.target, subject.options)]


class _Versions:
    """A subject and another version of it."""

    def __init__(self, subject: Subject, config: Config | None, request: BuildOptions) -> None:
        self._subject, self._request = subject, request
        self._domain = registry.domain(subject.domain)
        self._folder, self._root = _folders(subject, config)
        self._config = config
        store = Store(config.root, shown) if config and subject.robot else None
        self._state = store.load(subject.name) if store else None
        self._tree = Tree(subject.robot.output, shown) if subject.robot else None

    def compare(self, against: str, folder: Path) -> Comparison:
        """What changed from that version to the source as it is now."""
        subject, domain = self._subject, self._domain
        with tempfile.TemporaryDirectory(prefix="urdfsync-") as scratch:
            other = self._other(against, folder, Path(scratch))
            new = self._read(versions.from_file(subject.source), self._recorded())
            old = self._read(other, versions.known_from(new, self._copy))
        found = changes.compare(old.version, new.version, domain, subject.options)
        actions = self._actions(old.version, new.version) if found.changes else Actions()
        effects: Sequence[Effect] = ()
        if found.changes:
            effects = _effects(domain, old.version, new.version, found.renames, subject)
        said = {(known.code, known.message) for known in old.diagnostics}
        result = Result(
            subject.name,
            subject.target.package,
            self._folder,
            self._root,
            actions=actions,
            diagnostics=tuple(found for found in new.diagnostics if (found.code, found.message) not in said),
            changes=found if found.changes else None,
            dry=True,
        )
        edited = frozenset(action.path for action in actions.decided if self._is_edited(action.path))
        return Comparison(result, shown(subject.source), against, "", tuple(effects), edited)

    def _other(self, against: str, folder: Path, scratch: Path) -> Source:
        source, file = self._subject.source, folder / against
        if file.is_file():
            return versions.from_file(file, source)
        return versions.from_revision(Revision(source.parent, against), source, scratch)

    def _read(self, source: Source, known: imports.Recorded) -> Read:
        what, request = f"{self._subject.name}: imports", self._request
        return versions.read(
            self._domain,
            self._subject,
            source,
            request.package_paths,
            known,
            lambda done, total: request.progress(what, done, total),
        )

    def _recorded(self) -> imports.Recorded:
        """What the last build tells about imports, so that they need not be converted again."""
        state = self._state
        if state is None or state.model is None or not state.intact:
            return imports.Recorded({}, {}, lambda _target: None, lambda _target: None)
        records = state.manifest.dependencies
        return imports.Recorded(records, state.model.imports, self._copy, lambda _target: None)

    def _copy(self, target: str) -> bytes | None:
        return self._tree.read(self._folder / target) if self._tree else None

    def _actions(self, old: Version, new: Version) -> Actions:
        """What would happen to the files that differ, if nobody had edited any."""
        before, after = self._package(old), self._package(new)
        found = []
        differing = changes.stale(before.artifacts, after.artifacts)
        for path in differing.render | differing.gone:
            one, two = before.artifacts.get(path), after.artifacts.get(path)
            known = two or one
            if known is None or (one and two and before.content(path) == after.content(path)):
                continue
            kind = _kind(one is not None, two is not None)
            found.append(Action(self._key(path), kind, known.role, known.owner))
        for path in before.orders.keys() | after.orders.keys():
            if before.orders.get(path) != after.orders.get(path):
                kind = _kind(path in before.orders, path in after.orders)
                found.append(Action(self._key(path), kind, Role.ORDER, "package"))
        found += [
            Action(self._key(entry.target), kind, Role.IMPORT, key)
            for key, entry, kind in _imports(old.imports or {}, new.imports or {})
        ]
        return Actions(found)

    def _package(self, version: Version) -> Package:
        subject, config, domain = self._subject, self._config, self._domain
        if config is not None and subject.robot is not None:
            templates = source.templates(config, subject.robot, domain)
        else:
            folder = templates_folder(domain)
            templates = Templates((folder,), templates_digest([folder]))
        return generate(domain, version.snapshot, version.imports or {}, subject.target, subject.options, templates)

    def _key(self, path: str) -> str:
        return Path(os.path.relpath(self._folder / path, self._root)).as_posix()

    def _is_edited(self, path: str) -> bool:
        record = self._state.manifest.files.get(path) if self._state else None
        if record is None or record.base is None or self._tree is None:
            return False
        mine = self._tree.read(Path(os.path.normpath(self._root / path)))
        seen = digest if record.role is Role.IMPORT else text_digest
        return mine is not None and seen(mine) != record.base


def _kind(was: bool, now: bool) -> Kind:
    return Kind.UPDATE if was and now else Kind.CREATE if now else Kind.DELETE


def _imports(old: Mapping[str, Import], new: Mapping[str, Import]) -> Iterator[tuple[str, Import, Kind]]:
    for key, entry in new.items():
        if key not in old:
            yield key, entry, Kind.CREATE
        elif old[key].target_hash != entry.target_hash:
            yield key, entry, Kind.UPDATE
    yield from ((key, entry, Kind.DELETE) for key, entry in old.items() if key not in new)


def _folders(subject: Subject, config: Config | None) -> tuple[Path, Path]:
    """The package's folder, and the one that paths of files count from; of no place if there is no configuration."""
    if config is None or subject.robot is None:
        return Path(), Path()
    return subject.robot.folder, config.root

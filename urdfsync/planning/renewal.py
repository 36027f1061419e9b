"""The work for a robot of which something is new: its source is read again, and what is stale is rendered."""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Mapping

from urdfsync import profiling
from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.diff import changes
from urdfsync.diff.changes import Changes, StaleFiles
from urdfsync.domain import ElementKey, Role, Target, Version
from urdfsync.moves import places
from urdfsync.plan import FileRecord, State, Wanted
from urdfsync.planning import imports, inputs, leftovers, outdated
from urdfsync.planning.dangling import DanglingNames, lost_names
from urdfsync.planning.decide import Aim, Decision, decide
from urdfsync.planning.generate import Generated, artifacts
from urdfsync.planning.outputs import Outputs
from urdfsync.planning.recording import Recording
from urdfsync.planning.situation import NO_MODEL, Situation
from urdfsync.planning.work import Work


class Renewal:
    """One robot's source, imports, texts and plan; each step rests on those before it."""

    def __init__(self, situation: Situation) -> None:
        self._situation = situation
        robot = situation.robot
        self._snapshot, reading = inputs.read(
            situation.domain, robot.options, situation.content, shown(robot.source), situation.request.memory
        )
        self._said, self._lines = reading.diagnostics, reading.lines  # and not another snapshot
        self._said += inputs.check_options(situation.config, robot, situation.domain, self._snapshot)
        del reading
        self._imported = self._import()
        self.now = Version(self._snapshot, self._imported.imports, situation.generator.fingerprint)
        """The model as it is in the source, with what it imports."""
        self._before = self._last()  # first: it may be in the memory, where the next one takes its place
        self._generated = self._generate(self.now, situation.robot.target)
        self._differing = self._compared()
        self._outputs = self._known_outputs()

    def work(self) -> Work:
        """What there is to do."""
        situation = self._situation
        last, settled = situation.last, situation.settled
        found = self._changes(last)
        decision = self._decide(found.renames if found else {})
        found = found if settled is last else self._changes(settled)
        said = [*self._said, *self._imported.diagnostics, *situation.parents.diagnostics]
        said += [*self._moved(decision), *self._uses(decision), *self._lost_connectors(found)]
        said += outdated.findings(situation, decision.actions.decided)
        said.sort(key=lambda diagnostic: (diagnostic.file, diagnostic.line))
        news = found if found and (found.changes or found.generator) else None
        if situation.request.dry:
            return Work(decision, situation.store.witness(), diagnostics=tuple(said), changes=news)
        recording = Recording(situation, self._outputs, self._imported, self._snapshot, self.base)
        writes, emptied = recording.writes(decision)
        return Work(decision, situation.store.witness(), writes, emptied, tuple(said), recording.drawing(), news)

    @profiling.staged("meshes")
    def _import(self) -> imports.Imported:
        situation, state, name = self._situation, self._situation.state, self._situation.robot.name
        files = state.manifest.files if state else {}

        def base(target: str) -> str | None:
            record = files.get(situation.old_key(target))
            return record.base if record else None

        recorded = imports.Recorded(
            records=state.manifest.dependencies if state else {},
            facts=state.model.imports if state and state.model else {},
            copy=lambda target: situation.disk.read(situation.old_key(target)),
            base=base,
            moved=state is not None and state.manifest.folder != situation.folder,
        )
        return imports.bring_in(
            situation.domain,
            situation.dependencies(self._snapshot, self._lines),
            recorded,
            shown(situation.robot.source),
            situation.request.full,
            lambda done, total: situation.request.progress(f"{name}: imports", done, total),
        )

    def _generate(self, version: Version, target: Target) -> Generated:
        situation, options = self._situation, self._situation.robot.options
        make = situation.request.memory.artifacts if situation.request.memory else artifacts
        files = make(situation.domain, version.snapshot, version.imports or {}, target, options)
        return Generated(files, situation.templates)

    def _known_outputs(self) -> Outputs:
        situation = self._situation
        recorded, state = situation.recorded, situation.state
        same = recorded is not None and recorded.generator == situation.generator
        files = recorded.files if recorded else {}
        return Outputs(
            now=self._generated,
            last=self._before if same else None,
            differing=self._differing.render,
            record=lambda path: files.get(situation.old_key(path)),
            bases=situation.store.bases(situation.former or situation.robot.name),
            aside=state.model.bases if state and state.model else {},
            mine=lambda path: situation.disk.read(situation.old_key(path)),
            older=self._sides(),
            again=situation.request.full,
        )

    @profiling.staged("comparing")
    def _compared(self) -> StaleFiles:
        """The files that may be other than those of the last build, if templates and options are the same."""
        if self._before is None:
            # nothing can be told; of a first build, there are only new ones
            return StaleFiles(frozenset(), frozenset())
        return changes.stale_files(self._before.artifacts, self._generated.artifacts)

    def _last(self) -> Generated | None:
        """The package of the last build. Its texts are right only if the generator still is the same."""
        last, recorded = self._situation.last, self._situation.recorded
        if last is None or recorded is None:
            return None
        try:
            return self._generate(last, Target(recorded.package, recorded.class_))
        except NO_MODEL:
            return None  # what is recorded is no model of the domain

    def _sides(self) -> list[Generated]:
        """The packages of all models that could be saved of a state that can't be read."""
        recovered, recorded = self._situation.recovered, self._situation.recorded
        found = []
        for model in recovered.models.values() if recovered and recorded else ():
            with contextlib.suppress(*NO_MODEL):  # what is recorded is no model of the domain
                found.append(self._generate(self._situation.version(model), self._situation.robot.target))
        return found

    @profiling.staged("comparing")
    def _changes(self, since: Version | None) -> Changes | None:
        """What is new in the model since another version; None if nothing is known of that."""
        situation = self._situation
        if since is None:
            return None
        try:
            return changes.compare(since, self.now, situation.domain, situation.robot.options)
        except NO_MODEL:
            return None  # what is recorded is no model of the domain

    @profiling.staged("deciding")
    def _decide(self, renames: Mapping[ElementKey, str]) -> Decision:
        situation = self._situation
        key, prefix, digest = situation.key, situation.key(""), self._outputs.digest
        moves = self._moves(renames)
        stay = {} if moves or situation.recovered else self._staying()
        wanted = {
            place: Wanted(artifact.role, artifact.owner, digest(path))
            for path, artifact in self._generated.artifacts.items()
            if (place := prefix + path) not in stay
        }
        for name, entry in self._imported.imports.items():
            if (place := key(entry.target)) not in stay:
                at_hand = entry.target not in self._imported.hashes_only
                wanted[place] = Wanted(Role.IMPORT, name, entry.target_hash, at_hand)
        orders = {key(path): names for path, names in self._generated.orders.items()}
        folder = situation.robot.folder
        if folder.parent != situation.robot.output and situation.parents.listed:
            orders[situation.disk.key(folder.parent / "package.order")] = (folder.name,)
        aim = Aim(
            wanted,
            orders,
            situation.parents,
            situation.folder,
            stay,
            moves,
            situation.request.choices,
            situation.robot.merging,
        )
        hashes = {key: target.hash for key, target in wanted.items()} if situation.recovered else {}
        return decide(situation.disk, situation.rebuilt(hashes), aim, self)

    def _staying(self) -> dict[str, FileRecord]:
        """The plain records of files that are wanted as they are recorded, and whose texts are kept."""
        plain = self._situation.recorded.plain if self._situation.recorded else {}
        prefix, stale, kept = self._situation.key(""), self._outputs.stale, self._outputs.bases
        stay = {}
        for path, artifact in self._generated.artifacts.items():
            if path not in stale and (record := plain.get(prefix + path)) is not None:
                same = record.owner == artifact.owner and record.role is artifact.role
                if same and record.base in kept:
                    stay[prefix + path] = record
        for name, entry in self._imported.imports.items():
            wanted = FileRecord(name, Role.IMPORT, entry.target_hash)
            if plain.get(prefix + entry.target) == wanted:
                stay[prefix + entry.target] = wanted
        return stay

    def generated(self, key: str) -> str:
        """What would be written to a file of the plan."""
        return self._outputs.content(key.removeprefix(self._situation.key(""))).decode()

    def base(self, key: str, digest: str) -> str | None:
        """What was written last to a file of the last build, by its hash; None if that is lost.

        A file that the user has moved has its base under the path that it had.
        """
        files = self._situation.recorded.files if self._situation.recorded else {}
        keys = [key, *(other for other, record in files.items() if record.base == digest and other != key)]
        found = (self._outputs.base(self._old_path(other), digest) for other in keys)
        return next((text for text in found if text is not None), None)

    @functools.cached_property
    def _replaced(self) -> dict[str, str]:
        """Hashes of what was written last to files that get another text, or none; of records, only those that go."""
        recorded, now = self._situation.recorded, self._generated.artifacts
        if recorded is None or self._situation.recovered is not None:
            return {}
        found = {}
        for key, record in recorded.files.items():
            path = self._old_path(key)
            stays = path in now and (record.role is Role.RECORD or not self._is_new(path, record))
            is_text = record.role in (Role.MODEL, Role.RECORD, Role.PACKAGE) and record.state is not State.ORPHAN
            if is_text and not stays and record.base is not None:
                found[path] = record.base
        return found

    @functools.cached_property
    def _lost(self) -> dict[str, str]:
        """The names that the package loses, with their new names."""
        recorded, package = self._situation.recorded, self._situation.robot.target.package
        before = {path: self._outputs.base(path, digest) or "" for path, digest in self._replaced.items()}
        if recorded is None or not before:
            return {}
        records = {self._old_path(key): record for key, record in recorded.files.items()}
        changed = [path for path in self._generated.artifacts if self._is_new(path, records.get(path))]
        now = {path: self._outputs.content(path).decode() for path in changed}
        moved = {recorded.package.rpartition(".")[2]: package} if recorded.package != package else {}
        return {**lost_names(before, now, self._renamed(), self._dangling.is_inherited), **moved}

    def _is_new(self, path: str, record: FileRecord | None) -> bool:
        """Whether the text of a generated file can be another one than what was written last."""
        waits = record is None or record.state in (State.WAITING, State.CONFLICT)
        return waits or path in self._outputs.stale

    def _renamed(self) -> dict[str, str]:
        """Old and new identifiers of elements."""
        situation, settled, recorded = self._situation, self._situation.settled, self._situation.recorded
        if settled is None or recorded is None:
            return {}
        found = self._changes(settled)
        renames = found.renames if found else {}
        domain, target = situation.domain, Target(recorded.package, recorded.class_)
        try:
            old = recorded.names if settled is situation.last else domain.names(settled.snapshot, target)
        except NO_MODEL:
            return {}  # what is recorded is no model of the domain
        new = domain.names(self._snapshot, situation.robot.target)
        pairs = (
            (identifier, new.get(kind, {}).get(renames.get((kind.removesuffix("s"), name), name), identifier))
            for kind, identifiers in old.items()
            for name, identifier in identifiers.items()
        )
        return {before: after for before, after in pairs if before != after}

    @functools.cached_property
    def _dangling(self) -> DanglingNames:
        """Finds uses of the names that the package loses."""
        return DanglingNames(self._situation, list(self._generated.artifacts), self._outputs.content)

    def _lost_connectors(self, found: Changes | None) -> list[Diagnostic]:
        """Notes on what users may have connected to, and what has another name now, or none."""
        situation, settled = self._situation, self._situation.settled
        if settled is None or found is None or not found.is_structural:
            return []
        notes = []
        robot = situation.robot
        for one in situation.domain.interface(settled, self.now, found.renames, robot.target, robot.options):
            element, connector = one.path
            if one.old is not None:
                now = f"is now `{one.new}`" if one.new else "is gone"
                message = f"{element}: its {connector} `{one.old}` {now}"
                place = shown(situation.robot.source), self._lines.get(element, 0)
                notes.append(Diagnostic(Severity.NOTE, "connector-changed", message, *place, hint=one.hint))
        return notes

    def _uses(self, decision: Decision) -> list[Diagnostic]:
        """Warnings about texts of the user's that use names that the package loses."""
        if not self._replaced:
            return []
        texts = self._dangling.users_texts(decision.actions, decision.texts)  # parsing a large package takes longer
        said = self._dangling.left_out(texts, self._optional) if self._optional else []
        return said + (self._dangling.warnings(texts, self._lost) if texts and self._lost else [])

    @functools.cached_property
    def _optional(self) -> dict[str, str]:
        """The options that bring files which the package loses with this build, by their paths."""
        situation = self._situation
        recorded, options = situation.recorded, situation.robot.options
        if recorded is None:
            return {}
        target = Target(recorded.package, recorded.class_)
        gone = self._replaced.keys() - self._generated.artifacts.keys()
        found = {path: situation.domain.option_for(path, target, options) for path in sorted(gone)}
        return {path: option for path, option in found.items() if option}

    def lost_use(self, key: str, text: str) -> tuple[str, int] | None:
        """The first name in a text for a file that the package loses, with its line."""
        return self._dangling.first_use(key, text, self._lost) if self._lost else None

    def _old_path(self, key: str) -> str:
        """Path of a file of the last build below the folder that the package had then."""
        return key.removeprefix(self._situation.old_key(""))

    def _moves(self, renames: Mapping[ElementKey, str]) -> dict[str, str]:
        """New and old path of text files whose element has another name, or whose package another folder."""
        situation, recorded = self._situation, self._situation.recorded
        if recorded is None:
            return {}
        before, now = self._before.artifacts if self._before else {}, self._generated.artifacts
        given = self._identified_anew()
        alike = recorded.folder == situation.folder and not renames and not given and self._is_placed_alike()
        if alike and not any(record.origin for record in recorded.special.values()):
            return {}
        texts = {
            self._old_path(key): record
            for key, record in recorded.files.items()
            if record.role is not Role.IMPORT and record.state is not State.ORPHAN
        }
        old = {path: (a.owner, a.template) for path, a in before.items() if path in texts}
        old |= {path: (before[place].owner, before[place].template) for path, place in given.items()}
        renamed = changes.moved_files(old, {path: (a.owner, a.template) for path, a in now.items()}, renames)
        targets = {situation.old_key(path): situation.key(renamed.get(path, path)) for path in texts}
        return places(recorded.files, targets, {situation.key(path) for path in now})

    def _identified_anew(self) -> Mapping[str, str]:
        """Where the last model would have files today that an older program called otherwise, by their paths."""
        situation, last, recorded = self._situation, self._situation.last, self._situation.recorded
        if last is None or recorded is None or self._before is None:
            return {}
        names = situation.domain.names(last.snapshot, Target(recorded.package, recorded.class_))
        owners = {
            f"{kind.removesuffix('s')} {name}"
            for kind, identifiers in recorded.names.items()
            for name, identifier in identifiers.items()
            if names.get(kind, {}).get(name, identifier) != identifier
        }
        if not owners:
            return {}
        files = {self._old_path(key): (one.owner, str(one.role)) for key, one in recorded.files.items()}
        today = {path: (one.owner, str(one.role)) for path, one in self._before.artifacts.items()}
        return changes.moved_files({path: key for path, key in files.items() if key[0] in owners}, today, {})

    def _is_placed_alike(self) -> bool:
        """Whether every file of the last build still is one: of the same element, from the same template."""
        before, now = self._before.artifacts if self._before else {}, self._generated.artifacts
        pairs = ((before[path], now[path]) for path in self._differing.render if path in before)
        return not self._differing.gone and all(
            (new.owner, new.template) == (old.owner, old.template) for old, new in pairs
        )

    def _moved(self, decision: Decision) -> list[Diagnostic]:
        """What there is to say if robot or package had another name in the last build."""
        situation = self._situation
        place = shown(situation.config.file), situation.robot.lines[""]
        said = [leftovers.renamed(situation.former, situation.robot.name, *place)] if situation.former else []
        if situation.recovered:
            from urdfsync.state import repair

            said.append(repair.repaired(situation.recovered, situation.robot.name, shown(situation.store.folder)))
        if situation.recorded and situation.recorded.folder != situation.folder:
            actions = decision.actions
            said += leftovers.left_behind(situation.disk, situation.recorded, actions, situation.folder, *place)
        return said

"""What one build of a robot writes: files, conflict files, bases, model, and the manifest as the last one."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from pathlib import Path

import msgspec

from urdfsync.changes import Changes
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import Role
from urdfsync.engine.actions import CONFLICTS, DELETES, Action, Actions
from urdfsync.engine.conflicts import Conflict, conflict_files
from urdfsync.engine.decide import Decision
from urdfsync.engine.generation import Generation
from urdfsync.engine.package_files import PackageFiles, encode
from urdfsync.engine.parents import SharedFile
from urdfsync.files import shown, text_digest
from urdfsync.state import manifest, modelfile
from urdfsync.state.record import FileRecord, RecordState
from urdfsync.state.store import Store, Witness
from urdfsync.state.transaction import FileChange

_OLDER_BASE = (RecordState.CONFLICT, RecordState.WAITING, RecordState.ORPHAN)
"""States of files whose base is older than the recorded model, which can't give it back."""


class Plan(msgspec.Struct, frozen=True):
    """What one build of a robot does."""

    actions: Actions
    witness: Witness
    """Hashes of the recorded state that the plan rests on."""
    conflicts: tuple[Conflict, ...] = ()
    shared: tuple[SharedFile, ...] = ()
    """What to do with files around the package."""
    diagnostics: tuple[Diagnostic, ...] = ()
    changes: Changes | None = None
    """What is new in the model."""
    writes: tuple[FileChange, ...] = ()
    """The files to write, the manifest last; none in a dry run, unless it compares the recorded state."""
    emptied: tuple[Path, ...] = ()
    """The folders that are empty then, innermost first."""
    bases: Mapping[str, str] = {}
    """Texts to keep as bases that are not kept yet, by their hashes."""
    mentioned: frozenset[str] | None = None
    """Hashes of all bases that the manifest mentions then; None if others may be needed as well."""
    former_folder: str = ""
    """Key of the package's folder in the last build, if it has another one now."""
    former_name: str | None = None
    """The name that the robot had in the last build, if it has another one now."""
    drawing: Path | None = None
    """Path of the main model's diagram."""


def stage(generation: Generation, decision: Decision, diagnostics: tuple[Diagnostic, ...]) -> Plan:
    """Return the plan, with all that is to be written unless the run is dry."""
    inputs, files, robot = generation.inputs, generation.inputs.files, generation.inputs.robot
    store, former, news = inputs.store, inputs.former_name, generation.changes_since_complete
    if news and not (news.changes or news.generator):
        news = None
    plan = Plan(decision.actions, store.witness(), decision.conflicts, decision.shared, diagnostics, news)
    if inputs.options.dry and not inputs.options.compares_state:
        return plan
    changes = _file_changes(generation, decision)
    versions = (conflict_files(conflict, inputs.folder).values() for conflict in decision.conflicts)
    aside = {path: encode(text) for version in versions for path, text in version}
    changes += store.conflicts(robot.name, aside, former)

    drawing = None
    if inputs.options.draw:
        imports = generation.imported.imports
        picture = inputs.domain.drawing(generation.now.snapshot, imports, robot.target, robot.options)
        if picture is not None:
            drawing, more = store.drawing(robot.name, picture)
            changes += more

    bases: dict[str, str] = {}
    mentioned: frozenset[str] | None = None
    if inputs.old_folder != inputs.folder and any(action.held for action in decision.actions):
        # while something waits, the package can't move: its record stays, with the choices that the user made meanwhile
        recorded = inputs.recorded or inputs.heading("")
        chosen = {record.origin: record for record in decision.files.values() if record.origin and record.choice}
        renewed = {
            key: msgspec.structs.replace(record, choice=chosen[key].choice, chosen_for=chosen[key].chosen_for)
            for key, record in recorded.files.items()
            if key in chosen
        }
        text = manifest.dumps(msgspec.structs.replace(recorded, files={**recorded.files, **renewed}))
        changes += store.changes(robot.name, text, None, None)
    else:
        changes += store.changes(robot.name, *_recorded_texts(generation, decision), former)
        kept = store.bases(robot.name)
        mentioned = frozenset(r.base for r in decision.files.values() if r.role is not Role.IMPORT and r.base)
        new = {key: record for key, record in decision.files.items() if record.base not in kept}
        bases = {base: text for _, base, text in _base_texts(generation, new)}

    above, conflicts = files.path(inputs.old_folder).parent, store.folder / "conflicts"
    folders = {folder for change in changes if change.content is None for folder in change.path.parents}
    emptied = [one for one in folders if above in one.parents or conflicts in (one, *one.parents)]
    return msgspec.structs.replace(
        plan,
        witness=store.witness(),  # again: more of the recorded state has been read since
        writes=tuple(changes),
        emptied=tuple(sorted(emptied, key=lambda folder: len(folder.parts), reverse=True)),
        bases=bases,
        mentioned=mentioned,
        former_folder=inputs.old_folder if inputs.old_folder != inputs.folder else "",
        former_name=former,
        drawing=drawing,
    )


def _file_changes(generation: Generation, decision: Decision) -> list[FileChange]:
    """Return the changes of the package's files, but for those in which other robots may have a part."""
    files, found = generation.inputs.files, []
    shared = {files.key(file.path) for file in decision.shared}
    for action in decision.actions:
        if action.writes and action.path not in shared:
            content = None if action.kind in DELETES else _content(generation, decision, action)
            is_moved = action.origin is not None and action.path in decision.texts
            state = files.state(action.path)
            found.append(FileChange(files.path(action.path), content, state.sha256 if state else None, is_moved))
    return found


def partly_done(
    plan: Plan, robot: str, not_done: Collection[Path], store: Store, files: PackageFiles
) -> list[FileChange]:
    """Return how to record a plan of which some files are not as planned, since somebody saved one in between.

    Those keep the records that they had, as conflicts. So the next plan compares them with what was written there
    before, and all others with what this plan wrote.
    """
    path, last = store.paths(robot)[0], store.load(plan.former_name or robot)
    state = {change.path: change for change in plan.writes if change.path.parent == path.parent}
    if path not in state:
        return []
    new = manifest.loads((state[path].content or b"").decode(), shown(path))
    old_files, old_orders = (last.manifest.files, last.manifest.orders) if last else ({}, {})
    left = {files.key(one) for one in not_done}
    records = {key: record for key, record in new.files.items() if key not in left}
    for key in left & old_files.keys():
        record = old_files[key]
        records[key] = msgspec.structs.replace(record, state=RecordState.CONFLICT) if key in new.files else record
    orders = {key: names for key, names in new.orders.items() if key not in left}
    orders |= {key: names for key, names in old_orders.items() if key in left}
    source = msgspec.structs.replace(new.source, hash="")  # so that the next build generates everything
    text = manifest.dumps(msgspec.structs.replace(new, files=records, orders=orders, source=source))
    return list({**state, path: msgspec.structs.replace(state[path], content=text.encode())}.values())


def _content(generation: Generation, decision: Decision, action: Action) -> bytes:
    key, files = action.path, generation.inputs.files
    if key in decision.texts:
        return encode(decision.texts[key])
    if action.role is Role.IMPORT:
        content = generation.imported.contents.get(generation.inputs.path(key))
        if content is None:  # its copy was to serve, and has changed since
            message, file = "it changed while urdfsync looked at it", shown(files.path(key))
            raise OutputError(Diagnostic(Severity.ERROR, "restless", message, file, hint="build again"))
        return content
    generated = generation.content(key)
    state = files.state(key)
    mine = (files.read(key) or b"") if state and state.sha256 != state.text_sha256 else b""
    return generated.replace(b"\n", b"\r\n") if 2 * mine.count(b"\r\n") > mine.count(b"\n") else generated


def _recorded_texts(generation: Generation, decision: Decision) -> tuple[str, str]:
    """Return the texts of manifest and model."""
    inputs, snapshot = generation.inputs, generation.now.snapshot
    waits = any(action.held or action.kind in CONFLICTS for action in decision.actions)
    since = inputs.last_complete.snapshot if waits and inputs.last_complete else None
    before = inputs.complete_revision if since else None
    revision = msgspec.UNSET if before in (None, inputs.domain.revision) else before
    below = inputs.key("")
    older = {k: r for k, r in decision.files.items() if r.state in _OLDER_BASE and k.startswith(below)}
    bases = {inputs.path(key): text for key, _, text in _base_texts(generation, older)}
    model = modelfile.of(snapshot, generation.imported.imports, bases, since, revision, decision.gone, decision.left)
    model_text = modelfile.dumps(model)
    whole = msgspec.structs.replace(
        inputs.heading(text_digest(model_text.encode())),
        names=inputs.domain.names(snapshot, inputs.robot.target),
        dependencies=generation.imported.records,
        orders=decision.orders,
        files=decision.files,
    )
    text = manifest.dumps(whole)
    return text, model_text


def _base_texts(generation: Generation, records: Mapping[str, FileRecord]) -> Iterator[tuple[str, str, str]]:
    """Yield key, hash and text of the base of each recorded text file, as far as they are not lost."""
    for key, record in records.items():
        if record.role is not Role.IMPORT and record.base is not None:
            origin = record.origin or key
            path = generation.inputs.path(origin)
            is_generated = path in generation.package.artifacts and generation.hash(path) == record.base
            text = generation.content(origin).decode() if is_generated else generation.base(origin, record.base)
            if text is not None:
                yield key, record.base, text

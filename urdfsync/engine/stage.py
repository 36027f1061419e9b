"""What one build of a robot writes: files, conflict files, bases, and the record as the last one."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import msgspec

from urdfsync.changes import Changes
from urdfsync.dependencies import is_file
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import Role
from urdfsync.engine.actions import DELETES, USERS, Action, Actions, Kind
from urdfsync.engine.conflicts import Conflict, conflict_files
from urdfsync.engine.decide import Decision
from urdfsync.engine.generation import Generation
from urdfsync.engine.inputs import option_values
from urdfsync.engine.package_files import encode
from urdfsync.engine.parents import SharedFile
from urdfsync.engine.rules import files_after, pending_choices, renewed_files
from urdfsync.engine.undo import put_aside
from urdfsync.files import shown
from urdfsync.state import replaced
from urdfsync.state.record import RESOURCES, Choice, FileRecord, Open, Record, role_of
from urdfsync.state.store import BASE, CONFLICTS, REPLACED, Witness
from urdfsync.state.transaction import FileChange


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
    """The files to write, the record last; none in a dry run, unless it compares the recorded state."""
    emptied: tuple[Path, ...] = ()
    """The folders that are empty then, innermost first."""
    is_broken: bool = False
    """Whether a file of the package that the user edited does not fit it, or is no Modelica."""
    stale: tuple[str, ...] = ()
    """What has changed since the source was expanded, which it was not again."""
    drawing: Path | None = None
    """Path of the main model's diagram."""


def stage(generation: Generation, decision: Decision, diagnostics: tuple[Diagnostic, ...]) -> Plan:
    """Return the plan, with all that is to be written unless the run is dry."""
    inputs, files, robot = generation.inputs, generation.inputs.files, generation.inputs.robot
    store, former, news = inputs.store, inputs.former_name, generation.changes
    if news and not (news.changes or news.generator):
        news = None
    plan = Plan(decision.actions, store.witness(), decision.conflicts, decision.shared, diagnostics, news)
    is_broken = any(one.is_broken for one in decision.misfits)
    plan = msgspec.structs.replace(plan, stale=inputs.source.stale, is_broken=is_broken)
    if inputs.options.dry and not inputs.options.compares_state:
        return plan
    record = _record(generation, decision)
    changes = _file_changes(generation, decision, record.files if record else {})
    versions = (conflict_files(conflict, inputs.folder).values() for conflict in decision.conflicts)
    aside = {path: encode(text) for version in versions for path, text in version}
    changes += store.fill(CONFLICTS, robot.name, aside, former)
    changes += store.fill(BASE, robot.name, _bases(generation, decision, record) if record else {}, former)
    before = put_aside(generation, decision.actions, decision.texts) if record else {}
    changes += store.fill(REPLACED, robot.name, replaced.contents(before), former)

    drawing = None
    if inputs.options.draw:
        imports = generation.imported.imports
        picture = inputs.domain.drawing(generation.now.snapshot, imports, robot.target, robot.options)
        if picture is not None:
            drawing, more = store.drawing(robot.name, picture)
            changes += more

    if record and not inputs.source.stale:
        changes += store.save_expansion(robot.name, inputs.source.expansion)
    changes += store.changes(robot.name, record, former)
    above = {files.path(inputs.old_folder).parent, store.folder}
    folders = {folder for change in changes if change.content is None for folder in change.path.parents}
    emptied = [one for one in folders if not above.isdisjoint(one.parents)]
    return msgspec.structs.replace(
        plan,
        witness=store.witness(),  # again: more of the recorded state has been read since
        writes=tuple(changes),
        emptied=tuple(sorted(emptied, key=lambda folder: len(folder.parts), reverse=True)),
        drawing=drawing,
    )


def _record(generation: Generation, decision: Decision) -> Record | None:
    """Return the record after a build; None for a robot that is removed."""
    if generation.inputs.options.removes:
        return None
    return _complete_record(generation, decision) if decision.is_complete else _open_record(generation, decision)


def _file_changes(generation: Generation, decision: Decision, recorded: Mapping[str, FileRecord]) -> list[FileChange]:
    """Return the changes of the package's files, but for those in which other robots may have a part.

    `recorded` are the records of the files afterwards.
    """
    files, found = generation.inputs.files, []
    shared = {files.key(file.path) for file in decision.shared}
    for action in decision.actions:
        if action.writes and action.path not in shared:
            content = None if action.kind in DELETES else _content(generation, decision, action)
            is_moved = action.origin is not None and action.path in decision.texts
            state = files.state(action.path)
            old, file = state.sha256 if state else None, recorded.get(action.path)
            found.append(FileChange(files.path(action.path), content, old, is_moved, file))
    return found


def _content(generation: Generation, decision: Decision, action: Action) -> bytes:
    key, files = action.path, generation.inputs.files
    if key in decision.texts:
        return encode(decision.texts[key])
    if action.role is Role.IMPORT:
        content = generation.imported.contents.get(generation.inputs.path(key))
        if content is None:
            message, file = "it can't be written: the file that it is imported from is missing", shown(files.path(key))
            hint = "restore that file, or the imported copy"
            raise OutputError(Diagnostic(Severity.ERROR, "no-source", message, file, hint=hint))
        return content
    generated = generation.content(key)
    state = files.state(key)
    mine = (files.read(key) or b"") if state and state.sha256 != state.text_sha256 else b""
    return generated.replace(b"\n", b"\r\n") if 2 * mine.count(b"\r\n") > mine.count(b"\n") else generated


def _complete_record(generation: Generation, decision: Decision) -> Record:
    """Return the record of a build after which nothing is open."""
    inputs, texts = generation.inputs, dict[str, str]()
    inside = inputs.key("")
    old = {
        key: one for key, one in inputs.recorded_files.items() if not one.is_users or is_file(inputs.files.path(key))
    }
    files = files_after(decision.actions, old)
    for action in decision.actions:
        is_left = action.kind in (Kind.ORPHAN, Kind.NEEDED)
        if is_left and action.path.startswith(inside) and action.role is not Role.IMPORT:
            for base in files[action.path].hashes:
                if (text := generation.base(action.origin or action.path, base)) is not None:
                    texts[base] = text
    return Record(
        package=inputs.robot.target.package,
        class_=inputs.robot.target.name,
        folder=inputs.folder,
        generator=inputs.generator,
        options=option_values(inputs.robot.options),
        snapshots=(generation.now.snapshot,),
        imports={key: (one,) for key, one in generation.imported.imports.items()},
        files={key: one for key, one in files.items() if key.startswith(inside)},
        texts=texts,
    )


def _open_record(generation: Generation, decision: Decision) -> Record:
    """Return the record of the last complete build, with the bases that this build has renewed, and what is open."""
    inputs, inside = generation.inputs, generation.inputs.key("")
    record = inputs.record or Record(
        package=inputs.robot.target.package,
        class_=inputs.robot.target.name,
        folder=inputs.folder,
        generator=inputs.generator,
        options=option_values(inputs.robot.options),
    )
    renewed = {} if inputs.has_moved else renewed_files(decision.actions)
    renewed = {key: one for key, one in renewed.items() if key.startswith(inside) and record.files.get(key) != one}
    files = {**record.files, **renewed}
    imported = inputs.key(RESOURCES)
    texts = {one.hashes[0]: generation.content(key).decode() for key, one in renewed.items() if imported not in key}
    hashes = {sha256 for file in files.values() for sha256 in file.hashes}
    texts = {sha256: text for sha256, text in {**record.texts, **texts}.items() if sha256 in hashes}
    known = record.open.imports if record.open else {}
    imports = {
        key: one
        for key, one in generation.imported.imports.items()
        if files.get(inputs.key(one.target)) == FileRecord((one.target_hash,)) and record.imports.get(key) != (one,)
    }
    choices = {(inputs.path(key), sides): one for (key, sides), one in pending_choices(decision.actions).items()}
    edited = {
        inputs.path(one.path): decision.texts[one.path]
        for one in decision.actions
        if one.held and one.choice is Choice.EDIT and one.path in decision.texts
    }
    seen = generation.now.snapshot
    open_ = Open(choices, seen, generation.recognised_renames, edited, {**known, **imports})
    return msgspec.structs.replace(record, files=files, texts=texts, open=open_)


def _bases(generation: Generation, decision: Decision, record: Record) -> dict[str, bytes]:
    """Return the bases of edited files by their hashes, as far as they are not lost: templates may change."""
    inputs, found = generation.inputs, dict[str, bytes]()
    for action in decision.actions:
        if not (action.kind in USERS or (action.held and action.choice)):
            continue
        key = action.path if action.writes else action.origin or action.path
        text_after = (action.result or action.generated) if action.writes else action.mine
        if key not in record.files or text_after in record.files[key].hashes:
            continue
        path = key.removeprefix(f"{record.folder}/")
        for sha256 in record.files[key].hashes if role_of(path) is not Role.IMPORT else ():
            text = generation.base(key, sha256)
            if text is None and path in generation.package.artifacts and generation.hash(path) == sha256:
                text = generation.content(inputs.key(path)).decode()
            if text is not None and sha256 not in record.texts:
                found[sha256] = encode(text)
    return found

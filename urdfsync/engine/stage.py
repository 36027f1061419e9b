"""What one build of a robot writes: files, conflict files, bases, and the record as the last one."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import msgspec

from urdfsync.changes import Changes
from urdfsync.dependencies import is_file
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import ChangeClass, Role
from urdfsync.engine.actions import Action, Actions, Kind
from urdfsync.engine.conflicts import Conflict, conflict_files
from urdfsync.engine.decide import Decision
from urdfsync.engine.generation import Generation
from urdfsync.engine.inputs import option_values
from urdfsync.engine.package_files import encode, text_hash
from urdfsync.engine.parents import SharedFile
from urdfsync.engine.rules import files_after, pending_choices, renewed_files
from urdfsync.engine.undo import put_aside
from urdfsync.files import shown
from urdfsync.state import replaced
from urdfsync.state.bases import DIGITS
from urdfsync.state.record import Choice, FileRecord, Open, Record
from urdfsync.state.replaced import Replaced
from urdfsync.state.store import CONFLICTS, REPLACED, Witness
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
    """The files to write but for the shared ones, the record last."""
    is_noop: bool = False
    """The build writes nothing that version control has: no file of the package, and no recorded state."""
    emptied: tuple[Path, ...] = ()
    """The folders that are empty then, innermost first."""
    is_broken: bool = False
    """Whether a file of the package that the user edited does not fit it, or is no Modelica."""
    stale: tuple[str, ...] = ()
    """What has changed since the source was expanded, which it was not again."""
    drawing: Path | None = None
    """Path of the main model's diagram."""


def stage(generation: Generation, decision: Decision, diagnostics: tuple[Diagnostic, ...]) -> Plan:
    """Return the plan with all that is to be written, in a dry run, too: one plan has one verdict."""
    inputs, files, robot = generation.inputs, generation.inputs.files, generation.inputs.robot
    store, former, news = inputs.store, inputs.former_name, generation.changes
    if news and not (news.changes or news.generator):
        news = None
    plan = Plan(decision.actions, store.witness(), decision.conflicts, decision.shared, diagnostics, news)
    is_broken = any(one.is_broken for one in decision.misfits)
    plan = msgspec.structs.replace(plan, stale=inputs.source.stale, is_broken=is_broken)
    record = _record(generation, decision)
    files_changed = _file_changes(generation, decision, record.files if record else {})
    versions = (conflict_files(conflict, inputs.folder).values() for conflict in decision.conflicts)
    aside = {path: encode(text) for version in versions for path, text in version}
    changes = store.fill(CONFLICTS, robot.name, aside, former)
    before = put_aside(generation, decision.actions, decision.texts, decision.moved) if record else {}
    changes += store.fill(REPLACED, robot.name, replaced.contents(before), former)

    drawing = None
    if inputs.options.draw:
        imports = generation.imported.imports
        picture = inputs.domain.drawing(generation.now.snapshot, imports, robot.target, robot.options)
        if picture is not None:
            drawing, more = store.drawing(robot.name, picture)
            changes += more

    state = _base_changes(generation, decision, record, before)
    if record and not inputs.source.stale:
        state += store.save_expansion(robot.name, inputs.source.expansion)
    state += store.changes(robot.name, record, former)
    changes = [*files_changed, *changes, *state]
    above = {files.path(inputs.old_folder).parent, store.folder}
    folders = {folder for change in changes if change.content is None for folder in change.path.parents}
    emptied = [one for one in folders if not above.isdisjoint(one.parents)]
    return msgspec.structs.replace(
        plan,
        witness=store.witness(),  # again: more of the recorded state has been read since
        writes=tuple(changes),
        is_noop=not state and not any(action.writes for action in decision.actions),
        emptied=tuple(sorted(emptied, key=lambda folder: len(folder.parts), reverse=True)),
        drawing=drawing,
    )


def _record(generation: Generation, decision: Decision) -> Record | None:
    """Return the record after a build; None for a robot that is removed."""
    if generation.inputs.options.removes:
        return None
    if not decision.is_complete:
        return _open_record(generation, decision)
    record = _complete_record(generation, decision)
    old = generation.inputs.record
    return old if old is not None and _serves(old, record, generation) else record


def _serves(old: Record, new: Record, generation: Generation) -> bool:
    """Return whether all later decisions are the same with the record that is there.

    What no file of the package says is not worth a commit: extensions that nothing models, options without effect.
    """
    changes = generation.changes
    if old.open or old.is_united or old.snapshot is None or changes is None:
        return False
    is_said = any(change.change_class.rank > ChangeClass.UNMODELLED.rank for change in changes.changes)
    like_old = msgspec.structs.replace(new, snapshot=old.snapshot, options=old.options, generator=old.generator)
    return not is_said and like_old == old


def _file_changes(generation: Generation, decision: Decision, recorded: Mapping[str, FileRecord]) -> list[FileChange]:
    """Return the changes of the package's files, but for those in which other robots may have a part.

    `recorded` are the records of the files afterwards.
    """
    files, found = generation.inputs.files, []
    shared = {files.key(file.path) for file in decision.shared}
    for action in decision.actions:
        if action.writes and action.path not in shared:
            content = None if action.kind is Kind.DELETE else _content(generation, decision, action)
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
    inputs = generation.inputs
    inside = inputs.key("")
    old = {
        key: one for key, one in inputs.recorded_files.items() if not one.is_users or is_file(inputs.files.path(key))
    }
    files = files_after(decision.actions, old)
    return Record(
        package=inputs.robot.target.package,
        class_=inputs.robot.target.name,
        folder=inputs.folder,
        generator=inputs.generator,
        options=option_values(inputs.robot.options),
        snapshot=generation.now.snapshot,
        imports={key: (one,) for key, one in generation.imported.imports.items()},
        files={key: one for key, one in files.items() if key.startswith(inside)},
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
    return msgspec.structs.replace(record, files=files, open=open_)


def _base_changes(
    generation: Generation, decision: Decision, record: Record | None, aside: Mapping[str, Replaced]
) -> list[FileChange]:
    """Return how the texts that the record mentions get to the bases, and how old ones go.

    Looked at are the files of bases for new hashes, and those that are not there; all in a full build, and where git
    has united states. Once no state mentions a text, neither the record before nor the one after, it goes when its file
    is written; that alone is no reason to write it.
    """
    inputs, store, name = generation.inputs, generation.inputs.store, generation.inputs.robot.name
    if record is None:
        names = {name, inputs.last_name}
        return [one for robot in names for digit in DIGITS for one in store.save_bases(robot, digit, None)]
    before = [*(inputs.record.files if inputs.record else {}).values(), *inputs.written.values()]
    old = {sha256 for file in before if file for sha256 in file.hashes}
    new = {sha256: key for key, file in record.files.items() for sha256 in file.hashes}
    is_whole = inputs.options.full or inputs.former_name or inputs.record is None or inputs.record.is_united
    renewed = {sha256[0] for sha256 in new.keys() - old} | store.missing_bases(name)
    needed = {*old, *new, *(text_hash(one.base) for one in aside.values() if one.is_users and one.base)}
    found = list[FileChange]()
    for digit in DIGITS if is_whole else sorted(renewed):
        texts = dict(store.bases(inputs.last_name, digit))
        for sha256 in [one for one in new if one[0] == digit and one not in texts]:
            path = inputs.path(new[sha256])
            if path in generation.package.artifacts and generation.package.hash(path) == sha256:
                texts[sha256] = generation.package.content(path).decode()
        if decision.is_complete and store.save_bases(name, digit, texts):
            texts = {sha256: text for sha256, text in texts.items() if sha256 in needed}
        found += store.save_bases(name, digit, texts)
        if inputs.former_name:
            found += store.save_bases(inputs.former_name, digit, None)
    return found

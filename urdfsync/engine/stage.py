"""The plan of one robot with all its writes: files, conflict files, bases, and the record as the last one."""

from __future__ import annotations

from pathlib import Path

import msgspec

from urdfsync.diagnostics import Diagnostic, OutputError
from urdfsync.domain import ChangeClass, Role
from urdfsync.engine.actions import Action
from urdfsync.engine.conflicts import conflict_files
from urdfsync.engine.decide import Decision
from urdfsync.engine.generation import Generation
from urdfsync.engine.last_build import option_values
from urdfsync.engine.package_files import encode, text_hash
from urdfsync.engine.parents import SharedFile
from urdfsync.engine.result import Result
from urdfsync.engine.rules import files_after, pending_choices
from urdfsync.engine.undo import put_aside
from urdfsync.files import shown
from urdfsync.state import bases, expansion, statefile
from urdfsync.state.bases import DIGITS
from urdfsync.state.record import FileRecord, Open, Record
from urdfsync.state.store import PutAside, StateHashes
from urdfsync.state.transaction import FileChange


class Plan(msgspec.Struct, frozen=True):
    """All that one build of a robot writes, and its result once that is done."""

    result: Result
    state: StateHashes
    """Hashes of the recorded state that the plan rests on."""
    shared: tuple[SharedFile, ...] = ()
    """Changes of files around the package."""
    writes: tuple[FileChange, ...] = ()
    """The files to write but for the shared ones, the record last."""
    emptied: tuple[Path, ...] = ()
    """The folders that are empty then, innermost first."""


def stage(generation: Generation, decision: Decision, diagnostics: tuple[Diagnostic, ...]) -> Plan:
    """Return the plan with all that is to be written, in a dry run, too: one plan has one verdict."""
    inputs, store, robot = generation.inputs, generation.inputs.store, generation.inputs.robot
    record = None if inputs.options.removes else _record(generation, decision)
    aside = put_aside(generation, decision.actions, decision.texts, decision.disputed) if record else PutAside()
    changes = _file_changes(generation, decision)
    is_writing = any(action.writes for action in decision.actions)

    drawing = None
    if inputs.options.draw:
        imports = generation.imported.imports
        picture = inputs.domain.drawing(generation.now.snapshot, imports, robot.target, robot.options)
        if picture is not None:
            drawing = store.drawing(robot.name)
            changes += store.save(drawing, picture.encode())

    names = {inputs.last.name} - {robot.name} if record else {inputs.last.name, robot.name}
    state = [change for name in names for change in store.remove(name)]
    if record:
        state += store.for_git()
        versions = [conflict_files(conflict, inputs.folder).values() for conflict in decision.conflicts]
        texts = {path: encode(text) for version in versions for path, text in version}
        changes += store.save_conflicts(robot.name, texts)
        changes += store.save_aside(robot.name, aside)
        expanded = inputs.source.expansion
        if not inputs.source.stale:
            state += store.save(store.expansion(robot.name), expansion.dumps(expanded) if expanded else None)
        recorded = store.save(store.path(robot.name), statefile.dumps(record).encode())
        state += _base_changes(generation, decision, record, aside, is_writing=is_writing or bool(state or recorded))
        state += recorded
    changes += state
    above = {inputs.files.path(inputs.last.folder).parent, store.folder}
    folders = {folder for change in changes if change.content is None for folder in change.path.parents}
    emptied = [folder for folder in folders if not above.isdisjoint(folder.parents)]
    news, writes = generation.changes, bool(state or is_writing)
    if news and not writes and decision.is_complete:
        # the record keeps the old generator and options then, so that each later plan would tell them again
        news = msgspec.structs.replace(news, generator=False, options=())
    emptied.sort(key=lambda folder: len(folder.parts), reverse=True)
    result = Result(
        robot.name,
        robot.target.package,
        robot.folder,
        inputs.config.root,
        decision.actions,
        diagnostics,
        dry=inputs.options.dry,
        writes=writes,
        stale=inputs.source.stale,
        is_broken=any(misfit.is_broken for misfit in decision.misfits),
        drawing=drawing,
        changes=news if news and (news.changes or news.generator) else None,
        conflict_texts=decision.conflicts,
    )
    return Plan(result, store.hashes(), decision.shared, tuple(changes), tuple(emptied))


def _record(generation: Generation, decision: Decision) -> Record:
    """Return the record after a build."""
    inputs, old, news = generation.inputs, generation.inputs.last.record, generation.changes
    imports, inside = generation.imported.imports, inputs.folder.key("")
    if not decision.is_complete:
        # the model stays that of the last complete build; what is renewed counts, but in a former folder
        files = {} if inputs.has_moved else files_after(decision.actions, old.files, is_complete=False)
        files = {**old.files} | {key: file for key, file in files.items() if key.startswith(inside)}
        renewed = {
            key: (*old.imports.get(key, ()), entry)
            for key, entry in imports.items()
            if files.get(inputs.folder.key(entry.target)) == FileRecord((entry.target_hash,))
            and entry not in old.imports.get(key, ())
        }
        choices = pending_choices(decision.actions, decision.texts)
        choices = {inputs.folder.path(key): choice for key, choice in choices.items()}
        open_ = Open(choices, generation.now.snapshot, generation.recognised_renames)
        return msgspec.structs.replace(old, files=files, imports={**old.imports, **renewed}, open=open_)
    files = files_after(decision.actions, inputs.last.files, is_complete=True)
    new = Record(
        package=inputs.robot.target.package,
        class_=inputs.robot.target.name,
        folder=str(inputs.folder),
        generator=inputs.generator,
        options=option_values(inputs.robot.options),
        snapshot=generation.now.snapshot,
        imports={key: (entry,) for key, entry in imports.items()},
        files={key: file for key, file in files.items() if key.startswith(inside)},
    )
    if news is None or any(change.change_class.rank > ChangeClass.UNMODELLED.rank for change in news.changes):
        return new
    # not worth a commit is what no file of the package says: extensions that nothing models, options without effect
    silent = msgspec.structs.replace(new, snapshot=old.snapshot, options=old.options, generator=old.generator)
    return old if silent == old else new


def _file_changes(generation: Generation, decision: Decision) -> list[FileChange]:
    """Return the changes of the package's files, but for those in which other robots may have a part."""
    files, changes = generation.inputs.files, []
    shared = {files.key(file.path) for file in decision.shared}
    for action in decision.actions:
        if action.writes and action.path not in shared:
            content = None if action.is_deletion else _content(generation, decision, action)
            is_moved = action.origin is not None and action.path in decision.texts
            state = files.state(action.path)
            old = state.sha256 if state else None
            changes.append(FileChange(files.path(action.path), content, old, is_moved))
    return changes


def _content(generation: Generation, decision: Decision, action: Action) -> bytes:
    key, files = action.path, generation.inputs.files
    if key in decision.texts:
        return encode(decision.texts[key])
    path = generation.inputs.folder.path(key)
    if action.role is Role.IMPORT:
        content = generation.imported.contents.get(path)
        if content is None:
            message, file = "it can't be written: the file that it is imported from is missing", shown(files.path(key))
            hint = "restore that file, or the imported copy"
            raise OutputError.of("no-source", message, file, hint=hint)
        return content
    generated, state = generation.package.content(path), files.state(key)
    mine = (files.read(key) or b"") if state and state.sha256 != state.text_sha256 else b""
    return generated.replace(b"\n", b"\r\n") if 2 * mine.count(b"\r\n") > mine.count(b"\n") else generated


def _base_changes(
    generation: Generation, decision: Decision, record: Record, aside: PutAside, *, is_writing: bool
) -> list[FileChange]:
    """Return how the texts that the record mentions get to the bases, and how old ones go.

    A text that is missing or damaged is written if it is generated now. One that no state mentions any more, neither
    the record before nor the one after, goes with a complete build that writes something: alone it is no reason.
    """
    inputs, last = generation.inputs, generation.inputs.last
    old = {sha256 for file in last.record.files.values() for sha256 in file.hashes}
    new = {sha256: key for key, file in record.files.items() for sha256 in file.hashes}
    # what was replaced can be merged again
    needed = {*old, *new, *(text_hash(text.base) for text in aside.texts.values() if text.base)}
    stored = {digit: inputs.store.bases(last.name, digit) for digit in DIGITS}
    missing = dict[str, str]()
    for sha256 in new.keys() - {sha256 for texts in stored.values() for sha256 in texts or ()}:
        path = inputs.folder.path(new[sha256])
        if path in generation.package.artifacts and generation.package.hash(path) == sha256:
            missing[sha256] = generation.package.content(path).decode()
    cleans = decision.is_complete and (is_writing or bool(missing))
    # git may have united lines, which have an order
    is_whole = inputs.options.full or inputs.former_name or last.record.is_united
    changes = list[FileChange]()
    for digit, texts in stored.items():
        after = {sha256: text for sha256, text in (texts or {}).items() if not cleans or sha256 in needed}
        after |= {sha256: text for sha256, text in missing.items() if sha256[0] == digit}
        if is_whole or texts is None or after.keys() != texts.keys():
            changes += inputs.store.save(inputs.store.base_file(inputs.robot.name, digit), bases.dumps(after))
    return changes

"""The plan of one robot with all its writes: files, conflict files, bases, and the record as the last one."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import msgspec

from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import ChangeClass, Role
from urdfsync.engine.actions import Action, Actions, Reason
from urdfsync.engine.aside import put_aside
from urdfsync.engine.decide import Decision
from urdfsync.engine.generation import Generation
from urdfsync.engine.last_build import import_hash, option_values
from urdfsync.engine.package_files import PackageFiles, encode, with_line_ends
from urdfsync.engine.package_names import renamed_identifiers
from urdfsync.engine.parents import SharedFile
from urdfsync.engine.proposals import save_versions
from urdfsync.engine.result import Result
from urdfsync.engine.rules import files_after
from urdfsync.engine.settle import Settled, actions_after
from urdfsync.engine.source import expansion_hash
from urdfsync.files import shown
from urdfsync.spelling import counted
from urdfsync.state import bases, expansion, statefile
from urdfsync.state.bases import DIGITS
from urdfsync.state.notes import Notes
from urdfsync.state.record import FileRecord, Open, Record
from urdfsync.state.store import Aside, StateHashes
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
    notes: Notes | None = None
    """What this machine knows then, if that is something new."""


def stage(generation: Generation, decision: Decision, diagnostics: tuple[Diagnostic, ...], settled: Settled) -> Plan:
    """Return the plan with all that is to be written, in a dry run, too: one plan has one verdict."""
    inputs, store, robot = generation.inputs, generation.inputs.store, generation.inputs.robot
    record = None if inputs.options.removes else _record(generation, decision)
    actions = actions_after(decision.actions, settled)
    files = _file_changes(generation, decision, settled)
    is_writing = bool(files) or any(action.writes for action in actions)
    contents = {key: change.content for key, change in files.items()}
    index, texts = put_aside(generation, decision, contents, settled) if record else ({}, {})
    changes, drawing = [*files.values()], None
    diagnostics += _tell_aside(generation, actions, index, texts)
    if inputs.options.draw:
        imports = generation.imported.imports
        picture = inputs.domain.drawing(generation.now.snapshot, imports, robot.target, robot.options)
        if picture is not None:
            drawing = store.drawing(robot.name)
            changes += store.save(drawing, picture.encode())

    names = {inputs.last.name} - {robot.name} if record else {inputs.last.name, robot.name}
    state = [change for name in names for change in store.remove(name)]
    versions = save_versions(inputs, decision.conflicts)
    if record:
        state += store.for_git()
        changes += versions.changes
        changes += store.save_aside(robot.name, index, texts)
        state += _state_changes(generation, decision, record, index, settled, is_writing=is_writing or bool(state))
        is_late = inputs.last.record.files and decision.is_complete
        if is_late and not (is_writing or inputs.options.renews):
            state = []
    changes += state
    above = {inputs.files.path(inputs.last.folder).parent, store.folder}
    folders = {folder for change in changes if change.content is None for folder in change.path.parents}
    emptied = [folder for folder in folders if not above.isdisjoint(folder.parents)]
    emptied.sort(key=lambda folder: len(folder.parts), reverse=True)
    news = generation.changes
    if news and not is_writing and decision.is_complete:
        # the record may keep the old generator and options then, so that each later plan would tell them again
        news = msgspec.structs.replace(news, generator=False, options=())
    result = Result(
        robot.name,
        robot.target.package,
        robot.folder,
        inputs.config.root,
        actions,
        tuple(sorted((*diagnostics, *versions.diagnostics), key=lambda found: (found.file, found.line))),
        dry=inputs.options.dry,
        writes=is_writing,
        renews=bool(state),
        stale=inputs.source.stale,
        is_broken=any(misfit.is_broken for misfit in decision.misfits),
        drawing=drawing,
        changes=news if news and (news.changes or news.generator) else None,
        conflict_texts=versions.conflicts,
        settled=frozenset(settled.keys),
    )
    notes = _notes(generation, record, versions.noted, is_writing=is_writing) if record else None
    return Plan(result, store.hashes(), decision.shared, tuple(changes), tuple(emptied), notes)


def _tell_aside(
    generation: Generation, actions: Actions, index: Mapping[str, Aside], texts: Mapping[str, bytes]
) -> tuple[Diagnostic, ...]:
    """Return a note if texts are replaced that this machine did not generate, without a word of the user's."""
    inputs = generation.inputs
    told = (Reason.MERGE, Reason.MOVE, Reason.UNDO)
    known = {inputs.folder.path(action.path) for action in actions if action.choice or action.reason in told}
    new = sorted(path for path, aside in index.items() if aside.file in texts and path not in known)
    if not new:
        return ()
    file, be = shown(inputs.files.path(inputs.folder.key(new[0]))), "is" if len(new) == 1 else "are"
    message = f"{counted(len(new), 'text')} that this machine did not generate {be} replaced"
    place = shown(inputs.store.aside_file(inputs.robot.name).parent)
    hint = f"copies are below {place}; `resolve FILE --undo` brings one back"
    return (Diagnostic(Severity.NOTE, "put-aside", message, file, hint=hint),)


def _notes(
    generation: Generation, record: Record, proposals: Mapping[str, tuple[str, str]], *, is_writing: bool
) -> Notes | None:
    """Return what this machine knows after a build; None if that is nothing new."""
    inputs, old, imports = generation.inputs, generation.inputs.last.notes, generation.imported
    recorded = {
        sha256 for files in (inputs.last.files, record.files) for file in files.values() for sha256 in file.hashes
    }
    texts, expanded = generation.package.notes(), inputs.source.expansion
    made = {sha256 for _, sha256 in texts.values()} | {imports.imports[key].target_hash for key in imports.converted}
    made_here = imports.converted | {key for key, file in inputs.last.imports.items() if file.is_noted}
    renamed = renamed_identifiers(generation) if generation.renames or generation.respelled else {}
    is_later = is_writing and not inputs.options.choices  # a choice may bring old names back
    expansion_noted = expansion_hash(expanded) if expanded and inputs.source.is_made_here else ""
    new = msgspec.structs.replace(
        old,
        program=inputs.program,
        texts=texts,
        imports=frozenset(import_hash(entry) for key, entry in imports.imports.items() if key in made_here),
        expansion=expansion_noted,
        written=frozenset(made | (set(old.written) & recorded)),
        renamed=renamed if is_later or (renamed and is_writing) else old.renamed,
        proposals=old.proposals if inputs.options.dry else proposals,
    )
    return None if new == old and not inputs.former_name else new


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
        open_ = Open(generation.now.snapshot, generation.recognised_renames)
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


def _file_changes(generation: Generation, decision: Decision, settled: Settled) -> dict[str, FileChange]:
    """Return the changes of the package's files by key, but for those in which other robots may have a part."""
    inputs, changes = generation.inputs, dict[str, FileChange]()
    on_disk = PackageFiles(inputs.config, inputs.robot) if settled.contents else inputs.files
    shared = {inputs.files.key(file.path) for file in decision.shared}
    decided = {action.path: action for action in decision.actions}

    def change(key: str, content: bytes | None, *, is_moved: bool = False) -> None:
        state = on_disk.state(key)
        old = state.sha256 if state else None
        changes[key] = FileChange(inputs.files.path(key), content, old, is_moved)

    for key, content in settled.contents.items():
        if not (key in decided and decided[key].writes) and content != on_disk.read(key):
            change(key, content)
    for action in decision.actions:
        if action.writes and action.path not in shared:
            content = None if action.is_deletion else _content(generation, decision, action)
            change(action.path, content, is_moved=action.origin is not None and action.path in decision.texts)
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
    state = files.state(key)
    mine = (files.read(key) or b"") if state and state.sha256 != state.text_sha256 else b""
    return with_line_ends(generation.package.content(path), mine)


def _state_changes(
    generation: Generation,
    decision: Decision,
    record: Record,
    aside: Mapping[str, Aside],
    settled: Settled,
    *,
    is_writing: bool,
) -> list[FileChange]:
    """Return the changes of the recorded state: the expanded source, the bases, and the record as the last one."""
    inputs, store, expanded = generation.inputs, generation.inputs.store, generation.inputs.source.expansion
    name, changes = inputs.robot.name, list[FileChange]()
    if not inputs.source.stale:
        changes += store.save(store.expansion(name), expansion.dumps(expanded) if expanded else None)
    recorded = store.save(store.path(name), statefile.dumps(record).encode())
    is_writing = is_writing or bool(changes or recorded)
    changes += _base_changes(generation, decision, record, aside, settled, is_writing=is_writing)
    return changes + recorded


def _base_changes(
    generation: Generation,
    decision: Decision,
    record: Record,
    aside: Mapping[str, Aside],
    settled: Settled,
    *,
    is_writing: bool,
) -> list[FileChange]:
    """Return how the texts that the record mentions get to the bases, and how old ones go.

    A text that is missing or damaged is written if it is generated now. One that no state mentions any more, neither
    the record before nor the one after, goes with a complete build that writes something: alone it is no reason.
    """
    inputs, last = generation.inputs, generation.inputs.last
    old = {sha256 for file in last.record.files.values() for sha256 in file.hashes}
    new = {sha256 for file in record.files.values() for sha256 in file.hashes}
    needed = {*old, *new, *(sha256 for text in aside.values() for sha256 in text.bases)}
    stored = {digit: inputs.store.bases(last.name, digit) for digit in DIGITS}
    missing, package = dict[str, str](), generation.package
    if absent := new - {sha256 for texts in stored.values() for sha256 in texts or ()}:
        made = generation.paths_by_hash  # an element may get another name yet
        missing = {sha256: package.content(made[sha256]).decode() for sha256 in absent & made.keys()}
        missing |= {sha256: settled.texts[sha256] for sha256 in absent & settled.texts.keys()}
    cleans = decision.is_complete and (is_writing or bool(missing))
    # git may have united lines, which have an order
    is_whole = inputs.options.full or inputs.former_name or (last.record.is_united and is_writing)
    changes = list[FileChange]()
    for digit, texts in stored.items():
        after = {sha256: text for sha256, text in (texts or {}).items() if not cleans or sha256 in needed}
        after |= {sha256: text for sha256, text in missing.items() if sha256[0] == digit}
        if is_whole or texts is None or after.keys() != texts.keys():
            changes += inputs.store.save(inputs.store.base_file(inputs.robot.name, digit), bases.dumps(after))
    return changes

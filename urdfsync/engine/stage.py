"""Stages one robot's plan with all its writes: files, conflict files, bases, and last the record."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, TypeAlias

import msgspec

from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import ChangeClass, Import, Role, Snapshot, Target
from urdfsync.engine.actions import Action, Actions, Reason
from urdfsync.engine.aside import put_aside
from urdfsync.engine.decide import Decision
from urdfsync.engine.edit_origins import EDITED, model_hash
from urdfsync.engine.generation import Generation
from urdfsync.engine.inputs import Inputs
from urdfsync.engine.last_build import import_hash, option_values
from urdfsync.engine.package_files import encode, state_of, with_line_ends
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
from urdfsync.state.notes import Notes, Use
from urdfsync.state.record import FileRecord, Open, Record, as_recorded
from urdfsync.state.store import Aside, StateHashes
from urdfsync.state.transaction import FileChange

Drawing: TypeAlias = Callable[[Snapshot, Mapping[str, Import], Target, Any], str | None]
"""Returns the main model's diagram as SVG text, or None if it has none. Pure. A domain's attribute `drawing`."""


class Plan(msgspec.Struct, frozen=True):
    """All writes of one robot's build, and its result afterwards."""

    result: Result
    state: StateHashes
    """Hashes of the recorded state when the plan was made."""
    shared: tuple[SharedFile, ...] = ()
    """Changes of files around the package."""
    writes: tuple[FileChange, ...] = ()
    """The files to write, without those in `shared`; the record is the last one."""
    emptied: tuple[Path, ...] = ()
    """The folders that become empty, innermost first."""
    notes: Notes | None = None
    """This machine's notes after the build, if they change."""


def stage(
    generation: Generation,
    decision: Decision,
    diagnostics: tuple[Diagnostic, ...],
    settled: Settled,
    uses: Mapping[str, Use],
) -> Plan:
    """Return the plan with all its writes. A dry run gets the same plan, so it gives the same verdict."""
    inputs, store, robot = generation.inputs, generation.inputs.store, generation.inputs.robot
    actions = actions_after(decision.actions, settled)
    files, versions, notes = (
        _file_changes(generation, decision, settled),
        save_versions(inputs, decision.conflicts),
        None,
    )
    is_writing = bool(files) or any(action.writes for action in actions)
    model = generation.now.snapshot, generation.imported.imports, robot.target, robot.options
    draw: Drawing | None = inputs.domain.drawing
    picture = draw(*model) if draw and inputs.options.draw else None
    drawing = None if picture is None else store.drawing(robot.name)
    changes = [*files.values(), *(store.save(drawing, picture.encode()) if picture and drawing else ())]
    if inputs.options.removes:
        state = [change for name in {inputs.last.name, robot.name} for change in store.remove(name)]
    else:
        record = _record(generation, decision, settled)
        index, texts = put_aside(generation, decision, {key: one.content for key, one in files.items()}, settled)
        diagnostics += _tell_aside(generation, actions, index, texts, settled)
        changes += [*versions.changes, *store.save_aside(robot.name, index, texts)]
        state = _state_changes(generation, decision, record, index, settled, is_writing=is_writing)
        notes = _notes(generation, decision, record, versions.noted, uses, is_writing=is_writing)
    changes += state
    news = generation.changes
    if news and not is_writing and decision.is_complete:
        # if the record keeps the old generator and options, each later plan would report them again
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
    return Plan(result, store.hashes(), decision.shared, tuple(changes), _emptied(inputs, changes), notes)


def _emptied(inputs: Inputs, changes: Iterable[FileChange]) -> tuple[Path, ...]:
    """Return the folders of the package and the state that may become empty, innermost first."""
    above = {inputs.files.path(inputs.last.folder).parent, inputs.store.folder}
    folders = {folder for change in changes if change.content is None for folder in change.path.parents}
    below = [folder for folder in folders if not above.isdisjoint(folder.parents)]
    return tuple(sorted(below, key=lambda folder: len(folder.parts), reverse=True))


def _tell_aside(
    generation: Generation, actions: Actions, index: Mapping[str, Aside], texts: Mapping[str, bytes], settled: Settled
) -> tuple[Diagnostic, ...]:
    """Return a note if the build replaces texts that this machine did not generate, without the user's choice."""
    inputs = generation.inputs
    told, chosen = (Reason.MERGE, Reason.MOVE, Reason.UNDO), settled.actions.keys()
    known = {inputs.folder.path(one.path) for one in actions if one.reason in told or {one.path, one.origin} & chosen}
    new = sorted(path for path, aside in index.items() if aside.file in texts and path not in known)
    if not new:
        return ()
    file, be = shown(inputs.files.path(inputs.folder.key(new[0]))), "is" if len(new) == 1 else "are"
    message = f"{counted(len(new), 'text')} that this machine did not generate {be} replaced"
    place = shown(inputs.store.aside_file(inputs.robot.name).parent)
    hint = f"copies are below {place}; `resolve FILE --undo` brings one back"
    return (Diagnostic(Severity.NOTE, "put-aside", message, file, hint=hint),)


def _notes(
    generation: Generation,
    decision: Decision,
    record: Record,
    proposals: Mapping[str, tuple[str, str]],
    uses: Mapping[str, Use],
    *,
    is_writing: bool,
) -> Notes | None:
    """Return this machine's notes after a build; None if they do not change."""
    inputs, old, imports = generation.inputs, generation.inputs.last.notes, generation.imported
    recorded = inputs.last.record.hashes | record.hashes
    texts, expanded = generation.package.notes(), inputs.source.expansion
    made = {sha256 for _, sha256 in texts.values()} | {imports.imports[key].target_hash for key in imports.converted}
    made_here = imports.converted | {key for key, file in inputs.last.imports.items() if file.is_noted}
    renamed = renamed_identifiers(generation) if generation.renames or generation.respelled else {}
    is_later = is_writing and not inputs.options.choices  # a choice like --undo may bring old names back
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
        model=model_hash(record.snapshot),
        edited={action.path: action.mine for action in decision.actions if action.reason in EDITED and action.mine},
        uses=uses,
    )
    return None if new == old and not (inputs.former_name or inputs.options.choices) else new


def _record(generation: Generation, decision: Decision, settled: Settled) -> Record:
    """Return the record after a build."""
    inputs, old, news = generation.inputs, generation.inputs.last.record, generation.changes
    imports, inside = generation.imported.imports, inputs.folder.key("")
    if not decision.is_complete:
        # keep the model of the last complete build; record the files that are renewed, but not those in a former folder
        files = {} if inputs.has_moved else files_after(decision.actions, old.files, is_complete=False)
        files = {**old.files} | {key: file for key, file in files.items() if key.startswith(inside)}
        renewed = {
            key: (*old.imports.get(key, ()), entry)
            for key, entry in imports.items()
            if files.get(inputs.folder.key(entry.target)) == FileRecord((entry.target_hash,))
            and entry not in old.imports.get(key, ())
        }
        asked = frozenset(action.path for action in decision.actions if action.reason is Reason.ASKED)
        open_ = Open(as_recorded(generation.now.snapshot), generation.undeclared_renames, asked)
        settled_texts = {state_of(text).text_sha256 for text in settled.contents.values() if text is not None}
        return msgspec.structs.replace(
            old,
            files=files,
            imports={**old.imports, **renewed},
            open=open_,
            confirmed=old.confirmed | settled_texts,
        )
    files = files_after(decision.actions, inputs.last.files, is_complete=True)
    is_same = inputs.last.version is not None and inputs.last.version.snapshot == generation.now.snapshot
    new = Record(
        package=inputs.robot.target.package,
        class_=inputs.robot.target.name,
        folder=str(inputs.folder),
        generator=inputs.generator,
        options=option_values(inputs.robot.options),
        renamed=_brought(generation),
        confirmed=_confirmed(generation, decision),
        snapshot=old.snapshot if is_same else as_recorded(generation.now.snapshot),
        imports={key: (entry,) for key, entry in imports.items()},
        files={key: file for key, file in files.items() if key.startswith(inside)},
    )
    if news is None or any(change.change_class.rank > ChangeClass.UNMODELLED.rank for change in news.changes):
        return new
    # changes that no file of the package shows are not worth a commit, such as unmodelled parts of the source
    silent = msgspec.structs.replace(new, snapshot=old.snapshot, options=old.options, generator=old.generator)
    return old if silent == old else new


def _brought(generation: Generation) -> Mapping[str, str]:
    """Return the declared renames that this build or an earlier one has applied."""
    if generation.inputs.last.version is None:  # the first build has the new names already
        return dict(generation.inputs.robot.renamed)
    done = generation.inputs.last.record.renamed
    brought = {(name, new) for (_, name), new in generation.renames.items()}
    declared = generation.inputs.robot.renamed.items()
    return {old: new for old, new in declared if done.get(old) == new or (old, new) in brought}


def _confirmed(generation: Generation, decision: Decision) -> frozenset[str]:
    """Return the hashes of the texts that the user has confirmed to be in the right place, now or before."""
    before, files = generation.inputs.last.record.confirmed, generation.inputs.files
    edited = [action for action in decision.actions if action.reason in EDITED and action.mine]
    return frozenset(str(one.mine) for one in edited if one.mine in before or files.is_chosen(one.path))


def _file_changes(generation: Generation, decision: Decision, settled: Settled) -> dict[str, FileChange]:
    """Return the changes of the package's files by key, without files that other robots share."""
    inputs, changes = generation.inputs, dict[str, FileChange]()
    shared = {inputs.files.key(file.path) for file in decision.shared}
    decided = {action.path: action for action in decision.actions}

    def change(key: str, content: bytes | None, *, is_moved: bool = False) -> None:
        state = inputs.files.state_on_disk(key)
        old = state.sha256 if state else None
        changes[key] = FileChange(inputs.files.path(key), content, old, is_moved)

    for key, content in settled.contents.items():
        if not (key in decided and decided[key].writes) and content != inputs.files.read_on_disk(key):
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
            message, file = "it can't be written: its source file is missing", shown(files.path(key))
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
    """Return the changes of the recorded state, the record as the last one.

    `status` and some other commands do not renew a complete state if there is nothing else to write.
    """
    inputs, store, expanded = generation.inputs, generation.inputs.store, generation.inputs.source.expansion
    name, last = inputs.robot.name, inputs.last
    if last.record.files and decision.is_complete and not (is_writing or inputs.options.renews):
        return []
    changes = [*(store.remove(last.name) if last.name != name else ()), *store.for_git()]
    if not inputs.source.stale:
        changes += store.save(store.expansion(name), expansion.dumps(expanded) if expanded else None)
    recorded = store.save(store.path(name), statefile.dumps(record).encode())
    is_writing = is_writing or bool(changes or recorded)

    # A missing or damaged text is written if it is generated now. A text that neither the old record nor the new one
    # mentions is deleted by the next complete build that writes: it is no reason for a build.
    needed = {*last.record.hashes, *record.hashes, *(sha256 for text in aside.values() for sha256 in text.bases)}
    stored = {digit: store.bases(last.name, digit) for digit in bases.DIGITS}
    absent = record.hashes - {sha256 for texts in stored.values() for sha256 in texts or ()}
    missing, package = {sha256: settled.texts[sha256] for sha256 in absent & settled.texts.keys()}, generation.package
    if absent:
        made = generation.paths_by_hash  # by hash, since a text may have another path now
        missing |= {sha256: package.content(made[sha256]).decode() for sha256 in absent & made.keys()}
    cleans = decision.is_complete and (is_writing or bool(missing))
    # if git has united lines, they may be in another order
    is_united = last.record.is_united and is_writing
    is_whole = inputs.options.full or inputs.former_name or inputs.damage or is_united
    for digit, texts in stored.items():
        after = {sha256: text for sha256, text in (texts or {}).items() if not cleans or sha256 in needed}
        after |= {sha256: text for sha256, text in missing.items() if sha256[0] == digit}
        if is_whole or texts is None or after.keys() != texts.keys():
            changes += store.save(store.base_file(name, digit), bases.dumps(after))
    return changes + recorded

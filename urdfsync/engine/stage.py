"""Stages one robot's plan with all its writes: files, texts saved beside them, bases, and last the record.

Two kinds of texts are saved below `.urdfsync/`. `aside` has a copy of each replaced text that this machine did not
generate, for `--undo`. Once the user saves a text's file, and a build writes files, the list in `aside` drops the text;
the copy stays. `conflicts` has the versions of each file in conflict: base, generated, and a proposed merge. If a
person changed a proposal, builds never overwrite it, and `resolve --edit` begins with it.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import Any, TypeAlias

import msgspec

from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import ChangeClass, ElementKey, Import, Role, Snapshot, Target
from urdfsync.engine.actions import Action, Actions, Reason, sides_hash
from urdfsync.engine.conflicts import Conflict
from urdfsync.engine.decide import Decision
from urdfsync.engine.differences import Differences
from urdfsync.engine.edit_origins import EDITED
from urdfsync.engine.findings import UNMERGED, find_lasting, find_news, find_uses, tell_uses
from urdfsync.engine.foresight import foresee_actions
from urdfsync.engine.generate import Package
from urdfsync.engine.generation import Generation
from urdfsync.engine.inputs import Former, Inputs, Settled
from urdfsync.engine.last_build import hash_of, option_values
from urdfsync.engine.package_after import PackageAfter
from urdfsync.engine.package_files import PackageFiles, encode, text_hash
from urdfsync.engine.parents import SharedFile
from urdfsync.engine.renames import match_with_last, pending
from urdfsync.engine.result import Result
from urdfsync.engine.rules import files_after
from urdfsync.engine.settle import known_bases
from urdfsync.engine.source import expansion_hash
from urdfsync.files import digest, shown, text_digest
from urdfsync.modelica.files import class_parts
from urdfsync.spelling import counted
from urdfsync.state import bases, expansion, statefile
from urdfsync.state.notes import Notes
from urdfsync.state.record import FileRecord, Open, Question, Record, as_recorded
from urdfsync.state.store import Aside, StateHashes
from urdfsync.state.transaction import FileChange

Drawing: TypeAlias = Callable[[Snapshot, Mapping[str, Import], Target, Any, Mapping[str, tuple[str, str]]], str | None]
"""Returns the main model's diagram as SVG text; None for a model without a diagram. Pure. A domain's attribute
`drawing`. The last argument has the texts of the package that differ from the generated ones: by path, the generated
text, empty for a class of the user's own, and the text on disk."""


class _Versions(msgspec.Struct, frozen=True):
    """The saved versions of all conflicts of a robot."""

    conflicts: tuple[Conflict, ...]
    """The conflicts, with the files of their versions."""
    changes: tuple[FileChange, ...]
    noted: Mapping[str, tuple[str, str]]
    """Two hashes for each proposal, by path: of its text as urdfsync wrote it, and of its two sides."""
    written: Mapping[str, str]
    """Hash of each other version, by path."""
    diagnostics: tuple[Diagnostic, ...]


class Plan(msgspec.Struct, frozen=True):
    """All writes of one robot's build, and the result after them."""

    result: Result
    state: StateHashes
    """Hashes of the recorded state when the plan was made."""
    shared: tuple[SharedFile, ...] = ()
    """Changes of the `package.mo` and `package.order` files around the package."""
    writes: tuple[FileChange, ...] = ()
    """The files to write, without `shared`; the record is the last one."""
    emptied: tuple[Path, ...] = ()
    """The folders that become empty, innermost first."""
    notes: Notes | None = None
    """This machine's notes after the build, if they change."""
    next_result: Result | None = None
    """The result of the next plan, if nobody changes a file after this build; None if it is not certain."""


def stage(inputs: Inputs, generation: Generation, decision: Decision) -> Plan:
    """Return the plan with all its writes. A dry run gets the same plan, so it reports the same as a build."""
    store, robot, old, differences = inputs.store, inputs.robot, inputs.last.notes, decision.differences
    uses = find_uses(inputs, generation, decision)
    lasting = [*find_lasting(inputs, generation, decision), *tell_uses(uses)]
    findings = [*lasting, *find_news(inputs, generation, decision)]
    actions = _actions_after(decision.actions, inputs.settled)
    files, versions = _file_changes(inputs, generation, decision), _save_versions(inputs, decision.conflicts)
    is_writing = bool(files) or any(action.writes for action in actions)
    picture = draw_model(inputs, generation, decision) if inputs.options.draw else None
    drawing = None if picture is None else store.drawing(robot.name)
    changes = [*files.values(), *(store.save(drawing, picture.encode()) if picture and drawing else ())]
    notes, after = None, None
    contents = {key: one.content for key, one in files.items()}
    index, texts = _put_aside(inputs, generation.package, decision, contents)
    findings += _tell_aside(inputs, actions, index, texts)
    changes += store.save_aside(robot.name, index, texts)
    if inputs.options.removes:
        state = [change for name in {inputs.last.name, robot.name} for change in store.remove(name)]
    else:
        record = _record(inputs, generation, decision)
        after = foresee_actions(inputs, decision, record)
        changes += versions.changes
        state = []
        # without other writes, `status` and some other commands leave a complete state
        if not (inputs.last.record.files and decision.is_complete) or is_writing or inputs.options.renews:
            state = _source_changes(inputs)
            recorded = store.save(store.path(robot.name), statefile.dumps(record).encode())
            is_renewing = is_writing or bool(state or recorded)
            needed = {*inputs.last.record.hashes, *record.hashes, *(sha for one in index.values() for sha in one.bases)}
            kept = needed if decision.is_complete else None
            state += _base_changes(inputs, generation.package, record, kept, is_writing=is_renewing)
            state += recorded  # the last one
        notes = msgspec.structs.replace(
            _notes(inputs, generation, record, index.values()),
            proposals=old.proposals if inputs.options.dry else versions.noted,
            versions=old.versions if inputs.options.dry else versions.written,
            edited={one.path: one.mine for one in after or decision.actions if one.reason in EDITED and one.mine},
            uses=uses,
        )
        if notes == old and not (inputs.former_name or inputs.options.choices):
            notes = None
    changes += state
    news = differences.changes
    if news and not is_writing and decision.is_complete:
        # else the next plan would report them again: the record keeps the old generator and options
        news = msgspec.structs.replace(news, generator=False, options=())
    result = Result(
        robot.name,
        robot.target.package,
        robot.folder,
        inputs.config.root,
        actions,
        _sorted((*findings, *versions.diagnostics)),
        dry=inputs.options.dry,
        writes=is_writing,
        renews=bool(state),
        stale=inputs.source.stale,
        is_broken=any(misfit.is_broken for misfit in decision.misfits),
        is_unmerged=any(finding.code == UNMERGED for finding in findings),
        drawing=drawing,
        changes=news if news and (news.changes or news.generator) else None,
        conflict_texts=versions.conflicts,
        settled=frozenset(inputs.settled.keys),
    )
    following = None
    if after is not None:
        silent: dict[str, Any] = {"writes": False, "renews": False, "changes": None}
        following = msgspec.structs.replace(result, actions=after, diagnostics=_sorted(lasting), **silent)
    return Plan(result, store.hashes(), decision.shared, tuple(changes), _emptied(inputs, changes), notes, following)


def _sorted(findings: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    return tuple(sorted(findings, key=lambda found: (found.file, found.line)))


def draw_model(inputs: Inputs, generation: Generation, decision: Decision) -> str | None:
    """Return the diagram of the main model as the build leaves the package; None if the domain has no diagram."""
    draw: Drawing | None = inputs.domain.drawing
    if draw is None:
        return None
    model = generation.now.snapshot, generation.imported.imports, inputs.robot.target, inputs.robot.options
    after = PackageAfter(inputs, generation.package, decision.actions, decision.texts)
    return draw(*model, after.differing)


def _actions_after(actions: Actions, settled: Settled) -> Actions:
    """Return the actions of the build, and those of the choices."""
    after = {action.path: action for action in actions}
    for key, chosen in settled.actions.items():
        decided = after.get(key)
        if decided and (decided.is_conflict or decided.writes):
            after[key] = msgspec.structs.replace(decided, choice=chosen.choice)
        else:
            after[key] = chosen
    return Actions(after.values())


def _emptied(inputs: Inputs, changes: Iterable[FileChange]) -> tuple[Path, ...]:
    """Return the folders of the package and the state that may become empty, innermost first."""
    above = {inputs.files.path(inputs.last.folder).parent, inputs.store.folder}
    folders = {folder for change in changes if change.content is None for folder in change.path.parents}
    below = [folder for folder in folders if not above.isdisjoint(folder.parents)]
    return tuple(sorted(below, key=lambda folder: len(folder.parts), reverse=True))


def _tell_aside(
    inputs: Inputs, actions: Actions, index: Mapping[str, Aside], texts: Mapping[str, bytes]
) -> tuple[Diagnostic, ...]:
    """Return a note if the build replaces texts that this machine did not generate, without the user's choice."""
    told, chosen = (Reason.MERGE, Reason.MOVE, Reason.UNDO), inputs.settled.actions.keys()
    known = {inputs.folder.path(one.path) for one in actions if one.reason in told or {one.path, one.origin} & chosen}
    new = sorted(path for path, aside in index.items() if aside.file in texts and path not in known)
    if not new:
        return ()
    file, be = shown(inputs.files.path(inputs.folder.key(new[0]))), "is" if len(new) == 1 else "are"
    what = f"{counted(len(new), 'text')} that this machine did not generate"
    message = f"a build replaces {what}" if inputs.options.dry else f"{what} {be} replaced"
    place = shown(inputs.store.aside_file(inputs.robot.name).parent)
    hint = f"copies {'will be' if inputs.options.dry else 'are'} below {place}; `resolve FILE --undo` brings one back"
    return (Diagnostic(Severity.NOTE, "put-aside", message, file, hint=hint),)


def _notes(inputs: Inputs, generation: Generation, record: Record, saved: Iterable[Aside]) -> Notes:
    """Return this machine's notes with the results of this build; `record` is the new record."""
    old, imports, expanded = inputs.last.notes, generation.imported, inputs.source.expansion
    recorded, texts = inputs.last.record.hashes | record.hashes, generation.package.notes()
    recorded |= {text_hash(model) for aside in saved for model in aside.beside.values()}  # `--undo` records them again
    made = {sha256 for _, sha256 in texts.values()} | {imports.imports[key].target_hash for key in imports.converted}
    made_here = imports.converted | {key for key, file in inputs.last.imports.items() if file.is_noted}
    return msgspec.structs.replace(
        old,
        program=inputs.program,
        texts=texts,
        imports=frozenset(hash_of(entry) for key, entry in imports.imports.items() if key in made_here),
        expansion=expansion_hash(expanded) if expanded and inputs.source.is_made_here else "",
        written=frozenset(made | (set(old.written) & recorded)),
        model=hash_of(record.snapshot),
    )


def _record(inputs: Inputs, generation: Generation, decision: Decision) -> Record:
    """Return the record after a build."""
    old, differences, news = inputs.last.record, decision.differences, decision.differences.changes
    imports, inside = generation.imported.imports, inputs.folder.key("")
    merged = {key: text_hash(text) for key, text in decision.texts.items() if key.endswith(".mo")}
    # a merge may wait: then the edit stays on disk
    edits = (action for action in decision.actions if action.reason in EDITED or action.path in merged)
    judged = frozenset((*merged.values(), *(str(action.mine) for action in edits if action.mine)))
    # the merge of a confirmed text with an export stays confirmed
    merges = (action for action in decision.actions if action.path in merged and action.mine in old.confirmed)
    confirmed = frozenset(merged[action.path] for action in merges)
    if not decision.is_complete:
        return _open_record(inputs, generation, decision, judged, confirmed)
    files = files_after(decision.actions, inputs.last.files, is_complete=True)
    users, is_chosen = {*EDITED, Reason.UNKNOWN}, inputs.files.is_chosen
    edited = (one for one in decision.actions if one.reason in users and one.mine)
    is_same = inputs.last.version is not None and inputs.last.version.snapshot == generation.now.snapshot
    new = Record(
        package=inputs.robot.target.package,
        class_=inputs.robot.target.name,
        folder=str(inputs.folder),
        generator=inputs.generator,
        options=option_values(inputs.robot.options),
        renamed=_brought(inputs, differences.renames),
        former=_former(inputs, generation, differences),
        confirmed=confirmed.union(str(one.mine) for one in edited if one.mine in old.confirmed or is_chosen(one.path)),
        edited=judged,
        snapshot=old.snapshot if is_same else as_recorded(generation.now.snapshot),
        imports={key: (entry,) for key, entry in imports.items()},
        files={key: file for key, file in files.items() if key.startswith(inside)},
    )
    # an edit is not worth a commit of the record
    silent = msgspec.structs.replace(new, edited=old.edited)
    if news is not None and all(change.change_class.rank <= ChangeClass.UNMODELLED.rank for change in news.changes):
        # nor is a change without effect on the package, such as an unmodelled part of the source
        silent = msgspec.structs.replace(silent, snapshot=old.snapshot, options=old.options, generator=old.generator)
    return old if silent == old else new


def _open_record(
    inputs: Inputs, generation: Generation, decision: Decision, judged: frozenset[str], confirmed: frozenset[str]
) -> Record:
    """Return the record after an incomplete build: it keeps the model of the last complete build.

    `judged` has the hashes of the user's texts, `confirmed` those of confirmed texts after their merges.
    """
    old, imports, inside = inputs.last.record, generation.imported.imports, inputs.folder.key("")
    # record renewed files, but none in a former folder
    files = {} if inputs.has_moved else files_after(decision.actions, old.files, is_complete=False)
    files = {**old.files} | {key: file for key, file in files.items() if key.startswith(inside)}
    renewed = dict(old.open.imports) if old.open else {}
    for key, entry in imports.items():
        if files.get(inputs.folder.key(entry.target)) == FileRecord((entry.target_hash,)):
            renewed[key] = (entry,)
    renewed = {key: entries for key, entries in renewed.items() if entries != old.imports.get(key)}
    questions = (action for action in decision.actions if action.reason is Reason.ASKED)
    asked = {one.path: Question(str(one.mine), decision.doubts[one.path]) for one in questions}
    # a decision about an earlier export does not answer a question, not in the next build either
    outdated = decision.outdated.union(question.mine for question in asked.values())
    confirmed |= old.confirmed.difference(outdated)
    renames = decision.differences.renames
    if pending(inputs):  # the user may delete a declaration
        renames = match_with_last(inputs, generation.now.snapshot, {}).renames
    new = msgspec.structs.replace(
        old,
        files=files,
        open=Open(as_recorded(generation.now.snapshot), renames, asked, renewed),
        confirmed=confirmed.union(text_digest(text) for text in inputs.settled.contents.values() if text is not None),
    )
    return old if new == old else msgspec.structs.replace(new, edited=judged)


def _former(inputs: Inputs, generation: Generation, differences: Differences) -> Mapping[str, str]:
    """Return present identifiers by former ones that name nothing now: of package, main model and elements."""
    names = inputs.domain.names(generation.now.snapshot, inputs.robot.target)
    elements = (identifier for kind in names.values() for identifier in kind.values())
    present = {inputs.robot.folder.name, inputs.robot.target.name, *elements}
    return {old: new for old, new in differences.former.items() if new in present and old not in present}


def _brought(inputs: Inputs, renames: Mapping[ElementKey, str]) -> Mapping[str, str]:
    """Return the declared renames that this build or an earlier one has applied."""
    declared, done = inputs.robot.renamed, inputs.last.record.renamed
    if inputs.last.version is None:  # the first build has the new names already
        return dict(declared)
    brought = {(name, new) for (_, name), new in renames.items()}
    return {old: new for old, new in declared.items() if done.get(old) == new or (old, new) in brought}


def _file_changes(inputs: Inputs, generation: Generation, decision: Decision) -> dict[str, FileChange]:
    """Return the changes of the package's files by key, without files that other robots share."""
    changes = dict[str, FileChange]()
    shared = {inputs.files.key(file.path) for file in decision.shared}
    decided = {action.path: action for action in decision.actions}

    def change(key: str, content: bytes | None, *, is_moved: bool = False) -> None:
        state = inputs.files.state_on_disk(key)
        old = state.sha256 if state else None
        changes[key] = FileChange(inputs.files.path(key), content, old, is_moved)

    for key, content in inputs.settled.contents.items():
        if not (key in decided and decided[key].writes) and content != inputs.files.read_on_disk(key):
            change(key, content)
    for action in decision.actions:
        if action.writes and action.path not in shared:
            content = None if action.is_deletion else _content(inputs, generation, decision, action)
            change(action.path, content, is_moved=action.origin is not None and action.path in decision.texts)
    return changes


def _content(inputs: Inputs, generation: Generation, decision: Decision, action: Action) -> bytes:
    key, files = action.path, inputs.files
    if key in decision.texts:
        return encode(decision.texts[key])
    state = files.state(key)
    mine = (files.read(key) or b"") if state and state.sha256 != state.text_sha256 else b""
    content = generation.content(inputs.folder.path(key), action.role, mine)
    if content is None:
        message, hint = "it can't be written: its source file is missing", "restore that file, or the imported copy"
        raise OutputError.of("no-source", message, shown(files.path(key)), hint=hint)
    return content


def _source_changes(inputs: Inputs) -> list[FileChange]:
    """Return the changes of the state after a new name of the robot, or a new expansion of its source."""
    store, name, last, expanded = inputs.store, inputs.robot.name, inputs.last, inputs.source.expansion
    changes = [*(store.remove(last.name) if last.name != name else ()), *store.for_git()]
    if not inputs.source.stale:
        changes += store.save(store.expansion(name), expansion.dumps(expanded) if expanded else None)
    return changes


def _base_changes(
    inputs: Inputs, package: Package, record: Record, needed: Collection[str] | None, *, is_writing: bool
) -> Iterator[FileChange]:
    """Yield the changes of the stored bases.

    A missing or damaged text is written again if the present package has it. The next complete build that writes
    anything keeps only the hashes of texts that are not `needed`.
    """
    store, last, settled = inputs.store, inputs.last, inputs.settled
    stored = {digit: store.bases(last.name, digit) for digit in bases.DIGITS}
    known = (item for texts in stored.values() for item in (texts or {}).items())
    absent = record.hashes - {sha256 for sha256, text in known if text is not None}
    missing = {sha256: settled.texts[sha256] for sha256 in absent & settled.texts.keys()}
    if absent:
        made = package.paths_by_hash  # found by hash, since a text may have another path now
        missing |= {sha256: package.content(made[sha256]).decode() for sha256 in absent & made.keys()}
    cleans = needed is not None and (is_writing or bool(missing))
    # git may have united lines in another order
    is_united = last.record.is_united and is_writing
    is_whole = inputs.options.full or inputs.former_name or inputs.damage or is_united
    for digit, texts in stored.items():
        is_kept = frozenset(texts or ()) if not cleans else frozenset(needed or ())
        after = {sha256: text if sha256 in is_kept else None for sha256, text in (texts or {}).items()}
        after |= {sha256: text for sha256, text in missing.items() if sha256[0] == digit}
        if is_whole or after != texts:
            yield from store.save(store.base_file(inputs.robot.name, digit), bases.dumps(after))


def _save_versions(inputs: Inputs, conflicts: Sequence[Conflict]) -> _Versions:
    """Return the writes that save the versions of conflicts, and the paths of the versions."""
    store, robot, noted = inputs.store, inputs.robot.name, inputs.last.notes.proposals
    existing, of_persons = store.conflict_files(robot), store.persons_files(robot, inputs.last.notes)
    # an empty proposal does not count
    persons = {path for path, text in of_persons.items() if ".merge" in path and text.strip()}
    contents, saved, findings = dict[str, bytes](), list[Conflict](), list[Diagnostic]()
    notes = {path: facts for path, facts in noted.items() if path in persons}
    for conflict in conflicts:
        path, merge = PurePosixPath(inputs.folder.path(conflict.path)), conflict.merge
        stem, suffix = path.with_suffix("").as_posix(), path.suffix
        files = dict[str, str]()
        for kind, text in (("base", conflict.base), ("generated", conflict.generated)):
            if text is not None:
                files[kind] = f"{stem}.{kind}{suffix}"
                contents[files[kind]] = encode(text)
        if merge is not None:  # a text with markers is no Modelica
            ending, proposal = ".txt" if merge.text is None else suffix, encode(merge.proposal)
            sides = sides_hash(text_hash(conflict.mine), text_hash(conflict.generated))
            numbers = itertools.chain(("",), map("-{}".format, itertools.count(2)))
            for number in numbers:
                name = f"{stem}.merge{number}{ending}"
                if name not in persons or noted.get(name, ("", ""))[1] == sides or existing[name] == proposal:
                    break
                message = "you changed this proposed merge, so it stays: a new proposal is beside it"
                place = shown(store.conflicts(robot) / name)
                findings.append(Diagnostic(Severity.NOTE, "proposal-kept", message, place))
            files["merge"] = name
            if name not in persons:
                contents[name], notes[name] = proposal, (digest(proposal), sides)
        name = files.get("merge", "")
        edited = existing[name].decode(errors="replace") if name in persons else None
        saved.append(msgspec.structs.replace(conflict, files=files, edited=edited))
    changes = store.save_conflicts(robot, contents, persons)
    for name, content in of_persons.items():
        if name not in persons and content.strip() and contents.get(name) != content:  # it is replaced or deleted now
            below = PurePosixPath("conflicts", name)
            aside = below.with_name(f"{below.stem}.{digest(content)[:8]}{below.suffix}").as_posix()
            changes += store.save(store.aside_file(robot, aside), content)
            message, saved_as = "you wrote this file", shown(store.conflicts(robot) / name)
            hint = f"a copy is {shown(store.aside_file(robot, aside))}"
            findings.append(Diagnostic(Severity.NOTE, "put-aside", message, saved_as, hint=hint))
    written = {name: digest(text) for name, text in contents.items() if name not in notes}
    return _Versions(tuple(saved), tuple(changes), notes, written, tuple(findings))


def _put_aside(
    inputs: Inputs, package: Package, decision: Decision, contents: Mapping[str, bytes | None]
) -> tuple[dict[str, Aside], dict[str, bytes]]:
    """Return the saved texts after a build, by path below the package, and the new texts by file.

    `contents` are the texts that the build writes, by key; None for a deletion.
    """
    folder, settled = inputs.folder, inputs.settled
    moved = {action.origin: action.path for action in decision.actions if action.origin and action.writes}
    index, replaced = dict[str, Aside](), dict(_replaced(inputs, package, decision, contents))
    for path, aside in inputs.last.aside.items():
        key = folder.key(path)
        is_unsaved = _is_as_written(inputs.files, key, aside)
        if key in moved and is_unsaved and (text := inputs.store.aside_text(inputs.last.name, aside.file)) is not None:
            former = Former(text, FileRecord(aside.bases), aside.texts)
            replaced.setdefault(moved[key], _follow(inputs, former, moved[key], decision.names))
        elif is_unsaved or not contents:
            index[path] = aside
    for key in settled.contents:
        index.pop(folder.path(key), None)  # another choice replaces this text, or this text was restored
    chosen = {
        moved.get(key, key): _follow(inputs, former, moved[key], decision.names) if key in moved else former
        for key, former in settled.before.items()
    }
    deleted = [one for one in decision.actions if one.writes and one.reason is Reason.DELETE] if chosen else []
    models = (one.path for one in deleted if one.path.startswith(folder.key("")) and one.path.endswith(".mo"))
    beside, texts = {folder.path(key): inputs.files.text(key) or "" for key in models}, dict[str, bytes]()
    for key, former in {**replaced, **chosen}.items():
        place, after = PurePosixPath(folder.path(key)), contents.get(key, settled.contents.get(key))
        file = place.with_name(f"{place.stem}.{digest(former.text)[:8]}{place.suffix}").as_posix()
        sha256, bases = None if after is None else text_digest(after), (former.record.hashes, former.bases)
        index[str(place)] = Aside(file, sha256, *bases, beside if key in chosen else {})
        texts[file] = former.text
    return index, texts


def _is_as_written(files: PackageFiles, key: str, aside: Aside) -> bool:
    """Return whether a file is unchanged since the build that saved its former text in `aside`."""
    try:
        state = files.state_on_disk(key)
    except OutputError:  # the user replaced it by a link or a folder
        return False
    return (state.text_sha256 if state else None) == aside.after


def _follow(inputs: Inputs, former: Former, key: str, names: Mapping[str, str]) -> Former:
    """Return a text and its base for the file's new path: with new names, and a new `within` clause."""
    from urdfsync.merge.renames import rename, without_clashes  # imports the parser
    from urdfsync.modelica.layout import with_within

    text, base = former.text.decode(errors="surrogateescape"), next(iter(former.bases.values()), None)
    if base is not None:
        base, text = rename(base, text, without_clashes(names, text))
    class_name = (inputs.robot.target.package, *class_parts(inputs.folder.path(key)))
    return Former(encode(with_within(text, ".".join(class_name))), *known_bases(base))


def _replaced(
    inputs: Inputs, package: Package, decision: Decision, contents: Mapping[str, bytes | None]
) -> Iterator[tuple[str, Former]]:
    """Yield the key and the former text of each replaced or deleted file; leave out texts that this machine generated.

    A `package.order` is saved only if git has united two states: then a build may remove the user's lines.
    """
    files, last, folder = inputs.files, inputs.last, inputs.folder.key("")
    origins = {action.origin for action in decision.actions if action.origin and action.writes}
    for action in decision.actions:
        key, is_moving = action.path, action.reason is Reason.MOVE
        if not action.writes or key not in contents or (key in origins and not is_moving):
            continue  # the user's text moves to another file
        if action.role is Role.ORDER and not (last.record.is_united and key.startswith(folder)):
            continue
        state = files.state(action.origin or key) if is_moving else files.state_on_disk(key)
        recorded = last.files.get(action.origin or key, FileRecord()).hashes
        # a mesh is no text: bytes that look like line ends count
        if state is None or not last.notes.written.intersection(recorded).isdisjoint(state):
            continue
        text = files.read(action.origin or key) if is_moving else files.read_on_disk(key)
        if text is None:  # somebody has just deleted it
            continue
        former = Former(text, *_bases_given_back(inputs, package, action, text))
        if is_moving:
            former = _follow(inputs, former, key, decision.names)
        if former.text != contents[key]:
            yield key, former


def _bases_given_back(
    inputs: Inputs, package: Package, action: Action, text: bytes
) -> tuple[FileRecord, Mapping[str, str]]:
    """Return the bases of a text after `--undo`."""
    place = (action.origin or "") if action.reason is Reason.MOVE else action.path
    record = inputs.last.files.get(place, FileRecord())
    # with the old base, the next build would merge the text again, or take it for generated
    merging = {robot.name for robot in inputs.config.robots if robot.on_conflict == "merge"}  # not only this command
    is_merge = (action.reason is Reason.MERGE or action.is_left_by_git) and inputs.robot.name in merging
    is_own_base = text_digest(text) in record.hashes
    if action.generated and action.role is not Role.IMPORT and (is_merge or is_own_base):
        return known_bases(package.content(inputs.folder.path(action.path)).decode())
    return (FileRecord(), {}) if is_own_base else (record, inputs.last.bases(record))

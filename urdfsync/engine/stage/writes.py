"""Stages one robot's plan with all its writes: what they need first, the files, and last the record."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator, Sequence
from pathlib import Path

import msgspec

from urdfsync.common.dependencies.reads import Reads
from urdfsync.common.diagnostics import OutputError
from urdfsync.common.files import digest, shown
from urdfsync.domain import Role
from urdfsync.domain.comparison import Changes
from urdfsync.engine.actions import Action, Actions, find_left_paths
from urdfsync.engine.decide.decision import Decision
from urdfsync.engine.decide.package_after import PackageAfter
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs, Settled
from urdfsync.engine.inspect.package_files import PackageFiles, encode
from urdfsync.engine.inspect.parents import SharedFile, merge_order
from urdfsync.engine.package.generate import Package
from urdfsync.engine.result import Outlook
from urdfsync.engine.stage.aside import put_aside, tell_aside
from urdfsync.engine.stage.findings import UNMERGED, find_findings, find_uses
from urdfsync.engine.stage.record_after import notes_after, records_after
from urdfsync.engine.stage.saved_conflicts import save_conflicts
from urdfsync.modelica.markers import join_sides
from urdfsync.modelica.stamp import Stamp, with_stamp
from urdfsync.project.state import bases, expansion, statefile
from urdfsync.project.state.notes import Notes
from urdfsync.project.state.record import Record, unite
from urdfsync.project.state.store import Aside, StateHashes
from urdfsync.project.state.transaction import FileChange, Writes


class Plan(msgspec.Struct, frozen=True):
    """All writes of one robot's build, and the outlook for its package."""

    outlook: Outlook
    state: StateHashes
    """Hashes of the recorded state when the plan was made."""
    shared: tuple[SharedFile, ...] = ()
    """Changes of the `package.mo` and `package.order` files around the package."""
    writes: Writes = Writes()
    """All other changes of files."""
    emptied: tuple[Path, ...] = ()
    """The folders that become empty, innermost first."""
    notes: Notes | None = None
    """This machine's notes after the build, if they change."""


def stage(inputs: Inputs, generation: Generation, decision: Decision, reads: Reads) -> Plan:
    """Return the plan with all its writes. A dry run gets the same plan, so it reports the same as a build.

    `reads` lists all that the steps have read so far.
    """
    store, robot, options = inputs.store, inputs.robot, inputs.options
    actions, files = _actions_after(decision.actions, inputs.settled), _file_changes(inputs, generation, decision)
    is_writing = bool(files) or any(action.writes for action in actions)
    contents = {key: one.content for key, one in files.items()}
    index, texts = put_aside(inputs, generation.package, decision, contents)
    conflicts = save_conflicts(inputs, decision.conflicts)
    picture, drawing = draw_model(inputs, generation, decision) if options.draw else None, store.drawing(robot.name)
    copies = [*(store.save(drawing, picture.encode()) if picture else ()), *store.save_aside(robot.name, index, texts)]
    records = () if options.removes else records_after(inputs, generation, decision)
    if not records:
        state = [change for name in {inputs.last.name, robot.name} for change in store.remove(name)]
        needed = list[FileChange]()
    else:
        copies += conflicts.changes
        needed, state = _state_changes(inputs, generation, decision, records, index.values(), is_writing=is_writing)
    writes = Writes(before=(*needed, *copies), files=tuple(files.values()), record=tuple(state))
    uses = find_uses(inputs, generation, decision)
    findings = [*find_findings(inputs, generation, decision, uses, reads), *tell_aside(inputs, actions, index, texts)]
    outlook = Outlook(
        actions,
        tuple(sorted(findings, key=lambda found: (not found.is_new, found.file, found.line))),
        writes=is_writing,
        renews=bool(needed or state),
        stale=inputs.source.stale,
        is_broken=any(misfit.is_broken for misfit in decision.misfits),
        is_unmerged=any(finding.code == UNMERGED for finding in findings),
        drawing=None if picture is None else drawing,
        changes=_told_changes(decision, is_writing=is_writing),
        conflict_texts=decision.conflicts,
        saved=conflicts.versions,
        settled=frozenset(inputs.settled.keys),
    )
    notes = None
    if records:
        notes = notes_after(inputs, generation, decision, records, index.values(), uses)
        if notes == inputs.last.notes and not (inputs.former_name or options.choices):
            notes = None
    return Plan(outlook, store.hashes(), decision.shared, writes, _emptied(inputs, writes.in_order()), notes)


def _told_changes(decision: Decision, *, is_writing: bool) -> Changes | None:
    """Return the changes of the model that the build tells; None without any."""
    news = decision.differences.changes
    if news and not is_writing and decision.is_complete:
        # else the next plan would report them again: the record keeps the old generator and options
        news = msgspec.structs.replace(news, generator=False, options=())
    return news if news and (news.changes or news.generator) else None


def draw_model(inputs: Inputs, generation: Generation, decision: Decision) -> str | None:
    """Return the diagram of the main model as the build leaves the package; None if the domain has no diagram."""
    draw = inputs.domain.drawing
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
    """Return the folders of the package and the state that may become empty, innermost first.

    A killed build may have deleted some of the recorded files, and all saved versions of conflicts.
    """
    above = {inputs.files.path(inputs.last.folder).parent, inputs.store.folder}
    places = {change.path.parent for change in changes if change.content is None}
    places |= {*map(inputs.files.path, {key.rpartition("/")[0] for key in inputs.last.record.files})}
    conflicts = inputs.store.conflicts(inputs.robot.name)
    places |= {conflicts, *(Path(folder) for folder, _, _ in os.walk(conflicts))}
    folders = {folder for place in places for folder in (place, *place.parents)}
    below = [folder for folder in folders if not above.isdisjoint(folder.parents)]
    return tuple(sorted(below, key=lambda folder: len(folder.parts), reverse=True))


def _file_changes(inputs: Inputs, generation: Generation, decision: Decision) -> dict[str, FileChange]:
    """Return the changes of the package's files by key, without files that other robots share."""
    changes = dict[str, FileChange]()
    shared = {inputs.files.key(file.path) for file in decision.shared}
    decided = {action.path: action for action in decision.actions}
    gone = find_left_paths(decision.actions)

    def change(key: str, content: bytes | None, origin: str | None = None) -> None:
        state = inputs.files.state_on_disk(key)
        old, moved_from = state.sha256 if state else None, inputs.files.path(origin) if origin else None
        changes[key] = FileChange(inputs.files.path(key), content, old, moved_from)

    for key, content in inputs.settled.contents.items():
        if (
            key not in gone
            and not (key in decided and decided[key].writes)
            and content != inputs.files.read_on_disk(key)
        ):
            change(key, content)
    for action in decision.actions:
        if action.writes and not action.is_deletion and action.path not in shared:
            content = _content(inputs, generation, decision, action)
            change(action.path, content, action.origin if action.path in decision.texts else None)
    for key in sorted(gone - shared):
        change(key, None)
    return changes


def _content(inputs: Inputs, generation: Generation, decision: Decision, action: Action) -> bytes:
    key, files, path = action.path, inputs.files, inputs.folder.path(action.path)
    stamp = files.stamp(action.origin or key) if action.role is not Role.IMPORT else None
    if path in decision.differences.ids and action.generated:
        stamp = Stamp(decision.differences.ids[path], action.generated)
    if key in decision.texts:
        return with_stamp(encode(decision.texts[key]), stamp)
    content = generation.content(path, action.role, files.read(key) or b"")
    if content is None:
        message, hint = "it can't be written: its source file is missing", "restore that file, or the imported copy"
        raise OutputError.of("no-source", message, shown(files.path(key)), hint=hint)
    return with_stamp(content, stamp) if stamp else content


def _state_changes(
    inputs: Inputs,
    generation: Generation,
    decision: Decision,
    records: Sequence[Record],
    saved: Iterable[Aside],
    *,
    is_writing: bool,
) -> tuple[list[FileChange], list[FileChange]]:
    """Return the changes of the bases, and those of the rest of the state: the record is the last one."""
    store, last = inputs.store, inputs.last
    if inputs.unmerged_paths and not (is_writing or decision.is_complete):
        return [], []  # else `git merge --abort` would refuse to overwrite the state
    # without other writes, `status` and some other commands leave a complete state
    if last.record.files and decision.is_complete and not (is_writing or inputs.options.renews):
        return [], []
    source = _source_changes(inputs)
    recorded = store.save(store.path(inputs.robot.name), statefile.dumps(*records).encode())
    written = unite(records).files.values()
    needed = {*last.files.values(), *written, *(sha256 for one in saved for sha256 in one.base)}
    kept, is_renewing = needed if decision.is_complete else None, is_writing or bool(source or recorded)
    return [*_base_changes(inputs, generation.package, written, kept, is_writing=is_renewing)], [*source, *recorded]


def _source_changes(inputs: Inputs) -> list[FileChange]:
    """Return the changes of the state after a new name of the robot, or a new expansion of its source."""
    store, name, last, expanded = inputs.store, inputs.robot.name, inputs.last, inputs.source.expansion
    changes = [*(store.remove(last.name) if last.name != name else ()), *store.for_git()]
    if not inputs.source.stale:
        changes += store.save(store.expansion(name), expansion.dumps(expanded) if expanded else None)
    return changes


def _base_changes(
    inputs: Inputs, package: Package, written: Collection[str], needed: Collection[str] | None, *, is_writing: bool
) -> Iterator[FileChange]:
    """Yield the changes of the stored bases.

    A missing or damaged text of those `written` is written again if the present package has it. The next complete build
    that writes anything keeps only the hashes of texts that are not `needed`.
    """
    store, last, settled = inputs.store, inputs.last, inputs.settled
    stored = {digit: store.bases(last.name, digit) for digit in bases.DIGITS}
    known = (item for texts in stored.values() for item in (texts or {}).items())
    absent = {*written, *settled.texts} - {sha256 for sha256, text in known if text is not None}
    missing = {sha256: settled.texts[sha256] for sha256 in absent & settled.texts.keys()}
    if absent:
        made = package.paths_by_hash  # found by hash, since a text may have another path now
        missing |= {sha256: package.content(made[sha256]).decode() for sha256 in absent & made.keys()}
    cleans = needed is not None and (is_writing or bool(missing))
    # git may have united lines in another order
    is_united = last.is_united and is_writing
    is_whole = inputs.options.full or inputs.former_name or inputs.damage or is_united
    for digit, texts in stored.items():
        is_kept = frozenset(texts or ()) if not cleans else frozenset(needed or ())
        after = {sha256: text if sha256 in is_kept else None for sha256, text in (texts or {}).items()}
        after |= {sha256: text for sha256, text in missing.items() if sha256[0] == digit}
        if is_whole or after != texts:
            yield from store.save(store.base_file(inputs.robot.name, digit), bases.dumps(after))


def shared_change(file: SharedFile, files: PackageFiles) -> FileChange | None:
    """Return the change of a file around the package as it is on disk now; None without a change."""
    content = files.read(files.key(file.path))
    if file.content is not None:
        return FileChange(file.path, file.content, None) if content is None else None
    old = None if content is None else content.decode(errors="surrogateescape")
    new = merge_order(join_sides(old) if old and file.joins else old, file.names, file.owned)
    if new == (old or ""):
        return None
    return FileChange(file.path, encode(new) if new else None, None if content is None else digest(content))

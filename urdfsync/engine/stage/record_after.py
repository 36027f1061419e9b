"""The record of a robot after a build, and this machine's notes. Pure, but for the texts that it looks up."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence

import msgspec

from urdfsync.domain import ChangeClass, ElementKey
from urdfsync.domain.matching import Matching
from urdfsync.engine.actions import Choice, Reason
from urdfsync.engine.decide.decision import Decision
from urdfsync.engine.decide.differences import Differences
from urdfsync.engine.decide.doubts import EDITED, added_lines
from urdfsync.engine.decide.parts import find_part_ids, other_meanings
from urdfsync.engine.decide.rules import file_records_after
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.last_build import hash_of, line_hash, option_values
from urdfsync.engine.inspect.package_files import bare_hash, encode, text_hash
from urdfsync.engine.sources.source import expansion_hash
from urdfsync.project.state.notes import Notes, Use
from urdfsync.project.state.record import Open, Record, as_recorded, edit_key, unite
from urdfsync.project.state.statefile import key_of
from urdfsync.project.state.store import Aside

_MOST_ANCESTORS = 50
"""The greatest number of earlier records that a record names: branches are seldom longer."""


def records_after(inputs: Inputs, generation: Generation, decision: Decision) -> tuple[Record, ...]:
    """Return the records after a build: one, or after an incomplete build those of all branches."""
    last, differences, news = inputs.last, decision.differences, decision.differences.changes
    old, *others = last.records or (last.record,)
    merged = {key: text_hash(text) for key, text in decision.texts.items() if key.endswith(".mo")}
    edits = {**last.record.edits, **seen_edits(inputs, decision), **seen_merges(inputs, decision)}
    # the merge of a confirmed text with an export stays confirmed
    merges = (action for action in decision.actions if action.path in merged and action.mine in last.record.confirmed)
    confirmed = frozenset(merged[action.path] for action in merges)
    if not decision.is_complete:
        return _open_record(inputs, generation, decision, edits, confirmed), *others
    files = file_records_after(decision.actions, last.files, is_complete=True)
    users, is_chosen, inside = {*EDITED, Reason.UNKNOWN}, inputs.files.is_chosen, inputs.folder.key("")
    edited = [str(one.mine) for one in decision.actions if one.reason in users and one.mine]
    kept = (one.mine for one in decision.actions if one.mine in edited and is_chosen(one.path))
    is_same = last.version is not None and last.version.snapshot == generation.now.snapshot
    # who keeps an edit says what the name means: later edits are not asked about
    answered = {one.owner for one in inputs.settled.actions.values() if one.choice is Choice.KEEP}
    new = Record(
        package=inputs.robot.target.package,
        class_=inputs.robot.target.name,
        folder=str(inputs.folder),
        generator=inputs.generator,
        options=option_values(inputs.robot.options),
        renamed=_brought(inputs, differences.renames),
        former=_former(inputs, generation, differences),
        confirmed=confirmed.union(last.record.confirmed.intersection(edited), map(str, kept)),
        edits=edits,
        former_ids={owner: ids for owner, ids in differences.former_ids.items() if owner not in answered},
        snapshot=old.snapshot if is_same else as_recorded(generation.now.snapshot),
        imports=generation.imported.imports,
        files={key: file for key, file in files.items() if key.startswith(inside)},
        ids=differences.parts,
        ancestors=old.ancestors,
    )
    # an edit is not worth a commit of the record, unless a clone would ask which part it belongs to
    asked = {" ".join(element) for element in other_meanings(inputs, generation, differences.parts)}
    told = {merged.get(one.path, str(one.mine)) for one in decision.actions if one.owner in asked}
    silent = msgspec.structs.replace(
        new, edits={**old.edits, **{sha256: edits[sha256] for sha256 in edits.keys() & told}}
    )
    if news is not None and all(change.change_class.rank <= ChangeClass.UNMODELLED.rank for change in news.changes):
        # nor is a change without effect on the package, such as an unmodelled part of the source
        silent = msgspec.structs.replace(silent, snapshot=old.snapshot, options=old.options, generator=old.generator)
    is_news = silent != old or len(last.records) > 1
    return (_with_ancestors(new, last.records) if is_news else old,)


def _with_ancestors(new: Record, records: Iterable[Record]) -> Record:
    """Return a record that follows from others; if an export was taken back, it is the record of before again."""
    keys = [*dict.fromkeys(key for record in records for key in (key_of(record), *record.ancestors))]
    if (key := key_of(new)) in keys:
        del keys[: keys.index(key) + 1]
    return msgspec.structs.replace(new, ancestors=tuple(keys[:_MOST_ANCESTORS]))


def _open_record(
    inputs: Inputs, generation: Generation, decision: Decision, edits: Mapping[str, str], confirmed: frozenset[str]
) -> Record:
    """Return the record after an incomplete build: it keeps the model of the last complete build.

    `edits` has the files of the user's texts, `confirmed` the hashes of confirmed texts after their merges.
    """
    last, imports, inside = inputs.last, generation.imported.imports, inputs.folder.key("")
    old = last.records[0] if last.records else last.record
    before = old.open or Open()
    # record renewed files, but none in a former folder
    files = {} if inputs.has_moved else file_records_after(decision.actions, before.files, is_complete=False)
    files = {**before.files} | {key: file for key, file in files.items() if key.startswith(inside)}
    written = (item for item in imports.items() if files.get(inputs.folder.key(item[1].target)) == item[1].target_hash)
    renewed = {key: entry for key, entry in (*before.imports.items(), *written) if entry != old.imports.get(key)}
    # a decision about an earlier export does not answer a question, not in the next build either
    questions = (one for one in decision.actions if one.reason is Reason.ASKED)
    asked = {edit_key(one.path, one.mine): decision.doubts[one.path] for one in questions}
    settled = inputs.settled
    chosen = {bare_hash(text) for text in settled.contents.values() if text is not None}
    answered = (key for key, one in settled.before.items() if one.doubt and settled.actions[key].choice is Choice.KEEP)
    named = before.named if last.seen == generation.now.snapshot else frozenset[str]()
    named |= {bare_hash(text) for key in answered if (text := settled.contents[key]) is not None}
    confirmed |= last.record.confirmed | chosen
    differences = decision.differences
    ids = find_part_ids(inputs, generation, Matching(differences.undeclared), differences.stamped)
    new = msgspec.structs.replace(
        old,
        open=Open(as_recorded(generation.now.snapshot), ids, renewed, files, asked, named),
        confirmed=confirmed.difference(asked),
    )
    return old if new == old else _with_ancestors(msgspec.structs.replace(new, edits=edits), last.records[:1])


def seen_edits(inputs: Inputs, decision: Decision) -> dict[str, str]:
    """Return the ids of the files of all edits that stay where they are, by the hashes of their texts."""
    ids, path = decision.differences.ids, inputs.folder.path
    edited = (one for one in decision.actions if one.reason in EDITED and one.mine)
    return {str(one.mine): ids[path(one.path)] for one in edited if path(one.path) in ids}


def seen_merges(inputs: Inputs, decision: Decision) -> dict[str, str]:
    """Return the ids of the files that get merged texts, by the hashes of these texts."""
    ids, path = decision.differences.ids, inputs.folder.path
    return {text_hash(text): ids[path(key)] for key, text in decision.texts.items() if path(key) in ids}


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


def notes_after(
    inputs: Inputs,
    generation: Generation,
    decision: Decision,
    records: Iterable[Record],
    saved: Iterable[Aside],
    uses: Mapping[str, Use],
) -> Notes:
    """Return this machine's notes with the results of this build; `records` are the new records.

    A dry run writes no record. So it notes no edits of another model than the recorded one.
    """
    old, imports, expanded = inputs.last.notes, generation.imported, inputs.source.expansion
    record, texts = unite([*records]), generation.package.notes()
    recorded = {*inputs.last.files.values(), *record.files.values()}
    recorded |= {bare_hash(encode(model)) for aside in saved for model in aside.beside.values()}  # for `--undo`
    made = {sha256 for _, sha256 in texts.values()} | {imports.imports[key].target_hash for key in imports.converted}
    made_here = imports.converted | {key for key, file in inputs.last.imports.items() if file.is_noted}
    is_dry = inputs.options.dry
    return Notes(
        program=inputs.program,
        texts=texts,
        imports=frozenset(hash_of(entry) for key, entry in imports.imports.items() if key in made_here),
        expansion=expansion_hash(expanded) if expanded and inputs.source.is_made_here else "",
        written=frozenset(made | (set(old.written) & recorded)),
        edits={**old.edits, **seen_edits(inputs, decision), **({} if is_dry else seen_merges(inputs, decision))},
        lines=_seen_lines(inputs, generation, decision),
        uses=old.uses if is_dry else uses,
        model=old.model if is_dry else hash_of(record.snapshot) if uses else "",
    )


def _seen_lines(inputs: Inputs, generation: Generation, decision: Decision) -> Mapping[str, Sequence[str]]:
    """Return the ids of files by hashes of lines, with those of the edits that no build has seen so far."""
    old, ids, found = inputs.last.notes, decision.differences.ids, defaultdict[str, set[str]](set)
    edited = (one for one in decision.actions if one.reason in EDITED and one.mine and one.mine not in old.edits)
    for action in edited:
        if (path := inputs.folder.path(action.path)) in ids:
            for line in added_lines(inputs, generation.package, action):
                found[line_hash(line)].add(ids[path])
    return {**old.lines, **{key: sorted(found[key].union(old.lines.get(key, ()))) for key in found}}

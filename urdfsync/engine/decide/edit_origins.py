"""Finds edited files that may belong to other elements now: by the record, and by merged commits.

One branch exchanges two names, another branch edits one of the files. Git leaves the edit in the file of its old name,
and both texts look right. So this module looks for edits in the commits that they may come from. The recorded models of
these commits tell the meaning of the names at that time.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from urdfsync.domain import ElementKey, Role, Snapshot
from urdfsync.engine.actions import Action, Reason
from urdfsync.engine.decide.differences import Differences
from urdfsync.engine.decide.package_names import elements_by_identifier, identifier_of
from urdfsync.engine.decide.renames import find_matching
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.commits import CommittedBuild
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.last_build import NO_MODEL, hash_of
from urdfsync.engine.inspect.package_files import text_hash
from urdfsync.engine.package.generate import Package
from urdfsync.matching import Doubt
from urdfsync.modelica.files import code_of, text_of
from urdfsync.modelica.stamp import split
from urdfsync.state.record import as_read

EDITED = (Reason.KEEP, Reason.CONFLICT)
"""Reasons of files that the user edited and that stay where they are."""


def find_doubts(
    inputs: Inputs, generation: Generation, differences: Differences, actions: Iterable[Action]
) -> dict[str, Doubt]:
    """Return the doubts whether edited files belong to the same elements as before, by key."""
    edited = [one for one in actions if one.reason in EDITED and one.role is not Role.IMPORT]
    edited = [one for one in edited if not inputs.files.is_chosen(one.path)]
    record, notes = inputs.last.record, inputs.last.notes
    unconfirmed = [one for one in edited if one.mine not in record.confirmed]
    # the user's decision about an export holds until the next export
    is_told = inputs.last.seen == generation.now.snapshot
    doubts = dict[str, Doubt | None]()
    for action in unconfirmed if is_told else edited:
        doubts[action.path] = _doubt(inputs, generation, differences, action)
    open_doubts = _open_doubts(inputs, generation, unconfirmed)
    doubts |= open_doubts
    unconfirmed = [one for one in unconfirmed if one.path not in open_doubts]
    if not record.is_united:  # the build that wrote the record has judged these texts; a clone knows that, too
        unconfirmed = [one for one in unconfirmed if one.mine not in record.edited]
    if unconfirmed and notes.model == hash_of(record.snapshot):  # otherwise git may have changed the meaning of names
        unconfirmed = [one for one in unconfirmed if notes.edited.get(one.path) != one.mine]
    unconfirmed = [one for one in unconfirmed if one.mine]  # not a class that became a folder: no commit has this file
    # if both branches changed one element, the united record has no model
    has_model = inputs.last.version is not None or record.is_united
    if unconfirmed and has_model and inputs.commits:  # most texts need not be compared without a repository
        edits = {action: _edit_of(inputs, generation.package, action) for action in unconfirmed}
        for commit in inputs.commits:
            doubts |= _look(inputs, generation, commit, edits)
    return {path: doubt for path, doubt in doubts.items() if doubt}


def _open_doubts(inputs: Inputs, generation: Generation, actions: Iterable[Action]) -> dict[str, Doubt]:
    """Return the doubts of recorded questions about these edits, by key, unless an export was undone."""
    last, now = inputs.last, generation.now.snapshot
    is_undone = last.seen != now and last.version is not None and last.version.snapshot == now
    asked = {} if is_undone or last.record.open is None else last.record.open.asked
    edits = (action for action in actions if action.path in asked and asked[action.path].mine == (action.mine or ""))
    return {action.path: asked[action.path].doubt for action in edits}


def _doubt(inputs: Inputs, generation: Generation, differences: Differences, action: Action) -> Doubt | None:
    """Return the doubt whether an edit belongs to its file's element, judged by the last build; None without one."""
    found, last = differences.matching.doubts, inputs.last
    if not (element := _element(action)):
        lines = _edit_of(inputs, generation.package, action).added if found else ()
        return _named(inputs, lines, found, generation.now.snapshot)
    if element in found:
        return found[element]
    if moved_to := differences.renames.get(element):  # the file can't move to the new name
        return Doubt(" ".join(element), "", (), moved_to, is_certain=True)
    # if only numbers changed, no element is new, and most builds need no features
    is_new_element = last.version is not None and differences.is_structural and element not in last.elements
    is_orphan = is_new_element and action.path in last.files
    is_new = last.record.open is not None and action.path not in last.record.open.asked  # a later build wrote the file
    if is_orphan and not (is_new or last.record.is_united or _is_back(inputs, generation, action)):
        return Doubt(" ".join(element), is_certain=True)  # the user edited the file for an element that is gone
    return None


def _is_back(inputs: Inputs, generation: Generation, action: Action) -> bool:
    """Whether earlier builds have written all texts of a file's element, with the same numbers."""
    package = generation.package
    own = (path for path, owner in package.owners.items() if owner == action.owner)
    return all(inputs.last.has_written(package.hash(path)) for path in own)


class _Edit(NamedTuple):
    """An edit of a generated text, as lines without their indents."""

    added: Counter[str]
    removed: Counter[str]

    def shared(self, text: str) -> Counter[str]:
        """Return the added lines that another text has; if the edit only removes, the removed lines that it lacks."""
        lines = _lines(text)
        return self.added & lines if self.added else self.removed - lines

    def has_moved(self, shared: Counter[str], text: str) -> bool:
        """Return whether this text, the file of the element's new name, has the shared lines of the edit already."""
        return not shared - _lines(text) if self.added else not shared & _lines(text)


def _edit_of(inputs: Inputs, package: Package, action: Action) -> _Edit:
    """Return the user's edit of a generated text; a line of one of the file's bases is no edit."""
    last = inputs.last
    mine = _lines(inputs.files.text(action.path) or "")
    generated = _lines(package.content(inputs.folder.path(action.path)).decode())
    base = last.base(last.files.get(action.path)) or ""
    return _Edit(mine - (generated | _lines(base)), generated - mine)


def _lines(text: str) -> Counter[str]:
    return Counter(line.strip() for line in text.splitlines() if line.strip())


def _look(
    inputs: Inputs, generation: Generation, commit: CommittedBuild, edits: Mapping[Action, _Edit]
) -> dict[str, Doubt]:
    """Return a doubt for each edit that a commit has in its file, if the file's element was renamed since."""
    texts = commit.texts([action.path for action in edits])
    of_commit = {action: text for action in edits if (text := texts.get(action.path))}
    shared = {action: lines for action, text in of_commit.items() if (lines := edits[action].shared(text))}
    if not shared:  # true for most commits; reading the model of a large robot would take a while
        return {}
    record = commit.record()
    try:
        if record is None or record.is_united or not record.snapshot or record.snapshot == inputs.last.record.snapshot:
            return {}
        snapshot = as_read(record.snapshot, inputs.domain.model)
        matching = find_matching(inputs.domain, snapshot, generation.now.snapshot, {})
        if not (matching.renames or matching.doubts):
            return {}
        known = inputs.domain.features(snapshot)
    except NO_MODEL:
        return {}
    formers, moved = {(key[0], new): key[1] for key, new in matching.renames.items()}, dict(matching.doubts)
    for key in known:
        if key in matching.renames or key in formers:
            moved_to = matching.renames.get(key, "")
            moved[key] = Doubt(" ".join(key), formers.get(key, ""), (), moved_to, is_certain=True)
    # other findings report removed names
    elements = inputs.domain.features(generation.now.snapshot)
    existing = {key: doubt for key, doubt in moved.items() if key in elements}
    doubts = dict[str, Doubt]()
    for action, lines in shared.items():
        recorded = record.files.get(action.path)
        text, stamp = split(texts[action.path])
        if recorded is None or text_hash(text) == (stamp.base if stamp else recorded):
            continue  # the file is unedited in this commit
        if element := _element(action):
            if (doubt := moved.get(element)) is None:
                continue
            path = generation.package.find_like(inputs.folder.path(action.path), f"{element[0]} {doubt.moved_to}")
            if path is None or not edits[action].has_moved(lines, inputs.files.text(inputs.folder.key(path)) or ""):
                doubts[action.path] = doubt
        elif doubt := _named(inputs, lines, existing, snapshot):
            doubts[action.path] = doubt
    return doubts


def _element(action: Action) -> ElementKey | None:
    """Return the element that a file belongs to; None for a common file."""
    kind, _, name = action.owner.partition(" ")
    return (kind, name) if name else None


def _named(
    inputs: Inputs, lines: Iterable[str], doubts: Mapping[ElementKey, Doubt], snapshot: Snapshot
) -> Doubt | None:
    """Return the doubt about the first doubtful element in these lines of a common file; None without one."""
    if not doubts:
        return None
    elements = elements_by_identifier(inputs.domain, snapshot, inputs.last.target)
    code = text_of(code_of("\n".join(lines).encode()))
    words = dict.fromkeys(re.findall(r"\w+", code))
    found = filter(None, (elements.get(identifier_of(word, elements)) for word in words))
    return next((doubts[key] for key in found if key in doubts), None)

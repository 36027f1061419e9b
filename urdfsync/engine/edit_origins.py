"""Finds edited files that may belong to other elements now.

One branch exchanges two names, and another branch edits a file. Git leaves the edit in the file of the old name, and
both texts look right. So the edited lines are looked for in the commits that git may have merged. The models recorded
in these commits say which elements the names meant there.
"""

from __future__ import annotations

import itertools
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import msgspec

from urdfsync import git
from urdfsync.diagnostics import SourceError, StateError
from urdfsync.domain import ElementKey, Role, Snapshot
from urdfsync.engine.actions import Action, Reason
from urdfsync.engine.generation import Generation
from urdfsync.engine.last_build import NO_MODEL
from urdfsync.engine.package_files import text_hash
from urdfsync.engine.package_names import identifier_of
from urdfsync.engine.renames import find_matching
from urdfsync.files import digest
from urdfsync.matching import Doubt
from urdfsync.state import statefile
from urdfsync.state.record import FileRecord, as_read

if TYPE_CHECKING:
    import pygit2

    from urdfsync.git.revisions import Revision

_MOST = 50
"""The most branches, and the most earlier checkouts, that are looked at."""
_BACK = 10
"""The most commits that are looked at, from the last one back."""
EDITED = (Reason.KEEP, Reason.CONFLICT)
"""Reasons of files that the user edited and that stay where they are."""


def find_doubts(generation: Generation, actions: Iterable[Action]) -> dict[str, Doubt]:
    """Return why edited files may belong to other elements than before, by key."""
    inputs, notes = generation.inputs, generation.inputs.last.notes
    edited = [one for one in actions if one.reason in EDITED and one.mine and one.role is not Role.IMPORT]
    edited = [one for one in edited if not inputs.files.is_chosen(one.path)]
    record = inputs.last.record
    unconfirmed = [one for one in edited if one.mine not in record.confirmed]
    # the user's answer about an export holds until the next export
    is_told = inputs.last.seen == generation.now.snapshot
    doubts = dict[str, Doubt]()
    for action in (unconfirmed if is_told else edited) if generation.matching.doubts else ():
        if found := _doubt(generation, action, generation.matching.doubts, generation.now.snapshot):
            doubts[action.path] = found
    if notes.model == model_hash(record.snapshot):  # else git may have changed what names mean
        unconfirmed = [one for one in unconfirmed if notes.edited.get(one.path) != one.mine]
    if unconfirmed and inputs.last.version is not None and git.find_top(inputs.config.root) is not None:
        for commit in _commits(generation):
            doubts |= _look(generation, commit, unconfirmed)
    return doubts


def model_hash(snapshot: Mapping[str, Any] | None) -> str:
    """Return one hash for a model."""
    return digest(msgspec.json.encode(snapshot, order="sorted"))


def _commits(generation: Generation) -> Iterator[Revision]:
    """Yield the commits that an edit may come from: merged ones, and those of this clone if it builds."""
    import pygit2  # 55 ms, which most builds do without

    from urdfsync.git.revisions import Revision, open_repository

    root = generation.inputs.config.root
    try:
        repository = open_repository(root)
    except SourceError:  # git may not read this repository
        return
    if repository is None or repository.is_empty or repository.head_is_unborn:
        return
    names = ["MERGE_HEAD", *(str(parent) for parent in repository.head.peel(pygit2.Commit).parent_ids)]
    if generation.inputs.last.notes.program:
        names += [f"HEAD~{number}" for number in range(2, _BACK)]
        names += ["ORIG_HEAD", "CHERRY_PICK_HEAD", "REBASE_HEAD", *_checked_out(repository)]
        names += [name for name in repository.references if name.startswith(("refs/heads/", "refs/remotes/"))][:_MOST]
    for name in dict.fromkeys(names):
        try:
            yield Revision(root, name)
        except SourceError:  # there is no such commit
            continue


def _checked_out(repository: pygit2.Repository) -> Iterator[str]:
    """Yield the commits that were checked out last: a squashed branch may be deleted."""
    for entry in itertools.islice(repository.lookup_reference("HEAD").log(), _MOST):
        yield str(entry.oid_new)


def _look(generation: Generation, commit: Revision, edited: Iterable[Action]) -> dict[str, Doubt]:
    """Return doubts about edits that a commit has in the same file, if their elements were renamed since then."""
    inputs = generation.inputs
    state = inputs.store.path(inputs.last.name)
    try:
        contents = commit.contents([state, *(inputs.files.path(action.path) for action in edited)])
        record, _ = statefile.loads(contents[state].decode(errors="replace"), commit.label(state))
        if record is None or record.is_united or not record.snapshot or record.snapshot == inputs.last.record.snapshot:
            return {}
        snapshot = as_read(record.snapshot, inputs.domain.model)
        matching = find_matching(inputs.domain, snapshot, generation.now.snapshot, {})
        if not (matching.renames or matching.doubts):
            return {}
        known = inputs.domain.features(snapshot)
    except (KeyError, SourceError, StateError, *NO_MODEL):
        return {}
    formers, moved = {(key[0], new): key[1] for key, new in matching.renames.items()}, dict(matching.doubts)
    for key in known:
        if key in matching.renames or key in formers:
            moved_to = matching.renames.get(key, "")
            moved[key] = Doubt(" ".join(key), formers.get(key, ""), (), moved_to, is_certain=True)
    doubts = dict[str, Doubt]()
    for action in edited:
        content = contents.get(inputs.files.path(action.path), b"").decode(errors="replace")
        recorded = record.files.get(action.path)
        is_edited = bool(content) and recorded is not None and text_hash(content) not in recorded.hashes
        if is_edited and (found := _doubt(generation, action, moved, snapshot, content)):
            doubts[action.path] = found
    return doubts


def _doubt(
    generation: Generation,
    action: Action,
    doubts: Mapping[ElementKey, Doubt],
    snapshot: Snapshot,
    former: str | None = None,
) -> Doubt | None:
    """Return the doubt about the file's element, or about an element that an edit in a file of the whole robot uses.

    `former` is an older text of the file, with the names of `snapshot`: only edits that it has, too, count.
    """
    inputs, path = generation.inputs, generation.inputs.folder.path(action.path)
    kind, _, name = action.owner.partition(" ")
    if name and ((kind, name) not in doubts or former is None):
        return doubts.get((kind, name))
    mine = _lines(inputs.files.text(action.path) or "")
    generated = _lines(generation.package.content(path).decode())
    known = generated | _lines("\n".join(inputs.last.bases(inputs.last.files.get(action.path, FileRecord())).values()))
    there = _lines(former) if former is not None else mine
    lines = (mine - known) & there
    if name:
        if lines and _has_followed(generation, action, doubts[kind, name].moved_to, lines):
            return None
        # the edit may have deleted a generated line that both texts lack
        return doubts[kind, name] if lines or (generated - mine) - there else None
    names = inputs.domain.names(snapshot, inputs.last.target)
    elements = {
        identifier: (kind.removesuffix("s"), name) for kind in names for name, identifier in names[kind].items()
    }
    words = dict.fromkeys(word for line in lines for word in re.findall(r"\w+", line))
    found = (elements.get(identifier_of(word, elements)) for word in words)
    return next((doubts[key] for key in found if key and key in doubts), None)


def _has_followed(generation: Generation, action: Action, name: str, lines: Counter[str]) -> bool:
    """Return whether the file of the element's new name has the edit, too: then nothing has to be moved."""
    inputs, artifacts = generation.inputs, generation.package.artifacts
    owner, template = f"{action.owner.partition(' ')[0]} {name}", artifacts[inputs.folder.path(action.path)].template
    paths = (path for path, one in artifacts.items() if (one.owner, one.template) == (owner, template))
    return any(not lines - _lines(inputs.files.text(inputs.folder.key(path)) or "") for path in paths)


def _lines(text: str) -> Counter[str]:
    return Counter(line.strip() for line in text.splitlines() if line.strip())

"""Edits that git brought from a branch in which their names meant other parts.

One branch exchanges names, another one edits: git leaves the edit with the name, and both texts look as they should. So
a new text is looked for in the commits that git may have brought it from, and its element in their recorded models.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import msgspec

from urdfsync import git
from urdfsync.diagnostics import SourceError, StateError
from urdfsync.engine.actions import Action, Reason
from urdfsync.engine.generation import Generation
from urdfsync.engine.last_build import NO_MODEL
from urdfsync.engine.renames import find_matching
from urdfsync.files import digest
from urdfsync.matching import Doubt
from urdfsync.state import statefile
from urdfsync.state.record import as_read

if TYPE_CHECKING:
    from urdfsync.revisions import Revision

_MOST = 50
"""So many branches are looked at."""
_BACK = 10
"""So many commits are looked at, back from the last one."""
EDITED = (Reason.KEEP, Reason.CONFLICT)
"""Reasons of files that the user edited and that stay where they are."""


def find_moved_edits(generation: Generation, actions: Iterable[Action]) -> dict[str, Doubt]:
    """Return why edited files may belong to other elements, by key: as the commits have it that they come from."""
    inputs, notes = generation.inputs, generation.inputs.last.notes
    edited = [action for action in actions if action.reason in EDITED and action.mine and " " in action.owner]
    is_same = notes.model == model_hash(inputs.last.record.snapshot)
    new = [action for action in edited if action.mine not in inputs.last.record.confirmed]
    if is_same:
        new = [action for action in new if notes.edited.get(action.path) != action.mine]
    if not new or inputs.last.version is None or git.find_top(inputs.config.root) is None:
        return {}
    doubts = dict[str, Doubt]()
    try:
        for commit in _commits(generation):
            doubts |= _look(generation, commit, new)
    except SourceError:  # a repository that git itself may not read
        return {}
    return doubts


def model_hash(snapshot: Mapping[str, Any] | None) -> str:
    """Return one hash for a model."""
    return digest(msgspec.json.encode(snapshot, order="sorted"))


def _commits(generation: Generation) -> Iterator[Revision]:
    """Yield the commits that an edit may come from: merged ones, and all branches if this machine builds here."""
    import pygit2  # 55 ms, which most builds do without

    from urdfsync.revisions import Revision, open_repository

    root = generation.inputs.config.root
    repository = open_repository(root)
    if repository is None or repository.is_empty or repository.head_is_unborn:
        return
    names = ["MERGE_HEAD", *(str(parent) for parent in repository.head.peel(pygit2.Commit).parent_ids)]
    if generation.inputs.last.notes.program:
        names += [f"HEAD~{number}" for number in range(2, _BACK)]
        names += ["ORIG_HEAD", "CHERRY_PICK_HEAD", "REBASE_HEAD"]
        names += [name for name in repository.references if name.startswith(("refs/heads/", "refs/remotes/"))][:_MOST]
    for name in names:
        try:
            yield Revision(root, name)
        except SourceError:  # there is no such commit
            continue


def _look(generation: Generation, commit: Revision, edited: Iterable[Action]) -> dict[str, Doubt]:
    """Return the edits that a commit has in the same place, and whose element has another name since its model."""
    inputs = generation.inputs
    state = inputs.store.path(inputs.last.name)
    files = {inputs.files.path(action.path): action for action in edited}
    contents = commit.contents([state, *files])
    same = [one for file, one in files.items() if file in contents and contents[file] == inputs.files.read(one.path)]
    if not same or state not in contents:
        return {}
    try:
        record, _ = statefile.loads(contents[state].decode(errors="replace"), commit.label(state))
        if record is None or record.is_united or not record.snapshot or record.snapshot == inputs.last.record.snapshot:
            return {}
        snapshot = as_read(record.snapshot, inputs.domain.model)
        matching = find_matching(inputs.domain, snapshot, generation.now.snapshot, {})
        known = inputs.domain.features(snapshot)
    except (StateError, *NO_MODEL):
        return {}
    doubts = dict[str, Doubt]()
    for action in same:
        kind, _, name = action.owner.partition(" ")
        if (kind, name) not in known:
            continue
        moved_to = matching.renames.get((kind, name), name)
        former = next((old for (one, old), new in matching.renames.items() if (one, new) == (kind, name)), "")
        if moved_to != name or former:
            doubts[action.path] = Doubt(action.owner, former, (), "" if moved_to == name else moved_to, is_certain=True)
        elif (kind, name) in matching.doubts:
            doubts[action.path] = matching.doubts[kind, name]
    return doubts

"""Texts that builds and choices replace: each is a plain file below `.urdfsync/aside/`, and can be given back.

Put aside is what a person wrote, and what this machine did not generate: that it is recorded is no proof. The list of
what can be given back forgets a text once its file is saved again and another build writes. The text itself stays.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import PurePosixPath

import msgspec

from urdfsync.diagnostics import OutputError
from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Reason
from urdfsync.engine.decide import Decision
from urdfsync.engine.generation import Generation
from urdfsync.engine.package_files import encode, state_of
from urdfsync.engine.settle import Former, Settled, known_bases
from urdfsync.files import digest
from urdfsync.state.record import FileRecord
from urdfsync.state.store import Aside


def put_aside(
    generation: Generation, decision: Decision, contents: Mapping[str, bytes | None], settled: Settled
) -> tuple[dict[str, Aside], dict[str, bytes]]:
    """Return all that can be given back after a build, by path below the package, and the new texts by file.

    `contents` are those that the build writes, by key; None for a deletion.
    """
    inputs = generation.inputs
    moved = {action.origin: action.path for action in decision.actions if action.origin and action.writes}
    index, texts = dict(_still_listed(generation, contents, settled, moved)), dict[str, bytes]()
    chosen = {key: former for key, former in settled.before.items() if key not in moved}
    chosen |= {moved[key]: former for key, former in settled.before_move.items() if key in moved}
    beside = dict(_deleted(generation, decision)) if chosen else {}
    for key, former in {**dict(_replaced(generation, decision, contents, settled)), **chosen}.items():
        path, after = PurePosixPath(inputs.folder.path(key)), contents.get(key, settled.contents.get(key))
        file = path.with_name(f"{path.stem}.{digest(former.text)[:8]}{path.suffix}").as_posix()
        sha256, bases = None if after is None else state_of(after).text_sha256, (former.record.hashes, former.bases)
        index[str(path)] = Aside(file, sha256, *bases, beside if key in chosen else {})
        texts[file] = former.text
    return index, texts


def _still_listed(
    generation: Generation, contents: Mapping[str, bytes | None], settled: Settled, moved: Mapping[str, str]
) -> Iterator[tuple[str, Aside]]:
    """Yield what could be given back before, and still can: no other choice follows, and no save before a write."""
    inputs = generation.inputs
    for path, aside in inputs.last.aside.items():
        key = inputs.folder.key(path)
        if key in settled.contents:
            continue
        try:
            state = inputs.files.state_on_disk(key)
            is_unsaved = (state.text_sha256 if state else None) == aside.after
        except OutputError:  # the user has put a link or a folder in its place
            is_unsaved = False
        if key in moved and is_unsaved:
            after = state_of(contents.get(moved[key]) or b"").text_sha256
            yield inputs.folder.path(moved[key]), msgspec.structs.replace(aside, after=after)
        elif is_unsaved or not contents:
            yield path, aside


def _deleted(generation: Generation, decision: Decision) -> Iterator[tuple[str, str]]:
    """Yield the path and text of each model that goes with a choice, since nothing needs it any more."""
    files, folder = generation.inputs.files, generation.inputs.folder
    for action in decision.actions:
        is_model = action.path.startswith(folder.key("")) and action.path.endswith(".mo")
        if is_model and action.writes and action.reason is Reason.DELETE:
            yield folder.path(action.path), files.text(action.path) or ""


def _replaced(
    generation: Generation, decision: Decision, contents: Mapping[str, bytes | None], settled: Settled
) -> Iterator[tuple[str, Former]]:
    """Yield the key and text of each file that the build itself writes over or deletes, but for what it generated."""
    inputs = generation.inputs
    for action in decision.actions:
        key, conflict = action.path, decision.disputed.get(action.path)
        if not action.writes or key not in contents or action.role is Role.ORDER or key in settled.before:
            continue
        if action.reason is Reason.MOVE:
            is_other = conflict is not None and encode(conflict.kept) != contents[key]
            if conflict is not None and is_other and action.origin not in settled.before:
                yield key, Former(encode(conflict.kept), *known_bases(conflict.kept_base))
        elif action.reason is not Reason.MOVED_AWAY:
            text = inputs.files.read_on_disk(key)
            if text not in (None, contents[key]) and state_of(text or b"").text_sha256 not in inputs.last.notes.written:
                yield key, Former(text or b"", *_bases_given_back(generation, action, text or b""))


def _bases_given_back(generation: Generation, action: Action, text: bytes) -> tuple[FileRecord, Mapping[str, str]]:
    """Return what a text is an edit of, once it is given back."""
    inputs = generation.inputs
    record = inputs.last.files.get(action.path, FileRecord())
    # else the next build would merge it again, or take it for the text that it wrote
    is_merge = (action.reason is Reason.MERGE or action.is_left_by_git) and inputs.always_merges
    is_own_base = state_of(text).text_sha256 in record.hashes
    if action.generated and action.role is not Role.IMPORT and (is_merge or is_own_base):
        return known_bases(generation.package.content(inputs.folder.path(action.path)).decode())
    return (FileRecord(), {}) if is_own_base else (record, inputs.last.bases(record))

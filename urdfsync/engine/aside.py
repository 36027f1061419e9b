"""Saves the texts that builds and choices replace: each is a plain file below `.urdfsync/aside/`, for `--undo`.

It saves each text that this machine did not generate, even if the text is recorded. The list for `--undo` drops a text
once its file is saved again and another build writes files. The saved file itself stays.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import PurePosixPath

from urdfsync.diagnostics import OutputError
from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Reason
from urdfsync.engine.decide import Decision
from urdfsync.engine.generate import Package
from urdfsync.engine.inputs import Former, Inputs
from urdfsync.engine.package_files import PackageFiles, encode, state_of
from urdfsync.engine.settle import known_bases
from urdfsync.files import digest
from urdfsync.modelica.files import class_parts
from urdfsync.state.record import FileRecord
from urdfsync.state.store import Aside


def put_aside(
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
        if key in moved and is_unsaved and (text := inputs.last.aside_text(aside.file)) is not None:
            former = Former(text, FileRecord(aside.bases), aside.texts)
            replaced.setdefault(moved[key], _follow(inputs, former, moved[key], decision.names))
        elif is_unsaved or not contents:
            index[path] = aside
    for key in settled.contents:
        index.pop(folder.path(key), None)  # another choice replaces it, or it is undone
    chosen = {
        moved.get(key, key): _follow(inputs, former, moved[key], decision.names) if key in moved else former
        for key, former in settled.before.items()
    }
    beside, texts = dict(_deleted(inputs, decision)) if chosen else {}, dict[str, bytes]()
    for key, former in {**replaced, **chosen}.items():
        place, after = PurePosixPath(folder.path(key)), contents.get(key, settled.contents.get(key))
        file = place.with_name(f"{place.stem}.{digest(former.text)[:8]}{place.suffix}").as_posix()
        sha256, bases = None if after is None else state_of(after).text_sha256, (former.record.hashes, former.bases)
        index[str(place)] = Aside(file, sha256, *bases, beside if key in chosen else {})
        texts[file] = former.text
    return index, texts


def _is_as_written(files: PackageFiles, key: str, aside: Aside) -> bool:
    """Return whether a file is unchanged since the build that put its former text aside."""
    try:
        state = files.state_on_disk(key)
    except OutputError:  # the user replaced it by a link or a folder
        return False
    return (state.text_sha256 if state else None) == aside.after


def _follow(inputs: Inputs, former: Former, key: str, names: Mapping[str, str]) -> Former:
    """Return a text and its base for the file's new path: with new names, and with its `within` clause."""
    from urdfsync.merge.renames import rename, without_clashes  # imports the parser
    from urdfsync.modelica.layout import with_within

    text, base = former.text.decode(errors="surrogateescape"), next(iter(former.bases.values()), None)
    if base is not None:
        base, text = rename(base, text, without_clashes(names, text))
    class_name = (inputs.robot.target.package, *class_parts(inputs.folder.path(key)))
    return Former(encode(with_within(text, ".".join(class_name))), *known_bases(base))


def _deleted(inputs: Inputs, decision: Decision) -> Iterator[tuple[str, str]]:
    """Yield the path and text of each model that a choice deletes because nothing needs it any more."""
    files, folder = inputs.files, inputs.folder
    for action in decision.actions:
        is_model = action.path.startswith(folder.key("")) and action.path.endswith(".mo")
        if is_model and action.writes and action.reason is Reason.DELETE:
            yield folder.path(action.path), files.text(action.path) or ""


def _replaced(
    inputs: Inputs, package: Package, decision: Decision, contents: Mapping[str, bytes | None]
) -> Iterator[tuple[str, Former]]:
    """Yield the key and text of each replaced or deleted file; leave out texts that this machine generated.

    A `package.order` is saved only after a union by git: then a build may remove more than its recorded lines.
    """
    files, last, folder = inputs.files, inputs.last, inputs.folder.key("")
    origins = {action.origin for action in decision.actions if action.origin and action.writes}
    for action in decision.actions:
        key, is_moving = action.path, action.reason is Reason.MOVE
        if not action.writes or key not in contents or (key in origins and not is_moving):
            continue  # the user's text moves to another file
        if action.role is Role.ORDER and not (last.record.is_united and key.startswith(folder)):
            continue
        text = files.read(action.origin or key) if is_moving else files.read_on_disk(key)
        if text is None or state_of(text).text_sha256 in last.notes.written:
            continue
        former = Former(text, *_bases_given_back(inputs, package, action, text))
        if is_moving:
            former = _follow(inputs, former, key, decision.names)
        if former.text != contents[key]:
            yield key, former


def _bases_given_back(
    inputs: Inputs, package: Package, action: Action, text: bytes
) -> tuple[FileRecord, Mapping[str, str]]:
    """Return the bases that a text has after `--undo`."""
    place = (action.origin or "") if action.reason is Reason.MOVE else action.path
    record = inputs.last.files.get(place, FileRecord())
    # with the old base, the next build would merge the text again, or take it for a generated one
    is_merge = (action.reason is Reason.MERGE or action.is_left_by_git) and inputs.always_merges
    is_own_base = state_of(text).text_sha256 in record.hashes
    if action.generated and action.role is not Role.IMPORT and (is_merge or is_own_base):
        return known_bases(package.content(inputs.folder.path(action.path)).decode())
    return (FileRecord(), {}) if is_own_base else (record, inputs.last.bases(record))

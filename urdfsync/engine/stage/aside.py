"""Puts texts aside that a build replaces, and that this machine did not generate.

`.urdfsync/aside` has a copy of each, for `--undo`. Once the user saves a text's file, and a build writes files, the
list drops the text; the copy stays.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import PurePosixPath

import msgspec

from urdfsync.common.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.common.files import digest, shown
from urdfsync.common.spelling import counted
from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Actions, Reason, find_left_paths
from urdfsync.engine.decide.decision import Decision
from urdfsync.engine.decide.settle import known_base
from urdfsync.engine.inspect.inputs import Inputs, Replaced
from urdfsync.engine.inspect.package_files import PackageFiles, bare_hash, encode, text_hash
from urdfsync.engine.package.generate import Package
from urdfsync.modelica.files import class_parts
from urdfsync.modelica.stamp import split, with_stamp
from urdfsync.project.state.record import role_of
from urdfsync.project.state.store import Aside


def put_aside(
    inputs: Inputs, package: Package, decision: Decision, contents: Mapping[str, bytes | None]
) -> tuple[dict[str, Aside], dict[str, bytes]]:
    """Return the saved texts after a build, by path below the package, and the new texts by file.

    `contents` are the texts that the build writes, by key; None for a deletion.
    """
    folder, settled = inputs.folder, inputs.settled
    moved = {action.origin: action.path for action in decision.actions if action.origin and action.writes}

    def path_of(key: str) -> str:  # a package that is to move is still in its former folder while conflicts wait
        return folder.path(inputs.last.folder.path(key))

    index, replaced = dict[str, Aside](), dict(_replaced(inputs, package, decision, contents))
    for path, aside in inputs.last.aside.items():
        key = inputs.last.folder.key(path)  # the package may have moved since
        is_unsaved = _is_as_written(inputs.files, key, aside)
        if key in moved and is_unsaved and (text := inputs.store.aside_text(inputs.last.name, aside.file)) is not None:
            former = Replaced(text, aside.base)
            replaced.setdefault(moved[key], _follow(inputs, former, moved[key], decision.names))
        elif is_unsaved or not contents:
            index[path] = aside
    for key in settled.contents:
        index.pop(path_of(key), None)  # another choice replaces this text, or this text was restored
    chosen = {
        moved.get(key, key): _follow(inputs, former, moved[key], decision.names) if key in moved else former
        for key, former in settled.before.items()
    }
    edited = {action.origin for action in decision.actions if action.reason is Reason.MOVE}
    deleted = find_left_paths(decision.actions) - edited if chosen else set[str]()
    models = (key for key in sorted(deleted) if key.startswith(folder.key("")) and key.endswith(".mo"))
    contents_of = ((key, inputs.files.read(key) or b"") for key in models)
    beside = {folder.path(key): content.decode(errors="replace") for key, content in contents_of}
    texts = dict[str, bytes]()
    for key, former in {**replaced, **chosen}.items():
        place, after = PurePosixPath(path_of(key)), contents.get(key, settled.contents.get(key))
        file = place.with_name(f"{place.stem}.{digest(former.text)[:8]}{place.suffix}").as_posix()
        sha256 = None if after is None else bare_hash(after)
        index[str(place)] = Aside(file, sha256, former.base, beside if key in chosen else {}, former.doubt)
        texts[file] = former.text
    return index, texts


def tell_aside(
    inputs: Inputs, actions: Actions, index: Mapping[str, Aside], texts: Mapping[str, bytes]
) -> tuple[Diagnostic, ...]:
    """Return a note if the build replaces texts that this machine did not generate, without the user's choice."""
    told, chosen = (Reason.MERGE, Reason.MOVE, Reason.UNDO), inputs.settled.actions.keys()
    saved = {inputs.last.folder.key(path) for path in inputs.last.aside}  # such a text moves with its file
    known = {
        inputs.folder.path(one.path)
        for one in actions
        if one.reason in told or {one.path, one.origin} & chosen or one.origin in saved
    }
    new = sorted(path for path, aside in index.items() if aside.file in texts and path not in known)
    if not new:
        return ()
    file, be = shown(inputs.files.path(inputs.folder.key(new[0]))), "is" if len(new) == 1 else "are"
    what = f"{counted(len(new), 'text')} that this machine did not generate"
    message = f"a build replaces {what}" if inputs.options.dry else f"{what} {be} replaced"
    place = shown(inputs.store.aside_file(inputs.robot.name).parent)
    hint = f"copies {'will be' if inputs.options.dry else 'are'} below {place}"
    if any(role_of(path) is not Role.IMPORT for path in new):
        hint += "; `resolve FILE --undo` brings one back"
    return (Diagnostic(Severity.NOTE, "put-aside", message, file, hint=hint),)


def _is_as_written(files: PackageFiles, key: str, aside: Aside) -> bool:
    """Return whether a file is unchanged since the build that saved its former text in `aside`."""
    try:
        state = files.state_on_disk(key)
    except OutputError:  # the user replaced it by a link or a folder
        return False
    return (state.text_sha256 if state else None) == aside.after


def _follow(inputs: Inputs, former: Replaced, key: str, names: Mapping[str, str]) -> Replaced:
    """Return a text and its base for the file's new path: with new names, and a new `within` clause."""
    from urdfsync.merge.renames import rename, without_clashes  # imports the parser
    from urdfsync.modelica.layout import with_within

    text, stamp = split(former.text.decode(errors="surrogateescape"))
    base = next(iter(former.base.values()), None)
    if base is not None:
        base, text = rename(base, text, without_clashes(names, text))
    class_name = (inputs.robot.target.package, *class_parts(inputs.folder.path(key)))
    known = known_base(base)
    stamp = stamp and stamp._replace(base=next(iter(known), stamp.base))
    return Replaced(with_stamp(encode(with_within(text, ".".join(class_name))), stamp), known)


def _replaced(
    inputs: Inputs, package: Package, decision: Decision, contents: Mapping[str, bytes | None]
) -> Iterator[tuple[str, Replaced]]:
    """Yield the key and the former text of each replaced or deleted file; leave out texts that this machine generated.

    A `package.order` is saved only if git has united two states: then a build may remove the user's lines.
    """
    files, last, folder = inputs.files, inputs.last, inputs.folder.key("")
    writing = [action for action in decision.actions if action.writes]
    moving = {action.origin for action in writing if action.reason is Reason.MOVE}
    origins = [
        msgspec.structs.replace(one, path=one.origin, generated=None)
        for one in writing
        if one.origin not in (None, *moving, *inputs.settled.before)
    ]
    for action in (*writing, *origins):
        key, is_moving = action.path, action.reason is Reason.MOVE
        if key not in contents or (key in moving and not is_moving):
            continue  # the user's text moves to another file
        if action.role is Role.ORDER and not (last.is_united and key.startswith(folder)):
            continue
        place = (action.origin or key) if is_moving else key
        base = last.base_of(place, action.role)
        state = files.state(place) if is_moving else files.state_on_disk(key)
        # a mesh is no text: bytes that look like line ends count
        if state is None or (base in last.notes.written and base in (state.sha256, state.text_sha256)):
            continue
        text = files.read(place) if is_moving else files.read_on_disk(key)
        if text is None:  # somebody has just deleted it
            continue
        former = Replaced(text, known_base(last.base(base)))
        if is_moving:
            former = _follow(inputs, former, key, decision.names)
        new, is_import = contents[key], action.role is Role.IMPORT
        if former.text != new and (new is None or is_import or bare_hash(former.text) != bare_hash(new)):
            yield key, former if is_import else _given_back(inputs, package, action, former)


def _given_back(inputs: Inputs, package: Package, action: Action, former: Replaced) -> Replaced:
    """Return a text with the base that it has after `--undo`."""
    # with the old base, the next build would merge the text again, unless only this command merges; or would take it
    # for generated
    is_merge = action.reason in (Reason.MERGE, Reason.MOVE) or action.is_left_by_git
    text, stamp = split(former.text.decode(errors="surrogateescape"))
    is_own_base = stamp is not None and text_hash(text) == stamp.base
    if stamp and action.generated and (is_own_base or (is_merge and inputs.robot.on_conflict == "merge")):
        base = known_base(package.content(inputs.folder.path(action.path)).decode())
        return Replaced(with_stamp(former.text, stamp._replace(base=action.generated)), base)
    return Replaced(with_stamp(former.text, None), {}) if is_own_base else former

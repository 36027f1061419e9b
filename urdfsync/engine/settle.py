"""Applies the user's choices: each one changes its file, at the file's present path, and its base.

The user could do the same by hand: save a text, and name the generated text that it takes into account. So choices
change files and bases first, and the build then decides on these. It writes both together.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import msgspec

from urdfsync.diagnostics import ConfigError, OutputError
from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Actions, Choice, Reason, UsersChoice
from urdfsync.engine.conflicts import Conflict, over_bases
from urdfsync.engine.decide import Decision
from urdfsync.engine.generation import Generation
from urdfsync.engine.inputs import Inputs
from urdfsync.engine.package_files import PackageFiles, encode, text_hash, with_line_ends
from urdfsync.engine.package_names import names_of
from urdfsync.files import shown
from urdfsync.modelica.files import class_parts
from urdfsync.modelica.markers import find_markers
from urdfsync.spelling import nearest
from urdfsync.state.record import FileRecord, role_of

_EDITED = frozenset({Reason.KEEP, Reason.INCLUDED, Reason.MOVE, Reason.MERGE})
"""Actions on edited files that the user may replace by the generated ones."""


class Former(NamedTuple):
    """A replaced text, and its base."""

    text: bytes
    record: FileRecord
    bases: Mapping[str, str]
    """Texts of its known bases, by hash."""


class Settled(msgspec.Struct):
    """The files that choices have changed, by their present keys."""

    actions: dict[str, Action] = msgspec.field(default_factory=dict)
    contents: dict[str, bytes | None] = msgspec.field(default_factory=dict)
    """New contents; None for no file."""
    bases: dict[str, FileRecord] = msgspec.field(default_factory=dict)
    texts: dict[str, str] = msgspec.field(default_factory=dict)
    """Texts of bases that earlier choices put aside, by hash."""
    generated: set[str] = msgspec.field(default_factory=set)
    """Hashes of generated texts that `--undo` brings back."""
    before: dict[str, Former] = msgspec.field(default_factory=dict)
    """Texts before the choices."""
    names: Mapping[str, str] = {}
    """New names by old ones, before the choices."""
    keys: set[str] = msgspec.field(default_factory=set)
    """Keys of the choices that were applied."""

    def add(
        self, inputs: Inputs, action: Action, content: bytes | None, record: FileRecord, reason: Reason, choice: Choice
    ) -> None:
        """Add the new content and base that a choice gives a file."""
        key = action.origin or action.path
        mine, former = inputs.files.read_on_disk(key), inputs.last.files.get(key, FileRecord())
        if mine is not None and (choice is not Choice.UNDO or content != mine):  # otherwise nothing changes
            self.before[key] = Former(mine, former, inputs.last.bases(former))
        self.contents[key], self.bases[key] = content, record
        changes = {"path": key, "origin": None, "reason": reason, "choice": choice, "is_waiting": False}
        self.actions[key] = msgspec.structs.replace(action, **changes)


def settle(generation: Generation, decision: Decision) -> Settled:
    """Apply the choices of the options.

    A choice is ignored if one of its two texts changed since then, or if it does not fit its file. Raises OutputError
    for `--keep` on a file with markers of git.
    """
    settled = Settled(names=decision.names)
    choices, folder = generation.inputs.options.choices, generation.inputs.folder
    by_path = {action.path: action for action in decision.actions}
    for key, chosen in choices.items():
        role = role_of(folder.path(key))
        action = by_path.get(key, Action(key, Reason.FORGET, role))  # such as a deleted file
        if chosen.sides == action.sides and _settle(generation, decision, action, chosen, settled):
            settled.keys.add(key)
    return settled


def _settle(generation: Generation, decision: Decision, action: Action, chosen: UsersChoice, settled: Settled) -> bool:
    """Apply one choice; return whether it fits its file."""
    inputs, choice, key = generation.inputs, chosen.choice, action.origin or action.path
    reason, record = Reason.KEEP, FileRecord((action.generated,) if action.generated else ())
    content = mine = inputs.files.read_on_disk(key)
    conflict = decision.disputed.get(action.path)
    if choice is Choice.MOVED:
        return action.reason is Reason.ASKED and _move(generation, decision, action, chosen.text, settled)
    if choice is Choice.UNDO:
        aside = inputs.last.aside.get(inputs.folder.path(key))
        if aside is None or action.role is Role.IMPORT or inputs.files.hash(key, action.role) != aside.after:
            return False
        content, reason = inputs.last.aside_text(aside.file), Reason.UNDO
        if content is None:
            return False
        record = FileRecord(aside.bases)
        settled.texts.update(aside.texts)
        for path, model in aside.beside.items():
            if (place := inputs.folder.key(path)) not in settled.contents and inputs.files.read(place) is None:
                settled.contents[place] = encode(model)
                settled.bases[place], texts = known_bases(model)
                settled.texts.update(texts)
                settled.generated |= texts.keys()
    elif action.reason is Reason.ORPHAN and choice in (Choice.KEEP, Choice.TAKE):
        if choice is Choice.TAKE:
            content, reason, record = None, Reason.DELETE, inputs.last.files.get(key, FileRecord())
    elif choice is Choice.TAKE and action.mine is not None and (action.is_conflict or action.reason in _EDITED):
        content, reason = _generated(generation, action, mine or b""), Reason.UPDATE
        if content is None:
            return False
    elif not (action.is_conflict or conflict):
        return False
    elif choice is Choice.KEEP:
        content = inputs.files.read(key)
        if action.reason is Reason.ASKED:  # the user says that it is the same part: later exports still merge into it
            record = inputs.last.files.get(key, record)
        if conflict and action.origin:
            from urdfsync.merge.renames import rename, without_clashes  # imports the parser

            # the file gets its new names once it moves
            names = {new: old for old, new in without_clashes(decision.names, conflict.mine).items()}
            from urdfsync.modelica.layout import with_within  # imports the parser

            package = ".".join((inputs.last.target.package, *class_parts(inputs.last.folder.path(key))))
            record, texts = known_bases(with_within(rename(conflict.generated, "", names)[0], package))
            settled.texts.update(texts)
        if markers := find_markers((content or b"").decode(errors="replace")):
            message, hint = "unresolved merge markers", "settle them in the file, then build again"
            raise OutputError.of("merge-markers", message, shown(inputs.files.path(key)), markers[0][1], hint=hint)
    elif choice is not Choice.TAKE and conflict:
        text = chosen.text if choice is Choice.EDIT else conflict.merged(choice)
        if text is None:
            return False
        content, reason = encode(text), Reason.KEEP if text == conflict.mine else Reason.MERGE
    else:
        return False
    settled.add(inputs, action, content, record, reason, choice)
    return True


def _move(generation: Generation, decision: Decision, action: Action, named: str | None, settled: Settled) -> bool:
    """Move an edit to the file of another element, by default the likely one. Raises ConfigError if it can't move.

    An edit may move to a file that another edit leaves in the same command.
    """
    inputs, (kind, _, name), key = generation.inputs, action.owner.partition(" "), action.path
    conflict, choices = decision.disputed[key], inputs.options.choices
    new = named or conflict.moved_to
    path = _find_target(generation, action, new)
    target, sha256 = inputs.folder.key(path), generation.package.hash(path)
    is_leaving = target in choices and choices[target].choice is Choice.MOVED
    is_asked = any(one.path == target and one.reason is Reason.ASKED for one in decision.actions)
    message = ""
    if is_asked and not is_leaving:
        message, hint = "its edit may belong to another part, too", "settle it first, or name both files with --moved"
    elif inputs.files.read(f"{target.removesuffix('.mo')}/package.mo") or inputs.files.read(key) is None:
        message, hint = "one of the two classes is a folder", "move the edit by hand, then use --keep"
    elif target in generation.moves.values():
        message, hint = "its own text moves to another file", "build first, then move the edit by hand"
    if message:
        raise ConfigError.of("wrong-rename", message, shown(inputs.files.path(target)), hint=hint)
    last, mine = inputs.last.files.get(target, FileRecord()), inputs.files.hash(target, action.role)
    is_edited = mine not in (None, sha256, *last.hashes) and not is_leaving
    text = (inputs.files.text(target) or "") if is_edited else generation.package.content(path).decode()
    if target in settled.contents:
        text = (settled.contents[target] or b"").decode()
    merged = _merge_into(generation, conflict, f"{kind}s", name, new, text)
    if merged is None:
        message, hint = "your edit does not fit into this file", "move the edit by hand, then use --take"
        raise ConfigError.of("wrong-rename", message, shown(inputs.files.path(target)), hint=hint)
    if key not in settled.contents:  # otherwise another edit has moved here already
        source = _generated(generation, action, inputs.files.read(key) or b"")
        settled.add(inputs, action, source, FileRecord((str(action.generated),)), Reason.UPDATE, Choice.MOVED)
    content = with_line_ends(encode(merged), inputs.files.read(target) or b"")
    other = Action(target, Reason.MERGE, action.role, f"{kind} {new}", generated=sha256, mine=mine)
    settled.add(inputs, other, content, last if is_edited else FileRecord((sha256,)), Reason.MERGE, Choice.MOVED)
    return True


def _find_target(generation: Generation, action: Action, new: str) -> str:
    """Return the path of the corresponding file of the element `new`. Raises ConfigError if there is none."""
    inputs, (kind, _, name) = generation.inputs, action.owner.partition(" ")
    path = generation.package.find_like(inputs.folder.path(action.path), f"{kind} {new}")
    known = {known for one, known in generation.elements_now if one == kind}
    near, message = nearest(new, sorted(known - {name})), ""
    hint = "name the part that the edit belongs to: --moved NAME"
    if not name:
        message, hint = "it belongs to no single part", "change the names in it, then use --keep"
    elif not new:
        message = "the part to which the edit belongs is unknown"
    elif new == name:
        message = f"it belongs to {kind} `{name}` already"
    elif new not in known:
        message, hint = f"the source has no {kind} `{new}`", f"did you mean `{near}`?" if near else hint
    elif path is None:
        message = f"{kind} `{new}` has no such file"
    if message or path is None:
        raise ConfigError.of("wrong-rename", message, shown(inputs.files.path(action.path)), hint=hint)
    return path


def _merge_into(generation: Generation, conflict: Conflict, kind: str, old: str, new: str, text: str) -> str | None:
    """Merge the edit of another element's file into a text, with the names of this text; None for a contradiction."""
    from urdfsync.merge import merge  # imports the parser
    from urdfsync.modelica.lexer import words_in

    record = generation.inputs.last.files.get(conflict.path, FileRecord())
    bases = [*generation.inputs.last.bases(record).values()] or [conflict.generated]
    edits = over_bases(bases, conflict.mine, is_modelica=True) or [(bases[0], conflict.mine)]
    base, mine = edits[0]
    identifiers = generation.inputs.domain.names(generation.now.snapshot, generation.inputs.robot.target)[kind]
    names = names_of(generation, {identifiers[old]: identifiers[new]}, frozenset(words_in(base)))
    merged = merge(base, mine, text, is_modelica=True, names=names)
    return None if merged.flaw else merged.text


def _generated(generation: Generation, action: Action, mine: bytes) -> bytes | None:
    """Return the generated content of a file; None for an imported file whose source is missing."""
    path = generation.inputs.folder.path(action.path)
    if action.role is Role.IMPORT:
        return generation.imported.contents.get(path)
    return with_line_ends(generation.package.content(path), mine)


def known_bases(base: str | None) -> tuple[FileRecord, Mapping[str, str]]:
    """Return a record with this base, and the base's text by its hash."""
    texts = {} if base is None else {text_hash(base): base}
    return FileRecord(tuple(texts)), texts


def with_choices(generation: Generation, settled: Settled) -> Generation:
    """Return the robot with the files and bases that choices have changed."""
    inputs = generation.inputs
    files, left = PackageFiles(inputs.config, inputs.robot), inputs.files.left_by_git
    files.overlay = {**inputs.files.overlay, **settled.contents}
    files.left_by_git = {key: left[key] for key in left.keys() - settled.contents.keys()}
    recorded = {**inputs.last.record.files, **settled.bases}
    record = msgspec.structs.replace(
        inputs.last.record, files={key: file for key, file in recorded.items() if file.hashes}
    )
    notes = msgspec.structs.replace(inputs.last.notes, written=inputs.last.notes.written | settled.generated)
    last = msgspec.structs.replace(inputs.last, record=record, notes=notes, texts=settled.texts, _files=files)
    inputs = msgspec.structs.replace(inputs, files=files, last=last)
    return msgspec.structs.replace(generation, inputs=inputs)


def actions_after(actions: Actions, settled: Settled) -> Actions:
    """Return the actions of the choices and of the build together."""
    after = {action.path: action for action in actions}
    for key, chosen in settled.actions.items():
        decided = after.get(key)
        if decided and (decided.is_conflict or decided.writes):
            after[key] = msgspec.structs.replace(decided, choice=chosen.choice)
        else:
            after[key] = chosen
    return Actions(after.values())

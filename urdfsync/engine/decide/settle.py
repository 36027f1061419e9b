"""Applies the user's choices: each choice changes a file, at its present path, and the file's base.

The user could do the same by hand: save a text, and name its base. So choices change files and bases first. Then the
build decides on the changed files, and writes all together.
"""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from urdfsync.common.diagnostics import ConfigError, Diagnostic, OutputError, Severity
from urdfsync.common.files import shown
from urdfsync.common.spelling import nearest
from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Choice, Reason, UsersChoice
from urdfsync.engine.decide.conflicts import Conflict
from urdfsync.engine.decide.decision import Decision
from urdfsync.engine.decide.package_names import names_of
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs, Replaced, Settled
from urdfsync.engine.inspect.package_files import bare_hash, encode, text_hash, with_line_ends
from urdfsync.modelica.files import class_parts
from urdfsync.modelica.markers import find_markers
from urdfsync.modelica.stamp import Stamp, split, with_stamp
from urdfsync.project.state.record import role_of

_EDITED = frozenset({Reason.KEEP, Reason.MOVE, Reason.MERGE})
"""Reasons of actions on edited files for which the user may choose `--take`."""


def settle(inputs: Inputs, generation: Generation, decision: Decision) -> Settled:
    """Apply the choices of the options.

    A choice is ignored if one of the two texts has changed, or if the texts do not merge. Raises OutputError if another
    choice has no effect, so nothing is written, and for `--keep` on a file with markers of git.
    """
    choices, wanted = _Choices(inputs, generation, decision), dict(inputs.options.choices)
    by_path, refused = {action.path: action for action in decision.actions}, list[Diagnostic]()
    if inputs.options.adopts:
        unowned = (one for one in decision.actions if one.reason is Reason.UNOWNED)
        wanted |= {one.path: UsersChoice(Choice.KEEP, one.sides) for one in unowned}
    for key, chosen in wanted.items():
        role = role_of(inputs.folder.path(key))
        action = by_path.get(key, Action(key, Reason.FORGET, role))  # the decision lacks a deleted file, for example
        if chosen.sides == action.sides:
            if choices.apply(action, chosen):
                choices.settled.keys.add(key)
            elif chosen.choice in (Choice.UNDO, Choice.MOVED) or not (action.is_conflict or action.is_left_by_git):
                refused.append(_without_effect(chosen.choice, action, shown(inputs.files.path(action.present))))
    if refused:
        raise OutputError(*refused)
    return choices.settled


def _without_effect(choice: Choice, action: Action, place: str) -> Diagnostic:
    """Return why a choice has no effect on a file."""
    code, message, hint = "no-conflict", "the file has no conflict", "see `urdfsync status`"
    if choice is Choice.UNDO:
        code, hint = "no-undo", "texts that were replaced are below .urdfsync/aside"
        message = "nothing to undo: nothing was replaced here, or the file has changed since"
    elif action.is_conflict:
        code, hint = "wrong-rename", "choose again: `urdfsync status` lists the choices"
        message = "--moved is only for an edit that may belong to another part"
    elif action.present.endswith("/package.mo") and not action.is_on_disk:
        more = " and build to get the generated file" if action.generated else ""
        message, hint = "you turned the class into a folder", f"delete the folder{more}"
    elif action.reason is Reason.ORPHAN:
        code, message = "no-merge", "the file is no longer generated: there is nothing to merge"
        hint = "make it yours with --keep, or delete it with --take"
    elif action.is_waiting:
        message, hint = "the file waits for other conflicts, and has none", "settle these first: see `urdfsync status`"
    return Diagnostic(Severity.ERROR, code, message, place, hint=hint)


class _Choices:
    """The choices that were applied so far: each choice sees the changes by earlier choices."""

    def __init__(self, inputs: Inputs, generation: Generation, decision: Decision) -> None:
        self._inputs, self._generation, self._decision = inputs, generation, decision
        self.settled = Settled(names=decision.names)

    def apply(self, action: Action, chosen: UsersChoice) -> bool:
        """Apply one choice; return whether the choice fits its file."""
        match chosen.choice:
            case Choice.MOVED:
                is_second = action.reason is Reason.SECOND and not chosen.text
                return (is_second or action.reason is Reason.ASKED) and self._move(action, chosen.text)
            case Choice.UNDO:
                return self._undo(action)
            case Choice.KEEP:
                return self._keep(action)
            case Choice.TAKE:
                return self._take(action, chosen)
            case _:
                return self._merge(action, chosen)

    def _undo(self, action: Action) -> bool:
        """Give back the text that a build replaced, unless the user has saved the file since."""
        inputs, settled, role = self._inputs, self.settled, action.role
        # the text of another file may be about to move to this path: the user means the file that is there now
        for key in filter(None, (action.path, action.origin)):
            aside = inputs.last.aside.get(inputs.last.folder.path(key))
            if aside is not None and role is not Role.IMPORT and inputs.files.hash(key, role) == aside.after:
                break
        else:
            return False
        content = inputs.store.aside_text(inputs.last.name, aside.file)
        if content is None:
            return False
        settled.texts.update(aside.base)
        settled.doubts |= {key: aside.doubt} if aside.doubt else {}
        for path, model in aside.beside.items():
            if (place := inputs.folder.key(path)) not in settled.contents and inputs.files.read(place) is None:
                settled.contents[place] = encode(model)
                settled.texts.update(known_base(split(model)[0]))
        there = msgspec.structs.replace(action, path=key, origin=None)
        self._add(there, content, Reason.UNDO, Choice.UNDO)
        return True

    def _keep(self, action: Action) -> bool:
        """Keep the user's text; the generated text becomes its base, so only later exports conflict again."""
        inputs, key = self._inputs, action.origin or action.path
        conflict = self._decision.disputed.get(action.path)
        if action.reason is Reason.ORPHAN:
            self._add(action, self._stamped(action, inputs.files.read_on_disk(key), None), Reason.KEEP, Choice.KEEP)
            return True
        if not (action.is_conflict or action.lacks_stamp):
            return False
        base, content = action.generated, inputs.files.read(key)
        if action.reason is Reason.ASKED:  # the user says that the part is the same: later exports still merge
            base = inputs.last.base_of(key, action.role) or base
        if conflict and action.origin:
            base = self._former_base(action, conflict)
        if markers := find_markers((content or b"").decode(errors="replace")):
            message, hint = "unresolved merge markers", "settle them in the file, then build again"
            raise OutputError.of("merge-markers", message, shown(inputs.files.path(key)), markers[0][1], hint=hint)
        if content is None:  # the class is a folder
            place = f"{key.removesuffix('.mo')}/package.mo"
            self.settled.contents[place] = self._stamped(action, inputs.files.read(place), base)
        self._add(action, self._stamped(action, content, base), Reason.KEEP, Choice.KEEP)
        return True

    def _take(self, action: Action, chosen: UsersChoice) -> bool:
        """Take the generated text, or delete a file that is not generated any more."""
        inputs, key = self._inputs, action.origin or action.path
        if action.reason is Reason.ORPHAN and not action.is_on_disk:
            return False  # the class is a folder, which may have other classes
        if action.reason in (Reason.ORPHAN, Reason.SECOND):
            self._add(action, None, Reason.DELETE, Choice.TAKE)
            return True
        if action.mine is None or not (action.is_conflict or action.reason in _EDITED):
            return False
        if action.generated is None:  # a class of the user's own: its text with new names is proposed
            return self._merge(action, msgspec.structs.replace(chosen, choice=Choice.MERGE))
        base, mine = action.generated, inputs.files.read_on_disk(key) or b""
        content = self._generation.content(inputs.folder.path(action.path), action.role, mine)
        conflict = self._decision.disputed.get(action.path)
        if conflict and action.origin:
            base = self._former_base(action, conflict)
            content = with_line_ends(encode(self._with_former_names(action, conflict, conflict.generated)), mine)
        if content is None:
            return False
        self._add(action, self._stamped(action, content, base), Reason.UPDATE, Choice.TAKE)
        return True

    def _merge(self, action: Action, chosen: UsersChoice) -> bool:
        """Take a merge of both sides, or the text that the user has edited."""
        conflict, key = self._decision.disputed.get(action.path), action.origin or action.path
        if conflict is None or action.reason in (Reason.MOVE, Reason.SECOND):
            return False
        text = chosen.text if chosen.choice is Choice.EDIT else conflict.merged(chosen.choice)
        if text is None:
            return False
        base = action.generated
        if conflict.is_of_branches:  # the text was merged with no generated one: the build does that next
            base = self._inputs.last.base_of(key, action.role) or base
            doubts = self._decision.doubts
            self.settled.doubts |= {key: doubts[key]} if key in doubts else {}  # the question comes after git's markers
        elif action.origin:
            base, text = self._former_base(action, conflict), self._with_former_names(action, conflict, text)
        reason = Reason.KEEP if text == conflict.mine else Reason.MERGE
        self._add(action, self._stamped(action, encode(text), base), reason, chosen.choice)
        return True

    def _with_former_names(self, action: Action, conflict: Conflict, text: str) -> str:
        """Return a text for the present path of a file that moves: other conflicts may keep the file there."""
        from urdfsync.merge.renames import rename, without_clashes  # imports the parser
        from urdfsync.modelica.layout import with_within

        last, key = self._inputs.last, action.origin or action.path
        names = {new: old for old, new in without_clashes(self._decision.names, conflict.mine).items()}
        return with_within(
            rename(text, "", names)[0], ".".join((last.target.package, *class_parts(last.folder.path(key))))
        )

    def _former_base(self, action: Action, conflict: Conflict) -> str:
        """Return the hash of the generated text as it would be at the present path of a file that moves."""
        former = known_base(self._with_former_names(action, conflict, conflict.generated))
        self.settled.texts.update(former)
        return next(iter(former))

    def _stamped(self, action: Action, content: bytes | None, base: str | None) -> bytes | None:
        """Return the content with the stamp of the action's file; without a base, the text becomes the user's own."""
        file_id = self._decision.differences.ids.get(self._inputs.folder.path(action.path))
        if action.role is Role.IMPORT:
            self.settled.bases[action.path] = base
        if content is None or action.role is Role.IMPORT:
            return content
        return with_stamp(content, Stamp(file_id, base) if file_id and base else None)

    def _add(self, action: Action, content: bytes | None, reason: Reason, choice: Choice) -> None:
        """Add the new content of a file after a choice."""
        key, last, settled = action.origin or action.path, self._inputs.last, self.settled
        mine = self._inputs.files.read_on_disk(key)
        is_same = mine is not None and content is not None and bare_hash(mine) == bare_hash(content)
        if mine is not None and not (choice is Choice.UNDO and is_same):
            doubt = self._decision.doubts.get(action.path)
            settled.before[key] = Replaced(mine, known_base(last.base(last.base_of(key, action.role))), doubt)
        settled.contents[key] = content
        changes = {"path": key, "origin": None, "reason": reason, "choice": choice, "is_waiting": False}
        settled.actions[key] = msgspec.structs.replace(action, **changes)

    def _move(self, action: Action, named: str | None) -> bool:
        """Move an edit to another element's file, by default the likely one's; a second edit of a part to its file.

        Raises ConfigError for an impossible move. If another edit leaves a file in the same command, this edit may move
        there.
        """
        inputs, decision, settled, package = self._inputs, self._decision, self.settled, self._generation.package
        (kind, _, name), key, choices = action.owner.partition(" "), action.path, inputs.options.choices
        conflict = decision.disputed[key]
        if action.reason is Reason.SECOND:
            path, renamed = action.copy_of, decision.differences.former
        else:
            new = named or conflict.moved_to
            path = self._find_target(action, new)
            names = inputs.domain.names(self._generation.now.snapshot, inputs.robot.target)[f"{kind}s"]
            renamed = {names[name]: names[new]}
        target, sha256 = inputs.folder.key(path), package.hash(path)
        is_leaving = target in choices and choices[target].choice is Choice.MOVED
        is_asked = any(one.path == target and one.reason is Reason.ASKED for one in decision.actions)
        message = ""
        if is_asked and not is_leaving:
            message = "your edit in this file may belong to another part, too"
            hint = "settle this file first, or name both files with --moved"
        elif inputs.files.read(f"{target.removesuffix('.mo')}/package.mo") or inputs.files.read(key) is None:
            message, hint = "one of the two classes is a folder", "move the edit by hand, then use --keep"
        elif target in decision.differences.moves.values():
            message, hint = "this file's own text moves to another file", "build first, then move the edit by hand"
        if message:
            raise ConfigError.of("wrong-rename", message, shown(inputs.files.path(target)), hint=hint)
        base, mine = inputs.last.base_of(target, action.role), inputs.files.hash(target, action.role)
        is_edited = mine not in (None, sha256, base) and not is_leaving
        text = (inputs.files.text(target) or "") if is_edited else package.content(path).decode()
        if target in settled.contents:
            text = (settled.contents[target] or b"").decode()
        is_lost = action.reason is Reason.SECOND and conflict.base is None
        merged = None if is_lost else self._merge_into(conflict, renamed, text)
        if merged is None:
            message, hint = "your edit contradicts this file", "move the edit by hand, then use --take"
            raise ConfigError.of("wrong-rename", message, shown(inputs.files.path(target)), hint=hint)
        if key not in settled.contents:  # another edit may have moved here already
            mine_bytes = inputs.files.read(key) or b""
            source, reason = None, Reason.DELETE
            if action.generated:
                source = self._generation.content(inputs.folder.path(key), action.role, mine_bytes)
                reason = Reason.UPDATE
            self._add(action, self._stamped(action, source, action.generated), reason, Choice.MOVED)
        content = with_line_ends(encode(merged), inputs.files.read(target) or b"")
        other = Action(target, Reason.MERGE, action.role, package.owners[path], generated=sha256, mine=mine)
        stamped = self._stamped(other, content, base if is_edited else sha256)
        self._add(other, stamped, Reason.MERGE, Choice.MOVED)
        return True

    def _find_target(self, action: Action, new: str) -> str:
        """Return the path of the corresponding file of the element `new`. Raises ConfigError if there is none."""
        inputs, generation, (kind, _, name) = self._inputs, self._generation, action.owner.partition(" ")
        path = generation.package.find_like(inputs.folder.path(action.path), f"{kind} {new}")
        known = {known for one, known in inputs.domain.features(generation.now.snapshot) if one == kind}
        near, message = nearest(new, sorted(known - {name})), ""
        hint = "name the part that the edit belongs to: --moved NAME"
        if not name:
            message, hint = "this file belongs to no single part", "change the names in the file, then use --keep"
        elif not new:
            message = "the part to which the edit belongs is unknown"
        elif new == name:
            message = f"this file belongs to {kind} `{name}` already"
        elif new not in known:
            message, hint = f"the source has no {kind} `{new}`", f"did you mean `{near}`?" if near else hint
        elif path is None:
            message = f"{kind} `{new}` has no such file"
        if message or path is None:
            raise ConfigError.of("wrong-rename", message, shown(inputs.files.path(action.path)), hint=hint)
        return path

    def _merge_into(self, conflict: Conflict, renamed: Mapping[str, str], text: str) -> str | None:
        """Merge the edit of another file into a text, with new identifiers (`renamed`); None for a contradiction."""
        from urdfsync.merge.texts import merge  # imports the parser
        from urdfsync.modelica.lexer import words_in

        base = conflict.generated if conflict.base is None else conflict.base
        names = names_of(self._inputs, self._generation, renamed, frozenset(words_in(base)))
        merged = merge(base, conflict.mine, text, is_modelica=True, names=names)
        return None if merged.flaw else merged.text


def known_base(text: str | None) -> Mapping[str, str]:
    """Return a base's text by its hash; nothing if it is unknown."""
    return {} if text is None else {text_hash(text): text}


def with_choices(inputs: Inputs, settled: Settled) -> Inputs:
    """Return the inputs with the files that choices have changed."""
    left = {key: merge for key, merge in inputs.files.left_by_git.items() if key not in settled.contents}
    inputs = inputs.laid_over({**inputs.files.overlay, **settled.contents}, left)
    generated = {key for key, action in settled.actions.items() if action.generated}  # of these, the path counts
    stampless = settled.contents.keys() - settled.bases.keys() - generated
    own = {key for key in stampless if settled.contents[key] is not None and not inputs.files.stamp(key)}
    recorded = {**inputs.last.record.files, **settled.bases}
    files = {key: base for key, base in recorded.items() if key not in own and base is not None}
    record = msgspec.structs.replace(inputs.last.record, files=files)
    last = msgspec.structs.replace(inputs.last, record=record, texts=settled.texts)
    return msgspec.structs.replace(inputs, last=last, settled=settled)

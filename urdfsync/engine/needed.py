"""Files that are no longer generated and that stay, since texts of the user's need them."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence

from urdfsync.domain import Role
from urdfsync.engine.actions import USERS, Action, Reason
from urdfsync.engine.generation import Generation
from urdfsync.engine.package_names import class_of
from urdfsync.modelica.files import text_of
from urdfsync.modelica.lexer import lex
from urdfsync.state.record import Choice

_CLASS_KINDS = frozenset({"block", "class", "connector", "function", "model", "package", "record", "type"})


def code_words(text: str) -> set[str]:
    """Return all names and keywords in a text, without those in strings and comments, and without the classes in it.

    Left out are the packages that it stands in, too: one may be called like the robot's model. An edited file whose
    element has another name may still declare its class by the old one. The text need not parse.
    """
    found = [token.text for token in lex(text)[0]]
    if found[:1] == ["within"]:
        found = found[[*found, ";"].index(";") :]
    return set(found) - {name for kind, name in itertools.pairwise(found) if kind in _CLASS_KINDS}


def mentioned_files(generation: Generation, actions: Sequence[Action], merged: Mapping[str, str]) -> frozenset[str]:
    """Return the files that are no longer generated and that the user's texts need.

    These are records that any of his texts mentions, edited files included; but those that a renamed element left are
    not: he is told the new name. What a file that he keeps mentions stays whatever it is, and so does what is mentioned
    or shown by what stays.
    """
    inputs, files, before = generation.inputs, generation.inputs.files, generation.inputs.last.package
    leaving = {one.path: one for one in actions if one.reason is Reason.DELETE}
    edited = {action.path for action in actions if action.reason in USERS}
    own = files.classes(inputs.folder) - {action.path for action in actions if not action.handed_to_user}
    texts = {key: merged.get(key) or files.any_text(key) for key in sorted(edited | own)}
    all_words = {word for text in texts.values() for word in code_words(text)}
    all_words |= {word for content in inputs.users_files.mentioning.values() for word in code_words(text_of(content))}
    kept = {one.path for one in actions if one.choice is Choice.KEEP and one.reason in USERS}
    kept_words = {word for key in kept & texts.keys() for word in code_words(texts[key])}
    left = set(generation.moves.values())
    used = set()
    for path, action in leaving.items():
        was_needed = before is not None and inputs.last.folder.path(path) not in before.artifacts
        is_record = action.role is Role.RECORD and path not in left
        if class_of(path) in (all_words if is_record or was_needed else kept_words) and path.endswith(".mo"):
            used.add(path)
    found = set(used)
    while used:
        needed = [files.any_text(path) for path in used]
        words = {word for text in needed for word in code_words(text)}
        used = {
            path
            for path in leaving.keys() - found
            if (
                class_of(path) in words
                if path.endswith(".mo")
                else any(inputs.last.folder.path(path) in one for one in needed)
            )
        }
        found |= used
    return frozenset(found)

"""Results in words, for several commands: no styles, no layout."""

from __future__ import annotations

from collections import Counter

from urdfsync.domain import ChangeClass, ChangeKind, Role
from urdfsync.domain.comparison import Changes
from urdfsync.engine.actions import Action, Choice, Reason

_NAMED = {
    Reason.UPDATE: "{}",
    Reason.MERGE: "{}; merged with your edits",
    Reason.CONFLICT: "you edited it, and its generated text changed too: {}",
}
"""Reasons of actions; `{}` stands for the change of the model."""

NEW_NAMES = "your text with the new names"
"""The text that a class of the user's own becomes after a rename."""
_CHOSEN = {
    Choice.KEEP: "your file as it is",
    Choice.TAKE: "the generated file; --undo brings your edits back",
    Choice.MERGE: "both sides' changes",
    Choice.MERGE_MINE: "both sides' changes, yours where they contradict",
    Choice.MERGE_GENERATED: "both sides' changes, the generated ones where they contradict",
    Choice.MERGE_THEIRS: "both branches' changes, theirs where they contradict",
    Choice.EDIT: "as you edited it",
    Choice.MOVED: "your edit is with the part that you named",
    Choice.UNDO: "as you had it before",
}
"""The content of a file after a choice, in words."""


def reason(action: Action, changes: Changes | None) -> str:
    """Return the end of a sentence that begins with a path: the action's reason, and the cause of a wait.

    The reason names the changed elements of the model, if any: `link forearm and 2 more`. A section lists the changes
    of these elements, too.
    """
    return "; ".join(filter(None, [_cause(action, changes), action.replaces, action.waits_for]))


def _cause(action: Action, changes: Changes | None) -> str:
    if action.choice and not action.is_conflict:
        is_orphan = action.generated is None and action.reason in (Reason.DELETE, Reason.KEEP)
        if action.generated is None and action.choice is Choice.MERGE:
            return NEW_NAMES
        kept = "yours from now on" if action.choice is Choice.KEEP else "deleted; --undo brings it back"
        if action.role is Role.IMPORT and action.choice is Choice.TAKE:
            return "the source's file; a copy of yours is below .urdfsync/aside"
        return kept if is_orphan and action.choice is not Choice.MOVED else _CHOSEN[action.choice]
    if action.reason not in _NAMED or changes is None or action.restores_stamp:
        return action.cause
    # changes of an element update its records, structural changes update models and packages
    causes = [change for change in changes.changes if change.element == action.owner]
    if action.role in (Role.MODEL, Role.PACKAGE, Role.ORDER):
        structural = [change for change in changes.changes if change.change_class is ChangeClass.STRUCTURAL]
        own = [change for change in structural if change.element == action.owner]
        causes = own or structural or ([] if changes.generator else causes)
    if action.reason is Reason.CONFLICT and not (causes or changes.generator) and len(changes.by_element()) == 1:
        causes = [*changes.changes]  # such as a mesh, whose facts are in a link's record
    if not (causes or changes.generator):
        return action.reason.text
    cause = generator_change(changes)
    if causes:
        elements = list(dict.fromkeys(change.element for change in causes))
        cause = f"{elements[0]} and {len(elements) - 1} more" if len(elements) > 1 else elements[0]
    return _NAMED[action.reason].format(cause)


def generator_change(changes: Changes) -> str:
    """Say that templates, options or urdfsync changed; if only options or the package's name changed, say which."""
    if changes.package:
        return f"the package's name changed: {changes.package}"
    if not changes.options:
        return "a template, an option or urdfsync itself changed"
    names = " and ".join(f"`{name}`" for name in changes.options)
    return f"the option{'s' if len(changes.options) > 1 else ''} {names} changed"


def change_counts(changes: Changes) -> str:
    """Return the numbers of added, removed and changed elements: `+2 −1 ~42 (4 structural changes)`."""
    marks = {change.element: "~" for change in changes.changes}
    marks |= {one.element: _SIGNS.get(one.kind, "~") for one in changes.changes if len(one.path) == 1}
    elements = Counter(marks.values())
    classes = Counter(change.change_class for change in changes.changes)
    counts = [(classes[one], one) for one in reversed(ChangeClass) if classes[one]]
    words = f"{' and '.join(f'{number} {one}' for number, one in counts)} change{'' if counts[-1][0] == 1 else 's'}"
    words += " by rounding" if changes.noise else ""
    signs = [f"{sign}{elements[sign]}" for sign in "+−~" if elements[sign]]
    return f"{' '.join(signs)} ({words})" if len(marks) > 1 else words


_SIGNS = {ChangeKind.ADDED: "+", ChangeKind.REMOVED: "−"}

"""Results in words, for several commands: no styles, no layout."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Sequence
from typing import TYPE_CHECKING

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import ChangeClass, ChangeKind, Role
from urdfsync.engine.actions import Action, Kind, Reason
from urdfsync.engine.result import Checked, Result
from urdfsync.output.outline import change_row, outline
from urdfsync.state.record import Choice

if TYPE_CHECKING:
    from urdfsync.changes import Changes

NOT_EXPANDED = "inputs changed since the last build"
"""Words for a source that xacro, or a command, would have to make again."""
BROKEN = "broken: a file that you edited does not fit"
"""Words for a package in which a name means nothing, or a file is no Modelica."""
_NAMED = {
    Reason.UPDATE: "{}",
    Reason.MERGE: "{}; merged with your edits",
    Reason.CONFLICT: "you edited it, and its generated text changed too: {}",
}
"""Reasons of actions that follow from a change of the model, which takes the place of `{}`."""

_CHOSEN = {
    Choice.KEEP: "your file as it is",
    Choice.TAKE: "the generated file; --undo brings your edits back",
    Choice.MERGE: "both sides' changes",
    Choice.MERGE_MINE: "both sides' changes, yours where they contradict",
    Choice.MERGE_GENERATED: "both sides' changes, the generated ones where they contradict",
    Choice.EDIT: "as you edited it",
    Choice.UNDO: "as you had it before",
}
"""The text that a choice of the user's gives a file."""


def counted(count: int, noun: str) -> str:
    """`1 file`, `2 files`."""
    return f"{count} {noun}{'' if count == 1 else 's'}"


def error_count(diagnostics: Sequence[Diagnostic]) -> str:
    """`2 errors`."""
    return counted(sum(diagnostic.severity is Severity.ERROR for diagnostic in diagnostics), "error")


def summary(result: Result) -> str:
    """Return what happened to a package, or would in a dry run, as the rest of a line that names the robot."""
    if result.failed:
        end = "the next build finishes it" if result.unfinished else "nothing was changed"
        return f"{error_count(result.diagnostics)}, {end}"
    parts = [NOT_EXPANDED, *action_counts(result)] if result.stale else action_counts(result)
    if result.in_step and not any(action.writes or action.reason is Reason.ADOPT for action in result.actions.decided):
        fine = (Reason.UNCHANGED, Reason.KEEP, Reason.INCLUDED)
        total = sum(action.reason in fine for action in result.actions)
        parts.insert(0, f"in step, {counted(total, 'file')}")
    if result.is_broken:
        parts.insert(0, BROKEN)
    checked = [check_result(result.checked, result.diagnostics)] if result.checked else []
    return "; ".join([", ".join(parts), *checked])


def check_result(checked: Checked, diagnostics: Sequence[Diagnostic]) -> str:
    """Return what the check after a build said, as the rest of a line that names the robot."""
    return {
        Checked.RIGHT: "checked: compiles",
        Checked.INCOMPLETE: "checked in part",
        Checked.WRONG: f"checked: {error_count(diagnostics)}",
    }[checked]


def action_counts(result: Result, silent: Container[Reason] = ()) -> list[str]:
    """Return a phrase for each reason that is not `silent`, with the number of files, and for what waits."""
    reasons = Counter(action.reason for action in result.actions.decided if not action.held)
    reasons[Reason.UPDATE] += reasons.pop(Reason.CREATE, 0)
    reasons[Reason.CONFLICT] += reasons.pop(Reason.UNOWNED, 0)
    phrases = []
    for reason in Reason:  # in the order in which they are told
        if (number := reasons[reason]) and reason not in silent and reason.done:
            them, have, s = ("them", "have", "s") if number > 1 else ("it", "has", "")
            phrase = reason.to_do if result.dry else reason.done
            phrases.append(phrase.format(n=number, them=them, have=have, s=s))
    if (
        result.dry
        and result.writes
        and all(reason.kind is Kind.LEAVE and reason is not Reason.ADOPT for reason in +reasons)
    ):
        phrases.append("recorded state to write")
    if waiting := sum(action.held for action in result.actions.decided):
        what = "the conflict is" if reasons[Reason.CONFLICT] == 1 else "all conflicts are"
        phrases.append(f"{counted(waiting, 'file')} wait{'s' if waiting == 1 else ''} until {what} resolved")
    return phrases


def reason(action: Action, changes: Changes | None, *, brief: bool = False) -> str:
    """Return why an action happens, as the end of a sentence that begins with the path, and what it waits for.

    Where the changes of the model tell, they are named: `link forearm: mass 1.2 → 1.4 kg (+16.7 %)`. If `brief`, their
    elements are, `link forearm`: the changes are listed beside it.
    """
    return "; ".join(filter(None, [_cause(action, changes, brief=brief), action.waits_for]))


def _cause(action: Action, changes: Changes | None, *, brief: bool) -> str:
    if action.choice and action.kind is not Kind.CONFLICT:
        is_orphan = action.generated is None and action.choice is not Choice.UNDO
        kept = "yours from now on" if action.choice is Choice.KEEP else "deleted; --undo brings it back"
        return kept if is_orphan else _CHOSEN[action.choice]
    if action.reason not in _NAMED or changes is None:
        return action.reason.text
    # records follow from the changes of their element, models and packages from structural ones
    causes = [change for change in changes.changes if change.element == action.owner]
    if action.role in (Role.MODEL, Role.PACKAGE, Role.ORDER):
        structural = [change for change in changes.changes if change.change_class is ChangeClass.STRUCTURAL]
        own = [change for change in structural if change.element == action.owner]
        causes = own or structural or ([] if changes.generator else causes)
    if not (causes or changes.generator):
        return action.reason.text
    cause = generator_change(changes)
    if causes and brief:
        elements = list(dict.fromkeys(change.element for change in causes))
        cause = f"{elements[0]} and {len(elements) - 1} more" if len(elements) > 1 else elements[0]
    elif causes:
        more = f", and {counted(len(causes) - 1, 'more change')}" if len(causes) > 1 else ""
        cause = f"{causes[0].element}: {change_row(causes[:1])}{more}"
    return _NAMED[action.reason].format(cause)


def generator_change(changes: Changes) -> str:
    """Return what changed beside the model: options by their names, if nothing but options did."""
    if not changes.options:
        return "a template, an option or urdfsync itself changed"
    names = " and ".join(f"`{name}`" for name in changes.options)
    return f"the option{'s' if len(changes.options) > 1 else ''} {names} changed"


def change_lines(changes: Changes, most: int | None = None, *, everything: bool = False) -> list[str]:
    """Return what changed in the model, one line each: `joint elbow: limit / effort 54 → 60 N.m (+11.1 %)`.

    How much it is comes first, if it is several things. Where that takes more than `most` lines, each element has one.
    """
    lines = [generator_change(changes)] if changes.generator else []
    elements = outline(changes, everything=everything)
    if sum(map(len, elements.values())) > 1:
        lines.append(change_counts(changes))
    if most is None or len(lines) + sum(map(len, elements.values())) <= most:
        return [*lines, *(f"{title}: {row}" for title, rows in elements.items() for row in rows)]
    for title, (first, *others) in elements.items():
        lines.append(f"{title}: {first}{f', and {len(others)} more' if others else ''}")
    return lines


def change_counts(changes: Changes) -> str:
    """Return how many elements come, go and change: `+2 −1 ~42 (4 structural and 51 parameter changes)`."""
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

"""Files that both sides changed: how the sides stand to each other, and lines with the commands that settle it."""

from __future__ import annotations

import os
import shlex
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from urdfsync.engine.actions import Action, Reason
from urdfsync.engine.conflicts import Conflict, conflict_files
from urdfsync.engine.result import Result
from urdfsync.files import shown
from urdfsync.output.console import Console, StyledLine, line
from urdfsync.output.phrases import counted, reason
from urdfsync.state.record import Choice

if TYPE_CHECKING:
    import rich.console

FULL = 3
"""So many conflicts of a robot are shown in full without --verbose."""
_ELEMENTS = 5
"""So many changes of each side are listed."""
_NAMED = 3
"""So many contradictions of a file are named in its sentence."""


class DisputedFile(msgspec.Struct, frozen=True):
    """A file that the user may decide about.

    It conflicts, or its merge is about to be written, or it waits for other conflicts after a choice that may
    be made again, or it is an edited one that is no longer generated.
    """

    result: Result
    action: Action
    texts: Conflict | None = None
    """None if the versions are no texts that could be compared."""

    @property
    def shown(self) -> str:
        """Where the user's file is, as the user would type it."""
        return shown_path(self.result, self.action.origin or self.action.path)

    @property
    def is_decided(self) -> bool:
        """Whether it does not conflict, but can be decided about all the same."""
        action = self.action
        waits = action.held and action.choice is not None
        return action.reason in (Reason.MERGE, Reason.MOVE) or waits

    @property
    def merges(self) -> bool:
        """Whether `--merge` settles it, as far as that is known."""
        return self.offers(Choice.MERGE)

    def offers(self, choice: Choice) -> bool:
        """Whether a choice to merge settles it, as far as that is known."""
        return self.is_decided or (self.texts is not None and self.texts.merged(choice) is not None)

    @property
    def is_on_disk(self) -> bool:
        """Whether `--take` settles it: a file stands there, and the generated one is at hand."""
        return self.is_decided or self.action.is_on_disk


def find_conflicts(results: Iterable[Result]) -> list[DisputedFile]:
    """The files that conflict, in the order of robots and paths."""
    found = []
    for result in results:
        by_path = {texts.path: texts for texts in result.conflict_texts}
        found += [DisputedFile(result, action, by_path.get(action.path)) for action in result.conflicts]
    return found


def describe(target: DisputedFile) -> str:
    """How the sides stand to each other, as a clause."""
    texts = target.texts
    if texts is None:
        return "it is not a text, so it can't be merged"
    if texts.merge is None:
        is_unowned = target.action.reason is Reason.UNOWNED
        base = (
            "there is no base" if is_unowned else "its merge base, the text that urdfsync wrote last, is not recorded"
        )
        return texts.rejected or f"{base}, so it can't be merged"
    if target.merges:
        return "the changes fit together: --merge takes both"
    if texts.rejected:
        return f"--merge would not be right: {texts.rejected}"
    found = [conflict.what for conflict in texts.merge.conflicts]
    if not all(found):
        return f"the changes contradict each other{f' in {len(found)} places' if len(found) > 1 else ''}"
    more = f"; and {len(found) - _NAMED} more" if len(found) > _NAMED else ""
    return f"{'; '.join(found[:_NAMED])}{more}"


def saved_texts(target: DisputedFile) -> dict[str, str]:
    """Where a build saves the versions of a text, from the configuration's folder: `base`, `generated`, `merge`."""
    if target.texts is None:
        return {}
    folder = Path(os.path.relpath(target.result.folder, target.result.root)).as_posix()
    aside = f".urdfsync/conflicts/{target.result.robot}"
    return {name: f"{aside}/{path}" for name, (path, _) in conflict_files(target.texts, folder).items()}


def shown_path(result: Result, path: str) -> str:
    """A path of the record as the user would type it."""
    return shown(Path(os.path.normpath(result.root / path)))


def conflict_lines(result: Result, console: Console, screen: rich.console.Console) -> Iterator[StyledLine]:
    """All conflicts of one robot: the first ones in full, the others on a line each, and the command for all.

    What differs is laid out for the width of `screen`.
    """
    found = find_conflicts([result])
    full = len(found) if console.verbose else 0 if console.quiet else FULL
    for target in found[:full]:
        yield line(("", ""))
        yield from _full_lines(target, console, screen)
    if full and found[full:]:
        yield line(("", ""))
    for target in found[full:]:
        yield line(("  conflict   ", "bold red"), (target.shown, ""), (f"  {describe(target)}", "dim"))
    if len(found) == 1 and full:
        return
    mergeable = sum(target.merges for target in found)
    what = "merges it" if len(found) == 1 else f"merges what can be merged: {mergeable} of {len(found)}"
    if not mergeable:
        what = "keeps all your files as they are, --take replaces them by the generated ones"
    choice = Choice.MERGE if mergeable else Choice.KEEP
    command = _command(["resolve", "--all", "--robot", result.robot, f"--{choice}"], console)
    yield from (line(("", "")), line((f"  {command}", "bold"), (f"  {what}", "dim")))
    never_built = all(action.base is None for action in result.actions)
    if never_built and all(target.action.reason is Reason.UNOWNED for target in found):
        what = "takes them for your edits, and lists these"
        yield line((f"  {_command(['adopt', result.robot], console)}", "bold"), (f"  {what}", "dim"))


def _full_lines(target: DisputedFile, console: Console, screen: rich.console.Console) -> Iterator[StyledLine]:
    """One conflict: what happened, the versions, where they are saved, and what to do."""
    result, action, name = target.result, target.action, target.shown
    yield line(("  conflict   ", "bold red"), (name, "bold"), (f"  {action.owner}", "dim"))
    story = f"{_sentence(reason(action, result.changes, brief=True))} {_sentence(describe(target))}"
    if action.origin:
        story += f" It will be moved to {shown_path(result, action.path)}."
    yield from _paragraph(story, "", screen)
    if target.texts:
        from urdfsync.output.differences import difference_lines  # only a conflict needs it

        saved = {kind: shown_path(result, path) for kind, path in saved_texts(target).items()}
        lines, left_out = [] if console.verbose else _element_lines(target.texts), 0
        if not lines:
            lines, left_out = difference_lines(target.texts, screen, console.verbose)
        yield from (line(("", "")), *lines)
        if left_out:
            see = "--verbose shows them" if result.dry else f"see {saved.get('merge', saved['generated'])}"
            yield line((f"    … {counted(left_out, 'more line')}; {see}", "dim"))
        yield line(("", ""))
        if not result.dry:
            yield from _paragraph(f"saved: {', '.join(saved.values())}", "dim", screen)
    choices = _choices(target)
    width = max(map(len, choices))
    typed = f"./{name}" if name.startswith("-") else name
    yield line((f"    {_command(['resolve', typed, *next(iter(choices)).split()], console)}", "bold"))
    for choice, words in choices.items():
        yield line((f"      {choice:<{width}}  {words}", "dim"))


def settle_hint(result: Result) -> str:
    """Return what settles the conflicts of a robot: the options that do so for each of them."""
    found = find_conflicts([result])
    best, *others = [choice for choice in _choices(found[0]) if all(choice in _choices(one) for one in found[1:])]
    what, file = ("the conflict", found[0].shown) if len(found) == 1 else ("each conflict", "FILE")
    more = f" (or {', '.join(others)})" if others else ""
    return f"  settle {what} with `urdfsync resolve {file} {best}`{more}"


def _choices(target: DisputedFile) -> dict[str, str]:
    """The options that settle a conflict, the best one first, and what they do."""
    found = {}
    if target.merges:
        found["--merge"] = "both sides' changes"
    elif target.offers(Choice.MERGE_MINE):
        found["--merge --prefer mine"] = "both sides' changes, yours (or generated) in doubt"
    if target.texts and target.texts.merge and target.is_on_disk:
        found["--edit"] = "both in your editor, between markers"
    found["--keep"] = "your file as it is"
    if target.action.origin:
        found["--keep"] += ", under its new name"
    if target.texts and target.is_on_disk:
        found.setdefault("--edit", "both texts in your editor, between markers")
    if target.is_on_disk:
        found["--take"] = "the generated file"
    return found


def _element_lines(texts: Conflict) -> list[StyledLine]:
    """What each side changed, by element, if a merge takes both and both are classes."""
    from urdfsync.merge.edits import find_edits, in_words  # only a conflict needs it

    if texts.base is None or texts.merge is None or texts.merge.text is None:
        return []
    sides = {"you": find_edits(texts.base, texts.mine), "the export": find_edits(texts.base, texts.generated)}
    lines: list[StyledLine] = []
    for side, edits in sides.items():
        if edits is None:
            return []
        told = [f"{element}: {what}" for element, what in in_words(edits)] or ["blanks, or the order of things"]
        more = [f"… {counted(len(told) - _ELEMENTS, 'more change')}"] if len(told) > _ELEMENTS else []
        for number, words in enumerate([*told[:_ELEMENTS], *more]):
            lines.append(line((f"    {'' if number else side:<12}", "bold"), (words, "")))
    return lines


def _command(arguments: Sequence[str], console: Console) -> str:
    """A command line to copy."""
    command = ["urdfsync", *arguments, *(["--config", console.config] if console.config else [])]
    if os.name == "nt":
        return " ".join(f'"{argument}"' if " " in argument else argument for argument in command)
    return shlex.join(command)


def _paragraph(words: str, style: str, screen: rich.console.Console) -> Iterator[StyledLine]:
    """Indented text; a terminal's lines are broken so that they keep the indent."""
    width = max(screen.width - 4, 20) if screen.is_terminal else len(words)
    for part in textwrap.wrap(words, width, break_on_hyphens=False):
        yield line((f"    {part}", style))


def _sentence(clause: str) -> str:
    """The clause as a sentence; the program's name keeps its small letter."""
    return f"{clause if clause.startswith('urdfsync') else clause[:1].upper() + clause[1:]}."

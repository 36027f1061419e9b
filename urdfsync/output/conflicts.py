"""Files that both sides changed: how the sides stand to each other, and lines with the commands that settle it."""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import msgspec

from urdfsync.config import shown
from urdfsync.engine.actions import Action, Kind
from urdfsync.engine.conflicts import Conflict, conflict_files
from urdfsync.outcome import Result
from urdfsync.output.console import text
from urdfsync.output.phrases import counted, reason
from urdfsync.state.record import Choice

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

FULL = 3
"""So many conflicts are shown in full without --verbose."""
NOT_HERE = "the file it is made from is not here"


class Target(msgspec.Struct, frozen=True):
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
        """Whether there is a decision about it that has not been carried out yet."""
        return self.action.kind in (Kind.MERGE, Kind.MOVE) or (self.action.held and self.action.choice is not None)

    @property
    def merges(self) -> bool:
        """Whether `--merge` settles it, as far as that is known."""
        merge = self.texts.merge if self.texts else None
        return self.is_decided or (merge is not None and merge.text is not None)

    @property
    def replaceable(self) -> bool:
        """Whether `--take` settles it: a file stands there, and the generated one is at hand."""
        return self.is_decided or self.action.replaceable


class Extent(NamedTuple):
    """How much of the conflicts to show."""

    verbose: bool = False
    """Everything."""
    quiet: bool = False
    """One line for each."""
    before: int = 0
    """So many conflicts of other robots have been shown."""
    config: str = ""
    """The configuration, if the user named one."""


def find_conflicts(results: Iterable[Result]) -> list[Target]:
    """The files that conflict, in the order of robots and paths."""
    found = []
    for result in results:
        by_path = {texts.path: texts for texts in result.standoffs}
        found += [Target(result, action, by_path.get(action.path)) for action in result.conflicts]
    return found


def describe(target: Target) -> str:
    """How the sides stand to each other, as a clause."""
    texts = target.texts
    if texts is None:
        return f"it is no text that could be merged{'' if target.action.at_hand else f', and {NOT_HERE}'}"
    if texts.merge is None:
        is_unowned = target.action.kind is Kind.UNOWNED
        lost = "without a base" if is_unowned else "what urdfsync wrote last is lost: without it"
        return texts.rejected or f"{lost}, nothing tells who changed what"
    if target.merges:
        return "the changes fit together: --merge takes both"
    if texts.rejected:
        return f"the changes fit together line by line, but {texts.rejected}"
    number = len(texts.merge.conflicts)
    return f"the changes contradict each other{f' in {number} places' if number > 1 else ''}"


def saved_texts(target: Target) -> dict[str, str]:
    """Where a build saves the versions of a text, from the configuration's folder: `base`, `generated`, `merge`."""
    if target.texts is None:
        return {}
    folder = Path(os.path.relpath(target.result.folder, target.result.root)).as_posix()
    found = conflict_files(target.texts, folder)
    paths = {"base": found.base, "generated": found.generated, "merge": found.merge}
    return {name: f".urdfsync/conflicts/{target.result.robot}/{path}" for name, path in paths.items() if path}


def shown_path(result: Result, path: str) -> str:
    """A path of the manifest as the user would type it."""
    return shown(Path(os.path.normpath(result.root / path)))


def conflict_lines(result: Result, console: Console, extent: Extent) -> Iterator[Text]:
    """All conflicts of one robot: the first ones in full, the others on a line each, and the command for all."""
    found = find_conflicts([result])
    full = len(found) if extent.verbose else 0 if extent.quiet else max(0, FULL - extent.before)
    for target in found[:full]:
        yield text(("", ""))
        yield from _full_lines(target, console, extent)
    if full and found[full:]:
        yield text(("", ""))
    for target in found[full:]:
        yield text(("  conflict   ", "bold red"), (target.shown, ""), (f"  {describe(target)}", "dim"))
    if len(found) == 1 and full:
        return
    mergeable = sum(target.merges for target in found)
    if not mergeable:
        what = "keeps all your files as they are, --take replaces them by the generated ones"
    elif mergeable < len(found):
        what = f"merges what can be merged: {mergeable} of {len(found)}"
    else:
        what = {1: "merges it", 2: "merges both"}.get(mergeable, f"merges all {mergeable}")
    choice = Choice.MERGE if mergeable else Choice.KEEP
    command = _command(["--all", "--robot", result.robot, f"--{choice}"], extent)
    yield text(("", ""))
    yield text((f"  {command}", "bold"), (f"  {what}", "dim"))


def _full_lines(target: Target, console: Console, extent: Extent) -> Iterator[Text]:
    """One conflict: what happened, the versions, where they are saved, and what to do."""
    result, action, name = target.result, target.action, target.shown
    yield text(("  conflict   ", "bold red"), (name, "bold"), (f"  {action.owner}", "dim"))
    story = f"{_sentence(reason(action, result.changes))} {_sentence(describe(target))}"
    if action.origin:
        story += f" Its element has another name now: it is to become {shown_path(result, action.path)}."
    yield from _paragraph(story, "", console)
    if target.texts:
        from urdfsync.output.differences import difference_lines  # only a conflict needs it

        saved = {kind: shown_path(result, path) for kind, path in saved_texts(target).items()}
        lines, left_out = difference_lines(target.texts, console, extent.verbose)
        yield from (text(("", "")), *lines)
        if left_out:
            see = "--verbose shows them" if result.dry else f"see {saved.get('merge', saved['generated'])}"
            yield text((f"    … {counted(left_out, 'more line')}; {see}", "dim"))
        yield text(("", ""))
        if not result.dry:
            yield text((f"    {_saved_files(saved)}", "dim"))
    choices = {Choice.KEEP: "--keep leaves your file as it is"}
    if action.origin:
        choices[Choice.KEEP] = "--keep moves your file as it is"
    if target.merges:
        choices = {Choice.MERGE: "--merge takes both sides' changes", **choices}
    elif target.texts:
        choices[Choice.KEEP] += ": first put into it what you want of both" + (
            ", and its new name" * bool(action.origin)
        )
    if target.replaceable:
        choices[Choice.TAKE] = "--take replaces it by the generated one"
    typed = f"./{name}" if name.startswith("-") else name
    yield text((f"    {_command([typed, f'--{next(iter(choices))}'], extent)}", "bold"))
    yield from _paragraph("; ".join(choices.values()), "dim", console)


def _saved_files(saved: dict[str, str]) -> str:
    """`base and generated: .urdfsync/conflicts/arm/Elbow.{base.mo,generated.mo}`."""
    *names, last = saved
    if not names:
        return f"{last}: {saved[last]}"
    stem = saved["generated"].rpartition("generated")[0]
    ends = ",".join(path.removeprefix(stem) for path in saved.values())
    return f"{', '.join(names)} and {last}: {stem}{{{ends}}}"


def _command(arguments: Sequence[str], extent: Extent) -> str:
    """A command line of `resolve` to copy."""
    options = ["--config", extent.config] if extent.config else []
    if os.name == "nt":
        quoted = [f'"{argument}"' if " " in argument else argument for argument in (*arguments, *options)]
        return " ".join(["urdfsync", "resolve", *quoted])
    return shlex.join(["urdfsync", "resolve", *arguments, *options])


def _paragraph(words: str, style: str, console: Console) -> Iterator[Text]:
    """Indented text; a terminal's lines are broken so that they keep the indent."""
    paragraph = text((words, style))
    width = console.width - 4 if console.is_terminal else paragraph.cell_len
    for line in paragraph.wrap(console, max(width, 20)):
        line.rstrip()
        line.pad_left(4)
        yield line


def _sentence(clause: str) -> str:
    """The clause as a sentence; the program's name keeps its small letter."""
    return f"{clause if clause.startswith('urdfsync') else clause[:1].upper() + clause[1:]}."

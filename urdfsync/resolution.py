"""Which conflicts the user means, and what may be done about each: from what was typed to choices by path. Pure."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.actions import Action, Kind
from urdfsync.engine.conflicts import Conflict, conflict_files
from urdfsync.outcome import Result
from urdfsync.state.record import Choice

FOLDER = ".urdfsync/conflicts"
"""Where the versions of conflicting files are put aside, below the configuration's folder."""
_NOT_HERE = "the file it is made from is not here"
_FEW = 5
"""So many conflicts are named in a message; of more, only the first ones and their number."""


class Target(msgspec.Struct, frozen=True):
    """A file that the user may decide about.

    It conflicts, or its merge is about to be written, or it waits for other conflicts after a choice that may
    be made again, or it is an edited one that is no longer generated.
    """

    result: Result
    action: Action
    standoff: Conflict | None = None
    """None if the versions are no texts that could be compared."""

    @property
    def place(self) -> str:
        """Where the user's file is, as in the manifest."""
        return self.action.origin or self.action.path

    @property
    def orphan(self) -> bool:
        """Whether it is no longer generated."""
        return self.action.kind is Kind.ORPHAN

    @property
    def settled(self) -> bool:
        """Whether there is a decision about it, which has not been carried out yet."""
        return self.action.kind in (Kind.MERGE, Kind.MOVE) or (self.action.held and self.action.choice is not None)

    @property
    def merges(self) -> bool:
        """Whether `--merge` settles it, as far as that is known."""
        if self.settled:
            return True
        merge = self.standoff.merge if self.standoff else None
        return merge is not None and merge.text is not None

    @property
    def replaceable(self) -> bool:
        """Whether `--take` settles it: what is there must be a file, and what is generated at hand."""
        return self.settled or self.action.replaceable

    def places(self) -> set[Path]:
        """The absolute paths by which it is known: where the user's file is, and where it is to go."""
        return {Path(os.path.normpath(self.result.root / path)) for path in (self.place, self.action.path)}


class Wish(msgspec.Struct, frozen=True):
    """A path that the user typed, and the absolute places that it may stand for."""

    typed: str
    places: tuple[Path, ...]


class Aside(msgspec.Struct, frozen=True):
    """The versions of a conflicting file that are put aside, as paths from the configuration's folder."""

    stem: str
    """What all of them begin with."""
    base: str | None
    generated: str
    merge: str | None

    @property
    def names(self) -> list[str]:
        """What there is."""
        return [name for name in ("base", "generated", "merge") if getattr(self, name) is not None]

    @property
    def files(self) -> list[str]:
        """Where it is, in the same order."""
        return [path for path in (self.base, self.generated, self.merge) if path is not None]


def conflicts(results: Iterable[Result]) -> list[Target]:
    """The files that conflict, in the order of robots and paths."""
    found = []
    for result in results:
        standoffs = {standoff.path: standoff for standoff in result.standoffs}
        found += [Target(result, action, standoffs.get(action.path)) for action in result.conflicts]
    return found


def targets(results: Iterable[Result], wishes: Iterable[Wish]) -> tuple[list[Target], list[Wish]]:
    """The files that paths mean, and the paths that mean none.

    A folder stands for all conflicts below it; a file that does not conflict has to be named itself.
    """
    results = list(results)
    others = [Target(result, action) for result in results for action in result.actions.decided]
    others = [target for target in others if target.orphan or target.settled]
    candidates = conflicts(results)
    chosen: dict[str, Target] = {}
    missing = []
    for wish in wishes:
        found = [target for target in candidates if _lies_in(target, wish.places)]
        found += [target for target in others if not target.places().isdisjoint(wish.places)]
        chosen |= {target.action.path: target for target in found}
        missing += [] if found else [wish]
    return list(chosen.values()), missing


def _lies_in(target: Target, places: Sequence[Path]) -> bool:
    return any(place in (path, *path.parents) for path in target.places() for place in places)


def unknown(results: Iterable[Result], missing: Sequence[Wish], shown: Callable[[Path], str]) -> Diagnostic:
    """What to say of paths that mean no conflict; `shown` turns paths into what people see."""
    results = list(results)
    names = " and ".join(f"`{wish.typed}`" for wish in missing)
    message = f"{names} {'is' if len(missing) == 1 else 'are'} not in conflict"
    if len(missing) == 1 and _waits(results, missing[0]):
        message += ", it only waits for the conflicts of its robot"
    names = listing(results, shown)
    return Diagnostic(Severity.ERROR, "no-conflict", message, hint=f"these are: {names}" if names else "nothing is")


def _waits(results: Iterable[Result], wish: Wish) -> bool:
    held = (Target(result, action) for result in results for action in result.actions.decided if action.held)
    return any(not target.places().isdisjoint(wish.places) for target in held)


def listing(results: Iterable[Result], shown: Callable[[Path], str]) -> str:
    """The conflicts that there are, in one line; empty if there are none."""
    names = [_name(target, shown) for target in conflicts(results)]
    more = f" and {len(names) - _FEW} more" if len(names) > _FEW else ""
    return f"{', '.join(names[:_FEW])}{more}"


def _name(target: Target, shown: Callable[[Path], str]) -> str:
    return shown(Path(os.path.normpath(target.result.root / target.place)))


def choices(found: Iterable[Target], choice: Choice, shown: Callable[[Path], str]) -> dict[str, Choice]:
    """The choice for every file, by its path. Raises UrdfsyncError if it is impossible for any of them."""
    found = list(found)
    if problems := [problem for target in found for problem in _problems(target, choice, shown)]:
        raise UrdfsyncError(*problems)
    return {target.action.path: choice for target in found}


def possible(found: Iterable[Target], choice: Choice) -> dict[str, Choice]:
    """The choice for every file for which it is possible, by its path."""
    return {target.action.path: choice for target in found if not any(_problems(target, choice, str))}


def _problems(target: Target, choice: Choice, shown: Callable[[Path], str]) -> Iterator[Diagnostic]:
    """Why the choice can't be had for a file."""
    if choice is Choice.TAKE and not target.action.at_hand:
        message = f"it can't be taken: {_NOT_HERE}"
        hint = f"bring it back, or keep yours with `urdfsync resolve {_name(target, shown)} --keep`"
    elif choice is Choice.TAKE and not target.replaceable:
        message, hint = f"it can't be replaced: {standing(target)}", "move it away, then build"
    elif choice is Choice.MERGE and target.orphan:
        message, hint = (
            "it is no longer generated: there is nothing to merge",
            "--keep makes it yours, --take deletes it",
        )
    elif choice is Choice.MERGE and not target.merges:
        message = f"it can't be merged: {standing(target)}"
        hint = "use --keep or --take" if target.replaceable else "use --keep"
        put_aside = aside(target)
        if put_aside and put_aside.merge:
            proposal = shown(target.result.root / put_aside.merge)
            hint = f"put what you want of {proposal} into your file, then use --keep"
    else:
        return
    yield Diagnostic(Severity.ERROR, f"no-{choice}", message, _name(target, shown), hint=hint)


def standing(target: Target) -> str:
    """How the sides stand to each other, as a clause."""
    standoff = target.standoff
    if standoff is None:
        return f"it is no text that could be merged{'' if target.action.at_hand else f', and {_NOT_HERE}'}"
    if standoff.merge is None and standoff.rejected:
        return standoff.rejected
    if standoff.merge is None:
        lost = (
            "without a base" if target.action.kind is Kind.UNOWNED else "what urdfsync wrote last is lost: without it"
        )
        return f"{lost}, nothing tells who changed what"
    if target.merges:
        return "the changes fit together: --merge takes both"
    if standoff.rejected:
        return f"the changes fit together line by line, but {standoff.rejected}"
    number = len(standoff.merge.conflicts)
    return f"the changes contradict each other{f' in {number} places' if number > 1 else ''}"


def aside(target: Target) -> Aside | None:
    """Where the versions of a file are put aside; None for what is no text."""
    standoff = target.standoff
    if standoff is None:
        return None
    folder = Path(os.path.relpath(target.result.folder, target.result.root)).as_posix()
    generated, base, merge = conflict_files(standoff, folder)
    top = f"{FOLDER}/{target.result.robot}/"
    stem = f"{top}{generated.rpartition('generated')[0]}"
    return Aside(stem, base and f"{top}{base}", f"{top}{generated}", merge and f"{top}{merge}")

"""What leads from one run of Modelica tokens to another: edits, each in the place where people would see it.

A shortest edit script says what changes, but often leaves open where: an added line may as well begin before
the last comma of the one above it. These edits keep to whole lines where they can, keep apart the comments that
come with a new value, and know over which equal tokens they could be moved.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from urdfsync.merging.myers import diff
from urdfsync.merging.tokens import NEWLINE, is_trivia, is_word

_MAX_WORK = 150_000
"""What comparing the tokens of one conflict may cost (see `urdfsync.merging.myers`): enough for some 500 edits."""


class Edit(msgspec.Struct, frozen=True):
    """Base tokens `start` to `stop` (half open) replaced; what lies from `low` to `high` it could be moved over."""

    start: int
    stop: int
    inserted: tuple[str, ...]
    deleted: tuple[str, ...]
    low: int
    high: int
    lines: bool = False
    """Nothing but whole lines are inserted or deleted."""

    @property
    def effect(self) -> tuple[int, int, tuple[str, ...], tuple[str, ...]]:
        """What comes of it, whatever it could be moved over."""
        return self.start, self.stop, self.inserted, self.deleted

    @property
    def adds(self) -> bool:
        """Nothing is deleted but comments and white space."""
        return all(map(is_trivia, self.deleted))

    @property
    def removes(self) -> bool:
        """Nothing is inserted but comments and white space."""
        return all(map(is_trivia, self.inserted))

    @property
    def trivia(self) -> bool:
        """Only comments and white space change."""
        return self.adds and self.removes

    @property
    def weight(self) -> int:
        """How much changes, in words, and at least 1."""
        return max(1, sum(map(is_word, self.inserted)), sum(map(is_word, self.deleted)))


def edits_between(old: Sequence[str], new: Sequence[str]) -> list[Edit]:
    """The edits that make `new` of `old`, in order."""
    changes = diff(old, new, thin=False, work=_MAX_WORK)
    floors, ceilings = [0, *(change.stop for change in changes)], [*(change.start for change in changes[1:]), len(old)]
    result: list[Edit] = []
    for change, floor, ceiling in zip(changes, floors, ceilings, strict=False):
        deleted, inserted = tuple(old[change.start : change.stop]), tuple(new[change.new_start : change.new_stop])
        if deleted and inserted:
            result += _replaced(change.start, deleted, inserted, old, ceiling)
        else:
            result.append(_placed(change.start, deleted, inserted, old, range(floor, ceiling)))
    return result


def _replaced(
    start: int, deleted: tuple[str, ...], inserted: tuple[str, ...], old: Sequence[str], ceiling: int
) -> Iterator[Edit]:
    """A replacement; whole lines after it that only one of the texts has are an edit of their own."""
    stop = start + len(deleted)
    rest = tuple(old[stop:ceiling])
    ending = rest[: rest.index(NEWLINE) + 1] if NEWLINE in rest else ()
    added, removed = _find(ending, inserted, deleted), _find(ending, deleted, inserted)
    if added:
        yield from _noted(start, deleted, inserted[:added])
        lines = inserted[added + len(ending) :] + ending
        yield _placed(stop + len(ending), (), lines, old, range(stop + len(ending), ceiling))
    elif removed is not None:
        yield from _noted(start, deleted[:removed], inserted)
        lines = deleted[removed + len(ending) :] + ending
        first = start + removed + len(ending)
        yield _placed(first, lines, (), old, range(first, ceiling))
    else:
        yield from _noted(start, deleted, inserted)


def _find(ending: tuple[str, ...], run: tuple[str, ...], other: tuple[str, ...]) -> int | None:
    """Where the end of a line first occurs in the run of several lines, if the other one is part of a single line."""
    if not ending or NEWLINE in other:
        return None
    return next((place for place in range(len(run)) if run[place : place + len(ending)] == ending), None)


def _noted(start: int, deleted: tuple[str, ...], inserted: tuple[str, ...]) -> Iterator[Edit]:
    """A replacement; comments and white space that come with it, before or after, are edits of their own."""
    stop = start + len(deleted)
    code = [place for place, token in enumerate(inserted) if deleted and not is_trivia(token)]
    head = code[0] if code and not is_trivia(deleted[0]) else 0
    tail = code[-1] + 1 if code and not is_trivia(deleted[-1]) else len(inserted)
    if head:
        yield Edit(start, start, inserted[:head], (), start, start)
    yield Edit(start, stop, inserted[head:tail], deleted, start, stop)
    if tail < len(inserted):
        yield Edit(stop, stop, inserted[tail:], (), stop, stop)


def _placed(start: int, deleted: tuple[str, ...], inserted: tuple[str, ...], old: Sequence[str], space: range) -> Edit:
    """An insertion or deletion, put where it comprises whole lines if there is such a place; `space` is all it has."""
    stop = start + len(deleted)
    run = deleted or inserted
    up = down = 0
    while start - up > space.start and old[start - up - 1] == run[(-up - 1) % len(run)]:
        up += 1
    while stop + down < space.stop and old[stop + down] == run[down % len(run)]:
        down += 1
    shifts = range(-up, down + 1)
    whole = [
        shift
        for shift in shifts
        if run[(shift - 1) % len(run)] == NEWLINE and (start + shift == 0 or old[start + shift - 1] == NEWLINE)
    ]
    places = whole or shifts
    turn = places[-1] % len(run)
    run = run[turn:] + run[:turn]
    return Edit(
        start + places[-1],
        stop + places[-1],
        () if deleted else run,
        run if deleted else (),
        start + places[0],
        stop + places[-1],
        bool(whole),
    )

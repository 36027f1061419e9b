"""Finds the literals of a source that an edit of a record comes from, by trying and looking.

1. All numbers of the source that may be behind an edit are moved a little, at once: two readings show the numbers that
   each of them feeds (see `feeds`). An edit whose literal feeds another number, too, stays.
2. An edit that shows nowhere, such as an axis, is tried at the tags of its element. One reading with all new attributes
   and elements shows which of them an edit may be.
3. All changes are tried together: the robot is read with them. They are right if all edited values are as the user
   wrote them, and no other one changed. Else the halves are tried. So a wrong guess leaves an edit out, and never gets
   into the patch.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from pathlib import Path
from typing import NamedTuple

from urdfsync.analysis.patches.edited import EditedValue
from urdfsync.analysis.patches.feeds import Feeds, NewTexts, Place
from urdfsync.analysis.patches.literals import Literal, decoded, find_literals, replaced
from urdfsync.analysis.patches.sources import Contents, Key, Look, SourceReader
from urdfsync.analysis.patches.tags import find_empty, find_same, start_tags
from urdfsync.analysis.patches.unified import path_in
from urdfsync.common.diagnostics import Severity, UrdfsyncError
from urdfsync.common.files import shown
from urdfsync.project.config import working_folder

_WHOLE = "robot"
"""The owner of records that repeat or derive numbers of elements, such as positions at the start."""
_LONGEST = 12
"""The greatest number of digits of a number that is converted into the unit of its cell."""
_PLACES = 9
"""Decimals by which an angle in degrees is recognised."""


class _Trial(NamedTuple):
    """Edits that belong together, and changes of the source that may be these edits."""

    values: Sequence[EditedValue]
    changes: NewTexts


class Search:
    """The search for the changes of one robot's source; it writes nothing."""

    def __init__(
        self,
        reader: SourceReader,
        look: Callable[[Contents], Look],
        owners: Mapping[str, str],
        values: Sequence[EditedValue],
        others: Sequence[SourceReader],
        top: Path,
    ) -> None:
        """`look` reads the robot with other contents; `owners` has the element of each record.

        The `others` read robots that must not change. The patch has no files outside of `top`.
        """
        self._reader, self._look, self._owners, self._robots, self._top = reader, look, owners, others, top
        self._values = {value.key: value for value in values}
        self._contents = reader.contents()
        self.before, numbers = self._read({})
        self._feeds = Feeds(lambda texts: self._read(texts)[1], numbers)
        self.changes: NewTexts = {}
        self._accepted = list[EditedValue]()
        self.reasons = dict[Key, str]()
        """Why edits are not in the patch."""

    def run(self) -> None:
        """Find the changes."""
        for value in self._values.values():
            if value.old and self.before.values.get(value.key) != value.old:
                first = "settle the conflict with `urdfsync resolve`" if value.is_in_conflict else "build"
                self.reasons[value.key] = f"the source has changed it, too: {first} first"
        known = [value for value in self._values.values() if value.key not in self.reasons]
        self._trace_literals([value for value in known if value.old])
        trials = list(self._by_literal(known))
        hidden = [value for value in known if not any(value in trial.values for trial in trials)]
        candidates = self._at_tags(hidden)
        while trials or any(candidates[value.key] for value in hidden):
            trials += [_Trial([value], candidates[value.key].pop(0)) for value in hidden if candidates[value.key]]
            self._settle([trial for trial in trials if not self._is_shared(trial)])
            trials, hidden = [], [value for value in hidden if value not in self._accepted]
        for value in hidden:
            self.reasons.setdefault(value.key, self._why_unknown(value))

    def _read(self, texts: NewTexts) -> tuple[Look, dict[Place, float]]:
        """Return the robot, and all numbers of its records, of an expanded text, and of the other robots' sources."""
        contents = replaced(self._contents, texts)
        look = self._look(contents)
        records = ((key, value) for key, value in look.values.items() if isinstance(value, tuple))
        numbers = {(*key, k): number for key, value in records for k, number in enumerate(value)}
        for k, literal in enumerate(find_literals(Path(), look.text.content) if look.text.expansion else ()):
            numbers["", "{}:{}".format(*look.text.place(literal.line)), k] = literal.value
        for other in self._robots:
            numbers |= {(other.name, "", k): number for k, number in enumerate(other.numbers(contents))}
        return look, numbers

    # --- candidates -----------------------------------------------------------------------------------------------

    def _trace_literals(self, values: Sequence[EditedValue]) -> None:
        """Find the numbers that the literals behind these edits feed."""
        wanted = {(*value.key, k): value.old[k] for value in values for k in value.changed}
        literals = [each for file, content in self._contents.items() for each in find_literals(file, content)]
        numbers, cells = {*wanted.values()}, {*self._cells({self._owner(value) for value in values}, literals)}
        degrees = {round(math.degrees(number), _PLACES) for number in numbers}
        possible = {
            each: (each.value,)
            for each in literals
            if each.value in numbers or round(each.value, _PLACES) in degrees or each in cells
        }
        moved = self._feeds.trace(possible, wanted.keys())
        # 0 and 1 may stand beside a number without an effect, as in `1.0*m + 0`, and were moved with it
        for sizes in ((lambda size: size not in (0, 1)), (lambda size: size == 1), (lambda size: size == 0)):
            shown = self._feeds.direct.keys()
            hidden = {place for place in moved & wanted.keys() - shown if sizes(abs(wanted[place]))}
            if hidden and self.before.text.expansion:
                self._feeds.trace({each: own for each, own in possible.items() if sizes(abs(each.value))}, hidden)

    def _cells(self, owners: set[str], literals: Sequence[Literal]) -> Iterator[Literal]:
        """Yield the numbers in the lines of elements: they may have other units. An expanded source has none."""
        places = sorted(
            (Path(working_folder() / file), line, path) for path, (file, line) in self.before.places.items()
        )
        for number, (file, line, path) in enumerate(places if not self.before.text.expansion else ()):
            if path in owners:
                end = next((other for at, other, _ in places[number:] if at == file and other > line), math.inf)
                names = re.split(r"[\s-]", path)
                of_file = (each for each in literals if each.file == file and line <= each.line < end)
                yield from (each for each in of_file if each.text not in names)

    def _by_literal(self, values: Sequence[EditedValue]) -> Iterator[_Trial]:
        """Yield the edits whose literals are known: those with a literal in common together, with its new text."""
        groups = list[tuple[list[EditedValue], set[tuple[Literal, str]]]]()
        for value in values:
            found = [self._change(value, k) for k in value.changed] if value.old else [None]
            changes = {change for change in found if change}
            if None in found:
                continue
            group = [value]
            for other in [other for other in groups if {*dict(other[1])} & {*dict(changes)}]:
                groups.remove(other)
                group, changes = [*other[0], *group], other[1] | changes
            groups.append((group, changes))
        for group, changes in groups:
            yield _Trial(group, dict(changes))

    def _change(self, value: EditedValue, k: int) -> tuple[Literal, str] | None:
        """Return the literal behind an edited number with its new text, in the unit of its cell; None if unknown."""
        place, word = (*value.key, k), value.words[k]
        if literal := self._feeds.direct.get(place):
            return literal, word
        literal, factor = self._feeds.computed.get(place, (None, 0.0))
        if literal is None or not self._has_other_unit(place):
            return None
        old = Decimal(repr(value.old[k])) / Decimal(repr(literal.value)) if literal.value else Decimal(f"{factor:.6g}")
        number = Decimal(f"{Decimal(word) / old:.14g}").normalize()
        return (literal, f"{number:f}") if len(number.as_tuple().digits) <= _LONGEST else None

    def _has_other_unit(self, place: Place) -> bool:
        """Whether a number is a multiple of one number of a plain source."""
        literal, factor = self._feeds.computed[place]
        is_multiple = math.isclose(factor * literal.value, self._values[place[:2]].old[place[2]], rel_tol=1e-6)
        return is_multiple and self.before.text.expansion is None

    def _at_tags(self, values: Sequence[EditedValue]) -> dict[Key, list[NewTexts]]:
        """Return changes of the tags of its element that each edit may be; one reading tries all new attributes."""
        candidates = {value.key: list[NewTexts]() for value in values}
        empty = {value.key: list[Literal]() for value in values}
        for value in values:
            for file, line, present in self._lines(value):
                text = decoded(self._contents[file])
                for tag in start_tags(text, line):
                    candidates[value.key] += find_same(file, text, tag, value)
                    if self._reader.can_grow:
                        empty[value.key] += find_empty(file, text, line, tag, value, present)
        moved = self._feeds.trace({each: value.new for value in values for each in empty[value.key]}, frozenset())
        for value in values:
            places = [(*value.key, k) for k in range(len(value.new))]
            shown = [each for each in empty[value.key] if each in map(self._feeds.direct.get, places)]
            possible = shown or (empty[value.key] if moved & {*places} else [])
            candidates[value.key] += [{each: " ".join(value.words)} for each in possible]
        return candidates

    def _lines(self, value: EditedValue) -> Iterator[tuple[Path, int, list[str]]]:
        """Yield the lines of the parts of an edited element, with the names of elements below these parts."""
        parts, owner = dict[tuple[str, int], list[str]](), self._owner(value)
        for path, place in sorted(self.before.places.items(), key=lambda item: item[1]):
            if path == owner or path.startswith(f"{owner} / "):
                parts.setdefault(place, []).append(path)
        for (name_of_file, line), paths in parts.items():
            below = (each.rpartition(" / ") for each in self.before.places)
            if (file := Path(working_folder() / name_of_file)) in self._contents:
                yield file, line, [name for above, _, name in below if above in paths]

    # --- trials ---------------------------------------------------------------------------------------------------

    def _settle(self, trials: Sequence[_Trial], *, is_faulty: bool = False) -> bool:
        """Accept the trials that are right, and tell why others are not; return whether all are right.

        `is_faulty` says that one of several trials is known to be wrong.
        """
        values = [value for trial in trials for value in trial.values]
        if not trials:
            return True
        changes = {literal: text for trial in trials for literal, text in trial.changes.items()}
        is_known = is_faulty and len(trials) > 1
        if not is_known and not (misfit := self._misfit(values, changes)):
            self._accepted += values
            self.changes |= changes
            for value in values:
                self.reasons.pop(value.key, None)
            return True
        if len(trials) == 1:
            self.reasons |= {value.key: misfit for value in values}
        else:
            half = len(trials) // 2
            self._settle(trials[half:], is_faulty=self._settle(trials[:half]))
        return False

    def _is_shared(self, trial: _Trial) -> bool:
        """Whether the readings have shown that the changes can't be these edits; tell why."""
        sources = {place: literal for place, (literal, _) in self._feeds.computed.items()} | self._feeds.direct
        fed = [place for place in self._feeds.before if sources.get(place) in trial.changes]
        others = self._others(fed, self._values, _count(trial.values, trial.changes))
        outside = {shown(each.file) for each in trial.changes if path_in(self._top, each.file) is None}
        reasons = [f"its number is in {file}, outside of {shown(self._top)}" for file in outside]
        reason = "; ".join(reasons) if outside else _also_feeds(trial.changes, others)
        self.reasons |= {value.key: reason for value in trial.values if reason}
        return bool(reason)

    def _others(self, places: Iterable[Place], edited: Collection[Key], most: int) -> list[str]:
        """Return the places of numbers that are none of the edited ones, in words.

        Records of the whole robot follow. If not more than `most` numbers of the source's text are among the places,
        they are the edited ones.
        """
        files, others, lines = {path for path, _ in edited}, list[str](), list[str]()
        for path, name, _ in places:
            owner = self._owners.get(path, path)
            if not path:
                lines.append(name)
            elif (path, name) not in edited and (owner != _WHOLE or path in files):
                others.append(f"{name} of {owner}" if name else f"robot `{path}`")
        return others or (lines if len(lines) > most else [])

    def _misfit(self, values: Sequence[EditedValue], changes: NewTexts) -> str:
        """Return why changes are not exactly these edits; empty if they are. Accepted changes are made, too."""
        try:
            look, numbers = self._read(self.changes | changes)
        except UrdfsyncError as error:
            fault = min(error.diagnostics, key=lambda each: each.severity is not Severity.ERROR)
            return f"the source would be wrong: {fault.message}"
        edited = {value.key: value for value in [*self._accepted, *values]}
        if any(look.values.get(key) != value.new for key, value in edited.items()):
            return "the source computes it, or another edit changes the same number"
        sides = self._feeds.before, numbers
        # an inserted element moves all lines below: numbers of the text are only counted
        before, now = (Counter(number for place, number in side.items() if not place[0]) for side in sides)
        keys = {**self.before.values, **look.values}
        changed = [(*key, 0) for key in keys if self.before.values.get(key) != look.values.get(key)]
        places = (place for place in {**sides[0], **sides[1]} if sides[0].get(place) != sides[1].get(place))
        changed += [place for place in places if not place[1] or (not place[0] and numbers.get(place) in now - before)]
        return _also_feeds(changes, self._others(changed, edited, _count(edited.values(), self.changes | changes)))

    def _owner(self, value: EditedValue) -> str:
        return self._owners.get(value.key[0], "")

    def _why_unknown(self, value: EditedValue) -> str:
        for k in value.changed:
            place = (*value.key, k)
            if place in self._feeds.computed:
                literal, factor = self._feeds.computed[place]
                at = f"{shown(literal.file)}:{literal.line}"
                if self._has_other_unit(place):
                    return f"{at} has it in another unit, in which {value.words[k]} is no plain number"
                if math.isclose(factor, math.radians(1), rel_tol=1e-6):
                    return f"it is in degrees in {at}"
                return f"it is computed from the number in {at}"
        if any(b"\0" in content for content in self._contents.values()):
            return "a workbook is no text: change its cell"
        line = "{}:{}".format(*self.before.places[owner]) if (owner := self._owner(value)) in self.before.places else ""
        return f"no number of the source{line and f' ({line})'} is this one: it is computed, or a default"


def _count(values: Iterable[EditedValue], changes: NewTexts) -> int:
    """Return how many numbers of a text may change: an edit may change some, and a new attribute has others, too."""
    return max(sum(len(value.changed) for value in values), len(" ".join(changes.values()).split()))


def _also_feeds(changes: Iterable[Literal], others: Sequence[str]) -> str:
    """Return that the literals feed these places, too; empty without places."""
    places = ", ".join(f"{name}:{line}" for name, line in sorted({(each.file.name, each.line) for each in changes}))
    others = list(dict.fromkeys(others))
    return f"its number in {places} also feeds {', '.join(others[:3])}{', …' * (len(others) > 3)}" if others else ""

"""Finds the literals of a source that an edit of a record comes from, by trying and looking.

1. Each number of the source that equals an edited one gets a value of its own, a neighbour of the number. The robot is
   read again: a record that shows this value shows where its number comes from, through all of xacro.
2. An edit that shows nowhere, such as an axis, is tried at the tags of its element.
3. Each change is tried: the robot is read with it. It is right if all edited values are as the user wrote them, and no
   other one changed. So a wrong guess leaves an edit out, and never gets into the patch.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

from urdfsync.config import working_folder
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.patches.edited import EditedValue
from urdfsync.patches.literals import Literal, decoded, find_literals, literals_in, neighbour, replaced
from urdfsync.patches.sources import Contents, Key, Look

NewTexts: TypeAlias = dict[Literal, str]
"""The new texts of literals."""
_TAG = re.compile(r"""<[\w:.-]++(?:[^<>"']++|"[^"]*"|'[^']*')*+>""")
_ATTRIBUTE = re.compile(r"""\s([\w:.-]+)\s*=\s*(?:"([^"]*)"|'([^']*)')""")
_LINE_END = re.compile(r"\r\n|\r|\n")
_FEEDS = " also feeds "
_WHOLE = "robot"
"""The owner of records that repeat or derive numbers of elements, such as positions at the start."""


class Search:
    """The search for the changes of one robot's source; it writes nothing."""

    def __init__(
        self,
        look: Callable[[Contents], Look],
        contents: Contents,
        owners: Mapping[str, str],
        values: Sequence[EditedValue],
        refused: Callable[[Contents], Sequence[str]],
    ) -> None:
        """`refused` tells why changed contents can't be in the patch; `owners` has the element of each record."""
        self._look, self._contents, self._owners, self._refused = look, contents, owners, refused
        self._values = {value.key: value for value in values}
        self.before = look({})
        self.changes: NewTexts = {}
        self._accepted = list[EditedValue]()
        self.reasons = dict[Key, str]()
        """Why edits are not in the patch."""

    def run(self) -> None:
        """Find the changes."""
        known = list[EditedValue]()
        for value in self._values.values():
            if value.old and self.before.values.get(value.key) != value.old:
                self.reasons[value.key] = "the source has changed it, too: build first"
            else:
                known.append(value)
        origins = self._find_origins(
            {(value.key, k): value.old[k] for value in known if value.old for k in value.changed}
        )
        groups = list(_by_literal(known, origins))
        together = {literal: text for _, changes in groups for literal, text in changes.items()}
        if groups and not self._misfit([value for values, _ in groups for value in values], together):
            groups = [([value for values, _ in groups for value in values], together)]
        for values, changes in groups:
            if (misfit := self._misfit(values, changes)) and not self._retry(values):
                self.reasons |= dict.fromkeys((value.key for value in values), misfit)
            elif not misfit:
                self._accept(values, changes)
        for value in known:
            if value not in self._accepted and value.key not in self.reasons and not self._retry([value]):
                self.reasons.setdefault(value.key, self._why_unknown(value))

    def _accept(self, values: Sequence[EditedValue], changes: NewTexts) -> None:
        self._accepted += values
        self.changes = self._with(changes)

    def _with(self, changes: NewTexts) -> NewTexts:
        """Return the accepted changes with further ones; what is inserted at one place follows each other."""
        inserted = {
            literal: f"{self.changes.get(literal, '')}{new}" for literal, new in changes.items() if not literal.text
        }
        return self.changes | changes | inserted

    def _find_origins(self, numbers: Mapping[tuple[Key, int], float]) -> dict[tuple[Key, int], Literal]:
        """Return the literals behind numbers of records, by the value and the place in it."""
        by_number = dict[float, list[Literal]]()
        for file, content in self._contents.items():
            for literal in find_literals(file, content):
                by_number.setdefault(float(literal.text), []).append(literal)
        wanted = {*numbers.values()} & by_number.keys()
        origins = self._trace([literal for number in wanted for literal in by_number[number]])
        # a factor `1.0*` beside a number was changed with it: try each number alone
        for number in {numbers[place] for place in numbers.keys() - origins.keys()} & wanted if len(wanted) > 1 else ():
            origins |= self._trace(by_number[number])
        return origins

    def _trace(self, literals: Sequence[Literal]) -> dict[tuple[Key, int], Literal]:
        """Return the literal behind each number of the records that is one of these literals."""
        if not literals:
            return {}
        marks = {neighbour(float(literal.text), number): literal for number, literal in enumerate(literals, 1)}
        try:
            seen = self._look(replaced(self._contents, {literal: repr(mark) for mark, literal in marks.items()})).values
        except UrdfsyncError:
            seen = {}
        if seen.keys() != self.before.values.keys():  # one of them must stay, such as a count: try the others
            half = len(literals) // 2
            return self._trace(literals[:half]) | self._trace(literals[half:]) if half else {}
        numbers = ((key, k, number) for key, value in seen.items() for k, number in enumerate(value or ()))
        return {(key, k): marks[number] for key, k, number in numbers if number in marks}

    def _misfit(self, values: Sequence[EditedValue], changes: NewTexts) -> str:
        """Return why changes are not exactly these edits; empty if they are. Accepted changes are made, too."""
        changes = self._with(changes)
        contents = replaced(self._contents, changes)
        try:
            if reasons := self._refused(contents):
                return "; ".join(reasons)
            now = self._look(contents)
        except UrdfsyncError as error:
            return f"the source would be wrong: {error.diagnostics[0].message}"
        edited = [*self._accepted, *values]
        if any(now.values.get(value.key) != value.new for value in edited):
            return "the source computes it, or another edit changes the same number"
        if others := self._others(now, edited):
            places = ", ".join(sorted({f"{literal.file.name}:{literal.line}" for literal in changes}))
            return f"its number in {places}{_FEEDS}{', '.join(others[:3])}{', …' * (len(others) > 3)}"
        return ""

    def _others(self, now: Look, edited: Sequence[EditedValue]) -> list[str]:
        """Return the places that change beside the edited values."""
        wanted = {value.key: value.new for value in edited}
        files = {path for path, _ in wanted}
        others = list[str]()
        for key in dict.fromkeys([*self.before.values, *now.values]):
            follows = self._owners.get(key[0]) == _WHOLE and key[0] not in files
            if key not in wanted and not follows and self.before.values.get(key) != now.values.get(key):
                others.append(f"{key[1]} of {self._owners.get(key[0], key[0])}")
        return others or (self._lines_beyond(now, edited) if self.before.text.expansion else [])

    def _lines_beyond(self, now: Look, edited: Sequence[EditedValue]) -> list[str]:
        """Return the places of changed lines of the expanded source, if more changed than the edited values."""
        old, new = (look.text.content.decode().splitlines() for look in (self.before, now))
        if len(old) != len(new):  # an element was inserted
            added = Counter(new) - Counter(old)
            return [] if added.total() <= len(edited) else [line.strip() for line in added]
        pairs = [(n, a.split(), b.split()) for n, (a, b) in enumerate(zip(old, new, strict=True), 1) if a != b]
        words = sum(sum(map(str.__ne__, a, b)) + abs(len(a) - len(b)) for _, a, b in pairs)
        if words <= sum(len(value.changed) for value in edited):
            return []
        return list(dict.fromkeys("{}:{}".format(*self._place(line)) for line, _, _ in pairs))

    def _place(self, line: int) -> tuple[str, int]:
        """Return the file and the line that the user wrote, by a line of the source that is read."""
        return self.before.text.place(line)

    def _retry(self, values: Sequence[EditedValue]) -> bool:
        """Try an edit at the tags of its element; return whether one of them is right."""
        if len(values) != 1:
            return False
        value, owner = values[0], self._owners.get(values[0].key[0], "")
        for changes in self._at_tags(value, owner):
            if not (misfit := self._misfit(values, changes)):
                self._accept(values, changes)
                self.reasons.pop(value.key, None)
                return True
            if _FEEDS in misfit:
                self.reasons[value.key] = misfit
        return False

    def _at_tags(self, value: EditedValue, owner: str) -> Iterator[NewTexts]:
        """Yield changes of the tags of an element that may be an edit."""
        parts = dict[tuple[str, int], list[str]]()
        for path, line in sorted(self.before.lines.items(), key=lambda item: item[1]):
            if path == owner or path.startswith(f"{owner} / "):
                parts.setdefault(self._place(line), []).append(path)
        *_, around, name = ["", *map(_snake, value.key[1].split("."))]
        pairs = [(around, name), (name, "xyz" if len(value.new) > 1 else "value")]
        for (place, line), paths in parts.items():
            file = Path(working_folder() / place)
            text = decoded(self._contents[file]) if file in self._contents else ""
            # a second element would take the place of the first one, with a warning
            missing = [pair for pair in pairs if not any(f"{path} / {pair[0]}" in self.before.lines for path in paths)]
            for tag in _tags(text, line):
                yield from _replacing(file, text, tag, value)
                ends = [match.end() for match in _ATTRIBUTE.finditer(tag[0])] or [len(tag[0].rstrip("/>"))]
                if words := _new_attribute(value, tag[0], name):
                    yield {Literal(file, tag.start() + ends[-1], "", line): words}
                for element, attribute in missing if not tag[0].endswith("/>") else ():
                    new = f"<{element}{_new_attribute(value, '', attribute)}/>"
                    yield {Literal(file, tag.end(), "", line): f"{_indented(text, tag)}{new}"}

    def _why_unknown(self, value: EditedValue) -> str:
        owner = self._owners.get(value.key[0], "")
        line = self.before.lines.get(owner, 0)
        place = " ({}:{})".format(*self._place(line)) if line else ""
        return f"no number of the source{place} is this one: it is computed, or a default"


def _by_literal(
    values: Sequence[EditedValue], origins: Mapping[tuple[Key, int], Literal]
) -> Iterator[tuple[list[EditedValue], NewTexts]]:
    """Yield the edits whose literals are known: those with a literal in common together, with its new text."""
    groups = list[tuple[list[EditedValue], NewTexts]]()
    for value in values:
        if not value.old or not all((value.key, k) in origins for k in value.changed):
            continue
        group, changes = [value], {origins[value.key, k]: value.words[k] for k in value.changed}
        for other in [other for other in groups if other[1].keys() & changes.keys()]:
            groups.remove(other)
            group, changes = [*other[0], *group], other[1] | changes
        groups.append((group, changes))
    yield from groups


def _snake(name: str) -> str:
    return re.sub("([A-Z])", lambda match: f"_{match[1].lower()}", name)


def _tags(text: str, line: int) -> Iterator[re.Match[str]]:
    """Yield the start tags that begin in a line of a text."""
    starts = [0, *(match.end() for match in _LINE_END.finditer(text)), len(text)]
    for match in _TAG.finditer(text, starts[min(line, len(starts) - 1) - 1]):
        if match.start() >= starts[min(line, len(starts) - 1)]:
            return
        yield match


def _indented(text: str, tag: re.Match[str]) -> str:
    """Return the line end and the indentation of a new child of a tag; empty if its children are in the tag's line."""
    end = _LINE_END.match(text, tag.end())
    before = text[: tag.start()]
    line = before[max(before.rfind("\n"), before.rfind("\r")) + 1 :]
    return f"{end[0]}{line[len(line.rstrip()) :]}  " if end else ""


def _replacing(file: Path, text: str, tag: re.Match[str], value: EditedValue) -> Iterator[NewTexts]:
    """Yield the new numbers of each attribute that has the old ones."""
    for attribute in _ATTRIBUTE.finditer(tag[0]):
        group = 2 if attribute[2] is not None else 3
        start, end = (tag.start() + place for place in attribute.span(group))
        found = literals_in(file, text, start, end)
        if value.old and tuple(float(literal.text) + 0.0 for literal in found) == value.old:
            yield {found[k]: value.words[k] for k in value.changed}


def _new_attribute(value: EditedValue, tag: str, name: str) -> str:
    """Return a new attribute for a tag, in the quotes of its others; empty if the tag has the attribute."""
    names = [match[1] for match in _ATTRIBUTE.finditer(tag)]
    quote = "'" if "'" in tag and '"' not in tag else '"'
    return "" if name in names else f" {name}={quote}{' '.join(value.words)}{quote}"

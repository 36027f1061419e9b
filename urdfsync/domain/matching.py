"""Matches the elements of two versions of a model, for any domain.

All elements are matched at once. The rows of this table are tried in order, and the first match of an element counts.

| evidence | proves | does not prove | example |
| --- | --- | --- | --- |
| declared rename | a match | | `renamed = {hand = "gripper"}` |
| unique content | a match under any names | a new name for a part that keeps its neighbours | exchanged masses |
| equal content beside a match | a match | a new name, if the old name stays at its place | joint above a renamed link |
| name | a match | the same part, if content and place are others | a camera named as the removed hand |
| place beside a match | a match of elements without another | a match, if others have the content | a heavier hand |

A content is one telling aspect of an element, such as its shapes, or all aspects together, or a file. Zeros and ones
tell nothing: many origins and axes have them. Numbers are equal if they differ by `NOISE` at most. If an element's
aspects match different elements, only the one with the element's own name counts.

Rows of a table have no neighbours, so they have no places: a whole content counts, whatever its values are. But if only
zeros and ones changed under a name, the row keeps its name: somebody may have switched it on or off. A unique text
proves no new name: two pumps may have one maker. Two rows of equal content match if all other rows of this content have
kept their names.

If the place or a part of the content contradicts a match by name, or nothing but the name agrees, this is a `Doubt`.
The time is linear in the number of elements.
"""

from __future__ import annotations

import itertools
from collections import Counter, defaultdict
from collections.abc import Collection, Hashable, Iterable, Iterator, Mapping
from typing import Any, TypeAlias

import msgspec

from urdfsync.domain import ElementKey, Features
from urdfsync.domain.changes import NOISE

Elements: TypeAlias = Mapping[ElementKey, Features]


class Doubt(msgspec.Struct, frozen=True):
    """The reason why an element with the name of an old element is, or may be, another part."""

    element: str
    """Kind and name: `link hand`."""
    former: str = ""
    """The likely former name of this element; empty for a new element."""
    aspects: tuple[str, ...] = ()
    """The aspects that it shares with the old element of the former name."""
    moved_to: str = ""
    """The likely new name of the old element with this name; empty if unknown."""
    is_certain: bool = False
    """Whether the old element with this name is gone."""
    is_named_alike: bool = False
    """Whether nothing but the name is that of the old element."""


class Matching(msgspec.Struct, frozen=True):
    """The renamed elements, and the doubts about elements that have an old name, but may be other parts."""

    renames: Mapping[ElementKey, str] = {}
    """New names by old elements, in the order of the old elements."""
    doubts: Mapping[ElementKey, Doubt] = {}
    """Doubts by new elements; each of these has the name of an old element."""


def without_exchanges(matching: Matching, old: Elements) -> Matching:
    """Return a matching in which names win: exchanged names become doubts."""
    formers = {(kind, new): name for (kind, name), new in matching.renames.items()}
    exchanged = {key for key in matching.renames if (key[0], matching.renames[key]) in old or key in formers}
    doubts = {
        key: Doubt(" ".join(key), formers[key], (), matching.renames.get(key, "")) for key in formers if key in old
    }
    plain = {key: new for key, new in matching.renames.items() if key not in exchanged}
    return Matching(plain, {**matching.doubts, **doubts})


def match(old: Elements, new: Elements, declared: Mapping[ElementKey, ElementKey] = {}) -> Matching:
    """Match the elements of two versions; `declared` has new elements by old elements."""
    if not declared and old.keys() == new.keys() and not _has_moved(old, new):
        return Matching()
    return _Matcher(old, new, declared).run()


def _has_moved(old: Elements, new: Elements) -> bool:
    """Whether contents may have moved between elements; both versions have the same names."""
    changed = [key for key, features in old.items() if features != new[key]]
    if any(old[key].neighbours != new[key].neighbours or old[key].files != new[key].files for key in changed):
        return True
    before, after, _ = _comparable({key: old[key] for key in changed}, {key: new[key] for key in changed})
    holders = {(key[0], aspect): key for key in changed for aspect in after[key]}
    return any(holders.get((key[0], aspect), key) != key for key in changed for aspect in before[key])


class _Matcher:
    """The matches found so far."""

    def __init__(self, old: Elements, new: Elements, declared: Mapping[ElementKey, ElementKey]) -> None:
        self._old, self._new = old, new
        self._before, self._after, self._telling = _comparable(old, new)
        self._placed = _placed(old, new)
        self._children = _children(old), _children(new)
        self._pairs: dict[ElementKey, ElementKey] = {}
        self._taken: dict[ElementKey, ElementKey] = {}
        self._places = defaultdict[ElementKey, dict[ElementKey, None]](dict)
        """New elements at the places of old elements, next to matched elements."""
        self._removed, self._added = set[Hashable](), set[Hashable]()
        """Contents of old and of new elements that have no match."""
        self._unconfirmed = set[ElementKey]()
        """Elements that match by their names alone."""
        self._take(declared.items())

    def run(self) -> Matching:
        """Go through the table of the module's docstring."""
        votes = self._votes()
        self._take(self._proved(votes).items())
        self._spread(self._pairs, is_late=False)
        named = [(key, key) for key in self._old if key in self._new]
        by_name = self._take((key, key) for key, _ in named if self._is_equal(key, key))
        self._spread(by_name, is_late=False)
        by_name |= self._take(named)
        self._take(self._remaining())
        self._unconfirmed = {key for key in by_name if not self._has_kept(key, votes)}
        self._confirm(self._pairs)
        self._removed = {
            (key[0], aspects) for key, aspects in self._before.items() if key not in self._pairs and aspects
        }
        self._added = {(key[0], aspects) for key, aspects in self._after.items() if key not in self._taken and aspects}
        self._spread({key: self._pairs[key] for key in self._pairs.keys() - self._unconfirmed}, is_late=True)
        renames = {old: self._pairs[old][1] for old in self._in_order() if self._pairs.get(old, old) != old}
        doubts = self._doubts(by_name, votes)
        return Matching(renames, {key: doubts[key] for key in sorted(doubts)})

    def _in_order(self) -> list[ElementKey]:
        """Return the old elements sorted by kind, in the domain's order, and by name."""
        kinds = {kind: number for number, kind in enumerate(dict.fromkeys(kind for kind, _ in self._old))}
        return sorted(self._old, key=lambda key: (kinds[key[0]], key[1]))

    def _take(self, matches: Iterable[tuple[ElementKey, ElementKey]]) -> dict[ElementKey, ElementKey]:
        """Match the pairs whose elements have no match yet; return the new matches."""
        taken = dict[ElementKey, ElementKey]()
        for old, new in matches:
            if old in self._old and new in self._new and old not in self._pairs and new not in self._taken:
                self._pairs[old], self._taken[new], taken[old] = new, old, new
        return taken

    def _votes(self) -> dict[ElementKey, dict[ElementKey, bool]]:
        """Return, for each old element, the new elements that share a unique aspect with it.

        The value tells whether the aspect may prove a new name. A text alone can't: two pumps may have one maker.
        """
        votes = defaultdict[ElementKey, dict[ElementKey, bool]](dict)
        holders = defaultdict[tuple[str, Any], tuple[list[ElementKey], list[ElementKey]]](lambda: ([], []))
        for side, elements in enumerate((self._before, self._after)):
            for key, aspects in elements.items():
                telling = [aspect for aspect in aspects if aspect in self._telling]
                is_whole = aspects and key[0] not in self._placed
                for aspect in (*telling, aspects) if is_whole or (telling and len(aspects) > 1) else telling:
                    holders[key[0], aspect][side].append(key)
                for file in dict.fromkeys((self._new if side else self._old)[key].files):
                    holders[key[0], file][side].append(key)
        for (_, aspect), (olds, news) in holders.items():
            if len(olds) == len(news) == 1:
                is_named = isinstance(aspect, str) and olds == news and _has_name(aspect, olds[0][1])
                is_proof = aspect not in self._telling or not isinstance(aspect[1], str)
                found = votes[olds[0]]
                found.update({} if is_named else {news[0]: is_proof or found.get(news[0], False)})
        return votes

    def _proved(self, votes: Mapping[ElementKey, Mapping[ElementKey, bool]]) -> dict[ElementKey, ElementKey]:
        """Return the matches that contents prove."""
        proved = {
            key: key if key in found else next(iter(found))
            for key, found in votes.items()
            if key in found or (len(found) == 1 and all(found.values()))
        }
        claims = Counter(proved.values())
        proved = {key: match_ for key, match_ in proved.items() if key == match_ or claims[match_] == 1}
        return {
            key: match_
            for key, match_ in proved.items()
            if key == match_ or not (self._stays(key, proved) or self._is_contested(key, match_))
        }

    def _stays(self, key: ElementKey, proved: Mapping[ElementKey, ElementKey]) -> bool:
        """Whether an element keeps its name and its neighbours, judged by contents.

        An element of a kind without neighbours must keep all aspects that can identify it: only zeros and ones differ.
        """
        if key in self._new and key[0] not in self._placed:
            return self._telling & {*self._before[key]} == self._telling & {*self._after[key]}
        before = self._old[key].neighbours
        after = self._new[key].neighbours if key in self._new else {}
        return bool(before) and before == after and all(proved.get(one) == one for one in before.values())

    def _is_contested(self, key: ElementKey, match_: ElementKey) -> bool:
        """Whether a new name's element has the old place, or a removed name's element had the new place."""
        for relation, one in self._old[key].neighbours.items():
            if self._before[one] == self._after.get(one) and one not in self._new[match_].neighbours.values():
                heirs = self._children[1].get(one, {}).get(relation, ())
                if any(heir not in self._old for heir in heirs) and len(heirs) == 1:
                    return True
        for relation, one in self._new[match_].neighbours.items():
            if self._after[one] == self._before.get(one) and one not in self._old[key].neighbours.values():
                former = self._children[0].get(one, {}).get(relation, ())
                if any(each not in self._new for each in former) and len(former) == 1:
                    return True
        return False

    def _has_kept(self, key: ElementKey, votes: Mapping[ElementKey, Collection[ElementKey]]) -> bool:
        """Whether contents speak for an element's name, all or a unique one, or its neighbours have no match yet."""
        is_equal = bool(self._before[key]) and self._before[key] == self._after[key]
        before, after = self._old[key].neighbours, self._new[key].neighbours
        around = [(one, after[relation]) for relation, one in before.items() if relation in after]
        known = [pair for pair in around if pair[0] in self._pairs or pair[1] in self._taken]
        is_elsewhere = any(self._pairs.get(old) != new for old, new in known)
        return is_equal or key in votes.get(key, ()) or (len(known) < max(len(around), 1) and not is_elsewhere)

    def _confirm(self, matches: Mapping[ElementKey, ElementKey]) -> None:
        """Confirm elements beside these matches, and beside those, and so on."""
        waiting = [*matches.items()] if self._unconfirmed else []
        while waiting:
            old, new = waiting.pop()
            if old in self._unconfirmed:
                continue
            before, after = self._old[old].neighbours, self._new[new].neighbours
            around = {one for relation, one in before.items() if self._pairs.get(one) == after.get(relation)}
            for relation, children in self._children[0].get(old, {}).items():
                others = {*self._children[1].get(new, {}).get(relation, ())}
                around |= {one for one in children if self._pairs.get(one) in others}
            found = {one: self._pairs[one] for one in around & self._unconfirmed}
            self._unconfirmed -= found.keys()
            waiting += found.items()

    def _spread(self, matches: Mapping[ElementKey, ElementKey], *, is_late: bool) -> None:
        """Match the neighbours of matched elements, and their neighbours, and so on."""
        frontier, roots = dict(matches), self._roots()
        while frontier or roots:
            found = defaultdict[ElementKey, dict[ElementKey, None]](dict)
            for old, new in itertools.chain(roots, self._around(frontier)):
                if old[0] == new[0] and old not in self._pairs and new not in self._taken:
                    self._places[old][new] = None
                    if self._is_same(old, new, is_late=is_late):
                        found[old][new] = None
            claims = defaultdict[ElementKey, list[ElementKey]](list)
            for old, places in found.items():
                place = old if old in places else next(iter(places))
                if len(places) == 1 or place == old:
                    claims[place].append(old)
            roots = []
            frontier = self._take((olds[0], new) for new, olds in claims.items() if len(olds) == 1 or new in olds)
            if not frontier and is_late:
                frontier = self._take(self._between())
            self._confirm(frontier)

    def _roots(self) -> list[tuple[ElementKey, ElementKey]]:
        """Return the two roots, if each version has a single root and their contents are equal."""
        tops = [
            [key for key, features in elements.items() if not features.neighbours]
            for elements in (self._old, self._new)
        ]
        is_one = len(tops[0]) == len(tops[1]) == 1 and tops[0][0] in self._children[0]
        is_one = is_one and self._is_equal(tops[0][0], tops[1][0])
        return [(tops[0][0], tops[1][0])] if is_one else []

    def _around(self, matches: Mapping[ElementKey, ElementKey]) -> Iterator[tuple[ElementKey, ElementKey]]:
        """Yield pairs of an old and a new element at the same place, next to a matched pair."""
        for old, new in matches.items():
            after = self._new[new].neighbours
            yield from (
                (one, after[relation]) for relation, one in self._old[old].neighbours.items() if relation in after
            )
            mine, others = (children.get(key, {}) for children, key in zip(self._children, (old, new), strict=True))
            for relation in mine.keys() & others.keys():
                alike = defaultdict[Hashable, tuple[list[ElementKey], list[ElementKey]]](lambda: ([], []))
                for side, keys in enumerate((mine[relation], others[relation])):
                    for key in keys:
                        if key not in (self._taken if side else self._pairs):
                            alike[self._likeness(key, side)][side].append(key)
                for olds, news in alike.values():
                    if len(olds) == len(news) == 1:
                        yield olds[0], news[0]
                    else:
                        yield from ((key, key) for key in olds if key in news)

    def _likeness(self, key: ElementKey, side: int) -> Hashable:
        """Return the content of an element, with its matched neighbours and the contents of other neighbours."""
        elements, contents, matched = (
            (self._new, self._after, self._taken) if side else (self._old, self._before, self._pairs)
        )
        around = []
        for relation, one in elements[key].neighbours.items():
            match_ = None if one not in matched else one if side else self._pairs[one]
            around.append((relation, contents.get(one, ()) if match_ is None else match_))
        return key[0], contents[key], tuple(around)

    def _is_same(self, old: ElementKey, new: ElementKey, *, is_late: bool) -> bool:
        """Whether two elements at one place are the same."""
        is_named = old in self._new and old not in self._taken
        if self._is_equal(old, new):
            return old == new or not is_named or not self._is_equal(old, old) or self._has_another_place(old)
        # by place alone: the old name is gone or another's, and no other unmatched element has these contents
        is_unique = (old[0], self._before[old]) not in self._added and (new[0], self._after[new]) not in self._removed
        return is_late and not is_named and is_unique

    def _is_equal(self, old: ElementKey, new: ElementKey) -> bool:
        """Whether two elements have equal contents, and either the same files or files named after the elements."""
        if self._before[old] != self._after[new]:
            return False
        files, others = self._old[old].files, self._new[new].files
        return files == others or (
            len(files) == len(others)
            and all(
                file == other or (_has_name(file, old[1]) and _has_name(other, new[1]))
                for file, other in zip(files, others, strict=True)
            )
        )

    def _has_another_place(self, key: ElementKey) -> bool:
        """Whether the new element of this name has other neighbours than the old element."""
        before, after = self._old[key].neighbours, self._new[key].neighbours
        return any(one in self._pairs and after.get(name) != self._pairs[one] for name, one in before.items()) or any(
            one in self._taken and before.get(name) != self._taken[one] for name, one in after.items()
        )

    def _remaining(self) -> Iterator[tuple[ElementKey, ElementKey]]:
        """Yield pairs of elements without places: all other elements of the same content keep their names."""
        holders = defaultdict[Hashable, tuple[set[ElementKey], set[ElementKey]]](lambda: (set(), set()))
        for side, elements in enumerate((self._before, self._after)):
            for key, aspects in elements.items():
                if aspects and key[0] not in self._placed:
                    holders[key[0], aspects][side].add(key)
        for olds, news in holders.values():
            removed, added = olds - news, news - olds
            if len(removed) == len(added) == 1:
                (old,), (new,) = removed, added
                if len(olds) == 1 or not (old in self._new or new in self._old):  # else any may be the same
                    yield old, new

    def _between(self) -> Iterator[tuple[ElementKey, ElementKey]]:
        """Yield pairs of elements, each the only unmatched element of its kind between the same matched neighbours."""
        ends = defaultdict[Hashable, tuple[list[ElementKey], list[ElementKey]]](lambda: ([], []))
        for key, features in self._old.items():
            around = [self._pairs.get(one) for one in features.neighbours.values()]
            if key not in self._pairs and len(around) > 1 and None not in around:
                ends[key[0], frozenset(around)][0].append(key)
        for key, features in self._new.items():
            if key not in self._taken:
                ends[key[0], frozenset(features.neighbours.values())][1].append(key)
        yield from ((olds[0], news[0]) for olds, news in ends.values() if len(olds) == len(news) == 1)

    def _doubts(
        self, by_name: Collection[ElementKey], votes: Mapping[ElementKey, Collection[ElementKey]]
    ) -> dict[ElementKey, Doubt]:
        """Return the doubts about elements that have an old name."""
        changed, shuffled = defaultdict[Hashable, list[ElementKey]](list), set[Hashable]()
        for key, aspects in self._after.items():
            if key in self._old and self._taken.get(key) != key:
                shuffled.add((key[0], aspects))
            if self._taken.get(key, key) == key and self._before.get(key) != aspects:
                changed[key[0], aspects].append(key)
        has_moved = any(old != new for old, new in self._pairs.items())  # if nothing moved, places tell nothing
        removed = {
            (key[0], aspects)
            for key, aspects in self._before.items()
            if key not in self._pairs or (key[0] not in self._placed and self._after[self._pairs[key]] != aspects)
        }
        held = {(key[0], aspect): key[1] for key in self._in_order() for aspect in self._before[key]}
        doubts = dict[ElementKey, Doubt]()
        for key in by_name:
            is_other = self._before[key] != self._after[key]
            is_other = is_other and not (key[0] in self._placed and self._shared(key, key))
            twins = changed.get((key[0], self._before[key]), []) if is_other else []
            is_former = is_other and (key[0], self._after[key]) in removed
            places = [place for place in self._places.get(key, {}) if place != key]
            is_shuffled = (key[0], self._before[key]) in shuffled
            is_elsewhere = has_moved and (self._contradicts(key) or (places and key not in self._places[key]))
            if twins or votes.get(key) or is_former or is_shuffled or is_elsewhere:
                likely = next(iter((*votes.get(key, ()), *twins, *places)), ("", ""))
                formers = [held.get((key[0], aspect), "") for aspect in self._after[key]] if is_other else []
                former = next(filter(None, formers), "")
                shared = self._shared((key[0], former), key) if former else ()
                doubts[key] = Doubt(" ".join(key), former, shared, likely[1])
        for key in self._unconfirmed - doubts.keys():
            doubts[key] = Doubt(" ".join(key), is_named_alike=True)
        for key in by_name:
            around = self._new[key].neighbours.values()
            if key not in doubts and around and all(one in doubts for one in around):
                doubts[key] = Doubt(" ".join(key))
        for key in self._old.keys() - self._pairs.keys():
            if key in self._new:
                former = self._taken.get(key, (key[0], ""))[1]
                places = [place for place in self._places.get(key, {}) if place != key]
                moved_to = places[0][1] if places else ""
                doubts[key] = Doubt(" ".join(key), former, (), moved_to, is_certain=True)
        return doubts

    def _contradicts(self, key: ElementKey) -> bool:
        """Whether an element has other neighbours: all differ, or one that has this element as its neighbour.

        A removed neighbour counts only if the new neighbour matches another old element.
        """
        before, after = self._old[key].neighbours, self._new[key].neighbours
        others = [
            (one, self._taken.get(after[relation]) != one)
            for relation, one in before.items()
            if relation in after and (one in self._pairs or after[relation] in self._taken)
        ]
        is_elsewhere = any(is_other and key in self._old[one].neighbours.values() for one, is_other in others)
        return is_elsewhere or (bool(others) and all(is_other for _, is_other in others))

    def _shared(self, old: ElementKey, new: ElementKey) -> tuple[str, ...]:
        """Return the names of the aspects that two elements share."""
        shared = set(self._before[old]) & set(self._after[new])
        return tuple(name for name, *_ in sorted(shared, key=lambda aspect: str(aspect[0])))


Aspects: TypeAlias = tuple[tuple[str, Hashable], ...]


def _comparable(
    old: Elements, new: Elements
) -> tuple[dict[ElementKey, Aspects], dict[ElementKey, Aspects], set[tuple[str, Hashable]]]:
    """Return the aspects of all elements as keys that ignore noise, and the aspects that can identify an element.

    Zeros and ones can't: many origins and axes have them. Texts can if the kind has no places.
    """
    placed = _placed(old, new)
    values = [features.contents for elements in (old, new) for features in elements.values()]
    numbers = _clusters({number for value in values for number in _numbers(value)})
    order = dict.fromkeys(itertools.chain.from_iterable(values))  # a record may have another order than the source
    telling, sides = set[tuple[str, Hashable]](), list[dict[ElementKey, Aspects]]()
    for elements in (old, new):
        aspects_of = dict[ElementKey, Aspects]()
        for key, features in elements.items():
            contents = {name: features.contents[name] for name in order if name in features.contents}
            aspects = tuple((name, _frozen(value, numbers)) for name, value in contents.items())
            telling.update(
                aspect
                for aspect, value in zip(aspects, contents.values(), strict=True)
                if _is_telling(value, has_place=key[0] in placed)
            )
            aspects_of[key] = aspects
        sides.append(aspects_of)
    return sides[0], sides[1], telling


def _placed(*versions: Elements) -> set[str]:
    """Return the kinds whose elements have places."""
    return {key[0] for elements in versions for key, features in elements.items() if features.neighbours}


def _is_telling(value: Any, *, has_place: bool) -> bool:
    if isinstance(value, str):
        return not has_place
    if isinstance(value, float | int):
        return abs(value) not in (0, 1)
    inside = value.values() if isinstance(value, Mapping) else value if isinstance(value, list | tuple) else ()
    return any(_is_telling(item, has_place=has_place) for item in inside)


def _has_name(file: str, name: str) -> bool:
    """Whether the file's name contains the element's."""
    return name.lower() in file.rpartition("/")[2].lower()


def _numbers(value: Any) -> Iterator[float]:
    if isinstance(value, float | int):
        yield value
    elif isinstance(value, Mapping):
        yield from itertools.chain.from_iterable(map(_numbers, value.values()))
    elif isinstance(value, list | tuple):
        yield from itertools.chain.from_iterable(map(_numbers, value))


def _clusters(numbers: Collection[float]) -> dict[float, int]:
    """Return the cluster of each number: numbers share a cluster if they differ from the next number only by noise."""
    clusters, last, cluster = dict[float, int](), 0.0, 0
    for number in sorted(numbers):
        if number - last > NOISE * max(abs(number), abs(last)):
            cluster += 1
        clusters[number] = cluster
        last = number
    return clusters


def _frozen(value: Any, numbers: Mapping[float, int]) -> Hashable:
    """Return plain data as a key, with clusters for numbers."""
    if isinstance(value, str):
        return value
    if isinstance(value, float | int):
        return numbers[value]
    if isinstance(value, Mapping):
        return tuple((key, _frozen(item, numbers)) for key, item in sorted(value.items()))
    return tuple(_frozen(item, numbers) for item in value) if isinstance(value, list | tuple) else value


def _children(elements: Elements) -> dict[ElementKey, dict[str, list[ElementKey]]]:
    """Return, for each element, the elements that have it as a neighbour, by relation."""
    children = defaultdict[ElementKey, defaultdict[str, list[ElementKey]]](lambda: defaultdict(list))
    for key, features in elements.items():
        for relation, one in features.neighbours.items():
            children[one][relation].append(key)
    return dict(children)

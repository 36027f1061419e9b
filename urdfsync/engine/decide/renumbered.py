"""Finds numbered parts, such as `visual2` of a link, that an export counts anew: an edit goes with its part."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping

import msgspec

from urdfsync.domain import ElementKey, Features, Version, displaced
from urdfsync.engine.actions import Action
from urdfsync.engine.decide.differences import GONE, Differences, agrees
from urdfsync.engine.decide.renames import find_matching
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.matching import Doubt, match
from urdfsync.spelling import counted

Names = Mapping[str, Mapping[str, str]]
"""New components by old ones, if they differ: for files of an element by its new kind and name, else by an empty key.

Components in files of the whole model begin with the identifier of their element.
"""


class Renumbered(msgspec.Struct, frozen=True):
    """The new components of numbered parts by their old components."""

    since_complete: Names = {}
    """Since the last complete build."""
    since_seen: Names = {}
    """Since the last, incomplete build."""
    seen: frozenset[str] = frozenset()
    """The files whose texts have the names of the last, incomplete build, by key."""
    unproved: frozenset[str] = frozenset()
    """The files whose element has records on disk that the recorded model does not explain, by key."""

    def __bool__(self) -> bool:
        return bool(self.since_complete or self.since_seen)

    def components(self, action: Action) -> Mapping[str, str]:
        """Return the changed components that a file may use."""
        by_element = self.since_seen if action.path in self.seen else self.since_complete
        return by_element.get(action.owner, by_element.get("", {}))

    def names(self, action: Action, words: Iterable[str]) -> dict[str, str]:
        """Return new names by old names for these words of a file: a part's names begin with its component."""
        return _new_names(self.components(action), words)

    def describe(self, action: Action, names: Mapping[str, str]) -> str:
        """Return the new components of a file as a clause; `names` has the new names by old names of the file."""
        components = self.components(action)
        (old, new), *others = [(old, new) for old, new in names.items() if old in components] or [*names.items()]
        more = f" (and {counted(len(others), 'more number')})" if others else ""
        return f"`{old}` is now `{new}`{more}"

    def doubt(self, words: Collection[str], named: Collection[str]) -> Doubt | None:
        """Return the doubt about the first part that an edit of a file of the whole model uses; None without one.

        `named` has the elements whose identifiers are among the words. Without any, each element may be meant.
        """
        for owner, components in self.since_complete.items():
            names = _new_names(components, words) if owner and (owner in named or not named) else {}
            if names:
                return Doubt(owner, part=next(iter(names)))
        return None

    def doubts(self, edited: Iterable[Action]) -> dict[str, Doubt]:
        """Return a doubt for each edit whose numbers are unknown, by key.

        An incomplete build has settled the edit, before an export counted anew: the next build can't know whether the
        edit has the numbers before or after this export. Or a stranger may have written the recorded model.
        """
        unknown = self.seen | self.unproved
        parts = {one.path: (one.owner, self.components(one)) for one in edited if one.path in unknown}
        return {key: Doubt(owner, part=next(iter(each))) for key, (owner, each) in parts.items() if each}


NOT_RENUMBERED = Renumbered()


def find_renumbered(
    inputs: Inputs, generation: Generation, differences: Differences, edited: Iterable[Action]
) -> Renumbered:
    """Return the parts with other numbers than in the last complete build, and in the build since then."""
    last, now = inputs.last, generation.now
    if last.version is None:
        return NOT_RENUMBERED
    since_complete = find_numbers(inputs, last.version, now, differences.renames)
    edited = [one for one in edited if not inputs.files.is_chosen(one.path)]
    changed = {one.path: _former(one.owner, differences) for one in edited if since_complete.get(one.owner)}
    unproved = frozenset(key for key, owner in changed.items() if not agrees(inputs, {owner}))
    if last.seen is None or last.package is None:
        return Renumbered(since_complete, unproved=unproved)
    renames = find_matching(inputs.domain, last.seen, now.snapshot, {}).renames
    since_seen = find_numbers(inputs, Version(last.seen, now.imports), now, renames)
    is_seen = last.seen == now.snapshot
    seen = frozenset(one.path for one in edited if _is_later(inputs, one, is_seen=is_seen))
    return Renumbered(since_complete, since_seen, seen, unproved)


def _former(owner: str, differences: Differences) -> str:
    """Return the element as it was called in the last complete build."""
    kind, _, name = owner.partition(" ")
    return next((" ".join(old) for old, new in differences.renames.items() if (old[0], new) == (kind, name)), owner)


def _is_later(inputs: Inputs, action: Action, *, is_seen: bool) -> bool:
    """Whether the user's text has the names of the last, incomplete build: confirmed then, or with a newer base.

    `is_seen`: that build has read the present model, so a newer base is the generated text.
    """
    package, path = inputs.last.package, inputs.last.folder.path(action.origin or action.path)
    is_other = package is not None and path in package.artifacts and package.hash(path) != action.base
    # other templates change the text, too
    is_newer = is_other and (action.base == action.generated or not is_seen)
    return is_newer or action.mine in inputs.last.record.confirmed


def find_numbers(inputs: Inputs, old: Version, new: Version, renames: Mapping[ElementKey, str]) -> Names:
    """Return the new components of all elements of two versions; `renames` has new names of elements."""
    if old.snapshot == new.snapshot:
        return {}
    domain, gone = inputs.domain, displaced(renames)
    before, after = domain.numbered(old, new)
    if not before:
        return {}
    targets = inputs.last.target, inputs.robot.target
    olds, news = (domain.names(each.snapshot, target) for each, target in zip((old, new), targets, strict=True))
    names, common = dict[str, Mapping[str, str]](), dict[str, str]()
    for (kind, name), parts in before.items():
        new_name = renames.get((kind, name), name)
        present = after.get((kind, new_name), parts)
        if (kind, name) in gone or parts == present or not (components := _match(parts, present)):
            continue
        names[f"{kind} {new_name}"] = components
        start, new_start = olds[f"{kind}s"][name], news[f"{kind}s"][new_name]
        common |= {f"{start}{_capital(one)}": f"{new_start}{_capital(other)}" for one, other in components.items()}
    return {**names, "": common} if names else {}


def _new_names(components: Mapping[str, str], words: Iterable[str]) -> dict[str, str]:
    names = dict[str, str]()
    for word in dict.fromkeys(words) if components else ():
        for digits in re.finditer(r"[0-9]+", word):
            if new := components.get(word[: digits.end()]):
                names[word] = new + word[digits.end() :]
    return names


def _capital(name: str) -> str:
    return name[0].upper() + name[1:]


def _match(
    old: Mapping[str, tuple[ElementKey, Features]], new: Mapping[str, tuple[ElementKey, Features]]
) -> dict[str, str]:
    """Return the changed components of one element; a part that is gone, or in doubt, leaves its name to another."""
    matching = match(dict(old.values()), dict(new.values()))
    components, gone = {key: component for component, (key, _) in new.items()}, displaced(matching.renames)
    renamed = dict[str, str]()
    for component, (key, _) in old.items():
        if key in matching.renames:
            renamed[component] = components[key[0], matching.renames[key]]
        elif key in components and key not in gone and key not in matching.doubts:
            renamed[component] = components[key]
        elif component in new:
            renamed[component] = f"{component}{GONE}"
    return {component: new_component for component, new_component in renamed.items() if new_component != component}

"""Finds the new names of elements: the core matches them, and the configuration or a choice declares them."""

from __future__ import annotations

from collections.abc import Mapping

from urdfsync.domain import ElementKey, Snapshot, displaced
from urdfsync.engine.decide.parts import ids_of
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.renames import find_matching
from urdfsync.matching import Doubt, Matching


def match_with_last(inputs: Inputs, now: Snapshot, declared: Mapping[str, str]) -> Matching:
    """Match the elements of the last complete build with the present elements.

    While a conflict is open, one export may rename an element, and the next export may change its numbers. So this
    follows each part, by its id, through the model that the last build read. `declared` has only renames
    that no complete build has made.
    """
    last, domain = inputs.last, inputs.domain
    if last.version is None:
        return Matching()
    recorded, last_seen = last.version.snapshot, last.seen
    has_other_format = recorded != now and last.source_format != inputs.source.format
    direct = find_matching(domain, recorded, now, declared, is_pending=True, has_other_format=has_other_format)
    if last_seen is None:
        return direct
    existing = domain.features(now)
    recorded_ids = ids_of(last.elements, last.record.ids)
    seen = {part: key for key, part in ids_of(domain.features(last_seen), last.seen_ids).items()}
    opened = {(name, seen[part][1]) for (_, name), part in recorded_ids.items() if part in seen}
    remaining = {name: new for name, new in declared.items() if (name, new) not in opened}
    later = find_matching(domain, last_seen, now, remaining, is_pending=True, has_other_format=has_other_format)
    gone, followed = displaced(later.renames), dict[ElementKey, str]()
    for key, part in recorded_ids.items():
        if part in seen and seen[part] not in gone:
            new = later.renames.get(seen[part], seen[part][1])
            if (key[0], new) in existing:
                followed[key] = new
    found = {key: name for key, name in direct.renames.items() if key[1] in declared}
    for more in (followed, direct.renames):
        taken = {(kind, name) for (kind, _), name in found.items()}
        found |= {key: name for key, name in more.items() if key not in found and (key[0], name) not in taken}
    return Matching({key: name for key, name in found.items() if name != key[1]}, {**direct.doubts, **later.doubts})


def describe_doubt(doubt: Doubt, *, is_used: bool = False) -> str:
    """Return the doubt as a clause; `is_used` if a file of the whole robot uses the element's name."""
    name, aspects = doubt.element.partition(" ")[2], " and ".join(doubt.aspects)
    subject = f"it uses `{name}`, which" if is_used else f"`{name}`"
    if doubt.is_named_alike:
        return f"{subject} may be another part now: only its name is as before"
    if doubt.is_certain:
        return f"{subject} is another part now{f', the former `{doubt.former}`' if doubt.former else ''}"
    if doubt.former and not aspects:
        return f"{subject} may be the former `{doubt.former}` now"
    shared = f"its {aspects} {'are those' if len(doubt.aspects) > 1 else 'is that'} of the former `{doubt.former}`"
    neighbours = "parts next to it, or like it, have other names"
    return f"{subject} may be another part now: {shared if doubt.former else neighbours}"

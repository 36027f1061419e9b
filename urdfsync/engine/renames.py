"""Matches the elements of two versions of a model: the core finds new names, and the configuration declares some.

The option `renamed` of a robot declares renames. Each counts until a complete build has made it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from urdfsync.common.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.common.files import shown
from urdfsync.common.spelling import nearest
from urdfsync.domain import Domain, ElementKey, Features, Snapshot, displaced
from urdfsync.domain.changes import Formats
from urdfsync.domain.matching import Elements, Matching, match
from urdfsync.engine.inspect.inputs import Inputs


def find_matching(
    domain: Domain,
    old: Snapshot,
    new: Snapshot,
    declared: Mapping[str, str],
    *,
    is_pending: bool = False,
    has_other_format: bool = False,
) -> Matching:
    """Match the elements of two versions; `declared` maps old names to new names.

    Declared renames of a kind (links, joints) are ignored if the old version has the new names already. That is so if
    an element with one of the old names is equal in both versions. If `is_pending`, this element must also differ from
    the element with the new name: elements that look alike prove nothing. If the new version `has_other_format`, the
    elements without a match match by features that all formats have, and by places alone if they are more than half.
    """
    if old == new and not (declared and is_pending):
        return Matching()
    parts = domain.parts.pairs(old, new) if domain.parts else {}
    if domain.parts and parts:  # elements are alike if they differ in names of their parts alone
        old = domain.parts.renamed(old, {key: name for key, (_, name) in parts.items()})
    before, after = domain.features(old), domain.features(new)
    named = {(kind, name): (kind, declared[name]) for kind, name in before if name in declared}
    named = {key: new for key, new in named.items() if new in after}
    done = {
        key[0]
        for key, new in named.items()
        if before[key] == after.get(key) and not (is_pending and before[key].contents == after[new].contents)
    }
    named = {**parts, **{key: new for key, new in named.items() if key[0] not in done}}
    matching = match(before, after, named)
    pairs = _pairs(before, after, matching) if has_other_format else {}
    count = min(len(before), len(after))
    if not has_other_format or len(pairs) == count:
        return matching
    formats = domain.formats  # loads numpy, which takes as long as a build of a changed mass
    if formats is None:
        return matching
    # if most elements match, a part that matches by its place alone may be a new part at the place of a removed one
    further = _coarse_renames(formats, old, new, matching, pairs, by_places=2 * len(pairs) < count)
    return Matching({**further, **matching.renames}, matching.doubts)


def _pairs(before: Elements, after: Elements, matching: Matching) -> dict[ElementKey, ElementKey]:
    gone = displaced(matching.renames)
    new = {key: (key[0], matching.renames.get(key, key[1])) for key in before if key not in gone}
    return {key: to for key, to in new.items() if to in after}


def _coarse_renames(
    formats: Formats,
    old: Snapshot,
    new: Snapshot,
    matching: Matching,
    pairs: Mapping[ElementKey, ElementKey],
    *,
    by_places: bool,
) -> dict[ElementKey, str]:
    """Return the renames of elements that are not in `pairs`: by features of all formats, then `by_places` alone.

    `pairs` are the matched elements. A pair stays as it is even if its elements have no coarse features.
    """
    before, after, renames = formats.coarse_features(old), formats.coarse_features(new), dict[ElementKey, str]()
    matched, taken = set(pairs), set(pairs.values())
    for has_contents in (True, False) if by_places else (True,):
        sides = [before, after]
        if not has_contents:
            sides = [{key: Features({}, each.neighbours) for key, each in side.items()} for side in sides]
        known = _pairs(sides[0], sides[1], Matching({**renames, **matching.renames}))
        for key, name in match(sides[0], sides[1], known).renames.items():
            if key not in matched and (key[0], name) not in taken:
                renames[key] = name
        matched, taken = {*matched, *renames}, {*taken, *((kind, name) for (kind, _), name in renames.items())}
    return renames


def pending(inputs: Inputs) -> Mapping[str, str]:
    """Return the declared renames that no complete build has made yet."""
    done = inputs.last.record.renamed
    return {old: new for old, new in inputs.robot.renamed.items() if done.get(old) != new}


def check_declared(inputs: Inputs, now: Snapshot) -> Iterator[Diagnostic]:
    """Yield a note for each declared rename that the last complete build has made already.

    Raises ConfigError with all impossible renames.
    """
    robot, errors, open_renames = inputs.robot, list[Diagnostic](), pending(inputs)
    if not robot.renamed:
        return
    after, before = set(inputs.domain.features(now)), set(inputs.last.elements)
    for old, new in robot.renamed.items():
        olds, news = ({kind for kind, name in before if name == word} for word in (old, new))
        kinds = {kind for kind, name in after if name == new}
        place, hint, near = (shown(inputs.config.file), robot.lines[f"renamed.{old}"]), "correct it, or take it out", ""
        if old != new and kinds and (not before or (old in open_renames and olds & kinds)):
            continue
        if old == new:
            message = "both names are equal"
        elif not kinds:
            message, near = f"the source has no `{new}`", nearest(new, sorted(name for _, name in after))
        elif news & kinds and not (olds - kinds):
            message, hint = f"the last build has `{new}` already", f"take `{old}` out of `renamed`"
            yield Diagnostic(Severity.NOTE, "rename-done", f"robot `{robot.name}`: {message}", *place, hint=hint)
            continue
        else:
            message = f"the last build had no {' or '.join(sorted(kinds))} `{old}`"
            near = nearest(old, sorted(name for kind, name in before - after if kind in kinds))
        hint = f"did you mean `{near}`?" if near else hint
        message = f"robot `{robot.name}`: `{old}` can't be renamed to `{new}`: {message}"
        errors.append(Diagnostic(Severity.ERROR, "wrong-rename", message, *place, hint=hint))
    if errors:
        raise ConfigError(*errors)

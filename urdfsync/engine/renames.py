"""Elements that have another name: those that the domain recognises, and those that the configuration declares."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping

from urdfsync.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.domain import Domain, ElementKey, Snapshot, Target, displaced
from urdfsync.engine.inputs import Inputs
from urdfsync.engine.last_build import NO_MODEL
from urdfsync.files import shown
from urdfsync.spelling import nearest
from urdfsync.state.record import Open


def find_renames(domain: Domain, old: Snapshot, new: Snapshot, declared: Mapping[str, str]) -> dict[ElementKey, str]:
    """Return old element → new name. What follows from the declared renames is recognised, too."""
    if old == new:
        return {}
    known = _find_declared(domain, old, new, declared)
    if not known:
        return dict(domain.renames(old, new))
    return known | dict(domain.renames(domain.comparable(old, known), domain.comparable(new, {})))


def find_renames_since(
    domain: Domain, recorded: Snapshot, open_: Open | None, now: Snapshot, declared: Mapping[str, str]
) -> dict[ElementKey, str]:
    """Return elements that have another name since the last complete build: old element → new name.

    While something is open, an element may get another name in one export and other numbers in another. So the renames
    up to the model last seen are followed by those from it.
    """
    direct = find_renames(domain, recorded, now, declared)
    if open_ is None or not open_.seen:
        return direct
    later = find_renames(domain, open_.seen, now, declared)
    existing, elements = set(_elements(domain, now)), set(_elements(domain, open_.seen))
    gone, followed = displaced(open_.renamed), dict[ElementKey, str]()
    for kind, name in _elements(domain, recorded):
        if (kind, name) in gone:
            continue
        last_name = open_.renamed.get((kind, name), name)
        new_name = later.get((kind, last_name), last_name)
        if (kind, last_name) in elements and (kind, new_name) in existing:
            followed[kind, name] = new_name
    found = _find_declared(domain, recorded, now, declared)
    for more in (followed, direct):
        taken = {(kind, name) for (kind, _), name in found.items()}
        found |= {key: name for key, name in more.items() if key not in found and (key[0], name) not in taken}
    return {key: name for key, name in found.items() if name != key[1]}


def check_declared(inputs: Inputs, now: Snapshot) -> Iterator[Diagnostic]:
    """Yield a note for each declared rename that the last complete build has brought already.

    Raises ConfigError with each one that can't be.
    """
    robot, errors = inputs.robot, list[Diagnostic]()
    if not robot.renamed:
        return
    before, after = set[ElementKey](), set(_elements(inputs.domain, now))
    if inputs.last.version:
        with contextlib.suppress(*NO_MODEL):
            before.update(_elements(inputs.domain, inputs.last.version.snapshot))
    for old, new in robot.renamed.items():
        stays = sorted(kind for kind, name in after if name == old)
        kinds = sorted(kind for kind, name in after if name == new and kind not in stays)
        olds, news = ({kind for kind in kinds if (kind, name) in before} for name in (old, new))
        if kinds and (olds - news or not before):
            continue
        place, hint, near = (shown(inputs.config.file), robot.lines[f"renamed.{old}"]), "correct it, or take it out", ""
        if stays:
            message = f"the source still has {stays[0]} `{old}`"
        elif not kinds:
            message, near = f"the source has no `{new}`", nearest(new, sorted(name for _, name in after))
        elif news and not olds:
            message, hint = f"the last build has `{new}` already", f"take `{old}` out of `renamed`"
            yield Diagnostic(Severity.NOTE, "rename-done", f"robot `{robot.name}`: {message}", *place, hint=hint)
            continue
        elif olds:
            message = f"the last build has `{new}` beside `{old}`"
        else:
            message = f"the last build had no {' or '.join(kinds)} `{old}`"
            near = nearest(old, sorted(name for kind, name in before - after if kind in kinds))
        hint = f"did you mean `{near}`?" if near else hint
        message = f"robot `{robot.name}`: `{old}` can't be renamed to `{new}`: {message}"
        errors.append(Diagnostic(Severity.ERROR, "wrong-rename", message, *place, hint=hint))
    if errors:
        raise ConfigError(*errors)


def _find_declared(domain: Domain, old: Snapshot, new: Snapshot, declared: Mapping[str, str]) -> dict[ElementKey, str]:
    """Return the declared renames of elements that are gone to names that came; of each kind that has both."""
    if not declared:
        return {}
    before, after = set(_elements(domain, old)), set(_elements(domain, new))
    return {
        (kind, name): declared[name]
        for kind, name in sorted(before - after)
        if name in declared and (kind, declared[name]) in after - before
    }


def _elements(domain: Domain, snapshot: Snapshot) -> Iterator[ElementKey]:
    for kind, identifiers in domain.names(snapshot, Target("Package", "Model")).items():
        yield from ((kind.removesuffix("s"), name) for name in identifiers)

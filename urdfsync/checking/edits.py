"""What edits do to a robot: which of them there are, and what each changes by itself. Pure."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

from urdfsync.checking.verdict import TOLERANCE, Effect
from urdfsync.domain import Deviation
from urdfsync.files import normalised
from urdfsync.merge.tokens import is_trivia, tokens

Values: TypeAlias = Mapping[str, Sequence[float]]
"""Series of a simulation by the names of variables."""

MANY = 6
"""So many edited files are tried one by one at most; more of them are looked at together."""
_REST = 0.01
"""Part of a change that must be unexplained by single edits before it is told as one of several together."""


def edited(generated: Mapping[str, bytes], disk: Mapping[str, bytes]) -> list[str]:
    """The Modelica files that differ from what is generated, by their path below the package."""
    files = (path for path in sorted(generated) if path.endswith(".mo"))
    return [path for path in files if path in disk and normalised(disk[path]) != generated[path]]


def is_cosmetic(old: bytes, new: bytes) -> bool:
    """Whether two texts differ in comments, blanks and ends of line only."""
    one, two = ([t for t in tokens(text.decode(errors="replace")) if not is_trivia(t)] for text in (old, new))
    return one == two


def variants(
    files: Sequence[str], generated: Mapping[str, bytes], disk: Mapping[str, bytes]
) -> Iterator[tuple[str, Mapping[str, bytes]]]:
    """For each edited file a package in which nothing else is edited; the user's own files are in all of them."""
    own = {path: content for path, content in disk.items() if path not in generated}
    if 1 < len(files) <= MANY:
        for file in files:
            yield file, {**generated, **own, file: disk[file]}


def leftover(baseline: Values, whole: Values, single: Sequence[Values]) -> Values:
    """The simulation in which everything has happened but what each single edit does: what they do only together."""
    return {
        name: [
            base + (value - base) - sum(one[name][instant] - base for one in single)
            for instant, (base, value) in enumerate(zip(baseline[name], whole[name], strict=True))
        ]
        for name in baseline
        if name in whole and all(len(run.get(name, ())) == len(baseline[name]) for run in (whole, *single))
    }


def effects(
    files: Sequence[str],
    whole: Sequence[Deviation],
    single: Mapping[str, Sequence[Deviation]],
    rest: Sequence[Deviation],
) -> tuple[Effect, ...]:
    """What the edits in `files` do, each apart where that can be told, in their order.

    All deviations are from the generated package: `whole` of the one on disk, `single` of those with one edit each,
    `rest` of what none of these explains.
    """
    if len(files) == 1:
        return (Effect((files[0],), _beyond(whole)),)
    changed = {_key(one): one for one in _beyond(whole)}
    differing = {_key(one): one.difference for one in _beyond(rest)}
    together = tuple(one for key, one in changed.items() if not differing.get(key, 0.0) <= _REST * one.difference)
    apart = {file: Effect((file,), _beyond(single[file])) for file in files if file in single}
    unknown = [file for file in files if file not in single]
    if not together:
        return (*apart.values(), *([Effect(tuple(unknown), ())] if unknown else []))
    silent = [file for file in files if file in unknown or not apart[file].deviations] or list(files)
    kept = [effect for effect in apart.values() if effect.deviations]
    return (*kept, Effect(tuple(silent), together))


def _beyond(deviations: Sequence[Deviation]) -> tuple[Deviation, ...]:
    return tuple(one for one in deviations if not one.relative <= TOLERANCE)


def _key(one: Deviation) -> tuple[str, str, str]:
    return one.quantity, one.element, one.unit

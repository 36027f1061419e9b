"""What edits do to a robot: which of them there are, and what each changes by itself. Pure."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

from urdfsync.checking.verdict import TOLERANCE, Comparison, Effect
from urdfsync.files import normalised

MANY = 6
"""So many edited files are tried one by one at most; more of them are looked at together."""


def edited(generated: Mapping[str, bytes], disk: Mapping[str, bytes], besides: Collection[str]) -> list[str]:
    """The Modelica files that differ from what is generated, by their path below the package.

    `besides` are files that have no part in the comparison.
    """
    files = (path for path in sorted(generated) if path.endswith(".mo") and path not in besides)
    return [path for path in files if path in disk and normalised(disk[path]) != generated[path]]


def own(generated: Mapping[str, bytes], disk: Mapping[str, bytes]) -> dict[str, bytes]:
    """The files that are the user's alone."""
    return {path: content for path, content in disk.items() if path not in generated}


def variants(
    files: Sequence[str], generated: Mapping[str, bytes], disk: Mapping[str, bytes]
) -> Iterator[tuple[str, Mapping[str, bytes]]]:
    """For each edited file a package in which nothing else is edited; the user's own files are in all of them."""
    if 1 < len(files) <= MANY:
        for file in files:
            yield file, {**generated, **own(generated, disk), file: disk[file]}


def effects(
    files: Sequence[str], whole: Comparison, single: Mapping[str, Comparison], generated: Comparison
) -> tuple[Effect, ...]:
    """What the edits in `files` do: `whole` is the package with all of them, `single` with one of them each.

    What already differs in the `generated` package, and as much, does not come from an edit. Files that change
    something only together with others make one effect.
    """
    known = {(one.quantity, one.element): one.difference for one in generated.deviations}

    def beyond(comparison: Comparison) -> Effect:
        found = [
            one
            for one in comparison.deviations
            if not one.relative <= TOLERANCE
            and not abs(one.difference - known.get((one.quantity, one.element), 0.0)) <= TOLERANCE * max(1.0, one.size)
        ]
        return Effect((), tuple(sorted(found, key=lambda one: -one.relative)))

    if len(files) == 1:
        return (Effect((files[0],), beyond(whole).deviations),)
    apart = [Effect((file,), beyond(comparison).deviations) for file, comparison in single.items()]
    together = beyond(whole).deviations
    if set(files) != single.keys() or (together and not any(effect.deviations for effect in apart)):
        rest = tuple(file for file in files if file not in single) or tuple(files)
        return (*apart, Effect(rest, together))
    return tuple(apart)

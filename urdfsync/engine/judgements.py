"""Judgements about a model itself: legal parts that can hardly be meant, new ones first.

A judgement follows from the model alone, so the recorded model tells which ones are new since the last build.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

import msgspec

from urdfsync.common.diagnostics import Diagnostic
from urdfsync.domain import Domain, ElementKey, Reading, Version
from urdfsync.domain.comparison import Changes
from urdfsync.domain.features import Judgements
from urdfsync.engine.inspect.last_build import NO_MODEL


def judge(
    domain: Domain,
    now: Version,
    reading: Reading,
    file: str,
    last: Version | None = None,
    changes: Changes | None = None,
) -> list[Diagnostic]:
    """Return the judgements about a model at their places; `file` is its source's name.

    Those that the `last` version lacks are new; `changes` lead to it. Without a last version, nothing is new.
    """
    judgements = domain.judgements
    if judgements is None or now.snapshot is None:
        return []
    changes = changes or Changes()
    changed = {change.element for change in changes.changes}
    findings = list(judgements.judge(now, changed))
    if last is None or not findings:
        return [_placed(finding, reading, file) for finding in findings]
    known = set(_known(judgements, last, changes.renames, changed))
    return [
        _placed(finding, reading, file, is_new=(finding.code, finding.element) not in known) for finding in findings
    ]


def find_jumps(
    domain: Domain, now: Version, reading: Reading, file: str, last: Version, renames: Mapping[ElementKey, str]
) -> list[Diagnostic]:
    """Return the judgements about the differences of two models, all of them new."""
    judgements = domain.judgements
    jumps = judgements.find_jumps(last, now, renames) if judgements else ()
    return [_placed(jump, reading, file, is_new=True) for jump in jumps]


def _placed(finding: Diagnostic, reading: Reading, file: str, *, is_new: bool = False) -> Diagnostic:
    place, line = reading.place(finding.element, file)
    return msgspec.structs.replace(finding, file=place, line=line, is_new=is_new)


def _known(
    judgements: Judgements, last: Version, renames: Mapping[ElementKey, str], changed: Collection[str]
) -> Iterator[tuple[str, str]]:
    """Yield code and element of each judgement about the last model, by the names of the present model."""
    former = {f"{kind} {name}": f"{kind} {old}" for (kind, old), name in renames.items()}
    try:
        findings = list(judgements.judge(last, {former.get(element, element) for element in changed}))
    except NO_MODEL:  # the recorded model may be invalid
        return
    for finding in findings:
        element, separator, rest = finding.element.partition(" / ")
        kind, _, name = element.partition(" ")
        name = renames.get((kind, name), name)
        yield finding.code, f"{kind} {name}".rstrip() + separator + rest

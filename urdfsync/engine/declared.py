"""Declared renames: the option `renamed` of a robot. Each counts until a complete build has made it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from urdfsync.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.domain import Snapshot
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.files import shown
from urdfsync.spelling import nearest


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

"""Results as plain data, for programs: the parts of the JSON documents that `docs/json.md` describes."""

from __future__ import annotations

import datetime
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from urdfsync import difference, resolution, wording
from urdfsync.diagnostics import Diagnostic
from urdfsync.engine.actions import Action, Kind
from urdfsync.outcome import Result
from urdfsync.profiling import OTHER, STAGES, Profile
from urdfsync.status import FileState, RobotState

if TYPE_CHECKING:
    from urdfsync.changes import Change
    from urdfsync.checking.verdict import Verdict
    from urdfsync.comparing.comparison import Comparison
    from urdfsync.domain import Deviation
    from urdfsync.watch.events import Event

VERSION = 1
"""Version of the JSON documents and events; raised when a key changes its meaning or goes away."""


def change(found: Change) -> dict[str, Any]:
    """A change of the model as plain data."""
    return {
        "change": str(found),
        "kind": found.kind,
        "class": found.change_class,
        "old": found.old,
        "new": found.new,
        "unit": found.unit,
        "noise": found.noise,
    }


def finding(diagnostic: Diagnostic) -> dict[str, Any]:
    """A diagnostic as plain data."""
    return msgspec.structs.asdict(diagnostic)


def robot(result: Result) -> dict[str, Any]:
    """A result as plain data; paths are relative to the configuration's folder."""
    return {
        "name": result.robot,
        "package": result.package,
        "folder": str(result.folder),
        "failed": result.failed,
        "locked": result.locked,
        "in_step": result.in_step,
        "summary": wording.summary(result),
        "drawing": str(result.drawing) if result.drawing else None,
        "checked": result.checked,
        "class": result.changes.change_class if result.changes else difference.ChangeClass.NONE,
        "changes": [change(found) for found in result.changes.changes] if result.changes else [],
        "actions": [_action(action) for action in result.actions],
        "conflicts": [_conflict(target) for target in resolution.conflicts([result])],
        "diagnostics": [finding(diagnostic) for diagnostic in result.diagnostics],
    }


def profile(found: Profile) -> dict[str, Any]:
    """Where the time of a command went as plain data, in milliseconds."""
    here, counts = found.results()
    return {
        "ms": _ms(sum(here.values())),
        "stages": [
            {"stage": name, "ms": _ms(here.get(name, 0)), "elsewhere_ms": _ms(found.elsewhere[name])}
            for name in (*STAGES, OTHER)
            if here.get(name) or found.elsewhere[name]
        ],
        "counts": counts,
        "stamp": found.stamp,
    }


def _ms(nanoseconds: int) -> float:
    return round(nanoseconds / 1e6, 3)


def state(found: RobotState) -> dict[str, Any]:
    """How a robot stands as plain data."""
    values = robot(found.result)
    return {
        **{key: values[key] for key in ("name", "package", "folder", "failed", "locked")},
        "built": found.built,
        "in_step": found.in_step,
        "summary": wording.state(found),
        **{key: values[key] for key in ("class", "changes")},
        "files": [_file(file) for file in found.files],
        "diagnostics": values["diagnostics"],
    }


def comparison(found: Comparison) -> dict[str, Any]:
    """What changed in a source as plain data."""
    result = found.result
    return {
        "name": result.robot,
        "source": found.source,
        "against": found.against,
        "built": not found.missing,
        "failed": result.failed,
        "locked": result.locked,
        "in_step": found.in_step,
        "summary": wording.comparison(found),
        "class": found.change_class,
        "changes": [change(one) for one in found.changes.changes] if found.changes else [],
        "effects": [_effect(effect) for effect in found.effects],
        "actions": [{**_action(action), "edited": action.path in found.edited} for action in result.actions],
        "diagnostics": [finding(diagnostic) for diagnostic in result.diagnostics],
    }


def verdict(found: Verdict, strict: bool) -> dict[str, Any]:
    """What was checked of a robot as plain data; with `strict`, what an edit does is a difference as well."""
    from urdfsync.checking import words  # no other command has a use for it
    from urdfsync.checking.verdict import TOLERANCE

    return {
        "name": found.robot,
        "package": found.package,
        "standing": found.standing(strict),
        "failed": found.failed,
        "built": found.built,
        "in_step": found.in_step,
        "conflicting": found.conflicting,
        "summary": words.summary(found, strict),
        "compiled": [
            {"model": one.model, "unknowns": one.unknowns or None, "states": one.states if one.unknowns else None}
            for one in found.compiled
        ],
        "reference": found.reference,
        "tolerance": TOLERANCE,
        "agrees": found.generated.agrees if found.generated else None,
        "deviations": [_deviation(one) for one in found.generated.deviations] if found.generated else [],
        "edits": [
            {
                "files": list(one.files),
                "owners": list(one.owners),
                "deviations": [_deviation(each) for each in one.deviations],
            }
            for one in found.effects
        ],
        "notes": list(found.notes),
        "unchecked": list(found.unchecked),
        "gaps": list(found.gaps),
        "seconds": found.seconds,
        "megabytes": found.megabytes,
        "diagnostics": [finding(diagnostic) for diagnostic in found.diagnostics],
    }


def event(found: Event, time: datetime.datetime) -> dict[str, Any]:
    """An event of the daemon as plain data: its values under their own names, a result as the keys of `robot`.

    Of a result's files those are left out of which nothing can be said but that they are as they should be.
    """
    values: dict[str, Any] = {"version": VERSION, "event": found.__struct_config__.tag, "time": time.isoformat()}
    for name, value in msgspec.structs.asdict(found).items():
        if isinstance(value, Result):
            inside = {key: part for key, part in robot(value).items() if key != "checked"}  # an event of its own
            actions = [action for action in inside["actions"] if action["action"] != Kind.UNCHANGED]
            values |= {"robot": inside.pop("name"), **inside, "actions": actions}
        else:
            values[name] = _plain(value)
    return values


def _deviation(found: Deviation) -> dict[str, Any]:
    """How far a quantity of an element is from the reference; JSON has no words for what is no number."""
    numbers = {name: getattr(found, name) for name in ("difference", "relative", "value", "size")}
    finite = {name: number if math.isfinite(number) else None for name, number in numbers.items()}
    reason = "" if finite["difference"] is not None else "the simulation gave no number"
    return {"quantity": found.quantity, "element": found.element, **finite, "unit": found.unit, "reason": reason}


def _plain(value: object) -> Any:
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    if isinstance(value, Diagnostic):
        return finding(value)
    return str(value) if isinstance(value, Path) else value


def _effect(found: difference.Effect) -> dict[str, Any]:
    values = {"old": found.old, "new": found.new, "unit": found.unit, "hint": found.hint}
    return {"effect": " / ".join(found.path), **values}


def _file(file: FileState) -> dict[str, Any]:
    values = {**_action(file.action), "path": file.path, "reason": file.reason}
    return {"path": file.path, "status": file.status} | values


def _conflict(target: resolution.Target) -> dict[str, Any]:
    aside = resolution.aside(target)
    return {
        "path": target.action.path,
        "origin": target.action.origin,
        "owner": target.action.owner,
        "merges": target.merges,
        "reason": resolution.standing(target),
        "base": aside.base if aside else None,
        "generated": aside.generated if aside else None,
        "merge": aside.merge if aside else None,
    }


def _action(action: Action) -> dict[str, Any]:
    return {
        "path": action.path,
        "action": action.kind,
        "held": action.held,
        "owner": action.owner,
        "role": action.role,
        "reason": action.reason,
    }

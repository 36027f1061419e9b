"""Finds names in the user's models and configuration that an export has given to other parts.

Such a file still works, but with another part. So each build warns until the user saves the file. The notes of this
machine list each file with such names.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import msgspec

from urdfsync.answers import dependencies
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.actions import Reason
from urdfsync.engine.decide import Decision
from urdfsync.engine.differences import GONE, Differences
from urdfsync.engine.generation import Generation
from urdfsync.engine.inputs import Inputs
from urdfsync.engine.package_names import elements_by_identifier, identifier_of, known_names, renamed_names
from urdfsync.files import shown
from urdfsync.state.notes import Use

CODE = "other-part"
MAYBE = "?"
"""Stands for the new name of a part if it is unknown whether the name means another part now."""


def find_uses(inputs: Inputs, generation: Generation, differences: Differences, decision: Decision) -> dict[str, Use]:
    """Return the names in each file that mean another part now; names that earlier builds found are included."""
    uses = {path: use for path, use in inputs.last.notes.uses.items() if use.facts == _facts(Path(path))}
    if not decision.is_complete:
        return uses
    own = (inputs.files.path(action.path) for action in decision.actions if action.reason is Reason.UNKNOWN)
    files = [*inputs.users_files.mentioning, *own]
    if files and (names := _other_names(inputs, generation, differences)):
        for path in files:
            earlier = uses[str(path)].names if str(path) in uses else {}
            used = {name: names.get(new, new) for name, new in earlier.items()}
            used = {name: names[name] for name in _lines(path, names) if name not in earlier} | used
            uses.pop(str(path), None)
            if used := {name: new for name, new in used.items() if name != new}:
                uses[str(path)] = Use(_facts(path), used)
    elements = {**{name: MAYBE for _, name in differences.matching.doubts}, **differences.other_elements}
    if used := {name: elements[name] for name in _texts(msgspec.to_builtins(inputs.robot.options)) if name in elements}:
        uses[str(inputs.config.file)] = Use(_facts(inputs.config.file), used)
    return uses


def _other_names(inputs: Inputs, generation: Generation, differences: Differences) -> dict[str, str]:
    """Return the names in the package that mean other parts than in the last build, or may do so.

    Each has the new name of the part that had it before.
    """
    doubts, renamed = differences.matching.doubts, dict[str, str]()
    if differences.other_elements:
        renamed = renamed_names(inputs, generation, differences)
    now = known_names(generation.package) if doubts or renamed else ()
    elements = elements_by_identifier(inputs.domain, generation.now.snapshot, inputs.robot.target) if doubts else {}
    doubtful = {name: MAYBE for name in now if elements.get(identifier_of(name, elements)) in doubts}
    return {**doubtful, **{name: new for name, new in renamed.items() if name in now}}


def tell_uses(uses: Mapping[str, Use]) -> Iterator[Diagnostic]:
    """Yield a warning for the first use of each name in a file."""
    for path, use in uses.items():
        lines = _lines(Path(path), use.names)
        for name, line in sorted(lines.items(), key=lambda item: item[1]):
            new = use.names[name]
            message = f"`{name}` names another part now; the former one is called `{new}`"
            hint = f"use `{new}`, or save the file as it is"
            if new.endswith(GONE):
                message = f"`{name}` names another part now; the former one is gone"
                hint = "change it, or save the file as it is if it is right"
            elif new == MAYBE:
                message, hint = f"`{name}` may name another part now", "look at it, and save the file"
            yield Diagnostic(Severity.WARNING, CODE, message, shown(Path(path)), line, hint=hint)


def _facts(path: Path) -> tuple[int, ...]:
    try:
        return dependencies.read_stat(path)
    except OSError:
        return (0,)


def _lines(path: Path, names: Mapping[str, str]) -> dict[str, int]:
    """Return the first line in which a file uses each name; names that a model only declares do not count."""
    from urdfsync.merge.renames import find_uses_of  # the lexer takes a while to load
    from urdfsync.modelica.files import text_of

    try:
        text = text_of(dependencies.read_file(path))
    except OSError:
        return {}
    if path.suffix == ".mo":
        places = find_uses_of(text, names)
    else:
        places = ((found[0], found.start()) for found in re.finditer(r"[\w-]+", text) if found[0] in names)
    lines = dict[str, int]()
    for name, start in places:
        lines.setdefault(name, text.count("\n", 0, start) + 1)
    return lines


def _texts(value: Any) -> Iterator[str]:
    """Yield all texts and keys in plain data."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, Mapping):
        yield from (*value, *itertools.chain.from_iterable(map(_texts, value.values())))
    elif isinstance(value, list | tuple):
        yield from itertools.chain.from_iterable(map(_texts, value))

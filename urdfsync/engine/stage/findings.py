"""Findings of a build: removed names and connectors, moved or outdated packages, names that mean other parts now.

After an export, a known name may stand for another part. A user's file with this name still works, but with the other
part. So each build warns until the user saves the file. This machine's notes list the files with such names.
"""

from __future__ import annotations

import itertools
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from urdfsync.common.dependencies.facts import PATH
from urdfsync.common.dependencies.reads import Reads, walk_files
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.files import shown
from urdfsync.domain import ChangeClass, Snapshot
from urdfsync.domain.advice import brings_back
from urdfsync.domain.comparison import Changes
from urdfsync.engine.actions import Actions, Reason, find_deletions
from urdfsync.engine.decide.decision import Decision
from urdfsync.engine.decide.differences import GONE
from urdfsync.engine.decide.package_names import (
    class_of,
    elements_by_identifier,
    identifier_of,
    known_names,
    new_name,
    new_names,
)
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.package_files import text_hash
from urdfsync.engine.inspect.users_files import read_saved_facts
from urdfsync.engine.judgements import find_jumps, judge
from urdfsync.modelica.files import text_of
from urdfsync.modelica.markers import find_markers
from urdfsync.modelica.stamp import split
from urdfsync.project.git.unmerged import NO_DRIVER, has_driver
from urdfsync.project.state.notes import Use

if TYPE_CHECKING:
    from urdfsync.engine.decide.fit import Misfit
    from urdfsync.modelica.unresolved import Unresolved

UNMERGED = "unmerged"
"""Code of the warnings about files that git could not merge: with one, no package is in step."""
CONNECTORS = "connector-changed"
"""Code of the notes on changed connectors."""
_FEW = 3
"""The greatest number of files that a message names; it counts further files."""
_LINES = 20
"""The greatest number of lines that a message names for one fault; it counts further lines."""
_NEW = 6
"""The greatest number of new connectors that a message names; it counts further connectors."""
_MAYBE = "?"
"""Stands for the new name of a part if the old name may still mean this part."""


def find_findings(
    inputs: Inputs, generation: Generation, decision: Decision, uses: Mapping[str, Use], reads: Reads
) -> list[Diagnostic]:
    """Return the findings of a build; `uses` are those of `find_uses`, `reads` lists all that the build has read."""
    differences, last, file = decision.differences, inputs.last.version, shown(inputs.robot.source)
    changes, findings = differences.changes, [*inputs.parents.diagnostics]
    version = last if changes and changes.changes else None
    findings += judge(inputs.domain, generation.now, generation.reading, file, version, changes)
    if decision.misfits:
        findings += _diagnose(inputs, generation.now.snapshot, decision, differences.former)
    place = shown(inputs.config.file)
    if inputs.users_files.is_too_wide:
        message = "your models were not checked: there are too many folders to search"
        hint = "put urdfsync.toml into a folder of the project, and narrower folders into `users`"
        line = inputs.robot.lines.get("users", 0)
        findings.append(Diagnostic(Severity.WARNING, "too-many-folders", message, place, line, hint=hint))
    findings += _unmerged(inputs, reads)
    findings += () if inputs.has_moved else (*_twin(inputs), *_strays(inputs, decision))
    findings += _unlisted(inputs, decision)
    findings += [*_look_left_behind(inputs, decision.actions), *([inputs.damage] if inputs.damage else [])]
    if inputs.former_name:
        message = f"robot `{inputs.robot.name}` was called `{inputs.former_name}`; its recorded state"
        line, message = inputs.robot.lines[""], f"{message} continues under the new name"
        findings.append(Diagnostic(Severity.NOTE, "renamed-robot", message, place, line))
    if changes and version is not None:
        findings += find_jumps(inputs.domain, generation.now, generation.reading, file, version, changes.renames)
    if decision.is_complete:
        findings += _changed_connectors(inputs, generation, changes)
    return [*generation.diagnostics, *map(inputs.source.locate, findings), *_tell_uses(inputs, uses)]


def _diagnose(
    inputs: Inputs, snapshot: Snapshot, decision: Decision, renamed: Mapping[str, str]
) -> Iterator[Diagnostic]:
    """Yield one finding for all places of a fault in a file: an error if the fault breaks the package."""
    waiting = (one.path for one in decision.actions if one.is_waiting and not one.is_deletion)
    classes = {class_of(path) for path in waiting if path.endswith(".mo")}
    places: dict[tuple[object, ...], list[Misfit]] = {}
    for misfit in decision.misfits:
        if misfit.key or misfit.file in inputs.users_files.mentioning:  # not in a former folder
            finding = misfit.finding
            what = misfit.use.part if misfit.use else (misfit.lacking or finding.message, finding.code, finding.line)
            places.setdefault((misfit.file, what), []).append(misfit)
    for first, *more in places.values():
        finding = first.finding
        lines = [*map(str, sorted({misfit.finding.line for misfit in more} - {finding.line}))]
        also = f"also in line{'s' if len(lines) > 1 else ''} {_first(lines, _LINES)}" if lines else ""
        hint = _hint(inputs, snapshot, renamed, first.use) if first.use else finding.hint
        if first.use and first.use.part in classes and first.use.kind.value == "class":
            hint = "settle the conflicts: the file of this class waits until then"
        yield msgspec.structs.replace(
            finding,
            severity=Severity.ERROR if first.is_broken else Severity.WARNING,
            file=shown(first.file),
            hint="; ".join(filter(None, (hint, also))),
        )


def _hint(inputs: Inputs, snapshot: Snapshot, renamed: Mapping[str, str], use: Unresolved) -> str:
    """Return a hint for an unresolved name; `renamed` has new identifiers by old identifiers."""
    target, options = inputs.robot.target, inputs.robot.options
    first, *rest = use.name.split(".")
    if first == use.part and renamed.get(first) == inputs.robot.folder.name:  # the package has another name
        return f"use `{'.'.join((target.package, *(renamed.get(part, part) for part in rest)))}` instead"
    if name := new_name(use.part, renamed, use.candidates):
        return f"use `{name}` instead"
    advice = inputs.domain.advice
    for name in dict.fromkeys((use.part, next(new_names(use.part, renamed), use.part))):
        if advice and (option := advice.option_for(name, snapshot, target, options)):
            return brings_back(option, name if name != use.part else "")
    if use.meant:
        return f"did you mean `{use.meant}`?"
    if use.is_library:
        return f'if `{use.part}` is a library, name it in `uses`: annotation (uses({use.part}(version="…")))'
    return "change or remove this use"


def _unmerged(inputs: Inputs, reads: Reads) -> Iterator[Diagnostic]:
    """Yield a warning for each file that git could not merge: of the package, or read by this build.

    A build reads the user's models outside of the package, too, but they change no file. If git could not merge two
    commits of a submodule, all its files are unmerged.
    """
    if not (unmerged := inputs.unmerged_paths):
        return
    found = {str(inputs.files.path(key)) for key in inputs.unmerged}
    for path in (str(inputs.config.file), *(path for kind, path in reads.entries if kind == PATH)):
        real = os.path.realpath(path)
        if not path.endswith(".mo") and not unmerged.isdisjoint((real, *map(str, Path(real).parents))):
            found.add(path)
    for path in sorted(found):
        message, hint = "git has not merged this file", "if its text is right now, `git add` it"
        if find_markers(inputs.users_text(Path(path))):
            hint = "settle its conflict, as `urdfsync status` says, then `git add` it"
        yield Diagnostic(Severity.WARNING, UNMERGED, message, shown(Path(path)), hint=hint)
    if any(path.endswith(".mo") for path in found) and not has_driver(inputs.config.root):
        yield NO_DRIVER


def _look_left_behind(inputs: Inputs, actions: Actions) -> Iterator[Diagnostic]:
    """Return a warning if files stay in the package's former folder."""
    files, old, new = inputs.files, inputs.files.path(inputs.last.folder), inputs.files.path(inputs.folder)
    if not inputs.has_moved or any(action.is_waiting for action in actions):
        return
    gone = set(map(files.path, find_deletions(actions)))
    # a stranger may have written the record: never look into a folder elsewhere, or propose to delete it
    is_inside = files.is_inside(f"{inputs.last.folder}/package.mo")
    below = sorted(map(Path, walk_files(old))) if is_inside else [old]
    rest = [shown(path) for path in below if path not in gone and new not in path.parents]
    if not rest:
        return
    message = f"the package moved from {shown(old)} to {shown(new)}"
    if not is_inside:
        message, hint = f"{message}, but urdfsync may not delete files in the old folder", "delete it by hand"
    else:
        message += f"; these files stay there, since they are yours or your files need them: {_first(rest, _FEW)}"
        hint = "move the files that you need, then delete the old folder"
    file, line = shown(inputs.config.file), inputs.robot.lines[""]
    yield Diagnostic(Severity.WARNING, "left-behind", message, file, line, hint=hint)


def _twin(inputs: Inputs) -> Iterator[Diagnostic]:
    """Yield a warning if the project has another class of the package's name, such as files in the former folder."""
    name = inputs.robot.target.package.partition(".")[0]
    other = inputs.users_files.tops.get(name)
    if other and other != inputs.robot.output / name:
        message, hint = f"there is another class `{name}`", "move the files that you need, then delete it"
        yield Diagnostic(Severity.WARNING, "left-behind", message, shown(other), hint=hint)


def _strays(inputs: Inputs, decision: Decision) -> Iterator[Diagnostic]:
    """Yield a warning for each edited file outside of the package whose stamp says that it belongs to the package."""
    paths = decision.differences.paths
    for path, content in inputs.users_files.mentioning.items():
        if b"__urdfsync" in content:
            text, stamp = split(text_of(content))
            if stamp and stamp.id in paths and text_hash(text) != stamp.base:
                message = f"it has edits of `{shown(inputs.files.path(inputs.folder.key(paths[stamp.id])))}`"
                hint = "merge them into that file by hand, or delete its stamp if the class is your own"
                yield Diagnostic(Severity.WARNING, "left-behind", message, shown(path), hint=hint)


def _unlisted(inputs: Inputs, decision: Decision) -> Iterator[Diagnostic]:
    """Yield a warning for each class of the user's in the package that the `package.order` beside it does not name."""
    for action in decision.actions:
        if action.reason is Reason.UNKNOWN:
            from urdfsync.modelica.layout import check_order  # the parser takes a while to load

            folder, _, name = action.path.removesuffix("/package.mo").removesuffix(".mo").rpartition("/")
            order = f"{folder}/package.order"
            if text := decision.texts.get(order, inputs.files.text(order)):
                lacks = (finding for finding in check_order(text, {name}, None) if finding.code == "order-lacks")
                file = shown(inputs.files.path(order))
                yield from (msgspec.structs.replace(finding, file=file) for finding in lacks)


def _first(names: Sequence[str], most: int) -> str:
    """Return the names as one text: the first `most` names, then the number of further names."""
    more = [f"{len(names) - most} more"] if len(names) > most else []
    return ", ".join([*names[:most], *more])


def _changed_connectors(inputs: Inputs, generation: Generation, changes: Changes | None) -> Iterator[Diagnostic]:
    """Yield notes on renamed and removed connectors, and one note on new connectors."""
    complete, robot = inputs.last.version, inputs.robot
    effects = inputs.domain.effects
    if (
        effects is None
        or complete is None
        or changes is None
        or changes.change_class.rank < ChangeClass.STRUCTURAL.rank
    ):
        return
    connectors = effects.interface(complete, generation.now, changes.renames, robot.target, robot.options)
    file = shown(robot.source)
    if new := [f"`{connector_change.new}`" for connector_change in connectors if connector_change.old is None]:
        message = f"new connectors and variables: {_first(new, _NEW)}"
        yield Diagnostic(Severity.NOTE, CONNECTORS, message, file)
    for connector_change in connectors:
        element, connector = connector_change.path
        if connector_change.old is not None:
            now = f"is now `{connector_change.new}`" if connector_change.new else "is gone"
            message = f"{element}: its {connector} `{connector_change.old}` {now}"
            place = generation.reading.place(element, file)
            yield Diagnostic(Severity.NOTE, CONNECTORS, message, *place, hint=connector_change.hint)


def find_uses(inputs: Inputs, generation: Generation, decision: Decision) -> dict[str, Use]:
    """Return the names in each file that mean another part now, names from earlier builds included.

    Reads the texts and stat values of the user's files that this may concern.
    """
    differences, uses = decision.differences, inputs.read_unsaved_uses()
    if not decision.is_complete:
        return uses
    own = [inputs.files.path(action.path) for action in decision.actions if action.reason is Reason.UNKNOWN]
    has_models = bool(own or inputs.users_files.mentioning)
    if has_models and (names := _other_names(inputs, generation, decision)):
        for path in (*inputs.users_files.using, *own):
            earlier = uses[str(path)].names if str(path) in uses else {}
            used = {name: names.get(new, new) for name, new in earlier.items()}
            used = {name: names[name] for name in _lines(inputs, path, names) if name not in earlier} | used
            uses.pop(str(path), None)
            if used := {name: new for name, new in used.items() if name != new}:
                uses[str(path)] = Use(read_saved_facts(path), used)
    elements = {**{name: _MAYBE for _, name in differences.matching.doubts}, **differences.other_elements}
    options = msgspec.to_builtins(inputs.robot.options).values()  # its keys are names of options
    if used := {name: elements[name] for value in options for name in _texts(value) if name in elements}:
        uses[str(inputs.config.file)] = Use(read_saved_facts(inputs.config.file), used)
    return uses


def _other_names(inputs: Inputs, generation: Generation, decision: Decision) -> dict[str, str]:
    """Return names of the package that mean, or may mean, other parts than in the last build.

    The value of a name is the new name of the part that had this name before.
    """
    doubts = decision.differences.matching.doubts
    renamed = decision.names if decision.differences.other_elements else {}
    now = known_names(generation.package) if doubts or renamed else ()
    elements = elements_by_identifier(inputs.domain, generation.now.snapshot, inputs.robot.target) if doubts else {}
    doubtful = {name: _MAYBE for name in now if elements.get(identifier_of(name, elements)) in doubts}
    return {**doubtful, **{name: new for name, new in renamed.items() if name in now}}


def _tell_uses(inputs: Inputs, uses: Mapping[str, Use]) -> Iterator[Diagnostic]:
    """Yield a warning for the first use of each name in a file."""
    for path, use in uses.items():
        lines = _lines(inputs, Path(path), use.names)
        for name, line in sorted(lines.items(), key=lambda item: item[1]):
            new = use.names[name]
            message = f"`{name}` names another part now; the former part is called `{new}`"
            hint = f"use `{new}`, or save the file as it is"
            if new.endswith(GONE):
                message = f"`{name}` names another part now; the former part is gone"
                hint = "change the name; if it is right, save the file as it is"
            elif new == _MAYBE:
                message, hint = f"`{name}` may name another part now", "check this name, then save the file"
            yield Diagnostic(Severity.WARNING, "other-part", message, shown(Path(path)), line, hint=hint)


def _lines(inputs: Inputs, path: Path, names: Mapping[str, str]) -> dict[str, int]:
    """Return the first line in which a file uses each name; declarations do not count."""
    from urdfsync.merge.renames import find_uses_of  # the lexer takes a while to load

    text = inputs.users_text(path)
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

"""Versions of files in conflict below `.urdfsync/conflicts/`: base, generated, and a proposed merge.

A proposed merge that a person has changed is never overwritten, and `resolve --edit` begins with it.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from pathlib import PurePosixPath

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.actions import sides_hash
from urdfsync.engine.conflicts import Conflict
from urdfsync.engine.inputs import Inputs
from urdfsync.engine.package_files import encode, text_hash
from urdfsync.files import digest, shown
from urdfsync.state.transaction import FileChange


class Versions(msgspec.Struct, frozen=True):
    """The versions of all conflicts of a robot."""

    conflicts: tuple[Conflict, ...]
    """The conflicts, with the files of their versions."""
    changes: tuple[FileChange, ...]
    noted: Mapping[str, tuple[str, str]]
    """Hash of each proposal as urdfsync wrote it, and of its two sides, by path."""
    diagnostics: tuple[Diagnostic, ...]


def save_versions(inputs: Inputs, conflicts: Sequence[Conflict]) -> Versions:
    """Return the writes that save the versions, and their files."""
    store, robot, noted = inputs.store, inputs.robot.name, inputs.last.notes.proposals
    existing = store.conflict_files(robot)
    persons = store.persons_proposals(robot, noted)
    contents, saved, findings = dict[str, bytes](), list[Conflict](), list[Diagnostic]()
    notes = {path: facts for path, facts in noted.items() if path in persons}
    for conflict in conflicts:
        path, merge = PurePosixPath(inputs.folder.path(conflict.path)), conflict.merge
        stem, suffix = path.with_suffix("").as_posix(), path.suffix
        files = dict[str, str]()
        for kind, text in (("base", conflict.base), ("generated", conflict.generated)):
            if text is not None:
                files[kind] = f"{stem}.{kind}{suffix}"
                contents[files[kind]] = encode(text)
        if merge is not None:  # a text with markers is no Modelica
            ending, proposal = ".txt" if merge.text is None else suffix, encode(merge.proposal)
            sides = sides_hash(text_hash(conflict.mine), text_hash(conflict.generated))
            numbers = itertools.chain(("",), map("-{}".format, itertools.count(2)))
            for number in numbers:
                name = f"{stem}.merge{number}{ending}"
                if name not in persons or noted.get(name, ("", ""))[1] == sides or existing[name] == proposal:
                    break
                message = "you changed this proposal, so it stays: a new one is beside it"
                place = shown(store.conflicts(robot) / name)
                findings.append(Diagnostic(Severity.NOTE, "proposal-kept", message, place))
            files["merge"] = name
            if name not in persons:
                contents[name], notes[name] = proposal, (digest(proposal), sides)
        saved.append(msgspec.structs.replace(conflict, files=files, edited=_edited(files, persons, existing)))
    changes = store.save_conflicts(robot, contents, persons)
    return Versions(tuple(saved), tuple(changes), notes, tuple(findings))


def _edited(files: Mapping[str, str], persons: set[str], existing: Mapping[str, bytes]) -> str | None:
    """Return the proposal that a person has changed; None if nobody has."""
    name = files.get("merge", "")
    return existing[name].decode(errors="replace") if name in persons else None

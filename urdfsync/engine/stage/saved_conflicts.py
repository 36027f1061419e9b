"""Saves the versions of each file in conflict: base, generated, and a proposed merge, below `.urdfsync/conflicts`.

If a person changed a proposal, builds never overwrite it, and `resolve --edit` begins with it.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from pathlib import PurePosixPath

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.actions import sides_hash
from urdfsync.engine.decide.conflicts import Conflict
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.package_files import encode, text_hash
from urdfsync.engine.result import SavedVersions
from urdfsync.files import digest, shown
from urdfsync.state.transaction import FileChange


class SavedConflicts(msgspec.Struct, frozen=True):
    """The saved versions of all conflicts of a robot."""

    versions: Mapping[str, SavedVersions]
    """By path."""
    changes: tuple[FileChange, ...]
    noted: Mapping[str, tuple[str, str]]
    """Two hashes for each proposal, by path: of its text as urdfsync wrote it, and of its two sides."""
    written: Mapping[str, str]
    """Hash of each other version, by path."""
    diagnostics: tuple[Diagnostic, ...]


def save_conflicts(inputs: Inputs, conflicts: Sequence[Conflict]) -> SavedConflicts:
    """Return the writes that save the versions of conflicts, and the paths of the versions."""
    store, robot, noted = inputs.store, inputs.robot.name, inputs.last.notes.proposals
    existing, of_persons = store.conflict_files(robot), store.persons_files(robot, inputs.last.notes)
    # an empty proposal does not count
    persons = {path for path, text in of_persons.items() if ".merge" in path and text.strip()}
    contents, saved, findings = dict[str, bytes](), dict[str, SavedVersions](), list[Diagnostic]()
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
                message = "you changed this proposed merge, so it stays: a new proposal is beside it"
                place = shown(store.conflicts(robot) / name)
                findings.append(Diagnostic(Severity.NOTE, "proposal-kept", message, place))
            files["merge"] = name
            if name not in persons:
                contents[name], notes[name] = proposal, (digest(proposal), sides)
        name = files.get("merge", "")
        edited = existing[name].decode(errors="replace") if name in persons else None
        saved[conflict.path] = SavedVersions(files, edited)
    changes = store.save_conflicts(robot, contents, persons)
    for name, content in of_persons.items():
        if name not in persons and content.strip() and contents.get(name) != content:  # it is replaced or deleted now
            below = PurePosixPath("conflicts", name)
            aside = below.with_name(f"{below.stem}.{digest(content)[:8]}{below.suffix}").as_posix()
            changes += store.save(store.aside_file(robot, aside), content)
            message, saved_as = "you wrote this file", shown(store.conflicts(robot) / name)
            hint = f"a copy is {shown(store.aside_file(robot, aside))}"
            findings.append(Diagnostic(Severity.NOTE, "put-aside", message, saved_as, hint=hint))
    written = {name: digest(text) for name, text in contents.items() if name not in notes}
    return SavedConflicts(saved, tuple(changes), notes, written, tuple(findings))

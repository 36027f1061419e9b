"""The writes of one robot's build: files, conflict files, model, and the manifest as the last one; and its bases."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync import profiling
from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import Role, Snapshot
from urdfsync.engine.actions import CONFLICTS, DELETES
from urdfsync.engine.conflicts import conflict_files
from urdfsync.engine.decide import Decision
from urdfsync.engine.generation import Generation
from urdfsync.engine.inputs import Inputs
from urdfsync.engine.package_files import encode
from urdfsync.state import manifest, modelfile
from urdfsync.state.manifest import Manifest
from urdfsync.state.record import RecordState
from urdfsync.state.store import State
from urdfsync.state.transaction import Change

_OLDER_BASE = (RecordState.CONFLICT, RecordState.WAITING, RecordState.ORPHAN)
"""States of files whose base is older than the recorded model, which can't give it back."""


@profiling.stage("recording")
def stage(inputs: Inputs, generation: Generation, decision: Decision) -> tuple[list[Change], list[Path]]:
    """Return the writes, the manifest last, and the folders that are empty then, innermost first."""
    store, name, former = inputs.store, inputs.robot.name, inputs.former_name
    changes = list(_file_changes(inputs, generation, decision))
    changes += store.conflicts(name, dict(_conflict_files(inputs, decision)), former)
    if (drawing := draw(inputs, generation)) is not None:
        changes += store.drawing(name, drawing)[1]
    if _must_stay(inputs, decision):
        # The package can't move yet: its record stays, with the choices that the user made meanwhile.
        changes += store.changes(name, manifest.dumps(_with_choices(inputs, decision)), None, None)
    else:
        changes += store.changes(name, *_recorded_texts(inputs, generation, decision), former)
    return changes, _emptied_folders(inputs, changes)


def draw(inputs: Inputs, generation: Generation) -> str | None:
    """Return the main model's diagram; None if nobody asked for it or the domain draws none."""
    if not inputs.options.draw:
        return None
    robot = inputs.robot
    return inputs.domain.drawing(generation.snapshot, generation.imported.imports, robot.target, robot.options)


def _file_changes(inputs: Inputs, generation: Generation, decision: Decision) -> Iterator[Change]:
    files = inputs.files
    shared = {files.key(file.path) for file in decision.shared}
    for action in decision.actions:
        if action.writes and action.path not in shared:
            key, content = action.path, None
            if action.kind not in DELETES:
                content = _content(inputs, generation, decision, key, action.role)
            yield Change(files.path(key), content, files.old_hash(key))


def _content(inputs: Inputs, generation: Generation, decision: Decision, key: str, role: Role) -> bytes:
    if key in decision.texts:
        return encode(decision.texts[key])
    if role is Role.IMPORT:
        content = generation.imported.contents.get(inputs.path(key))
        if content is None:  # its copy was to serve, and has changed since
            message, file = "it changed while urdfsync looked at it", shown(inputs.files.path(key))
            raise OutputError(Diagnostic(Severity.ERROR, "restless", message, file, hint="build again"))
        return content
    generated = generation.content(key)
    mine = (inputs.files.read(key) or b"") if inputs.files.has_carriage_returns(key) else b""
    return generated.replace(b"\n", b"\r\n") if 2 * mine.count(b"\r\n") > mine.count(b"\n") else generated


def _conflict_files(inputs: Inputs, decision: Decision) -> Iterator[tuple[str, bytes]]:
    """Yield path below the robot's folder of conflicts, and content."""
    for conflict in decision.conflicts:
        generated, base, merge = conflict_files(conflict, inputs.folder)
        yield generated, encode(conflict.generated)
        if base is not None and conflict.base is not None:
            yield base, encode(conflict.base)
        if merge is not None and conflict.merge is not None:
            yield merge, encode(conflict.merge.proposal)


def _emptied_folders(inputs: Inputs, changes: Sequence[Change]) -> list[Path]:
    above = inputs.files.path(inputs.old_folder).parent
    conflicts = inputs.store.folder / "conflicts"
    folders = {
        folder
        for change in changes
        if change.content is None
        for folder in change.path.parents
        if above in folder.parents or conflicts in (folder, *folder.parents)
    }
    return sorted(folders, key=lambda folder: len(folder.parts), reverse=True)


def _recorded_texts(inputs: Inputs, generation: Generation, decision: Decision) -> tuple[str, str]:
    """Return the texts of manifest and model."""
    since = _incomplete_since(inputs, decision)
    before = inputs.complete_revision if since else None
    revision = msgspec.UNSET if before in (None, inputs.domain.revision) else before
    older = _older_bases(inputs, generation, decision)
    model = modelfile.of(generation.snapshot, generation.imported.imports, older, since, revision)
    model_text = modelfile.dumps(model)
    whole = msgspec.structs.replace(
        inputs.heading(manifest.text_hash(model_text)),
        names=inputs.domain.names(generation.snapshot, inputs.robot.target),
        dependencies=generation.imported.records,
        orders=decision.orders,
        files=decision.files,
    )
    text = manifest.dumps(whole)
    if inputs.options.cache:
        # What is loaded from these texts; saves the daemon half of a build of 1,000 links.
        inputs.options.cache.put("state", (text, model_text), State(whole.recorded, model, intact=True))
    return text, model_text


def _with_choices(inputs: Inputs, decision: Decision) -> Manifest:
    recorded = inputs.recorded or inputs.heading("")
    waiting = {record.origin: record for record in decision.files.values() if record.origin and record.choice}
    files = {
        key: msgspec.structs.replace(record, choice=waiting[key].choice, chosen_for=waiting[key].chosen_for)
        for key, record in recorded.files.items()
        if key in waiting
    }
    return msgspec.structs.replace(recorded, files={**recorded.files, **files})


def _incomplete_since(inputs: Inputs, decision: Decision) -> Snapshot | None:
    """Return the model that what waits is compared with; None if nothing waits."""
    complete = inputs.last_complete
    waits = any(action.held or action.kind in CONFLICTS for action in decision.actions)
    return complete.snapshot if waits and complete else None


def _older_bases(inputs: Inputs, generation: Generation, decision: Decision) -> Mapping[str, str]:
    """Return the bases that can't be rendered from the recorded model, by path below the package."""
    texts = {}
    for key, record in decision.files.items():
        is_older = record.state in _OLDER_BASE and record.role is not Role.IMPORT and key.startswith(inputs.key(""))
        if is_older and record.base is not None:
            text = _base(inputs, generation, record.origin or key, record.base)
            if text is not None:
                texts[inputs.path(key)] = text
    return texts


def stage_bases(
    inputs: Inputs, generation: Generation, decision: Decision
) -> tuple[dict[str, str], frozenset[str] | None]:
    """Return the bases that are not kept yet, as far as they are not lost, and the hashes of all.

    None for the latter if the record of the package's old folder stays, with its bases.
    """
    if _must_stay(inputs, decision):
        return {}, None
    kept, new, mentioned = inputs.store.bases(inputs.robot.name), dict[str, str](), set[str]()
    for key, record in decision.files.items():
        if record.role is Role.IMPORT or record.base is None:
            continue
        mentioned.add(record.base)
        if record.base in kept or record.base in new:
            continue
        text = inputs.bases.get(record.base) or _base(inputs, generation, record.origin or key, record.base)
        if text is not None:
            new[record.base] = text
    return new, frozenset(mentioned)


def _must_stay(inputs: Inputs, decision: Decision) -> bool:
    """Whether the package can't move to its new folder yet."""
    moves = inputs.recorded is not None and inputs.recorded.folder != inputs.folder
    return moves and any(action.held for action in decision.actions)


def _base(inputs: Inputs, generation: Generation, key: str, sha256: str) -> str | None:
    path = inputs.path(key)
    if path in generation.package.artifacts and generation.hash(path) == sha256:
        return generation.content(key).decode()
    return generation.base(key, sha256)

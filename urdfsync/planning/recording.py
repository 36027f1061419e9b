"""What is written when a plan is carried out: files, conflicts put aside, model and manifest, in that order."""

from __future__ import annotations

import functools
from collections.abc import Callable, Collection, Iterator, Mapping
from pathlib import Path

import msgspec

from urdfsync import profiling
from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import Role, Snapshot
from urdfsync.plan import CONFLICTS, DELETES, FileRecord
from urdfsync.plan import State as FileState
from urdfsync.planning.decide import Decision
from urdfsync.planning.disk import encode
from urdfsync.planning.imports import Imported
from urdfsync.planning.outputs import Outputs
from urdfsync.planning.situation import Situation
from urdfsync.standoff import aside
from urdfsync.state import manifest, modelfile
from urdfsync.state.manifest import Manifest
from urdfsync.state.transaction import Change

_OUTLIVING = (FileState.CONFLICT, FileState.WAITING, FileState.ORPHAN)
"""States of files whose base is older than the recorded model, which can't give it back."""


class Recording:
    """The writes of one robot's build; `outputs` and `imported` have the contents."""

    def __init__(
        self,
        situation: Situation,
        outputs: Outputs,
        imported: Imported,
        snapshot: Snapshot,
        last: Callable[[str, str], str | None],
    ) -> None:
        """`last` gives what was written last to a file of the plan or of the last build, by its hash."""
        self._situation, self._outputs, self._imported = situation, outputs, imported
        self._snapshot, self._last = snapshot, last

    @profiling.staged("recording")
    def writes(self, decision: Decision) -> tuple[tuple[Change, ...], tuple[Path, ...]]:
        """The files to write, the manifest last, and the folders that are empty then, innermost first."""
        situation, store = self._situation, self._situation.store
        name, former = situation.robot.name, situation.former
        changes = list(self._files(decision))
        changes += store.conflicts(name, dict(self._aside(decision)), former)
        if self._drawing is not None:
            changes += store.drawing(name, self._drawing)[1]
        if self._stays(decision):
            changes += store.changes(name, manifest.dumps(self._chosen(decision)), None, None)
        else:
            changes += store.changes(name, *self._state(decision), former)
        return tuple(changes), tuple(self._emptied(changes))

    def drawing(self) -> Path | None:
        """Where the main model's diagram is then; None if nobody asked for it or there is none."""
        if self._drawing is None:
            return None
        return self._situation.store.drawing(self._situation.robot.name, self._drawing)[0]

    @functools.cached_property
    def _drawing(self) -> str | None:
        situation, robot = self._situation, self._situation.robot
        if not situation.request.draw:
            return None
        return situation.domain.drawing(self._snapshot, self._imported.imports, robot.target, robot.options)

    def _stays(self, decision: Decision) -> bool:
        """Whether the record of the package's old folder is still needed: the package can't move yet."""
        recorded = self._situation.recorded
        moves = recorded is not None and recorded.folder != self._situation.folder
        return moves and any(action.held for action in decision.actions.decided)

    def _files(self, decision: Decision) -> Iterator[Change]:
        """The changes of the package itself."""
        disk = self._situation.disk
        shared = {disk.key(file.path) for file in decision.shared}
        for action in decision.actions.decided:
            if action.writes and action.path not in shared:
                content = None if action.kind in DELETES else self._content(decision, action.path, action.role)
                yield Change(disk.path(action.path), content, disk.seen(action.path))

    def _content(self, decision: Decision, key: str, role: Role) -> bytes:
        if key in decision.texts:
            return encode(decision.texts[key])
        path = key.removeprefix(self._situation.key(""))
        if role is Role.IMPORT:
            return self._import(key, path)
        mine = (self._situation.disk.read(key) or b"") if self._situation.disk.has_returns(key) else b""
        if 2 * mine.count(b"\r\n") > mine.count(b"\n"):
            return self._outputs.content(path).replace(b"\n", b"\r\n")
        return self._outputs.content(path)

    def _import(self, key: str, path: str) -> bytes:
        """The bytes of an imported file. Raises OutputError if its copy was to serve, and has changed since."""
        content = self._imported.contents.get(path)
        if content is None:
            message, file = "it changed while urdfsync looked at it", shown(self._situation.disk.path(key))
            raise OutputError(Diagnostic(Severity.ERROR, "restless", message, file, hint="build again"))
        return content

    def _aside(self, decision: Decision) -> Iterator[tuple[str, bytes]]:
        """What is put aside of conflicts: path below the robot's folder, and content."""
        for standoff in decision.standoffs:
            generated, base, merge = aside(standoff, self._situation.folder)
            yield generated, encode(standoff.generated)
            if base is not None and standoff.base is not None:
                yield base, encode(standoff.base)
            if merge is not None and standoff.merge is not None:
                yield merge, encode(standoff.merge.proposal)

    def _emptied(self, changes: list[Change]) -> list[Path]:
        situation = self._situation
        above = situation.disk.path(situation.old_key("package.mo")).parent.parent
        folders = {
            folder
            for change in changes
            if change.content is None
            for folder in change.path.parents
            if above in folder.parents or situation.store.folder / "conflicts" in (folder, *folder.parents)
        }
        return sorted(folders, key=lambda folder: len(folder.parts), reverse=True)

    def _state(self, decision: Decision) -> tuple[str, str]:
        """The texts of manifest and model."""
        outliving, since = self._outliving(decision), self._since(decision)
        before = self._situation.written_by if since else None
        revision = msgspec.UNSET if before in (None, self._situation.domain.revision) else before
        model = modelfile.of(self._snapshot, self._imported.imports, outliving, since, revision)
        text = modelfile.dumps(model)
        return manifest.dumps(self._manifest(decision, text)), text

    def _manifest(self, decision: Decision, model: str) -> Manifest:
        situation, robot = self._situation, self._situation.robot
        return msgspec.structs.replace(
            situation.heading(manifest.text_hash(model)),
            names=situation.domain.names(self._snapshot, robot.target),
            dependencies=self._imported.records,
            orders=decision.orders,
            files=decision.files,
        )

    def _chosen(self, decision: Decision) -> Manifest:
        """What was recorded, where the package stood, with the choices that the user made meanwhile."""
        recorded = self._situation.recorded or self._situation.heading("")
        waiting = {record.origin: record for record in decision.files.values() if record.origin and record.choice}
        files = {
            key: msgspec.structs.replace(record, choice=waiting[key].choice, chosen_for=waiting[key].chosen_for)
            for key, record in recorded.files.items()
            if key in waiting
        }
        return msgspec.structs.replace(recorded, files={**recorded.files, **files})

    def _since(self, decision: Decision) -> Snapshot | None:
        """The model with which what waits is compared; None if nothing waits."""
        settled = self._situation.settled
        waits = any(action.held or action.kind in CONFLICTS for action in decision.actions.decided)
        return settled.snapshot if waits and settled else None

    def _outliving(self, decision: Decision) -> Mapping[str, str]:
        """The bases that can't be rendered from the recorded model, by path below the package's folder."""
        texts = {}
        prefix = self._situation.key("")
        for key, record in decision.others.items():
            if record.state in _OUTLIVING and record.role is not Role.IMPORT and key.startswith(prefix):
                text = self._base(record.origin or key, record.base)
                if text is not None:
                    texts[key.removeprefix(prefix)] = text
        return texts

    def bases(self, decision: Decision) -> tuple[Mapping[str, str], Collection[str] | None]:
        """The bases that are not kept yet, by their hashes; and all hashes that the manifest mentions.

        None for the latter if the record of the package's old folder stays, with its bases.
        """
        if self._stays(decision):
            return {}, None
        kept, keys = self._situation.store.bases(self._situation.robot.name), _keys(decision.files)
        return dict(self._known({digest: key for digest, key in keys.items() if digest not in kept})), keys.keys()

    def _known(self, keys: Mapping[str, str]) -> Iterator[tuple[str, str]]:
        """Hash and text of bases that are not lost; one after the other, so that not all are in memory."""
        for digest, key in keys.items():
            text = self._base(key, digest)
            if text is not None:
                yield digest, text

    def _base(self, key: str, digest: str | None) -> str | None:
        if digest is None:
            return None
        path = key.removeprefix(self._situation.key(""))
        if self._outputs.generates(path, digest):
            return self._outputs.content(path).decode()
        return self._last(key, digest)


def _keys(records: Mapping[str, FileRecord]) -> dict[str, str]:
    """Where each base is, by its hash."""
    keys: dict[str, str] = {}
    for key, record in records.items():
        if record.role is not Role.IMPORT and record.base is not None:
            keys.setdefault(record.base, record.origin or key)
    return keys

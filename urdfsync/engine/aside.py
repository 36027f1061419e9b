"""Texts that builds and choices replace: each is a plain file below `.urdfsync/aside/`, and can be given back.

Put aside is what a person wrote, and what this machine did not generate: that it is recorded is no proof. The list of
what can be given back forgets a text once its file is saved again and another build writes. The text itself stays.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import PurePosixPath

import msgspec

from urdfsync.domain import Role
from urdfsync.engine.actions import Reason
from urdfsync.engine.decide import Decision
from urdfsync.engine.generation import Generation
from urdfsync.engine.package_files import PackageFiles, encode, state_of
from urdfsync.engine.settle import Settled, known_bases
from urdfsync.files import digest
from urdfsync.state.record import FileRecord
from urdfsync.state.store import Aside


def put_aside(
    generation: Generation, decision: Decision, contents: Mapping[str, bytes | None], settled: Settled
) -> tuple[dict[str, Aside], dict[str, bytes]]:
    """Return all that can be given back after a build, by path below the package, and the new texts by file.

    `contents` are those that the build writes, by key; None for a deletion.
    """
    inputs, index, texts = generation.inputs, dict[str, Aside](), dict[str, bytes]()
    on_disk = PackageFiles(inputs.config, inputs.robot) if settled.contents else inputs.files
    moved = {action.origin: action.path for action in decision.actions if action.origin and action.writes}
    for path, aside in inputs.last.aside.items():
        key = inputs.folder.key(path)
        if key in settled.contents:
            continue  # another choice follows, or this one is taken back
        if key in moved and on_disk.hash(key, Role.MODEL) == aside.after:
            after = contents.get(moved[key])
            aside = msgspec.structs.replace(aside, after=state_of(after or b"").text_sha256)
            index[inputs.folder.path(moved[key])] = aside
        elif not contents or on_disk.hash(key, Role.MODEL) == aside.after:
            index[path] = aside

    def add(key: str, text: bytes, record: FileRecord, bases: Mapping[str, str]) -> None:
        path, after = PurePosixPath(inputs.folder.path(key)), contents.get(key, settled.contents.get(key))
        file = path.with_name(f"{path.stem}.{digest(text)[:8]}{path.suffix}").as_posix()
        sha256 = None if after is None else state_of(after).text_sha256
        index[str(path)], texts[file] = Aside(file, sha256, record.hashes, dict(bases)), text

    for key, before in settled.before.items():
        if key not in moved:
            add(key, *before)
        elif key in settled.before_move:
            add(moved[key], *settled.before_move[key])
    for action in decision.actions:
        key, conflict = action.path, decision.disputed.get(action.path)
        if not action.writes or key not in contents or action.role is Role.ORDER or key in settled.before:
            continue
        if action.reason is Reason.MOVE:
            is_other = conflict is not None and encode(conflict.kept) != contents[key]
            if conflict is not None and is_other and action.origin not in settled.before:
                add(key, encode(conflict.kept), *known_bases(conflict.kept_base))
        elif action.reason is not Reason.MOVED_AWAY and (former := on_disk.read(key)) not in (None, contents[key]):
            former_hash = state_of(former or b"").text_sha256
            if former_hash in inputs.last.notes.written:
                continue
            record = inputs.last.files.get(key, FileRecord())
            bases: Mapping[str, str] = inputs.last.bases(record)
            # else the next build would merge it again, or take it for the text that it wrote
            is_merge = (action.reason is Reason.MERGE or action.is_left_by_git) and inputs.always_merges
            is_own_base = former_hash in record.hashes
            if action.generated and action.role is not Role.IMPORT and (is_merge or is_own_base):
                record, bases = known_bases(generation.package.content(inputs.folder.path(key)).decode())
            elif is_own_base:
                record, bases = FileRecord(), {}
            add(key, former or b"", record, bases)
    return index, texts

"""Deciding over differences: what stays as it is recorded needs no decision, and makes none other."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path

import msgspec
from hypothesis import given
from hypothesis import strategies as st

from urdfsync import config
from urdfsync.domain import Role
from urdfsync.files import digest, text_digest
from urdfsync.plan import FileRecord, Kind, State, Wanted
from urdfsync.planning.decide import Aim, Decision, decide
from urdfsync.planning.disk import Disk
from urdfsync.planning.parents import Parents
from urdfsync.state.manifest import Generator, Manifest, Source

FOLDER = "modelica/Arm"
TEXTS = ("a\n", "b\n", "a\r\n")
HASHES = [text_digest(text.encode()) for text in TEXTS[:2]]
PATHS = [
    f"{FOLDER}/{name}" for name in ("Arm.mo", "Links/One.mo", "Links/Two.mo", "Links/package.mo", "Resources/x.stl")
]


def disk(root: Path) -> Disk:
    (root / "urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    loaded = config.load(root / "urdfsync.toml")
    return Disk(loaded, loaded.robots[0])


def manifest(files: Mapping[str, FileRecord]) -> Manifest:
    source, generator = Source("arm.urdf", "", ""), Generator("urdf", 1, "")
    return Manifest(package="Arm", class_="Arm", folder=FOLDER, source=source, generator=generator, files=files)


def role(path: str) -> Role:
    return Role.IMPORT if path.endswith(".stl") else Role.RECORD


def write(root: Path, files: Mapping[str, str]) -> None:
    for path, text in files.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_bytes(text.encode())


def decided(root: Path, recorded: Manifest, wanted: Mapping[str, Wanted], stay: Mapping[str, FileRecord]) -> Decision:
    rest = {path: target for path, target in wanted.items() if path not in stay}
    return decide(disk(root), recorded, Aim(rest, {}, Parents({}, {}), FOLDER, stay), None)


@st.composite
def records(draw: st.DrawFn) -> dict[str, FileRecord]:
    states = st.sampled_from([State.GENERATED, State.GENERATED, State.EDITED, State.ORPHAN, State.CONFLICT])
    made = st.builds(FileRecord, st.just("link a"), st.just(Role.RECORD), st.sampled_from(HASHES), states)
    found = draw(st.dictionaries(st.sampled_from(PATHS), made))
    return {path: msgspec.structs.replace(record, role=role(path)) for path, record in found.items()}


def staying(recorded: Manifest, wanted: Mapping[str, Wanted]) -> dict[str, FileRecord]:
    return {path: record for path, record in recorded.plain.items() if wanted.get(path) == Wanted.again(record)}


@given(
    records(),
    st.dictionaries(st.sampled_from(PATHS), st.sampled_from(HASHES)),
    st.dictionaries(st.sampled_from(PATHS), st.sampled_from(TEXTS)),
)
def test_what_stays_makes_no_difference(
    files: Mapping[str, FileRecord], hashes: Mapping[str, str], found: Mapping[str, str]
) -> None:
    recorded = manifest(files)
    wanted = {path: Wanted(role(path), "link a", hash_) for path, hash_ in hashes.items()}
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        write(root, found)
        whole = decided(root, recorded, wanted, {})
        fast = decided(root, recorded, wanted, staying(recorded, wanted))
    assert fast == whole
    assert tuple(fast.actions) == tuple(whole.actions)
    assert len(fast.actions) == len(tuple(fast.actions))


def test_nothing_is_decided_on_what_stays(tmp_path: Path) -> None:
    files = {path: FileRecord("link a", role(path), digest(b"a\n")) for path in PATHS}
    write(tmp_path, dict.fromkeys(PATHS, "a\n"))
    write(tmp_path, {PATHS[1]: "edited\n", PATHS[2]: "a\r\n"})
    found = decided(tmp_path, manifest(files), {}, files)
    assert [(action.path, action.kind) for action in found.actions.decided] == [(PATHS[1], Kind.KEEP)]
    assert found.actions.unchanged.keys() == {*PATHS} - {PATHS[1]}
    assert found.files == {**files, PATHS[1]: msgspec.structs.replace(files[PATHS[1]], state=State.EDITED)}
    assert found.others.keys() == {PATHS[1]}

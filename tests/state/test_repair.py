"""Repair: what both sides of a merge know is kept, and no file counts as untouched that nobody recorded."""

from __future__ import annotations

import random
import shutil
import subprocess
from pathlib import Path

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.diagnostics import StateError
from urdfsync.domain import Import, Role
from urdfsync.engine.actions import Kind
from urdfsync.engine.rules import decide_file
from urdfsync.files import text_digest
from urdfsync.state import modelfile
from urdfsync.state.manifest import DependencyRecord, Generator, Manifest, Source, dumps
from urdfsync.state.modelfile import ConversionFacts
from urdfsync.state.record import FileRecord
from urdfsync.state.repair import RecoveredState, rebuilt, recover, sides

GRIPPER = "Arm/Links/Gripper.mo"
BASE = "Arm/Links/Base.mo"
MESH = "Arm/Resources/base.stl"
NAMES = "ABCDEFGHIJ"

Hashes = dict[str, str | None]


def manifest(hashes: Hashes, snapshot: str = "5a", mesh: str = "m1") -> Manifest:
    roles = {MESH: Role.IMPORT}
    files = {
        path: FileRecord(Path(path).stem, roles.get(path, Role.MODEL), base) for path, base in sorted(hashes.items())
    }
    return Manifest(
        package="Arm",
        class_="Arm",
        folder="Arm",
        source=Source("arm.urdf", "1f", snapshot),
        generator=Generator("urdf", 3, "9c"),
        dependencies={"base.stl": DependencyRecord("base.stl", "Resources/base.stl", f"s-{mesh}", mesh, 1)},
        orders={"Arm/Links/package.order": tuple(Path(path).stem for path in hashes if "/Links/" in path)},
        files=files,
    )


def model(name: str, mesh: str = "m1", bases: dict[str, str] | None = None) -> str:
    imported = Import("Resources/base.stl", f"s-{mesh}", mesh, 1, {"volume": mesh})
    return modelfile.dumps(modelfile.of({"name": name}, {"base.stl": imported}, bases))


OURS = manifest({BASE: "b1", GRIPPER: "g-ours", MESH: "m1"})
THEIRS = manifest({BASE: "b1", GRIPPER: "g-theirs", "Arm/Links/Finger.mo": "f1", MESH: "m2"}, "5b", "m2")


def conflict(ours: str, theirs: str, ancestor: str = "") -> str:
    """Two whole texts between markers."""
    middle = f"||||||| ancestor\n{ancestor}" if ancestor else ""
    return f"<<<<<<< HEAD\n{ours}{middle}=======\n{theirs}>>>>>>> feature\n"


def merged_texts(ours: str, theirs: str, json: str | None = None) -> RecoveredState:
    return recover(conflict(ours, theirs), json, "arm.toml", "arm.json")


def merged(ours: Manifest = OURS, theirs: Manifest = THEIRS, json: str | None = None) -> RecoveredState:
    return merged_texts(dumps(ours), dumps(theirs), json)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        pytest.param(conflict("a\n", "b\n", "c\n").replace("\n", "\r\n"), ["a\r\n", "b\r\n"], id="CRLF"),
        pytest.param("1\n<<<<<<< HEAD\na\n=======\nb\n", ["1\na\n", "1\nb\n"], id="no end"),
        pytest.param("1\n<<<<<<< HEAD\na\n", ["1\na\n", "1\n"], id="no middle"),
        pytest.param("a = '<<<<<<< H'\n <<<<<<<\n<<<<<<<x\n", ["a = '<<<<<<< H'\n <<<<<<<\n<<<<<<<x\n"], id="text"),
        pytest.param("\u2028<<<<<<< HEAD\n", ["\u2028<<<<<<< HEAD\n"], id="what only looks like a line"),
    ],
)
def test_sides_of_odd_texts(text: str, expected: list[str]) -> None:
    assert list(sides(text)) == expected


part = st.lists(st.sampled_from(["a\n", "b\r\n", "= 1\n", "\n"]), max_size=3).map("".join)


@given(regions=st.lists(st.tuples(part, part, part, part), max_size=4), style=st.booleans())
def test_every_side_is_put_together_from_all_conflicts(regions: list[tuple[str, ...]], style: bool) -> None:
    text = "".join(
        common + conflict(ours, theirs, ancestor if style else "") for common, ours, theirs, ancestor in regions
    )
    ours, theirs = ("".join(region[0] + region[side] for region in regions) for side in (1, 2))
    assert list(sides(text)) == list(dict.fromkeys([ours, theirs]))


@given(st.lists(st.sampled_from(["<<<<<<< a\n", "||||||| b\n", "=======\n", ">>>>>>> c\n", "x\n", "y"]), max_size=40))
def test_no_marker_survives(parts: list[str]) -> None:
    found = sides("".join(parts))
    assert 1 <= len(found) <= 2
    for side in found:
        assert not any(line.startswith(("<<<<<<<", "|||||||", "=======", ">>>>>>>")) for line in side.split("\n"))


def varied(rng: random.Random, side: str, ancestor: Hashes) -> Hashes:
    """The files of a branch: some are new, some gone, some written again."""
    files = {path: rng.choice([base, f"{base}-{side}"]) for path, base in ancestor.items() if rng.random() < 0.8}
    return files | {f"Arm/Links/{name}.mo": f"{name}-{side}" for name in rng.sample(NAMES, rng.randint(0, 3))}


def on_disk(common: Hashes, ours: Hashes, theirs: Hashes, taken: Hashes) -> Hashes:
    """The files after a merge: what one branch changed is done, and where both did, a person takes one of them."""
    result: Hashes = {}
    for path in ours.keys() | theirs.keys():
        before, left, right = (side.get(path) for side in (common, ours, theirs))
        found = left if right in (before, left) else right if left == before else taken.get(path)
        if found is not None:
            result[path] = found
    return result


@pytest.mark.skipif(shutil.which("git") is None, reason="no git")
@pytest.mark.parametrize("style", ["merge", "diff3", "zdiff3"])
def test_whatever_git_makes_of_two_states_a_file_of_either_is_untouched(tmp_path: Path, style: str) -> None:
    rng = random.Random(style)
    command = ["git", "merge-file", "-p", *([f"--{style}"] if style != "merge" else []), "ours", "common", "theirs"]
    for _ in range(40):
        common: Hashes = {f"Arm/Links/{name}.mo": name for name in rng.sample(NAMES, 6)}
        ours, theirs = varied(rng, "ours", common), varied(rng, "theirs", common)
        for name, files in (("common", common), ("ours", ours), ("theirs", theirs)):
            (tmp_path / name).write_text(dumps(manifest(files, snapshot=name)))
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert ">>>>>>> theirs" in done.stdout
        found = recover(done.stdout, None, "arm.toml", "arm.json")
        for taken in (ours, theirs):
            disk = on_disk(common, ours, theirs, taken)
            state = rebuilt(found, disk, dict.fromkeys(disk, "new"))
            assert state is not None
            assert {path: record.base for path, record in state.files.items() if path in disk} == disk


@pytest.mark.parametrize(
    "broken",
    [
        pytest.param(dumps(OURS).replace('folder = "Arm"', "folder = 1"), id="no manifest"),
        pytest.param(dumps(OURS).replace("Links/Gripper.mo", "../../evil.mo"), id="a path outside of the package"),
        pytest.param(dumps(OURS)[:-20] + "\n", id="cut off"),
        pytest.param(dumps(OURS).replace("format = 1", "format = 0"), id="a format that never was"),
    ],
)
def test_a_side_that_can_not_be_used_is_left_out(broken: str) -> None:
    assert merged_texts(broken, dumps(THEIRS)).manifests == (THEIRS,)
    assert merged_texts(broken, broken).manifests == ()


@pytest.mark.parametrize(
    ("toml", "json", "file"),
    [
        (conflict(dumps(OURS), dumps(THEIRS).replace("format = 1", "format = 99")), None, r"arm.toml:\d+"),
        ("# all of it\nformat = 99\nnot for us\n", None, "arm.toml:2"),
        (dumps(OURS), '{\n "format": 99,\n "snapshot": []\n}\n', "arm.json:2"),
        (dumps(OURS), '{"format":99,"snapshot":{},"imports":{}}', "arm.json"),
    ],
    ids=["manifest", "a manifest that can't be read", "a model of another structure", "a model on one line"],
)
def test_a_newer_side_is_refused(toml: str, json: str | None, file: str) -> None:
    with pytest.raises(StateError, match=rf"^{file}: error: a newer urdfsync wrote .* \(format 99"):
        recover(toml, json, "arm.toml", "arm.json")


def chosen(candidates: list[str], mine: str | None, generated: str | None) -> str | None:
    """The base of a file with these recorded hashes on so many sides."""
    hashes: list[str | None] = [*candidates] or [None]
    sides = tuple(manifest({GRIPPER: base}) for base in hashes)
    state = rebuilt(RecoveredState(sides, {}, frozenset(candidates)), {GRIPPER: mine}, {GRIPPER: generated or ""})
    assert state is not None
    return state.files[GRIPPER].base


hashes = st.sampled_from("abcd")


@given(st.lists(hashes, unique=True), st.none() | hashes, st.none() | hashes)
def test_a_choice_never_costs_an_edit(candidates: list[str], mine: str | None, generated: str | None) -> None:
    base = chosen(candidates, mine, generated)
    assert (base in candidates) if candidates else base is None
    kind = decide_file(base, mine, generated)
    if mine not in candidates:
        assert kind not in (Kind.UPDATE, Kind.DELETE)
        if set(candidates) - {generated}:
            assert kind is not Kind.KEEP, "what is new is not left out in silence"
    if not candidates and mine not in (None, generated) and generated is not None:
        assert kind is Kind.UNOWNED


@pytest.mark.parametrize(("mesh", "volume"), [("m1", "m1"), ("m2", "m2"), ("edited", "m1"), (None, "m1")])
def test_facts_are_those_of_the_copy_that_is_there(mesh: str | None, volume: str) -> None:
    recovered = merged(json=conflict(model("ours"), model("theirs", "m2")))
    found = rebuilt(recovered, {MESH: mesh}, {})
    assert found is not None
    expected = {"base.stl": ConversionFacts(f"s-{volume}", 1, {"volume": volume})}
    united = recovered.model(found)
    assert united is not None
    assert united.imports == expected


def test_the_snapshot_is_that_of_the_manifest() -> None:
    ours, theirs = model("ours"), model("theirs", bases={"Links/Gripper.mo": "model Gripper\n"})
    newer = msgspec.structs.replace(
        THEIRS, generator=Generator("urdf", 4, "9d"), source=Source("a", "b", text_digest(theirs.encode()))
    )
    recovered = merged(theirs=newer, json=conflict(ours, theirs))
    written = text_digest(b"model Gripper\n")
    state = msgspec.structs.replace(newer, files={GRIPPER: FileRecord("gripper", Role.MODEL, written)})
    for recorded, name, bases in ((state, "theirs", {"Links/Gripper.mo": "model Gripper\n"}), (OURS, "ours", {})):
        united = recovered.model(recorded)
        assert united is not None
        assert (united.snapshot, united.bases) == ({"name": name}, bases)
    assert merged(json="<<<<<<< HEAD\n").model(OURS) is None

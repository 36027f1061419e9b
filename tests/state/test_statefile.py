"""The recorded state as text: what is written comes back, and what is no fact is passed over."""

from __future__ import annotations

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from urdfsync.diagnostics import StateError
from urdfsync.domain import Import
from urdfsync.state.record import Generator, Open, Record
from urdfsync.state.statefile import dumps, loads

A, B = "a" * 64, "b" * 64
ARM = Record(
    package="Plant.Arm",
    class_="Arm",
    folder="modelica/Plant/Arm",
    generator=Generator("urdf", "0.0.3", "0123"),
    options={"base": "fixed", "frames": ["tip"]},
    snapshot={"links": {"tip": {"mass": 1.5}}, "joints": {}, "name": "arm"},
    imports={"tip.stl": (Import("Resources/tip.stl", A, B, {"hull": [[0.0, 1.0]]}),)},
    files={"modelica/Plant/Arm/Arm.mo": A},
)
SEEN = {"tip.stl": (Import("Resources/tip.stl", B, A, {}),)}
OPEN = Open({"links": {"tip": {"mass": 2.0}}}, {("link", "end"): "tip"}, imports=SEEN)
TEXT = dumps(ARM)

names = st.text(st.characters(exclude_categories=["Cs"]), max_size=8)
values = st.recursive(st.none() | st.booleans() | st.floats(allow_nan=False, allow_infinity=False) | names, st.lists)
snapshots = st.dictionaries(names, values | st.dictionaries(names, values, max_size=3), min_size=1, max_size=3)


@settings(max_examples=30)
@given(snapshots, snapshots, st.dictionaries(names, values.filter(lambda value: value is not None)))
def test_a_record_comes_back(snapshot: dict[str, object], seen: dict[str, object], options: dict[str, object]) -> None:
    record = msgspec.structs.replace(ARM, snapshot=snapshot, options=options, open=Open(seen, {}))
    assert loads(dumps(record), "arm.state") == (record, None)


def test_blanks_in_paths_come_back() -> None:
    folder = "my models/Plant/Arm"
    record = msgspec.structs.replace(ARM, folder=folder, files={f"{folder}/Own part.mo": A})
    assert loads(dumps(record), "arm.state") == (record, None)


@pytest.mark.parametrize("record", [ARM, msgspec.structs.replace(ARM, open=OPEN)], ids=["complete", "open"])
def test_each_line_stands_alone(record: Record) -> None:
    lines = dumps(record).split("\n")
    assert not any(lines[1::2]), "between neighbours is a blank line"
    shuffled = "\n".join([*reversed(lines), *lines, "# a remark"])
    assert loads(shuffled, "arm.state") == (record, None)


def read(text: str) -> Record:
    record, damage = loads(text, "arm.state")
    assert record is not None
    assert damage is None
    return record


def united(*more: str) -> Record:
    return read("\n\n".join([TEXT, *more]))


@pytest.mark.parametrize(
    "line",
    ['class "Leg"', 'release "0.0.4"', 'option ["base","floating"]', 'model ["links","tip",{"mass":3.0}]'],
)
def test_what_git_united_is_not_known_for_sure(line: str) -> None:
    record = united(line)
    assert record.is_united
    assert read(dumps(record)).is_united, "until a build is complete"


def test_a_sum_beside_another_one_is_none() -> None:
    """Of two branches each has its own, and a third one may fit."""
    sums = [line for line in TEXT.split("\n") if line.startswith("sum ")]
    assert len(sums) == 1
    for text in (f'{TEXT}\nsum "{B}"', f'sum "{B}"\n{TEXT}', TEXT.replace(sums[0], "")):
        assert read(text).is_united


def test_the_newest_release_counts_wherever_it_stands() -> None:
    for release in ("0.0.2", "0.0.10"):
        assert united(f'release "{release}"').generator.release == ("0.0.10" if release == "0.0.10" else "0.0.3")
    assert read(f'release "0.0.10"\n{TEXT}').generator.release == "0.0.10"


def test_what_a_newer_urdfsync_wrote_is_refused() -> None:
    with pytest.raises(StateError, match=r"urdfsync 99\.0 wrote this state, and this is") as caught:
        united('release "99.0"')
    assert caught.value.diagnostics[0].line == TEXT.count("\n") + 3


@pytest.mark.parametrize(
    ("line", "lost"),
    [
        ('renamed ["link","end","hand"]', {"seen": {}, "renamed": {}}),
        ('seen ["links","tip",{"mass":3.0}]', {"seen": {}, "renamed": {}}),
    ],
)
def test_of_what_is_open_none_counts_that_two_branches_say_otherwise(line: str, lost: dict[str, object]) -> None:
    text = dumps(msgspec.structs.replace(ARM, open=OPEN))
    assert read(f"{text}\n{line}").open == msgspec.structs.replace(OPEN, **lost)


def test_a_model_that_git_united_is_at_hand_unless_an_element_stands_twice() -> None:
    found = united('model ["links","hand",{"mass":3.0}]').snapshot
    assert found is not None
    assert found["links"] == {"tip": {"mass": 1.5}, "hand": {"mass": 3.0}}
    assert united('model ["links","tip",{"mass":3.0}]').snapshot is None


def test_a_file_has_every_hash_that_a_branch_recorded() -> None:
    record = united(f"file {B}  Arm.mo")
    assert record.files["modelica/Plant/Arm/Arm.mo"] == B
    assert record.is_united


def test_where_the_files_of_two_folders_are_is_not_known() -> None:
    assert united('folder "packages/Plant/Arm"').files == {}


BROKEN = {
    "<<<<<<< ours": "unresolved merge markers",
    "files 3": "no fact of urdfsync",
    "release true": "no fact of urdfsync: expected `str`, got `bool`",
    'model ["links"]': "no fact of urdfsync",
    f"file {A[:9]}  Arm.mo": "no fact of urdfsync: no hash and path",
    f"file {A}  ../Arm.mo": "the path '../Arm.mo' does not belong to the package `Plant.Arm`",
    f"file {A}  .git/config.mo": "does not belong to the package",
    f"file {A}  C:/Arm.mo": "the path 'C:/Arm.mo' does not belong to the package",
    f"file {A}  Arm\x7f.mo": "does not belong to the package",
    f"file {A}  package.order": "does not belong to the package",
    'import ["x",{"target":"../x","source_hash":"","target_hash":"","facts":{}}]': "'../x' does not",
}


@pytest.mark.parametrize("line", BROKEN)
def test_a_line_that_can_not_be_read_is_passed_over_and_told(line: str) -> None:
    record, damage = loads(f"{TEXT}\n\n{line}", "arm.state")
    assert record == msgspec.structs.replace(ARM, is_united=True)
    assert damage is not None
    assert BROKEN[line] in damage.message
    assert (damage.code, damage.line) == ("broken-state", TEXT.count("\n") + 3)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (TEXT.replace("\nfolder ", "\n# "), "it has no folder"),
        ("", "it is empty"),
        (TEXT.replace("modelica/Plant/Arm", "modelica/Plant/Leg"), "is not a folder of the package `Plant.Arm`"),
    ],
)
def test_a_state_without_its_heading_is_none(text: str, words: str) -> None:
    record, damage = loads(text, "arm.state")
    assert record is None
    assert damage is not None
    assert words in damage.message

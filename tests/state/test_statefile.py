"""The recorded state as text: what is written comes back, what git unites is told, and what is no state is refused."""

from __future__ import annotations

import re

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from urdfsync.diagnostics import StateError
from urdfsync.domain import Import
from urdfsync.engine.actions import Choice, UsersChoice
from urdfsync.state.record import FileRecord, Generator, Open, Record
from urdfsync.state.statefile import dumps, loads

A, B = "a" * 64, "b" * 64
ARM = Record(
    package="Plant.Arm",
    class_="Arm",
    folder="modelica/Plant/Arm",
    generator=Generator("urdf", 3, "0123"),
    options={"base": "fixed", "frames": ["tip"]},
    snapshot={"links": {"tip": {"mass": 1.5}}, "joints": {}, "name": "arm"},
    imports={"tip.stl": (Import("Resources/tip.stl", A, B, {"hull": [[0.0, 1.0]]}),)},
    files={"modelica/Plant/Arm/Arm.mo": FileRecord((A,))},
)
OPEN = Open({"Arm.mo": UsersChoice(Choice.MERGE, B)}, {"links": {"tip": {"mass": 2.0}}}, {("link", "end"): "tip"})
TEXT = dumps(ARM)

names = st.text(st.characters(exclude_categories=["Cs"]), max_size=8)
values = st.recursive(st.none() | st.booleans() | st.floats(allow_nan=False, allow_infinity=False) | names, st.lists)
snapshots = st.dictionaries(names, values | st.dictionaries(names, values, max_size=3), min_size=1, max_size=3)


@settings(max_examples=30)
@given(snapshots, snapshots, st.dictionaries(names, values.filter(lambda value: value is not None)))
def test_a_record_comes_back(snapshot: dict[str, object], seen: dict[str, object], options: dict[str, object]) -> None:
    record = msgspec.structs.replace(ARM, snapshot=snapshot, options=options, open=Open({}, seen, {}))
    assert loads(dumps(record), "arm.state") == record


def test_blanks_in_paths_come_back() -> None:
    folder = "my models/Plant/Arm"
    record = msgspec.structs.replace(ARM, folder=folder, files={f"{folder}/Own part.mo": FileRecord((A,))})
    assert loads(dumps(record), "arm.state") == record


@pytest.mark.parametrize("record", [ARM, msgspec.structs.replace(ARM, open=OPEN)], ids=["complete", "open"])
def test_each_line_stands_alone(record: Record) -> None:
    lines = dumps(record).split("\n")
    assert not any(lines[1::2]), "between neighbours is a blank line"
    shuffled = "\n".join([*reversed(lines), *lines, "# a remark"])
    assert loads(shuffled, "arm.state") == record


def united(*more: str) -> Record:
    return loads("\n\n".join([TEXT, *more]), "arm.state")


@pytest.mark.parametrize(
    "line",
    ['class "Leg"', "revision 4", 'option ["base","floating"]', 'model ["links","tip",{"mass":3.0}]'],
)
def test_what_git_united_is_not_known_for_sure(line: str) -> None:
    record = united(line)
    assert record.is_united
    assert loads(dumps(record), "arm.state").is_united, "until a build is complete"


def test_a_sum_beside_another_one_is_none() -> None:
    """Of two branches each has its own, and a third one may fit."""
    sums = [line for line in TEXT.split("\n") if line.startswith("sum ")]
    assert len(sums) == 1
    for text in (f'{TEXT}\nsum "{B}"', f'sum "{B}"\n{TEXT}', TEXT.replace(sums[0], "")):
        assert loads(text, "arm.state").is_united


def test_the_greatest_revision_counts_wherever_it_stands() -> None:
    for line in ("revision 2", "revision 4"):
        assert united(line).generator.revision == max(3, int(line[-1]))
    assert loads(f"revision 4\n{TEXT}", "arm.state").generator.revision == 4


@pytest.mark.parametrize(
    ("line", "lost"),
    [
        (f'choice ["Arm.mo",{{"choice":"take","sides":"{B}"}}]', {"choices": {}}),
        ('renamed ["link","end","hand"]', {"seen": {}, "renamed": {}}),
        ('seen ["links","tip",{"mass":3.0}]', {"seen": {}, "renamed": {}}),
    ],
)
def test_of_what_is_open_none_counts_that_two_branches_say_otherwise(line: str, lost: dict[str, object]) -> None:
    text = dumps(msgspec.structs.replace(ARM, open=OPEN))
    assert loads(f"{text}\n{line}", "arm.state").open == msgspec.structs.replace(OPEN, **lost)


def test_a_model_that_git_united_is_at_hand_unless_an_element_stands_twice() -> None:
    found = united('model ["links","hand",{"mass":3.0}]').snapshot
    assert found is not None
    assert found["links"] == {"tip": {"mass": 1.5}, "hand": {"mass": 3.0}}
    assert united('model ["links","tip",{"mass":3.0}]').snapshot is None


def test_a_file_has_every_hash_that_a_branch_recorded() -> None:
    record = united(f"file {B}  Arm.mo")
    assert record.files["modelica/Plant/Arm/Arm.mo"] == FileRecord((A, B))
    assert record.is_united


def test_where_the_files_of_two_folders_are_is_not_known() -> None:
    assert united('folder "packages/Plant/Arm"').files == {}


BROKEN = {
    "<<<<<<< ours": "unresolved merge markers",
    "files 3": "this is not a state file of urdfsync",
    "revision true": "this is not a state file of urdfsync: expected `int`, got `bool`",
    'model ["links"]': "this is not a state file of urdfsync",
    f"file {A[:9]}  Arm.mo": "this is not a state file of urdfsync: no hash and path",
    f"file {A}  ../Arm.mo": "the recorded path '../Arm.mo' does not belong to the package `Plant.Arm`",
    f"file {A}  .git/config.mo": "does not belong to the package",
    f"file {A}  C:/Arm.mo": "the recorded path 'C:/Arm.mo' does not belong to the package",
    f"file {A}  Arm\x7f.mo": "does not belong to the package",
    f"file {A}  package.order": "does not belong to the package",
    'import ["x",{"target":"../x","source_hash":"","target_hash":"","converter":1,"facts":{}}]': "'../x' does not",
    "format 2": "a newer urdfsync wrote this state (format 2; this one knows 1)",
}


@pytest.mark.parametrize("line", BROKEN)
def test_what_is_no_state_is_refused_with_its_line(line: str) -> None:
    with pytest.raises(StateError, match=re.escape(BROKEN[line])) as caught:
        united(line)
    assert caught.value.diagnostics[0].line == TEXT.count("\n") + 3


@pytest.mark.parametrize(
    "line", [line for line in BROKEN if "does not" not in BROKEN[line] and "newer" not in BROKEN[line]]
)
def test_a_full_build_passes_over_what_can_not_be_read(line: str) -> None:
    record = loads(f"{line}\n{TEXT}", "arm.state", strict=False)
    assert record == msgspec.structs.replace(ARM, is_united=True)


def test_a_state_without_its_heading_is_none() -> None:
    with pytest.raises(StateError, match="it has no folder"):
        loads(TEXT.replace("\nfolder ", "\n# "), "arm.state")
    with pytest.raises(StateError, match="the recorded state is empty"):
        loads("", "arm.state")

"""The recorded state as text: records come back, git unites those of branches, and what is no record is passed over."""

from __future__ import annotations

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from urdfsync.common.diagnostics import StateError
from urdfsync.domain import Import
from urdfsync.domain.matching import Doubt
from urdfsync.project.state.record import Generator, Open, Record, unite
from urdfsync.project.state.statefile import dumps, key_of, loads

A, B = "a" * 64, "b" * 64
ARM = Record(
    package="Plant.Arm",
    class_="Arm",
    folder="modelica/Plant/Arm",
    generator=Generator("urdf", "0.0.3", "0123"),
    options={"base": "fixed", "frames": ["tip"]},
    snapshot={"links": {"tip": {"mass": 1.5}}, "joints": {}, "name": "arm"},
    imports={"tip.stl": Import("Resources/tip.stl", A, B, {"hull": [[0.0, 1.0]]})},
    files={"modelica/Plant/Arm/Arm.mo": A},
)
OPEN = Open({"links": {"tip": {"mass": 2.0}}}, {"link tip": "1f"}, asked={A: Doubt("link tip")})
TEXT = dumps(ARM)

names = st.text(st.characters(exclude_categories=["Cs"]), max_size=8)
values = st.recursive(st.none() | st.booleans() | st.floats(allow_nan=False, allow_infinity=False) | names, st.lists)
snapshots = st.dictionaries(names, values | st.dictionaries(names, values, max_size=3), min_size=1, max_size=3)


@settings(max_examples=30)
@given(snapshots, snapshots, st.dictionaries(names, values.filter(lambda value: value is not None)))
def test_a_record_comes_back(snapshot: dict[str, object], seen: dict[str, object], options: dict[str, object]) -> None:
    record = msgspec.structs.replace(ARM, snapshot=snapshot, options=options, open=Open(seen))
    assert loads(dumps(record), "arm.state") == ((record,), None)


@pytest.mark.parametrize("record", [ARM, msgspec.structs.replace(ARM, open=OPEN)], ids=["complete", "open"])
def test_a_record_is_one_line(record: Record) -> None:
    assert dumps(record).count("\n") == 2
    assert loads(f"{dumps(record)}# a remark\n\n", "arm.state") == ((record,), None)


def test_blanks_in_paths_come_back() -> None:
    folder = "my models/Plant/Arm"
    record = msgspec.structs.replace(ARM, folder=folder, files={f"{folder}/Own part.mo": A})
    assert loads(dumps(record), "arm.state") == ((record,), None)


def test_the_records_of_both_branches_count_but_not_the_one_that_they_follow_from() -> None:
    ours, theirs = (
        msgspec.structs.replace(ARM, options={"base": base}, ancestors=(key_of(ARM),)) for base in ("world", "floating")
    )
    assert loads(dumps(ours, theirs), "arm.state") == ((ours, theirs), None)
    assert loads(dumps(ours, ARM, theirs, ours), "arm.state") == ((ours, theirs), None)


def test_strangers_records_that_follow_from_nothing_but_themselves_count() -> None:
    (record,), _ = loads(dumps(msgspec.structs.replace(ARM, ancestors=(A[:16],))), "arm.state")
    assert record.snapshot == ARM.snapshot


def test_of_united_records_names_with_two_meanings_are_left_out() -> None:
    ours = msgspec.structs.replace(ARM, former={"a": "b", "c": "d"}, edits={"1": "x"}, open=Open(files={"own": A}))
    theirs = msgspec.structs.replace(ARM, former={"a": "e"}, edits={"1": "x", "2": "y"}, files={"other": B})
    united = unite([ours, theirs])
    assert (united.former, united.edits) == ({"c": "d"}, {"1": "x", "2": "y"})
    assert united.files == {**ARM.files, "own": A, "other": B}
    assert united.snapshot == ARM.snapshot


def test_what_a_newer_urdfsync_wrote_is_refused() -> None:
    newer = dumps(msgspec.structs.replace(ARM, generator=Generator("urdf", "99.0", "")))
    for text in (newer, newer.replace('"package":', '"place":')):
        with pytest.raises(StateError, match=r"urdfsync 99\.0 wrote this state, and this is") as caught:
            loads(text, "arm.state")
        assert caught.value.diagnostics[0].line == 2


BROKEN = {
    "<<<<<<< ours": "unresolved merge markers",
    "{": "no record of urdfsync",
    TEXT[TEXT.index("{") : -9]: "no record of urdfsync",
    TEXT.splitlines()[1].replace('"package":"Plant.Arm"', '"package":3'): "no record of urdfsync: expected `str`",
    TEXT.splitlines()[1].replace("modelica/Plant/Arm", "modelica/Plant/Leg"): "is not a folder of the package",
    TEXT.splitlines()[1].replace(f'"{A}"}},"folder', '"a"},"folder'): "'a' is no hash",
    **{
        TEXT.splitlines()[1].replace('"Arm.mo"', f'"{path}"'): "does not belong to the package `Plant.Arm`"
        for path in ("../Arm.mo", ".git/config.mo", "C:/Arm.mo", "Arm\\u007f.mo", "package.order")
    },
    TEXT.splitlines()[1].replace("Resources/tip.stl", "Resources/../../x"): "does not belong to the package",
}


@pytest.mark.parametrize("line", BROKEN)
def test_a_line_that_can_not_be_read_is_passed_over_and_told(line: str) -> None:
    assert f"{line}\n" not in TEXT
    records, damage = loads(f"{TEXT}\n{line}", "arm.state")
    assert records == (ARM,)
    assert damage is not None
    assert BROKEN[line] in damage.message
    assert (damage.code, damage.line) == ("broken-state", 4)


def test_an_empty_state_is_told() -> None:
    records, damage = loads("", "arm.state")
    assert records == ()
    assert damage is not None
    assert "it is empty" in damage.message

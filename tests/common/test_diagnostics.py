"""A finding is a line of reasonable length, whatever the names in it are."""

from __future__ import annotations

import pickle

import pytest
from support import urdfs
from support.urdfs import joint, link

from urdfsync.common.diagnostics import Diagnostic, Severity, SourceError, cut
from urdfsync.formats.urdf.parse.source import read_robot

LONG = "a" * 100_000
FAULTS = {
    "several-roots": (link("b"), link(LONG)),
    "unknown-child": (link("b"), joint("j", "fixed", "b", LONG)),
    "duplicate-link": (link(LONG), link(LONG)),
    "cycle": (link(LONG), joint("j", "fixed", LONG, LONG)),
    "unknown-mimic": (link("b"), link("c"), joint("j", "continuous", "b", "c", inside=[urdfs.mimic(LONG)])),
    "unknown-joint-type": (link("b"), link("c"), joint("j", LONG, "b", "c")),
    "unknown-material": (f'<link name="b"><visual><geometry><sphere radius="1"/></geometry><material name="{LONG}"/>'
        "</visual></link>",),
    "not-modelled": (link("b"), f"<gazebo><plugin name='{LONG}'/></gazebo>"),
}  # fmt: skip


@pytest.mark.parametrize(("code", "elements"), FAULTS.items(), ids=FAULTS)
def test_long_names_are_cut(code: str, elements: tuple[str, ...]) -> None:
    reading = read_robot(urdfs.robot(*elements).encode(), "own.urdf")
    found = [*reading.diagnostics, *reading.unmodelled]
    assert code in {one.code for one in found}
    assert all(len(str(one)) < 2200 for one in found)
    assert all(len(str(detail)) < 1100 for one in found for detail in one.details)


def test_the_middle_is_left_out() -> None:
    assert cut("0123456789", 10) == "0123456789"
    assert cut("0123456789a", 10) == "0123456…9a"
    said = Diagnostic(Severity.ERROR, "code", f"link {LONG} is bad", hint="rename it")
    assert said.message.startswith("link aaa")
    assert said.message.endswith("aaa is bad")


def test_an_error_of_a_worker_is_the_same_here() -> None:
    error = SourceError(Diagnostic(Severity.ERROR, "xml-syntax", "this is no XML", "arm.urdf"))
    copy = pickle.loads(pickle.dumps(error))
    assert (copy.diagnostics, str(copy)) == (error.diagnostics, str(error))
    assert str(copy) == "arm.urdf: error: this is no XML [xml-syntax]"

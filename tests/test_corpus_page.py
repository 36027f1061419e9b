"""The table of the corpus: elements of real robots beside links and joints, and their effect; none is ignored silently.

`python tests/test_corpus_page.py` writes it.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import get_args

import pytest
from lxml import etree
from support import corpus as corpora
from support.corpus import ABSENT, FOLDER, REPOSITORY
from support.packages import read

from urdfsync.common.diagnostics import Diagnostic
from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.options import LeftOut, Options

PAGE = REPOSITORY / "tests" / "golden" / "corpus.md"
HEADER = """| robot | has beside links and joints | Run drives | sensors | contacts | not modelled | left out |
| --- | --- | --- | --- | --- | --- | --- |
"""
KNOWN = ("link", "joint", "material")


def table() -> str:
    """The rows of all robots that have elements beside links and joints, with numbers only."""
    return HEADER + "".join(row for file in corpora.robots() for row in rows(file))


def rows(file: str) -> Iterator[str]:
    reading = read((FOLDER / file).read_bytes(), file)
    if reading.snapshot is None:
        yield f"| {corpora.label(file)} | refused: it is half a robot, to be mounted on another | | | | | |\n"
        return
    robot = reading.snapshot
    root = etree.parse(FOLDER / file).getroot()
    tags = Counter(element.tag for element in root.iterchildren("*") if element.tag not in KNOWN)
    has = ", ".join(f"{count} {re.sub('{.*}', '', str(tag))}" for tag, count in tags.items())
    note = next((one.message for one in reading.diagnostics if one.code == "not-modelled"), "")
    counts = note.removeprefix("not modelled: ")
    allowed = ", ".join(f"{count_of(one)} {one.code}" for one in reading.diagnostics if one.code in get_args(LeftOut))
    inputs = Counter(drive.command or "free" for drive in Assembly(robot, Options()).connectors.drives.values())
    drives = ", ".join(f"{count} {command}" for command, count in inputs.items())
    contacts = sum(link.contact is not None for link in robot.links)
    if has or counts:
        numbers = " | ".join(str(number or "") for number in (drives, len(robot.sensors), contacts))
        counts = counts.replace("<", "`<").replace(">", ">`")
        yield f"| {corpora.label(file)} | {has} | {numbers} | {counts} | {allowed} |\n"


def count_of(found: Diagnostic) -> int:
    """The number of findings with its code that a warning counts."""
    return 1 + sum(not detail.text for detail in found.details)


@pytest.mark.usefixtures("corpus")
def test_the_table_is_what_becomes_of_the_corpus() -> None:
    page = PAGE.read_text(encoding="utf-8")
    assert HEADER + page.partition(HEADER)[2] == table(), "run `python tests/test_corpus_page.py` and review it"


@pytest.mark.usefixtures("corpus")
@pytest.mark.parametrize("file", corpora.robots())
def test_nothing_is_silent(file: str) -> None:
    """Each element beside links and joints is modelled, or a finding names its line."""
    if file == ABSENT:
        return
    reading = read((FOLDER / file).read_bytes(), file)
    if reading.snapshot is None:
        return
    robot = reading.snapshot
    said = {line for one in reading.diagnostics for line in (one.line, *(detail.line for detail in one.details))}
    modelled = {"transmission", "ros2_control", *KNOWN}
    contacts = {link.name for link in robot.links if link.contact}
    names = {sensor.name for sensor in robot.sensors}
    for element in etree.parse(FOLDER / file).getroot().iterchildren("*"):
        lines = {inner.sourceline for inner in element.iter("*")}
        is_sensor = any(inner.get("name") in names for inner in element.iter("sensor"))
        is_contact = element.get("reference") in contacts
        is_drive = any(element.find(path) is not None for path in ("plugin/mimicJoint", "turnGravityOff", "gravity"))
        is_modelled = element.tag in modelled or is_sensor or is_contact or is_drive
        assert is_modelled or lines & said or not len(element), element.sourceline


if __name__ == "__main__":
    text = PAGE.read_text(encoding="utf-8").partition(HEADER)[0]
    Path(PAGE).write_text(text + table(), encoding="utf-8", newline="\n")

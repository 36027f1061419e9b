"""House rules of the Modelica library that no compiler checks, over every file that the library holds.

That its layout is right, tests/analysis/checks/test_texts.py says.
"""

from __future__ import annotations

import functools
import html
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pymoca.ast
import pymoca.parser
import pytest
import rumoca
from lxml import etree
from support.annotations import annotations_in
from support.modelica import URDFSYNC as LIBRARY

FILES = sorted(LIBRARY.rglob("*.mo"))
FOLDERS = [file.parent for file in FILES if file.name == "package.mo"]

pytestmark = pytest.mark.slow  # another parser, of Python alone, reads the whole library


def where(file: Path) -> str:
    """The file as the messages of these tests name it."""
    return file.relative_to(LIBRARY.parent).as_posix()


def full_name(file: Path) -> str:
    """The class that a file of this place must hold."""
    path = file.parent if file.name == "package.mo" else file.with_suffix("")
    return ".".join(path.relative_to(LIBRARY.parent).parts)


@functools.cache
def text(file: Path) -> str:
    """The file's text, line endings as they are."""
    return file.read_bytes().decode("utf-8")


@functools.cache
def parsed(file: Path) -> Any:
    """The file's class, as pymoca reads it."""
    node = pymoca.parser.parse(text(file))
    for part in full_name(file).split("."):
        node = node.classes[part]
    return node


def nested(node: Any) -> Iterator[Any]:
    """A class and all classes inside it."""
    yield node
    for inner in node.classes.values():
        yield from nested(inner)


@functools.cache
def documentation(file: Path) -> str:
    """The documentation text of the file's class, empty if there is none."""
    notes = [note.get("Documentation") for note in annotations_in(text(file))]
    return next((note.get("info", "") for note in notes if note), "")


def test_both_parsers_accept_every_file() -> None:
    assert {where(file): found for file in FILES if (found := rumoca.validate(str(file)))} == {}
    assert [where(file) for file in FILES if parsed(file) is None] == []


def test_files_are_plain_text_with_a_final_newline() -> None:
    faults = {
        where(file): fault
        for file in [*FILES, *LIBRARY.rglob("package.order")]
        for fault, found in {
            "tab": "\t" in text(file),
            "carriage return": "\r" in text(file),
            "byte order mark": text(file).startswith("\ufeff"),
            "space at the end of a line": re.search(r" $", text(file), re.MULTILINE) is not None,
            "no final newline, or several": not re.search(r"[^\n]\n\Z", text(file)),
        }.items()
        if found
    }
    assert faults == {}


def test_every_class_has_a_description() -> None:
    faults = [
        f"{where(file)}: {node.name}"
        for file in FILES
        for node in nested(parsed(file))
        if not node.comment and not is_described(node.name, text(file))
    ]
    assert faults == []


def is_described(name: str, source: str) -> bool:
    """Whether a description follows the constraining clause of an element: pymoca drops that one."""
    return re.search(rf'\b{name}\b[^;"]*\bconstrainedby\b(?:(?!\bannotation\b)[^;"])*"', source) is not None


def test_every_public_declaration_has_a_description() -> None:
    faults = [
        f"{where(file)}: {symbol.name}"
        for file in FILES
        for node in nested(parsed(file))
        for symbol in node.symbols.values()
        if symbol.visibility == pymoca.ast.Visibility.PUBLIC
        and not symbol.comment
        and not is_described(symbol.name, text(file))
    ]
    assert faults == []


def test_every_file_documents_its_class() -> None:
    faults = [where(file) for file in FILES if not re.fullmatch(r"<html>\n.+\n</html>", documentation(file), re.DOTALL)]
    assert faults == []


def markup_fault(markup: str) -> str:
    """What is wrong with an HTML text in which every tag has to be closed."""
    try:
        etree.fromstring(html.unescape(re.sub(r"<(br|hr|img[^>]*)>|&(amp|lt|gt|quot);", "", markup)))
    except etree.XMLSyntaxError as error:
        return str(error)
    return ""


def test_documentation_is_well_formed() -> None:
    assert markup_fault("<p><code>a</p></code>")
    assert {where(file): fault for file in FILES if (fault := markup_fault(documentation(file)))} == {}


def test_classes_that_are_mentioned_exist() -> None:
    """In documentation: names in code are resolved by test_unresolved."""
    existing = {full_name(file) for file in FILES}
    for file in (folder / "package.mo" for folder in FOLDERS):
        constants = {name for name, each in parsed(file).symbols.items() if "constant" in each.prefixes}
        existing |= {f"{full_name(file)}.{name}" for name in constants}
    mentioned = {
        where(file): set(re.findall(r"modelica://(UrdfSync[\w.]*)[\"'#]", documentation(file))) for file in FILES
    }
    assert {file: names - existing for file, names in mentioned.items() if names - existing} == {}


def test_files_that_are_mentioned_exist() -> None:
    mentioned = [(file, uri) for file in FILES for uri in re.findall(r"modelica://UrdfSync/([^\"\\]+)", text(file))]
    assert mentioned
    assert [(where(file), uri) for file, uri in mentioned if not (LIBRARY / uri).is_file()] == []


def test_the_library_asks_for_the_standard_library_in_the_oldest_version_that_serves() -> None:
    uses = next(note.get("uses") for note in annotations_in(text(LIBRARY / "package.mo")) if note.get("uses"))
    assert uses.get("Modelica").get("version") == "4.0.0"


def components(file: Path) -> dict[str, Any]:
    """Components of a class and of those that it extends."""
    node = parsed(file)
    inherited = [str(base.component) for base in node.extends]
    files = [
        LIBRARY.joinpath(*name.split(".")[1:]).with_suffix(".mo") for name in inherited if name.startswith("UrdfSync.")
    ]
    return {name: symbol for base in map(components, files) for name, symbol in base.items()} | dict(node.symbols)


def test_axes_of_joint_records_are_parameters() -> None:
    """The table of axes in a robot's record is a parameter, and its binding must not vary more."""
    records = [LIBRARY / "Records" / f"{kind}Joint.mo" for kind in ("Revolute", "Continuous", "Prismatic", "Planar")]
    assert "parameter" in parsed(LIBRARY / "Records" / "Robot.mo").symbols["jointAxes"].prefixes
    assert [where(file) for file in records if "parameter" not in components(file)["axis"].prefixes] == []


BARE = re.compile(r"^  (?:\w+ )*?Real (\w+)(\[[^\]]*\])?(?!.*unit)[^(]*$", re.MULTILINE)
PLAIN = {
    "axisStarts": {"lower", "upper", "start"},
    "axisValues": {"x", "y"},
    "jointVector": {"ofTurning", "ofSliding", "factor", "x"},
    "sweepTurns": {"start", "lower", "upper", "velocity", "reach", "turn", "room", "above", "below"},
    "AxisSweeps": {"start", "lower", "upper", "velocity", "reach", "turn"},
    "jacobian": {"J"},
}
"""Numbers of any unit, and the Jacobian, whose rows have two."""
RATIOS = {"followerMultipliers"}
"""rad or m per rad or m."""


def record_files() -> Iterator[Path]:
    yield from (LIBRARY / "Dynamics").glob("*.mo")
    yield from (LIBRARY / "Records").glob("*.mo")
    names = ("PartialRecordRobot", "PartialGenericRobot", "GenericRobot", "ArticulatedRobot", "AxisSweeps")
    yield from (LIBRARY / "Robots" / f"{name}.mo" for name in (*names, "MultiBodyGenericRobot"))


def test_no_number_of_the_robots_that_are_read_from_a_record_is_without_a_unit() -> None:
    found = {
        (file.stem, name)
        for file in record_files()
        for name, _ in BARE.findall(file.read_text("utf-8"))
        if name not in RATIOS | PLAIN.get(file.stem, set())
    }
    assert found <= {(kind, "multiplier") for kind in ("RotationalMimic", "TranslationalMimic")}

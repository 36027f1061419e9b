"""Reads a catalogue: a table whose rows have numbers of drives, such as rotors, gears and limits.

The rows that the option `motors` names go to the end of the URDF, as they are written. So all readers of the URDF have
them, with their lines, and each converts the units itself:

    <catalogue_header effort="stall torque [N.cm]" rotor_inertia="rotor [g.cm2]"/>
    <catalogue_row joint="elbow" motor="MX-64" effort="600" rotor_inertia="12.5"/>
    <catalogue_fault option="motors.wrist" message="…" hint="…"/>
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.spelling import nearest
from urdfsync.urdf.options import MotorNumber, Options
from urdfsync.urdf.parse.fields import Reader
from urdfsync.urdf.robot import MOTION_KINDS, Joint, Motor, Transmission

_HEADER, _ROW, _FAULT = "catalogue_header", "catalogue_row", "catalogue_fault"
_NUMBERS: Mapping[MotorNumber, tuple[str, str, str]] = {
    "effort": ("limit", "N.m", "N"),
    "velocity": ("limit", "rad/s", "m/s"),
    "damping": ("dynamics", "N.m.s/rad", "N.s/m"),
    "friction": ("dynamics", "N.m", "N"),
    "armature": ("dynamics", "kg.m2", "kg"),
    "reduction": ("transmission", "1", "rad/m"),
    "rotor_inertia": ("transmission", "kg.m2", "kg.m2"),
}
"""Numbers of a row: the field of `Joint` that has each, and its unit for a turning and for a sliding joint."""
PATHS = {(field, number): number for number, (field, _, _) in _NUMBERS.items()}


class Row(NamedTuple):
    """A row of the catalogue for one joint."""

    motor: Motor
    gear: Mapping[str, float]
    """Fields of `Transmission`; all other numbers are attributes of the joint's elements by now."""
    element: Element


def file(options: Options) -> str:
    """Return the path of the catalogue from the folder of the configuration; empty if no joint needs it."""
    return options.catalogue if options.motors else ""


def join(content: bytes, other: bytes, file: str, options: Options) -> tuple[bytes, Sequence[tuple[int, int]]]:
    """Return the URDF with the rows before its last tag, and the line of each in both files; see `Catalogue`."""
    end = content.rfind(b"</robot")
    if end < 0:
        return content, ()
    elements = list(_elements(other, file, options))
    first = content.count(b"\n", 0, end) + 2
    lines = "".join(f"\n{element}" for element, _ in elements).encode("ascii", "xmlcharrefreplace")
    places = [(number, line) for number, (_, line) in enumerate(elements, first)]
    return content[:end] + lines + b"\n" + content[end:], places


def _elements(content: bytes, file: str, options: Options) -> Iterator[tuple[str, int]]:
    """Yield each element, and its line in the catalogue. Raises SourceError for an unreadable one."""
    from xml.sax.saxutils import quoteattr  # 9 ms, and few robots need it

    from urdfsync.table.formats import read_sheets  # likewise
    from urdfsync.table.reading import name_and_unit

    def write(tag: str, line: int, **attributes: object) -> tuple[str, int]:
        texts = {name: "".join(c if c.isprintable() else " " for c in str(text)) for name, text in attributes.items()}
        return f"<{tag} {' '.join(f'{name}={quoteattr(text)}' for name, text in texts.items())}/>", line

    def fault(option: str, message: str, name: str, names: Sequence[str]) -> tuple[str, int]:
        near = nearest(name, names)
        hint = f"did you mean `{near}`?" if near else f"it has {', '.join(names)}"[:200]
        return write(_FAULT, 1, option=option, message=f"the catalogue {file} has {message}", hint=hint)

    sheet, _ = read_sheets(content, file)
    names = [name_and_unit(cell)[0] for cell in sheet.header]
    wanted = {number: options.motor_columns.get(number, number) for number in _NUMBERS}
    columns = {number: names.index(column) for number, column in wanted.items() if column in names}
    for number, column in options.motor_columns.items():
        if column not in names:
            yield fault(f"motor_columns.{number}", f"no column `{column}`", column, names)
    if not columns:
        yield fault("catalogue", f"none of the columns {', '.join(_NUMBERS)}", "", names)
    yield write(_HEADER, 1, **{number: sheet.header[column] for number, column in columns.items()})
    rows = defaultdict[str, list[tuple[int, Sequence[object]]]](list)
    for line, cells in sheet.rows:
        rows[str(cells[0]).strip()].append((line, cells))
    for joint, name in options.motors.items():
        if len(rows.get(name, ())) != 1:
            words = f"no row `{name}`" if name not in rows else f"{len(rows[name])} rows `{name}`"
            yield fault(f"motors.{joint}", words, name, list(rows))
            continue
        (line, cells), *_ = rows[name]
        filled = {
            number: cells[column]
            for number, column in columns.items()
            if column < len(cells) and cells[column] is not None
        }
        yield write(_ROW, line, joint=joint, motor=name, **filled)


def find_faults(root: Element, options: Options) -> Iterator[tuple[str, Diagnostic]]:
    """Yield the faults of the options `catalogue`, `motors` and `motor_columns`; see `Reading.option_findings`."""
    if file(options) and root.find(_HEADER) is None:
        message, hint = "the catalogue can't be added to the source", "save the source as UTF-8"
        yield "catalogue", Diagnostic(Severity.ERROR, "catalogue", message, hint=hint)
    elif options.motors and not options.catalogue:
        message, hint = "`motors` names rows, but there is no catalogue", "name its file in `catalogue`"
        yield "motors", Diagnostic(Severity.ERROR, "catalogue", message, hint=hint)
    for fault in root.findall(_FAULT):
        option, message, hint = (fault.get(name, "") for name in ("option", "message", "hint"))
        yield option, Diagnostic(Severity.ERROR, "catalogue", message, hint=hint)


def read_rows(reader: Reader, root: Element) -> Mapping[str, Row]:
    """Put the numbers of the catalogue's rows into the elements of their joints; return the rows by joint.

    The elements of the catalogue leave the document. Joints that are not there, or have no axis, are left out: the
    check of options reports them.
    """
    header, rows = root.find(_HEADER), root.findall(_ROW)
    joints = {joint.get("name"): joint for joint in root.findall("joint") if joint.get("type") in MOTION_KINDS}
    for element in [part for part in root if part.tag in (_HEADER, _ROW, _FAULT)]:
        root.remove(element)
    if header is None or not rows:
        return {}
    from urdfsync.table.model import Options as TableOptions  # 15 ms, and few robots need it
    from urdfsync.table.model import Sheet
    from urdfsync.table.reading import SheetReader
    from urdfsync.table.units import Unit, is_same_kind

    def fail(element: Element, code: str, message: str, hint: str) -> None:
        line = reader.element_lines[element]
        found = Diagnostic(Severity.ERROR, code, message, line=line, hint=hint)
        if found not in reader.diagnostics:
            reader.diagnostics.append(found)

    numbers = [number for number in _NUMBERS if number in header.attrib]
    by_line = {reader.element_lines[row]: row for row in rows}
    sheet = Sheet(
        [header.get(number, "") for number in numbers],
        [(line, [row.get(number) for number in numbers]) for line, row in by_line.items()],
    )
    table = SheetReader("", TableOptions())
    columns = table.columns(sheet, set())
    values = [] if table.findings else list(table.values(sheet, columns))
    for finding in table.findings:
        fail(by_line.get(finding.line, header), finding.code, finding.message, finding.hint)
    found = dict[str, Row]()
    for line, cells in values:
        row = by_line[line]
        name = row.get("joint", "")
        joint, gear, given = joints.get(name), dict[str, float](), list[str]()
        if joint is None:
            continue
        for number, column in zip(numbers, columns, strict=True):
            value = cells.get(column.name)
            if value is None:
                continue
            field, *units = _NUMBERS[number]
            expected = units[MOTION_KINDS[joint.get("type")] == "translational"]  # type: ignore[index] # see `joints`
            unit = column.type.si if isinstance(column.type, Unit) else {"integer": "1"}.get(column.type, "")
            try:
                is_right = bool(unit) and is_same_kind(unit, expected)
            except SourceError as error:
                fail(header, error.diagnostics[0].code, error.diagnostics[0].message, error.diagnostics[0].hint)
                continue
            if not is_right:
                has = f"is in {unit}" if unit else "has no unit"
                message = f"column `{column.name}` {has}, and the {number} of joint `{name}` needs {expected}"
                fail(header, "bad-unit", message, "correct its unit, or name another column in `motor_columns`")
                continue
            size = float(value)
            if size < 0 if number != "reduction" else not size:
                fail(row, "bad-cell", f"column `{column.name}`: {size:g} is no {number}", "correct the cell")
            given.append(number)
            if field == "transmission":
                gear[number] = size
                continue
            part = next((p for p in (joint.find(field), joint.find(f"axis/{field}")) if p is not None), None)
            if part is None and field == "limit" and joint.get("type") != "continuous":
                message = f"joint `{name}` has no <limit>, and a row can't give it limits of position"
                fail(row, "catalogue", message, "give it a <limit> with lower and upper")
                continue
            if part is None:
                part = SubElement(joint, field)
                reader.element_lines = {**reader.element_lines, part: line}
            part.set(number, repr(size))
        if not given:
            fail(row, "catalogue", f"the row `{row.get('motor')}` has no number of a drive", "fill its cells")
        found[name] = Row(Motor(row.get("motor", ""), tuple(given)), gear, row)
    return found


def with_row(reader: Reader, joint: Joint, row: Row | None) -> Joint:
    """Return a joint with the gear of its row."""
    if row is None:
        return joint
    gear = msgspec.structs.replace(joint.transmission or Transmission(), **row.gear)
    if gear.joint is not None and "reduction" in row.gear:
        message = f"the motor of joint `{joint.name}` moves `{gear.joint}`, too: a row can't give its reduction"
        line, hint = reader.element_lines[row.element], "leave its cell empty"
        reader.diagnostics.append(Diagnostic(Severity.ERROR, "catalogue", message, line=line, hint=hint))
    return msgspec.structs.replace(joint, motor=row.motor, transmission=None if gear == Transmission() else gear)
